//! A document tree in each format.

mod html;
mod latex;
mod layout;
mod markdown;
mod nested;
mod typst;

pub use html::page as html;
pub use latex::{fragment as latex_fragment, whole as latex};
pub use layout::too_long;
pub use markdown::{Markdown, whole as markdown};
pub use typst::{fragment as typst_fragment, whole as typst};
