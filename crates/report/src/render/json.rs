//! The tree for a program that shows it: parts as JSON, each formula in every notation that somebody may want to copy.
//!
//! A formula is `{"mathml", "text", "latex", "typst", "wide"}` with its source code by language and, where it defines a name,
//! `"name"`. Words are
//! HTML: text with `math` elements and `strong`.

use super::html::{escaped, lines, rows, spoken, words};
use super::layout::{display, equation, is_wide, named};
use crate::document::{Block, Branch, Math, Proof, math};
use crate::document::{Document, Part, Section};
use crate::figure::svg::{Palette, svg};
use denavit_symbolic::print::Style;
use denavit_symbolic::vocabulary::Vocabulary;
use serde_json::{Value, json};

/// A formula as source code: languages and texts.
pub type Sources = fn(&Math, &Vocabulary) -> Vec<(&'static str, String)>;

/// The parts of a document, in order, as one list.
pub fn parts(document: &Document, sources: Sources) -> Value {
    let mut out = vec![];
    for section in &document.sections {
        section_parts(section, sources, &mut out);
    }
    out.into()
}

/// Every formula as it is shown, with its names: wide matrices by the names of their entries.
pub fn formulas(document: &Document) -> Vec<(Math, Vocabulary)> {
    let mut out = vec![];
    for section in &document.sections {
        for part in &section.parts {
            match part {
                Part::Block(block) => formulas_of(block, &section.names, &mut out),
                Part::Equations(all) | Part::Beside(all) => {
                    out.extend(all.iter().map(|m| (m.clone(), section.names.clone())));
                }
                _ => {}
            }
        }
    }
    out
}

fn formulas_of(block: &Block, names: &Vocabulary, out: &mut Vec<(Math, Vocabulary)>) {
    match (named(block, names), block) {
        (Some(named), _) => {
            formulas_of(&named.matrix, &named.names, out);
            out.extend(named.entries.into_iter().map(|m| (m, named.names.clone())));
        }
        (None, Block::Formula { math, .. }) => out.push((math.clone(), names.clone())),
        _ => {}
    }
}

fn section_parts(section: &Section, sources: Sources, out: &mut Vec<Value>) {
    let names = &section.names;
    for part in &section.parts {
        match part {
            Part::Block(block) => self::block(block, names, sources, out),
            Part::Equations(all) => out.push(equations(all, names, sources)),
            Part::Beside(all) => {
                let all: Vec<Value> = all.iter().map(|m| formula(m, names, sources)).collect();
                out.push(json!({ "kind": "beside", "formulas": all }));
            }
            Part::Summary(rows) => {
                let rows: Vec<[String; 2]> =
                    rows.iter().map(|(label, value)| [words(label, names), words(value, names)]).collect();
                out.push(json!({ "kind": "summary", "rows": rows }));
            }
            Part::Table(table) => {
                let cells = |row: &Vec<_>| row.iter().map(|c| words(c, names)).collect::<Vec<_>>();
                out.push(json!({
                    "kind": "table",
                    "caption": words(&table.caption, names),
                    "head": cells(&table.head),
                    "rows": table.rows.iter().map(cells).collect::<Vec<_>>(),
                }));
            }
            Part::Figure(figure) => {
                let pictures = figure.pictures.iter().enumerate().map(|(k, (drawing, caption))| {
                    let svg = svg(drawing, Palette::Page, &format!("p{}-{k}", out.len()));
                    json!({ "svg": svg, "caption": words(caption, names) })
                });
                let pictures: Vec<Value> = pictures.collect();
                out.push(
                    json!({ "kind": "figure", "svgs": pictures, "caption": words(&figure.caption, names) }),
                );
            }
            Part::Code(text) => out.push(json!({ "kind": "code", "text": text })),
        }
    }
}

fn block(block: &Block, names: &Vocabulary, sources: Sources, out: &mut Vec<Value>) {
    if let Some(named) = named(block, names) {
        self::block(&named.matrix, &named.names, sources, out);
        out.push(equations(&named.entries, &named.names, sources));
        return;
    }
    out.push(match block {
        Block::Heading(level, line) => {
            json!({ "kind": "heading", "level": level, "html": words(line, names) })
        }
        Block::Paragraph(line) => json!({ "kind": "paragraph", "html": words(line, names) }),
        Block::Formula { math, number, proof } => {
            let mut value = json!({ "kind": "formula", "formula": formula(math, names, sources) });
            if let Some(number) = number {
                value["number"] = (*number).into();
            }
            if let Some(proof) = proof {
                value["proof"] = match proof {
                    Proof::Proved => "proved",
                    Proof::Sampled => "sampled",
                    Proof::Wrong => "wrong",
                }
                .into();
            }
            value
        }
        Block::List(lines) => {
            let items: Vec<String> = lines.iter().map(|l| words(l, names)).collect();
            json!({ "kind": "list", "items": items })
        }
        Block::Tree(root) => json!({ "kind": "tree", "root": tree(root, names) }),
    });
}

fn tree(branch: &Branch, names: &Vocabulary) -> Value {
    let children: Vec<Value> = branch.children.iter().map(|b| tree(b, names)).collect();
    json!({ "html": words(&branch.line, names), "children": children })
}

/// Equations below each other, aligned at their signs.
fn equations(all: &[Math], names: &Vocabulary, sources: Sources) -> Value {
    let each = all.iter().map(|m| {
        let set = format!("<mtable class=\"lines\">{}</mtable>", rows(&equation(m, names, Style::MathMl)));
        noted(m, names, sources, &set)
    });
    json!({ "kind": "equations", "formulas": each.collect::<Vec<_>>() })
}

/// A formula in every notation.
pub fn formula(m: &Math, names: &Vocabulary, sources: Sources) -> Value {
    noted(m, names, sources, &lines(&display(m, names, Style::MathMl)))
}

fn noted(m: &Math, names: &Vocabulary, sources: Sources, set: &str) -> Value {
    let text = spoken(m, names);
    let mathml =
        format!("<math display=\"block\" displaystyle=\"true\" alttext=\"{}\">{set}</math>", escaped(&text));
    let mut value = json!({
        "mathml": mathml,
        "latex": math(m, names, Style::Latex),
        "typst": math(m, names, Style::Typst),
        "wide": is_wide(m, names),
        "text": text,
    });
    for (language, text) in sources(m, names) {
        value[language] = text.into();
    }
    if let Math::Chain(left, _) = m
        && let Some(name) = left.as_symbol()
    {
        value["name"] = (*name.name()).into();
    }
    value
}
