//! The arm as the generator reads it: constants of the chain as values of the graph, and names for the links' numbers.

use super::choices::{Choices, Form, Gauge};
use crate::description::{Description, JointKind};
use crate::dynamics::grouping::Grouped;
use crate::dynamics::model::{Dynamics, Formulas};
use crate::geometry::{Body, Rotation, Transform, Vector};
use crate::mechanism::{Affine, Lengths, MovingAxes, Robot};
use denavit_program::{Graph, Value};
use denavit_symbolic::{Angle, Expr, Rational, Symbol};
use rustc_hash::FxHashMap;

/// Three components.
pub(super) type V3 = [Value; 3];

/// An axis.
pub(super) struct Axis {
    pub kind: JointKind,
    /// The constant turn before it, row by row.
    pub turn: [V3; 3],
    /// The constant displacement before it, without the length along a revolute axis.
    pub across: V3,
    /// That length, 0 for a slide.
    pub along: Value,
    /// Its displacement, 0 for a turn.
    pub slide: Value,
    pub rate: Value,
    pub change: Value,
    /// Where its group begins.
    pub first: usize,
}

/// The arm.
pub(super) struct Arm {
    pub axes: Vec<Axis>,
    /// The acceleration of the base less gravity.
    pub base: V3,
    angles: Vec<(Expr, u8)>,
    known: FxHashMap<(usize, usize), Option<(Value, Value)>>,
    /// The names of links' numbers, by their letters.
    numbers: FxHashMap<(&'static str, usize), Expr>,
    /// The masses that slides keep: names along x, y and z, and of the first moment; none where nothing is kept.
    pub slides: Vec<Option<[Option<Symbol>; 6]>>,
}

/// The length that is 1: a symbol or a number; none where lengths stay what they are.
#[derive(Clone, Copy)]
pub(super) struct Unit(pub Option<Expr>);

impl Unit {
    /// One over the unit.
    pub fn inverse(self, graph: &mut Graph) -> Option<Value> {
        let unit = graph.trace(self.0?);
        let one = graph.number(&Rational::ONE);
        Some(graph.div(one, unit))
    }

    /// A sum of lengths, or of what is proportional to lengths.
    pub fn scaled(self, e: Expr, graph: &mut Graph) -> Value {
        let Some(inverse) = self.inverse(graph) else { return graph.trace(e) };
        let sum = Angle::of(e);
        let rest = Expr::from(sum.turns) * Expr::pi() + Expr::from(sum.radians);
        let rest = graph.trace(rest);
        let mut all = graph.mul(rest, inverse);
        for (term, k) in sum.terms {
            let k = graph.number(&k);
            let part = if Some(term) == self.0 {
                k
            } else {
                let term = graph.trace(term);
                let term = graph.mul(term, inverse);
                graph.mul(k, term)
            };
            all = graph.add(all, part);
        }
        all
    }

    /// A value times a power of the unit.
    pub fn raised(self, value: Value, power: i32, graph: &mut Graph) -> Value {
        let Some(unit) = self.0.map(|unit| graph.trace(unit)) else { return value };
        (0..power).fold(value, |value, _| graph.mul(value, unit))
    }
}

/// The letters of a link's numbers in the one form and in the other.
const SECOND: [&str; 5] = ["SXX", "SYY", "SXY", "SXZ", "SYZ"];
const TENSOR: [&str; 6] = ["XX", "YY", "XY", "XZ", "YZ", "ZZ"];

/// The name of a number of a link, from 0.
fn name(letters: &str, link: usize) -> Symbol {
    // Not to be mistaken for a base parameter.
    Symbol::new(&format!("{letters}P{}", link + 1))
}

impl Arm {
    /// An arm in a graph, in which symbols may be bound to others.
    pub fn new(
        d: &Description,
        formulas: &Formulas,
        grouped: &[Grouped],
        unit: Unit,
        graph: &mut Graph,
    ) -> Self {
        let (chain, along) = without_lengths(d);
        let arm = &formulas.dynamics;
        let [_, qd, qdd] = formulas.state();
        let (rates, changes) = (arm.rates(&qd), arm.rates(&qdd));
        let zero = graph.trace(Expr::int(0));
        let mut axes: Vec<Axis> = vec![];
        let mut angles = vec![];
        let mut slides = vec![];
        let q: Vec<Expr> = formulas.q.iter().map(|&s| s.into()).collect();
        for (k, link) in arm.links.iter().enumerate() {
            let before = chain.constants[k];
            let continues = k > 0 && before.rotation == Rotation::identity();
            let slides_here = link.kind == JointKind::Prismatic;
            let value = link.value.value(&q);
            let of_motion = if slides_here { unit } else { Unit(None) };
            angles.push(if slides_here { (Expr::int(0), 0) } else { (value, link.value.quarters) });
            axes.push(Axis {
                kind: link.kind,
                turn: before.rotation.rows().map(|row| row.map(|e| graph.trace(e))),
                across: before.translation.0.map(|e| unit.scaled(e, graph)),
                along: if slides_here { zero } else { unit.scaled(along[k], graph) },
                slide: if slides_here { unit.scaled(value, graph) } else { zero },
                rate: of_motion.scaled(rates[k], graph),
                change: of_motion.scaled(changes[k], graph),
                first: if continues { axes[k - 1].first } else { k },
            });
            slides.push(slides_here.then(|| {
                let e = grouped[k].entries();
                let letters = ["MA", "MB", "MC", "MX", "MY", "MZ"];
                // Equal masses have one name.
                let mass = |i: usize| {
                    let same = (0..i).find(|&j| e[9 + j] == e[9 + i]).unwrap_or(i);
                    name(if e[9] == e[10] && e[10] == e[11] { "M" } else { letters[same] }, k)
                };
                std::array::from_fn(|i| {
                    let entry = if i < 3 { e[9 + i] } else { e[3 + i] };
                    (!entry.is_zero()).then(|| if i < 3 { mass(i) } else { name(letters[i], k) })
                })
            }));
        }
        let base = arm.gravity.0.map(|e| unit.scaled(-e, graph));
        Arm { axes, base, angles, known: FxHashMap::default(), numbers: FxHashMap::default(), slides }
    }

    /// The name of a number of a link, from 0.
    pub fn number(&mut self, letters: &'static str, link: usize) -> Expr {
        *self.numbers.entry((letters, link)).or_insert_with(|| name(letters, link).into())
    }

    /// Sine and cosine of the turns of some axes together; none where none of them turns.
    pub fn turned(&mut self, from: usize, to: usize, graph: &mut Graph) -> Option<(Value, Value)> {
        if let Some(&known) = self.known.get(&(from, to)) {
            return known;
        }
        let axes = (from..=to).filter(|&k| self.axes[k].kind == JointKind::Revolute);
        let (mut sum, mut quarters, mut any) = (Expr::int(0), 0, false);
        for k in axes {
            (sum, quarters, any) = (sum + self.angles[k].0, quarters + self.angles[k].1, true);
        }
        let found = any.then(|| {
            let angle = Angle::of(sum).to_expr();
            let (mut s, mut c) = (graph.trace(angle.sin()), graph.trace(angle.cos()));
            for _ in 0..quarters % 4 {
                (s, c) = (c, if is_zero(graph, s) { s } else { -s });
            }
            (s, c)
        });
        self.known.insert((from, to), found);
        found
    }

    /// The displacement before an axis, in the frame of the link before, as lengths were slid; a slide with its own.
    pub fn offset(&self, k: usize, choices: &Choices, graph: &mut Graph) -> V3 {
        let axis = &self.axes[k];
        let along = if choices.slid[k] { None } else { Some(axis.along) };
        let own = along.map_or(axis.slide, |along| graph.add(along, axis.slide));
        let mut p: V3 = std::array::from_fn(|i| {
            let part = graph.mul(axis.turn[i][2], own);
            graph.add(axis.across[i], part)
        });
        if k > 0 && choices.slid[k - 1] {
            p[2] = graph.add(p[2], self.axes[k - 1].along);
        }
        p
    }

    /// True if a link may keep mass on its axis so.
    pub fn allows(&self, k: usize, gauge: Gauge, choices: &Choices, graph: &mut Graph) -> bool {
        let turns = |k: usize| self.axes[k].kind == JointKind::Revolute;
        let place = match gauge {
            Gauge::Nothing => return true,
            Gauge::X => 0,
            Gauge::Y => 1,
        };
        k > 0 && turns(k) && turns(k - 1) && {
            let p = self.offset(k, choices, graph);
            !is_zero(graph, p[place])
        }
    }
}

pub(super) fn is_zero(graph: &Graph, v: Value) -> bool {
    graph.as_number(v).is_some_and(|r| r.is_zero())
}

/// The chain without the constant lengths along revolute axes, and these.
fn without_lengths(d: &Description) -> (MovingAxes<Expr>, Vec<Expr>) {
    let mut robot = Robot::symbolic(d);
    let mut along = vec![];
    for link in &mut robot.links {
        let turns_only = link.turns() && !link.slides();
        along.push(if turns_only { link.d.offset } else { Expr::int(0) });
        if turns_only {
            link.d = Affine { offset: Expr::int(0), ..link.d.clone() };
        }
    }
    let chain = MovingAxes::new(&robot, Lengths::Before);
    let lengths = chain.moving.iter().map(|a| match a.kind {
        JointKind::Revolute => along[a.row],
        JointKind::Prismatic => Expr::int(0),
    });
    let lengths = lengths.collect();
    (chain, lengths)
}

/// The names of links' numbers with their values in base parameters, as they were chosen, and the powers of a length that they have.
pub(super) fn values(
    d: &Description,
    arm: &Dynamics<Expr>,
    base: &[Grouped],
    choices: &Choices,
    slides: &[Option<[Option<Symbol>; 6]>],
) -> Vec<(Symbol, Expr, i32)> {
    let (chain, along) = without_lengths(d);
    let o = Expr::int(0);
    let n = arm.links.len();
    // The frames as lengths were slid, and the bodies in them.
    let slid =
        |k: usize| if choices.slid[k] { Transform::translation_z(along[k]) } else { Transform::identity() };
    let before: Vec<Transform<Expr>> = (0..n)
        .map(|k| {
            let own = if choices.slid[k] { o } else { along[k] };
            let start = if k > 0 { slid(k - 1) } else { Transform::identity() };
            start * chain.constants[k] * Transform::translation_z(own)
        })
        .collect();
    let mut shifted = arm.clone();
    let mut start = base.to_vec();
    for (k, link) in shifted.links.iter_mut().enumerate() {
        link.before = before[k];
        if choices.slid[k] {
            let body = Body { inertia: start[k].inertia, first_moment: start[k].first_moment, mass: o };
            let body = body.seen_from(&slid(k));
            (start[k].inertia, start[k].first_moment) = (body.inertia, body.first_moment);
        }
    }
    let half = Expr::from(Rational::new(1, 2));
    let given = |j: usize, own: &Grouped, parent: Option<&Grouped>| {
        let [xx, _, _, yy, _, zz] = own.inertia;
        let along = match choices.form[j] {
            Form::NoYy => yy,
            Form::NoZz => (xx + yy - zz) * half,
        };
        let (axis, place) = (before[j].rotation.z(), before[j].translation);
        let mass = match (choices.gauge[j], parent) {
            (Gauge::X, Some(p)) => -(p.first_moment[0] + own.first_moment[2] * axis[0]) / place[0],
            (Gauge::Y, Some(p)) => -(p.first_moment[1] + own.first_moment[2] * axis[1]) / place[1],
            _ => own.mass[0],
        };
        Body { inertia: [along, o, o, along, o, o], first_moment: Vector([o, o, own.first_moment[2]]), mass }
    };
    let links = crate::dynamics::grouping::grouped_by(&shifted, start, given);
    let mut all = vec![];
    for (k, link) in links.iter().enumerate() {
        let [xx, xy, xz, yy, yz, zz] = link.inertia;
        let [mx, my, _] = link.first_moment.0;
        if let Some(names) = &slides[k] {
            let entries = link.entries();
            for (i, s) in names.iter().enumerate() {
                let entry = if i < 3 { entries[9 + i] } else { entries[3 + i] };
                all.extend(s.map(|s| (s, entry, if i < 3 { 2 } else { 1 })));
            }
            continue;
        }
        match choices.form[k] {
            Form::NoZz => {
                let second = [(yy + zz - xx) * half, (xx + zz - yy) * half, -xy, -xz, -yz];
                all.extend(SECOND.iter().zip(second).map(|(l, e)| (name(l, k), e, 0)));
            }
            Form::NoYy => {
                let tensor = [xx, o, xy, xz, yz, zz];
                all.extend(TENSOR.iter().zip(tensor).map(|(l, e)| (name(l, k), e, 0)));
            }
        }
        all.extend([(name("MX", k), mx, 1), (name("MY", k), my, 1), (name("M", k), link.mass[0], 2)]);
    }
    all
}
