//! A tree as a model of MuJoCo's that reads back to it.
//!
//! Each body that moves has a solid: capsules to what it carries, or a ball. They touch nothing. Where a mass is given it is
//! written; elsewhere a solid's is MuJoCo's own. A body without mass on which nothing stands is a site.

use crate::description::JointKind;
use crate::description::robot_file::exact_rpy;
use crate::description::tree::{Joint, Mass, Mechanism, Solids, joint_names};
use crate::description::xml::{escaped, number};
use crate::geometry::{Rotation, Transform, Vector, quaternion};
use denavit_symbolic::{Expr, Rational};
use std::fmt::Write;

/// What is to be written next.
enum Step {
    /// A body and the joint to it; none for the root.
    Open(usize, Option<usize>),
    Close,
}

/// The model of a tree whose numbers are constants.
pub fn write_mjcf(tree: &Mechanism) -> String {
    let mut file = File {
        tree,
        solids: Solids::new(tree),
        names: joint_names(tree),
        text: String::new(),
        depth: 2,
        moving: vec![],
    };
    let gravity = tree
        .gravity
        .map_or(String::new(), |g| format!("<option gravity=\"{}\"/>\n  ", g.map(number).join(" ")));
    let _ = write!(
        file.text,
        "<mujoco model=\"{}\">\n  <compiler angle=\"radian\" eulerseq=\"XYZ\" autolimits=\"true\"/>\n  \
         {gravity}<default>\n    <geom contype=\"0\" conaffinity=\"0\"/>\n  </default>\n  <worldbody>\n",
        escaped(&tree.name)
    );
    let mut steps = match tree.bodies[tree.root].name.as_str() {
        // The world is there.
        "world" => file.solids.on[tree.root]
            .iter()
            .rev()
            .map(|&j| Step::Open(tree.joints[j].child, Some(j)))
            .collect(),
        _ => vec![Step::Open(tree.root, None)],
    };
    while let Some(step) = steps.pop() {
        match step {
            Step::Close => file.close(),
            Step::Open(body, joint) => {
                if file.open(body, joint) {
                    steps.push(Step::Close);
                    steps.extend(
                        file.solids.on[body].iter().rev().map(|&j| Step::Open(tree.joints[j].child, Some(j))),
                    );
                }
            }
        }
    }
    file.text.push_str("  </worldbody>\n");
    file.couplings();
    file.keyframes();
    file.text.push_str("</mujoco>\n");
    file.text
}

/// The bodies of which a mass is known that MuJoCo refuses: they are written without it.
pub fn refused_masses(tree: &Mechanism) -> Vec<&str> {
    let is_refused = |mass: &Mass| inertial(mass).is_none();
    let refused = tree.bodies.iter().filter(|b| b.mass.as_ref().is_some_and(is_refused));
    refused.map(|b| b.name.as_str()).collect()
}

/// A file under way.
struct File<'a> {
    tree: &'a Mechanism,
    solids: Solids,
    /// The names of the joints.
    names: Vec<String>,
    text: String,
    depth: usize,
    /// The joints that move, in the order in which they are written.
    moving: Vec<usize>,
}

impl File<'_> {
    fn line(&mut self, line: &str) {
        // What is very deep is not moved in further.
        let _ = writeln!(self.text, "{}{line}", "  ".repeat(self.depth.min(40)));
    }

    fn close(&mut self) {
        self.depth -= 1;
        self.line("</body>");
    }

    /// Configurations with names: a value for each joint that moves.
    fn keyframes(&mut self) {
        if self.tree.poses.is_empty() || self.moving.is_empty() {
            return;
        }
        self.text.push_str("  <keyframe>\n");
        for (name, values) in &self.tree.poses {
            let all: Vec<String> = self.moving.iter().map(|&j| number(self.tree.value(j, values))).collect();
            let _ = writeln!(self.text, "    <key name=\"{}\" qpos=\"{}\"/>", escaped(name), all.join(" "));
        }
        self.text.push_str("  </keyframe>\n");
    }

    /// A body up to what stands on it; false for a site, on which nothing stands.
    fn open(&mut self, body: usize, joint: Option<usize>) -> bool {
        let tree = self.tree;
        let name = escaped(&tree.bodies[body].name);
        let joint = joint.map(|j| (j, &tree.joints[j]));
        let placed = joint.map_or(String::new(), |(_, j)| placed(&j.origin));
        let moves = joint.is_some_and(|(_, j)| j.kind.is_some());
        let mass = tree.bodies[body].mass.as_ref();
        if joint.is_some() && !moves && self.solids.on[body].is_empty() && mass.is_none() {
            self.line(&format!("<site name=\"{name}\"{placed}/>"));
            return false;
        }
        self.line(&format!("<body name=\"{name}\"{placed}>"));
        self.depth += 1;
        if let Some((j, joint)) = joint.filter(|_| moves) {
            self.moving.push(j);
            let line = self.joint(j, joint);
            self.line(&line);
        }
        if let Some(inertial) = mass.and_then(inertial) {
            self.line(&inertial);
        }
        self.solid(body, moves);
        true
    }

    fn joint(&self, j: usize, joint: &Joint) -> String {
        let kind = if joint.kind == Some(JointKind::Prismatic) { "slide" } else { "hinge" };
        let axis = joint.axis.0.map(number).join(" ");
        let [low, high] = joint.limits.map_or([String::new(), String::new()], |l| l.map(number));
        let range = if low.is_empty() { low } else { format!(" range=\"{low} {high}\"") };
        let force = joint.effort.map_or(String::new(), |e| {
            let e = number(e);
            format!(" actuatorfrcrange=\"-{e} {e}\"")
        });
        let drive = joint.drive;
        let drive = [("armature", drive.rotor), ("damping", drive.viscous), ("frictionloss", drive.coulomb)];
        let drive =
            drive.map(|(name, e)| e.map_or(String::new(), |e| format!(" {name}=\"{}\"", number(e)))).concat();
        format!("<joint name=\"{}\" type=\"{kind}\" axis=\"{axis}\"{range}{force}{drive}/>", self.names[j])
    }

    /// Capsules to what a body carries; a ball where there is none and it moves.
    fn solid(&mut self, body: usize, moves: bool) {
        let (ends, radius) = (self.solids.bars(body), self.solids.radius);
        for [x, y, z] in &ends {
            self.line(&format!(
                "<geom type=\"capsule\" size=\"{radius:.4}\" fromto=\"0 0 0 {x:.6} {y:.6} {z:.6}\"/>"
            ));
        }
        if ends.is_empty() && moves {
            self.line(&format!("<geom type=\"sphere\" size=\"{radius:.4}\"/>"));
        }
    }

    fn couplings(&mut self) {
        let tree = self.tree;
        let follows =
            tree.joints.iter().enumerate().filter_map(|(j, joint)| Some((j, joint.follows.as_ref()?)));
        let lines: Vec<String> = follows
            .map(|(j, f)| {
                let (factor, offset) = (number(f.factor.clone().into()), number(f.offset));
                let [one, other] = [&self.names[j], &self.names[f.joint]];
                format!("<joint joint1=\"{one}\" joint2=\"{other}\" polycoef=\"{offset} {factor} 0 0 0\"/>")
            })
            .collect();
        if lines.is_empty() {
            return;
        }
        self.text.push_str("  <equality>\n");
        self.depth = 2;
        lines.iter().for_each(|l| self.line(l));
        self.text.push_str("  </equality>\n");
    }
}

fn value(e: Expr) -> f64 {
    e.eval(|_| None).unwrap_or(f64::NAN)
}

/// Where a frame is, and how it is turned: by fixed angles about x, y, z where these are exact, else by a quaternion.
fn placed(x: &Transform<Expr>) -> String {
    let list = |v: [Expr; 3]| v.map(number).join(" ");
    let is_there = x.translation == Vector::zero();
    let pos = if is_there { String::new() } else { format!(" pos=\"{}\"", list(x.translation.0)) };
    if x.rotation == Rotation::identity() {
        return pos;
    }
    match exact_rpy(&x.rotation) {
        Some(rpy) => format!("{pos} euler=\"{}\"", list(rpy)),
        None => {
            let [x, y, z, w] = quaternion(&x.rotation.map(value));
            let q = [w, x, y, z].map(|c| number(Rational::from_f64(c).map_or(Expr::int(0), Expr::from)));
            format!("{pos} quat=\"{}\"", q.join(" "))
        }
    }
}

/// A mass that a body can have; MuJoCo refuses others.
fn inertial(mass: &Mass) -> Option<String> {
    let [xx, xy, xz, yy, yz, zz] = mass.inertia.map(value);
    let minor = xx * yy - xy * xy;
    let volume = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
    // Of the eigenvalues none is larger than the others together if ½tr − I is not negative either.
    let half = 0.5 * (xx + yy + zz);
    let [a, b, c] = [half - xx, half - yy, half - zz];
    let rest = a * (b * c - yz * yz) - xy * (xy * c + yz * xz) - xz * (xy * yz + b * xz);
    let is_body = value(mass.mass) > 0.0 && xx > 0.0 && minor > 0.0 && volume > 0.0;
    let is_possible = a >= 0.0 && b >= 0.0 && c >= 0.0 && rest >= 0.0;
    if !(is_body && is_possible) {
        return None;
    }
    let com = mass.com.map(number).join(" ");
    let [xx, xy, xz, yy, yz, zz] = mass.inertia.map(number);
    let m = number(mass.mass);
    Some(format!("<inertial pos=\"{com}\" mass=\"{m}\" fullinertia=\"{xx} {yy} {zz} {xy} {xz} {yz}\"/>"))
}
