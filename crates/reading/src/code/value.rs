//! What a program computes with: scalars, matrices, lists and functions.

use super::scalar::{Budget, Read, Scalar, combined, refuse, refuse_hint};
use super::tree::{Definition, Op, Span};
use super::{Dialect, MAX_SIDE};
use denavit_symbolic::Expr;
use std::collections::BTreeMap;
use std::rc::Rc;

#[derive(Clone, Debug)]
pub(super) enum Object<'a> {
    Scalar(Scalar),
    Matrix(Rc<Matrix>),
    /// A list or tuple of Python, a cell array of MATLAB.
    List(Rc<Items<'a>>),
    Text(Rc<str>),
    Bool(bool),
    Nothing,
    /// A function of the text.
    Function(Rc<Closure<'a>>),
    /// A module or one of its functions, `numpy.linalg.inv`.
    Path(Rc<str>),
}

/// The items of a list, and how deep lists are nested in it.
#[derive(Clone, Debug)]
pub(super) struct Items<'a> {
    items: Vec<Object<'a>>,
    depth: usize,
}

impl<'a> std::ops::Deref for Items<'a> {
    type Target = [Object<'a>];
    fn deref(&self) -> &Self::Target {
        &self.items
    }
}

impl<'a> Items<'a> {
    pub fn new(items: Vec<Object<'a>>) -> Self {
        let depth = items.iter().map(Object::depth).max().unwrap_or(0) + 1;
        Items { items, depth }
    }

    pub fn push(&mut self, item: Object<'a>) {
        self.depth = self.depth.max(item.depth() + 1);
        self.items.push(item);
    }

    /// The item at a place, taken out; those before it are made.
    pub fn take(&mut self, i: usize) -> Object<'a> {
        while self.items.len() <= i {
            self.items.push(Object::Nothing);
        }
        std::mem::replace(&mut self.items[i], Object::Nothing)
    }

    pub fn put(&mut self, i: usize, item: Object<'a>) {
        self.depth = self.depth.max(item.depth() + 1);
        if let Some(place) = self.items.get_mut(i) {
            *place = item;
        }
    }
}

#[derive(Debug)]
pub(super) struct Closure<'a> {
    pub definition: &'a Definition,
    /// Where it is defined, as long as that runs.
    pub home: Option<(usize, u64)>,
    /// The values that it took along.
    pub captured: BTreeMap<&'a str, Object<'a>>,
}

/// Which products and indices a matrix has.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Sort {
    /// NumPy's arrays: `*` goes entry by entry.
    Array,
    /// `np.matrix`
    NumpyMatrix,
    /// `sympy.Matrix`
    SympyMatrix,
    Matlab,
}

#[derive(Clone, Debug)]
pub(super) struct Matrix {
    pub rows: usize,
    pub columns: usize,
    /// By rows.
    pub entries: Vec<Scalar>,
    /// An array with one index; it is kept as a column.
    pub is_flat: bool,
    pub sort: Sort,
    /// An array of `int`, which cuts off what is assigned to it.
    pub is_whole: bool,
    /// The same for arrays that are views of one another.
    pub storage: Rc<()>,
}

impl Matrix {
    pub fn new(rows: usize, columns: usize, entries: Vec<Scalar>, sort: Sort) -> Self {
        Matrix { rows, columns, entries, is_flat: false, sort, is_whole: false, storage: Rc::new(()) }
    }

    /// An array with one index, or a row of MATLAB.
    pub fn vector(entries: Vec<Scalar>, sort: Sort) -> Self {
        let n = entries.len();
        let (rows, columns) = if sort == Sort::Matlab { (1, n) } else { (n, 1) };
        Matrix { is_flat: sort == Sort::Array, ..Matrix::new(rows, columns, entries, sort) }
    }

    pub fn at(&self, r: usize, c: usize) -> &Scalar {
        &self.entries[r * self.columns + c]
    }

    pub fn is_vector(&self) -> bool {
        self.rows == 1 || self.columns == 1
    }

    pub fn transposed(&self) -> Self {
        if self.is_flat {
            return self.clone();
        }
        let entries =
            (0..self.columns).flat_map(|c| (0..self.rows).map(move |r| self.at(r, c).clone())).collect();
        self.view(Matrix::new(self.columns, self.rows, entries, self.sort))
    }

    /// The entries from row and column on, `rows`×`columns` of them.
    pub fn part(&self, rows: &[usize], columns: &[usize]) -> Self {
        let entries =
            rows.iter().flat_map(|&r| columns.iter().map(move |&c| self.at(r, c).clone())).collect();
        self.view(Matrix::new(rows.len(), columns.len(), entries, self.sort))
    }

    /// The matrix as a view of this one.
    pub fn view(&self, m: Matrix) -> Self {
        Matrix { is_whole: self.is_whole, storage: self.storage.clone(), ..m }
    }

    /// A copy with storage of its own.
    pub fn fresh(&self) -> Self {
        Matrix { storage: Rc::new(()), ..self.clone() }
    }

    /// Every entry by a function.
    pub fn map(&self, f: impl FnMut(&Scalar) -> Read<Scalar>) -> Read<Self> {
        let entries = self.entries.iter().map(f).collect::<Read<Vec<Scalar>>>()?;
        Ok(Matrix { entries, is_whole: false, storage: Rc::new(()), ..*self })
    }

    /// For messages.
    pub fn shape(&self) -> String {
        if self.is_flat {
            format!("{} entries", self.rows)
        } else {
            format!("{}×{}", self.rows, self.columns)
        }
    }

    /// With the fact that it holds `int` only.
    pub fn with_wholeness(mut self) -> Self {
        self.is_whole =
            self.sort == Sort::Array && !self.entries.is_empty() && self.entries.iter().all(|e| e.is_whole);
        self
    }
}

/// A matrix as a value: of MATLAB a single entry is a scalar.
pub(super) fn object<'a>(m: Matrix) -> Object<'a> {
    match (m.sort, m.entries.as_slice()) {
        (Sort::Matlab, [one]) => Object::Scalar(one.clone()),
        _ => Object::Matrix(Rc::new(m)),
    }
}

/// Entry by entry, with what NumPy stretches.
pub(super) fn each(op: Op, a: &Matrix, b: &Matrix, budget: &mut Budget, span: &Span) -> Read<Matrix> {
    // An array with one index is a row here.
    let shape = |m: &Matrix| if m.is_flat { (1, m.rows) } else { (m.rows, m.columns) };
    let ((ra, ca), (rb, cb)) = (shape(a), shape(b));
    let stretched = |x: usize, y: usize| match (x, y) {
        _ if x == y => Some(x),
        (1, n) | (n, 1) => Some(n),
        _ => None,
    };
    let (Some(rows), Some(columns)) = (stretched(ra, rb), stretched(ca, cb)) else {
        return refuse(span, format!("the sizes {} and {} do not fit", a.shape(), b.shape()));
    };
    side(rows.max(columns), span)?;
    let pick = |m: &Matrix, (rows, columns): (usize, usize), r: usize, c: usize| {
        m.entries[(if rows == 1 { 0 } else { r }) * columns + if columns == 1 { 0 } else { c }].clone()
    };
    let mut entries = vec![];
    for r in 0..rows {
        for c in 0..columns {
            entries.push(combined(op, &pick(a, (ra, ca), r, c), &pick(b, (rb, cb), r, c), budget, span)?);
        }
    }
    if a.is_flat && b.is_flat {
        return Ok(Matrix::vector(entries, a.sort).with_wholeness());
    }
    let sort = if a.sort == Sort::Array { b.sort } else { a.sort };
    Ok(Matrix::new(rows, columns, entries, sort).with_wholeness())
}

/// The matrix product.
pub(super) fn product<'a>(a: &Matrix, b: &Matrix, budget: &mut Budget, span: &Span) -> Read<Object<'a>> {
    // On the left an array with one index is a row.
    let (ra, ca) = if a.is_flat { (1, a.rows) } else { (a.rows, a.columns) };
    if ca != b.rows {
        let (a, b) = (a.shape(), b.shape());
        return refuse(span, format!("the sizes {a} and {b} do not fit in a product"));
    }
    let mut entries = Vec::with_capacity(ra * b.columns);
    for r in 0..ra {
        for c in 0..b.columns {
            let mut sum = Scalar::of(Expr::int(0), span);
            sum.is_whole = true;
            for k in 0..ca {
                let (x, y) = (&a.entries[r * ca + k], b.at(k, c));
                let term = combined(Op::Mul, x, y, budget, span)?;
                sum = combined(Op::Add, &sum, &term, budget, span)?;
            }
            entries.push(sum.unwritten(span));
        }
    }
    if a.is_flat
        && b.is_flat
        && let Some(sum) = entries.pop()
    {
        return Ok(Object::Scalar(sum));
    }
    let sort = if a.sort == Sort::Array { b.sort } else { a.sort };
    let product = if a.is_flat || b.is_flat {
        Matrix { sort, ..Matrix::vector(entries, Sort::Array) }
    } else {
        Matrix::new(ra, b.columns, entries, sort)
    };
    Ok(object(product.with_wholeness()))
}

/// The inverse of a rotation or of a rigid motion.
pub(super) fn inverse(m: &Matrix, budget: &mut Budget, span: &Span) -> Read<Matrix> {
    if m.rows != m.columns || m.is_flat {
        return refuse(span, format!("a matrix of {} has no inverse", m.shape()));
    }
    let n = m.rows;
    budget.charge((n * n * n) as u64 * 8, span)?;
    let all: Vec<Expr> = m.entries.iter().map(|e| e.expr).collect();
    budget.charge(4 * Expr::postorder(&all).len() as u64, span)?;
    if is_orthogonal(m, n) {
        return Ok(Matrix { is_whole: false, ..m.transposed() });
    }
    let last = n - 1;
    let is_rigid = n > 1
        && (0..n).all(|c| if c == last { m.at(last, c).expr.is_one() } else { m.at(last, c).expr.is_zero() })
        && is_orthogonal(m, last);
    if !is_rigid {
        let hint = "only rotations and homogeneous matrices are inverted";
        return refuse_hint(span, "this inverse is not read", hint);
    }
    // R, p ↦ Rᵀ, −Rᵀ p
    let all: Vec<usize> = (0..last).collect();
    let r_t = m.part(&all, &all).transposed();
    let Object::Matrix(p) = object(Matrix { sort: Sort::SympyMatrix, ..m.part(&all, &[last]) }) else {
        return refuse(span, "this inverse is not read");
    };
    let mut entries = vec![];
    for r in 0..n {
        for c in 0..n {
            entries.push(match (r == last, c == last) {
                (true, _) => m.at(r, c).unwritten(span),
                (_, false) => r_t.at(r, c).unwritten(span),
                _ => {
                    let zero = Scalar::of(Expr::int(0), span);
                    let minus = |sum: Scalar, k: usize| {
                        let term = combined(Op::Mul, r_t.at(r, k), p.at(k, 0), budget, span)?;
                        combined(Op::Sub, &sum, &term, budget, span)
                    };
                    (0..last).try_fold(zero, minus)?
                }
            });
        }
    }
    Ok(Matrix::new(n, n, entries, m.sort))
}

/// True if the first `n` rows and columns are a rotation or reflection, tried at two places.
fn is_orthogonal(m: &Matrix, n: usize) -> bool {
    [0.7318, 1.6273].iter().all(|&place| {
        // Names that come one after another get values far apart.
        let value = |name: &str| {
            let mixed =
                name.bytes().fold(place, |x: f64, b| (x * 7.31 + f64::from(b) * 0.377).rem_euclid(3.0));
            0.2 + mixed
        };
        let entry = |r: usize, c: usize| m.at(r, c).expr.eval(|s| Some(value(&s.name()))).unwrap_or(f64::NAN);
        let rows: Vec<Vec<f64>> = (0..n).map(|r| (0..n).map(|c| entry(r, c)).collect()).collect();
        (0..n).all(|i| {
            (0..=i).all(|j| {
                let dot: f64 = (0..n).map(|k| rows[i][k] * rows[j][k]).sum();
                (dot - f64::from(u8::from(i == j))).abs() < 1e-9
            })
        })
    })
}

/// Checks the length of a side.
pub(super) fn side(n: usize, span: &Span) -> Read<usize> {
    if n > MAX_SIDE {
        return refuse(span, format!("a matrix has at most {MAX_SIDE} rows and columns"));
    }
    Ok(n)
}

impl<'a> Object<'a> {
    pub fn list(items: Vec<Object<'a>>) -> Self {
        Object::List(Rc::new(Items::new(items)))
    }

    /// How deep lists and functions are nested in it.
    pub fn depth(&self) -> usize {
        match self {
            Object::List(items) => items.depth,
            Object::Function(f) => f.captured.values().map(Object::depth).max().unwrap_or(0) + 1,
            _ => 0,
        }
    }

    /// The number of its entries, for work that goes through them.
    pub fn weight(&self) -> u64 {
        match self {
            Object::Matrix(m) => m.entries.len() as u64,
            Object::List(items) => items.len() as u64,
            Object::Text(text) => text.len() as u64 / 16,
            _ => 1,
        }
    }

    /// In words, for messages.
    pub fn about(&self) -> String {
        match self {
            Object::Scalar(_) => "a number".to_string(),
            Object::Matrix(m) if m.is_flat => format!("an array of {}", m.shape()),
            Object::Matrix(m) => format!("a {} matrix", m.shape()),
            Object::List(items) => format!("a list of {}", items.len()),
            Object::Text(_) => "a text".to_string(),
            Object::Bool(_) => "a truth value".to_string(),
            Object::Nothing => "nothing".to_string(),
            Object::Function(f) => format!("the function `{}`", f.definition.name),
            Object::Path(path) => format!("`{path}`"),
        }
    }

    /// A matrix, from lists as `np.array` makes it.
    pub fn matrix(&self, sort: Sort, span: &Span) -> Read<Matrix> {
        let items = match self {
            Object::Matrix(m) => return Ok(Matrix::clone(m)),
            Object::Scalar(s) => return Ok(Matrix::new(1, 1, vec![s.clone()], sort)),
            Object::List(items) => items,
            other => return refuse(span, format!("a matrix is expected here, found {}", other.about())),
        };
        side(items.len(), span)?;
        let mut entries = vec![];
        let mut lengths = vec![];
        for item in items.iter() {
            match item {
                Object::Scalar(s) => entries.push(s.clone()),
                Object::List(row) => {
                    for entry in row.iter() {
                        let entry = entry.scalar(span)?;
                        entries.push(entry.clone());
                    }
                    lengths.push(row.len());
                }
                Object::Matrix(row) if row.is_flat || row.rows == 1 => {
                    entries.extend(row.entries.iter().cloned());
                    lengths.push(row.entries.len());
                }
                other => return refuse(span, format!("an entry of a matrix is {}", other.about())),
            }
        }
        if lengths.is_empty() {
            let is_column = sort == Sort::SympyMatrix;
            let m = Matrix::vector(entries, sort);
            return Ok(match sort {
                Sort::NumpyMatrix => Matrix { is_flat: false, ..m.row() },
                _ => Matrix { is_flat: !is_column && m.is_flat, ..m },
            }
            .with_wholeness());
        }
        let columns = lengths[0];
        if lengths.len() != items.len() || lengths.iter().any(|&l| l != columns) {
            return refuse(span, "the rows of the matrix have different lengths");
        }
        side(columns, span)?;
        Ok(Matrix::new(items.len(), columns, entries, sort).with_wholeness())
    }

    /// The scalar that it is.
    pub fn scalar(&self, span: &Span) -> Read<&Scalar> {
        match self {
            Object::Scalar(s) => Ok(s),
            Object::Matrix(m) if m.entries.len() == 1 => Ok(&m.entries[0]),
            other => refuse(span, format!("a number is expected here, found {}", other.about())),
        }
    }

    /// The items that a loop or an assignment to several names goes through.
    pub fn items(&self, language: Dialect, span: &Span) -> Read<Vec<Object<'a>>> {
        match self {
            Object::List(items) => Ok(items.to_vec()),
            Object::Matrix(m) if language == Dialect::Matlab => {
                let rows: Vec<usize> = (0..m.rows).collect();
                Ok((0..m.columns).map(|c| object(m.part(&rows, &[c]))).collect())
            }
            Object::Scalar(_) if language == Dialect::Matlab => Ok(vec![self.clone()]),
            Object::Matrix(m) if m.is_flat || m.sort == Sort::SympyMatrix => {
                Ok(m.entries.iter().cloned().map(Object::Scalar).collect())
            }
            Object::Matrix(m) => Ok((0..m.rows).map(|r| m.row_object(r)).collect()),
            other => refuse(span, format!("{} is not taken apart", other.about())),
        }
    }
}

impl Matrix {
    fn row(self) -> Self {
        Matrix { rows: self.columns, columns: self.rows, ..self }
    }

    /// `M[r]`
    pub fn row_object<'a>(&self, r: usize) -> Object<'a> {
        let all: Vec<usize> = (0..self.columns).collect();
        let row = self.part(&[r], &all);
        match self.sort {
            Sort::Array => object(self.view(Matrix::vector(row.entries, Sort::Array))),
            _ => object(row),
        }
    }
}
