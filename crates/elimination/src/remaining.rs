//! From a null vector at a value of the hidden joint to all six joints, eight candidates at a time.

use crate::{
    arm::Joint,
    eliminate::Eliminated,
    extract::UNKNOWNS,
    instructions::{Compute, Instructions, part},
    lanes::Lanes,
    rigid::Rigid,
    split::Split,
};

/// A joint's value in each lane: cosine and sine, or the slide (scaled) and nothing.
pub type Value = [Lanes; 2];

/// Three numbers in each lane.
type Vector = [Lanes; 3];

/// How the first joint follows from the six forms that the second one leaves alone; the same for all candidates.
#[derive(Clone, Copy, Debug)]
pub struct First {
    /// The joint's two monomials from the six forms without their constants (least squares).
    weights: [[f64; 6]; 2],
    /// If the forms know one combination of cosine and sine only: the direction that they leave open. Both of the
    /// angles with this combination are candidates.
    pub open: Option<[f64; 2]>,
}

/// Relative size of the smaller singular value squared at which the forms know one combination only.
const OPEN: f64 = 1e-9;

impl First {
    /// From the coefficients over `(1, c, s)` or `(1, d, d²)`.
    pub fn new(kind: Joint, first: &[[f64; 3]; 6]) -> First {
        let (mut aa, mut ab, mut bb) = (0.0, 0.0, 0.0);
        for row in first {
            aa += row[1] * row[1];
            ab += row[1] * row[2];
            bb += row[2] * row[2];
        }
        let (det, trace) = (aa * bb - ab * ab, aa + bb);
        let mut weights = [[0.0; 6]; 2];
        if det > OPEN * trace * trace {
            for (k, row) in first.iter().enumerate() {
                weights[0][k] = (bb * row[1] - ab * row[2]) / det;
                weights[1][k] = (aa * row[2] - ab * row[1]) / det;
            }
            return First { weights, open: None };
        }
        if kind == Joint::Prismatic {
            for (k, row) in first.iter().enumerate() {
                weights[0][k] = if aa > 0.0 { row[1] / aa } else { 0.0 };
            }
            return First { weights, open: None };
        }
        // The direction n of the larger eigenvalue: m = n (n·AᵀF) / trace
        let (x, y) = if aa > bb { (aa, ab) } else { (ab, bb) };
        let norm = (x * x + y * y).sqrt();
        if norm > 0.0 {
            let n = [x / norm, y / norm];
            for (k, row) in first.iter().enumerate() {
                let along = (n[0] * row[1] + n[1] * row[2]) / trace;
                weights[0][k] = n[0] * along;
                weights[1][k] = n[1] * along;
            }
            return First { weights, open: Some([-n[1], n[0]]) };
        }
        First { weights, open: Some([0.0, 1.0]) }
    }
}

part! {
    /// The values of all joints, in the arm's order, of the candidates with the hidden joint at `hidden` and the null vectors
    /// `x`; `branch` (±1) chooses between the first joint's angles where the forms leave it open.
    pub fn complete<I>(
        split: &Split,
        eliminated: &Eliminated,
        first: &First,
        branch: f64,
        hidden: &Value,
        x: &[Lanes; UNKNOWNS],
        out: &mut [Value; 6],
    ) {
        let mut ring = [[Lanes::ZERO; 2]; 6];
        ring[2] = *hidden;
        trio::<I>(split, x, &mut ring);

        // The dropped joint's line, and its x direction, in the frame before the second joint's inverse.
        let links = &eliminated.links;
        let r = &links[4].rotation;
        let mut p = splat(links[4].translation);
        let mut l = splat([r[0][2], r[1][2], r[2][2]]);
        let mut e = splat([r[0][0], r[1][0], r[2][0]]);
        for i in [4, 3, 2] {
            let link = &links[i - 1];
            p = through::<I>(link, true, joint::<I>(split.kinds[i], &ring[i], true, p));
            l = through::<I>(link, false, joint::<I>(split.kinds[i], &ring[i], false, l));
            e = through::<I>(link, false, joint::<I>(split.kinds[i], &ring[i], false, e));
        }

        // The first joint.
        let pp = product::<I>(&p, &p);
        let pl = product::<I>(&p, &l);
        let normal = p[1].times(l[0]);
        let normal = p[0].times(l[1]).minus(normal);
        let last = pp.times(l[2]).minus(pl.times(p[2]).scale(2.0));
        let seen = match split.kinds[1] {
            Joint::Revolute => [p[2], l[2], pp, pl, normal, last],
            Joint::Prismatic => [p[0], p[1], l[0], l[1], l[2], normal],
        };
        let mut m = [Lanes::ZERO; 2];
        for (k, form) in seen.into_iter().enumerate() {
            let rest = form.minus(Lanes::splat(eliminated.first[k][0]));
            m[0] = rest.scale_add::<I>(first.weights[0][k], m[0]);
            m[1] = rest.scale_add::<I>(first.weights[1][k], m[1]);
        }
        if let Some(open) = first.open {
            let left = Lanes::ONE.minus(m[1].mul_add::<I>(m[1], m[0].times(m[0])));
            let left = left.larger(Lanes::ZERO).root().scale(branch);
            m[0] = left.scale_add::<I>(open[0], m[0]);
            m[1] = left.scale_add::<I>(open[1], m[1]);
        }
        ring[0] = match split.kinds[0] {
            Joint::Revolute => unit::<I>(m[0], m[1]),
            Joint::Prismatic => [m[0], Lanes::ZERO],
        };

        // The same line from the other side, up to the second joint: L₁⁻¹ Z₁⁻¹ L₆⁻¹
        let close = &links[5];
        let p2 = joint_back::<I>(split.kinds[0], &ring[0], true, splat(close.point_back([0.0; 3])));
        let p2 = through_back::<I>(&links[0], true, p2);
        let l2 = joint_back::<I>(split.kinds[0], &ring[0], false, splat(close.rotation[2]));
        let l2 = through_back::<I>(&links[0], false, l2);
        ring[1] = match split.kinds[1] {
            // (x', y') = (c x + s y, c y − s x)
            Joint::Revolute => {
                let mut c = p[0].times(p2[0]);
                c = p[1].mul_add::<I>(p2[1], c);
                c = l[0].mul_add::<I>(l2[0], c);
                c = l[1].mul_add::<I>(l2[1], c);
                let mut s = p[0].times(p2[1]);
                s = p[1].mul_sub::<I>(p2[0], s);
                s = l[0].mul_add::<I>(l2[1], s);
                s = l[1].mul_sub::<I>(l2[0], s);
                unit::<I>(c, s)
            }
            Joint::Prismatic => [p2[2].minus(p[2]), Lanes::ZERO],
        };

        // The dropped joint: Z₆⁻¹ e₁ = (c, −s, 0) in the frame behind L₆.
        let mut y = joint::<I>(split.kinds[1], &ring[1], false, e);
        y = through::<I>(&links[0], false, y);
        y = joint::<I>(split.kinds[0], &ring[0], false, y);
        y = through::<I>(close, false, y);
        ring[5] = unit::<I>(y[0], y[1].negated());

        for (i, value) in ring.into_iter().enumerate() {
            out[split.joints[i]] = match split.kinds[i] {
                Joint::Revolute => [value[0], value[1].scale(split.sign)],
                Joint::Prismatic => [value[0].scale(split.sign), Lanes::ZERO],
            };
        }
    }
}

/// The two joints of the trio behind the hidden one, from the null vector.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
fn trio<I: Instructions>(split: &Split, x: &[Lanes; UNKNOWNS], ring: &mut [Value; 6]) {
    let (multiplied, other) = split.multiplied_and_other();
    let weight = if multiplied == Joint::Revolute { 1.0 / 3.0f64.sqrt() } else { 1.0 };
    let mut y = *x;
    for entry in &mut y[3..9] {
        *entry = entry.scale(weight);
    }
    // y = (u³, u²v, uv², v³) ⊗ w: the rows without the last block are u z, those without the first v z.
    let (mut uu, mut uv, mut vv) = (Lanes::ZERO, Lanes::ZERO, Lanes::ZERO);
    for k in 0..9 {
        uu = y[k].mul_add::<I>(y[k], uu);
        uv = y[k].mul_add::<I>(y[k + 3], uv);
        vv = y[k + 3].mul_add::<I>(y[k + 3], vv);
    }
    let (value, u, v) = match multiplied {
        Joint::Revolute => {
            let value = unit::<I>(uu.minus(vv), uv.plus(uv));
            let [c, s] = value;
            // Half angles without cancellation: the larger of u and v by a root, the other from s = 2 u v.
            let large = Lanes::splat(0.5).plus(c.magnitude().scale(0.5)).root();
            let small = s.over(large.plus(large));
            let u = c.where_less(Lanes::ZERO, small, large);
            let v = c.where_less(Lanes::ZERO, large, small);
            (value, u, v)
        }
        Joint::Prismatic => {
            let d = uv.over(uu);
            ([d, Lanes::ZERO], Lanes::ONE, d)
        }
    };
    let (u2, v2) = (u.times(u), v.times(v));
    let powers = [u2.times(u), u2.times(v), u.times(v2), v2.times(v)];
    let mut w = [Lanes::ZERO; 3];
    for (j, w) in w.iter_mut().enumerate() {
        for (k, power) in powers.iter().enumerate() {
            *w = y[3 * k + j].mul_add::<I>(*power, *w);
        }
    }
    let other_value = match other {
        Joint::Revolute => {
            let [c, s] = unit::<I>(w[1], w[2]);
            [w[0].where_less(Lanes::ZERO, c.negated(), c), w[0].where_less(Lanes::ZERO, s.negated(), s)]
        }
        Joint::Prismatic => [w[1].over(w[0]), Lanes::ZERO],
    };
    let (fourth, fifth) = if split.last_multiplied { (other_value, value) } else { (value, other_value) };
    ring[3] = without_offset::<I>(split, split.kinds[3], fourth);
    ring[4] = without_offset::<I>(split, split.kinds[4], fifth);
}

#[inline(always)]
fn without_offset<I: Instructions>(split: &Split, kind: Joint, [c, s]: Value) -> Value {
    let [oc, os] = split.offset;
    match kind {
        Joint::Revolute => [s.scale_add::<I>(os, c.scale(oc)), c.scale_add::<I>(-os, s.scale(oc))],
        Joint::Prismatic => [c, s],
    }
}

/// `(c, s)` divided by its length; `(1, 0)` if it has none.
#[inline(always)]
pub fn unit<I: Instructions>(c: Lanes, s: Lanes) -> Value {
    let square = s.mul_add::<I>(s, c.times(c));
    let inverse = Lanes::ONE.over(square.where_is(0.0, Lanes::ONE, square).root());
    [square.where_is(0.0, Lanes::ONE, c.times(inverse)), s.times(inverse)]
}

#[inline(always)]
fn splat(v: [f64; 3]) -> Vector {
    [Lanes::splat(v[0]), Lanes::splat(v[1]), Lanes::splat(v[2])]
}

#[inline(always)]
fn product<I: Instructions>(a: &Vector, b: &Vector) -> Lanes {
    a[2].mul_add::<I>(b[2], a[1].mul_add::<I>(b[1], a[0].times(b[0])))
}

/// A direction, or a point, through a constant transform.
#[inline(always)]
fn through<I: Instructions>(by: &Rigid, point: bool, v: Vector) -> Vector {
    let mut out = if point { splat(by.translation) } else { [Lanes::ZERO; 3] };
    for (out, row) in out.iter_mut().zip(&by.rotation) {
        for (v, x) in v.iter().zip(row) {
            *out = v.scale_add::<I>(*x, *out);
        }
    }
    out
}

#[inline(always)]
fn through_back<I: Instructions>(by: &Rigid, point: bool, v: Vector) -> Vector {
    through::<I>(&by.inverse(), point, v)
}

/// A direction, or a point, moved by a joint.
#[inline(always)]
fn joint<I: Instructions>(kind: Joint, [c, s]: &Value, point: bool, v: Vector) -> Vector {
    match kind {
        Joint::Revolute => [s.mul_sub::<I>(v[1], c.times(v[0])), s.mul_add::<I>(v[0], c.times(v[1])), v[2]],
        Joint::Prismatic => [v[0], v[1], if point { v[2].plus(*c) } else { v[2] }],
    }
}

#[inline(always)]
fn joint_back<I: Instructions>(kind: Joint, [c, s]: &Value, point: bool, v: Vector) -> Vector {
    match kind {
        Joint::Revolute => joint::<I>(kind, &[*c, s.negated()], point, v),
        Joint::Prismatic => joint::<I>(kind, &[c.negated(), *s], point, v),
    }
}
