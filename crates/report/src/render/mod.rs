//! A document tree in each format.

mod html;
mod latex;
mod layout;
mod markdown;
mod nested;
pub mod slides;
mod typst;

pub use html::{
    escaped, font, font_face, math_aligned, math_display, page as html, page_with as html_with,
    words as html_words,
};
pub use latex::{fragment as latex_fragment, whole as latex};
pub(crate) use layout::columns;
pub use layout::{Named, formulas, is_wide, named, too_long};
pub use markdown::{Markdown, whole as markdown};
pub use typst::{fragment as typst_fragment, whole as typst};
