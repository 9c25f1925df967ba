//! Where the tool comes to.

use crate::refusal::Refusal;
use crate::subject::Subject;
use denavit::geometry::Vector;
use denavit::workspace::{Section, Workspace};
use serde_json::{Value, json};

/// A section of the workspace.
///
/// # Errors
/// If there is none to show.
pub fn workspace(subject: &Subject) -> Result<Value, Refusal> {
    let found =
        Workspace::new(&subject.robot, &subject.space).map_err(|why| Refusal::new(why.to_string()))?;
    let Plane { origin, directions: [first, second], axis } = Plane::of(&found.section);
    let cells = (0..found.grid.len()).filter_map(|k| {
        let value = found.manipulability[k]?;
        Some(json!({ "at": found.grid.centre(k), "value": value }))
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
    Ok(json!({
        "origin": origin.0,
        "first": first.0,
        "second": second.0,
        "revolves": axis.is_some(),
        "axis": axis.map(|[at, along]| json!({ "at": at.0, "along": along.0 })),
        "names": found.section.symbols(),
        "boundary": found.boundary,
        "cells": cells.collect::<Vec<_>>(),
        "size": [found.grid.side, found.grid.side],
        "remarks": remarks,
        "area": found.area(),
    }))
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
