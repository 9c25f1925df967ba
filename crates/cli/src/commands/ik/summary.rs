//! What can be said of a derivation in a few lines.

use crate::commands::show::title;
use crate::terminal::{Align, FAINT, HEADING, NAME, styled, table, words};
use denavit::structure::Structure;
use denavit_report::document::{Math, Sign, math};
use denavit_report::explain::Explanation;
use denavit_symbolic::print::{Style, print};

/// Structure, a line a step, how many solutions.
pub fn text(e: &Explanation) -> String {
    let names = e.names();
    let formula = |m: &Math| math(m, &names, Style::Unicode);
    let mut text = title(&e.description);
    text += &format!("  {}\n", Structure::of(&e.description).schematic());
    let given: Vec<String> = e.given.iter().map(|q| print(*q, &names, Style::Unicode)).collect();
    if !given.is_empty() {
        let why = if e.given_by_choice { " (joints too many; any value is allowed)" } else { "" };
        text += &format!("  given beside the pose: {}{why}\n", styled(&given.join(", "), NAME));
    }
    text.push('\n');
    let rows: Vec<Vec<String>> = e
        .steps
        .iter()
        .enumerate()
        .map(|(k, s)| {
            let meaning = s.meaning.map(|m| format!(" = {}", print(m, &names, Style::Unicode)));
            let equations: Vec<String> =
                s.sources.iter().flat_map(|o| &o.equations).map(|q| formula(&q.math)).collect();
            let equation = match (equations.len(), s.sources.iter().any(|o| o.squared)) {
                (0, _) => String::new(),
                (_, true) => format!("squares of  {}", equations.join(",  ")),
                _ => equations.join(",  "),
            };
            vec![
                (k + 1).to_string(),
                print(s.unknown, &names, Style::Unicode) + &meaning.unwrap_or_default(),
                s.values.to_string(),
                s.label.map(|label| words().label(label)).unwrap_or_default(),
                s.kind.number().replace("none", "–"),
                equation,
            ]
        })
        .collect();
    let header = ["", "unknown", "values", "branch", "type", "from"];
    let align = [Align::Right, Align::Left, Align::Right, Align::Left, Align::Left, Align::Left];
    if !rows.is_empty() {
        text += &table(&header, &align, &rows);
    }
    for s in &e.joints {
        text += &format!("     {}\n", formula(&s.math));
    }
    text.push('\n');
    match e.solutions {
        Some(n) => {
            let count = if n == 1 { "one solution".into() } else { format!("at most {n} solutions") };
            text += &format!("  {}\n", styled(&count, HEADING));
        }
        None => {
            let missing: Vec<String> = e.missing.iter().map(|q| print(*q, &names, Style::Unicode)).collect();
            let verb = if missing.len() == 1 { "is" } else { "are" };
            text += &format!("  {} {verb} not found: no closed form\n", styled(&missing.join(", "), NAME));
        }
    }
    for (k, s) in e.steps.iter().enumerate() {
        for c in s.conditions.iter().filter(|c| !c.when.is_empty()) {
            let when: Vec<String> = c.when.iter().map(formula).collect();
            let is_bound = c
                .when
                .iter()
                .any(|m| matches!(m, Math::Chain(_, signs) if signs.iter().any(|s| s.0 != Sign::Equal)));
            let what = if is_bound { "needs" } else { "is degenerate at" };
            text += &format!("  step {} {what} {}\n", k + 1, when.join(", "));
        }
    }
    if let Some(target) = e.target() {
        text += &format!("  p, n, o and a are those of {}, T the pose of the tool\n", formula(&target));
    }
    for s in &e.leftovers {
        text += &format!("  the pose must meet {}\n", formula(&s.math));
    }
    if e.steps.is_empty() {
        return text + &format!("  {}\n", styled("--pose and -q solve in numbers", FAINT));
    }
    let which = if e.solutions.is_some() { "all formulas" } else { "the formulas above are" };
    let hint = "--explain shows every step, --symbolic the formulas, --pose and -q solve";
    text + &format!("  {}\n", styled(&format!("{which} {}; {hint}", words().proof(e.proof())), FAINT))
}
