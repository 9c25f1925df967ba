//! Single changes of a printed formula, as text: a sign, a sine for a cosine, the arguments of atan2 exchanged, an index, a number.
//!
//! Where a formula is no polynomial, the slip is not computed but tried: each change is read again, and the caller says whether
//! the formula is right then.

use super::outcome::Patch;
use denavit_reading::slip::Slip;
use denavit_symbolic::Node;
use denavit_symbolic::parse::{Function, Syntax, SyntaxKind};
use std::ops::Range;

/// The most changes of a formula that are tried.
const MAX_EDITS: usize = 160;
/// The largest index that is tried.
const MAX_INDEX: u32 = 7;

/// A change of a formula.
#[derive(Clone, Debug)]
pub(super) struct Edit {
    pub kind: Kind,
    /// Places count from the beginning of the formula.
    pub patches: Vec<Patch>,
}

/// What is changed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// The arguments of `atan2` are exchanged.
    Arguments,
    Slip(Slip),
}

/// The changes of a formula, the likely ones first.
pub(super) fn edits(source: &str, syntax: &Syntax) -> Vec<Edit> {
    let mut found: [Vec<Edit>; 4] = Default::default();
    visit(source, syntax, &mut found);
    let mut all: Vec<Edit> = found.into_iter().flatten().collect();
    all.truncate(MAX_EDITS);
    all
}

/// The formula after a change.
pub(super) fn edited(source: &str, edit: &Edit) -> Option<String> {
    let mut patches = edit.patches.clone();
    patches.sort_by_key(|p| p.span.start);
    let (mut out, mut at) = (String::new(), 0);
    for patch in &patches {
        out += source.get(at..patch.span.start)?;
        out += &patch.now;
        at = patch.span.end;
    }
    Some(out + source.get(at..)?)
}

fn visit(source: &str, syntax: &Syntax, found: &mut [Vec<Edit>; 4]) {
    let text = |s: &Syntax| source.get(s.span.clone()).unwrap_or_default();
    let mut add = |rank: usize, kind: Kind, patches: Vec<(Range<usize>, String)>| {
        let patches = patches.into_iter().map(|(span, now)| Patch { span, now }).collect();
        found[rank].push(Edit { kind, patches });
    };
    match &syntax.kind {
        SyntaxKind::Call(Function::Atan2, arguments) => {
            if let [a, b] = &arguments[..] {
                let patches =
                    vec![(a.span.clone(), text(b).trim().into()), (b.span.clone(), text(a).trim().into())];
                add(0, Kind::Arguments, patches);
                for argument in [a, b] {
                    if !matches!(argument.kind, SyntaxKind::Sum(_)) {
                        let start = argument.span.start;
                        add(0, Kind::Slip(Slip::Sign), vec![(start..start, "-".into())]);
                    }
                }
            }
        }
        SyntaxKind::Call(f @ (Function::Sin | Function::Cos), _) => {
            let (was, now) = if *f == Function::Sin { ("sin", "cos") } else { ("cos", "sin") };
            let shown = text(syntax);
            let at = shown.find(was).map(|i| (i, was.len(), now)).or_else(|| {
                let first = shown.chars().next()?;
                let other = match first {
                    's' => "c",
                    'c' => "s",
                    'S' => "C",
                    'C' => "S",
                    _ => return None,
                };
                Some((0, 1, other))
            });
            if let Some((i, length, now)) = at {
                let start = syntax.span.start + i;
                add(1, Kind::Slip(Slip::SineForCosine), vec![(start..start + length, now.into())]);
            }
        }
        SyntaxKind::Name(e) => {
            let shown = text(syntax);
            let start = syntax.span.start;
            let other = match shown.trim_start_matches('\\').chars().next() {
                Some('s') => Some("c"),
                Some('c') => Some("s"),
                Some('S') => Some("C"),
                Some('C') => Some("S"),
                _ => None,
            };
            if let (Node::Sin(_) | Node::Cos(_), Some(now)) = (e.node(), other) {
                let word = ["\\sin", "\\cos", "sin", "cos"].iter().find(|w| shown.starts_with(**w));
                let (length, now) = match word {
                    Some(w) => (
                        w.len(),
                        if w.contains("sin") { w.replace("sin", "cos") } else { w.replace("cos", "sin") },
                    ),
                    None => (1, now.to_string()),
                };
                add(1, Kind::Slip(Slip::SineForCosine), vec![(start..start + length, now)]);
            }
            let digit = shown.char_indices().rev().find(|(_, c)| c.is_ascii_digit());
            if let Some((i, digit)) = digit.filter(|_| shown.starts_with(|c: char| !c.is_ascii_digit())) {
                for k in (1..=MAX_INDEX).filter(|k| Some(*k) != digit.to_digit(10)) {
                    let place = start + i..start + i + 1;
                    add(3, Kind::Slip(Slip::Index), vec![(place, k.to_string())]);
                }
            }
        }
        SyntaxKind::Number(r) => {
            if r.is_one() {
                add(2, Kind::Slip(Slip::Number), vec![(syntax.span.clone(), "2".into())]);
            } else {
                add(2, Kind::Slip(Slip::ExtraFactor), vec![(syntax.span.clone(), "1".into())]);
            }
        }
        SyntaxKind::Sum(terms) => {
            for (k, (sign, term)) in terms.iter().enumerate() {
                let before = match k {
                    0 => syntax.span.start,
                    _ => terms[k - 1].1.span.end,
                };
                let between = source.get(before..term.span.start).unwrap_or_default();
                let marks = ['-', '−', '+', '–'];
                let place = between.char_indices().rev().find(|(_, c)| marks.contains(c));
                let now = if sign.is_minus() { "+" } else { "-" };
                match place {
                    Some((i, c)) => {
                        let start = before + i;
                        let now = if k == 0 && sign.is_minus() { "" } else { now };
                        add(0, Kind::Slip(Slip::Sign), vec![(start..start + c.len_utf8(), now.into())]);
                    }
                    None if k == 0 && !sign.is_two_valued() => {
                        let start = term.span.start;
                        add(0, Kind::Slip(Slip::Sign), vec![(start..start, "-".into())]);
                    }
                    None => {}
                }
            }
        }
        SyntaxKind::Product(factors) => {
            let first = factors.iter().find(|f| f.0).map(|f| &f.1);
            let numbered = first.is_some_and(|f| text(f).trim_start_matches(['(', ' ']).starts_with('2'));
            if let Some(under) = first.filter(|_| !numbered) {
                let start = under.span.start;
                let inside = start + usize::from(text(under).starts_with('('));
                add(2, Kind::Slip(Slip::LostFactor), vec![(inside..inside, "2*".into())]);
            }
        }
        SyntaxKind::Fraction(_, under) => {
            let start = under.span.start + usize::from(text(under).starts_with('{'));
            add(2, Kind::Slip(Slip::LostFactor), vec![(start..start, "2".into())]);
        }
        SyntaxKind::Root(_) | SyntaxKind::Power(..) | SyntaxKind::Call(..) | SyntaxKind::Bracket(_) => {}
    }
    for part in syntax.children() {
        visit(source, part, found);
    }
}
