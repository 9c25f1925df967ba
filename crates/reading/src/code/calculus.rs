//! What computer algebra does with formulas: values for symbols, derivatives, determinants.

use super::calls::Given;
use super::machine::Machine;
use super::scalar::{Read, Scalar, combined, refuse};
use super::tree::{Op, Span};
use super::value::{Matrix, Object, Sort, object};
use denavit_symbolic::expr::Node;
use denavit_symbolic::{Expr, Symbol};
use std::collections::HashMap;

/// The largest determinant that is expanded.
const MAX_DETERMINANT: usize = 6;
/// The most nodes that are differentiated or substituted at once.
const MAX_NODES: u64 = 20_000;

impl<'a> Machine<'a> {
    /// `f.subs(q1, 0)`, `f.subs({q1: 0})`, `f.subs([(q1, 0)])`, `subs(f, [q1 q2], [0 1])`
    pub fn substituted(&mut self, value: &Object<'a>, given: &Given<'a>, span: &Span) -> Read<Object<'a>> {
        let mut pairs: Vec<(Symbol, Expr)> = vec![];
        match given.positional.as_slice() {
            [] => return Ok(value.clone()),
            [(one, place)] => {
                for item in one.items(self.language, place)? {
                    let pair = item.items(self.language, place)?;
                    let [key, value] = pair.as_slice() else {
                        return refuse(place, "what is put in is pairs of a symbol and its value");
                    };
                    push_pair(&mut pairs, key.scalar(place)?, value.scalar(place)?, place)?;
                }
            }
            [(keys, pk), (values, pv)] => {
                let (keys, values) = (scalars(keys, pk)?, scalars(values, pv)?);
                if keys.len() != values.len() {
                    return refuse(span, "there are as many values as symbols");
                }
                for (key, value) in keys.iter().zip(&values) {
                    push_pair(&mut pairs, key, value, pk)?;
                }
            }
            _ => return refuse(span, "`subs` is read with symbols and their values"),
        }
        self.each_entry(value.clone(), span, |m, s| {
            m.budget.charge(nodes(s.expr, span)?, span)?;
            let find = |s: Symbol| pairs.iter().rev().find(|p| p.0 == s).map(|p| p.1);
            Ok(Scalar::of(s.expr.substitute(find), span))
        })
    }

    /// `diff(f, x)`, `diff(f, x, y)`
    pub fn differentiated(
        &mut self,
        value: &Object<'a>,
        by: &[(Object<'a>, Span)],
        span: &Span,
    ) -> Read<Object<'a>> {
        let mut value = value.clone();
        if by.is_empty() {
            return refuse(span, "a derivative is by a symbol");
        }
        let mut last = None;
        for (symbol, place) in by {
            let s = symbol.scalar(place)?;
            let times = match (s.to_integer(), last) {
                (Some(n @ 1..=4), Some(before)) => (before, n - 1),
                _ => match s.expr.as_symbol() {
                    Some(symbol) => (symbol, 1),
                    None => return refuse(place, "a derivative is by a symbol"),
                },
            };
            last = Some(times.0);
            for _ in 0..times.1 {
                value = self.each_entry(value, span, |m, s| m.derivative(&s, times.0, span))?;
            }
        }
        Ok(value)
    }

    /// The matrix of derivatives.
    pub fn jacobian(&mut self, value: &Object<'a>, by: &(Object<'a>, Span), span: &Span) -> Read<Object<'a>> {
        let values = scalars(value, span)?;
        let mut entries = vec![];
        let symbols: Vec<Symbol> = scalars(&by.0, &by.1)?
            .iter()
            .map(|s| match s.expr.as_symbol() {
                Some(symbol) => Ok(symbol),
                None => refuse(&by.1, "a derivative is by a symbol"),
            })
            .collect::<Read<_>>()?;
        for v in &values {
            for s in &symbols {
                entries.push(self.derivative(v, *s, span)?);
            }
        }
        let sort = if self.language == super::Dialect::Matlab { Sort::Matlab } else { Sort::SympyMatrix };
        Ok(object(Matrix::new(values.len(), symbols.len(), entries, sort)))
    }

    fn derivative(&mut self, s: &Scalar, by: Symbol, span: &Span) -> Read<Scalar> {
        self.budget.charge(4 * nodes(s.expr, span)?, span)?;
        match derivative(s.expr, by) {
            Some(e) => Ok(Scalar::of(e, span)),
            None => refuse(span, "this derivative is not read"),
        }
    }

    /// The determinant, by its first rows.
    pub fn determinant(&mut self, m: &Matrix, span: &Span) -> Read<Object<'a>> {
        let n = m.rows;
        if n != m.columns || n > MAX_DETERMINANT || m.is_flat {
            return refuse(span, format!("a determinant of {} is not read", m.shape()));
        }
        let columns: Vec<usize> = (0..n).collect();
        let value = self.minor(m, 0, &columns, span)?;
        Ok(Object::Scalar(value.unwritten(span)))
    }

    fn minor(&mut self, m: &Matrix, row: usize, columns: &[usize], span: &Span) -> Read<Scalar> {
        let mut sum = Scalar::of(Expr::int(i64::from(columns.is_empty())), span);
        for (k, &c) in columns.iter().enumerate() {
            let factor = m.at(row, c);
            if factor.expr.is_zero() {
                continue;
            }
            let rest: Vec<usize> = columns.iter().copied().filter(|&x| x != c).collect();
            let below = self.minor(m, row + 1, &rest, span)?;
            let term = combined(Op::Mul, factor, &below, &mut self.budget, span)?;
            sum = combined(if k % 2 == 0 { Op::Add } else { Op::Sub }, &sum, &term, &mut self.budget, span)?;
        }
        Ok(sum)
    }
}

fn push_pair(pairs: &mut Vec<(Symbol, Expr)>, key: &Scalar, value: &Scalar, span: &Span) -> Read<()> {
    match key.expr.as_symbol() {
        Some(symbol) => pairs.push((symbol, value.expr)),
        // What is put in for a number changes nothing.
        None if key.expr.as_number().is_some() => {}
        None => return refuse(span, "only symbols are given values"),
    }
    Ok(())
}

fn scalars<'a>(value: &Object<'a>, span: &Span) -> Read<Vec<Scalar>> {
    match value {
        Object::Scalar(s) => Ok(vec![s.clone()]),
        Object::Matrix(m) if m.is_vector() => Ok(m.entries.clone()),
        Object::List(items) => {
            let all = items.iter().map(|i| scalars(i, span)).collect::<Read<Vec<_>>>()?;
            Ok(all.into_iter().flatten().collect())
        }
        other => refuse(span, format!("numbers are expected here, found {}", other.about())),
    }
}

fn nodes(e: Expr, span: &Span) -> Read<u64> {
    let count = Expr::postorder(&[e]).len() as u64;
    if count > MAX_NODES { refuse(span, "the formula becomes too large") } else { Ok(count + 1) }
}

/// The derivative of a formula; nothing where it has none that is read.
fn derivative(e: Expr, by: Symbol) -> Option<Expr> {
    let zero = Expr::int(0);
    let mut known: HashMap<Expr, Expr> = HashMap::new();
    for part in Expr::postorder(&[e]) {
        let of = |x: Expr| known.get(&x).copied().unwrap_or(zero);
        let d = match part.node() {
            Node::Number(_) | Node::Pi | Node::Sign(_) => zero,
            Node::Symbol(s) => Expr::int(i64::from(s == by)),
            Node::Neg(a) => -of(a),
            Node::Add(a, b) => of(a) + of(b),
            Node::Sub(a, b) => of(a) - of(b),
            Node::Mul(a, b) => of(a) * b + a * of(b),
            Node::Div(a, b) if of(b).is_zero() => of(a) / b,
            Node::Div(a, b) => (of(a) * b - a * of(b)) / b.powi(2),
            Node::Pow(_, 0) => zero,
            Node::Pow(a, n) => Expr::int(i64::from(n)) * a.powi(n - 1) * of(a),
            Node::Sqrt(a) if of(a).is_zero() => zero,
            Node::Sqrt(a) => of(a) / (Expr::int(2) * a.sqrt()),
            Node::Sin(a) => a.cos() * of(a),
            Node::Cos(a) => -(a.sin() * of(a)),
            Node::Atan2(y, x) if of(y).is_zero() && of(x).is_zero() => zero,
            Node::Atan2(y, x) => (x * of(y) - y * of(x)) / (x.powi(2) + y.powi(2)),
        };
        known.insert(part, d);
    }
    known.get(&e).copied()
}
