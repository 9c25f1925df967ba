//! What a browser asks for, and whether it gets it.
//!
//! Whoever can connect to a port of this machine may be another page in the same browser, or another person. A request
//! is answered if it names this server (else a foreign name may have been pointed here, DNS rebinding), is a plain GET
//! or HEAD without a body, does not come from a page of somebody else, and knows the token. No refusal tells more than
//! the one who asked knew already: what is checked before the token does not depend on it.

use super::response::Status;
use super::server::Door;
use super::site::File;
use httparse::{EMPTY_HEADER, Error, Header, Request};
use std::hint::black_box;

/// The longest head that is read, bytes.
pub const MAX_HEAD: usize = 8192;
/// The most header fields.
const MAX_FIELDS: usize = 64;

/// What a head asks for.
pub struct Asked<'a> {
    /// The file.
    pub file: &'a File,
    /// Whether only the head of the answer is wanted.
    pub head_only: bool,
    /// Whether the answer may be compressed.
    pub takes_gzip: bool,
}

/// The head that has arrived so far: `None` while it is not whole.
///
/// # Errors
/// The refusal, as soon as it is certain.
pub fn judge<'a>(head: &[u8], door: &'a Door) -> Result<Option<Asked<'a>>, Status> {
    let mut fields = [EMPTY_HEADER; MAX_FIELDS];
    let mut request = Request::new(&mut fields);
    match request.parse(head) {
        Ok(status) if status.is_complete() => asked(&request, door).map(Some),
        Ok(_) if head.len() >= MAX_HEAD => Err(Status::HEAD_TOO_LARGE),
        Ok(_) => Ok(None),
        Err(Error::TooManyHeaders) => Err(Status::HEAD_TOO_LARGE),
        Err(Error::Version) => Err(Status::VERSION_NOT_SUPPORTED),
        Err(_) => Err(Status::BAD_REQUEST),
    }
}

fn asked<'a>(request: &Request, door: &'a Door) -> Result<Asked<'a>, Status> {
    if request.version != Some(1) {
        return Err(Status::VERSION_NOT_SUPPORTED);
    }
    let fields = &*request.headers;
    host(fields, door)?;
    let head_only = match request.method {
        Some("GET") => false,
        Some("HEAD") => true,
        _ => return Err(Status::METHOD_NOT_ALLOWED),
    };
    body(fields)?;
    // Neither another server's address nor `*`.
    let target = request.path.and_then(|p| p.strip_prefix('/')).ok_or(Status::BAD_REQUEST)?;
    origin(fields, target.ends_with('/'))?;
    let (token, name) = target.split_once('/').ok_or(Status::NOT_FOUND)?;
    if !same(token.as_bytes(), door.token.as_bytes()) {
        return Err(Status::NOT_FOUND);
    }
    // Names are compared letter by letter, so that no spelling of `..` means anything.
    let file = door.site.file(name).ok_or(Status::NOT_FOUND)?;
    Ok(Asked { file, head_only, takes_gzip: takes_gzip(fields) })
}

/// All values of a field, whatever the case of its name.
fn values<'f>(fields: &'f [Header<'f>], name: &str) -> impl Iterator<Item = &'f [u8]> {
    fields.iter().filter(move |f| f.name.eq_ignore_ascii_case(name)).map(|f| f.value)
}

/// The one name of this server under which it was asked.
fn host(fields: &[Header], door: &Door) -> Result<(), Status> {
    let mut given = values(fields, "host");
    match (given.next(), given.next()) {
        (Some(host), None) if door.hosts.iter().any(|h| h.as_bytes() == host) => Ok(()),
        (Some(_), None) => Err(Status::MISDIRECTED),
        _ => Err(Status::BAD_REQUEST),
    }
}

/// That nothing follows the head. Two ways to say how much follows may be read in two ways, so that is refused first.
fn body(fields: &[Header]) -> Result<(), Status> {
    let mut lengths = values(fields, "content-length");
    match (values(fields, "transfer-encoding").next(), lengths.next(), lengths.next()) {
        (None, None | Some(b"0"), None) => Ok(()),
        (None, Some(n), None) if !n.is_empty() && n.iter().all(u8::is_ascii_digit) => {
            Err(Status::BODY_TOO_LARGE)
        }
        _ => Err(Status::BAD_REQUEST),
    }
}

/// Browsers say from whose page a request comes. A page of somebody else may lead to this one, as a link does, but not
/// use a part of it.
fn origin(fields: &[Header], is_index: bool) -> Result<(), Status> {
    let all = |name, right: &[&[u8]]| values(fields, name).all(|v| right.contains(&v));
    let has = |name, right: &[u8]| values(fields, name).any(|v| v == right);
    let own = all("sec-fetch-site", &[b"same-origin", b"none"]);
    let led = is_index && has("sec-fetch-mode", b"navigate") && has("sec-fetch-dest", b"document");
    if own || led { Ok(()) } else { Err(Status::FORBIDDEN) }
}

/// Whether two texts are the same, in a time that does not tell where they differ.
fn same(a: &[u8], b: &[u8]) -> bool {
    a.len() == b.len() && black_box(a.iter().zip(b).fold(0, |sum, (x, y)| sum | (x ^ y))) == 0
}

/// Whether `Accept-Encoding` names gzip, and not with the weight 0.
fn takes_gzip(fields: &[Header]) -> bool {
    let listed = values(fields, "accept-encoding").filter_map(|v| std::str::from_utf8(v).ok());
    listed.flat_map(|v| v.split(',')).any(|coding| {
        let mut parts = coding.split(';').map(str::trim);
        let named = parts.next().is_some_and(|name| name.eq_ignore_ascii_case("gzip"));
        let weight = parts.find_map(|p| p.strip_prefix("q=").or(p.strip_prefix("Q=")));
        named && weight.is_none_or(|w| w.parse::<f32>().is_ok_and(|w| w > 0.0))
    })
}
