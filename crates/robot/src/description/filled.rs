//! Values for parameters that have none, for pictures and examples.

use super::{Description, Measure};
use denavit_symbolic::Expr;

impl Description {
    /// The robot with values for all parameters: those that have none get a length of the size of the others (0.4 m where
    /// none is known) or an angle, no two neighbours alike.
    #[must_use]
    pub fn filled(&self) -> Description {
        let known: Vec<f64> = self
            .parameters
            .iter()
            .filter(|p| self.measure(p.symbol) == Measure::Length)
            .filter_map(|p| p.number().map(f64::abs))
            .filter(|x| x.is_finite() && *x > 0.0)
            .collect();
        let usual = if known.is_empty() { 0.4 } else { known.iter().sum::<f64>() / known.len() as f64 };
        let thousandths = (1000.0 * usual).clamp(1.0, 1e6) as i64;
        let mut filled = self.clone();
        for (k, p) in filled.parameters.iter_mut().enumerate().filter(|(_, p)| p.value.is_none()) {
            // No sum of two is a third.
            let percent = [100, 85, 117, 92, 71, 79, 61, 107, 67][k % 9];
            p.value = Some(match self.measure(p.symbol) {
                Measure::Length => Expr::int(thousandths * percent) / Expr::int(100_000),
                // Nothing that is drawn depends on it.
                Measure::Other(_) => continue,
                Measure::Angle => Expr::int(30 + 5 * (k % 4) as i64) * Expr::pi() / Expr::int(180),
            });
        }
        filled
    }
}
