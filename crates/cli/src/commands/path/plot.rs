//! Joints, velocities and manipulability over time, as SVG.

use crate::terminal::words;
use denavit::description::{Description, JointKind};
use denavit::motion::follow::EventKind;
use denavit::motion::plan::{Planned, Sample, Sampled};
use denavit_report::figure::drawing::Label;
use denavit_report::figure::plot::{Curve, Panel, curves};
use denavit_report::figure::svg::{Palette, svg};
use denavit_report::figure::symbol;

/// From this line on colours come again, dashed.
const COLOURS: usize = 8;

/// A drawing of three panels, with a mark at every singular configuration.
pub fn picture(d: &Description, planned: &Planned, sampled: &Sampled) -> String {
    let variables = d.variables();
    let of = |value: &dyn Fn(&Sample) -> f64| sampled.samples.iter().map(|s| [s.t, value(s)]).collect();
    let slides = variables.iter().any(|v| v.kind == JointKind::Prismatic);
    let of_joints = |value: fn(&Sample) -> &[f64]| -> Vec<Curve> {
        let curve = |(j, v): (usize, &denavit::description::Variable)| {
            let (unit, behind) = match v.kind {
                JointKind::Revolute => (180.0 / std::f64::consts::PI, Label::default()),
                JointKind::Prismatic => (100.0, Label::words(" (cm)")),
            };
            let name = symbol(&v.symbol.name()).and(behind);
            Curve { name, points: of(&|s| value(s)[j] * unit), is_dashed: j >= COLOURS }
        };
        variables.iter().enumerate().map(curve).collect()
    };
    let label = |turns: &str, slide: &str| {
        Label::words(if slides { format!("{turns} ({slide})") } else { turns.into() })
    };
    let panels = [
        Panel { label: label("joints / °", "slides / cm"), curves: of_joints(|s| &s.state.q) },
        Panel {
            label: label("joint velocities / ° per second", "slides / cm per second"),
            curves: of_joints(|s| &s.state.qd),
        },
        Panel {
            label: Label::words("manipulability (lengths by the arm's size)"),
            curves: vec![Curve {
                name: Label::words("manipulability"),
                points: of(&|s| s.manipulability),
                is_dashed: false,
            }],
        },
    ];
    let title = format!("{}: {}", d.name, words().course(&planned.course));
    let across = Label::symbol("t", "").and(Label::words(" / s"));
    svg(&curves(&title, &across, &panels, &singular_times(planned, sampled)), Palette::File, "path")
}

/// When a singular configuration is passed: the sample nearest to it.
fn singular_times(planned: &Planned, sampled: &Sampled) -> Vec<f64> {
    let events = planned.followed.iter().flat_map(|f| &f.events);
    let singular = events.filter(|e| matches!(e.kind, EventKind::Singular { .. } | EventKind::End { .. }));
    singular
        .filter_map(|e| {
            let away = |s: &&Sample| s.state.q.iter().zip(&e.q).map(|(a, b)| (a - b).powi(2)).sum::<f64>();
            sampled.samples.iter().min_by(|a, b| away(a).total_cmp(&away(b))).map(|s| s.t)
        })
        .collect()
}
