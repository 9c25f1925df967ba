//! The steps of rows as they stand in the table.

use denavit::description::{Cell, Description, Row};
use denavit_symbolic::Expr;
use denavit_symbolic::print::{Style, print};

/// A step of a row.
pub struct Step {
    /// The cell.
    pub cell: Cell,
    /// What it multiplies by, lengths with values.
    pub value: Expr,
    /// As it is printed.
    pub text: String,
}

/// Those of a table, row by row; `valued` is the same with values for its lengths.
pub fn of(description: &Description, valued: &Description) -> Vec<Vec<Step>> {
    let rows = description.rows.iter().zip(&valued.rows);
    rows.map(|(own, valued)| cells(description, own, valued)).collect()
}

/// The steps of a row in the convention's order; those of a branch only where there is one.
fn cells(description: &Description, own: &Row, valued: &Row) -> Vec<Step> {
    let convention = description.convention;
    let names = description.vocabulary();
    let shown = convention.order().iter().filter(|c| own.is_branch() || !c.is_of_branch());
    let step = |&cell: &Cell| Step {
        cell,
        value: cell.of(valued),
        text: print(cell.of(own), &names, Style::Unicode),
    };
    shown.map(step).collect()
}
