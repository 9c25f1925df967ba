//! Cubic and quintic time laws (Biagiotti & Melchiorri 2008, §2.1.4 and §2.1.7; Craig, *Introduction to Robotics*, §7.3).

use super::{Profile, Sample};
use crate::motion::error::{MotionError, finite, positive};

/// A polynomial in time of degree five at most.
#[derive(Clone, Debug, PartialEq)]
pub struct Polynomial {
    /// Coefficients of 1, t, t², …
    coefficients: [f64; 6],
    duration: f64,
}

impl Polynomial {
    /// The cubic from one position to another in `duration` seconds, with the velocities given at its ends.
    ///
    /// # Errors
    /// If a number is not finite, or the duration not positive.
    pub fn cubic(positions: [f64; 2], velocities: [f64; 2], duration: f64) -> Result<Self, MotionError> {
        finite("end states", &[positions, velocities].concat())?;
        positive("duration", &[duration])?;
        let (t, [v0, v1]) = (duration, velocities);
        let distance = positions[1] - positions[0];
        let c2 = (3.0 * distance - (2.0 * v0 + v1) * t) / (t * t);
        let c3 = (-2.0 * distance + (v0 + v1) * t) / (t * t * t);
        Ok(Self { coefficients: [positions[0], v0, c2, c3, 0.0, 0.0], duration })
    }

    /// The quintic between two states (position, velocity, acceleration) in `duration` seconds.
    ///
    /// # Errors
    /// If a number is not finite, or the duration not positive.
    pub fn quintic(from: [f64; 3], to: [f64; 3], duration: f64) -> Result<Self, MotionError> {
        finite("end states", &[from, to].concat())?;
        positive("duration", &[duration])?;
        Ok(Self { coefficients: hermite(from, to, duration), duration })
    }

    /// The fastest cubic from rest to rest with these greatest velocity and acceleration:
    /// T = max(3d / 2v, √(6d / a)).
    ///
    /// # Errors
    /// If a number is not finite, or a limit not positive.
    pub fn fastest_cubic(
        from: f64,
        to: f64,
        max_velocity: f64,
        max_acceleration: f64,
    ) -> Result<Self, MotionError> {
        positive("limits", &[max_velocity, max_acceleration])?;
        finite("end states", &[from, to])?;
        let d = (to - from).abs();
        let duration = (1.5 * d / max_velocity).max((6.0 * d / max_acceleration).sqrt());
        if duration == 0.0 {
            return Ok(Self::constant(from, 0.0));
        }
        Self::cubic([from, to], [0.0; 2], duration)
    }

    /// The fastest quintic from rest to rest with these greatest velocity, acceleration and, where given, jerk:
    /// T = max(15d / 8v, √(10d / √3 a), ∛(60d / j)).
    ///
    /// # Errors
    /// If a number is not finite, or a limit not positive.
    pub fn fastest_quintic(
        from: f64,
        to: f64,
        max_velocity: f64,
        max_acceleration: f64,
        max_jerk: Option<f64>,
    ) -> Result<Self, MotionError> {
        positive("limits", &[max_velocity, max_acceleration, max_jerk.unwrap_or(1.0)])?;
        finite("end states", &[from, to])?;
        let d = (to - from).abs();
        let duration = (1.875 * d / max_velocity)
            .max((10.0 / 3.0f64.sqrt() * d / max_acceleration).sqrt())
            .max(max_jerk.map_or(0.0, |j| (60.0 * d / j).cbrt()));
        if duration == 0.0 {
            return Ok(Self::constant(from, 0.0));
        }
        Self::quintic([from, 0.0, 0.0], [to, 0.0, 0.0], duration)
    }

    /// At rest at `position` for `duration` seconds.
    pub(super) fn constant(position: f64, duration: f64) -> Self {
        Self { coefficients: [position, 0.0, 0.0, 0.0, 0.0, 0.0], duration }
    }

    /// The same positions, slower by `factor`: velocities become 1/factor, accelerations 1/factor², and so on.
    pub(super) fn slowed(mut self, factor: f64) -> Self {
        let mut power = 1.0;
        for c in &mut self.coefficients {
            *c /= power;
            power *= factor;
        }
        self.duration *= factor;
        self
    }
}

impl Profile for Polynomial {
    fn duration(&self) -> f64 {
        self.duration
    }

    fn at(&self, t: f64) -> Sample {
        let t = t.clamp(0.0, self.duration);
        let [c0, c1, c2, c3, c4, c5] = self.coefficients;
        Sample {
            position: c0 + t * (c1 + t * (c2 + t * (c3 + t * (c4 + t * c5)))),
            velocity: c1 + t * (2.0 * c2 + t * (3.0 * c3 + t * (4.0 * c4 + t * 5.0 * c5))),
            acceleration: 2.0 * c2 + t * (6.0 * c3 + t * (12.0 * c4 + t * 20.0 * c5)),
            jerk: 6.0 * c3 + t * (24.0 * c4 + t * 60.0 * c5),
        }
    }
}

/// Coefficients of the quintic on [0, t] between two states (value, first and second derivative).
pub(in crate::motion) fn hermite([p0, v0, a0]: [f64; 3], [p1, v1, a1]: [f64; 3], t: f64) -> [f64; 6] {
    let (d, t2) = (p1 - p0, t * t);
    let c3 = (20.0 * d - (8.0 * v1 + 12.0 * v0) * t - (3.0 * a0 - a1) * t2) / (2.0 * t2 * t);
    let c4 = (-30.0 * d + (14.0 * v1 + 16.0 * v0) * t + (3.0 * a0 - 2.0 * a1) * t2) / (2.0 * t2 * t2);
    let c5 = (12.0 * d - 6.0 * (v1 + v0) * t - (a0 - a1) * t2) / (2.0 * t2 * t2 * t);
    [p0, v0, a0 / 2.0, c3, c4, c5]
}
