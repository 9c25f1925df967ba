//! Sines and cosines in and out: the same values as with angles.

use crate::support::{program, symbols};
use denavit_program::{Domain, Extended, PairReason, PairRefusal, Program};
use denavit_symbolic::{Expr, Rational, Symbol};
use proptest::prelude::*;

/// Values by name; `c_q` and `s_q` are the pair of the angle q.
fn eval(program: &Program, inputs: &[(&str, f64)]) -> Vec<Extended> {
    let named = |name: &str| inputs.iter().find(|i| i.0 == name).map(|i| Extended::from(i.1));
    let value = |s: Symbol| match &*s.name() {
        name if name.starts_with("c_") => named(&name[2..]).map(|x| x.sin_cos().1),
        name if name.starts_with("s_") => named(&name[2..]).map(|x| x.sin_cos().0),
        name => named(name),
    };
    program.eval(value).expect("all inputs are given")
}

fn names(list: &[Symbol]) -> String {
    list.iter().map(|s| s.name().to_string()).collect::<Vec<_>>().join(" ")
}

#[track_caller]
fn check(formulas: &[(&str, Expr)], angles: &[&str]) -> Program {
    let plain = program(&["p", "q", "r", "d"], &["a"], formulas);
    let pairs = plain.with_pairs(&symbols(angles)).unwrap_or_else(|r| panic!("{r}"));
    let inputs = [("p", 0.7), ("q", -2.1), ("r", 1.9), ("d", 0.35), ("a", 0.83)];
    for (i, (x, y)) in eval(&plain, &inputs).iter().zip(&eval(&pairs, &inputs)).enumerate() {
        let error = x.sub(y).to_f64().abs();
        assert!(error < 1e-27, "{}: {error:e}\n{pairs}", formulas[i].0);
    }
    pairs
}

#[test]
fn sums_are_expanded_and_shared() {
    let [p, q, r, d, a] = ["p", "q", "r", "d", "a"].map(Expr::symbol);
    let half = Expr::from(Rational::new(1, 2));
    let chain = check(
        &[("x", p.sin() + (p + q).cos() + (p + q + r).cos()), ("y", (p + q).sin() + (p + q + r).sin() * a)],
        &["p", "q", "r"],
    );
    // two additions of angles: four products and two sums each; one product with a, four sums
    let count = chain.count();
    assert_eq!((count.multiplications, count.additions, count.sincos), (9, 7, 0), "{chain}");
    assert_eq!(names(chain.variables()), "c_p s_p c_q s_q c_r s_r d");
    assert_eq!(names(chain.parameters()), "a");

    let one = |e: Expr| check(&[("f", e)], &["p", "q", "r"]);
    assert_eq!(one(p.sin()).count().cost(), 0);
    one((p - q).sin());
    one((q - p - r).cos() + (p + r - q).sin());
    one((p + a).sin() * (p + q + a).cos());
    assert_eq!(one((p + a).sin()).count().hoisted, 2);
    one((p - a).sin() + (a - p).cos() + (a - p - q).sin());
    one((p + d).cos() + (p + q + d).sin());
    one((Expr::int(2) * p).sin() + (Expr::int(3) * p + q).cos());
    one((Expr::int(37) * p - Expr::int(5) * q).sin());
    one((half * (p + p + q + q)).sin());
    one((p * half + p * half).cos());
    one(((p + q) / Expr::int(3) * Expr::int(6) + a * d).cos());
    one((p + q.sin()).sin());
    one((p + (q + r).sin().atan2(a)).cos());
    // an angle that cancels is no angle
    one((p + d) - p);
    // one of them only
    let some = check(&[("f", (p + q).sin() * q)], &["p"]);
    assert_eq!(some.count().sincos, 1);
    assert_eq!(names(some.variables()), "c_p s_p q r d");
}

/// Texts can hold offsets that formulas have moved out of the sine.
#[test]
fn quarter_turns_are_exact() {
    let text = "variables q\n%0 = input q\n%1 = pi\n%2 = number 1/2\n%3 = mul %1 %2\n%4 = sub %0 %3\n\
                %5 = sin %4\n%6 = add %0 %1\n%7 = cos %6\nresult x = %5\nresult y = %7\n";
    let plain = Program::from_text(text).expect("a program");
    let pairs = plain.with_pairs(plain.variables()).expect("sines only");
    let expected = "variables c_q s_q\nparameters\n%0 = input c_q\nresult x = -%0\nresult y = -%0\n";
    assert_eq!(pairs.to_text(), expected);
}

#[test]
fn names_avoid_those_that_are_there() {
    let [q, c] = ["q", "c_q"].map(Expr::symbol);
    let f = program(&["q", "c_q"], &["s_q"], &[("f", q.sin() * c)]);
    let pairs = f.with_pairs(&symbols(&["q", "q"])).expect("a sine only");
    assert_eq!(names(pairs.variables()), "c_q_2 s_q_2 c_q");
}

#[test]
fn other_uses_are_refused() {
    let [p, q, a] = ["p", "q", "a"].map(Expr::symbol);
    let half = Expr::from(Rational::new(1, 2));
    let refusal = |e: Expr| {
        let f = program(&["p", "q"], &["a"], &[("f", e)]);
        let refusal = f.with_pairs(&symbols(&["p", "q"])).expect_err("a refusal");
        // The operation that is named is one that there is.
        if let PairReason::Operation(n) | PairReason::Multiple(n) = refusal.reason {
            assert!((n as usize) < f.ops().len());
        }
        (refusal.variable.name().to_string(), refusal.reason)
    };
    let own = |name: &str, reason: PairReason| (name.to_string(), reason);
    assert_eq!(refusal(p), own("p", PairReason::Result("f".into())));
    assert_eq!(refusal(q + a), own("q", PairReason::Result("f".into())));
    // %0 q  %1 a  %2 product
    assert_eq!(refusal((q * a).sin()), own("q", PairReason::Operation(2)));
    assert_eq!(refusal(q.sqrt()), own("q", PairReason::Operation(1)));
    assert!(matches!(refusal(p * q), (_, PairReason::Operation(2))));
    assert!(matches!(refusal(a / q), (_, PairReason::Operation(2))));
    assert!(matches!(refusal(a.atan2(q)), (_, PairReason::Operation(2))));
    assert!(matches!(refusal((half * q + p).sin()), (name, PairReason::Multiple(_)) if name == "q"));
    assert!(matches!(refusal((Expr::int(1_000_000) * q).sin()), (_, PairReason::Multiple(_))));

    let f = program(&["p"], &["a"], &[("f", p.sin())]);
    let a = Symbol::new("a");
    let unknown = f.with_pairs(&[a]).expect_err("a parameter");
    assert_eq!(unknown, PairRefusal { variable: a, reason: PairReason::NotAVariable });
    assert_eq!(unknown.to_string(), "there is no variable `a`");
}

#[test]
fn results_become_pairs() {
    let [p, q, a] = ["p", "q", "a"].map(Expr::symbol);
    let formulas = [("t", p.atan2(q)), ("u", -(p.atan2(a))), ("v", p.atan2(q) + a), ("w", p * q)];
    let plain = program(&["p", "q"], &["a"], &formulas);
    let pairs = plain.results_as_pairs();
    let found: Vec<&str> = pairs.outputs().iter().map(|o| o.0.as_str()).collect();
    assert_eq!(found, ["c_t", "s_t", "c_u", "s_u", "v", "w"]);
    for (p, q) in [(0.3, 1.2), (0.3, -1.2), (-0.3, -1.2), (-0.3, 1.2), (0.0, -1.0)] {
        let inputs = [("p", p), ("q", q), ("a", -0.8)];
        let (angles, values) = (eval(&plain, &inputs), eval(&pairs, &inputs));
        for i in 0..2 {
            let (s, c) = angles[i].sin_cos();
            assert!(values[2 * i].sub(&c).to_f64().abs() < 1e-30);
            assert!(values[2 * i + 1].sub(&s).to_f64().abs() < 1e-30);
        }
        assert_eq!(values[4..], angles[2..]);
    }
}

proptest! {
    /// Sines of random sums of angles, a variable that stays, a parameter and multiples of π.
    #[test]
    fn random_sums(
        sums in proptest::collection::vec((-3..4_i64, -3..4_i64, -3..4_i64, -1..2_i64, -1..2_i64, -5..6_i64), 1..8),
        at in [-3.0..3.0_f64, -3.0..3.0, -3.0..3.0, -3.0..3.0, -3.0..3.0],
    ) {
        let [p, q, r, d, a] = ["p", "q", "r", "d", "a"].map(Expr::symbol);
        let angle = |(k, l, m, n, o, t): (i64, i64, i64, i64, i64, i64)| {
            let times = |n: i64, e: Expr| Expr::int(n) * e;
            let turn = Expr::pi() * Rational::new(t, 4).into();
            times(k, p) + times(l, q) + times(m, r) + times(n, d) + times(o, a) + turn
        };
        let of_sums: Vec<(String, Expr)> =
            sums.iter().enumerate().map(|(i, s)| (format!("f{i}"), angle(*s).sin() + angle(*s).cos() * a)).collect();
        let formulas: Vec<(&str, Expr)> = of_sums.iter().map(|(n, e)| (n.as_str(), *e)).collect();
        let plain = program(&["p", "q", "r", "d"], &["a"], &formulas);
        let pairs = plain.with_pairs(&symbols(&["p", "q", "r"])).expect("sines only");
        let inputs: Vec<(&str, f64)> = ["p", "q", "r", "d", "a"].into_iter().zip(at).collect();
        for (x, y) in eval(&plain, &inputs).iter().zip(&eval(&pairs, &inputs)) {
            prop_assert!(x.sub(y).to_f64().abs() < 1e-28, "{}", pairs);
        }
    }
}
