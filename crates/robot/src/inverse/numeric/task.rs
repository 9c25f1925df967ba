//! What is asked of a configuration: tasks of frames, their residuals and how these change.
//!
//! Rotations are compared as rotation vectors, radians; positions in lengths of the arm, so that both are numbers of
//! one kind. All vectors are given in the base.

use crate::geometry::{Axis, Transform};
use crate::inverse::derivation::Goal;
use crate::mechanism::Reference;
use denavit_program::kernel;

/// A frame that is to be somewhere.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Frame {
    /// The tool.
    Tool,
    /// The frame behind row i of the table, from 1; frame 0 stands before row 1.
    Link(usize),
}

impl Frame {
    /// As a frame of a table with so many rows.
    pub(super) fn reference(self, rows: usize) -> Reference {
        match self {
            Frame::Tool => Reference::Tool,
            Frame::Link(i) => Reference::Frame(i.min(rows)),
        }
    }
}

/// What of a pose counts.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum TaskKind {
    /// Position and orientation.
    Pose,
    /// The position.
    Position,
    /// The position and the direction of an axis of the frame.
    PositionAndAxis(Axis),
    /// Chosen components of the small motion that leads to the target.
    Components {
        /// Rotations about x, y, z. With one of them free, the other two align that axis with the target's.
        turns: [bool; 3],
        /// Displacements along x, y, z.
        shifts: [bool; 3],
        /// Whose axes are meant: those of the target (for displacements) and of the frame (for rotations), or those of
        /// the base.
        axes: Axes,
    },
}

/// Whose axes are meant.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Axes {
    /// Those of the frame that is moved.
    Own,
    /// Those of the base.
    Base,
}

/// Whether a task must be met.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Level {
    /// It must.
    Hard,
    /// As well as possible where the hard tasks leave freedom.
    Soft,
}

/// A task: a frame, and what of its pose counts how much.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Task {
    /// The frame that is to be somewhere.
    pub frame: Frame,
    /// What of the pose counts.
    pub kind: TaskKind,
    /// How much the square of its error counts beside those of other tasks, positive: 1 is usual.
    pub weight: f64,
    /// Whether it must be met.
    pub level: Level,
}

impl Task {
    /// A hard task of weight 1.
    pub fn hard(frame: Frame, kind: TaskKind) -> Self {
        Task { frame, kind, weight: 1.0, level: Level::Hard }
    }

    /// A soft task.
    pub fn soft(frame: Frame, kind: TaskKind, weight: f64) -> Self {
        Task { frame, kind, weight, level: Level::Soft }
    }
}

impl From<Goal> for TaskKind {
    fn from(goal: Goal) -> Self {
        match goal {
            Goal::Pose => TaskKind::Pose,
            Goal::Position => TaskKind::Position,
            Goal::PositionAndAxis => TaskKind::PositionAndAxis(Axis::Z),
        }
    }
}

/// How a configuration is to be where tasks leave freedom.
#[derive(Clone, PartialEq, Debug)]
pub enum Preference {
    /// Near this configuration: `weight·Σ (q − q₀)²/2`, slides in lengths of the arm.
    Posture {
        /// q₀, radians and metres.
        near: Vec<f64>,
        /// How much it counts beside soft tasks and other preferences.
        weight: f64,
    },
    /// In the middle of the limits: `weight·Σ ((q − middle)/half the range)²/2` over the joints that have limits.
    MiddleOfLimits {
        /// How much it counts beside soft tasks and other preferences.
        weight: f64,
    },
}

/// What a task misses its target by, of what it asks for.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Residual {
    /// The rotation that is missing, radians.
    pub angle: f64,
    /// The displacement that is missing, metres.
    pub distance: f64,
}

pub(super) type Matrix = [[f64; 3]; 3];

/// A pose as plain numbers: rotation by rows, position.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub(super) struct Place {
    pub r: Matrix,
    pub p: [f64; 3],
}

impl From<&Transform<f64>> for Place {
    fn from(x: &Transform<f64>) -> Self {
        Place { r: x.rotation.rows(), p: x.translation.0 }
    }
}

/// A rotation's part of a task.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Turn {
    Free,
    Full,
    /// An axis of the frame to the target's, or of the base as both see it.
    Align(usize, Axes),
    /// Components of the rotation vector.
    Parts([bool; 3], Axes),
}

/// A task made ready: which residuals it has.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Shape {
    turn: Turn,
    shifts: [bool; 3],
    axes: Axes,
    /// The square root of the weight, and that by the arm's size.
    weights: [f64; 2],
}

/// Residuals at a place, and the directions in which motions are seen: a residual falls by `turn[i]·ω` and
/// `shift[i]·v`. No directions stand for those of the base.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Linear {
    pub r: [f64; 6],
    pub turn: Option<Matrix>,
    pub shift: Option<Matrix>,
    /// What turns and displacements are multiplied by.
    pub weights: [f64; 2],
}

impl Shape {
    /// That of a task of an arm of some size (metres).
    pub fn new(task: &Task, size: f64) -> Self {
        let w = task.weight.max(0.0).sqrt();
        let (turn, shifts, axes) = match task.kind {
            TaskKind::Pose => (Turn::Full, [true; 3], Axes::Base),
            TaskKind::Position => (Turn::Free, [true; 3], Axes::Base),
            TaskKind::PositionAndAxis(axis) => (Turn::Align(axis.index(), Axes::Own), [true; 3], Axes::Base),
            TaskKind::Components { turns, shifts, axes } => {
                let turn = match turns {
                    [false, false, false] => Turn::Free,
                    [true, true, true] => Turn::Full,
                    [false, true, true] => Turn::Align(0, axes),
                    [true, false, true] => Turn::Align(1, axes),
                    [true, true, false] => Turn::Align(2, axes),
                    parts => Turn::Parts(parts, axes),
                };
                (turn, shifts, if shifts == [true; 3] { Axes::Base } else { axes })
            }
        };
        Shape { turn, shifts, axes, weights: [w, w / size] }
    }

    /// True if all of the position counts; and of the orientation.
    pub fn fixes(&self) -> [bool; 2] {
        [self.shifts == [true; 3], self.turn == Turn::Full]
    }

    /// A measure of how far two places are apart, cheap: no less than nothing, and 0 where the task is met.
    pub fn apart(&self, at: &Place, target: &Place) -> f64 {
        let turned = match self.turn {
            Turn::Free => 0.0,
            Turn::Full | Turn::Parts(..) => {
                0.5 * (0..3).map(|i| square(sub(at.r[i], target.r[i]))).sum::<f64>()
            }
            Turn::Align(k, Axes::Own) => square(sub(column(&at.r, k), column(&target.r, k))),
            Turn::Align(k, Axes::Base) => square(sub(at.r[k], target.r[k])),
        };
        let d = self.shift(at, target).0;
        self.weights[0].powi(2) * turned + self.weights[1].powi(2) * square(d)
    }

    /// The angle and the distance that are missing.
    pub fn residual(&self, at: &Place, target: &Place) -> Residual {
        let turn = self.turned(at, target).0;
        Residual { angle: square(turn).sqrt(), distance: square(self.shift(at, target).0).sqrt() }
    }

    /// The residuals and their directions.
    pub fn linear(&self, at: &Place, target: &Place) -> Linear {
        let (t, turn) = self.turned(at, target);
        let (d, shift) = self.shift(at, target);
        let [a, b] = self.weights;
        let r = [a * t[0], a * t[1], a * t[2], b * d[0], b * d[1], b * d[2]];
        Linear { r, turn, shift, weights: self.weights }
    }

    fn shift(&self, at: &Place, target: &Place) -> ([f64; 3], Option<Matrix>) {
        let d = sub(target.p, at.p);
        if self.shifts == [true; 3] {
            return (d, None);
        }
        let mut rows = [[0.0; 3]; 3];
        for (k, row) in rows.iter_mut().enumerate().filter(|(k, _)| self.shifts[*k]) {
            match self.axes {
                Axes::Own => *row = column(&target.r, k),
                Axes::Base => row[k] = 1.0,
            }
        }
        (apply(&rows, d), Some(rows))
    }

    fn turned(&self, at: &Place, target: &Place) -> ([f64; 3], Option<Matrix>) {
        match self.turn {
            Turn::Free => ([0.0; 3], Some([[0.0; 3]; 3])),
            Turn::Full => (rotation_vector(&at.r, &target.r), None),
            // Two residuals, along the frame's other axes: that axis is turned by both at right angles.
            Turn::Align(k, Axes::Own) => {
                let (i, j) = ((k + 1) % 3, (k + 2) % 3);
                let (x, y) = (column(&at.r, i), column(&at.r, j));
                let turn = between(column(&at.r, k), column(&target.r, k), x);
                ([dot(x, turn), dot(y, turn), 0.0], Some([x, y, [0.0; 3]]))
            }
            // The base's axis as the frame sees it turns by −Rᵀω.
            Turn::Align(k, Axes::Base) => {
                let (i, j) = ((k + 1) % 3, (k + 2) % 3);
                let mut rows = [[0.0; 3]; 3];
                (rows[0][i], rows[1][j]) = (1.0, 1.0);
                let turn = between(target.r[k], at.r[k], at.r[i]);
                let seen = apply(&at.r, turn);
                ([seen[i], seen[j], 0.0], Some(rows))
            }
            // ψ with exp[ψ] = RᵀR*, or φ with exp[φ] = R*Rᵀ: dψ = −Jₗ⁻¹(ψ) Rᵀω, dφ = −Jᵣ⁻¹(φ) ω.
            Turn::Parts(parts, axes) => {
                let phi = rotation_vector(&at.r, &target.r);
                let (v, rows) = match axes {
                    Axes::Base => (phi, inverse_jacobian(phi, 0.5)),
                    Axes::Own => {
                        let psi = apply(&transposed(&at.r), phi);
                        (psi, product(&inverse_jacobian(psi, -0.5), &transposed(&at.r)))
                    }
                };
                let kept = std::array::from_fn(|i| if parts[i] { v[i] } else { 0.0 });
                (kept, Some(std::array::from_fn(|i| if parts[i] { rows[i] } else { [0.0; 3] })))
            }
        }
    }
}

/// The rotation vector of `b·aᵀ`, in the base: from a to b.
fn rotation_vector(a: &Matrix, b: &Matrix) -> [f64; 3] {
    // E = b aᵀ; sin·axis from E − Eᵀ, cos from the trace.
    let e: Matrix = std::array::from_fn(|i| std::array::from_fn(|j| dot(b[i], a[j])));
    let sine = [e[2][1] - e[1][2], e[0][2] - e[2][0], e[1][0] - e[0][1]].map(|x| 0.5 * x);
    let cos = 0.5 * (e[0][0] + e[1][1] + e[2][2] - 1.0);
    let ss = square(sine);
    if ss < 1e-8 && cos > 0.0 {
        // asin(s)/s = 1 + s²/6 + 3s⁴/40
        let k = 1.0 + ss * (1.0 / 6.0 + ss * 0.075);
        return sine.map(|x| k * x);
    }
    let s = ss.sqrt();
    let angle = kernel::atan2::<false>(s, cos);
    if cos > -0.99 {
        return sine.map(|x| x * angle / s);
    }
    // Near half a turn the axis stands in E + Eᵀ: E_kk = cos + (1 − cos) n_k².
    let largest = |k: usize, j: usize| if e[j][j] > e[k][k] { j } else { k };
    let k = largest(largest(0, 1), 2);
    let mut n: [f64; 3] = std::array::from_fn(|i| 0.5 * (e[i][k] + e[k][i]) - if i == k { cos } else { 0.0 });
    let length = square(n).sqrt().max(f64::MIN_POSITIVE);
    let sign = if dot(n, sine) < 0.0 { -1.0 } else { 1.0 };
    n = n.map(|x| sign * angle * x / length);
    n
}

/// The shortest rotation from a to b, unit vectors; half a turn about `else_about` if they are opposite.
fn between(a: [f64; 3], b: [f64; 3], else_about: [f64; 3]) -> [f64; 3] {
    let c = cross(a, b);
    let (s, cos) = (square(c).sqrt(), dot(a, b));
    if s < 1e-9 {
        return if cos > 0.0 { c } else { else_about.map(|x| x * std::f64::consts::PI) };
    }
    let k = kernel::atan2::<false>(s, cos) / s;
    c.map(|x| k * x)
}

/// `1 + half·[v] + c(|v|)·[v]²`: with ½ the inverse of the right Jacobian of the exponential, with −½ of the left one.
fn inverse_jacobian(v: [f64; 3], half: f64) -> Matrix {
    let tt = square(v);
    let t = tt.sqrt();
    let c = if tt < 1e-4 {
        1.0 / 12.0 + tt / 720.0
    } else {
        let (sin, cos) = kernel::sin_cos::<false>(t);
        // (1 + cos)/sin is 0 at half a turn.
        1.0 / tt - if sin.abs() < 1e-12 { 0.0 } else { (1.0 + cos) / (2.0 * t * sin) }
    };
    let [x, y, z] = v;
    let skew = [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]];
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let one = if i == j { 1.0 - c * tt } else { 0.0 };
            one + half * skew[i][j] + c * v[i] * v[j]
        })
    })
}

pub(super) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn square(a: [f64; 3]) -> f64 {
    dot(a, a)
}

pub(super) fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(super) fn cross([ax, ay, az]: [f64; 3], [bx, by, bz]: [f64; 3]) -> [f64; 3] {
    [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx]
}

fn column(m: &Matrix, k: usize) -> [f64; 3] {
    [m[0][k], m[1][k], m[2][k]]
}

pub(super) fn apply(m: &Matrix, v: [f64; 3]) -> [f64; 3] {
    [dot(m[0], v), dot(m[1], v), dot(m[2], v)]
}

fn transposed(m: &Matrix) -> Matrix {
    [column(m, 0), column(m, 1), column(m, 2)]
}

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    let columns = transposed(b);
    std::array::from_fn(|i| std::array::from_fn(|j| dot(a[i], columns[j])))
}
