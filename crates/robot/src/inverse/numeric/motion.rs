//! Frames and the motions of their joints, from one program.
//!
//! The program gives the axis and a point of every row that moves, and the frames of the tasks; the derivatives of the
//! frames by the joints are the screws of these axes ([`Line::twist`]).

use super::task::{Frame, Linear, Place, Shape, apply};
use crate::description::Description;
use crate::geometry::Vector;
use crate::mechanism::{Line, MissingValue, Mover, Robot, Twist, Walk};
use crate::space::JointSpace;
use denavit_program::{Graph, Program, Scalar, Value};
use denavit_symbolic::{Expr, Symbol};
use rustc_hash::FxHashSet;

/// A row of the table and a joint that moves it.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Moving {
    row: usize,
    /// Where the row's axis stands among the program's results: its direction and a point.
    at: usize,
    /// For one unit of the joint.
    mover: Mover<f64>,
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
    movers: Vec<Moving>,
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
        let units = space.is_angle.iter().map(|&a| if a { 1.0 } else { space.reach }).collect::<Vec<_>>();
        let walk = Walk::merged(description);
        let mut results: Vec<Expr> = vec![];
        let mut movers = vec![];
        for (row, (link, axis)) in robot.links.iter().zip(walk.axes()).enumerate().filter(|r| r.1.0.moves()) {
            let at = results.len();
            let unit = |m: Mover<f64>| Mover { factor: m.factor * units[m.joint], ..m };
            movers.extend(link.movers().map(|m| Moving { row, at, mover: unit(m) }));
            results.extend(axis.direction.0.into_iter().chain(axis.point.0));
        }
        let mut moved = vec![];
        for frame in frames {
            let reference = frame.reference(robot.links.len());
            let x = walk.place(reference);
            moved.push(Moved { rows: robot.rows_before(reference), at: results.len() });
            results.extend(x.rotation.rows().into_iter().flatten().chain(x.translation.0));
        }
        let program = program(description, &results);
        let scalar = program.compile_with(|s| description.value(s))?.scalar();
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
            for Moving { at: axis, mover, .. } in self.movers.iter().take_while(|m| m.row < frame.rows) {
                let twist = line(results, *axis).twist(mover, Vector(at.p));
                add_motion(&mut c[mover.joint], twist, &linear);
            }
        }
        point.cost = cost;
    }
}

#[inline(always)]
fn add_motion(column: &mut [f64; 6], [Vector(shift), Vector(turn)]: Twist<f64>, linear: &Linear) {
    let turn = linear.turn.as_ref().map_or(turn, |m| apply(m, turn));
    let shift = linear.shift.as_ref().map_or(shift, |m| apply(m, shift));
    let [a, b] = linear.weights;
    for i in 0..3 {
        column[i] += a * turn[i];
        column[3 + i] += b * shift[i];
    }
}

#[inline(always)]
fn line(results: &[f64], at: usize) -> Line<f64> {
    let [x, y, z, ox, oy, oz] = *results[at..].first_chunk().unwrap_or(&[0.0; 6]);
    Line { direction: Vector([x, y, z]), point: Vector([ox, oy, oz]) }
}

fn place(results: &[f64], at: usize) -> Place {
    let x: &[f64; 12] = results[at..].first_chunk().unwrap_or(&[0.0; 12]);
    Place { r: [[x[0], x[1], x[2]], [x[3], x[4], x[5]], [x[6], x[7], x[8]]], p: [x[9], x[10], x[11]] }
}

fn program(description: &Description, results: &[Expr]) -> Program {
    let variables: Vec<Symbol> = description.variables().iter().map(|v| v.symbol).collect();
    let parameters: Vec<Symbol> = description.parameters.iter().map(|p| p.symbol).collect();
    let mut graph = Graph::new(&variables, &parameters);
    let results: Vec<(String, Value)> =
        results.iter().enumerate().map(|(k, &e)| (format!("x{k}"), graph.trace(e))).collect();
    Program::new(&graph, &results, |_| None, &FxHashSet::default())
}
