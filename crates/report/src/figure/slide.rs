//! Where on its axis each joint's symbol stands: beside the others, along the links, where axes meet in one point.

use super::place::{free_range, symbol_size};
use super::skeleton::{Chain, Skeleton};
use denavit::description::JointKind;
use denavit::geometry::Vector;

/// Places that are tried on each axis.
const STEPS: usize = 20;

/// Arms with more joints are gone through once, from one start.
const MANY: usize = 40;

/// Places of the symbols along their axes, from the feet, that suit several poses; the first counts most.
pub fn slides(chain: &Chain, poses: &[Skeleton]) -> Vec<f64> {
    let Some(main) = poses.first() else { return vec![] };
    let count = main.joints.len();
    let sizes: Vec<(f64, f64)> = (0..count).map(|k| symbol_size(chain, main, k)).collect();
    let ranges: Vec<([f64; 2], f64)> = (0..count).map(|k| free_range(chain, main, k)).collect();
    let arm = Axes { chain, poses, sizes, ranges };
    // What has most room gives way first: in a wrist the outer joints, not the one between them.
    let room = |k: &usize| arm.ranges[*k].0[1] - arm.ranges[*k].0[0];
    let mut by_room: Vec<usize> = (0..count).collect();
    by_room.sort_by(|a, b| room(b).total_cmp(&room(a)));
    let from_hand: Vec<usize> = (0..count).rev().collect();
    let best: Vec<f64> = arm.ranges.iter().map(|r| r.1).collect();
    // Sliders farther out make room for what turns about the same axis.
    let out = arm.ranges.iter().zip(&main.joints).map(|(r, j)| match j.kind {
        JointKind::Prismatic => r.1 + 0.75 * (j.travel - r.1),
        JointKind::Revolute => r.1,
    });
    let out: Vec<f64> = out.collect();
    // Or what has least room first, but for what has none: between neighbours on one line.
    let mut narrow = by_room.clone();
    narrow.reverse();
    narrow.sort_by_key(|k| room(k) <= 0.0);
    let starts = [(&by_room, &best), (&from_hand, &best), (&by_room, &out), (&narrow, &out)];
    let mut chosen: Option<(f64, Vec<f64>)> = None;
    for (order, start) in starts.into_iter().take(if count > MANY { 1 } else { starts.len() }) {
        let slides = arm.descend(order, start.clone());
        let cost: f64 = (0..count).map(|k| arm.cost(&slides, k, slides[k])).sum();
        if chosen.as_ref().is_none_or(|c| cost < c.0 - 1e-6 * chain.size) {
            chosen = Some((cost, slides));
        }
    }
    chosen.map(|c| c.1).unwrap_or_default()
}

/// What is known of the axes.
struct Axes<'a> {
    chain: &'a Chain,
    poses: &'a [Skeleton],
    /// Radius and half the length of each symbol.
    sizes: Vec<(f64, f64)>,
    /// Where each may stand at no cost, and where best.
    ranges: Vec<([f64; 2], f64)>,
}

impl Axes<'_> {
    /// Each symbol in turn goes where it is least in the way.
    fn descend(&self, order: &[usize], mut slides: Vec<f64>) -> Vec<f64> {
        for _sweep in 0..if slides.len() > MANY { 1 } else { 3 } {
            for &k in order {
                let (range, best) = self.ranges[k];
                let beyond = 3.0 * (self.sizes[k].0 + self.sizes[k].1);
                let (low, high) = (range[0] - beyond, range[1] + beyond);
                let tried = (0..=STEPS).map(|i| low + (high - low) * i as f64 / STEPS as f64);
                let tried = tried.chain((0..=STEPS).map(|i| best + beyond * (i as f64 / STEPS as f64 - 0.5)));
                let mut chosen = (self.cost(&slides, k, slides[k]), slides[k]);
                for s in [best].into_iter().chain(tried) {
                    let outside = self.off(k, s);
                    if outside >= chosen.0 {
                        continue;
                    }
                    let c = self.cost(&slides, k, s);
                    if c < chosen.0 - 1e-9 * self.chain.size {
                        chosen = (c, s);
                    }
                }
                slides[k] = chosen.1;
            }
        }
        slides
    }

    /// How far a place is from where the symbol would stand alone.
    fn off(&self, k: usize, s: f64) -> f64 {
        let (range, best) = self.ranges[k];
        let outside = (range[0] - s).max(s - range[1]).max(0.0);
        1.2 * outside + 0.25 * (s - best).abs()
    }

    fn cost(&self, slides: &[f64], k: usize, s: f64) -> f64 {
        let weights = [1.0, 0.35, 0.35];
        let crowded = self.poses.iter().zip(weights);
        let crowded = crowded.map(|(pose, w)| w * crowding(self.chain, pose, &self.sizes, slides, k, s));
        self.off(k, s) + crowded.sum::<f64>()
    }
}

/// How much a symbol at a place is in the way of others, metres.
fn crowding(chain: &Chain, pose: &Skeleton, sizes: &[(f64, f64)], slides: &[f64], k: usize, s: f64) -> f64 {
    let (radius, half) = sizes[k];
    let own = spine(pose, k, s, half);
    let gap = 0.011 * chain.size;
    let mut cost = 0.0;
    for (other, &(r, h)) in sizes.iter().enumerate().filter(|o| o.0 != k) {
        let theirs = spine(pose, other, slides[other], h);
        let nearest = own.iter().flat_map(|p| theirs.iter().map(|q| (*p - *q).norm()));
        let deep = radius + r + gap - nearest.fold(f64::INFINITY, f64::min);
        cost += 4.0 * deep.max(0.0) + if deep > 0.0 { 0.3 * radius } else { 0.0 };
    }
    // On one line the order is that of the chain.
    for (first, second) in [(k.wrapping_sub(1), k), (k, k + 1)] {
        let (Some(a), Some(b)) = (pose.joints.get(first), pose.joints.get(second)) else { continue };
        let along = b.end() - a.foot;
        let length = along.norm();
        let near = 1e-6 * chain.size;
        let same = a.axis.cross(b.axis).norm() < 1e-6 && (b.foot - a.foot).cross(a.axis).norm() < near;
        if same && length > near {
            let at = |j: usize| pose.joints[j].point(if j == k { s } else { slides[j] });
            cost += 2.0 * (at(first) - at(second)).dot(along.scale(1.0 / length)).max(0.0);
        }
    }
    // Links of others; its own two may pass.
    for (link, path) in pose.links.iter().enumerate() {
        if link == k || link == k + 1 {
            continue;
        }
        for ends in path.windows(2) {
            let nearest = own.iter().map(|p| to_segment(*p, ends[0], ends[1])).fold(f64::INFINITY, f64::min);
            cost += 0.8 * (radius - nearest).max(0.0);
        }
    }
    cost
}

/// Points along the middle of a symbol.
fn spine(pose: &Skeleton, k: usize, s: f64, half: f64) -> [Vector<f64>; 5] {
    let inner = 0.75 * half;
    [-1.0, -0.5, 0.0, 0.5, 1.0].map(|t| pose.joints[k].point(s + t * inner))
}

/// The distance of a point from a segment.
pub fn to_segment(p: Vector<f64>, a: Vector<f64>, b: Vector<f64>) -> f64 {
    let v = b - a;
    let t = ((p - a).dot(v) / v.dot(v).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    (p - a - v.scale(t)).norm()
}

#[cfg(test)]
mod tests {
    use crate::figure::Arm;
    use denavit::catalogue;

    fn slides(name: &str) -> (Arm, Vec<f64>) {
        let arm = Arm::new(&catalogue::robot(name).expect("a robot of the catalogue")).expect("an arm");
        let slides = arm.slides.to_vec();
        (arm, slides)
    }

    /// As the RX-90 is always drawn: joint 1 below the shoulder, joint 4 on the forearm, joint 6 beyond the wrist.
    #[test]
    fn symbols_of_axes_that_meet_stand_beside_each_other() {
        let (arm, s) = slides("staubli-rx90");
        assert!(s[0] < -0.02, "{s:?}");
        assert!(s[1].abs() < 0.01 && s[2].abs() < 0.01 && s[4].abs() < 0.01, "{s:?}");
        // The forearm is RL4 = 0.45 m long.
        assert!(s[3] > 0.1 && s[3] < 0.4, "{s:?}");
        assert!(s[5] > 0.02, "{s:?}");
        let hand = arm.layout().gripper.0;
        let joint = &arm.skeleton().joints[5];
        assert!((hand - joint.foot).dot(joint.axis) > s[5], "the hand is beyond the last joint");
    }

    /// Axes 5 and 6 of the PRRRRP arm are one line: the joint that turns comes first.
    #[test]
    fn symbols_on_one_line_are_in_the_order_of_the_chain() {
        for (name, first) in [("prrrrp", 4), ("stanford", 2), ("gantry-wrist", 2)] {
            let (arm, s) = slides(name);
            let [a, b] = [first, first + 1].map(|k| arm.skeleton().joints[k].point(s[k]));
            let along = arm.skeleton().joints[first + 1].end() - arm.skeleton().joints[first].foot;
            assert!((b - a).dot(along) > 0.0, "{name}: {s:?}");
        }
    }
}
