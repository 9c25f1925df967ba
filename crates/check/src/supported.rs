//! The convention of tables of which the document does not say it: the one in which its own statements are right.

use super::note::Notes;
use super::plan::{Plan, kind_of_tables};
use super::{CheckOptions, dynamics, listing, readings};
use denavit::description::Convention;
use denavit::description::table::convention_said;
use denavit_reading::document::{Document, Format};
use std::ops::Range;

/// What the statements of a document say of its tables.
pub(super) struct Supported {
    pub convention: Convention,
    /// How many of its statements are right in that convention.
    pub right: usize,
    /// How many at most in another.
    pub rival: usize,
    /// The head of the first table that does not say it.
    pub head: Range<usize>,
}

/// A convention, and how many statements are right and how many wrong in it.
type Score = (Convention, [usize; 2]);

/// So many more right statements say what a convention is where none is wrong in another.
const CLEARLY: usize = 3;

/// The convention in which more statements are right and fewer wrong than in any other; nothing where tables or words say
/// it.
pub(super) fn by_statements(
    text: &str,
    format: Format,
    document: &Document,
    options: &CheckOptions,
) -> Option<Supported> {
    if options.table.convention.is_some() || format == Format::Toml || convention_said(text).is_some() {
        return None;
    }
    let kind = kind_of_tables(format);
    let unsaid =
        listing::tables_of(text, kind, options, &options.table).into_iter().find(|t| t.robot.is_err())?;
    let mut scores: Vec<Score> = vec![];
    let mut of_dynamics: Vec<Score> = vec![];
    for convention in Convention::ALL {
        let mut there = options.clone();
        there.table.convention = Some(convention);
        let printed = listing::tables_of(text, kind, &there, &there.table);
        // What is amiss with the table is something else, or the letters are not those of the convention.
        if !printed.iter().any(|t| t.span == unsaid.span && t.robot.is_ok()) {
            continue;
        }
        let Ok(plan) = Plan::of(text, format, document, None, &there, &mut Notes::default()) else {
            continue;
        };
        let score = match options.language {
            Some(_) => readings::entries(&plan.walk(text, document, &there)),
            None => {
                of_dynamics.push((convention, dynamics::support(text, document, &plan)));
                readings::support(text, document, plan, &there)
            }
        };
        scores.push((convention, score));
    }
    // A document of torques and energies has few formulas of positions.
    let found = clearly(scores.clone()).or_else(|| {
        let both = |(s, d): (&Score, &Score)| (s.0, [s.1[0] + d.1[0], s.1[1] + d.1[1]]);
        clearly(scores.iter().zip(&of_dynamics).map(both).collect())
    })?;
    let end = text[unsaid.span.start..].find('\n').map_or(unsaid.span.end, |n| unsaid.span.start + n);
    let (convention, right, rival) = found;
    Some(Supported { convention, right, rival, head: unsaid.span.start..end })
}

/// The convention in which more is right and less wrong than in any other, how much is right in it and how much at most in another.
fn clearly(mut scores: Vec<Score>) -> Option<(Convention, usize, usize)> {
    scores.sort_by_key(|s| std::cmp::Reverse(s.1[0]));
    let &(convention, [right, wrong]) = scores.first()?;
    let rivals = &scores[1..];
    let is_best = rivals.iter().all(|&(_, [other, wrong_there])| {
        right > other && (wrong < wrong_there || wrong == wrong_there && right >= other + CLEARLY)
    });
    let rival = rivals.iter().map(|s| s.1[0]).max().unwrap_or(0);
    is_best.then_some((convention, right, rival))
}
