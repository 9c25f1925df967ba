//! One page of HTML that needs nothing else: MathML with a font of its own, figures inside, light and dark.
//!
//! The page is well-formed XML, too.

use super::layout::{columns, display, equation, inline, is_wide, named};
use super::nested::{Item, nested};
use crate::document::{Block, BrokenLine, Laid, Line, Math, Piece, math};
use crate::document::{Document, Figure, Part, Section, Table};
use crate::figure::svg::{Palette, style, svg};
use crate::words::Wording;
use base64::Engine;
use denavit_symbolic::print::Style;
use denavit_symbolic::vocabulary::Vocabulary;
use std::fmt::Write;

/// STIX Two Math, the letters and signs that formulas use; under the SIL Open Font License, beside it.
const FONT: &[u8] = include_bytes!("../../assets/maths.woff2");
const LOOK: &str = include_str!("../../assets/page.css");

/// The page.
pub fn page(document: &Document) -> String {
    page_with(document, &font())
}

/// The font of formulas, WOFF2 in base64.
pub fn font() -> String {
    base64::engine::general_purpose::STANDARD.encode(FONT)
}

/// The font of formulas as a rule of a style sheet; it is called Denavit Maths.
pub fn font_face(font: &str) -> String {
    format!(
        "@font-face{{font-family:\"Denavit Maths\";src:url(data:font/woff2;base64,{font}) format(\"woff2\")}}\n"
    )
}

/// All that stands before the body.
pub(super) fn head(document: &Document, font: &str, more: &str) -> String {
    format!(
        "<!DOCTYPE html>\n<html lang=\"{}\">\n<head>\n<meta charset=\"utf-8\"/>\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n\
         <meta name=\"generator\" content=\"denavit {}\"/>\n<title>{}</title>\n<style>\n\
         {}{LOOK}{}{more}</style>\n</head>\n",
        document.language.words().code(),
        env!("CARGO_PKG_VERSION"),
        escaped(&document.title),
        font_face(font),
        style()
    )
}

/// The page with the font of its formulas (WOFF2, base64) put in by whoever has it already.
pub fn page_with(document: &Document, font: &str) -> String {
    let title = escaped(&document.title);
    let author = document.author.as_deref();
    let author = author.map_or_else(String::new, |a| format!("<p class=\"author\">{}</p>\n", escaped(a)));
    let mut writer = Writer::new(document.language.words());
    for section in &document.spelled() {
        writer.section(section);
    }
    let mut out = head(document, font, "") + &format!("<body>\n<main>\n<h1>{title}</h1>\n{author}");
    if writer.contents.len() > 3 {
        let _ = writeln!(out, "<nav aria-label=\"{}\">\n<ol>", document.language.words().contents());
        for (k, heading) in writer.contents.iter().enumerate() {
            let _ = writeln!(out, "<li><a href=\"#s{}\">{heading}</a></li>", k + 1);
        }
        out.push_str("</ol>\n</nav>\n");
    }
    out + &writer.out + "</main>\n</body>\n</html>\n"
}

pub(super) struct Writer {
    pub(super) out: String,
    /// Headings of level 2.
    contents: Vec<String>,
    figures: usize,
    tables: usize,
    said: &'static dyn Wording,
}

impl Writer {
    pub(super) fn new(said: &'static dyn Wording) -> Self {
        Writer { out: String::new(), contents: vec![], figures: 0, tables: 0, said }
    }

    pub(super) fn section(&mut self, section: &Section) {
        let names = &section.names;
        for part in &section.parts {
            match part {
                Part::Block(of) => self.block(of, names),
                Part::Equations(all) => self.equations(all, names),
                Part::Beside(all) => {
                    self.out.push_str("<div class=\"beside\">\n");
                    for m in all {
                        self.block(&Block::Formula { math: m.clone(), number: None, proof: None }, names);
                    }
                    self.out.push_str("</div>\n");
                }
                Part::Summary(rows) => self.summary(rows, names),
                Part::Table(of) => self.table(of, names),
                Part::Figure(of) => self.figure(of, names),
                Part::Code(text) => {
                    let _ = writeln!(self.out, "<pre><code>{}</code></pre>", escaped_lines(text));
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
            // The page has its title.
            Block::Heading(1, _) => {}
            Block::Heading(2, line) => {
                self.contents.push(words(line, names));
                let _ = writeln!(self.out, "<h2 id=\"s{}\">{}</h2>", self.contents.len(), words(line, names));
            }
            Block::Heading(level, line) => {
                let level = (*level).min(6);
                let _ = writeln!(self.out, "<h{level}>{}</h{level}>", words(line, names));
            }
            Block::Paragraph(line) => {
                let _ = writeln!(self.out, "<p>{}</p>", words(line, names));
            }
            Block::Formula { math, number, proof } => {
                let mark = proof.map_or("", |proof| self.said.mark(proof));
                let said = self.said.spoken_mark(mark);
                let number = number.map(|n| format!("({n})")).unwrap_or_default();
                let tail = match (number.is_empty(), mark.is_empty()) {
                    (true, true) => String::new(),
                    (_, true) => format!("<span class=\"number\">{number}</span>"),
                    _ => format!(
                        "<span class=\"number\">{number} <span role=\"img\" aria-label=\"{said}\">{mark}</span></span>"
                    ),
                };
                let set = lines(&display(math, names, Style::MathMl));
                self.formula(&set, &spoken(math, names), &tail, is_wide(math, names));
            }
            Block::List(lines) => {
                self.out.push_str("<ul>\n");
                for line in lines {
                    let _ = writeln!(self.out, "<li>{}</li>", words(line, names));
                }
                self.out.push_str("</ul>\n");
            }
            Block::Tree(branch) => nested(branch, &mut |item| {
                let _ = match item {
                    Item::Open(_) => writeln!(self.out, "<ul class=\"tree\">"),
                    Item::Entry(_, line) => writeln!(self.out, "<li>{}", words(line, names)),
                    Item::Done => writeln!(self.out, "</li>"),
                    Item::Close(_) => writeln!(self.out, "</ul>"),
                };
            }),
        }
    }

    /// One that may be wider than a screen can be scrolled by keys.
    fn formula(&mut self, set: &str, alt: &str, tail: &str, is_wide: bool) {
        let label = self.said.formula();
        let scrolled = if is_wide {
            format!(" tabindex=\"0\" role=\"group\" aria-label=\"{label}\"")
        } else {
            String::new()
        };
        let _ = writeln!(
            self.out,
            "<div class=\"formula\"{scrolled}><math displaystyle=\"true\" alttext=\"{}\">{set}</math>{tail}</div>",
            escaped(alt)
        );
    }

    fn equations(&mut self, all: &[Math], names: &Vocabulary) {
        if all.is_empty() {
            return;
        }
        let set: String = all.iter().map(|m| rows(&equation(m, names, Style::MathMl))).collect();
        let alt: Vec<String> = all.iter().map(|m| spoken(m, names)).collect();
        self.formula(
            &format!("<mtable class=\"lines\">{set}</mtable>"),
            &alt.join("; "),
            "",
            all.iter().any(|m| is_wide(m, names)),
        );
    }

    fn summary(&mut self, rows: &[(Line, Line)], names: &Vocabulary) {
        self.out.push_str("<dl class=\"summary\">\n");
        for (label, value) in rows {
            let _ = writeln!(self.out, "<dt>{}</dt><dd>{}</dd>", words(label, names), words(value, names));
        }
        self.out.push_str("</dl>\n");
    }

    fn table(&mut self, table: &Table, names: &Vocabulary) {
        self.tables += 1;
        let word = self.said.table();
        let _ = writeln!(
            self.out,
            "<div class=\"table\" tabindex=\"0\" role=\"group\" aria-label=\"{word} {}\"><table>\n<caption><b>{word} {}.</b> {}</caption>\n<thead><tr>",
            self.tables,
            self.tables,
            words(&table.caption, names)
        );
        for head in &table.head {
            let _ = write!(self.out, "<th scope=\"col\">{}</th>", words(head, names));
        }
        self.out.push_str("</tr></thead>\n<tbody>\n");
        for row in &table.rows {
            let cells: String = row.iter().map(|c| format!("<td>{}</td>", words(c, names))).collect();
            let _ = writeln!(self.out, "<tr>{cells}</tr>");
        }
        self.out.push_str("</tbody>\n</table></div>\n");
    }

    fn figure(&mut self, figure: &Figure, names: &Vocabulary) {
        self.figures += 1;
        let word = self.said.figure();
        self.out.push_str("<figure>\n");
        match &figure.pictures[..] {
            [(one, _)] => self.out += &svg(one, Palette::Page, &format!("f{}", self.figures)),
            many => {
                let _ = writeln!(self.out, "<div class=\"pictures of-{}\">", columns(many.len()));
                for (k, (drawing, caption)) in many.iter().enumerate() {
                    let svg = svg(drawing, Palette::Page, &format!("f{}-{}", self.figures, k + 1));
                    let _ = writeln!(self.out, "<div>{svg}<p>{}</p></div>", words(caption, names));
                }
                self.out.push_str("</div>\n");
            }
        }
        let _ = writeln!(
            self.out,
            "<figcaption><b>{word} {}.</b> {}</figcaption>\n</figure>",
            self.figures,
            words(&figure.caption, names)
        );
    }
}

/// The formula for those who hear it.
fn spoken(m: &Math, names: &Vocabulary) -> String {
    math(m, names, Style::Unicode)
}

/// A formula on lines of its own, as a `math` element.
pub fn math_display(m: &Math, names: &Vocabulary) -> String {
    element(m, names, &lines(&display(m, names, Style::MathMl)))
}

/// One of several equations below each other, to be aligned at their signs, as a `math` element.
pub fn math_aligned(m: &Math, names: &Vocabulary) -> String {
    let rows = rows(&equation(m, names, Style::MathMl));
    element(m, names, &format!("<mtable class=\"lines\">{rows}</mtable>"))
}

fn element(m: &Math, names: &Vocabulary, set: &str) -> String {
    let text = escaped(&spoken(m, names));
    format!("<math display=\"block\" displaystyle=\"true\" alttext=\"{text}\">{set}</math>")
}

fn lines(laid: &Laid) -> String {
    match &laid.lines[..] {
        [one] => format!("<mrow>{}{}</mrow>", laid.left, one.text),
        _ => format!("<mtable class=\"lines\">{}</mtable>", rows(laid)),
    }
}

/// Rows of a table, with the place where they are aligned.
fn rows(laid: &Laid) -> String {
    let line = |(k, line): (usize, &BrokenLine)| {
        let left = if k == 0 { laid.left.as_str() } else { "" };
        let indent = match line.depth {
            0 => String::new(),
            depth => format!("<mspace width=\"{depth}em\"></mspace>"),
        };
        // The sign of equality keeps its space at the start of a cell.
        let text =
            if k == 0 { line.text.replacen("<mo>", "<mo form=\"infix\">", 1) } else { line.text.clone() };
        let text = if k == 0 && !line.text.starts_with("<mo>") { &line.text } else { &text };
        format!("<mtr><mtd>{left}</mtd><mtd><mrow>{indent}{text}</mrow></mtd></mtr>")
    };
    laid.lines.iter().enumerate().map(line).collect()
}

/// A line of text: `math` elements for its formulas, and `strong`.
pub fn words(line: &Line, names: &Vocabulary) -> String {
    let piece = |p: &Piece| match p {
        Piece::Text(t) => escaped(t),
        Piece::Strong(t) => format!("<strong>{}</strong>", escaped(t)),
        Piece::Math(m) => {
            let parts = inline(m, names, Style::MathMl);
            let alt = |k: usize| match k {
                0 => format!(" alttext=\"{}\"", escaped(&spoken(m, names))),
                _ => " alttext=\"…\"".into(),
            };
            let set = parts.iter().enumerate().map(|(k, part)| {
                let part =
                    if k == 0 { part.clone() } else { part.replacen("<mo>", "<mo form=\"infix\">", 1) };
                format!("<math{}><mrow>{part}</mrow></math>", alt(k))
            });
            set.collect::<Vec<_>>().join(" ")
        }
    };
    line.0.iter().map(piece).collect()
}

/// Text outside of formulas.
pub fn escaped(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            // Not allowed in XML, not even as a reference.
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

fn escaped_lines(text: &str) -> String {
    text.lines().map(escaped).collect::<Vec<_>>().join("\n")
}
