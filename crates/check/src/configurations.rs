//! Tables of numbers with a column for each joint: all solutions of a pose, or configurations with their poses beside them.
//!
//! A row is held against the pose that the document gave last in numbers, or against its own further columns. It is called
//! wrong only in a table of which another row is right: then the columns are read as their author means them.

use super::facts::{About, Remark, SlipKind, Unproved};
use super::heads::{Column, column};
use super::numbers::{Configuration, decimal, half_unit};
use super::outcome::{Claim, Entry, Finding, Patch, Slip, Wrong};
use super::plan::{Plan, Walked};
use super::subject::Subject;
use super::walk::{Assertion, Piece};
use denavit::description::table::{PrintedGrid, grids};
use denavit::description::{JointKind, TableKind};
use denavit_reading::slip::Slip as Kind;
use denavit_symbolic::{Angle, Expr, Symbol};
use std::ops::Range;

/// The most rows of a table that are looked at.
const MAX_ROWS: usize = 500;
/// The bytes before a table in which its unit may stand.
const BEFORE: usize = 400;

/// A quantity with its printed value, and half a unit of the last digit.
#[derive(Clone)]
struct Target {
    wanted: Expr,
    printed: f64,
    half: f64,
    /// Where it stands in the row, if it does.
    cell: Option<usize>,
    /// It is the same a turn further.
    is_angle: bool,
}

impl Target {
    /// What a document wants to be reached.
    fn of(goal: &super::walk::Target) -> Self {
        let super::walk::Target { wanted, printed, half, is_length } = *goal;
        let is_angle = !is_length && !Angle::of(wanted).terms.is_empty() && printed.abs() > 1.0;
        Target { wanted, printed, half, cell: None, is_angle }
    }
}

/// A table with a column for each joint.
struct Listed<'a> {
    subject: &'a Subject,
    number: usize,
    columns: Vec<Column>,
    rows: Vec<Row>,
    /// What all rows should reach.
    targets: Vec<Target>,
    at: Configuration,
    /// The unit of lengths is a millimetre.
    scaled: bool,
}

/// A row as printed.
struct Row {
    span: Range<usize>,
    /// The place, the value and half a unit of the last digit of each cell that is a number.
    cells: Vec<Option<(Range<usize>, f64, f64)>>,
}

/// The claims of a document's tables of configurations, and the rows of numbers of which nothing is said.
pub(super) fn judged(
    text: &str,
    kind: TableKind,
    plan: &Plan,
    walked: &Walked,
) -> (Vec<Claim>, Vec<Range<usize>>) {
    let (mut found, mut open) = (vec![], vec![]);
    let mut all = grids(text, kind);
    let is_joint = |name: &String| {
        let subject = &*plan.subjects[0];
        matches!(column(name, subject, walked.names_of(0), true), Column::Joint(..))
    };
    let is_head = |names: &[String]| names.iter().filter(|n| is_joint(n)).count() >= 2;
    let place = |g: &PrintedGrid| g.first().and_then(|r| r.first()).map_or(0, |c| c.1.start);
    for grid in super::plain_tables::below(text, &is_head) {
        let (start, end) = (place(&grid), grid.last().and_then(|r| r.last()).map_or(0, |c| c.1.end));
        if !all.iter().any(|g| (start..end).contains(&place(g))) {
            all.push(grid);
        }
    }
    let is_table = |span: &Range<usize>| plan.tables.iter().any(|t| t.start < span.end && span.start < t.end);
    // A table in a document may have no row.
    for grid in all.into_iter().filter(|g| !g.is_empty()) {
        if let Some(listed) = Listed::of(text, &grid, plan, walked) {
            found.extend(listed.claims());
            continue;
        }
        let is_limits = |c: &(String, Range<usize>)| {
            let head = c.0.to_lowercase();
            ["min", "max", "limit", "range", "grenz", "bereich"].iter().any(|w| head.contains(w))
        };
        let span = place(&grid)..grid.last().and_then(|r| r.last()).map_or(0, |c| c.1.end);
        let is_other =
            grid[0].iter().chain(grid.iter().filter_map(|r| r.first())).any(is_limits) || is_table(&span);
        let side = transposed(&grid)
            .filter(|_| !is_other)
            .filter(|t| is_head(&t[0].iter().map(|c| c.0.clone()).collect::<Vec<_>>()));
        if let Some(listed) = side.as_ref().and_then(|t| Listed::of(text, t, plan, walked)) {
            found.extend(listed.claims_by_joint());
            continue;
        }
        let is_named =
            is_head(&grid[0].iter().map(|c| c.0.clone()).collect::<Vec<String>>()) || side.is_some();
        if is_named && !grid[0].iter().any(is_limits) {
            let has_number = |row: &&PrintedRow| read(row).cells.iter().skip(1).any(Option::is_some);
            open.extend(grid.iter().skip(1).filter(has_number).map(|row| read(row).span));
        }
    }
    open.retain(|span| !span.is_empty() && !is_table(span));
    (found, open)
}

/// A row of a grid: cells with their places.
type PrintedRow = Vec<(String, Range<usize>)>;

/// A grid with its rows as columns; nothing where these are not of one length.
fn transposed(grid: &PrintedGrid) -> Option<PrintedGrid> {
    let width = grid.first()?.len();
    let is_even =
        (2..=MAX_ROWS).contains(&width) && grid.len() <= MAX_ROWS && grid.iter().all(|r| r.len() == width);
    is_even.then(|| (0..width).map(|c| grid.iter().map(|row| row[c].clone()).collect()).collect())
}

impl<'a> Listed<'a> {
    /// A grid whose head names all joints of the robot.
    fn of(text: &str, grid: &PrintedGrid, plan: &'a Plan, walked: &Walked) -> Option<Self> {
        let (heads, rows) = grid.split_first()?;
        let start = heads.first()?.1.start;
        let number = plan.at(start);
        let subject = &*plan.subjects[number];
        let names = walked.names_of(number);
        let joints = subject.joints().len();
        if joints < 2 || rows.is_empty() || rows.len() > MAX_ROWS {
            return None;
        }
        // `x` is a place, unless it is needed for a joint.
        let columns = [true, false].into_iter().find_map(|places_first| {
            let read = |h: &(String, Range<usize>)| column(&h.0, subject, names, places_first);
            let columns: Vec<Column> = heads.iter().map(read).collect();
            let count =
                |k: usize| columns.iter().filter(|c| matches!(c, Column::Joint(i, _) if *i == k)).count();
            let told = (0..joints).filter(|&k| count(k) == 1).count();
            ((0..joints).all(|k| count(k) <= 1) && told >= 2).then_some(columns)
        })?;
        let is_told = |k: usize| columns.iter().any(|c| matches!(c, Column::Joint(i, _) if *i == k));
        let open: Vec<Expr> = (0..joints).filter(|&k| !is_told(k)).map(|k| subject.joints()[k]).collect();
        let is_open = |e: Expr| e.symbols().iter().any(|s| open.contains(&(*s).into()));
        let printed: Vec<Row> = rows.iter().map(|row| read(row)).collect();
        // Each row gives every joint a number.
        let is_full = |row: &Row| {
            columns.iter().zip(&row.cells).all(|(c, x)| !matches!(c, Column::Joint(..)) || x.is_some())
                && row.cells.len() == columns.len()
        };
        if !printed.iter().all(is_full) {
            return None;
        }
        let before = walked.assertions.iter().rev().filter(|a| a.span.end <= start && a.subject == number);
        let stated = before.into_iter().find_map(stated);
        let lengths = || walked.stated.get(number).cloned().unwrap_or_default();
        let told = walked.goals.iter().rev().filter(|g| g.end <= start && g.subject == number);
        let told = told.map(|g| g.targets.iter().map(Target::of).collect()).next();
        let by_words = || (goal(before_of(text, start), subject, plan.habits.scaled), lengths());
        // What is to be reached, the likeliest first.
        let mut tried: Vec<(Vec<Target>, Configuration)> =
            stated.into_iter().chain(told.map(|t| (t, lengths()))).chain([by_words()]).collect();
        tried.iter_mut().for_each(|t| t.0.retain(|t| !is_open(t.wanted)));
        tried.retain(|t| !t.0.is_empty());
        let (targets, at) = tried.first().cloned().unwrap_or_else(|| (vec![], lengths()));
        // What depends on a joint that the table does not give is not known.
        let columns: Vec<Column> = columns
            .into_iter()
            .map(|c| match c {
                Column::Pose(e, ..) if is_open(e) => Column::Other,
                other => other,
            })
            .collect();
        let scaled = plan.habits.scaled;
        let mut listed = Listed { subject, number, columns, rows: printed, targets, at, scaled };
        if scaled {
            let kinds: Vec<JointKind> = subject.description.variables().iter().map(|v| v.kind).collect();
            for column in &mut listed.columns {
                match column {
                    Column::Joint(k, Some(unit)) if kinds[*k] == JointKind::Prismatic => *unit *= 1000.0,
                    Column::Pose(_, Some(unit), false) => *unit *= 1000.0,
                    _ => {}
                }
            }
        }
        listed.settle_units(text, start);
        listed.settle_lengths();
        for (targets, at) in tried {
            if listed.is_any_right() {
                break;
            }
            (listed.targets, listed.at) = (targets, at);
        }
        Some(listed)
    }

    /// True if a row reaches what it should.
    fn is_any_right(&self) -> bool {
        self.rows.iter().any(|row| {
            let targets = self.targets(row);
            targets.len() > 1 && self.reaches(&targets, &self.joints(row)) == Some(true)
        })
    }

    /// The units of columns without one: degrees by the words before the table, or by the size of the numbers.
    fn settle_units(&mut self, text: &str, start: usize) {
        let from =
            (start.saturating_sub(BEFORE)..=start).find(|&k| text.is_char_boundary(k)).unwrap_or(start);
        let near = text[from..start].rsplit("\n\n").take(2).collect::<Vec<&str>>().join(" ").to_lowercase();
        let says = |words: &[&str]| words.iter().any(|w| near.contains(w));
        let in_degrees = says(&["degree", "(deg", " deg", "grad", "degré", "gradi", "°"]);
        let in_radians = says(&["radian", "(rad", " rad", "[rad"]);
        let in_millimetres = says(&["(mm", "[mm", " mm", "millim"]);
        let kinds: Vec<JointKind> = self.subject.description.variables().iter().map(|v| v.kind).collect();
        let turning = |c: &Column| matches!(c, Column::Joint(k, _) if kinds[*k] == JointKind::Revolute);
        let largest = |row: &Row| {
            let angles = self.columns.iter().zip(&row.cells).filter(|(c, _)| turning(c));
            angles.filter_map(|(_, x)| x.as_ref()).map(|x| x.1.abs()).fold(0.0, f64::max)
        };
        let is_large = self.rows.iter().map(largest).fold(0.0, f64::max) > std::f64::consts::TAU;
        let angle = if is_large || in_degrees && !in_radians { 1_f64.to_radians() } else { 1.0 };
        let length = if in_millimetres && !self.scaled { 0.001 } else { 1.0 };
        for column in &mut self.columns {
            match column {
                Column::Joint(k, unit @ None) => {
                    *unit = Some(if kinds[*k] == JointKind::Revolute { angle } else { length });
                }
                Column::Pose(_, unit @ None, is_angle) => {
                    *unit = Some(if *is_angle { angle } else { length })
                }
                _ => {}
            }
        }
    }

    /// Lengths in the unit of the robot's table, where no row is right in millimetres and one is then.
    fn settle_lengths(&mut self) {
        let is_length = |c: &Column| matches!(c, Column::Pose(_, Some(unit), false) if *unit < 1.0);
        if self.is_any_right() || !self.columns.iter().any(is_length) {
            return;
        }
        let change = |listed: &mut Self, factor: f64| {
            for column in &mut listed.columns {
                if let Column::Pose(_, Some(unit), false) = column {
                    *unit *= factor;
                }
            }
        };
        change(self, 1000.0);
        if !self.is_any_right() {
            change(self, 0.001);
        }
    }

    /// What a row says of itself, or else what all rows should reach.
    fn targets(&self, row: &Row) -> Vec<Target> {
        let own: Vec<Target> = self
            .columns
            .iter()
            .zip(&row.cells)
            .enumerate()
            .filter_map(|(k, (column, cell))| match (column, cell) {
                (Column::Pose(wanted, unit, is_angle), Some((_, x, half))) => {
                    let unit = unit.unwrap_or(1.0);
                    let (wanted, is_angle) = (*wanted, *is_angle);
                    Some(Target { wanted, printed: x * unit, half: half * unit, cell: Some(k), is_angle })
                }
                _ => None,
            })
            .collect();
        if own.is_empty() { self.targets.clone() } else { own }
    }

    /// The joints of a row, and half a unit of the last digit of each.
    fn joints(&self, row: &Row) -> Vec<(f64, f64)> {
        let mut q = vec![(0.0, 0.0); self.subject.joints().len()];
        for (column, cell) in self.columns.iter().zip(&row.cells) {
            if let (Column::Joint(k, unit), Some((_, x, half))) = (column, cell) {
                let unit = unit.unwrap_or(1.0);
                q[*k] = (x * unit, half * unit);
            }
        }
        q
    }

    /// The value of a quantity.
    fn value(&self, e: Expr, q: &[(f64, f64)]) -> Option<f64> {
        let (d, joints) = (&self.subject.description, self.subject.joints());
        let value = |s: Symbol| {
            let joint = joints.iter().position(|j| *j == s.into()).map(|k| q[k].0);
            joint.or_else(|| self.at.length(s)).or_else(|| d.value(s))
        };
        e.eval(value).ok().filter(|x| x.is_finite())
    }

    /// How far a quantity is from what is printed, beside how far rounding may move it; nothing where lengths have no values.
    fn off(&self, target: &Target, q: &[(f64, f64)]) -> Option<(f64, f64)> {
        let x = self.value(target.wanted, q)?;
        let mut allowed = target.half;
        for k in 0..q.len() {
            let mut moved = q.to_vec();
            moved[k].0 += moved[k].1;
            allowed += (self.value(target.wanted, &moved)? - x).abs();
        }
        let off = x - target.printed;
        let turn = std::f64::consts::TAU;
        let off = if target.is_angle { off - turn * (off / turn).round() } else { off };
        Some((off.abs(), 1.05 * allowed + 1e-9))
    }

    /// True if all that a row should reach is reached.
    fn reaches(&self, targets: &[Target], q: &[(f64, f64)]) -> Option<bool> {
        let mut all = true;
        for target in targets {
            let (off, allowed) = self.off(target, q)?;
            all &= off <= allowed;
        }
        Some(all)
    }

    /// For each row whether it reaches what it should.
    fn standing(&self) -> Vec<Option<bool>> {
        let of = |row: &Row| {
            let targets = self.targets(row);
            if targets.len() < 2 { None } else { self.reaches(&targets, &self.joints(row)) }
        };
        self.rows.iter().map(of).collect()
    }

    /// The verdicts on the cells of each row, or one on the whole.
    fn entries(&self) -> Vec<Vec<Entry>> {
        let standing = self.standing();
        // What a table is about is not known where no row is right.
        let is_meant = standing.contains(&Some(true));
        let rows = self.rows.iter().zip(standing).enumerate();
        let undecided = |row: &Row, why| {
            let finding = Finding::Undecided { why };
            vec![Entry { place: None, span: row.span.clone(), finding, identities: vec![] }]
        };
        rows.map(|(r, (row, standing))| match standing {
            _ if !is_meant => undecided(row, Unproved::NoPose),
            Some(true) => self.right(r, row),
            Some(false) => self.wrong(r, row),
            None => undecided(row, Unproved::NoLength),
        })
        .collect()
    }

    fn claim(&self, span: Range<usize>, name: String, entries: Vec<Entry>) -> Claim {
        let (about, robot) = (About::Configuration, self.number);
        Claim { span, name, about, entries, instead: None, remarks: vec![], robot }
    }

    fn claims(&self) -> Vec<Claim> {
        let rows = self.rows.iter().zip(self.entries()).enumerate();
        rows.map(|(r, (row, entries))| self.claim(row.span.clone(), format!("row {}", r + 1), entries))
            .collect()
    }

    /// A claim for each printed row of a table that has a configuration in each column.
    fn claims_by_joint(&self) -> Vec<Claim> {
        let entries = self.entries();
        let mut found = vec![];
        for (c, column) in self.columns.iter().enumerate() {
            if matches!(column, Column::Number | Column::Other) {
                continue;
            }
            let cells = self.rows.iter().zip(&entries).filter_map(|(row, said)| {
                let span = row.cells.get(c)?.as_ref()?.0.clone();
                let own = said.iter().find(|e| e.span == span);
                let whole = said.iter().find(|e| e.place.is_none());
                let finding = match (own, whole.map(|w| &w.finding)) {
                    (Some(own), _) => own.finding.clone(),
                    // That something is wrong, but not where.
                    (None, Some(Finding::Wrong(_))) => Finding::Undecided { why: Unproved::NotFound },
                    (None, Some(finding)) => finding.clone(),
                    (None, None) => Finding::Equal { unless_zero: vec![] },
                };
                Some(Entry { place: None, span, finding, identities: vec![] })
            });
            let cells: Vec<Entry> = cells.filter(|e| !e.span.is_empty()).collect();
            if let (Some(first), Some(last)) = (cells.first(), cells.last()) {
                found.push(self.claim(first.span.start..last.span.end, format!("row {c}"), cells));
            }
        }
        found
    }

    /// A row that is right as far as its columns are known.
    fn right(&self, r: usize, row: &Row) -> Vec<Entry> {
        let equal = || Finding::Equal { unless_zero: vec![] };
        let whole = Entry { place: None, span: row.span.clone(), finding: equal(), identities: vec![] };
        let cells = self.columns.iter().zip(&row.cells).enumerate();
        let unknown = cells.filter_map(|(k, (column, cell))| {
            let (span, ..) = cell.as_ref().filter(|_| matches!(column, Column::Other))?;
            let finding = Finding::Undecided { why: Unproved::UnknownColumn };
            Some(Entry { place: Some((r + 1, k + 1)), span: span.clone(), finding, identities: vec![] })
        });
        std::iter::once(whole).chain(unknown).collect()
    }

    /// The cells of a row that is wrong: quantities that differ, or the joint whose value would make it right.
    fn wrong(&self, r: usize, row: &Row) -> Vec<Entry> {
        let (q, targets) = (self.joints(row), self.targets(row));
        let differs = |k: usize| {
            let own = targets.iter().find(|t| t.cell == Some(k))?;
            let (off, allowed) = self.off(own, &q)?;
            (off > allowed).then(|| self.value(own.wanted, &q)).flatten()
        };
        // One quantity that differs is the slip itself.
        let differing: Vec<usize> = (0..self.columns.len()).filter(|&k| differs(k).is_some()).collect();
        let is_own = |k: usize| row.cells[k].as_ref().is_some_and(|c| !c.0.is_empty());
        let is_one = matches!(differing[..], [k] if is_own(k));
        let mended = if is_one { None } else { self.mended(&q, &targets) };
        let mut entries = vec![];
        for (k, (column, cell)) in self.columns.iter().zip(&row.cells).enumerate() {
            let Some((span, x, _)) = cell.as_ref().filter(|c| !c.0.is_empty()) else { continue };
            let finding = match (column, &mended) {
                (Column::Other | Column::Number, _) => continue,
                (_, Some((at, now, kind))) if *at == k => {
                    let patches = vec![Patch { span: span.clone(), now: now.clone() }];
                    let slip = Slip { kind: kind.clone(), patches, formula: now.clone() };
                    let correct = vec![now.clone()];
                    Finding::Wrong(Box::new(Wrong { correct, slip: Some(slip), ..Wrong::default() }))
                }
                (Column::Pose(_, unit, _), None) if differs(k).is_some() => {
                    let right = differs(k).unwrap_or_default() / unit.unwrap_or(1.0);
                    let remark = if (right + x).abs() < 1e-9 {
                        Remark::Sign
                    } else {
                        Remark::OffBy((right - x).abs())
                    };
                    let correct = vec![decimal(right)];
                    Finding::Wrong(Box::new(Wrong { correct, remarks: vec![remark], ..Wrong::default() }))
                }
                _ => Finding::Equal { unless_zero: vec![] },
            };
            entries.push(Entry {
                place: Some((r + 1, k + 1)),
                span: span.clone(),
                finding,
                identities: vec![],
            });
        }
        let is_said = entries.iter().any(|e| matches!(e.finding, Finding::Wrong(_)));
        if !is_said {
            // Nothing that one cell explains.
            let off = targets.iter().filter_map(|t| self.off(t, &q)).map(|o| o.0).fold(0.0, f64::max);
            let remarks = vec![Remark::OffBy(off)];
            let finding = Finding::Wrong(Box::new(Wrong { remarks, ..Wrong::default() }));
            entries = vec![Entry { place: None, span: row.span.clone(), finding, identities: vec![] }];
        }
        entries
    }

    /// The one joint whose value with another sign, or half a turn away, makes a row right; two joints exchanged are none.
    fn mended(&self, q: &[(f64, f64)], targets: &[Target]) -> Option<(usize, String, SlipKind)> {
        let half_turn = std::f64::consts::PI;
        for (k, column) in self.columns.iter().enumerate() {
            let Column::Joint(joint, unit) = column else { continue };
            let unit = unit.unwrap_or(1.0);
            let (x, half) = q[*joint];
            let decimals = (0..12).find(|d| half / unit >= 0.49 * 10_f64.powi(-d)).unwrap_or(0) as usize;
            let shown = |x: f64| format!("{:.decimals$}", x / unit);
            let turned = x - half_turn.copysign(x);
            let tries = [(-x, SlipKind::Formula(Kind::Sign)), (turned, SlipKind::Formula(Kind::Number))];
            for (now, kind) in tries {
                let mut q = q.to_vec();
                q[*joint].0 = now;
                if now != x && self.reaches(targets, &q) == Some(true) {
                    return Some((k, shown(now), kind));
                }
            }
        }
        None
    }
}

/// The numbers of the pose that a statement gives.
fn stated(assertion: &Assertion) -> Option<(Vec<Target>, Configuration)> {
    let mut at = None;
    let targets: Vec<Target> = assertion
        .pieces
        .iter()
        .filter_map(|piece| match piece {
            Piece::Number { answer, .. } if !answer.wanted.symbols().is_empty() => {
                at = Some(answer.at.clone());
                Some(Target {
                    wanted: answer.wanted,
                    printed: answer.printed,
                    half: answer.half,
                    cell: None,
                    is_angle: false,
                })
            }
            _ => None,
        })
        .collect();
    (targets.len() >= 2).then(|| (targets, at.unwrap_or_default()))
}

/// The text before a table.
fn before_of(text: &str, start: usize) -> &str {
    let from = (start.saturating_sub(BEFORE)..=start).find(|&k| text.is_char_boundary(k)).unwrap_or(start);
    &text[from..start]
}

/// The last point that a text gives in numbers, `(0.4, 0.2, 0.3)`, as the place of the hand.
fn goal(text: &str, subject: &Subject, scaled: bool) -> Vec<Target> {
    let position = subject.pose().translation.0;
    let point = |inner: &str| -> Option<Vec<Target>> {
        let numbers: Vec<&str> = inner.split([',', ';']).map(str::trim).collect();
        let unit = if text.contains(" mm") && !scaled { 0.001 } else { 1.0 };
        let target = |(number, wanted): (&&str, &Expr)| {
            let x: f64 = number.replace('−', "-").parse().ok()?;
            Some(Target {
                wanted: *wanted,
                printed: x * unit,
                half: half_unit(number) * unit,
                cell: None,
                is_angle: false,
            })
        };
        let found = (2..=3).contains(&numbers.len());
        found.then(|| numbers.iter().zip(&position).map(target).collect::<Option<Vec<Target>>>())?
    };
    let open = text.char_indices().rev().filter(|(_, c)| matches!(c, '(' | '['));
    let inner = open.map(|(at, _)| text[at + 1..].split([')', ']']).next().unwrap_or_default());
    inner.filter_map(point).next().unwrap_or_default()
}

/// The numbers of a row.
fn read(row: &[(String, Range<usize>)]) -> Row {
    let number = |cell: &(String, Range<usize>)| {
        let bare = cell
            .0
            .trim_end_matches("mm")
            .trim_end_matches("cm")
            .trim_end_matches("rad")
            .trim_end_matches(" m");
        let text = bare.replace(['−', '–'], "-").replace("^\\circ", "").replace("{,}", ".");
        let text = text.trim_matches(['$', ' ', '°', '*']).trim_end_matches("deg").trim().to_string();
        let x: f64 = text.parse().ok()?;
        Some((cell.1.clone(), x, half_unit(&text)))
    };
    // A cell that is said above has no place of its own.
    let own = || row.iter().filter(|c| !c.1.is_empty());
    let span = own().next().map_or(0, |c| c.1.start)..own().next_back().map_or(0, |c| c.1.end);
    Row { span, cells: row.iter().map(number).collect() }
}
