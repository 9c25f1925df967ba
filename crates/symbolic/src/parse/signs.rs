//! Signs with two values, `±` and `∓`: what can be chosen, and that every choice is a formula.

use super::grammar;
use super::lexer::{Kind, Token};
use super::syntax::{Sign, Syntax, SyntaxKind};
use super::{MAX_SIGN_CHOICES, ParseError, finish};
use crate::vocabulary::Vocabulary;

/// One choice of the signs, which are taken in the order of print.
struct Choice {
    /// For each sign that is chosen by itself whether it is the lower one.
    is_lower: Vec<bool>,
    taken: usize,
}

impl Choice {
    /// Choice number `index` of `count` signs; the last sign changes first.
    fn new(index: usize, count: usize) -> Self {
        Choice { is_lower: (0..count).rev().map(|i| index >> i & 1 == 1).collect(), taken: 0 }
    }

    /// `±` is chosen by itself, and so is a `∓` before which no `±` stands; another `∓` goes with the sign before it.
    fn take(&mut self, sign: Sign) -> Sign {
        self.taken += usize::from(sign == Sign::PlusMinus || sign == Sign::MinusPlus && self.taken == 0);
        let is_lower = self.taken.checked_sub(1).and_then(|i| self.is_lower.get(i)) == Some(&true);
        match (sign, is_lower) {
            (Sign::Plus, _) | (Sign::PlusMinus, false) | (Sign::MinusPlus, true) => Sign::Plus,
            (Sign::Minus, _) | (Sign::PlusMinus, true) | (Sign::MinusPlus, false) => Sign::Minus,
        }
    }

    fn take_in(&mut self, part: &mut Syntax) {
        match &mut part.kind {
            SyntaxKind::Number(_) | SyntaxKind::Name(_) => {}
            SyntaxKind::Sum(terms) => {
                for (sign, term) in terms {
                    *sign = self.take(*sign);
                    self.take_in(term);
                }
            }
            SyntaxKind::Product(factors) => factors.iter_mut().for_each(|(_, f)| self.take_in(f)),
            SyntaxKind::Fraction(over, under) => {
                self.take_in(over);
                self.take_in(under);
            }
            SyntaxKind::Power(inner, _) | SyntaxKind::Root(inner) | SyntaxKind::Bracket(inner) => {
                self.take_in(inner);
            }
            SyntaxKind::Call(_, arguments) => arguments.iter_mut().for_each(|a| self.take_in(a)),
        }
    }
}

impl Syntax {
    /// How many signs can be chosen: every `±` by itself. A `∓` is the opposite of the `±` before it, and is chosen by
    /// itself where there is none.
    pub fn sign_choices(&self) -> usize {
        fn count(part: &Syntax, choice: &mut Choice) {
            match &part.kind {
                SyntaxKind::Sum(terms) => terms.iter().for_each(|(sign, term)| {
                    choice.take(*sign);
                    count(term, choice);
                }),
                _ => part.children().into_iter().for_each(|c| count(c, choice)),
            }
        }
        let mut choice = Choice::new(0, 0);
        count(self, &mut choice);
        choice.taken
    }

    /// The formula for every choice of its signs, without `±` and `∓`: the upper signs first, and the last sign changes
    /// first. None at all beyond [`MAX_SIGN_CHOICES`], to which a formula that was read keeps.
    pub fn variants(&self) -> Vec<Syntax> {
        let count = self.sign_choices();
        if count > MAX_SIGN_CHOICES {
            return vec![];
        }
        let variant = |index| {
            let mut variant = self.clone();
            Choice::new(index, count).take_in(&mut variant);
            variant
        };
        (0..1 << count).map(variant).collect()
    }
}

/// Whether every choice of signs in `tokens`, which `syntax` came from, is a formula with the meaning that its parts give.
pub(super) fn check(
    text: &str,
    tokens: &[Token],
    vocabulary: &Vocabulary,
    syntax: &Syntax,
) -> Result<(), Vec<ParseError>> {
    let count = syntax.sign_choices();
    if count > MAX_SIGN_CHOICES {
        let message = format!("more than {MAX_SIGN_CHOICES} signs of two values");
        return Err(vec![ParseError::new(syntax.span.clone(), message)]);
    }
    for (index, variant) in syntax.variants().into_iter().enumerate() {
        let mut choice = Choice::new(index, count);
        let chosen: Vec<Token> = tokens.iter().map(|t| with_sign(t, &mut choice)).collect();
        let (read, errors) = grammar::syntax(text, &chosen, vocabulary);
        if !errors.is_empty() {
            return finish(None, errors);
        }
        if read.is_none_or(|(value, _)| value != variant.value()) {
            let message = "the meaning depends on the signs of two values in it";
            return Err(vec![
                ParseError::new(syntax.span.clone(), message).hint("write one formula for each"),
            ]);
        }
    }
    Ok(())
}

fn with_sign(token: &Token, choice: &mut Choice) -> Token {
    let sign = match token.kind {
        Kind::PlusMinus => choice.take(Sign::PlusMinus),
        Kind::MinusPlus => choice.take(Sign::MinusPlus),
        _ => return token.clone(),
    };
    let kind = if sign == Sign::Minus { Kind::Minus } else { Kind::Plus };
    Token { kind, span: token.span.clone() }
}
