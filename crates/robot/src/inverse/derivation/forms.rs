//! Polynomials as a search looks at them: in the basis of their unknowns, by powers of one, squared. The same ones are
//! asked for from one state after another, and are formed once.

use super::candidates::Problem;
use super::known::{Known, Unknown, Ways, rewritten};
use denavit_symbolic::Rational;
use denavit_symbolic::poly::{Monomial, Poly};
use rustc_hash::FxHashMap;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

/// A polynomial by powers of an unknown: (cosine, sine), or (displacement, 0).
pub(super) type View = BTreeMap<(u16, u16), Poly>;

/// What was formed.
#[derive(Debug, Default)]
pub(super) struct Forms {
    /// Squares of what is open of components of a position.
    squared: RefCell<FxHashMap<Poly, Poly>>,
    /// Polynomials in the basis of their unknowns, by the ways to the angles that were replaced.
    rewritten: RefCell<FxHashMap<Ways, FxHashMap<Poly, Poly>>>,
    /// Polynomials by powers of an unknown, which are asked for again from the next state on.
    views: RefCell<FxHashMap<Unknown, FxHashMap<Poly, Rc<View>>>>,
}

impl Problem<'_> {
    /// The polynomial with its unknown angles written in those of a basis.
    pub(super) fn in_basis(&self, known: &Known, p: &Poly, basis: &[Unknown]) -> Poly {
        let ways = known.ways(self.chain, p, basis);
        if ways.is_empty() {
            return p.clone();
        }
        let mut formed = self.forms.rewritten.borrow_mut();
        if let Some(found) = formed.get(&ways).and_then(|of| of.get(p)) {
            return found.clone();
        }
        let found = rewritten(self.chain, p, &ways);
        formed.entry(ways).or_default().insert(p.clone(), found.clone());
        found
    }

    /// The square, which is asked for again from the next state on.
    pub(super) fn squared(&self, p: &Poly) -> Poly {
        let mut formed = self.forms.squared.borrow_mut();
        if let Some(square) = formed.get(p) {
            return square.clone();
        }
        let square = self.chain.algebra.square(p);
        formed.insert(p.clone(), square.clone());
        square
    }

    /// A polynomial by powers of an unknown.
    pub(super) fn view(&self, p: &Poly, x: Unknown) -> Rc<View> {
        let mut views = self.forms.views.borrow_mut();
        if let Some(view) = views.get(&x).and_then(|of| of.get(p)) {
            return view.clone();
        }
        let view = Rc::new(self.viewed(p, x));
        views.entry(x).or_default().insert(p.clone(), view.clone());
        view
    }

    fn viewed(&self, p: &Poly, x: Unknown) -> View {
        let mut view: BTreeMap<(u16, u16), Vec<(Monomial, Rational)>> = BTreeMap::new();
        let (c, s) = self.atoms(x);
        for (m, r) in p.terms() {
            let key = (m.exponent(c), s.map_or(0, |s| m.exponent(s)));
            let rest = m.without(c);
            let rest = s.map_or(rest.clone(), |s| rest.without(s));
            view.entry(key).or_default().push((rest, r.clone()));
        }
        let polys = view.into_iter().map(|(k, terms)| (k, Poly::from_terms(terms)));
        polys.filter(|(_, p)| !self.samples.vanishes(p)).collect()
    }
}
