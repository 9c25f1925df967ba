//! All useful scalar equations of Z₁ C₁ … Zₙ = U.
//!
//! For two cuts of the chain, left · middle · right = U gives middle = left⁻¹ · U · right⁻¹: nine entries of the
//! rotation, three of the position, three of the position of the inverse. Sums of squares of positions are formed when
//! it is known which components still hold an unknown ([`Split`]).

use super::algebra::{Column, Matrix, transposed};
use super::chain::NormalChain;
use denavit_symbolic::Rational;
use denavit_symbolic::poly::{Atom, Monomial, Poly};
use rustc_hash::FxHashSet;
use std::cell::Cell;

/// What of the hand is given.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Goal {
    /// Position and orientation.
    Pose,
    /// The position of the tool.
    Position,
    /// The position of the tool and the direction of its z axis.
    PositionAndAxis,
}

/// Which element of which product an equation is.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, PartialOrd, Ord)]
pub enum Entry {
    /// An element of the rotation, row and column from 0.
    Rotation(usize, usize),
    /// An element of the position.
    Position(usize),
    /// An element of the position of the inverse.
    Inverse(usize),
}

/// Where an equation comes from: what stands left of element `left` and from element `right` on is moved to the side of
/// the pose.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, PartialOrd, Ord)]
pub struct Source {
    /// The first element of the middle part.
    pub left: usize,
    /// The element behind the middle part.
    pub right: usize,
    /// Which element of the two sides.
    pub entry: Entry,
}

/// `pose = chain`.
#[derive(Clone, Debug)]
pub struct Equation {
    /// Where it comes from.
    pub source: Source,
    /// The side with the entries of the pose.
    pub pose: Poly,
    /// The side of the middle part.
    pub chain: Poly,
    /// pose − chain, which vanishes.
    pub zero: Poly,
    /// The dimension: 0 for a rotation, 1 for a length.
    pub degree: u8,
    /// The atoms that occur.
    pub atoms: Vec<Atom>,
}

/// Both sides at two cuts: for sums of squares, and to measure how well a solution fulfils the equations.
#[derive(Clone, Debug)]
pub struct Split {
    /// The first element of the middle part.
    pub left: usize,
    /// The element behind it.
    pub right: usize,
    /// The position on the side with the entries of the pose; a component is missing if it is too large.
    pub pose: [Option<Poly>; 3],
    /// The position of the middle part.
    pub chain: Column,
    /// The rotation on the side with the entries of the pose.
    pub pose_rotation: [[Option<Poly>; 3]; 3],
    /// The rotation of the middle part.
    pub chain_rotation: Matrix,
}

/// Terms of one side of an equation that is kept.
const TERMS: usize = 160;

/// How long equations may become.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Length {
    /// Those from which a search nearly always ends.
    Short,
    /// All that is worth looking at.
    Any,
}

impl Length {
    /// Products of terms that an entry may take.
    fn products(self) -> usize {
        match self {
            Length::Short => 400,
            Length::Any => 4_500,
        }
    }
}

/// The equations of a chain.
#[derive(Debug)]
pub struct Equations {
    /// Those of single entries, short ones first.
    pub found: Vec<Equation>,
    /// Both sides at each two cuts, as they are.
    pub whole: Vec<Split>,
    /// The same with the entries that the arm holds at a number put in.
    pub splits: Vec<Split>,
    /// Whether some were too long, or the work was [spent](super::algebra::Algebra::is_spent).
    pub is_cut: bool,
}

/// The equations of a chain up to a length.
pub fn equations(chain: &NormalChain, goal: Goal, length: Length) -> Equations {
    let a = &chain.algebra;
    let is_cut = Cell::new(false);
    let dot = |pairs: &mut dyn Iterator<Item = (Option<Poly>, &Poly)>| {
        let factors = factors(pairs)?;
        let products: usize = factors.iter().map(|(x, y)| x.terms().len() * y.terms().len()).sum();
        if products > length.products() || a.is_spent() {
            is_cut.set(true);
            return None;
        }
        Some(factors.iter().fold(Poly::zero(), |sum, (x, y)| sum.plus(&a.times(x, y))))
    };
    let n = chain.elements.len();
    let products: Vec<Vec<(Matrix, Column)>> = (0..=n).map(|u| chain.products_from(u)).collect();
    let u = |i: usize, j: usize| Some(Poly::atom((i * 4 + j) as Atom));
    let known = |j: usize| match goal {
        Goal::Pose => true,
        Goal::Position => j == 3,
        Goal::PositionAndAxis => j >= 2,
    };
    let (mut found, mut splits) = (vec![], vec![]);
    let mut seen: FxHashSet<Poly> = FxHashSet::default();
    let rights: Vec<usize> = if goal == Goal::Pose { (0..=n).collect() } else { vec![n] };
    for &v in &rights {
        // W = U · right⁻¹
        let Some((r_right, p_right)) = products[v].get(n - v) else { continue };
        let back = transposed(r_right);
        let rotation: [[Option<Poly>; 3]; 3] = std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                if goal == Goal::Pose {
                    dot(&mut (0..3).map(|k| (u(i, k), &back[k][j])))
                } else {
                    known(j).then(|| u(i, j)).flatten()
                }
            })
        });
        let position: [Option<Poly>; 3] = std::array::from_fn(|i| {
            let shift = dot(&mut (0..3).map(|k| (rotation[i][k].clone(), &p_right[k])))?;
            Some(u(i, 3)?.minus(&shift))
        });
        for left in 0..=v {
            let (Some((r_left, p_left)), Some((r_middle, p_middle))) =
                (products[0].get(left), products[left].get(v - left))
            else {
                continue;
            };
            let moved: [Option<Poly>; 3] =
                std::array::from_fn(|i| Some(position[i].as_ref()?.minus(&p_left[i])));
            let entry_of = |column: &dyn Fn(usize) -> Option<Poly>, i: usize| {
                dot(&mut (0..3).map(|k| (column(k), &r_left[k][i])))
            };
            let mut push = |entry: Entry, pose: Option<Poly>, chain_side: &Poly, degree: u8| {
                let Some(pose) = pose else { return };
                if pose.terms().len() > TERMS || chain_side.terms().len() > TERMS {
                    return;
                }
                let zero = pose.minus(chain_side);
                let Some((_, first)) = zero.terms().first() else { return };
                let monic = zero.scaled(&first.recip().unwrap_or(Rational::ONE));
                if seen.insert(monic) {
                    let atoms = zero.atoms();
                    let source = Source { left, right: v, entry };
                    found.push(Equation { source, pose, chain: chain_side.clone(), zero, degree, atoms });
                }
            };
            let turned: [[Option<Poly>; 3]; 3] =
                std::array::from_fn(|i| std::array::from_fn(|j| entry_of(&|k| rotation[k][j].clone(), i)));
            for i in 0..3 {
                for j in 0..3 {
                    push(Entry::Rotation(i, j), turned[i][j].clone(), &r_middle[i][j], 0);
                }
            }
            let on_pose: [Option<Poly>; 3] = std::array::from_fn(|i| entry_of(&|k| moved[k].clone(), i));
            for i in 0..3 {
                push(Entry::Position(i), on_pose[i].clone(), &p_middle[i], 1);
            }
            for i in 0..3 {
                // middle⁻¹'s position: −Rᵀp on both sides
                let pose = dot(&mut (0..3).map(|k| (rotation[k][i].clone(), &moved[k])).filter_map(flat));
                let pose = pose.map(|p| p.scaled(&-Rational::ONE));
                let complete = (0..3).all(|k| rotation[k][i].is_some() && moved[k].is_some());
                let sum = dot(&mut (0..3).map(|k| (Some(r_middle[k][i].clone()), &p_middle[k])));
                let chain_side = sum.map(|p| p.scaled(&-Rational::ONE));
                if let Some(chain_side) = chain_side.filter(|_| complete) {
                    push(Entry::Inverse(i), pose, &chain_side, 1);
                }
            }
            splits.push(Split {
                left,
                right: v,
                pose: on_pose,
                chain: p_middle.clone(),
                pose_rotation: turned,
                chain_rotation: r_middle.clone(),
            });
        }
    }
    // Of equations that become one, the shortest stays.
    found.sort_by_key(|e| (e.zero.terms().len(), e.source));
    put_constants(&mut found);
    found.sort_by_key(|e| (e.zero.terms().len(), e.source));
    let whole = splits;
    Equations { splits: as_in(&found, &whole), found, whole, is_cut: is_cut.get() }
}

/// Entries of the rotation that the arm holds at a number, each with the equation that says so.
type Constants = Vec<(Atom, Rational, Source)>;

/// A polynomial with these entries put in.
fn with_entries(p: &Poly, constants: &Constants) -> Poly {
    Poly::from_terms(p.terms().iter().map(|(m, r)| {
        constants.iter().fold((m.clone(), r.clone()), |(m, r), (atom, x, _)| {
            let power = (0..m.exponent(*atom)).fold(r, |r, _| &r * x);
            (m.without(*atom), power)
        })
    }))
}

/// Entries of the rotation that the arm holds at a number are put into the other equations: az = −1 of an arm whose hand
/// always points down.
fn put_constants(found: &mut Vec<Equation>) {
    let constants: Constants = found.iter().filter_map(constant).collect();
    if constants.is_empty() {
        return;
    }
    let mut seen: FxHashSet<Poly> = FxHashSet::default();
    found.retain_mut(|e| {
        if !constants.iter().any(|c| c.2 == e.source) {
            (e.pose, e.chain) = (with_entries(&e.pose, &constants), with_entries(&e.chain, &constants));
            e.zero = e.pose.minus(&e.chain);
            e.atoms = e.zero.atoms();
        }
        let Some((_, first)) = e.zero.terms().first() else { return false };
        seen.insert(e.zero.scaled(&first.recip().unwrap_or(Rational::ONE)))
    });
}

/// Both sides at the cuts as the equations have them, with the entries that the arm holds at a number put in. What a
/// pose misses an equation by is measured by the sides as they were: a pose may have another number there.
fn as_in(found: &[Equation], splits: &[Split]) -> Vec<Split> {
    let constants: Constants = found.iter().filter_map(constant).collect();
    let mut splits = splits.to_vec();
    if constants.is_empty() {
        return splits;
    }
    for split in &mut splits {
        let entries = split.pose.iter_mut().chain(split.pose_rotation.iter_mut().flatten());
        entries.flatten().for_each(|p| *p = with_entries(p, &constants));
    }
    splits
}

/// The entry of the rotation that an equation gives as a number.
pub(super) fn constant(e: &Equation) -> Option<(Atom, Rational, Source)> {
    let [atom] = e.atoms[..] else { return None };
    let is_entry = usize::from(atom) < 12 && atom % 4 != 3;
    let is_linear = e.zero.terms().iter().all(|(m, _)| m.is_one() || *m == Monomial::power(atom, 1));
    if e.degree != 0 || !is_entry || !is_linear {
        return None;
    }
    let of = |part: &Monomial| e.zero.terms().iter().find(|t| t.0 == *part).map(|t| t.1.clone());
    // a·U + b = 0
    let (a, b) = (of(&Monomial::power(atom, 1))?, of(&Monomial::one()).unwrap_or(Rational::ZERO));
    Some((atom, -(&b * &a.recip()?), e.source))
}

fn flat((x, y): (Option<Poly>, &Option<Poly>)) -> Option<(Option<Poly>, &Poly)> {
    y.as_ref().map(|y| (x, y))
}

/// The factors of the products that are not 0, or nothing if one is missing.
fn factors<'a>(pairs: &mut dyn Iterator<Item = (Option<Poly>, &'a Poly)>) -> Option<Vec<(Poly, &'a Poly)>> {
    pairs.filter(|(_, y)| !y.is_zero()).map(|(x, y)| Some((x?, y))).collect()
}
