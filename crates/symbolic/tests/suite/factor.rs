//! Products of sines, cosines and lengths, found again in their expansions.

use denavit_symbolic::factor::{Factored, Zero, factored, zero_in, zeros};
use denavit_symbolic::parse::parse;
use denavit_symbolic::print::{Style, print};
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Angle, Expr, Ring, Symbol, equal};

fn names() -> Vocabulary {
    let lengths = ["a", "b", "c", "D3", "RL4", "a2", "a3", "d4", "d5", "r3", "L", "dSE", "dEW"];
    (1..=7).fold(Vocabulary::new().symbols(lengths), |v, n| v.angle(n, Symbol::new(&format!("q{n}"))))
}

fn read(text: &str) -> Expr {
    parse(text, &names()).unwrap_or_else(|e| panic!("{text}: {e:?}"))
}

/// The plain sum of products of a formula, over single angles.
fn expanded(e: Expr) -> Expr {
    let single: Vec<Angle> = (1..=7).map(|n| Angle::of(Expr::symbol(&format!("q{n}")))).collect();
    let mut ring = Ring::with_basis(&single, &[e], &[]);
    let p = ring.polynomial(e).unwrap();
    ring.poly_expr(&p)
}

fn written(product: &Factored) -> String {
    print(product.to_expr(), &names(), Style::Ascii)
}

/// The product, found in the formula as it stands and in its expansion over single angles.
#[track_caller]
fn check(text: &str, expected: &str) {
    for formula in [read(text), expanded(read(text))] {
        let product = factored(formula, &[]).unwrap();
        assert!(equal(product.to_expr(), formula).is_equal(), "{text}");
        assert!(product.is_complete, "{text}");
        assert_eq!(written(&product), expected);
    }
}

/// As [`check`], for a product that is written as it should be.
#[track_caller]
fn unchanged(text: &str) {
    check(text, text);
}

#[test]
fn determinants() {
    // Expansions of the determinants in exact-algebra.md, section 4.
    check("D3*RL4*S5*C3*(D3*C2 - RL4*S23)", "D3*RL4*C3*S5*(D3*C2 - RL4*S23)");
    unchanged("a2*a3*S3*S5*(a2*C2 + a3*C23 + d5*S234)");
    unchanged("-a2*S5*(d4*C3 + a3*S3)*(a2*C2 + a3*C23 - d4*S23)");
    unchanged("-r3^2*S2*S5");
    unchanged("a2*a3*S3");
    check("a2*a3*(S23*C2 - C23*S2)", "a2*a3*S3");
    check("a2*C1*a3*S12 - a2*S1*a3*C12", "a2*a3*S2");
    check("(a2*C2 + a3*C23)*a3*C23 + (a2*S2 + a3*S23)*a3*S23 - a3^2", "a2*a3*C3");
}

#[test]
fn squares_and_halves() {
    unchanged("a2^2*S3^2");
    unchanged("S5^3*(a2*C2 + a3*C23)^2");
    unchanged("a*(1 + C4)");
    check("(1 + C4)^2*(1 - C4)", "S4^2*(1 + C4)");
    check("1 - S4^2 - C4^4", "C4^2*S4^2");
    check("1 - C23^2", "S23^2");
    // det JJᵀ of two links in a plane
    let (x1, x2, y1, y2) = ("(-a*S1 - b*S12)", "(-b*S12)", "(a*C1 + b*C12)", "(b*C12)");
    let gram = format!("({x1}^2 + {x2}^2)*({y1}^2 + {y2}^2) - ({x1}*{y1} + {x2}*{y2})^2");
    check(&gram, "a^2*b^2*S2^2");
}

#[test]
fn sums_times_sums() {
    unchanged("(a*C2 + b*C23)*(c*S2 + d4*S23)");
    unchanged("(a*C2 + b*C23)*(a*S2 + b*S23)");
    unchanged("(a*C2 + b*S2)*(b*C2 + a*S2)");
    unchanged("(a + C2*S3)*(b + C4*S5)");
    unchanged("(a + 2*C2)*(a + 3*C2)*(b + C2)");
    unchanged("(2 + C2)*(3 + C2)*(3 - 2*S2)");
    unchanged("(a^2 + b^2)*C23*S34");
    unchanged("S2*C3*S4*C5*S23*C34*S45");
    check("(a^4 - b^4)*S2", "(a + b)*(a - b)*(a^2 + b^2)*S2");
    check("3 - 4*S1^2", "-(1 + 2*C1)*(1 - 2*C1)");
    check("2*0.425*S3*(0.425*C2 + 0.392*C23 - 0.095*S234)", "0.00085*S3*(425*C2 + 392*C23 - 95*S234)");
    check("(a*C2 + b*S23)*(C2*sqrt(3) + S2)", "(sqrt(3)*C2 + S2)*(a*C2 + b*S23)");
}

#[test]
fn what_is_irreducible_stays_whole() {
    for text in [
        "a^2 + b^2 + 2*a*b*C2",
        "1 + a^2*S2 + b*C3",
        "a*C2 + b*C23 + c*S234",
        "1 + C2",
        "a^2 - 2*b^2",
        "a + C2*S3",
    ] {
        let product = factored(expanded(read(text)), &[]).unwrap();
        assert_eq!((product.factors.len(), product.factors[0].1), (1, 1), "{text}: {product}");
    }
    let nothing = factored(read("C2^2 + S2^2 - 1"), &[]).unwrap();
    assert!(nothing.constant.is_zero() && nothing.factors.is_empty());
    assert!(factored(read("a/b"), &[]).is_err());
}

#[test]
fn what_is_too_large_is_left_whole_and_said_to_be() {
    let root = (1..6).fold(Expr::int(1), |s, n| {
        let q = Expr::symbol(&format!("q{n}"));
        s + q.cos() * Expr::symbol(&format!("a{n}")) + q.sin()
    });
    let a = Expr::symbol("a1");
    for sum in [root.powi(4) + a, a.powi(60_000) + Expr::symbol("b").powi(60_000), a.powi(150) - Expr::int(1)]
    {
        let product = factored(a * sum, &[]).unwrap();
        assert!(!product.is_complete);
        assert_eq!(product.factors[0], (a, 1));
    }
}

#[derive(Clone, Copy)]
struct Random(u64);

impl Random {
    fn below(&mut self, n: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % n
    }
    fn length(&mut self) -> String {
        ["a", "b", "c", "a2", "a3", "d4"][self.below(6) as usize].into()
    }
    fn wave(&mut self) -> String {
        let sums = ["1", "2", "3", "4", "5", "12", "23", "34", "234", "45", "6"];
        format!("{}{}", ["C", "S"][self.below(2) as usize], sums[self.below(11) as usize])
    }
    fn factor(&mut self) -> String {
        match self.below(9) {
            0 => self.length(),
            1 | 2 => self.wave(),
            3 => format!("({}*{} + {}*{})", self.length(), self.wave(), self.length(), self.wave()),
            4 => format!(
                "({} - {}*{} + {}*{})",
                self.length(),
                self.length(),
                self.wave(),
                self.length(),
                self.wave()
            ),
            5 => format!("({}^2 + {}*{}*{} + 3)", self.length(), self.length(), self.wave(), self.wave()),
            6 => format!("(2*{} + {}*{})", self.length(), self.wave(), self.wave()),
            7 => format!("({} + 2*{} - 5)", self.length(), self.length()),
            _ => format!(
                "({}*{} + {}*{} - {}*{})",
                self.length(),
                self.wave(),
                self.length(),
                self.wave(),
                self.length(),
                self.wave()
            ),
        }
    }
}

#[test]
fn random_products_split() {
    let mut random = Random(2026);
    let mut split = 0;
    for case in 0..200 {
        let factors: Vec<String> = (0..2 + random.below(4)).map(|_| random.factor()).collect();
        let is_zero = |f: &String| equal(read(f), Expr::int(0)).is_equal();
        let factors: Vec<String> = factors.into_iter().filter(|f| !is_zero(f)).collect();
        let text = factors.join("*");
        let formula = if case % 2 == 0 { read(&text) } else { expanded(read(&text)) };
        let product = factored(formula, &[]).unwrap();
        assert!(equal(product.to_expr(), formula).is_equal(), "{text}");
        split += usize::from(product.factors.iter().map(|f| f.1 as usize).sum::<usize>() >= factors.len());
    }
    assert!(split >= 195, "{split} of 200");
}

#[test]
fn any_formula_is_the_product_of_its_factors() {
    let mut random = Random(7);
    for _ in 0..200 {
        let mut pool: Vec<Expr> = [
            "a",
            "b",
            "C2",
            "S23",
            "cos(q2/2)",
            "S3",
            "sin(q2 + pi/6)",
            "sqrt(2)",
            "cos(0.3)",
            "sqrt(a^2 + b^2)",
        ]
        .map(read)
        .into();
        for _ in 0..8 {
            let n = pool.len() as u64;
            let (x, y) = (pool[random.below(n) as usize], pool[random.below(n) as usize]);
            pool.push(match random.below(4) {
                0 => x * y,
                1 => x - y,
                2 => x + Expr::int(2) * y,
                _ => x * (y + Expr::int(1)),
            });
        }
        let formula = pool[pool.len() - 1];
        let product = factored(formula, &[]).unwrap();
        assert!(equal(product.to_expr(), formula).is_equal(), "{formula}");
        assert_eq!(product, factored(formula, &[]).unwrap(), "the same each time");
    }
}

fn cross(a: [Expr; 3], b: [Expr; 3]) -> [Expr; 3] {
    let term = |i: usize, j: usize| a[i] * b[j] - a[j] * b[i];
    [term(1, 2), term(2, 0), term(0, 1)]
}

/// The vector turned about z, or about y.
fn turned(q: &str, about_z: bool, v: [Expr; 3]) -> [Expr; 3] {
    let (c, s) = (Expr::symbol(q).cos(), Expr::symbol(q).sin());
    match about_z {
        true => [c * v[0] - s * v[1], s * v[0] + c * v[1], v[2]],
        false => [c * v[0] + s * v[2], v[1], c * v[2] - s * v[0]],
    }
}

#[test]
fn a_ball_a_hinge_and_a_ball_one_angle_fixed() {
    let unit = |i: usize| [0, 1, 2].map(|k| Expr::int(i64::from(k == i)));
    let (z, y) = (unit(2), unit(1));
    let first = |v| turned("q1", true, v);
    let second = |v| first(turned("q2", false, v));
    let third = |v| second(turned("q3", true, v));
    let upper = second(z.map(|x| x * Expr::symbol("dSE")));
    let fore = third(turned("q4", false, z.map(|x| x * Expr::symbol("dEW"))));
    let wrist = [0, 1, 2].map(|k| upper[k] + fore[k]);
    let columns = [cross(z, wrist), cross(first(y), wrist), cross(second(z), wrist), cross(third(y), fore)];
    for (fixed, expected) in [
        (0, "-dEW^2*dSE*C3*S4^2*S6"),
        (1, "-dEW^2*dSE*S2*S3*S4^2*S6"),
        (2, "dEW*dSE*S4*S6*(dEW*C2*C3*S4 + S2*(dSE + dEW*C4))"),
        (3, "0"),
    ] {
        let kept: Vec<[Expr; 3]> = (0..4).filter(|&k| k != fixed).map(|k| columns[k]).collect();
        let across = cross(kept[1], kept[2]);
        let det = (0..3).fold(Expr::int(0), |sum, k| sum + kept[0][k] * across[k]) * read("S6");
        assert_eq!(written(&factored(det, &[]).unwrap()), expected);
    }
}

#[test]
fn where_factors_are_zero() {
    let written = |e: Expr| print(e, &names(), Style::Ascii);
    for (text, expected) in [
        ("S5", "q5: 0, pi"),
        ("-2*C5", "q5: pi/2, -pi/2"),
        ("S23", "q2 + q3: 0, pi"),
        ("1 + C4", "q4: pi"),
        ("1 - C4", "q4: 0"),
        ("2 - 2*S4", "q4: pi/2"),
        ("1 + S4", "q4: -pi/2"),
        ("d4*C3 + a3*S3", "q3: atan2(-d4, a3) + kπ"),
        ("d4*C23 - a3*S23", "q2 + q3: atan2(d4, a3) + kπ"),
        ("a2*C2 + a3*C23 + d5*S234", "q2: atan2(a2 + a3*C3 + d5*S34, a3*S3 - d5*C34) + kπ"),
        ("dEW*C2*S4*C3 + S2*(dSE + dEW*C4)", "q2: atan2(-dEW*S4*C3, dSE + dEW*C4) + kπ"),
        ("cos(q2 + pi/6)", "q2 + pi/6: pi/2, -pi/2"),
        ("cos(q2/2)", "q2/2: pi/2, -pi/2"),
        ("C2 + cos(q2/2)", ""),
        ("a + C2", ""),
        ("a + b*C2 + c*S2", ""),
        ("C2 + C3", ""),
        ("a*C2", ""),
    ] {
        let found = zeros(read(text));
        let line = |zero: &Zero| {
            let values: Vec<String> = zero.values().into_iter().map(written).collect();
            let shown = match zero {
                Zero::Ratio { .. } => format!("{} + kπ", values[0]),
                _ => values.join(", "),
            };
            format!("{}: {shown}", written(zero.angle()))
        };
        assert_eq!(found.iter().map(line).collect::<Vec<_>>().join("; "), expected, "{text}");
        for zero in &found {
            let Some(symbol) = zero.angle().as_symbol() else { continue };
            for value in zero.values() {
                let there = read(text).substitute(|s| (s == symbol).then_some(value));
                assert!(equal(there, Expr::int(0)).is_equal(), "{text} at {value}");
            }
        }
    }
}

/// Multiples of one symbol are solved for it, all values within its own period.
#[test]
fn zeros_of_a_multiple() {
    let written = |e: Expr| print(e, &names(), Style::Ascii);
    for (text, expected) in [
        ("C5", "q5: pi/2, -pi/2"),
        ("sin(q3/2)", "q3: 0, 2*pi"),
        ("cos(q3/2)", "q3: pi, -pi"),
        ("sin(2*q5)", "q5: 0, pi/2, pi, -pi/2"),
        ("sin(2*q5 + pi/6)", "q5: -pi/12, 5*pi/12, 11*pi/12, -7*pi/12"),
        ("cos(2*q4/3)", "q4: 3*pi/4, -3*pi/4, -9*pi/4, 9*pi/4"),
        ("S23", "q2 + q3: 0, pi"),
        ("1 + cos(q3/2)", "q3: 2*pi"),
    ] {
        let found = zeros(read(text));
        let (unknown, values) = found[0].solved();
        let shown: Vec<String> = values.iter().map(|v| written(*v)).collect();
        assert_eq!(format!("{}: {}", written(unknown), shown.join(", ")), expected, "{text}");
        let Some(symbol) = unknown.as_symbol() else { continue };
        for value in values {
            let there = read(text).substitute(|s| (s == symbol).then_some(value));
            assert!(equal(there, Expr::int(0)).is_equal(), "{text} at {value}");
        }
    }
}

#[test]
fn zeros_of_an_angle_of_choice() {
    let (factor, q3, q23) = (read("a2*C2 + a3*C23 - d4*S23"), read("q3"), read("q2 + q3"));
    assert_eq!(zero_in(factor, q3), None, "it has a part without this angle");
    assert_eq!(zero_in(factor, q23), None, "C2 turns with the sum");
    assert_eq!(zero_in(read("S2*C3 + C2*S3"), q23), Some(Zero::Sine { angle: q23 }));
    assert_eq!(
        zero_in(read("S23"), q3),
        Some(Zero::Ratio { angle: q3, cosine: read("S2"), sine: read("C2") })
    );
}
