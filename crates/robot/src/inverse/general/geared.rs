//! Six joints that move more than six axes, all but five of which one joint (or one combination of joints) drives.
//!
//! With the angle φ that the driven axes have in common, each so many times, the arm is a ring of five axes: the
//! configurations are roots of a trigonometric polynomial in φ ([`Remaining`]). At a root the arm of six axes in which one of
//! the driven ones is free again is solved by its own elimination; where that axis stands as its gear says, Newton's method on
//! the arm itself has the last digits. A count of the roots, arc by arc, tells whether anything is missing.

use super::arm::{Unsuited, inverted, rigid};
use super::circle::Trigonometric;
use super::ring::{Cut, Remaining};
use crate::description::JointKind;
use crate::geometry::Transform;
use crate::inverse::derivation::Goal;
use crate::inverse::newton;
use crate::mechanism::{Affine, Lengths, MovingAxes, Robot};
use crate::random::Random;
use crate::space::{JointSpace, within};
use denavit_elimination::{self as elimination, Arm, Certificate, Joint, Plan, Ranking};
use std::f64::consts::TAU;

/// The driven axes turn at most so often together while φ goes round once.
const MOST_TURNS: u32 = 8;
/// Gears are fractions with denominators up to this.
const DENOMINATOR: u32 = 6;
/// What the determinant's rows have of degree for each turn.
const ROWS: usize = 12;
/// Poses on which cuts of the ring are tried, and how many are kept.
const POSES: usize = 2;
const KEPT: usize = 3;
/// Harmonics below this are none, when the degree is measured.
const HARMONIC: f64 = 1e-10;
/// A polynomial with more noise than this is of no use.
const USELESS: f64 = 1e-6;
/// How much larger than the harmonics that ought to vanish the noise of the others may be.
const ALLOWED: f64 = 16.0;
/// An axis this near to where its gear wants it may be there (radians); Newton's method tells.
const NEAR: f64 = 0.1;
/// Where an arm of six axes is solved beside a root (radians).
const BESIDE: f64 = 0.01;
/// A root that is not real but this near to it is tried.
const ALMOST: f64 = 1e-2;

/// An arm of six joints in which one unknown drives several axes.
#[derive(Clone, Debug)]
pub struct Geared {
    kinds: Vec<JointKind>,
    constants: Vec<Transform<f64>>,
    offsets: Vec<f64>,
    /// The axes that are driven, and how often each turns while φ does once.
    driven: Vec<(usize, f64)>,
    /// The five others.
    others: [usize; 5],
    /// The joints from φ and what the others have beside their offsets.
    inverse: [[f64; 6]; 6],
    /// φ from the joints.
    unknown: Vec<(usize, f64)>,
    /// Which driven axis the arm of six leaves free, and how that is solved.
    freed: usize,
    ranking: Ranking,
    /// Lengths are divided by this.
    size: f64,
    /// The cuts of the ring in the order in which they are tried, with the degree of the polynomial.
    cuts: Vec<(Cut, usize)>,
}

/// A configuration.
#[derive(Clone, Debug)]
pub(super) struct Found {
    pub q: Vec<f64>,
    pub multiplicity: u32,
    pub singular: f64,
}

impl Geared {
    /// That of a robot; measures which cuts suit it.
    pub fn new(robot: &Robot<f64>, space: &JointSpace) -> Result<Self, Unsuited> {
        let MovingAxes { moving, constants } = MovingAxes::new(robot, Lengths::Before);
        let unsuited = Unsuited::Axes(moving.len());
        if robot.joints != 6 || moving.len() < 7 {
            return Err(unsuited);
        }
        let kinds: Vec<JointKind> = moving.iter().map(|a| a.kind).collect();
        let values: Vec<&Affine<f64>> = moving.iter().map(|a| &a.value).collect();
        let driven = driven(&kinds, &values).ok_or(unsuited)?;
        let is_driven = |k: &usize| driven.iter().any(|d| d.0 == *k);
        let others: Vec<usize> = (0..kinds.len()).filter(|k| !is_driven(k)).collect();
        let others: [usize; 5] = others.try_into().map_err(|_| Unsuited::Axes(moving.len()))?;
        let mut coupling = [[0.0; 6]; 6];
        let (first, turns) = driven[0];
        let unknown: Vec<(usize, f64)> = values[first].terms.iter().map(|&(j, k)| (j, k / turns)).collect();
        unknown.iter().for_each(|&(j, k)| coupling[0][j] = k);
        for (row, &axis) in coupling[1..].iter_mut().zip(&others) {
            values[axis].terms.iter().for_each(|&(j, k)| row[j] = k);
        }
        let inverse = inverted(coupling).ok_or(Unsuited::Coupled)?;
        let length = 0.5 * constants[1..kinds.len()].iter().map(|c| c.translation.norm()).sum::<f64>();
        let mut geared = Geared {
            offsets: values.iter().map(|v| v.constant()).collect(),
            kinds,
            constants,
            driven,
            others,
            inverse,
            unknown,
            freed: 0,
            ranking: Ranking::Triple,
            size: if length > 0.0 { length } else { 1.0 },
            cuts: vec![],
        };
        geared.choose_freed()?;
        geared.choose_cuts(robot, space)?;
        Ok(geared)
    }

    /// Which driven axis is left free where the others are held: one for which an arm of six axes can be solved.
    fn choose_freed(&mut self) -> Result<(), Unsuited> {
        let mut why = Unsuited::Coupled;
        for &(axis, _) in self.driven.clone().iter().rev() {
            self.freed = axis;
            match Plan::new(&self.six(0.7)) {
                Ok(plan) => {
                    self.ranking = plan.ranking();
                    return Ok(());
                }
                Err(e) => why = Unsuited::Degenerate(e.to_string()),
            }
        }
        Err(why)
    }

    /// Which cuts of the ring have a determinant that does not vanish, those with the least noise first.
    fn choose_cuts(&mut self, robot: &Robot<f64>, space: &JointSpace) -> Result<(), Unsuited> {
        let depends = self.depends();
        let kinds = self.ring_kinds();
        let bound = ROWS * self.driven.iter().map(|d| d.1.abs() as usize).sum::<usize>();
        let mut random = Random(1);
        let poses: Vec<Transform<f64>> =
            (0..POSES).map(|_| robot.pose(&space.anywhere(&mut random, self.size))).collect();
        let mut tried: Vec<(f64, Cut, usize)> = vec![];
        for cut in Cut::all().filter(|c| c.suits(&depends) && kinds[c.dropped] == JointKind::Revolute) {
            let of = |pose: &Transform<f64>| {
                let p = self.polynomial(cut, bound, pose, &Chart::WHOLE)?;
                let noise = HARMONIC.max(ALLOWED * p.noise);
                Some((p.noise, p.degree_above(noise)))
            };
            let Some(measured) = poses.iter().map(of).collect::<Option<Vec<_>>>() else { continue };
            let noise = measured.iter().map(|m| m.0).fold(0.0, f64::max);
            let degree = measured.iter().map(|m| m.1).max().unwrap_or(0);
            if noise < USELESS && degree > 0 {
                tried.push((noise, cut, degree));
            }
        }
        tried.sort_by(|a, b| a.2.cmp(&b.2).then(a.0.total_cmp(&b.0)));
        self.cuts = tried.iter().map(|t| (t.1, t.2)).take(KEPT).collect();
        if self.cuts.is_empty() { Err(Unsuited::Coupled) } else { Ok(()) }
    }

    fn ring_kinds(&self) -> [JointKind; 5] {
        self.others.map(|k| self.kinds[k])
    }

    /// Which gaps of the ring depend on φ: those behind each of the five axes up to the next.
    fn depends(&self) -> [bool; 5] {
        let behind = |axis: usize| self.others.iter().rposition(|&k| k < axis).unwrap_or(4);
        let mut depends = [false; 5];
        self.driven.iter().for_each(|d| depends[behind(d.0)] = true);
        depends
    }

    /// The gaps of the ring at a value of φ; `closing` is what leads from the last axis over the pose to the first one.
    fn gaps(&self, phi: f64, closing: &Transform<f64>) -> [Transform<f64>; 5] {
        let n = self.kinds.len();
        let mut gaps = [Transform::identity(); 5];
        let mut place = 4;
        // What stands before the first of the five belongs behind the pose.
        let mut before = Transform::identity();
        for axis in 0..n {
            let driven = self.driven.iter().find(|d| d.0 == axis);
            let after = if axis + 1 < n { self.scaled(axis + 1) } else { *closing };
            match driven {
                None => {
                    place = self.others.iter().position(|&k| k == axis).unwrap_or(place);
                    gaps[place] = after;
                }
                Some(&(_, turns)) => {
                    let x = Transform::rotation_z(turns * phi + self.offsets[axis]) * after;
                    if axis < self.others[0] {
                        before = before * x;
                    } else {
                        gaps[place] = gaps[place] * x;
                    }
                }
            }
        }
        gaps[4] = gaps[4] * before;
        gaps
    }

    fn scaled(&self, constant: usize) -> Transform<f64> {
        let x = self.constants[constant];
        Transform::from_rotation_translation(x.rotation, x.translation.scale(1.0 / self.size))
    }

    /// What leads from the last axis over the pose back to the first one.
    fn closing(&self, pose: &Transform<f64>) -> Transform<f64> {
        let last = self.kinds.len();
        let by_size =
            Transform::from_rotation_translation(pose.rotation, pose.translation.scale(1.0 / self.size));
        self.scaled(last) * by_size.inverse() * self.scaled(0)
    }

    /// The determinant of a cut at a pose, as a chart shows it.
    fn polynomial(
        &self,
        cut: Cut,
        degree: usize,
        pose: &Transform<f64>,
        chart: &Chart,
    ) -> Option<Trigonometric> {
        let closing = self.closing(pose);
        let remaining = Remaining::new(cut, &self.ring_kinds(), &self.gaps(0.0, &closing));
        let shown = |x: f64| {
            let own = remaining.determinant(&self.gaps(chart.out(x), &closing));
            own * chart.weight(x).powi(degree as i32)
        };
        Trigonometric::of(degree, shown)
    }

    /// The arm of six axes at a value of φ: one of the driven axes is free, the others are held.
    fn six(&self, phi: f64) -> Arm {
        let (mut joints, mut links) = ([Joint::Revolute; 6], [Transform::identity(); 7]);
        let mut k = 0;
        links[0] = self.constants[0];
        for (axis, kind) in self.kinds.iter().enumerate() {
            match self.driven.iter().find(|d| d.0 == axis && axis != self.freed) {
                Some(&(_, turns)) => {
                    links[k] = links[k] * Transform::rotation_z(turns * phi + self.offsets[axis]);
                }
                None => {
                    if *kind == JointKind::Prismatic {
                        joints[k] = Joint::Prismatic;
                    }
                    k += 1;
                }
            }
            links[k] = links[k] * self.constants[axis + 1];
        }
        Arm { base: rigid(&links[0]), joints, links: std::array::from_fn(|i| rigid(&links[i + 1])) }
    }

    /// All configurations of a pose that the roots lead to, and whether they are all.
    pub fn solve(
        &self,
        robot: &Robot<f64>,
        space: &JointSpace,
        pose: &Transform<f64>,
    ) -> (Vec<Found>, Certificate) {
        let mut found: Vec<Found> = vec![];
        let mut certificate = Certificate::Undecided;
        for &(cut, degree) in &self.cuts {
            let mut charts = vec![Chart::WHOLE];
            let mut is_all = true;
            while let Some(chart) = charts.pop() {
                let open = self.look((cut, degree), (robot, space), pose, &chart, &mut found);
                let parts = chart.parts(&open);
                is_all = is_all && (open.is_empty() || !parts.is_empty());
                if !is_all {
                    break;
                }
                charts.extend(parts);
            }
            if is_all {
                certificate = Certificate::Complete;
                break;
            }
        }
        let is_isolated = |f: &Found| f.singular > 1e-6;
        if !found.iter().all(is_isolated) {
            certificate = Certificate::NearDoubleRoot;
        }
        (found, certificate)
    }

    /// Adds the configurations that a chart shows; the arcs of the chart on which there may be more.
    fn look(
        &self,
        (cut, degree): (Cut, usize),
        arm: (&Robot<f64>, &JointSpace),
        pose: &Transform<f64>,
        chart: &Chart,
        found: &mut Vec<Found>,
    ) -> Vec<[f64; 2]> {
        let p = self.polynomial(cut, degree, pose, chart).filter(|p| p.noise <= USELESS);
        let Some(p) = p else { return vec![chart.span()] };
        for z in p.roots().iter().filter(|z| (z.size() - 1.0).abs() < ALMOST && chart.shows(z.angle())) {
            let phi = chart.out(z.angle());
            // The arm of six axes may be a special one at a root, and hide what it has.
            let _ = self.at(phi, arm, pose, found)
                || [BESIDE, -BESIDE].iter().any(|by| self.at(phi + by, arm, pose, found));
        }
        let of = |f: &Found| self.unknown.iter().map(|&(j, k)| k * f.q[j]).sum::<f64>();
        let angles: Vec<f64> = found.iter().map(|f| chart.inside(of(f))).collect();
        Count { p: &p, noise: ALLOWED * p.noise + 1e-15, angles }.open(chart.span())
    }

    /// Adds the configurations at a value of φ; false if there are none near.
    fn at(
        &self,
        phi: f64,
        (robot, space): (&Robot<f64>, &JointSpace),
        pose: &Transform<f64>,
        found: &mut Vec<Found>,
    ) -> bool {
        let Ok(plan) = Plan::ranked(&self.six(phi), &self.ranking) else { return false };
        let mut answer = elimination::Answer::default();
        plan.solve(&rigid(pose), &mut answer);
        let axes: Vec<usize> =
            (0..self.kinds.len()).filter(|k| *k == self.freed || self.others.contains(k)).collect();
        let turns = self.driven.iter().find(|d| d.0 == self.freed).map_or(1.0, |d| d.1);
        let wanted = turns * phi + self.offsets[self.freed];
        let mut is_any = false;
        let size = space.size(pose);
        for s in &answer.solutions {
            let value = |axis: usize| axes.iter().position(|&a| a == axis).map_or(0.0, |k| s.q[k]);
            if within(value(self.freed) - wanted, TAU).abs() > NEAR {
                continue;
            }
            let mut x = [phi; 6];
            for (x, &axis) in x[1..].iter_mut().zip(&self.others) {
                *x = value(axis) - self.offsets[axis];
            }
            let q: Vec<f64> =
                self.inverse.iter().map(|row| row.iter().zip(&x).map(|(a, b)| a * b).sum()).collect();
            let Some((q, residual)) = newton::polish(robot, Goal::Pose, pose, &q, &[], size) else {
                continue;
            };
            is_any = is_any || residual <= super::solve::TOLERANCE;
            if residual > super::solve::TOLERANCE || found.iter().any(|f| space.distance(&f.q, &q) < 1e-7) {
                continue;
            }
            let singular = newton::least_seen(robot, Goal::Pose, &q, &[], size);
            found.push(Found { q, multiplicity: if singular < 1e-6 { 2 } else { 1 }, singular });
        }
        is_any
    }
}

/// Roots against configurations.
struct Count<'a> {
    p: &'a Trigonometric,
    noise: f64,
    /// Where the configurations stand.
    angles: Vec<f64>,
}

/// The first arcs of a count are such a part of the span, the smallest such a part of those.
const ARCS: usize = 64;
const SMALLEST: f64 = 1.0 / 1024.0;
/// Where an arc is cut in two, as a part of it: where the polynomial is largest.
const CUTS: [f64; 5] = [0.5, 0.42, 0.58, 0.35, 0.65];

impl Count<'_> {
    /// The arcs of a span that may have more roots than configurations.
    fn open(&self, [from, to]: [f64; 2]) -> Vec<[f64; 2]> {
        let step = (to - from) / ARCS as f64;
        let mut borders: Vec<f64> = (0..ARCS).map(|k| from + step * k as f64).collect();
        // Both ends of the circle are one place.
        for border in &mut borders[1..] {
            *border = self.best(*border - 0.5 * step, *border + 0.5 * step);
        }
        borders.push(to);
        let mut arcs: Vec<[f64; 2]> = borders.windows(2).map(|b| [b[0], b[1]]).collect();
        let mut open = vec![];
        while let Some([low, high]) = arcs.pop() {
            if self.is_settled(low, high) {
                continue;
            }
            if high - low < SMALLEST * step {
                open.push([low, high]);
                continue;
            }
            let middle = self.best(low, high);
            arcs.extend([[low, middle], [middle, high]]);
        }
        open
    }

    /// Where to cut an arc.
    fn best(&self, low: f64, high: f64) -> f64 {
        let all = CUTS.map(|part| low + part * (high - low));
        let size = |x: &f64| self.p.value(*x).abs();
        all.into_iter().max_by(|a, b| size(a).total_cmp(&size(b))).unwrap_or(low)
    }

    /// Whether an arc has no more roots than configurations.
    fn is_settled(&self, low: f64, high: f64) -> bool {
        let Some(most) = self.p.most_roots(0.5 * (low + high), 0.5 * (high - low), self.noise) else {
            return false;
        };
        // Where configurations share an angle, fewer roots than they are may hide another one beside.
        let mut apart: Vec<f64> = self.angles.iter().copied().filter(|x| (low..high).contains(x)).collect();
        let own = apart.len();
        apart.sort_by(f64::total_cmp);
        apart.dedup_by(|a, b| (*a - *b).abs() < SHARED);
        if apart.len() >= most || own >= most && high - low < SMALL {
            return true;
        }
        // One root at most, and the ends on the same side.
        let ends = [low, high].map(|x| self.p.value(x));
        let is_clear = ends.iter().all(|y| y.abs() > self.noise);
        most == 1 && is_clear && ends[0] * ends[1] > 0.0
    }
}

/// Several configurations of one angle are counted on an arc as small as this.
const SMALL: f64 = 0.02;
/// Angles this near are one.
const SHARED: f64 = 1e-6;

/// A look at the circle: an arc of it is spread out by a projective map of the half angle's tangent, which leaves the degree.
#[derive(Clone, Copy, Debug)]
struct Chart {
    center: f64,
    /// The tangent of half the angle is multiplied by this.
    scale: f64,
}

/// The smallest scale of a chart, and how much smaller each is than the one before at least.
const DEEPEST: f64 = 1e-5;
const CLOSER: f64 = 0.5;

impl Chart {
    const WHOLE: Chart = Chart { center: 0.1, scale: 1.0 };

    fn is_whole(&self) -> bool {
        self.scale >= 1.0
    }

    /// The angle that is shown at one of the chart.
    fn out(&self, x: f64) -> f64 {
        let (s, c) = (0.5 * x).sin_cos();
        self.center + 2.0 * (self.scale * s).atan2(c)
    }

    /// Where an angle is shown.
    fn inside(&self, phi: f64) -> f64 {
        let (s, c) = (0.5 * within(phi - self.center, TAU)).sin_cos();
        2.0 * s.atan2(self.scale * c)
    }

    /// What a polynomial of degree 1 is multiplied by to be one in the chart.
    fn weight(&self, x: f64) -> f64 {
        let (s, c) = (0.5 * x).sin_cos();
        c * c + self.scale * self.scale * s * s
    }

    /// What it is its task to show.
    fn span(&self) -> [f64; 2] {
        let half = if self.is_whole() { 0.5 * TAU } else { 0.25 * TAU };
        [-half, half]
    }

    fn shows(&self, x: f64) -> bool {
        self.is_whole() || x.cos() > -1e-3
    }

    /// Charts that show open arcs more exactly; none if that is too near.
    fn parts(&self, open: &[[f64; 2]]) -> Vec<Chart> {
        let mut arcs: Vec<[f64; 2]> = open.to_vec();
        arcs.sort_by(|a, b| a[0].total_cmp(&b[0]));
        // Those next to each other together.
        let mut joined: Vec<[f64; 2]> = vec![];
        for arc in arcs {
            match joined.last_mut() {
                Some(last) if arc[0] - last[1] < 0.02 => last[1] = arc[1],
                _ => joined.push(arc),
            }
        }
        let most = (CLOSER * self.scale).min(0.4);
        let mut charts = vec![];
        for [low, high] in joined {
            let [low, high] = [self.out(low), self.out(high)];
            // An arc of the circle around, no wider than the next chart may be.
            let width = (4.0 * most.atan()).max(1e-9);
            let count = ((high - low) / width).ceil().max(1.0);
            let own = (high - low) / count;
            for k in 0..count as usize {
                let center = low + own * (k as f64 + 0.5);
                let scale = (0.25 * own).tan().max(0.02 * self.scale);
                charts.push(Chart { center, scale: scale.min(most) });
            }
        }
        if charts.iter().any(|c| c.scale < DEEPEST) || charts.len() > MOST_CHARTS {
            return vec![];
        }
        charts
    }
}

/// More charts than this are not looked at.
const MOST_CHARTS: usize = 12;

/// The axes of which the values are multiples of one unknown, so many that five are left, and how often each turns while that
/// unknown does once.
fn driven(kinds: &[JointKind], values: &[&Affine<f64>]) -> Option<Vec<(usize, f64)>> {
    let many = kinds.len().checked_sub(5)?;
    (0..kinds.len()).find_map(|first| {
        let ratios: Vec<(usize, (i32, u32))> = (first..kinds.len())
            .filter(|&k| kinds[k] == JointKind::Revolute)
            .filter_map(|k| Some((k, fraction(ratio(values[first], values[k])?)?)))
            .collect();
        if ratios.len() != many || ratios[0].0 != first {
            return None;
        }
        let multiple = ratios.iter().fold(1, |l, (_, (_, d))| l / gcd(l, *d) * d);
        let turns: Vec<i32> = ratios.iter().map(|(_, (n, d))| n * (multiple / d) as i32).collect();
        let common = turns.iter().fold(0, |g, t| gcd(g, t.unsigned_abs()));
        let turns: Vec<i32> = turns.iter().map(|t| t / common as i32).collect();
        let all: u32 = turns.iter().map(|t| t.unsigned_abs()).sum();
        (all <= MOST_TURNS).then(|| ratios.iter().zip(turns).map(|(r, t)| (r.0, f64::from(t))).collect())
    })
}

/// The factor by which one affine form is another, constants aside.
fn ratio(of: &Affine<f64>, to: &Affine<f64>) -> Option<f64> {
    let factor = |a: &Affine<f64>, j: usize| a.terms.iter().find(|t| t.0 == j).map_or(0.0, |t| t.1);
    let &(j, k) = of.terms.first()?;
    let ratio = factor(to, j) / k;
    let same = |&(j, _): &(usize, f64)| (factor(to, j) - ratio * factor(of, j)).abs() < 1e-14 * ratio.abs();
    (ratio != 0.0 && of.terms.iter().chain(&to.terms).all(same)).then_some(ratio)
}

/// A fraction with a small denominator.
fn fraction(x: f64) -> Option<(i32, u32)> {
    let is_near = |d: &u32| (x * f64::from(*d) - (x * f64::from(*d)).round()).abs() < 1e-13;
    let d = (1..=DENOMINATOR).find(is_near)?;
    let n = (x * f64::from(d)).round();
    (n.abs() <= f64::from(MOST_TURNS)).then_some((n as i32, d))
}

fn gcd(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { gcd(b, a % b) }
}
