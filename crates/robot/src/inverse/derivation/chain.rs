//! The problem's normal form: Z₁ C₁ Z₂ … Cₙ₋₁ Zₙ = U, with base and tool on the other side.
//!
//! Zᵢ turns about z or slides along it; Cᵢ is constant. A constant displacement along a joint's axis commutes with the
//! joint, so those of parallel axes are brought to one place, at the outer ends of the chain into base and tool.
//! Parallel turning axes form a *group* with potentials φ₀ = 0, φₖ = φₖ₋₁ ± θₖ: the angles that can occur in an
//! equation are the differences of potentials.

use super::algebra::{Algebra, Column, Kind, Matrix, identity};
use crate::description::{Description, JointKind};
use crate::geometry::{Rotation, Transform, Vector, parallel};
use crate::mechanism::{Affine, Lengths, Link, MovingAxes, MovingAxis, Robot};
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
        /// The potential behind it; `node − 1` is the one before.
        node: usize,
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
    /// For each group, how many axes it has.
    pub groups: Vec<usize>,
    /// What was brought to the other side in front: U = base⁻¹ · T · tool⁻¹.
    pub base: Transform<Expr>,
    /// What was brought to the other side behind.
    pub tool: Transform<Expr>,
    /// Names of the entries of U, row-major 3×4.
    pub pose: [Symbol; 12],
    /// All differences of potentials, in the order of their numbers.
    pub differences: Vec<Difference>,
    /// The algebra of all equations.
    pub algebra: Algebra,
    /// For each joint variable the axes it is computed from, with factors: q = Σ factor·(value of the axis − offset).
    pub inverse_coupling: Vec<Vec<(usize, Rational)>>,
    /// For each joint variable, whether a whole turn of it brings all links back.
    pub goes_round: Vec<bool>,
}

/// Why a robot has no normal form.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Unsuitable {
    /// A row turns and slides with one variable.
    Helical(usize),
    /// The joint variables are not determined by the angles and displacements of the rows.
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
            Unsuitable::Coupling => {
                f.write_str("the joint variables do not follow from the angles and displacements of the rows")
            }
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

/// An axis with what stands before it, while the chain is built.
struct Screw {
    before: Transform<Expr>,
    form: Affine<Expr>,
    kind: JointKind,
    row: usize,
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
        if screws.len() != variables.len() {
            return Err(Unsuitable::Coupling);
        }
        let mut tail = tail.map(readable::settled);
        screws.iter_mut().for_each(|s| s.before = s.before.map(readable::settled));
        let turning: Vec<bool> = screws.iter().map(|s| s.kind == JointKind::Revolute).collect();

        // Groups of parallel axes, and displacements along them to one place.
        let (mut motions, mut groups) = (vec![], vec![]);
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
                groups.push(0);
                (groups.len() - 1, false)
            });
            groups[group] += 1;
            motions.push(Motion::Turn { group, node: groups[group], reversed });
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
        let mut differences = vec![];
        for (group, &size) in groups.iter().enumerate() {
            for from in 0..=size {
                differences.extend((from + 1..=size).map(|to| Difference { group, from, to }));
            }
        }
        let inverse_coupling = inverse_coupling(&axes, variables.len()).ok_or(Unsuitable::Coupling)?;
        let turning = Periods::of(description);
        let mut chain = NormalChain {
            goes_round: (0..variables.len()).map(|j| turning.goes_round(j)).collect(),
            inverse_coupling,
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
            let expr = chain.angle(chain.differences[number]);
            chain.algebra.pair(number, expr);
        }
        for k in 0..chain.axes.len() {
            if chain.axes[k].motion == Motion::Slide {
                let e = chain.axes[k].value;
                chain.algebra.atom(Kind::Slide(k), || e);
            }
        }
        Ok(chain)
    }

    /// True if a joint variable is an angle.
    pub fn is_angle(&self, variable: usize) -> bool {
        self.inverse_coupling[variable].iter().any(|f| self.axes[f.0].motion != Motion::Slide)
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

    /// A difference of potentials as a sum of the rows' angles.
    pub fn angle(&self, d: Difference) -> Expr {
        let mut sum = Expr::int(0);
        for axis in &self.axes {
            if let Motion::Turn { group, node, reversed } = axis.motion
                && group == d.group
                && (d.from + 1..=d.to).contains(&node)
            {
                sum = if reversed { sum - axis.value } else { sum + axis.value };
            }
        }
        denavit_symbolic::Angle::of(sum).to_expr()
    }

    /// Cosine and sine of φ_to − φ_from, whichever is larger.
    pub fn pair(&self, group: usize, from: usize, to: usize) -> (Poly, Poly) {
        if from == to {
            return (Poly::one(), Poly::zero());
        }
        let number = self.number(Difference { group, from: from.min(to), to: from.max(to) });
        let atom = |kind| Poly::atom(self.algebra.find(kind).expect("every difference has atoms"));
        let (c, s) = (atom(Kind::Cos(number)), atom(Kind::Sin(number)));
        if from < to { (c, s) } else { (c, s.scaled(&-Rational::ONE)) }
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
                        let r = a.find(Kind::Slide(*k)).expect("every slide has an atom");
                        let z = whole(&before, group, &since);
                        let along: Column = std::array::from_fn(|i| a.times(&z[i][2], &Poly::atom(r)));
                        position = super::algebra::sum(&position, &along);
                    }
                    Motion::Turn { group: g, node, reversed } => match &mut group {
                        Some((current, _, _, end)) if *current == g => *end = node,
                        _ => {
                            before = whole(&before, group, &since);
                            since = identity();
                            group = Some((g, node - 1, reversed, node));
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

/// The inverse of the matrix that takes joint variables to axes, by rows without zeros.
fn inverse_coupling(axes: &[Axis], n: usize) -> Option<Vec<Vec<(usize, Rational)>>> {
    let mut matrix: Vec<Vec<Rational>> = vec![];
    for (k, axis) in axes.iter().enumerate() {
        let mut row = vec![Rational::ZERO; 2 * n];
        for &(j, factor) in &axis.form.terms {
            row[j] = factor.as_number()?;
        }
        row[n + k] = Rational::ONE;
        matrix.push(row);
    }
    for j in 0..n {
        let pivot = (j..n).find(|&i| !matrix[i][j].is_zero())?;
        matrix.swap(j, pivot);
        let inverse = matrix[j][j].recip()?;
        matrix[j].iter_mut().for_each(|x| *x = &*x * &inverse);
        for i in (0..n).filter(|&i| i != j) {
            let factor = matrix[i][j].clone();
            let pivot = matrix[j].clone();
            for (x, y) in matrix[i].iter_mut().zip(&pivot) {
                *x = &*x - &(&factor * y);
            }
        }
    }
    let row = |r: &Vec<Rational>| {
        (0..n).filter(|&k| !r[n + k].is_zero()).map(|k| (k, r[n + k].clone())).collect::<Vec<_>>()
    };
    let found: Vec<Vec<(usize, Rational)>> = matrix.iter().map(row).collect();
    let slides = |k: usize| axes[k].motion == Motion::Slide;
    found.iter().all(|f| f.iter().all(|x| slides(x.0)) || f.iter().all(|x| !slides(x.0))).then_some(found)
}

fn about_z(c: &Poly, s: &Poly) -> Matrix {
    let (o, l) = (Poly::zero(), Poly::one());
    [[c.clone(), s.scaled(&-Rational::ONE), o.clone()], [s.clone(), c.clone(), o.clone()], [o.clone(), o, l]]
}

/// The moving axes with the constants before each, and what stands behind the last.
fn screws(robot: &Robot<Expr>) -> Result<(Vec<Screw>, Transform<Expr>), Unsuitable> {
    let turns_by = |l: &Link<Expr>, j: usize| l.theta.terms.iter().any(|t| t.0 == j);
    if let Some(row) = robot.links.iter().position(|l| l.d.terms.iter().any(|t| turns_by(l, t.0))) {
        return Err(Unsuitable::Helical(row + 1));
    }
    let MovingAxes { moving, mut constants } = MovingAxes::new(robot, Lengths::Behind);
    // Quarter turns of an angle and offsets of a displacement are constants.
    for (k, axis) in moving.iter().enumerate() {
        if axis.kind == JointKind::Prismatic {
            constants[k + 1] = axis.at_rest() * constants[k + 1];
        } else {
            let quarters = Rational::new(i64::from(axis.value.quarters), 2);
            constants[k] = constants[k] * Transform::rotation_z(Expr::from(quarters) * Expr::pi());
        }
    }
    let tail = constants.pop().unwrap_or_else(Transform::identity);
    let screw = |(axis, before): (MovingAxis<Expr>, Transform<Expr>)| {
        let mut form = Affine { quarters: 0, ..axis.value };
        if axis.kind == JointKind::Prismatic {
            form.offset = Expr::int(0);
        }
        Screw { before, form, kind: axis.kind, row: axis.row }
    };
    Ok((moving.into_iter().zip(constants).map(screw).collect(), tail))
}

/// Brings constant displacements along axes that stay parallel to one place: those of the first axes into the base,
/// all others behind the last of them.
fn gather(screws: &mut [Screw], tail: &mut Transform<Expr>, turning: &[bool]) {
    let n = screws.len();
    // The constant behind axis k.
    let behind = |screws: &[Screw], tail: &Transform<Expr>, k: usize| {
        if k + 1 < n { screws[k + 1].before } else { *tail }
    };
    let set = |screws: &mut [Screw], tail: &mut Transform<Expr>, k: usize, x: Transform<Expr>| {
        if k + 1 < n { screws[k + 1].before = x } else { *tail = x }
    };
    let parallel = |x: &Transform<Expr>| {
        let z = x.rotation.z();
        z[0].is_zero() && z[1].is_zero()
    };
    // How far the first axes stay parallel.
    let first = (1..n).find(|&k| !parallel(&screws[k].before)).unwrap_or(n);
    for k in (0..first).rev() {
        let x = behind(screws, tail, k);
        let along = x.translation[2];
        if along.is_zero() || oblique(&x) {
            continue;
        }
        let [a, b, _] = x.translation.0;
        let rest = Transform::from_rotation_translation(x.rotation, Vector([a, b, Expr::int(0)]));
        set(screws, tail, k, rest);
        let before = screws[k].before;
        screws[k].before = (before * Transform::translation_z(along)).map(readable::settled);
    }
    for k in first.max(1)..n {
        // Along the axis that follows the constant before axis k.
        let x = screws[k].before;
        let along = readable::settled(x.rotation.z().dot(x.translation));
        if along.is_zero() || oblique(&x) || !turning[k] {
            continue;
        }
        let z = x.rotation.z();
        let rest = x.translation - z.scale(along);
        screws[k].before = Transform::from_rotation_translation(x.rotation, rest).map(readable::settled);
        let after = behind(screws, tail, k);
        set(screws, tail, k, (Transform::translation_z(along) * after).map(readable::settled));
    }
}

/// True if the axes before and behind a constant are neither parallel nor at a right angle.
fn oblique(x: &Transform<Expr>) -> bool {
    let z = x.rotation.z();
    !(z[2].is_zero() || z[0].is_zero() && z[1].is_zero())
}

/// The value of an axis in the joint variables.
fn value(form: &Affine<Expr>, variables: &[Symbol]) -> Expr {
    let terms = form.terms.iter().map(|&(j, k)| k * Expr::from(variables[j]));
    let sum = terms.reduce(|a, b| a + b).unwrap_or(Expr::int(0));
    if form.offset.is_zero() { sum } else { sum + form.offset }
}

/// The description with the values of its angles, and of what is zero, put in.
pub fn settled(description: &Description) -> Description {
    let mut d = description.clone();
    let mut angles: Vec<Symbol> = vec![];
    for row in &d.rows {
        angles.extend(row.alpha.symbols());
        angles.extend(row.gamma.symbols());
        angles.extend(row.theta.symbols());
    }
    let rotations = [d.base, d.tool];
    for x in &rotations {
        x.rotation.rows().iter().flatten().for_each(|e| angles.extend(e.symbols()));
    }
    let known: Vec<(Symbol, Expr)> = d
        .parameters
        .iter()
        .filter_map(|p| Some((p.symbol, p.value?)))
        .filter(|(s, v)| angles.contains(s) || readable::settled(*v).is_zero())
        .collect();
    if known.is_empty() {
        return d;
    }
    let put = |e: Expr| e.substitute(|s| known.iter().find(|k| k.0 == s).map(|k| k.1));
    for row in &mut d.rows {
        row.theta = put(row.theta);
        row.d = put(row.d);
        row.a = put(row.a);
        row.alpha = put(row.alpha);
        row.gamma = put(row.gamma);
        row.b = put(row.b);
    }
    d.base = d.base.map(put);
    d.tool = d.tool.map(put);
    d.parameters.retain(|p| !known.iter().any(|k| k.0 == p.symbol));
    d
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
