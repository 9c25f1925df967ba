//! Recordings held against robots.

mod hostile;
mod made;
mod motion;
mod recipe;
mod study;
