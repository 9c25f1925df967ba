//! Recordings held against robots.

mod made;
mod study;
