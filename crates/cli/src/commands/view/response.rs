//! Answers: what every one of them tells the browser to refuse, and the file or the reason why there is none.

use super::request::Asked;
use std::io;

/// A status that is answered.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Status(u16, &'static str);

impl Status {
    const OK: Status = Status(200, "OK");
    /// What has arrived is no request, or can be read in two ways.
    pub const BAD_REQUEST: Status = Status(400, "Bad Request");
    /// A page of somebody else asks.
    pub const FORBIDDEN: Status = Status(403, "Forbidden");
    /// There is nothing under this address.
    pub const NOT_FOUND: Status = Status(404, "Not Found");
    /// Neither GET nor HEAD.
    pub const METHOD_NOT_ALLOWED: Status = Status(405, "Method Not Allowed");
    /// The head did not arrive in time.
    pub const TIMED_OUT: Status = Status(408, "Request Timeout");
    /// Something follows the head.
    pub const BODY_TOO_LARGE: Status = Status(413, "Content Too Large");
    /// The request names another server.
    pub const MISDIRECTED: Status = Status(421, "Misdirected Request");
    /// The head is longer than any that a browser sends here.
    pub const HEAD_TOO_LARGE: Status = Status(431, "Request Header Fields Too Large");
    /// Another version than HTTP/1.1.
    pub const VERSION_NOT_SUPPORTED: Status = Status(505, "HTTP Version Not Supported");
}

/// Scripts, styles, pictures and requests of the page itself, WebAssembly, and nothing else; no page around it.
/// There is no field that lets another page read an answer.
const FIELDS: &str = "\
Content-Security-Policy: default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self'; style-src 'self'; \
img-src 'self' blob: data:; font-src 'self'; connect-src 'self'; base-uri 'none'; form-action 'none'; \
frame-ancestors 'none'\r\n\
X-Content-Type-Options: nosniff\r\n\
Referrer-Policy: no-referrer\r\n\
Cross-Origin-Opener-Policy: same-origin\r\n\
Cross-Origin-Resource-Policy: same-origin\r\n\
Cache-Control: no-store\r\n\
Connection: close\r\n";

/// The answer with the file.
///
/// # Errors
/// If the file was not compressed by gzip.
pub fn answer(asked: &Asked) -> io::Result<Vec<u8>> {
    let file = asked.file;
    if asked.takes_gzip {
        let encoding = "Content-Encoding: gzip\r\n";
        return Ok(message(Status::OK, file.content_type, encoding, &file.gzip, asked.head_only));
    }
    Ok(message(Status::OK, file.content_type, "", &file.plain()?, asked.head_only))
}

/// The answer that says no.
pub fn refusal(status: Status) -> Vec<u8> {
    let fields = if status == Status::METHOD_NOT_ALLOWED { "Allow: GET, HEAD\r\n" } else { "" };
    let text = format!("{}\n", status.1);
    message(status, "text/plain; charset=utf-8", fields, text.as_bytes(), false)
}

fn message(status: Status, content_type: &str, fields: &str, body: &[u8], head_only: bool) -> Vec<u8> {
    let Status(code, reason) = status;
    let length = body.len();
    let mut bytes = format!(
        "HTTP/1.1 {code} {reason}\r\n{FIELDS}{fields}Content-Type: {content_type}\r\nContent-Length: {length}\r\n\r\n"
    )
    .into_bytes();
    if !head_only {
        bytes.extend_from_slice(body);
    }
    bytes
}
