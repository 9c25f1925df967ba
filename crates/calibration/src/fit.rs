//! The estimate: Gauss–Newton on the minimal set, with weights, deviations, and what the data at hand do not show.
//!
//! Numbers are scaled by what is usual for them, [`PRIOR`](crate::PRIOR). A combination whose deviation would be larger than that is not seen
//! by these data: it is held at what the table says, exactly, and named. Against gross errors rows are weighed by Tukey's
//! biweight, after Beaton and Tukey (1974); the deviations are then Huber's for such estimates.

use crate::estimate::{CalibrateError, CalibrateOptions, Calibrated, Measured};
use crate::linear::dot;
use crate::measurement::{Measurement, Reading};
use crate::model::{Problem, State};
use crate::visible::Visible;
use crate::work::{ASIDE, Split, Work};

/// The residual of a pose that was computed is below this: radians, metres.
const COMPUTED: f64 = 2e-6;

/// Estimates what is seen.
///
/// # Errors
/// If there are too few rows, or the measurements do not follow from these joints.
pub fn calibrate(
    problem: &Problem,
    visible: &Visible,
    measured: &Measured,
    options: &CalibrateOptions,
) -> Result<Calibrated, CalibrateError> {
    let is_whole = |q: &Vec<f64>| q.len() == problem.arm.joints();
    if !measured.joints.iter().all(is_whole) || measured.readings.len() != measured.joints.len() {
        return Err(CalibrateError::Joints);
    }
    let width = problem.measurement.width();
    // More numbers than a frame has, so that anything is left to judge by.
    let (found, needed) = (width * measured.joints.len(), 12);
    if found < needed {
        return Err(CalibrateError::Rows(found, needed));
    }
    let work = Work::new(problem, visible, measured, options.is_robust);
    let all: Vec<usize> = (0..measured.joints.len()).collect();
    let start = work.residuals(&problem.nominal(), &all);
    let before = work.off(&start, &vec![1.0; all.len()]);
    let fit = work.fitted(&all, options.noise)?;
    let last = work.residuals(&fit.state, &all);
    let after = work.off(&last, &fit.weights);
    if !after.turn.is_finite() || !after.shift.is_finite() {
        return Err(CalibrateError::NoEnd(after));
    }
    let aside: Vec<usize> = all.iter().copied().filter(|&r| fit.weights[r] < ASIDE).collect();
    let held_out = work.held_out(options.folds, &measured.episodes, fit.noise, &aside, &start);
    let information = work.information(&fit.state, &fit.noise, &all, &fit.weights);
    let split = Split::new(&information);
    let covariance = work.covariance(&split, &fit);
    let estimates = work.estimates(&split, &fit, &covariance);
    let size = |r: &[f64; 6]| work.row_off(r);
    let is_pose = problem.measurement == Measurement::Pose || problem.measurement == Measurement::Position;
    Ok(Calibrated {
        unseen: work.unseen(&split),
        residuals: last.iter().map(size).collect(),
        is_computed: is_pose
            && after.turn < COMPUTED
            && after.shift < COMPUTED
            && all.len() * width > 2 * visible.kept.len(),
        state: fit.state,
        estimates,
        covariance,
        noise: fit.noise,
        ratio: fit.ratio,
        before,
        after,
        held_out,
        aside,
    })
}

/// How many configurations at random the deviation of the hand is looked at in.
pub const LOOKED_AT: usize = 100;

/// How far the hand is off, one deviation, in [`LOOKED_AT`] configurations at random: the mean and the most among them, metres.
/// None where orientations alone are measured, which say nothing of lengths, where things stand beside the arm, and where these
/// rows do not show everything.
pub fn deviation_of_hand(problem: &Problem, visible: &Visible, found: &Calibrated) -> Option<[f64; 2]> {
    found.unseen.is_empty().then(|| spread_of_hand(problem, visible, &found.state, &found.covariance))?
}

/// The same of a covariance.
pub fn spread_of_hand(
    problem: &Problem,
    visible: &Visible,
    state: &State,
    covariance: &[Vec<f64>],
) -> Option<[f64; 2]> {
    if problem.measurement == Measurement::Orientation || problem.measurement.of_fixture() > 0 {
        return None;
    }
    let free = Problem { measurement: Measurement::Position, fixtures: vec![], ..problem.clone() };
    let constants = problem.constants_at(state);
    let state = State { x: state.x.clone(), fixtures: vec![] };
    let mut all = vec![];
    for q in free.samples(LOOKED_AT, 9) {
        let (_, rows) = free.derivatives(&state, &constants, &q, 0);
        let variance: f64 = rows
            .iter()
            .map(|row| {
                let at: Vec<f64> = visible.kept.iter().map(|&k| row.get(k).copied().unwrap_or(0.0)).collect();
                covariance.iter().zip(&at).map(|(c, x)| x * dot(c, &at)).sum::<f64>()
            })
            .sum();
        all.push(variance.max(0.0).sqrt());
    }
    let mean = all.iter().sum::<f64>() / all.len() as f64;
    mean.is_finite().then(|| [mean, all.iter().copied().fold(0.0, f64::max)])
}

/// The information of one configuration, over the noise, in units of what is usual: rows of derivatives.
pub fn rows_of(problem: &Problem, visible: &Visible, q: &[f64], noise: &[f64; 2]) -> Vec<Vec<f64>> {
    let reading = Reading {
        turn: denavit::geometry::Rotation::identity(),
        at: denavit::geometry::Vector::zero(),
        distance: 0.0,
        group: 0,
    };
    let measured = Measured { joints: vec![q.to_vec()], readings: vec![reading], episodes: vec![] };
    Work::new(problem, visible, &measured, false).rows(&problem.nominal(), noise, 0)
}
