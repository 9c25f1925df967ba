//! Proofs that a configuration's own values are among the printed ones, whatever the configuration.
//!
//! With the forward model in place of the pose a value v is a formula in the joint variables. A sum of arctangents is the
//! angle of a product Z of numbers x + iy; it is θ where Z·e^{−iθ} is real and positive. A root of a square s² is ε·s with
//! the sign ε of s: each choice of signs must have a branch that is right.

use super::judgement::Where;
use super::mend::rebuilt;
use super::setting::{Sample, Setting, Unknown};
use denavit_symbolic::factor::factored;
use denavit_symbolic::poly::Monomial;
use denavit_symbolic::{Angle, Expr, Node, Rational, Ring, equal, readable};

/// Signs of roots that are told apart.
const SIGNS: usize = 3;
/// Literals of a formula that is still worked with.
const LONGEST: u64 = 1_500;
/// The largest multiple of an arctangent.
const MULTIPLE: i64 = 2;

/// Roots of squares, taken with a sign each.
#[derive(Default)]
struct Roots {
    /// ε, and what its sign is that of.
    signs: Vec<(Expr, Expr)>,
    /// Formulas that are positive for they stand under a root, and the roots.
    positive: Vec<Expr>,
    /// True if some formula was too large.
    is_spent: bool,
}

/// The identities that prove that the values of every configuration are among the printed ones, for each branch where its
/// condition holds; nothing if that is not proved.
pub fn proof(
    setting: &Setting,
    samples: &[Sample],
    of: &[Unknown],
    branches: &[Vec<Expr>],
    places: &[Where],
) -> Option<Vec<[Expr; 2]>> {
    let mut roots = Roots::default();
    let values: Vec<Option<Vec<Expr>>> = branches
        .iter()
        .zip(places)
        .map(|(b, place)| {
            let wanted = matches!(place, Where::Everywhere | Where::If(_));
            wanted.then(|| b.iter().map(|&e| roots.resolved(setting.by_table(e))).collect())
        })
        .collect();
    if roots.is_spent || roots.signs.len() > SIGNS {
        return None;
    }
    let conditions: Vec<Vec<Expr>> = places
        .iter()
        .map(|p| match p {
            Where::If(all) => all.iter().map(|&e| roots.resolved(setting.by_table(e))).collect(),
            _ => vec![],
        })
        .collect();
    let conditional: Vec<&Vec<Expr>> =
        (0..places.len()).filter(|&k| values[k].is_some()).map(|k| &conditions[k]).collect();
    let is_mixed = conditional.windows(2).any(|c| c[0] != c[1]);
    let mut identities = vec![];
    for mask in 0..1_usize << roots.signs.len() {
        let sign = |k: usize| Expr::int(if mask >> k & 1 == 1 { -1 } else { 1 });
        let chosen =
            |e: Expr| e.substitute(|s| roots.signs.iter().position(|(eps, _)| *eps == s.into()).map(sign));
        let positive: Vec<Expr> =
            roots.signs.iter().enumerate().map(|(k, (_, s))| sign(k) * chosen(*s)).collect();
        let contradicts = |c: &Expr| positive.iter().any(|&p| roots.is_positive(-(chosen(*c) * p)));
        if conditional.iter().all(|all| all.iter().any(contradicts)) {
            continue;
        }
        let order = likely(setting, samples, of, branches, &roots, mask);
        let proof = |k: usize| -> Option<Vec<[Expr; 2]>> {
            let values = values[k].as_ref()?;
            let mut positive = positive.clone();
            positive.extend(conditions[k].iter().map(|&e| chosen(e)));
            of.iter().zip(values).map(|(u, &v)| roots.value_is(u, chosen(v), &positive)).collect()
        };
        if is_mixed {
            // Under different conditions each branch must be right under its own.
            for k in (0..branches.len()).filter(|&k| values[k].is_some()) {
                identities.extend(proof(k)?);
            }
            continue;
        }
        let whole = order.iter().take(2).find_map(|&k| proof(k));
        let found = whole.or_else(|| {
            let [of] = of else { return None };
            let all: Vec<Expr> = order.iter().filter_map(|&k| Some(chosen(values[k].as_ref()?[0]))).collect();
            let is_plain = conditional.iter().all(|all| all.is_empty());
            roots.either_is(of, &all, &positive).filter(|_| is_plain)
        });
        identities.extend(found?);
    }
    Some(identities)
}

/// The branches, those first that are right at a sample with these signs.
fn likely(
    setting: &Setting,
    samples: &[Sample],
    of: &[Unknown],
    branches: &[Vec<Expr>],
    roots: &Roots,
    mask: usize,
) -> Vec<usize> {
    let mut order: Vec<usize> = (0..branches.len()).collect();
    let signs: Vec<Expr> = roots.signs.iter().map(|s| s.1).collect();
    let unknowns: Vec<Expr> = of.iter().map(|u| u.formula).collect();
    let tapes = (setting.tape(&signs), setting.tape(&unknowns), setting.tape(&branches.concat()));
    let (Ok(signs), Ok(unknowns), Ok(printed)) = tapes else { return order };
    for s in samples {
        let point = setting.point(&s.q, &s.entries);
        if signs.values(&point).iter().enumerate().all(|(k, x)| (*x < 0.0) == (mask >> k & 1 == 1)) {
            let (own, values) = (unknowns.values(&point), printed.values(&point));
            let n = of.len().max(1);
            order.sort_by_key(|&k| !setting.near(of, &values[k * n..(k + 1) * n], &own));
            break;
        }
    }
    order
}

impl Roots {
    /// The formula with roots of squares replaced, and sines of arctangents.
    fn resolved(&mut self, e: Expr) -> Expr {
        let mut change = |_, new: Expr| {
            if self.is_spent {
                return new;
            }
            match new.node() {
                Node::Sqrt(a) => self.root(a),
                Node::Sin(a) | Node::Cos(a) => {
                    self.sine(a, matches!(new.node(), Node::Cos(_))).unwrap_or(new)
                }
                _ => new,
            }
        };
        rebuilt(e, &mut change)
    }

    /// The same without the signs that do not matter, as in (ε·ρ)².
    fn without_signs(&self, e: Expr) -> Expr {
        self.signs.iter().fold(e, |e, (sign, _)| {
            if !e.symbols().iter().any(|s| Expr::from(*s) == *sign) {
                return e;
            }
            let with = |n: i64| e.substitute(|s| (Expr::from(s) == *sign).then(|| Expr::int(n)));
            let (plus, minus) = (with(1), with(-1));
            if equal(plus, minus).is_equal() { plus } else { e }
        })
    }

    /// √a with what is a square taken out: √(n/d) = √(n·d)/|d|.
    fn root(&mut self, a: Expr) -> Expr {
        let a = self.without_signs(a);
        let Some((num, den)) = self.fraction(a) else { return a.sqrt() };
        let product = if den.is_one() { num } else { num * den };
        let Ok(product) = factored(product, &[]) else { return a.sqrt() };
        let (mut outside, mut inside) = (Expr::int(1) / den, Expr::from(product.constant.clone()));
        for &(f, n) in &product.factors {
            outside = outside * f.powi((n / 2) as i32);
            if n % 2 == 1 {
                inside = inside * f;
            }
        }
        if inside.as_number().is_none() {
            self.positive.extend([inside, inside.sqrt()]);
        }
        if outside.as_number().is_some() {
            return outside * inside.sqrt();
        }
        let known = self.signs.iter().position(|s| s.1 == outside);
        let k = known.unwrap_or_else(|| {
            let epsilon = Expr::symbol(&format!("sign of root {}", self.signs.len() + 1));
            self.signs.push((epsilon, outside));
            self.is_spent |= self.signs.len() > SIGNS;
            self.signs.len() - 1
        });
        self.signs[k].0 * outside * inside.sqrt()
    }

    /// Sine or cosine of an angle with arctangents in it.
    fn sine(&mut self, angle: Expr, is_cosine: bool) -> Option<Expr> {
        let form = Angle::of(angle);
        if !form.terms.iter().any(|t| matches!(t.0.node(), Node::Atan2(..))) {
            return None;
        }
        let ([re, im], squares) = direction(angle)?;
        let length = self.root(squares.into_iter().fold(Expr::int(1), |x, y| x * y));
        Some(if is_cosine { re } else { im } / length)
    }

    /// Numerator and denominator in canonical form.
    fn fraction(&mut self, e: Expr) -> Option<(Expr, Expr)> {
        let mut ring = Ring::new(&[e], &[]);
        let Ok(form) = ring.normal(e) else {
            self.is_spent = true;
            return None;
        };
        let num = readable::show(&ring, &form.num);
        let show = |d: Expr, (p, n): &(_, u32)| d * readable::show(&ring, p).powi(*n as i32);
        let den = form.den.iter().fold(Expr::int(1), show);
        self.is_spent |= readable::literals(num) + readable::literals(den) > LONGEST;
        (!self.is_spent).then_some((num, den))
    }

    /// The identity that proves that a value is the unknown, where `positive` are: both are equal, or Z·e^{−iθ} is real and positive.
    fn value_is(&self, of: &Unknown, value: Expr, positive: &[Expr]) -> Option<[Expr; 2]> {
        if !of.is_angle {
            return equal(value, of.formula).is_equal().then_some([value, of.formula]);
        }
        let ([re, im], squares) = direction(value - of.formula)?;
        let zero = Expr::int(0);
        (equal(im, zero).is_equal() && self.is_direction(re, &squares, positive)).then_some([im, zero])
    }

    /// The identities that prove that one of two values is the unknown: both give its direction or the opposite one, and never the
    /// same, as `atan2(y, x)` and `atan2(-y, -x)`.
    fn either_is(&self, of: &Unknown, values: &[Expr], positive: &[Expr]) -> Option<Vec<[Expr; 2]>> {
        let zero = Expr::int(0);
        let along = |&v: &Expr| -> Option<[Expr; 2]> {
            let ([re, im], _) = direction(v - of.formula)?;
            equal(im, zero).is_equal().then_some([re, im])
        };
        let all: Vec<[Expr; 2]> = values.iter().filter_map(along).filter(|_| of.is_angle).take(4).collect();
        let pairs = || (1..all.len()).flat_map(|k| all[..k].iter().map(move |a| (a, k)));
        let opposite = |(a, k): &(&[Expr; 2], usize)| self.is_direction(-(a[0] * all[*k][0]), &[], positive);
        let (a, k) = pairs().find(opposite)?;
        Some(vec![[a[1], zero], [all[k][1], zero]])
    }

    /// True if a real number is proved to be positive, where `positive` are.
    fn is_direction(&self, re: Expr, squares: &[Expr], positive: &[Expr]) -> bool {
        if std::iter::once(&Expr::int(1)).chain(squares).any(|&x| equal(re, x).is_equal()) {
            return true;
        }
        // The product with some of what is positive must be a square times something positive.
        let few = positive.len().min(SIGNS + 2);
        (0..1_usize << few).any(|mask| {
            let chosen = (0..few).filter(|k| mask >> k & 1 == 1).map(|k| positive[k]);
            self.is_positive(chosen.fold(re, |x, p| x * p))
        })
    }

    /// True if a formula is positive wherever it is not 0.
    fn is_positive(&self, e: Expr) -> bool {
        let mut scratch = Roots::default();
        let Some((num, den)) = scratch.fraction(e) else { return false };
        let [num, den] = [num, den].map(|x| factored(x, &[]));
        let (Ok(num), Ok(den)) = (num, den) else { return false };
        let odd = num.factors.iter().chain(&den.factors).filter(|f| f.1 % 2 == 1);
        let mut left: Vec<Expr> = vec![];
        for (f, _) in odd {
            match left.iter().position(|l| l == f) {
                Some(k) => drop(left.remove(k)),
                None => left.push(*f),
            }
        }
        let is_positive =
            |f: &Expr| self.positive.contains(f) || matches!(f.node(), Node::Sqrt(_)) || is_length(*f);
        !(num.constant.is_negative() ^ den.constant.is_negative()) && left.iter().all(is_positive)
    }
}

/// True for A + B cos φ + C sin φ where A is a sum of squares and A² − B² − C² a square: the squared distance of two points
/// on circles, as a² + b² + 2ab cos φ, is not negative.
fn is_length(f: Expr) -> bool {
    let [c, s] = ["cosine", "sine"].map(|n| Expr::symbol(&format!("{n} of the angle")));
    let mut angles: Vec<Expr> = vec![];
    let mut change = |_, new: Expr| match new.node() {
        Node::Cos(a) | Node::Sin(a) => {
            if !angles.contains(&a) {
                angles.push(a);
            }
            if matches!(new.node(), Node::Cos(_)) { c } else { s }
        }
        _ => new,
    };
    let plain = rebuilt(f, &mut change);
    if angles.len() > 1 {
        return false;
    }
    let at = |x: i64, y: i64| {
        plain.substitute(|z| [(c, x), (s, y)].iter().find(|p| p.0 == z.into()).map(|p| Expr::int(p.1)))
    };
    let half = Expr::from(Rational::new(1, 2));
    let (a, b) = (half * (at(1, 0) + at(-1, 0)), half * (at(1, 0) - at(-1, 0)));
    let e = at(0, 1) - a;
    let mut ring = Ring::new(&[plain, a], &[]);
    let is_square_sum = ring.polynomial(a).is_ok_and(|p| {
        let even = |m: &Monomial| m.factors().iter().all(|x| x.1 % 2 == 0);
        p.terms().iter().all(|(m, r)| !r.is_negative() && even(m))
    });
    let (cos, sin) = angles.first().map_or((Expr::int(1), Expr::int(0)), |x| (x.cos(), x.sin()));
    let is_square = || {
        let rest = factored(a.powi(2) - b.powi(2) - e.powi(2), &[]);
        rest.is_ok_and(|p| !p.constant.is_negative() && p.factors.iter().all(|f| f.1 % 2 == 0))
    };
    is_square_sum && equal(f, a + b * cos + e * sin).is_equal() && is_square()
}

/// Real and imaginary part of a complex number that has this angle, and the squared lengths of its factors; nothing if an arctangent
/// counts a fraction, or often.
fn direction(angle: Expr) -> Option<([Expr; 2], Vec<Expr>)> {
    let mut form = Angle::of(angle);
    let mut z = [Expr::int(1), Expr::int(0)];
    let mut squares = vec![];
    let mut turns: Vec<(Expr, Expr, i64)> = vec![];
    let mut is_whole = true;
    form.terms.retain(|(x, k)| {
        let Node::Atan2(b, a) = x.node() else { return true };
        match k.to_integer().filter(|n| n.abs() <= MULTIPLE) {
            Some(n) => turns.push((a, b, n)),
            None => is_whole = false,
        }
        false
    });
    let plain = form.terms.iter().all(|t| t.0.as_symbol().is_some());
    if !is_whole || !plain || form.radians != Rational::ZERO {
        return None;
    }
    for (a, b, n) in turns {
        let b = if n < 0 { -b } else { b };
        for _ in 0..n.abs() {
            z = [z[0] * a - z[1] * b, z[0] * b + z[1] * a];
            squares.push(a.powi(2) + b.powi(2));
        }
    }
    let (s, c) = form.to_expr().sin_cos();
    Some(([z[0] * c - z[1] * s, z[0] * s + z[1] * c], squares))
}
