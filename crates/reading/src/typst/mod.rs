//! Typst as Markdown with formulas of LaTeX: what is read of a document is the same then, whoever set it.
//!
//! Lines stay where they are, so that places are told by lines of the document; columns are those of what is read.

mod math;

use math::Math;

/// Functions whose texts are no words of a document.
const SILENT: [&str; 14] = [
    "rgb",
    "luma",
    "image",
    "link",
    "label",
    "ref",
    "cite",
    "raw",
    "json",
    "csv",
    "read",
    "bibliography",
    "curve",
    "polygon",
];
/// What changes how a document looks, to the end of its line or of its brackets.
const SETTINGS: [&str; 6] = ["let", "set", "show", "import", "include", "pagebreak"];

/// A document of Typst as Markdown.
pub fn markdown(text: &str) -> String {
    let mut reader = Reader { rest: text, out: String::with_capacity(text.len()), depth: 0, last: None };
    while !reader.rest.is_empty() {
        reader.markup();
        // A bracket that nothing opened.
        reader.next();
    }
    reader.out
}

/// The first letter of what is left of a text, and is left no longer.
fn taken(rest: &mut &str) -> Option<char> {
    let c = rest.chars().next()?;
    *rest = &rest[c.len_utf8()..];
    Some(c)
}

struct Reader<'a> {
    rest: &'a str,
    out: String,
    depth: usize,
    /// Where the formula ends that was written last, if brackets in it are not closed.
    last: Option<(usize, bool)>,
}

/// Brackets in brackets that are followed.
const DEEPEST: usize = 100;
/// So many letters of arguments are looked through for those with names.
const FIRST: usize = 1000;

impl Reader<'_> {
    fn peek(&self) -> Option<char> {
        self.rest.chars().next()
    }

    fn next(&mut self) -> Option<char> {
        taken(&mut self.rest)
    }

    fn skip(&mut self, what: &str) -> bool {
        let found = self.rest.strip_prefix(what);
        self.rest = found.unwrap_or(self.rest);
        found.is_some()
    }

    /// Leaves so many bytes away, but for the ends of their lines.
    fn leave(&mut self, bytes: usize) {
        let (left, rest) = self.rest.split_at(bytes.min(self.rest.len()));
        self.out.extend(left.chars().filter(|c| *c == '\n'));
        self.rest = rest;
    }

    fn blank(&mut self) {
        if !self.out.ends_with([' ', '\n']) {
            self.out.push(' ');
        }
    }

    /// True at the beginning of a line.
    fn begins(&self) -> bool {
        self.out.trim_end_matches([' ', '\t']).chars().next_back().is_none_or(|c| c == '\n')
    }

    /// The arguments of a function, its brackets included, as far as they are looked through.
    fn own_arguments(&self) -> &str {
        let (mut depth, mut is_text) = (0_i32, false);
        if !self.rest.starts_with('(') {
            return "";
        }
        let mut end = 0;
        for c in self.rest.chars().take(FIRST) {
            end += c.len_utf8();
            match c {
                '"' => is_text = !is_text,
                _ if is_text => {}
                '(' | '[' | '{' => depth += 1,
                ')' | ']' | '}' => depth -= 1,
                _ => {}
            }
            if depth == 0 {
                break;
            }
        }
        &self.rest[..end]
    }

    /// A comment; true if there is one.
    fn comment(&mut self) -> bool {
        if self.rest.starts_with("//") && !self.out.ends_with(':') {
            self.leave(self.rest.find('\n').unwrap_or(self.rest.len()));
        } else if self.rest.starts_with("/*") {
            self.leave(self.rest.find("*/").map_or(self.rest.len(), |at| at + 2));
        } else {
            return false;
        }
        true
    }

    /// Words and formulas, up to a closing bracket or the end.
    fn markup(&mut self) {
        self.depth += 1;
        let mut open = 0;
        while let Some(c) = self.peek() {
            if self.comment() {
                continue;
            }
            match c {
                ']' if open == 0 => break,
                '[' => open += 1,
                ']' => open -= 1,
                '=' if self.begins() => {
                    let level = self.rest.len() - self.rest.trim_start_matches('=').len();
                    if self.rest[level..].starts_with(' ') {
                        self.out.extend(std::iter::repeat_n('#', level.min(6)));
                        self.rest = &self.rest[level..];
                        continue;
                    }
                }
                '$' => {
                    self.formula();
                    continue;
                }
                '#' => {
                    self.next();
                    self.code();
                    continue;
                }
                '\\' => {
                    self.next();
                    match self.peek() {
                        Some(c) if !c.is_whitespace() => self.out.push(c),
                        _ => continue,
                    }
                }
                _ => {}
            }
            if c != '\\' {
                self.out.push(c);
            }
            self.next();
        }
        self.depth -= 1;
    }

    /// A formula between dollars.
    fn formula(&mut self) {
        self.next();
        let mut end = self.rest.len();
        let (mut is_text, mut is_escaped) = (false, false);
        for (at, c) in self.rest.char_indices() {
            match c {
                _ if is_escaped => is_escaped = false,
                '\\' => is_escaped = true,
                '"' => is_text = !is_text,
                '$' if !is_text => {
                    end = at;
                    break;
                }
                _ => {}
            }
        }
        let (inner, rest) = self.rest.split_at(end);
        self.rest = rest.strip_prefix('$').unwrap_or(rest);
        let is_display = inner.starts_with(char::is_whitespace) && inner.ends_with(char::is_whitespace);
        let dollars = if is_display { "$$" } else { "$" };
        let formula = Math::read(inner);
        if formula.trim().is_empty() {
            return;
        }
        // One that goes on behind a place where its line may be broken: `$a$ $"" = b$`, `$f(x,$ $y)$`.
        let before = self.last.filter(|last| self.out.get(last.0..).is_some_and(|t| t.trim().is_empty()));
        let goes_on = before.filter(|last| !is_display && (last.1 || inner.trim_start().starts_with("\"\"")));
        let formula = if is_display { &formula } else { formula.trim() };
        match goes_on {
            Some((end, _)) => {
                self.out.truncate(end - 1);
                self.out.push(' ');
            }
            None => self.out.push_str(dollars),
        }
        self.out.push_str(formula);
        self.out.push_str(dollars);
        let count = |c: char| formula.matches(c).count();
        self.last = Some((self.out.len(), !is_display && count('(') > count(')')));
    }

    /// A word with dots and hyphens in it.
    fn word(&mut self) -> String {
        let is_part = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-');
        let mut end = self.rest.find(|c| !is_part(c)).unwrap_or(self.rest.len());
        while let Some(more) =
            self.rest[end..].strip_prefix('.').filter(|m| m.starts_with(char::is_alphabetic))
        {
            end = self.rest.len() - more.len() + more.find(|c| !is_part(c)).unwrap_or(more.len());
        }
        let word = self.rest[..end].to_string();
        self.rest = &self.rest[end..];
        word
    }

    /// The text between quotes.
    fn quoted(&mut self) -> String {
        self.next();
        let mut text = String::new();
        while let Some(c) = self.next() {
            match c {
                '"' => break,
                '\\' => text.extend(self.next().map(|c| if c == 'n' { ' ' } else { c })),
                c => text.push(c),
            }
        }
        text
    }

    /// What stands behind `#`.
    fn code(&mut self) {
        match self.peek() {
            Some('"') => {
                let text = self.quoted();
                self.out.push_str(&text);
            }
            Some('[') => self.content(),
            Some('(' | '{') => self.arguments(true),
            Some(c) if c.is_alphabetic() => {
                let word = self.word();
                if SETTINGS.contains(&word.as_str()) {
                    self.setting();
                    return;
                }
                self.call(&word);
            }
            _ => {}
        }
        self.skip(";");
    }

    /// The rest of a setting: to the end of the line that closes its brackets.
    fn setting(&mut self) {
        let (mut depth, mut is_text) = (0_i32, false);
        let mut end = self.rest.len();
        for (at, c) in self.rest.char_indices() {
            match c {
                '"' => is_text = !is_text,
                _ if is_text => {}
                '(' | '[' | '{' => depth += 1,
                ')' | ']' | '}' if depth == 0 => {
                    end = at;
                    break;
                }
                ')' | ']' | '}' => depth -= 1,
                '\n' | ';' if depth == 0 => {
                    end = at;
                    break;
                }
                _ => {}
            }
        }
        self.leave(end);
        self.skip(";");
    }

    /// A function with its arguments: what of them is words, formulas or cells.
    fn call(&mut self, name: &str) {
        if name == "sym.checkmark" {
            self.out.push('✓');
            return;
        }
        if name == "heading" {
            let level = self.own_arguments().split_once("level:").map_or(1, |(_, rest)| {
                rest.trim_start().chars().next().and_then(|c| c.to_digit(10)).unwrap_or(1) as usize
            });
            self.out.extend(std::iter::repeat_n('#', level.clamp(1, 6)));
            self.out.push(' ');
        }
        if name == "table" && self.peek() == Some('(') && self.depth <= DEEPEST {
            self.table();
            return;
        }
        if self.peek() == Some('(') {
            self.arguments(!SILENT.contains(&name));
        }
        while self.peek() == Some('[') {
            self.content();
        }
    }

    /// Markup between brackets.
    fn content(&mut self) {
        if self.depth > DEEPEST {
            self.leave(self.rest.len());
            return;
        }
        self.next();
        self.markup();
        self.skip("]");
    }

    /// What stands between round or curly brackets; texts only where they are words of the document.
    fn arguments(&mut self, speaks: bool) {
        self.depth += 1;
        let close = if self.next() == Some('{') { '}' } else { ')' };
        let mut is_named = false;
        while let Some(c) = self.peek() {
            if c == close || self.depth > DEEPEST {
                break;
            }
            self.item(speaks, &mut is_named);
        }
        self.next();
        self.depth -= 1;
    }

    /// The next of what stands between brackets.
    fn item(&mut self, speaks: bool, is_named: &mut bool) {
        let Some(c) = self.peek().filter(|_| !self.comment()) else { return };
        match c {
            '"' => {
                let text = self.quoted();
                if speaks && !*is_named {
                    self.out.push_str(&text);
                }
            }
            '$' => self.formula(),
            '[' => self.content(),
            '(' | '{' => self.arguments(speaks && !*is_named),
            '#' => {
                self.next();
            }
            c if c.is_alphabetic() => {
                let word = self.word();
                match self.rest.trim_start().starts_with(':') {
                    // A caption speaks.
                    true => *is_named = !matches!(word.as_str(), "caption" | "body"),
                    false => self.call(&word),
                }
            }
            c => {
                *is_named &= c != ',';
                if c == ',' {
                    self.blank();
                }
                if c == '\n' {
                    self.out.push('\n');
                }
                self.next();
            }
        }
    }

    /// A table with its cells row by row. Its rule stands where its heading does, and that a line above.
    fn table(&mut self) {
        let columns = columns(self.own_arguments());
        let mut cells: Vec<String> = vec![];
        let out = std::mem::take(&mut self.out);
        self.depth += 1;
        self.next();
        let (mut is_named, mut breaks) = (false, vec![]);
        let mut open = 1;
        while let Some(c) = self.peek() {
            match c {
                // `table.header(…)`: its cells are cells.
                '(' if !is_named => {
                    open += 1;
                    self.next();
                }
                ')' => {
                    open -= 1;
                    self.next();
                    if open == 0 {
                        break;
                    }
                }
                c if c.is_ascii_digit() || c == '-' && !is_named => {
                    let end = self.rest.find([',', ')', '\n']).unwrap_or(self.rest.len());
                    self.out.push_str(&self.rest[..end]);
                    self.rest = &self.rest[end..];
                }
                c if c.is_alphabetic() => {
                    let word = self.word();
                    if self.rest.trim_start().starts_with(':') {
                        is_named = true;
                    } else if !word.starts_with("table.") && !is_named {
                        self.call(&word);
                    }
                }
                _ => self.item(true, &mut is_named),
            }
            let lines = self.out.matches('\n').count();
            breaks.extend(std::iter::repeat_n(cells.len(), lines));
            let cell = self.out.replace('\n', " ").trim().to_string();
            if !cell.is_empty() && !is_named {
                cells.push(cell.replace('|', "\\|"));
            }
            self.out.clear();
        }
        self.depth -= 1;
        self.out = out;
        self.rows(&cells, columns, &breaks);
    }

    /// Rows of cells, with line ends behind so many cells.
    fn rows(&mut self, cells: &[String], columns: usize, breaks: &[usize]) {
        let mut lines = breaks.iter().copied().peekable();
        let mut owed = 0;
        for (k, row) in cells.chunks(columns.max(1)).enumerate() {
            let first = k * columns;
            // The lines above this row; the heading is a line above its own, for the rule behind it.
            while lines.next_if(|at| *at <= first).is_some() {
                owed += 1;
            }
            let ends = if k == 0 { owed - owed.min(1) } else { owed.max(1) };
            self.out.extend(std::iter::repeat_n('\n', ends));
            owed = if k == 0 { owed.min(1) } else { 0 };
            let _ = std::fmt::Write::write_fmt(&mut self.out, format_args!("| {} |", row.join(" | ")));
            if k == 0 {
                self.out.push('\n');
                self.out.push_str(&"|---".repeat(columns.max(1)));
                self.out.push('|');
                owed = 0;
            }
        }
        self.out.extend(lines.map(|_| '\n'));
    }
}

/// How many columns the arguments of a table say that it has.
fn columns(arguments: &str) -> usize {
    let Some((_, rest)) = arguments.split_once("columns:") else { return 1 };
    let rest = rest.trim_start();
    match rest.strip_prefix('(') {
        None => {
            rest.chars().map_while(|c| c.to_digit(10)).fold(0, |n, d| (10 * n + d as usize).min(100)).max(1)
        }
        Some(all) => {
            let mut depth = 0_i32;
            let mut count = 0;
            let mut is_part = false;
            for c in all.chars() {
                match c {
                    ')' if depth == 0 => break,
                    '(' => depth += 1,
                    ')' => depth -= 1,
                    ',' if depth == 0 => is_part = false,
                    c if !c.is_whitespace() && !is_part => {
                        is_part = true;
                        count += 1;
                    }
                    _ => {}
                }
            }
            count.max(1)
        }
    }
}
