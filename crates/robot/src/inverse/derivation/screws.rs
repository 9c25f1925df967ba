//! A chain as its moving axes with the constants before them, and what is done to it before its normal form is built.

use super::chain::Unsuitable;
use super::drivers::Drivers;
use crate::description::{Description, JointKind};
use crate::geometry::{Transform, Vector};
use crate::mechanism::{Affine, Lengths, Link, MovingAxes, MovingAxis, Robot};
use denavit_symbolic::{Expr, Rational, Symbol, readable};

/// An axis with what stands before it, while the chain is built.
pub(super) struct Screw {
    pub before: Transform<Expr>,
    pub form: Affine<Expr>,
    pub kind: JointKind,
    pub row: usize,
}

/// The moving axes with the constants before each, and what stands behind the last.
pub(super) fn screws(robot: &Robot<Expr>) -> Result<(Vec<Screw>, Transform<Expr>), Unsuitable> {
    let turns_by = |l: &Link<Expr>, j: usize| l.theta.terms.iter().any(|t| t.0 == j);
    if let Some(row) = robot.links.iter().position(|l| l.d.terms.iter().any(|t| turns_by(l, t.0))) {
        return Err(Unsuitable::Helical(row + 1));
    }
    let MovingAxes { moving, mut constants } = MovingAxes::new(robot, Lengths::Behind);
    // Quarter turns of an angle and offsets of a displacement are constants.
    for (k, axis) in moving.iter().enumerate() {
        if axis.kind == JointKind::Prismatic {
            constants[k + 1] = axis.at_rest() * constants[k + 1];
        } else {
            let quarters = Rational::new(i64::from(axis.value.quarters), 2);
            constants[k] = constants[k] * Transform::rotation_z(Expr::from(quarters) * Expr::pi());
        }
    }
    let tail = constants.pop().unwrap_or_else(Transform::identity);
    let screw = |(axis, before): (MovingAxis<Expr>, Transform<Expr>)| {
        let mut form = Affine { quarters: 0, ..axis.value };
        if axis.kind == JointKind::Prismatic {
            form.offset = Expr::int(0);
        }
        Screw { before, form, kind: axis.kind, row: axis.row }
    };
    Ok((moving.into_iter().zip(constants).map(screw).collect(), tail))
}

/// Brings constant displacements along axes that stay parallel to one place: those of the first axes into the base,
/// all others behind the last of them.
pub(super) fn gather(screws: &mut [Screw], tail: &mut Transform<Expr>, turning: &[bool]) {
    let n = screws.len();
    // The constant behind axis k.
    let behind = |screws: &[Screw], tail: &Transform<Expr>, k: usize| {
        if k + 1 < n { screws[k + 1].before } else { *tail }
    };
    let set = |screws: &mut [Screw], tail: &mut Transform<Expr>, k: usize, x: Transform<Expr>| {
        if k + 1 < n { screws[k + 1].before = x } else { *tail = x }
    };
    let parallel = |x: &Transform<Expr>| {
        let z = x.rotation.z();
        z[0].is_zero() && z[1].is_zero()
    };
    // How far the first axes stay parallel.
    let first = (1..n).find(|&k| !parallel(&screws[k].before)).unwrap_or(n);
    for k in (0..first).rev() {
        let x = behind(screws, tail, k);
        let along = x.translation[2];
        if along.is_zero() || oblique(&x) {
            continue;
        }
        let [a, b, _] = x.translation.0;
        let rest = Transform::from_rotation_translation(x.rotation, Vector([a, b, Expr::int(0)]));
        set(screws, tail, k, rest);
        let before = screws[k].before;
        screws[k].before = (before * Transform::translation_z(along)).map(readable::settled);
    }
    for k in first.max(1)..n {
        // Along the axis that follows the constant before axis k.
        let x = screws[k].before;
        let along = readable::settled(x.rotation.z().dot(x.translation));
        if along.is_zero() || oblique(&x) || !turning[k] {
            continue;
        }
        let z = x.rotation.z();
        let rest = x.translation - z.scale(along);
        screws[k].before = Transform::from_rotation_translation(x.rotation, rest).map(readable::settled);
        let after = behind(screws, tail, k);
        set(screws, tail, k, (Transform::translation_z(along) * after).map(readable::settled));
    }
}

/// True if the axes before and behind a constant are neither parallel nor at a right angle.
fn oblique(x: &Transform<Expr>) -> bool {
    let z = x.rotation.z();
    !(z[2].is_zero() || z[0].is_zero() && z[1].is_zero())
}

/// Which axes drive.
pub(super) fn drivers(screws: &[Screw], turning: &[bool], n: usize) -> Option<Drivers> {
    let row = |s: &Screw| -> Option<Vec<Rational>> {
        let mut row = vec![Rational::ZERO; n];
        for &(j, factor) in &s.form.terms {
            row[j] = &row[j] + &factor.as_number()?;
        }
        Some(row)
    };
    Drivers::of(&screws.iter().map(row).collect::<Option<Vec<_>>>()?, turning, n)
}

/// Axes that follow others do so exactly from here on: a constant that is left stands behind them.
pub(super) fn follow(screws: &mut [Screw], tail: Transform<Expr>, drivers: &Drivers) -> Transform<Expr> {
    let mut tail = tail;
    for k in (0..screws.len()).filter(|&k| !drivers.drives(k)) {
        let factors = drivers.axes.iter().zip(&drivers.factors[k]).filter(|(_, x)| !x.is_zero());
        let offset =
            factors.fold(Expr::int(0), |sum, (&d, x)| sum + Expr::from(x.clone()) * screws[d].form.offset);
        let left = readable::settled(screws[k].form.offset - offset);
        screws[k].form.offset = offset;
        if left.is_zero() {
            continue;
        }
        let behind = match screws[k].kind {
            JointKind::Revolute => Transform::rotation_z(left),
            JointKind::Prismatic => Transform::translation_z(left),
        };
        match screws.get_mut(k + 1) {
            Some(next) => next.before = behind * next.before,
            None => tail = behind * tail,
        }
    }
    tail
}

/// The description with the values of its angles, and of what is zero, put in.
pub fn settled(description: &Description) -> Description {
    let mut d = description.clone();
    let mut angles: Vec<Symbol> = vec![];
    for row in &d.rows {
        angles.extend(row.alpha.symbols());
        angles.extend(row.gamma.symbols());
        angles.extend(row.theta.symbols());
    }
    let rotations = [d.base, d.tool];
    for x in &rotations {
        x.rotation.rows().iter().flatten().for_each(|e| angles.extend(e.symbols()));
    }
    let known: Vec<(Symbol, Expr)> = d
        .parameters
        .iter()
        .filter_map(|p| Some((p.symbol, p.value?)))
        .filter(|(s, v)| angles.contains(s) || readable::settled(*v).is_zero())
        .collect();
    if known.is_empty() {
        return d;
    }
    let put = |e: Expr| e.substitute(|s| known.iter().find(|k| k.0 == s).map(|k| k.1));
    for row in &mut d.rows {
        row.theta = put(row.theta);
        row.d = put(row.d);
        row.a = put(row.a);
        row.alpha = put(row.alpha);
        row.gamma = put(row.gamma);
        row.b = put(row.b);
    }
    d.base = d.base.map(put);
    d.tool = d.tool.map(put);
    d.parameters.retain(|p| !known.iter().any(|k| k.0 == p.symbol));
    d
}
