//! Arms with a spherical shoulder, an elbow and a spherical wrist: all configurations by the arm angle.
//!
//! After Shimizu, Kakuya, Yoon, Kitagaki and Kosuge, *Analytical inverse kinematic computation for 7-DOF redundant
//! manipulators with joint limits and its application to redundancy resolution*, IEEE T-RO 24(5), 2008; for any such
//! geometry. S is the shoulder's centre, W the wrist's. The distance |SW| determines the elbow; link 3 can still swivel
//! about the line SW: R₀₃(ψ) = A sin ψ + B cos ψ + C, and so the wrist's rotation. Where a joint is at a limit is an
//! equation a sin ψ + b cos ψ = c, solved exactly.
//!
//! ψ = 0 where axis 3, seen from S toward the elbow, lies in the plane of axis 1 and the line SW, on the side that axis 1
//! points to; ψ is positive about the direction from S to W.

use super::arcs::Arcs;
use super::limits::{Range, SLACK};
use super::manifold::{Chart, Found, Piece};
use super::spherical::{Matrix, Spherical, Swivel, Turn, act, dot, product, transposed};
use super::wrapped;
use crate::description::{Description, JointKind};
use crate::geometry::{Rotation, Transform, Vector};
use crate::inverse::branch::{Branch, Choice, Label, Part};
use crate::inverse::derivation::settled;
use crate::mechanism::{Lengths, MovingAxes, MovingAxis, Robot};
use crate::space::JointSpace;
use crate::structure::Structure;
use std::f64::consts::PI;

/// Values of ψ that are tried before intervals are computed, as distances from the first.
const TRIES: [f64; 8] = [0.0, PI, PI / 2.0, -PI / 2.0, PI / 4.0, -PI / 4.0, 0.75 * PI, -0.75 * PI];
/// How far |SW| may be beyond reach, by the square, for rounding.
const CLAMP: f64 = 1e-12;

/// The arm, seen so.
#[derive(Clone, Debug)]
pub(super) struct ArmAngle {
    shoulder: Spherical,
    elbow: Turn,
    elbow_range: Range,
    wrist: Spherical,
    /// Frame 0 before axis 1, in the base.
    base: Transform<f64>,
    /// Rotations from behind axis 1, 2, 3, 4 to before the next.
    between: [Matrix; 4],
    /// S in the base.
    shoulder_centre: [f64; 3],
    /// From S to the origin before axis 4, in frame 3.
    upper: [f64; 3],
    /// W behind axis 4, in the frame of axis 4.
    lower: [f64; 3],
    /// W in the tool.
    wrist_centre: Vector<f64>,
    /// Rotation from behind axis 7 to the tool, transposed.
    tool: Matrix,
    /// Along axis 3 from S toward the elbow.
    toward: f64,
    reach: f64,
}

/// What a pose leaves open for one elbow angle.
#[derive(Clone, Copy, Debug)]
struct Elbow {
    q: f64,
    /// 0 where the two elbows meet, 1 at most.
    guard: f64,
    choice: Choice,
    shoulder: Swivel,
    wrist: Swivel,
}

/// The elbows of a pose: the one with the larger angle first.
type Elbows = [Option<Elbow>; 2];

const SIGNS: [f64; 2] = [1.0, -1.0];
/// Places in it, for the shoulder and the wrist.
const BRANCHES: [(usize, usize); 4] = [(0, 0), (0, 1), (1, 0), (1, 1)];

impl ArmAngle {
    /// The arm seen so; nothing if it is none.
    pub fn recognise(description: &Description, robot: &Robot<f64>, space: &JointSpace) -> Option<Self> {
        let kinds = description.variables();
        if kinds.len() != 7 || kinds.iter().any(|v| v.kind != JointKind::Revolute) {
            return None;
        }
        let spherical = Structure::of(&settled(description)).spherical;
        if !spherical.contains(&1) || !spherical.contains(&5) {
            return None;
        }
        let (mut turns, fixed) = chain(robot)?;
        let ranges = Range::all(space);
        let three = |k: usize| [ranges[k], ranges[k + 1], ranges[k + 2]];
        let shoulder = Spherical::new(
            [turns[0], turns[1], turns[2]],
            [&fixed[1].rotation, &fixed[2].rotation],
            three(0),
        )?;
        let wrist = Spherical::new(
            [turns[4], turns[5], turns[6]],
            [&fixed[5].rotation, &fixed[6].rotation],
            three(4),
        )?;
        let elbow = turns.swap_remove(3);
        let [s_1, _] = meeting(&fixed[1]);
        let [_, s_3] = meeting(&fixed[2]);
        let [w_5, _] = meeting(&fixed[5]);
        let [_, w_7] = meeting(&fixed[6]);
        let on_axis = |x: f64| Vector([0.0, 0.0, x]);
        let upper = fixed[3].translation - on_axis(s_3);
        let lower = fixed[4].act_on_point(on_axis(w_5));
        // Without offsets along these two the elbow does not change |SW|.
        let reach = space.reach;
        let turned = fixed[3].rotation.inverse() * upper;
        if lower[0].hypot(lower[1]) * turned[0].hypot(turned[1]) <= 1e-9 * reach * reach {
            return None;
        }
        // The point of axis 3 next to axis 4: (upper + μz) is as near to e_z as can be.
        let z = fixed[3].rotation.z();
        let along =
            upper[2] - z[2] * (z[0] * upper[0] + z[1] * upper[1]) / (z[0] * z[0] + z[1] * z[1]).max(1e-30);
        Some(ArmAngle {
            shoulder,
            elbow,
            elbow_range: ranges[3],
            wrist,
            base: fixed[0],
            between: std::array::from_fn(|k| fixed[k + 1].rotation.rows()),
            shoulder_centre: fixed[0].act_on_point(on_axis(s_1)).0,
            upper: upper.0,
            lower: lower.0,
            wrist_centre: fixed[7].inverse().act_on_point(on_axis(w_7)),
            tool: fixed[7].rotation.inverse().rows(),
            toward: if along < 0.0 { -1.0 } else { 1.0 },
            reach,
        })
    }

    /// From S to W in frame 3, for the turn of axis 4 by τ.
    fn forearm(&self, tau: f64) -> [f64; 3] {
        let (s, c) = tau.sin_cos();
        let [x, y, z] = self.lower;
        let w = act(&self.between[2], [c * x - s * y, s * x + c * y, z]);
        std::array::from_fn(|i| self.upper[i] + w[i])
    }

    /// R₀₃ at ψ = 0, for W in direction `d` (unit) seen from S, with W at `p` (unit) in frame 3.
    fn reference(&self, p: [f64; 3], d: [f64; 3]) -> Matrix {
        let base = self.base.rotation;
        let local = triad(p, [[0.0, 0.0, self.toward], [1.0, 0.0, 0.0]]);
        let world = triad(d, [base.z().0, base.x().0]);
        product(&transposed(&world), &local)
    }

    fn elbows(&self, pose: &Transform<f64>) -> Elbows {
        let w = pose.act_on_point(self.wrist_centre).0;
        let line: [f64; 3] = std::array::from_fn(|i| w[i] - self.shoulder_centre[i]);
        let square = dot(line, line);
        if square <= 1e-18 * self.reach * self.reach {
            return [None, None];
        }
        let d = line.map(|x| x / square.sqrt());
        // |SW|² = |u|² + |l|² + 2 uᵀ M Rz(τ) l
        let u = act(&transposed(&self.between[2]), self.upper);
        let [lx, ly, lz] = self.lower;
        let (a, b) = (lx * u[0] + ly * u[1], lx * u[1] - ly * u[0]);
        let rest = (square - dot(u, u) - dot(self.lower, self.lower)) / 2.0 - lz * u[2];
        let length = a.hypot(b);
        let root = (length - rest) * (length + rest);
        if root < -CLAMP * length * length {
            return [None, None];
        }
        let middle = b.atan2(a);
        let away = root.max(0.0).sqrt().atan2(rest);
        let r_07 = pose.rotation.rows();
        let hand = product(&r_07, &self.tool);
        let one = |tau: f64, choice: Choice| {
            let p = self.forearm(tau);
            let length = dot(p, p).sqrt();
            let at = self.reference(p.map(|x| x / length), d);
            // Rodrigues: cos ψ (1 − ddᵀ)R + sin ψ [d]R + ddᵀR
            let along: [f64; 3] = std::array::from_fn(|j| (0..3).map(|i| d[i] * at[i][j]).sum());
            let c: Matrix = std::array::from_fn(|i| std::array::from_fn(|j| d[i] * along[j]));
            let b: Matrix = std::array::from_fn(|i| std::array::from_fn(|j| at[i][j] - c[i][j]));
            let column = |j: usize| cross(d, [at[0][j], at[1][j], at[2][j]]);
            let a = transposed(&std::array::from_fn(column));
            let swivel = Swivel { a, b, c };
            let (s, co) = tau.sin_cos();
            let turn = [[co, -s, 0.0], [s, co, 0.0], [0.0, 0.0, 1.0]];
            let link = product(&product(&self.between[2], &turn), &self.between[3]);
            let identity = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
            Elbow {
                q: wrapped(self.elbow.sense * (tau - self.elbow.offset)),
                guard: away.sin(),
                choice,
                shoulder: swivel.between(&self.base.rotation.inverse().rows(), &identity),
                wrist: swivel.transposed().between(&transposed(&link), &hand),
            }
        };
        [
            Some(one(middle + away, Choice::Plus)),
            (away > 0.0 && away < PI).then(|| one(middle - away, Choice::Minus)),
        ]
    }

    /// The joints at ψ, on a branch.
    fn at(&self, elbow: &Elbow, psi: f64, shoulder: f64, wrist: f64) -> Option<[f64; 7]> {
        let (s, c) = psi.sin_cos();
        let [q1, q2, q3] = self.shoulder.solve(&elbow.shoulder.at(s, c), shoulder)?;
        let [q5, q6, q7] = self.wrist.solve(&elbow.wrist.at(s, c), wrist)?;
        Some([q1, q2, q3, elbow.q, q5, q6, q7])
    }

    /// The member of a component at ψ.
    pub fn member(
        &self,
        pose: &Transform<f64>,
        (elbow, shoulder, wrist): (usize, f64, f64),
        psi: f64,
    ) -> Option<Vec<f64>> {
        let elbow = self.elbows(pose)[elbow]?;
        self.at(&elbow, psi, shoulder, wrist).map(|q| q.to_vec())
    }

    /// ψ of a configuration; nothing if W lies in S.
    pub fn angle_of(&self, q: &[f64]) -> Option<f64> {
        let r = self.r_03(q);
        let tau = self.elbow.sense * q[self.elbow.joint] + self.elbow.offset;
        let p = self.forearm(tau);
        let length = dot(p, p).sqrt();
        if length <= 1e-9 * self.reach {
            return None;
        }
        let p = p.map(|x| x / length);
        let at = self.reference(p, act(&r, p));
        // What turns the reference into R₀₃, about the line: its cosine and sine, by a direction across the line.
        let [_, n, b] = triad(p, [[0.0, 0.0, self.toward], [1.0, 0.0, 0.0]]);
        let turned = act(&r, n);
        Some(dot(act(&at, b), turned).atan2(dot(act(&at, n), turned)))
    }

    fn r_03(&self, q: &[f64]) -> Matrix {
        let mut r = self.base.rotation;
        for (i, turn) in self.shoulder.turns.iter().enumerate() {
            // The offsets of the turns hold part of the rotations between; what is left is Rx of the twist.
            r = r * Rotation::about_z(turn.sense * q[turn.joint] + turn.offset);
            if i < 2 {
                r = r * Rotation::from_rows(self.shoulder.twist(i));
            }
        }
        r.rows()
    }

    /// One within the limits, or nothing if there is none; ψ is tried from that of `seed` outward.
    pub fn within(&self, pose: &Transform<f64>, seed: Option<&[f64]>) -> Option<Found> {
        let elbows = self.elbows(pose);
        let allowed = || elbows.iter().flatten().filter(|e| self.elbow_range.excess(e.q) <= SLACK);
        let angle = seed.and_then(|q| Some((q, self.angle_of(q)?)));
        if let Some((seed, psi)) = angle {
            let mut near: Option<(f64, Found)> = None;
            for elbow in allowed() {
                for (i, j) in BRANCHES {
                    let Some(q) = self.at(elbow, psi, SIGNS[i], SIGNS[j]).filter(|q| self.is_within(q))
                    else {
                        continue;
                    };
                    let away = q.iter().zip(seed).map(|(x, y)| wrapped(x - y).abs()).fold(0.0, f64::max);
                    if near.as_ref().is_none_or(|n| away < n.0) {
                        near = Some((away, self.found(elbow, q, i, j)));
                    }
                }
            }
            if let Some((_, found)) = near {
                return Some(found);
            }
        }
        let start = angle.map_or(0.0, |a| a.1);
        for away in TRIES {
            for elbow in allowed() {
                if let Some(found) = self.quick(elbow, start + away) {
                    return Some(found);
                }
            }
        }
        // The feasible intervals are exact: if there is a solution, it is in one of them or at an end.
        for elbow in allowed() {
            let (shoulders, wrists) = self.arcs(elbow);
            for (i, j) in BRANCHES {
                let arcs = shoulders[i].intersection(&wrists[j]);
                let places = arcs.0.iter().flat_map(|[low, high]| [(low + high) / 2.0, *low, *high]);
                for psi in places {
                    if let Some(q) = self.at(elbow, psi, SIGNS[i], SIGNS[j])
                        && self.is_within(&q)
                    {
                        return Some(self.found(elbow, q, i, j));
                    }
                }
            }
        }
        // Where the feasible set is a single ψ, it is a cut.
        for elbow in allowed() {
            let mut cuts = vec![];
            self.shoulder.cuts(&elbow.shoulder, &mut cuts);
            self.wrist.cuts(&elbow.wrist, &mut cuts);
            if let Some(found) = cuts.iter().find_map(|&psi| self.quick(elbow, psi)) {
                return Some(found);
            }
        }
        None
    }

    /// A branch within the limits at ψ.
    fn quick(&self, elbow: &Elbow, psi: f64) -> Option<Found> {
        let (s, c) = psi.sin_cos();
        let one = |arm: &Spherical, r: &Matrix| {
            (0..2).find_map(|i| arm.solve(r, SIGNS[i]).filter(|q| arm.is_within(q)).map(|q| (i, q)))
        };
        let (i, [q1, q2, q3]) = one(&self.shoulder, &elbow.shoulder.at(s, c))?;
        let (j, [q5, q6, q7]) = one(&self.wrist, &elbow.wrist.at(s, c))?;
        Some(self.found(elbow, [q1, q2, q3, elbow.q, q5, q6, q7], i, j))
    }

    fn found(&self, elbow: &Elbow, q: [f64; 7], i: usize, j: usize) -> Found {
        let guard = elbow.guard.min(self.shoulder.guard(q[1])).min(self.wrist.guard(q[5]));
        Found { q: q.to_vec(), guard: Some(guard), branch: branch(elbow, i, j) }
    }

    fn is_within(&self, q: &[f64; 7]) -> bool {
        self.shoulder.is_within(&[q[0], q[1], q[2]]) && self.wrist.is_within(&[q[4], q[5], q[6]])
    }

    /// Where the limits allow the shoulder's joints, for both signs, and where the wrist's.
    fn arcs(&self, elbow: &Elbow) -> ([Arcs; 2], [Arcs; 2]) {
        let of = |arm: &Spherical, swivel: &Swivel| {
            let mut cuts = Vec::with_capacity(16);
            arm.cuts(swivel, &mut cuts);
            SIGNS.map(|sign| {
                Arcs::between(&mut cuts, |psi| {
                    let (s, c) = psi.sin_cos();
                    arm.solve(&swivel.at(s, c), sign).is_some_and(|q| arm.excess(&q) <= 0.0)
                })
            })
        };
        (of(&self.shoulder, &elbow.shoulder), of(&self.wrist, &elbow.wrist))
    }

    /// Where branches exist, whatever the limits.
    fn domains(&self, elbow: &Elbow) -> Arcs {
        let of = |arm: &Spherical, swivel: &Swivel| {
            let mut cuts = vec![];
            arm.ends(swivel, &mut cuts);
            Arcs::between(&mut cuts, |psi| {
                let (s, c) = psi.sin_cos();
                arm.solve(&swivel.at(s, c), 1.0).is_some()
            })
        };
        of(&self.shoulder, &elbow.shoulder).intersection(&of(&self.wrist, &elbow.wrist))
    }

    /// All branches of a pose.
    pub fn pieces(&self, pose: &Transform<f64>) -> Vec<Piece> {
        let mut found = vec![];
        for (number, elbow) in self.elbows(pose).iter().enumerate() {
            let Some(elbow) = elbow else { continue };
            let domains = self.domains(elbow);
            let (shoulders, wrists) = self.arcs(elbow);
            let is_allowed = self.elbow_range.excess(elbow.q) <= SLACK;
            for (i, j) in BRANCHES {
                let feasible =
                    if is_allowed { shoulders[i].intersection(&wrists[j]) } else { Arcs::default() };
                for domain in &domains.0 {
                    found.push(Piece {
                        branch: branch(elbow, i, j),
                        parameter: "ψ".into(),
                        domain: *domain,
                        feasible: feasible.inside(*domain).0,
                        is_closed: *domain == super::arcs::CIRCLE,
                        chart: Chart::ArmAngle { elbow: number, shoulder: SIGNS[i], wrist: SIGNS[j] },
                    });
                }
            }
        }
        found
    }
}

fn branch(elbow: &Elbow, i: usize, j: usize) -> Branch {
    let choice = |x: usize| if x == 0 { Choice::Plus } else { Choice::Minus };
    let all = [(Part::Shoulder, choice(i)), (Part::Elbow, elbow.choice), (Part::Wrist, choice(j))];
    Branch(all.map(|(part, choice)| (Label { part, number: 1 }, choice)).to_vec())
}

/// The joints of a chain in which each turns one axis, in order, and the eight constant transforms around them.
fn chain(robot: &Robot<f64>) -> Option<(Vec<Turn>, Vec<Transform<f64>>)> {
    let MovingAxes { moving, constants } = MovingAxes::new(robot, Lengths::Behind);
    let turn = |(k, axis): (usize, &MovingAxis<f64>)| match axis.value.terms[..] {
        [(joint, sense)] if axis.kind == JointKind::Revolute && joint == k && sense.abs() == 1.0 => {
            Some(Turn { joint, sense, offset: axis.value.constant() })
        }
        _ => None,
    };
    let turns: Vec<Turn> = moving.iter().enumerate().map(turn).collect::<Option<_>>()?;
    (turns.len() == 7).then_some((turns, constants))
}

/// Where the z axis of a frame meets the z axis that it is seen from: the coordinates along the first and the second.
fn meeting(x: &Transform<f64>) -> [f64; 2] {
    let (z, p) = (x.rotation.z(), x.translation);
    let second = -(p[0] * z[0] + p[1] * z[1]) / (z[0] * z[0] + z[1] * z[1]);
    [p[2] + second * z[2], second]
}

/// Rows: a unit vector; the first of two directions that is not along it, made orthogonal; their cross product.
fn triad(along: [f64; 3], hints: [[f64; 3]; 2]) -> Matrix {
    let across = |hint: [f64; 3]| -> ([f64; 3], f64) {
        let k = dot(along, hint);
        let rest: [f64; 3] = std::array::from_fn(|i| hint[i] - k * along[i]);
        (rest, dot(rest, rest).sqrt())
    };
    let (mut n, mut length) = across(hints[0]);
    if length < 1e-6 {
        (n, length) = across(hints[1]);
    }
    let n = n.map(|x| x / length);
    // Once more: what rounding left along it, a short rest magnifies.
    let k = dot(along, n);
    let n: [f64; 3] = std::array::from_fn(|i| n[i] - k * along[i]);
    let length = dot(n, n).sqrt();
    let n = n.map(|x| x / length);
    [along, n, cross(along, n)]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
