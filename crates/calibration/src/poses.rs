//! Which configurations to measure at: those that tell most, chosen greedily, then exchanged while that tells more.
//!
//! What is maximised is the determinant of the information (D-optimality), what is usual counted as known beforehand: the gain
//! of a further configuration is log det(1 + J C Jᵀ).

use crate::estimate::prior;
use crate::fit::{rows_of, spread_of_hand};
use crate::linear::{dot, symmetric};
use crate::model::Problem;
use crate::visible::Visible;
use denavit::random::Random;

/// How often every choice is looked at again.
const EXCHANGES: usize = 3;
/// Sets at random that the chosen one is held against.
const SETS: usize = 30;

/// Configurations that were chosen.
#[derive(Clone, Debug)]
pub struct Chosen {
    /// Their numbers among the candidates.
    pub chosen: Vec<usize>,
    /// One deviation of the hand with them in configurations at random: the mean and the most, metres; none where what is
    /// measured says nothing of it.
    pub deviation: Option<[f64; 2]>,
    /// The same with as many at random: medians.
    pub random: Option<[f64; 2]>,
    /// How many combinations remain that they do not show.
    pub unseen: usize,
}

/// Chooses so many configurations of the candidates. `noise` is that of a turn (radians) and a shift (metres).
pub fn choose_poses(
    problem: &Problem,
    visible: &Visible,
    candidates: &[Vec<f64>],
    count: usize,
    noise: [f64; 2],
    seed: u64,
) -> Chosen {
    let rows: Vec<Vec<Vec<f64>>> = candidates.iter().map(|q| rows_of(problem, visible, q, &noise)).collect();
    let n = visible.kept.len();
    let count = count.min(candidates.len());
    let mut chosen: Vec<usize> = vec![];
    let mut covariance = unit(n);
    for _ in 0..count {
        let Some(best) = best(&rows, &covariance, &chosen) else { break };
        chosen.push(best);
        rows[best].iter().for_each(|row| learned(&mut covariance, row));
    }
    for _ in 0..EXCHANGES {
        let mut is_changed = false;
        for place in 0..chosen.len() {
            let others: Vec<usize> =
                chosen.iter().enumerate().filter(|c| c.0 != place).map(|c| *c.1).collect();
            let mut covariance = unit(n);
            others.iter().flat_map(|&c| &rows[c]).for_each(|row| learned(&mut covariance, row));
            if let Some(best) = best(&rows, &covariance, &others) {
                is_changed |= best != chosen[place];
                chosen[place] = best;
            }
        }
        if !is_changed {
            break;
        }
    }
    let priors: Vec<f64> = visible.kept.iter().map(|&k| prior(problem, visible.parameters[k])).collect();
    let deviation = |set: &[usize]| {
        let mut covariance = unit(n);
        set.iter().flat_map(|&c| &rows[c]).for_each(|row| learned(&mut covariance, row));
        let scaled: Vec<Vec<f64>> = covariance
            .iter()
            .enumerate()
            .map(|(i, line)| line.iter().enumerate().map(|(j, c)| c * priors[i] * priors[j]).collect())
            .collect();
        spread_of_hand(problem, visible, &problem.nominal(), &scaled)
    };
    let mut dice = Random(seed ^ 0x5eed);
    let sets: Option<Vec<[f64; 2]>> = (0..SETS)
        .map(|_| {
            let mut all: Vec<usize> = (0..candidates.len()).collect();
            for k in 0..count {
                let other = k + ((dice.unit() * (all.len() - k) as f64) as usize).min(all.len() - k - 1);
                all.swap(k, other);
            }
            deviation(&all[..count])
        })
        .collect();
    let middle = |sets: &[[f64; 2]], k: usize| {
        let mut all: Vec<f64> = sets.iter().map(|s| s[k]).collect();
        all.sort_by(f64::total_cmp);
        all[all.len() / 2]
    };
    let random = sets.map(|sets| [middle(&sets, 0), middle(&sets, 1)]);
    let mut information = vec![vec![0.0; n]; n];
    for row in chosen.iter().flat_map(|&c| &rows[c]) {
        for (line, x) in information.iter_mut().zip(row) {
            line.iter_mut().zip(row).for_each(|(a, y)| *a += x * y);
        }
    }
    let unseen = symmetric(information).0.into_iter().filter(|x| *x < 1.0).count();
    Chosen { deviation: deviation(&chosen), random, chosen, unseen }
}

fn unit(n: usize) -> Vec<Vec<f64>> {
    (0..n).map(|i| (0..n).map(|j| f64::from(u8::from(i == j))).collect()).collect()
}

/// The candidate that tells most beside those that are taken.
fn best(rows: &[Vec<Vec<f64>>], covariance: &[Vec<f64>], taken: &[usize]) -> Option<usize> {
    let gain = |candidate: &[Vec<f64>]| {
        // log det(1 + J C Jᵀ), by its rows one after another.
        let through: Vec<Vec<f64>> =
            candidate.iter().map(|row| covariance.iter().map(|c| dot(c, row)).collect()).collect();
        let mut a: Vec<Vec<f64>> =
            candidate.iter().map(|row| through.iter().map(|t| dot(row, t)).collect()).collect();
        let mut sum = 0.0;
        a.iter_mut().enumerate().for_each(|(k, row)| row[k] += 1.0);
        for k in 0..a.len() {
            sum += a[k][k].max(1e-300).ln();
            for i in k + 1..a.len() {
                let by = a[i][k] / a[k][k];
                let (above, below) = a.split_at_mut(i);
                below[0].iter_mut().zip(&above[k]).for_each(|(x, y)| *x -= by * y);
            }
        }
        sum
    };
    (0..rows.len())
        .filter(|c| !taken.contains(c))
        .map(|c| (c, gain(&rows[c])))
        .max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0)))
        .map(|b| b.0)
}

/// The covariance after one more number with the noise 1: C − C rᵀ r C / (1 + r C rᵀ).
fn learned(covariance: &mut [Vec<f64>], row: &[f64]) {
    let through: Vec<f64> = covariance.iter().map(|c| dot(c, row)).collect();
    let by = 1.0 / (1.0 + dot(row, &through));
    for (line, x) in covariance.iter_mut().zip(&through) {
        line.iter_mut().zip(&through).for_each(|(c, y)| *c -= by * x * y);
    }
}
