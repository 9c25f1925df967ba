//! Arms told link by link as products of motions along and about z and x: `A1 = Rz(q1) Tz(d1) Rx(-90°)`.

use super::lines::lines;
use denavit::description::Convention;
use denavit_symbolic::vocabulary::plain_name;
use std::ops::Range;

/// The longest line that is looked at, and the most links.
const LONGEST: usize = 300;
const MAX_LINKS: usize = 12;

/// Motions of a link.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Step {
    TurnZ,
    SlideZ,
    TurnX,
    SlideX,
}

/// Links with their places: θ, d, a, α of each.
pub(super) struct Steps {
    pub span: Range<usize>,
    pub rows: Vec<[String; 4]>,
    pub convention: Convention,
}

/// The links of a text, one below the other or side by side, numbered from 1 on; nothing where a link has other motions, or moves
/// about z, about x and about z again, or where the next one cannot be read: an arm is not told by its first links.
pub(super) fn told(text: &str) -> Option<Steps> {
    let mut links: Vec<(Range<usize>, Vec<_>)> = vec![];
    // The name of the first link without its number.
    let mut letter = String::new();
    for line in lines(text) {
        let source = text.get(line.clone()).unwrap_or_default();
        let head = head(source);
        let next = links.len() + 1;
        match link(source).filter(|_| source.len() <= LONGEST && links.len() < MAX_LINKS) {
            Some((number, steps)) if number == next => {
                if links.is_empty() {
                    letter = head.map(|h| h.0).unwrap_or_default();
                }
                links.push((line, steps));
            }
            Some((number, _)) if number > next => return None,
            // Told again further down.
            Some(_) => {}
            None if links.is_empty() => {}
            None if head.is_some_and(|(own, number)| own == letter && number >= next) => return None,
            // Motions go on in a line of their own.
            None if begins_with_step(source) => return None,
            None if links.len() == 1 && !source.trim().is_empty() => links.clear(),
            None => {}
        }
    }
    let (first, last) = (links.first()?.0.start, links.last()?.0.end);
    let is_z = |s: &Step| matches!(s, Step::TurnZ | Step::SlideZ);
    let in_order = |z_first: bool| {
        links.iter().all(|(_, steps)| {
            let sides: Vec<bool> = steps.iter().map(|(s, _)| is_z(s) == z_first).collect();
            sides.is_sorted_by(|a, b| a >= b)
        })
    };
    let convention = match (in_order(true), in_order(false)) {
        (true, _) => Convention::Standard,
        (false, true) => Convention::Craig,
        (false, false) => return None,
    };
    let row = |steps: &[(Step, String)]| {
        [Step::TurnZ, Step::SlideZ, Step::SlideX, Step::TurnX].map(|wanted| {
            let own = steps.iter().find(|(s, _)| *s == wanted);
            own.map_or("0".to_string(), |(_, argument)| argument.clone())
        })
    };
    let rows: Vec<[String; 4]> = links.iter().map(|(_, steps)| row(steps)).collect();
    let moves = rows.iter().any(|r| r[0].contains(char::is_alphabetic));
    (rows.len() > 1 && moves).then_some(Steps { span: first..last, rows, convention })
}

/// The letter and the number of a link that a line begins with: `A1`, `A01`, `T_{01}` with both frames.
fn head(line: &str) -> Option<(String, usize)> {
    let (left, _) = line.split_once('=').filter(|(left, _)| left.len() <= LONGEST)?;
    let name = plain_name(&left.replace(['$', '&', '*', '`'], ""));
    let name = name.trim_start_matches(|c: char| c.is_ascii_digit() || c == '^' || c.is_whitespace());
    let digits = name.trim_start_matches(|c: char| c.is_ascii_alphabetic());
    let letter = &name[..name.len() - digits.len()];
    let number = match digits.as_bytes() {
        [n @ b'1'..=b'9'] => usize::from(n - b'0'),
        [i @ b'0'..=b'8', j @ b'1'..=b'9'] if *j == *i + 1 => usize::from(j - b'0'),
        _ => return None,
    };
    (letter.len() == 1).then(|| (letter.to_string(), number))
}

/// True for a line without a sign of equality that begins with a motion.
fn begins_with_step(line: &str) -> bool {
    let bare = line
        .trim_start_matches([' ', '*', '·', '@', '.', '&', '$'])
        .trim_start_matches("\\cdot")
        .trim_start();
    let parts = bare.split_once('(').and_then(|(name, rest)| Some((name, rest.split_once(')')?.0)));
    bare.len() <= LONGEST
        && !bare.contains('=')
        && parts.is_some_and(|(name, argument)| step(name, argument).is_some())
}

/// The number of a link and its motions.
fn link(line: &str) -> Option<(usize, Vec<(Step, String)>)> {
    let (_, number) = head(line)?;
    let (_, right) = line.trim_end().split_once('=')?;
    let mut steps: Vec<(Step, String)> = vec![];
    let mut rest = right.trim_start_matches([' ', '&']);
    while let Some(open) = rest.find('(') {
        let inner = &rest[open + 1..];
        let close = inner.find(')')?;
        let (step, argument) = step(&rest[..open], &inner[..close])?;
        if steps.iter().any(|(s, _)| *s == step) {
            return None;
        }
        steps.push((step, argument));
        let behind = &inner[close + 1..];
        if is_remark(behind) {
            return Some((number, steps));
        }
        rest = behind.trim_start_matches([' ', '*', '·', '@', '.', ',', '&', '$', '\t', '\\', ';']);
        for word in ["cdot", "quad", "qquad", "!"] {
            rest = rest.strip_prefix(word).unwrap_or(rest).trim_start_matches([' ', '\\']);
        }
    }
    // What is left is no motion: another matrix, a product with a number.
    (rest.is_empty() && !steps.is_empty()).then_some((number, steps))
}

/// True for words behind motions that belong to none: apart by two blanks, or in small letters.
fn is_remark(behind: &str) -> bool {
    let text = behind.trim_end().trim_start_matches([',', ';', ' ', '\t']);
    let is_apart =
        behind.starts_with("  ") || behind.starts_with('\t') || behind.trim_start().starts_with([',', ';']);
    let has_motion = text.contains(['(', '=', '\\']) || text.chars().any(|c| c.is_ascii_digit());
    let mut words = text.split(|c: char| !c.is_alphanumeric()).filter(|w| !w.is_empty()).peekable();
    let is_words =
        words.peek().is_some() && words.all(|w| w.chars().count() >= 3 && w.chars().all(char::is_lowercase));
    let is_letter = text.trim().chars().count() == 1 || text.starts_with(['*', '·', '@']);
    !text.is_empty() && !has_motion && (is_words || (is_apart && !is_letter))
}

/// `Rz(q1)`, `Rot(z, q1)`, `Trans_x(a1)`, `Trans(0, 0, d1)`.
fn step(name: &str, argument: &str) -> Option<(Step, String)> {
    let name = name.replace("\\mathrm", "").replace("\\operatorname", "").replace("\\text", "");
    let name: String = name.chars().filter(|c| c.is_alphabetic()).collect::<String>().to_lowercase();
    let parts: Vec<&str> = argument.split(',').map(str::trim).collect();
    let step = match (name.as_str(), &parts[..]) {
        ("rz" | "rotz", [_]) => Step::TurnZ,
        ("rx" | "rotx", [_]) => Step::TurnX,
        ("tz" | "transz" | "translz" | "dz", [_]) => Step::SlideZ,
        ("tx" | "transx" | "translx" | "dx", [_]) => Step::SlideX,
        ("rot" | "r", ["z", _]) => Step::TurnZ,
        ("rot" | "r", ["x", _]) => Step::TurnX,
        ("trans" | "transl" | "t", ["z", _]) => Step::SlideZ,
        ("trans" | "transl" | "t", ["x", _]) => Step::SlideX,
        ("trans" | "transl" | "t", ["0", "0", _]) => Step::SlideZ,
        ("trans" | "transl" | "t", [a, "0", "0"]) => return Some((Step::SlideX, a.to_string())),
        _ => return None,
    };
    Some((step, parts.last()?.to_string()))
}

#[cfg(test)]
mod tests {
    use super::told;
    use denavit::description::Convention;

    #[test]
    fn links_as_products() {
        for (text, convention, rows) in [
            (
                "A1 = Rz(q1) Tz(d1) Rx(-90°)      base\nA2 = Rz(q2) Tx(a2)   arm\n",
                Some(Convention::Standard),
                [["q1", "d1", "0", "-90°"], ["q2", "0", "a2", "0"]],
            ),
            (
                "T01 = Rot(z, q1)·Trans(0, 0, d1)\nT12 = Rot(x, 90°)·Trans(a1, 0, 0)·Rot(z, q2)\n",
                Some(Convention::Craig),
                [["q1", "d1", "0", "0"], ["q2", "0", "a1", "90°"]],
            ),
            ("A1 = Rz(q1) Rx(b) Tz(d1)\nA2 = Rz(q2)\n", None, [[""; 4]; 2]),
            ("A1 = Rz(q1) Ry(90°)\nA2 = Rz(q2)\n", None, [[""; 4]; 2]),
            // The third link is none of these motions, and is not left out.
            ("A1 = Rz(q1) Tz(d1)\nA2 = Rz(q2) Tx(a2)\nA3 = Ry(90°) Tz(a3)\n", None, [[""; 4]; 2]),
            ("A1 = Rz(q1)\nA2 = Rz(q2) Tx(a2)\nA3 = Ty(q3)\nA4 = Rz(q4)\n", None, [[""; 4]; 2]),
            ("A1 = Rz(q1)\nA2 = Rz(q2)\nA4 = Rz(q4) Tx(a4)\n", None, [[""; 4]; 2]),
            ("A1 = Rz(q1) Tz(d1)\nA2 = Rz(q2) Tx(a2) H\n", None, [[""; 4]; 2]),
            ("A1 = Rz(q1) Tz(d1)\nA2 = Rz(q2)\n   Tx(a2)\n", None, [[""; 4]; 2]),
            ("A1 = Rz(q1) Tz(d1) A2 = Rz(q2)\nA2 = Rz(q2)\n", None, [[""; 4]; 2]),
        ] {
            let found = told(text);
            assert_eq!(found.as_ref().map(|f| f.convention), convention, "{text}");
            if let Some(found) = found {
                assert_eq!(found.rows, rows);
            }
        }
    }
}
