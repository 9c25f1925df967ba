//! Which steps are possible: equations with one unknown by type, and eliminations from two with two.
//!
//! Types and their numbers: Paul, *Robot Manipulators* (1981), ch. 3; Khalil and Dombre, *Modeling, Identification and
//! Control of Robots* (2002), ch. 4. Types 4 to 8 of the latter are types 1 to 3 behind an elimination.

use super::algebra::Kind;
use super::chain::NormalChain;
use super::equations::{Equations, Split};
use super::forms::{Forms, View};
use super::known::{Known, Samples, Unknown};
use super::plan::{Cost, Determinant, Elimination, Form, Norm, Origin, Row, Step};
use denavit_symbolic::Rational;
use denavit_symbolic::poly::{Atom, Monomial, Poly};
use rustc_hash::FxHashMap;
use std::cell::RefCell;
use std::collections::BTreeSet;
use std::rc::Rc;

/// Cuts, whether on the side of the pose, components.
type SquaresKey = (usize, usize, bool, Vec<usize>);

/// What the search works on.
pub struct Problem<'a> {
    /// The normal form.
    pub chain: &'a NormalChain,
    /// Its equations, and its positions for sums of squares.
    pub sides: &'a Equations,
    /// Values of all atoms at random configurations.
    pub samples: &'a Samples,
    /// Sums of squares that were multiplied out.
    squares: RefCell<FxHashMap<SquaresKey, Poly>>,
    pub(super) forms: Forms,
}

/// Equations of one unknown that are compared in pairs.
const ROWS: usize = 24;
/// Equations of two unknowns that are tried in pairs.
const PAIRS: usize = 16;
/// Terms of a polynomial that is squared.
const SQUARED: usize = 60;
/// Unknowns of a sum of squares before it is multiplied out, which loses two at most.
const MOST_UNKNOWNS: usize = 4;

/// An equation seen from a state.
struct Seen {
    unknowns: Vec<Unknown>,
    zero: Norm,
    degree: u8,
    origin: Origin,
}

impl Seen {
    fn terms(&self) -> usize {
        self.zero.plus.terms().len() + self.zero.squares.len()
    }
}

impl<'a> Problem<'a> {
    /// A search's problem.
    pub fn new(chain: &'a NormalChain, sides: &'a Equations, samples: &'a Samples) -> Self {
        Problem { chain, sides, samples, squares: RefCell::default(), forms: Forms::default() }
    }
}

impl Problem<'_> {
    /// All steps that can be taken, in no order.
    pub fn candidates(&self, known: &Known) -> Vec<Step> {
        let mut seen = self.entries(known);
        let steps = self.in_one_unknown(&seen);
        // Nothing behind a sum of squares or an elimination is cheaper.
        if steps.iter().any(|s| s.cost.roots == 1 && !s.cost.spurious && s.cost.condition == 0) {
            return steps;
        }
        let splits = self.sides.splits.iter().take_while(|_| !self.chain.algebra.is_spent());
        seen.extend(splits.filter_map(|s| self.squares(known, s)));
        seen.sort_by_key(Seen::terms);
        let mut steps = self.in_one_unknown(&seen);
        if steps.iter().all(|s| s.cost.roots > 2) {
            self.eliminations(known, &seen, &mut steps);
        }
        steps
    }

    /// The steps from equations with one unknown.
    fn in_one_unknown(&self, seen: &[Seen]) -> Vec<Step> {
        let mut steps = vec![];
        let single = |s: &Seen| if let [x] = s.unknowns[..] { Some(x) } else { None };
        let unknowns: BTreeSet<Unknown> = seen.iter().filter_map(single).collect();
        for x in unknowns {
            let of: Vec<&Seen> = seen.iter().filter(|s| s.unknowns == [x]).collect();
            match x {
                Unknown::Angle(_) => self.angle_steps(x, &of, false, &mut steps),
                Unknown::Slide(_) => self.slide_steps(x, &of, false, &mut steps),
            }
        }
        steps
    }

    /// The equations of entries with one or two independent unknowns, in the basis of their unknowns, short ones first.
    fn entries(&self, known: &Known) -> Vec<Seen> {
        let mut found = vec![];
        for e in &self.sides.found {
            let unknowns = known.unknowns(self.chain, &e.atoms);
            if unknowns.is_empty() || unknowns.len() > 3 || known.rank(self.chain, &unknowns) > 2 {
                continue;
            }
            let origin = Origin::Entry(e.source);
            let zero =
                if unknowns.len() == 1 { self.in_basis(known, &e.zero, &unknowns) } else { e.zero.clone() };
            found.push(Seen { unknowns, zero: zero.into(), degree: e.degree, origin });
        }
        found.sort_by_key(Seen::terms);
        found
    }

    /// The sum of the squares of those position components that hold unknowns.
    fn squares(&self, known: &Known, split: &Split) -> Option<Seen> {
        let a = &self.chain.algebra;
        let unknowns_of = |p: &Poly| known.unknowns(self.chain, &p.atoms());
        let mut components = vec![];
        let (mut in_pose, mut in_chain) = (false, false);
        for k in 0..3 {
            let pose = split.pose[k].as_ref()?;
            let (p, c) = (!unknowns_of(pose).is_empty(), !unknowns_of(&split.chain[k]).is_empty());
            if p || c {
                components.push(k);
            }
            in_pose |= p;
            in_chain |= c;
        }
        if components.len() < 2 {
            return None;
        }
        let side = |pose: bool| -> Vec<&Poly> {
            let of = |&k: &usize| if pose { split.pose[k].as_ref() } else { Some(&split.chain[k]) };
            components.iter().filter_map(of).collect()
        };
        let (pose, chain) = (side(true), side(false));
        let all: Vec<Atom> = pose.iter().chain(&chain).flat_map(|p| p.atoms()).collect();
        let open = known.unknowns(self.chain, &all);
        if known.rank(self.chain, &open) > MOST_UNKNOWNS {
            return None;
        }
        let expanded = |on_pose: bool, polys: &[&Poly]| -> Option<Poly> {
            let products: usize = polys.iter().map(|p| p.terms().len() * p.terms().len()).sum();
            if products > SQUARED * SQUARED {
                return None;
            }
            let key = (split.left, split.right, on_pose, components.clone());
            let mut squares = self.squares.borrow_mut();
            let found = squares.entry(key);
            Some(
                found
                    .or_insert_with(|| polys.iter().fold(Poly::zero(), |sum, p| sum.plus(&a.square(p))))
                    .clone(),
            )
        };
        let mut zero = match (in_pose, in_chain) {
            (false, true) => {
                // What is known on the side of the chain goes over before it is squared.
                let parts: Vec<(Poly, Poly)> = chain.iter().map(|c| self.known_part(known, c)).collect();
                let open: Vec<&Poly> = parts.iter().map(|p| &p.1).collect();
                let square = |sum: Poly, p: &&Poly| sum.plus(&self.squared(p));
                Norm {
                    plus: open.iter().fold(Poly::zero(), square).scaled(&-Rational::ONE),
                    squares: pose.iter().zip(&parts).map(|(p, (k, _))| p.minus(k)).collect(),
                }
            }
            (true, false) => Norm {
                plus: expanded(true, &pose)?.scaled(&-Rational::ONE),
                squares: chain.into_iter().cloned().collect(),
            },
            _ => expanded(true, &pose)?.minus(&expanded(false, &chain)?).into(),
        };
        let mut unknowns = unknowns_of(&zero.plus);
        if unknowns.len() > 1 && unknowns.len() <= 3 && known.rank(self.chain, &unknowns) == 2 {
            // The sum of the squares of a·C2 + b·C23 and a·S2 + b·S23 holds θ3 alone.
            let mut basis = unknowns.clone();
            basis.extend(known.third(self.chain, &unknowns));
            for i in 0..basis.len() {
                for j in i + 1..basis.len() {
                    let p = self.in_basis(known, &zero.plus, &[basis[i], basis[j]]);
                    let left = unknowns_of(&p);
                    if left.len() < unknowns.len() {
                        (zero.plus, unknowns) = (p, left);
                    }
                }
            }
        }
        if unknowns.is_empty() || unknowns.len() > 3 || known.rank(self.chain, &unknowns) > 2 {
            return None;
        }
        if unknowns.len() == 1 {
            zero.plus = self.in_basis(known, &zero.plus, &unknowns);
        }
        let origin = Origin::Squares { left: split.left, right: split.right, components };
        Some(Seen { unknowns, zero, degree: 2, origin })
    }

    /// The terms of a polynomial that are known, and the others.
    fn known_part(&self, known: &Known, p: &Poly) -> (Poly, Poly) {
        let is_known = |m: &Monomial| {
            let atoms: Vec<Atom> = m.factors().iter().map(|f| f.0).collect();
            known.unknowns(self.chain, &atoms).is_empty()
        };
        let constant = |m: &Monomial| {
            m.factors().iter().all(|f| matches!(self.chain.algebra.kind(f.0), Kind::Constant(_)))
        };
        let (moved, kept) = p.terms().iter().cloned().partition(|(m, _)| is_known(m) && !constant(m));
        let (moved, kept): (Vec<_>, Vec<_>) = (moved, kept);
        (Poly::from_terms(moved), Poly::from_terms(kept))
    }

    /// A sum with its squares multiplied out, if that is short.
    fn expanded(&self, sum: &Norm) -> Option<Poly> {
        let products: usize = sum.squares.iter().map(|p| p.terms().len() * p.terms().len()).sum();
        let square = |total: Poly, p: &Poly| total.plus(&self.chain.algebra.square(p));
        (products <= SQUARED).then(|| sum.squares.iter().fold(sum.plus.clone(), square))
    }

    /// The atoms of an unknown: cosine and sine, or the displacement alone.
    pub fn atoms(&self, x: Unknown) -> (Atom, Option<Atom>) {
        let find = |kind| self.chain.algebra.find(kind).expect("every unknown has its atoms");
        match x {
            Unknown::Angle(d) => {
                let n = self.chain.number(d);
                (find(Kind::Cos(n)), Some(find(Kind::Sin(n))))
            }
            Unknown::Slide(k) => (find(Kind::Slide(k)), None),
        }
    }

    /// Steps for an angle from equations in it alone.
    fn angle_steps(&self, x: Unknown, of: &[&Seen], spurious: bool, steps: &mut Vec<Step>) {
        let mut rows: Vec<Row> = vec![];
        for s in of {
            let view = self.view(&s.zero.plus, x);
            let part = |key| view.get(&key).cloned().unwrap_or_default();
            let negated = |p: Poly| p.scaled(&-Rational::ONE);
            let degree = view.keys().map(|k| k.0 + k.1).max().unwrap_or(0);
            if degree == 2 {
                let mut all: [Norm; 5] =
                    [part((2, 0)), part((1, 1)), part((1, 0)), part((0, 1)), part((0, 0))].map(Norm::from);
                all[4].squares = s.zero.squares.clone();
                let terms = s.zero.plus.terms().len();
                steps.push(Step {
                    unknown: x,
                    form: Form::Quartic(Box::new(all)),
                    rows: vec![],
                    origins: vec![s.origin.clone()],
                    degree: s.degree,
                    cost: Cost { roots: 4, spurious, condition: 4, depth: s.origin.depth(), terms },
                });
            }
            if degree != 1 {
                continue;
            }
            // Σ squares² + (A c + B s + P) = 0 is −A c − B s = Σ squares² + P.
            let (a, b) = (negated(part((1, 0))), negated(part((0, 1))));
            let c = Norm { squares: s.zero.squares.clone(), plus: part((0, 0)) };
            rows.push(Row { a, b, c, degree: s.degree, origin: s.origin.clone() });
        }
        rows.sort_by_key(row_terms);
        // The shortest, and the shortest of those whose factors never vanish.
        let (mut short, mut firm) = (0, 0);
        rows.retain(|row| {
            if short < ROWS {
                short += 1;
                return true;
            }
            let keep = firm < ROWS && is_constant(&self.lengths(row));
            firm += usize::from(keep);
            keep
        });
        for row in &rows {
            let constant = is_constant(&self.lengths(row));
            let line = row.c.squares.is_empty() && row.c.plus.is_zero();
            let condition = match (line, constant) {
                (true, true) => 0,
                (true, false) => 1,
                (false, _) => 2,
            };
            steps.push(Step {
                unknown: x,
                form: if line { Form::Line } else { Form::Sincos },
                rows: vec![row.clone()],
                origins: vec![row.origin.clone()],
                degree: row.degree,
                cost: Cost {
                    roots: 2,
                    spurious,
                    condition,
                    depth: row.origin.depth(),
                    terms: row_terms(row),
                },
            });
        }
        let values: Vec<[Vec<f64>; 2]> =
            rows.iter().map(|r| [&r.a, &r.b].map(|p| self.samples.values(p))).collect();
        let mut best: Option<(Cost, [usize; 2], Determinant)> = None;
        for i in 0..rows.len() {
            for j in i + 1..rows.len() {
                let cost = pair_cost([&rows[i], &rows[j]], [&values[i], &values[j]], spurious);
                if let Some((cost, determinant)) = cost
                    && best.as_ref().is_none_or(|b| cost < b.0)
                {
                    best = Some((cost, [i, j], determinant));
                }
            }
        }
        if let Some((cost, [i, j], determinant)) = best {
            let (first, second) = (rows[i].clone(), rows[j].clone());
            steps.push(Step {
                unknown: x,
                degree: first.degree + second.degree,
                origins: vec![first.origin.clone(), second.origin.clone()],
                form: Form::Pair { determinant },
                rows: vec![first, second],
                cost,
            });
        }
    }

    /// √(a² + b²) at the samples.
    fn lengths(&self, row: &Row) -> Vec<f64> {
        let (a, b) = (self.samples.values(&row.a), self.samples.values(&row.b));
        a.iter().zip(&b).map(|(a, b)| a.hypot(*b)).collect()
    }

    /// Steps for a displacement from equations in it alone.
    fn slide_steps(&self, x: Unknown, of: &[&Seen], spurious: bool, steps: &mut Vec<Step>) {
        for s in of {
            let view = self.view(&s.zero.plus, x);
            let part = |n| view.get(&(n, 0)).cloned().unwrap_or_default();
            let degree = view.keys().map(|k| k.0).max().unwrap_or(0);
            let terms = s.zero.plus.terms().len();
            let (form, cost) = match degree {
                1 if s.zero.squares.is_empty() => {
                    let denominator = part(1);
                    let condition = if is_constant(&self.samples.values(&denominator)) { 0 } else { 2 };
                    let numerator = part(0).scaled(&-Rational::ONE);
                    (
                        Form::Ratio { numerator, denominator },
                        Cost { roots: 1, spurious, condition, depth: s.origin.depth(), terms },
                    )
                }
                2 => {
                    let c = Norm { squares: s.zero.squares.clone(), plus: part(0) };
                    let condition = 2 + u8::from(!is_constant(&self.samples.values(&part(2))));
                    let form = Form::Quadratic { a: part(2), b: part(1).scaled(&Rational::new(1, 2)), c };
                    (form, Cost { roots: 2, spurious, condition, depth: s.origin.depth(), terms })
                }
                _ => continue,
            };
            steps.push(Step {
                unknown: x,
                form,
                rows: vec![],
                origins: vec![s.origin.clone()],
                degree: s.degree,
                cost,
            });
        }
    }

    /// Steps behind the elimination of one of two unknowns.
    fn eliminations(&self, known: &Known, seen: &[Seen], steps: &mut Vec<Step>) {
        let mut bases: Vec<(Unknown, Unknown)> = vec![];
        for s in seen.iter().filter(|s| s.unknowns.len() > 1) {
            for &x in &s.unknowns {
                for &y in &s.unknowns {
                    if x != y && !bases.contains(&(x, y)) {
                        bases.push((x, y));
                    }
                }
            }
        }
        for (x, y) in bases {
            if self.chain.algebra.is_spent() {
                return;
            }
            let spans = |s: &&Seen| {
                s.unknowns.len() > 1 && {
                    let mut all = s.unknowns.clone();
                    all.extend([x, y]);
                    known.rank(self.chain, &all) == 2
                }
            };
            let rows: Vec<(Rc<View>, &Seen)> = seen
                .iter()
                .filter(spans)
                .take(PAIRS)
                .filter_map(|s| {
                    let zero = self.in_basis(known, &self.expanded(&s.zero)?, &[x, y]);
                    // Where axes follow others, some angle may be none of these two and their sum or difference.
                    let is_in =
                        || known.unknowns(self.chain, &zero.atoms()).iter().all(|u| [x, y].contains(u));
                    if self.chain.has_followers() && !is_in() {
                        return None;
                    }
                    Some((self.view(&zero, y), s))
                })
                .filter(|(view, _)| {
                    let degree = view.keys().map(|k| k.0 + k.1).max().unwrap_or(0);
                    degree == 1
                })
                .collect();
            let mut found: Vec<(Seen, bool)> = vec![];
            for (i, (first, s1)) in rows.iter().enumerate() {
                for (second, s2) in &rows[i + 1..] {
                    if let Some((zero, how, degree)) =
                        self.eliminate((x, y), first, second, s1.degree, s2.degree)
                    {
                        let from = Box::new([s1.origin.clone(), s2.origin.clone()]);
                        let origin = Origin::Eliminated { unknown: y, how, from };
                        let spurious = how != Elimination::Rotation;
                        found.push((Seen { unknowns: vec![x], zero, degree, origin }, spurious));
                    }
                }
            }
            for (s, spurious) in &found {
                match x {
                    Unknown::Angle(_) => self.angle_steps(x, &[s], *spurious, steps),
                    Unknown::Slide(_) => self.slide_steps(x, &[s], *spurious, steps),
                }
            }
        }
    }

    /// What is left of two equations u·cos y + v·sin y + w = 0 (or u·y + w = 0) without y.
    fn eliminate(
        &self,
        (x, y): (Unknown, Unknown),
        first: &View,
        second: &View,
        d1: u8,
        d2: u8,
    ) -> Option<(Norm, Elimination, u8)> {
        let a = &self.chain.algebra;
        let part = |view: &View, key| view.get(&key).cloned().unwrap_or_default();
        let small = |p: &Poly| p.terms().len() <= SQUARED;
        let (u1, u2) = (part(first, (1, 0)), part(second, (1, 0)));
        let (w1, w2) = (part(first, (0, 0)), part(second, (0, 0)));
        if !small(&w1) || !small(&w2) || u1.is_zero() && part(first, (0, 1)).is_zero() {
            return None;
        }
        if matches!(y, Unknown::Slide(_)) {
            let zero = a.times(&u1, &w2).minus(&a.times(&u2, &w1));
            return Some((zero.into(), Elimination::Displacement, d1 + d2));
        }
        let (v1, v2) = (part(first, (0, 1)), part(second, (0, 1)));
        if u2.is_zero() && v2.is_zero() {
            return None;
        }
        if let Some((alpha, beta)) = rotation_like(a, [&u1, &v1], [&u2, &v2]) {
            // (β w1)² + (α w2)² = β² (u1² + v1²)
            let (s1, s2) = (a.times(&beta, &w1), a.times(&alpha, &w2));
            let lengths = a.square(&u1).plus(&a.square(&v1));
            let right = a.times(&a.square(&beta), &lengths).scaled(&-Rational::ONE);
            let (cos, sin) = self.atoms(x);
            let is_known = |p: &Poly| p.atoms().iter().all(|&a| a != cos && Some(a) != sin);
            let zero = if is_known(&s1) && is_known(&s2) {
                Norm { squares: vec![s1, s2], plus: right }
            } else {
                a.square(&s1).plus(&a.square(&s2)).plus(&right).into()
            };
            return Some((zero, Elimination::Rotation, 2 * d1));
        }
        if [&u1, &v1, &u2, &v2].iter().any(|p| p.terms().len() > 12)
            || w1.terms().len() > 24
            || w2.terms().len() > 24
        {
            return None;
        }
        let cos = a.times(&w1, &v2).minus(&a.times(&w2, &v1));
        let sin = a.times(&u1, &w2).minus(&a.times(&u2, &w1));
        let determinant = a.times(&u1, &v2).minus(&a.times(&u2, &v1));
        if determinant.is_zero() || ![&cos, &sin, &determinant].into_iter().all(small) {
            return None;
        }
        let zero = a.square(&cos).plus(&a.square(&sin)).minus(&a.square(&determinant));
        Some((zero.into(), Elimination::Cramer, 2 * (d1 + d2)))
    }
}

/// Factors with which two rows become those of a rotation: β·u1 = ±α·v2 and β·v1 = ∓α·u2.
pub(super) fn rotation_like(
    a: &super::algebra::Algebra,
    first: [&Poly; 2],
    second: [&Poly; 2],
) -> Option<(Poly, Poly)> {
    let [u1, v1] = first;
    let [u2, v2] = second;
    let like = |alpha: &Poly, beta: &Poly| {
        let same = |x: &Poly, y: &Poly| a.times(beta, x) == a.times(alpha, y);
        let negated = |p: &Poly| p.scaled(&-Rational::ONE);
        same(u1, v2) && same(v1, &negated(u2)) || same(u1, &negated(v2)) && same(v1, u2)
    };
    let one = Poly::one();
    if like(&one, &one) {
        return Some((one.clone(), one));
    }
    // A common factor in each: the first coefficients that correspond.
    let (x, y) = if u1.is_zero() { (v1, u2) } else { (u1, v2) };
    let (Some(m), Some(n)) = (x.terms().first(), y.terms().first()) else { return None };
    let common = m.0.gcd(&n.0);
    let alpha = Poly::term(m.0.over(&common), m.1.clone());
    let beta = Poly::term(n.0.over(&common), n.1.clone());
    like(&alpha, &beta).then_some((alpha, beta))
}

/// What two equations in cosine and sine cost, and what their determinant is, if they are independent.
fn pair_cost(rows: [&Row; 2], values: [&[Vec<f64>; 2]; 2], spurious: bool) -> Option<(Cost, Determinant)> {
    let [[a1, b1], [a2, b2]] = values;
    let (mut perpendicular, mut least) = (true, f64::INFINITY);
    let mut determinants = vec![];
    for k in 0..a1.len() {
        let (n1, n2) = (a1[k].hypot(b1[k]), a2[k].hypot(b2[k]));
        let determinant = a1[k] * b2[k] - a2[k] * b1[k];
        let across = (a1[k] * a2[k] + b1[k] * b2[k]).abs();
        perpendicular &= across <= 1e-10 * n1 * n2 && (n1 - n2).abs() <= 1e-10 * (n1 + n2);
        least = least.min(determinant.abs() / (n1 * n2).max(f64::MIN_POSITIVE));
        determinants.push(determinant);
    }
    if least < 1e-9 || rows.iter().all(|r| r.c.squares.is_empty() && r.c.plus.is_zero()) {
        return None;
    }
    let determinant = match (is_constant(&determinants), perpendicular) {
        (true, _) => Determinant::Constant,
        (false, true) => Determinant::Perpendicular,
        (false, false) => Determinant::General,
    };
    let condition = match determinant {
        Determinant::Constant => 0,
        Determinant::Perpendicular => 1,
        Determinant::General => 2 + u8::from(least < 1e-2),
    };
    let depth = rows.iter().map(|r| r.origin.depth()).max().unwrap_or(0);
    Some((
        Cost { roots: 1, spurious, condition, depth, terms: row_terms(rows[0]) + row_terms(rows[1]) },
        determinant,
    ))
}

fn row_terms(row: &Row) -> usize {
    let squares: usize = row.c.squares.iter().map(|p| p.terms().len()).sum();
    row.a.terms().len() + row.b.terms().len() + row.c.plus.terms().len() + squares
}

/// True if all values are the same, and not 0.
fn is_constant(values: &[f64]) -> bool {
    let first = values[0];
    first != 0.0 && values.iter().all(|v| (v - first).abs() <= 1e-9 * first.abs())
}
