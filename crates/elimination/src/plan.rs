//! The ways to solve an arm in their order: a plan, and the ranking from which it is built again without measuring.

use crate::{
    answer::Answer,
    arm::{Arm, Joint},
    determinant::DEGREE,
    fourier::Fourier,
    instructions::{Instructions, Portable},
    rigid::{Rigid, dot},
    slides::Sliding,
    solve::{Constants, Method, Task, Way, solve},
    split::Split,
    triple::Triple,
    wide,
};

/// Whether products inside sums are fused: where every processor of the target has instructions for it.
const FUSED: bool = cfg!(any(target_arch = "aarch64", target_feature = "fma"));

/// The splits of an arm in the order in which they are solved, and their constants.
#[derive(Clone, Debug)]
pub struct Plan {
    pub(crate) constants: Constants,
    pub(crate) method: Method,
}

/// Why an arm has no plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unsuitable {
    /// The Jacobian is singular everywhere: the tool cannot be moved in all six directions.
    Singular,
    /// More than three slides: the tool cannot be turned in all directions.
    TooManySlides,
    /// A number is not finite, or a rotation is not orthogonal.
    NotRigid,
    /// No split recovers configurations of the arm.
    NoSplit,
}

impl std::fmt::Display for Unsuitable {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Unsuitable::Singular => "the Jacobian is singular at every configuration",
            Unsuitable::TooManySlides => "an arm with more than three slides cannot reach poses in general",
            Unsuitable::NotRigid => "a link is not a rigid transform",
            Unsuitable::NoSplit => "the elimination degenerates in every split of the loop",
        })
    }
}

impl std::error::Error for Unsuitable {}

/// Which ways to solve an arm, in their order: what [`Plan::new`] measures and [`Plan::ranked`] takes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Ranking {
    /// At most one slide: the hidden joint (0 to 5), and whether the last joint of the trio is multiplied.
    Splits(Vec<(usize, bool)>),
    /// Two slides: the turn (0 to 3) that the ring starts at, whether it is read forwards, the power, and the degree.
    Slides(Vec<(usize, bool, usize, usize)>),
    /// Three slides: the one way there is.
    Triple,
}

impl Plan {
    /// The plan with a ranking of [`Plan::ranking`]: nothing is measured, which takes microseconds.
    ///
    /// # Errors
    /// If the arm is not rigid, or the ranking is not one of such an arm.
    pub fn ranked(arm: &Arm, ranking: &Ranking) -> Result<Plan, Unsuitable> {
        check(arm)?;
        let size = arm.size();
        let scaled = arm.scaled(1.0 / size);
        let constants =
            Constants { arm: scaled, size, fourier: Fourier::new(DEGREE), wide: Fourier::new(wide::DEGREE) };
        let arm = &constants.arm;
        let is_empty = match ranking {
            Ranking::Splits(ways) => ways.is_empty(),
            Ranking::Slides(ways) => ways.is_empty(),
            Ranking::Triple => false,
        };
        let method = match ranking {
            Ranking::Splits(ways) => {
                let one = |&(hidden, last)| if hidden < 6 { Split::new(arm, hidden, last) } else { None };
                ways.iter().map(one).collect::<Option<Vec<Split>>>().map(Method::Splits)
            }
            Ranking::Slides(ways) => {
                let one = |&(first, forwards, power, degree)| {
                    if first < 4 { Sliding::settled(arm, first, forwards, power, degree) } else { None }
                };
                ways.iter().map(one).collect::<Option<Vec<Sliding>>>().map(Method::Slides)
            }
            Ranking::Triple => Triple::new(arm).map(|triple| Method::Triple(Box::new(triple))),
        };
        let method = method.filter(|_| !is_empty).ok_or(Unsuitable::NoSplit)?;
        Ok(Plan { constants, method })
    }

    /// Which ways are tried, in their order.
    pub fn ranking(&self) -> Ranking {
        match &self.method {
            Method::Splits(splits) => {
                Ranking::Splits(splits.iter().map(|s| (s.joints[2], s.last_multiplied)).collect())
            }
            Method::Slides(ways) => {
                let joints = &self.constants.arm.joints;
                let turns_before =
                    |joint: usize| joints[..joint].iter().filter(|&&kind| kind == Joint::Revolute).count();
                let one = |w: &Sliding| (turns_before(w.turns[0]), w.sign > 0.0, w.power, w.degree);
                Ranking::Slides(ways.iter().map(one).collect())
            }
            Method::Triple(_) => Ranking::Triple,
        }
    }

    /// All configurations at a pose, on the instructions that every processor of the target has; slides and translations
    /// in the arm's unit.
    pub(crate) fn solve_portably(&self, pose: &Rigid, answer: &mut Answer) {
        self.solve_as::<Portable<FUSED>>(pose, answer);
    }

    /// The same on a set of instructions.
    pub(crate) fn solve_as<I: Instructions>(&self, pose: &Rigid, answer: &mut Answer) {
        solve::<I>(&self.constants, Task::Answer(&self.method), &self.target(pose), answer);
    }

    /// The pose, lengths divided by the arm's size.
    pub(crate) fn target(&self, pose: &Rigid) -> Rigid {
        pose.scaled(1.0 / self.constants.size)
    }

    /// The hidden joint (0 to 5) of each way to solve, in the order in which they are tried.
    pub fn hidden(&self) -> Vec<usize> {
        let ways = (0..).map_while(|turn| self.method.way(turn));
        ways.filter(|way| !way.is_wide()).map(Way::hidden).collect()
    }
}

/// Whether the links are rigid, and not too many joints slide.
pub(crate) fn check(arm: &Arm) -> Result<(), Unsuitable> {
    for rigid in arm.links.iter().chain([&arm.base]) {
        let straight = rigid.rotation.iter().enumerate().all(|(i, a)| {
            rigid
                .rotation
                .iter()
                .enumerate()
                .all(|(k, b)| (dot(*a, *b) - f64::from(u8::from(i == k))).abs() < 1e-6)
        });
        if !straight || !rigid.translation.iter().all(|x| x.is_finite()) {
            return Err(Unsuitable::NotRigid);
        }
    }
    if arm.joints.iter().filter(|&&joint| joint == Joint::Prismatic).count() > 3 {
        return Err(Unsuitable::TooManySlides);
    }
    Ok(())
}
