//! What an explanation says.

use super::Explanation;
use super::explained::{Explained, Source, Statement, ordinal};
use super::origin::listed;
use crate::explain::{Block, Factor, Line, Math, Proof};
use crate::inverse::derivation::Goal;
use denavit_symbolic::Expr;
use denavit_symbolic::readable::literals;

/// Solutions beyond which the tree is not drawn.
const DRAWN: usize = 16;

/// Literals of coefficients that stand in a line of text.
const INLINE: u64 = 40;

/// The whole derivation.
pub fn document(e: &Explanation) -> Vec<Block> {
    let mut blocks =
        vec![Block::Heading(1, Line::new(format!("Inverse kinematics of the {}", e.description.name)))];
    setting(e, &mut blocks);
    for (k, step) in e.steps.iter().enumerate() {
        explained(k + 1, step, &mut blocks);
    }
    if !e.joints.is_empty() && e.solutions.is_some() {
        blocks.push(Block::Heading(2, Line::new("The other joints")));
        blocks.extend(e.joints.iter().map(block));
    }
    ending(e, &mut blocks);
    blocks
}

/// The formulas alone.
pub fn formulas(e: &Explanation) -> Vec<Block> {
    let mut blocks =
        vec![Block::Heading(1, Line::new(format!("Inverse kinematics of the {}", e.description.name)))];
    setting(e, &mut blocks);
    for (k, step) in e.steps.iter().enumerate() {
        let mut line = Line::new(format!("{}. ", k + 1)).math(step.unknown);
        if let Some(meaning) = step.meaning {
            line = line.text(" = ").math(meaning);
        }
        blocks.push(Block::Heading(3, line));
        blocks.extend(step.names.iter().map(block));
        if step.solution.iter().any(|s| uses_letters(s, step)) {
            blocks.extend(step.coefficients.iter().map(block));
        }
        blocks.extend(step.solution.iter().map(|s| block(&Statement { number: None, ..s.clone() })));
    }
    if !e.joints.is_empty() {
        blocks.push(Block::Heading(3, Line::new("The other joints")));
        blocks.extend(e.joints.iter().map(block));
    }
    let mut line = Line::default();
    for s in e.steps.iter().filter_map(|s| s.sign) {
        line = line.math(s).text(" = ±1, ");
    }
    let count = match e.solutions {
        Some(1) => "one solution".to_string(),
        Some(n) => format!("at most {n} solutions"),
        None => "here the derivation ends: no closed form was found".into(),
    };
    blocks.push(Block::Paragraph(line.text(format!("{count}. {}", legend(e)))));
    blocks
}

/// True if a statement names a coefficient of its step.
fn uses_letters(s: &Statement, step: &Explained) -> bool {
    let names: Vec<Expr> = step.coefficients.iter().filter_map(|c| c.math.exprs().first().copied()).collect();
    s.math.exprs().iter().any(|e| e.symbols().into_iter().any(|x| names.contains(&Expr::from(x))))
}

fn block(s: &Statement) -> Block {
    Block::Formula { math: s.math.clone(), number: s.number, proof: s.proof }
}

fn setting(e: &Explanation, blocks: &mut Vec<Block>) {
    let [base, tool] = &e.moved;
    let names: Vec<Factor> = e
        .matrices
        .iter()
        .map(|(f, _)| match f {
            Factor::Named { letter, number, .. } => {
                Factor::Named { letter, number: *number, of: None, inverse: false }
            }
            other => other.clone(),
        })
        .collect();
    let given = match e.goal {
        Goal::Pose => "the pose T of the hand",
        Goal::Position => "the position of the hand",
        Goal::PositionAndAxis => "the position of the hand and the direction of its z axis",
    };
    let mut line = Line::new(format!("Given {given}"));
    if !e.given.is_empty() {
        line = line.text(" and ").list(e.given.iter().map(|&q| q.into()));
        if e.given_by_choice {
            line = line.text(match e.given.len() {
                1 => {
                    " (a joint too many: any value is allowed, and the derivation is shortest with this one)"
                }
                _ => " (joints too many: any values are allowed, and the derivation is shortest with these)",
            });
        }
    }
    let sought: Vec<Math> = e
        .description
        .variables()
        .iter()
        .map(|v| Expr::from(v.symbol))
        .filter(|q| !e.given.contains(q))
        .map(Math::from)
        .collect();
    line = line.text("; sought ").list(sought).text(". ");
    let trivial = base.is_none() && tool.is_none();
    line = line.text(match (trivial, e.matrices.len()) {
        (true, _) => "With U = T the chain is",
        _ => "What is constant at both ends is taken to the side of the pose; what is left is",
    });
    blocks.push(Block::Paragraph(line));
    blocks.push(formula(Math::Products(vec![Factor::named("U")], names)));
    let mut left: Vec<Factor> = vec![];
    let inverse = |f: &Vec<Factor>| f.iter().rev().map(|x| x.clone().inverse()).collect::<Vec<_>>();
    left.extend(base.iter().flat_map(inverse));
    left.push(Factor::named("T"));
    left.extend(tool.iter().flat_map(inverse));
    if !trivial {
        blocks.push(formula(Math::Products(vec![Factor::named("U")], left)));
    }
    for (name, factors) in &e.matrices {
        blocks.push(formula(Math::Products(vec![name.clone()], factors.clone())));
    }
    let column = |k: usize| e.pose[k];
    let rows = |k: usize| [column(k), column(4 + k), column(8 + k)];
    let mut line = Line::new("U has the columns ");
    for (k, last) in [(0, ""), (1, ""), (2, ""), (3, " (the position)")] {
        line = line.text("(").list(rows(k).map(Math::from)).text(format!("){last}"));
        line = line.text(if k < 2 {
            ", "
        } else if k == 2 {
            " and "
        } else {
            ". "
        });
    }
    let turning = |q: &&denavit_symbolic::Symbol| e.names().number_of(**q).is_some();
    let variables: Vec<denavit_symbolic::Symbol> =
        e.description.variables().iter().map(|v| v.symbol).collect();
    if let Some(&q) = variables.iter().find(turning) {
        let q = Expr::from(q);
        line = line.math(q.cos()).text(" and ").math(q.sin()).text(" are cosine and sine of ").math(q);
        if let Some(sum) = e.steps.iter().find_map(|s| s.meaning).or_else(|| e.sum()) {
            line = line.text(", ").math(sum.cos()).text(" is the cosine of ").math(sum);
        }
        line = line.text(".");
    }
    blocks.push(Block::Paragraph(line));
}

fn formula(math: Math) -> Block {
    Block::Formula { math, number: None, proof: None }
}

fn explained(number: usize, s: &Explained, blocks: &mut Vec<Block>) {
    let mut title = Line::new(format!("Step {number}. ")).math(s.unknown);
    if let Some(meaning) = s.meaning {
        title = title.text(" = ").math(meaning);
    }
    title = title.text(match s.values {
        1 => ": one value".into(),
        n => format!(": {n} values"),
    });
    if let Some(label) = &s.label {
        title = title.text(format!(" ({label})"));
    }
    blocks.push(Block::Heading(2, title));
    for source in &s.sources {
        from(source, blocks);
    }
    if let Some(line) = &s.elimination {
        blocks.push(Block::Paragraph(line.clone()));
    }
    if !s.names.is_empty() {
        blocks.push(Block::Paragraph(Line::new(if s.sources.is_empty() { "Let" } else { "with" })));
        blocks.extend(s.names.iter().map(block));
    }
    let squared = s.sources.iter().any(|o| o.squared);
    let mut line = Line::new(match (s.number, squared) {
        ("none", _) => "An equation ".to_string(),
        (n, true) => format!("The squares of both sides, added: type {n}, "),
        (n, false) => format!("Type {n}, "),
    });
    line = line.text(s.kind.clone());
    for (k, f) in s.form.iter().enumerate() {
        line = line.text(if k == 0 { ": " } else { " and " }).math(f.clone());
    }
    let literals = |c: &Statement| c.math.exprs().into_iter().map(literals).sum::<u64>();
    let is_long = s.coefficients.iter().map(literals).sum::<u64>() > INLINE;
    for (k, c) in s.coefficients.iter().enumerate().filter(|_| !is_long) {
        line = line.text(if k == 0 { " with " } else { ", " }).math(c.math.clone());
    }
    if is_long {
        blocks.push(Block::Paragraph(line.text(" with")));
        blocks.extend(s.coefficients.iter().map(block));
        line = Line::default();
    } else {
        line = line.text("; ");
    }
    blocks.push(Block::Paragraph(line.text("so")));
    blocks.extend(s.solution.iter().map(block));
    let mut remarks = vec![];
    for c in &s.conditions {
        let mut line = Line::default();
        for (k, m) in c.when.iter().enumerate() {
            line = line
                .text(if k == 0 {
                    ""
                } else if is_zeros(&c.when) {
                    " and "
                } else {
                    " or "
                })
                .math(m.clone());
        }
        if !c.when.is_empty() {
            line = line.text(": ");
        }
        remarks.push(line.text(c.then.clone()));
    }
    let mut last = Line::default();
    if let Some(sign) = s.sign.filter(|_| s.values == 2) {
        last = last.math(sign).text(" = ±1");
        if let Some(label) = &s.label {
            last = last.text(format!(": {label}+ and {label}−"));
        }
        last = last.text(". ");
    }
    last = last.text(s.remark.clone());
    last = last.text(match &s.used_by[..] {
        [] => " No later step needs it.".to_string(),
        [one] => format!(" Used by step {one}."),
        many => {
            format!(" Used by steps {}.", listed(&many.iter().map(ToString::to_string).collect::<Vec<_>>()))
        }
    });
    remarks.push(last);
    blocks.push(Block::List(remarks));
}

/// True for a list of expressions that all vanish.
fn is_zeros(all: &[Math]) -> bool {
    all.iter().all(|m| m.exprs().last().is_some_and(|e| e.is_zero()))
}

fn from(source: &Source, blocks: &mut Vec<Block>) {
    let (left, right) = source.product.clone();
    let mut line = Line::default();
    if source.inverse {
        line = line.text("The inverse of both sides of ");
    }
    line = line.math(Math::Products(left, right)).text(", ");
    let mut rows: Vec<usize> = source.elements.iter().map(|e| e.0).collect();
    let mut columns: Vec<usize> = source.elements.iter().map(|e| e.1).collect();
    rows.dedup();
    columns.dedup();
    let several = |all: &[usize], word: &str| {
        let names: Vec<String> = all.iter().map(|&n| ordinal(n).to_string()).collect();
        format!("{} {word}{}", listed(&names), if all.len() == 1 { "" } else { "s" })
    };
    line = line.text(match (rows.len(), columns.len()) {
        (1, _) | (_, 1) => format!("{}, {}", several(&rows, "row"), several(&columns, "column")),
        _ => {
            let places: Vec<String> = source.elements.iter().map(|(r, c)| format!("({r}, {c})")).collect();
            format!("elements {}", listed(&places))
        }
    });
    if let Some(why) = &source.why {
        line = line.text(format!(" ({why})"));
    }
    blocks.push(Block::Paragraph(line.text(":")));
    blocks.extend(source.equations.iter().map(block));
}

fn ending(e: &Explanation, blocks: &mut Vec<Block>) {
    if !e.leftovers.is_empty() {
        blocks.push(Block::Heading(2, Line::new("What the pose must meet")));
        let count = e.rank.unwrap_or(6);
        let task = e.task.map(|t| format!(": it can be told {t}")).unwrap_or_default();
        blocks.push(Block::Paragraph(Line::new(format!(
            "The hand can move in {count} independent directions{task}. A pose that is reached meets"
        ))));
        blocks.extend(e.leftovers.iter().map(block));
    }
    match e.solutions {
        Some(count) => {
            blocks.push(Block::Heading(
                2,
                Line::new(match count {
                    1 => "One solution".to_string(),
                    n => format!("At most {n} solutions"),
                }),
            ));
            let factors: Vec<String> =
                e.steps.iter().filter(|s| s.values > 1).map(|s| s.values.to_string()).collect();
            if factors.len() > 1 {
                blocks.push(Block::Paragraph(Line::new(format!("{} = {count}:", factors.join(" · ")))));
            }
            if let Some(tree) = e.branches.clone().filter(|_| count > 1 && count <= DRAWN) {
                blocks.push(Block::Tree(tree));
            }
            let text = "Each step follows from the equations before it and has all their roots, so no solution is lost. \
                        Each solution is put into the whole chain again; what does not give the pose is dropped. \
                        The types are numbered as by Khalil and Dombre; 1, 2 and 3 are Paul's.";
            blocks.push(Block::Paragraph(Line::new(text)));
        }
        None => {
            blocks.push(Block::Heading(2, Line::new("Here the derivation ends")));
            let mut line = Line::default();
            if e.steps.is_empty() {
                line = line.text("Nothing was found. ");
            }
            line = line
                .text("No equation of the chain, and no combination of two of them that was tried, holds ")
                .list(e.missing.iter().map(|&q| q.into()))
                .text(" in one unknown with degree up to 4 in tan(θ/2).");
            blocks.push(Block::Paragraph(line));
            let text = match e.surplus {
                0 => "Closed forms exist where three axes in a row meet in one point or are parallel; \
                      where neither is so, the general arm has up to 16 solutions, roots of one polynomial of degree 16."
                    .to_string(),
                n => format!("The arm has {n} joint{} more than the hand can use: with other joints given the derivation may end.", if n == 1 { "" } else { "s" }),
            };
            blocks.push(Block::Paragraph(Line::new(text)));
        }
    }
    blocks.push(Block::Paragraph(Line::new(legend(e))));
}

/// What the marks behind formulas mean.
fn legend(e: &Explanation) -> &'static str {
    match e.proof() {
        Proof::Proved => {
            "✓: proved. With A1·A2·… put in for U, both sides are identical, whatever the joint values and lengths."
        }
        Proof::Sampled => "✓: proved. ≈: checked at sample poses only; the expansion is too large to decide.",
        Proof::Wrong => "A formula above is NOT TRUE: this is an error of the program.",
    }
}
