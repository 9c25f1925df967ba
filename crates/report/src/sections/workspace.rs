//! What is reached: a section of the workspace with the manipulability in it.

use super::setting::Setting;
use crate::cell::decimals;
use crate::document::{Part, Section};
use crate::figure::plot::{arm_line, workspace_plot};
use denavit::explain::Line;
use denavit::inverse::JointSpace;
use denavit::workspace::{Assumed, Section as Plane, Workspace};
use denavit_symbolic::Expr;

/// The plot and its extremes; nothing if nothing moves.
pub fn section(s: &Setting) -> Option<Section> {
    let (robot, space) = s.robot()?;
    let (space, travels) = with_travels(s, space);
    let workspace = Workspace::new(&robot, &space).ok()?;
    let mut section = Section::new(s.description.vocabulary());
    section.heading(2, s.line("Workspace", "Espace de travail"));
    if let Some(assumed) = s.assumed() {
        section.paragraph(assumed);
    }
    let [u, v] = workspace.section.symbols();
    let metres = |x: f64| format!("{} m", decimals(x, 3));
    let range = |x: [f64; 2]| format!("{} … {}", decimals(x[0], 3), metres(x[1]));
    let (first, second) = (range(workspace.extremes.first), range(workspace.extremes.second));
    let mut text = s.language.pick(
        format!("Within the limits of the joints the tool point comes to {u} = {first} and {v} = {second}"),
        format!(
            "Dans les butées des articulations, le point de l'outil atteint {u} = {first} et {v} = {second}"
        ),
    );
    if let (Some(far), Some(_)) = (workspace.extremes.from_shoulder, workspace.extremes.shoulder) {
        text += &s.language.pick(
            format!("; its largest distance from the shoulder is {}", metres(far)),
            format!(" ; sa plus grande distance à l'épaule est {}", metres(far)),
        );
    }
    let mut line = Line::new(s.language.spaced(&(text + ".")));
    let is_free = |(limits, is_angle): (&Option<[f64; 2]>, &bool)| *is_angle && limits.is_none();
    if space.limits.iter().zip(&space.is_angle).any(is_free) {
        line = line.text(s.say(
            " Joints that turn and have no limits turn fully.",
            " Une articulation rotoïde sans butées tourne d'un tour complet.",
        ));
    }
    line = taken(s, line, &travels, " Assumed travel: ", " Course supposée : ");
    line = taken(s, line, &workspace.held, " Held: ", " Fixé : ");
    section.paragraph(line);
    let arm = arm_line(&workspace, &robot, &s.q);
    let drawing = workspace_plot(&workspace, arm.as_deref());
    let drawn = arm
        .is_some()
        .then(|| s.say(" The line is the arm of the example.", " La ligne est le bras de l'exemple."));
    section.push(Part::figure(
        s.language,
        drawing,
        Line::new(match &workspace.section {
            Plane::ThroughAxis { joint, .. } => s.language.pick(
                format!(
                    "What the tool point reaches, in the half plane through axis {} (distance {u}, height {v}). Colours: the \
                     largest manipulability √det(J Jᵀ) of its velocity found there, by the largest of all.",
                    joint + 1
                ),
                s.language.spaced(&format!(
                    "Ce que le point de l'outil atteint, dans le demi-plan de l'axe {} (distance {u}, hauteur {v}). \
                     Couleurs : la plus grande manipulabilité √det(J Jᵀ) de sa vitesse trouvée à cet endroit, rapportée au \
                     maximum.",
                    joint + 1
                )),
            ),
            Plane::Plane { .. } => s.language.pick(
                format!(
                    "What the tool point reaches, in its plane ({u}, {v}). Colours: the largest manipulability of its \
                     velocity found there, by the largest of all."
                ),
                s.language.spaced(&format!(
                    "Ce que le point de l'outil atteint, dans son plan ({u}, {v}). Couleurs : la plus grande manipulabilité \
                     de sa vitesse trouvée à cet endroit, rapportée au maximum."
                )),
            ),
            Plane::Projection { .. } => s.language.pick(
                format!(
                    "What the tool point reaches, projected onto the plane ({u}, {v}). Colours: the largest manipulability of \
                     its velocity found there, by the largest of all."
                ),
                s.language.spaced(&format!(
                    "Ce que le point de l'outil atteint, en projection sur le plan ({u}, {v}). Couleurs : la plus grande \
                     manipulabilité de sa vitesse trouvée à cet endroit, rapportée au maximum."
                )),
            ),
        })
        .text(drawn.unwrap_or_default()),
    ));
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
fn taken(s: &Setting, mut line: Line, all: &[Assumed], english: &str, french: &str) -> Line {
    let variables = s.description.variables();
    for (k, one) in all.iter().enumerate() {
        line = if k == 0 { line.text(s.say(english, french)) } else { line.text(", ") };
        line = line.math(Expr::from(variables[one.joint].symbol));
        let [low, high] = one.range.map(|x| decimals(x, 3));
        line = line.text(if low == high { format!(" = {low} m") } else { format!(" = {low} … {high} m") });
    }
    if all.is_empty() { line } else { line.text(".") }
}
