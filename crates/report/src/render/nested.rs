//! A tree as a list of lists.

use crate::document::{Branch, Line};

/// What a nested list is written of; the number is the depth.
pub enum Item<'a> {
    /// A list starts.
    Open(usize),
    /// An entry; the lists inside it follow before it is closed.
    Entry(usize, &'a Line),
    /// An entry ends.
    Done,
    /// A list ends.
    Close(usize),
}

/// All parts of the list that hangs below a branch, in order.
pub fn nested<'a>(branch: &'a Branch, write: &mut dyn FnMut(Item<'a>)) {
    below(branch, 0, write);
}

fn below<'a>(branch: &'a Branch, depth: usize, write: &mut dyn FnMut(Item<'a>)) {
    write(Item::Open(depth));
    for child in &branch.children {
        write(Item::Entry(depth, &child.line));
        if !child.children.is_empty() {
            below(child, depth + 1, write);
        }
        write(Item::Done);
    }
    write(Item::Close(depth));
}
