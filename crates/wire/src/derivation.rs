//! The derivation of an inverse model.

use crate::{Schema, words};
use denavit_report::document::{Math, math};
use denavit_report::explain::{self, Explanation};
use denavit_report::words::{Inverse as _, Terms as _};
use denavit_symbolic::Expr;
use denavit_symbolic::print::{Style, print};
use denavit_symbolic::vocabulary::Vocabulary;
use serde::Serialize;

/// How the joint variables follow from a pose.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Derivation {
    /// Joint variables that are given beside the pose.
    pub given: Vec<String>,
    /// Whether the derivation chose them.
    pub given_by_choice: bool,
    /// How joint variables follow that no step gives by name.
    pub joints: Vec<Statement>,
    /// The matrices of the chain.
    pub matrices: Vec<String>,
    /// The largest number of isolated solutions; null if the derivation ended early.
    pub max_solutions: Option<usize>,
    /// Joint variables that were not found.
    pub missing: Vec<String>,
    /// What a pose must meet.
    pub pose_conditions: Vec<Statement>,
    /// On what all formulas rest.
    pub proof: &'static str,
    /// The robot's name.
    pub robot: String,
    /// The version.
    pub schema: Schema,
    /// `derived` or `refused`.
    pub status: &'static str,
    /// The steps.
    pub steps: Vec<Step>,
}

/// A formula, or an equation with its two sides.
#[derive(Clone, PartialEq, Debug, Default, Serialize)]
pub struct Statement {
    /// What is no single equation.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub formula: Option<String>,
    /// The left side.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left: Option<String>,
    /// The number by which others refer to it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub number: Option<usize>,
    /// On what it rests, unless it is a definition.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub proof: Option<&'static str>,
    /// The right side.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub right: Option<String>,
}

/// How one unknown is found.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Step {
    /// What the letters of the form stand for.
    pub coefficients: Vec<Statement>,
    /// When it has how many values.
    pub conditions: Vec<Case>,
    /// The general form of its equation.
    pub form: Vec<String>,
    /// The type of its equation, in words.
    pub kind: String,
    /// What its branches are called.
    pub label: Option<String>,
    /// What a sum of angles stands for.
    pub meaning: Option<String>,
    /// Names that are used from here on.
    pub names: Vec<Statement>,
    /// What is lost or added on the way.
    pub remark: String,
    /// The sign that tells its values apart, ±1.
    pub sign: Option<String>,
    /// From the equation to the unknown.
    pub solution: Vec<Statement>,
    /// Where its equations come from.
    pub sources: Vec<Source>,
    /// The type of its equation, by the number that Khalil and Dombre give it.
    #[serde(rename = "type")]
    pub number: &'static str,
    /// What is found.
    pub unknown: String,
    /// Later steps that use it.
    pub used_by: Vec<usize>,
    /// How many values it has.
    pub values: usize,
}

/// An equation of the chain.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Source {
    /// Row and column of the elements that are used.
    pub elements: Vec<(usize, usize)>,
    /// The equations.
    pub equations: Vec<Statement>,
    /// Whether the inverse of both sides is taken.
    pub inverse: bool,
    /// The matrix equation.
    pub product: String,
    /// Whether the squares of the rows are added.
    pub squares_added: bool,
    /// Why few joints occur.
    pub why: Option<String>,
}

/// What follows where something holds.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Case {
    /// What follows.
    pub then: String,
    /// What holds.
    pub when: Vec<String>,
}

impl Derivation {
    /// What was explained.
    pub fn of(e: &Explanation) -> Self {
        let names = &Names(e.names());
        let product = |m: &_| names.formula(m);
        Derivation {
            given: names.texts(&e.given),
            given_by_choice: e.given_by_choice,
            joints: names.all(&e.joints),
            matrices: e
                .matrices
                .iter()
                .map(|(name, of)| product(&Math::Products(vec![name.clone()], of.clone())))
                .collect(),
            max_solutions: e.solutions,
            missing: names.texts(&e.missing),
            pose_conditions: names.all(&e.leftovers),
            proof: words().proof(e.proof()),
            robot: e.description.name.clone(),
            schema: Schema,
            status: if e.solutions.is_some() { "derived" } else { "refused" },
            steps: e.steps.iter().map(|s| names.step(s)).collect(),
        }
    }
}

/// The names that formulas use.
struct Names(Vocabulary);

impl Names {
    fn text(&self, e: Expr) -> String {
        print(e, &self.0, Style::Ascii)
    }

    fn texts(&self, all: &[Expr]) -> Vec<String> {
        all.iter().map(|e| self.text(*e)).collect()
    }

    fn formula(&self, m: &Math) -> String {
        math(m, &self.0, Style::Ascii)
    }

    fn formulas(&self, all: &[Math]) -> Vec<String> {
        all.iter().map(|m| self.formula(m)).collect()
    }

    fn statement(&self, s: &explain::Statement) -> Statement {
        let said =
            Statement { number: s.number, proof: s.proof.map(|p| words().proof(p)), ..Statement::default() };
        match &s.math {
            Math::Chain(left, rest) if rest.len() == 1 => {
                Statement { left: Some(self.text(*left)), right: Some(self.text(rest[0].1)), ..said }
            }
            other => Statement { formula: Some(self.formula(other)), ..said },
        }
    }

    fn all(&self, statements: &[explain::Statement]) -> Vec<Statement> {
        statements.iter().map(|s| self.statement(s)).collect()
    }

    fn source(&self, o: &explain::Source) -> Source {
        let (left, right) = &o.product;
        Source {
            elements: o.elements.clone(),
            equations: self.all(&o.equations),
            inverse: o.inverse,
            product: self.formula(&Math::Products(left.clone(), right.clone())),
            squares_added: o.squared,
            why: o.why.as_ref().map(|why| words().component(why)),
        }
    }

    fn step(&self, s: &explain::Explained) -> Step {
        let case =
            |c: &explain::Case| Case { then: words().consequence(c.then), when: self.formulas(&c.when) };
        Step {
            coefficients: self.all(&s.coefficients),
            conditions: s.conditions.iter().map(case).collect(),
            form: self.formulas(&s.form),
            kind: words().kind(s.kind),
            label: s.label.map(|label| label.to_string()),
            meaning: s.meaning.map(|m| self.text(m)),
            names: self.all(&s.names),
            remark: words().remark(s.remark),
            sign: s.sign.map(|x| self.text(x)),
            solution: self.all(&s.solution),
            sources: s.sources.iter().map(|o| self.source(o)).collect(),
            number: s.kind.number(),
            unknown: self.text(s.unknown),
            used_by: s.used_by.clone(),
            values: s.values,
        }
    }
}
