//! A document as text of bounded width.

use crate::tree::{Block, Branch, Factor, Line, Math, Piece, Proof, math};
use crate::words::{Tongue, Wording};
use denavit_symbolic::Expr;
use denavit_symbolic::print::Style;
use denavit_symbolic::vocabulary::Vocabulary;

/// What a part of a text is, for colours.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Mark {
    /// A heading.
    Heading,
    /// Words that stand out.
    Strong,
    /// What stands back.
    Faint,
}

/// Characters of a line.
const WIDTH: usize = 104;
/// Where the numbers of formulas end.
const NUMBER: usize = 96;

/// The document; `mark` may colour parts, without changing their width. `language` is that of the document.
pub fn text(
    blocks: &[Block],
    names: &Vocabulary,
    language: Tongue,
    mark: &dyn Fn(Mark, &str) -> String,
) -> String {
    let names = &language.spelled(names);
    let writer = Writer { names, words: language.words(), mark };
    let mut out = String::new();
    for block in blocks {
        match block {
            Block::Heading(level, line) => {
                if *level > 1 {
                    out.push('\n');
                }
                out += &(writer.mark)(Mark::Heading, &writer.plain(line));
                out.push('\n');
            }
            Block::Paragraph(line) => out += &writer.wrapped(line, "  ", "  "),
            Block::List(lines) => {
                for line in lines {
                    out += &writer.wrapped(line, "  - ", "    ");
                }
            }
            Block::Formula { math: Math::Matrix(name, rows), number: None, proof } => {
                let tail = writer.sign(*proof);
                out += &writer.matrix(name, rows, tail);
            }
            Block::Formula { math: m, number, proof } => {
                let formula = math(m, names, Style::Unicode);
                let tail = match (number, proof) {
                    (Some(n), None) => format!("({n})"),
                    (Some(n), Some(_)) => format!("({n}) {}", writer.sign(*proof)),
                    (None, Some(_)) => format!("   {}", writer.sign(*proof)),
                    (None, None) => String::new(),
                };
                let mut lines = broken(&formula, WIDTH - 8);
                let last = lines.pop().unwrap_or_default();
                for line in lines {
                    out += &format!("      {line}\n");
                }
                let space = NUMBER.saturating_sub(6 + last.chars().count() + tail.chars().count());
                let tail = if tail.is_empty() {
                    tail
                } else {
                    " ".repeat(space.max(2)) + &(writer.mark)(Mark::Faint, &tail)
                };
                out += &format!("      {last}{tail}\n");
            }
            Block::Tree(branch) => writer.tree(branch, &mut out),
        }
    }
    out
}

/// A line as text that is not wrapped.
pub fn plain(line: &Line, names: &Vocabulary) -> String {
    let piece = |piece: &Piece| match piece {
        Piece::Text(t) | Piece::Strong(t) => t.clone(),
        Piece::Math(m) => math(m, names, Style::Unicode),
    };
    line.0.iter().map(piece).collect()
}

/// A long formula in lines, broken before signs outside of brackets.
fn broken(formula: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = vec![];
    let mut line: Vec<char> = vec![];
    let mut depth = 0_i32;
    let mut breaks: Vec<(usize, i32)> = vec![];
    let all: Vec<char> = formula.chars().collect();
    for (k, &c) in all.iter().enumerate() {
        depth += i32::from(c == '(') - i32::from(c == ')');
        let is_sign = matches!(c, '+' | '−' | '=' | '≤');
        if is_sign && k > 0 && all[k - 1] == ' ' && all.get(k + 1) == Some(&' ') {
            breaks.push((line.len(), depth));
        }
        line.push(c);
        if line.len() > width {
            // The outermost place, of those the last in the second half.
            let usable = breaks.iter().filter(|b| b.0 > width / 3 && b.0 <= width);
            let Some(&(at, _)) = usable.min_by_key(|b| (b.1, std::cmp::Reverse(b.0))) else { continue };
            let rest: Vec<char> = line.split_off(at);
            lines.push(line.iter().collect::<String>().trim_end().to_string());
            line = "    ".chars().chain(rest).collect();
            breaks = breaks.into_iter().filter(|b| b.0 > at).map(|(b, d)| (b - at + 4, d)).collect();
        }
    }
    lines.push(line.into_iter().collect());
    lines
}

struct Writer<'a> {
    names: &'a Vocabulary,
    words: &'static dyn Wording,
    mark: &'a dyn Fn(Mark, &str) -> String,
}

impl Writer<'_> {
    fn sign(&self, proof: Option<Proof>) -> &'static str {
        proof.map(|p| self.words.mark(p)).unwrap_or_default()
    }

    /// A matrix in aligned columns; one that is too wide entry by entry, without those that are 0.
    fn matrix(&self, name: &Factor, rows: &[Vec<Expr>], tail: &str) -> String {
        let name = math(&Math::Product(vec![name.clone()]), self.names, Style::Unicode);
        let cell = |&e: &Expr| math(&Math::Expr(e), self.names, Style::Unicode);
        let cells: Vec<Vec<String>> = rows.iter().map(|row| row.iter().map(cell).collect()).collect();
        let columns = rows.first().map_or(0, Vec::len);
        let width = |c: usize| cells.iter().map(|row| row[c].chars().count()).max().unwrap_or(0);
        let widths: Vec<usize> = (0..columns).map(width).collect();
        let tail =
            if tail.is_empty() { String::new() } else { format!("   {}", (self.mark)(Mark::Faint, tail)) };
        let mut out = String::new();
        if widths.iter().sum::<usize>() + 2 * columns + name.chars().count() + 12 > WIDTH {
            for (r, row) in cells.iter().enumerate() {
                for (c, entry) in row.iter().enumerate().filter(|(_, entry)| *entry != "0") {
                    let between = if columns > 9 { "," } else { "" };
                    out += &format!("      {name}{}{between}{} = {entry}\n", r + 1, c + 1);
                }
            }
            if cells.iter().flatten().all(|entry| entry != "0") {
                return if tail.is_empty() { out } else { format!("{out}   {tail}\n") };
            }
            let rest = self.words.other_entries_vanish();
            return format!("{out}      ({rest}){tail}\n");
        }
        for (r, row) in cells.iter().enumerate() {
            let (open, close) = match (r, cells.len()) {
                (_, 1) => ('[', ']'),
                (0, _) => ('⎡', '⎤'),
                (r, n) if r + 1 == n => ('⎣', '⎦'),
                _ => ('⎢', '⎥'),
            };
            let is_middle = r == cells.len().saturating_sub(1) / 2;
            let front = if is_middle { format!("{name} = ") } else { " ".repeat(name.chars().count() + 3) };
            let padded = row.iter().zip(&widths).map(|(text, w)| format!("{text:<w$}"));
            let line = padded.collect::<Vec<_>>().join("  ");
            out += &format!(
                "      {front}{open} {line} {close}{}\n",
                if is_middle { tail.as_str() } else { "" }
            );
        }
        out
    }

    fn plain(&self, line: &Line) -> String {
        plain(line, self.names)
    }

    /// Words that stay together, with what they are.
    fn wrapped(&self, line: &Line, first: &str, next: &str) -> String {
        // A formula does not break unless it is long; text breaks at blanks.
        let mut words: Vec<(String, Option<Mark>, bool)> = vec![];
        let mut glued = true;
        for piece in &line.0 {
            let (text, mark) = match piece {
                Piece::Text(t) => (t.clone(), None),
                Piece::Strong(t) => (t.clone(), Some(Mark::Strong)),
                Piece::Math(m) => (math(m, self.names, Style::Unicode), None),
            };
            if matches!(piece, Piece::Math(_)) && text.chars().count() < WIDTH / 2 {
                words.push((text, mark, glued));
                glued = true;
                continue;
            }
            if text.is_empty() {
                continue;
            }
            let starts = text.starts_with(' ');
            for (k, word) in text.split(' ').filter(|w| !w.is_empty()).enumerate() {
                words.push((word.to_string(), mark, k == 0 && glued && !starts));
            }
            glued = !text.ends_with(' ');
        }
        let mut out = String::new();
        let (mut at, mut start) = (0, first);
        let mut k = 0;
        while k < words.len() {
            let mut end = k + 1;
            while end < words.len() && words[end].2 {
                end += 1;
            }
            let width: usize = words[k..end].iter().map(|w| w.0.chars().count()).sum();
            if at == 0 {
                out += start;
                at = start.chars().count();
            } else if at + 1 + width > WIDTH {
                out.push('\n');
                start = next;
                out += start;
                at = start.chars().count();
            } else {
                out.push(' ');
                at += 1;
            }
            for (word, mark, _) in &words[k..end] {
                out += &mark.map_or_else(|| word.clone(), |m| (self.mark)(m, word));
            }
            at += width;
            k = end;
        }
        out.push('\n');
        out
    }

    fn tree(&self, branch: &Branch, out: &mut String) {
        let line = self.plain(&branch.line);
        if !line.is_empty() {
            *out += &format!("      {line}\n");
        }
        self.children(branch, "      ", out);
    }

    fn children(&self, branch: &Branch, indent: &str, out: &mut String) {
        for (k, child) in branch.children.iter().enumerate() {
            let last = k + 1 == branch.children.len();
            let (corner, bar) = if last { ("└─ ", "   ") } else { ("├─ ", "│  ") };
            *out += &format!("{indent}{corner}{}\n", self.plain(&child.line));
            self.children(child, &format!("{indent}{bar}"), out);
        }
    }
}
