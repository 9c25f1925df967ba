//! `<inertial>`: a link's mass, its centre, its inertia.

use crate::description::reader::Reader;
use crate::description::tree::Mass;
use crate::description::xml::Element;
use crate::geometry::Rotation;
use denavit_symbolic::Expr;

impl Reader {
    /// The mass of a link in its frame; nothing where it is not complete, which is said.
    pub(super) fn mass(&mut self, inertial: Element) -> Option<Mass> {
        self.known(inertial, &["origin", "mass", "inertia"]);
        let origin = inertial.one("origin", &mut self.out);
        let origin = self.origin(origin);
        let mass = inertial.one("mass", &mut self.out).and_then(|m| self.number(&m, "value"));
        let inertia = inertial.one("inertia", &mut self.out);
        let names = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"];
        let entries = inertia.map(|e| names.map(|n| self.number(&e, n)));
        let (Some(mass), Some([Some(xx), Some(xy), Some(xz), Some(yy), Some(yz), Some(zz)])) =
            (mass, entries)
        else {
            self.out.warning(inertial.span(), "the inertia is not complete, and is left");
            return None;
        };
        let [a, b, c, d, e, f] = [&xx, &xy, &xz, &yy, &yz, &zz].map(|x| x.to_f64());
        let minor = a * d - b * b;
        let volume = a * (d * f - e * e) - b * (b * f - e * c) + c * (b * e - d * c);
        if mass.is_negative() {
            self.out.warning(inertial.span(), "the mass is negative");
        } else if !mass.is_zero() && (a <= 0.0 || minor <= 0.0 || volume <= 0.0) {
            self.out.warning(inertial.span(), "the inertia is not positive definite");
        } else if a > d + f || d > a + f || f > a + d {
            self.out
                .warning(inertial.span(), "no body has this inertia")
                .hint("of ixx, iyy and izz none is larger than the sum of the others");
        }
        // I' = R I Rᵀ
        let [xx, xy, xz, yy, yz, zz] = [xx, xy, xz, yy, yz, zz].map(Expr::from);
        let tensor = Rotation::from_rows([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]);
        let m = (origin.rotation * tensor * origin.rotation.inverse()).rows();
        Some(Mass {
            mass: mass.into(),
            com: origin.translation.0,
            inertia: [m[0][0], m[0][1], m[0][2], m[1][1], m[1][2], m[2][2]],
        })
    }
}
