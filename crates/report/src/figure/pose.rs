//! An arm in a pose: where none is given, one that shows it well.

use super::place::{Layout, approach, layout};
use super::skeleton::{Chain, Joint, Skeleton};
use super::slide::{slides, to_segment};
use super::view::{Bounds, View};
use denavit::description::{Description, JointKind};
use denavit::geometry::Vector;
use denavit::robot::MissingValue;
use std::f64::consts::PI;
use std::rc::Rc;

/// A robot in a pose, ready to be drawn.
#[derive(Clone, Debug)]
pub struct Arm {
    pub(super) chain: Rc<Chain>,
    pub(super) skeleton: Skeleton,
    pub(super) slides: Rc<Vec<f64>>,
    q: Vec<f64>,
    view: View,
}

impl Arm {
    /// A robot in a pose that shows it well; lengths without values get some that differ.
    ///
    /// # Errors
    /// If a parameter's value depends on another that has none.
    pub fn new(description: &Description) -> Result<Self, MissingValue> {
        let chain = Chain::new(description)?;
        let q = pleasant(&chain);
        let skeleton = chain.skeleton(&q);
        let turned = |by: f64| -> Vec<f64> {
            let turn = |(x, k): (&f64, &JointKind)| if *k == JointKind::Revolute { x + by } else { *x };
            q.iter().zip(&chain.kinds).map(turn).collect()
        };
        let nearby = [skeleton.clone(), chain.skeleton(&turned(0.7)), chain.skeleton(&turned(-0.6))];
        let slides = slides(&chain, &nearby);
        let view = super::view::choose(&chain, &skeleton, &layout(&chain, &skeleton, &slides));
        Ok(Arm { chain: Rc::new(chain), skeleton, slides: Rc::new(slides), q, view })
    }

    /// The same robot elsewhere: symbols stand at the same places of their axes, the view is the same.
    ///
    /// # Panics
    /// If `q` does not have one entry per joint.
    #[must_use]
    pub fn at(&self, q: &[f64]) -> Self {
        assert_eq!(q.len(), self.q.len(), "one entry per joint");
        let skeleton = self.chain.skeleton(q);
        Arm {
            chain: self.chain.clone(),
            slides: self.slides.clone(),
            skeleton,
            q: q.to_vec(),
            view: self.view,
        }
    }

    /// The values of the joint variables, radians and metres.
    pub fn pose(&self) -> &[f64] {
        &self.q
    }

    /// What is drawn, as points in the base.
    pub fn skeleton(&self) -> &Skeleton {
        &self.skeleton
    }

    /// The view that shows the arm's first pose best.
    pub fn view(&self) -> View {
        self.view
    }

    /// What is to be seen of the arm without labels.
    pub fn bounds(&self, view: &View) -> Bounds {
        self.layout().bounds(view)
    }

    /// Whether all axes are parallel and nothing slides.
    pub(super) fn is_flat(&self) -> bool {
        is_flat(&self.skeleton)
    }

    /// What stands where: symbols, links, ground and gripper, in the base.
    pub fn layout(&self) -> Layout {
        layout(&self.chain, &self.skeleton, &self.slides)
    }
}

/// Whether all axes are parallel and nothing slides.
pub(super) fn is_flat(skeleton: &Skeleton) -> bool {
    let Some(first) = skeleton.joints.first() else { return false };
    let parallel = |j: &Joint| j.kind == JointKind::Revolute && j.axis.cross(first.axis).norm() < 1e-6;
    skeleton.joints.iter().all(parallel)
}

/// Poses that are tried, times the pairs of links that are held against each other in each: more than twenty joints need.
const WORK: usize = 8_000_000;

/// A pose within the limits in which links do not cover each other: the best of some starts, each joint moved in turn.
fn pleasant(chain: &Chain) -> Vec<f64> {
    let count = chain.kinds.len();
    let choices: Vec<Vec<f64>> = (0..count).map(|j| choices(chain, j)).collect();
    let nearest = |j: usize, x: f64| {
        let by = |c: &f64| (c - x).abs();
        choices[j].iter().copied().min_by(|a, b| by(a).total_cmp(&by(b))).unwrap_or(x)
    };
    let zero: Vec<f64> = (0..count)
        .map(|j| if chain.kinds[j] == JointKind::Prismatic { choices[j][0] } else { nearest(j, 0.0) })
        .collect();
    if is_flat(&chain.skeleton(&zero)) {
        // An open polygon, as it is always drawn; axes may point up or down.
        let skeleton = chain.skeleton(&zero);
        let bends = [PI / 6.0, PI / 4.0, PI / 6.0].into_iter().cycle();
        let first = skeleton.joints.first().map_or(Vector::zero(), |j| j.axis);
        let bend = |(j, bend): (usize, f64)| {
            let joint = skeleton.joints.iter().find(|k| k.number == Some(j));
            zero[j] + bend * joint.map_or(1.0, |k| k.axis.dot(first).signum())
        };
        let q: Vec<f64> = (0..count).zip(bends).map(bend).collect();
        let inside = |(x, l): (&f64, &Option<[f64; 2]>)| l.is_none_or(|[a, b]| (a..=b).contains(x));
        if q.iter().zip(&chain.limits).all(inside) {
            return q;
        }
    }
    let mut starts = vec![zero.clone()];
    for pose in chain.poses.iter().filter(|p| p.iter().any(|x| *x != 0.0)).take(2) {
        starts.push(
            (0..count)
                .map(
                    |j| {
                        if chain.kinds[j] == JointKind::Prismatic {
                            choices[j][0]
                        } else {
                            nearest(j, pose[j])
                        }
                    },
                )
                .collect(),
        );
    }
    for step in [1.0, -1.0] {
        starts.push((0..count).map(|j| nearest(j, zero[j] + step * PI / 3.0 * (j % 3) as f64)).collect());
    }
    // What an arm with very many joints leaves untried is left as it stands.
    let mut left = WORK / (count * count).max(1);
    let mut best = (f64::NEG_INFINITY, zero.clone());
    for mut q in starts {
        let mut value = beauty(chain, &q, &zero);
        for _sweep in 0..3 {
            let before = value;
            for j in 0..count {
                for &x in choices[j].iter().take(left) {
                    left -= 1;
                    let old = std::mem::replace(&mut q[j], x);
                    let new = beauty(chain, &q, &zero);
                    if new > value + 1e-9 { value = new } else { q[j] = old }
                }
            }
            if value <= before + 1e-9 {
                break;
            }
        }
        if value > best.0 + 1e-6 {
            best = (value, q);
        }
    }
    best.1
}

/// Values of a joint that are tried, within its limits.
fn choices(chain: &Chain, j: usize) -> Vec<f64> {
    let limits = chain.limits[j];
    let inside = |x: &f64| limits.is_none_or(|[low, high]| (low..=high).contains(x));
    let (all, middle): (Vec<f64>, f64) = match chain.kinds[j] {
        JointKind::Revolute => (
            (-12..=12).map(|k| f64::from(k) * PI / 12.0).collect(),
            limits.map_or(0.0, |[a, b]| (a + b) / 2.0),
        ),
        JointKind::Prismatic => {
            // What counts is the way along the axis, offset included.
            let of = |l: &denavit::robot::Link<f64>| {
                l.d.terms.iter().find(|t| t.0 == j).map(|t| (l.d.offset, t.1))
            };
            let (offset, factor) = chain.robot.links.iter().find_map(of).unwrap_or((0.0, 1.0));
            let way = |t: f64| (t * chain.stroke - offset) / factor;
            let inner = limits.map_or(way(0.8), |[a, b]| a + 0.6 * (b - a));
            // Beyond its offset rather than behind it.
            let least = if offset * factor.signum() > 0.0 { offset.abs() / chain.stroke } else { 0.0 };
            let shares = shares_axis(chain, j);
            let ways = if shares { [1.35, 1.5, 1.2] } else { [0.8, 1.0, 0.6] };
            (ways.map(|t| way((t + least).min(1.6).max(t))).to_vec(), inner)
        }
    };
    let within: Vec<f64> = all.into_iter().filter(inside).collect();
    if within.is_empty() { vec![middle] } else { within }
}

/// Whether another joint's axis is the same line as that of one that slides: both symbols need room.
fn shares_axis(chain: &Chain, j: usize) -> bool {
    let skeleton = chain.skeleton(&vec![0.0; chain.kinds.len()]);
    let at = skeleton.joints.iter().position(|k| k.number == Some(j));
    let Some((at, own)) = at.and_then(|at| Some((at, skeleton.joints.get(at)?))) else { return false };
    let near = 1e-6 * chain.size;
    let same = |k: usize| {
        skeleton.joints.get(k).is_some_and(|other| {
            other.axis.cross(own.axis).norm() < 1e-6 && (other.foot - own.foot).cross(own.axis).norm() < near
        })
    };
    same(at + 1) || at.checked_sub(1).is_some_and(same)
}

/// How well a pose shows an arm.
fn beauty(chain: &Chain, q: &[f64], zero: &[f64]) -> f64 {
    let skeleton = chain.skeleton(q);
    let size = chain.size;
    let hand = approach(&skeleton);
    let mut points: Vec<Vector<f64>> = vec![];
    for p in skeleton.links.iter().flatten() {
        if points.last().is_none_or(|l| (*p - *l).norm() > 1e-6 * size) {
            points.push(*p);
        }
    }
    let Some((&base, &tip)) = points.first().zip(points.last()) else { return 0.0 };
    if let Some(joint) = skeleton.joints.first().filter(|j| j.travel == 0.0) {
        // The post that the picture puts under the arm.
        let side = if joint.axis[2] < -0.3 { 0.1 } else { -0.1 };
        points.insert(0, base + joint.axis.scale(side * size));
    }
    points.push(tip + hand.scale(0.12 * size));
    let mut value = 0.0;

    // No two links in one place, none folded onto the one before.
    let segments: Vec<[Vector<f64>; 2]> = points.windows(2).map(|w| [w[0], w[1]]).collect();
    for (i, a) in segments.iter().enumerate() {
        let v = a[1] - a[0];
        for (k, b) in segments.iter().enumerate().skip(i + 1) {
            if k == i + 1 {
                let w = b[1] - b[0];
                let cos = v.dot(w) / (v.norm() * w.norm());
                value -= 0.8 * (-cos - 0.3).max(0.0) + 0.25 * (cos - 0.93).max(0.0) / 0.07;
            } else {
                let [mid, end] = [b[0] + (b[1] - b[0]).scale(0.5), b[1]];
                let near = to_segment(end, a[0], a[1]).min(to_segment(mid, a[0], a[1]));
                value -= 1.2 * (1.0 - near / (0.14 * size)).max(0.0);
            }
        }
    }

    // Above the floor, where there is one below.
    let upright = skeleton.joints.first().is_some_and(|j| j.axis[2].abs() > 0.7);
    let flat = points.iter().all(|p| (p[2] - base[2]).abs() < 1e-6 * size);
    if upright && !flat {
        let lowest = points[1..].iter().map(|p| p[2] - base[2]).fold(f64::INFINITY, f64::min);
        let hangs = chain.kinds.first() == Some(&JointKind::Prismatic);
        value -= if hangs { 0.3 } else { 6.0 } * (0.02 - lowest / size).max(0.0);
        let height: f64 = points.iter().map(|p| p[2] - base[2]).sum::<f64>() / points.len() as f64;
        value += (height / size).min(0.5);
        // An arch rather than a valley: what has begun to fall does not rise again.
        for pair in segments.windows(2) {
            let [a, b] = [pair[0], pair[1]].map(|s| s[1] - s[0]);
            let long = (10.0 * a.norm().min(b.norm()) / size - 1.2).clamp(0.0, 1.0);
            value -= 0.2 * long * (b[2] / b.norm() - a[2] / a.norm()).max(0.0);
        }
    }

    // The hand outside, neither stretched nor folded, pointing out and down.
    let out = Vector([tip[0] - base[0], tip[1] - base[1], 0.0]);
    value += 1.2 * (out.norm() / size).min(0.4);
    let outward = out.scale(1.0 / out.norm().max(1e-9 * size));
    value += 0.35 * (0.75 * hand.dot(outward) - 0.65 * hand[2]);
    let reach = (tip - base).norm() / size;
    value -= 1.5 * (reach - 0.64).max(0.0) + 0.8 * (0.4 - reach).max(0.0);

    // In front rather than behind, few joints away from zero, quarter turns rather than others.
    value += 0.05 * (outward[0] + 0.3 * outward[1]);
    if flat && upright {
        value += 0.2 * out[1].max(0.0).min(0.5 * out.norm()) / size;
    }
    for (j, (x, z)) in q.iter().zip(zero).enumerate() {
        if chain.kinds[j] == JointKind::Revolute && (x - z).abs() > 1e-9 {
            value -= 0.045 + 0.025 * (x - z).abs();
        }
    }
    value
}
