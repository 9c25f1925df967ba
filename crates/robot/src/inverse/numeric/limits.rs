//! What the joints may do: limits as a descent keeps to them, and configurations to start from.

use crate::description::JointKind;
use crate::mechanism::{Link, Robot};
use crate::random::Random;
use crate::space::{JointSpace, wrapped};
use std::f64::consts::{PI, TAU};

/// The range of each joint, radians and metres.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Limits {
    /// What a descent keeps to: infinite for a joint that can turn all round, which is brought back by whole turns.
    pub low: Vec<f64>,
    /// The same from above.
    pub high: Vec<f64>,
    /// As described.
    given: Vec<Option<[f64; 2]>>,
    /// True if a whole turn of the joint moves nothing.
    is_periodic: Vec<bool>,
    /// Ranges that cover all that starts need to cover.
    start: Vec<[f64; 2]>,
}

impl Limits {
    /// Those of a robot; of lengths without limits, starts take as much as the arm's size.
    pub fn new(robot: &Robot<f64>, space: &JointSpace) -> Self {
        let n = robot.joints;
        // A joint whose turns also move a length, or of which an angle takes a fraction, is not the same after one.
        let is_whole = |j: usize| {
            let mut movers = robot.links.iter().flat_map(Link::movers).filter(|m| m.joint == j);
            movers.all(|m| m.kind == JointKind::Revolute && m.factor.fract() == 0.0)
        };
        let is_periodic: Vec<bool> = (0..n).map(|j| space.is_angle[j] && is_whole(j)).collect();
        let (mut low, mut high, mut start) = (vec![], vec![], vec![]);
        for (j, limits) in space.limits.iter().enumerate() {
            let half = if space.is_angle[j] { PI } else { space.reach };
            let [l, h] = limits.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
            let all_round = is_periodic[j] && h - l >= TAU;
            low.push(if all_round { f64::NEG_INFINITY } else { l });
            high.push(if all_round { f64::INFINITY } else { h });
            start.push(match (l.is_finite(), h.is_finite()) {
                (true, true) if is_periodic[j] && h - l > TAU => [0.5 * (l + h) - PI, 0.5 * (l + h) + PI],
                (true, true) => [l, h],
                (true, false) => [l, l + 2.0 * half],
                (false, true) => [h - 2.0 * half, h],
                (false, false) => [-half, half],
            });
        }
        Limits { low, high, given: space.limits.clone(), is_periodic, start }
    }

    /// Brings a start into the limits, by whole turns where these lead there.
    pub fn admit(&self, q: &mut [f64]) {
        for (j, x) in q.iter_mut().enumerate() {
            let [l, h] = [self.low[j], self.high[j]];
            if !(l..=h).contains(x) && self.is_periodic[j] {
                let middle = 0.5 * (l + h);
                *x = middle + wrapped(*x - middle);
            }
            *x = x.max(l).min(h);
        }
    }

    /// Joints that went round return: to the copy within the limits that is nearest to `near`, or else to (−π, π].
    pub fn settle(&self, q: &mut [f64], near: Option<&[f64]>) {
        for (j, x) in q.iter_mut().enumerate() {
            if !self.is_periodic[j] {
                continue;
            }
            let wanted = near.map_or(0.0, |n| n[j]);
            match self.given[j] {
                _ if !self.low[j].is_infinite() || !self.high[j].is_infinite() => {}
                None => *x = wanted + wrapped(*x - wanted),
                Some([l, h]) => {
                    let mut y = wanted + wrapped(*x - wanted);
                    if y > h {
                        y -= ((y - h) / TAU).ceil() * TAU;
                    } else if y < l {
                        y += ((l - y) / TAU).ceil() * TAU;
                    }
                    *x = y.max(l).min(h);
                }
            }
        }
    }

    /// The middle and half the range of a joint that has limits.
    pub fn middle(&self, j: usize) -> Option<[f64; 2]> {
        let [l, h] = self.given[j]?;
        let half = 0.5 * (h - l);
        (half.is_finite() && half > 0.0).then_some([0.5 * (l + h), half])
    }

    /// A configuration to start from, the same for each number.
    pub fn start(&self, number: u64, q: &mut Vec<f64>) {
        let mut random = Random(number.wrapping_mul(0xD6E8_FEB8_6659_FD93));
        q.clear();
        q.extend(self.start.iter().map(|[l, h]| l + (h - l) * random.unit()));
    }
}
