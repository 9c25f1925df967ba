//! Loads on the hand whose components words give in numbers: `a force of 10 N along x and -20 N along z, moment 0.8 Nm`.

use denavit_symbolic::Expr;
use denavit_symbolic::parse::parse;
use denavit_symbolic::vocabulary::Vocabulary;

/// Longer texts are not looked through.
const LONGEST: usize = 400_000;
/// Words between a force and its axis, a preposition and perhaps an article.
const ALONG: [&str; 16] = [
    "along", "in", "entlang", "längs", "selon", "suivant", "según", "lungo", "segundo", "langs", "auf", "on",
    "en", "the", "der", "l",
];

/// Force and moment, along the axes of which a text speaks; nothing where it gives a component twice.
pub(super) fn load(text: &str) -> Option<[Expr; 6]> {
    if text.len() > LONGEST {
        return None;
    }
    let mut load: [Option<Expr>; 6] = [None; 6];
    for (at, _) in text.match_indices(" N") {
        let (before, behind) = (&text[..at], &text[at + 2..]);
        let Some(value) = number_before(before) else { continue };
        let Some(axis) = axis_behind(behind) else { continue };
        set(&mut load[axis], value)?;
    }
    if load.iter().all(Option::is_none) {
        return None;
    }
    // A moment beside forces in the plane is about the axis that stands upright on it.
    for (at, _) in text.match_indices(" Nm") {
        let before = text[..at].trim_end();
        let sentence = before.rsplit([';', '\n', '=']).next().unwrap_or_default();
        let sentence = sentence.rsplit(". ").next().unwrap_or_default();
        let part = sentence.rsplit(',').next().unwrap_or_default();
        let is_moment = part.to_lowercase().contains("moment");
        if let Some(value) = number_before(before).filter(|_| is_moment) {
            set(&mut load[5], value)?;
        }
    }
    Some(load.map(|e| e.unwrap_or(Expr::int(0))))
}

/// Gives a component its value; nothing if it has another one.
fn set(component: &mut Option<Expr>, value: Expr) -> Option<()> {
    match component {
        Some(known) if *known != value => return None,
        _ => *component = Some(value),
    }
    Some(())
}

/// The number at the end of a text, unless it is what a name is said to be.
fn number_before(text: &str) -> Option<Expr> {
    let text = text.trim_end();
    let start = text.char_indices().rev().take_while(|(_, c)| c.is_ascii_digit() || *c == '.').last()?.0;
    let (before, digits) = text.split_at(start);
    let is_minus = before.ends_with(['-', '−']);
    let before = before.trim_end_matches(['-', '−', '+']);
    let is_result = before.trim_end().ends_with(['=', '≈', '(', '[']);
    if is_result || before.ends_with(|c: char| c.is_alphanumeric() || c == '_') {
        return None;
    }
    let value = parse(digits, &Vocabulary::new()).ok()?;
    Some(if is_minus { -value } else { value })
}

/// The axis that the words behind a force name: ` along x`, ` in der z-Richtung`.
fn axis_behind(text: &str) -> Option<usize> {
    let phrase = text.split(|c: char| "0123456789.;\n".contains(c)).next()?;
    let words = phrase.split(|c: char| !c.is_alphanumeric()).filter(|w| !w.is_empty());
    let mut is_along = false;
    for word in words.take(4) {
        match word {
            "x" | "y" | "z" | "x0" | "y0" | "z0" if is_along => {
                return ["x", "y", "z"].iter().position(|a| word.starts_with(a));
            }
            _ if ALONG.contains(&word) => is_along = true,
            _ => return None,
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn components_in_words() {
        let shown = |text: &str| load(text).map(|l| l.map(|e| e.to_string()).join(" "));
        for (text, expected) in [
            (
                "With a force of 10 N along x and -20 N along z (base frame) at the flange",
                Some("10 0 -20 0 0 0"),
            ),
            ("Tip force 12 N along x, -5 N along y, moment 0.8 Nm.", Some("12 -5 0 0 0 0.8")),
            ("10 N along x. Later 12 N along x", None),
            ("F3 = 8.192 N", None),
            ("a motor of 5 N", None),
        ] {
            assert_eq!(shown(text), expected.map(String::from), "{text}");
        }
    }
}
