//! What is known at a point of the derivation, and equations seen from there.
//!
//! The nodes of a group of parallel axes are connected where the angle between them is known: learning θ234 and θ2 makes
//! θ34 known for free. Two angles that differ by a known one are one unknown. Where axes follow others, what is a sum of
//! whole multiples of known angles is known as well.

use super::algebra::{Algebra, Kind};
use super::chain::{Difference, Element, Motion, NormalChain};
use super::drivers::Lattice;
use crate::geometry::{Rotation, Transform, Vector};
use crate::random::Random;
use denavit_symbolic::poly::{Atom, Monomial, Poly};
use denavit_symbolic::{Expr, Rational, Symbol};
use std::collections::BTreeMap;

/// An angle or a displacement.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, PartialOrd, Ord)]
pub enum Unknown {
    /// A difference of potentials.
    Angle(Difference),
    /// The displacement of an axis.
    Slide(usize),
}

/// What is known.
#[derive(Clone, Debug)]
pub struct Known {
    /// For each node of each group, the smallest node that it is connected to.
    component: Vec<Vec<usize>>,
    slides: Vec<bool>,
    /// The angles that were learnt, if axes follow others.
    learnt: Option<Lattice>,
}

impl Known {
    /// Nothing but the values of some axes.
    pub fn new(chain: &NormalChain, given: &[usize]) -> Self {
        let mut known = Known {
            component: chain.groups.iter().map(|&n| (0..=n).collect()).collect(),
            slides: (0..chain.axes.len())
                .map(|k| chain.axes[k].motion != Motion::Slide || !chain.drivers.drives(k))
                .collect(),
            learnt: chain.has_followers().then(Lattice::default),
        };
        for &k in given {
            known.learn(chain, axis_unknown(chain, k));
        }
        known
    }

    /// The unknown is known from here on.
    pub fn learn(&mut self, chain: &NormalChain, x: Unknown) {
        match x {
            Unknown::Slide(k) => self.slides[k] = true,
            Unknown::Angle(d) => {
                self.connect(d);
                let Some(mut learnt) = self.learnt.take() else { return };
                learnt.add(&chain.form(d));
                for (&d, form) in chain.differences.iter().zip(&chain.forms) {
                    if !self.knows(Unknown::Angle(d)) && learnt.made(form).is_some() {
                        self.connect(d);
                    }
                }
                self.learnt = Some(learnt);
            }
        }
    }

    fn connect(&mut self, d: Difference) {
        let nodes = &mut self.component[d.group];
        let (a, b) = (nodes[d.from], nodes[d.to]);
        let (low, high) = (a.min(b), a.max(b));
        nodes.iter_mut().filter(|n| **n == high).for_each(|n| *n = low);
    }

    /// True if the value is known.
    pub fn knows(&self, x: Unknown) -> bool {
        match x {
            Unknown::Slide(k) => self.slides[k],
            Unknown::Angle(d) => self.component[d.group][d.from] == self.component[d.group][d.to],
        }
    }

    /// The axes that are not known.
    pub fn open(&self, chain: &NormalChain) -> Vec<Unknown> {
        (0..chain.axes.len()).map(|k| axis_unknown(chain, k)).filter(|&x| !self.knows(x)).collect()
    }

    /// True if every axis is known.
    pub fn everything(&self) -> bool {
        self.slides.iter().all(|&x| x) && self.component.iter().all(|c| c.iter().all(|&n| n == 0))
    }

    /// The angle by which an unknown difference is called: between the smallest nodes of its components, or the first that
    /// is the same.
    pub fn representative(&self, chain: &NormalChain, d: Difference) -> Difference {
        let nodes = &self.component[d.group];
        let (a, b) = (nodes[d.from], nodes[d.to]);
        chain.first_of(Difference { group: d.group, from: a.min(b), to: a.max(b) })
    }

    /// The unknown angles (by representative) and displacements among some atoms, sorted.
    pub fn unknowns(&self, chain: &NormalChain, atoms: &[Atom]) -> Vec<Unknown> {
        let mut found = vec![];
        for &a in atoms {
            let x = match chain.algebra.kind(a) {
                Kind::Cos(n) | Kind::Sin(n) => Unknown::Angle(chain.differences[n]),
                Kind::Slide(k) => Unknown::Slide(k),
                Kind::Pose(_) | Kind::Constant(_) => continue,
            };
            if !self.knows(x) {
                found.push(match x {
                    Unknown::Angle(d) => Unknown::Angle(self.representative(chain, d)),
                    slide => slide,
                });
            }
        }
        found.sort_unstable();
        found.dedup();
        found
    }

    /// How many of some unknowns are independent: three angles between three nodes are two.
    pub fn rank(&self, chain: &NormalChain, unknowns: &[Unknown]) -> usize {
        let mut merged = self.clone();
        let mut rank = 0;
        for &x in unknowns {
            if !merged.knows(x) {
                merged.learn(chain, x);
                rank += 1;
            }
        }
        rank
    }

    /// The angle between the outer ends of two angles of one group that share a node; where axes follow others, any that is
    /// the sum or the difference of both.
    pub fn third(&self, chain: &NormalChain, pair: &[Unknown]) -> Option<Unknown> {
        let [Unknown::Angle(a), Unknown::Angle(b)] = pair else { return None };
        if chain.has_followers() {
            let (a, b) = (chain.form(*a), chain.form(*b));
            let is_made = |form: &Vec<i64>| {
                [(1, 1), (1, -1), (-1, 1), (-1, -1)]
                    .into_iter()
                    .any(|(x, y)| form.iter().zip(&a).zip(&b).all(|((f, a), b)| *f == x * a + y * b))
            };
            let number = chain.forms.iter().position(is_made)?;
            return Some(Unknown::Angle(self.representative(chain, chain.differences[number])));
        }
        if a.group != b.group {
            return None;
        }
        let mut nodes = vec![];
        for n in [a.from, a.to, b.from, b.to] {
            match nodes.iter().position(|&m| m == n) {
                Some(k) => {
                    nodes.swap_remove(k);
                }
                None => nodes.push(n),
            }
        }
        let [p, q] = nodes[..] else { return None };
        Some(Unknown::Angle(Difference { group: a.group, from: p.min(q), to: p.max(q) }))
    }

    /// The unknown angles of a polynomial that `basis` does not have, each with the way to it over angles of the basis.
    pub(crate) fn ways(&self, chain: &NormalChain, p: &Poly, basis: &[Unknown]) -> Ways {
        let mut found: Ways = vec![];
        for atom in p.atoms() {
            if let Kind::Cos(n) | Kind::Sin(n) = chain.algebra.kind(atom) {
                let d = chain.differences[n];
                let x = Unknown::Angle(d);
                if !self.knows(x)
                    && !basis.contains(&x)
                    && found.iter().all(|w| w.0 != n)
                    && let Some(way) = self.way(chain, d, basis)
                {
                    found.push((n, way));
                }
            }
        }
        found
    }

    /// A difference over at most two angles of a basis.
    fn way(&self, chain: &NormalChain, d: Difference, basis: &[Unknown]) -> Option<Vec<(usize, usize)>> {
        let nodes = &self.component[d.group];
        let (start, goal) = (nodes[d.from], nodes[d.to]);
        // A path over at most two edges of the basis.
        let edges: Vec<(usize, usize)> = basis
            .iter()
            .filter_map(|x| if let Unknown::Angle(e) = x { Some(chain.all_of(*e)) } else { None })
            .flatten()
            .filter(|e| e.group == d.group)
            .flat_map(|e| [(e.from, e.to), (e.to, e.from)])
            .collect();
        let ends = |e: (usize, usize)| (nodes[e.0], nodes[e.1]);
        let mut path: Option<Vec<(usize, usize)>> =
            edges.iter().find(|e| ends(**e) == (start, goal)).map(|e| vec![*e]);
        if path.is_none() {
            for &e in edges.iter().filter(|e| ends(**e).0 == start) {
                let next = edges.iter().find(|f| ends(**f) == (ends(e).1, goal));
                if let Some(&f) = next {
                    path = Some(vec![e, f]);
                    break;
                }
            }
        }
        path
    }
}

/// Differences of potentials by number, each as a way over other differences.
pub(crate) type Ways = Vec<(usize, Vec<(usize, usize)>)>;

/// The polynomial with these angles written over the ways to them.
pub(crate) fn rewritten(chain: &NormalChain, p: &Poly, ways: &Ways) -> Poly {
    let a = &chain.algebra;
    let pairs: BTreeMap<usize, (Poly, Poly)> =
        ways.iter().map(|(n, way)| (*n, expanded(chain, chain.differences[*n], way))).collect();
    let of = |atom: Atom| match a.kind(atom) {
        Kind::Cos(k) => pairs.get(&k).map(|x| &x.0),
        Kind::Sin(k) => pairs.get(&k).map(|x| &x.1),
        _ => None,
    };
    // Terms by what of them is replaced: each such product is formed once.
    let mut parts: BTreeMap<Monomial, Vec<(Monomial, Rational)>> = BTreeMap::new();
    for (m, r) in p.terms() {
        let (replaced, rest) = m.parted(|atom| of(atom).is_some());
        parts.entry(replaced).or_default().push((rest, r.clone()));
    }
    let mut terms: Vec<(Monomial, Rational)> = vec![];
    for (replaced, rest) in parts {
        if replaced.is_one() {
            terms.extend(rest);
            continue;
        }
        let factors = replaced.factors().iter().flat_map(|&(atom, n)| (0..n).filter_map(move |_| of(atom)));
        let product = factors.fold(Poly::one(), |product, x| a.times(&product, x));
        terms.extend(a.times(&product, &Poly::from_terms(rest)).terms().iter().cloned());
    }
    Poly::from_terms(terms)
}

/// Cosine and sine of a difference by angles on a way to it and known ones.
fn expanded(chain: &NormalChain, d: Difference, way: &[(usize, usize)]) -> (Poly, Poly) {
    let mut at = d.from;
    let mut sum = (Poly::one(), Poly::zero());
    for &(p, q) in way {
        sum = add_angles(&chain.algebra, &sum, &chain.pair(d.group, at, p));
        sum = add_angles(&chain.algebra, &sum, &chain.pair(d.group, p, q));
        at = q;
    }
    add_angles(&chain.algebra, &sum, &chain.pair(d.group, at, d.to))
}

/// The unknown that an axis is.
pub fn axis_unknown(chain: &NormalChain, k: usize) -> Unknown {
    match chain.axes[k].motion {
        Motion::Slide => Unknown::Slide(k),
        Motion::Turn { group, from, to, .. } => {
            Unknown::Angle(chain.first_of(Difference { group, from, to }.forwards()))
        }
    }
}

fn add_angles(a: &Algebra, x: &(Poly, Poly), y: &(Poly, Poly)) -> (Poly, Poly) {
    let c = a.times(&x.0, &y.0).minus(&a.times(&x.1, &y.1));
    let s = a.times(&x.1, &y.0).plus(&a.times(&x.0, &y.1));
    (c, s)
}

/// Values of all atoms at some configurations: for tests of what vanishes, and for conditioning.
#[derive(Debug)]
pub struct Samples {
    /// For each configuration the values of all atoms.
    atoms: Vec<Vec<f64>>,
    /// The configurations: the value of each axis, quarter turns left aside.
    axes: Vec<Vec<f64>>,
    /// What stands behind the pose at the first configuration.
    tool: Transform<f64>,
    /// The longest displacement of the chain there; 1 if there is none.
    length: f64,
}

/// How many configurations are sampled.
const SAMPLES: usize = 8;

impl Samples {
    /// Random configurations (always the same ones); a parameter without value gets a random one.
    pub fn new(chain: &NormalChain, value: impl Fn(Symbol) -> Option<f64>) -> Self {
        let mut random = Random(0x9E37_79B9_7F4A_7C15);
        let constants: Vec<Vec<(Symbol, f64)>> = (0..SAMPLES)
            .map(|_| {
                let of = |s: &Symbol| {
                    let drawn = 0.3 + 0.7 * random.unit();
                    (*s, value(*s).unwrap_or(drawn))
                };
                chain.parameters.iter().map(of).collect()
            })
            .collect();
        let first = |s: Symbol| constants[0].iter().find(|p| p.0 == s).map(|p| p.1);
        let tool = chain.tool.map(|e| e.eval(first).unwrap_or(f64::NAN));
        let mut samples = Samples { atoms: vec![], axes: vec![], tool, length: 0.0 };
        for parameters in &constants {
            let lookup = |s: Symbol| parameters.iter().find(|p| p.0 == s).map(|p| p.1);
            let mut atoms = vec![0.0; chain.algebra.atoms()];
            for (i, atom) in atoms.iter_mut().enumerate() {
                if let Kind::Constant(e) = chain.algebra.kind(i as Atom) {
                    *atom = Expr::eval(e, lookup).unwrap_or(f64::NAN);
                }
            }
            if samples.length == 0.0 {
                samples.length = length(chain, &atoms);
            }
            let mut axes: Vec<f64> = chain
                .axes
                .iter()
                .map(|axis| match axis.motion {
                    Motion::Turn { .. } => std::f64::consts::TAU * random.unit(),
                    Motion::Slide => samples.length * (random.unit() - 0.3),
                })
                .collect();
            chain.drivers.follow(&mut axes);
            set_axes(chain, &axes, &mut atoms);
            samples.atoms.push(atoms);
            samples.axes.push(axes);
        }
        samples
    }

    /// The tool's pose at the first configuration with one axis that drives moved, row-major 3×4.
    pub fn moved(&self, chain: &NormalChain, axis: usize, by: f64) -> Vec<f64> {
        let (mut axes, mut atoms) = (self.axes[0].clone(), self.atoms[0].clone());
        axes[axis] += by;
        chain.drivers.follow(&mut axes);
        set_axes(chain, &axes, &mut atoms);
        let rows = std::array::from_fn(|i| std::array::from_fn(|j| atoms[i * 4 + j]));
        let p = Vector(std::array::from_fn(|i| atoms[i * 4 + 3]));
        let pose = Transform::from_rotation_translation(Rotation::from_rows(rows), p) * self.tool;
        pose.matrix().into_iter().take(3).flatten().collect()
    }

    /// What lengths of the chain are compared with.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// The values of all atoms at the first configuration.
    pub fn first(&self) -> &[f64] {
        &self.atoms[0]
    }

    /// True if the polynomial is 0 at all of them.
    pub fn vanishes(&self, p: &Poly) -> bool {
        p.is_zero()
            || self.atoms.iter().all(|atoms| {
                let (value, size) = Algebra::value_and_size(p, atoms);
                value.abs() <= 1e-10 * size
            })
    }

    /// The values.
    pub fn values(&self, p: &Poly) -> Vec<f64> {
        self.atoms.iter().map(|atoms| Algebra::value(p, atoms)).collect()
    }
}

/// The longest displacement of a chain; 1 if there is none.
fn length(chain: &NormalChain, atoms: &[f64]) -> f64 {
    let constants = chain.elements.iter().filter_map(|e| match e {
        Element::Constant(constant) => Some(&constant.1),
        Element::Axis(_) => None,
    });
    let longest = constants.flatten().map(|p| Algebra::value(p, atoms).abs()).fold(0.0, f64::max);
    if longest > 0.0 { longest } else { 1.0 }
}

/// Puts in the values of the axes, and of what follows from them.
fn set_axes(chain: &NormalChain, axes: &[f64], atoms: &mut [f64]) {
    let mut potentials: Vec<Vec<f64>> = chain.groups.iter().map(|&n| vec![0.0; n + 1]).collect();
    for (axis, &x) in chain.axes.iter().zip(axes) {
        if let Motion::Turn { group, from, to, reversed } = axis.motion
            && to > from
        {
            potentials[group][to] =
                if reversed { potentials[group][from] - x } else { potentials[group][from] + x };
        }
    }
    for (i, atom) in atoms.iter_mut().enumerate() {
        let angle = |n: usize| {
            let d = chain.differences[n];
            potentials[d.group][d.to] - potentials[d.group][d.from]
        };
        match chain.algebra.kind(i as Atom) {
            Kind::Cos(n) => *atom = angle(n).cos(),
            Kind::Sin(n) => *atom = angle(n).sin(),
            Kind::Slide(k) => *atom = axes[k],
            Kind::Pose(_) | Kind::Constant(_) => {}
        }
    }
    let pose = pose(chain, axes, atoms);
    let (r, p) = (pose.rotation.rows(), pose.translation);
    for i in 0..3 {
        atoms[i * 4..i * 4 + 3].copy_from_slice(&r[i]);
        atoms[i * 4 + 3] = p[i];
    }
}

/// The product of the chain's elements, with these values of its axes and of its constants.
fn pose(chain: &NormalChain, axes: &[f64], atoms: &[f64]) -> Transform<f64> {
    let value = |p: &Poly| Algebra::value(p, atoms);
    chain.elements.iter().fold(Transform::identity(), |pose, element| {
        pose * match element {
            Element::Constant(constant) => {
                let (r, p) = &**constant;
                let rows = std::array::from_fn(|i| std::array::from_fn(|j| value(&r[i][j])));
                let p = Vector(std::array::from_fn(|i| value(&p[i])));
                Transform::from_rotation_translation(Rotation::from_rows(rows), p)
            }
            Element::Axis(k) if chain.axes[*k].motion == Motion::Slide => Transform::translation_z(axes[*k]),
            Element::Axis(k) => Transform::rotation_z(axes[*k]),
        }
    })
}
