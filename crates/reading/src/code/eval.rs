//! The values of expressions.

use super::Dialect;
use super::machine::Machine;
use super::scalar::{Read, Scalar, Stop, applied, combined, negated, operated, refuse, refuse_hint};
use super::tree::{Definition, Kind, Node, Op, Span, Suffix, SuffixKind, mentioned};
use super::value::{Closure, Matrix, Object, Sort, each, inverse, object, product, side};
use super::{builders, known};
use denavit_symbolic::parse::Function;
use denavit_symbolic::{Expr, Rational};
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

/// Names that usually stand for all joints.
pub(super) const VECTORS: &[&str] =
    &["q", "Q", "theta", "thetas", "th", "joints", "joint_angles", "angles", "Theta"];

impl<'a> Machine<'a> {
    pub fn eval(&mut self, node: &'a Node) -> Read<Object<'a>> {
        self.budget.charge(1, &node.span)?;
        self.deeper(&node.span, |m| m.eval_inner(node))
    }

    fn eval_inner(&mut self, node: &'a Node) -> Read<Object<'a>> {
        let span = &node.span;
        match &node.kind {
            Kind::Number(r, is_whole) => Ok(Object::Scalar(Scalar::literal(r, *is_whole, span))),
            Kind::Text(text) => {
                self.budget.charge(text.len() as u64 / 16, span)?;
                Ok(Object::Text(text.as_str().into()))
            }
            Kind::Name(name) => self.name(name, span),
            Kind::Bracket(inner) => Ok(match self.eval(inner)? {
                Object::Scalar(s) => Object::Scalar(s.bracketed(span)),
                value => value,
            }),
            Kind::Path(base, suffixes) => self.path(base, suffixes),
            Kind::Unary(op, inner) => self.unary(*op, inner, span),
            Kind::Chain(first, rest) => self.chain(first, rest, span),
            Kind::List(parts) | Kind::Tuple(parts) => self.list(parts, span),
            Kind::Rows(rows) => self.rows(rows, span),
            Kind::Cells(rows) => self.cells(rows, span),
            Kind::Lambda(definition) => {
                let mut captured = BTreeMap::new();
                if self.language == Dialect::Matlab {
                    captured = self.captured(definition);
                    self.budget.charge(captured.len() as u64, span)?;
                }
                let home = Some((self.frames.len() - 1, self.frame().id));
                Ok(Object::Function(Rc::new(Closure { definition, home, captured })))
            }
            Kind::Comprehension(parts) => self.comprehension(parts),
            Kind::Choice(parts) => {
                let [test, value, other] = &**parts;
                let holds = self.eval(test).and_then(|v| self.truth(&v, &test.span));
                if holds.is_err() && self.posed.is_some() {
                    let (a, b) = (self.eval(value)?, self.eval(other)?);
                    if let Some(either) = self.one_of(&a, &b, span) {
                        return Ok(either);
                    }
                }
                match holds? {
                    true => self.eval(value),
                    false => self.eval(other),
                }
            }
            Kind::End => match self.ends.last() {
                Some(&n) => Ok(Object::Scalar(Scalar::whole(n, span).named(span))),
                None => refuse(span, "`end` stands outside of an index"),
            },
            Kind::Slice(_) | Kind::All => refuse(span, "a range of indices stands outside of an index"),
            Kind::Star(_) => refuse(span, "`*` stands outside of a call"),
        }
    }

    /// The values that a function without a name takes along.
    fn captured(&mut self, definition: &'a Definition) -> BTreeMap<&'a str, Object<'a>> {
        let key = std::ptr::from_ref(definition) as usize;
        let names = self.free.entry(key).or_insert_with(|| {
            let mut names = BTreeSet::new();
            mentioned(&definition.body, &mut names);
            names
        });
        let Some(frame) = self.frames.last() else { return BTreeMap::new() };
        let value = |n: &&'a str| Some((*n, frame.slots.get(n)?.value.clone()?));
        names.iter().filter_map(value).collect()
    }

    /// Several values where MATLAB asks for them.
    pub fn several(&mut self, node: &'a Node, count: usize) -> Read<Object<'a>> {
        if self.language == Dialect::Python || count < 2 {
            return self.eval(node);
        }
        if let Kind::Path(base, suffixes) = &node.kind
            && let Kind::Name(name) = &base.kind
            && let [Suffix { kind: SuffixKind::Call(arguments), .. }] = suffixes.as_slice()
        {
            match self.name(name, &base.span)? {
                Object::Function(f) => {
                    let given = self.arguments(arguments)?;
                    return Ok(Object::list(self.call(&f, given, count, &node.span)?));
                }
                Object::Path(path) if &*path == "matlab.deal" => {
                    let given = self.arguments(arguments)?;
                    let mut values: Vec<Object<'a>> = given.positional.into_iter().map(|a| a.0).collect();
                    if let [one] = values.as_slice() {
                        values = vec![one.clone(); count];
                    }
                    return Ok(Object::list(values));
                }
                // Of Julia.
                Object::Path(path) if &*path == "matlab.sincos" && count == 2 => {
                    let given = self.arguments(arguments)?;
                    let [(value, place)] = self.positional(given, "sincos", &node.span)?;
                    let angle = value.scalar(&place)?.clone();
                    let sine = applied(Function::Sin, vec![angle.clone()], &mut self.budget, &node.span)?;
                    let cosine = applied(Function::Cos, vec![angle], &mut self.budget, &node.span)?;
                    return Ok(Object::list(vec![Object::Scalar(sine), Object::Scalar(cosine)]));
                }
                Object::Path(path) if &*path == "matlab.size" => return self.eval(node),
                _ => {}
            }
        }
        match self.eval(node)? {
            Object::List(items) if items.len() >= count => Ok(Object::List(items)),
            _ => refuse_hint(
                &node.span,
                format!("{count} values are asked for here"),
                "`deal(a, b)` gives two",
            ),
        }
    }

    /// What a name means.
    pub fn name(&mut self, name: &'a str, span: &Span) -> Read<Object<'a>> {
        self.flush(name);
        if let Some(value) = self.variable(name) {
            return match value? {
                Object::Scalar(s) => Ok(Object::Scalar(s.named(span))),
                value => Ok(value),
            };
        }
        if let Some(definition) = self.functions.get(name) {
            let closure = Closure { definition, home: None, captured: BTreeMap::new() };
            return Ok(Object::Function(Rc::new(closure)));
        }
        if let Some(path) = self.imports.get(name) {
            return Ok(known::constant(path, span).unwrap_or_else(|| Object::Path((*path).into())));
        }
        match name {
            "True" | "true" => return Ok(Object::Bool(true)),
            "False" | "false" => return Ok(Object::Bool(false)),
            "None" => return Ok(Object::Nothing),
            "nargin" if self.language == Dialect::Matlab => {
                let given = self.frame().given;
                return Ok(Object::Scalar(Scalar::whole(given, span)));
            }
            _ => {}
        }
        if let Some(coordinate) = self.coordinate(name, span) {
            return Ok(coordinate);
        }
        if let Some(meaning) = (self.names)(name) {
            return Ok(Object::Scalar(Scalar::of(meaning, span).named(span)));
        }
        if let Some(path) = known::path_of(name, self.language, &self.stars) {
            return Ok(known::constant(&path, span).unwrap_or_else(|| Object::Path(path.into())));
        }
        if VECTORS.contains(&name) {
            return Ok(self.joint_vector(span));
        }
        refuse_hint(
            span,
            format!("unknown `{name}`"),
            "give it a value further up, or name it as the robot does",
        )
    }

    /// All joints, as the argument of a function.
    pub fn joint_vector(&self, span: &Span) -> Object<'a> {
        self.vector_of(self.joints, span)
    }

    /// A vector of these, as the argument of a function.
    pub fn vector_of(&self, entries: &[Expr], span: &Span) -> Object<'a> {
        let sort = if self.language == Dialect::Matlab { Sort::Matlab } else { Sort::Array };
        object(Matrix::vector(entries.iter().map(|&e| Scalar::of(e, span)).collect(), sort))
    }

    /// The value of a variable: of the function, of those around it, or of the script.
    pub fn variable(&self, name: &str) -> Option<Read<Object<'a>>> {
        let mut at = self.frames.len().checked_sub(1);
        while let Some(index) = at {
            let frame = &self.frames[index];
            if let Some(slot) = frame.slots.get(name) {
                return Some(slot.value.clone().ok_or(Stop(None)));
            }
            at = match frame.home {
                Some((home, id)) if home < index && self.frames[home].id == id => Some(home),
                _ if index > 0 && self.language == Dialect::Python => Some(0),
                _ => None,
            };
        }
        // Constants of a script that stands beside functions are not known to MATLAB's functions.
        None
    }

    fn unary(&mut self, op: Op, inner: &'a Node, span: &Span) -> Read<Object<'a>> {
        let value = self.eval(inner)?;
        match (op, value) {
            (Op::Not, value) => Ok(Object::Bool(!self.truth(&value, &inner.span)?)),
            (Op::Sub, Object::Scalar(s)) => Ok(Object::Scalar(negated(s, span)?)),
            (Op::Sub, Object::Matrix(m)) => {
                self.budget.charge(m.entries.len() as u64, span)?;
                let negated = m.map(|e| Ok(negated(e.unwritten(span), span)?.unwritten(span)))?;
                Ok(object(negated.with_wholeness()))
            }
            (_, value @ (Object::Scalar(_) | Object::Matrix(_))) => Ok(value),
            (_, other) => refuse(span, format!("a sign before {} is not read", other.about())),
        }
    }

    fn chain(&mut self, first: &'a Node, rest: &'a [(Op, Node)], span: &Span) -> Read<Object<'a>> {
        let mut left = self.eval(first)?;
        if rest.iter().any(|(op, _)| op.is_comparison()) {
            let mut holds = true;
            for (op, node) in rest {
                let right = self.eval(node)?;
                holds &= self.compared(*op, &left, &right, span)?;
                left = right;
            }
            return Ok(Object::Bool(holds));
        }
        if let [(Op::Colon, _), ..] = rest {
            return self.range(left, rest, span);
        }
        for (op, node) in rest {
            if matches!(op, Op::And | Op::Or) {
                if self.truth(&left, span)? == (*op == Op::Or) {
                    return Ok(left);
                }
                left = self.eval(node)?;
            } else {
                let right = self.eval(node)?;
                left = self.binary(*op, left, right, span)?;
            }
        }
        Ok(left)
    }

    fn compared(&self, op: Op, left: &Object<'a>, right: &Object<'a>, span: &Span) -> Read<bool> {
        let hint = "write each branch as a function of its own";
        let (a, b) = match (left, right) {
            (Object::Nothing, Object::Nothing) => (0.0, 0.0),
            (Object::Nothing, _) | (_, Object::Nothing) => (0.0, 1.0),
            (Object::Text(a), Object::Text(b)) => (0.0, f64::from(u8::from(a != b))),
            (Object::Bool(a), Object::Bool(b)) => (f64::from(u8::from(*a)), f64::from(u8::from(*b))),
            (Object::Scalar(a), Object::Scalar(b)) => {
                let constant = |s: &Scalar| s.expr.as_number().map(|r| r.to_f64());
                match (constant(a), constant(b)) {
                    (Some(x), Some(y)) => (x, y),
                    _ => return refuse_hint(span, "a condition on values is not read", hint),
                }
            }
            _ => return refuse_hint(span, "a condition on values is not read", hint),
        };
        Ok(match op {
            Op::Less => a < b,
            Op::LessEqual => a <= b,
            Op::Greater => a > b,
            Op::GreaterEqual => a >= b,
            Op::NotEqual => a != b,
            _ => a == b,
        })
    }

    /// `from:to` or `from:step:to`.
    fn range(&mut self, first: Object<'a>, rest: &'a [(Op, Node)], span: &Span) -> Read<Object<'a>> {
        let mut numbers = vec![];
        let known = |value: &Object<'a>| {
            let number = value.scalar(span)?.expr.as_number();
            number.map_or_else(|| refuse(span, "a range is between known numbers"), Ok)
        };
        numbers.push(known(&first)?);
        for (_, node) in rest {
            let value = self.eval(node)?;
            numbers.push(known(&value)?);
        }
        let (from, step, to) = match numbers.as_slice() {
            [from, to] => (from.clone(), Rational::ONE, to.clone()),
            [from, step, to] => (from.clone(), step.clone(), to.clone()),
            _ => return refuse(span, "a range has at most three parts"),
        };
        if step.is_zero() {
            return refuse(span, "the step is 0");
        }
        let count = (&(&to - &from) / &step).floor();
        let count = if count.is_negative() { -1 } else { count.to_integer().unwrap_or(i64::MAX) };
        let count = side(usize::try_from(count.saturating_add(1)).unwrap_or(0), span)?;
        let mut entries = vec![];
        let mut at = from;
        for _ in 0..count {
            entries.push(Scalar::of(at.clone().into(), span).wholly(true));
            at = &at + &step;
        }
        Ok(object(Matrix::vector(entries, Sort::Matlab)))
    }

    pub fn binary(&mut self, op: Op, left: Object<'a>, right: Object<'a>, span: &Span) -> Read<Object<'a>> {
        self.budget.charge(left.weight() + right.weight(), span)?;
        match (left, right) {
            (Object::Scalar(a), Object::Scalar(b)) if op != Op::MatMul => {
                Ok(Object::Scalar(operated(op, a, b, &mut self.budget)?))
            }
            (Object::List(a), Object::List(b)) if op == Op::Add => {
                side(a.len() + b.len(), span)?;
                Ok(Object::list(a.iter().chain(b.iter()).cloned().collect()))
            }
            (Object::List(items), Object::Scalar(n)) | (Object::Scalar(n), Object::List(items))
                if op == Op::Mul =>
            {
                let n = n.to_integer().and_then(|n| usize::try_from(n).ok()).unwrap_or(usize::MAX);
                let length = side(n.saturating_mul(items.len()), span)?;
                Ok(Object::list(items.iter().cycle().take(length).cloned().collect()))
            }
            (left @ (Object::Matrix(_) | Object::List(_)), right @ (Object::Matrix(_) | Object::List(_)))
            | (left @ Object::Matrix(_), right @ Object::Scalar(_))
            | (left @ Object::Scalar(_), right @ Object::Matrix(_)) => {
                if !matches!(left, Object::Matrix(_)) && !matches!(right, Object::Matrix(_)) {
                    return refuse_hint(span, "this is not computed between lists", "write `np.array(…)`");
                }
                self.matrices(op, &left, &right, span)
            }
            (left, right) => {
                let message =
                    format!("an operator between {} and {} is not read", left.about(), right.about());
                refuse(span, message)
            }
        }
    }

    fn matrices(&mut self, op: Op, left: &Object<'a>, right: &Object<'a>, span: &Span) -> Read<Object<'a>> {
        let (a, b) = (left.matrix(Sort::Array, span)?, right.matrix(Sort::Array, span)?);
        let has_scalar = matches!(left, Object::Scalar(_)) || matches!(right, Object::Scalar(_));
        let is_array = [&a, &b].iter().all(|m| m.sort == Sort::Array);
        match op {
            Op::MatMul if has_scalar => refuse_hint(span, "`@` is between matrices", "write `*`"),
            Op::MatMul => product(&a, &b, &mut self.budget, span),
            Op::Mul if !has_scalar && !is_array => product(&a, &b, &mut self.budget, span),
            Op::Div if !has_scalar && !is_array => {
                let inverted = inverse(&b, &mut self.budget, span)?;
                product(&a, &inverted, &mut self.budget, span)
            }
            Op::LeftDiv if !has_scalar => {
                let inverted = inverse(&a, &mut self.budget, span)?;
                product(&inverted, &b, &mut self.budget, span)
            }
            Op::Pow if !is_array => {
                let n = right.scalar(span)?.to_integer();
                let Some(n @ -1..=16) = n.filter(|&n| n != 0) else {
                    return refuse(span, "this power of a matrix is not read");
                };
                let base = if n < 0 { inverse(&a, &mut self.budget, span)? } else { a.clone() };
                let mut power = object(base.clone());
                for _ in 1..n {
                    let so_far = power.matrix(base.sort, span)?;
                    power = product(&so_far, &base, &mut self.budget, span)?;
                }
                Ok(power)
            }
            Op::Add | Op::Sub
                if has_scalar && !is_array && [&a, &b].iter().any(|m| m.sort == Sort::SympyMatrix) =>
            {
                refuse(span, "a number and a matrix are not added")
            }
            op => {
                let scalar = |m: &Matrix, o: &Object<'a>| match o {
                    Object::Scalar(s) => {
                        Matrix { is_flat: false, ..Matrix::new(1, 1, vec![s.clone()], m.sort) }
                    }
                    _ => m.clone(),
                };
                let (x, y) = (scalar(&a, left), scalar(&b, right));
                let mut result = each(op, &x, &y, &mut self.budget, span)?;
                // A scalar leaves an array with one index as it is.
                let other = if matches!(left, Object::Scalar(_)) { &b } else { &a };
                if has_scalar && other.is_flat {
                    result = Matrix::vector(result.entries, Sort::Array).with_wholeness();
                }
                Ok(object(result))
            }
        }
    }

    /// `-R.T @ p` and `2*A`: used by functions as well.
    pub fn times(&mut self, a: &Scalar, b: &Scalar, span: &Span) -> Read<Scalar> {
        combined(Op::Mul, a, b, &mut self.budget, span)
    }

    /// The items of a list; `*rest` is taken apart.
    pub fn list(&mut self, parts: &'a [Node], span: &Span) -> Read<Object<'a>> {
        let mut items = vec![];
        for part in parts {
            match &part.kind {
                Kind::Star(inner) => {
                    let value = self.eval(inner)?;
                    items.extend(value.items(self.language, &part.span)?);
                }
                _ => items.push(self.settled(part)?),
            }
        }
        if items.len() > 4096 {
            return refuse(span, "a list has at most 4096 items");
        }
        Ok(Object::list(items))
    }

    /// An entry of a matrix or list, with the value that its form on paper has.
    fn settled(&mut self, node: &'a Node) -> Read<Object<'a>> {
        Ok(match self.eval(node)? {
            Object::Scalar(s) => Object::Scalar(s.settled()),
            value => value,
        })
    }

    /// `[a b; c d]`, of numbers and of matrices.
    fn rows(&mut self, rows: &'a [Vec<Node>], span: &Span) -> Read<Object<'a>> {
        let mut bands = vec![];
        for row in rows {
            let mut blocks = vec![];
            for node in row {
                let value = self.settled(node)?;
                let block = match value {
                    Object::Scalar(s) => Matrix::new(1, 1, vec![s], Sort::Matlab),
                    other => other.matrix(Sort::Matlab, &node.span)?,
                };
                if !block.entries.is_empty() {
                    blocks.push(block);
                }
            }
            if !blocks.is_empty() {
                bands.push(builders::beside(&blocks, span)?);
            }
        }
        if bands.is_empty() {
            return Ok(object(Matrix::new(0, 0, vec![], Sort::Matlab)));
        }
        Ok(object(builders::above(&bands, span)?))
    }

    fn cells(&mut self, rows: &'a [Vec<Node>], span: &Span) -> Read<Object<'a>> {
        if rows.len() > 1 && rows.iter().any(|r| r.len() > 1) {
            return refuse(span, "a table of cells is not read");
        }
        let items = rows.iter().flatten().map(|node| self.settled(node)).collect::<Read<Vec<_>>>()?;
        side(items.len(), span)?;
        Ok(Object::list(items))
    }

    fn comprehension(&mut self, parts: &'a [Node; 3]) -> Read<Object<'a>> {
        let [item, target, source] = parts;
        let turns = self.eval(source)?.items(self.language, &source.span)?;
        if turns.len() > super::MAX_TURNS {
            return refuse(
                &source.span,
                format!("a loop of more than {} turns is not read", super::MAX_TURNS),
            );
        }
        // Its names are its own.
        let home = Some((self.frames.len() - 1, self.frame().id));
        let id = self.next_id;
        self.next_id += 1;
        self.frames.push(super::machine::Frame { id, home, ..Default::default() });
        let mut items = vec![];
        let mut failed = None;
        for turn in turns {
            let value =
                self.assign(target, turn, &target.span, &target.span).and_then(|()| self.settled(item));
            match value {
                Ok(value) => items.push(value),
                Err(stop) => {
                    failed = Some(stop);
                    break;
                }
            }
        }
        self.frames.pop();
        failed.map_or_else(|| Ok(Object::list(items)), Err)
    }

    /// π as a factor.
    pub fn pi(&self, span: &Span) -> Scalar {
        Scalar::of(Expr::pi(), span)
    }
}
