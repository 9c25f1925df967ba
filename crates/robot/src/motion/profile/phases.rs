//! Time laws of constant jerk by phases; a trapezoidal one has no jerk, and accelerations that jump.

use super::{Profile, Sample};

/// A stretch of time with constant jerk, and the state at its start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phase {
    /// When it starts (s).
    pub start: f64,
    /// Position, velocity, acceleration there, and the jerk from there on.
    pub state: Sample,
}

/// Phases one after the other.
#[derive(Clone, Debug, PartialEq)]
pub struct Phases {
    phases: Vec<Phase>,
    duration: f64,
}

impl Phases {
    /// No time at all in this state.
    pub(in crate::motion) fn starting_at(position: f64, velocity: f64) -> Self {
        let state = Sample { position, velocity, ..Sample::default() };
        Self { phases: vec![Phase { start: 0.0, state }], duration: 0.0 }
    }

    /// Appends `time` seconds that start with `acceleration` and have this jerk; position and velocity go on.
    pub(in crate::motion) fn push(&mut self, time: f64, acceleration: f64, jerk: f64) {
        if time <= 0.0 {
            return;
        }
        let state = Sample { acceleration, jerk, ..self.end() };
        if self.duration == 0.0 {
            self.phases.clear();
        }
        self.phases.push(Phase { start: self.duration, state });
        self.duration += time;
    }

    /// Appends a phase that starts in the state given, whatever comes before.
    pub(in crate::motion) fn push_state(&mut self, time: f64, state: Sample) {
        if self.duration == 0.0 {
            self.phases.clear();
        }
        self.phases.push(Phase { start: self.duration, state });
        self.duration += time;
    }

    /// The phases, in order.
    pub fn phases(&self) -> &[Phase] {
        &self.phases
    }

    /// The state at the end.
    pub fn end(&self) -> Sample {
        self.at(self.duration)
    }

    /// The same positions, slower by `factor`.
    pub(super) fn slowed(mut self, factor: f64) -> Self {
        for Phase { start, state } in &mut self.phases {
            *start *= factor;
            state.velocity /= factor;
            state.acceleration /= factor * factor;
            state.jerk /= factor * factor * factor;
        }
        self.duration *= factor;
        self
    }

    /// The mirror image: every position `p` becomes `-p`.
    pub(super) fn mirrored(mut self) -> Self {
        for Phase { state, .. } in &mut self.phases {
            *state = Sample {
                position: -state.position,
                velocity: -state.velocity,
                acceleration: -state.acceleration,
                jerk: -state.jerk,
            };
        }
        self
    }
}

impl Profile for Phases {
    fn duration(&self) -> f64 {
        self.duration
    }

    fn at(&self, t: f64) -> Sample {
        let t = t.clamp(0.0, self.duration);
        let k = self.phases.partition_point(|p| p.start <= t).max(1) - 1;
        let Phase { start, state: Sample { position, velocity, acceleration, jerk } } = self.phases[k];
        let t = t - start;
        Sample {
            position: position + t * (velocity + t * (acceleration / 2.0 + t * jerk / 6.0)),
            velocity: velocity + t * (acceleration + t * jerk / 2.0),
            acceleration: acceleration + t * jerk,
            jerk,
        }
    }
}
