//! Formulas in the syntax that the checker reads, which is Python's: `a2*cos(q2) + 3/2*sqrt(2)`.

use crate::field::{Field, root_of_number};
use denavit_symbolic::poly::{Monomial, Poly};
use denavit_symbolic::{Expr, Node, Rational};

/// How a formula is written.
pub trait Dialect {
    /// A power of what stands in brackets if it has to.
    fn power(&self, base: &str, n: u32) -> String;
    /// A rational number, in brackets unless it is an integer that is not negative.
    fn number(&self, r: &Rational) -> String;
    /// A sine or cosine.
    fn circular(&self, field: &mut Field, argument: Expr, is_sine: bool) -> String;
    /// The root of a positive integer.
    fn surd(&self, field: &mut Field, prime: i64) -> String;
    /// The root of a formula.
    fn root(&self, field: &mut Field, of: Expr) -> String;
}

/// The syntax of Python.
pub struct Python;

impl Dialect for Python {
    fn power(&self, base: &str, n: u32) -> String {
        format!("{base}**{n}")
    }

    fn number(&self, r: &Rational) -> String {
        let (n, d) = r.digits();
        let sign = if r.is_negative() { "-" } else { "" };
        if r.is_integer() { format!("{sign}{n}") } else { format!("{sign}{n}/{d}") }
    }

    fn circular(&self, field: &mut Field, argument: Expr, is_sine: bool) -> String {
        format!("{}({})", if is_sine { "sin" } else { "cos" }, text(field, argument, self))
    }

    fn surd(&self, _: &mut Field, prime: i64) -> String {
        format!("sqrt({prime})")
    }

    fn root(&self, field: &mut Field, of: Expr) -> String {
        format!("sqrt({})", text(field, of, self))
    }
}

/// Summands beyond which a sum is cut into brackets: readers of long sums go as deep as they are long.
const LONG: usize = 60;
/// The binding of sums, products and of what needs no brackets.
const SUM: u8 = 0;
const PRODUCT: u8 = 1;
const ATOM: u8 = 2;

/// A formula as text.
pub fn text(field: &mut Field, e: Expr, dialect: &dyn Dialect) -> String {
    written(field, e, dialect).0
}

fn bracketed((text, binding): (String, u8), least: u8) -> String {
    if binding < least { format!("({text})") } else { text }
}

fn written(field: &mut Field, e: Expr, dialect: &dyn Dialect) -> (String, u8) {
    match e.node() {
        Node::Number(r) => (dialect.number(&r), if r.is_integer() && !r.is_negative() { ATOM } else { SUM }),
        Node::Pi => ("pi".into(), ATOM),
        Node::Symbol(s) => (field.names.of(s), ATOM),
        Node::Neg(a) => (format!("-{}", bracketed(written(field, a, dialect), PRODUCT)), SUM),
        Node::Add(..) | Node::Sub(..) => (sum(field, e, dialect), SUM),
        Node::Mul(a, b) => {
            let a = match a.node() {
                Node::Number(r) if !r.is_negative() => dialect.number(&r),
                _ => bracketed(written(field, a, dialect), PRODUCT),
            };
            (format!("{a}*{}", bracketed(written(field, b, dialect), ATOM)), PRODUCT)
        }
        Node::Div(a, b) => {
            let (a, b) = (written(field, a, dialect), written(field, b, dialect));
            (format!("{}/{}", bracketed(a, PRODUCT), bracketed(b, ATOM)), PRODUCT)
        }
        Node::Pow(a, n) => {
            let base = bracketed(written(field, a, dialect), ATOM);
            let power = dialect.power(&base, n.unsigned_abs());
            if n < 0 { (format!("1/({power})"), PRODUCT) } else { (format!("({power})"), ATOM) }
        }
        Node::Sqrt(a) => match a.as_number().and_then(|r| root_of_number(&r)) {
            None => (dialect.root(field, a), ATOM),
            Some((outside, primes)) => {
                let mut product = dialect.number(&outside);
                for p in primes {
                    product += &format!("*{}", dialect.surd(field, p));
                }
                (product, PRODUCT)
            }
        },
        Node::Sin(a) => (dialect.circular(field, a, true), ATOM),
        Node::Cos(a) => (dialect.circular(field, a, false), ATOM),
        Node::Atan2(..) => ("atan2".into(), ATOM),
        Node::Sign(_) => ("sign".into(), ATOM),
    }
}

/// A sum, from the left; a long one in brackets by pieces.
fn sum(field: &mut Field, e: Expr, dialect: &dyn Dialect) -> String {
    let (mut terms, mut at) = (vec![], e);
    loop {
        match at.node() {
            Node::Add(a, b) => {
                terms.push((b, false));
                at = a;
            }
            Node::Sub(a, b) => {
                terms.push((b, true));
                at = a;
            }
            _ => break,
        }
    }
    terms.push((at, false));
    terms.reverse();
    let mut pieces: Vec<(bool, String)> = terms
        .into_iter()
        .enumerate()
        .map(|(i, (term, minus))| {
            let part = written(field, term, dialect);
            (minus, bracketed(part, if i == 0 { SUM } else { PRODUCT }))
        })
        .collect();
    while pieces.len() > LONG {
        let join = |part: &[(bool, String)]| (false, format!("({})", joined(part)));
        pieces = pieces.chunks(LONG).map(join).collect();
    }
    joined(&pieces)
}

fn joined(pieces: &[(bool, String)]) -> String {
    let mut text = String::new();
    for (i, (minus, piece)) in pieces.iter().enumerate() {
        text += match (i, minus) {
            (0, false) => "",
            (0, true) => "0 - ",
            (_, false) => " + ",
            (_, true) => " - ",
        };
        text += piece;
    }
    text
}

/// A polynomial as text.
pub fn polynomial(field: &Field, p: &Poly, dialect: &dyn Dialect) -> String {
    let product = |(m, r): &(Monomial, Rational)| {
        let power = |&(atom, n): &(u16, u16)| {
            let name = &field.atoms[usize::from(atom)];
            if n == 1 { name.clone() } else { dialect.power(name, n.into()) }
        };
        let mut factors: Vec<String> = m.factors().iter().map(power).collect();
        if factors.is_empty() || !r.abs().is_one() {
            factors.insert(0, dialect.number(&r.abs()));
        }
        (r.is_negative(), factors.join("*"))
    };
    let mut pieces: Vec<(bool, String)> = p.terms().iter().map(product).collect();
    while pieces.len() > LONG {
        pieces = pieces.chunks(LONG).map(|part| (false, format!("({})", joined(part)))).collect();
    }
    if pieces.is_empty() { "0".into() } else { joined(&pieces) }
}
