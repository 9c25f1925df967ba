// Reduction of huge arguments modulo π/2, in integers (Payne and Hanek 1983).
//
// |x| = m·2^e with an integer m of 53 bits. Bits of 2/π whose product with 2^e is a multiple of 4 change no quadrant and
// are skipped; the next 192 give |x|·2/π mod 4 with an error below 2⁻¹³⁷. No double comes closer to a multiple of π/2
// than 2⁻⁶¹, so at least 75 bits of the remainder are right. It is multiplied by π/2 in 128 bits and returned
// as a sum of two doubles.

/// 64 bits of 0, then 2/π behind the binary point.
const TWO_OVER_PI: [u64; 20] = [
    0,
    0xa2f9_836e_4e44_1529,
    0xfc27_57d1_f534_ddc0,
    0xdb62_9599_3c43_9041,
    0xfe51_63ab_debb_c561,
    0xb724_6e3a_424d_d2e0,
    0x0649_2eea_09d1_921c,
    0xfe1d_eb1c_b129_a73e,
    0xe882_35f5_2ebb_4484,
    0xe99c_7026_b45f_7e41,
    0x3991_d639_8353_39f4,
    0x9c84_5f8b_bdf9_283b,
    0x1ff8_97ff_de05_980f,
    0xef2f_118b_5a0a_6d1f,
    0x6d36_7ecf_27cb_09b7,
    0x4f46_3f66_9e5f_ea2d,
    0x7527_bac7_ebe5_f17b,
    0x3d07_39f7_8a52_92ea,
    0x6bfb_5fb1_1f8d_5d08,
    0x5603_3046_fc7b_6bab,
];
/// π/2·2¹²⁷.
const HALF_PI_BITS: u128 = 0xc90f_daa2_2168_c234_c4c6_628b_80dc_1cd1;

/// The quadrant n mod 4, r and lo with |x| = n·π/2 + r + lo, |r| ≤ π/4 and |lo| ≤ ulp(r)/2, for every finite x.
#[cold]
#[inline(never)]
pub fn reduce_huge(x: f64) -> (u32, f64, f64) {
    let bits = x.abs().to_bits();
    let exponent = (bits >> 52) as i32 - 1075;
    if exponent < -53 {
        return (0, x.abs(), 0.0); // below 1/2
    }
    let m = u128::from((bits & ((1 << 52) - 1)) | 1 << 52);

    // 192 bits of 2/π, the first of them of weight 2 in the product with 2^e.
    let first = (exponent + 62) as usize;
    let window = |k: usize| {
        let [high, low] = [TWO_OVER_PI[first / 64 + k], TWO_OVER_PI[first / 64 + k + 1]].map(u128::from);
        low_half((high << 64 | low) >> (64 - first % 64))
    };
    let low = m * window(2);
    let middle = m * window(1) + (low >> 64);
    let high = m * window(0) + (middle >> 64);
    let (low, middle, high) = (low as u64, middle as u64, high as u64);

    // high:middle:low·2⁻¹⁹⁰ = |x|·2/π mod 4. The nearest integer n, and the fraction, whose first bit is its sign.
    let n = (high.wrapping_add(1 << 61) >> 62) as u32;
    let fraction = u128::from(high) << 66 | u128::from(middle) << 2 | u128::from(low >> 62);
    let negative = fraction >> 127 != 0;
    let (fraction, tail) = if negative { (!fraction, !low << 2) } else { (fraction, low << 2) };

    // f = fraction·2^zeros in [1/2, 1), times π/2.
    let zeros = fraction.leading_zeros();
    let f = fraction << zeros | u128::from(tail >> (64 - zeros));
    let (f_high, f_low) = (f >> 64, low_half(f));
    let (p_high, p_low) = (HALF_PI_BITS >> 64, low_half(HALF_PI_BITS));
    let product = f_high * p_high + ((f_high * p_low) >> 64) + ((f_low * p_high) >> 64);

    // product·2^(-127 - zeros), as its first 53 bits and the 64 behind them.
    let power = |k: u32| f64::from_bits(u64::from(1023 - k) << 52); // 2^-k
    let head = (product >> 75) as f64 * power(52 + zeros);
    let rest = (product >> 11) as u64 as f64 * power(116 + zeros);
    let r = head + rest;
    let lo = (head - r) + rest;
    if negative { (n, -r, -lo) } else { (n, r, lo) }
}

fn low_half(v: u128) -> u128 {
    v & u128::from(u64::MAX)
}
