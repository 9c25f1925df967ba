//! A tree of rows as a `.par` file that reads back to it.
//!
//! θ of a joint that turns, and r of one that slides, are their variables alone, as SYMORO wants them: what is constant there goes to
//! γ and b of the rows behind, with which it commutes. Values of names stand in comments, `(* D3 = 0.45 *)`, which SYMORO skips.

use super::place::rows_of;
use super::{NamedFrame, RowTree};
use crate::description::cell::decimal;
use crate::description::decimals::{Found, places, recognise};
use crate::description::lines::{NotNamed, Turns};
use crate::description::{Convention, Description, JointKind, Parameter, Row};
use crate::geometry::Transform;
use denavit_symbolic::print::{Style, print};
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Angle, Expr, Rational, Symbol};
use std::fmt::Write;

/// Names, and the numbers that they have in a file.
type Numbers = Vec<(String, usize)>;

/// With so many places a decimal is a multiple of π/12 only if it is one up to rounding.
const PLACES: i64 = 40;

/// Why a tree has no `.par` file.
#[derive(Clone, PartialEq, Debug)]
pub enum NoPar {
    /// The row of this name follows other joints, for which the format has no words.
    Follows(String),
    /// A constant transform has names on which more than lengths depend, without values.
    NotNamed(NotNamed),
}

impl From<NotNamed> for NoPar {
    fn from(why: NotNamed) -> Self {
        NoPar::NotNamed(why)
    }
}

/// A `.par` file.
#[derive(Clone, Debug)]
pub struct ParFile {
    /// Its text.
    pub text: String,
    /// The frames with names, and rows on which nothing stands, and the number that each has in the file, from 1.
    pub frames: Vec<(String, usize)>,
    /// The number of the last frame of a tree without named frames.
    pub last: usize,
}

/// The `.par` file of a tree. Names of joints, limits and masses have no place in it.
///
/// # Errors
/// If a joint follows others.
pub fn write_par(tree: &RowTree) -> Result<ParFile, NoPar> {
    let (tree, frames) = with_plain_variables(tree)?;
    let n = tree.rows.len();
    let is_branched = tree.after.iter().enumerate().any(|(j, a)| *a != j.checked_sub(1));
    let counts = [n, n, n, usize::from(is_branched)];
    Ok(ParFile { text: columns(&tree, counts, |_| true), frames, last: n })
}

/// The text of a file: `NL`, `NJ`, `NF` and `Type`, then the rows, which have their variables alone in θ or r.
pub(in crate::description) fn columns(
    tree: &RowTree,
    [links, joints, frames, kind]: [usize; 4],
    is_driven: impl Fn(usize) -> bool,
) -> String {
    let n = tree.rows.len();
    let mut out = format!("(* Robotname = '{}' *)\n", tree.name.replace(['\'', '*', '\n'], " "));
    for p in tree.parameters.iter().filter_map(|p| Some((p.symbol, p.value?))) {
        let _ = writeln!(out, "(* {} = {} *)", p.0.name(), text(p.1, false));
    }
    let _ = writeln!(out, "NL = {links}\nNJ = {joints}\nNF = {frames}\nType = {kind}\n");
    out.push_str("(* Geometric parameters *)\n");
    let names: Vec<String> = (0..n).map(|j| variable_name(tree, j)).collect();
    let named = |e: Expr| {
        let name = |s: Symbol| {
            let j = tree.rows.iter().position(|r| r.variable.is_some_and(|v| v.symbol == s))?;
            Some(Expr::symbol(&names[j]))
        };
        e.substitute(name)
    };
    let mut column = |key: &str, of: &dyn Fn(usize) -> String| {
        let all: Vec<String> = (0..n).map(of).collect();
        let _ = writeln!(out, "{key} = {{{}}}", all.join(","));
    };
    let rows = &tree.rows;
    let kind = |j: usize| rows[j].variable.map(|v| v.kind);
    column("ant", &|j| tree.after[j].map_or(0, |a| a + 1).to_string());
    column("sigma", &|j| kind(j).map_or(2, |k| i32::from(k == JointKind::Prismatic)).to_string());
    column("b", &|j| text(rows[j].b, false));
    column("d", &|j| text(rows[j].a, false));
    column("r", &|j| text(named(rows[j].d), false));
    column("gamma", &|j| text(rows[j].gamma, true));
    column("alpha", &|j| text(rows[j].alpha, true));
    column("mu", &|j| i32::from(kind(j).is_some() && is_driven(j)).to_string());
    column("theta", &|j| text(named(rows[j].theta), true));
    if let Some(g) = &tree.gravity {
        let all: Vec<String> = g.iter().map(|e| text(*e, false)).collect();
        let _ = writeln!(out, "\n(* Acceleration of gravity *)\nG = {{{}}}", all.join(","));
    }
    if tree.base != Transform::identity() {
        let all: Vec<String> = tree.base.matrix().concat().iter().map(|e| text(*e, false)).collect();
        let _ = writeln!(out, "\n(* Frame 0 in the base *)\nZ = {{{}}}", all.join(","));
    }
    out.push_str("\n(* End of definition *)\n");
    out
}

/// `th3` or `r3`; `q3`, which no parameter is called, where that is taken.
fn variable_name(tree: &RowTree, j: usize) -> String {
    let slides = tree.rows[j].variable.is_some_and(|v| v.kind == JointKind::Prismatic);
    let usual = format!("{}{}", if slides { "r" } else { "th" }, j + 1);
    let is_taken = tree.parameters.iter().any(|p| *p.symbol.name() == *usual.as_str());
    if is_taken { format!("q{}", j + 1) } else { usual }
}

/// A value as SYMORO writes it.
fn text(e: Expr, is_angle: bool) -> String {
    let form = Angle::of(e);
    let names = Vocabulary::new();
    // SYMORO has no word for degrees.
    // And a name is what it is, whatever else it may mean in a formula.
    let print = |e: Expr| print(e, &names, Style::Ascii).replace(" deg", "*pi/180").replace('`', "");
    if !is_angle || form.radians.is_zero() {
        return match e.as_number() {
            Some(x) => decimal(&x),
            None => print(e),
        };
    }
    let mut number = decimal(&form.radians);
    // Decimals that look like a multiple of π/12 get the digits by which they are none.
    let is_multiple = |places: i64| matches!(recognise(&form.radians, places), Found::Multiple(_));
    while !is_multiple(PLACES) && is_multiple(places(&number)) {
        number += if number.contains('.') { "0" } else { ".0" };
    }
    let rest = Angle { radians: Rational::ZERO, ..form.clone() }.to_expr();
    match (rest.is_zero(), number.strip_prefix('-')) {
        (true, _) => number,
        (false, Some(size)) => format!("{} - {size}", print(rest)),
        (false, None) => format!("{} + {number}", print(rest)),
    }
}

/// The tree with variables alone in θ and r, and its frames and its base as rows.
pub(in crate::description) fn with_plain_variables(tree: &RowTree) -> Result<(RowTree, Numbers), NoPar> {
    let original = tree;
    let (mut tree, mut frames, moved) = with_frames_as_rows(tree)?;
    let mut ends: Vec<(usize, usize)> = vec![];
    for j in 0..tree.rows.len() {
        if !tree.motions(&tree.rows[j]).is_empty() && tree.rows[j].variable.is_none()
            || tree.motions(&tree.rows[j]).len() > 1
        {
            return Err(NoPar::Follows(tree.frame_name(j)));
        }
    }
    let variables = tree.variables();
    let mut j = 0;
    while j < tree.rows.len() {
        let Some(variable) = tree.rows[j].variable else {
            j += 1;
            continue;
        };
        let still = |e: Expr| e.substitute(|s| variables.contains(&s).then(|| Expr::int(0)));
        let row = &mut tree.rows[j];
        let (angle, length) = match variable.kind {
            JointKind::Revolute => (Angle::of(still(row.theta)).to_expr(), Expr::int(0)),
            JointKind::Prismatic => (Expr::int(0), Angle::of(still(row.d)).to_expr()),
        };
        if !angle.is_zero() || !length.is_zero() {
            row.theta = Angle::of(row.theta - angle).to_expr();
            row.d = Angle::of(row.d - length).to_expr();
            let behind: Vec<usize> = (0..tree.rows.len()).filter(|&k| tree.after[k] == Some(j)).collect();
            for &k in &behind {
                let row = &mut tree.rows[k];
                row.gamma = Angle::of(row.gamma + angle).to_expr();
                row.b = Angle::of(row.b + length).to_expr();
            }
            if behind.is_empty() {
                tree.rows.push(Row { theta: angle, d: length, ..Row::still() });
                tree.after.push(Some(j));
                ends.push((j, tree.rows.len() - 1));
            }
        }
        j += 1;
    }
    for (k, &row) in moved.iter().enumerate() {
        let is_end = !original.after.contains(&Some(k)) && original.frames.iter().all(|f| f.on != Some(k));
        let end = ends.iter().find(|e| e.0 == row).map_or(row, |e| e.1);
        if is_end {
            frames.push((original.frame_name(k), end + 1));
        }
    }
    Ok((tree, frames))
}

/// The tree with its base in the rows that stand on it, and its frames as rows behind the others; the numbers of the frames, and where
/// its rows went.
pub(in crate::description) fn with_frames_as_rows(
    tree: &RowTree,
) -> Result<(RowTree, Numbers, Vec<usize>), NotNamed> {
    let mut all =
        RowTree { rows: vec![], after: vec![], frames: vec![], base: Transform::identity(), ..tree.clone() };
    let mut moved: Vec<usize> = vec![];
    let add = |all: &mut RowTree, rows: Vec<Row>, on: Option<usize>| {
        let mut on = on;
        for row in rows {
            all.rows.push(row);
            all.after.push(on);
            on = Some(all.rows.len() - 1);
        }
        on
    };
    for (row, after) in tree.rows.iter().zip(&tree.after) {
        let rows = match after {
            None if tree.base != Transform::identity() => on_base(tree, row)?,
            _ => vec![row.clone()],
        };
        let last = add(&mut all, rows, after.map(|a| moved[a]));
        moved.push(last.unwrap_or_default());
    }
    let mut frames = vec![];
    for NamedFrame { name, on, pose } in &tree.frames {
        let before = if on.is_none() { tree.base } else { Transform::identity() };
        let rows = fixed_rows(&(before * *pose), &tree.parameters)?;
        add(&mut all, rows, on.map(|a| moved[a]));
        if let Some(row) = all.rows.last_mut() {
            row.name = Some(name.clone());
        }
        frames.push((name.clone(), all.rows.len()));
    }
    Ok((all, frames, moved))
}

/// A row behind the base as rows behind nothing.
fn on_base(tree: &RowTree, row: &Row) -> Result<Vec<Row>, NotNamed> {
    let before = row.screws(Convention::Khalil).before;
    let before = before.iter().fold(tree.base, |x, s| x * s.transform());
    let mut rows = fixed_rows(&before, &tree.parameters)?;
    let none = Row { theta: Expr::int(0), d: Expr::int(0), ..Row::still() };
    let end = rows.pop().unwrap_or(none);
    let sum = |a: Expr, b: Expr| Angle::of(a + b).to_expr();
    rows.push(Row {
        gamma: end.gamma,
        b: end.b,
        alpha: end.alpha,
        a: end.a,
        theta: sum(row.theta, end.theta),
        d: sum(row.d, end.d),
        ..row.clone()
    });
    Ok(rows)
}

/// A constant transform as rows: one, or two where the axes are nearly parallel.
pub(in crate::description) fn fixed_rows(
    x: &Transform<Expr>,
    parameters: &[Parameter],
) -> Result<Vec<Row>, NotNamed> {
    let turns = Turns::of(x, parameters)?;
    Ok(rows_of(&turns))
}

impl Description {
    /// The robot as a tree of rows in Khalil's convention, its tool a frame with a name.
    pub fn as_tree(&self) -> RowTree {
        RowTree::of_chain(self)
    }
}
