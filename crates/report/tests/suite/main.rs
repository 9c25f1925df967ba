//! Tests of documents and figures, one program.

mod checked;
mod escape;
mod explain;
mod figures;
mod language;
mod plot;
mod report;
