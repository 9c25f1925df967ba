//! The Semantic Robot Description Format (SRDF): groups of joints and links of a URDF, by name. What else stands in such a file (states,
//! end effectors, pairs that may touch) is left.

use super::diagnostic::{Diagnostic, Diagnostics, nearest};
use super::tree::Mechanism;
use super::xml::{Element, parse, shown};
use std::fmt;

/// A group of an SRDF.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Group {
    /// Its name.
    pub name: String,
    /// Base and tip of each chain in it.
    pub chains: Vec<[String; 2]>,
    /// The joints that are named.
    pub joints: Vec<String>,
    /// The links that are named, each with the joint that moves it.
    pub links: Vec<String>,
    /// Groups whose members it has, too.
    pub groups: Vec<String>,
}

/// Why a group is no chain.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum NoEnds {
    /// There is no group of this name.
    Unknown {
        /// The name.
        name: String,
        /// The groups that there are.
        known: Vec<String>,
        /// One that may have been meant.
        near: Option<String>,
    },
    /// The robot has no joint or link of this name.
    NotThere(String),
    /// It has no members.
    Empty(String),
    /// Its members are no way from one link to another.
    NoChain(String),
}

impl fmt::Display for NoEnds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NoEnds::Unknown { name, near: Some(near), .. } => {
                write!(f, "there is no group `{name}`; did you mean `{near}`?")
            }
            NoEnds::Unknown { name, known, near: None } => {
                write!(f, "there is no group `{name}`; groups: {}", known.join(", "))
            }
            NoEnds::NotThere(name) => write!(f, "the robot has no joint or link `{name}`"),
            NoEnds::Empty(name) => write!(f, "the group `{name}` has no joints"),
            NoEnds::NoChain(name) => write!(f, "the group `{name}` is no chain from one link to another"),
        }
    }
}

impl std::error::Error for NoEnds {}

/// Reads the groups of an SRDF.
///
/// # Errors
/// All errors of the text (with the warnings).
pub fn read_srdf(text: &str) -> Result<(Vec<Group>, Vec<Diagnostic>), Vec<Diagnostic>> {
    let mut out = Diagnostics::default();
    let Some(tree) = parse(text, 0, &mut out) else { return out.finish(None) };
    let robot = tree.root();
    if robot.name() != Some("robot") {
        let name = shown(robot.full_name());
        out.error(robot.span(), format!("the root element is <{name}>, not <robot>"));
        return out.finish(None);
    }
    if let Some(element) = robot.children().find(|c| c.full_name().starts_with("xacro:")) {
        out.error(element.span(), format!("<{}> is for xacro to expand", shown(element.full_name())))
            .hint("`xacro robot.srdf.xacro > robot.srdf` writes the SRDF");
    }
    let mut groups: Vec<Group> = vec![];
    for element in robot.all("group") {
        let Some(name) = named(element, "name", &mut out) else { continue };
        if groups.iter().any(|g| g.name == name) {
            out.error(element.span(), format!("the group `{}` is given twice", shown(&name)));
            continue;
        }
        let mut group = Group { name, ..Group::default() };
        for member in element.children() {
            match member.name() {
                Some("chain") => {
                    let ends = ["base_link", "tip_link"].map(|end| named(member, end, &mut out));
                    if let [Some(base), Some(tip)] = ends {
                        group.chains.push([base, tip]);
                    }
                }
                Some("joint") => group.joints.extend(named(member, "name", &mut out)),
                Some("link") => group.links.extend(named(member, "name", &mut out)),
                Some("group") => group.groups.extend(named(member, "name", &mut out)),
                _ => {
                    let word = shown(member.full_name());
                    out.warning(member.span(), format!("<{word}> in a group is left"));
                }
            }
        }
        groups.push(group);
    }
    if groups.is_empty() && !out.has_errors() {
        out.error(robot.span(), "there is no group");
    }
    out.finish(Some(groups))
}

/// An attribute that must be there.
fn named(element: Element, attribute: &'static str, out: &mut Diagnostics) -> Option<String> {
    let text = element.attribute(attribute).map(|a| a.text.trim().to_string()).filter(|t| !t.is_empty());
    if text.is_none() {
        out.error(element.span(), format!("a <{}> without {attribute}", shown(element.full_name())));
    }
    text
}

impl Mechanism {
    /// The links between which the chain of a group leads: for one of joints and links from the link that the first of them
    /// stands on to the last one.
    ///
    /// # Errors
    /// If there is no such group, or it is no chain.
    pub fn ends_of_group(&self, groups: &[Group], name: &str) -> Result<[String; 2], NoEnds> {
        let mut moved = vec![];
        let mut seen = vec![];
        let mut open = vec![name];
        while let Some(own) = open.pop() {
            let Some(group) = groups.iter().find(|g| g.name == own) else {
                let known: Vec<String> = groups.iter().map(|g| g.name.clone()).collect();
                let near = nearest(own, known.iter().map(String::as_str)).map(str::to_string);
                return Err(NoEnds::Unknown { name: own.into(), known, near });
            };
            if seen.contains(&own) {
                continue;
            }
            seen.push(own);
            open.extend(group.groups.iter().map(String::as_str));
            for [base, tip] in &group.chains {
                self.way_up(base, tip, &mut moved)?;
            }
            for joint in &group.joints {
                let found = self.joints.iter().position(|j| j.name == *joint);
                moved.push(found.ok_or_else(|| NoEnds::NotThere(joint.clone()))?);
            }
            for link in &group.links {
                let body = self.body(link).ok_or_else(|| NoEnds::NotThere(link.clone()))?;
                moved.extend(self.joint_to(body));
            }
        }
        moved.sort_unstable();
        moved.dedup();
        if moved.is_empty() {
            return Err(NoEnds::Empty(name.into()));
        }
        let joint = |j: usize| &self.joints[j];
        let is_first = |&&j: &&usize| moved.iter().all(|&k| joint(k).child != joint(j).parent);
        let is_last = |&&j: &&usize| moved.iter().all(|&k| joint(k).parent != joint(j).child);
        let firsts: Vec<usize> = moved.iter().filter(is_first).copied().collect();
        let lasts: Vec<usize> = moved.iter().filter(is_last).copied().collect();
        match (&firsts[..], &lasts[..]) {
            ([first], [last]) => {
                Ok([joint(*first).parent, joint(*last).child].map(|b| self.bodies[b].name.clone()))
            }
            _ => Err(NoEnds::NoChain(name.into())),
        }
    }

    /// The joints from a link up to another that it stands on.
    fn way_up(&self, base: &str, tip: &str, moved: &mut Vec<usize>) -> Result<(), NoEnds> {
        let find = |name: &str| self.body(name).ok_or_else(|| NoEnds::NotThere(name.into()));
        let (base, mut body) = (find(base)?, find(tip)?);
        while body != base {
            let Some(joint) = self.joint_to(body) else { return Err(NoEnds::NoChain(tip.into())) };
            moved.push(joint);
            body = self.joints[joint].parent;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::description::{Decimals, read_urdf};

    const ARM: &str = r#"<robot name="arm">
        <link name="world"/><link name="base"/><link name="one"/><link name="two"/><link name="tool"/><link name="eye"/>
        <joint name="stand" type="fixed"><parent link="world"/><child link="base"/></joint>
        <joint name="turn" type="continuous"><parent link="base"/><child link="one"/><axis xyz="0 0 1"/></joint>
        <joint name="bend" type="continuous"><parent link="one"/><child link="two"/><axis xyz="0 1 0"/></joint>
        <joint name="hold" type="fixed"><parent link="two"/><child link="tool"/></joint>
        <joint name="look" type="fixed"><parent link="two"/><child link="eye"/></joint>
    </robot>"#;

    fn ends(group: &str) -> Result<[String; 2], NoEnds> {
        let text = format!(
            r#"<robot name="arm"><group name="inner"><joint name="bend"/></group>{group}<group_state name="a" group="b"/></robot>"#
        );
        let (groups, _) = read_srdf(&text).expect("it can be read");
        let (arm, _) = read_urdf(ARM, Decimals::Meant).expect("it can be read");
        arm.ends_of_group(&groups, "g")
    }

    /// Chains, joints, links and groups in groups lead between the same links; branches, gaps and names that are not there do not.
    #[test]
    fn groups_are_chains_or_say_why_not() {
        let whole = Ok(["base".to_string(), "tool".to_string()]);
        for members in [
            r#"<chain base_link="base" tip_link="tool"/>"#,
            r#"<joint name="turn"/><joint name="bend"/><joint name="hold"/>"#,
            r#"<link name="one"/><link name="two"/><link name="tool"/>"#,
            r#"<group name="inner"/><joint name="turn"/><link name="tool"/>"#,
        ] {
            assert_eq!(ends(&format!(r#"<group name="g">{members}</group>"#)), whole, "{members}");
        }
        for (members, why) in [
            ("", NoEnds::Empty("g".into())),
            (r#"<joint name="turn"/><joint name="hold"/>"#, NoEnds::NoChain("g".into())),
            (r#"<link name="tool"/><link name="eye"/>"#, NoEnds::NoChain("g".into())),
            (r#"<chain base_link="tool" tip_link="base"/>"#, NoEnds::NoChain("base".into())),
            (r#"<chain base_link="base" tip_link="hand"/>"#, NoEnds::NotThere("hand".into())),
            (r#"<joint name="twist"/>"#, NoEnds::NotThere("twist".into())),
        ] {
            assert_eq!(ends(&format!(r#"<group name="g">{members}</group>"#)), Err(why), "{members}");
        }
        let unknown =
            NoEnds::Unknown { name: "g".into(), known: vec!["inner".into(), "h".into()], near: None };
        assert_eq!(
            ends(r#"<group name="h"><group name="g"/></group>"#).map_err(|e| e.to_string()),
            Err(unknown.to_string())
        );
        assert_eq!(
            ends(r#"<group name="g"><group name="g"/><joint name="bend"/></group>"#),
            Ok(["one".into(), "two".into()])
        );
    }

    /// All errors at once, with their places.
    #[test]
    fn errors_have_places() {
        let text = "<robot>\n<group>\n<joint/></group>\n<group name=\"g\"><chain base_link=\"a\"/></group>\n<group name=\"g\"/></robot>";
        let errors = read_srdf(text).expect_err("it has errors");
        let words: Vec<String> =
            errors.iter().map(|e| e.render("f", text).lines().next().unwrap_or("").into()).collect();
        assert_eq!(
            words,
            [
                "f:2:1: error: a <group> without name",
                "f:4:17: error: a <chain> without tip_link",
                "f:5:1: error: the group `g` is given twice"
            ]
        );
        for text in ["", "<sdf/>", "<robot/>", "<robot><xacro:include filename='x'/></robot>", "<robot"] {
            assert!(read_srdf(text).is_err(), "{text}");
        }
    }
}
