//! What is wrong in the document that the robot comes from.

use super::setting::Setting;
use crate::document::{Part, Section, Table};
use denavit::check::{Finding, Slip, Standing};
use denavit::explain::{Language, Line};

/// The counts, the causes and the slips; nothing if no document was checked or it claims nothing.
pub fn section(s: &Setting) -> Option<Section> {
    let errata = s.options.errata?;
    let checked = errata.checked;
    if checked.claims.is_empty() {
        return None;
    }
    let mut section = Section::new(s.description.vocabulary());
    section.heading(2, s.line("Errata", "Errata"));
    let t = checked.tally();
    let (n, name) = (checked.claims.len(), errata.name);
    section.paragraph(Line::new(s.language.spaced(&s.language.pick(
        format!(
            "{name} claims {n} formulas: {} proved, {} wrong, {} right under a condition, {} undecided, {} unreadable.",
            t.equal, t.wrong, t.conditional, t.undecided, t.unreadable
        ),
        format!(
            "{name} énonce {n} formules : {} démontrées, {} fausses, {} vraies sous condition, {} indécises, {} illisibles.",
            t.equal, t.wrong, t.conditional, t.undecided, t.unreadable
        ),
    ))));
    let rows: Vec<Vec<Line>> = checked
        .claims
        .iter()
        .filter(|c| c.standing() != Standing::Equal)
        .flat_map(|claim| {
            claim.entries.iter().filter_map(move |entry| {
                let place = entry.place.map(|(r, c)| format!(" [{}, {}]", r + 1, c + 1)).unwrap_or_default();
                let line = errata.text.get(..entry.span.start).map_or(0, |t| t.matches('\n').count()) + 1;
                let printed = errata.text.get(entry.span.clone()).unwrap_or_default();
                let printed = shortened(&printed.split_whitespace().collect::<Vec<_>>().join(" "));
                let (right, said) = match &entry.finding {
                    Finding::Equal { .. } => return None,
                    Finding::Wrong(w) => (
                        w.correct.clone().unwrap_or_default(),
                        w.slip.as_ref().map_or_else(|| wrong(s), |x| slip(s, x)),
                    ),
                    Finding::Conditional { condition, correct, .. } => (
                        correct.clone().unwrap_or_default(),
                        s.language.pick(format!("right {condition}"), "vrai sous condition".into()),
                    ),
                    Finding::Undecided { .. } => (String::new(), s.say("not decided", "indécis")),
                    Finding::Unreadable(_) => (String::new(), s.say("not readable", "illisible")),
                };
                Some(vec![
                    Line::new(shortened(&format!("{}{place}", claim.name))),
                    Line::new(line.to_string()),
                    Line::new(printed),
                    Line::new(shortened(&right)),
                    Line::new(said),
                ])
            })
        })
        .take(ROWS)
        .collect();
    if rows.is_empty() {
        section.paragraph(s.line("Nothing is wrong.", "Rien n'est faux."));
        return Some(section);
    }
    section.push(Part::Table(Table {
        caption: s.line("What is not right in it.", "Ce qui n'y est pas juste."),
        head: vec![
            s.line("claim", "énoncé"),
            s.line("line", "ligne"),
            s.line("printed", "imprimé"),
            s.line("right", "juste"),
            s.line("the slip", "la faute"),
        ],
        rows,
    }));
    Some(section)
}

/// More than these are not listed.
const ROWS: usize = 200;
/// Formulas longer than this are cut.
const LENGTH: usize = 90;

/// A formula as it is printed, cut if it is long; a line may end behind its signs.
fn shortened(text: &str) -> String {
    let mut out = String::new();
    for (k, c) in text.chars().enumerate() {
        if k == LENGTH {
            return out + " …";
        }
        out.push(c);
        if matches!(c, '+' | '-' | '−' | '*' | '/' | '(' | ')' | ',' | '=' | '}' | '·') {
            out.push('\u{200b}');
        }
    }
    out
}

fn wrong(s: &Setting) -> String {
    s.say("wrong", "faux")
}

/// The kind of a slip in words.
fn slip(s: &Setting, slip: &Slip) -> String {
    if s.language == Language::English {
        return slip.kind.clone();
    }
    let words = match &slip.id[..] {
        "sign" => "un signe",
        "sine-for-cosine" => "un sinus pour un cosinus, ou l'inverse",
        "index" => "un indice",
        "symbol" => "un symbole pour un autre",
        "lost-factor" => "un facteur manque",
        "extra-factor" => "un facteur de trop",
        "lost-term" => "un terme manque",
        "extra-term" => "un terme de trop",
        "bracket" => "une parenthèse mal placée",
        "exponent" => "un exposant",
        "number" => "un nombre",
        "exchanged" => "deux noms échangés",
        "transposed" => "deux éléments échangés par transposition",
        "entry" => "l'élément d'une autre place",
        "several" => "plusieurs fautes",
        _ => "une partie remplacée",
    };
    s.language.spaced(words)
}
