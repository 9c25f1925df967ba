//! What is wrong in the document that the robot comes from.

use super::setting::Setting;
use crate::document::Section;
use denavit::explain::{Block, Language, Line};
use denavit_check::{Claim, Entry, Finding, Slip, Standing};

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
    let counted = [
        (t.equal, ["proved", "proved"], ["démontrée", "démontrées"]),
        (t.wrong, ["wrong", "wrong"], ["fausse", "fausses"]),
        (t.conditional, ["right under a condition"; 2], ["juste sous condition", "justes sous condition"]),
        (t.undecided, ["undecided"; 2], ["indécise", "indécises"]),
        (t.unreadable, ["unreadable"; 2], ["illisible", "illisibles"]),
    ];
    let parts = counted.into_iter().filter(|c| c.0 > 0);
    let parts: Vec<String> = parts.map(|(n, en, fr)| s.language.counted(n, en, fr)).collect();
    section.paragraph(Line::new(s.language.spaced(&s.language.pick(
        format!("{name} claims {n} formulas: {}.", s.language.listed(&parts)),
        format!("{name} énonce {n} formules : {}.", s.language.listed(&parts)),
    ))));
    for cause in &checked.causes {
        let counts = [&cause.turns_right, &cause.turns_wrong, &cause.stays_wrong].map(Vec::len);
        let mut line = Line::default().strong(cause.change.clone());
        line = line.text(s.language.spaced(&s.language.pick(
            format!(
                " would turn {} of them right and {} wrong; {} would stay wrong.",
                counts[0], counts[1], counts[2]
            ),
            format!(
                " en rendrait {} justes et {} fausses ; {} resteraient fausses.",
                counts[0], counts[1], counts[2]
            ),
        )));
        section.paragraph(line);
    }
    let mut all = Listed::default();
    for claim in checked.claims.iter().filter(|c| c.standing() != Standing::Equal) {
        for entry in &claim.entries {
            all.add(s, errata.text, claim, entry);
        }
    }
    for (english, french, lines) in [
        ("Wrong", "Faux", all.wrong),
        ("Right under a condition", "Juste sous condition", all.conditional),
        ("Not decided or not readable", "Indécis ou illisible", all.open),
    ] {
        if lines.is_empty() {
            continue;
        }
        section.heading(3, s.line(english, french));
        let more = lines.len().saturating_sub(ROWS);
        section.push(Block::List(lines.into_iter().take(ROWS).collect()));
        if more > 0 {
            section.paragraph(Line::new(s.language.pick(
                format!("And {more} more; `denavit check` lists them."),
                format!("Et {more} autres ; `denavit check` les donne."),
            )));
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
}

impl Listed {
    fn add(&mut self, s: &Setting, text: &str, claim: &Claim, entry: &Entry) {
        let place = entry.place.map(|(r, c)| format!(" [{r}, {c}]")).unwrap_or_default();
        let number = text.get(..entry.span.start).map_or(0, |t| t.matches('\n').count()) + 1;
        let printed = text.get(entry.span.clone()).unwrap_or_default();
        let printed = shortened(&printed.split_whitespace().collect::<Vec<_>>().join(" "));
        let head = Line::default().strong(shortened(&format!("{}{place}", claim.name)));
        let head = head.text(s.language.spaced(
            &s.language.pick(format!(", line {number}: {printed}"), format!(", ligne {number} : {printed}")),
        ));
        let right = |line: Line, correct: &Option<String>| match correct {
            Some(formula) => line.text(s.say("; right: ", " ; juste : ")).text(shortened(formula)),
            None => line,
        };
        match &entry.finding {
            Finding::Equal { .. } => {}
            Finding::Wrong(w) => {
                let line = right(head, &w.correct);
                self.wrong.push(match &w.slip {
                    Some(found) => line.text(" (").text(slip(s, found)).text(")"),
                    None => line,
                });
            }
            Finding::Conditional { condition, correct, .. } => {
                let line = head.text(s.language.pick(format!(" ({condition})"), String::new()));
                self.conditional.push(right(line, correct));
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
