//! Options of `check` for recordings, and which columns of one are what.

use clap::Args;
use denavit_recording::Told;
use std::path::PathBuf;

/// Which columns of a recording are the joints and the pose.
#[derive(Args)]
pub struct PoseColumns {
    /// The column of the time
    #[arg(long, value_name = "COLUMN")]
    pub time: Option<String>,
    /// The columns of the joints, and what may stand among them: names with commas, or `first..last`
    #[arg(long, value_name = "COLUMNS")]
    pub joints: Option<String>,
    /// The three columns of the position
    #[arg(long, value_name = "COLUMNS")]
    pub position: Option<String>,
    /// The 3, 4, 6 or 9 columns of the orientation
    #[arg(long, value_name = "COLUMNS")]
    pub rotation: Option<String>,
}

impl PoseColumns {
    fn all(&self) -> [&Option<String>; 4] {
        [&self.time, &self.joints, &self.position, &self.rotation]
    }

    /// The first option that is given.
    pub fn given(&self) -> Option<&'static str> {
        let options = ["--time", "--joints", "--position", "--rotation"];
        self.all().into_iter().zip(options).find_map(|(text, option)| text.as_ref().map(|_| option))
    }

    /// What is told by hand.
    pub fn told(&self) -> Told {
        let [time, joints, position, rotation] = self.all().map(Clone::clone);
        Told { time, joints, position, rotation }
    }
}

/// What is told of a recording, and what is written.
#[derive(Args)]
#[command(next_help_heading = "Recordings")]
pub struct RecordingArguments {
    /// Which columns are what.
    #[command(flatten)]
    pub columns: PoseColumns,
    /// Write what the columns mean as a recipe (TOML)
    #[arg(long, value_name = "FILE")]
    pub recipe: Option<PathBuf>,
    /// Write the recording with all of it undone (CSV): the model's joints in radians and metres, the pose of its tool
    #[arg(long, value_name = "FILE")]
    pub fix: Option<PathBuf>,
    /// Write a plot of how far the hand is off, as the columns stand and with all of it undone
    #[arg(long, value_name = "FILE.svg")]
    pub plot: Option<PathBuf>,
}

impl RecordingArguments {
    /// Whether one of them is given.
    pub fn is_any(&self) -> bool {
        let written = [&self.recipe, &self.fix, &self.plot];
        self.columns.given().is_some() || written.iter().any(|file| file.is_some())
    }
}
