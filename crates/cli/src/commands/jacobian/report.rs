//! The answer for reading.

use super::answer::{Answer, Held};
use crate::commands::fk::joint_names;
use crate::terminal::{Align, FAINT, HEADING, NAME, decimals, number, styled, table};
use denavit::description::JointKind;
use denavit::quantity::{rate, reading, torque_unit};
use denavit::velocity::{Jacobian, ROWS};

/// Everything that was asked.
pub fn text(a: &Answer) -> String {
    let variables = a.description.variables();
    let at: Vec<String> = variables
        .iter()
        .zip(&a.q)
        .map(|(v, &x)| format!("{} = {}", v.symbol.name(), reading(x, v.kind)))
        .collect();
    let mut text = format!("{} at {}\n\n", styled(&a.description.name, HEADING), at.join(", "));
    text += &joint_names(a.description);
    text += &format!("Jacobian of {}\n", seen(a));
    text += &matrix(a, &a.jacobian);
    text += &quality(a);
    if let Some((o, analytic)) = &a.analytic {
        text += &format!("\nAnalytic Jacobian: position and {}\n", o.set);
        let rows = analytic.names.iter().zip(&analytic.rows);
        let rows: Vec<(String, &[f64])> = rows.map(|(n, r)| (n.clone(), &r[..])).collect();
        text += &numbers(a, &rows);
        if o.singular {
            text += "  the set is singular at this orientation: its rates grow beyond all bounds\n";
        }
    }
    if let Some((twist, rate, drift)) = &a.motion {
        text += &format!("\nTwist  {}\n", components(twist, ["m/s", "rad/s"]));
        text += "\nRate of the Jacobian\n";
        text += &matrix(a, rate);
        text += &format!(
            "  acceleration without joint accelerations (J̇q̇): {}\n",
            components(drift, ["m/s²", "rad/s²"])
        );
    }
    text += &joint_rates(a);
    if let Some(Held { torques, largest }) = &a.held {
        let values: Vec<String> = variables
            .iter()
            .zip(torques)
            .map(|(v, &t)| {
                let unit = torque_unit(v.kind);
                format!("{} {} {unit}", v.symbol.name(), decimals(t, 4))
            })
            .collect();
        text += &format!("\nTorques that hold the wrench  {}\n", values.join(", "));
        text += &match (largest, &a.questions.torques) {
            (Some((factor, j)), _) => format!(
                "  the wrench can be {} times as large; then {} is at its limit\n",
                decimals(*factor, 4),
                variables[*j].symbol.name()
            ),
            (None, Some(_)) => "  the structure holds the wrench: no joint limits it\n".into(),
            (None, None) => String::new(),
        };
    }
    for (j, derivative) in a.hessian.iter().flatten().enumerate() {
        text += &format!("\nDerivative by {}\n", variables[j].symbol.name());
        text += &matrix(a, derivative);
    }
    text
}

fn seen(a: &Answer) -> String {
    let frame = |f| match denavit_wire::jacobian::frame(f) {
        n if n.parse::<usize>().is_ok() => format!("frame {n}"),
        n => format!("the {n}"),
    };
    let (body, axes) = (frame(a.view.body), frame(a.view.axes));
    let point = match a.view.at == a.view.body {
        true => String::new(),
        false => format!(", at the origin of {}", frame(a.view.at)),
    };
    let offset = match a.view.offset.0.iter().any(|e| !e.is_zero()) {
        true => {
            let parts: Vec<String> =
                a.view.offset.0.iter().map(|e| decimals(e.eval(|_| None).unwrap_or(f64::NAN), 6)).collect();
            format!(", at ({}) m from its origin", parts.join(", "))
        }
        false => String::new(),
    };
    format!("{body}{point}{offset}, along the axes of {axes}")
}

fn matrix(a: &Answer, j: &Jacobian<f64>) -> String {
    let rows = j.rows();
    let rows: Vec<(String, &[f64])> = ROWS.iter().zip(&rows).map(|(n, r)| (n.to_string(), &r[..])).collect();
    numbers(a, &rows)
}

fn numbers(a: &Answer, rows: &[(String, &[f64])]) -> String {
    let variables = a.description.variables();
    let names: Vec<String> = variables.iter().map(|v| v.symbol.name().to_string()).collect();
    let header: Vec<&str> = [""].into_iter().chain(names.iter().map(String::as_str)).collect();
    let align: Vec<Align> = header.iter().map(|_| Align::Right).collect();
    let size =
        rows.iter().flat_map(|r| r.1).fold(1.0_f64, |m, x| if x.is_finite() { m.max(x.abs()) } else { m });
    let row = |(n, values): &(String, &[f64])| {
        [n.clone()].into_iter().chain(values.iter().map(|&x| number(x, 1e-14 * size))).collect()
    };
    table(&header, &align, &rows.iter().map(row).collect::<Vec<Vec<String>>>())
}

/// Singular values, what is lost and free, how far the next singularity is.
fn quality(a: &Answer) -> String {
    let (m, whole) = (&a.measures, &a.measures.whole);
    let list = |values: &[f64]| values.iter().map(|&v| number(v, 1e-12)).collect::<Vec<_>>().join(", ");
    let condition = |c: f64| if c.is_finite() { decimals(c, 3) } else { "∞".into() };
    let mut text = String::from("\n");
    for (what, block, unit) in [("translation", &m.linear, " m"), ("rotation", &m.angular, "")] {
        text += &format!(
            "  {what:<12} singular values {}{unit}; condition {}, manipulability {}\n",
            list(&block.singular_values),
            condition(block.condition),
            number(block.manipulability, 1e-12),
        );
    }
    text += &format!(
        "  {:<12} singular values {}; condition {}, manipulability {}  {}\n",
        "both",
        list(&whole.singular_values),
        condition(whole.condition),
        number(whole.manipulability, 1e-15),
        styled(&format!("(lengths by {} m)", decimals(m.length, 4)), FAINT),
    );
    let full = a.q.len().min(6);
    if whole.rank < full {
        text += &format!("  {}: rank {} of {full}\n", styled("singular", NAME), whole.rank);
        if a.q.len() >= 6 {
            for lost in &whole.lost {
                text += &format!("    lost: {}\n", direction(lost, m.length));
            }
        }
    }
    for free in &whole.free {
        text += &format!("    free: {}\n", motion(a, free));
    }
    if let Some(nearest) = a.nearest.as_ref().filter(|n| n.distance > 1e-9) {
        let at = a.description.variables();
        let at: Vec<String> = at.iter().zip(&nearest.q).map(|(v, &x)| reading(x, v.kind)).collect();
        text += &format!(
            "  a singular configuration is {} away: {}\n",
            reading(nearest.distance, JointKind::Revolute),
            at.join(", ")
        );
    }
    text
}

/// A twist that cannot be had, in words: its largest component is 1.
fn direction(lost: &[f64; 6], length: f64) -> String {
    // No twist that the arm can have does work against it: (v/L, ω)·lost = 0.
    let largest = lost.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let mut text = String::new();
    for (k, name) in ROWS.iter().enumerate().filter(|(k, _)| lost[*k].abs() > 1e-9) {
        let by = if k < 3 { length } else { 1.0 };
        let factor = lost[k] / largest / by;
        text += match (text.is_empty(), factor < 0.0) {
            (true, false) => "",
            (true, true) => "−",
            (false, false) => " + ",
            (false, true) => " − ",
        };
        let size = number(factor.abs(), 1e-12);
        text += &if size == "1" { name.to_string() } else { format!("{size}·{name}") };
    }
    format!("{text} = 0 whatever the joints do")
}

/// A motion of the joints, the largest 1.
fn motion(a: &Answer, free: &[f64]) -> String {
    let largest = free.iter().fold(0.0_f64, |m, x| if x.abs() > m.abs() { *x } else { m });
    let parts: Vec<String> = a
        .description
        .variables()
        .iter()
        .zip(free)
        .filter(|(_, x)| x.abs() > 1e-9)
        .map(|(v, x)| format!("{} {}", v.symbol.name(), number(x / largest, 1e-12)))
        .collect();
    format!("{} leaves the body at rest", parts.join(", "))
}

fn components(twist: &[f64; 6], units: [&str; 2]) -> String {
    let part = |k: usize| {
        let values: Vec<String> = (0..3).map(|i| number(twist[3 * k + i], 1e-14)).collect();
        format!("({}) {}", values.join(", "), units[k])
    };
    format!("{}, {}", part(0), part(1))
}

fn joint_rates(a: &Answer) -> String {
    let (Some(solved), Some((_, rows))) = (&a.solved, &a.questions.twist) else { return String::new() };
    let variables = a.description.variables();
    let values: Vec<String> = variables
        .iter()
        .zip(&solved.rates)
        .map(|(v, &x)| format!("{} {}", v.symbol.name(), rate(x, v.kind)))
        .collect();
    let mut text = format!("\nJoint velocities  {}\n", values.join(", "));
    let achieved = components(&solved.achieved, ["m/s", "rad/s"]);
    let any = if rows.iter().all(|&r| r) { "" } else { " (some components were left open)" };
    text += &format!("  give the twist {achieved}{any}\n");
    let Some((wanted, _)) = &a.questions.twist else { return text };
    let size = wanted.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let off = (0..6)
        .filter(|&k| rows[k])
        .any(|k| (solved.achieved[k] / solved.scale - wanted[k]).abs() > 1e-9 * size);
    if off && solved.damped.is_empty() && solved.scale > 0.0 {
        text += "  the rest of the twist cannot be had with these joints here\n";
    }
    if !solved.damped.is_empty() {
        let d = a.questions.damping;
        let values: Vec<String> = solved.damped.iter().map(|&v| number(v, 1e-12)).collect();
        text += &format!(
            "  damped: singular values {} lie below {} (damping up to {})\n",
            values.join(", "),
            d.threshold,
            d.largest
        );
    }
    if let Some(j) = solved.slowest {
        text += &format!(
            "  scaled by {} so that {} keeps its limit\n",
            decimals(solved.scale, 4),
            variables[j].symbol.name()
        );
    }
    text
}
