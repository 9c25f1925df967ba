//! Plots as drawings: axes by the crate `plotters`, everything with a meaning of its own by shapes.
//!
//! - [`workspace_plot`]: the reachable region with its manipulability.
//! - [`curves`]: lines over an axis.

mod axes;
mod curves;
mod recorder;
mod workspace;

pub use curves::{Curve, curves};
pub use workspace::{arm_line, workspace_plot};
