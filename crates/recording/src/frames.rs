//! Base, tool and the unit of length in closed form, for one hypothesis about the joints and the format.
//!
//! M = B F E for the recorded pose M and the model's F. Axes of increments: log(M_sᵀ M_t) = Eᵀ log(F_sᵀ F_t), so that one Kabsch
//! solve gives the turn of E, a mean that of B. Then p = λ (B p_F + B R_F t_E + t_B) is linear in λ, t_E, t_B. λ < 0 is a
//! left-handed recording.

use crate::turns::{Sum, eigen, log, solve};
use denavit::geometry::{Rotation, Transform, Vector};

/// Increments above this have no stable axis, radians.
const HALF: f64 = 2.97;
/// What a unit of length may be, and how near the scale has to come.
const SCALES: [f64; 9] = [1.0, 1e3, -1.0, -1e3, 100.0, -100.0, 1e-3, -1e-3, 0.0254];
const SNAP: f64 = 0.12;

/// Base, tool and scale.
#[derive(Clone, Copy, Debug)]
pub struct Frames {
    /// The robot's base in the recording's, lengths in the model's unit.
    pub base: Transform<f64>,
    /// The recorded frame in the robot's tool.
    pub tool: Transform<f64>,
    /// The recording's lengths for one of the model's; negative where it is left-handed.
    pub scale: f64,
}

impl Frames {
    /// None of them.
    pub fn none() -> Self {
        Frames { base: Transform::identity(), tool: Transform::identity(), scale: 1.0 }
    }

    /// The pose as it would be recorded; lengths in the model's unit, with the sign of the scale.
    #[inline]
    pub fn of(&self, model: &Transform<f64>) -> Transform<f64> {
        self.base * *model * self.tool
    }
}

/// Readings of base, tool and scale for poses of the model beside recorded ones; `pairs` are rows of both.
pub fn closed(
    model: &[Transform<f64>],
    recorded: &[(Rotation<f64>, Vector<f64>)],
    pairs: &[(usize, usize)],
) -> Vec<Frames> {
    let mut turned = vec![];
    let mut axes = Sum::default();
    let mut spread = [[0.0; 3]; 3];
    for &(s, t) in pairs {
        let a = log(&(model[s].rotation.inverse() * model[t].rotation));
        let b = log(&(recorded[s].0.inverse() * recorded[t].0));
        if a.norm() > HALF || b.norm() > HALF {
            continue;
        }
        axes.outer(b, a);
        for (i, row) in spread.iter_mut().enumerate() {
            for (j, x) in row.iter_mut().enumerate() {
                *x += a[i] * a[j];
            }
        }
    }
    // log M = Eᵀ log F: the turn that brings a to b is Eᵀ.
    let tool = axes.nearest().inverse();
    let mut base = Sum::default();
    for (f, m) in model.iter().zip(recorded) {
        base.add(&(m.0 * (f.rotation * tool).inverse()));
    }
    turned.push((base.nearest(), tool));
    let mut values = eigen(spread).0;
    values.sort_by(f64::total_cmp);
    // All increments about one axis: the position decides the base first, with either sign.
    if values[1].max(0.0).sqrt() < 0.05 * values[2].max(0.0).sqrt() {
        let n = model.len() as f64;
        let mean = |points: &mut dyn Iterator<Item = Vector<f64>>| {
            points.fold(Vector::zero(), |a, b| a + b).scale(1.0 / n)
        };
        let from = mean(&mut model.iter().map(|f| f.translation));
        let to = mean(&mut recorded.iter().map(|m| m.1));
        for sign in [1.0, -1.0] {
            let mut sum = Sum::default();
            for (f, m) in model.iter().zip(recorded) {
                sum.outer((m.1 - to).scale(sign), f.translation - from);
            }
            let base = sum.nearest();
            let mut sum = Sum::default();
            for (f, m) in model.iter().zip(recorded) {
                sum.add(&((base * f.rotation).inverse() * m.0));
            }
            turned.push((base, sum.nearest()));
        }
    }
    turned.into_iter().map(|(base, tool)| shifted(base, tool, model, recorded)).collect()
}

/// The scale and the shifts, the turns given.
fn shifted(
    base: Rotation<f64>,
    tool: Rotation<f64>,
    model: &[Transform<f64>],
    recorded: &[(Rotation<f64>, Vector<f64>)],
) -> Frames {
    let free = translations(&base, model, recorded, None);
    let largest = recorded.iter().map(|m| m.1.norm()).fold(0.0, f64::max);
    let snapped = SCALES.into_iter().find(|s| (free[6] / s - 1.0).abs() < SNAP);
    let scale = snapped.unwrap_or(if largest < 10.0 { 1.0 } else { 1e3 });
    let x = translations(&base, model, recorded, Some(scale));
    Frames {
        base: Transform::from_rotation_translation(base, Vector([x[3], x[4], x[5]])),
        tool: Transform::from_rotation_translation(tool, Vector([x[0], x[1], x[2]])),
        scale,
    }
}

/// t_E, t_B (both times the scale, where it is not given) and the scale.
fn translations(
    base: &Rotation<f64>,
    model: &[Transform<f64>],
    recorded: &[(Rotation<f64>, Vector<f64>)],
    scale: Option<f64>,
) -> Vec<f64> {
    let n = if scale.is_some() { 6 } else { 7 };
    let (mut a, mut b) = (vec![0.0; n * n], vec![0.0; n]);
    for (f, m) in model.iter().zip(recorded) {
        let turned = (*base * f.rotation).rows();
        let at = *base * f.translation;
        for k in 0..3 {
            let mut row = [0.0; 7];
            row[..3].copy_from_slice(&turned[k]);
            (row[3 + k], row[6]) = (1.0, at[k]);
            let y = scale.map_or(m.1[k], |s| m.1[k] / s - at[k]);
            for i in 0..n {
                b[i] += row[i] * y;
                for j in 0..n {
                    a[i * n + j] += row[i] * row[j];
                }
            }
        }
    }
    let ridge = if scale.is_some() { 1e-4 } else { 1e-6 };
    (0..n).for_each(|i| a[i * n + i] += ridge);
    solve(a, b)
}
