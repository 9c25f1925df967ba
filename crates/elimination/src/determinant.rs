//! The 12 × 12 matrix of the hidden joint, and its determinant by blocks, eight values of the joint at a time.
//!
//! With `u = cos(q/2)`, `v = sin(q/2)` of the multiplied joint (`1, q` if it slides), each of the six equations reads
//! `(A u² + B u v + C v²) w = 0`, `w = (1, c, s)` of the last joint. Multiplied by `u` and by `v`, the unknowns
//! `x = (u³, r u² v, r u v², v³) ⊗ w` obey
//!
//! ```text
//! [ A  B/r C/r  0 ]
//! [ 0  A/r B/r  C ] x = 0,      r = √3
//! ```
//!
//! with weights that make the basis invariant under turns of `q`. The determinant is of degree 8 in the hidden angle.

use crate::{
    arm::Joint,
    instructions::{Compute, Instructions, part},
    lanes::{Lanes, one_by_one},
};

/// Degree of the determinant in the hidden angle.
pub(crate) const DEGREE: usize = 8;

/// Six rows of nine entries: the block that is eliminated, and the two in the middle.
pub type Strip = [[Lanes; 9]; 6];

/// The upper strip `[A | B/r C/r]` and the lower one `[C | A/r B/r]` at eight values of the hidden joint.
///
/// `rows` are those of [`Eliminated`](crate::eliminate::Eliminated); `c` and `s` the hidden joint's monomials.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
pub fn strips<I: Instructions>(
    rows: &[[f64; 27]; 6],
    multiplied: Joint,
    c: Lanes,
    s: Lanes,
    upper: &mut Strip,
    lower: &mut Strip,
) {
    let (r, half) = match multiplied {
        Joint::Revolute => (1.0 / 3.0f64.sqrt(), true),
        Joint::Prismatic => (1.0, false),
    };
    for i in 0..6 {
        let row = &rows[i];
        for w in 0..3 {
            one_by_one();
            let one = entry::<I>(row, w, c, s);
            let first = entry::<I>(row, 3 + w, c, s);
            let second = entry::<I>(row, 6 + w, c, s);
            let (a, b, c) = if half {
                (one.plus(first), second.scale(2.0 * r), one.minus(first))
            } else {
                (one, first, second)
            };
            upper[i][w] = a;
            upper[i][3 + w] = b;
            upper[i][6 + w] = c.scale(r);
            lower[i][w] = c;
            lower[i][3 + w] = a.scale(r);
            lower[i][6 + w] = b;
        }
    }
}

/// `E₁ + c E_c + s E_s`
#[inline(always)]
fn entry<I: Instructions>(row: &[f64; 27], k: usize, c: Lanes, s: Lanes) -> Lanes {
    s.scale_add::<I>(row[18 + k], c.scale_add::<I>(row[9 + k], Lanes::splat(row[k])))
}

/// Eliminates the first `columns` columns of six rows with partial pivoting; the product of the pivots, signed.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
pub fn reduce<I: Instructions, const N: usize>(m: &mut [[Lanes; N]; 6], columns: usize) -> Lanes {
    let mut product = Lanes::ONE;
    for k in 0..columns {
        for r in k + 1..6 {
            let (mine, other) = (m[k][k].magnitude(), m[r][k].magnitude());
            for c in k..N {
                one_by_one();
                let (a, b) = (m[k][c], m[r][c]);
                m[k][c] = mine.where_less(other, b, a);
                m[r][c] = mine.where_less(other, a, b);
            }
            product = mine.where_less(other, product.negated(), product);
        }
        product = product.times(m[k][k]);
        let inverse = m[k][k].where_is(0.0, Lanes::ZERO, Lanes::ONE.over(m[k][k]));
        for r in k + 1..6 {
            let factor = m[r][k].times(inverse);
            m[r][k] = factor;
            for c in k + 1..N {
                one_by_one();
                m[r][c] = factor.mul_sub::<I>(m[k][c], m[r][c]);
            }
        }
    }
    product
}

/// The 6 × 6 matrix that remains of the two reduced strips.
#[inline(always)]
pub fn core(upper: &Strip, lower: &Strip, out: &mut [[Lanes; 6]; 6]) {
    for i in 0..3 {
        for k in 0..6 {
            out[i][k] = upper[3 + i][3 + k];
            out[3 + i][k] = lower[3 + i][3 + k];
        }
    }
}

part! {
    /// The determinant at eight values of the hidden joint.
    pub fn determinant<I>(rows: &[[f64; 27]; 6], multiplied: Joint, c: Lanes, s: Lanes) -> Lanes {
        let (mut upper, mut lower) = ([[Lanes::ZERO; 9]; 6], [[Lanes::ZERO; 9]; 6]);
        strips::<I>(rows, multiplied, c, s, &mut upper, &mut lower);
        let first = reduce::<I, 9>(&mut upper, 3);
        let second = reduce::<I, 9>(&mut lower, 3);
        let mut rest = [[Lanes::ZERO; 6]; 6];
        core(&upper, &lower, &mut rest);
        let third = reduce::<I, 6>(&mut rest, 6);
        first.times(second).times(third)
    }
}
