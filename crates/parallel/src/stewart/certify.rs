//! Krawczyk's test: a box in which six legs have one solution and no other, in intervals that hold every rounding.
//!
//! The coordinate of the point that is largest is 1; the other seven are unknown. With Y near F'(x)⁻¹, where
//! K = x − Y F(x) + (1 − Y F'(X)) (X − x) lies inside of the box X, there is just one zero of F in X, and it lies in K.
//! A box around a real point is its own conjugate, and so is then its zero: it is real.

use super::equations::{Bounded, Quadric, Study, half_product, study_gradient};
use crate::complex::Complex;
use crate::interval::{Interval, Rectangle};
use crate::lu::Lu;

/// How far the greatest imaginary part is from 0 where a point is tried as a real one.
const NEARLY_REAL: f64 = 1e-7;

/// A solution that is proved to be there.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Proved {
    /// Which coordinate is 1.
    pub unit: usize,
    /// In which its coordinates lie.
    pub region: [Rectangle; 8],
    /// The middle of it.
    pub x: Study,
    /// Whether it is real, which is proved as well.
    pub is_real: bool,
}

/// The equations of six legs, for sure and in doubles.
pub struct Legs {
    pub bounded: [Bounded; 6],
    pub middle: [Quadric; 6],
}

type Seven = [Complex; 7];

/// The coordinates without the one that is 1.
fn others(unit: usize) -> [usize; 7] {
    std::array::from_fn(|i| if i < unit { i } else { i + 1 })
}

impl Legs {
    /// The values and derivatives in doubles.
    fn values(&self, x: &Study, unit: usize) -> (Seven, [Seven; 7]) {
        let columns = others(unit);
        let (mut f, mut d) = ([Complex::ZERO; 7], [[Complex::ZERO; 7]; 7]);
        for i in 0..7 {
            let gradient = if i < 6 { self.middle[i].gradient(x) } else { study_gradient(x) };
            f[i] = half_product(&gradient, x);
            d[i] = columns.map(|c| gradient[c]);
        }
        (f, d)
    }

    /// The derivatives in intervals.
    fn gradients(&self, x: &[Rectangle; 8]) -> [[Rectangle; 8]; 7] {
        std::array::from_fn(|i| {
            if i < 6 { self.bounded[i].gradient(x) } else { std::array::from_fn(|k| x[(k + 4) % 8]) }
        })
    }

    /// Newton's method to where doubles stand still.
    fn refined(&self, mut x: Study, unit: usize) -> Study {
        let mut smallest = f64::INFINITY;
        for _ in 0..8 {
            let (f, d) = self.values(&x, unit);
            let Some(factors) = Lu::of(d) else { break };
            let step = factors.solve(&f);
            let size = step.iter().fold(0.0, |most: f64, z| most.max(z.abs()));
            if size >= smallest || size.is_nan() {
                break;
            }
            smallest = size;
            for (c, step) in others(unit).into_iter().zip(step) {
                x[c] -= step;
            }
        }
        x
    }

    /// The solution near a point, proved; `None` where it cannot be.
    pub fn prove(&self, x: &Study) -> Option<Proved> {
        let unit = (0..8).max_by(|&a, &b| x[a].norm2().total_cmp(&x[b].norm2()))?;
        let scale = Complex::ONE / x[unit];
        let mut x: Study = x.map(|z| z * scale);
        x[unit] = Complex::ONE;
        let x = self.refined(x, unit);
        if x.iter().all(|z| z.im.abs() < NEARLY_REAL) {
            let real = self.refined(x.map(|z| z.re.into()), unit);
            if let Some(region) = self.krawczyk(&real, unit) {
                return Some(Proved { unit, region, x: real, is_real: true });
            }
        }
        let region = self.krawczyk(&x, unit)?;
        // With a real coordinate 1, a real point has real ones.
        let is_complex = region.iter().any(|z| !z.im.holds_zero());
        is_complex.then_some(Proved { unit, region, x, is_real: false })
    }

    /// A box of one solution.
    fn krawczyk(&self, x: &Study, unit: usize) -> Option<[Rectangle; 8]> {
        let columns = others(unit);
        let y = Lu::of(self.values(x, unit).1)?.inverse().map(|row| row.map(Rectangle::point));
        let point = x.map(Rectangle::point);
        let half = Interval::point(0.5);
        let f: [Rectangle; 7] = self.gradients(&point).map(|gradient| {
            half * gradient.iter().zip(&point).fold(Rectangle::ZERO, |sum, (&d, &x)| sum + d * x)
        });
        let product = |row: &[Rectangle; 7], v: [Rectangle; 7]| {
            row.iter().zip(v).fold(Rectangle::ZERO, |sum, (&a, b)| sum + a * b)
        };
        let off = y.map(|row| product(&row, f));
        let size = |z: &Rectangle| z.re.size().max(z.im.size());
        let mut radius = 2.0 * off.iter().map(size).fold(1e-16, f64::max);
        for _ in 0..6 {
            let mut region = x.map(|z| Rectangle::around(z, radius));
            region[unit] = Rectangle::point(Complex::ONE);
            let d = self.gradients(&region).map(|gradient| columns.map(|c| gradient[c]));
            let around = Rectangle::around(Complex::ZERO, radius);
            let image: [Rectangle; 7] = std::array::from_fn(|i| {
                (0..7).fold(Rectangle::ZERO - off[i], |sum, j| {
                    let one = Rectangle::point(if i == j { Complex::ONE } else { Complex::ZERO });
                    let column = std::array::from_fn(|k| d[k][j]);
                    sum + (one - product(&y[i], column)) * around
                })
            });
            // What was evaluated holds the square of this radius, and rounding beside it.
            let inner = Interval { lo: -radius, hi: radius };
            if image.iter().all(|z| z.is_inside(Rectangle { re: inner, im: inner })) {
                let mut region = point;
                for (c, image) in columns.into_iter().zip(image) {
                    region[c] = region[c] + image;
                }
                return Some(region);
            }
            let most = image.iter().map(size).fold(0.0, f64::max);
            radius = 2.0 * most;
            if radius.is_nan() || radius >= 1e-2 {
                return None;
            }
        }
        None
    }
}

impl Proved {
    /// e·e, which is not 0 of a pose.
    pub fn weight(&self) -> Rectangle {
        self.region[..4].iter().fold(Rectangle::ZERO, |sum, &z| sum + z * z)
    }

    /// True if this is another point than `other` for sure.
    pub fn is_apart_from(&self, other: &Proved) -> bool {
        if self.is_real != other.is_real {
            return true;
        }
        let (x, y) = (&self.region, &other.region);
        if self.unit == other.unit {
            return x.iter().zip(y).any(|(a, b)| a.is_apart_from(*b));
        }
        (0..8).any(|i| (0..i).any(|j| !(x[i] * y[j] - x[j] * y[i]).holds_zero()))
    }

    /// The conjugate solution of real legs.
    pub fn conjugate(&self) -> Self {
        let region = self.region.map(|z| Rectangle { re: z.re, im: -z.im });
        Proved { region, x: self.x.map(Complex::conj), ..*self }
    }
}
