//! Tests of documents and figures, one program.

mod escape;
mod figures;
mod plot;
mod report;
