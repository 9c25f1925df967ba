//! The functions that a formula may call: their spellings and their meanings.

use crate::expr::Expr;

/// What is written before brackets.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Function {
    /// The sine of an angle.
    Sin,
    /// The cosine of an angle.
    Cos,
    /// The tangent of an angle.
    Tan,
    /// The square root; in a [`Syntax`](super::Syntax) it is a [`Root`](super::SyntaxKind::Root).
    Sqrt,
    /// The angle of the point (x, y), of the arguments `y, x`.
    Atan2,
    /// The angle from −π/2 to π/2 with a given sine.
    Arcsin,
    /// The angle from 0 to π with a given cosine.
    Arccos,
    /// The angle between −π/2 and π/2 with a given tangent.
    Arctan,
}

/// The functions that a whole word may call.
pub(super) const CALLED: [Function; 5] =
    [Function::Sin, Function::Cos, Function::Tan, Function::Sqrt, Function::Atan2];

/// The names of functions; sine, cosine and tangent may also stand without brackets.
pub(super) const FUNCTIONS: &[(&str, Function)] = &[
    ("cos", Function::Cos),
    ("sin", Function::Sin),
    ("tan", Function::Tan),
    ("C", Function::Cos),
    ("S", Function::Sin),
    ("c", Function::Cos),
    ("s", Function::Sin),
    ("sen", Function::Sin),
    ("tg", Function::Tan),
    ("sqrt", Function::Sqrt),
    ("atan2", Function::Atan2),
    ("Atan2", Function::Atan2),
    ("ATAN2", Function::Atan2),
    ("arctan2", Function::Atan2),
    ("arcsin", Function::Arcsin),
    ("arccos", Function::Arccos),
    ("arctan", Function::Arctan),
    ("asin", Function::Arcsin),
    ("acos", Function::Arccos),
    ("atan", Function::Arctan),
    ("arcsen", Function::Arcsin),
    ("arctg", Function::Arctan),
];

/// True if the word is the name of a function, other than one letter.
pub(super) fn is_function_name(word: &str) -> bool {
    word.len() > 1 && FUNCTIONS.iter().any(|(name, _)| *name == word)
}

impl Function {
    /// Its usual name.
    pub fn name(self) -> &'static str {
        match self {
            Function::Sin => "sin",
            Function::Cos => "cos",
            Function::Tan => "tan",
            Function::Sqrt => "sqrt",
            Function::Atan2 => "atan2",
            Function::Arcsin => "arcsin",
            Function::Arccos => "arccos",
            Function::Arctan => "arctan",
        }
    }

    /// Whether its argument is an angle.
    pub fn takes_angle(self) -> bool {
        matches!(self, Function::Sin | Function::Cos | Function::Tan)
    }

    /// The function that takes a sine, cosine or tangent back to the angle.
    pub fn inverse(self) -> Option<Function> {
        match self {
            Function::Sin => Some(Function::Arcsin),
            Function::Cos => Some(Function::Arccos),
            Function::Tan => Some(Function::Arctan),
            _ => None,
        }
    }

    /// Whether it is the inverse of another one.
    pub fn is_inverse(self) -> bool {
        matches!(self, Function::Arcsin | Function::Arccos | Function::Arctan)
    }

    /// Its value; angles are in radians.
    ///
    /// # Panics
    /// If there are not two arguments for `atan2`, and one for any other function.
    pub fn of(self, arguments: &[Expr]) -> Expr {
        let cofunction = |u: Expr| (Expr::int(1) - u.powi(2)).sqrt();
        match (self, arguments) {
            (Function::Sin, [a]) => a.sin(),
            (Function::Cos, [a]) => a.cos(),
            (Function::Tan, [a]) => {
                let (sin, cos) = a.sin_cos();
                sin / cos
            }
            (Function::Sqrt, [a]) => a.sqrt(),
            (Function::Atan2, [y, x]) => y.atan2(*x),
            (Function::Arcsin, [u]) => u.atan2(cofunction(*u)),
            (Function::Arccos, [u]) => cofunction(*u).atan2(*u),
            (Function::Arctan, [u]) => u.atan2(Expr::int(1)),
            _ => panic!("{} of {} arguments", self.name(), arguments.len()),
        }
    }
}
