//! The expression graph: hash-consed nodes behind a `Copy` handle.
//!
//! Equal structure means equal handle. The constructors keep the order in which a formula was written and
//! normalise only what no reader would miss: numbers are folded and stand in front of a product, signs move
//! outwards (`a·(−b)` is `−(a·b)`), `0` and `1` disappear, and the argument of a sine or cosine is a sorted sum
//! of angles without quarter turns or leading sign (`cos(θ + π/2)` is `−sin θ`).
//!
//! Nodes live in a store of the thread, which grows until the thread ends; [`scoped`] gives a piece of work a store of
//! its own.

mod angle;
mod store;

pub use angle::Angle;
pub use store::{scoped, store_size};

use crate::rational::Rational;
use rustc_hash::FxHashMap;
use std::fmt;
use std::marker::PhantomData;
use std::ops::{Add, Div, Mul, Neg, Sub};
use std::rc::Rc;

/// A name that stands for a number: a length, an angle.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Symbol(u32, PhantomData<*const ()>);

/// A handle to a node of the graph. Copying is free; `==` compares structure in constant time.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Expr(u32, PhantomData<*const ()>);

/// What an expression is made of.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub enum Node {
    /// A rational constant.
    Number(Rational),
    /// The constant π.
    Pi,
    /// A named quantity.
    Symbol(Symbol),
    /// `−a`
    Neg(Expr),
    /// `a + b`
    Add(Expr, Expr),
    /// `a − b`
    Sub(Expr, Expr),
    /// `a · b`
    Mul(Expr, Expr),
    /// `a / b`
    Div(Expr, Expr),
    /// `aⁿ` for an integer n
    Pow(Expr, i32),
    /// `√a`, the root that is not negative
    Sqrt(Expr),
    /// `sin a`
    Sin(Expr),
    /// `cos a`
    Cos(Expr),
    /// `atan2(y, x)`, in (−π, π]
    Atan2(Expr, Expr),
    /// The sign of `a`: 1, −1, or 0 where it is 0
    Sign(Expr),
}

fn intern(node: Node) -> Expr {
    Expr(store::intern(node), PhantomData)
}

/// 1, −1, or the number itself where it is 0 or none.
fn sign(x: f64) -> f64 {
    if x > 0.0 {
        1.0
    } else if x < 0.0 {
        -1.0
    } else {
        x
    }
}

impl Symbol {
    /// The symbol with this name.
    pub fn new(name: &str) -> Self {
        Symbol(store::intern_name(name), PhantomData)
    }

    /// Its name.
    pub fn name(self) -> Rc<str> {
        store::name(self.0)
    }
}

impl Expr {
    /// The symbol with this name, as an expression.
    pub fn symbol(name: &str) -> Self {
        Symbol::new(name).into()
    }

    /// An integer.
    pub fn int(n: i64) -> Self {
        Rational::from(n).into()
    }

    /// The constant π.
    pub fn pi() -> Self {
        intern(Node::Pi)
    }

    /// The node behind the handle.
    pub fn node(self) -> Node {
        store::node(self.0)
    }

    /// The value if the node is a rational constant.
    pub fn as_number(self) -> Option<Rational> {
        match self.node() {
            Node::Number(r) => Some(r),
            _ => None,
        }
    }

    /// The symbol if the node is one.
    pub fn as_symbol(self) -> Option<Symbol> {
        match self.node() {
            Node::Symbol(s) => Some(s),
            _ => None,
        }
    }

    /// True if the node is the constant 0 (a formula that is 0 for other reasons is not found here).
    pub fn is_zero(self) -> bool {
        matches!(self.node(), Node::Number(r) if r.is_zero())
    }

    /// True if the node is the constant 1.
    pub fn is_one(self) -> bool {
        matches!(self.node(), Node::Number(r) if r.is_one())
    }

    /// The nodes that this one is built from.
    pub fn children(self) -> impl Iterator<Item = Expr> {
        let (a, b) = match self.node() {
            Node::Number(_) | Node::Pi | Node::Symbol(_) => (None, None),
            Node::Neg(a) | Node::Pow(a, _) | Node::Sqrt(a) | Node::Sin(a) | Node::Cos(a) | Node::Sign(a) => {
                (Some(a), None)
            }
            Node::Add(a, b) | Node::Sub(a, b) | Node::Mul(a, b) | Node::Div(a, b) | Node::Atan2(a, b) => {
                (Some(a), Some(b))
            }
        };
        a.into_iter().chain(b)
    }

    /// `selfⁿ`.
    pub fn powi(self, n: i32) -> Self {
        match (self.node(), n) {
            (_, 0) => Expr::int(1),
            (_, 1) => self,
            (Node::Number(r), _) => r.pow(n).map_or_else(|| intern(Node::Pow(self, n)), Expr::from),
            (Node::Neg(a), _) if n % 2 == 0 => a.powi(n),
            (Node::Neg(a), _) => -a.powi(n),
            (Node::Pow(a, m), _) if n.checked_mul(m).is_some() => a.powi(n * m),
            _ => intern(Node::Pow(self, n)),
        }
    }

    /// The square root that is not negative.
    pub fn sqrt(self) -> Self {
        match self.as_number().and_then(|r| r.sqrt()) {
            Some(r) => r.into(),
            None => intern(Node::Sqrt(self)),
        }
    }

    /// The sine; the argument is an angle in radians.
    pub fn sin(self) -> Self {
        Angle::of(self).sin_cos().0
    }

    /// The cosine; the argument is an angle in radians.
    pub fn cos(self) -> Self {
        Angle::of(self).sin_cos().1
    }

    /// Sine and cosine.
    pub fn sin_cos(self) -> (Self, Self) {
        Angle::of(self).sin_cos()
    }

    /// The angle of the point (x, y) in (−π, π], `y.atan2(x)` as in the standard library.
    pub fn atan2(self, x: Expr) -> Self {
        if let (true, Some(x)) = (self.is_zero(), x.as_number())
            && !x.is_zero()
        {
            return if x.is_negative() { Expr::pi() } else { Expr::int(0) };
        }
        intern(Node::Atan2(self, x))
    }

    /// The sign: 1, −1, or 0 at 0.
    pub fn sign(self) -> Self {
        match self.node() {
            Node::Number(r) if r.is_zero() => self,
            Node::Number(r) => Expr::int(if r.is_negative() { -1 } else { 1 }),
            Node::Pi => Expr::int(1),
            Node::Neg(a) => -a.sign(),
            _ => intern(Node::Sign(self)),
        }
    }

    /// All nodes under `roots`, each once, parts before wholes.
    pub fn postorder(roots: &[Expr]) -> Vec<Expr> {
        Expr::postorder_of_new(roots, |_| false)
    }

    /// The nodes under `roots` that are not known, each once, parts before wholes; what only known ones hold is not looked at.
    pub fn postorder_of_new(roots: &[Expr], is_known: impl Fn(Expr) -> bool) -> Vec<Expr> {
        let mut seen: rustc_hash::FxHashSet<Expr> = roots.iter().copied().filter(|&e| !is_known(e)).collect();
        let mut order: Vec<Expr> = seen.iter().copied().collect();
        let mut next = 0;
        while next < order.len() {
            order.extend(
                order[next].children().filter(|&c| !is_known(c) && seen.insert(c)).collect::<Vec<_>>(),
            );
            next += 1;
        }
        order.sort_unstable(); // a node is always newer than its parts
        order
    }

    /// The symbols that occur, in the order of their names (`d2` before `d10`).
    pub fn symbols(self) -> Vec<Symbol> {
        let mut found: Vec<Symbol> =
            Expr::postorder(&[self]).into_iter().filter_map(Expr::as_symbol).collect();
        found.sort_by(|a, b| natural_order(&a.name(), &b.name()));
        found
    }

    /// Each node rebuilt bottom-up, where `leaf` answers for symbols (`None` keeps them).
    pub fn substitute(self, leaf: impl Fn(Symbol) -> Option<Expr>) -> Expr {
        let mut new: FxHashMap<Expr, Expr> = FxHashMap::default();
        for e in Expr::postorder(&[self]) {
            let built = match e.node() {
                Node::Number(_) | Node::Pi => e,
                Node::Symbol(s) => leaf(s).unwrap_or(e),
                Node::Neg(a) => -new[&a],
                Node::Add(a, b) => new[&a] + new[&b],
                Node::Sub(a, b) => new[&a] - new[&b],
                Node::Mul(a, b) => new[&a] * new[&b],
                Node::Div(a, b) => new[&a] / new[&b],
                Node::Pow(a, n) => new[&a].powi(n),
                Node::Sqrt(a) => new[&a].sqrt(),
                Node::Sin(a) => new[&a].sin(),
                Node::Cos(a) => new[&a].cos(),
                Node::Atan2(a, b) => new[&a].atan2(new[&b]),
                Node::Sign(a) => new[&a].sign(),
            };
            new.insert(e, built);
        }
        new[&self]
    }

    /// The value in double precision; `leaf` gives the symbols theirs.
    ///
    /// # Errors
    /// The first symbol without a value.
    pub fn eval(self, leaf: impl Fn(Symbol) -> Option<f64>) -> Result<f64, Symbol> {
        let mut value: FxHashMap<Expr, f64> = FxHashMap::default();
        for e in Expr::postorder(&[self]) {
            let x = match e.node() {
                Node::Number(r) => r.to_f64(),
                Node::Pi => std::f64::consts::PI,
                Node::Symbol(s) => leaf(s).ok_or(s)?,
                Node::Neg(a) => -value[&a],
                Node::Add(a, b) => value[&a] + value[&b],
                Node::Sub(a, b) => value[&a] - value[&b],
                Node::Mul(a, b) => value[&a] * value[&b],
                Node::Div(a, b) => value[&a] / value[&b],
                Node::Pow(a, n) => value[&a].powi(n),
                Node::Sqrt(a) => value[&a].sqrt(),
                Node::Sin(a) => value[&a].sin(),
                Node::Cos(a) => value[&a].cos(),
                Node::Atan2(a, b) => value[&a].atan2(value[&b]),
                Node::Sign(a) => sign(value[&a]),
            };
            value.insert(e, x);
        }
        Ok(value[&self])
    }

    /// Number and rest of a product: `3/2·x` is (3/2, x).
    pub(crate) fn split_number(self) -> (Rational, Expr) {
        match self.node() {
            Node::Number(r) => (r, Expr::int(1)),
            Node::Neg(a) => {
                let (r, x) = a.split_number();
                (-r, x)
            }
            Node::Mul(a, b) => match a.as_number() {
                Some(r) => (r, b),
                None => (Rational::ONE, self),
            },
            _ => (Rational::ONE, self),
        }
    }

    /// `r·x`, for an `x` without number or sign in front.
    pub(crate) fn with_number(r: &Rational, x: Expr) -> Expr {
        if r.is_zero() {
            Expr::int(0)
        } else if r.is_negative() {
            -Expr::with_number(&-r, x)
        } else if r.is_one() {
            x
        } else if x.is_one() {
            r.clone().into()
        } else {
            intern(Node::Mul(r.clone().into(), x))
        }
    }

    /// `Sin` or `Cos` of an argument that is already in normal form.
    pub(crate) fn trig_node(node: Node) -> Expr {
        intern(node)
    }
}

/// Sign and magnitude: −x is (true, x).
fn split_sign(e: Expr) -> (bool, Expr) {
    match e.node() {
        Node::Neg(a) => (true, a),
        Node::Number(r) if r.is_negative() => (true, Expr::from(-r)),
        _ => (false, e),
    }
}

impl From<Rational> for Expr {
    fn from(r: Rational) -> Self {
        intern(Node::Number(r))
    }
}

impl From<Symbol> for Expr {
    fn from(s: Symbol) -> Self {
        intern(Node::Symbol(s))
    }
}

impl Neg for Expr {
    type Output = Expr;
    fn neg(self) -> Expr {
        match self.node() {
            Node::Number(r) => (-r).into(),
            Node::Neg(a) => a,
            // −(a − b) is b − a; of a longer sum the sign stays in front
            Node::Sub(a, b) if !matches!(a.node(), Node::Add(..) | Node::Sub(..)) => intern(Node::Sub(b, a)),
            _ => intern(Node::Neg(self)),
        }
    }
}

impl Add for Expr {
    type Output = Expr;
    fn add(self, o: Expr) -> Expr {
        match (self.as_number(), o.as_number()) {
            (Some(a), Some(b)) => return (a + b).into(),
            (Some(a), _) if a.is_zero() => return o,
            (_, Some(b)) if b.is_zero() => return self,
            _ => {}
        }
        match (split_sign(self), split_sign(o)) {
            ((false, a), (false, b)) => intern(Node::Add(a, b)),
            ((false, a), (true, b)) | ((true, b), (false, a)) if a == b => Expr::int(0),
            ((false, a), (true, b)) | ((true, b), (false, a)) => intern(Node::Sub(a, b)),
            ((true, a), (true, b)) => -intern(Node::Add(a, b)),
        }
    }
}

impl Sub for Expr {
    type Output = Expr;
    fn sub(self, o: Expr) -> Expr {
        self + -o
    }
}

impl Mul for Expr {
    type Output = Expr;
    fn mul(self, o: Expr) -> Expr {
        let ((r, a), (t, b)) = (self.split_number(), o.split_number());
        let rest = match (a.is_one(), b.is_one()) {
            (true, _) => b,
            (_, true) => a,
            _ => intern(Node::Mul(a, b)),
        };
        Expr::with_number(&(r * t), rest)
    }
}

impl Div for Expr {
    type Output = Expr;
    fn div(self, o: Expr) -> Expr {
        if o.is_zero() {
            return intern(Node::Div(self, o)); // refused where the value is asked for, not here
        }
        let ((r, a), (t, b)) = (self.split_number(), o.split_number());
        if r.is_zero() {
            return Expr::int(0);
        }
        let rest = match b.is_one() {
            true => a,
            false => intern(Node::Div(a, b)),
        };
        Expr::with_number(&(r / t), rest)
    }
}

impl fmt::Debug for Symbol {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.name())
    }
}

/// The order a person would list names in: `d2` before `d10`, `q1` after `a3`.
pub fn natural_order(a: &str, b: &str) -> std::cmp::Ordering {
    fn key(s: &str) -> Vec<(&str, Option<u64>)> {
        let mut parts = vec![];
        let mut rest = s;
        while !rest.is_empty() {
            let word = rest.find(|c: char| c.is_ascii_digit()).unwrap_or(rest.len());
            let (w, tail) = rest.split_at(word);
            let digits = tail.find(|c: char| !c.is_ascii_digit()).unwrap_or(tail.len());
            parts.push((w, tail[..digits].parse().ok()));
            rest = &tail[digits..];
        }
        parts
    }
    key(a).cmp(&key(b)).then_with(|| a.cmp(b))
}
