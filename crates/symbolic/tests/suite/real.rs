//! Real constants.

use denavit_symbolic::real::{Real, Values};
use denavit_symbolic::{Expr, Rational};

fn value(e: Expr) -> Real {
    Values::default().of(e).unwrap()
}

fn decimal(text: &str) -> Real {
    Rational::from_decimal(text).unwrap().into()
}

fn is_small(x: &Real, below: f64) -> bool {
    x.to_f64().abs() < below
}

/// Digits of the tables: π from Abramowitz and Stegun, table 1.1; sin 1, cos 1 and arctan ½ by mpmath 1.4.1 with 70 digits.
#[test]
fn sixty_digits_are_right() {
    let one = Expr::int(1);
    for (e, digits) in [
        (Expr::pi(), "3.14159265358979323846264338327950288419716939937510582097494459"),
        (one.sin(), "0.84147098480789650665250232163029899962256306079837106567275171"),
        (one.cos(), "0.540302305868139717400936607442976603732310420617922227670097255"),
        (one.atan2(Expr::int(2)), "0.463647609000806116214256231461214402028537054286120263810933089"),
        ((-one).atan2(Expr::int(-2)), "-2.6779450445889871222483871518182884821686323450889855571640115"),
    ] {
        assert!(is_small(&(value(e) - decimal(digits)), 1e-60), "{digits}");
    }
    let many_turns = Expr::int(1) + Expr::pi() * Expr::int(2000);
    assert!(is_small(&(value(many_turns.sin()) - value(one.sin())), 1e-60));
}

#[test]
fn multiples_of_a_twelfth_turn_are_exact() {
    for n in -24..=24 {
        let angle = Expr::pi() * Expr::from(Rational::new(n, 12));
        let (s, c) = angle.sin_cos();
        let (s, c) = (value(s), value(c));
        assert!(s.is_exact() && c.is_exact());
        let square = s.clone() * s.clone() + c.clone() * c.clone();
        assert!((square - Real::from(1)).is_zero());
        let found = s.angle(&c).eval(|_| None).unwrap();
        let turns = (angle.eval(|_| None).unwrap() - found) / std::f64::consts::TAU;
        assert!((turns - turns.round()).abs() < 1e-15 && found.abs() < 3.2, "{n}");
        // 1/x and √x² stay in the field.
        if !s.is_zero() {
            assert!((s.recip().unwrap() * s.clone() - Real::from(1)).is_zero());
        }
        let root = (s.clone() * s.clone()).sqrt().unwrap();
        assert!(root.is_exact() && (root - s.abs()).is_zero());
    }
}

#[test]
fn what_is_outside_of_the_field_is_rounded() {
    assert!(Real::from(98).sqrt().unwrap().is_exact());
    let five = Real::from(5).sqrt().unwrap();
    assert!(!five.is_exact() && is_small(&(five.clone() * five - Real::from(5)), 1e-70));
    assert!(Real::from(-1).sqrt().is_none() && Real::from(0).recip().is_none());
    assert!(Values::default().of(Expr::symbol("a") + Expr::int(1)).is_none());
}

#[test]
fn angles_come_back_as_they_were_written() {
    let degrees =
        |text: &str| Expr::from(Rational::from_decimal(text).unwrap()) / Expr::int(180) * Expr::pi();
    let radians = |text: &str| Expr::from(Rational::from_decimal(text).unwrap());
    for angle in [
        degrees("79.34995"),
        degrees("-11.25"),
        radians("0.3"),
        radians("-2.7"),
        radians("0.0427") - Expr::pi() / Expr::int(2),
    ] {
        let (s, c) = angle.sin_cos();
        let found = value(s).angle(&value(c));
        assert!(value(found - angle).is_zero());
    }
}

/// What is rounded is not exact again by way of a formula, nor is what is made of it.
#[test]
fn formulas_of_rounded_numbers_are_rounded() {
    let x = value(Expr::from(Rational::new(7, 10)).sin());
    let again = value(x.formula());
    assert!(!again.is_exact() && (again.clone() - x.clone()).is_zero());
    let product = value(x.formula() * Expr::from(Rational::new(3, 5)) + x.formula() * x.formula());
    assert!(!product.is_exact());
    let nothing = x.clone() - x;
    assert!(nothing.is_zero() && !nothing.is_exact());
    assert!(value(nothing.formula()).is_zero() && !value(nothing.formula()).is_exact());
    let half = value(Expr::from(Rational::new(1, 2)).sqrt());
    assert!(half.is_exact() && value(half.formula()).is_exact());
}

/// What rounding to 18 places leaves of 0 and of a quarter turn is not written; what is written as small as that stays.
#[test]
fn leftovers_of_rounding_are_not_written() {
    let small = || Expr::from(Rational::new(1, 1_000_000_000_000_000_000));
    let rounded = |x: Expr| {
        value(x + Expr::from(Rational::new(7, 10)).sin()) - value(Expr::from(Rational::new(7, 10)).sin())
    };
    assert_eq!(rounded(small()).settled().to_string(), "0");
    assert!((value(value(small()).settled()).to_f64() - 1e-18).abs() < 1e-30);
    let (s, c) = (rounded(small()), value(Expr::int(1)));
    assert_eq!(s.angle(&c).to_string(), "0");
    assert_eq!((-c.clone()).angle(&s).to_string(), "-pi/2");
    assert_eq!(s.angle(&-c).to_string(), "pi");
    let angle = rounded(Expr::from(Rational::new(1, 1_000_000))).angle(&value(Expr::int(1)));
    assert!(!angle.is_zero());
}
