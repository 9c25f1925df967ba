//! Gauss–Newton on base, tool and single numbers, with weights that leave rows out which are far off.
//!
//! The base turns on the left, exp(x) B, the tool on the right, E exp(y); residuals are log(R̂ᵀ R) and p/λ − p̂ in units of what
//! noise and an arm that nobody calibrated explain, [`Scale`].

use crate::arm::Arm;
use crate::frames::Frames;
use crate::turns::{exp, log, solve};
use denavit::geometry::{Rotation, Transform, Vector};

/// What residuals are compared with.
#[derive(Clone, Copy, Debug)]
pub struct Scale {
    /// Of a turn, radians.
    pub turn: f64,
    /// Of a shift, in the model's unit of length.
    pub shift: f64,
}

/// A number that may be off.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Extra {
    /// The pose is so many rows behind the joints.
    Lag,
    /// What the joint's column is ahead of the model.
    Zero(usize),
    /// By how much, as a part, the joint turns more than its column says.
    Gain(usize),
    /// What of the joint before it the column holds.
    Couple(usize),
    /// By how much a constant between two axes is longer: its number, and the coordinate.
    Length(usize, usize),
}

/// What is fitted: joints of rows for a lag and numbers, and poses for them.
pub struct Problem<'a> {
    /// The arm.
    pub arm: &'a Arm,
    /// Joints of each row, for a lag in rows.
    pub joints: &'a dyn Fn(usize, f64, &mut Vec<f64>),
    /// The rows.
    pub rows: &'a [usize],
    /// Their recorded poses.
    pub recorded: &'a [(Rotation<f64>, Vector<f64>)],
    /// What residuals are compared with.
    pub scale: Scale,
    /// The lag that is taken out already, rows.
    pub lag: f64,
}

/// A fit.
#[derive(Clone, Debug)]
pub struct Fit {
    /// Base, tool and scale.
    pub frames: Frames,
    /// The numbers.
    pub extras: Vec<(Extra, f64)>,
    /// Their standard deviations, the residual taken for noise.
    pub deviations: Vec<f64>,
}

impl Problem<'_> {
    /// The model's poses of the rows.
    pub fn model(&self, extras: &[(Extra, f64)]) -> Vec<Transform<f64>> {
        let mut constants = None;
        let mut lag = self.lag;
        for &(extra, value) in extras {
            match extra {
                Extra::Lag => lag += value,
                Extra::Length(k, axis) => {
                    let constants = constants.get_or_insert_with(|| self.arm.constants.clone());
                    constants[k].translation.0[axis] += value;
                }
                _ => {}
            }
        }
        let constants = constants.as_ref().unwrap_or(&self.arm.constants);
        let mut q = vec![];
        let pose = |&r: &usize| {
            (self.joints)(r, lag, &mut q);
            adjusted(&mut q, extras);
            self.arm.pose_with(constants, &q)
        };
        self.rows.iter().map(pose).collect()
    }

    /// Residuals of the rows: turn, then shift.
    pub fn residuals(&self, frames: &Frames, model: &[Transform<f64>]) -> Vec<[f64; 6]> {
        let one = |(f, m): (&Transform<f64>, &(Rotation<f64>, Vector<f64>))| {
            let x = frames.of(f);
            let turn = log(&(x.rotation.inverse() * m.0)).scale(1.0 / self.scale.turn);
            let sign = frames.scale.signum();
            let shift = (m.1.scale(1.0 / frames.scale) - x.translation).scale(sign / self.scale.shift);
            [turn[0], turn[1], turn[2], shift[0], shift[1], shift[2]]
        };
        model.iter().zip(self.recorded).map(one).collect()
    }

    /// Fits what is free of base and tool, and the numbers.
    pub fn fit(&self, start: &Frames, extras: &[(Extra, f64)], free: [bool; 2], steps: usize) -> Fit {
        let n = 12 + extras.len();
        let mut fit = Fit { frames: *start, extras: extras.to_vec(), deviations: vec![0.0; extras.len()] };
        for step in 0..steps {
            let model = self.model(&fit.extras);
            let residuals = self.residuals(&fit.frames, &model);
            let weights = weights(&residuals);
            let derivatives: Vec<Vec<[f64; 6]>> = (0..extras.len())
                .map(|k| {
                    let h = 1e-5;
                    let mut moved = fit.extras.clone();
                    moved[k].1 += h;
                    let other = self.residuals(&fit.frames, &self.model(&moved));
                    let pairs = other.iter().zip(&residuals);
                    pairs.map(|(a, b)| std::array::from_fn(|i| (a[i] - b[i]) / h)).collect()
                })
                .collect();
            let (mut a, mut b) = (vec![0.0; n * n], vec![0.0; n]);
            let mut row = vec![0.0; n];
            let mut squares = 0.0;
            for (k, r) in residuals.iter().enumerate() {
                let w = weights[k];
                if w == 0.0 {
                    continue;
                }
                squares += w * r.iter().map(|x| x * x).sum::<f64>();
                let jacobian = self.jacobian(&fit.frames, &model[k]);
                for i in 0..6 {
                    row[..12].copy_from_slice(&jacobian[i]);
                    for (x, d) in row[12..].iter_mut().zip(&derivatives) {
                        *x = d[k][i];
                    }
                    for p in 0..n {
                        if row[p] == 0.0 {
                            continue;
                        }
                        let x = w * row[p];
                        b[p] -= x * r[i];
                        for q in 0..=p {
                            a[p * n + q] += x * row[q];
                        }
                    }
                }
            }
            for p in 0..n {
                let is_held = p < 12 && !free[usize::from(matches!(p, 3..=5 | 9..=11))];
                if is_held {
                    b[p] = 0.0;
                    (0..n).for_each(|q| (a[p * n + q], a[q * n + p]) = (0.0, 0.0));
                    a[p * n + p] = 1.0;
                }
            }
            for p in 0..n {
                (0..p).for_each(|q| a[q * n + p] = a[p * n + q]);
                a[p * n + p] += if p < 12 { 1e-3 } else { 1e-6 };
            }
            if step + 1 == steps && !extras.is_empty() {
                let count = weights.iter().filter(|w| **w > 0.0).count();
                let size = squares / (6 * count).saturating_sub(n).max(1) as f64;
                for k in 0..extras.len() {
                    let mut unit = vec![0.0; n];
                    unit[12 + k] = 1.0;
                    fit.deviations[k] = (size * solve(a.clone(), unit)[12 + k].max(0.0)).sqrt();
                }
            }
            let d = solve(a, b);
            let v = |k: usize| Vector([d[k], d[k + 1], d[k + 2]]);
            let (base, tool) = (&mut fit.frames.base, &mut fit.frames.tool);
            base.rotation = exp(v(0)) * base.rotation;
            tool.rotation = tool.rotation * exp(v(3));
            base.translation = base.translation + v(6);
            tool.translation = tool.translation + v(9);
            fit.extras.iter_mut().zip(&d[12..]).for_each(|(e, x)| e.1 += x);
        }
        fit
    }

    /// What base and tool do to a row's residuals: turns of the base, of the tool, shifts of the base, of the tool.
    fn jacobian(&self, frames: &Frames, model: &Transform<f64>) -> [[f64; 12]; 6] {
        let x = frames.of(model);
        let back = x.rotation.inverse().rows();
        let out = (frames.base.rotation * model.rotation).rows();
        let [px, py, pz] = (x.translation - frames.base.translation).0;
        let cross = [[0.0, -pz, py], [pz, 0.0, -px], [-py, px, 0.0]];
        let (turn, shift) = (1.0 / self.scale.turn, frames.scale.signum() / self.scale.shift);
        let mut j = [[0.0; 12]; 6];
        for i in 0..3 {
            for k in 0..3 {
                j[i][k] = -turn * back[i][k];
                j[3 + i][k] = shift * cross[i][k];
                j[3 + i][9 + k] = -shift * out[i][k];
            }
            j[i][3 + i] = -turn;
            j[3 + i][6 + i] = -shift;
        }
        j
    }
}

/// Joints with the numbers that are fitted.
pub fn adjusted(q: &mut [f64], extras: &[(Extra, f64)]) {
    for &(extra, value) in extras {
        match extra {
            Extra::Zero(i) => q[i] -= value,
            Extra::Gain(i) => q[i] *= 1.0 + value,
            Extra::Couple(i) => q[i] -= value * q[i - 1],
            Extra::Lag | Extra::Length(..) => {}
        }
    }
}

/// How large a row's residual is.
fn size(r: &[f64; 6]) -> f64 {
    (r.iter().map(|x| x * x).sum::<f64>() / 6.0).sqrt()
}

/// Huber's, and nothing of what is far off.
fn weights(residuals: &[[f64; 6]]) -> Vec<f64> {
    let sizes: Vec<f64> = residuals.iter().map(size).collect();
    let c = 1.5 * crate::columns::median(sizes.clone()) + 1e-9;
    sizes.into_iter().map(|e| if e > 4.0 * c { 0.0 } else { (c / e.max(1e-12)).min(1.0) }).collect()
}

/// The size of residuals, in units of the scale; rows that are far off count three medians.
pub fn rho(residuals: &[[f64; 6]]) -> f64 {
    let sizes: Vec<f64> = residuals.iter().map(size).collect();
    let most = (3.0 * crate::columns::median(sizes.clone())).max(1e-3);
    let squares: f64 = sizes.iter().map(|e| e.min(most).powi(2)).sum();
    (squares / sizes.len().max(1) as f64).sqrt()
}

/// The sizes of residuals row by row.
pub fn sizes(residuals: &[[f64; 6]]) -> Vec<f64> {
    residuals.iter().map(size).collect()
}
