//! The constants of a plan as plain numbers: what a port to another language prints.

use crate::{arm::Arm, plan::Plan, solve::Method, split::Split};

/// The constants of a plan for an arm with at most one slide.
#[derive(Clone, Debug)]
pub struct Tables {
    /// The arm, lengths divided by its size.
    pub arm: Arm,
    /// The arm's size.
    pub size: f64,
    /// The splits in the order in which they are solved.
    pub splits: Vec<Split>,
    /// Cosines of the angles at which the determinant is sampled.
    pub cosines: Vec<f64>,
    /// Their sines.
    pub sines: Vec<f64>,
    /// For each sample what it adds to the real parts of the coefficients, to the imaginary parts, and to the harmonics
    /// that vanish without rounding.
    pub transform: Vec<Vec<f64>>,
}

impl Plan {
    /// The constants; none if more than one joint slides.
    pub fn tables(&self) -> Option<Tables> {
        let Method::Splits(splits) = &self.method else { return None };
        let fourier = &self.constants.fourier;
        let cosines: Vec<f64> = fourier.cosines.iter().flat_map(|lanes| lanes.0).collect();
        let rows = fourier.table.iter().take(cosines.len());
        Some(Tables {
            arm: self.constants.arm.clone(),
            size: self.constants.size,
            splits: splits.clone(),
            sines: fourier.sines.iter().flat_map(|lanes| lanes.0).collect(),
            transform: rows.map(|row| row.iter().flat_map(|lanes| lanes.0).collect()).collect(),
            cosines,
        })
    }
}
