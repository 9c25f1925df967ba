//! The documents of `examples/documents/`, checked: every verdict, and that what is called right is right.
//!
//! `snapshots/*.txt` holds what is expected of each claim, reviewed against the sources; `docs/errata.md` tells the
//! wrong ones. A line that ends in `…` leaves open how it goes on; a lone `…` under a claim, what is said of it.

use denavit::description::line_column;
use denavit_check::{CheckOptions, Checked, Claim, Entry, Finding, Patch, Slip, Standing, check};
use denavit_reading::document::Format;

fn document(name: &str) -> String {
    let path = format!("{}/../../examples/documents/{name}.md", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{path}: {e}"))
}

fn checked(text: &str) -> Checked {
    check(text, Format::Markdown, None, &CheckOptions::default())
        .unwrap_or_else(|errors| panic!("{errors:?}"))
}

/// `3,4 ` for an entry of a matrix.
fn place(entry: &Entry) -> String {
    entry.place.map_or(String::new(), |(r, c)| format!("{r},{c} "))
}

/// A claim with its line and verdict, and under it what is wrong: place, slip and what is right.
fn block(text: &str, checked: &Checked, claim: &Claim) -> Vec<String> {
    let (line, _) = line_column(text, claim.span.start);
    let name = claim.name.split_whitespace().collect::<Vec<_>>().join(" ");
    let mut lines = vec![format!("{line:3} {} {name}", claim.standing().name())];
    for entry in &claim.entries {
        let place = place(entry);
        match &entry.finding {
            Finding::Equal { .. } => {}
            Finding::Wrong(wrong) => {
                let slip = wrong.slip.as_ref().map_or("", |s| s.kind.id());
                let right = wrong.correct.join(" or ");
                lines.push(format!("    {place}{slip}: {right}"));
                lines.extend(
                    wrong
                        .under_cause
                        .iter()
                        .map(|(k, s)| format!("    {place}by cause {}: {}", k + 1, s.formula)),
                );
            }
            Finding::Conditional { condition, correct, .. } => {
                lines.push(format!("    {place}right {condition:?}"));
                if !correct.is_empty() {
                    lines.push(format!("    {place}everywhere: {}", correct.join(" or ")));
                }
            }
            Finding::Carried { by, correct } => {
                let cause = &checked.claims[*by].name;
                lines.push(format!("    {place}carried from {cause}: {}", correct.join(" or ")));
            }
            Finding::Undecided { why } => lines.push(format!("    {place}{why:?}")),
            Finding::Unreadable(errors) => {
                lines.extend(errors.iter().map(|e| format!("    {place}{:?}", e.why)));
            }
        }
    }
    lines.extend(claim.remarks.iter().map(|r| format!("    {r:?}")));
    lines
}

/// What is found in a document: a block for each cause and for each claim.
fn found(text: &str, checked: &Checked) -> Vec<Vec<String>> {
    let names = |places: &[(usize, usize)]| {
        let name = |&(c, e): &(usize, usize)| {
            let claim = &checked.claims[c];
            format!("{} {}", claim.name, place(&claim.entries[e])).trim_end().to_string()
        };
        places.iter().map(name).collect::<Vec<_>>().join(", ")
    };
    let causes = (1..).zip(&checked.causes).map(|(k, cause)| {
        vec![
            format!("cause {k}: {:?}", cause.change),
            format!("    turns right: {}", names(&cause.turns_right)),
            format!("    turns wrong: {}", names(&cause.turns_wrong)),
            format!("    stays wrong: {}", names(&cause.stays_wrong)),
        ]
    });
    causes.chain(checked.claims.iter().map(|claim| block(text, checked, claim))).collect()
}

/// Whether lines are as expected, where `…` leaves open what follows.
fn agrees(found: &[String], expected: &[&str]) -> bool {
    let same = |f: &String, e: &str| e.strip_suffix('…').map_or(f == e, |start| f.starts_with(start));
    match expected {
        [claim, open] if open.trim() == "…" => same(&found[0], claim),
        _ => found.len() == expected.len() && found.iter().zip(expected).all(|(f, e)| same(f, e)),
    }
}

/// Compares what is found with the snapshot; of `slips` claims the slip is known, and mended they are right.
#[track_caller]
fn expect(name: &str, slips: usize) {
    let text = document(name);
    let checked = checked(&text);
    let found = found(&text, &checked);
    let path = format!("{}/tests/snapshots/{name}.txt", env!("CARGO_MANIFEST_DIR"));
    if std::env::var_os("UPDATE_SNAPSHOTS").is_some() {
        std::fs::write(&path, found.concat().join("\n") + "\n").expect("the snapshot is written");
    }
    let expected = std::fs::read_to_string(&path).unwrap_or_default();
    let mut blocks: Vec<Vec<&str>> = vec![];
    for line in expected.lines() {
        match blocks.last_mut() {
            Some(block) if line.starts_with("    ") => block.push(line),
            _ => blocks.push(vec![line]),
        }
    }
    for (f, e) in found.iter().zip(&blocks) {
        assert!(agrees(f, e), "found\n{}\nexpected\n{}", f.join("\n"), e.join("\n"));
    }
    assert_eq!(found.len(), blocks.len(), "as many claims; UPDATE_SNAPSHOTS=1 writes the new verdicts");
    assert_eq!(mended(&text, &checked, ("", ""), slip), slips);
}

#[test]
fn general_transforms() {
    expect("transforms", 0);
}

#[test]
fn staubli_rx90() {
    expect("rx90", 2);
}

#[test]
fn stanford() {
    expect("stanford", 1);
}

#[test]
fn prrrrp() {
    expect("prrrrp", 1);
}

#[test]
fn ur3() {
    expect("ur3", 28);
}

#[test]
fn cylindrical() {
    expect("cylindrical", 4);
}

#[test]
fn smart5_six() {
    expect("smart5", 0);
}

/// A text with parts of it replaced.
fn patched(text: &str, patches: impl Iterator<Item = Patch>) -> String {
    let mut patches: Vec<Patch> = patches.collect();
    patches.sort_by_key(|p| (p.span.start, p.span.end));
    patches.dedup();
    let mut out = String::new();
    let mut at = 0;
    for patch in patches {
        out += &text[at..patch.span.start];
        out += &patch.now;
        at = patch.span.end;
    }
    out + &text[at..]
}

/// Mends all slips at once, in a table that may be changed, too; proves that the claims that had some are right then, and
/// counts them.
fn mended(text: &str, before: &Checked, change: (&str, &str), slip: fn(&Entry) -> Option<&Slip>) -> usize {
    let slips = before.claims.iter().flat_map(|c| &c.entries).filter_map(slip);
    let text = patched(text, slips.flat_map(|s| s.patches.clone())).replace(change.0, change.1);
    let after = checked(&text);
    assert_eq!(before.claims.len(), after.claims.len());
    let pairs = before.claims.iter().zip(&after.claims);
    let of_slips: Vec<_> = pairs.filter(|(b, _)| b.entries.iter().any(|e| slip(e).is_some())).collect();
    for (b, a) in &of_slips {
        assert_eq!(a.standing(), Standing::Equal, "{}: {}", b.name, block(&text, &after, a).join("\n"));
    }
    of_slips.len()
}

fn slip(entry: &Entry) -> Option<&Slip> {
    match &entry.finding {
        Finding::Wrong(wrong) => wrong.slip.as_ref(),
        _ => None,
    }
}

fn slip_by_the_first_cause(entry: &Entry) -> Option<&Slip> {
    match &entry.finding {
        Finding::Wrong(wrong) => wrong.under_cause.as_ref().filter(|u| u.0 == 0).map(|u| &u.1),
        _ => None,
    }
}

/// The report on the UR3 with α5 = −90°, which its products follow: the entries turn as the first cause says, and what
/// stays wrong has the slips that it says.
#[test]
fn ur3_with_the_likely_table() {
    let change = ("83.4 | 0 | 90° |\n| 6", "83.4 | 0 | -90° |\n| 6");
    let text = document("ur3");
    assert_eq!(text.matches(change.0).count(), 1);
    let before = checked(&text);
    let cause = &before.causes[0];
    let after = checked(&text.replace(change.0, change.1));
    let standing = |&(c, e): &(usize, usize)| after.claims[c].entries[e].finding.standing();
    for at in &cause.turns_right {
        assert_eq!(standing(at), Standing::Equal, "{}", after.claims[at.0].name);
    }
    for at in cause.turns_wrong.iter().chain(&cause.stays_wrong) {
        let is_wrong = matches!(standing(at), Standing::Wrong | Standing::Carried);
        assert!(is_wrong, "{}", after.claims[at.0].name);
    }
    assert_eq!(mended(&text, &before, change, slip_by_the_first_cause), 14);
}
