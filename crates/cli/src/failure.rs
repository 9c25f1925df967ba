//! How a command ends when it does not succeed.

use denavit::description::{Description, Measure};
use denavit::robot::MissingValue;
use denavit_symbolic::Symbol;
use std::io::{self, Write};
use std::process::ExitCode;

/// Why a command stopped, with its exit code.
#[derive(Debug)]
pub enum Failure {
    /// 1: the answer is no.
    No(String),
    /// 2: the command line asks for something that does not fit the robot.
    Usage(String),
    /// 3: a file or value cannot be read; what is to be said stands in the text, ready to print.
    Input(String),
    /// 4: this is not supported.
    Unsupported(String),
    /// 5: a bound on time or size was reached; what was found is printed.
    GaveUp(String),
    /// Standard output or a file cannot be written or read.
    Io(io::Error),
}

impl Failure {
    /// Says why on standard error and gives the exit code. A reader that has gone away (`| head`) is no failure.
    pub fn report(self) -> ExitCode {
        let (code, text) = match self {
            Failure::Io(e) if e.kind() == io::ErrorKind::BrokenPipe => return ExitCode::SUCCESS,
            Failure::Io(e) => (3, format!("error: {e}")),
            Failure::No(text) => (1, text),
            Failure::GaveUp(text) => (5, format!("gave up: {text}")),
            Failure::Usage(text) => (2, format!("error: {text}")),
            Failure::Input(text) => (3, text),
            Failure::Unsupported(text) => (4, format!("not supported: {text}")),
        };
        let _ = writeln!(anstream::stderr(), "{}", text.trim_end());
        ExitCode::from(code)
    }
}

impl From<io::Error> for Failure {
    fn from(e: io::Error) -> Self {
        Failure::Io(e)
    }
}

/// Parameters have no value.
pub fn without_values(description: &Description, name: &str, missing: &MissingValue) -> Failure {
    let example = |p: &String| match description.measure(Symbol::new(p)) {
        Measure::Angle => format!("--set {p}=30deg"),
        Measure::Length => format!("--set {p}=450mm"),
        Measure::Other("") => format!("--set {p}=1"),
        Measure::Other(unit) if unit.contains([' ', '^']) => format!("--set \"{p}=1 {unit}\""),
        Measure::Other(unit) => format!("--set {p}=1{unit}"),
    };
    let settings: Vec<String> = missing.parameters.iter().map(example).collect();
    Failure::Input(format!("error: {name}: {missing}\n  = hint: give values, as in {}", settings.join(" ")))
}
