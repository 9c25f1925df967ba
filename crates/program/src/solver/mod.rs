//! All solutions of equations, branch by branch: straight-line programs with roots between them.
//!
//! A [`Solver`] is a list of nodes. Before each node a program computes the node's operands from what is known; the
//! node's [`Root`] has up to four values, each a branch; behind the last node a program computes the results and the
//! residual of the equations. What only earlier branches determine is computed once for all later ones.

mod build;
mod evaluate;
mod quartic;
mod roots;
mod text;

pub use build::{Level, Output, Register, SolverBuilder};
pub use evaluate::{Ended, Leaf, Leaves, Solutions, SolverBatch, SolverFunction, SolverScalar, Walk};
pub use roots::{Roots, roots};

use crate::graph::Value;
use denavit_symbolic::Symbol;

/// An equation in one unknown, with a closed form for its roots.
///
/// Unknown angles come as cosine and sine, never as angles. A node that branches also returns its sign k (±1; 1 to 4
/// for a quartic).
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Root<V> {
    /// `denominator·r = numerator`; returns `r`.
    Ratio {
        /// The right-hand side.
        numerator: V,
        /// The factor.
        denominator: V,
    },
    /// `(cos, sin) = ±(x, y)/√(x² + y²)` with the sign of `sign`, + without one; returns `cos, sin`.
    Direction {
        /// Along the cosine.
        x: V,
        /// Along the sine.
        y: V,
        /// A value whose sign is taken: the determinant that x and y have as a factor.
        sign: Option<V>,
    },
    /// `x·sin = y·cos`: `(cos, sin) = k(x, y)/√(x² + y²)`; returns `cos, sin, k`.
    Line {
        /// Along the cosine.
        x: V,
        /// Along the sine.
        y: V,
    },
    /// `r² = x² + y²`: `r = k√(x² + y²)`; returns `r, k`. One root, of multiplicity 2, where the guard vanishes.
    Length {
        /// One component.
        x: V,
        /// The other.
        y: V,
    },
    /// `a·cos + b·sin = c`: with R = √(a² + b² − c²), `cos = (a·c − k·b·R)/(a² + b²)`, `sin = (b·c + k·a·R)/(a² + b²)`;
    /// returns `cos, sin, k`.
    Sincos {
        /// The factor of the cosine.
        a: V,
        /// The factor of the sine.
        b: V,
        /// The right-hand side.
        c: V,
        /// a² + b² − c² in a form that does not cancel, where there is one.
        discriminant: Option<V>,
    },
    /// `a·r² + 2b·r + c = 0`: `r = (−b + k√(b² − a·c))/a`; returns `r, k`.
    Quadratic {
        /// The factor of r².
        a: V,
        /// Half the factor of r.
        b: V,
        /// The constant.
        c: V,
    },
    /// `cc·cos² + cs·cos·sin + c·cos + s·sin + one = 0`; returns `cos, sin, k`, the roots sorted by angle in (−π, π].
    Quartic {
        /// The factor of cos².
        cc: V,
        /// The factor of cos·sin.
        cs: V,
        /// The factor of cos.
        c: V,
        /// The factor of sin.
        s: V,
        /// The constant.
        one: V,
    },
}

impl<V: Copy> Root<V> {
    /// How many roots there are at most.
    pub fn branches(&self) -> usize {
        match self {
            Root::Ratio { .. } | Root::Direction { .. } => 1,
            Root::Line { .. } | Root::Length { .. } | Root::Sincos { .. } | Root::Quadratic { .. } => 2,
            Root::Quartic { .. } => 4,
        }
    }

    /// True if the unknown is an angle, so that the first results are its cosine and sine.
    pub fn is_angle(&self) -> bool {
        match self {
            Root::Direction { .. } | Root::Line { .. } | Root::Sincos { .. } | Root::Quartic { .. } => true,
            Root::Ratio { .. } | Root::Length { .. } | Root::Quadratic { .. } => false,
        }
    }

    /// How many results there are: the unknown (two for an angle), and the sign of a node that branches.
    pub fn results(&self) -> usize {
        1 + usize::from(self.is_angle()) + usize::from(self.branches() > 1)
    }

    /// The same root of other operands, in a fixed order.
    pub fn map<W>(&self, mut f: impl FnMut(V) -> W) -> Root<W> {
        match *self {
            Root::Ratio { numerator, denominator } => {
                Root::Ratio { numerator: f(numerator), denominator: f(denominator) }
            }
            Root::Direction { x, y, sign } => Root::Direction { x: f(x), y: f(y), sign: sign.map(f) },
            Root::Line { x, y } => Root::Line { x: f(x), y: f(y) },
            Root::Length { x, y } => Root::Length { x: f(x), y: f(y) },
            Root::Sincos { a, b, c, discriminant } => {
                Root::Sincos { a: f(a), b: f(b), c: f(c), discriminant: discriminant.map(f) }
            }
            Root::Quadratic { a, b, c } => Root::Quadratic { a: f(a), b: f(b), c: f(c) },
            Root::Quartic { cc, cs, c, s, one } => {
                Root::Quartic { cc: f(cc), cs: f(cs), c: f(c), s: f(s), one: f(one) }
            }
        }
    }

    /// Its operands, in the order of [`Root::map`].
    pub fn operands(&self) -> Vec<V> {
        let mut found = vec![];
        self.map(|v| found.push(v));
        found
    }
}

/// A step of a [`Solver`].
#[derive(Clone, PartialEq, Debug)]
pub struct Node<V> {
    /// The equation.
    pub root: Root<V>,
    /// What vanishes where the equation does not determine its unknown, if that is not what the root divides by
    /// (|denominator|, √(x² + y²), √(a² + b²), |a|, the largest coefficient).
    pub guard: Option<V>,
    /// The dimension of the guard: it counts as vanished below `tolerance · size^degree`.
    pub degree: u8,
    /// The names of the results, as many as [`Root::results`].
    pub results: Vec<Symbol>,
    /// What its branches mean to a person: `shoulder`, `elbow`.
    pub label: Option<String>,
}

/// All solutions of equations, as programs and roots.
///
/// Registers 0, 1, … hold the variables in order; the levels say which registers they read and write.
#[derive(Clone, Debug)]
pub struct Solver {
    /// What is known at every solution only.
    pub variables: Vec<Symbol>,
    /// What is known before.
    pub parameters: Vec<Symbol>,
    /// A level more than nodes: level i is what can be computed before node i, the last one what follows them all.
    pub levels: Vec<Level>,
    /// The nodes, operands as registers.
    pub nodes: Vec<Node<Register>>,
    /// Where the results come to be, with their names.
    pub outputs: Vec<(String, Register)>,
    /// For each output, whether it is an angle, equal modulo 2π.
    pub angles: Vec<bool>,
    /// Where the residual of the equations comes to be: a number without dimension, 0 for an exact solution.
    pub residual: Register,
    /// Where the size that guards are compared with comes to be; known at level 0.
    pub size: Register,
    /// Where it comes to be how far the variables are from what they must be (entries of a rotation), if that is computed;
    /// known at level 0. What is solved then is the nearest that can be.
    pub defect: Option<Register>,
    /// How many registers there are.
    pub registers: usize,
}

/// A guard below `GUARD · size^degree` counts as vanished: rounding alone leaves as much.
pub const GUARD: f64 = 256.0 * f64::EPSILON / 2.0;
/// A discriminant that is negative by less than `CLAMP` times its terms counts as 0; the residual decides.
pub const CLAMP: f64 = 1e-6;
/// A branch is a solution if its residual is at most this.
pub const TOLERANCE: f64 = 1e-9;
/// A branch with a residual up to this is kept, for the caller to improve; with a larger one it is dropped.
pub const CANDIDATE: f64 = 1e-4;
/// A guard below this, beside what is usual of it, may be one that vanishes at a solution which is known to the square root
/// of rounding only.
pub const NEAR: f64 = 1e-6;
/// A guard below this, beside what is usual of it, magnifies the error of such a solution until what follows means little:
/// where there is one, whether all solutions were found is to be confirmed.
pub const BESIDE: f64 = 1e-4;
/// By less than this, all in all, a solver divides only where rounding grows until it may hide branches.
const CLEAR: f64 = 1e-5;

/// Whether a solver usually divides by so little, all in all, that rounding may hide branches: what it finds need not be
/// all. `usual` is how large the guard of each node is usually ([`SolverFunction::usual_guards`]).
pub fn may_hide(usual: impl IntoIterator<Item = f64>) -> bool {
    usual.into_iter().product::<f64>() < CLEAR
}

/// The largest defect of the variables that is taken for rounding.
pub const ROUNDED: f64 = 1e-5;
/// Two branches are the same solution if all results differ by at most this (angles modulo 2π).
pub const SAME: f64 = 2e-7;

impl Solver {
    /// The largest number of solutions.
    pub fn max_solutions(&self) -> usize {
        self.nodes.iter().map(|n| n.root.branches()).product()
    }

    /// The registers of a node's results: those behind the variables and the results of earlier nodes.
    ///
    /// # Panics
    /// If there are not that many nodes.
    pub fn results(&self, node: usize) -> std::ops::Range<Register> {
        let earlier: usize = self.nodes[..node].iter().map(|n| n.root.results()).sum();
        let first = (self.variables.len() + earlier) as Register;
        first..first + self.nodes[node].root.results() as Register
    }
}

/// A node under construction.
pub type Draft = Node<Value>;
