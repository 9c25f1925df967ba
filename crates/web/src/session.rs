//! What an engine remembers from one request to the next: the robot in hand.

use crate::model::Model;
use crate::refusal::Refusal;
use crate::robot_file::RobotFile;
use crate::subject::Subject;
use denavit::description::{Diagnostic, Severity, read_toml};
use denavit_wire::finding::Finding;
use serde::Serialize;

/// What an engine knows.
#[derive(Default)]
pub struct Session {
    robot: Option<Subject>,
}

/// What is known of a robot file.
#[derive(Serialize)]
pub struct Edited {
    findings: Vec<Finding>,
    robot: Option<Model>,
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
    pub fn edit(&mut self, file: &RobotFile) -> Edited {
        let written = file.to_toml();
        let found =
            |d: &Diagnostic| Finding { cell: written.cell(d.span.start).map(Into::into), ..Finding::of(d) };
        let (description, findings) = match read_toml(&written.text) {
            Ok(read) => read,
            Err(findings) => {
                return Edited { findings: findings.iter().map(found).collect(), robot: None };
            }
        };
        let mut findings: Vec<Finding> = findings.iter().map(found).collect();
        match Subject::new(description) {
            Ok(subject) => {
                let model = Model::of(&subject);
                self.robot = Some(subject);
                Edited { findings, robot: Some(model) }
            }
            Err(why) => {
                findings.push(Finding {
                    at: None,
                    cell: None,
                    hint: None,
                    message: why,
                    severity: Severity::Error.name(),
                });
                Edited { findings, robot: None }
            }
        }
    }
}
