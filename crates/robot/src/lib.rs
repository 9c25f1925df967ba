//! Robot manipulators, exactly.
#![doc = "\n"]
pub mod geometry;
pub mod scalar;
pub mod description;
