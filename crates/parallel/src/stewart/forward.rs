//! All poses of a platform with six lengths.
//!
//! The forty solutions of one set of hyperplanes are followed to those of the legs ([`super::track`]), and each is proved
//! ([`super::certify`]). Where forty are proved, different, and none has e·e = 0, they are all: the motions of space form a variety of
//! degree 40 in P¹⁶, and the degrees of the components in which six hyperplanes meet it add up to 40 at most (Fulton, Intersection
//! Theory, example 8.4.6), so there is neither a further pose nor a motion of the platform with its legs at rest. Legs that meet in pairs
//! in three points of a triangle have at most sixteen isolated poses: the points lie on circles, and three forms of degrees (2, 2) in two of
//! three parameters each meet in 16.

use super::Stewart;
use super::certify::{Legs, Proved};
use super::equations::{Bounded, Study, apart, norm};
use super::start::{MOST, hyperplanes, solutions, unit};
use super::track::{Care, Line};
use crate::complex::Complex;
use crate::interval::Interval;
use denavit::geometry::orientation::{OrientationSet, rotation};
use denavit::geometry::{Rotation, Transform, Vector};
use denavit::random::Random;

/// How many times the paths are followed, with other factors.
const TRIES: u64 = 3;
/// Points that are nearer than this, as sines of angles in P⁷, are taken for one.
const SAME: f64 = 1e-8;

/// What says how many poses there can be.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Bound {
    /// Forty of any platform, and then no others of any kind.
    Forty,
    /// Sixteen isolated ones where legs meet in pairs in three points of a triangle.
    Sixteen,
}

impl Bound {
    /// How many.
    pub fn count(self) -> usize {
        match self {
            Bound::Forty => MOST,
            Bound::Sixteen => 16,
        }
    }
}

/// A pose with the given lengths.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Assembly {
    /// The pose.
    pub pose: Transform<f64>,
    /// By how much a leg's length is off at most, metres.
    pub residual: f64,
    /// Whether it is proved that there is a solution here and where: no component of (e, g), of which the greatest is 1, is off by more.
    pub radius: Option<f64>,
}

/// All that was found.
#[derive(Clone, PartialEq, Debug)]
pub struct Forward {
    /// The real poses, by their heights from above.
    pub assemblies: Vec<Assembly>,
    /// How many different solutions are proved, complex ones included.
    pub proved: usize,
    /// How many there are at most.
    pub bound: Bound,
    /// Paths that ended in no solution that is proved: at infinity, where solutions meet, or nowhere.
    pub lost: usize,
}

impl Forward {
    /// True if there are no other isolated poses, proved.
    pub fn is_complete(&self) -> bool {
        self.proved == self.bound.count() && self.assemblies.iter().all(|a| a.radius.is_some())
    }
}

/// A geometry in the units and around the points in which its numbers are near 1.
struct Scaled {
    legs: Legs,
    /// Metres.
    unit: f64,
    base: Vector<f64>,
    platform: Vector<f64>,
}

impl Scaled {
    fn new(of: &Stewart, lengths: &[f64; 6]) -> Self {
        let middle = |points: &[Vector<f64>; 6]| {
            points.iter().fold(Vector::zero(), |sum, p| sum + *p).scale(1.0 / 6.0)
        };
        let (base, platform) = (middle(&of.base), middle(&of.platform));
        let squares = |points: &[Vector<f64>; 6], m: Vector<f64>| {
            points.iter().map(|p| (*p - m).dot(*p - m)).sum::<f64>()
        };
        let lengths_squared = lengths.iter().map(|l| l * l).sum::<f64>();
        let sum = squares(&of.base, base) + squares(&of.platform, platform) + lengths_squared;
        // A power of two, by which nothing is rounded.
        let unit = (sum / 18.0).sqrt().max(f64::MIN_POSITIVE).log2().round().exp2();
        let moved = |p: Vector<f64>, m: Vector<f64>| -> [Interval; 3] {
            std::array::from_fn(|k| Interval::point(p[k] / unit) - Interval::point(m[k] / unit))
        };
        let bounded: [Bounded; 6] = std::array::from_fn(|i| {
            let (a, b) = (moved(of.base[i], base), moved(of.platform[i], platform));
            Bounded::leg(a, b, Interval::point(lengths[i] / unit))
        });
        let middle = std::array::from_fn(|i| bounded[i].middle());
        Scaled { legs: Legs { bounded, middle }, unit, base, platform }
    }

    /// The pose of a real point.
    fn pose(&self, x: &Study) -> Transform<f64> {
        let [e, g]: [[f64; 4]; 2] = [std::array::from_fn(|i| x[i].re), std::array::from_fn(|i| x[i + 4].re)];
        let n = e.iter().map(|x| x * x).sum::<f64>();
        let turned = rotation(OrientationSet::Quaternion, &[e[1], e[2], e[3], e[0]]);
        let turned = turned.unwrap_or_else(|_| Rotation::identity());
        // g ē
        let (v, u) = (Vector([e[1], e[2], e[3]]), Vector([g[1], g[2], g[3]]));
        let p = (u.scale(e[0]) - v.scale(g[0]) + v.cross(u)).scale(self.unit / n);
        // In the frames of the file: p + base − R platform.
        Transform::from_rotation_translation(turned, p + self.base - turned * self.platform)
    }
}

impl Stewart {
    /// All poses with these lengths of the legs, metres; none is found for negative ones.
    pub fn forward(&self, lengths: &[f64; 6]) -> Forward {
        let bound = self.bound();
        let numbers = self.base.iter().chain(&self.platform).flat_map(|p| p.0).chain(*lengths);
        // Squares of what is larger are no numbers, and hide a sign.
        let is_none = numbers.into_iter().any(|x| x.is_nan() || x.abs() > 1e100);
        if is_none || lengths.iter().any(|l| *l < 0.0) {
            return Forward { assemblies: vec![], proved: 0, bound, lost: MOST };
        }
        let scaled = Scaled::new(self, lengths);
        let (home, _) = hyperplanes();
        // Of one size, so that none of the lines is nearly at its end all the way.
        let legs = scaled.legs.middle.map(|q| q.scaled((1.0 / q.size()).into()));
        let starts = solutions();
        let (mut proved, mut doubtful): (Vec<Proved>, Vec<Study>) = (vec![], vec![]);
        let mut lost = 0;
        for attempt in 0..TRIES {
            let mut random = Random(1000 + attempt);
            let factors: [Complex; 6] = std::array::from_fn(|_| unit(&mut random));
            let line = Line::new(&home, &factors, &legs);
            let care = if attempt == 0 { Care::USUAL } else { Care::MORE };
            let before = proved.len();
            lost = 0;
            for start in &starts {
                let end = line.follow(start, care);
                let p = scaled.legs.prove(&end.x).filter(|_| end.is_reached);
                match p {
                    Some(p) if !p.weight().holds_zero() => add(&mut proved, p),
                    _ => {
                        lost += 1;
                        doubtful.push(end.x);
                    }
                }
            }
            if proved.len() >= bound.count() || (attempt > 0 && proved.len() == before) {
                break;
            }
        }
        doubtful.retain(|x| proved.iter().all(|p| apart(&p.x, x) > 1e-5));
        let mut assemblies: Vec<Assembly> = vec![];
        for p in proved.iter().filter(|p| p.is_real) {
            let size = p.region.iter().zip(&p.x).map(|(r, x)| (r.re.hi - x.re).max(x.re - r.re.lo));
            assemblies.push(self.assembly(&scaled, &p.x, lengths, Some(size.fold(0.0, f64::max))));
        }
        for a in doubtful.iter().filter_map(|x| self.doubtful(&scaled, x, lengths)) {
            let is_new = assemblies.iter().all(|b| {
                let off = b.pose.inverse() * a.pose;
                off.rotation.z()[2] < 1.0 - 1e-8
                    || off.rotation.x()[0] < 1.0 - 1e-8
                    || off.translation.norm() > 1e-4 * scaled.unit
            });
            if is_new {
                assemblies.push(a);
            }
        }
        assemblies.sort_by(|a, b| b.pose.translation[2].total_cmp(&a.pose.translation[2]));
        Forward { assemblies, proved: proved.len(), bound, lost }
    }

    /// How many poses there can be.
    fn bound(&self) -> Bound {
        let is_paired = [&self.base, &self.platform].into_iter().any(|points| {
            let mut different: Vec<(Vector<f64>, usize)> = vec![];
            for p in points {
                match different.iter_mut().find(|d| d.0 == *p) {
                    Some(d) => d.1 += 1,
                    None => different.push((*p, 1)),
                }
            }
            let corners = different.iter().map(|d| d.0).collect::<Vec<_>>();
            let is_triangle = || {
                let corner = |k: usize| corners[k].map(Interval::point);
                let [u, v] = [1, 2].map(|k| [0, 1, 2].map(|i| corner(k)[i] - corner(0)[i]));
                (0..3).any(|i| {
                    let j = (i + 1) % 3;
                    !(u[i] * v[j] - u[j] * v[i]).holds_zero()
                })
            };
            different.len() == 3 && different.iter().all(|d| d.1 == 2) && is_triangle()
        });
        if is_paired { Bound::Sixteen } else { Bound::Forty }
    }

    fn assembly(&self, scaled: &Scaled, x: &Study, lengths: &[f64; 6], radius: Option<f64>) -> Assembly {
        let pose = scaled.pose(x);
        let off = self.lengths(&pose).iter().zip(lengths).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        Assembly { pose, residual: off, radius }
    }

    /// The pose of a point that nothing is proved of, if it is real as far as one sees and its legs close.
    fn doubtful(&self, scaled: &Scaled, x: &Study, lengths: &[f64; 6]) -> Option<Assembly> {
        let largest = x.iter().copied().max_by(|a, b| a.norm2().total_cmp(&b.norm2()))?;
        let x: Study = x.map(|z| z / largest);
        let is_real = x.iter().all(|z| z.im.abs() < 1e-5);
        let has_pose = x[..4].iter().map(|z| z.norm2()).sum::<f64>().sqrt() > 1e-4 * norm(&x);
        if !(is_real && has_pose) {
            return None;
        }
        let assembly = self.assembly(scaled, &x, lengths, None);
        (assembly.residual < 1e-6 * scaled.unit).then_some(assembly)
    }
}

/// Adds a solution and its conjugate, if they are others than those known for sure.
fn add(known: &mut Vec<Proved>, p: Proved) {
    let both = if p.is_real { vec![p] } else { vec![p, p.conjugate()] };
    for p in both {
        let is_new = known.iter().all(|k| apart(&k.x, &p.x) > SAME && k.is_apart_from(&p));
        if is_new {
            known.push(p);
        }
    }
}
