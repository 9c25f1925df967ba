//! Formulas as fractions of plain polynomials: every sine, cosine and root an atom, nothing replaced by any rule.
//!
//! This is the arithmetic of the checker (`check_certificate.py`), step by step, so that both expand a formula to the same
//! polynomials. It shares nothing with the canonical form but the polynomials themselves.

use crate::names::Names;
use denavit_symbolic::poly::{Atom, Monomial, Poly};
use denavit_symbolic::rules::Rules;
use denavit_symbolic::{Angle, Expr, Node, Rational, Symbol};
use rustc_hash::FxHashMap;
use std::fmt;

/// Why something cannot be certified.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Obstacle {
    /// The polynomials are larger than the bound.
    TooLarge,
    /// The difference of both sides is no sum of multiples of the relations.
    NoIdentity,
    /// A function that certificates do not know.
    Function,
    /// A denominator is 0.
    Undefined,
    /// It has a denominator where there must be none.
    Denominator,
    /// It rests on comparison in numbers, not on a proof.
    Compared,
}

impl fmt::Display for Obstacle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Obstacle::TooLarge => "its polynomials are too large",
            Obstacle::NoIdentity => "it does not follow from c² + s² = 1 and the squares of its roots",
            Obstacle::Function => "it holds a function that certificates do not know",
            Obstacle::Undefined => "a denominator is 0",
            Obstacle::Denominator => "it has a denominator, and so is not for Coq",
            Obstacle::Compared => "it was compared, not proved",
        })
    }
}

/// Numerator and denominator.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Value {
    /// The numerator.
    pub num: Poly,
    /// The denominator; 1 if it is constant.
    pub den: Poly,
}

impl From<Poly> for Value {
    fn from(num: Poly) -> Self {
        Value { num, den: Poly::one() }
    }
}

/// An angle with its sine and cosine.
#[derive(Clone, Debug)]
pub struct Base {
    /// A multiple of one symbol, or a constant.
    pub angle: Angle,
    /// Its cosine.
    pub cos: Atom,
    /// Its sine.
    pub sin: Atom,
}

/// A root that is adjoined.
#[derive(Clone, Debug)]
pub struct Root {
    /// The root.
    pub atom: Atom,
    /// Its square.
    pub square: Poly,
    /// What it is the root of.
    pub of: Expr,
}

/// The atoms and what formulas are in them.
pub struct Field {
    /// What atoms, parameters and definitions are called.
    pub names: Names,
    /// What each atom is called.
    pub atoms: Vec<String>,
    /// Angles, in order.
    pub bases: Vec<Base>,
    /// Roots, each of what stands before it.
    pub roots: Vec<Root>,
    /// Symbols that stand for themselves, in order.
    pub parameters: Vec<Symbol>,
    symbols: FxHashMap<Symbol, Value>,
    /// By what each symbol is divided in the angle whose sine is an atom.
    parts: FxHashMap<Symbol, i64>,
    memo: FxHashMap<Expr, Result<Value, Obstacle>>,
    /// What is left for all claims, and for the present one.
    work: [u64; 2],
}

/// Products of terms for one certificate, and for one claim: seconds. Products of long numbers count more.
const WORK: [u64; 2] = [8_000_000, 4_000_000];
/// Terms of a polynomial.
pub const MOST_TERMS: usize = 40_000;
/// Sums of constant angles that are tried for another one.
const MOST_SUMS: usize = 20_000;
/// The largest multiple of an angle and the largest exponent.
const MULTIPLE: i64 = 64;

impl Field {
    /// The field of formulas whose sines are of whole multiples of `parts` of the symbols.
    pub fn new(names: Names, parts: FxHashMap<Symbol, i64>) -> Self {
        let mut field = Field {
            names,
            atoms: vec![],
            bases: vec![],
            roots: vec![],
            parameters: vec![],
            symbols: FxHashMap::default(),
            parts,
            memo: FxHashMap::default(),
            work: WORK,
        };
        field.atom("pi".into());
        field
    }

    fn atom(&mut self, name: String) -> Atom {
        self.atoms.push(name);
        Atom::try_from(self.atoms.len() - 1).unwrap_or(Atom::MAX)
    }

    /// What a symbol stands for: itself, if it is not defined.
    pub fn symbol(&mut self, s: Symbol) -> Value {
        if let Some(known) = self.symbols.get(&s) {
            return known.clone();
        }
        let name = self.names.of(s);
        let atom = self.atom(name);
        self.parameters.push(s);
        self.symbols.insert(s, Poly::atom(atom).into());
        Poly::atom(atom).into()
    }

    /// Gives a symbol a value.
    pub fn define(&mut self, s: Symbol, value: Value) {
        self.symbols.insert(s, value);
    }

    /// True if the symbol has a meaning.
    pub fn knows(&self, s: Symbol) -> bool {
        self.symbols.contains_key(&s)
    }

    /// The product.
    ///
    /// # Errors
    /// If it is too large.
    pub fn times(&mut self, a: &Poly, b: &Poly) -> Result<Poly, Obstacle> {
        let work = &mut self.work;
        let product = Rules::default().times(a, b, |_, r| {
            let words = r.bits() / 64;
            let cost = if words < 2 { 1 } else { 16 + 2 * words * words };
            for left in work.iter_mut() {
                *left = left.checked_sub(cost).ok_or(Obstacle::TooLarge)?;
            }
            Ok(())
        })?;
        if product.terms().len() > MOST_TERMS { Err(Obstacle::TooLarge) } else { Ok(product) }
    }

    /// Another claim begins.
    pub fn begin_claim(&mut self) {
        self.work[1] = WORK[1];
    }

    fn power(&mut self, p: &Poly, n: u32) -> Result<Poly, Obstacle> {
        (0..n).try_fold(Poly::one(), |x, _| self.times(&x, p))
    }

    /// The value of a formula.
    ///
    /// # Errors
    /// See [`Obstacle`].
    pub fn value(&mut self, e: Expr) -> Result<Value, Obstacle> {
        for part in Expr::postorder(&[e]) {
            if !self.memo.contains_key(&part) {
                let value = self.of_node(part);
                self.memo.insert(part, value);
            }
        }
        self.memo[&e].clone()
    }

    /// The value of a formula without denominator.
    ///
    /// # Errors
    /// See [`Obstacle`].
    pub fn polynomial(&mut self, e: Expr) -> Result<Poly, Obstacle> {
        let value = self.value(e)?;
        if value.den == Poly::one() { Ok(value.num) } else { Err(Obstacle::Denominator) }
    }

    fn known(&self, e: Expr) -> Result<Value, Obstacle> {
        self.memo.get(&e).cloned().unwrap_or(Err(Obstacle::Function))
    }

    fn of_node(&mut self, e: Expr) -> Result<Value, Obstacle> {
        match e.node() {
            Node::Number(r) => Ok(Poly::constant(r).into()),
            Node::Pi => Ok(Poly::atom(0).into()),
            Node::Symbol(s) => Ok(self.symbol(s)),
            Node::Neg(a) => {
                let a = self.known(a)?;
                Ok(Value { num: Poly::zero().minus(&a.num), den: a.den })
            }
            Node::Add(a, b) => self.sum(a, b, &Rational::ONE),
            Node::Sub(a, b) => self.sum(a, b, &-Rational::ONE),
            Node::Mul(a, b) => {
                let (a, b) = (self.known(a)?, self.known(b)?);
                Ok(Value { num: self.times(&a.num, &b.num)?, den: self.times(&a.den, &b.den)? })
            }
            Node::Div(a, b) => {
                let (a, b) = (self.known(a)?, self.known(b)?);
                self.quotient(&a, &b)
            }
            Node::Pow(a, n) => {
                let a = self.known(a)?;
                let exponent = n.unsigned_abs();
                if i64::from(exponent) > MULTIPLE {
                    return Err(Obstacle::TooLarge);
                }
                let power = Value { num: self.power(&a.num, exponent)?, den: self.power(&a.den, exponent)? };
                if n < 0 { self.quotient(&Poly::one().into(), &power) } else { Ok(power) }
            }
            Node::Sqrt(a) => self.root(a).map(Value::from),
            Node::Sin(a) => Ok(self.sine(&Angle::of(a))?.0.into()),
            Node::Cos(a) => Ok(self.sine(&Angle::of(a))?.1.into()),
            Node::Atan2(..) | Node::Sign(_) => Err(Obstacle::Function),
        }
    }

    fn sum(&mut self, a: Expr, b: Expr, sign: &Rational) -> Result<Value, Obstacle> {
        let (a, b) = (self.known(a)?, self.known(b)?);
        if a.den == b.den {
            return Ok(Value { num: a.num.plus(&b.num.scaled(sign)), den: a.den });
        }
        let (x, y) = (self.times(&a.num, &b.den)?, self.times(&b.num, &a.den)?);
        Ok(Value { num: x.plus(&y.scaled(sign)), den: self.times(&a.den, &b.den)? })
    }

    fn quotient(&mut self, a: &Value, b: &Value) -> Result<Value, Obstacle> {
        let (num, den) = (self.times(&a.num, &b.den)?, self.times(&a.den, &b.num)?);
        if self.reduced(&den)?.1.is_zero() {
            return Err(Obstacle::Undefined);
        }
        Ok(match den.as_constant().and_then(|d| d.recip()) {
            Some(r) => num.scaled(&r).into(),
            None => Value { num, den },
        })
    }

    /// √a: of a number by the roots of its primes, of a polynomial by a root of its own.
    fn root(&mut self, a: Expr) -> Result<Poly, Obstacle> {
        let square = self.known(a)?;
        if square.den != Poly::one() {
            return Err(Obstacle::Function);
        }
        match square.num.as_constant() {
            None => Ok(self.root_of(&square.num, a)),
            Some(r) => {
                let (outside, primes) = root_of_number(&r).ok_or(Obstacle::Function)?;
                let mut root = Poly::constant(outside);
                for p in primes {
                    let of_prime = self.root_of(&Poly::constant(p.into()), Expr::int(p));
                    root = self.times(&root, &of_prime)?;
                }
                Ok(root)
            }
        }
    }

    fn root_of(&mut self, square: &Poly, of: Expr) -> Poly {
        if let Some(known) = self.roots.iter().find(|r| r.square == *square) {
            return Poly::atom(known.atom);
        }
        let wanted = of.as_number().map_or("root".into(), |_| format!("r{of:?}", of = square_text(square)));
        let name = self.names.new_name(&wanted);
        let atom = self.atom(name);
        self.roots.push(Root { atom, square: square.clone(), of });
        Poly::atom(atom)
    }

    /// Sine and cosine.
    ///
    /// # Errors
    /// If the angle is no sum of multiples of symbols and a constant.
    pub fn sine(&mut self, angle: &Angle) -> Result<(Poly, Poly), Obstacle> {
        let mut pair = (Poly::zero(), Poly::one());
        let terms = angle.terms.clone();
        for (x, k) in terms {
            let symbol = x.as_symbol().ok_or(Obstacle::Function)?;
            let part = self.parts.get(&symbol).copied().unwrap_or(1);
            let n = (&k * &Rational::from(part)).to_integer().ok_or(Obstacle::Function)?;
            if n.abs() > MULTIPLE {
                return Err(Obstacle::TooLarge);
            }
            let (s, c) = self.pair_of(symbol, part);
            let sign = Rational::from(n.signum());
            for _ in 0..n.abs() {
                pair = self.turned(&pair, &(s.scaled(&sign), c.clone()))?;
            }
        }
        self.constant(pair, angle)
    }

    /// Turns by the constant part of an angle.
    fn constant(&mut self, mut pair: (Poly, Poly), angle: &Angle) -> Result<(Poly, Poly), Obstacle> {
        let two = Rational::from(2);
        let mut quarters = (&angle.turns * &two).floor();
        let turns = &angle.turns - &(&quarters / &two);
        let rest = Angle { terms: vec![], turns, radians: angle.radians.clone() };
        let is_exact = rest.radians.is_zero() && (&rest.turns * &Rational::from(12)).is_integer();
        if is_exact && !rest.turns.is_zero() {
            let (s, c) = rest.to_expr().sin_cos();
            pair = {
                let exact = (self.polynomial(s)?, self.polynomial(c)?);
                self.turned(&pair, &exact)?
            };
        } else if rest != Angle::default() {
            let (pairs, more) = self.constant_pairs(&rest);
            quarters = &quarters + &more;
            for part in &pairs {
                pair = self.turned(&pair, part)?;
            }
        }
        let quarters = quarters.to_integer().ok_or(Obstacle::TooLarge)?.rem_euclid(4);
        Ok((0..quarters).fold(pair, |(s, c), _| (c, Poly::zero().minus(&s))))
    }

    /// Sines and cosines of up to three constant angles from whose sum an angle differs by quarter turns, and how many.
    fn constant_pairs(&mut self, rest: &Angle) -> (Vec<(Poly, Poly)>, Rational) {
        let signed: Vec<(Angle, (Poly, Poly))> = self
            .bases
            .iter()
            .filter(|b| b.angle.is_constant())
            .flat_map(|b| [Rational::ONE, -Rational::ONE].map(|sign| (b, sign)))
            .map(|(b, sign)| (b.angle.scaled(&sign), (Poly::atom(b.sin).scaled(&sign), Poly::atom(b.cos))))
            .collect();
        let n = signed.len();
        let sums = (1..=3_u32).filter(|&count| n.pow(count) <= MOST_SUMS);
        for (count, code) in sums.flat_map(|count| (0..n.pow(count)).map(move |code| (count, code))) {
            let parts: Vec<_> = (0..count).rev().map(|k| &signed[code / n.pow(k) % n]).collect();
            let turns = parts.iter().fold(rest.turns.clone(), |sum, p| &sum - &p.0.turns);
            let radians = parts.iter().fold(rest.radians.clone(), |sum, p| &sum - &p.0.radians);
            let quarters = &turns * &Rational::from(2);
            if radians.is_zero() && quarters.is_integer() {
                return (parts.into_iter().map(|p| p.1.clone()).collect(), quarters);
            }
        }
        let number = 1 + self.bases.iter().filter(|b| b.angle.is_constant()).count();
        let (s, c) = self.base(rest.clone(), &format!("a{number}"));
        (vec![(s, c)], Rational::ZERO)
    }

    fn pair_of(&mut self, symbol: Symbol, part: i64) -> (Poly, Poly) {
        let angle = Angle { terms: vec![(symbol.into(), Rational::new(1, part))], ..Angle::default() };
        if let Some(known) = self.bases.iter().find(|b| b.angle == angle) {
            return (Poly::atom(known.sin), Poly::atom(known.cos));
        }
        let name = self.names.of(symbol);
        let short = name.strip_prefix('q').filter(|d| d.bytes().all(|b| b.is_ascii_digit()) && !d.is_empty());
        let stem = short.map_or(format!("_{name}"), str::to_string);
        self.base(angle, &if part == 1 { stem } else { format!("{stem}_{part}") })
    }

    fn base(&mut self, angle: Angle, stem: &str) -> (Poly, Poly) {
        let [c, s] = ["c", "s"].map(|letter| self.names.new_name(&format!("{letter}{stem}")));
        let (cos, sin) = (self.atom(c), self.atom(s));
        self.bases.push(Base { angle, cos, sin });
        (Poly::atom(sin), Poly::atom(cos))
    }

    /// sin(a + b) and cos(a + b).
    fn turned(&mut self, a: &(Poly, Poly), b: &(Poly, Poly)) -> Result<(Poly, Poly), Obstacle> {
        let s = self.times(&a.0, &b.1)?.plus(&self.times(&a.1, &b.0)?);
        let c = self.times(&a.1, &b.1)?.minus(&self.times(&a.0, &b.0)?);
        Ok((s, c))
    }

    /// The atoms whose squares are replaced, and by what: roots first, the last one first, for they stand on what is before.
    pub fn squares(&self) -> Vec<(Atom, Poly)> {
        let roots = self.roots.iter().rev().map(|r| (r.atom, r.square.clone()));
        let sine = |b: &Base| {
            let cosine = Poly::term(Monomial::power(b.cos, 2), Rational::ONE);
            (b.sin, Poly::one().minus(&cosine))
        };
        roots.chain(self.bases.iter().rev().map(sine)).collect()
    }

    /// Divides by each relation x² − square: the quotients, and what is left.
    ///
    /// # Errors
    /// If a quotient is too large.
    pub fn reduced(&mut self, p: &Poly) -> Result<(Vec<(Atom, Poly)>, Poly), Obstacle> {
        let mut left = p.clone();
        let mut quotients = vec![];
        for (atom, square) in self.squares() {
            let mut quotient = Poly::zero();
            loop {
                let (high, low): (Vec<_>, Vec<_>) =
                    left.terms().iter().cloned().partition(|t| t.0.exponent(atom) > 1);
                if high.is_empty() {
                    break;
                }
                let two = Monomial::power(atom, 2);
                let part = Poly::from_terms(high.into_iter().map(|(m, r)| (m.over(&two), r)));
                left = Poly::from_terms(low).plus(&self.times(&part, &square)?);
                quotient = quotient.plus(&part);
                if quotient.terms().len() > MOST_TERMS {
                    return Err(Obstacle::TooLarge);
                }
            }
            if !quotient.is_zero() {
                quotients.push((atom, quotient));
            }
        }
        Ok((quotients, left))
    }
}

fn square_text(square: &Poly) -> i64 {
    square.as_constant().and_then(|r| r.to_integer()).unwrap_or(0)
}

/// √(n/d) as a rational times roots of primes.
pub fn root_of_number(r: &Rational) -> Option<(Rational, Vec<i64>)> {
    let (n, d) = r.to_parts()?;
    let mut rest = n.checked_mul(d).filter(|x| (0..1_000_000_000_000).contains(x))?;
    if rest == 0 {
        return Some((Rational::ZERO, vec![]));
    }
    let (mut outside, mut primes, mut p) = (Rational::new(1, d), vec![], 2);
    while p * p <= rest {
        if rest % (p * p) == 0 {
            rest /= p * p;
            outside = &outside * &Rational::from(p);
        } else if rest % p == 0 {
            rest /= p;
            primes.push(p);
        } else {
            p += 1;
        }
    }
    if rest > 1 {
        primes.push(rest);
    }
    Some((outside, primes))
}
