//! A formula as the text of a cell that reads back to the same formula.

use crate::description::units::Quantity;
use denavit_symbolic::{Expr, Rational, expr::Node};

/// How tightly the surroundings bind.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum Tight {
    Sum,
    Minus,
    Product,
    Power,
}

/// The text of a cell that measures `quantity`, see [`read_cell`](super::read_cell).
pub(in crate::description) fn write_cell(e: Expr, quantity: Quantity) -> String {
    write(e, quantity, Tight::Sum)
}

/// A number as a decimal, or as a quotient if it has none.
pub(in crate::description) fn decimal(r: &Rational) -> String {
    let sign = if r.is_negative() { "-" } else { "" };
    let mut scaled = r.abs();
    for places in 0..=60 {
        if scaled.is_integer() {
            let digits = format!("{:0>width$}", scaled.digits().0, width = places + 1);
            let (whole, fraction) = digits.split_at(digits.len() - places);
            return if places == 0 { format!("{sign}{whole}") } else { format!("{sign}{whole}.{fraction}") };
        }
        scaled = scaled * Rational::from(10);
    }
    let (n, d) = r.digits();
    format!("{sign}{n}/{d}")
}

fn bracket(text: String, when: bool) -> String {
    if when { format!("({text})") } else { text }
}

fn number(r: &Rational, quantity: Quantity, tight: Tight) -> String {
    let unit = quantity.units().1;
    let text = decimal(r);
    let compound = text.contains('/') && tight > Tight::Minus || r.is_negative() && tight > Tight::Sum;
    if unit.is_empty() || r.is_zero() {
        bracket(text, compound)
    } else {
        bracket(format!("{text} {unit}"), tight > Tight::Minus)
    }
}

/// `r·π`
fn turns(r: &Rational, quantity: Quantity, tight: Tight) -> String {
    let text = match quantity.units().0 {
        Some(unit) => {
            let degrees = decimal(&(r * &Rational::from(180)));
            match degrees.contains('/') {
                true => format!("{}*pi", decimal(r)),
                false => format!("{degrees} {unit}"),
            }
        }
        None if r.is_one() => return "pi".into(),
        None => format!("{}*pi", decimal(r)),
    };
    bracket(text, tight > Tight::Minus)
}

fn write(e: Expr, quantity: Quantity, tight: Tight) -> String {
    let plain = |e, tight| write(e, Quantity::Number, tight);
    match e.node() {
        Node::Number(r) => number(&r, quantity, tight),
        Node::Pi => turns(&Rational::ONE, quantity, tight),
        Node::Symbol(s) => s.name().to_string(),
        Node::Neg(a) => bracket(format!("-{}", write(a, quantity, Tight::Minus)), tight > Tight::Sum),
        Node::Add(a, b) => {
            let text = format!("{} + {}", write(a, quantity, Tight::Sum), write(b, quantity, Tight::Minus));
            bracket(text, tight > Tight::Sum)
        }
        Node::Sub(a, b) => {
            let text = format!("{} - {}", write(a, quantity, Tight::Sum), write(b, quantity, Tight::Minus));
            bracket(text, tight > Tight::Sum)
        }
        Node::Mul(a, b) => match (a.as_number(), b.node()) {
            (Some(r), Node::Pi) => turns(&r, quantity, tight),
            (Some(r), _) => {
                bracket(format!("{}*{}", decimal(&r), write_factor(b, quantity)), tight > Tight::Minus)
            }
            _ => {
                let text = format!("{}*{}", plain(a, Tight::Minus), plain(b, Tight::Product));
                bracket(text, tight > Tight::Minus)
            }
        },
        Node::Div(a, b) => {
            bracket(format!("{}/{}", plain(a, Tight::Minus), plain(b, Tight::Product)), tight > Tight::Minus)
        }
        Node::Pow(a, n) => bracket(format!("{}^{n}", plain(a, Tight::Power)), tight >= Tight::Power),
        Node::Sqrt(a) => format!("sqrt({})", plain(a, Tight::Sum)),
        Node::Sin(a) => format!("sin({})", write(a, Quantity::Angle, Tight::Sum)),
        Node::Cos(a) => format!("cos({})", write(a, Quantity::Angle, Tight::Sum)),
        Node::Sign(a) => format!("sign({})", plain(a, Tight::Sum)),
        Node::Atan2(y, x) => format!("atan2({}, {})", plain(y, Tight::Sum), plain(x, Tight::Sum)),
    }
}

/// What stands behind a number in a product: `2*a*b` needs no brackets, `2*(a + b)` does.
fn write_factor(e: Expr, quantity: Quantity) -> String {
    match e.node() {
        Node::Mul(..) | Node::Div(..) => write(e, Quantity::Number, Tight::Minus),
        Node::Add(..) | Node::Sub(..) => write(e, quantity, Tight::Product),
        _ => write(e, Quantity::Number, Tight::Product),
    }
}
