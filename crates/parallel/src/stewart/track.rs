//! Solutions followed from one set of six legs to another, along a line of their coefficients.
//!
//! H(x, t) = (1 − t) γ S(x) + t T(x) with Study's quadric beside it: all are linear in the coefficients of hyperplanes in P¹⁶, so that H
//! stays in the family of six hyperplanes, of which almost all have forty solutions. Points of P⁷ are followed on a patch of their own,
//! renewed at each step. Nothing rests on the tracker: what it brings is certified afterwards.

use super::equations::{Quadric, Study, half_product, norm, study_gradient};
use crate::complex::Complex;
use crate::lu::Lu;

/// How carefully paths are followed.
#[derive(Clone, Copy, Debug)]
pub struct Care {
    /// How far a predicted point may be from the path.
    pub off: f64,
    /// The longest step.
    pub longest: f64,
}

impl Care {
    /// What nearly always does.
    pub const USUAL: Care = Care { off: 1e-5, longest: 0.1 };
    /// For paths that met.
    pub const MORE: Care = Care { off: 1e-8, longest: 0.02 };
}

/// The shortest step.
const SHORTEST: f64 = 1e-13;
/// From where on a path that goes no further is looked at.
const NEAR_END: f64 = 0.999;
/// How many steps a path may take.
const MOST_STEPS: usize = 20_000;
/// The size of a correction after which a point is on its path.
const ON_PATH: f64 = 1e-9;
/// The size of a correction after which a point is as good as doubles allow.
const AT_END: f64 = 1e-13;

/// Where a path ends.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct End {
    /// The last point.
    pub x: Study,
    /// Whether t = 1 was reached.
    pub is_reached: bool,
}

/// S and T, S with its factors γ.
pub struct Line<'a> {
    from: [Quadric; 6],
    to: &'a [Quadric; 6],
}

/// The values of H, its derivatives by x, and by t.
struct Values {
    h: [Complex; 8],
    by_x: [Study; 8],
    by_t: [Complex; 8],
}

impl<'a> Line<'a> {
    /// The line with these factors at its start.
    pub fn new(from: &[Quadric; 6], factors: &[Complex; 6], to: &'a [Quadric; 6]) -> Self {
        let from = std::array::from_fn(|i| from[i].scaled(factors[i]));
        Line { from, to }
    }

    /// On the patch on which `patch`·x = 1.
    fn values(&self, x: &Study, t: f64, patch: &Study) -> Values {
        let zero = [Complex::ZERO; 8];
        let mut v = Values { h: zero, by_x: [zero; 8], by_t: zero };
        for i in 0..6 {
            let (s, e) = (self.from[i].gradient(x), self.to[i].gradient(x));
            v.by_x[i] = std::array::from_fn(|k| s[k] * (1.0 - t) + e[k] * t);
            v.by_t[i] = half_product(&e, x) - half_product(&s, x);
            v.h[i] = half_product(&v.by_x[i], x);
        }
        v.by_x[6] = study_gradient(x);
        v.h[6] = half_product(&v.by_x[6], x);
        v.by_x[7] = *patch;
        v.h[7] = half_product(patch, x) * 2.0 - Complex::ONE;
        v
    }

    /// dx/dt along the path.
    fn tangent(&self, x: &Study, t: f64, patch: &Study) -> Option<Study> {
        let v = self.values(x, t, patch);
        Some(Lu::of(v.by_x)?.solve(&v.by_t.map(|z| -z)))
    }

    /// A step of Newton's method, and its size.
    fn corrected(&self, x: &Study, t: f64, patch: &Study) -> Option<(Study, f64)> {
        let v = self.values(x, t, patch);
        let step = Lu::of(v.by_x)?.solve(&v.h);
        let size = norm(&step);
        size.is_finite().then(|| (std::array::from_fn(|i| x[i] - step[i]), size))
    }

    /// Runge and Kutta's step of fourth order.
    fn predicted(&self, x: &Study, t: f64, h: f64, patch: &Study) -> Option<Study> {
        let moved = |k: &Study, h: f64| -> Study { std::array::from_fn(|i| x[i] + k[i] * h) };
        let k1 = self.tangent(x, t, patch)?;
        let k2 = self.tangent(&moved(&k1, 0.5 * h), t + 0.5 * h, patch)?;
        let k3 = self.tangent(&moved(&k2, 0.5 * h), t + 0.5 * h, patch)?;
        let k4 = self.tangent(&moved(&k3, h), t + h, patch)?;
        Some(std::array::from_fn(|i| x[i] + (k1[i] + (k2[i] + k3[i]) * 2.0 + k4[i]) * (h / 6.0)))
    }

    /// Follows the path that begins at `start`.
    pub fn follow(&self, start: &Study, care: Care) -> End {
        let (mut x, mut t, mut h) = (*start, 0.0, care.longest);
        for _ in 0..MOST_STEPS {
            let size = 1.0 / norm(&x);
            x.iter_mut().for_each(|z| *z *= size);
            let patch = x.map(Complex::conj);
            // What is left is no step of its own.
            let step = if t + h > 1.0 - SHORTEST { 1.0 - t } else { h };
            match self.step(&x, t, step, &patch, care) {
                Some((next, off)) => {
                    x = next;
                    t += step;
                    if step == 1.0 - (t - step) || t >= 1.0 {
                        return self.ended(x, &patch);
                    }
                    h = (step * (0.8 * (care.off / off.max(1e-300)).powf(0.2)).clamp(0.2, 2.0))
                        .min(care.longest);
                }
                None => h = 0.4 * step,
            }
            if h < SHORTEST {
                break;
            }
        }
        if t > NEAR_END {
            x = self.settled(x);
        }
        End { x, is_reached: false }
    }

    /// A point near the end where Newton's method is slow, as it is where solutions meet.
    fn settled(&self, start: Study) -> Study {
        let patch = start.map(Complex::conj);
        let (mut x, mut last) = (start, f64::INFINITY);
        for _ in 0..100 {
            let Some((next, size)) = self.corrected(&x, 1.0, &patch) else { break };
            if size > 0.9 * last {
                break;
            }
            (x, last) = (next, size);
        }
        x
    }

    /// The point of the path at t + h, and how far it was from the predicted one.
    fn step(&self, x: &Study, t: f64, h: f64, patch: &Study, care: Care) -> Option<(Study, f64)> {
        let guess = self.predicted(x, t, h, patch)?;
        let (mut next, first) = self.corrected(&guess, t + h, patch)?;
        if first > 10.0 * care.off {
            return None;
        }
        let mut last = first;
        for _ in 0..3 {
            if last < ON_PATH {
                return Some((next, first));
            }
            let (better, size) = self.corrected(&next, t + h, patch)?;
            if size > 0.1 * last {
                return None;
            }
            (next, last) = (better, size);
        }
        (last < ON_PATH).then_some((next, first))
    }

    /// The end of a path as well as doubles hold it.
    fn ended(&self, x: Study, patch: &Study) -> End {
        let (mut best, mut smallest) = (x, f64::INFINITY);
        for _ in 0..10 {
            let Some((next, size)) = self.corrected(&best, 1.0, patch) else { break };
            if size >= smallest {
                break;
            }
            (best, smallest) = (next, size);
            if size < AT_END {
                break;
            }
        }
        End { x: best, is_reached: smallest < 1e-6 }
    }
}
