//! All of it: columns to motion, motion to rows, rows to parameters, with what is suspect.

use crate::estimate::{Estimate, Known, Options, estimate, sizes};
use crate::linear::rms;
use crate::model::Model;
use crate::motion::{Columns, Cutoff, Motion, NoMotion, Remark};
use crate::observations::Observations;
use crate::suspects::{Suspect, gravity, suspects};

/// How to identify.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Asked<'a> {
    /// The filter.
    pub cutoff: Cutoff,
    /// The estimate.
    pub options: Options,
    /// The columns with angles without unit taken for degrees, where there are any.
    pub in_degrees: Option<&'a Columns>,
}

/// What was found.
#[derive(Clone, Debug)]
pub struct Identified {
    /// The parameters.
    pub estimate: Estimate,
    /// The rows from which they are.
    pub observations: Observations,
    /// What no arm does.
    pub suspects: Vec<Suspect>,
    /// What is worth saying of the recording.
    pub remarks: Vec<Remark>,
    /// The filter's frequency, Hz, and that of the filter of the torques.
    pub cutoffs: Option<(f64, f64)>,
    /// Seconds of motion.
    pub seconds: f64,
    /// Rows of the recording.
    pub rows: usize,
}

/// Angles beyond this are hardly radians.
const MANY_TURNS: f64 = 7.0;
/// Degrees have to leave less than this part of what radians do.
const BETTER: f64 = 0.5;

/// Identifies the parameters of a model from columns.
///
/// # Errors
/// If the columns are no motion.
pub fn identify(model: &Model, columns: &Columns, asked: &Asked) -> Result<Identified, NoMotion> {
    let largest =
        |j: usize| columns.q[j].iter().filter(|x| x.is_finite()).fold(0.0_f64, |m, x| m.max(x.abs()));
    let is_wide = (0..columns.q.len()).any(|j| model.turns[j] && largest(j) > MANY_TURNS);
    let Some(in_degrees) = asked.in_degrees.filter(|_| is_wide) else { return once(model, columns, asked) };
    let degrees = once(model, in_degrees, asked);
    let radians = once(model, columns, asked);
    let left = |i: &Identified| {
        let parts = i.estimate.joints.iter().filter(|j| j.rows > 0);
        rms(&parts.map(|j| j.left / j.torque.max(1e-12)).collect::<Vec<_>>())
    };
    match (degrees, radians) {
        (Ok(mut d), Ok(r)) if left(&d) < BETTER * left(&r) => {
            d.remarks.push(Remark::Degrees(Some(left(&r) / left(&d).max(1e-12))));
            Ok(d)
        }
        (_, Ok(r)) => Ok(r),
        (Ok(mut d), Err(_)) => {
            d.remarks.push(Remark::Degrees(None));
            Ok(d)
        }
        (Err(_), Err(why)) => Err(why),
    }
}

fn once(model: &Model, columns: &Columns, asked: &Asked) -> Result<Identified, NoMotion> {
    let motion = Motion::of(columns, &model.turns, asked.cutoff)?;
    let observations = Observations::of(model, &motion);
    let estimate = estimate(model, &observations, &asked.options);
    let sizes = sizes(model, &observations);
    let mut suspects = suspects(model, &observations, &estimate, &sizes);
    if !suspects.iter().any(|s| matches!(s, Suspect::Sign(..) | Suspect::Factor(..))) {
        suspects.extend(gravity(model, &motion, &observations, &sizes));
    }
    let cutoffs = motion.cutoff.zip(motion.parallel.map(|p| p.0));
    Ok(Identified {
        estimate,
        observations,
        suspects,
        cutoffs,
        seconds: motion.seconds(),
        remarks: motion.remarks,
        rows: columns.time.len(),
    })
}

impl Identified {
    /// Parameters that the motion does not tell.
    pub fn unseen(&self) -> impl Iterator<Item = usize> + '_ {
        let is_unseen = |k: &usize| matches!(self.estimate.known[*k], Known::Unseen(_));
        (0..self.estimate.known.len()).filter(is_unseen)
    }

    /// What is left of each joint's torques with other values of the parameters.
    pub fn left(&self, values: &[f64]) -> Vec<f64> {
        let of = |j: usize| rms(&self.observations.of_joint(j).map(|r| r.left(values)).collect::<Vec<_>>());
        (0..self.observations.joints).map(of).collect()
    }
}
