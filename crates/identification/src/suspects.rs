//! What no arm does: torques that fit better with another sign or unit, inertias and frictions below 0, another gravity.

use crate::consistent::even_mass;
use crate::estimate::{Estimate, Known};
use crate::linear::Square;
use crate::model::{Model, What};
use crate::motion::Motion;
use crate::observations::{Normal, Observations};
use denavit::geometry::Vector;

/// What is suspect of a recording.
#[derive(Clone, PartialEq, Debug)]
pub enum Suspect {
    /// The torque of a joint has the other sign: what is left over of all torques falls to this part with it turned round.
    Sign(usize, f64),
    /// The torques of a joint fit the others when they are multiplied with this: what is left over falls to this part.
    Factor(usize, f64, f64),
    /// All torques have the other sign: all inertias that joints feel are below 0.
    AllSigns,
    /// The inertia that a joint feels is below 0: its least value, and its deviation.
    Inertia(usize, f64, f64),
    /// The friction of a joint drives it: the parameter, its value, its deviation.
    Friction(usize, f64, f64),
    /// Torques fit another direction of gravity: what is left over falls to this part.
    Gravity([f64; 3], f64),
    /// Even links with these torques would weigh this, kg: no arm of this size does.
    Mass(f64),
    /// More than this part of a joint's torque is not explained.
    Unexplained(usize, f64),
}

/// What is left over has to fall below this part for a suspicion to be said.
const FALLS: f64 = 0.35;
/// Fits that leave less than this of the torques, squared, are not suspect.
const GOOD: f64 = 1e-4;
/// Of a joint's torque at most this part goes without a word.
const SHARE: f64 = 0.5;
/// Kilograms of an arm by metres of its links, at least and at most: torques in N mm or kN m make a thousand of it.
const LIGHT: f64 = 0.03;
const HEAVY: f64 = 3000.0;
/// So many deviations below 0 are below 0.
const BELOW: f64 = 4.0;
/// What torques are multiplied with by a slip: units, degrees.
const FACTORS: [f64; 7] = [-1.0, 1e-3, 1e3, -1e-3, -1e3, 0.01, 100.0];
/// Parts of the torques taken for noise while hypotheses are compared.
const NOISE: f64 = 0.02;

/// All that is suspect, gravity apart.
pub fn suspects(model: &Model, all: &Observations, estimate: &Estimate, sizes: &[f64]) -> Vec<Suspect> {
    let mut found = signs(all, sizes);
    if !found.is_empty() {
        return found;
    }
    found = inertias(model, all, estimate);
    let mass = even_mass(model, estimate).filter(|_| model.arm.gravity.norm() > 0.1);
    let is_one = |m: f64| (LIGHT * model.size()..HEAVY * model.size()).contains(&m);
    found.extend(mass.filter(|m| *m > 0.0 && !is_one(*m)).map(Suspect::Mass));
    for (k, p) in model.parameters.iter().enumerate() {
        if let (What::Viscous(_) | What::Coulomb(_) | What::Rotor(_), Known::Value(x, s)) =
            (p.what, estimate.known[k])
            && x + BELOW * s < 0.0
        {
            found.push(Suspect::Friction(k, x, s));
        }
    }
    for (j, of) in estimate.joints.iter().enumerate().filter(|(_, of)| of.rows > 0) {
        if of.left > SHARE * of.torque {
            found.push(Suspect::Unexplained(j, of.left / of.torque));
        }
    }
    found
}

/// The sums of each joint.
fn normals(all: &Observations) -> Vec<Normal> {
    let mut normals = vec![Normal::none(all.width); all.joints];
    all.rows.iter().for_each(|r| normals[r.joint].take(r, 1.0));
    normals
}

/// What is left of the torques, each in parts of its own, when those of joints are multiplied with factors.
fn left(normals: &[Normal], factors: &[f64], sizes: &[f64]) -> f64 {
    let mut whole = Normal::none(sizes.len());
    let mut scaled: Vec<Normal> = vec![];
    let mut count = 0;
    for (own, &f) in normals.iter().zip(factors) {
        let mut own = own.clone();
        own.right.iter_mut().for_each(|r| *r *= f);
        own.torques *= f * f;
        if own.torques > 0.0 {
            whole.add(&own, own.rows as f64 / (own.torques * NOISE * NOISE));
            count += 1;
        }
        scaled.push(own);
    }
    // Parameters are about as large as such arms have them: that makes every sum of squares regular.
    let largest = factors.iter().fold(1.0_f64, |m, f| m.max(f.abs()));
    let n = sizes.len();
    let mut one = whole.square.clone();
    for i in 0..n {
        for j in 0..n {
            *one.at_mut(i, j) *= sizes[i] * sizes[j] * largest * largest;
        }
        *one.at_mut(i, i) += 1.0;
    }
    let right: Vec<f64> = whole.right.iter().zip(sizes).map(|(r, s)| r * s * largest).collect();
    let Some(l) = one.cholesky() else { return f64::INFINITY };
    let values: Vec<f64> = l.solved(&right).iter().zip(sizes).map(|(x, s)| x * s * largest).collect();
    let parts = scaled.iter().filter(|n| n.torques > 0.0).map(|n| n.left(&values) / n.torques);
    parts.sum::<f64>() / f64::from(count).max(1.0)
}

/// Joints whose torques fit those of the others with another sign or unit: the best one after the other.
fn signs(all: &Observations, sizes: &[f64]) -> Vec<Suspect> {
    let normals = normals(all);
    let mut factors = vec![1.0; all.joints];
    let mut now = left(&normals, &factors, sizes);
    let first = now;
    let mut gains: Vec<(usize, f64)> = vec![];
    while now > GOOD && gains.len() < all.joints {
        let mut best: Option<(usize, f64, f64)> = None;
        for j in (0..all.joints).filter(|&j| factors[j] == 1.0) {
            for f in FACTORS {
                let mut tried = factors.clone();
                tried[j] = f;
                let then = left(&normals, &tried, sizes);
                if best.is_none_or(|b| then < b.2) {
                    best = Some((j, f, then));
                }
            }
        }
        match best {
            Some((j, f, then)) if then < now * 0.8 => {
                factors[j] = f;
                now = then;
                gains.push((j, f));
            }
            _ => break,
        }
    }
    // As one joint is like another, the fewer are the ones that are other.
    if now >= FALLS * first || gains.is_empty() {
        return vec![];
    }
    let flipped = factors.iter().filter(|f| **f == -1.0).count();
    let (flipped, part) = (flipped, now / first);
    if flipped == gains.len() && 2 * flipped > all.joints {
        let others = (0..all.joints).filter(|&j| factors[j] == 1.0);
        return others.map(|j| Suspect::Sign(j, part)).collect();
    }
    let say =
        |&(j, f): &(usize, f64)| if f == -1.0 { Suspect::Sign(j, part) } else { Suspect::Factor(j, f, part) };
    let mut all: Vec<Suspect> = gains.iter().map(say).collect();
    all.sort_by_key(|s| match s {
        Suspect::Sign(j, _) | Suspect::Factor(j, ..) => *j,
        _ => 0,
    });
    all
}

/// Inertias that joints feel, A_jj(q), at configurations of the motion.
fn inertias(model: &Model, all: &Observations, estimate: &Estimate) -> Vec<Suspect> {
    let still = vec![0.0; model.joints()];
    let free = model.under(Vector::zero());
    // The least of each joint, with its deviation, and whether one is certainly above 0.
    let mut least: Vec<Option<(f64, f64)>> = vec![None; model.joints()];
    let mut is_above = vec![false; model.joints()];
    for q in &all.configurations {
        for j in 0..model.joints() {
            let mut pull = still.clone();
            pull[j] = 1.0;
            let mut rows = vec![];
            free.observe(q, &still, &pull, &mut rows);
            let mut row = rows.swap_remove(j);
            for (x, p) in row.iter_mut().zip(&model.parameters) {
                if matches!(p.what, What::Viscous(_) | What::Coulomb(_) | What::Offset(_)) {
                    *x = 0.0;
                }
            }
            let value = crate::linear::dot(&row, &estimate.values);
            let deviation = spread(&estimate.covariance, &row);
            is_above[j] |= value > BELOW * deviation;
            if value + BELOW * deviation < 0.0 && least[j].is_none_or(|l| value < l.0) {
                least[j] = Some((value, deviation));
            }
        }
    }
    let below = least.iter().flatten().count();
    if below > 0
        && below == (0..model.joints()).filter(|&j| least[j].is_some() || is_above[j]).count()
        && !is_above.contains(&true)
    {
        return vec![Suspect::AllSigns];
    }
    let of = |(j, l): (usize, &Option<(f64, f64)>)| l.map(|(x, s)| Suspect::Inertia(j, x, s));
    least.iter().enumerate().filter_map(of).collect()
}

/// The deviation of a sum of parameters.
fn spread(covariance: &Square, row: &[f64]) -> f64 {
    covariance.between(row).max(0.0).sqrt()
}

/// Another direction of gravity along an axis of the base that the torques fit much better; nothing where what is left is little.
pub fn gravity(model: &Model, motion: &Motion, all: &Observations, sizes: &[f64]) -> Option<Suspect> {
    let own = model.arm.gravity;
    let factors = vec![1.0; all.joints];
    let first = left(&normals(all), &factors, sizes);
    if first < GOOD {
        return None;
    }
    let size = if own.norm() > 0.0 { own.norm() } else { 9.81 };
    let mut best: Option<([f64; 3], f64)> = None;
    for axis in 0..3 {
        for sign in [1.0, -1.0] {
            let mut g = [0.0; 3];
            g[axis] = sign * size;
            if (Vector(g) - own).norm() < 1e-6 * size {
                continue;
            }
            let other = Observations::of(&model.under(Vector(g)), motion);
            let part = left(&normals(&other), &factors, sizes) / first;
            if best.is_none_or(|b| part < b.1) {
                best = Some((g, part));
            }
        }
    }
    best.filter(|b| b.1 < FALLS).map(|(g, part)| Suspect::Gravity(g, part))
}
