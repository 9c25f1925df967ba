//! Robot manipulators, exactly.
#![doc = "\n"]
pub mod scalar;
