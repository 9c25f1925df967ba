//! What goes wrong: a status, its words, and findings with their places; the last one of each thread.

use crate::types::{FindingSeverity, Status};
use denavit::description::{Diagnostic, Severity, line_column};
use denavit_load::Finding;
use std::any::Any;
use std::cell::RefCell;
use std::ffi::CString;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::thread;

/// How deep a derivation may go, bytes.
const STACK: usize = 64 << 20;

/// Why nothing was computed.
#[derive(Debug)]
pub struct Trouble {
    pub status: Status,
    pub message: String,
    pub findings: Vec<Found>,
}

/// A finding, as C reads it.
#[derive(Clone, Debug)]
pub struct Found {
    pub severity: FindingSeverity,
    pub message: CString,
    pub hint: Option<CString>,
    pub file: CString,
    /// From 1; 0 where there is no place.
    pub line: usize,
    pub column: usize,
    /// All of it as it is printed.
    pub rendered: CString,
}

/// A text that ends with a zero byte, and has no other.
pub fn text(s: &str) -> CString {
    CString::new(s.replace('\0', "\u{fffd}")).unwrap_or_default()
}

impl Found {
    /// A finding with its place.
    pub fn new(d: &Diagnostic, name: &str, of: &str) -> Self {
        let (line, column) = line_column(of, d.span.start);
        Found {
            severity: match d.severity {
                Severity::Error => FindingSeverity::Error,
                Severity::Warning => FindingSeverity::Warning,
                Severity::Note => FindingSeverity::Note,
            },
            message: text(&d.message),
            hint: d.hint.as_deref().map(text),
            file: text(name),
            line,
            column,
            rendered: text(d.render(name, of).trim_end()),
        }
    }

    /// All findings of files.
    pub fn all(findings: &[Finding]) -> Vec<Self> {
        findings.iter().map(|f| Found::new(&f.diagnostic, &f.name, &f.text)).collect()
    }

    /// Without a place.
    pub fn said(severity: FindingSeverity, message: &str, file: &str) -> Self {
        let word = match severity {
            FindingSeverity::Error => "error",
            FindingSeverity::Warning => "warning",
            FindingSeverity::Note => "note",
        };
        let rendered = text(&format!("{file}: {word}: {message}"));
        Found { severity, message: text(message), hint: None, file: text(file), line: 0, column: 0, rendered }
    }
}

impl Trouble {
    /// Without findings.
    pub fn new(status: Status, message: impl Into<String>) -> Self {
        Trouble { status, message: message.into(), findings: vec![] }
    }

    /// The errors of a description.
    pub fn of(findings: Vec<Found>) -> Self {
        let errors = findings.iter().filter(|f| f.severity == FindingSeverity::Error);
        let words: Vec<_> = errors.map(|f| f.rendered.to_string_lossy()).collect();
        Trouble { message: words.join("\n"), status: Status::BadDescription, findings }
    }

    /// Parameters have no value.
    pub fn missing(why: impl std::fmt::Display) -> Self {
        Trouble::new(Status::MissingValue, format!("{why}; `denavit_robot_set` gives values"))
    }

    /// An array has another length than it must have.
    pub fn length(name: &str, given: usize, wanted: usize) -> Self {
        Trouble::new(Status::WrongLength, format!("{name} has {given} entries; {wanted} are needed"))
    }

    /// The message of a panic.
    fn panicked(panic: &(dyn Any + Send)) -> Self {
        let words = panic.downcast_ref::<&str>().copied().map(str::to_string);
        let words = words.or_else(|| panic.downcast_ref::<String>().cloned());
        let words = words.unwrap_or_else(|| "a panic without words".into());
        Trouble::new(Status::Panic, format!("a fault of the library, which is worth a report: {words}"))
    }
}

/// The last error of a thread, as C reads it.
#[derive(Default)]
pub struct Last {
    pub message: CString,
    pub findings: Vec<Found>,
}

thread_local! {
    static LAST: RefCell<Last> = RefCell::default();
}

/// Reads the last error of this thread.
pub fn last<T>(read: impl FnOnce(&Last) -> T) -> Option<T> {
    LAST.try_with(|last| last.try_borrow().ok().map(|last| read(&last))).ok().flatten()
}

/// Does something for a caller who knows no panic: keeps what goes wrong, and gives its status.
pub fn guarded(work: impl FnOnce() -> Result<Status, Trouble>) -> Status {
    let trouble = match catch_unwind(AssertUnwindSafe(work)) {
        Ok(Ok(status)) => return status,
        Ok(Err(trouble)) => trouble,
        Err(panic) => Trouble::panicked(&*panic),
    };
    let kept = Last { message: text(&trouble.message), findings: trouble.findings };
    // A thread that ends has no last error any more.
    let _ = LAST.try_with(|last| last.try_borrow_mut().map(|mut last| *last = kept));
    trouble.status
}

/// Does something on a thread of its own, whose formulas end with it.
pub fn apart<T: Send>(work: impl FnOnce() -> Result<T, Trouble> + Send) -> Result<T, Trouble> {
    thread::scope(|scope| {
        let started = thread::Builder::new().stack_size(STACK).spawn_scoped(scope, work);
        let started = started.map_err(|e| Trouble::new(Status::Unsupported, format!("no thread: {e}")))?;
        started.join().unwrap_or_else(|panic| Err(Trouble::panicked(&*panic)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message() -> String {
        last(|last| last.message.to_string_lossy().into_owned()).unwrap_or_default()
    }

    #[test]
    fn a_panic_is_a_status() {
        assert_eq!(guarded(|| panic!("no {}", "way")), Status::Panic);
        assert!(message().ends_with("no way"), "{}", message());
        assert_eq!(guarded(|| apart(|| panic!("far away"))), Status::Panic);
        assert!(message().ends_with("far away"), "{}", message());
        assert_eq!(guarded(|| std::panic::panic_any(7)), Status::Panic);
        assert!(message().ends_with("without words"), "{}", message());
    }

    #[test]
    fn the_last_error_is_that_of_its_thread_and_stays() {
        let fail = |words: &str| guarded(|| Err(Trouble::new(Status::BadFile, words)));
        assert_eq!(fail("one\0two"), Status::BadFile);
        assert_eq!(guarded(|| Ok(Status::Family)), Status::Family);
        let other = thread::spawn(move || (message(), fail("three"), message()));
        assert_eq!(other.join().ok(), Some((String::new(), Status::BadFile, "three".into())));
        assert_eq!(message(), "one\u{fffd}two");
    }
}
