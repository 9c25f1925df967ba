//! A package for ROS 2: the functions in C, the arm around them in plain C++ with names of joints and links, and plug-ins for
//! MoveIt 2 (`kinematics::KinematicsBase`) and ros2_control (`kinematics_interface::KinematicsInterface`).

mod links;

pub use links::{Link, Links};

use super::tables::{list, wrapped};
use super::{Generated, PackageOptions, Unable, Wanted, generate};
use denavit::description::{Convention, Description, JointKind};
use denavit::inverse::Goal;
use denavit::robot::Robot;
use denavit::space::JointSpace;
use denavit_emit::{File, Language, Precision};
use std::fmt::Write;

/// Generates the package: `fk`, `frames`, `jacobian` and `ik` with the values of parameters in them, and what stands around them.
///
/// # Errors
/// If a parameter has no value; if another function is wanted.
pub fn generate_ros2(
    description: &Description,
    links: &Links,
    options: &PackageOptions,
) -> Result<Generated, Unable> {
    let functions = [Wanted::Pose, Wanted::Frames, Wanted::Jacobian, Wanted::Inverse];
    if let Some(other) = options.functions.iter().find(|w| !functions.contains(w)) {
        return Err(Unable::NotInInterface(*other));
    }
    let inner = PackageOptions {
        language: Language::C,
        functions: functions.to_vec(),
        precision: Precision::Double,
        fixed: true,
        ..options.clone()
    };
    let mut made = generate(description, &inner)?;
    let Some(inverse) = &made.inverse else {
        made.files.clear();
        return Ok(made);
    };
    let name = made.files.iter().find_map(|f| f.path.strip_suffix(".h")).unwrap_or("arm").to_string();
    let given: Vec<usize> = {
        let variables = description.variables();
        let place = |s| variables.iter().position(|v| v.symbol == s);
        inverse.given.iter().filter_map(|s| place(*s)).collect()
    };
    let robot = Robot::numeric(&description.made_rigid().0).map_err(Unable::Fixed)?;
    let package = Package {
        title: &description.name,
        package: format!("{name}_kinematics"),
        name,
        links,
        size: JointSpace::new(description, &robot).length(),
        robot,
        convention: description.convention,
        is_slide: description.variables().iter().map(|v| v.kind == JointKind::Prismatic).collect(),
        given,
        goal: options.inverse.goal,
    };
    made.files = package.files(&made.files);
    Ok(made)
}

struct Package<'a> {
    title: &'a str,
    /// Of the C functions.
    name: String,
    package: String,
    links: &'a Links,
    robot: Robot<f64>,
    /// What lengths are compared with, metres.
    size: f64,
    convention: Convention,
    is_slide: Vec<bool>,
    given: Vec<usize>,
    goal: Goal,
}

impl Package<'_> {
    /// The package around the files in C.
    fn files(&self, own: &[File]) -> Vec<File> {
        let own = own.iter().filter(|f| f.path != "Makefile").map(|f| {
            let folder = if f.path.starts_with("test_") { "test" } else { "src" };
            File { path: format!("{folder}/{}", f.path), text: f.text.clone() }
        });
        let mut files: Vec<File> = [
            ("package.xml", include_str!("package.xml")),
            ("CMakeLists.txt", include_str!("CMakeLists.txt")),
            ("Makefile", include_str!("Makefile")),
            ("README.md", include_str!("README.md")),
            ("moveit_plugin.xml", include_str!("moveit_plugin.xml")),
            ("control_plugin.xml", include_str!("control_plugin.xml")),
            ("config/kinematics.yaml", include_str!("kinematics.yaml")),
            ("config/control.yaml", include_str!("control.yaml")),
            ("include/@package@/arm.hpp", include_str!("arm.hpp")),
            ("src/arm.cpp", include_str!("arm.cpp")),
            ("src/moveit_plugin.cpp", include_str!("moveit_plugin.cpp")),
            ("src/control_plugin.cpp", include_str!("control_plugin.cpp")),
            ("test/test_arm.cpp", include_str!("test_arm.cpp")),
        ]
        .into_iter()
        .map(|(path, text)| File { path: self.filled(path), text: self.filled(text) })
        .collect();
        files.extend(own);
        files
    }

    /// A template with the facts of the arm in it.
    fn filled(&self, template: &str) -> String {
        let Links { base, tip, joints, links, group } = self.links;
        let texts = |names: Vec<&String>| {
            let all: Vec<String> = names.into_iter().map(|n| literal(n)).collect();
            wrapped("    ", &all.join(", "), "").trim().to_string()
        };
        let flags = |all: &[bool]| all.iter().map(bool::to_string).collect::<Vec<_>>().join(", ");
        let given: Vec<String> = self.given.iter().map(usize::to_string).collect();
        let met = match self.goal {
            Goal::Pose => [true; 4],
            Goal::Position => [false, false, false, true],
            Goal::PositionAndAxis => [false, false, true, true],
        };
        let given_values = if given.is_empty() { "  (void)given;\n" } else { "" };
        let given_argument = if given.is_empty() { "" } else { "given.data(), " };
        let head = format!("# {}: generated by Denavit {}.", line(self.title), env!("CARGO_PKG_VERSION"));
        let free_words = if given.is_empty() {
            String::new()
        } else {
            let names: Vec<String> = self.given.iter().map(|&j| format!("`{}`", joints[j])).collect();
            format!(
                "- The arm has more joints than a pose fixes; {} may be chosen freely. The nearest configuration is \
                 searched over them; with redundant joints locked, and where all solutions are asked for, they have the \
                 values of the seed, or (`ALL_DISCRETIZED`) values a step of the search resolution apart.\n",
                names.join(", ")
            )
        };
        let table: String = joints.iter().enumerate().fold(String::new(), |mut text, (j, name)| {
            let kind = if self.is_slide[j] { "slides (m)" } else { "turns (rad)" };
            let _ = writeln!(text, "| `{}` | {kind} |", line(name));
            text
        });
        let names: Vec<String> = links.iter().map(|l| format!("`{}`", line(&l.name))).collect();
        template
            .replace("@head@", &head)
            .replace("@given_values@\n", given_values)
            .replace("@given_argument@", given_argument)
            .replace("@motions@", &self.motions())
            .replace("@mounts@", &mounts(links))
            .replace("@known@", &known(links))
            .replace("@frames@", &(self.robot.links.len() + 1).to_string())
            .replace("@is_slide@", &flags(&self.is_slide))
            .replace("@is_met@", &flags(&met))
            .replace("@joint_names@", &texts(joints.iter().collect()))
            .replace("@link_names@", &texts(links.iter().map(|l| &l.name).collect()))
            .replace("@free@", &given.join(", "))
            .replace("@free_words@", &free_words)
            .replace("@joints_table@", &table)
            .replace("@links_list@", &names.join(", "))
            .replace("@base_text@", &literal(base))
            .replace("@tip_text@", &literal(tip))
            .replace("@base_xml@", &escaped(base))
            .replace("@tip_xml@", &escaped(tip))
            .replace("@title_xml@", &escaped(self.title))
            .replace("@base_yaml@", &literal(base))
            .replace("@tip_yaml@", &literal(tip))
            .replace("@group@", &group.as_deref().map_or("the_group".into(), literal))
            .replace("@version@", env!("CARGO_PKG_VERSION"))
            .replace("@size@", &format!("{:?}", self.size))
            .replace("@title@", &line(self.title))
            .replace("@base@", &line(base))
            .replace("@tip@", &line(tip))
            .replace("@package@", &self.package)
            .replace("@PACKAGE@", &self.package.to_uppercase())
            .replace("@NAME@", &self.name.to_uppercase())
            .replace("@name@", &self.name)
            .replace("@n@", &joints.len().to_string())
    }

    /// What the joints move: entries of the table in C++.
    fn motions(&self) -> String {
        let mut text = String::new();
        for (k, row) in self.robot.links.iter().enumerate() {
            // Row k leads from frame k to frame k + 1; in the standard convention it turns about the z axis of the former.
            let axis = if self.convention == Convention::Standard { k } else { k + 1 };
            for (terms, is_slide) in [(&row.theta.terms, false), (&row.d.terms, true)] {
                for (joint, rate) in terms {
                    let _ = writeln!(text, "  {{{joint}, {axis}, {}, {is_slide}, {rate:?}}},", k + 1);
                }
            }
        }
        text
    }
}

/// Where links stand on frames: entries of the table in C++.
fn mounts(links: &[Link]) -> String {
    let mut text = String::new();
    for link in links {
        let rows: Vec<String> = link.on_frame.iter().map(|row| list(row, 6)).collect();
        let _ = writeln!(text, "  {{{}, {{\n{}}}}},", link.frame, rows.join(",\n"));
    }
    text
}

/// Poses of links: entries of the table in C++.
fn known(links: &[Link]) -> String {
    let mut text = String::new();
    for link in links {
        for (q, pose) in &link.known {
            let rows: Vec<String> = pose.iter().map(|row| list(row, 6)).collect();
            let _ = writeln!(
                text,
                "  {{{}, {}, {{\n{}}}}},",
                list(q, 4).trim_start(),
                literal(&link.name),
                rows.join(",\n")
            );
        }
    }
    text
}

/// A text without line breaks, which comments can hold.
fn line(text: &str) -> String {
    text.replace(|c: char| c.is_control(), " ").replace("*/", "* /").replace('\\', "/")
}

/// A text in quotation marks, as C++, and YAML, read it.
fn literal(text: &str) -> String {
    let inner: String = text.chars().filter(|c| !c.is_control()).fold(String::new(), |mut out, c| {
        if matches!(c, '"' | '\\') {
            out.push('\\');
        }
        out.push(c);
        out
    });
    format!("\"{inner}\"")
}

/// A text in XML.
fn escaped(text: &str) -> String {
    line(text).replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
