//! Tests of the science, one program.

mod attack;
mod common;
mod description;
mod description_bytes;
mod description_tables;
mod documents_inverse;
mod documents_jacobian;
mod every_arm;
mod follow;
mod forward;
mod frames;
mod geometry;
mod idealise;
mod inverse;
mod mechanism;
mod members;
mod motion_jerk;
mod motion_plan;
mod motion_profiles;
mod motion_timing;
mod numeric;
mod redundant;
mod scope;
mod singular;
mod velocity;
mod workspace;
