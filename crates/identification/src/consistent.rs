//! Masses that can be: of all links whose second moments are positive, those that have the estimated torques and are nearest to given
//! ones.
//!
//! A body is its pseudo-inertia P, 4 × 4 (Wensing, Kim and Slotine 2018): P = [Σ h; hᵀ m], Σ = ½ tr(J) 1 − J. Some mass has these numbers
//! if and only if P is positive definite. With D(P ‖ P₀) = tr(P₀⁻¹P) − ln det P (Lee, Wensing and Park 2020),
//! ½ ‖Wβ − τ‖² + μ Σ D(Pₖ ‖ P₀ₖ) is convex in the numbers of the links: Newton's method finds its only minimum for each μ, and as μ falls to 0
//! these go to the nearest of the best. Friction and rotors are kept positive alike.

use crate::estimate::Estimate;
use crate::linear::{Square, dot};
use crate::model::{Model, What};
use denavit::dynamics::{Drive, Dynamics};
use denavit::geometry::{Body, Vector};

/// Links with masses that can be.
#[derive(Clone, Debug)]
pub struct Consistent {
    /// The links, in their own frames.
    pub bodies: Vec<Body<f64>>,
    /// Rotors and friction of the joints.
    pub drives: Vec<Drive<f64>>,
    /// What is added to the torques.
    pub offsets: Vec<f64>,
    /// The parameters that these have.
    pub values: Vec<f64>,
    /// By how much the weighted sum of squares is larger than that of the estimate.
    pub excess: f64,
    /// The parameter that is farthest off of those that are seen, in the deviations with which masses are sought: noise counts as
    /// no less than 1e-4 of the torques in them.
    pub farthest: Option<(usize, f64)>,
    /// Whether Newton's method came to its end at the last weight.
    pub is_settled: bool,
}

/// What the masses are to be near to.
#[derive(Clone, Debug)]
pub enum Prior {
    /// These links.
    Given(Vec<Body<f64>>),
    /// Links of even mass between their joints, as heavy in all as fits best.
    Neutral,
}

/// The weights of what is given, from the first to the last, and by how much they fall.
const FIRST: f64 = 1e6;
const LAST: f64 = 0.02;
const FALL: f64 = 0.1;
/// Steps of Newton's method at each weight, at most.
const STEPS: usize = 200;
/// Half the square of Newton's decrement at which it is at its end.
const SETTLED: f64 = 1e-9;
/// The least part of what is typical that a given mass, its extent or a friction counts with.
const LEAST: f64 = 1e-3;

/// The masses that can be nearest to `prior` that have what was estimated.
pub fn consistent(model: &Model, estimate: &Estimate, prior: &Prior) -> Consistent {
    let links = model.arm.links.len();
    let positive: Vec<usize> = (0..model.parameters.len())
        .filter(|&k| matches!(model.parameters[k].what, What::Rotor(_) | What::Viscous(_) | What::Coulomb(_)))
        .collect();
    let offsets: Vec<usize> = (0..model.parameters.len())
        .filter(|&k| matches!(model.parameters[k].what, What::Offset(_)))
        .collect();
    let width = 10 * links + positive.len() + offsets.len();
    // β = G x: the links' numbers, then what is positive, then offsets.
    let mut g: Vec<Vec<f64>> = vec![vec![0.0; width]; model.parameters.len()];
    for (row, of) in g.iter_mut().zip(&model.groupings) {
        row[..of.len()].copy_from_slice(of);
    }
    for (i, &k) in positive.iter().chain(&offsets).enumerate() {
        g[k][10 * links + i] = 1.0;
    }
    let information = &estimate.information;
    let ng: Vec<Vec<f64>> =
        (0..width).map(|c| information.times(&g.iter().map(|row| row[c]).collect::<Vec<_>>())).collect();
    let mut curvature = Square::zero(width);
    for (c, column) in ng.iter().enumerate() {
        for (row, &x) in g.iter().zip(column).filter(|(_, x)| **x != 0.0) {
            for (d, g) in row.iter().enumerate() {
                *curvature.at_mut(c, d) += x * g;
            }
        }
    }
    let given = match prior {
        Prior::Given(bodies) => bodies.clone(),
        Prior::Neutral => neutral(model, estimate),
    };
    let given = thickened(&given, model.size());
    let frictions: Vec<f64> = positive.iter().map(|&k| typical(model, estimate, k)).collect();
    let mut problem = Problem {
        inverses: given.iter().map(|b| pseudo(&b.parameters()).cholesky().map(|l| inverse(&l))).collect(),
        frictions,
        curvature,
        g,
        information,
        target: &estimate.values,
        links,
    };
    // A body that is none even when thickened counts as a small ball.
    for inverse in &mut problem.inverses {
        inverse.get_or_insert_with(|| {
            let mut one = Square::zero(4);
            (0..4).for_each(|i| *one.at_mut(i, i) = 1.0);
            one
        });
    }
    let mut x: Vec<f64> = problem
        .inverses
        .iter()
        .flat_map(|inverse| {
            parameters_of(
                &inverse
                    .as_ref()
                    .and_then(Square::cholesky)
                    .map_or_else(|| Square::zero(4), |l| self::inverse(&l)),
            )
        })
        .collect();
    x.extend(&problem.frictions);
    x.resize(width, 0.0);
    let last = LAST / (4 * links + positive.len()).max(1) as f64;
    let mut weight = FIRST;
    let is_settled = loop {
        let is_settled = problem.descend(&mut x, weight);
        if weight <= last {
            break is_settled;
        }
        weight = (weight * FALL).max(last);
    };
    let values: Vec<f64> = problem.g.iter().map(|row| dot(row, &x)).collect();
    let off: Vec<f64> = values.iter().zip(&estimate.values).map(|(a, b)| a - b).collect();
    let seen = (0..off.len()).filter(|&k| matches!(estimate.known[k], crate::estimate::Known::Value(..)));
    let by = |k: usize| off[k].abs() / estimate.worth.at(k, k).sqrt().max(f64::MIN_POSITIVE);
    let farthest = seen.map(|k| (k, by(k))).max_by(|a, b| a.1.total_cmp(&b.1));
    let body = |k: usize| Body::of(std::array::from_fn(|p| x[10 * k + p]));
    let mut drives = vec![Drive::nothing(); model.joints()];
    for (&k, &value) in positive.iter().zip(&x[10 * links..]) {
        match model.parameters[k].what {
            What::Rotor(j) => drives[j].rotor = value,
            What::Viscous(j) => drives[j].viscous = value,
            What::Coulomb(j) => drives[j].coulomb = value,
            What::Base(_) | What::Offset(_) => {}
        }
    }
    let mut added = vec![0.0; model.joints()];
    for (&k, &value) in offsets.iter().zip(&x[10 * links + positive.len()..]) {
        if let What::Offset(j) = model.parameters[k].what {
            added[j] = value;
        }
    }
    Consistent {
        bodies: (0..links).map(body).collect(),
        drives,
        offsets: added,
        excess: information.between(&off),
        values,
        farthest,
        is_settled,
    }
}

impl Consistent {
    /// The arm with these masses and drives.
    pub fn dynamics(&self, model: &Model) -> Dynamics<f64> {
        let mut arm = model.arm.clone();
        arm.links.iter_mut().zip(&self.bodies).for_each(|(l, b)| l.body = *b);
        arm.drives.clone_from(&self.drives);
        arm
    }
}

/// ½ (Gx − β)ᵀ N (Gx − β) + μ Σ D
struct Problem<'a> {
    /// GᵀNG
    curvature: Square,
    g: Vec<Vec<f64>>,
    information: &'a Square,
    /// β
    target: &'a [f64],
    /// P₀⁻¹ of each link.
    inverses: Vec<Option<Square>>,
    /// What frictions and rotors are to be near to.
    frictions: Vec<f64>,
    links: usize,
}

impl Problem<'_> {
    /// How far the parameters are from those of the estimate: small numbers, so that little is lost.
    fn off(&self, x: &[f64]) -> Vec<f64> {
        self.g.iter().zip(self.target).map(|(row, t)| dot(row, x) - t).collect()
    }

    /// The value; none outside of what can be.
    fn value(&self, x: &[f64], weight: f64) -> Option<f64> {
        let mut far = 0.0;
        for (k, inverse) in self.inverses.iter().enumerate() {
            let p = pseudo(&x[10 * k..10 * k + 10]);
            let l = p.cholesky()?;
            far += inverse.as_ref().map_or(0.0, |i| dot(&i.entries, &p.entries)) - l.log_det();
        }
        for (value, near) in x[10 * self.links..].iter().zip(&self.frictions) {
            if *value <= 0.0 {
                return None;
            }
            far += value / near - (value / near).ln();
        }
        Some(0.5 * self.information.between(&self.off(x)) + weight * far)
    }

    /// Newton's method from a point of what can be; whether it came to its end.
    fn descend(&self, x: &mut Vec<f64>, weight: f64) -> bool {
        let Some(mut now) = self.value(x, weight) else { return false };
        for _ in 0..STEPS {
            let pulled = self.information.times(&self.off(x));
            let mut slope = vec![0.0; x.len()];
            for (row, p) in self.g.iter().zip(&pulled) {
                slope.iter_mut().zip(row).for_each(|(s, g)| *s += p * g);
            }
            let mut second = self.curvature.clone();
            for (k, inverse) in self.inverses.iter().enumerate() {
                let Some(l) = pseudo(&x[10 * k..10 * k + 10]).cholesky() else { return false };
                let own = self::inverse(&l);
                let mixed: Vec<Square> = (0..10).map(|p| product(&own, &unit(p))).collect();
                for p in 0..10 {
                    let e = unit(p);
                    let given = inverse.as_ref().map_or(0.0, |i| dot(&i.entries, &e.entries));
                    slope[10 * k + p] += weight * (given - dot(&own.entries, &e.entries));
                    for q in 0..10 {
                        // tr(P⁻¹E P⁻¹F)
                        let trace: f64 = (0..4)
                            .flat_map(|i| (0..4).map(move |j| (i, j)))
                            .map(|(i, j)| mixed[p].at(i, j) * mixed[q].at(j, i))
                            .sum();
                        *second.at_mut(10 * k + p, 10 * k + q) += weight * trace;
                    }
                }
            }
            for (i, near) in self.frictions.iter().enumerate() {
                let at = 10 * self.links + i;
                slope[at] += weight * (1.0 / near - 1.0 / x[at]);
                *second.at_mut(at, at) += weight / (x[at] * x[at]);
            }
            let Some(step) = newton(&second, &slope) else { return false };
            let decrement = -dot(&step, &slope);
            if decrement <= 2.0 * SETTLED * weight.min(1.0) {
                return true;
            }
            let mut size = 1.0;
            loop {
                let next: Vec<f64> = x.iter().zip(&step).map(|(a, b)| a + size * b).collect();
                if let Some(value) = self.value(&next, weight)
                    && value <= now - 1e-4 * size * decrement
                {
                    (*x, now) = (next, value);
                    break;
                }
                size *= 0.5;
                if size < 1e-10 {
                    // What is left is rounding, by the size of what is added up.
                    return decrement < 1e-9 * now.abs().max(weight);
                }
            }
        }
        false
    }
}

/// −H⁻¹ g, H with a diagonal of 1 first; a little more on it where rounding has made it singular.
fn newton(second: &Square, slope: &[f64]) -> Option<Vec<f64>> {
    let n = second.n;
    let scale: Vec<f64> = (0..n).map(|i| 1.0 / second.at(i, i).max(1e-300).sqrt()).collect();
    let mut one = second.clone();
    for i in 0..n {
        for j in 0..n {
            *one.at_mut(i, j) *= scale[i] * scale[j];
        }
    }
    let right: Vec<f64> = slope.iter().zip(&scale).map(|(g, s)| -g * s).collect();
    let mut more = 0.0;
    for _ in 0..6 {
        let mut with = one.clone();
        (0..n).for_each(|i| *with.at_mut(i, i) += more);
        if let Some(l) = with.cholesky() {
            let mut x = l.solved(&right);
            // Once more on what is left: the factors are those of doubles.
            let left: Vec<f64> = one.times(&x).iter().zip(&right).map(|(a, b)| b - a).collect();
            x.iter_mut().zip(l.solved(&left)).for_each(|(a, b)| *a += b);
            return Some(x.iter().zip(&scale).map(|(a, s)| a * s).collect());
        }
        more = if more == 0.0 { 1e-15 } else { 10.0 * more };
    }
    None
}

/// P of the ten numbers.
fn pseudo(numbers: &[f64]) -> Square {
    let [xx, xy, xz, yy, yz, zz, mx, my, mz, m] = std::array::from_fn(|k| numbers[k]);
    let [a, b, c] = [(yy + zz - xx) / 2.0, (xx + zz - yy) / 2.0, (xx + yy - zz) / 2.0];
    let entries = vec![a, -xy, -xz, mx, -xy, b, -yz, my, -xz, -yz, c, mz, mx, my, mz, m];
    Square { n: 4, entries }
}

/// The ten numbers of P.
fn parameters_of(p: &Square) -> [f64; 10] {
    let [a, b, c] = [p.at(0, 0), p.at(1, 1), p.at(2, 2)];
    [
        b + c,
        -p.at(0, 1),
        -p.at(0, 2),
        a + c,
        -p.at(1, 2),
        a + b,
        p.at(0, 3),
        p.at(1, 3),
        p.at(2, 3),
        p.at(3, 3),
    ]
}

/// ∂P by a number.
fn unit(number: usize) -> Square {
    let mut one = [0.0; 10];
    one[number] = 1.0;
    pseudo(&one)
}

fn inverse(l: &Square) -> Square {
    let n = l.n;
    let mut all = Square::zero(n);
    for j in 0..n {
        let one: Vec<f64> = (0..n).map(|i| f64::from(u8::from(i == j))).collect();
        l.solved(&one).into_iter().enumerate().for_each(|(i, x)| *all.at_mut(i, j) = x);
    }
    all
}

fn product(a: &Square, b: &Square) -> Square {
    let n = a.n;
    let mut all = Square::zero(n);
    for i in 0..n {
        for j in 0..n {
            *all.at_mut(i, j) = (0..n).map(|k| a.at(i, k) * b.at(k, j)).sum();
        }
    }
    all
}

/// By how much the estimate is larger than the parameters of these links, as far as one number says it; none where nothing does.
pub fn scale(model: &Model, estimate: &Estimate, bodies: &[Body<f64>]) -> Option<f64> {
    let mut values = vec![0.0; model.parameters.len()];
    let base = model.base_of(bodies);
    values[..base.len()].copy_from_slice(&base);
    let weighted = estimate.information.times(&values);
    let by = dot(&weighted, &estimate.values) / dot(&weighted, &values);
    by.is_finite().then_some(by)
}

/// The mass of even links that fits the estimate best, kilograms; below 0 where the torques have the other sign.
pub fn even_mass(model: &Model, estimate: &Estimate) -> Option<f64> {
    let bodies = even(model);
    scale(model, estimate, &bodies).map(|by| by * bodies.len() as f64)
}

/// Even links between their joints, as heavy in all as fits the estimate best.
fn neutral(model: &Model, estimate: &Estimate) -> Vec<Body<f64>> {
    let bodies = even(model);
    let mass = scale(model, estimate, &bodies).filter(|m| *m > 0.0).unwrap_or(1.0);
    bodies.iter().map(|b| b.map(|x| mass * x)).collect()
}

/// Links of a kilogram each between their joints.
fn even(model: &Model) -> Vec<Body<f64>> {
    let links = &model.arm.links;
    let usual = 0.1 * model.size();
    let shape = |k: usize| {
        let next = links.iter().find(|l| l.parent == Some(k)).map(|l| l.before.translation);
        let last = if k + 1 == links.len() { model.arm.tool.translation } else { Vector::zero() };
        let end = next.unwrap_or(last);
        let extent = (0.3 * end.norm()).max(usual);
        let own = 0.4 * extent * extent;
        Body::about_centre(1.0, end.scale(0.5), [own, 0.0, 0.0, own, 0.0, own])
    };
    (0..links.len()).map(shape).collect()
}

/// The bodies with a little extent in all directions, and a little mass where they have none.
fn thickened(bodies: &[Body<f64>], size: f64) -> Vec<Body<f64>> {
    let mean = bodies.iter().map(|b| b.mass.max(0.0)).sum::<f64>() / bodies.len().max(1) as f64;
    let mean = if mean > 0.0 { mean } else { 1.0 };
    let thicker = |b: &Body<f64>| {
        if pseudo(&b.parameters()).eigen().last().is_some_and(|e| e.0 > 1e-9 * mean * size * size) {
            return *b;
        }
        let mass = b.mass.max(LEAST * mean);
        let own = LEAST * mass * size * size;
        let centre = b.at_centre().map_or_else(Vector::zero, |c| c.0);
        let inertia = b.at_centre().filter(|_| b.check().is_ok()).map_or([0.0; 6], |c| c.1);
        let [xx, xy, xz, yy, yz, zz] = inertia;
        Body::about_centre(mass, centre, [xx + own, xy, xz, yy + own, yz, zz + own])
    };
    bodies.iter().map(thicker).collect()
}

/// What a friction or a rotor is taken to be before anything is known.
fn typical(model: &Model, estimate: &Estimate, k: usize) -> f64 {
    let (value, deviation) = (estimate.values[k], estimate.covariance.at(k, k).max(0.0).sqrt());
    let joint = match model.parameters[k].what {
        What::Rotor(j) | What::Viscous(j) | What::Coulomb(j) | What::Offset(j) => j,
        What::Base(_) => 0,
    };
    let least = LEAST * estimate.joints[joint].torque.max(1e-6);
    if value > deviation { value.max(least) } else { least }
}
