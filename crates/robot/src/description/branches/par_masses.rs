//! Masses of `.par` files: the ten numbers of each link about the origin of its frame, the rotors IA, friction FV and FS.

use super::par::{Entry, Reader};
use crate::description::units::Quantity;
use crate::description::{Parameter, Row};
use crate::geometry::PARAMETERS;
use denavit_symbolic::{Expr, Rational, Symbol};

/// What belongs to a joint itself: the inertia of its rotor, viscous friction, Coulomb's.
const DRIVES: [&str; 3] = ["IA", "FV", "FS"];
/// What acts from outside, and the state of the base.
const FORCES: [&str; 12] = ["FX", "FY", "FZ", "CX", "CY", "CZ", "QP", "QDP", "W0", "WP0", "V0", "VP0"];

impl<'t> Reader<'t> {
    /// Gives rows their masses, where a file has any in numbers: names alone are what links are called anyhow.
    pub(super) fn masses(
        &mut self,
        entries: &[Entry<'t>],
        rows: &mut [Row],
        parameters: &mut Vec<Parameter>,
    ) {
        let column = |key: &str| entries.iter().find(|e| e.key() == key);
        let has_numbers = |key: &&str| column(key).is_some_and(Entry::has_numbers);
        if let Some(entry) = FORCES.iter().filter(|key| has_numbers(key)).find_map(|key| column(key)) {
            self.out.note(entry.place(), "forces from outside and the motion of the base are not read");
        }
        if !PARAMETERS.iter().chain(&DRIVES).any(has_numbers) {
            return;
        }
        let count = rows.len();
        for (j, row) in rows.iter_mut().enumerate() {
            let mut at = |key: &str| -> Option<Expr> {
                let item = column(key)?.item(j)?;
                let cell = self.cell(item, Quantity::Number);
                for name in cell.names() {
                    let symbol = Symbol::new(name);
                    if !parameters.iter().any(|p| p.symbol == symbol) {
                        parameters.push(Parameter { symbol, value: None });
                    }
                }
                Some(cell.value())
            };
            let [xx, xy, xz, yy, yz, zz, x, y, z, mass] =
                PARAMETERS.map(|key| at(key).unwrap_or(Expr::int(0)));
            let [rotor, viscous, coulomb] = DRIVES.map(|key| at(key).filter(|e| !e.is_zero()));
            let all = [xx, xy, xz, yy, yz, zz, x, y, z, mass];
            if all.iter().any(|e| !e.is_zero()) {
                row.mass = Some(mass);
                row.first_moment = Some([x, y, z]);
                row.inertia_at_origin = Some([xx, xy, xz, yy, yz, zz]);
            }
            if row.variable.is_some() {
                (row.rotor, row.viscous, row.coulomb) = (rotor, viscous, coulomb);
            }
        }
        for key in PARAMETERS.iter().chain(&DRIVES) {
            let more = column(key).and_then(|e| Some((e, e.item(count)?)));
            if let Some((entry, _)) = more {
                let message = format!("`{key}` has more values than there are frames ({count})");
                self.out.warning(entry.place(), message);
            }
        }
    }
}

impl Entry<'_> {
    /// Whether a number stands in it that is not 0.
    pub(super) fn has_numbers(&self) -> bool {
        self.texts().any(|text| Rational::from_decimal(text).is_some_and(|x| !x.is_zero()))
    }
}
