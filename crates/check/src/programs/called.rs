//! What a function gives back by its name, its arguments and its shape.

use super::JACOBIANS;
use super::stated::in_radians;
use super::{Program, recognised};
use crate::facts::{About, Jacobian, Meaning};
use crate::jacobians::Part;
use crate::lexis::Lexis;
use crate::matrix::Matrix;
use crate::note::{Unread, Unreadable};
use crate::subject::Subject;
use crate::walk::{Assertion, Pair, Piece};
use denavit::forward::Reference;
use denavit_reading::code::{Assigned, Cell, Reading, Value};
use denavit_reading::slip::Points;
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Expr, Node, Rational, Symbol, equal};
use std::ops::Range;

impl Program<'_> {
    /// What a function gives back.
    pub(super) fn returned(&self, function: &Reading) -> Vec<Assertion> {
        let mut found = vec![];
        for r in &function.returned {
            let shown = r.name.clone().unwrap_or_else(|| format!("{}(…)", function.name));
            // A name is given back, its formula stands where it got its value.
            let own = |name: &String| function.assigned.iter().rev().find(|a| a.name == *name);
            let span = r.name.as_ref().and_then(own).map_or(&r.span, |a| &a.span);
            let is_other =
                |n: &&String| is_of_part(function) && matches!(n.to_lowercase().as_str(), "x" | "y" | "z");
            let named =
                r.name.as_ref().filter(|n| !is_other(n)).and_then(|name| match is_velocity(function) {
                    true => self.component(name, &shown, span, &r.value),
                    false => self.named(name, &shown, span, &r.value),
                });
            // `def T12(th2): return np.array(…)`
            let says_nothing = r.name.as_ref().is_none_or(|name| name.chars().count() == 1);
            let called = || match &r.value {
                Value::Matrix(_) if says_nothing => self.named(&function.name, &shown, span, &r.value),
                _ => None,
            };
            found.extend(named.or_else(called).or_else(|| {
                match &r.value {
                    Value::Matrix(rows) => self
                        .torques(r.name.as_deref().unwrap_or(&function.name), &shown, span, rows)
                        .or_else(|| self.velocity(function, &shown, span, rows))
                        .or_else(|| self.pose(function, &shown, span, rows)),
                    Value::Scalar(cell) => self.by_function(function, span, cell, &shown),
                }
            }));
        }
        found
    }

    /// An axis of a frame, or another point, that a vector is in all its entries.
    pub(super) fn other_vector(&self, rows: &[Vec<Cell>]) -> Option<(Matrix, Meaning)> {
        let values = rows.iter().map(|r| r.iter().map(|c| Some(in_radians(c.value))).collect()).collect();
        let given = |e: Expr| e.substitute(|s| self.given.iter().rev().find(|g| g.0 == s).map(|g| g.1));
        let ((matrix, about), agreement) = recognised::nearest_with(self.subject, &Matrix(values), &given)?;
        let is_axis = matches!(about, Meaning::Axis(..));
        (agreement.is_whole && agreement.telling > 1 && is_axis).then_some((matrix, about))
    }

    /// Scalars that stand as they are in a matrix that is judged, `p = [x4; y4; z4]`: each is that entry.
    pub(super) fn entries(&self, function: &Reading, judged: &[Assertion]) -> Vec<Assertion> {
        let mut found: Vec<Assertion> = vec![];
        let touches = |all: &[Assertion], span: &Range<usize>| {
            all.iter().any(|x| x.span.start < span.end && span.start < x.span.end)
        };
        let matrices = judged.iter().filter(|a| matches!(a.about, About::Matrix(_)) && a.pieces.len() > 1);
        for piece in matrices.flat_map(|a| &a.pieces) {
            let Piece::Pair(pair) = piece else { continue };
            let name = self.text.get(pair.span.clone()).unwrap_or_default().trim();
            let of = |a: &&Assigned| a.name == name && a.span.end <= pair.span.start;
            let Some(a) = function.assigned.iter().rev().find(of) else { continue };
            let Value::Scalar(cell) = &a.value else { continue };
            let source = self.text.get(a.span.clone()).unwrap_or_default();
            // `c12 = cos(q1 + q2)` is an abbreviation.
            let is_plain = matches!(cell.value.node(), Node::Sin(_) | Node::Cos(_));
            let is_formula =
                source.contains(['+', '-', '*', '/']) && !is_plain && in_radians(cell.value) == pair.value;
            // What stands in another entry that is right is no entry alone: the slip is where it was put.
            let is_right_elsewhere = || {
                let others = judged.iter().flat_map(|a| &a.pieces).filter_map(|p| match p {
                    Piece::Pair(other) if other.span != pair.span => Some(other),
                    _ => None,
                });
                let uses = |other: &&Pair| {
                    let source = self.text.get(other.span.clone()).unwrap_or_default();
                    other.span.start > a.span.end && super::words(source).any(|w| w == name)
                };
                others.filter(uses).any(|o| equal(o.value, o.wanted).is_equal())
            };
            let is_right = || equal(pair.value, pair.wanted).is_equal();
            if is_formula
                && !touches(judged, &a.span)
                && !touches(&found, &a.span)
                && (is_right() || !is_right_elsewhere())
            {
                let pieces = vec![self.piece(None, cell, pair.wanted)];
                found.push(self.assertion(&a.name, About::Entry, &a.span, pieces, None));
            }
        }
        found
    }

    /// The Jacobian of the joints that a function takes, or of the first ones if it is that for the greater part.
    pub(super) fn jacobian_of(
        &self,
        values: &Matrix,
        taken: &[usize],
        columns: usize,
    ) -> Option<(Matrix, Jacobian)> {
        if taken.len() == columns {
            return self.subject.jacobian_of_joints(values, taken, Part::Any);
        }
        let first: Vec<usize> = (0..columns).collect();
        let found = self.subject.jacobian_of_joints(values, &first, Part::Any)?;
        let own = values.0.iter().flatten().zip(found.0.0.iter().flatten());
        let is_same = |(a, b): (&Option<Expr>, &Option<Expr>)| match (a, b) {
            (Some(a), Some(b)) => equal(*a, self.with_numbers(*b, *a)).is_equal(),
            _ => false,
        };
        let telling: Vec<bool> = own.filter(|(_, b)| b.is_some_and(|b| !b.is_zero())).map(is_same).collect();
        (2 * telling.iter().filter(|t| **t).count() > telling.len()).then_some(found)
    }

    /// True if numbers are made of the robot's alone, or of those that the program has for its lengths.
    pub(super) fn knows_all(&self, numbers: &[Rational]) -> bool {
        let d = &self.subject.description;
        let rows = d.rows.iter().flat_map(|r| [r.theta, r.d, r.a, r.b]).flat_map(|e| Expr::postorder(&[e]));
        let given = self.given.iter().map(|g| g.1);
        let values = d.parameters.iter().filter_map(|p| d.exact_value(p.symbol));
        let all = rows.chain(given).chain(values).filter_map(|e| e.as_number());
        let known: Vec<Rational> = all.map(|r| r.abs()).collect();
        numbers.iter().all(|r| known.contains(r))
    }

    /// `fk_x(…)` by what a function is called.
    pub(super) fn by_function(
        &self,
        function: &Reading,
        span: &Range<usize>,
        cell: &Cell,
        shown: &str,
    ) -> Option<Assertion> {
        let named = function.returned.first().and_then(|r| r.name.as_deref());
        let by_name = || {
            let source = self.text.get(function.span.clone()).unwrap_or_default().to_lowercase();
            named.is_some_and(|n| determinant_named(n).is_some()) && source.contains("determinant")
        };
        if function.returned.len() == 1 && (is_determinant(function) || by_name()) {
            let lacking = lacking(function, self.text, self.lexis, self.subject);
            let given = |e: Expr| self.with_numbers(e, in_radians(cell.value));
            let wanted = determinant_like(self.subject, in_radians(cell.value), &lacking, &given)?;
            return Some(self.assertion(
                shown,
                About::Equation,
                span,
                vec![self.piece(None, cell, wanted)],
                None,
            ));
        }
        let axis =
            axis_of(&function.name).filter(|_| !is_of_part(function) && function.returned.len() == 1)?;
        let pieces = vec![self.piece(None, cell, self.subject.pose().translation.0[axis])];
        Some(self.assertion(shown, About::Entry, span, pieces, None))
    }
}

/// The coordinate of the hand that a function is called after: `fk_x`, `get_y`, `px`.
pub(super) fn axis_of(name: &str) -> Option<usize> {
    let lower = name.to_lowercase();
    let (rest, last) = lower.split_at(lower.len() - lower.chars().next_back()?.len_utf8());
    let axis = ["x", "y", "z"].iter().position(|a| *a == last)?;
    let of_hand =
        ["fk", "get", "p", "pos", "forward", "fwd", "tcp", "ee", "hand", "tip", "end", "calc", "compute", ""];
    let words: Vec<&str> = rest.split('_').filter(|w| !w.is_empty()).collect();
    words.iter().all(|w| of_hand.contains(w)).then_some(axis)
}

/// A name without a last word that says where the author has it from: `T03_paper`.
pub(super) fn stem(name: &str) -> &str {
    const FROM: [&str; 26] = [
        "paper",
        "hand",
        "byhand",
        "manual",
        "check",
        "ref",
        "expected",
        "exp",
        "book",
        "sym",
        "num",
        "calc",
        "closed",
        "direct",
        "simplified",
        "simp",
        "theory",
        "theoretical",
        "mine",
        "own",
        "short",
        "explicit",
        "analytic",
        "analytical",
        "printed",
        "soll",
    ];
    let last = name
        .rsplit_once('_')
        .filter(|(stem, last)| !stem.is_empty() && FROM.contains(&last.to_lowercase().as_str()));
    last.map_or(name, |(stem, _)| stem)
}

/// True for a function whose name says that it is about a part of the arm, not about the hand.
pub(super) fn is_of_part(function: &Reading) -> bool {
    const PARTS: [&str; 18] = [
        "wrist",
        "elbow",
        "shoulder",
        "knee",
        "ankle",
        "hip",
        "axis",
        "axes",
        "center",
        "centre",
        "poignet",
        "coude",
        "epaule",
        "handgelenk",
        "ellbogen",
        "schulter",
        "muneca",
        "codo",
    ];
    let name = function.name.to_lowercase();
    PARTS.iter().any(|part| name.contains(part))
}

/// True for a function whose name says that it gives something else than a place: a velocity, torques.
pub(super) fn gives_another(function: &Reading) -> bool {
    const OTHERS: [&str; 16] = [
        "vel", "speed", "rate", "torque", "tau", "force", "effort", "grav", "accel", "power", "energy",
        "inertia", "mass", "hold", "static", "det",
    ];
    let is_jacobian = function.name.to_lowercase().contains("jac");
    !is_jacobian && words(&function.name).any(|w| OTHERS.iter().any(|other| w.starts_with(other)))
}

/// True if a matrix is called an inverse, `J_inv`, `Ji`, or is what a function of that name gives, `def jac_inv(…)`; what such a function
/// calls `J` is none.
pub(super) fn says_inverse(function: &Reading, shown: &str) -> bool {
    let says = |name: &str| name.to_lowercase().contains("inv");
    says(shown) || matches!(shown, "Ji" | "iJ" | "J_i") || says(&function.name) && !JACOBIANS.contains(&shown)
}

/// True for a function whose name says that it gives a velocity.
pub(super) fn is_velocity(function: &Reading) -> bool {
    const WORDS: [&str; 8] = ["vel", "speed", "rate", "twist", "geschw", "vitesse", "veloc", "snelh"];
    words(&function.name).any(|w| WORDS.iter().any(|other| w.starts_with(other)))
}

/// True for a function that is called after a determinant: `arm_det`.
pub(super) fn is_determinant(function: &Reading) -> bool {
    words(&function.name).any(|w| matches!(w.as_str(), "det" | "detj" | "determinant" | "determinante"))
}

fn words(name: &str) -> impl Iterator<Item = String> + '_ {
    name.split('_').filter(|w| !w.is_empty()).map(str::to_lowercase)
}

/// The words before a function that speak of it, in bytes.
const WORDS_BEFORE: usize = 300;

/// Nine or sixteen entries one behind the other as a rotation or a pose, by rows, or by columns where the function or the words
/// before it say so and they agree with the hand's.
pub(super) fn as_square(
    rows: &[Vec<Cell>],
    hand: &Matrix,
    (function, text): (&Reading, &str),
) -> Option<Vec<Vec<Cell>>> {
    let n = match rows.len() {
        9 => 3,
        16 => 4,
        _ => return None,
    };
    let all: Vec<&Cell> = rows.iter().map(|r| r.first()).collect::<Option<_>>()?;
    let mut points = Points::new(3);
    let mut agreement = |by_columns: bool| {
        let places = (0..n).flat_map(|r| (0..n).map(move |c| (r, c)));
        places
            .filter(|&(r, c)| {
                let cell = all[if by_columns { c * n + r } else { r * n + c }];
                let own = points.value(cell.value);
                own.is_some() && own == hand.entry(r, c).and_then(|e| points.value(e))
            })
            .count()
    };
    let start =
        (0..=function.span.start.saturating_sub(WORDS_BEFORE)).rev().find(|&i| text.is_char_boundary(i));
    let told = text.get(start.unwrap_or(0)..function.span.end).unwrap_or_default();
    let by_columns = told.to_lowercase().contains("column") && agreement(true) > agreement(false);
    let at = |r: usize, c: usize| all[if by_columns { c * n + r } else { r * n + c }].clone();
    Some((0..n).map(|r| (0..n).map(|c| at(r, c)).collect()).collect())
}

/// The joints that a function does not take where it takes others by their names: what it gives holds at values of them that it does
/// not tell.
pub(super) fn lacking(function: &Reading, source: &str, lexis: &Lexis, subject: &Subject) -> Vec<Symbol> {
    let taken = joints_taken(function, source, lexis, subject);
    if taken.is_empty() {
        return vec![];
    }
    let others = (0..).zip(subject.joints()).filter(|(k, _)| !taken.contains(k));
    others.filter_map(|(_, q)| q.as_symbol()).collect()
}

/// The places of the joints that a function takes by their names.
pub(super) fn joints_taken(function: &Reading, source: &str, lexis: &Lexis, subject: &Subject) -> Vec<usize> {
    let text = source.get(function.span.clone()).unwrap_or_default();
    let head = text.split_once('(').and_then(|h| h.1.split_once(')')).map_or("", |h| h.0);
    if function.name.is_empty() || head.is_empty() {
        return vec![];
    }
    let names: Vec<&str> = super::words(head).collect();
    let taken: Vec<Expr> = names.iter().filter_map(|n| lexis.names.lookup(n)).collect();
    let joints = (0..).zip(subject.joints());
    joints.filter(|(_, q)| taken.contains(q)).map(|(k, _)| k).collect()
}

/// A pair whose right side holds a joint that the function does not take is not judged, unless it is right.
pub(super) fn without(piece: &mut Piece, lacking: &[Symbol]) {
    let Piece::Pair(Pair { place, span, value, wanted, .. }) = piece else { return };
    let Some(name) = wanted.symbols().into_iter().find(|s| lacking.contains(s)) else { return };
    if !equal(*value, *wanted).is_equal() {
        let errors = vec![Unread::new(span.clone(), Unreadable::Unknown(name.name().to_string()))];
        *piece = Piece::Unreadable { place: *place, span: span.clone(), errors };
    }
}

/// The determinant that the arm has by nature; in which order the rows of a task of more than a place are is not told, so that
/// of more than three joints it has the sign of the printed one.
/// A function that does not take all joints gives that of the joints which it takes, if it is printed so.
pub(super) fn determinant_like(
    subject: &Subject,
    printed: Expr,
    lacking: &[Symbol],
    given: &dyn Fn(Expr) -> Expr,
) -> Option<Expr> {
    let taken = |k: &usize| subject.joints()[*k].as_symbol().is_none_or(|q| !lacking.contains(&q));
    let columns: Vec<usize> = (0..subject.joints().len()).filter(taken).collect();
    if columns.len() < subject.joints().len() {
        let rows = subject.geometric_rows(Reference::Tool, Reference::Frame(0));
        let picked = |row: &Vec<Expr>| columns.iter().map(|&k| Some(row[k])).collect::<Vec<_>>();
        let moves = |row: &Vec<Option<Expr>>| row.iter().flatten().any(|e| !e.is_zero());
        let block = Matrix(rows[..3].iter().map(picked).filter(moves).collect());
        let is_square = block.0.len() == columns.len();
        let own = if is_square { block.determinant() } else { None };
        if let Some(own) = own.filter(|own| equal(printed, given(*own)).is_equal()) {
            return Some(own);
        }
    }
    let wanted = [Part::Any, Part::Linear].into_iter().find_map(|p| subject.determinant(p))?;
    let is_turned = subject.joints().len() > 3 && equal(printed, given(-wanted)).is_equal();
    Some(if is_turned { -wanted } else { wanted })
}

/// Lengths of the robot that a program sets to numbers.
pub(super) fn given_in(function: &Reading, subject: &Subject, lexis: &Lexis) -> Vec<(Symbol, Expr)> {
    let of = |a: &Assigned| {
        let Value::Scalar(cell) = &a.value else { return None };
        let lower = a.name.to_lowercase();
        let found = lexis.names.lookup(&a.name).or_else(|| lexis.names.lookup(&lower));
        let symbol = found?.as_symbol()?;
        let is_length = subject.description.parameter(symbol).is_some();
        (is_length && cell.value.symbols().is_empty()).then_some((symbol, cell.value))
    };
    function.assigned.iter().filter_map(of).collect()
}

/// The names of the document and those that a function gives its scalars.
pub(super) fn names_in(function: &Reading, lexis: &Lexis) -> Vocabulary {
    function.assigned.iter().fold(lexis.names.clone(), |names, a| match &a.value {
        Value::Scalar(cell) if a.name.chars().all(char::is_alphanumeric) => names.alias(&a.name, cell.value),
        _ => names,
    })
}

/// The rows of the Jacobian whose determinant has a name: `detJ`, `det_Jv`; `det` alone is that of the whole.
pub(super) fn determinant_named(name: &str) -> Option<Part> {
    let rest = name.strip_prefix("det").or_else(|| name.strip_prefix("Det"))?.trim_start_matches('_');
    match rest {
        "" | "J" | "j" | "Jac" | "jac" => Some(Part::Any),
        "Jv" | "J_v" | "Jp" | "J_p" | "JP" => Some(Part::Linear),
        "Jw" | "J_w" | "Jo" | "J_o" | "JO" => Some(Part::Angular),
        _ => None,
    }
}
