//! Attempts on the server, over its socket.
//!
//! The times that a client may take are shortened so that the tests are quick; what they wait for is long.

use super::packing::packed;
use super::server::{Bounds, Server};
use super::site::Site;
use flate2::read::GzDecoder;
use std::io::{Read, Write};
use std::net::TcpStream;
use std::thread;
use std::time::{Duration, Instant};

/// What a server that works has done long ago, on any machine.
const LONG: Duration = Duration::from_secs(20);
const SCRIPT: &str = "export const answer = 42;\n";

/// A server that runs, and its token.
struct Running {
    port: u16,
    token: String,
}

/// Starts a server of a few small files, which ends with the tests.
fn start(bounds: Bounds) -> Running {
    let index = b"<!doctype html><html><head><title>t</title></head></html>";
    start_with(&[("index.html", index), ("main.js", SCRIPT.as_bytes())], bounds)
}

fn start_with(contents: &[(&str, &[u8])], bounds: Bounds) -> Running {
    let files = contents.iter().map(|(name, bytes)| packed(name, bytes).expect("in memory"));
    started(Site::of(files.collect()).with_robot("name = \"arm\"\n").expect("a head"), bounds)
}

fn started(site: Site, bounds: Bounds) -> Running {
    let server = Server::bind(site, 0, bounds).expect("a free port");
    let address = server.address();
    thread::spawn(move || server.run());
    let rest = address.strip_prefix("http://127.0.0.1:").expect("this machine");
    let (port, path) = rest.split_once('/').expect("a path");
    Running { port: port.parse().expect("a port"), token: path.trim_end_matches('/').into() }
}

fn quick() -> Running {
    start(Bounds { farewell: Duration::from_millis(200), ..Bounds::default() })
}

impl Running {
    fn connect(&self) -> TcpStream {
        let stream = TcpStream::connect(("127.0.0.1", self.port)).expect("the server listens");
        stream.set_read_timeout(Some(LONG)).expect("a time");
        stream.set_write_timeout(Some(LONG)).expect("a time");
        stream
    }

    /// Sends bytes with the server's port and token in the places of PORT and TOKEN; what is answered until the end.
    fn raw(&self, request: &str) -> Vec<u8> {
        let request = request.replace("PORT", &self.port.to_string()).replace("TOKEN", &self.token);
        let mut stream = self.connect();
        // A server that refuses may close before it has read everything.
        let _ = stream.write_all(request.as_bytes());
        read(&mut stream)
    }

    fn ask(&self, request: &str) -> String {
        String::from_utf8_lossy(&self.raw(request)).into_owned()
    }

    /// A request as a browser sends it, with more fields.
    fn get(&self, path: &str, fields: &str) -> String {
        self.ask(&format!("GET {path} HTTP/1.1\r\nHost: 127.0.0.1:PORT\r\n{fields}\r\n"))
    }

    #[track_caller]
    fn check(&self, request: &str, status: u16) {
        let answer = self.ask(request);
        let shown: String = request.chars().take(120).collect();
        assert!(answer.starts_with(&format!("HTTP/1.1 {status} ")), "{shown:?}: {answer:?}");
        if status != 200 {
            assert!(!answer.contains(&self.token), "{shown:?} is told the token");
            assert!(!answer.contains("denavit"), "{shown:?} is told what this is");
        }
    }
}

/// Everything until the end, which an error is, too.
fn read(stream: &mut TcpStream) -> Vec<u8> {
    let (mut bytes, mut part) = (vec![], [0; 65536]);
    while let Ok(n @ 1..) = stream.read(&mut part) {
        bytes.extend_from_slice(&part[..n]);
    }
    bytes
}

fn body(answer: &[u8]) -> &[u8] {
    let end = answer.windows(4).position(|w| w == b"\r\n\r\n").expect("a whole head");
    &answer[end + 4..]
}

#[test]
fn the_files_are_served() {
    let server = quick();
    let index = server.get("/TOKEN/", "");
    assert!(index.starts_with("HTTP/1.1 200 OK\r\n"), "{index}");
    assert!(index.contains("<head>\n<meta name=\"denavit-robot\" content=\"robot.toml\"><title>"), "{index}");
    assert!(index.contains("Content-Type: text/html; charset=utf-8\r\n"), "{index}");
    let robot = server.get("/TOKEN/robot.toml", "");
    assert!(robot.ends_with("\r\n\r\nname = \"arm\"\n"), "{robot}");
    let script = server.get("/TOKEN/main.js", "");
    assert!(script.contains("Content-Type: text/javascript; charset=utf-8\r\n"), "{script}");
    assert!(script.contains(&format!("Content-Length: {}\r\n", SCRIPT.len())), "{script}");
    assert!(script.ends_with(SCRIPT) && !script.contains("Content-Encoding"), "{script}");
    let by_name = "GET /TOKEN/main.js HTTP/1.1\r\nhOST:localhost:PORT\r\n\r\n";
    server.check(by_name, 200);
    let head = server.ask(&by_name.replace("GET", "HEAD"));
    assert!(head.contains(&format!("Content-Length: {}\r\n", SCRIPT.len())), "{head}");
    assert!(head.ends_with("\r\n\r\n"), "{head}");
}

#[test]
fn meshes_have_numbers_and_no_name_leads_to_a_file() {
    let folder = std::env::temp_dir().join(format!("denavit-view-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let (mesh, secret) = (folder.join("arm.stl"), folder.join("secret.stl"));
    std::fs::write(&mesh, b"solid arm").expect("a mesh");
    std::fs::write(&secret, b"solid secret").expect("another");
    let index = b"<!doctype html><html><head></head></html>";
    let site = Site::of(vec![packed("index.html", index).expect("in memory")]);
    let site = site.with_tree("{\"name\":\"arm\"}", &[mesh]).expect("a head, a mesh");
    let missing = Site::of(vec![packed("index.html", index).expect("in memory")]);
    assert!(missing.with_tree("{}", &[folder.join("none.stl")]).is_err());
    let server = started(site, Bounds { farewell: Duration::from_millis(200), ..Bounds::default() });
    assert!(server.get("/TOKEN/", "").contains("<meta name=\"denavit-robot\" content=\"robot.json\">"));
    assert!(server.get("/TOKEN/robot.json", "").ends_with("{\"name\":\"arm\"}"));
    // What is served is what was there at the start.
    std::fs::remove_dir_all(&folder).expect("it is ours");
    let answer = server.get("/TOKEN/mesh/0", "");
    assert!(answer.contains("Content-Type: application/octet-stream\r\n"), "{answer}");
    assert!(answer.contains("connect-src 'self';") && answer.ends_with("\r\n\r\nsolid arm"), "{answer}");
    let names = [
        "1",
        "arm.stl",
        "secret.stl",
        "00",
        "0/",
        "../robot.toml",
        "0/../1",
        "%30",
        "-1",
        "18446744073709551616",
        "",
    ];
    for name in names {
        server.check(&format!("GET /TOKEN/mesh/{name} HTTP/1.1\r\nHost: 127.0.0.1:PORT\r\n\r\n"), 404);
    }
}

#[test]
fn answers_are_compressed_for_who_takes_it() {
    let server = quick();
    for (accepts, expected) in [
        ("gzip", true),
        ("br, GZIP;q=0.5", true),
        ("deflate\r\nAccept-Encoding: gzip", true),
        ("gzip;q=0", false),
        ("gzip; q=0.000", false),
        ("gzip;q=x", false),
        ("br", false),
        ("gzipped", false),
    ] {
        let request = format!(
            "GET /TOKEN/main.js HTTP/1.1\r\nHost: 127.0.0.1:PORT\r\nAccept-Encoding: {accepts}\r\n\r\n"
        );
        let answer = server.raw(&request);
        let is_compressed = String::from_utf8_lossy(&answer).contains("Content-Encoding: gzip\r\n");
        assert_eq!(is_compressed, expected, "{accepts}");
        let mut text = String::new();
        if is_compressed {
            GzDecoder::new(body(&answer)).read_to_string(&mut text).expect("gzip");
        } else {
            text = String::from_utf8_lossy(body(&answer)).into_owned();
        }
        assert_eq!(text, SCRIPT, "{accepts}");
    }
}

#[test]
fn every_answer_says_what_the_page_may_do() {
    let server = quick();
    for answer in [server.get("/TOKEN/", ""), server.get("/", ""), server.ask("POST / HTTP/1.1\r\n\r\n")] {
        for field in [
            "Content-Security-Policy: default-src 'none'; script-src 'self' 'wasm-unsafe-eval';",
            "frame-ancestors 'none'\r\n",
            "X-Content-Type-Options: nosniff\r\n",
            "Referrer-Policy: no-referrer\r\n",
            "Cross-Origin-Opener-Policy: same-origin\r\n",
            "Cross-Origin-Resource-Policy: same-origin\r\n",
            "Cache-Control: no-store\r\n",
            "Connection: close\r\n",
        ] {
            assert!(answer.contains(field), "{field} is missing in {answer}");
        }
        assert!(!answer.to_lowercase().contains("access-control-"), "{answer}");
    }
}

#[test]
fn another_host_is_refused() {
    let server = quick();
    let other = server.port ^ 1;
    for (hosts, status) in [
        ("Host: evil.com\r\n", 421),
        ("Host: evil.com:PORT\r\n", 421),
        ("Host: 127.0.0.1\r\n", 421),
        (&format!("Host: 127.0.0.1:{other}\r\n"), 421),
        ("Host: 127.0.0.1:PORT0\r\n", 421),
        ("Host: 127.0.0.1.evil.com:PORT\r\n", 421),
        ("Host: localhost.:PORT\r\n", 421),
        ("Host: user@localhost:PORT\r\n", 421),
        ("Host: 0.0.0.0:PORT\r\n", 421),
        ("Host: 2130706433:PORT\r\n", 421),
        ("Host: [::1]:PORT\r\n", 421),
        ("Host:\r\n", 421),
        ("X-Forwarded-Host: localhost:PORT\r\nHost: evil.com\r\n", 421),
        ("", 400),
        ("X-Host: localhost:PORT\r\n", 400),
        ("Host: localhost:PORT\r\nHost: localhost:PORT\r\n", 400),
        ("Host: localhost:PORT\r\nHost: evil.com\r\n", 400),
        ("Host: localhost:PORT\r\n", 200),
        ("Host: 127.0.0.1:PORT\r\n", 200),
    ] {
        server.check(&format!("GET /TOKEN/ HTTP/1.1\r\n{hosts}\r\n"), status);
    }
}

#[test]
fn without_the_token_there_is_nothing() {
    let server = quick();
    let swapped: String = server.token.chars().rev().collect();
    let (half, loud) = (&server.token[..16], server.token.to_uppercase());
    let reference = server.get("/", "");
    for path in [
        "/",
        "/index.html",
        "/main.js",
        "/robot.toml",
        "//",
        "//main.js",
        "/TOKEN",
        "/TOKEN0/",
        "/TOKEN%00/",
        "/?TOKEN/",
        "/x/TOKEN/",
        &format!("/{half}/"),
        &format!("/{swapped}/"),
        &format!("/{loud}{loud}/"),
        &format!("/{}/main.js", "0".repeat(32)),
    ] {
        assert_eq!(server.get(path, ""), reference, "{path}");
    }
    assert!(reference.starts_with("HTTP/1.1 404 Not Found\r\n"), "{reference}");
    assert_eq!(server.token.len(), 32);
    assert_ne!(server.token, quick().token, "a token is drawn anew");
}

#[test]
fn no_other_file_can_be_named() {
    let server = quick();
    let reference = server.get("/", "");
    for name in [
        "x",
        "../x",
        "../main.js",
        "./main.js",
        "/main.js",
        "main.js/",
        "main.js/..",
        "..",
        "....//",
        "main.js?x=1",
        "main.js;x",
        "MAIN.JS",
        "%2e%2e/x",
        "%2e%2e%2fx",
        "main%2ejs",
        "%6dain.js",
        "..%2f..%2fetc%2fpasswd",
        "..%c0%af",
        "..\\x",
        "..\\..\\x",
        "main.js%00",
        "main.js.gz",
        "../../../../../../etc/passwd",
        "src/main.rs",
        "Cargo.toml",
    ] {
        assert_eq!(server.get(&format!("/TOKEN/{name}"), ""), reference, "{name}");
    }
}

#[test]
fn what_is_no_plain_request_is_refused() {
    let server = quick();
    const HOST: &str = "Host: 127.0.0.1:PORT\r\n";
    for (start, status) in [
        ("GET http://127.0.0.1:PORT/TOKEN/ HTTP/1.1", 400),
        ("GET http://evil.com/TOKEN/ HTTP/1.1", 400),
        ("GET TOKEN/ HTTP/1.1", 400),
        ("GET * HTTP/1.1", 400),
        ("GET \\TOKEN\\ HTTP/1.1", 400),
        ("GET /TOKEN/\0 HTTP/1.1", 400),
        ("GET /TOKEN/main.js\0.html HTTP/1.1", 400),
        ("GET /TOKEN/ /x HTTP/1.1", 505),
        ("GET  /TOKEN/ HTTP/1.1", 400),
        ("GET /TOKEN/", 400),
        ("GET /TOKEN/ HTTP/1.0", 505),
        ("GET /TOKEN/ HTTP/0.9", 505),
        ("GET /TOKEN/ HTTP/2", 505),
        ("GET /TOKEN/ HTTP/3.1", 505),
        ("GET /TOKEN/ http/1.1", 505),
        ("GET /TOKEN/ HTTP/1.1\r\nno colon", 400),
        ("GET /TOKEN/ HTTP/1.1\r\nName : space", 400),
        ("GET /TOKEN/ HTTP/1.1\r\nX: a\r\n folded", 400),
        ("GET /TOKEN/ HTTP/1.1\r\nX: \0", 400),
        ("POST /TOKEN/ HTTP/1.1", 405),
        ("PUT /TOKEN/main.js HTTP/1.1", 405),
        ("DELETE /TOKEN/main.js HTTP/1.1", 405),
        ("PATCH /TOKEN/ HTTP/1.1", 405),
        ("TRACE /TOKEN/ HTTP/1.1", 405),
        ("OPTIONS * HTTP/1.1", 405),
        ("CONNECT 127.0.0.1:PORT HTTP/1.1", 405),
        ("get /TOKEN/ HTTP/1.1", 405),
        ("GETS /TOKEN/ HTTP/1.1", 405),
        ("GET /TOKEN/ HTTP/1.1", 200),
    ] {
        server.check(&format!("{start}\r\n{HOST}\r\n"), status);
    }
    // HTTP/2 with prior knowledge; TLS; another protocol; noise.
    server.check("PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n\0\0\0\u{4}\0\0\0\0\0", 505);
    server.check("\u{16}\u{3}\u{1}\u{2}\0\u{1}\0\u{1}\u{fc}", 400);
    server.check("EHLO x\r\n\r\n", 400);
    server.check("\0\0\0\0\0\0", 400);
    let mut noise = String::from("\u{1}");
    let mut seed = 1u32;
    for _ in 0..20_000 {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        noise.push(char::from((seed >> 24) as u8));
    }
    server.check(&noise, 400);
    server.check("GET /TOKEN/ HTTP/1.1\r\nHost: 127.0.0.1:PORT\r\n\r\n", 200);
}

#[test]
fn a_preflight_is_refused() {
    let server = quick();
    let answer = server.ask(
        "OPTIONS /TOKEN/ HTTP/1.1\r\nHost: 127.0.0.1:PORT\r\nOrigin: http://evil.com\r\n\
         Access-Control-Request-Method: GET\r\nAccess-Control-Request-Private-Network: true\r\n\r\n",
    );
    assert!(answer.starts_with("HTTP/1.1 405 "), "{answer}");
    assert!(answer.contains("Allow: GET, HEAD\r\n"), "{answer}");
    assert!(!answer.to_lowercase().contains("access-control-"), "{answer}");
}

#[test]
fn bodies_are_refused() {
    let server = quick();
    let huge = format!("Content-Length: 10000000000\r\n\r\n{}", "x".repeat(100_000));
    for (fields, status) in [
        ("Content-Length: 1\r\n\r\nx", 413),
        (&huge, 413),
        ("Content-Length: 99999999999999999999999999\r\n\r\n", 413),
        ("Content-Length: 5\r\nExpect: 100-continue\r\n\r\n", 413),
        ("Content-Length: -1\r\n\r\n", 400),
        ("Content-Length: +0\r\n\r\n", 400),
        ("Content-Length: 0x0\r\n\r\n", 400),
        ("Content-Length:\r\n\r\n", 400),
        ("Content-Length: 0\r\nContent-Length: 0\r\n\r\n", 400),
        ("Content-Length: 0\r\nContent-Length: 4\r\n\r\nabcd", 400),
        ("Content-Length: 0, 4\r\n\r\nabcd", 400),
        ("Transfer-Encoding: chunked\r\n\r\n0\r\n\r\n", 400),
        ("Transfer-Encoding: identity\r\n\r\n", 400),
        ("Content-Length: 4\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\nGET /x HTTP/1.1\r\n\r\n", 400),
        ("transfer-encoding: xchunked\r\nContent-Length: 0\r\n\r\n", 400),
        ("Content-Length: 0\r\n\r\n", 200),
    ] {
        server.check(&format!("GET /TOKEN/ HTTP/1.1\r\nHost: 127.0.0.1:PORT\r\n{fields}"), status);
    }
}

#[test]
fn one_connection_gets_one_answer() {
    let server = quick();
    let request = "GET /TOKEN/main.js HTTP/1.1\r\nHost: 127.0.0.1:PORT\r\nConnection: keep-alive\r\n\r\n";
    let answer = server.ask(&request.repeat(3));
    assert_eq!(answer.matches("HTTP/1.1 ").count(), 1, "{answer}");
    assert!(answer.ends_with(SCRIPT), "{answer}");
}

#[test]
fn heads_are_bounded() {
    let server = quick();
    let start = "GET /TOKEN/ HTTP/1.1\r\nHost: 127.0.0.1:PORT\r\n";
    let field = |n: usize| format!("{start}X: {}\r\n\r\n", "x".repeat(n));
    server.check(&field(7_500), 200);
    server.check(&field(8_192), 431);
    server.check(&field(5_000_000), 431);
    server.check(&format!("GET /{} HTTP/1.1\r\n\r\n", "x".repeat(100_000)), 431);
    server.check(&format!("{start}{}\r\n", "X: y\r\n".repeat(60)), 200);
    server.check(&format!("{start}{}\r\n", "X: y\r\n".repeat(100)), 431);
}

#[test]
fn pages_of_others_get_nothing() {
    let server = quick();
    const LINK: &str = "Sec-Fetch-Mode: navigate\r\nSec-Fetch-Dest: document\r\n";
    const FRAME: &str = "Sec-Fetch-Mode: navigate\r\nSec-Fetch-Dest: iframe\r\n";
    const FETCH: &str = "Sec-Fetch-Mode: cors\r\nSec-Fetch-Dest: empty\r\n";
    const IMAGE: &str = "Sec-Fetch-Mode: no-cors\r\nSec-Fetch-Dest: image\r\n";
    for (site, rest, path, status) in [
        ("same-origin", FETCH, "/TOKEN/main.js", 200),
        ("none", LINK, "/TOKEN/", 200),
        ("none", LINK, "/TOKEN/robot.toml", 200),
        ("cross-site", LINK, "/TOKEN/", 200),
        ("same-site", LINK, "/TOKEN/", 200),
        ("cross-site", FRAME, "/TOKEN/", 403),
        ("cross-site", FETCH, "/TOKEN/", 403),
        ("cross-site", IMAGE, "/TOKEN/", 403),
        ("cross-site", FETCH, "/TOKEN/main.js", 403),
        ("cross-site", LINK, "/TOKEN/robot.toml", 403),
        ("same-site", FETCH, "/TOKEN/robot.toml", 403),
        ("same-origin\r\nSec-Fetch-Site: cross-site", FETCH, "/TOKEN/main.js", 403),
        // Whether the token is right cannot be seen from the refusal.
        ("cross-site", FETCH, "/wrong/main.js", 403),
        ("cross-site", IMAGE, "/wrong/", 403),
        ("cross-site", LINK, "/wrong/", 404),
    ] {
        let fields = format!("Sec-Fetch-Site: {site}\r\n{rest}Origin: http://evil.com\r\n");
        let request = format!("GET {path} HTTP/1.1\r\nHost: 127.0.0.1:PORT\r\n{fields}\r\n");
        server.check(&request, status);
    }
}

#[test]
fn a_slow_client_is_cut_off_while_others_are_served() {
    let server = start(Bounds { head: Duration::from_millis(700), ..Bounds::default() });
    let mut slow = server.connect();
    slow.set_read_timeout(Some(Duration::from_millis(20))).expect("a time");
    let start = Instant::now();
    let (mut sent, mut answer, mut is_open) = (0, vec![], true);
    // A byte every 20 ms is never late by itself; the head as a whole is.
    while is_open {
        assert!(start.elapsed() < LONG, "still open after {sent} bytes");
        is_open = slow.write_all(if sent == 0 { b"GET /" } else { b"x" }).is_ok();
        sent += 1;
        let mut part = [0; 4096];
        match slow.read(&mut part) {
            Ok(0) => is_open = false,
            Ok(n) => answer.extend_from_slice(&part[..n]),
            Err(e) => {
                is_open &= matches!(e.kind(), std::io::ErrorKind::WouldBlock | std::io::ErrorKind::TimedOut)
            }
        }
        if sent == 5 {
            server.check("GET /TOKEN/ HTTP/1.1\r\nHost: 127.0.0.1:PORT\r\n\r\n", 200);
        }
    }
    assert!(sent > 5, "cut off before its time");
    assert!(answer.is_empty() || answer.starts_with(b"HTTP/1.1 408 "), "{answer:?}");
    // One that says nothing at all is closed without a word.
    assert!(read(&mut server.connect()).is_empty());
}

#[test]
fn idle_connections_keep_nobody_out() {
    // The time of a head is so long that only making room helps.
    let bounds = Bounds { head: 10 * LONG, connections: 4, ..Bounds::default() };
    let server = start(bounds);
    let mut idle: Vec<TcpStream> = (0..60)
        .map(|k| {
            let mut stream = server.connect();
            if k % 2 == 0 {
                stream.write_all(b"GET /").expect("room for five bytes");
            }
            stream
        })
        .collect();
    server.check("GET /TOKEN/ HTTP/1.1\r\nHost: 127.0.0.1:PORT\r\n\r\n", 200);
    // All but the last few are closed; those are not.
    let last = idle.split_off(60 - (bounds.connections - 1));
    for mut stream in idle {
        assert!(read(&mut stream).is_empty());
    }
    for mut stream in last {
        stream.set_read_timeout(Some(Duration::from_millis(20))).expect("a time");
        let error = stream.read(&mut [0]).expect_err("it is open");
        assert!(
            matches!(error.kind(), std::io::ErrorKind::WouldBlock | std::io::ErrorKind::TimedOut),
            "{error}"
        );
    }
}

#[test]
fn a_client_that_takes_nothing_is_cut_off() {
    const LARGE: usize = 64 << 20;
    let bounds = Bounds { answer: Duration::from_secs(1), connections: 1, ..Bounds::default() };
    let files: [(&str, &[u8]); 2] = [("index.html", b"<head>"), ("large.wasm", &[0; LARGE])];
    let server = start_with(&files, bounds);
    let request =
        format!("GET /{}/large.wasm HTTP/1.1\r\nHost: localhost:{}\r\n\r\n", server.token, server.port);
    let mut greedy = server.connect();
    greedy.write_all(request.as_bytes()).expect("room for a line");
    greedy.read_exact(&mut [0; 16]).expect("it is being answered");
    // It has the only place, and keeps it as long as an answer may take.
    assert!(server.get("/TOKEN/", "").is_empty(), "a place beside the only one");
    let start = Instant::now();
    while server.get("/TOKEN/", "").is_empty() {
        assert!(start.elapsed() < LONG, "no place after all");
        thread::sleep(Duration::from_millis(50));
    }
    assert!(read(&mut greedy).len() < LARGE, "served after its time");
    // Whoever takes it gets it whole.
    let patient = start_with(&files, Bounds { answer: LONG, ..bounds });
    let whole = patient.raw("GET /TOKEN/large.wasm HTTP/1.1\r\nHost: localhost:PORT\r\n\r\n");
    assert_eq!(body(&whole).len(), LARGE);
}

#[test]
fn the_same_files_give_the_same_bytes() {
    let [a, b] = [(); 2].map(|()| packed("main.js", SCRIPT.as_bytes()).expect("in memory").gzip);
    assert_eq!(a, b);
    assert_eq!(&a[4..8], [0; 4], "no time in the header");
}

#[test]
fn a_page_without_head_takes_no_robot() {
    let site = Site::of(vec![packed("index.html", b"<p>").expect("in memory")]);
    let error = site.with_robot("").err().expect("a refusal");
    assert_eq!(error.to_string(), "index.html has no <head>");
}
