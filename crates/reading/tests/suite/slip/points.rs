//! Values of formulas at random points modulo a prime.

use denavit_reading::slip::{K, Points, Value};
use denavit_symbolic::Expr;
use denavit_symbolic::rational::Rational;

/// A fraction of π.
fn turn(n: i64, d: i64) -> Expr {
    Expr::from(Rational::new(n, d)) * Expr::pi()
}

/// The value, at points where there is one.
#[track_caller]
fn value(e: Expr) -> Value {
    (1..2_000).find_map(|seed| Points::new(seed).value(e)).expect("some of the points have it")
}

/// Two formulas have the same values wherever both have some.
#[track_caller]
fn same(a: Expr, b: Expr) {
    let mut met = 0;
    for seed in 1..2_000 {
        let mut points = Points::new(seed);
        if let (Some(x), Some(y)) = (points.value(a), points.value(b)) {
            assert_eq!(x, y, "{a} = {b}");
            met += 1;
        }
    }
    assert!(met > 0, "{a} = {b} nowhere");
}

#[test]
fn identities_hold() {
    let x = Expr::symbol;
    let (a, b, q) = (x("a"), x("b"), x("q"));
    let two = Expr::int(2);
    same((a + b).cos(), a.cos() * b.cos() - a.sin() * b.sin());
    same((a / two).cos().powi(2), (Expr::int(1) + a.cos()) / two);
    same((a + turn(1, 2)).sin(), a.cos());
    same(turn(1, 12).sin() * Expr::int(4), Expr::int(6).sqrt() - two.sqrt());
    same((q + turn(1, 5)).cos(), q.cos() * turn(1, 5).cos() - q.sin() * turn(1, 5).sin());
    same(turn(3, 10).sin(), turn(1, 5).cos());
    same(turn(20, 180).cos() * turn(40, 180).cos() * turn(80, 180).cos(), Rational::new(1, 8).into());
    let r = (a * a + b * b).sqrt();
    same((q + b.atan2(a)).sin() * r, q.sin() * a + q.cos() * b);
    same((Expr::int(1) + q).sin(), Expr::int(1).sin() * q.cos() + Expr::int(1).cos() * q.sin());
}

#[test]
fn the_field_is_one() {
    let (a, b) = (Expr::symbol("a"), Expr::symbol("b"));
    same((a + b).powi(2) - a * b, a * a + a * b + b * b);
    same((a / b - b / a) * a * b, (a - b) * (a + b));
    same((a * a).sqrt() * (b * b).sqrt(), (a * a * (b * b)).sqrt());
    let (large, larger) = (1_234_567_890_123, 987_654_321_987);
    same(
        (a + Expr::int(large)) * Expr::int(larger),
        a * Expr::int(larger) + Expr::int(large) * Expr::int(larger),
    );
    same((a + Expr::from(Rational::new(-22, 7))) * Expr::int(7), a * Expr::int(7) - Expr::int(22));
}

#[test]
fn fixed_angles() {
    let q = Expr::symbol("q");
    let (two, four) = (Expr::int(2), Expr::int(4));
    let root = |n| Expr::int(n).sqrt();
    same((q + turn(1, 2)).cos(), -q.sin());
    same((q + turn(1, 1)).cos(), -q.cos());
    same((q + turn(1, 3)).cos() * two, q.cos() - root(3) * q.sin());
    same((q + turn(1, 4)).cos() * root(2), q.cos() - q.sin());
    same((q + turn(1, 6)).cos() * two, root(3) * q.cos() - q.sin());
    // cos 36° = (1 + √5)/4
    same(
        (q + turn(1, 5)).cos() * four,
        (root(5) + Expr::int(1)) * q.cos() - four * turn(1, 5).sin() * q.sin(),
    );
    for n in [2, 3, 5, 7, 11, 13] {
        assert!(Points::new(1).value(root(n)).is_some(), "√{n}");
    }
}

#[test]
fn an_angle_is_a_symbol_of_its_own_outside_of_a_sine() {
    let q = Expr::symbol("q");
    assert_ne!(value(q), value(q.sin()));
    assert_eq!(value(q - q), [0; K]);
    assert_eq!(Points::new(1).value(Expr::int(1) / (q * q - q * q)), None);
    assert_eq!(value(Expr::from(Rational::new(3, 7))), value(Expr::int(3) / Expr::int(7)));
}
