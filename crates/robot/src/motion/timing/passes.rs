//! The two passes over the grid.

use super::stage::Program;
use crate::motion::error::MotionError;

/// How far an end speed may be outside what is possible, as a share: rounding.
const ROUNDING: f64 = 1e-9;

/// The greatest x = ṡ² at every grid point, given those at the start and at the end.
pub(super) fn solve(program: &Program, [start, end]: [f64; 2]) -> Result<Vec<f64>, MotionError> {
    let n = program.s.len() - 1;
    let controllable = backward(program, end)?;
    let [low, high] = controllable[0];
    if start < low * (1.0 - ROUNDING) || start > high * (1.0 + ROUNDING) {
        let possible = [low.sqrt(), high.sqrt()];
        return Err(MotionError::EndSpeed { s: 0.0, speed: start.sqrt(), possible });
    }
    let mut x = Vec::with_capacity(n + 1);
    x.push(start.max(low).min(high));
    for i in 0..n {
        x.push(program.stage(i, controllable[i + 1]).forward(x[i]));
        if x[i] == 0.0 && x[i + 1] == 0.0 {
            return Err(MotionError::Stuck { s: program.s[i] });
        }
    }
    Ok(x)
}

/// The intervals of x from which the end can be reached.
fn backward(program: &Program, end: f64) -> Result<Vec<[f64; 2]>, MotionError> {
    let n = program.s.len() - 1;
    if end > program.highest[n] * (1.0 + ROUNDING) {
        let possible = [0.0, program.highest[n].sqrt()];
        return Err(MotionError::EndSpeed { s: program.s[n], speed: end.sqrt(), possible });
    }
    let mut sets = vec![[end; 2]; n + 1];
    for i in (0..n).rev() {
        sets[i] = program
            .stage(i, sets[i + 1])
            .controllable()
            .ok_or(MotionError::NotControllable { s: program.s[i] })?;
    }
    Ok(sets)
}
