//! A tree as a URDF that reads back to it, with simple solids in place of its links.
//!
//! Angles have 17 digits, by which they are found again, lengths are decimals. ROS's own parser asks for effort and velocity of
//! every limit, and for limits of every slide: 0 and a distance that nothing has stand for what is not known.

use crate::description::JointKind;
use crate::description::robot_file::exact_rpy;
use crate::description::tree::{Follows, Joint, Mass, Mechanism, Solids, joint_names};
use crate::description::xml::{escaped, number};
use crate::geometry::Rotation;
use denavit_symbolic::{Expr, Rational};
use std::fmt::Write;

/// Where no slide goes, metres: limits so far away are read as none.
const NOWHERE: &str = "1e9";

/// The URDF of a tree whose numbers are constants.
pub fn write_urdf(tree: &Mechanism) -> String {
    let (solids, names) = (Solids::new(tree), joint_names(tree));
    let mut text = format!("<robot name=\"{}\">\n", escaped(&tree.name));
    let link = |text: &mut String, body: usize, moves: bool| {
        let name = escaped(&tree.bodies[body].name);
        let mass = tree.bodies[body].mass.as_ref().map_or(String::new(), inertial);
        let inner = mass + &looks(&solids, body, moves);
        let _ = match inner.is_empty() {
            true => writeln!(text, "  <link name=\"{name}\"/>"),
            false => writeln!(text, "  <link name=\"{name}\">\n{inner}  </link>"),
        };
    };
    link(&mut text, tree.root, false);
    for (j, joint) in tree.joints.iter().enumerate() {
        link(&mut text, joint.child, joint.kind.is_some());
        write_joint(&mut text, tree, &names, j);
    }
    text.push_str("</robot>\n");
    text
}

/// Cylinders to what a body carries; a ball where there is none and it moves.
fn looks(solids: &Solids, body: usize, moves: bool) -> String {
    let (ends, radius) = (solids.bars(body), solids.radius);
    let visual = |origin: &str, shape: &str| {
        format!("    <visual>\n{origin}      <geometry>{shape}</geometry>\n    </visual>\n")
    };
    if ends.is_empty() && moves {
        return visual("", &format!("<sphere radius=\"{radius:.4}\"/>"));
    }
    let bar = |&[x, y, z]: &[f64; 3]| {
        let level = x.hypot(y);
        // About y away from z, then about z.
        let (pitch, yaw) = (level.atan2(z), if level > 0.0 { y.atan2(x) } else { 0.0 });
        let middle = [x, y, z].map(|c| format!("{:.6}", c / 2.0)).join(" ");
        let origin = format!("      <origin xyz=\"{middle}\" rpy=\"0 {pitch:.6} {yaw:.6}\"/>\n");
        visual(&origin, &format!("<cylinder radius=\"{radius:.4}\" length=\"{:.6}\"/>", level.hypot(z)))
    };
    ends.iter().map(bar).collect()
}

fn write_joint(text: &mut String, tree: &Mechanism, names: &[String], j: usize) {
    let joint: &Joint = &tree.joints[j];
    let list = |v: [Expr; 3]| v.map(number).join(" ");
    // A joint that follows another has limits through it.
    let through = |f: &Follows| tree.limits_among(j, &[f.joint]);
    let limits = joint.limits.or_else(|| joint.follows.as_ref().and_then(through));
    let kind = match (joint.kind, limits) {
        (None, _) => "fixed",
        (Some(JointKind::Revolute), None) => "continuous",
        (Some(JointKind::Revolute), Some(_)) => "revolute",
        (Some(JointKind::Prismatic), _) => "prismatic",
    };
    let origin = &joint.origin;
    let rpy = exact_rpy(&origin.rotation).unwrap_or_else(|| numeric_rpy(&origin.rotation));
    let [parent, child] = [joint.parent, joint.child].map(|b| escaped(&tree.bodies[b].name));
    let _ = writeln!(text, "  <joint name=\"{}\" type=\"{kind}\">", names[j]);
    let _ = writeln!(text, "    <origin xyz=\"{}\" rpy=\"{}\"/>", list(origin.translation.0), list(rpy));
    let _ = writeln!(text, "    <parent link=\"{parent}\"/>\n    <child link=\"{child}\"/>");
    if joint.kind.is_some() {
        let _ = writeln!(text, "    <axis xyz=\"{}\"/>", list(joint.axis.0));
    }
    if let Some(follows) = &joint.follows {
        let (leader, factor) = (&names[follows.joint], number(follows.factor.clone().into()));
        let offset = match follows.offset.is_zero() {
            true => String::new(),
            false => format!(" offset=\"{}\"", number(follows.offset)),
        };
        let _ = writeln!(text, "    <mimic joint=\"{leader}\" multiplier=\"{factor}\"{offset}/>");
    }
    let known = |x: Option<Expr>| x.map_or("0".into(), number);
    let drive = format!("effort=\"{}\" velocity=\"{}\"", known(joint.effort), known(joint.velocity));
    let ends = match (joint.kind, limits) {
        (Some(_), Some([low, high])) => Some((number(low), number(high))),
        (Some(JointKind::Prismatic), None) => Some((format!("-{NOWHERE}"), NOWHERE.into())),
        _ => None,
    };
    if let Some((low, high)) = ends {
        let _ = writeln!(text, "    <limit lower=\"{low}\" upper=\"{high}\" {drive}/>");
    } else if joint.velocity.is_some() || joint.effort.is_some() {
        let _ = writeln!(text, "    <limit {drive}/>");
    }
    if joint.drive.viscous.is_some() || joint.drive.coulomb.is_some() {
        let [damping, friction] = [joint.drive.viscous, joint.drive.coulomb].map(known);
        let _ = writeln!(text, "    <dynamics damping=\"{damping}\" friction=\"{friction}\"/>");
    }
    text.push_str("  </joint>\n");
}

/// A body's mass about its centre, along the axes of its frame.
fn inertial(mass: &Mass) -> String {
    let [xx, xy, xz, yy, yz, zz] = mass.inertia.map(number);
    format!(
        "    <inertial>\n      <origin xyz=\"{}\"/>\n      <mass value=\"{}\"/>\n      \
         <inertia ixx=\"{xx}\" ixy=\"{xy}\" ixz=\"{xz}\" iyy=\"{yy}\" iyz=\"{yz}\" izz=\"{zz}\"/>\n    </inertial>\n",
        mass.com.map(number).join(" "),
        number(mass.mass)
    )
}

/// Roll, pitch and yaw in doubles.
fn numeric_rpy(r: &Rotation<Expr>) -> [Expr; 3] {
    let m = r.map(|e| e.eval(|_| None).unwrap_or(f64::NAN)).rows();
    let level = m[0][0].hypot(m[1][0]);
    let angles = match level > 1e-9 {
        true => [m[2][1].atan2(m[2][2]), (-m[2][0]).atan2(level), m[1][0].atan2(m[0][0])],
        false => [0.0, (-m[2][0]).atan2(level), (-m[0][1]).atan2(m[1][1])],
    };
    angles.map(|x| Rational::from_f64(x).map_or(Expr::int(0), Expr::from))
}
