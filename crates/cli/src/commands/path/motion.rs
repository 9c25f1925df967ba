//! The motion: followed, and timed.

use super::request::Request;
use crate::arguments::{LawName, PathArguments};
use crate::commands::ik::unprepared;
use crate::failure::Failure;
use denavit::Robot;
use denavit::description::Description;
use denavit::inverse::JointSpace;
use denavit::motion::follow::{Alternative, Followed, Follower, Options};
use denavit::motion::hand::HandPath;
use denavit::motion::path::{Blend, Ends, JointPath, PiecewisePath, blended, cubic_spline, cubic_spline_at};
use denavit::motion::profile::{Law, Polynomial, Profile, synchronised};
use denavit::motion::{
    JerkLimited, JointState, Limits, MotionError, TimeOptimal, Trajectory, move_within_limits,
};

/// A path with its timing.
pub struct Planned {
    /// The joints in time; nothing if the path cannot be followed at all.
    pub trajectory: Box<dyn Trajectory>,
    /// What path it is, in words.
    pub words: String,
    /// How it was timed, in words.
    pub timing: String,
    /// What was met on the way, for a path of the hand.
    pub followed: Option<Followed>,
    /// The other starts.
    pub alternatives: Vec<Alternative>,
}

/// The speed of the hand where nothing else is known, m/s.
const SPEED: f64 = 0.25;

impl Planned {
    /// Follows and times.
    ///
    /// # Errors
    /// If there is no start, or the timing finds no answer.
    pub fn new(
        description: &Description,
        robot: &Robot<f64>,
        request: Request,
        limits: Option<Limits>,
        arguments: &PathArguments,
    ) -> Result<Self, Failure> {
        match request {
            Request::Joints(points) => joints(description, points, limits, arguments),
            Request::Hand { path, start, words } => {
                let mut follower = Follower::new(description)
                    .map_err(|why| unprepared(description, &arguments.robot.robot, &why))?;
                hand(robot, &mut follower, (path, start, words), limits, arguments)
            }
        }
    }

    /// Whether the path is followed to its end within the limits.
    pub fn verdict(&self) -> Result<(), Failure> {
        match &self.followed {
            Some(f) if f.reached < 1.0 => Err(Failure::No(format!(
                "the path cannot be followed beyond {} % of its way",
                crate::terminal::decimals(100.0 * f.reached, 4)
            ))),
            Some(f) if !f.is_clean() => Err(Failure::No("the path leaves the limits of the joints".into())),
            _ => Ok(()),
        }
    }
}

fn refused(e: MotionError) -> Failure {
    Failure::No(e.to_string())
}

fn joints(
    description: &Description,
    points: Vec<Vec<f64>>,
    limits: Option<Limits>,
    arguments: &PathArguments,
) -> Result<Planned, Failure> {
    let n = description.variables().len();
    let is_one = points.len() == 2;
    let words = match is_one {
        true => "joint move".to_string(),
        false if arguments.blend.is_some() => {
            format!("straight joint moves past {} way-points", points.len())
        }
        false => format!("joint spline through {} way-points", points.len()),
    };
    let (trajectory, timing): (Box<dyn Trajectory>, String) = match (&limits, arguments.law) {
        (None, _) => {
            // Without limits a duration; with it the law of the whole.
            let duration = arguments.duration.unwrap_or(1.0);
            let path = through(&points, arguments.blend)?;
            let timed = InTime::new(path, duration).map_err(refused)?;
            (Box::new(timed), format!("a quintic law over {duration} s (no limits are known)"))
        }
        (Some(limits), law) if is_one => {
            let law = law.unwrap_or(if limits.jerk().is_some() {
                LawName::JerkLimited
            } else {
                LawName::Trapezoidal
            });
            if law == LawName::JerkLimited && limits.jerk().is_some() {
                let [a, b] = [0, 1].map(|k| JointState::at_rest(&points[k]));
                let found = move_within_limits(&a, &b, limits).map_err(refused)?;
                (Box::new(found), "the fastest within velocity, acceleration and jerk limits".into())
            } else {
                let found = synchronised(&points[0], &points[1], limits, law.into()).map_err(refused)?;
                (Box::new(found), format!("{} law, all joints together, within the limits", law.words()))
            }
        }
        (Some(limits), _) => timed(through(&points, arguments.blend)?, limits)?,
    };
    let space = JointSpace::new(description, 1.0);
    let outside = (0..n).find(|&j| {
        let out = |x: f64| space.limits[j].is_some_and(|[low, high]| x < low - 1e-9 || x > high + 1e-9);
        points.iter().any(|p| out(p[j]))
    });
    if let Some(j) = outside {
        let name = description.variables()[j].symbol.name().to_string();
        return Err(Failure::No(format!("a way-point has {name} outside of its limits")));
    }
    Ok(Planned { trajectory, words, timing, followed: None, alternatives: vec![] })
}

/// A smooth curve through way-points, or straight lines between them with rounded corners.
fn through(points: &[Vec<f64>], blend: Option<f64>) -> Result<PiecewisePath, Failure> {
    match blend {
        Some(distance) if points.len() > 2 => {
            blended(points, &vec![distance; points.len() - 2], Blend::Quintic).map_err(refused)
        }
        _ => cubic_spline(points, &Ends::Natural).map_err(refused),
    }
}

/// The fastest timing of a path.
fn timed<P: JointPath + 'static>(path: P, limits: &Limits) -> Result<(Box<dyn Trajectory>, String), Failure> {
    if limits.jerk().is_some() {
        let found = JerkLimited::default().time(path, limits).map_err(refused)?;
        return Ok((Box::new(found), "fast, within velocity, acceleration and jerk limits".into()));
    }
    let found = TimeOptimal::default().time(path, limits).map_err(refused)?;
    Ok((Box::new(found), "time-optimal within velocity and acceleration limits".into()))
}

fn hand(
    robot: &Robot<f64>,
    follower: &mut Follower,
    (path, start, words): (Box<dyn HandPath + Send + Sync>, Option<Vec<f64>>, String),
    limits: Option<Limits>,
    arguments: &PathArguments,
) -> Result<Planned, Failure> {
    let mut options = Options::default();
    if let Some(deviation) = arguments.max_deviation {
        options.max_deviation = deviation;
    }
    let alternatives = if arguments.alternatives || start.is_none() {
        follower.alternatives(&*path, &options)
    } else {
        vec![]
    };
    let start = match start {
        Some(q) => q,
        // The branch that goes furthest, within the limits, past the fewest singular configurations.
        None => alternatives
            .iter()
            .max_by(|a, b| {
                let key =
                    |x: &Alternative| (x.reached >= 1.0, x.within_limits, std::cmp::Reverse(x.singular));
                key(a).cmp(&key(b)).then(a.reached.total_cmp(&b.reached))
            })
            .map(|a| a.start.clone())
            .ok_or_else(|| Failure::No("the start of the path is out of reach".into()))?,
    };
    let mut followed = follower.follow(&*path, &start, &options);
    let mut alternatives = alternatives;
    if !followed.is_clean() && alternatives.is_empty() {
        alternatives = follower.alternatives(&*path, &options);
    }
    let (trajectory, timing): (Box<dyn Trajectory>, String) = if followed.reached <= 0.0 {
        (Box::new(Still(start)), "it does not start".into())
    } else {
        match &limits {
            Some(limits) if limits.jerk().is_some() => {
                let smooth = smooth(robot, &*path, &mut followed)?;
                timed(smooth, limits)?
            }
            Some(limits) => timed(followed.joints.clone(), limits)?,
            None => {
                let length = path.length() * followed.reached;
                let duration = arguments.duration.unwrap_or((length / SPEED).max(0.5));
                let timing = match arguments.duration {
                    Some(_) => format!("a quintic law over {duration} s"),
                    None => {
                        format!("a quintic law at {SPEED} m/s on the average (no joint limits are known)")
                    }
                };
                (Box::new(InTime::new(followed.joints.clone(), duration).map_err(refused)?), timing)
            }
        }
    };
    Ok(Planned { trajectory, words, timing, followed: Some(followed), alternatives })
}

/// A path without jumps of q'', through the same samples; how far the hand then leaves its path is measured again.
fn smooth(
    robot: &Robot<f64>,
    path: &dyn HandPath,
    followed: &mut Followed,
) -> Result<impl JointPath + 'static, Failure> {
    let (s, samples) = (followed.joints.parameters(), followed.joints.samples());
    let last = s.len() - 1;
    let ends = Ends::Clamped(followed.joints.eval(0.0).dq, followed.joints.eval(s[last]).dq);
    let spline = cubic_spline_at(s, samples, &ends).map_err(refused)?;
    let places = s.windows(2).flat_map(|w| (1..8).map(move |k| w[0] + (w[1] - w[0]) * f64::from(k) / 8.0));
    let away =
        places.map(|at| (robot.pose(&spline.eval(at).q).translation - path.pose(at).translation).norm());
    followed.deviation = away.fold(0.0, f64::max);
    Ok(spline)
}

/// A path run through by a quintic law.
struct InTime<P> {
    path: P,
    law: Polynomial,
}

impl<P: JointPath> InTime<P> {
    fn new(path: P, duration: f64) -> Result<Self, MotionError> {
        let law = Polynomial::quintic([0.0; 3], [path.end(), 0.0, 0.0], duration)?;
        Ok(InTime { path, law })
    }
}

impl<P: JointPath> Trajectory for InTime<P> {
    fn dof(&self) -> usize {
        self.path.dof()
    }

    fn duration(&self) -> f64 {
        self.law.duration()
    }

    fn eval(&self, t: f64) -> JointState {
        let at = self.law.at(t);
        let point = self.path.eval(at.position);
        let pairs = point.dq.iter().zip(&point.ddq);
        JointState {
            qd: point.dq.iter().map(|d| d * at.velocity).collect(),
            qdd: pairs.map(|(d, dd)| d * at.acceleration + dd * at.velocity * at.velocity).collect(),
            q: point.q,
        }
    }
}

/// No motion at all.
struct Still(Vec<f64>);

impl Trajectory for Still {
    fn dof(&self) -> usize {
        self.0.len()
    }

    fn duration(&self) -> f64 {
        0.0
    }

    fn eval(&self, _: f64) -> JointState {
        JointState::at_rest(&self.0)
    }
}

impl From<LawName> for Law {
    fn from(name: LawName) -> Self {
        match name {
            LawName::Cubic => Law::Cubic,
            LawName::Quintic => Law::Quintic,
            LawName::Trapezoidal => Law::Trapezoidal,
            LawName::JerkLimited => Law::DoubleS,
        }
    }
}
