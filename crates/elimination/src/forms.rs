//! The fourteen functions of a line through which the loop equation is cut (Raghavan and Roth 1990, 1993).
//!
//! For the line of the dropped joint, with a point `p` on it and its direction `l`:
//!
//! `f(p, l) = [p, l, p·p, p·l, p×l, (p·p) l − 2 (p·l) p]`.
//!
//! A rigid motion of `p` and `l` acts on `f` by an affine map, so each entry stays linear in `(1, cos, sin)` of every
//! angle and in `(1, d, d²)` of every slide on the way.

use crate::{
    arm::Joint,
    rigid::{Rigid, cross, dot},
};

/// Number of the functions.
pub const FORMS: usize = 14;

/// `f(p, l)`.
#[inline]
pub fn forms(p: [f64; 3], l: [f64; 3]) -> [f64; FORMS] {
    let (pp, pl, n) = (dot(p, p), dot(p, l), cross(p, l));
    [
        p[0],
        p[1],
        p[2],
        l[0],
        l[1],
        l[2],
        pp,
        pl,
        n[0],
        n[1],
        n[2],
        pp * l[0] - 2.0 * pl * p[0],
        pp * l[1] - 2.0 * pl * p[1],
        pp * l[2] - 2.0 * pl * p[2],
    ]
}

/// Values of a joint at which a function of it is sampled: cosine and sine of 0 and ±120°, or slides −1, 0, 1.
#[inline]
pub fn nodes(joint: Joint) -> [Rigid; 3] {
    match joint {
        Joint::Revolute => {
            let s = 0.75f64.sqrt();
            [Rigid::IDENTITY, Rigid::about_z(-0.5, s), Rigid::about_z(-0.5, -s)]
        }
        Joint::Prismatic => [Rigid::along_z(-1.0), Rigid::IDENTITY, Rigid::along_z(1.0)],
    }
}

/// The coefficients of `(1, cos, sin)` or `(1, d, d²)` from the values at the [`nodes`].
#[inline]
pub fn interpolate(joint: Joint, [a, b, c]: [f64; 3]) -> [f64; 3] {
    match joint {
        Joint::Revolute => {
            let s = 0.75f64.sqrt();
            [(a + b + c) / 3.0, (2.0 * a - b - c) / 3.0, (b - c) * (2.0 * s / 3.0)]
        }
        Joint::Prismatic => [b, (c - a) / 2.0, (a + c) / 2.0 - b],
    }
}

/// Where each vector of three stands among the functions.
const VECTORS: [usize; 4] = [0, 3, 8, 11];

/// From coefficients over one joint's monomials to coefficients over two (9, the second joint's fastest): the line moved
/// by the inverse of the second joint.
#[inline]
pub fn move_by_joint_back(joint: Joint, of: &[[f64; 3]; FORMS]) -> [[f64; 9]; FORMS] {
    let mut out = [[0.0; 9]; FORMS];
    for i in 0..3 {
        let at = 3 * i;
        match joint {
            // Rz(-q) v = (c x + s y, c y − s x, z)
            Joint::Revolute => {
                for b in VECTORS {
                    let (x, y, z) = (of[b][i], of[b + 1][i], of[b + 2][i]);
                    out[b][at + 1] = x;
                    out[b][at + 2] = y;
                    out[b + 1][at + 1] = y;
                    out[b + 1][at + 2] = -x;
                    out[b + 2][at] = z;
                }
                out[6][at] = of[6][i];
                out[7][at] = of[7][i];
            }
            // p − d e₃: the affine map of `moved` with t = −d e₃
            Joint::Prismatic => {
                for k in 0..FORMS {
                    out[k][at] = of[k][i];
                }
                out[6][at + 1] = -2.0 * of[2][i];
                out[7][at + 1] = -of[5][i];
                out[8][at + 1] = of[4][i];
                out[9][at + 1] = -of[3][i];
                out[11][at + 1] = -2.0 * of[9][i];
                out[12][at + 1] = 2.0 * of[8][i];
                out[13][at + 1] = 2.0 * of[7][i];
                out[11][at + 2] = of[3][i];
                out[12][at + 2] = of[4][i];
                out[13][at + 2] = -of[5][i];
            }
        }
    }
    if joint == Joint::Prismatic {
        out[2][1] -= 1.0;
        out[6][2] += 1.0;
    }
    out
}

/// The functions of the line moved by `by`, from their coefficients over nine monomials, the first of which is 1.
///
/// With `P = R p`, `L = R l`: `p·p + 2 t·P + t·t`, `p·l + t·L`, `P×L + t×L`, and the last
/// `(P·P) L − 2 (P·L) P − 2 t×(P×L) + (t·t) L − 2 (P·L) t − 2 (t·L) t`.
#[inline]
pub fn moved(by: &Rigid, of: &[[f64; 9]; FORMS]) -> [[f64; 9]; FORMS] {
    let t = by.translation;
    let tt = dot(t, t);
    let mut out = [[0.0; 9]; FORMS];
    for k in 0..9 {
        let vector = |b: usize| by.turn([of[b][k], of[b + 1][k], of[b + 2][k]]);
        let (p, l, n, last) = (vector(0), vector(3), vector(8), vector(11));
        let (pl, tl, tn, t_l) = (of[7][k], dot(t, l), cross(t, n), cross(t, l));
        let one = if k == 0 { 1.0 } else { 0.0 };
        for x in 0..3 {
            out[x][k] = p[x] + one * t[x];
            out[3 + x][k] = l[x];
            out[8 + x][k] = n[x] + t_l[x];
            out[11 + x][k] = last[x] - 2.0 * tn[x] + tt * l[x] - 2.0 * (pl + tl) * t[x];
        }
        out[6][k] = of[6][k] + 2.0 * dot(t, p) + one * tt;
        out[7][k] = pl + tl;
    }
    out
}

/// The functions that the inverse of the second joint leaves alone: six equations in the first joint only.
#[inline]
pub fn left_alone(joint: Joint) -> [usize; 6] {
    match joint {
        Joint::Revolute => [2, 5, 6, 7, 10, 13],
        Joint::Prismatic => [0, 1, 3, 4, 5, 10],
    }
}
