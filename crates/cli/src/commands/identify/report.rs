//! What was identified, for reading.

use super::Subject;
use crate::terminal::{Align, FAINT, HEADING, styled, table};
use denavit_identification::{Consistent, Estimate, Identified, Known, Prior, Roles, scale, words};
use denavit_wire::identification as wire;

/// What is shown.
pub struct Shown<'a> {
    /// The arm.
    pub subject: &'a Subject,
    /// The files.
    pub recordings: &'a [String],
    /// Which columns are what.
    pub roles: &'a Roles,
    /// Their names.
    pub columns: &'a wire::Roles,
}

/// All of it.
pub fn text(shown: &Shown, found: &Identified, set: Option<(&Consistent, &Prior)>) -> String {
    let Subject { name, model, names, .. } = shown.subject;
    let estimate = &found.estimate;
    let short = words::short;
    let mut text = format!(
        "{} from {}: {} rows, {} s of motion\n",
        styled(name, HEADING),
        shown.recordings.join(", "),
        found.rows,
        short(found.seconds)
    );
    text += &format!("  {}\n", columns(shown));
    match found.cutoffs {
        Some((positions, torques)) => {
            text += &format!(
                "  positions filtered below {} Hz, torques and their regressor alike below {} Hz\n",
                short(positions),
                short(torques)
            );
        }
        None => text += "  no filter\n",
    }
    for r in &found.remarks {
        text += &format!("  {}\n", words::remark(names, r));
    }
    for s in &found.suspects {
        text += &format!("  {}: {}\n", styled("suspect", HEADING), words::suspect(model, names, s));
    }
    text += &format!("\n{}  {}\n", styled("Torques", HEADING), styled("(root mean squares)", FAINT));
    let left = set.map(|(set, _)| found.left(&set.values));
    let rows: Vec<Vec<String>> = estimate
        .joints
        .iter()
        .enumerate()
        .map(|(j, of)| {
            let dash = || "—".to_string();
            let share = if of.torque > 0.0 { words::percent(of.left / of.torque) } else { dash() };
            let masses = left.as_ref().map_or_else(dash, |l| short(l[j]));
            let number = |x: f64| if of.rows == 0 { dash() } else { short(x) };
            vec![
                names[j].clone(),
                number(of.torque),
                number(of.left),
                if of.rows == 0 { dash() } else { share },
                of.held_out.map_or_else(dash, short),
                if of.rows == 0 { dash() } else { masses },
                words::unit_of_torque(model, j).to_string(),
            ]
        })
        .collect();
    let right = Align::Right;
    text += &table(
        &["", "torque", "left", "share", "held out", "with masses", ""],
        &[Align::Left, right, right, right, right, right, Align::Left],
        &rows,
    );
    text += &format!("\n{}\n", styled("Parameters", HEADING));
    let rows: Vec<Vec<String>> = model
        .parameters
        .iter()
        .zip(&estimate.known)
        .map(|(p, known)| {
            let (value, deviation, part) = match *known {
                Known::Value(x, s) => (short(x), short(s), words::percent(s / x.abs())),
                Known::Unseen(_) => ("not told".into(), "—".into(), "—".into()),
                Known::LeftOut(x, s) => {
                    ("0, left out".into(), format!("{} ± {}", short(x), short(s)), "—".into())
                }
            };
            let part = if part.len() > 7 { "—".to_string() } else { part };
            vec![
                p.name.clone(),
                value,
                deviation,
                part,
                p.unit.into(),
                p.grouping.clone().unwrap_or_default(),
            ]
        })
        .collect();
    text += &table(
        &["", "value", "deviation", "%", "", "stands for"],
        &[Align::Left, right, right, right, Align::Left, Align::Left],
        &rows,
    );
    let condition = if estimate.condition.is_finite() {
        format!("condition number of the regressor, its columns of one size: {}", short(estimate.condition))
    } else {
        "the regressor has columns that this motion leaves dependent".into()
    };
    text += &format!("  {condition}\n");
    if estimate.outliers > 0 {
        text += &format!("  {} rows are far off, and count less than half\n", estimate.outliers);
    }
    for line in words::lines(model, names, found) {
        text += &format!("  {line}\n");
    }
    if let Some((_, Prior::Given(bodies))) = set
        && let Some(by) = scale(model, estimate, bodies)
    {
        text += &format!(
            "  as far as one number says it, the parameters are {} times those of the file\n",
            short(by)
        );
    }
    text + &set.map_or(String::new(), |(set, prior)| masses(shown.subject, estimate, set, prior))
}

/// The columns by their names.
fn columns(shown: &Shown) -> String {
    let range = |names: &[String]| match names {
        [] => String::new(),
        [one] => one.clone(),
        [first, .., last] => format!("{first} … {last}"),
    };
    let c = shown.columns;
    let mut parts = vec![format!("joints {}", range(&c.joints))];
    let optional = [("velocities", &c.velocities), ("accelerations", &c.accelerations)];
    parts.extend(
        optional.iter().filter(|o| !o.1.is_empty()).map(|(what, names)| format!("{what} {}", range(names))),
    );
    parts.push(format!("torques {}", range(&c.torques)));
    parts.extend(c.time.as_ref().map(|t| format!("time {t}")));
    if shown.roles.velocities.is_empty() {
        parts.push("velocities from the positions".into());
    }
    parts.join("; ")
}

/// Masses that can be.
fn masses(subject: &Subject, estimate: &Estimate, set: &Consistent, prior: &Prior) -> String {
    let short = words::short;
    let near = match prior {
        Prior::Given(_) => "nearest to those of the file where torques do not tell",
        Prior::Neutral => "nearest to even links where torques do not tell",
    };
    let mut text =
        format!("\n{}  {}\n", styled("Masses that can be", HEADING), styled(&format!("({near})"), FAINT));
    let rows: Vec<Vec<String>> = set
        .bodies
        .iter()
        .enumerate()
        .map(|(k, b)| {
            let (centre, inertia) = b.at_centre().map_or(([0.0; 3], [0.0; 6]), |(c, i)| (c.0, i));
            let list = |x: &[f64]| x.iter().map(|x| short(*x)).collect::<Vec<_>>().join(", ");
            vec![
                format!("link {}", k + 1),
                short(b.mass),
                list(&centre),
                list(&[inertia[0], inertia[3], inertia[5]]),
            ]
        })
        .collect();
    let left = Align::Left;
    text += &table(
        &["", "kg", "centre, m", "xx, yy, zz about it, kg m²"],
        &[left, Align::Right, left, left],
        &rows,
    );
    let size = subject.model.parameters.len();
    // Where noise is less than what counts, deviations are other than those of the table.
    let counted = |k: usize| match estimate.worth.at(k, k) > 1.02 * estimate.covariance.at(k, k) {
        true => ", with noise of 0.01 % of the torques",
        false => "",
    };
    text += &match set.farthest {
        Some((k, off)) if off > 3.0 => format!(
            "  the masses that were found do not have just these parameters: {} is {} deviations off{}, the weighted squares grow by {} of {size} parameters\n",
            subject.model.parameters[k].name,
            short(off),
            counted(k),
            short(set.excess)
        ),
        Some((k, off)) => format!(
            "  they have all parameters that are told within {} deviations ({}{})\n",
            short(off),
            subject.model.parameters[k].name,
            counted(k)
        ),
        None => String::new(),
    };
    text + "  single masses are not measured: these are some of many with these torques\n"
}
