//! Gauss's method of two stages (Hairer, Lubich and Wanner, *Geometric Numerical Integration*, II.1.3 and VI.4) in joint variables
//! and momenta p = A q̇: symplectic, of order 4.

use super::problem::{Problem, Stop};
use super::{MAX_STEPS, NoMotion, Simulation};
use crate::dynamics::coriolis::coriolis_matrix;
use crate::dynamics::direct::factored;
use crate::dynamics::inertia::inertia_matrix;
use crate::dynamics::newton_euler::{gravity_torques, inverse_dynamics};

/// √3/6
const ROOT: f64 = 0.288_675_134_594_812_9;
const NODES: [f64; 2] = [0.5 - ROOT, 0.5 + ROOT];
const STAGES: [[f64; 2]; 2] = [[0.25, 0.25 - ROOT], [0.25 + ROOT, 0.25]];
/// How often the equations of the stages are put into themselves at most.
const ROUNDS: usize = 100;
/// What is rounding, and what is small enough where rounding alone goes on.
const SOLVED: f64 = 1e-15;
const SMALL: f64 = 1e-11;

pub(super) struct Symplectic {
    step: f64,
}

impl Symplectic {
    pub fn new(step: f64) -> Self {
        Symplectic { step }
    }

    /// Goes from one time to another by steps of one length.
    pub fn run(
        &mut self,
        problem: &Problem,
        (from, to): (f64, f64),
        y: &mut Vec<f64>,
        counts: &mut Simulation,
    ) -> Result<(), Stop> {
        let stop = |why, t, y: &[f64]| Stop { why, t, y: y.to_vec() };
        let wanted = ((to - from) / self.step - 1e-9).ceil().max(1.0);
        if wanted > (MAX_STEPS - counts.steps.min(MAX_STEPS)) as f64 {
            return Err(stop(NoMotion::Steps { t: from }, from, y));
        }
        let steps = wanted as usize;
        let h = (to - from) / wanted;
        let mut state = problem.momenta(y);
        let mut rates: [Vec<f64>; 2] = std::array::from_fn(|_| vec![0.0; state.len()]);
        for k in 0..steps {
            let t = from + k as f64 * h;
            solve(problem, t, h, &state, &mut rates).map_err(|why| stop(why, t, y))?;
            for (i, x) in state.iter_mut().enumerate() {
                *x += 0.5 * h * (rates[0][i] + rates[1][i]);
            }
            counts.steps += 1;
            *y = problem.velocities(t + h, &state).map_err(|why| stop(why, t, y))?;
        }
        Ok(())
    }
}

/// The rates of the two stages of a step.
fn solve(
    problem: &Problem,
    t: f64,
    h: f64,
    state: &[f64],
    rates: &mut [Vec<f64>; 2],
) -> Result<(), NoMotion> {
    let mut before = f64::INFINITY;
    for _ in 0..ROUNDS {
        let mut moved = 0.0_f64;
        let mut found = vec![];
        for (stage, node) in STAGES.iter().zip(NODES) {
            let at: Vec<f64> = (0..state.len())
                .map(|i| state[i] + h * (stage[0] * rates[0][i] + stage[1] * rates[1][i]))
                .collect();
            found.push(problem.hamiltonian_slope(t + node * h, &at)?);
        }
        for (rate, new) in rates.iter_mut().zip(found) {
            for (i, (x, new)) in rate.iter_mut().zip(new).enumerate() {
                moved = moved.max(h * (new - *x).abs() / (1.0 + state[i].abs()));
                *x = new;
            }
        }
        if moved <= SOLVED || moved >= before && moved <= SMALL {
            return Ok(());
        }
        before = moved;
    }
    Err(NoMotion::NotSolved { t })
}

impl Problem<'_> {
    /// The state with momenta in the place of velocities.
    fn momenta(&self, y: &[f64]) -> Vec<f64> {
        let n = self.arm.joints();
        let matrix = inertia_matrix(self.arm, &y[..n]);
        let momenta = matrix.iter().map(|row| row.iter().zip(&y[n..2 * n]).map(|(m, v)| m * v).sum());
        y[..n].iter().copied().chain(momenta).chain(y[2 * n..].iter().copied()).collect()
    }

    /// The state with velocities in the place of momenta.
    fn velocities(&self, t: f64, state: &[f64]) -> Result<Vec<f64>, NoMotion> {
        let n = self.arm.joints();
        if state.iter().any(|x| !x.is_finite()) {
            return Err(NoMotion::NotFinite { t });
        }
        let matrix = inertia_matrix(self.arm, &state[..n]);
        let factors = factored(&matrix);
        if let Some(joint) = factors.lost(&matrix) {
            return Err(NoMotion::Singular { joint, t });
        }
        let rates = factors.solve(&state[n..2 * n]);
        Ok(state[..n].iter().copied().chain(rates).chain(state[2 * n..].iter().copied()).collect())
    }

    /// The rates of q, p and the energies: ṗ = τ − FV q̇ − Q − Jᵀ w + Cᵀ q̇, since Ȧ = C + Cᵀ.
    fn hamiltonian_slope(&self, t: f64, state: &[f64]) -> Result<Vec<f64>, NoMotion> {
        let n = self.arm.joints();
        let y = self.velocities(t, state)?;
        let (q, qd) = (&y[..n], &y[n..2 * n]);
        let still = vec![0.0; n];
        let torques = self.acting.torques.at(t);
        let resting = inverse_dynamics(self.arm, q, &still, &still, self.acting.wrench.as_ref());
        let matrix = coriolis_matrix(self.arm, q, qd);
        let mut rates = qd.to_vec();
        let (mut supplied, mut dissipated, mut exerted) = (0.0, 0.0, 0.0);
        let gravity = self.acting.wrench.as_ref().map(|_| gravity_torques(self.arm, q));
        for j in 0..n {
            let turned: f64 = (0..n).map(|i| matrix[i][j] * qd[i]).sum();
            let rubbed = self.arm.drives[j].viscous * qd[j];
            rates.push(torques[j] - rubbed - resting[j] + turned);
            supplied += torques[j] * qd[j];
            dissipated += rubbed * qd[j];
            exerted += gravity.as_ref().map_or(0.0, |g| (resting[j] - g[j]) * qd[j]);
        }
        rates.extend([supplied, dissipated, exerted]);
        match rates.iter().all(|x| x.is_finite()) {
            true => Ok(rates),
            false => Err(NoMotion::NotFinite { t }),
        }
    }
}
