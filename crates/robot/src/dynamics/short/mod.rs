//! Short programs for torques and inertia matrices: the recursion of Newton and Euler, or composite bodies, with a choice at each link,
//! searched and counted.
//!
//! Successive axes that are parallel are a group; G is the frame before it, turned with the link before. A link's motion and its
//! wrench may be had in its own frame, in G with the link's masses turned instead of the motion, or in the frame of the group's
//! first link; of the numbers that grouping leaves free the choice is what is short ([`choices`]). U = ω̇^ + ω^ω^ is carried by its
//! third column, which a turn about z leaves a vector ([`generator`]); composite bodies are formed in one of these frames ([`inertia`]).
//! All candidates share one value-numbered graph.

mod arm;
mod choices;
mod generator;
mod inertia;
mod search;

pub(super) use search::{shortest, shortest_inertia};
