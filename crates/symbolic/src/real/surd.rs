//! The field Q(√2, √3), in which the sines of all multiples of π/12 lie.

use crate::rational::Rational;

/// `a + b√2`
type Pair = [Rational; 2];

/// `a + b√2 + c√3 + d√6`
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Surd(pub [Rational; 4]);

/// Longer numbers are no longer exact: geometry does not come to them.
const MAX_BITS: u64 = 4_000;

impl Surd {
    pub fn rational(x: Rational) -> Self {
        Surd([x, Rational::ZERO, Rational::ZERO, Rational::ZERO])
    }

    pub fn is_zero(&self) -> bool {
        self.0.iter().all(Rational::is_zero)
    }

    pub fn is_short(&self) -> bool {
        self.0.iter().all(|x| x.bits() <= MAX_BITS)
    }

    pub fn as_rational(&self) -> Option<&Rational> {
        self.0[1..].iter().all(Rational::is_zero).then_some(&self.0[0])
    }

    pub fn plus(&self, o: &Self) -> Self {
        Surd([0, 1, 2, 3].map(|i| &self.0[i] + &o.0[i]))
    }

    pub fn negated(&self) -> Self {
        Surd([0, 1, 2, 3].map(|i| -&self.0[i]))
    }

    pub fn times(&self, o: &Self) -> Self {
        if let Some(k) = self.as_rational() {
            return Surd([0, 1, 2, 3].map(|i| k * &o.0[i]));
        }
        if let Some(k) = o.as_rational() {
            return Surd([0, 1, 2, 3].map(|i| k * &self.0[i]));
        }
        // (u + v√3)(x + y√3) = ux + 3vy + (uy + vx)√3
        let ([u, v], [x, y]) = (self.halves(), o.halves());
        let three = [Rational::from(3), Rational::ZERO];
        let first = sum(&product(&u, &x), &product(&three, &product(&v, &y)));
        Surd::of(first, sum(&product(&u, &y), &product(&v, &x)))
    }

    /// Nothing for 0.
    pub fn inverse(&self) -> Option<Self> {
        if let Some(k) = self.as_rational() {
            return k.recip().map(Surd::rational);
        }
        // 1/(u + v√3) = (u − v√3)/(u² − 3v²)
        let [u, v] = self.halves();
        let three = [Rational::from(3), Rational::ZERO];
        let norm = difference(&product(&u, &u), &product(&three, &product(&v, &v)));
        let over = inverse(&norm)?;
        Some(Surd::of(product(&u, &over), negative(&product(&v, &over))))
    }

    /// The root of one sign, if it lies in the field.
    pub fn sqrt(&self) -> Option<Self> {
        // (s + t√3)² = s² + 3t² + 2st√3
        let [u, v] = self.halves();
        let zero = || [Rational::ZERO, Rational::ZERO];
        if is_zero(&v) {
            let third = product(&u, &[Rational::new(1, 3), Rational::ZERO]);
            let of_three = || Some(Surd::of(zero(), root(&third)?));
            return root(&u).map(|s| Surd::of(s, zero())).or_else(of_three);
        }
        let three = [Rational::from(3), Rational::ZERO];
        let half = [Rational::new(1, 2), Rational::ZERO];
        let n = root(&difference(&product(&u, &u), &product(&three, &product(&v, &v))))?;
        [n.clone(), negative(&n)].iter().find_map(|n| {
            let s = root(&product(&half, &sum(&u, n)))?;
            let t = product(&product(&half, &v), &inverse(&s)?);
            Some(Surd::of(s, t))
        })
    }

    fn halves(&self) -> [Pair; 2] {
        let [a, b, c, d] = self.0.clone();
        [[a, b], [c, d]]
    }

    fn of([a, b]: Pair, [c, d]: Pair) -> Self {
        Surd([a, b, c, d])
    }
}

fn is_zero(x: &Pair) -> bool {
    x[0].is_zero() && x[1].is_zero()
}

fn sum(x: &Pair, y: &Pair) -> Pair {
    [&x[0] + &y[0], &x[1] + &y[1]]
}

fn negative(x: &Pair) -> Pair {
    [-&x[0], -&x[1]]
}

fn difference(x: &Pair, y: &Pair) -> Pair {
    [&x[0] - &y[0], &x[1] - &y[1]]
}

fn product(x: &Pair, y: &Pair) -> Pair {
    let two = Rational::from(2);
    [&(&x[0] * &y[0]) + &(&two * &(&x[1] * &y[1])), &(&x[0] * &y[1]) + &(&x[1] * &y[0])]
}

fn inverse(x: &Pair) -> Option<Pair> {
    let two = Rational::from(2);
    let norm = (&(&x[0] * &x[0]) - &(&two * &(&x[1] * &x[1]))).recip()?;
    Some([&x[0] * &norm, -(&x[1] * &norm)])
}

/// The root of one sign in Q(√2), if it lies there.
fn root(x: &Pair) -> Option<Pair> {
    let [p, q] = x;
    let half = Rational::new(1, 2);
    if q.is_zero() {
        let of_two = || Some([Rational::ZERO, (p * &half).sqrt()?]);
        return p.sqrt().map(|s| [s, Rational::ZERO]).or_else(of_two);
    }
    let two = Rational::from(2);
    let n = (&(p * p) - &(&two * &(q * q))).sqrt()?;
    [n.clone(), -n].iter().find_map(|n| {
        let s = (&half * &(p + n)).sqrt()?;
        let t = &(&half * q) * &s.recip()?;
        Some([s, t])
    })
}
