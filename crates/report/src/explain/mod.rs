//! Derivations as documents.
//!
//! What is to be said is gathered as facts (an [`Explanation`], the singularities of `denavit`) and written in a language
//! of [`crate::words`] as a tree of [`crate::document`].

mod dynamics;
mod inverse;
mod velocity;

pub use dynamics::{
    dynamics_document, dynamics_explanation, dynamics_vocabulary, recursion_vocabulary,
    rows_dynamics_vocabulary, tree_dynamics_document, tree_dynamics_vocabulary,
};
pub(crate) use inverse::uses_letters;
pub use inverse::{
    Bound, Case, Component, Consequence, Explained, Explanation, Kind, Remark, Source, Statement,
};
pub use velocity::{
    found_singularities_document, jacobian_document, singularities_document, velocity_vocabulary,
};
