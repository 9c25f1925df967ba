//! The Jacobian and its singularities in words and formulas, in each language.

use super::geometric::{ROWS, Viewpoint};
use super::inverse::REST;
use super::model::JacobianModel;
use super::singular::{Example, Minor, Place, Singularities, Singularity};
use crate::description::Description;
use crate::explain::{Block, Factor, Language, Line, Math, Proof, Sign, count, refusal};
use crate::forward::Proof as Forward;
use denavit_symbolic::Expr;
use denavit_symbolic::factor::Zero;
use denavit_symbolic::vocabulary::Vocabulary;

/// The robot's names and those of velocities: `dq1`, `vx`, and where a point is apart.
pub fn velocity_vocabulary(description: &Description) -> Vocabulary {
    let rates = description.variables().into_iter().map(|v| format!("d{}", v.symbol.name()));
    let twist = ROWS.iter().chain(&REST).map(ToString::to_string);
    rates.chain(twist).fold(description.vocabulary(), |v, name| v.symbol(&name))
}

/// The matrix, with its place and what it costs.
pub fn jacobian_document(description: &Description, model: &JacobianModel, language: Language) -> Vec<Block> {
    let name = &description.name;
    let title = language.pick(format!("Jacobian of the {name}"), format!("Jacobienne : {name}"));
    let mut blocks = vec![Block::Heading(1, Line::new(title))];
    blocks.extend(matrix(model, language));
    language.set(blocks)
}

/// The matrix where it is shortest, its determinant in factors, and what happens at each singularity.
pub fn singularities_document(
    description: &Description,
    found: &Singularities,
    language: Language,
) -> Vec<Block> {
    let said = |english: &str, french: &str| Line::new(language.pick(english, french));
    let mut blocks = jacobian_document(description, &found.jacobian, language);
    blocks.push(Block::Paragraph(said(
        "In this frame and at this point the matrix is shortest. The twist along other axes, and at another point of the \
         same body, follows by a rotation and a lever arm, which leave the determinant as it is.",
        "C'est dans ce repère et en ce point que la matrice est la plus courte. Le torseur cinématique suivant d'autres \
         axes, ou en un autre point du même corps, s'en déduit par une rotation et un bras de levier, qui laissent le \
         déterminant inchangé.",
    )));
    blocks.push(Block::Heading(2, said("Determinant", "Déterminant")));
    blocks.extend(determinants(found, language));
    blocks.push(Block::Heading(2, said("Singularities", "Singularités")));
    if found.common.is_empty() {
        blocks.push(Block::Paragraph(match found.is_complete {
            true => said(
                "There are none: a determinant is never 0.",
                "Il n'y en a pas : un déterminant ne s'annule jamais.",
            ),
            false => said(
                "No factor that depends on the joints is shared by all of the determinants.",
                "Aucun facteur dépendant des articulations n'est commun à tous les déterminants.",
            ),
        }));
    }
    for (k, s) in found.common.iter().enumerate() {
        blocks.push(Block::Heading(3, Line::new(format!("{}. ", k + 1)).math(vanishing(s.factor))));
        blocks.push(Block::List(remarks(&found.jacobian.view, s, language)));
    }
    if !found.is_complete {
        blocks.push(Block::Paragraph(said(
            "Besides, the arm is singular where all of the determinants above are 0 at once.",
            "De plus, le bras est singulier là où tous les déterminants ci-dessus s'annulent à la fois.",
        )));
    }
    blocks.extend(rates(found, language));
    language.set(blocks)
}

/// The joint velocities for a twist.
fn rates(found: &Singularities, language: Language) -> Vec<Block> {
    let Some(rates) = &found.rates else { return vec![] };
    let said = |english: &str, french: &str| Line::new(language.pick(english, french));
    let title =
        said("Joint velocities for a twist", "Vitesses articulaires pour un torseur cinématique donné");
    let mut blocks = vec![Block::Heading(2, title)];
    blocks.push(Block::Paragraph(match rates.steps.len() {
        3 => said(
            "The linear rows give the velocities of the three joints.",
            "Les lignes de la vitesse linéaire donnent les vitesses des trois articulations.",
        ),
        _ => said(
            "The last three joints do not move the point: the linear rows give the velocities of the first three joints. rx, ry \
             and rz are what these leave of the angular velocity for the others.",
            "Les trois dernières articulations ne déplacent pas le point : les lignes de la vitesse linéaire donnent les vitesses \
             des trois premières. rx, ry et rz sont ce que celles-ci laissent de la vitesse angulaire aux autres.",
        ),
    }));
    for (name, value) in &rates.steps {
        let math = Math::equation(Expr::symbol(name), *value);
        blocks.push(Block::Formula { math, number: None, proof: rates.is_proved.then_some(Proof::Proved) });
    }
    let different = rates.conditions.iter().map(|&c| Math::relation(c, Sign::Different, Expr::int(0)));
    if !rates.conditions.is_empty() {
        blocks.push(Block::List(vec![said("where ", "pour ").list(different)]));
    }
    blocks
}

fn vanishing(factor: Expr) -> Math {
    Math::equation(factor, Expr::int(0))
}

fn matrix(model: &JacobianModel, language: Language) -> Vec<Block> {
    let view = &model.view;
    let [body, at, axes] = [view.body, view.at, view.axes].map(|frame| frame.of(language));
    let mut place = Line::new(language.pick(
        format!("Linear rows first: the velocity of the point {body} at the origin {at}"),
        format!("D'abord les lignes de la vitesse linéaire, celle du point {body} situé à l'origine {at}"),
    ));
    if view.offset.0.iter().any(|e| !e.is_zero()) {
        place = place.text(language.pick(" plus (", " décalée de ("));
        place = place.list(view.offset.0.map(Math::Expr)).text(")");
    }
    let place = place.text(language.pick(
        format!(", then its angular velocity, along the axes {axes}."),
        format!(", puis celles de la vitesse angulaire, suivant les axes {axes}."),
    ));
    let formula = match &model.matrix {
        Ok(matrix) => Block::Formula {
            math: Math::Matrix(Factor::named("J"), matrix.rows().to_vec()),
            number: None,
            proof: (model.proof == Forward::Proved).then_some(Proof::Proved),
        },
        Err(why) => {
            let why = refusal(*why, language);
            Block::Paragraph(Line::new(language.pick(
                format!("The entries are not expanded: {why}."),
                format!("Les éléments ne sont pas développés : {why}."),
            )))
        }
    };
    let (count, proof) = (count(&model.algorithm.count(), language), model.proof.of_jacobian(language));
    let cost = Line::new(language.pick(format!("{count}; {proof}."), format!("{count} ; {proof}.")));
    vec![Block::Paragraph(place), formula, Block::Paragraph(cost)]
}

fn determinants(found: &Singularities, language: Language) -> Vec<Block> {
    let mut blocks = vec![];
    let is_whole = |_: &Minor| found.minors.len() == 1;
    if !found.minors.iter().any(is_whole) {
        let text = match found.minors.first() {
            Some(m) if m.rows.len() == 6 => language.pick(
                "There are more joints than directions: the arm is singular where the determinants with all choices of six \
                 joints are 0.",
                "Il y a plus d'articulations que de directions : le bras est singulier là où les déterminants de tous les \
                 choix de six articulations sont nuls.",
            ),
            _ => language.pick(
                "There are fewer joints than directions: the arm is singular where the determinants of all choices of rows \
                 are 0. Those that are 0 everywhere are left out.",
                "Il y a moins d'articulations que de directions : le bras est singulier là où les déterminants de tous les \
                 choix de lignes sont nuls. Ceux qui sont nuls partout sont omis.",
            ),
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
            let joints = joints.join(", ");
            language.pick(format!("Joints {joints}:"), format!("Articulations {joints} :"))
        } else {
            let rows: Vec<&str> = m.rows.iter().map(|&r| ROWS[r]).collect();
            let rows = rows.join(", ");
            language.pick(format!("Rows {rows}:"), format!("Lignes {rows} :"))
        };
        blocks.push(Block::Paragraph(Line::new(parts)));
        blocks.push(formula(Factor::named("J")));
    }
    blocks
}

/// Where, why, what is lost, what comes free.
fn remarks(view: &Viewpoint<Expr>, s: &Singularity, language: Language) -> Vec<Line> {
    let mut lines = vec![];
    if let Some(zero) = s.zeros.first() {
        lines.push(solved(zero, language));
    }
    let Some(example) = &s.example else {
        lines.push(Line::new(language.pick(
            "no configuration was found where this factor alone is 0",
            "aucune configuration n'a été trouvée où ce facteur s'annule seul",
        )));
        return lines;
    };
    lines.push(Line::default().strong(example.place.words(language)));
    lines.extend(lost(view, example, language));
    lines.extend(gained(example, language));
    lines
}

fn solved(zero: &Zero, language: Language) -> Line {
    let mut line = Line::new(language.pick("where ", "pour "));
    for (k, value) in zero.values().into_iter().enumerate() {
        if k > 0 {
            line = line.text(language.pick(" or ", " ou "));
        }
        line = line.math(Math::equation(zero.angle(), value));
    }
    line
}

/// What is lost, where it is lost along or about one axis everywhere on the singularity.
fn lost(view: &Viewpoint<Expr>, example: &Example, language: Language) -> Option<Line> {
    let [w] = &example.lost[..] else { return None };
    let parts: Vec<usize> = (0..6).filter(|&k| w[k] != 0.0).collect();
    let text = match parts[..] {
        [k] => {
            let what = if k < 3 {
                language.pick("velocity along", "la vitesse suivant")
            } else {
                language.pick("rotation about", "la rotation autour de")
            };
            let (axis, frame) = (["x", "y", "z"][k % 3], view.axes.of(language));
            language.pick(
                format!("lost: {what} the {axis} axis {frame}"),
                format!("perdue : {what} l'axe {axis} {frame}"),
            )
        }
        _ if parts.iter().all(|&k| k < 3) => language
            .pick(
                "lost: a velocity of the point, in one direction",
                "perdue : une vitesse du point, dans une direction",
            )
            .into(),
        _ if parts.iter().all(|&k| k >= 3) => language
            .pick("lost: a rotation, about one direction", "perdue : une rotation, autour d'une direction")
            .into(),
        _ => language
            .pick(
                "lost: a screw, a velocity and a rotation together",
                "perdu : un torseur cinématique (translation et rotation combinées)",
            )
            .into(),
    };
    Some(Line::new(text))
}

fn gained(example: &Example, language: Language) -> Option<Line> {
    let [free] = &example.free[..] else { return None };
    let moving: Vec<usize> = (0..free.len()).filter(|&j| free[j] != 0.0).collect();
    let text = match (&example.place, &moving[..]) {
        (Place::OneLine(..), [i, j]) => {
            let way = if free[*i] * free[*j] < 0.0 {
                language.pick("against each other", "en sens contraires")
            } else {
                language.pick("together", "dans le même sens")
            };
            let (i, j) = (i + 1, j + 1);
            language.pick(
                format!("gained: joints {i} and {j} turn {way} while the body stands still"),
                format!("gagné : les articulations {i} et {j} tournent {way}, le corps restant immobile"),
            )
        }
        _ => {
            let names: Vec<String> = moving.iter().map(|j| (j + 1).to_string()).collect();
            let all = names.join(", ");
            match names.len() {
                1 => language.pick(
                    format!("gained: joint {all} moves at first with the body at rest"),
                    format!(
                        "gagné : au premier ordre, l'articulation {all} bouge, le corps restant immobile"
                    ),
                ),
                _ => language.pick(
                    format!("gained: joints {all} move at first with the body at rest"),
                    format!(
                        "gagné : au premier ordre, les articulations {all} bougent, le corps restant immobile"
                    ),
                ),
            }
        }
    };
    Some(Line::new(text))
}
