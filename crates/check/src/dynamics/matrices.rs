//! Matrices and vectors of dynamics entry by entry, and sums of products of matrices term by term.

use super::points::Kind as OfPoint;
use super::quantity::{Content, Quantity, is_coriolis, is_inertia, of_scalar, of_vector};
use super::statements::{Piece, Reader, Row, formula_span, lone_name};
use crate::lexis::read;
use crate::names::Name;
use crate::note::Unread;
use denavit_reading::document::{Grid, Part, Side};
use denavit_symbolic::parse::Syntax;
use denavit_symbolic::{Expr, Symbol};
use std::collections::BTreeMap;
use std::ops::Range;

/// A factor of a term.
pub(super) enum Factor<'a> {
    Grid(&'a Grid),
    Scalar(Expr),
    /// q̇ or q̈
    Column(Vec<Expr>),
}

/// Parts of a sum of products of matrices.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    Inertial,
    Velocity,
    Gravity,
    Bias,
    Other,
}

pub(super) type Cells = Vec<Vec<(Range<usize>, Syntax)>>;

impl Reader<'_> {
    /// The cells of a matrix of formulas; nothing where one is none.
    pub(super) fn cells(&self, grid: &Grid, errors: &mut Vec<Unread>) -> Option<Cells> {
        if grid.rows.iter().map(Vec::len).sum::<usize>() > 100 {
            return None;
        }
        let mut found = vec![];
        for row in &grid.rows {
            let mut cells = vec![];
            for span in row {
                match read(self.text, span, &self.read.vocabulary) {
                    Ok(syntax) => cells.push((span.clone(), syntax)),
                    Err(e) => errors.extend(e.into_iter().map(Unread::from)),
                }
            }
            found.push(cells);
        }
        errors.is_empty().then_some(found)
    }

    pub(super) fn matrices(&mut self, at: usize) {
        let statement = &self.statements[at];
        let mut name = None;
        let mut errors = vec![];
        let before = self.read.pieces.len();
        let point = statement.sides.first().and_then(formula_span).and_then(|span| self.named(&span));
        if let Some(point) = point.filter(|p| p.is_centre) {
            for side in &statement.sides[1..] {
                self.point_matrix(at, side, &point, &mut errors);
            }
            if self.read.pieces.len() == before && !errors.is_empty() {
                errors.truncate(5);
                self.read.unread.push((at, errors));
                return;
            }
            // `J_{c2}` may be an inertia.
            if self.read.pieces.len() > before || point.kind != OfPoint::Jacobian {
                return;
            }
        }
        for (i, side) in statement.sides.iter().enumerate() {
            if let Some(span) = formula_span(side) {
                name = name.or_else(|| lone_name(self.text, &span));
                continue;
            }
            if let [Part::Matrix(grid)] = &side.parts[..] {
                // A column of names: `(τ_1, τ_2)`.
                let cells: Vec<Option<Name>> =
                    grid.rows.iter().flatten().map(|s| lone_name(self.text, s)).collect();
                let is_torque = |n: &Option<Name>| {
                    n.as_ref().is_some_and(|n| {
                        !of_scalar(n, self.size(), Content { accelerations: true, ..Content::default() })
                            .is_empty()
                    })
                };
                if i == 0 && cells.len() == self.n && cells.iter().all(is_torque) {
                    name = cells[0].clone().map(|n| Name { sub: String::new(), ..n });
                    continue;
                }
                if i == 0 && cells.iter().all(Option::is_some) {
                    continue;
                }
            }
            let mut trouble = vec![];
            if self.side(at, side, name.as_ref(), &mut trouble).is_none() {
                errors.extend(trouble);
            }
        }
        if self.read.pieces.len() == before && !errors.is_empty() && name.is_some() {
            errors.truncate(5);
            self.read.unread.push((at, errors));
        }
    }

    /// A side with matrices.
    fn side(&mut self, at: usize, side: &Side, name: Option<&Name>, errors: &mut Vec<Unread>) -> Option<()> {
        let terms = self.terms(side)?;
        if let [(false, factors)] = &terms[..]
            && let [Factor::Grid(grid)] = &factors[..]
        {
            let cells = self.cells(grid, errors)?;
            return self.single(at, &cells, name?);
        }
        if let [(is_minus, factors)] = &terms[..]
            && let [Factor::Scalar(k), Factor::Grid(grid)] = &factors[..]
        {
            // A factor before a matrix.
            let cells = self.cells(grid, errors)?;
            let k = if *is_minus { -*k } else { *k };
            return self.scaled(at, &cells, k, name?);
        }
        self.sum(at, &terms, errors)
    }

    fn push(
        &mut self,
        at: usize,
        place: (usize, usize),
        cell: &(Range<usize>, Syntax),
        candidates: Vec<Quantity>,
    ) {
        self.read.pieces.push(Piece {
            statement: at,
            place: Some((place.0 + 1, place.1 + 1)),
            span: cell.0.clone(),
            syntax: Some(cell.1.clone()),
            value: cell.1.value(),
            candidates,
            row: None,
            is_nameless: false,
            gears: self.gears(cell.1.value()),
            symbol: None,
            uses: vec![],
        });
    }

    fn content_of(&self, cells: &Cells) -> Content {
        let mut content = Content::default();
        for (_, syntax) in cells.iter().flatten() {
            let one = self.content(syntax.value());
            content.accelerations |= one.accelerations;
            content.rates |= one.rates;
            content.gravity |= one.gravity;
        }
        content
    }

    /// One matrix with a name.
    fn single(&mut self, at: usize, cells: &Cells, name: &Name) -> Option<()> {
        // `{}^2J`, `M^{-1}` are no quantities of dynamics.
        if !name.left.is_empty() || name.is_inverse {
            return None;
        }
        let n = self.n;
        let content = self.content_of(cells);
        let columns = cells.first()?.len();
        if !cells.iter().all(|r| r.len() == columns) {
            return None;
        }
        let shape = (cells.len(), columns);
        if shape == (n, n) && n > 1 || n == 1 && shape == (1, 1) {
            if content.accelerations || content.gravity {
                return None;
            }
            if content.rates && is_coriolis(name) {
                for (i, row) in cells.iter().enumerate() {
                    self.coriolis_row(at, i, row);
                }
                return Some(());
            }
            if !content.rates && is_coriolis(name) && !is_inertia(name) || !content.rates && name.base == "C"
            {
                for (i, row) in cells.iter().enumerate() {
                    for (j, cell) in row.iter().enumerate() {
                        self.push(at, (i, j), cell, vec![Quantity::Centrifugal(i, j)]);
                    }
                }
                return Some(());
            }
            if !content.rates && is_inertia(name) {
                for (i, row) in cells.iter().enumerate() {
                    for (j, cell) in row.iter().enumerate() {
                        self.push(at, (i, j), cell, vec![Quantity::Inertia(i, j)]);
                    }
                }
                return Some(());
            }
            if content.rates && name.base.starts_with("dot") {
                return None;
            }
            return None;
        }
        let pairs: Vec<(usize, usize)> = (0..n).flat_map(|j| (j + 1..n).map(move |k| (j, k))).collect();
        if shape == (n, pairs.len()) && n > 1 && !content.rates && !content.gravity && name.base == "B" {
            for (i, row) in cells.iter().enumerate() {
                for (c, cell) in row.iter().enumerate() {
                    let (j, k) = pairs[c];
                    self.push(at, (i, c), cell, vec![Quantity::Coriolis(i, j, k)]);
                }
            }
            return Some(());
        }
        if shape != (n, 1) && shape != (1, n) {
            return None;
        }
        let made = of_vector(name, content);
        if made.is_empty() {
            return None;
        }
        for (i, (place, cell)) in entries(cells).into_iter().enumerate() {
            self.push(at, place, &cell, made.iter().map(|m| m(i)).collect());
        }
        Some(())
    }

    /// A matrix with a factor before it.
    fn scaled(&mut self, at: usize, cells: &Cells, k: Expr, name: &Name) -> Option<()> {
        let first = self.read.pieces.len();
        let content = self.content(k);
        if content.rates
            && is_coriolis(name)
            && cells.len() == self.n
            && cells.iter().all(|r| r.len() == self.n)
        {
            for (i, row) in cells.iter().enumerate() {
                self.coriolis_row(at, i, row);
            }
        } else {
            self.single(at, cells, name)?;
        }
        for piece in &mut self.read.pieces[first..] {
            piece.value = k * piece.value;
            piece.syntax = None;
        }
        Some(())
    }

    fn coriolis_row(&mut self, at: usize, i: usize, row: &[(Range<usize>, Syntax)]) {
        for (j, cell) in row.iter().enumerate() {
            self.push(at, (i, j), cell, vec![Quantity::CoriolisEntry(i, j)]);
            let number = self.read.pieces.len() - 1;
            let entries = self.entries.entry((at, i)).or_insert_with(|| vec![None; self.n]);
            entries[j] = Some(number);
        }
    }

    /// The rows of C that are known.
    pub(super) fn rows(&mut self) {
        for ((_, i), pieces) in &self.entries {
            let Some(pieces) = pieces.iter().copied().collect::<Option<Vec<usize>>>() else { continue };
            let mut value = Expr::int(0);
            for (&p, &rate) in pieces.iter().zip(&self.state.qd) {
                value = value + self.read.pieces[p].value * Expr::from(rate);
                self.read.pieces[p].row = Some(self.read.rows.len());
            }
            self.read.rows.push(Row { pieces, value, joint: *i });
        }
    }

    /// The terms of a side, each with its factors.
    pub(super) fn terms<'s>(&self, side: &'s Side) -> Option<Vec<(bool, Vec<Factor<'s>>)>> {
        let mut terms: Vec<(bool, Vec<Factor<'_>>)> = vec![(false, vec![])];
        for part in &side.parts {
            match part {
                Part::Matrix(grid) => terms.last_mut()?.1.push(Factor::Grid(grid)),
                Part::Text(span) => {
                    for (sign, piece) in segments(self.text, span) {
                        if let Some(is_minus) = sign {
                            let is_open = terms.last().is_some_and(|t| t.1.is_empty());
                            match is_open {
                                true => terms.last_mut()?.0 ^= is_minus,
                                false => terms.push((is_minus, vec![])),
                            }
                        }
                        if piece.is_empty() {
                            continue;
                        }
                        let factor = self.factor(&piece)?;
                        terms.last_mut()?.1.push(factor);
                    }
                }
            }
        }
        terms.retain(|t| !t.1.is_empty());
        (terms.len() <= 12 && !terms.is_empty()).then_some(terms)
    }

    fn factor<'s>(&self, span: &Range<usize>) -> Option<Factor<'s>> {
        let source = self.text.get(span.clone())?;
        let plain =
            crate::custom::plain(source.trim()).replace(['$', '&', ' ', ','], "").replace("boldsymbol", "");
        let plain = plain.replace("mathbf", "").replace("bf", "");
        let column = |all: &[Symbol]| Some(Factor::Column(all.iter().map(|s| Expr::from(*s)).collect()));
        match plain.as_str() {
            "ddotq" | "q\u{308}" | "ddotθ" | "θ\u{308}" | "qdd" | "ddq" | "θddot" => {
                return column(&self.state.qdd);
            }
            "dotq" | "q\u{307}" | "dotθ" | "θ\u{307}" | "qd" | "dq" | "θdot" => {
                return column(&self.state.qd);
            }
            _ => {}
        }
        let syntax = read(self.text, span, &self.read.vocabulary).ok()?;
        Some(Factor::Scalar(syntax.value()))
    }

    /// A sum of products: what multiplies accelerations is the inertia matrix, and so on.
    fn sum(&mut self, at: usize, terms: &[(bool, Vec<Factor<'_>>)], errors: &mut Vec<Unread>) -> Option<()> {
        let n = self.n;
        let mut columns: BTreeMap<Kind, Vec<Expr>> = BTreeMap::new();
        let mut printed: BTreeMap<Kind, Vec<Printed>> = BTreeMap::new();
        let before = self.read.pieces.len();
        for (is_minus, factors) in terms {
            let mut scale = if *is_minus { Expr::int(-1) } else { Expr::int(1) };
            let mut matrices: Vec<(Vec<Vec<Expr>>, Option<Cells>)> = vec![];
            for factor in factors {
                match factor {
                    Factor::Scalar(e) => scale = scale * *e,
                    Factor::Column(v) => matrices.push((v.iter().map(|e| vec![*e]).collect(), None)),
                    Factor::Grid(grid) => {
                        let cells = self.cells(grid, errors)?;
                        let values = cells.iter().map(|r| r.iter().map(|c| c.1.value()).collect()).collect();
                        matrices.push((values, Some(cells)));
                    }
                }
            }
            let is_plain = scale.is_one();
            let (first, rest) = matrices.split_first()?;
            let mut value = first.0.clone();
            for (other, _) in rest {
                value = times(&value, other)?;
            }
            if value.len() != n || value.iter().any(|r| r.len() != 1) {
                return None;
            }
            let column: Vec<Expr> = value.iter().map(|r| scale * r[0]).collect();
            let mut content = Content::default();
            for &e in &column {
                let one = self.content(e);
                content.accelerations |= one.accelerations;
                content.rates |= one.rates;
                content.gravity |= one.gravity;
            }
            let kind = match (content.accelerations, content.rates, content.gravity) {
                (true, false, false) => Kind::Inertial,
                (false, true, false) => Kind::Velocity,
                (false, false, true) => Kind::Gravity,
                (false, true, true) => Kind::Bias,
                _ => Kind::Other,
            };
            let is_column_of = |m: &Vec<Vec<Expr>>, all: &[Symbol]| {
                m.len() == n && m.iter().zip(all).all(|(r, s)| r[..] == [Expr::from(*s)])
            };
            if is_plain
                && let ([(last, _)], Some(cells)) = (rest, &first.1)
                && cells.len() == n
                && cells.iter().all(|r| r.len() == n)
                && kind == Kind::Inertial
                && is_column_of(last, &self.state.qdd)
            {
                for (i, row) in cells.iter().enumerate() {
                    for (j, cell) in row.iter().enumerate() {
                        self.push(at, (i, j), cell, vec![Quantity::Inertia(i, j)]);
                    }
                }
                continue;
            }
            let spans: Vec<Printed> = match (&first.1, is_plain && rest.is_empty()) {
                (Some(cells), true) => {
                    entries(cells).into_iter().map(|(_, (span, s))| (span, Some(s))).collect()
                }
                (Some(cells), false) => {
                    let ends = |r: &Vec<(Range<usize>, Syntax)>| {
                        let (a, b) = (r.first()?, r.last()?);
                        Some((a.0.start..b.0.end, None))
                    };
                    cells.iter().map(ends).collect::<Option<_>>()?
                }
                (None, _) => return None,
            };
            match columns.get_mut(&kind) {
                Some(sum) => {
                    sum.iter_mut().zip(&column).for_each(|(a, b)| *a = *a + *b);
                    // Two parts of one kind are judged together.
                    printed.entry(kind).and_modify(|p| p.iter_mut().for_each(|(_, s)| *s = None));
                }
                None => {
                    columns.insert(kind, column);
                    printed.insert(kind, spans);
                }
            }
        }
        if columns.contains_key(&Kind::Other) {
            self.read.pieces.truncate(before);
            return None;
        }
        for (kind, column) in columns {
            let made: fn(usize) -> Quantity = match kind {
                Kind::Inertial => Quantity::Inertial,
                Kind::Velocity => Quantity::Velocity,
                Kind::Gravity => Quantity::Gravity,
                Kind::Bias => Quantity::Bias,
                Kind::Other => continue,
            };
            let spans = printed.remove(&kind)?;
            for (i, (value, (span, syntax))) in column.into_iter().zip(spans).enumerate() {
                let (place, candidates, row) = (Some((i + 1, 1)), vec![made(i)], None);
                self.read.pieces.push(Piece {
                    statement: at,
                    place,
                    span,
                    syntax,
                    value,
                    candidates,
                    row,
                    is_nameless: false,
                    gears: self.gears(value),
                    symbol: None,
                    uses: vec![],
                });
            }
        }
        Some(())
    }
}

/// Where a part of a sum stands, and how it is printed.
type Printed = (Range<usize>, Option<Syntax>);
/// A place in a matrix, and what stands there.
type Entry = ((usize, usize), (Range<usize>, Syntax));

/// The entries of a column or of a row, with their places.
fn entries(cells: &Cells) -> Vec<Entry> {
    let rows = cells.iter().enumerate();
    rows.flat_map(|(i, row)| row.iter().enumerate().map(move |(j, cell)| ((i, j), cell.clone()))).collect()
}

pub(super) fn times(a: &[Vec<Expr>], b: &[Vec<Expr>]) -> Option<Vec<Vec<Expr>>> {
    let columns = b.first()?.len();
    let fits = a.iter().all(|r| r.len() == b.len()) && b.iter().all(|r| r.len() == columns);
    let entry =
        |row: &Vec<Expr>, c: usize| row.iter().zip(b).fold(Expr::int(0), |sum, (x, r)| sum + *x * r[c]);
    fits.then(|| a.iter().map(|row| (0..columns).map(|c| entry(row, c)).collect()).collect())
}

/// The parts of a text between signs that stand in no bracket: whether a minus stands before, and where the part is.
fn segments(text: &str, span: &Range<usize>) -> Vec<(Option<bool>, Range<usize>)> {
    let source = text.get(span.clone()).unwrap_or_default();
    let mut found: Vec<(Option<bool>, Range<usize>)> = vec![];
    let (mut depth, mut start, mut sign) = (0_i32, span.start, None);
    let mut push = |sign: Option<bool>, from: usize, to: usize| {
        let source = text.get(from..to).unwrap_or_default();
        let mut inner = source.trim();
        for look in
            ["\\cdot", "\\times", "*", "·", "\\,", "\\;", "\\left", "\\right", "\\quad", "&", "\\\\", "."]
        {
            inner = inner.strip_suffix(look).unwrap_or(inner).trim_end();
            inner = inner.strip_prefix(look).unwrap_or(inner).trim_start();
        }
        let at =
            if inner.is_empty() { to } else { from + (inner.as_ptr() as usize - source.as_ptr() as usize) };
        if sign.is_some() || !inner.is_empty() {
            found.push((sign, at..at + inner.len()));
        }
    };
    for (i, c) in source.char_indices() {
        match c {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth -= 1,
            '+' | '-' | '−' if depth == 0 => {
                push(sign, start, span.start + i);
                sign = Some(c != '+');
                start = span.start + i + c.len_utf8();
            }
            _ => {}
        }
    }
    push(sign, start, span.end);
    found
}
