// Sine and cosine together, with fused multiply-add. Needs reduce.rs and sincos_strict.rs.
//
// The scheme of sincos_strict.rs; a fused product is exact before the subtraction, so π/2 has three pieces. The second
// has 33 bits only: then n times it is a double, and the remainder is exact even where the first difference cancels
// against it. With 53 bits the error near multiples of π/2 reaches thousands of ulp.
// Largest errors found: sine 0.764 ulp, cosine 0.770 ulp (1.4 million arguments).

/// π/2 in pieces of 53, 33 and 53 bits.
const HALF_PI_FUSED: [f64; 3] = [core::f64::consts::FRAC_PI_2, 6.12323399538461e-17, 3.5215598651832e-27];

/// (sin x, cos x) if `sin_cos_in_range(x)`; anything otherwise.
#[inline(always)]
pub fn sin_cos_fused(x: f64) -> (f64, f64) {
    let big = x.abs().mul_add(core::f64::consts::FRAC_2_PI, ROUND);
    let n = big - ROUND;
    let [p1, p2, p3] = HALF_PI_FUSED;
    // |x| - n p1 = a exactly; a - n p2 = r + (a - r - n p2) exactly
    let a = (-n).mul_add(p1, x.abs());
    let r = (-n).mul_add(p2, a);
    let lo = (-n).mul_add(p3, (-n).mul_add(p2, a - r));

    let z = r * r;
    let w = (-0.5_f64).mul_add(z, 1.0);
    let s =
        SIN[5].mul_add(z, SIN[4]).mul_add(z, SIN[3]).mul_add(z, SIN[2]).mul_add(z, SIN[1]).mul_add(z, SIN[0]);
    let c =
        COS[5].mul_add(z, COS[4]).mul_add(z, COS[3]).mul_add(z, COS[2]).mul_add(z, COS[1]).mul_add(z, COS[0]);
    // sin(r + lo) = r + lo cos r + r³ S,   cos(r + lo) = w + (rounding error of w) + z² C - r lo
    let s = r + lo.mul_add(w, z * r * s);
    let c = w + (z * z).mul_add(c, (-r).mul_add(lo, (-0.5_f64).mul_add(z, 1.0 - w)));
    sin_cos_in_quadrant(big.to_bits(), x, s, c)
}
