//! Where the page is served.

use crate::Schema;
use serde::Serialize;

/// An address.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Served {
    /// The version.
    pub schema: Schema,
    /// Where the page is, for the browser of this machine.
    pub url: String,
}
