//! The geometric Jacobian of any body of the chain, at any point, along the axes of any frame.

use crate::geometry::Vector;
use crate::mechanism::walk::{along, twists};
use crate::mechanism::{Reference, Robot, Twist, Walk};
use crate::scalar::Scalar;

/// The rows of a geometric Jacobian, and the components of a twist.
pub const ROWS: [&str; 6] = ["vx", "vy", "vz", "wx", "wy", "wz"];

/// Whose velocity is meant, of which of its points, and along which axes it is written.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Viewpoint<T> {
    /// The components are along the axes of this frame.
    pub axes: Reference,
    /// The body that moves: a link by its frame, or the tool.
    pub body: Reference,
    /// The point of the body is given from the origin of this frame, where that happens to be.
    pub at: Reference,
    /// Where the point is in that frame, metres.
    pub offset: Vector<T>,
}

impl<T: Scalar> Viewpoint<T> {
    /// The tool's own origin, along the axes of the base.
    pub fn tool() -> Self {
        Viewpoint::of(Reference::Tool, Reference::Base)
    }

    /// The origin of a body's frame, along the axes of a frame.
    pub fn of(body: Reference, axes: Reference) -> Self {
        Viewpoint { axes, body, at: body, offset: Vector::zero() }
    }
}

/// One column a joint: the twist for a unit of the joint's velocity; rows as in [`ROWS`].
///
/// Entries of linear rows are metres a radian, or 1 for a joint that slides; of angular rows 1 or 0.
#[derive(Clone, PartialEq, Debug)]
pub struct Jacobian<T> {
    /// The columns, in the order of the joints.
    pub columns: Vec<[T; 6]>,
}

impl<T: Scalar> Jacobian<T> {
    /// Row by row, six rows.
    pub fn rows(&self) -> [Vec<T>; 6] {
        [0, 1, 2, 3, 4, 5].map(|r| self.columns.iter().map(|c| c[r]).collect())
    }

    /// The twist at joint velocities.
    pub fn twist(&self, rates: &[T]) -> [T; 6] {
        let mut twist = [T::zero(); 6];
        for (column, &rate) in self.columns.iter().zip(rates) {
            for (t, &c) in twist.iter_mut().zip(column) {
                *t = *t + c * rate;
            }
        }
        twist
    }
}

/// The Jacobian at a configuration: what each joint does to the body and its point ([`Line::twist`](crate::mechanism::Line)).
///
/// # Panics
/// If `q` has not one entry a joint, or the robot has no such frame.
pub fn geometric<T: Scalar>(robot: &Robot<T>, q: &[T], view: &Viewpoint<T>) -> Jacobian<T> {
    assert_eq!(q.len(), robot.joints, "one entry per joint");
    let walk = Walk::seen_from(robot, q, view.axes);
    let point = walk.place(view.at).act_on_point(view.offset);
    let mut columns = vec![[Vector::zero(); 2]; robot.joints];
    walk.twists(robot, view.body, point, &mut columns);
    Jacobian { columns: columns.into_iter().map(column).collect() }
}

/// The Jacobian of the tool at a point given in the base, along the axes of the base: what [`geometric`] gives there, in one
/// walk along the chain.
pub(crate) fn of_tool(robot: &Robot<f64>, q: &[f64], point: Vector<f64>) -> Vec<[f64; 6]> {
    let mut columns = vec![[Vector::zero(); 2]; q.len()];
    let axes = along(&robot.links, q, robot.base).map(|(axis, _)| axis);
    twists(&robot.links, axes, point, &mut columns);
    columns.into_iter().map(column).collect()
}

/// Linear velocity first.
fn column<T: Copy>([Vector([x, y, z]), Vector([a, b, c])]: Twist<T>) -> [T; 6] {
    [x, y, z, a, b, c]
}
