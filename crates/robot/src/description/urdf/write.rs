//! A description as a URDF that reads back to it.
//!
//! A joint's origin is what is constant before its motion, its axis z; rows without a variable are part of the next origin. A row
//! that adds variables is one joint for each, with empty links between; those that are not its own `mimic` them. Angles have 17
//! digits, by which they are found again, lengths are decimals.

use crate::description::cell::decimal;
use crate::description::robot_file::exact_rpy;
use crate::description::{Description, JointKind, Row};
use crate::geometry::{Rotation, Transform};
use denavit_symbolic::{Angle, Expr, Rational, Symbol};
use std::collections::HashSet;
use std::fmt::Write;

/// The URDF of a description.
///
/// # Errors
/// The parameters without value.
pub fn write_urdf(d: &Description) -> Result<String, Vec<Symbol>> {
    let missing: Vec<Symbol> = d.parameters.iter().filter(|p| p.value.is_none()).map(|p| p.symbol).collect();
    if !missing.is_empty() {
        return Err(missing);
    }
    let value = |e: Expr| e.substitute(|s| d.exact_value(s));
    let mut file = Urdf {
        text: format!("<robot name=\"{}\">\n", escaped(&d.name)),
        names: HashSet::new(),
        on: String::new(),
    };
    file.on = file.link("base");
    let variables: Vec<Symbol> = d.variables().iter().map(|v| v.symbol).collect();
    let names: Vec<String> = named_joints(d);
    let mut constant = d.base.map(value);
    for (i, row) in d.rows.iter().enumerate() {
        let screws = row.screws(d.convention);
        constant = screws.before.iter().fold(constant, |x, s| x * s.transform().map(value));
        let parts = [(JointKind::Revolute, screws.joint.angle), (JointKind::Prismatic, screws.joint.length)];
        let mut moves: Vec<(JointKind, usize, Rational)> = vec![];
        for (kind, cell) in parts {
            let mut rest = Angle::of(value(cell));
            let is_joint = |e: &Expr| e.as_symbol().and_then(|s| variables.iter().position(|&v| v == s));
            moves.extend(rest.terms.iter().filter_map(|(e, k)| Some((kind, is_joint(e)?, k.clone()))));
            rest.terms.retain(|t| is_joint(&t.0).is_none());
            constant = constant
                * match kind {
                    JointKind::Revolute => Transform::rotation_z(rest.to_expr()),
                    JointKind::Prismatic => Transform::translation_z(rest.to_expr()),
                };
        }
        // Its own variable first, so that what follows it stands behind it.
        let own = row.variable.and_then(|v| variables.iter().position(|&s| s == v.symbol));
        moves.sort_by_key(|m| (Some(m.1) != own, m.1));
        for (k, (kind, variable, factor)) in moves.iter().enumerate() {
            let is_unit = factor.abs().is_one();
            let is_own = k == 0 && own == Some(*variable) && is_unit;
            if k == 0 && own == Some(*variable) && !is_unit {
                file.driver(&names[*variable], *kind);
            }
            file.joint(
                &Moving {
                    row,
                    number: i + 1,
                    kind: *kind,
                    is_own,
                    factor,
                    names: &names,
                    variable: *variable,
                },
                &constant,
            );
            constant = Transform::identity();
        }
        constant = screws.behind.iter().fold(constant, |x, s| x * s.transform().map(value));
    }
    let tool = constant * d.tool.map(value);
    let (parent, child) = (file.on.clone(), file.link("tool"));
    let name = file.unique("tool_joint");
    let _ = writeln!(file.text, "  <joint name=\"{name}\" type=\"fixed\">");
    file.ends(&tool, &parent, &child);
    file.text.push_str("  </joint>\n</robot>\n");
    Ok(file.text)
}

/// The names of the joints that move by themselves; `q3` where there is none.
fn named_joints(d: &Description) -> Vec<String> {
    let own = d.rows.iter().filter_map(|r| Some((r.variable?, r.name.as_deref())));
    let mut seen = HashSet::new();
    let name = |(v, name): (crate::description::Variable, Option<&str>)| {
        let plain =
            name.filter(|n| !n.trim().is_empty()).map_or_else(|| v.symbol.name().to_string(), escaped);
        if seen.insert(plain.clone()) { plain } else { format!("{plain}_{}", v.symbol.name()) }
    };
    own.map(name).collect()
}

/// A joint to be written.
struct Moving<'a> {
    row: &'a Row,
    number: usize,
    kind: JointKind,
    is_own: bool,
    factor: &'a Rational,
    names: &'a [String],
    variable: usize,
}

/// A file under way.
struct Urdf {
    text: String,
    names: HashSet<String>,
    /// The link that the next joint stands on.
    on: String,
}

impl Urdf {
    fn unique(&mut self, name: &str) -> String {
        let mut found = name.to_string();
        while !self.names.insert(found.clone()) {
            found.push('_');
        }
        found
    }

    fn link(&mut self, name: &str) -> String {
        let name = self.unique(name);
        let _ = writeln!(self.text, "  <link name=\"{name}\"/>");
        name
    }

    fn joint(&mut self, joint: &Moving, origin: &Transform<Expr>) {
        let own = &joint.names[joint.variable];
        let (parent, child) = (self.on.clone(), self.link(&format!("link{}", joint.number)));
        let name =
            if joint.is_own { own.clone() } else { self.unique(&format!("{own}_in_{}", joint.number)) };
        // A factor of its own is the way round of the axis, if it is −1.
        let is_turned = joint.is_own && *joint.factor == -Rational::ONE;
        let limits = joint.row.limits.filter(|_| joint.is_own);
        let kind = match (joint.kind, limits) {
            (JointKind::Revolute, None) => "continuous",
            (JointKind::Revolute, Some(_)) => "revolute",
            (JointKind::Prismatic, _) => "prismatic",
        };
        let _ = writeln!(self.text, "  <joint name=\"{name}\" type=\"{kind}\">");
        self.ends(origin, &parent, &child);
        let _ = writeln!(self.text, "    <axis xyz=\"0 0 {}\"/>", if is_turned { -1 } else { 1 });
        if !joint.is_own {
            let factor = number(joint.factor.clone().into());
            let _ = writeln!(self.text, "    <mimic joint=\"{own}\" multiplier=\"{factor}\"/>");
        }
        let speed = joint.row.velocity.filter(|_| joint.is_own);
        let speed = speed.map_or(String::new(), |v| format!(" velocity=\"{}\"", number(v)));
        if let Some([low, high]) = limits {
            let _ = writeln!(
                self.text,
                "    <limit lower=\"{}\" upper=\"{}\" effort=\"0\"{speed}/>",
                number(low),
                number(high)
            );
        } else if !speed.is_empty() {
            let _ = writeln!(self.text, "    <limit effort=\"0\"{speed}/>");
        }
        self.text.push_str("  </joint>\n");
        self.on = child;
    }

    /// A joint that moves nothing but what follows it: a joint with a gear follows it.
    fn driver(&mut self, name: &str, kind: JointKind) {
        let (parent, child) = (self.on.clone(), self.link(&format!("{name}_driver")));
        let kind = if kind == JointKind::Revolute { "continuous" } else { "prismatic" };
        let _ = writeln!(self.text, "  <joint name=\"{name}\" type=\"{kind}\">");
        self.ends(&Transform::identity(), &parent, &child);
        self.text.push_str("    <axis xyz=\"0 0 1\"/>\n  </joint>\n");
    }

    fn ends(&mut self, origin: &Transform<Expr>, parent: &str, child: &str) {
        let list = |v: [Expr; 3]| v.map(number).join(" ");
        let rpy = exact_rpy(&origin.rotation).unwrap_or_else(|| numeric_rpy(&origin.rotation));
        let _ =
            writeln!(self.text, "    <origin xyz=\"{}\" rpy=\"{}\"/>", list(origin.translation.0), list(rpy));
        let _ = writeln!(self.text, "    <parent link=\"{parent}\"/>\n    <child link=\"{child}\"/>");
    }
}

/// A decimal, or the 17 digits of the nearest double.
fn number(e: Expr) -> String {
    let short = |r: &Rational| Some(decimal(r)).filter(|t| !t.contains('/') && t.len() <= 25);
    let exact = e.as_number().as_ref().and_then(short);
    exact.unwrap_or_else(|| format!("{}", e.eval(|_| None).unwrap_or(f64::NAN) + 0.0))
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

fn escaped(text: &str) -> String {
    let plain = text.replace(|c: char| c.is_control(), " ");
    plain.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}
