//! Documents as strangers write them, with the truth beside each statement: nothing right is called wrong, nothing wrong right.
//!
//! They lie in `tests/labelled`, labels (`line`, `printed`, `truth`) made by computations of their own. What is not judged is
//! counted: more may become so, less may not.

use denavit::description::{Description, read_toml};
use denavit_check::{CheckOptions, Checked, Standing, check};
use denavit_reading::code::Dialect;
use denavit_reading::document::Format;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// The tests among which the documents are divided.
const PARTS: usize = 4;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/labelled")
}

fn text(name: &str) -> String {
    std::fs::read_to_string(folder().join(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
}

fn checked(label: &Value) -> Result<Checked, String> {
    let name = label["document"].as_str().expect("a document");
    let robot: Option<Description> = label["robot"].as_str().map(|r| read_toml(&text(r)).expect("a robot").0);
    let (format, language) = match name.rsplit('.').next() {
        Some("tex") => (Format::Latex, None),
        Some("py") => (Format::Markdown, Some(Dialect::Python)),
        Some("m" | "jl") => (Format::Markdown, Some(Dialect::Matlab)),
        Some("c" | "cpp" | "ino" | "js") => (Format::Markdown, Some(Dialect::C)),
        _ => (Format::Markdown, None),
    };
    let options = CheckOptions { language, ..CheckOptions::default() };
    check(&text(name), format, robot.as_ref(), &options).map_err(|e| format!("{e:?}"))
}

/// A left side without what spelling adds.
fn plain(name: &str) -> String {
    const GREEK: [(char, &str); 9] = [
        ('θ', "theta"),
        ('ϑ', "theta"),
        ('φ', "phi"),
        ('α', "alpha"),
        ('β', "beta"),
        ('γ', "gamma"),
        ('ψ', "psi"),
        ('ω', "omega"),
        ('τ', "tau"),
    ];
    let spelled: String = name
        .chars()
        .map(|c| GREEK.iter().find(|g| g.0 == c).map_or_else(|| c.to_string(), |g| g.1.to_string()))
        .collect();
    let looks =
        ["\\mathrm", "\\text", "\\operatorname", "\\dot", "\\mathbf", "\\mathit", "\\boldsymbol", "var"];
    let bare = looks.iter().fold(spelled, |s, look| s.replace(look, ""));
    bare.chars().filter(char::is_ascii_alphanumeric).collect::<String>().to_lowercase()
}

/// What is said wrongly of a document, the statements that are judged, and all of them.
fn judged(label: &Value) -> (Vec<String>, usize, usize) {
    let name = label["document"].as_str().expect("a document");
    let labels = label["claims"].as_array().expect("labels");
    let text = text(name);
    let Ok(checked) = checked(label) else { return (vec![], 0, labels.len()) };
    let line = |at: usize| text[..at].matches('\n').count() + 1;
    let mut taken = vec![false; checked.claims.len()];
    let (mut slips, mut count) = (vec![], 0);
    for l in labels {
        let (at, printed) = (l["line"].as_u64().expect("a line"), l["printed"].as_str().expect("a name"));
        let truth = l["truth"].as_str().expect("a truth");
        let fits = |(k, c): &(usize, &denavit_check::Claim)| {
            !taken[*k] && line(c.span.start) as u64 == at && plain(&c.name) == plain(printed)
        };
        let Some((k, claim)) = checked.claims.iter().enumerate().find(fits) else { continue };
        taken[k] = true;
        let standing = claim.standing();
        let is_false = matches!(truth, "right" | "conditional") && standing == Standing::Wrong;
        let is_missed = truth == "wrong" && standing == Standing::Equal;
        if is_false || is_missed {
            slips.push(format!("{name}:{at}: {printed} is {truth}, called {standing:?}"));
        }
        count += usize::from(matches!(
            standing,
            Standing::Equal | Standing::Wrong | Standing::Conditional | Standing::Carried
        ));
    }
    (slips, count, labels.len())
}

/// All documents of a part: at least so many of their statements are judged.
fn part(number: usize, least: usize) {
    let mut names: Vec<PathBuf> = std::fs::read_dir(folder())
        .expect("the folder")
        .filter_map(|e| Some(e.ok()?.path()).filter(|p| p.extension().is_some_and(|x| x == "json")))
        .collect();
    names.sort();
    let (mut slips, mut count, mut all) = (vec![], 0, 0);
    for path in names.iter().skip(number).step_by(PARTS) {
        let label: Value =
            serde_json::from_str(&std::fs::read_to_string(path).expect("a label")).expect("JSON");
        let (own, judged, labels) = judged(&label);
        slips.extend(own);
        count += judged;
        all += labels;
    }
    assert!(slips.is_empty(), "{}", slips.join("\n"));
    assert!(count >= least, "{count} of {all} are judged, {least} were");
}

#[test]
fn labelled_first() {
    part(0, 404);
}

#[test]
fn labelled_second() {
    part(1, 451);
}

#[test]
fn labelled_third() {
    part(2, 452);
}

#[test]
fn labelled_fourth() {
    part(3, 417);
}
