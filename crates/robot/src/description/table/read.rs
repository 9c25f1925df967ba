//! From the cells of a table to a description.

use super::after::antecedents;
use super::columns::{Column, Role};
use super::find::{GridCell, Separator};
use super::joint::{Given, Joint, joints};
use super::layout::Layout;
use super::letters::{Letters, check_letters, columns, convention, letters};
use super::lines::{Around, Lines};
use super::marks::{with_numbers, without_stars};
use super::said::millimetres_said;
use super::{TableOptions, limits, values};
use crate::description::cell::{Place, Style, name_of, read_cell, variable_number};
use crate::description::diagnostic::{Diagnostic, Diagnostics};
use crate::description::rows::{self, Cell, Cells};
use crate::description::units::{Quantity, Unit, unit_named};
use crate::description::{Convention, Description, JointKind, Row, suspicious_number};
use crate::geometry::Transform;
use denavit_symbolic::{Angle, Expr, Symbol};
use rustc_hash::FxHashSet;
use std::f64::consts::{PI, TAU};
use std::ops::Range;

/// What a table says.
pub(super) struct Reading {
    pub description: Description,
    /// The names that the table gives the joint variables.
    pub variables: Vec<Option<String>>,
    /// The letters of the columns for the lengths along x and z.
    pub along_x: Option<&'static str>,
    pub along_z: Option<&'static str>,
    /// The index of the length along x is that of the row before: `a_{i-1}`.
    pub previous: bool,
    /// The row that each stands on, where a column says it and it is not always the one above.
    pub after: Option<Vec<Option<usize>>>,
}

/// A cell of the table.
#[derive(Clone, Debug)]
pub(super) struct TableCell {
    pub cell: Cell,
    /// Marked as the variable: `θ1*`.
    pub star: bool,
    /// Says that it is the variable and nothing else: `*`, `var`.
    pub marker: bool,
    /// Numbers without unit.
    bare: Vec<(f64, Range<usize>)>,
}

/// A row of the table.
#[derive(Clone, Debug)]
pub(super) struct ReadRow<'a> {
    /// As the table numbers it.
    pub number: usize,
    pub theta: TableCell,
    /// The length along z.
    pub z: TableCell,
    pub x: TableCell,
    pub alpha: TableCell,
    pub gamma: TableCell,
    pub b: TableCell,
    /// Read as an angle, to see whether it is in degrees.
    offset_bare: Vec<(f64, Range<usize>)>,
    span: Range<usize>,
    columns: &'a [Column],
    source: &'a [GridCell],
}

impl<'a> ReadRow<'a> {
    /// The text in the column with a role.
    pub fn source(&self, role: Role) -> Option<&'a GridCell> {
        self.source.get(self.columns.iter().position(|c| c.role == role)?)
    }

    /// The unit of the column with a role, if it measures this.
    pub fn unit(&self, role: Role, quantity: Quantity) -> Option<Unit> {
        let column = self.columns.iter().find(|c| c.role == role);
        column.and_then(|c| c.unit).filter(|u| u.quantity == quantity)
    }

    /// θ, z, x, α, γ, b.
    pub fn cells(&self) -> [&TableCell; 6] {
        [&self.theta, &self.z, &self.x, &self.alpha, &self.gamma, &self.b]
    }

    fn cells_mut(&mut self) -> [&mut TableCell; 6] {
        [&mut self.theta, &mut self.z, &mut self.x, &mut self.alpha, &mut self.gamma, &mut self.b]
    }
}

/// The units of numbers without one.
#[derive(Clone, Copy)]
pub(super) struct BareUnits {
    pub angle: Option<Unit>,
    pub length: Option<Unit>,
    pub decimal_comma: bool,
}

impl BareUnits {
    pub fn style(&self, quantity: Quantity, column: Option<Unit>) -> Style {
        let told = match quantity {
            Quantity::Angle => self.angle,
            Quantity::Length => self.length,
            _ => None,
        };
        let bare = column.or(told).filter(|u| !u.factor().is_one()); // SI is what nothing says
        Style { bare, document: true, decimal_comma: self.decimal_comma, ..Style::of(quantity) }
    }
}

/// The description of the tables, joined. Lines in `around` speak of them.
///
/// Where the convention is not told, what every convention would find is reported with it.
pub(super) fn description(
    text: &str,
    layouts: &[&Layout],
    lines: &Lines,
    around: &Around,
    options: &TableOptions,
    out: &mut Diagnostics,
) -> Option<Reading> {
    let mut told_columns = vec![];
    for layout in layouts {
        told_columns.push(columns(layout, lines, options, out)?);
    }
    let first = (layouts[0], told_columns[0].as_slice());
    check_letters(first.0, first.1, out)?;
    let settled = [
        (options.convention.is_some(), "convention"),
        (options.columns.is_some(), "columns"),
        (options.angles_in_degrees.is_some(), "angles"),
        (options.lengths_in_millimetres.is_some(), "lengths"),
    ];
    let settled: Vec<&str> = settled.into_iter().filter(|s| s.0).map(|s| s.1).collect();
    lines.check(text, &around.directives, &settled, out);
    let tables = Tables { text, layouts, columns: &told_columns, lines, around, options };
    if let Some(convention) = convention(text, first.0, first.1, lines, options, out) {
        let letters = letters(first.0, first.1, convention, out)?;
        return Some(read_as(&letters, &tables, out));
    }
    let mut common: Option<Vec<Diagnostic>> = None;
    for convention in Convention::ALL {
        let Some(letters) = letters(first.0, first.1, convention, &mut Diagnostics::default()) else {
            continue;
        };
        let mut found = Diagnostics::default();
        read_as(&letters, &tables, &mut found);
        match &mut common {
            Some(common) => common.retain(|f| found.list().contains(f)),
            None => common = Some(found.list().to_vec()),
        }
    }
    common.into_iter().flatten().for_each(|f| out.add(f));
    None
}

/// Tables that are one, and what is said about them.
struct Tables<'a> {
    text: &'a str,
    layouts: &'a [&'a Layout],
    columns: &'a [Vec<Column>],
    lines: &'a Lines,
    around: &'a Around,
    options: &'a TableOptions,
}

/// A name without the backslashes that Markdown and LaTeX want before some signs: `arm\_1`.
fn plain_name(text: &str) -> String {
    let mut name = String::new();
    let mut rest = text.chars().peekable();
    while let Some(c) = rest.next() {
        let is_escape = c == '\\' && rest.peek().is_some_and(char::is_ascii_punctuation);
        name.extend(if is_escape { rest.next() } else { Some(c) });
    }
    name
}

/// True for tables that write a half as `0,5`.
fn has_decimal_commas(layouts: &[&Layout]) -> bool {
    let is_number = |text: &str, mark: char| {
        let parts: Vec<&str> = text.trim().trim_start_matches(['-', '−', '$']).split(mark).collect();
        let digits = |s: &str| s.chars().take_while(char::is_ascii_digit).count();
        matches!(parts[..], [whole, rest] if digits(whole) == whole.len() && !whole.is_empty() && digits(rest) > 0)
    };
    let any =
        |mark: char| layouts.iter().flat_map(|l| l.rows.iter().flatten()).any(|c| is_number(&c.text, mark));
    match layouts[0].separator {
        Separator::Field(';') => true,
        Separator::Field(',') => false,
        _ => any(',') && !any('.'),
    }
}

/// The description under a convention.
fn read_as(letters: &Letters, tables: &Tables, out: &mut Diagnostics) -> Reading {
    let &Tables { text, layouts, columns: told_columns, lines, around, options } = tables;
    let at = layouts[0].span.start;
    for (layout, columns) in layouts.iter().zip(told_columns) {
        check_columns(layout, columns, &told_columns[0], out);
    }
    let mut units = BareUnits {
        angle: match options.angles_in_degrees {
            Some(degrees) => unit_named(if degrees { "deg" } else { "rad" }),
            None => told("angles", Quantity::Angle, lines, at, out),
        },
        length: match options.lengths_in_millimetres {
            Some(millimetres) => unit_named(if millimetres { "mm" } else { "m" }),
            None => {
                told("lengths", Quantity::Length, lines, at, out).or_else(|| millimetres(text, lines, out))
            }
        },
        decimal_comma: has_decimal_commas(layouts),
    };
    let all = |units: &BareUnits, out: &mut Diagnostics| -> Vec<ReadRow> {
        let mut found: Vec<ReadRow> = vec![];
        for (layout, columns) in layouts.iter().zip(told_columns) {
            for source in &layout.rows {
                let number = layout.number(source).unwrap_or(found.last().map_or(1, |r| r.number + 1));
                found.push(read_row(layout, columns, source, number, letters, units, out));
            }
        }
        found
    };
    if units.angle.is_none() {
        units.angle = degrees_by_size(&all(&units, &mut Diagnostics::default()), &told_columns[0], out);
    }
    let mut read = all(&units, out);
    check_numbers(&read, layouts, out);
    let told = |role: Option<Role>| told_columns[0].iter().any(|c| Some(c.role) == role && c.unit.is_some());
    let lengths = read.iter().flat_map(|r| [(letters.z, &r.z), (letters.x, &r.x), (Some(Role::B), &r.b)]);
    let bare = lengths.filter(|l| units.length.is_none() && !told(l.0)).flat_map(|l| &l.1.bare);
    let bare: Vec<&(f64, Range<usize>)> = bare.collect();
    if let Some((x, span)) = bare.iter().max_by(|a, b| a.0.abs().total_cmp(&b.0.abs())) {
        let hint = "say `d (mm)` in the header, add the line `lengths: mm`, or give it as an option";
        let mut found = Diagnostics::default();
        suspicious_number(*x, span, Quantity::Length, hint, &mut found); // the largest stands for all
        let more = |n: &usize| bare[*n].0.abs() > 20.0 && bare[*n].1 != *span;
        let more = (0..bare.len()).filter(more).count();
        for mut finding in found.list().iter().cloned() {
            if more > 0 {
                finding.message = format!("{x} and {more} more are long ways for a robot in metres");
            }
            out.add(finding);
        }
    }
    let is_constant = |name: &str| values::is_constant(name, lines, &units);
    let gives_both = |one: &str, other: &str| lines.gives_both(one, other);
    let given = Given { is_constant: &is_constant, gives_both: &gives_both };
    let joints = joints(&read, letters.convention, &given, out);
    rename(&mut read, &joints, &units, out);
    units.angle = units.angle.or(common_unit(&told_columns[0], Quantity::Angle));
    units.length = units.length.or(common_unit(&told_columns[0], Quantity::Length));
    let cells: Vec<Cells> = read.iter().map(cells_of).collect();
    let variables = rows::assign_variables(&cells, letters.convention, out);
    if variables.iter().all(Option::is_none) && !out.has_errors() {
        out.warning(
            layouts[0].head(),
            "no row holds a joint variable: the table describes a fixed transform",
        )
        .hint("write θ1 or q1 (d1 for a sliding joint) into row 1, and so on, or add a column σ");
    }
    let names: Vec<&str> = joints
        .iter()
        .filter_map(|j| match j {
            Joint::Moves(_, name) => name.as_deref(),
            Joint::Fixed => None,
        })
        .collect();
    let parameters = values::parameters(text, &cells, &names, (lines, around), &units, out);
    let rows: Vec<Row> = cells
        .iter()
        .zip(&read)
        .zip(&variables)
        .map(|((cells, read), &variable)| Row {
            name: read.source(Role::Name).map(|n| plain_name(&n.text)).filter(|n| !n.is_empty()),
            limits: variable.and_then(|v| limits::limits(read, v.kind, &units, out)),
            ..cells.row(variable)
        })
        .collect();
    // Without a name it is called by its joints: RRP arm.
    let letters_of_joints =
        variables.iter().flatten().map(|v| if v.kind == JointKind::Revolute { 'R' } else { 'P' });
    let unnamed = || letters_of_joints.chain(" arm".chars()).collect();
    let name = lines.value("name", at).or(lines.title(at)).map_or_else(unnamed, String::from);
    let moves = joints.iter().filter_map(|j| match j {
        Joint::Moves(_, name) => Some(name.clone()),
        Joint::Fixed => None,
    });
    Reading {
        after: antecedents(&read, letters.convention, out),
        variables: moves.collect(),
        along_x: letters.x.map(Role::letter),
        along_z: letters.z.map(Role::letter),
        previous: told_columns[0].iter().any(|c| Some(c.role) == letters.x && c.previous),
        description: Description {
            name,
            source: None,
            convention: letters.convention,
            parameters,
            rows,
            base: Transform::identity(),
            tool: Transform::identity(),
            poses: vec![],
            gravity: None,
        },
    }
}

/// A unit told by a line.
fn told(key: &str, quantity: Quantity, lines: &Lines, at: usize, out: &mut Diagnostics) -> Option<Unit> {
    let line = lines.get(key, at)?;
    let unit = unit_named(line.text.trim()).filter(|u| u.quantity == quantity);
    if unit.is_none() {
        let units = if quantity == Quantity::Angle { "deg or rad" } else { "m, cm, mm or in" };
        out.error(line.span.clone(), format!("unknown unit of {key}")).hint(format!("{key}: {units}"));
    }
    unit
}

/// Millimetres, where no line tells the unit of lengths and the text says it in words.
fn millimetres(text: &str, lines: &Lines, out: &mut Diagnostics) -> Option<Unit> {
    let place = millimetres_said(text).filter(|_| lines.get("lengths", 0).is_none())?;
    out.note(place, "lengths without a unit are read as millimetres: the text says so");
    unit_named("mm")
}

/// Columns of unknown meaning, units that do not fit, tables that do not match.
fn check_columns(layout: &Layout, columns: &[Column], first: &[Column], out: &mut Diagnostics) {
    for (column, head) in columns.iter().zip(&layout.heads) {
        let wanted = match column.role {
            Role::Theta | Role::Alpha | Role::Gamma => Quantity::Angle,
            Role::D | Role::A | Role::R | Role::B => Quantity::Length,
            Role::Other => {
                let shown: String = head.text.chars().take(30).collect();
                out.warning(head.span.clone(), format!("the column `{shown}` is not read"));
                continue;
            }
            _ => continue,
        };
        if column.unit.is_some_and(|u| u.quantity != wanted) {
            out.error(head.span.clone(), format!("`{}` is {}", column.role.letter(), wanted.name()));
        }
        if !first.iter().any(|c| c.role == column.role) {
            out.error(head.span.clone(), format!("the first table has no column `{}`", column.role.letter()));
        }
    }
}

/// Rows are numbered without gaps.
fn check_numbers(read: &[ReadRow], layouts: &[&Layout], out: &mut Diagnostics) {
    for pair in read.windows(2) {
        let (before, after) = (pair[0].number, pair[1].number);
        if after != before + 1 {
            out.error(pair[1].span.clone(), format!("row {after} follows row {before}"));
        }
    }
    if let Some(first) = read.first().filter(|r| r.number > 1) {
        out.note(
            first.span.clone(),
            format!("the table begins with row {}; its joints become q1, q2, …", first.number),
        );
    }
    let rows = layouts.iter().flat_map(|l| l.rows.iter().map(|r| (*l, r.as_slice())));
    let mut empty = None;
    for ((layout, row), read) in rows.zip(read) {
        let (cells, wanted) = (row.len(), layout.columns.len());
        if cells == wanted {
            let letters = layout.columns.iter().zip(row).filter(|c| c.0.role.is_letter());
            empty = empty.or(letters.map(|c| c.1).find(|c| c.text.is_empty()));
            continue;
        }
        let span =
            if cells > wanted { row[wanted].span.start..row[cells - 1].span.end } else { read.span.clone() };
        let plural = if cells == 1 { "" } else { "s" };
        out.error(span, format!("row {} has {cells} cell{plural}, the header has {wanted}", read.number))
            .hint("a cell that is 0 may be left empty, but not left out");
    }
    if let Some(cell) = empty {
        out.note(cell.span.clone(), "empty cells are read as 0");
    }
}

/// Degrees, if an angle without unit is more than a turn in radians.
fn degrees_by_size(read: &[ReadRow], columns: &[Column], out: &mut Diagnostics) -> Option<Unit> {
    let told = |role| columns.iter().find(|c| c.role == role).is_some_and(|c| c.unit.is_some());
    let bare = |row: &ReadRow| -> Vec<(f64, Range<usize>)> {
        [
            (Role::Theta, &row.theta.bare),
            (Role::Alpha, &row.alpha.bare),
            (Role::Gamma, &row.gamma.bare),
            (Role::Offset, &row.offset_bare),
        ]
        .into_iter()
        .filter(|(role, _)| !told(*role))
        .flat_map(|(_, bare)| bare.clone())
        .collect()
    };
    let all: Vec<(f64, Range<usize>)> = read.iter().flat_map(bare).collect();
    let (x, span) = all.iter().find(|b| b.0.abs() > TAU)?;
    if let Some((radians, span)) = all.iter().find(|b| looks_like_radians(b.0)) {
        let message = format!("{radians} looks like radians, but {x} elsewhere like degrees");
        out.error(span.clone(), message)
            .hint("`angles: deg` or `angles: rad` says what angles without a unit are");
    } else {
        let message =
            format!("{x} is more than a turn in radians: angles without a unit are read as degrees");
        out.note(span.clone(), message).hint("`angles: deg` or `angles: rad` says so");
    }
    unit_named("deg")
}

/// A multiple of π/12 up to a turn, other than 0, as one writes it with three decimals or more.
fn looks_like_radians(x: f64) -> bool {
    let nearest = (x / (PI / 12.0)).round() * (PI / 12.0);
    nearest != 0.0 && x.abs() < TAU + 0.1 && (x - nearest).abs() < 1e-3
}

fn read_row<'a>(
    layout: &'a Layout,
    columns: &'a [Column],
    source: &'a [GridCell],
    number: usize,
    letters: &Letters,
    units: &BareUnits,
    out: &mut Diagnostics,
) -> ReadRow<'a> {
    let start = source.first().map_or(layout.span.start, |c| c.span.start);
    let end = source.iter().map(|c| c.span.end).max().unwrap_or(start);
    let span = start..end.max(start);
    let read_into = |role: Option<Role>, quantity, out: &mut Diagnostics| {
        let at = role.and_then(|r| columns.iter().position(|c| c.role == r));
        match at.and_then(|i| source.get(i).map(|s| (s, columns[i].unit))) {
            Some((cell, unit)) => read_table_cell(cell, &units.style(quantity, unit), out),
            None => TableCell { cell: Cell::zero(span.clone()), star: false, marker: false, bare: vec![] },
        }
    };
    let offset_bare = read_into(Some(Role::Offset), Quantity::Angle, &mut Diagnostics::default()).bare;
    let mut read = |role, quantity| read_into(role, quantity, out);
    ReadRow {
        number,
        theta: read(Some(Role::Theta), Quantity::Angle),
        z: read(letters.z, Quantity::Length),
        x: read(letters.x, Quantity::Length),
        alpha: read(Some(Role::Alpha), Quantity::Angle),
        gamma: read(Some(Role::Gamma), Quantity::Angle),
        b: read(Some(Role::B), Quantity::Length),
        offset_bare,
        span,
        columns,
        source,
    }
}

/// A cell; `-` and nothing are 0.
fn read_table_cell(cell: &GridCell, style: &Style, out: &mut Diagnostics) -> TableCell {
    let mut found =
        TableCell { cell: Cell::zero(cell.span.clone()), star: false, marker: false, bare: vec![] };
    // `d_1 = 0.0892` in a cell is that number.
    let told = cell
        .text
        .split_once('=')
        .filter(|t| !t.1.contains('=') && name_of(t.0.trim_matches(['$', ' ']), true).is_some());
    let own;
    let cell = match told {
        Some((name, value)) => {
            let start = cell.span.start + name.len() + 1;
            own = GridCell {
                text: value.trim().to_string(),
                span: start + (value.len() - value.trim_start().len())..cell.span.end,
            };
            &own
        }
        None => cell,
    };
    let (text, star) = without_stars(&cell.text);
    let text = with_numbers(&text);
    found.star = star;
    let bare = text.trim_matches(['$', ' ']);
    if matches!(bare.to_lowercase().as_str(), "var" | "var." | "variable" | "variabel")
        || found.star && bare.is_empty()
    {
        found.marker = true;
        found.star = true;
        return found;
    }
    if matches!(bare, "" | "-" | "–" | "—" | "−" | "--" | "/" | "\\\\" | "n/a") {
        return found;
    }
    let place = Place { span: cell.span.clone(), start: Some(cell.span.start) };
    if let Some(value) = read_cell(&text, &place, style, out) {
        found.cell = Cell { expr: value.expr, span: cell.span.clone(), symbols: value.symbols };
        found.star |= found.cell.symbols.iter().any(|s| s.0 == "var");
        found.bare = value.bare;
    }
    found
}

/// Calls the variables q1, q2, … wherever they occur.
fn rename(read: &mut [ReadRow], joints: &[Joint], units: &BareUnits, out: &mut Diagnostics) {
    let mut names: Vec<(String, String)> = vec![];
    let mut seen: FxHashSet<&str> = FxHashSet::default();
    let mut count = 0;
    for (row, joint) in read.iter_mut().zip(joints) {
        let Joint::Moves(kind, symbol) = joint else { continue };
        count += 1;
        let q = format!("q{count}");
        let quantity = if *kind == JointKind::Revolute { Quantity::Angle } else { Quantity::Length };
        let style = units.style(quantity, row.unit(Role::Offset, quantity));
        let offset = row.source(Role::Offset).map(|c| read_table_cell(c, &style, out).cell);
        let cell = if *kind == JointKind::Revolute { &mut row.theta.cell } else { &mut row.z.cell };
        let owners =
            |name: &str| joints.iter().filter(|j| matches!(j, Joint::Moves(_, Some(n)) if n == name)).count();
        // a name that no cell can hold stands for what has none, or one that other rows use for theirs
        let placeholder = format!("variable of row {}", row.number);
        match symbol {
            None => {
                cell.expr = cell.expr + Expr::symbol(&placeholder);
                cell.symbols.push((placeholder.clone(), cell.span.clone()));
                names.push((placeholder, q));
            }
            Some(name) if owners(name) == 1 => names.push((name.clone(), q)),
            Some(name) => {
                if name.ends_with(|c: char| c.is_ascii_digit()) && !seen.insert(name) {
                    out.error(cell.span.clone(), format!("`{name}` is the variable of two rows"));
                }
                replace(cell, &[(name.clone(), placeholder.clone())]);
                names.push((placeholder, q));
            }
        }
        if let Some(offset) = offset {
            cell.expr = cell.expr + offset.expr;
            cell.symbols.extend(offset.symbols);
        }
    }
    let undecided = out.has_errors(); // then a name may be the variable that was not found
    for row in read.iter_mut() {
        for cell in row.cells_mut() {
            let known = |name: &String| variable_number(name).is_none() || names.iter().any(|n| n.0 == *name);
            if !undecided {
                for (name, span) in cell.cell.symbols.iter().filter(|s| !known(&s.0)) {
                    out.error(span.clone(), format!("`{name}` is not the variable of any row"));
                }
                cell.cell.symbols.retain(|s| known(&s.0));
            }
            replace(&mut cell.cell, &names);
        }
    }
}

/// Puts new names for old ones, all at once.
fn replace(cell: &mut Cell, names: &[(String, String)]) {
    if !cell.symbols.iter().any(|s| names.iter().any(|n| n.0 == s.0)) {
        return;
    }
    let new = |old: &str| names.iter().find(|n| n.0 == *old).map(|n| n.1.clone());
    cell.expr = cell.expr.substitute(|s: Symbol| new(&s.name()).map(|n| Expr::symbol(&n)));
    for symbol in &mut cell.symbols {
        symbol.0 = new(&symbol.0).unwrap_or_else(|| symbol.0.clone());
    }
}

fn cells_of(row: &ReadRow) -> Cells {
    let cell = |c: &TableCell| c.cell.clone();
    // 90+θ2 is q2 + 90°
    let angle = |c: &TableCell| Cell { expr: Angle::of(c.cell.expr).to_expr(), ..c.cell.clone() };
    Cells {
        span: row.span.clone(),
        theta: angle(&row.theta),
        d: cell(&row.z),
        a: cell(&row.x),
        alpha: angle(&row.alpha),
        gamma: angle(&row.gamma),
        b: cell(&row.b),
    }
}

/// The unit that all columns of a quantity have in their heads.
fn common_unit(columns: &[Column], quantity: Quantity) -> Option<Unit> {
    let measured = |c: &&Column| match quantity {
        Quantity::Angle => matches!(c.role, Role::Theta | Role::Alpha | Role::Gamma),
        _ => matches!(c.role, Role::D | Role::A | Role::R | Role::B),
    };
    let mut units = columns.iter().filter(measured).map(|c| c.unit);
    let first = units.next()??;
    units.all(|u| u == Some(first)).then_some(first)
}
