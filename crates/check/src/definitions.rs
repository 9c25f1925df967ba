//! A slip in a definition shows in every result that uses it: the one change of the definition that mends them all.

use super::facts::{Change, SlipKind};
use super::judge::{Judge, slip};
use super::outcome::{Cause, Claim, Finding};
use super::plan::Walked;
use super::walk::{Defined, Pair, Piece};
use denavit_reading::slip::{Effort, Value, Wanted, needed, repairs};
use denavit_symbolic::parse::{Syntax, SyntaxKind, parse_syntax};
use denavit_symbolic::vocabulary::{Vocabulary, plain_name};
use denavit_symbolic::{Expr, equal};

/// No more definitions than these are looked at.
const MAX_DEFINITIONS: usize = 200;

/// The definitions whose mending turns wrong results right.
pub(super) fn causes(judge: &mut Judge<'_>, text: &str, walked: &Walked, claims: &[Claim]) -> Vec<Cause> {
    let wrong: Vec<(usize, usize, &Pair, usize)> = walked
        .assertions
        .iter()
        .enumerate()
        .flat_map(|(c, a)| a.pieces.iter().enumerate().map(move |(e, p)| (c, e, p, a.subject)))
        .filter_map(|(c, e, piece, subject)| match (piece, &claims.get(c)?.entries.get(e)?.finding) {
            (Piece::Pair(pair), Finding::Wrong(_)) => Some((c, e, pair, subject)),
            _ => None,
        })
        .collect();
    if wrong.is_empty() {
        return vec![];
    }
    let mut found: Vec<Cause> = vec![];
    for defined in walked.defined.iter().take(MAX_DEFINITIONS) {
        let uses: Vec<_> = wrong
            .iter()
            .filter(|w| {
                w.3 == defined.subject
                    && w.2.printed.as_ref().is_some_and(|s| mentions(s, defined, text, w.2))
            })
            .collect();
        if uses.is_empty() {
            continue;
        }
        let Some(cause) = mended(judge, text, walked, defined, &uses) else { continue };
        found.push(cause);
    }
    found
}

/// True if a formula uses a defined name.
fn mentions(syntax: &Syntax, defined: &Defined, text: &str, pair: &Pair) -> bool {
    is_name(syntax, defined, text, pair)
        || syntax.children().into_iter().any(|s| mentions(s, defined, text, pair))
}

fn is_name(part: &Syntax, defined: &Defined, text: &str, pair: &Pair) -> bool {
    let is_value = matches!(part.kind, SyntaxKind::Name(e) if e == defined.value);
    let source = text.get(pair.span.clone()).and_then(|s| s.get(part.span.clone()));
    is_value && source.is_some_and(|s| plain_name(s) == defined.name)
}

type Use<'a> = (usize, usize, &'a Pair, usize);

/// The change of a definition that mends all that use it and are wrong.
fn mended(
    judge: &mut Judge<'_>,
    text: &str,
    walked: &Walked,
    defined: &Defined,
    uses: &[&Use<'_>],
) -> Option<Cause> {
    let names = walked.names_of(defined.subject);
    let lexicon = judge.lexicon(defined.subject)?;
    let mut value: Option<Value> = None;
    for (_, _, pair, _) in uses {
        let printed = pair.printed.as_ref()?;
        let is_part = |part: &Syntax| is_name(part, defined, text, pair);
        let this = needed(printed, is_part, &Wanted::Formula(pair.wanted), lexicon)?;
        if value.is_some_and(|v| v != this) {
            return None;
        }
        value = Some(this);
    }
    let source = text.get(defined.span.clone())?;
    let found = repairs(source, &defined.printed, &Wanted::Values(value?), lexicon, names, Effort::default());
    let best = found.into_iter().find(|r| r.cost <= 60)?;
    // Proved: each use with the mended definition is right.
    let is_right = |pair: &Pair| {
        let now: Expr = best.value;
        let names = Vocabulary::clone(names).alias(&defined.name, now);
        let source = text.get(pair.span.clone()).unwrap_or_default();
        parse_syntax(source, &names).is_ok_and(|s| equal(s.value(), pair.wanted).is_equal())
    };
    if !uses.iter().all(|u| is_right(u.2)) {
        return None;
    }
    Some(Cause {
        change: Change::Definition { name: defined.name.clone(), slip: SlipKind::Formula(best.slip.clone()) },
        slip: Some(slip(best, defined.span.start)),
        turns_right: uses.iter().map(|u| (u.0, u.1)).collect(),
        turns_wrong: vec![],
        stays_wrong: vec![],
    })
}
