//! The robot to compute with: constant transforms with a joint between each two.
//!
//! `x_ij` is frame j seen from frame i; frame i is rigidly attached behind row i of the table, frame 0 before row 1.

use super::walk::{Line, Reference};
pub use crate::description::MissingValue;
use crate::description::{Convention, Description, Row, Screw};
use crate::geometry::{Rotation, Transform, Vector};
use crate::scalar::Scalar;
use denavit_symbolic::{Angle, Expr, Rational, Symbol};
use std::f64::consts::FRAC_PI_2;

/// A serial chain over numbers or formulas.
#[derive(Clone, Debug)]
pub struct Robot<T> {
    /// Frame 0 in the base.
    pub base: Transform<T>,
    /// One link a row of the table.
    pub links: Vec<Link<T>>,
    /// The tool in the last frame.
    pub tool: Transform<T>,
    /// How many joint variables there are.
    pub joints: usize,
}

/// A row: constant, Rz(θ)·Tz(d), constant. Made by [`Link::new`], and not changed in place.
#[derive(Clone, Debug)]
pub struct Link<T> {
    /// What stands before the joint's screw.
    pub before: Transform<T>,
    /// The angle about z, radians.
    pub theta: Affine<T>,
    /// The displacement along z, metres.
    pub d: Affine<T>,
    /// What stands behind it.
    pub after: Transform<T>,
    /// Whether `before` and `after` do nothing: one of them does, in every convention.
    is_bare: [bool; 2],
}

/// `offset + quarters·π/2 + Σ kᵢ·q[i]`; the quarter turns are kept apart because their sines are exact.
#[derive(Clone, PartialEq, Debug)]
pub struct Affine<T> {
    /// The constant part.
    pub offset: T,
    /// Quarter turns, 0 to 3; 0 for a length.
    pub quarters: u8,
    /// Joint numbers (from 0) and their factors.
    pub terms: Vec<(usize, T)>,
}

impl<T: Scalar> Affine<T> {
    #[inline]
    fn linear(&self, q: &[T]) -> Option<T> {
        self.terms.iter().map(|&(j, k)| if k == T::one() { q[j] } else { k * q[j] }).reduce(|a, b| a + b)
    }

    /// The value at a configuration, quarter turns left aside.
    #[inline]
    pub(crate) fn value(&self, q: &[T]) -> T {
        match self.linear(q) {
            None => self.offset,
            Some(x) if self.offset == T::zero() => x,
            Some(x) => self.offset + x,
        }
    }

    /// The same with all joint variables 0.
    pub(crate) fn at_rest(&self) -> Self {
        Affine { terms: vec![], ..*self }
    }

    /// Sine and cosine at a configuration.
    #[inline]
    pub(crate) fn sin_cos(&self, q: &[T]) -> (T, T) {
        let (mut s, mut c) = self.value(q).sin_cos();
        for _ in 0..self.quarters {
            (s, c) = (c, -s);
        }
        (s, c)
    }
}

impl Affine<f64> {
    /// The constant part, with the quarter turns.
    pub fn constant(&self) -> f64 {
        self.offset + f64::from(self.quarters) * FRAC_PI_2
    }
}

impl<T: Scalar> Link<T> {
    /// The row of these parts.
    pub fn new(before: Transform<T>, theta: Affine<T>, d: Affine<T>, after: Transform<T>) -> Self {
        let is_bare = [before, after].map(|x| x == Transform::identity());
        Link { before, theta, d, after, is_bare }
    }

    /// True if a joint turns it.
    pub fn turns(&self) -> bool {
        !self.theta.terms.is_empty()
    }

    /// True if a joint slides it.
    pub fn slides(&self) -> bool {
        !self.d.terms.is_empty()
    }

    /// True if a joint moves it.
    pub fn moves(&self) -> bool {
        self.turns() || self.slides()
    }

    /// Frame i in frame i−1 at a configuration.
    #[inline]
    pub fn transform(&self, q: &[T]) -> Transform<T> {
        let (sin_cos, d) = (self.theta.sin_cos(q), self.d.value(q));
        let [is_first, is_last] = self.is_bare;
        if is_first {
            return screw_times(sin_cos, d, &self.after);
        }
        let x = times_screw(&self.before, sin_cos, d);
        if is_last { x } else { x * self.after }
    }

    /// For a place of the frame before the row: the row's axis, the z in which its screw stands, and the frame behind it.
    #[inline]
    pub fn step(&self, frame: &Transform<T>, q: &[T]) -> (Line<T>, Transform<T>) {
        (self.axis(frame), *frame * self.transform(q))
    }

    /// The row's axis, for a place of the frame before the row.
    #[inline]
    pub fn axis(&self, frame: &Transform<T>) -> Line<T> {
        if self.is_bare[0] {
            return Line::z_of(frame);
        }
        let direction = frame.rotation * self.before.rotation.z();
        Line { direction, point: frame.act_on_point(self.before.translation) }
    }
}

/// x · Rz(θ)·Tz(d)
#[inline]
fn times_screw<T: Scalar>(x: &Transform<T>, (s, c): (T, T), d: T) -> Transform<T> {
    let row = |[a, b, z]: [T; 3]| [a * c + b * s, a * -s + b * c, z];
    let rows = x.rotation.rows();
    let rows = [row(rows[0]), row(rows[1]), row(rows[2])];
    Transform::from_rotation_translation(Rotation::from_rows(rows), x.rotation.z().scale(d) + x.translation)
}

/// Rz(θ)·Tz(d) · x
#[inline]
fn screw_times<T: Scalar>((s, c): (T, T), d: T, x: &Transform<T>) -> Transform<T> {
    let ([a, b, z], Vector([p, q, r])) = (x.rotation.rows(), x.translation);
    let turned = |a: T, b: T| (c * a + -s * b, s * a + c * b);
    let [x, y, w] = [turned(a[0], b[0]), turned(a[1], b[1]), turned(a[2], b[2])];
    let (p, q) = turned(p, q);
    let rows = [[x.0, y.0, w.0], [x.1, y.1, w.1], z];
    Transform::from_rotation_translation(Rotation::from_rows(rows), Vector([p, q, r + d]))
}

impl<T: Scalar> Robot<T> {
    /// Frames 0 … n in the base: `frames[i]` is the frame behind row i.
    ///
    /// # Panics
    /// If `q` does not have one entry per joint.
    pub fn frames(&self, q: &[T]) -> Vec<Transform<T>> {
        assert_eq!(q.len(), self.joints, "one entry per joint");
        let mut x_0i = self.base;
        let mut frames = vec![x_0i];
        for link in &self.links {
            x_0i = x_0i * link.transform(q);
            frames.push(x_0i);
        }
        frames
    }

    /// The robot that ends with a frame: without the rows behind it.
    pub(crate) fn up_to(&self, frame: Reference) -> Self {
        let tool = if frame == Reference::Tool { self.tool } else { Transform::identity() };
        let base = if frame == Reference::Base { Transform::identity() } else { self.base };
        Robot { base, links: self.links[..self.rows_before(frame)].to_vec(), tool, joints: self.joints }
    }

    /// The tool in the base: base · ⁰Tₙ · tool.
    ///
    /// # Panics
    /// If `q` does not have one entry per joint.
    pub fn pose(&self, q: &[T]) -> Transform<T> {
        assert_eq!(q.len(), self.joints, "one entry per joint");
        self.links.iter().fold(self.base, |x, link| x * link.transform(q)) * self.tool
    }
}

impl Robot<Expr> {
    /// The robot over formulas.
    pub fn symbolic(description: &Description) -> Self {
        let variables: Vec<Symbol> = description.variables().iter().map(|v| v.symbol).collect();
        let links =
            description.rows.iter().map(|row| link_of(description.convention, row, &variables)).collect();
        Robot { base: description.base, links, tool: description.tool, joints: variables.len() }
    }
}

/// Displacements that undo each other are gathered where that makes the reach smaller by so much.
const MUCH: f64 = 4.0;

impl Robot<f64> {
    /// A length that no point of the hand is further from the [foot](Self::foot) than, slides left aside, metres: the sum
    /// of the robot's lengths. Long displacements along nearly parallel axes that undo each other, as calibrations have
    /// them, count for what is left of them.
    pub fn reach(&self) -> f64 {
        self.stand().1
    }

    /// Where the robot stands, in the base: the origin; of a robot that stands further away than it is long the point of
    /// its first axis that everything in front of it leads to.
    pub fn foot(&self) -> Vector<f64> {
        self.stand().0
    }

    /// The foot, and the reach from there.
    fn stand(&self) -> (Vector<f64>, f64) {
        let across = |l: &Link<f64>| l.before.translation.norm() + l.after.translation.norm();
        let ends = self.base.translation.norm() + self.tool.translation.norm();
        let across = ends + self.links.iter().map(across).sum::<f64>();
        let plain = across + self.links.iter().map(|l| l.d.offset.abs()).sum::<f64>();
        let gathered = across + self.gathered();
        let reach = if gathered < plain / MUCH { gathered } else { plain };
        let in_front = self.links.first().map_or(0.0, |l| l.before.translation.norm() + l.d.offset.abs());
        // Not from the sum: the rest would be what rounding leaves of it.
        let own = |l: &Link<f64>| l.after.translation.norm();
        let rest = self.tool.translation.norm()
            + self.links.first().map_or(0.0, own)
            + self
                .links
                .iter()
                .skip(1)
                .map(|l| l.before.translation.norm() + own(l) + l.d.offset.abs())
                .sum::<f64>();
        let foot = self.base.translation.norm() + in_front;
        if rest > 0.0 && foot > MUCH * rest && rest < reach {
            let along = Transform::translation_z(self.links[0].d.offset);
            ((self.base * self.links[0].before * along).translation, rest)
        } else {
            (Vector([0.0; 3]), reach)
        }
    }

    /// A bound on what the displacements along the axes add up to: what one has in common with the next is carried there.
    fn gathered(&self) -> f64 {
        let (mut sum, mut carried) = (0.0, 0.0);
        for (k, link) in self.links.iter().enumerate() {
            carried += link.d.offset;
            let Some(next) = self.links.get(k + 1) else { break };
            let between = link.after.rotation * next.before.rotation;
            let z = between.z();
            // The part across the next axis, and that along it.
            let rest = f64::hypot(z[0], z[1]) * carried.abs();
            if rest + (z[2] * carried + next.d.offset).abs() < carried.abs() + next.d.offset.abs() {
                sum += rest;
                carried *= z[2];
            } else {
                sum += carried.abs();
                carried = 0.0;
            }
        }
        sum + carried.abs()
    }

    /// The robot with some joints held at values: `held` are their numbers (from 0) and values; the others keep their
    /// order.
    pub fn held(&self, held: &[(usize, f64)]) -> Self {
        let value = |j: usize| held.iter().find(|h| h.0 == j).map(|h| h.1);
        let left: Vec<usize> = (0..self.joints).filter(|&j| value(j).is_none()).collect();
        let affine = |a: &Affine<f64>| Affine {
            offset: a.offset + a.terms.iter().filter_map(|&(j, k)| Some(k * value(j)?)).sum::<f64>(),
            quarters: a.quarters,
            terms: a
                .terms
                .iter()
                .filter_map(|&(j, k)| Some((left.iter().position(|&l| l == j)?, k)))
                .collect(),
        };
        let links = self.links.iter().map(|l| Link::new(l.before, affine(&l.theta), affine(&l.d), l.after));
        Robot { base: self.base, links: links.collect(), tool: self.tool, joints: left.len() }
    }

    /// The robot over numbers, with the values of its parameters.
    ///
    /// # Errors
    /// If a parameter that the table uses has no value.
    pub fn numeric(description: &Description) -> Result<Self, MissingValue> {
        let mut missing: Vec<String> = vec![];
        let mut number = |e: Expr| match e.eval(|s| description.value(s)) {
            Ok(x) => x,
            Err(s) => {
                let name = s.name().to_string();
                if !missing.contains(&name) {
                    missing.push(name);
                }
                0.0
            }
        };
        let symbolic = Robot::symbolic(description);
        let mut numeric = |x: &Transform<Expr>| x.map(&mut number);
        let (base, tool) = (numeric(&symbolic.base), numeric(&symbolic.tool));
        let mut links = vec![];
        for link in &symbolic.links {
            let (before, after) = (numeric(&link.before), numeric(&link.after));
            links.push((before, after));
        }
        let affine = |a: &Affine<Expr>, number: &mut dyn FnMut(Expr) -> f64| Affine {
            offset: number(a.offset),
            quarters: a.quarters,
            terms: a.terms.iter().map(|&(j, k)| (j, number(k))).collect(),
        };
        let links = links
            .into_iter()
            .zip(&symbolic.links)
            .map(|((before, after), link)| {
                let (theta, d) = (affine(&link.theta, &mut number), affine(&link.d, &mut number));
                Link::new(before, theta, d, after)
            })
            .collect();
        if missing.is_empty() {
            Ok(Robot { base, links, tool, joints: symbolic.joints })
        } else {
            Err(MissingValue { parameters: missing })
        }
    }
}

impl Link<Expr> {
    /// The link over numbers.
    pub(crate) fn in_numbers(&self, number: impl Fn(Expr) -> f64) -> Link<f64> {
        let affine = |a: &Affine<Expr>| Affine {
            offset: number(a.offset),
            quarters: a.quarters,
            terms: a.terms.iter().map(|&(j, k)| (j, number(k))).collect(),
        };
        Link::new(self.before.map(&number), affine(&self.theta), affine(&self.d), self.after.map(&number))
    }
}

/// A row as a link of a robot that has these variables.
pub(crate) fn link_of(convention: Convention, row: &Row, variables: &[Symbol]) -> Link<Expr> {
    let screws = row.screws(convention);
    let product = |screws: &[Screw]| {
        screws.iter().map(Screw::transform).reduce(|x, y| x * y).unwrap_or_else(Transform::identity)
    };
    let (theta, d) =
        (affine(screws.joint.angle, variables, true), affine(screws.joint.length, variables, false));
    Link::new(product(&screws.before), theta, d, product(&screws.behind))
}

fn affine(e: Expr, variables: &[Symbol], is_angle: bool) -> Affine<Expr> {
    let mut form = Angle::of(e);
    let mut terms = vec![];
    form.terms.retain(|(x, k)| {
        let joint = x.as_symbol().and_then(|s| variables.iter().position(|&v| v == s));
        terms.extend(joint.map(|j| (j, Expr::from(k.clone()))));
        joint.is_none()
    });
    let mut quarters = 0;
    if is_angle {
        let turns = &form.turns * &Rational::from(2);
        let whole = turns.floor();
        form.turns = &form.turns - &(&whole / &Rational::from(2));
        let four = Rational::from(4);
        let rest = &whole - &(&(&whole / &four).floor() * &four);
        quarters = rest.to_integer().and_then(|n| u8::try_from(n).ok()).unwrap_or(0);
    }
    Affine { offset: form.to_expr(), quarters, terms }
}
