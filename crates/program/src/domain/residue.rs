//! Integers modulo the prime 2⁶¹ − 1, with angles as points of the circle modulo it.
//!
//! A polynomial in lengths, sines and cosines takes a value there that is its own modulo the prime, at points of one's choice.
//! What differs there differs; a rank there is no larger than the rank.

use super::Domain;
use denavit_symbolic::Rational;

/// The prime.
const P: u64 = (1 << 61) - 1;

/// A number modulo 2⁶¹ − 1; what has none, such as a division by 0, is undefined.
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
    let product = u128::from(a) * u128::from(b);
    let folded = (product & u128::from(P)) as u64 + (product >> 61) as u64;
    if folded >= P { folded - P } else { folded }
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

impl Residue {
    /// An integer.
    pub fn new(n: u64) -> Self {
        let value = n % P;
        let circle = (value == 0).then_some((0, 1));
        Residue { value: Some(value), circle, turns: Rational::ZERO, number: None }
    }

    /// An input that may be an angle: with this value, and the point (2t, 1 − t²)/(1 + t²) for its sine and cosine.
    pub fn input(n: u64, t: u64) -> Self {
        let t = t % P;
        let square = times(t, t);
        let circle = inverse(plus(1, square))
            .map(|over| (times(plus(t, t), over), times(plus(1, minus(square)), over)));
        Residue { value: Some(n % P), circle, turns: Rational::ZERO, number: None }
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
        let mut rows: Vec<Vec<u64>> =
            rows.iter().map(|row| row.iter().map(Residue::get).collect()).collect::<Option<_>>()?;
        let columns = rows.first().map_or(0, Vec::len);
        let mut rank = 0;
        for column in 0..columns {
            let Some(pivot) = (rank..rows.len()).find(|&r| rows[r][column] != 0) else { continue };
            rows.swap(rank, pivot);
            let over = inverse(rows[rank][column])?;
            let leading = rows[rank].clone();
            for row in &mut rows[rank + 1..] {
                let factor = times(row[column], over);
                if factor != 0 {
                    for (entry, &l) in row.iter_mut().zip(&leading).skip(column) {
                        *entry = plus(*entry, minus(times(factor, l)));
                    }
                }
            }
            rank += 1;
        }
        Some(rank)
    }
}

impl Domain for Residue {
    fn rational(r: &Rational) -> Self {
        let modulo =
            |digits: &str| digits.bytes().fold(0, |n, digit| plus(times(n, 10), u64::from(digit - b'0')));
        let (over, under) = r.abs().digits();
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
        let circle = self.circle.zip(b.circle).map(|(x, y)| turned(x, y));
        Residue { value, circle, turns: &self.turns + &b.turns, number: None }
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

    /// The prime is 3 modulo 4.
    fn sqrt(&self) -> Self {
        let root = self.get().map(|a| (a, power(a, P.div_ceil(4))));
        Residue::plain(root.filter(|&(a, root)| times(root, root) == a).map(|r| r.1))
    }

    fn sin_cos(&self) -> (Self, Self) {
        let quarters = &self.turns * &Rational::from(2);
        let whole = quarters.floor();
        let exact = (quarters == whole).then(|| {
            let four = Rational::from(4);
            let rest = &whole - &(&(&whole / &four).floor() * &four);
            rest.to_integer().unwrap_or(0)
        });
        let Some(((mut s, mut c), quarters)) = self.circle.zip(exact) else {
            return (Residue::undefined(), Residue::undefined());
        };
        for _ in 0..quarters {
            (s, c) = (c, minus(s));
        }
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
