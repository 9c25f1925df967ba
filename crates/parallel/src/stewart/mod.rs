//! Stewart platforms (Gough's hexapods): six legs between points of a base and points of a platform.
//!
//! The legs of a pose have one set of lengths ([`Stewart::lengths`]). Six lengths have up to forty poses over the complex numbers, the
//! real ones among them are assembly modes ([`Stewart::forward`]).

mod certify;
mod equations;
mod forward;
pub mod start;
mod track;

pub use forward::{Assembly, Bound, Forward};

use crate::rates::Rates;
use denavit::geometry::{Transform, Vector};

/// Where the legs are fixed, metres.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Stewart {
    /// In the base.
    pub base: [Vector<f64>; 6],
    /// In the platform.
    pub platform: [Vector<f64>; 6],
}

impl Stewart {
    /// The legs of a pose, from base to platform, along the axes of the base.
    pub fn legs(&self, pose: &Transform<f64>) -> [Vector<f64>; 6] {
        std::array::from_fn(|i| pose.act_on_point(self.platform[i]) - self.base[i])
    }

    /// The lengths of the legs: lᵢ = |p + R bᵢ − aᵢ|.
    pub fn lengths(&self, pose: &Transform<f64>) -> [f64; 6] {
        self.legs(pose).map(Vector::norm)
    }

    /// J_x (v, ω) = l̇ with v of the platform's origin: a leg's row is (s, R b × s), its direction and moment. Nothing where a leg
    /// has the length 0, which has no direction.
    pub fn rates(&self, pose: &Transform<f64>) -> Option<Rates> {
        let mut rows = vec![];
        for (leg, b) in self.legs(pose).into_iter().zip(self.platform) {
            let length = leg.norm();
            if length == 0.0 {
                return None;
            }
            let s = leg.scale(1.0 / length);
            let m = pose.act_on_vector(b).cross(s);
            rows.push([s[0], s[1], s[2], m[0], m[1], m[2]]);
        }
        let size = self.platform.iter().map(|b| b.dot(*b)).sum::<f64>();
        Some(Rates::in_space(rows, vec![1.0; 6], vec![1.0; 6], (size / 6.0).sqrt(), pose.translation))
    }
}
