//! The canonical form against numbers, and against itself: what is called equal is, at every point tried.

use denavit_symbolic::readable::simplify;
use denavit_symbolic::{Equality, Expr, Rational, Refusal, Ring, Symbol, equal};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

/// A recipe for an expression; expressions themselves belong to a thread.
#[derive(Clone, Debug)]
enum Recipe {
    Number(i64, i64),
    Length(u8),
    Trig(bool, Vec<(u8, i8)>, i8),
    Add(Box<Recipe>, Box<Recipe>),
    Sub(Box<Recipe>, Box<Recipe>),
    Mul(Box<Recipe>, Box<Recipe>),
    Div(Box<Recipe>, Box<Recipe>),
    Square(Box<Recipe>),
    Root(Box<Recipe>),
}

impl Recipe {
    fn build(&self) -> Expr {
        match self {
            Recipe::Number(n, d) => Rational::new(*n, *d).into(),
            Recipe::Length(i) => Expr::symbol(["a", "b", "d1"][usize::from(i % 3)]),
            Recipe::Trig(sine, terms, twelfths) => {
                let turn = Expr::from(Rational::new((*twelfths).into(), 12)) * Expr::pi();
                let angle = terms.iter().fold(turn, |sum, (i, k)| {
                    sum + Expr::int((*k).into()) * Expr::symbol(&format!("q{}", i % 3 + 1))
                });
                if *sine { angle.sin() } else { angle.cos() }
            }
            Recipe::Add(a, b) => a.build() + b.build(),
            Recipe::Sub(a, b) => a.build() - b.build(),
            Recipe::Mul(a, b) => a.build() * b.build(),
            Recipe::Div(a, b) => a.build() / b.build(),
            Recipe::Square(a) => a.build().powi(2),
            Recipe::Root(a) => a.build().powi(2).sqrt(),
        }
    }
}

fn recipes() -> impl Strategy<Value = Recipe> {
    let leaf = prop_oneof![
        (-4_i64..5, 1_i64..4).prop_map(|(n, d)| Recipe::Number(n, d)),
        any::<u8>().prop_map(Recipe::Length),
        (any::<bool>(), prop::collection::vec((any::<u8>(), -2_i8..3), 1..3), -12_i8..13)
            .prop_map(|(s, terms, turn)| Recipe::Trig(s, terms, turn)),
    ];
    leaf.prop_recursive(4, 24, 2, |inner| {
        let two = (inner.clone().prop_map(Box::new), inner.clone().prop_map(Box::new));
        prop_oneof![
            3 => two.clone().prop_map(|(a, b)| Recipe::Add(a, b)),
            3 => two.clone().prop_map(|(a, b)| Recipe::Sub(a, b)),
            4 => two.clone().prop_map(|(a, b)| Recipe::Mul(a, b)),
            1 => two.prop_map(|(a, b)| Recipe::Div(a, b)),
            1 => inner.clone().prop_map(|a| Recipe::Square(Box::new(a))),
            1 => inner.prop_map(|a| Recipe::Root(Box::new(a))),
        ]
    })
}

fn check(cases: u32, test: impl Fn(Recipe) -> Result<(), TestCaseError>) {
    let config = Config { cases, failure_persistence: None, ..Config::default() };
    let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &[7; 32]);
    TestRunner::new_with_rng(config, rng).run(&recipes(), test).unwrap();
}

/// Values of a, b, d1, q1, q2, q3 at the k-th point.
fn point(k: usize) -> impl Fn(Symbol) -> Option<f64> {
    move |s| {
        let names = ["a", "b", "d1", "q1", "q2", "q3"];
        let i = names.iter().position(|n| *n == &*s.name())?;
        Some(0.3 + 0.61 * i as f64 + 0.37 * (k * (i + 2)) as f64 % 2.9)
    }
}

/// Both values, unless rounding says nothing about them.
fn values(a: Expr, b: Expr, k: usize) -> Option<(f64, f64)> {
    let (x, y) = (a.eval(point(k)).ok()?, b.eval(point(k)).ok()?);
    (x.is_finite() && y.is_finite() && x.abs() < 1e6).then_some((x, y))
}

#[test]
fn the_readable_form_has_the_value_of_the_original() {
    check(400, |recipe| {
        let e = recipe.build();
        let form = match simplify(e, &[]) {
            Ok(form) => form,
            Err(Refusal::Undefined | Refusal::TooLarge) => return Ok(()),
            Err(why) => return Err(TestCaseError::fail(format!("{e}: {why}"))),
        };
        prop_assert!(equal(form.expr, e).is_equal(), "{} is not {}", form.expr, e);
        for k in 0..4 {
            if let Some((x, y)) = values(e, form.expr, k) {
                prop_assert!((x - y).abs() <= 1e-8 * (1.0 + x.abs()), "{e} = {x}, {} = {y}", form.expr);
            }
        }
        Ok(())
    });
}

#[test]
fn a_changed_formula_is_never_called_equal() {
    check(400, |recipe| {
        let e = recipe.build();
        for changed in [e + Expr::symbol("a"), e * Expr::symbol("q1").cos(), -e, e + Expr::int(1)] {
            let separated = (0..4)
                .any(|k| values(e, changed, k).is_some_and(|(x, y)| (x - y).abs() > 1e-6 * (1.0 + x.abs())));
            if separated {
                prop_assert!(!equal(e, changed).is_equal(), "{e} = {changed}");
            }
        }
        Ok(())
    });
}

#[test]
fn the_basis_of_angles_does_not_change_the_verdict() {
    check(300, |recipe| {
        let e = recipe.build();
        let q = |n: &str| Expr::symbol(n);
        let shifted = e.substitute(|s| (&*s.name() == "q2").then(|| q("q2") - q("q1")));
        let back = shifted.substitute(|s| (&*s.name() == "q2").then(|| q("q2") + q("q1")));
        match equal(back, e) {
            Equality::Equal { .. } => Ok(()),
            Equality::Undecided(_) => Ok(()), // a division by zero, or an expansion beyond the budget
            Equality::Different { .. } => Err(TestCaseError::fail(format!("{back} against {e}"))),
        }
    });
}

#[test]
fn complements_of_a_right_angle_are_one_constant() {
    let degrees = |n: i64| Expr::from(Rational::new(n, 180)) * Expr::pi();
    let q = Expr::symbol("q");
    assert_eq!(degrees(73).cos(), degrees(17).sin());
    // cos(q + 17°) = cos q cos 17° − sin q sin 17°, whichever way the sum was turned round
    let expanded = q.cos() * degrees(17).cos() - q.sin() * degrees(17).sin();
    assert!(equal((q - degrees(73)).sin(), -expanded).is_equal());
    assert!(equal((-q - degrees(17)).cos(), expanded).is_equal());
}

#[test]
fn refusals_are_typed() {
    let (a, q) = (Expr::symbol("a"), Expr::symbol("q"));
    let refusal = |e: Expr| Ring::new(&[e], &[]).normal(e).err();
    assert_eq!(refusal(a / (q.cos().powi(2) + q.sin().powi(2) - Expr::int(1))), Some(Refusal::Undefined));
    assert_eq!(refusal(Expr::int(-2).sqrt()), Some(Refusal::Undefined));
    assert_eq!(refusal((Expr::int(1000) * q).sin() + q.sin()), Some(Refusal::TooLarge));
    let foreign = Ring::new(&[q.sin()], &[]).normal((q / Expr::int(2)).sin()).err();
    assert_eq!(foreign, Some(Refusal::OutsideBasis));
}
