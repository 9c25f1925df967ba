//! Arithmetic modulo a 61-bit prime, at all points at once.
//!
//! The prime is −1 modulo N = 2⁶·3⁴·5⁵·7·11·13. The points of the circle c² + s² = 1 are then a cyclic group of p + 1
//! elements that holds the angles 2π/N, so that every multiple of a thousandth of a degree has its sine and cosine, and
//! every prime up to 13 its root. Numbers are kept in Montgomery's form: x·2⁶⁴ mod p.

/// The number of points at which formulas are compared.
pub const K: usize = 3;
/// The values of a formula at the points.
pub type Value = [u64; K];

/// The prime.
const P: u64 = 2_305_842_840_100_799_999;
/// −1/P modulo 2⁶⁴.
const NEGATIVE_INVERSE: u64 = 15_942_707_043_404_219_905;
/// 2⁶⁴ and 2¹²⁸ modulo P.
const R: u64 = 1_352_903_151_624;
const R2: u64 = 1_173_001_898_305_831_162;

pub(super) const ZERO: Value = [0; K];
pub(super) const ONE: Value = [R; K];

/// The number of steps of a whole turn.
pub(super) const TURN: i64 = 16_216_200_000;
/// A point of the circle that generates it; of the two roots of 2, 3, 5 and (sin 36°)² those that follow are squares.
const GENERATOR: u64 = 67;

/// A point of the circle: cosine and sine.
pub(super) type Point = (u64, u64);

pub(super) fn plus(a: u64, b: u64) -> u64 {
    let sum = a + b;
    if sum >= P { sum - P } else { sum }
}

pub(super) fn negative(a: u64) -> u64 {
    if a == 0 { 0 } else { P - a }
}

pub(super) fn minus(a: u64, b: u64) -> u64 {
    if a >= b { a - b } else { a + P - b }
}

pub(super) fn times(a: u64, b: u64) -> u64 {
    let t = u128::from(a) * u128::from(b);
    let m = (t as u64).wrapping_mul(NEGATIVE_INVERSE);
    let u = ((t + u128::from(m) * u128::from(P)) >> 64) as u64;
    if u >= P { u - P } else { u }
}

/// A whole number.
pub(super) fn whole(n: u64) -> u64 {
    times(n % P, R2)
}

/// A whole number with a sign.
pub(super) fn signed(n: i64) -> u64 {
    let x = whole(n.unsigned_abs());
    if n < 0 { negative(x) } else { x }
}

/// The number below P that `a` stands for.
pub(super) fn plain(a: u64) -> u64 {
    times(a, 1)
}

pub(super) fn power(a: u64, mut n: u64) -> u64 {
    let (mut result, mut base) = (R, a);
    while n > 0 {
        if n & 1 == 1 {
            result = times(result, base);
        }
        base = times(base, base);
        n >>= 1;
    }
    result
}

/// `1/a`, or `None` for 0.
pub(super) fn inverse(a: u64) -> Option<u64> {
    (a != 0).then(|| power(a, P - 2))
}

/// The root that is itself a square, so that √a·√b = √(ab); `None` if `a` is no square.
pub(super) fn root(a: u64) -> Option<u64> {
    let r = power(a, (P + 1) / 4);
    (times(r, r) == a).then_some(r)
}

/// The point of the circle at the parameter `t`: ((1−t²)/(1+t²), 2t/(1+t²)). −1 is no square: no divisor is 0.
pub(super) fn circle(t: u64) -> Point {
    let square = times(t, t);
    let scale = inverse(plus(R, square)).unwrap_or(R);
    (times(minus(R, square), scale), times(plus(t, t), scale))
}

/// The point at the sum of two angles.
pub(super) fn turned(a: Point, b: Point) -> Point {
    (minus(times(a.0, b.0), times(a.1, b.1)), plus(times(a.0, b.1), times(a.1, b.0)))
}

/// The point at a multiple of an angle.
pub(super) fn multiple(a: Point, n: i64) -> Point {
    let mut base = if n < 0 { (a.0, negative(a.1)) } else { a };
    let (mut result, mut n) = ((R, 0), n.unsigned_abs());
    while n > 0 {
        if n & 1 == 1 {
            result = turned(result, base);
        }
        base = turned(base, base);
        n >>= 1;
    }
    result
}

/// The point at `n` steps, of which [`TURN`] are a whole turn.
pub(super) fn step(n: i64) -> Point {
    let unit = multiple(circle(whole(GENERATOR)), ((P + 1) / TURN.unsigned_abs()) as i64);
    multiple(unit, n.rem_euclid(TURN))
}

fn each(a: &Value, b: &Value, f: impl Fn(u64, u64) -> u64) -> Value {
    std::array::from_fn(|k| f(a[k], b[k]))
}

pub(super) fn sum(a: &Value, b: &Value) -> Value {
    each(a, b, plus)
}

pub(super) fn difference(a: &Value, b: &Value) -> Value {
    each(a, b, minus)
}

pub(super) fn product(a: &Value, b: &Value) -> Value {
    each(a, b, times)
}

pub(super) fn opposite(a: &Value) -> Value {
    a.map(negative)
}

/// `1/a`, or `None` where one of the values is 0.
pub(super) fn reciprocal(a: &Value) -> Option<Value> {
    let mut result = ZERO;
    for k in 0..K {
        result[k] = inverse(a[k])?;
    }
    Some(result)
}

pub(super) fn raised(a: &Value, n: i32) -> Option<Value> {
    let power = a.map(|x| power(x, n.unsigned_abs().into()));
    if n < 0 { reciprocal(&power) } else { Some(power) }
}

pub(super) fn has_zero(a: &Value) -> bool {
    a.contains(&0)
}

/// The small fraction n/d that has this value at every point, if there is one.
pub(super) fn as_fraction(a: &Value) -> Option<(i64, i64)> {
    const LARGEST: u64 = 1 << 28;
    if a.iter().any(|x| *x != a[0]) {
        return None;
    }
    // Euclid's algorithm on P and x holds r = t·x; it is stopped half-way.
    let (mut r0, mut r1) = (i128::from(P), i128::from(plain(a[0])));
    let (mut t0, mut t1) = (0_i128, 1_i128);
    while r1 >= i128::from(LARGEST) {
        let q = r0 / r1;
        (r0, r1) = (r1, r0 - q * r1);
        (t0, t1) = (t1, t0 - q * t1);
    }
    let (n, d) = if t1 < 0 { (-r1, -t1) } else { (r1, t1) };
    if d == 0 || d >= i128::from(LARGEST) {
        return None;
    }
    Some((i64::try_from(n).ok()?, i64::try_from(d).ok()?))
}

/// A number that depends on all bits of `x` (Steele, Lea, Flood 2014: splitmix64).
pub(super) fn mixed(x: u64) -> u64 {
    let mut z = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}
