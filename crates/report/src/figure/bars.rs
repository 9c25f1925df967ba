//! Masses in place of those that nobody knows: links as bars, joints as balls.

use super::Arm;
use denavit::description::Description;
use denavit::geometry::{Body, Vector};
use denavit_symbolic::{Expr, Rational};

/// The mass of a bar by its length, kg/m.
pub const BAR: f64 = 1.0;

/// A thin bar between two points.
fn bar(a: Vector<f64>, b: Vector<f64>) -> Body<f64> {
    let way = b - a;
    let mass = BAR * way.norm();
    let spread = |i: usize, j: usize| {
        let along = way[i] * way[j];
        let whole = if i == j { way.dot(way) } else { 0.0 };
        mass / 12.0 * (whole - along)
    };
    let inertia = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)].map(|(i, j)| spread(i, j));
    Body::about_centre(mass, (a + b).scale(0.5), inertia)
}

/// A ball, as heavy as a bar of its width.
fn ball(centre: Vector<f64>, radius: f64) -> Body<f64> {
    let mass = BAR * 2.0 * radius;
    let inertia = 0.4 * mass * radius * radius;
    Body::about_centre(mass, centre, [inertia, 0.0, 0.0, inertia, 0.0, inertia])
}

impl Arm {
    /// The robot with masses as if its links were thin bars of [`BAR`], from each joint to the next as they are drawn, with a ball of
    /// the size of a joint at the beginning of each; what the description says of masses is gone.
    pub fn as_bars(&self, description: &Description) -> Description {
        let mut d = description.clone();
        let (skeleton, radius) = (self.skeleton(), self.layout().unit);
        for row in &mut d.rows {
            (row.mass, row.com, row.inertia) = (None, None, None);
            (row.first_moment, row.inertia_at_origin) = (None, None);
        }
        let number = |x: f64| Rational::from_f64(x).map_or(Expr::int(0), Expr::from);
        for (joint, link) in skeleton.joints.iter().zip(&skeleton.links[1..]) {
            let row = joint.frame - d.convention.axis_frame(0);
            let seen = skeleton.frames[row + 1].inverse();
            let points: Vec<Vector<f64>> = link.iter().map(|p| seen.act_on_point(*p)).collect();
            let bars = points.windows(2).map(|w| bar(w[0], w[1]));
            let whole = bars.fold(ball(seen.act_on_point(joint.end()), radius), |sum, body| sum + body);
            let Some((centre, inertia)) = whole.at_centre() else { continue };
            let row = &mut d.rows[row];
            row.mass = Some(number(whole.mass));
            row.com = Some(centre.0.map(number));
            row.inertia = Some(inertia.map(number));
        }
        d
    }
}
