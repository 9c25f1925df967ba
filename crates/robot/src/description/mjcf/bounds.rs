//! What `<compiler>` says that masses and inertias are at least: `boundmass`, `boundinertia`, `balanceinertia`.

use super::super::tree::Mass;
use super::super::xml::Element;
use super::Mjcf;
use super::bodies::Named;
use crate::description::reader::Reader;
use denavit_symbolic::{Expr, Rational};

/// What no body of a model is below, but for the world.
#[derive(Clone, Default)]
pub(super) struct Bounds {
    /// kg
    mass: Option<Rational>,
    /// Of each principal moment of inertia, kg·m².
    inertia: Option<Rational>,
    /// Whether moments that no body has, one larger than the sum of the others, are all their mean.
    balances: bool,
}

impl Bounds {
    pub fn of(root: Element, reader: &mut Reader) -> Self {
        let mut bounds = Bounds::default();
        for element in root.all("compiler") {
            for (name, bound) in [("boundmass", &mut bounds.mass), ("boundinertia", &mut bounds.inertia)] {
                if let Some(x) = reader.number(&element, name) {
                    *bound = Some(x).filter(|x| !x.is_zero() && !x.is_negative());
                }
            }
            if let Some(text) = element.attribute("balanceinertia") {
                bounds.balances = super::truth(&text, reader).unwrap_or(false);
            }
        }
        bounds
    }
}

impl Mjcf<'_, '_> {
    /// Gives bodies what they weigh at least, as MuJoCo does: first the bounds, then the balance.
    pub(super) fn bound_bodies(&mut self) {
        for number in 1..self.links.bodies.len() {
            let Some(&model) = self.model_of.get(&number).filter(|_| self.named[number] != Named::Site)
            else {
                continue;
            };
            let Bounds { mass: least, inertia, balances } = &self.models[model].bounds;
            let body = &mut self.links.bodies[number];
            let is_bounded = least.is_some() || inertia.is_some();
            if body.is_unweighed || body.mass.is_none() && !is_bounded {
                continue;
            }
            let zero = Expr::int(0);
            let own = body.mass.take();
            let mut mass = own.unwrap_or(Mass { mass: zero, com: [zero; 3], inertia: [zero; 6] });
            if let (Some(least), Ok(now)) = (least, mass.mass.eval(|_| None))
                && now < least.to_f64()
            {
                mass.mass = least.clone().into();
            }
            if let Some(bounded) = bounded(mass.inertia, inertia.as_ref(), *balances) {
                mass.inertia = bounded;
            }
            body.mass = Some(mass);
        }
    }
}

/// An inertia, xx xy xz yy yz zz, with principal moments that are not below a bound, and balanced; nothing where it stays.
fn bounded(inertia: [Expr; 6], least: Option<&Rational>, balances: bool) -> Option<[Expr; 6]> {
    let numbers = inertia.map(|e| e.eval(|_| None).unwrap_or(f64::NAN));
    let (moments, axes) = principal(numbers);
    let bound = least.map_or(0.0, Rational::to_f64);
    let raised = moments.map(|m| if m < bound { bound } else { m });
    let [a, b, c] = raised;
    let is_other = |x: f64, y: f64, z: f64| x + y < z - 1e-15;
    if balances && (is_other(a, b, c) || is_other(b, c, a) || is_other(c, a, b)) {
        let mean = Rational::from_f64((a + b + c) / 3.0)?;
        let (mean, zero) = (Expr::from(mean), Expr::int(0));
        return Some([mean, zero, zero, mean, zero, mean]);
    }
    if raised == moments {
        return None;
    }
    let zero = Expr::int(0);
    if raised.iter().all(|m| *m == bound) {
        let bound = Expr::from(least?.clone());
        return Some([bound, zero, zero, bound, zero, bound]);
    }
    // R·diag·Rᵀ
    let entry = |i: usize, j: usize| -> Option<Expr> {
        let sum: f64 = (0..3).map(|k| axes[i][k] * raised[k] * axes[j][k]).sum();
        Rational::from_f64(sum).map(Expr::from)
    };
    Some([entry(0, 0)?, entry(0, 1)?, entry(0, 2)?, entry(1, 1)?, entry(1, 2)?, entry(2, 2)?])
}

/// The principal moments of an inertia and their axes, which are the columns: turns in the planes of two axes each, by which the
/// product of inertia there is 0, again and again (Jacobi 1846).
fn principal([xx, xy, xz, yy, yz, zz]: [f64; 6]) -> ([f64; 3], [[f64; 3]; 3]) {
    let mut m = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    let mut axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    for _ in 0..12 {
        for (i, j) in [(0, 1), (0, 2), (1, 2)] {
            if m[i][j] == 0.0 {
                continue;
            }
            let half = 0.5 * (m[j][j] - m[i][i]) / m[i][j];
            let t = half.signum() / (half.abs() + half.hypot(1.0));
            let c = 1.0 / t.hypot(1.0);
            let s = t * c;
            let turned = |row: &mut [f64; 3]| {
                (row[i], row[j]) = (c * row[i] - s * row[j], s * row[i] + c * row[j]);
            };
            m.iter_mut().for_each(turned);
            let (a, b) = (m[i], m[j]);
            m[i] = [0, 1, 2].map(|k| c * a[k] - s * b[k]);
            m[j] = [0, 1, 2].map(|k| s * a[k] + c * b[k]);
            axes.iter_mut().for_each(turned);
        }
    }
    ([m[0][0], m[1][1], m[2][2]], axes)
}
