//! The two passes over the grid.

use super::stage::Program;
use crate::motion::error::MotionError;

/// How far an end speed may be outside what is possible, as a share: rounding.
const ROUNDING: f64 = 1e-9;
/// How often, for each grid point, a way without continuation is given up.
const BELOW: usize = 4;

/// The greatest x = ṡ² at every grid point, given those at the start and at the end.
pub(super) fn solve(program: &Program, [start, end]: [f64; 2]) -> Result<Vec<f64>, MotionError> {
    let n = program.s.len() - 1;
    let mut controllable = backward(program, end)?;
    // With viscous friction there may be no way from within the bounds. What is faster cannot be reached, so that all ways pass below.
    for _ in 0..=BELOW * n {
        let [low, high] = controllable[0];
        if start < low * (1.0 - ROUNDING) || start > high * (1.0 + ROUNDING) {
            let possible = [low.sqrt(), high.sqrt()];
            return Err(MotionError::EndSpeed { s: 0.0, speed: start.sqrt(), possible });
        }
        let mut x = Vec::with_capacity(n + 1);
        x.push(start.max(low).min(high));
        while let Some(next) = forward(program, x.len() - 1, &controllable, &x)? {
            x.push(next);
        }
        let last = x.len() - 1;
        if last == n {
            return Ok(x);
        }
        let [low, _] = controllable[last];
        let curved = program.curved(last, controllable[last + 1]);
        let below = curved.and_then(|curved| curved.below(x[last], low));
        controllable[last][1] = below.ok_or(MotionError::NotControllable { s: program.s[last] })?;
        reach(program, &mut controllable, last)?;
    }
    Err(MotionError::NotControllable { s: 0.0 })
}

/// The next x; `None` at the end, and where there is none.
fn forward(
    program: &Program,
    i: usize,
    controllable: &[[f64; 2]],
    x: &[f64],
) -> Result<Option<f64>, MotionError> {
    let Some(&next) = controllable.get(i + 1) else { return Ok(None) };
    let found = match program.curved(i, next) {
        Some(curved) => curved.forward(x[i]),
        None => Some(program.stage(i, next).forward(x[i])),
    };
    match found {
        Some(0.0) if x[i] == 0.0 => Err(MotionError::Stuck { s: program.s[i] }),
        _ => Ok(found),
    }
}

/// The bounds of the x from which the end can be reached.
fn backward(program: &Program, end: f64) -> Result<Vec<[f64; 2]>, MotionError> {
    let n = program.s.len() - 1;
    if end > program.highest[n] * (1.0 + ROUNDING) {
        let possible = [0.0, program.highest[n].sqrt()];
        return Err(MotionError::EndSpeed { s: program.s[n], speed: end.sqrt(), possible });
    }
    let mut sets = vec![[end; 2]; n + 1];
    reach(program, &mut sets, n)?;
    Ok(sets)
}

/// The bounds at all grid points before `last`.
fn reach(program: &Program, sets: &mut [[f64; 2]], last: usize) -> Result<(), MotionError> {
    for i in (0..last).rev() {
        let found = match program.curved(i, sets[i + 1]) {
            Some(curved) => curved.controllable(),
            None => program.stage(i, sets[i + 1]).controllable(),
        };
        sets[i] = found.ok_or(MotionError::NotControllable { s: program.s[i] })?;
    }
    Ok(())
}
