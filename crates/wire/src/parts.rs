//! A document for a program that shows it: its parts in order, each formula in every notation that somebody may want to copy.
//!
//! Words are HTML: text with `math` elements and `strong`.

use denavit_emit::{Language, expression};
use denavit_report::document::{Block, Branch, Line, Math, Sign, math};
use denavit_report::figure::svg::{Palette, svg};
use denavit_report::{Document, Figure, Section, Table, document, render};
use denavit_symbolic::Expr;
use denavit_symbolic::print::Style;
use denavit_symbolic::vocabulary::Vocabulary;
use serde::Serialize;

/// A part of a document.
#[derive(Clone, PartialEq, Debug, Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
pub enum Part {
    /// Formulas that may stand side by side.
    Beside {
        /// They.
        formulas: Vec<Formula>,
    },
    /// Text that is set as it is.
    Code {
        /// It.
        text: String,
    },
    /// Equations below each other, aligned at their signs.
    Equations {
        /// They.
        formulas: Vec<Formula>,
    },
    /// Pictures, each with what it shows.
    Figure {
        /// What all show.
        caption: String,
        /// They.
        svgs: Vec<Picture>,
    },
    /// A formula on lines of its own.
    Formula {
        /// It.
        formula: Formula,
        /// The number by which the text refers to it.
        #[serde(skip_serializing_if = "Option::is_none")]
        number: Option<usize>,
        /// On what it rests: `proved`, `sampled`, or it is `wrong`.
        #[serde(skip_serializing_if = "Option::is_none")]
        proof: Option<&'static str>,
    },
    /// A heading.
    Heading {
        /// Its words.
        html: String,
        /// From 1.
        level: u8,
    },
    /// Points.
    List {
        /// Their words.
        items: Vec<String>,
    },
    /// Sentences.
    Paragraph {
        /// Their words.
        html: String,
    },
    /// Facts: what, and how it is.
    Summary {
        /// They.
        rows: Vec<[String; 2]>,
    },
    /// A table.
    Table {
        /// What it shows.
        caption: String,
        /// What its columns are.
        head: Vec<String>,
        /// Its cells.
        rows: Vec<Vec<String>>,
    },
    /// Cases below cases.
    Tree {
        /// The first.
        root: Tree,
    },
}

/// A case, and those below it.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Tree {
    /// Those below.
    pub children: Vec<Tree>,
    /// Its words.
    pub html: String,
}

/// A picture.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Picture {
    /// What it shows.
    pub caption: String,
    /// The `svg` element.
    pub svg: String,
}

/// A formula in every notation.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Formula {
    /// A statement of C.
    pub c: String,
    /// LaTeX.
    pub latex: String,
    /// The `math` element.
    pub mathml: String,
    /// What it defines: `C23`, `k1`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// A statement of Python.
    pub python: String,
    /// For those who hear it.
    pub text: String,
    /// Typst.
    pub typst: String,
    /// Whether it may not fit a narrow screen.
    pub wide: bool,
}

/// The parts of a document, in order.
pub fn parts(document: &Document) -> Vec<Part> {
    let mut out = vec![];
    for section in &document.sections {
        section_parts(section, &mut out);
    }
    out
}

fn section_parts(section: &Section, out: &mut Vec<Part>) {
    let names = &section.names;
    let words = |line: &Line| render::html_words(line, names);
    for part in &section.parts {
        out.push(match part {
            document::Part::Block(of) => {
                block(of, names, out);
                continue;
            }
            document::Part::Equations(all) => equations(all, names),
            document::Part::Beside(all) => {
                Part::Beside { formulas: all.iter().map(|m| Formula::of(m, names)).collect() }
            }
            document::Part::Summary(rows) => Part::Summary {
                rows: rows.iter().map(|(label, value)| [words(label), words(value)]).collect(),
            },
            document::Part::Table(of) => table(of, names),
            document::Part::Figure(of) => figure(of, names, out.len()),
            document::Part::Code(text) => Part::Code { text: text.clone() },
        });
    }
}

fn table(table: &Table, names: &Vocabulary) -> Part {
    let cells = |row: &Vec<Line>| row.iter().map(|c| render::html_words(c, names)).collect();
    Part::Table {
        caption: render::html_words(&table.caption, names),
        head: cells(&table.head),
        rows: table.rows.iter().map(cells).collect(),
    }
}

/// `number` tells the pictures of a page apart.
fn figure(figure: &Figure, names: &Vocabulary, number: usize) -> Part {
    let pictures = figure.pictures.iter().enumerate().map(|(k, (drawing, caption))| Picture {
        caption: render::html_words(caption, names),
        svg: svg(drawing, Palette::Page, &format!("p{number}-{k}")),
    });
    Part::Figure { caption: render::html_words(&figure.caption, names), svgs: pictures.collect() }
}

fn block(of: &Block, names: &Vocabulary, out: &mut Vec<Part>) {
    if let Some(named) = render::named(of, names) {
        block(&named.matrix, &named.names, out);
        out.push(equations(&named.entries, &named.names));
        return;
    }
    let words = |line: &Line| render::html_words(line, names);
    out.push(match of {
        Block::Heading(level, line) => Part::Heading { html: words(line), level: *level },
        Block::Paragraph(line) => Part::Paragraph { html: words(line) },
        Block::Formula { math, number, proof } => Part::Formula {
            formula: Formula::of(math, names),
            number: *number,
            proof: proof.map(|proof| match proof {
                document::Proof::Proved => "proved",
                document::Proof::Sampled => "sampled",
                document::Proof::Wrong => "wrong",
            }),
        },
        Block::List(lines) => Part::List { items: lines.iter().map(words).collect() },
        Block::Tree(root) => Part::Tree { root: Tree::of(root, names) },
    });
}

/// Equations below each other, aligned at their signs.
fn equations(all: &[Math], names: &Vocabulary) -> Part {
    let each = all.iter().map(|m| Formula::set(m, names, render::math_aligned(m, names)));
    Part::Equations { formulas: each.collect() }
}

impl Tree {
    fn of(branch: &Branch, names: &Vocabulary) -> Self {
        Tree {
            children: branch.children.iter().map(|b| Tree::of(b, names)).collect(),
            html: render::html_words(&branch.line, names),
        }
    }
}

impl Formula {
    /// A formula on lines of its own.
    pub fn of(m: &Math, names: &Vocabulary) -> Self {
        Self::set(m, names, render::math_display(m, names))
    }

    fn set(m: &Math, names: &Vocabulary, mathml: String) -> Self {
        let name = match m {
            Math::Chain(left, _) => left.as_symbol().map(|s| s.name().to_string()),
            _ => None,
        };
        Formula {
            c: code(m, names, Language::C),
            latex: math(m, names, Style::Latex),
            mathml,
            name,
            python: code(m, names, Language::Python),
            text: math(m, names, Style::Unicode),
            typst: math(m, names, Style::Typst),
            wide: render::is_wide(m, names),
        }
    }
}

/// An assignment in a programming language; what no language has is given as plain text behind a sign of comment.
fn code(m: &Math, names: &Vocabulary, language: Language) -> String {
    let spelled = |e: &Expr| expression(*e, language);
    let is_c = language == Language::C;
    let end = if is_c { ";" } else { "" };
    let [open, close] = if is_c { ["{", "}"] } else { ["[", "]"] };
    match m {
        Math::Expr(e) => spelled(e),
        Math::Chain(left, rest)
            if left.as_symbol().is_some() && rest[..].iter().all(|r| r.0 == Sign::Equal) =>
        {
            let right = rest.last().map(|r| spelled(&r.1)).unwrap_or_default();
            format!("{} = {right}{end}", spelled(left))
        }
        Math::Matrix(_, all) => {
            let row = |row: &Vec<Expr>| {
                format!("{open}{}{close}", row.iter().map(spelled).collect::<Vec<_>>().join(", "))
            };
            format!("{open}{}{close}", all.iter().map(row).collect::<Vec<_>>().join(",\n "))
        }
        Math::Determinant(_, e) => format!("det = {}{end}", spelled(e)),
        other => format!("{} {}", if is_c { "//" } else { "#" }, math(other, names, Style::Ascii)),
    }
}
