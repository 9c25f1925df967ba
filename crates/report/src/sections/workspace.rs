//! What is reached: a section of the workspace with the manipulability in it.

use super::setting::Setting;
use crate::cell::decimals;
use crate::document::{Line, Part, Section};
use crate::figure::plot::{arm_line, workspace_plot};
use crate::words::Heading;
use denavit::inverse::JointSpace;
use denavit::workspace::{Assumed, Workspace};
use denavit_symbolic::Expr;

/// The plot and its extremes; nothing if nothing moves.
pub fn section(s: &Setting) -> Option<Section> {
    let (robot, space) = s.robot()?;
    let (space, travels) = with_travels(s, space);
    let workspace = Workspace::new(&robot, &space).ok()?;
    let mut section = Section::new(s.description.vocabulary());
    section.heading(2, Line::new(s.words().heading(Heading::Workspace)));
    if let Some(assumed) = s.assumed() {
        section.paragraph(assumed);
    }
    let [u, v] = workspace.section.symbols();
    let written = |x: f64| s.words().written(decimals(x, 3));
    let metres = |x: f64| format!("{} m", written(x));
    let range = |x: [f64; 2]| format!("{} … {}", written(x[0]), metres(x[1]));
    let (first, second) = (range(workspace.extremes.first), range(workspace.extremes.second));
    let far = workspace.extremes.from_shoulder.filter(|_| workspace.extremes.shoulder.is_some()).map(metres);
    let mut line = Line::new(s.words().reach((u, &first), (v, &second), far.as_deref()));
    let is_free = |(limits, is_angle): (&Option<[f64; 2]>, &bool)| *is_angle && limits.is_none();
    if space.limits.iter().zip(&space.is_angle).any(is_free) {
        line = line.text(s.words().full_turns());
    }
    line = taken(s, line, &travels, s.words().assumed_travel());
    line = taken(s, line, &workspace.held, s.words().held());
    section.paragraph(line);
    let arm = arm_line(&workspace, &robot, &s.q);
    let drawing = workspace_plot(&workspace, arm.as_deref());
    let caption = s.words().workspace(&workspace.section, [u, v], arm.is_some());
    section.push(Part::figure(s.words(), drawing, Line::new(caption)));
    Some(section)
}

/// The joint space with a travel for slides that have none: as far as the arm is long, and farther than the example.
fn with_travels(s: &Setting, mut space: JointSpace) -> (JointSpace, Vec<Assumed>) {
    let mut travels = vec![];
    for joint in 0..space.limits.len() {
        if space.is_angle[joint] || space.limits[joint].is_some() {
            continue;
        }
        let x = s.q[joint];
        let length = if space.reach > 0.0 { space.reach } else { 1.0 };
        let range = [(1.5 * x).min(0.0), length.max(1.5 * x)];
        space.limits[joint] = Some(range);
        travels.push(Assumed { joint, range });
    }
    (space, travels)
}

/// Ranges of joints that the plot takes for given.
fn taken(s: &Setting, mut line: Line, all: &[Assumed], words: String) -> Line {
    let variables = s.description.variables();
    for (k, one) in all.iter().enumerate() {
        line = line.text(if k == 0 { &words } else { s.words().between() });
        line = line.math(Expr::from(variables[one.joint].symbol));
        let [low, high] = one.range.map(|x| s.words().written(decimals(x, 3)));
        line = line.text(if low == high { format!(" = {low} m") } else { format!(" = {low} … {high} m") });
    }
    if all.is_empty() { line } else { line.text(".") }
}
