//! Dynamics: what torques do to an arm with masses.
//!
//! Every algorithm is straight-line code over [`Scalar`](crate::scalar::Scalar): with `f64` it computes, with `Expr` it leaves
//! formulas. The links are those of the moving axes ([`MovingAxes`](crate::mechanism::MovingAxes)): the frame of link k has its z
//! along axis k, in every convention alike, and what is fixed to a link is part of it. Torques are newton metres, newtons for
//! joints that slide; the joint variables radians and metres, their rates per second.
//!
//! - [`Dynamics`]: the links with their masses, the drives, gravity; over numbers or formulas; [`OfTree`]: of a whole tree.
//! - [`inverse_dynamics`]: the recursion of Newton and Euler; gravity and velocity torques are cases of it.
//! - [`inertia_matrix`]: A(q), by composite bodies.
//! - [`kinetic_energy`], [`potential_energy`]: the energies.
//! - [`momentum`]: of all mass, and about its centre; [`holding_torques`], [`holding_at`]: what holds a wrench; [`power`]: where it goes.
//! - [`regressor`]: W with τ = Wχ.
//! - [`coriolis_matrix`]: C with C q̇ the velocity torques and Ȧ − 2C skew.
//! - [`BaseModel`]: base parameters, and torques in them, with [`Representatives`] as they are wanted; [`DynamicModel`]: all as formulas, with the [`Ground`] they rest on.
//! - [`Recursion`]: Newton and Euler's, a name for every quantity.
//! - [`DynamicPrograms`]: all of it as programs, with derivatives.
//! - [`direct_dynamics`], [`articulated_bodies`]: accelerations.
//! - [`torque_derivatives`], [`acceleration_derivatives`]: their first derivatives, in numbers.
//! - [`simulate`]: motion over time, with the balance of energy.

mod articulated;
mod base;
mod closed;
mod coriolis;
mod dependent;
mod derivatives;
mod direct;
mod dynamic_model;
mod energy;
mod expansion;
mod grouping;
mod inertia;
mod lagrange;
mod model;
mod momentum;
mod newton_euler;
mod power;
mod programs;
mod recursion;
mod regressor;
mod representatives;
mod rows;
mod short;
mod simulation;
mod tree;

pub use articulated::articulated_bodies;
pub use base::{BaseModel, BaseParameter, Fate, Minimality};
pub use closed::{ClosedDynamics, Held, Meets};
pub use coriolis::coriolis_matrix;
pub use derivatives::{Slopes, acceleration_derivatives, torque_derivatives};
pub use direct::{Factored, Singular, direct_dynamics, factored};
pub use dynamic_model::{DynamicModel, Parts};
pub use energy::{kinetic_energy, potential_energy};
pub use grouping::{Gives, Grouped, given, grouped};
pub use inertia::inertia_matrix;
pub use lagrange::{Ground, lagrange};
pub use model::{Drive, Dynamics, Formulas, GRAVITY, Link, NoNumbers, Wrench};
pub use momentum::{Momentum, momentum};
pub use newton_euler::{drive_torques, friction, gravity_torques, inverse_dynamics, velocity_torques};
pub use power::{Power, holding_at, holding_torques, power};
pub use programs::{DynamicFunction, DynamicProgram, DynamicPrograms, Loads, Masses, NoProgram};
pub use recursion::{Inward, Outward, Recursion};
pub use regressor::regressor;
pub use representatives::{NoBasis, Representatives};
pub use simulation::{Acting, Method, Moment, NoMotion, Simulation, Torques, simulate, simulate_closed};
pub use tree::{OfTree, Unknown};
