//! Formulas in the languages.

use crate::emit::names::Names;
use crate::emit::{Language, Precision};
use crate::op::{Op, Value};
use denavit_symbolic::{Expr, Node};

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
            (Language::C | Language::Cuda, Precision::Single) => format!("{digits}f"),
            (Language::Rust | Language::C | Language::Cuda, _) => digits,
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
            let name = op.spelling(self.language, self.precision).expect("a function of the language");
            let arguments: Vec<String> = arguments.iter().map(|a| self.formula(*a)).collect();
            (format!("{name}({})", arguments.join(", ")), Binding::Atom)
        };
        match e.node() {
            Node::Number(_) | Node::Pi => unreachable!("a constant"),
            Node::Symbol(s) => (self.names.of(s).to_string(), Binding::Atom),
            Node::Neg(a) => (format!("-{}", at_least(a, Binding::Product)), Binding::Sign),
            Node::Add(a, b) => {
                (format!("{} + {}", at_least(a, Binding::Sum), at_least(b, Binding::Product)), Binding::Sum)
            }
            Node::Sub(a, b) => {
                (format!("{} - {}", at_least(a, Binding::Sum), at_least(b, Binding::Product)), Binding::Sum)
            }
            Node::Mul(a, b) => {
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
