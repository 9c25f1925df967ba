//! The problem's normal form: Z₁ C₁ Z₂ … Cₙ₋₁ Zₙ = U, with base and tool on the other side.
//!
//! Zᵢ turns about z or slides along it; Cᵢ is constant. A constant displacement along a joint's axis commutes with the
//! joint, so those of parallel axes are brought to one place, at the outer ends of the chain into base and tool.
//! Parallel turning axes form a *group* with potentials φ₀ = 0, φₖ = φₖ₋₁ ± θₖ, the *nodes*: the angles that can occur in
//! an equation are the differences of potentials. Of axes that [follow others](super::drivers) some come back to a
//! potential that was there: it is one node, and angles that are the same whatever the joints are one unknown.

use super::algebra::{Algebra, Column, Kind, Matrix, identity};
use super::drivers::Drivers;
use super::known::Unknown;
use super::screws::{drivers, follow, gather, screws};
use crate::description::{Description, JointKind};
use crate::geometry::{Rotation, Transform, parallel};
use crate::mechanism::{Affine, Robot};
use crate::space::Periods;
use denavit_symbolic::poly::Poly;
use denavit_symbolic::{Expr, Rational, Ring, Symbol, readable};

/// A moving axis of the normal form.
#[derive(Clone, Debug)]
pub struct Axis {
    /// Turning or sliding.
    pub motion: Motion,
    /// Its angle or displacement in the joint variables, constant quarter turns left aside.
    pub value: Expr,
    /// The same as a linear form.
    pub form: Affine<Expr>,
    /// The row of the table that moves it, from 0.
    pub row: usize,
}

/// How an axis moves.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Motion {
    /// From one potential of a group to the next.
    Turn {
        /// The group, from 0.
        group: usize,
        /// The potential before it.
        from: usize,
        /// The potential behind it.
        to: usize,
        /// True if it turns against the group's first axis.
        reversed: bool,
    },
    /// Along z.
    Slide,
}

/// What stands between two cuts.
#[derive(Clone, Debug)]
pub enum Element {
    /// A constant rotation and displacement.
    Constant(Box<(Matrix, Column)>),
    /// A moving axis.
    Axis(usize),
}

/// A difference of potentials of a group, `from < to`.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, PartialOrd, Ord)]
pub struct Difference {
    /// The group.
    pub group: usize,
    /// The smaller node.
    pub from: usize,
    /// The larger node.
    pub to: usize,
}

impl Difference {
    /// From the smaller node to the larger.
    pub fn forwards(self) -> Self {
        if self.from <= self.to { self } else { self.backwards() }
    }

    /// The negative.
    pub fn backwards(self) -> Self {
        Difference { from: self.to, to: self.from, ..self }
    }
}

/// The normal form.
#[derive(Debug)]
pub struct NormalChain {
    /// The joint variables, in the order of the robot.
    pub variables: Vec<Symbol>,
    /// The robot's parameters that occur.
    pub parameters: Vec<Symbol>,
    /// The moving axes, base first.
    pub axes: Vec<Axis>,
    /// What is multiplied, base first; begins and ends with an axis (unless only part of the pose is given).
    pub elements: Vec<Element>,
    /// For each group, how many nodes it has beside the first.
    pub groups: Vec<usize>,
    /// What was brought to the other side in front: U = base⁻¹ · T · tool⁻¹.
    pub base: Transform<Expr>,
    /// What was brought to the other side behind.
    pub tool: Transform<Expr>,
    /// Names of the entries of U, row-major 3×4.
    pub pose: [Symbol; 12],
    /// All differences of potentials, in the order of their numbers.
    pub differences: Vec<Difference>,
    /// For each difference its factors of the axes that drive; nothing else makes two angles the same.
    pub forms: Vec<Vec<i64>>,
    /// For each difference the first that is the same angle, and whether it is its negative.
    same: Vec<(usize, bool)>,
    /// The algebra of all equations.
    pub algebra: Algebra,
    /// Which axes the others follow. For each joint variable q = Σ factor·(value of the axis − offset) by `inverse`.
    pub drivers: Drivers,
    /// For each joint variable, whether a whole turn of it brings all links back.
    pub goes_round: Vec<bool>,
}

/// Why a robot has no normal form.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Unsuitable {
    /// A row turns and slides with one variable.
    Helical(usize),
    /// The joint variables are not determined by the angles and displacements of as many rows, or other rows do not turn
    /// by whole multiples of those.
    Coupling,
    /// There is no joint.
    NoJoint,
    /// There are so many joints that the products of the chain would not end.
    TooLong(usize),
}

/// Terms of an element of a product that is worked with.
const LONGEST: usize = 3_000;
/// Joints of the longest chain that is derived.
pub const MAX_AXES: usize = 8;

impl std::fmt::Display for Unsuitable {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Unsuitable::Helical(row) => write!(f, "row {row} turns and slides at once (a helical joint)"),
            Unsuitable::Coupling => f.write_str(
                "the angles of the rows are no sums of whole multiples of as many of them as there are joint variables",
            ),
            Unsuitable::NoJoint => f.write_str("the robot has no joint"),
            Unsuitable::TooLong(n) => {
                write!(f, "the robot has {n} joints; closed forms are derived for up to {MAX_AXES}")
            }
        }
    }
}

impl std::error::Error for Unsuitable {}

/// How much of the tool stays in the chain.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum End {
    /// The whole pose is given: the tool is brought to the other side.
    Pose,
    /// Only the tool's position (and direction) is given: its displacement belongs to the chain.
    Point,
}

impl NormalChain {
    /// The normal form of a robot. Parameters with the value 0, and angles with a value, are taken at their values.
    ///
    /// # Errors
    /// See [`Unsuitable`].
    pub fn new(description: &Description, end: End) -> Result<Self, Unsuitable> {
        let robot = Robot::symbolic(description);
        let variables: Vec<Symbol> = description.variables().iter().map(|v| v.symbol).collect();
        let (mut screws, tail) = screws(&robot)?;
        if screws.is_empty() {
            return Err(Unsuitable::NoJoint);
        }
        if screws.len() > MAX_AXES {
            return Err(Unsuitable::TooLong(screws.len()));
        }
        let turning: Vec<bool> = screws.iter().map(|s| s.kind == JointKind::Revolute).collect();
        let drivers = drivers(&screws, &turning, variables.len()).ok_or(Unsuitable::Coupling)?;
        let mut tail = follow(&mut screws, tail, &drivers).map(readable::settled);
        screws.iter_mut().for_each(|s| s.before = s.before.map(readable::settled));

        // Groups of parallel axes, and displacements along them to one place.
        let (mut motions, mut nodes): (Vec<Motion>, Vec<Vec<Vec<i64>>>) = (vec![], vec![]);
        let mut at: Vec<usize> = vec![];
        let mut orientation: Option<(usize, bool, Rotation<Expr>)> = None;
        for (k, screw) in screws.iter().enumerate() {
            let turn =
                orientation.take().map(|(g, flipped, since)| (g, flipped, since * screw.before.rotation));
            if !turning[k] {
                orientation = turn;
                motions.push(Motion::Slide);
                continue;
            }
            let parallel = turn.and_then(|(g, flipped, since)| {
                Some((g, flipped != parallel::reversed(&since.map(readable::settled))?))
            });
            let (group, reversed) = parallel.unwrap_or_else(|| {
                nodes.push(vec![vec![0; drivers.axes.len()]]);
                at.push(0);
                (nodes.len() - 1, false)
            });
            let from = at[group];
            let own = drivers.factors[k].iter().map(|x| x.to_integer().unwrap_or(0));
            let sign = if reversed { -1 } else { 1 };
            let reached: Vec<i64> = nodes[group][from].iter().zip(own).map(|(x, y)| x + sign * y).collect();
            let to = nodes[group].iter().position(|n| *n == reached).unwrap_or(nodes[group].len());
            if to == nodes[group].len() {
                nodes[group].push(reached);
            }
            at[group] = to;
            motions.push(Motion::Turn { group, from, to, reversed });
            orientation = Some((group, reversed, Rotation::identity()));
        }
        gather(&mut screws, &mut tail, &turning);

        let base = screws[0].before;
        screws[0].before = Transform::identity();
        let (last, tool) = match end {
            End::Pose => (Transform::identity(), tail),
            End::Point => (tail, Transform::identity()),
        };

        let constants: Vec<Transform<Expr>> =
            screws.iter().map(|s| s.before).chain([last]).map(|x| x.map(readable::settled)).collect();
        let entries: Vec<Expr> = constants
            .iter()
            .flat_map(|x| x.rotation.rows().into_iter().flatten().chain(x.translation.0))
            .collect();
        let mut ring = Ring::new(&entries, &[]);
        let mut algebra = Algebra::default();
        let parameters = parameters(description, &entries, &base, &tool);
        let pose = pose_names(&variables, &parameters);
        for (k, s) in pose.iter().enumerate() {
            algebra.atom(Kind::Pose(k), || (*s).into());
        }
        let axes: Vec<Axis> = screws
            .iter()
            .zip(&motions)
            .map(|(s, &motion)| Axis {
                motion,
                value: value(&s.form, &variables),
                form: s.form.clone(),
                row: s.row,
            })
            .collect();
        let mut elements = vec![];
        for (k, x) in constants.iter().enumerate() {
            if *x != Transform::identity() {
                let rotation = x.rotation.rows().map(|row| row.map(|e| algebra.constant(&mut ring, e)));
                let translation = x.translation.0.map(|e| algebra.constant(&mut ring, e));
                elements.push(Element::Constant(Box::new((rotation, translation))));
            }
            if k < axes.len() {
                elements.push(Element::Axis(k));
            }
        }
        let groups: Vec<usize> = nodes.iter().map(|n| n.len() - 1).collect();
        let mut differences = vec![];
        for (group, &size) in groups.iter().enumerate() {
            for from in 0..=size {
                differences.extend((from + 1..=size).map(|to| Difference { group, from, to }));
            }
        }
        let form = |d: &Difference| -> Vec<i64> {
            let of = &nodes[d.group];
            of[d.to].iter().zip(&of[d.from]).map(|(x, y)| x - y).collect()
        };
        let forms: Vec<Vec<i64>> = differences.iter().map(form).collect();
        let same = (0..forms.len()).map(|n| first_like(&forms, n)).collect();
        let turning = Periods::of(description);
        let mut chain = NormalChain {
            goes_round: (0..variables.len()).map(|j| turning.goes_round(j)).collect(),
            forms,
            same,
            drivers,
            variables,
            parameters,
            axes,
            elements,
            groups,
            base,
            tool,
            pose,
            differences,
            algebra,
        };
        for number in 0..chain.differences.len() {
            if chain.same[number].0 == number {
                let expr = chain.angle(chain.differences[number]);
                chain.algebra.pair(number, expr);
            }
        }
        for k in 0..chain.axes.len() {
            if chain.axes[k].motion == Motion::Slide && chain.drivers.drives(k) {
                let e = chain.axes[k].value;
                chain.algebra.atom(Kind::Slide(k), || e);
            }
        }
        Ok(chain)
    }

    /// True if a joint variable is an angle.
    pub fn is_angle(&self, variable: usize) -> bool {
        self.drivers.inverse[variable].iter().any(|f| self.axes[f.0].motion != Motion::Slide)
    }

    /// Whether some axes follow others.
    pub fn has_followers(&self) -> bool {
        self.axes.len() > self.drivers.axes.len()
    }

    /// The axes that joint variables (from 0) determine.
    pub fn axes_of(&self, given: &[usize]) -> Vec<usize> {
        let is_determined = |&k: &usize| self.axes[k].form.terms.iter().all(|t| given.contains(&t.0));
        (0..self.axes.len()).filter(is_determined).collect()
    }

    /// The number of a difference.
    pub fn number(&self, d: Difference) -> usize {
        self.differences.iter().position(|&x| x == d).expect("every difference has a number")
    }

    /// The factors of a difference of the axes that drive; `from` may be the larger node.
    pub fn form(&self, d: Difference) -> Vec<i64> {
        if d.from == d.to {
            return vec![0; self.drivers.axes.len()];
        }
        let form = &self.forms[self.number(d.forwards())];
        if d.from < d.to { form.clone() } else { form.iter().map(|x| -x).collect() }
    }

    /// The first difference that is the same angle, or its negative.
    pub fn first_of(&self, d: Difference) -> Difference {
        self.differences[self.same[self.number(d)].0]
    }

    /// Whether an axis moves with an unknown, all else held: it is among its axes, or follows one of them.
    pub fn moves_with(&self, axis: usize, x: Unknown) -> bool {
        let own = &self.drivers.factors[axis];
        match x {
            Unknown::Slide(k) => {
                own.iter().zip(&self.drivers.axes).any(|(factor, &d)| d == k && !factor.is_zero())
            }
            Unknown::Angle(d) => own.iter().zip(self.form(d)).any(|(factor, x)| x != 0 && !factor.is_zero()),
        }
    }

    /// All differences that are the same angle, each from and to the nodes for which that is so, not for its negative.
    pub fn all_of(&self, d: Difference) -> impl Iterator<Item = Difference> + '_ {
        let (first, backwards) = self.same[self.number(d)];
        (0..self.differences.len()).filter(move |&n| self.same[n].0 == first).map(move |n| {
            let found = self.differences[n];
            if self.same[n].1 == backwards { found } else { found.backwards() }
        })
    }

    /// The axes whose angles add up to a difference, with signs: those of the shortest way along the chain.
    pub fn axes_between(&self, d: Difference) -> Vec<(usize, bool)> {
        let of: Vec<(usize, usize, usize, bool)> = (0..self.axes.len())
            .filter_map(|k| match self.axes[k].motion {
                Motion::Turn { group, from, to, reversed } if group == d.group => {
                    Some((k, from, to, reversed))
                }
                _ => None,
            })
            .collect();
        let way = |start: usize, end: usize| {
            let all = (0..of.len()).flat_map(|i| (i..of.len()).map(move |j| (i, j)));
            all.filter(|&(i, j)| of[i].1 == start && of[j].2 == end).min_by_key(|(i, j)| j - i)
        };
        let forwards = way(d.from, d.to).map(|way| (way, false));
        let found = forwards.or_else(|| way(d.to, d.from).map(|way| (way, true)));
        let signed = |((i, j), backwards): ((usize, usize), bool)| {
            of[i..=j].iter().map(|&(k, _, _, reversed)| (k, reversed != backwards)).collect()
        };
        found.map_or(vec![], signed)
    }

    /// A difference of potentials as a sum of the rows' angles.
    pub fn angle(&self, d: Difference) -> Expr {
        let mut sum = Expr::int(0);
        for (k, negative) in self.axes_between(d) {
            let value = self.axes[k].value;
            sum = if negative { sum - value } else { sum + value };
        }
        denavit_symbolic::Angle::of(sum).to_expr()
    }

    /// True if all that turns the hand turns it about one direction: the axes between come back to where they were.
    pub fn turns_about_one_direction(&self) -> bool {
        let end = |group: usize| {
            let of = |a: &Axis| match a.motion {
                Motion::Turn { group: g, to, .. } if g == group => Some(to),
                _ => None,
            };
            self.axes.iter().rev().find_map(of)
        };
        // Of a group that turns, constants between its axes keep their direction; one that does not is a constant.
        let (mut since, mut turning) = (identity(), None);
        for element in &self.elements {
            match element {
                Element::Constant(constant) => since = self.algebra.product(&since, &constant.0),
                Element::Axis(k) => {
                    let Motion::Turn { group, .. } = self.axes[*k].motion else { continue };
                    if turning == Some(group) || end(group) == Some(0) {
                        continue;
                    }
                    if turning.is_some() && !(since[0][2].is_zero() && since[1][2].is_zero()) {
                        return false;
                    }
                    (since, turning) = (identity(), Some(group));
                }
            }
        }
        turning.is_some()
    }

    /// Cosine and sine of φ_to − φ_from, whichever is larger.
    pub fn pair(&self, group: usize, from: usize, to: usize) -> (Poly, Poly) {
        if from == to {
            return (Poly::one(), Poly::zero());
        }
        let (number, opposite) = self.same[self.number(Difference { group, from, to }.forwards())];
        let atom = |kind| Poly::atom(self.algebra.find(kind).expect("every angle has atoms"));
        let (c, s) = (atom(Kind::Cos(number)), atom(Kind::Sin(number)));
        if (from < to) != opposite { (c, s) } else { (c, s.scaled(&-Rational::ONE)) }
    }

    /// The displacement of an axis by those of the axes that drive.
    pub fn slide(&self, axis: usize) -> Poly {
        let of = |(&k, x): (&usize, &Rational)| {
            let atom = self.algebra.find(Kind::Slide(k))?;
            (!x.is_zero()).then(|| Poly::atom(atom).scaled(x))
        };
        let all = self.drivers.axes.iter().zip(&self.drivers.factors[axis]);
        all.filter_map(of).fold(Poly::zero(), |sum, x| sum.plus(&x))
    }

    /// The product of elements `from..to` for all `to`, as rotation and position, up to the first that is too long to
    /// work with; parallel axes are merged before anything is multiplied.
    pub fn products_from(&self, from: usize) -> Vec<(Matrix, Column)> {
        let a = &self.algebra;
        let mut before = identity();
        // The group under way: number, node before its first axis here, whether that axis is reversed, last node.
        let mut group: Option<(usize, usize, bool, usize)> = None;
        let mut since = identity();
        let mut position: Column = std::array::from_fn(|_| Poly::zero());
        let turn = |group: Option<(usize, usize, bool, usize)>| {
            group.map(|(g, start, reversed, end)| {
                let (c, s) = self.pair(g, start, end);
                let s = if reversed { s.scaled(&-Rational::ONE) } else { s };
                about_z(&c, &s)
            })
        };
        let whole = |before: &Matrix, group: Option<(usize, usize, bool, usize)>, since: &Matrix| {
            let turned = turn(group).map_or_else(|| before.clone(), |z| a.product(before, &z));
            a.product(&turned, since)
        };
        let mut found = vec![(identity(), position.clone())];
        for element in &self.elements[from..] {
            match element {
                Element::Constant(constant) => {
                    let (r, p) = &**constant;
                    if p.iter().any(|x| !x.is_zero()) {
                        let shift = a.apply(&since, p);
                        let shift = turn(group).map_or_else(|| shift.clone(), |z| a.apply(&z, &shift));
                        position = super::algebra::sum(&position, &a.apply(&before, &shift));
                    }
                    since = a.product(&since, r);
                }
                Element::Axis(k) => match self.axes[*k].motion {
                    Motion::Slide => {
                        let r = self.slide(*k);
                        let z = whole(&before, group, &since);
                        let along: Column = std::array::from_fn(|i| a.times(&z[i][2], &r));
                        position = super::algebra::sum(&position, &along);
                    }
                    Motion::Turn { group: g, from, to, reversed } => match &mut group {
                        Some((current, _, _, end)) if *current == g => *end = to,
                        _ => {
                            before = whole(&before, group, &since);
                            since = identity();
                            group = Some((g, from, reversed, to));
                        }
                    },
                },
            }
            let rotation = whole(&before, group, &since);
            if rotation.iter().flatten().chain(&position).any(|p| p.terms().len() > LONGEST) {
                break;
            }
            found.push((rotation, position.clone()));
        }
        found
    }
}

/// The first form that is the same or the negative of one, and whether it is that.
fn first_like(forms: &[Vec<i64>], n: usize) -> (usize, bool) {
    let is_negative = |m: usize| forms[m].iter().zip(&forms[n]).all(|(x, y)| *x == -y);
    let found = (0..n).find(|&m| forms[m] == forms[n] || is_negative(m)).unwrap_or(n);
    (found, forms[found] != forms[n])
}

fn about_z(c: &Poly, s: &Poly) -> Matrix {
    let (o, l) = (Poly::zero(), Poly::one());
    [[c.clone(), s.scaled(&-Rational::ONE), o.clone()], [s.clone(), c.clone(), o.clone()], [o.clone(), o, l]]
}

/// The value of an axis in the joint variables.
fn value(form: &Affine<Expr>, variables: &[Symbol]) -> Expr {
    let terms = form.terms.iter().map(|&(j, k)| k * Expr::from(variables[j]));
    let sum = terms.reduce(|a, b| a + b).unwrap_or(Expr::int(0));
    if form.offset.is_zero() { sum } else { sum + form.offset }
}

/// The parameters that occur in the chain, in the order of the description.
fn parameters(
    description: &Description,
    entries: &[Expr],
    base: &Transform<Expr>,
    tool: &Transform<Expr>,
) -> Vec<Symbol> {
    let robot = Robot::symbolic(description);
    let mut used: Vec<Symbol> = entries.iter().flat_map(|e| e.symbols()).collect();
    for x in [base, tool] {
        let of = x.rotation.rows().into_iter().flatten().chain(x.translation.0);
        used.extend(of.flat_map(|e| e.symbols()));
    }
    for link in &robot.links {
        used.extend(link.theta.offset.symbols());
        used.extend(link.d.offset.symbols());
    }
    let mut found: Vec<Symbol> =
        description.parameters.iter().map(|p| p.symbol).filter(|s| used.contains(s)).collect();
    let variables: Vec<Symbol> = description.variables().iter().map(|v| v.symbol).collect();
    for s in used {
        if !found.contains(&s) && !variables.contains(&s) {
            found.push(s);
        }
    }
    found
}

/// Names of the entries of the pose: columns n, o, a and the position p, unless the robot uses one of them.
fn pose_names(variables: &[Symbol], parameters: &[Symbol]) -> [Symbol; 12] {
    const COLUMNS: [&str; 4] = ["n", "o", "a", "p"];
    const ROWS: [&str; 3] = ["x", "y", "z"];
    let usual: [Symbol; 12] =
        std::array::from_fn(|k| Symbol::new(&format!("{}{}", COLUMNS[k % 4], ROWS[k / 4])));
    if usual.iter().any(|s| variables.contains(s) || parameters.contains(s)) {
        std::array::from_fn(|k| Symbol::new(&format!("u{}{}", k / 4 + 1, k % 4 + 1)))
    } else {
        usual
    }
}
