//! Markdown with LaTeX formulas between dollar signs, as GitHub and most programs read it; figures are files beside it.

use super::latex::rows;
use super::layout::{columns, display, equation, mark, named};
use super::nested::{Item, nested};
use crate::document::{Block, Line, Math, Piece, math};
use crate::document::{Document, Figure, Part, Section, Table};
use crate::figure::svg::{Palette, svg};
use crate::words::Wording;
use denavit_symbolic::print::Style;
use denavit_symbolic::vocabulary::Vocabulary;
use std::fmt::Write;

/// A document with the files that it shows.
#[derive(Clone, Debug)]
pub struct Markdown {
    /// The document.
    pub text: String,
    /// File names, as the document has them, and SVG.
    pub figures: Vec<(String, String)>,
}

/// A document of its own; its figures are in `folder` beside it.
pub fn whole(document: &Document, folder: &str) -> Markdown {
    let mut writer = Writer {
        out: format!("# {}\n\n", escaped(&document.title)),
        figures: vec![],
        tables: 0,
        pictures: 0,
        folder,
        said: document.language.words(),
    };
    if let Some(author) = &document.author {
        let _ = writeln!(writer.out, "{}\n", escaped(author));
    }
    for section in &document.spelled() {
        writer.section(section);
    }
    Markdown { text: writer.out, figures: writer.figures }
}

struct Writer<'a> {
    out: String,
    figures: Vec<(String, String)>,
    tables: usize,
    pictures: usize,
    folder: &'a str,
    said: &'static dyn Wording,
}

impl Writer<'_> {
    fn section(&mut self, section: &Section) {
        let names = &section.names;
        for part in &section.parts {
            match part {
                Part::Block(of) => self.block(of, names),
                Part::Equations(all) => self.equations(all, names),
                Part::Beside(all) => {
                    for m in all {
                        self.block(&Block::Formula { math: m.clone(), number: None, proof: None }, names);
                    }
                }
                Part::Summary(rows) => {
                    self.out += "| | |\n|:--|:--|\n";
                    for (label, value) in rows {
                        let _ = writeln!(self.out, "| {} | {} |", cell(label, names), cell(value, names));
                    }
                    self.out.push('\n');
                }
                Part::Table(of) => self.table(of, names),
                Part::Figure(of) => self.figure(of, names),
                Part::Code(text) => {
                    // Longer than any row of backquotes inside.
                    let longest = text.split(|c| c != '`').map(str::len).max().unwrap_or(0);
                    let fence = "`".repeat(longest.max(2) + 1);
                    let _ = writeln!(self.out, "{fence}text\n{}\n{fence}\n", text.trim_end());
                }
            }
        }
    }

    fn block(&mut self, block: &Block, names: &Vocabulary) {
        if let Some(named) = named(block, names) {
            self.block(&named.matrix, &named.names);
            return self.equations(&named.entries, &named.names);
        }
        match block {
            Block::Heading(level, line) => {
                let _ = writeln!(self.out, "{} {}\n", "#".repeat((*level).into()), words(line, names));
            }
            Block::Paragraph(line) => {
                let _ = writeln!(self.out, "{}\n", words(line, names));
            }
            Block::Formula { math, number, proof } => {
                let wrong = |word: &str| format!(" \\quad\\textbf{{{word}}}");
                let mark = mark(*proof, self.said, [" \\quad\\checkmark", " \\quad\\approx"], wrong);
                let tag = number.map(|n| format!(" \\tag{{{n}}}")).unwrap_or_default();
                let laid = display(math, names, Style::Latex);
                let formula = match &laid.lines[..] {
                    [one] => laid.left.clone() + &one.text,
                    _ => format!("\\begin{{aligned}}\n{}\n\\end{{aligned}}", rows(&laid)),
                };
                let _ = writeln!(self.out, "$$\n{}{mark}{tag}\n$$\n", guarded(&formula));
            }
            Block::List(lines) => {
                for line in lines {
                    let _ = writeln!(self.out, "- {}", words(line, names));
                }
                self.out.push('\n');
            }
            Block::Tree(branch) => {
                nested(branch, &mut |item| {
                    if let Item::Entry(depth, line) = item {
                        let _ = writeln!(self.out, "{}- {}", "  ".repeat(depth), words(line, names));
                    }
                });
                self.out.push('\n');
            }
        }
    }

    fn equations(&mut self, all: &[Math], names: &Vocabulary) {
        let lines: Vec<String> = all.iter().map(|m| rows(&equation(m, names, Style::Latex))).collect();
        if !lines.is_empty() {
            let lines = guarded(&lines.join(" \\\\\n"));
            let _ = writeln!(self.out, "$$\n\\begin{{aligned}}\n{lines}\n\\end{{aligned}}\n$$\n");
        }
    }

    fn table(&mut self, table: &Table, names: &Vocabulary) {
        self.tables += 1;
        let word = self.said.table();
        let _ = writeln!(self.out, "**{word} {}.** {}\n", self.tables, words(&table.caption, names));
        let cells = |row: &Vec<Line>| row.iter().map(|c| cell(c, names)).collect::<Vec<_>>().join(" | ");
        let _ = writeln!(self.out, "| {} |\n|{}", cells(&table.head), ":-:|".repeat(table.head.len()));
        for row in &table.rows {
            let _ = writeln!(self.out, "| {} |", cells(row));
        }
        self.out.push('\n');
    }

    fn figure(&mut self, figure: &Figure, names: &Vocabulary) {
        let across = columns(figure.pictures.len());
        let is_table = figure.pictures.len() > 1;
        for (k, (drawing, caption)) in figure.pictures.iter().enumerate() {
            let file = format!("{}/figure-{}.svg", self.folder, self.figures.len() + 1);
            let address: String = file
                .chars()
                .map(|c| match c {
                    ' ' | '(' | ')' | '<' | '>' | '\\' | '%' | '"' => format!("%{:02X}", u32::from(c)),
                    c if c.is_control() => String::new(),
                    c => c.to_string(),
                })
                .collect();
            let picture = format!("![{}]({address})", escaped(&drawing.description));
            if is_table {
                let _ = write!(self.out, "| {picture}<br>{} ", cell(caption, names));
                let is_last = k + 1 == figure.pictures.len();
                let empty = if is_last { (across - 1) - k % across } else { 0 };
                self.out.push_str(&"| ".repeat(empty));
                if is_last || k % across == across - 1 {
                    self.out.push_str("|\n");
                }
                if k == across - 1 || is_last && k < across {
                    let _ = writeln!(self.out, "|{}", ":-:|".repeat(across));
                }
            } else {
                let _ = writeln!(self.out, "{picture}");
            }
            self.figures.push((file, svg(drawing, Palette::File, "figure")));
        }
        self.pictures += 1;
        let (word, number) = (self.said.figure(), self.pictures);
        let _ = writeln!(self.out, "\n**{word} {number}.** {}\n", words(&figure.caption, names));
    }
}

fn words(line: &Line, names: &Vocabulary) -> String {
    let piece = |p: &Piece| match p {
        Piece::Text(t) => escaped(t),
        Piece::Strong(t) => strong(t),
        Piece::Math(m) => format!("${}$", guarded(&math(m, names, Style::Latex))),
    };
    line.0.iter().map(piece).collect()
}

/// Words that stand out. Stars beside punctuation do not always do it.
fn strong(words: &str) -> String {
    let is_plain = |c: Option<char>| c.is_some_and(char::is_alphanumeric);
    match is_plain(words.chars().next()) && is_plain(words.chars().last()) {
        true => format!("**{}**", escaped(words)),
        false => format!("<strong>{}</strong>", escaped(words)),
    }
}

/// A formula without the signs that end one in Markdown.
fn guarded(latex: &str) -> String {
    latex.replace("\\$", "\\textdollar ").replace('`', "'")
}

/// In a table, where a bar ends a cell even in a formula.
fn cell(line: &Line, names: &Vocabulary) -> String {
    words(line, names).replace('|', "\\|").replace("\\\\|", "\\|")
}

/// Text outside of formulas: every sign of punctuation that may mean something behind a backslash.
pub fn escaped(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '\\' | '`' | '*' | '_' | '{' | '}' | '[' | ']' | '<' | '>' | '#' | '$' | '|' | '&' | '!'
            | '~' | '^' => {
                out.extend(['\\', c]);
            }
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    // A line that starts so would be a list.
    let behind = out.trim_start().trim_start_matches(|c: char| c.is_ascii_digit());
    if behind.starts_with(['-', '+', '.', ')', '=', ':']) {
        out.insert(out.len() - out.trim_start().len(), '\u{200b}');
    }
    // And one so a block of code.
    if out.starts_with("    ") {
        out.insert(0, '\u{200b}');
    }
    out
}
