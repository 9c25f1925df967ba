//! The special arm beside a nearly special one: axes that are almost parallel, perpendicular or meeting become exactly
//! so, on request, and what that costs is measured.
//!
//! The axes are taken as lines, not as rows of a table: where two axes are almost parallel their common normal may lie
//! hundreds of metres away, and a calibrated table has such numbers.

use crate::description::{Convention, Description, JointKind, Row};
use crate::geometry::orientation::{OrientationSet, extract};
use crate::geometry::{Rotation, Transform, Vector};
use crate::mechanism::{MissingValue, Reference, Robot, Walk};
use crate::random::Random;
use crate::space::JointSpace;
use denavit_symbolic::{Expr, Rational};
use std::f64::consts::PI;

/// A special arm, and how it differs from the one it stands for.
#[derive(Clone, Debug)]
pub struct Ideal {
    /// The special arm, a table in the standard convention with the joints of the original.
    pub description: Description,
    /// What was made special.
    pub snaps: Vec<Snap>,
    /// By how much the hand's orientation differs at most over a few hundred configurations, radians.
    pub rotation_error: f64,
    /// By how much its position does, metres.
    pub position_error: f64,
}

/// A number that was moved to a special value.
#[derive(Clone, PartialEq, Debug)]
pub struct Snap {
    /// The axes between which it stands, from 1.
    pub axes: (usize, usize),
    /// What it is.
    pub what: Measured,
    /// Its value, radians or metres.
    pub from: f64,
    /// The value taken instead.
    pub to: f64,
}

/// What is measured between two consecutive axes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Measured {
    /// The angle between them (α).
    Angle,
    /// The length of their common normal (a).
    Normal,
    /// The distance along the first axis from the common normal before to the one behind (d).
    Offset,
    /// The angle about the first axis between the two common normals (θ), where the joint slides.
    Turn,
}

impl Measured {
    /// True for radians.
    pub fn is_angle(self) -> bool {
        matches!(self, Measured::Angle | Measured::Turn)
    }
}

/// Special angles are multiples of this.
const STEP: f64 = PI / 12.0;
/// Below this an angle (radians) or a length (by the arm's size) is special but for rounding.
const ROUNDING: f64 = 1e-12;
/// An angle of rest this near to a special one is taken as that: it makes no structure, but was meant.
const MEANT: f64 = 1e-5;
/// Configurations that are compared.
const SAMPLES: usize = 256;

/// The arm with everything special that is so up to `tolerance`: angles in radians, lengths by the arm's size.
///
/// # Errors
/// If a parameter has no value.
pub fn idealised(description: &Description, tolerance: f64) -> Result<Ideal, MissingValue> {
    let robot = Robot::numeric(description)?;
    let symbolic = Robot::symbolic(description);
    let axes = axes_at_rest(&robot);
    let mut snaps = vec![];
    let mut rows: Vec<Row> = vec![];
    let moving: Vec<usize> = (0..robot.links.len()).filter(|&k| robot.links[k].moves()).collect();
    let size = size(&axes.frames);
    let mut here = axes.frames[0];
    for (k, &link) in moving.iter().enumerate() {
        let turns = robot.links[link].turns();
        let (place, there) = match axes.frames.get(k + 1) {
            Some(next) => Place::of(&(here.inverse() * *next), tolerance),
            None => (Place::default(), Transform::identity()),
        };
        let mut snap = |what, from: f64, to: f64| {
            if (from - to).abs() > ROUNDING {
                snaps.push(Snap { axes: (k + 1, k + 2), what, from, to });
            }
            to
        };
        let special = |x: f64, within: f64| {
            let to = (x / STEP).round() * STEP;
            if (x - to).abs() <= within { to } else { x }
        };
        let zero = |x: f64| if x.abs() <= tolerance * size { 0.0 } else { x };
        let alpha = snap(Measured::Angle, place.alpha, special(place.alpha, tolerance));
        let a = snap(Measured::Normal, place.a, zero(place.a));
        let d = snap(Measured::Offset, place.d, zero(place.d));
        let theta = if turns {
            special(place.theta, MEANT)
        } else {
            snap(Measured::Turn, place.theta, special(place.theta, tolerance))
        };
        here = here * there;
        let (row, formulas) = (&description.rows[link], &symbolic.links[link]);
        let variables = description.variables();
        let linear = |terms: &[(usize, Expr)]| {
            terms.iter().map(|&(j, f)| f * Expr::from(variables[j].symbol)).reduce(|x, y| x + y)
        };
        let with = |rest: Expr, moved: Option<Expr>| match moved {
            Some(x) if rest.is_zero() => x,
            Some(x) => x + rest,
            None => rest,
        };
        rows.push(Row {
            theta: with(angle(theta), linear(&formulas.theta.terms)),
            d: with(number(d), linear(&formulas.d.terms)),
            a: number(a),
            alpha: angle(alpha),
            gamma: Expr::int(0),
            b: Expr::int(0),
            ..row.clone()
        });
    }
    let mut ideal = description.clone();
    ideal.convention = Convention::Standard;
    ideal.rows = rows;
    ideal.base = transform(&axes.frames[0]);
    ideal.tool = transform(&(here.inverse() * axes.tool));
    let (rotation_error, position_error) = difference(&robot, &Robot::numeric(&ideal)?, description);
    Ok(Ideal { description: ideal, snaps, rotation_error, position_error })
}

/// The arm with all joint variables 0.
struct AtRest {
    /// A frame on each axis, z along it.
    frames: Vec<Transform<f64>>,
    tool: Transform<f64>,
}

fn axes_at_rest(robot: &Robot<f64>) -> AtRest {
    let walk = Walk::seen_from(robot, &vec![0.0; robot.joints], Reference::Base);
    let place = |k: usize| walk.place(Reference::Frame(k)) * robot.links[k].before;
    let frames = (0..robot.links.len()).filter(|&k| robot.links[k].moves()).map(place).collect();
    AtRest { frames, tool: walk.place(Reference::Tool) }
}

/// The sum of the distances between consecutive axes, each from the point where the one before was reached.
fn size(frames: &[Transform<f64>]) -> f64 {
    let mut at = frames.first().map_or(Vector([0.0; 3]), |f| f.translation);
    let mut sum = 0.0;
    for f in &frames[1.min(frames.len())..] {
        let z = f.rotation.z();
        let foot = f.translation + z.scale(z.dot(at - f.translation));
        sum += (foot - at).norm();
        at = foot;
    }
    if sum > 0.0 { sum } else { 1.0 }
}

/// Where the next axis lies: Rz(θ)·Tz(d)·Tx(a)·Rx(α) from a frame on one axis to a frame on the next.
#[derive(Clone, Copy, Default, Debug)]
struct Place {
    theta: f64,
    d: f64,
    a: f64,
    alpha: f64,
}

impl Place {
    /// Of an axis along z of a frame; and a frame on that axis with x along the common normal. Where the axes are parallel
    /// up to `tolerance`, the normal starts at the origin.
    fn of(next: &Transform<f64>, tolerance: f64) -> (Self, Transform<f64>) {
        let (w, p) = (next.rotation.z(), next.translation);
        let sine = w[0].hypot(w[1]);
        if sine <= tolerance.max(ROUNDING) {
            let foot = p + w.scale(-p[2] / w[2]);
            let a = foot[0].hypot(foot[1]);
            let x = if a > ROUNDING { foot.scale(1.0 / a) } else { Vector([1.0, 0.0, 0.0]) };
            let across = x - w.scale(w.dot(x));
            let x_next = across.scale(1.0 / across.norm());
            let place = Place { theta: x[1].atan2(x[0]), d: 0.0, a, alpha: sine.atan2(w[2]) };
            return (place, Transform::from_rotation_translation(frame(x_next, w), foot));
        }
        // x along z × w, or against it, whichever turns less.
        let mut x = [-w[1] / sine, w[0] / sine];
        let mut alpha = sine.atan2(w[2]);
        if x[0] < -1e-9 || x[0] < 1e-9 && x[1] < 0.0 {
            (x, alpha) = ([-x[0], -x[1]], -alpha);
        }
        let y = [-x[1], x[0]];
        let t = -(p[0] * y[0] + p[1] * y[1]) / (w[0] * y[0] + w[1] * y[1]);
        let place =
            Place { theta: x[1].atan2(x[0]), d: p[2] + t * w[2], a: p[0] * x[0] + p[1] * x[1], alpha };
        let x = Vector([x[0], x[1], 0.0]);
        (place, Transform::from_rotation_translation(frame(x, w), p + w.scale(t)))
    }
}

/// The rotation with these columns x and z.
fn frame(x: Vector<f64>, z: Vector<f64>) -> Rotation<f64> {
    let y = z.cross(x);
    Rotation::from_rows(std::array::from_fn(|i| [x[i], y[i], z[i]]))
}

/// A number as an exact formula, to twelve decimals.
fn number(x: f64) -> Expr {
    Rational::from_decimal(&format!("{x:.12}")).map_or(Expr::int(0), Expr::from)
}

/// An angle as an exact formula, a multiple of π/12 where it is one.
fn angle(x: f64) -> Expr {
    let steps = (x / STEP).round();
    if (x - steps * STEP).abs() <= 1e-9 {
        Expr::from(Rational::new(steps as i64, 12)) * Expr::pi()
    } else {
        number(x)
    }
}

/// A constant transform as an exact one.
fn transform(x: &Transform<f64>) -> Transform<Expr> {
    let e = extract(&x.rotation, OrientationSet::Rpy).values;
    let turned =
        Rotation::about_z(angle(e[2])) * Rotation::about_y(angle(e[1])) * Rotation::about_x(angle(e[0]));
    Transform::from_rotation_translation(turned, x.translation.map(number))
}

/// The largest differences of the two arms' hands, radians and metres.
fn difference(a: &Robot<f64>, b: &Robot<f64>, description: &Description) -> (f64, f64) {
    let space = JointSpace::new(description, a);
    let kinds: Vec<JointKind> = description.variables().iter().map(|v| v.kind).collect();
    let mut random = Random(1);
    let mut largest = (0.0_f64, 0.0_f64);
    for _ in 0..SAMPLES {
        let q: Vec<f64> = space
            .limits
            .iter()
            .zip(&kinds)
            .map(|(limits, kind)| {
                let [low, high] = limits.unwrap_or(match kind {
                    JointKind::Revolute => [-PI, PI],
                    JointKind::Prismatic => [0.0, 1.0],
                });
                low + random.unit() * (high - low)
            })
            .collect();
        let gap = a.pose(&q).inverse() * b.pose(&q);
        let m = gap.rotation.rows();
        let sine = [m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]];
        let turned = (0.5 * Vector(sine).norm()).atan2(0.5 * (m[0][0] + m[1][1] + m[2][2] - 1.0));
        largest = (largest.0.max(turned), largest.1.max(gap.translation.norm()));
    }
    largest
}
