//! The motion at regular times.

use crate::failure::Failure;
use denavit::Robot;
use denavit::description::Description;
use denavit::geometry::Transform;
use denavit::inverse::JointSpace;
use denavit::motion::plan::Planned;
use denavit::motion::{JointState, MotionError};
use denavit::velocity::{Viewpoint, Whole, geometric};
use denavit_wire::path as wire;
use std::fmt::Write;

/// Samples a motion has at most where no time between them is given.
const USUAL: f64 = 200.0;

/// A state with what belongs to it.
pub struct Sample {
    /// Seconds.
    pub t: f64,
    pub state: JointState,
    pub pose: Transform<f64>,
    /// √det(J Jᵀ), lengths by the arm's size.
    pub manipulability: f64,
}

/// The motion in samples.
pub struct Sampled {
    pub dt: f64,
    pub samples: Vec<Sample>,
}

impl Sampled {
    /// Every `dt` seconds.
    ///
    /// # Errors
    /// If `dt` is not positive or there are too many samples.
    pub fn new(
        description: &Description,
        robot: &Robot<f64>,
        planned: &Planned,
        dt: Option<f64>,
    ) -> Result<Self, Failure> {
        let space = JointSpace::new(description, robot);
        let size = if space.reach > 0.0 { space.reach } else { 1.0 };
        let duration = planned.trajectory.duration();
        let dt = dt.unwrap_or_else(|| if duration > 0.0 { (duration / USUAL).max(0.001) } else { 0.01 });
        let states =
            planned.trajectory.resample(dt).map_err(|e: MotionError| Failure::Usage(format!("--dt: {e}")))?;
        let sample = |(t, state): (f64, JointState)| {
            let jacobian = geometric(robot, &state.q, &Viewpoint::tool());
            let manipulability = Whole::new(&jacobian, &space.is_angle, size).manipulability;
            Sample { t, pose: robot.pose(&state.q), state, manipulability }
        };
        Ok(Sampled { dt, samples: states.into_iter().map(sample).collect() })
    }

    /// A header, and a line a sample: time, joints, velocities, accelerations, position, rotation row by row,
    /// manipulability.
    pub fn csv(&self, description: &Description) -> String {
        let names: Vec<String> =
            description.variables().iter().map(|v| v.symbol.name().to_string()).collect();
        let mut header = vec!["t".to_string()];
        for suffix in ["", "_velocity", "_acceleration"] {
            header.extend(names.iter().map(|n| format!("{n}{suffix}")));
        }
        header.extend(["x", "y", "z"].map(String::from));
        header.extend((0..9).map(|k| format!("r{}{}", k / 3 + 1, k % 3 + 1)));
        header.push("manipulability".into());
        let mut out = header.join(",") + "\n";
        for s in &self.samples {
            let rotation = s.pose.rotation.rows();
            let values = [s.t]
                .into_iter()
                .chain(s.state.q.iter().copied())
                .chain(s.state.qd.iter().copied())
                .chain(s.state.qdd.iter().copied())
                .chain(s.pose.translation.0)
                .chain(rotation.into_iter().flatten())
                .chain([s.manipulability]);
            // The shortest decimals that read back as the same double.
            let line: Vec<String> = values.map(|x| denavit_wire::text(&(x + 0.0))).collect();
            // Writing to memory does not fail.
            let _ = writeln!(out, "{}", line.join(","));
        }
        out
    }

    /// An object a line.
    pub fn ndjson(&self) -> String {
        self.samples.iter().map(|s| format!("{}\n", denavit_wire::text(&s.wire()))).collect()
    }

    /// As other programs read it.
    pub fn wire(&self) -> Vec<wire::Sample> {
        self.samples.iter().map(Sample::wire).collect()
    }
}

impl Sample {
    fn wire(&self) -> wire::Sample {
        wire::Sample {
            acceleration: self.state.qdd.clone(),
            manipulability: self.manipulability,
            pose: self.pose.matrix(),
            q: self.state.q.clone(),
            t: self.t,
            velocity: self.state.qd.clone(),
        }
    }
}
