//! Geometric paths q(s) of all joints: where to go, not when.
//!
//! The parameter s runs from 0 to [`JointPath::end`]. Derivatives are by s: q', q'', q'''.

mod blended;
mod cubic_spline;
mod piecewise;
mod quintic_spline;
mod way_points;

pub use blended::{Blend, blended};
pub use cubic_spline::{Ends, cubic_spline, cubic_spline_at};
pub use piecewise::PiecewisePath;
pub use quintic_spline::{QuinticEnds, quintic_spline, quintic_spline_at};
pub use way_points::chord_lengths;

/// From which side a parameter is approached, where a derivative jumps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// From lower parameters.
    Before,
    /// From higher parameters.
    Behind,
}

/// A point of a path, one entry a joint in each list.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PathPoint {
    /// Positions q.
    pub q: Vec<f64>,
    /// First derivatives q'.
    pub dq: Vec<f64>,
    /// Second derivatives q''.
    pub ddq: Vec<f64>,
    /// Third derivatives q'''; zeros if [`JointPath::has_third_derivative`] says no.
    pub dddq: Vec<f64>,
}

impl PathPoint {
    /// Zeros for `dof` joints.
    pub fn zeros(dof: usize) -> Self {
        let zeros = || vec![0.0; dof];
        Self { q: zeros(), dq: zeros(), ddq: zeros(), dddq: zeros() }
    }
}

/// A path of all joints.
pub trait JointPath: Send + Sync {
    /// The number of joints.
    fn dof(&self) -> usize;

    /// The parameter at the end; it is 0 at the start.
    fn end(&self) -> f64;

    /// Writes the point at `s` (the nearest end outside the path); lists of `point` have one entry a joint.
    fn eval_into(&self, s: f64, side: Side, point: &mut PathPoint);

    /// The point at `s`, and its derivatives behind it where they jump.
    fn eval(&self, s: f64) -> PathPoint {
        let mut point = PathPoint::zeros(self.dof());
        self.eval_into(s, Side::Behind, &mut point);
        point
    }

    /// Parameters between the ends at which q', q'' or q''' may jump, increasing.
    fn knots(&self) -> &[f64] {
        &[]
    }

    /// Whether q''' is known.
    fn has_third_derivative(&self) -> bool {
        true
    }
}

impl<P: JointPath + ?Sized> JointPath for &P {
    fn dof(&self) -> usize {
        (**self).dof()
    }

    fn end(&self) -> f64 {
        (**self).end()
    }

    fn eval_into(&self, s: f64, side: Side, point: &mut PathPoint) {
        (**self).eval_into(s, side, point);
    }

    fn knots(&self) -> &[f64] {
        (**self).knots()
    }

    fn has_third_derivative(&self) -> bool {
        (**self).has_third_derivative()
    }
}
