//! One file a verb.

pub mod derive;
pub mod fk;
pub mod generate;
pub mod robots;
pub mod show;
