//! Robots out of trees: a URDF, plain or for xacro, or a model of MuJoCo's, with the files that lie around it, and a chain through it.

use crate::dropped::{Dropped, Lying};
use crate::looks::{Looks, Missing, looks};
use crate::refusal::Refusal;
use crate::robot_file::RobotFile;
use denavit::description::{
    Convention, Decimals, Diagnostic, Files, NoChain, Severity, read_bodies, write_toml,
};
use denavit_report::words::Geometry as _;
use denavit_wire::finding::Finding;
use serde::{Deserialize, Serialize};

/// Metres that a person could see.
const SEEN: f64 = 1e-9;

/// A description of a tree, and the chain that is wanted of it.
#[derive(Deserialize)]
pub struct Wanted {
    /// Its path among the files.
    name: String,
    text: String,
    /// What lies around it.
    #[serde(default)]
    around: Lying,
    /// Names and values that xacro is given.
    #[serde(default)]
    arguments: Vec<(String, String)>,
    base: Option<String>,
    tip: Option<String>,
    convention: Option<String>,
    #[serde(default)]
    as_written: bool,
}

/// The table of a chain, and the tree that it goes through.
#[derive(Serialize)]
pub struct Taken {
    /// The table; nothing where the description has errors or a choice has to be made.
    file: Option<RobotFile>,
    findings: Vec<Placed>,
    /// How the bodies look, where there is a chain that moves them.
    looks: Option<Looks>,
    /// Nothing where the description has errors.
    tree: Option<Tree>,
}

/// A finding with the file that it is in, where that is another.
#[derive(Serialize)]
struct Placed {
    #[serde(flatten)]
    finding: Finding,
    #[serde(skip_serializing_if = "Option::is_none")]
    source: Option<String>,
}

/// A tree, and the chain through it.
#[derive(Serialize)]
struct Tree {
    base: String,
    /// All links, in the order of the file.
    links: Vec<String>,
    name: String,
    /// Nothing where several links may be meant.
    tip: Option<String>,
    /// The links with the most joints on the way, where several may be meant; else those at which the tree ends.
    tips: Vec<String>,
    /// What the chain is, and that its table is the file's.
    words: String,
}

/// Reads a tree, and the chain through it that is wanted.
///
/// # Errors
/// If there is no such convention.
pub fn tree(wanted: &Wanted) -> Result<Taken, Refusal> {
    let convention = match wanted.convention.as_deref() {
        Some(name) => crate::catalogue::convention(name)?,
        None => Convention::Standard,
    };
    let mut dropped = Dropped::new(&wanted.around);
    let mut read =
        |decimals| read_bodies(&wanted.name, &wanted.text, &mut dropped, &wanted.arguments, decimals);
    let decimals = if wanted.as_written { Decimals::AsWritten } else { Decimals::Meant };
    let (outcome, files) = read(decimals);
    let (mechanism, findings) = match outcome {
        Ok(read) => read,
        Err(findings) => {
            return Ok(Taken {
                file: None,
                findings: placed(&findings, &files, &wanted.name),
                looks: None,
                tree: None,
            });
        }
    };
    let mut findings = placed(&findings, &files, &wanted.name);
    if let (Decimals::Meant, (Ok((written, _)), _)) = (decimals, read(Decimals::AsWritten)) {
        let apart = mechanism.apart(&written);
        let words = || crate::words().read_apart(apart);
        findings.extend((apart > SEEN).then(|| alone(Severity::Note, words(), None)));
    }
    if !mechanism.holds.is_empty() {
        let message = "its closed loops are not held here: joints move as if they were open".to_string();
        findings.push(alone(Severity::Warning, message, None));
    }
    let links: Vec<String> = mechanism.bodies.iter().map(|b| b.name.clone()).collect();
    let ends: Vec<String> = mechanism.leaves().into_iter().map(|b| links[b].clone()).collect();
    let [base, tip] = [&wanted.base, &wanted.tip].map(|body| body.as_deref().filter(|b| !b.is_empty()));
    let root = &links[mechanism.root];
    let tree = |tip: Option<String>, tips: Vec<String>, words: String| Tree {
        base: base.unwrap_or(root).into(),
        links: links.clone(),
        name: mechanism.name.clone(),
        tip,
        tips,
        words,
    };
    match mechanism.chain(base, tip, convention) {
        Ok(chain) => {
            let words = crate::words().chain(&chain, &mechanism);
            let (looks, missing) = looks(&mechanism, &chain, &dropped, &wanted.name);
            findings.extend(missing.iter().map(not_there));
            let to = links[chain.to].clone();
            let source = format!("{}: {} to {to}", wanted.name, links[chain.from]);
            let mut description = chain.description;
            description.source = Some(source);
            let file = RobotFile::from_toml(&write_toml(&description));
            Ok(Taken { file, findings, looks: Some(looks), tree: Some(tree(Some(to), ends, words)) })
        }
        Err(why) => {
            let tips = if let NoChain::Several(tips) = &why { tips.clone() } else { ends };
            let hint = matches!(why, NoChain::Several(_)).then(|| "choose where the chain ends".to_string());
            findings.push(alone(Severity::Error, why.to_string(), hint));
            Ok(Taken {
                file: None,
                findings,
                looks: None,
                tree: Some(tree(tip.map(Into::into), tips, String::new())),
            })
        }
    }
}

/// Findings with their places; the file is named where it is not the one that was opened.
fn placed(findings: &[Diagnostic], files: &Files, own: &str) -> Vec<Placed> {
    let one = |d: &Diagnostic| match files.locate(&d.span) {
        Some((name, text, span)) => Placed {
            finding: Finding::placed(&Diagnostic { span, ..d.clone() }, text),
            source: (name != own).then(|| name.to_string()),
        },
        None => Placed { finding: Finding::of(d), source: None },
    };
    findings.iter().map(one).collect()
}

/// A finding without a place.
fn alone(severity: Severity, message: String, hint: Option<String>) -> Placed {
    let finding = Finding { at: None, cell: None, hint, message, severity: severity.name() };
    Placed { finding, source: None }
}

/// Meshes that are not among the files.
fn not_there(Missing { package, count, first }: &Missing) -> Placed {
    let whose = package.as_ref().map_or(String::new(), |p| format!(" of the package `{p}`"));
    let (meshes, are) = if *count == 1 { ("mesh", "is") } else { ("meshes", "are") };
    let message = format!("{count} {meshes}{whose} {are} not among the files, the first one is `{first}`");
    let hint = "links are drawn without; open the whole folder, or a zip of it".to_string();
    alone(Severity::Note, message, Some(hint))
}
