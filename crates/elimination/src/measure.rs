//! Offline: which splits of an arm's loop to solve, and in which order.
//!
//! Which split is good for an arm is not guessed from its geometry but measured: each is tried on the same
//! pseudo-random poses.

use crate::{
    answer::Answer,
    arm::{Arm, Joint, smallest_singular_value},
    certificate::Verdict,
    determinant::DEGREE,
    fourier::Fourier,
    instructions::Strict,
    plan::{Plan, Unsuitable, check},
    rigid::Rigid,
    slides::Sliding,
    solve::{Constants, Method, Task, Way, solve},
    split::Split,
    triple::Triple,
    wide,
    work::Work,
};

/// Poses on which every split is tried, and the best of them again.
const POSES: [usize; 2] = [32, 96];
/// The same where any good split will do.
const FEW: [usize; 2] = [8, 8];

/// A pose with a configuration that has it.
type Pose = ([f64; 6], Rigid);

/// What a way to solve did on the poses.
#[derive(Clone, Copy, Debug, Default)]
struct Score {
    poses: usize,
    missed: usize,
    certified: usize,
    /// Sum of the numbers of charts and of candidates, which cost time.
    effort: usize,
}

impl Score {
    /// The larger the better: certified poses, then little effort.
    fn merit(&self) -> f64 {
        let n = self.poses.max(1) as f64;
        (self.certified as f64 - 4.0 * self.missed as f64) / n - 0.002 * self.effort as f64 / n
    }

    /// Whether it is worth using.
    fn usable(&self) -> bool {
        2 * self.missed < self.poses && self.certified > 0
    }

    /// Counts one pose.
    fn add(&mut self, arm: &Arm, q: &[f64; 6], verdict: Verdict, work: &Work) {
        self.poses += 1;
        self.certified += usize::from(verdict == Verdict::Certified);
        self.effort += work.effort;
        let known = work.found.iter().any(|found| {
            (0..6).all(|i| {
                let [c, s] = found.values[i];
                match arm.joints[i] {
                    Joint::Revolute => (c - q[i].cos()).abs() + (s - q[i].sin()).abs() < 1e-5,
                    Joint::Prismatic => (c - q[i]).abs() < 1e-5,
                }
            })
        });
        self.missed += usize::from(!known);
    }
}

impl Plan {
    /// Measures every split on deterministic pseudo-random poses and ranks them.
    ///
    /// # Errors
    /// If the arm has no isolated configurations in general, or no split works for it.
    pub fn new(arm: &Arm) -> Result<Plan, Unsuitable> {
        Plan::measured(arm, POSES)
    }

    /// The same from a tenth of the poses: a good split, if not the best, where few poses are solved.
    ///
    /// # Errors
    /// See [`Plan::new`].
    pub fn quick(arm: &Arm) -> Result<Plan, Unsuitable> {
        Plan::measured(arm, FEW)
    }

    fn measured(arm: &Arm, count: [usize; 2]) -> Result<Plan, Unsuitable> {
        let size = arm.size();
        let scaled = arm.scaled(1.0 / size);
        check(arm)?;
        if is_singular(&scaled) {
            return Err(Unsuitable::Singular);
        }
        let constants =
            Constants { arm: scaled, size, fourier: Fourier::new(DEGREE), wide: Fourier::new(wide::DEGREE) };
        let mut draws = Draws(0x9e37_79b9_7f4a_7c15);
        let poses: Vec<Pose> = (0..count[0] + count[1])
            .map(|_| {
                let q = draws.configuration(&constants.arm);
                (q, constants.arm.pose(&q))
            })
            .collect();

        let poses = poses.split_at(count[0]);
        let slides = arm.joints.iter().filter(|&&joint| joint == Joint::Prismatic).count();
        let arm = &constants.arm;
        let method = match slides {
            0 | 1 => {
                let ways = (0..6)
                    .flat_map(|hidden| [true, false].map(|last| Split::new(arm, hidden, last)))
                    .flatten()
                    .collect();
                Method::Splits(rank(&constants, ways, poses, |split| Way::Split { split, wide: false }))
            }
            2 => {
                let some: Vec<Rigid> = poses.0[..6].iter().map(|(_, pose)| *pose).collect();
                let ways = (0..4)
                    .flat_map(|first| [true, false].map(|forwards| Sliding::new(arm, first, forwards)))
                    .flatten()
                    .filter_map(|mut way| way.settle(arm, &some).then_some(way))
                    .collect();
                Method::Slides(rank(&constants, ways, poses, |way| Way::Slides(way)))
            }
            _ => Method::Triple(Box::new(Triple::new(arm).ok_or(Unsuitable::TooManySlides)?)),
        };
        let empty = match &method {
            Method::Splits(ways) => ways.is_empty(),
            Method::Slides(ways) => ways.is_empty(),
            Method::Triple(_) => false,
        };
        if empty { Err(Unsuitable::NoSplit) } else { Ok(Plan { constants, method }) }
    }
}

/// Tries all ways on the poses; the best for each hidden joint, the best of them first. Products are not fused: the order
/// is the same on every processor.
fn rank<W>(
    constants: &Constants,
    ways: Vec<W>,
    (some, more): (&[Pose], &[Pose]),
    as_way: impl Fn(&W) -> Way<'_>,
) -> Vec<W> {
    let mut answer = Answer::default();
    let mut tried: Vec<(W, Score)> = ways.into_iter().map(|way| (way, Score::default())).collect();
    let mut measure = |(way, score): &mut (W, Score), poses: &[Pose]| {
        for (q, pose) in poses {
            let verdict = solve::<Strict>(constants, Task::Trial(as_way(way)), pose, &mut answer);
            score.add(&constants.arm, q, verdict, &answer.work);
            // Not worth more time.
            if score.poses == 5 && (score.missed > 3 || score.certified == 0) {
                break;
            }
        }
    };
    let order = |a: &(W, Score), b: &(W, Score)| b.1.merit().total_cmp(&a.1.merit());
    for one in &mut tried {
        measure(one, some);
    }
    tried.sort_by(order);
    for one in tried.iter_mut().take(4) {
        measure(one, more);
    }
    tried.sort_by(order);
    let mut seen = [false; 6];
    tried.retain(|(way, score)| score.usable() && !std::mem::replace(&mut seen[as_way(way).hidden()], true));
    tried.into_iter().map(|(way, _)| way).collect()
}

/// Whether the Jacobian is singular wherever it is looked at.
fn is_singular(scaled: &Arm) -> bool {
    let mut draws = Draws(0x2545_f491_4f6c_dd1d);
    (0..9).all(|_| {
        let q = draws.configuration(scaled);
        smallest_singular_value(scaled.jacobian(&q)) < 1e-9
    })
}

/// Pseudo-random numbers (Marsaglia's xorshift with a multiplier).
struct Draws(u64);

impl Draws {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Angles anywhere, slides between −1 and 1 times the arm's size.
    fn configuration(&mut self, scaled: &Arm) -> [f64; 6] {
        scaled.joints.map(|joint| match joint {
            Joint::Revolute => (2.0 * self.next() - 1.0) * std::f64::consts::PI,
            Joint::Prismatic => 2.0 * self.next() - 1.0,
        })
    }
}
