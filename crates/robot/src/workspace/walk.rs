//! The tool point and its velocities on walks along the chain, in buffers that are used again.
//!
//! A cell of the workspace costs dozens of walks and no frame but the last, so that the constants between two rows' screws
//! are multiplied beforehand: half the time of [`along`](crate::mechanism::walk::along).

use crate::geometry::{Axis, Transform, Vector};
use crate::mechanism::{Affine, Line, Mover, Robot};

/// A row: its screw, and what is constant up to the screw of the next.
struct Row {
    theta: Affine<f64>,
    d: Affine<f64>,
    then: Transform<f64>,
}

/// A robot to walk along, and what the last walk found; all in the base.
pub(super) struct Walk {
    start: Transform<f64>,
    rows: Vec<Row>,
    /// What moves the rows, by their numbers.
    movers: Vec<(usize, Mover<f64>)>,
    /// The tool point, metres.
    pub point: Vector<f64>,
    /// The velocity of the tool point for a unit of each joint's velocity (m/rad; without unit for a slide).
    pub columns: Vec<Vector<f64>>,
    /// The axis of each row.
    pub axes: Vec<Line<f64>>,
}

impl Walk {
    /// That of a robot, before any walk.
    pub fn new(robot: &Robot<f64>) -> Self {
        let n = robot.links.len();
        let before = |i: usize| robot.links.get(i).map_or(robot.tool, |l| l.before);
        let row = |i: usize| Row {
            theta: robot.links[i].theta.clone(),
            d: robot.links[i].d.clone(),
            then: robot.links[i].after * before(i + 1),
        };
        let start = robot.base * before(0);
        let links = robot.links.iter().enumerate();
        Walk {
            start,
            rows: (0..n).map(row).collect(),
            movers: links.flat_map(|(i, l)| l.movers().map(move |m| (i, m))).collect(),
            point: Vector::zero(),
            columns: vec![Vector::zero(); robot.joints],
            axes: vec![Line::z_of(&start); n],
        }
    }

    /// Finds the tool point and its velocities at a configuration.
    pub fn to(&mut self, q: &[f64]) {
        let [mut x, mut y, mut z] = Axis::ALL.map(|a| self.start.rotation.column(a));
        let mut o = self.start.translation;
        for (row, axis) in self.rows.iter().zip(&mut self.axes) {
            *axis = Line { direction: z, point: o };
            let (s, c) = sin_cos(&row.theta, q);
            (x, y) = (x.scale(c) + y.scale(s), y.scale(c) - x.scale(s));
            o = o + z.scale(value(&row.d, q));
            let of = |v: Vector<f64>| x.scale(v[0]) + y.scale(v[1]) + z.scale(v[2]);
            let next = Axis::ALL.map(|a| of(row.then.rotation.column(a)));
            o = o + of(row.then.translation);
            [x, y, z] = next;
        }
        self.point = o;
        self.columns.fill(Vector::zero());
        for (row, mover) in &self.movers {
            let [linear, _] = self.axes[*row].twist(mover, o);
            self.columns[mover.joint] = self.columns[mover.joint] + linear;
        }
    }

    /// The only row that a joint stands in, if there is but one.
    pub fn row_of(&self, joint: usize) -> Option<usize> {
        let mut rows = self.movers.iter().filter(|(_, m)| m.joint == joint && m.factor != 0.0);
        let first = rows.next()?;
        rows.next().is_none().then_some(first.0)
    }
}

fn value(a: &Affine<f64>, q: &[f64]) -> f64 {
    a.terms.iter().fold(a.offset, |sum, &(j, k)| sum + k * q[j])
}

/// Sine and cosine with the quarter turns.
fn sin_cos(a: &Affine<f64>, q: &[f64]) -> (f64, f64) {
    let (s, c) = value(a, q).sin_cos();
    match a.quarters % 4 {
        0 => (s, c),
        1 => (c, -s),
        2 => (-s, -c),
        _ => (-c, s),
    }
}
