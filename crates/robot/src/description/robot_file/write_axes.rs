//! A description as its axes at rest, or as a product of exponentials, that reads back to the same robot.

use super::axes::Given;
use super::write::{cell, list, quoted, write_frame, write_head, write_poses};
use crate::description::cell::write_cell;
use crate::description::lines::{AxisAtRest, ChainAtRest};
use crate::description::units::Quantity;
use crate::description::{Description, JointKind, MissingValue, Row};
use crate::geometry::{Transform, Vector};
use denavit_symbolic::real::Values;
use denavit_symbolic::{Angle, Expr, Rational, Symbol};
use std::fmt::Write;

/// How axes are written.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum AxesAs {
    /// A point and a direction each, in the base.
    Lines,
    /// Screws (ω, v) in the base: the product of exponentials.
    Screws,
    /// Screws in the tip at rest: the product of exponentials behind M.
    BodyScrews,
}

/// The robot file of a description by its axes at rest. Names of lengths stay; a name on which a direction depends is written by its
/// value. Masses and the convention's own frames have no place in it.
///
/// # Errors
/// If a direction depends on a parameter without value.
pub fn write_axes(d: &Description, written: AxesAs) -> Result<String, MissingValue> {
    let d = &with_numbers_for_directions(d)?;
    let chain = d.axes_with_names();
    let given = match written {
        AxesAs::Lines => Given::Axes,
        AxesAs::Screws => Given::Screws,
        AxesAs::BodyScrews => Given::BodyScrews,
    };
    let mut out = String::new();
    write_head(&mut out, d);
    let lines: Vec<[Vector<Expr>; 2]> = match written {
        AxesAs::BodyScrews => d.axes_from_tip(),
        AxesAs::Lines | AxesAs::Screws => chain.axes.iter().map(|a| [a.point, a.direction]).collect(),
    };
    let rows = moving_rows(d);
    let mut known = 0;
    for ((axis, row), line) in chain.axes.iter().zip(rows).zip(lines) {
        let [point, direction] = line.map(|v| v.map(settled));
        let _ = writeln!(out, "\n[[{}]]", given.key());
        if let Some(name) = &row.name {
            let _ = writeln!(out, "name = {}", quoted(name));
        }
        write_axis(&mut out, axis.kind, point, direction, written);
        write_moves(&mut out, axis, &mut known);
        super::write::write_limits(&mut out, row);
    }
    if chain.tip != Transform::identity() {
        out.push_str("\n[tip]\n");
        write_frame(&mut out, &settled_frame(&chain));
    }
    write_poses(&mut out, d);
    Ok(out)
}

fn write_axis(out: &mut String, kind: JointKind, p: Vector<Expr>, z: Vector<Expr>, written: AxesAs) {
    let zero = [Expr::int(0); 3];
    let number = direction(&z.0);
    let _ = match (written, kind) {
        (AxesAs::Lines, JointKind::Revolute) => {
            writeln!(out, "point = {}\ndirection = {number}", list(&p.0, Quantity::Length))
        }
        (AxesAs::Lines, JointKind::Prismatic) => {
            writeln!(out, "kind = \"prismatic\"\ndirection = {number}")
        }
        (_, JointKind::Revolute) => {
            let v = p.cross(z).map(settled); // −ω × p
            writeln!(out, "omega = {number}\nv = {}", list(&v.0, Quantity::Length))
        }
        (_, JointKind::Prismatic) => writeln!(out, "omega = {}\nv = {number}", direction(&zero)),
    };
}

/// Three numbers, whole ones without quotes.
fn direction(z: &[Expr; 3]) -> String {
    let one = |e: &Expr| match e.as_number().filter(Rational::is_integer) {
        Some(n) => n.to_string(),
        None => cell(*e, Quantity::Number),
    };
    format!("[{}]", z.iter().map(one).collect::<Vec<_>>().join(", "))
}

/// The variables that move an axis, unless it is the next alone.
fn write_moves(out: &mut String, axis: &AxisAtRest, known: &mut usize) {
    let is_plain = axis.moves == [(*known, Rational::ONE)];
    let sum = axis
        .moves
        .iter()
        .fold(Expr::int(0), |sum, (v, k)| sum + Expr::from(k.clone()) * Expr::symbol(&format!("q{}", v + 1)));
    if !is_plain {
        let _ = writeln!(out, "moves = {}", cell(sum, Quantity::Number));
    }
    *known += usize::from(axis.moves.iter().any(|m| m.0 == *known));
}

/// The rows in which something moves, in the order of the axes.
fn moving_rows(d: &Description) -> Vec<&Row> {
    let symbols: Vec<Symbol> = d.variables().iter().map(|v| v.symbol).collect();
    let moves = |e: Expr| e.symbols().iter().any(|s| symbols.contains(s));
    d.rows.iter().flat_map(|r| [r.theta, r.d].into_iter().filter(|e| moves(*e)).map(move |_| r)).collect()
}

/// Formulas of numbers that are longer, in bytes, are written as decimals.
const LONG: usize = 200;

/// A sum Σ kᵢ·xᵢ + c with short factors; points are linear in lengths, since directions are numbers here.
fn settled(e: Expr) -> Expr {
    let zero = |_: Symbol| Some(Expr::int(0));
    let rest = e.substitute(zero);
    let terms = e.symbols().into_iter().map(|s| {
        let one = e.substitute(|t| Some(Expr::int(i64::from(t == s))));
        short(one - rest) * Expr::from(s)
    });
    let sum = terms.fold(short(rest), |sum, term| sum + term);
    Angle::of(sum).to_expr()
}

/// A number as short as it is.
fn short(e: Expr) -> Expr {
    let e = Angle::of(e).to_expr();
    let Some(x) = Values::default().of(e) else { return e };
    match x.to_expr() {
        Some(exact) => exact,
        None if is_long(e) => x.settled(),
        None => e,
    }
}

/// True for a formula whose text has more than [`LONG`] bytes; it is written only if it is no tree with more leaves, as a formula
/// that shares its parts can be a text of any length.
fn is_long(e: Expr) -> bool {
    let (mut open, mut leaves) = (vec![e], 0);
    while let Some(e) = open.pop() {
        let before = open.len();
        open.extend(e.children());
        leaves += usize::from(open.len() == before);
        if leaves > LONG || open.len() > LONG {
            return true;
        }
    }
    write_cell(e, Quantity::Number).len() > LONG
}

fn settled_frame(chain: &ChainAtRest) -> Transform<Expr> {
    chain.tip.map(settled)
}

/// The description with numbers for the parameters on which directions depend.
fn with_numbers_for_directions(d: &Description) -> Result<Description, MissingValue> {
    let chain = d.axes_with_names();
    let axes = chain.axes.iter().flat_map(|a| a.direction.0);
    let turned: Vec<Symbol> =
        axes.chain(chain.tip.rotation.rows().concat()).flat_map(Expr::symbols).collect();
    let without: Vec<Symbol> = turned.iter().copied().filter(|&s| d.exact_value(s).is_none()).collect();
    if !without.is_empty() {
        d.values(&without)?;
    }
    Ok(d.with_numbers_for(&turned))
}
