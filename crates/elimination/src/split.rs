//! A split of the loop: which joint is hidden, which is dropped, which two are eliminated; its constants.
//!
//! The loop of joints and links, read forwards or backwards from any joint, is `Z₁ L₁ Z₂ L₂ … Z₆ L₆ = 1` with the
//! joints `a₁ … a₆`. Cut in two,
//!
//! `G = L₂ Z₃ L₃ Z₄ L₄ Z₅ L₅ = Z₂⁻¹ L₁⁻¹ Z₁⁻¹ L₆⁻¹ Z₆⁻¹`.
//!
//! `Z₆` leaves the line of `a₆` where it is, so the [forms](crate::forms) of this line, seen from both sides, give
//! fourteen equations in `a₃ a₄ a₅` on the left and `a₁ a₂` on the right. The link that depends on the pose is `L₁`,
//! `L₂` or `L₆`: the left side is a constant of the arm (where the pose is `L₂`, that link is moved to the right).

use crate::{
    arm::{Arm, Joint},
    forms::{FORMS, forms, interpolate, nodes},
    rigid::Rigid,
};

/// Constants of a split; lengths are divided by the arm's size.
#[derive(Clone, Debug)]
pub struct Split {
    /// The arm's joints `a₁ … a₆`, counted from 0.
    pub joints: [usize; 6],
    /// What they do.
    pub kinds: [Joint; 6],
    /// 1 where the loop is read forwards, −1 where backwards: joint values change sign with it.
    pub sign: f64,
    /// `L₁ … L₆` without the pose; the one that contains it is the identity here.
    pub links: [Rigid; 6],
    /// Which of the links contains the pose: 0, 1 or 5.
    pub pose_link: usize,
    /// Cosine and sine of what is added to `a₄` and `a₅` (if revolute) in the equations, so that no value is special.
    pub offset: [f64; 2],
    /// Whether `a₅` is the multiplied joint, `a₄` the one that stays; else the reverse.
    pub last_multiplied: bool,
    /// The left sides: coefficients of `(1, c, s)` of `a₃` times those of the multiplied joint times those of the other,
    /// the last fastest.
    pub left: [[f64; 27]; FORMS],
}

/// Angle added to the joints of the trio behind the hidden one.
const OFFSET: f64 = 0.7;

impl Split {
    /// The split that hides joint `hidden` (0 to 5), with the fifth or the fourth joint of the loop multiplied; `None` if
    /// the hidden or the dropped joint slides. The arm is already scaled.
    pub fn new(arm: &Arm, hidden: usize, last_multiplied: bool) -> Option<Split> {
        // Forwards the hidden joint is one of the first three, backwards one of the last three.
        let forwards = hidden < 3;
        let joints: [usize; 6] =
            std::array::from_fn(|i| if forwards { (hidden + 4 + i) % 6 } else { (hidden + 8 - i) % 6 });
        let kinds = joints.map(|j| arm.joints[j]);
        if kinds[2] == Joint::Prismatic || kinds[5] == Joint::Prismatic {
            return None;
        }
        // Forwards the link after joint j is A_j, backwards the inverse of the one before it.
        let links = joints.map(|j| match (forwards, j) {
            (true, 5) | (false, 0) => Rigid::IDENTITY,
            (true, j) => arm.links[j],
            (false, j) => arm.links[j - 1].inverse(),
        });
        let pose_link = joints.iter().position(|&j| j == if forwards { 5 } else { 0 })?;
        let sign = if forwards { 1.0 } else { -1.0 };

        let mut split = Split {
            joints,
            kinds,
            sign,
            links,
            pose_link,
            offset: [OFFSET.cos(), OFFSET.sin()],
            last_multiplied,
            left: [[0.0; 27]; FORMS],
        };
        let (third, fourth, fifth) = (nodes(kinds[2]), nodes(kinds[3]), nodes(kinds[4]));
        let back = |kind: Joint| match kind {
            Joint::Revolute => Rigid::about_z(split.offset[0], -split.offset[1]),
            Joint::Prismatic => Rigid::IDENTITY,
        };
        let (back_fourth, back_fifth) = (back(kinds[3]), back(kinds[4]));
        let mut samples = [[0.0; 27]; FORMS];
        for (i, third) in third.iter().enumerate() {
            for (j, fourth) in fourth.iter().enumerate() {
                for (k, fifth) in fifth.iter().enumerate() {
                    let g = links[1]
                        .then(third)
                        .then(&links[2])
                        .then(&back_fourth)
                        .then(fourth)
                        .then(&links[3])
                        .then(&back_fifth)
                        .then(fifth)
                        .then(&links[4]);
                    let r = &g.rotation;
                    let values = forms(g.translation, [r[0][2], r[1][2], r[2][2]]);
                    let at = if last_multiplied { 9 * i + 3 * k + j } else { 9 * i + 3 * j + k };
                    for (row, value) in samples.iter_mut().zip(values) {
                        row[at] = value;
                    }
                }
            }
        }
        let (multiplied, other) = if last_multiplied { (kinds[4], kinds[3]) } else { (kinds[3], kinds[4]) };
        for (row, sample) in split.left.iter_mut().zip(&samples) {
            *row = *sample;
            for (kind, stride) in [(kinds[2], 9), (multiplied, 3), (other, 1)] {
                for at in (0..27).filter(|at| at / stride % 3 == 0) {
                    let found = interpolate(kind, [row[at], row[at + stride], row[at + 2 * stride]]);
                    for (k, value) in found.into_iter().enumerate() {
                        row[at + k * stride] = value;
                    }
                }
            }
        }
        Some(split)
    }

    /// What the multiplied joint does, and what the other one does.
    #[inline]
    pub(crate) fn multiplied_and_other(&self) -> (Joint, Joint) {
        if self.last_multiplied { (self.kinds[4], self.kinds[3]) } else { (self.kinds[3], self.kinds[4]) }
    }

    /// The links with the pose in its place; `closing` is `A₆ T⁻¹ B`.
    #[inline]
    pub(crate) fn links_at(&self, closing: &Rigid) -> [Rigid; 6] {
        let mut links = self.links;
        links[self.pose_link] = if self.sign > 0.0 { *closing } else { closing.inverse() };
        links
    }
}
