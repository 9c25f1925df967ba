//! `C_1 (C_23 (C_4 C_5 C_6 - S_4 S_6) - S_23 S_5 C_6)`

use super::names::{Index, Spelling};
use super::notation::{Head, Notation, Seam};
use crate::greek;

pub(super) const NOTATION: Notation = Notation {
    whole: ["", ""],
    plus: " + ",
    minus: " - ",
    negative: "-",
    paren: ["(", ")"],
    bar: Some(["frac(", ", ", ")"]),
    root: ["sqrt(", ")"],
    short_root: None,
    root_sign: ["sqrt(", ")"],
    sine: "sin",
    cosine: "cos",
    arctangent: "op(\"atan2\")",
    sign: "op(\"sign\")",
    call: ["(", ", ", ")"],
    pi: "pi",
    half_turn: "180 degree",
    degree: " degree",
    radian: " \"rad\"",
    power: ["", "^"],
    exponent: |n| if n < 0 { format!("({n})") } else { n.to_string() },
    digits: |text| text,
    comma: |text| if text.contains('.') { format!("\"{}\"", text.replace('.', ",")) } else { text },
    semicolon: "; ",
    symbol,
    trig,
    times,
};

fn times(seam: &Seam) -> &'static str {
    match seam.right {
        Head::Number => " dot ",
        Head::Paren | Head::Word(_) | Head::Call | Head::Root | Head::Fraction => " ",
    }
}

fn trig(letter: char, index: &Index) -> String {
    if index.is_plain() { format!("{letter}_{}", index.text) } else { format!("{letter}_({})", index.text) }
}

fn symbol(name: &Spelling) -> String {
    let (letters, index) = match name.parts() {
        Ok(parts) => parts,
        Err(name) => return quoted(name),
    };
    let base = match greek::LETTERS.iter().find(|g| letters.chars().eq([g.1])) {
        Some((greek, _)) => greek.to_string(),
        None => atom(letters),
    };
    if index.is_empty() { base } else { format!("{base}_{}", atom(&index)) }
}

/// One letter and numbers stand for themselves, longer words are quoted.
fn atom(text: &str) -> String {
    let is_number = text.bytes().all(|c| c.is_ascii_digit());
    if is_number || text.chars().count() == 1 { text.to_string() } else { quoted(text) }
}

fn quoted(name: &str) -> String {
    format!("\"{}\"", name.replace('\\', "\\\\").replace('"', "\\\""))
}
