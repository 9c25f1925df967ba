//! `denavit view` as it is run: the address that it prints, what is under it, and how it ends.

use crate::common::{fed, text};
use denavit::catalogue;
use denavit::description::read_toml;
use serde_json::Value;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

const INDEX: &str = "<!doctype html><html lang=\"en\"><head><title>t</title></head><body></body></html>";

/// A page of two files in a folder of its own.
fn page(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("denavit-view-{name}-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    std::fs::write(folder.join("index.html"), INDEX).expect("a file");
    std::fs::write(folder.join("main.js"), "export {};\n").expect("a file");
    folder
}

/// The command while it runs.
struct Viewed {
    child: Child,
    address: String,
}

impl Viewed {
    fn start(arguments: &[&str]) -> Viewed {
        Viewed::start_by(Command::new(env!("CARGO_BIN_EXE_denavit")), arguments)
    }

    fn start_by(mut command: Command, arguments: &[&str]) -> Viewed {
        let mut child = command
            .arg("view")
            .args(arguments)
            .args(["--no-open", "--json"])
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("the command starts");
        let mut line = String::new();
        let stdout = child.stdout.take().expect("a pipe");
        BufReader::new(stdout).read_line(&mut line).expect("a line");
        let value: Value = serde_json::from_str(&line).unwrap_or_else(|e| panic!("{line:?}: {e}"));
        assert_eq!(value["schema"], 1);
        Viewed { child, address: value["url"].as_str().expect("an address").into() }
    }

    /// The whole answer to a request for a file.
    fn get(&self, name: &str) -> String {
        let (host, path) =
            self.address.strip_prefix("http://").and_then(|a| a.split_once('/')).expect("an address");
        let mut stream = TcpStream::connect(host).expect("it listens");
        stream.set_read_timeout(Some(Duration::from_secs(30))).expect("a time");
        let request = format!("GET /{path}{name} HTTP/1.1\r\nHost: {host}\r\n\r\n");
        stream.write_all(request.as_bytes()).expect("room for a line");
        let mut answer = vec![];
        stream.read_to_end(&mut answer).expect("an answer");
        text(&answer)
    }

    fn body(&self, name: &str) -> String {
        let answer = self.get(name);
        assert!(answer.starts_with("HTTP/1.1 200 OK\r\n"), "{name}: {answer}");
        answer.split_once("\r\n\r\n").expect("a head").1.into()
    }
}

impl Drop for Viewed {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn path(folder: &Path) -> &str {
    folder.to_str().expect("UTF-8")
}

#[test]
fn a_robot_is_handed_to_the_page() {
    let folder = page("robot");
    let viewed = Viewed::start(&["ur5", "--page", path(&folder)]);
    assert!(viewed.address.starts_with("http://127.0.0.1:") && viewed.address.ends_with('/'));
    let mention = "<head>\n<meta name=\"denavit-robot\" content=\"robot.toml\">";
    assert_eq!(viewed.body(""), INDEX.replace("<head>", mention));
    assert_eq!(viewed.body("main.js"), "export {};\n");
    assert_eq!(Some(&viewed.body("robot.toml")[..]), catalogue::text("ur5"));
    assert!(viewed.get("../").starts_with("HTTP/1.1 404 "));

    // A table, and a robot that is not as its file has it, are written as robot files.
    let table = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/documents/cylindrical-arm.md");
    for robot in [&[table][..], &["puma560", "--set", "d6=30mm"]] {
        let toml = Viewed::start(&[robot, &["--page", path(&folder)]].concat()).body("robot.toml");
        let shown = fed(&[&["show"][..], robot, &["--toml"]].concat(), "");
        assert_eq!(toml, text(&shown.stdout), "{robot:?}");
        read_toml(&toml).unwrap_or_else(|e| panic!("{robot:?}: {e:?}"));
    }

    let without = Viewed::start(&["--page", path(&folder)]);
    assert_eq!(without.body(""), INDEX);
    assert!(without.get("robot.toml").starts_with("HTTP/1.1 404 "));
    std::fs::remove_dir_all(folder).expect("it is there");
}

#[test]
fn what_cannot_be_shown_is_refused() {
    let folder = page("refused");
    let taken = TcpListener::bind("127.0.0.1:0").expect("a free port");
    let port = taken.local_addr().expect("an address").port().to_string();
    std::fs::create_dir_all(folder.join("empty")).expect("a folder");
    let empty = folder.join("empty");
    for (arguments, code, says) in [
        (&["view", "nobody"][..], 3, "no robot or file `nobody`"),
        (&["view", "arm.urdf"], 3, "error: arm.urdf: "),
        (&["view", "--set", "d6=1"], 2, "not provided: robot"),
        (&["view", "--port", "70000"], 2, "70000"),
        (&["view", "--page", path(&empty)], 3, "no index.html in it"),
        (&["view", "--page", path(&empty.join("none"))], 3, "error: "),
        (&["view", "--no-open", "--page", path(&folder), "--port", &port], 2, "--port "),
    ] {
        let output = fed(arguments, "");
        let stderr = text(&output.stderr);
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {stderr}");
        assert!(stderr.contains(says), "{arguments:?}: {stderr}");
        assert!(output.stdout.is_empty(), "{arguments:?}: data after a refusal");
    }
    std::fs::remove_dir_all(folder).expect("it is there");
}

/// With the page in the program it is served; without, one line says how to get it.
#[test]
fn the_page_in_the_program() {
    if env!("DENAVIT_PAGE_FILES") == "0" {
        let output = fed(&["view", "ur5"], "");
        assert_eq!(output.status.code(), Some(4));
        let line = "not supported: this binary was built without the page: run `cargo xtask web`, then build again\n";
        assert_eq!(text(&output.stderr), line);
        return;
    }
    let index = Viewed::start(&["ur5"]).body("");
    assert!(index.contains("content=\"robot.toml\""), "{index}");
}

/// The command with an interrupt's usual effect: where this process ignores it (started by a script with `&`, or by nohup),
/// a child inherits that, and GNU's `env` puts it right.
#[cfg(unix)]
fn interruptible() -> Command {
    let words = ["--default-signal=INT", env!("CARGO_BIN_EXE_denavit")];
    let is_there =
        Command::new("env").args(words).arg("--version").output().is_ok_and(|o| o.status.success());
    let mut command = Command::new(if is_there { "env" } else { words[1] });
    command.args(if is_there { &words[..] } else { &[] });
    command
}

#[cfg(unix)]
#[test]
fn it_ends_with_an_interrupt() {
    use std::os::unix::process::ExitStatusExt;
    let folder = page("interrupt");
    let mut viewed = Viewed::start_by(interruptible(), &["--page", path(&folder)]);
    let id = viewed.child.id().to_string();
    let interrupt = Command::new("kill").args(["-INT", &id]).status().expect("kill starts");
    assert!(interrupt.success());
    let deadline = Instant::now() + Duration::from_secs(30);
    let status = loop {
        match viewed.child.try_wait().expect("it is our child") {
            Some(status) => break status,
            None => assert!(Instant::now() < deadline, "the interrupt does not end it"),
        }
        std::thread::sleep(Duration::from_millis(10));
    };
    assert_eq!(status.signal(), Some(2));
    std::fs::remove_dir_all(folder).expect("it is there");
}
