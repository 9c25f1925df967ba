//! The Unified Robot Description Format (URDF): links, and joints between them.
//!
//! Lengths are exact decimals, angles what their digits mean ([`Decimals`]). Looks are kept in doubles; what a file says of
//! collisions and drives is left; what it leaves out is what the format says: x for an axis, the identity for an origin.

mod joints;
mod looks;
mod tree;
mod units;
mod write;

pub(super) use joints::{Draft, FAR};
pub use write::write_urdf;

use super::Decimals;
use super::diagnostic::{Diagnostic, Diagnostics};
use super::reader::Reader;
use super::sources::{Files, Sources};
use super::tree::{Body, Mass, Mechanism};
use super::xacro::{Xacro, expand, is_xacro};
use super::xml::{Element, parse, shown};
use std::collections::{HashMap, HashSet};
use std::ops::Range;

/// What stands in `<robot>` beside links and joints, and says nothing of kinematics.
const BESIDE: &[&str] = &[
    "material",
    "transmission",
    "gazebo",
    "ros2_control",
    "sensor",
    "group",
    "loop_joint",
    "self_collision_checking",
];

/// The links of a file: their bodies and places.
#[derive(Default)]
pub(super) struct Links {
    pub bodies: Vec<Body>,
    pub spans: Vec<Range<usize>>,
    pub by_name: HashMap<String, usize>,
    /// Those whose names are given to others, too.
    pub doubled: HashSet<usize>,
}

impl Links {
    /// Adds a link of a name that none has yet, and gives its number.
    pub fn add(&mut self, name: String, mass: Option<Mass>, span: Range<usize>) -> usize {
        let number = self.bodies.len();
        self.by_name.insert(name.clone(), number);
        self.bodies.push(Body { name, mass, is_unweighed: false, looks: vec![] });
        self.spans.push(span);
        number
    }
}

/// Reads a URDF. With the mechanism come warnings and notes.
///
/// # Errors
/// All errors of the text (with the warnings and notes), in the order of the text.
pub fn read_urdf(text: &str, decimals: Decimals) -> Result<(Mechanism, Vec<Diagnostic>), Vec<Diagnostic>> {
    let mut out = Diagnostics::default();
    let Some(tree) = parse(text, 0, &mut out) else { return out.finish(None) };
    let mut reader = Reader::new(out, decimals);
    let mechanism = reader.robot(tree.root());
    reader.say_angles();
    reader.out.finish(mechanism)
}

/// A mechanism with what there is to say, or all that is wrong.
pub type Reading = Result<(Mechanism, Vec<Diagnostic>), Vec<Diagnostic>>;

/// Reads a URDF that xacro is to expand, or one that it need not, with the files that it includes.
///
/// `arguments` are the values of its arguments by name. Places are those of all files together ([`Files`]).
///
/// # Errors
/// All errors of the texts (with the warnings and notes).
pub fn read_xacro(
    name: &str,
    text: &str,
    sources: &mut dyn Sources,
    arguments: &[(String, String)],
    decimals: Decimals,
) -> (Reading, Files) {
    let mut files = Files::default();
    files.add(name.into(), text.into());
    let mut out = Diagnostics::default();
    let Some(tree) = parse(text, 0, &mut out) else { return (out.finish(None), files) };
    let mut xacro = Xacro::new(files, out, sources, arguments);
    let tree = if is_xacro(&tree) { expand(&mut xacro, tree) } else { Some(tree) };
    xacro.say_unasked();
    let calls = xacro.first_calls();
    let Xacro { files, out, .. } = xacro;
    let Some(tree) = tree.filter(|_| !out.has_errors()) else { return (out.finish(None), files) };
    let mut reader = Reader::new(out, decimals);
    let mechanism = reader.robot(tree.root());
    reader.say_angles();
    // What stands in a macro says who called it first.
    let hinted = |mut list: Vec<Diagnostic>| {
        for finding in list.iter_mut().filter(|f| f.hint.is_none()) {
            let call = calls.iter().find(|(body, _)| body.contains(&finding.span.start));
            finding.hint = call.map(|(_, call)| format!("expanded from {}", files.place(call)));
        }
        list
    };
    let reading = match reader.out.finish(mechanism) {
        Ok((mechanism, list)) => Ok((mechanism, hinted(list))),
        Err(list) => Err(hinted(list)),
    };
    (reading, files)
}

impl Reader {
    fn robot(&mut self, robot: Element) -> Option<Mechanism> {
        if robot.name() != Some("robot") {
            let name = robot.full_name().to_string();
            let finding =
                self.out.error(robot.span(), format!("the root element is <{}>, not <robot>", shown(&name)));
            match name.as_str() {
                "sdf" => finding.hint("this is SDF, which is not read: export a URDF"),
                "mujoco" | "mujocoinclude" => finding.hint("this is a model of MuJoCo's (MJCF)"),
                _ => {}
            }
            return None;
        }
        if self.is_xacro(robot) {
            return None;
        }
        robot.only(&["name", "version"], &mut self.out);
        let name = robot.attribute("name").map_or_else(|| "robot".to_string(), |n| plain(n.text));
        let mut links = self.links(robot);
        if links.bodies.is_empty() {
            self.out
                .error(robot.span(), "an empty robot: there is no link")
                .hint("did the run of xacro fail that was to write it?");
            return None;
        }
        let drafts = self.joints(robot, &mut links);
        self.say_units(&drafts);
        self.beside(robot);
        if !self.has_few_joints(&drafts) {
            return None;
        }
        self.tree(name, links, drafts)
    }

    /// True, and said, for a file that xacro has yet to expand.
    fn is_xacro(&mut self, robot: Element) -> bool {
        let found = robot.children().find(|c| c.full_name().starts_with("xacro:"));
        if let Some(element) = found {
            self.out
                .error(element.span(), format!("<{}> is for xacro to expand", shown(element.full_name())))
                .hint("`xacro robot.urdf.xacro > robot.urdf` writes the URDF");
        }
        found.is_some()
    }

    fn links(&mut self, robot: Element) -> Links {
        let materials = self.materials(robot);
        let mut links = Links::default();
        for link in robot.all("link") {
            link.only(&["name", "type"], &mut self.out);
            let name = self.name_of(link);
            // Everything is read before anything is given up, so that all findings come at once.
            self.known(link, &["inertial", "visual", "collision", "contact", "self_collision_checking"]);
            let mass = link.one("inertial", &mut self.out).and_then(|e| self.mass(e));
            let looks = self.looks(link, &materials);
            let Some(name) = name else {
                self.is_part = true;
                continue;
            };
            if let Some(&first) = links.by_name.get(&name) {
                let finding =
                    self.out.error(link.span(), format!("the link `{}` is given twice", shown(&name)));
                finding.hint("names are unique");
                self.out.note(links.spans[first].clone(), format!("the first link `{}`", shown(&name)));
                links.doubled.insert(first);
                continue;
            }
            let number = links.add(name, mass, link.span());
            links.bodies[number].looks = looks;
        }
        links
    }

    /// The name of a link or a joint; one that is missing is reported.
    fn name_of(&mut self, element: Element) -> Option<String> {
        let name = element.attribute("name").map(|n| plain(n.text)).filter(|n| !n.trim().is_empty());
        if name.is_none() {
            self.out.error(element.span(), format!("a <{}> without a name", element.full_name()));
        }
        name
    }

    /// Says once of each kind what in `<robot>` is left.
    fn beside(&mut self, robot: Element) {
        let mut said: Vec<String> = vec![];
        for child in robot.children() {
            let name = child.full_name().to_string();
            if matches!(child.name(), Some("link" | "joint")) || said.contains(&name) || said.len() > 20 {
                continue;
            }
            if child.name().is_some_and(|n| !BESIDE.contains(&n)) {
                let finding =
                    self.out.warning(child.span(), format!("<{}> is unknown: it is skipped", shown(&name)));
                let known = ["link", "joint"].into_iter().chain(BESIDE.iter().copied());
                if let Some(near) = super::diagnostic::nearest(&name, known) {
                    finding.hint(format!("did you mean <{near}>?"));
                }
            } else if !matches!(child.name(), Some("material")) {
                self.out.note(
                    child.span(),
                    format!("<{}> says nothing of kinematics: it is skipped", shown(&name)),
                );
            }
            said.push(name);
        }
    }

    /// Warns of elements that are not among these.
    pub(super) fn known(&mut self, parent: Element, names: &[&str]) {
        for child in parent.children() {
            let Some(name) = child.name().filter(|n| !names.contains(n) && !self.out.is_full()) else {
                continue;
            };
            let message = format!("<{}> has no <{}>: it is skipped", parent.full_name(), shown(name));
            let finding = self.out.warning(child.span(), message);
            if let Some(near) = super::diagnostic::nearest(name, names.iter().copied()) {
                finding.hint(format!("did you mean <{near}>?"));
            }
        }
    }
}

/// A name on one line.
pub(super) fn plain(name: &str) -> String {
    name.replace(|c: char| c.is_control(), " ")
}
