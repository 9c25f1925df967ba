//! The tool point and its velocities, one walk along the chain, in buffers that are used again.

use crate::geometry::{Transform, Vector};
use crate::robot::{Affine, Robot};

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
    /// The tool point, metres.
    pub point: Vector<f64>,
    /// The velocity of the tool point for a unit of each joint's velocity (m/rad; without unit for a slide).
    pub columns: Vec<Vector<f64>>,
    /// The direction of each row's z, and a point of it.
    pub axes: Vec<[Vector<f64>; 2]>,
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
        Walk {
            start: robot.base * before(0),
            rows: (0..n).map(row).collect(),
            point: Vector::zero(),
            columns: vec![Vector::zero(); robot.joints],
            axes: vec![[Vector::zero(); 2]; n],
        }
    }

    /// Finds the tool point and its velocities at a configuration.
    pub fn to(&mut self, q: &[f64]) {
        let [mut x, mut y, mut z] = [0, 1, 2].map(|c| column(&self.start, c));
        let mut o = self.start.translation;
        for (row, axis) in self.rows.iter().zip(&mut self.axes) {
            *axis = [z, o];
            let (s, c) = sin_cos(&row.theta, q);
            (x, y) = (x.scale(c) + y.scale(s), y.scale(c) - x.scale(s));
            o = o + z.scale(value(&row.d, q));
            let of = |v: Vector<f64>| x.scale(v[0]) + y.scale(v[1]) + z.scale(v[2]);
            let next = [0, 1, 2].map(|c| of(column(&row.then, c)));
            o = o + of(row.then.translation);
            [x, y, z] = next;
        }
        self.point = o;
        self.columns.fill(Vector::zero());
        for (row, &[z, at]) in self.rows.iter().zip(&self.axes) {
            for &(j, k) in &row.theta.terms {
                self.columns[j] = self.columns[j] + z.cross(o - at).scale(k);
            }
            for &(j, k) in &row.d.terms {
                self.columns[j] = self.columns[j] + z.scale(k);
            }
        }
    }

    /// The only row that a joint stands in, if there is but one.
    pub fn row_of(&self, joint: usize) -> Option<usize> {
        let stands = |r: &Row| {
            r.theta.terms.iter().chain(&r.d.terms).filter(|&&(j, k)| j == joint && k != 0.0).count()
        };
        let mut rows = (0..self.rows.len()).filter(|&i| stands(&self.rows[i]) > 0);
        let first = rows.next()?;
        (rows.next().is_none() && stands(&self.rows[first]) == 1).then_some(first)
    }
}

fn column(x: &Transform<f64>, c: usize) -> Vector<f64> {
    match c {
        0 => x.rotation.x(),
        1 => x.rotation.y(),
        _ => x.rotation.z(),
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
