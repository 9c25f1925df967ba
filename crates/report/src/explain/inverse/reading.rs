//! Polynomials of a derivation as formulas that a person would write.

use denavit::inverse::derivation::{
    Difference, Kind, Known, Lattice, Norm, NormalChain, Step, Unknown, axis_unknown, index, outermost, split,
};
use denavit_symbolic::poly::{Atom, Monomial, Poly};
use denavit_symbolic::{Expr, Rational};
use std::collections::VecDeque;

/// How polynomials are read: when each atom becomes known, and which steps an angle is composed of.
pub struct Reading<'a> {
    pub chain: &'a NormalChain,
    ranks: Vec<usize>,
    /// Angles that are known: between which nodes, and from which step (none for what is given).
    edges: Vec<(Difference, Option<usize>)>,
    slides: Vec<(usize, usize)>,
}

/// The parts of a polynomial, as they are written.
enum Parts {
    /// A number or a single product.
    Term,
    /// A common factor and the rest.
    Content(Monomial, Rational, Poly),
    /// The rest, and what a constant is the factor of.
    Apart(Atom, Poly, Poly),
    /// Atom times polynomial, one after another, and what is left.
    Sum(Vec<(Atom, Poly)>, Poly),
}

/// A name for a polynomial, if it has one.
pub type Short<'s> = &'s dyn Fn(&Poly) -> Option<Expr>;

/// An angle on the way from node to node, the step that finds it (none if it is given), whether it is passed backwards.
type Leg = (Difference, Option<usize>, bool);

impl<'a> Reading<'a> {
    /// With the values of some joint variables given.
    pub fn new(chain: &'a NormalChain, given: &[usize], steps: &[Step]) -> Self {
        let axes: Vec<usize> = (0..chain.axes.len())
            .filter(|&k| chain.axes[k].form.terms.iter().all(|t| given.contains(&t.0)))
            .collect();
        let mut known = Known::new(chain, &axes);
        let mut edges: Vec<(Difference, Option<usize>)> = vec![];
        for &k in &axes {
            if let Unknown::Angle(d) = axis_unknown(chain, k) {
                edges.push((d, None));
            }
        }
        let mut slides = vec![];
        let mut ranks = vec![usize::MAX; chain.algebra.atoms()];
        for i in 0..=steps.len() {
            for (a, rank) in ranks.iter_mut().enumerate().filter(|r| *r.1 == usize::MAX) {
                *rank = match chain.algebra.kind(a as Atom) {
                    Kind::Constant(_) => 0,
                    Kind::Pose(_) => 1,
                    Kind::Cos(n) | Kind::Sin(n) if known.knows(Unknown::Angle(chain.differences[n])) => 2 + i,
                    Kind::Slide(k) if known.knows(axis_unknown(chain, k)) => 2 + i,
                    _ => continue,
                };
            }
            if let Some(step) = steps.get(i) {
                known.learn(chain, step.unknown);
                match step.unknown {
                    Unknown::Angle(d) => edges.push((d, Some(i))),
                    Unknown::Slide(k) => slides.push((k, i)),
                }
            }
        }
        Reading { chain, ranks, edges, slides }
    }

    /// When an atom is known: 0 for constants, 1 for the pose, 2 for what is given, 3 + i for step i.
    pub fn rank(&self, a: Atom) -> usize {
        self.ranks[usize::from(a)]
    }

    /// When all of a polynomial is known.
    pub(crate) fn rank_of(&self, p: &Poly) -> usize {
        p.atoms().into_iter().map(|a| self.rank(a)).max().unwrap_or(0)
    }

    fn is_constant(&self, p: &Poly) -> bool {
        self.rank_of(p) == 0
    }

    /// The steps (or given angles) that lead from node to node, with signs, by the first `steps` steps.
    pub fn path(&self, d: Difference, steps: usize) -> Option<Vec<Leg>> {
        if self.chain.has_followers() {
            return self.sum(d, steps);
        }
        let mut ways: Vec<(usize, Vec<Leg>)> = vec![(d.from, vec![])];
        let mut pending = VecDeque::from([0]);
        while let Some(at) = pending.pop_front() {
            let (node, way) = ways[at].clone();
            if node == d.to {
                return Some(way);
            }
            for &(e, step) in &self.edges {
                if e.group != d.group || step.is_some_and(|s| s >= steps) {
                    continue;
                }
                for (start, end, backwards) in [(e.from, e.to, false), (e.to, e.from, true)] {
                    if start == node && ways.iter().all(|w| w.0 != end) {
                        let mut longer = way.clone();
                        longer.push((e, step, backwards));
                        ways.push((end, longer));
                        pending.push_back(ways.len() - 1);
                    }
                }
            }
        }
        None
    }

    /// The same where axes follow others: an angle is a sum of whole multiples of those that are known.
    fn sum(&self, d: Difference, steps: usize) -> Option<Vec<Leg>> {
        let edges: Vec<_> = self.edges.iter().filter(|e| e.1.is_none_or(|s| s < steps)).collect();
        let mut lattice = Lattice::default();
        edges.iter().for_each(|e| lattice.add(&self.chain.form(e.0)));
        let made = lattice.made(&self.chain.form(d))?;
        let legs = edges
            .iter()
            .zip(made)
            .flat_map(|((e, step), factor)| (0..factor.unsigned_abs()).map(move |_| (*e, *step, factor < 0)));
        Some(legs.collect())
    }

    /// The steps whose results are in a polynomial that is known after `steps` steps.
    pub(crate) fn steps_in(&self, p: &Poly, steps: usize) -> Vec<usize> {
        let mut found = vec![];
        for a in p.atoms() {
            match self.chain.algebra.kind(a) {
                Kind::Cos(n) | Kind::Sin(n) => {
                    let way = self.path(self.chain.differences[n], steps).unwrap_or_default();
                    found.extend(way.iter().filter_map(|w| w.1));
                }
                Kind::Slide(k) => {
                    found.extend(self.slides.iter().filter(|s| s.0 == k && s.1 < steps).map(|s| s.1))
                }
                Kind::Pose(_) | Kind::Constant(_) => {}
            }
        }
        found.sort_unstable();
        found.dedup();
        found
    }

    fn parts(&self, p: &Poly) -> Parts {
        if p.terms().len() <= 1 {
            return Parts::Term;
        }
        let common = p.monomial_content();
        let constants = common.factors().iter().filter(|f| self.rank(f.0) == 0);
        let common = constants.fold(Monomial::one(), |m, f| m.times(&Monomial::power(f.0, f.1)));
        let size = p.terms()[0].1.abs();
        let same = !size.is_one() && p.terms().iter().all(|t| t.1.abs() == size);
        if !common.is_one() || same {
            let number = if same { size } else { Rational::ONE };
            let inner = p.over(&common).scaled(&number.recip().unwrap_or(Rational::ONE));
            return Parts::Content(common, number, inner);
        }
        if self.is_constant(p) {
            return Parts::Sum(vec![], p.clone());
        }
        if let Some(apart) = self.apart(p) {
            return apart;
        }
        let (mut products, mut rest) = (vec![], p.clone());
        while !self.is_constant(&rest) && rest.terms().len() > 1 {
            let Some(atom) = outermost(&rest, |a| self.rank(a)) else { break };
            let (inside, left) = split(&rest, atom);
            products.push((atom, inside));
            rest = left;
        }
        Parts::Sum(products, rest)
    }

    /// What one length is the factor of, apart from the rest: C1px + S1py + d5(C6u + S6v).
    fn apart(&self, p: &Poly) -> Option<Parts> {
        let constants = p.atoms().into_iter().filter(|&a| self.rank(a) == 0);
        let linear = |a: &Atom| p.terms().iter().all(|t| t.0.exponent(*a) <= 1);
        for atom in constants.filter(linear) {
            let (inside, rest) = split(p, atom);
            let several = |p: &Poly| outermost(p, |a| self.rank(a)).is_some_and(|a| !split(p, a).1.is_zero());
            if inside.terms().len() > 1 && !rest.is_zero() && !self.is_constant(&inside) && several(&inside) {
                return Some(Parts::Apart(atom, inside, rest));
            }
        }
        None
    }

    /// A product: number, constants, sines and cosines, entries of the pose.
    fn monomial(&self, m: &Monomial, r: &Rational) -> Expr {
        let mut factors: Vec<(usize, Atom, u16)> =
            m.factors().iter().map(|&(a, n)| (self.place(a), a, n)).collect();
        factors.sort_unstable();
        factors.into_iter().fold(r.clone().into(), |product: Expr, (_, a, n)| {
            product * self.chain.algebra.expr(a).powi(i32::from(n))
        })
    }

    fn place(&self, a: Atom) -> usize {
        match self.chain.algebra.kind(a) {
            Kind::Constant(_) => 0,
            Kind::Slide(_) => 1,
            Kind::Cos(_) | Kind::Sin(_) => 2,
            Kind::Pose(_) => 3,
        }
    }

    /// The polynomial, the atom that becomes known last taken out first; `short` may have a name for a part.
    pub fn expr(&self, p: &Poly, short: Short) -> Expr {
        if p.is_zero() {
            return Expr::int(0);
        }
        if p.terms().len() > 1
            && let Some(name) = short(p)
        {
            return name;
        }
        match self.parts(p) {
            Parts::Term => self.monomial(&p.terms()[0].0, &p.terms()[0].1),
            Parts::Content(m, r, inner) => times(self.monomial(&m, &r), self.expr(&inner, short)),
            Parts::Apart(atom, inside, rest) => {
                self.expr(&rest, short) + self.chain.algebra.expr(atom) * self.expr(&inside, short)
            }
            Parts::Sum(products, rest) => {
                let (mut front, mut back, mut constants) = (vec![], vec![], vec![]);
                for (atom, inside) in products {
                    let product = self.product(atom, &inside, short);
                    if self.place(atom) == 2 && self.is_constant(&inside) {
                        back.push((atom, product));
                    } else {
                        front.push(product);
                    }
                }
                for (m, r) in rest.terms() {
                    let term = self.monomial(m, r);
                    let known: Vec<Atom> =
                        m.factors().iter().map(|f| f.0).filter(|&a| self.rank(a) > 0).collect();
                    match known[..] {
                        [] => constants.push(term),
                        [a] if self.place(a) == 2 && m.exponent(a) == 1 && m.factors().len() > 1 => {
                            back.push((a, term))
                        }
                        _ => front.push(term),
                    }
                }
                // a2C2 + a3C23: along the chain.
                back.sort_by_key(|b| b.0);
                let back = back.into_iter().map(|b| b.1);
                let first = if front.is_empty() { constants.split_off(0) } else { vec![] };
                let all = first.into_iter().chain(front).chain(back).chain(constants);
                positive_first(all.collect())
            }
        }
    }

    fn product(&self, atom: Atom, inside: &Poly, short: Short) -> Expr {
        if inside.terms().len() == 1 {
            let (m, r) = &inside.terms()[0];
            return self.monomial(&m.times(&Monomial::power(atom, 1)), r);
        }
        let x = self.chain.algebra.expr(atom);
        if short(inside).is_none()
            && let Parts::Content(m, r, inner) = self.parts(inside)
        {
            return times(self.monomial(&m, &r) * x, self.expr(&inner, short));
        }
        let within = self.expr(inside, short);
        if self.is_constant(inside) { within * x } else { times(x, within) }
    }

    /// Every part with more than one term that writing the polynomial meets, the whole first.
    pub fn walk(&self, p: &Poly, visit: &mut dyn FnMut(&Poly) -> bool) {
        if p.terms().len() <= 1 || !visit(p) {
            return;
        }
        match self.parts(p) {
            Parts::Term => {}
            Parts::Content(_, _, inner) => self.walk(&inner, visit),
            Parts::Apart(_, inside, rest) => {
                self.walk(&rest, visit);
                self.walk(&inside, visit);
            }
            Parts::Sum(products, _) => {
                for (_, inside) in products {
                    match self.parts(&inside) {
                        Parts::Content(_, _, inner) => self.walk(&inner, visit),
                        _ => self.walk(&inside, visit),
                    }
                }
            }
        }
    }

    /// The same without names.
    pub fn plain(&self, p: &Poly) -> Expr {
        self.expr(p, &|_| None)
    }

    /// A sum with its squares left as they are.
    pub fn norm(&self, n: &Norm, short: Short) -> Expr {
        let square = |sum: Expr, p: &Poly| sum + self.expr(p, short).powi(2);
        let squares = n.squares.iter().fold(Expr::int(0), square);
        if n.squares.is_empty() {
            return self.expr(&n.plus, short);
        }
        // − (a² + b²) reads better term by term.
        if self.is_constant(&n.plus) && short(&n.plus).is_none() {
            return n.plus.terms().iter().fold(squares, |sum, (m, r)| sum + self.monomial(m, r));
        }
        squares + self.expr(&n.plus, short)
    }

    /// The unknown that turns or moves an axis, by name: q2, or q234 for a sum.
    pub fn name(&self, x: Unknown) -> (Expr, Option<Expr>) {
        let value = self.chain.unknown_expr(x);
        if value.as_symbol().is_some() {
            return (value, None);
        }
        let index = index(self.chain, x);
        let is_sum = value.symbols().len() > 1
            && match x {
                Unknown::Angle(d) => self.chain.axes_between(d).iter().all(|&(k, negative)| {
                    let symbol = self.chain.axes[k].value.as_symbol();
                    !negative && symbol.is_some_and(|s| s.name().starts_with('q'))
                }),
                Unknown::Slide(_) => true,
            };
        let taken = |s: &str| self.chain.parameters.iter().any(|p| *p.name() == *s);
        let mut name = format!("{}{index}", if is_sum { "q" } else { "φ" });
        while taken(&name) || self.chain.variables.iter().any(|v| *v.name() == *name) {
            name.insert(0, 'θ');
        }
        (Expr::symbol(&name), Some(value))
    }
}

/// The product without brackets round a product.
fn times(x: Expr, y: Expr) -> Expr {
    match y.node() {
        denavit_symbolic::Node::Mul(a, b) => times(times(x, a), b),
        denavit_symbolic::Node::Neg(a) => -times(x, a),
        _ => x * y,
    }
}

/// The sum, a term without minus sign in front if there is one.
fn positive_first(mut terms: Vec<Expr>) -> Expr {
    let negative = |e: &Expr| match e.node() {
        denavit_symbolic::Node::Neg(_) => true,
        denavit_symbolic::Node::Number(r) => r.is_negative(),
        _ => false,
    };
    if terms.first().is_some_and(negative)
        && let Some(k) = terms.iter().position(|t| !negative(t))
    {
        let first = terms.remove(k);
        terms.insert(0, first);
    }
    terms.into_iter().reduce(|a, b| a + b).unwrap_or(Expr::int(0))
}

/// −p.
pub fn negated(p: &Poly) -> Poly {
    p.scaled(&-Rational::ONE)
}
