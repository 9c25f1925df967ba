//! From samples on the circle to a trigonometric polynomial `p(θ) = Σ cₖ exp(i k θ)`, with a measure of its noise.

use crate::instructions::Instructions;
use crate::lanes::Lanes;

/// Largest number of samples.
const MOST: usize = 32;

/// Equispaced angles, eight a group, and the transform of samples there; offset so that no node is a special angle.
#[derive(Clone, Debug)]
pub struct Fourier<const GROUPS: usize> {
    /// Cosines of the angles.
    pub cosines: [Lanes; GROUPS],
    /// Their sines.
    pub sines: [Lanes; GROUPS],
    /// For each sample what it adds to `c₀, Re c₁ …, Im c₁ …`, then to the harmonics above the degree.
    pub table: [[Lanes; GROUPS]; MOST],
}

/// A fit with more noise than this is of no use.
pub(crate) const USELESS: f64 = 1e-5;

/// A trigonometric polynomial of degree `degree`, its largest sample 1.
#[derive(Clone, Debug)]
pub struct Trigonometric {
    /// Degree.
    pub degree: usize,
    /// `Re c₀ …`.
    pub re: [f64; 13],
    /// `Im c₀ …`.
    pub im: [f64; 13],
    /// Size of the harmonics above the degree, which would be zero without rounding.
    pub noise: f64,
}

impl Default for Trigonometric {
    fn default() -> Trigonometric {
        Trigonometric { degree: 0, re: [0.0; 13], im: [0.0; 13], noise: 1.0 }
    }
}

impl Trigonometric {
    /// Its values at eight angles, given by cosines and sines: `c₀ + 2 Re Σ cₖ zᵏ` by Horner's rule.
    #[inline(always)]
    pub fn values<I: Instructions>(&self, c: Lanes, s: Lanes) -> Lanes {
        let (mut re, mut im) = (Lanes::ZERO, Lanes::ZERO);
        for k in (1..=self.degree).rev() {
            let (a, b) = (re.plus(Lanes::splat(self.re[k])), im.plus(Lanes::splat(self.im[k])));
            re = b.mul_sub::<I>(s, a.times(c));
            im = b.mul_add::<I>(c, a.times(s));
        }
        re.scale_add::<I>(2.0, Lanes::splat(self.re[0]))
    }
}

/// Where the first node is, as a part of the spacing.
const START: f64 = 0.381_966_011_250_105_1;

impl<const GROUPS: usize> Fourier<GROUPS> {
    /// The nodes and the table for the given degree; `8 GROUPS` samples, more than `2 degree`.
    pub fn new(degree: usize) -> Fourier<GROUPS> {
        let count = 8 * GROUPS;
        let mut out = Fourier {
            cosines: [Lanes::ZERO; GROUPS],
            sines: [Lanes::ZERO; GROUPS],
            table: [[Lanes::ZERO; GROUPS]; MOST],
        };
        for node in 0..count {
            let angle = std::f64::consts::TAU * (node as f64 + START) / count as f64;
            out.cosines[node / 8].0[node % 8] = angle.cos();
            out.sines[node / 8].0[node % 8] = angle.sin();
            for output in 0..count {
                let entry = if output <= degree {
                    (output as f64 * angle).cos()
                } else if output <= 2 * degree {
                    -((output - degree) as f64 * angle).sin()
                } else {
                    let above = output - 2 * degree - 1;
                    let k = (degree + 1 + above / 2) as f64;
                    if above.is_multiple_of(2) { (k * angle).cos() } else { (k * angle).sin() }
                };
                out.table[node][output / 8].0[output % 8] = entry / count as f64;
            }
        }
        out
    }

    /// The polynomial through the samples, divided by the largest of them; false if they are all zero or not numbers.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    pub fn fit<I: Instructions>(
        &self,
        degree: usize,
        samples: &[Lanes; GROUPS],
        out: &mut Trigonometric,
    ) -> bool {
        let mut top = Lanes::ZERO;
        for sample in samples {
            top = top.larger(sample.magnitude());
        }
        let top = top.largest();
        if !(top > 1e-250 && top < 1e250) {
            return false;
        }
        let mut sums = [Lanes::ZERO; GROUPS];
        for node in 0..8 * GROUPS {
            let sample = samples[node / 8].0[node % 8];
            for (sum, entry) in sums.iter_mut().zip(&self.table[node]) {
                *sum = entry.scale_add::<I>(sample, *sum);
            }
        }
        let sum = |k: usize| sums[k / 8].0[k % 8] / top;
        out.degree = degree;
        out.re[0] = sum(0);
        out.im[0] = 0.0;
        for k in 1..=degree {
            out.re[k] = sum(k);
            out.im[k] = sum(degree + k);
        }
        let mut noise = 0.0;
        for k in 2 * degree + 1..8 * GROUPS {
            noise += sum(k) * sum(k);
        }
        out.noise = noise.sqrt();
        out.noise.is_finite()
    }
}
