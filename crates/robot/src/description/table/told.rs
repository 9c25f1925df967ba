//! Tables that are told row by row where nothing is set in columns: in sentences and lists, in the brackets of a program, in the
//! constructors of toolboxes.
//!
//! - names with values: `joint 1: theta = q1, d = d1, a = 0, alpha = 90°`
//! - rows of values whose order is told: `(theta, d, a, alpha)`, then `[q1, d1, 0, pi/2]` or `link 1: q1 d1 0 90`
//! - constructors: `Link([0 d1 0 pi/2])`, `RevoluteDH(d=d1, a=0, alpha=pi/2)`, in the order θ, d, a, α of the toolboxes that have
//!   them.

use super::columns::{Role, column, plain};
use super::find::{Grid, GridCell, Separator, cells_between, lines, uncommented};
use crate::description::units::unit_named;
use std::ops::Range;

/// The longest line that is looked at, and the most rows.
const MAX_LINE: usize = 500;
const MAX_ROWS: usize = 100;
/// No more lines that tell the order of the letters are looked behind.
const MAX_ORDERS: usize = 20;
/// So many bytes may stand between two rows in brackets.
const MAX_BETWEEN: usize = 60;
/// So many bytes behind the order of the columns the first row begins at the latest.
const MAX_BEFORE: usize = 400;

/// A row: its number, if it says one, and its cells by letters.
#[derive(Clone, Debug)]
struct Told {
    number: Option<usize>,
    cells: Vec<(Role, Range<usize>)>,
    span: Range<usize>,
}

/// Reads the rows of each table that is told one way.
type Reader = fn(&str) -> Vec<Vec<Told>>;

/// The tables of a text that are told so.
pub(super) fn grids(text: &str) -> Vec<Grid> {
    let readers: [Reader; 3] = [constructed, named, ordered];
    let found = readers.into_iter().map(|read| read(text)).find(|tables| !tables.is_empty());
    found.unwrap_or_default().into_iter().filter_map(|rows| grid(text, &rows)).collect()
}

/// A grid whose heads are letters; what a row does not tell is 0.
fn grid(text: &str, rows: &[Told]) -> Option<Grid> {
    let first = rows.first()?;
    let mut roles: Vec<Role> = vec![];
    for role in rows.iter().flat_map(|r| r.cells.iter().map(|c| c.0)) {
        if !roles.contains(&role) {
            roles.push(role);
        }
    }
    let start = first.span.start;
    let place = |text: &str, span: Range<usize>| GridCell { text: text.into(), span };
    let begin = first.number.unwrap_or(1);
    let mut heads = vec![place("", start..start)];
    heads.extend(roles.iter().map(|r| place(r.letter(), start..start)));
    let mut all = vec![heads];
    for (k, row) in rows.iter().enumerate() {
        let number = begin + k;
        if row.number.is_some_and(|n| n != number) {
            return None;
        }
        let mut cells = vec![place(&number.to_string(), row.span.clone())];
        for role in &roles {
            let found = row.cells.iter().find(|c| c.0 == *role);
            cells.push(match found {
                // What moves, without a name.
                Some((_, span)) if span.is_empty() => place("*", row.span.clone()),
                Some((_, span)) => GridCell::of(text, span.clone()),
                None => place("0", row.span.clone()),
            });
        }
        all.push(cells);
    }
    let span = start..rows.last()?.span.end;
    Some(Grid { rows: all, span, separator: Separator::Field(','), ruled: true })
}

/// True for the letters of a row: three, θ or α among them, none twice.
fn is_row(cells: &[(Role, Range<usize>)]) -> bool {
    let twice = cells.iter().enumerate().any(|(k, c)| cells[..k].iter().any(|d| d.0 == c.0));
    cells.len() >= 3 && !twice && cells.iter().any(|c| matches!(c.0, Role::Theta | Role::Alpha))
}

/// The letter of a table with its index: `a_2`, `\alpha_{1}`, `theta`.
fn letter(name: &str) -> Option<(Role, Option<usize>)> {
    let plain = plain(name);
    let stem = plain.trim_end_matches(|c: char| c.is_ascii_digit());
    let role = column(stem).role;
    role.is_letter().then(|| (role, plain[stem.len()..].parse().ok()))
}

// Names with values -------------------------------------------------------------------------------------------------

/// Rows of names with values, a line or a clause each.
fn named(text: &str) -> Vec<Vec<Told>> {
    let mut rows = vec![];
    for line in paragraphs(text).into_iter().filter(|l| l.len() <= 4 * MAX_LINE) {
        let cuts = text[line.clone()].match_indices(';').map(|(i, _)| line.start + i);
        let mut start = line.start;
        let mut clauses: Vec<Told> = vec![];
        for end in cuts.chain([line.end]).collect::<Vec<usize>>() {
            clauses.extend(named_row(text, start..end));
            start = (end + 1).min(line.end);
        }
        match clauses.is_empty() {
            true => rows.extend(named_row(text, line)),
            false => rows.extend(clauses),
        }
        if rows.len() > MAX_ROWS {
            return vec![];
        }
    }
    // A row without the joint's own letters is none of a table.
    let is_whole = |r: &Told| {
        r.cells.iter().any(|c| c.0 == Role::Theta) || r.cells.iter().any(|c| matches!(c.0, Role::D | Role::R))
    };
    if rows.len() < 2 || !rows.iter().all(is_whole) { vec![] } else { tables(rows) }
}

/// Lines; those of a paragraph that goes on with `;` are one.
fn paragraphs(text: &str) -> Vec<Range<usize>> {
    let mut found: Vec<Range<usize>> = vec![];
    let mut is_open = false;
    for line in lines(text) {
        let shown = text[line.clone()].trim();
        let begins = shown.is_empty() || shown.starts_with(['-', '*', '|', '\\', '%', '#', '>', '(']);
        let has_cut = |r: &Range<usize>| text[r.clone()].contains(';');
        match found.last_mut() {
            Some(last) if is_open && !begins && (has_cut(last) || has_cut(&line)) => last.end = line.end,
            _ => found.push(line.clone()),
        }
        is_open = !shown.is_empty();
    }
    found
}

/// Rows that begin to count again are another table.
fn tables(rows: Vec<Told>) -> Vec<Vec<Told>> {
    let mut found: Vec<Vec<Told>> = vec![];
    for row in rows {
        let goes_on = |table: &Vec<Told>| {
            let last = table.last().and_then(|r| r.number);
            row.number.is_none() || last.is_none() || row.number == last.map(|n| n + 1)
        };
        match found.last_mut() {
            Some(table) if goes_on(table) => table.push(row),
            _ => found.push(vec![row]),
        }
    }
    found
}

fn named_row(text: &str, span: Range<usize>) -> Option<Told> {
    let source = text.get(span.clone())?;
    let mut cells: Vec<(Role, Range<usize>)> = vec![];
    let mut number = None;
    for (at, _) in source.match_indices('=') {
        let before = source[..at].trim_end_matches([' ', '$', '&']);
        let name_start = before.rfind([' ', ',', ';', '$', '(', ':']).map_or(0, |i| i + 1);
        let Some((role, index)) = letter(&before[name_start..]) else { continue };
        let value = value_end(&source[at + 1..]);
        number = number.or(index);
        cells.push((role, span.start + at + 1..span.start + at + 1 + value));
    }
    if !is_row(&cells) {
        return None;
    }
    let head = source.split('=').next().unwrap_or_default();
    Some(Told { number: number.or_else(|| counted(head)), cells, span })
}

/// Where the value at the beginning of a text ends.
fn value_end(text: &str) -> usize {
    let mut depth = 0_usize;
    let chars: Vec<(usize, char)> = text.char_indices().collect();
    let start = chars.iter().position(|c| c.1 != ' ').unwrap_or(0);
    for (k, &(i, c)) in chars.iter().enumerate().skip(start) {
        let next = chars.get(k + 1).map(|c| c.1);
        match c {
            '(' | '{' | '[' => depth += 1,
            ')' | '}' | ']' if depth == 0 => return i,
            ')' | '}' | ']' => depth -= 1,
            ',' if depth == 0 && !next.is_some_and(|n| n.is_ascii_digit()) => return i,
            ';' | '$' if depth == 0 => return i,
            '.' if next.is_none_or(char::is_whitespace) => return i,
            ' ' if depth == 0 => {
                let word: String =
                    chars[k + 1..].iter().map(|c| c.1).take_while(|c| c.is_alphabetic()).collect();
                let is_sign = next.is_some_and(|n| matches!(n, '+' | '-' | '−' | '*' | '/' | '°' | '·'));
                let follows_sign = chars[..k]
                    .iter()
                    .rev()
                    .map(|c| c.1)
                    .find(|c| *c != ' ')
                    .is_some_and(|b| "+-−*/·".contains(b));
                let is_unit = unit_named(&word).is_some() && word.chars().count() > 1 || word == "m";
                if !(is_sign || follows_sign || is_unit || next == Some(' ')) {
                    return i;
                }
            }
            _ => {}
        }
    }
    text.len()
}

/// The number that words end in: `joint 2`, `- Link 2 (shoulder)`.
fn counted(head: &str) -> Option<usize> {
    let mut words = head.split(|c: char| !c.is_alphanumeric()).filter(|w| !w.is_empty()).peekable();
    while let Some(word) = words.next() {
        let is_index = column(word).role == Role::Index;
        if let (true, Some(Ok(n))) = (is_index, words.peek().map(|w| w.parse())) {
            return Some(n);
        }
    }
    None
}

// Rows whose order is told ------------------------------------------------------------------------------------------

/// Rows of values behind words that tell the order of the letters.
fn ordered(text: &str) -> Vec<Vec<Told>> {
    let mut found = vec![];
    let (mut at, mut tries) = (0, 0);
    for line in lines(text) {
        if line.start < at || line.len() > MAX_LINE {
            continue;
        }
        let Some((order, end)) = order_in(text, &line) else { continue };
        tries += 1;
        if tries > MAX_ORDERS {
            break;
        }
        let rows = in_brackets(text, end, &order).or_else(|| in_lines(text, line.end, &order));
        if let Some(rows) = rows {
            at = rows.last().map_or(at, |r| r.span.end);
            found.push(rows);
        }
    }
    found
}

/// Four letters or more that follow one another with nothing but blanks, commas and brackets between.
fn order_in(text: &str, line: &Range<usize>) -> Option<(Vec<Role>, usize)> {
    let source = &text[line.clone()];
    let is_between = |c: char| c.is_whitespace() || matches!(c, ',' | ';' | '|' | '&' | '$' | '"' | '\'');
    let mut run: Vec<(Role, usize)> = vec![];
    let mut start = None;
    let mut words: Vec<Range<usize>> = vec![];
    for (i, c) in source.char_indices().chain([(source.len(), ' ')]) {
        if is_between(c) {
            words.extend(start.take().map(|s: usize| s..i));
        } else {
            start = start.or(Some(i));
        }
    }
    for word in words {
        let bare = source[word.clone()].trim_matches(['(', ')', '[', ']', ':', '.', '%', '#', '/', '{', '}']);
        if bare.is_empty() {
            continue;
        }
        let role = letter(bare).filter(|(r, index)| index.is_none() && run.iter().all(|x| x.0 != *r));
        match role {
            Some((role, _)) => run.push((role, line.start + word.end)),
            None if run.len() >= 4 => break,
            None => run.clear(),
        }
    }
    let end = run.last()?.1;
    let roles: Vec<Role> = run.into_iter().map(|r| r.0).collect();
    (roles.len() >= 4 && roles.contains(&Role::Theta) && roles.contains(&Role::Alpha)).then_some((roles, end))
}

/// `[q1, d1, 0, pi/2], [q2, 0, a2, 0]`, `(…) and (…)`
fn in_brackets(text: &str, from: usize, order: &[Role]) -> Option<Vec<Told>> {
    let mut rows: Vec<Told> = vec![];
    let mut last = from;
    let rest = text.get(from..)?;
    for (open, close) in groups(rest) {
        let start = from + open;
        let far = if rows.is_empty() { MAX_BEFORE } else { MAX_BETWEEN };
        if start < last {
            continue;
        }
        if start - last > far || rows.len() > MAX_ROWS {
            break;
        }
        let inner = start + 1..from + close;
        let values = values(text, &inner);
        if values.len() != order.len() {
            if rows.is_empty() {
                continue;
            }
            break;
        }
        let number = counted(&text[last..start]);
        rows.push(Told {
            number,
            cells: order.iter().copied().zip(values).collect(),
            span: start..from + close + 1,
        });
        last = from + close + 1;
    }
    (rows.len() > 1).then_some(rows)
}

/// The innermost brackets of a text: where they open and close.
fn groups(text: &str) -> Vec<(usize, usize)> {
    let (mut found, mut open) = (vec![], None);
    let mut depth_inside = 0_usize;
    for (i, c) in text.char_indices().take(20_000) {
        match c {
            '[' => (open, depth_inside) = (Some((i, ']')), 0),
            // `cos(q1)`, `(1/2)` inside a row.
            '(' => match open {
                Some((_, ']')) => depth_inside += 1,
                _ => (open, depth_inside) = (Some((i, ')')), 0),
            },
            ')' if depth_inside > 0 => depth_inside -= 1,
            ']' | ')' => {
                if let Some((at, close)) = open.take()
                    && close == c
                {
                    found.push((at, i));
                }
            }
            _ => {}
        }
    }
    found
}

/// The values between commas, or between blanks if there are none.
fn values(text: &str, span: &Range<usize>) -> Vec<Range<usize>> {
    let source = &text[span.clone()];
    let cut = |is_cut: &dyn Fn(char) -> bool| {
        let mut found = vec![];
        let mut start = 0;
        for (i, c) in source.char_indices().chain([(source.len(), ',')]) {
            if i == source.len() || is_cut(c) {
                found.push(span.start + start..span.start + i);
                start = (i + c.len_utf8()).min(source.len());
            }
        }
        found.retain(|r| !text[r.clone()].trim().is_empty());
        found
    };
    match () {
        () if source.contains('|') => cut(&|c| c == '|'),
        () if source.contains(',') => cut(&|c| c == ','),
        () if source.contains(" / ") => {
            let cuts = source.match_indices(" / ").map(|c| span.start + c.0 + 1);
            cells_between(text, span.clone(), &cuts.collect::<Vec<usize>>())
                .into_iter()
                .map(|c| c.span)
                .collect()
        }
        () => {
            let mut found = cut(&char::is_whitespace);
            // `90 deg` is one value.
            for k in (1..found.len()).rev() {
                let is_unit =
                    matches!(&text[found[k].clone()], "deg" | "rad" | "°" | "mm" | "cm" | "m" | "degrees");
                if is_unit && text[found[k - 1].clone()].ends_with(|c: char| c.is_ascii_digit()) {
                    found[k - 1].end = found[k].end;
                    found.remove(k);
                }
            }
            found
        }
    }
}

/// Lines that end in as many values: `axis 1 (lift):  0  d1  0  90`, `pan | q1 | 0.31 | 0 | pi/2`, `J2:  0 / -90 / q2 / -90`.
fn in_lines(text: &str, from: usize, order: &[Role]) -> Option<Vec<Told>> {
    let mut rows: Vec<Told> = vec![];
    let rest = from..(from + 4_000).min(text.len());
    let rest = text.get(rest.clone()).map_or(from..text.len(), |_| rest);
    for line in lines(&text[rest.clone()]) {
        let span = in_matrix(text, uncommented(text, rest.start + line.start..rest.start + line.end));
        let source = &text[span.clone()];
        if source.trim_matches(['%', '#', '/', '*', ' ', '-', '=', '\t', '>']).is_empty() {
            continue;
        }
        let behind = label_end(source);
        let (head, tail) = source.split_at(behind);
        // A row's number, or words with it, before the values.
        let mut values = values(text, &(span.start + behind..span.end));
        let mut number = counted(head).or_else(|| number_of(head));
        let mut is_labelled = !head.is_empty();
        if values.len() == order.len() + 1 && !is_labelled {
            let label = text[values.remove(0)].trim();
            is_labelled = is_label(label);
            number = number_of(label);
            if !is_labelled {
                values.clear();
            }
        }
        let cells = || values.iter().map(|v| text[v.clone()].trim());
        let is_row = values.len() == order.len()
            && !tail.contains('=')
            && (number.is_some() || cells().all(is_value) && cells().any(is_number));
        if is_row {
            rows.push(Told { number, cells: order.iter().copied().zip(values).collect(), span });
        } else if !rows.is_empty() || span.start - from >= MAX_BEFORE {
            break;
        }
    }
    // Rows count on, or none does.
    let counts = rows.iter().filter(|r| r.number.is_some()).count();
    (rows.len() > 1 && (counts == 0 || counts == rows.len())).then_some(rows)
}

/// A line without what opens or closes a matrix around its rows: `DH = [ q1 d1 0 pi/2`, `q6 d6 0 0 ];`.
fn in_matrix(text: &str, span: Range<usize>) -> Range<usize> {
    let source = &text[span.clone()];
    let open = source.find('[').filter(|at| source[..*at].trim_end().ends_with('='));
    let start = span.start + open.map_or(0, |at| at + 1);
    let end = text[start..span.end].trim_end_matches([' ', ';', ']', ',', '.']).len();
    start..start + end
}

/// Where the values of a line begin: behind the words before a colon, or those before a last bracket that is no value's.
fn label_end(source: &str) -> usize {
    let end = source.rfind(':').map_or(0, |i| i + 1);
    match source.rfind(')') {
        Some(at) if at >= end && counted(&source[..at]).is_some() => at + 1,
        _ => end,
    }
}

/// The number that a label is or ends in: `2`, `2:`, `J2:`.
fn number_of(label: &str) -> Option<usize> {
    let bare = label.trim().trim_end_matches([':', '.', ')']).trim_start_matches(['(', '-', '*']).trim();
    let stem = bare.trim_end_matches(|c: char| c.is_ascii_digit());
    let is_word = stem.chars().count() < 12 && stem.chars().all(|c| c.is_alphabetic() || c == ' ');
    bare[stem.len()..].parse().ok().filter(|_| is_word)
}

/// True for a number of a row, or a word for it.
fn is_label(label: &str) -> bool {
    let is_word = label.chars().count() < 16
        && label.chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | '-' | '.' | '#' | ':' | ')'));
    is_word && !label.is_empty()
}

/// True for what may be a cell: a number, a short name, or a formula of both.
fn is_value(cell: &str) -> bool {
    const LONGEST: usize = 6;
    let is_sign = |c: char| "+-−*/().°π_^{}$\\ ,".contains(c);
    let words = cell.split(|c: char| !c.is_alphabetic()).filter(|w| !w.is_empty());
    cell.len() < 24
        && cell.chars().all(|c| c.is_alphanumeric() || is_sign(c))
        && (words.clone().all(|w| w.chars().count() <= LONGEST) || words.count() == 1)
}

/// True for a cell that begins with a number.
fn is_number(cell: &str) -> bool {
    let bare = cell.trim_start_matches(['-', '−', '–', '+', '$', ' ']);
    bare.starts_with(|c: char| c.is_ascii_digit() || c == 'π') || bare.starts_with("pi")
}

// Constructors of toolboxes -----------------------------------------------------------------------------------------

/// Functions that make a link, and whether it slides: not known from `Link`.
const LINKS: [(&str, Option<bool>); 11] = [
    ("RevoluteMDH", Some(false)),
    ("PrismaticMDH", Some(true)),
    ("RevoluteDH", Some(false)),
    ("PrismaticDH", Some(true)),
    ("Revolute", Some(false)),
    ("Prismatic", Some(true)),
    ("DHLink", None),
    ("RevoluteLink", Some(false)),
    ("PrismaticLink", Some(true)),
    ("Link", None),
    ("SerialLink", None),
];

fn constructed(text: &str) -> Vec<Vec<Told>> {
    let mut found: Vec<(usize, &str, Option<bool>)> = vec![];
    for (name, slides) in LINKS {
        for (at, _) in text.match_indices(name).take(MAX_ROWS) {
            let before = text[..at].chars().next_back();
            let is_word = !before.is_some_and(|c| c.is_alphanumeric() || c == '_');
            if is_word && text[at + name.len()..].starts_with('(') {
                found.push((at, name, slides));
            }
        }
    }
    found.sort_by_key(|f| f.0);
    let mut is_plain = true;
    let rows: Vec<Told> = found
        .into_iter()
        .filter_map(|(at, name, slides)| {
            let open = at + name.len();
            let close = closing(text, open)?;
            is_plain &= is_plain_link(name, &text[open..close]);
            constructed_row(text, open + 1..close, slides, at..close + 1)
        })
        .collect();
    if rows.len() < 2 || !is_plain { vec![] } else { vec![rows] }
}

/// False where a link says more than its row, or what a formula of a table does not have: the program is read then.
fn is_plain_link(name: &str, arguments: &str) -> bool {
    let says_more = ["offset", "flip", "mod", "np.", "math.", "deg2rad", "radians", "**"];
    let has_offset = arguments.split(['[', ']']).nth(1).is_some_and(|row| {
        let row = row.replace(',', " ");
        row.split_whitespace().nth(5).is_some_and(|x| x.parse() != Ok(0.0))
    });
    !name.contains("MDH") && !has_offset && says_more.iter().all(|word| !arguments.contains(word))
}

/// Where a bracket closes.
fn closing(text: &str, open: usize) -> Option<usize> {
    let mut depth = 0_usize;
    for (i, c) in text[open..].char_indices().take(1_000) {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => {
                depth = depth.saturating_sub(1);
                if depth == 0 {
                    return Some(open + i);
                }
            }
            _ => {}
        }
    }
    None
}

/// The row that a constructor makes: `[0 d1 0 pi/2]`, `d=d1, alpha=pi/2`, `'d', d1, 'alpha', pi/2`. The joint's own cell is left to
/// its variable, whose name the number of the row tells.
fn constructed_row(
    text: &str,
    inside: Range<usize>,
    slides: Option<bool>,
    span: Range<usize>,
) -> Option<Told> {
    let source = &text[inside.clone()];
    let order = [Role::Theta, Role::D, Role::A, Role::Alpha];
    let bracket = source.trim_start().starts_with('[');
    let mut cells: Vec<(Role, Range<usize>)> = vec![];
    if bracket {
        let open = inside.start + source.find('[')?;
        let close = open + text[open..inside.end].find(']')?;
        let values = values(text, &(open + 1..close));
        if values.len() < 4 || values.len() > 6 {
            return None;
        }
        let is_sliding = values.get(4).map(|v| text[v.clone()].trim() == "1");
        cells = order.into_iter().zip(values).collect();
        let moving = if is_sliding.or(slides) == Some(true) { Role::D } else { Role::Theta };
        return Some(Told { number: None, cells: with_variable(text, cells, moving, &span), span });
    }
    let parts = values(text, &inside);
    let mut k = 0;
    while k < parts.len() {
        let part = text[parts[k].clone()].trim();
        let name = part.trim_matches(['\'', '"']);
        if let Some((key, _)) = part.split_once('=') {
            if let Some((role, None)) = letter(key.trim()) {
                let start = parts[k].start + text[parts[k].clone()].find('=').unwrap_or(0) + 1;
                cells.push((role, start..parts[k].end));
            }
        } else if name.len() < part.len()
            && let (Some((role, None)), Some(value)) = (letter(name), parts.get(k + 1))
        {
            cells.push((role, value.clone()));
            k += 1;
        }
        k += 1;
    }
    if cells.is_empty() {
        return None;
    }
    let has = |role: Role| cells.iter().any(|c| c.0 == role);
    // A link whose d is not told slides, one whose θ is not told turns.
    let is_sliding = slides.unwrap_or(has(Role::Theta) && !has(Role::D));
    let moving = if is_sliding { Role::D } else { Role::Theta };
    Some(Told { number: None, cells: with_variable(text, cells, moving, &span), span })
}

/// The cells without the one that moves where that holds a number: the variable stands there.
fn with_variable(
    text: &str,
    cells: Vec<(Role, Range<usize>)>,
    moving: Role,
    span: &Range<usize>,
) -> Vec<(Role, Range<usize>)> {
    let holds_name = |r: &Range<usize>| text[r.clone()].contains(|c: char| c.is_alphabetic() && c != 'e');
    let mut kept: Vec<(Role, Range<usize>)> =
        cells.into_iter().filter(|(role, value)| *role != moving || holds_name(value)).collect();
    if !kept.iter().any(|c| c.0 == moving) {
        kept.push((moving, span.start..span.start));
    }
    kept
}
