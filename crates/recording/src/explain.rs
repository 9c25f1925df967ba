//! Steps 8 and 9: another arm of the same kind, then one fitted number after another, where the best reading leaves too much.

use crate::arm::{self, Arm};
use crate::fit::Extra;
use crate::hypothesis::Move;
use crate::search::{Reading, Search};
use std::collections::BTreeSet;
use std::f64::consts::FRAC_PI_2;
use std::rc::Rc;

/// Up to this a reading explains the recording.
pub const GOOD: f64 = 1.05;
/// What a fitted number has to gain, nats.
const GAIN: f64 = 8.0;
/// What another arm has to gain over the one that is named, nats.
const OTHER: f64 = 8.0;

/// The best reading out of those that were searched, whatever else it takes.
pub fn best<'a>(search: &Search<'a>, found: &[Reading<'a>], with_others: bool) -> Reading<'a> {
    let mut best = found[0].clone();
    let both = best.has_base && best.has_tool;
    if with_others && (best.rho > 1.15 || both) {
        let other = others(search, found, &best);
        if other.as_ref().is_some_and(|o| o.score < best.score - OTHER + 4.0) {
            best = other.expect("it is there");
        }
    }
    let frames = best.has_base || best.has_tool;
    let is_other = !std::ptr::eq(best.arm, search.data.arm);
    if best.rho > GOOD || (is_other && frames) {
        best = with_numbers(search, found, best);
    } else if best.has_base || best.has_tool {
        best = without_frames(search, best);
    }
    best
}

/// The best of the arms with the same kinds of joints.
fn others<'a>(search: &Search<'a>, found: &[Reading<'a>], best: &Reading<'a>) -> Option<Reading<'a>> {
    let mut seen = BTreeSet::new();
    let mut readings = vec![];
    for r in found {
        if readings.len() < 3 && seen.insert((r.hypothesis.key(), r.format)) {
            readings.push((r.hypothesis.clone(), r.format));
        }
    }
    let mut winner: Option<Reading<'a>> = None;
    let own = search.data.arm;
    let is_other = |a: &&Arm| a.is_like(own) && a.name != own.name && !same(a, own);
    for arm in arm::all().iter().filter(is_other) {
        let more = search.of_other(arm, 3);
        let all = readings.iter().chain(&more);
        let mut framed: Vec<Reading<'a>> = all.flat_map(|(h, e)| search.framed(h, *e, arm)).collect();
        framed.sort_by(|a, b| a.score.total_cmp(&b.score));
        for start in framed.iter().take(2) {
            // An arm that is far off needs no fits.
            if start.rho > 4.0 * best.rho.max(2.0) {
                continue;
            }
            for free in [[true, true], [false, false], [false, true], [true, false]] {
                let z = search.finish(start, &[], free, 6);
                if winner.as_ref().is_none_or(|w| z.score < w.score) {
                    winner = Some(z);
                }
            }
        }
    }
    winner
}

/// True for arms with the same numbers.
fn same(a: &Arm, b: &Arm) -> bool {
    let pairs = a.constants.iter().zip(&b.constants);
    a.constants.len() == b.constants.len()
        && pairs.into_iter().all(|(x, y)| {
            let [x, y] = [x, y].map(|x| x.matrix().concat());
            x.iter().zip(&y).all(|(x, y)| (x - y).abs() < 1e-9)
        })
}

/// Every number that may be off.
fn numbers(arm: &Arm) -> Vec<Extra> {
    let turning: Vec<usize> = arm.turning().collect();
    let mut all = vec![Extra::Lag];
    all.extend((0..arm.joints()).map(Extra::Zero));
    all.extend(turning.iter().map(|&i| Extra::Gain(i)));
    all.extend(turning.iter().filter(|&&i| i > 0 && arm.turns[i - 1]).map(|&i| Extra::Couple(i)));
    all.extend(arm.lengths().into_iter().map(|(k, axis)| Extra::Length(k, axis)));
    all
}

/// The best of one number more.
fn one_more<'a>(search: &Search<'a>, reading: &Reading<'a>) -> Option<Reading<'a>> {
    let has = |e: &Extra| reading.fit.extras.iter().any(|x| x.0 == *e);
    let tried = numbers(reading.arm).into_iter().filter(|e| !has(e)).map(|e| {
        let mut extras = reading.fit.extras.clone();
        extras.push((e, 0.0));
        search.finish(reading, &extras, reading.free, 5)
    });
    tried.min_by(|a, b| a.score.total_cmp(&b.score))
}

/// With up to two fitted numbers, from the best readings.
fn with_numbers<'a>(search: &Search<'a>, found: &[Reading<'a>], best: Reading<'a>) -> Reading<'a> {
    let mut starts = vec![best.clone()];
    starts.extend(found.iter().take(4).filter(|r| r.rho > GOOD).cloned());
    starts.extend(found.iter().skip(4).filter(|r| r.hypothesis.moves.is_empty()).take(2).cloned());
    let mut winner = best;
    for start in starts.into_iter().take(6) {
        let mut now = start;
        for _ in 0..2 {
            let Some(more) = one_more(search, &now) else { break };
            if more.score >= now.score - GAIN {
                break;
            }
            now = more;
            if now.rho < GOOD {
                break;
            }
        }
        if now.score < winner.score {
            winner = now;
        }
    }
    winner = exact(search, fewer(search, winner));
    if !winner.fit.extras.is_empty() && (winner.has_base || winner.has_tool) {
        for free in [[false, false], [false, true], [true, false]] {
            let z = search.finish(&winner, &winner.fit.extras.clone(), free, 8);
            if z.score < winner.score {
                winner = z;
            }
        }
    }
    winner
}

/// Without a number that does not pay for itself once the other is there.
fn fewer<'a>(search: &Search<'a>, mut winner: Reading<'a>) -> Reading<'a> {
    while winner.fit.extras.len() > 1 {
        let without = |k: usize| {
            let mut extras = winner.fit.extras.clone();
            extras.remove(k);
            search.finish(&winner, &extras, winner.free, 6)
        };
        let best = (0..winner.fit.extras.len()).map(without).min_by(|a, b| a.score.total_cmp(&b.score));
        match best {
            Some(z) if z.score < winner.score => winner = z,
            _ => break,
        }
    }
    winner
}

/// A fitted number that is nearly an exact slip, as that slip: a gain of −1 is a sign.
fn exact<'a>(search: &Search<'a>, winner: Reading<'a>) -> Reading<'a> {
    let near = |x: f64, y: f64| (x - y).abs() < 0.03;
    for (k, &(extra, value)) in winner.fit.extras.iter().enumerate() {
        let quarters = (value / FRAC_PI_2).round();
        let one = match extra {
            Extra::Gain(i) if near(value, -2.0) => Move::Flip(i),
            Extra::Gain(i) if near(value, 1.0) => Move::Gain(i, -2),
            Extra::Gain(i) if near(value, -0.5) => Move::Gain(i, 2),
            Extra::Couple(i) if near(value.abs(), 1.0) => Move::Couple(i, if value > 0.0 { 1 } else { -1 }),
            Extra::Zero(i) if winner.arm.turns[i] && quarters != 0.0 && near(value, quarters * FRAC_PI_2) => {
                Move::Quarter(i, [0, 1, 2, -1][(quarters as i64).rem_euclid(4) as usize])
            }
            _ => continue,
        };
        let mut start = winner.clone();
        let hypothesis = winner.hypothesis.plus(one);
        start.map = Rc::new(hypothesis.map(search.data.width(), winner.arm));
        start.hypothesis = Rc::new(hypothesis);
        let mut extras = winner.fit.extras.clone();
        extras.remove(k);
        let z = search.finish(&start, &extras, winner.free, 8);
        if z.score < winner.score {
            return exact(search, z);
        }
    }
    winner
}

/// A frame may hide a length, or a zero: one number instead of base, tool or both, where that is the better reading.
fn without_frames<'a>(search: &Search<'a>, best: Reading<'a>) -> Reading<'a> {
    let mut winner = best.clone();
    for free in [[false, false], [false, true], [true, false]] {
        let drops = (best.has_base && !free[0]) || (best.has_tool && !free[1]);
        if !drops {
            continue;
        }
        let start = search.finish(&best, &[], free, 6);
        if let Some(z) = one_more(search, &start)
            && z.score < winner.score
        {
            winner = z;
        }
    }
    winner
}
