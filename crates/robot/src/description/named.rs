//! Names for lengths that a table gives as numbers, so that formulas are about the arm and not about its numbers.

use super::{Description, Parameter};
use denavit_symbolic::{Expr, Symbol};

impl Description {
    /// The robot with a parameter for every length that its table has as a bare number: `a2` of row 2, in the letters of its
    /// convention. Lengths that are the same in size share a name, so that what they make special stays special.
    #[must_use]
    pub fn with_named_lengths(&self) -> Description {
        let mut named = self.clone();
        let mut known: Vec<(Expr, Expr)> = vec![];
        let letters = [self.convention.length_x(), self.convention.length_z()];
        for i in 0..named.rows.len() {
            for (k, letter) in letters.into_iter().enumerate() {
                let row = &named.rows[i];
                let cell = if k == 0 { row.a } else { row.d };
                let Some(number) = cell.as_number().filter(|n| !n.is_zero()) else { continue };
                let is_negative = number.is_negative();
                let size: Expr = if is_negative { -cell } else { cell };
                let symbol = match known.iter().find(|(value, _)| *value == size) {
                    Some((_, symbol)) => *symbol,
                    None => {
                        let name = format!("{letter}{}", i + 1);
                        if named.is_taken(&name) {
                            continue;
                        }
                        named.parameters.push(Parameter { symbol: Symbol::new(&name), value: Some(size) });
                        known.push((size, Expr::symbol(&name)));
                        Expr::symbol(&name)
                    }
                };
                let signed = if is_negative { -symbol } else { symbol };
                let row = &mut named.rows[i];
                *(if k == 0 { &mut row.a } else { &mut row.d }) = signed;
            }
        }
        named
    }

    /// True if a parameter or a joint variable has this name.
    fn is_taken(&self, name: &str) -> bool {
        let parameters = self.parameters.iter().map(|p| p.symbol);
        let mut all = parameters.chain(self.variables().into_iter().map(|v| v.symbol));
        all.any(|s| *s.name() == *name)
    }
}
