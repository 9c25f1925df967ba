//! Formulas that somebody printed, held against the robot.
//!
//! A document is read as it is (`denavit_reading::document`), its names are given their meaning (`names`, `subject`, `lexis`), its
//! statements become pairs of formulas, printed and right (`walk`, `product`, `matrix`), and each pair is judged by proof
//! (`judge`). For what is wrong, the smallest change that mends it is looked for, first of the robot's table (`causes`),
//! then of the formula (`denavit_reading::slip`).

mod apart;
mod blamed;
mod blocks;
mod carried;
mod causes;
mod changed;
mod components;
mod configurations;
mod convention;
mod counted;
mod custom;
mod definitions;
mod degrees;
mod directions;
mod displayed;
mod dynamics;
mod edits;
mod facts;
mod formula;
mod givens;
mod goals;
mod habits;
mod heads;
pub mod inverse;
mod jacobians;
mod judge;
mod languages;
mod leeway;
mod letters;
mod lexis;
mod lines;
mod listing;
mod loads;
mod macros;
pub mod marking;
mod masses_read;
mod matrix;
mod named_sums;
mod names;
mod note;
mod numbers;
mod order;
mod outcome;
mod plain_tables;
mod plan;
mod product;
mod programs;
mod reaches;
mod readings;
mod recognised;
mod remarks;
mod respelling;
mod scripts;
mod signs;
mod spoken_loads;
mod steps;
mod still_rows;
mod subject;
mod supported;
mod supposed;
mod tables;
mod told_otherwise;
mod tools;
mod trial;
mod unjudged;
mod unsupported;
mod values;
mod values_asked;
mod walk;
mod weights;
mod whole;

pub use facts::{
    About, Change, Condition, Dynamic, Instead, Jacobian, Meaning, Placement, ReadWith, Remark, Sense,
    ShortRow, SlipKind, Spoken, TableCell, Unproved, Whereabouts, Zeros,
};
pub use formula::Formula;
pub use note::{Note, Noted, Unread, Unreadable};
pub use numbers::decimal;
pub use outcome::{
    Cause, Checked, Claim, Counterexample, Entry, Finding, Patch, Skipped, Slip, Standing, Tally, Unjudged,
    Wrong,
};
pub use values_asked::{Answer, Answered, ValueSlip};

use denavit::description::table::millimetres_said;
use denavit::description::{Convention, Description, TableOptions};
use denavit_reading::code::Dialect;
use denavit_reading::document::{self, Document, Format, Statement};
use judge::Judge;
use note::Notes;
use plan::{Plan, Walked};
use scripts::Forces;
use std::ops::Range;
use std::rc::Rc;

/// The longest document, in bytes.
pub const MAX_BYTES: usize = 8_000_000;
/// The most formulas of a document that are judged.
pub(crate) const MAX_FORMULAS: usize = 20_000;

/// What may be told beside the document.
#[derive(Clone, Debug, Default)]
pub struct CheckOptions {
    /// How the tables of the document are read.
    pub table: TableOptions,
    /// Values of parameters of the document's tables: names with the text of a value.
    pub set: Vec<(String, String)>,
    /// What the left side of the first statement means, `T06`.
    pub claim: Option<String>,
    /// How far a numeric answer may be off, in its own unit.
    pub tolerance: Option<f64>,
    /// The text is a program in this language.
    pub language: Option<Dialect>,
}

/// Holds a document against a robot, or against the tables that stand in it.
///
/// # Errors
/// If there is no robot: neither given nor a table in the document that can be read.
pub fn check(
    text: &str,
    format: Format,
    robot: Option<&Description>,
    options: &CheckOptions,
) -> Result<Checked, Vec<Note>> {
    let mut notes = Notes::default();
    if text.len() > MAX_BYTES {
        notes.error(0..0, Noted::TooLong { bytes: text.len(), most: MAX_BYTES });
        return Err(notes.found());
    }
    let respelled = respelling::respelled(text, options.language);
    let text = &*respelled;
    let mut document = match options.language {
        Some(language) => remarks::document(text, language),
        None => document::read(text, format),
    };
    let supported = match (robot, options.language) {
        (None, None) => supported::by_statements(text, format, &document, options),
        (None, Some(_)) => supported::by_statements(text, format, &Document::default(), options),
        _ => None,
    };
    let mut options = options.clone();
    let is_long = |_: &Range<usize>| {
        let kind = plan::kind_of_tables(format);
        // Lengths are the same in each convention.
        let mut readings = Convention::ALL.into_iter().map(|c| {
            let reading = TableOptions { convention: Some(c), ..options.table.clone() };
            listing::tables_of(text, kind, &options, &reading)
        });
        robot.is_none() && readings.any(|tables| convention::has_long_rows(&tables))
    };
    let in_millimetres =
        || millimetres_said(text).or_else(|| convention::only_in_millimetres(text).filter(is_long));
    let place = options.table.lengths_in_millimetres.is_none().then(in_millimetres).flatten();
    if let Some(place) = place {
        notes.note(place, Noted::InMillimetres);
        options.table.lengths_in_millimetres = Some(true);
    }
    if let Some(s) = supported {
        notes.warning(s.head, Noted::Supported { convention: s.convention, right: s.right, rival: s.rival });
        options.table.convention = Some(s.convention);
    }
    let options = &options;
    let mut plan = Plan::of(text, format, &document, robot, options, &mut notes)?;
    let mut of_dynamics = dynamics::taken(text, &mut document, &plan.tables);
    if options.language.is_some() {
        plan.remarks = Rc::new(document.statements.iter().map(|s| s.span.clone()).collect());
    }
    let programs = blocks::programs(text, &document, options);
    let forces = scripts::forces(text, &programs, &|name| plan.joint(name));
    // What is judged as dynamics is not refused as kinematics.
    let mut of_forces: Vec<Range<usize>> = vec![];
    if let Some(Forces { text, document: lines, heads, motion, .. }) = &forces {
        let found = dynamics::taken(text, &mut lines.clone(), &[]);
        if !found.is_empty() {
            of_forces = found.iter().map(|s| s.span.clone()).chain(heads.iter().cloned()).collect();
            plan.motion = Rc::new(motion.clone());
        }
        of_dynamics.extend(found);
        of_dynamics.sort_by_key(|s| s.span.start);
    }
    let known = directions::Known::of(&plan.subjects);
    let scripts = scripts::inverse(text, &programs, &|name| plan.is_joint(name), &|name| known.has(name));
    let mut lost = vec![];
    let computed = scripts::computed(text, &programs, &|name| plan.is_joint(name));
    let respelled = scripts.map(|mut scripts| {
        scripts.join(&mut document);
        lost = std::mem::take(&mut scripts.lost);
        plan.programs = Some(Rc::from(scripts.programs));
        plan.posed = scripts.posed;
        scripts.text
    });
    let text = respelled.as_deref().unwrap_or(text);
    let with_forces = forces.filter(|_| !of_forces.is_empty()).and_then(|f| f.over(text));
    let (plan, senses) = readings::weighed(text, &document, plan, options);
    for sense in senses {
        notes.note(0..0, Noted::Reading(sense));
    }
    let mut walked = plan.walk(text, &document, options);
    walked.unsaid.extend(lost);
    let is_of_forces =
        |span: &Range<usize>| of_forces.iter().any(|f| f.start < span.end && span.start < f.end);
    walked.refused.retain(|e| !is_of_forces(&e.span));
    if !plan.has_robot && walked.assertions.is_empty() {
        notes.error(0..0, Noted::NoRobot);
        return Err(notes.found());
    }
    for (span, error) in walked.skipped.iter().filter(|s| s.1 == Unreadable::Alias) {
        notes.note(span.clone(), Noted::PassedOver(error.clone()));
    }
    for error in &walked.refused {
        notes.warning(error.span.clone(), Noted::NotRead(error.why.clone()));
    }
    for note in &document.notes {
        notes.warning(note.span.clone(), Noted::Document(note.message.clone()));
    }
    let (mut claims, composed) = judge::judge(text, &plan, &walked, options.tolerance);
    for (span, composed) in composed {
        notes.note(span, Noted::Together(composed));
    }
    let mut causes = definitions::causes(&mut Judge::new(text, &plan, &walked), text, &walked, &claims);
    if causes.is_empty() {
        causes = causes::causes(text, &document, &plan, options, &walked, &mut claims);
    }
    carried::of_true_coordinates(text, &document, &plan, options, &walked, &mut claims);
    carried::carry(text, &document, &plan, options, &walked, &mut claims);
    carried::by_row_function(text, &document, &plan, options, &walked, &mut claims);
    carried::in_programs(text, &walked, &mut claims);
    carried::as_computed(&walked, &mut claims);
    carried::by_name(text, &mut claims);
    carried::by_sines(&walked, &mut claims);
    blamed::helpers(text, format, &plan, options, &walked, &mut claims);
    let judged = tables::judge(text, &plan.subjects[0], &plan.own_tables);
    for (k, table) in judged.into_iter().enumerate() {
        if k == 0 {
            carried::by_own_table(text, &document, &plan, &table, options, &walked, &mut claims);
        }
        claims.extend(table.claims);
    }
    supposed::withdraw(text, &plan, &walked, &mut claims);
    unsupported::withdraw(text, &plan, &walked, &mut claims);
    remarks::withdraw(&plan.remarks, &walked.assertions, &mut claims);
    claims.extend(goals::judged(text, &plan, &walked));
    claims.extend(givens::judged(text, &plan, &walked));
    let (listed, open_rows) = configurations::judged(text, plan::kind_of_tables(format), &plan, &walked);
    claims.extend(listed);
    causes.retain(|c| {
        let finding = |at: &(usize, usize)| Some(claims.get(at.0)?.entries.get(at.1)?.finding.standing());
        c.turns_right.iter().any(|at| matches!(finding(at), Some(Standing::Wrong | Standing::Carried)))
    });
    if !of_dynamics.is_empty() {
        let measures = document.statements.iter().filter(|s| dynamics::is_measure(text, s));
        walked.taken.extend(measures.map(|s| s.span.clone()));
    }
    let said = with_forces.as_deref().unwrap_or(text);
    let of_dynamics = dynamics_judged(said, &of_dynamics, &plan, &mut walked, &mut claims, &mut notes);
    let of_arm = reaches::judged(text, &plan, &walked, &claims);
    claims.extend(of_arm);
    let mut unjudged = unjudged::listed(text, &document, &walked, &open_rows, &mut claims, options);
    let is_tested =
        |span: &Range<usize>| walked.tested.iter().any(|t| t.start < span.end && span.start < t.end);
    let computed = computed.into_iter().filter(|c| !is_tested(&c.0)).collect();
    unjudged.extend(unjudged::passed_over(computed, &claims, &unjudged));
    unjudged.extend(of_dynamics);
    unjudged.extend(givens::unused(text, &plan, &walked, &claims));
    unjudged.extend(givens::assumed(text, &walked));
    unjudged.sort_by_key(|u| (u.span.start, u.span.end));
    unjudged.dedup_by(|a, b| a.span == b.span);
    let claims = apart::split(text, claims, &mut causes);
    let mut checked = Checked {
        claims,
        causes,
        unjudged,
        notes: notes.sorted(),
        robots: plan.subjects.iter().map(|s| s.description.clone()).collect(),
        answered: vec![],
    };
    checked.sort();
    Ok(checked)
}

/// Adds what is said of formulas of dynamics, and gives what of them was not judged.
fn dynamics_judged(
    text: &str,
    taken: &[Statement],
    plan: &Plan,
    walked: &mut Walked,
    claims: &mut Vec<Claim>,
    notes: &mut Notes,
) -> Vec<Unjudged> {
    let judged = dynamics::judged(text, taken, plan, claims);
    for (span, read) in judged.read_with {
        notes.warning(span, Noted::ReadWith(read));
    }
    walked.taken.extend(taken.iter().map(|s| s.span.clone()));
    claims.extend(judged.claims);
    judged.unjudged
}
