//! From a frame on one axis to the frame on the next.

use super::space::{Frame, V, cleaned, cross, dot, is_zero, minus, plus, scaled, unit, zero};
use super::{Draft, Line};
use crate::description::JointKind;
use denavit_symbolic::Expr;
use denavit_symbolic::real::Real;

/// Axes whose angle has a smaller sine, and not 0, are nearly parallel: their normal is far away.
const NEARLY_PARALLEL: f64 = 1e-3;

/// Frame 0: z along the first axis, its origin next to that of the base, x along an axis of the base or of the joint's own frame
/// that is perpendicular to it.
pub(super) fn first_frame(lines: &[Line], beside: &Frame) -> Frame {
    let e = |k: usize| [0, 1, 2].map(|i| Real::from(i64::from(i == k)));
    let Some(line) = lines.first() else { return Frame { x: e(0), z: e(2), origin: zero() } };
    let z = line.direction.clone();
    let point = line.point.clone().unwrap_or_else(zero);
    let along = dot(&point, &z);
    let origin = cleaned(minus(&point, &scaled(&z, &along)));
    let choices = [e(0), e(1), e(2), beside.x.clone(), beside.y(), beside.z.clone()];
    let x = choices.into_iter().find(|x| dot(x, &z).is_zero()).unwrap_or_else(|| {
        let far = if z[0].to_f64().abs() < 0.9 { e(0) } else { e(1) };
        let across = minus(&far, &scaled(&z, &dot(&far, &z)));
        unit(&across).map_or(far, |u| u.0)
    });
    Frame { x, z, origin }
}

/// A slide has no place: it is on the next axis where that is parallel, else on the one before, else through the origin before.
pub(super) fn relocated(lines: &[Line]) -> Vec<Line> {
    let mut lines = lines.to_vec();
    for i in (0..lines.len()).rev().filter(|&i| lines[i].kind == JointKind::Prismatic).collect::<Vec<_>>() {
        let beside = [i + 1, i.wrapping_sub(1)].into_iter().find_map(|k| {
            let other = lines.get(k)?;
            let is_parallel = is_zero(&cross(&lines[i].direction, &other.direction));
            other.point.clone().filter(|_| is_parallel)
        });
        lines[i].point = beside;
    }
    lines
}

/// The rows between the axes, their normals pointing any way, and the last frame.
pub(super) fn drafts(lines: &[Line], start: &Frame, tip: &Frame) -> (Vec<Draft>, Frame) {
    let mut frame = start.clone();
    let mut drafts = vec![];
    for k in 0..lines.len() {
        let mut steps = match lines.get(k + 1) {
            Some(next) => {
                let point = next.point.clone().unwrap_or_else(|| frame.origin.clone());
                to_line(&mut frame, &point, &next.direction)
            }
            None => {
                let d = dot(&minus(&tip.origin, &frame.origin), &frame.z);
                frame.origin = plus(&frame.origin, &scaled(&frame.z, &d));
                let zero = Expr::int(0);
                vec![Draft { theta: zero, d: d.settled(), a: zero, alpha: zero, motion: None, is_free: true }]
            }
        };
        steps[0].motion = Some(k);
        drafts.extend(steps);
    }
    (drafts, frame)
}

/// The angle about z from x to u.
fn about(z: &V, x: &V, u: &V) -> Expr {
    dot(&cross(z, x), u).angle(&dot(x, u))
}

/// The rows from a frame to a line, and on to the frame on it.
fn to_line(frame: &mut Frame, point: &V, z2: &V) -> Vec<Draft> {
    let Frame { x, z, origin } = frame.clone();
    let none = Expr::int(0);
    let c = cleaned(cross(&z, z2));
    let to = minus(point, &origin);
    frame.z = z2.clone();
    if is_zero(&c) {
        let across = cleaned(minus(&to, &scaled(&z, &dot(&to, &z))));
        let alpha = if dot(&z, z2).is_negative() { Expr::pi() } else { none };
        let Some((u, a)) = unit(&across) else {
            return vec![Draft { theta: none, d: none, a: none, alpha, motion: None, is_free: true }];
        };
        let theta = about(&z, &x, &u);
        frame.origin = plus(&origin, &across);
        frame.x = u;
        return vec![Draft { theta, d: none, a: a.settled(), alpha, motion: None, is_free: false }];
    }
    let Some((u, sine)) = unit(&c) else {
        return vec![Draft { theta: none, d: none, a: none, alpha: none, motion: None, is_free: true }];
    };
    if sine.to_f64() < NEARLY_PARALLEL {
        return to_nearly_parallel(frame, (&x, &z, &origin), point, z2);
    }
    // O + d·z + a·u is a point of the line.
    let cosine = dot(&z, z2);
    let over = (sine.clone() * sine.clone()).recip().unwrap_or_else(|| Real::from(0));
    let d = (dot(&to, &z) - dot(&to, z2) * cosine.clone()) * over;
    let a = dot(&to, &u);
    frame.origin = cleaned(plus(&origin, &plus(&scaled(&z, &d), &scaled(&u, &a))));
    frame.x = u.clone();
    vec![Draft {
        theta: about(&z, &x, &u),
        d: d.settled(),
        a: a.settled(),
        alpha: sine.angle(&cosine),
        motion: None,
        is_free: false,
    }]
}

/// Two rows to an axis that is nearly parallel: to where it pierces the plane across z through the origin, and there
/// Rz(π/2)·Rx(β), which is Ry(β)·Rz(π/2); the quarter turn is in the next row's θ.
fn to_nearly_parallel(frame: &mut Frame, (x, z, origin): (&V, &V, &V), point: &V, z2: &V) -> Vec<Draft> {
    let none = Expr::int(0);
    let rise = dot(z2, z).recip().unwrap_or_else(|| Real::from(1));
    let along = dot(&minus(origin, point), z) * rise;
    let pierced = plus(point, &scaled(z2, &along));
    let across = cleaned(minus(&pierced, origin));
    let (u, a, theta) = match unit(&across) {
        Some((u, a)) => {
            let theta = about(z, x, &u);
            (u, a, theta)
        }
        None => (x.clone(), Real::from(0), none),
    };
    let y = cross(z, &u);
    let (zx, zy, zz) = (dot(z2, &u), dot(z2, &y), dot(z2, z));
    let cos_beta = (Real::from(1) - zx.clone() * zx.clone()).sqrt().unwrap_or_else(|| Real::from(1));
    let over = cos_beta.recip().unwrap_or_else(|| Real::from(1));
    let (sa, ca) = (-zy * over.clone(), zz * over);
    // Rx(α)·Ry(β) turns y to (0, cos α, sin α).
    frame.x = plus(&scaled(&y, &ca), &scaled(z, &sa));
    frame.origin = pierced;
    let first = Draft { theta, d: none, a: a.settled(), alpha: sa.angle(&ca), motion: None, is_free: false };
    let quarter = Expr::pi() / Expr::int(2);
    let beta = zx.angle(&cos_beta);
    vec![first, Draft { theta: quarter, d: none, a: none, alpha: beta, motion: None, is_free: true }]
}
