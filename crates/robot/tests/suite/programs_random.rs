//! Random programs of Python, with lists that have two names, objects, arrays, functions, loops and conditions: what is read of one is
//! what Python makes of it, or an error.

use crate::common::{Random, share};
use denavit::description::{Language, read_program};
use std::fmt::Write as _;
use std::io::Write as _;
use std::process::{Command, Stdio};

/// Runs programs, each by itself, and prints for each the lengths of its robot's links; nothing for one that fails.
const RUN: &str = r#"
import json, signal, sys, types
class RevoluteDH:
    def __init__(self, d=0, a=0): self.d, self.a = d, a
class DHRobot:
    made = []
    def __init__(self, links):
        self.links = list(links)
        DHRobot.made.append(self)
box = types.ModuleType("roboticstoolbox")
box.RevoluteDH, box.DHRobot = RevoluteDH, DHRobot
sys.modules["roboticstoolbox"] = box
running = False
def late(*_):
    if running: raise TimeoutError
# By the processor's time, and only while a program runs: other work on the machine changes nothing.
signal.signal(signal.SIGVTALRM, late)
out = []
for text in json.load(sys.stdin):
    DHRobot.made = []
    made = None
    signal.setitimer(signal.ITIMER_VIRTUAL, 0.2)
    try:
        running = True
        exec(compile(text, "p", "exec"), {"__name__": "__main__"})
        running = False
        robot, = DHRobot.made
        made = [[float(l.d), float(l.a)] for l in robot.links]
    except Exception:
        running = False
    signal.setitimer(signal.ITIMER_VIRTUAL, 0)
    out.append(made)
json.dump(out, sys.stdout)
"#;

/// What writes a program.
struct Writer {
    random: Random,
    text: String,
    indent: usize,
}

impl Writer {
    fn below(&mut self, n: usize) -> usize {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small number")]
        let k = (self.random.unit() * n as f64) as usize;
        k.min(n - 1)
    }

    fn one<'a>(&mut self, all: &[&'a str]) -> &'a str {
        all[self.below(all.len())]
    }

    fn line(&mut self, text: &str) {
        let _ = writeln!(self.text, "{}{text}", "    ".repeat(self.indent));
    }

    fn number(&mut self) -> String {
        match self.below(10) {
            0..3 => (1 + self.below(9)).to_string(),
            3..5 => self.one(&["x", "y"]).into(),
            5 => format!("{}[{}]", self.one(&["u", "v", "A", "B"]), self.one(&["0", "1", "-1"])),
            6 => format!("{}.k", self.one(&["p", "q"])),
            7 => format!("{}({})", self.one(&["f", "g"]), self.one(&["", "2", "x", "u[0]"])),
            8 => format!("{}.{}", self.one(&["L[0]", "L[-1]", "M[0]"]), self.one(&["d", "a"])),
            _ => format!("len({})", self.one(&["u", "v", "L", "M"])),
        }
    }

    fn value(&mut self) -> String {
        let first = self.number();
        match self.below(3) {
            0 => format!("{first} {} {}", self.one(&["+", "-", "*"]), self.number()),
            _ => first,
        }
    }

    /// The lines of a block.
    fn block(&mut self, most: usize) {
        self.indent += 1;
        for _ in 0..=self.below(most) {
            self.statement();
        }
        self.indent -= 1;
    }

    fn statement(&mut self) {
        let (value, other) = (self.value(), self.value());
        let text = match self.below(26) {
            0 | 1 => format!("{} = {value}", self.one(&["x", "y"])),
            2 => format!("{} {}= {value}", self.one(&["x", "y"]), self.one(&["+", "-", "*"])),
            3 => format!("{} = [{value}, {other}, 3]", self.one(&["u", "v"])),
            4 => self
                .one(&[
                    "v = u",
                    "u = v",
                    "v = u[:]",
                    "v = u[0:2]",
                    "v = list(u)",
                    "v = u + u",
                    "v = u.copy()",
                ])
                .into(),
            5 => {
                format!("{}[{}] = {value}", self.one(&["u", "v", "A", "B"]), self.one(&["0", "1", "-1", "x"]))
            }
            6 => format!("{}.{}({value})", self.one(&["u", "v"]), self.one(&["append", "append", "remove"])),
            7 => format!("{}.insert(0, {value})", self.one(&["u", "v"])),
            8 => format!("{} += [{value}]", self.one(&["u", "v"])),
            9 => self.one(&["u.reverse()", "v.pop()", "u.sort()", "v.clear()", "del u[0]"]).into(),
            10 => format!("A = np.array([{value}, {other}, 2])"),
            11 => self
                .one(&[
                    "B = A",
                    "B = A[0:2]",
                    "B = A[1:]",
                    "B = A.copy()",
                    "B = A * 2",
                    "B = A + A",
                    "A *= 2",
                    "B += 1",
                    "A = np.array(u)",
                ])
                .into(),
            12 => format!("{}.k = {value}", self.one(&["p", "q"])),
            13 => self.one(&["q = p", "p = q", "p = P()", "set_k(p)", "keep = [p]", "keep = [q]"]).into(),
            14 => format!("L.append(RevoluteDH(a={value}))"),
            15 => format!("L.append(RevoluteDH(d={value}, a={other}))"),
            16 => {
                format!("{}.{} = {value}", self.one(&["L[0]", "L[-1]", "M[0]", "one"]), self.one(&["d", "a"]))
            }
            17 => self
                .one(&[
                    "M = L",
                    "M = L[:]",
                    "M = [L[0]]",
                    "L = L + M",
                    "L[0], L[-1] = L[-1], L[0]",
                    "L = L[1:]",
                    "M.append(one)",
                    "one = L[0]",
                    "L += [one]",
                    "L.pop()",
                    "M = [one] * 2",
                ])
                .into(),
            18 => {
                let head = match self.below(7) {
                    0 => format!("for i in range({}):", self.below(4)),
                    1 => "for w in u:".into(),
                    2 => "for l in L:".into(),
                    3 => "for i, w in enumerate(v):".into(),
                    4 => "for i, l in enumerate(L):".into(),
                    5 => "for l in reversed(L):".into(),
                    _ => "for w, l in zip(u, L):".into(),
                };
                self.line(&head);
                self.indent += 1;
                let inner = self.one(&[
                    "x = x + 1",
                    "x = w",
                    "l.a = x",
                    "y += 2",
                    "u[0] = y",
                    "v.append(x)",
                    "if x > 3: break",
                    "L.append(RevoluteDH(a=x))",
                ]);
                self.line(inner);
                self.indent -= 1;
                return self.block(1);
            }
            19 | 20 => {
                let condition = match self.below(6) {
                    0 => format!("{value} > {other}"),
                    1 => format!("{value} == {other}"),
                    2 => format!("not {value} < {other}"),
                    3 => format!("0 < {value} < 4"),
                    4 => self.one(&["u", "True", "x and y", "q is p", "len(u) > 2"]).into(),
                    _ => format!("{value} >= {other} or x"),
                };
                self.line(&format!("if {condition}:"));
                self.block(2);
                if self.below(2) == 0 {
                    self.line("else:");
                    self.block(2);
                }
                return;
            }
            21 => self
                .one(&[
                    "change(u)",
                    "change(v)",
                    "lengthen(L)",
                    "lengthen(M)",
                    "set_x()",
                    "x = change(u)",
                    "fix(one)",
                ])
                .into(),
            22 => format!("x = {value} if {other} > 2 else y"),
            23 => self
                .one(&[
                    "u = [w + 1 for w in u]",
                    "L = [RevoluteDH(a=w) for w in v]",
                    "v = [x for w in u if w > 2]",
                    "u = [0] * 3",
                    "x, y = y, x",
                    "x = y = 3",
                ])
                .into(),
            24 => {
                let condition = self.value();
                self.line("try:");
                self.block(1);
                self.line(&format!("    x = x + {condition}"));
                self.line("except IndexError:");
                return self.block(1);
            }
            _ => format!("{} = {value}", self.one(&["x", "y", "s"])),
        };
        self.line(&text);
    }

    fn program(seed: u64) -> String {
        let mut w = Writer { random: Random(seed), text: String::new(), indent: 0 };
        for line in [
            "from roboticstoolbox import *",
            "s = 3",
            "class P:",
            "    k = 4",
            "def f(k=s):",
            "    return k + 1",
            "def g(k=2):",
            "    x = k * s",
            "    return x",
            "def change(w):",
            "    w[0] = 7",
            "    return 2",
            "def lengthen(links, by=s):",
            "    for l in links: l.a = by",
            "def fix(link):",
            "    link.d = 5",
            "def set_k(o):",
            "    o.k = 9",
            "def set_x():",
            "    global x",
            "    x = 8",
            "x, y = 1, 2",
            "u = [1, 2, 3]",
            "v = [4, 5]",
            "p = P()",
            "q = P()",
            "p.k = 6",
            "one = RevoluteDH(d=1)",
            "L = [RevoluteDH(a=1), one]",
            "M = [RevoluteDH(d=2)]",
        ] {
            w.line(line);
        }
        // Arrays are not everywhere, and what is not followed ends what can be said of a program.
        if w.below(3) == 0 {
            w.line("import numpy as np");
            w.line("A = np.array([1, 2, 3])");
            w.line("B = A");
        }
        for _ in 0..=w.below(8) {
            w.statement();
        }
        w.line("r = DHRobot(L)");
        for _ in 0..w.below(3) {
            w.statement();
        }
        w.text
    }
}

#[test]
fn programs_are_what_python_makes_of_them() {
    let python = std::env::var("DENAVIT_PYTHON").unwrap_or("python3".into());
    let programs: Vec<String> =
        (0..share(100_000, 3_000)).map(|k| Writer::program(1_000 + k as u64)).collect();
    let run = Command::new(python).args(["-c", RUN]).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn();
    let Ok(mut run) = run else { return };
    let text = serde_json::to_vec(&programs).unwrap();
    let mut to = run.stdin.take().unwrap();
    let writer = std::thread::spawn(move || to.write_all(&text).unwrap());
    let output = run.wait_with_output().unwrap();
    writer.join().unwrap();
    let made: Vec<Option<Vec<[f64; 2]>>> = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(made.len(), programs.len());
    let (mut same, mut ran) = (0, 0);
    for (text, made) in programs.iter().zip(made) {
        let Some(made) = made.filter(|links| !links.is_empty()) else { continue };
        ran += 1;
        let Ok((d, _)) = read_program(text, Language::Python, None) else { continue };
        let number = |e: denavit_symbolic::Expr| e.eval(|_| None).ok();
        let read: Vec<[Option<f64>; 2]> = d.rows.iter().map(|r| [number(r.d), number(r.a)]).collect();
        let wanted: Vec<[Option<f64>; 2]> = made.iter().map(|l| l.map(Some)).collect();
        assert_eq!(read, wanted, "{text}");
        same += 1;
    }
    assert!(ran > programs.len() / 5 && same > ran / 10, "{same} of {ran}");
}
