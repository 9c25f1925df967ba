//! Quadratic splines x(τ), continuous with their first derivative.
//!
//! Interval i has the control points x(τᵢ), cᵢ₊₁, x(τᵢ₊₁); c₀ and the last c are the values at the ends. At an inner
//! grid point between intervals of the lengths h and k the derivative is continuous if x = (k c + h c') / (h + k).

/// A quadratic spline.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Spline {
    /// Grid points.
    pub(super) grid: Vec<f64>,
    /// Control points: two more than intervals.
    pub(super) c: Vec<f64>,
}

/// Linear forms in three neighbouring control points.
pub(super) type Form = [f64; 3];

/// x, u = x'/2 and u' at a point of interval `i`, as forms in `c[i]`, `c[i + 1]`, `c[i + 2]`; `place` is 0 at the start
/// of the interval and 1 at its end.
pub(super) fn forms(grid: &[f64], i: usize, place: f64) -> [Form; 3] {
    let n = grid.len() - 1;
    let h = grid[i + 1] - grid[i];
    let before = if i == 0 { 0.0 } else { grid[i] - grid[i - 1] };
    let behind = if i + 1 == n { 0.0 } else { grid[i + 2] - grid[i + 1] };
    // Control points of the interval.
    let b0 = [h / (before + h), before / (before + h), 0.0];
    let b2 = [0.0, behind / (behind + h), h / (behind + h)];
    let b1 = [0.0, 1.0, 0.0];
    let (t, r) = (place, 1.0 - place);
    let combine = |w: [f64; 3]| std::array::from_fn(|k| w[0] * b0[k] + w[1] * b1[k] + w[2] * b2[k]);
    [
        combine([r * r, 2.0 * t * r, t * t]),
        combine([-r / h, (r - t) / h, t / h]),
        combine([1.0 / (h * h), -2.0 / (h * h), 1.0 / (h * h)]),
    ]
}

impl Spline {
    /// Slows the motion down by a factor.
    pub(super) fn slow(&mut self, factor: f64) {
        self.c.iter_mut().for_each(|c| *c *= factor.powi(-2));
    }

    /// x, u = x'/2 and u' at a point of interval `i`.
    pub(super) fn at(&self, i: usize, place: f64) -> [f64; 3] {
        let c = &self.c[i..i + 3];
        forms(&self.grid, i, place).map(|f| f[0] * c[0] + f[1] * c[1] + f[2] * c[2])
    }
}
