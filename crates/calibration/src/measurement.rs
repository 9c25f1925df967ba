//! What is measured of the hand, and what stands still beside the arm for it: the centre of a ball bar, a plane that is touched.
//!
//! A measurement is a few numbers of the hand's pose. Its derivative is taken along a twist of the hand (ω, v), v the velocity of
//! the point that passes the origin of the base.

use denavit::geometry::{Rotation, Transform, Vector};
use denavit_recording::turns::{exp, log};

/// What is measured.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Measurement {
    /// The pose of the tool.
    Pose,
    /// Where a point of the tool is.
    Position,
    /// How the tool is turned.
    Orientation,
    /// How far a point of the tool is from a centre that stands still.
    Distance(Bar),
    /// That a point of the tool touches a plane that stands still.
    Plane,
}

/// What is known of a distance to a centre.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Bar {
    /// It is measured.
    Measured,
    /// It is measured but for a constant.
    Offset,
    /// It is always the same, and known.
    Fixed,
    /// It is always the same, and not known.
    FixedUnknown,
}

impl Measurement {
    /// How many numbers one measurement is.
    pub fn width(self) -> usize {
        match self {
            Measurement::Pose => 6,
            Measurement::Position | Measurement::Orientation => 3,
            Measurement::Distance(_) | Measurement::Plane => 1,
        }
    }

    /// How many of these, the first ones, are turns.
    pub fn turns(self) -> usize {
        if matches!(self, Measurement::Pose | Measurement::Orientation) { 3 } else { 0 }
    }

    /// Whether any of them is a turn.
    pub fn has_turns(self) -> bool {
        self.turns() > 0
    }

    /// Whether any of them is a shift or a distance.
    pub fn has_shifts(self) -> bool {
        self.width() > self.turns()
    }

    /// Whether a point of the tool is measured, and not how it is turned.
    pub fn is_of_point(self) -> bool {
        matches!(self, Measurement::Position | Measurement::Distance(_) | Measurement::Plane)
    }

    /// How many numbers a thing beside the arm has that are not known.
    pub fn of_fixture(self) -> usize {
        match self {
            Measurement::Pose | Measurement::Position | Measurement::Orientation => 0,
            Measurement::Plane | Measurement::Distance(Bar::Measured | Bar::Fixed) => 3,
            Measurement::Distance(Bar::Offset | Bar::FixedUnknown) => 4,
        }
    }

    /// Whether all poses are on one surface.
    pub fn is_on_surface(self) -> bool {
        matches!(self, Measurement::Plane | Measurement::Distance(Bar::Fixed | Bar::FixedUnknown))
    }
}

/// A thing beside the arm: the frame of a plane, its z the normal, or the centre of a bar with its length.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Fixture {
    /// A point of the plane or the centre, and the normal as z.
    pub frame: Transform<f64>,
    /// The length of a bar that is always the same, or the constant of its distances: model = distance − length. Metres.
    pub length: f64,
}

impl Fixture {
    /// Moved by its parameters: a plane is tilted about its x and y, and shifted along z; a centre is shifted, a length grows.
    #[must_use]
    pub fn moved(&self, measurement: Measurement, by: &[f64]) -> Self {
        let Fixture { frame, length } = *self;
        if measurement == Measurement::Plane {
            let turn = frame.rotation * exp(Vector([by[0], by[1], 0.0]));
            let at = frame.translation + frame.rotation.z().scale(by[2]);
            return Fixture { frame: Transform::from_rotation_translation(turn, at), length };
        }
        let at = frame.translation + Vector([by[0], by[1], by[2]]);
        let length = length + by.get(3).copied().unwrap_or(0.0);
        Fixture { frame: Transform::from_rotation_translation(frame.rotation, at), length }
    }

    /// The model's reading for a point: how far it is off the plane, or how much farther from the centre than the length.
    pub fn reading(&self, measurement: Measurement, point: Vector<f64>) -> f64 {
        let from = point - self.frame.translation;
        if measurement == Measurement::Plane {
            self.frame.rotation.z().dot(from)
        } else {
            from.norm() - self.length
        }
    }

    /// The direction in which the reading grows fastest.
    pub fn gradient(&self, measurement: Measurement, point: Vector<f64>) -> Vector<f64> {
        if measurement == Measurement::Plane {
            return self.frame.rotation.z();
        }
        let from = point - self.frame.translation;
        from.scale(1.0 / from.norm().max(1e-300))
    }

    /// How the reading changes with its own parameters.
    pub fn derivatives(&self, measurement: Measurement, point: Vector<f64>) -> Vec<f64> {
        let from = point - self.frame.translation;
        let [x, y, z] = [self.frame.rotation.x(), self.frame.rotation.y(), self.frame.rotation.z()];
        if measurement == Measurement::Plane {
            return vec![x.cross(z).dot(from), y.cross(z).dot(from), -1.0];
        }
        let u = self.gradient(measurement, point);
        [-u[0], -u[1], -u[2], -1.0][..measurement.of_fixture()].to_vec()
    }

    /// Its parameters for a motion of everything by a twist (ω, v).
    pub fn carried(&self, measurement: Measurement, twist: &[f64; 6]) -> Vec<f64> {
        let (w, v) = halves(twist);
        let at = v + w.cross(self.frame.translation);
        let r = self.frame.rotation;
        if measurement == Measurement::Plane {
            return vec![r.x().dot(w), r.y().dot(w), r.z().dot(at)];
        }
        [at[0], at[1], at[2], 0.0][..measurement.of_fixture()].to_vec()
    }
}

/// ω and v.
pub fn halves(twist: &[f64; 6]) -> (Vector<f64>, Vector<f64>) {
    (Vector([twist[0], twist[1], twist[2]]), Vector([twist[3], twist[4], twist[5]]))
}

/// How the numbers of a measurement change when the hand moves by a twist: turns in the hand's own frame, shifts in the base.
pub fn seen(
    measurement: Measurement,
    hand: &Transform<f64>,
    fixture: Option<&Fixture>,
    twist: &[f64; 6],
    out: &mut [f64],
) {
    let (w, v) = halves(twist);
    let at = v + w.cross(hand.translation);
    match measurement {
        Measurement::Pose => {
            let turn = hand.rotation.inverse() * w;
            out[..3].copy_from_slice(&turn.0);
            out[3..6].copy_from_slice(&at.0);
        }
        Measurement::Position => out[..3].copy_from_slice(&at.0),
        Measurement::Orientation => out[..3].copy_from_slice(&(hand.rotation.inverse() * w).0),
        Measurement::Distance(_) | Measurement::Plane => {
            out[0] = fixture.map_or(0.0, |f| f.gradient(measurement, hand.translation).dot(at));
        }
    }
}

/// One measured row.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Reading {
    /// How the tool is turned, where that is measured.
    pub turn: Rotation<f64>,
    /// Where it is, where that is measured.
    pub at: Vector<f64>,
    /// A distance; 0 where a surface is touched.
    pub distance: f64,
    /// Which of the planes or centres it belongs to.
    pub group: usize,
}

/// What is measured less what the model says.
pub fn residual(
    measurement: Measurement,
    hand: &Transform<f64>,
    fixture: Option<&Fixture>,
    reading: &Reading,
    out: &mut [f64],
) {
    let turn = || log(&(hand.rotation.inverse() * reading.turn)).0;
    let shift = || (reading.at - hand.translation).0;
    match measurement {
        Measurement::Pose => {
            out[..3].copy_from_slice(&turn());
            out[3..6].copy_from_slice(&shift());
        }
        Measurement::Position => out[..3].copy_from_slice(&shift()),
        Measurement::Orientation => out[..3].copy_from_slice(&turn()),
        Measurement::Distance(_) | Measurement::Plane => {
            out[0] = reading.distance - fixture.map_or(0.0, |f| f.reading(measurement, hand.translation));
        }
    }
}
