//! First derivatives in numbers, of arms and whole trees alike: the recursion over dual numbers, once for each variable.

use super::direct::{Singular, direct_dynamics, factored};
use super::inertia::inertia_matrix;
use super::model::Dynamics;
use super::newton_euler::inverse_dynamics;
use crate::scalar::Scalar;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// First derivatives of torques or accelerations: entry `[j][k]` is that of joint j by variable k.
#[derive(Clone, PartialEq, Debug)]
pub struct Slopes {
    /// By the joint variables.
    pub by_q: Vec<Vec<f64>>,
    /// By their rates.
    pub by_qd: Vec<Vec<f64>>,
    /// Of torques by the accelerations: A. Of accelerations by the torques: A⁻¹.
    pub by_third: Vec<Vec<f64>>,
}

/// The derivatives of the torques that accelerate an arm by `qdd` in the state `(q, qd)`, friction with them. Coulomb's friction
/// counts as constant: at rest, where it jumps, it has no derivative.
///
/// # Panics
/// If `q`, `qd` or `qdd` does not have one entry per joint.
pub fn torque_derivatives(arm: &Dynamics<f64>, q: &[f64], qd: &[f64], qdd: &[f64]) -> Slopes {
    let n = arm.joints();
    assert_eq!([q.len(), qd.len(), qdd.len()], [n; 3], "one entry per joint");
    let dual = arm.map(Dual::constant);
    let [q, qd, qdd] = [q, qd, qdd].map(|all| all.iter().map(|&x| Dual::constant(x)).collect::<Vec<_>>());
    let (mut by_q, mut by_qd) = (vec![vec![0.0; n]; n], vec![vec![0.0; n]; n]);
    for k in 0..n {
        let moved = |all: &[Dual]| {
            let mut all = all.to_vec();
            all[k].slope = 1.0;
            all
        };
        let along = [
            (inverse_dynamics(&dual, &moved(&q), &qd, &qdd, None), &mut by_q),
            (inverse_dynamics(&dual, &q, &moved(&qd), &qdd, None), &mut by_qd),
        ];
        for (column, matrix) in along {
            column.iter().zip(matrix).for_each(|(entry, row)| row[k] = entry.slope);
        }
    }
    let q: Vec<f64> = q.iter().map(|x| x.value).collect();
    Slopes { by_q, by_qd, by_third: inertia_matrix(arm, &q) }
}

/// The derivatives of the accelerations under torques `tau` in the state `(q, qd)`: −A⁻¹ ∂τ/∂q and −A⁻¹ ∂τ/∂q̇ at these
/// accelerations, and A⁻¹.
///
/// # Errors
/// If the inertia matrix is singular.
///
/// # Panics
/// If `q`, `qd` or `tau` does not have one entry per joint.
pub fn acceleration_derivatives(
    arm: &Dynamics<f64>,
    q: &[f64],
    qd: &[f64],
    tau: &[f64],
) -> Result<Slopes, Singular> {
    let qdd = direct_dynamics(arm, q, qd, tau, None)?;
    let of_torques = torque_derivatives(arm, q, qd, &qdd);
    let factors = factored(&of_torques.by_third);
    let n = arm.joints();
    // Column by column.
    let solved = |of: &dyn Fn(usize, usize) -> f64| {
        let mut matrix = vec![vec![0.0; n]; n];
        for k in 0..n {
            let column: Vec<f64> = (0..n).map(|j| of(j, k)).collect();
            factors.solve(&column).into_iter().zip(&mut matrix).for_each(|(entry, row)| row[k] = entry);
        }
        matrix
    };
    Ok(Slopes {
        by_q: solved(&|j, k| -of_torques.by_q[j][k]),
        by_qd: solved(&|j, k| -of_torques.by_qd[j][k]),
        by_third: solved(&|j, k| f64::from(u8::from(j == k))),
    })
}

/// A number with its derivative by one variable.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Dual {
    value: f64,
    slope: f64,
}

impl Dual {
    fn constant(value: f64) -> Self {
        Dual { value, slope: 0.0 }
    }
}

impl Add for Dual {
    type Output = Dual;
    fn add(self, other: Dual) -> Dual {
        Dual { value: self.value + other.value, slope: self.slope + other.slope }
    }
}

impl Sub for Dual {
    type Output = Dual;
    fn sub(self, other: Dual) -> Dual {
        Dual { value: self.value - other.value, slope: self.slope - other.slope }
    }
}

impl Mul for Dual {
    type Output = Dual;
    fn mul(self, other: Dual) -> Dual {
        let slope = self.slope * other.value + self.value * other.slope;
        Dual { value: self.value * other.value, slope }
    }
}

impl Div for Dual {
    type Output = Dual;
    fn div(self, other: Dual) -> Dual {
        let value = self.value / other.value;
        Dual { value, slope: (self.slope - value * other.slope) / other.value }
    }
}

impl Neg for Dual {
    type Output = Dual;
    fn neg(self) -> Dual {
        Dual { value: -self.value, slope: -self.slope }
    }
}

impl Scalar for Dual {
    fn int(n: i64) -> Dual {
        Dual::constant(n as f64)
    }
    fn sin_cos(self) -> (Dual, Dual) {
        let (s, c) = self.value.sin_cos();
        (Dual { value: s, slope: c * self.slope }, Dual { value: c, slope: -s * self.slope })
    }
    fn sqrt(self) -> Dual {
        let value = self.value.sqrt();
        Dual { value, slope: self.slope / (value + value) }
    }
}
