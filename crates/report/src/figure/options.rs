//! What a picture of an arm shows.

use super::view::{Bounds, View};

/// What a picture of an arm shows.
#[derive(Clone, PartialEq, Debug)]
pub struct FigureOptions {
    /// Points.
    pub width: f64,
    /// No higher than this, points.
    pub height: f64,
    /// The frames' x and z axes with their names.
    pub frames: bool,
    /// Their y axes too.
    pub y_axes: bool,
    /// The lengths of the table.
    pub lengths: bool,
    /// The joint variables.
    pub variables: bool,
    /// Joints (from 0) whose axes the picture is about.
    pub highlight: Vec<usize>,
    /// Where one looks from; the arm's own choice otherwise.
    pub view: Option<View>,
    /// What is to be seen, so that several pictures have one scale; the arm itself otherwise.
    pub bounds: Option<Bounds>,
}

impl FigureOptions {
    /// A figure of its own: everything is named.
    pub fn main() -> Self {
        FigureOptions {
            width: 460.0,
            height: 400.0,
            frames: true,
            y_axes: false,
            lengths: true,
            variables: true,
            highlight: vec![],
            view: None,
            bounds: None,
        }
    }

    /// A figure that fills a slide: everything is named, in letters that are large beside it.
    pub fn slide() -> Self {
        FigureOptions { height: 250.0, ..FigureOptions::main() }
    }

    /// A small picture without words, to stand beside others.
    pub fn small(width: f64, height: f64) -> Self {
        FigureOptions {
            width,
            height,
            frames: false,
            lengths: false,
            variables: false,
            ..FigureOptions::main()
        }
    }

    /// Whether there is anything to name.
    pub(super) fn has_labels(&self) -> bool {
        self.frames || self.lengths || self.variables
    }
}

impl Default for FigureOptions {
    fn default() -> Self {
        FigureOptions::main()
    }
}
