//! A document tree in each format.

mod html;
mod json;
mod latex;
mod layout;
mod markdown;
mod nested;
mod typst;

pub use html::{page as html, page_with as html_with};
pub use json::{Sources, formula as json_formula, formulas, parts as json_parts};
pub use latex::{fragment as latex_fragment, whole as latex};
pub use layout::too_long;
pub use markdown::{Markdown, whole as markdown};
pub use typst::{fragment as typst_fragment, whole as typst};
