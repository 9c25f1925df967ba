//! Small expressions in an author's notation.

use super::style::Style;
use denavit_symbolic::expr::{Expr, Node};
use denavit_symbolic::print;
use denavit_symbolic::rational::Rational;
use denavit_symbolic::vocabulary::Vocabulary;

pub(super) struct Writer<'a> {
    pub style: &'a Style,
    pub vocabulary: &'a Vocabulary,
    /// What stands between factors.
    pub gap: &'a str,
}

/// A number without sign.
pub(super) fn number(r: &Rational) -> String {
    let (n, d) = r.digits();
    if d == "1" { n } else { format!("{n}/{d}") }
}

impl Writer<'_> {
    /// The factors as one: a sum in brackets.
    pub fn factors(&self, factors: &[Expr]) -> String {
        match factors {
            [one] => self.factor(*one),
            _ => self.product_of(factors),
        }
    }

    fn factor(&self, e: Expr) -> String {
        match e.node() {
            _ if self.style.knows(e) => self.primary(e),
            Node::Add(..) | Node::Sub(..) | Node::Neg(_) | Node::Div(..) => format!("({})", self.sum(e)),
            _ => self.product(e),
        }
    }

    /// The expression as a term.
    pub fn term(&self, e: Expr, behind_minus: bool) -> String {
        match e.node() {
            _ if self.style.knows(e) => self.primary(e),
            Node::Add(..) | Node::Sub(..) if !behind_minus => self.sum(e),
            Node::Add(..) | Node::Sub(..) | Node::Neg(_) => format!("({})", self.sum(e)),
            _ => self.product(e),
        }
    }

    fn sum(&self, e: Expr) -> String {
        match e.node() {
            _ if self.style.knows(e) => self.primary(e),
            Node::Add(a, b) => format!("{}{}{}", self.sum(a), self.style.term_gap(false), self.term(b, true)),
            Node::Sub(a, b) => format!("{}{}{}", self.sum(a), self.style.term_gap(true), self.term(b, true)),
            Node::Neg(a) => format!("{}{}", self.style.minus(), self.term(a, true)),
            _ => self.product(e),
        }
    }

    fn product(&self, e: Expr) -> String {
        let mut factors = vec![];
        self.flatten(e, &mut factors);
        self.product_of(&factors)
    }

    /// Factors in the author's order.
    pub fn product_of(&self, factors: &[Expr]) -> String {
        let ordered = self.ordered(factors);
        let texts = ordered.iter().map(|&f| (self.primary(f), self.is_bracket(f)));
        let mut text = String::new();
        for (i, (factor, is_bracket)) in texts.enumerate() {
            let is_space = self.gap.trim().is_empty();
            text.push_str(if i == 0 || is_bracket && is_space { "" } else { self.gap });
            text.push_str(&factor);
        }
        text
    }

    fn ordered(&self, factors: &[Expr]) -> Vec<Expr> {
        // Insertion, since the order learned need not be transitive.
        let mut ordered: Vec<Expr> = vec![];
        for &f in factors {
            let at = ordered.iter().rposition(|&o| self.style.compare(o, f).is_le()).map_or(0, |i| i + 1);
            ordered.insert(at, f);
        }
        ordered
    }

    /// The name that the product begins with.
    pub fn lead(&self, factors: &[Expr]) -> Option<Expr> {
        let mut flat = vec![];
        factors.iter().for_each(|&f| self.flatten(f, &mut flat));
        let first = *self.ordered(&flat).first()?;
        match first.node() {
            _ if self.style.knows(first) => Some(first),
            Node::Add(a, _) | Node::Sub(a, _) | Node::Div(a, _) | Node::Neg(a) => self.lead(&[a]),
            _ => Some(first),
        }
    }

    fn is_bracket(&self, e: Expr) -> bool {
        matches!(e.node(), Node::Add(..) | Node::Sub(..)) && !self.style.knows(e)
    }

    fn primary(&self, e: Expr) -> String {
        match e.node() {
            _ if self.style.knows(e) => self.style.spell(e, self.vocabulary),
            Node::Symbol(_) | Node::Sin(_) | Node::Cos(_) => self.style.spell(e, self.vocabulary),
            Node::Number(r) if !r.is_negative() => number(&r),
            Node::Add(..) | Node::Sub(..) | Node::Neg(_) => format!("({})", self.sum(e)),
            Node::Pow(a, n) if (2..10).contains(&n) => format!("{}^{n}", self.primary(a)),
            Node::Div(a, b) => format!("{}/{}", self.primary(a), self.factor_below(b)),
            _ => print::print(e, self.vocabulary, print::Style::Ascii),
        }
    }

    fn factor_below(&self, e: Expr) -> String {
        match e.node() {
            Node::Mul(..) => format!("({})", self.product(e)),
            _ => self.primary(e),
        }
    }

    fn flatten(&self, e: Expr, factors: &mut Vec<Expr>) {
        match e.node() {
            Node::Mul(a, b) if !self.style.knows(e) => {
                self.flatten(a, factors);
                self.flatten(b, factors);
            }
            _ => factors.push(e),
        }
    }
}
