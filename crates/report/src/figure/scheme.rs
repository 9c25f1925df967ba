//! The line diagram that textbooks print: links as lines, joints as small cylinders and boxes, axes dashed.

use super::drawing::Drawing;
use super::options::FigureOptions;
use super::picture::Picture;
use super::pose::Arm;
use super::solid::Style;
use super::view::View;

/// Draws an arm as a line diagram; one whose axes are all parallel is seen from above.
pub fn scheme(arm: &Arm, options: &FigureOptions) -> Drawing {
    let own = if arm.is_flat() { View::along(arm.skeleton.joints[0].axis) } else { arm.view() };
    let mut picture = Picture::new(arm, options, options.view.unwrap_or(own), Style::Outlined);
    picture.axes(options.frames);
    if options.frames && arm.is_flat() {
        // Their z axes are points.
        picture.frames();
    }
    if options.variables {
        picture.variables();
    }
    if options.lengths {
        picture.lengths(false);
    }
    picture.finish(true)
}
