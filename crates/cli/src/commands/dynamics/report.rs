//! The answer for reading.

use crate::terminal::{Align, FAINT, HEADING, matrix, number, styled, table};
use denavit::description::JointKind;
use denavit::quantity::{rate, reading, torque_unit};
use denavit_wire::dynamics::{Answer, Slopes};

/// The state, the torques with their parts, the inertia matrix, the energies.
pub fn text(robot: &str, joints: &[(String, JointKind)], a: &Answer) -> String {
    let each = |values: &[f64], of: &dyn Fn(f64, JointKind) -> String| -> String {
        let all = joints.iter().zip(values);
        all.map(|((name, kind), &x)| format!("{name} = {}", of(x, *kind))).collect::<Vec<_>>().join(", ")
    };
    let mut text = format!("{} at {}\n", styled(robot, HEADING), each(&a.q, &reading));
    if a.qd.iter().any(|&v| v != 0.0) {
        text += &format!("  velocities {}\n", each(&a.qd, &rate));
    }
    let accelerated = |x: f64, kind| {
        format!("{} {}", number(x, 0.0), if kind == JointKind::Revolute { "rad/s²" } else { "m/s²" })
    };
    if let Some(qdd) = &a.qdd {
        text += &format!("  accelerations {}\n", each(qdd, &accelerated));
    }
    let pulled = a.accelerations.as_ref().or(a.qdd.as_ref());
    let mut columns: Vec<(&str, Vec<f64>)> = vec![("torque", a.torques.clone())];
    if let Some(qdd) = pulled {
        let times = |row: &Vec<f64>| row.iter().zip(qdd).map(|(m, x)| m * x).sum();
        columns.push(("A q̈", a.inertia.iter().map(times).collect()));
    }
    columns.push(("C q̇", a.velocity.clone()));
    columns.push(("gravity", a.gravity.clone()));
    if a.friction.iter().any(|&x| x != 0.0) {
        columns.push(("friction", a.friction.clone()));
    }
    columns.extend(a.wrench.clone().map(|w| ("wrench", w)));
    let size = columns.iter().flat_map(|c| &c.1).fold(1.0_f64, |m, x| m.max(x.abs()));
    let header: Vec<&str> = [""].into_iter().chain(columns.iter().map(|c| c.0)).chain([""]).collect();
    let mut align = vec![Align::Right; header.len()];
    (align[0], align[header.len() - 1]) = (Align::Left, Align::Left);
    let row = |j: usize| -> Vec<String> {
        let (name, kind) = joints[j].clone();
        let unit = torque_unit(kind);
        let cells = columns.iter().map(|c| number(c.1[j], 1e-14 * size));
        [name].into_iter().chain(cells).chain([unit.to_string()]).collect()
    };
    text += &format!("\n{}\n", styled("Torques", HEADING));
    text += &table(&header, &align, &(0..joints.len()).map(row).collect::<Vec<_>>());
    if let Some(found) = &a.accelerations {
        text += &format!("\n{}\n  {}\n", styled("Accelerations", HEADING), each(found, &accelerated));
    }
    let largest = a.inertia.iter().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
    let entries: Vec<Vec<String>> =
        a.inertia.iter().map(|row| row.iter().map(|&x| number(x, 1e-14 * largest)).collect()).collect();
    let slides = joints.iter().any(|j| j.1 == JointKind::Prismatic);
    let units = if slides { "kg m²; kg m beside a slide, kg between slides" } else { "kg m²" };
    text += &format!("\n{}  {}\n", styled("Inertia matrix", HEADING), styled(&format!("({units})"), FAINT));
    text += &matrix("", &entries, Align::Right);
    text += &a.derivatives.as_ref().map_or(String::new(), slopes);
    text += &format!(
        "\n  kinetic energy {} J, potential energy {} J\n",
        number(a.energy.kinetic, 1e-14),
        number(a.energy.potential, 1e-14)
    );
    let three = |v: &[f64; 3], unit: &str| {
        let noise = 1e-14 * v.iter().fold(1.0_f64, |m, x| m.max(x.abs()));
        format!("({}) {unit}", v.map(|x| number(x, noise)).join(", "))
    };
    text += &format!(
        "  {} kg that move, their centre at {}\n",
        number(a.momentum.mass, 0.0),
        three(&a.momentum.centre, "m")
    );
    if a.qd.iter().any(|&v| v != 0.0) {
        text += &format!("  momentum {}", three(&a.momentum.linear, "kg m/s"));
        text += &format!(", about the centre of mass {}\n", three(&a.momentum.angular, "kg m²/s"));
        let p = &a.power;
        let all = [
            ("the torques supply", p.supplied),
            ("friction takes", p.dissipated),
            ("the tool gives", p.exerted),
            ("the potential energy grows by", p.potential),
            ("the kinetic energy by", p.kinetic),
        ];
        let size = all.iter().fold(0.0_f64, |m, x| m.max(x.1.abs()));
        let shown = all.iter().filter(|x| x.1 != 0.0 || !matches!(x.0, "friction takes" | "the tool gives"));
        let each = shown.map(|(what, x)| format!("{what} {} W", number(*x, 1e-14 * size)));
        text += &format!("  power: {}\n", each.collect::<Vec<_>>().join(", "));
    }
    text
}

/// The matrices of first derivatives, one below the other: a row a joint, in radians, metres, seconds, newtons.
fn slopes(all: &Slopes) -> String {
    let (of, third) = match (&all.by_qdd, &all.by_tau) {
        (_, Some(third)) => ("q̈", ("τ", third)),
        (Some(third), None) => ("τ", ("q̈", third)),
        (None, None) => return String::new(),
    };
    let mut text = String::new();
    for (by, rows) in [("q", &all.by_q), ("q̇", &all.by_qd), third] {
        let largest = rows.iter().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
        let entries: Vec<Vec<String>> =
            rows.iter().map(|row| row.iter().map(|&x| number(x, 1e-14 * largest)).collect()).collect();
        text += &format!("\n{}\n", styled(&format!("∂{of}/∂{by}"), HEADING));
        text += &matrix("", &entries, Align::Right);
    }
    text
}
