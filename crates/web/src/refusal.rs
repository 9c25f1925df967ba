//! Why a request is not answered.

use serde::Serialize;

/// A sentence for whoever uses the page, and what would help.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Refusal {
    /// What is wrong.
    pub error: String,
    /// What would help.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hint: Option<String>,
}

impl Refusal {
    /// Without a hint.
    pub fn new(error: impl Into<String>) -> Self {
        Refusal { error: error.into(), hint: None }
    }
}
