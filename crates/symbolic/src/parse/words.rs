//! Cutting a run of letters and digits into names and sines, by a shortest path over its places.
//!
//! A known symbol costs 10, a sine of numbered angles or the name of a function 11, so that the vocabulary wins over
//! the sines, and fewer pieces over more. Two cheapest paths that mean different things are an error.

use super::ParseError;
use super::functions::Function;
use super::names::Names;
use super::normalise::is_greek;
use super::trig;
use crate::expr::Expr;
use std::ops::Range;

/// A letter or digit of a word.
#[derive(Clone, Debug)]
pub(super) struct Letter {
    pub c: char,
    /// True for digits and subscripts, which no piece begins with.
    pub glued: bool,
    pub span: Range<usize>,
}

/// What follows a word.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Next {
    /// A bracket, perhaps behind a power.
    Bracket,
    /// A fraction, a root or a number, likewise: the argument of a function with a full name.
    Argument,
    /// A letter: the argument of an arc that is written out, `\arctan t`.
    Letter,
    Other,
}

/// What a piece of a word means.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Piece {
    Atom(Expr),
    Function(Function),
}

pub(super) const KNOWN: u64 = 10;
pub(super) const TRIG: u64 = 11;
/// A new symbol of an open vocabulary.
const OPEN: u64 = 20;
/// A piece that cannot be read costs so much that it is on a path only where there is no other.
pub(super) const REFUSED: u64 = 1_000;
const UNKNOWN: u64 = 100_000;
/// The longest new symbol.
const MAX_NAME: usize = 100;

/// A way to read the letters from `from` up to some place.
#[derive(Clone, Debug)]
struct Edge {
    from: usize,
    kind: EdgeKind,
}

#[derive(Clone, Debug)]
enum EdgeKind {
    Piece(Piece),
    /// A new symbol.
    Open,
    Unknown,
    Refused(ParseError),
}

/// A product of pieces, and where they end.
#[derive(Clone)]
struct Way {
    product: Expr,
    last: Option<Function>,
    pieces: Vec<(Piece, usize)>,
}

/// The pieces of a word, with their places.
pub(super) fn split(
    letters: &[Letter],
    next: Next,
    names: &Names,
    text: &str,
) -> Result<Vec<(Piece, Range<usize>)>, Vec<ParseError>> {
    let n = letters.len();
    let mut best = vec![u64::MAX; n + 1];
    let mut into: Vec<Vec<Edge>> = vec![vec![]; n + 1];
    best[0] = 0;
    for from in 0..n {
        if best[from] == u64::MAX {
            continue;
        }
        let start = best[from];
        let mut offer = |to: usize, cost: u64, kind: &mut dyn FnMut() -> EdgeKind| {
            let cost = start + cost;
            if cost < best[to] {
                best[to] = cost;
                into[to].clear();
            }
            if cost == best[to] {
                into[to].push(Edge { from, kind: kind() });
            }
        };
        known_edges(letters, from, names, &mut offer);
        for edge in trig::edges(letters, from, next, names) {
            let mut meaning = Some(edge.meaning);
            offer(edge.to, edge.cost, &mut || match meaning.take() {
                Some(Ok(piece)) => EdgeKind::Piece(piece),
                Some(Err(e)) => EdgeKind::Refused(e),
                None => EdgeKind::Unknown,
            });
        }
        other_edges(letters, from, next == Next::Bracket, names, &mut offer);
    }
    if best[n] >= REFUSED {
        return Err(failures(letters, &into, next == Next::Bracket, names));
    }
    let ways = ways(letters, &into);
    if let [one, other] = ways.as_slice() {
        let [a, b] = [one, other].map(|w| reading(letters, w, text));
        let word = spelled(letters);
        let span = letters[0].span.start..letters[n - 1].span.end;
        let e = ParseError::new(span, format!("`{word}` reads as `{a}` or as `{b}`"));
        let inverse = [one, other].into_iter().find_map(|w| w.last.filter(|f| f.is_inverse()));
        return Err(vec![match inverse {
            Some(f) => {
                e.hint(format!("write `{}` for the inverse function, or `*` between the factors", f.name()))
            }
            None => e.hint("write `*` between the factors"),
        }]);
    }
    let mut from = 0;
    let pieces = ways.into_iter().next().map(|w| w.pieces).unwrap_or_default();
    Ok(pieces
        .into_iter()
        .map(|(piece, to)| {
            let span = letters[from].span.start..letters[to - 1].span.end;
            from = to;
            (piece, span)
        })
        .collect())
}

/// The places behind `from` at which a piece may end.
pub(super) fn ends(letters: &[Letter], from: usize) -> impl Iterator<Item = usize> {
    (from + 1..=letters.len()).filter(|&j| letters.get(j).is_none_or(|l| !l.glued))
}

fn known_edges(
    letters: &[Letter],
    from: usize,
    names: &Names,
    offer: &mut impl FnMut(usize, u64, &mut dyn FnMut() -> EdgeKind),
) {
    let longest = names.longest;
    for to in ends(letters, from).take_while(|to| to - from <= longest) {
        if let Some(e) = names.known(&spelled(&letters[from..to])) {
            offer(to, KNOWN, &mut || EdgeKind::Piece(Piece::Atom(e)));
        }
    }
}

/// New and unknown symbols: letters, then digits and subscripts.
fn other_edges(
    letters: &[Letter],
    from: usize,
    is_called: bool,
    names: &Names,
    offer: &mut impl FnMut(usize, u64, &mut dyn FnMut() -> EdgeKind),
) {
    let n = letters.len();
    let mut is_name = true;
    let mut has_index = false;
    let mut end_of_letters = from;
    for to in from + 1..=n {
        let l = &letters[to - 1];
        if has_index && !l.glued {
            break;
        }
        has_index |= l.glued;
        is_name &= l.c.is_alphanumeric();
        if !l.glued {
            end_of_letters = to;
        }
        if letters.get(to).is_some_and(|l| l.glued) {
            continue;
        }
        offer(to, UNKNOWN + 100 * (to - from) as u64, &mut || EdgeKind::Unknown);
        let is_function = is_called && to == n && !has_index && to - from > 1;
        let is_function = is_function || to == n && is_inverse_name(&letters[from..to]);
        if names.is_open() && is_name && !is_function && to - from <= MAX_NAME {
            // `aC1` may be a·C1: as dear as these two pieces. `RC4` and `pos2` are names.
            let tail =
                end_of_letters.checked_sub(2).filter(|&i| i >= from).map(|i| &letters[i..end_of_letters]);
            let has_sine = matches!(tail, Some([a, b]) if a.c.is_lowercase() && matches!(b.c, 'C' | 'S'));
            let has_digits = letters[end_of_letters..to].iter().all(|l| l.c.is_ascii_digit()) && has_index;
            let cost = if has_sine && has_digits { OPEN + TRIG } else { OPEN };
            offer(to, cost, &mut || EdgeKind::Open);
        }
    }
}

/// The cheapest readings of the whole word, at most two that differ.
fn ways(letters: &[Letter], into: &[Vec<Edge>]) -> Vec<Way> {
    let n = letters.len();
    let mut is_used = vec![false; n + 1];
    is_used[n] = true;
    for to in (0..=n).rev() {
        if is_used[to] {
            into[to].iter().for_each(|e| is_used[e.from] = true);
        }
    }
    let mut at: Vec<Vec<Way>> = vec![vec![]; n + 1];
    at[0].push(Way { product: Expr::int(1), last: None, pieces: vec![] });
    for to in (1..=n).filter(|&to| is_used[to]) {
        for edge in &into[to] {
            let piece = match &edge.kind {
                EdgeKind::Piece(p) => p.clone(),
                EdgeKind::Open | EdgeKind::Unknown | EdgeKind::Refused(_) => {
                    Piece::Atom(Expr::symbol(&spelled(&letters[edge.from..to])))
                }
            };
            for i in 0..at[edge.from].len() {
                let before = &at[edge.from][i];
                let (product, last) = match piece {
                    Piece::Atom(e) => (before.product * e, None),
                    Piece::Function(f) => (before.product, Some(f)),
                };
                if at[to].len() < 2 && !at[to].iter().any(|w| w.product == product && w.last == last) {
                    let mut pieces = before.pieces.clone();
                    pieces.push((piece.clone(), to));
                    at[to].push(Way { product, last, pieces });
                }
            }
        }
    }
    at.pop().unwrap_or_default()
}

/// What is wrong along a cheapest path.
fn failures(letters: &[Letter], into: &[Vec<Edge>], is_called: bool, names: &Names) -> Vec<ParseError> {
    let mut errors = vec![];
    let mut to = letters.len();
    while to > 0 {
        let Some(edge) = into[to].first() else { break };
        let span = letters[edge.from].span.start..letters[to - 1].span.end;
        match &edge.kind {
            EdgeKind::Piece(_) | EdgeKind::Open => {}
            EdgeKind::Refused(e) => errors.push(e.clone()),
            EdgeKind::Unknown => {
                let is_function = is_called && to == letters.len();
                errors.push(names.unknown(&spelled(&letters[edge.from..to]), is_function, span));
            }
        }
        to = edge.from;
    }
    errors.reverse();
    errors
}

fn reading(letters: &[Letter], way: &Way, text: &str) -> String {
    let mut from = 0;
    let pieces = way.pieces.iter().map(|(_, to)| {
        let span = letters[from].span.start..letters[to - 1].span.end;
        from = *to;
        text.get(span).unwrap_or_default()
    });
    pieces.collect::<Vec<_>>().join("*")
}

/// The letters in plain spelling.
pub(super) fn spelled(letters: &[Letter]) -> String {
    letters.iter().map(|l| l.c).collect()
}

/// True if the letters end in `sin`, `cos` or `tan`, or in `sen`.
pub(super) fn ends_in_full_name(letters: &[Letter]) -> bool {
    match letters {
        [.., a, b, c] => {
            let is_name =
                matches!([a.c, b.c, c.c], ['s', 'i' | 'e', 'n'] | ['c', 'o', 's'] | ['t', 'a', 'n']);
            is_name && !(a.glued || b.glued || c.glued)
        }
        _ => false,
    }
}

/// True if the letters end in `arcsin`, `arccos` or `arctan`.
pub(super) fn ends_in_inverse_name(letters: &[Letter]) -> bool {
    letters.len().checked_sub(6).is_some_and(|from| is_inverse_name(&letters[from..]))
}

fn is_inverse_name(letters: &[Letter]) -> bool {
    letters.len() == 6 && matches!(spelled(letters).as_str(), "arcsin" | "arccos" | "arctan")
}

/// True if the letters may end in a sine that still lacks its argument.
pub(super) fn awaits_argument(letters: &[Letter]) -> bool {
    let is_letter = |l: &Letter| !l.glued && matches!(l.c, 'C' | 'S' | 'c' | 's');
    !ends_in_inverse_name(letters) && (ends_in_full_name(letters) || letters.last().is_some_and(is_letter))
}

/// True if a Greek letter begins at `at` (other than π).
pub(super) fn is_angle_letter(letters: &[Letter], at: usize) -> bool {
    letters.get(at).is_some_and(|l| is_greek(l.c) && l.c != 'π')
}
