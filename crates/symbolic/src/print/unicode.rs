//! `C1(C23(C4C5C6 − S4S6) − S23S5C6)`: as in a textbook, with `·` where factors side by side would be read
//! differently.

use super::ascii;
use super::names::{Spelling, is_letter};
use super::notation::{Head, Notation, Seam};
use crate::greek;
use crate::vocabulary::plain_name;

pub(super) const NOTATION: Notation = Notation {
    whole: ["", ""],
    plus: " + ",
    minus: " − ",
    negative: "−",
    paren: ["(", ")"],
    bar: None,
    root: ["√(", ")"],
    short_root: Some("√"),
    root_sign: ["√(", ")"],
    sine: "sin",
    cosine: "cos",
    arctangent: "atan2",
    sign: "sign",
    call: ["(", ", ", ")"],
    pi: "π",
    half_turn: "180°",
    degree: "°",
    radian: " rad",
    power: ["", ""],
    exponent,
    digits: |text| text,
    comma: |text| text.replace('.', ","),
    semicolon: "; ",
    symbol,
    trig: ascii::trig,
    times,
};

const SUPERSCRIPTS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];

fn exponent(n: i32) -> String {
    n.to_string().chars().map(|c| c.to_digit(10).map_or('⁻', |d| SUPERSCRIPTS[d as usize])).collect()
}

fn symbol(name: &Spelling) -> String {
    match name {
        Spelling::Plain { unicode, .. } => unicode.clone(),
        Spelling::Declared(name) => name.clone(),
        Spelling::Quoted(name) => ascii::quoted(name),
    }
}

fn times(seam: &Seam) -> &'static str {
    if may_touch(seam) { "" } else { "·" }
}

/// Factors touch where the left one ends in a digit or bracket, perhaps with an exponent, the right one starts with
/// a letter, a bracket or a root sign, and no known word runs across the border.
fn may_touch(seam: &Seam) -> bool {
    if seam.after_slash {
        return false;
    }
    let base = seam.left.trim_end_matches(SUPERSCRIPTS).trim_end_matches('⁻');
    let is_power = base.len() < seam.left.len();
    let number = base.trim_end_matches(|c: char| c.is_ascii_digit());
    if number.ends_with('√') || !(number.len() < base.len() || base.ends_with([')', '}'])) {
        return false;
    }
    let before = seam.left.trim_end_matches(|c: char| is_letter(c) || c.is_ascii_digit() || c == '_');
    let run = plain_name(&seam.left[before.len()..]);
    match &seam.right {
        Head::Number | Head::Call | Head::Fraction => false,
        Head::Root => true,
        Head::Paren => !seam.bridges_at(&format!("{run}(")),
        Head::Word(word) => {
            let is_number = !run.is_empty() && run.bytes().all(|c| c.is_ascii_digit());
            // 2e1 is a number, C2θ1 has two readings.
            let is_clear = match word.chars().next() {
                Some('e' | 'E') => !is_number,
                Some(c) if greek::is_letter(c) || c == 'π' => is_number || is_power || base.ends_with(')'),
                Some(c) => is_letter(c),
                None => false,
            };
            is_clear && !seam.bridges_at(&plain_name(&format!("{run}{word}")))
        }
    }
}
