//! Numbers of a program as formulas: each with how it is written, and within bounds.
//!
//! A sum of values in a loop doubles what is written out at every turn, so that sizes are counted, not found.

use super::tree::{Op, Span};
use super::{MAX_SIZE, MAX_WORK};
use denavit_symbolic::expr::Node;
use denavit_symbolic::parse::{Function, MAX_EXPONENT, ParseError, Sign, Syntax, SyntaxKind};
use denavit_symbolic::{Expr, Rational};
use std::rc::Rc;

/// The most operators on one way from a formula to a name in it.
const MAX_HEIGHT: u32 = 3_000;
/// The largest number, in bits.
const MAX_BITS: u64 = 4_096;
/// The largest number under a root, in bits.
const MAX_ROOT_BITS: u64 = 256;
/// The most bits of numbers in one angle.
const MAX_ANGLE_BITS: u64 = 8_192;
/// The largest angle, in nodes.
const MAX_ANGLE: u64 = 10_000;

/// Why a value is not known: an error, or one that was reported before.
#[derive(Debug)]
pub(super) struct Stop(pub Option<Box<ParseError>>);

pub(super) type Read<T> = Result<T, Stop>;

impl From<ParseError> for Stop {
    fn from(e: ParseError) -> Self {
        Stop(Some(Box::new(e)))
    }
}

/// An error.
pub(super) fn refuse<T>(span: &Span, message: impl Into<String>) -> Read<T> {
    Err(ParseError::new(span.clone(), message).into())
}

/// An error with what to write instead.
pub(super) fn refuse_hint<T>(span: &Span, message: impl Into<String>, hint: impl Into<String>) -> Read<T> {
    Err(ParseError::new(span.clone(), message).hint(hint).into())
}

/// A scalar: what it is, how it is written, and how large it is.
#[derive(Clone, Debug)]
pub(super) struct Scalar {
    pub expr: Expr,
    pub syntax: Option<Rc<Syntax>>,
    pub span: Span,
    /// Of Python: an `int`.
    pub is_whole: bool,
    size: u64,
    height: u32,
    bits: u64,
}

/// What may still be computed.
#[derive(Debug)]
pub(super) struct Budget(u64);

impl Budget {
    pub fn new() -> Self {
        Budget(MAX_WORK)
    }

    pub fn is_spent(&self) -> bool {
        self.0 == 0
    }

    /// Counts work.
    pub fn charge(&mut self, work: u64, span: &Span) -> Read<()> {
        if self.0 == 0 {
            return Err(Stop(None));
        }
        self.0 = self.0.saturating_sub(work);
        if self.0 == 0 {
            return refuse_hint(span, "the code computes too much", "leave only the kinematics");
        }
        Ok(())
    }
}

impl Scalar {
    /// A number as it stands in the text.
    pub fn literal(r: &Rational, is_whole: bool, span: &Span) -> Self {
        let syntax = Syntax { kind: SyntaxKind::Number(r.clone()), span: span.clone() };
        Scalar { syntax: Some(Rc::new(syntax)), is_whole, ..Scalar::of(r.clone().into(), span) }
    }

    /// A whole number.
    pub fn whole(n: usize, span: &Span) -> Self {
        Scalar { is_whole: true, ..Scalar::of(Expr::int(i64::try_from(n).unwrap_or(i64::MAX)), span) }
    }

    /// The same value, as an `int` of Python or not.
    pub fn wholly(self, is_whole: bool) -> Self {
        Scalar { is_whole, ..self }
    }

    /// A symbol or number.
    pub fn of(expr: Expr, span: &Span) -> Self {
        let bits = expr.as_number().map_or(0, |r| bits(&r));
        // Of what comes from outside the size is not known.
        let size = if expr.as_number().is_some() || expr.as_symbol().is_some() { 1 } else { 16 };
        Scalar { expr, syntax: None, span: span.clone(), is_whole: false, size, height: 0, bits }
    }

    /// The same value where its name is written.
    pub fn named(&self, span: &Span) -> Self {
        let syntax = Syntax { kind: SyntaxKind::Name(self.expr), span: span.clone() };
        Scalar { syntax: Some(Rc::new(syntax)), span: span.clone(), ..self.clone() }
    }

    /// The same value, not as it is written.
    pub fn unwritten(&self, span: &Span) -> Self {
        Scalar { syntax: None, span: span.clone(), ..self.clone() }
    }

    /// In brackets.
    pub fn bracketed(self, span: &Span) -> Self {
        let value = self.unwritten(span);
        let syntax = SyntaxKind::Bracket(Box::new(self.into_written()));
        Scalar { syntax: syntax_at(syntax, span), ..value }
    }

    /// How it is written, at least as a name.
    pub fn written(&self) -> Syntax {
        match &self.syntax {
            Some(syntax) => Syntax::clone(syntax),
            None => Syntax { kind: SyntaxKind::Name(self.expr), span: self.span.clone() },
        }
    }

    fn into_written(self) -> Syntax {
        match self.syntax.map(Rc::try_unwrap) {
            Some(Ok(syntax)) => syntax,
            Some(Err(syntax)) => Syntax::clone(&syntax),
            None => Syntax { kind: SyntaxKind::Name(self.expr), span: self.span },
        }
    }

    /// With the value that its form on paper has: signs stand before products there.
    pub fn settled(mut self) -> Self {
        if let Some(syntax) = &self.syntax {
            self.expr = syntax.value();
        }
        self
    }

    /// The whole number that it is.
    pub fn to_integer(&self) -> Option<i64> {
        self.expr.as_number()?.to_integer()
    }

    fn with(mut self, kind: SyntaxKind) -> Self {
        self.syntax = syntax_at(kind, &self.span);
        self
    }
}

fn syntax_at(kind: SyntaxKind, span: &Span) -> Option<Rc<Syntax>> {
    Some(Rc::new(Syntax { kind, span: span.clone() }))
}

fn bits(r: &Rational) -> u64 {
    match r.to_parts() {
        Some((n, d)) => {
            u64::from(128 - n.unsigned_abs().leading_zeros() - d.unsigned_abs().leading_zeros()) - 1
        }
        None => {
            let (n, d) = r.digits();
            4 * (n.len() + d.len()) as u64
        }
    }
}

/// The number in front of a product, in bits.
fn front_bits(e: Expr) -> u64 {
    match e.node() {
        Node::Number(r) => bits(&r),
        Node::Neg(a) => match a.node() {
            Node::Mul(n, _) => n.as_number().map_or(0, |r| bits(&r)),
            _ => 0,
        },
        Node::Mul(n, _) => n.as_number().map_or(0, |r| bits(&r)),
        _ => 0,
    }
}

/// A value built from others, if it is within bounds.
fn made(expr: Expr, parts: &[&Scalar], span: &Span) -> Read<Scalar> {
    let height = parts.iter().map(|p| p.height).max().unwrap_or(0) + 1;
    let sum = parts.iter().fold(0_u64, |s, p| s.saturating_add(p.bits));
    let size = parts.iter().fold(1_u64, |s, p| s.saturating_add(p.size));
    let front = front_bits(expr);
    if front > MAX_BITS {
        return refuse(span, "the numbers become too large");
    }
    if height > MAX_HEIGHT {
        return refuse(span, "too many operators inside one another");
    }
    if size > MAX_SIZE {
        return refuse(span, "the formula becomes too large");
    }
    let is_number = expr.as_number().is_some();
    Ok(Scalar {
        expr,
        syntax: None,
        span: span.clone(),
        is_whole: parts.iter().all(|p| p.is_whole),
        size: if is_number { 1 } else { size },
        height: if is_number { 0 } else { height },
        bits: if is_number { front } else { sum },
    })
}

/// `−a`, as it is written.
pub(super) fn negated(a: Scalar, span: &Span) -> Read<Scalar> {
    let value = made(-a.expr, &[&a], span)?;
    Ok(value.with(SyntaxKind::Sum(vec![(Sign::Minus, a.into_written())])))
}

/// The value of an operator between scalars, without how it is written.
pub(super) fn combined(op: Op, a: &Scalar, b: &Scalar, budget: &mut Budget, span: &Span) -> Read<Scalar> {
    budget.charge(1, span)?;
    let value = match op {
        Op::Add => made(a.expr + b.expr, &[a, b], span)?,
        Op::Sub => made(a.expr - b.expr, &[a, b], span)?,
        Op::Mul | Op::EachMul => made(a.expr * b.expr, &[a, b], span)?,
        Op::Div | Op::EachDiv => {
            if b.expr.is_zero() {
                return refuse(span, "division by zero");
            }
            Scalar { is_whole: false, ..made(a.expr / b.expr, &[a, b], span)? }
        }
        Op::LeftDiv => return combined(Op::Div, b, a, budget, span),
        Op::Pow | Op::EachPow => return Ok(power(a, b, span)?.unwritten(span)),
        Op::FloorDiv | Op::Mod => {
            let (Some(x), Some(y)) = (a.expr.as_number(), b.expr.as_number().filter(|y| !y.is_zero())) else {
                return refuse(span, "a remainder or whole part of values is not read");
            };
            let quotient = (&x / &y).floor();
            let value = if op == Op::Mod { &x - &(&y * &quotient) } else { quotient };
            made(value.into(), &[a, b], span)?
        }
        _ => return refuse(span, "this operator is not read between numbers"),
    };
    Ok(value)
}

/// An operator between scalars as it is written.
pub(super) fn operated(op: Op, a: Scalar, b: Scalar, budget: &mut Budget) -> Read<Scalar> {
    let span = a.span.start.min(b.span.start)..b.span.end.max(a.span.end);
    if matches!(op, Op::Pow | Op::EachPow) {
        budget.charge(1, &span)?;
        return power(&a, &b, &span);
    }
    let value = combined(op, &a, &b, budget, &span)?;
    let (left, right) = (a.into_written(), b.into_written());
    let kind = match op {
        Op::Add | Op::Sub => {
            let sign = if op == Op::Add { Sign::Plus } else { Sign::Minus };
            let mut terms = match left.kind {
                SyntaxKind::Sum(terms) => terms,
                _ => vec![(Sign::Plus, left)],
            };
            terms.push((sign, right));
            SyntaxKind::Sum(terms)
        }
        Op::Mul | Op::EachMul => product(left, right, false),
        Op::Div | Op::EachDiv => product(left, right, true),
        _ => return Ok(value.named(&span)),
    };
    Ok(value.with(kind))
}

/// The sign of `-a*b` is that of the term.
fn product(left: Syntax, right: Syntax, is_divisor: bool) -> SyntaxKind {
    let end = right.span.end;
    match left.kind {
        SyntaxKind::Sum(mut terms) if terms.len() == 1 => {
            if let Some((sign, term)) = terms.pop() {
                let span = term.span.start..end;
                terms.push((sign, Syntax { kind: product(term, right, is_divisor), span }));
            }
            SyntaxKind::Sum(terms)
        }
        SyntaxKind::Product(mut factors) => {
            factors.push((is_divisor, right));
            SyntaxKind::Product(factors)
        }
        _ => SyntaxKind::Product(vec![(false, left), (is_divisor, right)]),
    }
}

/// A power with a known exponent: a whole number, or halves.
fn power(a: &Scalar, b: &Scalar, span: &Span) -> Read<Scalar> {
    let halves = b.expr.as_number().and_then(|r| (&r * &Rational::from(2)).to_integer());
    let Some(halves) = halves.and_then(|n| i32::try_from(n).ok()).filter(|n| n.abs() <= MAX_EXPONENT) else {
        let message = format!("an exponent is a whole number from -{MAX_EXPONENT} to {MAX_EXPONENT}, or 0.5");
        return refuse(span, message);
    };
    if halves < 0 && a.expr.is_zero() {
        return refuse(span, "division by zero");
    }
    let (base, n) = if halves % 2 == 0 { (a.clone(), halves / 2) } else { (root(a, span)?, halves) };
    let scaled = base.bits.saturating_mul(u64::from(n.unsigned_abs()));
    if base.expr.as_number().is_some() && base.bits > 1 && scaled > 2 * MAX_BITS {
        return refuse(span, "the numbers become too large");
    }
    let is_whole = a.is_whole && b.is_whole && n >= 0;
    let scaled = Scalar { bits: scaled, ..base.clone() };
    let value = Scalar { is_whole, ..made(base.expr.powi(n), &[&scaled], span)? };
    Ok(match (halves % 2 == 0, n) {
        (false, 1) => value.with(base.written().kind),
        _ => value.with(SyntaxKind::Power(Box::new(base.written()), n)),
    })
}

/// The square root, as it is written.
pub(super) fn root(a: &Scalar, span: &Span) -> Read<Scalar> {
    if let Some(r) = a.expr.as_number() {
        if r.is_negative() {
            return refuse(span, "the root of a negative number");
        }
        if bits(&r) > MAX_ROOT_BITS {
            return refuse(span, "the numbers become too large");
        }
    }
    let inner = match a.written() {
        Syntax { kind: SyntaxKind::Bracket(inner), .. } => inner,
        written => Box::new(written),
    };
    let value = Scalar { is_whole: false, ..made(a.expr.sqrt(), &[a], span)? };
    Ok(value.with(SyntaxKind::Root(inner)))
}

/// A function of its arguments, as it is written; angles are in radians.
pub(super) fn applied(f: Function, arguments: Vec<Scalar>, budget: &mut Budget, span: &Span) -> Read<Scalar> {
    let Some(a) = arguments.first() else { return refuse(span, "an argument is missing") };
    budget.charge(1, span)?;
    let grown = match f {
        Function::Sqrt => return root(a, span),
        Function::Sin | Function::Cos | Function::Tan => {
            if a.bits > MAX_ANGLE_BITS || a.size > MAX_ANGLE {
                return refuse(span, "the angle becomes too large");
            }
            budget.charge(a.size, span)?;
            if f == Function::Tan && a.expr.cos().is_zero() {
                return refuse(span, "the value is not a finite number");
            }
            2
        }
        Function::Arcsin | Function::Arccos => {
            if let Some(r) = a.expr.as_number() {
                if 2 * bits(&r) > MAX_ROOT_BITS {
                    return refuse(span, "the numbers become too large");
                }
                if (&Rational::ONE - &(&r * &r)).is_negative() {
                    return refuse(span, "no real angle has this sine or cosine");
                }
            }
            5
        }
        Function::Atan2 | Function::Arctan => 1,
    };
    let exprs: Vec<Expr> = arguments.iter().map(|a| a.expr).collect();
    if exprs.len() != if f == Function::Atan2 { 2 } else { 1 } {
        return refuse(span, format!("`{}` has {} arguments here", f.name(), exprs.len()));
    }
    let parts: Vec<&Scalar> = arguments.iter().chain(arguments.iter().take(1)).collect();
    let mut value = made(f.of(&exprs), &parts, span)?;
    value.height = value.height.saturating_add(grown);
    value.is_whole = false;
    if f.takes_angle() && value.expr.as_number().is_none() {
        value.bits = 0;
    }
    Ok(value.with(SyntaxKind::Call(f, arguments.into_iter().map(Scalar::into_written).collect())))
}
