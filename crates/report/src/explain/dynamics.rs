//! The dynamic model: base parameters, torques, inertia.

use crate::document::{Block, Factor, Line, Math, Proof};
use crate::words::{Tongue, Wording};
use denavit::description::{Convention, Description, JointKind, Mechanism, Row, RowTree};
use denavit::dynamics::{DynamicModel, Fate, Ground, Recursion, given};
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Expr, Symbol};

/// The robot's names, those of masses, base parameters and rates, and those of the program's steps.
pub fn dynamics_vocabulary(d: &Description, model: &DynamicModel) -> Vocabulary {
    with_names(d.vocabulary(), model)
}

/// The names of a whole tree's model, whose joints move so.
pub fn tree_dynamics_vocabulary(m: &Mechanism, model: &DynamicModel) -> Vocabulary {
    let joints = (1..).zip(model.formulas.q.iter().zip(m.variables()));
    let names = joints.fold(Vocabulary::new(), |v, (number, (&s, j))| match m.joints[j].kind {
        Some(JointKind::Prismatic) => v.sliding(number, s),
        Some(JointKind::Revolute) | None => v.angle(number, s),
    });
    with_names(names, model)
}

fn with_names(names: Vocabulary, model: &DynamicModel) -> Vocabulary {
    let formulas = &model.formulas;
    let own = formulas.parameters.iter().map(|p| p.symbol);
    let base = model.base.parameters.iter().map(|p| p.symbol);
    let all = own.chain(base).chain(formulas.qd.iter().chain(&formulas.qdd).copied());
    let names = all.fold(names, |v, s| v.symbol(&s.name()));
    model.torques.steps().into_iter().fold(names, |v, step| v.symbol(&step.name))
}

/// Base parameters, the torques as a program, and the parts of the torques where they are written out.
pub fn dynamics_document(d: &Description, model: &DynamicModel, language: Tongue) -> Vec<Block> {
    let words = language.words();
    let mut blocks = vec![
        Block::Heading(1, Line::new(words.dynamics_title(&d.name))),
        paragraph(words.link_parameters(d.convention == Convention::Standard)),
        Block::Paragraph(words.gravity_is(model.formulas.dynamics.gravity.0.map(Math::Expr))),
        Block::Heading(2, Line::new(words.base_title())),
    ];
    blocks.extend(base(model, words));
    blocks.extend(torques(model, words));
    blocks.extend(parts(d, model, words));
    blocks
}

/// The names of the model of a tree of rows.
pub fn rows_dynamics_vocabulary(tree: &RowTree, model: &DynamicModel) -> Vocabulary {
    with_names(tree.all_rows().vocabulary(), model)
}

/// The same of a whole tree, of this name and with joints of these: its links, base parameters, the torques as a program.
pub fn tree_dynamics_document(
    name: &str,
    joints: &[String],
    model: &DynamicModel,
    language: Tongue,
) -> Vec<Block> {
    let words = language.words();
    let arm = &model.formulas.dynamics;
    let links =
        arm.links.iter().enumerate().map(|(k, link)| {
            Line::new(words.link_of_tree(k + 1, &joints[link.row], link.parent.map(|p| p + 1)))
        });
    let mut blocks = vec![
        Block::Heading(1, Line::new(words.dynamics_title(name))),
        Block::List(links.collect()),
        paragraph(words.link_parameters(false)),
        Block::Paragraph(words.gravity_is(arm.gravity.0.map(Math::Expr))),
        Block::Heading(2, Line::new(words.base_title())),
    ];
    blocks.extend(base(model, words));
    blocks.extend(torques(model, words));
    blocks
}

/// The derivation: bodies, groupings, the recursion outward and inward, and the short program, with what each rests on.
pub fn dynamics_explanation(
    d: &Description,
    model: &DynamicModel,
    recursion: &Recursion,
    language: Tongue,
) -> Vec<Block> {
    let words = language.words();
    let arm = &model.formulas.dynamics;
    let title = |title: String| Block::Heading(2, Line::new(title));
    let mut blocks = vec![
        Block::Heading(1, Line::new(words.dynamics_title(&d.name))),
        title(words.bodies_title()),
        paragraph(words.bodies()),
    ];
    for o in &recursion.outward {
        let frame = Factor::Frame { from: o.link.to_string(), to: (o.link + 1).to_string() };
        let rows = o.place.matrix().iter().map(|row| row.to_vec()).collect();
        blocks.push(Block::Formula { math: Math::Matrix(frame, rows), number: None, proof: None });
    }
    blocks.push(paragraph(words.link_parameters(d.convention == Convention::Standard)));
    blocks.push(Block::Paragraph(words.gravity_is(arm.gravity.0.map(Math::Expr))));
    blocks.push(title(words.base_title()));
    blocks.push(paragraph(words.grouping()));
    let gifts = given(arm).into_iter().enumerate().rev();
    let given = gifts.map(|(k, gives)| Line::new(words.gives(k + 1, gives)));
    blocks.push(Block::List(given.collect()));
    blocks.extend(base(model, words));
    blocks.push(title(words.outward_title()));
    blocks.push(paragraph(words.outward()));
    for o in &recursion.outward {
        blocks.push(Block::Heading(3, Line::new(words.link(o.link + 1))));
        for &(name, value) in &o.steps {
            // U is made of the others.
            let proof = (!name.name().starts_with('U')).then_some(mark(o.ground));
            blocks.push(Block::Formula { math: Math::equation(name.into(), value), number: None, proof });
        }
        blocks.push(paragraph(words.motion_ground(o.ground)));
    }
    blocks.push(title(words.inward_title()));
    blocks.push(paragraph(words.inward()));
    for i in &recursion.inward {
        blocks.push(Block::Heading(3, Line::new(words.link(i.link + 1))));
        blocks.extend(i.steps.iter().map(|&(name, value)| formula(name.into(), value)));
    }
    blocks.push(title(words.torques_title()));
    for &(name, value) in &recursion.torques {
        let math = Math::equation(name.into(), value);
        blocks.push(Block::Formula { math, number: None, proof: Some(mark(recursion.ground)) });
    }
    blocks.push(paragraph(words.recursion_cost(&model.base.inverse.count(), recursion.ground)));
    blocks.push(title(words.short_title()));
    blocks.push(paragraph(words.short()));
    blocks.extend(told(model, words));
    blocks.extend(parts(d, model, words));
    blocks
}

/// The names of [`dynamics_vocabulary`], and those of the recursion.
pub fn recursion_vocabulary(d: &Description, model: &DynamicModel, recursion: &Recursion) -> Vocabulary {
    recursion.names().fold(dynamics_vocabulary(d, model), |v, s| v.symbol(&s.name()))
}

/// The mark of what rests on that.
fn mark(ground: Ground) -> Proof {
    match ground {
        Ground::Proved => Proof::Proved,
        Ground::Modulo(_) | Ground::Numbers(..) => Proof::Sampled,
        Ground::Failed => Proof::Wrong,
    }
}

/// The program of the torques.
fn torques(model: &DynamicModel, words: &dyn Wording) -> Vec<Block> {
    let mut blocks = vec![Block::Heading(2, Line::new(words.torques_title()))];
    for step in model.torques.steps() {
        blocks.push(formula(Expr::symbol(&step.name), step.value));
    }
    blocks.extend(told(model, words));
    blocks
}

/// What the program of the torques costs and rests on, and by what it divides.
fn told(model: &DynamicModel, words: &dyn Wording) -> Vec<Block> {
    let mut blocks = vec![paragraph(words.torques_cost(&model.torques.count(), model.ground))];
    let divisors = model.divisors();
    if !divisors.is_empty() {
        blocks.push(Block::Paragraph(words.divides_by(divisors.into_iter().map(Math::Expr).collect())));
    }
    blocks
}

/// The parts of the torques where they are written out.
fn parts(d: &Description, model: &DynamicModel, words: &dyn Wording) -> Vec<Block> {
    let mut blocks = vec![];
    let has = |pick: fn(&Row) -> &Option<Expr>| d.rows.iter().filter_map(|r| *pick(r)).any(|e| !e.is_zero());
    if let Some(parts) = &model.parts {
        let proof = (parts.ground == Ground::Proved).then_some(Proof::Proved);
        let column = |all: &[Expr]| all.iter().map(|&e| vec![e]).collect();
        for (title, name, rows) in [
            (words.inertia_title(), "A", parts.inertia.clone()),
            (words.velocity_torques_title(), "h", column(&parts.velocity)),
            (words.gravity_torques_title(), "Q", column(&parts.gravity)),
        ] {
            blocks.push(Block::Heading(2, Line::new(title)));
            blocks.push(Block::Formula {
                math: Math::Matrix(Factor::named(name), rows),
                number: None,
                proof,
            });
            if name == "h" && (has(|r| &r.viscous) || has(|r| &r.coulomb)) {
                blocks.push(paragraph(words.with_friction()));
            }
        }
    }
    blocks
}

fn base(model: &DynamicModel, words: &dyn Wording) -> Vec<Block> {
    let base = &model.base;
    let mut blocks =
        vec![paragraph(words.base_count(base.fates.len(), base.parameters.len(), base.minimality))];
    let symbols = |all: &[Symbol]| all.iter().map(|&s| Math::Expr(s.into())).collect::<Vec<_>>();
    if !base.asked.kept.is_empty() {
        blocks.push(Block::Paragraph(words.kept(symbols(&base.asked.kept))));
    }
    if !base.asked.dropped.is_empty() {
        blocks.push(Block::Paragraph(words.dropped(symbols(&base.asked.dropped))));
    }
    for p in base.parameters.iter().filter(|p| p.is_grouped) {
        blocks.push(formula(p.symbol.into(), p.value));
    }
    let alone: Vec<Math> =
        base.parameters.iter().filter(|p| !p.is_grouped).map(|p| Math::Expr(p.symbol.into())).collect();
    let idle: Vec<Math> =
        base.fates.iter().filter(|f| f.1 == Fate::WithoutEffect).map(|f| Math::Expr(f.0.into())).collect();
    let mut lines = vec![];
    if !alone.is_empty() {
        lines.push(words.base_alone(alone));
    }
    if !idle.is_empty() {
        lines.push(words.without_effect(idle));
    }
    blocks.push(Block::List(lines));
    blocks
}

fn formula(name: Expr, value: Expr) -> Block {
    Block::Formula { math: Math::equation(name, value), number: None, proof: None }
}

fn paragraph(words: String) -> Block {
    Block::Paragraph(Line::new(words))
}
