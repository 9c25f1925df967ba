//! The workspace: where the tool point comes to within the ranges of the joints, as a section to draw.
//!
//! - [`Section`]: the plane it is seen in, chosen by how the axes lie.
//! - [`Workspace`]: cells that are reached, each with a configuration that reaches it and the largest manipulability found
//!   there; the boundary; extremes, polished.
//!
//! A cell is reported only with a configuration that lies in it: what is shown is reached. What is not shown was not found
//! by samples, nor by steps from the cells around. Lengths are metres, angles radians; vectors are given in the base.
//! The work is bounded by counts, the same call gives the same bits.

mod arm;
mod boundary;
mod cells;
mod contour;
mod extremes;
mod section;
mod walk;

pub use arm::Assumed;
pub use cells::Grid;
pub use contour::{Field, area, contours};
pub use extremes::Extremes;
pub use section::Section;

use crate::mechanism::Robot;
use crate::space::JointSpace;
use std::fmt;

/// A section of the reachable workspace.
#[derive(Clone, PartialEq, Debug)]
pub struct Workspace {
    /// The plane.
    pub section: Section,
    /// Slides without limits, and the travel that was assumed for them.
    pub assumed: Vec<Assumed>,
    /// Slides that carry the section elsewhere, held in the middle of their travel.
    pub held: Vec<Assumed>,
    /// The cells.
    pub grid: Grid,
    /// The largest manipulability found in each cell, by the largest of all (0 to 1); none where nothing comes.
    pub manipulability: Vec<Option<f64>>,
    /// What the manipulability was divided by: √det(J Jᵀ) of the tool point's velocity, slides counted by the arm's size
    /// (m³, for an arm in a plane m²; with fewer joints than that √det(Jᵀ J)).
    pub largest_manipulability: f64,
    /// The edge: closed lines in the section's coordinates, what is reached on their left.
    pub boundary: Vec<Vec<[f64; 2]>>,
    /// How far the tool point comes.
    pub extremes: Extremes,
    configurations: Vec<f64>,
    joints: usize,
}

/// Why there is no workspace to show.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum NoWorkspace {
    /// No joint moves the tool point.
    NothingMoves,
    /// A length or a limit is not a finite number, or too large to compute with.
    NotFinite,
}

impl fmt::Display for NoWorkspace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            NoWorkspace::NothingMoves => "no joint moves the tool point",
            NoWorkspace::NotFinite => "a length or a limit is not a finite number",
        })
    }
}

impl std::error::Error for NoWorkspace {}

impl Workspace {
    /// That of a robot within the limits of its joint space: joints without limits turn fully, slides without limits go from
    /// 0 as far as the arm is long (see [`Workspace::assumed`]).
    ///
    /// # Errors
    /// If no joint moves the tool point, or a length or limit is not finite.
    ///
    /// # Panics
    /// If the joint space is not the robot's.
    pub fn new(robot: &Robot<f64>, space: &JointSpace) -> Result<Self, NoWorkspace> {
        assert_eq!([space.limits.len(), space.is_angle.len()], [robot.joints; 2], "one entry per joint");
        let mut arm = arm::Arm::new(robot, space)?;
        let (cells, extremes) = cells::find(&mut arm);
        // Lengths whose squares are too large for a double.
        if ![extremes.first, extremes.second].as_flattened().iter().all(|x| x.is_finite()) {
            return Err(NoWorkspace::NotFinite);
        }
        let boundary = boundary::boundary(&mut arm, &cells);
        let largest = cells.values.iter().flatten().copied().fold(0.0, f64::max);
        let share = |v: f64| if largest > 0.0 { v / largest } else { 0.0 };
        Ok(Workspace {
            section: arm.section,
            assumed: arm.assumed,
            held: arm.held,
            grid: cells.grid,
            manipulability: cells.values.iter().map(|v| v.map(share)).collect(),
            largest_manipulability: largest,
            boundary,
            extremes,
            configurations: cells.configurations,
            joints: robot.joints,
        })
    }

    /// The configuration that reaches a cell with the largest manipulability found; none where nothing comes.
    pub fn configuration(&self, cell: usize) -> Option<&[f64]> {
        self.manipulability.get(cell).copied().flatten()?;
        self.configurations.get(cell * self.joints..(cell + 1) * self.joints)
    }

    /// The area within the boundary, m².
    pub fn area(&self) -> f64 {
        self.boundary.iter().map(|line| area(line)).sum()
    }
}
