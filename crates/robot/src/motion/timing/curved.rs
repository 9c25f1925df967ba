//! Stages with viscous friction, whose torque grows with ṡ = √x and not with x.
//!
//! At the start of an interval a limit is a u + b x + k √x ≤ 1, at its end the same with x' = x + 2Δu. From a given x the former are
//! bounds of u, the latter quadratic inequalities in √x', so that the greatest x' is found exactly: from above, each limit that is
//! exceeded takes x' down to the next place at which it is not. What friction leaves at a point need not be one interval of x (a motion
//! may be too fast for a torque at medium speeds, and not at high ones), so the x from which the next point can be reached are found
//! from above, too, by steps and by halving.

use super::grid::Sampled;
use super::stage::{NEGLIGIBLE, Stage};
use super::torques::Torques;

/// Into how many steps the x below a bound are divided,
const STEPS: u32 = 16;
/// beside those that are so near to the greatest at the next point.
const NEAR: [f64; 5] = [0.0, 1e-3, 4e-3, 1.6e-2, 6.4e-2];
/// The bounds of x are found to this part of them,
const PRECISION: f64 = 1e-10;
/// unless they are nearly 0.
const HALVINGS: u32 = 128;
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// a, b and k of a limit.
pub(super) type Row = [f64; 3];

/// The limits of an interval, those at its start and those at its end.
#[derive(Default)]
pub(super) struct Curves {
    start: Vec<Row>,
    end: Vec<Row>,
}

/// A stage with such limits beside those that are lines.
pub(super) struct CurvedStage<'a> {
    pub(super) stage: Stage<'a>,
    pub(super) curves: &'a Curves,
}

/// The limits of all intervals.
pub(super) fn curves(torques: &Torques<'_>, grid: &Sampled) -> Vec<Curves> {
    let mut all = vec![];
    for i in 0..grid.s.len() - 1 {
        let mut curves = Curves::default();
        for (joint, range) in torques.ranges().iter().enumerate() {
            let [start, end] = torques.ends(i, joint);
            // Where the joint turns round, friction is met in both directions.
            let [f_least, f_most] = torques.friction(i, joint);
            for (f, limit) in [(f_most, range.upper), (f_least, range.lower)] {
                for (t, rows) in [(start, &mut curves.start), (end, &mut curves.end)] {
                    let left = limit - t.c - f;
                    rows.push([t.a / left, t.b / left, t.k / left]);
                }
            }
        }
        all.push(curves);
    }
    all
}

impl CurvedStage<'_> {
    /// The least and the greatest x from which some u leads into the bounds of the next grid point; `None` if none is found.
    pub(super) fn controllable(&self) -> Option<[f64; 2]> {
        let [first, last] = self.stage.next();
        let highest = self.stage.highest();
        let mut tried: Vec<f64> = (0..=STEPS).map(|k| highest * f64::from(k) / f64::from(STEPS)).collect();
        // It changes little from a grid point to the next.
        let near = NEAR.into_iter().flat_map(|part| [last * (1.0 - part), last * (1.0 + part)]);
        tried.extend(near.chain([first]).filter(|x| *x < highest));
        tried.sort_by(f64::total_cmp);
        let is_open = |x: f64| self.forward(x).is_some();
        let top = tried.iter().rposition(|&x| is_open(x))?;
        let high = tried.get(top + 1).map_or(tried[top], |&shut| self.border(tried[top], shut));
        let bottom = tried.iter().position(|&x| is_open(x))?;
        let low = if bottom == 0 { tried[0] } else { self.border(tried[bottom], tried[bottom - 1]) };
        Some([low.min(high), high])
    }

    /// The greatest x below `x` and not below `low` from which the next grid point can be reached.
    pub(super) fn below(&self, x: f64, low: f64) -> Option<f64> {
        let mut shut = x;
        for k in (0..4 * STEPS).rev() {
            let tried = low + (x - low) * f64::from(k) / f64::from(4 * STEPS);
            if self.forward(tried).is_some() {
                return Some(self.border(tried, shut));
            }
            shut = tried;
        }
        None
    }

    /// Between an x from which there is a way and one from which there is none: the last with a way.
    fn border(&self, mut open: f64, mut shut: f64) -> f64 {
        for _ in 0..HALVINGS {
            if (open - shut).abs() <= PRECISION * open.max(shut) {
                break;
            }
            let middle = f64::midpoint(open, shut);
            if self.forward(middle).is_some() {
                open = middle;
            } else {
                shut = middle;
            }
        }
        open
    }

    /// The greatest x at the next grid point that can be reached from `x`.
    pub(super) fn forward(&self, x: f64) -> Option<f64> {
        let (step, share) = (self.stage.step(), self.stage.share());
        let [mut low, mut high] = self.stage.reached(x)?;
        let speed = x.sqrt();
        for &[a, b, k] in &self.curves.start {
            let left = share - b * x - k * speed;
            if (a * self.stage.highest()).abs() <= NEGLIGIBLE * step {
                if left < 0.0 {
                    return None;
                }
                continue;
            }
            let there = x + step * left / a;
            if a > 0.0 {
                high = high.min(there);
            } else {
                low = low.max(there);
            }
        }
        let rounding = ROUNDING * (low.abs() + high.abs() + x);
        if high < low - rounding {
            return None;
        }
        let mut speed = high.max(low).max(0.0).sqrt();
        loop {
            let from = speed;
            for &[a, b, k] in &self.curves.end {
                // a (x' − x)/2Δ + b x' + k √x' ≤ 1
                let slope = a / step;
                speed = lowered(slope + b, k, share + slope * x, speed)?;
            }
            if speed == from {
                break;
            }
        }
        let [first, last] = self.stage.next();
        let found = speed * speed;
        (found >= low - rounding).then(|| found.max(first).min(last))
    }
}

/// The greatest v ≤ `from` that is not negative and has α v² + k v ≤ γ.
fn lowered(alpha: f64, k: f64, gamma: f64, from: f64) -> Option<f64> {
    let parts = [alpha * from * from, k * from, -gamma];
    let rounding = ROUNDING * parts.iter().map(|p| p.abs()).sum::<f64>();
    if parts.iter().sum::<f64>() <= rounding {
        return Some(from);
    }
    let discriminant = k * k + 4.0 * alpha * gamma;
    if discriminant < 0.0 {
        return None;
    }
    // (−k ± √…)/2α, without a difference of what is nearly the same.
    let half = -0.5 * (k + discriminant.sqrt().copysign(k));
    // Where it grows, it is less just below.
    let roots = [half / alpha, -gamma / half].into_iter();
    roots.filter(|v| (0.0..from).contains(v) && 2.0 * alpha * v + k >= 0.0).reduce(f64::max)
}
