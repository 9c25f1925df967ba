//! Which columns of a recording are joints, rates, torques, and in which units: by their names, or as it is told.

use crate::motion::Columns;
use denavit_recording::{
    RolesError, column_of_episodes, column_of_time, columns_of_joints, columns_told, seconds_by_step,
    seconds_said,
};

/// A column of a file.
#[derive(Clone, PartialEq, Debug)]
pub struct Column {
    /// Its name, without its unit.
    pub name: String,
    /// Its unit, as it stands there.
    pub unit: Option<String>,
    /// Its numbers; not a number where there is none.
    pub values: Vec<f64>,
}

/// What columns are told by hand: names with commas, or `first..last`.
#[derive(Clone, Default, Debug)]
pub struct Told {
    /// The time.
    pub time: Option<String>,
    /// Joint variables.
    pub joints: Option<String>,
    /// Their rates.
    pub velocities: Option<String>,
    /// Their accelerations.
    pub accelerations: Option<String>,
    /// Torques, or what is multiplied with gains: currents.
    pub torques: Option<String>,
    /// What columns of torques are multiplied with, joint by joint.
    pub gains: Option<Vec<f64>>,
    /// Rows a second; no column is the time then, unless it is told.
    pub rate: Option<f64>,
    /// Joints without unit are degrees.
    pub degrees: bool,
}

/// What the joints are called, and what they do.
#[derive(Clone, Debug)]
pub struct Joints {
    /// Lists of their names, each complete.
    pub names: Vec<Vec<String>>,
    /// Whether each turns.
    pub turns: Vec<bool>,
}

/// Which columns are what, by their numbers from 0.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Roles {
    /// The time.
    pub time: Option<usize>,
    /// The number of the episode.
    pub episode: Option<usize>,
    /// Joint variables.
    pub joints: Vec<usize>,
    /// Their rates.
    pub velocities: Vec<usize>,
    /// Their accelerations.
    pub accelerations: Vec<usize>,
    /// Torques.
    pub torques: Vec<usize>,
}

/// Why columns are not known.
#[derive(Clone, PartialEq, Debug)]
pub enum NoColumns {
    /// A column that is told is not there, or nothing says which columns are meant.
    Roles(RolesError),
    /// So many columns are these, and so many joints there are.
    Count(&'static str, usize, usize),
    /// A column is in a unit that is none of its quantity.
    Unit {
        /// Its name.
        column: String,
        /// The unit.
        unit: String,
        /// What it is taken for.
        what: &'static str,
    },
    /// Torques are currents, and there are no gains.
    Currents(String),
}

impl std::fmt::Display for NoColumns {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            NoColumns::Roles(why) => why.fmt(f),
            NoColumns::Count(what, found, needed) => {
                write!(f, "the robot has {needed} joints, and {found} columns are taken for their {what}")
            }
            NoColumns::Unit { column, unit, what } => {
                write!(f, "column `{column}`: {unit} is no unit of {what}")
            }
            NoColumns::Currents(column) => write!(
                f,
                "column `{column}` is a current\n  = hint: --gains with the torque of a joint by its current, one for all or one each"
            ),
        }
    }
}

impl std::error::Error for NoColumns {}

/// Names of joint variables.
const POSITIONS: &[&str] = &[
    "q",
    "qmeas",
    "qm",
    "qactual",
    "actualq",
    "measuredq",
    "qpos",
    "pos",
    "position",
    "positions",
    "joint",
    "joints",
    "jointposition",
    "jointpositions",
    "jointangle",
    "jointangles",
    "jointpos",
    "jointstateposition",
    "theta",
    "θ",
    "th",
    "angle",
    "angles",
    "axis",
    "state",
    "observationstate",
    "j",
    "",
];
/// Names of rates.
const VELOCITIES: &[&str] = &[
    "qd",
    "dq",
    "qdot",
    "qvel",
    "vel",
    "velocity",
    "velocities",
    "jointvelocity",
    "jointvelocities",
    "jointvel",
    "actualqd",
    "qdactual",
    "qdmeas",
    "dqmeas",
    "speed",
    "speeds",
    "v",
    "omega",
    "thetadot",
    "dtheta",
];
/// Names of accelerations.
const ACCELERATIONS: &[&str] = &[
    "qdd",
    "ddq",
    "qddot",
    "qacc",
    "acc",
    "acceleration",
    "accelerations",
    "jointacceleration",
    "jointaccelerations",
    "actualqdd",
    "ddtheta",
];
/// Names of torques.
const TORQUES: &[&str] = &[
    "tau",
    "τ",
    "taum",
    "tauj",
    "taumeas",
    "taumeasured",
    "measuredtau",
    "torque",
    "torques",
    "jointtorque",
    "jointtorques",
    "measuredtorque",
    "measuredtorques",
    "actualtorque",
    "effort",
    "efforts",
    "jointeffort",
    "jointefforts",
    "motortorque",
    "motortorques",
    "trq",
    "moment",
    "msrjointtorque",
    "forces",
    "force",
];
/// Names of currents.
const CURRENTS: &[&str] = &[
    "current",
    "currents",
    "actualcurrent",
    "motorcurrent",
    "motorcurrents",
    "jointcurrent",
    "jointcurrents",
    "i",
    "im",
];

impl Roles {
    /// By what is told, and by names for the rest.
    ///
    /// # Errors
    /// If a column is not there, or nothing says which columns are meant.
    pub fn find(columns: &[Column], joints: &Joints, told: &Told) -> Result<Self, NoColumns> {
        let names: Vec<&str> = columns.iter().map(|c| c.name.as_str()).collect();
        let n = joints.turns.len();
        let by = |text: &Option<String>| -> Result<Option<Vec<usize>>, NoColumns> {
            text.as_deref().map(|t| columns_told(&names, t).map_err(NoColumns::Roles)).transpose()
        };
        let search = |known: &[&str]| columns_of_joints(&names, &joints.names, known);
        let unknown = |what| {
            let names = names.iter().map(|n| (*n).to_string()).collect();
            NoColumns::Roles(RolesError::Unknown(what, names))
        };
        let time = match by(&told.time)? {
            Some(columns) => columns.first().copied(),
            // What is told of the rate is so whatever a column says.
            None if told.rate.is_some() => None,
            None => column_of_time(&names, |_| false),
        };
        if time.is_none() && told.rate.is_none() {
            return Err(unknown("time"));
        }
        let positions = by(&told.joints)?.or_else(|| search(POSITIONS)).ok_or_else(|| unknown("joints"))?;
        let torques = match by(&told.torques)? {
            Some(columns) => columns,
            None => search(TORQUES).or_else(|| search(CURRENTS)).ok_or_else(|| unknown("torques"))?,
        };
        let velocities = by(&told.velocities)?.or_else(|| search(VELOCITIES)).unwrap_or_default();
        let accelerations = by(&told.accelerations)?.or_else(|| search(ACCELERATIONS)).unwrap_or_default();
        for (what, found, may_be_none) in [
            ("variables", &positions, false),
            ("torques", &torques, false),
            ("velocities", &velocities, true),
            ("accelerations", &accelerations, true),
        ] {
            if found.len() != n && !(may_be_none && found.is_empty()) {
                return Err(NoColumns::Count(what, found.len(), n));
            }
        }
        Ok(Roles {
            time,
            episode: column_of_episodes(&names),
            joints: positions,
            velocities,
            accelerations,
            torques,
        })
    }

    /// The columns in SI.
    ///
    /// # Errors
    /// If a unit is none of its quantity, or currents have no gains.
    pub fn columns(&self, all: &[Column], joints: &Joints, told: &Told) -> Result<Columns, NoColumns> {
        let rows = all.first().map_or(0, |c| c.values.len());
        let scaled = |c: usize, k: f64| -> Vec<f64> { all[c].values.iter().map(|x| k * x).collect() };
        let wrong = |c: usize, what| NoColumns::Unit {
            column: all[c].name.clone(),
            unit: all[c].unit.clone().unwrap_or_default(),
            what,
        };
        let kinematic = |columns: &[usize], per: usize| -> Result<Vec<Vec<f64>>, NoColumns> {
            let one = |(&c, &turns): (&usize, &bool)| {
                let usual = if told.degrees && turns { 1_f64.to_radians() } else { 1.0 };
                let k = match &all[c].unit {
                    None => usual,
                    Some(unit) => of_motion(unit, turns, per).ok_or_else(|| {
                        wrong(c, if turns { "an angle or its rates" } else { "a length or its rates" })
                    })?,
                };
                Ok(scaled(c, k))
            };
            columns.iter().zip(&joints.turns).map(one).collect()
        };
        let torque = |(j, &c): (usize, &usize)| {
            let unit = all[c].unit.as_deref().map(plain_unit);
            let gain = told.gains.as_ref().map(|g| g[j.min(g.len().saturating_sub(1))]);
            let k = match (unit.as_deref(), gain) {
                (Some("a" | "amp" | "ampere"), Some(g)) => g,
                (Some("ma"), Some(g)) => 1e-3 * g,
                (Some("a" | "ma" | "amp" | "ampere"), None) => {
                    return Err(NoColumns::Currents(all[c].name.clone()));
                }
                (Some(unit), g) => {
                    of_torque(unit, joints.turns[j]).ok_or_else(|| wrong(c, "a torque or a force"))?
                        * g.unwrap_or(1.0)
                }
                (None, Some(g)) => g,
                (None, None) => {
                    let stem: String =
                        all[c].name.to_lowercase().chars().filter(|c| c.is_alphabetic()).collect();
                    if CURRENTS.contains(&stem.as_str()) {
                        return Err(NoColumns::Currents(all[c].name.clone()));
                    }
                    1.0
                }
            };
            Ok(scaled(c, k))
        };
        let rate = |columns: &[usize], per| {
            if columns.is_empty() { Ok(None) } else { kinematic(columns, per).map(Some) }
        };
        let time = match self.time {
            Some(c) => {
                let unit = unit_of_time(&all[c]).ok_or_else(|| wrong(c, "time"))?;
                scaled(c, unit)
            }
            None => (0..rows).map(|r| r as f64 / told.rate.unwrap_or(1.0)).collect(),
        };
        let starts = self.episode.map_or(vec![], |c| {
            let values = &all[c].values;
            (1..rows).filter(|&r| values[r].to_bits() != values[r - 1].to_bits()).collect()
        });
        Ok(Columns {
            time,
            starts,
            q: kinematic(&self.joints, 0)?,
            qd: rate(&self.velocities, 1)?,
            qdd: rate(&self.accelerations, 2)?,
            tau: self.torques.iter().enumerate().map(torque).collect::<Result<_, _>>()?,
        })
    }

    /// Whether angles without unit may be degrees: none of the joints says its unit.
    pub fn may_be_degrees(&self, all: &[Column], joints: &Joints, told: &Told) -> bool {
        let mut turning = self.joints.iter().zip(&joints.turns).filter(|t| *t.1);
        !told.degrees && turning.all(|(&c, _)| all[c].unit.is_none())
    }
}

/// Seconds in what the time is in: as it says, or by its step; none if it says no unit of time.
fn unit_of_time(column: &Column) -> Option<f64> {
    if let Some(unit) = &column.unit {
        return seconds_said(&plain_unit(unit));
    }
    let steps = column.values.windows(2).map(|w| w[1] - w[0]).filter(|d| *d > 0.0);
    Some(seconds_by_step(crate::signal::median(steps.collect()), &column.values))
}

/// Small letters without blanks and dots.
fn plain_unit(unit: &str) -> String {
    unit.to_lowercase()
        .chars()
        .filter(|c| !c.is_whitespace() && !matches!(c, '·' | '*' | '.' | '⋅'))
        .collect()
}

/// What a unit of a joint's variable, or of its rates, is in SI.
fn of_motion(unit: &str, turns: bool, per: usize) -> Option<f64> {
    let unit = plain_unit(unit).replace('²', "2").replace('^', "").replace("**", "");
    if unit == "rpm" {
        return (turns && per == 1).then_some(std::f64::consts::TAU / 60.0);
    }
    let behind = unit.find('/').map_or("", |at| &unit[at..]);
    let own = unit.split('/').next().unwrap_or_default();
    let is_right = match per {
        0 => behind.is_empty(),
        1 => matches!(behind, "/s" | "/sec"),
        _ => matches!(behind, "/s2" | "/sec2" | "/s/s"),
    };
    // A header may leave away that a rate is one: `qd1 [rad]`.
    if !(is_right || behind.is_empty()) {
        return None;
    }
    match (own, turns) {
        ("rad" | "radian" | "radians", true) | ("m" | "meter" | "metre" | "meters" | "metres", false) => {
            Some(1.0)
        }
        ("deg" | "degree" | "degrees" | "°", true) => Some(1_f64.to_radians()),
        ("cm", false) => Some(1e-2),
        ("mm", false) => Some(1e-3),
        _ => None,
    }
}

/// What a unit of torque, or of force, is in SI.
fn of_torque(unit: &str, turns: bool) -> Option<f64> {
    Some(match (unit, turns) {
        ("nm", true) | ("n", false) => 1.0,
        ("mnm" | "nmm", true) | ("mn", false) => 1e-3,
        ("ncm", true) => 1e-2,
        ("knm", true) | ("kn", false) => 1e3,
        _ => return None,
    })
}
