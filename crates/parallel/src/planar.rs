//! Planar 3-RRR robots: three arms of two links each between a base and a platform in the plane.
//!
//! A drive qᵢ turns the first link of leg i, and its elbow stands at Cᵢ = Aᵢ + first e(qᵢ), e(φ) = (cos φ, sin φ). The second link keeps
//! |p + R(φ) bᵢ − Cᵢ| = second. With x = p + R b₁ − C₁ and dᵢ = R(bᵢ − b₁) − (Cᵢ − C₁), vectors being complex numbers and z = e(φ),
//!
//! ```text
//! 2 x·dᵢ = hᵢ = rᵢ² − r₁² − |dᵢ|²,   x = i N/(2δ),   N = h₃ d₂ − h₂ d₃,   δ = Im(d̄₂ d₃),   |N|² = 4 r₁² δ²
//! ```
//!
//! The last is of degree 3 in z and 1/z: a polynomial of degree 6 in tan(φ/2), so that there are six poses at most.

use crate::complex::Complex;
use crate::delta::{FLAT, Mode, OutOfReach, Sign, modes};
use crate::interval::{Interval, Rectangle};
use crate::lu::Lu;
use crate::rates::Rates;
use crate::roots::isolate;
use denavit::geometry::{Rotation, Transform, Vector};

/// Metres.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Planar {
    /// Where the drives stand.
    pub base: [[f64; 2]; 3],
    /// Where the second links hold the platform, in its own frame.
    pub platform: [[f64; 2]; 3],
    /// The links that are driven.
    pub first: [f64; 3],
    /// Those behind them.
    pub second: [f64; 3],
}

/// A pose in the plane.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct PlanarPose {
    /// The platform's origin, metres.
    pub position: [f64; 2],
    /// Its angle, radians.
    pub angle: f64,
}

impl PlanarPose {
    /// In space, about z.
    pub fn transform(&self) -> Transform<f64> {
        let [x, y] = self.position;
        Transform::from_rotation_translation(Rotation::about_z(self.angle), Vector([x, y, 0.0]))
    }
}

/// A pose with the given drives.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct PlanarAssembly {
    /// The pose.
    pub pose: PlanarPose,
    /// By how much a link's length is off at most, metres.
    pub residual: f64,
    /// Whether it is proved that there is one pose with this angle, and no second one near it.
    pub is_proved: bool,
}

/// All that was found.
#[derive(Clone, PartialEq, Debug)]
pub struct PlanarForward {
    /// By their angles.
    pub assemblies: Vec<PlanarAssembly>,
    /// True if there are no others, proved.
    pub is_complete: bool,
}

/// Half the angle up to which its tangent is used, and its reciprocal from there on; no tangent of a round angle.
const SPLIT: f64 = 1.093_741;

impl Planar {
    fn held(&self, leg: usize, pose: &PlanarPose) -> [f64; 2] {
        let (sin, cos) = pose.angle.sin_cos();
        let [x, y] = self.platform[leg];
        [pose.position[0] + cos * x - sin * y, pose.position[1] + sin * x + cos * y]
    }

    /// The elbow of a leg.
    pub fn elbow(&self, leg: usize, q: f64) -> [f64; 2] {
        let (sin, cos) = q.sin_cos();
        [self.base[leg][0] + self.first[leg] * cos, self.base[leg][1] + self.first[leg] * sin]
    }

    /// A second link, from its elbow to the platform.
    pub fn link_at(&self, leg: usize, pose: &PlanarPose, q: f64) -> [f64; 2] {
        let (at, elbow) = (self.held(leg, pose), self.elbow(leg, q));
        [at[0] - elbow[0], at[1] - elbow[1]]
    }

    /// The drives of a pose in eight modes: `+` where the second link is turned counterclockwise against the first one.
    ///
    /// # Errors
    /// The first leg that does not reach.
    pub fn inverse(&self, pose: &PlanarPose) -> Result<Vec<Mode>, OutOfReach> {
        let mut legs = [[0.0; 2]; 3];
        for (leg, both) in legs.iter_mut().enumerate() {
            let [x, y] = self.held(leg, pose);
            let (x, y) = (x - self.base[leg][0], y - self.base[leg][1]);
            let (a, b, far) = (self.first[leg], self.second[leg], x.hypot(y));
            let off = (far - a - b).max((a - b).abs() - far);
            if off > 1e-12 * (a + b) || far == 0.0 {
                return Err(OutOfReach { leg, metres: off.max(0.0) });
            }
            let k = far * far + (a - b) * (a + b);
            let product = (far + a + b) * (far + a - b) * (far - a + b) * (a + b - far);
            let h = if off > -FLAT * (a + b) { 0.0 } else { product.max(0.0).sqrt() };
            // The first link turns back by what the second one turns on.
            *both = Sign::BOTH.map(|s| (y * k - s.factor() * h * x).atan2(x * k + s.factor() * h * y));
        }
        Ok(modes(legs))
    }

    /// All poses with these drives.
    pub fn forward(&self, q: &[f64; 3]) -> PlanarForward {
        let elbows: [[f64; 2]; 3] = std::array::from_fn(|i| self.elbow(i, q[i]));
        let bounded = |z: [f64; 2], radius: f64| Rectangle::around(Complex::new(z[0], z[1]), radius);
        // Sines and cosines of the system's library are right to a few units of the last place.
        let c: [Rectangle; 3] = std::array::from_fn(|i| {
            let size = self.base[i][0].abs().max(self.base[i][1].abs()) + self.first[i];
            bounded(elbows[i], 8.0 * f64::EPSILON * size)
        });
        let b = self.platform.map(|z| Rectangle::point(Complex::new(z[0], z[1])));
        let p = self.sextic(&c, &b);
        let reversed: Vec<Interval> = p.polynomial.iter().rev().copied().collect();
        // Rounded up, so that nothing lies between the two.
        let most = (1.0 / SPLIT).next_up();
        let (near, far) = (isolate(&p.polynomial, -SPLIT, SPLIT), isolate(&reversed, -most, most));
        let mut all = PlanarForward {
            assemblies: vec![],
            is_complete: near.doubtful.is_empty() && far.doubtful.is_empty(),
        };
        let middle = |x: &Interval| 0.5 * (x.lo + x.hi);
        let angles = |x: &Interval, is_far: bool| {
            let t = middle(x);
            if is_far { 2.0 * 1.0_f64.atan2(t) } else { 2.0 * t.atan() }
        };
        let mut unproved = vec![];
        for (roots, is_far) in [(&near, false), (&far, true)] {
            for x in &roots.isolated {
                let angle = angles(x, is_far);
                // One position belongs to the angle.
                if p.delta_at(x, is_far).holds_zero() {
                    unproved.push(angle);
                    continue;
                }
                let found = self.assemblies(angle, &elbows, true);
                all.is_complete &= found.len() == 1;
                all.assemblies.extend(found);
            }
            unproved.extend(roots.doubtful.iter().map(|x| angles(x, is_far)));
        }
        all.is_complete &= unproved.is_empty();
        let same = |a: &PlanarAssembly, b: &PlanarAssembly| {
            let [x, y] = [0, 1].map(|k| a.pose.position[k] - b.pose.position[k]);
            let turn = 2.0 * (0.5 * (a.pose.angle - b.pose.angle)).sin().abs();
            x.hypot(y).max(turn * self.size()) < 1e-6 * self.size()
        };
        for a in unproved.into_iter().flat_map(|angle| self.assemblies(angle, &elbows, false)) {
            if !all.assemblies.iter().any(|b| same(&a, b)) {
                all.assemblies.push(a);
            }
        }
        // Newton's method may bring two near ones together.
        let each = all.assemblies.iter().enumerate();
        all.is_complete &= !each.clone().any(|(i, a)| all.assemblies[..i].iter().any(|b| same(a, b)));
        all.assemblies.sort_by(|a, b| a.pose.angle.total_cmp(&b.pose.angle));
        all
    }

    /// The longest link, metres.
    fn size(&self) -> f64 {
        self.first.iter().chain(&self.second).fold(0.0, |most: f64, l| most.max(*l))
    }

    /// The poses with about this angle, of which all links close.
    fn assemblies(&self, angle: f64, elbows: &[[f64; 2]; 3], is_proved: bool) -> Vec<PlanarAssembly> {
        let (sin, cos) = angle.sin_cos();
        let z = Complex::new(cos, sin);
        let point = |p: [f64; 2]| Complex::new(p[0], p[1]);
        let b = self.platform.map(point);
        let c = elbows.map(point);
        let d = [1, 2].map(|i| z * (b[i] - b[0]) - (c[i] - c[0]));
        let r = self.second;
        let h = [0, 1].map(|i| r[i + 1] * r[i + 1] - r[0] * r[0] - d[i].norm2());
        let delta = (d[0].conj() * d[1]).im;
        let mut x = vec![Complex::new(0.0, 0.5 / delta) * (d[0] * h[1] - d[1] * h[0])];
        x.retain(|x| x.norm2().is_finite());
        if !is_proved {
            // Where the two lines are nearly one: where it meets the circle.
            let k = usize::from(d[1].norm2() > d[0].norm2());
            let far = d[k].abs();
            let along = d[k] * (1.0 / far);
            let m = h[k] / (2.0 * far);
            let s = (r[0] * r[0] - m * m).max(0.0).sqrt();
            if far > 1e-12 * self.size() {
                x.extend(Sign::BOTH.map(|sign| along * Complex::new(m, sign.factor() * s)));
            }
        }
        let start = |x: Complex| {
            let p = x + c[0] - z * b[0];
            PlanarPose { position: [p.re, p.im], angle }
        };
        let closed = x.into_iter().filter_map(|x| self.closed(start(x), elbows));
        closed.map(|(pose, residual)| PlanarAssembly { pose, residual, is_proved }).collect()
    }

    /// The pose by Newton's method, and by how much links are off; nothing where they stay open.
    fn closed(&self, mut pose: PlanarPose, elbows: &[[f64; 2]; 3]) -> Option<(PlanarPose, f64)> {
        let rods = |pose: &PlanarPose| -> [[f64; 2]; 3] {
            std::array::from_fn(|i| {
                let at = self.held(i, pose);
                [at[0] - elbows[i][0], at[1] - elbows[i][1]]
            })
        };
        let residual = |pose: &PlanarPose| {
            let off = rods(pose).into_iter().zip(self.second).map(|(r, l)| (r[0].hypot(r[1]) - l).abs());
            off.fold(0.0, |most: f64, x| if x.is_nan() { f64::INFINITY } else { most.max(x) })
        };
        let mut best = residual(&pose);
        // Where poses meet it is slow.
        for _ in 0..60 {
            let (mut rows, mut f) = ([[Complex::ZERO; 3]; 3], [Complex::ZERO; 3]);
            for (i, r) in rods(&pose).into_iter().enumerate() {
                let at = self.held(i, &pose);
                let (x, y) = (at[0] - pose.position[0], at[1] - pose.position[1]);
                rows[i] = [r[0], r[1], x * r[1] - y * r[0]].map(Complex::from);
                f[i] = (0.5 * (r[0] * r[0] + r[1] * r[1] - self.second[i] * self.second[i])).into();
            }
            let Some(factors) = Lu::of(rows) else { break };
            let step = factors.solve(&f);
            let next = PlanarPose {
                position: [pose.position[0] - step[0].re, pose.position[1] - step[1].re],
                angle: pose.angle - step[2].re,
            };
            let off = residual(&next);
            if off >= best {
                break;
            }
            (pose, best) = (next, off);
        }
        pose.angle = pose.angle.sin().atan2(pose.angle.cos());
        (best < 1e-11 * self.size()).then_some((pose, best))
    }

    /// |N|² − 4 r₁² δ² as a polynomial of tan(φ/2), and δ.
    fn sextic(&self, c: &[Rectangle; 3], b: &[Rectangle; 3]) -> Sextic {
        let bar = |z: Rectangle| Rectangle { re: z.re, im: -z.im };
        let beta = [b[1] - b[0], b[2] - b[0]];
        let gamma = [c[1] - c[0], c[2] - c[0]];
        let size2 = |z: Rectangle| z.re.squared() + z.im.squared();
        let r2 = self.second.map(|l| Interval::point(l).squared());
        // h by its powers −1, 0, 1; d by 0, 1; N by −1 … 2.
        let h: [[Rectangle; 3]; 2] = std::array::from_fn(|i| {
            let turning = beta[i] * bar(gamma[i]);
            let k = r2[i + 1] - r2[0] - size2(beta[i]) - size2(gamma[i]);
            [bar(turning), Rectangle::real(k), turning]
        });
        let zero = Rectangle::ZERO;
        let mut n = [zero; 4];
        for k in 0..3 {
            n[k] = n[k] - h[1][k] * gamma[0] + h[0][k] * gamma[1];
            n[k + 1] = n[k + 1] + h[1][k] * beta[0] - h[0][k] * beta[1];
        }
        // 1/(2i) = −i/2
        let half = Rectangle::point(Complex::new(0.0, -0.5));
        let turning = half * (beta[0] * bar(gamma[1]) - bar(gamma[0]) * beta[1]);
        let still = (bar(beta[0]) * beta[1] + bar(gamma[0]) * gamma[1]).im;
        let delta = [bar(turning), Rectangle::real(still), turning];
        // By the powers −3 … 3.
        let mut p = [zero; 7];
        for i in 0..4 {
            for j in 0..4 {
                p[3 + i - j] = p[3 + i - j] + n[i] * bar(n[j]);
            }
        }
        let four = Interval::point(4.0) * r2[0];
        for i in 0..3 {
            for j in 0..3 {
                p[1 + i + j] = p[1 + i + j] - four * (delta[i] * delta[j]);
            }
        }
        Sextic { polynomial: of_tangent(&p), delta: of_tangent(&delta) }
    }

    /// J_x (vx, vy, ω) = J_q q̇: a row of J_x is the direction r of a second link with its moment about the platform's origin, the entry of
    /// J_q is r·∂C/∂q.
    pub fn rates(&self, pose: &PlanarPose, q: &[f64; 3]) -> Rates {
        let (mut rows, mut drives, mut most) = (vec![], vec![], vec![]);
        for (leg, &q) in q.iter().enumerate() {
            let at = self.held(leg, pose);
            let r = self.link_at(leg, pose, q).map(|x| x / self.second[leg]);
            let (x, y) = (at[0] - pose.position[0], at[1] - pose.position[1]);
            rows.push([r[0], r[1], x * r[1] - y * r[0]]);
            let (sin, cos) = q.sin_cos();
            drives.push(self.first[leg] * (r[1] * cos - r[0] * sin));
            most.push(self.first[leg]);
        }
        let size = self.platform.iter().map(|b| b[0] * b[0] + b[1] * b[1]).sum::<f64>();
        let [x, y] = pose.position;
        Rates::in_plane(rows, drives, most, (size / 3.0).sqrt(), Vector([x, y, 0.0]))
    }
}

/// Polynomials of t = tan(φ/2), the constant first.
struct Sextic {
    polynomial: Vec<Interval>,
    delta: Vec<Interval>,
}

impl Sextic {
    /// δ, but for a factor that is not 0, at tan(φ/2) or its reciprocal.
    fn delta_at(&self, x: &Interval, is_far: bool) -> Interval {
        let ordered: Vec<Interval> = match is_far {
            false => self.delta.clone(),
            true => self.delta.iter().rev().copied().collect(),
        };
        crate::roots::value(&ordered, *x)
    }
}

/// Σ cₖ zᵏ, k = −n … n, times (1 + t²)ⁿ, of z = (1 + it)/(1 − it): Σ cₖ (1 + it)ⁿ⁺ᵏ (1 − it)ⁿ⁻ᵏ. It is real where c₋ₖ is conjugate to cₖ.
fn of_tangent(c: &[Rectangle]) -> Vec<Interval> {
    let degree = c.len() - 1;
    let mut sum = vec![Interval::ZERO; degree + 1];
    for (k, &c) in c.iter().enumerate() {
        // Whole numbers: nothing is rounded.
        let mut powers = vec![Complex::ONE];
        for factor in 0..degree {
            let i = Complex::new(0.0, if factor < k { 1.0 } else { -1.0 });
            powers.push(Complex::ZERO);
            for m in (1..powers.len()).rev() {
                let below = powers[m - 1];
                powers[m] += i * below;
            }
        }
        for (sum, power) in sum.iter_mut().zip(powers) {
            *sum = *sum + (c * Rectangle::point(power)).re;
        }
    }
    sum
}
