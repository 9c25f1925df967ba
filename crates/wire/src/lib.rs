//! What is answered, as JSON: one set of names for the command line, the page and whoever asks next.
//!
//! A module a topic; its types are made from what the other crates find (`of`) and serialised as they stand. Lengths are
//! metres, angles radians, poses 4×4 by rows, in right-handed frames; joints, axes, rows and columns are counted from 1
//! unless a field says otherwise. Formulas are plain text that reads back. What is absent is left out, what is known not to be
//! there is null, and so is a number that is not finite. Fields stand in the order of their names. `docs/json.md` tells it to
//! those who read it.

pub mod calibration;
pub mod catalogue;
pub mod check;
pub mod class;
pub mod code;
pub mod convert;
pub mod derivation;
pub mod dynamics;
pub mod exercise;
pub mod finding;
pub mod forward;
pub mod identification;
pub mod inverse;
pub mod jacobian;
pub mod linkage;
pub mod mapped;
pub mod parallel;
pub mod parts;
pub mod path;
pub mod pose;
pub mod program;
pub mod recording;
pub mod robot;
pub mod singular;
pub mod view;

use denavit_report::words::English;
use serde::{Serialize, Serializer};

/// The version of all this: the number 1.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Schema;

impl Serialize for Schema {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_u32(1)
    }
}

/// An answer on one line, without its end.
///
/// # Panics
/// If a map in it has keys that are no texts: the types of this crate have none.
pub fn text<T: Serialize + ?Sized>(answer: &T) -> String {
    serde_json::to_string(answer).expect("every key is a text")
}

/// Appends an answer and the end of its line.
///
/// # Panics
/// As [`text`] does.
pub fn line<T: Serialize + ?Sized>(answer: &T, out: &mut Vec<u8>) {
    serde_json::to_writer(&mut *out, answer).expect("every key is a text, and memory takes everything");
    out.push(b'\n');
}

/// The words of an answer; called directly, so that a door carries those that it says.
fn words() -> English {
    English
}
