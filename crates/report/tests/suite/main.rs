//! Tests of documents and figures, one program.

mod checked;
mod conditions;
mod escape;
mod exercise;
mod exercise_marks;
mod explain;
mod fed_back;
mod figures;
mod language;
mod messages;
mod plot;
mod report;
mod slides;
