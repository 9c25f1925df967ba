//! Greatest common divisors: of machine words, and of numbers of any length by Lehmer's method (Knuth, The Art of Computer
//! Programming, volume 2, 4.5.2, algorithm L): Euclid's steps are taken on the leading words, and many at once applied
//! to the numbers.

use num_bigint::BigUint;
use num_integer::Integer;
use num_traits::{ToPrimitive, Zero};

/// The greatest common divisor of numbers of two machine words; 0 has all divisors.
pub(crate) fn gcd(mut a: u128, mut b: u128) -> u128 {
    // Machine words are the rule; 128-bit remainders are slow.
    while b != 0 {
        if a <= u64::MAX.into() && b <= u64::MAX.into() {
            return u128::from((a as u64).gcd(&(b as u64)));
        }
        (a, b) = (b, a % b);
    }
    a
}

/// As [`gcd`], of any length.
pub(crate) fn gcd_of_long(a: &BigUint, b: &BigUint) -> BigUint {
    let (mut a, mut b) = if a < b { (b.clone(), a.clone()) } else { (a.clone(), b.clone()) };
    loop {
        if b.is_zero() {
            return a;
        }
        if let Some(short) = b.to_u128() {
            let rest = (&a % &b).to_u128();
            return gcd(short, rest.unwrap_or_default()).into();
        }
        let [[p, q], [r, s]] = leading_steps(&a, &b);
        (a, b) = if q == 0 {
            let rest = &a % &b;
            (b, rest)
        } else {
            (combined(&a, p, &b, q), combined(&a, r, &b, s))
        };
    }
}

/// As many of Euclid's steps from `a` ≥ `b` as their leading words determine: the rows give both numbers as combinations
/// of `a` and `b`, the signs within a row opposite.
fn leading_steps(a: &BigUint, b: &BigUint) -> [[i64; 2]; 2] {
    let beyond = a.bits() - LEADING;
    let leading = |n: &BigUint| (n >> beyond).to_i64().unwrap_or_default();
    let (mut x, mut y) = (leading(a), leading(b));
    let [mut above, mut below] = [[1_i64, 0], [0, 1]];
    // The quotient is certain where both ends of what the leading words leave open give the same.
    while y + below[0] != 0 && y + below[1] != 0 {
        let q = (x + above[0]) / (y + below[0]);
        if q != (x + above[1]) / (y + below[1]) {
            break;
        }
        (above, below) = (below, [above[0] - q * below[0], above[1] - q * below[1]]);
        (x, y) = (y, x - q * y);
    }
    [above, below]
}

/// The bits of leading words; sums of two stay within a word.
const LEADING: u64 = 62;

/// `p a + q b`, of which one is not positive, and the sum is not negative; `q` is not 0.
fn combined(a: &BigUint, p: i64, b: &BigUint, q: i64) -> BigUint {
    let (a, b) = (a * p.unsigned_abs(), b * q.unsigned_abs());
    if q < 0 { a - b } else { b - a }
}

#[cfg(test)]
mod tests {
    use super::gcd_of_long;
    use num_bigint::BigUint;
    use num_integer::Integer;

    #[test]
    fn divisors_of_long_numbers() {
        let mut state = 1_u64;
        let mut word = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 32) as u32
        };
        let mut number = |words: u32| BigUint::new((0..words).map(|_| word()).collect());
        for k in 0..600 {
            let common = number(k % 7);
            let (a, b) = (&common * number(k % 31), &common * number(k % 13));
            assert_eq!(gcd_of_long(&a, &b), a.gcd(&b), "{a} {b}");
            // Neighbours and powers: quotients of 1, and very long ones.
            let (a, b) = (&a + 1_u32, BigUint::from(10_u32).pow(k % 90));
            assert_eq!(gcd_of_long(&a, &b), a.gcd(&b), "{a} {b}");
            assert_eq!(gcd_of_long(&(&a + &b), &b), a.gcd(&b), "{a} {b}");
        }
        let (mut a, mut b) = (BigUint::from(1_u32), BigUint::from(1_u32));
        for _ in 0..1_000 {
            (a, b) = (&a + &b, a);
            assert_eq!(gcd_of_long(&a, &b), 1_u32.into());
        }
    }
}
