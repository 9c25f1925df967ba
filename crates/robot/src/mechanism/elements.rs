//! The table as elementary transforms, in order.

use crate::description::Description;
use crate::geometry::{Axis, Transform};
use denavit_symbolic::Expr;

/// An elementary transform of the table.
pub(crate) enum Elementary {
    Turn(Axis, Expr),
    Shift(Axis, Expr),
    Fixed(Transform<Expr>),
    /// The end of a row of the table.
    EndOfRow(usize),
}

/// What rows `from+1 … to` multiply, in order, with the base before row 1 and the tool behind the last on request.
pub(crate) fn elements(
    description: &Description,
    from: usize,
    to: usize,
    base: bool,
    tool: bool,
) -> Vec<Elementary> {
    let mut elements = vec![];
    if base {
        elements.push(Elementary::Fixed(description.base));
    }
    for (i, row) in description.rows.iter().enumerate().take(to).skip(from) {
        for screw in row.screws(description.convention) {
            elements.push(Elementary::Turn(screw.axis, screw.angle));
            elements.push(Elementary::Shift(screw.axis, screw.length));
        }
        elements.push(Elementary::EndOfRow(i + 1));
    }
    if tool {
        elements.push(Elementary::Fixed(description.tool));
    }
    elements
}
