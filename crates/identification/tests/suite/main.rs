//! Parameters out of recordings that were made from known ones.

mod excitation;
mod file;
mod made;
mod recovery;
mod slips;
mod trees;
