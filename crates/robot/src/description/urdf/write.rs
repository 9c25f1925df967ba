//! A description as a URDF that reads back to it.
//!
//! Angles have 17 digits, by which they are found again, lengths are decimals. ROS's own parser asks for effort and velocity of
//! every limit, and for limits of every slide: 0 and a distance that nothing has stand for what is not known.

use crate::description::robot_file::exact_rpy;
use crate::description::tree::{Joint, Mass, Mechanism};
use crate::description::xml::{escaped, number};
use crate::description::{Description, JointKind, MissingValue};
use crate::geometry::Rotation;
use denavit_symbolic::{Expr, Rational};
use std::fmt::Write;

/// Where no slide goes, metres: limits so far away are read as none.
const NOWHERE: &str = "1e9";

/// The URDF of a description.
///
/// # Errors
/// If a parameter has no value.
pub fn write_urdf(d: &Description) -> Result<String, MissingValue> {
    let tree = Mechanism::of(d)?;
    let mut text = format!("<robot name=\"{}\">\n", escaped(&tree.name));
    let link = |text: &mut String, body: usize| {
        let name = escaped(&tree.bodies[body].name);
        let _ = match &tree.bodies[body].mass {
            Some(mass) => writeln!(text, "  <link name=\"{name}\">\n{}  </link>", inertial(mass)),
            None => writeln!(text, "  <link name=\"{name}\"/>"),
        };
    };
    link(&mut text, tree.root);
    for joint in &tree.joints {
        link(&mut text, joint.child);
        write_joint(&mut text, &tree, joint);
    }
    text.push_str("</robot>\n");
    Ok(text)
}

fn write_joint(text: &mut String, tree: &Mechanism, joint: &Joint) {
    let list = |v: [Expr; 3]| v.map(number).join(" ");
    let kind = match (joint.kind, joint.limits) {
        (None, _) => "fixed",
        (Some(JointKind::Revolute), None) => "continuous",
        (Some(JointKind::Revolute), Some(_)) => "revolute",
        (Some(JointKind::Prismatic), _) => "prismatic",
    };
    let origin = &joint.origin;
    let rpy = exact_rpy(&origin.rotation).unwrap_or_else(|| numeric_rpy(&origin.rotation));
    let [parent, child] = [joint.parent, joint.child].map(|b| escaped(&tree.bodies[b].name));
    let _ = writeln!(text, "  <joint name=\"{}\" type=\"{kind}\">", escaped(&joint.name));
    let _ = writeln!(text, "    <origin xyz=\"{}\" rpy=\"{}\"/>", list(origin.translation.0), list(rpy));
    let _ = writeln!(text, "    <parent link=\"{parent}\"/>\n    <child link=\"{child}\"/>");
    if joint.kind.is_some() {
        let _ = writeln!(text, "    <axis xyz=\"{}\"/>", list(joint.axis.0));
    }
    if let Some(follows) = &joint.follows {
        let leader = escaped(&tree.joints[follows.joint].name);
        let factor = number(follows.factor.clone().into());
        let _ = writeln!(text, "    <mimic joint=\"{leader}\" multiplier=\"{factor}\"/>");
    }
    let known = |x: Option<Expr>| x.map_or("0".into(), number);
    let drive = format!("effort=\"{}\" velocity=\"{}\"", known(joint.effort), known(joint.velocity));
    let ends = match (joint.kind, joint.limits) {
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
