//! Tables as answers: those of a document, held against the robot that is given.
//!
//! A table is right if its axes are the robot's, wherever its author put frames, zeros and names; what he chose is said. It is
//! wrong only if that is proved, and then the cells are named that make it right.

mod cells;
mod names;

use super::facts::{About, Condition, Placement, Remark, SlipKind, Unproved};
use super::formula::Formula;
use super::outcome::{Claim, Entry, Finding, Patch, Slip, Wrong};
use super::subject::Subject;
use cells::WrongCell;
use denavit::description::table::PrintedTable;
use denavit::description::{
    Cell, Convention, Description, JointKind, SameMechanism, Sameness, same_mechanism,
};
use denavit::geometry::{Rotation, Transform};
use denavit_reading::slip::Slip as Kind;
use denavit_symbolic::Expr;
use denavit_symbolic::print::{Style, print};
use std::ops::Range;
use std::rc::Rc;

/// A table of the document, as its author means it.
pub(super) struct OwnTable {
    pub table: PrintedTable,
    pub subject: Rc<Subject>,
    /// Nothing in the document says the convention: this one was tried.
    pub is_tried: bool,
}

/// What was found of a table.
pub(super) struct Judged {
    /// The table, and its rows if it is wrong.
    pub claims: Vec<Claim>,
    /// The table with base and hand where the robot has them, and its standing.
    pub subject: Rc<Subject>,
    pub standing: Standing,
}

/// Whether a table is the robot's.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Standing {
    /// To the letter.
    Identical,
    /// The same mechanism with frames of its own.
    SameArm,
    Wrong,
    Undecided,
}

/// The verdict on one reading of a table.
struct Verdict {
    standing: Standing,
    finding: Finding,
    remarks: Vec<Remark>,
    cells: Vec<WrongCell>,
    subject: Rc<Subject>,
}

/// Judges each table of a document; tables that were read in several conventions are one.
pub(super) fn judge(text: &str, robot: &Subject, tables: &[OwnTable]) -> Vec<Judged> {
    let mut found: Vec<Judged> = vec![];
    let mut at = 0;
    while at < tables.len() {
        let span = &tables[at].table.span;
        let count = tables[at..].iter().take_while(|t| t.table.span == *span).count();
        let readings = &tables[at..at + count];
        at += count;
        if readings[0].table.first > 1 {
            continue;
        }
        let verdicts = readings.iter().map(|t| (t, verdict(robot, t)));
        let rank = |v: &Verdict| match v.standing {
            Standing::Identical => 0,
            Standing::SameArm => 1,
            Standing::Undecided => 2,
            Standing::Wrong => 3 + if v.cells.is_empty() { 100 } else { v.cells.len() },
        };
        if let Some((table, verdict)) = verdicts.min_by_key(|v| rank(&v.1)) {
            found.push(judged(text, table, verdict));
        }
    }
    found
}

/// The claims that a table makes.
fn judged(text: &str, own: &OwnTable, verdict: Verdict) -> Judged {
    let claim = |span: Range<usize>, name: String, about: About, entries: Vec<Entry>| Claim {
        span,
        name,
        about,
        entries,
        instead: None,
        remarks: vec![],
        robot: 0,
    };
    let span = head(text, &own.table);
    let equal = || Finding::Equal { unless_zero: vec![] };
    let mut claims = vec![];
    if verdict.cells.is_empty() {
        let whole = own.table.span.clone();
        let entry = Entry { place: None, span: whole, finding: verdict.finding, identities: vec![] };
        let whole = claim(span, "table".into(), About::Table, vec![entry]);
        claims.push(Claim { remarks: verdict.remarks, ..whole });
    } else {
        let rows = own.table.rows.iter().enumerate().map(|(r, row)| {
            let entries = row.cells.iter().map(|(cell, column, span)| {
                let wrong = verdict.cells.iter().find(|w| (w.row, w.cell) == (r, *cell));
                let finding = wrong.map_or_else(equal, |w| mended(text, own, w, &verdict.cells, span));
                Entry { place: Some((r + 1, *column)), span: span.clone(), finding, identities: vec![] }
            });
            (row.span.clone(), entries.collect::<Vec<Entry>>())
        });
        let rows: Vec<(Range<usize>, Vec<Entry>)> = rows.collect();
        let all = rows.iter().flat_map(|r| r.1.clone()).collect();
        claims.push(claim(span, "table".into(), About::Table, all));
        for (k, (span, entries)) in rows.into_iter().enumerate() {
            claims.push(claim(span, format!("row {}", k + 1), About::TableRow, entries));
        }
    }
    Judged { claims, subject: verdict.subject, standing: verdict.standing }
}

/// The first line of a table.
fn head(text: &str, table: &PrintedTable) -> Range<usize> {
    let shown = text.get(table.span.clone()).unwrap_or_default();
    let length = shown.lines().next().map_or(0, |l| l.trim_end().len());
    table.span.start..table.span.start + length
}

/// Why a cell is wrong, and what should stand there.
fn mended(text: &str, own: &OwnTable, wrong: &WrongCell, all: &[WrongCell], span: &Range<usize>) -> Finding {
    let now = written(text, own, wrong.cell, wrong.right);
    // Two cells of a column that are each other's.
    let other = all.iter().find(|o| {
        (o.row, o.cell) != (wrong.row, wrong.cell) && o.printed == wrong.right && o.right == wrong.printed
    });
    let column = |w: &WrongCell| {
        let cells = own.table.rows.get(w.row).map(|r| &r.cells);
        cells.and_then(|c| c.iter().find(|c| c.0 == w.cell)).map_or(0, |c| c.1)
    };
    let kind = match other {
        Some(other) => SlipKind::ExchangedWith(other.row + 1, column(other)),
        None if wrong.right == cells::opposite(wrong.printed) => SlipKind::Formula(Kind::Sign),
        None => SlipKind::OtherEntry,
    };
    let patches = vec![Patch { span: span.clone(), now: now.clone() }];
    let slip = Slip { kind, patches, formula: now.clone() };
    Finding::Wrong(Box::new(Wrong { correct: vec![now], slip: Some(slip), ..Wrong::default() }))
}

/// A cell as the author would write it: angles in the unit that the others are in.
fn written(text: &str, own: &OwnTable, cell: Cell, value: Expr) -> String {
    let names = own.subject.vocabulary();
    let column = own.table.rows.iter().flat_map(|r| &r.cells).filter(|c| c.0.turns());
    let shown: Vec<&str> = column.filter_map(|c| text.get(c.2.clone())).collect();
    let in_radians = shown.iter().any(|s| s.contains('π') || s.contains("pi"));
    let degrees = value.eval(|_| None).ok().map(f64::to_degrees).filter(|_| cell.turns() && !in_radians);
    match degrees {
        Some(x) => {
            let unit = ["°", " deg"].into_iter().find(|u| shown.iter().any(|s| s.contains(u.trim())));
            format!("{}{}", (x * 1e6).round() / 1e6, unit.unwrap_or_default())
        }
        None => print(value, &names, Style::Ascii),
    }
}

/// The verdict on a table in one reading.
fn verdict(robot: &Subject, own: &OwnTable) -> Verdict {
    let undecided = |why: Unproved| Verdict {
        standing: Standing::Undecided,
        finding: Finding::Undecided { why },
        remarks: vec![],
        cells: vec![],
        subject: Rc::clone(&own.subject),
    };
    let (a, b) = (&robot.description, &own.subject.description);
    let kinds = |d: &Description| d.variables().iter().map(|v| v.kind).collect::<Vec<JointKind>>();
    if kinds(a) != kinds(b) || own.table.rows.len() != b.rows.len() {
        return undecided(Unproved::OtherJoints);
    }
    let mut wrong: Option<Verdict> = None;
    let mut why = Unproved::NotFound;
    for reading in names::readings(a, b) {
        match same_mechanism(&reading.robot, &reading.table) {
            Sameness::Same(same) => return right(own, &reading, &same),
            Sameness::Undecided => why = Unproved::NotFound,
            Sameness::Different if reading.is_open => why = Unproved::OtherNames,
            Sameness::Different => {
                let cells = cells::wrong(&reading.robot, &reading.table);
                let finding = Finding::Wrong(Box::default());
                let subject = Rc::clone(&own.subject);
                let found = Verdict { standing: Standing::Wrong, finding, remarks: vec![], cells, subject };
                let is_closer = wrong.as_ref().is_none_or(|w| w.cells.is_empty() && !found.cells.is_empty());
                if is_closer {
                    wrong = Some(found);
                }
            }
        }
    }
    wrong.unwrap_or_else(|| undecided(why))
}

/// The verdict on a table with the robot's axes.
fn right(own: &OwnTable, reading: &names::Reading, same: &SameMechanism) -> Verdict {
    let names = Rc::new(own.subject.vocabulary());
    let moves = |x: &Transform<Expr>| x.translation.0.iter().any(|e| !e.is_zero());
    let tilts = |x: &Transform<Expr>| !x.rotation.z()[2].is_one();
    let joints = (1..).zip(&same.zeros).filter(|z| !z.1.is_zero());
    let reversed: Vec<usize> = (1..).zip(&same.reversed).filter(|r| *r.1).map(|r| r.0).collect();
    let convention = reading.table.convention;
    let is_exact = reversed.is_empty()
        && same.zeros.iter().all(|z| z.is_zero())
        && same.base == Transform::identity()
        && same.tool == Transform::identity();
    let placement = Placement {
        zeros: joints.map(|(k, z)| (k, Formula::new(*z, &names))).collect(),
        base: moves(&same.base) || tilts(&same.base),
        hand: moves(&same.tool) || tilts(&same.tool),
        is_turned: same.base.rotation != Rotation::identity() || same.tool.rotation != Rotation::identity(),
        reversed,
        names: reading.names.clone(),
        convention: own.is_tried.then_some(convention),
        millimetres: reading.millimetres,
    };
    let hand_is_free = convention == Convention::Craig || convention == Convention::Khalil;
    let is_free = placement.reversed.is_empty() && !placement.base && (!placement.hand || hand_is_free);
    let last_turns = |k: usize| {
        let joints = reading.table.variables();
        k == joints.len() && joints[k - 1].kind == JointKind::Revolute
    };
    // One cell that makes it the robot's is the slip, unless the cell is a place that may be chosen.
    let cells = if is_free { vec![] } else { cells::wrong(&reading.robot, &reading.table) };
    let is_slip = match &cells[..] {
        [one] => {
            let is_turn = placement.reversed.iter().any(|&k| !last_turns(k));
            is_turn || (placement.base || placement.hand) && !one.printed.is_zero()
        }
        _ => false,
    };
    // Base and hand where the robot has them.
    let mut d = own.subject.description.clone();
    (d.base, d.tool) = (same.base * d.base, d.tool * same.tool);
    let mut subject = own.subject.with(d);
    if !(same.zeros.iter().all(|z| z.is_zero()) && placement.reversed.is_empty()) {
        // The pose at the table's own angles.
        subject = Subject::clone(&own.subject);
    }
    let equal = || Finding::Equal { unless_zero: vec![] };
    let said = (!placement.is_none()).then(|| Remark::Placed(Box::new(placement.clone())));
    let (standing, finding, remarks) = match () {
        () if is_slip => (Standing::Wrong, Finding::Wrong(Box::default()), vec![]),
        () if is_exact => (Standing::Identical, equal(), said.into_iter().collect()),
        () if is_free => (Standing::SameArm, equal(), said.into_iter().collect()),
        () => {
            let condition = Condition::Placed(Box::new(placement));
            (Standing::SameArm, Finding::Conditional { condition, correct: vec![], remarks: vec![] }, vec![])
        }
    };
    let cells = if is_slip { cells } else { vec![] };
    Verdict { standing, finding, remarks, cells, subject: Rc::new(subject) }
}
