//! Typst markup. All words are Typst strings, so that no word is read as markup.

use super::layout::{self, WIDE, columns, display, equation, inline, mark, named, shares};
use super::nested::{Item, nested};
use crate::document::{Block, BrokenLine, Laid, Line, Math, Piece, math};
use crate::document::{Document, Figure, Part, Section, Table};
use crate::figure::Drawing;
use crate::figure::typst::typst as drawn;
use crate::words::Wording;
use denavit_symbolic::print::Style;
use denavit_symbolic::vocabulary::Vocabulary;
use std::fmt::Write;

/// The first lines of a fragment.
pub(super) const HEAD: &str = concat!(
    "// Made by denavit ",
    env!("CARGO_PKG_VERSION"),
    "\n#show math.equation: set block(breakable: true)\n#set math.mat(delim: \"[\", column-gap: 0.9em, row-gap: 0.35em)\n"
);

/// How a whole document looks.
const LOOK: &str = r##"#set page(paper: "a4", margin: (x: 2.2cm, top: 2.4cm, bottom: 2.2cm), numbering: "1")
#set text(font: "New Computer Modern", size: 10pt)
#set par(justify: true, leading: 0.62em, spacing: 0.95em)
#show heading.where(level: 1): set heading(numbering: "1")
#set table(stroke: none, inset: (x: 0.55em, y: 0.34em))
#set figure(gap: 0.8em)
#set list(indent: 0.6em, spacing: 0.6em)
#show heading.where(level: 1): it => block(above: 1.7em, below: 0.9em, sticky: true, text(1.12em, it))
#show heading.where(level: 2): it => block(above: 1.3em, below: 0.7em, sticky: true, it)
#show figure.where(kind: table): set figure.caption(position: top)
#show table: set par(justify: false)
#show figure: set block(above: 1.3em, below: 1.3em)
#show figure.caption: it => block(width: 92%, text(0.93em, it))
#show math.equation.where(block: true): set align(left)
#show math.equation.where(block: true): it => pad(left: 1.2em, it)
"##;

/// Tables with more rows are broken over pages.
const LONG: usize = 20;

/// A fragment to paste into a document.
pub fn fragment(document: &Document) -> String {
    let mut out = HEAD.to_string();
    let _ = writeln!(out, "#heading(level: 1, {})\n", quoted(&document.title));
    for section in &document.spelled() {
        parts(section, document.language.words(), 0, &mut out);
    }
    out
}

/// A document of its own.
pub fn whole(document: &Document) -> String {
    let language = document.language.words().code();
    let title = quoted(&document.title);
    let mut out = HEAD.to_string() + LOOK;
    // No date, so that the same robot gives the same bytes.
    let _ = writeln!(
        out,
        "#set text(lang: \"{language}\")\n#set document(title: {title}, date: none)\n\
         #align(center, text(1.75em, weight: \"bold\", hyphenate: false, par(justify: false, {title})))"
    );
    if let Some(author) = &document.author {
        let author = quoted(author);
        let _ = writeln!(out, "#set document(author: {author})\n#align(center, text(1.1em, {author}))");
    }
    out.push_str("#v(0.6em)\n\n");
    for section in &document.spelled() {
        parts(section, document.language.words(), 1, &mut out);
    }
    out
}

/// `up` is taken from the level of headings.
pub(super) fn parts(section: &Section, said: &dyn Wording, up: u8, out: &mut String) {
    for (k, part) in section.parts.iter().enumerate() {
        match part {
            Part::Block(Block::Paragraph(line)) if part.introduces(section.parts.get(k + 1)) => {
                let _ =
                    writeln!(out, "#block(sticky: true, spacing: 0.95em)[{}]\n", words(line, &section.names));
            }
            Part::Block(of) => block(of, &section.names, said, up, out),
            Part::Equations(all) => equations(all, &section.names, out),
            Part::Beside(all) => beside(all, section, said, up, out),
            Part::Summary(rows) => summary(rows, &section.names, out),
            Part::Table(of) => table(of, &section.names, out),
            Part::Figure(of) => pictures(of, &section.names, out),
            Part::Code(text) => {
                let _ = writeln!(out, "#raw(block: true, {})\n", multiline(text));
            }
        }
    }
}

/// Formulas beside each other; one that does not fit the page at all stands alone.
fn beside(all: &[Math], section: &Section, said: &dyn Wording, up: u8, out: &mut String) {
    for row in layout::beside(all, &section.names) {
        match row[..] {
            [one] => {
                let formula = Block::Formula { math: one.clone(), number: None, proof: None };
                block(&formula, &section.names, said, up, out);
            }
            _ => {
                let set = row.iter().map(|m| math(m, &section.names, Style::Typst));
                let _ = writeln!(out, "$ {} $\n", set.collect::<Vec<_>>().join(" quad quad "));
            }
        }
    }
}

fn block(block: &Block, names: &Vocabulary, said: &dyn Wording, up: u8, out: &mut String) {
    if let Some(named) = named(block, names) {
        self::block(&named.matrix, &named.names, said, up, out);
        return equations(&named.entries, &named.names, out);
    }
    match block {
        Block::Heading(level, line) => {
            let level = level.saturating_sub(up).max(1);
            let _ = writeln!(out, "#heading(level: {level})[{}]\n", words(line, names));
        }
        Block::Paragraph(line) => {
            let _ = writeln!(out, "{}\n", words(line, names));
        }
        Block::Formula { math, number, proof } => {
            let wrong = |word: &str| format!("*{word}*");
            let tail = mark(*proof, said, ["#sym.checkmark", "#sym.approx"], wrong);
            let tail = match number {
                Some(n) => format!("({n}) {tail}"),
                None => tail,
            };
            let formula = lines(&display(math, names, Style::Typst));
            if tail.is_empty() {
                let _ = writeln!(out, "$ {formula} $\n");
            } else {
                let _ = writeln!(
                    out,
                    "#grid(columns: (1fr, auto), align: (left + horizon, right + horizon), $ {formula} $, [{tail}])\n"
                );
            }
        }
        Block::List(lines) => {
            for line in lines {
                let _ = writeln!(out, "- {}", words(line, names));
            }
            out.push('\n');
        }
        Block::Tree(branch) => {
            nested(branch, &mut |item| {
                if let Item::Entry(depth, line) = item {
                    let _ = writeln!(out, "{}- {}", "  ".repeat(depth), words(line, names));
                }
            });
            out.push('\n');
        }
    }
}

/// A formula whose lines are aligned behind its left side.
fn lines(laid: &Laid) -> String {
    match &laid.lines[..] {
        [one] => laid.left.clone() + &one.text,
        _ => rows(laid),
    }
}

/// Lines, with the place where they are aligned.
fn rows(laid: &Laid) -> String {
    let line = |(k, line): (usize, &BrokenLine)| {
        let indent = " quad".repeat(line.depth);
        let left = if k == 0 { laid.left.as_str() } else { "" };
        // An empty text makes a sign at the start of a line one between two addends.
        let space = if k == 0 { "" } else { " \"\"" };
        format!("{left} &{indent}{space} {}", line.text.trim_start())
    };
    laid.lines.iter().enumerate().map(line).collect::<Vec<_>>().join(" \\\n  ")
}

fn equations(all: &[Math], names: &Vocabulary, out: &mut String) {
    let lines: Vec<String> = all.iter().map(|m| rows(&equation(m, names, Style::Typst))).collect();
    if !lines.is_empty() {
        let _ = writeln!(out, "$ {} $\n", lines.join(" \\\n  "));
    }
}

pub(super) fn words(line: &Line, names: &Vocabulary) -> String {
    let piece = |p: &Piece| match p {
        Piece::Text(t) => format!("#{};", quoted(t)),
        Piece::Strong(t) => format!("#strong({});", quoted(t)),
        Piece::Math(m) => {
            let parts = inline(m, names, Style::Typst).into_iter();
            // What starts with a sign goes on with the part before.
            let set = |(k, part): (usize, String)| match k {
                0 => format!("${part}$"),
                _ => format!("$\"\"{part}$"),
            };
            parts.enumerate().map(set).collect::<Vec<_>>().join(" ")
        }
    };
    line.0.iter().map(piece).collect()
}

fn summary(rows: &[(Line, Line)], names: &Vocabulary, out: &mut String) {
    let row = |(label, value): &(Line, Line)| {
        format!("  [#strong[{}]], [{}],\n", words(label, names), words(value, names))
    };
    let rows: String = rows.iter().map(row).collect();
    let _ = writeln!(
        out,
        "#block(width: 100%, fill: luma(246), stroke: 0.5pt + luma(200), radius: 3pt, inset: 0.7em)[\n\
         #set par(justify: false)\n#table(columns: (auto, 1fr), align: left,\n{rows})]\n"
    );
}

fn table(table: &Table, names: &Vocabulary, out: &mut String) {
    let cells =
        |row: &Vec<Line>| -> String { row.iter().map(|c| format!("[{}], ", words(c, names))).collect() };
    let rows: String = table.rows.iter().map(|r| format!("  {}\n", cells(r))).collect();
    let long = if table.rows.len() > LONG { "#show figure: set block(breakable: true); " } else { "" };
    let dense = if table.head.len() > WIDE {
        "#set text(0.88em); #set table(inset: (x: 0.32em, y: 0.34em)); "
    } else {
        ""
    };
    let _ = writeln!(
        out,
        "#[{long}{dense}#figure(caption: [{}], table(columns: ({}), align: center + horizon, table.hline(stroke: 0.8pt),\n  \
         table.header({}),\n  table.hline(stroke: 0.5pt),\n{rows}  table.hline(stroke: 0.8pt)))]\n",
        words(&table.caption, names),
        shares(table, names).into_iter().map(column).collect::<String>(),
        cells(&table.head)
    );
}

fn column(share: Option<f64>) -> String {
    share.map_or("auto, ".into(), |share| format!("{:.0}fr, ", 1000.0 * share))
}

fn pictures(figure: &Figure, names: &Vocabulary, out: &mut String) {
    let caption = words(&figure.caption, names);
    let body = match &figure.pictures[..] {
        [(one, _)] => drawn(one),
        many => {
            let columns = columns(many.len());
            let cell = |(drawing, caption): &(Drawing, Line)| {
                let width = drawing.width;
                format!(
                    "  box(width: {width}pt, stack(spacing: 4pt, {}, text(0.85em, [{}]))),\n",
                    code(&drawn(drawing)),
                    words(caption, names)
                )
            };
            let cells: String = many.iter().map(cell).collect();
            format!("#grid(columns: {columns}, gutter: 8pt, align: center,\n{cells})")
        }
    };
    let _ = writeln!(out, "#figure(kind: image, caption: [{caption}], {})\n", code(&body));
}

/// Markup that is one call, as an argument.
fn code(markup: &str) -> String {
    markup.strip_prefix('#').unwrap_or(markup).to_string()
}

/// A Typst string.
pub fn quoted(text: &str) -> String {
    format!("\"{}\"", escaped(text))
}

/// A Typst string that keeps its lines.
fn multiline(text: &str) -> String {
    format!("\"{}\"", text.lines().map(escaped).collect::<Vec<_>>().join("\\n"))
}

fn escaped(text: &str) -> String {
    text.replace('\\', "\\\\").replace('"', "\\\"").replace(char::is_control, " ")
}
