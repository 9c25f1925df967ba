/// The square root.
#[cfg(feature = "std")]
#[inline(always)]
pub fn sqrt(x: f64) -> f64 {
    x.sqrt()
}

/// The square root, correctly rounded, in integers.
#[cfg(not(feature = "std"))]
pub fn sqrt(x: f64) -> f64 {
    if x < 0.0 || x.is_nan() {
        return f64::NAN;
    }
    if x == 0.0 || x.is_infinite() {
        return x;
    }
    // x = m·2^e, and m·2^shift has 110 or 111 bits, so that its root has at least 55.
    let bits = x.to_bits();
    let (fraction, exponent) = (bits & ((1 << 52) - 1), (bits >> 52) as i32);
    let m = if exponent == 0 { fraction } else { fraction | 1 << 52 };
    let e = exponent.max(1) - 1075;
    let shift = 46 + m.leading_zeros() as i32;
    let shift = shift + ((e - shift) & 1);
    let m = u128::from(m) << shift;
    let root = m.isqrt();
    // What is cut off shows in the last bit, so that the conversion rounds as it should.
    let sticky = u64::from(root * root != m);
    let power = f64::from_bits(((1023 + (e - shift) / 2) as u64) << 52);
    (root as u64 | sticky) as f64 * power
}

