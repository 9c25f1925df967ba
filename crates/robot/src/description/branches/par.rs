//! `.par` files of SYMORO and OpenSYMORO: the geometric parameters of a tree in Khalil's notation, column by column.
//!
//! A file holds `key = value` and `key = {value, value, …}`, with comments between `(*` and `*)`. Read are the name, `NL`, `NJ`, `NF`,
//! `Type`, the columns `ant sigma mu gamma b alpha d theta r`, masses (`par_masses`), the gravity `G` and the base `Z` (4×4 by rows). With closed loops there
//! are B = NJ − NL frames more for the cut joints, and B for the other sides of the cuts; μ says which joints are driven.

use super::RowTree;
use crate::description::cell::{Place, Style, is_reserved, read_cell, variable_number};
use crate::description::decimals::{Found, name, places, recognise};
use crate::description::diagnostic::{Diagnostic, Diagnostics, nearest};
use crate::description::units::Quantity;
use crate::description::{Decimals, Described, JointKind, MAX_BYTES, MAX_ROWS, Parameter, Row, Variable};
use crate::geometry::{Rotation, Transform, Vector};
use denavit_symbolic::{Angle, Expr, Rational, Symbol};
use std::ops::Range;

/// A value and its place.
#[derive(Clone, Debug)]
pub(super) struct Item<'t> {
    text: &'t str,
    span: Range<usize>,
}

/// What stands behind an equals sign.
pub(super) struct Entry<'t> {
    key: &'t str,
    span: Range<usize>,
    items: Vec<Item<'t>>,
}

/// The columns of the geometry, as OpenSYMORO spells them.
const COLUMNS: [&str; 9] = ["ant", "sigma", "mu", "gamma", "b", "alpha", "d", "theta", "r"];

/// What is known beside the geometry: masses, forces, speeds.
const OTHERS: &[&str] = &[
    "XX",
    "XY",
    "XZ",
    "YY",
    "YZ",
    "ZZ",
    "MX",
    "MY",
    "MZ",
    "M",
    "IA",
    "FV",
    "FS",
    "FX",
    "FY",
    "FZ",
    "CX",
    "CY",
    "CZ",
    "QP",
    "QDP",
    "GAM",
    "W0",
    "WP0",
    "V0",
    "VP0",
    "is_mobile",
    "Content",
    "NL",
    "NJ",
    "NF",
    "Type",
    "G",
    "Z",
];

/// The plain spelling of a key: columns are written in either case.
fn plain(key: &str) -> &str {
    let lower = key.to_lowercase();
    let is_column = |c: &&&str| **c == lower && !matches!(key, "G" | "D");
    COLUMNS.iter().find(is_column).copied().unwrap_or(key)
}

pub(super) struct Reader<'t> {
    text: &'t str,
    pub(super) out: Diagnostics,
    decimals: Decimals,
    /// `(* D3 = 0.45 *)`: names and values in comments.
    values: Vec<(&'t str, Item<'t>)>,
}

/// Reads a `.par` file. With the tree come warnings and notes.
///
/// # Errors
/// All errors of the text (with the warnings and notes), in the order of the text.
pub fn read_par(text: &str, decimals: Decimals) -> Result<(Described, Vec<Diagnostic>), Vec<Diagnostic>> {
    let mut reader = Reader { text, out: Diagnostics::default(), decimals, values: vec![] };
    if text.len() > MAX_BYTES {
        reader.out.error(0..0, format!("the text has {} bytes; {MAX_BYTES} are allowed", text.len()));
        return reader.out.finish(None);
    }
    let entries = reader.entries();
    let tree = reader.tree(&entries);
    reader.out.finish(tree)
}

impl<'t> Reader<'t> {
    /// All `key = value` of the text, comments left out.
    fn entries(&mut self) -> Vec<Entry<'t>> {
        let text = self.text;
        let mut entries: Vec<Entry> = vec![];
        let mut at = 0;
        while at < text.len() {
            let rest = &text[at..];
            if let Some(behind) = rest.strip_prefix("(*") {
                match behind.find("*)") {
                    Some(end) => {
                        self.comment(at + 2..at + 2 + end);
                        at += end + 4;
                    }
                    None => {
                        self.out.error(at..at + 2, "this comment does not end");
                        break;
                    }
                }
                continue;
            }
            if rest.starts_with(char::is_whitespace) || rest.starts_with(['\u{feff}', ';']) {
                at += rest.chars().next().map_or(1, char::len_utf8);
                continue;
            }
            let line = rest.find('\n').unwrap_or(rest.len());
            let Some(equals) = rest[..line].find('=') else {
                self.out.error(at..at + rest[..line].trim_end().len(), "`key = value` is expected here");
                at += line;
                continue;
            };
            let key = rest[..equals].trim();
            let span = at..at + key.len();
            let behind = at + equals + 1;
            let value = &text[behind..];
            let open = value.len() - value.trim_start().len();
            let (inside, end) = if value[open..].starts_with('{') {
                match value.find('}') {
                    Some(end) => (behind + open + 1..behind + end, behind + end + 1),
                    None => {
                        self.out.error(behind + open..behind + open + 1, "this list does not end");
                        break;
                    }
                }
            } else {
                let end = value.find('\n').unwrap_or(value.len());
                let end = value[..end].find("(*").unwrap_or(end);
                (behind..behind + end, behind + end)
            };
            let items = items(text, inside);
            if let Some(first) = entries.iter().find(|e| plain(e.key) == plain(key)) {
                let line = crate::description::line_column(text, first.span.start).0;
                self.out.error(span, format!("`{key}` a second time; the first is in line {line}"));
            } else {
                let known = COLUMNS.iter().chain(OTHERS).copied();
                if !known.clone().any(|k| k == plain(key)) {
                    let shown: String = key.chars().take(40).collect();
                    let finding =
                        self.out.warning(span.clone(), format!("`{}` is not read", shown.escape_debug()));
                    if let Some(near) = nearest(&shown, known) {
                        finding.hint(format!("did you mean `{near}`?"));
                    }
                }
                entries.push(Entry { key, span, items });
            }
            at = end;
        }
        entries
    }

    fn comment(&mut self, inside: Range<usize>) {
        let text = &self.text[inside.clone()];
        if let Some((name, value)) = text.split_once('=') {
            let from = inside.start + name.len() + 1;
            let at = from + (value.len() - value.trim_start().len());
            let value = value.trim();
            self.values.push((name.trim(), Item { text: value, span: at..at + value.len() }));
        }
    }

    /// The values of the names that comments give.
    fn give_values(&mut self, parameters: &mut [Parameter], rows: &[Row]) {
        for (name, item) in std::mem::take(&mut self.values) {
            let Some(p) = parameters.iter_mut().find(|p| *p.symbol.name() == *name) else { continue };
            let turns = rows.iter().flat_map(|r| [r.theta, r.alpha, r.gamma]);
            let is_angle = turns.flat_map(Expr::symbols).any(|s| s == p.symbol);
            let cell = self.cell(&item, if is_angle { Quantity::Angle } else { Quantity::Length });
            if cell.symbols.is_empty() {
                p.value = Some(cell.expr);
            }
        }
    }

    pub(super) fn number(&mut self, entries: &[Entry], key: &str) -> Option<(i64, Range<usize>)> {
        let entry = entries.iter().find(|e| e.key == key)?;
        let item = entry.items.first()?;
        match item.text.parse() {
            Ok(n) => Some((n, item.span.clone())),
            Err(_) => {
                self.out.error(item.span.clone(), format!("`{key}` is a whole number"));
                None
            }
        }
    }

    fn tree(&mut self, entries: &[Entry<'t>]) -> Option<Described> {
        let (links, joints) = (self.number(entries, "NL"), self.number(entries, "NJ"));
        let frames = self.number(entries, "NF");
        let loops = self.loops(entries, [&links, &joints, &frames]);
        let columns = COLUMNS.map(|c| entries.iter().find(|e| plain(e.key) == c));
        let ant = columns[0];
        let told = frames.or(links).map(|f| f.0);
        let count = columns.iter().flatten().map(|e| e.items.len()).max().unwrap_or(0);
        if count == 0 {
            self.out
                .error(0..0, "there are no geometric parameters")
                .hint("ant = {0,1,2}, sigma = {0,0,0}, theta = {th1,th2,th3}, …");
            return None;
        }
        if let Some(more) = columns.iter().flatten().find_map(|e| e.items.get(MAX_ROWS)) {
            self.out.error(more.span.clone(), format!("{count} frames; {MAX_ROWS} are allowed"));
            return None;
        }
        for entry in columns.iter().flatten().filter(|e| e.items.len() != count) {
            let message = format!("`{}` has {} values, others have {count}", entry.key, entry.items.len());
            self.out.error(entry.span.clone(), message);
        }
        if let Some(told) = told.filter(|t| *t != count as i64) {
            let what = if entries.iter().any(|e| e.key == "NF") { "NF" } else { "NL" };
            let span = entries.iter().find(|e| e.key == what).map_or(0..0, |e| e.span.clone());
            self.out.error(span, format!("`{what}` is {told}, the columns have {count} values"));
        }
        // What is there is read, so that all findings come at once.
        let is_whole = !self.out.has_errors();
        let item = |column: usize, j: usize| columns[column].and_then(|e| e.items.get(j));
        let after = self.antecedents(ant, count);
        let mut parameters: Vec<Parameter> = vec![];
        let mut rows: Vec<Row> = vec![];
        for j in 0..count {
            let cells = [3, 4, 5, 6, 7, 8].map(|column| {
                let turns = matches!(column, 3 | 5 | 7);
                let quantity = if turns { Quantity::Angle } else { Quantity::Length };
                item(column, j).map_or(Cell::zero(), |i| self.cell(i, quantity))
            });
            let kind = self.kind(item(1, j), item(2, j), loops.is_some());
            let is_told = columns.iter().flatten().all(|e| j < e.items.len());
            let kind = kind.filter(|_| is_told);
            let is_passive = loops.is_some() && item(2, j).is_none_or(|mu| mu.text == "0");
            let letter = if is_passive { 'p' } else { 'q' };
            rows.push(self.row((j, letter), cells, kind, &rows, &mut parameters));
        }
        let spans: Vec<Range<usize>> = (0..count)
            .map(|j| columns.iter().flatten().find_map(|e| e.items.get(j)).map_or(0..0, |i| i.span.clone()))
            .collect();
        self.give_values(&mut parameters, &rows);
        let (base, gravity) = (self.base(entries), self.gravity(entries));
        let title = self.title();
        self.masses(entries, &mut rows, &mut parameters);
        is_whole.then_some(())?;
        let tree = RowTree {
            name: title,
            source: None,
            parameters,
            rows,
            after: after?,
            base: base?,
            frames: vec![],
            tip: None,
            poses: vec![],
            gravity,
        };
        Some(match loops {
            None => Described::Tree(Box::new(tree)),
            Some(links) => Described::Linkage(Box::new(self.linkage(tree, links, &spans)?)),
        })
    }

    /// `(* Robotname = 'RX90' *)`
    fn title(&self) -> String {
        let behind = self.text.find("Robotname").map(|at| &self.text[at..]);
        let line = behind.and_then(|b| b.lines().next()).and_then(|l| l.split_once('='));
        let name = line.map(|(_, value)| value.trim_end_matches("*)").trim().trim_matches(['\'', '"']));
        name.filter(|n| !n.is_empty()).unwrap_or("robot").replace(|c: char| c.is_control(), " ")
    }

    fn antecedents(&mut self, entry: Option<&Entry>, count: usize) -> Option<Vec<Option<usize>>> {
        let Some(entry) = entry else { return Some((0..count).map(|j: usize| j.checked_sub(1)).collect()) };
        let mut all = vec![];
        for (j, item) in entry.items.iter().enumerate() {
            match item.text.parse::<usize>() {
                Ok(a) if a <= j => all.push(a.checked_sub(1)),
                Ok(a) => {
                    self.out
                        .error(
                            item.span.clone(),
                            format!("frame {} stands on frame {a}, which comes later", j + 1),
                        )
                        .hint("number frames from the base outwards: a(j) < j");
                }
                Err(_) => {
                    self.out
                        .error(item.span.clone(), "an antecedent is the number of a frame, 0 for the base");
                }
            }
        }
        (all.len() == count).then_some(all)
    }

    /// σ and μ.
    fn kind(&mut self, sigma: Option<&Item>, mu: Option<&Item>, is_closed: bool) -> Option<JointKind> {
        let kind = match sigma.map(|s| s.text) {
            Some("0") | None => Some(JointKind::Revolute),
            Some("1") => Some(JointKind::Prismatic),
            Some("2") => None,
            Some(_) => {
                let span = sigma.map_or(0..0, |s| s.span.clone());
                self.out.error(span, "σ is 0 (it turns), 1 (it slides) or 2 (it is fixed)");
                None
            }
        };
        match mu {
            Some(mu) if mu.text != "0" && mu.text != "1" => {
                self.out.error(mu.span.clone(), "μ is 1 (with a motor) or 0");
            }
            Some(mu) if mu.text == "0" && kind.is_some() && !is_closed => {
                self.out.note(mu.span.clone(), "a joint without motor: it moves by itself here");
            }
            _ => {}
        }
        kind
    }

    /// A cell; an angle in decimals is what its digits mean.
    pub(super) fn cell(&mut self, item: &Item, quantity: Quantity) -> Cell {
        let none = Cell { span: item.span.clone(), ..Cell::zero() };
        if let (Quantity::Angle, Decimals::Meant, Some(x)) =
            (quantity, self.decimals, Rational::from_decimal(item.text))
        {
            return match recognise(&x, places(item.text)) {
                Found::Multiple(m) => {
                    let message = format!("{} is read as {} ({})", item.text, name(m.twelfths), m.distance());
                    match m.is_doubtful {
                        true => self.out.warning(item.span.clone(), message),
                        false => self.out.note(item.span.clone(), message),
                    };
                    Cell { expr: Expr::from(Rational::new(m.twelfths, 12)) * Expr::pi(), ..none }
                }
                Found::Nearly(m) => {
                    let message = format!(
                        "{} is nearly {} ({}), and stays as it is",
                        item.text,
                        name(m.twelfths),
                        m.distance()
                    );
                    self.out.note(item.span.clone(), message);
                    Cell { expr: x.into(), ..none }
                }
                Found::Plain => Cell { expr: x.into(), ..none },
            };
        }
        let place = Place { span: item.span.clone(), start: Some(item.span.start) };
        let text = item.text.replace("Pi", "pi");
        let style = Style::plain(quantity);
        match read_cell(&text, &place, &style, &mut self.out) {
            Some(value) => Cell { expr: value.expr, span: item.span.clone(), symbols: value.symbols },
            None => none,
        }
    }

    /// A row, the variable of which has this letter; it is the symbol that its moving cell adds.
    fn row(
        &mut self,
        (j, letter): (usize, char),
        cells: [Cell; 6],
        kind: Option<JointKind>,
        above: &[Row],
        parameters: &mut Vec<Parameter>,
    ) -> Row {
        let moving = match kind {
            Some(JointKind::Revolute) => Some(4),
            Some(JointKind::Prismatic) => Some(5),
            None => None,
        };
        let mut variable = None;
        let mut own: Option<Symbol> = None;
        let has_letter = |r: &&Row| r.variable.is_some_and(|v| v.symbol.name().starts_with(letter));
        let number = above.iter().filter(has_letter).count() + 1;
        if let (Some(kind), Some(at)) = (kind, moving) {
            let cell = &cells[at];
            let summands: Vec<Symbol> =
                Angle::of(cell.expr).terms.iter().filter_map(|t| t.0.as_symbol()).collect();
            let usual = [
                format!("th{}", j + 1),
                format!("t{}", j + 1),
                format!("theta{}", j + 1),
                format!("q{}", j + 1),
                format!("r{}", j + 1),
            ];
            let named = summands.iter().find(|s| usual.iter().any(|u| *u.as_str() == *s.name()));
            own = named.or(summands.first()).copied();
            if own.is_none() {
                let (letter, what) = if at == 4 { ("theta", "turns") } else { ("r", "slides") };
                self.out
                    .error(
                        cell.span.clone(),
                        format!("frame {} {what}, but its `{letter}` holds no variable", j + 1),
                    )
                    .hint(format!("{letter} = {{…, th{}, …}}, or sigma 2 for a frame that is fixed", j + 1));
            }
            variable = own.map(|_| Variable { symbol: Symbol::new(&format!("{letter}{number}")), kind });
        }
        for cell in &cells {
            for (name, span) in &cell.symbols {
                let symbol = Symbol::new(name);
                let is_known = Some(symbol) == own || parameters.iter().any(|p| p.symbol == symbol);
                if is_known {
                    continue;
                }
                if is_reserved(name) || variable_number(name).is_some() {
                    self.out
                        .error(span.clone(), format!("`{name}` is no name of a length here"))
                        .hint("a row has its own variable; C1, S2, q1, pi, mm and functions are taken");
                    continue;
                }
                parameters.push(Parameter { symbol, value: None });
            }
        }
        let q = Expr::symbol(&format!("{letter}{number}"));
        let e = |i: usize| cells[i].expr.substitute(|s| (Some(s) == own).then_some(q));
        let elsewhere = (0..6)
            .filter(|i| Some(*i) != moving)
            .find(|&i| own.is_some_and(|s| cells[i].expr.symbols().contains(&s)));
        if let Some(i) = elsewhere {
            self.out.error(cells[i].span.clone(), "the variable of this frame stands in a second cell");
        }
        Row { gamma: e(0), b: e(1), alpha: e(2), a: e(3), theta: e(4), d: e(5), variable, ..Row::still() }
    }

    /// `Z`: frame 0 in the base, 4×4 by rows.
    fn base(&mut self, entries: &[Entry]) -> Option<Transform<Expr>> {
        let Some(entry) = entries.iter().find(|e| e.key == "Z") else { return Some(Transform::identity()) };
        if entry.items.len() != 16 {
            self.out.error(entry.span.clone(), format!("`Z` has 16 values, not {}", entry.items.len()));
            return None;
        }
        let mut e = vec![];
        for (k, item) in entry.items.iter().enumerate() {
            let quantity = if k % 4 == 3 && k < 12 { Quantity::Length } else { Quantity::Number };
            let cell = self.cell(item, quantity);
            if let Some((name, span)) = cell.symbols.first() {
                self.out.error(span.clone(), format!("`{name}` stands where a number is needed"));
                return None;
            }
            e.push(cell.expr);
        }
        let numbers: Vec<f64> = e.iter().map(|e| e.eval(|_| None).unwrap_or(f64::NAN)).collect();
        let m = [0, 1, 2, 3].map(|i| [0, 1, 2, 3].map(|j| numbers[4 * i + j]));
        if let Err(why) = Transform::from_matrix(m) {
            self.out.error(entry.span.clone(), format!("`Z` is no rigid transform: {why}"));
            return None;
        }
        let rotation = Rotation::from_rows([0, 1, 2].map(|i| [0, 1, 2].map(|j| e[4 * i + j])));
        Some(Transform::from_rotation_translation(rotation, Vector([e[3], e[7], e[11]])))
    }

    /// `G`, where it is numbers.
    fn gravity(&mut self, entries: &[Entry]) -> Option<[Expr; 3]> {
        let entry = entries.iter().find(|e| e.key == "G")?;
        let three: Vec<Rational> =
            entry.items.iter().filter_map(|i| Rational::from_decimal(i.text)).collect();
        let g: [Rational; 3] = three.try_into().ok()?;
        g.iter().any(|x| !x.is_zero()).then(|| g.map(Expr::from))
    }
}

impl<'t> Entry<'t> {
    /// Its key.
    pub(super) fn key(&self) -> &'t str {
        self.key
    }

    /// Its place in the text.
    pub(super) fn place(&self) -> Range<usize> {
        self.span.clone()
    }

    /// One of its values.
    pub(super) fn item(&self, j: usize) -> Option<&Item<'t>> {
        self.items.get(j)
    }

    /// The texts of its values.
    pub(super) fn texts(&self) -> impl Iterator<Item = &'t str> {
        self.items.iter().map(|i| i.text)
    }
}

/// A cell as it was read.
#[derive(Clone, Debug)]
pub(super) struct Cell {
    expr: Expr,
    span: Range<usize>,
    symbols: Vec<(String, Range<usize>)>,
}

impl Cell {
    fn zero() -> Self {
        Cell { expr: Expr::int(0), span: 0..0, symbols: vec![] }
    }

    /// What it is.
    pub(super) fn value(&self) -> Expr {
        self.expr
    }

    /// The names in it.
    pub(super) fn names(&self) -> impl Iterator<Item = &str> {
        self.symbols.iter().map(|s| s.0.as_str())
    }
}

/// What stands between commas that are in no brackets.
fn items(text: &str, inside: Range<usize>) -> Vec<Item<'_>> {
    let (mut depth, mut start) = (0_i32, inside.start);
    let mut all = vec![];
    let mut push = |from: usize, to: usize| {
        let part = &text[from..to];
        let trimmed = part.trim();
        let at = from + (part.len() - part.trim_start().len());
        all.push(Item { text: trimmed, span: at..at + trimmed.len() });
    };
    for (at, c) in text[inside.clone()].char_indices() {
        match c {
            '(' => depth += 1,
            ')' => depth -= 1,
            ',' if depth <= 0 => {
                push(start, inside.start + at);
                start = inside.start + at + 1;
            }
            _ => {}
        }
    }
    push(start, inside.end);
    all
}
