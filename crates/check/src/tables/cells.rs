//! The cells in which a table differs from the robot's, whichever way its normals point.

use denavit::description::{Cell, Description, JointKind, Row, Sameness, same_mechanism};
use denavit_symbolic::{Angle, Expr, equal};

/// A cell that is not the robot's.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct WrongCell {
    /// The row, from 0.
    pub row: usize,
    pub cell: Cell,
    pub printed: Expr,
    pub right: Expr,
}

/// The longest table for which ways to turn normals are tried.
const MAX_ROWS: usize = 12;

/// The fewest cells that make a table the robot's; nothing if that does not make it so, or most of them are other ones.
pub(super) fn wrong(robot: &Description, table: &Description) -> Vec<WrongCell> {
    let robot = robot.converted(table.convention).description;
    let count = table.rows.len();
    let is_plain = |d: &Description| d.rows.len() == count && d.rows.iter().all(|r| r.variable.is_some());
    if !is_plain(&robot) || !is_plain(table) || count > MAX_ROWS {
        return vec![];
    }
    let is_first = table.convention.begins_with_joint();
    let mut best: Option<(usize, Vec<WrongCell>)> = None;
    for choice in 0..1_u32 << count {
        let is_turned = |normal: Option<usize>| normal.is_some_and(|k| choice >> k & 1 == 1);
        let (mut cost, mut cells) = (0, vec![]);
        for (k, (a, b)) in robot.rows.iter().zip(&table.rows).enumerate() {
            let (before, behind) = (is_turned(k.checked_sub(1)), is_turned(Some(k)));
            let own = if is_first { behind } else { before };
            for (cell, right, is_free) in wanted(a, own, before != behind) {
                let printed = cell.of(b);
                if is_same(cell, printed, right) {
                    continue;
                }
                cost += if is_free { 1 } else { 100 };
                if !is_free {
                    cells.push(WrongCell { row: k, cell, printed, right });
                }
            }
        }
        if best.as_ref().is_none_or(|b| cost < b.0) {
            best = Some((cost, cells));
        }
    }
    let cells = best.map(|b| b.1).unwrap_or_default();
    if cells.len() > count {
        return vec![];
    }
    let mut mended = table.clone();
    for wrong in &cells {
        let row = &mut mended.rows[wrong.row];
        match wrong.cell {
            Cell::Theta => row.theta = wrong.right,
            Cell::D => row.d = wrong.right,
            Cell::A => row.a = wrong.right,
            Cell::Alpha => row.alpha = wrong.right,
            Cell::Gamma => row.gamma = wrong.right,
            Cell::B => row.b = wrong.right,
        }
    }
    let is_robot = |s: &Sameness| matches!(s, Sameness::Same(s) if s.reversed.iter().all(|r| !r));
    if is_robot(&same_mechanism(&robot, &mended)) { cells } else { vec![] }
}

/// The cells of a row with its normal turned round, and whether a table may have another value there.
fn wanted(row: &Row, is_turned: bool, is_half: bool) -> [(Cell, Expr, bool); 4] {
    let signed = |e: Expr| if is_turned { opposite(e) } else { e };
    let theta = if is_half { Angle::of(row.theta + Expr::pi()).to_expr() } else { row.theta };
    let kind = row.variable.map(|v| v.kind);
    [
        (Cell::Theta, theta, kind == Some(JointKind::Revolute)),
        (Cell::D, row.d, kind == Some(JointKind::Prismatic)),
        (Cell::A, signed(row.a), false),
        (Cell::Alpha, signed(row.alpha), false),
    ]
}

/// The value with the other sign.
pub(super) fn opposite(e: Expr) -> Expr {
    Angle::of(-e).to_expr()
}

fn is_same(cell: Cell, a: Expr, b: Expr) -> bool {
    if a == b {
        return true;
    }
    let difference = Angle::of(a - b).to_expr();
    match cell.turns() {
        true => difference.is_zero() || equal(difference.cos(), Expr::int(1)).is_equal(),
        false => difference.is_zero(),
    }
}
