//! What the comments of a program claim: results and formulas in lines of their own, read as a document's.
//!
//! Programs are read without running them; a comment may speak of names that are the program's, or of a state that it is in
//! later. So what cannot be read in a comment is left aside, and a number that is refuted there is one of another configuration
//! unless a number beside it is right.

use super::facts::Unproved;
use super::outcome::{Claim, Finding, Standing};
use super::walk::{Assertion, Piece};
use denavit_reading::code::Dialect;
use denavit_reading::document::{self, Document, Format};
use std::ops::Range;

/// The longest line that is looked at.
const LONGEST: usize = 500;

/// The statements in the comments of a program.
pub(super) fn document(text: &str, language: Dialect) -> Document {
    let mut bytes: Vec<u8> = text.bytes().map(|b| if b == b'\n' { b'\n' } else { b' ' }).collect();
    let (mut is_block, mut is_any) = (false, false);
    for line in super::lines::lines(text) {
        let source = text.get(line.clone()).unwrap_or_default();
        let own = source.trim_start();
        let bare = match language {
            Dialect::Python => own.strip_prefix('#').map(|o| o.trim_start_matches('#')),
            Dialect::Matlab => own.strip_prefix('%').map(|o| o.trim_start_matches('%')),
            Dialect::C => {
                let begins = own.strip_prefix("/*");
                let inner = match (begins, is_block) {
                    (Some(inner), _) => Some(inner.trim_start_matches('*')),
                    (None, true) => Some(own.strip_prefix("* ").unwrap_or(own)),
                    (None, false) => own.strip_prefix("//").map(|o| o.trim_start_matches('/')),
                };
                is_block = match own.rfind("*/") {
                    Some(at) => own[at..].contains("/*"),
                    None => is_block || begins.is_some(),
                };
                // Code may follow.
                let ends = inner.and_then(|i| i.split_once("*/"));
                match ends {
                    Some((_, rest)) if !rest.trim().is_empty() => None,
                    Some((inner, _)) => Some(inner),
                    None => inner,
                }
            }
        };
        let Some(bare) = bare.filter(|b| b.len() < LONGEST) else { continue };
        let start = line.start + (bare.as_ptr() as usize - source.as_ptr() as usize);
        bytes[start..start + bare.len()].copy_from_slice(bare.as_bytes());
        is_any |= bare.contains('=');
    }
    match String::from_utf8(bytes) {
        Ok(comments) if is_any => document::read(&comments, Format::Markdown),
        _ => Document::default(),
    }
}

/// True for what is said in a comment and cannot be judged there.
pub(super) fn is_idle(assertion: &Assertion, remarks: &[Range<usize>]) -> bool {
    let is_unread = assertion.pieces.iter().any(|p| matches!(p, Piece::Unreadable { .. }));
    is_in(&assertion.span, remarks)
        && (is_unread || assertion.pieces.is_empty() || assertion.spoken.is_some())
}

/// True for a place in a comment.
pub(super) fn is_in(span: &Range<usize>, remarks: &[Range<usize>]) -> bool {
    let next = remarks.partition_point(|r| r.end <= span.start);
    remarks.get(next).is_some_and(|r| r.start < span.end)
}

/// Numbers in comments that are refuted are not called wrong where no other one beside them is right.
pub(super) fn withdraw(remarks: &[Range<usize>], assertions: &[Assertion], claims: &mut [Claim]) {
    let is_number = |a: &Assertion| a.pieces.iter().all(|p| matches!(p, Piece::Number { .. }));
    let own: Vec<usize> = (0..claims.len().min(assertions.len()))
        .filter(|&k| is_in(&claims[k].span, remarks) && is_number(&assertions[k]))
        .collect();
    let standing: Vec<Standing> = own.iter().map(|&k| claims[k].standing()).collect();
    for (i, &k) in own.iter().enumerate() {
        let near = i.saturating_sub(3)..(i + 4).min(own.len());
        let right = near.clone().filter(|&j| standing[j] == Standing::Equal).count();
        let wrong = near.filter(|&j| standing[j] == Standing::Wrong).count();
        if standing[i] == Standing::Wrong && right < wrong {
            for entry in claims[k].entries.iter_mut().filter(|e| matches!(e.finding, Finding::Wrong(_))) {
                entry.finding = Finding::Undecided { why: Unproved::NoPose };
            }
        }
    }
}
