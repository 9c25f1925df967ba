//! Where the frames of a robot are: in numbers, and as formulas.

use crate::pose::{Matrix, Orientation};
use crate::program::Step;
use crate::robot::{Formulas, Joint};
use crate::{Schema, words};
use denavit::geometry::orientation::OrientationSet;
use denavit_report::Derivation;
use denavit_report::words::Terms as _;
use denavit_symbolic::Expr;
use denavit_symbolic::print::Style;
use serde::Serialize;
use std::collections::BTreeMap;

/// The tool in the base at a configuration.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Placed<'a> {
    /// The frames that were asked for, in the base.
    #[serde(skip_serializing_if = "<[Matrix]>::is_empty")]
    pub frames: &'a [Matrix],
    /// The tool's orientation, where a set was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub orientation: Option<Orientation>,
    /// The tool.
    pub pose: Matrix,
    /// The joint variables.
    pub q: &'a [f64],
    /// The robot's name.
    pub robot: &'a str,
    /// The version.
    pub schema: Schema,
    /// Whether all joints are within their limits, where the robot has some.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub within_limits: Option<bool>,
}

impl Placed<'_> {
    /// Appends a line; compiled here, because there may be millions.
    pub fn write(&self, out: &mut Vec<u8>) {
        crate::line(self, out);
    }
}

/// All bodies of a tree at a configuration.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct PlacedTree<'a> {
    /// The bodies in the root, in the order of the file.
    pub frames: &'a [NamedPose<'a>],
    /// The joints that move by themselves, by name.
    pub joints: &'a [String],
    /// Their values.
    pub q: &'a [f64],
    /// The robot's name.
    pub robot: &'a str,
    /// The version.
    pub schema: Schema,
    /// Whether all joints are within their limits, where the robot has some.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub within_limits: Option<bool>,
}

impl PlacedTree<'_> {
    /// Appends a line.
    pub fn write(&self, out: &mut Vec<u8>) {
        crate::line(self, out);
    }
}

/// A frame with a name.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct NamedPose<'a> {
    /// The name.
    pub name: &'a str,
    /// The pose.
    pub pose: Matrix,
}

/// The link transforms and a forward model.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Derived {
    /// The convention of the table.
    pub convention: &'static str,
    /// The model.
    pub forward: Model,
    /// The joints.
    pub joints: Vec<Joint>,
    /// Row by row, frame k in frame k − 1.
    pub links: Vec<Formulas>,
    /// The orientation as angles, where a set was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub orientation: Option<Angles>,
    /// A point in the frame that the pose is given in, where one was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub point: Option<[String; 3]>,
    /// The robot's name.
    pub robot: String,
    /// The version.
    pub schema: Schema,
    /// A free vector in that frame, where one was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub vector: Option<[String; 3]>,
}

/// An orientation as formulas of angles, where it is not singular.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Angles {
    /// The formulas by name.
    pub angles: BTreeMap<&'static str, String>,
    /// The set: `rpy`, `zyz`.
    pub set: String,
}

impl Angles {
    /// Formulas printed by `text`.
    pub fn of(set: OrientationSet, all: &[(&'static str, Expr)], text: impl Fn(Expr) -> String) -> Self {
        Angles { angles: all.iter().map(|(name, e)| (*name, text(*e))).collect(), set: set.to_string() }
    }
}

/// A frame in another, as formulas.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Model {
    /// What the steps cost.
    pub count: Cost,
    /// The frame that it is given in: `0`, `base`.
    pub from: String,
    /// The pose; null if it is too large to expand.
    pub matrix: Option<Formulas>,
    /// What is proved of the steps.
    pub proof: String,
    /// Names of sines and cosines, then a program for the matrix.
    pub steps: Vec<Step>,
    /// The frame: `6`, `tool`.
    pub to: String,
}

/// The operations of a program, and how long they take.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Cost {
    /// Additions and subtractions.
    pub additions: u32,
    /// An estimate for one evaluation in a batch on four lanes.
    pub cycles: f64,
    /// The longest chain of operations.
    pub depth: usize,
    /// Operations on parameters alone, done once.
    pub hoisted: u32,
    /// Multiplications.
    pub multiplications: u32,
    /// Additions of a constant to a variable as it comes in.
    pub offsets: u32,
    /// Angles of which a sine or a cosine is taken.
    pub sincos: u32,
}

impl From<&denavit_program::Program> for Cost {
    fn from(program: &denavit_program::Program) -> Self {
        let count = program.count();
        Cost {
            additions: count.additions,
            cycles: program.cycles(),
            depth: program.depth(),
            hoisted: count.hoisted,
            multiplications: count.multiplications,
            offsets: count.offsets,
            sincos: count.sincos,
        }
    }
}

impl Derived {
    /// A derivation.
    pub fn of(d: &Derivation) -> Self {
        let [from, to] = d.frames();
        let text = |e: Expr| d.text(e, Style::Ascii);
        let rows = |m: &[[Expr; 4]; 4]| m.map(|row| row.map(text));
        let short = |(name, value)| Step { name, output: false, value: d.in_full(value, Style::Ascii) };
        let trigonometry = d.trigonometry().into_iter().map(short);
        Derived {
            convention: d.description.convention.name(),
            forward: Model {
                count: Cost::from(&d.model.algorithm),
                from,
                matrix: d.model.matrix.as_ref().ok().map(rows),
                proof: words().forward_proof(d.model.proof),
                steps: trigonometry.chain(d.steps.iter().map(|s| Step::of(s, text))).collect(),
                to,
            },
            joints: d.description.variables().iter().map(Joint::from).collect(),
            links: d.links.iter().map(rows).collect(),
            orientation: None,
            point: None,
            robot: d.description.name.clone(),
            schema: Schema,
            vector: None,
        }
    }
}
