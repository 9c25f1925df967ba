//! Joint velocities for a twist: bounded and continuous through singular configurations.

use super::geometric::Jacobian;
use super::measures::scaled;
use super::svd::{Svd, dot, svd};

/// How joint velocities are kept within bounds where the arm is nearly singular.
///
/// A singular value σ below `threshold` is inverted as σ/(σ² + λ²) with λ² = (1 − (σ/threshold)²)·`largest`² (Nakamura
/// and Hanafusa 1986; Chiaverini 1997): exactly where the arm is not near a singularity, less and less along the
/// direction that is lost, and continuously between. Values have no unit: lengths are divided by the arm's size.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Damping {
    /// Singular values below this are damped.
    pub threshold: f64,
    /// λ where the arm is singular.
    pub largest: f64,
}

impl Default for Damping {
    /// Damped below 0.04, by 0.02 at the most.
    fn default() -> Self {
        Damping { threshold: 0.04, largest: 0.02 }
    }
}

impl Damping {
    /// No damping: velocities grow without bound towards a singular configuration.
    pub const NONE: Damping = Damping { threshold: 0.0, largest: 0.0 };

    /// λ² for a singular value.
    fn square(&self, sigma: f64) -> f64 {
        if sigma >= self.threshold {
            0.0
        } else {
            (1.0 - (sigma / self.threshold).powi(2)) * self.largest.powi(2)
        }
    }

    /// What a singular value is multiplied with instead of being divided by; 0 for 0.
    fn inverse(&self, sigma: f64) -> f64 {
        let below = sigma * sigma + self.square(sigma);
        if below > f64::MIN_POSITIVE { sigma / below } else { 0.0 }
    }

    /// No twist of length 1 (lengths by the arm's size) asks for joint velocities larger than this.
    pub fn gain(&self) -> f64 {
        if self.largest <= 0.0 || self.threshold <= 0.0 {
            return f64::INFINITY;
        }
        // σ/(σ²(1 − r²) + λ²) with r = λ/threshold has its peak λ/√(1 − r²), if that lies below the threshold.
        let r = self.largest / self.threshold;
        let peak = self.largest / (1.0 - r * r).max(f64::MIN_POSITIVE).sqrt();
        let at_peak = if peak < self.threshold { self.inverse(peak) } else { 0.0 };
        at_peak.max(1.0 / self.threshold)
    }
}

/// Joint velocities for a twist, and what they achieve.
#[derive(Clone, PartialEq, Debug)]
pub struct JointRates {
    /// Radians or metres a second, one a joint.
    pub rates: Vec<f64>,
    /// The twist that they give, rows as in [`super::ROWS`], metres and radians a second.
    pub achieved: [f64; 6],
    /// Singular values that were damped, without unit.
    pub damped: Vec<f64>,
    /// What the velocities were multiplied with so that none exceeds its limit: 1 if none did.
    pub scale: f64,
    /// The joint whose limit decided that.
    pub slowest: Option<usize>,
}

/// Finds joint velocities for twists.
#[derive(Clone, PartialEq, Debug)]
pub struct RateSolver {
    /// Which joints turn.
    pub is_angle: Vec<bool>,
    /// The arm's size, metres: what lengths are divided by.
    pub length: f64,
    /// What happens near singular configurations.
    pub damping: Damping,
    /// Which rows of the twist are asked for; the others may come out as they like.
    pub rows: [bool; 6],
    /// The largest velocity of each joint, radians or metres a second; none if empty.
    pub limits: Vec<f64>,
}

impl RateSolver {
    /// All six rows, the usual damping, no limits.
    pub fn new(is_angle: &[bool], length: f64) -> Self {
        RateSolver {
            is_angle: is_angle.to_vec(),
            length,
            damping: Damping::default(),
            rows: [true; 6],
            limits: vec![],
        }
    }

    /// The joint velocities, the least of all if there are several, for a twist of the body.
    ///
    /// `wished`, one a joint or empty, is what the joints would rather do: it is followed as far as the twist leaves
    /// them free (its projection on the null space). If limits are exceeded, all velocities are made smaller by one
    /// factor, so that the direction of the motion stays.
    pub fn solve(&self, jacobian: &Jacobian<f64>, twist: &[f64; 6], wished: &[f64]) -> JointRates {
        let mut columns = scaled(jacobian, &self.is_angle, self.length);
        let mut wanted = [0.0; 6];
        for r in (0..6).filter(|&r| self.rows[r]) {
            wanted[r] = if r < 3 { twist[r] / self.length } else { twist[r] };
        }
        for column in &mut columns {
            (0..6).filter(|&r| !self.rows[r]).for_each(|r| column[r] = 0.0);
        }
        let decomposed = svd(columns);
        let mut rates = self.least(&decomposed, &wanted);
        if !wished.is_empty() {
            let wished: Vec<f64> = wished.iter().enumerate().map(|(j, w)| w / self.unit(j)).collect();
            rates.iter_mut().zip(self.projected(&decomposed, &wished)).for_each(|(r, w)| *r += w);
        }
        rates.iter_mut().enumerate().for_each(|(j, r)| *r *= self.unit(j));
        let (scale, slowest) = self.within_limits(&rates);
        rates.iter_mut().for_each(|r| *r *= scale);
        let is_damped = |v: &f64| *v < self.damping.threshold;
        let rank = self.rows.iter().filter(|&&r| r).count().min(rates.len());
        JointRates {
            achieved: jacobian.twist(&rates),
            damped: decomposed.values.iter().take(rank).copied().filter(is_damped).collect(),
            scale,
            slowest,
            rates,
        }
    }

    fn unit(&self, joint: usize) -> f64 {
        if self.is_angle[joint] { 1.0 } else { self.length }
    }

    /// Σ vᵢ f(σᵢ) uᵢᵀ twist.
    fn least(&self, decomposed: &Svd, twist: &[f64; 6]) -> Vec<f64> {
        let mut rates = vec![0.0; decomposed.vectors.len()];
        let parts = decomposed.vectors.iter().zip(&decomposed.images).zip(&decomposed.values);
        for ((v, image), &sigma) in parts.take(6).filter(|p| *p.1 > f64::MIN_POSITIVE) {
            let along = dot(image, twist) / sigma;
            let k = self.damping.inverse(sigma) * along;
            rates.iter_mut().zip(v).for_each(|(r, v)| *r += k * v);
        }
        rates
    }

    /// The part of a wish that the twist leaves free: a direction is given back as far as it is damped.
    fn projected(&self, decomposed: &Svd, wished: &[f64]) -> Vec<f64> {
        let mut rest = wished.to_vec();
        for (v, &sigma) in decomposed.vectors.iter().zip(&decomposed.values).take(6) {
            let along: f64 = v.iter().zip(wished).map(|(a, b)| a * b).sum();
            let used = sigma * self.damping.inverse(sigma);
            rest.iter_mut().zip(v).for_each(|(r, v)| *r -= used * along * v);
        }
        rest
    }

    fn within_limits(&self, rates: &[f64]) -> (f64, Option<usize>) {
        let over = rates.iter().zip(&self.limits).map(|(r, l)| r.abs() / l).enumerate();
        match over.max_by(|a, b| a.1.total_cmp(&b.1)) {
            Some((joint, ratio)) if ratio > 1.0 => (1.0 / ratio, Some(joint)),
            _ => (1.0, None),
        }
    }
}
