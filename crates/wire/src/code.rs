//! Generated source code.

use crate::Schema;
use crate::program::Operations;
use denavit_emit::Language;
use denavit_generate::{Generated, Inverse};
use denavit_symbolic::Symbol;
use serde::Serialize;
use std::path::Path;

/// What was written.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Written {
    /// Paths in the folder.
    pub files: Vec<String>,
    /// Where.
    pub folder: String,
    /// Functions of the joints.
    pub functions: Vec<Function>,
    /// The inverse function; null if there is none.
    pub ik: Option<Solver>,
    /// `Rust`.
    pub language: &'static str,
    /// The version.
    pub schema: Schema,
    /// The command that tests the folder, to be run in it.
    pub test: String,
}

/// A function of the joints.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Function {
    /// Equal to what it is, and on what that rests.
    pub claim: String,
    /// Its operations.
    pub count: Operations,
    /// What it divides by that depends on parameters alone: where one of these is 0 it does not hold.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub divides_by: Vec<String>,
    /// Its name: `fk`.
    pub name: &'static str,
    /// Whether it is proved equal to what it stands for.
    pub proved: bool,
}

/// An inverse function.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Solver {
    /// Parameters whose values are part of the formulas.
    pub assumed: Vec<String>,
    /// What its branches are called.
    pub branches: Vec<String>,
    /// Joint variables that are given beside the pose.
    pub given: Vec<String>,
    /// Whether the derivation chose them.
    pub given_by_choice: bool,
    /// The largest number of solutions.
    pub max_solutions: usize,
    /// `closed form` or `elimination`.
    pub method: &'static str,
    /// Poses in the test.
    pub poses_in_test: usize,
}

impl Written {
    /// Code in a language, in a folder.
    pub fn of(made: &Generated, language: Language, folder: &Path) -> Self {
        let function = |made: &denavit_generate::Function| Function {
            claim: made.claim.clone(),
            count: Operations::from(&made.count),
            divides_by: made.divides_by.clone(),
            name: made.wanted.name(),
            proved: made.is_proved,
        };
        Written {
            files: made.files.iter().map(|f| f.path.clone()).collect(),
            folder: folder.display().to_string(),
            functions: made.functions.iter().map(function).collect(),
            ik: made.inverse.as_ref().map(Solver::from),
            language: language.name(),
            schema: Schema,
            test: made.test_command(language),
        }
    }
}

impl From<&Inverse> for Solver {
    fn from(ik: &Inverse) -> Self {
        let name = |s: &Symbol| s.name().to_string();
        Solver {
            assumed: ik.assumed.iter().map(|(s, _)| name(s)).collect(),
            branches: ik.branches.clone(),
            given: ik.given.iter().map(name).collect(),
            given_by_choice: ik.given_by_choice,
            max_solutions: ik.max_solutions,
            method: if ik.by_elimination { "elimination" } else { "closed form" },
            poses_in_test: ik.vectors,
        }
    }
}
