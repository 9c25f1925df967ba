//! How far the tool point comes: extremes of coordinates and distances, found by Newton's method within the ranges.

use super::arm::Arm;
use super::section::Section;
use crate::geometry::Vector;

/// How far the tool point comes, metres; polished, not read off the grid.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Extremes {
    /// The least and the largest first coordinate: the distance ρ from the axis, or what [`Section::symbols`] says.
    pub first: [f64; 2],
    /// The least and the largest second coordinate: the height along the axis, or what [`Section::symbols`] says.
    pub second: [f64; 2],
    /// The largest distance from [`Extremes::shoulder`].
    pub from_shoulder: Option<f64>,
    /// The point of the first axis that turns which is nearest to the next axis, in the base; none if they are parallel
    /// or a slide carries it. For an arm in a plane where its first axis stands.
    pub shoulder: Option<Vector<f64>>,
}

/// What is to become large.
#[derive(Clone, Copy)]
pub(super) enum Objective {
    /// The first coordinate or its opposite; a distance from an axis is squared.
    First(f64),
    /// The second coordinate or its opposite.
    Second(f64),
    /// The square of the distance from a point.
    From(Vector<f64>),
}

impl Objective {
    /// The value where the tool point is, and its gradient by the point.
    pub fn value(self, section: &Section, p: Vector<f64>) -> (f64, Vector<f64>) {
        let at = section.coordinates(p);
        match (self, section) {
            (Objective::First(sign), Section::ThroughAxis { point, direction, .. }) => {
                let r = p - *point;
                (sign * at[0] * at[0], (r - direction.scale(at[1])).scale(2.0 * sign))
            }
            (Objective::First(sign), _) => (sign * at[0], section.rows(p)[0].scale(sign)),
            (Objective::Second(sign), _) => (sign * at[1], section.rows(p)[1].scale(sign)),
            (Objective::From(s), _) => ((p - s).dot(p - s), (p - s).scale(2.0)),
        }
    }
}

/// Newton steps to an extreme.
const STEPS: usize = 40;

/// Moves a configuration uphill within the ranges until it is highest there: damped Newton steps on the joints that are not
/// at an end; the Hessian by differences of the gradient. The value.
pub(super) fn climb(arm: &mut Arm, objective: Objective, q: &mut Vec<f64>) -> f64 {
    let n = q.len();
    let unit: Vec<f64> = arm.weights.iter().map(|w| w.sqrt()).collect();
    let mut gradient = vec![0.0; n];
    let mut value = gradient_at(arm, objective, q, &unit, &mut gradient);
    let mut damping: Option<f64> = None;
    for _ in 0..STEPS {
        let size = value.abs().max(1e-3 * arm.length * arm.length);
        let is_free = |j: usize| {
            let (r, g) = (arm.ranges[j], gradient[j]);
            unit[j] > 0.0 && (r.is_endless || !(q[j] <= r.low && g < 0.0 || q[j] >= r.high && g > 0.0))
        };
        let free: Vec<usize> = (0..n).filter(|&j| is_free(j)).collect();
        if free.iter().all(|&j| gradient[j].abs() <= 1e-13 * size) {
            break;
        }
        // −H, a row a free joint.
        let mut minus: Vec<Vec<f64>> = vec![];
        let mut beside = vec![0.0; n];
        for &j in &free {
            let mut moved = q.clone();
            moved[j] += 1e-6 * unit[j];
            gradient_at(arm, objective, &moved, &unit, &mut beside);
            minus.push(free.iter().map(|&i| (gradient[i] - beside[i]) / 1e-6).collect());
        }
        let mut mu = damping.unwrap_or(1e-3 * size);
        let mut is_better = false;
        for _ in 0..12 {
            let right: Vec<f64> = free.iter().map(|&j| gradient[j]).collect();
            let step = solve(&minus, mu, right);
            if let Some(step) = step {
                let mut moved = q.clone();
                for (&j, s) in free.iter().zip(&step) {
                    moved[j] += s.clamp(-0.7, 0.7) * unit[j];
                }
                arm.clamp(&mut moved);
                let there = gradient_at(arm, objective, &moved, &unit, &mut beside);
                if there > value {
                    is_better = there - value > 1e-15 * size;
                    value = there;
                    *q = moved;
                    gradient.copy_from_slice(&beside);
                    mu *= 0.05;
                    break;
                }
            }
            mu = (mu * 8.0).max(1e-9 * size);
        }
        damping = Some(mu);
        if !is_better {
            break;
        }
    }
    value
}

/// The value at a configuration, and its gradient by the joints in their units.
fn gradient_at(arm: &mut Arm, objective: Objective, q: &[f64], unit: &[f64], gradient: &mut [f64]) -> f64 {
    arm.walk.to(q);
    let (value, by_point) = objective.value(&arm.section, arm.walk.point);
    for ((g, c), u) in gradient.iter_mut().zip(&arm.walk.columns).zip(unit) {
        *g = by_point.dot(*c) * u;
    }
    value
}

/// The solution of (A + μ)·x = b for a symmetric A, by Cholesky's factors; none where A + μ is not positive.
fn solve(a: &[Vec<f64>], mu: f64, mut b: Vec<f64>) -> Option<Vec<f64>> {
    let n = b.len();
    let mut l = vec![vec![0.0; n]; n];
    for i in 0..n {
        for j in 0..=i {
            let symmetric = f64::midpoint(a[i][j], a[j][i]) + if i == j { mu } else { 0.0 };
            let rest = symmetric - (0..j).map(|k| l[i][k] * l[j][k]).sum::<f64>();
            if i == j {
                if rest <= 0.0 || !rest.is_finite() {
                    return None;
                }
                l[i][i] = rest.sqrt();
            } else {
                l[i][j] = rest / l[j][j];
            }
        }
    }
    for i in 0..n {
        b[i] = (b[i] - (0..i).map(|k| l[i][k] * b[k]).sum::<f64>()) / l[i][i];
    }
    for i in (0..n).rev() {
        b[i] = (b[i] - (i + 1..n).map(|k| l[k][i] * b[k]).sum::<f64>()) / l[i][i];
    }
    Some(b)
}
