//! `dynamics --input`: a line with a state in, a line with its torques or accelerations out.

use super::{Arm, Given};
use crate::commands::fk::plural;
use crate::commands::stream::{self, Chunk, Worker, complaint, parsed, without_mark};
use crate::failure::Failure;
use serde_json::Value;
use std::path::Path;

/// Answers a line for each line: what `dynamics` says of the state, or what is wrong with the line.
///
/// # Errors
/// If the file cannot be read or the answers not written; at the end, if there were lines that could not be read.
pub fn run(arm: &Arm, usual: &Given, path: &Path) -> Result<(), Failure> {
    stream::run(|| States { arm: arm.clone(), usual: usual.clone() }, path)
}

struct States {
    arm: Arm,
    /// What the command line gives, for lines that do not.
    usual: Given,
}

impl Worker for States {
    fn answer(&mut self, chunk: &Chunk, out: &mut Vec<u8>) -> usize {
        let mut bad = 0;
        for (number, line) in chunk.lines() {
            let answer = self.state(line).and_then(|(q, given)| self.arm.answer(given, q));
            match answer {
                Ok(answer) => denavit_wire::line(&answer, out),
                Err(why) => {
                    complaint(number, &why, out);
                    bad += 1;
                }
            }
        }
        bad
    }
}

impl States {
    /// The state of a line: an object with `q` and what else is given, or the numbers of q, q̇ and q̈ one after the other.
    fn state(&self, line: &[u8]) -> Result<(Vec<f64>, Given), String> {
        const WHAT: &str = "a state";
        let n = self.arm.joints.len();
        let line = without_mark(line);
        let is_json = line.trim_ascii_start().first().is_some_and(|c| matches!(c, b'[' | b'{'));
        let read = |l: &[u8]| parsed(l, WHAT, |l| serde_json::from_slice::<Value>(l));
        let value = if is_json { read(line)? } else { read(&[b"[", line.trim_ascii(), b"]"].concat())? };
        let mut given = self.usual.clone();
        match value {
            Value::Array(all) => {
                let all = numbers(&all)?;
                let fits = if n == 0 { all.is_empty() } else { (1..=3).any(|k| all.len() == k * n) };
                if !fits {
                    let there = plural(all.len(), "number");
                    return Err(format!("{there}; {n}, {} or {} are needed", 2 * n, 3 * n));
                }
                let mut blocks = all.chunks(n.max(1)).map(<[f64]>::to_vec);
                let q = blocks.next().unwrap_or_default();
                if let Some(qd) = blocks.next() {
                    given.qd = qd;
                }
                if let Some(qdd) = blocks.next() {
                    (given.qdd, given.tau) = (Some(qdd), None);
                }
                Ok((q, given))
            }
            Value::Object(fields) => {
                let mut q = None;
                for (key, value) in &fields {
                    let count = if key == "wrench" { 6 } else { n };
                    let all = value.as_array().ok_or_else(|| format!("`{key}` is no list of numbers"))?;
                    let all = numbers(all).map_err(|why| format!("`{key}`: {why}"))?;
                    if all.len() != count {
                        let there = plural(all.len(), "number");
                        return Err(format!("`{key}` has {there}; {count} are needed"));
                    }
                    match key.as_str() {
                        "q" => q = Some(all),
                        "qd" => given.qd = all,
                        "qdd" => (given.qdd, given.tau) = (Some(all), None),
                        "tau" => (given.tau, given.qdd) = (Some(all), None),
                        "wrench" => given.wrench = <[f64; 6]>::try_from(all).ok(),
                        _ => return Err(format!("`{key}` is none of q, qd, qdd, tau and wrench")),
                    }
                }
                if fields.contains_key("qdd") && fields.contains_key("tau") {
                    return Err("both `qdd` and `tau`: one follows from the other".into());
                }
                if given.derivatives && given.wrench.is_some() {
                    return Err("--derivatives are without a wrench".into());
                }
                Ok((q.ok_or("no `q`")?, given))
            }
            _ => Err(format!("not {WHAT}")),
        }
    }
}

fn numbers(all: &[Value]) -> Result<Vec<f64>, String> {
    let number = |v: &Value| v.as_f64().filter(|x| x.is_finite()).ok_or_else(|| format!("{v} is no number"));
    all.iter().map(number).collect()
}
