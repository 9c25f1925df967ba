//! Types: statuses, names of functions, and structures that are read and written.

use std::ffi::c_char;
use std::marker::PhantomData;

/// How a call ended. Negative: nothing was computed.
#[repr(i32)]
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Status {
    /// Done. Of an answer: these are all solutions, each isolated.
    Ok = 0,
    /// These are all solutions, and some hang together: the arm can move there with its hand still (a singular pose, a redundant arm).
    Family = 1,
    /// There are solutions; whether these are all is not decided.
    Undecided = 2,
    /// It is certain that there is no solution: the pose is out of reach.
    Unreachable = 3,
    /// No solution was found; whether there is one is not decided.
    NotFound = 4,
    /// There are solutions, and the limits of the joints exclude all of them.
    OutsideLimits = 5,
    /// A solution within the limits, which is not near to where the joints were.
    Jumped = 6,
    /// A pointer is null that must not be, or is not aligned.
    BadPointer = -1,
    /// An array has another length than it must have.
    WrongLength = -2,
    /// A text is no UTF-8.
    NotText = -3,
    /// There is no such joint, frame, link, parameter, function, convention, …, or it does not fit the robot.
    BadArgument = -4,
    /// A number is infinite or none.
    NotFinite = -5,
    /// A matrix is no pose: its rotation is not orthonormal within 1e-5, is a reflection, or its last row is not 0 0 0 1.
    NotARotation = -6,
    /// The catalogue has no such robot.
    UnknownRobot = -7,
    /// A file cannot be read, or its ending is not known.
    BadFile = -8,
    /// A description has errors: `denavit_error_finding` has each with its place.
    BadDescription = -9,
    /// There is no such chain in the description.
    NoChain = -10,
    /// A parameter of the robot has no value.
    MissingValue = -11,
    /// The description says nothing of masses.
    NoMasses = -12,
    /// There is no such program or solver for this robot.
    Unsupported = -13,
    /// A fault of the library: it panicked, which was caught.
    Panic = -14,
}

/// A number of an enumeration, as C gives it: any other may come, too.
#[repr(transparent)]
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Code<E>(pub i32, PhantomData<E>);

/// The convention of a Denavit-Hartenberg table: which elementary transforms make a row, in this order.
#[repr(i32)]
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Convention {
    /// None is named.
    None = 0,
    /// Rz(theta) Tz(d) Tx(a) Rx(alpha): the cells of a row are theta, d, a, alpha.
    Standard = 1,
    /// Rx(alpha) Tx(a) Rz(theta) Tz(d): alpha, a, theta, d.
    Craig = 2,
    /// Rx(alpha) Tx(d) Rz(theta) Tz(r): alpha, d, theta, r.
    Khalil = 3,
}

/// How a joint moves.
#[repr(i32)]
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum JointKind {
    /// It turns: radians.
    Revolute = 0,
    /// It slides: metres.
    Prismatic = 1,
    /// A row of a table that does not move, and is no joint.
    Fixed = 2,
}

/// What of the hand is given.
#[repr(i32)]
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Goal {
    /// All of the pose.
    Pose = 0,
    /// The position of the tool: the rotation of a pose does not count.
    Position = 1,
}

/// Functions of joint variables q, rates qd, and accelerations qdd or torques. n is the number of joints.
#[repr(i32)]
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Function {
    /// q: the tool in the base, 16 numbers, as `denavit_pose` has them.
    Fk = 0,
    /// q: frames 0, 1, … of the table and the tool in the base, 16 numbers each.
    Frames = 1,
    /// q: the geometric Jacobian of the tool along the axes of the base, 6 x n.
    Jacobian = 2,
    /// q, qd, qdd: the torques of the drives (N m; N of a slide), n.
    Torque = 3,
    /// q: the inertia matrix, n x n.
    Inertia = 4,
    /// q, qd: the torques without accelerations, with gravity and friction, n.
    Bias = 5,
    /// q: the torques that hold the arm at rest, n.
    Gravity = 6,
    /// q, qd, torques: the accelerations of the joints, n.
    Acceleration = 7,
    /// q, qd: the kinetic and the potential energy (J), 2.
    Energy = 8,
    /// q, qd, qdd: the derivatives of the torques by q, by qd and by qdd side by side, n x 3n.
    TorqueDerivatives = 9,
    /// q, qd, torques: the derivatives of the accelerations by q, by qd and by the torques side by side, n x 3n.
    AccelerationDerivatives = 10,
    /// q, qd, qdd: a column with the torques, and the derivatives behind it, n x (3n + 1).
    TorqueWithDerivatives = 11,
    /// q, qd, torques: a column with the accelerations, and the derivatives behind it, n x (3n + 1).
    AccelerationWithDerivatives = 12,
}

/// Why an answer may lack solutions.
#[repr(i32)]
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Doubt {
    /// It lacks none: all solutions are there.
    None = 0,
    /// Some were found by trying values or from nearby, where others may hide.
    Sampled = 1,
    /// Two roots nearly coincide: whether they are two, one or none is below rounding.
    DoubleRoot = 2,
    /// The roots could not be counted.
    Uncounted = 3,
    /// They were searched for by descent from several starts.
    Searched = 4,
    /// One was asked for.
    OneAsked = 5,
    /// Gears repeat each configuration more often within a turn than is listed.
    Copies = 6,
    /// The robot stands so far from the origin that a pose has too few digits.
    Digits = 7,
}

/// The tool, where a frame is asked for.
pub const DENAVIT_TOOL: i32 = -1;
/// The base, where a frame is asked for: what frame 0 stands in.
pub const DENAVIT_BASE: i32 = -2;

/// How bad a finding is.
#[repr(i32)]
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum FindingSeverity {
    /// The description means nothing.
    Error = 0,
    /// It may not mean what it was to.
    Warning = 1,
    /// What was understood.
    Note = 2,
}

/// A pose: the matrix that takes coordinates in a frame (the tool, say) to those in the base, row by row; the last row is 0 0 0 1. Its
/// last column is the position, metres.
#[repr(C)]
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Pose {
    /// Rows.
    pub matrix: [[f64; 4]; 4],
}

/// How a description is read. All zero is usual.
#[repr(C)]
#[derive(Debug)]
pub struct Options {
    /// The link or frame at which the chain begins; null: the root.
    pub base: *const c_char,
    /// The link or frame at which it ends; null: the leaf with the most joints.
    pub tip: *const c_char,
    /// The convention of a table that does not say it, or of the table that is made of bodies.
    pub convention: Code<Convention>,
    /// Not 0: decimals of angles are taken as they are written (1.5708 is no quarter turn).
    pub as_written: i32,
    /// What columns of a table are in where it does not say it: 0 not told, 1 radians, 2 degrees.
    pub angles: i32,
    /// The same of lengths: 0 not told, 1 metres, 2 millimetres.
    pub lengths: i32,
    /// Which table or robot of a document, from 1; 0: there is one.
    pub table: usize,
    /// What the columns of a table mean, as `theta,d,a,alpha`; null: it says it.
    pub columns: *const c_char,
    /// Values of a xacro file's arguments: names and values in turn.
    pub arguments: *const *const c_char,
    /// How many texts these are.
    pub arguments_length: usize,
    /// Folders of packages: names and paths in turn.
    pub packages: *const *const c_char,
    /// How many texts these are.
    pub packages_length: usize,
}

/// A joint. Its texts belong to the robot.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Joint {
    /// The joint variable in the table: `q1`.
    pub variable: *const c_char,
    /// What the description calls the joint; null where it does not.
    pub name: *const c_char,
    /// Revolute or prismatic.
    pub kind: Code<JointKind>,
    /// Whether limits are known.
    pub limited: i32,
    /// The lowest value, radians or metres; minus infinity where it is not known.
    pub lower: f64,
    /// The highest value; infinity where it is not known.
    pub upper: f64,
    /// The largest speed, rad/s or m/s; infinity where it is not known.
    pub velocity: f64,
}

/// A finding in a description. Its texts belong to the robot or to the error that it was asked of.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Finding {
    /// How bad it is.
    pub severity: Code<FindingSeverity>,
    /// From 1; 0 where there is no place.
    pub line: usize,
    /// From 1, in characters.
    pub column: usize,
    /// The file, or what the text is called.
    pub file: *const c_char,
    /// What was found.
    pub message: *const c_char,
    /// What would help; null where nothing is known.
    pub hint: *const c_char,
    /// All of it, with the line of the text and a mark below the place.
    pub rendered: *const c_char,
}

/// A solution of the inverse kinematics. Its texts belong to the answer.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Solution {
    /// The distance from the pose, without dimension: the rotation (Frobenius norm of two columns), and the position by the arm's size.
    pub residual: f64,
    /// The smallest quantity that formulas divide by, without dimension: joints are determined to about 1e-16 by it; 0 where it is not
    /// known.
    pub guard: f64,
    /// How many configurations within the limits it stands for, joints moved by whole turns; 0 if they exclude all.
    pub copies: u64,
    /// How many branches coincide here.
    pub multiplicity: u32,
    /// Whether the limits allow it, or a copy of it whole turns away.
    pub within_limits: i32,
    /// The branch: `shoulder+ elbow− wrist+`; empty where branches have no names.
    pub branch: *const c_char,
}

/// A family: configurations with the pose that hang together. Its texts belong to the answer.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Family {
    /// One of them.
    pub representative: Solution,
    /// How many parameters it has.
    pub dimension: usize,
    /// How many members along it are known, neighbours next to each other; 0 where it was not followed.
    pub members: usize,
    /// How many stretches of what is free are known to be within the limits.
    pub stretches: usize,
    /// Whether the joints move in the same proportions everywhere: q + t direction is in the family for each t.
    pub affine: i32,
    /// Whether the interval is known.
    pub bounded: i32,
    /// For one free unknown the values for which there is a solution, radians or metres.
    pub interval: [f64; 2],
    /// The unknowns that are free, separated by commas: `q4`, or `q2 + q3 + q4`.
    pub free_unknowns: *const c_char,
}

/// Why a pose has no solution, and how near the arm comes. Its text belongs to the answer.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Obstacle {
    /// The rotation that is missing at the nearest configuration that was found, radians.
    pub angle: f64,
    /// The displacement that is missing there, metres.
    pub distance: f64,
    /// Why, in words.
    pub message: *const c_char,
}

/// A configuration that follows another.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Tracked {
    /// Its distance from the pose, as that of a solution.
    pub residual: f64,
    /// The largest change of a joint, radians, and lengths by the arm's reach.
    pub distance: f64,
    /// The smallest singular value of the Jacobian, lengths by the reach, or up to a third less: 0 at a singular configuration, and where
    /// fewer than six joints move or the goal is less than a pose.
    pub guard: f64,
    /// How many joints are at a limit.
    pub at_limit: usize,
}

/// A configuration near to another.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Nearest {
    /// The largest difference of a joint, radians, and lengths by the arm's reach.
    pub distance: f64,
    /// Whether the limits allow it.
    pub within_limits: i32,
}

/// Enumerations whose numbers C gives and gets.
pub trait Numbered: Copy + 'static {
    /// All that there are.
    const ALL: &'static [Self];

    /// The number of one.
    fn number(self) -> i32;
}

impl<E: Numbered> Code<E> {
    /// What the number means, if anything.
    pub fn meant(self) -> Option<E> {
        E::ALL.iter().copied().find(|one| one.number() == self.0)
    }
}

impl<E: Numbered> From<E> for Code<E> {
    fn from(one: E) -> Self {
        Code(one.number(), PhantomData)
    }
}

macro_rules! numbered {
    ($($name:ident: $($variant:ident)*;)*) => { $(
        impl Numbered for $name {
            const ALL: &'static [Self] = &[$($name::$variant),*];

            fn number(self) -> i32 {
                self as i32
            }
        }
    )* };
}

numbered! {
    Status: Ok Family Undecided Unreachable NotFound OutsideLimits Jumped BadPointer WrongLength NotText BadArgument NotFinite
        NotARotation UnknownRobot BadFile BadDescription NoChain MissingValue NoMasses Unsupported Panic;
    Convention: None Standard Craig Khalil;
    JointKind: Revolute Prismatic Fixed;
    Goal: Pose Position;
    Function: Fk Frames Jacobian Torque Inertia Bias Gravity Acceleration Energy TorqueDerivatives AccelerationDerivatives
        TorqueWithDerivatives AccelerationWithDerivatives;
    Doubt: None Sampled DoubleRoot Uncounted Searched OneAsked Copies Digits;
    FindingSeverity: Error Warning Note;
}
