//! The robot at a glance.

use super::setting::{Setting, Topic};
use crate::document::{Part, Section};
use denavit::description::{Convention, JointKind};
use denavit::explain::{Line, count};
use denavit::forward::Proof;
use denavit::inverse::Refusal;
use denavit::structure::Relation;
use denavit::velocity::Obstacle;
use denavit_symbolic::print::{Style, print};

/// Factors whose LaTeX is longer are not for a summary.
const LONG: usize = 240;

/// A box of labels and values.
pub fn section(s: &Setting) -> Section {
    let mut rows = vec![(s.line("Structure", "Structure"), structure(s))];
    rows.push((s.line("Convention", "Convention"), convention(s)));
    if let Some(source) = &s.description.source {
        rows.push((s.line("Source", "Source"), Line::new(source.clone())));
    }
    if s.options.topics.contains(&Topic::Forward) {
        rows.push((s.line("Forward model", "Modèle direct"), forward(s)));
    }
    if s.options.topics.contains(&Topic::Inverse) {
        rows.push((s.line("Inverse model", "Modèle inverse"), inverse(s)));
    }
    if s.options.topics.contains(&Topic::Velocity) {
        rows.push((s.line("Singularities", "Singularités"), singularities(s)));
    }
    let mut section = Section::new(s.description.vocabulary());
    section.push(Part::Summary(rows));
    section
}

fn structure(s: &Setting) -> Line {
    let kinds: String =
        s.structure.joints.iter().map(|k| if *k == JointKind::Revolute { 'R' } else { 'P' }).collect();
    let n = kinds.len();
    let mut text = s.language.pick(
        format!("{kinds}, {n} joint{}; {}", if n == 1 { "" } else { "s" }, s.structure.schematic()),
        s.language.spaced(&format!(
            "{kinds}, {n} articulation{} ; {}",
            if n < 2 { "" } else { "s" },
            s.structure.schematic()
        )),
    );
    let numbers = |all: &[usize]| s.language.listed(&all.iter().map(ToString::to_string).collect::<Vec<_>>());
    for run in &s.structure.parallel {
        let run = numbers(run);
        text += &s.language.pick(
            format!("; axes {run} are parallel"),
            s.language.spaced(&format!(" ; axes {run} parallèles")),
        );
    }
    for &first in &s.structure.spherical {
        let last = first + 2 == n;
        let run = numbers(&[first, first + 1, first + 2]);
        let english = if last { "spherical wrist" } else { "spherical joint" };
        let french = if last { "poignet sphérique" } else { "rotule" };
        text += &s.language.pick(
            format!("; axes {run} meet in one point ({english})"),
            s.language.spaced(&format!(" ; axes {run} concourants ({french})")),
        );
    }
    for (k, relation) in s.structure.relations.iter().enumerate().filter(|r| *r.1 == Relation::Coincident) {
        let _ = relation;
        text += &s.language.pick(
            format!("; axes {} and {} coincide", k + 1, k + 2),
            s.language.spaced(&format!(" ; axes {} et {} confondus", k + 1, k + 2)),
        );
    }
    Line::new(text + ".")
}

fn convention(s: &Setting) -> Line {
    Line::new(match s.description.convention {
        Convention::Standard => s.say(
            "Denavit–Hartenberg, standard: Rot(z, θ) Trans(z, d) Trans(x, a) Rot(x, α).",
            "Denavit–Hartenberg standard : Rot(z, θ) Trans(z, d) Trans(x, a) Rot(x, α).",
        ),
        Convention::Craig => s.say(
            "Denavit–Hartenberg, modified (Craig): Rot(x, α) Trans(x, a) Rot(z, θ) Trans(z, d).",
            "Denavit–Hartenberg modifié (Craig) : Rot(x, α) Trans(x, a) Rot(z, θ) Trans(z, d).",
        ),
        Convention::Khalil => s.say(
            "Khalil–Kleinfinger: Rot(x, α) Trans(x, d) Rot(z, θ) Trans(z, r).",
            "Khalil–Kleinfinger : Rot(x, α) Trans(x, d) Rot(z, θ) Trans(z, r).",
        ),
    })
}

fn forward(s: &Setting) -> Line {
    let model = s.forward();
    let count = count(&model.algorithm.count(), s.language);
    let proved = match model.proof {
        Proof::Proved => s.say(
            "proved equal to the product of the link transforms",
            "égalité démontrée avec le produit des matrices de passage",
        ),
        other => other.of_model(s.language),
    };
    Line::new(
        s.language.spaced(&s.language.pick(format!("{count}; {proved}."), format!("{count} ; {proved}."))),
    )
}

fn inverse(s: &Setting) -> Line {
    Line::new(match s.inverse() {
        Ok(model) => {
            let n = model.max_solutions();
            let free: Vec<String> =
                model.given.iter().map(|&j| s.description.variables()[j].symbol.name().to_string()).collect();
            let text = s.language.pick(
                if n == 1 {
                    "closed form, one solution".into()
                } else {
                    format!("closed form, at most {n} solutions")
                },
                if n == 1 {
                    "forme explicite, une solution".into()
                } else {
                    format!("forme explicite, au plus {n} solutions")
                },
            );
            match free.is_empty() {
                true => text + ".",
                false => {
                    text + &s.language.pick(
                        format!(", for each value of {}.", free.join(", ")),
                        format!(", pour chaque valeur de {}.", free.join(", ")),
                    )
                }
            }
        }
        Err(Refusal::Stuck(stuck)) if stuck.surplus == 0 && s.description.variables().len() == 6 => s.say(
            "no closed form; all solutions, at most 16, by elimination.",
            "pas de forme explicite ; toutes les solutions, 16 au plus, par élimination.",
        ),
        Err(_) => s.say("no closed form; in numbers.", "pas de forme explicite ; par calcul numérique."),
    })
}

fn singularities(s: &Setting) -> Line {
    match s.singular() {
        Ok(found) if found.common.is_empty() && found.is_complete => s.line("none.", "aucune."),
        Ok(found) if found.common.is_empty() => {
            s.line(
                "where all determinants of the section on the Jacobian vanish at once; no single factor is shared by them.",
                "là où tous les déterminants de la section sur la jacobienne s'annulent à la fois ; ils n'ont aucun facteur commun.",
            )
        }
        Ok(found) => {
            let mut line = Line::default();
            let is_short = |e: denavit_symbolic::Expr| print(e, &s.description.vocabulary(), Style::Latex).len() < LONG;
            if !found.common.iter().all(|one| is_short(one.factor)) {
                return s.line(
                    "factors of the determinant that are too long for a summary.",
                    "facteurs du déterminant trop longs pour un résumé.",
                );
            }
            for (k, one) in found.common.iter().enumerate() {
                let zero = denavit_symbolic::Expr::int(0);
                line = line
                    .text(if k > 0 { s.say("; ", " ; ") } else { String::new() })
                    .math(denavit::explain::Math::equation(one.factor, zero));
            }
            if found.is_complete {
                line.text(".")
            } else {
                line.text(s.say(
                    ", and where all determinants of the section on the Jacobian vanish at once.",
                    ", et là où tous les déterminants de la section sur la jacobienne s'annulent à la fois.",
                ))
            }
        }
        Err(Obstacle::AlwaysSingular(_)) => s.line(
            "the arm has fewer than six directions everywhere.",
            "le bras a partout moins de six degrés de liberté.",
        ),
        Err(_) => s.line("too large to be expanded.", "expressions trop grandes pour être développées."),
    }
}
