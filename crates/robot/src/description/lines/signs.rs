//! Which way common normals point: so that a table has few offsets, and those small and positive, as makers print it.

use super::Draft;
use denavit_symbolic::{Angle, Expr};
use std::cmp::Ordering;
use std::f64::consts::{PI, TAU};

/// What a table is judged by: offsets of joint angles, the sum of their sizes, lengths below 0, twists below 0.
type Cost = [f64; 4];

/// The cheapest way to a normal: its cost, and the ways of the normals before it (true: turned round).
type Way = (Cost, Vec<bool>);

/// Turns normals round until the table is the plainest: by dynamic programming over the two ways of each.
pub(super) fn choose(rows: &mut [Draft]) {
    let mut best: [Option<Way>; 2] = [Some(([0.0; 4], vec![])), None];
    for row in rows.iter() {
        let mut next: [Option<Way>; 2] = [None, None];
        for (before, way) in best.iter().enumerate() {
            let Some((cost, way)) = way else { continue };
            for after in [0, 1].into_iter().filter(|&after| !row.is_free || after == before) {
                let added = cost_of(row, before != after, after == 1);
                let sum: Cost = [0, 1, 2, 3].map(|i| cost[i] + added[i]);
                let is_better = |w: &Way| compare(&sum, &w.0) == Ordering::Less;
                if next[after].as_ref().is_none_or(is_better) {
                    next[after] = Some((sum, [way.as_slice(), &[after == 1]].concat()));
                }
            }
        }
        best = next;
    }
    let cheapest = best.into_iter().flatten().reduce(|a, b| match compare(&b.0, &a.0) {
        Ordering::Less => b,
        _ => a,
    });
    let Some((_, ways)) = cheapest else { return };
    let mut before = false;
    for (row, after) in rows.iter_mut().zip(ways) {
        if before != after {
            row.theta = within_turn(row.theta + Expr::pi());
        }
        if after {
            row.a = -row.a;
            row.alpha = within_turn(-row.alpha);
        }
        before = after;
    }
}

fn cost_of(row: &Draft, is_turned: bool, is_negative: bool) -> Cost {
    let number = |e: Expr| e.eval(|_| None).unwrap_or(0.0);
    let mut theta = number(row.theta) + if is_turned { PI } else { 0.0 };
    theta -= TAU * (theta / TAU).round();
    let sign = if is_negative { -1.0 } else { 1.0 };
    let (a, alpha) = (sign * number(row.a), sign * number(row.alpha));
    let one = |is: bool| if is { 1.0 } else { 0.0 };
    let is_offset = row.motion.is_some() && theta.abs() > 1e-15;
    [one(is_offset), theta.abs(), one(a < 0.0), one(alpha < -1e-15 && alpha > 1e-9 - PI)]
}

/// Lexicographically, sums of angles up to rounding.
fn compare(a: &Cost, b: &Cost) -> Ordering {
    let pairs = a.iter().zip(b);
    let mut orders = pairs.map(|(x, y)| if (x - y).abs() < 1e-9 { Ordering::Equal } else { x.total_cmp(y) });
    orders.find(|o| o.is_ne()).unwrap_or(Ordering::Equal)
}

/// An angle that is a number, in (−π, π].
pub(super) fn within_turn(angle: Expr) -> Expr {
    let form = Angle::of(angle);
    match angle.eval(|_| None) {
        Ok(x) => {
            let turns = (x / TAU - 1e-9).round() as i64;
            Angle::of(form.to_expr() - Expr::pi() * Expr::int(2 * turns)).to_expr()
        }
        Err(_) => form.to_expr(),
    }
}
