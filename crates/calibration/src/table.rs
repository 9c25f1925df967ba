//! The arm with its errors as rows of a table, and as a robot file.
//!
//! Between two axes there are six numbers, and Cₖ = Rz(γ)·Tz(b)·Tx(a)·Rx(α)·Rz(θ)·Tz(d) along the common normal: γ and b go to the
//! row of the axis before, θ and d to that of the axis behind. Where the axes are nearly parallel the normal is wherever noise
//! puts it: Rz(γ)·Tx(a)·Rx(α)·Ry(β)·Rz(θ)·Tz(d) instead, β in a fixed row of its own, 90° about z before it and behind it. Base and tool take what is
//! before the first axis and behind the last; θ and d there stay as they were.

use denavit::description::{Convention, Description, MissingValue, Parameter, Row, read_toml, write_toml};
use denavit::geometry::{Rotation, Transform};
use denavit::{Robot, mechanism::Affine};
use denavit_recording::Arm;
use denavit_symbolic::{Expr, Rational};
use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt::Write;

/// Below this sine axes are nearly parallel.
const PARALLEL: f64 = 0.05;
/// Lengths below this are none: the normal has no direction, metres.
const NO_LENGTH: f64 = 1e-9;

/// A number of a row.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Cell {
    /// About z.
    Theta,
    /// Along z.
    D,
    /// Along x.
    A,
    /// About x.
    Alpha,
    /// About y, in a fixed row of its own.
    Beta,
}

impl Cell {
    /// True for angles.
    pub fn is_angle(self) -> bool {
        matches!(self, Cell::Theta | Cell::Alpha | Cell::Beta)
    }

    /// Its letter in a convention.
    pub fn name(self, convention: Convention) -> &'static str {
        match self {
            Cell::Theta => "theta",
            Cell::D => convention.length_z(),
            Cell::A => convention.length_x(),
            Cell::Alpha => "alpha",
            Cell::Beta => "beta",
        }
    }
}

/// The numbers of a row that moves; β stands with the row whose α it follows.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Numbers {
    /// θ, d, a, α, β: radians and metres.
    pub cells: [f64; 5],
}

/// The five cells in their order.
pub const CELLS: [Cell; 5] = [Cell::Theta, Cell::D, Cell::A, Cell::Alpha, Cell::Beta];

/// A table that moves as a description does, with other numbers.
#[derive(Clone, PartialEq, Debug)]
pub struct Table {
    /// A row for each axis.
    pub rows: Vec<Numbers>,
    /// Frame 0 in the base.
    pub base: Transform<f64>,
    /// The tool in the last frame.
    pub tool: Transform<f64>,
}

/// Why there is no table.
#[derive(Clone, PartialEq, Debug)]
pub enum NoTable {
    /// A row turns and slides at once.
    Screw(usize),
    /// The robot does not move.
    NoAxis,
    /// A parameter has no value.
    Missing(MissingValue),
    /// What was written does not read back to the arm: how far it is off.
    NotBack(f64),
}

impl std::fmt::Display for NoTable {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            NoTable::Screw(row) => write!(f, "row {} turns and slides at once", row + 1),
            NoTable::NoAxis => f.write_str("the robot has no joint"),
            NoTable::Missing(missing) => write!(f, "{missing}"),
            NoTable::NotBack(by) => write!(f, "what was written is {by:e} off when it is read back"),
        }
    }
}

impl std::error::Error for NoTable {}

/// The rows of a description that move, with their numbers as they are written.
#[derive(Clone, Debug)]
pub struct Rows<'a> {
    description: &'a Description,
    robot: Robot<f64>,
    /// Which rows move.
    moving: Vec<usize>,
    nominal: Vec<Numbers>,
}

impl<'a> Rows<'a> {
    /// Of a description.
    ///
    /// # Errors
    /// If a row turns and slides at once, nothing moves, or a parameter has no value.
    pub fn new(description: &'a Description) -> Result<Self, NoTable> {
        let robot = Robot::numeric(description).map_err(NoTable::Missing)?;
        let both = |i: &usize| robot.links[*i].turns() && robot.links[*i].slides();
        let moves = |i: &usize| robot.links[*i].turns() || robot.links[*i].slides();
        if let Some(row) = (0..robot.links.len()).find(both) {
            return Err(NoTable::Screw(row));
        }
        let moving: Vec<usize> = (0..robot.links.len()).filter(moves).collect();
        if moving.is_empty() {
            return Err(NoTable::NoAxis);
        }
        let number = |e: Expr| e.eval(|s| description.value(s)).unwrap_or(0.0);
        let nominal = moving
            .iter()
            .map(|&i| {
                let row = &description.rows[i];
                let at_rest = |e: &Affine<f64>| e.offset + f64::from(e.quarters) * FRAC_PI_2;
                let link = &robot.links[i];
                Numbers {
                    cells: [at_rest(&link.theta), link.d.offset, number(row.a), number(row.alpha), 0.0],
                }
            })
            .collect();
        Ok(Rows { description, robot, moving, nominal })
    }

    /// Whether x comes before z in a row.
    fn is_x_first(&self) -> bool {
        self.description.convention != Convention::Standard
    }

    /// The numbers as they are written.
    pub fn nominal(&self) -> &[Numbers] {
        &self.nominal
    }

    /// The row of the description that an axis has, from 0.
    pub fn row_of(&self, axis: usize) -> usize {
        self.moving[axis]
    }

    /// The table of these constants between the axes.
    pub fn table(&self, constants: &[Transform<f64>]) -> Table {
        let n = self.moving.len();
        let nominal = &self.nominal;
        let mut rows: Vec<Numbers> = nominal.clone();
        // θ and d that the constant before an axis leaves to its row; those of the first and the last row stay.
        let mut carried = [nominal[0].cells[0], nominal[0].cells[1]];
        let mut first = carried;
        for k in 1..n {
            let own = nominal[k - 1].cells;
            // α and a between two axes stand in the row of the one or of the other.
            let x_row = if self.is_x_first() { k } else { k - 1 };
            let wanted = nominal[x_row].cells;
            let hint = if k == 1 { own[0] } else { own[0] - carried[0] };
            let part = between(&constants[k], wanted[2], wanted[3], hint);
            if k == 1 {
                first = [own[0] - part.gamma, own[1] - part.b];
            } else {
                rows[k - 1].cells[0] = near(carried[0] + part.gamma, own[0]);
                rows[k - 1].cells[1] = carried[1] + part.b;
            }
            let x = &mut rows[x_row].cells;
            (x[2], x[3], x[4]) = (part.a, near(part.alpha, wanted[3]), part.beta);
            carried = [part.theta, part.d];
        }
        let along_z = |z: [f64; 2]| Transform::rotation_z(z[0]) * Transform::translation_z(z[1]);
        let mut base = constants[0] * along_z(first).inverse();
        let mut behind = along_z([rows[n - 1].cells[0] - carried[0], rows[n - 1].cells[1] - carried[1]]);
        if self.is_x_first() {
            base = base * along_x(&rows[0].cells).inverse();
        } else {
            behind = behind * along_x(&rows[n - 1].cells);
        }
        Table { rows, base, tool: behind.inverse() * constants[n] }
    }

    /// The robot file of a table; joints move more by their gains.
    pub fn text(&self, table: &Table, gains: Option<&[f64]>, source: Option<String>) -> String {
        let d = self.description;
        let n = self.moving.len();
        let variables = d.variables();
        let mut rows = vec![];
        for (k, &i) in self.moving.iter().enumerate() {
            let (old, link) = (&d.rows[i], &self.robot.links[i]);
            let [theta, length, a, alpha, beta] = table.rows[k].cells;
            let turns = link.turns();
            let terms = if turns { &link.theta.terms } else { &link.d.terms };
            let motion = terms.iter().fold(Expr::int(0), |sum, &(j, by)| {
                let by = gains.map_or(by, |g| by * (1.0 + g[j]));
                sum + number(by) * Expr::from(variables[j].symbol)
            });
            // A fixed row before this one where x comes first, behind it else.
            let has_beta = beta != 0.0;
            let after_beta = match (self.is_x_first(), k) {
                (true, _) => has_beta,
                (false, 0) => false,
                (false, _) => table.rows[k - 1].cells[4] != 0.0,
            };
            let theta = angle(theta) - if after_beta { Expr::pi() / Expr::int(2) } else { Expr::int(0) };
            let (theta, length) =
                if turns { (motion + theta, number(length)) } else { (theta, motion + number(length)) };
            let mut row = Row { theta, d: length, gamma: Expr::int(0), b: Expr::int(0), ..old.clone() };
            let quarter = Expr::pi() / Expr::int(2);
            let still = |a: f64, alpha: f64| Row {
                a: number(a),
                alpha: angle(alpha),
                theta: quarter,
                ..Row::still()
            };
            match (self.is_x_first(), has_beta) {
                (true, true) => {
                    rows.push(still(a, alpha));
                    (row.a, row.alpha) = (Expr::int(0), angle(beta));
                }
                _ => (row.a, row.alpha) = (number(a), angle(alpha)),
            }
            rows.push(row);
            if !self.is_x_first() && has_beta && k + 1 < n {
                rows.push(Row { alpha: angle(beta), theta: quarter, ..Row::still() });
            }
        }
        let kept = Description {
            rows,
            base: Transform::identity(),
            tool: Transform::identity(),
            parameters: used(d),
            source,
            ..d.clone()
        };
        let mut text = write_toml(&without_masses(kept, d, &self.moving));
        let mut frames = String::new();
        for (name, frame) in [("base", &table.base), ("tool", &table.tool)] {
            if *frame != Transform::identity() {
                let [x, y, z] = frame.translation.0;
                let [roll, pitch, yaw] = rpy(&frame.rotation);
                let xyz = [x, y, z].map(shown).join(", ");
                let turned =
                    [roll, pitch, yaw].map(|x| format!("\"{} deg\"", shown(x.to_degrees()))).join(", ");
                let _ = write!(frames, "\n[{name}]\nxyz = [{xyz}]\nrpy = [{turned}]\n");
            }
        }
        // Named poses stand behind.
        let at = text.find("\n[poses]").unwrap_or(text.len());
        text.insert_str(at, &frames);
        text
    }

    /// The description that a robot file reads back to, if it is the arm of these constants within rounding at these
    /// configurations.
    ///
    /// # Errors
    /// If it is not.
    pub fn read_back(
        &self,
        text: &str,
        constants: &[Transform<f64>],
        gains: Option<&[f64]>,
        at: &[Vec<f64>],
    ) -> Result<Description, NoTable> {
        let far = NoTable::NotBack(f64::INFINITY);
        let (back, _) = read_toml(text).map_err(|_| far.clone())?;
        let arm = Arm::new(&back.name, &back).map_err(NoTable::Missing)?;
        let own = Arm::new(&self.description.name, self.description).map_err(NoTable::Missing)?;
        if arm.joints() != own.joints() {
            return Err(far);
        }
        let mut worst = 0.0_f64;
        for q in at {
            let moved: Vec<f64> =
                q.iter().enumerate().map(|(j, q)| gains.map_or(*q, |g| (1.0 + g[j]) * q)).collect();
            let (x, y) = (own.pose_with(constants, &moved).matrix(), arm.pose(q).matrix());
            for (a, b) in x.concat().into_iter().zip(y.concat()) {
                worst = worst.max((a - b).abs());
            }
        }
        // Angles of many turns, and lengths of many metres, lose digits.
        if worst < 1e-10 { Ok(back) } else { Err(NoTable::NotBack(worst)) }
    }
}

/// The parameters that stand elsewhere than in the cells of the table.
fn used(d: &Description) -> Vec<Parameter> {
    let of_row = |r: &Row| {
        let limits = r.limits.iter().flatten().copied();
        let rates = r.velocity.into_iter().chain(r.acceleration);
        let masses = r.mass_cells().map(|c| c.1);
        limits.chain(rates).chain(masses).collect::<Vec<Expr>>()
    };
    let others = d.poses.iter().flat_map(|p| p.1.iter().copied()).chain(d.gravity.iter().flatten().copied());
    let all: Vec<Expr> = d.rows.iter().flat_map(of_row).chain(others).collect();
    let is_used = |p: &&Parameter| all.iter().any(|e| e.symbols().contains(&p.symbol));
    d.parameters.iter().filter(is_used).cloned().collect()
}

/// Masses have frames of their own rows: they stay where each row of the old table still has its own.
fn without_masses(mut kept: Description, old: &Description, moving: &[usize]) -> Description {
    if moving.len() == old.rows.len() {
        return kept;
    }
    for row in &mut kept.rows {
        let plain = Row::still();
        (row.mass, row.com, row.inertia) = (plain.mass, plain.com, plain.inertia);
        (row.first_moment, row.inertia_at_origin) = (plain.first_moment, plain.inertia_at_origin);
        (row.rotor, row.viscous, row.coulomb) = (plain.rotor, plain.viscous, plain.coulomb);
    }
    kept
}

/// A constant between two axes in parts.
struct Part {
    gamma: f64,
    b: f64,
    a: f64,
    alpha: f64,
    beta: f64,
    theta: f64,
    d: f64,
}

/// The parts of a constant, of several readings the one that is nearest to a, α and γ as they were.
fn between(c: &Transform<f64>, a: f64, alpha: f64, gamma: f64) -> Part {
    let (r, t) = (&c.rotation, c.translation);
    let z = r.z();
    let sine = z[0].hypot(z[1]);
    let rest = |turn: &Rotation<f64>| {
        let q = turn.rows();
        q[1][0].atan2(q[0][0])
    };
    let distance = |x: f64, y: f64| near(x - y, 0.0).abs();
    if sine >= PARALLEL {
        // n = z₀ × z / sine
        let n = [-z[1] / sine, z[0] / sine];
        let (along, up) = (t.dot(z), t[2]);
        let d = (along - z[2] * up) / (sine * sine);
        let b = up - d * z[2];
        let length = t[0] * n[0] + t[1] * n[1];
        let one = |sign: f64| {
            let turn = (sign * n[1]).atan2(sign * n[0]);
            let tilt = sign * sine.atan2(z[2]);
            let left = Rotation::about_x(-tilt) * (Rotation::about_z(-turn) * *r);
            Part { gamma: turn, b, a: sign * length, alpha: tilt, beta: 0.0, theta: rest(&left), d }
        };
        let (p, m) = (one(1.0), one(-1.0));
        return if distance(p.alpha, alpha) <= distance(m.alpha, alpha) { p } else { m };
    }
    let d = t[2] / z[2];
    let (x, y) = (t[0] - z[0] * d, t[1] - z[1] * d);
    let size = x.hypot(y);
    let one = |turn: f64, length: f64| {
        let q = (Rotation::about_z(-turn) * *r).rows();
        Part {
            gamma: turn,
            b: 0.0,
            a: length,
            alpha: (-q[1][2]).atan2(q[2][2]),
            beta: q[0][2].atan2(q[0][0].hypot(q[0][1])),
            theta: (-q[0][1]).atan2(q[0][0]),
            d,
        }
    };
    if size < NO_LENGTH {
        return one(gamma, 0.0);
    }
    let sign = if a < 0.0 { -1.0 } else { 1.0 };
    one((sign * y).atan2(sign * x), sign * size)
}

/// Tx(a)·Rx(α)
fn along_x(cells: &[f64; 5]) -> Transform<f64> {
    Transform::translation_x(cells[2]) * Transform::rotation_x(cells[3])
}

/// An angle by whole turns next to another.
fn near(x: f64, to: f64) -> f64 {
    x - 2.0 * PI * ((x - to) / (2.0 * PI)).round()
}

/// Roll, pitch and yaw: R = Rz(yaw)·Ry(pitch)·Rx(roll).
pub fn rpy(r: &Rotation<f64>) -> [f64; 3] {
    let rows = r.rows();
    let yaw = rows[1][0].atan2(rows[0][0]);
    // Whatever yaw is near a pitch of 90°, the others belong to it.
    let q = (Rotation::about_z(-yaw) * *r).rows();
    [(-q[1][2]).atan2(q[1][1]), (-q[2][0]).atan2(q[0][0]), yaw]
}

/// A number exactly, by its shortest text.
fn number(x: f64) -> Expr {
    let text = shown(x);
    Rational::from_decimal(&text).map_or_else(|| Expr::int(0), Expr::from)
}

/// An angle exactly, by the shortest text of its degrees.
fn angle(x: f64) -> Expr {
    number(x.to_degrees()) * Expr::pi() / Expr::int(180)
}

/// The shortest decimal of a number, without exponent.
fn shown(x: f64) -> String {
    if x == 0.0 || !x.is_finite() { "0".into() } else { format!("{x}") }
}
