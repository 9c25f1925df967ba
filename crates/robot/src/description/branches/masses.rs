//! What hangs on the rows of a chain beside it.

use super::RowTree;
use crate::description::Row;
use crate::description::tree::{Mass, Unweighed};
use crate::geometry::{Body, Transform};
use denavit_symbolic::{Expr, Symbol};

impl RowTree {
    /// Adds to the rows of a way down the tree the masses of the rows that hang on them beside it, these being where their joints
    /// are at 0; the rows are returned whose joints could move what weighs. Where one moves with a joint of the way, no row weighs
    /// anything, and that is returned.
    pub(super) fn weigh_branches(&self, way: &[usize], rows: &mut [Row]) -> (Vec<usize>, Option<Unweighed>) {
        let on_way: Vec<usize> =
            way.iter().flat_map(|&j| self.motions(&self.rows[j])).map(|motion| motion.1).collect();
        let mut unweighed = None;
        let variables = self.variables();
        let mut held = vec![];
        // Of each row beside the way: the place of the row of the way that it hangs on, its frame there, the last row that moves.
        let mut hangs: Vec<Option<Hanging>> = vec![None; self.rows.len()];
        for (j, row) in self.rows.iter().enumerate() {
            let Some(after) = self.after[j].filter(|_| !way.contains(&j)) else { continue };
            let at = match way.iter().position(|&k| k == after) {
                Some(at) => Some(Hanging { at, pose: Transform::identity(), held: None, follows: false }),
                None => hangs[after],
            };
            let Some(Hanging { at, pose, held: before, follows: follows_before }) = at else { continue };
            let pose = pose * at_rest(row, &variables);
            let motions = self.motions(row);
            let follows = follows_before || motions.iter().any(|m| on_way.contains(&m.1));
            let own = Hanging { at, pose, held: motions.first().map(|_| j).or(before), follows };
            if let Some(body) = row.body() {
                let moves = follows.then(|| Unweighed::Joint(self.frame_name(j)));
                unweighed = unweighed.or(moves);
                held.extend(own.held.filter(|h| !held.contains(h)));
                add(&mut rows[at], &body.seen_from(&pose));
            }
            hangs[j] = Some(own);
        }
        held.sort_unstable();
        if unweighed.is_some() {
            rows.iter_mut().for_each(Row::weigh_nothing);
        }
        (held, unweighed)
    }
}

/// Where a row beside a way hangs.
#[derive(Clone, Copy)]
struct Hanging {
    at: usize,
    pose: Transform<Expr>,
    held: Option<usize>,
    /// True if a joint of the way moves it.
    follows: bool,
}

/// A row's frame in the one before, with all variables at 0.
fn at_rest(row: &Row, variables: &[Symbol]) -> Transform<Expr> {
    let still = |e: Expr| e.substitute(|s| variables.contains(&s).then(|| Expr::int(0)));
    let screws = row.screws(crate::description::Convention::Khalil);
    screws.into_iter().fold(Transform::identity(), |x, screw| x * screw.transform().map(still))
}

/// Adds a body to what a row says of its mass.
fn add(row: &mut Row, body: &Body<Expr>) {
    let sum = row.body().map_or(*body, |own| own + *body);
    let is_known = sum.parameters().iter().all(|e| e.symbols().is_empty());
    row.mass = Some(sum.mass);
    match Mass::of_body(&sum).filter(|_| is_known) {
        Some(mass) => {
            (row.com, row.inertia) = (Some(mass.com), Some(mass.inertia));
            (row.first_moment, row.inertia_at_origin) = (None, None);
        }
        None => {
            (row.com, row.inertia) = (None, None);
            (row.first_moment, row.inertia_at_origin) = (Some(sum.first_moment.0), Some(sum.inertia));
        }
    }
}
