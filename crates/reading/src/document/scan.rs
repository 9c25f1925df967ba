//! Where the formulas of a document stand: between `$`, in environments and fences, on lines of their own.

use super::lexer::{Kind, lex};
use super::lines::{Lead, goes_on, is_foreign, is_rule, lead, line, trimmed};
use super::statements::{Manner, Reader};
use super::{CodeBlock, Format, MAX_FORMULA, Place, cut, drawn, prose, words};
use std::ops::Range;

/// The most lines that one formula without marks may have.
const MOST_LINES: usize = 400;

/// LaTeX environments without statements.
const SKIPPED: [&str; 12] = [
    "tabular",
    "tabular*",
    "tabularx",
    "longtable",
    "tabulary",
    "tikzpicture",
    "comment",
    "thebibliography",
    "verbatim",
    "lstlisting",
    "minted",
    "filecontents",
];

pub(super) fn read(reader: &mut Reader, format: Format) {
    let text = reader.text;
    let mut start = usize::from(text.starts_with('\u{feff}')) * 3;
    let (mut end, mut bare) = (text.len(), true);
    if format == Format::Markdown {
        start = behind_front_matter(text, start);
    }
    if format == Format::Latex {
        const BEGIN: &str = "\\begin{document}";
        if let Some(begin) = text.find(BEGIN) {
            start = begin + BEGIN.len();
            end = text.get(start..).and_then(|t| t.find("\\end{document}")).map_or(end, |i| start + i);
        }
        bare = !text.contains("\\documentclass") && start == 0;
    }
    let style = Style {
        marks: format == Format::Markdown,
        dollars: true,
        latex: format == Format::Latex,
        sums: format == Format::Plain,
        bare,
    };
    Scanner { reader, style, missing: vec![], quotes: [0; 4] }.lines(start..end);
}

/// What counts as a mark.
#[derive(Clone, Copy)]
pub(super) struct Style {
    /// Headings, fences, tables and backquotes of Markdown.
    pub marks: bool,
    /// `$…$`
    pub dollars: bool,
    pub latex: bool,
    /// Sums may be left sides of lines on their own.
    pub sums: bool,
    /// Lines without marks are read.
    pub bare: bool,
}

pub(super) struct Scanner<'r, 't> {
    pub reader: &'r mut Reader<'t>,
    pub style: Style,
    /// What does not occur any more from here on.
    pub missing: Vec<String>,
    /// Up to where no run of so many backquotes is closed.
    pub quotes: [usize; 4],
}

fn behind_front_matter(text: &str, start: usize) -> usize {
    for fence in ["---", "+++"] {
        let (first, mut at) = line(text, start, text.len());
        if cut(text, &first).trim_end() != fence {
            continue;
        }
        for _ in 0..500 {
            let (span, next) = line(text, at, text.len());
            if cut(text, &span).trim_end() == fence {
                return next;
            }
            if next <= at {
                break;
            }
            at = next;
        }
    }
    start
}

impl<'t> Scanner<'_, 't> {
    pub(super) fn text(&self) -> &'t str {
        self.reader.text
    }

    pub(super) fn manner(&self, place: Place) -> Manner {
        Manner { place, lines: place == Place::Line, sums: self.style.sums }
    }

    fn lines(&mut self, range: Range<usize>) {
        let (mut at, limit) = (range.start, range.end);
        while at < limit && !self.reader.full() {
            let (span, next) = line(self.text(), at, limit);
            let shown = cut(self.text(), &span);
            let after = if shown.trim().is_empty() {
                Some(next)
            } else if self.style.marks {
                self.markdown_block(&span, next, limit)
            } else if self.style.latex {
                self.latex_block(&span, next, limit)
            } else {
                None
            };
            at = match after {
                Some(after) => after,
                None => self.line(span, next, limit),
            }
            .max(at + 1);
        }
    }

    /// Fences, headings, tables and comments; where the line behind it begins.
    fn markdown_block(&mut self, span: &Range<usize>, next: usize, limit: usize) -> Option<usize> {
        let text = self.text();
        let shown = cut(text, span).trim();
        let (following, _) = line(text, next, limit);
        if let Some(fence) = ["```", "~~~"].iter().find(|f| shown.starts_with(*f)) {
            let mark = fence.chars().next()?;
            let length = shown.chars().take_while(|&c| c == mark).count();
            // ```` ``` x = y ``` ```` is a formula in a line.
            if !shown.get(length..)?.contains(mark) {
                return Some(self.fence(shown, mark, length, next, limit));
            }
        }
        let level = shown.bytes().take_while(|&b| b == b'#').count();
        if (1..=6).contains(&level)
            && shown.get(level..).is_some_and(|r| r.is_empty() || r.starts_with([' ', '\t']))
        {
            let heading = trimmed(text, span);
            let start = heading.start + level;
            self.headed(trimmed(text, &(start..heading.end)), limit);
            return Some(next);
        }
        let under = cut(text, &following).trim();
        if is_rule(shown) {
            return Some(next);
        }
        let ruled = under.contains('-') && under.contains('|') && under.chars().all(|c| "|-: \t".contains(c));
        if shown.contains('|') && ruled {
            let manner = self.manner(Place::Display);
            return Some(drawn::table(self.reader, span.start, limit, manner));
        }
        let bars = shown.bytes().filter(|&b| b == b'|').count();
        if shown.starts_with('|') && shown.ends_with('|') && bars > 2 && !shown.contains('=') {
            let manner = self.manner(Place::Display);
            return Some(drawn::table(self.reader, span.start, limit, manner));
        }
        if is_rule(under) && !shown.contains(['$', '`', '=']) {
            self.headed(trimmed(text, span), limit);
            return Some(next);
        }
        // `[name]: https://…`
        (shown.starts_with('[') && shown.contains("]: ")).then_some(next)
    }

    /// A heading, with the formulas in it.
    fn headed(&mut self, span: Range<usize>, limit: usize) {
        (self.reader.prose, self.reader.label) = (None, None);
        self.reader.heading = Some(span.clone());
        if cut(self.text(), &span).contains('$') {
            self.line(span.clone(), span.end, limit);
            (self.reader.prose, self.reader.label) = (None, None);
        }
    }

    /// A fence whose first line was read.
    fn fence(&mut self, first: &str, mark: char, length: usize, start: usize, limit: usize) -> usize {
        let text = self.text();
        let (mut at, mut end) = (start, limit);
        let mut after = limit;
        while at < limit {
            let (span, next) = line(text, at, limit);
            let shown = cut(text, &span).trim();
            if shown.chars().count() >= length && shown.chars().all(|c| c == mark) {
                (end, after) = (span.start, next);
                break;
            }
            at = next.max(at + 1);
        }
        let info = first.trim_start_matches(mark).trim_start().trim_start_matches(['{', '.']);
        let language: String =
            info.chars().take_while(|c| c.is_alphanumeric() || "+-_".contains(*c)).collect();
        let language = language.to_lowercase();
        let content = start..end;
        let shown = cut(text, &content);
        match language.as_str() {
            "math" | "latex" | "tex" | "katex" if !["$", "\\[", "\\("].iter().any(|m| shown.contains(m)) => {
                self.reader.fences.push(content.clone());
                let manner = self.manner(Place::Display);
                self.reader.region(content, manner);
            }
            "" | "text" | "txt" | "plain" | "plaintext" | "math" | "latex" | "tex" | "katex" | "equation" => {
                self.reader.fences.push(content.clone());
                let tex = matches!(language.as_str(), "latex" | "tex" | "math" | "katex");
                let inner = Style { marks: false, dollars: tex, latex: tex, sums: true, bare: true };
                let outer = std::mem::replace(&mut self.style, inner);
                // What is missing in the fence may stand behind it.
                let missing = std::mem::take(&mut self.missing);
                self.lines(content);
                (self.style, self.missing) = (outer, missing);
            }
            _ => self.reader.code.push(CodeBlock { span: content, language, directives: vec![] }),
        }
        after
    }

    /// Headings and environments that are skipped.
    fn latex_block(&mut self, span: &Range<usize>, next: usize, limit: usize) -> Option<usize> {
        let text = self.text();
        let shown = cut(text, span).trim();
        let command = shown.strip_prefix('\\')?;
        for heading in ["section", "subsection", "subsubsection", "chapter", "paragraph", "title"] {
            let Some(rest) = command.strip_prefix(heading) else { continue };
            let rest = rest.strip_prefix('*').unwrap_or(rest);
            if rest.starts_with('{') {
                let end = trimmed(text, span).end;
                let inner = end - rest.len() + 1..end;
                let close = closing_brace(cut(text, &inner)).map_or(inner.end, |i| inner.start + i);
                self.headed(inner.start..close, limit);
                // `\paragraph{Position.} Given $o$ …`: the text begins on its line.
                let rest = (close + 1).min(end)..end;
                let is_label = cut(text, &rest).trim_start().starts_with("\\label");
                if !is_label && has_letters(text, &rest) {
                    return Some(self.line(rest, next, limit));
                }
                return Some(next);
            }
        }
        for defining in
            ["newcommand", "renewcommand", "def\\", "usepackage", "set", "include", "input", "graphicspath"]
        {
            if command.starts_with(defining) {
                return Some(next);
            }
        }
        let name = command.strip_prefix("begin{")?;
        let name = SKIPPED.iter().find(|s| name.strip_prefix(**s).is_some_and(|r| r.starts_with('}')))?;
        let start = trimmed(text, span).start;
        let Some(end) = self.end_of(name, start, limit) else { return Some(next) };
        if matches!(*name, "lstlisting" | "minted") {
            let language = shown.split("language=").nth(1).or(shown.rsplit('{').next()).unwrap_or("");
            let language =
                language.chars().take_while(|c| c.is_alphanumeric()).collect::<String>().to_lowercase();
            self.reader.code.push(CodeBlock {
                span: next..end.start.max(next),
                language,
                directives: vec![],
            });
        }
        Some(line(text, end.end, limit).1)
    }

    /// The next `\end{name}`.
    pub(super) fn end_of(&mut self, name: &str, from: usize, limit: usize) -> Option<Range<usize>> {
        self.next(&format!("\\end{{{name}}}"), from, limit)
    }

    /// The next place of `mark`. What was not found once is not looked for again.
    pub(super) fn next(&mut self, mark: &str, from: usize, limit: usize) -> Option<Range<usize>> {
        if self.missing.iter().any(|m| m == mark) {
            return None;
        }
        let at = self.text().get(from..limit).and_then(|t| t.find(mark));
        if at.is_none() {
            self.missing.push(mark.to_string());
        }
        at.map(|at| from + at..from + at + mark.len())
    }

    /// A line with formulas between marks, or one on its own, or prose. Where the line behind it begins.
    fn line(&mut self, span: Range<usize>, next: usize, limit: usize) -> usize {
        let text = self.text();
        let lead = lead(text, &span);
        let (mut cursor, mut end, mut next) = (lead.rest.min(span.end), span.end, next);
        let (mut marked, mut letters) = (false, has_letters(text, &(span.start..cursor)));
        while cursor < end {
            let Some(mark) = self.mark(cursor, end) else { break };
            letters |= has_letters(text, &(cursor..mark));
            if !marked && lead.label.is_some() && cut(text, &(lead.rest..mark)).trim().is_empty() {
                self.reader.label = lead.label.clone();
            } else if letters {
                self.reader.prose = Some(trimmed(text, &(span.start..mark)));
                self.reader.label = None;
            }
            let (after, formula) = self.marked(mark, limit);
            marked |= formula;
            cursor = after.max(mark + 1);
            if cursor > end {
                let (rest, following) = line(text, cursor, limit);
                (end, next) = (rest.end, following);
            }
            if self.reader.full() {
                return next;
            }
        }
        if marked {
            if has_letters(text, &(cursor.min(end)..end)) {
                self.reader.prose = Some(trimmed(text, &span));
                self.reader.label = None;
            }
            return next;
        }
        if self.style.bare
            && let Some(after) = self.bare(&span, &lead, next, limit)
        {
            return after;
        }
        if has_letters(text, &span) {
            self.reader.prose = Some(trimmed(text, &span));
            if self.style.bare && !is_foreign(cut(text, &span)) {
                let manner = self.manner(Place::Inline);
                for formula in prose::formulas(text, &(lead.rest.min(span.end)..span.end)) {
                    self.reader.region(formula, manner);
                }
            }
            if !is_foreign(cut(text, &span)) {
                let manner = self.manner(Place::Told);
                for tuple in prose::tuples(text, &span) {
                    self.reader.region(tuple, manner);
                }
            }
            // `t22:` alone labels what follows.
            let alone = cut(text, &(lead.rest.min(span.end)..span.end)).trim().is_empty();
            self.reader.label = lead.label.filter(|_| alone);
        }
        next
    }

    /// A statement that stands alone on its line, with the lines that go on with it. Where the line behind begins.
    fn bare(&mut self, span: &Range<usize>, lead: &Lead, next: usize, limit: usize) -> Option<usize> {
        let text = self.text();
        let shown = cut(text, span);
        if shown.len() > MAX_FORMULA {
            return None;
        }
        let (mut following, mut after) = line(text, next, limit);
        let mut manner = self.manner(Place::Line);
        if drawn::begins(text, span, &following) {
            return Some(drawn::read(self.reader, span.start, limit, self.manner(Place::Display)));
        }
        let content = lead.rest.min(span.end)..span.end;
        let tokens = lex(text, &content);
        let related = tokens.iter().any(|t| matches!(t.kind, Kind::Relation(_)));
        let opens = tokens.iter().any(|t| matches!(t.kind, Kind::Begin(_)));
        let chain =
            cut(text, &following).trim_start().starts_with('=') && !is_rule(cut(text, &following).trim());
        if tokens.is_empty() || !(related || opens || chain) || is_foreign(shown) {
            return None;
        }
        if opens {
            manner.place = Place::Display;
        } else {
            let left = tokens.iter().find(|t| matches!(t.kind, Kind::Relation(_)));
            let left = content.start..left.map_or(content.end, |t| t.span.start);
            let label = words::is_left_side(text, &trimmed(text, &left), self.style.sums || !related);
            let bracket = chain && !words::is_prose(text, &content);
            let begins = tokens.first().is_some_and(|t| matches!(t.kind, Kind::Relation(_)));
            // Several statements on a line are looked at one by one.
            if words::is_prose(text, &content) || !(label || bracket || begins) {
                return None;
            }
        }
        let mut depth = words::open_brackets(&tokens);
        let mut last = tokens.last().map(|t| (t.kind, cut(text, &t.span)));
        let (mut end, mut behind) = (span.end, next);
        let mut skipped = false;
        for _ in 0..MOST_LINES {
            if behind >= limit || following.end - span.start > MAX_FORMULA {
                break;
            }
            let waits = matches!(last, Some((Kind::Relation(_), _)));
            let open = waits || matches!(last, Some((Kind::Operator, o)) if o != ".");
            let line_shown = cut(text, &following).trim();
            if line_shown.is_empty() {
                let (over, further) = line(text, after, limit);
                let matrix = cut(text, &over).trim_start().starts_with(['[', '{', '(']);
                if !(waits && matrix && !skipped && depth == 0)
                    || drawn::begins(text, &over, &line(text, further, limit).0)
                {
                    break;
                }
                skipped = true;
                (behind, following, after) = (after, over, further);
                continue;
            }
            let (second, _) = line(text, after, limit);
            if waits && (line_shown.starts_with(['|', '$']) || drawn::begins(text, &following, &second)) {
                break;
            }
            if !(depth > 0 || open || goes_on(text, &following, lead.bullet)) {
                break;
            }
            let more = lex(text, &following);
            for token in &more {
                match token.kind {
                    Kind::Open(_) | Kind::Begin(_) => depth += 1,
                    Kind::Close(_) | Kind::End => depth = depth.saturating_sub(1),
                    _ => {}
                }
            }
            last = more.last().map(|t| (t.kind, cut(text, &t.span))).or(last);
            (end, behind) = (following.end, after);
            (following, after) = line(text, behind, limit);
        }
        if lead.label.is_some() {
            self.reader.label = lead.label.clone();
        }
        if !self.reader.region(content.start..end, manner) && has_letters(text, span) {
            self.reader.prose = Some(trimmed(text, span));
        }
        Some(behind)
    }
}

fn has_letters(text: &str, span: &Range<usize>) -> bool {
    cut(text, span).chars().any(char::is_alphabetic)
}

/// Where the brace that is open before a text closes.
pub fn closing_brace(text: &str) -> Option<usize> {
    let mut depth = 0_usize;
    for (i, c) in text.char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth == 0 => return Some(i),
            '}' => depth -= 1,
            _ => {}
        }
    }
    None
}
