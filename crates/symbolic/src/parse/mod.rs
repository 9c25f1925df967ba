//! Reading formulas as people print them: `C1(C23C4 − S4)`, `\frac{a_2}{2}\cos\theta_1`, `c2.(D_7 + s_{34}.r_7)`.
//!
//! Text → marks (`normalise`: Unicode and LaTeX spellings become plain characters) → tokens (`lexer`; words are taken
//! up by `gather` and cut into names and sines by `words` and `trig`) → [`Expr`] (`grammar`, `calls`), and the same
//! formula as it is printed, [`Syntax`] (`parts`, `signs`), where that is asked for. Places are bytes of the text as it
//! came in. What has two readings is refused with both of them.

mod calls;
mod functions;
mod gather;
mod grammar;
mod lexer;
mod measured;
mod names;
mod normalise;
mod parts;
mod signs;
mod syntax;
mod trig;
mod words;

pub use functions::Function;
pub use measured::{Context, Measures, Term, parse_measured, whole_word};
pub use normalise::{greek_name, subscript};
pub use syntax::{Sign, Syntax, SyntaxKind};

use crate::expr::Expr;
use crate::vocabulary::Vocabulary;
use std::fmt;
use std::ops::Range;

/// The longest text that is read, in bytes.
pub const MAX_BYTES: usize = 65_536;
/// The deepest nesting of brackets, roots and fractions.
pub const MAX_NESTING: usize = 100;
/// The most operators in one sum or product.
pub(crate) const MAX_OPERATORS: usize = 2_000;
/// The most signs of two values in one formula that are chosen by themselves.
pub const MAX_SIGN_CHOICES: usize = 6;
/// The largest magnitude of an exponent.
pub const MAX_EXPONENT: i32 = 1_000;
/// No more errors than these are reported for one text.
const MAX_ERRORS: usize = 20;

/// What is wrong with a formula, and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ParseError {
    /// The place, in bytes of the text that was read.
    pub span: Range<usize>,
    /// What is wrong, in one line.
    pub message: String,
    /// What to write instead, if that is known.
    pub hint: Option<String>,
}

impl ParseError {
    /// An error without a hint.
    pub fn new(span: Range<usize>, message: impl Into<String>) -> Self {
        ParseError { span, message: message.into(), hint: None }
    }

    /// The error with what to write instead.
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }
}

impl fmt::Display for ParseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)?;
        self.hint.as_ref().map_or(Ok(()), |hint| write!(f, "; {hint}"))
    }
}

impl std::error::Error for ParseError {}

/// A named formula, `c34 = c3.c4 - s3.s4`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Definition {
    /// The name on the left, without marks of subscripts (`D_1` and `D1` are one name).
    pub name: String,
    /// The place of the name.
    pub span: Range<usize>,
    /// The formula on the right.
    pub value: Expr,
}

/// Reads a formula.
///
/// ```
/// use denavit_symbolic::{Expr, Symbol, parse::parse, vocabulary::Vocabulary};
/// let names = Vocabulary::new()
///     .symbols(["D3", "RL4"])
///     .angle(1, Symbol::new("q1"))
///     .angle(2, Symbol::new("q2"))
///     .angle(3, Symbol::new("q3"));
/// let q = |n: i32| Expr::symbol(&format!("q{n}"));
/// let printed = parse("C1(C2D3 − S23RL4)", &names).unwrap();
/// assert_eq!(
///     printed,
///     q(1).cos() * (q(2).cos() * Expr::symbol("D3") - (q(2) + q(3)).sin() * Expr::symbol("RL4"))
/// );
/// let errors = parse("S23R4", &names).unwrap_err();
/// assert_eq!(errors[0].to_string(), "unknown `R4`; did you mean `RL4`?");
/// assert_eq!(errors[0].span, 3..5);
/// ```
///
/// # Errors
/// All that is wrong with the words of the text, and the first thing that is wrong with its structure.
pub fn parse(text: &str, vocabulary: &Vocabulary) -> Result<Expr, Vec<ParseError>> {
    read(text, vocabulary, false)
}

/// Reads an angle: as [`parse`], but in a vocabulary in degrees a bare number in the sum is one (`90 + θ2`).
///
/// # Errors
/// As [`parse`].
pub fn parse_angle(text: &str, vocabulary: &Vocabulary) -> Result<Expr, Vec<ParseError>> {
    read(text, vocabulary, true)
}

fn read(text: &str, vocabulary: &Vocabulary, is_angle: bool) -> Result<Expr, Vec<ParseError>> {
    let (marks, mut errors) = normalise::normalise(checked(text)?);
    let (tokens, is_whole) = lexer::tokens(text, &marks, vocabulary, None, &mut errors);
    let (value, structure) = grammar::formula(text, &tokens, vocabulary, None, is_angle);
    errors.extend(structure.into_iter().filter(|_| is_whole));
    finish(value, errors)
}

/// Reads a formula as it is printed, with every sign, bracket and name at its place. Its value is what [`parse`] gives.
///
/// Two more notations are read: signs of two values, `±` and `∓`, and `cos^{-1}(x)` for the inverse function.
///
/// ```
/// use denavit_symbolic::{parse::{parse, parse_syntax}, vocabulary::Vocabulary};
/// let open = Vocabulary::new().open(true);
/// let text = r"\pm\cos^{-1}\left(\frac{a^2 - b^2}{2 a b}\right)";
/// let [upper, lower] = &parse_syntax(text, &open).unwrap().variants()[..] else { panic!() };
/// assert_eq!(upper.value(), parse("arccos((a^2 - b^2)/(2*a*b))", &open).unwrap());
/// assert_eq!(lower.value(), -upper.value());
/// assert_eq!(upper.span, 0..text.len());
/// ```
///
/// # Errors
/// As [`parse`], of every formula that the signs give.
pub fn parse_syntax(text: &str, vocabulary: &Vocabulary) -> Result<Syntax, Vec<ParseError>> {
    let (marks, mut errors) = normalise::normalise(checked(text)?);
    let (tokens, is_whole) = lexer::tokens(text, &marks, vocabulary, None, &mut errors);
    let (read, structure) = grammar::syntax(text, &tokens, vocabulary);
    errors.extend(structure.into_iter().filter(|_| is_whole));
    let (_, syntax) = finish(read, errors)?;
    signs::check(text, &tokens, vocabulary, &syntax)?;
    Ok(syntax)
}

/// Reads a definition, `name = formula`; a `;`, `,` or `.` may end it.
///
/// ```
/// use denavit_symbolic::{parse::{parse, parse_definition}, vocabulary::Vocabulary};
/// let open = Vocabulary::new().open(true);
/// let d = parse_definition("D_7 = c3.D_3 - s3.D_4 + a_2;", &open).unwrap();
/// assert_eq!((d.name.as_str(), d.span), ("D7", 0..3));
/// assert_eq!(d.value, parse("cos(q3)*D3 - sin(q3)*D4 + a2", &open).unwrap());
/// ```
///
/// # Errors
/// As [`parse`], and if there is not one name before one `=`.
pub fn parse_definition(text: &str, vocabulary: &Vocabulary) -> Result<Definition, Vec<ParseError>> {
    let (mut marks, mut errors) = normalise::normalise(checked(text)?);
    while marks.last().is_some_and(|m| m.is_space()) {
        marks.pop();
    }
    if marks.last().is_some_and(|m| matches!(m.char(), Some(';' | ',' | '.'))) {
        marks.pop();
    }
    let Some(equals) = marks.iter().position(|m| m.char() == Some('=')) else {
        errors.push(ParseError::new(0..text.len(), "no `=`").hint("write `name = formula`"));
        return Err(errors);
    };
    let name = lexer::defined_name(text, &marks[..equals], vocabulary);
    let (tokens, is_whole) = lexer::tokens(text, &marks[equals + 1..], vocabulary, None, &mut errors);
    let (value, structure) = grammar::formula(text, &tokens, vocabulary, None, false);
    errors.extend(structure.into_iter().filter(|_| is_whole));
    match name {
        Ok((name, span)) => finish(value, errors).map(|value| Definition { name, span, value }),
        Err(e) => {
            errors.push(e);
            finish(None, errors)
        }
    }
}

fn checked(text: &str) -> Result<&str, Vec<ParseError>> {
    if text.len() > MAX_BYTES {
        let message = format!("the text has {} bytes; at most {MAX_BYTES} are read", text.len());
        return Err(vec![ParseError::new(0..text.len(), message)]);
    }
    Ok(text)
}

fn finish<T>(value: Option<T>, mut errors: Vec<ParseError>) -> Result<T, Vec<ParseError>> {
    match value {
        Some(value) if errors.is_empty() => Ok(value),
        _ => {
            errors.sort_by_key(|e| (e.span.start, e.span.end));
            errors.dedup();
            errors.truncate(MAX_ERRORS);
            Err(errors)
        }
    }
}
