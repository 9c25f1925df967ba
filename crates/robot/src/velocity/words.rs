//! The Jacobian and its singularities in words and formulas.

use super::geometric::{ROWS, Viewpoint};
use super::model::JacobianModel;
use super::singular::{Example, Minor, Place, Singularities, Singularity};
use crate::description::Description;
use crate::explain::{Block, Factor, Line, Math, Proof, Sign};
use crate::forward::{Proof as Forward, Reference};
use denavit_symbolic::Expr;
use denavit_symbolic::factor::Zero;

/// The matrix, with its place and what it costs.
pub fn jacobian_document(description: &Description, model: &JacobianModel) -> Vec<Block> {
    let mut blocks = vec![Block::Heading(1, Line::new(format!("Jacobian of the {}", description.name)))];
    blocks.extend(matrix(model));
    blocks
}

/// The matrix where it is shortest, its determinant in factors, and what happens at each singularity.
pub fn singularities_document(description: &Description, found: &Singularities) -> Vec<Block> {
    let mut blocks = jacobian_document(description, &found.jacobian);
    blocks.push(Block::Paragraph(Line::new(
        "In this frame and at this point the matrix is shortest. The twist along other axes, and at another point of the \
         same body, follows by a rotation and a lever arm, which leave the determinant as it is.",
    )));
    blocks.push(Block::Heading(2, Line::new("Determinant")));
    blocks.extend(determinants(found));
    blocks.push(Block::Heading(2, Line::new("Singularities")));
    if found.common.is_empty() {
        blocks.push(Block::Paragraph(Line::new(if found.is_complete {
            "There are none: a determinant is never 0."
        } else {
            "No factor that depends on the joints is shared by all of the determinants."
        })));
    }
    for (k, s) in found.common.iter().enumerate() {
        blocks.push(Block::Heading(3, Line::new(format!("{}. ", k + 1)).math(vanishing(s.factor))));
        blocks.push(Block::List(remarks(&found.jacobian.view, s)));
    }
    if !found.is_complete {
        blocks.push(Block::Paragraph(Line::new(
            "Besides, the arm is singular where all of the determinants above are 0 at once.",
        )));
    }
    blocks.extend(rates(found));
    blocks
}

/// The joint velocities for a twist.
fn rates(found: &Singularities) -> Vec<Block> {
    let Some(rates) = &found.rates else { return vec![] };
    let mut blocks = vec![Block::Heading(2, Line::new("Joint velocities for a twist"))];
    let text = match rates.steps.len() {
        3 => "The linear rows give the velocities of the three joints.",
        _ => {
            "The last three joints do not move the point: the linear rows give the velocities of the first three joints. rx, ry \
             and rz are what these leave of the angular velocity for the others."
        }
    };
    blocks.push(Block::Paragraph(Line::new(text)));
    for (name, value) in &rates.steps {
        let math = Math::equation(Expr::symbol(name), *value);
        blocks.push(Block::Formula { math, number: None, proof: rates.is_proved.then_some(Proof::Proved) });
    }
    let different = rates.conditions.iter().map(|&c| Math::relation(c, Sign::Different, Expr::int(0)));
    if !rates.conditions.is_empty() {
        blocks.push(Block::List(vec![Line::new("where ").list(different)]));
    }
    blocks
}

fn vanishing(factor: Expr) -> Math {
    Math::equation(factor, Expr::int(0))
}

/// A frame in words.
fn named(frame: Reference) -> String {
    match frame {
        Reference::Base => "the base".into(),
        Reference::Tool => "the tool".into(),
        Reference::Frame(i) => format!("frame {i}"),
    }
}

fn matrix(model: &JacobianModel) -> Vec<Block> {
    let view = &model.view;
    let mut place = Line::new(format!(
        "Linear rows first: the velocity of the point of {} at the origin of {}",
        named(view.body),
        named(view.at)
    ));
    if view.offset.0.iter().any(|e| !e.is_zero()) {
        place = place.text(" plus (").list(view.offset.0.map(Math::Expr)).text(")");
    }
    let place = place.text(format!(", then its angular velocity, along the axes of {}.", named(view.axes)));
    let formula = match &model.matrix {
        Ok(matrix) => Block::Formula {
            math: Math::Matrix(Factor::named("J"), matrix.rows().to_vec()),
            number: None,
            proof: (model.proof == Forward::Proved).then_some(Proof::Proved),
        },
        Err(why) => Block::Paragraph(Line::new(format!("The entries are not expanded: {why}."))),
    };
    let proof = match model.proof {
        Forward::Proved => "proved equal to the derivative of the product of the link transforms".to_string(),
        Forward::Undecided(why) => format!("not proved: {why}"),
        Forward::Failed => "not proved: the canonical forms differ".into(),
    };
    let cost = Line::new(format!("{}; {proof}.", model.algorithm.count()));
    vec![Block::Paragraph(place), formula, Block::Paragraph(cost)]
}

fn determinants(found: &Singularities) -> Vec<Block> {
    let mut blocks = vec![];
    let is_whole = |_: &Minor| found.minors.len() == 1;
    if !found.minors.iter().any(is_whole) {
        let text = match found.minors.first() {
            Some(m) if m.rows.len() == 6 => {
                "There are more joints than directions: the arm is singular where the determinants with all choices of six \
                 joints are 0."
            }
            _ => {
                "There are fewer joints than directions: the arm is singular where the determinants of all choices of rows \
                 are 0. Those that are 0 everywhere are left out."
            }
        };
        blocks.push(Block::Paragraph(Line::new(text)));
    }
    for m in &found.minors {
        let formula = |factor| Block::Formula {
            math: Math::Determinant(factor, m.determinant.to_expr()),
            number: None,
            proof: Some(Proof::Proved),
        };
        if is_whole(m) {
            blocks.push(formula(Factor::named("J")));
            continue;
        }
        let parts = if m.rows.len() == 6 {
            let joints: Vec<String> = m.joints.iter().map(|j| (j + 1).to_string()).collect();
            format!("Joints {}:", joints.join(", "))
        } else {
            let rows: Vec<&str> = m.rows.iter().map(|&r| ROWS[r]).collect();
            format!("Rows {}:", rows.join(", "))
        };
        blocks.push(Block::Paragraph(Line::new(parts)));
        blocks.push(formula(Factor::named("J")));
    }
    blocks
}

/// Where, why, what is lost, what comes free.
fn remarks(view: &Viewpoint<Expr>, s: &Singularity) -> Vec<Line> {
    let mut lines = vec![];
    if let Some(zero) = s.zeros.first() {
        lines.push(solved(zero));
    }
    let Some(example) = &s.example else {
        lines.push(Line::new("no configuration was found where this factor alone is 0"));
        return lines;
    };
    lines.push(Line::default().strong(example.place.to_string()));
    lines.extend(lost(view, example));
    lines.extend(gained(example));
    lines
}

fn solved(zero: &Zero) -> Line {
    let mut line = Line::new("where ");
    for (k, value) in zero.values().into_iter().enumerate() {
        if k > 0 {
            line = line.text(" or ");
        }
        line = line.math(Math::equation(zero.angle(), value));
    }
    line
}

/// What is lost, where it is lost along or about one axis everywhere on the singularity.
fn lost(view: &Viewpoint<Expr>, example: &Example) -> Option<Line> {
    let [w] = &example.lost[..] else { return None };
    let parts: Vec<usize> = (0..6).filter(|&k| w[k] != 0.0).collect();
    let text = match parts[..] {
        [k] => {
            let what = if k < 3 { "velocity along" } else { "rotation about" };
            format!("lost: {what} the {} axis of {}", ["x", "y", "z"][k % 3], named(view.axes))
        }
        _ if parts.iter().all(|&k| k < 3) => "lost: a velocity of the point, in one direction".into(),
        _ if parts.iter().all(|&k| k >= 3) => "lost: a rotation, about one direction".into(),
        _ => "lost: a screw, a velocity and a rotation together".into(),
    };
    Some(Line::new(text))
}

fn gained(example: &Example) -> Option<Line> {
    let [free] = &example.free[..] else { return None };
    let moving: Vec<usize> = (0..free.len()).filter(|&j| free[j] != 0.0).collect();
    let text = match (&example.place, &moving[..]) {
        (Place::OneLine(..), [i, j]) => {
            let way = if free[*i] * free[*j] < 0.0 { "against each other" } else { "together" };
            format!("gained: joints {} and {} turn {way} while the body stands still", i + 1, j + 1)
        }
        _ => {
            let names: Vec<String> = moving.iter().map(|j| (j + 1).to_string()).collect();
            let verb = if let [_] = names[..] { "joint {} moves" } else { "joints {} move" };
            format!("gained: {} at first with the body at rest", verb.replace("{}", &names.join(", ")))
        }
    };
    Some(Line::new(text))
}
