//! Inverse kinematics of closed loops: the driven and the passive joints with which a frame is where it is wanted.
//!
//! It is the assembly of another linkage ([`Linkage::towards`]). Where that is one dyad after the other, all solutions are found; what
//! else is unknown is sought by Newton's method from many starts, and there may be more.

use super::{Assembly, Loops, Open};
use crate::description::linkage::{Mode, NotTowards, Towards, Wanted};
use crate::description::{JointKind, Linkage, MissingValue};
use crate::geometry::Transform;
use crate::random::Random;
use crate::space::wrapped;
use std::f64::consts::PI;
use std::fmt;

/// Configurations from which Newton's method starts.
const STARTS: usize = 48;
/// Joints that are nearer are the same, radians and parts of the size.
const SAME: f64 = 1e-6;

/// The inverse problem of a linkage.
pub struct ClosedInverse {
    loops: Loops,
    towards: Towards,
    /// The linkage with its frame held where it is wanted.
    held: Loops,
}

/// A configuration in which the frame is where it is wanted.
#[derive(Clone, PartialEq, Debug)]
pub struct ClosedSolution {
    /// The driven joints, q1 first.
    pub q: Vec<f64>,
    /// The passive joints, p1 first.
    pub passive: Vec<f64>,
    /// The assembly mode of the linkage; none where it was not told, as where modes meet.
    pub mode: Option<Mode>,
    /// How far closures are open, and the frame is from where it is wanted.
    pub residual: f64,
    /// Whether it is not isolated: singular, or one of a family.
    pub is_singular: bool,
}

/// What was found of an inverse problem.
#[derive(Clone, PartialEq, Debug)]
pub struct ClosedAnswer {
    /// The solutions.
    pub solutions: Vec<ClosedSolution>,
    /// Whether these are all.
    pub is_complete: bool,
    /// Whether they are by dyads alone.
    pub is_closed_form: bool,
    /// Whether what is wanted is out of the plane in which the frame moves.
    pub is_out_of_plane: bool,
}

/// Why there is no inverse problem.
#[derive(Clone, PartialEq, Debug)]
pub enum NoInverse {
    /// A parameter has no value.
    Missing(MissingValue),
    /// There is no such frame.
    Frame(NotTowards),
}

impl fmt::Display for NoInverse {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NoInverse::Missing(why) => why.fmt(f),
            NoInverse::Frame(why) => why.fmt(f),
        }
    }
}

impl ClosedInverse {
    /// That of a frame of a linkage, of the one at which a chain would end where none is named.
    ///
    /// # Errors
    /// If a parameter has no value, or there is no such frame.
    pub fn new(linkage: &Linkage, tip: Option<&str>, wanted: Wanted) -> Result<Self, NoInverse> {
        let loops = Loops::new(linkage).map_err(NoInverse::Missing)?;
        let towards = linkage.towards(tip, wanted).map_err(NoInverse::Frame)?;
        let held = Loops::new(&towards.linkage).map_err(NoInverse::Missing)?;
        Ok(ClosedInverse { loops, towards, held })
    }

    /// The linkage itself.
    pub fn loops(&self) -> &Loops {
        &self.loops
    }

    /// The frame that is asked about.
    pub fn tip(&self) -> &str {
        &self.towards.tip
    }

    /// Whether it is one dyad after the other.
    pub fn is_closed_form(&self) -> bool {
        self.held.rest.is_empty()
    }

    /// The configurations in which the frame has a pose, or its position.
    pub fn solve(&self, pose: &Transform<f64>) -> ClosedAnswer {
        let is_closed_form = self.is_closed_form();
        let mut answer = ClosedAnswer {
            solutions: vec![],
            is_complete: is_closed_form,
            is_closed_form,
            is_out_of_plane: false,
        };
        let Some(driven) = self.towards.driven(pose) else {
            (answer.is_out_of_plane, answer.is_complete) = (true, true);
            return answer;
        };
        let outcomes = self.held.tried(&driven);
        answer.is_complete &= outcomes.len() == self.held.plan.count();
        let starts = if is_closed_form { vec![] } else { self.starts() };
        for (mode, outcome) in outcomes {
            match outcome {
                Ok(found) => self.take(&mut answer, &driven, &found),
                Err(Open::Indeterminate { .. } | Open::NotFound | Open::Undecided { .. }) => {
                    answer.is_complete = false;
                }
                Err(_) => {}
            }
            for near in &starts {
                if let Ok(found) = self.held.assembly_near(&driven, &mode, Some(near)) {
                    self.take(&mut answer, &driven, &found);
                }
            }
        }
        answer
    }

    /// Configurations of the linkage here and there, its loops closed where that is found at once.
    fn starts(&self) -> Vec<Vec<f64>> {
        let mut random = Random(0x1EC5);
        let mut any = |kinds: &[JointKind]| -> Vec<f64> {
            let one = |kind: &JointKind| match kind {
                JointKind::Revolute => PI * (2.0 * random.unit() - 1.0),
                JointKind::Prismatic => self.loops.size * (2.0 * random.unit() - 1.0),
            };
            kinds.iter().map(one).collect()
        };
        let [driven, passive] = &self.towards.places;
        let modes = self.loops.plan.modes();
        (0..STARTS)
            .map(|k| {
                let mut near = any(self.held.passive());
                let q = any(self.loops.driven());
                driven.iter().zip(&q).for_each(|(&at, x)| near[at] = *x);
                if let Some(mode) = modes.get(k % modes.len().max(1))
                    && let Ok(found) = self.loops.assembly(&q, mode)
                {
                    passive.iter().zip(&found.passive).for_each(|(&at, x)| near[at] = *x);
                }
                near
            })
            .collect()
    }

    /// Takes a solution that is not there yet.
    fn take(&self, answer: &mut ClosedAnswer, driven: &[f64], found: &Assembly) {
        let [q, passive] = self
            .towards
            .places
            .each_ref()
            .map(|places| places.iter().map(|&k| found.passive[k]).collect::<Vec<f64>>());
        let near = |a: &[f64], b: &[f64], kinds: &[JointKind]| {
            a.iter().zip(b).zip(kinds).all(|((a, b), kind)| match kind {
                JointKind::Revolute => wrapped(a - b).abs() <= SAME,
                JointKind::Prismatic => (a - b).abs() <= SAME * self.loops.size,
            })
        };
        let is_same = |s: &ClosedSolution| {
            near(&s.q, &q, self.loops.driven()) && near(&s.passive, &passive, self.loops.passive())
        };
        // By dyads different signs give the same only where these meet.
        let may_be_same = found.is_numeric || !found.flat.is_empty();
        if may_be_same && answer.solutions.iter().any(is_same) {
            return;
        }
        let fits = |mode: &Mode| {
            self.loops
                .assembly_near(&q, mode, Some(&passive))
                .is_ok_and(|a| near(&a.passive, &passive, self.loops.passive()))
        };
        let mut fitting = self.loops.plan.modes().into_iter().filter(fits);
        let mode = fitting.next().filter(|_| fitting.next().is_none());
        let is_singular = !found.flat.is_empty() || self.held.passive_rates(driven, &found.passive).is_err();
        answer.solutions.push(ClosedSolution { q, passive, mode, residual: found.residual, is_singular });
    }
}
