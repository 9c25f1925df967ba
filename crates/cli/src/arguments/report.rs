//! The arguments of `report`.

use super::{ConventionName, RobotArguments};
use clap::{Args, ValueEnum};
use denavit_report::words::Tongue;
use std::path::PathBuf;

/// `report`
#[derive(Args)]
pub struct ReportArguments {
    /// The robot.
    #[command(flatten)]
    pub robot: RobotArguments,
    /// The file; its ending says the format: .pdf, .html, .typ (Typst), .tex (LaTeX) or .md (- for standard output)
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    /// Another robot to compare it with (can be repeated): both at a glance, in pictures, by their tables and workspaces
    #[arg(long, value_name = "ROBOT", conflicts_with = "q")]
    pub beside: Vec<String>,
    /// The format, if the ending does not say it
    #[arg(long, value_enum)]
    pub format: Option<ReportFormat>,
    /// The title; one that names the robot otherwise
    #[arg(long, value_name = "TITLE")]
    pub title: Option<String>,
    /// Who hands it in: stands below the title
    #[arg(long, value_name = "AUTHOR")]
    pub author: Option<String>,
    /// How much it says
    #[arg(long, value_enum, default_value = "full")]
    pub level: LevelName,
    /// As slides for a talk, a formula or a paragraph at a time or `whole`; as .html, .typ or .pdf
    #[arg(long, value_enum, value_name = "PACE", num_args = 0..=1, require_equals = true, default_missing_value = "steps")]
    pub slides: Option<PaceName>,
    /// Only these sections, as in `--sections table,forward,inverse`
    #[arg(long, value_enum, value_delimiter = ',', value_name = "SECTIONS")]
    pub sections: Vec<SectionName>,
    /// The language of the words
    #[arg(long, value_enum, default_value = "en")]
    pub language: ReportLanguage,
    /// Show the table in these conventions, too, proved the same
    #[arg(long, value_enum, value_delimiter = ',', value_name = "CONVENTIONS")]
    pub conventions: Vec<ConventionName>,
    /// The configuration of figures and examples, as for `fk`; one that shows the arm well otherwise
    #[arg(short, allow_hyphen_values = true, value_name = "CONFIGURATION")]
    pub q: Option<String>,
}

/// The format of a report.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ReportFormat {
    /// A PDF, by Typst
    Pdf,
    /// One web page that needs nothing else
    Html,
    /// Typst markup
    Typst,
    /// LaTeX for amsmath, amssymb and tikz
    Latex,
    /// Markdown with a folder of figures
    Markdown,
}

/// How slides go on.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum PaceName {
    /// A formula or a paragraph at a time
    Steps,
    /// Whole slides
    Whole,
}

/// How much a report says.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum LevelName {
    /// The results: no worked example, no steps of derivations, no pictures of solutions and singularities
    Short,
    /// Everything
    Full,
}

/// A language.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ReportLanguage {
    /// English
    En,
    /// Français
    Fr,
    /// Deutsch
    De,
    /// Español
    Es,
}

impl ReportLanguage {
    /// The words of the language.
    pub fn tongue(self) -> Tongue {
        match self {
            ReportLanguage::En => Tongue::English,
            ReportLanguage::Fr => Tongue::French,
            ReportLanguage::De => Tongue::German,
            ReportLanguage::Es => Tongue::Spanish,
        }
    }
}

/// A section of a report.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum SectionName {
    /// The robot at a glance
    Summary,
    /// The arm with its frames, and its line diagram
    Figures,
    /// The Denavit–Hartenberg table
    Table,
    /// The link transforms
    Links,
    /// The forward model and its algorithm
    Forward,
    /// Numbers at a configuration
    Example,
    /// Inverse kinematics, step by step, and all solutions at the example
    Inverse,
    /// The Jacobian, its determinant and the singularities
    Velocity,
    /// Base parameters and torques, of a robot with masses
    Dynamics,
    /// The reachable region and the manipulability in it
    Workspace,
    /// What is wrong in the document that the robot comes from
    Errata,
    /// Where methods and numbers come from
    References,
}
