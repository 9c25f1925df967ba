//! Formulas as text in every style.

use denavit_symbolic::Expr;
use denavit_symbolic::Symbol;
use denavit_symbolic::parse::parse;
use denavit_symbolic::print::{Style, print, print_symbol};
use denavit_symbolic::readable::simplify;
use denavit_symbolic::vocabulary::Vocabulary;
use proptest::prelude::*;
use proptest::test_runner::{RngSeed, TestRunner};

fn x(name: &str) -> Expr {
    Expr::symbol(name)
}

fn n(value: i64) -> Expr {
    Expr::int(value)
}

/// Sine and cosine of a sum of joint angles.
fn s(numbers: &[u32]) -> Expr {
    angle(numbers).sin()
}

fn c(numbers: &[u32]) -> Expr {
    angle(numbers).cos()
}

fn angle(numbers: &[u32]) -> Expr {
    numbers.iter().fold(n(0), |sum, i| sum + x(&format!("q{i}")))
}

const LENGTHS: [&str; 16] =
    ["a", "b", "d", "a2", "a3", "d1", "d3", "d4", "d5", "d6", "D3", "RL4", "alpha2", "e1", "L_1", "any name"];

fn robot() -> Vocabulary {
    (1..=12).fold(Vocabulary::new().symbols(LENGTHS), |v, i| v.angle(i, Symbol::new(&format!("q{i}"))))
}

#[track_caller]
fn check(style: Style, e: Expr, expected: &str) {
    assert_eq!(print(e, &robot(), style), expected);
}

/// First row of the product of Denavit-Hartenberg matrices: distal convention (Rz Tz Tx Rx), quarter turns `k`.
fn first_row_distal(table: &[(i64, Expr, Expr)]) -> [Expr; 4] {
    let mut row = [n(1), n(0), n(0), n(0)];
    for (i, &(k, a, d)) in table.iter().enumerate() {
        let (s, c) = x(&format!("q{}", i + 1)).sin_cos();
        let (sa, ca) = (n(k), n(1 - k.abs()));
        let [x, y, z, w] = row;
        row = [x * c + y * s, y * c * ca - x * s * ca + z * sa, x * s * sa - y * c * sa + z * ca, w];
        row[3] = x * a * c + y * a * s + z * d + w;
    }
    row
}

/// The same for the proximal convention (Rx Tx Rz Tz).
fn first_row_proximal(table: &[(i64, Expr, Expr)]) -> [Expr; 4] {
    let mut row = [n(1), n(0), n(0), n(0)];
    for (i, &(k, a, d)) in table.iter().enumerate() {
        let (s, c) = x(&format!("q{}", i + 1)).sin_cos();
        let (sa, ca) = (n(k), n(1 - k.abs()));
        let [x, y, z, w] = row;
        let (y1, z1) = (y * ca + z * sa, z * ca - y * sa);
        row = [x * c + y1 * s, y1 * c - x * s, z1, x * a + z1 * d + w];
    }
    row
}

/// The strings of notes/exact-algebra.md, section 4, which a prototype in another language printed.
#[test]
fn robots_read_as_in_a_textbook() {
    let (o, d3, rl4) = (n(0), x("D3"), x("RL4"));
    // Khalil and Dombre, Modeling, identification and control of robots (2002), table 3.1
    let rx90 = first_row_proximal(&[(0, o, o), (1, o, o), (0, d3, o), (-1, o, rl4), (1, o, o), (-1, o, o)]);
    let puma = first_row_distal(&[
        (1, o, o),
        (0, x("a2"), o),
        (-1, x("a3"), x("d3")),
        (1, o, x("d4")),
        (-1, o, o),
        (0, o, x("d6")),
    ]);
    let rows = [
        (rx90[0], "C1(C23(C4C5C6 − S4S6) − S23S5C6) − S1(S4C5C6 + C4S6)"),
        (rx90[2], "S1S4S5 − C1(C23C4S5 + S23C5)"),
        (rx90[3], "C1(D3C2 − RL4S23)"),
        (puma[3], "C1(C23(a3 − d6C4S5) + a2C2 − S23(d4 + d6C5)) + S1(d3 + d6S4S5)"),
    ];
    for (raw, expected) in rows {
        check(Style::Unicode, simplify(raw, &[]).unwrap().expr, expected);
    }
    // Products and sums as they are given
    let reach = x("a2") * c(&[2]) + x("a3") * c(&[2, 3]) + x("d5") * s(&[2, 3, 4]);
    let ur5 = c(&[1]) * (reach - x("d6") * c(&[2, 3, 4]) * s(&[5])) + s(&[1]) * (x("d4") + x("d6") * c(&[5]));
    check(Style::Unicode, ur5, "C1(a2C2 + a3C23 + d5S234 − d6C234S5) + S1(d4 + d6C5)");
    let rx90 = d3 * rl4 * s(&[5]) * c(&[3]) * (d3 * c(&[2]) - rl4 * s(&[2, 3]));
    check(Style::Unicode, rx90, "D3RL4S5C3(D3C2 − RL4S23)");
    check(Style::Ascii, rx90, "D3*RL4*S5*C3*(D3*C2 - RL4*S23)");
}

#[test]
fn ascii() {
    let (a, b, d) = (x("a"), x("b"), x("d"));
    let rows = [
        (n(-2), "-2"),
        (n(3) * a / n(2), "3*a/2"),
        (a / n(2), "a/2"),
        (n(1) / (a * b), "1/(a*b)"),
        (n(2) * (a + b) / n(3), "2*(a + b)/3"),
        (n(3) * a / (n(2) * b), "3*a/(2*b)"),
        (n(1) / n(2) + a, "1/2 + a"),
        (-(a + b), "-(a + b)"),
        (-a.powi(2), "-a^2"),
        ((a * b).powi(-2), "(a*b)^(-2)"),
        (a.powi(65536).powi(65536), "(a^65536)^65536"),
        (a + (b + d), "a + (b + d)"),
        (a - (b - d), "a + (d - b)"),
        (a - b + d, "a - b + d"),
        (-(a - b - d), "-(a - b - d)"),
        (-(a - b - d) - b, "-(a - b - d + b)"),
        (d - (a - b - d), "d - (a - b - d)"),
        (a * (b * d), "a*(b*d)"),
        (a * (b / d), "a*(b/d)"),
        (a / b * d, "a/b*d"),
        (a / (b / d), "a/(b/d)"),
        (a / b / d, "a/b/d"),
        (a / n(0), "a/0"),
        (n(3) * (a / n(0)) + d, "3*(a/0) + d"),
        ((-a) / n(0), "(-a)/0"),
        (n(3).sqrt() / n(2), "sqrt(3)/2"),
        ((a + b).sqrt().powi(3), "sqrt(a + b)^3"),
        (n(-1).sqrt(), "sqrt(-1)"),
        (a.atan2(-b), "atan2(a, -b)"),
        (n(1519) / n(10000) * a, "0.1519*a"),
        (n(-1) / n(20), "-0.05"),
        (n(3) / n(4) + n(1) / n(10) * a, "3/4 + 0.1*a"),
        (n(1) / n(3200000) * a, "a/3200000"),
        (s(&[2, 3]).powi(2), "S23^2"),
        (c(&[2, 10]), "C_{2,10}"),
        (c(&[10]), "C10"),
        (c(&[12]), "cos(q12)"),
        (c(&[1, 2]), "C_{1,2}"),
        ((x("q2") - x("q3")).sin(), "S_{2-3}"),
        ((x("q2") - x("q10")).sin(), "S_{2-10}"),
        ((x("q2") + x("q3") - x("q4")).sin(), "sin(q2 + q3 - q4)"),
        ((n(2) * x("q2")).cos(), "cos(2*q2)"),
        ((x("q2") + Expr::pi() / n(20)).cos(), "cos(q2 + 9 deg)"),
        (x("alpha2").cos() * x("any name"), "cos(alpha2)*`any name`"),
    ];
    for (e, expected) in rows {
        check(Style::Ascii, e, expected);
    }
}

#[test]
fn unicode() {
    let (a, a2, d) = (x("a"), x("a2"), x("d"));
    let sum = c(&[2]) + s(&[3]);
    let rows = [
        (a2 * c(&[2]) * sum, "a2C2(C2 + S3)"),
        (a2.powi(2) * c(&[2, 3]).powi(12), "a2²C23¹²"),
        (a2.powi(-2), "a2⁻²"),
        (n(2) * a2 * sum, "2a2(C2 + S3)"),
        (n(2) * sum / n(3), "2(C2 + S3)/3"),
        (n(2) * x("e1"), "2·e1"),
        (d * sum, "d·(C2 + S3)"),
        (d * c(&[2]), "d·C2"),
        (sum * d, "(C2 + S3)d"),
        (a2 / a * c(&[2]), "a2/a·C2"),
        (c(&[2]) / (a2 * d), "C2/(a2d)"),
        (n(2) * n(3).sqrt() * a2, "2√3·a2"),
        (n(3).sqrt().powi(3) * a2, "(√3)³a2"),
        ((a2 + d).sqrt() * a2, "√(a2 + d)a2"),
        (n(2) * Expr::pi() * a2, "2π·a2"),
        (a2 * x("alpha2").cos() * x("alpha2").sin(), "a2·cos(α2)·sin(α2)"),
        (a2 * n(0).powi(-1), "a2·0⁻¹"),
        (c(&[2, 10]) * c(&[2]), "C_{2,10}C2"),
        (-a2 - x("any name"), "−(a2 + `any name`)"),
    ];
    for (e, expected) in rows {
        check(Style::Unicode, e, expected);
    }
}

#[test]
fn a_dot_stands_where_another_word_would_be_cut() {
    let names = robot().symbols(["d4C", "a2b", "d4(O1,O2)", "C3"]);
    let rows = [
        (x("d4") * c(&[2]), "d4·C2"),
        (x("d4") * x("C3"), "d4·C3"),
        (x("a2") * x("b"), "a2·b"),
        (x("d4") * (x("a") + x("b")), "d4·(a + b)"),
        (c(&[3]) * x("C3"), "cos(q3)C3"),
    ];
    for (e, expected) in rows {
        assert_eq!(print(e, &names, Style::Unicode), expected);
    }
}

#[test]
fn latex() {
    let (a, a2, rl4) = (x("a"), x("a2"), x("RL4"));
    let rows = [
        (c(&[1]) * (c(&[2, 3]) * a2 - s(&[4])), r"C_{1}\left(C_{23} a_{2} - S_{4}\right)"),
        (n(3) * a / (n(2) * rl4), r"\frac{3 a}{2 \mathit{RL}_{4}}"),
        ((a + a2) / n(2), r"\frac{a + a_{2}}{2}"),
        (a * (a2 / rl4), r"a \frac{a_{2}}{\mathit{RL}_{4}}"),
        ((a2 / rl4).powi(2), r"\left(\frac{a_{2}}{\mathit{RL}_{4}}\right)^{2}"),
        (a * (a + a2), r"a \cdot \left(a + a_{2}\right)"),
        (a2.atan2(a), r"\operatorname{atan2}\left(a_{2}, a\right)"),
        (x("alpha2").cos() * n(3).sqrt(), r"\cos\left(\alpha_{2}\right) \sqrt{3}"),
        (-c(&[2, 10]).powi(2), r"-C_{2,10}^{2}"),
        ((x("q2") - x("q3")).cos(), r"C_{2-3}"),
    ];
    for (e, expected) in rows {
        check(Style::Latex, e, expected);
    }
}

#[test]
fn typst() {
    let (a, a2, rl4) = (x("a"), x("a2"), x("RL4"));
    let rows = [
        (c(&[1]) * (c(&[2, 3]) * a2 - s(&[4])), "C_1 (C_23 a_2 - S_4)"),
        (n(3) * a / (n(2) * rl4), "frac(3 a, 2 \"RL\"_4)"),
        (a2.atan2(a), "op(\"atan2\")(a_2, a)"),
        (x("alpha2").cos() * n(3).sqrt(), "cos(alpha_2) sqrt(3)"),
        (c(&[2, 10]).powi(2), "C_(2,10)^2"),
        (a.powi(-2), "a^(-2)"),
    ];
    for (e, expected) in rows {
        check(Style::Typst, e, expected);
    }
}

#[test]
fn mathml() {
    let (a2, rl4) = (x("a2"), x("RL4"));
    let rows = [
        (
            n(2) * a2 * c(&[2, 3]),
            "<mrow><mn>2</mn><mo>&#x2062;</mo><msub><mi>a</mi><mn>2</mn></msub><mo>&#x2062;</mo>\
             <msub><mi>C</mi><mn>23</mn></msub></mrow>",
        ),
        (
            rl4.powi(2) / n(3).sqrt(),
            "<mrow><mfrac><mrow><msup><msub><mi>RL</mi><mn>4</mn></msub><mn>2</mn></msup></mrow>\
             <mrow><msqrt><mn>3</mn></msqrt></mrow></mfrac></mrow>",
        ),
        (-x("alpha2"), "<mrow><mo>−</mo><msub><mi>α</mi><mn>2</mn></msub></mrow>"),
    ];
    for (e, expected) in rows {
        check(Style::MathMl, e, expected);
    }
}

#[test]
fn hostile_names_are_quoted() {
    let rows = [
        (Style::Ascii, "a`b\\", r"`a\`b\\`"),
        (Style::Ascii, "C1", "`C1`"),
        (Style::Ascii, "pi", "`pi`"),
        (Style::Ascii, "", "``"),
        (Style::Unicode, "x-y", "`x-y`"),
        (Style::Unicode, "theta3", "θ3"),
        (Style::Latex, "a_$x%", r"\text{`a\_\$x\%`}"),
        (Style::Latex, "RL4", r"\mathit{RL}_{4}"),
        (Style::Typst, "a\"b\\", r#""a\"b\\""#),
        (Style::Typst, "#x", "\"#x\""),
        (Style::MathMl, "<script>&", "<mi>&lt;script&gt;&amp;</mi>"),
        (Style::MathMl, "L\0", "<mi>L\u{fffd}</mi>"),
    ];
    for (style, name, expected) in rows {
        assert_eq!(print_symbol(name, style), expected, "{style:?}");
    }
}

#[test]
fn declared_spellings_print_as_themselves() {
    let names = Vocabulary::new().symbol("d(O_2,O_3)");
    let e = n(2) * x("d(O_2,O_3)");
    assert_eq!(print(e, &names, Style::Ascii), "2*d(O_2,O_3)");
    assert_eq!(print(e, &names, Style::Latex), r"2 d(O_{2},O_{3})");
    assert_eq!(print(e, &Vocabulary::new(), Style::Ascii), "2*`d(O_2,O_3)`");
}

#[test]
fn depth_and_size_have_no_limit_but_the_text() {
    let (mut sum, mut nested, mut huge) = (n(0), x("a"), x("a"));
    for i in 0..100_000 {
        sum = sum + x(&format!("d{}", i % 10));
        nested = x("a") * (x("b") - nested);
    }
    for _ in 0..60 {
        huge = huge * huge + huge;
    }
    assert_eq!(print(sum, &Vocabulary::new(), Style::Ascii).len(), 100_000 * 5 - 3);
    assert_eq!(print(nested, &robot(), Style::Unicode).matches('(').count(), 100_000);
    let cut = print(huge, &robot(), Style::Latex);
    assert!(cut.ends_with('…') && cut.len() < 10_000_100);
    let right = (0..100_000).fold(x("a"), |e, _| (e + n(1)).sqrt());
    assert!(print(right, &robot(), Style::Typst).starts_with("sqrt(sqrt("));
}

#[test]
fn debug_and_display_use_full_words() {
    let e = c(&[2, 3]) * x("a2");
    assert_eq!(format!("{e} {e:?}"), "cos(q2 + q3)*a2 cos(q2 + q3)*a2");
}

/// A formula of few nodes over the names, with all kinds of nodes that can be read (no x/0, no √−1).
fn formula(names: Vec<String>) -> impl Strategy<Value = Expr> {
    let number = (-12_i64..60, prop::sample::select(vec![1, 1, 2, 3, 7, 10, 20, 64, 1000, 10_000_000]));
    let leaf = prop_oneof![
        2 => number.prop_map(|(p, q)| n(p) / n(q)),
        1 => Just(Expr::pi()),
        6 => prop::sample::select(names).prop_map(|name| x(&name)),
        4 => (prop::collection::vec(1_u32..13, 1..4), any::<bool>()).prop_map(|(i, sine)| if sine { s(&i) } else { c(&i) }),
        1 => (1_u32..13, 1_u32..13).prop_map(|(i, j)| (angle(&[i]) - angle(&[j])).cos()),
    ];
    leaf.prop_recursive(5, 24, 2, |inner| {
        let pair = (inner.clone(), inner.clone());
        prop_oneof![
            4 => pair.clone().prop_map(|(a, b)| a * b),
            2 => pair.clone().prop_map(|(a, b)| a + b),
            2 => pair.clone().prop_map(|(a, b)| a - b),
            2 => pair.clone().prop_map(|(a, b)| if b.is_zero() { a } else { a / b }),
            1 => pair.prop_map(|(a, b)| a.atan2(b)),
            1 => inner.clone().prop_map(|a| -a),
            1 => (inner.clone(), -3..4).prop_map(|(a, n)| if a.is_zero() { a } else { a.powi(n) }),
            1 => inner.clone().prop_map(|a| if a.as_number().is_some_and(|r| r.is_negative()) { a } else { a.sqrt() }),
            1 => inner.clone().prop_map(|a| a.sin()),
            1 => inner.prop_map(|a| a.cos()),
        ]
    })
}

/// What is printed with these words is read back as the same handle.
#[track_caller]
fn round_trip(names: &[&str], vocabulary: &Vocabulary, cases: u32) {
    let config = ProptestConfig {
        cases,
        rng_seed: RngSeed::Fixed(2),
        failure_persistence: None,
        max_global_rejects: cases,
        ..ProptestConfig::default()
    };
    let names = names.iter().map(|n| n.to_string()).collect();
    let result = TestRunner::new(config).run(&formula(names), |e| {
        // Sums turned round as a whole, and sin(−1) as it comes from sin(π − 1), are not rebuilt as they are.
        prop_assume!(e.substitute(|_| None) == e);
        for style in [Style::Ascii, Style::Unicode, Style::Latex] {
            let text = print(e, vocabulary, style);
            match parse(&text, vocabulary) {
                Ok(read) => prop_assert_eq!(read, e, "{:?}: {}", style, text),
                Err(errors) => prop_assert!(false, "{:?}: {}: {}", style, text, errors[0]),
            }
        }
        Ok(())
    });
    if let Err(e) = result {
        panic!("{e}");
    }
}

#[test]
fn formulas_are_read_back() {
    round_trip(&LENGTHS, &robot(), 500);
}

#[test]
fn formulas_with_hostile_names_are_read_back() {
    let names = [
        "C1",
        "pi",
        "c",
        "s",
        "ac",
        "asin",
        "e",
        "E2",
        "rad",
        "d4C",
        "d4",
        "theta2",
        "α3",
        "αx",
        "L_1",
        "base_height",
        "d(O_2,O_3)",
        "d2(x)",
        "d2",
        "a`b\\",
        "x-y",
        "^~{}_%&#$",
        "é",
        "a2b",
        "a2",
        "b",
        "2x",
        "q77",
    ];
    round_trip(&names, &robot().symbols(names), 500);
}

#[test]
fn formulas_in_open_vocabularies_are_read_back() {
    let names =
        ["a", "b", "a2", "RL4", "aC1", "C1", "sin", "pi", "tau2", "alpha", "α3", "L_1", "deg", "x y", "q3"];
    round_trip(&names, &Vocabulary::new().open(true).symbols(["a", "a2"]), 500);
}

#[test]
fn formulas_in_degrees_are_read_back() {
    round_trip(&LENGTHS, &robot().degrees(true), 500);
}
