//! A table's chain as a tree: bodies `base`, `link1`, …, `tool`.
//!
//! A joint's origin is what is constant before its motion, its axis z; rows without a variable are part of the next origin. A row
//! that adds variables is one joint for each, with bodies between; those that are not its own follow them.

use super::{Body, Follows, Joint, Mass, Mechanism};
use crate::description::{Description, JointKind, Row, Variable};
use crate::geometry::{Transform, Vector};
use denavit_symbolic::{Angle, Expr, Rational, Symbol};
use std::collections::HashSet;

/// A tree under way.
struct Growing {
    tree: Mechanism,
    bodies: HashSet<String>,
    joints: HashSet<String>,
    /// The body that the next joint stands on, and the next joint's frame there.
    on: usize,
    origin: Transform<Expr>,
    /// The joint whose value is each variable.
    own: Vec<Option<usize>>,
    /// The joints that follow, the variables that they follow, and their factors.
    following: Vec<(usize, usize, Rational)>,
}

impl Mechanism {
    /// The chain of a description, with the values of its parameters.
    ///
    /// # Errors
    /// The parameters without value.
    pub fn of(d: &Description) -> Result<Self, Vec<Symbol>> {
        let missing: Vec<Symbol> =
            d.parameters.iter().filter(|p| p.value.is_none()).map(|p| p.symbol).collect();
        if !missing.is_empty() {
            return Err(missing);
        }
        let value = |e: Expr| e.substitute(|s| d.exact_value(s));
        let variables: Vec<Symbol> = d.variables().iter().map(|v| v.symbol).collect();
        let names = named_joints(d);
        let tree = Mechanism { name: d.name.clone(), bodies: vec![], joints: vec![], root: 0 };
        let mut growing = Growing {
            tree,
            bodies: HashSet::new(),
            joints: names.iter().cloned().collect(),
            on: 0,
            origin: d.base.map(value),
            own: vec![None; variables.len()],
            following: vec![],
        };
        growing.body("base");
        for (i, row) in d.rows.iter().enumerate() {
            let screws = row.screws(d.convention);
            let through = |x: Transform<Expr>, all: &[crate::description::Screw]| {
                all.iter().fold(x, |x, s| x * s.transform().map(value))
            };
            growing.origin = through(growing.origin, &screws.before);
            let parts =
                [(JointKind::Revolute, screws.joint.angle), (JointKind::Prismatic, screws.joint.length)];
            let mut moves: Vec<(JointKind, usize, Rational)> = vec![];
            for (kind, cell) in parts {
                let mut rest = Angle::of(value(cell));
                let is_joint = |e: &Expr| e.as_symbol().and_then(|s| variables.iter().position(|&v| v == s));
                moves.extend(rest.terms.iter().filter_map(|(e, k)| Some((kind, is_joint(e)?, k.clone()))));
                rest.terms.retain(|t| is_joint(&t.0).is_none());
                let still = rest.to_expr();
                growing.origin = growing.origin
                    * match kind {
                        JointKind::Revolute => Transform::rotation_z(still),
                        JointKind::Prismatic => Transform::translation_z(still),
                    };
            }
            // Its own variable first, so that what follows it stands behind it.
            let own = row.variable.and_then(|v| variables.iter().position(|&s| s == v.symbol));
            moves.sort_by_key(|m| (Some(m.1) != own, m.1));
            let moves = with_gear(moves, own);
            for (k, (kind, variable, factor)) in moves.iter().enumerate() {
                let is_own = k == 0 && own == Some(*variable);
                growing.row(row, i + 1, (*kind, *variable, factor), is_own, &names[*variable]);
            }
            if !moves.is_empty() {
                // The row's frame, in which its mass is given, in the frame of the body.
                let frame = through(Transform::identity(), &screws.behind);
                growing.tree.bodies[growing.on].mass = mass(row, &frame, &value);
            }
            growing.origin = through(growing.origin, &screws.behind);
        }
        growing.origin = growing.origin * d.tool.map(value);
        let name = growing.unused("tool_joint");
        growing.joint(name, None, "tool");
        Ok(growing.finished())
    }
}

impl Growing {
    fn body(&mut self, name: &str) -> usize {
        let mut name = name.to_string();
        while !self.bodies.insert(name.clone()) {
            name.push('_');
        }
        self.tree.bodies.push(Body { name, mass: None, looks: vec![] });
        self.tree.bodies.len() - 1
    }

    fn unused(&mut self, name: &str) -> String {
        let mut name = name.to_string();
        while !self.joints.insert(name.clone()) {
            name.push('_');
        }
        name
    }

    /// A joint to a new body, at the frame where the last one left off.
    fn joint(&mut self, name: String, kind: Option<JointKind>, body: &str) -> &mut Joint {
        let (parent, child) = (self.on, self.body(body));
        let origin = std::mem::replace(&mut self.origin, Transform::identity());
        self.tree.joints.push(Joint {
            name,
            kind,
            parent,
            child,
            origin,
            axis: Vector([0, 0, 1].map(Expr::int)),
            limits: None,
            velocity: None,
            effort: None,
            follows: None,
        });
        self.on = child;
        self.tree.joints.last_mut().expect("it was just added")
    }

    /// What one variable moves in a row.
    fn row(
        &mut self,
        row: &Row,
        number: usize,
        (kind, variable, factor): (JointKind, usize, &Rational),
        is_own: bool,
        name: &str,
    ) {
        let body = format!("link{number}");
        if is_own {
            let joint = self.joint(name.into(), Some(kind), &body);
            (joint.limits, joint.velocity) = (row.limits, row.velocity);
            // A factor of its own is the way round of the axis.
            if factor.is_negative() {
                joint.axis = -joint.axis;
            }
            self.own[variable] = Some(self.tree.joints.len() - 1);
            return;
        }
        let name = self.unused(&format!("{name}_in_{number}"));
        self.joint(name, Some(kind), &body);
        self.following.push((self.tree.joints.len() - 1, variable, factor.clone()));
    }

    fn finished(mut self) -> Mechanism {
        for (joint, variable, factor) in self.following {
            let offset = Expr::int(0);
            self.tree.joints[joint].follows =
                self.own[variable].map(|joint| Follows { joint, factor, offset });
        }
        self.tree
    }
}

/// The motions of a row, kind, variable and factor, its own first with a factor of 1 or −1: a joint with a gear is one that moves by
/// its own value and one on the same axis that follows it by the rest.
pub(in crate::description) fn with_gear(
    mut moves: Vec<(JointKind, usize, Rational)>,
    own: Option<usize>,
) -> Vec<(JointKind, usize, Rational)> {
    if let Some(&mut (kind, variable, ref mut factor)) = moves.first_mut()
        && own == Some(variable)
        && !factor.abs().is_one()
    {
        let unit = Rational::from(if factor.is_negative() { -1 } else { 1 });
        let rest = &*factor - &unit;
        *factor = unit;
        moves.insert(1, (kind, variable, rest));
    }
    moves
}

/// The mass of a row's link in the frame of its body, in which the row's frame stands.
fn mass(row: &Row, frame: &Transform<Expr>, value: &impl Fn(Expr) -> Expr) -> Option<Mass> {
    let mut row = row.clone();
    row.move_frame(frame);
    row.weighed().map(|m| Mass { mass: value(m.mass), com: m.com.map(value), inertia: m.inertia.map(value) })
}

/// The names of the joints that move by themselves; `q3` where there is none.
fn named_joints(d: &Description) -> Vec<String> {
    let own = d.rows.iter().filter_map(|r| Some((r.variable?, r.name.as_deref())));
    let mut seen = HashSet::new();
    let name = |(v, name): (Variable, Option<&str>)| {
        let plain = name.map(|n| n.replace(|c: char| c.is_control(), " ")).filter(|n| !n.trim().is_empty());
        let plain = plain.unwrap_or_else(|| v.symbol.name().to_string());
        if seen.insert(plain.clone()) { plain } else { format!("{plain}_{}", v.symbol.name()) }
    };
    own.map(name).collect()
}
