//! A pose as it stands on a command line or in a line of JSON.

use crate::failure::Failure;
use crate::load;
use denavit::description::Measure;
use denavit::geometry::orientation::{OrientationSet, rotation};
use denavit::geometry::{Rotation, Transform, Vector};
use denavit::inverse::Goal;
use serde_json::Value;

/// `x, y, z, roll, pitch, yaw` or another set of angles, or a matrix of three or four rows.
///
/// # Errors
/// If the text is neither.
pub fn read(text: &str, orientation: &str, goal: Goal) -> Result<Transform<f64>, Failure> {
    let bad = |why: String| Failure::Usage(format!("--pose: {why}"));
    let text = text.trim();
    if let Ok(value) = serde_json::from_str::<Value>(text)
        && value.is_array()
        && value[0].is_array()
    {
        return matrix(&value).map_err(bad);
    }
    let plain = load::unbracketed(text);
    let parts: Vec<&str> = plain.split([',', ';', ' ', '\n', '\t']).filter(|p| !p.is_empty()).collect();
    if matches!(parts.len(), 12 | 16) {
        let numbers: Result<Vec<f64>, Failure> =
            parts.iter().map(|p| number(p, Measure::Length).map_err(bad)).collect();
        return rigid(&numbers?).map_err(bad);
    }
    // Values may hold blanks: `0.4, 0, 0.3, 90 deg, 0, 0`.
    let parts = load::list(plain);
    let set: OrientationSet =
        orientation.parse().map_err(|e| Failure::Usage(format!("--orientation: {e}")))?;
    let wanted = 3 + set.names().len();
    let position_only = parts.len() == 3 && goal == Goal::Position;
    if parts.len() != wanted && !position_only {
        let hint = if parts.len() == 3 { "; x, y, z alone go with --position" } else { "" };
        return Err(bad(format!(
            "{} values; a pose is x, y, z, {} or a 4×4 matrix{hint}",
            parts.len(),
            set.names().join(", ")
        )));
    }
    let mut values = vec![];
    for (k, part) in parts.iter().enumerate() {
        let direction = matches!(set, OrientationSet::Quaternion | OrientationSet::Matrix)
            || set == OrientationSet::AxisAngle && k < 6;
        // A number without unit is one of either kind.
        let measure = if k < 3 || direction { Measure::Length } else { Measure::Angle };
        let value = number(part, measure).map_err(bad)?;
        if measure == Measure::Angle {
            load::note_of_radians(part, set.names()[k - 3], value);
        }
        values.push(value);
    }
    let turned = if position_only {
        Rotation::identity()
    } else {
        rotation(set, &values[3..]).map_err(|e| bad(e.to_string()))?
    };
    Ok(Transform::from_rotation_translation(turned, Vector([values[0], values[1], values[2]])))
}

fn number(text: &str, measure: Measure) -> Result<f64, String> {
    load::value_of(text, measure)
        .and_then(crate::commands::fk::value)
        .map_err(|why| format!("`{text}`: {why}"))
}

/// A matrix of four rows (or three) of four numbers.
///
/// # Errors
/// If it is not, or no pose.
pub fn matrix(value: &Value) -> Result<Transform<f64>, String> {
    let expected = || "not a 4×4 matrix of numbers".to_string();
    let rows = value.as_array().ok_or_else(expected)?;
    let mut numbers = vec![];
    for row in rows {
        let row = row.as_array().filter(|r| r.len() == 4).ok_or_else(expected)?;
        for x in row {
            numbers.push(x.as_f64().ok_or_else(expected)?);
        }
    }
    rigid(&numbers)
}

fn rigid(numbers: &[f64]) -> Result<Transform<f64>, String> {
    let row = |k: usize| [numbers[4 * k], numbers[4 * k + 1], numbers[4 * k + 2], numbers[4 * k + 3]];
    let last = match numbers.len() {
        12 => [0.0, 0.0, 0.0, 1.0],
        16 => row(3),
        _ => return Err("not a 4×4 matrix of numbers".into()),
    };
    Transform::from_matrix([row(0), row(1), row(2), last]).map_err(|e| e.to_string())
}
