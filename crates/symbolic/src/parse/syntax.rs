//! A formula as it is printed: every sign, bracket and name at its place.

use super::functions::Function;
use crate::expr::Expr;
use crate::rational::Rational;
use std::ops::Range;

/// A part of a printed formula.
#[derive(Clone, Debug, PartialEq)]
pub struct Syntax {
    /// What stands there.
    pub kind: SyntaxKind,
    /// Where, in bytes of the text that was read.
    pub span: Range<usize>,
}

/// What a part of a formula is. No part is nested deeper than the parser allows.
#[derive(Clone, Debug, PartialEq)]
pub enum SyntaxKind {
    /// A number.
    Number(Rational),
    /// A name, a sine of numbered angles written as one word (`S23`), or a number with a unit, as a bare one in degrees
    /// is; with its meaning.
    Name(Expr),
    /// Terms with their signs; the first sign is `Plus` where none is printed. A sum of one term has a sign in print.
    Sum(Vec<(Sign, Syntax)>),
    /// Factors, in the order of print; true for those behind a `/`.
    Product(Vec<(bool, Syntax)>),
    /// `\frac{…}{…}`; the braces belong to it.
    Fraction(Box<Syntax>, Box<Syntax>),
    /// A power with a whole exponent, also that of a function: `cos^2(x)` is the power of a call.
    Power(Box<Syntax>, i32),
    /// A square root; brackets directly around what is under it belong to it.
    Root(Box<Syntax>),
    /// A function of its arguments; the brackets belong to it.
    Call(Function, Vec<Syntax>),
    /// A part in brackets of its own; the span includes them.
    Bracket(Box<Syntax>),
}

/// The sign of a term.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    /// `+`, or none.
    Plus,
    /// `-`
    Minus,
    /// `±`
    PlusMinus,
    /// `∓`
    MinusPlus,
}

impl Sign {
    /// True for `-` and `∓`: the upper sign is a minus.
    pub fn is_minus(self) -> bool {
        matches!(self, Sign::Minus | Sign::MinusPlus)
    }

    /// True for `±` and `∓`.
    pub fn is_two_valued(self) -> bool {
        matches!(self, Sign::PlusMinus | Sign::MinusPlus)
    }
}

impl Syntax {
    /// What the formula means, as [`parse`](super::parse) reads it; of `±` and `∓` the upper signs.
    pub fn value(&self) -> Expr {
        match &self.kind {
            SyntaxKind::Number(r) => r.clone().into(),
            SyntaxKind::Name(e) => *e,
            SyntaxKind::Sum(terms) => {
                let sum = terms.iter().fold(None, |sum: Option<Expr>, (sign, term)| {
                    let (term, is_minus) = (term.value(), sign.is_minus());
                    Some(match sum {
                        None if is_minus => -term,
                        None => term,
                        Some(sum) if is_minus => sum - term,
                        Some(sum) => sum + term,
                    })
                });
                sum.unwrap_or_else(|| Expr::int(0))
            }
            SyntaxKind::Product(factors) => {
                factors.iter().fold(Expr::int(1), |product, (is_divisor, factor)| match is_divisor {
                    false => product * factor.value(),
                    true => product / factor.value(),
                })
            }
            SyntaxKind::Fraction(over, under) => over.value() / under.value(),
            SyntaxKind::Power(base, n) => base.value().powi(*n),
            SyntaxKind::Root(inner) => inner.value().sqrt(),
            SyntaxKind::Call(f, arguments) => f.of(&arguments.iter().map(Syntax::value).collect::<Vec<_>>()),
            SyntaxKind::Bracket(inner) => inner.value(),
        }
    }

    /// The parts that this one is directly made of, in the order of print.
    pub fn children(&self) -> Vec<&Syntax> {
        match &self.kind {
            SyntaxKind::Number(_) | SyntaxKind::Name(_) => vec![],
            SyntaxKind::Sum(terms) => terms.iter().map(|t| &t.1).collect(),
            SyntaxKind::Product(factors) => factors.iter().map(|f| &f.1).collect(),
            SyntaxKind::Fraction(over, under) => vec![over, under],
            SyntaxKind::Power(inner, _) | SyntaxKind::Root(inner) | SyntaxKind::Bracket(inner) => vec![inner],
            SyntaxKind::Call(_, arguments) => arguments.iter().collect(),
        }
    }
}
