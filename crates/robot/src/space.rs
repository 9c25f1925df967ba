//! The space of the joints: which of them turn, how configurations differ, what the limits allow.

use crate::geometry::{Transform, Vector};
use crate::random::Random;
use std::cmp::Ordering;
use std::f64::consts::{PI, TAU};

/// Solutions this near (radians, and lengths by the reach) are the same: two roots that coincide differ by as much.
const SAME: f64 = 2e-6;
/// Beside a displacement this part of it is what numbers of double precision still tell well.
const DIGITS: f64 = 1e-5;
/// What a joint may be beyond its limit, for rounding, in its unit.
const SLACK: f64 = 1e-9;

/// The space of the joint variables of a robot with numbers.
#[derive(Clone, PartialEq, Debug)]
pub struct JointSpace {
    /// Whether a joint turns (radians) or slides (metres).
    pub is_angle: Vec<bool>,
    /// The lowest and the highest value of a joint, where they are known.
    pub limits: Vec<Option<[f64; 2]>>,
    /// A length that slides are compared with: the sum of the robot's lengths, metres.
    pub reach: f64,
    /// Where the robot stands in the base, metres: the origin, or far from it (see
    /// [`Robot::foot`](crate::mechanism::Robot::foot)).
    pub foot: Vector<f64>,
    /// By what joints can be moved so that every link comes back to where it was.
    pub turning: Periods,
}

/// By what joints can be moved so that every link comes back to where it was: a whole turn, two turns of a joint that is
/// geared down to a half, half a turn of one that is geared up to twice its angle.
#[derive(Clone, PartialEq, Debug)]
pub struct Periods {
    /// By what each joint alone can be moved, radians; infinite for one that slides.
    pub periods: Vec<f64>,
    /// The range in which solutions are listed, the smallest multiple of the period that is a whole turn or more.
    pub windows: Vec<f64>,
    /// Further motions within the windows: all of them together with whole windows are all that there are.
    pub copies: Vec<Vec<f64>>,
    /// Whether that is so; copies too many to be listed are left out.
    pub all_copies: bool,
}

impl Periods {
    /// Those of joints without gears: whole turns of those that turn.
    pub fn whole_turns(is_angle: impl IntoIterator<Item = bool>) -> Self {
        let periods: Vec<f64> =
            is_angle.into_iter().map(|turns| if turns { TAU } else { f64::INFINITY }).collect();
        Periods { windows: periods.clone(), periods, copies: vec![], all_copies: true }
    }

    /// Whether a whole turn of a joint brings all links back.
    pub(crate) fn goes_round(&self, joint: usize) -> bool {
        (TAU / self.periods[joint]).fract() == 0.0 && self.periods[joint].is_finite()
    }

    /// Leaves out copies for which one of these joints would have to move.
    pub fn keep(&mut self, joints: &[usize]) {
        self.copies.retain(|c| joints.iter().all(|&j| c[j] == 0.0));
    }

    /// Those of some of the joints, the others held.
    fn held(&self, joints: &[usize]) -> Self {
        let of = |x: &[f64]| -> Vec<f64> { joints.iter().map(|&j| x[j]).collect() };
        let is_still = |c: &&Vec<f64>| (0..c.len()).all(|j| c[j] == 0.0 || joints.contains(&j));
        let copies = self.copies.iter().filter(is_still).map(|c| of(c)).collect();
        Periods {
            periods: of(&self.periods),
            windows: of(&self.windows),
            copies,
            all_copies: self.all_copies,
        }
    }
}

impl JointSpace {
    /// The space of the joints that are not held.
    pub fn held(&self, held: &[usize]) -> Self {
        let left = |j: &usize| !held.contains(j);
        let joints: Vec<usize> = (0..self.is_angle.len()).filter(left).collect();
        JointSpace {
            is_angle: joints.iter().map(|&j| self.is_angle[j]).collect(),
            limits: joints.iter().map(|&j| self.limits[j]).collect(),
            reach: self.reach,
            foot: self.foot,
            turning: self.turning.held(&joints),
        }
    }

    /// How the joints differ, those that turn by the shorter way.
    pub fn moved(&self, from: &[f64], to: &[f64]) -> Vec<f64> {
        let pairs = from.iter().zip(to).zip(&self.turning.periods);
        pairs.map(|((x, y), &period)| within(y - x, period)).collect()
    }

    /// What lengths are compared with: the reach, or 1 m for an arm without lengths.
    pub fn length(&self) -> f64 {
        if self.reach > 0.0 { self.reach } else { 1.0 }
    }

    /// What displacements of the hand are compared with at a pose.
    pub(crate) fn size(&self, pose: &Transform<f64>) -> f64 {
        self.length().hypot(self.away(pose)).hypot(DIGITS * self.foot.norm())
    }

    /// How far the hand is from where the robot stands, metres.
    pub(crate) fn away(&self, pose: &Transform<f64>) -> f64 {
        (pose.translation - self.foot).norm()
    }

    /// True if the robot stands so far from the origin that a pose has too few digits for what lies close together.
    pub(crate) fn is_remote(&self) -> bool {
        self.length() < DIGITS * self.foot.norm()
    }

    /// What a joint is measured in: a radian, or the length.
    pub fn unit(&self, joint: usize) -> f64 {
        if self.is_angle[joint] { 1.0 } else { self.length() }
    }

    /// How the joints differ, each in its unit.
    pub fn way(&self, from: &[f64], to: &[f64]) -> Vec<f64> {
        let mut way = self.moved(from, to);
        way.iter_mut().enumerate().for_each(|(j, x)| *x /= self.unit(j));
        way
    }

    /// The largest difference of a joint, in its unit.
    pub fn distance(&self, a: &[f64], b: &[f64]) -> f64 {
        let pairs = a.iter().zip(b).zip(&self.turning.periods).enumerate();
        pairs.fold(0.0, |most, (j, ((x, y), &period))| (within(y - x, period).abs() / self.unit(j)).max(most))
    }

    /// The configuration halfway from one to another, whole windows left aside; how far each joint is from it at most, in its
    /// unit, beside it.
    pub fn halfway(&self, a: &[f64], b: &[f64]) -> (Vec<f64>, f64) {
        let half = |((x, y), &window): ((&f64, &f64), &f64)| 0.5 * within(y - x, window);
        let ways: Vec<f64> = a.iter().zip(b).zip(&self.turning.windows).map(half).collect();
        let most = ways.iter().enumerate().fold(0.0_f64, |most, (j, way)| most.max(way.abs() / self.unit(j)));
        (a.iter().zip(&ways).map(|(x, way)| x + way).collect(), most)
    }

    /// True if two configurations are one, but for rounding and whole turns.
    pub fn is_same(&self, a: &[f64], b: &[f64]) -> bool {
        self.distance(a, b) <= SAME
    }

    /// True if two configurations are one entry of a list: the same but for rounding and whole windows.
    pub fn is_listed_as(&self, a: &[f64], b: &[f64]) -> bool {
        let pairs = a.iter().zip(b).zip(&self.turning.windows).enumerate();
        pairs.fold(true, |same, (j, ((x, y), &window))| {
            same && within(y - x, window).abs() <= SAME * self.unit(j)
        })
    }

    /// The middle of the limits; 0 where there are none.
    pub fn middle(&self) -> Vec<f64> {
        self.limits.iter().map(|l| l.map_or(0.0, |[low, high]| f64::midpoint(low, high))).collect()
    }

    /// Brings angles to (−π, π], those of geared joints to the range in which solutions are listed.
    pub fn wrap(&self, q: &mut [f64]) {
        for (x, &window) in q.iter_mut().zip(&self.turning.windows) {
            *x = within(*x, window);
        }
    }

    /// The configuration and its copies in the range in which solutions are listed, in the order of their joints' values.
    pub fn copies(&self, q: &[f64]) -> Vec<Vec<f64>> {
        let moved = |by: &Vec<f64>| q.iter().zip(by).map(|(x, d)| x + d).collect();
        let mut all: Vec<Vec<f64>> = self.turning.copies.iter().map(moved).collect();
        all.push(q.to_vec());
        all.iter_mut().for_each(|q| self.wrap(q));
        all.sort_by(|a, b| {
            a.iter().zip(b).map(|(x, y)| x.total_cmp(y)).find(|o| o.is_ne()).unwrap_or(Ordering::Equal)
        });
        all
    }

    /// How many windows (whole turns of a joint without gears) joint `j` may be moved by from `x` within its limits: the
    /// fewest and the most; nothing if the limits exclude all. A joint without limits, and one that slides, stays where
    /// it is.
    pub fn turns(&self, j: usize, x: f64) -> Option<[i32; 2]> {
        self.times(j, x, self.turning.windows[j])
    }

    /// How many configurations the limits allow of those that are whole windows away from one, itself among them.
    pub fn copies_within(&self, q: &[f64]) -> u64 {
        let of = |(j, &x)| self.turns(j, x).map_or(0, |[fewest, most]| u64::from(most.abs_diff(fewest)) + 1);
        q.iter().enumerate().map(of).fold(1, u64::saturating_mul)
    }

    /// These configurations, the nearest first (the one with the fewest windows in all), at most so many.
    pub fn listed_copies(&self, q: &[f64], most: usize) -> Vec<Vec<f64>> {
        let Some(turns) = q.iter().enumerate().map(|(j, &x)| self.turns(j, x)).collect::<Option<Vec<_>>>()
        else {
            return vec![];
        };
        // Windows by joint and, before the list grows too long, the fewest in all: sorted after each joint.
        let mut all: Vec<(i64, Vec<f64>)> = vec![(0, vec![])];
        for (j, &[fewest, highest]) in turns.iter().enumerate() {
            let (x, window) = (q[j], self.turning.windows[j]);
            let by = |k: i64| if k == 0 { x } else { x + k as f64 * window };
            // What is so far from the nearest is not listed anyhow.
            let (fewest, highest) = (i64::from(fewest), i64::from(highest));
            let span = i64::try_from(most).unwrap_or(i64::from(i32::MAX));
            let ks = fewest.max(highest.min(0) - span)..=highest.min(fewest.max(0) + span);
            let longer = |(sum, q): &(i64, Vec<f64>)| -> Vec<(i64, Vec<f64>)> {
                let with = |k: i64| (sum + k.abs(), q.iter().copied().chain([by(k)]).collect());
                ks.clone().map(with).collect()
            };
            all = all.iter().flat_map(longer).collect();
            all.sort_by_key(|a| a.0);
            all.truncate(most);
        }
        all.into_iter().map(|a| a.1).collect()
    }

    /// How many times a period joint `j` may be moved by from `x` within its limits.
    fn times(&self, j: usize, x: f64, period: f64) -> Option<[i32; 2]> {
        let Some([low, high]) = self.limits[j] else { return Some([0, 0]) };
        let (low, high) = (low - SLACK * self.unit(j), high + SLACK * self.unit(j));
        if period.is_infinite() {
            return (low..=high).contains(&x).then_some([0, 0]);
        }
        let fewest = ((low - x) / period).ceil() as i32;
        let most = ((high - x) / period).floor() as i32;
        (fewest <= most).then_some([fewest, most])
    }

    /// True if the limits allow a configuration itself.
    pub fn is_inside(&self, q: &[f64]) -> bool {
        let slack = |j: usize| SLACK * self.unit(j);
        let allows = |(j, &x): (usize, &f64)| {
            self.limits[j].is_none_or(|[low, high]| (low - slack(j)..=high + slack(j)).contains(&x))
        };
        q.iter().enumerate().all(allows)
    }

    /// True if the limits allow a configuration, or a copy of it whole turns away.
    pub fn within(&self, q: &[f64]) -> bool {
        (0..q.len()).all(|j| self.turns(j, q[j]).is_some())
    }

    /// The copy of a configuration, each joint moved by its periods, that the limits allow and that is nearest to another;
    /// a joint for which they allow none goes to the nearest copy.
    pub fn nearest_copy(&self, q: &[f64], to: &[f64]) -> Vec<f64> {
        let pairs = q.iter().zip(to).enumerate();
        pairs
            .map(|(j, (&x, &y))| {
                let period = self.turning.periods[j];
                if period.is_infinite() {
                    return x;
                }
                let times = ((y - x) / period).round();
                match (self.limits[j], self.times(j, x, period)) {
                    (Some(_), Some([fewest, most])) => x + period * times.clamp(fewest.into(), most.into()),
                    _ => x + period * times,
                }
            })
            .collect()
    }

    /// A configuration anywhere, with slides up to `size` either way, metres.
    pub(crate) fn anywhere(&self, random: &mut Random, size: f64) -> Vec<f64> {
        let half = |j: usize| if self.is_angle[j] { self.half_range(j) } else { size };
        (0..self.is_angle.len()).map(|j| (2.0 * random.unit() - 1.0) * half(j)).collect()
    }

    /// Half of what a joint needs to take all its places, radians or metres.
    pub fn half_range(&self, j: usize) -> f64 {
        let period = self.turning.periods[j];
        match self.is_angle[j] {
            true if period.is_finite() => 0.5 * period,
            true => PI,
            false => self.length(),
        }
    }
}

/// A number brought to (−half a period, half a period]; itself, if the period is infinite.
pub(crate) fn within(x: f64, period: f64) -> f64 {
    if period.is_infinite() {
        return x;
    }
    let y = x - period * (x / period).round();
    if y <= -0.5 * period { y + period } else { y }
}

/// The angle in (−π, π].
pub(crate) fn wrapped(x: f64) -> f64 {
    within(x, TAU)
}

pub(crate) fn norm(v: &[f64]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}
