//! Rows as bodies and joints: a chain as `base`, `link1`, …, `tool`, a tree of rows as its frames.
//!
//! A joint's origin is what is constant before its motion, its axis z. A row that adds variables is one joint for each, with bodies
//! between; those that are not its own follow them.

use super::{Body, Follows, Joint, JointDrive, Mass, Mechanism};
use crate::description::{
    Convention, Description, JointKind, MissingValue, NamedFrame, Parameter, Row, RowTree, Screw, Variable,
};
use crate::geometry::{self, Axis, Transform, Vector};
use denavit_symbolic::{Angle, Expr, Rational, Symbol};
use std::collections::{HashMap, HashSet};

impl Mechanism {
    /// The chain of a description, with the values of its parameters; rows that do not move are part of the next origin.
    ///
    /// # Errors
    /// If a parameter has no value.
    pub fn of(d: &Description) -> Result<Self, MissingValue> {
        has_values(&d.rows, &[d.base, d.tool], &d.parameters)?;
        let mut growing = Growing::new(&d.name, "base", &d.rows, &d.parameters);
        let names = named_joints(d);
        growing.joints.extend(names.iter().cloned());
        let mut place = Place { on: 0, origin: d.base };
        for (i, row) in d.rows.iter().enumerate() {
            let named = |motion: &Motion| {
                let name = &names[motion.variable];
                let joint = if motion.is_own { name.clone() } else { format!("{name}_in_{}", i + 1) };
                (joint, format!("link{}", i + 1))
            };
            let behind = growing.row(row, d.convention, place, &named);
            if growing.moves(row).is_empty() {
                // A row that does not move is fixed to the body before it.
                growing.weigh(behind.on, row, &behind.origin);
            }
            place = behind;
        }
        let end = Place { origin: place.origin * d.tool, ..place };
        growing.still(end, "tool_joint", "tool");
        let mut tree = growing.finished(&d.poses);
        tree.gravity = d.gravity.map(|g| g.map(|e| known(e, &d.parameters))).filter(|g| is_constant(g));
        Ok(tree)
    }

    /// A tree of rows, with the values of its parameters; each row's frame is a body, and so is each named frame.
    ///
    /// # Errors
    /// If a parameter has no value.
    pub fn of_rows(tree: &RowTree) -> Result<Self, MissingValue> {
        let poses: Vec<Transform<Expr>> =
            [tree.base].into_iter().chain(tree.frames.iter().map(|f| f.pose)).collect();
        has_values(&tree.rows, &poses, &tree.parameters)?;
        let mut growing =
            Growing::new(&tree.name, crate::description::branches::BASE, &tree.rows, &tree.parameters);
        let mut of_row: Vec<usize> = vec![];
        let place = |row: Option<usize>, of_row: &[usize]| match row {
            Some(row) => Place { on: of_row[row], origin: Transform::identity() },
            None => Place { on: 0, origin: tree.base },
        };
        for (j, row) in tree.rows.iter().enumerate() {
            let name = tree.frame_name(j);
            // The joint that moves by itself has the row's name, and so has the last body, the row's frame.
            let numbered = |is_plain: bool, k: usize| {
                if is_plain { name.clone() } else { format!("{name} ({})", k + 1) }
            };
            let named =
                |motion: &Motion| (numbered(motion.k == 0, motion.k), numbered(motion.is_last, motion.k));
            let mut behind = growing.row(row, Convention::Khalil, place(tree.after[j], &of_row), &named);
            if growing.moves(row).is_empty() {
                behind = Place { on: growing.still(behind, &name, &name), origin: Transform::identity() };
                growing.weigh(behind.on, row, &Transform::identity());
            }
            of_row.push(behind.on);
        }
        for NamedFrame { name, on, pose } in &tree.frames {
            let on = place(*on, &of_row);
            growing.still(Place { origin: on.origin * *pose, ..on }, name, name);
        }
        let mut mechanism = growing.finished(&tree.poses);
        let gravity = tree.gravity.map(|g| g.map(|e| known(e, &tree.parameters)));
        mechanism.gravity = gravity.filter(|g| is_constant(g));
        Ok(mechanism)
    }
}

/// A formula with the values of its parameters.
fn known(e: Expr, parameters: &[Parameter]) -> Expr {
    e.substitute(|s| parameters.iter().find(|p| p.symbol == s)?.value)
}

fn is_constant(all: &[Expr]) -> bool {
    all.iter().all(|e| e.symbols().is_empty())
}

/// Where a chain under way has come to: a body, and a frame there.
#[derive(Clone, Copy)]
struct Place {
    on: usize,
    origin: Transform<Expr>,
}

/// What one variable moves in a row.
struct Motion {
    kind: JointKind,
    variable: usize,
    factor: Rational,
    /// Whether the row has this variable, and moves by it with a factor of 1 or −1.
    is_own: bool,
    /// Its number among the row's motions.
    k: usize,
    is_last: bool,
}

/// A tree under way.
struct Growing<'d> {
    tree: Mechanism,
    bodies: HashSet<String>,
    joints: HashSet<String>,
    variables: Vec<Symbol>,
    parameters: &'d [Parameter],
    /// The joint whose value is each variable.
    own: Vec<Option<usize>>,
    /// The joints that follow, the variables that they follow, and their factors.
    following: Vec<(usize, usize, Rational)>,
}

/// Fails if a parameter that places frames has no value.
fn has_values(rows: &[Row], poses: &[Transform<Expr>], parameters: &[Parameter]) -> Result<(), MissingValue> {
    let cells = rows.iter().flat_map(|r| [r.theta, r.d, r.a, r.alpha, r.gamma, r.b]);
    let symbols: HashSet<Symbol> =
        cells.chain(poses.iter().flat_map(|p| p.matrix().concat())).flat_map(Expr::symbols).collect();
    let used: Vec<Symbol> = parameters.iter().map(|p| p.symbol).filter(|s| symbols.contains(s)).collect();
    let value = |s: Symbol| parameters.iter().find(|p| p.symbol == s)?.number();
    denavit_program::values(&used, value).map(|_| ())
}

impl<'d> Growing<'d> {
    fn new(name: &str, root: &str, rows: &[Row], parameters: &'d [Parameter]) -> Self {
        let variables: Vec<Symbol> = rows.iter().filter_map(|r| r.variable).map(|v| v.symbol).collect();
        let tree = Mechanism {
            name: name.into(),
            bodies: vec![],
            joints: vec![],
            root: 0,
            poses: vec![],
            gravity: None,
            holds: vec![],
            driven: vec![],
        };
        let mut growing = Growing {
            tree,
            bodies: HashSet::new(),
            joints: HashSet::new(),
            own: vec![None; variables.len()],
            variables,
            parameters,
            following: vec![],
        };
        growing.body(root);
        growing
    }

    fn value(&self, e: Expr) -> Expr {
        known(e, self.parameters)
    }

    fn body(&mut self, name: &str) -> usize {
        let mut name = name.to_string();
        while !self.bodies.insert(name.clone()) {
            name.push('_');
        }
        self.tree.bodies.push(Body { name, mass: None, is_unweighed: false, looks: vec![] });
        self.tree.bodies.len() - 1
    }

    fn unused(&mut self, name: &str) -> String {
        let mut name = name.to_string();
        while !self.joints.insert(name.clone()) {
            name.push('_');
        }
        name
    }

    /// A joint to a new body.
    fn joint(&mut self, place: Place, name: String, kind: Option<JointKind>, body: &str) -> &mut Joint {
        let child = self.body(body);
        let origin = place.origin.map(|e| self.value(e));
        self.tree.joints.push(Joint {
            name,
            kind,
            parent: place.on,
            child,
            origin,
            axis: Vector::unit(Axis::Z),
            limits: None,
            velocity: None,
            effort: None,
            drive: JointDrive::default(),
            follows: None,
        });
        self.tree.joints.last_mut().expect("it was just added")
    }

    /// A body that does not move on the one that it stands on.
    fn still(&mut self, place: Place, name: &str, body: &str) -> usize {
        let name = self.unused(name);
        self.joint(place, name, None, body).child
    }

    /// What moves in a row: its own variable first, so that what follows it stands behind it.
    fn moves(&self, row: &Row) -> Vec<Motion> {
        let variable = |s: Symbol| self.variables.iter().position(|&v| v == s);
        let mut moves: Vec<(JointKind, usize, Rational)> = vec![];
        for (kind, cell) in [(JointKind::Revolute, row.theta), (JointKind::Prismatic, row.d)] {
            let terms = Angle::of(self.value(cell)).terms;
            moves
                .extend(terms.iter().filter_map(|(e, k)| Some((kind, variable(e.as_symbol()?)?, k.clone()))));
        }
        let own = row.variable.and_then(|v| variable(v.symbol));
        moves.sort_by_key(|m| (Some(m.1) != own, m.1));
        let moves = with_gear(moves, own);
        let count = moves.len();
        let motion = |(k, (kind, variable, factor))| {
            let is_own = k == 0 && own == Some(variable);
            Motion { kind, variable, factor, is_own, k, is_last: k + 1 == count }
        };
        moves.into_iter().enumerate().map(motion).collect()
    }

    /// The joints of a row, which `named` names together with their bodies.
    fn row(
        &mut self,
        row: &Row,
        convention: Convention,
        from: Place,
        named: &dyn Fn(&Motion) -> (String, String),
    ) -> Place {
        let screws = row.screws(convention);
        let through = |x: Transform<Expr>, all: &[Screw]| all.iter().fold(x, |x, s| x * s.transform());
        let at_rest = |e: Expr| e.substitute(|s| self.variables.contains(&s).then(|| Expr::int(0)));
        let joint = Screw {
            angle: at_rest(screws.joint.angle),
            length: at_rest(screws.joint.length),
            ..screws.joint
        };
        let mut place = Place { origin: through(from.origin, &screws.before) * joint.transform(), ..from };
        let moves = self.moves(row);
        for motion in &moves {
            let (name, body) = named(motion);
            let on = self.moved(row, motion, place, name, &body);
            place = Place { on, origin: Transform::identity() };
        }
        let behind = through(Transform::identity(), &screws.behind);
        if !moves.is_empty() {
            // The row's frame, in which its mass is given, in the frame of the body.
            self.weigh(place.on, row, &behind);
        }
        Place { origin: place.origin * behind, ..place }
    }

    /// The joint of a motion, and the body that it moves.
    fn moved(&mut self, row: &Row, motion: &Motion, place: Place, name: String, body: &str) -> usize {
        let number = self.tree.joints.len();
        let Motion { kind, variable, ref factor, is_own, .. } = *motion;
        if is_own {
            let limits = row.limits.map(|ends| ends.map(|e| self.value(e)));
            let velocity = row.velocity.map(|e| self.value(e));
            let [rotor, viscous, coulomb] = [row.rotor, row.viscous, row.coulomb]
                .map(|e| e.map(|e| self.value(e)).filter(|e| is_constant(&[*e])));
            self.joints.insert(name.clone());
            let joint = self.joint(place, name, Some(kind), body);
            (joint.limits, joint.velocity) = (limits, velocity);
            joint.drive = JointDrive { rotor, viscous, coulomb };
            // A factor of its own is the way round of the axis.
            if factor.is_negative() {
                joint.axis = -joint.axis;
            }
            self.own[variable] = Some(number);
        } else {
            let name = self.unused(&name);
            self.joint(place, name, Some(kind), body);
            self.following.push((number, variable, factor.clone()));
        }
        self.tree.joints[number].child
    }

    /// Gives a body the mass of a row's link, the row's frame being this one in its own.
    fn weigh(&mut self, body: usize, row: &Row, frame: &Transform<Expr>) {
        let mut row = row.clone();
        row.move_frame(frame);
        let mass = match &self.tree.bodies[body].mass {
            None => row.weighed(),
            // With what is fixed to it already.
            Some(m) => row.body().and_then(|own| {
                let all = geometry::Body::about_centre(m.mass, Vector(m.com), m.inertia) + own;
                let (centre, inertia) = all.at_centre()?;
                Some(Mass { mass: all.mass, com: centre.0, inertia })
            }),
        };
        let Some(mass) = mass else { return };
        let mass = Mass {
            mass: self.value(mass.mass),
            com: mass.com.map(|e| self.value(e)),
            inertia: mass.inertia.map(|e| self.value(e)),
        };
        let entries = [mass.mass].into_iter().chain(mass.com).chain(mass.inertia);
        let is_known = entries.into_iter().all(|e| e.symbols().is_empty());
        self.tree.bodies[body].mass = is_known.then_some(mass);
    }

    /// The tree, with configurations that are given by the variables of the rows.
    fn finished(mut self, poses: &[(String, Vec<Expr>)]) -> Mechanism {
        // The variables of the tree are those of the rows, in the order of its joints.
        let numbers: HashMap<usize, usize> =
            self.own.iter().enumerate().filter_map(|(v, joint)| Some(((*joint)?, v))).collect();
        for (joint, variable, factor) in self.following {
            let offset = Expr::int(0);
            self.tree.joints[joint].follows =
                self.own[variable].map(|joint| Follows { joint, factor, offset });
        }
        let variables = self.tree.variables();
        let order: Vec<usize> = variables.iter().filter_map(|j| numbers.get(j).copied()).collect();
        let pose =
            |(name, values): &(String, Vec<Expr>)| (name.clone(), order.iter().map(|&v| values[v]).collect());
        self.tree.poses = poses.iter().filter(|p| p.1.len() == order.len()).map(pose).collect();
        self.tree
    }
}

/// The motions of a row, kind, variable and factor, its own first with a factor of 1 or −1: a joint with a gear is one that moves by
/// its own value and one on the same axis that follows it by the rest.
fn with_gear(
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
