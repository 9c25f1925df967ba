/// atan2(y, x) for every pair.
#[inline(always)]
pub fn atan2(y: f64, x: f64) -> f64 {
    if atan2_in_range(y, x) {
        near_atan2(y, x)
    } else {
        atan2_rare(y, x)
    }
}

