//! A recording held against a robot: what its columns are, what was found, what cannot be seen.

use crate::Schema;
use denavit_recording as recording;
use denavit_recording::words::{self, Names};
use denavit_recording::{Finding, Fitted, Held, Slip, Unseen};
use serde::Serialize;

/// A recording with what was found.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Recorded {
    /// Whether the pose was computed from these joints.
    pub computed: bool,
    /// In what it is other than the model.
    pub findings: Vec<Said>,
    /// How the orientation is written.
    pub format: String,
    /// How far the hand is off, once all of it is undone.
    pub left_over: Off,
    /// What of it is the noise of the columns; null where the rows are too far apart for it to be seen.
    pub noise: Option<Off>,
    /// The recipe, as a text in TOML.
    pub recipe: String,
    /// What it is called.
    pub recording: String,
    /// What else is worth saying.
    pub remarks: Vec<Said>,
    /// The residual in units of what is expected.
    pub rho: f64,
    /// Other readings that are as good, each as phrases.
    pub rivals: Vec<Vec<String>>,
    /// The robot.
    pub robot: String,
    /// Which columns are what.
    pub roles: Roles,
    /// How many rows there are.
    pub rows: usize,
    /// The version.
    pub schema: Schema,
    /// Whether it is understood.
    pub understood: bool,
    /// What no motion in it tells.
    pub unseen: Vec<NotSeen>,
}

/// Columns by their names.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Roles {
    /// The joints.
    pub joints: Vec<String>,
    /// The position.
    pub position: Vec<String>,
    /// The orientation.
    pub rotation: Vec<String>,
    /// The time.
    pub time: Option<String>,
}

impl Roles {
    /// By the numbers of the columns.
    pub fn of(recording: &recording::Recording, roles: &recording::Roles) -> Self {
        let name = |&c: &usize| recording.columns[c].name.clone();
        let listed = |columns: &[usize]| columns.iter().map(name).collect();
        Roles {
            joints: listed(&roles.joints),
            position: listed(&roles.position),
            rotation: listed(&roles.rotation),
            time: roles.time.as_ref().map(name),
        }
    }
}

/// How far the hand is off, root mean squares.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct Off {
    /// Radians.
    pub angle: f64,
    /// Metres.
    pub distance: f64,
}

/// A finding.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Said {
    /// The number's deviation.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub deviation: Option<f64>,
    /// The joint that it is about, from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint: Option<usize>,
    /// What kind of slip it is.
    pub kind: &'static str,
    /// Rows that it is about, counted from 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rows: Option<Vec<usize>>,
    /// Slips that are the same function, as phrases.
    pub same: Vec<String>,
    /// It in words.
    pub text: String,
    /// Its number: radians, metres, rows, or a part.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub value: Option<f64>,
    /// How far the hand is off where this alone is left as it stands.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub without: Option<Off>,
}

/// What no motion tells.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct NotSeen {
    /// The joint, from 1; null for all of them.
    pub joint: Option<usize>,
    /// By how much the joint moves, radians or metres.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub moves: Option<f64>,
    /// By how much it would have to.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub needed: Option<f64>,
}

impl Off {
    fn of(off: &recording::Off) -> Self {
        Off { angle: off.turn, distance: off.shift }
    }
}

/// The kind of a slip, its joint (from 0), its number and its rows.
fn parts(slip: &Slip) -> (&'static str, Option<usize>, Option<Fitted>, Option<Vec<usize>>) {
    let plain = |value: f64| Some(Fitted { value, deviation: 0.0 });
    match slip {
        Slip::Degrees => ("degrees", None, None, None),
        Slip::Radians => ("radians", None, None, None),
        Slip::Hundred => ("percent of range", None, None, None),
        Slip::Dropped(_) => ("no joint", None, None, None),
        Slip::Reversed => ("reversed order", None, None, None),
        Slip::Swap(i, _) => ("exchanged", Some(*i), None, None),
        Slip::Flip(i) => ("sign", Some(*i), None, None),
        Slip::Quarter(i, k) => ("zero", Some(*i), plain(f64::from(*k) * std::f64::consts::FRAC_PI_2), None),
        Slip::Couple(i, s) => ("coupling", Some(*i), plain(f64::from(*s)), None),
        Slip::DegreesOne(i) => ("degrees", Some(*i), None, None),
        Slip::Gain(i, g) => ("gain", Some(*i), plain(if *g > 0 { 0.5 } else { 2.0 }), None),
        Slip::Inverse => ("base in hand", None, None, None),
        Slip::Transposed => ("orientation of the base", None, None, None),
        Slip::Unit(k) => ("unit of length", None, plain(*k), None),
        Slip::LeftHanded(_) => ("left-handed", None, None, None),
        Slip::OtherArm(_) => ("another arm", None, None, None),
        Slip::Base(_) => ("base", None, None, None),
        Slip::Tool(_) => ("tool", None, None, None),
        Slip::Lag(by) => ("delay", None, Some(*by), None),
        Slip::Zero(i, by) => ("zero", Some(*i), Some(*by), None),
        Slip::GainBy(i, by) => ("gain", Some(*i), Some(Fitted { value: 1.0 + by.value, ..*by }), None),
        Slip::CoupleBy(i, by) => ("coupling", Some(*i), Some(*by), None),
        Slip::Length(l) => ("length", Some(l.constant - 1), Some(l.by), None),
        Slip::Jump(_, r, ..) => ("whole turns", None, None, Some(vec![*r])),
        Slip::Stuck(s) => ("stuck", Some(s.joint), None, Some(vec![s.from, s.to])),
        Slip::Spikes(rows) => ("spikes", None, None, Some(rows.clone())),
        Slip::Missing(rows) => ("missing", None, None, Some(rows.clone())),
        Slip::TimeBack(rows) => ("time", None, None, Some(rows.clone())),
        Slip::Apart(rows, _) => ("apart", None, None, Some(rows.clone())),
        Slip::Gaps(rows) => ("gaps", None, None, Some(rows.clone())),
        Slip::Unlike(u) => ("does not follow", Some(u.joint), None, None),
        Slip::NotUnderstood => ("not understood", None, None, None),
    }
}

impl Recorded {
    /// Of what was found.
    pub fn of(name: &str, robot: &str, held: &Held, roles: Roles, names: &Names) -> Self {
        let said = |f: &Finding| {
            let (kind, joint, number, rows) = parts(&f.slip);
            Said {
                deviation: number.map(|n| n.deviation).filter(|d| *d != 0.0),
                joint: joint.map(|j| j + 1),
                kind,
                rows,
                same: f.same.iter().map(|s| words::slip(s, held, names)).collect(),
                text: words::slip(&f.slip, held, names),
                value: number.map(|n| n.value),
                without: f.without.as_ref().map(Off::of),
            }
        };
        let unseen = |u: &Unseen| match *u {
            Unseen::Everything => NotSeen { joint: None, moves: None, needed: None },
            Unseen::Still(i) => NotSeen { joint: Some(i + 1), moves: None, needed: None },
            Unseen::Sign(i, moves, needed) => {
                NotSeen { joint: Some(i + 1), moves: Some(moves), needed: Some(needed) }
            }
        };
        let rival = |r: &recording::Rival| {
            let mut all: Vec<String> = r.slips.iter().map(|s| words::slip(s, held, names)).collect();
            if r.format != held.recipe.format {
                all.push(words::format_of(r.format));
            }
            all
        };
        Recorded {
            computed: held.is_computed,
            findings: held.findings.iter().map(said).collect(),
            format: words::format_of(held.recipe.format),
            left_over: Off::of(&held.left_over),
            noise: held.noise.as_ref().map(Off::of),
            recipe: held.recipe.to_string(),
            recording: name.into(),
            remarks: held.remarks.iter().map(said).collect(),
            rho: held.rho,
            rivals: held.rivals.iter().map(rival).collect(),
            robot: robot.into(),
            roles,
            rows: held.rows[0],
            schema: Schema,
            understood: held.is_understood,
            unseen: held.unseen.iter().map(unseen).collect(),
        }
    }
}
