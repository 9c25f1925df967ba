//! The sheet of one document: points item by item.

use super::Document;
use crate::terminal::words;
use crate::terminal::{Align, decimals, table};
use denavit_check::Standing;
use denavit_check::marking::{Mark, Rubric, Sheet};

/// What is printed for the teacher.
pub fn report(document: &Document, rubric: &Rubric) -> String {
    let sheet = rubric.mark(document.text, document.checked);
    let title = rubric.title.as_deref().unwrap_or(document.name);
    format!("{title}\n{}", points(rubric, &sheet, |at| document.line(at)))
}

/// The table of a sheet; `line` tells the line of a place in the document.
pub fn points(rubric: &Rubric, sheet: &Sheet, line: impl Fn(usize) -> usize) -> String {
    let mut rows: Vec<Vec<String>> = vec![];
    for (item, mark) in rubric.items.iter().zip(&sheet.marks) {
        rows.push(vec![item.name.clone(), earned(mark.points, mark.open), decimals(item.points, 2), {
            remark(mark, &line)
        }]);
    }
    let sum = earned(sheet.points(), sheet.open());
    rows.push(vec!["sum".into(), sum, decimals(rubric.points(), 2), String::new()]);
    table(&["item", "points", "of", ""], &[Align::Left, Align::Right, Align::Right, Align::Left], &rows)
}

/// Points, and what a teacher may add: `2 + 1?`.
pub fn earned(points: f64, open: f64) -> String {
    match open > 0.0 {
        true => format!("{} + {}?", decimals(points, 2), decimals(open, 2)),
        false => decimals(points, 2),
    }
}

/// What is to be said of an item.
pub fn remark(mark: &Mark, line: impl Fn(usize) -> usize) -> String {
    let [right, count] = mark.right;
    if count == 0 {
        return "not in the document".into();
    }
    let mut parts = vec![format!("{right} of {count} right")];
    if let Some([found, all]) = mark.configurations {
        parts.push(format!("{found} of {all} configurations"));
    }
    for name in mark.named_otherwise.iter().take(6) {
        parts.push(format!("{name} has the right value, its name says something else"));
    }
    for (what, standings) in [
        ("not", &[Standing::Wrong][..]),
        ("under a condition", &[Standing::Conditional]),
        ("carried", &[Standing::Carried]),
    ] {
        let names: Vec<&str> =
            mark.others.iter().filter(|o| standings.contains(&o.1)).map(|o| o.0.as_str()).take(6).collect();
        if !names.is_empty() {
            parts.push(format!("{what} {}", names.join(", ")));
        }
    }
    for (name, slip, right) in mark.slips.iter().take(6) {
        parts.push(format!("{name}: {}, right is {right}", words().value_slip(*slip)));
    }
    let mut lines: Vec<String> = mark.by_hand.iter().map(|s| line(s.start).to_string()).collect();
    lines.dedup();
    if !lines.is_empty() {
        let word = if lines.len() == 1 { "line" } else { "lines" };
        parts.push(format!("by hand: {word} {}", lines.join(", ")));
    }
    parts.join(", ")
}
