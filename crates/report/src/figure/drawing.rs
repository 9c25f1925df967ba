//! A drawing that knows no format: shapes in order of painting, colours by what they mean, labels with indices.
//!
//! Coordinates are points (1/72 inch), x to the right, y down, the origin in the upper left corner.

/// A drawing.
#[derive(Clone, PartialEq, Debug)]
pub struct Drawing {
    /// Points.
    pub width: f64,
    /// Points.
    pub height: f64,
    /// What is to be seen, for those who do not see it.
    pub description: String,
    /// In order of painting.
    pub shapes: Vec<Shape>,
}

impl Drawing {
    /// Writes the numbers of its labels in another way.
    pub(crate) fn write_numbers(&mut self, write: &dyn Fn(String) -> String) {
        for shape in &mut self.shapes {
            let Shape::Text { label, .. } = shape else { continue };
            for piece in label.0.iter_mut().filter(|p| !p.italic && !p.subscript) {
                piece.text = write(std::mem::take(&mut piece.text));
            }
        }
    }
}

/// A part of a drawing.
#[derive(Clone, PartialEq, Debug)]
pub enum Shape {
    /// An outline, filled or drawn or both.
    Path {
        /// Where it runs.
        segments: Vec<Segment>,
        /// What it is filled with.
        fill: Option<Ink>,
        /// The line along it.
        stroke: Option<Stroke>,
    },
    /// Words or symbols.
    Text {
        /// The point that the label stands at by its base line.
        at: [f64; 2],
        /// Which part of the label is there.
        anchor: Anchor,
        /// The height of the letters, points.
        size: f64,
        /// The colour.
        ink: Ink,
        /// What is written.
        label: Label,
    },
}

/// A part of an outline.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Segment {
    /// Go there without drawing.
    Move([f64; 2]),
    /// A straight line.
    Line([f64; 2]),
    /// A cubic Bézier curve: two control points and the end.
    Cubic([f64; 2], [f64; 2], [f64; 2]),
    /// Back to the last place that was gone to without drawing.
    Close,
}

/// A line.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Stroke {
    /// The colour.
    pub ink: Ink,
    /// Points.
    pub width: f64,
    /// Dashes of this length, points.
    pub dash: Option<f64>,
}

/// A colour by what it stands for; light and dark pages have their own.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Ink {
    /// Lines and words.
    Line,
    /// What stands back: grids, floors, projections.
    Faint,
    /// The page.
    Paper,
    /// The body of the arm, from 0 (in shadow) to 1 (in light).
    Body(f64),
    /// What turns, from 0 to 1.
    Revolute(f64),
    /// What slides, from 0 to 1.
    Prismatic(f64),
    /// The x, y or z axis of a frame.
    Axis(u8),
    /// A dimension and its label.
    Dimension,
    /// What the picture is about: an axis that is lost.
    Accent,
    /// A series of a plot.
    Series(u8),
    /// A value from 0 to 1 on a scale of colours.
    Scale(f64),
}

/// Which part of a label is at its place.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Anchor {
    /// Its start.
    Start,
    /// Its middle.
    Middle,
    /// Its end.
    End,
}

/// What is written: pieces side by side.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Label(pub Vec<LabelPiece>);

/// A piece of a label.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct LabelPiece {
    /// The letters.
    pub text: String,
    /// Whether they lean, as variables do.
    pub italic: bool,
    /// Whether they stand lower and are smaller.
    pub subscript: bool,
}

impl Label {
    /// Upright words.
    pub fn words(text: impl Into<String>) -> Self {
        Label(vec![LabelPiece { text: text.into(), italic: false, subscript: false }])
    }

    /// A symbol with its index: d4, RL4, theta_1.
    #[must_use]
    pub fn symbol(base: impl Into<String>, index: impl Into<String>) -> Self {
        let index = index.into();
        let mut pieces = vec![LabelPiece { text: base.into(), italic: true, subscript: false }];
        if !index.is_empty() {
            pieces.push(LabelPiece { text: index, italic: false, subscript: true });
        }
        Label(pieces)
    }

    /// What follows it.
    #[must_use]
    pub fn and(mut self, rest: Label) -> Self {
        self.0.extend(rest.0);
        self
    }
}
