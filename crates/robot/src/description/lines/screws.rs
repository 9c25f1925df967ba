//! The proof that two chains are one: the same axes at rest, moved by the same forms of the joint variables in the same order, and
//! the same tip at rest. It implies `∏ exp(ξₖ fₖ(q)) · M` on both sides; no sine of a joint is ever expanded.

use super::space::{Frame, V, cross, minus};
use super::{AxisAtRest, ChainAtRest, Draft, NotPlaced};
use crate::description::{Description, JointKind, Screw};
use crate::geometry::{Axis, Rotation, Transform, Vector};
use denavit_symbolic::real::{Real, Values};
use denavit_symbolic::{Angle, Expr, Rational, Ring, Symbol};
use std::collections::HashSet;

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
        let form = form_of(&variables);
        let (mut walk, mut screws) = (Walk::from(d.base), vec![]);
        for screw in d.rows.iter().flat_map(|r| r.screws(d.convention)) {
            for (kind, form) in motions(&screw, &form) {
                screws.push(Screwed { kind, form, frame: walk.frame() });
            }
            walk.go(&Screw { angle: still(screw.angle), length: still(screw.length), ..screw });
        }
        Rest { screws, tip: walk.frame() * d.tool }
    }

    /// The frames of the axes seen from the tip, in the same order; the tip is where the base is seen.
    fn from_tip(d: &Description) -> Self {
        let variables: Vec<Symbol> = d.variables().iter().map(|v| v.symbol).collect();
        let back = |e: Expr| -e.substitute(|s| variables.contains(&s).then(|| Expr::int(0)));
        let form = form_of(&variables);
        let (mut walk, mut screws) = (Walk::from(d.tool.inverse()), vec![]);
        let all: Vec<Screw> = d.rows.iter().flat_map(|r| r.screws(d.convention)).collect();
        for screw in all.iter().rev() {
            walk.go(&Screw { angle: back(screw.angle), length: back(screw.length), ..*screw });
            for (kind, form) in motions(screw, &form).into_iter().rev() {
                screws.push(Screwed { kind, form, frame: walk.frame() });
            }
        }
        screws.reverse();
        Rest { screws, tip: walk.frame() * d.base.inverse() }
    }
}

/// The joint variables of a cell with their factors.
fn form_of(variables: &[Symbol]) -> impl Fn(Expr) -> Vec<(Expr, Rational)> {
    move |e| {
        let moves = |t: &(Expr, Rational)| t.0.as_symbol().is_some_and(|s| variables.contains(&s));
        Angle::of(e).terms.into_iter().filter(moves).collect()
    }
}

/// What joint variables do to a screw about z: it turns, or slides.
fn motions(
    screw: &Screw,
    form: &impl Fn(Expr) -> Vec<(Expr, Rational)>,
) -> Vec<(JointKind, Vec<(Expr, Rational)>)> {
    if screw.axis != Axis::Z {
        return vec![];
    }
    let both = [(JointKind::Revolute, screw.angle), (JointKind::Prismatic, screw.length)];
    both.into_iter().map(|(kind, e)| (kind, form(e))).filter(|m| !m.1.is_empty()).collect()
}

/// A frame that goes along constant screws. Turns about one axis behind each other are one turn, so that their sines stay short.
struct Walk {
    place: Vector<Expr>,
    /// Turns, and the rotation behind each; the first is where it began.
    turns: Vec<(Axis, Expr, Rotation<Expr>)>,
    start: Rotation<Expr>,
}

impl Walk {
    fn from(x: Transform<Expr>) -> Self {
        Walk { place: x.translation, turns: vec![], start: x.rotation }
    }

    fn rotation(&self) -> Rotation<Expr> {
        self.turns.last().map_or(self.start, |t| t.2)
    }

    fn frame(&self) -> Transform<Expr> {
        Transform::from_rotation_translation(self.rotation(), self.place)
    }

    fn go(&mut self, screw: &Screw) {
        if !screw.length.is_zero() {
            self.place = self.place + self.rotation().column(screw.axis).scale(screw.length);
        }
        let mut angle = screw.angle;
        if let Some((_, before, _)) = self.turns.pop_if(|t| t.0 == screw.axis) {
            angle = Angle::of(before + angle).to_expr();
        }
        if !angle.is_zero() {
            let rotation = self.rotation() * Rotation::about(screw.axis, angle);
            self.turns.push((screw.axis, angle, rotation));
        }
    }
}

impl Description {
    /// Its axes and its tip at rest, with the values of its parameters.
    pub fn at_rest(&self) -> ChainAtRest {
        self.at_rest_with(|s| self.exact_value(s))
    }

    /// Its axes and its tip at rest, with names for its parameters.
    pub fn axes_with_names(&self) -> ChainAtRest {
        self.at_rest_with(|_| None)
    }

    /// Points and directions of its axes seen from the tip at rest, with names for its parameters.
    pub(in crate::description) fn axes_from_tip(&self) -> Vec<[Vector<Expr>; 2]> {
        let screws = Rest::from_tip(self).screws;
        screws.iter().map(|s| [s.frame.translation, s.frame.rotation.z()]).collect()
    }

    fn at_rest_with(&self, value: impl Fn(Symbol) -> Option<Expr>) -> ChainAtRest {
        let number = |e: Expr| e.substitute(&value);
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
    compare_screws(a, b) == Some(true)
}

/// True if two descriptions are proved to be one function of the joint variables, by their axes and their tip at rest, false if they
/// are proved to be two: where each variable moves one axis, what changes with it at rest is that axis.
pub fn compare_screws(a: &Description, b: &Description) -> Option<bool> {
    let (a, b) = (Rest::of(a), Rest::of(b));
    let moves = |r: &Rest| r.screws.iter().map(|s| (s.kind, s.form.clone())).collect::<Vec<_>>();
    if moves(&a) != moves(&b) {
        return None;
    }
    let mut moved: HashSet<Expr> = HashSet::new();
    let is_one_each = a.screws.iter().all(|s| s.form.len() == 1 && moved.insert(s.form[0].0));
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
    are_zero(&zero).filter(|is_same| *is_same || is_one_each)
}

/// True if a description is proved to be a chain whose points may hold names, as polynomials in them; the directions are numbers.
pub(super) fn is_chain(chain: &ChainAtRest, d: &Description) -> bool {
    let (rest, variables) = (Rest::of(d), d.variables());
    if rest.screws.len() != chain.axes.len() {
        return false;
    }
    let mut zero: Vec<Expr> = vec![];
    for (screw, axis) in rest.screws.iter().zip(&chain.axes) {
        let moves = |(v, k): &(usize, Rational)| Some((Expr::from(variables.get(*v)?.symbol), k.clone()));
        let moves: Option<Vec<(Expr, Rational)>> = axis.moves.iter().map(moves).collect();
        let mut form = screw.form.clone();
        let is_same_form = moves.is_some_and(|moves| {
            form.retain(|term| !moves.contains(term));
            form.is_empty() && moves.len() == screw.form.len()
        });
        // z and the direction point the same way.
        let z = screw.frame.rotation.z();
        let along = z.dot(axis.direction).eval(|_| None);
        if screw.kind != axis.kind || !is_same_form || !along.is_ok_and(|x| x > 0.0) {
            return false;
        }
        zero.extend(z.cross(axis.direction).0);
        if axis.kind == JointKind::Revolute {
            zero.extend((screw.frame.translation - axis.point).cross(axis.direction).0);
        }
    }
    let (m, n) = (rest.tip.matrix(), chain.tip.matrix());
    zero.extend((0..12).map(|k| m[k / 4][k % 4] - n[k / 4][k % 4]));
    are_zero(&zero) == Some(true)
}

/// True if all are proved to be 0, false if one is a number that is not.
fn are_zero(all: &[Expr]) -> Option<bool> {
    let mut values = Values::default();
    let mut open: Vec<Expr> = vec![];
    for &e in all.iter().filter(|e| !e.is_zero()) {
        match values.of(e) {
            Some(x) if x.is_exact() && x.is_zero() => {}
            Some(x) if !x.is_zero() => return Some(false),
            _ => open.push(e),
        }
    }
    let mut ring = Ring::new(&open, &[]);
    open.iter().all(|&e| ring.normal(e).is_ok_and(|form| form.num.is_zero())).then_some(true)
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
