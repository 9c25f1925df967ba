//! LaTeX for a plain TeX Live: the packages amsmath, amssymb and, for figures and long tables, tikz and longtable.

use super::layout::{self, WIDE, columns, display, equation, inline, mark, named, shares};
use super::nested::{Item, nested};
use crate::document::{Block, BrokenLine, Laid, Line, Math, Piece, math};
use crate::document::{Document, Figure, Part, Section, Table};
use crate::figure::tikz::tikz;
use crate::words::Wording;
use denavit_symbolic::greek;
use denavit_symbolic::print::Style;
use denavit_symbolic::vocabulary::Vocabulary;
use std::fmt::Write;

/// Tables with more rows are broken over pages.
const LONG: usize = 20;

/// A fragment to paste into a document.
pub fn fragment(document: &Document) -> String {
    let figures = document.has_figures();
    let mut out = format!(
        "% Made by denavit {}; needs amsmath and amssymb{}.\n\\section*{{{}}}\n",
        env!("CARGO_PKG_VERSION"),
        if figures { ", and tikz for figures" } else { "" },
        escaped(&document.title)
    );
    for section in &document.spelled() {
        parts(section, document.language.words(), "*", &mut out);
    }
    out
}

/// A document of its own.
pub fn whole(document: &Document) -> String {
    let mut out = format!(
        "% Made by denavit {}.\n\\documentclass[10pt,a4paper]{{article}}\n\
         \\usepackage[margin=2.2cm]{{geometry}}\n\\usepackage{{amsmath,amssymb,longtable,tikz}}\n\
         \\allowdisplaybreaks\n\\setcounter{{MaxMatrixCols}}{{20}}\n\\setcounter{{secnumdepth}}{{1}}\n\\setlength{{\\parindent}}{{0pt}}\n\\setlength{{\\parskip}}{{4pt}}\n\\sloppy\n\\makeatletter\\@beginparpenalty=10000\\makeatother\n",
        env!("CARGO_PKG_VERSION")
    );
    out += &language(document.language.words());
    let _ = writeln!(
        out,
        "\\title{{{}}}\n\\date{{}}\n\\author{{{}}}\n\\begin{{document}}\n\\maketitle\n",
        escaped(&document.title),
        escaped(document.author.as_deref().unwrap_or_default())
    );
    for section in &document.spelled() {
        parts(section, document.language.words(), "", &mut out);
    }
    out + "\\end{document}\n"
}

/// Hyphenation, and the names of tables and figures. What an installation may lack is asked for first: most have babel for
/// English alone, and letters with accents as letters, where words are to be hyphenated at all, with one more font.
fn language(words: &dyn Wording) -> String {
    let Some([name, options]) = words.babel() else { return String::new() };
    format!(
        "\\IfFileExists{{lmodern.sty}}{{\\usepackage{{lmodern}}\\usepackage[T1]{{fontenc}}}}{{}}\n\
         \\IfFileExists{{{name}.ldf}}{{\\usepackage[{options}]{{babel}}\\usetikzlibrary{{babel}}}}{{}}\n\
         \\AtBeginDocument{{\\renewcommand{{\\tablename}}{{{}}}\\renewcommand{{\\figurename}}{{{}}}}}\n",
        escaped(words.table()),
        escaped(words.figure())
    )
}

fn parts(section: &Section, said: &dyn Wording, star: &str, out: &mut String) {
    for (k, part) in section.parts.iter().enumerate() {
        match part {
            Part::Block(Block::Paragraph(line)) if part.introduces(section.parts.get(k + 1)) => {
                let _ = writeln!(out, "\n\\noindent {}\\par\\nobreak", words(line, &section.names));
            }
            Part::Block(of) => block(of, &section.names, said, star, out),
            Part::Equations(all) => equations(all, &section.names, out),
            Part::Beside(all) => beside(all, section, said, star, out),
            Part::Summary(rows) => summary(rows, &section.names, out),
            Part::Table(of) => table(of, &section.names, out),
            Part::Figure(of) => pictures(of, &section.names, out),
            Part::Code(text) => code(text, out),
        }
    }
}

/// Formulas beside each other; one that does not fit the page at all stands alone.
fn beside(all: &[Math], section: &Section, said: &dyn Wording, star: &str, out: &mut String) {
    for row in layout::beside(all, &section.names) {
        match row[..] {
            [one] => {
                let formula = Block::Formula { math: one.clone(), number: None, proof: None };
                block(&formula, &section.names, said, star, out);
            }
            _ => {
                let set = row.iter().map(|m| math(m, &section.names, Style::Latex));
                let _ = writeln!(out, "\\[ {} \\]", set.collect::<Vec<_>>().join(" \\qquad "));
            }
        }
    }
}

fn block(block: &Block, names: &Vocabulary, said: &dyn Wording, star: &str, out: &mut String) {
    if let Some(named) = named(block, names) {
        self::block(&named.matrix, &named.names, said, star, out);
        return equations(&named.entries, &named.names, out);
    }
    match block {
        Block::Heading(level, line) => {
            // The title of a document is no section of it, but that of a fragment is.
            let level = usize::from(*level).clamp(1, 3) - usize::from(star.is_empty() && *level > 1);
            let command = ["section", "subsection", "subsubsection"][level - 1];
            let _ = writeln!(out, "\\{command}{star}{{{}}}", words(line, names));
        }
        Block::Paragraph(line) => {
            let _ = writeln!(out, "\n\\noindent {}\n", words(line, names));
        }
        Block::Formula { math, number, proof } => {
            let wrong = |word: &str| format!(" \\quad\\textbf{{{word}}}");
            let mark = mark(*proof, said, [" \\quad\\checkmark", " \\quad\\approx"], wrong);
            let tag = number.map(|n| format!(" \\tag{{{n}}}")).unwrap_or_default();
            let laid = display(math, names, Style::Latex);
            let formula = match &laid.lines[..] {
                [one] => laid.left.clone() + &one.text,
                _ => rows(&laid),
            };
            let environment = if laid.lines.len() > 1 { "align*" } else { "equation*" };
            let _ = writeln!(out, "\\begin{{{environment}}}\n{formula}{mark}{tag}\n\\end{{{environment}}}");
        }
        Block::List(lines) => {
            out.push_str("\\begin{itemize}\n");
            for line in lines {
                let _ = writeln!(out, "  \\item {}", words(line, names));
            }
            out.push_str("\\end{itemize}\n");
        }
        Block::Tree(branch) => tree(branch, names, out),
    }
}

/// LaTeX nests four lists at most; what is deeper is set in one line each.
fn tree(branch: &crate::document::Branch, names: &Vocabulary, out: &mut String) {
    nested(branch, &mut |item| {
        let _ = match item {
            Item::Open(depth) if depth < 4 => {
                writeln!(out, "{}\\begin{{itemize}}\\setlength{{\\itemsep}}{{0pt}}", "  ".repeat(depth))
            }
            Item::Close(depth) if depth < 4 => writeln!(out, "{}\\end{{itemize}}", "  ".repeat(depth)),
            Item::Entry(depth, line) => {
                let indent = format!("\\hspace*{{{}em}}", 2 * depth.saturating_sub(3));
                let indent = if depth < 4 { "" } else { indent.as_str() };
                writeln!(out, "{}  \\item {indent}{}", "  ".repeat(depth), words(line, names))
            }
            Item::Open(_) | Item::Close(_) | Item::Done => Ok(()),
        };
    });
}

/// Lines, with the place where they are aligned.
pub(super) fn rows(laid: &Laid) -> String {
    let line = |(k, line): (usize, &BrokenLine)| {
        let indent = "\\quad".repeat(line.depth);
        let left = if k == 0 { laid.left.as_str() } else { "" };
        let text = line.text.trim_start();
        // A sign at the start of a line stands between two addends.
        let sign = if k > 0 && text.starts_with(['+', '-']) { "{}" } else { "" };
        format!("{left} &{indent} {sign}{text}")
    };
    laid.lines.iter().enumerate().map(line).collect::<Vec<_>>().join(" \\\\\n")
}

fn equations(all: &[Math], names: &Vocabulary, out: &mut String) {
    let lines: Vec<String> = all.iter().map(|m| rows(&equation(m, names, Style::Latex))).collect();
    if !lines.is_empty() {
        let _ = writeln!(out, "\\begin{{align*}}\n{}\n\\end{{align*}}", lines.join(" \\\\\n"));
    }
}

fn words(line: &Line, names: &Vocabulary) -> String {
    let piece = |p: &Piece| match p {
        Piece::Text(t) => escaped(t),
        Piece::Strong(t) => format!("\\textbf{{{}}}", escaped(t)),
        Piece::Math(m) => {
            let parts = inline(m, names, Style::Latex).into_iter().enumerate();
            let set = |(k, part): (usize, String)| {
                let part = part.trim();
                if k == 0 { format!("${part}$") } else { format!("${{}}{part}$") }
            };
            parts.map(set).collect::<Vec<_>>().join(" ")
        }
    };
    line.0.iter().map(piece).collect()
}

fn summary(rows: &[(Line, Line)], names: &Vocabulary, out: &mut String) {
    out.push_str("\\noindent\\fbox{\\begin{tabular}{p{0.22\\textwidth}p{0.70\\textwidth}}\n");
    for (label, value) in rows {
        let _ = writeln!(out, "\\textbf{{{}}} & {} \\\\", words(label, names), words(value, names));
    }
    out.push_str("\\end{tabular}}\n\n");
}

/// A box that stays where it is, with a number and a caption.
fn fixed(kind: &str, caption: &str, above: bool, body: &str, out: &mut String) {
    let caption = format!("\\refstepcounter{{{kind}}}\\{kind}name~\\the{kind}. {caption}\\par");
    let (first, second) = if above { (caption.as_str(), body) } else { (body, caption.as_str()) };
    let _ = writeln!(
        out,
        "\\par\\medskip\\noindent\\begin{{minipage}}{{\\textwidth}}\\centering\n{first}\n\\smallskip\n{second}\n\\end{{minipage}}\n\\par\\medskip\n"
    );
}

fn table(table: &Table, names: &Vocabulary, out: &mut String) {
    let cells = |row: &Vec<Line>| row.iter().map(|c| words(c, names)).collect::<Vec<_>>().join(" & ");
    let size =
        if table.head.len() > WIDE { "\\footnotesize\\setlength{\\tabcolsep}{3pt}" } else { "\\small" };
    let rows: String = table.rows.iter().map(|row| cells(row) + " \\\\\n").collect();
    let columns: String = shares(table, names).into_iter().map(column).collect();
    let (caption, head) = (words(&table.caption, names), cells(&table.head));
    if table.rows.len() > LONG {
        let _ = writeln!(
            out,
            "{{{size}\n\\begin{{longtable}}{{{columns}}}\n\\caption{{{caption}}}\\\\ \\hline\n{head} \\\\ \\hline\n\\endhead\n{rows}\\hline\n\\end{{longtable}}}}\n"
        );
        return;
    }
    let body = format!(
        "{size}\\begin{{tabular}}{{{columns}}}\n\\hline\n{head} \\\\ \\hline\n{rows}\\hline\n\\end{{tabular}}"
    );
    fixed("table", &caption, true, &body, out);
}

fn column(share: Option<f64>) -> String {
    match share {
        None => "c".into(),
        Some(share) => format!("p{{{share:.3}\\textwidth}}"),
    }
}

fn pictures(figure: &Figure, names: &Vocabulary, out: &mut String) {
    let across = columns(figure.pictures.len());
    let mut body = String::new();
    for (k, (drawing, caption)) in figure.pictures.iter().enumerate() {
        let picture = tikz(drawing);
        if figure.pictures.len() == 1 {
            body.push_str(&picture);
            continue;
        }
        let end = if k % across == across - 1 { "\\\\[6pt]" } else { "\\hfill" };
        let _ = writeln!(
            body,
            "\\begin{{minipage}}[t]{{{:.3}\\textwidth}}\\centering\n{picture}\\\\[2pt]\n\\small {}\n\\end{{minipage}}{end}",
            0.98 / across as f64 - 0.005,
            words(caption, names)
        );
    }
    fixed("figure", &words(&figure.caption, names), false, &body, out);
}

/// In typewriter letters, line by line, every character escaped.
fn code(text: &str, out: &mut String) {
    out.push_str("\\begin{flushleft}\\ttfamily\\footnotesize\n");
    for line in text.lines() {
        let blanks = line.len() - line.trim_start().len();
        let line = escaped(line.trim_start()).replace("  ", "~~");
        let _ = writeln!(out, "\\mbox{{}}{}{line}\\\\", "~".repeat(blanks));
    }
    out.push_str("\\end{flushleft}\n");
}

/// Text outside of formulas, for pdfTeX and its usual fonts.
pub fn escaped(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '\\' => out.push_str("\\textbackslash{}"),
            '~' => out.push_str("\\textasciitilde{}"),
            '^' => out.push_str("\\textasciicircum{}"),
            '<' => out.push_str("\\textless{}"),
            '>' => out.push_str("\\textgreater{}"),
            '|' => out.push_str("\\textbar{}"),
            '"' => out.push_str("''"),
            '#' | '$' | '%' | '&' | '_' | '{' | '}' => out.extend(['\\', c]),
            // Behind the end of a row they would be its arguments.
            '[' | ']' | '*' => out.extend(['{', c, '}']),
            '\u{a0}' => out.push('~'),
            '\u{200b}' => out.push_str("\\allowbreak{}"),
            '–' => out.push_str("--"),
            '—' => out.push_str("---"),
            '’' => out.push('\''),
            '„' => out.push_str(",,"),
            '“' | '«' => out.push_str("``"),
            '”' | '»' => out.push_str("''"),
            ' '..='~' => out.push(c),
            c if c.is_control() => out.push(' '),
            c => match symbol(c) {
                Some(command) => out.push_str(&command),
                None => {
                    let _ = write!(out, "{{[}}U+{:04X}{{]}}", u32::from(c));
                }
            },
        }
    }
    out
}

/// A character that the fonts have only as a command.
fn symbol(c: char) -> Option<String> {
    let maths = |command: &str| Some(format!("${command}$"));
    if let Some(name) = greek::name(c) {
        return maths(&format!("\\{name}"));
    }
    match c {
        'π' => maths("\\pi"),
        // Letters with accents, as the fonts and the input encoding know them.
        'À'..='ÿ' if !matches!(c, '×' | '÷' | 'Ð' | 'ð' | 'Þ' | 'þ') => Some(c.to_string()),
        'œ' => Some("{\\oe}".into()),
        'Œ' => Some("{\\OE}".into()),
        '✓' => maths("\\checkmark"),
        '≈' => maths("\\approx"),
        '−' => maths("-"),
        '·' => maths("\\cdot"),
        '→' => maths("\\to"),
        '⟂' => maths("\\perp"),
        '∥' => maths("\\parallel"),
        '∠' => maths("\\angle"),
        '≡' => maths("\\equiv"),
        '±' => maths("\\pm"),
        '×' => maths("\\times"),
        '≤' => maths("\\leq"),
        '≥' => maths("\\geq"),
        '≠' => maths("\\neq"),
        '°' => maths("^{\\circ}"),
        '√' => maths("\\surd"),
        'ẋ' => maths("\\dot{x}"),
        '∞' => maths("\\infty"),
        '…' => Some("\\ldots{}".into()),
        '‖' => maths("\\|"),
        'ᵀ' => maths("^{T}"),
        '⁻' => maths("^{-}"),
        _ => {
            let find = |digits: &str| digits.chars().position(|d| d == c);
            find("⁰¹²³⁴⁵⁶⁷⁸⁹")
                .map(|n| format!("$^{{{n}}}$"))
                .or_else(|| find("₀₁₂₃₄₅₆₇₈₉").map(|n| format!("$_{{{n}}}$")))
        }
    }
}
