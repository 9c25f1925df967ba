//! Torques proved by expansion: the program's results and Lagrange's equations as polynomials in normal form.
//!
//! Atoms are sines and cosines of angles, displacements, their rates and accelerations, and parameters; C² + S² = 1 leaves one form of
//! each value. Two things keep the forms small. The coordinates are the angles of successive parallel axes from the first of them, of
//! which programs take sines; torques at the joints follow from those at the coordinates, τ = Gᵀ τ' with x = G q, as Lagrange's equations
//! do. And the kinetic energy is had from velocities in the links' own frames: T = ½ Σ (ωᵀJω + 2 MS·(V × ω) + M V²).

mod packed;
mod ring;

use super::model::Formulas;
use crate::description::JointKind;
use crate::geometry::Rotation;
use denavit_program::{Op, Program, Value};
use denavit_symbolic::{Expr, Rational, Symbol};
use packed::{Atom, LONG, NARROW, Poly, WIDE};
use ring::{Coordinate, MULTIPLE, Ring, Sum, sum, transposed};
use rustc_hash::FxHashMap;

/// Monomials have too few words.
struct TooNarrow;

/// Whether the torques of a program in base parameters are proved to be those of Lagrange's equations. Not, if a value has no such
/// form, or one that is too large.
pub(super) fn are_lagranges(formulas: &Formulas, base: &FxHashMap<Symbol, Expr>, torques: &Program) -> bool {
    let widths = [are_lagranges_in::<NARROW>, are_lagranges_in::<LONG>, are_lagranges_in::<WIDE>];
    widths.into_iter().find_map(|in_width| in_width(formulas, base, torques).ok()).unwrap_or(false)
}

fn are_lagranges_in<const W: usize>(
    formulas: &Formulas,
    base: &FxHashMap<Symbol, Expr>,
    torques: &Program,
) -> Result<bool, TooNarrow> {
    let mut ring = Ring::<W>::default();
    let mut are_equal = || {
        let arm = Arm::new(formulas, &mut ring)?;
        let wanted = lagrange(formulas, &arm, &mut ring)?;
        Some(expanded(formulas, base, torques, &arm, &mut ring)? == wanted)
    };
    let found = are_equal().unwrap_or(false);
    if ring.is_full { Err(TooNarrow) } else { Ok(found) }
}

/// Whether the results of two programs of an arm are proved to be equal.
pub(super) fn are_equal(formulas: &Formulas, a: &Program, b: &Program) -> bool {
    let widths = [are_equal_in::<NARROW>, are_equal_in::<LONG>, are_equal_in::<WIDE>];
    widths.into_iter().find_map(|in_width| in_width(formulas, a, b).ok()).unwrap_or(false)
}

fn are_equal_in<const W: usize>(formulas: &Formulas, a: &Program, b: &Program) -> Result<bool, TooNarrow> {
    let (mut ring, none) = (Ring::<W>::default(), FxHashMap::default());
    let mut are_equal = || {
        let arm = Arm::new(formulas, &mut ring)?;
        let [a, b] = [a, b].map(|program| expanded(formulas, &none, program, &arm, &mut ring));
        Some(a? == b?)
    };
    let found = are_equal().unwrap_or(false);
    if ring.is_full { Err(TooNarrow) } else { Ok(found) }
}

/// The arm in coordinates of its own: the angles of groups of parallel axes from their beginning, displacements. So no sine of a sum
/// is written out.
struct Arm<const W: usize> {
    /// For each axis its turn as a sum, or its displacement, with its rate.
    turns: Vec<Sum>,
    slides: Vec<Poly<W>>,
    rates: Vec<Poly<W>>,
    coordinates: Vec<Coordinate>,
    /// Rates and accelerations of the coordinates.
    moving: Vec<[Atom; 2]>,
    /// How the coordinates vary with the joint variables.
    slopes: Vec<Vec<Poly<W>>>,
    /// The joint variables as sums of angles, or as lengths; their rates and accelerations, signs of the rates where Coulomb's
    /// friction asks for them.
    angles: FxHashMap<Symbol, Sum>,
    joints: FxHashMap<Symbol, Poly<W>>,
    signs: Vec<Option<Poly<W>>>,
}

impl<const W: usize> Arm<W> {
    fn new(formulas: &Formulas, ring: &mut Ring<W>) -> Option<Self> {
        let n = formulas.q.len();
        let mut arm = Arm {
            turns: vec![],
            slides: vec![],
            rates: vec![],
            coordinates: vec![],
            moving: vec![],
            slopes: vec![],
            angles: FxHashMap::default(),
            joints: FxHashMap::default(),
            signs: vec![],
        };
        // The angle of the group so far, with its slopes.
        let (mut group, mut group_slopes) = (Sum::default(), vec![Poly::zero(); n]);
        for (k, link) in formulas.dynamics.links.iter().enumerate() {
            // Trees have no such form here.
            if link.parent != k.checked_sub(1) {
                return None;
            }
            if k == 0 || link.before.rotation != Rotation::identity() {
                (group, group_slopes) = (Sum::default(), vec![Poly::zero(); n]);
            }
            let is_turn = link.kind == JointKind::Revolute;
            let mut own_slopes = vec![Poly::zero(); n];
            for &(j, by) in &link.value.terms {
                own_slopes[j] = own_slopes[j].plus(&ring.constant(by)?);
            }
            let is_known = |j: usize| arm.joints.contains_key(&formulas.qd[j]);
            let new: Vec<usize> = (0..n).filter(|&j| !own_slopes[j].is_zero() && !is_known(j)).collect();
            match new[..] {
                [] => {}
                [j] => {
                    // q = (x − the rest)/k
                    let by = own_slopes[j].as_constant()?.recip()?;
                    let of_group = if is_turn { group_slopes.clone() } else { vec![Poly::zero(); n] };
                    let slopes: Vec<Poly<W>> = (0..n).map(|i| own_slopes[i].plus(&of_group[i])).collect();
                    let [rate, change] = [ring.free()?, ring.free()?];
                    if is_turn {
                        let times = by.to_integer().filter(|k| k.abs() == 1)?;
                        let angle = ring.angle()?;
                        let mut own = Sum::of(angle);
                        own.add(&group, -1)?;
                        let mut rest = ring.sum(link.value.offset, &arm.angles)?;
                        rest.add_quarters(link.value.quarters);
                        for &(i, k) in link.value.terms.iter().filter(|t| t.0 != j) {
                            let k = whole(k)?;
                            rest.add(arm.angles.get(&formulas.q[i])?, k)?;
                        }
                        own.add(&rest, -1)?;
                        let mut joint = Sum::default();
                        joint.add(&own, times)?;
                        arm.angles.insert(formulas.q[j], joint);
                        arm.coordinates.push(Coordinate::Angle(angle));
                    } else {
                        let x = ring.free()?;
                        let mut rest = ring.constant(link.value.offset)?;
                        for i in (0..n).filter(|&i| i != j && !own_slopes[i].is_zero()) {
                            let other = arm.joints.get(&formulas.q[i])?.clone();
                            rest = rest.plus(&ring.mul(&own_slopes[i], &other)?);
                        }
                        let value = Poly::atom(x).minus(&rest).scaled(&by);
                        arm.joints.insert(formulas.q[j], value);
                        arm.coordinates.push(Coordinate::Length(x));
                    }
                    for (atom, symbols) in [(rate, &formulas.qd), (change, &formulas.qdd)] {
                        let mut value = Poly::atom(atom);
                        for i in (0..n).filter(|&i| i != j && !slopes[i].is_zero()) {
                            let other = arm.joints.get(&symbols[i])?.clone();
                            value = value.minus(&ring.mul(&slopes[i], &other)?);
                        }
                        // What the group turns by this joint alone.
                        let by = slopes[j].as_constant()?.recip()?;
                        arm.joints.insert(symbols[j], value.scaled(&by));
                    }
                    arm.moving.push([rate, change]);
                    arm.slopes.push(slopes);
                }
                _ => return None,
            }
            let mut turn = Sum::default();
            let mut slide = Poly::zero();
            let mut rate = Poly::zero();
            for (j, slope) in own_slopes.iter().enumerate().filter(|s| !s.1.is_zero()) {
                let of_joint = arm.joints.get(&formulas.qd[j])?.clone();
                rate = rate.plus(&ring.mul(slope, &of_joint)?);
            }
            if is_turn {
                turn = ring.sum(link.value.offset, &arm.angles)?;
                turn.add_quarters(link.value.quarters);
                for &(j, k) in &link.value.terms {
                    turn.add(arm.angles.get(&formulas.q[j])?, whole(k)?)?;
                }
                group.add(&turn, 1)?;
                for (all, own) in group_slopes.iter_mut().zip(&own_slopes) {
                    *all = all.plus(own);
                }
            } else {
                slide = ring.constant(link.value.offset)?;
                for (j, slope) in own_slopes.iter().enumerate().filter(|s| !s.1.is_zero()) {
                    let of_joint = arm.joints.get(&formulas.q[j])?.clone();
                    slide = slide.plus(&ring.mul(slope, &of_joint)?);
                }
            }
            arm.turns.push(turn);
            arm.slides.push(slide);
            arm.rates.push(rate);
        }
        for drive in &formulas.dynamics.drives {
            arm.signs.push(if drive.coulomb.is_zero() { None } else { Some(Poly::atom(ring.free()?)) });
        }
        (arm.coordinates.len() == n).then_some(arm)
    }
}

/// How often a joint's angle counts in an axis' one.
fn whole(k: Expr) -> Option<i64> {
    k.as_number()?.to_integer().filter(|k| k.unsigned_abs() <= MULTIPLE)
}

/// The torques at the joints by Lagrange's equations, from the energies of the links, whose frames are carried from the base.
fn lagrange<const W: usize>(formulas: &Formulas, arm: &Arm<W>, ring: &mut Ring<W>) -> Option<Vec<Poly<W>>> {
    let o = || [Poly::zero(), Poly::zero(), Poly::zero()];
    let (mut turning, mut velocity) = (o(), o());
    let one = |i: usize| [0, 1, 2].map(|j| if i == j { Poly::one() } else { Poly::zero() });
    // The axes of the base in the link, and where its origin is, along the axes of the base.
    let mut frame = [one(0), one(1), one(2)];
    let mut origin = o();
    let (mut twice, mut weight) = (Poly::zero(), Poly::zero());
    let mut gravity = o();
    for (own, e) in gravity.iter_mut().zip(formulas.dynamics.gravity.0) {
        *own = ring.constant(e)?;
    }
    for (k, link) in formulas.dynamics.links.iter().enumerate() {
        let mut rotation = [o(), o(), o()];
        for (row, given) in rotation.iter_mut().zip(link.before.rotation.rows()) {
            for (own, e) in row.iter_mut().zip(given) {
                *own = ring.constant(e)?;
            }
        }
        let mut offset = o();
        for (i, e) in link.before.translation.0.into_iter().enumerate() {
            let along = ring.mul(&rotation[i][2], &arm.slides[k])?;
            offset[i] = ring.constant(e)?.plus(&along);
        }
        let (s, c) = ring.pair(&arm.turns[k])?;
        let turn = [[c.clone(), Poly::zero().minus(&s), Poly::zero()], [s, c, Poly::zero()], one(2)];
        let columns = transposed(&turn);
        let mut place = [o(), o(), o()];
        for (row, constant) in place.iter_mut().zip(&rotation) {
            *row = ring.times(&columns, constant)?;
        }
        let back = transposed(&place);
        let lever = ring.cross(&turning, &offset)?;
        velocity = ring.times(&back, &sum(&velocity, &lever))?;
        turning = ring.times(&back, &turning)?;
        let moved = ring.times(&frame, &offset)?;
        origin = sum(&origin, &moved);
        for row in &mut frame {
            *row = ring.times(&back, row)?;
        }
        let axis = match link.kind {
            JointKind::Revolute => &mut turning[2],
            JointKind::Prismatic => &mut velocity[2],
        };
        *axis = axis.plus(&arm.rates[k]);
        // 2T = ωᵀJω + 2 MS·(V × ω) + M V²,   V = −gᵀ(M p + R MS)
        let mut inertia = vec![];
        for e in link.body.inertia {
            inertia.push(ring.constant(e)?);
        }
        let mut first = o();
        for (own, e) in first.iter_mut().zip(link.body.first_moment.0) {
            *own = ring.constant(e)?;
        }
        let mass = ring.constant(link.body.mass)?;
        for (place, (i, j)) in [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)].into_iter().enumerate() {
            let square = ring.mul(&turning[i], &turning[j])?;
            let part = ring.mul(&inertia[place], &square)?;
            twice = twice.plus(&part);
            if i != j {
                twice = twice.plus(&part);
            }
        }
        let across = ring.cross(&velocity, &turning)?;
        let crossed = ring.dot(&first, &across)?;
        let square = ring.dot(&velocity, &velocity)?;
        twice = twice.plus(&crossed).plus(&crossed).plus(&ring.mul(&mass, &square)?);
        let of_mass = ring.scaled(&origin, &mass)?;
        let moved = ring.times(&frame, &first)?;
        weight = weight.plus(&ring.dot(&gravity, &sum(&of_mass, &moved))?);
    }
    let kinetic = twice.scaled(&Rational::new(1, 2));
    let mut generalised = vec![];
    for (k, &x) in arm.coordinates.iter().enumerate() {
        let momentum = ring.slope(&kinetic, Coordinate::Length(arm.moving[k][0]))?;
        let mut force = Poly::zero().minus(&ring.slope(&kinetic, x)?.plus(&ring.slope(&weight, x)?));
        for (i, &y) in arm.coordinates.iter().enumerate() {
            let [rate, change] = arm.moving[i];
            let by_place = ring.slope(&momentum, y)?;
            let by_rate = ring.slope(&momentum, Coordinate::Length(rate))?;
            let (a, b) = (ring.mul(&by_place, &Poly::atom(rate))?, ring.mul(&by_rate, &Poly::atom(change))?);
            force = force.plus(&a).plus(&b);
        }
        generalised.push(force);
    }
    let mut torques = vec![];
    for (j, drive) in formulas.dynamics.drives.iter().enumerate() {
        let mut torque = Poly::zero();
        for (k, force) in generalised.iter().enumerate() {
            torque = torque.plus(&ring.mul(&arm.slopes[k][j], force)?);
        }
        let [rate, change] = [formulas.qd[j], formulas.qdd[j]].map(|s| arm.joints.get(&s).cloned());
        let way = arm.signs[j].clone().unwrap_or_else(Poly::zero);
        let moving = [(drive.rotor, change?), (drive.viscous, rate?), (drive.coulomb, way)];
        for (e, by) in moving {
            let e = ring.constant(e)?;
            torque = torque.plus(&ring.mul(&e, &by)?);
        }
        torques.push(torque);
    }
    Some(torques)
}

/// The results of a program.
fn expanded<const W: usize>(
    formulas: &Formulas,
    base: &FxHashMap<Symbol, Expr>,
    program: &Program,
    arm: &Arm<W>,
    ring: &mut Ring<W>,
) -> Option<Vec<Poly<W>>> {
    let mut formula: Vec<Option<Expr>> = vec![];
    let mut values: Vec<Option<Poly<W>>> = vec![];
    for (op, _) in program.ops() {
        // Sums of inputs as formulas, for sines and cosines.
        let of = |n: &u32| formula[*n as usize];
        let both = |a: &u32, b: &u32| of(a).zip(of(b));
        let angle = match op {
            Op::Number(r) => Some(Expr::from(r.clone())),
            Op::Pi => Some(Expr::pi()),
            Op::Input(s) => Some(Expr::from(*s)),
            Op::Add(a, b) => both(a, b).map(|(a, b)| a + b),
            Op::Sub(a, b) => both(a, b).map(|(a, b)| a - b),
            Op::Mul(a, b) => both(a, b)
                .filter(|(a, b)| a.as_number().is_some() || b.as_number().is_some())
                .map(|(a, b)| a * b),
            Op::Div(a, b) => both(a, b).filter(|(_, b)| b.as_number().is_some()).map(|(a, b)| a / b),
            Op::Sqrt(_) | Op::Sin(_) | Op::Cos(_) | Op::Atan2(..) | Op::Sign(_) => None,
        };
        let at = |n: &u32| values[*n as usize].as_ref();
        let pair = |a: &u32, b: &u32| at(a).zip(at(b));
        let value = match op {
            Op::Number(r) => Some(Poly::constant(r.clone())),
            Op::Input(s) => match (arm.joints.get(s), base.get(s)) {
                (Some(known), _) => Some(known.clone()),
                (None, Some(&value)) => Some(ring.constant(value)?),
                (None, None) if arm.angles.contains_key(s) => None,
                (None, None) => Some(ring.parameter(*s)?),
            },
            Op::Add(a, b) => match pair(a, b) {
                Some((a, b)) => Some(ring.plus(a, b)?),
                None => None,
            },
            Op::Sub(a, b) => match pair(a, b) {
                Some((a, b)) => Some(ring.minus(a, b)?),
                None => None,
            },
            Op::Mul(a, b) => match pair(a, b) {
                Some((a, b)) => Some(ring.mul(a, b)?),
                None => None,
            },
            Op::Div(a, b) => match pair(a, b) {
                Some((a, b)) => {
                    let over = ring.inverse(b)?;
                    Some(ring.mul(a, &over)?)
                }
                None => None,
            },
            Op::Sin(a) | Op::Cos(a) => {
                let sum = ring.sum(of(a)?, &arm.angles)?;
                let (s, c) = ring.pair(&sum)?;
                Some(if matches!(op, Op::Sin(_)) { s } else { c })
            }
            Op::Sign(a) => {
                let rate = of(a)?.as_symbol()?;
                let joint = formulas.qd.iter().position(|s| *s == rate)?;
                arm.signs[joint].clone()
            }
            Op::Sqrt(a) if !a.negative => match at(&a.node).and_then(Poly::as_constant) {
                Some(square) => Some(ring.root(&square)?),
                None => None,
            },
            Op::Pi | Op::Sqrt(_) | Op::Atan2(..) => None,
        };
        formula.push(angle);
        values.push(value);
    }
    let signed = |v: &Value| {
        let value = values[v.node as usize].as_ref()?;
        Some(if v.negative { Poly::zero().minus(value) } else { value.clone() })
    };
    program.outputs().iter().map(|o| signed(&o.1)).collect()
}
