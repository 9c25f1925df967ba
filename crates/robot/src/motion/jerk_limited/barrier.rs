//! The optimisation: Newton's method with logarithmic barriers.
//!
//! Unknowns are the control points of x(τ). Limits are imposed at the three Gauss points of each interval, of which the
//! duration is the sum. Where friction grows with √x a torque limit is, like that of the jerk, bounded from inside by a
//! tangent at each step.

use super::banded::{self, Pentadiagonal};
use super::spline::{Form, Spline, forms};
use super::torques::{Loads, Row};
use super::warped::{chain, warp};
use crate::motion::error::{MotionError, finite};
use crate::motion::limits::{Limits, Range};
use crate::motion::path::{JointPath, PathPoint, Side};

/// Gauss points of an interval, and their weights.
const GAUSS: [(f64, f64); 3] =
    [(0.112_701_665_379_258_3, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.887_298_334_620_741_7, 5.0 / 18.0)];
/// The weight of the duration grows by this factor when a centre is reached.
const GROWTH: f64 = 12.0;
const MAX_STEPS: usize = 400;

/// A Gauss point.
struct Place {
    interval: usize,
    /// Share of the duration at x = 1.
    weight: f64,
    /// The form x.
    x: Form,
    /// Forms that are at most 1: velocities and accelerations.
    linear: Vec<Form>,
    /// Forms that are at most 1/√x in magnitude: jerks.
    jerk: Vec<Form>,
    /// At most 1: torques.
    torques: Vec<Rooted>,
}

/// A form, and how much of √x goes with it.
struct Rooted {
    form: Form,
    root: f64,
}

/// The limits on a grid, and the fastest motion within them as far as it is found.
pub(super) struct Problem {
    places: Vec<Place>,
    spline: Spline,
    /// Where the weight of the duration starts, as a share of the number of limits.
    start: f64,
}

impl Problem {
    /// Half as fast as the fastest motion of constant τ̇.
    pub(super) fn new<P: JointPath>(
        path: &P,
        limits: &Limits,
        jerk: &[f64],
        loads: Option<&Loads<'_>>,
        grid: Vec<f64>,
    ) -> Result<Self, MotionError> {
        let places = places(path, limits, jerk, loads, &grid)?;
        let c = vec![constant(&places)?; grid.len() + 1];
        Ok(Self { places, spline: Spline { grid, c }, start: 1.0 })
    }

    /// The motion found last.
    pub(super) fn spline(&self) -> &Spline {
        &self.spline
    }

    /// The motion found last.
    pub(super) fn into_spline(self) -> Spline {
        self.spline
    }

    /// Makes the motion faster until it is at most by the share `gap` slower than the local optimum.
    pub(super) fn solve(&mut self, gap: f64) {
        // Unknowns of the order of 1 keep the numbers in their range.
        let scale = self.spline.c.iter().copied().fold(0.0, f64::max);
        rescale(&mut self.places, scale);
        self.spline.c.iter_mut().for_each(|c| *c /= scale);
        optimise(&self.places, &mut self.spline.c, self.start, gap.clamp(1e-6, 1.0));
        self.spline.c.iter_mut().for_each(|c| *c *= scale);
        rescale(&mut self.places, 1.0 / scale);
    }

    /// Tightens the limits of each interval by the ratios of velocity, acceleration, jerk and torque to their limits there,
    /// and slows the motion down to hold them.
    pub(super) fn tighten(&mut self, ratios: &[[f64; 4]]) {
        for place in &mut self.places {
            let [v, a, j, t] = ratios[place.interval].map(|r| 1.0 + 1.05 * (r - 1.0).max(0.0));
            let (velocity, accelerations) = place.linear.split_at_mut(1);
            velocity.iter_mut().flatten().for_each(|f| *f *= v * v);
            accelerations.iter_mut().flatten().for_each(|f| *f *= a);
            place.jerk.iter_mut().flatten().for_each(|f| *f *= j);
            place.torques.iter_mut().for_each(|r| r.multiply(t, t));
        }
        let most = self.places.iter().map(|p| p.slowness(&self.spline.c)).fold(1.0, f64::max);
        let slower = 0.98 / (most * most);
        self.spline.c.iter_mut().for_each(|c| *c *= slower);
        self.start = 100.0;
    }
}

impl Place {
    /// The factor by which a motion must be slowed down for the limits to hold here at it and at all that are slower.
    fn slowness(&self, c: &[f64]) -> f64 {
        let c = &c[self.interval..];
        let linear = self.linear.iter().map(|f| dot(f, c).max(0.0).sqrt()).fold(0.0, f64::max);
        let root = dot(&self.x, c).sqrt();
        let torques = self.torques.iter().map(|r| slowness(dot(&r.form, c), r.root * root));
        let linear = torques.fold(linear, f64::max);
        self.jerk.iter().map(|f| (dot(f, c).abs() * root).cbrt()).fold(linear, f64::max)
    }
}

impl Rooted {
    /// The row of a torque at a point with these forms x and u.
    fn new([a, b, k]: Row, x: &Form, u: &Form) -> Self {
        Rooted { form: std::array::from_fn(|i| a * u[i] + b * x[i]), root: k }
    }

    fn at(&self, c: &[f64], root: f64) -> f64 {
        dot(&self.form, c) + self.root * root
    }

    fn multiply(&mut self, form: f64, root: f64) {
        self.form.iter_mut().for_each(|f| *f *= form);
        self.root *= root;
    }
}

/// The factor z of which a y² + k y ≤ 1 for all y from 0 to 1/z: at 1/z it is 1 for the first time. 0 if it never is.
fn slowness(a: f64, k: f64) -> f64 {
    let square = k * k + 4.0 * a;
    if square < 0.0 { 0.0 } else { ((k + square.sqrt()) / 2.0).max(0.0) }
}

/// The limits in other units of x.
fn rescale(places: &mut [Place], scale: f64) {
    for place in places {
        place.linear.iter_mut().flatten().for_each(|f| *f *= scale);
        place.jerk.iter_mut().flatten().for_each(|f| *f *= scale * scale.sqrt());
        place.torques.iter_mut().for_each(|r| r.multiply(scale, scale.sqrt()));
    }
}

fn places<P: JointPath>(
    path: &P,
    limits: &Limits,
    jerk: &[f64],
    loads: Option<&Loads<'_>>,
    grid: &[f64],
) -> Result<Vec<Place>, MotionError> {
    let mut point = PathPoint::zeros(path.dof());
    let mut places = Vec::with_capacity(3 * grid.len());
    for interval in 0..grid.len() - 1 {
        let h = grid[interval + 1] - grid[interval];
        for (at, weight) in GAUSS {
            let warped = warp(grid[interval] + at * h);
            let s = warped[0] * path.end();
            path.eval_into(s, Side::Behind, &mut point);
            chain(&mut point, warped, path.end());
            for list in [&point.dq, &point.ddq, &point.dddq] {
                finite("derivatives of the path", list)?;
            }
            let f = forms(grid, interval, at);
            let (linear, jerk) = bounds(&point, &f, limits, jerk);
            let torques = match loads {
                Some(loads) => loads.rows(interval, s, &point)?,
                None => vec![],
            };
            let torques = torques.into_iter().map(|row| Rooted::new(row, &f[0], &f[1])).collect();
            places.push(Place { interval, weight: weight * h, x: f[0], linear, jerk, torques });
        }
    }
    Ok(places)
}

fn bounds(
    point: &PathPoint,
    [x, u, du]: &[Form; 3],
    limits: &Limits,
    jerk: &[f64],
) -> (Vec<Form>, Vec<Form>) {
    let fastest = point.dq.iter().zip(limits.velocity()).map(|(dq, r)| r.share(*dq)).fold(0.0, f64::max);
    let mut linear = vec![x.map(|x| x * fastest * fastest)];
    let mut jerks = vec![];
    for (joint, most) in jerk.iter().enumerate() {
        let (p1, p2, p3) = (point.dq[joint], point.ddq[joint], point.dddq[joint]);
        if p1 == 0.0 && p2 == 0.0 && p3 == 0.0 {
            continue;
        }
        let Range { lower, upper } = limits.acceleration()[joint];
        let acceleration: Form = std::array::from_fn(|k| p1 * u[k] + p2 * x[k]);
        for limit in [upper, lower].into_iter().filter(|limit| limit.is_finite()) {
            linear.push(acceleration.map(|a| a / limit));
        }
        jerks.push(std::array::from_fn(|k| (p1 * du[k] + 3.0 * p2 * u[k] + p3 * x[k]) / most));
    }
    (linear, jerks)
}

/// Half of the constant x at which the first limit is reached.
fn constant(places: &[Place]) -> Result<f64, MotionError> {
    let sum = |f: &Form| f[0] + f[1] + f[2];
    let mut most = 0.0f64;
    for place in places {
        for f in &place.linear {
            most = most.max(sum(f));
        }
        for f in &place.jerk {
            most = most.max(sum(f).abs().powf(2.0 / 3.0));
        }
        for r in &place.torques {
            most = most.max(slowness(sum(&r.form), r.root).powi(2));
        }
    }
    match most {
        0.0 => Err(MotionError::ZeroLength),
        m if m.is_finite() => Ok(0.5 / m),
        _ => Err(MotionError::Stuck { s: 0.0 }), // a limit of zero
    }
}

fn dot(f: &Form, c: &[f64]) -> f64 {
    f[0] * c[0] + f[1] * c[1] + f[2] * c[2]
}

fn duration(places: &[Place], c: &[f64]) -> f64 {
    places.iter().map(|p| p.weight / dot(&p.x, &c[p.interval..]).sqrt()).sum()
}

/// The duration times `t` less the logarithms of all slacks; infinite outside the limits.
fn barrier(places: &[Place], c: &[f64], t: f64) -> f64 {
    if c.iter().any(|c| *c <= 0.0) {
        return f64::INFINITY;
    }
    // Logarithms of products: slacks are neither huge nor tiny enough to leave the range of doubles eight at a time.
    let mut logarithms: f64 = c.iter().map(|c| c.ln()).sum();
    for p in places {
        let c = &c[p.interval..];
        let root = dot(&p.x, c).sqrt();
        let room = 1.0 / root;
        let linear = p.linear.iter().map(|f| 1.0 - dot(f, c));
        let jerk = p.jerk.iter().map(|f| room * room - dot(f, c).powi(2));
        let torques = p.torques.iter().map(|r| 1.0 - r.at(c, root));
        let (mut product, mut count) = (1.0, 0);
        for slack in linear.chain(jerk).chain(torques) {
            if slack.is_nan() || slack <= 0.0 {
                return f64::INFINITY;
            }
            product *= slack;
            count += 1;
            if count == 8 {
                logarithms += f64::ln(product);
                (product, count) = (1.0, 0);
            }
        }
        logarithms += product.ln();
    }
    t * duration(places, c) - logarithms
}

fn optimise(places: &[Place], c: &mut [f64], start: f64, gap: f64) {
    let of = |p: &Place| p.linear.len() + 2 * p.jerk.len() + p.torques.len();
    let limits: usize = places.iter().map(of).sum::<usize>() + c.len();
    let mut t = start * limits as f64 / duration(places, c);
    let mut value = barrier(places, c, t);
    for _ in 0..MAX_STEPS {
        let (mut matrix, mut step) = derivatives(places, c, t);
        let gradient = step.clone();
        if !banded::solve(&mut matrix, &mut step) {
            return; // rounding: the point is feasible, and no better one is in sight
        }
        let decrement: f64 = gradient.iter().zip(&step).map(|(g, s)| g * s).sum();
        if decrement < 0.5 {
            // A centre: what is left to gain is at most one slack by its multiplier 1/(t slack) for each limit.
            if limits as f64 / t <= gap * duration(places, c) {
                return;
            }
            t *= GROWTH;
            value = barrier(places, c, t);
            continue;
        }
        let mut length = 1.0;
        let moved = loop {
            let moved: Vec<f64> = c.iter().zip(&step).map(|(c, s)| c - length * s).collect();
            let new = barrier(places, &moved, t);
            if new <= value - 0.1 * length * decrement {
                value = new;
                break Some(moved);
            }
            length *= 0.6;
            if length < 1e-10 {
                break None;
            }
        };
        match moved {
            Some(moved) => c.copy_from_slice(&moved),
            None => return, // no progress beyond rounding
        }
    }
}

/// The Hessian and the gradient of the convex function that touches the barrier function here and is above it
/// elsewhere.
fn derivatives(places: &[Place], c: &[f64], t: f64) -> (Pentadiagonal, Vec<f64>) {
    let mut matrix: Pentadiagonal = c.iter().map(|c| [1.0 / (c * c), 0.0, 0.0]).collect();
    let mut gradient: Vec<f64> = c.iter().map(|c| -1.0 / c).collect();
    for p in places {
        let here = &c[p.interval..];
        let x = dot(&p.x, here);
        let root = 1.0 / x.sqrt();
        let (mut g, mut m) = ([0.0; 3], [0.0; 6]);
        // f = weight x^(−1/2)
        add(&mut g, &mut m, &p.x, -0.5 * t * p.weight * root / x, 0.75 * t * p.weight * root / (x * x));
        for f in &p.linear {
            let inverse = 1.0 / (1.0 - dot(f, here));
            add(&mut g, &mut m, f, inverse, inverse * inverse);
        }
        // ±y ≤ 1/√x, of which the tangent falls by x^(−3/2) / 2.
        let fall = 0.5 * root / x;
        for f in &p.jerk {
            let y = dot(f, here);
            for sign in [1.0, -1.0] {
                let inverse = 1.0 / (root - sign * y);
                let form = std::array::from_fn(|k| sign * f[k] + fall * p.x[k]);
                add(&mut g, &mut m, &form, inverse, inverse * inverse);
            }
        }
        for r in &p.torques {
            let inverse = 1.0 / (1.0 - r.at(here, 1.0 / root));
            let half = 0.5 * r.root * root;
            let form = std::array::from_fn(|k| r.form[k] + half * p.x[k]);
            add(&mut g, &mut m, &form, inverse, inverse * inverse);
            if r.root < 0.0 {
                // What falls with the root is convex; where it grows with it its tangent is above it.
                add(&mut g, &mut m, &p.x, 0.0, -0.5 * half / x * inverse);
            }
        }
        let i = p.interval;
        for k in 0..3 {
            gradient[i + k] += g[k];
        }
        let [m00, m10, m11, m20, m21, m22] = m;
        matrix[i][0] += m00;
        matrix[i + 1][0] += m11;
        matrix[i + 2][0] += m22;
        matrix[i + 1][1] += m10;
        matrix[i + 2][1] += m21;
        matrix[i + 2][2] += m20;
    }
    (matrix, gradient)
}

/// Adds a function of a linear form with these first and second derivatives.
fn add(g: &mut [f64; 3], m: &mut [f64; 6], f: &Form, first: f64, second: f64) {
    let [a, b, c] = *f;
    g[0] += first * a;
    g[1] += first * b;
    g[2] += first * c;
    m[0] += second * a * a;
    m[1] += second * b * a;
    m[2] += second * b * b;
    m[3] += second * c * a;
    m[4] += second * c * b;
    m[5] += second * c * c;
}
