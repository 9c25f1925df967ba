//! What is wrong with a text, or worth saying of it.

use crate::Schema;
use denavit::description::{Diagnostic, line_column};
use serde::Serialize;
use std::ops::Range;

/// A place in a text.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
pub struct Place {
    /// Its bytes, from 0; the second is behind it.
    pub bytes: [usize; 2],
    /// The column, from 1, in characters.
    pub column: usize,
    /// The line, from 1.
    pub line: usize,
}

impl Place {
    /// A part of a text.
    pub fn of(text: &str, span: &Range<usize>) -> Self {
        let (line, column) = line_column(text, span.start);
        Place { bytes: [span.start, span.end], column, line }
    }
}

/// Something that was found in a text.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Finding {
    /// Where, in a text.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at: Option<Place>,
    /// Where, in a robot file: `joints.2.theta`, counted from 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cell: Option<String>,
    /// What would help.
    pub hint: Option<String>,
    /// What.
    pub message: String,
    /// `error`, `warning` or `note`.
    pub severity: &'static str,
}

impl Finding {
    /// Without a place.
    pub fn of(found: &Diagnostic) -> Self {
        Finding {
            at: None,
            cell: None,
            hint: found.hint.clone(),
            message: found.message.clone(),
            severity: found.severity.name(),
        }
    }

    /// With its place in a text.
    pub fn placed(found: &Diagnostic, text: &str) -> Self {
        Finding { at: Some(Place::of(text, &found.span)), ..Self::of(found) }
    }
}

/// A line of input that cannot be read.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct BadLine<'a> {
    /// What is wrong with it.
    pub error: &'a str,
    /// Its number, from 1.
    pub line: usize,
    /// The version.
    pub schema: Schema,
}
