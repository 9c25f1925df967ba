//! Tables that stand in programs in other forms than rows under a head: rows whose order words tell, rows of names and values,
//! lists in code, and links of the robot toolboxes. Each is set as a table and read as one.

use super::CheckOptions;
use super::lines::lines;
use super::steps::{self, Steps};
use super::still_rows::turned;
use denavit::description::table::{PrintedTable, tables};
use denavit::description::{Convention, TableKind, TableOptions};
use denavit_reading::code::Dialect;
use std::ops::Range;

/// The longest line that is looked at.
const LONGEST: usize = 400;
/// The most rows of a table.
const MAX_ROWS: usize = 12;

/// A column of such a table.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Column {
    Theta,
    D,
    A,
    Alpha,
}

const COLUMNS: [Column; 4] = [Column::Theta, Column::D, Column::A, Column::Alpha];

/// Rows with their places, and what else is known of them.
struct Listing {
    span: Range<usize>,
    /// θ, d, a, α.
    rows: Vec<[String; 4]>,
    convention: Option<Convention>,
    /// Angles that are numbers are in degrees.
    in_degrees: bool,
    /// α and a are called after the row before.
    is_previous: bool,
}

/// The tables of a text; of a program those in its comments, or what stands for one in its code.
pub(super) fn tables_of(
    text: &str,
    kind: TableKind,
    options: &CheckOptions,
    reading: &TableOptions,
) -> Vec<PrintedTable> {
    let bare = without_marks(text, options);
    let bare = bare.as_deref().unwrap_or(text);
    let printed = tables(bare, kind, reading);
    let is_program = options.language.is_some();
    if !is_program && !printed.is_empty() {
        return printed;
    }
    let told = is_program.then(|| told_rows(bare)).flatten().and_then(|l| table(&l, reading));
    let still = || {
        let listing = told_rows(bare).or_else(|| lists(text)).filter(|_| is_program)?;
        let rows = turned(&listing.rows, text)?;
        table(&Listing { rows, ..listing }, reading)
    };
    if let Some(still) = still() {
        return vec![still];
    }
    let (mut listed, unread): (Vec<PrintedTable>, Vec<_>) = told.into_iter().partition(|t| t.robot.is_ok());
    // A head that was taken for words leaves rows out, a length that slides a joint.
    let most = |tables: &[PrintedTable]| {
        let robots = tables.iter().filter_map(|t| t.robot.as_ref().ok().map(|(d, _)| d));
        robots.map(|d| (d.rows.len(), d.variables().len())).max().unwrap_or_default()
    };
    if most(&printed).0 > 0 {
        return if most(&listed) > most(&printed) { listed } else { printed };
    }
    if listed.is_empty()
        && let Some(Steps { span, rows, convention }) = steps::told(bare)
    {
        let (in_degrees, is_previous) = (degrees(&rows), convention == Convention::Craig);
        let listing = Listing { span, rows, convention: Some(convention), in_degrees, is_previous };
        listed.extend(table(&listing, reading));
    }
    if listed.is_empty() {
        listed.extend(links(text).and_then(|l| table(&l, reading)));
    }
    if listed.is_empty() && (is_program || text.contains("```")) {
        listed.extend(lists(text).and_then(|l| table(&l, reading)));
    }
    if listed.is_empty() {
        listed = unread;
    }
    if listed.iter().any(|t| t.robot.is_ok()) || printed.is_empty() { listed } else { printed }
}

/// A program with blanks for the marks of its comments, in which tables stand.
pub(super) fn without_marks(text: &str, options: &CheckOptions) -> Option<String> {
    let marks: &[&str] = match options.language? {
        Dialect::Python => &["#"],
        Dialect::Matlab => &["%"],
        Dialect::C => &["//", "/*", "*/", "*"],
    };
    let bare = |line: &str| {
        let trimmed = line.trim_start();
        let start = line.len() - trimmed.len();
        let length = marks.iter().find(|m| trimmed.starts_with(**m)).map_or(0, |m| {
            let c = m.chars().next();
            m.len().max(trimmed.chars().take_while(|x| Some(*x) == c).count())
        });
        format!("{}{}{}", &line[..start], " ".repeat(length), &trimmed[length..])
    };
    Some(text.split_inclusive('\n').map(bare).collect())
}

/// The listing set as a table and read.
fn table(listing: &Listing, reading: &TableOptions) -> Option<PrintedTable> {
    if listing.rows.is_empty() || listing.rows.len() > MAX_ROWS {
        return None;
    }
    let unit = if listing.in_degrees { "angles: degrees\n\n" } else { "" };
    let [a, alpha] = if listing.is_previous { ["a_{i-1}", "alpha_{i-1}"] } else { ["a", "alpha"] };
    let mut text = format!("{unit}| i | theta | d | {a} | {alpha} |\n|---|---|---|---|---|\n");
    for (k, row) in listing.rows.iter().enumerate() {
        let mut row = row.clone().map(|cell| clean(&cell));
        // A row that does not turn slides, whatever its length is called.
        let letters = |cell: &str| cell.chars().any(char::is_alphabetic) && !cell.contains("pi");
        if !letters(&row[0]) && letters(&row[1]) {
            let is_part = |c: char| c.is_alphanumeric() || c == '_';
            let name = row[1].split(|c| !is_part(c)).find(|w| w.starts_with(char::is_alphabetic));
            let name = name.filter(|w| w.chars().count() == 1).map(str::to_string);
            if let Some(name) = name {
                row[1] = row[1].replace(&name, &format!("q{}", k + 1));
            }
        }
        text += &format!("| {} | {} |\n", k + 1, row.join(" | "));
    }
    let mut reading = reading.clone();
    reading.convention = reading.convention.or(listing.convention);
    let mut table = tables(&text, TableKind::Markdown, &reading).pop()?;
    if let Err(errors) = &mut table.robot {
        errors.iter_mut().for_each(|e| e.span = listing.span.clone());
    }
    if let Ok((_, found)) = &mut table.robot {
        found.clear();
    }
    table.span = listing.span.clone();
    Some(table)
}

/// What comments begin with.
pub(super) fn comment_mark(language: Dialect) -> &'static str {
    match language {
        Dialect::Python => "#",
        Dialect::Matlab => "%",
        Dialect::C => "//",
    }
}

fn column(word: &str) -> Option<Column> {
    let plain: String = word.to_lowercase().chars().filter(|c| c.is_alphabetic()).collect();
    let plain = plain.strip_suffix('i').filter(|p| !p.is_empty()).unwrap_or(&plain);
    Some(match plain {
        "theta" | "th" | "θ" | "thet" => Column::Theta,
        "d" => Column::D,
        "a" | "r" => Column::A,
        "alpha" | "alph" | "α" | "alfa" => Column::Alpha,
        _ => return None,
    })
}

/// The order of the columns, where a line names them one after another: `(theta, d, a, alpha)`.
fn order(line: &str) -> Option<Vec<Column>> {
    let plain: String = line
        .replace("(i-1)", "")
        .replace("_{i-1}", "")
        .replace("(i)", "")
        .replace(['(', ')', '[', ']', '{', '}', ',', '|', '/', ':', ';', '\'', '"'], " ");
    let words: Vec<&str> = plain.split_whitespace().collect();
    words.windows(4).find_map(|four| {
        let columns: Vec<Column> = four.iter().map(|w| column(w)).collect::<Option<_>>()?;
        COLUMNS.iter().all(|c| columns.contains(c)).then_some(columns)
    })
}

/// Rows below words that tell the order, and rows `theta4, d = 0, a = 0, alpha = -90`.
fn told_rows(text: &str) -> Option<Listing> {
    let lines: Vec<(Range<usize>, &str)> = lines(text).map(|l| (l.clone(), &text[l])).collect();
    let mut head: Option<Vec<Column>> = None;
    let mut rows: Vec<[String; 4]> = vec![];
    let mut span = 0..0;
    let (mut gap, mut is_previous) = (0, false);
    for (place, line) in &lines {
        let plain = line.trim();
        if line.len() > LONGEST {
            continue;
        }
        // `return [(q1, d1, 0, pi/2),`
        let inside = ["return [(", "return [[", "= [(", "= [["].iter().find_map(|open| {
            let at = plain.find(open)? + open.len() - 1;
            Some(&plain[at..])
        });
        let plain = inside.filter(|_| rows.is_empty() && head.is_some()).unwrap_or(plain);
        let row = named_row(plain).or_else(|| row(plain, head.as_deref()?));
        match row {
            Some(row) => {
                if rows.is_empty() {
                    span.start = place.start;
                }
                span.end = place.end;
                rows.push(row);
                gap = 0;
            }
            None if rows.len() > 1 => break,
            None => {
                gap += 1;
                rows.clear();
                if let Some(found) = order(plain) {
                    (head, gap) = (Some(found), 0);
                    is_previous = plain.contains("i-1") || plain.contains("prev");
                } else if gap > 3 {
                    head = None;
                }
            }
        }
    }
    (rows.len() > 1 && !is_transform(&rows)).then(|| {
        let in_degrees = degrees(&rows);
        Listing { span, rows, convention: None, in_degrees, is_previous }
    })
}

/// Angles beyond a turn are degrees.
fn degrees(rows: &[[String; 4]]) -> bool {
    let is_far = |cell: &String| cell.trim().parse::<f64>().is_ok_and(|x| x.abs() > 6.3);
    rows.iter().any(|row| is_far(&row[0]) || is_far(&row[3]))
}

/// A cell that may stand in a table.
fn is_cell(cell: &str) -> bool {
    let plain = cell.trim();
    let words: Vec<&str> = plain.split(|c: char| !c.is_alphabetic()).filter(|w| w.len() > 1).collect();
    let is_known = |w: &&str| {
        column(w).is_some() || matches!(*w, "pi" | "deg" | "th" | "degrees" | "rad" | "None") || w.len() <= 2
    };
    !plain.is_empty()
        && plain.len() <= 40
        && plain.starts_with(|c: char| c.is_alphanumeric() || matches!(c, '-' | '+' | '−' | '(' | '.'))
        && words.iter().all(is_known)
}

/// The cells of a row under a head, without what names it, and without a remark behind it.
fn row(line: &str, head: &[Column]) -> Option<[String; 4]> {
    plain_row(line, head).or_else(|| plain_row(without_remark(line)?, head))
}

/// `q1, H, E, -90 deg   (E: the tilt axis sits beside the pan axis)` without what stands in brackets at its end.
fn without_remark(line: &str) -> Option<&str> {
    let inner = line.trim_end().strip_suffix(')')?;
    let open = inner.rfind(" (")?;
    let (before, remark) = (line[..open].trim_end(), &inner[open + 2..]);
    let is_remark = remark.trim().contains(' ') && !remark.contains(['(', ')']);
    (is_remark && !before.ends_with([',', '|', ';'])).then_some(before)
}

fn plain_row(line: &str, head: &[Column]) -> Option<[String; 4]> {
    let line = line.replace(" deg", "°").replace(" rad", "");
    let line = line.split_once(':').map_or(line.as_str(), |l| l.1).trim();
    let line = match line.split_once('=') {
        Some((name, rest)) if matches!(name.trim(), "i" | "j" | "link" | "joint") => rest.trim(),
        _ => line,
    };
    let inner = line.trim_matches(['[', ']', '(', ')', ',', ';', '|']);
    // The bracket of the last cell is its own.
    let open = |opening: char, closing: char| {
        inner.matches(opening).count().saturating_sub(inner.matches(closing).count())
    };
    let line = format!("{inner}{}{}", "]".repeat(open('[', ']')), ")".repeat(open('(', ')')));
    let line = line.as_str();
    let by = |c: char| line.split(c).map(str::trim).filter(|c| !c.is_empty()).collect::<Vec<&str>>();
    let wide = line.replace('|', "  ");
    // `1 |   0    a1   q1   d1`: a bar behind the number alone.
    let is_barred = line.contains('|') && by('|').len() > 2;
    let line = if is_barred { line } else { wide.as_str() };
    let cells = match () {
        () if is_barred => by('|'),
        () if line.contains(',') => by(','),
        () => {
            let wide: Vec<&str> = line.split("  ").map(str::trim).filter(|c| !c.is_empty()).collect();
            if wide.len() >= 4 { wide } else { line.split_whitespace().collect() }
        }
    };
    let cells = match cells.len() {
        4 => cells,
        5 if cells[0].trim_start_matches(|c: char| c.is_alphabetic()).parse::<usize>().is_ok() => {
            cells[1..].to_vec()
        }
        _ => return None,
    };
    if !cells.iter().all(|c| is_cell(c)) {
        return None;
    }
    let of = |column: Column| {
        let k = head.iter().position(|c| *c == column)?;
        Some(cells[k].trim_matches(['\'', '"']).to_string())
    };
    Some([of(COLUMNS[0])?, of(COLUMNS[1])?, of(COLUMNS[2])?, of(COLUMNS[3])?])
}

/// `4: theta4, d = 0, a = 0, alpha = -90`, `link 1: d=0.4 a=0 alpha=90 theta=q1`
fn named_row(line: &str) -> Option<[String; 4]> {
    // `{ a: L1, alpha: 0, d: 0, theta: q1 },`
    let keyed = line.trim().trim_end_matches([',', ';']).strip_prefix('{').and_then(|l| l.strip_suffix('}'));
    let keyed = keyed.map(|l| l.replace(": ", "=").replace(':', "=").replace(['"', '\''], ""));
    let line = keyed.as_deref().unwrap_or(line);
    if line.matches('=').count() < 2 || line.contains("==") {
        return None;
    }
    let line = line.split_once(':').map_or(line, |l| l.1);
    let mut cells: [Option<String>; 4] = Default::default();
    let glued = line.replace(" =", "=").replace("= ", "=");
    for part in glued.split([',', ' ', ';', '\t']).filter(|p| !p.is_empty()) {
        let (name, value) = match part.split_once('=') {
            Some((name, value)) => (name, value),
            // `theta4` is the joint itself.
            None => (part.trim_end_matches(|c: char| c.is_ascii_digit()), part),
        };
        let k = COLUMNS.iter().position(|c| column(name) == Some(*c))?;
        if !is_cell(value) || cells[k].is_some() {
            return None;
        }
        cells[k] = Some(value.to_string());
    }
    let [Some(theta), Some(d), Some(a), Some(alpha)] = cells else { return None };
    Some([theta, d, a, alpha])
}

/// The links of the toolboxes of Corke: `Link('d', 0, 'a', 1, 'alpha', 0)`, `RevoluteDH(d=0.4, a=0, alpha=pi/2)`.
fn links(text: &str) -> Option<Listing> {
    const NAMES: [(&str, Option<bool>, Option<bool>); 8] = [
        ("RevoluteDH(", Some(true), Some(true)),
        ("PrismaticDH(", Some(false), Some(true)),
        ("RevoluteMDH(", Some(true), Some(false)),
        ("PrismaticMDH(", Some(false), Some(false)),
        ("Revolute(", Some(true), None),
        ("Prismatic(", Some(false), None),
        ("DHLink(", None, None),
        ("Link(", None, None),
    ];
    let is_modified = text.contains("'modified'") || text.contains("mdh=True") || text.contains("mdh=1");
    let mut rows: Vec<[String; 4]> = vec![];
    let mut span = 0..0;
    let mut standard = !is_modified;
    let mut at = 0;
    while at < text.len() {
        let found = NAMES
            .iter()
            .filter_map(|n| Some((at + text[at..].find(n.0)?, n)))
            .min_by_key(|f| (f.0, std::cmp::Reverse(f.1.0.len())));
        let Some((start, (name, revolute, is_standard))) = found else { break };
        let inside = start + name.len();
        at = inside;
        let before = text[..start].chars().next_back();
        if before.is_some_and(|c| c.is_alphanumeric() || c == '_') {
            continue;
        }
        let Some(length) = closing(&text[inside..]) else { break };
        at = inside + length;
        let arguments = &text[inside..inside + length];
        let Some(row) = link(arguments, *revolute, rows.len() + 1) else { continue };
        standard = is_standard.unwrap_or(standard);
        if rows.is_empty() {
            span.start = start;
        }
        span.end = at + 1;
        rows.push(row);
    }
    let convention = if standard { Convention::Standard } else { Convention::Craig };
    (!rows.is_empty()).then_some(Listing {
        span,
        rows,
        convention: Some(convention),
        in_degrees: false,
        is_previous: false,
    })
}

/// The bytes up to the bracket that closes.
fn closing(text: &str) -> Option<usize> {
    let mut depth = 0_usize;
    for (i, c) in text.char_indices().take(LONGEST) {
        match c {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' if depth == 0 => return Some(i),
            ')' | ']' | '}' => depth -= 1,
            _ => {}
        }
    }
    None
}

/// The parts between commas that stand in no bracket.
fn parts(text: &str) -> Vec<&str> {
    let (mut depth, mut start, mut found) = (0_usize, 0, vec![]);
    for (i, c) in text.char_indices() {
        match c {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth = depth.saturating_sub(1),
            ',' if depth == 0 => {
                found.push(text[start..i].trim());
                start = i + 1;
            }
            _ => {}
        }
    }
    found.push(text[start..].trim());
    found.retain(|p| !p.is_empty());
    found
}

/// The row of a link by its arguments.
fn link(arguments: &str, revolute: Option<bool>, number: usize) -> Option<[String; 4]> {
    let plain = arguments.trim();
    let mut cells: [Option<String>; 4] = Default::default();
    let mut is_revolute = revolute;
    let mut offset = None;
    let list = plain.strip_prefix('[').and_then(|p| p.split_once(']')).map(|p| p.0);
    if let Some(list) = list {
        // [theta d a alpha sigma]
        let values: Vec<&str> =
            if list.contains(',') { parts(list) } else { list.split_whitespace().collect() };
        for (cell, value) in cells.iter_mut().zip(&values) {
            *cell = Some(clean(value));
        }
        is_revolute = is_revolute.or(Some(values.get(4).is_none_or(|s| *s == "0")));
    } else {
        let parts = parts(plain);
        let mut rest = parts.iter();
        while let Some(part) = rest.next() {
            let (name, value) = match part.split_once('=') {
                Some((name, value)) => (name.trim(), value.trim()),
                None if part.starts_with(['\'', '"']) => {
                    let name = part.trim_matches(['\'', '"']);
                    if matches!(name, "standard" | "modified" | "revolute" | "prismatic" | "R" | "P") {
                        if matches!(name, "prismatic" | "P") {
                            is_revolute = Some(false);
                        }
                        continue;
                    }
                    (name, *rest.next()?)
                }
                None => return None,
            };
            match name {
                "offset" => offset = Some(clean(value)),
                "sigma" | "jointtype" => {
                    is_revolute = Some(matches!(value.trim_matches(['\'', '"']), "0" | "R"));
                }
                _ => {
                    if let Some(k) = COLUMNS.iter().position(|c| column(name) == Some(*c)) {
                        cells[k] = Some(clean(value));
                    }
                }
            }
        }
    }
    let is_told = cells.iter().filter(|c| c.is_some()).count() > 0;
    let is_slide =
        is_revolute == Some(false) || is_revolute.is_none() && cells[0].is_some() && cells[1].is_none();
    let zero = || "0".to_string();
    let joint = match offset {
        Some(offset) if offset != "0" => format!("q{number} + {offset}"),
        _ => format!("q{number}"),
    };
    let [theta, d, a, alpha] = cells;
    let (theta, d) = match is_slide {
        true => (theta.unwrap_or_else(zero), joint),
        false => (joint, d.unwrap_or_else(zero)),
    };
    is_told.then(|| [theta, d, a.unwrap_or_else(zero), alpha.unwrap_or_else(zero)])
}

/// A value of code as a table has it.
fn clean(value: &str) -> String {
    ["np.", "math.", "sp.", "numpy.", "sympy.", "sym."]
        .iter()
        .fold(value.trim().to_string(), |v, m| v.replace(m, ""))
        .trim_matches(['\'', '"'])
        .to_string()
}

/// Rows of four in a list, in an order that words above it or the function of a row tell.
fn lists(text: &str) -> Option<Listing> {
    let lines: Vec<(Range<usize>, &str)> = lines(text).map(|l| (l.clone(), &text[l])).collect();
    let by_function = lines.iter().map(|l| l.1.trim()).find_map(|l| {
        let rest = l.strip_prefix("def ").or_else(|| l.strip_prefix("function "))?;
        order(rest.split_once('(')?.1)
    });
    let mut told: Option<Vec<Column>> = None;
    let mut rows: Vec<[String; 4]> = vec![];
    let mut span = 0..0;
    for (place, line) in &lines {
        if line.len() > LONGEST {
            continue;
        }
        let plain = line.split(['#', '%']).next().unwrap_or_default().trim();
        let plain = plain.strip_prefix("return ").unwrap_or(plain).trim();
        let open = plain.rfind("= [").filter(|_| rows.is_empty()).map_or(plain, |i| &plain[i + 3..]).trim();
        let found = rows_in(open, told.as_deref().or(by_function.as_deref()));
        if found.is_empty() {
            if rows.len() > 1 && !is_transform(&rows) {
                break;
            }
            rows.clear();
            if !line.trim_start().starts_with("def ") {
                told = order(line).or(told);
            }
            continue;
        }
        if rows.is_empty() {
            span.start = place.start;
        }
        span.end = place.end;
        for mut row in found {
            // `None` where the variable of the joint stands.
            let number = rows.len() + 1;
            row.iter_mut().filter(|c| *c == "None").for_each(|c| *c = format!("q{number}"));
            rows.push(row);
        }
    }
    (rows.len() > 1 && !is_transform(&rows)).then(|| {
        let in_degrees = degrees(&rows);
        Listing { span, rows, convention: None, in_degrees, is_previous: false }
    })
}

/// Whether rows are those of a matrix of a transform, whose last one is 0 0 0 1.
fn is_transform(rows: &[[String; 4]]) -> bool {
    let is_last = |row: &[String; 4]| {
        let is = |cell: &str, number: f64| cell.trim().parse() == Ok(number);
        row.iter().filter(|c| is(c, 0.0)).count() == 3 && row.iter().any(|c| is(c, 1.0))
    };
    rows.last().is_some_and(is_last)
}

/// `(t1, L1, 0, pi/2), (t2, 0, 0, 0)` of one line.
fn rows_in(line: &str, head: Option<&[Column]>) -> Vec<[String; 4]> {
    let Some(head) = head else { return vec![] };
    let of = |part: &str| {
        let inner = part.strip_prefix(['(', '['])?;
        let trimmed = inner.trim_end_matches([']', ')', ',', ' ']);
        // The bracket of `q[0]` is the cell's own.
        let open = trimmed.matches('[').count().saturating_sub(trimmed.matches(']').count());
        let inner = format!("{trimmed}{}", "]".repeat(open));
        let cells: Vec<String> = parts(&inner).into_iter().map(clean).collect();
        let line = cells.join(", ");
        (cells.len() == 4).then(|| row(&line, head)).flatten()
    };
    let plain = line.trim_end_matches([',', ' ']);
    let plain = plain.strip_prefix('[').filter(|p| p.starts_with(['[', '('])).unwrap_or(plain);
    let all: Vec<Option<[String; 4]>> = parts(plain.trim_end_matches(';')).into_iter().map(of).collect();
    all.into_iter().collect::<Option<Vec<_>>>().unwrap_or_default()
}
