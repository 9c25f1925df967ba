//! The arm with errors: a twist behind each constant between two axes, a gain for each joint, things beside the arm.
//!
//! A constant with its error is Cₖ·Tr(v)·exp(w): six numbers (w, v) for each of the n + 1 constants are all errors of geometry
//! that there are. Link 0 stands before the first axis, link n behind the last; the frame of a link is the one at its end, so
//! that z of link k is axis k + 1.

use crate::measurement::{Fixture, Measurement, Reading, halves, residual, seen};
use denavit::geometry::{Axis, Rotation, Transform, Vector};
use denavit::random::Random;
use denavit_recording::Arm;
use denavit_recording::turns::exp;
use std::ops::Range;

/// A number of the model that may be off.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Parameter {
    /// A turn of the end of a link about an axis of its frame there, radians.
    Turn(usize, Axis),
    /// A shift along an axis of that frame, metres.
    Shift(usize, Axis),
    /// What a joint moves more, as a part of what it should.
    Gain(usize),
    /// A number of a thing beside the arm: which thing, which number.
    Fixture(usize, usize),
}

/// What an arm is measured by: the kind, the point, what else may be off.
#[derive(Clone, Debug)]
pub struct Problem {
    /// The arm.
    pub arm: Arm,
    /// Its constants, the point of the tool in the last.
    pub constants: Vec<Transform<f64>>,
    /// What is measured.
    pub measurement: Measurement,
    /// Whether joints have gains.
    pub gains: bool,
    /// The things beside the arm, as they are supposed.
    pub fixtures: Vec<Fixture>,
    /// Configurations at which the point is about on the surface of one of them; none where any may lead there.
    pub near: Vec<(Vec<f64>, usize)>,
}

/// The values of all parameters.
#[derive(Clone, PartialEq, Debug)]
pub struct State {
    /// Of the links and gains, in their order.
    pub x: Vec<f64>,
    /// The things beside the arm.
    pub fixtures: Vec<Fixture>,
}

const AXES: [Axis; 3] = [Axis::X, Axis::Y, Axis::Z];

impl Problem {
    /// With the point of the tool that is measured, in the tool's frame; the things beside the arm are in the base.
    pub fn new(
        arm: &Arm,
        measurement: Measurement,
        point: Vector<f64>,
        gains: bool,
        fixtures: Vec<Fixture>,
    ) -> Self {
        let mut constants = arm.constants.clone();
        if let Some(last) = constants.last_mut() {
            *last = *last * Transform::translation(point[0], point[1], point[2]);
        }
        Problem { arm: arm.clone(), constants, measurement, gains, fixtures, near: vec![] }
    }

    /// The number of the last link.
    pub fn last(&self) -> usize {
        self.arm.moving.len()
    }

    /// All parameters, in their order: links from the base, turns before shifts; gains; things beside the arm.
    pub fn parameters(&self) -> Vec<Parameter> {
        let links = (0..=self.last()).flat_map(|k| {
            AXES.into_iter()
                .map(move |a| Parameter::Turn(k, a))
                .chain(AXES.into_iter().map(move |a| Parameter::Shift(k, a)))
        });
        let gains = (0..if self.gains { self.arm.joints() } else { 0 }).map(Parameter::Gain);
        let each = self.measurement.of_fixture();
        let fixtures =
            (0..self.fixtures.len()).flat_map(|f| (0..each).map(move |k| Parameter::Fixture(f, k)));
        links.chain(gains).chain(fixtures).collect()
    }

    /// How many numbers links have.
    pub fn of_links(&self) -> usize {
        6 * (self.last() + 1)
    }

    /// How many parameters there are but for those of things beside the arm.
    pub fn of_arm(&self) -> usize {
        self.of_links() + if self.gains { self.arm.joints() } else { 0 }
    }

    /// The places of a thing's parameters.
    pub fn of_fixture(&self, f: usize) -> Range<usize> {
        let (from, each) = (self.of_arm(), self.measurement.of_fixture());
        from + f * each..from + (f + 1) * each
    }

    /// The model as it is written down.
    pub fn nominal(&self) -> State {
        State { x: vec![0.0; self.of_arm()], fixtures: self.fixtures.clone() }
    }

    /// A state moved by a step in all parameters.
    pub fn stepped(&self, state: &State, step: &[f64]) -> State {
        let x = state.x.iter().zip(step).map(|(x, d)| x + d).collect();
        let moved =
            |(f, fixture): (usize, &Fixture)| fixture.moved(self.measurement, &step[self.of_fixture(f)]);
        State { x, fixtures: state.fixtures.iter().enumerate().map(moved).collect() }
    }

    /// The constants with their errors.
    pub fn constants_at(&self, state: &State) -> Vec<Transform<f64>> {
        let with = |(k, c): (usize, &Transform<f64>)| {
            let (w, v) = link(&state.x, k);
            *c * Transform::from_rotation_translation(exp(w), v)
        };
        self.constants.iter().enumerate().map(with).collect()
    }

    /// The joints with their gains.
    pub fn joints_at(&self, state: &State, q: &[f64]) -> Vec<f64> {
        let gain = |j: usize| if self.gains { 1.0 + state.x[self.of_links() + j] } else { 1.0 };
        q.iter().enumerate().map(|(j, q)| gain(j) * q).collect()
    }

    /// How the hand moves with each joint, as twists: the columns of the geometric Jacobian at the base's origin.
    pub fn joint_twists(&self, before: &[Transform<f64>]) -> Vec<[f64; 6]> {
        let mut all = vec![[0.0; 6]; self.arm.joints()];
        for (axis, frame) in self.arm.moving.iter().zip(before) {
            let twist = along(frame, Axis::Z, axis.turns);
            for &(j, by) in &axis.terms {
                all[j].iter_mut().zip(twist).for_each(|(a, b)| *a += by * b);
            }
        }
        all
    }

    /// The hand, and how it moves with each parameter of links and gains.
    pub fn twists(
        &self,
        state: &State,
        constants: &[Transform<f64>],
        q: &[f64],
    ) -> (Transform<f64>, Vec<[f64; 6]>) {
        let q_gained = self.joints_at(state, q);
        let (mut frames, hand) = self.arm.frames_with(constants, &q_gained);
        let before = frames.clone();
        frames.push(hand);
        let mut all = Vec::with_capacity(self.of_arm());
        for (k, frame) in frames.iter().enumerate() {
            let (w, _) = link(&state.x, k);
            // exp(w + dw) = exp(w)·exp(J dw)
            let inner = right_jacobian(w);
            for column in inner {
                let axis = frame.rotation * column;
                let v = frame.translation.cross(axis);
                all.push([axis[0], axis[1], axis[2], v[0], v[1], v[2]]);
            }
            let shifted = frame.rotation * exp(-w);
            for axis in AXES {
                let v = shifted.column(axis);
                all.push([0.0, 0.0, 0.0, v[0], v[1], v[2]]);
            }
        }
        if self.gains {
            let joints = self.joint_twists(&before);
            all.extend(joints.into_iter().zip(q).map(|(t, q)| t.map(|x| q * x)));
        }
        (hand, all)
    }

    /// Derivatives of one row's numbers by all parameters, by rows, and the hand.
    pub fn derivatives(
        &self,
        state: &State,
        constants: &[Transform<f64>],
        q: &[f64],
        group: usize,
    ) -> (Transform<f64>, Vec<Vec<f64>>) {
        let (hand, twists) = self.twists(state, constants, q);
        let width = self.measurement.width();
        let count = self.of_arm() + state.fixtures.len() * self.measurement.of_fixture();
        let mut rows = vec![vec![0.0; count]; width];
        let fixture = state.fixtures.get(group);
        let mut out = [0.0; 6];
        for (p, twist) in twists.iter().enumerate() {
            seen(self.measurement, &hand, fixture, twist, &mut out);
            rows.iter_mut().zip(out).for_each(|(row, x)| row[p] = x);
        }
        if let Some(f) = fixture {
            let own = f.derivatives(self.measurement, hand.translation);
            rows[0][self.of_fixture(group)].copy_from_slice(&own);
        }
        (hand, rows)
    }

    /// What is measured less what the model says.
    pub fn residual(
        &self,
        state: &State,
        constants: &[Transform<f64>],
        q: &[f64],
        reading: &Reading,
    ) -> [f64; 6] {
        let hand = self.arm.pose_with(constants, &self.joints_at(state, q));
        let mut out = [0.0; 6];
        residual(self.measurement, &hand, state.fixtures.get(reading.group), reading, &mut out);
        out
    }

    /// Configurations within the limits, at random; on the surface of a thing beside the arm where there is one. As many as are
    /// found.
    pub fn samples(&self, count: usize, seed: u64) -> Vec<Vec<f64>> {
        self.samples_on(0, count, seed)
    }

    /// The same, on the surface of this thing beside the arm.
    pub fn samples_on(&self, fixture: usize, count: usize, seed: u64) -> Vec<Vec<f64>> {
        let mut random = Random(seed);
        let starts: Vec<&Vec<f64>> = self.near.iter().filter(|n| n.1 == fixture).map(|n| &n.0).collect();
        let is_on_surface = self.measurement.is_on_surface();
        let mut all = vec![];
        for k in 0..20 * count {
            if all.len() == count {
                break;
            }
            let q: Vec<f64> = if is_on_surface && !starts.is_empty() {
                let start = starts[k % starts.len()];
                let by = |j: usize| if self.arm.turns[j] { 0.6 } else { 0.2 };
                (0..start.len()).map(|j| start[j] + by(j) * (random.unit() - 0.5)).collect()
            } else {
                self.arm.limits.iter().map(|[low, high]| low + (high - low) * random.unit()).collect()
            };
            if is_on_surface {
                all.extend(self.on_surface(fixture, q));
            } else {
                all.push(q);
            }
        }
        all
    }

    /// The configuration on the surface that the steepest way leads to.
    fn on_surface(&self, fixture: usize, mut q: Vec<f64>) -> Option<Vec<f64>> {
        let fixture = self.fixtures.get(fixture)?;
        for _ in 0..60 {
            let (before, hand) = self.arm.frames_with(&self.constants, &q);
            let off = fixture.reading(self.measurement, hand.translation);
            if off.abs() < 1e-13 {
                return Some(q);
            }
            let gradient: Vec<f64> = self
                .joint_twists(&before)
                .iter()
                .map(|t| {
                    let (w, v) = halves(t);
                    let at = v + w.cross(hand.translation);
                    fixture.gradient(self.measurement, hand.translation).dot(at)
                })
                .collect();
            let size: f64 = gradient.iter().map(|g| g * g).sum();
            if !size.is_finite() || !off.is_finite() || size < 1e-6 {
                return None;
            }
            // A step of at most half a radian.
            let by = (off / size).clamp(-0.5 / size.sqrt(), 0.5 / size.sqrt());
            q.iter_mut().zip(&gradient).for_each(|(q, g)| *q -= by * g);
        }
        None
    }
}

/// (w, v) of a link.
pub fn link(x: &[f64], k: usize) -> (Vector<f64>, Vector<f64>) {
    (Vector([x[6 * k], x[6 * k + 1], x[6 * k + 2]]), Vector([x[6 * k + 3], x[6 * k + 4], x[6 * k + 5]]))
}

/// The twist of a turn about an axis of a frame, or of a shift along it.
pub fn along(frame: &Transform<f64>, axis: Axis, turns: bool) -> [f64; 6] {
    let a = frame.rotation.column(axis);
    if turns {
        let v = frame.translation.cross(a);
        [a[0], a[1], a[2], v[0], v[1], v[2]]
    } else {
        [0.0, 0.0, 0.0, a[0], a[1], a[2]]
    }
}

/// A twist in other coordinates: Ad(X) (ω, v) = (R ω, R v + t × R ω).
pub fn adjoint(x: &Transform<f64>, twist: &[f64; 6]) -> [f64; 6] {
    let (w, v) = halves(twist);
    let w = x.rotation * w;
    let v = x.rotation * v + x.translation.cross(w);
    [w[0], w[1], w[2], v[0], v[1], v[2]]
}

/// J of exp(w + dw) = exp(w)·exp(J dw), by its columns.
fn right_jacobian(w: Vector<f64>) -> [Vector<f64>; 3] {
    let t = w.norm();
    let (a, b) = if t > 1e-4 {
        ((1.0 - t.cos()) / (t * t), (t - t.sin()) / (t * t * t))
    } else {
        (0.5 - t * t / 24.0, 1.0 / 6.0 - t * t / 120.0)
    };
    AXES.map(|axis| {
        let e = Vector::unit(axis);
        let c = w.cross(e);
        e - c.scale(a) + w.cross(c).scale(b)
    })
}

/// A frame with this z.
pub fn frame_along(z: Vector<f64>, at: Vector<f64>) -> Transform<f64> {
    let z = z.scale(1.0 / z.norm());
    let x = z.any_across();
    let x = x.scale(1.0 / x.norm());
    let y = z.cross(x);
    let rows = std::array::from_fn(|i| [x[i], y[i], z[i]]);
    Transform::from_rotation_translation(Rotation::from_rows(rows), at)
}
