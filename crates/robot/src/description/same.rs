//! Whether two descriptions are the same mechanism: the same axes, whatever base, hand, zero positions, and directions in
//! which joints count.
//!
//! A chain is a word of screws about z and x in turn. What its author was free to choose is moved to where it is always
//! the same: what commutes with the first joint into the base, with the last one into the tool, lengths along parallel
//! axes behind the last of them, lengths across a slide behind it. Two such words are the same mechanism if one becomes
//! the other by turning normals (x) and axes (z) round, and that is decided cell by cell.

use super::{Description, JointKind, Screw};
use crate::geometry::{Axis, Rotation, Transform, Vector};
use denavit_symbolic::{Angle, Expr, Rational, Symbol, equal};
use std::f64::consts::TAU;

/// Two descriptions of one mechanism: for all q, `T_a(q) = base · T_b(σq + zeros) · tool`.
#[derive(Clone, Debug)]
pub struct SameMechanism {
    /// Of each joint whether it counts the other way, σ = −1.
    pub reversed: Vec<bool>,
    /// What is added to each joint variable, radians or metres.
    pub zeros: Vec<Expr>,
    /// The base of the second in that of the first.
    pub base: Transform<Expr>,
    /// The tool of the first in that of the second.
    pub tool: Transform<Expr>,
}

/// Whether two descriptions are the same mechanism.
#[derive(Clone, Debug)]
pub enum Sameness {
    /// They are, and this is how one becomes the other: proved.
    Same(Box<SameMechanism>),
    /// They are not.
    Different,
    /// Neither was proved.
    Undecided,
}

/// A turn about z and a slide along it, of which joints move one or both.
#[derive(Clone, Debug)]
struct Moving {
    angle: Expr,
    length: Expr,
    turns: Option<Own>,
    slides: Option<Own>,
}

/// The joint variable of a motion, and whether it counts with a minus.
#[derive(Clone, Copy, Debug)]
struct Own {
    joint: usize,
    is_negative: bool,
}

/// A chain of which each turn about z moves: `base · z₀ x₀ z₁ … zₘ · tool`.
#[derive(Clone, Debug)]
struct Word {
    base: Transform<Expr>,
    z: Vec<Moving>,
    x: Vec<Screw>,
    tool: Transform<Expr>,
    joints: usize,
}

/// Which way axes and normals are turned round.
#[derive(Clone, Debug)]
struct Flips {
    /// Of each axis.
    z: Vec<bool>,
    /// Of each normal.
    x: Vec<bool>,
}

/// Proves that two descriptions are the same mechanism, joint by joint, or that they are not.
///
/// Of several ways to make one the other, one that leaves directions, base and tool as they are is preferred.
pub fn same_mechanism(a: &Description, b: &Description) -> Sameness {
    let (ja, jb) = (a.variables(), b.variables());
    if ja.len() != jb.len() || ja.iter().zip(&jb).any(|(x, y)| x.kind != y.kind) {
        return Sameness::Different;
    }
    let (Some(a), Some(b)) = (Word::of(a), Word::of(b)) else { return Sameness::Undecided };
    let joint = |own: Option<Own>| own.map(|o| o.joint);
    let pattern = |w: &Word| w.z.iter().map(|z| (joint(z.turns), joint(z.slides))).collect::<Vec<_>>();
    if pattern(&a) != pattern(&b) {
        return Sameness::Undecided;
    }
    let mut found: Vec<SameMechanism> = vec![];
    let first = Flips { z: vec![false], x: vec![] };
    let other = Flips { z: vec![true], x: vec![] };
    let mut open = vec![other, first];
    while let Some(flips) = open.pop() {
        let k = flips.x.len();
        if k < a.x.len() {
            open.extend(next(&a, &b, &flips));
        } else if fits_z(&a, &b, &flips, k) {
            found.push(between(&a, &b, &flips));
        }
    }
    let plain = |x: &Transform<Expr>| usize::from(*x != Transform::identity());
    let cost = |s: &SameMechanism| {
        let zeros = s.zeros.iter().filter(|z| !z.is_zero()).count();
        (s.reversed.iter().filter(|r| **r).count(), plain(&s.base) + plain(&s.tool), zeros)
    };
    match found.into_iter().min_by_key(cost) {
        Some(same) if agrees(&a, &b, &same) => Sameness::Same(Box::new(same)),
        Some(_) => Sameness::Undecided,
        None if a.is_canonical() && b.is_canonical() => Sameness::Different,
        None => Sameness::Undecided,
    }
}

/// The ways on from a joint over the next normal.
fn next(a: &Word, b: &Word, flips: &Flips) -> Vec<Flips> {
    let k = flips.x.len();
    let mut ways = vec![];
    for (x, z) in [(true, true), (true, false), (false, true), (false, false)] {
        let mut flips = flips.clone();
        flips.x.push(x);
        flips.z.push(z);
        if fits_z(a, b, &flips, k) && fits_x(&a.x[k], &b.x[k], &flips, k) {
            ways.push(flips);
        }
    }
    ways
}

/// True if a motion about z is the same, turned round.
fn fits_z(a: &Word, b: &Word, flips: &Flips, k: usize) -> bool {
    let (a, b) = (&a.z[k], &b.z[k]);
    let turned = usize::checked_sub(k, 1).is_some_and(|before| {
        let behind = flips.x.get(k).unwrap_or(&flips.x[before]);
        flips.x[before] != *behind
    });
    let half = if turned { Expr::pi() } else { Expr::int(0) };
    let angle = a.turns.is_some() || is_turn(signed(a.angle, flips.z[k]) + half - b.angle);
    angle && (a.slides.is_some() || is_same(signed(a.length, flips.z[k]), b.length))
}

/// True if a normal is the same, turned round.
fn fits_x(a: &Screw, b: &Screw, flips: &Flips, k: usize) -> bool {
    let reverses = flips.z[k] != flips.z[k + 1];
    let angle = signed(a.angle, flips.x[k]) + if reverses { Expr::pi() } else { Expr::int(0) };
    is_same(signed(a.length, flips.x[k]), b.length) && is_turn(angle - b.angle)
}

/// How the first becomes the second, turned round so.
fn between(a: &Word, b: &Word, flips: &Flips) -> SameMechanism {
    let mut zeros = vec![Expr::int(0); a.joints];
    let mut reversed = vec![false; a.joints];
    for (k, (za, zb)) in a.z.iter().zip(&b.z).enumerate() {
        let before = k.checked_sub(1).and_then(|k| flips.x.get(k));
        let turned = matches!((before, flips.x.get(k)), (Some(x), Some(y)) if x != y);
        let half = if turned { Expr::pi() } else { Expr::int(0) };
        let mut set = |a: Option<Own>, b: Option<Own>, zero: Expr| {
            if let (Some(a), Some(b)) = (a, b) {
                zeros[a.joint] = signed(zero, b.is_negative);
                reversed[a.joint] = flips.z[k] ^ a.is_negative ^ b.is_negative;
            }
        };
        set(za.turns, zb.turns, within_turn(signed(za.angle, flips.z[k]) + half - zb.angle));
        set(za.slides, zb.slides, normal(signed(za.length, flips.z[k]) - zb.length));
    }
    // The frames of the first, in which those of the second are turned round.
    let round = |x: bool, z: bool| {
        let sign = |s: bool| Expr::int(if s { -1 } else { 1 });
        let zero = Expr::int(0);
        let rows = [[sign(x), zero, zero], [zero, sign(x != z), zero], [zero, zero, sign(z)]];
        Transform::from_rotation_translation(Rotation::from_rows(rows), Vector::zero())
    };
    let (first, last) = (flips.x.first().copied(), flips.x.last().copied());
    let end = flips.z.last().copied().unwrap_or_default();
    let begin = round(first.unwrap_or_default(), flips.z[0]);
    let finish = round(last.unwrap_or_default(), end);
    // A turn of the base about the first axis, or of the tool about the last, may as well be another zero position.
    let quarters = [0, 1, 2, -1].map(|k| Expr::pi() * Expr::from(Rational::new(k, 2)));
    let place = |joint: Option<Own>, pose: &dyn Fn(Transform<Expr>) -> Transform<Expr>| {
        let turns = if joint.is_some() { &quarters[..] } else { &quarters[..1] };
        let posed = |phi: &Expr| (*phi, tidy(pose(Transform::rotation_z(*phi))));
        let all: Vec<(Expr, Transform<Expr>)> = turns.iter().map(posed).collect();
        *all.iter().find(|p| p.1 == Transform::identity()).unwrap_or(&all[0])
    };
    let (joint_1, joint_n) = (b.z[0].turns, b.z[b.x.len()].turns);
    let (phi, base) = place(joint_1, &|turn| a.base * begin * turn * b.base.inverse());
    if let Some(joint) = joint_1 {
        zeros[joint.joint] = within_turn(zeros[joint.joint] - signed(phi, joint.is_negative));
    }
    let joint_n = joint_n.filter(|_| a.z.len() > 1);
    let (phi, tool) = place(joint_n, &|turn| b.tool.inverse() * turn * finish.inverse() * a.tool);
    if let Some(joint) = joint_n {
        zeros[joint.joint] = within_turn(zeros[joint.joint] - signed(phi, joint.is_negative));
    }
    SameMechanism { reversed, zeros, base, tool }
}

/// Holds the equation of [`SameMechanism`] at a few configurations: a guard beside the proof.
fn agrees(a: &Word, b: &Word, same: &SameMechanism) -> bool {
    (1..4_u32).all(|seed| {
        let value = |s: Symbol| {
            let sum =
                s.name().bytes().fold(seed * 7919, |h, c| h.wrapping_mul(31).wrapping_add(u32::from(c)));
            Some(0.3 + f64::from(sum % 997) / 997.0)
        };
        let q: Vec<f64> =
            (0..a.joints).map(|i| (f64::from(seed) * 1.7 + i as f64 * 0.9) % TAU - 3.0).collect();
        let number = |e: Expr| e.eval(value).unwrap_or(f64::NAN);
        let moved = |i: usize| if same.reversed[i] { -q[i] } else { q[i] } + number(same.zeros[i]);
        let second: Vec<f64> = (0..b.joints).map(moved).collect();
        let left = a.at(&q, &number);
        let right = same.base.map(number) * b.at(&second, &number) * same.tool.map(number);
        let size = |t: &Transform<f64>| t.translation.norm() + 1.0;
        let entries = |t: &Transform<f64>| t.matrix().concat();
        let apart = entries(&left).into_iter().zip(entries(&right)).map(|(x, y)| (x - y).abs());
        apart.fold(0.0, f64::max) <= 1e-9 * size(&left)
    })
}

impl Word {
    /// The word of a chain; nothing where the table turns about a fixed axis between joints, or couples joints.
    fn of(d: &Description) -> Option<Self> {
        let variables = d.variables();
        let (base, screws, tool) = d.core();
        let mut word = Word { base, z: vec![], x: vec![], tool, joints: variables.len() };
        for screw in &screws {
            if screw.axis == Axis::X {
                word.x.push(*screw);
                continue;
            }
            let own = |kind: JointKind, e: Expr| {
                let used: Vec<usize> =
                    (0..variables.len()).filter(|&i| e.symbols().contains(&variables[i].symbol)).collect();
                match used[..] {
                    [] => Some((None, e)),
                    [joint] if variables[joint].kind == kind => {
                        let symbol = variables[joint].symbol;
                        [false, true].into_iter().find_map(|is_negative| {
                            let constant = normal(e - signed(symbol.into(), is_negative));
                            let is_constant = !constant.symbols().contains(&symbol);
                            is_constant.then_some((Some(Own { joint, is_negative }), constant))
                        })
                    }
                    _ => None,
                }
            };
            let (turns, angle) = own(JointKind::Revolute, screw.angle)?;
            let (slides, length) = own(JointKind::Prismatic, screw.length)?;
            if turns.is_none() && slides.is_none() {
                return None;
            }
            word.z.push(Moving { angle, length, turns, slides });
        }
        let joints = word.z.iter().map(|z| usize::from(z.turns.is_some()) + usize::from(z.slides.is_some()));
        if joints.sum::<usize>() != variables.len() || word.z.len() != word.x.len() + 1 {
            return None;
        }
        word.settle();
        Some(word)
    }

    /// Moves what an author may choose to where it is always the same.
    fn settle(&mut self) {
        let last = self.z.len() - 1;
        // Slides have no place: what stands across in front of one stands behind it as well.
        for k in 1..=last {
            if self.z[k].turns.is_none() {
                self.pass_slide(k);
            }
        }
        // What commutes with all joints before it belongs to the base.
        for k in 0..=last {
            let mut before = Transform::identity();
            for i in 0..k {
                before = before * self.rest(i) * self.x[i].transform();
            }
            let slides_only = self.z[..k].iter().all(|z| z.turns.is_none());
            let parallel = self.x[..k].iter().all(is_parallel);
            if (slides_only || parallel) && self.z[k].slides.is_none() {
                let length = std::mem::replace(&mut self.z[k].length, Expr::int(0));
                let along = before.rotation.z().scale(length);
                self.base = self.base * Transform::translation(along[0], along[1], along[2]);
            }
            if slides_only && self.z[k].turns.is_none() && k < last {
                let length = std::mem::replace(&mut self.x[k].length, Expr::int(0));
                let turn = Transform::rotation_about(Axis::Z, self.z[k].angle);
                let along = (before * turn).rotation.x().scale(length);
                self.base = self.base * Transform::translation(along[0], along[1], along[2]);
            }
        }
        // What commutes with all joints behind it belongs to the tool.
        for k in (0..=last).rev() {
            let slides_only = self.z[k + 1..].iter().all(|z| z.turns.is_none());
            let parallel = self.x[k..].iter().all(is_parallel);
            if (slides_only || parallel) && self.z[k].slides.is_none() {
                let length = std::mem::replace(&mut self.z[k].length, Expr::int(0));
                self.pass_to_tool(k, [Expr::int(0), Expr::int(0), length]);
            }
            if slides_only && k < last {
                let length = std::mem::replace(&mut self.x[k].length, Expr::int(0));
                self.pass_to_tool(k, [length, Expr::int(0), Expr::int(0)]);
            }
        }
        // A length along parallel axes stands behind the last of them, or is one of a slide's.
        for k in 0..last {
            if !is_parallel(&self.x[k]) || self.z[k].slides.is_some() {
                continue;
            }
            let length = std::mem::replace(&mut self.z[k].length, Expr::int(0));
            let next = &mut self.z[k + 1].length;
            *next = normal(*next + length * self.x[k].angle.cos());
        }
        for k in (1..=last).rev() {
            if is_parallel(&self.x[k - 1]) && self.z[k].slides.is_none() && self.has_slide_before(k) {
                let length = std::mem::replace(&mut self.z[k].length, Expr::int(0));
                let before = &mut self.z[k - 1].length;
                *before = normal(*before + length * self.x[k - 1].angle.cos());
            }
        }
        // A constant turn beside the first joint's is one of the base, beside the last joint's one of the tool.
        let turn =
            |angle: &mut Expr| Transform::rotation_about(Axis::Z, std::mem::replace(angle, Expr::int(0)));
        self.base = self.base * turn(&mut self.z[0].angle);
        if last > 0 {
            self.tool = turn(&mut self.z[last].angle) * self.tool;
        }
    }

    /// True if an axis parallel to this one, in front of it with parallel ones between, slides.
    fn has_slide_before(&self, k: usize) -> bool {
        let parallel = (0..k).rev().take_while(|&i| is_parallel(&self.x[i]));
        parallel.into_iter().any(|i| self.z[i].slides.is_some())
    }

    /// The constant of a motion.
    fn rest(&self, k: usize) -> Transform<Expr> {
        Screw { axis: Axis::Z, angle: self.z[k].angle, length: self.z[k].length }.transform()
    }

    /// Moves a length behind the turn about z of joint `k` into the tool.
    fn pass_to_tool(&mut self, k: usize, length: [Expr; 3]) {
        let mut rotation = Rotation::identity();
        for i in k..self.x.len() {
            rotation = rotation * Rotation::about(Axis::X, self.x[i].angle);
            if self.z[i + 1].turns.is_none() {
                rotation = rotation * Rotation::about(Axis::Z, self.z[i + 1].angle);
            }
        }
        // Along parallel axes that turn, the length is along all of them.
        let v = rotation.inverse() * Vector(length);
        self.tool = Transform::translation(v[0], v[1], v[2]) * self.tool;
    }

    /// Moves the length across in front of a slide behind it, where it is one of the table's there.
    fn pass_slide(&mut self, k: usize) {
        let length = self.x[k - 1].length;
        if length.is_zero() {
            return;
        }
        // Tx(a)·Rz(θ) = Rz(θ)·T(a cos θ, −a sin θ, 0)
        let (s, c) = self.z[k].angle.sin_cos();
        let (x, y) = (length * c, -(length * s));
        if k == self.x.len() {
            self.x[k - 1].length = Expr::int(0);
            self.tool = Transform::translation(x, y, Expr::int(0)) * self.tool;
        } else if s.is_zero() {
            self.x[k - 1].length = Expr::int(0);
            self.x[k].length = normal(self.x[k].length + x);
        } else if c.is_zero() && self.x[k].angle.cos().is_zero() {
            // Ty(b)·Rx(α) = Rx(α)·Tz(−b sin α) where cos α = 0
            self.x[k - 1].length = Expr::int(0);
            let along = -(y * self.x[k].angle.sin());
            self.z[k + 1].length = normal(self.z[k + 1].length + along);
        }
    }

    /// True if nothing is left that an author may choose but the way round.
    fn is_canonical(&self) -> bool {
        let of_slide = |k: usize| self.z[k].turns.is_none();
        (1..self.z.len())
            .all(|k| !of_slide(k) || self.x[k - 1].length.is_zero() && !is_parallel(&self.x[k - 1]))
            && (0..self.x.len()).all(|k| !of_slide(k) || !is_parallel(&self.x[k]))
    }

    /// The pose of the tool.
    fn at(&self, q: &[f64], number: &impl Fn(Expr) -> f64) -> Transform<f64> {
        let mut x = self.base.map(number);
        for (k, z) in self.z.iter().enumerate() {
            let value =
                |own: Option<Own>| own.map_or(0.0, |o| if o.is_negative { -q[o.joint] } else { q[o.joint] });
            let angle = number(z.angle) + value(z.turns);
            let length = number(z.length) + value(z.slides);
            x = x * Transform::rotation_about(Axis::Z, angle) * Transform::translation_z(length);
            if let Some(screw) = self.x.get(k) {
                x = x * screw.transform().map(number);
            }
        }
        x * self.tool.map(number)
    }
}

fn signed(e: Expr, is_negative: bool) -> Expr {
    if is_negative { -e } else { e }
}

fn normal(e: Expr) -> Expr {
    Angle::of(e).to_expr()
}

/// An angle that is a number, in (−π, π].
fn within_turn(angle: Expr) -> Expr {
    let angle = normal(angle);
    match angle.eval(|_| None) {
        Ok(x) => normal(angle - Expr::pi() * Expr::int(2) * Expr::int((x / TAU - 1e-9).round() as i64)),
        Err(_) => angle,
    }
}

fn is_parallel(x: &Screw) -> bool {
    is_same(x.angle.sin(), Expr::int(0))
}

fn is_same(a: Expr, b: Expr) -> bool {
    a == b || equal(a, b).is_equal()
}

/// True for a whole number of turns.
fn is_turn(angle: Expr) -> bool {
    let angle = normal(angle);
    angle.is_zero() || is_same(angle.cos(), Expr::int(1))
}

/// The same with entries in their normal form.
fn tidy(x: Transform<Expr>) -> Transform<Expr> {
    if is_identity(&x) { Transform::identity() } else { x }
}

/// True if a transform is proved to move nothing.
fn is_identity(x: &Transform<Expr>) -> bool {
    let (m, one) = (x.matrix(), Transform::<Expr>::identity().matrix());
    (0..12).all(|k| is_same(m[k / 4][k % 4], one[k / 4][k % 4]))
}
