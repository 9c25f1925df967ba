//! How a robot's quantities are spelled in formulas.

use super::{Description, JointKind};
use denavit_symbolic::vocabulary::Vocabulary;

impl Description {
    /// The names that formulas about this robot use: its parameters, and its joint variables by number, so that
    /// `C23` is cos(q2 + q3).
    pub fn vocabulary(&self) -> Vocabulary {
        let parameters = self.parameters.iter().fold(Vocabulary::new(), |v, p| v.symbol(&p.symbol.name()));
        let numbered = (1..).zip(self.variables());
        numbered.fold(parameters, |v, (number, variable)| match variable.kind {
            JointKind::Revolute => v.angle(number, variable.symbol),
            JointKind::Prismatic => v.sliding(number, variable.symbol),
        })
    }
}
