//! Formulas of whole words and numbers with units: `a1 + 20 mm`, `\theta_2 - 90^\circ`.
//!
//! A word is never cut; what it means and what a unit is says a [`Measures`]. A unit holds for the product before it.

use super::functions::{CALLED, Function};
use super::grammar::{Parser, Read, Value, formula};
use super::lexer::{self, Kind};
use super::{ParseError, checked, finish, normalise};
use crate::expr::Expr;
use crate::vocabulary::Vocabulary;
use std::ops::Range;

/// Where a term stands.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Context {
    /// In no function.
    Whole,
    /// In the argument of a sine, cosine or tangent.
    Angle,
    /// In the argument of another function.
    Plain,
}

/// A product, and what is known of its unit.
#[derive(Clone, Debug)]
pub struct Term {
    /// Its value so far.
    pub expr: Expr,
    /// Its place.
    pub span: Range<usize>,
    /// Whether a name occurs in it.
    pub has_name: bool,
    /// Whether it has a unit.
    pub has_unit: bool,
}

impl Term {
    pub(super) fn new(value: &Value, span: Range<usize>) -> Self {
        Term { expr: value.expr, span, has_name: value.has_name, has_unit: value.has_unit }
    }
}

/// The meaning of words and units.
pub trait Measures {
    /// What a word means, and whether that has a unit in it, as π does in an angle.
    ///
    /// # Errors
    /// If it means nothing.
    fn word(&mut self, word: &str, span: Range<usize>, context: Context) -> Result<(Expr, bool), ParseError>;

    /// The length of the unit that `text` begins with.
    fn unit_at(&self, text: &str) -> Option<usize>;

    /// The value of a term with a unit behind it.
    ///
    /// # Errors
    /// If the unit does not go with the term.
    fn measured(
        &mut self,
        term: &Term,
        unit: (&str, Range<usize>),
        context: Context,
    ) -> Result<Expr, ParseError>;

    /// The value of a number without a unit.
    fn bare(&mut self, term: &Term, context: Context) -> Expr;

    /// Whether one more power, the `n`-th, is allowed.
    ///
    /// # Errors
    /// Why it is not.
    fn power(&mut self, n: i32) -> Result<(), String>;
}

/// Reads a formula of whole words and numbers with units.
///
/// # Errors
/// As [`parse`](super::parse), and what `measures` refuses.
pub fn parse_measured(text: &str, measures: &mut dyn Measures) -> Result<Expr, Vec<ParseError>> {
    let vocabulary = Vocabulary::new();
    let (marks, mut errors) = normalise::normalise(checked(text)?);
    let (tokens, is_whole) =
        lexer::tokens(text, &marks, &vocabulary, Some(&|word| measures.unit_at(word)), &mut errors);
    if !is_whole || !errors.is_empty() {
        return finish(None, errors);
    }
    let (value, structure) = formula(text, &tokens, &vocabulary, Some(measures), false);
    finish(value, structure)
}

/// The word that is all of `text`; `d(O_2, O_3)` counts as the word `dO_2O_3`.
///
/// ```
/// use denavit_symbolic::parse::whole_word;
/// assert_eq!(whole_word(r"$\mathrm{RL}_{4}$").as_deref(), Some("RL_4"));
/// assert_eq!(whole_word("a₁").as_deref(), Some("a1"));
/// assert_eq!(whole_word("d(O_2, O_3)").as_deref(), Some("dO_2O_3"));
/// assert_eq!(whole_word("2 a"), None);
/// ```
pub fn whole_word(text: &str) -> Option<String> {
    let (marks, mut errors) = normalise::normalise(checked(text).ok()?);
    let vocabulary = Vocabulary::new();
    let (tokens, is_whole) = lexer::tokens(text, &marks, &vocabulary, Some(&|_| None), &mut errors);
    let kinds: Vec<&Kind> = tokens.iter().map(|t| &t.kind).collect();
    match kinds.as_slice() {
        [Kind::Word(word)] if is_whole && errors.is_empty() => Some(word.clone()),
        [Kind::Word(word), rest @ ..] if is_whole && errors.is_empty() => {
            bracketed(rest).filter(|b| b.1 == rest.len()).map(|b| format!("{word}{}", b.0))
        }
        _ => None,
    }
}

/// Two words or more with commas between them in brackets, run together, and the number of tokens.
fn bracketed(tokens: &[&Kind]) -> Option<(String, usize)> {
    let close = tokens.iter().position(|t| matches!(t, Kind::Close(')')))?;
    let [Kind::Open(')'), inside @ ..] = &tokens[..close] else { return None };
    let mut name = String::new();
    for (i, token) in inside.iter().enumerate() {
        match (token, i % 2) {
            (Kind::Word(word), 0) => name.push_str(word),
            (Kind::Comma, 1) => {}
            _ => return None,
        }
    }
    (inside.len() >= 3 && inside.len() % 2 == 1).then_some((name, close + 1))
}

impl Value {
    /// True for a number with a unit.
    pub(crate) fn is_quantity(&self) -> bool {
        self.has_unit && !self.has_name
    }
}

impl Parser<'_> {
    /// The unit at the present token, and its place.
    pub(crate) fn unit_here(&self) -> Option<(String, Range<usize>)> {
        let measures = self.measures.as_deref()?;
        let name = match self.peek()? {
            Kind::Word(word) => word,
            Kind::Degree => "deg",
            _ => return None,
        };
        let span = self.span_of(self.at);
        let rest = self.text.get(span.start..)?;
        match measures.unit_at(rest) {
            Some(length) => Some((rest[..length].to_string(), span.start..span.start + length)),
            None => measures.unit_at(name).filter(|&n| n == name.len()).map(|_| (name.to_string(), span)),
        }
    }

    /// The product from token `start` on with the unit that stands here.
    pub fn measured(&mut self, product: Value, start: usize, unit: &str, span: Range<usize>) -> Read<Value> {
        let term = Term::new(&product, self.span_from(start));
        // The brackets around a superscript of Unicode have no bytes of their own.
        let is_inside = |at: Range<usize>| at.start < span.end || at.start == span.end && at.is_empty();
        while self.at < self.tokens.len() && is_inside(self.span_of(self.at)) {
            self.at += 1;
        }
        let context = self.context;
        let Some(measures) = self.measures.as_deref_mut() else { return Ok(product) };
        let expr = measures.measured(&term, (unit, span), context)?;
        Ok(Value { has_unit: true, ..self.made(expr, &[product], start)? })
    }

    pub(crate) fn two_values(&self) -> ParseError {
        let e = ParseError::new(self.span_of(self.at), "two values without a sign between them");
        e.hint("write a product with `*`")
    }

    /// A whole word: a function, a distance `d(O_2, O_3)`, or a name.
    pub fn named(&mut self, word: &str, start: usize) -> Read<Value> {
        self.at += 1;
        let called = CALLED.iter().find(|f: &&Function| f.name() == word);
        if let (Some(f), Some(Kind::Open(_) | Kind::Caret)) = (called, self.peek()) {
            self.at = start;
            return self.nested(start, |p| p.call(*f, start));
        }
        let rest: Vec<&Kind> = self.tokens[self.at..].iter().map(|t| &t.kind).take(100).collect();
        let mut name = word.to_string();
        if let Some((inside, length)) = bracketed(&rest) {
            name.push_str(&inside);
            self.at += length;
        }
        let (span, context) = (self.span_from(start), self.context);
        let Some(measures) = self.measures.as_deref_mut() else { return Err(self.unexpected("a name")) };
        let (expr, has_unit) = measures.word(&name, span, context)?;
        Ok(Value { has_name: expr.as_symbol().is_some(), has_unit, ..Value::plain(expr, 4, 0) })
    }
}
