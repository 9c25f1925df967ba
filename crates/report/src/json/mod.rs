//! Results as JSON, schema 1; `docs/json.md` describes it.

mod check;

pub use check::{checked, entry_name};
