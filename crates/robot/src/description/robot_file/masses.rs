//! What a row says of its link's mass and its joint's drive.

use super::fields::{Fields, Reader};
use super::joints::number;
use super::{Quantity, Style};
use crate::description::value::quantity_of_key;
use crate::description::{JointKind, Row};
use crate::geometry::NoBody;
use denavit_symbolic::Expr;
use std::ops::Range;
use toml::Spanned;
use toml::de::DeValue;

/// What a body cannot be, and what would help.
pub(in crate::description) fn no_body(why: NoBody) -> (&'static str, Option<&'static str>) {
    match why {
        NoBody::NotFinite => ("a number is not finite", None),
        NoBody::NegativeMass => ("the mass is negative", None),
        NoBody::NoMass => ("no body has this: its mass is 0, and the rest is not", Some("give its mass")),
        NoBody::NotPositive => ("no body has this: the inertia about the centre of mass is not positive", {
            Some("products of inertia have the sign of the tensor, XY = −∫xy dm")
        }),
        NoBody::Triangle => ("no body has this inertia", {
            Some("of the moments about its principal axes none is larger than the sum of the others")
        }),
    }
}

impl Reader<'_> {
    /// Reads mass, centre and inertia, or first moment and inertia about the origin, and the drive.
    pub fn masses(&mut self, fields: &Fields, row: &mut Row, names: &[String]) {
        let get = |key| fields.get(key);
        row.mass = get("mass").and_then(|v| self.not_negative(v, Quantity::Mass, "the mass", names));
        row.com = get("com").and_then(|v| self.constants(v, "com", names));
        row.inertia = get("inertia").and_then(|v| self.constants(v, "inertia", names));
        row.first_moment = get("first_moment").and_then(|v| self.constants(v, "first_moment", names));
        row.inertia_at_origin =
            get("inertia_at_origin").and_then(|v| self.constants(v, "inertia_at_origin", names));
        let twice = [("com", "first_moment"), ("inertia", "inertia_at_origin"), ("inertia", "first_moment")];
        for (one, other) in twice {
            if let (Some(_), Some(value)) = (get(one), get(other)) {
                self.out.error(value.span(), format!("`{other}` beside `{one}`")).hint(
                    "mass, com, inertia (about the centre of mass), or mass, first_moment, inertia_at_origin",
                );
            }
        }
        self.check_body(fields, row);
        let slides = row.variable.is_some_and(|v| v.kind == JointKind::Prismatic);
        let [rotor, viscous, coulomb] = ["rotor", "viscous", "coulomb"].map(|key| {
            let value = get(key)?;
            if row.variable.is_none() {
                self.out
                    .error(value.span(), format!("`{key}` of a row without a joint variable"))
                    .hint("a drive belongs to the row in which its joint variable first stands");
            }
            self.not_negative(value, quantity_of_key(key, slides), key, names)
        });
        (row.rotor, row.viscous, row.coulomb) = (rotor, viscous, coulomb);
    }

    /// Warns of what no body has, where all is given in numbers.
    fn check_body(&mut self, fields: &Fields, row: &Row) {
        let Some(body) = row.body() else { return };
        if body.parameters().iter().any(|e| !e.symbols().is_empty()) {
            return;
        }
        let at = ["inertia_at_origin", "inertia", "first_moment", "com", "mass"];
        let span: Option<Range<usize>> = at.into_iter().find_map(|key| Some(fields.get(key)?.span()));
        if let (Err(why), Some(span)) = (body.map(number).check(), span)
            && why != NoBody::NegativeMass
        {
            let (message, hint) = no_body(why);
            let name = row.name.as_ref().map_or(String::new(), |n| format!("`{n}`: "));
            let found = self.out.warning(span, format!("{name}{message}"));
            if let Some(hint) = hint {
                found.hint(hint);
            }
        }
    }

    fn not_negative(
        &mut self,
        value: &Spanned<DeValue>,
        quantity: Quantity,
        what: &str,
        names: &[String],
    ) -> Option<Expr> {
        let cell = self.cell(value, &Style::plain(quantity))?;
        self.constant_of_parameters(&cell, names, 0);
        if cell.symbols.is_empty() && number(cell.expr) < 0.0 {
            self.out.error(value.span(), format!("{what} is negative"));
        }
        Some(cell.expr)
    }

    fn constants<const N: usize>(
        &mut self,
        value: &Spanned<DeValue>,
        key: &str,
        names: &[String],
    ) -> Option<[Expr; N]> {
        let cells = self.list(value, &Style::plain(quantity_of_key(key, false)), key, N)?;
        cells.iter().for_each(|c| self.constant_of_parameters(c, names, 0));
        cells.iter().map(|c| c.expr).collect::<Vec<Expr>>().try_into().ok()
    }
}
