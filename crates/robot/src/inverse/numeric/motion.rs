//! Frames and the motions of their joints, from one program.
//!
//! The program gives the axis and a point of every joint that moves, and the frames of the tasks. The derivatives of
//! the frames by the joints are the screws of these axes (Whitney 1972): ω = z, v = z × (p − o) for a joint that
//! turns, v = z for one that slides; a joint that stands in several rows moves by their sum.

use super::task::{Frame, Linear, Place, Shape, apply, cross, sub};
use crate::description::Description;
use crate::forward::{Reference, frames_program};
use crate::inverse::space::JointSpace;
use crate::robot::{MissingValue, Robot};
use denavit_program::{Graph, Program, Scalar, Value};
use denavit_symbolic::Expr;
use rustc_hash::FxHashSet;

/// A row of the table that a joint moves: the row's axis, and by how much.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Mover {
    row: usize,
    /// Where axis and point stand among the program's results.
    at: usize,
    joint: usize,
    /// Radians about the axis, and displacement along it, for one unit of the joint.
    turn: f64,
    slide: f64,
}

/// A frame of a task: the rows before it move it.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Moved {
    rows: usize,
    at: usize,
}

/// Computes the frames of tasks and how they move.
#[derive(Clone, Debug)]
pub(super) struct Motion {
    scalar: Scalar,
    movers: Vec<Mover>,
    frames: Vec<Moved>,
    /// How many joints there are.
    pub joints: usize,
    /// One unit of each joint as the solver counts it: a radian, or a length of the arm.
    pub units: Vec<f64>,
}

/// Tasks at a configuration: residuals and their derivatives, six for each task; task by task, joint by joint.
#[derive(Clone, Debug, Default)]
pub(super) struct Point {
    /// Radians and metres.
    pub q: Vec<f64>,
    /// Weighted residuals.
    pub r: Vec<[f64; 6]>,
    /// By how much the residuals fall with a unit of each joint.
    pub c: Vec<[f64; 6]>,
    /// Σ r².
    pub cost: f64,
}

impl Motion {
    /// For frames of a robot.
    ///
    /// # Errors
    /// If a parameter has no value.
    pub fn new(
        description: &Description,
        robot: &Robot<f64>,
        space: &JointSpace,
        frames: &[Frame],
    ) -> Result<Self, MissingValue> {
        let rows = description.rows.len();
        let mut references = vec![];
        let mut movers = vec![];
        let mut results = 0;
        for (row, link) in robot.links.iter().enumerate() {
            let mut joints: Vec<usize> = link.theta.terms.iter().chain(&link.d.terms).map(|t| t.0).collect();
            joints.sort_unstable();
            joints.dedup();
            let factor = |terms: &[(usize, f64)], j: usize| {
                terms.iter().filter(|t| t.0 == j).map(|t| t.1).sum::<f64>()
            };
            for &joint in &joints {
                let unit = if space.is_angle[joint] { 1.0 } else { space.reach };
                let turn = factor(&link.theta.terms, joint) * unit;
                let slide = factor(&link.d.terms, joint) * unit;
                movers.push(Mover { row, at: results, joint, turn, slide });
            }
            if !joints.is_empty() {
                references.push(Reference::Frame(description.convention.axis_frame(row)));
                results += 6;
            }
        }
        let axes = references.len();
        let mut moved = vec![];
        for frame in frames {
            let (reference, rows) = match *frame {
                Frame::Tool => (Reference::Tool, rows),
                Frame::Link(i) => (Reference::Frame(i.min(rows)), i.min(rows)),
            };
            references.push(reference);
            moved.push(Moved { rows, at: results });
            results += 12;
        }
        let program = program(description, &references, axes);
        let scalar = program.compile(&description.values(program.parameters())?).scalar();
        let units = space.is_angle.iter().map(|&a| if a { 1.0 } else { space.reach }).collect();
        Ok(Motion { scalar, movers, frames: moved, joints: robot.joints, units })
    }

    /// The frames at a configuration.
    pub fn places(&mut self, q: &[f64]) -> Vec<Place> {
        let results = self.scalar.eval(q);
        self.frames.iter().map(|f| place(results, f.at)).collect()
    }

    /// Residuals and derivatives at `point.q`.
    pub fn evaluate(&mut self, shapes: &[Shape], targets: &[Place], point: &mut Point) {
        let results = self.scalar.eval(&point.q);
        let n = self.joints;
        point.r.resize(shapes.len(), [0.0; 6]);
        point.c.resize(shapes.len() * n, [0.0; 6]);
        let mut cost = 0.0;
        let tasks = shapes.iter().zip(targets).zip(&self.frames);
        for (((shape, target), frame), (r, c)) in
            tasks.zip(point.r.iter_mut().zip(point.c.chunks_exact_mut(n.max(1))))
        {
            let at = place(results, frame.at);
            let linear = shape.linear(&at, target);
            *r = linear.r;
            cost += linear.r.iter().map(|x| x * x).sum::<f64>();
            c.fill([0.0; 6]);
            for mover in self.movers.iter().take_while(|m| m.row < frame.rows) {
                let axis: &[f64; 6] = results[mover.at..].first_chunk().unwrap_or(&[0.0; 6]);
                add_motion(&mut c[mover.joint], mover, axis, &at, &linear);
            }
        }
        point.cost = cost;
    }
}

#[inline(always)]
fn add_motion(column: &mut [f64; 6], mover: &Mover, axis: &[f64; 6], at: &Place, linear: &Linear) {
    let [x, y, z, ox, oy, oz] = *axis;
    let z = [x, y, z];
    let lever = cross(z, sub(at.p, [ox, oy, oz]));
    let turn = z.map(|x| mover.turn * x);
    let shift = [0, 1, 2].map(|i| mover.turn * lever[i] + mover.slide * z[i]);
    let turn = linear.turn.as_ref().map_or(turn, |m| apply(m, turn));
    let shift = linear.shift.as_ref().map_or(shift, |m| apply(m, shift));
    let [a, b] = linear.weights;
    for i in 0..3 {
        column[i] += a * turn[i];
        column[3 + i] += b * shift[i];
    }
}

fn place(results: &[f64], at: usize) -> Place {
    let x: &[f64; 12] = results[at..].first_chunk().unwrap_or(&[0.0; 12]);
    Place { r: [[x[0], x[1], x[2]], [x[3], x[4], x[5]], [x[6], x[7], x[8]]], p: [x[9], x[10], x[11]] }
}

/// z and origin of the first `axes` frames, rotation by rows and origin of the others.
fn program(description: &Description, frames: &[Reference], axes: usize) -> Program {
    let whole = frames_program(description, frames);
    let entries: Vec<Expr> = whole.formulas();
    let mut graph = Graph::new(whole.variables(), whole.parameters());
    let mut results: Vec<(String, Value)> = vec![];
    for (k, matrix) in entries.chunks_exact(16).enumerate() {
        let rotation = [0, 1, 2, 4, 5, 6, 8, 9, 10];
        let chosen = if k < axes { &[2, 6, 10][..] } else { &rotation[..] };
        for &i in chosen.iter().chain(&[3, 7, 11]) {
            results.push((format!("x{k}_{i}"), graph.trace(matrix[i])));
        }
    }
    Program::new(&graph, &results, |_| None, &FxHashSet::default())
}
