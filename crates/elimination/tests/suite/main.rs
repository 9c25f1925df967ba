//! Tests of elimination, one program.

mod aligned;
mod arms;
mod complete;
mod published;
