//! Figures: shapes in order of painting, and what draws them.
//!
//! An [`Arm`] is a robot in a pose that shows it well; [`isometric`] draws it as it would look, [`scheme()`] as textbooks
//! do. A [`Drawing`] becomes text in [`svg`], [`tikz`] or [`typst`].

pub mod arm;
mod bars;
pub mod drawing;
pub mod labels;
mod naming;
mod options;
mod picture;
mod place;
pub mod plot;
mod pose;
pub mod scheme;
mod skeleton;
mod slide;
mod solid;
pub mod svg;
pub mod tikz;
pub mod typst;
pub mod view;

pub use arm::isometric;
pub use bars::BAR;
pub use drawing::Drawing;
pub use naming::symbol;
pub use options::FigureOptions;
pub use place::{Bar, Layout, Symbol};
pub use pose::Arm;
pub use scheme::scheme;
pub use skeleton::{Joint, Length, Skeleton};
pub use view::{Bounds, View};
