//! The geometric Jacobian of any body of the chain, at any point, along the axes of any frame.

use crate::forward::Reference;
use crate::geometry::{Transform, Vector};
use crate::robot::{Link, Robot};
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

/// Every frame of a robot seen from one of them.
pub(super) struct Seen<T> {
    /// What stands right before the screw of each row.
    pub screws: Vec<Transform<T>>,
    /// Frames 0 … n.
    pub frames: Vec<Transform<T>>,
    base: Transform<T>,
    tool: Transform<T>,
}

impl<T: Scalar> Seen<T> {
    /// The chain is walked from the frame to both ends, so that formulas hold the joints between only.
    pub fn from(robot: &Robot<T>, q: &[T], axes: Reference) -> Self {
        let n = robot.links.len();
        let (k, start) = match axes {
            Reference::Base => (0, robot.base),
            Reference::Frame(i) => (i, Transform::identity()),
            Reference::Tool => (n, robot.tool.inverse()),
        };
        let mut screws = vec![start; n];
        let mut frames = vec![start; n + 1];
        for i in k..n {
            screws[i] = frames[i] * robot.links[i].before;
            frames[i + 1] = frames[i] * robot.links[i].transform(q);
        }
        for i in (0..k).rev() {
            frames[i] = frames[i + 1] * robot.links[i].transform(q).inverse();
            screws[i] = frames[i] * robot.links[i].before;
        }
        let base =
            if axes == Reference::Base { Transform::identity() } else { frames[0] * robot.base.inverse() };
        let tool = if axes == Reference::Tool { Transform::identity() } else { frames[n] * robot.tool };
        Seen { screws, frames, base, tool }
    }

    /// A frame.
    pub fn place(&self, frame: Reference) -> Transform<T> {
        match frame {
            Reference::Base => self.base,
            Reference::Frame(i) => self.frames[i],
            Reference::Tool => self.tool,
        }
    }
}

/// How many rows of the table move a body.
pub(super) fn rows_before<T>(robot: &Robot<T>, body: Reference) -> usize {
    match body {
        Reference::Base => 0,
        Reference::Frame(i) => i,
        Reference::Tool => robot.links.len(),
    }
}

/// The Jacobian at a configuration (Whitney 1972): (z × (p − o), z) for a joint that turns about the axis z through o,
/// (z, 0) for one that slides along it; a joint that stands in several rows has the sum.
///
/// # Panics
/// If `q` has not one entry a joint, or the robot has no such frame.
pub fn geometric<T: Scalar>(robot: &Robot<T>, q: &[T], view: &Viewpoint<T>) -> Jacobian<T> {
    assert_eq!(q.len(), robot.joints, "one entry per joint");
    let seen = Seen::from(robot, q, view.axes);
    let point = seen.place(view.at).act_on_point(view.offset);
    let mut columns = vec![[T::zero(); 6]; robot.joints];
    for (link, screw) in robot.links.iter().zip(&seen.screws).take(rows_before(robot, view.body)) {
        add_screw(&mut columns, link, screw, point);
    }
    Jacobian { columns }
}

/// The Jacobian of the tool at a point given in the base, along the axes of the base: what [`geometric`] gives there, in one
/// walk along the chain.
pub(crate) fn of_tool(robot: &Robot<f64>, q: &[f64], point: Vector<f64>) -> Vec<[f64; 6]> {
    let mut columns = vec![[0.0; 6]; q.len()];
    let mut before = robot.base;
    for link in &robot.links {
        add_screw(&mut columns, link, &(before * link.before), point);
        before = before * link.transform(q);
    }
    columns
}

/// Adds what the joints of a row do to a point.
fn add_screw<T: Scalar>(columns: &mut [[T; 6]], link: &Link<T>, screw: &Transform<T>, point: Vector<T>) {
    let z = screw.rotation.z();
    let lever = z.cross(point - screw.translation);
    for &(j, k) in &link.theta.terms {
        add(&mut columns[j], lever, z, k);
    }
    for &(j, k) in &link.d.terms {
        add(&mut columns[j], z, Vector::zero(), k);
    }
}

fn add<T: Scalar>(column: &mut [T; 6], linear: Vector<T>, angular: Vector<T>, factor: T) {
    for i in 0..3 {
        column[i] = column[i] + linear[i] * factor;
        column[3 + i] = column[3 + i] + angular[i] * factor;
    }
}
