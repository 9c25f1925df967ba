//! A formula beside the names in which its document prints.

use denavit_symbolic::print::{Style, print};
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Expr, Node};
use std::fmt;
use std::rc::Rc;

/// A formula that is shown in the notation of a document. Two are equal if what they say is.
#[derive(Clone)]
pub struct Formula {
    /// What it says.
    pub value: Expr,
    /// The names of the document.
    pub names: Rc<Vocabulary>,
}

impl Formula {
    /// A formula in the names of a document.
    pub fn new(value: Expr, names: &Rc<Vocabulary>) -> Self {
        Formula { value, names: Rc::clone(names) }
    }
}

/// True for a formula with a root of a sum, as the distance from an axis is one.
pub(super) fn has_root_of_sum(e: Expr) -> bool {
    let is_root = |e: Expr| matches!(e.node(), Node::Sqrt(a) if matches!(a.node(), Node::Add(..)));
    Expr::postorder(&[e]).into_iter().any(is_root)
}

impl PartialEq for Formula {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl fmt::Display for Formula {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&print(self.value, &self.names, Style::Ascii))
    }
}

impl fmt::Debug for Formula {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}
