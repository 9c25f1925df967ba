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
mod german;
mod inverse;
mod motion;
mod report;
mod spanish;
mod terms;
mod velocity;

pub use check::Check;
pub use dynamics::Dynamics;
pub use english::English;
pub use exercise::{Exercise, ExerciseKind};
pub use french::French;
pub use geometry::{Geometry, Whole};
pub use german::German;
pub use inverse::{Coefficients, Given, Inverse};
pub use motion::Motion;
pub use report::{Caption, Column, Factors, Glance, Heading, List, Names, Report, Standings};
pub use spanish::Spanish;
pub use terms::Terms;
pub use velocity::{Gain, Loss, Velocity};

use denavit_symbolic::vocabulary::Vocabulary;

/// The language of the words around formulas.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Tongue {
    /// English.
    #[default]
    English,
    /// French, with the terms of courses in robotics.
    French,
    /// German.
    German,
    /// Spanish.
    Spanish,
}

/// All messages.
pub trait Wording:
    Terms + Geometry + Inverse + Velocity + Dynamics + Motion + Check + Report + Exercise
{
}

impl<T: Terms + Geometry + Inverse + Velocity + Dynamics + Motion + Check + Report + Exercise> Wording for T {}

impl Tongue {
    /// All languages.
    pub const ALL: [Tongue; 4] = [Tongue::English, Tongue::French, Tongue::German, Tongue::Spanish];

    /// The language with this code: `en`, `fr`, `de`, `es`.
    pub fn of_code(code: &str) -> Option<Tongue> {
        Tongue::ALL.into_iter().find(|language| language.words().code() == code)
    }

    /// The codes of all languages: `en, fr, de or es`.
    pub fn codes() -> String {
        let codes = Tongue::ALL.map(|language| language.words().code());
        let (last, before) = codes.split_last().unwrap_or((&"", &[]));
        format!("{} or {last}", before.join(", "))
    }

    /// The names of formulas, for formulas with the decimal sign of the language.
    pub fn spelled(self, names: &Vocabulary) -> Vocabulary {
        names.clone().decimal_comma(self.words().has_decimal_comma())
    }

    /// What is said in this language.
    pub fn words(self) -> &'static dyn Wording {
        match self {
            Tongue::English => &English,
            Tongue::French => &French,
            Tongue::German => &German,
            Tongue::Spanish => &Spanish,
        }
    }
}
