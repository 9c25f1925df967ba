//! Filters without delay, derivatives, and where the motion of a column ends and its noise begins.

use std::f64::consts::{PI, SQRT_2, TAU};

/// No recording has so many rows: a filter that needs more settles in none.
const MOST_ROWS: f64 = 1e12;

/// A section of second order, direct form II transposed.
#[derive(Clone, Copy, Debug)]
struct Section {
    b: [f64; 3],
    a: [f64; 2],
}

/// Butterworth's low pass of order 4, to run forwards and backwards: in all 1/(1 + (f/fc)⁸), without delay.
#[derive(Clone, Debug)]
pub struct LowPass {
    sections: [Section; 2],
    /// Rows until what was before is forgotten.
    pub settles: usize,
}

impl LowPass {
    /// With the frequency at which a half is left, as a part of the rate of rows: below a half.
    pub fn new(cutoff: f64) -> Self {
        let k = (PI * cutoff.clamp(1e-6, 0.499)).tan();
        let section = |m: u32| {
            // The poles' pairs: s² + 2 sin((2m + 1)π/8) s + 1.
            let damping = 2.0 * (f64::from(2 * m + 1) * PI / 8.0).sin();
            let over = 1.0 / (1.0 + damping * k + k * k);
            let b = k * k * over;
            Section {
                b: [b, 2.0 * b, b],
                a: [2.0 * (k * k - 1.0) * over, (1.0 - damping * k + k * k) * over],
            }
        };
        LowPass { sections: [section(0), section(1)], settles: (1.0 / cutoff).ceil().min(MOST_ROWS) as usize }
    }

    /// Forwards and backwards over a column that is mirrored through its ends.
    pub fn applied(&self, x: &[f64]) -> Vec<f64> {
        let n = x.len();
        if n < 2 {
            return x.to_vec();
        }
        let pad = (3 * self.settles).min(n - 1);
        let mut all: Vec<f64> = (1..=pad).rev().map(|k| 2.0 * x[0] - x[k]).collect();
        all.extend(x);
        all.extend((1..=pad).map(|k| 2.0 * x[n - 1] - x[n - 1 - k]));
        for _ in 0..2 {
            for s in &self.sections {
                s.run(&mut all);
            }
            all.reverse();
        }
        all[pad..pad + n].to_vec()
    }

    /// What is left of an oscillation after both runs, by its frequency as a part of the cutoff.
    pub fn left(ratio: f64) -> f64 {
        1.0 / (1.0 + ratio.powi(8))
    }
}

impl Section {
    /// From the state in which the first value has been there for ever.
    fn run(&self, x: &mut [f64]) {
        let ([b0, b1, b2], [a1, a2]) = (self.b, self.a);
        let first = x.first().copied().unwrap_or(0.0);
        let mut z2 = (b2 - a2) * first;
        let mut z1 = (b1 - a1) * first + z2;
        for v in x {
            let y = b0 * *v + z1;
            z1 = b1 * *v - a1 * y + z2;
            z2 = b2 * *v - a2 * y;
            *v = y;
        }
    }
}

/// Rows at each end for which there are no derivatives.
pub const EDGE: usize = 3;

/// The first derivative by central differences of order 6; at the ends the nearest.
pub fn derivative(x: &[f64], step: f64) -> Vec<f64> {
    let at = |i: usize| {
        let d = |k: usize| x[i + k] - x[i - k];
        (45.0 * d(1) - 9.0 * d(2) + d(3)) / (60.0 * step)
    };
    inside(x, at)
}

/// The second derivative by central differences of order 6; at the ends the nearest.
pub fn second_derivative(x: &[f64], step: f64) -> Vec<f64> {
    let at = |i: usize| {
        let s = |k: usize| x[i + k] - 2.0 * x[i] + x[i - k];
        (270.0 * s(1) - 27.0 * s(2) + 2.0 * s(3)) / (180.0 * step * step)
    };
    inside(x, at)
}

fn inside(x: &[f64], at: impl Fn(usize) -> f64) -> Vec<f64> {
    let n = x.len();
    if n <= 2 * EDGE {
        return vec![0.0; n];
    }
    (0..n).map(|i| at(i.clamp(EDGE, n - 1 - EDGE))).collect()
}

/// Frequencies at which a column is looked at.
const FREQUENCIES: usize = 160;
/// So many times the noise's power is motion.
const ABOVE: f64 = 10.0;
/// The longest stretch that is looked at.
const LONGEST: usize = 20_000;

/// The highest frequency, as a part of the rate of rows, at which there is more than white noise of this deviation; none where there is
/// nowhere. The column is seen through sin⁴, whose side lobes fall with the fifth power.
pub fn band(x: &[f64], noise: f64) -> Option<f64> {
    // Of a long column a part shows it: the noise is the same, and the motion is.
    let x = &x[..x.len().min(LONGEST)];
    let n = x.len();
    if n < 32 {
        return None;
    }
    // Without the line through its ends, the rest is small there.
    let slope = (x[n - 1] - x[0]) / (n - 1) as f64;
    let window = |i: usize| (PI * (i as f64 + 0.5) / n as f64).sin().powi(4);
    let seen: Vec<f64> =
        x.iter().enumerate().map(|(i, v)| (v - x[0] - slope * i as f64) * window(i)).collect();
    let weight: f64 = (0..n).map(|i| window(i).powi(2)).sum();
    let floor = noise * noise * weight;
    let power = |f: f64| {
        // Goertzel's recursion.
        let (c, mut s1, mut s2) = (2.0 * (TAU * f).cos(), 0.0, 0.0);
        for v in &seen {
            (s1, s2) = (v + c * s1 - s2, s1);
        }
        s1 * s1 + s2 * s2 - c * s1 * s2
    };
    let (low, high) = (3.0 / n as f64, 0.5);
    let at = |k: usize| low * (high / low).powf(k as f64 / (FREQUENCIES - 1) as f64);
    // One that stands alone by chance does not count: its neighbour has to be above the noise, too.
    let is_above: Vec<bool> = (0..FREQUENCIES).map(|k| power(at(k)) > ABOVE * floor).collect();
    (1..FREQUENCIES).rev().find(|&k| is_above[k] && is_above[k - 1]).map(at)
}

/// The deviation of white noise in a column, from its third differences where these are least: Gaussian noise alone.
pub fn noise(x: &[f64]) -> f64 {
    let third: Vec<f64> = x.windows(4).map(|w| (w[3] - 3.0 * w[2] + 3.0 * w[1] - w[0]).abs()).collect();
    median(third) / (0.6745 * 20_f64.sqrt())
}

/// The middle of numbers; 0 of none.
pub fn median(mut x: Vec<f64>) -> f64 {
    x.retain(|x| x.is_finite());
    if x.is_empty() {
        return 0.0;
    }
    let at = x.len() / 2;
    *x.select_nth_unstable_by(at, f64::total_cmp).1
}

/// By how much white noise that was filtered and thinned out is denser within its band than it looks by its variance: rows a second
/// over the integral of what is left of the power.
pub fn density(cutoff: f64, rate: f64) -> f64 {
    let steps = 4000;
    let width = 8.0 * cutoff / f64::from(steps);
    let power: f64 = (0..steps).map(|k| LowPass::left((f64::from(k) + 0.5) * width / cutoff).powi(2)).sum();
    (rate / (2.0 * power * width)).max(1.0)
}

/// The deviation of velocities below a cutoff that white noise of positions makes; √2 of it, as the filter leaves something above.
pub fn noise_of_rates(noise: f64, cutoff: f64, rate: f64) -> f64 {
    // σ² 2/fs ∫ (2πf)² df up to the cutoff
    noise * TAU * cutoff * (2.0 * cutoff / (3.0 * rate)).sqrt() * SQRT_2
}
