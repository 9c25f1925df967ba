//! What is said of a step.

use crate::tree::{Factor, Math, Proof};
use denavit::inverse::Label;
use denavit::inverse::derivation::Elimination;
use denavit_symbolic::Expr;

/// A formula that is printed.
#[derive(Clone, Debug)]
pub struct Statement {
    /// The formula.
    pub math: Math,
    /// The number by which the text refers to it.
    pub number: Option<usize>,
    /// Whether it is proved; nothing for a definition.
    pub proof: Option<Proof>,
}

/// An equation of the chain.
#[derive(Clone, Debug)]
pub struct Source {
    /// The matrix equation.
    pub product: (Vec<Factor>, Vec<Factor>),
    /// Row and column of the elements that are used, from 1.
    pub elements: Vec<(usize, usize)>,
    /// True if the inverse of both sides is taken.
    pub inverse: bool,
    /// True if the squares of the rows are added.
    pub squared: bool,
    /// Why few joints occur.
    pub why: Option<Component>,
    /// The equations, numbered.
    pub equations: Vec<Statement>,
}

impl Source {
    /// The rows and the columns of its elements, each in a row of equal ones once.
    pub(crate) fn rows_and_columns(&self) -> [Vec<usize>; 2] {
        let mut rows: Vec<usize> = self.elements.iter().map(|e| e.0).collect();
        let mut columns: Vec<usize> = self.elements.iter().map(|e| e.1).collect();
        rows.dedup();
        columns.dedup();
        [rows, columns]
    }
}

/// That an element is the component along some axes, of a direction or of a point, and free of some joints: turning about
/// an axis changes no component along it. Axes and joints are counted from 0.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Component {
    /// The parallel axes that it is taken along.
    pub along: Vec<usize>,
    /// The axes whose direction it is a component of, or on which the point lies.
    pub of: Vec<usize>,
    /// Whether it is one of a point.
    pub is_point: bool,
    /// The joints that do not occur in it.
    pub free: Vec<usize>,
}

/// The type of an equation.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Kind {
    /// A r = B
    Displacement,
    /// A r² + 2 B r + C = 0
    DisplacementSquared,
    /// A cos² + B cos sin + D cos + E sin + F = 0
    Quartic,
    /// A cos + B sin = 0
    Homogeneous,
    /// A cos = C
    Cosine,
    /// B sin = C
    Sine,
    /// A cos + B sin = C
    Linear,
    /// Two equations A cos + B sin = C.
    Pair,
    /// A cos = C and B sin = D
    Separate,
}

impl Kind {
    /// Its number in the books: Paul; Khalil and Dombre; `none` if it has none.
    pub fn number(self) -> &'static str {
        match self {
            Kind::Displacement => "1",
            Kind::Homogeneous | Kind::Cosine | Kind::Sine | Kind::Linear => "2",
            Kind::Pair | Kind::Separate => "3",
            Kind::DisplacementSquared => "5",
            Kind::Quartic => "none",
        }
    }
}

/// A case, and what it means.
#[derive(Clone, Debug)]
pub struct Case {
    /// When.
    pub when: Vec<Math>,
    /// Then.
    pub then: Consequence,
}

impl Case {
    /// True if all of its expressions vanish at once.
    pub(crate) fn is_zeros(&self) -> bool {
        self.when.iter().all(|m| m.exprs().last().is_some_and(|e| e.is_zero()))
    }
}

/// What a case means.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Consequence {
    /// No solution on this branch.
    NoSolution(Bound),
    /// Both values coincide.
    Coincide,
    /// Two values that coincide where equality holds; none otherwise.
    TwoValues(Bound),
    /// The displacement is open, or there is no solution.
    OpenDisplacement,
    /// The angle is open.
    OpenAngle,
    /// No solution, unless the right-hand side vanishes, too.
    OpenUnless,
    /// The joint is open if the right-hand sides vanish, too.
    OpenJoint,
    /// As many values as the quartic has real roots.
    Roots,
    /// One root is the half turn.
    HalfTurn,
    /// The joint is free.
    Free,
    /// Always exactly one value.
    OneValue,
    /// Two equations are one.
    OneEquation,
}

/// What keeps a branch from having a solution.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Bound {
    /// The root of a negative number.
    Reach,
    /// A distance that two links cannot span.
    Span,
}

/// What is lost or added by a step.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Remark {
    /// The elimination may add roots.
    MayAdd,
    /// Squares were added, and no root with them.
    SquaresAddNone,
    /// Nothing is dropped, nothing is squared.
    Whole,
    /// No root is added.
    AddsNone,
}

/// A step explained.
#[derive(Clone, Debug)]
pub struct Explained {
    /// The name of the unknown: q1, q234.
    pub unknown: Expr,
    /// What a sum stands for: q2 + q3 + q4.
    pub meaning: Option<Expr>,
    /// How many values it has.
    pub values: usize,
    /// Where the equations come from.
    pub sources: Vec<Source>,
    /// What is done with them: an unknown that is eliminated, and how.
    pub elimination: Option<(Expr, Elimination)>,
    /// Names that are used from here on.
    pub names: Vec<Statement>,
    /// The type.
    pub kind: Kind,
    /// The general form of the type.
    pub form: Vec<Math>,
    /// The coefficients in it.
    pub coefficients: Vec<Statement>,
    /// From the equation to the solution.
    pub solution: Vec<Statement>,
    /// When it has how many values.
    pub conditions: Vec<Case>,
    /// What the branches are called.
    pub label: Option<Label>,
    /// The sign that tells them apart, ±1.
    pub sign: Option<Expr>,
    /// Later steps that use the unknown, from 1.
    pub used_by: Vec<usize>,
    /// What is lost or added on the way.
    pub remark: Remark,
}
