//! The picture of an arm that one would recognise: bodies with light and shadow, seen from one side and from above.

use super::drawing::Drawing;
use super::options::FigureOptions;
use super::picture::Picture;
use super::pose::Arm;
use super::solid::Style;

/// Draws an arm as it would look.
pub fn isometric(arm: &Arm, options: &FigureOptions) -> Drawing {
    let view = options.view.unwrap_or_else(|| arm.view());
    let mut picture = Picture::new(arm, options, view, Style::Shaded);
    picture.axes(false);
    if options.frames {
        picture.frames();
    }
    if options.variables {
        picture.variables();
    }
    if options.lengths {
        picture.lengths(true);
    }
    picture.finish(false)
}
