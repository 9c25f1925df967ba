//! Closed loops: a tree of rows, and pairs of frames on it that coincide (Khalil and Kleinfinger 1986).
//!
//! Of each loop one joint is cut. Its variable stands in the frame on the left side of the closure, the right side is constant. Joints
//! that are driven have the variables q1, q2, …; p1, p2, … are passive: the closures determine them. The tree with its passive
//! variables is a type of its own, so that nothing takes it for one in which every joint moves by itself.
//!
//! - [`Plan`]: the order in which loops are solved, each by a dyad in closed form.
//! - [`Mode`]: one of the ways in which the loops can be assembled.
//! - [`Linkage::chain`]: the serial chain that a linkage is where its passive joints are affine in the driven ones.

mod affine;
mod bodies;
mod chain;
pub mod dyad;
mod mode;
mod order;
mod plane;
pub mod spherical;
mod towards;
mod write_par;

pub use chain::{ClosedChain, NotCoupled};
pub use dyad::Complex;
pub use mode::{Mode, NoMode, Sign};
pub use order::{Dyad, Plan, Step, Sum, Unsolved, Vectors};
pub use plane::{Fault, Planar, Term};
pub use spherical::{Between, Spherical};
pub use towards::{NotTowards, TipPlane, Towards, Wanted};
pub use write_par::write_linkage_par;

use super::branches::{NamedFrame, RowTree};
use super::{Description, JointKind, NoChain, Row, Variable};
use crate::geometry::Transform;
use denavit_symbolic::{Expr, Symbol};
use std::ops::Range;

/// A tree of rows with closed loops.
#[derive(Clone, Debug)]
pub struct Linkage {
    /// The rows; of its variables some are passive. It has no poses: these are of driven joints alone.
    pub tree: RowTree,
    /// The loops.
    pub closures: Vec<Closure>,
    /// Assembly modes that have names; the first is the one that is meant.
    pub modes: Vec<NamedMode>,
    /// Configurations with names: values of the driven joints, q1 first.
    pub poses: Vec<(String, Vec<Expr>)>,
}

/// Two frames that coincide.
#[derive(Clone, Debug)]
pub struct Closure {
    /// What people call it.
    pub name: Option<String>,
    /// The side that holds the variable of the cut joint, if a joint is cut and no link.
    pub left: Side,
    /// The side that is constant.
    pub right: Side,
    /// Its place in the text that it was read from.
    pub span: Range<usize>,
}

/// One side of a closure: a frame on a row of the tree.
#[derive(Clone, Debug)]
pub struct Side {
    /// The row that it stands on; none for frame 0.
    pub after: Option<usize>,
    /// The frame there.
    pub row: Row,
}

/// An assembly mode that has a name.
#[derive(Clone, Debug)]
pub struct NamedMode {
    /// The name.
    pub name: String,
    /// What tells it.
    pub told: Told,
    /// Its place in the text that it was read from.
    pub span: Range<usize>,
}

/// What tells an assembly mode from the others.
#[derive(Clone, Debug)]
pub enum Told {
    /// What passive variables are there.
    Relations(Vec<(Symbol, Expr)>),
    /// The signs of its dyads, as [`Mode`] prints them.
    Signs(String),
}

/// The number of the passive variable that a name is: `p12` is 12.
pub(in crate::description) fn passive_number(name: &str) -> Option<usize> {
    let index = name.strip_prefix('p')?;
    let plain = index.len() <= 4 && !index.starts_with('0') && index.bytes().all(|b| b.is_ascii_digit());
    if plain { index.parse().ok() } else { None }
}

/// True for the variable of a passive joint.
pub fn is_passive(symbol: Symbol) -> bool {
    passive_number(&symbol.name()).is_some()
}

impl Linkage {
    /// The variables of the rows and of the cut joints, in that order.
    fn variables(&self) -> impl Iterator<Item = Variable> {
        let cut = self.closures.iter().filter_map(|c| c.left.row.variable);
        self.tree.rows.iter().filter_map(|r| r.variable).chain(cut)
    }

    /// The variables of the driven joints, q1 first.
    pub fn driven(&self) -> Vec<Variable> {
        self.variables().filter(|v| !is_passive(v.symbol)).collect()
    }

    /// The variables of the passive joints, p1 first: those of cut joints last.
    pub fn passive(&self) -> Vec<Variable> {
        self.variables().filter(|v| is_passive(v.symbol)).collect()
    }

    /// What a variable moves.
    pub fn kind(&self, symbol: Symbol) -> Option<JointKind> {
        self.variables().find(|v| v.symbol == symbol).map(|v| v.kind)
    }

    /// What a closure is called: by its name, else by its number, from 1.
    pub fn loop_name(&self, closure: usize) -> String {
        self.closures[closure].name.clone().unwrap_or_else(|| format!("loop {}", closure + 1))
    }

    /// The rows from the last frame that both sides of a closure stand on, along the left side and along the right.
    pub fn sides(&self, closure: usize) -> [Vec<&Row>; 2] {
        let Closure { left, right, .. } = &self.closures[closure];
        let ways = [left.after, right.after].map(|on| self.tree.way(on));
        let common = ways[0].iter().zip(&ways[1]).take_while(|(a, b)| a == b).count();
        let [a, b] = [&ways[0][common..], &ways[1][common..]].map(|w| w.iter().map(|&j| &self.tree.rows[j]));
        [a.chain([&left.row]).collect(), b.chain([&right.row]).collect()]
    }

    /// The frame of a name, or that at which a chain ends where none is named: its name, the rows on the way to it, and its pose on the
    /// last of them.
    ///
    /// # Errors
    /// If there is no such frame, or several ends.
    pub fn way(&self, to: Option<&str>) -> Result<(String, Vec<usize>, Transform<Expr>), NoChain> {
        let name = self.tree.end(None, to)?;
        let frame = self.tree.frames.iter().find(|f| f.name == name);
        let pose = frame.map_or(Transform::identity(), |f| f.pose);
        let rows = self.tree.way(self.tree.row_of(&name));
        Ok((name, rows, pose))
    }

    /// The names in it that are neither variables nor parameters with a value.
    pub fn open_names(&self) -> Vec<String> {
        let variables: Vec<Symbol> = self.variables().map(|v| v.symbol).collect();
        let d = self.all_rows();
        let cells = d.rows.iter().flat_map(|r| [r.theta, r.d, r.a, r.alpha, r.gamma, r.b]);
        let frames = self.tree.frames.iter().flat_map(|f| f.pose.matrix().concat());
        let all = cells.chain(frames).chain(self.tree.base.matrix().concat());
        let mut names: Vec<String> = vec![];
        for s in all.flat_map(Expr::symbols) {
            let name = s.name().to_string();
            let has_value = self.tree.parameters.iter().any(|p| p.symbol == s && p.value.is_some());
            if !variables.contains(&s) && !has_value && !names.contains(&name) {
                names.push(name);
            }
        }
        names
    }

    /// All rows as if they were a table, those of the tree first, then the left and the right side of each closure: for what is said
    /// of parameters.
    pub fn all_rows(&self) -> Description {
        let mut d = self.tree.all_rows();
        d.rows.extend(self.closures.iter().flat_map(|c| [c.left.row.clone(), c.right.row.clone()]));
        d
    }

    /// The linkage with the values of its parameters in their place; those without value stay.
    #[must_use]
    pub fn in_numbers(&self) -> Linkage {
        let parameters = &self.tree.parameters;
        let value = |e: Expr| e.substitute(|s| parameters.iter().find(|p| p.symbol == s)?.value);
        let mut numbers = self.clone();
        let mut d = self.all_rows().in_numbers();
        let sides = d.rows.split_off(self.tree.rows.len());
        for (closure, rows) in numbers.closures.iter_mut().zip(sides.chunks_exact(2)) {
            (closure.left.row, closure.right.row) = (rows[0].clone(), rows[1].clone());
        }
        for mode in &mut numbers.modes {
            if let Told::Relations(all) = &mut mode.told {
                all.iter_mut().for_each(|r| r.1 = value(r.1));
            }
        }
        let frames = self.tree.frames.iter().map(|f| NamedFrame { pose: f.pose.map(value), ..f.clone() });
        numbers.tree.frames = frames.collect();
        (numbers.tree.rows, numbers.tree.base, numbers.tree.gravity) = (d.rows, d.base, d.gravity);
        numbers.tree.parameters = d.parameters;
        numbers
    }
}
