//! Powers and functions, angles in degrees, and the bounds on what is built.

use super::functions::Function;
use super::grammar::{Parser, Read, Value};
use super::lexer::Kind;
use super::measured::Context;
use super::syntax::SyntaxKind;
use super::{MAX_EXPONENT, MAX_OPERATORS, ParseError};
use crate::expr::{Angle, Expr, Node, Symbol};
use crate::rational::Rational;

/// The most operators on one way from the whole formula to a name in it.
const MAX_HEIGHT: u32 = 3_000;
/// The most nodes of an expression that is written out, where tangents and arcs write their argument twice.
const MAX_SIZE: u64 = 1_000_000;
/// The largest number, in bits of numerator and denominator.
const MAX_BITS: u64 = 4_096;
/// The largest number under a root, which is tried for being a square.
const MAX_ROOT_BITS: u64 = 256;
/// The most bits of numbers in one angle.
const MAX_ANGLE_BITS: u64 = 8_192;
/// Stands for one radian until bare numbers have become degrees.
pub(super) const RADIAN: &str = "\u{0}radian";

impl Parser<'_> {
    pub fn raised(&mut self, base: Value, n: i32, start: usize) -> Read<Value> {
        if n < 0 && base.expr.is_zero() {
            return Err(ParseError::new(self.span_from(start), "division by zero"));
        }
        if let Some(m) = self.measures.as_deref_mut() {
            m.power(n).map_err(|message| ParseError::new(self.span_from(start), message))?;
        }
        let size = base.expr.as_number().map_or(0, |r| bits(&r));
        if size > 1 && size * u64::from(n.unsigned_abs()) > 2 * MAX_BITS {
            return Err(self.too_large(start));
        }
        let power = base.expr.powi(n);
        let scaled = base.bits.saturating_mul(u64::from(n.unsigned_abs()));
        let value = self.made(power, &[Value { bits: scaled, ..base }], start)?;
        Ok(self.part(value, start, |p| SyntaxKind::Power(p.boxed(base.part), n)))
    }

    /// `^` and a whole number, if `^` comes next.
    pub fn exponent(&mut self) -> Read<Option<i32>> {
        if !matches!(self.peek(), Some(Kind::Caret)) {
            return Ok(None);
        }
        let start = self.at;
        self.at += 1;
        let closing = match self.peek() {
            Some(Kind::Open(c)) => Some(*c),
            _ => None,
        };
        self.at += usize::from(closing.is_some());
        let is_negative = matches!(self.peek(), Some(Kind::Minus));
        self.at += usize::from(is_negative);
        let whole = match self.peek() {
            Some(Kind::Number(r)) => r.to_integer().and_then(|n| i32::try_from(n).ok()),
            _ => None,
        };
        self.at = (self.at + 1).min(self.tokens.len());
        let wrong = |span| {
            let message = format!("an exponent is a whole number from -{MAX_EXPONENT} to {MAX_EXPONENT}");
            Err(ParseError::new(span, message).hint("a root is `sqrt(…)`"))
        };
        let Some(n) = whole.filter(|n| *n <= MAX_EXPONENT) else { return wrong(self.span_from(start)) };
        if let Some(c) = closing {
            if !matches!(self.peek(), Some(Kind::Close(d)) if *d == c) {
                return wrong(self.span_from(start));
            }
            self.at += 1;
        }
        if let Some(Kind::Caret) = self.peek() {
            let e = ParseError::new(self.span_from(start), "a power of a power has two readings");
            return Err(e.hint("write brackets: `(x^2)^3`"));
        }
        Ok(Some(if is_negative { -n } else { n }))
    }

    pub fn call(&mut self, f: Function, start: usize) -> Read<Value> {
        self.at += 1;
        let is_letter = self.span_of(start).len() == 1;
        let (f, power) = match (self.exponent()?, f.inverse()) {
            (Some(-1), Some(inverse)) if self.parts.is_some() && !is_letter => (inverse, None),
            (power, _) => (f, power),
        };
        let open = self.at;
        let outer = self.context;
        self.context = if f.takes_angle() { Context::Angle } else { Context::Plain };
        let (first, second) = self.arguments(f)?;
        self.context = outer;
        if power.is_some_and(i32::is_negative) {
            let e = ParseError::new(self.span_from(start), "a negative power of a function has two readings");
            return Err(match f.inverse() {
                Some(inverse) => e.hint(format!(
                    "write `1/{}(…)`, or `{}(…)` for the inverse function",
                    f.name(),
                    inverse.name()
                )),
                None => e.hint(format!("write `1/{}(…)`", f.name())),
            });
        }
        let first = if f.takes_angle() { self.angle(first, open)? } else { first };
        if is_letter && !is_linear(first.expr) {
            let e = ParseError::new(self.span_from(start), "the argument is not a sum of angles");
            return Err(e.hint("write `cos(…)` for a cosine, or the missing index"));
        }
        let value = self.called(f, first, second, start)?;
        let value = self.part(value, start, |p| match f {
            Function::Sqrt => SyntaxKind::Root(Box::new(p.unbracketed(first.part))),
            _ => {
                SyntaxKind::Call(f, [Some(first), second].iter().flatten().map(|a| p.take(a.part)).collect())
            }
        });
        match power {
            Some(n) => self.raised(value, n, start),
            None => Ok(value),
        }
    }

    /// The arguments of a function: in brackets, or one fraction, root or number.
    fn arguments(&mut self, f: Function) -> Read<(Value, Option<Value>)> {
        let open = self.at;
        let closing = match self.peek() {
            Some(Kind::Open(closing)) => *closing,
            Some(Kind::Fraction | Kind::Root) if f != Function::Atan2 => {
                let argument = self.primary()?;
                if let Some(Kind::Caret) = self.peek() {
                    let e =
                        ParseError::new(self.span_from(open), "a power behind an argument without brackets");
                    return Err(e.hint(format!("write `{}(…)^2` or `{0}((…)^2)`", f.name())));
                }
                return Ok((argument, None));
            }
            Some(Kind::Number(_)) if f.takes_angle() => return self.bare(f, open),
            Some(Kind::Atom(_)) if f.is_inverse() => return self.bare(f, open),
            _ => {
                let hint = format!("`{}` takes its argument in brackets", f.name());
                return Err(self.unexpected("`(`").hint(hint));
            }
        };
        self.at += 1;
        let first = self.sum(true)?;
        let second = match (f, self.peek()) {
            (Function::Atan2, Some(Kind::Comma)) => {
                self.at += 1;
                Some(self.sum(true)?)
            }
            (Function::Atan2, _) => {
                return Err(self.unexpected("`,`").hint("`atan2(y, x)` takes two arguments"));
            }
            _ => None,
        };
        self.close(closing, open)?;
        Ok((first, second))
    }

    /// A number or a name as the argument without brackets, `cos 30°`, `arccos a_x`, where nothing behind it may belong to the argument.
    fn bare(&mut self, f: Function, open: usize) -> Read<(Value, Option<Value>)> {
        let argument = self.primary()?;
        let has_unit = matches!(self.tokens[self.at - 1].kind, Kind::Degree | Kind::Radian);
        let ends = match self.peek() {
            None | Some(Kind::Plus | Kind::Minus | Kind::PlusMinus | Kind::MinusPlus) => true,
            Some(Kind::Close(_) | Kind::Comma | Kind::Equals) => true,
            Some(Kind::Divide | Kind::Caret | Kind::Number(_) | Kind::Degree | Kind::Radian) => false,
            Some(_) => has_unit,
        };
        if ends {
            return Ok((argument, None));
        }
        let e = ParseError::new(self.span_from(open), "it is not clear where the argument ends");
        Err(e.hint(format!("`{}` takes its argument in brackets", f.name())))
    }

    /// The value of a function.
    fn called(&self, f: Function, first: Value, second: Option<Value>, start: usize) -> Read<Value> {
        let error = |message: &str| Err(ParseError::new(self.span_from(start), message));
        match f {
            Function::Sin | Function::Cos => {
                let expr = f.of(&[first.expr]);
                Ok(Value { height: first.height + 2, bits: 0, expr, has_unit: false, ..first })
            }
            Function::Tan => {
                if first.expr.cos().is_zero() {
                    return error("the value is not a finite number");
                }
                let made = self.made(f.of(&[first.expr]), &[first, first], start)?;
                Ok(Value { height: first.height + 3, bits: 0, has_unit: false, ..made })
            }
            Function::Sqrt => self.root(first, start),
            Function::Arcsin | Function::Arccos => {
                if let Some(r) = first.expr.as_number() {
                    if 2 * bits(&r) > MAX_ROOT_BITS {
                        return Err(self.too_large(start));
                    }
                    if (&Rational::ONE - &(&r * &r)).is_negative() {
                        return error("no real angle has this sine or cosine");
                    }
                }
                let made = self.made(f.of(&[first.expr]), &[first, first], start)?;
                Ok(Value { height: first.height + 5, has_unit: true, ..made })
            }
            Function::Arctan => {
                Ok(Value { has_unit: true, ..self.made(f.of(&[first.expr]), &[first], start)? })
            }
            Function::Atan2 => {
                let Some(x) = second else { return error("`atan2(y, x)` takes two arguments") };
                let expr = f.of(&[first.expr, x.expr]);
                Ok(Value { has_unit: true, ..self.made(expr, &[first, x], start)? })
            }
        }
    }

    pub fn root(&self, inner: Value, start: usize) -> Read<Value> {
        if inner.expr.as_number().is_some_and(|r| r.is_negative()) {
            return Err(ParseError::new(self.span_from(start), "the root of a negative number"));
        }
        if inner.expr.as_number().is_some_and(|r| bits(&r) > MAX_ROOT_BITS) {
            return Err(self.too_large(start));
        }
        self.made(inner.expr.sqrt(), &[inner], start)
    }

    /// An angle: bare numbers become degrees where the vocabulary says so.
    pub fn angle(&mut self, value: Value, start: usize) -> Read<Value> {
        if value.bits > MAX_ANGLE_BITS {
            return Err(self.too_large(start));
        }
        if !self.vocabulary.in_degrees() {
            return Ok(value);
        }
        let mut angle = Angle::of(value.expr);
        let degrees = std::mem::take(&mut angle.radians);
        angle.turns = &angle.turns + &(&degrees / &Rational::from(180));
        let value = Value { expr: self.without_radians(angle.to_expr()), ..value };
        self.part_in_degrees(&value, !degrees.is_zero())?;
        Ok(value)
    }

    pub(crate) fn without_radians(&self, e: Expr) -> Expr {
        if !self.vocabulary.in_degrees() {
            return e;
        }
        let radian = Symbol::new(RADIAN);
        e.substitute(|s| (s == radian).then(|| Expr::int(1)))
    }

    /// The value of `expr`, built from `parts`, if it is within bounds.
    pub fn made(&self, expr: Expr, parts: &[Value], start: usize) -> Read<Value> {
        let height = parts.iter().map(|p| p.height).max().unwrap_or(0) + 1;
        let sum = parts.iter().fold(0_u64, |s, p| s.saturating_add(p.bits));
        if bits(&expr.split_number().0) > MAX_BITS {
            return Err(self.too_large(start));
        }
        if height > MAX_HEIGHT {
            return Err(ParseError::new(self.span_from(start), "too many operators inside one another"));
        }
        let size = parts.iter().fold(1_u64, |s, p| s.saturating_add(p.size));
        if size > MAX_SIZE {
            return Err(ParseError::new(self.span_from(start), "the formula becomes too large"));
        }
        let has_name = parts.iter().any(|p| p.has_name);
        let has_unit = parts.iter().any(|p| p.has_unit);
        Ok(Value { expr, height, bits: sum, has_name, has_unit, size, part: 0 })
    }

    pub(crate) fn too_large(&self, start: usize) -> ParseError {
        ParseError::new(self.span_from(start), "the numbers become too large")
    }

    pub fn chain(&self, count: usize, start: usize) -> Read<()> {
        if count > MAX_OPERATORS {
            let message = format!("more than {MAX_OPERATORS} operators in a row");
            return Err(ParseError::new(self.span_from(start), message));
        }
        Ok(())
    }
}

/// True for a sum of multiples of symbols, arctangents and π.
fn is_linear(e: Expr) -> bool {
    let angle = Angle::of(e);
    angle.terms.iter().all(|(term, _)| matches!(term.node(), Node::Symbol(_) | Node::Atan2(..)))
}

/// The bits of numerator and denominator, those of larger numbers rounded up.
pub(super) fn bits(r: &Rational) -> u64 {
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
