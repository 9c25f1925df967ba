//! All printed formulas, one after another.

use super::arm::Arm;
use super::judgement::{Composed, Undecided, Values};
use super::setting::spans;
use denavit_symbolic::Symbol;

/// Combinations of signs that are followed at a pose.
const MOST: usize = 1_024;
/// Poses that are tried.
const POSES: usize = 60;

/// One branch of the procedure: the joint variables found so far, and the sums that must stay.
#[derive(Clone)]
struct Branch {
    q: Vec<f64>,
    sums: Vec<(Vec<f64>, f64)>,
}

/// Counts what the formulas yield at random poses.
///
/// # Errors
/// A symbol that has no value.
pub fn composed(arm: &Arm, all: &[Values]) -> Result<Composed, Undecided> {
    let setting = &arm.setting;
    let n = setting.variables.len();
    let mut steps = vec![];
    let mut rows: Vec<Vec<f64>> = vec![];
    for values in all {
        let tape = setting.tape(&values.branches.concat()).map_err(Undecided::UnknownSymbol)?;
        let of: Option<Vec<Vec<f64>>> = values.of.iter().map(|&e| setting.row(e)).collect();
        // What is no sum of joint variables leads to none.
        let Some(of) = of else { continue };
        if of.is_empty() || values.branches.iter().any(|b| b.len() != of.len()) {
            return Err(Undecided::Shape);
        }
        rows.extend(of.iter().cloned());
        steps.push((of, tape));
    }
    let unit = |j: usize| (0..n).map(|k| f64::from(u8::from(k == j))).collect::<Vec<f64>>();
    rows.extend(setting.given.iter().map(|&j| unit(j)));
    let is_open = |j: &usize| !spans(&rows, &unit(*j));
    let open: Vec<Symbol> = (0..n).filter(is_open).map(|j| setting.variables[j]).collect();
    let mut counts = Composed { poses: 0, existing: 0, yielded: 0, spurious: 0, open };
    if !counts.open.is_empty() {
        return Ok(counts);
    }
    for sample in arm.any.iter().filter(|s| s.motions.is_empty()).take(POSES) {
        let mut start = vec![0.0; n];
        setting.given.iter().for_each(|&j| start[j] = sample.q[j]);
        let sums = setting.given.iter().map(|&j| (unit(j), sample.q[j])).collect();
        let mut branches = vec![Branch { q: start, sums }];
        for (of, tape) in &steps {
            branches = branches
                .iter()
                .flat_map(|b| {
                    let printed = tape.values(&setting.point(&b.q, &sample.entries));
                    printed.chunks(of.len()).filter_map(|v| b.with(of, v)).collect::<Vec<Branch>>()
                })
                .collect();
            branches.truncate(MOST);
        }
        let mut found: Vec<Vec<f64>> = vec![];
        for b in branches {
            if !found.iter().any(|f| setting.is_same(f, &b.q)) {
                found.push(b.q);
            }
        }
        counts.poses += 1;
        counts.existing += sample.solutions.len();
        counts.yielded +=
            sample.solutions.iter().filter(|s| found.iter().any(|f| setting.is_same(f, s))).count();
        counts.spurious += found.iter().filter(|f| !arm.has_pose(f, &sample.entries)).count();
    }
    Ok(counts)
}

impl Branch {
    /// With what was found; nothing if it is no number.
    fn with(&self, of: &[Vec<f64>], values: &[f64]) -> Option<Branch> {
        let mut next = self.clone();
        for (row, &x) in of.iter().zip(values) {
            if !x.is_finite() {
                return None;
            }
            next.sums.push((row.clone(), x));
            // The last variable of each sum makes up for what has changed in the others.
            for (row, x) in next.sums.iter().rev() {
                let last = row.iter().rposition(|k| *k != 0.0)?;
                let sum: f64 = row.iter().zip(&next.q).map(|(k, q)| k * q).sum();
                next.q[last] += (x - sum) / row[last];
            }
        }
        Some(next)
    }
}
