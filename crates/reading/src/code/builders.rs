//! Functions that make matrices and lists.

use super::Dialect;
use super::calls::Given;
use super::known::short;
use super::machine::Machine;
use super::scalar::{Read, Scalar, refuse, refuse_hint};
use super::tree::Span;
use super::value::{Matrix, Object, Sort, object, side};
use denavit_symbolic::Expr;
use std::rc::Rc;

/// Matrices beside each other.
pub(super) fn beside(blocks: &[Matrix], span: &Span) -> Read<Matrix> {
    let Some(first) = blocks.first() else { return refuse(span, "there are no matrices") };
    if let Some(other) = blocks.iter().find(|b| b.rows != first.rows) {
        let message = format!("{} beside {}: the rows do not fit", other.shape(), first.shape());
        return refuse(span, message);
    }
    let columns = side(blocks.iter().map(|b| b.columns).sum(), span)?;
    let row = |r: usize| blocks.iter().flat_map(move |b| (0..b.columns).map(move |c| b.at(r, c).clone()));
    let entries = (0..first.rows).flat_map(row).collect();
    Ok(Matrix::new(first.rows, columns, entries, first.sort))
}

/// Matrices above each other.
pub(super) fn above(blocks: &[Matrix], span: &Span) -> Read<Matrix> {
    let Some(first) = blocks.first() else { return refuse(span, "there are no matrices") };
    if let Some(other) = blocks.iter().find(|b| b.columns != first.columns) {
        let message = format!("{} below {}: the columns do not fit", other.shape(), first.shape());
        return refuse(span, message);
    }
    let rows = side(blocks.iter().map(|b| b.rows).sum(), span)?;
    let entries = blocks.iter().flat_map(|b| b.entries.iter().cloned()).collect();
    Ok(Matrix::new(rows, first.columns, entries, first.sort))
}

/// An array with one index as a row.
fn as_row(m: Matrix) -> Matrix {
    if m.is_flat { Matrix { rows: m.columns, columns: m.rows, is_flat: false, ..m } } else { m }
}

impl<'a> Machine<'a> {
    pub fn build(
        &mut self,
        name: &str,
        sort: Sort,
        given: Given<'a>,
        path: &str,
        span: &Span,
    ) -> Read<Object<'a>> {
        match name {
            "array" | "asarray" | "Matrix" | "matrix" | "mat" | "asmatrix" | "ImmutableMatrix"
            | "asanyarray" => self.array(name, sort, given, path, span),
            "eye" | "identity" | "zeros" | "ones" | "empty" => self.filled(name, sort, given, path, span),
            "zeros_like" | "ones_like" => {
                let m = self.first(given, path, span)?.matrix(sort, span)?;
                let value = Scalar::of(Expr::int(i64::from(name == "ones_like")), span);
                Ok(object(m.map(|_| Ok(value.clone()))?))
            }
            "hstack" | "vstack" | "concatenate" | "column_stack" | "row_stack" | "horzcat" | "vertcat" => {
                self.stacked(name, sort, given, path, span)
            }
            "block" => {
                let value = self.first(given, path, span)?;
                self.blocks(&value, span)
            }
            "diag" => self.diagonal(sort, given, path, span),
            "cell" => {
                let sizes: Vec<i64> = self.sizes(given.positional, span)?;
                let count = sizes.iter().copied().max().unwrap_or(0);
                let count = side(usize::try_from(count).unwrap_or(usize::MAX), span)?;
                Ok(Object::list(vec![Object::Nothing; count]))
            }
            "copy" | "deepcopy" => Ok(self.copied(self.first(given, path, span)?)),
            "squeeze" | "ravel" | "flatten" => {
                let m = self.first(given, path, span)?.matrix(sort, span)?;
                Ok(object(m.view(Matrix::vector(m.entries.clone(), Sort::Array))))
            }
            "len" | "numel" | "length" | "size" | "isempty" | "range" | "enumerate" | "zip" | "list"
            | "tuple" | "reversed" => self.counted(name, given, path, span),
            "print" | "disp" => Ok(Object::Nothing),
            _ => {
                let hint = "only arithmetic, matrices, sines and roots are";
                refuse_hint(span, format!("`{}` is not read", short(path)), hint)
            }
        }
    }

    fn array(
        &mut self,
        name: &str,
        sort: Sort,
        given: Given<'a>,
        path: &str,
        span: &Span,
    ) -> Read<Object<'a>> {
        let mut has_floats = false;
        match given.named("dtype").or(given.positional.get(1).map(|p| &p.0)) {
            None => {}
            Some(Object::Path(kind)) if kind.contains("float") || kind.contains("object") => {
                has_floats = true
            }
            Some(Object::Text(kind)) if kind.starts_with("float") || kind.starts_with('f') => {
                has_floats = true
            }
            Some(value) if sort == Sort::SympyMatrix && given.positional.len() == 3 => {
                // Matrix(rows, columns, entries)
                let columns = value.scalar(span)?.to_integer().and_then(|n| usize::try_from(n).ok());
                let entries = given.positional[2].0.items(Dialect::Python, span)?;
                let entries = entries.iter().map(|e| e.scalar(span).cloned()).collect::<Read<Vec<_>>>()?;
                let Some(columns) = columns.filter(|&c| c > 0 && entries.len() % c == 0) else {
                    return refuse(span, "the size of the matrix does not fit its entries");
                };
                side(columns.max(entries.len() / columns), span)?;
                return Ok(object(Matrix::new(entries.len() / columns, columns, entries, sort)));
            }
            Some(_) => return refuse_hint(span, "this type of entries is not read", "leave `dtype` out"),
        }
        let is_view = name.starts_with("as");
        let value = self.first(given, path, span)?;
        if let Object::Scalar(s) = value {
            return Ok(Object::Scalar(s));
        }
        let is_list = matches!(value, Object::List(_));
        let mut m = value.matrix(sort, span)?;
        self.budget.charge(m.entries.len() as u64, span)?;
        if !is_list {
            let is_changed = m.sort != sort && sort != Sort::Array;
            m = if is_view { m } else { m.fresh() };
            if is_changed {
                m = Matrix { sort, is_flat: false, ..m };
            } else if name == "array" || name == "asarray" {
                m.sort = Sort::Array;
            }
        }
        m.is_whole &= !has_floats;
        Ok(object(m))
    }

    /// The whole numbers of a size: `4`, `4, 4` or `(4, 4)`.
    fn sizes(&self, arguments: Vec<(Object<'a>, Span)>, span: &Span) -> Read<Vec<i64>> {
        let mut sizes = vec![];
        for (argument, place) in arguments {
            let numbers: Vec<Scalar> = match argument {
                Object::Scalar(s) => vec![s],
                Object::Text(_) => continue, // 'double'
                other => other.matrix(Sort::Array, &place)?.entries,
            };
            for number in numbers {
                match number.to_integer().filter(|n| *n >= 0) {
                    Some(n) => sizes.push(n),
                    None => return refuse(span, "a size is a known whole number"),
                }
            }
        }
        Ok(sizes)
    }

    fn filled(
        &mut self,
        name: &str,
        sort: Sort,
        given: Given<'a>,
        path: &str,
        span: &Span,
    ) -> Read<Object<'a>> {
        if let Some((other, ..)) = given.named.iter().find(|(n, ..)| *n != "dtype") {
            return refuse(span, format!("`{other}=` of `{}` is not read", short(path)));
        }
        match given.named("dtype") {
            None => {}
            Some(Object::Path(kind)) if kind.contains("float") || kind.contains("object") => {}
            Some(_) => return refuse_hint(span, "this type of entries is not read", "leave `dtype` out"),
        }
        let is_identity = matches!(name, "eye" | "identity");
        // The second argument of NumPy's `zeros` is a type.
        if sort == Sort::Array && !is_identity && given.positional.len() > 1 {
            return refuse_hint(
                span,
                format!("`{}` takes one size", short(path)),
                "write `np.zeros((4, 4))`",
            );
        }
        let is_tuple = !matches!(given.positional.first(), Some((Object::Scalar(_), _)));
        let sizes = self.sizes(given.positional, span)?;
        let of = |n: i64| usize::try_from(n).unwrap_or(usize::MAX);
        let (rows, columns) = match sizes.as_slice() {
            [] if sort == Sort::Matlab => (1, 1),
            [n] if sort == Sort::Array && !is_identity => (of(*n), 1),
            [n] if !is_tuple || sort == Sort::Array => (of(*n), of(*n)),
            [r, c] => (of(*r), of(*c)),
            // Pages of MATLAB are kept as a list.
            [r, c, n] if sort == Sort::Matlab => {
                let page =
                    self.constant_matrix(side(of(*r), span)?, side(of(*c), span)?, name, sort, span)?;
                return Ok(Object::list(vec![object(page); side(of(*n), span)?]));
            }
            _ => return refuse(span, "this size is not read"),
        };
        let (rows, columns) = (side(rows, span)?, side(columns, span)?);
        let m = self.constant_matrix(rows, columns, name, sort, span)?;
        let is_flat = sort == Sort::Array && !is_identity && sizes.len() == 1;
        Ok(object(Matrix { is_flat, ..m }))
    }

    fn constant_matrix(
        &mut self,
        rows: usize,
        columns: usize,
        name: &str,
        sort: Sort,
        span: &Span,
    ) -> Read<Matrix> {
        self.budget.charge((rows * columns) as u64, span)?;
        let entry = |i: usize| match name {
            "eye" | "identity" => i64::from(i / columns == i % columns),
            "ones" => 1,
            _ => 0,
        };
        let entries = (0..rows * columns).map(|i| Scalar::of(Expr::int(entry(i)), span)).collect();
        Ok(Matrix::new(rows, columns, entries, sort))
    }

    fn stacked(
        &mut self,
        name: &str,
        sort: Sort,
        given: Given<'a>,
        path: &str,
        span: &Span,
    ) -> Read<Object<'a>> {
        let axis = match given.named("axis").or(given.positional.get(1).map(|p| &p.0)) {
            Some(axis) if name == "concatenate" => axis.scalar(span)?.to_integer(),
            _ => Some(0),
        };
        let items = match (sort, &given) {
            // `Matrix.hstack(a, b)` takes them one by one.
            (Sort::SympyMatrix, given) => given.positional.iter().map(|p| p.0.clone()).collect(),
            (Sort::Matlab, given) => given.positional.iter().map(|p| p.0.clone()).collect(),
            _ => self.first(given, path, span)?.items(Dialect::Python, span)?,
        };
        let blocks = items.iter().map(|i| i.matrix(sort, span)).collect::<Read<Vec<Matrix>>>()?;
        let total: u64 = blocks.iter().map(|b| b.entries.len() as u64).sum();
        self.budget.charge(total, span)?;
        let are_flat = blocks.iter().all(|b| b.is_flat);
        let whole = blocks.iter().all(|b| b.is_whole);
        let joined = match (name, axis) {
            ("hstack", _) | ("concatenate", Some(0)) if are_flat => {
                let entries: Vec<Scalar> = blocks.into_iter().flat_map(|b| b.entries).collect();
                side(entries.len(), span)?;
                Matrix::vector(entries, Sort::Array)
            }
            ("concatenate", Some(0 | 1)) | ("hstack", _) if blocks.iter().any(|b| b.is_flat) => {
                let hint = "write it as a column: `p.reshape(3, 1)`";
                return refuse_hint(span, "an array with one index beside a matrix", hint);
            }
            ("hstack" | "horzcat", _) | ("concatenate", Some(1)) => beside(&blocks, span)?,
            ("column_stack", _) => {
                let column = |b: Matrix| Matrix { is_flat: false, ..b };
                beside(&blocks.into_iter().map(column).collect::<Vec<_>>(), span)?
            }
            ("concatenate", Some(0)) | ("vstack" | "row_stack" | "vertcat", _) => {
                above(&blocks.into_iter().map(as_row).collect::<Vec<_>>(), span)?
            }
            _ => return refuse(span, "this axis is not read"),
        };
        Ok(object(Matrix { is_whole: whole, ..joined }))
    }

    /// `np.block([[R, p], [0, 0, 0, 1]])`
    fn blocks(&mut self, value: &Object<'a>, span: &Span) -> Read<Object<'a>> {
        let mut bands = vec![];
        for band in value.items(Dialect::Python, span)? {
            let items = match &band {
                Object::List(items) => items.to_vec(),
                other => vec![other.clone()],
            };
            let mut blocks = vec![];
            for item in items {
                blocks.push(as_row(match item {
                    Object::Scalar(s) => Matrix::new(1, 1, vec![s], Sort::Array),
                    other => other.matrix(Sort::Array, span)?,
                }));
            }
            bands.push(beside(&blocks, span)?);
        }
        Ok(object(above(&bands, span)?))
    }

    fn diagonal(&mut self, sort: Sort, given: Given<'a>, path: &str, span: &Span) -> Read<Object<'a>> {
        let m = match (sort, given.positional.len()) {
            (Sort::SympyMatrix, n) if n != 1 => {
                let entries = given.positional.iter().map(|(o, p)| o.scalar(p).cloned());
                Matrix::vector(entries.collect::<Read<Vec<_>>>()?, Sort::Array)
            }
            _ => self.first(given, path, span)?.matrix(sort, span)?,
        };
        if !m.is_vector() {
            return refuse(span, "the diagonal of a matrix is not read");
        }
        let n = side(m.entries.len(), span)?;
        self.budget.charge((n * n) as u64, span)?;
        let zero = Scalar::of(Expr::int(0), span);
        let entry = |i: usize| if i / n == i % n { m.entries[i / n].clone() } else { zero.clone() };
        Ok(object(Matrix::new(n, n, (0..n * n).map(entry).collect(), sort)))
    }

    /// With storage of its own.
    pub fn copied(&self, value: Object<'a>) -> Object<'a> {
        match value {
            Object::Matrix(m) => Object::Matrix(Rc::new(m.fresh())),
            Object::List(items) => Object::list(items.to_vec()),
            value => value,
        }
    }

    /// Lengths, and what loops go through.
    fn counted(&mut self, name: &str, given: Given<'a>, path: &str, span: &Span) -> Read<Object<'a>> {
        let number = |n: usize| Object::Scalar(Scalar::whole(n, span).named(span));
        if name == "range" {
            let numbers = given.positional.iter().map(|(o, p)| Ok(o.scalar(p)?.to_integer()));
            let numbers: Option<Vec<i64>> = numbers.collect::<Read<Option<_>>>()?;
            let (from, to, step) = match numbers.as_deref() {
                Some([to]) => (0, *to, 1),
                Some([from, to]) => (*from, *to, 1),
                Some([from, to, step]) if *step != 0 => (*from, *to, *step),
                _ => return refuse(span, "a range is between known whole numbers"),
            };
            let mut items = vec![];
            let mut at = from;
            while (step > 0 && at < to) || (step < 0 && at > to) {
                items.push(Object::Scalar(Scalar::of(Expr::int(at), span).wholly(true)));
                side(items.len(), span)?;
                at = at.saturating_add(step);
            }
            return Ok(Object::list(items));
        }
        let second = match given.positional.get(1) {
            Some((o, p)) if name != "zip" => o.scalar(p)?.to_integer(),
            _ => None,
        };
        if name == "zip" {
            let lists = given.positional.iter().map(|(o, p)| o.items(Dialect::Python, p));
            let lists = lists.collect::<Read<Vec<Vec<Object<'a>>>>>()?;
            let length = lists.iter().map(Vec::len).min().unwrap_or(0);
            return Ok(Object::list(
                (0..length).map(|i| Object::list(lists.iter().map(|l| l[i].clone()).collect())).collect(),
            ));
        }
        let value = self.first(given, path, span)?;
        let (rows, columns) = match &value {
            Object::Matrix(m) => (m.rows, m.columns),
            Object::List(items) => (1, items.len()),
            Object::Nothing => (0, 0),
            _ => (1, 1),
        };
        Ok(match name {
            "len" => match &value {
                Object::Matrix(m) if m.sort == Sort::SympyMatrix => number(m.entries.len()),
                Object::Matrix(m) => number(m.rows),
                Object::List(items) => number(items.len()),
                other => return refuse(span, format!("{} has no length", other.about())),
            },
            "numel" => number(rows * columns),
            "length" => number(rows.max(columns)),
            "isempty" => Object::Bool(rows * columns == 0),
            "size" => match second {
                Some(1) => number(rows),
                Some(2) => number(columns),
                Some(_) => number(1),
                None => Object::list(vec![number(rows), number(columns)]),
            },
            "list" | "tuple" => Object::list(value.items(Dialect::Python, span)?),
            "reversed" => {
                let mut items = value.items(Dialect::Python, span)?;
                items.reverse();
                Object::list(items)
            }
            _ => {
                let start = second.unwrap_or(0);
                let items = value.items(Dialect::Python, span)?.into_iter().enumerate();
                let index = |i: usize| {
                    let n = Expr::int(start.saturating_add(i as i64));
                    Object::Scalar(Scalar::of(n, span).wholly(true))
                };
                Object::list(items.map(|(i, item)| Object::list(vec![index(i), item])).collect())
            }
        })
    }
}
