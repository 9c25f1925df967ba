//! Exact rational numbers: two machine words while they fit, arbitrary precision behind; never wraps.

use super::divisor::{gcd, gcd_of_long};
use num_bigint::{BigInt, Sign};
use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive, Zero};
use std::cmp::Ordering;
use std::fmt;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A rational number in lowest terms with a positive denominator.
#[derive(Clone, PartialEq, Eq, Hash)]
pub struct Rational(Repr);

/// `Big` only holds what does not fit `Small`, so that equality of representations is equality of values.
#[derive(Clone, PartialEq, Eq, Hash)]
enum Repr {
    Small(i64, i64),
    Big(Box<(BigInt, BigInt)>),
}

/// The largest exponent of ten that a decimal may carry: 1e400 is a slip, not a length.
const MAX_DECIMAL_EXPONENT: i64 = 400;

/// Longer powers are not worked out: thousands of them in one product would take minutes.
const MAX_POWER_BITS: u64 = 4_096;

impl Rational {
    /// 0
    pub const ZERO: Rational = Rational(Repr::Small(0, 1));
    /// 1
    pub const ONE: Rational = Rational(Repr::Small(1, 1));

    /// `n / d`.
    ///
    /// # Panics
    /// If `d` is zero.
    pub fn new(n: i64, d: i64) -> Self {
        assert!(d != 0, "denominator is zero");
        Self::from_i128(n.into(), d.into())
    }

    /// An integer of two machine words.
    pub(crate) fn from_integer(n: i128) -> Self {
        Self::from_i128(n, 1)
    }

    fn from_i128(n: i128, d: i128) -> Self {
        debug_assert!(d != 0);
        if let (1, Ok(n)) = (d, i64::try_from(n)) {
            return Rational(Repr::Small(n, 1));
        }
        let g = gcd(n.unsigned_abs(), d.unsigned_abs()) as i128;
        let (n, d) = if d < 0 { (-(n / g), -(d / g)) } else { (n / g, d / g) };
        match (i64::try_from(n), i64::try_from(d)) {
            (Ok(n), Ok(d)) => Rational(Repr::Small(n, d)),
            _ => Rational(Repr::Big(Box::new((n.into(), d.into())))),
        }
    }

    fn from_big(n: BigInt, d: BigInt) -> Self {
        // Dividing out 1 takes the square of the length.
        let g = if d.is_one() { BigInt::one() } else { gcd_of_long(n.magnitude(), d.magnitude()).into() };
        let (n, d) = if d.is_negative() { (-n / &g, -d / &g) } else { (n / &g, d / &g) };
        match (n.to_i64(), d.to_i64()) {
            (Some(n), Some(d)) => Rational(Repr::Small(n, d)),
            _ => Rational(Repr::Big(Box::new((n, d)))),
        }
    }

    /// `n / d`, where `d` is not 0.
    pub(crate) fn from_parts(n: BigInt, d: BigInt) -> Self {
        Self::from_big(n, d)
    }

    /// Numerator and denominator in arbitrary precision.
    pub(crate) fn parts(&self) -> (BigInt, BigInt) {
        match &self.0 {
            Repr::Small(n, d) => ((*n).into(), (*d).into()),
            Repr::Big(b) => (b.0.clone(), b.1.clone()),
        }
    }

    /// The length of the longer of numerator and denominator; 64 for all that fit a machine word.
    pub fn bits(&self) -> u64 {
        match &self.0 {
            Repr::Small(..) => 64,
            Repr::Big(b) => b.0.bits().max(b.1.bits()),
        }
    }

    /// The number if it is an integer that fits a machine word.
    pub fn to_integer(&self) -> Option<i64> {
        match self.0 {
            Repr::Small(n, 1) => Some(n),
            _ => None,
        }
    }

    /// Numerator and denominator if both fit a machine word.
    pub fn to_parts(&self) -> Option<(i64, i64)> {
        match self.0 {
            Repr::Small(n, d) => Some((n, d)),
            Repr::Big(_) => None,
        }
    }

    /// Numerator as a decimal string, without sign, and denominator as one (for printing).
    pub fn digits(&self) -> (String, String) {
        let (n, d) = self.parts();
        (n.abs().to_string(), d.to_string())
    }

    /// True for an integer of any size.
    pub fn is_integer(&self) -> bool {
        match &self.0 {
            Repr::Small(_, d) => *d == 1,
            Repr::Big(b) => b.1.is_one(),
        }
    }

    /// True for 0.
    pub fn is_zero(&self) -> bool {
        matches!(self.0, Repr::Small(0, _))
    }

    /// True for 1.
    pub fn is_one(&self) -> bool {
        matches!(self.0, Repr::Small(1, 1))
    }

    /// True below 0.
    pub fn is_negative(&self) -> bool {
        match &self.0 {
            Repr::Small(n, _) => *n < 0,
            Repr::Big(b) => b.0.is_negative(),
        }
    }

    /// The absolute value.
    pub fn abs(&self) -> Self {
        if self.is_negative() { -self } else { self.clone() }
    }

    /// `1 / self`, or `None` for 0.
    pub fn recip(&self) -> Option<Self> {
        (!self.is_zero()).then(|| &Rational::ONE / self)
    }

    /// The largest integer not above the number.
    pub fn floor(&self) -> Self {
        let (n, d) = self.parts();
        Self::from_big(n.div_floor(&d), BigInt::one())
    }

    /// `self` to an integer power; `None` for a negative power of 0 or a result of more than 4096 bits.
    pub fn pow(&self, exponent: i32) -> Option<Self> {
        if exponent < 0 && self.is_zero() {
            return None;
        }
        let (n, d) = self.parts();
        let e = exponent.unsigned_abs();
        if n.bits().max(d.bits()).saturating_mul(u64::from(e)) > MAX_POWER_BITS {
            return None;
        }
        let (n, d) = (n.pow(e), d.pow(e));
        Some(if exponent < 0 { Self::from_big(d, n) } else { Self::from_big(n, d) })
    }

    /// The exact square root, if the number is the square of a rational.
    pub fn sqrt(&self) -> Option<Self> {
        let (n, d) = self.parts();
        if n.is_negative() {
            return None;
        }
        let (rn, rd) = (n.sqrt(), d.sqrt());
        (&rn * &rn == n && &rd * &rd == d).then(|| Self::from_big(rn, rd))
    }

    /// A decimal such as `-0.1519`, `3`, `.5`, `1e-3`, exactly. `None` if the text is anything else,
    /// or if its exponent is beyond ±400.
    pub fn from_decimal(text: &str) -> Option<Self> {
        let (mantissa, exponent) = match text.find(['e', 'E']) {
            Some(at) => (&text[..at], text[at + 1..].parse::<i64>().ok()?),
            None => (text, 0),
        };
        let (negative, mantissa) = match mantissa.strip_prefix('-') {
            Some(rest) => (true, rest),
            None => (false, mantissa.strip_prefix('+').unwrap_or(mantissa)),
        };
        let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let digits = [whole, fraction].concat();
        if digits.is_empty() || digits.len() > 4000 || !digits.bytes().all(|b| b.is_ascii_digit()) {
            return None;
        }
        if exponent.abs() > MAX_DECIMAL_EXPONENT {
            return None;
        }
        let mut n = BigInt::parse_bytes(digits.as_bytes(), 10)?;
        if negative {
            n = -n;
        }
        let shift = exponent - fraction.len() as i64;
        let ten = BigInt::from(10).pow(shift.unsigned_abs() as u32);
        Some(if shift < 0 { Self::from_big(n, ten) } else { Self::from_big(n * ten, BigInt::one()) })
    }

    /// The double with exactly this value, as a rational. `None` for NaN and infinities.
    pub fn from_f64(x: f64) -> Option<Self> {
        if !x.is_finite() {
            return None;
        }
        let bits = x.to_bits();
        let exponent = ((bits >> 52) & 0x7ff) as i64;
        let fraction = bits & ((1 << 52) - 1);
        let (m, e) = if exponent == 0 { (fraction, -1074) } else { (fraction | (1 << 52), exponent - 1075) };
        let m = BigInt::from_biguint(if x < 0.0 { Sign::Minus } else { Sign::Plus }, m.into());
        Some(if e >= 0 {
            Self::from_big(m << e, BigInt::one())
        } else {
            Self::from_big(m, BigInt::one() << -e)
        })
    }

    /// The nearest double.
    pub fn to_f64(&self) -> f64 {
        if let Repr::Small(n, d) = self.0
            && n.unsigned_abs() <= 1 << 53
            && d <= 1 << 53
        {
            return n as f64 / d as f64; // both exact, so the quotient is rounded once
        }
        let (n, d) = self.parts();
        let negative = n.is_negative();
        let n = n.abs();
        // A quotient of 66 or 67 bits whose last bit is sticky, rounded once to 53.
        let shift = 66 - (n.bits() as i64 - d.bits() as i64);
        let (n, d) = if shift >= 0 { (n << shift, d) } else { (n, d << -shift) };
        let (q, r) = n.div_rem(&d);
        let q = q.to_u128().unwrap_or(u128::MAX) | u128::from(!r.is_zero());
        let scaled = (q as f64) * 2f64.powi(-(shift / 2) as i32) * 2f64.powi(-(shift - shift / 2) as i32);
        if negative { -scaled } else { scaled }
    }
}

impl Default for Rational {
    fn default() -> Self {
        Self::ZERO
    }
}

impl From<i64> for Rational {
    fn from(n: i64) -> Self {
        Rational(Repr::Small(n, 1))
    }
}

impl Add for &Rational {
    type Output = Rational;
    fn add(self, o: &Rational) -> Rational {
        match (&self.0, &o.0) {
            (&Repr::Small(a, 1), &Repr::Small(b, 1)) => Rational::from_i128(a as i128 + b as i128, 1),
            (&Repr::Small(a, b), &Repr::Small(c, d)) => {
                let [a, b, c, d] = [a, b, c, d].map(i128::from);
                Rational::from_i128(a * d + c * b, b * d)
            }
            _ => {
                let ((a, b), (c, d)) = (self.parts(), o.parts());
                Rational::from_big(a * &d + c * &b, b * d)
            }
        }
    }
}

impl Mul for &Rational {
    type Output = Rational;
    fn mul(self, o: &Rational) -> Rational {
        match (&self.0, &o.0) {
            (&Repr::Small(a, 1), &Repr::Small(b, 1)) => Rational::from_i128(a as i128 * b as i128, 1),
            (&Repr::Small(a, b), &Repr::Small(c, d)) => {
                let [a, b, c, d] = [a, b, c, d].map(i128::from);
                Rational::from_i128(a * c, b * d)
            }
            (Repr::Small(1, 1), Repr::Big(_)) => o.clone(),
            (Repr::Big(_), Repr::Small(1, 1)) => self.clone(),
            (Repr::Small(-1, 1), Repr::Big(_)) => -o,
            (Repr::Big(_), Repr::Small(-1, 1)) => -self,
            _ => {
                let ((a, b), (c, d)) = (self.parts(), o.parts());
                Rational::from_big(a * c, b * d)
            }
        }
    }
}

impl Div for &Rational {
    type Output = Rational;
    /// # Panics
    /// If the divisor is zero.
    fn div(self, o: &Rational) -> Rational {
        assert!(!o.is_zero(), "division by zero");
        let ((a, b), (c, d)) = match (self.to_parts(), o.to_parts()) {
            (Some((a, b)), Some((c, d))) => {
                return Rational::from_i128(a as i128 * d as i128, b as i128 * c as i128);
            }
            _ => (self.parts(), o.parts()),
        };
        Rational::from_big(a * d, b * c)
    }
}

impl Neg for &Rational {
    type Output = Rational;
    fn neg(self) -> Rational {
        match &self.0 {
            Repr::Small(n, d) if *n != i64::MIN => Rational(Repr::Small(-n, *d)),
            Repr::Small(n, d) => Rational::from_i128(-(*n as i128), *d as i128),
            // The opposite of −2⁶³ is the one that changes its kind.
            Repr::Big(b) if b.0.bits() <= 64 => Rational::from_big(-&b.0, b.1.clone()),
            Repr::Big(b) => Rational(Repr::Big(Box::new((-&b.0, b.1.clone())))),
        }
    }
}

impl Sub for &Rational {
    type Output = Rational;
    fn sub(self, o: &Rational) -> Rational {
        self + &-o
    }
}

/// The owned forms, for code that reads better without borrows.
macro_rules! owned {
    ($($op:ident $name:ident),*) => {$(
        impl $op for Rational {
            type Output = Rational;
            fn $name(self, o: Rational) -> Rational {
                (&self).$name(&o)
            }
        }
    )*};
}
owned!(Add add, Sub sub, Mul mul, Div div);

impl Neg for Rational {
    type Output = Rational;
    fn neg(self) -> Rational {
        -&self
    }
}

impl Ord for Rational {
    fn cmp(&self, o: &Self) -> Ordering {
        match (&self.0, &o.0) {
            (&Repr::Small(a, b), &Repr::Small(c, d)) => (a as i128 * d as i128).cmp(&(c as i128 * b as i128)),
            _ => {
                let ((a, b), (c, d)) = (self.parts(), o.parts());
                (a * d).cmp(&(c * b))
            }
        }
    }
}

impl PartialOrd for Rational {
    fn partial_cmp(&self, o: &Self) -> Option<Ordering> {
        Some(self.cmp(o))
    }
}

impl fmt::Display for Rational {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (n, d) = self.parts();
        if d.is_one() { write!(f, "{n}") } else { write!(f, "{n}/{d}") }
    }
}

impl fmt::Debug for Rational {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn r(n: i64, d: i64) -> Rational {
        Rational::new(n, d)
    }

    #[test]
    fn arithmetic_is_exact_beyond_a_machine_word() {
        let big = r(i64::MAX, 1);
        let product = &big * &big;
        assert_eq!(product.to_string(), "85070591730234615847396907784232501249");
        assert_eq!(&product / &big, big);
        assert_eq!(&(&r(1, 3) + &r(1, 6)) - &r(1, 2), Rational::ZERO);
        assert_eq!(-r(i64::MIN, 1), &r(i64::MAX, 1) + &Rational::ONE);
    }

    #[test]
    fn decimals_are_read_exactly() {
        for (text, n, d) in
            [("0.1519", 1519, 10000), ("-3", -3, 1), (".5", 1, 2), ("1e-3", 1, 1000), ("2.5E2", 250, 1)]
        {
            assert_eq!(Rational::from_decimal(text), Some(r(n, d)), "{text}");
        }
        for text in ["", ".", "-", "1.2.3", "1e", "e5", "1e999", "0x10", "nan", "1 "] {
            assert_eq!(Rational::from_decimal(text), None, "{text}");
        }
    }

    #[test]
    fn doubles_round_once() {
        for x in [0.1, -std::f64::consts::FRAC_PI_2, 1e300, 5e-300, 3.0, 1.0 / 3.0] {
            assert_eq!(Rational::from_f64(x).unwrap().to_f64(), x);
        }
        assert_eq!(Rational::from_decimal("0.1").unwrap().to_f64(), 0.1);
        assert_eq!(
            Rational::from_decimal("179769313486231580793e-1").unwrap().to_f64(),
            17976931348623158079.3
        );
    }

    #[test]
    fn roots_and_powers() {
        assert_eq!(r(9, 4).sqrt(), Some(r(3, 2)));
        assert_eq!(r(2, 1).sqrt(), None);
        assert_eq!(r(-4, 1).sqrt(), None);
        assert_eq!(r(2, 3).pow(-2), Some(r(9, 4)));
        assert_eq!(Rational::ZERO.pow(-1), None);
        assert_eq!(r(2, 1).pow(i32::MAX), None);
    }
}
