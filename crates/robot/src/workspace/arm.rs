//! The arm as its workspace needs it: ranges of the joints, the section, damped steps in it.

use super::NoWorkspace;
use super::section::{Section, across, upwards};
use super::walk::Walk;
use crate::geometry::{Axis, Vector};
use crate::mechanism::{Line, Robot};
use crate::space::JointSpace;
use std::f64::consts::PI;

/// A joint that something was decided about.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Assumed {
    /// The joint, from 0.
    pub joint: usize,
    /// Its lowest and highest value, metres; the same twice for a slide that is held.
    pub range: [f64; 2],
}

/// Where a joint may be.
#[derive(Clone, Copy, Debug)]
pub(super) struct Range {
    pub low: f64,
    pub high: f64,
    /// Turns without end.
    pub is_endless: bool,
}

/// An arm in its section.
pub(super) struct Arm {
    pub walk: Walk,
    pub ranges: Vec<Range>,
    /// The square of each joint's unit: 1 for one that turns, a length's for one that slides, 0 for one that is held.
    pub weights: Vec<f64>,
    pub section: Section,
    /// Where distances from the shoulder are measured from.
    pub shoulder: Option<Vector<f64>>,
    pub assumed: Vec<Assumed>,
    pub held: Vec<Assumed>,
    /// A length of the arm's size, metres.
    pub length: f64,
    /// Space or the plane.
    dimension: usize,
    /// How many joints move the tool point.
    movers: usize,
    step: Vec<f64>,
    rows: Vec<[f64; 2]>,
    trial: Vec<f64>,
}

/// Configurations that show what moves.
const PROBES: usize = 12;
/// Below this part of the arm's size nothing moves.
const STILL: f64 = 1e-9;

impl Arm {
    /// The arm of a robot.
    pub fn new(robot: &Robot<f64>, space: &JointSpace) -> Result<Self, NoWorkspace> {
        let reach = robot.reach();
        let given = space.limits.iter().flatten().flatten();
        if !reach.is_finite() || given.clone().any(|x| !x.is_finite()) {
            return Err(NoWorkspace::NotFinite);
        }
        // An arm of slides alone has no length of its own.
        let length = if reach > 0.0 { reach } else { 1.0 };
        let mut assumed = vec![];
        let range = |j: usize| match (space.limits[j], space.is_angle[j]) {
            (Some([a, b]), _) => Range { low: a.min(b), high: a.max(b), is_endless: false },
            (None, true) => Range { low: -PI, high: PI, is_endless: true },
            (None, false) => {
                assumed.push(Assumed { joint: j, range: [0.0, length] });
                Range { low: 0.0, high: length, is_endless: false }
            }
        };
        let ranges: Vec<Range> = (0..robot.joints).map(range).collect();
        let unit = |&is_angle: &bool| if is_angle { 1.0 } else { length * length };
        let n = robot.joints;
        let mut arm = Arm {
            walk: Walk::new(robot),
            weights: space.is_angle.iter().map(unit).collect(),
            ranges,
            section: Section::Plane { directions: across(Vector::unit(Axis::Z)) },
            shoulder: None,
            assumed,
            held: vec![],
            length,
            dimension: 2,
            movers: 0,
            step: vec![0.0; n],
            rows: vec![[0.0; 2]; n],
            trial: vec![0.0; n],
        };
        arm.choose(&space.is_angle)?;
        Ok(arm)
    }

    /// The middle of all ranges.
    pub fn middle(&self) -> Vec<f64> {
        self.ranges.iter().map(|r| f64::midpoint(r.low, r.high)).collect()
    }

    /// Where the tool point is in the section, at a configuration.
    pub fn at(&mut self, q: &[f64]) -> [f64; 2] {
        self.walk.to(q);
        self.section.coordinates(self.walk.point)
    }

    /// How well the tool point can move where the last walk was: Yoshikawa's measure √det(J Jᵀ) of its velocity, in the
    /// plane for an arm that stays in one; with fewer joints √det(Jᵀ J). Slides count by the arm's size.
    pub fn measure(&self) -> f64 {
        let columns = || {
            let all = self.walk.columns.iter().zip(&self.weights);
            all.filter(|c| *c.1 > 0.0).map(|(c, w)| c.scale(w.sqrt()))
        };
        if self.movers < self.dimension {
            let mut of = columns().filter(|c| c.norm() > STILL * self.length);
            return match (of.next(), of.next()) {
                (Some(a), Some(b)) => a.cross(b).norm(),
                (Some(a), None) => a.norm(),
                _ => 0.0,
            };
        }
        if let (2, Section::Plane { directions: [u, v] }) = (self.dimension, &self.section) {
            let (mut uu, mut uv, mut vv) = (0.0, 0.0, 0.0);
            for c in columns() {
                let (x, y) = (c.dot(*u), c.dot(*v));
                (uu, uv, vv) = (uu + x * x, uv + x * y, vv + y * y);
            }
            return (uu * vv - uv * uv).max(0.0).sqrt();
        }
        let [mut xx, mut xy, mut xz, mut yy, mut yz, mut zz] = [0.0; 6];
        for Vector([x, y, z]) in columns() {
            (xx, xy, xz) = (xx + x * x, xy + x * y, xz + x * z);
            (yy, yz, zz) = (yy + y * y, yz + y * z, zz + z * z);
        }
        let det = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
        det.max(0.0).sqrt()
    }

    /// Moves a configuration, within the ranges, until the tool point is nearer than `near` to a point of the section or
    /// so many walks are made; the tool point's place. Damped Gauss–Newton steps (Levenberg 1944); joints that a step
    /// would take out of their range stay at its end.
    pub fn approach(&mut self, q: &mut [f64], target: [f64; 2], near: f64, walks: usize) -> [f64; 2] {
        let away = |p: [f64; 2]| [target[0] - p[0], target[1] - p[1]];
        let mut place = self.at(q);
        let mut damping = 1e-6 * self.length * self.length;
        let mut is_fresh = true;
        for _ in 0..walks {
            let error = away(place);
            let square = error[0] * error[0] + error[1] * error[1];
            if square <= near * near {
                break;
            }
            if is_fresh {
                let gradient = self.section.rows(self.walk.point);
                for (row, c) in self.rows.iter_mut().zip(&self.walk.columns) {
                    *row = [gradient[0].dot(*c), gradient[1].dot(*c)];
                }
            }
            self.damped_step(q, error, damping);
            let mut trial = std::mem::take(&mut self.trial);
            trial.copy_from_slice(q);
            trial.iter_mut().zip(&self.step).for_each(|(x, s)| *x += s);
            // A cut sum may pass an end by a rounding.
            self.clamp(&mut trial);
            let there = self.at(&trial);
            let left = away(there);
            is_fresh = left[0] * left[0] + left[1] * left[1] < square;
            if is_fresh {
                q.copy_from_slice(&trial);
                place = there;
                damping = (damping * 0.2).max(1e-12 * self.length * self.length);
            } else {
                damping *= 30.0;
            }
            self.trial = trial;
        }
        place
    }

    /// The step W Jᵀ (J W Jᵀ + λ)⁻¹ e, cut to the ranges.
    fn damped_step(&mut self, q: &[f64], error: [f64; 2], damping: f64) {
        const LONGEST: f64 = 0.6;
        let n = q.len();
        self.step.fill(0.0);
        // Joints at the end of their range leave the system one round after the other.
        let mut stopped = 0_u64;
        let mut rest = error;
        for _ in 0..3 {
            let (mut a, mut b, mut c) = (damping, 0.0, damping);
            let works = |j: usize| j >= 64 || stopped & (1 << j) == 0;
            for j in (0..n).filter(|&j| works(j)) {
                let ([u, v], w) = (self.rows[j], self.weights[j]);
                (a, b, c) = (a + w * u * u, b + w * u * v, c + w * v * v);
            }
            let det = a * c - b * b;
            if det <= 0.0 || !det.is_finite() {
                break;
            }
            let y = [(c * rest[0] - b * rest[1]) / det, (a * rest[1] - b * rest[0]) / det];
            let of = |j: usize| self.weights[j] * (self.rows[j][0] * y[0] + self.rows[j][1] * y[1]);
            let largest = (0..n)
                .filter(|&j| works(j) && self.weights[j] > 0.0)
                .map(|j| of(j).abs() / self.weights[j].sqrt())
                .fold(0.0, f64::max);
            let shorter = if largest > LONGEST { LONGEST / largest } else { 1.0 };
            let mut newly = 0_u64;
            for j in (0..n).filter(|&j| works(j)) {
                let r = self.ranges[j];
                let wanted = shorter * of(j);
                let to = q[j] + wanted;
                self.step[j] = if r.is_endless { wanted } else { to.clamp(r.low, r.high) - q[j] };
                if self.step[j] != wanted && j < 64 {
                    newly |= 1 << j;
                }
            }
            if newly == 0 {
                break;
            }
            stopped |= newly;
            rest = error;
            for j in (0..n).filter(|j| *j < 64 && stopped & (1 << j) != 0) {
                rest[0] -= self.rows[j][0] * self.step[j];
                rest[1] -= self.rows[j][1] * self.step[j];
            }
        }
    }

    /// Brings a configuration into the ranges.
    pub fn clamp(&self, q: &mut [f64]) {
        for (x, r) in q.iter_mut().zip(&self.ranges) {
            if !r.is_endless {
                *x = x.clamp(r.low, r.high);
            }
        }
    }

    /// Chooses the section by what moves the tool point, and how.
    fn choose(&mut self, is_angle: &[bool]) -> Result<(), NoWorkspace> {
        let mut velocities: Vec<Vec<Vector<f64>>> = vec![];
        let mut q = self.middle();
        let mut sequence = Sequence::new(q.len());
        for _ in 0..PROBES {
            sequence.next(&self.ranges, &mut q);
            self.walk.to(&q);
            let columns = self.walk.columns.iter().zip(&self.weights).map(|(c, w)| c.scale(w.sqrt()));
            velocities.push(columns.collect());
        }
        let is_still = |j: usize| velocities.iter().all(|v| v[j].norm() <= STILL * self.length);
        let movers: Vec<usize> = (0..q.len()).filter(|&j| !is_still(j)).collect();
        if movers.iter().all(|&j| self.ranges[j].low == self.ranges[j].high) {
            return Err(NoWorkspace::NothingMoves);
        }
        self.movers = movers.len();
        let all: Vec<Vector<f64>> = velocities.iter().flatten().copied().collect();
        let directions = span(&all, 1e-7 * self.length);
        self.walk.to(&self.middle());
        if let [first, rest @ ..] = &directions[..]
            && rest.len() < 2
        {
            let normal = match rest {
                [second, ..] => first.cross(*second),
                // A single direction: a plane of the base that holds it, if there is one.
                _ => [Axis::Z, Axis::Y, Axis::X]
                    .map(Vector::unit)
                    .into_iter()
                    .find(|e| e.dot(*first).abs() <= 1e-9)
                    .unwrap_or_else(|| first.any_across()),
            };
            self.section = Section::Plane { directions: across(normal) };
            self.shoulder = movers.iter().copied().find(|&j| is_angle[j]).and_then(|j| {
                // Slides before it carry the shoulder along.
                (movers.first() == Some(&j)).then(|| self.walk.row_of(j).map(|r| self.walk.axes[r].point))?
            });
            return Ok(());
        }
        self.dimension = 3;
        if self.choose_axis(&movers, is_angle) {
            return Ok(());
        }
        let [x, y, z] = Axis::ALL.map(Vector::unit);
        let extent = |u: Vector<f64>| all.iter().map(|c| c.dot(u).abs()).fold(0.0, f64::max);
        let moves = |u: Vector<f64>| extent(u) > 1e-7 * self.length;
        let directions = match (moves(x), moves(z)) {
            (true, true) => [x, z],
            (false, _) => [y, z],
            (true, false) => [x, y],
        };
        self.section = Section::Projection { directions };
        Ok(())
    }

    /// The half plane through the first axis that turns, slides that carry it elsewhere held in the middle; false if
    /// that shows nothing. The last walk was to the middle.
    fn choose_axis(&mut self, movers: &[usize], is_angle: &[bool]) -> bool {
        let mut slides = vec![];
        let mut turning = None;
        for (k, &j) in movers.iter().enumerate() {
            let Some(row) = self.walk.row_of(j) else { break };
            if is_angle[j] {
                turning = Some((k, j, row));
                break;
            }
            slides.push((j, self.walk.axes[row].direction));
        }
        let Some((k, joint, row)) = turning else { return false };
        let ways: Vec<Vector<f64>> = slides.iter().map(|s| s.1).collect();
        if span(&ways, 1e-7).len() > 2 {
            return false;
        }
        let Line { direction, point: on } = self.walk.axes[row];
        let direction = upwards(direction);
        let point = on - direction.scale(on.dot(direction));
        self.section = Section::ThroughAxis { joint, point, direction };
        let second = movers.get(k + 1).and_then(|&j| self.walk.row_of(j).filter(|_| is_angle[j]));
        self.shoulder = second.and_then(|r| foot(self.walk.axes[row], self.walk.axes[r]));
        let middle = self.middle();
        let across: Vec<usize> =
            slides.iter().filter(|s| s.1.cross(direction).norm() > 1e-7).map(|s| s.0).collect();
        if !slides.is_empty() && across.len() < slides.len() {
            // A slide along the axis carries the shoulder.
            self.shoulder = None;
        }
        for &j in &across {
            self.held.push(Assumed { joint: j, range: [middle[j]; 2] });
            self.ranges[j] = Range { low: middle[j], high: middle[j], is_endless: false };
            self.weights[j] = 0.0;
        }
        self.movers -= across.len();
        true
    }
}

/// The point of a line that is nearest to another; none if they are parallel.
fn foot(first: Line<f64>, second: Line<f64>) -> Option<Vector<f64>> {
    let (a, p) = (first.direction, first.point);
    let (b, q) = (second.direction, second.point);
    let n = a.cross(b);
    let square = n.dot(n);
    (square > 1e-9).then(|| p + a.scale((q - p).cross(b).dot(n) / square))
}

/// Up to three orthonormal directions that some vectors have, the largest first; what is smaller than `least` is nothing.
fn span(vectors: &[Vector<f64>], least: f64) -> Vec<Vector<f64>> {
    let mut found: Vec<Vector<f64>> = vec![];
    while found.len() < 3 {
        let rest = |v: &Vector<f64>| found.iter().fold(*v, |v, d| v - d.scale(d.dot(v)));
        let largest = vectors.iter().map(rest).max_by(|a, b| a.norm().total_cmp(&b.norm()));
        match largest {
            Some(v) if v.norm() > least => found.push(v.scale(1.0 / v.norm())),
            _ => break,
        }
    }
    found
}

/// Points that fill a box evenly: multiples of powers of the root of xⁿ⁺¹ = x + 1, without their whole parts (Roberts 2018).
pub(super) struct Sequence {
    steps: Vec<f64>,
    at: Vec<f64>,
}

impl Sequence {
    /// One in so many dimensions.
    pub fn new(dimension: usize) -> Self {
        let d = i32::try_from(dimension).unwrap_or(i32::MAX).saturating_add(1);
        let mut root = 2.0_f64;
        for _ in 0..60 {
            root = (1.0 + root).powf(1.0 / f64::from(d));
        }
        let mut power = 1.0;
        let mut next = || {
            power /= root;
            power
        };
        Sequence { steps: (0..dimension).map(|_| next()).collect(), at: vec![0.5; dimension] }
    }

    /// The next configuration.
    pub fn next(&mut self, ranges: &[Range], q: &mut [f64]) {
        for (((x, at), step), r) in q.iter_mut().zip(&mut self.at).zip(&self.steps).zip(ranges) {
            *at = (*at + step).fract();
            *x = r.low + (r.high - r.low) * *at;
        }
    }
}
