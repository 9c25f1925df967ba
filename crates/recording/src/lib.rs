//! Recorded motion held against a robot: what the columns mean, which slip is in them, what no motion in them can tell.
//!
//! A recording has columns for the joints of an arm and for the pose of its hand. [`hold`] finds the units, orders, signs, zeros,
//! formats, frames and delays under which the one follows from the other, and says them as facts; [`words`] says them in English,
//! [`Recipe`] applies them. No file is opened and no clock is read.

mod arm;
mod columns;
mod data;
mod decode;
mod deviations;
mod explain;
mod families;
mod finding;
mod fit;
mod fixed;
pub mod frames;
mod hold;
mod hypothesis;
mod lag;
mod needed;
mod recipe;
mod recipe_text;
mod recording;
mod roles;
mod search;
mod spelled;
mod times;
pub mod turns;
pub mod words;

pub use arm::{Arm, Moving};
pub use data::Direction;
pub use decode::{Form, Format};
pub use deviations::{deviations, seconds};
pub use families::columns_of_joints;
pub use finding::{Finding, Fitted, Length, Off, Rival, Slip, Stuck, Unlike, Unseen};
pub use fixed::{Row, fixed, rows};
pub use hold::{Held, HoldOptions, hold};
pub use recipe::{ColumnUnit, JointColumn, Recipe, Rows, table_of};
pub use recipe_text::RecipeError;
pub use recording::{Column, HoldError, Recording, Roles, Said};
pub use roles::{RolesError, Told, columns_told};
pub use times::{column_of_episodes, column_of_time, seconds_by_step, seconds_said};
