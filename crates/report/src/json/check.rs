//! What was found in a document.

use crate::words::{Language, Wording};
use denavit::description::line_column;
use denavit_check::{Cause, Checked, Claim, Counterexample, Entry, Finding, Remark, Slip, Unread};
use serde_json::{Value, json};
use std::ops::Range;

/// All claims of a document (its name and its text) with their verdicts.
pub fn checked(name: &str, text: &str, checked: &Checked) -> Value {
    let document = &Document { text, checked };
    let tally = checked.tally();
    json!({
        "schema": 1,
        "document": name,
        "robots": checked.robots.iter().map(|r| r.name.as_str()).collect::<Vec<_>>(),
        "tally": {
            "equal": tally.equal,
            "wrong": tally.wrong,
            "conditional": tally.conditional,
            "undecided": tally.undecided,
            "unreadable": tally.unreadable,
        },
        "causes": checked.causes.iter().map(|c| cause(document, c)).collect::<Vec<_>>(),
        "claims": checked.claims.iter().map(|c| claim(document, c)).collect::<Vec<_>>(),
        "notes": checked.notes.iter().map(|n| words().note(n)).map(|n| json!({
            "severity": n.severity.name(),
            "at": place(document, &n.span),
            "message": n.message,
            "hint": n.hint,
        })).collect::<Vec<_>>(),
    })
}

/// `H_6^3, row 3, column 2`
pub fn entry_name(claim: &Claim, place: Option<(usize, usize)>) -> String {
    match place {
        Some((r, c)) => format!("{}, row {r}, column {c}", claim.name),
        None => claim.name.clone(),
    }
}

/// JSON is in English.
fn words() -> &'static dyn Wording {
    Language::English.words()
}

fn remarks(all: &[Remark]) -> Vec<String> {
    all.iter().map(|r| words().remarked(r)).collect()
}

/// A document with what was found in it.
struct Document<'a> {
    text: &'a str,
    checked: &'a Checked,
}

impl Document<'_> {
    /// The part at a place, blanks run together.
    fn source(&self, span: &Range<usize>) -> String {
        let source = self.text.get(span.clone()).unwrap_or_default();
        source.split_whitespace().collect::<Vec<_>>().join(" ")
    }
}

fn place(document: &Document<'_>, span: &Range<usize>) -> Value {
    let (line, column) = line_column(document.text, span.start);
    json!({ "line": line, "column": column, "bytes": [span.start, span.end] })
}

fn cause(document: &Document<'_>, cause: &Cause) -> Value {
    let names = |places: &[(usize, usize)]| {
        let name = |&(c, e): &(usize, usize)| {
            let claim = document.checked.claims.get(c)?;
            Some(entry_name(claim, claim.entries.get(e)?.place))
        };
        places.iter().filter_map(name).collect::<Vec<String>>()
    };
    json!({
        "change": words().change(&cause.change),
        "slip": cause.slip.as_ref().map(|s| slip(document, s)),
        "turns_right": names(&cause.turns_right),
        "turns_wrong": names(&cause.turns_wrong),
        "stays_wrong": names(&cause.stays_wrong),
    })
}

fn claim(document: &Document<'_>, claim: &Claim) -> Value {
    let entries: Vec<Value> = claim.entries.iter().map(|e| entry(document, e)).collect();
    // The first entry with the claim's own verdict speaks for it.
    let standing = claim.standing();
    let speaker = claim.entries.iter().position(|e| e.finding.standing() == standing);
    let of = |key: &str| speaker.and_then(|i| entries[i].get(key)).cloned().unwrap_or(Value::Null);
    json!({
        "claim": claim.name,
        "about": words().about(&claim.about),
        "at": place(document, &claim.span),
        "robot": claim.robot,
        "verdict": standing.name(),
        "correct": of("correct"),
        "slip": of("slip"),
        "instead": claim.instead.map(|i| words().instead(i)),
        "remarks": remarks(&claim.remarks),
        "entries": entries,
    })
}

fn entry(document: &Document<'_>, entry: &Entry) -> Value {
    let mut value = json!({
        "verdict": entry.finding.standing().name(),
        "at": place(document, &entry.span),
        "printed": document.source(&entry.span),
    });
    let mut set = |key: &str, v: Value| value[key] = v;
    if let Some((row, column)) = entry.place {
        set("row", row.into());
        set("column", column.into());
    }
    match &entry.finding {
        Finding::Equal { unless_zero } => {
            if !unless_zero.is_empty() {
                set("unless_zero", unless_zero.iter().map(ToString::to_string).collect());
            }
        }
        Finding::Conditional { condition, correct, remarks: all } => {
            set("condition", json!(words().right_where(condition)));
            set("correct", json!(words().either(correct)));
            set("remarks", json!(remarks(all)));
        }
        Finding::Undecided { why } => set("why", json!(words().unproved(*why))),
        Finding::Unreadable(findings) => {
            let of = |u: &Unread| {
                let d = words().unread(u);
                json!({ "at": place(document, &d.span), "message": d.message, "hint": d.hint })
            };
            set("errors", findings.iter().map(of).collect());
        }
        Finding::Wrong(wrong) => {
            set("correct", json!(words().either(&wrong.correct)));
            set("slip", json!(wrong.slip.as_ref().map(|s| slip(document, s))));
            set("rivals", wrong.rivals.iter().map(|s| slip(document, s)).collect());
            set("difference", json!(wrong.difference.as_ref().map(ToString::to_string)));
            set("counterexample", json!(wrong.counterexample.as_ref().map(example)));
            set("holds_if", json!(wrong.holds_if.map(|p| words().is_zero(p))));
            set("remarks", json!(remarks(&wrong.remarks)));
            if let Some((cause, under)) = &wrong.under_cause {
                set("under_cause", json!({ "cause": cause, "slip": slip(document, under) }));
            }
        }
    }
    value
}

fn slip(document: &Document<'_>, slip: &Slip) -> Value {
    let patches = slip
        .patches
        .iter()
        .map(|p| json!({ "at": place(document, &p.span), "was": document.source(&p.span), "now": p.now }));
    json!({
        "kind": slip.kind.id(),
        "words": words().slip(&slip.kind),
        "patches": patches.collect::<Vec<_>>(),
        "formula": slip.formula,
    })
}

fn example(example: &Counterexample) -> Value {
    let at: serde_json::Map<String, Value> = example.at.iter().map(|(n, x)| (n.clone(), json!(x))).collect();
    json!({ "at": at, "printed": example.printed, "right": example.right })
}
