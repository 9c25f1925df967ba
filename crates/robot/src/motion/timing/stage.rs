//! The linear programs of the stages, in the two variables u = s̈ and x = ṡ².
//!
//! A limit lo ≤ a u + b x ≤ hi with a ≠ 0 is a strip between two parallel lines u = lo/a − (b/a) x and hi/a − (b/a) x.
//! At a given x the strips leave an interval of u: from the highest lower line L(x) to the lowest upper line U(x).
//! U − L is concave and piecewise linear, so the extreme x with U(x) ≥ L(x) is found by Newton's method from outside,
//! which ends at the vertex itself after a few steps.

use super::Scheme;
use super::curved::{CurvedStage, Curves, curves};
use super::grid::Sampled;
use super::torques::Torques;
use crate::motion::error::MotionError;
use crate::motion::limits::{Limits, Range};

/// A strip is left out if no possible u makes more of it than this share: then it bounds x alone.
pub(super) const NEGLIGIBLE: f64 = 1e-13;
/// Speeds that nothing limits are at most this times the highest that something limits.
const UNLIMITED: f64 = 1e3;

/// Slope b/a, lower and upper line at x = 0.
pub(super) type Strip = [f64; 3];

/// All stages of a path.
pub(super) struct Program {
    /// Parameters of the grid.
    pub(super) s: Vec<f64>,
    /// Greatest x at the grid points.
    pub(super) highest: Vec<f64>,
    /// Shares of the acceleration limits in use, an entry an interval: 1, or less where they were exceeded between.
    pub(super) share: Vec<f64>,
    /// Greatest x of each stage by strips that bound x alone, at a share of 1.
    flat: Vec<f64>,
    /// `rows` of them a stage.
    strips: Vec<Strip>,
    rows: usize,
    /// What is no strip, an entry an interval; none at all without viscous friction.
    curves: Vec<Curves>,
}

/// One stage with the x of the next grid point between two bounds.
pub(super) struct Stage<'a> {
    strips: &'a [Strip],
    share: f64,
    highest: f64,
    /// 1 / 2Δ
    slope: f64,
    next: [f64; 2],
}

pub(super) fn program(
    grid: &Sampled,
    limits: &Limits,
    scheme: Scheme,
    torques: Option<&Torques<'_>>,
) -> Result<Program, MotionError> {
    let (n, dof) = (grid.s.len() - 1, grid.dof);
    let rows = match scheme {
        Scheme::Collocation => dof,
        Scheme::Interpolation => 2 * dof,
        Scheme::Throughout => 4 * dof + 4,
    };
    let (straight, curved) = match torques {
        Some(torques) if torques.has_roots() => (None, curves(torques, grid)),
        _ => (torques, vec![]),
    };
    let rows = rows + if straight.is_some() { 4 * dof } else { 0 };
    let inverse = inverses(limits);
    let mut program = Program {
        s: grid.s.clone(),
        highest: speeds(grid, &inverse)?,
        share: vec![1.0; n],
        flat: Vec::with_capacity(n),
        strips: Vec::with_capacity(n * rows),
        rows,
        curves: curved,
    };
    for i in 0..n {
        let step = 2.0 * (grid.s[i + 1] - grid.s[i]);
        // No u is greater in magnitude than this.
        let reach = program.highest[i].max(program.highest[i + 1]) / step;
        let mut flat = f64::INFINITY;
        let entries = i * dof..(i + 1) * dof;
        for (joint, entry) in entries.enumerate() {
            let range = limits.acceleration()[joint];
            let mut add = |[a, b]: [f64; 2]| program.strips.push(strip(a, b, range, reach, &mut flat));
            let [a, b, c] = [0, 1, 2].map(|k| grid.behind[k][entry]);
            add([a, b]);
            if scheme == Scheme::Collocation {
                continue;
            }
            // A third of the way along the tangent, q̈ + Δ/3 dq̈/ds with dq̈/ds = 3 q'' u + q''' x.
            if scheme == Scheme::Throughout {
                add([a + step / 2.0 * b, b + step / 6.0 * c]);
            }
            // At the next point x is x + 2Δu: (a + 2Δb) u + b x.
            let [a, b, c] = [0, 1, 2].map(|k| grid.before[k][entry + dof]);
            add([a + step * b, b]);
            if scheme == Scheme::Throughout {
                let (a, b) = (a - step / 2.0 * b, b - step / 6.0 * c);
                add([a + step * b, b]);
            }
        }
        if scheme == Scheme::Throughout {
            let within = Range { lower: f64::NEG_INFINITY, upper: 1.0 };
            for [a, b] in velocities(grid, i, step, limits.velocity()) {
                program.strips.push(strip(a, b, within, reach, &mut flat));
            }
        }
        if let Some(torques) = straight {
            torques.strips(i, step, reach, &mut flat, &mut program.strips);
        }
        program.flat.push(flat);
    }
    Ok(program)
}

/// Bounds of the velocities within interval `i`, a u + b x ≤ 1: the inner control points of g = (q'/limit)² x, taken as
/// a cubic, of the joints that are the fastest at its start and at its end. With w = (q'/limit)², so that
/// g' = w' x + 2 w u, they are g + Δ g'/3 at the start and g − Δ g'/3 at the end.
fn velocities(grid: &Sampled, i: usize, step: f64, limits: &[Range]) -> [[f64; 2]; 4] {
    let (here, there) = (i * grid.dof..(i + 1) * grid.dof, (i + 1) * grid.dof..(i + 2) * grid.dof);
    let first = [0, 1].map(|k| &grid.behind[k][here.clone()]);
    let last = [0, 1].map(|k| &grid.before[k][there.clone()]);
    let share = |tangents: &[f64], joint: usize| limits[joint].share(tangents[joint]);
    let fastest = |tangents: &[f64]| {
        (1..grid.dof).fold(0, |best, j| if share(tangents, j) > share(tangents, best) { j } else { best })
    };
    // w and Δ w'/3, or zeros where a limit of zero forbids all motion.
    let weight = |[dq, ddq]: [&[f64]; 2], joint: usize| {
        let w = share(dq, joint);
        let limit = if w == 0.0 { f64::INFINITY } else { dq[joint] / w };
        if w.is_finite() { [w * w, w * ddq[joint] / limit * step / 3.0] } else { [0.0; 2] }
    };
    let at_start = |joint| {
        let [w, slope] = weight(first, joint);
        [w * step / 3.0, w + slope]
    };
    let at_end = |joint| {
        let [w, slope] = weight(last, joint);
        [(w - slope) * step - w * step / 3.0, w - slope]
    };
    let (a, b) = (fastest(first[0]), fastest(last[0]));
    [at_start(a), at_end(a), at_start(b), at_end(b)]
}

/// The strip of one limit; if it does not depend on u it bounds x, and the strip is the whole plane.
pub(super) fn strip(a: f64, b: f64, range: Range, reach: f64, flat: &mut f64) -> Strip {
    let width = match (range.lower.is_finite(), range.upper.is_finite()) {
        (true, true) => range.upper - range.lower,
        (false, _) => range.upper,
        (true, false) => -range.lower,
    };
    if (a * reach).abs() > NEGLIGIBLE * width {
        let inverse = 1.0 / a;
        let (p, q) = (range.lower * inverse, range.upper * inverse);
        return [b * inverse, p.min(q), p.max(q)];
    }
    if b != 0.0 {
        *flat = flat.min(if b > 0.0 { range.upper / b } else { range.lower / b });
    }
    [0.0, f64::NEG_INFINITY, f64::INFINITY]
}

fn inverses(limits: &Limits) -> Vec<[f64; 2]> {
    limits.velocity().iter().map(|r| r.inverse()).collect()
}

/// The time that s takes at least, by the joint that takes longest. A limit of 0 makes it infinite, or NaN where the
/// joint is not to move, which `max` passes over.
fn longest(dq: &[f64], inverse: &[[f64; 2]]) -> f64 {
    dq.iter().zip(inverse).fold(0.0f64, |m, (d, [low, high])| m.max((d * low).max(d * high)))
}

/// Greatest x at the grid points by the velocity limits; 0 at corners.
fn speeds(grid: &Sampled, inverse: &[[f64; 2]]) -> Result<Vec<f64>, MotionError> {
    let highest = |dq: &[f64]| longest(dq, inverse).powi(-2);
    let mut x: Vec<f64> = grid.behind[0].chunks_exact(grid.dof).map(highest).collect();
    for &corner in &grid.corners {
        x[corner] = 0.0;
    }
    let limited = x.iter().copied().filter(|x| x.is_finite()).fold(f64::NAN, f64::max);
    if limited.is_nan() {
        return Err(MotionError::ZeroLength);
    }
    let cap = UNLIMITED * UNLIMITED * limited;
    x.iter_mut().for_each(|x| *x = x.min(cap));
    Ok(x)
}

impl Program {
    /// Stage `i` with the x of the next grid point within `next`.
    pub(super) fn stage(&self, i: usize, next: [f64; 2]) -> Stage<'_> {
        Stage {
            strips: &self.strips[i * self.rows..(i + 1) * self.rows],
            share: self.share[i],
            highest: self.highest[i].min(self.share[i] * self.flat[i]),
            slope: 0.5 / (self.s[i + 1] - self.s[i]),
            next,
        }
    }

    /// The same with what is no strip; `None` without viscous friction.
    pub(super) fn curved(&self, i: usize, next: [f64; 2]) -> Option<CurvedStage<'_>> {
        self.curves.get(i).map(|curves| CurvedStage { stage: self.stage(i, next), curves })
    }
}

/// A line u = p − r x.
#[derive(Clone, Copy)]
struct Line {
    p: f64,
    r: f64,
}

impl Line {
    fn at(self, x: f64) -> f64 {
        self.p - self.r * x
    }

    /// How far off the value may be.
    fn rounding(self, x: f64) -> f64 {
        4.0 * f64::EPSILON * (self.p.abs() + self.r.abs() * x)
    }
}

impl Stage<'_> {
    /// The least and the greatest x from which some u leads into the bounds of the next grid point; `None` if there is
    /// no such x.
    pub(super) fn controllable(&self) -> Option<[f64; 2]> {
        let (low, high) = (self.extreme(0.0, self.highest)?, self.extreme(self.highest, 0.0)?);
        Some([low.min(high), high]) // a single speed may come out the wrong way round
    }

    /// The greatest x at the next grid point that can be reached from `x`.
    pub(super) fn forward(&self, x: f64) -> f64 {
        let (lower, upper) = self.tightest(x);
        let (low, high) = (lower.at(x), upper.at(x));
        // Where they cross it is by rounding, and that is greater in the steeper line, which hardly depends on u.
        let u = if low > high && upper.rounding(x) > lower.rounding(x) { low } else { high };
        (x + u / self.slope).max(self.next[0]).min(self.next[1])
    }

    /// The least and the greatest x at the next grid point that strips let reach from `x`; `None` if `x` is too fast, or nothing is left.
    pub(super) fn reached(&self, x: f64) -> Option<[f64; 2]> {
        if x > self.highest {
            return None;
        }
        let (lower, upper) = self.tightest(x);
        let (low, high) = (lower.at(x), upper.at(x));
        let is_open = high - low >= -(lower.rounding(x) + upper.rounding(x));
        is_open.then(|| [x + low / self.slope, x + high / self.slope])
    }

    /// The bounds of x at the next grid point.
    pub(super) fn next(&self) -> [f64; 2] {
        self.next
    }

    /// The greatest x at this one.
    pub(super) fn highest(&self) -> f64 {
        self.highest
    }

    /// The share of the limits that is in use.
    pub(super) fn share(&self) -> f64 {
        self.share
    }

    /// 2Δ
    pub(super) fn step(&self) -> f64 {
        1.0 / self.slope
    }

    /// The highest of the lower lines at `x`, and the lowest of the upper ones.
    fn tightest(&self, x: f64) -> (Line, Line) {
        let mut lower = Line { p: self.next[0] * self.slope, r: self.slope };
        let mut upper = Line { p: self.next[1] * self.slope, r: self.slope };
        let (mut low, mut high) = (lower.at(x), upper.at(x));
        for &[r, down, up] in self.strips {
            let (down, up) = (Line { p: down * self.share, r }, Line { p: up * self.share, r });
            let (down_at, up_at) = (down.at(x), up.at(x));
            if down_at > low {
                (lower, low) = (down, down_at);
            }
            if up_at < high {
                (upper, high) = (up, up_at);
            }
        }
        (lower, upper)
    }

    /// The x nearest to `from`, on the way to `to`, at which the lines leave a u.
    fn extreme(&self, from: f64, to: f64) -> Option<f64> {
        let mut x = from;
        // Each step leaves a pair of lines behind for good.
        for _ in 0..4 * self.strips.len() + 8 {
            let (lower, upper) = self.tightest(x);
            let gap = upper.at(x) - lower.at(x);
            let rounding = lower.rounding(x) + upper.rounding(x);
            if gap >= -rounding {
                return Some(x);
            }
            // Where both lines meet; not as a step from x, in whose rounding a small result would be lost.
            let (next, uncertain) =
                ((upper.p - lower.p) / (upper.r - lower.r), rounding / (upper.r - lower.r).abs());
            let towards = if to < from { next < x } else { next > x };
            if !towards || next.is_nan() {
                // Rounding alone holds it back, or the gap does not close in this direction.
                return (gap >= -16.0 * rounding).then_some(x);
            }
            if if to < from { next < to } else { next > to } {
                return ((next - to).abs() <= uncertain).then_some(to);
            }
            x = next;
        }
        Some(x)
    }
}
