//! What `plotters` draws, as shapes.
//!
//! It speaks whole numbers and RGB; here a point has [`FINE`] units, and each ink a colour of its own that is nobody else's.

use crate::figure::drawing::{Anchor, Ink, Label, Segment, Shape, Stroke};
use plotters::style::RGBColor;
use plotters_backend::text_anchor::{HPos, VPos};
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind,
};
use std::convert::Infallible;

/// Units of a point.
pub(super) const FINE: u32 = 20;

/// Collects shapes.
pub(super) struct Recorder<'a> {
    /// Where they go.
    pub shapes: &'a mut Vec<Shape>,
    /// Width and height, points.
    pub size: [f64; 2],
}

type Done = Result<(), DrawingErrorKind<Infallible>>;

/// The colour that stands for an ink.
pub(super) fn colour(ink: Ink) -> RGBColor {
    let share = |v: f64| (v.clamp(0.0, 1.0) * 255.0).round() as u8;
    let (role, value) = match ink {
        Ink::Line => (0, 0),
        Ink::Faint => (1, 0),
        Ink::Paper => (2, 0),
        Ink::Body(v) => (3, share(v)),
        Ink::Revolute(v) => (4, share(v)),
        Ink::Prismatic(v) => (5, share(v)),
        Ink::Axis(k) => (6, k),
        Ink::Dimension => (7, 0),
        Ink::Accent => (8, 0),
        Ink::Series(k) => (9, k),
        Ink::Scale(v) => (10, share(v)),
    };
    RGBColor(role, value, 0)
}

/// The ink that a colour stands for.
fn ink(colour: BackendColor) -> Ink {
    let (role, value, _) = colour.rgb;
    let share = f64::from(value) / 255.0;
    match role {
        1 => Ink::Faint,
        2 => Ink::Paper,
        3 => Ink::Body(share),
        4 => Ink::Revolute(share),
        5 => Ink::Prismatic(share),
        6 => Ink::Axis(value),
        7 => Ink::Dimension,
        8 => Ink::Accent,
        9 => Ink::Series(value),
        10 => Ink::Scale(share),
        _ => Ink::Line,
    }
}

/// A place in points.
pub(super) fn points((x, y): BackendCoord) -> [f64; 2] {
    [x, y].map(|c| f64::from(c) / f64::from(FINE))
}

fn stroke<S: BackendStyle>(style: &S) -> Stroke {
    Stroke {
        ink: ink(style.color()),
        width: f64::from(style.stroke_width().max(1)) / f64::from(FINE),
        dash: None,
    }
}

impl Recorder<'_> {
    fn path<S: BackendStyle>(
        &mut self,
        places: impl IntoIterator<Item = BackendCoord>,
        style: &S,
        is_filled: bool,
        is_closed: bool,
    ) {
        if style.color().alpha == 0.0 {
            return;
        }
        let start = |(i, p)| if i == 0 { Segment::Move(points(p)) } else { Segment::Line(points(p)) };
        let mut segments: Vec<Segment> = places.into_iter().enumerate().map(start).collect();
        if segments.len() < 2 {
            return;
        }
        if is_closed || is_filled {
            segments.push(Segment::Close);
        }
        let fill = is_filled.then(|| ink(style.color()));
        let stroke = (!is_filled).then(|| stroke(style));
        self.shapes.push(Shape::Path { segments, fill, stroke });
    }
}

impl DrawingBackend for Recorder<'_> {
    type ErrorType = Infallible;

    fn get_size(&self) -> (u32, u32) {
        let fine = |length: f64| (length * f64::from(FINE)).round() as u32;
        (fine(self.size[0]), fine(self.size[1]))
    }

    fn ensure_prepared(&mut self) -> Done {
        Ok(())
    }

    fn present(&mut self) -> Done {
        Ok(())
    }

    fn draw_pixel(&mut self, (x, y): BackendCoord, color: BackendColor) -> Done {
        self.path([(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)], &color, true, true);
        Ok(())
    }

    fn draw_line<S: BackendStyle>(&mut self, from: BackendCoord, to: BackendCoord, style: &S) -> Done {
        self.path([from, to], style, false, false);
        Ok(())
    }

    fn draw_rect<S: BackendStyle>(
        &mut self,
        upper_left: BackendCoord,
        bottom_right: BackendCoord,
        style: &S,
        fill: bool,
    ) -> Done {
        let ((l, t), (r, b)) = (upper_left, bottom_right);
        self.path([(l, t), (r, t), (r, b), (l, b)], style, fill, true);
        Ok(())
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        path: I,
        style: &S,
    ) -> Done {
        self.path(path, style, false, false);
        Ok(())
    }

    fn draw_circle<S: BackendStyle>(
        &mut self,
        center: BackendCoord,
        radius: u32,
        style: &S,
        fill: bool,
    ) -> Done {
        if style.color().alpha != 0.0 {
            let segments = circle(points(center), f64::from(radius) / f64::from(FINE));
            let filled = fill.then(|| ink(style.color()));
            let stroke = (!fill).then(|| stroke(style));
            self.shapes.push(Shape::Path { segments, fill: filled, stroke });
        }
        Ok(())
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        vert: I,
        style: &S,
    ) -> Done {
        self.path(vert, style, true, true);
        Ok(())
    }

    /// Text stands upright whatever is asked; places are given for the font's box and kept for its base line.
    fn draw_text<S: BackendTextStyle>(&mut self, text: &str, style: &S, pos: BackendCoord) -> Done {
        if style.color().alpha == 0.0 || text.is_empty() {
            return Ok(());
        }
        let size = style.size() / f64::from(FINE);
        let [x, y] = points(pos);
        let anchor = style.anchor();
        let down = match anchor.v_pos {
            VPos::Top => 0.8,
            VPos::Center => 0.34,
            VPos::Bottom => -0.2,
        };
        self.shapes.push(Shape::Text {
            at: [x, y + down * size],
            anchor: match anchor.h_pos {
                HPos::Left => Anchor::Start,
                HPos::Center => Anchor::Middle,
                HPos::Right => Anchor::End,
            },
            size,
            ink: ink(style.color()),
            label: Label::words(text),
        });
        Ok(())
    }

    /// Letters are taken to be as wide as digits.
    fn estimate_text_size<S: BackendTextStyle>(
        &self,
        text: &str,
        style: &S,
    ) -> Result<(u32, u32), DrawingErrorKind<Infallible>> {
        let wide = (0.55 * style.size() * text.chars().count() as f64).ceil() as u32;
        Ok((wide, style.size().ceil() as u32))
    }
}

/// A circle by four curves (points).
pub(super) fn circle([x, y]: [f64; 2], r: f64) -> Vec<Segment> {
    const ROUND: f64 = 0.552_284_75;
    let k = ROUND * r;
    vec![
        Segment::Move([x + r, y]),
        Segment::Cubic([x + r, y + k], [x + k, y + r], [x, y + r]),
        Segment::Cubic([x - k, y + r], [x - r, y + k], [x - r, y]),
        Segment::Cubic([x - r, y - k], [x - k, y - r], [x, y - r]),
        Segment::Cubic([x + k, y - r], [x + r, y - k], [x + r, y]),
        Segment::Close,
    ]
}
