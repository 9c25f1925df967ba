//! A robot's functions over columns: record batches of Arrow in, the same with further columns out.
//!
//! A [`Request`] says what is to be computed. A [`Mapping`] is compiled of it and a robot; [`Mapping::bind`] finds its inputs in a
//! schema, by name, with their units, and [`Bound::run`] computes a batch: a row's results depend on nothing but its inputs. A row in
//! which an input is null or no finite number has nulls, and is counted.
//!
//! With the feature `files`, [`files`] maps whole files, part by part.

mod arm;
mod bound;
mod columns;
#[cfg(feature = "files")]
pub mod files;
mod inverse;
mod mapping;
mod outputs;
mod rates;
mod request;
mod unit;

pub use bound::{Bound, Counts};
pub use mapping::Mapping;
pub use request::{Frame, Inverse, Keep, Names, Orientation, Request, Solutions};
pub use unit::{Angle, Length, Units};

use std::fmt;

/// Why nothing can be computed.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct MapError {
    /// What is the matter, with its place.
    pub what: String,
    /// What to do.
    pub hint: String,
}

impl MapError {
    pub(crate) fn new(what: impl Into<String>, hint: impl Into<String>) -> Self {
        MapError { what: what.into(), hint: hint.into() }
    }
}

impl fmt::Display for MapError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}\n  = hint: {}", self.what, self.hint)
    }
}

impl std::error::Error for MapError {}
