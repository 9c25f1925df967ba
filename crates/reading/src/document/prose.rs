//! Formulas that stand in a sentence without marks: `hence q2 = ±acos(D), and x = 0.43 m`.
//!
//! From each relation the formula is followed to both sides as far as its words are those of formulas.

use super::lexer::{Bracket, Kind, Token, lex};
use super::lines::trimmed;
use super::{cut, words};
use std::ops::Range;

/// Sentences with more tokens are not looked at.
const MOST_TOKENS: usize = 600;
/// The most formulas of a line.
const MOST_FORMULAS: usize = 12;

/// The formulas of a line, in its order.
pub(super) fn formulas(text: &str, line: &Range<usize>) -> Vec<Range<usize>> {
    let tokens = lex(text, line);
    if tokens.len() > MOST_TOKENS {
        return vec![];
    }
    let reader = Reader { text, tokens: &tokens };
    let mut found: Vec<Range<usize>> = vec![];
    let mut at = 0;
    while at < tokens.len() && found.len() < MOST_FORMULAS {
        if !matches!(tokens[at].kind, Kind::Relation(_)) {
            at += 1;
            continue;
        }
        let floor =
            found.last().map_or(0, |f| tokens.iter().position(|t| t.span.start >= f.end).unwrap_or(at));
        let (first, last) = (reader.left(at, floor), reader.right(at));
        match (first, last) {
            (Some(first), Some(last)) => {
                let span = trimmed(text, &(tokens[first].span.start..tokens[last].span.end));
                found.push(span);
                at = last + 1;
            }
            _ => at += 1,
        }
    }
    found
}

/// Values in brackets that the words of a line tell of something: `the tip is at (1.5, 1.2)`, `… of R03 is (s2, 0, c2)`.
pub(super) fn tuples(text: &str, line: &Range<usize>) -> Vec<Range<usize>> {
    const BEFORE: [&str; 28] = [
        "target", "goal", "ziel", "punkt", "punto", "ponto", "at", "is", "are", "to", "becomes", "reads",
        "bei", "ist", "lautet", "sind", "est", "en", "vaut", "sont", "es", "son", "vale", "está", "è",
        "sono", "in", "point",
    ];
    let shown = cut(text, line);
    if shown.len() > 1_000 {
        return vec![];
    }
    let mut found = vec![];
    for (at, _) in shown.match_indices('(').take(MOST_FORMULAS) {
        let before = shown[..at].trim_end_matches([' ', '$']);
        let word = before.rsplit([' ', '\t']).next().unwrap_or_default();
        let gap = shown[..at].ends_with([' ', '$']);
        if !gap || !BEFORE.contains(&word.to_lowercase().as_str()) {
            continue;
        }
        let mut depth = 0_usize;
        let close = shown[at..].char_indices().find(|(_, c)| {
            depth = depth + usize::from(*c == '(') - usize::from(*c == ')');
            depth == 0
        });
        let Some((length, _)) = close else { continue };
        let inner = &shown[at + 1..at + length];
        if inner.contains(',') && !inner.contains('=') && inner.len() < 300 {
            found.push(line.start + at..line.start + at + length + 1);
        }
    }
    found
}

struct Reader<'a> {
    text: &'a str,
    tokens: &'a [Token],
}

impl Reader<'_> {
    fn shown(&self, at: usize) -> &str {
        self.tokens.get(at).map_or("", |t| cut(self.text, &t.span))
    }

    fn kind(&self, at: usize) -> Option<Kind> {
        self.tokens.get(at).map(|t| t.kind)
    }

    /// True for a word of a sentence.
    fn is_prose(&self, at: usize) -> bool {
        match self.kind(at) {
            Some(Kind::Prose) => true,
            Some(Kind::Word) => {
                let word = self.shown(at);
                let bare = word.trim_matches(['*', '\'', '’']);
                if word == "I"
                    && self.kind(at + 1) == Some(Kind::Word)
                    && is_sentence_word(self.shown(at + 1))
                {
                    return true;
                }
                let is_unit = at > 0 && is_number(self.shown(at - 1)) && words::is_unit(bare);
                !is_unit && (words::is_link(bare) || is_sentence_word(bare))
            }
            Some(Kind::Command) => matches!(self.shown(at), "\\text" | "\\textbf" | "\\emph" | "\\textit"),
            _ => false,
        }
    }

    /// The first token of the left side of the relation at `at`.
    fn left(&self, at: usize, floor: usize) -> Option<usize> {
        let mut first = self.operand_before(at, floor)?;
        loop {
            let Some(before) = first.checked_sub(1).filter(|b| *b >= floor) else { return Some(first) };
            match self.kind(before) {
                Some(Kind::Operator) if self.shown(before) != "." => match self.operand_before(before, floor)
                {
                    Some(next) => first = next,
                    None => {
                        let is_sign = matches!(self.shown(before), "-" | "−" | "+");
                        return Some(if is_sign { before } else { first });
                    }
                },
                // A product without a sign: `e_1 sθ_1`, `cos q2`.
                Some(Kind::Word | Kind::Command) if !self.is_prose(before) && self.is_factor(before) => {
                    match self.operand_before(first, floor) {
                        Some(next) if next < first => first = next,
                        _ => return Some(first),
                    }
                }
                _ => return Some(first),
            }
        }
    }

    /// True for a word that multiplies what follows, or takes it as its argument.
    fn is_factor(&self, at: usize) -> bool {
        let word = self.shown(at);
        // `X S2 + Y C2 = Z`; `A` and `I` are words.
        let mut letters = word.chars();
        let is_letter = letters.next().is_some_and(|c| c.is_ascii_uppercase() && !matches!(c, 'A' | 'I'))
            && letters.next().is_none();
        words::is_function(word)
            || is_letter
            || matches!(word, "det" | "\\det")
            || word.contains(|c: char| c.is_ascii_digit() || c == '_')
    }

    /// The first token of the operand that ends before `at`.
    fn operand_before(&self, at: usize, floor: usize) -> Option<usize> {
        let mut k = at.checked_sub(1).filter(|k| *k >= floor)?;
        loop {
            match self.kind(k)? {
                Kind::Close(bracket) => {
                    k = self.opening(k, bracket, floor)?;
                    // What the bracket belongs to: a function, an index.
                    let attached = self.tokens[k].gap == super::lexer::Gap::None;
                    match k.checked_sub(1).filter(|b| *b >= floor && attached).and_then(|b| self.kind(b)) {
                        Some(Kind::Script | Kind::Word | Kind::Command | Kind::Close(_))
                            if !self.is_prose(k - 1) =>
                        {
                            k -= 1;
                        }
                        Some(Kind::Mark) if self.shown(k - 1) == "√" => return Some(k - 1),
                        _ => return Some(k),
                    }
                }
                Kind::Word if self.is_power(k) => k = k.checked_sub(1).filter(|b| *b >= floor)?,
                Kind::Word | Kind::Command if !self.is_prose(k) => {
                    match k.checked_sub(1).filter(|b| *b >= floor).and_then(|b| self.kind(b)) {
                        Some(Kind::Script) => k = k.checked_sub(2).filter(|b| *b >= floor)?,
                        _ => return Some(k),
                    }
                }
                Kind::Script => k = k.checked_sub(1).filter(|b| *b >= floor)?,
                _ => return None,
            }
        }
    }

    /// True for the `⁻¹` of `A(q)⁻¹`.
    fn is_power(&self, at: usize) -> bool {
        let is_raised = |c: char| matches!(c, '⁺' | '⁻' | '¹' | '²' | '³' | '⁰' | '⁴'..='⁹' | 'ᵀ');
        self.tokens[at].gap == super::lexer::Gap::None && self.shown(at).chars().all(is_raised)
    }

    /// The token that opens what `at` closes.
    fn opening(&self, at: usize, bracket: Bracket, floor: usize) -> Option<usize> {
        self.partner((floor..=at).rev(), bracket)
    }

    /// The last token of what follows the relation at `at`, further relations of a chain included.
    fn right(&self, at: usize) -> Option<usize> {
        let mut depth = 0_usize;
        let mut last = None;
        let mut k = at + 1;
        while k < self.tokens.len() {
            let kind = self.tokens[k].kind;
            match kind {
                Kind::Open(bracket) => {
                    // `(two solutions)` is said of the formula.
                    let close = self.closing(k, bracket);
                    let is_remark = depth == 0
                        && last.is_some()
                        && close.is_none_or(|c| {
                            (k + 1..c).any(|i| self.is_prose(i))
                                || self.is_condition(k, c)
                                || self.is_area(k, c)
                        });
                    if is_remark {
                        return last;
                    }
                    depth += 1;
                }
                Kind::Close(_) => {
                    if depth == 0 {
                        return last;
                    }
                    depth -= 1;
                }
                _ if depth > 0 => {}
                Kind::Mark if self.shown(k) == "√" => {
                    k += 1;
                    continue;
                }
                Kind::Comma
                | Kind::Semicolon
                | Kind::Colon
                | Kind::Other
                | Kind::Arrow
                | Kind::Prose
                | Kind::Mark
                | Kind::Row => {
                    return last;
                }
                Kind::Relation(_) if last.is_none() => return None,
                Kind::Operator if self.shown(k) == "." => {
                    let is_end = self.tokens.get(k + 1).is_none_or(|t| t.gap != super::lexer::Gap::None);
                    if is_end {
                        return last;
                    }
                }
                _ => {}
            }
            if depth == 0 && (self.is_prose(k) || last.is_some() && self.joins(k)) {
                return last;
            }
            if depth > 0 && kind == Kind::Word && self.is_prose(k) {
                return None;
            }
            if !matches!(kind, Kind::Operator | Kind::Relation(_) | Kind::Open(_) | Kind::Quad | Kind::Amp)
                && depth == 0
            {
                last = Some(k);
            }
            k += 1;
        }
        last
    }

    fn closing(&self, at: usize, bracket: Bracket) -> Option<usize> {
        self.partner(at..self.tokens.len(), bracket)
    }

    /// The first token of a walk at which the bracket that it begins with is balanced.
    fn partner(&self, walk: impl Iterator<Item = usize>, bracket: Bracket) -> Option<usize> {
        let mut depth = 0_isize;
        for k in walk {
            match self.kind(k)? {
                Kind::Open(b) if b == bracket => depth += 1,
                Kind::Close(b) if b == bracket => depth -= 1,
                _ => continue,
            }
            if depth == 0 {
                return Some(k);
            }
        }
        None
    }

    /// True for brackets around an inequality.
    fn is_condition(&self, open: usize, close: usize) -> bool {
        (open..close).any(|k| self.kind(k) == Some(Kind::Other))
    }

    /// True for brackets around the unit of an area, `(mm²)`, which a determinant has.
    fn is_area(&self, open: usize, close: usize) -> bool {
        let inner = match (self.tokens.get(open), self.tokens.get(close)) {
            (Some(a), Some(b)) => cut(self.text, &(a.span.end..b.span.start)),
            _ => "",
        };
        inner.contains(['²', '^']) && words::is_unit_alone(inner)
    }

    /// True for a letter that joins two formulas in some language: `k1 = a y k2 = b`.
    fn joins(&self, at: usize) -> bool {
        matches!(self.shown(at), "y" | "e" | "o" | "u" | "i" | "и")
            && matches!(self.kind(at + 1), Some(Kind::Word | Kind::Command))
            && matches!(self.kind(at + 2), Some(Kind::Relation(_)))
    }
}

fn is_number(word: &str) -> bool {
    word.starts_with(|c: char| c.is_ascii_digit())
}

/// True for a word that no formula has: two letters or more, of which one is small, and no name.
fn is_sentence_word(word: &str) -> bool {
    let letters = word.chars().filter(|c| c.is_alphabetic()).count();
    if letters == 1 && word.chars().any(|c| ('à'..='ÿ').contains(&c)) {
        return true;
    }
    let is_plain = word.chars().all(|c| c.is_alphabetic() || c == '-' || c == '\'') && letters >= 2;
    let is_greek = |c: char| ('\u{370}'..='\u{3ff}').contains(&c);
    if !is_plain || words::is_function(word) || word.chars().any(is_greek) {
        return false;
    }
    if matches!(word, "det" | "pi" | "Pi" | "sen" | "tg" | "arctg" | "arcsen" | "Atan2" | "ATAN2") {
        return false;
    }
    let is_small = word.chars().any(char::is_lowercase);
    let is_name = letters <= 2 && !words::is_filler(word) && word.is_ascii();
    is_small && !is_name && !is_spelled_greek(word) && !is_rate(word)
}

fn is_spelled_greek(word: &str) -> bool {
    words::is_greek(word)
}

/// `xdot`, `dtheta`
fn is_rate(word: &str) -> bool {
    word.len() <= 6 && (word.ends_with("dot") || word.starts_with("dot"))
}

#[cfg(test)]
mod tests {
    use super::formulas;

    #[test]
    fn formulas_among_words() {
        for (line, expected) in [
            ("also x = 0.433 m und y = 0.550 m.", vec!["x = 0.433 m", "y = 0.550 m"]),
            ("Hence q2 = ±acos(D) (two solutions)", vec!["q2 = ±acos(D)"]),
            ("θ1 = β − γ if θ2 > 0 (elbow down),", vec!["θ1 = β − γ"]),
            ("and det J = l1*l2*sin(q2), so it is singular", vec!["det J = l1*l2*sin(q2)"]),
            ("With β = atan2(Y, X) and the inner angle γ", vec!["β = atan2(Y, X)"]),
            (
                "sale de la orientación, nx = cos(θ1+θ2−θ4), ny = sen(θ1):",
                vec!["nx = cos(θ1+θ2−θ4)", "ny = sen(θ1)"],
            ),
            ("so that cos(q2) = (x² + y² - 0.34)/0.3, das gibt", vec!["cos(q2) = (x² + y² - 0.34)/0.3"]),
            ("the tip is at q = (30°, 60°, 0.2 m).", vec!["q = (30°, 60°, 0.2 m)"]),
            ("A1(q1)⁻¹·U = A2·A3, third row", vec!["A1(q1)⁻¹·U = A2·A3"]),
            ("its distance is r = √(x² + y²) = 0.4, and", vec!["r = √(x² + y²) = 0.4"]),
            ("as det J = 11400 sin(t2) (mm²) goes to zero", vec!["det J = 11400 sin(t2)"]),
            ("there is nothing here", vec![]),
        ] {
            let found: Vec<&str> = formulas(line, &(0..line.len())).into_iter().map(|s| &line[s]).collect();
            assert_eq!(found, expected, "{line}");
        }
    }
}
