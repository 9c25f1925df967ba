//! Integers modulo a prime, with angles as points of the circle modulo it.
//!
//! A polynomial in lengths, sines and cosines takes a value there that is its own modulo the prime, at points of one's choice.
//! What differs there differs; a rank there is no larger than the rank. Constants keep what holds between them: of the prime −1 is
//! no square, but small primes are, so that the root which is a square itself is the same for √2·√3 as for √6; constant angles are
//! powers of one element of the circle for 1/[`PARTS`] of a turn, whose sines and cosines are those roots where they are roots
//! (cos 45° = √2/2, cos 36° = (1 + √5)/4), and powers of another, with which nothing has to do, for radians.

use super::Domain;
use denavit_symbolic::Rational;

/// The prime, 213500357 · [`PARTS`] − 1.
const P: u64 = 2_305_803_855_599_999_999;
/// The order of the circle.
const ORDER: u64 = P + 1;
/// Parts of a turn that have a sine and a cosine: 2¹⁰·3³·5⁸.
const PARTS: i64 = 10_800_000_000;
/// Sine and cosine of one of them: of those of that order one with √2 = 2 cos 45°, √3 = 2 cos 30°, √5 = 4 cos 36° − 1,
/// √(10 − 2√5) = 4 sin 36° and sin 90° = 1.
const PART: (u64, u64) = (757_097_694_285_513_000, 698_530_410_534_215_526);
/// What makes the point for one of [`RADIANS`] parts of a radian ([`point`]): any number, as e^{i/n} is transcendental.
const RADIAN: u64 = 1_873_456_789_012_345_678;
/// Parts of a radian that have a sine and a cosine.
const RADIANS: u128 = 9 * 10_u128.pow(30);

/// A number modulo the prime; what has none, such as a division by 0, is undefined.
#[derive(Clone, PartialEq, Debug)]
pub struct Residue {
    value: Option<u64>,
    /// Sine and cosine of the value as an angle, where they are known.
    circle: Option<(u64, u64)>,
    /// How many times π is added.
    turns: Rational,
    /// The number itself, where it is a constant.
    number: Option<Rational>,
}

fn times(a: u64, b: u64) -> u64 {
    (u128::from(a) * u128::from(b) % u128::from(P)) as u64
}

fn plus(a: u64, b: u64) -> u64 {
    let sum = a + b;
    if sum >= P { sum - P } else { sum }
}

fn minus(a: u64) -> u64 {
    if a == 0 { 0 } else { P - a }
}

fn power(mut base: u64, mut exponent: u64) -> u64 {
    let mut result = 1;
    while exponent > 0 {
        if exponent & 1 == 1 {
            result = times(result, base);
        }
        base = times(base, base);
        exponent >>= 1;
    }
    result
}

/// Modulo the prime; `None` for a multiple of it.
fn inverse(a: u64) -> Option<u64> {
    (a != 0).then(|| power(a, P - 2))
}

/// The sine and cosine of the sum of two angles.
fn turned((s, c): (u64, u64), (t, d): (u64, u64)) -> (u64, u64) {
    (plus(times(s, d), times(c, t)), plus(times(c, d), minus(times(s, t))))
}

/// The sine and cosine of so many times an angle.
fn repeated(mut angle: (u64, u64), mut times: u64) -> (u64, u64) {
    let mut result = (0, 1);
    while times > 0 {
        if times & 1 == 1 {
            result = turned(result, angle);
        }
        angle = turned(angle, angle);
        times >>= 1;
    }
    result
}

/// The point (2t, 1 − t²)/(1 + t²) of the circle; 1 + t² is not 0.
fn point(t: u64) -> Option<(u64, u64)> {
    let square = times(t, t);
    let over = inverse(plus(1, square))?;
    Some((times(plus(t, t), over), times(plus(1, minus(square)), over)))
}

/// An integer by its decimal digits, modulo another.
fn modulo(digits: &str, by: u64) -> u64 {
    let next =
        |n: u64, digit: u8| (u128::from(n) * 10 + u128::from(digit - b'0')).rem_euclid(u128::from(by)) as u64;
    digits.bytes().fold(0, next)
}

/// Sine and cosine of a number of radians; nothing if that is no multiple of what has them.
fn of_radians(n: &Rational) -> Option<(u64, u64)> {
    let (over, under) = n.abs().digits();
    let under: u128 = under.parse().ok()?;
    let each = RADIANS.is_multiple_of(under).then_some(RADIANS / under)? % u128::from(ORDER);
    let count = u128::from(modulo(&over, ORDER)) * each % u128::from(ORDER);
    let (s, c) = repeated(point(RADIAN)?, count as u64);
    Some((if n.is_negative() { minus(s) } else { s }, c))
}

/// The root that is a square itself; nothing for what has no root.
fn root(a: u64) -> Option<u64> {
    // The prime is 3 modulo 4.
    let root = power(a, P.div_ceil(4));
    (times(root, root) == a).then_some(root)
}

/// The largest prime that is looked for as a square in what a root is of.
const DIVISOR: u64 = 1000;

/// The root of a number as a product of roots of primes.
fn root_of_number(n: &Rational) -> Option<u64> {
    let (over, under) = n.to_parts()?;
    let (over, under) = (u64::try_from(over).ok()?, u64::try_from(under).ok()?);
    let mut rest = over.checked_mul(under)?;
    let mut all = inverse(under % P)?;
    for p in 2..=DIVISOR {
        while rest > 0 && rest.is_multiple_of(p * p) {
            rest /= p * p;
            all = times(all, p);
        }
        if rest > 0 && rest.is_multiple_of(p) {
            rest /= p;
            all = times(all, root(p)?);
        }
    }
    // No square of a larger prime is in it.
    let is_square = rest > 1 && rest.isqrt().pow(2) == rest;
    (rest < DIVISOR.pow(3) && !is_square).then_some(times(all, root(rest)?))
}

impl Residue {
    /// An integer.
    pub fn new(n: u64) -> Self {
        let value = n % P;
        let circle = (value == 0).then_some((0, 1));
        Residue { value: Some(value), circle, turns: Rational::ZERO, number: None }
    }

    /// An input that may be an angle: with this value, and the point (2t, 1 − t²)/(1 + t²) for its sine and cosine.
    pub fn input(n: u64, t: u64) -> Self {
        Residue { value: Some(n % P), circle: point(t % P), turns: Rational::ZERO, number: None }
    }

    /// Sine and cosine of the value as an angle, π aside.
    fn circle(&self) -> Option<(u64, u64)> {
        self.circle.or_else(|| of_radians(self.number.as_ref()?))
    }

    /// The integer below the prime; `None` where it is undefined.
    pub fn get(&self) -> Option<u64> {
        self.value.filter(|_| self.turns.is_zero())
    }

    /// Times a number, which is also given modulo the prime.
    fn multiple(&self, n: &Rational, residue: &Residue) -> Self {
        let value = self.value.zip(residue.value).map(|(x, y)| times(x, y));
        let turned = |c: (u64, u64)| {
            let count = n.to_integer().filter(|n| n.abs() < 1000)?;
            let (s, c) = (0..count.abs()).fold((0, 1), |all, _| turned(all, c));
            Some(if count < 0 { (minus(s), c) } else { (s, c) })
        };
        let circle = self.circle.and_then(|c| if c == (0, 1) { Some(c) } else { turned(c) });
        let number = self.number.as_ref().map(|own| own * n);
        Residue { value, circle, turns: &self.turns * n, number }
    }

    fn undefined() -> Self {
        Residue { value: None, circle: None, turns: Rational::ZERO, number: None }
    }

    fn plain(value: Option<u64>) -> Self {
        value.map_or_else(Residue::undefined, Residue::new)
    }

    /// The rank of a matrix of such numbers; `None` if one is undefined.
    pub fn rank(rows: &[Vec<Residue>]) -> Option<usize> {
        let columns = rows.first().map_or(0, Vec::len);
        Some(columns - Self::dependencies(rows)?.len())
    }

    /// The columns of a matrix that depend on those before them, each with its coefficients in the others; `None` if an entry is undefined.
    pub fn dependencies(rows: &[Vec<Residue>]) -> Option<Vec<Dependency>> {
        let mut rows: Vec<Vec<u64>> =
            rows.iter().map(|row| row.iter().map(Residue::get).collect()).collect::<Option<_>>()?;
        let columns = rows.first().map_or(0, Vec::len);
        let (mut pivots, mut found): (Vec<usize>, Vec<Dependency>) = (vec![], vec![]);
        for column in 0..columns {
            let rank = pivots.len();
            let Some(pivot) = (rank..rows.len()).find(|&r| rows[r][column] != 0) else {
                let entries = pivots.iter().zip(&rows).map(|(&p, row)| (p, Residue::new(row[column])));
                let of = entries.filter(|(_, e)| e.value != Some(0)).collect();
                found.push(Dependency { column, of });
                continue;
            };
            rows.swap(rank, pivot);
            let over = inverse(rows[rank][column])?;
            rows[rank].iter_mut().skip(column).for_each(|entry| *entry = times(*entry, over));
            let leading = rows[rank].clone();
            for (r, row) in rows.iter_mut().enumerate() {
                let factor = row[column];
                if r != rank && factor != 0 {
                    for (entry, &l) in row.iter_mut().zip(&leading).skip(column) {
                        *entry = plus(*entry, minus(times(factor, l)));
                    }
                }
            }
            pivots.push(column);
        }
        Some(found)
    }

    /// The fraction of the least size with this residue, if it is far smaller than that of a random one would be.
    pub fn lifted(&self) -> Option<Rational> {
        const SMALL: i64 = 1 << 24;
        // Euclid's algorithm, stopped half way: each remainder is the value times the number beside it.
        let (mut r, mut next) = (i64::try_from(P).ok()?, i64::try_from(self.get()?).ok()?);
        let (mut t, mut by) = (0_i64, 1_i64);
        while next > SMALL {
            let whole = r / next;
            (r, next) = (next, r - whole * next);
            (t, by) = (by, t - whole * by);
        }
        let (over, under) = if by < 0 { (-next, -by) } else { (next, by) };
        (under > 0 && under <= SMALL).then(|| Rational::new(over, under))
    }
}

/// A column that depends on others.
#[derive(Clone, PartialEq, Debug)]
pub struct Dependency {
    /// Its number.
    pub column: usize,
    /// Columns before it that do not depend on others, with the coefficients of which it is the sum.
    pub of: Vec<(usize, Residue)>,
}

impl Domain for Residue {
    fn rational(r: &Rational) -> Self {
        let (over, under) = r.abs().digits();
        let modulo = |digits: &str| modulo(digits, P);
        let value = inverse(modulo(&under)).map(|u| times(modulo(&over), u));
        let value = Residue::plain(value);
        Residue { number: Some(r.clone()), ..if r.is_negative() { value.neg() } else { value } }
    }

    fn pi() -> Self {
        Residue { turns: Rational::ONE, ..Residue::new(0) }
    }

    fn neg(&self) -> Self {
        let circle = self.circle.map(|(s, c)| (minus(s), c));
        let number = self.number.as_ref().map(|n| -n);
        Residue { value: self.value.map(minus), circle, turns: -&self.turns, number }
    }

    fn add(&self, b: &Self) -> Self {
        let value = self.value.zip(b.value).map(|(x, y)| plus(x, y));
        let turns = &self.turns + &b.turns;
        if let (Some(x), Some(y)) = (&self.number, &b.number) {
            return Residue { value, circle: None, turns, number: Some(x + y) };
        }
        let circle = self.circle().and_then(|x| Some(turned(x, b.circle()?)));
        Residue { value, circle, turns, number: None }
    }

    fn sub(&self, b: &Self) -> Self {
        self.add(&b.neg())
    }

    fn mul(&self, b: &Self) -> Self {
        match (&b.number, &self.number) {
            (Some(n), _) => self.multiple(n, b),
            (None, Some(n)) => b.multiple(n, self),
            _ => Residue::plain(self.get().zip(b.get()).map(|(x, y)| times(x, y))),
        }
    }

    fn div(&self, b: &Self) -> Self {
        let over = b.get().and_then(inverse);
        match (&b.number, over) {
            (Some(n), Some(over)) => {
                let by = n.recip().unwrap_or(Rational::ZERO);
                self.multiple(&by, &Residue::new(over))
            }
            (_, over) => Residue::plain(self.get().zip(over).map(|(x, y)| times(x, y))),
        }
    }

    fn sqrt(&self) -> Self {
        let found = match &self.number {
            Some(n) => root_of_number(n),
            None => self.get().and_then(root),
        };
        Residue::plain(found)
    }

    fn sin_cos(&self) -> (Self, Self) {
        let parts = &self.turns * &Rational::from(PARTS / 2);
        let all = Rational::from(PARTS);
        let rest = &parts - &(&(&parts / &all).floor() * &all);
        let count = rest.to_integer().and_then(|n| u64::try_from(n).ok());
        let Some((own, count)) = self.circle().zip(count) else {
            return (Residue::undefined(), Residue::undefined());
        };
        let (s, c) = turned(own, repeated(PART, count));
        (Residue::new(s), Residue::new(c))
    }

    /// There is no order modulo a prime: a number that belongs to the value, the opposite one to its opposite, as a sign does.
    fn sign(&self) -> Self {
        let of = |x: u64| {
            let mut mixed = x.wrapping_mul(0x9e37_79b9_7f4a_7c15);
            mixed ^= mixed >> 29;
            mixed.wrapping_mul(0xbf58_476d_1ce4_e5b9) >> 3
        };
        Residue::plain(self.get().map(|x| match x {
            0 => 0,
            x if x <= P / 2 => of(x) % P,
            x => minus(of(minus(x)) % P),
        }))
    }

    fn atan2(&self, _: &Self) -> Self {
        Residue::undefined()
    }
}
