//! Formulas in the languages.

use crate::names::Names;
use crate::{Language, Precision};
use denavit_program::{Op, Value};
use denavit_symbolic::{Expr, Node, Rational};

/// How formulas are written.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spelling<'a> {
    pub language: Language,
    pub precision: Precision,
    pub names: &'a Names,
}

/// How tightly the outermost operation of a text binds.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Sum,
    Product,
    Sign,
    Atom,
}

impl Spelling<'_> {
    /// A formula; constants that are no plain numbers are written as the double nearest to them.
    pub fn formula(&self, e: Expr) -> String {
        self.bound(e).0
    }

    /// A number so that it reads back to the same bits.
    pub fn number(&self, x: f64) -> String {
        let digits = match self.precision {
            Precision::Double => format!("{x:?}"),
            Precision::Single => format!("{:?}", x as f32),
        };
        match (self.language, self.precision) {
            (Language::C | Language::Cuda | Language::IkFast, Precision::Single) => format!("{digits}f"),
            (Language::Rust | Language::C | Language::Cuda | Language::IkFast, _) => digits,
            (Language::Python | Language::Matlab | Language::JavaScript, _) => {
                digits.strip_suffix(".0").map_or(digits.clone(), str::to_string)
            }
        }
    }

    fn bound(&self, e: Expr) -> (String, Binding) {
        if let (Ok(x), true) = (e.eval(|_| None), e.symbols().is_empty()) {
            let binding = if x.is_sign_negative() { Binding::Sign } else { Binding::Atom };
            return (self.number(x), binding);
        }
        let at_least = |e: Expr, least: Binding| {
            let (text, binding) = self.bound(e);
            if binding < least { format!("({text})") } else { text }
        };
        let any = Value { node: 0, negative: false };
        let call = |op: Op, arguments: &[Expr]| {
            // Compiled languages have no such call in what is emitted; their libraries name them as the text form does.
            let name = function_name(&op, self.language, self.precision).unwrap_or_else(|| op.mnemonic());
            let arguments: Vec<String> = arguments.iter().map(|a| self.formula(*a)).collect();
            (format!("{name}({})", arguments.join(", ")), Binding::Atom)
        };
        match e.node() {
            Node::Number(_) | Node::Pi => unreachable!("a constant"),
            Node::Symbol(s) => (self.names.of(s).to_string(), Binding::Atom),
            // A product that begins with a minus loses it.
            Node::Neg(a) => match at_least(a, Binding::Product) {
                text if text.starts_with('-') => (text[1..].into(), Binding::Product),
                text => (format!("-{text}"), Binding::Sign),
            },
            Node::Add(a, b) => {
                (sum(&at_least(a, Binding::Sum), '+', &at_least(b, Binding::Product)), Binding::Sum)
            }
            Node::Sub(a, b) => {
                (sum(&at_least(a, Binding::Sum), '-', &at_least(b, Binding::Product)), Binding::Sum)
            }
            Node::Mul(a, b) => {
                if let Some(joined) = with_one_constant(e) {
                    return self.bound(joined);
                }
                let sign = self.product();
                let text = format!("{}{sign}{}", at_least(a, Binding::Product), at_least(b, Binding::Sign));
                (text, Binding::Product)
            }
            Node::Div(a, b) => {
                let sign = self.quotient();
                let text = format!("{}{sign}{}", at_least(a, Binding::Product), at_least(b, Binding::Atom));
                (text, Binding::Product)
            }
            Node::Pow(a, n) => {
                let factor = at_least(a, Binding::Sign);
                let factors = vec![factor; n.unsigned_abs() as usize].join(self.product());
                if n < 0 {
                    let text = format!("{}{}({factors})", self.number(1.0), self.quotient());
                    return (text, Binding::Product);
                }
                (factors, Binding::Product)
            }
            Node::Sqrt(a) => call(Op::Sqrt(any), &[a]),
            Node::Sin(a) => call(Op::Sin(0), &[a]),
            Node::Cos(a) => call(Op::Cos(0), &[a]),
            Node::Atan2(y, x) => call(Op::Atan2(any, any), &[y, x]),
            Node::Sign(a) => call(Op::Sign(0), &[a]),
        }
    }

    /// MATLAB's plain signs are those of matrices.
    fn product(&self) -> &'static str {
        if self.language == Language::Matlab { ".*" } else { " * " }
    }

    fn quotient(&self) -> &'static str {
        if self.language == Language::Matlab { "./" } else { " / " }
    }
}

/// `a + b`, `a - b`, where a minus that `b` begins with turns the sign around.
fn sum(a: &str, sign: char, b: &str) -> String {
    match (b.strip_prefix('-'), sign) {
        (Some(b), '+') => format!("{a} - {b}"),
        (Some(b), _) => format!("{a} + {b}"),
        (None, _) => format!("{a} {sign} {b}"),
    }
}

/// A product with several constant factors, rewritten with their product in front.
fn with_one_constant(e: Expr) -> Option<Expr> {
    let (mut constants, mut others) = (vec![], vec![]);
    let mut pending = vec![e];
    while let Some(part) = pending.pop() {
        match part.node() {
            _ if part.symbols().is_empty() => constants.push(part),
            Node::Mul(a, b) => pending.extend([b, a]),
            _ => others.push(part),
        }
    }
    if constants.len() < 2 {
        return None;
    }
    let product = constants.into_iter().reduce(|a, b| a * b)?;
    let value = Rational::from_f64(product.eval(|_| None).ok()?)?;
    Some(Expr::from(value) * others.into_iter().reduce(|a, b| a * b)?)
}

/// The function that computes it in a language, for operations that are not written with signs. In Rust, C and
/// CUDA sines and cosines come in pairs from a routine of their own.
pub(crate) fn function_name(op: &Op, language: Language, precision: Precision) -> Option<&'static str> {
    let is_single = precision == Precision::Single;
    let name = match (op, language) {
        (
            Op::Number(_) | Op::Pi | Op::Input(_) | Op::Add(..) | Op::Sub(..) | Op::Mul(..) | Op::Div(..),
            _,
        ) => {
            return None;
        }
        (Op::Sqrt(_), Language::Rust | Language::Matlab) => "sqrt",
        (Op::Sqrt(_), Language::C | Language::Cuda | Language::IkFast) if is_single => "sqrtf",
        (Op::Sqrt(_), Language::C | Language::Cuda | Language::IkFast) => "sqrt",
        (Op::Sqrt(_), Language::Python) => "np.sqrt",
        (Op::Sqrt(_), Language::JavaScript) => "Math.sqrt",
        (Op::Sin(_) | Op::Cos(_), Language::Rust | Language::C | Language::Cuda | Language::IkFast) => {
            return None;
        }
        (Op::Sin(_), Language::Python) => "np.sin",
        (Op::Sin(_), Language::JavaScript) => "Math.sin",
        (Op::Sin(_), Language::Matlab) => "sin",
        (Op::Cos(_), Language::Python) => "np.cos",
        (Op::Cos(_), Language::JavaScript) => "Math.cos",
        (Op::Cos(_), Language::Matlab) => "cos",
        (Op::Sign(_), Language::Rust | Language::C | Language::Cuda | Language::IkFast) => "sign_of",
        (Op::Sign(_), Language::Python) => "np.sign",
        (Op::Sign(_), Language::JavaScript) => "Math.sign",
        (Op::Sign(_), Language::Matlab) => "sign",
        (Op::Atan2(..), Language::Rust | Language::Matlab) => "atan2",
        (Op::Atan2(..), Language::C | Language::Cuda | Language::IkFast) if is_single => "atan2f",
        (Op::Atan2(..), Language::C | Language::Cuda | Language::IkFast) => "atan2",
        (Op::Atan2(..), Language::Python) => "np.arctan2",
        (Op::Atan2(..), Language::JavaScript) => "Math.atan2",
    };
    Some(name)
}
