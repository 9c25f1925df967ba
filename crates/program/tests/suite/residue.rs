//! Integers modulo a prime.

use denavit_program::{Domain, Residue};
use denavit_symbolic::Rational;

#[test]
fn it_is_a_field_with_a_circle() {
    let third = Residue::rational(&Rational::new(-1, 3));
    assert_eq!(third.mul(&Residue::new(3)).add(&Residue::new(1)).get(), Some(0));
    let (a, b) = (Residue::input(7, 11), Residue::input(5, 123_456));
    let half = Residue::pi().div(&Residue::rational(&Rational::from(2)));
    let thrice = b.mul(&Residue::rational(&Rational::from(-3)));
    for angle in [a.clone(), a.add(&b), a.sub(&thrice), a.add(&half), half.sub(&b)] {
        let (s, c) = angle.sin_cos();
        assert_eq!(s.mul(&s).add(&c.mul(&c)).get(), Some(1));
    }
    assert_eq!(a.add(&half).sin_cos().0, a.sin_cos().1);
    // sin 3x = 3 sin x − 4 sin³ x
    let (s, _) = b.sin_cos();
    let cube = s.mul(&s).mul(&s);
    let wanted = Residue::new(3).mul(&s).sub(&Residue::new(4).mul(&cube));
    assert_eq!(thrice.neg().sin_cos().0.get(), wanted.get());
    assert_eq!(Residue::new(1).div(&Residue::new(0)).get(), None);
    let big = Rational::new(i64::MAX, 1);
    let plain = Residue::new(i64::MAX as u64);
    assert_eq!(Residue::rational(&(&big * &big)).get(), plain.mul(&plain).get());
}

/// What holds between constants holds between their values: roots of products, cosines that are roots, sums of angles.
#[test]
fn constants_keep_what_holds_between_them() {
    let number = |n: i64| Residue::rational(&Rational::from(n));
    let root = |n: i64| number(n).sqrt();
    let holds = |a: Residue, b: Residue| {
        assert!(a.get().is_some(), "a value");
        assert_eq!(a.get(), b.get());
    };
    for (a, b) in [(2, 3), (6, 10), (12, 75), (7, 21), (2, 18), (31, 37)] {
        holds(root(a).mul(&root(b)), root(a * b));
    }
    holds(Residue::rational(&Rational::new(3, 8)).sqrt(), root(6).div(&number(4)));
    holds(root(0), number(0));
    assert_eq!(number(-2).sqrt().get(), None);
    let degrees = |n: i64, d: i64| Residue::pi().mul(&Residue::rational(&Rational::new(n, 180 * d)));
    let (sin, cos) = (|x: Residue| x.sin_cos().0, |x: Residue| x.sin_cos().1);
    holds(cos(degrees(45, 1)), root(2).div(&number(2)));
    holds(sin(degrees(60, 1)), root(3).div(&number(2)));
    holds(cos(degrees(15, 1)).mul(&number(4)), root(6).add(&root(2)));
    holds(cos(degrees(36, 1)).mul(&number(4)), root(5).add(&number(1)));
    holds(sin(degrees(36, 1)).mul(&number(4)), number(10).sub(&number(2).mul(&root(5))).sqrt());
    for (degree, (s, c)) in [(90, (1, 0)), (180, (0, -1)), (-90, (-1, 0)), (360, (0, 1))] {
        holds(sin(degrees(degree, 1)), number(s));
        holds(cos(degrees(degree, 1)), number(c));
    }
    // 54.7356° thrice, and radians with it.
    let (part, radians) = (degrees(547_356, 10_000), Residue::rational(&Rational::new(-12_217, 10_000)));
    let both = part.add(&radians);
    let (s, c) = both.sin_cos();
    holds(s.mul(&s).add(&c.mul(&c)), number(1));
    holds(s, sin(part.clone()).mul(&cos(radians.clone())).add(&cos(part.clone()).mul(&sin(radians.clone()))));
    holds(sin(part.add(&part).add(&part)), sin(degrees(3 * 547_356, 10_000)));
    holds(sin(radians.add(&radians)), sin(radians.mul(&number(2))));
    let with_input = Residue::input(5, 77).add(&radians);
    holds(with_input.sub(&Residue::input(5, 77)).sin_cos().1, cos(radians));
    // A seventh of a turn has none.
    assert_eq!(sin(Residue::pi().mul(&Residue::rational(&Rational::new(2, 7)))).get(), None);
}

#[test]
fn ranks() {
    let rank = |rows: &[&[u64]]| {
        let rows: Vec<Vec<Residue>> =
            rows.iter().map(|r| r.iter().map(|&x| Residue::new(x)).collect()).collect();
        Residue::rank(&rows)
    };
    assert_eq!(rank(&[&[1, 2, 3], &[2, 4, 6], &[0, 0, 5]]), Some(2));
    assert_eq!(rank(&[&[0, 0], &[0, 0]]), Some(0));
    assert_eq!(rank(&[&[0, 1], &[1, 0], &[1, 1]]), Some(2));
    assert_eq!(Residue::rank(&[vec![Residue::new(1).div(&Residue::new(0))]]), None);
}
