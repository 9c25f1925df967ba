//! Parameters that were identified, and motions that show them.

use crate::Schema;
use denavit_identification as identification;
use denavit_identification::words;
use denavit_identification::{Known, Model, Prior};
use serde::Serialize;

/// What was identified.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Identified {
    /// Rotors that are part of other parameters.
    pub absorbed: Vec<Absorbed>,
    /// The condition number of the weighted regressor, its columns of one size; null where it is infinite.
    pub condition: Option<f64>,
    /// Masses that can be; null where the recording is suspect.
    pub consistent: Option<Consistent>,
    /// The filters' frequencies; null without one.
    pub cutoff: Option<Cutoff>,
    /// Joint by joint.
    pub joints: Vec<Joint>,
    /// Rows that count less than half in the robust fit.
    pub outliers: usize,
    /// What was sought.
    pub parameters: Vec<Parameter>,
    /// The recordings.
    pub recordings: Vec<String>,
    /// What else is worth saying.
    pub remarks: Vec<String>,
    /// The robot.
    pub robot: String,
    /// Which columns are what.
    pub roles: Roles,
    /// Rows of the recordings.
    pub rows: usize,
    /// The version.
    pub schema: Schema,
    /// Seconds of motion.
    pub seconds: f64,
    /// What no arm does.
    pub suspects: Vec<Suspect>,
}

/// A rotor that is part of other parameters.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Absorbed {
    /// The rotor.
    pub name: String,
    /// These.
    pub of: String,
}

/// Frequencies, Hz.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct Cutoff {
    /// Of the positions.
    pub positions: f64,
    /// Of the torques and their regressor.
    pub torques: f64,
}

/// Columns by their names.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Roles {
    /// Accelerations; none where they are had from the rates.
    pub accelerations: Vec<String>,
    /// Joint variables.
    pub joints: Vec<String>,
    /// The time; null where the rate is told.
    pub time: Option<String>,
    /// Torques.
    pub torques: Vec<String>,
    /// Rates; none where they are had from the positions.
    pub velocities: Vec<String>,
}

/// A joint's torques, root mean squares.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Joint {
    /// Rows at rest, left out.
    pub at_rest: usize,
    /// What is left on stretches that were held out; null where they could not be.
    pub held_out: Option<f64>,
    /// What is left.
    pub left: f64,
    /// Its name.
    pub name: String,
    /// The noise of a row.
    pub noise: f64,
    /// Rows.
    pub rows: usize,
    /// The torque.
    pub torque: f64,
}

/// A parameter.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Parameter {
    /// Its standard deviation.
    pub deviation: f64,
    /// What it is in the parameters of the links; null where it is one of them.
    pub grouping: Option<String>,
    /// `value`, `unseen` or `left out`.
    pub known: &'static str,
    /// Its name.
    pub name: String,
    /// Its unit.
    pub unit: &'static str,
    /// Its value; null where the motion does not tell.
    pub value: Option<f64>,
}

/// Masses that can be.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Consistent {
    /// By how much the weighted sum of squares is larger.
    pub excess: f64,
    /// What is left of each joint's torques with them.
    pub left: Vec<f64>,
    /// The links.
    pub links: Vec<Link>,
    /// What is added to each joint's torque.
    pub offsets: Vec<f64>,
    /// What they are near to: `given` or `neutral`.
    pub prior: &'static str,
    /// Whether Newton's method came to its end at the last weight of what they are near to.
    pub settled: bool,
}

/// A link about the origin of its own frame.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Link {
    /// Its centre of mass, metres.
    pub centre: [f64; 3],
    /// xx xy xz yy yz zz, about the origin.
    pub inertia: [f64; 6],
    /// Kilograms.
    pub mass: f64,
}

/// What is suspect.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Suspect {
    /// The joint, from 1; null where it is about all.
    pub joint: Option<usize>,
    /// `sign`, `factor`, `all signs`, `inertia`, `friction`, `gravity`, `mass` or `unexplained`.
    pub kind: &'static str,
    /// In words.
    pub text: String,
}

impl Suspect {
    /// Of what was found.
    pub fn of(model: &Model, names: &[String], s: &identification::Suspect) -> Self {
        use identification::Suspect as S;
        use identification::What;
        let (kind, joint) = match s {
            S::Sign(j, _) => ("sign", Some(*j)),
            S::Factor(j, ..) => ("factor", Some(*j)),
            S::AllSigns => ("all signs", None),
            S::Inertia(j, ..) => ("inertia", Some(*j)),
            S::Friction(k, ..) => match model.parameters[*k].what {
                What::Viscous(j) | What::Coulomb(j) | What::Rotor(j) | What::Offset(j) => {
                    ("friction", Some(j))
                }
                What::Base(_) => ("friction", None),
            },
            S::Gravity(..) => ("gravity", None),
            S::Mass(_) => ("mass", None),
            S::Unexplained(j, _) => ("unexplained", Some(*j)),
        };
        Suspect { joint: joint.map(|j| j + 1), kind, text: words::suspect(model, names, s) }
    }
}

impl Identified {
    /// Of what was found; `names` are those of the joints.
    pub fn of(
        robot: &str,
        recordings: Vec<String>,
        model: &Model,
        names: &[String],
        roles: Roles,
        found: &identification::Identified,
        set: Option<(&identification::Consistent, &Prior)>,
    ) -> Self {
        let estimate = &found.estimate;
        let joint = |(j, of): (usize, &identification::OfJoint)| Joint {
            at_rest: of.at_rest,
            held_out: of.held_out,
            left: of.left,
            name: names[j].clone(),
            noise: of.noise,
            rows: of.rows,
            torque: of.torque,
        };
        let parameter = |(p, known): (&identification::Parameter, &Known)| {
            let (known, value, deviation) = match *known {
                Known::Value(x, s) => ("value", Some(x), s),
                Known::Unseen(s) => ("unseen", None, s),
                Known::LeftOut(x, s) => ("left out", Some(x), s),
            };
            let grouping = p.grouping.clone();
            Parameter { deviation, grouping, known, name: p.name.clone(), unit: p.unit, value }
        };
        let consistent = set.map(|(set, prior)| Consistent {
            excess: set.excess,
            left: found.left(&set.values),
            links: set
                .bodies
                .iter()
                .map(|b| Link {
                    centre: b.first_moment.0.map(|x| x / b.mass),
                    inertia: b.inertia,
                    mass: b.mass,
                })
                .collect(),
            offsets: set.offsets.clone(),
            prior: match prior {
                Prior::Given(_) => "given",
                Prior::Neutral => "neutral",
            },
            settled: set.is_settled,
        });
        let mut remarks: Vec<String> = found.remarks.iter().map(|r| words::remark(names, r)).collect();
        remarks.extend(words::lines(model, names, found));
        Identified {
            absorbed: model
                .absorbed
                .iter()
                .map(|(name, of)| Absorbed { name: name.clone(), of: of.clone() })
                .collect(),
            condition: Some(estimate.condition).filter(|c| c.is_finite()),
            consistent,
            cutoff: found.cutoffs.map(|(positions, torques)| Cutoff { positions, torques }),
            joints: estimate.joints.iter().enumerate().map(joint).collect(),
            outliers: estimate.outliers,
            parameters: model.parameters.iter().zip(&estimate.known).map(parameter).collect(),
            recordings,
            remarks,
            robot: robot.into(),
            roles,
            rows: found.rows,
            schema: Schema,
            seconds: found.seconds,
            suspects: found.suspects.iter().map(|s| Suspect::of(model, names, s)).collect(),
        }
    }
}

/// A motion that shows the parameters.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Excitation {
    /// aₗ of each joint, from the first harmonic.
    pub a: Vec<Vec<f64>>,
    /// bₗ of each joint.
    pub b: Vec<Vec<f64>>,
    /// Where each joint's series is about.
    pub centres: Vec<f64>,
    /// The condition number of the regressor, its columns of one size; null where it is infinite.
    pub condition: Option<f64>,
    /// Seconds of a period.
    pub duration: f64,
    /// ln det WᵀW; null where it is 0.
    pub log_det: Option<f64>,
    /// The robot.
    pub robot: String,
    /// The version.
    pub schema: Schema,
    /// Where it starts, and ends.
    pub start: Vec<f64>,
    /// The greatest part of the torque limits; null where there are none.
    pub torque: Option<f64>,
    /// How many motions were tried.
    pub trials: usize,
}

impl Excitation {
    /// Of a motion.
    pub fn of(robot: &str, e: &identification::Excitation) -> Self {
        let [start, ..] = e.at(0.0);
        Excitation {
            a: e.series.iter().map(|s| s[0].clone()).collect(),
            b: e.series.iter().map(|s| s[1].clone()).collect(),
            centres: e.centres.clone(),
            condition: Some(e.condition).filter(|c| c.is_finite()),
            duration: e.duration,
            log_det: Some(e.log_det).filter(|c| c.is_finite()),
            robot: robot.into(),
            schema: Schema,
            start,
            torque: e.torque,
            trials: e.trials,
        }
    }
}
