//! Programs of inverse kinematics: what they are told of a pose stands for its entries, and the name of a joint stands for the
//! joint once it has a value. What is not known of a choice is a sign.

use super::machine::{Flow, Machine, Slot};
use super::place::Step;
use super::records::is_number;
use super::report;
use super::scalar::{Read, Scalar};
use super::tree::{Definition, Kind, Node, Op, Span, Statement, StatementKind, SuffixKind, changed};
use super::value::{Matrix, Object, Sort, object};
use super::{Assigned, Dialect, eval};
use denavit_symbolic::Expr;
use std::collections::{BTreeMap, BTreeSet};

/// What names mean in a program that is told of a pose.
#[derive(Clone, Copy)]
pub struct Posed<'a> {
    /// The entries of the pose that a name stands for, by rows.
    pub given: &'a dyn Fn(&str) -> Option<Vec<Vec<Expr>>>,
    /// What a name stands for that got the value of a joint, which it is for.
    pub joint: &'a dyn Fn(&str) -> Option<Expr>,
    /// What stands for +1 or −1 under a name.
    pub sign: &'a dyn Fn(&str) -> Expr,
    /// What stands for 180/π in the values of `atan2d`.
    pub per_radian: Expr,
}

/// What an argument of which nothing is known is called.
const ARGUMENT: &str = "argument ";
/// Parts of the names of arguments that are signs.
const SIGNS: [&str; 12] = [
    "sign", "sgn", "elbow", "shoulder", "wrist", "flip", "sigma", "branch", "coude", "codo", "ellbogen",
    "gomito",
];

/// True if an argument of this name, in small letters, is 1 or −1 by its name.
pub fn is_sign_name(name: &str) -> bool {
    SIGNS.iter().any(|s| name.contains(s))
}

impl<'a> Machine<'a> {
    /// The arguments of a function that is told of a pose.
    pub fn posed_arguments(&self, d: &'a Definition) -> BTreeMap<&'a str, Object<'a>> {
        let mut slots = BTreeMap::new();
        let Some(posed) = self.posed else { return slots };
        let signs = factors_of_roots(&d.body);
        for p in &d.parameters {
            let scalar = |e: Expr| Object::Scalar(Scalar::of(e, &p.span));
            let is_one = p.default.as_ref().is_some_and(is_plus_or_minus_one);
            let has_number = p.default.as_ref().is_some_and(|d| matches!(d.kind, Kind::Number(..)));
            let lower = p.name.to_lowercase();
            let is_sign = || {
                let is_called = is_sign_name(&lower) || lower == "s" || signs.contains(p.name.as_str());
                p.default.is_none() && is_called
            };
            let value = match () {
                () if is_one => scalar((posed.sign)(&p.name)),
                () if has_number => continue,
                () => match self.entries_of_pose(&p.name, &p.span) {
                    Some(entries) => entries,
                    None if eval::VECTORS.contains(&p.name.as_str()) => self.joint_vector(&p.span),
                    None => match (self.names)(&p.name) {
                        Some(meaning) => scalar(meaning),
                        None if is_sign() => scalar((posed.sign)(&p.name)),
                        None => scalar(Expr::symbol(&format!("{ARGUMENT}{}", p.name))),
                    },
                },
            };
            slots.insert(p.name.as_str(), value);
        }
        slots
    }

    /// The one entry of the pose that a name stands for.
    pub fn entry_of_pose(&self, name: &str, span: &Span) -> Option<Scalar> {
        match self.entries_of_pose(name, span)? {
            Object::Scalar(s) => Some(s),
            _ => None,
        }
    }

    /// What a name stands for of the pose.
    fn entries_of_pose(&self, name: &str, span: &Span) -> Option<Object<'a>> {
        let rows = (self.posed?.given)(name)?;
        let is_matlab = self.language == Dialect::Matlab;
        let columns = rows.first()?.len();
        let entries: Vec<Scalar> = rows.iter().flatten().map(|e| Scalar::of(*e, span)).collect();
        if let [one] = &entries[..] {
            return Some(Object::Scalar(one.clone()));
        }
        Some(match (columns, is_matlab) {
            (1, false) => object(Matrix::vector(entries, Sort::Array)),
            (_, true) => object(Matrix::new(rows.len(), columns, entries, Sort::Matlab)),
            _ => object(Matrix::new(rows.len(), columns, entries, Sort::Array)),
        })
    }

    /// The entries of the pose in place of the numbers that a script has for them.
    pub fn pose_in_numbers(&self, name: &str, value: &Object<'a>, span: &Span) -> Option<Object<'a>> {
        if self.frames.len() > 1 {
            return None;
        }
        // Names first: what a value is made of is looked for only where it may be a pose.
        let entries = self.entries_of_pose(name, span).filter(|_| is_number(value))?;
        let shape = |o: &Object<'a>| match o {
            Object::Scalar(_) => Some(1),
            Object::Matrix(m) => Some(m.entries.len()),
            Object::List(items) => Some(items.len()),
            _ => None,
        };
        (shape(value) == shape(&entries)).then_some(entries)
    }

    /// The joint that a name is for, once it got a value that is a formula.
    pub fn joint_of(&self, name: &str, value: &Object<'a>, span: &Span) -> Option<Object<'a>> {
        let joint = (self.posed?.joint)(name).filter(|_| self.is_recorded())?;
        match value {
            Object::Scalar(s) if !s.expr.symbols().is_empty() => {
                Some(Object::Scalar(Scalar::of(joint, span)))
            }
            _ => None,
        }
    }

    /// A field of an argument of which nothing is known, `L.d1`: what the name means.
    pub fn field(&self, value: &Object<'a>, name: &str, span: &Span) -> Option<Object<'a>> {
        self.posed?;
        let Object::Scalar(s) = value else { return None };
        let symbol = s.expr.as_symbol()?;
        if !symbol.name().starts_with(ARGUMENT) {
            return None;
        }
        let meaning = (self.names)(name).map(|e| Object::Scalar(Scalar::of(e, span)));
        meaning.or_else(|| self.entries_of_pose(name, span))
    }

    /// `p.x` of C, here `p_x`, where p is a point that a function is told.
    pub fn coordinate(&mut self, name: &'a str, span: &Span) -> Option<Object<'a>> {
        self.posed?;
        let (base, field) = name.rsplit_once('_')?;
        let Object::Matrix(m) = self.variable(base)?.ok()? else { return None };
        match ["x", "y", "z"].iter().position(|a| *a == field) {
            Some(k) if m.entries.len() == 3 => Some(Object::Scalar(m.entries[k].clone().named(span))),
            Some(k) if m.rows == 4 && m.columns == 4 => {
                Some(Object::Scalar(m.entries[4 * k + 3].clone().named(span)))
            }
            // Of a pose beside its place: the direction of the hand.
            None => self.entry_of_pose(field, span).map(Object::Scalar),
            Some(_) => None,
        }
    }

    /// An entry of the joints that gets a value, `q[0] = atan2(…)`: it is put down, and stands for the joint from here on.
    pub fn posed_entry(
        &mut self,
        name: &str,
        step: &Step,
        value: Object<'a>,
        right: &Span,
        target: &Span,
    ) -> Object<'a> {
        let posed = self.posed.filter(|_| self.is_recorded());
        // Under a name that vectors of joints have, or the one that the table has for them.
        let is_own = |k: usize, q: Expr| {
            eval::VECTORS.contains(&name)
                || posed.is_some_and(|p| (p.joint)(&format!("{name}[{k}]")) == Some(q))
        };
        let single = step.single().filter(|_| posed.is_some());
        let joint = single.and_then(|k| self.joints.get(k).map(|q| (k, *q))).filter(|&(k, q)| is_own(k, q));
        let (Some((k, joint)), Object::Scalar(s)) = (joint, &value) else { return value };
        if s.expr.symbols().is_empty() {
            return value;
        }
        if let Some(written) = report::value(&value, &mut self.budget) {
            let shown = format!("{name}[{k}]");
            self.records.push(Some(Assigned { name: shown, span: right.clone(), value: written }));
        }
        Object::Scalar(Scalar::of(joint, target))
    }

    /// One of two values, by a sign that stands for what is not known.
    pub fn one_of(&self, a: &Object<'a>, b: &Object<'a>, span: &Span) -> Option<Object<'a>> {
        let sign = (self.posed?.sign)(&format!("@{}", span.start));
        let (Object::Scalar(a), Object::Scalar(b)) = (a, b) else { return None };
        let (x, y) = (a.expr, b.expr);
        let (one, two) = (Expr::int(1), Expr::int(2));
        let value = match () {
            () if x == y => x,
            () if x == -y || y == -x => sign * x,
            () => x * (one + sign) / two + y * (one - sign) / two,
        };
        Some(Object::Scalar(Scalar::of(value, span)))
    }

    /// Both ways from a condition that is not known; what names get in them is one of two values.
    pub fn either(&mut self, bodies: &[&'a [Statement]], span: &Span) -> Read<Flow<'a>> {
        let mut names: Vec<&'a str> = vec![];
        let mut ways: Vec<&'a [Statement]> = vec![];
        for body in bodies {
            // What gives up, or gives something back early, is not followed.
            if !changed(body, &mut names) {
                ways.push(body);
            }
        }
        names.sort_unstable();
        names.dedup();
        let value = |m: &mut Self, name: &str| m.frame().slots.get(name).and_then(|s| s.value.clone());
        let before: Vec<Option<Object<'a>>> = names.iter().map(|n| value(self, n)).collect();
        let mut after: Vec<Vec<Option<Object<'a>>>> = vec![];
        for way in ways {
            for (name, was) in names.iter().zip(&before) {
                match was {
                    Some(was) => self.frame().slots.insert(name, Slot::of(was.clone())),
                    None => self.frame().slots.remove(name),
                };
            }
            if let Flow::Next = self.block(way) {
                after.push(names.iter().map(|n| value(self, n)).collect());
            }
        }
        for (k, name) in names.iter().enumerate() {
            let all: Vec<&Object<'a>> = after.iter().filter_map(|a| a[k].as_ref()).collect();
            let now = match all[..] {
                [one] => Some(one.clone()),
                [a, b] => self.one_of(a, b, span),
                _ => None,
            };
            let slot = now.map_or_else(Slot::default, Slot::of);
            self.frame().slots.insert(name, slot);
        }
        Ok(Flow::Next)
    }
}

/// The names that are factors of roots, `side * sqrt(1 - c*c)`: an argument of which nothing else is known is 1 or −1 there.
fn factors_of_roots(body: &[Statement]) -> BTreeSet<&str> {
    let mut found = BTreeSet::new();
    for statement in body {
        match &statement.kind {
            StatementKind::Assign(_, node) | StatementKind::Return(Some(node)) => {
                in_products(node, &mut found)
            }
            StatementKind::If(arms, other) => {
                let all = arms.iter().map(|a| &a.1).chain([other]);
                all.for_each(|body| found.append(&mut factors_of_roots(body)));
            }
            StatementKind::For(_, _, body) => found.append(&mut factors_of_roots(body)),
            _ => {}
        }
    }
    found
}

fn in_products<'a>(node: &'a Node, found: &mut BTreeSet<&'a str>) {
    let is_root = |node: &Node| match &node.kind {
        Kind::Path(base, suffixes) => {
            let is_named = |name: &str| name == "sqrt" || name == "acos" || name == "arccos";
            let by_name = matches!(&base.kind, Kind::Name(name) if is_named(name));
            let by_module =
                suffixes.iter().any(|s| matches!(&s.kind, SuffixKind::Attribute(a) if is_named(a)));
            by_name || by_module
        }
        _ => false,
    };
    match &node.kind {
        Kind::Chain(first, rest) => {
            let parts = || std::iter::once(&**first).chain(rest.iter().map(|r| &r.1));
            let is_product = rest.iter().all(|r| matches!(r.0, Op::Mul | Op::EachMul));
            if is_product && parts().any(is_root) {
                found.extend(parts().filter_map(|p| match &p.kind {
                    Kind::Name(name) => Some(name.as_str()),
                    _ => None,
                }));
            }
            parts().for_each(|p| in_products(p, found));
        }
        Kind::Path(base, suffixes) => {
            in_products(base, found);
            for suffix in suffixes {
                if let SuffixKind::Call(arguments) = &suffix.kind {
                    arguments.iter().for_each(|a| in_products(&a.value, found));
                }
            }
        }
        Kind::Bracket(inner) | Kind::Unary(_, inner) => in_products(inner, found),
        Kind::Tuple(parts) | Kind::List(parts) => parts.iter().for_each(|p| in_products(p, found)),
        _ => {}
    }
}

fn is_plus_or_minus_one(node: &Node) -> bool {
    match &node.kind {
        Kind::Number(r, ..) => r.is_one(),
        Kind::Bracket(inner) => is_plus_or_minus_one(inner),
        Kind::Unary(_, inner) => is_plus_or_minus_one(inner),
        _ => false,
    }
}
