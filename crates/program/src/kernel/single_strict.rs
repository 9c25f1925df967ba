// The kernels in single precision, without fused multiply-add. Needs reduce.rs, sincos_strict.rs, atan2_strict.rs.
//
// The schemes of those files with fewer pieces and coefficients. What is out of range is computed in double.
// Largest errors: sine 0.794 ulp, cosine 0.800 ulp (every argument in range); atan2 1.55 ulp (1.8 million points).

/// 2¹²·π/2. The branch-free functions hold for |x| up to here.
pub const SINCOS_LIMIT_F32: f32 = 6433.982;

const SIGN_F32: u32 = 1 << 31;
/// 1.5·2²³: a sum with it is rounded to an integer, which then stands in its low bits.
const ROUND_F32: f32 = 12_582_912.0;
/// π/2, three pieces of 12 bits and one of 24.
const HALF_PI_STRICT_F32: [f32; 4] = [1.570_800_8, -4.4535846e-06, -8.706138e-10, 6.223372e-14];
/// sin r = r + r z S(z), z = r²; error 2⁻²⁷·⁹.
const SIN_F32: [f32; 3] = [-0.16666655, 0.008332187, -0.00019517895];
/// cos r = 1 - z/2 + z² C(z); error 2⁻³³.
const COS_F32: [f32; 3] = [0.041666646, -0.001388731, 2.4432326e-05];
/// 0, π/2, π, π/4, 3π/4: the numbers, and what they lack.
const NEAREST_F32: [f32; 5] =
    [0.0, core::f32::consts::FRAC_PI_2, core::f32::consts::PI, core::f32::consts::FRAC_PI_4, 2.3561945];
const NEAREST_LO_F32: [f32; 5] = [0.0, -4.371139e-08, -8.742278e-08, -2.1855694e-08, -5.9624403e-09];
/// atan t = t + t z A(z), z = t²; error 2⁻²⁷·⁵.
const ATAN_F32: [f32; 5] = [-0.33333233, 0.19994166, -0.14174175, 0.10155528, -0.051243987];

/// Whether the branch-free functions hold. `sin_cos_huge_f32` takes the rest.
#[inline(always)]
pub fn sin_cos_in_range_f32(x: f32) -> bool {
    x.abs() <= SINCOS_LIMIT_F32
}

/// (sin x, cos x) if `sin_cos_in_range_f32(x)`; anything otherwise.
#[inline(always)]
pub fn sin_cos_strict_f32(x: f32) -> (f32, f32) {
    let big = x.abs() * core::f32::consts::FRAC_2_PI + ROUND_F32;
    let n = big - ROUND_F32;
    let [p1, p2, p3, p4] = HALF_PI_STRICT_F32;
    let first = x.abs() - n * p1;
    let head = first - n * p2;
    let d = ((first - head) - n * p2) - n * p3;
    let r = head + d;
    let lo = ((head - r) + d) - n * p4;

    let z = r * r;
    let half = 0.5 * z;
    let w = 1.0 - half;
    let s = (SIN_F32[2] * z + SIN_F32[1]) * z + SIN_F32[0];
    let c = (COS_F32[2] * z + COS_F32[1]) * z + COS_F32[0];
    let s = r + (lo * w + z * r * s);
    let c = w + (((1.0 - w) - half) + (z * z * c - r * lo));
    sin_cos_in_quadrant_f32(big.to_bits(), x, s, c)
}

/// (sin x, cos x) for every x, slowly. NaN for infinities and NaN.
#[cold]
#[inline(never)]
pub fn sin_cos_huge_f32(x: f32) -> (f32, f32) {
    let (s, c) = sin_cos_huge(f64::from(x));
    (s as f32, c as f32)
}

/// (sin x, cos x) from sine and cosine of |x| - n·π/2; the low two bits of `quadrant` are those of n.
#[inline(always)]
fn sin_cos_in_quadrant_f32(quadrant: u32, x: f32, s: f32, c: f32) -> (f32, f32) {
    let odd = quadrant & 1 != 0;
    let (sin, cos) = (if odd { c } else { s }, if odd { s } else { c });
    let sin_sign = (quadrant << 30 ^ x.to_bits()) & SIGN_F32;
    let cos_sign = quadrant.wrapping_add(1) << 30 & SIGN_F32;
    (f32::from_bits(sin.to_bits() ^ sin_sign), f32::from_bits(cos.to_bits() ^ cos_sign))
}

/// Whether the branch-free functions hold: |x| + |y| is 0 or from 1e-30 to 1e30. `atan2_rare_f32` takes the rest.
#[inline(always)]
pub fn atan2_in_range_f32(y: f32, x: f32) -> bool {
    let size = x.abs() + y.abs();
    (size == 0.0) | (1e-30..=1e30).contains(&size)
}

/// atan2(y, x) if `atan2_in_range_f32(y, x)`; anything else otherwise.
#[inline(always)]
pub fn atan2_strict_f32(y: f32, x: f32) -> f32 {
    let (t, hi, lo) = atan2_from_nearest_f32(y, x);
    let z = t * t;
    let a = (((ATAN_F32[4] * z + ATAN_F32[3]) * z + ATAN_F32[2]) * z + ATAN_F32[1]) * z + ATAN_F32[0];
    let sum = hi + t;
    let angle = sum + (((hi - sum) + t) + (lo + t * z * a));
    angle.copysign(y)
}

/// atan2(y, x) for every pair, slowly: through double precision.
#[cold]
#[inline(never)]
pub fn atan2_rare_f32(y: f32, x: f32) -> f32 {
    let (y, x) = (f64::from(y), f64::from(x));
    (if atan2_in_range(y, x) { atan2_strict(y, x) } else { atan2_rare(y, x) }) as f32
}

/// t, hi and lo with atan2(|y|, x) = hi + lo + atan t.
#[inline(always)]
fn atan2_from_nearest_f32(y: f32, x: f32) -> (f32, f32, f32) {
    let (ay, ax) = (y.abs(), x.abs());
    let (steep, left) = (ay > ax, x.is_sign_negative());
    let small = if steep { ax } else { ay };
    let large = if steep { ay } else { ax };
    let diagonal = small + small > large;
    let above = if diagonal { small - large } else { small };
    let below = if diagonal { small + large } else { large };
    let below = if below == 0.0 { 1.0 } else { below };
    let above = if steep { -above } else { above };
    let above = if left { -above } else { above };

    let pick = |[right, up, back, first, second]: [f32; 5]| {
        let axis = if left { back } else { right };
        let axis = if steep { up } else { axis };
        let slope = if left { second } else { first };
        if diagonal { slope } else { axis }
    };
    (above / below, pick(NEAREST_F32), pick(NEAREST_LO_F32))
}
