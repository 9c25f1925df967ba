//! All complex roots `z = exp(iθ)` of a trigonometric polynomial at once (Aberth 1973, Ehrlich 1967).
//!
//! `P(z) = zⁿ p` has the degree `2 n` and is self-inversive: with `z` also `1/z̄` is a root, so real angles are roots on
//! the circle, or pairs that rounding has moved off it.

use crate::{
    fourier::Trigonometric,
    instructions::Instructions,
    lanes::{Lanes, WIDTH},
};

/// The roots, eight a group.
#[derive(Clone, Debug)]
pub struct Roots<const GROUPS: usize> {
    /// Real parts.
    pub re: [Lanes; GROUPS],
    /// Imaginary parts.
    pub im: [Lanes; GROUPS],
    /// Upper bounds of their distances from the true roots (Smith 1970), at the noise given.
    pub radius: [Lanes; GROUPS],
    /// How many roots there are; what follows them has no meaning.
    pub count: usize,
    /// Iterations used.
    pub iterations: u32,
}

impl<const GROUPS: usize> Default for Roots<GROUPS> {
    fn default() -> Roots<GROUPS> {
        let none = [Lanes::ZERO; GROUPS];
        Roots { re: none, im: none, radius: none, count: 0, iterations: 0 }
    }
}

/// Leading coefficients below this are dropped: their roots are at 0 and at infinity.
const LEADING: f64 = 1e-14;
/// Where roots that do not exist are kept.
const FAR: f64 = 1e30;
/// A root at which the polynomial is smaller than this is not improved.
const FLOOR: f64 = 1e-16;
/// Square of the relative step that ends the iteration.
const STEP: f64 = 1e-22;
/// Most iterations.
const MOST: u32 = 40;

impl<const GROUPS: usize> Roots<GROUPS> {
    /// Finds the roots; `noise` is the relative error of the polynomial on the circle that the radii allow for.
    #[inline(always)]
    pub fn find<I: Instructions>(&mut self, of: &Trigonometric, noise: f64) {
        let mut degree = of.degree;
        while degree > 0 && of.re[degree] * of.re[degree] + of.im[degree] * of.im[degree] < LEADING * LEADING
        {
            degree -= 1;
        }
        let count = 2 * degree;
        self.count = count;
        self.iterations = 0;
        if count == 0 {
            return;
        }
        // Coefficients of P from the constant on: c₋ₙ … cₙ
        let (mut re, mut im) = ([0.0; 25], [0.0; 25]);
        for k in 0..=degree {
            (re[degree + k], im[degree + k]) = (of.re[k], of.im[k]);
            (re[degree - k], im[degree - k]) = (of.re[k], -of.im[k]);
        }
        let mut live = [Lanes::ZERO; GROUPS];
        for k in 0..WIDTH * GROUPS {
            let exists = k < count;
            let angle = std::f64::consts::TAU * (k as f64 + 0.3) / count as f64;
            let radius = if k.is_multiple_of(2) { 1.05 } else { 1.0 / 1.05 };
            let (s, c) = angle.sin_cos();
            self.re[k / 8].0[k % 8] = if exists { radius * c } else { FAR };
            self.im[k / 8].0[k % 8] = if exists { radius * s } else { FAR * (k + 1) as f64 };
            live[k / 8].0[k % 8] = if exists { 1.0 } else { 0.0 };
        }

        for _ in 0..MOST {
            self.iterations += 1;
            let mut largest = Lanes::ZERO;
            let (mut next_re, mut next_im) = (self.re, self.im);
            for g in 0..GROUPS {
                let (x, y) = (self.re[g], self.im[g]);
                let (mut pr, mut pi) = (Lanes::splat(re[count]), Lanes::splat(im[count]));
                let (mut dr, mut di) = (Lanes::ZERO, Lanes::ZERO);
                for k in (0..count).rev() {
                    // P' ← P' z + P,   P ← P z + c
                    let t = di.mul_sub::<I>(y, pr);
                    let next = dr.mul_add::<I>(x, t);
                    di = dr.mul_add::<I>(y, di.mul_add::<I>(x, pi));
                    dr = next;
                    let t = pi.mul_sub::<I>(y, Lanes::splat(re[k]));
                    let next = pr.mul_add::<I>(x, t);
                    pi = pr.mul_add::<I>(y, pi.mul_add::<I>(x, Lanes::splat(im[k])));
                    pr = next;
                }
                let (mut sr, mut si) = (Lanes::ZERO, Lanes::ZERO);
                for k in 0..count {
                    let dx = x.minus(Lanes::splat(self.re[k / 8].0[k % 8]));
                    let dy = y.minus(Lanes::splat(self.im[k / 8].0[k % 8]));
                    let square = dy.mul_add::<I>(dy, dx.times(dx));
                    let inverse = square.where_is(0.0, Lanes::ZERO, Lanes::ONE.over(square));
                    sr = dx.mul_add::<I>(inverse, sr);
                    si = dy.mul_sub::<I>(inverse, si);
                }
                // step = P / (P' − P S)
                let er = pi.mul_add::<I>(si, pr.mul_sub::<I>(sr, dr));
                let ei = pi.mul_sub::<I>(sr, pr.mul_sub::<I>(si, di));
                let square = ei.mul_add::<I>(ei, er.times(er));
                let inverse = square.where_is(0.0, Lanes::ZERO, Lanes::ONE.over(square));
                let step_r = pi.mul_add::<I>(ei, pr.times(er)).times(inverse);
                let step_i = pr.mul_sub::<I>(ei, pi.times(er)).times(inverse);
                // No step where P is at its rounding error, and none of roots that do not exist.
                let modulus = y.mul_add::<I>(y, x.times(x));
                let scale = growth(modulus, degree);
                let value = pi.mul_add::<I>(pi, pr.times(pr)).root();
                let go = value.where_less(scale.scale(FLOOR), Lanes::ZERO, live[g]);
                let (step_r, step_i) =
                    (go.where_is(0.0, Lanes::ZERO, step_r), go.where_is(0.0, Lanes::ZERO, step_i));
                next_re[g] = x.minus(step_r);
                next_im[g] = y.minus(step_i);
                let step = step_i.mul_add::<I>(step_i, step_r.times(step_r)).over(modulus);
                largest = largest.larger(step);
            }
            (self.re, self.im) = (next_re, next_im);
            if largest.largest() < STEP {
                break;
            }
        }
        self.bound::<I>(&re, &im, degree, noise);
    }

    /// Smith's radii `n (|P(z)| + noise s(z)) / |cₙ Π (z − zⱼ)|`, with `s(z) = max(1, |z|ⁿ)`.
    #[inline(always)]
    fn bound<I: Instructions>(&mut self, re: &[f64; 25], im: &[f64; 25], degree: usize, noise: f64) {
        let count = 2 * degree;
        let leading = (re[count] * re[count] + im[count] * im[count]).sqrt();
        for g in 0..GROUPS {
            let (x, y) = (self.re[g], self.im[g]);
            let (mut pr, mut pi) = (Lanes::splat(re[count]), Lanes::splat(im[count]));
            let mut product = Lanes::splat(leading * leading);
            for k in (0..count).rev() {
                let t = pi.mul_sub::<I>(y, Lanes::splat(re[k]));
                let next = pr.mul_add::<I>(x, t);
                pi = pr.mul_add::<I>(y, pi.mul_add::<I>(x, Lanes::splat(im[k])));
                pr = next;
            }
            for k in 0..count {
                let dx = x.minus(Lanes::splat(self.re[k / 8].0[k % 8]));
                let dy = y.minus(Lanes::splat(self.im[k / 8].0[k % 8]));
                let square = dy.mul_add::<I>(dy, dx.times(dx));
                // The root itself; roots that coincide keep a radius that reaches everything near.
                let mut own = Lanes::ZERO;
                if k / 8 == g {
                    own.0[k % 8] = 1.0;
                }
                let square = own.where_is(1.0, Lanes::ONE, square.larger(Lanes::splat(1e-30)));
                product = product.times(square);
            }
            let scale = growth(y.mul_add::<I>(y, x.times(x)), degree);
            let value = pi.mul_add::<I>(pi, pr.times(pr)).root();
            let error = scale.scale_add::<I>(noise, value).scale(count as f64);
            self.radius[g] = error.over(product.root());
        }
    }
}

/// `max(1, |z|ⁿ)` for a polynomial of degree `2 degree`, from `|z|²`.
#[inline(always)]
fn growth(modulus: Lanes, degree: usize) -> Lanes {
    let mut power = modulus;
    for _ in 1..degree {
        power = power.times(modulus);
    }
    Lanes::ONE.larger(power)
}
