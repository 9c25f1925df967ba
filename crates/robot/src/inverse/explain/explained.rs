//! What is said of a step.

use crate::explain::{Factor, Language, Math, Proof, Words};
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
    pub why: Option<Words>,
    /// The equations, numbered.
    pub equations: Vec<Statement>,
}

/// A case, and what it means.
#[derive(Clone, Debug)]
pub struct Case {
    /// When.
    pub when: Vec<Math>,
    /// Then.
    pub then: Words,
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
    pub elimination: Option<(Expr, Words)>,
    /// Names that are used from here on.
    pub names: Vec<Statement>,
    /// The type in words.
    pub kind: Words,
    /// The type's number in the books: Paul; Khalil and Dombre.
    pub number: &'static str,
    /// The general form of the type.
    pub form: Vec<Math>,
    /// The coefficients in it.
    pub coefficients: Vec<Statement>,
    /// From the equation to the solution.
    pub solution: Vec<Statement>,
    /// When it has how many values.
    pub conditions: Vec<Case>,
    /// What the branches are called.
    pub label: Option<Words>,
    /// The sign that tells them apart, ±1.
    pub sign: Option<Expr>,
    /// Later steps that use the unknown, from 1.
    pub used_by: Vec<usize>,
    /// What is lost or added on the way.
    pub remark: Words,
}

/// Ordinal numbers of rows and columns.
pub fn ordinal(n: usize, language: Language) -> &'static str {
    language.pick(
        ["zeroth", "first", "second", "third", "fourth"],
        ["zéroième", "première", "deuxième", "troisième", "quatrième"],
    )[n.min(4)]
}
