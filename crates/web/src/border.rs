//! What the page calls: a request of bytes in, an answer of bytes out, through one buffer.
//!
//! The page asks for room ([`request`]), writes JSON there, lets it be answered ([`answer`]) and reads so many bytes
//! from where [`text`] says. After a failure the buffer holds the words of the panic.

#![allow(unsafe_code)] // an exported name is declared with it; nothing here is unsafe to call

use std::cell::RefCell;
use std::sync::Once;

thread_local! {
    static BUFFER: RefCell<Vec<u8>> = const { RefCell::new(vec![]) };
}

/// Makes room for a request of so many bytes, and says where.
#[unsafe(no_mangle)]
pub extern "C" fn request(bytes: usize) -> *const u8 {
    BUFFER.with_borrow_mut(|buffer| {
        buffer.clear();
        buffer.resize(bytes, 0);
        buffer.as_ptr()
    })
}

/// Answers the request in the buffer; the length of the answer.
#[unsafe(no_mangle)]
pub extern "C" fn answer() -> usize {
    exchange(crate::answer)
}

/// The same for solutions of poses; the code of this one and of those below is loaded when it is first needed.
#[unsafe(no_mangle)]
pub extern "C" fn answer_inverse() -> usize {
    exchange(crate::answer_inverse)
}

/// The same for what is derived.
#[unsafe(no_mangle)]
pub extern "C" fn answer_more() -> usize {
    exchange(crate::answer_more)
}

/// The same for descriptions that others wrote.
#[unsafe(no_mangle)]
pub extern "C" fn answer_read() -> usize {
    exchange(crate::answer_read)
}

/// The same for reports and source code.
#[unsafe(no_mangle)]
pub extern "C" fn answer_written() -> usize {
    exchange(crate::answer_written)
}

/// The same for documents that are checked.
#[unsafe(no_mangle)]
pub extern "C" fn answer_check() -> usize {
    exchange(crate::answer_check)
}

fn exchange(answer: impl FnOnce(&str) -> String) -> usize {
    HOOK.call_once(|| std::panic::set_hook(Box::new(complain)));
    let request = BUFFER.with_borrow_mut(std::mem::take);
    let text = answer(&String::from_utf8_lossy(&request));
    BUFFER.with_borrow_mut(|buffer| {
        *buffer = text.into_bytes();
        buffer.len()
    })
}

static HOOK: Once = Once::new();

/// Leaves the words of a panic in the buffer.
fn complain(info: &std::panic::PanicHookInfo) {
    let _ = BUFFER.try_with(|buffer| {
        if let Ok(mut buffer) = buffer.try_borrow_mut() {
            *buffer = info.to_string().into_bytes();
        }
    });
}

/// Where the answer stands.
#[unsafe(no_mangle)]
pub extern "C" fn text() -> *const u8 {
    BUFFER.with_borrow(|buffer| buffer.as_ptr())
}

/// How long what stands there is.
#[unsafe(no_mangle)]
pub extern "C" fn length() -> usize {
    BUFFER.with_borrow(Vec::len)
}
