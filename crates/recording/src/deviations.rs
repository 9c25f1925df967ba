//! How far the hand is off, row by row, and when.

use crate::arm::{Arm, all};
use crate::finding::Off;
use crate::fixed::rows;
use crate::recipe::Recipe;
use crate::recording::{Recording, Roles, Said};
use crate::times::seconds_by_step;
use crate::turns::between;

/// How far the recorded pose of the hand lies from that of the model in each row, with what a recipe says done to the columns:
/// an angle in radians, a distance in metres. Nothing for rows that the recipe leaves out, in which a number is missing, or for
/// which a delay leaves no joints. The arm is that of the recipe: of the catalogue where it is not `own`, with lengths that the
/// recipe found.
pub fn deviations(recording: &Recording, roles: &Roles, recipe: &Recipe, own: &Arm) -> Vec<Option<Off>> {
    let mut out = vec![None; recording.columns.first().map_or(0, |c| c.values.len())];
    let mut arms = [own].into_iter().chain(all());
    let Some(arm) = arms.find(|arm| recipe.is_of(arm).is_ok()) else { return out };
    let mut constants = arm.constants.clone();
    for &(k, axis, by) in &recipe.lengths {
        constants[k].translation.0[axis] += by;
    }
    for row in rows(recording, roles, recipe).map_or(vec![], |all| all.0) {
        let model = arm.pose_with(&constants, &row.q);
        out[row.row] = Some(Off {
            turn: between(&model.rotation, &row.pose.rotation),
            shift: (row.pose.translation - model.translation).norm(),
        });
    }
    out
}

/// The times of the rows since the first, in seconds; nothing where no column tells them, or they do not go on.
pub fn seconds(recording: &Recording, roles: &Roles) -> Option<Vec<f64>> {
    let column = &recording.columns[roles.time?];
    let values = &column.values;
    let [first, .., last] = values[..] else { return None };
    let step = (last - first) / (values.len() as f64 - 1.0);
    let unit = column.said.map_or_else(|| seconds_by_step(step, values), Said::si);
    let goes_on = values.windows(2).all(|w| w[1] > w[0]);
    goes_on.then(|| values.iter().map(|t| (t - first) * unit).collect())
}
