//! How a frame is turned: `quat`, `axisangle`, `xyaxes`, `zaxis`, `euler`.
//!
//! The matrix of a quaternion is rational, whatever its length is. One whose digits print turns by multiples of π/12 is those.

use super::super::reader::Reader;
use super::super::tree::turned;
use super::super::xml::{Text, shown};
use super::super::{Decimals, decimals};
use super::defaults::{Resolved, TURNS};
use crate::geometry::{Axis, Rotation, Transform, Vector};
use denavit_symbolic::{Expr, Rational};
use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::ops::Range;

/// What `<compiler>` says of angles and limits.
#[derive(Clone, Copy)]
pub(super) struct Compiler {
    pub degrees: bool,
    /// The axes of Euler angles, and whether each stays where it was.
    pub sequence: [(Axis, bool); 3],
    pub autolimits: bool,
}

impl Default for Compiler {
    fn default() -> Self {
        Compiler {
            degrees: true,
            sequence: [Axis::X, Axis::Y, Axis::Z].map(|a| (a, false)),
            autolimits: true,
        }
    }
}

impl Compiler {
    /// The turn by angles about the axes of the sequence.
    pub fn turned(&self, angles: [Expr; 3]) -> Rotation<Expr> {
        self.sequence.into_iter().zip(angles).fold(Rotation::identity(), |r, ((axis, is_fixed), angle)| {
            let one = Rotation::about(axis, angle);
            if is_fixed { one * r } else { r * one }
        })
    }
}

/// Quaternions that were read as turns: by text, where first, how often, and what is said of them.
pub(super) type Quaternions = BTreeMap<String, (Range<usize>, usize, String)>;

fn o() -> Expr {
    Expr::int(0)
}

/// Reads places and turns of one model.
pub(super) struct Placing<'r> {
    pub reader: &'r mut Reader,
    pub compiler: Compiler,
    pub quaternions: &'r mut Quaternions,
}

impl Placing<'_> {
    /// An angle in the unit of the file.
    pub fn angle(&mut self, x: Rational, word: &Text) -> Expr {
        if self.compiler.degrees {
            return Expr::from(x * Rational::new(1, 180)) * Expr::pi();
        }
        self.reader.angle(x, word)
    }

    /// The frame of a body, a site or a `<frame>`.
    pub fn pose(&mut self, at: &Resolved) -> Transform<Expr> {
        let place = at.get("pos").map_or(Vector::zero(), |p| self.point(&p, "pos"));
        Transform::from_rotation_translation(self.turn(at), place)
    }

    /// Three lengths.
    pub fn point(&mut self, value: &Text, what: &str) -> Vector<Expr> {
        let Some(numbers) = self.reader.numbers(value, what, 3) else { return Vector::zero() };
        let mut lengths = numbers.into_iter().map(|(x, word)| self.reader.length(x, &word));
        Vector([0, 1, 2].map(|_| lengths.next().unwrap_or_else(o)))
    }

    /// How the frame of an element is turned in the one around it.
    pub fn turn(&mut self, at: &Resolved) -> Rotation<Expr> {
        let given: Vec<(&str, Text)> =
            TURNS.into_iter().filter_map(|n| at.own.attribute(n).map(|t| (n, t))).collect();
        if let [(first, _), (second, text), ..] = &given[..] {
            let message = format!("both `{first}` and `{second}` say how it is turned");
            self.reader.out.error(text.span.clone(), message).hint("one of them does");
        }
        let default = || TURNS.into_iter().find_map(|n| at.default(n).map(|t| (n, t)));
        let chosen = given.into_iter().next().or_else(default);
        let read = chosen.and_then(|(name, text)| match name {
            "quat" => self.quaternion(&text),
            "axisangle" => self.axis_angle(&text),
            "xyaxes" => self.axes(&text),
            "zaxis" => Some(to_axis(self.reader.direction(&text, "zaxis")?)),
            _ => self.euler(&text),
        });
        read.unwrap_or_else(Rotation::identity)
    }

    fn euler(&mut self, text: &Text) -> Option<Rotation<Expr>> {
        let angles = self.angles(text)?;
        Some(self.compiler.turned(angles))
    }

    /// Three angles.
    pub fn angles(&mut self, text: &Text) -> Option<[Expr; 3]> {
        let mut numbers = self.reader.numbers(text, "euler", 3)?.into_iter();
        let mut one = || numbers.next().map(|(x, word)| self.angle(x, &word));
        Some([one()?, one()?, one()?])
    }

    /// The frame of what reaches from one point to another: halfway, z towards the first.
    pub fn between(&mut self, text: &Text) -> Option<Transform<Expr>> {
        let mut numbers = self.reader.numbers(text, "fromto", 6)?.into_iter();
        let mut point = || {
            let mut one = || numbers.next().map_or(Expr::int(0), |(x, word)| self.reader.length(x, &word));
            Vector([one(), one(), one()])
        };
        let (from, to) = (point(), point());
        let along = from - to;
        if along.dot(along).is_zero() {
            self.reader.out.error(text.span.clone(), "`fromto` ends where it begins");
            return None;
        }
        let half = Expr::from(Rational::new(1, 2));
        Some(Transform::from_rotation_translation(to_axis(along), (from + to).scale(half)))
    }

    fn axis_angle(&mut self, text: &Text) -> Option<Rotation<Expr>> {
        let mut numbers = self.reader.numbers(text, "axisangle", 4)?;
        let (x, word) = numbers.pop()?;
        let axis = self.reader.direction_of(numbers, text, "axisangle")?;
        let angle = self.angle(x, &word);
        let plain = Axis::ALL.into_iter().find(|&a| Vector::unit(a) == axis);
        Some(plain.map_or_else(|| turned(axis, angle), |a| Rotation::about(a, angle)))
    }

    /// x, and y made perpendicular to it.
    fn axes(&mut self, text: &Text) -> Option<Rotation<Expr>> {
        let mut numbers = self.reader.numbers(text, "xyaxes", 6)?;
        let y = numbers.split_off(3);
        let x = self.reader.direction_of(numbers, text, "xyaxes")?;
        let y = self.reader.direction_of(y, text, "xyaxes")?;
        let y = y - x.scale(x.dot(y) / x.dot(x));
        if y.dot(y).is_zero() {
            self.reader.out.error(text.span.clone(), "x and y of `xyaxes` are parallel");
            return None;
        }
        let [x, y] = [x, y].map(|v| v.scale(Expr::int(1) / v.norm()));
        let z = x.cross(y);
        Some(Rotation::from_rows([0, 1, 2].map(|i| [x[i], y[i], z[i]])))
    }

    fn quaternion(&mut self, text: &Text) -> Option<Rotation<Expr>> {
        let numbers = self.reader.numbers(text, "quat", 4)?;
        self.of_quaternion(text, numbers)
    }

    /// The rotation of the four numbers of a quaternion, which stand in a text.
    pub fn of_quaternion(&mut self, text: &Text, numbers: Vec<(Rational, Text)>) -> Option<Rotation<Expr>> {
        let places = numbers.iter().map(|n| decimals::places(n.1.text)).max().unwrap_or(0);
        let q: Vec<Rational> = numbers.into_iter().map(|n| n.0).collect();
        let [w, x, y, z] = [0, 1, 2, 3].map(|k| q[k].clone());
        let Some(plain) = matrix([&w, &x, &y, &z]) else {
            self.reader.out.error(text.span.clone(), "the quaternion is 0");
            return None;
        };
        if self.reader.decimals == Decimals::AsWritten {
            return Some(plain);
        }
        let Some(meant) = Meant::of([&w, &x, &y, &z].map(Rational::to_f64), places) else {
            return Some(plain);
        };
        let rotation = meant.rotation();
        if rotation != plain && self.quaternions.len() < 1000 {
            let said = format!(
                "the quaternion {} is read as {} ({})",
                shown(text.text),
                meant.name(),
                decimals::distance(meant.off, "")
            );
            self.quaternions.entry(text.text.into()).or_insert((text.span.clone(), 0, said)).1 += 1;
        }
        Some(rotation)
    }
}

/// The matrix of a quaternion of any length but 0.
pub(in crate::description) fn matrix([w, x, y, z]: [&Rational; 4]) -> Option<Rotation<Expr>> {
    let n = w * w + x * x + y * y + z * z;
    let over = n.recip()?;
    let two = Rational::from(2) * over;
    let of = |a: Rational| Expr::from(a * two.clone());
    let rest = |a: &Rational, b: &Rational| Expr::from(Rational::ONE - (a * a + b * b) * two.clone());
    Some(Rotation::from_rows([
        [rest(y, z), of(x * y - w * z), of(x * z + w * y)],
        [of(x * y + w * z), rest(x, z), of(y * z - w * x)],
        [of(x * z - w * y), of(y * z + w * x), rest(x, y)],
    ]))
}

/// A quaternion that prints three turns by multiples of π/12, about an axis, the next one, and the first again.
struct Meant {
    axis: usize,
    twelfths: [i64; 3],
    off: f64,
}

impl Meant {
    /// `q` is w, x, y, z. About z, x, z by a, b, c it is
    /// (cos b/2 cos s, sin b/2 cos d, sin b/2 sin d, cos b/2 sin s), s = (a + c)/2, d = (a − c)/2.
    fn of(q: [f64; 4], places: i64) -> Option<Self> {
        if places < 4 {
            return None; // what has so few digits is itself
        }
        let unit = 10_f64.powi(-places.clamp(4, 400) as i32) * (1.0 + 1e-7);
        let size = q.iter().map(|x| x * x).sum::<f64>().sqrt();
        let scale = if (size - 1.0).abs() <= 4.0 * unit + 1e-14 { 1.0 } else { size };
        let step = PI / 24.0;
        let nearest = |y: f64, x: f64| (y.atan2(x) / step).round() as i64;
        let all = [2, 0, 1].into_iter().filter_map(|axis| {
            let [k, i, j] = [axis, (axis + 1) % 3, (axis + 2) % 3].map(|n| n + 1);
            let tilt = nearest(q[i].hypot(q[j]), q[0].hypot(q[k]));
            let (mut s, mut d) = (nearest(q[k], q[0]), nearest(q[j], q[i]));
            match tilt {
                0 => d = s,
                12 => s = d,
                _ => {}
            }
            if (s + d) % 2 != 0 {
                return None;
            }
            let of = |n: i64| (n as f64 * step).sin_cos();
            let ((sb, cb), (ss, cs), (sd, cd)) = (of(tilt), of(s), of(d));
            let off = [(0, cb * cs), (i, sb * cd), (j, sb * sd), (k, cb * ss)]
                .map(|(n, x)| (x * scale - q[n]).abs())
                .into_iter()
                .fold(0.0, f64::max);
            let is_printed = off <= unit.max(4e-15 * scale);
            // a = s + d and c = s − d in twenty-fourths of π, b twice the tilt
            is_printed.then_some(Meant { axis, twelfths: [(s + d) / 2, tilt, (s - d) / 2], off })
        });
        // The plainest of them.
        all.min_by_key(|m| m.twelfths.iter().filter(|n| **n != 0).count())
    }

    fn axes(&self) -> [Axis; 3] {
        [self.axis, (self.axis + 1) % 3, self.axis].map(|k| Axis::ALL[k])
    }

    fn rotation(&self) -> Rotation<Expr> {
        let turns = self.axes().into_iter().zip(self.twelfths).filter(|t| t.1 != 0);
        turns.fold(Rotation::identity(), |r, (axis, n)| {
            r * Rotation::about(axis, Expr::from(Rational::new(n, 12)) * Expr::pi())
        })
    }

    /// `π/4 about z`
    fn name(&self) -> String {
        let turns = self.axes().into_iter().zip(self.twelfths).filter(|t| t.1 != 0);
        let names: Vec<String> = turns
            .map(|(axis, n)| format!("{} about {}", decimals::name(n), ["x", "y", "z"][axis.index()]))
            .collect();
        if names.is_empty() { "no turn".into() } else { names.join(", ") }
    }
}

/// The shortest turn that takes z to a direction; the half turn about x where that is −z.
pub(super) fn to_axis(v: Vector<Expr>) -> Rotation<Expr> {
    let [x, y, z] = v.scale(Expr::int(1) / v.norm()).0;
    if x.is_zero() && y.is_zero() {
        let is_down = z.eval(|_| None).is_ok_and(|z| z < 0.0);
        return if is_down { Rotation::about(Axis::X, Expr::pi()) } else { Rotation::identity() };
    }
    let one = Expr::int(1);
    let over = one / (one + z);
    Rotation::from_rows([
        [one - x * x * over, -(x * y * over), x],
        [-(x * y * over), one - y * y * over, y],
        [-x, -y, z],
    ])
}
