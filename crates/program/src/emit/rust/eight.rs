/// Sines and cosines of eight angles, whatever they are.
#[inline(always)]
pub fn sin_cos_8(x: [f64; 8]) -> ([f64; 8], [f64; 8]) {
    let (mut s, mut c) = ([0.0; 8], [0.0; 8]);
    let mut in_range = true;
    for i in 0..8 {
        (s[i], c[i]) = near_sin_cos(x[i]);
        in_range &= sin_cos_in_range(x[i]);
    }
    if !in_range {
        // By value: an array whose address is taken goes through memory in the common case too.
        let [x0, x1, x2, x3, x4, x5, x6, x7] = x;
        return one_by_one(x0, x1, x2, x3, x4, x5, x6, x7);
    }
    (s, c)
}

#[cold]
#[inline(never)]
#[allow(clippy::too_many_arguments)]
fn one_by_one(
    x0: f64,
    x1: f64,
    x2: f64,
    x3: f64,
    x4: f64,
    x5: f64,
    x6: f64,
    x7: f64,
) -> ([f64; 8], [f64; 8]) {
    let pairs = [x0, x1, x2, x3, x4, x5, x6, x7].map(sin_cos);
    (pairs.map(|pair| pair.0), pairs.map(|pair| pair.1))
}

