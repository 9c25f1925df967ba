//! What somebody wrote down about a robot: its Denavit–Hartenberg table, exactly.
//!
//! A [`Description`] is text made precise: every cell an exact formula in parameters and joint variables. It is
//! read from a robot file or from a table as it stands in a document, and turned into a `Robot` to compute with.

mod bodies;
mod branches;
mod cell;
pub mod convert;
mod decimals;
pub mod diagnostic;
mod filled;
mod held;
mod inertia;
mod joints;
mod lines;
pub mod linkage;
mod masses;
mod mjcf;
mod named;
mod names;
mod order;
pub mod parallel;
mod parameters;
mod periods;
mod reader;
mod rigid;
mod robot_file;
mod rows;
mod same;
mod sources;
mod srdf;
pub mod table;
mod toolbox;
mod tree;
mod units;
mod urdf;
mod value;
mod xacro;
mod xml;

pub use bodies::{is_mjcf, read_bodies};
pub use branches::{NamedFrame, NoPar, ParFile, RowChain, RowTree, read_par, write_par};
pub use cell::MAX_LENGTH as MAX_CELL_BYTES;
pub use convert::{Conversion, Moved, SameChain, prove_same_chain};
pub use decimals::Decimals;
pub use diagnostic::{Diagnostic, Diagnostics, Severity, line_column, render};
pub use held::{Format, Part};
pub use lines::{
    Agreement, AxisAtRest, ChainAtRest, Named, NotNamed, NotPlaced, Placed, compare_screws, same_screws,
};
pub use linkage::{ClosedChain, Closure, Linkage, NotCoupled, write_linkage_par};
pub use mjcf::{read_mjcf, refused_masses, write_mjcf};
pub use order::{Cell, Screw, Screws};
pub use parameters::MissingValue;
pub use robot_file::{
    AxesAs, Described, MAX_BYTES, MAX_ROWS, PARALLEL_VERBS, ParallelRead, read_parallel, read_robot,
    read_toml, write_axes, write_linkage, write_toml, write_tree,
};
pub use same::{SameMechanism, Sameness, same_mechanism};
pub use sources::{Alone, Files, Sources};
pub use srdf::{Group, NoEnds, read_srdf};
pub use table::{TableKind, TableOptions, read_table, read_table_robot, write_table, write_tree_table};
pub use toolbox::{Language, read_program};
pub use tree::{
    Alikeness, Body, Chain, Follows, Hold, Joint, JointDrive, Keeps, Likeness, Look, Mass, Mechanism,
    NoChain, Placing, Shape, Unweighed,
};
pub use urdf::{Reading, read_urdf, read_xacro, write_urdf};
pub use value::{Measure, NotSet, read_value};
pub use xml::{MAX_XML_BYTES, root_element};

use denavit_symbolic::{Expr, Symbol};
use std::fmt;
use std::ops::Range;
use units::Quantity;

use crate::geometry::Transform;

/// A robot as described.
#[derive(Clone, Debug)]
pub struct Description {
    /// What people call it.
    pub name: String,
    /// Where the numbers come from.
    pub source: Option<String>,
    /// The convention of the table.
    pub convention: Convention,
    /// Symbols that stand for constants, in the order of the file.
    pub parameters: Vec<Parameter>,
    /// The rows of the table.
    pub rows: Vec<Row>,
    /// Frame 0 in the base; constant.
    pub base: Transform<Expr>,
    /// The tool in the last frame; constant.
    pub tool: Transform<Expr>,
    /// Named configurations, one constant for each joint variable.
    pub poses: Vec<(String, Vec<Expr>)>,
    /// The acceleration of gravity in the base, m/s².
    pub gravity: Option<[Expr; 3]>,
}

/// A constant of the robot that formulas carry as a symbol.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// The symbol.
    pub symbol: Symbol,
    /// Its value (metres or radians), a constant expression, if one is known.
    pub value: Option<Expr>,
}

/// The order and the letters of a row's four elementary transforms.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Convention {
    /// Rz(θ)·Tz(d)·Tx(a)·Rx(α), keys `theta d a alpha` (Denavit and Hartenberg 1955, as in Paul 1981).
    Standard,
    /// Rx(α)·Tx(a)·Rz(θ)·Tz(d), keys `alpha a theta d` (Craig, *Introduction to Robotics*).
    Craig,
    /// Rx(α)·Tx(d)·Rz(θ)·Tz(r), keys `alpha d theta r`, and Rz(γ)·Tz(b) before it where a row has `gamma`, `b`
    /// (Khalil and Kleinfinger 1986).
    Khalil,
}

impl Convention {
    /// All of them.
    pub const ALL: [Convention; 3] = [Convention::Standard, Convention::Craig, Convention::Khalil];

    /// The name used in robot files.
    pub fn name(self) -> &'static str {
        match self {
            Convention::Standard => "standard",
            Convention::Craig => "craig",
            Convention::Khalil => "khalil",
        }
    }

    /// The key of the length along x (`a`, in Khalil's letters `d`).
    pub fn length_x(self) -> &'static str {
        if self == Convention::Khalil { "d" } else { "a" }
    }

    /// The key of the length along z (`d`, in Khalil's letters `r`).
    pub fn length_z(self) -> &'static str {
        if self == Convention::Khalil { "r" } else { "d" }
    }
}

impl fmt::Display for Convention {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A row of the table, in letters that do not depend on the convention: θ and d about and along z, α and a
/// about and along x, γ and b about and along the z of the frame before (Khalil's letters for branches).
#[derive(Clone, Debug)]
pub struct Row {
    /// Rotation about z, radians; affine in the joint variables.
    pub theta: Expr,
    /// Translation along z, metres; affine in the joint variables.
    pub d: Expr,
    /// Translation along x, metres; constant.
    pub a: Expr,
    /// Rotation about x, radians; constant.
    pub alpha: Expr,
    /// Rotation about the z of the frame before, radians; constant, `khalil` only.
    pub gamma: Expr,
    /// Translation along the z of the frame before, metres; constant, `khalil` only.
    pub b: Expr,
    /// The joint variable that this row introduces; a row without one is a fixed transform (or follows other
    /// joints).
    pub variable: Option<Variable>,
    /// The joint's name.
    pub name: Option<String>,
    /// Lower and upper limit of the variable (radians or metres), constants.
    pub limits: Option<[Expr; 2]>,
    /// Limit of the joint's speed (rad/s or m/s).
    pub velocity: Option<Expr>,
    /// Limit of the joint's acceleration (rad/s² or m/s²).
    pub acceleration: Option<Expr>,
    /// Mass of the link behind the joint, kg.
    pub mass: Option<Expr>,
    /// Its centre of mass in the row's frame, metres.
    pub com: Option<[Expr; 3]>,
    /// Its inertia about the centre of mass in the row's frame, xx xy xz yy yz zz, kg·m².
    pub inertia: Option<[Expr; 6]>,
    /// Its first moment in the row's frame, in place of its centre of mass: MX MY MZ, kg·m.
    pub first_moment: Option<[Expr; 3]>,
    /// Its inertia about the origin of the row's frame, in place of that about its centre of mass: XX XY XZ YY YZ ZZ, kg·m².
    pub inertia_at_origin: Option<[Expr; 6]>,
    /// The inertia of the joint's rotor as the joint feels it: IA, kg·m² (kg for a slide).
    pub rotor: Option<Expr>,
    /// The joint's viscous friction: FV, N·m·s/rad (N·s/m for a slide).
    pub viscous: Option<Expr>,
    /// The joint's friction of Coulomb: FS, N·m (N for a slide).
    pub coulomb: Option<Expr>,
}

/// A joint variable.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Variable {
    /// `q1`, `q2`, … counting the rows that have one.
    pub symbol: Symbol,
    /// What it moves.
    pub kind: JointKind,
}

/// Whether a joint turns or slides.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum JointKind {
    /// Turns about z.
    Revolute,
    /// Slides along z.
    Prismatic,
}

impl Row {
    /// The row that moves nothing.
    pub fn still() -> Self {
        let zero = Expr::int(0);
        let [theta, d, a, alpha, gamma, b] = [zero; 6];
        Row {
            theta,
            d,
            a,
            alpha,
            gamma,
            b,
            variable: None,
            name: None,
            limits: None,
            velocity: None,
            acceleration: None,
            mass: None,
            com: None,
            inertia: None,
            first_moment: None,
            inertia_at_origin: None,
            rotor: None,
            viscous: None,
            coulomb: None,
        }
    }
}

impl Description {
    /// The joint variables, `q1` first.
    pub fn variables(&self) -> Vec<Variable> {
        self.rows.iter().filter_map(|r| r.variable).collect()
    }
}

/// Decimals that people type.
const TYPED: usize = 4;

/// How many decimals the shortest text of a number has.
fn decimals(x: f64) -> usize {
    format!("{x}").split_once('.').map_or(0, |(_, behind)| behind.len())
}

/// Reports a number without unit that is improbable in SI: 90 rad, 151.9 m.
fn suspicious_number(x: f64, span: &Range<usize>, quantity: Quantity, hint: &str, out: &mut Diagnostics) {
    let (what, unit) = match quantity {
        Quantity::Angle if x.abs() > std::f64::consts::TAU => (format!("{x} rad is more than a turn"), "deg"),
        Quantity::Length if x.abs() > 20.0 => (format!("{x} m is a long way for a robot"), "mm"),
        _ => return,
    };
    let hint = match hint {
        // A number that a program printed means what it says.
        "" if decimals(x) > TYPED => "a number without unit is SI".to_string(),
        "" => format!("a number without unit is SI; write `{x} {unit}` if that is meant"),
        other => other.into(),
    };
    out.warning(span.clone(), what).hint(hint);
}
