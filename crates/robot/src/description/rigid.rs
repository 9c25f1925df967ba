//! Frames whose decimals are a rotation only up to rounding.

use super::Description;
use super::mjcf::rotation_of;
use crate::geometry::{Rotation, Transform, Vector, nearest_rigid, quaternion};
use denavit_symbolic::{Expr, Rational};

/// What is off by more is no rotation that was rounded.
const ROUNDED: f64 = 1e-5;

impl Description {
    /// The robot with rotations in base and tool where their decimals are some up to rounding; and for each what it is called
    /// and by how much the largest of its entries has moved. What has symbols in it, or is exact, stays as it is.
    pub fn made_rigid(&self) -> (Self, Vec<(&'static str, f64)>) {
        let mut new = self.clone();
        let mut moved = vec![];
        for (what, frame) in [("base", &mut new.base), ("tool", &mut new.tool)] {
            if let Some((rotation, off)) = nearest(&frame.rotation) {
                frame.rotation = rotation;
                moved.push((what, off));
            }
        }
        (new, moved)
    }
}

/// An exact rotation beside one that is rounded, by a quaternion with the digits of doubles, whose matrix is rational; and how
/// far it is away.
fn nearest(rounded: &Rotation<Expr>) -> Option<(Rotation<Expr>, f64)> {
    let is_rational = rounded.rows().as_flattened().iter().all(|e| e.as_number().is_some());
    let is_exact = rounded.inverse() * *rounded == Rotation::identity();
    if !is_rational || is_exact {
        return None;
    }
    let number = |e: Expr| e.eval(|_| None).unwrap_or(f64::NAN);
    let given = Transform::from_rotation_translation(rounded.map(number), Vector::zero());
    let (rigid, _) = nearest_rigid(&given);
    let parts = quaternion(&rigid.rotation).map(Rational::from_f64);
    let [Some(x), Some(y), Some(z), Some(w)] = parts else { return None };
    let exact = rotation_of([&w, &x, &y, &z])?;
    let pairs = exact.rows().into_iter().flatten().zip(given.rotation.rows().into_iter().flatten());
    let off = pairs.map(|(a, b)| (number(a) - b).abs()).fold(0.0, f64::max);
    (off <= ROUNDED).then_some((exact, off))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue;
    use crate::random::Random;

    /// Rotations with some decimals become exact ones, no farther away than they were rounded; exact ones and others stay.
    #[test]
    fn rounded_rotations_become_exact() {
        let mut random = Random(5);
        for decimals in [6, 9, 12, 15] {
            let unit = 10_f64.powi(decimals);
            for _ in 0..20 {
                let parts: [Rational; 4] =
                    std::array::from_fn(|_| Rational::from_f64(random.unit() - 0.5).unwrap_or(Rational::ONE));
                let exact = rotation_of([&parts[0], &parts[1], &parts[2], &parts[3]]).expect("it is not 0");
                let decimal = |e: Expr| {
                    let x = (e.eval(|_| None).unwrap_or(0.0) * unit).round() as i64;
                    Expr::from(Rational::from(x)) / Expr::from(Rational::from(10_i64.pow(decimals as u32)))
                };
                let mut d = catalogue::robot("ur5").expect("it is there");
                d.tool.rotation = exact.map(decimal);
                let (rigid, moved) = d.made_rigid();
                let (what, off) = moved[0];
                assert!(moved.len() == 1 && what == "tool" && off <= 2.0 / unit + 1e-15, "{moved:?}");
                let r = rigid.tool.rotation;
                assert!(r.inverse() * r == Rotation::identity(), "{decimals}");
                assert!(rigid.made_rigid().1.is_empty());
            }
        }
        let mut d = catalogue::robot("ur5").expect("it is there");
        assert!(d.made_rigid().1.is_empty());
        d.tool.rotation = Rotation::identity().map(|e: Expr| e * Expr::int(2));
        assert!(d.made_rigid().1.is_empty());
    }
}
