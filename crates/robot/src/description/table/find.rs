//! Where a text has something with rows and columns.

use super::columns::{Role, column};
use super::layout::number_before;
use super::{TableKind, latex, lines};
use crate::description::units::unit_named;
use std::ops::Range;

/// A cell of a grid: its text and place, without the space around it.
#[derive(Clone, Debug)]
pub(super) struct GridCell {
    pub text: String,
    pub span: Range<usize>,
}

impl GridCell {
    /// The part of `text` in `span`, trimmed.
    pub fn of(text: &str, span: Range<usize>) -> Self {
        let raw = &text[span.clone()];
        let start = span.start + (raw.len() - raw.trim_start().len());
        GridCell { text: raw.trim().to_string(), span: start..start + raw.trim().len() }
    }
}

/// Rows of cells.
#[derive(Clone, Debug)]
pub(super) struct Grid {
    pub rows: Vec<Vec<GridCell>>,
    pub span: Range<usize>,
    pub separator: Separator,
    /// A line of dashes below the first row says that it is a header.
    pub ruled: bool,
}

/// What stands between the cells of a row.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Separator {
    Pipe,
    /// Tab, comma or semicolon.
    Field(char),
    /// Blanks: columns that are set below one another.
    Blank,
    /// `&`, with `\\` behind each row.
    Latex,
}

/// The longest row that is looked at, and the most rows.
const MAX_COLUMNS: usize = 600;

/// All grids of a text in their order.
pub(super) fn grids(text: &str, kind: TableKind) -> Vec<Grid> {
    let drawn = with_plain_bars(text);
    let text = drawn.as_deref().unwrap_or(text);
    let open = without_lone_bars(text).filter(|_| matches!(kind, TableKind::Markdown));
    let text = open.as_deref().unwrap_or(text);
    let mut found = match kind {
        TableKind::Markdown => {
            let mut grids = blocks(text, Separator::Pipe, false);
            grids.extend(blocks(text, Separator::Field('\t'), false));
            grids.extend(latex::grids(text));
            // Among other text, commas and blanks make a table only below a line of its letters.
            let is_free = |g: &Grid, all: &[Grid]| {
                !all.iter().any(|o| o.span.start < g.span.end && g.span.start < o.span.end)
            };
            for separator in [Separator::Field(';'), Separator::Field(','), Separator::Blank] {
                let below = headed(text, separator);
                let free: Vec<Grid> = below.into_iter().filter(|g| is_free(g, &grids)).collect();
                grids.extend(free);
            }
            let turned: Vec<Grid> = turned(text).into_iter().filter(|g| is_free(g, &grids)).collect();
            grids.extend(turned);
            grids
        }
        TableKind::Csv => {
            let fields = |d: char| blocks(text, Separator::Field(d), true);
            let count = |d: char| fields(d).iter().map(|g| g.rows.len()).sum::<usize>();
            fields([',', ';', '\t'].into_iter().max_by_key(|&d| count(d)).unwrap_or(','))
        }
        TableKind::Latex => latex::grids(text),
    };
    found.retain(|g| g.rows.iter().all(|r| r.len() <= MAX_COLUMNS));
    found.sort_by_key(|g| g.span.start);
    found
}

/// A text with `|` for bars that are drawn, `│`, byte for byte; nothing for other texts.
fn with_plain_bars(text: &str) -> Option<String> {
    const BARS: [char; 3] = ['│', '┃', '║'];
    let plain = |text: &str| BARS.iter().fold(text.to_string(), |t, bar| t.replace(*bar, "|  "));
    text.contains(BARS).then(|| plain(text))
}

/// A text with blanks for the one bar behind the number of each row, `i | a  alpha  d  theta`, byte for byte; nothing for other texts.
fn without_lone_bars(text: &str) -> Option<String> {
    let mut bytes = text.as_bytes().to_vec();
    let (mut is_open, mut is_any) = (false, false);
    for span in lines(text) {
        let line = uncommented(text, span.clone());
        let Some(bar) = text[line.clone()].find('|').map(|i| line.start + i) else {
            // A rule below the head.
            is_open &= is_line(&text[line]);
            continue;
        };
        let (number, cells) = (text[line.start..bar].trim(), split_blanks(text, bar + 1..line.end, None));
        let is_lone = !text[bar + 1..line.end].contains('|') && number.len() <= 8;
        let letters = cells.iter().filter(|c| column(&c.text).role.is_letter()).count();
        let is_head = letters >= 4 && cells.len() == letters && column(number).role == Role::Index;
        let is_row = is_open && cells.len() >= 4 && !number.is_empty() && is_numbered(number);
        is_open = is_lone && (is_head || is_row);
        if is_open {
            bytes[bar] = b' ';
            is_any = true;
        }
    }
    if is_any { String::from_utf8(bytes).ok() } else { None }
}

/// True for a line that is drawn: `-----+----`.
fn is_line(line: &str) -> bool {
    let line = line.trim();
    line.len() > 2 && line.chars().all(|c| "-= +_─┼═╪".contains(c))
}

/// The lines of a text with their places, without the line ends.
pub(super) fn lines(text: &str) -> impl Iterator<Item = Range<usize>> {
    let mut start = 0;
    text.split_inclusive('\n').map(move |line| {
        let span = start..start + line.trim_end_matches(['\n', '\r']).len();
        start += line.len();
        span
    })
}

/// Runs of lines that are rows. A run begins with a line of three cells or more; inside it a line with too few
/// cells is a row, too, so that the fault can be told. With `loose`, blank lines and comments do not end a run.
fn blocks(text: &str, separator: Separator, loose: bool) -> Vec<Grid> {
    let mut grids: Vec<Grid> = vec![];
    let mut open = false;
    for span in lines(text) {
        let line = text[span.clone()].trim();
        if loose && (line.is_empty() || line.starts_with('#')) {
            continue;
        }
        let mut cells = match separator {
            Separator::Field(delimiter) => split_fields(text, span.clone(), delimiter),
            _ => split_pipes(text, span.clone()),
        };
        // A single dash is a rule below a heading; elsewhere it may stand for an entry.
        let is_below_heading = open && grids.last().is_some_and(|grid| grid.rows.len() == 1);
        let least = if is_below_heading && separator == Separator::Pipe { 1 } else { 2 };
        let rule = cells.iter().all(|cell| is_rule(cell, least));
        // `+---+-------+` above and below the rows of a frame of characters.
        if separator == Separator::Pipe && is_frame(line) {
            if let Some(grid) = grids.last_mut().filter(|_| open) {
                grid.ruled |= grid.rows.len() == 1;
                grid.span.end = span.end;
            }
            continue;
        }
        let mut grid = grids.last_mut().filter(|_| open);
        // A head without the column of the rows' names: `      | theta | d | a | alpha`, `yaw | a | 0 | 0 | -90°`.
        if let Some(grid) = &mut grid
            && separator == Separator::Pipe
            && !rule
            && !line.starts_with('|')
            && grid.rows.len() == 1
            && cells.len() == grid.rows[0].len() + 1
            && text[grid.span.clone()].trim_start().starts_with('|')
        {
            let at = grid.rows[0][0].span.start;
            grid.rows[0].insert(0, GridCell { text: String::new(), span: at..at });
        }
        open = match &grid {
            _ if !rule && (cells[0].text.contains('=') || lines::directive(line).is_some()) => false,
            Some(grid) => is_row(line, &cells, grid, loose),
            None => cells.len() >= 3 || separator == Separator::Pipe && is_framed(line),
        };
        if grid.is_some() && open && separator == Separator::Pipe && !line.ends_with('|') {
            cells.last_mut().into_iter().for_each(|cell| *cell = before_words(text, cell));
        }
        match grid {
            _ if !open => {}
            Some(grid) => {
                grid.span.end = span.end;
                grid.ruled |= rule && grid.rows.len() == 1;
                if !rule {
                    grid.rows.push(cells);
                }
            }
            None => {
                let rows = if rule { vec![] } else { vec![cells] };
                grids.push(Grid { rows, span, separator, ruled: false });
            }
        }
    }
    grids
}

/// The lines below each line whose cells are the letters of a table, as far as they have as many cells and begin with a
/// number or a name with one.
fn headed(text: &str, separator: Separator) -> Vec<Grid> {
    let split = |span: &Range<usize>, width: Option<usize>| match separator {
        Separator::Field(delimiter) => split_fields(text, span.clone(), delimiter),
        _ => split_blanks(text, span.clone(), width),
    };
    let mut grids: Vec<Grid> = vec![];
    let mut open = false;
    for span in lines(text) {
        let span = uncommented(text, span);
        let line = text[span.clone()].trim();
        if line.len() > 500 {
            open = false;
            continue;
        }
        let grid = grids.last_mut().filter(|_| open);
        if let Some(grid) = grid {
            if is_line(line) {
                continue;
            }
            let width = grid.rows.first().map_or(0, Vec::len);
            let span = before_remark(text, behind_index(text, span.clone()));
            let mut cells = split(&span, Some(width));
            // Rows may say their number where the head has no column for it.
            if grid.rows.len() == 1 && cells.len() != width {
                let wider = split(&span, Some(width + 1));
                let is_labelled =
                    wider.len() == width + 1 && (is_numbered(&wider[0].text) || is_named_row(&wider));
                if is_labelled && !grid.rows[0].iter().any(|c| column(&c.text).role == Role::Index) {
                    let at = grid.rows[0][0].span.start;
                    grid.rows[0].insert(0, GridCell { text: String::new(), span: at..at });
                    cells = wider;
                }
            }
            let width = grid.rows.first().map_or(0, Vec::len);
            let has_index = grid.rows[0].iter().any(|c| column(&c.text).role == Role::Index);
            // `6   0   l2   0   0   tool (fixed)`: words behind the cells.
            let is_remark = |c: &GridCell| {
                c.text.chars().filter(|c| c.is_alphabetic()).count() > 3
                    && c.text.chars().all(|c| c.is_alphabetic() || " ,()-.".contains(c))
            };
            if cells.len() == width + 1 && has_index && cells.last().is_some_and(is_remark) {
                cells.pop();
            }
            let is_value = |c: &GridCell| {
                let is_whole = c.text.matches('(').count() == c.text.matches(')').count();
                c.text.len() < 24 && c.text.split(' ').count() < 4 && is_whole && !c.text.contains(':')
            };
            let begins = |cells: &[GridCell]| match has_index {
                true => is_numbered(&cells[0].text) || is_named_row(cells),
                false => {
                    cells.iter().all(is_value)
                        && cells.iter().any(|c| c.text.contains(|x: char| x.is_ascii_digit()))
                }
            };
            let is_row = cells.len() == width && !text[span.clone()].contains('=') && begins(&cells);
            if is_row {
                grid.span.end = span.end;
                grid.rows.push(cells);
                continue;
            }
        }
        // `Standard DH:   i   alpha   a   d   theta`
        let span = before_remark(text, span);
        let behind = text[span.clone()].rfind(':').map(|n| span.start + n + 1..span.end);
        let header = [Some(span.clone()), behind]
            .into_iter()
            .flatten()
            .find(|part| is_header(text[part.clone()].trim(), &split(part, None), separator));
        open = header.is_some();
        if let Some(header) = header {
            grids.push(Grid {
                rows: vec![split(&header, None)],
                span: header.start..span.end,
                separator,
                ruled: true,
            });
        }
    }
    grids.retain(|g| g.rows.len() > 1);
    grids
}

/// Lines of blanks that begin with a letter of a table each: its rows and columns are swapped.
fn turned(text: &str) -> Vec<Grid> {
    let mut grids: Vec<Grid> = vec![];
    let mut run: Vec<(Vec<GridCell>, Range<usize>)> = vec![];
    let mut close = |run: &mut Vec<(Vec<GridCell>, Range<usize>)>| {
        let letters = run.iter().filter(|r| column(&r.0[0].text).role.is_letter()).count();
        if letters >= 3 {
            let span = run[0].1.start..run[run.len() - 1].1.end;
            let rows = run.drain(..).map(|r| r.0).collect();
            grids.push(Grid { rows, span, separator: Separator::Blank, ruled: false });
        }
        run.clear();
    };
    for span in lines(text).map(|l| uncommented(text, l)).chain(std::iter::once(text.len()..text.len())) {
        let line = text[span.clone()].trim();
        let is_plain = line.len() < 300 && !line.contains(['=', '|', '&', '\t', ':']);
        let cells = if is_plain { split_blanks(text, span.clone(), None) } else { vec![] };
        let role = cells.first().filter(|_| cells.len() > 2).map(|c| column(&c.text).role);
        let is_one = role.is_some_and(|r| r.is_letter() || r == Role::Index && !cells[0].text.is_empty());
        if cells.len() < 3 || !is_one || run.first().is_some_and(|r| r.0.len() != cells.len()) {
            close(&mut run);
        }
        if cells.len() >= 3 && is_one {
            run.push((cells, span));
        }
    }
    close(&mut run);
    grids
}

/// A line without the mark of a comment before it.
pub(super) fn uncommented(text: &str, span: Range<usize>) -> Range<usize> {
    let line = &text[span.clone()];
    let bare = line.trim_start().trim_start_matches(['%', '#', '/', '*', '>']);
    match bare.starts_with([' ', '\t']) {
        true => span.end - bare.len()..span.end,
        false => span,
    }
}

/// A line behind `i = `, where a row's number stands.
fn behind_index(text: &str, span: Range<usize>) -> Range<usize> {
    let line = &text[span.clone()];
    let Some((before, rest)) = line.split_once('=') else { return span };
    let is_index = matches!(before.trim(), "i" | "j" | "k" | "n" | "link" | "joint");
    if is_index { span.end - rest.len()..span.end } else { span }
}

/// A line without the remark in brackets, or behind an arrow, that stands apart behind it: `3   q3   0   l3   0     (mm)`,
/// `4   -q2-q3   0   a4   0    <- passive`.
fn before_remark(text: &str, span: Range<usize>) -> Range<usize> {
    const ARROWS: [&str; 5] = ["  <-", "  ←", "  //", "  # ", "  ! "];
    let arrow = ARROWS.iter().filter_map(|a| text[span.clone()].find(a)).min();
    let span = match arrow.filter(|at| !text[span.start..span.start + at].trim().is_empty()) {
        Some(at) => span.start..span.start + at,
        None => span,
    };
    let line = text[span.clone()].trim_end();
    let open = match line.chars().next_back() {
        Some(')') => "  (",
        Some(']') => "  [",
        _ => return span,
    };
    let Some(at) = line.rfind(open) else { return span };
    let is_one = !line[at + open.len()..line.len() - 1].contains(['(', ')', '[', ']']);
    if is_one && !line[..at].trim().is_empty() { span.start..span.start + at } else { span }
}

/// A cell without the words that stand apart behind it: `th1      slewing ring`.
fn before_words(text: &str, cell: &GridCell) -> GridCell {
    let shown = cell.text.as_str();
    let Some(at) = shown.find("  ") else { return cell.clone() };
    let word: String = shown[at..].trim_start().chars().take_while(|c| c.is_alphabetic()).collect();
    // `0      (prismatic, d3 > 0)`
    let is_remark = shown[at..].trim_start().starts_with('(') && shown.ends_with(')')
        || shown[at..].trim_start().starts_with(['←', '<']);
    let is_word = word.chars().count() > 2 && unit_named(&word).is_none() || is_remark;
    match is_word && text.get(cell.span.clone()).is_some_and(|own| own == shown) {
        true => GridCell::of(text, cell.span.start..cell.span.start + at),
        false => cell.clone(),
    }
}

/// True for a line of nothing but heads of columns.
fn is_header(line: &str, cells: &[GridCell], separator: Separator) -> bool {
    let mut roles: Vec<Role> = cells.iter().map(|c| column(&c.text).role).collect();
    // `DH table   theta   d   a   alpha`: words stand above the numbers of the rows.
    if roles.first() == Some(&Role::Other) && roles[1..].iter().filter(|r| r.is_letter()).count() >= 4 {
        roles[0] = Role::Index;
    }
    let letters = roles.iter().filter(|r| r.is_letter()).count();
    let others = roles.iter().filter(|r| **r == Role::Other).count();
    letters >= 3
        && others == 0
        && roles.iter().any(|r| matches!(r, Role::Alpha | Role::Theta))
        && !line.contains('=')
        && (separator != Separator::Blank || !line.contains(['|', '&', '\t']))
}

/// `3`, `Link 3`, `J3`, `3 elbow`
fn is_numbered(cell: &str) -> bool {
    if number_before(cell).is_some() {
        return true;
    }
    // `axis 2 (shoulder):`
    let bare = cell.trim_end_matches([':', '.', ' ']);
    let bare = bare.strip_suffix(')').and_then(|b| b.rsplit_once('(')).map_or(bare, |b| b.0.trim_end());
    let cell = bare.trim_end_matches([':', '.', ' ']);
    let name = cell.trim_end_matches(|c: char| c.is_ascii_digit());
    name.len() < cell.len() && name.chars().all(|c| c.is_alphabetic() || matches!(c, ' ' | '_' | '.' | '#'))
}

/// `boom   b   0   2.10   0 deg`: a word before values with a number among them.
fn is_named_row(cells: &[GridCell]) -> bool {
    let Some((name, values)) = cells.split_first() else { return false };
    let is_word =
        name.text.chars().count() < 24 && name.text.chars().all(|c| c.is_alphabetic() || "_-. ".contains(c));
    let is_value =
        |c: &GridCell| c.text.len() < 24 && c.text.split(' ').count() < 4 && !c.text.contains([':', '=']);
    let has_digit = |c: &GridCell| c.text.contains(|x: char| x.is_ascii_digit());
    is_word && !name.text.is_empty() && values.iter().all(is_value) && values.iter().any(has_digit)
}

/// The cells of a line with blanks between them: two or more, or single ones where these make the told number of cells.
fn split_blanks(text: &str, span: Range<usize>, width: Option<usize>) -> Vec<GridCell> {
    let pieces = |least: usize| {
        let line = &text[span.clone()];
        let mut cells: Vec<GridCell> = vec![];
        let mut start: Option<usize> = None;
        let mut blanks = 0;
        for (i, c) in line.char_indices() {
            if c.is_whitespace() {
                blanks += 1;
                continue;
            }
            if let Some(from) = start.filter(|_| blanks >= least) {
                cells.push(GridCell::of(text, span.start + from..span.start + i));
                start = None;
            }
            start = start.or(Some(i));
            blanks = 0;
        }
        if let Some(from) = start {
            cells.push(GridCell::of(text, span.start + from..span.end));
        }
        // `90 deg` is one cell.
        let mut joined: Vec<GridCell> = vec![];
        for cell in cells {
            let is_unit = matches!(cell.text.as_str(), "deg" | "rad" | "°" | "mm" | "cm" | "m" | "degrees");
            match joined.last_mut() {
                Some(last) if is_unit && last.text.ends_with(|c: char| c.is_ascii_digit()) => {
                    *last = GridCell::of(text, last.span.start..cell.span.end);
                }
                _ => joined.push(cell),
            }
        }
        joined
    };
    let (wide, narrow) = (pieces(2), pieces(1));
    match width {
        Some(width) if wide.len() != width && narrow.len() == width => narrow,
        None if wide.iter().filter(|c| column(&c.text).role.is_letter()).count() < 3 => narrow,
        _ => wide,
    }
}

/// Whether a line below the rows of a grid is one of them, be it too short or too long.
fn is_row(line: &str, cells: &[GridCell], grid: &Grid, loose: bool) -> bool {
    let width = grid.rows.first().map_or(0, Vec::len);
    let numbered = !cells[0].text.is_empty() && cells[0].text.chars().all(|c| c.is_ascii_digit());
    match (grid.separator, cells.len()) {
        (_, count) if count == width => true,
        (_, 1) => numbered && loose || grid.separator == Separator::Pipe && is_framed(line),
        (Separator::Pipe, _) => line.starts_with('|') || numbered,
        (_, 2) => numbered || loose,
        _ => true,
    }
}

/// `| … |`
fn is_framed(line: &str) -> bool {
    line.len() > 1 && line.starts_with('|') && line.ends_with('|')
}

/// `+---+-------+`, `---+-------`
fn is_frame(line: &str) -> bool {
    let is_open = line.starts_with(['-', '─', '═']) && line.contains(['+', '┼', '╪']) && line.len() > 8;
    line.len() > 4
        && (is_open || line.starts_with(['+', '├', '┌', '└', '╞']))
        && line.chars().all(|c| {
            matches!(
                c,
                '+' | '-'
                    | '='
                    | '─'
                    | '┬'
                    | '┼'
                    | '┴'
                    | '├'
                    | '┤'
                    | '┌'
                    | '┐'
                    | '└'
                    | '┘'
                    | '═'
                    | '╞'
                    | '╡'
                    | '╪'
            )
        })
}

/// `---`, `:--:`, of so many characters at least.
fn is_rule(cell: &GridCell, least: usize) -> bool {
    cell.text.len() >= least && cell.text.chars().all(|c| matches!(c, '-' | ':' | '=' | '+'))
}

/// The cells of a line with `|` between them.
fn split_pipes(text: &str, span: Range<usize>) -> Vec<GridCell> {
    let line = &text[span.clone()];
    let mut cuts = vec![];
    let mut escaped = false;
    for (i, c) in line.char_indices() {
        if c == '|' && !escaped {
            cuts.push(span.start + i);
        }
        escaped = c == '\\';
    }
    let mut cells = cells_between(text, span, &cuts);
    if cells.len() < 2 {
        return cells;
    }
    if cells.first().is_some_and(|c| c.text.is_empty()) && line.trim_start().starts_with('|') {
        cells.remove(0);
    }
    if cells.len() > 1 && cells.last().is_some_and(|c| c.text.is_empty()) && line.trim_end().ends_with('|') {
        cells.pop();
    }
    cells
}

/// The fields of a line; a field in quotes may hold the delimiter.
fn split_fields(text: &str, span: Range<usize>, delimiter: char) -> Vec<GridCell> {
    let line = &text[span.clone()];
    let mut cuts = vec![];
    let mut quoted = false;
    for (i, c) in line.char_indices() {
        match c {
            '"' if delimiter != '\t' => quoted = !quoted,
            c if c == delimiter && !quoted => cuts.push(span.start + i),
            _ => {}
        }
    }
    let mut cells = cells_between(text, span, &cuts);
    for cell in &mut cells {
        if cell.text.len() >= 2 && cell.text.starts_with('"') && cell.text.ends_with('"') {
            *cell = GridCell::of(text, cell.span.start + 1..cell.span.end - 1);
        }
    }
    cells
}

/// The pieces of `span` between one-byte separators.
pub(super) fn cells_between(text: &str, span: Range<usize>, cuts: &[usize]) -> Vec<GridCell> {
    let starts = std::iter::once(span.start).chain(cuts.iter().map(|c| c + 1));
    let ends = cuts.iter().copied().chain([span.end]);
    starts.zip(ends).map(|(start, end)| GridCell::of(text, start..end)).collect()
}
