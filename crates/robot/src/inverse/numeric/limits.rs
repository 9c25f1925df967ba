//! What the joints may do: limits as a descent keeps to them, and configurations to start from.

use crate::random::Random;
use crate::space::{JointSpace, within};

/// The range of each joint, radians and metres.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Limits {
    /// What a descent keeps to: infinite for a joint that can turn all round, which is brought back by whole turns.
    pub low: Vec<f64>,
    /// The same from above.
    pub high: Vec<f64>,
    /// As described.
    given: Vec<Option<[f64; 2]>>,
    /// By what a joint can be moved with every link back where it was; infinite if there is no such motion.
    periods: Vec<f64>,
    /// Ranges that cover all that starts need to cover.
    start: Vec<[f64; 2]>,
}

impl Limits {
    /// Those of a robot; of lengths without limits, starts take as much as the arm's size.
    pub fn new(space: &JointSpace) -> Self {
        let periods = space.turning.periods.clone();
        let (mut low, mut high, mut start) = (vec![], vec![], vec![]);
        for (j, limits) in space.limits.iter().enumerate() {
            let half = space.half_range(j);
            let [l, h] = limits.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
            let all_round = h - l >= periods[j] && periods[j].is_finite();
            low.push(if all_round { f64::NEG_INFINITY } else { l });
            high.push(if all_round { f64::INFINITY } else { h });
            start.push(match (l.is_finite(), h.is_finite()) {
                (true, true) if all_round => [0.5 * (l + h - periods[j]), 0.5 * (l + h + periods[j])],
                (true, true) => [l, h],
                (true, false) => [l, l + 2.0 * half],
                (false, true) => [h - 2.0 * half, h],
                (false, false) => [-half, half],
            });
        }
        Limits { low, high, given: space.limits.clone(), periods, start }
    }

    /// Brings a start into the limits, by whole turns where these lead there.
    pub fn admit(&self, q: &mut [f64]) {
        for (j, x) in q.iter_mut().enumerate() {
            let [l, h] = [self.low[j], self.high[j]];
            if !(l..=h).contains(x) && self.periods[j].is_finite() {
                let middle = 0.5 * (l + h);
                *x = middle + within(*x - middle, self.periods[j]);
            }
            *x = x.max(l).min(h);
        }
    }

    /// Joints that went round return: to the copy within the limits that is nearest to `near`, or else to (−π, π].
    pub fn settle(&self, q: &mut [f64], near: Option<&[f64]>) {
        for (j, x) in q.iter_mut().enumerate() {
            let period = self.periods[j];
            if period.is_infinite() {
                continue;
            }
            let wanted = near.map_or(0.0, |n| n[j]);
            match self.given[j] {
                _ if !self.low[j].is_infinite() || !self.high[j].is_infinite() => {}
                None => *x = wanted + within(*x - wanted, period),
                Some([l, h]) => {
                    let mut y = wanted + within(*x - wanted, period);
                    if y > h {
                        y -= ((y - h) / period).ceil() * period;
                    } else if y < l {
                        y += ((l - y) / period).ceil() * period;
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
