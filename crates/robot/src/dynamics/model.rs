//! An arm with masses: its moving links, its drives, gravity.

use super::tree::OfTree;
use crate::description::{Convention, Description, JointKind, Parameter, Row, RowTree};
use crate::geometry::{Axis, Body, PARAMETERS, Rotation, Transform, Vector};
use crate::mechanism::robot::link_of;
use crate::mechanism::{Affine, Lengths, MissingValue, MovingAxes, Robot};
use crate::scalar::Scalar;
use denavit_symbolic::{Expr, Rational, Symbol};
use std::collections::BTreeSet;
use std::fmt;

/// The acceleration of gravity where a description says nothing of it, along −z of the base, m/s²: as a decimal.
pub const GRAVITY: (i64, i64) = (981, 100);

/// An arm with masses, or a tree.
#[derive(Clone, PartialEq, Debug)]
pub struct Dynamics<T> {
    /// The links, each behind the one that it stands on: one for each moving axis.
    pub links: Vec<Link<T>>,
    /// The tool in the frame of the last link.
    pub tool: Transform<T>,
    /// The acceleration of gravity in the base, m/s².
    pub gravity: Vector<T>,
    /// The drives, one a joint variable.
    pub drives: Vec<Drive<T>>,
}

/// What moves about or along one axis.
#[derive(Clone, PartialEq, Debug)]
pub struct Link<T> {
    /// The link that it stands on, an earlier one: of an arm the one before; none on the base.
    pub parent: Option<usize>,
    /// What is constant between the frame of that link, or the base, and the motion.
    pub before: Transform<T>,
    /// Whether it turns about z or slides along it.
    pub kind: JointKind,
    /// Its angle or its displacement.
    pub value: Affine<T>,
    /// Its mass with that of everything fixed to it, in its frame: the one behind the motion.
    pub body: Body<T>,
    /// The row of the table that its axis stands in, or its joint in the tree, from 0.
    pub row: usize,
}

/// What belongs to a joint variable itself.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Drive<T> {
    /// The inertia of the rotor as the joint feels it, N² times its own behind a gear of N: IA, kg·m² (kg for a slide).
    pub rotor: T,
    /// Viscous friction: FV, torque by velocity.
    pub viscous: T,
    /// Coulomb's friction: FS, torque.
    pub coulomb: T,
}

/// What the tool exerts on its surroundings: the force in newtons and the moment about the tool's origin in newton metres, along
/// the axes of the base.
pub type Wrench<T> = [Vector<T>; 2];

impl<T: Scalar> Dynamics<T> {
    /// How many joint variables there are.
    pub fn joints(&self) -> usize {
        self.drives.len()
    }

    /// A robot with the masses of its rows, each in the row's frame, with its drives, under gravity. What is fixed to the base
    /// does not count.
    pub fn new(robot: &Robot<T>, rows: &[Body<T>], drives: Vec<Drive<T>>, gravity: Vector<T>) -> Self {
        let axes = MovingAxes::new(robot, Lengths::Before);
        let mut constants = axes.constants.into_iter();
        let mut links: Vec<Link<T>> = axes
            .moving
            .into_iter()
            .zip(constants.by_ref())
            .enumerate()
            .map(|(k, (a, before))| Link {
                parent: k.checked_sub(1),
                before,
                kind: a.kind,
                value: a.value,
                body: Body::nothing(),
                row: a.row,
            })
            .collect();
        let tool = constants.next().unwrap_or_else(Transform::identity);
        // Where the frame of each row stands in that of the link that it is fixed to.
        let (mut moved, mut place) = (0, Transform::identity());
        for (link, body) in robot.links.iter().zip(rows) {
            if link.moves() {
                moved += usize::from(link.turns()) + usize::from(link.slides());
                place = link.after;
            } else {
                place = place * link.transform(&[]);
            }
            if let Some(of) = moved.checked_sub(1) {
                links[of].body = links[of].body + body.seen_from(&place);
            }
        }
        Dynamics { links, tool, gravity, drives }
    }

    /// The same with a body fixed to the tool, given in its frame. An arm without moving links carries nothing.
    #[must_use]
    pub fn carrying(mut self, payload: &Body<T>) -> Self {
        if let Some(last) = self.links.last_mut() {
            last.body = last.body + payload.seen_from(&self.tool);
        }
        self
    }

    /// The rates of the axes at rates of the joints.
    pub(super) fn rates(&self, joints: &[T]) -> Vec<T> {
        let rate = |value: &Affine<T>| {
            let parts =
                value.terms.iter().map(|&(j, k)| if k == T::one() { joints[j] } else { k * joints[j] });
            parts.reduce(|a, b| a + b).unwrap_or_else(T::zero)
        };
        self.links.iter().map(|l| rate(&l.value)).collect()
    }

    /// How each link moves: its frame in that of the one before, and its angular velocity and the velocity of its origin along its own
    /// axes.
    pub(super) fn velocities(&self, q: &[T], qd: &[T]) -> Vec<Moved<T>> {
        let z = Vector::unit(Axis::Z);
        let mut all: Vec<Moved<T>> = vec![];
        for (link, rate) in self.links.iter().zip(self.rates(qd)) {
            let place = link.place(q);
            let back = place.rotation.inverse();
            let of = |k: usize| (all[k].turning, all[k].velocity);
            let (turning, velocity) = link.parent.map_or((Vector::zero(), Vector::zero()), of);
            let mut velocity = back * (velocity + turning.cross(place.translation));
            let mut turning = back * turning;
            match link.kind {
                JointKind::Revolute => turning = turning + z.scale(rate),
                JointKind::Prismatic => velocity = velocity + z.scale(rate),
            }
            all.push(Moved { place, turning, velocity });
        }
        all
    }

    /// The frames of the links in the base.
    pub(super) fn frames(&self, places: impl Iterator<Item = Transform<T>>) -> Vec<Transform<T>> {
        let mut all: Vec<Transform<T>> = vec![];
        for (link, place) in self.links.iter().zip(places) {
            all.push(link.parent.map_or(place, |k| all[k] * place));
        }
        all
    }

    /// What torques at the axes are at the joints: τ = Gᵀ τ of the axes, with the rates of the axes G q̇.
    pub(super) fn at_joints(&self, axes: &[T]) -> Vec<T> {
        let mut torques = vec![T::zero(); self.joints()];
        for (link, &torque) in self.links.iter().zip(axes) {
            for &(j, k) in &link.value.terms {
                torques[j] = torques[j] + if k == T::one() { torque } else { k * torque };
            }
        }
        torques
    }

    /// The same in another scalar type.
    pub fn map<U: Scalar>(&self, mut f: impl FnMut(T) -> U) -> Dynamics<U> {
        let mut links = vec![];
        for l in &self.links {
            let terms = l.value.terms.iter().map(|&(j, k)| (j, f(k))).collect();
            let value = Affine { offset: f(l.value.offset), quarters: l.value.quarters, terms };
            links.push(Link {
                parent: l.parent,
                before: l.before.map(&mut f),
                kind: l.kind,
                value,
                body: l.body.map(&mut f),
                row: l.row,
            });
        }
        let drive = |d: &Drive<T>| Drive { rotor: f(d.rotor), viscous: f(d.viscous), coulomb: f(d.coulomb) };
        let drives = self.drives.iter().map(drive).collect();
        let (tool, gravity) = (self.tool.map(&mut f), self.gravity.map(&mut f));
        Dynamics { links, tool, gravity, drives }
    }
}

/// How a link moves.
#[derive(Clone, Copy)]
pub(super) struct Moved<T> {
    /// Its frame in that of the one before.
    pub place: Transform<T>,
    /// Its angular velocity along its own axes.
    pub turning: Vector<T>,
    /// The velocity of its origin along its own axes.
    pub velocity: Vector<T>,
}

impl<T: Scalar> Link<T> {
    /// The frame of the link in that of the one before.
    pub(super) fn place(&self, q: &[T]) -> Transform<T> {
        let motion = match self.kind {
            JointKind::Revolute => {
                let (s, c) = self.value.sin_cos(q);
                let turn = Rotation::from_sin_cos(Axis::Z, s, c);
                return Transform::from_rotation_translation(
                    self.before.rotation * turn,
                    self.before.translation,
                );
            }
            JointKind::Prismatic => self.before.rotation.z().scale(self.value.value(q)),
        };
        Transform::from_rotation_translation(self.before.rotation, self.before.translation + motion)
    }
}

impl<T: Scalar> Drive<T> {
    /// IA q̈ + FV q̇; Coulomb's friction is apart.
    pub(super) fn torque(&self, rate: T, change: T) -> T {
        self.rotor * change + self.viscous * rate
    }

    /// A joint without any.
    pub fn nothing() -> Self {
        Drive { rotor: T::zero(), viscous: T::zero(), coulomb: T::zero() }
    }
}

/// A dynamic model in formulas.
#[derive(Clone, Debug)]
pub struct Formulas {
    /// The arm.
    pub dynamics: Dynamics<Expr>,
    /// The joint variables.
    pub q: Vec<Symbol>,
    /// Their rates, `qd1` ….
    pub qd: Vec<Symbol>,
    /// Their accelerations, `qdd1` ….
    pub qdd: Vec<Symbol>,
    /// All other symbols: those of the table, those of masses, gravity; with their values where these are known.
    pub parameters: Vec<Parameter>,
    /// Whether the masses are symbols of Khalil and Dombre's names, because the description says nothing of them.
    pub is_generic: bool,
    /// The ten numbers of a payload, in the order of [`PARAMETERS`]; none without one.
    pub payload: Vec<Symbol>,
}

/// Why there is no dynamic model in numbers.
#[derive(Clone, PartialEq, Debug)]
pub enum NoNumbers {
    /// The description says nothing of masses.
    NoMasses,
    /// Parameters without value.
    Missing(MissingValue),
    /// What has this number among the rows, from 0, weighs less than nothing.
    NegativeMass(usize, Option<String>),
}

impl fmt::Display for NoNumbers {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NoNumbers::NoMasses => f.write_str("the description says nothing of masses"),
            NoNumbers::Missing(missing) => missing.fmt(f),
            NoNumbers::NegativeMass(_, Some(name)) => write!(f, "the mass behind `{name}` is negative"),
            NoNumbers::NegativeMass(row, None) => write!(f, "the mass of row {} is negative", row + 1),
        }
    }
}

impl std::error::Error for NoNumbers {}

impl Description {
    /// Whether the description says something of masses.
    pub fn has_masses(&self) -> bool {
        self.rows.iter().any(|r| r.body().is_some())
    }

    /// Whether no row weighs less than nothing, as far as masses have values.
    ///
    /// # Errors
    /// The first that does.
    pub(super) fn no_negative_mass(&self) -> Result<(), NoNumbers> {
        let is_negative =
            |r: &Row| r.mass.is_some_and(|m| m.eval(|s| self.value(s)).is_ok_and(|mass| mass < 0.0));
        match self.rows.iter().position(is_negative) {
            Some(row) => Err(NoNumbers::NegativeMass(row, self.rows[row].name.clone())),
            None => Ok(()),
        }
    }

    /// The acceleration of gravity in the base, m/s².
    fn gravity_or_default(&self) -> Vector<Expr> {
        let (n, d) = GRAVITY;
        let down = || [Expr::int(0), Expr::int(0), Expr::from(Rational::new(-n, d))];
        Vector(self.gravity.unwrap_or_else(down))
    }
}

impl Formulas {
    /// The model of a description. Where it says nothing of masses, the links have symbols of Khalil and Dombre's names with
    /// the number of their axis, XX1 … M1, about the origins of their own frames; the drives have none. Gravity along an axis
    /// of the base has the symbol g.
    pub fn new(d: &Description) -> Self {
        Self::with(d, false)
    }

    /// The same with a symbol for each of the ten numbers of a link that is not 0: XX1 … M1, with that value where the lengths in it have
    /// values. A link with names of its own, m1 or lc1, keeps them, with the numbers beside them.
    pub fn named(d: &Description) -> Self {
        Self::with(d, true)
    }

    /// The same with the numbers of links and of gravity.
    pub fn in_numbers(d: &Description) -> Self {
        let mut formulas = Self::new(d);
        let own: Vec<Parameter> = formulas.parameters.split_off(d.parameters.len());
        let value = |s: Symbol| own.iter().find(|p| p.symbol == s)?.value;
        formulas.dynamics = formulas.dynamics.map(|e| e.substitute(value));
        formulas.parameters.extend(own.into_iter().filter(|p| p.value.is_none()));
        formulas
    }

    /// The model of a whole tree with its numbers: q1, q2, … are the values of its joints, in order.
    pub fn of_tree(tree: &OfTree<Expr>) -> Self {
        let n = tree.joints.len();
        let [q, qd, qdd] = ["q", "qd", "qdd"]
            .map(|letters| (1..=n).map(|k| Symbol::new(&format!("{letters}{k}"))).collect::<Vec<Symbol>>());
        let dynamics = tree.dynamics.clone();
        Formulas { dynamics, q, qd, qdd, parameters: vec![], is_generic: false, payload: vec![] }
    }

    /// The same with a symbol for each number that is not 0 of a link, XX1 …, with that value.
    #[must_use]
    pub fn with_names(mut self) -> Self {
        let mut names = Names { parameters: std::mem::take(&mut self.parameters) };
        for (k, link) in self.dynamics.links.iter_mut().enumerate() {
            let given = link.body.parameters();
            link.body = Body::of(std::array::from_fn(|p| match given[p].is_zero() {
                true => given[p],
                false => names.symbol(&format!("{}{}", PARAMETERS[p], k + 1), Some(given[p])),
            }));
        }
        Formulas { parameters: names.parameters, ..self }
    }

    /// The model of a tree of rows, as [`Formulas::named`] has that of a description.
    pub fn of_rows(tree: &RowTree) -> Self {
        let q = by_number(&tree.rows);
        let links: Vec<_> = tree
            .rows
            .iter()
            .map(|r| link_of(Convention::Khalil, r, &q))
            .zip(tree.after.iter().copied())
            .collect();
        let d = tree.all_rows();
        let (bodies, drives) = weights(&d.rows, &q);
        let dynamics = Dynamics::of_rows(tree.base, &links, &bodies, drives, d.gravity_or_default());
        Self::of_links(&d, dynamics, q, true)
    }

    fn with(d: &Description, is_named: bool) -> Self {
        let robot = Robot::symbolic(d);
        let q: Vec<Symbol> = d.variables().iter().map(|v| v.symbol).collect();
        let (bodies, drives) = weights(&d.rows, &q);
        let dynamics = Dynamics::new(&robot, &bodies, drives, d.gravity_or_default());
        Self::of_links(d, dynamics, q, is_named)
    }

    /// With names for the numbers of links where they are wanted, or where nothing is said of masses.
    fn of_links(d: &Description, mut dynamics: Dynamics<Expr>, q: Vec<Symbol>, is_named: bool) -> Self {
        let mut names = Names { parameters: d.parameters.clone() };
        let is_generic = !d.has_masses();
        let lengths = of_table(d);
        for (k, link) in dynamics.links.iter_mut().enumerate() {
            let given = link.body.parameters();
            let is_in_numbers =
                is_named && given.iter().flat_map(|e| e.symbols()).all(|s| lengths.contains(&s));
            let all: [Expr; 10] = std::array::from_fn(|p| {
                let mut named = |value| names.symbol(&format!("{}{}", PARAMETERS[p], k + 1), value);
                match (is_generic, given[p].is_zero()) {
                    (true, _) => named(None),
                    (false, true) => given[p],
                    (false, false) if is_in_numbers => named(valued(d, given[p])),
                    (false, false) => given[p],
                }
            });
            link.body = Body::of(all);
        }
        let gravity = &mut dynamics.gravity;
        let along: Vec<usize> = (0..3).filter(|&i| !gravity[i].is_zero()).collect();
        if let &[i] = &along[..]
            && let Some(value) = gravity[i].as_number()
        {
            let g = names.symbol("g", Some(Expr::from(value.abs())));
            gravity.0[i] = if value.is_negative() { -g } else { g };
        }
        let rates = |prefix: &str| -> Vec<Symbol> {
            let behind = |s: &Symbol| s.name().trim_start_matches('q').to_string();
            let free = |mut name: String| {
                while names.parameters.iter().any(|p| *p.symbol.name() == *name) {
                    name.push('_');
                }
                Symbol::new(&name)
            };
            q.iter().map(|s| free(format!("{prefix}{}", behind(s)))).collect()
        };
        let (qd, qdd) = (rates("qd"), rates("qdd"));
        Formulas { dynamics, qd, qdd, q, parameters: names.parameters, is_generic, payload: vec![] }
    }

    /// The same with a body fixed to the tool: its numbers about the tool's origin along the tool's axes are parameters, XXL … ML.
    #[must_use]
    pub fn carrying(mut self) -> Self {
        let mut names = Names { parameters: std::mem::take(&mut self.parameters) };
        let numbers = PARAMETERS.map(|letters| names.symbol(&format!("{letters}L"), None));
        let payload = numbers.iter().filter_map(|e| e.as_symbol()).collect();
        let dynamics = self.dynamics.carrying(&Body::of(numbers));
        Formulas { dynamics, parameters: names.parameters, payload, ..self }
    }

    /// The variables as formulas: q, q̇, q̈.
    pub fn state(&self) -> [Vec<Expr>; 3] {
        [&self.q, &self.qd, &self.qdd].map(|all| all.iter().map(|&s| s.into()).collect())
    }

    /// The value of a parameter.
    pub fn value(&self, symbol: Symbol) -> Option<f64> {
        self.parameters.iter().find(|p| p.symbol == symbol)?.number()
    }
}

/// The variables of rows, those of one letter by their numbers: q1 first, wherever its row stands.
pub(super) fn by_number(rows: &[Row]) -> Vec<Symbol> {
    let mut all: Vec<Symbol> = rows.iter().filter_map(|r| r.variable).map(|v| v.symbol).collect();
    let number = |s: &Symbol| s.name().trim_start_matches(char::is_alphabetic).parse::<usize>().ok();
    all.sort_by_key(number);
    all
}

/// The bodies of rows in their frames, and the drives of these variables.
fn weights(rows: &[Row], variables: &[Symbol]) -> (Vec<Body<Expr>>, Vec<Drive<Expr>>) {
    let bodies = rows.iter().map(|row| row.body().unwrap_or_else(Body::nothing)).collect();
    let own = |s: &Symbol| rows.iter().find(|r| r.variable.is_some_and(|v| v.symbol == *s));
    (bodies, variables.iter().map(|s| own(s).map_or_else(Drive::nothing, Row::drive)).collect())
}

/// The symbols of a table.
fn of_table(d: &Description) -> BTreeSet<Symbol> {
    let rows = d.rows.iter().flat_map(|r| [r.theta, r.d, r.a, r.alpha, r.gamma, r.b]);
    rows.chain(d.tool.matrix().into_iter().flatten()).flat_map(|e| e.symbols()).collect()
}

/// What a formula is with the values of a description's parameters, if all in it have one.
fn valued(d: &Description, e: Expr) -> Option<Expr> {
    let value = e.substitute(|s| d.parameters.iter().find(|p| p.symbol == s)?.value);
    value.symbols().is_empty().then_some(value)
}

/// The parameters so far.
struct Names {
    parameters: Vec<Parameter>,
}

impl Names {
    /// A further parameter; its name has an underscore behind it where another has it.
    fn symbol(&mut self, name: &str, value: Option<Expr>) -> Expr {
        let mut name = name.to_string();
        while self.parameters.iter().any(|p| *p.symbol.name() == *name) {
            name.push('_');
        }
        let symbol = Symbol::new(&name);
        self.parameters.push(Parameter { symbol, value });
        symbol.into()
    }
}

impl Row {
    fn drive(&self) -> Drive<Expr> {
        let [rotor, viscous, coulomb] =
            [self.rotor, self.viscous, self.coulomb].map(|e| e.unwrap_or_else(|| Expr::int(0)));
        Drive { rotor, viscous, coulomb }
    }
}

impl Dynamics<f64> {
    /// The model of a description in numbers.
    ///
    /// # Errors
    /// If the description says nothing of masses, a mass is negative, or a parameter has no value.
    pub fn numeric(d: &Description) -> Result<Self, NoNumbers> {
        if !d.has_masses() {
            return Err(NoNumbers::NoMasses);
        }
        let robot = Robot::numeric(d).map_err(NoNumbers::Missing)?;
        let variables: Vec<Symbol> = d.variables().iter().map(|v| v.symbol).collect();
        let Weights { bodies, drives, gravity } = weights_of(d, &variables)?;
        Ok(Dynamics::new(&robot, &bodies, drives, gravity))
    }

    /// The same of a tree of rows, of which one may carry a body that is given in its frame.
    ///
    /// # Errors
    /// As of [`Dynamics::numeric`].
    pub fn numeric_of_rows(tree: &RowTree, payload: Option<(usize, Body<f64>)>) -> Result<Self, NoNumbers> {
        let d = tree.all_rows();
        if !d.has_masses() {
            return Err(NoNumbers::NoMasses);
        }
        // What has no value is said.
        Robot::numeric(&d).map_err(NoNumbers::Missing)?;
        let q = by_number(&tree.rows);
        let mut weights = weights_of(&d, &q)?;
        if let Some((row, payload)) = payload {
            weights.bodies[row] = weights.bodies[row] + payload;
        }
        Ok(Dynamics::of_tree(tree, &q, weights, |s| d.value(s)))
    }

    /// The rows of a tree in numbers, moved by these variables. Bodies behind those of its rows are left.
    pub(super) fn of_tree(
        tree: &RowTree,
        variables: &[Symbol],
        Weights { bodies, drives, gravity }: Weights,
        value: impl Fn(Symbol) -> Option<f64>,
    ) -> Self {
        let number = |e: Expr| e.eval(&value).unwrap_or(f64::NAN);
        let link = |r| link_of(Convention::Khalil, r, variables).in_numbers(number);
        let links: Vec<_> = tree.rows.iter().map(link).zip(tree.after.iter().copied()).collect();
        Dynamics::of_rows(tree.base.map(number), &links, &bodies[..links.len()], drives, gravity)
    }
}

/// What rows weigh, in numbers.
pub(super) struct Weights {
    /// The bodies of the rows, each in its frame.
    pub bodies: Vec<Body<f64>>,
    /// The drives of the variables.
    pub drives: Vec<Drive<f64>>,
    /// The acceleration of gravity in the base.
    pub gravity: Vector<f64>,
}

/// What the rows weigh, with the drives of these variables.
pub(super) fn weights_of(d: &Description, variables: &[Symbol]) -> Result<Weights, NoNumbers> {
    let mut missing: Vec<String> = vec![];
    let mut number = |e: Expr| {
        e.eval(|s| d.value(s)).unwrap_or_else(|s| {
            let name = s.name().to_string();
            if !missing.contains(&name) {
                missing.push(name);
            }
            0.0
        })
    };
    let (bodies, drives) = weights(&d.rows, variables);
    let bodies = bodies.iter().map(|b| b.map(&mut number)).collect();
    let drives = drives
        .iter()
        .map(|of| Drive { rotor: number(of.rotor), viscous: number(of.viscous), coulomb: number(of.coulomb) })
        .collect();
    let gravity = d.gravity_or_default().map(&mut number);
    d.no_negative_mass()?;
    if missing.is_empty() {
        Ok(Weights { bodies, drives, gravity })
    } else {
        Err(NoNumbers::Missing(MissingValue { parameters: missing }))
    }
}
