//! The printed form of a formula: its parts, their places, signs of two values, inverse functions.

use denavit_symbolic::parse::{
    Function, MAX_SIGN_CHOICES, Sign, Syntax, SyntaxKind, parse, parse_definition, parse_syntax,
};
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Expr, Symbol};
use proptest::prelude::*;

fn x(name: &str) -> Expr {
    Expr::symbol(name)
}

fn q(n: u32) -> Expr {
    x(&format!("q{n}"))
}

fn n(value: i64) -> Expr {
    Expr::int(value)
}

/// Six angles q1 … q6 and some lengths.
fn robot() -> Vocabulary {
    let names = ["D3", "RL4", "R2", "a_2", "a_3", "d_2", "d_3", "D_7", "r_7", "b", "x", "y", "X", "Y"];
    let greek = ["α_j", "θ_j", "θ_n", "r_j", "r_n", "d(O_2,O_3)"];
    let names = Vocabulary::new().symbols(names).symbols(greek).alias("T1", q(1));
    (1..=6).fold(names, |v, n| v.angle(n, Symbol::new(&format!("q{n}"))))
}

fn vocabularies() -> [Vocabulary; 4] {
    let open = Vocabulary::new().open(true);
    [robot().symbol("a"), robot().degrees(true), open.clone(), open.degrees(true)]
}

/// The parts in brackets with the letter of their kind, the names as they are printed.
fn shape(part: &Syntax, text: &str) -> String {
    let inner: Vec<String> = part.children().into_iter().map(|c| shape(c, text)).collect();
    let printed = &text[part.span.clone()];
    match &part.kind {
        SyntaxKind::Number(_) | SyntaxKind::Name(_) => printed.to_string(),
        SyntaxKind::Sum(terms) => {
            let sign = |sign| match sign {
                Sign::Plus => '+',
                Sign::Minus => '-',
                Sign::PlusMinus => '±',
                Sign::MinusPlus => '∓',
            };
            let terms = terms.iter().zip(inner).map(|(t, inner)| format!("{}{inner}", sign(t.0)));
            format!("sum[{}]", terms.collect::<Vec<_>>().join(" "))
        }
        SyntaxKind::Product(factors) => {
            let factors =
                factors.iter().zip(inner).map(|(f, inner)| format!("{}{inner}", if f.0 { "/" } else { "" }));
            format!("product[{}]", factors.collect::<Vec<_>>().join(" "))
        }
        SyntaxKind::Fraction(..) => format!("fraction[{}]", inner.join(" ")),
        SyntaxKind::Power(_, n) => format!("power[{} {n}]", inner.join(" ")),
        SyntaxKind::Root(_) => format!("root[{}]", inner.join(" ")),
        SyntaxKind::Call(f, _) => format!("{}[{}]", f.name(), inner.join(" ")),
        SyntaxKind::Bracket(_) => format!("bracket[{}]", inner.join(" ")),
    }
}

#[track_caller]
fn read(text: &str, names: &Vocabulary) -> Syntax {
    parse_syntax(text, names).unwrap_or_else(|e| panic!("{text}: {e:?}"))
}

#[track_caller]
fn check_shape(text: &str, expect: &str) {
    let syntax = read(text, &robot());
    assert_eq!(shape(&syntax, text), expect, "{text}");
    assert_eq!(&text[syntax.span.clone()], text.trim());
}

#[track_caller]
fn check_value(names: &Vocabulary, texts: &[&str], expect: Expr) {
    for text in texts {
        let value = read(text, names).value();
        assert!(value == expect, "{text}: {value} is not {expect}");
    }
}

#[track_caller]
fn check_error(text: &str, message: &str) {
    let errors = parse_syntax(text, &robot()).map(|s| s.value()).unwrap_err();
    assert_eq!(errors[0].to_string(), message, "{text}");
}

/// Parts lie within the whole, in the order of print and without overlap.
fn has_places(part: &Syntax, text: &str) -> bool {
    let mut at = part.span.start;
    let children = part.children();
    let mut is_inside = |s: &Syntax| {
        let fits = at <= s.span.start && s.span.end <= part.span.end;
        at = s.span.end;
        fits && has_places(s, text)
    };
    text.get(part.span.clone()).is_some_and(|s| !s.is_empty()) && children.iter().copied().all(&mut is_inside)
}

#[test]
fn the_shape_of_a_formula() {
    check_shape("b", "b");
    check_shape("a_2C_2", "product[a_2 C_2]");
    check_shape("C1(C23D3 − S4)", "product[C1 bracket[sum[+product[C23 D3] -S4]]]");
    check_shape("+b", "sum[+b]");
    check_shape("-b x", "sum[-product[b x]]");
    check_shape("b*-x", "product[b sum[-x]]");
    check_shape("b - --x", "sum[+b -sum[+x]]");
    check_shape("(-b)", "bracket[sum[-b]]");
    check_shape("b/x*y", "product[b /x y]");
    check_shape("((b))[x]", "product[bracket[bracket[b]] bracket[x]]");
    check_shape(r"\frac{b + x}{2 y}", "fraction[sum[+b +x] product[2 y]]");
    check_shape("√x + √(x) + sqrt(x) + \\sqrt{x}", "sum[+root[x] +root[x] +root[x] +root[x]]");
    check_shape("x^{2} - x² - (x)**2", "sum[+power[x 2] -power[x 2] -power[bracket[x] 2]]");
    check_shape("-x^2", "sum[-power[x 2]]");
    check_shape("x + b C^2_1", "sum[+x +product[b power[C^2_1 2]]]");
    check_shape("cos(θ2+θ3)^2 + cos^2(θ_2)", "sum[+power[cos[sum[+θ2 +θ3]] 2] +power[cos[θ_2] 2]]");
    check_shape(r"\cos\theta_1 \sin(\theta_2)", r"product[\cos\theta_1 sin[\theta_2]]");
    check_shape("atan2(y, -x)", "atan2[y sum[-x]]");
    check_shape(
        r"\mathit{RL}_{4}C_{1} + S_{\theta_2}",
        r"sum[+product[\mathit{RL}_{4} C_{1}] +S_{\theta_2}]",
    );
    check_shape("cos(θ2 + 90^{\\circ}) x", "product[cos[sum[+θ2 +90^{\\circ}]] x]");
    check_shape("D_7 (S_{23} ± 2 deg)", "product[D_7 bracket[sum[+S_{23} ±2 deg]]]");
}

#[test]
fn the_places_of_parts() {
    let text = r"x - 2\left(b + \frac{y}{\mathit{RL}_{4}}\right)^{2}";
    let mut found = vec![];
    let mut rest = vec![read(text, &robot())];
    while let Some(part) = rest.pop() {
        found.push(text[part.span.clone()].to_string());
        rest.extend(part.children().into_iter().rev().cloned());
    }
    let power = r"(b + \frac{y}{\mathit{RL}_{4}}\right)^{2}";
    let fraction = r"\frac{y}{\mathit{RL}_{4}}";
    let expect = [
        text,
        "x",
        &format!(r"2\left{power}"),
        "2",
        power,
        power.strip_suffix("^{2}").unwrap(),
        &format!("b + {fraction}"),
        "b",
        fraction,
        "y",
        r"\mathit{RL}_{4}",
    ];
    assert_eq!(found, expect);
}

/// The strings of a test: what stands between quotes in its source.
fn strings(source: &str) -> Vec<String> {
    let mut found = vec![];
    let mut rest = source;
    while let Some(at) = rest.find('"') {
        let is_raw = rest[..at].ends_with('r');
        let mut string = String::new();
        let mut chars = rest[at + 1..].char_indices();
        let end = loop {
            match chars.next() {
                Some((i, '"')) => break i,
                Some((_, '\\')) if !is_raw => string.extend(chars.next().map(|c| c.1)),
                Some((_, c)) => string.push(c),
                None => return found,
            }
        };
        found.push(string);
        rest = &rest[at + 1 + end + 1..];
    }
    found
}

#[test]
fn the_value_is_that_of_the_parser_for_all_formulas_of_the_tests() {
    let mut count = 0;
    for text in [include_str!("parse.rs"), include_str!("print.rs")].into_iter().flat_map(strings) {
        for names in vocabularies() {
            if let Ok(value) = parse(&text, &names) {
                let syntax = read(&text, &names);
                assert!(syntax.value() == value, "{text}: {} is not {value}", syntax.value());
                assert!(has_places(&syntax, &text), "{text}: {syntax:?}");
                count += 1;
            }
        }
    }
    assert!(count > 800, "{count} formulas");
}

#[test]
fn bare_numbers_of_angles_are_degrees() {
    let v = robot().degrees(true);
    let right = Expr::pi() / n(2);
    check_value(
        &v,
        &[
            "cos(θ2 + 90)",
            "cos(θ2 + 180/2)",
            "cos((90 + θ2))",
            "cos(2(θ2/2 + 45))",
            r"\cos{\frac{2θ2 + 180}{2}}",
        ],
        (q(2) + right).cos(),
    );
    check_value(&v, &["cos(θ2 + 0.5 rad) + 0.5 rad"], (q(2) + n(1) / n(2)).cos() + n(1) / n(2));
    check_value(&v, &["sin(√4 + 28)", "sin(3*10)", "sin(30)", "sin(2^2 + 26)"], n(1) / n(2));
    check_value(&v, &["cos(x*(θ2 + 90))"], (x("x") * (q(2) + n(90))).cos());
    let SyntaxKind::Call(Function::Cos, sum) = read("cos(θ2 ± 90)", &v).kind else { panic!() };
    let SyntaxKind::Sum(terms) = &sum[0].kind else { panic!() };
    assert_eq!((terms[1].0, &terms[1].1.kind), (Sign::PlusMinus, &SyntaxKind::Name(right)));
    let variants = read("cos(θ2 ± (60 ± 30))", &v).variants();
    let values: Vec<Expr> = variants.iter().map(Syntax::value).collect();
    let turned = |k: i64| (q(2) + Expr::pi() * n(k) / n(6)).cos();
    assert_eq!(values, [turned(3), turned(1), turned(-3), turned(-1)]);
}

#[test]
fn signs_of_two_values() {
    let v = robot();
    let values = |text: &str| read(text, &v).variants().iter().map(Syntax::value).collect::<Vec<_>>();
    let (b, x, y) = (x("b"), x("x"), x("y"));
    assert_eq!(values("b"), [b]);
    for text in ["±b", r"\pm b", "(±b)", "+0 ± b"] {
        assert_eq!(values(text), [b, -b], "{text}");
    }
    assert_eq!(values("∓b"), [-b, b]);
    assert_eq!(values("x ± b ∓ y"), [x + b - y, x - b + y]);
    assert_eq!(values(r"x \pm b \mp y"), [x + b - y, x - b + y]);
    assert_eq!(values("x ± b ± y"), [x + b + y, x + b - y, x - b + y, x - b - y]);
    assert_eq!(values("(x ± b)(x ∓ b)"), [(x + b) * (x - b), (x - b) * (x + b)]);
    assert_eq!(
        values(r"\frac{-b ± \sqrt{b^2 - x}}{2}"),
        [1, -1].map(|k| (-b + n(k) * (b.powi(2) - x).sqrt()) / n(2))
    );
    assert_eq!(values("cos(±arccos(x))"), [1, -1].map(|k| (n(k) * (n(1) - x.powi(2)).sqrt().atan2(x)).cos()));
    assert_eq!(read("x ∓ b", &v).value(), x - b);
    assert_eq!(read("x ± b ∓ y", &v).sign_choices(), 1);

    assert_eq!(values(&"±b".repeat(MAX_SIGN_CHOICES)).len(), 64);
    check_error(&"±b".repeat(MAX_SIGN_CHOICES + 1), "more than 6 signs of two values");
    check_error("b*±x", "unexpected `±`");
    check_error("1/(1 ± 1)", "division by zero");
    check_error("sqrt(1 ± 2)", "the root of a negative number");
    check_error("((10^1000 ∓ 10^1000)^1000)^1000", "the numbers become too large");
    for (text, place) in [("x ± b", 2..4), ("±b", 0..2), ("cos(θ1 \\mp θ2)", 8..11)] {
        let sign = &text[place.clone()];
        let e = parse(text, &v).unwrap_err().remove(0);
        assert_eq!((e.message, e.span), (format!("`{sign}` stands for two formulas"), place));
    }
    assert!(parse_definition("y = ±b", &v).is_err());
}

#[test]
fn degrees_that_depend_on_a_sign_are_refused() {
    let errors = parse_syntax("cos((x ± x + 2)*(θ2 + 90))", &robot().degrees(true)).unwrap_err();
    assert_eq!(errors[0].hint.as_deref(), Some("write one formula for each"));
}

#[test]
fn inverse_functions() {
    let v = robot();
    let (y, x) = (x("Y"), x("X"));
    let quotient = y / x;
    check_value(
        &v,
        &[
            "arctan(Y/X)",
            "atan(Y/X)",
            r"\arctan\frac{Y}{X}",
            r"\arctan \left(\frac{Y}{X}\right)",
            r"\tan^{-1} \left(\frac{Y}{X}\right)",
            r"\tan^{-1}\frac{Y}{X}",
            "tan⁻¹(Y/X)",
            r"\operatorname{arctan}\left[\frac{Y}{X}\right]",
        ],
        quotient.atan2(n(1)),
    );
    let root = (n(1) - x.powi(2)).sqrt();
    check_value(&v, &["arccos(X)", "acos(X)", r"\arccos{X}", "cos^{-1}(X)", "cos⁻¹(X)"], root.atan2(x));
    check_value(&v, &["arcsin(X)", "asin(X)", r"\arcsin(X)", r"\sin^{-1}(X)"], x.atan2(root));
    check_value(
        &v,
        &[r"\arcsin \frac{Y}{\sqrt{X}}"],
        (y / x.sqrt()).atan2((n(1) - (y / x.sqrt()).powi(2)).sqrt()),
    );
    check_value(&v, &[r"\arccos \sqrt{X}", r"arccos√X"], (n(1) - x.sqrt().powi(2)).sqrt().atan2(x.sqrt()));
    check_value(
        &v,
        &[
            "atan2(Y, X)",
            "ATAN2(Y, X)",
            "arctan2(Y,X)",
            r"\operatorname{atan2}(Y, X)",
            r"\text{atan2}\left(Y, X\right)",
            r"\arctan2(Y, X)",
        ],
        y.atan2(x),
    );
    check_value(&v, &["tan(θ1)", "tanθ1", r"\tan\theta_1", "tan θ1"], q(1).sin() / q(1).cos());
    check_value(&v, &[r"\sin\frac{\theta_1}{2}", "sin(θ1/2)"], (q(1) / n(2)).sin());
    check_value(&v, &["arccos(0)", "asin(1)"], n(1).atan2(n(0)));
    check_value(&v, &["arctan^2(X)", "(arctan(X))^2"], x.atan2(n(1)).powi(2));
    check_value(&v, &["2Xarccos(X)"], n(2) * x * root.atan2(x));
    // The arcs that are written out take what follows them, as sines do.
    check_value(&v, &[r"\arctan\theta_1", "arctan θ1"], q(1).atan2(n(1)));
    // `parse` reads the same, but for the power with two readings.
    assert_eq!(parse(r"\arctan\frac{Y}{X}", &v), Ok(quotient.atan2(n(1))));
    assert_eq!(
        parse("tan^{-1}(X)", &v).unwrap_err()[0].to_string(),
        "a negative power of a function has two readings; write `1/tan(…)`, or `arctan(…)` for the inverse function"
    );
    check_error("arccos(2)", "no real angle has this sine or cosine");
    check_error("tan(90 deg)", "the value is not a finite number");
    check_error("arctan(Y, X)", "unexpected `,`; a decimal point is `.`");
    check_error(
        r"\arctan\frac{Y}{X}^2",
        "a power behind an argument without brackets; write `arctan(…)^2` or `arctan((…)^2)`",
    );
    check_error("arctan^{-1}(X)", "a negative power of a function has two readings; write `1/arctan(…)`");
    check_error(&format!("{}X{}", "tan(".repeat(30), ")".repeat(30)), "the formula becomes too large");
    for unclear in [r"\arctan\theta_1^2", r"\arctan\theta_1\theta_2", "arctan θ1 X"] {
        check_error(
            unclear,
            "it is not clear where the argument ends; `arctan` takes its argument in brackets",
        );
    }
    assert!(parse_syntax("arctan θ", &Vocabulary::new().open(true)).is_ok());
    let a = robot().symbol("a");
    assert_eq!(
        parse("acos(θ1)", &a).unwrap_err()[0].to_string(),
        "`acos` reads as `acos` or as `a*cos`; write `arccos` for the inverse function, or `*` between the factors"
    );
    check_value(&a, &["a cos(θ1)", r"a\cos\theta_1"], Expr::symbol("a") * q(1).cos());
}

#[test]
fn marks_of_the_layout_are_blanks() {
    let v = robot();
    let sum = x("b") + x("x");
    check_value(
        &v,
        &[
            r"b & + x",
            r"b \\ & + x",
            r"& b + \\ & x",
            r"b +& x \\",
            r"b\;+\!x",
            r"b \quad +\ x",
            r"\left. b + x \right.",
            r"\left.b + x\right.",
            r"b \\ + x",
        ],
        sum,
    );
    check_error("b & x", "unexpected character `&`");
    check_error(r"b \\ x", r"unknown command `\\`");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, rng_seed: proptest::test_runner::RngSeed::Fixed(11), ..ProptestConfig::default() })]

    /// What the parser reads has a printed form of the same value; each choice of signs is a formula of its own.
    #[test]
    fn the_value_is_that_of_the_parser(text in "(C1|S23|cos\\(|sin\\(|tan\\(|arccos\\(|θ_2|\\\\theta_{3}|\\\\frac\\{|\\}\\{|√|sqrt\\(|atan2\\(|a_2|\\\\mathit\\{R\\}_\\{2\\}|b|x|[()()+*/^, −²9±∓0-3]|\\+| deg| rad|\\}|\\)){0,14}") {
        for names in vocabularies() {
            let (value, syntax) = (parse(&text, &names), parse_syntax(&text, &names));
            if let Ok(value) = value {
                prop_assert!(syntax.as_ref().is_ok_and(|s| s.value() == value), "{text:?}: {syntax:?}");
            }
            let Ok(syntax) = syntax else { continue };
            prop_assert!(has_places(&syntax, &text), "{text:?}: {syntax:?}");
            let variants = syntax.variants();
            prop_assert_eq!(variants.len(), 1 << syntax.sign_choices());
            prop_assert!(variants[0].value() == syntax.value());
            if let Some(at) = text.find(['±', '∓']) && syntax.sign_choices() == 1 && !text[at + 2..].contains('∓') {
                let chosen = |upper: &str, lower: &str| parse(&text.replace('±', upper).replace('∓', lower), &names);
                prop_assert_eq!([variants[0].value(), variants[1].value()].map(Ok), [chosen("+", "-"), chosen("-", "+")]);
            }
        }
    }

    /// Whatever comes in, an answer comes out, and the places of errors are places of the text.
    #[test]
    fn no_text_is_too_odd(text in "(C|S|cos|sin|tan|arc|\\\\pm|\\\\arctan|\\^\\{-1\\}|±|∓|&|\\\\\\\\|\\\\left|\\\\right|θ|\\\\theta|\\\\frac|√|sqrt|atan2|[()\\[\\]{}^_+*/.,=` −²₂π°0-9a-dqRL]){0,40}", odd in ".{0,40}") {
        for names in vocabularies() {
            for text in [&text, &odd] {
                for e in parse_syntax(text, &names).err().into_iter().flatten() {
                    prop_assert!(text.get(e.span.clone()).is_some(), "{text:?}: {e:?}");
                }
            }
        }
    }
}

#[test]
fn hostile_texts_are_bounded() {
    let v = robot().degrees(true);
    let ok = |text: &str| parse_syntax(text, &v).is_ok();
    let nested = |open: &str, n: usize| format!("{}x{}", open.repeat(n), ")".repeat(n));
    assert!(ok(&nested("(", 100)) && ok(&nested("-(", 100)) && ok(&nested("cos(1+", 100)));
    assert!(ok(&nested("cos(9+b*", 100)) && ok(&nested("±(", 6)));
    assert!(!ok(&nested("(", 101)));
    assert!(ok(&format!("x{}", "*b".repeat(2000))) && ok(&format!("{}x", "-".repeat(60_000))));
    assert!(ok(&format!("({})±x±x±x±x±x±x", "x+".repeat(1900) + "1")));
    assert!(!ok(&"±".repeat(20_000)) && !ok(&"±x".repeat(20_000)) && !ok(&"\\arctan\\frac".repeat(5_000)));
    assert!(!ok(&"/0".repeat(30_000)) && !ok(&format!("x±x{}", "/0".repeat(1_000))));
}
