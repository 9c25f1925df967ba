//! Plots as drawings: axes, and on them what has a meaning of its own.
//!
//! - [`workspace_plot`]: the reachable region with its manipulability.
//! - [`curves`]: lines over an axis, in panels.

mod axes;
mod curves;
mod workspace;

pub use curves::{Curve, Panel, curves};
pub use workspace::{arm_line, workspace_plot};
