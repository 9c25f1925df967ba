//! `<inertial>`: a body's mass, its centre, its inertia.

use super::reader::Reader;
use super::tree::Mass;
use super::xml::Element;
use crate::geometry::{Rotation, Transform};
use denavit_symbolic::{Expr, Rational};
use std::ops::Range;

impl Reader {
    /// The mass of a URDF's link in its frame; nothing where it is not complete, which is said.
    pub fn mass(&mut self, inertial: Element) -> Option<Mass> {
        self.known(inertial, &["origin", "mass", "inertia"]);
        let origin = inertial.one("origin", &mut self.out);
        let origin = self.origin(origin);
        let mass = inertial.one("mass", &mut self.out).and_then(|m| self.number(&m, "value"));
        let inertia = inertial.one("inertia", &mut self.out);
        let names = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"];
        let entries = inertia.map(|e| names.map(|n| self.number(&e, n)));
        let (Some(mass), Some([Some(xx), Some(xy), Some(xz), Some(yy), Some(yz), Some(zz)])) =
            (mass.clone(), &entries)
        else {
            // What is there and no number was said.
            let is_given = |e: Option<Element>, n: &str| e.is_some_and(|e| e.attribute(n).is_some());
            let weight = inertial.all("mass").next();
            let entries: Vec<&str> =
                names.iter().filter(|n| inertia.is_some() && !is_given(inertia, n)).copied().collect();
            let missing = match (inertia, &entries[..]) {
                (None, _) => "no <inertia>".into(),
                _ if !is_given(weight, "value") => "no <mass value=\"…\"/>".into(),
                (_, [only]) => format!("no `{only}` in <inertia>"),
                (_, [all @ .., last]) => format!("no `{}` and `{last}` in <inertia>", all.join("`, `")),
                (_, []) => return None,
            };
            self.out.warning(inertial.span(), format!("<inertial> has {missing}: it is left"));
            return None;
        };
        let [xx, xy, xz, yy, yz, zz] = [xx, xy, xz, yy, yz, zz].map(Rational::clone);
        let entries = [xx, xy, xz, yy, yz, zz];
        self.say_inertia(&mass, &entries, inertial.span());
        Some(Mass::about(mass, &origin, entries))
    }

    /// Warns of a mass and an inertia (xx xy xz yy yz zz) that no body has.
    pub fn say_inertia(&mut self, mass: &Rational, inertia: &[Rational; 6], span: Range<usize>) {
        let [a, b, c, d, e, f] = [0, 1, 2, 3, 4, 5].map(|k| inertia[k].to_f64());
        let minor = a * d - b * b;
        let volume = a * (d * f - e * e) - b * (b * f - e * c) + c * (b * e - d * c);
        if mass.is_negative() {
            self.out.warning(span, "the mass is negative");
        } else if !mass.is_zero() && (a <= 0.0 || minor <= 0.0 || volume <= 0.0) {
            self.out.warning(span, "the inertia is not positive definite");
        } else if a > d + f || d > a + f || f > a + d {
            self.out
                .warning(span, "no body has this inertia")
                .hint("of ixx, iyy and izz none is larger than the sum of the others");
        }
    }
}

impl Mass {
    /// A mass in a body's frame, its centre and the axes of its inertia (xx xy xz yy yz zz) being a frame there.
    pub(super) fn about(mass: Rational, frame: &Transform<Expr>, inertia: [Rational; 6]) -> Self {
        let inertia = turned(frame.rotation, inertia.map(Expr::from));
        Mass { mass: mass.into(), com: frame.translation.0, inertia }
    }
}

/// An inertia, xx xy xz yy yz zz, along other axes: R I Rᵀ.
pub(super) fn turned(r: Rotation<Expr>, [xx, xy, xz, yy, yz, zz]: [Expr; 6]) -> [Expr; 6] {
    let tensor = Rotation::from_rows([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]);
    let m = (r * tensor * r.inverse()).rows();
    [m[0][0], m[0][1], m[0][2], m[1][1], m[1][2], m[2][2]]
}
