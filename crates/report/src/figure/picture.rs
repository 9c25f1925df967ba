//! What both pictures of an arm share: its bodies, arrows, hatching, and the labels of joints, frames and lengths.

use super::drawing::{Drawing, Ink, Label, Segment, Shape, Stroke};
use super::labels::{Sheet, Wish};
use super::options::FigureOptions;
use super::place::{Layout, Symbol};
use super::pose::Arm;
use super::slide::to_segment;
use super::solid::{Form, Paint, Solid, Style, arc, line, paint, polygon, polyline};
use super::view::{Bounds, Paper, View};
use crate::words::Tongue;
use denavit::description::JointKind;
use denavit::geometry::Vector;

/// Letters of names, points.
const LETTERS: f64 = 10.5;
/// Above and below a picture, points.
const ROOM: f64 = 4.0;
/// Letters of lengths, points.
const SMALL: f64 = 9.5;

/// A picture in the making.
pub struct Picture<'a> {
    arm: &'a Arm,
    options: &'a FigureOptions,
    style: Style,
    layout: Layout,
    paper: Paper,
    size: [f64; 2],
    shapes: Vec<Shape>,
    sheet: Sheet,
    wishes: Vec<Wish>,
}

impl<'a> Picture<'a> {
    /// The arm itself, nothing named.
    pub fn new(arm: &'a Arm, options: &'a FigureOptions, view: View, style: Style) -> Self {
        let layout = arm.layout();
        let bounds = options.bounds.unwrap_or_else(|| {
            let mut bounds = layout.bounds(&view);
            extend(&mut bounds, arm, options, &layout, &view, style);
            bounds
        });
        let margin = if options.has_labels() { 24.0 } else { 5.0 };
        let (paper, size) = Paper::fit(view, &bounds, [options.width, options.height], margin);
        let size = if options.bounds.is_some() { [options.width, size[1]] } else { size };
        let sheet = Sheet::new(size[0], size[1]);
        let mut picture =
            Picture { arm, options, style, layout, paper, size, shapes: vec![], sheet, wishes: vec![] };
        picture.bodies();
        picture
    }

    /// Points that the radius of the largest joint has on paper.
    fn unit(&self) -> f64 {
        self.layout.unit * self.paper.scale
    }

    fn bodies(&mut self) {
        let (ground, normal) = self.layout.ground;
        let unit = self.layout.unit;
        let plate = Solid {
            group: 0,
            paint: Paint::Body,
            form: Form::Cylinder { a: ground - normal.scale(0.35 * unit), b: ground, radius: 1.9 * unit },
        };
        let faces = normal.dot(self.paper.view.toward) >= 0.0;
        let plate = match self.style {
            Style::Shaded => paint(&[plate], &self.paper, self.style),
            Style::Outlined => self.hatching(),
        };
        let solids = solids(&self.layout, self.style);
        let arm = paint(&solids, &self.paper, self.style);
        let (first, second) = if faces { (plate, arm) } else { (arm, plate) };
        self.shapes.extend(first);
        self.shapes.extend(second);

        for symbol in &self.layout.symbols {
            let [a, b] = symbol.ends().map(|p| self.paper.at(p));
            let weight = if self.style == Style::Shaded { 0.5 } else { 2.0 };
            self.sheet.block(a, b, symbol.radius * self.paper.scale, weight);
        }
        for bar in &self.layout.bars {
            self.sheet.block(self.paper.at(bar.a), self.paper.at(bar.b), 0.35 * self.unit(), 1.0);
        }
        let (palm, direction, _) = self.layout.gripper;
        let end = palm + direction.scale(1.5 * unit);
        self.sheet.block(self.paper.at(palm), self.paper.at(end), 0.8 * self.unit(), 0.8);
        let across = self.paper.view.right.scale(1.6 * unit);
        let ends = [ground - across, ground + across].map(|p| self.paper.at(p));
        self.sheet.block(ends[0], ends[1], 0.5 * self.unit(), 0.6);
    }

    /// The ground of a line diagram.
    fn hatching(&self) -> Vec<Shape> {
        let (ground, normal) = self.layout.ground;
        let u = self.unit().max(3.0);
        let mut foot = self.paper.at(ground);
        let [nx, ny] = self.paper.along(normal);
        let seen = nx.hypot(ny) / self.paper.scale;
        let mut shapes = vec![];
        let stroke = line(Ink::Line, 1.1);
        // Seen from above the arm stands on a bracket.
        let [nx, ny] = if seen < 0.3 { [0.0, -1.0] } else { [nx, ny].map(|x| x / nx.hypot(ny)) };
        let [tx, ty] = [-ny, nx];
        if seen < 0.3 {
            let top = foot;
            foot = [foot[0], foot[1] + 2.0 * u];
            let corners = [[foot[0] - u, foot[1]], top, [foot[0] + u, foot[1]]];
            shapes.push(Shape::Path { segments: polygon(&corners), fill: Some(Ink::Paper), stroke });
        }
        let at = |t: f64, n: f64| [foot[0] + t * tx + n * nx, foot[1] + t * ty + n * ny];
        let half = 1.9 * u;
        shapes.push(Shape::Path {
            segments: polyline(&[at(-half, 0.0), at(half, 0.0)]),
            fill: None,
            stroke: line(Ink::Line, 1.6),
        });
        for k in 0..8 {
            let t = -half + half * f64::from(k) / 4.0;
            shapes.push(Shape::Path {
                segments: polyline(&[at(t + 0.45 * u, 0.0), at(t, -0.5 * u)]),
                fill: None,
                stroke: line(Ink::Line, 0.8),
            });
        }
        shapes
    }

    /// The axes of joints: all of them dashed with an arrow and the name of the frame's z axis, or those that the
    /// picture is about.
    pub fn axes(&mut self, named: bool) {
        for symbol in self.layout.symbols.clone() {
            let joint = &self.arm.skeleton.joints[symbol.joint];
            let lit = joint.number.is_some_and(|n| self.options.highlight.contains(&n));
            if !lit && !named || symbol.axis.dot(self.paper.view.toward).abs() > 0.97 {
                continue;
            }
            let reach = symbol.half + self.layout.unit * if lit { 4.0 } else { 2.2 };
            let back = symbol.half + self.layout.unit * if lit { 4.0 } else { 0.9 };
            let [from, tip] = [-back, reach].map(|s| self.paper.at(symbol.centre + symbol.axis.scale(s)));
            let [a, b] = symbol.ends().map(|p| self.paper.at(p));
            let (ink, width) = if lit { (Ink::Accent, 1.5) } else { (Ink::Axis(2), 0.8) };
            if lit {
                self.line(from, tip, Stroke { ink, width, dash: Some(5.0) });
            } else {
                // Not over a link on the same line.
                for (s, p, q) in [(-0.9, from, a), (2.2, b, tip)] {
                    let end = symbol.half + self.layout.unit * f64::abs(s);
                    if !self.on_link(symbol.centre + symbol.axis.scale(end * f64::signum(s))) {
                        self.line(p, q, Stroke { ink, width, dash: Some(3.0) });
                    }
                }
            }
            self.head([from, tip], ink, 1.2);
            self.sheet.block(from, tip, 1.0, 0.9);
            if named {
                self.wish(Label::symbol("z", joint.frame.to_string()), ink, vec![tip], [from, tip], 3.0);
            }
        }
    }

    fn on_link(&self, p: Vector<f64>) -> bool {
        let near = 1e-6 * self.arm.chain.size;
        self.layout.bars.iter().any(|b| to_segment(p, b.a, b.b) < near)
    }

    /// How each joint moves, with its variable.
    pub fn variables(&mut self) {
        for symbol in self.layout.symbols.clone() {
            let joint = &self.arm.skeleton.joints[symbol.joint];
            let lit = joint.number.is_some_and(|n| self.options.highlight.contains(&n));
            let (label, ink) = (joint.label.clone(), if lit { Ink::Accent } else { Ink::Line });
            let anchors = match symbol.kind {
                JointKind::Revolute => self.turn(&symbol, ink),
                JointKind::Prismatic => self.slide(&symbol, ink),
            };
            if label.0.is_empty() || anchors.is_empty() {
                continue;
            }
            let centre = self.paper.at(symbol.centre);
            let first = anchors[0];
            self.wish(label, ink, anchors, [centre, first], 3.5);
        }
    }

    /// An arrow round the axis, at the freer end of the symbol.
    fn turn(&mut self, symbol: &Symbol, ink: Ink) -> Vec<[f64; 2]> {
        let unit = self.layout.unit;
        let ends = [1.0, -1.0].map(|side| {
            let place = symbol.centre + symbol.axis.scale(side * (symbol.half + 0.3 * unit));
            (self.crowd(place, symbol), place)
        });
        // The end of the axis' arrow only where the other is worse.
        let place = if ends[0].0 >= ends[1].0 { ends[0].1 } else { ends[1].1 };
        let radius = 1.4 * symbol.radius;
        let across = symbol.axis.cross(self.paper.view.toward);
        let e1 = match across.norm() {
            n if n > 1e-6 => across.scale(1.0 / n),
            _ => self.paper.view.right,
        };
        let e2 = symbol.axis.cross(e1);
        let (centre, p, r) =
            (self.paper.at(place), self.paper.along(e1.scale(radius)), self.paper.along(e2.scale(radius)));
        // The gap of the arrow is behind the axis.
        let front = if e2.dot(self.paper.view.toward) > 0.0 { 0.5 } else { -0.5 } * std::f64::consts::PI;
        let (from, to) = (front - 1.9, front + 1.9);
        let at = |t: f64| [0, 1].map(|k| centre[k] + p[k] * t.cos() + r[k] * t.sin());
        let (start, mut segments) = arc(centre, p, r, from, to);
        segments.insert(0, Segment::Move(start));
        self.shapes.push(Shape::Path { segments, fill: None, stroke: line(ink, 0.9) });
        self.head([at(to - 0.35), at(to)], ink, 0.9);
        for k in 0..8 {
            let t = |k: i32| from + (to - from) * f64::from(k) / 8.0;
            self.sheet.block(at(t(k)), at(t(k + 1)), 0.8, 0.7);
        }
        vec![at(to), at(from), at(front), at(front + 1.2), at(front - 1.2)]
    }

    /// An arrow with two heads beside a slider.
    fn slide(&mut self, symbol: &Symbol, ink: Ink) -> Vec<[f64; 2]> {
        let [ax, ay] = self.paper.along(symbol.axis);
        let length = ax.hypot(ay);
        if length < 0.15 * self.paper.scale {
            return vec![self.paper.at(symbol.centre)];
        }
        let across = [-ay / length, ax / length];
        let off = 1.5 * symbol.radius * self.paper.scale + 2.0;
        let ends = symbol.ends().map(|p| self.paper.at(p));
        let sides =
            [1.0, -1.0].map(|s| ends.map(|e| [e[0] + s * off * across[0], e[1] + s * off * across[1]]));
        let busy = sides.map(|s| self.sheet.busy(s[0], s[1]));
        let [a, b] = if busy[1] < busy[0] { sides[1] } else { sides[0] };
        self.line(a, b, Stroke { ink, width: 0.9, dash: None });
        self.head([a, b], ink, 0.9);
        self.head([b, a], ink, 0.9);
        self.sheet.block(a, b, 1.0, 1.0);
        vec![[(a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0], b, a]
    }

    /// How far the nearest thing on paper is that does not belong to a symbol.
    fn crowd(&self, place: Vector<f64>, own: &Symbol) -> f64 {
        let here = self.paper.at(place);
        let apart = |p: Vector<f64>| {
            let q = self.paper.at(p);
            (q[0] - here[0]).hypot(q[1] - here[1])
        };
        let symbols = self.layout.symbols.iter().filter(|s| s.joint != own.joint).map(|s| apart(s.centre));
        let bars = self
            .layout
            .bars
            .iter()
            .flat_map(|b| [0.1, 0.3, 0.5, 0.7, 0.9].map(|t| b.a + (b.b - b.a).scale(t)));
        let bars = bars.filter(|p| !own.holds(*p, 1.05)).map(apart);
        let ground = apart(self.layout.ground.0);
        symbols.chain(bars).chain([ground]).fold(f64::INFINITY, f64::min)
    }

    /// The frames' axes; what coincides is one arrow with several names.
    pub fn frames(&mut self) {
        let skeleton = &self.arm.skeleton;
        let near = 1e-6 * self.arm.chain.size;
        let length = 2.5 * self.layout.unit;
        let mut arrows: Vec<Arrow> = vec![];
        for (i, frame) in skeleton.frames.iter().enumerate() {
            let mut axes = vec![(0, frame.rotation.x())];
            if self.style == Style::Shaded {
                axes.push((2, frame.rotation.z()));
            }
            if self.options.y_axes {
                axes.insert(1, (1, frame.rotation.y()));
            }
            for (letter, v) in axes {
                let o = frame.translation;
                let same = arrows
                    .iter_mut()
                    .find(|a| a.letter == letter && (a.o - o).norm() < near && (a.v - v).norm() < 1e-6);
                match same {
                    Some(arrow) => arrow.frames.push(i),
                    None => arrows.push(Arrow { o, v, letter, frames: vec![i] }),
                }
            }
        }
        for Arrow { o, v, letter, frames } in arrows {
            let [a, b] = [o, o + v.scale(length)].map(|p| self.paper.at(p));
            if (b[0] - a[0]).hypot(b[1] - a[1]) < 0.12 * length * self.paper.scale {
                continue;
            }
            self.line(a, b, Stroke { ink: Ink::Paper, width: 2.6, dash: None });
            self.line(a, b, Stroke { ink: Ink::Axis(letter), width: 1.2, dash: None });
            self.head([a, b], Ink::Axis(letter), 1.0);
            self.sheet.block(a, b, 1.0, 1.0);
            let numbers: Vec<String> = frames.iter().map(ToString::to_string).collect();
            let name = ["x", "y", "z"][usize::from(letter.min(2))];
            self.wish(Label::symbol(name, numbers.join(",")), Ink::Axis(letter), vec![b], [a, b], 2.0);
        }
    }

    /// The lengths of the table: beside what they measure, or with dimension lines.
    pub fn lengths(&mut self, lines: bool) {
        for length in &self.arm.skeleton.lengths {
            let [a, b] = [length.from, length.to].map(|p| self.paper.at(p));
            let along = (b[0] - a[0]).hypot(b[1] - a[1]);
            let between = |t: f64| [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
            let across =
                if along > 1e-6 { [-(b[1] - a[1]) / along, (b[0] - a[0]) / along] } else { [1.0, 0.0] };
            let mut anchors = vec![between(0.5), between(0.35), between(0.65)];
            let mut direction = across;
            let mut distance = 0.5 * self.unit();
            if lines && along > 9.0 {
                let offsets = [2.3, -2.3, 3.2, -3.2].map(|k| k * self.unit().max(5.0));
                let shifted = |o: f64, p: [f64; 2]| [p[0] + o * across[0], p[1] + o * across[1]];
                let busy = |o: &f64| self.sheet.busy(shifted(*o, a), shifted(*o, b)) + 0.02 * o.abs();
                let offset =
                    offsets.into_iter().min_by(|x, y| busy(x).total_cmp(&busy(y))).unwrap_or(offsets[0]);
                let [c, d] = [shifted(offset, a), shifted(offset, b)];
                let thin = Stroke { ink: Ink::Dimension, width: 0.45, dash: None };
                for (p, o) in [(a, offset), (b, offset)] {
                    self.line(p, shifted(o + 3.0 * o.signum(), p), thin);
                    self.sheet.block(p, shifted(o, p), 0.3, 0.4);
                }
                self.line(c, d, Stroke { width: 0.7, ..thin });
                self.head([c, d], Ink::Dimension, 0.75);
                self.head([d, c], Ink::Dimension, 0.75);
                self.sheet.block(c, d, 0.8, 1.0);
                anchors = anchors.into_iter().map(|p| shifted(offset, p)).collect();
                direction = across.map(|x| x * offset.signum());
                distance = 2.0;
            }
            self.wishes.push(Wish {
                label: length.label.clone(),
                size: SMALL,
                ink: Ink::Dimension,
                anchors,
                direction,
                distance,
            });
        }
    }

    /// The drawing; labels find their places last, when all lines are known.
    pub fn finish(mut self, is_scheme: bool) -> Drawing {
        for wish in &self.wishes {
            self.sheet.place(wish, &mut self.shapes);
        }
        if self.options.bounds.is_none() {
            self.trim();
        }
        let joints = self.arm.chain.kinds.iter().map(|k| match k {
            JointKind::Revolute => 'R',
            JointKind::Prismatic => 'P',
        });
        let joints: String = joints.collect();
        let words = Tongue::default().words();
        let description = words.arm_picture(is_scheme, &self.arm.chain.name, &joints);
        Drawing { width: self.size[0], height: self.size[1], description, shapes: self.shapes }
    }

    /// Takes away empty room above and below.
    fn trim(&mut self) {
        let (mut top, mut bottom) = (f64::INFINITY, f64::NEG_INFINITY);
        for shape in &mut self.shapes {
            let (rise, depth) = match shape {
                Shape::Text { size, .. } => (0.8 * *size, 0.3 * *size),
                Shape::Path { .. } => (0.0, 0.0),
            };
            heights(shape, |y| (top, bottom) = (top.min(*y - rise), bottom.max(*y + depth)));
        }
        let height = bottom - top;
        if height.is_finite() {
            self.shapes.iter_mut().for_each(|shape| heights(shape, |y| *y += ROOM - top));
            self.size[1] = height + 2.0 * ROOM;
        }
    }

    fn wish(
        &mut self,
        label: Label,
        ink: Ink,
        anchors: Vec<[f64; 2]>,
        [from, to]: [[f64; 2]; 2],
        distance: f64,
    ) {
        let v = [to[0] - from[0], to[1] - from[1]];
        let norm = v[0].hypot(v[1]).max(1e-9);
        let direction = v.map(|x| x / norm);
        self.wishes.push(Wish { label, size: LETTERS, ink, anchors, direction, distance });
    }

    fn line(&mut self, a: [f64; 2], b: [f64; 2], stroke: Stroke) {
        self.shapes.push(Shape::Path { segments: polyline(&[a, b]), fill: None, stroke: Some(stroke) });
    }

    /// The head of an arrow.
    fn head(&mut self, [from, tip]: [[f64; 2]; 2], ink: Ink, times: f64) {
        let v = [tip[0] - from[0], tip[1] - from[1]];
        let norm = v[0].hypot(v[1]);
        if norm < 1e-9 {
            return;
        }
        let [x, y] = v.map(|c| c / norm);
        let (long, half) = (5.5 * times, 1.9 * times);
        let base = [tip[0] - long * x, tip[1] - long * y];
        self.sheet.block(base, tip, half, 0.8);
        let corners =
            [tip, [base[0] - half * y, base[1] + half * x], [base[0] + half * y, base[1] - half * x]];
        self.shapes.push(Shape::Path { segments: polygon(&corners), fill: Some(ink), stroke: None });
    }
}

/// An axis of one or several frames: its origin, its direction, which axis it is.
struct Arrow {
    o: Vector<f64>,
    v: Vector<f64>,
    letter: u8,
    frames: Vec<usize>,
}

/// Every y of a shape.
fn heights(shape: &mut Shape, mut change: impl FnMut(&mut f64)) {
    match shape {
        Shape::Text { at, .. } => change(&mut at[1]),
        Shape::Path { segments, .. } => {
            for segment in segments {
                match segment {
                    Segment::Move(p) | Segment::Line(p) => change(&mut p[1]),
                    Segment::Cubic(a, b, p) => [a, b, p].into_iter().for_each(|p| change(&mut p[1])),
                    Segment::Close => {}
                }
            }
        }
    }
}

/// Room for what is drawn around the arm.
fn extend(
    bounds: &mut Bounds,
    arm: &Arm,
    options: &FigureOptions,
    layout: &Layout,
    view: &View,
    style: Style,
) {
    if options.frames && style == Style::Shaded {
        for frame in &arm.skeleton.frames {
            for v in [frame.rotation.x(), frame.rotation.z()] {
                bounds.include(view.flat(frame.translation + v.scale(2.5 * layout.unit)), 0.0);
            }
        }
    }
    for symbol in &layout.symbols {
        let lit = arm.skeleton.joints[symbol.joint].number.is_some_and(|n| options.highlight.contains(&n));
        let reach: f64 = match (lit, style) {
            (true, _) => 4.0,
            (false, Style::Outlined) if options.frames => 2.2,
            _ => 0.4,
        };
        for s in [-if lit { reach } else { reach.min(0.9) }, reach] {
            let along = s * layout.unit + s.signum() * symbol.half;
            bounds.include(view.flat(symbol.centre + symbol.axis.scale(along)), 0.0);
        }
    }
}

/// The arm as bodies.
fn solids(layout: &Layout, style: Style) -> Vec<Solid> {
    let mut solids = vec![];
    for (k, symbol) in layout.symbols.iter().enumerate() {
        let (paint, form) = match symbol.kind {
            JointKind::Revolute => {
                let [a, b] = symbol.ends();
                (Paint::Revolute, Form::Cylinder { a, b, radius: symbol.radius })
            }
            JointKind::Prismatic => {
                let u = perpendicular(symbol.axis);
                let v = symbol.axis.cross(u);
                let r = 0.82 * symbol.radius;
                let half = [u.scale(r), v.scale(r), symbol.axis.scale(symbol.half)];
                (Paint::Prismatic, Form::Block { centre: symbol.centre, half })
            }
        };
        solids.push(Solid { group: 2 * k + 1, paint, form });
    }
    let links = layout.symbols.len().max(1) as f64;
    let thickness = |link: usize| layout.unit * (0.46 - 0.14 * link as f64 / links);
    for (tube, bar) in layout.bars.iter().enumerate() {
        let full = thickness(bar.link);
        let radius = if bar.rod { 0.62 * full } else { full };
        let group = 2 * bar.link;
        let near = [bar.link.checked_sub(1), Some(bar.link)].into_iter().flatten();
        let near: Vec<&Symbol> = near.filter_map(|k| layout.symbols.get(k)).collect();
        let inside = |p: Vector<f64>| near.iter().any(|s| s.holds(p, 0.98));
        let v = bar.b - bar.a;
        let pieces = (v.norm() / (0.5 * full)).ceil().clamp(1.0, 160.0) as usize;
        for i in 0..pieces {
            let at = |k: usize| bar.a + v.scale(k as f64 / pieces as f64);
            let (a, b) = (at(i), at(i + 1));
            if !inside((a + b).scale(0.5)) {
                solids.push(Solid {
                    group,
                    paint: Paint::Body,
                    form: Form::Tube { tube, piece: i, a, b, radius },
                });
            }
        }
        // Elbows, and the round end of a post that leads nowhere.
        let next = layout.bars.get(tube + 1).filter(|n| n.link == bar.link);
        if next.is_some() && !inside(bar.b) {
            let form = Form::Ball { centre: bar.b, radius };
            solids.push(Solid { group, paint: Paint::Body, form });
        }
    }
    solids.extend(hand(layout, style));
    solids
}

/// The gripper: a palm and two fingers.
fn hand(layout: &Layout, style: Style) -> Vec<Solid> {
    let (palm, direction, side) = layout.gripper;
    let u = layout.unit;
    let group = 2 * layout.symbols.len() + 2;
    let paint = Paint::Body;
    let at = |d: f64, s: f64| palm + direction.scale(d * u) + side.scale(s * u);
    if style == Style::Outlined {
        let lines =
            [[at(0.0, -0.7), at(0.0, 0.7)], [at(0.0, -0.7), at(1.3, -0.7)], [at(0.0, 0.7), at(1.3, 0.7)]];
        let tube = |(k, [a, b]): (usize, [Vector<f64>; 2])| {
            let form = Form::Tube { tube: layout.bars.len() + k, piece: 0, a, b, radius: 0.05 * u };
            Solid { group: group - 2, paint, form }
        };
        return lines.into_iter().enumerate().map(tube).collect();
    }
    let across = direction.cross(side);
    let block = |centre: Vector<f64>, d: f64, s: f64, t: f64| {
        let half = [direction.scale(d * u), side.scale(s * u), across.scale(t * u)];
        Solid { group, paint, form: Form::Block { centre, half } }
    };
    vec![
        block(at(0.17, 0.0), 0.17, 0.8, 0.32),
        block(at(0.9, 0.62), 0.56, 0.16, 0.26),
        block(at(0.9, -0.62), 0.56, 0.16, 0.26),
    ]
}

/// A unit vector at a right angle to one, level where that can be.
fn perpendicular(axis: Vector<f64>) -> Vector<f64> {
    let up = if axis[2].abs() < 0.9 { Vector([0.0, 0.0, 1.0]) } else { Vector([1.0, 0.0, 0.0]) };
    let v = up.cross(axis);
    v.scale(1.0 / v.norm().max(f64::MIN_POSITIVE))
}
