//! The proof that two chains are one: the same axes at rest, moved by the same forms of the joint variables in the same order, and
//! the same tip at rest. It implies `∏ exp(ξₖ fₖ(q)) · M` on both sides; no sine of a joint is ever expanded.

use super::space::{Frame, V, cross, minus};
use super::{AxisAtRest, ChainAtRest, Draft, NotPlaced};
use crate::description::{Description, JointKind, Screw};
use crate::geometry::{Axis, Rotation, Transform};
use denavit_symbolic::real::{Real, Values};
use denavit_symbolic::{Angle, Expr, Rational, Ring, Symbol};

/// How two chains were found to be one.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Agreement {
    /// Exactly.
    Proved,
    /// Axes and tip at rest differ by at most this (their directions, and metres): numbers of more than 60 digits were compared.
    Within(f64),
}

/// What rounded numbers can differ by and be the same.
const ROUNDING: f64 = 1e-60;

/// What moves a row, and where its axis is at rest.
struct Screwed {
    kind: JointKind,
    form: Vec<(Expr, Rational)>,
    frame: Transform<Expr>,
}

/// Axes and tip of a description at rest.
struct Rest {
    screws: Vec<Screwed>,
    tip: Transform<Expr>,
}

impl Rest {
    fn of(d: &Description) -> Self {
        let variables: Vec<Symbol> = d.variables().iter().map(|v| v.symbol).collect();
        let still = |e: Expr| e.substitute(|s| variables.contains(&s).then(|| Expr::int(0)));
        let form = |e: Expr| {
            let moves = |t: &(Expr, Rational)| t.0.as_symbol().is_some_and(|s| variables.contains(&s));
            Angle::of(e).terms.into_iter().filter(moves).collect::<Vec<_>>()
        };
        let (mut x, mut screws) = (d.base, vec![]);
        for screw in d.rows.iter().flat_map(|r| r.screws(d.convention)) {
            if screw.axis == Axis::Z {
                for (kind, e) in [(JointKind::Revolute, screw.angle), (JointKind::Prismatic, screw.length)] {
                    let form = form(e);
                    if !form.is_empty() {
                        screws.push(Screwed { kind, form, frame: x });
                    }
                }
            }
            x = x * Screw { angle: still(screw.angle), length: still(screw.length), ..screw }.transform();
        }
        Rest { screws, tip: x * d.tool }
    }
}

impl Description {
    /// Its axes and its tip at rest, with the values of its parameters.
    pub fn at_rest(&self) -> ChainAtRest {
        let value = |s: Symbol| self.exact_value(s);
        let number = |e: Expr| e.substitute(value);
        let rest = Rest::of(self);
        let variables = self.variables();
        let index = |e: Expr| variables.iter().position(|v| e.as_symbol() == Some(v.symbol)).unwrap_or(0);
        let axis = |s: &Screwed| AxisAtRest {
            kind: s.kind,
            point: s.frame.translation.map(number),
            direction: s.frame.rotation.z().map(number),
            moves: s.form.iter().map(|(e, k)| (index(*e), k.clone())).collect(),
        };
        let beside = rest.screws.first().map_or(Rotation::identity(), |s| s.frame.rotation.map(number));
        ChainAtRest { axes: rest.screws.iter().map(axis).collect(), tip: rest.tip.map(number), beside }
    }
}

/// True if two descriptions are proved to be one function of the joint variables, by their axes and their tip at rest; no answer
/// means nothing: one mechanism can be more than one sequence of axes.
pub fn same_screws(a: &Description, b: &Description) -> bool {
    let (a, b) = (Rest::of(a), Rest::of(b));
    let moves = |r: &Rest| r.screws.iter().map(|s| (s.kind, s.form.clone())).collect::<Vec<_>>();
    if moves(&a) != moves(&b) {
        return false;
    }
    let mut zero: Vec<Expr> = vec![];
    for (a, b) in a.screws.iter().zip(&b.screws) {
        let (za, zb) = (a.frame.rotation.z(), b.frame.rotation.z());
        zero.extend((za - zb).0);
        if a.kind == JointKind::Revolute {
            zero.extend((a.frame.translation - b.frame.translation).cross(zb).0);
        }
    }
    let (m, n) = (a.tip.matrix(), b.tip.matrix());
    zero.extend((0..12).map(|k| m[k / 4][k % 4] - n[k / 4][k % 4]));
    are_zero(&zero)
}

/// True if all are proved to be 0.
fn are_zero(all: &[Expr]) -> bool {
    let mut values = Values::default();
    let mut open: Vec<Expr> = vec![];
    for &e in all.iter().filter(|e| !e.is_zero()) {
        match values.of(e) {
            Some(x) if x.is_exact() && x.is_zero() => {}
            Some(x) if !x.is_zero() => return false,
            _ => open.push(e),
        }
    }
    let mut ring = Ring::new(&open, &[]);
    open.iter().all(|&e| ring.normal(e).is_ok_and(|form| form.num.is_zero()))
}

/// How the axes of a chain are those of a description.
pub(super) fn agreement(chain: &ChainAtRest, d: &Description) -> Result<Agreement, NotPlaced> {
    let mut values = Values::default();
    let lines = chain.lines(&mut values)?;
    let rest = Rest::of(d);
    let (mut worst, mut is_exact) = (0.0_f64, rest.screws.len() == lines.len());
    let mut hold = |differences: &[Real]| {
        for x in differences {
            is_exact &= x.is_exact();
            worst = worst.max(x.to_f64().abs());
        }
    };
    for (screw, line) in rest.screws.iter().zip(&lines) {
        let frame = Frame::of(&screw.frame, &mut values).ok_or(NotPlaced::Symbols)?;
        hold(&minus(&frame.z, &line.direction));
        if let (JointKind::Revolute, Some(point)) = (line.kind, &line.point) {
            hold(&cross(&minus(&frame.origin, point), &line.direction));
        }
    }
    let tips = [&rest.tip, &chain.tip].map(|tip| Frame::of(tip, &mut values));
    let [Some(a), Some(b)] = tips else { return Err(NotPlaced::Symbols) };
    let pairs: [(&V, &V); 3] = [(&a.x, &b.x), (&a.z, &b.z), (&a.origin, &b.origin)];
    pairs.iter().for_each(|(a, b)| hold(&minus(a, b)));
    if rest.screws.len() != lines.len() {
        worst = f64::INFINITY;
    }
    Ok(if is_exact && worst == 0.0 { Agreement::Proved } else { Agreement::Within(worst.max(ROUNDING)) })
}

/// The frame behind all rows at rest, as they are written.
pub(super) fn end_of(start: &Frame, drafts: &[Draft], values: &mut Values) -> Option<Frame> {
    let mut x = start.settled();
    for d in drafts {
        x = x
            * Transform::rotation_z(d.theta)
            * Transform::translation(d.a, Expr::int(0), d.d)
            * Transform::rotation_x(d.alpha);
    }
    Frame::of(&x, values)
}
