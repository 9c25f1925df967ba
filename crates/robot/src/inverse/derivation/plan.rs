//! The derivation as a list of steps: which unknown, from which equation, of which type.

use super::equations::{Entry, Source};
use super::known::Unknown;
use denavit_symbolic::poly::Poly;

/// A sum that is kept in the form that loses least: Σ squares² + plus.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Norm {
    /// What is squared; known.
    pub squares: Vec<Poly>,
    /// The rest.
    pub plus: Poly,
}

impl From<Poly> for Norm {
    fn from(plus: Poly) -> Self {
        Norm { squares: vec![], plus }
    }
}

/// `a·cos x + b·sin x = c`, of known a, b, c.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The factor of the cosine.
    pub a: Poly,
    /// The factor of the sine.
    pub b: Poly,
    /// The right-hand side.
    pub c: Norm,
    /// The dimension of the equation.
    pub degree: u8,
    /// Where it comes from.
    pub origin: Origin,
}

/// Where an equation in one unknown comes from.
#[derive(Clone, Debug, PartialEq)]
pub enum Origin {
    /// An element of the two sides of a product.
    Entry(Source),
    /// The sum of squares of position components at two cuts.
    Squares {
        /// The first element of the middle part.
        left: usize,
        /// The element behind it.
        right: usize,
        /// The components that are squared.
        components: Vec<usize>,
    },
    /// Two equations from which an unknown is eliminated.
    Eliminated {
        /// What goes.
        unknown: Unknown,
        /// How.
        how: Elimination,
        /// From what.
        from: Box<[Origin; 2]>,
    },
}

impl Origin {
    /// The elements of products that it is made of.
    pub fn sources(&self) -> Vec<Source> {
        match self {
            Origin::Entry(source) => vec![*source],
            Origin::Squares { left, right, components } => {
                let entry = |&k: &usize| Source { left: *left, right: *right, entry: Entry::Position(k) };
                components.iter().map(entry).collect()
            }
            Origin::Eliminated { from, .. } => from.iter().flat_map(Origin::sources).collect(),
        }
    }

    /// How many operations lie between the equation and an element of a product.
    pub fn depth(&self) -> u8 {
        match self {
            Origin::Entry(_) => 0,
            Origin::Squares { .. } => 1,
            Origin::Eliminated { from, .. } => 2 + from[0].depth() + from[1].depth(),
        }
    }
}

/// How an unknown is eliminated from two equations that are linear in it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Elimination {
    /// The factors of cosine and sine are those of a rotation: square and add.
    Rotation,
    /// Cramer's rule for cosine and sine, whose squares add up to 1. May add roots.
    Cramer,
    /// Cramer's rule for a displacement. May add roots.
    Displacement,
}

/// The equation of a step, by type.
#[derive(Clone, Debug, PartialEq)]
pub enum Form {
    /// `denominator·r = numerator` (type 1).
    Ratio {
        /// The right-hand side.
        numerator: Poly,
        /// The factor.
        denominator: Poly,
    },
    /// Two equations in cosine and sine (type 3).
    Pair {
        /// What their determinant is.
        determinant: Determinant,
    },
    /// `a·cos + b·sin = 0` (type 2 without right-hand side).
    Line,
    /// `a·cos + b·sin = c` (type 2).
    Sincos,
    /// `a·r² + 2b·r + c = 0`.
    Quadratic {
        /// The factor of r².
        a: Poly,
        /// Half the factor of r.
        b: Poly,
        /// The constant.
        c: Norm,
    },
    /// A polynomial of degree 2 in cosine and sine: factors of cos², cos·sin, cos, sin, 1.
    Quartic(Box<[Norm; 5]>),
}

/// What is known of the determinant of two equations in cosine and sine.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Determinant {
    /// The rows are perpendicular and of constant length: it never vanishes.
    Constant,
    /// The rows are perpendicular and of equal length: it vanishes only with both.
    Perpendicular,
    /// Neither.
    General,
}

/// A step of the derivation.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// What is found.
    pub unknown: Unknown,
    /// The type of the equation.
    pub form: Form,
    /// The equation (of a Line or Sincos), or the equations.
    pub rows: Vec<Row>,
    /// Where it comes from.
    pub origins: Vec<Origin>,
    /// The dimension of the equation.
    pub degree: u8,
    /// What one pays for it.
    pub cost: Cost,
}

/// The price of a step, the most important first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct Cost {
    /// How many values the unknown has.
    pub roots: u8,
    /// Whether roots may be added that solve the step's equation alone.
    pub spurious: bool,
    /// How badly the equation determines its unknown at the worst: 0 never, 1 at isolated places, 2 and more.
    pub condition: u8,
    /// How far the equation is from an element of a product.
    pub depth: u8,
    /// The length of the equation.
    pub terms: usize,
}
