//! Labels from names and formulas, and how wide they are.

use super::drawing::{Label, LabelPiece};
use denavit_symbolic::{Expr, greek};

/// A symbol as it is printed: `RL4`, `theta_1`, `q2` with their indices lowered, Greek letters as letters.
pub fn symbol(name: &str) -> Label {
    let plain = name.trim_end_matches(|c: char| c.is_ascii_digit());
    let (base, index) = match name.split_once('_') {
        Some((base, index)) if !base.is_empty() && !index.is_empty() => (base, index),
        _ if plain.is_empty() => (name, ""),
        _ => name.split_at(plain.len()),
    };
    let letter = greek::letter(base).map(String::from);
    Label::symbol(letter.unwrap_or_else(|| base.to_string()), index)
}

/// A formula of a cell as it is printed; a length has no sign.
pub fn length(cell: Expr) -> Label {
    if let Ok(metres) = cell.eval(|_| None) {
        return Label::words(metric(metres.abs()));
    }
    let text = cell.to_string().replace('`', "");
    let one_term = !text[1.min(text.len())..].contains([' ', '+']);
    formula(if one_term { text.strip_prefix('-').unwrap_or(&text) } else { &text })
}

/// A length with its unit: millimetres below a metre.
fn metric(metres: f64) -> String {
    let (value, unit) = if metres < 0.9995 { (metres * 1000.0, "mm") } else { (metres, "m") };
    let text = format!("{value:.2}");
    format!("{}\u{a0}{unit}", text.trim_end_matches('0').trim_end_matches('.'))
}

/// Names become symbols, the rest stays as it is.
fn formula(text: &str) -> Label {
    let mut label = Label::default();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let word = first.is_alphabetic();
        let inside = |c: char| c.is_alphanumeric() || c == '_';
        let end =
            rest.find(|c: char| if word { !inside(c) } else { c.is_alphabetic() }).unwrap_or(rest.len());
        let (piece, behind) = rest.split_at(end);
        label = label.and(match word {
            true => symbol(piece),
            false => Label::words(piece.replace('-', "−").replace(['*', ' '], "\u{2009}")),
        });
        rest = behind;
    }
    label
}

/// How much smaller an index is.
pub const INDEX: f64 = 0.7;

/// How wide a label is, points, with letters of a size: an estimate that is rather too wide.
pub fn width(label: &Label, size: f64) -> f64 {
    label.0.iter().map(|piece| piece_width(piece, size)).sum()
}

/// How wide a piece of a label is.
pub fn piece_width(piece: &LabelPiece, size: f64) -> f64 {
    let size = if piece.subscript { INDEX * size } else { size };
    piece.text.chars().map(letter_width).sum::<f64>() * size
}

fn letter_width(c: char) -> f64 {
    match c {
        'i' | 'j' | 'l' | 't' | 'f' | 'I' | '.' | ',' | ' ' | '\u{a0}' | '\'' => 0.34,
        '\u{2009}' => 0.24,
        'm' | 'w' | 'M' | 'W' => 0.86,
        c if c.is_uppercase() => 0.7,
        '+' | '−' | '=' => 0.62,
        _ => 0.53,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(label: &Label) -> String {
        let piece = |p: &LabelPiece| if p.subscript { format!("_{}", p.text) } else { p.text.clone() };
        label.0.iter().map(piece).collect()
    }

    #[test]
    fn names_have_their_indices_lowered() {
        for (name, expect) in [
            ("RL4", "RL_4"),
            ("theta_1", "θ_1"),
            ("q2", "q_2"),
            ("d", "d"),
            ("a_x2", "a_x2"),
            ("_", "_"),
            ("7", "7"),
        ] {
            assert_eq!(written(&symbol(name)), expect);
        }
    }

    #[test]
    fn lengths_have_units_and_no_sign() {
        let d4 = Expr::symbol("d4");
        assert_eq!(written(&length(-d4)), "d_4");
        assert_eq!(written(&length(Expr::symbol("a3") + d4)), "a_3\u{2009}+\u{2009}d_4");
        assert_eq!(written(&length(Expr::int(-2))), "2\u{a0}m");
        assert_eq!(written(&length(Expr::int(9) / Expr::int(20))), "450\u{a0}mm");
    }
}
