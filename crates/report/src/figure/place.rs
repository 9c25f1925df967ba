//! What stands where in a picture: a symbol on every axis, links between the symbols, the ground, the gripper.

use super::pose::is_flat;
use super::skeleton::{Chain, Joint, Skeleton};
use super::view::{Bounds, View};
use denavit::description::JointKind;
use denavit::geometry::Vector;

/// The sign of a joint: a cylinder about its axis, or a box along it.
#[derive(Clone, Copy, Debug)]
pub struct Symbol {
    /// Which of the skeleton's joints.
    pub joint: usize,
    /// What it moves.
    pub kind: JointKind,
    /// Its middle, in the base.
    pub centre: Vector<f64>,
    /// Its direction, a unit vector.
    pub axis: Vector<f64>,
    /// Its radius, or half of its side, metres.
    pub radius: f64,
    /// Half of its length.
    pub half: f64,
}

impl Symbol {
    /// The ends of the symbol on its axis.
    pub fn ends(&self) -> [Vector<f64>; 2] {
        [self.centre - self.axis.scale(self.half), self.centre + self.axis.scale(self.half)]
    }

    /// Whether a point is within, the symbol taken some times as large.
    pub fn holds(&self, p: Vector<f64>, times: f64) -> bool {
        let v = p - self.centre;
        let along = v.dot(self.axis);
        along.abs() < times * self.half && (v - self.axis.scale(along)).norm() < times * self.radius
    }
}

/// A straight part of a link.
#[derive(Clone, Copy, Debug)]
pub struct Bar {
    /// From where.
    pub a: Vector<f64>,
    /// To where.
    pub b: Vector<f64>,
    /// Which link, the base being 0.
    pub link: usize,
    /// Whether it slides out of a joint.
    pub rod: bool,
}

/// Where everything stands.
#[derive(Clone, Debug)]
pub struct Layout {
    /// One a joint.
    pub symbols: Vec<Symbol>,
    /// The links, the base's first.
    pub bars: Vec<Bar>,
    /// Where the arm stands, and the direction from the ground to the arm.
    pub ground: (Vector<f64>, Vector<f64>),
    /// The middle of the palm, where the gripper points, and the direction from finger to finger.
    pub gripper: (Vector<f64>, Vector<f64>, Vector<f64>),
    /// The radius of the largest joint.
    pub unit: f64,
}

impl Layout {
    /// What is to be seen of it.
    pub fn bounds(&self, view: &View) -> Bounds {
        let mut bounds = Bounds::empty();
        for bar in &self.bars {
            bounds.include(view.flat(bar.a), 0.3 * self.unit);
            bounds.include(view.flat(bar.b), 0.3 * self.unit);
        }
        for symbol in &self.symbols {
            symbol.ends().into_iter().for_each(|p| bounds.include(view.flat(p), symbol.radius));
        }
        let (ground, normal) = self.ground;
        bounds.include(view.flat(ground), 1.2 * self.unit);
        for axis in [view.right, -view.right] {
            bounds.include(view.flat(ground + axis.scale(2.0 * self.unit)), 0.2 * self.unit);
        }
        if normal.dot(view.toward).abs() > 0.95 {
            // Seen from above a line diagram stands on a bracket.
            bounds.include(view.flat(ground - view.up.scale(2.6 * self.unit)), 0.2 * self.unit);
        }
        let (palm, direction, side) = self.gripper;
        for s in [-1.0, 1.0] {
            let finger = palm + direction.scale(1.7 * self.unit) + side.scale(0.8 * s * self.unit);
            bounds.include(view.flat(finger), 0.2 * self.unit);
        }
        bounds
    }
}

/// The radius and half the length of a joint's symbol.
pub fn symbol_size(chain: &Chain, skeleton: &Skeleton, joint: usize) -> (f64, f64) {
    let count = skeleton.joints.len().max(2) as f64;
    // Joints near the hand are smaller.
    let radius = chain.size * 0.029 * (1.15 - 0.45 * joint as f64 / (count - 1.0));
    match skeleton.joints[joint].kind {
        JointKind::Revolute => (radius, 1.25 * radius),
        JointKind::Prismatic => (0.95 * radius, (0.14 * chain.stroke).max(1.6 * radius)),
    }
}

/// From where to where a symbol may slide at no cost, and where it would best stand.
pub fn free_range(chain: &Chain, skeleton: &Skeleton, k: usize) -> ([f64; 2], f64) {
    let joint = &skeleton.joints[k];
    let d = joint.travel;
    let near = |x: f64| x.abs() < 1e-6 * chain.size;
    let mut range = [d.min(0.0), d.max(0.0)];
    let mut widen = |p: Vector<f64>| {
        let t = (p - joint.foot).dot(joint.axis);
        if near((p - joint.point(t)).norm()) {
            range = [range[0].min(t), range[1].max(t)];
        }
    };
    if let [.., p, _] = skeleton.links[k][..] {
        widen(p);
    } else if let Some(before) = k.checked_sub(1).map(|b| &skeleton.joints[b]) {
        widen(before.foot);
    }
    if let [_, p, ..] = skeleton.links[k + 1][..] {
        widen(p);
    } else if let Some(behind) = skeleton.joints.get(k + 1) {
        widen(behind.end());
    }
    let (_, half) = symbol_size(chain, skeleton, k);
    if k == 0 {
        let side = base_side(joint);
        widen_by(&mut range, side * 4.0 * half);
    }
    if k + 1 == skeleton.joints.len() {
        let side = approach(skeleton).dot(joint.axis);
        if side.abs() > 0.999 {
            widen_by(&mut range, side * 6.0 * half);
        }
    }
    let best = match joint.kind {
        _ if near(d) => 0.0,
        JointKind::Revolute if k == 0 => d.signum() * (d.abs() * 0.5).min(1.6 * half),
        JointKind::Revolute => 0.5 * d,
        JointKind::Prismatic => d.signum() * (0.4 * d.abs()).min(1.2 * half),
    };
    (range, best)
}

fn widen_by(range: &mut [f64; 2], by: f64) {
    range[0] += by.min(0.0);
    range[1] += by.max(0.0);
}

/// On which side of the first axis the ground is: −1 before its foot, 1 behind.
fn base_side(joint: &Joint) -> f64 {
    match joint.axis[2] {
        _ if joint.travel != 0.0 => -joint.travel.signum(),
        z if z < -0.3 => 1.0,
        _ => -1.0,
    }
}

/// Where the gripper points: along the last z axis, or, where the arm is flat, along its last link.
pub fn approach(skeleton: &Skeleton) -> Vector<f64> {
    let z = skeleton.tool.rotation.z();
    let last = skeleton.links.last().and_then(|link| match link[..] {
        [.., a, b] => Some((b - a).scale(1.0 / (b - a).norm())),
        _ => None,
    });
    let Some(joint) = skeleton.joints.last() else { return z };
    let beyond = last.unwrap_or_else(|| joint.axis.scale(joint.travel.signum()));
    let moves_out = last.is_some() || joint.travel.abs() > 0.0;
    if skeleton.joints.len() > 1 && is_flat(skeleton) {
        return if last.is_some() { beyond } else { skeleton.tool.rotation.x() };
    }
    // Where the last two axes are parallel and a link follows, it is as in a flat arm.
    let parallel = |v: Vector<f64>| v.cross(joint.axis).norm() < 1e-6;
    let before = skeleton.joints.len().checked_sub(2).and_then(|k| skeleton.joints.get(k));
    if let Some(along) = last
        && before.is_some_and(|b| parallel(b.axis))
        && parallel(z)
        && along.dot(z).abs() < 1e-6
    {
        return along;
    }
    // A hand that is turned round in the table still points away from the arm.
    if moves_out && z.dot(beyond) < -0.999 { -z } else { z }
}

/// Puts symbols at their places along the axes.
pub fn layout(chain: &Chain, skeleton: &Skeleton, slides: &[f64]) -> Layout {
    let symbol = |(k, (joint, &s)): (usize, (&Joint, &f64))| {
        let (radius, half) = symbol_size(chain, skeleton, k);
        Symbol { joint: k, kind: joint.kind, centre: joint.point(s), axis: joint.axis, radius, half }
    };
    let symbols: Vec<Symbol> = skeleton.joints.iter().zip(slides).enumerate().map(symbol).collect();
    let unit = chain.size * 0.029 * 1.15;
    let ground = ground(chain, skeleton, &symbols, slides);
    let gripper = gripper(skeleton, &symbols, unit);
    let mut bars = vec![];
    for (k, link) in skeleton.links.iter().enumerate() {
        let mut path: Vec<Vector<f64>> = vec![];
        match k.checked_sub(1) {
            None => path.push(ground.0),
            Some(j) => path.push(symbols[j].centre),
        }
        path.extend(link);
        path.push(symbols.get(k).map_or(gripper.0, |s| s.centre));
        let path = straightened(path, 1e-6 * chain.size);
        for (i, ends) in path.windows(2).enumerate() {
            let slider = k.checked_sub(1).map(|j| &symbols[j]).filter(|s| s.kind == JointKind::Prismatic);
            let direction = ends[1] - ends[0];
            let rod = i == 0 && slider.is_some_and(|s| s.axis.cross(direction).norm() < 1e-6 * chain.size);
            bars.push(Bar { a: ends[0], b: ends[1], link: k, rod });
        }
    }
    Layout { symbols, bars, ground, gripper, unit }
}

/// Without repeated points, without points on straight lines, without going somewhere and back.
fn straightened(points: Vec<Vector<f64>>, nothing: f64) -> Vec<Vector<f64>> {
    let mut path: Vec<Vector<f64>> = vec![];
    for p in points {
        loop {
            match path[..] {
                [.., b] if (p - b).norm() < nothing => {
                    path.pop();
                }
                [.., a, b] if (b - a).cross(p - b).norm() < nothing * ((b - a).norm() + (p - b).norm()) => {
                    path.pop();
                }
                _ => break,
            }
        }
        path.push(p);
    }
    path
}

fn ground(
    chain: &Chain,
    skeleton: &Skeleton,
    symbols: &[Symbol],
    slides: &[f64],
) -> (Vector<f64>, Vector<f64>) {
    let up = Vector([0.0, 0.0, 1.0]);
    let (Some(joint), Some(symbol), Some(&s)) = (skeleton.joints.first(), symbols.first(), slides.first())
    else {
        return (Vector::zero(), up);
    };
    let start = skeleton.links[0][0];
    let is_apart = (joint.foot - start).cross(joint.axis).norm() > 1e-6 * chain.size;
    if is_apart {
        // The table begins beside the first axis: a post leads there.
        return (start, up);
    }
    let side = base_side(joint);
    let symbol_end = s + side * 1.35 * symbol.half;
    let start = (start - joint.foot).dot(joint.axis);
    let has_room = joint.travel != 0.0 || start * side > 0.0;
    let t = if has_room { (start * side).max(symbol_end * side) * side } else { symbol_end };
    (joint.point(t), joint.axis.scale(-side))
}

fn gripper(skeleton: &Skeleton, symbols: &[Symbol], unit: f64) -> (Vector<f64>, Vector<f64>, Vector<f64>) {
    let direction = approach(skeleton);
    let tool = skeleton.tool.translation;
    // The fingers open along y, or along x where the hand points along y.
    let y = skeleton.tool.rotation.y();
    let side = if y.dot(direction).abs() < 0.5 { y } else { skeleton.tool.rotation.x() };
    let mut palm = tool;
    if let Some(last) = symbols.last() {
        // Not within the last joint.
        let reach = last.half.max(last.radius);
        let along = (last.centre - tool).dot(direction);
        let beside = (last.centre + direction.scale(-along) - tool).norm();
        if beside < reach + 0.5 * unit {
            let extent = if last.axis.dot(direction).abs() > 0.9 { last.half } else { last.radius };
            palm = tool + direction.scale((along + extent + 0.45 * unit).max(0.0));
        }
    }
    (palm, direction, side)
}
