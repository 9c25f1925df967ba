//! One file a verb; `stream` is what the verbs with `--input` share.

pub mod calibrate;
mod certificate;
pub mod check;
pub mod convert;
pub mod derive;
pub mod document;
pub mod dynamics;
pub mod exercise;
pub mod fk;
pub mod generate;
pub mod identify;
pub mod ik;
pub mod jacobian;
#[cfg(feature = "parquet")]
pub mod map;
pub mod parallel;
pub mod path;
pub mod report;
pub mod robots;
pub mod show;
mod stream;
pub mod view;
