//! Loads on the hand, and the torques of the joints for them: which letters a text has for both.

use super::habits::Habits;
use super::letters::{AXES, Add, is_mentioned, plain};
use super::spoken_loads as spoken;
use super::subject::Subject;
use denavit::description::JointKind;
use denavit::geometry::Vector;
use denavit_symbolic::Expr;
use denavit_symbolic::parse::parse;
use denavit_symbolic::vocabulary::Vocabulary;

/// The load that a text gives as a vector, `F = (0, 0, -W)`, `\mathbf f = (10; -5)`: force, and moment if there are six.
/// Nothing where it gives several: a torque would have to say of which it is.
fn load_given(text: &str) -> Option<[Expr; 6]> {
    vector_given(text).or_else(|| spoken::load(text))
}

fn vector_given(text: &str) -> Option<[Expr; 6]> {
    let open = Vocabulary::new().open(true);
    let mut found: Option<[Expr; 6]> = None;
    for (at, _) in text.match_indices('=').take(2_000) {
        let before = text[..at].trim_end_matches([' ', '}', '&', '$']);
        let Some(stem) = before.strip_suffix(['F', 'f']) else { continue };
        if stem.ends_with(|c: char| c.is_alphanumeric() || c == '_') {
            continue;
        }
        let rest = text[at + 1..].trim_start_matches([' ', '\n', '&', '$']);
        let rest = rest.strip_prefix("\\left").unwrap_or(rest);
        // `F = N u`: a size along a direction.
        let mut words = rest.split_whitespace();
        let is_letter =
            |w: Option<&str>| w.is_some_and(|w| w.chars().count() == 1 && w.chars().all(char::is_alphabetic));
        if is_letter(words.next()) && is_letter(words.next()) {
            return None;
        }
        let Some(inner) = rest.strip_prefix(['(', '[']).and_then(|r| r.split([')', ']']).next()) else {
            continue;
        };
        let parts: Vec<&str> =
            inner.split([',', ';']).map(|p| p.trim_matches(['\\', ' ', '~', '$'])).collect();
        let values: Option<Vec<Expr>> =
            parts.iter().map(|p| parse(&p.replace('−', "-"), &open).ok()).collect();
        let Some(values) = values.filter(|v| matches!(v.len(), 2 | 3 | 6)) else { continue };
        let is_short = values.iter().all(|e| e.symbols().len() <= 1);
        if is_short && values.iter().any(|e| !e.is_zero()) {
            let mut load = [Expr::int(0); 6];
            load.iter_mut().zip(values).for_each(|(l, v)| *l = v);
            if found.is_some_and(|other| other != load) {
                return None;
            }
            found = Some(load);
        }
    }
    found
}

/// The letters that a text has for torques.
fn torque_letters(text: &str) -> Vec<&'static str> {
    let all = plain(text);
    let mut found: Vec<&str> = ["τ", "Γ"].into_iter().filter(|t| all.contains(t)).collect();
    if all.contains("Gamma1") || all.contains("Gamma2") {
        found.push("Gamma");
    }
    // M is a moment where a text says so and names a force.
    let lower = text.to_lowercase();
    let says = |words: &[&str]| words.iter().any(|w| lower.contains(w));
    let is_told = |letter: &str| {
        (1..=7).any(|k| {
            let name = format!("{letter}{k}");
            let is_given = ["=", "&="].iter().any(|e| all.contains(&format!("{name}{e}")));
            is_given && is_mentioned(text, &name)
        })
    };
    let has_force = || {
        let is_named = ["Fx", "Fy", "Fz", "fx", "fy", "fz"].iter().any(|f| is_mentioned(text, f));
        let weighs = || {
            says(&[
                "weigh", "tyngd", "gewicht", "peso", "poids", "load", "last ", "charge", "carico", "carga",
                "ciężar", "mass",
            ]) && ["W", "G", "P", "F", "Q", "m"].iter().any(|f| is_mentioned(text, f))
        };
        is_named || load_given(text).is_some() || super::weights::told(text).is_some() || weighs()
    };
    let letters = [
        ("M", &["torque", "moment", "couple", "coppi", "момент"][..]),
        ("C", &["couple", "coppi"][..]),
        ("T", &["torque"][..]),
    ];
    for (letter, words) in letters {
        // `T1` is a transform wherever frames are spoken of.
        let is_free = letter != "T" || !says(&["matri", "frame", "transform"]);
        if found.is_empty() && is_free && says(words) && is_told(letter) && has_force() {
            found.push(letter);
        }
    }
    found
}

/// Letters of their own that a text may have for a load on the hand: it speaks of torques, and names no components of a force.
/// [`super::weights::LETTER`] stands for one that words give in newtons.
pub(super) fn letters_of_load(text: &str) -> Vec<char> {
    let components = ["Fx", "Fy", "Fz", "fx", "fy", "fz"];
    let is_given = || components.iter().any(|c| is_mentioned(text, c)) || load_given(text).is_some();
    if torque_letters(text).is_empty() || is_given() {
        return vec![];
    }
    // A mass times the number for g: `m*9.81`.
    let times = Some(super::weights::MASS).filter(|_| super::weights::has_mass_times_number(text));
    // A weight m·g counts as one letter.
    let weighs =
        text.contains("mg") || text.contains("m g") || text.contains("m·g") || text.contains("m\\,g");
    let weight = Some('g').filter(|_| weighs);
    let told = super::weights::told(text).map(|_| super::weights::LETTER);
    ['W', 'F', 'P', 'G', 'Q', 'f']
        .into_iter()
        .filter(|c| is_mentioned(text, &c.to_string()))
        .chain(weight.filter(|_| times.is_none()))
        .chain(times)
        .chain(told)
        .collect()
}

/// The frame along whose axes a text has the components of its force, `{}^3F = (f_x, f_y, f_z)`; nothing where it has several.
fn frame_of_load(text: &str) -> Option<usize> {
    let mut found = None;
    for (at, _) in text.match_indices('^') {
        let behind = text[at + 1..].strip_prefix('{').unwrap_or(&text[at + 1..]);
        let Some(frame) = behind.chars().next().and_then(|c| c.to_digit(10)) else { continue };
        let behind = behind[1..].trim_start_matches(['}', ' ']);
        let letter = LOOKS.iter().find_map(|l| behind.strip_prefix(l)).unwrap_or(behind);
        let rest = letter.trim_start_matches(['{', ' ']).strip_prefix(['F', 'f']);
        let is_left = may_be_left(&text[..at]);
        let is_name = rest.is_some_and(|r| !r.starts_with(|c: char| c.is_alphanumeric()));
        if is_left && is_name {
            match found {
                Some(other) if other != frame => return None,
                _ => found = Some(frame),
            }
        }
    }
    found.map(|k| k as usize)
}

/// Commands that change the looks of a letter.
const LOOKS: [&str; 5] = ["\\mathbf", "\\boldsymbol", "\\vec", "\\bm", "\\mathrm"];

/// True for a text behind which an upper left index may stand; behind what is multiplied it is a power: `a^2 F`, `|d|^2 F`.
fn may_be_left(text: &str) -> bool {
    let bare = text.trim_end_matches(' ');
    bare.is_empty()
        || bare.ends_with("{}")
        || bare.ends_with("\\,")
        || bare.ends_with(['$', '=', '(', '[', ',', '+', '-', '`', '\n', '~'])
}

/// True if a torque is said to be something and a letter: `τ_2 = … + M`.
fn adds_to_torque(text: &str, letters: &[&str], letter: &str) -> bool {
    let is_torque = |name: &str| {
        let name = plain(name);
        letters.iter().any(|l| {
            name.rfind(l).is_some_and(|at| {
                let number = &name[at + l.len()..];
                !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit())
            })
        })
    };
    text.lines().filter(|l| l.len() < 1_000).any(|line| {
        let Some((name, formula)) = line.split_once('=') else { return false };
        let bare = formula.replace(' ', "");
        let is_term = |at: usize| {
            let rest = &bare[at + 1 + letter.len()..];
            !rest.starts_with(|c: char| c.is_alphanumeric() || matches!(c, '_' | '*' | '(' | '\\'))
        };
        let mut terms = ["+", "-", "−"].into_iter().flat_map(|sign| {
            bare.match_indices(&format!("{sign}{letter}"))
                .map(move |(at, _)| at + sign.len() - 1)
                .collect::<Vec<_>>()
        });
        let sign_and_letter = terms.any(is_term);
        sign_and_letter && is_torque(name.trim_end_matches(['&', ' ']))
    })
}

/// Torques of the joints for a force at the hand, in those of its components that are mentioned.
pub(super) fn torques(subject: &Subject, text: &str, habits: &Habits, add: &mut Add<'_>) {
    let letters = torque_letters(text);
    if letters.is_empty() {
        return;
    }
    let mut load = [Expr::int(0); 6];
    for (first, forces) in [(0, &["F", "f"][..]), (3, &["M", "m", "N"])] {
        for (r, axis) in AXES.iter().enumerate() {
            // `My` is a word, too.
            let is_marked = |f: &str| {
                f == "F"
                    || f == "f"
                    || text.contains(&format!("{f}_{axis}"))
                    || text.contains(&format!("{f}_{{{axis}"))
            };
            let is_named = |f: &&&str| is_marked(f) && is_mentioned(text, &format!("{f}{axis}"));
            if let Some(letter) = forces.iter().find(is_named) {
                let name = format!("{letter}{axis}");
                let symbol = Expr::symbol(&name);
                load[first + r] = symbol;
                add(&name, symbol, symbol);
            }
        }
    }
    // A moment beside a force in the plane.
    let is_planar = || super::directions::parallel_sum(subject).is_some();
    if load[5].is_zero() && !(load[0].is_zero() && load[1].is_zero()) && is_planar() {
        let own = ["M", "m", "N", "n"].into_iter().filter(|l| !letters.contains(l) || *l != "M");
        if let Some(letter) = own.into_iter().find(|l| adds_to_torque(text, &letters, l)) {
            load[5] = Expr::symbol(letter);
            add(letter, load[5], load[5]);
        }
    }
    if load.iter().all(|e| e.is_zero())
        && let Some(given) = load_given(text)
    {
        load = given;
        for symbol in given.iter().flat_map(|e| e.symbols()) {
            add(&symbol.name(), symbol.into(), symbol.into());
        }
    }
    if let Some((letter, axis, is_minus)) = habits.load.filter(|_| load.iter().all(|e| e.is_zero())) {
        let told = super::weights::told(text).filter(|_| letter == super::weights::LETTER);
        let symbol = told.unwrap_or_else(|| Expr::symbol(&letter.to_string()));
        let mass = (letter == 'g').then(|| Expr::symbol("m"));
        let size = mass.map_or(symbol, |m| m * symbol);
        let size = if letter == super::weights::MASS { size * super::weights::gravity() } else { size };
        load[axis] = if is_minus { -size } else { size };
        for own in [Some(symbol).filter(|_| told.is_none()), mass].into_iter().flatten() {
            add(&own.as_symbol().map_or_else(String::new, |s| s.name().to_string()), own, own);
        }
    }
    if load.iter().all(|e| e.is_zero()) {
        return;
    }
    let frame = match frame_of_load(text) {
        // Frame 0 is the base.
        Some(0) => None,
        Some(k) => subject.placed(k),
        None => Some(subject.pose()).filter(|_| habits.load_in_hand),
    };
    if let Some(turn) = frame.map(|x| x.rotation) {
        let [force, moment] = [0, 3].map(|k| (turn * Vector([load[k], load[k + 1], load[k + 2]])).0);
        load = std::array::from_fn(|k| if k < 3 { force[k] } else { moment[k - 3] });
    }
    if habits.against_load {
        load = load.map(|e| -e);
    }
    let kinds = subject.description.variables().into_iter().map(|v| v.kind);
    for ((k, torque), kind) in (1..).zip(subject.torques(&load)).zip(kinds) {
        for letter in &letters {
            add(&format!("{letter}{k}"), torque, torque);
        }
        // The force of a sliding joint has a letter of its own.
        for letter in ["f", "F", "Q"] {
            let name = format!("{letter}{k}");
            if kind == JointKind::Prismatic && is_mentioned(text, &name) {
                add(&name, torque, torque);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::frame_of_load;

    #[test]
    fn frames_of_forces() {
        for (text, frame) in [
            ("with ${}^3F=[f_x\\; f_y]^T$, then $\\tau={}^3J^T\\,{}^3F$", Some(3)),
            ("$^{2}\\mathbf{f}$ and $a^3 F$", Some(2)),
            ("{}^3F and {}^0F", None),
            ("J^T F and m^2 f_x", None),
            ("its work is $\\|d\\|^2 F$ and $|x|^2 F$", None),
            ("the force ${}^0F$", Some(0)),
        ] {
            assert_eq!(frame_of_load(text), frame, "{text}");
        }
    }
}
