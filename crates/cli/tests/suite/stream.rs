//! `fk --input`: a line of JSON in, a line of JSON out.

use denavit::{Robot, catalogue};
use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Write};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::channel;
use std::thread;
use std::time::Duration;

/// Lines that are handled together.
const CHUNK: usize = 1024;

fn started(arguments: &[&str]) -> Child {
    Command::new(env!("CARGO_BIN_EXE_denavit"))
        .args(arguments)
        .env("NO_COLOR", "1")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command starts")
}

/// Exit code, the lines of the answer, standard error.
fn answers(arguments: &[&str], input: &[u8]) -> (Option<i32>, Vec<String>, String) {
    let mut child = started(arguments);
    let mut stdin = child.stdin.take().expect("a pipe");
    let input = input.to_vec();
    let feeder = thread::spawn(move || stdin.write_all(&input));
    let output = child.wait_with_output().expect("the command ends");
    feeder.join().expect("no panic").expect("all input is read");
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    assert!(text.is_empty() || text.ends_with('\n'));
    let lines = text.lines().map(str::to_string).collect();
    (output.status.code(), lines, String::from_utf8(output.stderr).expect("UTF-8"))
}

fn parsed(line: &str) -> Value {
    let value: Value = serde_json::from_str(line).unwrap_or_else(|e| panic!("{e}: {line}"));
    assert_eq!(value["schema"], 1);
    value
}

#[test]
fn order_is_kept_across_chunks() {
    for count in [0, 1, CHUNK - 1, CHUNK, CHUNK + 1, 2 * CHUNK, 7 * CHUNK + 3] {
        let input: String = (0..count).map(|i| format!("[{i},-0.5]\n")).collect();
        let (code, lines, errors) = answers(&["fk", "planar-2r", "--input", "-"], input.as_bytes());
        assert_eq!((code, lines.len(), errors.as_str()), (Some(0), count, ""), "{count} lines");
        for (i, line) in lines.iter().enumerate() {
            assert_eq!(parsed(line)["q"], json!([i as f64, -0.5]));
        }
    }
}

#[test]
fn bad_lines_are_answered_in_their_place() {
    let bad = [0, 5, CHUNK - 1, CHUNK, CHUNK + 1, 3 * CHUNK - 1, 3 * CHUNK];
    let line = |i: usize| if bad.contains(&i) { "[1,2,3]\n".to_string() } else { format!("[0.25,{i}]\n") };
    let input: String = (0..=3 * CHUNK).map(line).collect();
    let (code, lines, errors) = answers(&["fk", "planar-2r", "--input", "-"], input.as_bytes());
    assert_eq!(code, Some(3));
    assert!(errors.contains("-: 7 lines could not be read"), "{errors}");
    assert_eq!(lines.len(), 3 * CHUNK + 1);
    for (i, line) in lines.iter().enumerate() {
        let answer = parsed(line);
        if bad.contains(&i) {
            let wanted = json!({"schema": 1, "line": i + 1, "error": "3 values, the robot has 2 joints"});
            assert_eq!(answer, wanted);
        } else {
            assert_eq!(answer["q"][1], i as f64);
        }
    }
}

#[test]
fn blank_lines_line_ends_and_what_is_no_number() {
    let input = b"[0,0]\r\n\r\n\n  \t\n[1,1] \r\n[1e400,0]\n[NaN,0]\n\xff\n{}\n[1,2][3]\n \n[-0.0,1E-3]";
    let (code, lines, _) = answers(&["fk", "planar-2r", "--input", "-"], input);
    assert_eq!(code, Some(3));
    let found: Vec<Value> = lines
        .iter()
        .map(|l| {
            let answer = parsed(l);
            if answer["q"].is_array() { answer["q"].clone() } else { answer["line"].clone() }
        })
        .collect();
    let wanted = [
        json!([0.0, 0.0]),
        json!([1.0, 1.0]),
        json!(6),
        json!(7),
        json!(8),
        json!(9),
        json!(10),
        json!([-0.0, 1e-3]),
    ];
    assert_eq!(found, wanted);
}

#[test]
fn a_line_that_is_too_long_is_passed_over() {
    let input = [b"[0,0]\n[".as_slice(), &vec![b' '; 3 << 20], b"1,2]\n[3,4]\n"].concat();
    let (code, lines, _) = answers(&["fk", "planar-2r", "--input", "-"], &input);
    assert_eq!((code, lines.len()), (Some(3), 3));
    assert_eq!(parsed(&lines[1])["error"], "longer than 1048576 bytes");
    assert_eq!(parsed(&lines[2])["q"], json!([3.0, 4.0]));
}

/// A configuration has one answer, alone or among thousands; that it is right is the matter of `crates/robot`.
#[test]
fn the_answer_is_that_of_one_configuration() {
    for options in [&[][..], &["--frames", "all", "--orientation", "quaternion"], &["--frames", "3"]] {
        for name in ["franka-panda", "ur5", "stanford"] {
            let d = catalogue::robot(name).expect("a robot");
            let robot = Robot::numeric(&d).expect("all values");
            let q = |i: usize| -> Vec<f64> {
                (0..robot.joints)
                    .map(|j| ((1 + i * 7 + j) as f64 * 0.618_033_988_749_894_8).sin() * 3.0)
                    .collect()
            };
            let count = CHUNK + 40;
            let input: String = (0..count).map(|i| json!(q(i)).to_string() + "\n").collect();
            let streamed = answers(&[&["fk", name, "--input", "-"], options].concat(), input.as_bytes());
            assert_eq!((streamed.0, streamed.1.len()), (Some(0), count));
            for i in [0, 1, 700, CHUNK - 1, CHUNK, count - 1] {
                let text = q(i).iter().map(f64::to_string).collect::<Vec<_>>().join(",");
                let (_, alone, _) = answers(&[&["fk", name, "--json", "-q", &text], options].concat(), b"");
                assert_eq!(alone, streamed.1[i..=i], "{name} {options:?}");
                let pose = parsed(&alone[0])["pose"].clone();
                for (r, row) in robot.pose(&q(i)).matrix().iter().enumerate() {
                    for (c, x) in row.iter().enumerate() {
                        assert!(
                            pose[r][c].as_f64().is_some_and(|y| (x - y).abs() <= 1e-13),
                            "{name}: {pose}"
                        );
                    }
                }
            }
        }
    }
}

/// Each answer is read before the next line is written.
#[test]
fn a_slow_pipe_is_answered_line_by_line() {
    let mut child = started(&["fk", "planar-2r", "--input", "-"]);
    let mut stdin = child.stdin.take().expect("a pipe");
    let stdout = BufReader::new(child.stdout.take().expect("a pipe"));
    let (sender, receiver) = channel();
    let reader = thread::spawn(move || stdout.lines().for_each(|line| drop(sender.send(line))));
    for i in 0..5 {
        // The end of the line comes later.
        write!(stdin, "[{i},").expect("written");
        stdin.flush().expect("written");
        thread::sleep(Duration::from_millis(5));
        writeln!(stdin, "0.5]").expect("written");
        stdin.flush().expect("written");
        let line = receiver.recv_timeout(Duration::from_secs(60)).expect("an answer").expect("readable");
        assert_eq!(parsed(&line)["q"][0], f64::from(i));
    }
    drop(stdin);
    assert!(child.wait().expect("the command ends").success());
    reader.join().expect("no panic");
}

/// Also while the input is open and silent.
#[test]
fn a_reader_that_goes_away_ends_the_stream_quietly() {
    let mut child = started(&["fk", "planar-2r", "--input", "-"]);
    let mut stdin = child.stdin.take().expect("a pipe");
    drop(child.stdout.take());
    stdin.write_all(b"[1,2]\n").expect("written");
    let output = child.wait_with_output().expect("the command ends");
    assert_eq!((output.status.code(), output.stderr.as_slice()), (Some(0), &[][..]));
    drop(stdin);
}

#[test]
fn files_that_cannot_be_read() {
    for path in ["no/such/file.ndjson", env!("CARGO_MANIFEST_DIR")] {
        let (code, lines, errors) = answers(&["fk", "planar-2r", "--input", path], b"");
        assert_eq!((code, lines.len()), (Some(3), 0));
        assert!(errors.starts_with("error: ") && errors.contains(path), "{errors}");
    }
}
