//! The parts of a printed formula, kept beside the values while these are read.
//!
//! The grammar reads once; a value carries the number of its part, and a part takes those that it is made of.

use super::ParseError;
use super::grammar::{Parser, Read, Value};
use super::syntax::{Syntax, SyntaxKind};
use crate::expr::{Angle, Expr};
use crate::rational::Rational;
use std::ops::Range;

/// The parts read so far; each is taken once.
#[derive(Default)]
pub(super) struct Parts(Vec<Syntax>);

impl Parts {
    pub fn take(&mut self, part: usize) -> Syntax {
        let nothing = Syntax { kind: SyntaxKind::Number(Rational::ZERO), span: 0..0 };
        self.0.get_mut(part).map_or(nothing.clone(), |p| std::mem::replace(p, nothing))
    }

    pub fn boxed(&mut self, part: usize) -> Box<Syntax> {
        Box::new(self.take(part))
    }

    /// What is in the brackets that a root or a function has as its own.
    pub fn unbracketed(&mut self, part: usize) -> Syntax {
        let part = self.take(part);
        match part.kind {
            SyntaxKind::Bracket(inner) => *inner,
            _ => part,
        }
    }
}

impl Parser<'_> {
    /// The value, with the part that is all of the text from token `start` on, if parts are asked for.
    pub fn part(&mut self, value: Value, start: usize, kind: impl FnOnce(&mut Parts) -> SyntaxKind) -> Value {
        let Some(parts) = &mut self.parts else { return value };
        let kind = kind(parts);
        let span = balanced(self.text, self.span_from(start));
        let Some(Parts(parts)) = &mut self.parts else { return value };
        let mut part = Syntax { kind, span };
        // Of `C^2_1` the power is read last, and ends within the name.
        let last = part.children().last().map_or(0, |c| c.span.end);
        part.span.end = part.span.end.max(last);
        parts.push(part);
        Value { part: parts.len() - 1, ..value }
    }

    /// The part of an angle whose bare numbers have become degrees: they are numbers with a unit.
    pub fn part_in_degrees(&mut self, angle: &Value, has_degrees: bool) -> Read<()> {
        let Some(Parts(parts)) = &mut self.parts else { return Ok(()) };
        let Some(part) = parts.get_mut(angle.part) else { return Ok(()) };
        if !in_degrees(part) && !has_degrees {
            return Ok(());
        }
        if Angle::of(part.value()) != Angle::of(angle.expr) {
            if part.sign_choices() > 0 {
                let e = ParseError::new(part.span.clone(), "degrees beside signs of two values");
                return Err(e.hint("write the unit behind each number: `90 deg`"));
            }
            part.kind = SyntaxKind::Name(angle.expr);
        }
        Ok(())
    }
}

/// Bare numbers of a linear form as degrees; true if there were any.
fn in_degrees(part: &mut Syntax) -> bool {
    let is_number = is_number(part);
    match &mut part.kind {
        SyntaxKind::Sum(terms) => terms.iter_mut().fold(false, |any, (_, t)| in_degrees(t) | any),
        SyntaxKind::Bracket(inner) => in_degrees(inner),
        _ if is_number => {
            part.kind = SyntaxKind::Name(part.value() * Expr::pi() / Expr::int(180));
            true
        }
        SyntaxKind::Product(factors) => {
            let mut angles = factors.iter_mut().filter(|(_, f)| !self::is_number(f));
            match (angles.next(), angles.next()) {
                (Some((false, angle)), None) => in_degrees(angle),
                _ => false,
            }
        }
        SyntaxKind::Fraction(over, under) => self::is_number(under) && in_degrees(over),
        _ => false,
    }
}

/// True if the part is made of numbers only, and of signs with one value.
fn is_number(part: &Syntax) -> bool {
    match &part.kind {
        SyntaxKind::Number(_) => true,
        SyntaxKind::Name(_) | SyntaxKind::Call(..) => false,
        SyntaxKind::Sum(terms) if terms.iter().any(|(sign, _)| sign.is_two_valued()) => false,
        _ => part.children().into_iter().all(is_number),
    }
}

/// The place with the braces that it cuts off: of `\mathit{W}_{4}`, the word is at `W}_{4`.
fn balanced(text: &str, mut span: Range<usize>) -> Range<usize> {
    let (mut open, mut unopened) = (0_usize, 0_usize);
    for b in text.get(span.clone()).unwrap_or_default().bytes() {
        match b {
            b'{' => open += 1,
            b'}' if open > 0 => open -= 1,
            b'}' => unopened += 1,
            _ => {}
        }
    }
    for _ in 0..unopened {
        let Some(before) = text[..span.start].trim_end().strip_suffix('{') else { break };
        let command = before.trim_end().trim_end_matches(|c: char| c.is_ascii_alphabetic());
        span.start = command.strip_suffix('\\').map_or(before.len(), str::len);
    }
    for _ in 0..open {
        let rest = &text[span.end..];
        let Some(behind) = rest.trim_start().strip_prefix('}') else { break };
        span.end = text.len() - behind.len();
    }
    span
}
