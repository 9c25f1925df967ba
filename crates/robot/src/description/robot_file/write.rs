//! A description as a robot file that reads back to it.

use crate::description::branches::{BASE, RowTree};
use crate::description::cell::{variable_number, write_cell};
use crate::description::linkage::{Linkage, Told};
use crate::description::units::Quantity;
use crate::description::{Convention, Description, JointKind, Row};
use crate::geometry::{Axis, Rotation, Transform};
use denavit_symbolic::{Expr, Rational, Symbol, equal, expr::Node};
use std::f64::consts::PI;
use std::fmt::Write;

/// The robot file of a description.
pub fn write_toml(d: &Description) -> String {
    let mut out = String::new();
    write_head(&mut out, d);
    for row in &d.rows {
        out.push_str("\n[[joints]]\n");
        write_row(&mut out, row, d.convention);
    }
    for (name, frame) in [("base", &d.base), ("tool", &d.tool)] {
        if *frame != Transform::identity() {
            let _ = writeln!(out, "\n[{name}]");
            write_frame(&mut out, frame);
        }
    }
    write_poses(&mut out, d);
    out
}

/// The robot file of a tree of rows.
pub fn write_tree(tree: &RowTree) -> String {
    write_rows(tree, &tree.all_rows()).whole()
}

/// The robot file of a tree of rows; `all` are these, and others in which its parameters stand.
fn write_rows(tree: &RowTree, all: &Description) -> Parts {
    let mut out = String::new();
    let d = tree.all_rows();
    write_head(&mut out, all);
    if let Some(tip) = &tree.tip {
        // Keys stand before the tables.
        let key = format!("tip = {}\n", quoted(tip));
        let at = out.find("\n\n[parameters]").map_or(out.len(), |at| at + 1);
        out.insert_str(at, &key);
    }
    let names_of = |a: Option<usize>| name_of(tree, a);
    for (j, row) in tree.rows.iter().enumerate() {
        out.push_str("\n[[joints]]\n");
        if tree.after[j] != j.checked_sub(1) {
            let _ = writeln!(out, "after = {}", names_of(tree.after[j]));
        }
        write_row(&mut out, row, Convention::Khalil);
    }
    for frame in &tree.frames {
        let _ = writeln!(out, "\n[[frames]]\nname = {}\non = {}", quoted(&frame.name), names_of(frame.on));
        write_frame(&mut out, &frame.pose);
    }
    let mut rest = String::new();
    if tree.base != Transform::identity() {
        rest.push_str("\n[base]\n");
        write_frame(&mut rest, &tree.base);
    }
    write_poses(&mut rest, &d);
    Parts { rows: out, rest }
}

/// The robot file of a tree with closed loops.
pub fn write_linkage(linkage: &Linkage) -> String {
    let tree = RowTree { poses: linkage.poses.clone(), ..linkage.tree.clone() };
    let mut out = write_rows(&tree, &linkage.all_rows());
    let names_of = |a: Option<usize>| name_of(&tree, a);
    let mut tail = String::new();
    for closure in &linkage.closures {
        tail.push_str("\n[[closures]]\n");
        if let Some(name) = &closure.name {
            let _ = writeln!(tail, "name = {}", quoted(name));
        }
        for (key, side) in [("left", &closure.left), ("right", &closure.right)] {
            let cells = Convention::Khalil.order().iter().filter(|c| !c.of(&side.row).is_zero()).map(|c| {
                let quantity = if c.turns() { Quantity::Angle } else { Quantity::Length };
                format!(", {} = {}", c.key(Convention::Khalil), cell(c.of(&side.row), quantity))
            });
            let cells: String = cells.collect();
            let _ = writeln!(tail, "{key} = {{ after = {}{cells} }}", names_of(side.after));
        }
    }
    if !linkage.modes.is_empty() {
        tail.push_str("\n[modes]\n");
    }
    for mode in &linkage.modes {
        let told = match &mode.told {
            Told::Signs(text) => text.clone(),
            Told::Relations(all) => {
                let relation = |(symbol, e): &(Symbol, Expr)| {
                    let kind = linkage.kind(*symbol).unwrap_or(JointKind::Revolute);
                    let quantity = super::quantity_of(kind);
                    format!("{} = {}", symbol.name(), write_cell(*e, quantity))
                };
                all.iter().map(relation).collect::<Vec<_>>().join(", ")
            }
        };
        let _ = writeln!(tail, "{} = {}", key(&mode.name), quoted(&told));
    }
    out.rows.push_str(&tail);
    out.whole()
}

/// A file in parts.
struct Parts {
    rows: String,
    rest: String,
}

impl Parts {
    fn whole(self) -> String {
        self.rows + &self.rest
    }
}

/// What a row is called behind `after`.
fn name_of(tree: &RowTree, a: Option<usize>) -> String {
    match a {
        None => quoted(BASE),
        Some(a) => tree.rows[a].name.as_ref().map_or((a + 1).to_string(), |n| quoted(n)),
    }
}

/// What a file begins with: name, convention, source, gravity and parameters.
pub(super) fn write_head(out: &mut String, d: &Description) {
    let _ = writeln!(out, "name = {}\nconvention = \"{}\"", quoted(&d.name), d.convention);
    if let Some(source) = &d.source {
        let _ = writeln!(out, "source = {}", quoted(source));
    }
    if let Some(gravity) = &d.gravity {
        let _ = writeln!(out, "gravity = {}", list(gravity, Quantity::Acceleration));
    }
    if !d.parameters.is_empty() {
        out.push_str("\n[parameters]\n");
        for p in &d.parameters {
            let quantity = quantity_of_parameter(d, p.symbol.into());
            let value = p.value.map_or("{}".into(), |v| cell(v, quantity));
            let _ = writeln!(out, "{} = {value}", key(&p.symbol.name()));
        }
    }
}

/// `[poses]`
pub(super) fn write_poses(out: &mut String, d: &Description) {
    if !d.poses.is_empty() {
        out.push_str("\n[poses]\n");
        let driven = d.variables().into_iter().filter(|v| variable_number(&v.symbol.name()).is_some());
        let kinds: Vec<JointKind> = driven.map(|v| v.kind).collect();
        for (name, pose) in &d.poses {
            let values: Vec<String> =
                pose.iter().zip(&kinds).map(|(&e, &k)| cell(e, super::quantity_of(k))).collect();
            let _ = writeln!(out, "{} = [{}]", key(name), values.join(", "));
        }
    }
}

fn write_row(out: &mut String, row: &Row, convention: Convention) {
    if let Some(name) = &row.name {
        let _ = writeln!(out, "name = {}", quoted(name));
    }
    for c in convention.order().iter().filter(|c| !c.of(row).is_zero()) {
        let quantity = if c.turns() { Quantity::Angle } else { Quantity::Length };
        let _ = writeln!(out, "{} = {}", c.key(convention), cell(c.of(row), quantity));
    }
    write_limits(out, row);
    let slides = row.variable.is_some_and(|v| v.kind == JointKind::Prismatic);
    let rotor = if slides { Quantity::Mass } else { Quantity::Inertia };
    let one = |key: &str, e: Option<Expr>, quantity| e.map(|e| format!("{key} = {}", cell(e, quantity)));
    let many = |key: &str, e: Option<&[Expr]>, quantity| e.map(|e| format!("{key} = {}", list(e, quantity)));
    let lines = [
        one("mass", row.mass, Quantity::Mass),
        many("com", row.com.as_ref().map(|e| &e[..]), Quantity::Length),
        many("inertia", row.inertia.as_ref().map(|e| &e[..]), Quantity::Inertia),
        many("first_moment", row.first_moment.as_ref().map(|e| &e[..]), Quantity::FirstMoment),
        many("inertia_at_origin", row.inertia_at_origin.as_ref().map(|e| &e[..]), Quantity::Inertia),
        one("rotor", row.rotor, rotor),
        one("viscous", row.viscous, Quantity::Number),
        one("coulomb", row.coulomb, Quantity::Number),
    ];
    lines.into_iter().flatten().for_each(|line| {
        let _ = writeln!(out, "{line}");
    });
}

/// How far and how fast a row's joint moves.
pub(super) fn write_limits(out: &mut String, row: &Row) {
    let turns = row.variable.is_none_or(|v| v.kind == JointKind::Revolute);
    let (value, rate, change) = match turns {
        true => (Quantity::Angle, Quantity::AngularVelocity, Quantity::AngularAcceleration),
        false => (Quantity::Length, Quantity::Velocity, Quantity::Acceleration),
    };
    if let Some(limits) = &row.limits {
        let _ = writeln!(out, "limits = {}", list(limits, value));
    }
    for (key, e, quantity) in [("velocity", row.velocity, rate), ("acceleration", row.acceleration, change)] {
        if let Some(e) = e {
            let _ = writeln!(out, "{key} = {}", cell(e, quantity));
        }
    }
}

pub(super) fn write_frame(out: &mut String, frame: &Transform<Expr>) {
    let zero = [Expr::int(0); 3];
    if let Some(rpy) = exact_rpy(&frame.rotation) {
        if frame.translation.0 != zero {
            let _ = writeln!(out, "xyz = {}", list(&frame.translation.0, Quantity::Length));
        }
        if rpy != zero {
            let _ = writeln!(out, "rpy = {}", list(&rpy, Quantity::Angle));
        }
        return;
    }
    out.push_str("matrix = [\n");
    for (row, &p) in frame.rotation.rows().iter().zip(&frame.translation.0) {
        let entries: Vec<String> = row.iter().map(|&e| cell(e, Quantity::Number)).collect();
        let _ = writeln!(out, "  [{}, {}],", entries.join(", "), cell(p, Quantity::Length));
    }
    out.push_str("  [0, 0, 0, 1],\n]\n");
}

/// Roll, pitch and yaw that give this rotation, entry by entry, if they are multiples of π/180 or a turn about
/// one axis by an angle that occurs in it.
pub(in crate::description) fn exact_rpy(r: &Rotation<Expr>) -> Option<[Expr; 3]> {
    let o = Expr::int(0);
    let angles: Vec<Expr> = Expr::postorder(r.rows().as_flattened())
        .into_iter()
        .filter_map(|e| if let Node::Sin(a) | Node::Cos(a) = e.node() { Some(a) } else { None })
        .collect();
    for angle in angles.into_iter().flat_map(|a| [a, -a, a + Expr::pi(), -a + Expr::pi()]) {
        for axis in Axis::ALL {
            if Rotation::about(axis, angle) == *r {
                let mut rpy = [o; 3];
                rpy[axis.index()] = angle;
                return Some(rpy);
            }
        }
    }
    let m = r.rows();
    let number = |i: usize, j: usize| m[i][j].eval(|_| None).ok();
    let (m00, m10, m20) = (number(0, 0)?, number(1, 0)?, number(2, 0)?);
    let pitch = (-m20).atan2(m00.hypot(m10));
    let (roll, yaw) = match m00.hypot(m10) > 1e-9 {
        true => (number(2, 1)?.atan2(number(2, 2)?), m10.atan2(m00)),
        false => (0.0, (-number(0, 1)?).atan2(number(1, 1)?)), // pitch ±90°: only roll ∓ yaw is determined
    };
    // decimals of a degree that the rotation was perhaps given in
    for scale in [1.0, 1000.0, 1e6] {
        let rpy = [roll, pitch, yaw].map(|x| {
            let steps = (x / PI * 180.0 * scale).round();
            Expr::from(Rational::new(steps as i64, 180 * scale as i64)) * Expr::pi()
        });
        let again = Rotation::from_rpy(rpy[0], rpy[1], rpy[2]);
        let same = |i: usize, j: usize| again[(i, j)] == m[i][j] || equal(again[(i, j)], m[i][j]).is_equal();
        if (0..9).all(|k| same(k / 3, k % 3)) {
            return Some(rpy);
        }
    }
    None
}

pub(super) fn cell(e: Expr, quantity: Quantity) -> String {
    if e.is_zero() { "0".into() } else { quoted(&write_cell(e, quantity)) }
}

pub(super) fn list(values: &[Expr], quantity: Quantity) -> String {
    format!("[{}]", values.iter().map(|&e| cell(e, quantity)).collect::<Vec<_>>().join(", "))
}

/// A parameter that stands in an angle is an angle.
fn quantity_of_parameter(d: &Description, symbol: Expr) -> Quantity {
    let occurs = |e: &Expr| e.symbols().iter().any(|&s| Expr::from(s) == symbol);
    let summand = |e: Expr| denavit_symbolic::Angle::of(e).terms.iter().any(|t| t.0 == symbol);
    if d.rows.iter().flat_map(|r| [r.theta, r.alpha, r.gamma]).any(summand) {
        return Quantity::Angle;
    }
    let lengths =
        d.rows.iter().flat_map(|r| [r.d, r.a, r.b]).chain(d.base.translation.0).chain(d.tool.translation.0);
    if lengths.collect::<Vec<_>>().into_iter().any(summand) {
        return Quantity::Length;
    }
    let turned = [&d.base, &d.tool].iter().any(|f| f.rotation.rows().as_flattened().iter().any(occurs));
    if turned { Quantity::Angle } else { Quantity::Open }
}

fn key(name: &str) -> String {
    let bare = !name.is_empty() && name.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_' || b == b'-');
    if bare { name.to_string() } else { quoted(name) }
}

pub(super) fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            '\n' => out.push_str("\\n"),
            '\t' => out.push_str("\\t"),
            c if c.is_control() => {
                let _ = write!(out, "\\u{:04X}", u32::from(c));
            }
            c => out.push(c),
        }
    }
    out.push('"');
    out
}
