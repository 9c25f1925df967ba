//! The canonical form: polynomials in symbols, sines and cosines over a basis of angles, and square roots.
//!
//! A [`Ring`] is made for the formulas at hand. Each *generator* angle of its basis contributes two atoms, C and
//! S, with the rule S² → 1 − C²; each square root an atom with x² → radicand. Every rule mentions earlier
//! atoms only and the leading terms are coprime, so the normal form is unique: two formulas of the ring whose
//! atoms are independent are equal exactly when their normal forms are identical.

mod fraction;
mod lattice;

pub use fraction::Fraction;

use crate::expr::{Angle, Expr, Node, Symbol, natural_order};
use crate::poly::{Atom, Poly};
use crate::rational::Rational;
use crate::rules::Rules;
use rustc_hash::FxHashMap;
use std::fmt;
use std::rc::Rc;

/// What an atom stands for.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub enum AtomKind {
    /// A symbol.
    Symbol(Symbol),
    /// The constant π.
    Pi,
    /// The cosine of the generator with this number.
    Cos(usize),
    /// The sine of the generator with this number.
    Sin(usize),
    /// The square root of a squarefree integer above 1.
    Surd(i64),
    /// The square root, not negative, of a polynomial.
    Root(Poly),
    /// An arctangent or a sign of normalised arguments; nothing is known of it but its identity.
    Opaque(Expr),
}

/// Why a normal form was not computed.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Refusal {
    /// The expansion is larger than the ring's budget.
    TooLarge,
    /// A denominator is identically zero, or a root is taken of a negative constant.
    Undefined,
    /// An angle is no integer combination of the ring's basis.
    OutsideBasis,
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Refusal::TooLarge => "the expansion is too large to decide",
            Refusal::Undefined => {
                "a denominator is identically zero, or a root is taken of a negative number"
            }
            Refusal::OutsideBasis => "an angle is no whole multiple of the angles the formula is built on",
        })
    }
}

impl std::error::Error for Refusal {}

/// Products of terms that one ring may form. The pose of six angles takes hundreds; the bound keeps an expansion
/// within a second and some hundred megabytes.
const BUDGET: u64 = 600_000;
/// The largest multiple of a generator that is expanded: cos 64θ has 33 terms.
const MAX_MULTIPLE: i64 = 64;

/// A generator angle and its two atoms.
struct Generator {
    angle: Angle,
    cos: Atom,
    sin: Atom,
}

/// Atoms, their rules, and the normal forms found so far.
pub struct Ring {
    atoms: Vec<AtomKind>,
    rules: Rules,
    numbers: FxHashMap<AtomKind, Atom>,
    generators: Vec<Generator>,
    basis: Vec<Angle>,
    memo: FxHashMap<Expr, Result<Rc<Fraction>, Refusal>>,
    budget: u64,
}

impl Ring {
    /// The ring in which all of `exprs` have a normal form. Symbols are numbered in the order of `symbols`,
    /// others behind them by name; the basis of angles is taken from the sums that occur.
    pub fn new(exprs: &[Expr], symbols: &[Symbol]) -> Self {
        Self::with_basis(&[], exprs, symbols)
    }

    /// As [`Ring::new`], with the first generators given.
    pub fn with_basis(basis: &[Angle], exprs: &[Expr], symbols: &[Symbol]) -> Self {
        let mut ring = Ring {
            atoms: vec![],
            rules: Rules::default(),
            numbers: FxHashMap::default(),
            generators: vec![],
            basis: vec![],
            memo: FxHashMap::default(),
            budget: BUDGET,
        };
        let mut angles: Vec<Angle> = vec![];
        let mut names: Vec<Symbol> = vec![];
        for e in Expr::postorder(exprs) {
            match e.node() {
                Node::Sin(a) | Node::Cos(a) => angles.push(symbolic_part(&Angle::of(a))),
                Node::Symbol(s) => names.push(s),
                _ => {}
            }
        }
        names.sort_by(|a, b| natural_order(&a.name(), &b.name()));
        for &s in symbols.iter().chain(&names) {
            ring.atom(AtomKind::Symbol(s), None);
        }
        for angle in lattice::extend_basis(basis.to_vec(), &angles) {
            ring.generator(angle);
        }
        ring
    }

    /// The products of terms that were formed so far.
    pub(crate) fn spent(&self) -> u64 {
        BUDGET - self.budget
    }

    /// The basis of angles.
    pub fn basis(&self) -> &[Angle] {
        &self.basis
    }

    /// What an atom stands for.
    pub fn kind(&self, atom: Atom) -> &AtomKind {
        &self.atoms[usize::from(atom)]
    }

    /// The atoms C and S of each generator.
    pub fn pairs(&self) -> impl Iterator<Item = (Atom, Atom)> {
        self.generators.iter().map(|g| (g.cos, g.sin))
    }

    /// The angle of an atom that is its sine or cosine.
    pub(crate) fn angle_of(&self, atom: Atom) -> Option<&Angle> {
        match self.kind(atom) {
            AtomKind::Cos(g) | AtomKind::Sin(g) => Some(&self.generators[*g].angle),
            _ => None,
        }
    }

    /// The atom of a symbol.
    pub(crate) fn atom_of(&self, symbol: Symbol) -> Option<Atom> {
        self.numbers.get(&AtomKind::Symbol(symbol)).copied()
    }

    /// True if different normal forms prove different functions: every atom is free, a sine or cosine of an
    /// independent angle, or the root of a squarefree integer.
    pub(crate) fn is_independent(&self, p: &Poly) -> bool {
        p.atoms().into_iter().all(|a| match self.kind(a) {
            AtomKind::Symbol(_) | AtomKind::Pi => true,
            AtomKind::Surd(_) => true,
            AtomKind::Cos(g) | AtomKind::Sin(g) => {
                let angle = &self.generators[*g].angle;
                !angle.is_constant() && angle.terms.iter().all(|t| t.0.as_symbol().is_some())
            }
            AtomKind::Root(_) | AtomKind::Opaque(_) => false,
        })
    }

    fn atom(&mut self, kind: AtomKind, rule: Option<Poly>) -> Atom {
        if let Some(&a) = self.numbers.get(&kind) {
            return a;
        }
        let number = Atom::try_from(self.atoms.len()).expect("fewer than 65536 atoms in a formula");
        self.atoms.push(kind.clone());
        if let Some(square) = rule {
            self.rules.set(number, square);
        }
        self.numbers.insert(kind, number);
        number
    }

    fn generator(&mut self, angle: Angle) -> usize {
        let number = self.generators.len();
        let cos = self.atom(AtomKind::Cos(number), None);
        let sin = self.atom(AtomKind::Sin(number), None);
        self.rules.set_pair(cos, sin);
        if !angle.is_constant() {
            self.basis.push(angle.clone());
        }
        self.generators.push(Generator { angle, cos, sin });
        number
    }

    /// The product in normal form.
    ///
    /// # Errors
    /// [`Refusal::TooLarge`] once the ring's budget is used up.
    pub fn times(&mut self, a: &Poly, b: &Poly) -> Result<Poly, Refusal> {
        let budget = &mut self.budget;
        self.rules.times(a, b, |_, r| {
            // Numbers beyond machine words take memory of their own, long ones the square of their length.
            let words = r.bits() / 64;
            let cost = if words < 2 { 1 } else { 8 + words * words / 8 };
            *budget = budget.checked_sub(cost).ok_or(Refusal::TooLarge)?;
            Ok(())
        })
    }

    /// `pⁿ` in normal form.
    ///
    /// # Errors
    /// [`Refusal::TooLarge`] once the ring's budget is used up.
    pub fn power(&mut self, p: &Poly, n: u32) -> Result<Poly, Refusal> {
        let (mut result, mut base, mut n) = (Poly::one(), p.clone(), n);
        while n > 0 {
            if n & 1 == 1 {
                result = self.times(&result, &base)?;
            }
            n >>= 1;
            if n > 0 {
                base = self.times(&base, &base)?;
            }
        }
        Ok(result)
    }

    /// The normal form of an expression.
    ///
    /// # Errors
    /// See [`Refusal`].
    pub fn normal(&mut self, e: Expr) -> Result<Rc<Fraction>, Refusal> {
        if let Some(known) = self.memo.get(&e) {
            return known.clone();
        }
        for part in self.parts(e) {
            let form = self.normal_node(part).map(Rc::new);
            self.memo.insert(part, form);
        }
        self.memo[&e].clone()
    }

    /// What has to be known before an expression, each once, parts before wholes, the expression last. Of a sum its terms:
    /// the sums of the first of them, each as long as all before, are not kept.
    fn parts(&self, e: Expr) -> Vec<Expr> {
        let mut seen = rustc_hash::FxHashSet::from_iter([e]);
        let mut parts = vec![e];
        let mut next = 0;
        while next < parts.len() {
            let part = parts[next];
            let operands: Vec<Expr> = match part.node() {
                Node::Add(..) | Node::Sub(..) => self.summands(part).into_iter().map(|s| s.0).collect(),
                _ => part.children().collect(),
            };
            parts.extend(operands.into_iter().filter(|o| !self.memo.contains_key(o) && seen.insert(*o)));
            next += 1;
        }
        parts.sort_unstable(); // a node is always newer than its parts
        parts
    }

    /// The terms of a sum that was put together from the left, and whether each is subtracted.
    fn summands(&self, e: Expr) -> Vec<(Expr, bool)> {
        let mut found = vec![];
        let mut at = e;
        loop {
            let (rest, term) = match at.node() {
                Node::Add(a, b) if at == e || !self.memo.contains_key(&at) => (a, (b, false)),
                Node::Sub(a, b) if at == e || !self.memo.contains_key(&at) => (a, (b, true)),
                _ => {
                    found.push((at, false));
                    found.reverse();
                    return found;
                }
            };
            found.push(term);
            at = rest;
        }
    }

    /// The sum of the terms of a sum, neighbours first.
    fn total(&mut self, e: Expr) -> Result<Fraction, Refusal> {
        let mut all: Vec<Fraction> = vec![];
        for (term, is_subtracted) in self.summands(e) {
            let form = self.normal(term)?;
            all.push(if is_subtracted { form.scaled(&-Rational::ONE) } else { (*form).clone() });
        }
        while all.len() > 1 {
            let mut sums = Vec::with_capacity(all.len().div_ceil(2));
            for pair in all.chunks(2) {
                sums.push(match pair {
                    [a, b] => self.add(a, b)?,
                    _ => pair[0].clone(),
                });
            }
            all = sums;
        }
        Ok(all.pop().unwrap_or_else(|| Poly::zero().into()))
    }

    /// The normal form of a polynomial expression; `Undefined` if it has a denominator.
    ///
    /// # Errors
    /// See [`Refusal`].
    pub fn polynomial(&mut self, e: Expr) -> Result<Poly, Refusal> {
        let f = self.normal(e)?;
        if f.den.is_empty() { Ok(f.num.clone()) } else { Err(Refusal::Undefined) }
    }

    fn normal_node(&mut self, e: Expr) -> Result<Fraction, Refusal> {
        Ok(match e.node() {
            Node::Number(r) => Poly::constant(r).into(),
            Node::Pi => Poly::atom(self.atom(AtomKind::Pi, None)).into(),
            Node::Symbol(s) => Poly::atom(self.atom(AtomKind::Symbol(s), None)).into(),
            Node::Neg(a) => self.normal(a)?.scaled(&-Rational::ONE),
            Node::Add(..) | Node::Sub(..) => self.total(e)?,
            Node::Mul(a, b) => {
                let (a, b) = (self.normal(a)?, self.normal(b)?);
                self.multiply(&a, &b)?
            }
            Node::Div(a, b) => {
                let (a, b) = (self.normal(a)?, self.normal(b)?);
                let inverse = self.invert(&b)?;
                self.multiply(&a, &inverse)?
            }
            Node::Pow(a, n) => {
                let a = self.normal(a)?;
                let base = if n < 0 { self.invert(&a)? } else { (*a).clone() };
                self.raise(&base, n.unsigned_abs())?
            }
            Node::Sqrt(a) => {
                let a = self.normal(a)?;
                self.root(&a)?
            }
            Node::Sin(a) => self.sin_cos(&Angle::of(a))?.0,
            Node::Cos(a) => self.sin_cos(&Angle::of(a))?.1,
            Node::Atan2(y, x) => {
                let (y, x) = (self.normal(y)?, self.normal(x)?);
                let key = self.fraction_expr(&y).atan2(self.fraction_expr(&x));
                Poly::atom(self.atom(AtomKind::Opaque(key), None)).into()
            }
            Node::Sign(a) => {
                let a = self.normal(a)?;
                // It is odd: of two arguments with opposite signs one has a name.
                let turned = a.num.terms().first().is_some_and(|t| t.1.is_negative());
                let by = if turned { -Rational::ONE } else { Rational::ONE };
                let key = self.fraction_expr(&a.scaled(&by)).sign();
                match key.as_number() {
                    Some(known) => Poly::constant(&known * &by).into(),
                    None => Fraction::from(Poly::atom(self.atom(AtomKind::Opaque(key), None))).scaled(&by),
                }
            }
        })
    }

    /// √(n/d) = √(n·d) / √(d²), with rational squares taken out of the roots.
    fn root(&mut self, f: &Fraction) -> Result<Fraction, Refusal> {
        let den = self.expanded_denominator(f)?;
        let radicand = self.times(&f.num, &den)?;
        let top = self.root_of(&radicand)?;
        let square = self.times(&den, &den)?;
        let bottom = self.root_of(&square)?;
        let inverse = self.invert(&bottom.into())?;
        self.multiply(&top.into(), &inverse)
    }

    fn root_of(&mut self, p: &Poly) -> Result<Poly, Refusal> {
        if p.is_zero() {
            return Ok(Poly::zero());
        }
        let content = p.terms()[0].1.abs();
        let primitive = p.scaled(&content.recip().unwrap_or(Rational::ONE));
        let mut root = self.root_of_number(&content)?;
        match primitive.as_constant() {
            Some(r) if r.is_negative() => return Err(Refusal::Undefined),
            Some(_) => {}
            None => {
                let atom = self.atom(AtomKind::Root(primitive.clone()), Some(primitive));
                root = self.times(&root, &Poly::atom(atom))?;
            }
        }
        Ok(root)
    }

    /// √(n/d) = √(n·d)/d as a rational times roots of primes; factors beyond trial division stay together.
    fn root_of_number(&mut self, r: &Rational) -> Result<Poly, Refusal> {
        if let Some(exact) = r.sqrt() {
            return Ok(Poly::constant(exact));
        }
        let (n, d) = r.to_parts().ok_or(Refusal::TooLarge)?;
        let mut outside = Rational::new(1, d);
        let mut root = Poly::one();
        for mut rest in [n, d] {
            let mut p: i64 = 2;
            while rest > 1 {
                if p > 100_000 || p.saturating_mul(p) > rest {
                    p = rest; // a prime, or two large ones that stay together
                }
                let mut odd = false;
                while rest % p == 0 {
                    rest /= p;
                    if odd {
                        outside = &outside * &Rational::from(p);
                    }
                    odd = !odd;
                }
                if odd {
                    let atom = self.atom(AtomKind::Surd(p), Some(Poly::constant(p.into())));
                    root = self.times(&root, &Poly::atom(atom))?;
                }
                p += 1;
            }
        }
        Ok(root.scaled(&outside))
    }

    /// Sine and cosine of an angle, expanded over the generators.
    fn sin_cos(&mut self, angle: &Angle) -> Result<(Fraction, Fraction), Refusal> {
        let numbers =
            lattice::coordinates(&symbolic_part(angle), &self.basis).ok_or(Refusal::OutsideBasis)?;
        let mut rest = angle.clone();
        let mut sum: (Fraction, Fraction) = (Poly::zero().into(), Poly::one().into());
        let of_basis: Vec<usize> =
            (0..self.generators.len()).filter(|&g| !self.generators[g].angle.is_constant()).collect();
        for (&g, &n) in of_basis.iter().zip(&numbers) {
            if n != 0 {
                let generator = &self.generators[g];
                rest = rest.plus(&generator.angle.scaled(&Rational::from(-n)));
                let pair = (Poly::atom(generator.sin).into(), Poly::atom(generator.cos).into());
                let multiple = self.multiple(pair, n)?;
                sum = self.add_angles(&sum, &multiple)?;
            }
        }
        for (term, k) in rest.terms.clone() {
            // What is left are arctangents, whose sine and cosine are y/√(x²+y²) and x/√(x²+y²).
            let (Node::Atan2(y, x), Some(n)) = (term.node(), k.to_integer()) else {
                return Err(Refusal::OutsideBasis);
            };
            let length = (x * x + y * y).sqrt();
            let pair = ((*self.normal(y / length)?).clone(), (*self.normal(x / length)?).clone());
            let multiple = self.multiple(pair, n)?;
            sum = self.add_angles(&sum, &multiple)?;
        }
        let constant = Angle { terms: vec![], ..rest };
        if constant != Angle::default() {
            let pair = self.constant_pair(&constant)?;
            sum = self.add_angles(&sum, &pair)?;
        }
        Ok(sum)
    }

    /// Sine and cosine of a constant angle: exact, or a pair of atoms of its own.
    fn constant_pair(&mut self, constant: &Angle) -> Result<(Fraction, Fraction), Refusal> {
        let (s, c) = constant.clone().sin_cos();
        let mut pair = [s, c].map(|e| (e, None));
        for (e, form) in &mut pair {
            let (number, base) = e.split_number();
            *form = match base.node() {
                Node::Sin(a) | Node::Cos(a) => {
                    let angle = Angle::of(a);
                    let known = self.generators.iter().position(|g| g.angle == angle);
                    let g = known.unwrap_or_else(|| self.generator(angle));
                    let cosine = matches!(base.node(), Node::Cos(_));
                    let atom = if cosine { self.generators[g].cos } else { self.generators[g].sin };
                    Some(Fraction::from(Poly::atom(atom)).scaled(&number))
                }
                _ => Some((*self.normal(*e)?).clone()),
            };
        }
        let [(_, Some(s)), (_, Some(c))] = pair else { return Err(Refusal::Undefined) };
        Ok((s, c))
    }

    /// Sine and cosine of n times the angle of a pair, by doubling.
    fn multiple(&mut self, pair: (Fraction, Fraction), n: i64) -> Result<(Fraction, Fraction), Refusal> {
        if n.abs() > MAX_MULTIPLE {
            return Err(Refusal::TooLarge);
        }
        let mut power = if n < 0 { (pair.0.scaled(&-Rational::ONE), pair.1) } else { pair };
        let mut n = n.unsigned_abs();
        let mut sum: (Fraction, Fraction) = (Poly::zero().into(), Poly::one().into());
        while n > 0 {
            if n & 1 == 1 {
                sum = self.add_angles(&sum, &power)?;
            }
            n >>= 1;
            if n > 0 {
                power = self.add_angles(&power, &power)?;
            }
        }
        Ok(sum)
    }

    /// sin(a+b) = sa·cb + ca·sb, cos(a+b) = ca·cb − sa·sb.
    fn add_angles(
        &mut self,
        (sa, ca): &(Fraction, Fraction),
        (sb, cb): &(Fraction, Fraction),
    ) -> Result<(Fraction, Fraction), Refusal> {
        let (x, y) = (self.multiply(sa, cb)?, self.multiply(ca, sb)?);
        let s = self.add(&x, &y)?;
        let (x, y) = (self.multiply(ca, cb)?, self.multiply(sa, sb)?.scaled(&-Rational::ONE));
        Ok((s, self.add(&x, &y)?))
    }

    /// An atom as an expression.
    pub fn atom_expr(&self, atom: Atom) -> Expr {
        match self.kind(atom) {
            AtomKind::Symbol(s) => (*s).into(),
            AtomKind::Pi => Expr::pi(),
            AtomKind::Cos(g) => self.generators[*g].angle.to_expr().cos(),
            AtomKind::Sin(g) => self.generators[*g].angle.to_expr().sin(),
            AtomKind::Surd(n) => Expr::int(*n).sqrt(),
            AtomKind::Root(p) => self.poly_expr(p).sqrt(),
            AtomKind::Opaque(e) => *e,
        }
    }

    /// A polynomial as a plain sum of products (for a form to read, see the module `readable`).
    pub fn poly_expr(&self, p: &Poly) -> Expr {
        p.to_expr(|a| self.atom_expr(a))
    }

    fn fraction_expr(&self, f: &Fraction) -> Expr {
        let den = f.den.iter().fold(Expr::int(1), |x, (p, n)| x * self.poly_expr(p).powi(*n as i32));
        self.poly_expr(&f.num) / den
    }
}

/// The angle without arctangents, which have a sine and cosine of their own.
fn symbolic_part(angle: &Angle) -> Angle {
    let keeps = |e: Expr, k: &Rational| !matches!(e.node(), Node::Atan2(..)) || !k.is_integer();
    Angle { terms: angle.terms.iter().filter(|(e, k)| keeps(*e, k)).cloned().collect(), ..angle.clone() }
}
