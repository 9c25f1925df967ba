//! Indices: what they pick, and how entries are set.

use super::machine::Machine;
use super::scalar::{Read, Scalar, refuse, refuse_hint};
use super::tree::{Kind, Node, Span, Suffix, SuffixKind};
use super::value::{Matrix, Object, Sort, object, side};
use super::{Dialect, MAX_LISTS};
use denavit_symbolic::Expr;
use std::rc::Rc;

/// What one index picks, from 0 on.
#[derive(Clone, Debug)]
pub(super) enum Pick {
    One(usize),
    Many(Vec<usize>),
    /// `:`
    All(usize),
}

impl Pick {
    fn list(&self) -> Vec<usize> {
        match self {
            Pick::One(i) => vec![*i],
            Pick::Many(all) => all.clone(),
            Pick::All(n) => (0..*n).collect(),
        }
    }

    fn last(&self) -> usize {
        self.list().into_iter().max().map_or(0, |i| i + 1)
    }
}

/// One pair of brackets.
#[derive(Debug)]
pub(super) struct Step {
    picks: Vec<Pick>,
    is_cell: bool,
}

impl Step {
    /// The place of a single entry of a vector.
    pub fn single(&self) -> Option<usize> {
        match self.picks[..] {
            [Pick::One(k)] => Some(k),
            _ => None,
        }
    }
}

impl<'a> Machine<'a> {
    /// What an index picks of `length`; beyond it only if entries are set.
    fn pick(&mut self, node: &'a Node, length: usize, grows: bool) -> Read<Pick> {
        self.ends.push(length);
        let picked = self.pick_inner(node, length, grows);
        self.ends.pop();
        picked
    }

    fn pick_inner(&mut self, node: &'a Node, length: usize, grows: bool) -> Read<Pick> {
        match &node.kind {
            Kind::All => return Ok(Pick::All(length)),
            Kind::Slice(parts) => return self.slice(parts, length, &node.span),
            _ => {}
        }
        let value = self.eval(node)?;
        self.budget.charge(value.weight(), &node.span)?;
        let is_range = matches!(value, Object::Matrix(_) | Object::List(_));
        let entries: Vec<Scalar> = match &value {
            Object::Scalar(s) => vec![s.clone()],
            Object::Matrix(m) => m.entries.clone(),
            Object::List(items) => {
                items.iter().map(|i| i.scalar(&node.span).cloned()).collect::<Read<_>>()?
            }
            other => return refuse(&node.span, format!("{} is not an index that is read", other.about())),
        };
        let mut picked = vec![];
        for entry in entries {
            let Some(n) = entry.to_integer() else {
                return refuse(&node.span, "an index is a known whole number");
            };
            let from_zero = match self.language {
                Dialect::Python if n < 0 => n.checked_add(length as i64),
                Dialect::Python | Dialect::C => Some(n),
                Dialect::Matlab => n.checked_sub(1),
            };
            let index = from_zero.and_then(|i| usize::try_from(i).ok());
            let Some(index) = index.filter(|&i| i < length || (grows && i < 4096)) else {
                let first = if self.language == Dialect::Python { "0" } else { "1" };
                let message = format!("index {n} is out of range: there are {length}");
                return refuse_hint(&node.span, message, format!("the first index is {first}"));
            };
            picked.push(index);
        }
        Ok(match (is_range, picked.as_slice()) {
            (false, [one]) => Pick::One(*one),
            _ => Pick::Many(picked),
        })
    }

    fn slice(&mut self, parts: &'a [Option<Node>; 3], length: usize, span: &Span) -> Read<Pick> {
        let mut numbers = [None; 3];
        for (part, number) in parts.iter().zip(&mut numbers) {
            let Some(part) = part else { continue };
            let value = self.eval(part)?;
            if matches!(value, Object::Nothing) {
                continue;
            }
            *number = value.scalar(&part.span)?.to_integer();
            if number.is_none() {
                return refuse(&part.span, "an index is a known whole number");
            }
        }
        let n = length as i64;
        let step = numbers[2].unwrap_or(1);
        let bound = |x: Option<i64>, default: i64| match x {
            Some(x) if x < 0 => x.saturating_add(n).clamp(if step < 0 { -1 } else { 0 }, n),
            Some(x) => x.clamp(0, n),
            None => default,
        };
        let mut picked = vec![];
        if step > 0 {
            let (mut i, to) = (bound(numbers[0], 0), bound(numbers[1], n));
            while i < to {
                picked.push(i as usize);
                i = i.saturating_add(step);
            }
        } else if step < 0 {
            let (mut i, to) = (bound(numbers[0], n - 1).min(n - 1), bound(numbers[1], -1));
            while i > to {
                picked.push(i as usize);
                i = i.saturating_add(step);
            }
        } else {
            return refuse(span, "the step is 0");
        }
        Ok(Pick::Many(picked))
    }

    /// What the brackets behind a value pick.
    pub fn step(
        &mut self,
        value: &Object<'a>,
        items: Vec<&'a Node>,
        is_cell: bool,
        span: &Span,
        grows: bool,
    ) -> Read<Step> {
        let grows = grows && self.language == Dialect::Matlab;
        let lengths: Vec<usize> = match (value, items.len()) {
            (Object::Matrix(m), 1) => vec![match m.sort {
                Sort::Matlab | Sort::SympyMatrix => m.entries.len(),
                _ => m.rows,
            }],
            (Object::Matrix(m), 2) if m.is_flat => {
                return refuse(span, format!("two indices into an array of {}", m.shape()));
            }
            (Object::Matrix(m), 2) => vec![m.rows, m.columns],
            (Object::Scalar(_), n) if self.language == Dialect::Matlab && n > 0 => vec![1; n],
            (Object::List(items), 1) => vec![items.len()],
            (Object::List(items), 2) if is_cell => vec![1, items.len()],
            // The pages of `A(:,:,i)` are kept as a list.
            (Object::List(items), 3) if self.language == Dialect::Matlab => vec![1, 1, items.len()],
            (_, n) => {
                return refuse(span, format!("{} with {n} indices is not read", value.about()));
            }
        };
        let mut picks = vec![];
        let is_one = items.len() == 1;
        for (item, length) in items.into_iter().zip(lengths) {
            let pick = self.pick(item, length, grows)?;
            let is_slice = matches!(item.kind, Kind::Slice(_));
            if matches!(pick, Pick::Many(_)) && !is_slice && !is_one && self.language == Dialect::Python {
                return refuse_hint(
                    &item.span,
                    "a list as an index is not read",
                    "write slices: `T[0:3, 0:3]`",
                );
            }
            picks.push(pick);
        }
        Ok(Step { picks, is_cell })
    }

    /// What was picked.
    pub fn picked(&mut self, value: &Object<'a>, step: &Step, span: &Span) -> Read<Object<'a>> {
        let picked = match value {
            Object::List(items) => {
                let pick = step.picks.last().map_or(Pick::All(items.len()), Pick::clone);
                match pick {
                    Pick::One(i)
                        if step.is_cell || self.language == Dialect::Python || step.picks.len() == 3 =>
                    {
                        items.get(i).cloned().unwrap_or(Object::Nothing)
                    }
                    many => Object::list(many.list().iter().filter_map(|&i| items.get(i).cloned()).collect()),
                }
            }
            Object::Scalar(s) => Object::Scalar(s.clone()),
            Object::Matrix(m) => self.of_matrix(m, &step.picks, span)?,
            other => return refuse(span, format!("{} has no entries", other.about())),
        };
        Ok(match picked {
            Object::Scalar(s) => Object::Scalar(s.named(span)),
            Object::Nothing if self.language == Dialect::Matlab => {
                return refuse(span, "this cell is empty");
            }
            picked => picked,
        })
    }

    fn of_matrix(&mut self, m: &Matrix, picks: &[Pick], span: &Span) -> Read<Object<'a>> {
        let count = picks.iter().fold(1_u64, |n, p| n.saturating_mul(p.list().len() as u64));
        self.budget.charge(count, span)?;
        let all: Vec<usize> = (0..m.columns).collect();
        let line = |entries: Vec<Scalar>| m.view(Matrix::vector(entries, Sort::Array));
        Ok(match (picks, m.sort) {
            ([pick], Sort::Matlab) => {
                let by_columns = |i: usize| m.at(i % m.rows, i / m.rows).clone();
                let entries: Vec<Scalar> = pick.list().into_iter().map(by_columns).collect();
                let n = entries.len();
                let is_column = match pick {
                    Pick::All(_) => true,
                    _ => m.columns == 1 && m.rows > 1,
                };
                let (rows, columns) = if is_column { (n, 1) } else { (1, n) };
                object(Matrix::new(rows, columns, entries, Sort::Matlab))
            }
            ([Pick::One(i)], Sort::SympyMatrix) => Object::Scalar(m.entries[*i].clone()),
            ([pick], Sort::SympyMatrix) => {
                Object::list(pick.list().iter().map(|&i| Object::Scalar(m.entries[i].clone())).collect())
            }
            ([Pick::One(i)], _) if m.is_flat => Object::Scalar(m.entries[*i].clone()),
            ([pick], _) if m.is_flat => {
                object(line(pick.list().iter().map(|&i| m.entries[i].clone()).collect()))
            }
            ([Pick::One(i)], _) => m.row_object(*i),
            ([pick], _) => object(m.part(&pick.list(), &all)),
            ([Pick::One(r), Pick::One(c)], _) => Object::Scalar(m.at(*r, *c).clone()),
            ([r, c], sort) => {
                let part = m.part(&r.list(), &c.list());
                let is_line = matches!(r, Pick::One(_)) || matches!(c, Pick::One(_));
                match sort {
                    Sort::Array if is_line => object(line(part.entries)),
                    _ => object(part),
                }
            }
            _ => return refuse(span, "more than two indices are not read"),
        })
    }

    /// The places behind a name, `[0][3]`.
    pub fn steps(&mut self, value: &Object<'a>, suffixes: &'a [Suffix], span: &Span) -> Read<Vec<Step>> {
        let (mut steps, mut value) = (vec![], value.clone());
        for (k, suffix) in suffixes.iter().enumerate() {
            let (items, is_cell): (Vec<&'a Node>, bool) = match &suffix.kind {
                SuffixKind::Index(items) => (self.indices(items), false),
                SuffixKind::Cell(items) => (items.iter().collect(), true),
                SuffixKind::Call(arguments) if self.language == Dialect::Matlab => {
                    (arguments.iter().map(|a| &a.value).collect(), false)
                }
                _ => return refuse(span, "what is assigned to is not a name or its entries"),
            };
            // What does not exist yet is made by MATLAB.
            if let (Object::Nothing, Dialect::Matlab) = (&value, self.language) {
                value = match is_cell || items.len() == 3 {
                    true => Object::list(vec![]),
                    false => object(Matrix::new(0, 0, vec![], Sort::Matlab)),
                };
            }
            let step = self.step(&value, items, is_cell, span, true)?;
            if k + 1 < suffixes.len() {
                value = match (&value, step.picks.last()) {
                    (Object::List(items), Some(Pick::One(i))) if *i >= items.len() => Object::Nothing,
                    _ => self.picked(&value, &step, span)?,
                };
            }
            steps.push(step);
        }
        Ok(steps)
    }

    /// The parts of an index: `[i, j]` or `[(i, j)]`.
    pub fn indices(&self, items: &'a [Node]) -> Vec<&'a Node> {
        match items {
            [Node { kind: Kind::Bracket(inner), .. }] => match &inner.kind {
                Kind::Tuple(parts) => parts.iter().collect(),
                _ => items.iter().collect(),
            },
            _ => items.iter().collect(),
        }
    }

    /// Sets entries.
    pub fn set(
        &mut self,
        place: &mut Object<'a>,
        steps: &[Step],
        value: Object<'a>,
        span: &Span,
    ) -> Read<()> {
        let Some((step, rest)) = steps.split_first() else {
            *place = value;
            return Ok(());
        };
        let is_python = self.language == Dialect::Python;
        if let (Object::Nothing | Object::Scalar(_), false) = (&*place, is_python) {
            *place = match (step.is_cell || step.picks.len() == 3, &*place) {
                (true, _) => Object::list(vec![]),
                (false, Object::Scalar(s)) => {
                    Object::Matrix(Rc::new(Matrix::new(1, 1, vec![s.clone()], Sort::Matlab)))
                }
                _ => Object::Matrix(Rc::new(Matrix::new(0, 0, vec![], Sort::Matlab))),
            };
        }
        if is_python && is_aliased(place) {
            let hint = "make a copy first: `T = T.copy()`";
            return refuse_hint(span, "other names may stand for the same array, and change with it", hint);
        }
        match place {
            Object::List(items) => {
                let Some(Pick::One(i)) = step.picks.last() else {
                    return refuse(span, "several items of a list are not set at once");
                };
                side(*i, span)?;
                self.budget.charge(items.len() as u64 / 8, span)?;
                let items = Rc::make_mut(items);
                let mut item = items.take(*i);
                self.set(&mut item, rest, value, span)?;
                items.put(*i, item);
                shallow(place, span)
            }
            Object::Matrix(m) => {
                let mut picks = step.picks.clone();
                if let ([Pick::One(_)], [next], false) = (picks.as_slice(), rest, m.is_flat) {
                    picks.extend(next.picks.iter().cloned()); // T[0][3]
                } else if !rest.is_empty() {
                    return refuse_hint(span, "these entries are not set", "write `T[0, 3] = …`");
                }
                let m = Rc::make_mut(m);
                self.budget.charge(1, span)?;
                self.set_matrix(m, &picks, &value, span)
            }
            other => refuse(span, format!("{} has no entries", other.about())),
        }
    }

    fn set_matrix(&mut self, m: &mut Matrix, picks: &[Pick], value: &Object<'a>, span: &Span) -> Read<()> {
        let (rows, columns) = match (picks, m.sort) {
            ([pick], _) if m.is_flat || m.columns == 1 && m.rows > 1 => (pick.list(), vec![0]),
            ([pick], Sort::Matlab) if m.rows <= 1 => (vec![0], pick.list()),
            ([Pick::One(i)], Sort::Matlab) if *i < m.entries.len() => (vec![i % m.rows], vec![i / m.rows]),
            ([Pick::One(i)], Sort::SympyMatrix) => (vec![i / m.columns], vec![i % m.columns]),
            ([pick], Sort::Array | Sort::NumpyMatrix) => (pick.list(), (0..m.columns).collect()),
            ([r, c], _) => {
                // `A(:, 1) = v` gives a new matrix its rows.
                let of_value = |pick: &Pick, n: usize| match pick {
                    Pick::All(0) if m.sort == Sort::Matlab => (0..n).collect(),
                    pick => pick.list(),
                };
                let (nr, nc) = match value {
                    Object::Matrix(v) if v.is_vector() => (v.entries.len(), v.entries.len()),
                    Object::Matrix(v) => (v.rows, v.columns),
                    _ => (1, 1),
                };
                (of_value(r, nr), of_value(c, nc))
            }
            _ => return refuse(span, "these entries are not set"),
        };
        let (last_row, last_column) = match picks {
            [_, _] | [_] => (Pick::Many(rows.clone()).last(), Pick::Many(columns.clone()).last()),
            _ => (0, 0),
        };
        if last_row > m.rows || last_column > m.columns {
            self.grow(m, last_row, last_column, span)?;
        }
        let count = rows.len() * columns.len();
        let sort = if m.sort == Sort::Matlab { Sort::Matlab } else { Sort::Array };
        let entries: Vec<Scalar> = match value {
            Object::Scalar(s) => vec![s.clone(); count],
            other => {
                let v = other.matrix(sort, span)?;
                let is_line = v.is_vector() && (rows.len() == 1 || columns.len() == 1);
                if v.entries.len() != count
                    || !(is_line || (v.rows, v.columns) == (rows.len(), columns.len()))
                {
                    let message =
                        format!("{} is not set to {}×{} entries", other.about(), rows.len(), columns.len());
                    return refuse(span, message);
                }
                v.entries
            }
        };
        self.budget.charge(count as u64, span)?;
        if m.is_whole && entries.iter().any(|e| !is_integer(e)) {
            let message = "the array is of whole numbers: NumPy cuts off what is assigned to it";
            return refuse_hint(span, message, "write `1.0` for one of its numbers, or `dtype=float`");
        }
        let mut entries = entries.into_iter();
        for &r in &rows {
            for &c in &columns {
                if let (Some(place), Some(entry)) = (m.entries.get_mut(r * m.columns + c), entries.next()) {
                    *place = entry;
                }
            }
        }
        Ok(())
    }

    fn grow(&mut self, m: &mut Matrix, rows: usize, columns: usize, span: &Span) -> Read<()> {
        let (rows, columns) = (side(rows.max(m.rows), span)?, side(columns.max(m.columns), span)?);
        self.budget.charge((rows * columns) as u64, span)?;
        let zero = Scalar::of(Expr::int(0), span);
        let entries = (0..rows * columns)
            .map(|i| match (i / columns < m.rows, i % columns < m.columns) {
                (true, true) => m.at(i / columns, i % columns).clone(),
                _ => zero.clone(),
            })
            .collect();
        *m = Matrix::new(rows, columns, entries, m.sort);
        Ok(())
    }
}

/// Checks that lists are not nested too deep.
pub(super) fn shallow(value: &Object, span: &Span) -> Read<()> {
    if value.depth() > MAX_LISTS {
        return refuse(span, format!("lists and functions are nested more than {MAX_LISTS} deep"));
    }
    Ok(())
}

fn is_integer(s: &Scalar) -> bool {
    s.expr.as_number().is_some_and(|r| r.is_integer())
}

/// True if something else may hold the same storage.
pub(super) fn is_aliased(value: &Object) -> bool {
    match value {
        Object::Matrix(m) => Rc::strong_count(m) > 1 || Rc::strong_count(&m.storage) > 1,
        Object::List(items) => Rc::strong_count(items) > 1,
        _ => false,
    }
}
