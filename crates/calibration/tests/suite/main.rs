//! What measurements show of an arm, and what is made of them.

mod columns;
mod estimate;
mod made;
mod structure;
