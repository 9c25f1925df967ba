//! Sparse polynomials in a fixed number of variables, over either field, and the bound on work.

use super::field::{Field, Gauss, Residue};
use rustc_hash::FxHashMap;
use smallvec::SmallVec;
use std::collections::BTreeMap;

/// The exponent of each variable.
pub(super) type Exponents = SmallVec<[u16; 12]>;

/// The bound on work was reached.
#[derive(Debug)]
pub(super) struct Exhausted;

/// Products of terms that may still be formed.
pub(super) struct Work(u64);

impl Work {
    /// So much work.
    pub fn new(limit: u64) -> Self {
        Work(limit)
    }

    /// Takes `n` off what is left.
    pub fn spend(&mut self, n: usize) -> Result<(), Exhausted> {
        self.0 = self.0.checked_sub(n as u64).ok_or(Exhausted)?;
        Ok(())
    }
}

/// Terms sorted by exponents, the largest first, without zero coefficients.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Sparse<K> {
    variables: usize,
    terms: Vec<(Exponents, K)>,
}

impl<K: Field> Sparse<K> {
    /// 0 in so many variables.
    pub fn zero(variables: usize) -> Self {
        Sparse { variables, terms: vec![] }
    }

    /// A constant.
    pub fn constant(variables: usize, k: K) -> Self {
        Self::from_terms(variables, [(SmallVec::from_elem(0, variables), k)])
    }

    /// From terms in any order, repeated ones added up.
    pub fn from_terms(variables: usize, terms: impl IntoIterator<Item = (Exponents, K)>) -> Self {
        let mut sum: FxHashMap<Exponents, K> = FxHashMap::default();
        for (e, k) in terms {
            match sum.get_mut(&e) {
                Some(have) => *have = have.plus(&k),
                None => {
                    sum.insert(e, k);
                }
            }
        }
        let mut terms: Vec<_> = sum.into_iter().filter(|t| !t.1.is_zero()).collect();
        terms.sort_unstable_by(|a, b| b.0.cmp(&a.0));
        Sparse { variables, terms }
    }

    /// How many variables there are.
    pub fn variables(&self) -> usize {
        self.variables
    }

    /// The terms, the largest first.
    pub fn terms(&self) -> &[(Exponents, K)] {
        &self.terms
    }

    /// True for 0.
    pub fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    /// True for a polynomial without variables.
    pub fn is_constant(&self) -> bool {
        self.terms.iter().all(|t| t.0.iter().all(|&e| e == 0))
    }

    /// The degree in a variable.
    pub fn degree(&self, x: usize) -> u16 {
        self.terms.iter().map(|t| t.0[x]).max().unwrap_or(0)
    }

    /// The variables that occur.
    pub fn used(&self) -> Vec<usize> {
        (0..self.variables).filter(|&x| self.terms.iter().any(|t| t.0[x] > 0)).collect()
    }

    /// The difference.
    pub fn minus(&self, o: &Self) -> Self {
        let negative = o.terms.iter().map(|(e, k)| (e.clone(), K::zero().minus(k)));
        Self::from_terms(self.variables, self.terms.iter().cloned().chain(negative))
    }

    /// The product.
    pub fn times(&self, o: &Self, work: &mut Work) -> Result<Self, Exhausted> {
        let cost = self.cost().max(o.cost());
        work.spend((self.terms.len() * o.terms.len()).saturating_mul(cost))?;
        let products =
            self.terms.iter().flat_map(|(a, x)| o.terms.iter().map(|(b, y)| (product(a, b), x.times(y))));
        Ok(Self::from_terms(self.variables, products))
    }

    /// What an operation with its dearest coefficient costs.
    pub fn cost(&self) -> usize {
        self.terms.iter().map(|t| t.1.cost()).max().unwrap_or(1)
    }

    /// The multiple `k·self`.
    pub fn scaled(&self, k: &K) -> Self {
        Self::from_terms(self.variables, self.terms.iter().map(|(e, c)| (e.clone(), c.times(k))))
    }

    /// The multiple whose first coefficient is 1.
    pub fn monic(self) -> Self {
        match self.terms.first().and_then(|t| t.1.inverse()) {
            Some(k) if k != K::one() => self.scaled(&k),
            _ => self,
        }
    }

    /// The largest monomial that divides every term.
    pub fn monomial(&self) -> Exponents {
        let mut all = self.terms.iter().map(|t| &t.0);
        let first = all.next().cloned().unwrap_or_else(|| SmallVec::from_elem(0, self.variables));
        all.fold(first, |m, e| m.iter().zip(e).map(|(a, b)| *a.min(b)).collect())
    }

    /// The quotient by a monomial that divides every term.
    pub fn over_monomial(mut self, m: &Exponents) -> Self {
        for (e, _) in &mut self.terms {
            e.iter_mut().zip(m).for_each(|(a, b)| *a -= b);
        }
        self
    }

    /// The product with a monomial.
    pub fn times_monomial(mut self, m: &Exponents) -> Self {
        for (e, _) in &mut self.terms {
            e.iter_mut().zip(m).for_each(|(a, b)| *a = a.saturating_add(*b));
        }
        self
    }

    /// The quotient if it is exact.
    pub fn divided(&self, d: &Self, work: &mut Work) -> Result<Option<Self>, Exhausted> {
        let (Some((lead, k)), Some((tail, _))) = (d.terms.first(), d.terms.last()) else { return Ok(None) };
        let (Some(inverse), Some((last, _))) = (k.inverse(), self.terms.last()) else {
            return Ok(self.is_zero().then(|| self.clone()));
        };
        if quotient(last, tail).is_none() || (0..self.variables).any(|x| d.degree(x) > self.degree(x)) {
            return Ok(None);
        }
        let mut rest: BTreeMap<Exponents, K> = self.terms.iter().cloned().collect();
        let mut terms = vec![];
        while let Some((e, c)) = rest.pop_last() {
            let Some(q) = quotient(&e, lead) else { return Ok(None) };
            let c = c.times(&inverse);
            work.spend((2 * d.terms.len()).saturating_mul(c.cost()))?;
            for (m, k) in &d.terms[1..] {
                let at = product(m, &q);
                let change = K::zero().minus(&k.times(&c));
                let sum = rest.get(&at).map_or_else(|| change.clone(), |have| have.plus(&change));
                if sum.is_zero() {
                    rest.remove(&at);
                } else {
                    rest.insert(at, sum);
                }
            }
            terms.push((q, c));
        }
        Ok(Some(Sparse { variables: self.variables, terms }))
    }

    /// The coefficients of the powers of a variable, the lowest power first.
    pub fn coefficients(&self, x: usize) -> Vec<(u16, Self)> {
        let mut parts: BTreeMap<u16, Vec<(Exponents, K)>> = BTreeMap::new();
        for (e, k) in &self.terms {
            let mut rest = e.clone();
            rest[x] = 0;
            parts.entry(e[x]).or_default().push((rest, k.clone()));
        }
        // The order of terms with the same power of x is that of the rest.
        parts.into_iter().map(|(n, terms)| (n, Sparse { variables: self.variables, terms })).collect()
    }

    /// The coefficient of the highest power of a variable.
    pub fn leading(&self, x: usize) -> Self {
        self.coefficients(x).pop().map_or_else(|| Self::zero(self.variables), |c| c.1)
    }

    /// The derivative by a variable.
    pub fn derivative(&self, x: usize) -> Self {
        let terms = self.terms.iter().filter(|t| t.0[x] > 0).map(|(e, k)| {
            let mut lower = e.clone();
            lower[x] -= 1;
            (lower, k.times(&K::int(e[x].into())))
        });
        Self::from_terms(self.variables, terms)
    }

    /// The polynomial with every variable but `x` replaced by a number, as coefficients from the lowest power.
    pub fn along(&self, x: usize, point: &[K]) -> Vec<K> {
        let mut out = vec![K::zero(); usize::from(self.degree(x)) + 1];
        for (e, k) in &self.terms {
            let factors = (0..self.variables).filter(|&y| y != x && e[y] > 0);
            let value = factors.fold(k.clone(), |v, y| v.times(&point[y].power(e[y])));
            let at = &mut out[usize::from(e[x])];
            *at = at.plus(&value);
        }
        out
    }
}

impl Sparse<Gauss> {
    /// The polynomial modulo the prime; `None` if the prime divides a denominator.
    pub fn residues(&self) -> Option<Sparse<Residue>> {
        let terms: Option<Vec<_>> =
            self.terms.iter().map(|(e, k)| Some((e.clone(), Residue::of(k)?))).collect();
        Some(Sparse::from_terms(self.variables, terms?))
    }
}

/// The product of two monomials; exponents that large are kept out by the bound on degrees and the proof at the end.
pub(super) fn product(a: &Exponents, b: &Exponents) -> Exponents {
    a.iter().zip(b).map(|(x, y)| x.saturating_add(*y)).collect()
}

/// The quotient of two monomials if it is one.
fn quotient(a: &Exponents, b: &Exponents) -> Option<Exponents> {
    a.iter().zip(b).map(|(x, y)| x.checked_sub(*y)).collect()
}
