//! What goes wrong, as exceptions of the package.

use denavit::description::Diagnostic;
use denavit_load::Finding;
use pyo3::prelude::*;
use pyo3::{PyErr, import_exception};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

import_exception!(denavit._errors, ChainError);
import_exception!(denavit._errors, DescriptionError);
import_exception!(denavit._errors, FileError);
import_exception!(denavit._errors, MissingValueError);
import_exception!(denavit._errors, MotionError);
import_exception!(denavit._errors, NoMassesError);
import_exception!(denavit._errors, PoseError);
import_exception!(denavit._errors, ShapeError);
import_exception!(denavit._errors, UnknownRobotError);
import_exception!(denavit._errors, UnsupportedError);
import_exception!(denavit._errors, UsageError);

/// How long a signal may have to wait.
const WAKE: Duration = Duration::from_millis(50);

/// How deep a derivation may go.
const STACK: usize = 64 << 20;

/// A finding in a text, as Python gets it: severity, message, hint, file, line, column, and all of it as it is printed.
pub type Found = (String, String, Option<String>, String, usize, usize, String);

/// A finding with its place.
pub fn found(d: &Diagnostic, name: &str, text: &str) -> Found {
    let (line, column) = denavit::description::line_column(text, d.span.start);
    let rendered = d.render(name, text).trim_end().to_string();
    (d.severity.name().into(), d.message.clone(), d.hint.clone(), name.into(), line, column, rendered)
}

/// Findings with their places.
pub fn all_found(findings: &[Finding]) -> Vec<Found> {
    findings.iter().map(|f| found(&f.diagnostic, &f.name, &f.text)).collect()
}

/// A note without a place.
pub fn said(severity: &str, message: String, file: &str) -> Found {
    let rendered = format!("{file}: {severity}: {message}");
    (severity.into(), message, None, file.into(), 0, 0, rendered)
}

/// Which exception it is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Kind {
    /// There is no such chain.
    Chain,
    /// A description has errors.
    Description,
    /// A file cannot be read or written.
    File,
    /// A parameter has no value.
    Missing,
    /// There is no such motion.
    Motion,
    /// The description says nothing of masses.
    NoMasses,
    /// A matrix is no pose.
    Pose,
    /// An array has the wrong shape.
    Shape,
    /// There is no such robot.
    Unknown,
    /// There is no such formula, solution or source code.
    Unsupported,
    /// What is asked for does not fit the robot.
    Usage,
}

/// Why there is no answer.
#[derive(Clone, Debug)]
pub struct Trouble {
    kind: Kind,
    message: String,
    findings: Vec<Found>,
}

impl Trouble {
    /// Without findings.
    pub fn new(kind: Kind, message: impl Into<String>) -> Self {
        Trouble { kind, message: message.into(), findings: vec![] }
    }

    /// The errors of a description.
    pub fn of(findings: Vec<Found>) -> Self {
        let errors: Vec<&str> = findings.iter().filter(|f| f.0 == "error").map(|f| f.6.as_str()).collect();
        Trouble { kind: Kind::Description, message: errors.join("\n"), findings }
    }

    /// With why a description says nothing of masses, where it is known and this is the trouble.
    #[must_use]
    pub fn explained(mut self, unweighed: Option<&str>) -> Self {
        if let (Kind::NoMasses, Some(why)) = (self.kind, unweighed) {
            self.message = format!("{} ({why})", self.message);
        }
        self
    }

    /// Parameters have no value.
    pub fn missing(why: impl std::fmt::Display) -> Self {
        Trouble::new(Kind::Missing, format!("{why}; `robot.set(name=value)` gives values"))
    }
}

impl From<Trouble> for PyErr {
    fn from(trouble: Trouble) -> PyErr {
        let Trouble { kind, message, findings } = trouble;
        let arguments = (message, findings);
        match kind {
            Kind::Chain => ChainError::new_err(arguments),
            Kind::Description => DescriptionError::new_err(arguments),
            Kind::File => FileError::new_err(arguments),
            Kind::Missing => MissingValueError::new_err(arguments),
            Kind::Motion => MotionError::new_err(arguments),
            Kind::NoMasses => NoMassesError::new_err(arguments),
            Kind::Pose => PoseError::new_err(arguments),
            Kind::Shape => ShapeError::new_err(arguments),
            Kind::Unknown => UnknownRobotError::new_err(arguments),
            Kind::Unsupported => UnsupportedError::new_err(arguments),
            Kind::Usage => UsageError::new_err(arguments),
        }
    }
}

/// Does something on a thread of its own, whose formulas end with it, while Python's other threads run. A signal is attended to
/// within [`WAKE`]: the thread then goes on, and what it finds is dropped.
///
/// # Errors
/// Those of the work; what the signal's handler raises; or if no thread can be started.
pub fn apart<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce() -> Result<T, Trouble> + Send + 'static,
) -> PyResult<T> {
    let (send, receive) = mpsc::sync_channel(1);
    let started = thread::Builder::new().stack_size(STACK).spawn(move || {
        // Nobody listens any more where a signal came first.
        let _ = send.send(work());
    });
    let started = started.map_err(|e| Trouble::new(Kind::Unsupported, format!("no thread: {e}")))?;
    let mut receive = receive;
    loop {
        let waited;
        (receive, waited) = py.detach(move || {
            let waited = receive.recv_timeout(WAKE);
            (receive, waited)
        });
        // Before anything of Python's is made: a signal that is still due would be raised there.
        py.check_signals()?;
        match waited {
            Ok(found) => return Ok(found?),
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => {
                return Err(match started.join() {
                    Err(panic) => std::panic::resume_unwind(panic),
                    Ok(()) => Trouble::new(Kind::Unsupported, "the work ended without an answer").into(),
                });
            }
        }
    }
}
