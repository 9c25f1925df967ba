//! Formulas of dynamics: torques, inertia matrices, Coriolis and centrifugal torques, gravity, energies, held against the robot with
//! masses.
//!
//! The statements that speak of dynamics are taken out of a document (`taken`), names get their meaning (`words`), statements become
//! formulas with what they may be (`statements`, `matrices`, `quantity`). Where centres of mass are, about which point inertias are
//! meant and along what gravity acts is read as most of the document is right (`bodies`, `vote`, `attempt`); where its sentences say
//! it (`told`) and another reading makes more of it right, what differs is left open. What is right in the readings that are left is
//! proved by the robot's own dynamics (`model`), what is wrong in every such reading has its slip looked for (`repair`, `together`),
//! unless it follows from what is wrong before it (`author`, `verdict`).

mod attempt;
mod author;
mod bodies;
mod centres;
mod described;
mod in_numbers;
mod letters;
mod matrices;
mod measures;
mod model;
mod points;
mod quantity;
mod read_with;
mod repair;
mod slopes;
mod spoken_torques;
mod statements;
mod taken;
mod together;
mod told;
mod verdict;
mod vote;
mod words;

use crate::facts::{About, Dynamic, ReadWith, Unproved};
use crate::formula::Formula;
use crate::note::Unreadable;
use crate::outcome::{Claim, Entry, Finding, Skipped, Standing, Unjudged};
use crate::plan::Plan;
use denavit_reading::document::{Document, Side, Statement};
use quantity::Quantity;
use std::collections::BTreeMap;
use std::ops::Range;
use std::rc::Rc;
use verdict::{By, Said};

/// What is said of a document's dynamics.
#[derive(Default)]
pub(super) struct Judged {
    pub claims: Vec<Claim>,
    pub unjudged: Vec<Unjudged>,
    /// How masses and gravity are read where no words say it, at the first formula that is right so.
    pub read_with: Vec<(Range<usize>, Vec<ReadWith>)>,
}

/// Takes the statements about dynamics out of a document.
pub(super) fn taken(text: &str, document: &mut Document, rows: &[Range<usize>]) -> Vec<Statement> {
    taken::taken(text, document, rows)
}

/// True for a formula with a mass or an inertia of a body in it.
pub(super) fn speaks_of_masses(formula: &str) -> bool {
    let is_of_body = |w: &String| {
        matches!(
            words::role(w, 9),
            Some(words::Role::Mass(Some(_)) | words::Role::About(..) | words::Role::Ten(..))
        )
    };
    let words = words::words(formula);
    let has_inertia = |w: &String| matches!(words::role(w, 9), Some(words::Role::Inertia(Some(_))));
    words.iter().any(|w| is_of_body(w) && !w.starts_with('M'))
        || words.iter().any(has_inertia) && words.contains("g")
}

/// Judges the statements about dynamics beside claims that there are already.
pub(super) fn judged(text: &str, taken: &[Statement], plan: &Plan, known: &[Claim]) -> Judged {
    let mut by_subject: BTreeMap<usize, Vec<Statement>> = BTreeMap::new();
    for statement in taken {
        by_subject.entry(plan.at(statement.span.start)).or_default().push(statement.clone());
    }
    let mut judged = Judged::default();
    for (number, statements) in by_subject {
        of_robot(text, &statements, plan, number, known, &mut judged);
    }
    judged
}

/// True for a statement that gives a mass, an inertia or gravity in numbers.
pub(super) fn is_measure(text: &str, statement: &Statement) -> bool {
    let name = statement.sides.first().and_then(statements::formula_span);
    let name = name.and_then(|span| statements::lone_name(text, &span));
    let role = name.and_then(|n| words::role(&statements::word(&n), 9));
    let is_of_masses = role.is_some_and(|r| !matches!(r, words::Role::Length(_) | words::Role::Gear(_)));
    is_of_masses && taken::is_measure(text, statement)
}

/// How many statements about dynamics are right of a plan's robots, and how many are wrong.
pub(super) fn support(text: &str, document: &Document, plan: &Plan) -> [usize; 2] {
    let mut document = document.clone();
    let taken = taken(text, &mut document, &plan.tables);
    let claims = judged(text, &taken, plan, &[]).claims;
    let count = |is_so: fn(Standing) -> bool| claims.iter().filter(|c| is_so(c.standing())).count();
    [
        count(|s| s == Standing::Equal),
        count(|s| matches!(s, Standing::Wrong | Standing::Carried | Standing::Undecided)),
    ]
}

fn of_robot(text: &str, all: &[Statement], plan: &Plan, number: usize, known: &[Claim], judged: &mut Judged) {
    let subject = &plan.subjects[number];
    let silent = |s: &Statement| Unjudged { span: s.span.clone(), why: Skipped::SaysNothing };
    let attempt = attempt::best(text, subject, all, &plan.motion);
    let Some((attempt, (said, helpers))) =
        attempt.and_then(|a| verdict::verdicts(text, all, subject, &a).map(|v| (a, v)))
    else {
        judged.unjudged.extend(all.iter().filter(|s| !is_general(text, s)).map(silent));
        return;
    };
    let read = &attempt.read;
    let names = Rc::new(read.vocabulary.clone());
    let first_right = said.iter().position(|s| matches!(s, Said::Right { .. }));
    if let Some(k) = first_right {
        let read_with = read_with::read_with(&attempt, subject, &told::told(text), &names);
        if !read_with.is_empty() {
            judged.read_with.push((read.pieces[k].span.clone(), read_with));
        }
    }
    // Claims in the order of the statements: those of pieces, and those of helpers that are wrong or used.
    let mut claim_of_statement: BTreeMap<usize, usize> = BTreeMap::new();
    let base = known.len() + judged.claims.len();
    let is_used = |h: usize| {
        let uses = |k: usize| matches!(said[k], Said::Right { .. }) && read.pieces[k].uses.contains(&h);
        (0..read.pieces.len()).any(uses)
    };
    let mut of_helpers: BTreeMap<usize, usize> = BTreeMap::new();
    let mut used: Vec<bool> = (0..read.helpers.len()).map(is_used).collect();
    // A helper of a helper that is used is used.
    for h in (0..read.helpers.len()).rev() {
        let by = |k: usize| used[k] && read.helpers[k].uses.contains(&h);
        if !used[h] && (0..read.helpers.len()).any(by) {
            used[h] = true;
        }
    }
    for (at, _) in all.iter().enumerate() {
        let has_piece = read.pieces.iter().any(|p| p.statement == at);
        let helper = read.helpers.iter().position(|h| h.statement == at);
        let is_claim = helper.is_some_and(|h| used[h] || helpers.iter().any(|x| x.0 == h));
        if has_piece || is_claim {
            let number = claim_of_statement.len();
            claim_of_statement.insert(at, number);
            if let Some(h) = helper.filter(|_| !has_piece) {
                of_helpers.insert(h, number);
            }
        }
    }
    let claim_of = |by: By| {
        base + match by {
            By::Piece(k) => claim_of_statement.get(&read.pieces[k].statement).copied().unwrap_or(0),
            By::Helper(h) => claim_of_statement.get(&read.helpers[h].statement).copied().unwrap_or(0),
        }
    };
    for (at, statement) in all.iter().enumerate() {
        if !claim_of_statement.contains_key(&at) {
            if is_general(text, statement) {
                continue;
            }
            if let Some((_, errors)) = read.unread.iter().find(|u| u.0 == at) {
                let why = errors.first().map_or(Unreadable::NeitherFormulaNorProduct, |e| e.why.clone());
                judged
                    .unjudged
                    .push(Unjudged { span: statement.span.clone(), why: Skipped::Unreadable(why) });
            } else if let Some(h) = read.helpers.iter().find(|h| h.statement == at) {
                let why = Skipped::Unused(h.name.clone());
                judged.unjudged.push(Unjudged { span: statement.span.clone(), why });
            } else if !is_given(text, statement, read) {
                judged.unjudged.push(silent(statement));
            }
            continue;
        }
        let pieces: Vec<usize> = (0..read.pieces.len()).filter(|k| read.pieces[*k].statement == at).collect();
        let mut entries: Vec<Entry> = pieces
            .iter()
            .map(|&k| verdict::entry(&read.pieces[k], &said[k], subject, &names, &claim_of))
            .collect();
        let about = match pieces.first() {
            Some(&k) => {
                read.pieces[k].candidates.first().map_or(About::Helper, |&q| About::Dynamics(kind(q)))
            }
            None => About::Helper,
        };
        if let (true, Some(h)) = (pieces.is_empty(), read.helpers.iter().position(|h| h.statement == at)) {
            let helper = &read.helpers[h];
            let finding = match helpers.iter().find(|x| x.0 == h) {
                Some((_, wanted, slips)) => {
                    Finding::Wrong(Box::new(verdict::wrong(helper.value, *wanted, slips, subject, &names)))
                }
                None => Finding::Equal { unless_zero: vec![] },
            };
            entries.push(Entry { place: None, span: helper.span.clone(), finding, identities: vec![] });
            let truth = helpers.iter().find(|x| x.0 == h).map_or(helper.value, |x| x.1);
            for (span, value) in &helper.also {
                let finding = match denavit_symbolic::equal(*value, truth) {
                    denavit_symbolic::Equality::Equal { conditions } => Finding::Equal {
                        unless_zero: conditions.iter().map(|e| Formula::new(*e, &names)).collect(),
                    },
                    // A value in numbers is one at a configuration.
                    _ if value.symbols().is_empty() => Finding::Undecided { why: Unproved::NotFound },
                    _ => Finding::Wrong(Box::new(verdict::wrong(*value, truth, &[], subject, &names))),
                };
                entries.push(Entry { place: None, span: span.clone(), finding, identities: vec![] });
            }
        }
        let name = name_of(text, statement);
        judged.claims.push(Claim {
            span: statement.span.clone(),
            name,
            about,
            entries,
            instead: None,
            remarks: vec![],
            robot: number,
        });
    }
    let mut spoken = spoken_torques::judged(text, subject, &attempt, number);
    spoken.extend(in_numbers::judged(text, all, subject, &attempt, number));
    let touch = |a: &Range<usize>, b: &Range<usize>| a.start < b.end && b.start < a.end;
    spoken.retain(|c| !known.iter().any(|other| touch(&c.span, &other.span)));
    judged.unjudged.retain(|u| !spoken.iter().any(|c| touch(&c.span, &u.span)));
    judged.claims.extend(spoken);
}

/// The left side as printed; of one that holds matrices another side that is short.
fn name_of(text: &str, statement: &Statement) -> String {
    let shown = |s: &Side| text.get(s.span.clone()).unwrap_or_default().trim().to_string();
    let is_plain = |s: &&Side| statements::formula_span(s).is_some();
    let first = statement.sides.first().filter(is_plain).or(statement.sides.iter().find(is_plain));
    match first.or(statement.sides.last()) {
        Some(side) => shown(side),
        None => String::new(),
    }
}

/// True for what only says what torques are made of: `τ = M(q) q̈ + C(q, q̇) q̇ + g(q)`.
fn is_general(text: &str, statement: &Statement) -> bool {
    let source = text.get(statement.span.clone()).unwrap_or_default();
    let words = words::words(source);
    let has_number = words.iter().any(|w| w.chars().any(|c| c.is_ascii_digit()));
    // `m`, `I`, `l`, `g` are those of a formula.
    let has_body = ["m", "I", "l", "g"].iter().any(|w| words.contains(*w));
    taken::is_form(source) || !has_number && !has_body && source.len() < 300
}

/// True for what says what a mass, an inertia or a length is.
fn is_given(text: &str, statement: &Statement, read: &statements::Read) -> bool {
    let name = statement.sides.first().and_then(statements::formula_span);
    let name = name.and_then(|span| statements::lone_name(text, &span));
    name.is_some_and(|n| read.given.contains_key(&denavit_symbolic::Symbol::new(&statements::word(&n))))
}

/// What a quantity is called.
fn kind(quantity: Quantity) -> Dynamic {
    match quantity {
        Quantity::Torque(_) | Quantity::Inertial(_) => Dynamic::Torque,
        Quantity::Bias(_) => Dynamic::Bias,
        Quantity::Inertia(..) | Quantity::InertiaRate(..) => Dynamic::Inertia,
        Quantity::Velocity(_) => Dynamic::Velocity,
        Quantity::Centrifugal(..)
        | Quantity::Coriolis(..)
        | Quantity::Christoffel(..)
        | Quantity::Asada(..)
        | Quantity::CoriolisEntry(..) => Dynamic::Coriolis,
        Quantity::Gravity(_) => Dynamic::Gravity,
        Quantity::Kinetic(_) | Quantity::Link(_) | Quantity::Motor(_) => Dynamic::Kinetic,
        Quantity::Potential(_) => Dynamic::Potential,
        Quantity::Lagrangian => Dynamic::Lagrangian,
        Quantity::Energy => Dynamic::Energy,
        Quantity::Coordinate(..) => Dynamic::Place,
        Quantity::Rate(..) | Quantity::Slope(..) | Quantity::Speed(..) => Dynamic::Motion,
        Quantity::Momentum(_)
        | Quantity::MomentumRate(_)
        | Quantity::KineticSlope(_)
        | Quantity::LagrangianSlope(_) => Dynamic::Derivative,
    }
}
