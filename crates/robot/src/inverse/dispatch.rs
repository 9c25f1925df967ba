//! Which method serves an arm, and its answers.
//!
//! | arm | method |
//! |---|---|
//! | a closed form is derived | [`InverseSolver`] |
//! | six joints without one, or nearly special | [`GeneralSolver`], the closed form beside it |
//! | six joints, one of which drives several axes (geared wrists) | [`GeneralSolver`] |
//! | more joints than the hand can use | [`RedundantSolver`] |
//! | anything else | descents of [`NumericSolver`] from all over |
//!
//! Nothing is rounded to a special arm here: see [`idealised`](crate::idealise::idealised).

use super::answer::{Answer, Doubt, Family, Solution};
use super::closed::InverseSolver;
use super::derivation::{Extent, Goal, InverseModel, InverseOptions, NotGiven, Refusal};
use super::general::GeneralSolver;
use super::lines;
use super::newton;
use super::numeric::NumericSolver;
use super::redundant::{Criterion, RedundantSolver};
use super::self_motion::follow_loosely;
use crate::description::Description;
use crate::geometry::Transform;
use crate::mechanism::{MissingValue, Robot};
use crate::random::Random;
use crate::shared::Shared;
use crate::space::{JointSpace, norm};
use crate::structure::{NearlySpecial, Structure};
use std::f64::consts::{PI, TAU};
use std::fmt;
use std::num::NonZero;
use std::ops::RangeInclusive;

/// Inverse kinematics of a robot with numbers, by whatever method serves it.
#[derive(Clone, Debug)]
pub struct InverseKinematics {
    /// The robot that is moved.
    pub robot: Robot<f64>,
    /// Its joints.
    pub space: JointSpace,
    /// What of the hand is given.
    pub goal: Goal,
    /// Joint variables (from 0) whose values go with each pose.
    pub given: Vec<usize>,
    /// What is nearly special about the arm: no closed form rests on it.
    pub nearly: Vec<NearlySpecial>,
    /// Where descents start, if they are needed.
    pub seed: Option<Vec<f64>>,
    names: Vec<String>,
    method: Method,
    pub(super) numeric: NumericSolver,
    /// The same where limits do not count.
    pub(super) unlimited: NumericSolver,
}

/// How the solutions are found.
#[derive(Clone, Debug)]
enum Method {
    Closed(Box<InverseSolver>),
    /// By elimination; the closed form beside it, where there is one.
    General(Box<GeneralSolver>, Option<Box<InverseSolver>>),
    /// By elimination for the joints that are not given, at the values that are held.
    Held(Shared<Held>),
    Redundant(Box<RedundantSolver>),
    Numeric,
}

/// The rest of an arm with joints at values: prepared anew where the values change.
#[derive(Clone, Debug, Default)]
struct Held {
    values: Vec<f64>,
    general: Option<Box<GeneralSolver>>,
}

/// Why there is no solver for a robot.
#[derive(Clone, PartialEq, Debug)]
pub enum Unprepared {
    /// A parameter has no value.
    Missing(MissingValue),
    /// Values are given for joints that the arm does not have, or for too many.
    Given(NotGiven),
    /// The arm's lengths add up to so much, metres: powers of it are no numbers of double precision.
    Lengths(f64),
}

impl fmt::Display for Unprepared {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Unprepared::Missing(why) => write!(f, "{why}"),
            Unprepared::Given(why) => write!(f, "{why}"),
            Unprepared::Lengths(reach) => write!(
                f,
                "the arm's lengths add up to {reach:e} m; computed is with {:e} to {:e} m",
                LENGTHS.start(),
                LENGTHS.end()
            ),
        }
    }
}

impl std::error::Error for Unprepared {}

impl From<MissingValue> for Unprepared {
    fn from(missing: MissingValue) -> Self {
        Unprepared::Missing(missing)
    }
}

/// What the lengths of an arm may add up to, metres, if it has any: eighth powers of them are computed.
const LENGTHS: RangeInclusive<f64> = 1e-30..=1e30;

/// A solution that one asked for in particular.
#[derive(Clone, PartialEq, Debug)]
pub struct Nearest {
    /// The joint variables: within the limits if anything is, whole turns from a solution.
    pub q: Vec<f64>,
    /// The largest difference of a joint from what was asked for, radians, and lengths by the reach.
    pub distance: f64,
    /// Whether the limits allow it.
    pub within_limits: bool,
}

impl Nearest {
    /// The copy of a configuration that is nearest to another.
    fn of(space: &JointSpace, q: &[f64], to: &[f64]) -> Self {
        let within_limits = space.within(q);
        let copy = space.nearest_copy(q, to);
        // What the limits do not allow anyhow goes to the nearest copy of all.
        let q = if within_limits {
            copy
        } else {
            to.iter().zip(space.moved(to, q)).map(|(x, d)| x + d).collect()
        };
        let unit = |&is_angle: &bool| if is_angle { 1.0 } else { space.reach };
        let by = |((x, y), is_angle): ((&f64, &f64), &bool)| (x - y).abs() / unit(is_angle);
        let distance = q.iter().zip(to).zip(&space.is_angle).map(by).fold(0.0, f64::max);
        Nearest { q, distance, within_limits }
    }
}

impl InverseKinematics {
    /// For a description. `options.given` are joints whose values go with each pose; without it an arm with too many
    /// joints is answered with its self-motion.
    ///
    /// # Errors
    /// See [`Unprepared`].
    pub fn new(description: &Description, options: &InverseOptions) -> Result<Self, Unprepared> {
        let robot = Robot::numeric(description)?;
        let space = JointSpace::new(description, &robot);
        if !(space.reach == 0.0 || LENGTHS.contains(&space.reach)) {
            return Err(Unprepared::Lengths(space.reach));
        }
        let numeric = NumericSolver::new(description, options.goal)?;
        let mut free = description.clone();
        free.rows.iter_mut().for_each(|r| r.limits = None);
        let unlimited = NumericSolver::new(&free, options.goal)?;
        let nearly = Structure::of(description).nearly;
        let surplus = robot.joints - newton::rank(&robot, options.goal);
        let of_pose = options.goal == Goal::Pose;
        let mut this = InverseKinematics {
            robot,
            space,
            goal: options.goal,
            given: vec![],
            nearly,
            seed: None,
            names: description.variables().iter().map(|v| v.symbol.name().to_string()).collect(),
            method: Method::Numeric,
            numeric,
            unlimited,
        };
        if surplus > 0
            && of_pose
            && options.given.is_none()
            && let Ok(solver) = RedundantSolver::new(description, options.goal)
        {
            this.method = Method::Redundant(Box::new(solver));
            return Ok(this);
        }
        if surplus > 0 && !of_pose && options.given.is_none() {
            // Joints that were held at some value would make a target unreachable that is not.
            return Ok(this);
        }
        let asked = options.given.clone().unwrap_or_default();
        let closed = match InverseModel::derive_for(description, options, Extent::Solver) {
            Ok(model) => {
                this.given.clone_from(&model.given);
                Some(Box::new(model.solver(description)?))
            }
            Err(Refusal::Given(why)) => return Err(Unprepared::Given(why)),
            Err(_) => {
                this.given = asked;
                this.given.sort_unstable();
                None
            }
        };
        let six = of_pose && this.robot.joints - this.given.len() == 6;
        this.space.turning.keep(&this.given);
        this.method = match closed {
            Some(solver) if this.nearly.is_empty() || !six || !this.given.is_empty() => {
                Method::Closed(solver)
            }
            closed if six && this.given.is_empty() => match GeneralSolver::new(&this.robot, &this.space) {
                Ok(general) => Method::General(Box::new(general), closed),
                Err(_) => closed.map_or(Method::Numeric, Method::Closed),
            },
            Some(solver) => Method::Closed(solver),
            None if six => Method::Held(Shared::new(Held::default())),
            None => Method::Numeric,
        };
        Ok(this)
    }

    /// The method in words: `closed form`, `elimination`, `self-motion`, `descent`.
    pub fn method(&self) -> &'static str {
        match self.method {
            Method::Closed(_) => "closed form",
            Method::General(..) | Method::Held(..) => "elimination",
            Method::Redundant(_) => "self-motion",
            Method::Numeric => "descent",
        }
    }

    /// Whether the arm has three freedoms, and with them the tool goes anywhere: positions, not poses, are what it serves.
    pub fn serves_positions(&self) -> bool {
        self.robot.joints == 3 && newton::rank(&self.robot, Goal::Position) == 3
    }

    /// All solutions of a pose of the tool in the base; `given` holds a value for each joint of [`given`](Self::given).
    ///
    /// # Panics
    /// If there is not one value per given joint.
    ///
    /// A pose is taken to be as precise as its rotation is orthonormal: the nearest rotation is meant.
    pub fn solve(&self, pose: &Transform<f64>, given: &[f64]) -> Answer {
        let mut answer = self.found(pose, given);
        answer.families.iter_mut().for_each(|f| lines::describe(f, &self.space, &self.names));
        answer
    }

    fn found(&self, pose: &Transform<f64>, given: &[f64]) -> Answer {
        assert_eq!(given.len(), self.given.len(), "one value per given joint");
        let as_given = pose;
        let pose = &newton::nearest_rigid(pose).0;
        let mut answer = match &self.method {
            // What it may miss the pose by follows from the pose as it is given.
            Method::Closed(solver) => return solver.solve(as_given, given),
            Method::General(general, closed) => {
                let mut answer = general.solve(pose);
                if answer.doubt.is_some()
                    && let Some(closed) = closed
                {
                    merge(&mut answer, closed.solve(pose, given), &self.space);
                }
                answer
            }
            Method::Held(held) => {
                let mut own = held.lend();
                let Held { values, general } = &mut *own;
                if values != given || general.is_none() {
                    let held: Vec<(usize, f64)> =
                        self.given.iter().copied().zip(given.iter().copied()).collect();
                    let robot = self.robot.held(&held);
                    *general = GeneralSolver::new(&robot, &self.space.held(&self.given)).ok().map(Box::new);
                    *values = given.to_vec();
                }
                match general {
                    Some(general) => with_held(general.solve(pose), &self.given, given, &self.space),
                    None => Answer { doubt: Some(Doubt::Searched), ..Answer::empty() },
                }
            }
            Method::Redundant(solver) => {
                let mut answer = solver.manifold(pose).answer(&solver.free());
                if answer.doubt.is_some() && solver.surplus == 1 {
                    self.follow_more(pose, &mut answer);
                }
                // What the limits allow of a curve they allow of it or of its copies, which are not listed.
                let turning = &self.space.turning;
                answer.doubt_numbers(&self.space, turning.all_copies && turning.copies.is_empty());
                answer
            }
            Method::Numeric => Answer { doubt: Some(Doubt::Searched), ..Answer::empty() },
        };
        let size = self.size(pose);
        answer.judge(|q| newton::distance(&self.robot, self.goal, pose, q, size));
        // Numbers so large that nothing follows from them.
        answer.solutions.retain(|s| s.residual.is_finite());
        answer.leave_false();
        answer.families.retain(|f| f.representative.residual.is_finite());
        if !answer.is_reachable() {
            if given.is_empty() {
                self.search(pose, &mut answer);
                if answer.is_reachable() {
                    self.search_more(pose, given, &mut answer);
                }
            } else {
                self.search_held(pose, given, &mut answer);
            }
            answer.spread(&self.space);
            answer.judge(|q| newton::distance(&self.robot, self.goal, pose, q, size));
        }
        answer.merge(&self.space, |q| newton::distance(&self.robot, self.goal, pose, q, size));
        answer
    }

    /// True if a configuration lies between members of a family that are next to each other.
    pub(super) fn is_near(&self, family: &Family, q: &[f64]) -> bool {
        let mut pairs = family.curve.windows(2);
        pairs.any(|pair| {
            let (along, to) = (self.space.way(&pair[0], &pair[1]), self.space.way(&pair[0], q));
            let square: f64 = along.iter().map(|x| x * x).sum();
            let part = along.iter().zip(&to).map(|(x, y)| x * y).sum::<f64>() / square.max(f64::MIN_POSITIVE);
            let off =
                to.iter().zip(&along).map(|(y, x)| (y - part.clamp(0.0, 1.0) * x).abs()).fold(0.0, f64::max);
            // A chord leaves the curve by an eighth of its bend.
            off <= 0.1 * square.sqrt() + 1e-6
        })
    }

    pub(crate) fn size(&self, pose: &Transform<f64>) -> f64 {
        self.space.size(pose)
    }

    /// The configuration of an answer that is nearest to another, families included: within the limits if one is.
    pub fn nearest(&self, pose: &Transform<f64>, answer: &Answer, to: &[f64]) -> Option<Nearest> {
        if let (Some(Doubt::OneAsked), [s]) = (answer.doubt, &answer.solutions[..]) {
            // The one that there is.
            return Some(Nearest::of(&self.space, &s.q, to));
        }
        let size = self.size(pose);
        let mut best: Option<Nearest> = None;
        // Whether nothing can be nearer.
        let mut offer = |q: &[f64]| {
            let found = Nearest::of(&self.space, q, to);
            let rank = |n: &Nearest| (n.within_limits, -n.distance);
            let is_there = found.within_limits && found.distance <= THERE;
            if best.as_ref().is_none_or(|b| rank(&found) > rank(b)) {
                best = Some(found);
            }
            is_there
        };
        let mut is_there = answer.solutions.iter().any(|s| offer(&s.q));
        is_there = is_there || self.is_member(pose, answer, to) && offer(to);
        if let Method::Redundant(solver) = &self.method
            && !is_there
        {
            let found = solver.best(pose, &Criterion::Nearest(to.to_vec()));
            is_there = found.is_some_and(|s| offer(&s.q));
        }
        if let Method::Closed(solver) = &self.method {
            for family in &answer.families {
                let given: Vec<f64> = self.given.iter().map(|&j| family.representative.q[j]).collect();
                is_there =
                    is_there || solver.members_at(pose, &given, family, to).iter().any(|s| offer(&s.q));
            }
        }
        let way = |q: &[f64]| self.space.moved(q, to);
        // Of a family with several parameters all curves that sample it.
        let curves = match &self.method {
            Method::Redundant(solver) if solver.surplus > 1 && !is_there => {
                Some(solver.manifold(pose).curves())
            }
            _ => None,
        };
        for family in curves.as_ref().unwrap_or(&answer.families) {
            if is_there {
                break;
            }
            let away = |q: &[f64]| norm(&self.space.way(q, to));
            let mut starts = self.starts(pose, family, away);
            starts.sort_by(|a, b| away(a).total_cmp(&away(b)));
            let slid =
                |q: &Vec<f64>| newton::slide(&self.robot, self.goal, pose, q, (&self.given, way), size);
            is_there = starts.iter().any(|q| offer(&slid(q)));
        }
        best
    }

    /// Whether a configuration with the pose is seen to be a member of a family of a redundant arm.
    fn is_member(&self, pose: &Transform<f64>, answer: &Answer, q: &[f64]) -> bool {
        let Method::Redundant(solver) = &self.method else { return false };
        // One family with several parameters stands for all configurations that have the pose.
        let stands_for_all = solver.surplus > 1 && !answer.families.is_empty();
        newton::distance(&self.robot, self.goal, pose, q, self.size(pose)) <= TOLERANCE
            && (stands_for_all || answer.families.iter().any(|f| self.is_near(f, q)))
    }

    /// Which family of an answer a configuration is a member of.
    pub fn family_of(&self, pose: &Transform<f64>, answer: &Answer, q: &[f64]) -> Option<usize> {
        answer.families.iter().position(|family| {
            if self.is_near(family, q) || family.dimension > 1 && self.is_member(pose, answer, q) {
                return true;
            }
            if family.dimension > 1 {
                let nearest = self.nearest(pose, answer, q);
                return nearest.is_some_and(|n| self.space.distance(&n.q, q) <= MEMBER);
            }
            // A curve that was followed holds all there is.
            if !family.curve.is_empty() {
                return false;
            }
            let is_member = |found: &[f64]| self.space.distance(found, q) <= MEMBER;
            let way = |p: &[f64]| self.space.moved(p, q);
            let slid = |p: Vec<f64>| {
                newton::slide(&self.robot, self.goal, pose, &p, (&self.given, way), self.size(pose))
            };
            let given: Vec<f64> = self.given.iter().map(|&j| family.representative.q[j]).collect();
            let by_formula = match &self.method {
                Method::Closed(solver) => solver.members_at(pose, &given, family, q),
                _ => vec![],
            };
            by_formula.iter().any(|s| is_member(&s.q))
                || self
                    .starts(pose, family, |p| norm(&self.space.way(p, q)))
                    .into_iter()
                    .any(|p| is_member(&slid(p)))
        })
    }

    /// Where to start on a family to get near: members of its curve that are nearer than their neighbours; members here
    /// and there, if it has more parameters than one.
    fn starts(&self, pose: &Transform<f64>, family: &Family, away: impl Fn(&[f64]) -> f64) -> Vec<Vec<f64>> {
        let representative = &family.representative.q;
        if family.is_affine && family.curve.is_empty() {
            return vec![representative.clone()];
        }
        let followed = match family.curve.is_empty() && self.given.is_empty() {
            true => {
                let arm = (&self.robot, &self.space, self.goal);
                follow_loosely(arm, pose, representative, TOLERANCE).curve
            }
            false => family.curve.clone(),
        };
        let distances: Vec<f64> = followed.iter().map(|q| away(q)).collect();
        let at = |k: usize| distances.get(k).copied().unwrap_or(f64::INFINITY);
        let is_dip = |k: &usize| at(*k) <= at(k + 1) && (*k == 0 || at(*k) <= at(k - 1));
        let dips = (0..distances.len()).filter(is_dip).map(|k| followed[k].clone());
        let mut starts: Vec<Vec<f64>> = std::iter::once(representative.clone()).chain(dips).collect();
        if family.curve.is_empty() {
            // What is a family up to rounding only cannot be followed all the way, nor one with several parameters.
            let mut random = Random(1);
            starts.extend((0..ANYWHERE).map(|_| {
                let to: Vec<f64> = representative.iter().map(|x| x + TAU * random.unit() - PI).collect();
                let way = |q: &[f64]| self.space.moved(q, &to);
                newton::slide(
                    &self.robot,
                    self.goal,
                    pose,
                    representative,
                    (&self.given, way),
                    self.size(pose),
                )
            }));
        }
        starts
    }

    /// The best configuration of an answer by a criterion, within the limits if one is; of a family that was not followed its
    /// representative stands for all.
    pub fn best(&self, pose: &Transform<f64>, answer: &Answer, criterion: &Criterion) -> Option<Nearest> {
        if let Criterion::Nearest(to) = criterion {
            return self.nearest(pose, answer, to);
        }
        let middle = self.space.middle();
        if let Method::Redundant(solver) = &self.method
            && let Some(s) = solver.best(pose, criterion)
        {
            return Some(Nearest::of(&self.space, &s.q, &middle));
        }
        let followed =
            answer.families.iter().flat_map(|f| std::iter::once(&f.representative.q).chain(&f.curve));
        let all = answer.solutions.iter().map(|s| &s.q).chain(followed);
        let cost = |q: &[f64]| criterion.of(&self.robot, &self.space, self.goal, q);
        let copies = all.map(|q| Nearest::of(&self.space, q, &middle));
        let ranked = copies.map(|n| (!n.within_limits, cost(&n.q), n));
        ranked.min_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))).map(|r| r.2)
    }

    /// One solution, within the limits if one is, and as near to `seed` as comes quickly. Where many are wanted see
    /// [`solve`](Self::solve).
    ///
    /// # Panics
    /// If there is not one value per given joint.
    pub fn one(&self, pose: &Transform<f64>, given: &[f64], seed: Option<&[f64]>) -> Answer {
        let mut answer = match &self.method {
            Method::Redundant(solver) => {
                match seed.and_then(|from| self.next(pose, from)).or_else(|| solver.within_limits(pose, seed))
                {
                    Some(s) => Answer { solutions: vec![s], ..Answer::empty() },
                    None => self.solve(pose, given),
                }
            }
            Method::Numeric if given.is_empty() => {
                let mut answer = Answer { doubt: Some(Doubt::Searched), ..Answer::empty() };
                self.search(&newton::nearest_rigid(pose).0, &mut answer);
                answer.spread(&self.space);
                answer
            }
            _ => self.solve(pose, given),
        };
        let away = |s: &Solution| seed.map_or(0.0, |to| self.space.distance(&s.q, to));
        let representatives = answer.families.drain(..).map(|f| f.representative);
        let all: Vec<Solution> = representatives.chain(answer.solutions.drain(..)).collect();
        let better = |a: &Solution, b: &Solution| {
            b.within_limits.cmp(&a.within_limits).then(away(a).total_cmp(&away(b)))
        };
        answer.solutions = all.into_iter().min_by(better).into_iter().collect();
        if answer.is_reachable() {
            answer.doubt = Some(Doubt::OneAsked);
        }
        // The copy that the limits allow.
        let is_outside = |s: &&mut Solution| s.within_limits && !self.space.is_inside(&s.q);
        for s in answer.solutions.iter_mut().filter(is_outside) {
            s.q = match seed {
                Some(to) => self.space.nearest_copy(&s.q, to),
                None => match self.space.listed_copies(&s.q, 1).pop() {
                    Some(copy) => copy,
                    None => self.space.nearest_copy(&s.q, &s.q),
                },
            };
        }
        let (pose, size) = (&newton::nearest_rigid(pose).0, self.size(pose));
        answer.judge(|q| newton::distance(&self.robot, self.goal, pose, q, size));
        answer
    }

    /// All solutions of many poses, in their order, by as many threads; the same whatever their number.
    ///
    /// # Panics
    /// If the number of given values is not that of [`given`](Self::given) joints: a panic of a thread is that of the caller.
    pub fn solve_all(&self, poses: &[Transform<f64>], given: &[f64], threads: NonZero<usize>) -> Vec<Answer> {
        let share = poses.len().div_ceil(threads.get()).max(1);
        std::thread::scope(|scope| {
            let work = |poses: &[Transform<f64>]| {
                poses.iter().map(|pose| self.solve(pose, given)).collect::<Vec<_>>()
            };
            let parts: Vec<_> = poses.chunks(share).map(|part| scope.spawn(move || work(part))).collect();
            parts
                .into_iter()
                .flat_map(|part| part.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
                .collect()
        })
    }
}

/// Members of a family with several parameters from which the way to another configuration is tried.
const ANYWHERE: usize = 16;
/// A configuration this near to another is there.
const THERE: f64 = 1e-9;
/// A configuration this near to a member of a family is one.
const MEMBER: f64 = 1e-6;
/// What a solution that was searched for may miss the pose by.
pub(super) const TOLERANCE: f64 = 1e-9;

/// Adds what another method found.
fn merge(answer: &mut Answer, other: Answer, space: &JointSpace) {
    for s in other.solutions {
        if !answer.solutions.iter().any(|t| space.is_same(&t.q, &s.q)) {
            answer.solutions.push(s);
        }
    }
    if answer.families.is_empty() {
        answer.families = other.families;
    }
}

/// An answer of the joints that are not given, with those that are.
fn with_held(mut answer: Answer, given: &[usize], values: &[f64], space: &JointSpace) -> Answer {
    let whole = |q: &[f64], held: &[f64]| -> Vec<f64> {
        let mut rest = q.iter().copied();
        let held = |j: usize| given.iter().position(|&g| g == j).map(|k| held[k]);
        (0..space.is_angle.len()).map(|j| held(j).or_else(|| rest.next()).unwrap_or(0.0)).collect()
    };
    let still = vec![0.0; given.len()];
    let families = answer.families.iter_mut();
    for s in families
        .map(|f| {
            f.direction = whole(&f.direction, &still);
            f.curve.iter_mut().for_each(|q| *q = whole(q, values));
            &mut f.representative
        })
        .chain(&mut answer.solutions)
    {
        s.q = whole(&s.q, values);
        s.within_limits = space.within(&s.q);
    }
    answer
}
