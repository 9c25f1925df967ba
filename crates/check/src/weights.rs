//! The load on the hand that words give in numbers: `it holds 50 N`, `a box of 8 kg`.

use denavit_symbolic::Expr;
use denavit_symbolic::parse::parse;
use denavit_symbolic::vocabulary::Vocabulary;

/// Stands for such a load among the letters of loads.
pub(super) const LETTER: char = 'N';
/// Stands for a mass that a text multiplies with the number for g, `m*9.81`.
pub(super) const MASS: char = 'm';
/// Longer texts are not looked through.
const LONGEST: usize = 400_000;
/// The acceleration of a falling body, in m/s².
const GRAVITY: &str = "9.81";

/// The force, in newtons; nothing where a text tells none, or several.
pub(super) fn told(text: &str) -> Option<Expr> {
    if text.len() > LONGEST {
        return None;
    }
    let forces = numbers_before(text, &["N", "Н", "newton", "newtons", "Newton"], 1)?;
    match forces {
        Some(force) => value(&force),
        None => {
            let mass = numbers_before(text, &["kg", "кг"], 1)??;
            Some(value(&mass)? * value(GRAVITY)?)
        }
    }
}

/// The acceleration of a falling body.
pub(super) fn gravity() -> Expr {
    value(GRAVITY).unwrap_or(Expr::int(10))
}

/// True for a text with a mass m times the number for g.
pub(super) fn has_mass_times_number(text: &str) -> bool {
    let plain: String =
        text.chars().filter(|c| !c.is_whitespace() && !matches!(c, '\\' | '{' | '}')).collect();
    ["m*9.81", "m·9.81", "mcdot9.81", "9.81*m", "9.81·m", "9.81cdotm", "m*9,81", "m·9,81", "9,81·m"]
        .iter()
        .any(|product| plain.contains(product))
}

fn value(number: &str) -> Option<Expr> {
    parse(number, &Vocabulary::new()).ok()
}

/// The one number before a unit, `Some(None)` where there is none; nothing where there are more than so many.
fn numbers_before(text: &str, units: &[&str], most: usize) -> Option<Option<String>> {
    let mut found: Vec<String> = vec![];
    for unit in units {
        for (at, _) in text.match_indices(unit) {
            let (before, behind) = (&text[..at], &text[at + unit.len()..]);
            // `N m`, `N·m` are torques.
            let rest = behind.trim_start_matches([' ', '}', '~', '$', '\u{202f}']);
            let rest = ["\\,", "\\cdot", "\\;", "\\ ", "·", "*", ".", "⋅"]
                .iter()
                .fold(rest, |r, s| r.strip_prefix(s).unwrap_or(r));
            let rest = rest.trim_start_matches([' ', '\\', '{']);
            let rest = ["text{", "mathrm{"].iter().fold(rest, |r, s| r.strip_prefix(s).unwrap_or(r));
            let is_moment = ["m", "м", "cm"]
                .iter()
                .any(|m| rest.strip_prefix(m).is_some_and(|r| !r.starts_with(char::is_alphanumeric)));
            let is_longer = behind.starts_with(char::is_alphanumeric);
            if is_moment || is_longer {
                continue;
            }
            let before = before.trim_end_matches([' ', '~', '{', '\u{a0}', '\u{202f}']);
            let before = ["\\text", "\\mathrm", "\\,", "\\;", "\\:", "\\ "]
                .iter()
                .fold(before, |b, s| b.strip_suffix(s).unwrap_or(b).trim_end_matches(['{', ' ', '~']));
            let before = before.trim_end_matches('$');
            let number: String = before
                .chars()
                .rev()
                .take_while(|c| c.is_ascii_digit() || matches!(c, '.' | ',' | '{' | '}'))
                .take(24)
                .collect::<Vec<char>>()
                .into_iter()
                .rev()
                .collect();
            let plain = number.replace("{,}", ".").replace(',', ".");
            let plain = plain.trim_matches(['{', '}', '.']);
            if plain.parse::<f64>().is_err() {
                continue;
            }
            // What has a name is a result, or has a letter of its own.
            let stands =
                before[..before.len() - number.len()].trim_end_matches([' ', '$', '-', '−', '{', '&']);
            if stands.ends_with(['=', '≈', '^', '_', '|', ',', '[', ';']) {
                continue;
            }
            if !found.iter().any(|f| f == plain) {
                found.push(plain.to_string());
            }
            if found.len() > most {
                return None;
            }
        }
    }
    Some(found.pop())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forces_in_words() {
        for (text, force) in [
            ("The tip carries a load of 50 N; z0 points up.", Some("50")),
            ("sostiene un peso di 35 N ($z_0$ verso l'alto): $\\tau_2=25{,}125$ N m", Some("35")),
            ("удержать груз весом 20 Н, M_2=16.91\\text{ Н}\\cdot\\text{м}", Some("20")),
            ("tenir 8 kg (78,48 N) au bout", Some("78.48")),
            ("it must hold 12 kg", Some("12*9.81")),
            ("18 N downwards and 10 N along x", None),
            ("F_3 = 25.00 N and tau = 3 Nm", None),
            ("a motor of 5 N·m", None),
        ] {
            assert_eq!(told(text), force.and_then(value), "{text}");
        }
    }
}
