// The angle of the point (x, y), with fused multiply-add. Needs atan2_strict.rs, whose scheme it follows.
// Largest error found: 1.55 ulp (1.8 million points), near y/x = 1/2; mean 0.14 ulp.

/// atan2(y, x) if `atan2_in_range(y, x)`; anything else otherwise.
#[inline(always)]
pub fn atan2_fused(y: f64, x: f64) -> f64 {
    let (t, hi, lo) = atan2_from_nearest(y, x);
    let z = t * t;
    let a = ATAN[11].mul_add(z, ATAN[10]).mul_add(z, ATAN[9]).mul_add(z, ATAN[8]).mul_add(z, ATAN[7]);
    let a =
        a.mul_add(z, ATAN[6]).mul_add(z, ATAN[5]).mul_add(z, ATAN[4]).mul_add(z, ATAN[3]).mul_add(z, ATAN[2]);
    let a = a.mul_add(z, ATAN[1]).mul_add(z, ATAN[0]);
    // hi + t = sum + (rounding error) exactly, since hi = 0 or |t| < hi
    let sum = hi + t;
    let angle = sum + (((hi - sum) + t) + (t * z).mul_add(a, lo));
    angle.copysign(y)
}
