//! The Jacobian, its determinant, and a picture of each singularity.

use super::inverse::lowered;
use super::setting::{Level, Setting};
use crate::document::{Line, Math, Part, Section};
use crate::explain::{found_singularities_document, singularities_document, velocity_vocabulary};
use crate::figure::{FigureOptions, isometric};
use crate::words::{Caption, Heading};
use denavit::forward::Reference;
use denavit::velocity::{JacobianModel, Obstacle, Place, Singularities, singular_configurations};
use denavit_symbolic::Expr;

/// The size of a picture, points.
const SIZE: [f64; 2] = [150.0, 150.0];

/// Formulas and pictures.
pub fn sections(s: &Setting) -> Vec<Section> {
    let title = Line::new(s.words().heading(Heading::Velocity));
    match s.singular() {
        Ok(found) => {
            let mut section = Section::new(velocity_vocabulary(&s.description));
            section.heading(2, title);
            lowered(
                singularities_document(&s.description, found, s.options.language),
                s.words(),
                &mut section,
            );
            let mut all = vec![section];
            if s.options.level == Level::Full {
                all.extend(pictures(s, found));
            }
            all
        }
        Err(why) => {
            let model = JacobianModel::shortest(&s.description, Reference::Tool);
            let mut section = Section::new(velocity_vocabulary(&s.description));
            section.heading(2, title);
            let found = match why {
                Obstacle::AlwaysSingular(_) => Ok(vec![]),
                _ => singular_configurations(&s.description, &model.view, &[0, 1, 2, 3, 4, 5]),
            };
            let language = s.options.language;
            lowered(
                found_singularities_document(&s.description, &model, why, found.as_deref(), language),
                s.words(),
                &mut section,
            );
            vec![section]
        }
    }
}

/// The arm at a configuration of each singularity, the axes that matter marked.
fn pictures(s: &Setting, found: &Singularities) -> Option<Section> {
    let arm = s.arm.as_ref()?;
    let view = arm.view();
    let factors: Vec<Expr> = found.common.iter().map(|c| c.factor).collect();
    let mut shown = vec![];
    for one in &found.common {
        // The robot's own lengths, or those of the other figures.
        let Some(q) = denavit::velocity::singular_configuration(&s.valued, one.factor, &factors, &s.q) else {
            continue;
        };
        let highlight = one.example.as_ref().map(|e| axes(&e.place)).unwrap_or_default();
        shown.push((one.factor, arm.at(&q), highlight));
    }
    let bounds = shown.iter().map(|(_, a, _)| a.bounds(&view)).reduce(|a, b| a.with(&b))?;
    let pictures = shown.iter().map(|(factor, a, highlight)| {
        let options = FigureOptions {
            view: Some(view),
            bounds: Some(bounds),
            highlight: highlight.clone(),
            ..FigureOptions::small(SIZE[0], SIZE[1])
        };
        (isometric(a, &options), Line::default().math(Math::equation(*factor, Expr::int(0))))
    });
    let mut section = Section::new(s.description.vocabulary());
    section.push(Part::figures(
        s.words(),
        pictures.collect(),
        Line::new(s.words().caption(Caption::Singular)),
    ));
    Some(section)
}

/// The joints (from 0) whose axes make a configuration singular.
fn axes(place: &Place) -> Vec<usize> {
    match place {
        Place::OneLine(a, b) => vec![*a, *b],
        Place::OnePlane(all) | Place::Parallel(all) | Place::SelfMotion { joints: all, .. } => all.clone(),
        Place::PointOnAxis(axis) => vec![*axis],
        Place::CentreOnAxis { axis, .. } => vec![*axis],
        Place::CentreInPlane { axes, .. } | Place::PointInPlane { axes, .. } => axes.to_vec(),
        Place::Line { meets, .. } => meets.clone(),
        Place::Lost | Place::Differs => vec![],
    }
}
