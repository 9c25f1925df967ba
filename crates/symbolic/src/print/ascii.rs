//! `C1*(C23*(C4*C5*C6 - S4*S6) - S23*S5*C6)`: what a keyboard has, every product with its sign.

use super::names::{Index, Spelling};
use super::notation::{Notation, Seam};
use super::{Style, print};
use crate::expr::Expr;
use crate::vocabulary::Vocabulary;
use std::fmt;

/// In ASCII, with full words: `cos(q2 + q3)`.
impl fmt::Display for Expr {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&print(*self, &Vocabulary::default(), Style::Ascii))
    }
}

impl fmt::Debug for Expr {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

pub(super) const NOTATION: Notation = Notation {
    whole: ["", ""],
    plus: " + ",
    minus: " - ",
    negative: "-",
    paren: ["(", ")"],
    bar: None,
    root: ["sqrt(", ")"],
    short_root: None,
    root_sign: ["√(", ")"],
    sine: "sin",
    cosine: "cos",
    arctangent: "atan2",
    sign: "sign",
    call: ["(", ", ", ")"],
    pi: "pi",
    half_turn: "180 deg",
    degree: " deg",
    radian: " rad",
    power: ["", "^"],
    exponent,
    digits: |text| text,
    comma: |text| text,
    semicolon: ", ",
    symbol,
    trig,
    times: |_: &Seam| "*",
};

fn exponent(n: i32) -> String {
    if n < 0 { format!("({n})") } else { n.to_string() }
}

fn symbol(name: &Spelling) -> String {
    match name {
        Spelling::Plain { ascii, .. } => ascii.clone(),
        Spelling::Declared(name) => name.clone(),
        Spelling::Quoted(name) => quoted(name),
    }
}

pub(super) fn quoted(name: &str) -> String {
    format!("`{}`", name.replace('\\', "\\\\").replace('`', "\\`"))
}

pub(super) fn trig(letter: char, index: &Index) -> String {
    if index.is_plain() { format!("{letter}{}", index.text) } else { format!("{letter}_{{{}}}", index.text) }
}
