//! Joints, velocities and manipulability over time, as SVG.

use super::samples::{Sample, Sampled};
use crate::terminal::words;
use denavit::description::{Description, JointKind};
use denavit::motion::follow::EventKind;
use denavit::motion::plan::Planned;
use plotters::prelude::*;

/// The drawing is made this much larger than it is shown, because coordinates are whole numbers.
const FINE: i32 = 8;
/// As it is shown.
const SIZE: (u32, u32) = (960, 900);
/// Okabe and Ito's colours, which everybody can tell apart, and two more.
const COLOURS: [RGBColor; 8] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(0, 0, 0),
    RGBColor(120, 120, 120),
];

/// A drawing of three panels.
///
/// # Errors
/// If it cannot be drawn.
pub fn svg(d: &Description, planned: &Planned, sampled: &Sampled) -> Result<String, String> {
    let mut text = String::new();
    draw(d, planned, sampled, &mut text).map_err(|e| format!("the plot: {e}"))?;
    let (width, height) = SIZE;
    let fine = FINE.unsigned_abs();
    let large = format!("width=\"{}\" height=\"{}\"", width * fine, height * fine);
    Ok(text.replacen(&large, &format!("width=\"{width}\" height=\"{height}\""), 1))
}

/// A line over time.
struct Curve {
    name: String,
    points: Vec<(f64, f64)>,
}

fn draw(
    d: &Description,
    planned: &Planned,
    sampled: &Sampled,
    text: &mut String,
) -> Result<(), Box<dyn std::error::Error>> {
    let variables = d.variables();
    let of =
        |value: &dyn Fn(&Sample) -> f64| sampled.samples.iter().map(|s| (s.t, value(s))).collect::<Vec<_>>();
    let unit = |j: usize| match variables[j].kind {
        JointKind::Revolute => 180.0 / std::f64::consts::PI,
        JointKind::Prismatic => 100.0,
    };
    let named = |j: usize| match variables[j].kind {
        JointKind::Revolute => variables[j].symbol.name().to_string(),
        JointKind::Prismatic => format!("{} (cm)", variables[j].symbol.name()),
    };
    let joints: Vec<Curve> = (0..variables.len())
        .map(|j| Curve { name: named(j), points: of(&|s| s.state.q[j] * unit(j)) })
        .collect();
    let rates: Vec<Curve> = (0..variables.len())
        .map(|j| Curve { name: named(j), points: of(&|s| s.state.qd[j] * unit(j)) })
        .collect();
    let one = [Curve { name: "manipulability".into(), points: of(&|s| s.manipulability) }];
    let marks = singular_times(planned, sampled);

    let root = SVGBackend::with_string(text, (SIZE.0 * FINE.unsigned_abs(), SIZE.1 * FINE.unsigned_abs()))
        .into_drawing_area();
    root.fill(&WHITE)?;
    let root =
        root.titled(&format!("{}: {}", d.name, words().course(&planned.course)), ("sans-serif", 22 * FINE))?;
    let panels = root.split_evenly((3, 1));
    for (panel, (title, curves)) in panels.iter().zip([
        ("joints / ° (slides / cm)", &joints[..]),
        ("joint velocities / ° per second (slides / cm per second)", &rates),
        ("manipulability (lengths by the arm's size)", &one),
    ]) {
        let end = sampled.samples.last().map_or(1.0, |s| s.t.max(1e-9));
        let values = || curves.iter().flat_map(|c| c.points.iter().map(|p| p.1)).filter(|v| v.is_finite());
        let (low, high) = (values().fold(0.0, f64::min), values().fold(0.0, f64::max));
        let margin = 0.05 * (high - low).max(1e-6);
        let mut chart = ChartBuilder::on(panel)
            .caption(title, ("sans-serif", 15 * FINE))
            .margin(8 * FINE)
            .x_label_area_size(40 * FINE)
            .y_label_area_size(64 * FINE)
            // Room for the names on the right.
            .build_cartesian_2d(0.0..1.12 * end, low - margin..high + margin)?;
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(BLACK.mix(0.15).stroke_width(FINE.unsigned_abs()))
            .axis_style(BLACK.stroke_width(FINE.unsigned_abs()))
            .label_style(("sans-serif", 12 * FINE))
            .axis_desc_style(("sans-serif", 12 * FINE))
            .x_desc("t / s")
            .draw()?;
        for &t in &marks {
            let line = [(t, low - margin), (t, high + margin)];
            chart.draw_series(std::iter::once(PathElement::new(
                line,
                RED.mix(0.5).stroke_width(FINE.unsigned_abs()),
            )))?;
        }
        for (k, curve) in curves.iter().enumerate() {
            let colour = COLOURS[k % COLOURS.len()];
            chart
                .draw_series(LineSeries::new(
                    curve.points.iter().copied(),
                    colour.stroke_width(2 * FINE.unsigned_abs()),
                ))?
                .label(curve.name.as_str())
                .legend(move |(x, y)| {
                    PathElement::new(
                        [(x, y), (x + 16 * FINE, y)],
                        colour.stroke_width(2 * FINE.unsigned_abs()),
                    )
                });
        }
        if curves.len() > 1 {
            chart
                .configure_series_labels()
                .position(SeriesLabelPosition::UpperRight)
                .label_font(("sans-serif", 12 * FINE))
                .legend_area_size(24 * FINE)
                .margin(6 * FINE)
                .background_style(WHITE.mix(0.85))
                .border_style(BLACK.mix(0.3))
                .draw()?;
        }
    }
    root.present()?;
    Ok(())
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
