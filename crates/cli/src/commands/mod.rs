//! One file a verb; `stream` is what the verbs with `--input` share.

pub mod derive;
pub mod fk;
pub mod generate;
pub mod ik;
pub mod robots;
pub mod show;
mod stream;
