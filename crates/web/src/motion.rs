//! Paths through way-points: planned stretch by stretch, sampled for drawings and plots.

use crate::refusal::Refusal;
use crate::solve;
use crate::subject::Subject;
use crate::words;
use denavit::dynamics::drive_torques;
use denavit::geometry::{Transform, Vector};
use denavit::motion::follow::Event;
use denavit::motion::hand::{Arc, HandChain, HandPath, Line, Orientation};
use denavit::motion::plan::{Course, KnownLimits, PlanOptions, Planned, Verdict, Wish as Stretch};
use denavit::velocity::{Viewpoint, Whole, geometric};
use denavit_report::words::Motion as _;
use denavit_wire::path::{Start, kind};
use denavit_wire::pose::{Matrix, matrix};
use serde::{Deserialize, Serialize};

/// A path that is asked for.
#[derive(Deserialize)]
pub struct Wish {
    start: Vec<f64>,
    points: Vec<Point>,
    duration: Option<f64>,
    speed: Option<f64>,
    samples: usize,
}

/// Where to go, and how.
#[derive(Deserialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
enum Point {
    Joint { q: Vec<f64> },
    Line { pose: Vec<Vec<f64>> },
    Arc { via: [f64; 3], pose: Vec<Vec<f64>> },
}

/// The most samples of a path, and way-points.
const MOST: [usize; 2] = [5_000, 200];

/// A path, sample by sample.
#[derive(Serialize)]
pub struct Path {
    /// Seconds.
    pub duration: f64,
    /// Of an arm that falls.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub energy: Option<Energies>,
    /// What is met on the way.
    pub events: Vec<Met>,
    /// Lengths by the reach.
    pub manipulability: Vec<f64>,
    /// What path it is, in words.
    pub path: String,
    /// Of the tool.
    pub pose: Vec<Matrix>,
    /// The joints.
    pub q: Vec<Vec<f64>>,
    /// The part of the way that could be followed, 1 if all.
    pub reached: f64,
    /// Where the first stretch of the hand can start.
    pub starts: Vec<Start>,
    /// Seconds.
    pub t: Vec<f64>,
    /// How it was timed, in words.
    pub timing: String,
    /// Of the drives, N·m and N; nothing where no masses are known, or nothing drives.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub torque: Option<Vec<Vec<f64>>>,
    /// The joints' rates.
    pub velocity: Vec<Vec<f64>>,
}

/// Energies sample by sample, joules.
#[derive(Serialize)]
pub struct Energies {
    /// Of the motion.
    pub kinetic: Vec<f64>,
    /// What friction has taken since the start.
    pub lost: Vec<f64>,
    /// Of the height, since the start.
    pub potential: Vec<f64>,
}

/// What is met on the way.
#[derive(Serialize)]
pub struct Met {
    /// Which: a singular configuration, a limit.
    pub kind: &'static str,
    /// Seconds.
    pub t: f64,
    /// What.
    pub words: String,
}

/// What the stretches of a path come to.
#[derive(Default)]
struct Sampled {
    times: Vec<f64>,
    q: Vec<Vec<f64>>,
    velocity: Vec<Vec<f64>>,
    acceleration: Vec<Vec<f64>>,
    events: Vec<Met>,
    starts: Vec<Start>,
    words: Vec<String>,
    timing: Vec<String>,
    /// How much of all stretches was gone.
    reached: f64,
    /// Whether a stretch could not be gone to its end.
    stopped: bool,
}

/// Plans a path: stretches through joints and stretches of the hand one after the other, the arm at rest between them.
///
/// # Errors
/// If a way-point is none, or a stretch cannot be planned.
pub fn path(subject: &Subject, wish: &Wish) -> Result<Path, Refusal> {
    if wish.points.is_empty() {
        return Err(Refusal::new("the path has no way-points"));
    }
    if wish.points.len() > MOST[1] {
        return Err(Refusal::new(format!("{} way-points; {} are allowed", wish.points.len(), MOST[1])));
    }
    let stretches = stretches(&wish.points);
    let samples = wish.samples.clamp(2, MOST[0]).div_ceil(stretches.len()).max(2);
    let mut here = subject.configuration(&wish.start)?.to_vec();
    let mut found = Sampled::default();
    for stretch in &stretches {
        let share = wish.duration.map(|d| d * stretch.len() as f64 / wish.points.len() as f64);
        let options = PlanOptions {
            duration: share,
            speed: wish.speed.unwrap_or(PlanOptions::default().speed),
            ..PlanOptions::default()
        };
        let asked = asked(subject, &here, stretch)?;
        let limits = KnownLimits::of(&subject.valued);
        let planned = Planned::new(&subject.valued, &subject.robot, asked, &limits, &options)
            .map_err(|why| Refusal::new(why.to_string()))?;
        found.take(subject, &planned, samples);
        found.reached += planned.followed.as_ref().map_or(1.0, |f| f.reached) / stretches.len() as f64;
        if matches!(planned.verdict(), Verdict::Ends(_)) {
            found.stopped = true;
            break;
        }
        here = found.q.last().cloned().unwrap_or(here);
    }
    Ok(found.told(subject))
}

/// Way-points of the joints, and of the hand, that follow each other.
fn stretches(points: &[Point]) -> Vec<&[Point]> {
    points.chunk_by(|a, b| matches!(a, Point::Joint { .. }) == matches!(b, Point::Joint { .. })).collect()
}

fn asked(subject: &Subject, here: &[f64], stretch: &[Point]) -> Result<Stretch, Refusal> {
    if matches!(stretch.first(), Some(Point::Joint { .. })) {
        let mut points = vec![here.to_vec()];
        for point in stretch {
            if let Point::Joint { q } = point {
                points.push(subject.configuration(q)?.to_vec());
            }
        }
        return Ok(Stretch::Joints(points));
    }
    let mut at = subject.robot.pose(here);
    let mut parts: Vec<Box<dyn HandPath + Send + Sync>> = vec![];
    let mut go = |to: Transform<f64>, via: Option<[f64; 3]>| -> Result<(), Refusal> {
        parts.push(match via {
            None => Box::new(Line { from: at, to, orientation: Orientation::Slerp }),
            Some(via) => Box::new(
                Arc::new(at, Vector(via), to).map_err(|why| Refusal::new(format!("the arc: {why}")))?,
            ),
        });
        at = to;
        Ok(())
    };
    for point in stretch {
        match point {
            Point::Line { pose } => go(solve::pose(pose)?, None)?,
            Point::Arc { via, pose } => go(solve::pose(pose)?, Some(*via))?,
            Point::Joint { .. } => {}
        }
    }
    Ok(Stretch::Hand { path: Box::new(HandChain::new(parts)), start: Some(here.to_vec()) })
}

impl Sampled {
    /// Samples a stretch behind those before it.
    fn take(&mut self, subject: &Subject, planned: &Planned, samples: usize) {
        let (motion, start) = (&planned.trajectory, self.times.last().copied().unwrap_or(0.0));
        let duration = motion.duration();
        let first = self.times.len();
        for k in 0..=samples {
            let t = duration * k as f64 / samples as f64;
            let state = motion.eval(t);
            self.times.push(start + t);
            self.q.push(state.q);
            self.velocity.push(state.qd);
            self.acceleration.push(state.qdd);
        }
        for event in planned.followed.iter().flat_map(|f| &f.events) {
            let near = |k: &usize| subject.space.distance(&self.q[*k], &event.q);
            let nearest = (first..self.q.len()).min_by(|a, b| near(a).total_cmp(&near(b)));
            let time = nearest.map_or(start, |k| self.times[k]);
            self.events.push(told(subject, event, time));
        }
        self.words.push(match &planned.course {
            Course::Hand(parts) => words().hand_path(parts.len()),
            course => words().course(course),
        });
        self.timing.push(words().timing(&planned.timing, &subject.description));
        if self.starts.is_empty() {
            self.starts = planned.alternatives.iter().map(Start::from).collect();
        }
    }

    fn told(self, subject: &Subject) -> Path {
        let heavy = subject.heavy().ok().filter(|h| h.is_known);
        let torque = heavy.map(|h| {
            let rates = self.velocity.iter().zip(&self.acceleration);
            self.q.iter().zip(rates).map(|(q, (qd, qdd))| drive_torques(&h.arm, q, qd, qdd, None)).collect()
        });
        Path {
            duration: self.times.last().copied().unwrap_or(0.0),
            energy: None,
            events: self.events,
            manipulability: self.q.iter().map(|q| manipulability(subject, q)).collect(),
            path: self.words.join(", then "),
            pose: self.q.iter().map(|q| matrix(&subject.robot.pose(q))).collect(),
            q: self.q,
            reached: if self.stopped { self.reached } else { 1.0 },
            starts: self.starts,
            t: self.times,
            timing: self.timing.join("; then "),
            torque,
            velocity: self.velocity,
        }
    }
}

/// How well the tool moves, lengths by the arm's reach.
pub fn manipulability(subject: &Subject, q: &[f64]) -> f64 {
    let jacobian = geometric(&subject.robot, q, &Viewpoint::tool());
    Whole::new(&jacobian, &subject.space.is_angle, subject.robot.reach().max(1e-9)).manipulability
}

fn told(subject: &Subject, event: &Event, t: f64) -> Met {
    Met { kind: kind(&event.kind), t, words: words().event(event, &subject.description) }
}
