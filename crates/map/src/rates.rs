//! How well the tool can move.

use crate::MapError;
use crate::outputs::Output;
use crate::unit::Quantity;
use denavit::Robot;
use denavit::description::Description;
use denavit::space::JointSpace;
use denavit::velocity::{Jacobian, Whole};

/// What measures of a Jacobian need of the arm.
#[derive(Clone, Debug)]
pub struct Mobility {
    is_angle: Vec<bool>,
    length: f64,
}

impl Mobility {
    /// Of an arm.
    ///
    /// # Errors
    /// If a parameter has no value.
    pub fn of(d: &Description) -> Result<Self, MapError> {
        let robot = Robot::numeric(d).map_err(|missing| {
            MapError::new(format!("{}: {missing}", d.name), "give them values, as in --set D3=450mm")
        })?;
        let space = JointSpace::new(d, &robot);
        Ok(Mobility { length: space.length(), is_angle: space.is_angle })
    }

    /// The columns.
    pub fn columns() -> Vec<Output> {
        ["manipulability", "condition"].map(|name| Output::new(name, Quantity::Plain)).into()
    }

    /// The measures of Jacobians whose entries stand in columns, row by row; infinite conditions are those of singular arms.
    pub fn measure(&self, entries: &[Vec<f64>]) -> [Vec<f64>; 2] {
        let n = self.is_angle.len();
        let rows = entries.first().map_or(0, Vec::len);
        let (mut manipulability, mut condition) = (Vec::with_capacity(rows), Vec::with_capacity(rows));
        let mut jacobian = Jacobian { columns: vec![[0.0; 6]; n] };
        (0..rows).for_each(|row| {
            for (c, column) in jacobian.columns.iter_mut().enumerate() {
                *column = [0, 1, 2, 3, 4, 5].map(|r| entries[r * n + c][row]);
            }
            // Numbers that are none have no singular values.
            let is_finite = jacobian.columns.iter().flatten().all(|x| x.is_finite());
            let [m, c] = if is_finite {
                let whole = Whole::new(&jacobian, &self.is_angle, self.length);
                [whole.manipulability, whole.condition]
            } else {
                [f64::NAN; 2]
            };
            manipulability.push(m);
            condition.push(c);
        });
        [manipulability, condition]
    }
}
