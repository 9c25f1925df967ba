//! Bodies in space, painted from the farthest to the nearest.
//!
//! Links are cut into short tubes; two bodies whose pictures touch are painted in order of their depth, all others as
//! it suits, so that what belongs together gets one outline.

use super::drawing::{Ink, Segment, Shape, Stroke};
use super::view::Paper;
use denavit::geometry::Vector;
use std::collections::BTreeMap;

type Point = Vector<f64>;

/// How bodies are painted.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Style {
    /// With light and shadow.
    Shaded,
    /// As lines and outlines.
    Outlined,
}

/// What a body is painted with.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Paint {
    Body,
    Revolute,
    Prismatic,
}

/// The shape of a body.
#[derive(Clone, Copy, Debug)]
pub enum Form {
    /// A piece of a link; pieces of one tube follow each other.
    Tube { tube: usize, piece: usize, a: Point, b: Point, radius: f64 },
    /// Where tubes meet.
    Ball { centre: Point, radius: f64 },
    /// With both ends.
    Cylinder { a: Point, b: Point, radius: f64 },
    /// Half its edges.
    Block { centre: Point, half: [Point; 3] },
}

/// A body.
#[derive(Clone, Copy, Debug)]
pub struct Solid {
    /// What belongs together.
    pub group: usize,
    pub paint: Paint,
    pub form: Form,
}

/// Where the light comes from, in the view: right, up, towards the eye.
const LIGHT: [f64; 3] = [-0.45, 0.65, 0.61];
/// The width of outlines, points.
const OUTLINE: f64 = 0.7;

/// Paints bodies.
pub fn paint(solids: &[Solid], paper: &Paper, style: Style) -> Vec<Shape> {
    let painter = Painter { paper, style };
    let order = order(solids, paper);
    let mut shapes = vec![];
    let mut rest = &order[..];
    while let Some(&first) = rest.first() {
        let same = rest.iter().take_while(|&&i| solids[i].group == solids[first].group).count();
        let (run, behind) = rest.split_at(same);
        painter.run(&merged(run.iter().map(|&i| solids[i])), &mut shapes);
        rest = behind;
    }
    shapes
}

/// Pieces of one tube that follow each other become one, where the farthest of them is painted.
fn merged(run: impl Iterator<Item = Solid>) -> Vec<Solid> {
    let run: Vec<Solid> = run.collect();
    let number = |s: &Solid| match s.form {
        Form::Tube { tube, piece, .. } => Some((tube, piece)),
        _ => None,
    };
    let mut pieces: Vec<(usize, usize)> = run.iter().filter_map(number).collect();
    pieces.sort_unstable();
    let start = |tube: usize, piece: usize| {
        (0..=piece).rev().take_while(|&p| pieces.binary_search(&(tube, p)).is_ok()).last().unwrap_or(piece)
    };
    let mut places: BTreeMap<(usize, usize), usize> = BTreeMap::new();
    let mut out: Vec<Solid> = vec![];
    for solid in run {
        let Form::Tube { tube, piece, a: from, b: to, .. } = solid.form else {
            out.push(solid);
            continue;
        };
        let first = start(tube, piece);
        match places.get(&(tube, first)).and_then(|&at| out.get_mut(at)) {
            Some(Solid { form: Form::Tube { piece: known, a, b, .. }, .. }) => {
                // `known` is the least piece so far, whose beginning is a; the greatest ends at b.
                if piece < *known {
                    (*known, *a) = (piece, from);
                } else if (to - *a).norm() > (*b - *a).norm() {
                    *b = to;
                }
            }
            _ => {
                places.insert((tube, first), out.len());
                out.push(solid);
            }
        }
    }
    out
}

/// The farthest first where two touch on paper; of those that are free, the group goes on.
fn order(solids: &[Solid], paper: &Paper) -> Vec<usize> {
    let depths: Vec<f64> = solids.iter().map(|s| paper.view.depth(s.centre())).collect();
    let boxes: Vec<[f64; 4]> = solids.iter().map(|s| s.extent(paper)).collect();
    let touch = |a: &[f64; 4], b: &[f64; 4]| a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];
    let mut behind = vec![0usize; solids.len()];
    let mut before: Vec<Vec<usize>> = vec![vec![]; solids.len()];
    for i in 0..solids.len() {
        for j in i + 1..solids.len() {
            if touch(&boxes[i], &boxes[j]) {
                let (far, near) = if depths[j] < depths[i] { (j, i) } else { (i, j) };
                before[far].push(near);
                behind[near] += 1;
            }
        }
    }
    let mut free: Vec<usize> = (0..solids.len()).filter(|&i| behind[i] == 0).collect();
    let mut order = vec![];
    let mut group = usize::MAX;
    while !free.is_empty() {
        let rank = |&i: &usize| (solids[i].group != group, depths[i]);
        let less = |a: &usize, b: &usize| {
            let (a, b) = (rank(a), rank(b));
            a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
        };
        let Some(at) = (0..free.len()).min_by(|&a, &b| less(&free[a], &free[b])) else { break };
        let next = free.remove(at);
        group = solids[next].group;
        order.push(next);
        for &n in &before[next] {
            behind[n] -= 1;
            if behind[n] == 0 {
                free.push(n);
            }
        }
        free.sort_unstable();
    }
    order
}

impl Solid {
    fn centre(&self) -> Point {
        match self.form {
            Form::Tube { a, b, .. } | Form::Cylinder { a, b, .. } => (a + b).scale(0.5),
            Form::Ball { centre, .. } | Form::Block { centre, .. } => centre,
        }
    }

    fn extent(&self, paper: &Paper) -> [f64; 4] {
        let mut extent = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
        let mut include = |p: Point, radius: f64| {
            let ([x, y], r) = (paper.at(p), radius * paper.scale);
            extent = [extent[0].min(x - r), extent[1].min(y - r), extent[2].max(x + r), extent[3].max(y + r)];
        };
        match self.form {
            Form::Tube { a, b, radius, .. } | Form::Cylinder { a, b, radius } => {
                include(a, radius);
                include(b, radius);
            }
            Form::Ball { centre, radius } => include(centre, radius),
            Form::Block { centre, half } => corners(centre, half).into_iter().for_each(|p| include(p, 0.0)),
        }
        extent
    }
}

fn corners(c: Point, [u, v, w]: [Point; 3]) -> Vec<Point> {
    let signs = [1.0, -1.0];
    let all = signs.iter().flat_map(|a| signs.iter().flat_map(move |b| signs.map(|c| (*a, *b, c))));
    all.map(|(a, b, d)| c + u.scale(a) + v.scale(b) + w.scale(d)).collect()
}

/// An elliptic arc: centre + p·cos φ + r·sin φ, on paper; begins with its first point.
pub fn arc(centre: [f64; 2], p: [f64; 2], r: [f64; 2], from: f64, to: f64) -> ([f64; 2], Vec<Segment>) {
    let at = |t: f64| [0, 1].map(|k| centre[k] + p[k] * t.cos() + r[k] * t.sin());
    let slope = |t: f64| [0, 1].map(|k| r[k] * t.cos() - p[k] * t.sin());
    let pieces = ((to - from).abs() / 1.6).ceil().max(1.0);
    let step = (to - from) / pieces;
    let reach = 4.0 / 3.0 * (step / 4.0).tan();
    let mut segments = vec![];
    for k in 0..pieces as usize {
        let (s, e) = (from + step * k as f64, from + step * (k + 1) as f64);
        let (start, end) = (at(s), at(e));
        let one = [0, 1].map(|i| start[i] + reach * slope(s)[i]);
        let two = [0, 1].map(|i| end[i] - reach * slope(e)[i]);
        segments.push(Segment::Cubic(one, two, end));
    }
    (at(from), segments)
}

/// A closed outline through points.
pub fn polygon(points: &[[f64; 2]]) -> Vec<Segment> {
    let mut segments: Vec<Segment> = points.iter().map(|&p| Segment::Line(p)).collect();
    if let Some(first) = segments.first_mut() {
        *first = Segment::Move(points[0]);
    }
    segments.push(Segment::Close);
    segments
}

/// A line from point to point.
pub fn polyline(points: &[[f64; 2]]) -> Vec<Segment> {
    let mut segments = polygon(points);
    segments.pop();
    segments
}

/// A thin line.
pub fn line(ink: Ink, width: f64) -> Option<Stroke> {
    Some(Stroke { ink, width, dash: None })
}

/// A round body on paper: its ends, and the half of its circle that is seen, as centre + p·cos φ + r·sin φ.
struct Round {
    a: [f64; 2],
    b: [f64; 2],
    p: [f64; 2],
    r: [f64; 2],
    /// The normals at φ = 0 and π/2.
    normals: [Point; 2],
    /// Whether the end b faces the eye, rather than a.
    b_faces: bool,
}

struct Painter<'a> {
    paper: &'a Paper,
    style: Style,
}

impl Painter<'_> {
    fn run(&self, run: &[Solid], shapes: &mut Vec<Shape>) {
        if self.style == Style::Shaded {
            for solid in run {
                match solid.form {
                    Form::Tube { a, b, radius, .. } => {
                        let round = self.round(a, b, radius);
                        for sign in [1.0, -1.0] {
                            let side = |c: [f64; 2]| [c[0] + sign * round.p[0], c[1] + sign * round.p[1]];
                            shapes.push(Shape::Path {
                                segments: polyline(&[side(round.a), side(round.b)]),
                                fill: None,
                                stroke: line(Ink::Line, 2.0 * OUTLINE),
                            });
                        }
                    }
                    Form::Ball { centre, radius } => {
                        let segments = self.disc(centre, radius);
                        shapes.push(Shape::Path {
                            segments,
                            fill: None,
                            stroke: line(Ink::Line, 2.0 * OUTLINE),
                        });
                    }
                    _ => {}
                }
            }
        }
        for solid in run {
            match solid.form {
                Form::Tube { a, b, radius, .. } if self.style == Style::Shaded => {
                    self.strips(&self.round(a, b, radius), solid.paint, 5, shapes);
                }
                Form::Tube { a, b, .. } => shapes.push(Shape::Path {
                    segments: polyline(&[self.paper.at(a), self.paper.at(b)]),
                    fill: None,
                    stroke: line(Ink::Line, 2.2),
                }),
                Form::Ball { centre, radius } => {
                    let (radius, ink) = match self.style {
                        Style::Shaded => (radius, self.ink(solid.paint, 0.62)),
                        Style::Outlined => (1.1 / self.paper.scale, Ink::Line),
                    };
                    shapes.push(Shape::Path {
                        segments: self.disc(centre, radius),
                        fill: Some(ink),
                        stroke: None,
                    });
                }
                Form::Cylinder { a, b, radius } => self.cylinder(a, b, radius, solid.paint, shapes),
                Form::Block { centre, half } => self.block(centre, half, solid.paint, shapes),
            }
        }
    }

    fn ink(&self, paint: Paint, light: f64) -> Ink {
        let light = (light.clamp(0.0, 1.0) * 100.0).round() / 100.0;
        match (self.style, paint) {
            (Style::Outlined, _) => Ink::Paper,
            (Style::Shaded, Paint::Body) => Ink::Body(light),
            (Style::Shaded, Paint::Revolute) => Ink::Revolute(light),
            (Style::Shaded, Paint::Prismatic) => Ink::Prismatic(light),
        }
    }

    fn light(&self, normal: Point) -> f64 {
        let view = &self.paper.view;
        let seen = [view.right, view.up, view.toward].map(|v| normal.dot(v));
        let cos: f64 = seen.iter().zip(LIGHT).map(|(n, l)| n * l).sum();
        0.32 + 0.68 * cos.max(0.0) - 0.2 * (-cos).max(0.0)
    }

    fn disc(&self, centre: Point, radius: f64) -> Vec<Segment> {
        let r = radius * self.paper.scale;
        closed(arc(self.paper.at(centre), [r, 0.0], [0.0, r], 0.0, std::f64::consts::TAU))
    }

    fn round(&self, a: Point, b: Point, radius: f64) -> Round {
        let toward = self.paper.view.toward;
        let axis = b - a;
        let n = axis.scale(1.0 / axis.norm().max(f64::MIN_POSITIVE));
        // e1 lies in the paper, e2 towards the eye.
        let across = n.cross(toward);
        let e1 = if across.norm() > 1e-6 { across.scale(1.0 / across.norm()) } else { self.paper.view.right };
        let mut e2 = e1.cross(n);
        if e2.dot(toward) < 0.0 {
            e2 = -e2;
        }
        Round {
            a: self.paper.at(a),
            b: self.paper.at(b),
            p: self.paper.along(e1.scale(radius)),
            r: self.paper.along(e2.scale(radius)),
            normals: [e1, e2],
            b_faces: n.dot(toward) >= 0.0,
        }
    }

    /// The side in strips of one light each; a strip reaches to the far edge, the next covers it: no seams.
    fn strips(&self, round: &Round, paint: Paint, count: usize, shapes: &mut Vec<Shape>) {
        let pi = std::f64::consts::PI;
        for k in 0..count {
            let from = pi * k as f64 / count as f64;
            let middle = pi * (k as f64 + 0.5) / count as f64;
            let normal = round.normals[0].scale(middle.cos()) + round.normals[1].scale(middle.sin());
            let (start, mut segments) = arc(round.a, round.p, round.r, from, pi);
            let (corner, back) = arc(round.b, round.p, round.r, pi, from);
            segments.insert(0, Segment::Move(start));
            segments.push(Segment::Line(corner));
            segments.extend(back);
            segments.push(Segment::Close);
            shapes.push(Shape::Path {
                segments,
                fill: Some(self.ink(paint, self.light(normal))),
                stroke: None,
            });
        }
    }

    fn cylinder(&self, a: Point, b: Point, radius: f64, paint: Paint, shapes: &mut Vec<Shape>) {
        let pi = std::f64::consts::PI;
        let round = self.round(a, b, radius);
        let count = if self.style == Style::Shaded { 8 } else { 1 };
        self.strips(&round, paint, count, shapes);
        let width = if self.style == Style::Shaded { 1.2 * OUTLINE } else { 1.1 };
        let (start, mut side) = arc(round.a, round.p, round.r, 0.0, pi);
        let (corner, back) = arc(round.b, round.p, round.r, pi, 0.0);
        side.insert(0, Segment::Move(start));
        side.push(Segment::Line(corner));
        side.extend(back);
        side.push(Segment::Close);
        shapes.push(Shape::Path { segments: side, fill: None, stroke: line(Ink::Line, width) });
        let (cap, normal) = if round.b_faces { (round.b, b - a) } else { (round.a, a - b) };
        let normal = normal.scale(1.0 / normal.norm().max(f64::MIN_POSITIVE));
        let full = arc(cap, round.p, round.r, 0.0, 2.0 * pi);
        shapes.push(Shape::Path {
            segments: closed(full),
            fill: Some(self.ink(paint, 0.1 + self.light(normal))),
            stroke: line(Ink::Line, width),
        });
    }

    fn block(&self, centre: Point, half: [Point; 3], paint: Paint, shapes: &mut Vec<Shape>) {
        let width = if self.style == Style::Shaded { 1.2 * OUTLINE } else { 1.1 };
        for k in 0..3 {
            let (u, v) = (half[(k + 1) % 3], half[(k + 2) % 3]);
            let faces = half[k].dot(self.paper.view.toward);
            if faces.abs() < 1e-9 * half[k].norm() {
                continue;
            }
            let out = half[k].scale(faces.signum());
            let middle = centre + out;
            let points = [u + v, u - v, -u - v, v - u].map(|c| self.paper.at(middle + c));
            let light = self.light(out.scale(1.0 / out.norm().max(f64::MIN_POSITIVE)));
            shapes.push(Shape::Path {
                segments: polygon(&points),
                fill: Some(self.ink(paint, light)),
                stroke: line(Ink::Line, width),
            });
        }
    }
}

/// A whole ellipse.
pub fn closed((start, mut segments): ([f64; 2], Vec<Segment>)) -> Vec<Segment> {
    segments.insert(0, Segment::Move(start));
    segments.push(Segment::Close);
    segments
}
