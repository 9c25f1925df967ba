//! Points of the arm under names of the author's own: `x_w`, `y_w`, `z_w` are the wrist centre if their values are.
//!
//! Names that differ in a letter x, y, z alone are one point. Which one is asked of the values: that frame whose origin has most
//! of the coordinates, at least half of them; the others are held against it.

use super::{Assertion, Defined, Pair, Piece, Walk, is_measured};
use crate::facts::{About, Meaning};
use crate::formula::has_root_of_sum;
use crate::subject::Subject;
use denavit::forward::Reference;
use denavit_reading::document::Statement;
use denavit_reading::slip::{Points, Value};
use denavit_symbolic::parse::{Syntax, SyntaxKind};
use denavit_symbolic::readable::literals;
use denavit_symbolic::{Expr, Node, equal};
use std::collections::BTreeMap;
use std::ops::Range;
use std::rc::Rc;

/// Longer formulas are not compared.
const LONGEST: u64 = 4_000;
/// No more frames are looked at, each from each other.
const MAX_FRAMES: usize = 8;
/// So many definitions of a document are looked at.
const MOST: usize = 300;

/// The claims that names of points make, where nothing else is known of these.
pub(in super::super) fn points(
    defined: &[Defined],
    assertions: &[Assertion],
    subjects: &[Rc<Subject>],
) -> Vec<Assertion> {
    let is_free = |d: &&Defined| {
        let touches = |a: &Assertion| a.span.start < d.statement.end && d.statement.start < a.span.end;
        // A number is that of a configuration.
        !is_measured(d.value) && literals(d.value) <= LONGEST && !assertions.iter().any(touches)
    };
    let named: Vec<(String, usize, &Defined)> = defined
        .iter()
        .take(MOST)
        .filter(is_free)
        .filter_map(|d| coordinate(&d.name).map(|(stem, axis)| (stem, axis, d)))
        .collect();
    let mut found = vec![];
    let mut seen: Vec<(String, usize)> = vec![];
    for (stem, _, first) in &named {
        let key = (stem.clone(), first.subject);
        if seen.contains(&key) {
            continue;
        }
        seen.push(key);
        let point: Vec<(usize, &Defined)> = named
            .iter()
            .filter(|n| n.0 == *stem && n.2.subject == first.subject)
            .map(|n| (n.1, n.2))
            .collect();
        let Some(subject) = subjects.get(first.subject).filter(|_| point.len() > 1) else { continue };
        found.extend(claims(&point, subject));
    }
    let is_told = |d: &Defined| found.iter().any(|a| a.span == d.statement);
    let open: Vec<&Defined> = defined.iter().take(MOST).filter(is_free).filter(|d| !is_told(d)).collect();
    found.extend(distances(&open, subjects));
    found.extend(speeds(&open, subjects));
    found
}

/// Names whose values are components of the hand's velocity, along or about an axis of the base, or its speed.
fn speeds(open: &[&Defined], subjects: &[Rc<Subject>]) -> Vec<Assertion> {
    let mut points = Points::new(71);
    let mut found = vec![];
    for d in open {
        let Some(subject) = subjects.get(d.subject) else { continue };
        let rates = subject.rates();
        let turns = |e: Expr| e.symbols().iter().any(|s| rates.contains(&(*s).into()));
        // A rate by itself tells nothing.
        if !turns(d.value) || d.value.as_symbol().is_some() {
            continue;
        }
        let velocity = subject.velocity();
        let speed = |part: &[Expr]| part.iter().fold(Expr::int(0), |sum, e| sum + e.powi(2));
        let (value, known) = match d.value.node() {
            Node::Sqrt(inner) => (inner, vec![speed(&velocity[..2]), speed(&velocity[..3])]),
            _ => (d.value, [velocity.clone(), vec![speed(&velocity[..2]), speed(&velocity[..3])]].concat()),
        };
        let own = points.value(value);
        let same = known
            .into_iter()
            .find(|e| turns(*e) && own.is_some() && points.value(*e) == own && equal(*e, value).is_equal());
        if let Some(wanted) = same {
            let printed = None;
            found.push(equation(
                d,
                Pair { place: None, span: d.span.clone(), printed, value, wanted, also: vec![] },
            ));
        }
    }
    found
}

/// Names whose values are distances of the arm, or their squares: between origins of frames, and of an origin from the first axis.
fn distances(open: &[&Defined], subjects: &[Rc<Subject>]) -> Vec<Assertion> {
    let mut points = Points::new(61);
    let mut known: BTreeMap<usize, Vec<(Value, Expr)>> = BTreeMap::new();
    let mut found = vec![];
    for d in open {
        let Some(subject) = subjects.get(d.subject) else { continue };
        let joints = subject.joints();
        let moves = |e: Expr| e.symbols().iter().any(|s| joints.contains(&(*s).into()));
        // What is told of the hand's own place is that by definition.
        let place = subject.pose().translation.0;
        let is_place = |e: Expr| place.iter().any(|p| !p.symbols().is_empty() && equal(e, *p).is_equal());
        let mut parts = vec![&d.printed];
        let mut speaks_of_hand = false;
        while let Some(part) = parts.pop() {
            speaks_of_hand |= matches!(part.kind, SyntaxKind::Name(e) if is_place(e));
            parts.extend(part.children());
        }
        if speaks_of_hand {
            continue;
        }
        // What is a multiple of a sine is no distance.
        if !moves(d.value) || !matches!(d.printed.kind, SyntaxKind::Sum(_) | SyntaxKind::Root(_)) {
            continue;
        }
        let squares = known.entry(d.subject).or_insert_with(|| {
            let all = squares(subject).into_iter().filter(|e| moves(*e));
            all.filter_map(|e| Some((points.value(e)?, e))).collect()
        });
        let is_root = matches!(d.printed.kind, SyntaxKind::Root(_));
        let square = match d.value.node() {
            Node::Sqrt(inner) if is_root => inner,
            _ if is_root => d.value.powi(2),
            _ => d.value,
        };
        let Some(value) = points.value(square) else { continue };
        let same = squares.iter().find(|(v, e)| *v == value && equal(square, *e).is_equal());
        if let Some((_, e)) = same {
            let pair = Pair {
                place: None,
                span: d.span.clone(),
                printed: None,
                value: square,
                wanted: *e,
                also: vec![],
            };
            found.push(equation(d, pair));
        }
    }
    found
}

/// The squares of distances of an arm.
fn squares(subject: &Subject) -> Vec<Expr> {
    let origins: Vec<_> = (0..=subject.last().min(MAX_FRAMES)).map(|k| subject.origin(k).0).collect();
    let origins: Vec<_> = origins.into_iter().chain([subject.pose().translation.0]).collect();
    let square = |parts: &[Expr]| parts.iter().fold(Expr::int(0), |sum, e| sum + e.powi(2));
    let mut found: Vec<Expr> = origins.iter().map(|o| square(&o[..2])).collect();
    for (k, a) in origins.iter().enumerate() {
        for b in &origins[..k] {
            found.push(square(&[a[0] - b[0], a[1] - b[1], a[2] - b[2]]));
        }
    }
    found
}

fn equation(d: &Defined, pair: Pair) -> Assertion {
    Assertion {
        span: d.statement.clone(),
        name: d.shown.clone(),
        about: About::Equation,
        pieces: vec![Piece::Pair(pair)],
        remarks: vec![],
        subject: d.subject,
        names: None,
        whole: None,
        reference: None,
        spoken: None,
    }
}

/// The claims that a point makes.
fn claims(point: &[(usize, &Defined)], subject: &Subject) -> Vec<Assertion> {
    let velocity = velocity_of_hand(point, subject);
    if !velocity.is_empty() {
        return velocity;
    }
    let moves = |e: Expr| e.symbols().iter().any(|s| subject.joints().contains(&(*s).into()));
    // A tool that is a point of its own is looked at behind the frames.
    let tool = subject.last() + 1;
    let has_tool = subject.description.tool.translation.0.iter().any(|e| !e.is_zero());
    let place = |k: usize| if k == tool { subject.pose().translation } else { subject.origin(k) };
    let mut best: Option<(usize, usize)> = None;
    // `x_3` is of frame 3, if of any.
    let told = point[0].1.name.trim_matches(|c: char| !c.is_ascii_digit()).parse::<usize>().ok();
    let frames = match told {
        Some(k) => k..=k.min(subject.last()),
        None => 1..=subject.last() + usize::from(has_tool),
    };
    for k in frames {
        let origin = place(k);
        let agrees = |(axis, d): &&(usize, &Defined)| {
            moves(d.value) && moves(origin[*axis]) && equal(d.value, origin[*axis]).is_equal()
        };
        let count = point.iter().filter(agrees).count();
        if best.is_none_or(|b| count > b.0) {
            best = Some((count, k));
        }
    }
    let is_enough = |b: &(usize, usize)| 2 * b.0 >= point.len() || told.is_some() && b.0 > 0;
    let Some((count, k)) = best.filter(is_enough) else { return axis_of_frame(point, subject) };
    // One of three is little: all may be something else.
    if count > 1 || point.len() == 2 || told.is_some() {
        let origin = place(k);
        let of = if k == tool { Reference::Tool } else { Reference::Frame(k) };
        let frame = Meaning::Frame { of, seen_from: Reference::Frame(0) };
        // A distance from an axis, `√(x² + y²) - L`, is no coordinate in the base.
        let is_right = |(axis, d): &(usize, &Defined)| equal(d.value, origin[*axis]).is_equal();
        // A statement that is read twice, as text and as a part of a program, is one claim.
        let is_twice = |(axis, d): &(usize, &Defined)| {
            point.iter().any(|o| {
                let touches = o.1.statement.start < d.statement.end && d.statement.start < o.1.statement.end;
                touches && o.0 == *axis && !std::ptr::eq(o.1, *d) && is_right(o)
            })
        };
        let coordinates =
            point.iter().filter(|p| !has_root_of_sum(p.1.value) && (is_right(p) || !is_twice(p)));
        return coordinates.map(|(axis, d)| assertion(d, origin[*axis], &frame)).collect();
    }
    axis_of_frame(point, subject)
}

/// The claims that components of the hand's velocity make, `vx`, `vy`, `vz`, where at least half of them are that velocity's.
fn velocity_of_hand(point: &[(usize, &Defined)], subject: &Subject) -> Vec<Assertion> {
    let rates = subject.rates();
    let turns = |e: Expr| e.symbols().iter().any(|s| rates.contains(&(*s).into()));
    if !point.iter().any(|(_, d)| turns(d.value)) {
        return vec![];
    }
    let all = subject.velocity();
    let agrees = |wanted: &[Expr]| {
        let right =
            |(axis, d): &&(usize, &Defined)| turns(d.value) && equal(d.value, wanted[*axis]).is_equal();
        point.iter().filter(right).count()
    };
    let parts = [0, 3].into_iter().filter_map(|first| all.get(first..first + 3));
    let Some(wanted) = parts.max_by_key(|wanted| agrees(wanted)) else { return vec![] };
    if 2 * agrees(wanted) < point.len() {
        return vec![];
    }
    point.iter().map(|(axis, d)| equation(d, held(d, wanted[*axis]))).collect()
}

/// The claims that the components of an axis make, `u_x`, `u_y`, `u_z`: all, or all but one, are those of one axis of a frame.
fn axis_of_frame(point: &[(usize, &Defined)], subject: &Subject) -> Vec<Assertion> {
    let mut points = Points::new(67);
    let Ok([a, b, c]) = <[(usize, &Defined); 3]>::try_from(point) else { return vec![] };
    let printed = [a, b, c];
    let is_told = [0, 1, 2].iter().all(|k| printed.iter().any(|p| p.0 == *k));
    let values = printed.map(|(_, d)| points.value(d.value));
    let moves = |e: Expr| e.symbols().iter().any(|s| subject.joints().contains(&(*s).into()));
    if !is_told || values.iter().any(Option::is_none) {
        return vec![];
    }
    let frames = (0..=subject.last().min(MAX_FRAMES)).filter_map(|k| subject.transform(Some(0), Some(k)));
    for frame in frames.chain([subject.pose()]) {
        let rows = frame.rotation.rows();
        let columns = [0, 1, 2].map(|column| printed.map(|(axis, _)| rows[axis][column]));
        for wanted in columns {
            let agrees = [0, 1, 2].map(|k| points.value(wanted[k]) == values[k]);
            let moving = (0..3).filter(|&k| agrees[k] && moves(wanted[k])).count();
            // A component that does not move tells little.
            let is_it = match agrees.iter().filter(|a| **a).count() {
                3 => moving > 1,
                2 => moving == 2 && wanted.iter().all(|e| moves(*e)),
                _ => false,
            };
            if is_it {
                let all = printed.iter().map(|p| p.1).zip(wanted);
                return all.map(|(d, wanted)| equation(d, held(d, wanted))).collect();
            }
        }
    }
    vec![]
}

impl Walk<'_> {
    /// A name that is defined already, at a configuration that its sentence gives; false if it is not that.
    pub(super) fn is_held_there(
        &mut self,
        statement: &Statement,
        name: &str,
        span: &Range<usize>,
        syntax: &Syntax,
    ) -> bool {
        let Some(d) = self.defined.iter().rev().find(|d| d.name == name) else { return false };
        let wanted = self.there(span, syntax.value(), d.value);
        if wanted == d.value {
            return false;
        }
        let pair = Pair {
            place: None,
            span: span.clone(),
            printed: Some(syntax.clone()),
            value: syntax.value(),
            wanted,
            also: vec![],
        };
        let held =
            Assertion { pieces: vec![Piece::Pair(pair)], ..self.assertion(statement, About::Equation) };
        self.assertions.push(held);
        true
    }
}

fn assertion(d: &Defined, wanted: Expr, frame: &Meaning) -> Assertion {
    let about = About::Matrix(Meaning::Origin(Box::new(frame.clone())));
    Assertion { about, ..equation(d, held(d, wanted)) }
}

/// A definition held against what it should be.
fn held(d: &Defined, wanted: Expr) -> Pair {
    Pair {
        place: None,
        span: d.span.clone(),
        printed: Some(d.printed.clone()),
        value: d.value,
        wanted,
        also: vec![],
    }
}

/// The rest of a name and its axis: `xw`, `wx`, `p_{cx}`.
fn coordinate(name: &str) -> Option<(String, usize)> {
    let axis = |c: char| "xyz".find(c.to_ascii_lowercase());
    let (first, last) = (name.chars().next()?, name.chars().next_back()?);
    if name.chars().count() == 1 && !first.is_ascii() {
        return None;
    }
    if name.chars().count() > 8 {
        return None;
    }
    match (axis(first), axis(last)) {
        (Some(k), _) => Some((format!("{}|", &name[first.len_utf8()..]), k)),
        (None, Some(k)) => Some((format!("|{}", &name[..name.len() - last.len_utf8()]), k)),
        (None, None) => None,
    }
}
