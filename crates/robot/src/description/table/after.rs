//! The column a(j): which row each stands on.

use super::columns::Role;
use super::read::ReadRow;
use crate::description::Convention;
use crate::description::diagnostic::Diagnostics;

/// What the column a(j) says.
pub(super) fn antecedents(
    read: &[ReadRow],
    convention: Convention,
    out: &mut Diagnostics,
) -> Option<Vec<Option<usize>>> {
    let first = read.first()?;
    let head = first.source(Role::After)?;
    if convention != Convention::Khalil {
        out.error(head.span.clone(), "antecedents need the convention khalil");
        return None;
    }
    let mut after = vec![];
    for (j, row) in read.iter().enumerate() {
        let cell = row.source(Role::After)?;
        let number = cell.text.trim_matches(['$', ' ']).parse::<usize>();
        // Frame 0, or the frame before the first row, is the base.
        let on = number.ok().map(|n| (n + 1).checked_sub(first.number).and_then(|n| n.checked_sub(1)));
        match on {
            Some(Some(a)) if a >= j => {
                let message = format!(
                    "row {} stands on row {}, which does not come before it",
                    row.number,
                    a + first.number
                );
                out.error(cell.span.clone(), message).hint("number rows from the base outwards: a(j) < j");
            }
            Some(on) => after.push(on),
            None => {
                out.error(cell.span.clone(), "a(j) is the number of a row, 0 for the base");
            }
        }
    }
    let is_tree = after.iter().enumerate().any(|(j, a)| *a != j.checked_sub(1));
    (is_tree && after.len() == read.len()).then_some(after)
}
