/// (sin x, cos x) for every x.
#[inline(always)]
pub fn sin_cos(x: f64) -> (f64, f64) {
    if sin_cos_in_range(x) {
        near_sin_cos(x)
    } else {
        sin_cos_huge(x)
    }
}

