//! The tool point and its velocities on walks along the chain, in buffers that are used again.

use crate::geometry::Vector;
use crate::mechanism::{self, Line, Reference, Robot, Twist};

/// A robot to walk along, and what the last walk found; all in the base.
pub(super) struct Walk {
    robot: Robot<f64>,
    places: mechanism::Walk<f64>,
    twists: Vec<Twist<f64>>,
    /// The tool point, metres.
    pub point: Vector<f64>,
}

impl Walk {
    /// That of a robot, before any walk.
    pub fn new(robot: &Robot<f64>) -> Self {
        let twists = vec![[Vector::zero(); 2]; robot.joints];
        Walk { places: mechanism::Walk::new(robot), robot: robot.clone(), twists, point: Vector::zero() }
    }

    /// Finds the tool point and its velocities at a configuration.
    pub fn to(&mut self, q: &[f64]) {
        self.places.to(&self.robot, q, Reference::Base);
        self.point = self.places.place(Reference::Tool).translation;
        self.places.twists(&self.robot, Reference::Tool, self.point, &mut self.twists);
    }

    /// The velocity of the tool point for a unit of each joint's velocity (m/rad; without unit for a slide).
    pub fn velocities(&self) -> impl Iterator<Item = Vector<f64>> {
        self.twists.iter().map(|t| t[0])
    }

    /// The axis of a row.
    pub fn axis(&self, row: usize) -> Line<f64> {
        self.places.axes()[row]
    }

    /// The only row that a joint stands in, if there is but one.
    pub fn row_of(&self, joint: usize) -> Option<usize> {
        let links = self.robot.links.iter().enumerate();
        let mut rows = links
            .flat_map(|(i, l)| l.movers().filter(|m| m.joint == joint && m.factor != 0.0).map(move |_| i));
        rows.next().filter(|_| rows.next().is_none())
    }
}
