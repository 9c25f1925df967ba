// Sine and cosine together, without fused multiply-add: the same bits on every machine. Needs reduce.rs.
//
// Reduction after Cody and Waite (1980): n is the integer nearest to |x|·2/π, π/2 is cut into pieces so short that
// n times a piece is exact, and the remainder is kept as r + lo. Then one minimax polynomial each on |r| ≤ π/4, an
// exchange in odd quadrants, and signs by xor. No branch, so that a loop over an array becomes vector code.
// Largest errors found: sine 0.763 ulp, cosine 0.770 ulp (1.4 million arguments, huge ones among them).

/// 2²⁰·π/2. The branch-free functions hold for |x| up to here.
pub const SINCOS_LIMIT: f64 = 1_647_099.329_165_285_5;

const SIGN: u64 = 1 << 63;
/// 1.5·2⁵²: a sum with it is rounded to an integer, which then stands in its low bits.
const ROUND: f64 = 6_755_399_441_055_744.0;
/// π/2, three pieces of at most 33 bits and one of 53.
const HALF_PI_STRICT: [f64; 4] =
    [1.5707963267341256, 6.077100506303966e-11, 2.0222662487111665e-21, 8.4784276603689e-32];
/// sin r = r + r z S(z), z = r²; error 2⁻⁵⁷·⁹.
const SIN: [f64; 6] = [
    -0.1666666666666663,
    0.00833333333332184,
    -0.00019841269829358333,
    2.7557313538085872e-06,
    -2.5050734242904226e-08,
    1.5895419876445903e-10,
];
/// cos r = 1 - z/2 + z² C(z); error 2⁻⁶³·⁸.
const COS: [f64; 6] = [
    0.041666666666666595,
    -0.0013888888888873342,
    2.4801587289002005e-05,
    -2.755731421698574e-07,
    2.0875705384029636e-09,
    -1.1358748258777913e-11,
];

/// Whether the branch-free functions hold. `sin_cos_huge` takes the rest, infinities and NaN.
#[inline(always)]
pub fn sin_cos_in_range(x: f64) -> bool {
    x.abs() <= SINCOS_LIMIT
}

/// (sin x, cos x) if `sin_cos_in_range(x)`; anything otherwise.
#[inline(always)]
pub fn sin_cos_strict(x: f64) -> (f64, f64) {
    let big = x.abs() * core::f64::consts::FRAC_2_PI + ROUND;
    let n = big - ROUND;
    let [p1, p2, p3, p4] = HALF_PI_STRICT;
    // |x| - n p1 - n p2 = head + e exactly; head + d = r + (head - r + d) exactly
    let first = x.abs() - n * p1;
    let head = first - n * p2;
    let d = ((first - head) - n * p2) - n * p3;
    let r = head + d;
    let lo = ((head - r) + d) - n * p4;
    let (s, c) = sin_cos_near_zero(r, lo);
    sin_cos_in_quadrant(big.to_bits(), x, s, c)
}

/// (sin x, cos x) for every x, slowly. NaN for infinities and NaN.
#[cold]
#[inline(never)]
pub fn sin_cos_huge(x: f64) -> (f64, f64) {
    if !x.is_finite() {
        return (f64::NAN, f64::NAN);
    }
    let (n, r, lo) = reduce_huge(x);
    let (s, c) = sin_cos_near_zero(r, lo);
    sin_cos_in_quadrant(u64::from(n), x, s, c)
}

/// (sin(r + lo), cos(r + lo)) for |r| ≤ π/4.
#[inline(always)]
fn sin_cos_near_zero(r: f64, lo: f64) -> (f64, f64) {
    let z = r * r;
    let half = 0.5 * z;
    let w = 1.0 - half;
    let s = ((((SIN[5] * z + SIN[4]) * z + SIN[3]) * z + SIN[2]) * z + SIN[1]) * z + SIN[0];
    let c = ((((COS[5] * z + COS[4]) * z + COS[3]) * z + COS[2]) * z + COS[1]) * z + COS[0];
    // sin(r + lo) = r + lo cos r + r³ S,   cos(r + lo) = w + (rounding error of w) + z² C - r lo
    let s = r + (lo * w + z * r * s);
    let c = w + (((1.0 - w) - half) + (z * z * c - r * lo));
    (s, c)
}

/// (sin x, cos x) from sine and cosine of |x| - n·π/2; the low two bits of `quadrant` are those of n.
#[inline(always)]
fn sin_cos_in_quadrant(quadrant: u64, x: f64, s: f64, c: f64) -> (f64, f64) {
    let odd = quadrant & 1 != 0;
    let (sin, cos) = (if odd { c } else { s }, if odd { s } else { c });
    let sin_sign = (quadrant << 62 ^ x.to_bits()) & SIGN;
    let cos_sign = quadrant.wrapping_add(1) << 62 & SIGN;
    (f64::from_bits(sin.to_bits() ^ sin_sign), f64::from_bits(cos.to_bits() ^ cos_sign))
}
