//! The routines of this crate, embedded in emitted packages.

use super::{FUSED, Source, WIDTH};
use crate::compiled::{Function, lines};
use crate::wrap::comments;
use denavit_program::kernel::source;
use std::fmt::Write;

impl Source<'_> {
    pub(super) fn kernel(&self) -> String {
        let (pairs, atan2) = (self.has_pairs(), self.has_atan2());
        let words = "Sines, cosines, angles and roots, the same bits in loops of vector code as one by one.";
        let mut text = self.head("// ", &["", words]);
        if pairs || atan2 {
            text.push_str("\n// One of the two classes of arithmetic is used.\n#![allow(dead_code)]\n");
            let _ = write!(text, "\n#[cfg({FUSED})]\nmod fused;\n");
        }
        for (on, name, fused, strict) in [
            (pairs, "near_sin_cos", "sin_cos_fused", "sin_cos_strict"),
            (atan2, "near_atan2", "atan2_fused", "atan2_strict"),
        ] {
            if on {
                let _ = write!(
                    text,
                    "\n#[cfg({FUSED})]\npub(crate) use fused::{fused} as {name};\n\
                     #[cfg(not({FUSED}))]\npub(crate) use self::{strict} as {name};\n"
                );
            }
        }
        if pairs {
            text.push('\n');
            text.push_str(include_str!("drivers.rs.txt"));
            if Function::any_eight(&self.functions) {
                text.push_str(include_str!("eight.rs.txt"));
            }
            text.push_str(&embedded(source::REDUCE));
            text.push('\n');
            text.push_str(&embedded(source::SINCOS_STRICT));
        }
        if atan2 {
            text.push('\n');
            text.push_str(include_str!("atan2.rs.txt"));
            text.push_str(&embedded(source::ATAN2_STRICT));
        }
        if self.has_root() {
            text.push('\n');
            text.push_str(include_str!("sqrt.rs.txt"));
        }
        text
    }

    pub(super) fn fused(&self) -> String {
        let mut text = self.head("// ", &["", "The routines with fused multiply-add."]);
        text.push_str("\nuse super::*;\n");
        if self.has_pairs() {
            text.push('\n');
            text.push_str(&embedded(source::SINCOS_FUSED));
        }
        if self.has_atan2() {
            text.push('\n');
            text.push_str(&embedded(source::ATAN2_FUSED));
        }
        text
    }
}

/// What the routines of this crate say of the files that they stand in, and what is said where they are embedded.
const ELSEWHERE: &[(&str, &str)] = &[
    (" Needs reduce.rs and sincos_strict.rs.", ""),
    (" Needs reduce.rs.", ""),
    (" Self-contained.", ""),
    (" Needs atan2_strict.rs, whose scheme it follows.", " The scheme of the routine without."),
    ("The scheme of sincos_strict.rs;", "The scheme of the routine without;"),
];

/// A routine of this crate, its lines no longer than [`WIDTH`].
fn embedded(text: &str) -> String {
    let text = ELSEWHERE.iter().fold(text.to_string(), |text, (old, new)| text.replace(old, new));
    let mut list: Vec<String> = vec![];
    let mut rest = text.lines().peekable();
    while let Some(line) = rest.next() {
        let Some(prefix) = comment_prefix(line) else {
            list.extend(narrow(line));
            continue;
        };
        let mut paragraph = vec![line];
        while let Some(next) = rest.next_if(|next| comment_prefix(next).as_ref() == Some(&prefix)) {
            paragraph.push(next);
        }
        if paragraph.iter().all(|line| line.chars().count() <= WIDTH) {
            list.extend(paragraph.into_iter().map(str::to_string));
        } else {
            let words: Vec<&str> = paragraph.iter().map(|line| line[prefix.len()..].trim()).collect();
            list.extend(comments([words.join(" ").as_str()], &prefix, WIDTH));
        }
    }
    lines(&list)
}

/// What stands before the words of a comment; nothing for code and for empty comments.
fn comment_prefix(line: &str) -> Option<String> {
    let trimmed = line.trim_start();
    let sign = trimmed.split(' ').next().filter(|sign| ["//", "///"].contains(sign))?;
    let is_empty = trimmed.len() <= sign.len() + 1;
    (!is_empty).then(|| format!("{}{sign} ", &line[..line.len() - trimmed.len()]))
}

/// Code in lines no longer than [`WIDTH`]: it goes on behind the last comma or in front of the last call that fits.
fn narrow(line: &str) -> Vec<String> {
    if line.chars().count() <= WIDTH {
        return vec![line.to_string()];
    }
    let margin = " ".repeat(line.len() - line.trim_start().len());
    let cut = (margin.len() + 1..WIDTH).rev().find(|&k| {
        line.is_char_boundary(k) && (line[..k].ends_with(", ") || line[k..].starts_with(".mul_add("))
    });
    match cut {
        Some(cut) => {
            let first = line[..cut].trim_end().to_string();
            [vec![first], narrow(&format!("{margin}    {}", &line[cut..]))].concat()
        }
        None => vec![line.to_string()],
    }
}
