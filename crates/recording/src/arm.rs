//! The arm in numbers as the search moves it: C₀ A₁ C₁ … Aₙ Cₙ, each A a turn about z or a slide along it.

use denavit::description::JointKind;
use denavit::geometry::{Axis, Rotation, Transform, Vector};
use denavit::mechanism::MovingAxes;
use denavit::mechanism::axes::Lengths;
use denavit::robot::MissingValue;
use denavit::space::JointSpace;
use denavit::{Description, Robot, catalogue};
use std::f64::consts::PI;
use std::sync::OnceLock;

/// What a slide without limits is taken to move in, metres.
const SLIDE: [f64; 2] = [0.05, 0.45];

/// An arm with numbers.
#[derive(Clone, Debug)]
pub struct Arm {
    /// What it is called.
    pub name: String,
    /// The names of its joint variables.
    pub names: Vec<String>,
    /// What its file calls the joints.
    pub joint_names: Vec<String>,
    /// Which joints turn.
    pub turns: Vec<bool>,
    /// Their limits; half a turn either way where a turning joint has none.
    pub limits: Vec<[f64; 2]>,
    /// The axes that move, base first.
    pub moving: Vec<Moving>,
    /// The constants between the moving axes.
    pub constants: Vec<Transform<f64>>,
}

/// An axis that moves: it turns about z, or slides along it.
#[derive(Clone, Debug)]
pub struct Moving {
    /// Whether it turns.
    pub turns: bool,
    /// How much it moves for one of each joint.
    pub terms: Vec<(usize, f64)>,
}

impl Moving {
    /// Its angle or displacement.
    pub fn value(&self, q: &[f64]) -> f64 {
        self.terms.iter().map(|&(j, k)| k * q[j]).sum()
    }
}

impl Arm {
    /// Of a description.
    ///
    /// # Errors
    /// If a parameter has no value.
    pub fn new(name: &str, description: &Description) -> Result<Self, MissingValue> {
        let axes = MovingAxes::new(&Robot::numeric(description)?, Lengths::Behind);
        let space = JointSpace::without_lengths(description);
        let mut constants = axes.constants;
        // What a joint has at rest stands before it: turns about one axis commute.
        for (k, axis) in axes.moving.iter().enumerate() {
            constants[k] = constants[k] * axis.at_rest();
        }
        let moving = axes
            .moving
            .iter()
            .map(|a| Moving { turns: a.kind == JointKind::Revolute, terms: a.value.terms.clone() })
            .collect();
        let limits = space.limits.iter().zip(&space.is_angle);
        let names: Vec<String> =
            description.variables().iter().map(|v| v.symbol.name().to_string()).collect();
        Ok(Arm {
            name: name.into(),
            joint_names: description.joint_names().unwrap_or_else(|| names.clone()),
            names,
            limits: limits.map(|(l, &a)| l.unwrap_or(if a { [-PI, PI] } else { SLIDE })).collect(),
            turns: space.is_angle,
            moving,
            constants,
        })
    }

    /// How many joints there are.
    pub fn joints(&self) -> usize {
        self.turns.len()
    }

    /// The joints that turn.
    pub fn turning(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.joints()).filter(|&i| self.turns[i])
    }

    /// The tool in the base, with constants of one's own.
    pub fn pose_with(&self, constants: &[Transform<f64>], q: &[f64]) -> Transform<f64> {
        let mut x = constants[0];
        for (axis, c) in self.moving.iter().zip(&constants[1..]) {
            x = moved(&x, axis.turns, axis.value(q)) * *c;
        }
        x
    }

    /// The frame before each axis moves, whose z is the axis, and the tool, in the base.
    pub fn frames_with(
        &self,
        constants: &[Transform<f64>],
        q: &[f64],
    ) -> (Vec<Transform<f64>>, Transform<f64>) {
        let mut x = constants[0];
        let mut before = Vec::with_capacity(self.moving.len());
        for (axis, c) in self.moving.iter().zip(&constants[1..]) {
            before.push(x);
            x = moved(&x, axis.turns, axis.value(q)) * *c;
        }
        (before, x)
    }

    /// The tool in the base.
    pub fn pose(&self, q: &[f64]) -> Transform<f64> {
        self.pose_with(&self.constants, q)
    }

    /// How the tool is turned.
    pub fn rotation(&self, q: &[f64]) -> Rotation<f64> {
        let mut r = self.constants[0].rotation;
        for (axis, c) in self.moving.iter().zip(&self.constants[1..]) {
            if axis.turns {
                r = about_z(&r, axis.value(q));
            }
            r = r * c.rotation;
        }
        r
    }

    /// What stands before and behind a joint at a configuration; nothing of a joint that moves several axes, or one by a gear.
    pub fn around(&self, joint: usize, q: &[f64]) -> Option<[Transform<f64>; 2]> {
        let with = |a: &Moving| a.terms.iter().any(|t| t.0 == joint);
        let at = self.moving.iter().position(with)?;
        if self.moving.iter().filter(|a| with(a)).count() > 1 || self.moving[at].terms.len() > 1 {
            return None;
        }
        if self.moving[at].terms[0].1 != 1.0 {
            return None;
        }
        let mut before = self.constants[0];
        for k in 0..at {
            let axis = &self.moving[k];
            before = moved(&before, axis.turns, axis.value(q)) * self.constants[k + 1];
        }
        let mut behind = self.constants[at + 1];
        for k in at + 1..self.moving.len() {
            let axis = &self.moving[k];
            behind = moved(&behind, axis.turns, axis.value(q)) * self.constants[k + 1];
        }
        Some([before, behind])
    }

    /// The lengths that are no frame's: between the first axis and the last, with the coordinate that has them. One along the
    /// first axis is a shift of the base, one along the last of the tool.
    pub fn lengths(&self) -> Vec<(usize, usize)> {
        let last = self.constants.len() - 1;
        let of = |k: usize| (0..3).map(move |axis| (k, axis));
        let is_own = |&(k, axis): &(usize, usize)| {
            let along_first = k == 1 && axis == 2;
            let along_last = k + 1 == last && self.constants[k].rotation.z()[axis].abs() > 1.0 - 1e-9;
            self.constants[k].translation[axis].abs() > 0.02 && !along_first && !along_last
        };
        (1..last).flat_map(of).filter(is_own).collect()
    }

    /// True for an arm whose joints are of the same kinds, in the same order.
    pub fn is_like(&self, other: &Arm) -> bool {
        self.turns == other.turns
    }
}

/// The arms of the catalogue.
pub fn all() -> &'static [Arm] {
    static ALL: OnceLock<Vec<Arm>> = OnceLock::new();
    ALL.get_or_init(|| {
        let arm = |name: &&str| Arm::new(name, &catalogue::robot(name)?).ok();
        catalogue::names().iter().filter_map(arm).collect()
    })
}

#[inline]
fn moved(x: &Transform<f64>, turns: bool, by: f64) -> Transform<f64> {
    if turns {
        Transform::from_rotation_translation(about_z(&x.rotation, by), x.translation)
    } else {
        Transform::from_rotation_translation(x.rotation, x.translation + x.rotation.z().scale(by))
    }
}

/// R·Rz(angle)
#[inline]
fn about_z(r: &Rotation<f64>, angle: f64) -> Rotation<f64> {
    let (s, c) = angle.sin_cos();
    let row = |[a, b, z]: [f64; 3]| [a * c + b * s, b * c - a * s, z];
    let [x, y, z] = r.rows();
    Rotation::from_rows([row(x), row(y), row(z)])
}

/// An axis of the mirror that makes a left-handed recording: the turn −S of S = 1 − 2 e eᵀ, a half turn about e.
pub fn half_turn(axis: Axis) -> Rotation<f64> {
    let e: Vector<f64> = Vector::unit(axis);
    let entry = |i: usize, j: usize| 2.0 * e[i] * e[j] - f64::from(u8::from(i == j));
    Rotation::from_rows(std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j))))
}
