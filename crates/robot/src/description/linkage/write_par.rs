//! A linkage as a `.par` file: its links, the frames of the cut joints, and the frames on the other side of the cuts.

use super::{Closure, Linkage, is_passive};
use crate::description::branches::{columns, with_frames_as_rows, with_plain_variables};
use crate::description::{JointKind, NoPar, ParFile, Row, RowTree};
use denavit_symbolic::{Angle, Expr};

/// The `.par` file of a linkage. Names of joints, limits, masses and assembly modes have no place in it.
///
/// # Errors
/// If a joint follows others.
pub fn write_linkage_par(linkage: &Linkage) -> Result<ParFile, NoPar> {
    let count = linkage.tree.rows.len();
    let mut all = RowTree { poses: vec![], ..linkage.tree.clone() };
    let closures: Vec<Closure> = linkage.closures.iter().map(with_plain_variable).collect();
    for side in closures.iter().map(|c| &c.left).chain(closures.iter().map(|c| &c.right)) {
        all.rows.push(side.row.clone());
        all.after.push(side.after);
    }
    let (_, _, moved) = with_frames_as_rows(&all)?;
    let (all, frames) = with_plain_variables(&all)?;
    // Links first, then the left sides, then the right ones.
    let sides = &moved[count..];
    let links = (0..all.rows.len()).filter(|j| !sides.contains(j));
    let order: Vec<usize> = links.chain(sides.iter().copied()).collect();
    let place = |j: usize| order.iter().position(|&k| k == j).unwrap_or_default();
    let rows: Vec<Row> = order.iter().map(|&j| all.rows[j].clone()).collect();
    let after = order.iter().map(|&j| all.after[j].map(place)).collect();
    let loops = closures.len();
    let links = rows.len() - 2 * loops;
    let driven: Vec<bool> = rows.iter().map(|r| r.variable.is_some_and(|v| !is_passive(v.symbol))).collect();
    let tree = RowTree { rows, after, ..all };
    let text = columns(&tree, [links, links + loops, links + 2 * loops, 2], |j| driven[j]);
    let is_link = |name: &str| !name.parse::<usize>().is_ok_and(|n| n > count);
    let frames = frames.into_iter().filter(|f| is_link(&f.0)).map(|(name, j)| (name, place(j - 1) + 1));
    Ok(ParFile { text, frames: frames.collect(), last: links })
}

/// The closure with what is constant beside the variable of its cut joint on the other side.
fn with_plain_variable(closure: &Closure) -> Closure {
    let mut plain = closure.clone();
    let Some(v) = closure.left.row.variable else { return plain };
    let (left, right) = (&mut plain.left.row, &mut plain.right.row);
    let still = |e: Expr| Angle::of(e.substitute(|s| (s == v.symbol).then(|| Expr::int(0)))).to_expr();
    let difference = |a: Expr, b: Expr| Angle::of(a - b).to_expr();
    // Both are about or along the z that the two frames have in common.
    match v.kind {
        JointKind::Revolute => {
            let rest = still(left.theta);
            (left.theta, right.theta) = (difference(left.theta, rest), difference(right.theta, rest));
        }
        JointKind::Prismatic => {
            let rest = still(left.d);
            (left.d, right.d) = (difference(left.d, rest), difference(right.d, rest));
        }
    }
    plain
}
