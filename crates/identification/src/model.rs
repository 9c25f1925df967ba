//! The torques as a linear function of what is sought: base parameters of the links, rotors, friction, offsets.
//!
//! χ are the ten numbers of each link about the origin of its own frame, β = Bχ the base parameters. As W and B have the same null
//! space, τ = Wχ = W_S (B_S)⁻¹ β for any columns S of B that are independent.

use crate::linear::dot;
use denavit::description::{Description, MissingValue};
use denavit::dynamics::{BaseModel, Drive, Dynamics, Formulas, GRAVITY, OfTree, regressor};
use denavit::geometry::{Body, PARAMETERS, Vector};
use denavit::random::Random;
use denavit::robot::Robot;
use denavit_symbolic::print::{Style, print};
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Expr, Symbol};

/// What besides the links is sought, joint by joint.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Sought {
    /// Inertias of rotors, IA.
    pub rotors: bool,
    /// Viscous friction, FV.
    pub viscous: bool,
    /// Friction of Coulomb, FS.
    pub coulomb: bool,
    /// What is added to the torque at all times.
    pub offsets: bool,
}

impl Default for Sought {
    fn default() -> Self {
        Sought { rotors: false, viscous: true, coulomb: true, offsets: true }
    }
}

/// Which quantity a parameter is, of which joint, from 0.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum What {
    /// A base parameter, by its number.
    Base(usize),
    /// The inertia of a rotor.
    Rotor(usize),
    /// Viscous friction.
    Viscous(usize),
    /// Friction of Coulomb.
    Coulomb(usize),
    /// What is added to the torque.
    Offset(usize),
}

/// What is sought.
#[derive(Clone, PartialEq, Debug)]
pub struct Parameter {
    /// Its name, as `dynamics --symbolic` has it.
    pub name: String,
    /// What it is in the parameters of the links, where others are grouped with it.
    pub grouping: Option<String>,
    /// Which it is.
    pub what: What,
    /// Its unit.
    pub unit: &'static str,
}

/// Why there is no such function.
#[derive(Clone, PartialEq, Debug)]
pub enum NoModel {
    /// Lengths have no values.
    Missing(MissingValue),
    /// Nothing moves.
    NoJoints,
    /// The groupings are not those of this arm in numbers.
    Groupings,
}

impl std::fmt::Display for NoModel {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            NoModel::Missing(missing) => missing.fmt(f),
            NoModel::NoJoints => f.write_str("nothing of it moves"),
            NoModel::Groupings => {
                f.write_str("the base parameters do not have the torques of this arm with its numbers")
            }
        }
    }
}

impl std::error::Error for NoModel {}

/// The torques of an arm, linear in what is sought.
#[derive(Clone, Debug)]
pub struct Model {
    /// The arm without masses, drives and friction.
    pub arm: Dynamics<f64>,
    /// What is sought.
    pub parameters: Vec<Parameter>,
    /// Rotors that are part of other parameters, with these.
    pub absorbed: Vec<(String, String)>,
    /// Whether each joint turns.
    pub turns: Vec<bool>,
    /// B, row by row: the base parameters of the ten numbers of each link.
    pub groupings: Vec<Vec<f64>>,
    /// S, and what multiplies their columns, a row a column of S.
    columns: Vec<usize>,
    mixed: Option<Vec<Vec<f64>>>,
}

impl Model {
    /// Of an arm whose lengths have values.
    ///
    /// # Errors
    /// If one has none, or nothing moves.
    pub fn new(d: &Description, sought: Sought) -> Result<Self, NoModel> {
        let bare = without_masses(d);
        let robot = Robot::numeric(&bare).map_err(NoModel::Missing)?;
        let formulas = Formulas::named(&bare);
        let base = BaseModel::derive(&bare, &formulas);
        let drives = vec![Drive::nothing(); robot.joints];
        let bodies = vec![Body::nothing(); robot.links.len()];
        let arm = Dynamics::new(&robot, &bodies, drives, gravity_of(d));
        let sought = Sought { rotors: sought.rotors || d.rows.iter().any(|r| r.rotor.is_some()), ..sought };
        Self::of(arm, &formulas, &base, sought)
    }

    /// Of all joints of a tree.
    ///
    /// # Errors
    /// If nothing moves.
    pub fn of_tree(exact: &OfTree<Expr>, numbers: &OfTree<f64>, sought: Sought) -> Result<Self, NoModel> {
        let mut formulas = Formulas::of_tree(exact);
        for (k, link) in formulas.dynamics.links.iter_mut().enumerate() {
            let names = PARAMETERS.map(|p| Symbol::new(&format!("{p}{}", k + 1)));
            link.body = Body::of(names.map(Expr::from));
            let parameter = |symbol| denavit::description::Parameter { symbol, value: None };
            formulas.parameters.extend(names.map(parameter));
        }
        let zero = Expr::int(0);
        formulas
            .dynamics
            .drives
            .iter_mut()
            .for_each(|d| *d = Drive { rotor: zero, viscous: zero, coulomb: zero });
        let base = BaseModel::of_tree(&formulas);
        let mut arm = numbers.dynamics.clone();
        arm.links.iter_mut().for_each(|l| l.body = Body::nothing());
        arm.drives.iter_mut().for_each(|d| *d = Drive::nothing());
        Self::of(arm, &formulas, &base, sought)
    }

    fn of(
        arm: Dynamics<f64>,
        formulas: &Formulas,
        base: &BaseModel,
        sought: Sought,
    ) -> Result<Self, NoModel> {
        let n = arm.joints();
        if n == 0 {
            return Err(NoModel::NoJoints);
        }
        let own: Vec<Option<Symbol>> =
            formulas.dynamics.links.iter().flat_map(|l| l.body.parameters()).map(|e| e.as_symbol()).collect();
        let row = |e: Expr| -> Vec<f64> {
            let mut row = vec![0.0; own.len()];
            for s in e.symbols() {
                if let Some(at) = own.iter().position(|o| *o == Some(s)) {
                    // Linear in them: the value with this one alone.
                    let is_own = |o: Symbol| own.contains(&Some(o));
                    let one = |o: Symbol| {
                        if is_own(o) { Some(f64::from(u8::from(o == s))) } else { formulas.value(o) }
                    };
                    row[at] = e.eval(one).unwrap_or(f64::NAN);
                }
            }
            row
        };
        let groupings: Vec<Vec<f64>> = base.parameters.iter().map(|p| row(p.value)).collect();
        let (columns, mixed) = independent(&groupings).ok_or(NoModel::Groupings)?;
        let names = Vocabulary::default();
        let mut turns = vec![true; n];
        for link in &arm.links {
            let slides = link.kind == denavit::description::JointKind::Prismatic;
            link.value.terms.iter().filter(|_| slides).for_each(|t| turns[t.0] = false);
        }
        let mut parameters: Vec<Parameter> = base
            .parameters
            .iter()
            .enumerate()
            .map(|(k, p)| Parameter {
                name: p.symbol.name().to_string(),
                grouping: p.is_grouped.then(|| print(p.value, &names, Style::Ascii)),
                what: What::Base(k),
                unit: unit_of(&groupings[k]),
            })
            .collect();
        let kinds: [Kind; 4] = [
            (sought.rotors, "IA", ["kg m²", "kg"], What::Rotor),
            (sought.viscous, "FV", ["N m s/rad", "N s/m"], What::Viscous),
            (sought.coulomb, "FS", ["N m", "N"], What::Coulomb),
            (sought.offsets, "offset", ["N m", "N"], What::Offset),
        ];
        for (_, letters, units, what) in kinds.into_iter().filter(|k| k.0) {
            parameters.extend((0..n).map(|j| Parameter {
                name: format!("{letters}{}", j + 1),
                grouping: None,
                what: what(j),
                unit: units[usize::from(!turns[j])],
            }));
        }
        let mut model = Model { arm, parameters, absorbed: vec![], turns, groupings, columns, mixed };
        if !model.holds() {
            return Err(NoModel::Groupings);
        }
        model.without_dependent_rotors();
        Ok(model)
    }

    /// How many joints there are.
    pub fn joints(&self) -> usize {
        self.arm.joints()
    }

    /// Appends the rows of a state to `rows`, one a joint, an entry a parameter: the torque is their product with the parameters.
    ///
    /// # Panics
    /// If `q`, `qd` or `qdd` does not have one entry per joint.
    pub fn observe(&self, q: &[f64], qd: &[f64], qdd: &[f64], rows: &mut Vec<Vec<f64>>) {
        let links = 10 * self.arm.links.len();
        for (j, whole) in regressor(&self.arm, q, qd, qdd).into_iter().enumerate() {
            let mut row = Vec::with_capacity(self.parameters.len());
            let chosen = self.columns.iter().map(|&c| whole[c]);
            match &self.mixed {
                None => row.extend(chosen),
                Some(mixed) => {
                    let chosen: Vec<f64> = chosen.collect();
                    let at = |k: usize| chosen.iter().zip(mixed).map(|(c, m)| c * m[k]).sum::<f64>();
                    row.extend((0..self.groupings.len()).map(at));
                }
            }
            let own = |of: usize, x: f64| if of == j { x } else { 0.0 };
            for p in &self.parameters[self.groupings.len()..] {
                row.push(match p.what {
                    What::Base(_) => 0.0,
                    What::Rotor(of) => whole[links + of],
                    What::Viscous(of) => own(of, qd[j]),
                    What::Coulomb(of) => own(of, if qd[j] == 0.0 { 0.0 } else { qd[j].signum() }),
                    What::Offset(of) => own(of, 1.0),
                });
            }
            rows.push(row);
        }
    }

    /// The base parameters of links with these bodies.
    pub fn base_of(&self, bodies: &[Body<f64>]) -> Vec<f64> {
        let all: Vec<f64> = bodies.iter().flat_map(Body::parameters).collect();
        self.groupings.iter().map(|row| dot(row, &all)).collect()
    }

    /// The same arm under another gravity.
    #[must_use]
    pub fn under(&self, gravity: Vector<f64>) -> Self {
        let mut other = self.clone();
        other.arm.gravity = gravity;
        other
    }

    /// A length that says how large the arm is: the sum of those between its axes, metres; 1 where there are none.
    pub fn size(&self) -> f64 {
        let sum: f64 = self.arm.links.iter().skip(1).map(|l| l.before.translation.norm()).sum();
        let tool = self.arm.tool.translation.norm();
        if sum + tool > 1e-6 { sum + tool } else { 1.0 }
    }

    /// Whether the torques in base parameters are those of links at random.
    fn holds(&self) -> bool {
        let (n, mut random) = (self.joints(), Random(77));
        let mut any = |k: usize| -> Vec<f64> { (0..k).map(|_| 2.0 * random.unit() - 1.0).collect() };
        (0..4).all(|_| {
            let [q, qd, qdd] = [any(n), any(n), any(n)];
            let links = any(10 * self.arm.links.len());
            let base: Vec<f64> = self.groupings.iter().map(|row| dot(row, &links)).collect();
            let whole = regressor(&self.arm, &q, &qd, &qdd);
            let mut rows = vec![];
            self.observe(&q, &qd, &qdd, &mut rows);
            whole.iter().zip(&rows).all(|(a, b)| {
                let size: f64 = a.iter().zip(&links).map(|(x, y)| (x * y).abs()).sum();
                (dot(&a[..links.len()], &links) - dot(&b[..base.len()], &base)).abs() <= 1e-9 * (1.0 + size)
            })
        })
    }

    /// Takes out rotors whose columns are sums of those before them: what they add is part of other parameters.
    fn without_dependent_rotors(&mut self) {
        let is_rotor = |p: &Parameter| matches!(p.what, What::Rotor(_));
        if !self.parameters.iter().any(is_rotor) {
            return;
        }
        let (n, mut random) = (self.joints(), Random(78));
        let mut rows: Vec<Vec<f64>> = vec![];
        while rows.len() < 3 * self.parameters.len() {
            let mut any = || -> Vec<f64> { (0..n).map(|_| 4.0 * random.unit() - 2.0).collect() };
            let [q, qd, qdd] = [any(), any(), any()];
            self.observe(&q, &qd, &qdd, &mut rows);
        }
        // Gram and Schmidt's, twice for rounding, with what each is of those before.
        let mut basis: Vec<Vec<f64>> = vec![];
        let mut kept: Vec<usize> = vec![];
        let mut gone: Vec<usize> = vec![];
        for k in 0..self.parameters.len() {
            let mut column: Vec<f64> = rows.iter().map(|r| r[k]).collect();
            let size = dot(&column, &column).sqrt();
            for _ in 0..2 {
                for b in &basis {
                    let part = dot(b, &column);
                    column.iter_mut().zip(b).for_each(|(c, b)| *c -= part * b);
                }
            }
            let left = dot(&column, &column).sqrt();
            if is_rotor(&self.parameters[k]) && left < 1e-8 * size {
                gone.push(k);
                continue;
            }
            basis.push(column.iter().map(|c| c / left.max(f64::MIN_POSITIVE)).collect());
            kept.push(k);
        }
        for &k in &gone {
            let mut normal = crate::linear::Square::zero(kept.len());
            let mut right = vec![0.0; kept.len()];
            for row in &rows {
                let own: Vec<f64> = kept.iter().map(|&i| row[i]).collect();
                normal.add_square_of(&own, 1.0);
                right.iter_mut().zip(&own).for_each(|(r, x)| *r += x * row[k]);
            }
            let of = normal.cholesky().map(|l| l.solved(&right)).unwrap_or_default();
            let into: Vec<&str> = of
                .iter()
                .zip(&kept)
                .filter(|(x, _)| x.abs() > 1e-6)
                .map(|(_, &i)| self.parameters[i].name.as_str())
                .collect();
            self.absorbed.push((self.parameters[k].name.clone(), into.join(", ")));
        }
        let mut k = 0;
        self.parameters.retain(|_| {
            k += 1;
            !gone.contains(&(k - 1))
        });
    }
}

/// A description of which nothing is said of masses and drives.
fn without_masses(d: &Description) -> Description {
    let mut bare = d.clone();
    for row in &mut bare.rows {
        (row.mass, row.com, row.inertia, row.first_moment, row.inertia_at_origin) =
            (None, None, None, None, None);
        (row.rotor, row.viscous, row.coulomb) = (None, None, None);
    }
    bare
}

/// The acceleration of gravity in the base.
fn gravity_of(d: &Description) -> Vector<f64> {
    let (n, over) = GRAVITY;
    let down = Vector([0.0, 0.0, -(n as f64) / over as f64]);
    d.gravity.map_or(down, |g| Vector(g.map(|e| e.eval(|s| d.value(s)).unwrap_or(f64::NAN))))
}

/// The unit of a base parameter: that of the largest of what it is, lengths left aside.
fn unit_of(row: &[f64]) -> &'static str {
    // A mass in a group of inertias comes with squares of lengths: what has 1 before it decides.
    let alone = row.iter().position(|x| (x.abs() - 1.0).abs() < 1e-12);
    let at = alone.or_else(|| row.iter().position(|&x| x != 0.0)).unwrap_or(0);
    match at % 10 {
        0..=5 => "kg m²",
        6..=8 => "kg m",
        _ => "kg",
    }
}

/// Whether it is sought, its letters, its units where a joint turns and slides, what it is.
type Kind = (bool, &'static str, [&'static str; 2], fn(usize) -> What);

/// Columns, and what multiplies them.
type Chosen = (Vec<usize>, Option<Vec<Vec<f64>>>);

/// Columns of B that are independent, those with few entries first, and the inverse of their matrix, a row a column; none where it is 1.
fn independent(b: &[Vec<f64>]) -> Option<Chosen> {
    let rows = b.len();
    let width = b.first().map_or(0, Vec::len);
    if b.iter().flatten().any(|x| !x.is_finite()) {
        return None;
    }
    let count = |c: usize| b.iter().filter(|row| row[c] != 0.0).count();
    // The column of each row that has 1 there and nothing elsewhere.
    let alone = |r: usize| (0..width).find(|&c| b[r][c] == 1.0 && count(c) == 1);
    let found: Option<Vec<usize>> = (0..rows).map(alone).collect();
    if let Some(columns) = found {
        return Some((columns, None));
    }
    let mut order: Vec<usize> = (0..width).filter(|&c| count(c) > 0).collect();
    order.sort_by_key(|&c| count(c));
    // Gauss and Jordan's, a column of B at a time.
    let mut left: Vec<Vec<f64>> = b.to_vec();
    let mut inverse: Vec<Vec<f64>> =
        (0..rows).map(|i| (0..rows).map(|j| f64::from(u8::from(i == j))).collect()).collect();
    let (mut columns, mut pivots) = (vec![], vec![]);
    for c in order {
        let free = (0..rows).filter(|r| !pivots.contains(r));
        let Some(pivot) = free.max_by(|&x, &y| left[x][c].abs().total_cmp(&left[y][c].abs())) else { break };
        if left[pivot][c].abs() < 1e-9 {
            continue;
        }
        let by = 1.0 / left[pivot][c];
        left[pivot].iter_mut().chain(&mut inverse[pivot]).for_each(|x| *x *= by);
        let (own, of) = (left[pivot].clone(), inverse[pivot].clone());
        for r in (0..rows).filter(|&r| r != pivot) {
            let factor = left[r][c];
            if factor != 0.0 {
                left[r].iter_mut().zip(&own).for_each(|(x, y)| *x -= factor * y);
                inverse[r].iter_mut().zip(&of).for_each(|(x, y)| *x -= factor * y);
            }
        }
        columns.push(c);
        pivots.push(pivot);
    }
    (columns.len() == rows).then(|| (columns, Some(pivots.into_iter().map(|p| inverse[p].clone()).collect())))
}
