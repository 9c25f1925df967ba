//! Components of the pose's columns along the axes of another frame, `a_y^3`: an upper index where a power would stand.

use super::habits::Places;
use super::letters::{AXES, Add};
use super::subject::Subject;

/// The letters of the columns that are directions.
const LETTERS: [char; 4] = ['n', 's', 'o', 'a'];
/// Squares are squares.
const FRAMES: [char; 8] = ['1', '3', '4', '5', '6', '7', '8', '9'];

/// A text with `a_y_3` for `a_y^3`, byte for byte, where it has the column in that frame, `a^3`, or the rotation that leads there,
/// `R_6^3`; nothing for other texts.
pub(super) fn with_frames(text: &str) -> Option<String> {
    let bare: String = without_looks(text);
    let is_frame = |letter: char, frame: char| {
        let vector = [format!("{letter}^{frame}"), format!("{letter}^{{{frame}}}")];
        let is_vector = vector.iter().any(|v| is_word(&bare, v));
        is_vector || rotations(frame).iter().any(|r| bare.contains(r))
    };
    let mut bytes = text.as_bytes().to_vec();
    let mut is_any = false;
    for (at, _) in text.match_indices('^') {
        let behind = text[at + 1..].strip_prefix('{').unwrap_or(&text[at + 1..]);
        let Some(frame) = behind.chars().next().filter(|c| FRAMES.contains(c)) else { continue };
        if behind[1..].starts_with(|c: char| c.is_alphanumeric()) {
            continue;
        }
        let before = text[..at].trim_end_matches('}');
        let Some(name) = before.strip_suffix(['x', 'y', 'z']) else { continue };
        let name = name.strip_suffix("_{").or(name.strip_suffix('_')).map(|n| n.trim_end_matches('}'));
        let Some(letter) = name.and_then(|n| n.chars().next_back()).filter(|c| LETTERS.contains(c)) else {
            continue;
        };
        let is_alone = name.is_some_and(|n| {
            let stem = &n[..n.len() - letter.len_utf8()];
            !stem.ends_with(|c: char| c.is_alphanumeric() || matches!(c, '_' | '\\'))
        });
        if is_alone && is_frame(letter, frame) {
            bytes[at] = b'_';
            is_any = true;
        }
    }
    if is_any { String::from_utf8(bytes).ok() } else { None }
}

/// The spellings of a rotation or a transform of the last frame in another.
fn rotations(frame: char) -> Vec<String> {
    let last = ['4', '5', '6', '7', 'n', 'e'];
    let of = |letter: char, n: char| {
        [
            format!("{letter}_{n}^{frame}"),
            format!("{letter}_{{{n}}}^{{{frame}}}"),
            format!("{letter}^{frame}_{n}"),
            format!("{letter}^{{{frame}}}_{{{n}}}"),
        ]
    };
    let all = ['R', 'T', 'A'].into_iter().flat_map(|l| last.map(|n| (l, n)));
    all.filter(|(_, n)| *n != frame).flat_map(|(l, n)| of(l, n)).collect()
}

/// A text without the commands that change the looks of a letter, and without the braces around one.
fn without_looks(text: &str) -> String {
    // `\\ ` and `\\,` set letters apart.
    let text = ["\\ ", "\\,", "\\;"].iter().fold(text.to_string(), |t, blank| t.replace(blank, ","));
    let looks = ["\\boldsymbol", "\\mathbf", "\\bm", "\\vec", "\\mathrm"];
    let bare = looks.iter().fold(text, |t, look| t.replace(look, ""));
    let chars: Vec<char> = bare.chars().filter(|c| *c != ' ').collect();
    let mut out = String::new();
    let mut at = 0;
    while at < chars.len() {
        match chars[at..] {
            ['{', c, '}', ..] if c.is_alphabetic() && !out.ends_with(['_', '^']) => {
                out.push(c);
                at += 3;
            }
            _ => {
                out.push(chars[at]);
                at += 1;
            }
        }
    }
    out
}

/// True if a text has these characters with no letter or index before them.
fn is_word(text: &str, word: &str) -> bool {
    let is_part = |c: char| c.is_alphanumeric() || matches!(c, '_' | '\\');
    text.match_indices(word).any(|(at, _)| !text[..at].ends_with(is_part))
}

/// Names for the components of the columns in frames inside the arm: `ay3`.
pub(super) fn of_columns(subject: &Subject, plain: &str, places: &Places, add: &mut Add<'_>) {
    let n = subject.last();
    for (c, letter) in places.0.letters().into_iter().take(3).enumerate() {
        for frame in 1..n {
            let name = |axis: &str| format!("{letter}{axis}{frame}");
            if !AXES.iter().any(|axis| plain.contains(&name(axis))) {
                continue;
            }
            let (Some(x), Some(before)) =
                (subject.transform(Some(frame), None), subject.transform(Some(0), Some(frame)))
            else {
                continue;
            };
            let (x, y) = (x.rotation.rows(), (before.inverse() * places.pose()).rotation.rows());
            for (r, axis) in AXES.iter().enumerate() {
                add(&name(axis), x[r][c], y[r][c]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::with_frames;

    #[test]
    fn upper_indices_are_frames_where_the_text_has_these() {
        for (text, expected) in [
            ("R_6^3, a_y^3 and (a_x^{3})^2", Some("R_6^3, a_y_3 and (a_x_{3})^2")),
            (
                "[{\\boldsymbol n}^3\\ {\\boldsymbol a}^3] a_{z}^3",
                Some("[{\\boldsymbol n}^3\\ {\\boldsymbol a}^3] a_{z}_3"),
            ),
            ("a_y^3 + a_x^3", None),
            ("R_6^3 and a_y^2, ba_y^3, p_x^3", None),
        ] {
            assert_eq!(with_frames(text).as_deref(), expected, "{text}");
        }
    }
}
