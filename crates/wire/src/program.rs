//! Programs: their steps, and what they cost.

use denavit_program::Count;
use denavit_symbolic::Expr;
use serde::Serialize;

/// Operations of a program.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
pub struct Operations {
    /// Additions and subtractions.
    pub additions: u32,
    /// Multiplications.
    pub multiplications: u32,
    /// Angles of which a sine or a cosine is taken.
    pub sincos: u32,
}

impl From<&Count> for Operations {
    fn from(count: &Count) -> Self {
        let &Count { additions, multiplications, sincos, .. } = count;
        Operations { additions, multiplications, sincos }
    }
}

/// A step of a program.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Step {
    /// What it is called: `C23`, `t14`.
    pub name: String,
    /// Whether it is a result.
    pub output: bool,
    /// Its formula, in the names of the steps before.
    pub value: String,
}

impl Step {
    /// A step, its formula printed by `text`.
    pub fn of(step: &denavit_program::Step, text: impl Fn(Expr) -> String) -> Self {
        Step { name: step.name.clone(), output: step.is_output, value: text(step.value) }
    }
}

/// A formula with its name.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Named {
    /// The name.
    pub name: String,
    /// The formula.
    pub value: String,
}
