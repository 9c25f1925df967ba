//! What an engine remembers from one request to the next: the robot in hand.

use crate::model;
use crate::refusal::Refusal;
use crate::robot_file::RobotFile;
use crate::subject::Subject;
use denavit::description::{Diagnostic, read_toml};
use serde_json::{Value, json};

/// What an engine knows.
#[derive(Default)]
pub struct Session {
    robot: Option<Subject>,
}

impl Session {
    /// The robot in hand.
    ///
    /// # Errors
    /// If there is none yet.
    pub fn robot(&mut self) -> Result<&mut Subject, Refusal> {
        self.robot.as_mut().ok_or_else(|| Refusal::new("there is no robot yet"))
    }

    /// Takes a robot file in hand; one with errors leaves the robot before.
    pub fn edit(&mut self, file: &RobotFile) -> Value {
        let written = file.to_toml();
        let cell = |d: &Diagnostic| {
            let mut value = finding(d);
            value["cell"] = written.cell(d.span.start).into();
            value
        };
        let (description, findings) = match read_toml(&written.text) {
            Ok(read) => read,
            Err(findings) => {
                let findings: Vec<Value> = findings.iter().map(cell).collect();
                return json!({ "robot": null, "findings": findings });
            }
        };
        let mut findings: Vec<Value> = findings.iter().map(cell).collect();
        match Subject::new(description) {
            Ok(subject) => {
                let model = model::model(&subject);
                self.robot = Some(subject);
                json!({ "robot": model, "findings": findings })
            }
            Err(why) => {
                findings.push(json!({ "severity": "error", "message": why }));
                json!({ "robot": null, "findings": findings })
            }
        }
    }
}

/// A finding without its place.
pub fn finding(d: &Diagnostic) -> Value {
    let mut value = json!({ "severity": d.severity.name(), "message": d.message });
    if let Some(hint) = &d.hint {
        value["hint"] = hint.as_str().into();
    }
    value
}
