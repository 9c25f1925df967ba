//! From a name to a robot: the catalogue, files of every format, and the files that they name in turn.
//!
//! - [`listed`]: the text of an arm of the catalogue; [`close_names`]: what may have been meant.
//! - [`Kind`]: what a file holds, by its ending or its root element; [`read`], [`read_text`]: what stands in it.
//! - [`Content::chain`]: the chain of it, and what is around that ([`Around`]).
//! - [`Folder`]: the files that a description names, where they lie.
//! - [`joint`], [`frame`]: joints and frames by number or name.

mod chain;
mod folder;
mod kind;
mod named;
mod read;
mod text;

pub use chain::{Around, NotTaken};
pub use folder::{Folder, Found, plain};
pub use kind::{ENDINGS, Kind, catalogue_name, close_names, is_tree, listed};
pub use named::{frame, joint};
pub use read::{Content, Contents, Finding, Options, Problem, read, read_text};
pub use text::{bytes, contents};
