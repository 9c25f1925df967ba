//! A step of a plan in numbers.

use super::Open;
use crate::description::linkage::dyad::{
    Complex, rpr, rpr_square, rrp, rrp_square, rrr, rrr_mirrored, rrr_square, slides,
};
use crate::description::linkage::spherical::{spherical, spherical_square, type_2};
use crate::description::linkage::{Dyad, Sign, Step, Vectors};
use crate::geometry::Rotation;
use crate::space::wrapped;
use denavit_program::{Function, Graph, Program};
use denavit_symbolic::{Angle, Expr, Symbol};
use rustc_hash::FxHashSet;

/// Roots of what is less than this, of what it is a difference of, are 0: both solutions meet.
const FLAT: f64 = 1e-14;

/// Whether two solutions are apart.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Met {
    /// They are, or there is but one.
    Apart,
    /// They are the same: a flat configuration, or a dead point.
    Meets,
}

/// A step over all variables.
pub(super) struct Compiled {
    pub closure: usize,
    kind: Kind,
    /// The turn, two numbers of each sum of vectors, then the angles of affine solutions.
    known: Function,
    angles: Vec<(usize, [f64; 3])>,
    slides: Vec<usize>,
}

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Turns,
    Slide,
    Cylinder,
    Slides,
    Spherical,
}

impl Compiled {
    /// A step of a linkage in numbers, the variables of which are these.
    pub fn of(step: &Step, symbols: &[Symbol]) -> Self {
        let place = |s: Symbol| symbols.iter().position(|x| *x == s).unwrap_or_default();
        let (kind, vectors, affine): (Kind, Vec<&Vectors>, &[[Angle; 2]]) = match &step.dyad {
            Dyad::Turns { a, b, p, affine } => (Kind::Turns, vec![a, b, p], affine),
            Dyad::Slide { a, u, p, .. } => (Kind::Slide, vec![a, u, p], &[]),
            Dyad::Cylinder { a, u, p, .. } => (Kind::Cylinder, vec![a, u, p], &[]),
            Dyad::Slides { along: [u, v], p, .. } => (Kind::Slides, vec![u, v, p], &[]),
            Dyad::Spherical(_) => (Kind::Spherical, vec![], &[]),
        };
        let mut graph = Graph::new(symbols, &[]);
        let sums = vectors.into_iter().flat_map(|v| {
            let sum = v.formula();
            [sum.re, sum.im]
        });
        let all = [step.turn.to_expr()].into_iter().chain(sums);
        let rotations: Vec<Expr> = match &step.dyad {
            Dyad::Spherical(between) => between.0.iter().flat_map(|r| r.rows().concat()).collect(),
            _ => vec![],
        };
        let all = all.chain(rotations).chain(affine.iter().flatten().map(Angle::to_expr));
        let results: Vec<_> = all.enumerate().map(|(k, e)| (format!("x{k}"), graph.trace(e))).collect();
        let taken: FxHashSet<String> = symbols.iter().map(|s| s.name().to_string()).collect();
        let program = Program::new(&graph, &results, |_| None, &taken);
        let found = step.unknowns();
        Compiled {
            closure: step.closure,
            kind,
            known: program.compile_with(|_| None).unwrap_or_else(|_| unreachable!("all values are there")),
            angles: step.angles.iter().map(|a| (place(a.symbol), a.of.map(|k| k as f64))).collect(),
            slides: found[step.angles.len()..].iter().map(|&s| place(s)).collect(),
        }
    }

    /// Finds the unknown variables from the others.
    pub fn solve(&self, all: &mut [f64], sign: Sign) -> Result<Met, Open> {
        let closure = self.closure;
        let known = self.known.scalar().eval(all).to_vec();
        if self.kind == Kind::Spherical {
            return self.solve_spherical(&known, all, sign);
        }
        let vector = |k: usize| Complex::new(known[2 * k + 1], known[2 * k + 2]);
        let [a, b, p] = [0, 1, 2].map(vector);
        let by = if sign == Sign::Minus { -1.0 } else { 1.0 };
        // The root, and whether both are one; `of` is what the square is a difference of.
        let root = |square: f64, of: f64, gap: f64| {
            let near = FLAT * of;
            match square {
                x if x > near => Ok((by * x.sqrt(), Met::Apart)),
                x if x >= -near && of > 0.0 => Ok((0.0, Met::Meets)),
                _ => Err(Open::Gap { closure, metres: Some(gap) }),
            }
        };
        let length = |z: Complex<f64>| z.square().sqrt();
        let indeterminate = Err(Open::Indeterminate { closure });
        let mut directions = [0.0; 2];
        let angle = |e: Complex<f64>| e.im.atan2(e.re);
        let met = match self.kind {
            Kind::Turns => {
                let scale = length(a).max(length(b)).max(length(p));
                if length(p) <= 1e-12 * scale || a.square() == 0.0 || b.square() == 0.0 {
                    return indeterminate;
                }
                let of = p.square() * a.square();
                let gap = (length(p) - length(a) - length(b)).max((length(a) - length(b)).abs() - length(p));
                let affine = |k: usize| [known[7 + 2 * k], known[8 + 2 * k]];
                let count = (known.len() - 7) / 2;
                match sign {
                    Sign::Affine | Sign::Crossed => {
                        let met = match rrr_square(a, b, p) <= FLAT * of {
                            true => Met::Meets,
                            false => Met::Apart,
                        };
                        directions = match sign == Sign::Affine || count > 1 {
                            true => affine(usize::from(sign == Sign::Crossed)),
                            false => {
                                let e1 = Complex::direction(affine(0)[0]);
                                rrr_mirrored(a, b, p, e1).map(angle)
                            }
                        };
                        met
                    }
                    _ => {
                        let (h, met) = root(rrr_square(a, b, p), of, gap)?;
                        directions = rrr(a, b, p, h).map(angle);
                        met
                    }
                }
            }
            Kind::Slide => {
                // a, u, p
                let of = a.square() * b.square();
                let across = (p * b.conj()).im.abs() / length(b);
                let (h, met) = root(rrp_square(a, b, p), of, across - length(a))?;
                let (e, r) = rrp(a, b, p, h);
                directions[0] = angle(e);
                all[self.slides[0]] = r;
                met
            }
            Kind::Cylinder => {
                let of = p.square() * b.square();
                let across = (a * b.conj()).im.abs() / length(b);
                if of == 0.0 {
                    return indeterminate;
                }
                let (h, met) = root(rpr_square(a, b, p), of, across - length(p))?;
                let (e, r) = rpr(a, b, p, h);
                directions[0] = angle(e);
                all[self.slides[0]] = r;
                met
            }
            Kind::Slides => {
                let (found, determinant) = slides(a, b, p);
                if determinant.abs() <= FLAT * length(a) * length(b) {
                    return indeterminate;
                }
                (all[self.slides[0]], all[self.slides[1]]) = (found[0], found[1]);
                Met::Apart
            }
            Kind::Spherical => unreachable!("it was solved above"),
        };
        for (place, [turn, one, two]) in &self.angles {
            all[*place] = wrapped(turn * known[0] + one * directions[0] + two * directions[1]);
        }
        Ok(met)
    }
}

impl Compiled {
    /// A spherical loop: `known` holds the three rotations from its second entry on.
    fn solve_spherical(&self, known: &[f64], all: &mut [f64], sign: Sign) -> Result<Met, Open> {
        let closure = self.closure;
        let k: [Rotation<f64>; 3] = std::array::from_fn(|n| {
            let at = |i: usize| known[1 + 9 * n + i];
            Rotation::from_rows([[at(0), at(1), at(2)], [at(3), at(4), at(5)], [at(6), at(7), at(8)]])
        });
        let ([a, b, d], square) = (type_2(&k), spherical_square(&k));
        let of = a * a + b * b;
        if of <= FLAT || 1.0 - k[2].rows()[2][2].abs() <= FLAT {
            return Err(Open::Indeterminate { closure });
        }
        let near = FLAT * (of + d * d);
        if square < -near {
            return Err(Open::Gap { closure, metres: None });
        }
        let met = if square <= near { Met::Meets } else { Met::Apart };
        let h = if met == Met::Meets { 0.0 } else { square.sqrt() };
        let found = spherical(&k, if sign == Sign::Minus { -h } else { h }).map(|e| e.im.atan2(e.re));
        for (place, of) in &self.angles {
            all[*place] = wrapped(of.iter().zip(found).map(|(k, x)| k * x).sum());
        }
        Ok(met)
    }
}
