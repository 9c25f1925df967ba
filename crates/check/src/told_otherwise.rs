//! What is refuted by the usual reading of its names, where the words before it give them another: entries of another matrix, a
//! supposition on the line before, a moment that is nowhere said, a pose that is numbered as its configuration is.

use super::facts::About;
use super::lexis::read;
use super::numbers::{self, Answer};
use super::outcome::{Finding, Standing};
use super::subject::Subject;
use super::walk::{Assertion, Pair, Piece, Spoken};
use denavit_symbolic::vocabulary::plain_name;
use denavit_symbolic::{Expr, Symbol, equal};

/// So many bytes before a formula its letters may be told.
const BEFORE: usize = 700;
/// So many bytes before a formula joints may be told to hang together; so many equations are looked at, no longer than this.
const TOGETHER: usize = 6_000;
const MOST_EQUATIONS: usize = 200;
const LONGEST: usize = 60;
/// No more values are looked at.
const MOST: usize = 8;

/// True for a statement that such words speak of.
pub(super) fn is_told_otherwise(text: &str, assertion: &Assertion, subject: &Subject) -> bool {
    is_of_entries_elsewhere(text, assertion, subject)
        || is_under_supposition(text, assertion, subject)
        || has_own_moment(assertion, subject)
}

/// The text before a place, so many bytes of it.
fn before(text: &str, at: usize, most: usize) -> &str {
    let start = (at.saturating_sub(most)..=at).find(|&k| text.is_char_boundary(k)).unwrap_or(at);
    text.get(start..at).unwrap_or_default()
}

/// Whether `r_22` in a statement is an entry of another matrix than the pose: `let r_ij be the elements of R_3^0`.
fn is_of_entries_elsewhere(text: &str, assertion: &Assertion, subject: &Subject) -> bool {
    let source = text.get(assertion.span.clone()).unwrap_or_default();
    let window = before(text, assertion.span.start, BEFORE);
    let indices = ["_{ij}", "_ij", "_{i,j}", "_{kl}"];
    let found = indices.iter().filter_map(|i| window.rfind(i).map(|at| (at, i.len()))).max();
    let Some((at, length)) = found else { return false };
    let Some(letter) = window[..at].chars().next_back().filter(|c| c.is_alphabetic()) else { return false };
    let is_entry = source.match_indices(letter).any(|(at, _)| {
        let rest = source[at + letter.len_utf8()..].trim_start_matches(['_', '{']);
        let is_word = source[..at].chars().next_back().is_some_and(|c| c.is_alphanumeric() || c == '\\');
        !is_word && rest.starts_with(|c: char| c.is_ascii_digit())
    });
    // What they are entries of, to the end of the sentence.
    let of = &window[at + length..];
    let of = of.split([':', ';', ',']).next().unwrap_or_default().split(". ").next().unwrap_or_default();
    let words =
        [" of ", " von ", " der ", " des ", " de ", " di ", " del ", " della ", " da ", " do ", " du "];
    let Some(name) =
        words.iter().filter_map(|w| of.find(w).map(|at| &of[at + w.len()..])).max_by_key(|rest| rest.len())
    else {
        return false;
    };
    let frames: Vec<usize> =
        name.split(|c: char| !c.is_ascii_digit()).filter_map(|d| d.parse().ok()).collect();
    is_entry && !frames.is_empty() && !frames.contains(&subject.last())
}

/// Whether what a joint, or a sum of joints, is said to be stands right behind words that fix a joint: `When θ_2 = 0 only the sum
/// is determined:`; a sum in the same sentence, `with θ_5 = 0 we have θ_4 + θ_6 = …`; or anything behind words of a linkage that makes joints follow others.
fn is_under_supposition(text: &str, assertion: &Assertion, subject: &Subject) -> bool {
    let is_of_joints = matches!(assertion.spoken, Some(Spoken::Joint { .. }));
    if (is_of_joints || assertion.about == About::Equation)
        && speaks_of_linkage(before(text, assertion.span.start, TOGETHER))
        && !told_together(text, assertion.span.start, subject).is_empty()
    {
        return true;
    }
    let Some(Spoken::Joint { of, .. }) = &assertion.spoken else { return false };
    let window = before(text, assertion.span.start, BEFORE);
    let window = window.trim_end_matches([' ', '\n', '\r', '\t', '*', '-', '$', '•', '&', '[', '\\']);
    let sentence = match window.strip_suffix(':') {
        Some(sentence) => sentence,
        None if of.as_symbol().is_none() => window,
        None => return false,
    };
    let sentence = sentence.rsplit(['\n', '.']).next().unwrap_or_default();
    !told_values(sentence, subject).is_empty()
}

/// Whether words speak of what holds joints together.
fn speaks_of_linkage(words: &str) -> bool {
    const WORDS: [&str; 14] = [
        "linkage",
        "parallelogram",
        "coupled",
        "coupling",
        "constraint",
        "keeps",
        "level",
        "gekoppelt",
        "waagerecht",
        "acoplad",
        "couplé",
        "mantiene",
        "parallélogramme",
        "parallelogramm",
    ];
    let lower = words.to_lowercase();
    WORDS.iter().any(|w| lower.contains(w))
}

/// The joints that words before a place make functions of others, as a linkage does: `q4 = -(q2 + q3)`.
pub(super) fn told_together(text: &str, at: usize, subject: &Subject) -> Vec<(Symbol, Expr)> {
    let window = before(text, at, TOGETHER);
    // Names and signs alone: most formulas are none.
    let is_plain = |value: &str| {
        let is_sign = |c: char| " +-−()_{}\\$".contains(c);
        let is_other = |c: char| !is_sign(c) && !c.is_alphanumeric();
        let has_function = || ["sin", "cos", "tan", "sqrt"].iter().any(|f| value.contains(f));
        value.len() <= LONGEST
            && !value.contains(is_other)
            && value.contains(|c: char| c.is_ascii_digit())
            && value.contains(char::is_alphabetic)
            && !has_function()
    };
    let candidates: Vec<(&str, &str)> = window
        .rmatch_indices('=')
        .take(MOST_EQUATIONS)
        .filter_map(|(at, _)| {
            let left = window[..at].trim_end_matches([' ', '$', '&', '*']);
            let name = left.rsplit([' ', '$', '(', ',', '\n', '*', ':']).next().unwrap_or_default();
            let value = &window[at + 1..];
            let end = value.find(['\n', '$', ';', ',', ':', '=']).unwrap_or(value.len());
            let value = value[..end].split(". ").next().unwrap_or_default().trim_end_matches(['.', ' ']);
            is_plain(value).then_some((name, value))
        })
        .collect();
    if candidates.is_empty() {
        return vec![];
    }
    let (names, joints) = (&subject.vocabulary(), subject.joints());
    let mut told: Vec<(Symbol, Expr)> = vec![];
    for (name, value) in candidates {
        let Some(joint) = names.lookup(&plain_name(name)).filter(|e| joints.contains(e)) else { continue };
        let Ok(syntax) = read(value, &(0..value.len()), names) else { continue };
        let value = syntax.value();
        let of: Vec<Expr> = value.symbols().iter().map(|s| (*s).into()).collect();
        // A step of each changes it by a number.
        let step = |by: Expr| {
            value.substitute(|s| by.as_symbol().filter(|b| *b == s).map(|_| by + Expr::int(1))) - value
        };
        let at_zero = |e: Expr| e.substitute(|_| Some(Expr::int(0)));
        let is_sum =
            || of.iter().all(|s| joints.contains(s) && equal(step(*s), at_zero(step(*s))).is_equal());
        if let Some(symbol) = joint.as_symbol()
            && !of.is_empty()
            && !of.contains(&joint)
            && is_sum()
            && told.iter().all(|t| t.0 != symbol)
        {
            told.push((symbol, value));
        }
    }
    told
}

/// Whether torques differ by a moment alone, a letter that the text has beside its forces.
fn has_own_moment(assertion: &Assertion, subject: &Subject) -> bool {
    let [Piece::Pair(Pair { value, wanted, .. })] = &assertion.pieces[..] else { return false };
    let is_parameter = |s: Symbol| subject.description.parameters.iter().any(|p| p.symbol == s);
    let letters = ["m", "M", "n", "N", "mu"].map(Symbol::new);
    // A moment that the torques know of has its place in them.
    let own = letters
        .into_iter()
        .find(|&s| value.symbols().contains(&s) && !wanted.symbols().contains(&s) && !is_parameter(s));
    own.is_some_and(|s| {
        let with = |e: Expr| equal(*value, *wanted + e).is_equal();
        !wanted.is_zero() && (with(s.into()) || with(-Expr::from(s)))
    })
}

/// The verdict on a matrix of numbers as the pose at its configuration, where it is that throughout: `T1` behind `Pose P1: …`.
pub(super) fn as_pose(text: &str, assertion: &Assertion, subject: &Subject) -> Option<Vec<Finding>> {
    const LEAST: usize = 9;
    if !has_number_of_configuration(text, assertion) {
        return None;
    }
    let pose = subject.pose();
    let rows = pose.rotation.rows();
    let findings = assertion.pieces.iter().map(|piece| {
        let Piece::Number { place: Some((r, c)), answer, .. } = piece else { return None };
        let wanted = match (*r, *c) {
            (r @ 1..=3, c @ 1..=3) => rows[r - 1][c - 1],
            (r @ 1..=3, 4) => pose.translation[r - 1],
            (4, c @ 1..=4) => Expr::int(i64::from(c == 4)),
            _ => return None,
        };
        let found = numbers::judge(&Answer { wanted, ..answer.clone() }, subject, None);
        (found.standing() == Standing::Equal).then_some(found)
    });
    let findings: Vec<Finding> = findings.collect::<Option<_>>()?;
    (findings.len() >= LEAST).then_some(findings)
}

/// The values that sentences with such words give joints, quarter turns.
pub(super) fn told_values(window: &str, subject: &Subject) -> Vec<(Symbol, Expr)> {
    const WORDS: [&str; 22] = [
        "for ",
        "at ",
        "posture",
        "position",
        "when ",
        "if ",
        "with ",
        "where ",
        "für ",
        "bei ",
        "wenn ",
        "pour ",
        "si ",
        "quando ",
        "para ",
        "con ",
        "per ",
        "cuando ",
        "lorsque ",
        "configura",
        "stellung",
        "suppose",
    ];
    let names = subject.vocabulary();
    let joints = subject.joints();
    let mut told: Vec<(Symbol, Expr)> = vec![];
    for sentence in window.split(". ") {
        let lower = sentence.to_lowercase();
        if !WORDS.iter().any(|w| lower.contains(w)) {
            continue;
        }
        for (at, _) in sentence.match_indices('=').take(MOST) {
            let before = sentence[..at].trim_end_matches([' ', '$', '&']);
            let name = before.rsplit([' ', '$', '(', ',', '\n', '*']).next().unwrap_or_default();
            let value = sentence[at + 1..].trim_start_matches([' ', '$', '&']);
            let value = value.split([' ', ',', ';', '$', ')', '\n', ':']).next().unwrap_or_default();
            let bare = value.replace("^\\circ", "").replace("^{\\circ}", "").replace('°', "");
            let bare = bare.trim_end_matches('.').trim_start_matches(['-', '−']);
            let quarter = match bare {
                "0" => 0,
                "90" | "\\pi/2" | "π/2" | "pi/2" => 1,
                "180" | "\\pi" | "π" | "pi" => 2,
                _ => continue,
            };
            let sign = if value.starts_with(['-', '−']) { -1 } else { 1 };
            let joint = names.lookup(&plain_name(name)).filter(|e| joints.contains(e));
            if let Some(symbol) = joint.and_then(|e| e.as_symbol())
                && told.len() < MOST
            {
                told.push((symbol, Expr::pi() * Expr::int(sign * quarter) / Expr::int(2)));
            }
        }
    }
    told
}

/// Whether a matrix has one letter and the number that words before it give the configuration: `P1:`, `pose 1`.
fn has_number_of_configuration(text: &str, assertion: &Assertion) -> bool {
    const WORDS: [&str; 9] = [
        "pose ",
        "posture ",
        "position ",
        "configuration ",
        "case ",
        "stellung ",
        "lage ",
        "configurazione ",
        "posa ",
    ];
    let name = plain_name(assertion.name.trim());
    let mut letters = name.chars();
    let number = match letters.next() {
        Some(first) if first.is_alphabetic() => letters.as_str(),
        _ => return false,
    };
    if number.is_empty() || !number.bytes().all(|b| b.is_ascii_digit()) || assertion.name.contains('^') {
        return false;
    }
    let window = before(text, assertion.span.start, BEFORE).to_lowercase();
    let is_whole = |rest: &str| !rest.starts_with(|c: char| c.is_alphanumeric());
    WORDS.iter().flat_map(|word| window.match_indices(word).map(|(at, w)| &window[at + w.len()..])).any(
        |rest| {
            let rest = rest.strip_prefix(|c: char| c.is_alphabetic()).unwrap_or(rest);
            rest.strip_prefix(number).is_some_and(is_whole)
        },
    )
}
