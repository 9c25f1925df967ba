//! Single changes of a printed formula, as text: a sign, a sine for a cosine, the arguments of atan2 exchanged, an index, a number.
//!
//! Where a formula is no polynomial, the slip is not computed but tried: each change is read again, and the caller says whether
//! the formula is right then.

use super::outcome::Patch;
use denavit::description::Description;
use denavit_reading::slip::Slip;
use denavit_symbolic::Node;
use denavit_symbolic::parse::{Function, Syntax, SyntaxKind};
use std::ops::Range;

/// The most changes of a formula that are tried.
const MAX_EDITS: usize = 160;
/// The most lengths that may be lost.
const MAX_LENGTHS: usize = 12;
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

/// The changes of a formula, the likely ones first; lengths of the robot may be lost from it.
pub(super) fn edits(source: &str, syntax: &Syntax, lengths: &[String]) -> Vec<Edit> {
    let mut found: [Vec<Edit>; 4] = Default::default();
    visit(source, syntax, &mut found);
    let end = syntax.span.end;
    let lost = |sign: char| {
        lengths.iter().map(move |length| Edit {
            kind: Kind::Slip(Slip::LostTerm),
            patches: vec![Patch { span: end..end, now: format!(" {sign} {length}") }],
        })
    };
    found[3].extend(lost('+').chain(lost('-')));
    let mut all: Vec<Edit> = found.into_iter().flatten().collect();
    all.truncate(MAX_EDITS);
    all
}

/// The lengths of a robot as a formula writes them.
pub(super) fn lengths(source: &str, description: &Description) -> Vec<String> {
    let spelled = |name: &str| match name.char_indices().find(|(i, c)| *i > 0 && c.is_ascii_digit()) {
        Some((i, _)) if source.contains('_') => format!("{}_{{{}}}", &name[..i], &name[i..]),
        _ => name.to_string(),
    };
    description.parameters.iter().map(|p| spelled(&p.symbol.name())).take(MAX_LENGTHS).collect()
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
                let mut all = vec![];
                [a, b].into_iter().for_each(|argument| all_turned(source, argument, &mut all));
                if all.len() > 1 {
                    add(1, Kind::Slip(Slip::SineForCosine), all);
                }
                for argument in [a, b] {
                    if !matches!(argument.kind, SyntaxKind::Sum(_)) {
                        let start = argument.span.start;
                        add(0, Kind::Slip(Slip::Sign), vec![(start..start, "-".into())]);
                    }
                }
            }
        }
        SyntaxKind::Call(Function::Sin | Function::Cos, _) => {
            if let Some(patch) = turned(source, syntax) {
                add(1, Kind::Slip(Slip::SineForCosine), vec![patch]);
            }
        }
        SyntaxKind::Name(_) => {
            let shown = text(syntax);
            let start = syntax.span.start;
            if let Some(patch) = turned(source, syntax) {
                add(1, Kind::Slip(Slip::SineForCosine), vec![patch]);
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
            // Two terms in each other's places: `a² − b²` for `b² − a²`.
            for (i, (sign, a)) in terms.iter().enumerate() {
                for (other, b) in &terms[i + 1..] {
                    if sign.is_minus() != other.is_minus() && text(a) != text(b) {
                        let patches =
                            vec![(a.span.clone(), text(b).into()), (b.span.clone(), text(a).into())];
                        add(3, Kind::Slip(Slip::Exchanged), patches);
                    }
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

/// A sine for a cosine, or a cosine for a sine: the part of the text and what stands there then.
fn turned(source: &str, syntax: &Syntax) -> Option<(Range<usize>, String)> {
    let is_turned = match &syntax.kind {
        SyntaxKind::Call(Function::Sin | Function::Cos, _) => true,
        SyntaxKind::Name(e) => matches!(e.node(), Node::Sin(_) | Node::Cos(_)),
        _ => false,
    };
    let shown = source.get(syntax.span.clone()).filter(|_| is_turned)?;
    let word = [("sin", "cos"), ("cos", "sin")].into_iter().find_map(|(was, now)| {
        let i = shown.find(was).filter(|i| shown[..*i].chars().all(|c| !c.is_alphanumeric()))?;
        Some((i, was, now))
    });
    let (i, was, now) = word.or_else(|| {
        let letters = [("s", "c"), ("c", "s"), ("S", "C"), ("C", "S")];
        letters.into_iter().find(|l| shown.starts_with(l.0)).map(|(was, now)| (0, was, now))
    })?;
    let start = syntax.span.start + i;
    Some((start..start + was.len(), now.into()))
}

/// All sines and cosines of a formula turned.
fn all_turned(source: &str, syntax: &Syntax, found: &mut Vec<(Range<usize>, String)>) {
    match turned(source, syntax) {
        Some(patch) => found.push(patch),
        None => syntax.children().into_iter().for_each(|part| all_turned(source, part, found)),
    }
}
