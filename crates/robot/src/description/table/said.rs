//! What the words of a document say of its tables: their convention, in the phrases of courses and books and in their languages, and
//! the unit of lengths.

use crate::description::Convention;
use std::ops::Range;

/// Words that name a convention by themselves.
const OWN: &[(&str, Convention)] = &[
    ("khalil", Convention::Khalil),
    ("kleinfinger", Convention::Khalil),
    ("craig", Convention::Craig),
    ("sciavicco", Convention::Standard),
    ("siciliano", Convention::Standard),
    ("spong", Convention::Standard),
    ("paul's convention", Convention::Standard),
    ("paul's book", Convention::Standard),
    ("after paul", Convention::Standard),
    ("convention of paul", Convention::Standard),
    ("nach paul", Convention::Standard),
    ("konvention von paul", Convention::Standard),
    ("convention de paul", Convention::Standard),
    ("selon paul", Convention::Standard),
    ("convenci\u{f3}n de paul", Convention::Standard),
    ("convenio de paul", Convention::Standard),
    ("seg\u{fa}n paul", Convention::Standard),
    // Constructors of toolboxes.
    ("revolutemdh", Convention::Craig),
    ("prismaticmdh", Convention::Craig),
    ("'modified'", Convention::Craig),
    ("\"modified\"", Convention::Craig),
    ("'mdh'", Convention::Craig),
    ("revolutedh", Convention::Standard),
    ("std dh", Convention::Standard),
    ("std. dh", Convention::Standard),
    ("std. d-h", Convention::Standard),
    ("prismaticdh", Convention::Standard),
];

/// Words that name a convention beside one of [`SUBJECTS`].
const BESIDE: &[(&str, Convention)] = &[
    ("standard", Convention::Standard),
    ("estándar", Convention::Standard),
    ("estandar", Convention::Standard),
    ("standaard", Convention::Standard),
    ("padrão", Convention::Standard),
    ("classic", Convention::Standard),
    ("clásic", Convention::Standard),
    ("clasic", Convention::Standard),
    ("clássic", Convention::Standard),
    ("klassiek", Convention::Standard),
    ("klassisk", Convention::Standard),
    ("klasyczn", Convention::Standard),
    ("klasick", Convention::Standard),
    ("classique", Convention::Standard),
    ("klassisch", Convention::Standard),
    ("original dh", Convention::Standard),
    ("distal", Convention::Standard),
    ("标准", Convention::Standard),
    ("modified", Convention::Craig),
    ("modifi", Convention::Craig),
    ("modifiziert", Convention::Craig),
    ("modificad", Convention::Craig),
    ("modificat", Convention::Craig),
    ("gewijzigd", Convention::Craig),
    ("proximal", Convention::Craig),
    ("改进", Convention::Craig),
];

/// What such words are said of.
const SUBJECTS: &[&str] = &[
    "dh",
    "d-h",
    "d–h",
    "d--h",
    "denavit",
    "convention",
    "convenio",
    "convenci",
    "convenzion",
    "konvention",
    "notation",
    "paramet",
    "parámet",
    "paramèt",
    "assignment",
    "asignaci",
    "tabl",
    "tabelle",
    "tafel",
    "frames",
    "repère",
];

/// So far from each other such words stand in one phrase, in bytes.
const NEAR: usize = 48;

/// Products of elementary motions, by the letters of axes and what is done.
const ORDERS: &[(&[&str], Convention)] = &[
    (&["rz", "tz", "tx", "rx"], Convention::Standard),
    (&["rotz", "transz", "transx", "rotx"], Convention::Standard),
    (&["rx", "tx", "rz", "tz"], Convention::Craig),
    (&["rotx", "transx", "rotz", "transz"], Convention::Craig),
];

/// The convention that a text names in its words, and where, if it names one only and has no line for it.
pub fn convention_said(text: &str) -> Option<(Convention, Range<usize>)> {
    if text.lines().any(|l| l.trim_start().to_lowercase().starts_with("convention:")) {
        return None;
    }
    let [found] = <[_; 1]>::try_from(named(text)).ok()?;
    Some(found)
}

/// Where a text says in words that its lengths are in millimetres, and nowhere that they are in metres.
pub fn millimetres_said(text: &str) -> Option<Range<usize>> {
    let lower = text.to_ascii_lowercase();
    let says = |units: &[&str]| {
        let phrases = LENGTHS.iter().flat_map(|w| units.iter().map(move |u| format!("{w} {u}")));
        phrases.into_iter().find_map(|phrase| {
            let is_short = phrase.ends_with(" m") || phrase.ends_with(" mm");
            let ends =
                |at: &usize| !is_short || !lower[at + phrase.len()..].starts_with(char::is_alphanumeric);
            lower.match_indices(&phrase).map(|m| m.0).find(ends).map(|at| at..at + phrase.len())
        })
    };
    says(&["mm", "millimet", "millim\u{e8}tres", "mil\u{ed}metros"])
        .filter(|_| says(&["m", "met", "m\u{e8}tres"]).is_none())
}

/// Words before the unit of lengths.
const LENGTHS: &[&str] = &[
    "lengths in",
    "lengths are in",
    "length in",
    "dimensions in",
    "distances in",
    "l\u{e4}ngen in",
    "ma\u{df}e in",
    "longueurs en",
    "dimensions en",
    "longitudes en",
    "medidas en",
    "lunghezze in",
    "comprimentos em",
];

/// The conventions that a text names, each where it first does.
fn named(text: &str) -> Vec<(Convention, Range<usize>)> {
    // As many bytes as the text has, so that places agree.
    let lower = text.to_ascii_lowercase();
    let mut found: Vec<(Convention, Range<usize>)> = vec![];
    let mut not_craig = None;
    let mut add = |convention: Convention, at: Range<usize>| {
        match found.iter_mut().find(|f| f.0 == convention) {
            Some(first) if first.1.start <= at.start => {}
            Some(first) => first.1 = at,
            None => found.push((convention, at)),
        };
    };
    for (word, convention) in OWN {
        for (at, _) in lower.match_indices(word).filter(|m| !is_in_literature(&lower, m.0)).take(20) {
            match is_denied(&lower[..at]) {
                false => add(*convention, at..at + word.len()),
                true if *convention == Convention::Craig => not_craig = Some(at..at + word.len()),
                true => {}
            }
        }
    }
    for (word, convention) in BESIDE {
        for (at, _) in lower.match_indices(word).take(50) {
            let end = at + word.len();
            if !(begins_word(&lower, at) && has_subject(&lower, at, end)) {
                continue;
            }
            match is_denied(&lower[..at]) {
                false => add(*convention, at..end),
                true if *convention == Convention::Craig => not_craig = Some(at..end),
                true => {}
            }
        }
    }
    for (parts, convention) in ORDERS {
        if let Some(at) = sequence(&lower, parts) {
            add(*convention, at);
        }
    }
    for (convention, at) in told_in_motions(&lower).into_iter().chain(as_a_product(&lower)) {
        add(convention, at);
    }
    // A row begins with the joint or with the frame before.
    if let (true, Some(at)) = (found.is_empty(), not_craig) {
        found.push((Convention::Standard, at));
    }
    // Craig's order with the letters of Khalil's table is Khalil's.
    let has = |c: Convention| found.iter().any(|f| f.0 == c);
    if has(Convention::Khalil) && !has(Convention::Standard) {
        found.retain(|f| f.0 == Convention::Khalil);
    }
    found.sort_by_key(|f| f.1.start);
    found
}

/// Words that deny what stands behind them.
const DENIALS: &[&str] = &[
    "not",
    "than",
    "instead",
    "unlike",
    "opposed",
    "versus",
    "vs",
    "nicht",
    "statt",
    "anstatt",
    "anders",
    "pas",
    "plut\u{f4}t",
    "contrairement",
    "niet",
    "non",
    "no",
    "n\u{e3}o",
    "invece",
    "anzich\u{e9}",
];

/// Words that may stand between a denial and what it denies.
const BETWEEN: &[&str] = &[
    "the",
    "a",
    "to",
    "of",
    "in",
    "that",
    "der",
    "die",
    "das",
    "des",
    "nach",
    "wie",
    "la",
    "le",
    "les",
    "celle",
    "celui",
    "de",
    "den",
    "van",
    "selon",
    "el",
    "los",
    "lo",
    "di",
    "il",
    "quella",
    "o",
    "do",
    "da",
    "as",
    "per",
    "que",
    "als",
    "het",
    "dem",
    "with",
    "any",
    "une",
    "un",
    "en",
    "seg\u{fa}n",
    "secondo",
];

/// True if what stands before a word denies it: `not Craig`, `rather than the modified …`, `nicht nach Craig`.
fn is_denied(before: &str) -> bool {
    let clause = before.rsplit(['.', ';', ':', '\n']).next().unwrap_or_default();
    let words = clause.split(|c: char| !(c.is_alphabetic() || c == '\'')).rev().filter(|w| !w.is_empty());
    let Some((between, word)) = words.enumerate().find(|(_, w)| !BETWEEN.contains(w)) else { return false };
    // Portuguese `no Craig` is `in Craig`; Spanish `no la de Craig` denies.
    DENIALS.contains(&word) && (word != "no" || between > 0) || word.ends_with("n't")
}

/// Headings of lists of literature.
const LITERATURE: &[&str] = &[
    "references",
    "literature",
    "bibliography",
    "further reading",
    "literatur",
    "literaturverzeichnis",
    "quellen",
    "r\u{e9}f\u{e9}rences",
    "bibliographie",
    "referencias",
    "bibliograf\u{ed}a",
    "bibliografia",
    "riferimenti",
    "refer\u{ea}ncias",
];

/// True in a list of literature: a book that is cited there says nothing of a table.
fn is_in_literature(lower: &str, at: usize) -> bool {
    let line = lower[..at].rsplit('\n').next().unwrap_or_default().trim_start();
    let line = line.trim_start_matches(['-', '*', '>', '%', '#', ' ']);
    let number = line.strip_prefix('[').and_then(|rest| rest.split_once(']'));
    let is_item = number.is_some_and(|(n, _)| !n.is_empty() && n.chars().all(|c| c.is_ascii_digit()))
        || line.starts_with("\\bibitem")
        || line.starts_with("author");
    let heading = lower[..at].lines().rev().skip(1).find_map(|line| {
        let line = line.trim();
        let inside = line.strip_prefix("\\section").or(line.strip_prefix("\\chapter"));
        let is_begun = line == "\\begin{document}" || line.starts_with("\\begin{thebibliography}");
        let is_heading = line.starts_with('#') || inside.is_some() || is_begun;
        let bare = inside.unwrap_or(line).trim_matches(|c: char| !c.is_alphabetic());
        let is_title = LITERATURE.contains(&bare) || bare == "begin{thebibliography";
        (is_heading || is_title).then_some(is_title || line.starts_with("\\begin{thebibliography}"))
    });
    is_item || heading == Some(true)
}

/// True if no letter stands before a place.
fn begins_word(text: &str, at: usize) -> bool {
    !text[..at].chars().next_back().is_some_and(|c| c.is_alphanumeric())
}

/// True if what a convention is said of stands near a word, with no end of a paragraph between.
fn has_subject(text: &str, start: usize, end: usize) -> bool {
    let floor = |mut i: usize| {
        while !text.is_char_boundary(i) {
            i -= 1;
        }
        i
    };
    let from = floor(start.saturating_sub(NEAR));
    let to = floor((end + NEAR).min(text.len()));
    let before = text[from..start].rsplit("\n\n").next().unwrap_or_default();
    let behind = text[end..to].split("\n\n").next().unwrap_or_default();
    let names =
        |part: &str| SUBJECTS.iter().any(|s| part.match_indices(s).any(|(at, _)| begins_word(part, at)));
    names(before) || names(behind)
}

/// Where parts of words follow one another with nothing but signs, blanks and arguments between.
fn sequence(text: &str, parts: &[&str]) -> Option<Range<usize>> {
    let plain: Vec<(usize, char)> =
        text.char_indices().filter(|(_, c)| !matches!(c, '_' | '{' | '}' | '\\' | '$' | ',')).collect();
    // Arguments in brackets are left out: `Rz(θ) Tz(d)`.
    let mut depth = 0_usize;
    let mut kept: Vec<(usize, char)> = vec![];
    for (k, (at, c)) in plain.iter().enumerate() {
        let is_behind_name = k.checked_sub(1).is_some_and(|k| plain[k].1.is_alphanumeric());
        match c {
            '(' | '[' if depth > 0 || is_behind_name => depth += 1,
            ')' | ']' => depth = depth.saturating_sub(1),
            _ if depth == 0 && c.is_alphabetic() => kept.push((*at, *c)),
            '\n' => {
                kept.push((*at, '\n'));
                depth = 0;
            }
            _ => {}
        }
    }
    let line: String = kept.iter().map(|c| c.1).collect();
    let joined = parts.concat();
    let at = line.find(&joined)?;
    let first = line[..at].chars().count();
    let start = kept.get(first)?.0;
    let end = kept.get(first + joined.chars().count() - 1)?.0 + 1;
    Some(start..end)
}

/// A sentence that tells the motions of a link one after another: `rotates by θ about z, moves d along z, then a along x, then
/// twists by α`.
fn told_in_motions(text: &str) -> Option<(Convention, Range<usize>)> {
    const TURNS: [&str; 7] = ["rotat", "turn", "dreht", "drehung", "tourn", "gira", "ruota"];
    for (at, word) in TURNS.iter().flat_map(|w| text.match_indices(w).take(20)) {
        let mut end = (at + 220).min(text.len());
        while !text.is_char_boundary(end) {
            end -= 1;
        }
        let sentence = text[at + word.len()..end].split(['.', ')', ';']).next().unwrap_or_default();
        let plain: String = sentence.chars().filter(|c| !matches!(c, '\\' | '$' | '{' | '}')).collect();
        let plain = plain.replace("theta", "θ").replace("alpha", "α");
        let letter = |c: &char| {
            let mut places = plain.char_indices().filter(|(i, x)| {
                let alone = |y: Option<char>| y.is_none_or(|y| !y.is_alphabetic());
                x == c
                    && alone(plain[..*i].chars().next_back())
                    && alone(plain[i + c.len_utf8()..].chars().next())
            });
            places.next().map(|p| p.0)
        };
        let [theta, d, a, alpha] = ['θ', 'd', 'a', 'α'].map(|c| letter(&c));
        let (Some(theta), Some(d), Some(a), Some(alpha)) = (theta, d, a, alpha) else { continue };
        let place = at..at + word.len();
        if theta.max(d) < a.min(alpha) {
            return Some((Convention::Standard, place));
        }
        if alpha.max(a) < theta.min(d) {
            return Some((Convention::Craig, place));
        }
    }
    None
}

/// The arguments of a motion are no longer than this, in bytes.
const MAX_ARGUMENTS: usize = 80;

/// A product of motions with their axes as arguments: `Rot(z, θ) × Trans(0, 0, d) × Trans(a, 0, 0) × Rot(x, α)`.
fn as_a_product(text: &str) -> Option<(Convention, Range<usize>)> {
    let mut run: Vec<([char; 2], Range<usize>)> = vec![];
    for (open, _) in text.match_indices('(') {
        let before = text[..open].trim_end_matches(['}', ' ', '\\', '{']);
        let before = before.strip_suffix("left").map_or(before, |b| b.trim_end_matches(['}', ' ', '\\']));
        let name = before.rsplit(|c: char| !c.is_ascii_alphabetic()).next().unwrap_or_default();
        if name.is_empty() {
            continue;
        }
        let ends = |&(n, c): &(usize, char)| n > MAX_ARGUMENTS || matches!(c, ')' | '\n');
        let Some(close) = text[open..].char_indices().find(ends).map(|(n, _)| open + n) else { break };
        let Some(motion) = motion(name, &text[open + 1..close]) else { continue };
        let start = before.len() - name.len();
        // Between two of a product stand signs and commands for signs only.
        let follows = run.last().is_some_and(|(_, last)| {
            let between = text.get(last.end + 1..start).unwrap_or("+");
            let words = between.split(|c: char| !c.is_ascii_alphabetic()).filter(|w| !w.is_empty());
            !between.contains(['+', '=', ';']) && words.into_iter().all(|w| SIGNS.contains(&w))
        });
        if !follows {
            run.clear();
        }
        run.push((motion, start..close));
        let Some([a, b, c, d]) = run.last_chunk() else { continue };
        // Turning about an axis and moving along it may be exchanged.
        let pair = |a: &[char; 2], b: &[char; 2]| (a[0] != b[0] && a[1] == b[1]).then_some(a[1]);
        let place = a.1.start..d.1.end + 1;
        match (pair(&a.0, &b.0), pair(&c.0, &d.0)) {
            (Some('z'), Some('x')) => return Some((Convention::Standard, place)),
            (Some('x'), Some('z')) => return Some((Convention::Craig, place)),
            _ => {}
        }
    }
    None
}

/// Commands that may stand between the factors of a product.
const SIGNS: [&str; 11] =
    ["times", "cdot", "ast", "text", "mathrm", "mathbf", "operatorname", "quad", "right", "bf", "rm"];

/// What a motion does, `r` or `t`, and along which axis.
fn motion(name: &str, arguments: &str) -> Option<[char; 2]> {
    let all: Vec<&str> = arguments.split(',').map(|a| a.trim().trim_matches(['\\', '{', '}', ' '])).collect();
    let axis = |a: &str| ["x", "z"].contains(&a).then(|| a.chars().next()).flatten();
    match (name, &all[..]) {
        ("rot" | "r", [first, second]) => Some(['r', axis(first).or(axis(second))?]),
        ("trans" | "t" | "d" | "transl", [first, second]) => Some(['t', axis(first).or(axis(second))?]),
        ("trans" | "t" | "d" | "transl", ["0", "0", _]) => Some(['t', 'z']),
        ("trans" | "t" | "d" | "transl", [_, "0", "0"]) => Some(['t', 'x']),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::named;
    use crate::description::Convention::{Craig, Khalil, Standard};

    #[test]
    fn conventions_in_the_words_of_courses() {
        for (text, expected) in [
            ("DH parameters (standard)", vec![Standard]),
            ("Standard-DH-Tabelle, Längen in m", vec![Standard]),
            ("Se usa el convenio estándar de Denavit–Hartenberg:", vec![Standard]),
            ("we use the classic (distal) assignment", vec![Standard]),
            ("DH parameters, modified (Craig)", vec![Craig]),
            ("parameters after Craig", vec![Craig]),
            ("(DH, the textbook version, not Craig)", vec![Standard]),
            ("the modified DH convention rather than the standard one", vec![Craig]),
            ("DH-Tabelle (nicht nach Craig)", vec![Standard]),
            ("parâmetros como no Craig", vec![Craig]),
            ("la tabla (no la de Craig)", vec![Standard]),
            ("not the standard but the modified DH table", vec![Craig]),
            ("Modifizierte DH-Parameter", vec![Craig]),
            ("paramètres de Khalil et Kleinfinger", vec![Khalil]),
            ("My DH table (i.e. Rz Tz Tx Rx):", vec![Standard]),
            (r"$A_i = Rot_z(\theta_i) Trans_z(d_i) Trans_x(a_i) Rot_x(\alpha_i)$", vec![Standard]),
            (
                r"each $A_i$ rotates by $\theta_i$ about $z$, moves $d$ along z, then $a$ along x, then twists by $\alpha$",
                vec![Standard],
            ),
            (
                r"$A_n = \text{Rot}(z,\theta_n) \times \text{Trans}(0,0,d_n) \times \text{Trans}(a_n,0,0) \times \text{Rot}(x,\alpha_n)$",
                vec![Standard],
            ),
            ("T = Trans(a, x) · Rot(x, α) · Rot(z, θ) · Trans(z, d)", vec![Craig]),
            ("R(z, θ) + T(z, d), T(x, a) R(x, α)", vec![]),
            ("the standard solution of a quadratic equation", vec![]),
            ("The mass is modified by the user.", vec![]),
            ("# Arm\n\nThe table follows Craig's convention.", vec![Craig]),
            ("Die Tabelle folgt der Konvention von Craig.", vec![Craig]),
            ("Le tableau suit la convention de Craig.", vec![Craig]),
            ("La tabla sigue la convención de Craig.", vec![Craig]),
            ("nach der Konvention von Paul", vec![Standard]),
            ("les paramètres suivent la convention de Paul", vec![Standard]),
            ("según la convención de Paul", vec![Standard]),
            ("Die Tabelle steht in der klassischen Konvention.", vec![Standard]),
            ("Le tableau suit la convention classique de Denavit et Hartenberg.", vec![Standard]),
            ("La tabla sigue la convención clásica.", vec![Standard]),
            (
                "The standard DH table:\n\n## References\n\nJ. J. Craig, Introduction to Robotics, 1986.",
                vec![Standard],
            ),
            ("The arm\n\n[3] J. J. Craig, Introduction to Robotics.", vec![]),
            ("Bibliographie :\n- W. Khalil, E. Dombre, 1999\n\n# Le bras\nconvention de Craig", vec![Craig]),
        ] {
            assert_eq!(named(text).iter().map(|f| f.0).collect::<Vec<_>>(), expected, "{text}");
        }
    }
}
