//! The geometry of an arm out of measurements: what a kind of measurement can show, the estimate, and the poses to measure at.
//!
//! [`visible()`] says by the structure which errors of geometry a measurement shows, and which no configuration does;
//! [`calibrate()`] estimates them, with deviations, and says what the data at hand leave open; [`choose_poses`] finds the
//! configurations that tell most. [`Table`] is the arm with what was found, as rows. No file is opened and no clock is read.

mod cells;
mod estimate;
mod fit;
mod linear;
pub mod measured;
pub mod measurement;
pub mod model;
mod poses;
mod refused;
mod starts;
pub mod table;
pub mod visible;
pub mod words;
mod work;

pub use cells::{Place, TableSeen, Tied, table_seen};
pub use estimate::{CalibrateError, CalibrateOptions, Calibrated, Estimate, Measured, Off, PRIOR};
pub use fit::{LOOKED_AT, calibrate, deviation_of_hand};
pub use measurement::{Bar, Fixture, Measurement, Reading};
pub use model::{Parameter, Problem, State};
pub use poses::{Chosen, choose_poses};
pub use table::{CELLS, Cell, NoTable, Numbers, Rows, Table};
pub use visible::{Cause, Null, Visible, formula, visible};
