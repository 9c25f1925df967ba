//! Where the tool comes to.

use crate::refusal::Refusal;
use crate::subject::Subject;
use denavit::geometry::Vector;
use denavit::workspace::{Section, Workspace};
use serde::Serialize;

/// A section of where the tool comes to, in the base.
#[derive(Serialize)]
pub struct Reached {
    /// What is filled, square metres.
    area: f64,
    axis: Option<Axis>,
    boundary: Vec<Vec<[f64; 2]>>,
    cells: Vec<Cell>,
    first: [f64; 3],
    /// What the coordinates are called.
    names: [&'static str; 2],
    origin: [f64; 3],
    remarks: Vec<String>,
    /// Whether the section turns about the axis.
    revolves: bool,
    second: [f64; 3],
    /// Of a cell.
    size: [f64; 2],
}

/// A point of an axis, and its direction.
#[derive(Serialize)]
struct Axis {
    along: [f64; 3],
    at: [f64; 3],
}

/// A place that is reached.
#[derive(Serialize)]
struct Cell {
    at: [f64; 2],
    /// Manipulability, from 0 to 1.
    value: f64,
}

/// A section of the workspace.
///
/// # Errors
/// If there is none to show.
pub fn workspace(subject: &Subject) -> Result<Reached, Refusal> {
    let found =
        Workspace::new(&subject.robot, &subject.space).map_err(|why| Refusal::new(why.to_string()))?;
    let Plane { origin, directions: [first, second], axis } = Plane::of(&found.section);
    let cells = (0..found.grid.len()).filter_map(|k| {
        let value = found.manipulability[k]?;
        Some(Cell { at: found.grid.centre(k), value })
    });
    let mut remarks = vec![];
    for (all, what) in [(&found.assumed, "is taken to slide"), (&found.held, "is held")] {
        for one in all {
            let [low, high] = one.range.map(|x| denavit_report::decimals(x, 3));
            let name = subject.valued.variables()[one.joint].symbol.name().to_string();
            remarks.push(match low == high {
                true => format!("{name} {what} at {low} m"),
                false => format!("{name} {what} from {low} m to {high} m"),
            });
        }
    }
    Ok(Reached {
        area: found.area(),
        axis: axis.map(|[at, along]| Axis { along: along.0, at: at.0 }),
        boundary: found.boundary.clone(),
        cells: cells.collect(),
        first: first.0,
        names: found.section.symbols(),
        origin: origin.0,
        remarks,
        revolves: axis.is_some(),
        second: second.0,
        size: [found.grid.side; 2],
    })
}

/// The section's plane: a point, two directions, and the axis that it turns about (a point and a direction).
struct Plane {
    origin: Vector<f64>,
    directions: [Vector<f64>; 2],
    axis: Option<[Vector<f64>; 2]>,
}

impl Plane {
    fn of(section: &Section) -> Self {
        match section {
            Section::ThroughAxis { point, direction, .. } => {
                // Any direction across the axis; x of the base where that is one.
                let is_along = direction.0[0].abs() >= 0.9;
                let rough = if is_along { [0.0, 1.0, 0.0] } else { [1.0, 0.0, 0.0] };
                let across = Vector(rough) - direction.scale(direction.dot(Vector(rough)));
                let across = across.scale(1.0 / across.norm());
                Plane { origin: *point, directions: [across, *direction], axis: Some([*point, *direction]) }
            }
            Section::Plane { directions } | Section::Projection { directions } => {
                Plane { origin: Vector([0.0; 3]), directions: *directions, axis: None }
            }
        }
    }
}
