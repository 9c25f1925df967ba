//! What is wrong in the document that the robot comes from.

use super::setting::{Errata, Setting};
use crate::document::{Block, Line, Section};
use crate::words::{Heading, List, Standings};
use denavit_check::{Claim, Entry, Finding, Standing};

/// The counts, the causes and the slips; nothing if no document was checked or it claims nothing.
pub fn section(s: &Setting) -> Option<Section> {
    let errata = s.options.errata?;
    let checked = errata.checked;
    if checked.claims.is_empty() && checked.unjudged.is_empty() {
        return None;
    }
    let mut section = Section::new(s.description.vocabulary());
    section.heading(2, Line::new(s.words().heading(Heading::Errata)));
    let t = checked.tally();
    let standings = Standings {
        equal: t.equal,
        wrong: t.wrong,
        conditional: t.conditional,
        undecided: t.undecided,
        carried: t.carried,
        unreadable: t.unreadable,
        unjudged: t.unjudged,
    };
    section.paragraph(Line::new(s.words().claims(errata.name, checked.claims.len(), standings)));
    for cause in &checked.causes {
        let counts = [&cause.turns_right, &cause.turns_wrong, &cause.stays_wrong].map(Vec::len);
        section
            .paragraph(Line::default().strong(s.words().change(&cause.change)).text(s.words().cause(counts)));
    }
    let mut all = Listed::default();
    for claim in checked.claims.iter().filter(|c| c.standing() != Standing::Equal) {
        for entry in &claim.entries {
            all.add(s, &errata, claim, entry);
        }
    }
    let line = |at: usize| errata.text.get(..at).map_or(0, |t| t.matches('\n').count()) + 1;
    for found in &checked.unjudged {
        let printed = errata.text.get(found.span.clone()).unwrap_or_default();
        let printed = shortened(&printed.split_whitespace().collect::<Vec<_>>().join(" "));
        let head = s.words().printed(line(found.span.start), &printed);
        all.unjudged.push(Line::new(head).text(format!(" ({})", s.words().skipped(&found.why))));
    }
    let lists = [
        (List::Wrong, all.wrong),
        (List::Conditional, all.conditional),
        (List::Open, all.open),
        (List::Unjudged, all.unjudged),
    ];
    for (list, lines) in lists {
        if lines.is_empty() {
            continue;
        }
        section.heading(3, Line::new(s.words().list(list)));
        let more = lines.len().saturating_sub(ROWS);
        section.push(Block::List(lines.into_iter().take(ROWS).collect()));
        if more > 0 {
            section.paragraph(Line::new(s.words().more(more)));
        }
    }
    Some(section)
}

/// What is said of each entry that is not right.
#[derive(Default)]
struct Listed {
    wrong: Vec<Line>,
    conditional: Vec<Line>,
    open: Vec<Line>,
    unjudged: Vec<Line>,
}

impl Listed {
    fn add(&mut self, s: &Setting, errata: &Errata, claim: &Claim, entry: &Entry) {
        let text = errata.text;
        let place = entry.place.map(|(r, c)| format!(" [{r}, {c}]")).unwrap_or_default();
        let number = text.get(..entry.span.start).map_or(0, |t| t.matches('\n').count()) + 1;
        let printed = text.get(entry.span.clone()).unwrap_or_default();
        let printed = shortened(&printed.split_whitespace().collect::<Vec<_>>().join(" "));
        let head = Line::default().strong(shortened(&format!("{}{place}", claim.name)));
        let head = head.text(s.words().printed(number, &printed));
        let right = |line: Line, correct: &[String]| match s.words().either(correct) {
            Some(formula) => line.text(s.words().right()).text(shortened(&formula)),
            None => line,
        };
        match &entry.finding {
            Finding::Equal { .. } => {}
            Finding::Wrong(w) => {
                let line = right(head, &w.correct);
                self.wrong.push(match &w.slip {
                    Some(found) => line.text(format!(" ({})", s.words().slip(&found.kind))),
                    None => line,
                });
            }
            Finding::Conditional { condition, correct, .. } => {
                let line = head.text(format!(" ({})", s.words().right_where(condition)));
                self.conditional.push(right(line, correct));
            }
            Finding::Carried { by, correct } => {
                let Some(cause) = errata.checked.claims.get(*by) else { return };
                let line = text.get(..cause.span.start).map_or(0, |t| t.matches('\n').count()) + 1;
                let carried = s.words().carried(&cause.name, line);
                self.wrong.push(right(head, correct).text(format!(" ({carried})")));
            }
            Finding::Undecided { .. } | Finding::Unreadable(_) => self.open.push(head),
        }
    }
}

/// More than these are not listed.
const ROWS: usize = 200;
/// Formulas longer than this are cut.
const LENGTH: usize = 160;

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
