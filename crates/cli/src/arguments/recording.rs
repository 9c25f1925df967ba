//! Options of `check` for recordings.

use clap::Args;
use denavit_recording::Told;
use std::path::PathBuf;

/// Which columns of a recording are what, and what is written.
#[derive(Args)]
#[command(next_help_heading = "Recordings")]
pub struct RecordingArguments {
    /// The column of the time
    #[arg(long, value_name = "COLUMN")]
    pub time: Option<String>,
    /// The columns of the joints, and what may stand among them: names with commas, or `first..last`
    #[arg(long, value_name = "COLUMNS")]
    pub joints: Option<String>,
    /// The three columns of the hand's position
    #[arg(long, value_name = "COLUMNS")]
    pub position: Option<String>,
    /// The 3, 4, 6 or 9 columns of how the hand is turned
    #[arg(long, value_name = "COLUMNS")]
    pub rotation: Option<String>,
    /// Write what the columns mean as a recipe (TOML)
    #[arg(long, value_name = "FILE")]
    pub recipe: Option<PathBuf>,
    /// Write the recording with all of it undone (CSV): the model's joints in radians and metres, the pose of its tool
    #[arg(long, value_name = "FILE")]
    pub fix: Option<PathBuf>,
}

impl RecordingArguments {
    /// What is told by hand.
    pub fn told(&self) -> Told {
        let [time, joints, position, rotation] =
            [&self.time, &self.joints, &self.position, &self.rotation].map(Clone::clone);
        Told { time, joints, position, rotation }
    }

    /// Whether one of them is given.
    pub fn is_any(&self) -> bool {
        let texts = [&self.time, &self.joints, &self.position, &self.rotation];
        texts.iter().any(|t| t.is_some()) || self.recipe.is_some() || self.fix.is_some()
    }
}
