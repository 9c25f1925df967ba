//! The Jacobian and its singularities.

use crate::document::{Block, Factor, Line, Math, Proof, Sign};
use crate::words::{Gain, Loss, Tongue, Wording};
use denavit::description::{Description, Variable};
use denavit::forward::{Proof as Forward, Reference};
use denavit::quantity::reading;
use denavit::robot::MissingValue;
use denavit::velocity::{
    Example, Jacobian, JacobianModel, Minor, Obstacle, Place, REST, ROWS, Singularities, Singularity,
    Viewpoint,
};
use denavit_symbolic::readable::literals;
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Expr, Rational};

/// The robot's names and those of velocities: `dq1`, `vx`, and where a point is apart.
pub fn velocity_vocabulary(description: &Description) -> Vocabulary {
    let rates = description.variables().into_iter().map(|v| format!("d{}", v.symbol.name()));
    let twist = ROWS.iter().chain(&REST).map(ToString::to_string);
    rates.chain(twist).fold(description.vocabulary(), |v, name| v.symbol(&name))
}

/// The matrix, with its place and what it costs.
pub fn jacobian_document(description: &Description, model: &JacobianModel, language: Tongue) -> Vec<Block> {
    let words = language.words();
    let mut blocks = vec![Block::Heading(1, Line::new(words.jacobian_title(&description.name)))];
    blocks.extend(matrix(model, words));
    blocks
}

/// The matrix at the hand in the base and where it is shortest, its determinant in factors, and what happens at each
/// singularity.
pub fn singularities_document(
    description: &Description,
    found: &Singularities,
    language: Tongue,
) -> Vec<Block> {
    let words = language.words();
    let mut blocks = vec![Block::Heading(1, Line::new(words.jacobian_title(&description.name)))];
    let in_base = in_base(description, &found.jacobian, words);
    if !in_base.is_empty() {
        blocks.extend(in_base);
        blocks.push(Block::Heading(2, Line::new(words.shortest_title())));
    }
    blocks.extend(matrix(&found.jacobian, words));
    blocks.push(paragraph(words.shortest()));
    blocks.push(Block::Heading(2, Line::new(words.determinant_title())));
    blocks.extend(determinants(found, &Factor::named("J"), words));
    blocks.push(Block::Heading(2, Line::new(words.singularities_title())));
    blocks.extend(places(description, found, words));
    if let Some(point) = found.of_its_point(description) {
        blocks.extend(point_document(description, &point, words));
    }
    blocks.extend(rates(found, words));
    blocks
}

/// Longer entries, in symbols and numbers, nobody reads; `jacobian --symbolic --frame base` gives them.
const MAX_READ: u64 = 40;

/// The matrix that most books have, of the body at its own origin along the axes of the base, if that is not the shortest and its
/// entries are ones that people read.
fn in_base(description: &Description, shortest: &JacobianModel, words: &dyn Wording) -> Vec<Block> {
    let body = shortest.view.body;
    let view = Viewpoint::of(body, Reference::Base);
    let is_same = shortest.view.axes == view.axes && shortest.view.at == view.at;
    let model = JacobianModel::derive(description, view);
    let is_read = |matrix: &Jacobian<Expr>| matrix.rows().iter().flatten().all(|&e| literals(e) <= MAX_READ);
    match model.matrix {
        Ok(matrix) if !is_same && is_read(&matrix) => vec![
            Block::Paragraph(words.viewpoint(view.body, view.at, None, view.axes)),
            Block::Formula {
                math: Math::Matrix(Factor::named("J"), matrix.rows().to_vec()),
                number: None,
                proof: (model.proof == Forward::Proved).then_some(Proof::Proved),
            },
        ],
        _ => vec![],
    }
}

/// The linear rows of a Jacobian.
fn of_point() -> Factor {
    Factor::Indexed("J", 'v')
}

/// The linear rows, their determinant, and where they are singular: that of the point at the body's origin, its orientation
/// left aside.
fn point_document(description: &Description, found: &Singularities, words: &dyn Wording) -> Vec<Block> {
    let view = &found.jacobian.view;
    let mut blocks = vec![
        Block::Heading(2, Line::new(words.point_title())),
        Block::Paragraph(words.point_alone(view.at, view.axes)),
    ];
    if let Ok(matrix) = &found.jacobian.matrix {
        blocks.push(Block::Formula {
            math: Math::Matrix(of_point(), matrix.rows().into_iter().take(3).collect()),
            number: None,
            proof: (found.jacobian.proof == Forward::Proved).then_some(Proof::Proved),
        });
    }
    blocks.extend(determinants(found, &of_point(), words));
    blocks.extend(places(description, found, words));
    blocks
}

/// The singularities, each under a heading of its own.
fn places(description: &Description, found: &Singularities, words: &dyn Wording) -> Vec<Block> {
    let assumes = description.parameters.iter().any(|p| p.value.is_none());
    let mut blocks = vec![];
    if found.common.is_empty() {
        blocks.push(paragraph(words.no_singularity(found.is_complete, found.minors.len() > 1)));
    }
    for (k, s) in found.common.iter().enumerate() {
        blocks.push(Block::Heading(3, Line::new(format!("{}. ", k + 1)).math(vanishing(s.factor))));
        blocks.push(Block::List(remarks(&found.jacobian.view, s, assumes, words)));
    }
    match &found.others {
        Some(sets) if !sets.is_empty() => {
            blocks.push(paragraph(words.besides_where()));
            let line = |set: &Vec<Expr>| Line::default().list(set.iter().map(|&f| vanishing(f)));
            blocks.push(Block::List(sets.iter().map(line).collect()));
        }
        Some(_) => {}
        None => blocks.push(paragraph(words.besides())),
    }
    blocks
}

/// The matrix, why the singularities are not had as formulas, and those that were found in numbers, or which values are
/// missing for that.
pub fn found_singularities_document(
    description: &Description,
    model: &JacobianModel,
    why: &Obstacle,
    found: Result<&[Example], &MissingValue>,
    language: Tongue,
) -> Vec<Block> {
    let words = language.words();
    let mut blocks = jacobian_document(description, model, language);
    blocks.push(Block::Heading(2, Line::new(words.singularities_title())));
    blocks.push(paragraph(sentence(&words.unknown_singularities(why))));
    if !matches!(why, Obstacle::AlwaysSingular(_)) {
        let missing =
            |m: &MissingValue| m.parameters.iter().map(|name| Math::Expr(Expr::symbol(name))).collect();
        blocks.push(match found {
            Ok(found) => paragraph(words.found_singularities(found.len())),
            Err(why) => Block::Paragraph(words.values_missing(missing(why))),
        });
    }
    for (k, example) in found.unwrap_or_default().iter().enumerate() {
        let mut place = Line::new(format!("{}. ", k + 1));
        for (j, (v, x)) in description.variables().iter().zip(&example.q).enumerate() {
            place = place.text(if j > 0 { words.between() } else { "" }).math(Expr::from(v.symbol));
            place = place.text(format!(" = {}", words.written(reading(*x, v.kind))));
        }
        blocks.push(Block::Heading(3, place));
        let mut lines = happens(&model.view, example, words);
        if let [free] = &example.free[..] {
            lines.push(words.motion(rates_of(description, free)));
        }
        blocks.push(Block::List(lines));
    }
    blocks
}

/// Velocities of joints, rounded to what is worth reading.
fn rates_of(description: &Description, free: &[f64]) -> Vec<Math> {
    let rate = |(v, x): (&Variable, &f64)| {
        let name = Expr::symbol(&format!("d{}", v.symbol.name()));
        Math::equation(name, Expr::from(Rational::new((x * ROUNDED).round() as i64, ROUNDED as i64)))
    };
    description.variables().iter().zip(free).map(rate).collect()
}

/// Parts of the fastest joint's velocity that are told.
const ROUNDED: f64 = 1e4;

/// A capital before, a full stop behind.
fn sentence(words: &str) -> String {
    let mut letters = words.chars();
    let first = letters.next().map(|c| c.to_uppercase().to_string()).unwrap_or_default();
    format!("{first}{}.", letters.as_str())
}

fn paragraph(words: String) -> Block {
    Block::Paragraph(Line::new(words))
}

/// The joint velocities for a twist.
fn rates(found: &Singularities, words: &dyn Wording) -> Vec<Block> {
    let Some(rates) = &found.rates else { return vec![] };
    let mut blocks = vec![Block::Heading(2, Line::new(words.rates_title()))];
    blocks.push(paragraph(words.rates(rates.blocks)));
    for (name, value) in &rates.steps {
        let math = Math::equation(Expr::symbol(name), *value);
        blocks.push(Block::Formula { math, number: None, proof: rates.is_proved.then_some(Proof::Proved) });
    }
    let different = rates.conditions.iter().map(|&c| Math::relation(c, Sign::Different, Expr::int(0)));
    if !rates.conditions.is_empty() {
        blocks.push(Block::List(vec![words.different(different.collect())]));
    }
    blocks
}

fn vanishing(factor: Expr) -> Math {
    Math::equation(factor, Expr::int(0))
}

fn matrix(model: &JacobianModel, words: &dyn Wording) -> Vec<Block> {
    let view = &model.view;
    let is_apart = view.offset.0.iter().any(|e| !e.is_zero());
    let offset = is_apart.then(|| view.offset.0.map(Math::Expr));
    let place = words.viewpoint(view.body, view.at, offset, view.axes);
    let formula = match &model.matrix {
        Ok(matrix) => Block::Formula {
            math: Math::Matrix(Factor::named("J"), matrix.rows().to_vec()),
            number: None,
            proof: (model.proof == Forward::Proved).then_some(Proof::Proved),
        },
        Err(why) => paragraph(words.no_entries(*why)),
    };
    let cost = words.jacobian_cost(&model.algorithm.count(), model.proof);
    vec![Block::Paragraph(place), formula, paragraph(cost)]
}

/// The determinants of the largest square parts of this matrix; which part it is, unless it is the matrix itself.
fn determinants(found: &Singularities, matrix: &Factor, words: &dyn Wording) -> Vec<Block> {
    let formula = |m: &Minor| Block::Formula {
        math: Math::Determinant(matrix.clone(), m.determinant.to_expr()),
        number: None,
        proof: Some(Proof::Proved),
    };
    let of_joints = |m: &Minor| m.rows.len() == found.rows.len();
    let part = |m: &Minor| {
        let rows: Vec<&str> = m.rows.iter().map(|&r| ROWS[r]).collect();
        if found.deficient.is_some() {
            return paragraph(words.minor_of_both(&rows, &m.joints));
        }
        paragraph(match of_joints(m) {
            true => words.minor_of_joints(&m.joints),
            false => words.minor_of_rows(&rows),
        })
    };
    if let ([whole], None) = (&found.minors[..], found.deficient) {
        // Joints that do not move the body are in no part.
        let shown = if of_joints(whole) { None } else { Some(part(whole)) };
        return shown.into_iter().chain([formula(whole)]).collect();
    }
    let has_surplus = found.minors.first().is_some_and(of_joints);
    let why = match found.deficient {
        Some(rank) => words.always_singular(rank, found.rows.len() == 3),
        None => words.several_determinants(has_surplus, found.rows.len()),
    };
    let mut blocks = vec![paragraph(why)];
    for m in &found.minors {
        blocks.push(part(m));
        blocks.push(formula(m));
    }
    blocks
}

/// Where, why, what is lost, what comes free.
fn remarks(view: &Viewpoint<Expr>, s: &Singularity, assumes: bool, words: &dyn Wording) -> Vec<Line> {
    let mut lines = vec![];
    if let Some(zero) = s.zeros.first() {
        let (unknown, values) = zero.solved();
        lines.push(words.zeros(values.into_iter().map(|x| Math::equation(unknown, x)).collect()));
    }
    let Some(example) = &s.example else {
        lines.push(Line::new(words.no_example(assumes)));
        return lines;
    };
    lines.extend(happens(view, example, words));
    lines
}

/// How the axes lie, what is lost, what comes free.
fn happens(view: &Viewpoint<Expr>, example: &Example, words: &dyn Wording) -> Vec<Line> {
    let mut lines = vec![Line::default().strong(words.place(&example.place))];
    if example.place != Place::Differs {
        lines.extend(loss(view, example).map(|loss| Line::new(words.lost(loss))));
        lines.extend(gain(example).map(|gain| Line::new(words.gained(&gain))));
    }
    lines
}

/// What is lost, where it is lost along or about one axis everywhere on the singularity.
fn loss(view: &Viewpoint<Expr>, example: &Example) -> Option<Loss> {
    let [w] = &example.lost[..] else { return None };
    let parts: Vec<usize> = (0..6).filter(|&k| w[k] != 0.0).collect();
    Some(match parts[..] {
        [k] if k < 3 => Loss::VelocityAlong(['x', 'y', 'z'][k], view.axes),
        [k] => Loss::RotationAbout(['x', 'y', 'z'][k - 3], view.axes),
        _ if parts.iter().all(|&k| k < 3) => Loss::Velocity,
        _ if parts.iter().all(|&k| k >= 3) => Loss::Rotation,
        _ => Loss::Screw,
    })
}

fn gain(example: &Example) -> Option<Gain> {
    let [free] = &example.free[..] else { return None };
    let moving: Vec<usize> = (0..free.len()).filter(|&j| free[j] != 0.0).collect();
    Some(match (&example.place, &moving[..]) {
        (Place::OneLine(..), &[i, j]) => Gain::Turns { joints: [i, j], is_same: free[i] * free[j] >= 0.0 },
        _ => Gain::Moves(moving, example.still),
    })
}
