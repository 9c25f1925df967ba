//! Why a request is not answered.

use serde_json::{Value, json};

/// A sentence for whoever uses the page, and what would help.
#[derive(Clone, PartialEq, Debug)]
pub struct Refusal {
    /// What is wrong.
    pub error: String,
    /// What would help.
    pub hint: Option<String>,
}

impl Refusal {
    /// Without a hint.
    pub fn new(error: impl Into<String>) -> Self {
        Refusal { error: error.into(), hint: None }
    }

    /// As the page reads it.
    pub fn into_json(self) -> Value {
        match self.hint {
            Some(hint) => json!({ "error": self.error, "hint": hint }),
            None => json!({ "error": self.error }),
        }
    }
}
