//! The branch through a start, as far as it goes.

use super::between::HermitePath;
use super::clearance::Clearance;
use super::events::{Event, EventKind};
use crate::description::Description;
use crate::forward::Reference;
use crate::inverse::{Branch, Goal, InverseKinematics, JointSpace, Unprepared, newton};
use crate::mechanism::Robot;
use crate::motion::hand::HandPath;
use crate::velocity::{
    Damping, Place, RateSolver, Singularities, Still, Viewpoint, Whole, geometric, nearest_singularity,
};
use denavit_program::{Graph, Interval, Program};
use denavit_symbolic::{Expr, Symbol};
use rustc_hash::FxHashSet;

/// How closely a path is followed.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct FollowOptions {
    /// How far the tool's origin may be from its path between samples, metres; and its orientation, radians by the
    /// arm's size.
    pub max_deviation: f64,
    /// The longest step of s.
    pub longest: f64,
    /// The shortest step of s: a branch that cannot be continued by this ends.
    pub shortest: f64,
}

impl Default for FollowOptions {
    /// A hundredth of a millimetre, steps of s between 1e-9 and 1/50.
    fn default() -> Self {
        FollowOptions { max_deviation: 1e-5, longest: 0.02, shortest: 1e-9 }
    }
}

/// A path as the joints follow it.
#[derive(Clone, Debug)]
pub struct Followed {
    /// The joints by s, as far as the branch goes.
    pub joints: HermitePath,
    /// What is met, in order.
    pub events: Vec<Event>,
    /// How far the tool's origin is from its path at most, of eight places between each two samples; metres.
    pub deviation: f64,
    /// The same for the orientation, radians.
    pub turned: f64,
    /// Up to which s the branch goes: 1 if all of the path is followed.
    pub reached: f64,
    /// Whether between all samples the determinant's factors were seen to keep their signs, but at the singular
    /// configurations that are listed: by interval arithmetic over boxes of joints, which are estimated from three
    /// configurations each. Where the factors are not known, or not all there is, whether the clearance is certain.
    pub certified: bool,
    /// How near the path comes to a singular configuration, in numbers: where the factors are not known, or not all there
    /// is.
    pub clearance: Option<Clearance>,
}

impl Followed {
    /// True if the whole path is followed within the limits.
    pub fn is_clean(&self) -> bool {
        self.reached >= 1.0 && !self.events.iter().any(|e| matches!(e.kind, EventKind::Limit { .. }))
    }
}

/// Another way to follow the path.
#[derive(Clone, PartialEq, Debug)]
pub struct Alternative {
    /// The configuration at the start.
    pub start: Vec<f64>,
    /// Its branch, if it has a name.
    pub branch: Branch,
    /// Up to which s it goes.
    pub reached: f64,
    /// Singular configurations on the way.
    pub singular: usize,
    /// Whether it stays within the limits.
    pub within_limits: bool,
}

/// A factor of the determinant, to be computed.
#[derive(Clone, Debug)]
struct Factor {
    expr: Expr,
    program: Program,
}

/// Follows paths of a robot's tool.
#[derive(Clone, Debug)]
pub struct Follower {
    /// The inverse kinematics.
    pub inverse: InverseKinematics,
    factors: Option<Vec<Factor>>,
    parameters: Vec<(Symbol, f64)>,
    /// Whether a zero of the factors is all there is to singular configurations.
    is_complete: bool,
}

/// The largest singular value below which a configuration counts as singular where no factor is known.
const SINGULAR: f64 = 1e-3;
/// Places between samples at which the deviation is measured.
const PLACES: usize = 8;
/// A factor this small is 0.
const ZERO: f64 = 1e-13;
/// A configuration solves a pose if it misses it by no more (see [`crate::inverse::Solution::residual`]).
const SOLVED: f64 = 1e-9;
/// How strongly joints to spare go to the middle of their limits, by s.
const CENTRING: f64 = 2.0;
/// Steps of s below this are taken however far the hand is from its path between their ends.
const SMALL: f64 = 1e-5;
/// Two singular configurations by the same factor within this of s are one.
const TOGETHER: f64 = 2e-3;
/// Halvings of a step in search of a zero of a factor.
const HALVINGS: u32 = 12;

impl Follower {
    /// For a robot with numbers.
    ///
    /// # Errors
    /// See [`Unprepared`].
    pub fn new(description: &Description) -> Result<Self, Unprepared> {
        let inverse = InverseKinematics::new(description, &crate::inverse::InverseOptions::default())?;
        let found = Singularities::derive(description, Reference::Tool).ok();
        let factor = |expr: Expr| Factor { expr, program: program(description, expr) };
        Ok(Follower {
            inverse,
            is_complete: found.as_ref().is_some_and(|f| f.is_complete && f.deficient.is_none()),
            factors: found.map(|f| f.common.iter().map(|s| factor(s.factor)).collect()),
            parameters: description.known_values(),
        })
    }

    fn robot(&self) -> &Robot<f64> {
        &self.inverse.robot
    }

    fn space(&self) -> &JointSpace {
        &self.inverse.space
    }

    /// The configurations in which the path can start, those within the limits first: all solutions, of a family its
    /// representative, moved by whole turns to be within the limits and near to `to`, or to their middle.
    pub fn starts(&mut self, path: &dyn HandPath, to: Option<&[f64]>) -> Vec<(Vec<f64>, Branch)> {
        let answer = self.inverse.solve(&path.pose(0.0), &[]);
        let all = answer.solutions.iter().chain(answer.families.iter().map(|f| &f.representative));
        let to = to.map_or_else(|| self.space().middle(), <[f64]>::to_vec);
        let mut starts: Vec<(Vec<f64>, Branch)> = vec![];
        for s in all {
            let q = self.space().nearest_copy(&s.q, &to);
            // Copies of one, as joints with gears have them, can be brought to one place.
            let is_known = |t: &(Vec<f64>, Branch)| self.space().is_same(&t.0, &q);
            if !starts.iter().any(is_known) {
                starts.push((q, s.branch.clone()));
            }
        }
        starts.sort_by_key(|s| self.outside(&s.0).is_some());
        starts
    }

    /// Follows a path from a configuration that has the pose of its start.
    pub fn follow(&mut self, path: &dyn HandPath, start: &[f64], options: &FollowOptions) -> Followed {
        let mut walk = Walk::new(self, path, start, options);
        walk.run();
        walk.finish()
    }

    /// What comes of each of the [`starts`](Self::starts).
    pub fn alternatives(
        &mut self,
        path: &dyn HandPath,
        to: Option<&[f64]>,
        options: &FollowOptions,
    ) -> Vec<Alternative> {
        let starts = self.starts(path, to);
        let coarse = FollowOptions { max_deviation: f64::INFINITY, ..*options };
        starts
            .into_iter()
            .map(|(start, branch)| {
                let followed = self.follow(path, &start, &coarse);
                let singular =
                    followed.events.iter().filter(|e| matches!(e.kind, EventKind::Singular { .. }));
                Alternative {
                    branch,
                    reached: followed.reached,
                    singular: singular.count(),
                    within_limits: !followed.events.iter().any(|e| matches!(e.kind, EventKind::Limit { .. })),
                    start,
                }
            })
            .collect()
    }

    /// The first joint outside of its limits, and the limit.
    fn outside(&self, q: &[f64]) -> Option<(usize, f64)> {
        q.iter().zip(&self.space().limits).enumerate().find_map(|(j, (x, limits))| {
            let [low, high] = (*limits)?;
            let slack = 1e-9;
            if *x < low - slack {
                Some((j, low))
            } else if *x > high + slack {
                Some((j, high))
            } else {
                None
            }
        })
    }

    /// dq/ds on the path: exact where the arm is not singular, bounded where it is.
    fn slope(&self, q: &[f64], twist: &[f64; 6]) -> Vec<f64> {
        let jacobian = geometric(self.robot(), q, &Viewpoint::tool());
        let mut solver = RateSolver::new(&self.space().is_angle, self.size());
        solver.damping = Damping { threshold: 1e-6, largest: 1e-6 };
        solver.solve(&jacobian, twist, &self.wish(q)).rates
    }

    /// Where joints to spare would rather go: to the middle of their limits, the more the nearer they are to one.
    fn wish(&self, q: &[f64]) -> Vec<f64> {
        if q.len() <= 6 {
            return vec![];
        }
        let away = |(x, limits): (&f64, &Option<[f64; 2]>)| {
            let Some([low, high]) = *limits else { return 0.0 };
            let (middle, half) = (f64::midpoint(low, high), 0.5 * (high - low));
            if half <= 0.0 { 0.0 } else { -CENTRING * half * ((x - middle) / half).powi(3) }
        };
        q.iter().zip(&self.space().limits).map(away).collect()
    }

    fn size(&self) -> f64 {
        if self.space().reach > 0.0 { self.space().reach } else { 1.0 }
    }

    /// The configuration at s next to a guess.
    fn corrected(&self, path: &dyn HandPath, s: f64, guess: &[f64]) -> Option<Vec<f64>> {
        let pose = path.pose(s);
        let (q, miss) = newton::polish(self.robot(), Goal::Pose, &pose, guess, &[], self.size())?;
        (miss <= SOLVED).then_some(q)
    }

    /// The values of the determinant's factors.
    fn values(&self, q: &[f64]) -> Vec<f64> {
        let value = |f: &Factor| {
            let input = |s: Symbol| self.input(&f.program, s, q);
            f.program.eval::<f64>(input).map_or(f64::NAN, |v| v[0])
        };
        self.factors.iter().flatten().map(value).collect()
    }

    fn input(&self, program: &Program, s: Symbol, q: &[f64]) -> Option<f64> {
        let joint = program.variables().iter().position(|&v| v == s).map(|j| q[j]);
        joint.or_else(|| self.parameters.iter().find(|p| p.0 == s).map(|p| p.1))
    }

    /// Whether a factor has one sign in a box of configurations, by interval arithmetic.
    fn keeps_sign(&self, factor: usize, low: &[f64], high: &[f64]) -> bool {
        let Some(f) = self.factors.as_ref().and_then(|all| all.get(factor)) else { return false };
        let input = |s: Symbol| {
            let joint = f.program.variables().iter().position(|&v| v == s);
            let of_joint = joint.map(|j| Interval::new(low[j], high[j]));
            of_joint.or_else(|| self.parameters.iter().find(|p| p.0 == s).map(|p| Interval::point(p.1)))
        };
        f.program.eval::<Interval>(input).is_ok_and(|v| !v[0].contains(0.0))
    }

    /// The smallest singular value of the Jacobian, lengths by the arm's size.
    fn smallest(&self, q: &[f64]) -> f64 {
        let jacobian = geometric(self.robot(), q, &Viewpoint::tool());
        let whole = Whole::new(&jacobian, &self.space().is_angle, self.size());
        whole.singular_values.last().copied().unwrap_or(0.0)
    }

    /// How the axes lie at a singular configuration next to this one.
    fn place(&self, q: &[f64]) -> Option<Place> {
        let view = Viewpoint::tool();
        let (is_angle, size) = (&self.space().is_angle, self.size());
        let exact =
            nearest_singularity(self.robot(), &view, is_angle, size, q).filter(|n| n.distance < 0.05)?;
        let jacobian = geometric(self.robot(), &exact.q, &view);
        let whole = Whole::new(&jacobian, is_angle, size);
        Some(Place::of(self.robot(), (Reference::Tool, Still::Body), &exact.q, &whole.free))
    }
}

/// A factor as a program over the joints.
fn program(description: &Description, factor: Expr) -> Program {
    let variables: Vec<Symbol> = description.variables().iter().map(|v| v.symbol).collect();
    let parameters: Vec<Symbol> = description.parameters.iter().map(|p| p.symbol).collect();
    let mut graph = Graph::new(&variables, &parameters);
    let value = graph.trace(factor);
    Program::new(&graph, &[("f".into(), value)], |_| None, &FxHashSet::default())
}

/// A path on the way.
struct Walk<'a> {
    follower: &'a mut Follower,
    path: &'a dyn HandPath,
    options: FollowOptions,
    corners: Vec<f64>,
    joints: HermitePath,
    events: Vec<Event>,
    deviation: f64,
    turned: f64,
    certified: bool,
    s: f64,
    q: Vec<f64>,
    slope: Vec<f64>,
}

/// A step that can be taken.
struct Step {
    s: f64,
    q: Vec<f64>,
    /// dq/ds before it, and behind it, which differs at corners.
    slopes: [Vec<f64>; 2],
    deviation: [f64; 2],
}

impl<'a> Walk<'a> {
    fn new(
        follower: &'a mut Follower,
        path: &'a dyn HandPath,
        start: &[f64],
        options: &FollowOptions,
    ) -> Self {
        let slope = follower.slope(start, &path.twist(0.0));
        let mut corners = path.corners();
        corners.push(1.0);
        Walk {
            joints: HermitePath::start(start.to_vec(), slope.clone()),
            follower,
            path,
            options: *options,
            corners,
            events: vec![],
            deviation: 0.0,
            turned: 0.0,
            certified: true,
            s: 0.0,
            q: start.to_vec(),
            slope,
        }
    }

    fn run(&mut self) {
        let start = self.q.clone();
        if let Some((joint, limit)) = self.follower.outside(&start) {
            self.events.push(Event { s: 0.0, q: start, kind: EventKind::Limit { joint, limit } });
        }
        let mut step = self.options.longest / 4.0;
        while self.s < 1.0 {
            let corner = self.corners.iter().copied().find(|c| *c > self.s + 1e-12).unwrap_or(1.0);
            let to = if self.s + 1.01 * step >= corner { corner } else { self.s + step };
            match self.step(to) {
                Some(taken) => {
                    let was_whole = to - self.s >= 0.99 * step;
                    let easy = taken.deviation[0].max(taken.deviation[1] * self.follower.size())
                        < 0.05 * self.options.max_deviation;
                    self.look_between(&taken);
                    self.take(taken);
                    if was_whole && easy {
                        step = (1.8 * step).min(self.options.longest);
                    }
                }
                None if to - self.s <= self.options.shortest => {
                    self.end();
                    return;
                }
                None => step = (0.5 * (to - self.s)).max(0.9 * self.options.shortest),
            }
        }
    }

    /// The next sample, if it continues the branch and the hand stays near its path.
    fn step(&self, to: f64) -> Option<Step> {
        let h = to - self.s;
        let guess: Vec<f64> = self.q.iter().zip(&self.slope).map(|(q, d)| q + h * d).collect();
        let q = self.follower.corrected(self.path, to, &guess)?;
        // Another branch is further from the guess than this one curves.
        let moved = self.distance(&self.q, &q);
        let off = self.distance(&guess, &q);
        if off > 0.3 * moved + 1e-7 || moved > 0.3 {
            return None;
        }
        let is_corner = self.corners.iter().any(|c| (c - to).abs() < 1e-12);
        let twist_before =
            if is_corner { self.path.twist((to - 4e-6).max(0.0)) } else { self.path.twist(to) };
        let before = self.follower.slope(&q, &twist_before);
        let behind = if is_corner && to < 1.0 {
            self.follower.slope(&q, &self.path.twist(to))
        } else {
            before.clone()
        };
        let mut deviation = [0.0_f64; 2];
        for k in 1..PLACES {
            let u = k as f64 / PLACES as f64;
            let at = HermitePath::value(h, u, (&self.q, &self.slope), (&q, &before));
            let (turned, away) =
                newton::gap(self.follower.robot(), Goal::Pose, &self.path.pose(self.s + u * h), &at);
            deviation = [deviation[0].max(away), deviation[1].max(turned)];
        }
        let size = self.follower.size();
        let fits =
            deviation[0] <= self.options.max_deviation && deviation[1] * size <= self.options.max_deviation;
        (fits || h < SMALL).then_some(Step { s: to, q, slopes: [before, behind], deviation })
    }

    /// The largest difference of a joint, slides by the arm's size; whole turns count.
    fn distance(&self, a: &[f64], b: &[f64]) -> f64 {
        let is_angle = &self.follower.space().is_angle;
        let unit = |j: usize| if is_angle[j] { 1.0 } else { self.follower.size() };
        a.iter().zip(b).enumerate().map(|(j, (x, y))| (x - y).abs() / unit(j)).fold(0.0, f64::max)
    }

    fn take(&mut self, step: Step) {
        self.deviation = self.deviation.max(step.deviation[0]);
        self.turned = self.turned.max(step.deviation[1]);
        self.joints.push(step.s, step.q.clone(), step.slopes.clone());
        (self.s, self.q) = (step.s, step.q);
        let [_, behind] = step.slopes;
        self.slope = behind;
    }

    /// The configuration at u in [0, 1] of a step, on the path itself.
    fn at(&self, step: &Step, u: f64) -> Vec<f64> {
        let h = step.s - self.s;
        let near = HermitePath::value(h, u, (&self.q, &self.slope), (&step.q, &step.slopes[0]));
        self.follower.corrected(self.path, self.s + u * h, &near).unwrap_or(near)
    }

    /// Singular configurations and limits between two samples.
    fn look_between(&mut self, step: &Step) {
        let mut found: Vec<(f64, EventKind)> = vec![];
        self.limits(step, &mut found);
        if self.follower.factors.is_some() {
            let (before, after) = (self.follower.values(&self.q), self.follower.values(&step.q));
            for k in 0..before.len() {
                self.factor(step, k, [0.0, 1.0], [before[k], after[k]], HALVINGS, &mut found);
            }
        }
        if !self.follower.is_complete {
            let (before, after) = (self.follower.smallest(&self.q), self.follower.smallest(&step.q));
            let middle = self.follower.smallest(&self.at(step, 0.5));
            if middle < SINGULAR && middle <= before.min(after) {
                found.push((0.5, EventKind::Singular { factor: None, place: None, crossed: false }));
            }
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (u, mut kind) in found {
            let (s, q) = (self.s + u * (step.s - self.s), self.at(step, u));
            if let EventKind::Singular { place, factor, .. } = &mut kind {
                // One that was met a moment ago is the same.
                let own = *factor;
                let is_same = |e: &Event| {
                    matches!(e.kind, EventKind::Singular { factor, .. } if factor == own)
                        && (e.s - s).abs() < TOGETHER
                };
                if self.events.iter().any(is_same) {
                    continue;
                }
                *place = self.follower.place(&q);
            }
            self.events.push(Event { s, q, kind });
        }
    }

    /// Where a factor is 0 in a part of a step; a part where its sign is certain is left.
    fn factor(
        &mut self,
        step: &Step,
        k: usize,
        [from, to]: [f64; 2],
        [a, b]: [f64; 2],
        depth: u32,
        found: &mut Vec<(f64, EventKind)>,
    ) {
        let expr = self.follower.factors.as_ref().and_then(|f| f.get(k)).map(|f| f.expr);
        let singular = |crossed: bool| EventKind::Singular { factor: expr, place: None, crossed };
        if a.abs() <= ZERO || b.abs() <= ZERO {
            // The rest of the part, without the end that is 0.
            let is_first = a.abs() <= ZERO;
            found.push((if is_first { from } else { to }, singular(false)));
            let beside = 1e-3 * (to - from);
            let (low, high) = if is_first { (from + beside, to) } else { (from, to - beside) };
            let value = self.follower.values(&self.at(step, if is_first { low } else { high }))[k];
            if depth > 0 && value.abs() > ZERO {
                let ends = if is_first { [value, b] } else { [a, value] };
                self.factor(step, k, [low, high], ends, depth - 1, found);
            }
            return;
        }
        if (a < 0.0) != (b < 0.0) {
            let (mut low, mut high) = (from, to);
            for _ in 0..50 {
                let middle = f64::midpoint(low, high);
                let value = self.follower.values(&self.at(step, middle))[k];
                if (value < 0.0) == (a < 0.0) { low = middle } else { high = middle }
            }
            found.push((f64::midpoint(low, high), singular(true)));
            return;
        }
        let (low, high) = self.bounds(step, from, to);
        if self.follower.keeps_sign(k, &low, &high) {
            return;
        }
        if depth == 0 {
            // Not certain on a part of 1/4096 of a step: touched, or nearly.
            self.certified = false;
            if a.abs().min(b.abs()) < 1e-9 {
                found.push((from, singular(false)));
            }
            return;
        }
        let middle = f64::midpoint(from, to);
        let value = self.follower.values(&self.at(step, middle))[k];
        self.factor(step, k, [from, middle], [a, value], depth - 1, found);
        self.factor(step, k, [middle, to], [value, b], depth - 1, found);
    }

    /// What the joints do in a part of a step, with a margin for their curvature.
    fn bounds(&self, step: &Step, from: f64, to: f64) -> (Vec<f64>, Vec<f64>) {
        let (a, b, c) = (self.at(step, from), self.at(step, f64::midpoint(from, to)), self.at(step, to));
        let bound = |j: usize| {
            let (low, high) = (a[j].min(b[j]).min(c[j]), a[j].max(b[j]).max(c[j]));
            // A parabola through three points exceeds them by a quarter of the second difference at most.
            let margin = 0.5 * (a[j] - 2.0 * b[j] + c[j]).abs() + 1e-12;
            (low - margin, high + margin)
        };
        (0..a.len()).map(bound).unzip()
    }

    /// Where joints leave and enter their limits between two samples.
    fn limits(&self, step: &Step, found: &mut Vec<(f64, EventKind)>) {
        let limits = self.follower.space().limits.clone();
        for (joint, limit) in limits.iter().enumerate() {
            let Some(range) = limit else { continue };
            for (side, &bound) in range.iter().enumerate() {
                let beyond = |q: &[f64]| if side == 0 { bound - q[joint] } else { q[joint] - bound };
                let places: Vec<f64> = (0..=4).map(|k| f64::from(k) / 4.0).collect();
                for pair in places.windows(2) {
                    let value = |u: f64| match u {
                        0.0 => beyond(&self.q),
                        1.0 => beyond(&step.q),
                        u => beyond(&self.at(step, u)),
                    };
                    let (a, b) = (value(pair[0]), value(pair[1]));
                    if (a > 1e-9) == (b > 1e-9) {
                        continue;
                    }
                    let (mut low, mut high) = (pair[0], pair[1]);
                    for _ in 0..40 {
                        let middle = f64::midpoint(low, high);
                        if (value(middle) > 1e-9) == (a > 1e-9) { low = middle } else { high = middle }
                    }
                    let kind = if b > a {
                        EventKind::Limit { joint, limit: bound }
                    } else {
                        EventKind::WithinLimits { joint }
                    };
                    found.push((high, kind));
                }
            }
        }
    }

    /// The branch ends here: why.
    fn end(&mut self) {
        let beyond = (self.s + 1e-4).min(1.0);
        let reachable = self.follower.inverse.solve(&self.path.pose(beyond), &[]).is_reachable();
        let values = self.follower.values(&self.q);
        let factor = values
            .iter()
            .enumerate()
            .min_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))
            .filter(|(_, v)| v.abs() < 1e-2)
            .and_then(|(k, _)| self.follower.factors.as_ref()?.get(k))
            .map(|f| f.expr);
        let place = self.follower.place(&self.q);
        // What is met right before the end is the end itself.
        let end = self.s;
        self.events
            .retain(|e| !(matches!(e.kind, EventKind::Singular { .. }) && end - e.s < TOGETHER && e.s > 0.0));
        let kind = EventKind::End { reachable, factor, place };
        self.events.push(Event { s: self.s, q: self.q.clone(), kind });
    }

    fn finish(self) -> Followed {
        let is_known = self.follower.factors.is_some() && self.follower.is_complete;
        let measured = || Clearance::of(self.follower.robot(), self.follower.space(), &self.joints);
        let clearance = (!is_known).then(measured);
        Followed {
            reached: if self.s >= 1.0 { 1.0 } else { self.s },
            joints: self.joints,
            events: self.events,
            deviation: self.deviation,
            turned: self.turned,
            certified: clearance.as_ref().map_or(self.certified, |c| c.is_certain),
            clearance,
        }
    }
}
