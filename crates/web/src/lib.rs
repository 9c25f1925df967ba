//! The engine of the page: requests and answers as JSON, one robot at a time.
//!
//! A page holds several engines; each has its robot, set by `edit`. [`answer`] and its like take
//! `{"op": …, "input": …}` and give the answer, or `{"error": …, "hint": …}`. What is asked and answered is written down
//! in `page/src/engine/types.ts`. Lengths are metres, angles radians, matrices rows of rows. Nothing is computed here:
//! the crates `denavit` and `denavit-report` do.

mod border;
mod catalogue;
mod checking;
mod definitions;
mod documents;
mod dropped;
mod falling;
mod formulas;
mod heavy;
mod looks;
mod model;
mod motion;
mod orientation;
mod reach;
mod recorded;
mod refusal;
mod robot_file;
mod scene;
mod session;
mod solve;
mod steps;
mod subject;
mod tree;
mod values;
mod velocity;

use denavit_report::words::English;
use denavit_wire::catalogue::Catalogue;
use refusal::Refusal;
use robot_file::RobotFile;
use serde::{Deserialize, Serialize};
use session::Session;
use std::cell::RefCell;

thread_local! {
    static SESSION: RefCell<Session> = RefCell::new(Session::default());
}

/// The words of the page; called directly, each stands in the part of the engine that says it.
fn words() -> English {
    English
}

/// What can be asked.
#[derive(Deserialize)]
#[serde(tag = "op", content = "input", rename_all = "camelCase")]
enum Request {
    Catalogue {},
    Open(catalogue::Open),
    Edit { file: RobotFile },
    Write { file: RobotFile },
    Convert { to: String },
    Scene { q: Vec<f64> },
    Ghost { q: Vec<f64> },
    Orientations {},
    Angles { pose: Vec<Vec<f64>>, set: String },
    Pose { xyz: [f64; 3], set: String, values: Vec<f64> },
    Jacobian { q: Vec<f64>, frame: String },
    Hold { q: Vec<f64> },
}

/// What can be asked about poses.
#[derive(Deserialize)]
#[serde(tag = "op", content = "input", rename_all = "camelCase")]
enum InverseRequest {
    Solve(solve::Wish),
}

/// What can be asked for that is derived first.
#[derive(Deserialize)]
#[serde(tag = "op", content = "input", rename_all = "camelCase")]
enum MoreRequest {
    Formulas { topic: String, q: Vec<f64> },
    Values { topic: String, q: Vec<f64> },
    Singular {},
    Workspace {},
    Path(motion::Wish),
    Fall(falling::Wish),
}

/// What can be read: tables out of texts, and descriptions of trees.
#[derive(Deserialize)]
#[serde(tag = "op", content = "input", rename_all = "camelCase")]
enum ReadRequest {
    Read(catalogue::Foreign),
    Tree(tree::Wanted),
}

/// What can be written.
#[derive(Deserialize)]
#[serde(tag = "op", content = "input", rename_all = "camelCase")]
enum WrittenRequest {
    Report { format: String, language: String, q: Vec<f64> },
    Code { language: String, name: Option<String> },
    Figure(documents::Picture),
}

/// What can be asked about documents and recordings.
#[derive(Deserialize)]
#[serde(tag = "op", content = "input", rename_all = "camelCase")]
enum CheckRequest {
    Check { text: String, name: String },
    Recording(recorded::Wish),
}

/// A robot file as it is written.
#[derive(Serialize)]
struct Text {
    text: String,
}

/// Answers a request about the robot.
pub fn answer(request: &str) -> String {
    answered(request, |session, request| match request {
        Request::Catalogue {} => told(Ok(Catalogue::whole())),
        Request::Open(open) => told(catalogue::open(&open)),
        Request::Edit { file } => told(Ok(session.edit(&file))),
        Request::Write { file } => told(Ok(Text { text: file.to_toml().text })),
        Request::Convert { to } => told(catalogue::convert(session.robot()?, &to)),
        Request::Scene { q } => told(scene::scene(session.robot()?, &q)),
        Request::Ghost { q } => told(scene::ghost(session.robot()?, &q)),
        Request::Orientations {} => told(Ok(orientation::sets())),
        Request::Angles { pose, set } => told(orientation::angles(&pose, &set)),
        Request::Pose { xyz, set, values } => told(orientation::pose(xyz, &set, &values)),
        Request::Jacobian { q, frame } => velocity::jacobian(session.robot()?, &q, &frame),
        Request::Hold { q } => told(falling::hold(session.robot()?, &q)),
    })
}

/// Answers a request for solutions of a pose.
pub fn answer_inverse(request: &str) -> String {
    answered(request, |session, request| match request {
        InverseRequest::Solve(wish) => told(solve::solve(session.robot()?, &wish)),
    })
}

/// Answers a request for what is derived.
pub fn answer_more(request: &str) -> String {
    answered(request, |session, request| match request {
        MoreRequest::Formulas { topic, q } => told(formulas::formulas(session.robot()?, &topic, &q)),
        MoreRequest::Values { topic, q } => told(values::values(session.robot()?, &topic, &q)),
        MoreRequest::Singular {} => told(velocity::singular(session.robot()?)),
        MoreRequest::Workspace {} => told(reach::workspace(session.robot()?)),
        MoreRequest::Path(wish) => told(motion::path(session.robot()?, &wish)),
        MoreRequest::Fall(wish) => told(falling::fall(session.robot()?, &wish)),
    })
}

/// Answers a request about a description that somebody else wrote.
pub fn answer_read(request: &str) -> String {
    answered(request, |_, request| match request {
        ReadRequest::Read(text) => told(catalogue::read(&text)),
        ReadRequest::Tree(wanted) => told(tree::tree(&wanted)),
    })
}

/// Answers a request for a report, source code, or a figure.
pub fn answer_written(request: &str) -> String {
    answered(request, |session, request| match request {
        WrittenRequest::Report { format, language, q } => {
            told(documents::report(session.robot()?, &format, &language, &q))
        }
        WrittenRequest::Code { language, name } => told(documents::code(session.robot()?, &language, name)),
        WrittenRequest::Figure(picture) => told(documents::figure(session.robot()?, &picture)),
    })
}

/// Answers a request about a document or a recording.
pub fn answer_check(request: &str) -> String {
    answered(request, |session, request| match request {
        CheckRequest::Check { text, name } => told(checking::check(session.robot()?, &text, &name)),
        CheckRequest::Recording(wish) => told(recorded::recording(session.robot()?, wish)),
    })
}

/// An answer as text.
fn told<T: Serialize>(answer: Result<T, Refusal>) -> Result<String, Refusal> {
    answer.map(|answer| denavit_wire::text(&answer))
}

fn answered<R: for<'a> Deserialize<'a>>(
    request: &str,
    answer: impl FnOnce(&mut Session, R) -> Result<String, Refusal>,
) -> String {
    let read = serde_json::from_str(request).map_err(|e| Refusal::new(format!("not a request: {e}")));
    let result = read.and_then(|request| SESSION.with_borrow_mut(|session| answer(session, request)));
    result.unwrap_or_else(|refusal| denavit_wire::text(&refusal))
}
