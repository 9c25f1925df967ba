//! The sign that says where a branch is right: searched among the formula's own arguments, sines and cosines, the entries
//! of the pose seen from known frames, and products of two of them.

use super::arm::Arm;
use super::judgement::{Cause, Where};
use super::setting::{Sample, Setting};
use denavit::geometry::{Rotation, Transform, Vector};
use denavit::robot::Robot;
use denavit_symbolic::{Angle, Expr, Node};

/// Shares of the samples below which a branch is right by accident.
const ACCIDENT: f64 = 0.01;
/// Candidates that are joined to products.
const JOINED: usize = 120;
/// A number below this has no sign.
const TINY: f64 = 1e-9;

/// Where a branch is right, given whether it is at each sample.
pub fn place(setting: &Setting, samples: &[Sample], right: &[bool], pool: &[Expr]) -> Where {
    let share = super::compare::share(right.iter().copied());
    if right.iter().all(|&r| r) {
        return Where::Everywhere;
    }
    if share <= ACCIDENT {
        return Where::Nowhere;
    }
    let signs = signs(setting, samples, pool);
    let is = |s: &[bool], negative: bool| s.iter().zip(right).all(|(&s, &r)| (s != negative) == r);
    let by = |e: Expr, negative: bool| Where::If(vec![if negative { -e } else { e }]);
    for (e, s) in &signs {
        if let Some(negative) = [false, true].into_iter().find(|&n| is(s, n)) {
            return by(*e, negative);
        }
    }
    let few = &signs[..signs.len().min(JOINED)];
    for (k, (e, s)) in few.iter().enumerate() {
        for (f, t) in &few[..k] {
            let product: Vec<bool> = s.iter().zip(t).map(|(a, b)| a == b).collect();
            if let Some(negative) = [false, true].into_iter().find(|&n| is(&product, n)) {
                return by(*f * *e, negative);
            }
        }
    }
    // Two conditions at once: each must hold wherever the branch is right.
    let implied = few.iter().flat_map(|(e, s)| {
        let one = |negative: bool| s.iter().zip(right).all(|(&s, &r)| !r || s != negative);
        [false, true].into_iter().filter(move |&n| one(n)).map(move |n| (if n { -*e } else { *e }, s, n))
    });
    let implied: Vec<(Expr, &Vec<bool>, bool)> = implied.collect();
    for (k, (e, s, n)) in implied.iter().enumerate() {
        for (f, t, m) in &implied[..k] {
            let both = s.iter().zip(*t).map(|(&a, &b)| (a != *n) && (b != *m));
            if both.zip(right).all(|(b, &r)| b == r) {
                return Where::If(vec![*f, *e]);
            }
        }
    }
    Where::Partly(share)
}

/// The candidates that have a sign at every sample, each different sign once.
fn signs(setting: &Setting, samples: &[Sample], pool: &[Expr]) -> Vec<(Expr, Vec<bool>)> {
    let mut found: Vec<(Expr, Vec<bool>)> = vec![];
    let known: Vec<Expr> = pool.iter().copied().filter(|&e| setting.tape(&[e]).is_ok()).collect();
    let Ok(tape) = setting.tape(&known) else { return vec![] };
    let values: Vec<Vec<f64>> =
        samples.iter().map(|s| tape.values(&setting.point(&s.q, &s.entries))).collect();
    for (k, &e) in known.iter().enumerate() {
        if values.iter().all(|v| v[k].is_finite() && v[k].abs() > TINY) {
            let s: Vec<bool> = values.iter().map(|v| v[k] > 0.0).collect();
            if !found.iter().any(|f| f.1 == s) {
                found.push((e, s));
            }
        }
    }
    found
}

/// What a formula itself suggests: arguments of arctangents, divisors, sines and cosines of what is known.
pub fn own(branch: &[Expr], known: &[Expr]) -> Vec<Expr> {
    let mut pool = vec![];
    let nodes = Expr::postorder(branch);
    for e in &nodes {
        match e.node() {
            Node::Atan2(y, x) if x.is_one() => match quotient(y) {
                Some((a, b)) => pool.extend([b, a, a * b]),
                None => pool.push(y),
            },
            Node::Atan2(y, x) => pool.extend([x, y]),
            Node::Div(_, b) => pool.push(b),
            _ => {}
        }
    }
    for &k in known {
        let (s, c) = k.sin_cos();
        pool.extend([s, c, k]);
    }
    pool.extend(nodes.iter().filter(|e| matches!(e.node(), Node::Sin(_) | Node::Cos(_))));
    pool
}

/// The entries of the pose seen from frames that known joints carry, on either side, and the pose itself.
pub fn seen_from(arm: &Arm, known: &[Expr]) -> Vec<Expr> {
    let d = &arm.description;
    let robot = Robot::symbolic(d);
    let q: Vec<Expr> = arm.setting.variables.iter().map(|&v| v.into()).collect();
    let is_known = |row: usize| {
        let used = d.rows[row].theta.symbols().into_iter().chain(d.rows[row].d.symbols());
        used.filter(|s| arm.setting.variables.contains(s)).all(|s| known.contains(&s.into()))
    };
    let n = d.rows.len();
    let first = (0..n).take_while(|&r| is_known(r)).count();
    let last = (0..n).rev().take_while(|&r| is_known(r)).count().min(n - first);
    let entry = |k: usize| Expr::from(arm.setting.entries[k].0);
    let rotation = std::array::from_fn(|i| std::array::from_fn(|j| entry(4 * i + j)));
    let position = Vector(std::array::from_fn(|i| entry(4 * i + 3)));
    let mut pose = Transform::from_rotation_translation(Rotation::from_rows(rotation), position);
    let mut pool = vec![];
    let mut add = |x: &Transform<Expr>| pool.extend(x.matrix().concat());
    add(&pose);
    for row in 0..first {
        if row == 0 {
            pose = robot.base.inverse() * pose;
        }
        pose = robot.links[row].transform(&q).inverse() * pose;
        add(&pose);
    }
    for row in (n - last..n).rev() {
        if row + 1 == n {
            pose = pose * robot.tool.inverse();
        }
        pose = pose * robot.links[row].transform(&q).inverse();
        add(&pose);
    }
    pool.retain(|e| !e.is_zero());
    pool
}

/// a/b of a quotient, a sign or number in front brought into a.
pub fn quotient(e: Expr) -> Option<(Expr, Expr)> {
    match e.node() {
        Node::Div(a, b) => Some((a, b)),
        Node::Neg(x) => quotient(x).map(|(a, b)| (-a, b)),
        Node::Mul(k, x) if k.as_number().is_some() => quotient(x).map(|(a, b)| (k * a, b)),
        _ => None,
    }
}

/// What in a formula loses a sign.
pub fn cause(branch: &[Expr]) -> Cause {
    let one = Expr::int(1);
    let is_root =
        |e: Expr, u: Expr| matches!(e.node(), Node::Sqrt(r) if r == one - u.powi(2) || r == one - u * u);
    let of = |e: &Expr| match e.node() {
        Node::Atan2(u, x) if x.is_one() && Angle::of(u).terms.iter().any(|t| t.0.as_number().is_none()) => {
            Cause::Arctan
        }
        Node::Atan2(u, root) if is_root(root, u) => Cause::Arcsin,
        Node::Atan2(root, u) if is_root(root, u) => Cause::Arccos,
        Node::Atan2(..) => Cause::Atan2,
        Node::Sqrt(_) => Cause::Root,
        _ => Cause::Other,
    };
    let order = [Cause::Arctan, Cause::Arccos, Cause::Arcsin, Cause::Atan2, Cause::Root];
    let causes: Vec<Cause> = Expr::postorder(branch).iter().map(of).collect();
    order.into_iter().find(|c| causes.contains(c)).unwrap_or(Cause::Other)
}
