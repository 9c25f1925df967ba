//! Presentation MathML.

use super::names::{Index, Spelling};
use super::notation::{Head, Notation, Seam};

pub(super) const NOTATION: Notation = Notation {
    whole: ["<mrow>", "</mrow>"],
    plus: "<mo>+</mo>",
    minus: "<mo>−</mo>",
    negative: "<mo>−</mo>",
    paren: ["<mrow><mo>(</mo>", "<mo>)</mo></mrow>"],
    bar: Some(["<mfrac><mrow>", "</mrow><mrow>", "</mrow></mfrac>"]),
    root: ["<msqrt>", "</msqrt>"],
    short_root: None,
    root_sign: ["<msqrt>", "</msqrt>"],
    sine: "<mi>sin</mi>",
    cosine: "<mi>cos</mi>",
    arctangent: "<mi>atan2</mi>",
    sign: "<mi>sign</mi>",
    call: ["<mo>&#x2061;</mo><mrow><mo>(</mo>", "<mo>,</mo>", "<mo>)</mo></mrow>"],
    pi: "<mi>π</mi>",
    half_turn: "<mi>π</mi>",
    degree: "<mo>°</mo>",
    radian: "<mo>&#x2062;</mo><mi mathvariant=\"normal\">rad</mi>",
    power: ["<msup>", ""],
    exponent,
    digits: |text| format!("<mn>{text}</mn>"),
    comma: |text| format!("<mn>{}</mn>", text.replace('.', ",")),
    semicolon: "<mo>;</mo>",
    symbol,
    trig,
    times,
};

fn times(seam: &Seam) -> &'static str {
    match seam.right {
        Head::Number => "<mo>·</mo>",
        Head::Paren | Head::Word(_) | Head::Call | Head::Root | Head::Fraction => "<mo>&#x2062;</mo>",
    }
}

fn exponent(n: i32) -> String {
    let size = n.unsigned_abs();
    if n < 0 {
        format!("<mrow><mo>−</mo><mn>{size}</mn></mrow></msup>")
    } else {
        format!("<mn>{size}</mn></msup>")
    }
}

fn trig(letter: char, index: &Index) -> String {
    let index = match index.difference {
        None => format!("<mn>{}</mn>", index.text),
        Some((a, b)) => format!("<mrow><mn>{a}</mn><mo>−</mo><mn>{b}</mn></mrow>"),
    };
    format!("<msub><mi>{letter}</mi>{index}</msub>")
}

fn symbol(name: &Spelling) -> String {
    match name.parts() {
        Ok((base, index)) if index.is_empty() => atom(base),
        Ok((base, index)) => format!("<msub>{}{}</msub>", atom(base), atom(&index)),
        Err(name) => atom(name),
    }
}

fn atom(text: &str) -> String {
    let is_number = !text.is_empty() && text.bytes().all(|c| c.is_ascii_digit());
    if is_number { format!("<mn>{text}</mn>") } else { format!("<mi>{}</mi>", escaped(text)) }
}

fn escaped(name: &str) -> String {
    let mut out = String::new();
    for c in name.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            // Not allowed in XML, not even as a reference.
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => out.push('\u{fffd}'),
            _ => out.push(c),
        }
    }
    out
}
