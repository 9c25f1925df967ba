//! Whether formulas can be 0 at once: cases are split on their factors, each solved for a joint and put into the others,
//! until in every case one of them is seen not to be 0.

use denavit_symbolic::factor::{factored, zeros};
use denavit_symbolic::{Angle, Expr, Node, Rational, Symbol};

/// Cases that are looked at.
const CASES: usize = 400;
/// A length or an angle is not taken for 0 if it is larger than this.
const ZERO: f64 = 1e-9;

/// What belongs to a robot: its joint variables, and the values of its parameters as far as they are known.
pub struct Known {
    /// The joint variables.
    pub variables: Vec<Symbol>,
    /// The values of parameters.
    pub values: Vec<(Symbol, f64)>,
}

/// A product by those of its factors that depend on the joints.
type Product = Vec<Expr>;

/// True if it is proved that some of the products is not 0, whatever the configuration; lengths that are named and have no
/// value are taken to be other than 0.
pub fn never_all_zero(products: &[Product], known: &Known) -> bool {
    let angles = Expr::postorder(&products.concat()).into_iter().filter_map(|e| match e.node() {
        Node::Sin(a) | Node::Cos(a) => Some(Angle::of(a)),
        _ => None,
    });
    // φ = 0 says nothing of the sine of φ/2: φ may be a whole turn.
    let is_whole = |a: Angle| a.terms.iter().all(|(x, k)| k.is_integer() && x.as_symbol().is_some());
    let mut cases = CASES;
    angles.into_iter().all(is_whole) && known.is_refuted(products.to_vec(), &mut cases)
}

/// Sets of factors of which one is 0 as a whole where all of the products are 0: a factor of each product, none that another
/// set does without. Sets that are never 0 at once are left out, and those with one of the `apart`; nothing if there are too many.
pub fn zero_at_once(products: &[Product], apart: &[Expr], known: &Known) -> Option<Vec<Vec<Expr>>> {
    // What nobody reads is not listed.
    if products.concat().iter().any(|f| Expr::postorder(&[*f]).len() > LONG) {
        return None;
    }
    let mut sets: Vec<Vec<Expr>> = vec![vec![]];
    for product in products {
        let (met, open): (Vec<_>, Vec<_>) =
            sets.into_iter().partition(|set| product.iter().any(|f| set.contains(f)));
        sets = met;
        for set in open {
            for &f in product.iter().filter(|f| !apart.contains(f)) {
                let with: Vec<Expr> = set.iter().copied().chain([f]).collect();
                let is_less = |other: &Vec<Expr>| other.iter().all(|f| with.contains(f));
                if !sets.iter().any(is_less) {
                    sets.retain(|other| !with.iter().all(|f| other.contains(f)));
                    sets.push(with);
                }
            }
        }
        if sets.len() > SETS {
            return None;
        }
    }
    if sets.len() > 2 * LISTED {
        return None;
    }
    let is_possible =
        |set: &Vec<Expr>| !never_all_zero(&set.iter().map(|&f| vec![f]).collect::<Vec<_>>(), known);
    let found: Vec<Vec<Expr>> =
        sets.into_iter().filter(is_possible).map(|set| without_implied(set, known)).collect();
    (found.len() <= LISTED).then_some(found)
}

/// The set without what is 0 anyway where the rest is, the longest first.
fn without_implied(mut set: Vec<Expr>, known: &Known) -> Vec<Expr> {
    let mut order = set.clone();
    order.sort_by_key(|f| std::cmp::Reverse(Expr::postorder(&[*f]).len()));
    for f in order {
        let rest: Vec<Expr> = set.iter().copied().filter(|&g| g != f).collect();
        if known.is_implied(f, &rest) {
            set = rest;
        }
    }
    set
}

/// Sets that are looked at, and that are listed.
const SETS: usize = 100;
const LISTED: usize = 12;
/// Parts of a factor beyond which nothing is listed.
const LONG: usize = 80;

/// A value of a joint variable.
type Value = (Symbol, Expr);

impl Known {
    fn is_refuted(&self, products: Vec<Product>, cases: &mut usize) -> bool {
        if products.iter().any(Vec::is_empty) {
            return true;
        }
        if *cases == 0 {
            return false;
        }
        *cases -= 1;
        let solved = |p: &Product| p.iter().map(|&f| self.solved(f)).collect::<Option<Vec<_>>>();
        let best = products.iter().filter_map(solved).min_by_key(|values| values.iter().flatten().count());
        let Some(values) = best else { return false };
        values.into_iter().flatten().all(|value| {
            let put = |p: &Product| self.put(p, value);
            self.is_refuted(products.iter().filter_map(put).collect(), cases)
        })
    }

    /// Whether a factor is 0 wherever all of some others are, as far as these can be solved one after another.
    fn is_implied(&self, f: Expr, by: &[Expr]) -> bool {
        if factored(f, &[]).is_ok_and(|f| f.constant.is_zero()) {
            return true;
        }
        let solved = by.iter().enumerate().find_map(|(k, &g)| Some((k, self.solved(g)?)));
        let Some((k, values)) = solved.filter(|(_, values)| !values.is_empty()) else { return false };
        values.into_iter().all(|(joint, value)| {
            let put = |e: Expr| e.substitute(|s| (s == joint).then_some(value));
            let rest: Vec<Expr> =
                by.iter().enumerate().filter(|(j, _)| *j != k).map(|(_, &g)| put(g)).collect();
            self.is_implied(put(f), &rest)
        })
    }

    /// All zeros of a factor, each as the value of one joint variable: those of a sine or a cosine, or of what is linear in
    /// a joint.
    fn solved(&self, factor: Expr) -> Option<Vec<Value>> {
        if let Some(value) = self.variables.iter().find_map(|&q| Some((q, linear(factor, q)?))) {
            return Some(vec![value]);
        }
        let zero = zeros(factor).into_iter().find(|z| z.values().iter().all(|v| v.symbols().is_empty()))?;
        let sum = Angle::of(zero.angle());
        let is_one = |k: &Rational| k.abs() == Rational::ONE;
        let (joint, k) =
            sum.terms.iter().find_map(|(x, k)| Some((x.as_symbol()?, k)).filter(|t| is_one(t.1)))?;
        let q = Expr::from(joint);
        // k q + r = v with k = ±1
        let rest = zero.angle() - Expr::from(k.clone()) * q;
        Some(zero.values().into_iter().map(|v| (joint, Expr::from(k.clone()) * (v - rest))).collect())
    }

    /// A product with a joint at a value; nothing if it is 0 there, or cannot be told from 0.
    fn put(&self, product: &Product, (joint, value): Value) -> Option<Product> {
        let mut rest = vec![];
        for f in product {
            let found = factored(f.substitute(|s| (s == joint).then_some(value)), &[]).ok()?;
            if found.constant.is_zero() {
                return None;
            }
            for (f, _) in found.factors {
                let varies = f.symbols().iter().any(|s| self.variables.contains(s));
                match varies {
                    true => rest.push(f),
                    false if self.may_vanish(f) => return None,
                    false => {}
                }
            }
        }
        Some(rest)
    }

    /// Whether a constant may be 0: a length that has no value is not, a sum of several may be.
    pub fn may_vanish(&self, constant: Expr) -> bool {
        let value = |s: Symbol| self.values.iter().find(|v| v.0 == s).map(|v| v.1);
        match constant.eval(value) {
            Ok(x) => x.is_nan() || x.abs() <= ZERO,
            Err(_) => constant.as_symbol().is_none(),
        }
    }
}

/// The zero of a·q + b, with a number a other than 0, where q is in no sine or cosine.
fn linear(factor: Expr, q: Symbol) -> Option<Expr> {
    let at = |x: i64| factor.substitute(|s| (s == q).then(|| Expr::int(x)));
    let is_in_angle = Expr::postorder(&[factor]).into_iter().any(|e| match e.node() {
        Node::Sin(a) | Node::Cos(a) => a.symbols().contains(&q),
        _ => false,
    });
    if is_in_angle || !factor.symbols().contains(&q) {
        return None;
    }
    let (rest, slope) = (at(0), factored(at(1) - at(0), &[]).ok()?);
    let is_linear = factored(at(2) - at(1) - at(1) + at(0), &[]).is_ok_and(|f| f.constant.is_zero());
    let (is_number, by) = (slope.factors.is_empty() && !slope.constant.is_zero(), Expr::from(slope.constant));
    (is_linear && is_number).then(|| -rest / by)
}
