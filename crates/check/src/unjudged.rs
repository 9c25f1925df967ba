//! What of a document was not judged, so that nothing is passed over in silence; and the helpers that what is proved uses.

use super::CheckOptions;
use super::facts::{About, Condition};
use super::lexis::read;
use super::lines::lines;
use super::note::Unreadable;
use super::outcome::{Claim, Entry, Finding, Skipped, Standing, Unjudged};
use super::plan::Walked;
use super::walk::{Assertion, Defined, Pair, Piece, Spoken};
use denavit_reading::document::{Document, Statement};
use denavit_symbolic::equal;
use denavit_symbolic::parse::{Syntax, SyntaxKind};
use denavit_symbolic::vocabulary::{Vocabulary, plain_name};
use std::collections::BTreeSet;
use std::ops::Range;

/// No more lines are listed.
const MAX_LISTED: usize = 1_000;
/// The longest line that is looked at.
const LONGEST: usize = 2_000;

/// Lists what looks like a formula and was not judged; helpers that proved formulas use become claims of their own.
pub(super) fn listed(
    text: &str,
    document: &Document,
    walked: &Walked,
    rows: &[Range<usize>],
    claims: &mut Vec<Claim>,
    options: &CheckOptions,
) -> Vec<Unjudged> {
    let judged: Vec<Range<usize>> = claims.iter().map(|c| c.span.clone()).collect();
    claims.extend(helpers(text, walked, claims));
    let covered: Vec<Range<usize>> = claims.iter().map(|c| c.span.clone()).collect();
    let mut found: Vec<Unjudged> = vec![];
    let touches = |all: &[Range<usize>], span: &Range<usize>| {
        all.iter().any(|s| s.start < span.end && span.start < s.end)
    };
    for statement in &document.statements {
        let span = &statement.span;
        let is_quiet = [&covered, &walked.taken, &walked.ignored].into_iter().any(|all| touches(all, span));
        if is_quiet || is_named(text, walked, span, claims) {
            continue;
        }
        found.push(Unjudged { span: span.clone(), why: why(walked, statement) });
    }
    for (span, name) in &walked.unsaid {
        if !touches(&covered, span) && !touches(&walked.taken, span) {
            found.push(Unjudged { span: span.clone(), why: Skipped::Unused(name.clone()) });
        }
    }
    for row in rows.iter().filter(|row| !touches(&covered, row)) {
        found.push(Unjudged { span: row.clone(), why: Skipped::SaysNothing });
    }
    for error in &walked.refused {
        if !touches(&judged, &error.span) {
            found.push(Unjudged { span: error.span.clone(), why: Skipped::Unreadable(error.why.clone()) });
        }
    }
    if options.language.is_none() {
        let read: Vec<Range<usize>> = document
            .statements
            .iter()
            .map(|s| s.span.clone())
            .chain(document.code.iter().map(|c| c.span.clone()))
            .chain(document.directives.iter().map(|d| d.span.clone()))
            .chain(document.statements.iter().flat_map(|s| &s.directives).map(|d| d.span.clone()))
            .chain(walked.taken.iter().cloned())
            .collect();
        let mut is_drawing = false;
        for line in lines(text) {
            let shown = text.get(line.clone()).unwrap_or_default();
            is_drawing |= shown.contains("\\begin{tikzpicture}");
            if is_drawing {
                is_drawing = !shown.contains("\\end{tikzpicture}");
                continue;
            }
            if !looks_like_formula(shown) {
                continue;
            }
            if !touches(&read, &line) && !touches(&covered, &line) {
                found.push(Unjudged { span: trimmed(text, line), why: Skipped::AmongWords });
                continue;
            }
            // Beside what is read.
            let is_said = |span: &Range<usize>| touches(&read, span) || touches(&covered, span);
            let beside = left_over(text, &line, &|name| is_given(walked, name));
            let open = beside.into_iter().filter(|span| !is_said(span));
            found.extend(open.map(|span| Unjudged { span, why: Skipped::AmongWords }));
        }
    }
    found.sort_by_key(|u| (u.span.start, u.span.end));
    found.dedup_by(|a, b| a.span == b.span);
    found.truncate(MAX_LISTED);
    found
}

/// The lines of programs of which no claim and nothing in a list says anything.
pub(super) fn passed_over(
    computed: Vec<(Range<usize>, String)>,
    claims: &[Claim],
    listed: &[Unjudged],
) -> Vec<Unjudged> {
    // A function that is listed as a whole says nothing of its lines.
    let is_line = |u: &&Unjudged| !matches!(u.why, Skipped::Unreadable(Unreadable::NothingTold(_)));
    let said: Vec<&Range<usize>> =
        claims.iter().map(|c| &c.span).chain(listed.iter().filter(is_line).map(|u| &u.span)).collect();
    let is_new = |span: &Range<usize>| !said.iter().any(|s| s.start < span.end && span.start < s.end);
    let new = computed.into_iter().filter(|c| is_new(&c.0));
    new.map(|(span, name)| Unjudged { span, why: Skipped::OfProgram(name) }).collect()
}

/// Why a statement was not judged.
fn why(walked: &Walked, statement: &Statement) -> Skipped {
    let span = &statement.span;
    let within = |other: &Range<usize>| other.start < span.end && span.start < other.end;
    if let Some(defined) = walked.defined.iter().find(|d| within(&d.statement)) {
        return Skipped::Unused(defined.shown.clone());
    }
    if let Some((_, name)) = walked.named.iter().find(|n| within(&n.0)) {
        return Skipped::Unused(name.clone());
    }
    match walked.skipped.iter().find(|s| within(&s.0)) {
        Some((_, Unreadable::NeitherFormulaNorProduct)) | None => Skipped::SaysNothing,
        Some((_, why)) => Skipped::Unreadable(why.clone()),
    }
}

/// True for a statement that names a matrix which a claim further down uses.
fn is_named(text: &str, walked: &Walked, span: &Range<usize>, claims: &[Claim]) -> bool {
    let names = walked.named.iter().filter(|n| n.0 == *span);
    let is_used = |name: &str| {
        let later = claims.iter().filter(|c| c.span.start >= span.end);
        later.into_iter().any(|c| mentions(text.get(c.span.clone()).unwrap_or_default(), name))
    };
    let shown = text.get(span.clone()).unwrap_or_default();
    names.into_iter().any(|(_, name)| is_used(name))
        || entries_of_names(shown).is_some_and(|all| all.iter().any(|e| is_used(e)))
}

/// The entries of a printed matrix that gives names to entries and says nothing else: `U = [n_x o_x …]`, each name once.
fn entries_of_names(shown: &str) -> Option<Vec<String>> {
    let (_, inner) = shown.split_once("matrix}")?;
    let (inner, _) = inner.split_once("\\end")?;
    let cells: Vec<&str> = inner.split("\\\\").flat_map(|row| row.split('&')).map(str::trim).collect();
    let is_number = |c: &&&str| c.chars().all(|x| x.is_ascii_digit());
    let names: Vec<String> =
        cells.iter().filter(|c| !is_number(c)).map(|c| super::custom::plain(c)).collect();
    let is_name = |n: &String| {
        n.starts_with(char::is_alphabetic) && n.chars().all(char::is_alphanumeric) && n.chars().count() <= 4
    };
    let is_new = |k: usize| !names[..k].contains(&names[k]);
    (names.len() >= 4 && names.iter().all(is_name) && (0..names.len()).all(is_new)).then_some(names)
}

/// The names that a formula, or several, are written in.
struct User<'a> {
    /// The equation, where it is one between values.
    equation: Option<&'a Assertion>,
    span: Range<usize>,
    names: BTreeSet<String>,
    /// A product of printed matrices, of which only the text is known.
    is_worked_out: bool,
    /// It is proved.
    is_proved: bool,
}

impl<'a> User<'a> {
    /// What stands in a statement.
    fn of(text: &str, assertion: &'a Assertion, is_proved: bool) -> Self {
        let span = assertion.span.clone();
        let equation = assertion.spoken.is_none().then_some(assertion);
        let mut user = User { equation, span, names: BTreeSet::new(), is_worked_out: false, is_proved };
        for piece in &assertion.pieces {
            match piece {
                Piece::Pair(Pair { printed: Some(syntax), span, .. }) => user.add(text, span, syntax),
                Piece::Pair(Pair { printed: None, .. }) => user.is_worked_out = true,
                Piece::Number { .. } | Piece::Unreadable { .. } => {}
            }
        }
        match &assertion.spoken {
            Some(Spoken::Joint { sides, .. }) => sides.iter().for_each(|(span, s)| user.add(text, span, s)),
            Some(Spoken::Angle { value: (span, syntax), .. }) => user.add(text, span, syntax),
            None => {}
        }
        if let Some((span, syntax)) = &assertion.reference {
            user.add(text, span, syntax);
        }
        // What a program gives back under its name is known by the text of its formula.
        let own = super::custom::plain(&assertion.name);
        user.is_worked_out |= user.names.len() == 1 && user.names.contains(&own);
        user
    }

    fn add(&mut self, text: &str, span: &Range<usize>, syntax: &Syntax) {
        if let SyntaxKind::Name(_) = syntax.kind {
            let shown = text.get(span.start + syntax.span.start..span.start + syntax.span.end);
            let shown = shown.unwrap_or_default();
            self.names.insert(super::custom::plain(shown));
            // A choice of a program, `up ? a : b`, is known by its text alone.
            if shown.contains(['?', '(']) && shown.contains(' ') {
                self.names.extend(crate::degrees::names_in(shown).map(super::custom::plain));
            }
        }
        syntax.children().into_iter().for_each(|part| self.add(text, span, part));
    }

    fn uses(&self, text: &str, name: &str) -> bool {
        self.names.contains(&super::custom::plain(name))
            || self.is_worked_out && mentions(text.get(self.span.clone()).unwrap_or_default(), name)
    }
}

/// True for a claim that shows its helpers to be right, if only under a condition: it is, or it is so in a part of all
/// configurations or as far as it goes, or one change of its own, or of a helper, makes it so.
fn rests_well(claim: &Claim, claims: &[Claim]) -> bool {
    let of = |e: &Entry| match &e.finding {
        Finding::Equal { .. } => true,
        Finding::Conditional { condition, .. } => !matches!(condition, Condition::AsUsed),
        Finding::Carried { by, .. } => claims.get(*by).is_some_and(|c| c.about == About::Helper),
        Finding::Wrong(wrong) => claim.about == About::Joint && wrong.slip.is_some(),
        _ => false,
    };
    !claim.entries.is_empty() && claim.entries.iter().all(of)
}

/// A claim for each helper that something right uses, directly or through another helper.
fn helpers(text: &str, walked: &Walked, claims: &[Claim]) -> Vec<Claim> {
    let good = claims.iter().zip(&walked.assertions).filter(|(c, _)| rests_well(c, claims));
    let mut users: Vec<User> =
        good.map(|(c, a)| User::of(text, a, c.standing() == Standing::Equal)).collect();
    let own =
        |d: &Defined| claims.iter().any(|c| c.span.start < d.statement.end && d.statement.start < c.span.end);
    let mut found: Vec<Claim> = vec![];
    // What is used last is defined last.
    for (k, defined) in walked.defined.iter().enumerate().rev() {
        if own(defined) {
            continue;
        }
        let end = walked.defined[k + 1..].iter().find(|d| d.name == defined.name).map(|d| d.from);
        let uses = |u: &&User| {
            u.span.start >= defined.from
                && end.is_none_or(|e| u.span.start < e)
                && u.span != defined.statement
                && u.uses(text, &defined.name)
                && !u
                    .equation
                    .is_some_and(|a| is_own_value(text, a, defined) || is_even(text, walked, a, defined))
        };
        let Some(is_proved) = users.iter().filter(uses).map(|u| u.is_proved).max() else { continue };
        let (span, names) = (defined.statement.clone(), BTreeSet::new());
        let mut user = User { equation: None, span, names, is_worked_out: false, is_proved };
        user.add(text, &defined.span, &defined.printed);
        users.push(user);
        let finding = match is_proved {
            true => Finding::Equal { unless_zero: vec![] },
            false => {
                let (correct, remarks) = (vec![], vec![]);
                Finding::Conditional { condition: Condition::AsUsed, correct, remarks }
            }
        };
        found.push(Claim {
            span: defined.statement.clone(),
            name: defined.shown.clone(),
            about: About::Helper,
            entries: vec![Entry { place: None, span: defined.span.clone(), finding, identities: vec![] }],
            instead: None,
            remarks: vec![],
            robot: defined.subject,
        });
    }
    found
}

/// True for an equation that only gives a helper its value in numbers: it says nothing of the helper.
fn is_own_value(text: &str, assertion: &Assertion, defined: &Defined) -> bool {
    let Some((span, syntax)) = &assertion.reference else { return false };
    let shown = text.get(span.clone()).unwrap_or_default();
    matches!(syntax.kind, SyntaxKind::Name(_))
        && super::custom::plain(shown) == super::custom::plain(&defined.name)
        && assertion.pieces.iter().all(|p| matches!(p, Piece::Number { .. } | Piece::Unreadable { .. }))
}

/// True for an equation that holds for a helper with the other sign as well, as one between squares: it says nothing of the helper.
fn is_even(text: &str, walked: &Walked, assertion: &Assertion, defined: &Defined) -> bool {
    let names = Vocabulary::clone(walked.names_of(assertion.subject)).alias(&defined.name, -defined.value);
    let value = |span: &Range<usize>| read(text, span, &names).ok().map(|s| s.value());
    let Some((reference, _)) = &assertion.reference else { return false };
    let holds = |piece: &Piece| match piece {
        Piece::Pair(pair) => match (value(reference), value(&pair.span)) {
            (Some(a), Some(b)) => equal(a, b).is_equal(),
            _ => false,
        },
        _ => false,
    };
    !assertion.pieces.is_empty() && assertion.pieces.iter().all(holds)
}

/// True if a formula uses a name.
pub(super) fn mentions(source: &str, name: &str) -> bool {
    mentions_in(source, name) || source.split_whitespace().any(|word| mentions_in(word, name))
}

fn mentions_in(source: &str, name: &str) -> bool {
    let (plain, name) = (super::custom::plain(source), super::custom::plain(name));
    let ends_in_digit = name.ends_with(|c: char| c.is_ascii_digit());
    let is_letter = |c: Option<char>| c.is_some_and(char::is_alphabetic);
    !name.is_empty()
        && plain.match_indices(&name).any(|(i, _)| {
            let (before, behind) = (plain[..i].chars().next_back(), plain[i + name.len()..].chars().next());
            let cut = match ends_in_digit {
                true => behind.is_some_and(|c| c.is_ascii_digit()),
                false => is_letter(behind) || behind.is_some_and(|c| c.is_ascii_digit()),
            };
            let is_part = is_letter(before) && name.chars().count() == 1;
            !(cut || is_part)
        })
}

/// True for a line with something like a formula on both sides of an equals sign.
fn looks_like_formula(line: &str) -> bool {
    let shown = line.trim();
    let foreign = shown.len() > LONGEST
        || shown.starts_with(['|', '<', '%', '#'])
        || shown.starts_with("\\usepackage")
        || shown.starts_with("\\newcommand")
        || shown.starts_with("\\includegraphics")
        || shown.starts_with("\\documentclass")
        || shown.contains("://")
        || shown.contains("check:")
        || super::plan::is_setting(shown);
    if foreign {
        return false;
    }
    let is_side = |s: &str| s.chars().any(char::is_alphanumeric);
    let mut sides = shown.split(['=', '≈', '≡']);
    let left = sides.next().unwrap_or_default();
    let is_rule = shown.chars().all(|c| matches!(c, '=' | '-' | '+' | '|' | ' '));
    !is_rule && is_side(left) && sides.any(is_side) && !plain_name(shown).is_empty() || is_row(shown)
}

/// True for a line of a matrix after a name: `row 1: -s1 (a2 c2 + a3 c23), -a3 c1 s23, 0`.
fn is_row(shown: &str) -> bool {
    let Some((name, entries)) = shown.split_once(':') else { return false };
    let is_name =
        name.len() < 30 && name.ends_with(|c: char| c.is_ascii_digit()) && !name.contains(['(', '"', ',']);
    let is_part = |c: char| c.is_alphanumeric() || " +-−*/^().,;_·".contains(c);
    let parts: Vec<&str> = entries.split([',', ';']).collect();
    // Words of prose have more letters, or no numbers.
    let words = entries.split(|c: char| !c.is_alphanumeric()).filter(|w| !w.is_empty());
    let is_short = |w: &str| w.chars().count() <= 4;
    let is_numbered =
        |w: &str| w.starts_with(char::is_alphabetic) && w.ends_with(|c: char| c.is_ascii_digit());
    is_name
        && parts.len() > 1
        && entries.chars().all(is_part)
        && words.clone().filter(|w| is_numbered(w)).count() > 1
        && words.clone().all(is_short)
}

/// True for a joint, a length or a rate, whose number is given.
fn is_given(walked: &Walked, name: &str) -> bool {
    let known = walked.names.iter().filter_map(|names| names.lookup(name));
    known.into_iter().any(|e| e.as_symbol().is_some())
}

/// What looks like `name = formula` in a line of words, each up to the comma or the end of the line behind it; numbers that are given
/// are none.
fn left_over(text: &str, line: &Range<usize>, is_given: &dyn Fn(&str) -> bool) -> Vec<Range<usize>> {
    let shown = text.get(line.clone()).unwrap_or_default();
    let mut found = vec![];
    for (at, _) in shown.match_indices('=') {
        let (before, behind) = (&shown[..at], &shown[at + 1..]);
        if before.ends_with(['<', '>', '!', ':', '=', '&']) || behind.starts_with(['=', '>', '&']) {
            continue;
        }
        let bare = before.trim_end_matches([' ', '`', '$', '*']);
        let is_part = |c: char| c.is_alphanumeric() || matches!(c, '_' | '\\' | '{' | '}' | '\'' | '^');
        let name = &bare[bare.trim_end_matches(is_part).len()..];
        let first = behind.trim_start_matches([' ', '`', '$', '*', '-', '−', '+', '±']).chars().next();
        let is_number = first.is_some_and(|c| c.is_ascii_digit());
        let is_value = first.is_some_and(|c| c.is_alphanumeric() || matches!(c, '(' | '[' | '\\' | '√'));
        if !name.contains(char::is_alphabetic) || !is_value || is_number && is_given(name) {
            continue;
        }
        let end = behind.find([',', ';']).unwrap_or(behind.len());
        let start = line.start + bare.len() - name.len();
        found.push(start..line.start + at + 1 + behind[..end].trim_end().len());
    }
    found
}

fn trimmed(text: &str, span: Range<usize>) -> Range<usize> {
    let shown = text.get(span.clone()).unwrap_or_default();
    let start = span.start + (shown.len() - shown.trim_start().len());
    start..start + shown.trim().len()
}
