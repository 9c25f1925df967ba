//! What is equal, what differs, under which conditions, and what is not decided.

use denavit_symbolic::equality::Reason;
use denavit_symbolic::{Equality, Expr, Rational, Refusal, Ring, equal};

fn x(name: &str) -> Expr {
    Expr::symbol(name)
}

#[track_caller]
fn same(a: Expr, b: Expr) {
    assert!(equal(a, b).is_equal(), "{a:?} = {b:?}: {:?}", equal(a, b));
}

#[track_caller]
fn differ(a: Expr, b: Expr) {
    assert!(matches!(equal(a, b), Equality::Different { .. }), "{a:?} ≠ {b:?}: {:?}", equal(a, b));
}

fn deg(n: i64) -> Expr {
    Expr::from(Rational::new(n, 180)) * Expr::pi()
}

#[test]
fn angle_sums() {
    let (a, b, c) = (x("q1"), x("q2"), x("q3"));
    same((a + b).cos(), a.cos() * b.cos() - a.sin() * b.sin());
    same((a + b + c).sin(), (a + b).sin() * c.cos() + (a + b).cos() * c.sin());
    same((a - b).cos(), a.cos() * b.cos() + a.sin() * b.sin());
    same((a + a).sin(), Expr::int(2) * a.sin() * a.cos());
    same(a.sin() * a.sin(), (Expr::int(1) - (a + a).cos()) / Expr::int(2));
    same((a + deg(90)).cos(), -a.sin());
    assert_eq!((Expr::pi() - Expr::int(1)).sin(), Expr::int(1).sin());
    assert_eq!((Expr::int(1) - deg(90)).cos(), Expr::int(1).sin());
    same((a / Expr::int(2)).cos().powi(2), (Expr::int(1) + a.cos()) / Expr::int(2));
    differ((a + b).cos(), a.cos() * b.cos() + a.sin() * b.sin());
    differ(a.cos(), b.cos());
    differ(a.cos(), a);
}

#[test]
fn fixed_angles_are_exact() {
    let two = Expr::int(2);
    same(deg(45).cos(), two.sqrt() / two);
    same(deg(15).sin() * Expr::int(4), Expr::int(6).sqrt() - two.sqrt());
    same(deg(36).cos() - deg(72).cos(), Expr::from(Rational::new(1, 2)));
    same(deg(18).sin().powi(2) + deg(18).cos().powi(2), Expr::int(1));
    same((x("t") + deg(30)).sin(), (Expr::int(3).sqrt() * x("t").sin() + x("t").cos()) / two);
    same(deg(20).sin().powi(2) + deg(20).cos().powi(2), Expr::int(1));
    differ(deg(20).sin(), deg(21).sin());
    // true, but for a reason the ring does not know
    let product = deg(20).cos() * deg(40).cos() * deg(80).cos();
    assert_eq!(equal(product, Expr::from(Rational::new(1, 8))), Equality::Undecided(Reason::Dependent));
}

#[test]
fn quotients_record_their_conditions() {
    let (a, b) = (x("a"), x("b"));
    let verdict = equal((a * a - b * b) / (a - b), a + b);
    let Equality::Equal { conditions } = verdict else { panic!("{verdict:?}") };
    assert!(equal(conditions[0], a - b).is_equal() || equal(conditions[0], b - a).is_equal());
    differ(a / b, b / a);
    same(Expr::int(1) / (Expr::int(1) / a), a);
    assert_eq!(equal(a / (a - a), b), Equality::Undecided(Reason::Refused(Refusal::Undefined)));
    same(Expr::int(1) / Expr::int(2).sqrt(), Expr::int(2).sqrt() / Expr::int(2));
}

#[test]
fn roots_and_arctangents() {
    let (a, b, q) = (x("a"), x("b"), x("q"));
    let r = (a * a + b * b).sqrt();
    same(r * r, a * a + b * b);
    same(b.atan2(a).cos() * r, a);
    same((q + b.atan2(a)).sin() * r, q.sin() * a + q.cos() * b);
    same(Expr::int(12).sqrt(), Expr::int(2) * Expr::int(3).sqrt());
    same((a / b).sqrt().powi(2), a / b);
    differ(r, a + b);
    // √(a²) is |a|: neither equal to a, nor different where a > 0
    assert!(!equal((a * a).sqrt(), a).is_equal());
}

#[test]
fn large_expansions_are_refused_not_run() {
    let sum = (0..40).fold(Expr::int(0), |s, i| s + x(&format!("x{i}")));
    let tower = sum.powi(30);
    assert!(matches!(Ring::new(&[tower], &[]).normal(tower), Err(Refusal::TooLarge)));
    assert!(!equal(tower, tower + x("y")).is_equal());
}
