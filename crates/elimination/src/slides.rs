//! Two slides and four turns: the turns close a spherical linkage of their own, and the slides enter linearly.
//!
//! With the turns read round the ring of rotations, `Z₁ C₁ Z₂ C₂ Z₃ C₃ Z₄ C₄ = 1`, and the first one hidden,
//! `(C₄ Z₁ C₁ Z₂ C₂)₃₃ = (C₃)₃₃` gives two branches of the second, and each of them the others. The position is linear in
//! the slides: the offset and the two directions must lie in a plane, `D = det [offset, a, b] = 0`. The product of both
//! branches' `D`, times a power of `A² + B²` (`A cos q₂ + B sin q₂ = K`), is a trigonometric polynomial of the hidden
//! angle; where the branches are complex, so is `D`, and the product is real.

use crate::{
    arm::{Arm, Joint},
    candidate::{ACCEPTED, Found, add, gather, lane},
    certificate::{Verdict, verdict},
    chart::Chart,
    charts::{Charts, DEEPEST, NEARBY, near_roots, noise},
    fourier::{Fourier, Trigonometric, USELESS},
    instructions::{Compute, Instructions, Strict, part},
    lanes::{Lanes, WIDTH},
    newton::polish,
    remaining::{Value, unit},
    rigid::Rigid,
    work::Work,
};

/// A way round the ring of the four turns.
#[derive(Clone, Debug)]
pub struct Sliding {
    /// The turning joints in the order of the ring, the hidden one first, counted from 0.
    pub turns: [usize; 4],
    /// The sliding joints.
    pub slides: [usize; 2],
    /// 1 where the ring is read forwards, −1 where backwards.
    pub sign: f64,
    /// `C₁ … C₄` (translations have no meaning); the one with the pose is the identity here.
    pub between: [Rigid; 4],
    /// Which of them contains the pose.
    pub pose_at: usize,
    /// Constants around the pose: `before T⁻¹ after`, inverted where read backwards.
    pub around_pose: [Rigid; 2],
    /// The power of `A² + B²` that makes the product a polynomial.
    pub power: usize,
    /// The polynomial's degree.
    pub degree: usize,
    /// Nodes and transform for this degree.
    pub fourier: Fourier<4>,
}

/// A complex number in each lane.
#[derive(Clone, Copy)]
struct Complex {
    re: Lanes,
    im: Lanes,
}

impl Complex {
    const ZERO: Complex = Complex { re: Lanes::ZERO, im: Lanes::ZERO };

    #[inline(always)]
    fn real(re: Lanes) -> Complex {
        Complex { re, im: Lanes::ZERO }
    }

    #[inline(always)]
    fn plus(self, b: Complex) -> Complex {
        Complex { re: self.re.plus(b.re), im: self.im.plus(b.im) }
    }

    #[inline(always)]
    fn minus(self, b: Complex) -> Complex {
        Complex { re: self.re.minus(b.re), im: self.im.minus(b.im) }
    }

    #[inline(always)]
    fn times<I: Instructions>(self, b: Complex) -> Complex {
        Complex {
            re: self.im.mul_sub::<I>(b.im, self.re.times(b.re)),
            im: self.im.mul_add::<I>(b.re, self.re.times(b.im)),
        }
    }

    #[inline(always)]
    fn scale_add<I: Instructions>(self, x: f64, c: Complex) -> Complex {
        Complex { re: self.re.scale_add::<I>(x, c.re), im: self.im.scale_add::<I>(x, c.im) }
    }

    #[inline(always)]
    fn scale(self, x: f64) -> Complex {
        Complex { re: self.re.scale(x), im: self.im.scale(x) }
    }
}

/// One branch: cosines and sines of the arm's joints (zeros for slides), what the position misses with the slides at 0,
/// and the slides' directions.
struct Branch {
    values: [[Complex; 2]; 6],
    offset: [Complex; 3],
    directions: [[Complex; 3]; 2],
}

impl Sliding {
    /// The ring that starts at the `first` of the turns; `None` if the arm has other than two slides, or if the third
    /// joint of the ring is parallel to the fourth. The power and the degree are still open.
    pub fn new(arm: &Arm, first: usize, forwards: bool) -> Option<Sliding> {
        let of = |kind: Joint| (0..6).filter(|&i| arm.joints[i] == kind).collect::<Vec<usize>>();
        let turning: [usize; 4] = of(Joint::Revolute).try_into().ok()?;
        let slides: [usize; 2] = of(Joint::Prismatic).try_into().ok()?;
        // The rotation behind turn number a, up to the next one; behind the last one up to the tool.
        let product =
            |from: usize, to: usize| arm.links[from..to].iter().fold(Rigid::IDENTITY, |a, b| a.then(b));
        let behind: [Rigid; 4] =
            std::array::from_fn(
                |a| if a < 3 { product(turning[a], turning[a + 1]) } else { Rigid::IDENTITY },
            );
        let (before, after) = (product(turning[3], 6), arm.base.then(&product(0, turning[0])));

        let order: [usize; 4] =
            std::array::from_fn(|i| if forwards { (first + i) % 4 } else { (first + 4 - i) % 4 });
        let between: [Rigid; 4] =
            order.map(|a| if forwards { behind[a] } else { behind[(a + 3) % 4].inverse() });
        let pose_at = order.iter().position(|&a| a == if forwards { 3 } else { 0 })?;
        let around_pose = if forwards { [before, after] } else { [after.inverse(), before.inverse()] };
        if pose_at != 2 && parallel(&between[2]) || pose_at != 1 && parallel(&between[1]) {
            return None;
        }
        Some(Sliding {
            turns: order.map(|a| turning[a]),
            slides,
            sign: if forwards { 1.0 } else { -1.0 },
            between,
            pose_at,
            around_pose,
            power: 0,
            degree: DEGREE,
            fourier: Fourier::new(DEGREE),
        })
    }

    /// The same with the power and the degree known; `None` also if the degree is too large.
    pub fn settled(arm: &Arm, first: usize, forwards: bool, power: usize, degree: usize) -> Option<Sliding> {
        let way = Sliding::new(arm, first, forwards)?;
        let is_degree = (1..=DEGREE).contains(&degree);
        is_degree.then(|| Sliding { power, degree, fourier: Fourier::new(degree), ..way })
    }

    /// Finds the power and the degree from the samples at some poses: the least degree that fits; false if none does.
    pub fn settle(&mut self, arm: &Arm, poses: &[Rigid]) -> bool {
        let mut best = None;
        for power in 0..=6 {
            self.power = power;
            let mut degree = 0;
            for pose in poses {
                let between = self.at(pose);
                let mut polynomial = Trigonometric::default();
                let samples = self.samples::<Strict>(arm, &between, pose, &Chart::WHOLE);
                if !self.fourier.fit::<Strict>(DEGREE, &samples, &mut polynomial) || polynomial.noise > 1e-10
                {
                    degree = DEGREE + 1;
                    break;
                }
                for k in 0..=DEGREE {
                    if polynomial.re[k].hypot(polynomial.im[k]) > 1e-10 {
                        degree = degree.max(k);
                    }
                }
            }
            if degree > 0 && degree <= DEGREE && best.is_none_or(|(_, least)| degree < least) {
                best = Some((power, degree));
            }
        }
        let Some((power, degree)) = best else { return false };
        self.power = power;
        self.degree = degree;
        self.fourier = Fourier::new(degree);
        true
    }

    /// The rotations between the turns with the pose in its place.
    fn at(&self, target: &Rigid) -> [Rigid; 4] {
        let mut between = self.between;
        let [before, after] = &self.around_pose;
        let pose = if self.sign > 0.0 { target.inverse() } else { *target };
        between[self.pose_at] = before.then(&pose).then(after);
        between
    }

    /// Products of the branches at the nodes of a chart.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn samples<I: Instructions>(
        &self,
        arm: &Arm,
        between: &[Rigid; 4],
        target: &Rigid,
        chart: &Chart,
    ) -> [Lanes; 4] {
        let mut samples = [Lanes::ZERO; 4];
        for (g, sample) in samples.iter_mut().enumerate() {
            let [c, s, weight] = chart.nodes::<I>(self.fourier.cosines[g], self.fourier.sines[g]);
            let mut product = Complex::real(Lanes::ONE);
            let mut square = Lanes::ZERO;
            for side in [1.0, -1.0] {
                let (branch, size) = self.branch::<I>(arm, between, target, c, s, side, true);
                product = product.times::<I>(determinant::<I>(&branch));
                square = size;
            }
            *sample = product.re;
            for _ in 0..self.power {
                *sample = sample.times(square);
            }
            for _ in 0..self.degree {
                *sample = sample.times(weight);
            }
        }
        samples
    }

    /// The branch `side` (±1) at eight values of the hidden joint, and `A² + B²`; complex where the second joint is, if
    /// `complex`, else the nearest real one.
    #[inline(always)]
    #[allow(clippy::too_many_arguments)]
    fn branch<I: Instructions>(
        &self,
        arm: &Arm,
        between: &[Rigid; 4],
        target: &Rigid,
        c: Lanes,
        s: Lanes,
        side: f64,
        complex: bool,
    ) -> (Branch, Lanes) {
        // w = (C₄ Z₁ C₁)ᵀ e₃, v = C₂ e₃: w·(Z₂ v) = (C₃)₃₃
        let row = between[3].rotation[2];
        let turned = [
            s.scale_add::<I>(row[1], c.scale(row[0])),
            c.scale_add::<I>(row[1], s.scale(-row[0])),
            Lanes::splat(row[2]),
        ];
        let mut w = [Lanes::ZERO; 3];
        for (k, w) in w.iter_mut().enumerate() {
            for (turned, row) in turned.iter().zip(&between[0].rotation) {
                *w = turned.scale_add::<I>(row[k], *w);
            }
        }
        let third = &between[1].rotation;
        let v = [third[0][2], third[1][2], third[2][2]];
        let a = w[1].scale_add::<I>(v[1], w[0].scale(v[0]));
        let b = w[0].scale_add::<I>(-v[1], w[1].scale(v[0]));
        let k = w[2].scale_add::<I>(-v[2], Lanes::splat(between[2].rotation[2][2]));
        let square = b.mul_add::<I>(b, a.times(a));
        let left = k.mul_sub::<I>(k, square);
        let root = left.magnitude().root().scale(side);
        let none = if complex { root } else { Lanes::ZERO };
        let root = Complex {
            re: left.where_less(Lanes::ZERO, Lanes::ZERO, root),
            im: left.where_less(Lanes::ZERO, none, Lanes::ZERO),
        };
        let inverse = Lanes::ONE.over(square.larger(Lanes::splat(1e-200)));
        // (c₂, s₂) = ((A, B) K + (−B, A) root) / (A² + B²)
        let c2 = Complex {
            re: b.mul_sub::<I>(root.re, a.times(k)).times(inverse),
            im: b.times(root.im).times(inverse).negated(),
        };
        let s2 = Complex {
            re: a.mul_add::<I>(root.re, b.times(k)).times(inverse),
            im: a.times(root.im).times(inverse),
        };

        // h = C₄ Z₁ C₁ Z₂ C₂ e₃ = Z₄⁻¹ C₃ᵀ e₃,   g = C₂ᵀ Z₂ᵀ w = Z₃ C₃ e₃
        let y = [
            c2.scale(v[0]).plus(s2.scale(-v[1])),
            s2.scale(v[0]).plus(c2.scale(v[1])),
            Complex::real(Lanes::splat(v[2])),
        ];
        let y = turn::<I>(&between[0], &y);
        let (c1, s1) = (Complex::real(c), Complex::real(s));
        let y = [
            c1.times::<I>(y[0]).minus(s1.times::<I>(y[1])),
            s1.times::<I>(y[0]).plus(c1.times::<I>(y[1])),
            y[2],
        ];
        let h = turn::<I>(&between[3], &y);
        let w = [Complex::real(w[0]), Complex::real(w[1]), Complex::real(w[2])];
        let y = [
            c2.times::<I>(w[0]).plus(s2.times::<I>(w[1])),
            c2.times::<I>(w[1]).minus(s2.times::<I>(w[0])),
            w[2],
        ];
        let g = turn::<I>(&between[1].inverse(), &y);
        let m = &between[2].rotation;
        let (a, b) = ([m[2][0], m[2][1]], [m[0][2], m[1][2]]);
        let size = 1.0 / (a[0] * a[0] + a[1] * a[1]);
        let c4 = h[0].scale(a[0] * size).plus(h[1].scale(a[1] * size));
        let s4 = h[0].scale(a[1] * size).plus(h[1].scale(-a[0] * size));
        let size = 1.0 / (b[0] * b[0] + b[1] * b[1]);
        let c3 = g[0].scale(b[0] * size).plus(g[1].scale(b[1] * size));
        let s3 = g[1].scale(b[0] * size).plus(g[0].scale(-b[1] * size));

        let mut values = [[Complex::ZERO; 2]; 6];
        for (joint, [c, s]) in self.turns.into_iter().zip([[c1, s1], [c2, s2], [c3, s3], [c4, s4]]) {
            values[joint] = [c, s.scale(self.sign)];
        }
        (self.position::<I>(arm, target, values), square)
    }

    /// The chain with the slides at 0.
    #[cfg_attr(not(target_arch = "wasm32"), inline(always))]
    fn position<I: Instructions>(&self, arm: &Arm, target: &Rigid, values: [[Complex; 2]; 6]) -> Branch {
        let mut rotation = [[Complex::ZERO; 3]; 3];
        let mut offset = [Complex::ZERO; 3];
        for x in 0..3 {
            offset[x].re = Lanes::splat(arm.base.translation[x] - target.translation[x]);
            for k in 0..3 {
                rotation[x][k].re = Lanes::splat(arm.base.rotation[x][k]);
            }
        }
        let mut directions = [[Complex::ZERO; 3]; 2];
        for i in 0..6 {
            let [c, s] = values[i];
            let link = &arm.links[i];
            for x in 0..3 {
                let row = rotation[x];
                if i == self.slides[0] {
                    directions[0][x] = row[2];
                }
                if i == self.slides[1] {
                    directions[1][x] = row[2];
                }
                let row = match arm.joints[i] {
                    Joint::Revolute => [
                        c.times::<I>(row[0]).plus(s.times::<I>(row[1])),
                        c.times::<I>(row[1]).minus(s.times::<I>(row[0])),
                        row[2],
                    ],
                    Joint::Prismatic => row,
                };
                for k in 0..3 {
                    offset[x] = row[k].scale_add::<I>(link.translation[k], offset[x]);
                    let entry = row[0].scale(link.rotation[0][k]);
                    let entry = row[1].scale_add::<I>(link.rotation[1][k], entry);
                    rotation[x][k] = row[2].scale_add::<I>(link.rotation[2][k], entry);
                }
            }
        }
        Branch { values, offset, directions }
    }
}

/// Largest degree of the polynomial.
const DEGREE: usize = 12;

fn parallel(rotation: &Rigid) -> bool {
    let r = &rotation.rotation;
    r[0][2].hypot(r[1][2]) < 1e-9
}

#[inline(always)]
fn turn<I: Instructions>(by: &Rigid, v: &[Complex; 3]) -> [Complex; 3] {
    let mut out = [Complex::ZERO; 3];
    for (out, row) in out.iter_mut().zip(&by.rotation) {
        for (v, x) in v.iter().zip(row) {
            *out = v.scale_add::<I>(*x, *out);
        }
    }
    out
}

#[inline(always)]
fn determinant<I: Instructions>(of: &Branch) -> Complex {
    let [a, b] = &of.directions;
    let mut sum = Complex::ZERO;
    for x in 0..3 {
        let (y, z) = ((x + 1) % 3, (x + 2) % 3);
        let normal = a[y].times::<I>(b[z]).minus(a[z].times::<I>(b[y]));
        sum = sum.plus(of.offset[x].times::<I>(normal));
    }
    sum
}

part! {
    /// Solves one ring and adds what it finds to `work.found`.
    pub(crate) fn solve_sliding<I>(
        arm: &Arm,
        sliding: &Sliding,
        target: &Rigid,
        work: &mut Work,
    ) -> Verdict {
        let between = sliding.at(target);
        work.candidates.clear();
        let mut charts = Charts::whole(DEEPEST);
        while let Some(chart) = charts.next() {
            let verdict = solve_chart::<I>(arm, sliding, &between, target, &chart, work);
            charts.settle::<I>(&chart, verdict, work);
        }
        charts.verdict(work)
    }
}

/// Finds the roots that a chart shows, and the configurations that belong to them.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn solve_chart<I: Instructions>(
    arm: &Arm,
    sliding: &Sliding,
    between: &[Rigid; 4],
    target: &Rigid,
    chart: &Chart,
    work: &mut Work,
) -> Verdict {
    work.marks.count = 0;
    let samples = sliding.samples::<I>(arm, between, target, chart);
    let useful = sliding.fourier.fit::<I>(sliding.degree, &samples, &mut work.polynomial);
    if !useful || work.polynomial.noise > USELESS {
        return Verdict::Uncertain;
    }
    work.wide.find::<I>(&work.polynomial, noise(&work.polynomial));
    let mut near = [([0.0; 2], false); NEARBY];
    let count = near_roots(chart, &work.wide, &mut near);
    for group in near[..count].chunks(WIDTH) {
        let [c, s] = gather(group, |(pair, _)| *pair);
        for side in [1.0, -1.0] {
            let (branch, _) = sliding.branch::<I>(arm, between, target, c, s, side, false);
            let mut values = real_values::<I>(sliding, &branch);
            let residual = polish::<I>(arm, target, &mut values);
            for l in 0..group.len() {
                if residual.0[l] <= ACCEPTED {
                    add(arm, &mut work.found, Found { values: lane(&values, l), residual: residual.0[l] });
                }
            }
        }
    }
    verdict(sliding.turns[0], sliding.sign, chart, &work.wide, &work.found, &mut work.marks)
}

/// The joints' values with the slides that come nearest to the position.
#[inline(always)]
fn real_values<I: Instructions>(sliding: &Sliding, branch: &Branch) -> [Value; 6] {
    let mut values = [[Lanes::ZERO; 2]; 6];
    for joint in sliding.turns {
        let [c, s] = &branch.values[joint];
        values[joint] = unit::<I>(c.re, s.re);
    }
    let [a, b] = &branch.directions;
    let (mut aa, mut ab, mut bb) = (Lanes::ZERO, Lanes::ZERO, Lanes::splat(1e-30));
    let (mut ao, mut bo) = (Lanes::ZERO, Lanes::ZERO);
    for x in 0..3 {
        aa = a[x].re.mul_add::<I>(a[x].re, aa);
        ab = a[x].re.mul_add::<I>(b[x].re, ab);
        bb = b[x].re.mul_add::<I>(b[x].re, bb);
        ao = a[x].re.mul_add::<I>(branch.offset[x].re, ao);
        bo = b[x].re.mul_add::<I>(branch.offset[x].re, bo);
    }
    let det = ab.mul_sub::<I>(ab, aa.times(bb)).larger(Lanes::splat(1e-30));
    let inverse = Lanes::splat(-1.0).over(det);
    values[sliding.slides[0]][0] = bo.mul_sub::<I>(ab, ao.times(bb)).times(inverse);
    values[sliding.slides[1]][0] = ao.mul_sub::<I>(ab, bo.times(aa)).times(inverse);
    values
}
