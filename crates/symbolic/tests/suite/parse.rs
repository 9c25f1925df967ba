//! The notations of the printed models, and what is refused.

use denavit_symbolic::parse::{ParseError, parse, parse_angle, parse_definition};
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Expr, Rational, Symbol};
use proptest::prelude::*;
use std::ops::Range;

/// Six angles q1 … q6 and the lengths of the printed models.
fn robot() -> Vocabulary {
    let names =
        ["D3", "RL4", "R2", "a_1", "a_2", "a_3", "a_4", "d_2", "d_3", "D_7", "r_7", "a", "b", "x", "y"];
    let greek = ["α_j", "θ_j", "α_i", "θ_i", "θ_n", "r_j", "r_n", "d(O_2,O_3)"];
    let names = Vocabulary::new().symbols(names).symbols(greek).alias("R4", x("RL4")).alias("T1", q(1));
    (1..=6).fold(names, |v, n| v.angle(n, Symbol::new(&format!("q{n}"))))
}

fn x(name: &str) -> Expr {
    Expr::symbol(name)
}

fn q(n: u32) -> Expr {
    x(&format!("q{n}"))
}

fn sum(angles: &[u32]) -> Expr {
    angles.iter().fold(Expr::int(0), |s, &n| s + q(n))
}

fn c(angles: &[u32]) -> Expr {
    sum(angles).cos()
}

fn s(angles: &[u32]) -> Expr {
    sum(angles).sin()
}

fn number(n: i64, d: i64) -> Expr {
    Rational::new(n, d).into()
}

#[track_caller]
fn check(names: &Vocabulary, texts: &[&str], expect: Expr) {
    for text in texts {
        match parse(text, names) {
            Ok(e) => assert!(e == expect, "{text}: {:?} is not {:?}", tree(e), tree(expect)),
            Err(errors) => panic!("{text}: {errors:?}"),
        }
    }
}

/// The nodes, for messages.
fn tree(e: Expr) -> Vec<String> {
    Expr::postorder(&[e]).into_iter().map(|e| format!("{e:?} = {:?}", e.node())).collect()
}

#[track_caller]
fn check_error(names: &Vocabulary, text: &str, span: Range<usize>, message: &str, hint: Option<&str>) {
    let expect = ParseError { span, message: message.into(), hint: hint.map(Into::into) };
    assert_eq!(parse(text, names).map(tree), Err(vec![expect]), "{text}");
}

#[test]
fn words_are_cut_into_names_and_sines() {
    let v = robot();
    check(
        &v,
        &["C1*C23", "C1C23", "c1 c23", "c1.c23", "C_1 C_{23}", "C₁C₂₃", "C{1}C{23}", "cos1cos23"],
        c(&[1]) * c(&[2, 3]),
    );
    check(&v, &["a_2C_2", "a2C2", "a_{2}C_{2}", "a₂·C₂", r"\mathsf{a}_2\mathbf{C}_2"], x("a_2") * c(&[2]));
    check(&v, &["a2C1C2"], x("a_2") * c(&[1]) * c(&[2]));
    check(&v, &["S2D3"], s(&[2]) * x("D3"));
    check(&v, &["C12C1"], c(&[1, 2]) * c(&[1]));
    check(&v, &["S23R4", "S23RL4", r"S_{23}\mathit{RL}_{4}", r"s23.\mathit{RL}_4"], s(&[2, 3]) * x("RL4"));
    check(&v, &["2RL4", "2 RL4", "2*RL4", r"2\,RL_4"], Expr::int(2) * x("RL4"));
    check(&v, &["S_{234}", "S234", "s_{234}", "S_{2,3,4}", "S₂₃₄", "Sθ234", r"S\theta_{234}"], s(&[2, 3, 4]));
    check(
        &v,
        &["C_{2-3}", "cos(θ2-θ3)", r"\cos(\theta_2 − \theta_3)", r"C_{\theta_2-\theta_3}"],
        (q(2) - q(3)).cos(),
    );
    let v = v.symbols(["d23", "d4"]);
    check(&v, &["d23C1"], x("d23") * c(&[1]));
    check(&v, &["C4d4"], c(&[4]) * x("d4"));
}

#[test]
fn sines_of_angles() {
    let v = robot();
    check(
        &v,
        &[
            "cos(θ2+θ3)",
            "cos(q2 + q3)",
            "C(t2+t3)",
            "cos(theta2+th_3)",
            r"\cos\left(\theta_2+\theta_3\right)",
        ],
        c(&[2, 3]),
    );
    check(
        &v,
        &[
            "C(t1)*C(t2)",
            "C(t1)C(t2)",
            r"\cos\theta_1 \cos\theta_2",
            r"\cos\theta_1\cos\theta_2",
            "cos θ1 cos θ2",
        ],
        c(&[1]) * c(&[2]),
    );
    check(
        &v,
        &[
            "cos(T_1)",
            "C(T1)",
            "Cθ1",
            r"C\theta_1",
            r"C \theta_1",
            r"c_{\theta_1}",
            "cosθ1",
            r"\cos{\theta_1}",
            "cos q1",
            "c_{q1}",
        ],
        c(&[1]),
    );
    check(&v, &[r"\cos\theta_1 \sin(\theta_2+\theta_3)"], c(&[1]) * s(&[2, 3]));
    check(&v, &[r"S\theta_4C\theta_5", "Sθ4Cθ5", "Sθ₄Cθ₅"], s(&[4]) * c(&[5]));
    check(
        &v,
        &[r"c\alpha_j s\theta_j", r"c_{\alpha_j} s_{\theta_j}", "cα_j*sin(θ_j)"],
        x("α_j").cos() * x("θ_j").sin(),
    );
    check(&v, &[r"-r_j s\alpha_j"], -(x("r_j") * x("α_j").sin()));
    check(&v, &[r"r_nC(\theta_n)"], x("r_n") * x("θ_n").cos());
    check(&v, &["cos(q1/2 + pi/12)"], (q(1) / Expr::int(2) + Expr::pi() / Expr::int(12)).cos());
    check(&v, &["(a_3 + a_4 + d_3)C\\theta_2"], (x("a_3") + x("a_4") + x("d_3")) * c(&[2]));
    let v = v.degrees(true);
    check(
        &v,
        &[r"C(\theta_n + 90)", "cos(θ_n + pi/2)", "-sin(θ_n)", r"C(\theta_n + 90^\circ)"],
        -x("θ_n").sin(),
    );
    check(&v, &["sin(30)", "sin(30 deg)", "sin(π/6)", "1/2"], number(1, 2));
    check(&v, &["cos(0.5 rad)"], number(1, 2).cos());
    assert_eq!(parse_angle("90+θ2", &v).unwrap(), q(2) + Expr::pi() / Expr::int(2));
    assert_eq!(parse("90+θ2", &v).unwrap(), Expr::int(90) + q(2));
}

#[test]
fn printed_formulas() {
    let v = robot();
    let bracket = c(&[4]) * c(&[5]) * c(&[6]) - s(&[4]) * s(&[6]);
    check(
        &v,
        &[
            "C1(C23(C4C5C6 − S4S6) − S23S5C6)",
            "C1*(C23*(C4*C5*C6 - S4*S6) - S23*S5*C6)",
            "C1·(C23·(C4·C5·C6 − S4·S6) − S23·S5·C6)",
            r"C_{1}\left(C_{23}\left(C_{4}C_{5}C_{6} - S_{4}S_{6}\right) - S_{23}S_{5}C_{6}\right)",
            "C1[C23{C4C5C6 – S4S6} – S23S5C6]",
        ],
        c(&[1]) * (c(&[2, 3]) * bracket - s(&[2, 3]) * s(&[5]) * c(&[6])),
    );
    check(&v, &["c2.(D_7 + s_{34}.r_7)"], c(&[2]) * (x("D_7") + s(&[3, 4]) * x("r_7")));
    check(&v, &["c2.s_{34}.r_7", "c2 . s34 . r7"], c(&[2]) * s(&[3, 4]) * x("r_7"));
    check(&v, &["-(R2*S(t1)) + a*C(t1)*S(t2)"], -(x("R2") * s(&[1])) + x("a") * c(&[1]) * s(&[2]));
    check(
        &v,
        &["-C1(C23C4S5 + S23C5)"],
        -(c(&[1]) * (c(&[2, 3]) * c(&[4]) * s(&[5]) + s(&[2, 3]) * c(&[5]))),
    );
    check(&v, &["d(O_2,O_3)", "d(O2, O3)", "`d(O_2,O_3)`"], x("d(O_2,O_3)"));
    check(&v, &["C1d(O_2,O_3)", "C_1*`d(O_2,O_3)`"], c(&[1]) * x("d(O_2,O_3)"));
}

#[test]
fn numbers_fractions_roots_and_powers() {
    let v = robot();
    check(&v, &["0.5", ".5", r"\frac{1}{2}"], number(1, 2));
    check(
        &v,
        &["π/2", "pi/2", r"\pi/2", r"\frac{\pi}{2}", "90 deg", "90°", r"90^\circ", r"90^{\circ}", "90º"],
        Expr::pi() / Expr::int(2),
    );
    check(&v, &[r"\frac{-\pi}{2}", "-π/2", "−90 deg"], -(Expr::pi() / Expr::int(2)));
    check(&v, &["1e-3", "0.001"], number(1, 1000));
    check(&v, &["0.5 rad"], number(1, 2));
    check(&v, &[r"\frac{a}{b}", "a/b", "a÷b"], x("a") / x("b"));
    check(&v, &["1/(a*b)", "1/(ab)", r"\frac{1}{ab}"], Expr::int(1) / (x("a") * x("b")));
    check(&v, &["3*a/2", "3a/2", r"\frac{3a}{2}", "1.5a"], number(3, 2) * x("a"));
    check(&v, &["a*b/x*y", "(a*b/x)*y", r"\frac{ab}{x}y"], x("a") * x("b") / x("x") * x("y"));
    check(&v, &["√3", "sqrt(3)", r"\sqrt{3}", "√(3)"], Expr::int(3).sqrt());
    check(&v, &["sqrt(2)/2", "√(2)/2", r"\frac{\sqrt{2}}{2}"], Expr::int(2).sqrt() / Expr::int(2));
    check(&v, &["√2a", "√(2)*a"], Expr::int(2).sqrt() * x("a"));
    check(&v, &["x^2", "x²", "x^{2}", "x**2", "x^(2)"], x("x").powi(2));
    check(&v, &["x^(-2)", "x^-2", "x^{-2}", "x⁻²"], x("x").powi(-2));
    check(
        &v,
        &[
            "C1²",
            "C1^2",
            "c_1^2",
            "C^2_1",
            "cos^2(θ1)",
            r"\cos^2\theta_1",
            r"\cos^{2}(\theta_1)",
            r"\cos^2 \theta_1",
            "cos(θ1)^2",
        ],
        c(&[1]).powi(2),
    );
    check(&v, &["a^2_2 + b", "a_2^2 + b"], x("a_2").powi(2) + x("b"));
    check(&v, &["C1C2^2"], c(&[1]) * c(&[2]).powi(2));
    check(&v, &["-x^2"], -x("x").powi(2));
    check(
        &v,
        &["atan2(y,x)", r"\operatorname{atan2}\left(y, x\right)", r"\mathrm{atan2}(y, x)", "atan2(y , x)"],
        x("y").atan2(x("x")),
    );
    check(
        &v,
        &["a·b", "a×b", "a∗b", r"a \cdot b", r"a\times b", "ab", "a b", "a.b", r"a\,b", "(a)(b)"],
        x("a") * x("b"),
    );
    check(&v, &["-a*b", "-(a*b)", "−ab"], -(x("a") * x("b")));
    check(&v, &["a - -b", "a + b"], x("a") + x("b"));
}

#[test]
fn open_vocabularies_and_odd_names() {
    let v = Vocabulary::new().open(true);
    check(&v, &["a2C1C23", r"a_2 C_1 C_{23}", "a2*cos(q1)*cos(q2+q3)"], x("a2") * c(&[1]) * c(&[2, 3]));
    check(&v, &["RL4", r"\mathit{RL}_{4}", "R_L4", "`RL4`"], x("RL4"));
    check(&v, &["L_{23} + pos2", "L23+pos2"], x("L23") + x("pos2"));
    check(&v, &[r"c\alpha_j", "cos(α_j)"], x("αj").cos());
    check(&v, &[r"\alpha"], x("α"));
    check(&v, &[r"`a\`b\\c` + `any name`"], x(r"a`b\c") + x("any name"));
    let v = robot().symbol("any name").symbol("T'");
    check(&v, &["C1`any name`^2", r"C_{1} `any name`^{2}"], c(&[1]) * x("any name").powi(2));
    check(&v, &["`T'`.`any name`"], x("T'") * x("any name"));
    let v = (7..=12).fold(robot(), |v, n| v.angle(n, Symbol::new(&format!("q{n}"))));
    check(&v, &["C_{2,10}", "cos(q2+q10)"], c(&[2, 10]));
    check(&v, &["C_{12,}", "cos(q12)"], q(12).cos());
    check(&v, &["C10", "C_{10}"], q(10).cos());
}

#[test]
fn definitions() {
    let v = robot();
    for text in
        ["c34 = c3.c4 - s3.s4", "c_{34} = c3.c4 - s3.s4;", " c34=c3.c4 - s3.s4 .", "c34 = c3 c4 - s3 s4,"]
    {
        let d = parse_definition(text, &v).unwrap();
        assert_eq!(d.name, "c34");
        assert_eq!(d.value, c(&[3]) * c(&[4]) - s(&[3]) * s(&[4]));
        assert_eq!(text[d.span].trim_matches(['{', '}']).replace(['_', '{', '}'], ""), "c34");
    }
    assert_eq!(parse_definition("`odd name` = a", &v).unwrap().name, "odd name");
    assert_eq!(parse_definition(r"\theta_7 = a", &v).unwrap().name, "θ7");
    let error = |text| parse_definition(text, &v).unwrap_err().remove(0);
    assert_eq!(error("c34").message, "no `=`");
    assert_eq!(
        (error("a + b = 1").message.as_str(), error("a + b = 1").span),
        ("`a + b` is not one name", 0..5)
    );
    assert_eq!(error("a b = 1").message, "`a b` is not one name");
    assert_eq!(error("D1 = zz").span, 5..7);
    assert_eq!(error("D1 = a = b").message, "unexpected `=`");
}

#[test]
fn refused_words() {
    let v = robot();
    check_error(&v, "S23R5", 3..5, "unknown `R5`", None);
    check_error(&v, "S23RLL4", 3..7, "unknown `RLL4`", Some("did you mean `RL4`?"));
    check_error(&v, "a - S_{23}\\mathit{W}_{4}", 18..23, "unknown `W4`", None);
    check_error(
        &v,
        "C321",
        0..4,
        "the indices of `C321` do not ascend",
        Some("C_{123} is the sum of the angles 1, 2 and 3"),
    );
    check_error(&v, "C7", 0..2, "there is no angle number 7", None);
    check_error(
        &v,
        "a + log(q1)",
        4..7,
        "unknown function `log`",
        Some("the functions are sin, cos, tan, sqrt, atan2, arcsin, arccos and arctan"),
    );
    check_error(
        &v,
        "C(C23C4 - S4)",
        0..13,
        "the argument is not a sum of angles",
        Some("write `cos(…)` for a cosine, or the missing index"),
    );
    check_error(&v, "cos", 0..3, "`cos` takes its argument in brackets", None);
    let unclear = "it is not clear where the argument ends";
    check_error(&v, "cos 20 θ1", 4..6, unclear, Some("`cos` takes its argument in brackets"));
    check_error(&v, "sin 30°/2", 4..8, unclear, Some("`sin` takes its argument in brackets"));
    check_error(&v, "sin 2^2", 4..5, unclear, Some("`sin` takes its argument in brackets"));
    for (bare, bracketed) in [
        ("2 cos 20° + 1.5 sin 65° sin 30°", "2 cos(20°) + 1.5 sin(65°) sin(30°)"),
        ("1 - cos^2 60°", "1 - cos^2(60°)"),
        ("\\sin 30^\\circ", "sin(30°)"),
        ("cos 2 - sin 3", "cos(2) - sin(3)"),
    ] {
        assert_eq!(parse(bare, &v).expect(bare), parse(bracketed, &v).expect(bracketed), "{bare}");
    }
    check_error(
        &v,
        "cos2θ1",
        0..7,
        "`cos2θ1` reads as `cos(2*θ1)` or as `cos2*θ1`",
        Some("write brackets or `*`"),
    );
    let slides = Vocabulary::new().angle(2, Symbol::new("q2")).sliding(3, Symbol::new("q3"));
    check_error(&slides, "C23", 0..3, "variable 3 is a length, not an angle", None);
    check_error(&slides, "C2 + cos(θ_3)", 9..13, "variable 3 is a length, not an angle", None);
    let two = Vocabulary::new().symbols(["ab", "c", "a", "bc"]);
    check_error(
        &two,
        "abc",
        0..3,
        "`abc` reads as `a*bc` or as `ab*c`",
        Some("write `*` between the factors"),
    );
    let alike = Vocabulary::new().symbols(["a", "b", "c"]).alias("ab", x("a")).alias("bc", x("c"));
    check(&alike, &["abc"], x("a") * x("c"));
    let cosine = Vocabulary::new().symbols(["c", "β"]);
    check_error(&cosine, "cβ", 0..3, "`cβ` reads as `cβ` or as `c*β`", Some("write `*` between the factors"));
    check_error(
        &Vocabulary::new().open(true),
        "aC1",
        0..3,
        "`aC1` reads as `aC1` or as `a*C1`",
        Some("write `*` between the factors"),
    );
    let twelve = (1..=12).fold(Vocabulary::new(), |v, n| v.angle(n, Symbol::new(&format!("q{n}"))));
    check_error(
        &twelve,
        "C12",
        0..3,
        "`C12` reads as angle 12 or as the sum of the angles 1,2",
        Some("write `C_{1,2}` or `C_{12,}`"),
    );
    check_error(&v, "R4R4R4 + zz", 9..11, "unknown `zz`", None);
}

#[test]
fn refused_structure() {
    let v = robot();
    let fraction = Some("write `*`, brackets or `\\frac`");
    check_error(&v, "a/2a_2a_3", 1..6, "`/2 a_2` reads as `/2*a_2` or as `/(2*a_2)`", fraction);
    check_error(&v, "a/b(x+y)", 1..8, "`/b (x+y)` reads as `/b*(x+y)` or as `/(b*(x+y))`", fraction);
    check_error(&v, "c2.5", 0..4, "`c2.5` reads as `c2*5` or as `c2*0.5`", Some("write `*` for the product"));
    check_error(&v, "0,5", 1..2, "unexpected `,`", Some("a decimal point is `.`"));
    check_error(&v, "a 2", 2..3, "two values without a sign between them", Some("write a product with `*`"));
    check_error(&v, "(a", 0..1, "no `)` closes this bracket", None);
    check_error(&v, "a)", 1..2, "unexpected `)`", Some("no bracket is open here"));
    check_error(&v, "(a]", 2..3, "unexpected `]`", Some("`)` closes the bracket"));
    check_error(&v, "a +", 3..3, "the formula ends where a name or a number should stand", None);
    check_error(&v, "(²", 1..3, "unexpected `²`", None);
    check_error(&v, "a * / b", 4..5, "unexpected `/`", None);
    check_error(&v, "a / 0", 2..5, "division by zero", None);
    check_error(&v, "", 0..0, "no formula", None);
    check_error(&v, "a\u{200b}b", 1..4, "invisible character U+200B", Some("delete it"));
    check_error(&v, "\u{feff}a", 0..3, "invisible character U+FEFF", Some("delete it"));
    check_error(&v, "a # b", 2..3, "unexpected character `#`", None);
    check_error(&v, r"a \foo b", 2..6, r"unknown command `\foo`", None);
    check_error(
        &v,
        "a = b",
        2..3,
        "unexpected `=`",
        Some("a formula has no `=`; a definition is `name = formula`"),
    );
    check_error(
        &v,
        "x^a",
        1..3,
        "an exponent is a whole number from -1000 to 1000",
        Some("a root is `sqrt(…)`"),
    );
    check_error(&v, "x^2^2", 1..3, "a power of a power has two readings", Some("write brackets: `(x^2)^3`"));
    check_error(&v, "a deg", 2..5, "unknown `deg`", None);
    check_error(&v, "a°", 1..3, "a unit stands directly behind a number", None);
    check_error(
        &v,
        "cos^{-1}(q1)",
        0..12,
        "a negative power of a function has two readings",
        Some("write `1/cos(…)`, or `arccos(…)` for the inverse function"),
    );
    let errors = parse("zz + \u{200b} + log(a) )", &v).unwrap_err();
    let spans: Vec<_> = errors.iter().map(|e| e.span.clone()).collect();
    assert_eq!(spans, [0..2, 5..8, 11..14], "{errors:?}");
}

#[test]
fn bounds() {
    let v = robot();
    let message = |text: &str| parse(text, &v).unwrap_err().remove(0).message;
    let nested = |n: usize| format!("{}a{}", "(".repeat(n), ")".repeat(n));
    check(&v, &[&nested(100)], x("a"));
    assert_eq!(message(&nested(101)), "nested more than 100 deep");
    let chain = |n: usize| format!("a{}", "*b".repeat(n));
    assert!(parse(&chain(2000), &v).is_ok());
    assert_eq!(message(&chain(2001)), "more than 2000 operators in a row");
    assert_eq!(message(&"a+".repeat(40_000)), "the text has 80000 bytes; at most 65536 are read");
    assert_eq!(message("9^999*9^999*9^999"), "the numbers become too large");
    assert_eq!(message("((10^1000)^1000)^1000"), "the numbers become too large");
    assert!(parse(&"-".repeat(60_000), &v).is_err());
    assert!(parse(&"√".repeat(20_000), &v).is_err());
    assert!(parse(&"x".repeat(65_000), &v).is_err());
    assert!(parse(&"C1".repeat(30_000), &v).is_err());
    assert!(parse(&"\\frac{".repeat(10_000), &v).is_err());
    assert!(parse(&"C_{".repeat(20_000), &v).is_err());
    assert!(parse(&"9".repeat(60_000), &v).is_err());
    let fractions: String = (0..1500).map(|i| format!("+q1/{}", 1_000_000_007_u64 + i)).collect();
    assert!(parse(&format!("cos({fractions})"), &v).is_err());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, failure_persistence: None, rng_seed: proptest::test_runner::RngSeed::Fixed(7), ..ProptestConfig::default() })]

    /// Whatever comes in, an answer comes out, and the places of errors are places of the text.
    #[test]
    fn no_text_is_too_odd(text in "(C|S|cos|sin|θ|\\\\theta|\\\\frac|\\\\cos|√|sqrt|atan2|[()\\[\\]{}^_+*/.,=` −²₂π°0-9a-dqRL]){0,40}", odd in ".{0,40}") {
        for v in [robot(), robot().degrees(true), Vocabulary::new().open(true)] {
            for text in [&text, &odd] {
                for e in [parse(text, &v).err(), parse_angle(text, &v).err(), parse_definition(text, &v).err()].into_iter().flatten().flatten() {
                    prop_assert!(text.get(e.span.clone()).is_some(), "{text:?}: {e:?}");
                }
            }
        }
    }
}
