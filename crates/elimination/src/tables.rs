//! The constants of a plan as plain numbers: what a port to another language prints.

use crate::{arm::Arm, fourier::Fourier, plan::Plan, solve::Method, split::Split, wide};

/// The constants of a plan for an arm with at most one slide.
#[derive(Clone, Debug)]
pub struct Tables {
    /// The arm, lengths divided by its size.
    pub arm: Arm,
    /// The arm's size.
    pub size: f64,
    /// The splits in the order in which they are solved.
    pub splits: Vec<Split>,
    /// Where the determinant is sampled.
    pub samples: Samples,
    /// Where that of the wider matrix is, for poses at which the other one vanishes identically.
    pub wide: Samples,
    /// The weights of the six equations in each row of the wider matrix.
    pub mixtures: Vec<[f64; 6]>,
}

/// Angles at which a determinant is sampled, and what the samples add to its polynomial.
#[derive(Clone, Debug)]
pub struct Samples {
    /// Cosines of the angles.
    pub cosines: Vec<f64>,
    /// Their sines.
    pub sines: Vec<f64>,
    /// For each sample what it adds to the real parts of the coefficients, to the imaginary parts, and to the harmonics
    /// that vanish without rounding.
    pub transform: Vec<Vec<f64>>,
}

impl Samples {
    fn new<const GROUPS: usize>(fourier: &Fourier<GROUPS>) -> Samples {
        let cosines: Vec<f64> = fourier.cosines.iter().flat_map(|lanes| lanes.0).collect();
        let rows = fourier.table.iter().take(cosines.len());
        Samples {
            sines: fourier.sines.iter().flat_map(|lanes| lanes.0).collect(),
            transform: rows.map(|row| row.iter().flat_map(|lanes| lanes.0).collect()).collect(),
            cosines,
        }
    }
}

impl Plan {
    /// The constants; none if more than one joint slides.
    pub fn tables(&self) -> Option<Tables> {
        let Method::Splits(splits) = &self.method else { return None };
        Some(Tables {
            arm: self.constants.arm.clone(),
            size: self.constants.size,
            splits: splits.clone(),
            samples: Samples::new(&self.constants.fourier),
            wide: Samples::new(&self.constants.wide),
            mixtures: (0..16).map(|i| std::array::from_fn(|j| wide::weight(i, j))).collect(),
        })
    }
}
