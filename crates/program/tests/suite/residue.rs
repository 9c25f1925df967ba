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
    // 2 is a square modulo the prime, 3 is none.
    assert_eq!(Residue::new(2).sqrt().mul(&Residue::new(2).sqrt()).get(), Some(2));
    assert_eq!(Residue::new(3).sqrt().get(), None);
    assert_eq!(half.div(&Residue::rational(&Rational::from(2))).sin_cos().0.get(), None);
    assert_eq!(Residue::new(1).div(&Residue::new(0)).get(), None);
    let big = Rational::new(i64::MAX, 1);
    let plain = Residue::new(i64::MAX as u64);
    assert_eq!(Residue::rational(&(&big * &big)).get(), plain.mul(&plain).get());
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
