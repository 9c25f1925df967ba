//! Numbers that a script gives joints, and angles in degrees.

use crate::inverse::rebuilt;
use crate::subject::Subject;
use denavit::description::JointKind;
use denavit_reading::code::is_vector;
use denavit_symbolic::{Angle, Expr, Node, Rational};
use std::cell::RefCell;
use std::f64::consts::TAU;

/// 180/π, until what it stands in is worked out.
const PER_RADIAN: &str = "degrees per radian";

/// Angles that a script has in degrees, worked out: π · 180/π is 180.
pub(super) fn in_radians(e: Expr) -> Expr {
    let per_radian = Expr::symbol(PER_RADIAN);
    let has = |e: Expr| e.symbols().iter().any(|s| Expr::from(*s) == per_radian);
    if !has(e) {
        return e;
    }
    // π · 180/π does not depend on what π is.
    let back = |e: Expr| {
        let at = |pi: i64| {
            let named = rebuilt(e, &mut |_, new: Expr| if new == Expr::pi() { Expr::int(pi) } else { new });
            let full = Expr::from(Rational::new(180, pi));
            Angle::of(named.substitute(|s| (Expr::from(s) == per_radian).then_some(full))).to_expr()
        };
        let all = [at(2), at(3), at(5), at(7)];
        match all.windows(2).all(|pair| pair[0] == pair[1]) {
            true => all[0],
            false => e.substitute(|s| (Expr::from(s) == per_radian).then(|| Expr::int(180) / Expr::pi())),
        }
    };
    let mut change = |_, new: Expr| match new.node() {
        Node::Sin(a) if has(a) => back(a).sin(),
        Node::Cos(a) if has(a) => back(a).cos(),
        _ => new,
    };
    let inner = rebuilt(e, &mut change);
    if has(inner) { back(inner) } else { inner }
}

/// An angle in degrees: what its name stands for where a program has it so.
pub(super) fn of_degrees(e: Expr) -> Expr {
    e * Expr::symbol(PER_RADIAN)
}

/// The joints that turn.
pub(super) fn turning(subject: &Subject) -> Vec<Expr> {
    let variables = subject.description.variables();
    variables.iter().filter(|v| v.kind == JointKind::Revolute).map(|v| v.symbol.into()).collect()
}

/// How a script gives joints their values: what it computes from them is read as a formula in the joints.
pub(super) struct Stated {
    kinds: Vec<JointKind>,
    joints: Vec<Expr>,
    in_degrees: bool,
    /// Its arctangents are in degrees.
    gives_degrees: bool,
    /// The numbers in radians and metres; nothing for a joint that got several.
    numbers: RefCell<Vec<Option<Option<Expr>>>>,
}

impl Stated {
    /// Angles are in degrees if the script turns degrees into radians somewhere, or a name of a joint gets a number that
    /// looks like degrees.
    pub fn of(text: &str, subject: &Subject) -> Self {
        const TURNS: [&str; 8] =
            ["deg2rad", "radians(", "cosd(", "sind(", "pi/180", "pi / 180", "*pi/180", "pi)/180"];
        let kinds = subject.description.variables().iter().map(|v| v.kind).collect();
        let in_degrees = TURNS.iter().any(|t| text.contains(t));
        let gives_degrees =
            ["atan2d", "acosd", "asind", "rad2deg(atan2", "degrees(atan2"].iter().any(|f| text.contains(f));
        let numbers = RefCell::new(vec![None; subject.joints().len()]);
        Stated { kinds, joints: subject.joints().to_vec(), in_degrees, gives_degrees, numbers }
    }

    /// The joints for their values: of one name, or of a vector of all of them.
    pub fn joints(&self, values: &[Expr], joint: Option<usize>, name: &str) -> Option<Vec<Expr>> {
        let numbers: Vec<usize> = match (joint, values) {
            (Some(k), [_]) => vec![k],
            (None, all) if all.len() > 1 && all.len() == self.joints.len() && is_vector(name) => {
                (0..all.len()).collect()
            }
            _ => return None,
        };
        numbers.into_iter().zip(values).map(|(k, value)| self.joint(k, *value)).collect()
    }

    fn joint(&self, k: usize, value: Expr) -> Option<Expr> {
        if value.symbols().iter().any(|s| self.joints[k] == (*s).into()) {
            return None;
        }
        let form = Angle::of(value);
        if !form.terms.is_empty() || !value.symbols().is_empty() {
            // What a script computes for a joint is that joint from there on.
            let is_computed =
                Expr::postorder(&[value]).iter().any(|e| matches!(e.node(), Node::Atan2(..) | Node::Sqrt(_)));
            let is_angle = self.kinds[k] == JointKind::Revolute;
            let per = if is_angle && self.gives_degrees { Expr::symbol(PER_RADIAN) } else { Expr::int(1) };
            return is_computed.then(|| self.joints[k] * per);
        }
        let is_angle = self.kinds[k] == JointKind::Revolute;
        let x = value.as_number().map(|r| r.to_f64());
        // `q1 = 30` with `deg2rad(q1)` further down; `q1 = pi/6`, `q1 = 0.5`.
        let is_degrees = match x {
            Some(0.0) => self.in_degrees,
            Some(x) => x.abs() > TAU || x % 5.0 == 0.0,
            None => false,
        };
        let per = Expr::pi() / Expr::int(180);
        let number = if is_angle && is_degrees { value * per } else { value };
        if let Some(known) = self.numbers.borrow_mut().get_mut(k) {
            *known = match *known {
                Some(before) if before != Some(number) => Some(None),
                _ => Some(Some(number)),
            };
        }
        Some(if is_angle && is_degrees { self.joints[k] * Expr::symbol(PER_RADIAN) } else { self.joints[k] })
    }

    /// A formula at the numbers that the script gives joints.
    pub fn at_numbers(&self, e: Expr) -> Expr {
        let numbers = self.numbers.borrow();
        e.substitute(|s| {
            let k = self.joints.iter().position(|q| *q == Expr::from(s))?;
            numbers.get(k).copied().flatten().flatten()
        })
    }
}
