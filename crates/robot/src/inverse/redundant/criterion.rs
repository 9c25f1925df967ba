//! The best configuration of a manifold by a criterion.

use crate::inverse::derivation::Goal;
use crate::inverse::newton;
use crate::inverse::self_motion::Frame;
use crate::mechanism::Robot;
use crate::space::JointSpace;

/// What makes a configuration good.
#[derive(Clone, PartialEq, Debug)]
pub enum Criterion {
    /// Near to these joint variables: the least sum of squares of the differences, radians, and slides by the reach;
    /// whole turns within the limits are free.
    Nearest(Vec<f64>),
    /// In the middle of the limits: the largest distance of a joint from its nearer limit, by half its range, for the
    /// joint for which it is least.
    FarthestFromLimits,
    /// Able to move the hand in every direction: the largest smallest singular value of the Jacobian, lengths by the
    /// reach.
    FarthestFromSingularity,
}

/// Values on an interval before the best is closed in on.
const VALUES: usize = 24;
/// Divisions of the interval around it.
const DIVISIONS: usize = 50;

impl Criterion {
    /// How bad a configuration of a robot is: less is better.
    pub(in crate::inverse) fn of(
        &self,
        robot: &Robot<f64>,
        space: &JointSpace,
        goal: Goal,
        q: &[f64],
    ) -> f64 {
        let frame = Frame { robot, goal, is_angle: &space.is_angle, size: space.length() };
        self.cost((&frame, newton::rank(robot, goal)), space, q)
    }

    /// How bad a configuration is; the Jacobian has `rank` singular values that are not 0 in general.
    pub(super) fn cost(&self, (frame, rank): (&Frame, usize), space: &JointSpace, q: &[f64]) -> f64 {
        match self {
            Criterion::Nearest(to) => {
                let copy = space.nearest_copy(q, to);
                (0..q.len()).map(|j| ((copy[j] - to[j]) / frame.unit(j)).powi(2)).sum()
            }
            Criterion::FarthestFromLimits => {
                let middle = space.middle();
                let copy = space.nearest_copy(q, &middle);
                let used = |j: usize| {
                    let [low, high] = space.limits[j]?;
                    Some((copy[j] - middle[j]).abs() / ((high - low) / 2.0).max(1e-12) - 1.0)
                };
                (0..q.len()).filter_map(used).fold(-1.0, f64::max)
            }
            Criterion::FarthestFromSingularity => {
                let values = frame.singular(q).values;
                -values.get(rank.wrapping_sub(1)).copied().unwrap_or(0.0)
            }
        }
    }
}

/// The place with the least cost between two, and that cost.
pub(super) fn least([low, high]: [f64; 2], mut cost: impl FnMut(f64) -> Option<f64>) -> Option<(f64, f64)> {
    let at = |k: usize| if k == VALUES { high } else { low + (high - low) * k as f64 / VALUES as f64 };
    let values: Vec<f64> = (0..=VALUES).map(|k| cost(at(k)).unwrap_or(f64::INFINITY)).collect();
    let mut order: Vec<usize> = (0..=VALUES)
        .filter(|&k| values[k].is_finite())
        .filter(|&k| k == 0 || values[k] <= values[k - 1])
        .filter(|&k| k == VALUES || values[k] <= values[k + 1])
        .collect();
    order.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
    let mut best: Option<(f64, f64)> = None;
    for k in order.into_iter().take(3) {
        let (mut a, mut b) = (at(k.saturating_sub(1)), at((k + 1).min(VALUES)));
        let golden = (5.0_f64.sqrt() - 1.0) / 2.0;
        let (mut x, mut y) = (b - golden * (b - a), a + golden * (b - a));
        let mut costs = [x, y].map(|p| cost(p).unwrap_or(f64::INFINITY));
        for _ in 0..DIVISIONS {
            if costs[0] <= costs[1] {
                (b, y, costs[1]) = (y, x, costs[0]);
                x = b - golden * (b - a);
                costs[0] = cost(x).unwrap_or(f64::INFINITY);
            } else {
                (a, x, costs[0]) = (x, y, costs[1]);
                y = a + golden * (b - a);
                costs[1] = cost(y).unwrap_or(f64::INFINITY);
            }
            if b - a <= 1e-10 {
                break;
            }
        }
        for (place, value) in [(at(k), values[k]), (x, costs[0]), (y, costs[1])] {
            if best.is_none_or(|b| value < b.1) && value.is_finite() {
                best = Some((place, value));
            }
        }
    }
    best
}
