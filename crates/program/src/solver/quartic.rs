//! The zeros of a trigonometric polynomial of degree 2.
//!
//! Its extrema are where its derivative, another such polynomial, vanishes: roots on the unit circle of a quartic in
//! z = e^{iθ}. Between two neighbours of these the polynomial is monotonic, so that a change of sign is one zero, which
//! bisection cannot miss; an extremum that nearly touches 0 is a double one. Nothing is lost at θ = π, and a point that
//! is no extremum does no harm among them.

use super::CLAMP;
use super::roots::Roots;
use crate::kernel;
use std::f64::consts::{PI, TAU};

/// `p + c cos θ + s sin θ + c₂ cos 2θ + s₂ sin 2θ`
#[derive(Clone, Copy)]
struct Wave {
    mean: f64,
    once: [f64; 2],
    twice: [f64; 2],
}

impl Wave {
    fn at(&self, angle: f64) -> f64 {
        let (s, c) = kernel::sin_cos::<false>(angle);
        let (s2, c2) = (2.0 * s * c, (c - s) * (c + s));
        let ([a, b], [a2, b2]) = (self.once, self.twice);
        self.mean + ((a * c + b * s) + (a2 * c2 + b2 * s2))
    }

    fn derivative(&self) -> Wave {
        let ([a, b], [a2, b2]) = (self.once, self.twice);
        Wave { mean: 0.0, once: [b, -a], twice: [2.0 * b2, -2.0 * a2] }
    }
}

/// Points that are always among the candidates for extrema.
const EVEN: usize = 8;
/// Candidates: these, the extrema of the first harmonic, and four roots.
const MOST: usize = EVEN + 2 + 4;
/// Candidates that are nearer to one another are one.
const APART: f64 = 1e-9;

/// The zeros of `cc·cos² + cs·cos·sin + c·cos + s·sin + one`, sorted by angle in (−π, π].
pub(crate) fn quartic([cc, cs, c, s, one]: [f64; 5], found: &mut Roots) {
    let sum = cc.abs() + cs.abs() + c.abs() + s.abs() + one.abs();
    // cos² = (1 + cos 2θ)/2, cos sin = sin 2θ/2
    let [cc, cs, c, s, one] = [cc, cs, c, s, one].map(|x| x / sum);
    let f = Wave { mean: one + 0.5 * cc, once: [c, s], twice: [0.5 * cc, 0.5 * cs] };
    let slope = f.derivative();

    let mut points = [0.0; MOST];
    for (i, p) in points[..EVEN].iter_mut().enumerate() {
        *p = i as f64 * (TAU / EVEN as f64) - PI;
    }
    let peak = s.atan2(c);
    points[EVEN] = wrapped(peak);
    points[EVEN + 1] = wrapped(peak + PI);
    for (p, angle) in points[EVEN + 2..].iter_mut().zip(arguments(&slope)) {
        *p = wrapped(polished(&slope, angle));
    }
    points.sort_unstable_by(f64::total_cmp);

    // Of candidates that coincide, the one where |f| is smallest: it is the extremum, if one of them is.
    let mut distinct: [(f64, f64); MOST] = [(0.0, 0.0); MOST];
    let mut n = 0;
    for p in points {
        let here = (p, f.at(p));
        if n == 0 || p - distinct[n - 1].0 > APART {
            distinct[n] = here;
            n += 1;
        } else if here.1.abs() < distinct[n - 1].1.abs() {
            distinct[n - 1] = here;
        }
    }
    if distinct[0].0 + TAU - distinct[n - 1].0 <= APART {
        n -= 1;
    }
    let points = &distinct[..n];
    // The sign at each point; a height of exactly 0 has that of the next one which is not.
    let is_positive =
        |i: usize| (0..n).map(|k| points[(i + k) % n].1).find(|&h| h != 0.0).unwrap_or(0.0) > 0.0;
    let mut zeros: [(f64, u32); 4] = [(0.0, 0); 4];
    let mut count = 0;
    let mut add = |angle: f64, multiplicity: u32| {
        if count < zeros.len() {
            zeros[count] = (wrapped(angle), multiplicity);
            count += 1;
        }
    };
    let mut gap = f64::INFINITY;
    for i in 0..n {
        let (before, behind) = ((i + n - 1) % n, (i + 1) % n);
        let side = is_positive(i);
        let end = points[behind].0 + if behind == 0 { TAU } else { 0.0 };
        if side != is_positive(behind) {
            add(crossing(&f, points[i].0, end, side), 1);
        }
        // An extremum that touches 0 from one side. Of equal neighbours, the last is it.
        let height = points[i].1.abs();
        gap = gap.min(height);
        let is_lowest = height < points[behind].1.abs() && height <= points[before].1.abs();
        if is_positive(before) == side && side == is_positive(behind) && is_lowest {
            if height <= CLAMP {
                add(points[i].0, 2);
            } else {
                found.missed = found.missed.min(height);
            }
        }
    }
    zeros[..count].sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    for (k, &(angle, multiplicity)) in zeros[..count].iter().enumerate() {
        let (s, c) = kernel::sin_cos::<false>(angle);
        found.push([c, s], k as i8 + 1, multiplicity);
        if multiplicity == 1 {
            found.magnified[k] = 1.0 / slope.at(angle).abs();
        }
    }
    if count == 0 {
        found.gap = gap;
    }
}

/// The same angle in (−π, π].
fn wrapped(angle: f64) -> f64 {
    let angle = if angle > PI { angle - TAU } else { angle };
    if angle <= -PI { angle + TAU } else { angle }
}

/// The zero between two angles at which the signs differ.
fn crossing(f: &Wave, mut low: f64, mut high: f64, is_positive_at_low: bool) -> f64 {
    let slope = f.derivative();
    let mut x = 0.5 * (low + high);
    for step in 0..128 {
        let y = f.at(x);
        if y == 0.0 {
            break;
        }
        if (y > 0.0) == is_positive_at_low {
            low = x;
        } else {
            high = x;
        }
        let newton = x - y / slope.at(x);
        let middle = 0.5 * (low + high);
        // Every fourth step halves the bracket, whatever Newton's method says.
        let next = if newton > low && newton < high && step % 4 != 3 { newton } else { middle };
        if (next - x).abs() <= 2.0 * f64::EPSILON * x.abs().max(0.1) {
            x = next;
            break;
        }
        x = next;
    }
    x
}

/// An angle nearer to the zero of a polynomial, if Newton's method finds one close by.
fn polished(f: &Wave, start: f64) -> f64 {
    let slope = f.derivative();
    let (mut x, mut y) = (start, f.at(start).abs());
    for _ in 0..4 {
        let next = x - f.at(x) / slope.at(x);
        let value = f.at(next).abs();
        if !(value < y && (next - start).abs() < 0.1) {
            break;
        }
        (x, y) = (next, value);
    }
    x
}

type Complex = [f64; 2];

fn times([a, b]: Complex, [c, d]: Complex) -> Complex {
    [a * c - b * d, a * d + b * c]
}

fn over(a: Complex, [c, d]: Complex) -> Complex {
    let inverse = 1.0 / (c * c + d * d);
    times(a, [c * inverse, -d * inverse])
}

/// The arguments of the roots of the quartic in z = e^{iθ}, by the iteration of Aberth (1973); whatever is found if the
/// iteration does not settle.
fn arguments(f: &Wave) -> [f64; 4] {
    // 2f = (c₂ − i s₂)z² + (c − i s)z + 2p + …, times z²
    let ([a, b], [a2, b2]) = (f.once, f.twice);
    let coefficients: [Complex; 5] = [[a2, b2], [a, b], [2.0 * f.mean, 0.0], [a, -b], [a2, -b2]];
    let mut z: [Complex; 4] = [[0.9, 0.5], [-0.6, 0.95], [-0.9, -0.4], [0.5, -1.0]];
    for _ in 0..60 {
        let mut moved: f64 = 0.0;
        for i in 0..4 {
            let (mut p, mut q): (Complex, Complex) = ([0.0; 2], [0.0; 2]);
            for c in coefficients.iter().rev() {
                let qz = times(q, z[i]);
                q = [qz[0] + p[0], qz[1] + p[1]];
                let pz = times(p, z[i]);
                p = [pz[0] + c[0], pz[1] + c[1]];
            }
            let newton = over(p, q);
            let mut sum: Complex = [0.0; 2];
            for j in (0..4).filter(|&j| j != i) {
                let [x, y] = over([1.0, 0.0], [z[i][0] - z[j][0], z[i][1] - z[j][1]]);
                sum = [sum[0] + x, sum[1] + y];
            }
            let [x, y] = times(newton, sum);
            let [x, y] = over(newton, [1.0 - x, -y]);
            if x.is_finite() && y.is_finite() {
                z[i] = [z[i][0] - x, z[i][1] - y];
                moved = moved.max((x.abs() + y.abs()) / (z[i][0].abs() + z[i][1].abs() + 1e-300));
            }
        }
        if moved < 1e-15 {
            break;
        }
    }
    z.map(|[x, y]| if x.is_finite() && y.is_finite() { y.atan2(x) } else { 0.0 })
}
