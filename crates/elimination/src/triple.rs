//! Three slides and three turns: the turns follow from the rotation, in two branches, and the slides linearly.
//!
//! `Z₁ C₁ Z₂ C₂ Z₃ C₃ = 1`, where `C₃` contains the pose: `(C₃ Z₁ C₁)₃₃ = (C₂)₃₃` gives the first turn, and the other two
//! follow from `C₃ Z₁ C₁ = Z₃⁻¹ C₂⁻¹ Z₂⁻¹`.

use crate::{
    arm::{Arm, Joint},
    candidate::{ACCEPTED, Found, add, lane},
    certificate::Verdict,
    instructions::{Compute, Instructions, part},
    lanes::Lanes,
    newton::polish,
    rigid::{Rigid, cross, dot},
    work::Work,
};

/// The constants of an arm with three slides.
#[derive(Clone, Debug)]
pub struct Triple {
    /// The turning joints, counted from 0.
    pub turns: [usize; 3],
    /// The sliding joints.
    pub slides: [usize; 3],
    /// The rotations behind the first and the second turn.
    pub between: [Rigid; 2],
    /// What stands before and behind `T⁻¹` in the third one.
    pub around_pose: [Rigid; 2],
}

impl Triple {
    /// `None` if the arm has other than three slides.
    pub fn new(arm: &Arm) -> Option<Triple> {
        let of = |kind: Joint| (0..6).filter(|&i| arm.joints[i] == kind).collect::<Vec<usize>>();
        let turns: [usize; 3] = of(Joint::Revolute).try_into().ok()?;
        let slides: [usize; 3] = of(Joint::Prismatic).try_into().ok()?;
        let product =
            |from: usize, to: usize| arm.links[from..to].iter().fold(Rigid::IDENTITY, |a, b| a.then(b));
        Some(Triple {
            turns,
            slides,
            between: [product(turns[0], turns[1]), product(turns[1], turns[2])],
            around_pose: [product(turns[2], 6), arm.base.then(&product(0, turns[0]))],
        })
    }
}

/// Branches that are closer to each other than this (as a sine) are about to meet.
const MEETING: f64 = 1e-7;

part! {
    /// Both branches, polished.
    pub(crate) fn solve_triple<I>(
        arm: &Arm,
        triple: &Triple,
        target: &Rigid,
        work: &mut Work,
    ) -> Verdict {
        let [first, second] = &triple.between;
        let closing = triple.around_pose[0].then(&target.inverse()).then(&triple.around_pose[1]);
        // (C₃ Z₁ C₁)₃₃ = A cos q₁ + B sin q₁ + C
        let (row, r) = (closing.rotation[2], &first.rotation);
        let column = [r[0][2], r[1][2], r[2][2]];
        let a = row[0] * column[0] + row[1] * column[1];
        let b = row[1] * column[0] - row[0] * column[1];
        let k = second.rotation[2][2] - row[2] * column[2];
        let square = a * a + b * b;
        let left = square - k * k;
        let root = if left > 0.0 { left.sqrt() } else { 0.0 };
        let close = root < MEETING;
        if square < 1e-24 || square.is_nan() {
            return Verdict::Uncertain;
        }
        if left < -MEETING * MEETING {
            return Verdict::Certified;
        }
        let mut all = true;
        for side in [root, -root] {
            let turn = Rigid::about_z((a * k - b * side) / square, (b * k + a * side) / square);
            let h = closing.then(&turn).then(first);
            // h e₃ = Z₃⁻¹ C₂ᵀ e₃,   hᵀ e₃ = Z₂ C₂ e₃
            let (m, p) = (&second.rotation, &h.rotation);
            let (u, v) = ([m[2][0], m[2][1]], [p[0][2], p[1][2]]);
            let third = (u[1] * v[0] - u[0] * v[1]).atan2(u[0] * v[0] + u[1] * v[1]);
            let (u, v) = ([m[0][2], m[1][2]], [p[2][0], p[2][1]]);
            let middle = (u[0] * v[1] - u[1] * v[0]).atan2(u[0] * v[0] + u[1] * v[1]);
            let mut pairs = [[0.0; 2]; 6];
            pairs[triple.turns[0]] = [turn.rotation[0][0], turn.rotation[1][0]];
            pairs[triple.turns[1]] = [middle.cos(), middle.sin()];
            pairs[triple.turns[2]] = [third.cos(), third.sin()];

            // offset + d₁ a₁ + d₂ a₂ + d₃ a₃ = target
            let (mut at, mut axes) = (arm.base, [[0.0; 3]; 3]);
            for i in 0..6 {
                for (axis, slide) in axes.iter_mut().zip(triple.slides) {
                    if i == slide {
                        let r = &at.rotation;
                        *axis = [r[0][2], r[1][2], r[2][2]];
                    }
                }
                if arm.joints[i] == Joint::Revolute {
                    at = at.then(&Rigid::about_z(pairs[i][0], pairs[i][1]));
                }
                at = at.then(&arm.links[i]);
            }
            let mut rest = target.translation;
            for (rest, at) in rest.iter_mut().zip(at.translation) {
                *rest -= at;
            }
            let det = dot(axes[0], cross(axes[1], axes[2]));
            if det == 0.0 {
                all = false;
                continue;
            }
            for x in 0..3 {
                pairs[triple.slides[x]][0] = dot(rest, cross(axes[(x + 1) % 3], axes[(x + 2) % 3])) / det;
            }
            let mut values = [[Lanes::ZERO; 2]; 6];
            for (value, [c, s]) in values.iter_mut().zip(pairs) {
                *value = [Lanes::splat(c), Lanes::splat(s)];
            }
            let residual = polish::<I>(arm, target, &mut values).0[0];
            if residual <= ACCEPTED {
                add(arm, &mut work.found, Found { values: lane(&values, 0), residual });
            } else {
                all = false;
            }
        }
        match (all, close) {
            (true, false) => Verdict::Certified,
            (_, true) => Verdict::Pairs,
            _ => Verdict::Uncertain,
        }
    }
}
