//! Everything that is said, in every language.
//!
//! A message is a method with typed arguments, one trait a topic; each language answers all of them in a folder of its own,
//! where its genders, plurals and elisions stay. A further language is a folder, a line in [`Tongue::words`] and what the
//! compiler then asks for.

mod check;
mod dynamics;
mod english;
mod exercise;
mod french;
mod geometry;
mod inverse;
mod motion;
mod report;
mod terms;
mod velocity;

pub use check::Check;
pub use dynamics::Dynamics;
pub use english::English;
pub use exercise::{Exercise, ExerciseKind};
pub use french::French;
pub use geometry::{Geometry, Whole};
pub use inverse::{Coefficients, Given, Inverse};
pub use motion::Motion;
pub use report::{Caption, Column, Factors, Glance, Heading, List, Names, Report, Standings};
pub use terms::Terms;
pub use velocity::{Gain, Loss, Velocity};

/// The language of the words around formulas.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Tongue {
    /// English.
    #[default]
    English,
    /// French, with the terms of courses in robotics.
    French,
}

/// All messages.
pub trait Wording:
    Terms + Geometry + Inverse + Velocity + Dynamics + Motion + Check + Report + Exercise
{
}

impl<T: Terms + Geometry + Inverse + Velocity + Dynamics + Motion + Check + Report + Exercise> Wording for T {}

impl Tongue {
    /// All languages.
    pub const ALL: [Tongue; 2] = [Tongue::English, Tongue::French];

    /// What is said in this language.
    pub fn words(self) -> &'static dyn Wording {
        match self {
            Tongue::English => &English,
            Tongue::French => &French,
        }
    }
}
