//! The two fields that factors are sought over: Gaussian rationals, and Gaussian integers modulo a prime.

use crate::rational::Rational;

/// Exact arithmetic with division.
pub(super) trait Field: Clone + PartialEq {
    /// 0
    fn zero() -> Self;
    /// An integer.
    fn int(n: i64) -> Self;
    /// The sum.
    fn plus(&self, o: &Self) -> Self;
    /// The difference.
    fn minus(&self, o: &Self) -> Self;
    /// The product.
    fn times(&self, o: &Self) -> Self;
    /// `1 / self`, or `None` for 0.
    fn inverse(&self) -> Option<Self>;
    /// True for 0.
    fn is_zero(&self) -> bool {
        *self == Self::zero()
    }
    /// 1
    fn one() -> Self {
        Self::int(1)
    }
    /// What an operation with it costs, in operations with short numbers.
    fn cost(&self) -> usize {
        1
    }
    /// A small power.
    fn power(&self, n: u16) -> Self {
        (0..n).fold(Self::one(), |x, _| x.times(self))
    }
}

/// `re + im·i` with rational parts.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Gauss {
    /// The real part.
    pub re: Rational,
    /// The imaginary part.
    pub im: Rational,
}

impl Gauss {
    /// A real number.
    pub fn real(re: Rational) -> Self {
        Gauss { re, im: Rational::ZERO }
    }

    /// i
    pub fn i() -> Self {
        Gauss { re: Rational::ZERO, im: Rational::ONE }
    }

    /// The complex conjugate.
    pub fn conjugate(&self) -> Self {
        Gauss { re: self.re.clone(), im: -&self.im }
    }

    /// An exact square root, if there is one among the Gaussian rationals.
    pub fn sqrt(&self) -> Option<Self> {
        let half = Rational::new(1, 2);
        let length = (&(&self.re * &self.re) + &(&self.im * &self.im)).sqrt()?;
        let re = (&(&length + &self.re) * &half).sqrt()?;
        let im = (&(&length - &self.re) * &half).sqrt()?;
        Some(Gauss { re, im: if self.im.is_negative() { -im } else { im } })
    }
}

impl Field for Gauss {
    fn zero() -> Self {
        Gauss::real(Rational::ZERO)
    }
    fn cost(&self) -> usize {
        // A fraction is shortened after each operation: in the square of its length.
        let words = self.re.bits().max(self.im.bits()) / 64;
        let words = usize::try_from(words).unwrap_or(usize::MAX);
        words.saturating_mul(words).max(1)
    }
    fn int(n: i64) -> Self {
        Gauss::real(n.into())
    }
    fn plus(&self, o: &Self) -> Self {
        Gauss { re: &self.re + &o.re, im: &self.im + &o.im }
    }
    fn minus(&self, o: &Self) -> Self {
        Gauss { re: &self.re - &o.re, im: &self.im - &o.im }
    }
    fn times(&self, o: &Self) -> Self {
        match (self.im.is_zero(), o.im.is_zero()) {
            (true, true) => Gauss::real(&self.re * &o.re),
            (true, false) => Gauss { re: &self.re * &o.re, im: &self.re * &o.im },
            (false, true) => Gauss { re: &self.re * &o.re, im: &self.im * &o.re },
            (false, false) => Gauss {
                re: &(&self.re * &o.re) - &(&self.im * &o.im),
                im: &(&self.re * &o.im) + &(&self.im * &o.re),
            },
        }
    }
    fn inverse(&self) -> Option<Self> {
        let norm = &(&self.re * &self.re) + &(&self.im * &self.im);
        let scale = norm.recip()?;
        Some(Gauss { re: &self.re * &scale, im: -(&self.im * &scale) })
    }
    fn is_zero(&self) -> bool {
        self.re.is_zero() && self.im.is_zero()
    }
}

/// The prime 2¹²⁷ − 1, which is 3 modulo 4, so that −1 has no root modulo it and i is adjoined.
const P: u128 = (1 << 127) - 1;

/// `re + im·i` modulo the prime: a field with P² elements.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Residue {
    re: u128,
    im: u128,
}

fn add(a: u128, b: u128) -> u128 {
    let sum = a + b; // both below 2¹²⁷
    if sum >= P { sum - P } else { sum }
}

fn subtract(a: u128, b: u128) -> u128 {
    if a >= b { a - b } else { a + P - b }
}

fn fold(x: u128) -> u128 {
    let sum = (x & P) + (x >> 127);
    if sum >= P { sum - P } else { sum }
}

/// The product modulo 2¹²⁷ − 1, by halves of 64 bits.
fn multiply(a: u128, b: u128) -> u128 {
    const LOW: u128 = u64::MAX as u128;
    let (a1, a0, b1, b0) = (a >> 64, a & LOW, b >> 64, b & LOW);
    let middle = a0 * b1 + a1 * b0;
    // 2¹²⁸ = 2, and the middle's bits from 63 on carry 2¹²⁷ = 1.
    let high = fold(2 * (a1 * b1));
    let carried = add(fold(middle >> 63), fold((middle & (LOW >> 1)) << 64));
    add(add(high, carried), fold(a0 * b0))
}

fn invert(a: u128) -> u128 {
    // a^(P−2); P − 2 = 2¹²⁷ − 3 has all bits set but the second.
    let (mut result, mut base, mut n) = (1, a, P - 2);
    while n > 0 {
        if n & 1 == 1 {
            result = multiply(result, base);
        }
        base = multiply(base, base);
        n >>= 1;
    }
    result
}

fn residue(r: &Rational) -> Option<u128> {
    let of_text = |digits: &str| {
        digits.bytes().fold(0, |x, digit| add(multiply(x, 10), u128::from(digit.saturating_sub(b'0'))))
    };
    let (n, d) = match r.to_parts() {
        Some((n, d)) => (u128::from(n.unsigned_abs()), u128::from(d.unsigned_abs())),
        None => {
            let (n, d) = r.digits();
            (of_text(&n), of_text(&d))
        }
    };
    if d == 0 {
        return None;
    }
    let size = if d == 1 { n } else { multiply(n, invert(d)) };
    Some(if r.is_negative() { subtract(0, size) } else { size })
}

/// The integer of least magnitude with a residue.
fn symmetric(x: u128) -> i128 {
    if x > P / 2 { -((P - x) as i128) } else { x as i128 }
}

/// Integers below this size are taken for what they look like; a random residue seldom is so small.
const PLAUSIBLE: u128 = 1 << 112;

impl Residue {
    /// The residue of a number; `None` if the prime divides its denominator.
    pub fn of(g: &Gauss) -> Option<Self> {
        Some(Residue { re: residue(&g.re)?, im: residue(&g.im)? })
    }

    /// A pseudo-random element.
    pub fn random(state: &mut u64) -> Self {
        let mut word = || {
            *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            u128::from(*state >> 32)
        };
        let mut part = || fold(word() | word() << 32 | word() << 64 | word() << 96);
        Residue { re: part(), im: part() }
    }

    /// The Gaussian integer of least size with this residue.
    pub fn lifted(&self) -> Gauss {
        let integer = |x| Rational::from_integer(symmetric(x));
        Gauss { re: integer(self.re), im: integer(self.im) }
    }

    /// True if the lifted integer is far smaller than a random residue would be.
    pub fn is_plausible(&self) -> bool {
        symmetric(self.re).unsigned_abs() < PLAUSIBLE && symmetric(self.im).unsigned_abs() < PLAUSIBLE
    }
}

impl Field for Residue {
    fn zero() -> Self {
        Residue { re: 0, im: 0 }
    }
    fn int(n: i64) -> Self {
        let size = u128::from(n.unsigned_abs());
        Residue { re: if n < 0 { P - size } else { size }, im: 0 }
    }
    fn plus(&self, o: &Self) -> Self {
        Residue { re: add(self.re, o.re), im: add(self.im, o.im) }
    }
    fn minus(&self, o: &Self) -> Self {
        Residue { re: subtract(self.re, o.re), im: subtract(self.im, o.im) }
    }
    fn times(&self, o: &Self) -> Self {
        Residue {
            re: subtract(multiply(self.re, o.re), multiply(self.im, o.im)),
            im: add(multiply(self.re, o.im), multiply(self.im, o.re)),
        }
    }
    fn inverse(&self) -> Option<Self> {
        if self.is_zero() {
            return None;
        }
        let scale = invert(add(multiply(self.re, self.re), multiply(self.im, self.im)));
        Some(Residue { re: multiply(self.re, scale), im: multiply(subtract(0, self.im), scale) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn residues_invert_and_lift() {
        let mut state = 1;
        for _ in 0..100 {
            let x = Residue::random(&mut state);
            assert!(x.times(&x.inverse().unwrap()) == Residue::one());
        }
        let g = Gauss { re: Rational::from(-12), im: Rational::from(i64::MAX) };
        let r = Residue::of(&g).unwrap();
        assert_eq!(r.lifted(), g);
        assert_eq!(r.times(&r).lifted(), g.times(&g), "126 bits");
        let third = Residue::of(&Gauss::real(Rational::new(-1, 3))).unwrap();
        assert_eq!(third.times(&Residue::int(-3)), Residue::one());
    }

    #[test]
    fn square_roots_of_gaussian_numbers() {
        let g = Gauss { re: Rational::from(-3), im: Rational::from(4) };
        let root = g.sqrt().unwrap();
        assert_eq!(root.times(&root), g);
        assert_eq!(Gauss::i().sqrt(), None);
        assert_eq!(Gauss::int(-4).sqrt().unwrap().times(&Gauss::int(1)), Gauss::i().times(&Gauss::int(2)));
    }
}
