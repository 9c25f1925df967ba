//! Families along which the joints move in the same proportions everywhere: straight lines in the space of the joints,
//! named by a joint that moves, with what the limits allow of them.

use super::answer::Family;
use crate::space::JointSpace;

/// Joints that move by less do not move, by the one that moves most.
const STILL: f64 = 1e-9;

/// Names a family that was followed: a line by the joint that moves most, a curve by its length `s`; and says where the
/// limits allow it, where that is not known yet.
pub(super) fn describe(family: &mut Family, space: &JointSpace, names: &[String]) {
    if family.dimension != 1 {
        return;
    }
    let [free] = &mut family.free[..] else { return };
    let is_by_length = *free == "s";
    if is_by_length && family.is_affine {
        let d = &family.direction;
        let lead = (0..d.len()).max_by(|&a, &b| d[a].abs().total_cmp(&d[b].abs()));
        free.clone_from(&names[lead.unwrap_or_default()]);
    }
    let lead = names.iter().position(|name| name == free);
    match lead.filter(|_| family.is_affine) {
        Some(lead) => along_line(family, space, lead),
        None if is_by_length => along_curve(family, space),
        None => {}
    }
}

/// A line by the value of a joint.
fn along_line(family: &mut Family, space: &JointSpace, lead: usize) {
    let (q, d) = (&family.representative.q, &family.direction);
    let moves = |j: &usize| d[*j].abs() > STILL * d[lead].abs();
    let period = space.turning.windows[lead];
    let range = if period.is_finite() { Some([-0.5 * period, 0.5 * period]) } else { space.limits[lead] };
    let (Some([low, high]), true) = (range, moves(&lead)) else { return };
    family.interval = family.interval.or(Some([low, high]));
    let moving: Vec<usize> = (0..q.len()).filter(moves).collect();
    if moving.iter().all(|&j| space.limits[j].is_none()) || !family.feasible.is_empty() {
        return;
    }
    // At x of the leading joint, joint j is at qⱼ + (x − q_lead) dⱼ/d_lead.
    let slope = |j: usize| d[j] / d[lead];
    let at = |x: f64| -> Vec<f64> { (0..q.len()).map(|j| q[j] + (x - q[lead]) * slope(j)).collect() };
    let mut cuts = vec![low, high];
    for &j in &moving {
        for limit in space.limits[j].into_iter().flatten() {
            let (here, window) = (at(low)[j], space.turning.windows[j]);
            let way = (at(high)[j] - here).abs();
            // Each copy of the limit that is passed on the way.
            let copies = if window.is_finite() { (way / window).ceil() as i32 + 1 } else { 0 };
            let nearest = if window.is_finite() { ((here - limit) / window).round() } else { 0.0 };
            for k in -copies..=copies {
                let turned = if window.is_finite() { (nearest + f64::from(k)) * window } else { 0.0 };
                cuts.push(low + (limit + turned - here) / slope(j));
            }
        }
    }
    cuts.retain(|x| (low..=high).contains(x));
    cuts.sort_by(f64::total_cmp);
    for pair in cuts.windows(2).filter(|pair| pair[0] < pair[1]) {
        if !space.within(&at(f64::midpoint(pair[0], pair[1]))) {
            continue;
        }
        match family.feasible.last_mut() {
            Some(last) if last[1] == pair[0] => last[1] = pair[1],
            _ => family.feasible.push([pair[0], pair[1]]),
        }
    }
}

/// A curve by its length: members next to each other that the limits allow make a stretch.
fn along_curve(family: &mut Family, space: &JointSpace) {
    let mut s = vec![0.0];
    for pair in family.curve.windows(2) {
        let way = space.way(&pair[0], &pair[1]);
        s.push(s[s.len() - 1] + way.iter().map(|x| x * x).sum::<f64>().sqrt());
    }
    if family.curve.len() < 2 {
        return;
    }
    family.interval = family.interval.or(Some([0.0, s[s.len() - 1]]));
    if space.limits.iter().all(Option::is_none) || !family.feasible.is_empty() {
        return;
    }
    let is_within: Vec<bool> = family.curve.iter().map(|q| space.within(q)).collect();
    for k in (1..s.len()).filter(|&k| is_within[k] && is_within[k - 1]) {
        match family.feasible.last_mut() {
            Some(last) if last[1] == s[k - 1] => last[1] = s[k],
            _ => family.feasible.push([s[k - 1], s[k]]),
        }
    }
}
