//! Tokens to an expression, and to the parts of the printed formula where these are asked for.
//!
//! ```text
//! sum     = [sign] product { sign product }
//! sign    = "+" | "-" | "±" | "∓"                     the last two only with the parts
//! product = factor { ["*"] factor | "/" factor }      from left to right; "/" and then no sign is refused;
//!                                                     of whole words: a unit behind any factor is that of all before it
//! factor  = {"-"} primary ["^" integer]
//! primary = number [unit] | name | "(" sum ")" | "√" primary | function ["^" integer] arguments
//!         | "\frac" "{" sum "}" "{" sum "}"          with the parts, `cos^{-1}` is the inverse function
//! arguments = "(" sum { "," sum } ")" | "√" primary | "\frac" "{" sum "}" "{" sum "}"
//! ```

use super::calls::{RADIAN, bits};
use super::lexer::{Kind, Token};
use super::measured::{Context, Measures, Term};
use super::parts::Parts;
use super::syntax::{Sign, Syntax, SyntaxKind};
use super::{MAX_NESTING, ParseError};
use crate::expr::Expr;
use crate::vocabulary::Vocabulary;
use std::ops::Range;

/// The expression that `tokens` spell, and what is wrong with their order; `None` where no reading on was possible.
pub(super) fn formula<'a>(
    text: &'a str,
    tokens: &'a [Token],
    vocabulary: &'a Vocabulary,
    measures: Option<&'a mut dyn Measures>,
    is_angle: bool,
) -> (Option<Expr>, Vec<ParseError>) {
    let mut p = Parser::new(text, tokens, vocabulary, measures);
    match p.whole(is_angle) {
        Ok(value) => (Some(p.without_radians(value.expr)), p.errors),
        Err(e) => {
            p.errors.push(e);
            (None, p.errors)
        }
    }
}

/// As [`formula`], with the parts of it, and in the further notations of print.
pub(super) fn syntax(
    text: &str,
    tokens: &[Token],
    vocabulary: &Vocabulary,
) -> (Option<(Expr, Syntax)>, Vec<ParseError>) {
    let mut p = Parser { parts: Some(Parts::default()), ..Parser::new(text, tokens, vocabulary, None) };
    match p.whole(false) {
        Ok(value) => {
            let expr = p.without_radians(value.expr);
            (p.parts.map(|mut parts| (expr, parts.take(value.part))), p.errors)
        }
        Err(e) => {
            p.errors.push(e);
            (None, p.errors)
        }
    }
}

/// An expression, with bounds on its depth and on the bits of the numbers in it.
#[derive(Clone, Copy)]
pub(super) struct Value {
    pub expr: Expr,
    pub height: u32,
    pub bits: u64,
    /// A name occurs.
    pub has_name: bool,
    /// A unit occurs that no other one cancels.
    pub has_unit: bool,
    /// The nodes of the expression, written out.
    pub size: u64,
    /// The number of the part it came from, where parts are asked for.
    pub part: usize,
}

impl Value {
    /// A number, or what is made of numbers.
    pub fn plain(expr: Expr, height: u32, bits: u64) -> Self {
        Value { expr, height, bits, has_name: false, has_unit: false, size: 1, part: 0 }
    }
}

pub(super) struct Parser<'a> {
    pub text: &'a str,
    pub tokens: &'a [Token],
    pub vocabulary: &'a Vocabulary,
    /// What says the meaning of whole words and units; without it, the vocabulary does.
    pub measures: Option<&'a mut dyn Measures>,
    pub context: Context,
    pub at: usize,
    pub depth: usize,
    /// The parts of the formula, if they are asked for; `±` and `cos^{-1}` are read then.
    pub parts: Option<Parts>,
    /// What is wrong without being in the way of reading on.
    pub errors: Vec<ParseError>,
}

/// What a rule of the grammar gives.
pub(super) type Read<T> = Result<T, ParseError>;

impl<'a> Parser<'a> {
    fn new(
        text: &'a str,
        tokens: &'a [Token],
        vocabulary: &'a Vocabulary,
        measures: Option<&'a mut dyn Measures>,
    ) -> Self {
        let context = Context::Whole;
        Parser { text, tokens, vocabulary, measures, context, at: 0, depth: 0, parts: None, errors: vec![] }
    }

    pub fn peek(&self) -> Option<&Kind> {
        self.tokens.get(self.at).map(|t| &t.kind)
    }

    /// The place of token number `i`, the end of the text behind the last one.
    pub fn span_of(&self, i: usize) -> Range<usize> {
        self.tokens.get(i).map_or(self.text.len()..self.text.len(), |t| t.span.clone())
    }

    /// The text of the tokens from number `from` to the present one.
    pub fn span_from(&self, from: usize) -> Range<usize> {
        let (first, last) = (self.span_of(from), self.span_of(self.at.saturating_sub(1)));
        first.start.min(last.end)..last.end.max(first.start)
    }

    pub fn source(&self, span: &Range<usize>) -> &str {
        self.text.get(span.clone()).unwrap_or_default()
    }

    fn whole(&mut self, is_angle: bool) -> Read<Value> {
        if self.tokens.is_empty() {
            return Err(ParseError::new(0..self.text.len(), "no formula"));
        }
        let mut value = self.sum(true)?;
        if self.at < self.tokens.len() {
            return Err(self.unexpected("an operator"));
        }
        if is_angle {
            value = self.angle(value, 0)?;
        }
        Ok(value)
    }

    /// An error at the present token, where `wanted` should stand.
    pub fn unexpected(&self, wanted: &str) -> ParseError {
        let span = self.span_of(self.at);
        let e = match self.peek() {
            None => return ParseError::new(span, format!("the formula ends where {wanted} should stand")),
            Some(Kind::Degree | Kind::Radian) => {
                return ParseError::new(span, "a unit stands directly behind a number");
            }
            Some(Kind::PlusMinus | Kind::MinusPlus) if self.parts.is_none() => {
                let message = format!("`{}` stands for two formulas", self.source(&span));
                return ParseError::new(span, message).hint("write each of them by itself");
            }
            Some(_) => ParseError::new(span.clone(), format!("unexpected `{}`", self.source(&span))),
        };
        match self.peek() {
            Some(Kind::Comma) => e.hint("a decimal point is `.`"),
            Some(Kind::Equals) => e.hint("a formula has no `=`; a definition is `name = formula`"),
            Some(Kind::Close(_)) if self.depth == 0 => e.hint("no bracket is open here"),
            _ => e,
        }
    }

    /// A sum; `is_whole` where it is all that a bracket of a function, or the text, holds.
    pub fn sum(&mut self, is_whole: bool) -> Read<Value> {
        let start = self.at;
        let first_sign = self.sign();
        let mut sign = first_sign.unwrap_or(Sign::Plus);
        let mut terms = vec![];
        loop {
            let from = self.at;
            let term = self.product()?;
            terms.push((sign, term, self.span_from(from)));
            self.chain(terms.len() - 1, start)?;
            match self.sign() {
                Some(next) => sign = next,
                None => break,
            }
        }
        // A number without unit has one where a name or a unit stands beside it.
        let takes_unit = is_whole || terms.iter().any(|(_, t, _)| t.has_name || t.has_unit);
        let parts: Vec<(Sign, usize)> = terms.iter().map(|(sign, t, _)| (*sign, t.part)).collect();
        let mut sum: Option<Value> = None;
        for (sign, mut term, span) in terms {
            if let Some(m) = self.measures.as_deref_mut()
                && takes_unit
                && !(term.has_name || term.has_unit)
            {
                term.expr = m.bare(&Term::new(&term, span), self.context);
            }
            sum = Some(match (sum, sign.is_minus()) {
                (None, false) => term,
                (None, true) => self.made(-term.expr, &[term], start)?,
                (Some(sum), false) => self.made(sum.expr + term.expr, &[sum, term], start)?,
                (Some(sum), true) => self.made(sum.expr - term.expr, &[sum, term], start)?,
            });
        }
        let sum = sum.ok_or_else(|| self.unexpected("a name or a number"))?;
        if first_sign.is_none() && parts.len() == 1 {
            return Ok(sum);
        }
        Ok(self.part(sum, start, |p| {
            SyntaxKind::Sum(parts.into_iter().map(|(sign, part)| (sign, p.take(part))).collect())
        }))
    }

    /// The sign of a term, if one stands here.
    fn sign(&mut self) -> Option<Sign> {
        let sign = match self.peek()? {
            Kind::Plus => Sign::Plus,
            Kind::Minus => Sign::Minus,
            Kind::PlusMinus if self.parts.is_some() => Sign::PlusMinus,
            Kind::MinusPlus if self.parts.is_some() => Sign::MinusPlus,
            _ => return None,
        };
        self.at += 1;
        Some(sign)
    }

    fn product(&mut self) -> Read<Value> {
        let start = self.at;
        let mut product = self.factor()?;
        let mut factors = vec![(false, product.part)];
        let mut divisor = None;
        let mut count = 0;
        let mut is_behind_unit = false;
        loop {
            let operator = self.at;
            if let Some((unit, span)) = self.unit_here() {
                product = self.measured(product, start, &unit, span)?;
                (divisor, is_behind_unit) = (None, true);
                continue;
            }
            let expr = match self.peek() {
                Some(Kind::Times) => {
                    self.at += 1;
                    divisor = None;
                    let factor = self.factor()?;
                    (product.expr * factor.expr, factor)
                }
                Some(Kind::Divide) => {
                    self.at += 1;
                    let over = self.factor()?;
                    divisor = Some(operator + 1);
                    if over.expr.is_zero() {
                        let span = self.span_from(operator);
                        self.errors.push(ParseError::new(span, "division by zero"));
                        continue;
                    }
                    (product.expr / over.expr, over)
                }
                Some(Kind::Number(_)) => {
                    return Err(self.two_values());
                }
                Some(
                    Kind::Atom(_)
                    | Kind::Word(_)
                    | Kind::Function(_)
                    | Kind::Open(_)
                    | Kind::Root
                    | Kind::Fraction,
                ) => {
                    let next = self.at;
                    let between = self.span_of(next - 1).end..self.span_of(next).start;
                    if self.measures.is_some() && self.source(&between).contains('$') {
                        return Err(self.two_values());
                    }
                    if is_behind_unit {
                        let message = format!("`{}` behind a unit", self.source(&self.span_of(next)));
                        let e = ParseError::new(self.span_of(next), message);
                        return Err(e.hint("a product with a unit needs a `*`"));
                    }
                    let factor = self.powered()?;
                    if let Some(from) = divisor {
                        let left = self.span_of(from).start..self.span_of(next - 1).end;
                        let right = self.span_from(next);
                        let (a, b) = (self.source(&left), self.source(&right));
                        let both = format!("`/{a} {b}` reads as `/{a}*{b}` or as `/({a}*{b})`");
                        let span = self.span_of(from - 1).start..right.end;
                        return Err(ParseError::new(span, both).hint("write `*`, brackets or `\\frac`"));
                    }
                    (product.expr * factor.expr, factor)
                }
                _ if factors.len() == 1 => return Ok(product),
                _ => break,
            };
            count += 1;
            let is_over = matches!(self.tokens[operator].kind, Kind::Divide);
            if !is_over && product.is_quantity() && expr.1.is_quantity() {
                return Err(ParseError::new(self.span_from(start), "a product of two quantities with units"));
            }
            let has_unit = product.has_unit != expr.1.has_unit;
            factors.push((is_over, expr.1.part));
            product = Value { has_unit, ..self.made(expr.0, &[product, expr.1], start)? };
            is_behind_unit = false;
            self.chain(count, start)?;
        }
        Ok(self.part(product, start, |p| {
            SyntaxKind::Product(factors.into_iter().map(|(is_over, part)| (is_over, p.take(part))).collect())
        }))
    }

    fn factor(&mut self) -> Read<Value> {
        let start = self.at;
        let mut negative = false;
        while let Some(Kind::Minus) = self.peek() {
            negative = !negative;
            self.at += 1;
        }
        let value = self.powered()?;
        if self.at == start || !matches!(self.tokens[start].kind, Kind::Minus) {
            return Ok(value);
        }
        let (sign, signed) = match negative {
            true => (Sign::Minus, self.made(-value.expr, &[value], start)?),
            false => (Sign::Plus, value),
        };
        Ok(self.part(signed, start, |p| SyntaxKind::Sum(vec![(sign, p.take(value.part))])))
    }

    fn powered(&mut self) -> Read<Value> {
        let start = self.at;
        let base = self.primary()?;
        let Some(n) = self.exponent()? else { return Ok(base) };
        self.raised(base, n, start)
    }

    pub fn primary(&mut self) -> Read<Value> {
        let start = self.at;
        let Some(kind) = self.peek().cloned() else { return Err(self.unexpected("a name or a number")) };
        match kind {
            Kind::Number(r) => {
                self.at += 1;
                let size = bits(&r);
                let number = Expr::from(r.clone());
                let (expr, meaning) = match self.peek() {
                    Some(Kind::Degree) if self.measures.is_none() => {
                        let angle = number * Expr::pi() / Expr::int(180);
                        (angle, angle)
                    }
                    Some(Kind::Radian) if self.vocabulary.in_degrees() => {
                        (number * Expr::symbol(RADIAN), number)
                    }
                    Some(Kind::Radian) => (number, number),
                    _ => {
                        let value = self.made(number, &[Value::plain(number, 0, size)], start)?;
                        return Ok(self.part(value, start, |_| SyntaxKind::Number(r)));
                    }
                };
                self.at += 1;
                let value = self.made(expr, &[Value::plain(expr, 1, size + 8)], start)?;
                Ok(self.part(value, start, |_| SyntaxKind::Name(meaning)))
            }
            Kind::Atom(expr) => {
                self.at += 1;
                Ok(self.part(Value::plain(expr, 4, 0), start, |_| SyntaxKind::Name(expr)))
            }
            Kind::Word(word) => self.named(&word, start),
            Kind::Open(closing) => {
                self.at += 1;
                let inner = self.nested(start, |p| p.bracket(closing, start))?;
                Ok(self.part(inner, start, |p| SyntaxKind::Bracket(p.boxed(inner.part))))
            }
            Kind::Root => {
                self.at += 1;
                let inner = self.nested(start, Self::primary)?;
                let root = self.root(inner, start)?;
                Ok(self.part(root, start, |p| SyntaxKind::Root(Box::new(p.unbracketed(inner.part)))))
            }
            Kind::Fraction => {
                self.at += 1;
                let over = self.nested(start, Self::group)?;
                let under = self.nested(start, Self::group)?;
                if under.expr.is_zero() {
                    return Err(ParseError::new(self.span_from(start), "division by zero"));
                }
                let value = self.made(over.expr / under.expr, &[over, under], start)?;
                Ok(self.part(value, start, |p| SyntaxKind::Fraction(p.boxed(over.part), p.boxed(under.part))))
            }
            Kind::Function(f) => self.nested(start, |p| p.call(f, start)),
            _ => Err(self.unexpected("a name, a number or a bracket")),
        }
    }

    pub fn nested(&mut self, start: usize, read: impl FnOnce(&mut Self) -> Read<Value>) -> Read<Value> {
        self.depth += 1;
        if self.depth > MAX_NESTING {
            let message = format!("nested more than {MAX_NESTING} deep");
            return Err(ParseError::new(self.span_of(start), message));
        }
        let value = read(self)?;
        self.depth -= 1;
        Ok(value)
    }

    /// A sum up to the closing bracket of the one that was opened at `open`.
    fn bracket(&mut self, closing: char, open: usize) -> Read<Value> {
        let value = self.sum(false)?;
        self.close(closing, open)?;
        Ok(value)
    }

    pub fn close(&mut self, closing: char, open: usize) -> Read<()> {
        match self.peek() {
            Some(Kind::Close(c)) if *c == closing => {
                self.at += 1;
                Ok(())
            }
            Some(Kind::Close(_)) => {
                Err(self.unexpected("a bracket").hint(format!("`{closing}` closes the bracket")))
            }
            Some(_) => Err(self.unexpected("an operator")),
            None => Err(ParseError::new(self.span_of(open), format!("no `{closing}` closes this bracket"))),
        }
    }

    /// One argument of `\frac`.
    fn group(&mut self) -> Read<Value> {
        let open = self.at;
        if !matches!(self.peek(), Some(Kind::Open('}'))) {
            return Err(self.unexpected("a group").hint("`\\frac` takes two groups in braces"));
        }
        self.at += 1;
        self.bracket('}', open)
    }
}
