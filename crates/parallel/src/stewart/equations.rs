//! The equations of six legs in Study's coordinates.
//!
//! A pose is a quaternion e for its rotation R, and g with its translation p = g ē / e·e, up to one common factor; e·g = 0 is
//! Study's quadric. With N = e·e, the leg of length l from a of the base to b of the platform says N(|p + R b − a|² − l²) = 0, which is
//!
//! ```text
//! g·g + (|a|² + |b|² − l²) e·e − 2 (a e)·(e b) + 2 g·(e b − a e) = 0
//! ```
//!
//! a quadric. It is linear in the seventeen forms e·e, eᵢeⱼ (as entries of R), N p, N Rᵀp, g·g: those by which the motions of space are
//! embedded in P¹⁶, where their closure has degree 40 (Gallet, Nawratil and Schicho, "Bond theory for pentapods and hexapods", J. Geom.
//! 106, 2015). A leg is a hyperplane there.

use crate::complex::Complex;
use crate::interval::{Interval, Rectangle};

/// e, then g.
pub type Study = [Complex; 8];

/// eᵀ A e + eᵀ M g + c g·g.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Quadric {
    pub ee: [[Complex; 4]; 4],
    pub eg: [[Complex; 4]; 4],
    pub gg: Complex,
}

/// The same with c = 1, with real coefficients that are known to lie between bounds.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Bounded {
    pub ee: [[Interval; 4]; 4],
    pub eg: [[Interval; 4]; 4],
}

/// Quaternion products as matrices: `a e` of a vector from the left, `e b` from the right.
fn left([x, y, z]: [Interval; 3]) -> [[Interval; 4]; 4] {
    let o = Interval::ZERO;
    [[o, -x, -y, -z], [x, o, -z, y], [y, z, o, -x], [z, -y, x, o]]
}

fn right([x, y, z]: [Interval; 3]) -> [[Interval; 4]; 4] {
    let o = Interval::ZERO;
    [[o, -x, -y, -z], [x, o, z, -y], [y, -z, o, x], [z, y, -x, o]]
}

impl Bounded {
    /// The equation of a leg.
    pub fn leg(a: [Interval; 3], b: [Interval; 3], length: Interval) -> Self {
        let two = Interval::point(2.0);
        let square = |v: [Interval; 3]| v[0].squared() + v[1].squared() + v[2].squared();
        let s = square(a) + square(b) - length.squared();
        let (l, r) = (left(a), right(b));
        let mut ee = [[Interval::ZERO; 4]; 4];
        let mut eg = ee;
        for i in 0..4 {
            for j in 0..4 {
                // −2 (a e)·(e b) = −2 eᵀ Lᵀ R e = 2 eᵀ L R e
                let product = (0..4).fold(Interval::ZERO, |sum, k| sum + l[i][k] * r[k][j]);
                ee[i][j] = two * product + if i == j { s } else { Interval::ZERO };
                eg[i][j] = two * (r[j][i] - l[j][i]);
            }
        }
        Bounded { ee, eg }
    }

    /// The quadric in the middle.
    pub fn middle(&self) -> Quadric {
        let middle = |m: &[[Interval; 4]; 4]| m.map(|row| row.map(|x| Complex::from(0.5 * (x.lo + x.hi))));
        Quadric { ee: middle(&self.ee), eg: middle(&self.eg), gg: Complex::ONE }
    }

    /// The derivatives by e and g.
    pub fn gradient(&self, x: &[Rectangle; 8]) -> [Rectangle; 8] {
        let two = Interval::point(2.0);
        std::array::from_fn(|n| {
            let i = n % 4;
            if n < 4 {
                let ee = (0..4).fold(Rectangle::ZERO, |sum, j| sum + self.ee[i][j] * x[j]);
                (0..4).fold(two * ee, |sum, j| sum + self.eg[i][j] * x[4 + j])
            } else {
                (0..4).fold(two * x[n], |sum, j| sum + self.eg[j][i] * x[j])
            }
        })
    }
}

impl Quadric {
    /// The derivatives by e and g; the value is half their product with (e, g).
    pub fn gradient(&self, x: &Study) -> Study {
        let mut d = [Complex::ZERO; 8];
        for i in 0..4 {
            let (mut along_e, mut along_g) = (Complex::ZERO, self.gg * x[4 + i]);
            for j in 0..4 {
                along_e += self.ee[i][j] * x[j];
                d[i] += self.eg[i][j] * x[4 + j];
                d[4 + i] += self.eg[j][i] * x[j];
            }
            along_g *= 2.0;
            d[i] += along_e * 2.0;
            d[4 + i] += along_g;
        }
        d
    }

    /// The same with another factor.
    pub fn scaled(&self, factor: Complex) -> Self {
        let all = |m: &[[Complex; 4]; 4]| m.map(|row| row.map(|x| x * factor));
        Quadric { ee: all(&self.ee), eg: all(&self.eg), gg: self.gg * factor }
    }

    /// The largest coefficient.
    pub fn size(&self) -> f64 {
        let all = self.ee.iter().chain(&self.eg).flatten().chain([&self.gg]);
        all.fold(0.0, |most: f64, z| most.max(z.abs()))
    }
}

/// The derivatives of e·g.
pub fn study_gradient(x: &Study) -> Study {
    std::array::from_fn(|i| x[(i + 4) % 8])
}

/// Half the product of a quadric's derivatives with the point: its value.
pub fn half_product(gradient: &Study, x: &Study) -> Complex {
    gradient.iter().zip(x).fold(Complex::ZERO, |sum, (&d, &x)| sum + d * x) * 0.5
}

/// |x|.
pub fn norm(x: &Study) -> f64 {
    x.iter().map(|z| z.norm2()).sum::<f64>().sqrt()
}

/// How far two points of P⁷ are apart: the sine of the angle between them.
pub fn apart(x: &Study, y: &Study) -> f64 {
    let (nx, ny) = (norm(x), norm(y));
    let product = x.iter().zip(y).fold(Complex::ZERO, |sum, (&x, &y)| sum + x.conj() * y);
    // |y/|y| − x/|x| ⟨x, y⟩/(|x||y|)|
    let off = x.iter().zip(y).map(|(&x, &y)| (y * (1.0 / ny) - x * product * (1.0 / (nx * nx * ny))).norm2());
    off.sum::<f64>().sqrt()
}
