//! `C_{1}\left(C_{23}\left(C_{4} C_{5} C_{6} - S_{4} S_{6}\right) - S_{23} S_{5} C_{6}\right)`

use super::names::{Index, Spelling, parts};
use super::notation::{Head, Notation, Seam};
use crate::greek;

pub(super) const NOTATION: Notation = Notation {
    whole: ["", ""],
    plus: " + ",
    minus: " - ",
    negative: "-",
    paren: ["\\left(", "\\right)"],
    bar: Some(["\\frac{", "}{", "}"]),
    root: ["\\sqrt{", "}"],
    short_root: None,
    root_sign: ["\\sqrt{", "}"],
    sine: "\\sin",
    cosine: "\\cos",
    arctangent: "\\operatorname{atan2}",
    sign: "\\operatorname{sign}",
    call: ["\\left(", ", ", "\\right)"],
    pi: "\\pi",
    half_turn: "180^\\circ",
    degree: "^\\circ",
    radian: "\\,\\mathrm{rad}",
    power: ["", "^"],
    exponent: |n| format!("{{{n}}}"),
    digits: |text| text,
    comma: |text| text.replace('.', "{,}"),
    semicolon: "; ",
    symbol,
    trig: |letter: char, index: &Index| format!("{letter}_{{{}}}", index.text),
    times,
};

fn times(seam: &Seam) -> &'static str {
    let base = match seam.left.strip_suffix('}').and_then(|l| l.rsplit_once("^{")) {
        Some((base, exponent)) if exponent.parse::<i32>().is_ok() => base,
        _ => seam.left,
    };
    let last = base.trim_end_matches('}');
    match &seam.right {
        Head::Number => " \\cdot ",
        // `a(b)` looks like a function.
        Head::Paren if seam.left.ends_with(char::is_alphabetic) || seam.calls() => " \\cdot ",
        Head::Paren => "",
        // `c^{2} \alpha` is the square of a cosine.
        Head::Word(_) if last.ends_with(['c', 's', 'C', 'S']) || last.ends_with("sin") => " \\cdot ",
        Head::Word(_) | Head::Call | Head::Root | Head::Fraction => " ",
    }
}

fn symbol(name: &Spelling) -> String {
    match name {
        Spelling::Plain { unicode, .. } => word(unicode),
        Spelling::Declared(name) => words(name),
        Spelling::Quoted(name) => format!("\\text{{`{}`}}", escaped(name)),
    }
}

fn word(name: &str) -> String {
    let (letters, index) = parts(name);
    let base = match greek::LETTERS.iter().find(|g| letters.chars().eq([g.1])) {
        Some((greek, _)) => format!("\\{greek}"),
        None if letters.chars().count() == 1 => letters.to_string(),
        None => format!("\\mathit{{{letters}}}"),
    };
    if index.is_empty() { base } else { format!("{base}_{{{index}}}") }
}

/// `d(O_{2},O_{3})`
fn words(name: &str) -> String {
    let mut out = String::new();
    let mut rest = name;
    while !rest.is_empty() {
        let end = rest.find(['(', ')', ',']).unwrap_or(rest.len());
        let plain = rest[..end].trim();
        if !plain.is_empty() {
            out.push_str(&word(plain));
        }
        out.push_str(rest[end..].get(..1).unwrap_or(""));
        rest = rest.get(end + 1..).unwrap_or("");
    }
    out
}

/// As between backquotes in ASCII, so that it is read back; TeX's own characters carry the same backslash.
fn escaped(name: &str) -> String {
    let mut out = String::new();
    for c in name.chars() {
        match c {
            '\\' | '`' | '^' | '~' | '{' | '}' | '_' | '%' | '&' | '#' | '$' => out.extend(['\\', c]),
            c if c.is_control() => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}
