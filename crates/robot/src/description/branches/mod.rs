//! Trees of rows: the notation of Khalil and Kleinfinger (1986), in which each row names the frame that it stands on.
//!
//! Row j takes the frame a(j) to its own: `Rz(γ)·Tz(b)·Rx(α)·Tx(d)·Rz(θ)·Tz(r)`. A chain from a frame down the tree is the rows on the
//! way, as they stand; other chains go through the [`Mechanism`] of the tree.

mod chain;
mod masses;
mod par;
mod par_loops;
mod par_masses;
mod place;
mod write_par;

pub use chain::RowChain;
pub use par::read_par;
pub(super) use place::rows_of;
pub(super) use write_par::fixed_rows;
pub use write_par::{NoPar, ParFile, write_par};
pub(in crate::description) use write_par::{columns, with_frames_as_rows, with_plain_variables};

use super::{Convention, Description, JointKind, Mechanism, MissingValue, Parameter, Row};
use crate::geometry::Transform;
use denavit_symbolic::{Angle, Expr, Rational, Symbol};

/// A tree of rows.
#[derive(Clone, Debug)]
pub struct RowTree {
    /// What people call it.
    pub name: String,
    /// Where the numbers come from.
    pub source: Option<String>,
    /// Symbols that stand for constants.
    pub parameters: Vec<Parameter>,
    /// The rows, in Khalil's convention; their variables q1, q2, … count over all of them.
    pub rows: Vec<Row>,
    /// The row that each stands on, an earlier one; none for frame 0.
    pub after: Vec<Option<usize>>,
    /// Frame 0 in the base.
    pub base: Transform<Expr>,
    /// Frames with names that stand on rows.
    pub frames: Vec<NamedFrame>,
    /// The frame at which a chain ends if no other is asked for.
    pub tip: Option<String>,
    /// Configurations with names: values of all joint variables, q1 first.
    pub poses: Vec<(String, Vec<Expr>)>,
    /// The acceleration of gravity in the base, m/s².
    pub gravity: Option<[Expr; 3]>,
}

/// A frame that does not move on its row.
#[derive(Clone, Debug)]
pub struct NamedFrame {
    /// Its name.
    pub name: String,
    /// The row that it stands on; none for frame 0.
    pub on: Option<usize>,
    /// Its pose in that row's frame.
    pub pose: Transform<Expr>,
}

/// The name of the base.
pub(in crate::description) const BASE: &str = "base";

impl RowTree {
    /// What the frame of a row is called: by the row's name, else by its number, from 1.
    pub fn frame_name(&self, row: usize) -> String {
        self.rows[row].name.clone().unwrap_or_else(|| (row + 1).to_string())
    }

    /// The names of all frames: the base, those of the rows, and the others.
    pub fn frame_names(&self) -> Vec<String> {
        let rows = (0..self.rows.len()).map(|j| self.frame_name(j));
        [BASE.to_string()].into_iter().chain(rows).chain(self.frames.iter().map(|f| f.name.clone())).collect()
    }

    /// All rows as if they were a table: for what is said of parameters.
    pub fn all_rows(&self) -> Description {
        Description {
            name: self.name.clone(),
            source: self.source.clone(),
            convention: Convention::Khalil,
            parameters: self.parameters.clone(),
            rows: self.rows.clone(),
            base: self.base,
            tool: self.frames.first().map_or(Transform::identity(), |f| f.pose),
            poses: self.poses.clone(),
            gravity: self.gravity,
        }
    }

    /// True if every row stands on the one above, and nothing beside.
    pub fn is_chain(&self) -> bool {
        self.frames.is_empty() && self.after.iter().enumerate().all(|(j, a)| *a == j.checked_sub(1))
    }

    /// The rows of a table as a tree; `after` names the row that each stands on.
    pub(in crate::description) fn of_rows(d: Description, after: Vec<Option<usize>>) -> Self {
        RowTree {
            name: d.name,
            source: d.source,
            parameters: d.parameters,
            rows: d.rows,
            after,
            base: d.base,
            frames: vec![],
            tip: None,
            poses: d.poses,
            gravity: d.gravity,
        }
    }

    /// A chain as a tree without branches.
    pub fn of_chain(d: &Description) -> Self {
        let khalil = d.converted(Convention::Khalil).description;
        let last = khalil.rows.len().checked_sub(1);
        let tool = NamedFrame { name: "tool".into(), on: last, pose: khalil.tool };
        RowTree {
            after: (0..khalil.rows.len()).map(|j| j.checked_sub(1)).collect(),
            frames: [tool].into_iter().filter(|f| f.pose != Transform::identity()).collect(),
            tip: None,
            poses: khalil.poses,
            name: khalil.name,
            source: khalil.source,
            parameters: khalil.parameters,
            rows: khalil.rows,
            base: khalil.base,
            gravity: khalil.gravity,
        }
    }

    /// The joint variables, q1 first.
    pub(super) fn variables(&self) -> Vec<Symbol> {
        self.rows.iter().filter_map(|r| r.variable).map(|v| v.symbol).collect()
    }

    /// The motions of a row: what kind, by which variable, with which factor; its own first.
    pub(super) fn motions(&self, row: &Row) -> Vec<(JointKind, usize, Rational)> {
        let variables = self.variables();
        let mut all = vec![];
        for (kind, e) in [(JointKind::Revolute, row.theta), (JointKind::Prismatic, row.d)] {
            for (term, factor) in Angle::of(e).terms {
                if let Some(v) = term.as_symbol().and_then(|s| variables.iter().position(|x| *x == s)) {
                    all.push((kind, v, factor));
                }
            }
        }
        let own = row.variable.map(|v| v.symbol);
        all.sort_by_key(|m| Some(variables[m.1]) != own);
        all
    }

    /// The tree as bodies and joints, with the values of its parameters. A row that several variables move is several joints on one
    /// axis.
    ///
    /// # Errors
    /// If a parameter has no value.
    pub fn mechanism(&self) -> Result<Mechanism, MissingValue> {
        Mechanism::of_rows(self)
    }
}
