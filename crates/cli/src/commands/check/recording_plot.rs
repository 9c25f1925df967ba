//! How far the hand is off over time, as the columns stand and with all of it undone, as SVG.

use denavit_recording::{Arm, Held, Off, Recipe, Recording, Roles, deviations, seconds};
use denavit_report::figure::drawing::Label;
use denavit_report::figure::plot::{Curve, Panel, curves};
use denavit_report::figure::svg::{Palette, svg};

/// A line has at most so many points: of rows that fall on one the farthest is shown.
const POINTS: usize = 1_500;

/// A drawing of the distances and angles; with findings those of the columns as they stand come first.
pub fn picture(title: &str, recording: &Recording, roles: &Roles, held: &Held, arm: &Arm) -> String {
    let (times, across) = match seconds(recording, roles) {
        Some(times) => (times, Label::symbol("t", "").and(Label::words(" / s"))),
        None => ((0..held.rows[0]).map(|r| r as f64).collect(), Label::words("row")),
    };
    let panels_of = |recipe: &Recipe, how: &str| {
        let off = deviations(recording, roles, recipe, arm);
        let panel = |what: &str, value: fn(&Off) -> f64| {
            let values: Vec<f64> = off.iter().map(|o| o.as_ref().map_or(f64::NAN, value)).collect();
            let name = Label::words(what);
            let curve = Curve { name, points: farthest(&times, &values), is_dashed: false };
            Panel { label: Label::words(format!("{what}{how}")), curves: vec![curve] }
        };
        [panel("position off / mm", |o| 1e3 * o.shift), panel("orientation off / °", |o| o.turn.to_degrees())]
    };
    let panels: Vec<Panel> = match held.findings.is_empty() {
        true => panels_of(&held.recipe, "").into(),
        false => {
            let as_they_stand = held.as_columns_stand(recording, roles, arm);
            let before = panels_of(&as_they_stand, ", as the columns stand");
            before.into_iter().chain(panels_of(&held.recipe, ", with all of it undone")).collect()
        }
    };
    svg(&curves(title, &across, &panels, &[]), Palette::File, "deviations")
}

/// The points of a line: the farthest value of as many rows as share a point, none where there is none.
fn farthest(times: &[f64], values: &[f64]) -> Vec<[f64; 2]> {
    let share = values.len().div_ceil(POINTS).max(1);
    let one = |(t, x): (&[f64], &[f64])| {
        let known = (0..x.len()).filter(|&k| x[k].is_finite());
        known.max_by(|&a, &b| x[a].total_cmp(&x[b])).map_or([f64::NAN; 2], |k| [t[k], x[k]])
    };
    times.chunks(share).zip(values.chunks(share)).map(one).collect()
}
