//! An arm with masses.

use denavit::description::Description;
use denavit::dynamics::{Dynamics, NoNumbers};
use denavit_report::figure::Arm;

/// An arm with masses.
pub struct Heavy {
    /// In numbers.
    pub arm: Dynamics<f64>,
    /// Whether the masses are the robot's own, and not those of bars.
    pub is_known: bool,
}

impl Heavy {
    /// The arm with its masses, those of bars where none are known.
    ///
    /// # Errors
    /// If a mass has no value: a sentence that says so.
    pub fn new(valued: &Description, drawn: &Arm) -> Result<Self, String> {
        let is_known = valued.has_masses();
        let arm = match is_known {
            true => Dynamics::numeric(valued),
            false => Dynamics::numeric(&drawn.as_bars(valued)),
        };
        let why = |why: NoNumbers| match why {
            NoNumbers::NoMasses => "it says nothing of masses".into(),
            NoNumbers::Missing(_) | NoNumbers::NegativeMass(..) => why.to_string(),
        };
        Ok(Heavy { arm: arm.map_err(why)?, is_known })
    }
}
