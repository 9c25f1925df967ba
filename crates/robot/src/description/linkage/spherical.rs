//! Spherical loops: all axes turn and meet in one point, exactly. Then the closure is one of rotations alone.
//!
//! With three unknown angles, Rz(a)·K₁·Rz(b)·K₂·Rz(c)·K₃ = 1: the entry zz of K₁·Rz(b)·K₂ = Rz(−a)·K₃ᵀ·Rz(−c) gives b, which has two
//! values, the third row c, and the third column a.

use super::Linkage;
use super::dyad::Complex;
use crate::description::{Convention, Row};
use crate::geometry::{Axis, Rotation, Transform, Vector};
use crate::scalar::Scalar;
use denavit_symbolic::{Angle, Expr, Symbol, equal, readable};

/// A turn or a constant rotation on the way round a loop.
#[derive(Clone, Debug)]
enum Element {
    /// About z, by an angle that variables move.
    Turn(Angle),
    /// What is constant.
    Constant(Rotation<Expr>),
}

/// A spherical loop: the rotations around it.
#[derive(Clone, Debug)]
pub struct Spherical(Vec<Element>);

/// The rotations between three unknown turns, each with what is known of the turn before it.
#[derive(Clone, Debug)]
pub struct Between(pub [Rotation<Expr>; 3]);

fn is_zero(e: Expr) -> bool {
    equal(e, Expr::int(0)).is_equal()
}

impl Spherical {
    /// A loop, if all its axes turn and meet in one point.
    pub fn of(linkage: &Linkage, closure: usize) -> Option<Self> {
        let variables: Vec<Symbol> = linkage.variables().map(|v| v.symbol).collect();
        let moves = |e: Expr| e.symbols().iter().any(|s| variables.contains(s));
        let sides = linkage.sides(closure);
        if sides.iter().flatten().any(|row| moves(row.d)) {
            return None;
        }
        let before = |row: &Row| {
            let screws = row.screws(Convention::Khalil).before;
            screws.into_iter().fold(Transform::identity(), |x, s| x * s.transform()).map(readable::settled)
        };
        let whole = |row: &Row| {
            let screw = row.screws(Convention::Khalil).joint;
            (before(row) * screw.transform()).map(readable::settled)
        };
        // The point, in the frame in which the loop begins.
        let side = sides.iter().find(|side| side.iter().filter(|r| moves(r.theta)).count() > 1)?;
        let mut first: Option<Transform<Expr>> = None;
        let mut to = Transform::identity();
        let mut point = None;
        for row in side {
            match (moves(row.theta), first) {
                (false, _) => to = to * whole(row),
                (true, None) => {
                    first = Some(to * before(row));
                    to = Transform::translation_z(row.d);
                }
                (true, Some(x)) => {
                    // (0, 0, s) of the first axis lies on z of this one: both other coordinates are affine in s.
                    let back = (to * before(row)).inverse().map(readable::settled);
                    let (z, t) = (back.rotation.column(Axis::Z), back.translation);
                    let along = (0..2).find(|&i| !is_zero(z[i]))?;
                    let s = readable::settled(-t[along] / z[along]);
                    point = Some(x.act_on_point(Vector([Expr::int(0), Expr::int(0), s])));
                    break;
                }
            }
        }
        let point = point?;
        let mut elements = vec![];
        let mut ends = vec![];
        for (k, side) in sides.iter().enumerate() {
            let mut at = point;
            let mut own = vec![];
            for row in side {
                let x = if moves(row.theta) { before(row) } else { whole(row) };
                at = x.inverse().act_on_point(at).map(readable::settled);
                own.push(Element::Constant(x.rotation));
                if moves(row.theta) {
                    if !is_zero(at[0]) || !is_zero(at[1]) {
                        return None;
                    }
                    own.push(Element::Turn(Angle::of(row.theta)));
                    at = Vector([at[0], at[1], readable::settled(at[2] - row.d)]);
                }
            }
            ends.push(at);
            if k == 1 {
                own.reverse();
                for element in &mut own {
                    *element = match element {
                        Element::Turn(angle) => {
                            Element::Turn(angle.scaled(&-denavit_symbolic::Rational::ONE))
                        }
                        Element::Constant(r) => Element::Constant(r.inverse()),
                    };
                }
            }
            elements.extend(own);
        }
        let meets = (0..3).all(|i| is_zero(ends[0][i] - ends[1][i]));
        meets.then_some(Spherical(elements))
    }

    /// The three unknown turns in order, each a symbol with its sign, and the rotations between them; nothing where other than three
    /// are unknown, or one stands with a factor or with another.
    pub(super) fn between(&self, unknown: &[Symbol]) -> Option<([(Symbol, i64); 3], Between)> {
        let own = |angle: &Angle| -> Vec<(Symbol, i64)> {
            let all = angle.terms.iter().filter_map(|t| {
                let symbol = t.0.as_symbol().filter(|s| unknown.contains(s))?;
                Some((symbol, t.1.to_integer().unwrap_or(0)))
            });
            all.collect()
        };
        let mut places = vec![];
        for (at, element) in self.0.iter().enumerate() {
            let Element::Turn(angle) = element else { continue };
            match own(angle)[..] {
                [] => {}
                [(symbol, sign)] if sign.abs() == 1 => places.push((at, symbol, sign)),
                _ => return None,
            }
        }
        let [a, b, c] = places[..] else { return None };
        if a.1 == b.1 || b.1 == c.1 || a.1 == c.1 {
            return None;
        }
        let n = self.0.len();
        let rotation = |from: usize, to: usize| {
            let mut r = Rotation::identity();
            let mut at = from;
            loop {
                r = match &self.0[at % n] {
                    Element::Constant(x) => r * *x,
                    Element::Turn(angle) if at == from => {
                        let rest = angle
                            .terms
                            .iter()
                            .filter(|t| t.0.as_symbol().is_none_or(|s| !unknown.contains(&s)));
                        let rest = Angle { terms: rest.cloned().collect(), ..angle.clone() };
                        r * Rotation::about_z(rest.to_expr())
                    }
                    Element::Turn(angle) => r * Rotation::about_z(angle.to_expr()),
                };
                at += 1;
                if at % n == to % n {
                    return r;
                }
            }
        };
        let between = [rotation(a.0, b.0), rotation(b.0, c.0), rotation(c.0, a.0 + n)];
        Some(([(a.1, a.2), (b.1, b.2), (c.1, c.2)], Between(between)))
    }
}

/// What the angle b stands in: A·cos b + B·sin b = D.
pub fn type_2<T: Scalar>([k1, k2, k3]: &[Rotation<T>; 3]) -> [T; 3] {
    let (row, column) = (k1.rows()[2], k2.column(Axis::Z));
    let (x, y, w) = (row[0], row[1], row[2]);
    let (u, v, t) = (column[0], column[1], column[2]);
    [x * u + y * v, y * u - x * v, k3.rows()[2][2] - w * t]
}

/// What the root is taken of: A² + B² − D².
pub fn spherical_square<T: Scalar>(k: &[Rotation<T>; 3]) -> T {
    let [a, b, d] = type_2(k);
    a * a + b * b - d * d
}

/// e(a), e(b) and e(c); h is the root of [`spherical_square`] with its sign.
pub fn spherical<T: Scalar>(k: &[Rotation<T>; 3], h: T) -> [Complex<T>; 3] {
    let [a, b, d] = type_2(k);
    let eb = Complex::new(a * d - b * h, b * d + a * h).over(a * a + b * b);
    let m = k[0] * Rotation::from_sin_cos(Axis::Z, eb.im, eb.re) * k[1];
    // N = K₃ᵀ = Rz(a)·M·Rz(c): its third row is that of M turned by −c, its third column that of M turned by a.
    let n = k[2].inverse();
    let row = |r: &Rotation<T>| Complex::new(r.rows()[2][0], r.rows()[2][1]);
    let column = |r: &Rotation<T>| Complex::new(r.rows()[0][2], r.rows()[1][2]);
    let ec = (row(&m) * row(&n).conj()).over(row(&n).square());
    let ea = (column(&n) * column(&m).conj()).over(column(&m).square());
    [ea, eb, ec]
}
