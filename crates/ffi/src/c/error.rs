//! Errors: what went wrong last on this thread, and the version.

#![allow(unsafe_code)] // functions of C

use crate::border::Place;
use crate::trouble::{Found, Trouble, guarded, last};
use crate::types::{Code, Finding, Status};
use std::ffi::c_char;
use std::ptr;

/// What went wrong in the last call on this thread that returned a negative status; an empty text if none did. It is there until the next
/// such call on this thread, or the end of the thread.
#[unsafe(no_mangle)]
pub extern "C" fn denavit_error_message() -> *const c_char {
    last(|last| last.message.as_ptr()).unwrap_or(c"".as_ptr())
}

/// How many findings belong to it: those of a description that has errors, warnings and notes among them.
#[unsafe(no_mangle)]
pub extern "C" fn denavit_error_findings() -> usize {
    last(|last| last.findings.len()).unwrap_or_default()
}

/// Finding `index` of the last error of this thread. Its texts are there as long as the message.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_error_finding(index: usize, finding: *mut Finding) -> Status {
    let found = last(|last| last.findings.get(index).map(shown)).flatten();
    // Keeps the error of which it is a finding, unless it fails.
    match (found, finding.is_null()) {
        (Some(found), false) => unsafe {
            guarded(|| {
                Place::new(finding, "finding")?.put(found);
                Ok(Status::Ok)
            })
        },
        (_, true) => guarded(|| Err(Trouble::new(Status::BadPointer, "finding is null"))),
        (None, false) => guarded(|| Err(Trouble::new(Status::BadArgument, format!("no finding {index}")))),
    }
}

/// What a status is, in a few words; never null.
#[unsafe(no_mangle)]
pub extern "C" fn denavit_status_text(status: Code<Status>) -> *const c_char {
    let words = match status.meant() {
        Some(Status::Ok) => c"done",
        Some(Status::Family) => c"all solutions, some of which hang together",
        Some(Status::Undecided) => c"solutions that may not be all",
        Some(Status::Unreachable) => c"out of reach",
        Some(Status::NotFound) => c"no solution found",
        Some(Status::OutsideLimits) => c"outside the limits of the joints",
        Some(Status::Jumped) => c"not near to where the joints were",
        Some(Status::BadPointer) => c"a null or misaligned pointer",
        Some(Status::WrongLength) => c"an array of another length",
        Some(Status::NotText) => c"a text that is no UTF-8",
        Some(Status::BadArgument) => c"an argument that does not fit",
        Some(Status::NotFinite) => c"a number that is infinite or none",
        Some(Status::NotARotation) => c"a matrix that is no pose",
        Some(Status::UnknownRobot) => c"no such robot",
        Some(Status::BadFile) => c"a file that cannot be read",
        Some(Status::BadDescription) => c"a description with errors",
        Some(Status::NoChain) => c"no such chain",
        Some(Status::MissingValue) => c"a parameter without value",
        Some(Status::NoMasses) => c"a robot without masses",
        Some(Status::Unsupported) => c"no such program or solver for this robot",
        Some(Status::Panic) => c"a fault of the library",
        None => c"no status",
    };
    words.as_ptr()
}

/// The version of the library: `0.1.0`.
#[unsafe(no_mangle)]
pub extern "C" fn denavit_version() -> *const c_char {
    const VERSION: &str = concat!(env!("CARGO_PKG_VERSION"), "\0");
    VERSION.as_ptr().cast()
}

/// A finding as C sees it, which is there as long as this one.
pub fn shown(found: &Found) -> Finding {
    Finding {
        severity: found.severity.into(),
        line: found.line,
        column: found.column,
        file: found.file.as_ptr(),
        message: found.message.as_ptr(),
        hint: found.hint.as_ref().map_or(ptr::null(), |h| h.as_ptr()),
        rendered: found.rendered.as_ptr(),
    }
}
