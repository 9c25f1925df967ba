//! Redundant arms: more joints than the hand can use, so that configurations of a pose form curves.
//!
//! | arm | parameter |
//! |---|---|
//! | spherical shoulder, elbow, spherical wrist | the arm angle ψ, in closed form with its limits (`arm_angle`) |
//! | a closed form for given joints | the last of these joints (`joint`) |
//! | any other with a joint too many | the length along the curve (`curves`) |
//!
//! What all share: pieces of curves with the intervals that the limits allow ([`Component`]), and the search for the
//! best member by a [`Criterion`]. Configurations are wrapped to (−π, π]; "within the limits" counts copies whole turns
//! away, as everywhere ([`JointSpace::within`]).

mod arcs;
mod arm_angle;
mod criterion;
mod curves;
mod feasible;
mod joint;
mod limits;
mod locked;
mod manifold;
mod spherical;

pub use criterion::Criterion;
pub use manifold::{Component, Manifold};

use super::answer::{Doubt, Solution};
use super::branch::Branch;
use super::derivation::{Extent, Goal, InverseModel, InverseOptions};
use super::newton;
use super::self_motion::Frame;
use crate::description::Description;
use crate::geometry::Transform;
use crate::mechanism::{MissingValue, Robot};
use crate::space::{JointSpace, wrapped};
use arm_angle::ArmAngle;
use curves::ByCurve;
use joint::ByJoint;
use limits::{Range, SLACK, excess};
use manifold::{Chart, Found, Piece};
use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

/// A residual above this is more than rounding, and Newton's method lowers it.
const ROUGH: f64 = 1e-13;
/// A configuration is a solution up to this residual.
const SOLVED: f64 = 1e-9;
/// Neighbours on a sampled curve differ by no more.
const FINE: f64 = 0.1;
/// Parts of a sampled curve at first, and how often each may be halved.
const PARTS: usize = 48;
const HALVINGS: usize = 14;
/// Members that a curve is known by are not many more: where there would be, rounding moves it.
const MOST: usize = 3000;

/// Finds the configurations of poses for a redundant robot with numbers.
#[derive(Clone, Debug)]
pub struct RedundantSolver {
    /// The robot that is moved.
    pub robot: Robot<f64>,
    /// Its joints.
    pub space: JointSpace,
    /// What of the hand is given.
    pub goal: Goal,
    /// How many joints there are too many.
    pub surplus: usize,
    ranges: Vec<Range>,
    method: Method,
    kept: Kept,
}

#[derive(Clone, Debug)]
enum Method {
    ArmAngle(Box<ArmAngle>),
    Joint(Box<ByJoint>),
    Curve(Box<ByCurve>),
}

/// The pieces of the pose that was asked about last: all solutions of a pose, and then the best of them, are asked for.
#[derive(Debug, Default)]
struct Kept(Mutex<Option<OfPose>>);

/// A pose, and its pieces.
type OfPose = (Transform<f64>, Arc<Vec<Piece>>);

impl Kept {
    fn of(&self, pose: &Transform<f64>, pieces: impl FnOnce() -> Vec<Piece>) -> Arc<Vec<Piece>> {
        let lock = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, kept)) = lock().as_ref().filter(|k| k.0 == *pose) {
            return kept.clone();
        }
        let pieces = Arc::new(pieces());
        *lock() = Some((*pose, pieces.clone()));
        pieces
    }
}

impl Clone for Kept {
    fn clone(&self) -> Self {
        Kept::default()
    }
}

/// Why there is no solver for a robot.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum NotSolved {
    /// A parameter has no value.
    Missing(MissingValue),
    /// The arm has no joint too many.
    NotRedundant,
    /// The arm has this many joints too many, and no closed form for as many given ones.
    NoClosedForm(usize),
}

impl fmt::Display for NotSolved {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NotSolved::Missing(why) => write!(f, "{why}"),
            NotSolved::NotRedundant => f.write_str("the arm has no more joints than its hand can use"),
            NotSolved::NoClosedForm(n) => {
                write!(f, "the arm has {n} joints too many, and no closed form for {n} given ones")
            }
        }
    }
}

impl std::error::Error for NotSolved {}

impl From<MissingValue> for NotSolved {
    fn from(missing: MissingValue) -> Self {
        NotSolved::Missing(missing)
    }
}

impl RedundantSolver {
    /// For a description; which parameter serves follows from the arm's geometry.
    ///
    /// # Errors
    /// See [`NotSolved`].
    pub fn new(description: &Description, goal: Goal) -> Result<Self, NotSolved> {
        let robot = Robot::numeric(description)?;
        let space = JointSpace::new(description, &robot);
        let surplus = robot.joints.saturating_sub(newton::rank(&robot, goal));
        if surplus == 0 {
            return Err(NotSolved::NotRedundant);
        }
        let method = Self::method_for(description, goal, &robot, &space, surplus)?;
        let ranges = Range::all(&space);
        Ok(RedundantSolver { robot, space, goal, surplus, ranges, method, kept: Kept::default() })
    }

    fn method_for(
        description: &Description,
        goal: Goal,
        robot: &Robot<f64>,
        space: &JointSpace,
        surplus: usize,
    ) -> Result<Method, NotSolved> {
        if goal == Goal::Pose
            && let Some(arm) = ArmAngle::recognise(description, robot, space)
        {
            return Ok(Method::ArmAngle(Box::new(arm)));
        }
        match InverseModel::derive_for(description, &InverseOptions { goal, given: None }, Extent::Steps) {
            Ok(model) if !model.given.is_empty() => {
                Ok(Method::Joint(Box::new(ByJoint::new(&model, description, robot, space)?)))
            }
            _ if surplus == 1 => Ok(Method::Curve(Box::new(ByCurve::new(robot, goal, space)))),
            _ => Err(NotSolved::NoClosedForm(surplus)),
        }
    }

    /// The names of all parameters that configurations of a pose have.
    pub fn free(&self) -> Vec<String> {
        match &self.method {
            Method::Joint(by) => by.names.clone(),
            Method::ArmAngle(_) | Method::Curve(_) => vec![self.parameter().to_string()],
        }
    }

    /// The parameter of the components: `ψ`, the name of a joint variable, or `s`.
    pub fn parameter(&self) -> &str {
        match &self.method {
            Method::ArmAngle(_) => "ψ",
            Method::Joint(by) => &by.name,
            Method::Curve(_) => "s",
        }
    }

    /// The value of the parameter at a configuration, on whatever component; nothing for the length along a curve, which
    /// has no zero of its own.
    ///
    /// # Panics
    /// If there is not one entry per joint.
    pub fn parameter_at(&self, q: &[f64]) -> Option<f64> {
        assert_eq!(q.len(), self.robot.joints, "one entry per joint");
        match &self.method {
            Method::ArmAngle(arm) => arm.angle_of(q),
            Method::Joint(by) => by.given.last().map(|&j| q[j]),
            Method::Curve(_) => None,
        }
    }

    /// All configurations of a pose of the tool in the base.
    pub fn manifold(&self, pose: &Transform<f64>) -> Manifold {
        let pose = &newton::nearest_rigid(pose).0;
        let pieces = self.pieces(pose);
        let components = pieces.iter().filter_map(|piece| self.component(pose, piece.clone())).collect();
        Manifold { components, dimension: self.surplus, doubt: self.doubt() }
    }

    /// The member of a component at a value of its parameter, for the pose that the component was made for; nothing
    /// outside its domain.
    pub fn member(&self, pose: &Transform<f64>, component: &Component, value: f64) -> Option<Solution> {
        let pose = &newton::nearest_rigid(pose).0;
        let q = self.configuration(pose, &component.chart, value)?;
        self.solution(pose, Found { q, guard: None, branch: component.branch.clone() })
    }

    /// The best member within the limits by a criterion; nothing if there is none.
    pub fn best(&self, pose: &Transform<f64>, criterion: &Criterion) -> Option<Solution> {
        let pose = &newton::nearest_rigid(pose).0;
        let mut best: Option<(f64, Vec<f64>, Branch)> = None;
        for piece in self.pieces(pose).iter() {
            for interval in &piece.feasible {
                let found = criterion::least(*interval, |x| {
                    let q = self.configuration(pose, &piece.chart, x)?;
                    Some(criterion.cost((&self.frame(), self.rank()), &self.space, &q))
                });
                let Some((x, cost)) = found else { continue };
                if best.as_ref().is_none_or(|b| cost < b.0)
                    && let Some(q) = self.configuration(pose, &piece.chart, x)
                {
                    best = Some((cost, q, piece.branch.clone()));
                }
            }
        }
        match best {
            Some((_, q, branch)) => self.solution(pose, Found { q, guard: None, branch }),
            // A single place that the limits allow is no interval.
            None => self.within_limits(pose, None),
        }
    }

    /// One configuration within the limits, found quickly: the parameter is tried at a few values, from that of `seed`
    /// on, before feasible intervals are computed. Nothing if there is none (see [`Manifold::doubt`] for how sure that
    /// is).
    pub fn within_limits(&self, pose: &Transform<f64>, seed: Option<&[f64]>) -> Option<Solution> {
        let pose = &newton::nearest_rigid(pose).0;
        let quick = match &self.method {
            Method::ArmAngle(arm) => arm.within(pose, seed),
            Method::Curve(by) => by.within(pose, seed),
            Method::Joint(by) => by.quick(pose, seed),
        };
        match (quick, &self.method) {
            (Some(found), _) => return self.solution(pose, found),
            (None, Method::Joint(_)) => {}
            (None, _) => return None,
        }
        for piece in self.pieces(pose).iter().filter(|p| !p.feasible.is_empty()) {
            let ends = piece.feasible.iter().flatten().copied();
            for x in std::iter::once(piece.middle()).chain(ends) {
                if let Some(q) = self.configuration(pose, &piece.chart, x)
                    && excess(&self.ranges, &q) <= SLACK
                {
                    return self.solution(pose, Found { q, guard: None, branch: piece.branch.clone() });
                }
            }
        }
        None
    }

    fn doubt(&self) -> Option<Doubt> {
        match &self.method {
            Method::ArmAngle(_) => None,
            Method::Joint(_) => Some(Doubt::Sampled),
            Method::Curve(by) if by.is_systematic() => Some(Doubt::Sampled),
            Method::Curve(_) => Some(Doubt::Searched),
        }
    }

    fn pieces(&self, pose: &Transform<f64>) -> Arc<Vec<Piece>> {
        self.kept.of(pose, || match &self.method {
            Method::ArmAngle(arm) => arm.pieces(pose),
            Method::Joint(by) => by.pieces(pose),
            Method::Curve(by) => by.pieces(pose),
        })
    }

    fn configuration(&self, pose: &Transform<f64>, chart: &Chart, x: f64) -> Option<Vec<f64>> {
        match (&self.method, chart) {
            (Method::ArmAngle(arm), &Chart::ArmAngle { elbow, shoulder, wrist }) => {
                arm.member(pose, (elbow, shoulder, wrist), x)
            }
            (Method::Joint(by), Chart::Joint { signs, others }) => by.member(pose, (signs, others), x),
            (Method::Curve(by), chart) => by.member(pose, chart, x),
            _ => None,
        }
    }

    fn frame(&self) -> Frame<'_> {
        let size = self.space.length();
        Frame { robot: &self.robot, goal: self.goal, is_angle: &self.space.is_angle, size }
    }

    /// A configuration as a solution, polished where it is not exact.
    fn solution(&self, pose: &Transform<f64>, found: Found) -> Option<Solution> {
        let Found { mut q, guard, branch } = found;
        let size = self.space.size(pose);
        let mut residual = newton::distance(&self.robot, self.goal, pose, &q, size);
        if residual > ROUGH
            && let Some((better, missed)) = newton::polish(&self.robot, self.goal, pose, &q, &[], size)
            && missed < residual
        {
            (q, residual) = (better, missed);
        }
        if residual > SOLVED {
            return None;
        }
        self.space.wrap(&mut q);
        let residual = newton::distance(&self.robot, self.goal, pose, &q, size);
        let guard = guard.unwrap_or_else(|| {
            let values = self.frame().singular(&q).values;
            values.get(self.rank().wrapping_sub(1)).copied().unwrap_or(0.0)
        });
        let within_limits = excess(&self.ranges, &q) <= SLACK;
        Some(Solution { branch, guard, ..Solution::found(q, residual, within_limits) })
    }

    fn rank(&self) -> usize {
        self.robot.joints - self.surplus
    }

    fn component(&self, pose: &Transform<f64>, piece: Piece) -> Option<Component> {
        let q = self.configuration(pose, &piece.chart, piece.middle())?;
        let representative = self.solution(pose, Found { q, guard: None, branch: piece.branch.clone() })?;
        let frame = self.frame();
        let null = frame.singular(&representative.q).vectors.pop()?;
        let direction: Vec<f64> = null.iter().enumerate().map(|(j, x)| x * frame.unit(j)).collect();
        let by = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
        let direction = direction.iter().map(|x| x / by).collect();
        let curve = match &piece.chart {
            Chart::Curve { members, .. } => members.clone(),
            _ => self.sampled(pose, &piece),
        };
        let Piece { branch, parameter, domain, feasible, is_closed, chart } = piece;
        Some(Component {
            branch,
            parameter,
            domain,
            feasible,
            is_closed,
            representative,
            direction,
            curve,
            chart,
        })
    }

    /// Members all along the domain of a piece, without jumps of whole turns.
    fn sampled(&self, pose: &Transform<f64>, piece: &Piece) -> Vec<Vec<f64>> {
        let [low, high] = piece.domain;
        let mut found: Vec<Vec<f64>> = vec![];
        let push = |found: &mut Vec<Vec<f64>>, mut q: Vec<f64>| {
            if let Some(last) = found.last() {
                let moved = self.space.moved(last, &q);
                q = last.iter().zip(moved).map(|(x, d)| x + d).collect();
            }
            found.push(q);
        };
        let mut left: Option<(f64, Vec<f64>)> = None;
        for k in 0..=PARTS {
            let x = low + (high - low) * k as f64 / PARTS as f64;
            let Some(q) = self.configuration(pose, &piece.chart, x) else { continue };
            // What is to come, the nearest last.
            let mut ahead = vec![(x, q, 0)];
            while let Some((y, p, halvings)) = ahead.pop() {
                if let Some((before, from)) = &left
                    && halvings < HALVINGS
                    && found.len() < MOST
                    && self.space.distance(from, &p) > FINE
                {
                    let middle = (before + y) / 2.0;
                    if let Some(q) = self.configuration(pose, &piece.chart, middle) {
                        ahead.push((y, p, halvings + 1));
                        ahead.push((middle, q, halvings + 1));
                        continue;
                    }
                }
                push(&mut found, p.clone());
                left = Some((y, p));
            }
        }
        found
    }
}
