//! How many rows the pose is behind the joints, before anything else is known.
//!
//! The turning speed of the orientation and that of the model do not depend on frames; where they go up and down together
//! shows the lag, whatever the format, for a wrong one turns quickly at the same times.

use crate::data::Data;
use crate::hypothesis::Hypothesis;
use crate::turns::between;
use denavit::geometry::Rotation;

/// The most rows that are looked at, and the most that a lag may have.
const ROWS: usize = 1200;
const MOST: usize = 30;

/// The lag with the best correlation, rows; 0 where there is none to be seen.
pub fn estimate(data: &Data, bases: &[Hypothesis]) -> f64 {
    let Some((from, count)) = longest(&data.columns.follows) else { return 0.0 };
    let count = count.min(ROWS);
    let most = MOST.min(count / 4);
    if most < 1 {
        return 0.0;
    }
    let speed = |turn: &mut dyn FnMut(usize) -> Rotation<f64>| -> Vec<f64> {
        let all: Vec<Rotation<f64>> = (from..from + count).map(turn).collect();
        all.windows(2).map(|w| between(&w[0], &w[1])).collect()
    };
    let formats: Vec<Vec<f64>> = (0..data.decoded.len())
        .map(|e| speed(&mut |r| data.recorded(e, r).map_or_else(Rotation::identity, |m| m.0)))
        .collect();
    let (mut best, mut lag) = (0.0, 0.0);
    for h in bases.iter().take(6) {
        let map = h.map(data.width(), data.arm);
        let (mut row, mut q) = (vec![], vec![]);
        let model = speed(&mut |r| {
            data.row(r, 0.0, &mut row);
            map.apply(&row, &mut q);
            data.arm.rotation(&q)
        });
        for format in &formats {
            let at = |shift: isize| correlation(&model, format, shift);
            let all: Vec<f64> = (-(most as isize)..=most as isize).map(at).collect();
            let k = (0..all.len()).fold(0, |k, i| if all[i] > all[k] { i } else { k });
            if all[k] > best {
                best = all[k];
                let fine = if k > 0 && k + 1 < all.len() {
                    let (a, b, c) = (all[k - 1], all[k], all[k + 1]);
                    0.5 * (a - c) / (a - 2.0 * b + c)
                } else {
                    0.0
                };
                lag = k as f64 - most as f64 + if fine.is_finite() { fine } else { 0.0 };
            }
        }
    }
    if best > 0.3 { lag } else { 0.0 }
}

/// How much a goes up and down with b, `shift` rows later.
fn correlation(a: &[f64], b: &[f64], shift: isize) -> f64 {
    let pairs: Vec<(f64, f64)> =
        (0..a.len()).filter_map(|i| Some((a[i], *b.get(i.checked_add_signed(shift)?)?))).collect();
    let n = pairs.len().max(1) as f64;
    let (ma, mb) = pairs.iter().fold((0.0, 0.0), |(x, y), (a, b)| (x + a / n, y + b / n));
    let (mut ab, mut aa, mut bb) = (0.0, 1e-30, 1e-30);
    for (a, b) in pairs {
        ab += (a - ma) * (b - mb);
        aa += (a - ma).powi(2);
        bb += (b - mb).powi(2);
    }
    ab / (aa * bb).sqrt()
}

/// The longest run of rows that follow one another: its first row and how many it has.
fn longest(follows: &[bool]) -> Option<(usize, usize)> {
    let (mut best, mut from) = (None, 0);
    for r in 1..=follows.len() {
        if r == follows.len() || !follows[r] {
            if best.is_none_or(|(_, n)| r - from > n) {
                best = Some((from, r - from));
            }
            from = r;
        }
    }
    best
}
