//! Why a function has no machine code.

use std::fmt;

/// Why there is no machine code.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Error {
    /// Cranelift has no code for this processor or system.
    Host(String),
    /// Cranelift does not translate this function: it is too large, or there is no memory for it.
    Refused(String),
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Error::Host(why) => write!(f, "no machine code on this processor: {why}"),
            Error::Refused(why) => write!(f, "no machine code for this function: {why}"),
        }
    }
}

impl std::error::Error for Error {}
