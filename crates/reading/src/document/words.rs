//! What tells a formula from prose, by its words alone.

use super::cut;
use super::lexer::{Bracket, Gap, Kind, Token, lex};
use std::ops::Range;

/// Words that join or close statements: `x = a and y = b`, `x = a if …`.
pub(super) fn is_link(word: &str) -> bool {
    const LINKS: [&str; 44] = [
        "and",
        "or",
        "with",
        "where",
        "if",
        "for",
        "otherwise",
        "else",
        "so",
        "then",
        "thus",
        "hence",
        "since",
        "et",
        "ou",
        "où",
        "avec",
        "si",
        "sinon",
        "pour",
        "donc",
        "alors",
        "und",
        "oder",
        "mit",
        "wenn",
        "sonst",
        "wo",
        "also",
        "或",
        "和",
        "y",
        "con",
        "because",
        "com",
        "onde",
        "então",
        "donde",
        "entonces",
        "dove",
        "quindi",
        "met",
        "waarbij",
        "dus",
    ];
    let word = word.trim_matches(|c: char| !c.is_alphanumeric());
    // A lone letter may be a name.
    word.len() > 1 && LINKS.contains(&word)
}

fn is_conjunction(word: &str) -> bool {
    matches!(word, "and" | "et" | "und" | "with" | "avec" | "mit" | "where")
}

/// Whether a text behind a statement says when it holds: what follows is no statement of its own.
pub(super) fn is_condition(text: &str) -> bool {
    const CONDITIONS: [&str; 9] = ["if", "for", "when", "si", "pour", "wenn", "für", "otherwise", "sinon"];
    let first = text.split(|c: char| !c.is_alphanumeric()).find(|w| !w.is_empty());
    first.is_some_and(|w| CONDITIONS.contains(&w))
}

/// The functions, which take what follows them.
pub(super) fn is_function(word: &str) -> bool {
    const FUNCTIONS: [&str; 23] = [
        "sen", "tg", "arcsen", "arctg", "sin", "cos", "tan", "cot", "sec", "csc", "asin", "acos", "atan",
        "atan2", "arcsin", "arccos", "arctan", "arctan2", "sqrt", "exp", "abs", "sign", "mod",
    ];
    FUNCTIONS.contains(&word.trim_start_matches('\\').to_ascii_lowercase().as_str())
}

pub(super) fn is_greek(word: &str) -> bool {
    const GREEK: [&str; 26] = [
        "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa", "lambda",
        "mu", "nu", "xi", "omicron", "pi", "rho", "sigma", "tau", "upsilon", "phi", "chi", "psi", "omega",
        "varphi", "vartheta",
    ];
    GREEK.contains(&word.to_ascii_lowercase().as_str())
}

/// A unit of lengths, angles, times, forces, or a part of one: `m` and `s` of `m/s`.
pub(super) fn is_unit(word: &str) -> bool {
    const UNITS: [&str; 19] = [
        "m", "mm", "cm", "rad", "deg", "grad", "Grad", "degrees", "grados", "degrés", "graus", "gradi",
        "graden", "N", "kN", "kNm", "Nm", "s", "°",
    ];
    UNITS.contains(&word)
}

/// True for nothing but a unit: `m/s`, `N·m`, `\,\mathrm{mm}`.
pub(super) fn is_unit_alone(text: &str) -> bool {
    if text.len() > 60 {
        return false;
    }
    let looks = ["\\mathrm", "\\text", "\\rm", "\\circ", "\\,", "\\;", "\\:", "\\!"];
    let plain = looks
        .iter()
        .fold(text.to_string(), |t, look| t.replace(look, if *look == "\\circ" { "°" } else { " " }));
    let is_between = |c: char| c.is_whitespace() || "/·*^{}~$\\²".contains(c);
    let mut words = plain.split(is_between).filter(|w| !w.is_empty()).peekable();
    plain.len() < 40 && words.peek().is_some() && words.all(|w| is_unit(w) || matches!(w, "2" | "cdot"))
}

/// Short words that no formula has.
pub(super) fn is_filler(word: &str) -> bool {
    const FILLERS: [&str; 60] = [
        "is", "in", "of", "to", "if", "for", "the", "and", "with", "are", "at", "on", "we", "or", "as", "by",
        "be", "an", "so", "it", "si", "et", "de", "la", "le", "les", "des", "du", "est", "en", "un", "une",
        "pour", "und", "der", "die", "das", "ist", "von", "zu", "im", "el", "los", "es", "bei", "aus", "auf",
        "für", "gilt", "per", "con", "para", "por", "em", "il", "lo", "gli", "voor", "bij", "dla",
    ];
    FILLERS.contains(&word.to_lowercase().as_str())
}

/// Whether a word before a colon can name a formula: `t11`, `n_x`, `RHS`; not `Position`.
pub(super) fn is_label(word: &str) -> bool {
    let indexed = word.chars().any(|c| c.is_numeric() || c == '_');
    let short = word.chars().count() <= 3 && word.chars().all(|c| c < '\u{400}') && !is_plain(word);
    (indexed && word.chars().all(|c| c < '\u{2e80}')) || short
}

/// Letters only, and none of the names and functions that formulas are made of.
fn is_plain(word: &str) -> bool {
    word.chars().count() >= 2
        && word.chars().all(|c| c.is_alphabetic() || c == '\'')
        && word.chars().any(char::is_lowercase)
        && !word
            .chars()
            .any(|c| ('\u{370}'..='\u{3ff}').contains(&c) || ('ᴀ'..='ᶿ').contains(&c) || c >= '\u{2070}')
        && !is_function(word)
        && !is_greek(word)
}

/// A word of at least four small letters that is no function and no Greek letter.
pub(super) fn is_long_word(word: &str) -> bool {
    is_plain(word) && word.chars().count() >= 4 && word.chars().all(char::is_lowercase)
}

/// Whether `span`, outside of any formula's marks, reads as prose or as a program rather than as a formula.
pub(super) fn is_prose(text: &str, span: &Range<usize>) -> bool {
    let tokens = lex(text, span);
    let words: Vec<Option<&str>> =
        tokens.iter().map(|t| (t.kind == Kind::Word).then(|| cut(text, &t.span))).collect();
    let foreign = |c: char| {
        let script = ('\u{2e80}'..='\u{ffef}').contains(&c) || ('\u{590}'..='\u{dff}').contains(&c);
        script || ('à'..='ÿ').contains(&c) && c != '÷'
    };
    if words.iter().flatten().any(|w| w.chars().any(foreign)) {
        return true;
    }
    if tokens.iter().any(|t| t.kind == Kind::Mark && matches!(cut(text, &t.span), "\"" | "“" | "”" | "@"))
    {
        return true;
    }
    // `*Example.* w`: a sentence ends before the formula.
    let is_label = |k: usize| {
        let ends = tokens.get(k + 1).is_some_and(|t| t.kind == Kind::Operator && cut(text, &t.span) == ".");
        let goes_on = tokens.get(k + 2).is_some_and(|t| t.gap != Gap::None || cut(text, &t.span) == "*");
        ends && goes_on && words[k].is_some_and(|w| is_plain(w) && w.chars().count() >= 4)
    };
    if (0..tokens.len()).any(is_label) {
        return true;
    }
    words.windows(2).any(|pair| match pair {
        [Some(a), Some(b)] if is_plain(a) && is_plain(b) => {
            let long = |w: &str| w.chars().count() >= 4;
            long(a) || long(b) || is_filler(a) || is_filler(b)
        }
        // `x = a and y = b`
        [_, Some(b)] if is_conjunction(b) => false,
        [Some(a), _] if is_conjunction(a) => false,
        [Some(a), Some(b)] if is_plain(a) => a.chars().count() >= 4 || is_filler(a) || is_link(b),
        // `0.5 m wird`
        [Some("m" | "mm" | "cm" | "rad"), Some(b)] if is_plain(b) && b.chars().count() > 3 => true,
        [Some(a), Some(b)] if is_plain(b) => is_filler(b) && a.chars().all(char::is_alphanumeric),
        _ => false,
    })
}

/// Whether `span` can be the left side of a statement that stands alone on its line: a name or a product of names;
/// with `sums` also a sum.
pub(super) fn is_left_side(text: &str, span: &Range<usize>, sums: bool) -> bool {
    let tokens = lex(text, span);
    let (mut depth, mut named) = (0usize, false);
    for (i, token) in tokens.iter().enumerate() {
        match token.kind {
            Kind::Open(_) | Kind::Begin(_) => depth += 1,
            Kind::Close(_) | Kind::End => depth = depth.saturating_sub(1),
            Kind::Word | Kind::Command => named = true,
            _ if depth > 0 => {}
            Kind::Operator => {
                let sign = matches!(cut(text, &token.span), "+" | "-" | "−");
                let script = i > 0 && tokens.get(i - 1).is_some_and(|t| t.kind == Kind::Script);
                if sign && !sums && !script && i > 0 {
                    return false;
                }
            }
            Kind::Script => {}
            _ => return false,
        }
    }
    named && tokens.len() < 200 && !is_prose(text, span)
}

/// Whether the tokens are one name: a word or command with indices, such as `{}^{1}T_2`, `T_{46}`, `\mathbf{A}_1`.
pub(super) fn is_one_name(text: &str, span: &Range<usize>) -> bool {
    const FONTS: [&str; 9] = [
        "\\mathbf",
        "\\mathrm",
        "\\mathit",
        "\\mathsf",
        "\\bm",
        "\\boldsymbol",
        "\\text",
        "\\operatorname",
        "\\mathcal",
    ];
    let tokens = lex(text, span);
    let (mut script, mut depth, mut names) = (None, 0usize, 0);
    for token in &tokens {
        match token.kind {
            Kind::Open(Bracket::Brace) => depth += 1,
            Kind::Close(Bracket::Brace) => {
                depth = depth.saturating_sub(1);
                if script == Some(depth) {
                    script = None;
                }
                continue;
            }
            Kind::Script if script.is_none() => {
                script = Some(depth);
                continue;
            }
            Kind::Word | Kind::Command if script.is_none() => {
                names += usize::from(!FONTS.contains(&cut(text, &token.span)));
            }
            _ if script.is_some() => {}
            _ => return false,
        }
        // An index without braces is one token long.
        if script == Some(depth) {
            script = None;
        }
    }
    names == 1
}

/// `span` without blanks and braces and fonts, for comparing names.
pub(super) fn bare(text: &str, span: &Range<usize>) -> String {
    let mut out = String::new();
    for token in lex(text, span) {
        let word = cut(text, &token.span);
        match token.kind {
            Kind::Open(Bracket::Brace) | Kind::Close(Bracket::Brace) => {}
            Kind::Command if word.starts_with("\\math") || word == "\\bm" => {}
            Kind::Word if out.ends_with(|c: char| c.is_alphanumeric()) => {
                out.push(' ');
                out.push_str(word);
            }
            _ => out.push_str(word),
        }
    }
    out
}

/// How many more brackets and environments `tokens` open than they close.
pub(super) fn open_brackets(tokens: &[Token]) -> usize {
    let mut depth = 0usize;
    for token in tokens {
        match token.kind {
            Kind::Open(_) | Kind::Begin(_) => depth += 1,
            Kind::Close(_) | Kind::End => depth = depth.saturating_sub(1),
            _ => {}
        }
    }
    depth
}
