//! A wider matrix of the hidden joint, for poses at which the [determinant](crate::determinant) vanishes identically.
//!
//! Where the last axis is parallel to the first, as with a tool that points straight down, the six equations have
//! relations: three of them imply the others, but the 12 × 12 matrix is too narrow to see it, and has two null vectors at
//! every value of the hidden joint. With half angles for both joints that are not hidden, `(u, v)` and `(u', v')`, the
//! equations are forms of degree 2 in either pair. Multiplied by `u u'`, `u v'`, `v u'` and `v v'` they are 24 equations
//! between the 16 monomials of degree 3 in either pair, and these lose rank only where there is a solution.
//!
//! Sixteen fixed mixtures of them have a determinant of degree 12 in the hidden angle. Those of its 24 roots are true at
//! which all 24 equations lose rank: the mixtures add others, and complex solutions at a real angle add pairs. Both are
//! recognised and dismissed, so that the [certificate](crate::certificate) asks for the rest only.

use crate::{
    arm::Joint, chart::Chart, eliminate::Eliminated, fourier::Fourier, instructions::Strict, lanes::Lanes,
    split::Split,
};

/// Unknowns: `u³ … v³` times `u'³ … v'³`, the second faster.
pub(crate) const MONOMIALS: usize = 16;
/// Equations: six times four multipliers.
pub(crate) const EQUATIONS: usize = 24;
/// Degree of the determinant in the hidden angle.
pub(crate) const DEGREE: usize = 12;

/// A form of degree 2 in both pairs: coefficients of `u², u v, v²` times those of the other pair, the latter faster.
type Form = [f64; 9];
/// Forms over `(1, c, s)` of the hidden joint.
type Forms<const N: usize> = [[Form; N]; 3];

/// The equations of a pose in half angles.
#[derive(Clone, Debug)]
pub(crate) struct Wide {
    /// The six equations.
    own: Forms<6>,
    /// Four mixtures of them for each multiplier.
    mixed: Forms<MONOMIALS>,
}

impl Default for Wide {
    fn default() -> Wide {
        Wide { own: [[[0.0; 9]; 6]; 3], mixed: [[[0.0; 9]; MONOMIALS]; 3] }
    }
}

impl Wide {
    /// Takes the equations of a pose. They have their own sizes again: one that is all rounding must not be enlarged.
    #[inline(never)]
    pub fn fill(&mut self, eliminated: &Eliminated, split: &Split) {
        let (multiplied, other) = split.multiplied_and_other();
        for (part, forms) in self.own.iter_mut().enumerate() {
            for (i, form) in forms.iter_mut().enumerate() {
                let mut entries = [0.0; 9];
                for (entry, x) in entries.iter_mut().zip(&eliminated.rows[i][9 * part..]) {
                    *entry = x * eliminated.sizes[i];
                }
                *form = halved(multiplied, 3, halved(other, 1, entries));
            }
        }
        for (mixed, own) in self.mixed.iter_mut().zip(&self.own) {
            for (i, form) in mixed.iter_mut().enumerate() {
                *form = [0.0; 9];
                for (j, equation) in own.iter().enumerate() {
                    let weight = weight(i, j);
                    for (entry, x) in form.iter_mut().zip(equation) {
                        *entry += weight * x;
                    }
                }
            }
        }
    }

    /// The determinants of the mixtures at the nodes of a chart.
    pub fn samples(&self, fourier: &Fourier<4>, chart: &Chart) -> [Lanes; 4] {
        let mut samples = [Lanes::ZERO; 4];
        for (g, sample) in samples.iter_mut().enumerate() {
            let [c, s, weight] = chart.nodes::<Strict>(fourier.cosines[g], fourier.sines[g]);
            for l in 0..8 {
                let square = weight.0[l] * weight.0[l];
                let fourth = square * square;
                sample.0[l] = self.determinant(c.0[l], s.0[l]) * (fourth * fourth * fourth);
            }
        }
        samples
    }

    /// The determinant of the mixtures, by elimination with partial pivoting.
    fn determinant(&self, c: f64, s: f64) -> f64 {
        let mut m = [[0.0; MONOMIALS]; MONOMIALS];
        for (i, row) in m.iter_mut().enumerate() {
            place(&at(&self.mixed, i, c, s), i / 4, row);
        }
        let mut product = 1.0;
        for k in 0..MONOMIALS {
            let mut best = k;
            for r in k + 1..MONOMIALS {
                if m[r][k].abs() > m[best][k].abs() {
                    best = r;
                }
            }
            if best != k {
                m.swap(k, best);
                product = -product;
            }
            let pivot = m[k];
            product *= pivot[k];
            if pivot[k] == 0.0 {
                return 0.0;
            }
            let inverse = 1.0 / pivot[k];
            for row in &mut m[k + 1..] {
                let factor = row[k] * inverse;
                for (entry, pivot) in row.iter_mut().zip(&pivot) {
                    *entry -= factor * pivot;
                }
            }
        }
        product
    }

    /// All equations at a value of the hidden joint.
    pub fn all(&self, [c, s]: [f64; 2]) -> [[f64; MONOMIALS]; EQUATIONS] {
        let mut m = [[0.0; MONOMIALS]; EQUATIONS];
        for (i, row) in m.iter_mut().enumerate() {
            place(&at(&self.own, i / 4, c, s), i % 4, row);
        }
        m
    }
}

/// From the monomials of a joint, every `stride` entries, to those of its half angle: `1 = u² + v²`, `c = u² − v²`,
/// `s = 2 u v`; a slide's stay as they are.
fn halved(joint: Joint, stride: usize, mut form: Form) -> Form {
    if joint == Joint::Revolute {
        for at in (0..9).filter(|at| (at / stride).is_multiple_of(3)) {
            let (one, c, s) = (form[at], form[at + stride], form[at + 2 * stride]);
            (form[at], form[at + stride], form[at + 2 * stride]) = (one + c, 2.0 * s, one - c);
        }
    }
    form
}

/// `F₁ + c F_c + s F_s`
fn at<const N: usize>(forms: &Forms<N>, i: usize, c: f64, s: f64) -> Form {
    std::array::from_fn(|k| forms[0][i][k] + c * forms[1][i][k] + s * forms[2][i][k])
}

/// A form times one of the four multipliers, in a row of zeros.
fn place(form: &Form, multiplier: usize, row: &mut [f64; MONOMIALS]) {
    for i in 0..3 {
        let to = 4 * (i + multiplier / 2) + multiplier % 2;
        row[to..to + 3].copy_from_slice(&form[3 * i..3 * i + 3]);
    }
}

/// A fixed number between −1 and 1 without pattern.
pub(crate) fn weight(i: usize, j: usize) -> f64 {
    let x = (6 * i + j + 1) as f64 * 0.754_877_666_246_692_8;
    let y = (x - x.floor()) * 997.0;
    2.0 * (y - y.floor()) - 1.0
}
