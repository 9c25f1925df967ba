//! Points of links: where centres of mass are, how fast they move, the squares of their speeds: `x_{c2}`, `\dot y_2`, `v_B^2`,
//! `J_{v_{c2}}`.

use super::letters::Letters;
use super::matrices::{Cells, Factor, times};
use super::model::State;
use super::quantity::Quantity;
use super::statements::{Piece, Reader, formula_span, lone_name};
use super::words::{Role, without_looks, words};
use crate::jacobians::derivative;
use crate::note::Unread;
use denavit_reading::document::{Part, Side, Statement};
use denavit_symbolic::parse::Syntax;
use denavit_symbolic::vocabulary::{Vocabulary, plain_name};
use denavit_symbolic::{Expr, Symbol};
use std::collections::BTreeSet;
use std::ops::Range;

/// A point that a link carries.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) enum Place {
    /// Its centre of mass.
    Centre,
    /// Where it ends: on the next axis, or at the tool. Where offsets leave several such points, each has a number.
    End(usize),
}

/// The most points at which a link may end.
pub(super) const ENDS: usize = 2;

/// No arm has more bodies with names of one digit.
const MOST: usize = 9;

/// What a name says of a point.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Kind {
    /// x, y or z in the base.
    Coordinate(usize),
    /// Its rate.
    Rate(usize),
    /// The square of the speed.
    Square,
    Speed,
    /// All coordinates.
    Position,
    Velocity,
    /// The derivatives of the coordinates by the joint variables.
    Jacobian,
    /// An angular velocity, or a scalar part of one.
    Turning,
}

impl Kind {
    /// True for what a vector or a matrix is.
    pub fn is_matrix(self) -> bool {
        matches!(self, Kind::Position | Kind::Velocity | Kind::Jacobian)
    }
}

/// A name of a point.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Named {
    pub kind: Kind,
    /// The link, counted from 0; nothing where a letter does not say which.
    pub link: Option<usize>,
    /// Its index says that it is a centre of mass.
    pub is_centre: bool,
    /// The name in formulas, without what makes it a rate or a square.
    pub word: String,
}

/// What a name says of a point of an arm of `n` bodies.
pub(super) fn named(text: &str, span: &Range<usize>, n: usize, letters: &Letters) -> Option<Named> {
    let source = text.get(span.clone())?.trim();
    if source.len() > 60 {
        return None;
    }
    let is_dotted = source.contains("\\dot") || source.contains(['\u{307}', 'ẋ', 'ẏ', 'ż']);
    let plain = source.replace("\\dot", "").replace('\u{307}', "");
    let plain = plain.replace("^{(", "^{").replace(")}", "}");
    let plain = plain.replace('ẋ', "x").replace('ẏ', "y").replace('ż', "z");
    let name = lone_name(&plain, &(0..plain.len()))?;
    if !name.left.is_empty() || name.is_inverse || name.is_transposed || !name.arguments.is_empty() {
        return None;
    }
    let alphanumeric = |s: &str| -> String { s.chars().filter(|c| c.is_alphanumeric()).collect() };
    let (sub, sup) = (alphanumeric(&without_looks(&name.sub)), alphanumeric(&without_looks(&name.sup)));
    let (mut kind, mut index) = match (name.base.as_str(), is_dotted) {
        ("x" | "X", false) => (Kind::Coordinate(0), sub.clone()),
        ("y" | "Y", false) => (Kind::Coordinate(1), sub.clone()),
        ("z" | "Z", false) => (Kind::Coordinate(2), sub.clone()),
        ("x" | "X", true) => (Kind::Rate(0), sub.clone()),
        ("y" | "Y", true) => (Kind::Rate(1), sub.clone()),
        ("z" | "Z", true) => (Kind::Rate(2), sub.clone()),
        ("v" | "V", false) => (Kind::Speed, sub.clone()),
        ("ω", false) => (Kind::Turning, sub.clone()),
        ("p" | "P" | "r", false) => (Kind::Position, sub.clone()),
        ("p" | "P" | "r", true) => (Kind::Velocity, sub.clone()),
        // `J_{v_{c2}}`, `J_P^{(l_2)}`, `J_{C2}`
        ("J", false) => {
            let of_centre = || Some(sub.as_str()).filter(|s| s.starts_with(['c', 'C', 'g', 'G']));
            let rest = sub.strip_prefix(['v', 'P', 'p', 'L']).or_else(of_centre)?;
            (Kind::Jacobian, if rest.is_empty() { sup.clone() } else { rest.to_string() })
        }
        _ => return None,
    };
    match (kind, sup.as_str()) {
        (_, "") => {}
        (Kind::Speed, "2") => kind = Kind::Square,
        (Kind::Jacobian, _) if sup == index => {}
        _ => return None,
    }
    let cut = index.find(|c: char| c.is_ascii_digit()).unwrap_or(index.len());
    let digits = index.split_off(cut);
    let is_mark =
        |s: &str| matches!(s, "c" | "C" | "g" | "G" | "cm" | "CM" | "cg" | "s" | "S" | "m" | "l" | "ci");
    let (link, is_centre) = match (index.as_str(), digits.parse::<usize>().ok()) {
        ("", Some(k)) if (1..=n).contains(&k) => (Some(k - 1), false),
        (mark, Some(k)) if is_mark(mark) && (1..=n).contains(&k) => (Some(k - 1), true),
        (letter, None) if digits.is_empty() && letter.chars().count() == 1 => {
            let letter = letter.chars().next()?;
            match letters.get(&letter) {
                Some(&k) if k < n => (Some(k), false),
                _ if letter.is_ascii_uppercase() && letter != 'E' => (None, false),
                _ if n == 1 && is_mark(&index) => (Some(0), true),
                _ => return None,
            }
        }
        _ => return None,
    };
    // `V_2` is a potential energy, or a torque.
    if name.base == "V" && !is_centre {
        return None;
    }
    let word = plain_name(&format!("{}{sub}", name.base)).replace(',', "");
    Some(Named { kind, link, is_centre, word })
}

impl Named {
    /// What it may be, of one number.
    pub fn quantities(&self, n: usize) -> Vec<Quantity> {
        let links = match self.link {
            Some(k) => k..k + 1,
            None => 0..n,
        };
        let ends = if self.is_centre { 0 } else { ENDS };
        let places = || std::iter::once(Place::Centre).chain((0..ends).map(Place::End));
        let of = |place: Place, k: usize| match self.kind {
            Kind::Coordinate(axis) => Some(Quantity::Coordinate(place, k, axis)),
            Kind::Rate(axis) => Some(Quantity::Rate(place, k, axis)),
            Kind::Square => Some(Quantity::Speed(place, k)),
            _ => None,
        };
        links.flat_map(|k| places().map(move |p| (p, k))).filter_map(|(p, k)| of(p, k)).collect()
    }

    /// What it may be in a row and a column of a matrix.
    fn entries(&self, row: usize, column: usize) -> Vec<Quantity> {
        let Some(k) = self.link else { return vec![] };
        match self.kind {
            Kind::Position => vec![Quantity::Coordinate(Place::Centre, k, row)],
            Kind::Velocity | Kind::Speed => vec![Quantity::Rate(Place::Centre, k, row)],
            Kind::Jacobian => vec![Quantity::Slope(Place::Centre, k, row, column)],
            _ => vec![],
        }
    }
}

impl Reader<'_> {
    /// What a side says of a point, unless the name stands for something else.
    pub(super) fn named(&self, span: &Range<usize>) -> Option<Named> {
        let named = named(self.text, span, self.names.bodies, &self.names.letters)?;
        self.names.vocabulary.lookup(&named.word).is_none().then_some(named)
    }

    /// The same of a side of a statement without matrices; `v_1 = -m_2 …` is a torque.
    pub(super) fn number_of_point(&self, at: usize, span: &Range<usize>) -> Option<Named> {
        let named = self.named(span).filter(|p| !p.kind.is_matrix())?;
        let words = words(self.text.get(self.statements[at].span.clone())?);
        let is_body = |w: &String| {
            let role = self.names.roles.get(&Symbol::new(w));
            matches!(role, Some(Role::Mass(_) | Role::Inertia(_) | Role::About(..) | Role::Ten(..)))
        };
        (!words.iter().any(is_body)).then_some(named)
    }

    /// A statement that says what numbers of a point are.
    pub(super) fn point(&mut self, at: usize, all: &[Named], formulas: &[(usize, Range<usize>, Syntax)]) {
        let Some((_, _, syntax)) = formulas.first() else { return };
        let value = syntax.value();
        let content = self.content(value);
        if content.accelerations || content.gravity || value.symbols().is_empty() && !value.is_zero() {
            return;
        }
        for named in all {
            let moves = matches!(named.kind, Kind::Rate(_) | Kind::Square | Kind::Speed | Kind::Turning);
            if named.kind.is_matrix() || moves != content.rates && !value.is_zero() {
                continue;
            }
            let candidates = named.quantities(self.names.bodies);
            let name = match named.kind {
                Kind::Rate(_) => format!("dot{}", named.word),
                _ => named.word.clone(),
            };
            if candidates.is_empty() {
                self.helper(at, name.clone(), formulas);
            }
            for (_, span, syntax) in formulas.iter().filter(|_| !candidates.is_empty()) {
                let number = self.read.pieces.len();
                self.read.defined.entry(name.clone()).or_insert((number, named.kind));
                let piece = self.piece(at, span, syntax, candidates.clone());
                self.read.pieces.push(Piece { is_nameless: named.link.is_none(), ..piece });
            }
            for (name, value) in meant(named.kind, &name, value, self.state) {
                self.define(&name, value);
            }
        }
    }

    /// True for formulas with joints in them.
    fn turns(&self, values: &[Vec<Expr>]) -> bool {
        values.iter().flatten().any(|e| e.symbols().iter().any(|s| self.state.q.contains(s)))
    }

    /// A side with a vector or a matrix of a point.
    pub(super) fn point_matrix(
        &mut self,
        at: usize,
        side: &Side,
        named: &Named,
        errors: &mut Vec<Unread>,
    ) -> Option<()> {
        let terms = self.terms(side)?;
        let [(is_minus, factors)] = &terms[..] else { return None };
        let mut scale = if *is_minus { Expr::int(-1) } else { Expr::int(1) };
        let mut values: Option<Vec<Vec<Expr>>> = None;
        let mut grids: Vec<Cells> = vec![];
        for factor in factors {
            let next: Vec<Vec<Expr>> = match factor {
                Factor::Scalar(e) => {
                    scale = scale * *e;
                    continue;
                }
                Factor::Column(column) => column.iter().map(|e| vec![*e]).collect(),
                Factor::Grid(grid) => {
                    let cells = self.cells(grid, errors)?;
                    let values = cells.iter().map(|r| r.iter().map(|c| c.1.value()).collect()).collect();
                    grids.push(cells);
                    values
                }
            };
            values = Some(match values {
                Some(before) => times(&before, &next)?,
                None => next,
            });
        }
        let values = values?;
        let cells = grids.first()?;
        let columns = values.first()?.len();
        let is_column = matches!((values.len(), columns), (2 | 3, 1));
        let is_row = values.len() == 1 && matches!(columns, 2 | 3) && factors.len() == 1;
        let fits = match named.kind {
            Kind::Jacobian => matches!(values.len(), 2 | 3) && columns == self.n,
            _ => is_column || is_row,
        };
        let content = values.iter().flatten().fold((false, false), |(rates, other), e| {
            let c = self.content(*e);
            (rates | c.rates, other | c.accelerations | c.gravity)
        });
        // `J_{C2}` may be an inertia, which does not depend on the joints.
        let is_tensor = named.kind == Kind::Jacobian && !self.turns(&values);
        let moves = matches!(named.kind, Kind::Velocity | Kind::Speed);
        if is_tensor || !fits || content.1 || content.0 != moves {
            return None;
        }
        let is_printed = scale.is_one() && factors.len() == 1;
        for (i, row) in values.iter().enumerate() {
            for (j, &value) in row.iter().enumerate() {
                let (line, column) = if is_row { (j, 0) } else { (i, j) };
                let (span, syntax) = match is_printed {
                    true => cells[i][j].clone(),
                    false => {
                        let (first, last) = (cells.get(i)?.first()?, cells.get(i)?.last()?);
                        (first.0.start..last.0.end, first.1.clone())
                    }
                };
                let piece = self.piece(at, &span, &syntax, named.entries(line, column));
                self.read.pieces.push(Piece {
                    place: Some((i + 1, j + 1)),
                    syntax: is_printed.then_some(syntax),
                    value: scale * value,
                    is_nameless: false,
                    ..piece
                });
            }
        }
        // `v_{c2}^2` behind the vector.
        if moves {
            let square = values.iter().flatten().fold(Expr::int(0), |sum, e| sum + (scale * *e).powi(2));
            if named.kind == Kind::Speed {
                self.define(&named.word, square.sqrt());
            }
        }
        Some(())
    }
}

/// The names of matrices that are the Jacobians of points, `J_{C2}`, and no inertias.
pub(super) fn jacobians(text: &str, all: &[Statement]) -> BTreeSet<String> {
    let is_wide = |s: &Statement| {
        let grids = s.sides.iter().flat_map(|s| &s.parts).filter_map(|p| match p {
            Part::Matrix(grid) => Some(grid),
            Part::Text(_) => None,
        });
        grids.into_iter().any(|g| {
            let columns = g.rows.first().map_or(0, Vec::len);
            columns > 1 && (g.rows.len(), columns) != (3, 3)
        })
    };
    let of = |s: &Statement| {
        let span = formula_span(s.sides.first()?)?;
        named(text, &span, MOST, &Letters::new()).filter(|p| p.kind == Kind::Jacobian)
    };
    all.iter().filter(|s| is_wide(s)).filter_map(of).map(|p| p.word).collect()
}

/// What names stand for in formulas where `value` is printed of one of a point: a coordinate has a rate, too.
fn meant(kind: Kind, name: &str, value: Expr, state: &State) -> Vec<(String, Expr)> {
    let own = match kind {
        Kind::Square => value.sqrt(),
        _ => value,
    };
    let rate = match kind {
        Kind::Coordinate(_) => rate(value, state),
        _ => None,
    };
    let rate = rate.map(|rate| (format!("dot{name}"), rate));
    std::iter::once((name.to_string(), own)).chain(rate).collect()
}

/// How fast a formula in the joint variables changes.
pub(super) fn rate(value: Expr, state: &State) -> Option<Expr> {
    let mut sum = Expr::int(0);
    for (&q, &qd) in state.q.iter().zip(&state.qd) {
        sum = sum + derivative(value, q.into())? * Expr::from(qd);
    }
    Some(sum)
}

/// Names with another value for one of a point.
pub(super) fn with(names: Vocabulary, kind: Kind, name: &str, value: Expr, state: &State) -> Vocabulary {
    let meant = meant(kind, name, value, state);
    meant.into_iter().fold(names, |names, (name, value)| names.alias(&name, value))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_points() {
        for (text, expected) in [
            ("v_2^2", Some((Kind::Square, Some(1), false, "v2"))),
            (r"v_{c2}^2", Some((Kind::Square, Some(1), true, "vc2"))),
            (r"v_{c_2}^{2}", Some((Kind::Square, Some(1), true, "vc2"))),
            (r"\dot x_2", Some((Kind::Rate(0), Some(1), false, "x2"))),
            (r"\dot{y}_{c2}", Some((Kind::Rate(1), Some(1), true, "yc2"))),
            ("x_{c1}", Some((Kind::Coordinate(0), Some(0), true, "xc1"))),
            (r"V_{G_2}^2", Some((Kind::Square, Some(1), true, "VG2"))),
            ("V_2^2", None),
            ("v_B^2", Some((Kind::Square, None, false, "vB"))),
            (r"J_{v_{c2}}", Some((Kind::Jacobian, Some(1), true, "Jvc2"))),
            ("J_{C2}", Some((Kind::Jacobian, Some(1), true, "JC2"))),
            (r"J_P^{(\ell_2)}", Some((Kind::Jacobian, Some(1), true, "JP"))),
            (r"\omega_2", Some((Kind::Turning, Some(1), false, "ω2"))),
            ("x_e", None),
            ("x", None),
            ("v_4^2", None),
            ("x_{12}", None),
            ("p_2^0", None),
        ] {
            let found = named(text, &(0..text.len()), 3, &Letters::new());
            let found = found.as_ref().map(|p| (p.kind, p.link, p.is_centre, p.word.as_str()));
            assert_eq!(found, expected, "{text}");
        }
    }
}
