//! The motion: followed, and timed.

use super::limits::Known;
use super::request::Request;
use crate::arguments::{LawName, PathArguments};
use crate::commands::ik::unprepared;
use crate::commands::jacobian::rate;
use crate::failure::Failure;
use crate::terminal::decimals;
use denavit::Robot;
use denavit::description::Description;
use denavit::inverse::JointSpace;
use denavit::motion::follow::{Alternative, Followed, Follower, Options};
use denavit::motion::hand::HandPath;
use denavit::motion::path::{Blend, Ends, JointPath, PiecewisePath, blended, cubic_spline, cubic_spline_at};
use denavit::motion::profile::{Law, synchronised};
use denavit::motion::{
    InTime, JerkLimited, JointState, Limits, MotionError, Slowed, TimeOptimal, Trajectory, move_within_limits,
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

impl Planned {
    /// Follows and times.
    ///
    /// # Errors
    /// If there is no start, or the timing finds no answer.
    pub fn new(
        description: &Description,
        robot: &Robot<f64>,
        request: Request,
        limits: Known,
        arguments: &PathArguments,
    ) -> Result<Self, Failure> {
        match request {
            Request::Joints(points) => joints(description, points, limits, arguments),
            Request::Hand { path, start, words } => {
                let mut follower = Follower::new(description)
                    .map_err(|why| unprepared(description, &arguments.robot.robot, &why))?;
                hand(description, robot, &mut follower, (path, start, words), limits, arguments)
            }
        }
    }

    /// Whether the path is followed to its end within the limits.
    pub fn verdict(&self) -> Result<(), Failure> {
        match &self.followed {
            Some(f) if f.reached < 1.0 => Err(Failure::No(format!(
                "the path cannot be followed beyond {} % of its way",
                decimals(100.0 * f.reached, 4)
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
    limits: Known,
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
    let (trajectory, timing): (Box<dyn Trajectory>, String) = match (&limits.all, arguments.law) {
        (None, _) => {
            let path = through(&points, arguments.blend)?;
            by_quintic(description, path, (1.0, arguments.duration), limits.velocity.as_deref())?
        }
        (Some(limits), law) if is_one => {
            let law = law.unwrap_or(if limits.jerk().is_some() {
                LawName::JerkLimited
            } else {
                LawName::Trapezoidal
            });
            let found: (Box<dyn Trajectory>, String) =
                if law == LawName::JerkLimited && limits.jerk().is_some() {
                    let [a, b] = [0, 1].map(|k| JointState::at_rest(&points[k]));
                    let found = move_within_limits(&a, &b, limits).map_err(refused)?;
                    (Box::new(found), "the fastest within velocity, acceleration and jerk limits".into())
                } else {
                    let found = synchronised(&points[0], &points[1], limits, law.into()).map_err(refused)?;
                    (Box::new(found), format!("{} law, all joints together, within the limits", law.words()))
                };
            over_duration(found, arguments.duration)?
        }
        (Some(limits), _) => {
            over_duration(timed(through(&points, arguments.blend)?, limits)?, arguments.duration)?
        }
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
    description: &Description,
    robot: &Robot<f64>,
    follower: &mut Follower,
    (path, start, words): (Box<dyn HandPath + Send + Sync>, Option<Vec<f64>>, String),
    limits: Known,
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
        // The branch that goes furthest, within the limits, past the fewest singular configurations; of equals the first.
        None => alternatives
            .iter()
            .rev()
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
        match &limits.all {
            Some(limits) if limits.jerk().is_some() => {
                let smooth = smooth(robot, &*path, &mut followed)?;
                over_duration(timed(smooth, limits)?, arguments.duration)?
            }
            Some(limits) => over_duration(timed(followed.joints.clone(), limits)?, arguments.duration)?,
            None => {
                let usual = (path.length() * followed.reached / arguments.speed).max(0.5);
                let velocity = limits.velocity.as_deref();
                by_quintic(description, followed.joints.clone(), (usual, arguments.duration), velocity)?
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

/// A path by a quintic law: over the duration asked for, or the usual one, longer if velocities are limited.
fn by_quintic<P: JointPath + Clone + 'static>(
    description: &Description,
    path: P,
    (usual, asked): (f64, Option<f64>),
    velocity: Option<&[f64]>,
) -> Result<(Box<dyn Trajectory>, String), Failure> {
    let duration = asked.unwrap_or(usual);
    let timed = InTime::new(path.clone(), duration).map_err(refused)?;
    let variables = description.variables();
    let name = |j: usize| variables[j].symbol.name();
    let fastest = timed.fastest();
    let Some(limits) = velocity else {
        let most = fastest.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1));
        let most = most.map(|(j, v)| {
            format!("; the fastest joint, {}, turns at {}", name(j), rate(*v, variables[j].kind))
        });
        let words = format!(
            "a quintic law over {} s, no limits are known{}",
            decimals(duration, 4),
            most.unwrap_or_default()
        );
        return Ok((Box::new(timed), words));
    };
    let over = fastest.iter().zip(limits).map(|(v, l)| v / l).enumerate();
    let (joint, ratio) = over.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0, 0.0));
    match asked {
        Some(d) if ratio > 1.0 + 1e-9 => Err(Failure::No(format!(
            "--duration {d}: {} would turn at {}, its limit is {}; {} s are needed",
            name(joint),
            rate(fastest[joint], variables[joint].kind),
            rate(limits[joint], variables[joint].kind),
            decimals(d * ratio, 4)
        ))),
        _ => {
            let needed = duration * ratio.max(if asked.is_some() { 1.0 } else { 1e-6 });
            let duration = if asked.is_some() { duration } else { needed.max(usual) };
            let words = format!(
                "a quintic law over {} s within the velocity limits, no accelerations are known",
                decimals(duration, 4)
            );
            Ok((Box::new(InTime::new(path, duration).map_err(refused)?), words))
        }
    }
}

/// A motion that takes longer, or as long as it does.
fn over_duration(
    (motion, words): (Box<dyn Trajectory>, String),
    asked: Option<f64>,
) -> Result<(Box<dyn Trajectory>, String), Failure> {
    let own = motion.duration();
    match asked {
        None => Ok((motion, words)),
        Some(d) if d < own * (1.0 - 1e-9) => {
            Err(Failure::No(format!("--duration {d}: the limits allow no less than {} s", decimals(own, 4))))
        }
        Some(d) => {
            let factor = if own > 0.0 { d / own } else { 1.0 };
            Ok((Box::new(Slowed::new(motion, factor)), format!("{words}, slowed down to {d} s")))
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
