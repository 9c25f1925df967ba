//! A robot with the masses that were found, as a description.

use crate::consistent::Consistent;
use crate::model::Model;
use denavit::description::Description;
use denavit::robot::Robot;
use denavit_symbolic::{Expr, Rational};

/// Digits of the numbers that are written.
const DIGITS: i32 = 9;

/// Why masses have no place in a table.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum NoPlace {
    /// Two links move in this row, from 0: it turns and slides.
    TwoInOne(usize),
    /// Rows have no values.
    NoValues,
}

/// The robot with these links, rotors and frictions, each link's mass in the frame of its row; offsets have no place.
///
/// # Errors
/// If a row has two links.
pub fn described(d: &Description, model: &Model, found: &Consistent) -> Result<Description, NoPlace> {
    let robot = Robot::numeric(d).map_err(|_| NoPlace::NoValues)?;
    let mut all = d.clone();
    for row in &mut all.rows {
        (row.mass, row.com, row.inertia, row.first_moment, row.inertia_at_origin) =
            (None, None, None, None, None);
        (row.rotor, row.viscous, row.coulomb) = (None, None, None);
    }
    for (link, body) in model.arm.links.iter().zip(&found.bodies) {
        let row = &mut all.rows[link.row];
        if row.mass.is_some() {
            return Err(NoPlace::TwoInOne(link.row));
        }
        // The row's frame stands behind its motion.
        let own = body.seen_from(&robot.links[link.row].after.inverse());
        let Some((centre, inertia)) = own.at_centre() else { continue };
        // What is 0 by rounding is so by the size of the body.
        let size = inertia.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        row.mass = Some(number(own.mass, 0.0));
        row.com = Some(centre.0.map(|x| number(x, 1e-12 * model.size())));
        row.inertia = Some(inertia.map(|x| number(x, 1e-13 * size)));
    }
    for (j, v) in d.variables().iter().enumerate() {
        let row = all.rows.iter_mut().find(|r| r.variable.is_some_and(|own| own.symbol == v.symbol));
        let (Some(row), drive) = (row, found.drives[j]) else { continue };
        let some = |x: f64| (x != 0.0).then(|| number(x, 0.0));
        (row.rotor, row.viscous, row.coulomb) = (some(drive.rotor), some(drive.viscous), some(drive.coulomb));
    }
    let g = model.arm.gravity;
    if d.gravity.is_none() && (g.0 != [0.0, 0.0, -9.81]) {
        all.gravity = Some(g.0.map(|x| number(x, 0.0)));
    }
    Ok(all)
}

/// A number with as many digits as are written, as a decimal.
fn number(x: f64, noise: f64) -> Expr {
    if x.abs() <= noise || !x.is_finite() {
        return Expr::int(0);
    }
    let digits = format!("{x:.*e}", (DIGITS - 1) as usize);
    let exact = Rational::from_decimal(&digits).or_else(|| Rational::from_f64(x));
    exact.map_or_else(|| Expr::int(0), Expr::from)
}
