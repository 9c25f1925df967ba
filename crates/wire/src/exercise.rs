//! Exercises with their points.

use crate::Schema;
use denavit::description::write_toml;
use denavit_check::marking::{self, Rubric};
use denavit_report::{Exercise as Made, render};
use serde::Serialize;

/// A sheet of tasks.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Exercise {
    /// How many configurations or poses it has.
    pub count: usize,
    /// The points, item by item.
    pub items: Vec<Item>,
    /// `fk`, `dh`, `ik`, `jacobian`, `singularities`, `transforms`, `position`, `statics`, `torques` or `path`.
    pub kind: &'static str,
    /// The robot's name.
    pub robot: String,
    /// The version.
    pub schema: Schema,
    /// What it was made from.
    pub seed: u64,
    /// The solution as Markdown, where it was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub solution: Option<String>,
    /// The tasks as Markdown.
    pub statement: String,
    /// What it is called.
    pub title: String,
    /// The robot as a robot file: answers are held against it.
    pub toml: String,
}

/// What answers a task.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Item {
    /// The left sides that count, `*` for any letters.
    pub claims: Vec<String>,
    /// How many formulas a full answer has.
    pub formulas: usize,
    /// What it is called.
    pub name: String,
    /// The most that it earns.
    pub points: f64,
}

impl Exercise {
    /// As it was made, with its solution or without.
    pub fn of(made: &Made, with_solution: bool) -> Self {
        let text = |document| render::markdown(document, "figures").text;
        let item = |item: &marking::Item| Item {
            claims: item.claims.clone(),
            formulas: item.formulas,
            name: item.name.clone(),
            points: item.points,
        };
        Exercise {
            count: made.options.count,
            items: made.rubric.items.iter().map(item).collect(),
            kind: made.options.kind.name(),
            robot: made.robot.name.clone(),
            schema: Schema,
            seed: made.options.seed,
            solution: with_solution.then(|| text(&made.solution)),
            statement: text(&made.statement),
            title: made.statement.title.clone(),
            toml: write_toml(&made.robot),
        }
    }
}

/// What an answer earns.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Marked {
    /// One an item.
    pub marks: Vec<Mark>,
    /// The points that a teacher decides on.
    pub open: f64,
    /// The points that are certain.
    pub points: f64,
}

/// What an item earns.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Mark {
    /// How many formulas were judged.
    pub judged: usize,
    /// The most that it earns.
    pub most: f64,
    /// What it is called.
    pub name: String,
    /// The points that a teacher decides on.
    pub open: f64,
    /// The points that are certain.
    pub points: f64,
    /// How many formulas are right.
    pub right: usize,
}

impl Marked {
    /// Of a sheet of points.
    pub fn of(rubric: &Rubric, sheet: &marking::Sheet) -> Self {
        let mark = |(item, mark): (&marking::Item, &marking::Mark)| Mark {
            judged: mark.right[1],
            most: item.points,
            name: item.name.clone(),
            open: mark.open,
            points: mark.points,
            right: mark.right[0],
        };
        Marked {
            marks: rubric.items.iter().zip(&sheet.marks).map(mark).collect(),
            open: sheet.open(),
            points: sheet.points(),
        }
    }
}
