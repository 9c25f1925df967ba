//! The functions of NumPy, SymPy, `math`, Python and MATLAB that are read.

use super::calls::Given;
use super::known::{MODULES, function, root, short};
use super::machine::Machine;
use super::scalar::{Read, Scalar, applied, combined, refuse, refuse_hint};
use super::tree::{Op, Span};
use super::value::{Matrix, Object, Sort, inverse, object, product};
use denavit_symbolic::Expr;
use denavit_symbolic::parse::Function;

impl<'a> Machine<'a> {
    /// Calls a function of a library.
    pub fn library(&mut self, path: &str, given: Given<'a>, span: &Span) -> Read<Object<'a>> {
        self.budget.charge(1, span)?;
        let module = root(path);
        let name = path.rsplit('.').next().unwrap_or(path);
        if !MODULES.contains(&module) {
            let hint = "only arithmetic, matrices, sines and roots are";
            return refuse_hint(span, format!("`{path}` is not read"), hint);
        }
        let sort = match (module, name) {
            ("sympy", _) | (_, "Matrix") => Sort::SympyMatrix,
            ("matlab", _) => Sort::Matlab,
            (_, "matrix" | "mat" | "asmatrix") => Sort::NumpyMatrix,
            _ => Sort::Array,
        };
        // Julia's `atan(y, x)`.
        let is_of_both = name == "atan" && module == "matlab" && given.positional.len() == 2;
        let name = if is_of_both { "atan2" } else { name };
        if let Some((f, in_degrees)) = function(name) {
            let [(value, place)] = self.positional(given, path, span)?;
            return self.each_entry(value, &place, |m, s| {
                let s = if in_degrees { m.radians(&s)? } else { s };
                applied(f, vec![s], &mut m.budget, span)
            });
        }
        match name {
            "atan2" | "arctan2" => {
                let [(y, py), (x, px)] = self.positional(given, path, span)?;
                let arguments = vec![y.scalar(&py)?.clone(), x.scalar(&px)?.clone()];
                Ok(Object::Scalar(applied(Function::Atan2, arguments, &mut self.budget, span)?))
            }
            "asind" | "acosd" | "atand" | "atan2d" => {
                let f = match name {
                    "asind" => Function::Arcsin,
                    "acosd" => Function::Arccos,
                    "atand" => Function::Arctan,
                    _ => Function::Atan2,
                };
                let of = |(value, place): &(Object<'a>, Span)| Ok(value.scalar(place)?.clone());
                let arguments = given.positional.iter().map(of).collect::<Read<Vec<Scalar>>>()?;
                let angle = applied(f, arguments, &mut self.budget, span)?;
                if let Some(posed) = self.posed {
                    let degrees = Scalar::of(posed.per_radian, span);
                    return Ok(Object::Scalar(self.times(&angle, &degrees, span)?));
                }
                let pi = self.pi(span);
                let scaled = self.times(&angle, &Scalar::of(Expr::int(180), span), span)?;
                Ok(Object::Scalar(combined(Op::Div, &scaled, &pi, &mut self.budget, span)?.named(span)))
            }
            "radians" | "deg2rad" => {
                let [(value, place)] = self.positional(given, path, span)?;
                self.each_entry(value, &place, |m, s| Ok(m.radians(&s)?.named(span)))
            }
            "degrees" | "rad2deg" => {
                let [(value, place)] = self.positional(given, path, span)?;
                self.each_entry(value, &place, |m, s| {
                    let scaled = m.times(&s, &Scalar::of(Expr::int(180), span), span)?;
                    let pi = m.pi(span);
                    Ok(combined(Op::Div, &scaled, &pi, &mut m.budget, span)?.named(span))
                })
            }
            "dot" | "matmul" | "mtimes" | "multiply" | "times" | "power" | "pow" | "plus" | "minus"
            | "add" | "subtract" | "divide" | "rdivide" | "mpower" => {
                self.operator(name, sort, given, path, span)
            }
            "cross" => {
                let [(a, pa), (b, pb)] = self.positional(given, path, span)?;
                self.cross(&a.matrix(sort, &pa)?, &b.matrix(sort, &pb)?, span)
            }
            "inv" | "pinv" | "inverse" => {
                let [(m, place)] = self.positional(given, path, span)?;
                Ok(object(inverse(&m.matrix(sort, &place)?, &mut self.budget, span)?))
            }
            "transpose" | "ctranspose" => {
                let [(m, place)] = self.positional(given, path, span)?;
                Ok(object(m.matrix(sort, &place)?.transposed()))
            }
            "multi_dot" | "reduce" => self.product_of_all(name, given, path, span),
            "subs" if !given.positional.is_empty() => {
                let mut given = given;
                let (value, _) = given.positional.remove(0);
                self.substituted(&value, &given, span)
            }
            "diff" | "Derivative" if !given.positional.is_empty() => {
                self.differentiated(&given.positional[0].0.clone(), &given.positional[1..], span)
            }
            "jacobian" => {
                let [(value, _), by] = self.positional(given, path, span)?;
                self.jacobian(&value, &by, span)
            }
            "det" | "Determinant" => {
                let [(m, place)] = self.positional(given, path, span)?;
                self.determinant(&m.matrix(sort, &place)?, span)
            }
            "lambdify" => match given.positional.get(1) {
                Some((value, _)) => Ok(value.clone()),
                None => refuse(span, "`lambdify` without a formula is not read"),
            },
            "simplify" | "trigsimp" | "expand" | "double" | "combine" | "nsimplify" | "factor"
            | "collect" | "cancel" | "together" | "apart" | "expand_trig" | "radsimp" | "powsimp" | "N"
            | "vpa" | "round" | "around" | "single" | "real" | "eval" | "simplifyFraction" | "horner"
            | "numden_" => {
                let value = self.first(given, path, span)?;
                self.each_entry(value, span, |_, s| Ok(s.unwritten(span)))
            }
            "float" | "float64" | "float32" | "S" | "sympify" | "Float" => {
                let value = self.first(given, path, span)?;
                self.each_entry(value, span, |_, s| Ok(s.wholly(false)))
            }
            "int" => {
                let value = self.first(given, path, span)?;
                match value.scalar(span)?.to_integer() {
                    Some(_) => Ok(value),
                    None => refuse(span, "`int` cuts off values that are not known"),
                }
            }
            "clip" | "max" | "min" | "maximum" | "minimum" | "fmax" | "fmin" => {
                // What keeps a value within ±1 against rounding leaves it as it is.
                let is_bound = |o: &Object<'a>| match o {
                    Object::Scalar(s) => s.expr.is_one() || (-s.expr).is_one(),
                    _ => false,
                };
                let rest: Vec<&(Object<'a>, Span)> =
                    given.positional.iter().filter(|v| !is_bound(&v.0)).collect();
                match rest[..] {
                    [(value, _)] if given.positional.len() > 1 => Ok(value.clone()),
                    _ => refuse(span, format!("`{name}` of values is not read")),
                }
            }
            "abs" | "fabs" => {
                let value = self.first(given, path, span)?;
                match value.scalar(span)?.expr.as_number() {
                    Some(r) => Ok(Object::Scalar(Scalar::of(r.abs().into(), span))),
                    None => refuse(span, "the magnitude of values is not read"),
                }
            }
            "norm" | "hypot" => {
                let mut squares = Scalar::of(Expr::int(0), span);
                let two = Scalar::of(Expr::int(2), span);
                for (value, place) in &given.positional {
                    let m = value.matrix(sort, place)?;
                    if !m.is_vector() {
                        return refuse(span, "the norm of a matrix is not read");
                    }
                    for e in &m.entries {
                        let square = combined(Op::Pow, e, &two, &mut self.budget, span)?;
                        squares = combined(Op::Add, &squares, &square, &mut self.budget, span)?;
                    }
                }
                Ok(Object::Scalar(
                    applied(Function::Sqrt, vec![squares], &mut self.budget, span)?.unwritten(span),
                ))
            }
            "sum" | "cumsum" => self.sums(name == "cumsum", sort, given, path, span),
            "Rational" => {
                let [(a, pa), (b, pb)] = self.positional(given, path, span)?;
                let (a, b) = (a.scalar(&pa)?, b.scalar(&pb)?);
                Ok(Object::Scalar(combined(Op::Div, a, b, &mut self.budget, span)?.named(span)))
            }
            "symbols" | "Symbol" | "dynamicsymbols" | "sym" => self.symbols(given, path, span),
            _ => self.build(name, sort, given, path, span),
        }
    }

    /// Exactly so many arguments.
    pub fn positional<const N: usize>(
        &self,
        given: Given<'a>,
        path: &str,
        span: &Span,
    ) -> Read<[(Object<'a>, Span); N]> {
        if let Some((name, ..)) = given.named.iter().find(|(n, ..)| *n != "dtype" && *n != "copy") {
            return refuse(span, format!("`{name}=` of `{}` is not read", short(path)));
        }
        let count = given.positional.len();
        given
            .positional
            .try_into()
            .or_else(|_| refuse(span, format!("`{}` with {count} arguments is not read", short(path))))
    }

    /// The first of its arguments.
    pub fn first(&self, given: Given<'a>, path: &str, span: &Span) -> Read<Object<'a>> {
        match given.positional.into_iter().next() {
            Some((value, _)) => Ok(value),
            None => refuse(span, format!("`{}` without arguments is not read", short(path))),
        }
    }

    /// An angle in degrees, in radians.
    fn radians(&mut self, s: &Scalar) -> Read<Scalar> {
        let span = s.span.clone();
        let pi = self.pi(&span);
        let scaled = self.times(s, &pi, &span)?;
        let half_turn = Scalar::of(Expr::int(180), &span);
        Ok(combined(Op::Div, &scaled, &half_turn, &mut self.budget, &span)?.named(&span))
    }

    /// A function of a number, or of each entry.
    pub fn each_entry(
        &mut self,
        value: Object<'a>,
        span: &Span,
        mut f: impl FnMut(&mut Self, Scalar) -> Read<Scalar>,
    ) -> Read<Object<'a>> {
        match value {
            Object::Scalar(s) => Ok(Object::Scalar(f(self, s)?)),
            other => {
                let m = other.matrix(Sort::Array, span)?;
                self.budget.charge(m.entries.len() as u64, span)?;
                Ok(object(m.map(|e| f(self, e.clone()))?))
            }
        }
    }

    fn operator(
        &mut self,
        name: &str,
        sort: Sort,
        given: Given<'a>,
        path: &str,
        span: &Span,
    ) -> Read<Object<'a>> {
        let [(a, pa), (b, pb)] = self.positional(given, path, span)?;
        let is_matlab = sort == Sort::Matlab;
        let op = match name {
            "dot" if is_matlab => {
                let (a, b) = (a.matrix(sort, &pa)?, b.matrix(sort, &pb)?);
                if !a.is_vector() || !b.is_vector() || a.entries.len() != b.entries.len() {
                    return refuse(span, "`dot` is between vectors of one length");
                }
                let flat = |m: Matrix| Matrix::vector(m.entries, Sort::Array);
                return product(&flat(a), &flat(b), &mut self.budget, span);
            }
            "dot" | "matmul" if matches!(a, Object::Scalar(_)) || matches!(b, Object::Scalar(_)) => Op::Mul,
            "dot" | "matmul" => {
                let (a, b) = (a.matrix(Sort::Array, &pa)?, b.matrix(Sort::Array, &pb)?);
                return product(&a, &b, &mut self.budget, span);
            }
            "mtimes" => Op::Mul,
            "times" | "multiply" => Op::EachMul,
            "power" if is_matlab => Op::EachPow,
            "power" | "pow" | "mpower" => Op::Pow,
            "plus" | "add" => Op::Add,
            "minus" | "subtract" => Op::Sub,
            _ => Op::EachDiv,
        };
        self.binary(op, a, b, span)
    }

    pub fn cross(&mut self, a: &Matrix, b: &Matrix, span: &Span) -> Read<Object<'a>> {
        if a.entries.len() != 3 || b.entries.len() != 3 {
            return refuse(span, "`cross` is between vectors of three entries");
        }
        let mut entries = vec![];
        for k in 0..3 {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            let plus = self.times(&a.entries[i], &b.entries[j], span)?;
            let minus = self.times(&a.entries[j], &b.entries[i], span)?;
            entries.push(combined(Op::Sub, &plus, &minus, &mut self.budget, span)?);
        }
        Ok(object(Matrix { entries, is_whole: false, ..a.fresh() }))
    }

    fn product_of_all(&mut self, name: &str, given: Given<'a>, path: &str, span: &Span) -> Read<Object<'a>> {
        let mut positional = given.positional;
        let by = if name == "reduce" && !positional.is_empty() { Some(positional.remove(0).0) } else { None };
        let mut items = match positional.first() {
            Some((list, place)) => list.items(self.language, place)?,
            None => return refuse(span, format!("`{}` without a list is not read", short(path))),
        };
        if let Some((start, _)) = positional.get(1) {
            items.insert(0, start.clone());
        }
        let mut items = items.into_iter();
        let Some(mut so_far) = items.next() else { return refuse(span, "the list is empty") };
        for item in items {
            let pair = vec![(so_far, span.clone()), (item, span.clone())];
            let given = Given { positional: pair, named: vec![] };
            so_far = match &by {
                Some(Object::Function(f)) => {
                    self.call(f, given, 1, span)?.into_iter().next().unwrap_or(Object::Nothing)
                }
                Some(Object::Path(path)) => self.library(path, given, span)?,
                Some(other) => return refuse(span, format!("{} is not a function", other.about())),
                None => self.operator("matmul", Sort::Array, given, path, span)?,
            };
        }
        Ok(so_far)
    }

    fn sums(
        &mut self,
        is_running: bool,
        sort: Sort,
        given: Given<'a>,
        path: &str,
        span: &Span,
    ) -> Read<Object<'a>> {
        let [(list, place)] = self.positional(given, path, span)?;
        let m = list.matrix(sort, &place)?;
        if !m.is_vector() {
            return refuse(span, "the sum of a matrix is not read");
        }
        let mut sum = Scalar::of(Expr::int(0), span);
        let mut running = vec![];
        for e in &m.entries {
            sum = combined(Op::Add, &sum, e, &mut self.budget, span)?;
            running.push(sum.clone());
        }
        match is_running {
            true => Ok(object(Matrix { entries: running, is_whole: false, ..m.fresh() })),
            false => Ok(Object::Scalar(sum.unwritten(span))),
        }
    }

    /// `symbols('q1:7')`, `symbols('a b')`, `sym('q', [1 6])`.
    fn symbols(&mut self, given: Given<'a>, path: &str, span: &Span) -> Read<Object<'a>> {
        let text = match given.positional.first() {
            Some((Object::Text(text), _)) => text.clone(),
            Some((value @ (Object::Scalar(_) | Object::Matrix(_)), _)) => return Ok(value.clone()),
            _ => return refuse(span, format!("`{}` without names is not read", short(path))),
        };
        let mut names: Vec<String> = vec![];
        for name in text.split([',', ' ']).filter(|n| !n.is_empty()) {
            let Some((first, last)) = name.split_once(':') else {
                names.push(name.to_string());
                continue;
            };
            let stem = first.trim_end_matches(|c: char| c.is_ascii_digit());
            let from = first[stem.len()..].parse::<u32>().unwrap_or(0);
            let Some(to) = last.parse::<u32>().ok().filter(|t| t.saturating_sub(from) <= 64) else {
                return refuse(span, format!("the names `{name}` are not read"));
            };
            names.extend((from..to).map(|k| format!("{stem}{k}")));
        }
        if let (true, Some((Object::Matrix(size), place))) = (path.ends_with(".sym"), given.positional.get(1))
        {
            let counts: Vec<i64> = size.entries.iter().filter_map(Scalar::to_integer).collect();
            let (stem, &[rows @ 0..=64, columns @ 0..=64]) = (text, counts.as_slice()) else {
                return refuse(place, "this size is not read");
            };
            if rows != 1 && columns != 1 {
                return refuse(place, "a matrix of symbols is not read");
            }
            let entries: Vec<Scalar> =
                (1..=rows * columns).map(|k| self.declared(&format!("{stem}{k}"), span)).collect();
            return Ok(object(Matrix::new(rows as usize, columns as usize, entries, Sort::Matlab)));
        }
        let is_one = names.len() == 1 && !text.contains(':') && !text.contains(',');
        let mut symbols: Vec<Object<'a>> =
            names.iter().map(|n| Object::Scalar(self.declared(n, span).named(span))).collect();
        match symbols.pop() {
            Some(one) if is_one => Ok(one),
            Some(last) => {
                symbols.push(last);
                Ok(Object::list(symbols))
            }
            None => refuse(span, "there are no names"),
        }
    }
}
