//! Paths of the joints and of the hand, followed and timed.

use crate::arrays::matrix;
use crate::inverse::{poses, unprepared};
use crate::trouble::{Kind, Trouble};
use denavit::Robot;
use denavit::description::Description;
use denavit::dynamics::{Dynamics, NoNumbers};
use denavit::geometry::{Transform, Vector};
use denavit::motion::hand::{Arc, HandChain, HandPath, Line, Orientation, PoseSpline};
use denavit::motion::plan::{Held, KnownLimits, PlanError, PlanOptions, Planned, Sampled, Verdict, Wish};
use denavit::motion::profile::Law;
use denavit::motion::{MotionError, TorqueLimits, Trajectory};
use denavit_report::words::Tongue;
use denavit_wire::path::{Event, Start};
use numpy::IntoPyArray;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

/// Poses that differ by less in every entry are one.
const SAME: f64 = 1e-9;

/// A motion of all joints, to be asked at any time.
#[pyclass(frozen, module = "denavit._denavit")]
pub struct Moving(Box<dyn Trajectory>);

#[pymethods]
impl Moving {
    /// Joints, velocities and accelerations at times.
    fn at<'py>(&self, py: Python<'py>, times: Vec<f64>) -> PyResult<Bound<'py, PyAny>> {
        let (count, n) = (times.len(), self.0.dof());
        let (mut q, mut qd, mut qdd) = (vec![], vec![], vec![]);
        for t in times {
            let state = self.0.eval(t);
            q.extend(state.q);
            qd.extend(state.qd);
            qdd.extend(state.qdd);
        }
        let all = (matrix(py, q, count, n)?, matrix(py, qd, count, n)?, matrix(py, qdd, count, n)?);
        Ok(all.into_pyobject(py)?.into_any())
    }
}

/// What is between two poses.
#[derive(FromPyObject)]
pub enum Along {
    /// An arc through a point.
    Through([f64; 3]),
    /// `line`, `screw`.
    Named(String),
}

/// What is moved along.
pub enum Way {
    /// Through configurations.
    Joints(Vec<Vec<f64>>),
    /// Through poses, by what is between them; a smooth curve if that is nothing.
    Hand { poses: Vec<Transform<f64>>, along: Option<Vec<Along>>, start: Option<Vec<f64>> },
}

/// How it is to be done.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Manner {
    velocity: Option<Vec<f64>>,
    acceleration: Option<Vec<f64>>,
    jerk: Option<Vec<f64>>,
    torque: Option<Vec<f64>>,
    duration: Option<f64>,
    dt: Option<f64>,
    law: Option<String>,
    blend: Option<f64>,
    speed: Option<f64>,
    max_deviation: Option<f64>,
    alternatives: bool,
}

/// A path of the hand as it comes from Python.
///
/// # Errors
/// If one of the poses is none.
pub fn way_of_poses(
    object: &Bound<'_, PyAny>,
    along: Option<Vec<Along>>,
    start: Option<Vec<f64>>,
) -> PyResult<Way> {
    Ok(Way::Hand { poses: poses(object)?.0, along, start })
}

fn law(name: &str) -> Result<Law, Trouble> {
    Ok(match name {
        "cubic" => Law::Cubic,
        "quintic" => Law::Quintic,
        "trapezoidal" => Law::Trapezoidal,
        "jerk-limited" => Law::DoubleS,
        _ => {
            let why = format!("no law `{name}`: cubic, quintic, trapezoidal or jerk-limited");
            return Err(Trouble::new(Kind::Usage, why));
        }
    })
}

/// What goes wrong, by who can do something about it.
fn trouble(why: &PlanError) -> Trouble {
    let kind = match why {
        PlanError::Unprepared(why) => return unprepared(why),
        PlanError::Limits(_)
        | PlanError::NeededForJerk
        | PlanError::NeededForTorque
        | PlanError::LawWithTorque
        | PlanError::NeededForLaw
        | PlanError::LawJumps(_)
        | PlanError::Motion(MotionError::NotPositive(..) | MotionError::Joints { .. }) => Kind::Usage,
        PlanError::Motion(_)
        | PlanError::OutOfReach
        | PlanError::OutsideLimits { .. }
        | PlanError::TooFast { .. }
        | PlanError::SlowTorque { .. }
        | PlanError::TooShort { .. } => Kind::Motion,
    };
    let about = match why {
        PlanError::NeededForJerk => "jerk: ",
        PlanError::NeededForTorque | PlanError::LawWithTorque => "torque: ",
        PlanError::NeededForLaw | PlanError::LawJumps(_) => "law: ",
        PlanError::TooFast { .. } | PlanError::SlowTorque { .. } | PlanError::TooShort { .. } => "duration: ",
        _ => "",
    };
    Trouble::new(kind, format!("{about}{why}"))
}

fn wish(robot: &Robot<f64>, way: Way) -> Result<Wish, Trouble> {
    let (mut poses, along, start) = match way {
        Way::Joints(points) => return Ok(Wish::Joints(points)),
        Way::Hand { poses, along, start } => (poses, along, start),
    };
    if let Some(q) = &start
        && q.len() == robot.joints
    {
        let own = robot.pose(q);
        let is_same = |first: &Transform<f64>| {
            let (a, b) = (own.matrix(), first.matrix());
            a.iter().flatten().zip(b.iter().flatten()).all(|(a, b)| (a - b).abs() < SAME)
        };
        if !poses.first().is_some_and(is_same) {
            poses.insert(0, own);
        }
    }
    if poses.len() < 2 {
        return Err(Trouble::new(Kind::Usage, "a path needs two poses, or a start and a pose"));
    }
    let Some(along) = along else {
        let spline = PoseSpline::new(poses).ok_or_else(|| {
            Trouble::new(Kind::Usage, "no two poses of a smooth path in a row may be the same")
        })?;
        return Ok(Wish::Hand { path: Box::new(spline), start });
    };
    let pieces = poses.len() - 1;
    if along.len() != pieces && along.len() != 1 {
        let why = format!("along has {} entries for {pieces} pieces: one for all, or one each", along.len());
        return Err(Trouble::new(Kind::Shape, why));
    }
    let piece = |(k, ends): (usize, &[Transform<f64>])| -> Result<Box<dyn HandPath + Send + Sync>, Trouble> {
        let (from, to) = (ends[0], ends[1]);
        let line = |orientation| Box::new(Line { from, to, orientation });
        Ok(match &along[if along.len() == 1 { 0 } else { k }] {
            Along::Named(name) if name == "line" => line(Orientation::Slerp),
            Along::Named(name) if name == "screw" => line(Orientation::Screw),
            Along::Named(name) => {
                let why = format!("no piece `{name}`: line, screw, or a point that an arc goes through");
                return Err(Trouble::new(Kind::Usage, why));
            }
            Along::Through(point) => {
                let arc = Arc::new(from, Vector(*point), to);
                Box::new(arc.map_err(|why| Trouble::new(Kind::Usage, format!("along {}: {why}", k + 1)))?)
            }
        })
    };
    let parts = poses.windows(2).enumerate().map(piece).collect::<Result<Vec<_>, _>>()?;
    Ok(Wish::Hand { path: Box::new(HandChain::new(parts)), start })
}

fn limits(d: &Description, manner: &Manner) -> Result<KnownLimits, Trouble> {
    let torque = match &manner.torque {
        None => None,
        Some(torques) => {
            let arm = Dynamics::numeric(d).map_err(|why| match why {
                NoNumbers::NoMasses => Trouble::new(Kind::NoMasses, format!("{}: {why}", d.name)),
                NoNumbers::Missing(missing) => Trouble::missing(missing),
                NoNumbers::NegativeMass(..) => Trouble::new(Kind::Description, format!("{}: {why}", d.name)),
            })?;
            let limits = TorqueLimits::symmetric(arm, torques);
            Some(limits.map_err(|why| Trouble::new(Kind::Usage, format!("torque: {why}")))?)
        }
    };
    let asked = KnownLimits {
        velocity: manner.velocity.clone(),
        acceleration: manner.acceleration.clone(),
        jerk: manner.jerk.clone(),
        torque,
    };
    Ok(asked.or(KnownLimits::of(d)))
}

/// A motion, with what is known of it.
pub struct Plan {
    moving: Moving,
    sampled: Sampled,
    course: String,
    timing: String,
    held: Option<Held>,
    verdict: (bool, String),
    followed: Option<Hand>,
    starts: Vec<Start>,
}

/// What is known of a path of the hand.
struct Hand {
    reached: f64,
    deviation: f64,
    turned: f64,
    certified: bool,
    /// The part of the way, the joints, the smallest singular value.
    clearance: Option<(f64, Vec<f64>, f64)>,
    events: Vec<(Event, String)>,
}

/// Follows, times and samples.
///
/// # Errors
/// If something does not fit the robot, or there is no such motion.
pub fn plan(d: &Description, way: Way, manner: &Manner) -> Result<Plan, Trouble> {
    let robot = Robot::numeric(d).map_err(Trouble::missing)?;
    let usual = PlanOptions::default();
    let options = PlanOptions {
        blend: manner.blend,
        law: manner.law.as_deref().map(law).transpose()?,
        duration: manner.duration,
        speed: manner.speed.unwrap_or(usual.speed),
        max_deviation: manner.max_deviation.unwrap_or(usual.max_deviation),
        alternatives: manner.alternatives,
    };
    let planned = Planned::new(d, &robot, wish(&robot, way)?, &limits(d, manner)?, &options);
    let planned = planned.map_err(|why| trouble(&why))?;
    let sampled = planned.sampled(d, &robot, manner.dt);
    let words = Tongue::English.words();
    let followed = planned.followed.as_ref().map(|f| Hand {
        reached: f.reached,
        deviation: f.deviation,
        turned: f.turned,
        certified: f.certified,
        clearance: f.clearance.as_ref().map(|c| (c.s, c.q.clone(), c.smallest)),
        events: f.events.iter().map(|e| (Event::of(d, e), words.event(e, d))).collect(),
    });
    let verdict = planned.verdict();
    Ok(Plan {
        sampled: sampled.map_err(|why| Trouble::new(Kind::Usage, format!("dt: {why}")))?,
        course: words.course(&planned.course),
        timing: words.timing(&planned.timing, d),
        held: planned.timing.held,
        verdict: (verdict == Verdict::Whole, words.verdict(verdict)),
        followed,
        starts: planned.alternatives.iter().map(Start::from).collect(),
        moving: Moving(planned.trajectory),
    })
}

impl Plan {
    /// As Python gets it.
    ///
    /// # Errors
    /// None but Python's own.
    pub fn into_dict(self, py: Python<'_>, joints: usize) -> PyResult<Bound<'_, PyDict>> {
        let dict = PyDict::new(py);
        let samples = &self.sampled.samples;
        let count = samples.len();
        let rows = |of: fn(&denavit::motion::plan::Sample) -> &[f64]| {
            let all: Vec<f64> = samples.iter().flat_map(|s| of(s).iter().copied()).collect();
            matrix(py, all, count, joints)
        };
        dict.set_item("t", samples.iter().map(|s| s.t).collect::<Vec<_>>().into_pyarray(py))?;
        dict.set_item("q", rows(|s| &s.state.q)?)?;
        dict.set_item("qd", rows(|s| &s.state.qd)?)?;
        dict.set_item("qdd", rows(|s| &s.state.qdd)?)?;
        let poses: Vec<f64> = samples.iter().flat_map(|s| s.pose.matrix()).flatten().collect();
        dict.set_item("poses", matrix(py, poses, 4 * count, 4)?)?;
        let manipulability: Vec<f64> = samples.iter().map(|s| s.manipulability).collect();
        dict.set_item("manipulability", manipulability.into_pyarray(py))?;
        dict.set_item("duration", self.moving.0.duration())?;
        dict.set_item("course", self.course)?;
        dict.set_item("timing", self.timing)?;
        let held = self.held.map(|h| (h.instants, h.velocity, h.acceleration, h.jerk, h.torque));
        dict.set_item("held", held)?;
        dict.set_item("ok", self.verdict.0)?;
        dict.set_item("verdict", self.verdict.1)?;
        dict.set_item("reached", self.followed.as_ref().map_or(1.0, |f| f.reached))?;
        dict.set_item("deviation", self.followed.as_ref().map(|f| (f.deviation, f.turned)))?;
        dict.set_item("certified", self.followed.as_ref().map(|f| f.certified))?;
        let clearance = self.followed.as_ref().and_then(|f| f.clearance.clone());
        dict.set_item("clearance", clearance.map(|(s, q, least)| (s, q.into_pyarray(py), least)))?;
        let events = self.followed.map_or(vec![], |f| f.events);
        let events = events.into_iter().map(|(e, words)| -> PyResult<_> {
            let event = PyDict::new(py);
            event.set_item("s", e.s)?;
            event.set_item("kind", e.kind)?;
            event.set_item("words", words)?;
            event.set_item("q", e.q.into_pyarray(py))?;
            event.set_item("joint", e.joint)?;
            event.set_item("limit", e.limit)?;
            event.set_item("factor", e.factor.flatten())?;
            event.set_item("why", e.why.flatten())?;
            event.set_item("crossed", e.crossed)?;
            event.set_item("reachable", e.reachable)?;
            Ok(event)
        });
        dict.set_item("events", PyList::new(py, events.collect::<PyResult<Vec<_>>>()?)?)?;
        let starts = self
            .starts
            .into_iter()
            .map(|s| (s.q.into_pyarray(py), s.branch, s.reached, s.singular, s.within_limits));
        dict.set_item("starts", PyList::new(py, starts.collect::<Vec<_>>())?)?;
        dict.set_item("moving", Py::new(py, self.moving)?)?;
        Ok(dict)
    }
}
