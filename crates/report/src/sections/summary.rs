//! The robot at a glance.

use super::setting::{Setting, Topic};
use crate::document::{Line, Math, Part, Section};
use crate::explain::Explanation;
use crate::words::{Factors, Glance};
use denavit::inverse::Refusal;
use denavit::velocity::{Obstacle, Singularities, Singularity};
use denavit_symbolic::Expr;
use denavit_symbolic::print::{Style, print};

/// Factors whose LaTeX is longer are not for a summary.
const LONG: usize = 240;

/// A box of labels and values.
pub fn section(s: &Setting) -> Section {
    let mut section = Section::new(s.description.vocabulary());
    let labelled = |(glance, line)| (Line::new(s.words().glance(glance)), line);
    section.push(Part::Summary(rows(s).into_iter().map(labelled).collect()));
    section
}

/// What is known at a glance.
pub fn rows(s: &Setting) -> Vec<(Glance, Line)> {
    let mut rows = vec![(Glance::Structure, Line::new(s.words().structure(&s.structure)))];
    rows.push((Glance::Convention, Line::new(s.words().convention(s.description.convention))));
    if let Some(source) = &s.description.source {
        rows.push((Glance::Source, Line::new(source.clone())));
    }
    if s.options.topics.contains(&Topic::Forward) {
        rows.push((Glance::Forward, forward(s)));
    }
    if s.options.topics.contains(&Topic::Inverse) {
        rows.push((Glance::Inverse, inverse(s)));
    }
    if s.options.topics.contains(&Topic::Velocity) {
        rows.push((Glance::Singularities, singularities(s)));
    }
    rows
}

fn forward(s: &Setting) -> Line {
    let model = s.forward();
    Line::new(s.words().forward_cost(&model.algorithm.count(), model.proof))
}

fn inverse(s: &Setting) -> Line {
    let variables = s.description.variables();
    Line::new(match s.inverse() {
        Ok(model) => {
            let given = model.given.iter().map(|&j| variables[j].symbol.name().to_string());
            let pose = s.words().closed_form(model.max_solutions(), &given.collect::<Vec<_>>());
            let position = Explanation::of_its_position(model).and_then(|e| e.solutions);
            match position {
                Some(count) => {
                    format!("{pose} {}", s.words().of_the_position(&s.words().closed_form(count, &[])))
                }
                None => pose,
            }
        }
        Err(why) => {
            let is_square = matches!(why, Refusal::Stuck(stuck) if stuck.surplus == 0);
            s.words().no_closed_form(is_square && variables.len() == 6)
        }
    })
}

fn singularities(s: &Setting) -> Line {
    let line = factors(s, s.singular().as_ref());
    let point = s.singular().as_ref().ok().and_then(|found| found.of_its_point(&s.description));
    match &point {
        Some(point) => {
            let mut line = line.text(format!(" {}", s.words().of_the_position("")));
            line.0.extend(factors(s, Ok(point)).0);
            line
        }
        None => line,
    }
}

fn factors(s: &Setting, found: Result<&Singularities, &Obstacle>) -> Line {
    let is_long = |e: Expr| print(e, &s.description.vocabulary(), Style::Latex).len() >= LONG;
    s.words().factors(match found {
        Ok(found) if found.deficient.is_some() => Factors::Everywhere,
        Ok(found) if found.common.is_empty() && found.is_complete => Factors::None,
        Ok(found) if found.common.is_empty() => Factors::NotShared,
        Ok(found) if found.common.iter().any(|one| is_long(one.factor)) => Factors::Long,
        Ok(found) => {
            let zero = |one: &Singularity| Math::equation(one.factor, Expr::int(0));
            Factors::Shared(found.common.iter().map(zero).collect(), found.is_complete)
        }
        Err(Obstacle::AlwaysSingular(_)) => Factors::Everywhere,
        Err(_) => Factors::TooLarge,
    })
}
