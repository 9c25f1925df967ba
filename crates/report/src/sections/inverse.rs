//! Inverse kinematics: the derivation, and the solutions at the example.

use super::example::{numbers, plain};
use super::setting::Setting;
use crate::document::{Part, Section, Table};
use crate::figure::{Options, isometric};
use crate::render::too_long;
use denavit::description::JointKind;
use denavit::explain::{Block, Language, Line};
use denavit::inverse::explain::Explanation;
use denavit::inverse::{Goal, InverseKinematics, Refusal, Solution};
use denavit_symbolic::Expr;

/// More solutions are not listed.
const SHOWN: usize = 16;
/// The size of one, points.
const SIZE: [f64; 2] = [108.0, 112.0];

/// The derivation and the example.
pub fn sections(s: &Setting) -> Vec<Section> {
    let mut all = vec![derivation(s)];
    all.extend(solutions(s));
    all
}

fn derivation(s: &Setting) -> Section {
    let title = s.line("Inverse kinematics", "Modèle géométrique inverse");
    let explained = match s.inverse() {
        Ok(model) => Some(Explanation::of(model)),
        Err(Refusal::Stuck(stuck)) => Some(Explanation::of_stuck(&s.description, stuck, Goal::Pose)),
        Err(Refusal::Given(_) | Refusal::Unsuitable(_)) => None,
    };
    let names = explained.as_ref().map_or_else(|| s.description.vocabulary(), Explanation::names);
    let mut section = Section::new(names);
    section.heading(2, title);
    match (explained, s.inverse()) {
        (Some(e), _) => lowered(e.document(s.language), s.language, &mut section),
        (None, Err(why)) => section.paragraph(Line::new(s.language.pick(
            format!("There is no closed form: {why}."),
            s.language.spaced(&format!("Il n'y a pas de forme explicite : {}.", why)),
        ))),
        (None, Ok(_)) => {}
    }
    section
}

/// A document as a part of another: its title left out, its headings one level lower.
pub fn lowered(blocks: Vec<Block>, language: Language, section: &mut Section) {
    for block in blocks {
        match block {
            Block::Heading(1, _) => {}
            Block::Formula { math, .. } if too_long(&math, &section.names) => section.paragraph(Line::new(language.pick(
                "A formula that is too long to be printed stands here; `--json` of the command has it.",
                "Ici se trouve une formule trop longue pour être imprimée ; l’option `--json` de la commande la donne.",
            ))),
            Block::Heading(level, line) => section.heading(level + 1, line),
            other => section.push(other),
        }
    }
}

fn solutions(s: &Setting) -> Option<Section> {
    // Joints too many have the values of the example, as in the derivation.
    let given = s.inverse().as_ref().ok().map(|m| m.given.clone()).filter(|g| !g.is_empty());
    let options = denavit::inverse::Options { given, ..Default::default() };
    let mut solver = InverseKinematics::new(&s.valued, &options).ok()?;
    solver.seed = Some(s.q.clone());
    let pose = solver.robot.pose(&s.q);
    let given: Vec<f64> = solver.given.iter().map(|&j| s.q[j]).collect();
    let answer = solver.solve(&pose, &given);
    let mut section = Section::new(s.description.vocabulary());
    section.heading(3, s.line("The solutions at the example", "Les solutions de l'exemple"));
    let mut line = s.line("The pose of the tool at ", "La pose de l'outil pour ");
    line.0.extend(s.configuration(&s.q).0);
    section.paragraph(line.text(s.say(" is", " est")));
    section.formula(numbers(&pose));
    if !given.is_empty() {
        let mut line = s.line("With ", "Avec ");
        let variables = s.description.variables();
        for (k, &j) in solver.given.iter().enumerate() {
            line = line.text(if k > 0 { ", " } else { "" }).math(Expr::from(variables[j].symbol));
            line = line.text(format!(" = {}", s.reading(s.q[j], variables[j].kind)));
        }
        section.paragraph(line.text(s.say(" given:", " donné :")));
    }
    let representatives = answer.families.iter().map(|f| &f.representative);
    let found: Vec<Solution> = answer.solutions.iter().chain(representatives).cloned().collect();
    let found: Vec<Solution> = found.into_iter().map(|f| turned(f, &solver.space)).collect();
    if found.is_empty() {
        section.paragraph(
            s.line("No solution was found in numbers.", "Aucune solution n'a été trouvée numériquement."),
        );
        return Some(section);
    }
    let shown = &found[..found.len().min(SHOWN)];
    section.push(table(s, shown, answer.solutions.len()));
    section.paragraph(counted(s, answer.solutions.len(), answer.families.len(), answer.is_complete()));
    if found.len() > SHOWN {
        section.paragraph(Line::new(s.language.pick(
            format!("The first {SHOWN} of them are shown."),
            format!("Seules les {SHOWN} premières sont montrées."),
        )));
    }
    section.push(pictures(s, shown)?);
    Some(section)
}

/// A solution within the limits by whole turns of its joints, with the values that are.
fn turned(mut found: Solution, space: &denavit::inverse::JointSpace) -> Solution {
    if found.within_limits {
        for ((x, limits), is_angle) in found.q.iter_mut().zip(&space.limits).zip(&space.is_angle) {
            let Some([low, high]) = limits.filter(|_| *is_angle) else { continue };
            let turn = std::f64::consts::TAU;
            let copies = [*x, *x + turn, *x - turn];
            let slack = 1e-9;
            *x = copies.into_iter().find(|c| (low - slack..=high + slack).contains(c)).unwrap_or(*x);
        }
    }
    found
}

fn counted(s: &Setting, isolated: usize, families: usize, complete: bool) -> Line {
    let mut text = s.language.counted(
        isolated,
        ["isolated solution", "isolated solutions"],
        ["solution isolée", "solutions isolées"],
    );
    if families > 0 {
        text += s.language.pick(" and ", " et ");
        text += &s.language.counted(
            families,
            [
                "family in which the arm moves with its hand still",
                "families in which the arm moves with its hand still",
            ],
            [
                "famille dans laquelle le bras bouge sans que la main bouge",
                "familles dans lesquelles le bras bouge sans que la main bouge",
            ],
        );
        text += s
            .language
            .pick(" (marked *: one member each is shown)", " (marquées * : un membre de chacune est montré)");
    }
    text += &match complete {
        true => s.say(
            "; these are all. Each was put into the chain again.",
            " ; il n'y en a pas d'autres. Chacune a été reportée dans la chaîne.",
        ),
        false => s.say("; others may exist.", " ; il peut en exister d'autres."),
    };
    Line::new(s.language.spaced(&text))
}

fn table(s: &Setting, found: &[Solution], isolated: usize) -> Part {
    let variables = s.description.variables();
    let mut head = vec![Line::default()];
    head.extend(variables.iter().map(|v| {
        let unit = if v.kind == JointKind::Revolute { " (°)" } else { " (m)" };
        Line::default().math(Expr::from(v.symbol)).text(unit)
    }));
    let has_branches = found.iter().any(|f| !f.branch.is_empty());
    let has_limits = found.iter().any(|f| !f.within_limits);
    if has_branches {
        head.push(s.line("branch", "branche"));
    }
    if has_limits {
        head.push(s.line("limits", "butées"));
    }
    let rows = found.iter().enumerate().map(|(k, f)| {
        let star = if k < isolated { "" } else { "*" };
        let mut cells = vec![Line::new(format!("{}{star}", k + 1))];
        cells.extend(f.q.iter().zip(&variables).map(|(x, v)| Line::new(plain(*x, v.kind))));
        if has_branches {
            cells.push(Line::new(branch(s, &f.branch)));
        }
        if has_limits {
            cells.push(if f.within_limits {
                s.line("within", "respectées")
            } else {
                s.line("beyond", "dépassées")
            });
        }
        cells
    });
    Part::Table(Table {
        caption: s
            .line("All configurations with this pose.", "Toutes les configurations qui donnent cette pose."),
        head,
        rows: rows.collect(),
    })
}

/// The name of a branch; its labels are words.
fn branch(s: &Setting, label: &str) -> String {
    match s.language {
        Language::English => label.replace('-', "−"),
        Language::French => label
            .replace("shoulder", "épaule")
            .replace("elbow", "coude")
            .replace("wrist", "poignet")
            .replace('-', "−"),
    }
}

fn pictures(s: &Setting, found: &[Solution]) -> Option<Part> {
    let arm = s.arm.as_ref()?;
    let view = arm.view();
    let arms: Vec<_> = found.iter().map(|f| arm.at(&f.q)).collect();
    let bounds = arms.iter().map(|a| a.bounds(&view)).reduce(|a, b| a.with(&b))?;
    let options = Options { view: Some(view), bounds: Some(bounds), ..Options::small(SIZE[0], SIZE[1]) };
    let picture =
        |(k, a): (usize, &crate::figure::Arm)| (isometric(a, &options), Line::new((k + 1).to_string()));
    Some(Part::figures(
        s.language,
        arms.iter().enumerate().map(picture).collect(),
        s.line(
            "The configurations of the table, all with the same pose of the tool.",
            "Les configurations du tableau, toutes avec la même pose de l'outil.",
        ),
    ))
}
