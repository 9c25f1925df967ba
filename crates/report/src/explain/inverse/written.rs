//! An explanation as a document.

use super::Explanation;
use crate::document::{Block, Branch, Factor, Line, Math, Sign};
use crate::explained::{Explained, Statement};
use crate::words::{Coefficients, Given, Wording};
use denavit::inverse::Goal;
use denavit_symbolic::print::{Style, print};
use denavit_symbolic::readable::literals;
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Expr, Symbol};

/// Solutions beyond which the tree is not drawn.
const DRAWN: usize = 16;

/// Literals of coefficients that stand in a line of text.
const INLINE: u64 = 40;

/// The whole derivation.
pub fn document(e: &Explanation, words: &dyn Wording) -> Vec<Block> {
    let mut blocks = vec![title(e, words)];
    setting(e, words, &mut blocks);
    for (k, step) in e.steps.iter().enumerate() {
        explained(k + 1, step, words, &mut blocks);
    }
    if !e.joints.is_empty() && e.solutions.is_some() {
        blocks.push(Block::Heading(2, Line::new(words.other_joints())));
        blocks.extend(e.joints.iter().map(block));
    }
    ending(e, words, &mut blocks);
    blocks
}

/// The problem of the position behind that of the pose, under headings one level lower.
pub fn with_position(pose: &Explanation, position: &Explanation, words: &dyn Wording) -> Vec<Block> {
    let mut blocks = document(pose, words);
    blocks.extend(below(document(position, words), words));
    blocks
}

/// The same, formulas alone.
pub fn formulas_with_position(pose: &Explanation, position: &Explanation, words: &dyn Wording) -> Vec<Block> {
    let mut blocks = formulas(pose, words);
    blocks.extend(below(formulas(position, words), words));
    blocks
}

fn below(blocks: Vec<Block>, words: &dyn Wording) -> impl Iterator<Item = Block> {
    let title = Line::new(words.point_title());
    blocks.into_iter().map(move |block| match block {
        Block::Heading(1, _) => Block::Heading(2, title.clone()),
        Block::Heading(_, line) => Block::Heading(3, line),
        other => other,
    })
}

fn title(e: &Explanation, words: &dyn Wording) -> Block {
    Block::Heading(1, Line::new(words.inverse_title(&e.description.name)))
}

/// The formulas alone.
pub fn formulas(e: &Explanation, words: &dyn Wording) -> Vec<Block> {
    let mut blocks = vec![title(e, words)];
    setting(e, words, &mut blocks);
    for (k, step) in e.steps.iter().enumerate() {
        let mut line = Line::new(format!("{}. ", k + 1));
        line.0.extend(unknown(step).0);
        blocks.push(Block::Heading(3, line));
        blocks.extend(step.names.iter().map(block));
        if step.solution.iter().any(|s| uses_letters(s, step)) {
            blocks.extend(step.coefficients.iter().map(block));
        }
        blocks.extend(step.solution.iter().map(|s| block(&Statement { number: None, ..s.clone() })));
    }
    if !e.joints.is_empty() {
        blocks.push(Block::Heading(3, Line::new(words.other_joints())));
        blocks.extend(e.joints.iter().map(block));
    }
    let mut line = Line::default();
    for s in e.steps.iter().filter_map(|s| s.sign) {
        line = line.math(Math::relation(s, Sign::EitherSign, Expr::int(1))).text(", ");
    }
    let (count, legend) = (words.solutions_found(e.solutions), words.legend(e.proof()));
    blocks.push(Block::Paragraph(line.text(format!("{count}. {legend}"))));
    blocks
}

/// The unknown of a step, with what it stands for.
fn unknown(s: &Explained) -> Line {
    match s.meaning {
        Some(meaning) => Line::default().math(Math::equation(s.unknown, meaning)),
        None => Line::default().math(s.unknown),
    }
}

/// True if a statement names a coefficient of its step.
pub fn uses_letters(s: &Statement, step: &Explained) -> bool {
    let names: Vec<Expr> = step.coefficients.iter().filter_map(|c| c.math.exprs().first().copied()).collect();
    s.math.exprs().iter().any(|e| e.symbols().into_iter().any(|x| names.contains(&Expr::from(x))))
}

fn block(s: &Statement) -> Block {
    Block::Formula { math: s.math.clone(), number: s.number, proof: s.proof }
}

fn formula(math: Math) -> Block {
    Block::Formula { math, number: None, proof: None }
}

impl Explanation {
    /// What of the pose T of the tool the formulas hold, U = B⁻¹ T E⁻¹, where a base or a tool is left out.
    pub fn target(&self) -> Option<Math> {
        let [base, tool] = &self.moved;
        if base.is_none() && tool.is_none() {
            return None;
        }
        let inverse = |f: &Vec<Factor>| f.iter().rev().map(|x| x.clone().inverse()).collect::<Vec<_>>();
        let mut left: Vec<Factor> = base.iter().flat_map(inverse).collect();
        left.push(Factor::named("T"));
        left.extend(tool.iter().flat_map(inverse));
        Some(Math::Products(vec![Factor::named("U")], left))
    }
}

/// What is given and sought, the chain of matrices, what the names mean.
fn setting(e: &Explanation, words: &dyn Wording, blocks: &mut Vec<Block>) {
    let [base, tool] = &e.moved;
    let is_whole = base.is_none() && tool.is_none();
    let variables: Vec<Symbol> = e.description.variables().iter().map(|v| v.symbol).collect();
    let sought = variables.iter().map(|&s| Expr::from(s)).filter(|q| !e.given.contains(q));
    blocks.push(Block::Paragraph(words.given(Given {
        goal: e.goal,
        joints: e.given.iter().map(|&q| q.into()).collect(),
        is_choice: e.given_by_choice,
        sought: sought.map(Math::from).collect(),
        is_whole,
    })));
    let names = e.matrices.iter().map(|(f, _)| match f {
        Factor::Named { letter, number, .. } => {
            Factor::Named { letter, number: *number, of: None, inverse: false }
        }
        other => other.clone(),
    });
    blocks.push(formula(Math::Products(vec![Factor::named("U")], names.collect())));
    blocks.extend(e.target().map(formula));
    for (name, factors) in &e.matrices {
        blocks.push(formula(Math::Products(vec![name.clone()], factors.clone())));
    }
    let mut rows: Vec<Vec<Expr>> = e.pose.chunks(4).map(<[Expr]>::to_vec).collect();
    rows.push([0, 0, 0, 1].map(Expr::int).to_vec());
    blocks.push(formula(Math::Matrix(Factor::named("U"), rows)));
    if e.goal != Goal::Pose {
        blocks.push(Block::Paragraph(Line::new(words.given_columns(e.goal == Goal::PositionAndAxis))));
    }
    let names = e.names();
    if let Some(&q) = variables.iter().find(|q| names.number_of(**q).is_some()) {
        // A cosine that is written out needs no words.
        let is_short = |sum: &Expr| {
            let [short, full] = [&names, &Vocabulary::new()].map(|n| print(sum.cos(), n, Style::Ascii));
            short != full
        };
        let sum = e.steps.iter().filter_map(|s| s.meaning).chain(e.sum()).find(is_short);
        blocks.push(Block::Paragraph(words.short_names(q.into(), sum)));
    }
}

fn explained(number: usize, s: &Explained, words: &dyn Wording, blocks: &mut Vec<Block>) {
    blocks.push(Block::Heading(2, words.step_title(number, unknown(s), s.values, s.label)));
    for source in &s.sources {
        blocks.push(Block::Paragraph(words.source(source)));
        blocks.extend(source.equations.iter().map(block));
    }
    if let Some((unknown, how)) = s.elimination {
        blocks.push(Block::Paragraph(words.elimination(unknown, how)));
    }
    if !s.names.is_empty() {
        blocks.push(Block::Paragraph(Line::new(words.names_follow(!s.sources.is_empty()))));
        blocks.extend(s.names.iter().map(block));
    }
    equation(s, words, blocks);
    blocks.extend(s.solution.iter().map(block));
    let mut remarks: Vec<Line> = s.conditions.iter().map(|c| words.case(c)).collect();
    let sign = s.sign.filter(|_| s.values == 2).map(|sign| (sign, s.label));
    remarks.push(words.step_remark(sign, s.remark, &s.used_by));
    blocks.push(Block::List(remarks));
}

/// The type of a step's equation, its form and its coefficients.
fn equation(s: &Explained, words: &dyn Wording, blocks: &mut Vec<Block>) {
    let is_squared = s.sources.iter().any(|o| o.squared);
    let length = |c: &Statement| c.math.exprs().into_iter().map(literals).sum::<u64>();
    // Letters that are given no meaning are not shown.
    let is_letter = |x: &Symbol| matches!(&*x.name(), "A" | "B" | "C" | "D" | "E" | "F");
    let has_letters = s.form.iter().flat_map(Math::exprs).any(|e| e.symbols().iter().any(is_letter));
    let form = if s.coefficients.is_empty() && has_letters { &[][..] } else { &s.form };
    let said = |coefficients| Block::Paragraph(words.equation(s.kind, is_squared, form, &coefficients));
    if s.coefficients.iter().map(length).sum::<u64>() > INLINE {
        blocks.push(said(Coefficients::Below));
        blocks.extend(s.coefficients.iter().map(block));
        blocks.push(Block::Paragraph(Line::new(words.so())));
    } else {
        let all: Vec<Math> = s.coefficients.iter().map(|c| c.math.clone()).collect();
        blocks.push(said(Coefficients::Here(&all)));
    }
}

fn ending(e: &Explanation, words: &dyn Wording, blocks: &mut Vec<Block>) {
    if !e.leftovers.is_empty() {
        blocks.push(Block::Heading(2, Line::new(words.conditions_title())));
        let conditions = words.conditions(e.rank.unwrap_or(6), e.task);
        blocks.push(Block::Paragraph(Line::new(conditions)));
        blocks.extend(e.leftovers.iter().map(block));
    }
    match e.solutions {
        Some(count) => solved(e, count, words, blocks),
        None => unsolved(e, words, blocks),
    }
    blocks.push(Block::Paragraph(Line::new(words.legend(e.proof()))));
}

fn solved(e: &Explanation, count: usize, words: &dyn Wording, blocks: &mut Vec<Block>) {
    blocks.push(Block::Heading(2, Line::new(words.solutions_title(count))));
    let factors: Vec<String> =
        e.steps.iter().filter(|s| s.values > 1).map(|s| s.values.to_string()).collect();
    if factors.len() > 1 {
        let product = words.solutions_product(&factors.join(" · "));
        blocks.push(Block::Paragraph(Line::new(product)));
    }
    if count > 1 && count <= DRAWN {
        blocks.push(Block::Tree(branches(&e.steps, &mut 0, words)));
    }
    blocks.push(Block::Paragraph(Line::new(words.solutions_remark())));
}

fn unsolved(e: &Explanation, words: &dyn Wording, blocks: &mut Vec<Block>) {
    blocks.push(Block::Heading(2, Line::new(words.ended_title())));
    let missing = e.missing.iter().map(|&q| q.into()).collect();
    blocks.push(Block::Paragraph(words.ended(!e.steps.is_empty(), missing)));
    blocks.push(Block::Paragraph(Line::new(words.ended_remark(e.surplus))));
}

/// The tree of branches: a node for each choice, what follows without choice on its line.
pub fn branches(steps: &[Explained], solutions: &mut usize, words: &dyn Wording) -> Branch {
    let first = steps.iter().position(|s| s.values > 1).unwrap_or(steps.len());
    let mut line = Line::default().list(steps[..first].iter().map(|s| s.unknown.into()));
    let mut children = vec![];
    if let Some(step) = steps.get(first) {
        for k in 0..step.values {
            let mut child = branches(&steps[first + 1..], solutions, words);
            let which = match step.values {
                2 => if k == 0 { "+" } else { "−" }.to_string(),
                _ => (k + 1).to_string(),
            };
            let label = step.label.map(|label| words.label(label)).unwrap_or_default();
            let mut front = Line::default().math(step.unknown).text(" ").strong(format!("{label}{which}"));
            if !child.line.0.is_empty() {
                front = front.text(", ");
            }
            front.0.append(&mut child.line.0);
            children.push(Branch { line: front, children: child.children });
        }
    } else {
        *solutions += 1;
        let arrow = if line.0.is_empty() { "→ " } else { " → " };
        line = line.text(format!("{arrow}{}", words.solution(*solutions)));
    }
    Branch { line, children }
}
