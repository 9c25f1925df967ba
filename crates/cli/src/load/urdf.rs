//! A URDF, plain or for xacro to expand, and the chain of it that a command is about.

use super::coloured;
use super::files::Folder;
use crate::arguments::RobotArguments;
use crate::failure::Failure;
use crate::terminal::note;
use denavit::description::{
    Agreement, Chain, Convention, Decimals, Description, Diagnostic, MAX_XML_BYTES, Mechanism, NoChain,
    read_xacro,
};
use std::path::PathBuf;

/// The chain that the arguments name.
///
/// # Errors
/// If the file cannot be read or has errors, or there is no such chain.
pub fn from_urdf(arguments: &RobotArguments) -> Result<Description, Failure> {
    let name = arguments.robot.as_str();
    let text = super::contents(name, MAX_XML_BYTES);
    let text = text.map_err(|e| Failure::Input(format!("error: {name}: {e}")))?;
    let packages = pairs(&arguments.package, "--package", "ur_description=../ur_description")?;
    let packages: Vec<(String, PathBuf)> = packages.into_iter().map(|(n, p)| (n, p.into())).collect();
    let given = pairs(&arguments.arg, "--arg", "name=ur5")?;
    let read = |decimals| read_xacro(name, &text, &mut Folder::around(name, &packages), &given, decimals);
    let decimals = if arguments.as_written { Decimals::AsWritten } else { Decimals::Meant };
    let (outcome, files) = read(decimals);
    let render = |findings: &[Diagnostic]| -> String {
        let shown = |d: &Diagnostic| {
            let (name, text, span) = files.locate(&d.span)?;
            Some(coloured(&Diagnostic { span, ..d.clone() }, name, text))
        };
        findings.iter().filter_map(shown).collect()
    };
    let (mechanism, findings) = outcome.map_err(|findings| Failure::Input(render(&findings)))?;
    note(render(&findings).trim_end());
    if let (Decimals::Meant, (Ok((written, _)), _)) = (decimals, read(Decimals::AsWritten)) {
        say_moved(mechanism.apart(&written), name);
    }
    let convention = arguments.convention.map_or(Convention::Standard, Into::into);
    let (base, tip) = (arguments.base.as_deref(), arguments.tip.as_deref());
    let chain = mechanism.chain(base, tip, convention).map_err(|why| no_chain(name, &why))?;
    let [from, to] = [chain.from, chain.to].map(|b| mechanism.bodies[b].name.clone());
    say_chain(&chain, &mechanism, [&from, &to]);
    Ok(Description { source: Some(format!("{name}: {from} to {to}")), ..chain.description })
}

/// `NAME=VALUE`, or `NAME:=VALUE` as ROS writes it.
fn pairs(settings: &[String], option: &str, example: &str) -> Result<Vec<(String, String)>, Failure> {
    let pair = |setting: &String| {
        let sides = setting.split_once(":=").or_else(|| setting.split_once('='));
        let sides = sides.map(|(name, value)| (name.trim().to_string(), value.trim().to_string()));
        sides.ok_or_else(|| Failure::Usage(format!("{option} {setting}: write NAME=VALUE, as in {example}")))
    };
    settings.iter().map(pair).collect()
}

/// Says by how much the reading of decimals moves the links, where a person could see it.
fn say_moved(metres: f64, name: &str) {
    if metres > 1e-9 {
        let micrometres = metres * 1e6;
        note(&format!(
            "{name}: note: read so, links lie up to {micrometres:.3} µm from where the decimals as they are written have them"
        ));
    }
}

fn say_chain(chain: &Chain, mechanism: &Mechanism, [from, to]: [&str; 2]) {
    let joints = chain.joints.len();
    let joints = format!("{joints} joint{}", if joints == 1 { "" } else { "s" });
    let proof = match chain.agreement {
        Agreement::Proved => "its table is proved to be the file's chain".to_string(),
        Agreement::Within(by) if by < 1e-50 => "its table is the file's chain to 60 digits".into(),
        Agreement::Within(by) => format!("its table is the file's chain within {by:.0e}"),
    };
    let follows = chain.joints.iter().map(|&j| &mechanism.joints[j]).find(|j| j.follows.is_some());
    let follows = follows.map_or(String::new(), |joint| {
        format!("; what `{}` follows is not on the way, it moves by itself", joint.name)
    });
    note(&format!("note: from `{from}` to `{to}`, {joints}; {proof}{follows}"));
}

fn no_chain(name: &str, why: &NoChain) -> Failure {
    let text = format!("{name}: {why}");
    match why {
        NoChain::Several(_) => Failure::Usage(format!("{text}\n  = hint: choose one with --tip LINK")),
        NoChain::Unknown { .. } => Failure::Usage(text),
        NoChain::Rigid { .. } | NoChain::TooLong(_) | NoChain::NoDirection(_) => {
            Failure::Input(format!("error: {text}"))
        }
    }
}
