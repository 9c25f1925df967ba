//! What words and numbers of a cell mean: names, units, and multiples of π/12 behind decimals.

use super::{Severity, Style, Value, special};
use crate::description::units::{Quantity, Unit, unit_at, unit_named};
use denavit_symbolic::parse::{Context, Measures, ParseError, Term, greek_name, parse_measured};
use denavit_symbolic::{Expr, Rational};
use std::ops::Range;

/// The largest power, and how many powers a cell may hold: numbers stay short.
const MAX_POWER: u32 = 9;
const MAX_POWERS: usize = 8;

pub(super) type Finding = (Severity, Range<usize>, String);

struct Measure<'a> {
    text: &'a str,
    style: &'a Style,
    /// What the first unit measures.
    measures: Option<Quantity>,
    symbols: Vec<(String, Range<usize>)>,
    bare: Vec<(f64, Range<usize>)>,
    findings: Vec<Finding>,
    powers: usize,
}

/// Reads a cell; spans are bytes of `text`.
pub(super) fn read(text: &str, style: &Style) -> Result<(Value, Vec<Finding>), ParseError> {
    if text.trim().is_empty() {
        return Err(ParseError::new(0..0, "an empty cell").hint("write 0 where there is nothing"));
    }
    let mended = if style.document { mended(text, style.decimal_comma) } else { text.to_string() };
    let (symbols, bare, findings) = (vec![], vec![], vec![]);
    let mut m = Measure { text, style, measures: None, symbols, bare, findings, powers: 0 };
    let expr = parse_measured(&mended, &mut m).map_err(|errors| first(errors, text))?;
    let is_finite = expr.eval(|_| Some(1.0)).is_ok_and(f64::is_finite);
    if !is_finite && m.symbols.is_empty() {
        return Err(ParseError::new(0..text.len(), "the value is not a finite number"));
    }
    Ok((Value { expr, symbols: m.symbols, bare: m.bare }, m.findings))
}

/// The first error; one behind the end is shown at the last character.
fn first(errors: Vec<ParseError>, text: &str) -> ParseError {
    let mut e = errors.into_iter().next().unwrap_or_else(|| ParseError::new(0..0, "no formula"));
    if e.span.start >= text.len() {
        let end = text.trim_end_matches(|c: char| c == '$' || c.is_whitespace()).len();
        e.span = text[..end].char_indices().next_back().map_or(0..0, |(last, _)| last..end);
    }
    e
}

/// The text with its slips of scanning repaired (`\t` taken for a tab, `\b` for a control character) and points in
/// its decimals, every byte at its place.
pub(super) fn mended(text: &str, decimal_comma: bool) -> String {
    let mut text = text.replace('\u{8}', " ");
    if !text.contains("boldsymbol") {
        text = text.replace("oldsymbol", "\\mathsf  ");
    }
    for space in ['\t', ' '] {
        text = text.replace(&format!("{space}extsf"), "\\text ").replace(&format!("{space}ext{{"), " \\bm{");
    }
    if !decimal_comma {
        return text;
    }
    let bytes = text.as_bytes();
    let is_digit = |i: usize| bytes.get(i).is_some_and(u8::is_ascii_digit);
    let is_point = |i: usize| i > 0 && is_digit(i - 1) && is_digit(i + 1);
    text.char_indices().map(|(i, c)| if c == ',' && is_point(i) { '.' } else { c }).collect()
}

/// The plain name of a Greek letter; an angle is θ also where it is written Θ.
pub(in crate::description) fn greek(c: char) -> Option<&'static str> {
    match c {
        'Θ' | 'ϑ' => Some("theta"),
        'ϕ' => Some("phi"),
        'ς' => Some("sigma"),
        '⍺' => Some("alpha"),
        c => greek_name(c),
    }
}

/// A word as a name: Greek letters spelled out, in a document without the marks of subscripts.
pub(super) fn plain(word: &str, document: bool) -> String {
    let mut name = String::new();
    for c in word.chars().filter(|&c| !(document && c == '_')) {
        match greek(c) {
            Some(greek) => name.push_str(greek),
            None => name.push(c),
        }
    }
    match name.strip_prefix("heta").filter(|i| document && i.chars().all(|c| c.is_ascii_digit())) {
        Some(index) => format!("theta{index}"), // the scan took `\t` for a tab
        None => name,
    }
}

impl Measure<'_> {
    /// What is measured here.
    fn quantity(&self, context: Context) -> Quantity {
        match context {
            Context::Whole => self.style.quantity,
            Context::Angle => Quantity::Angle,
            Context::Plain => Quantity::Number,
        }
    }

    /// A number of radians: the multiple of π/12 whose nearest double it is, or itself.
    fn exact_angle(&mut self, radians: Rational, span: &Range<usize>, is_warned: bool) -> Expr {
        let shown = &self.text[span.clone()];
        match special::recognise(&radians, digits(shown)) {
            special::Angle::Exactly(multiple) => {
                let name = special::name(&multiple);
                self.findings.push((Severity::Note, span.clone(), format!("{shown} is read as {name}")));
                Expr::from(multiple) * Expr::pi()
            }
            special::Angle::Nearly(multiple, off) if is_warned => {
                let name = special::name(&multiple);
                let message = format!("{shown} is nearly {name} (off by {off:.1e} rad)");
                self.findings.push((Severity::Warning, span.clone(), message));
                radians.into()
            }
            special::Angle::Nearly(..) | special::Angle::Plain => radians.into(),
        }
    }
}

/// The significant digits of a single decimal.
fn digits(text: &str) -> usize {
    let text = text.trim_matches(['(', ')', '-', '−', ' ']);
    let mantissa = text.split(['e', 'E']).next().unwrap_or(text);
    let is_number = mantissa.chars().all(|c| c.is_ascii_digit() || matches!(c, '.' | ','));
    let digits = mantissa.chars().filter(char::is_ascii_digit).skip_while(|&c| c == '0');
    if is_number { digits.count() } else { 0 }
}

impl Measures for Measure<'_> {
    fn word(&mut self, word: &str, span: Range<usize>, context: Context) -> Result<(Expr, bool), ParseError> {
        let name = plain(word, self.style.document);
        // As programs spell it.
        let name = if matches!(word, "PI" | "M_PI") { "pi".to_string() } else { name };
        match name.as_str() {
            "pi" => return Ok((Expr::pi(), self.quantity(context) == Quantity::Angle)),
            "inf" | "nan" | "NaN" | "infinity" | "Inf" | "Infinity" => {
                return Err(ParseError::new(span, "the value is not a finite number"));
            }
            _ => {}
        }
        let shown = &self.text[span.clone()];
        if shown.ends_with(')') {
            self.findings.push((Severity::Note, span.clone(), format!("{shown} is named {name}")));
        }
        let symbol = Expr::symbol(&name);
        self.symbols.push((name, span));
        Ok((symbol, false))
    }

    fn unit_at(&self, text: &str) -> Option<usize> {
        unit_at(text).map(|u| u.length)
    }

    fn measured(
        &mut self,
        term: &Term,
        (name, span): (&str, Range<usize>),
        context: Context,
    ) -> Result<Expr, ParseError> {
        let Some(unit) = unit_named(name) else {
            return Err(ParseError::new(span, format!("`{name}` is no unit")));
        };
        if term.has_name {
            let e = ParseError::new(span, format!("the unit `{name}` behind a name"));
            return Err(e.hint("a name has its unit in its value; give numbers a unit"));
        }
        let is_radian = unit.factor().is_one();
        if term.has_unit && !(is_radian && self.measures.is_none()) {
            let shown = &self.text[term.span.clone()];
            let message = format!("`{shown}` has a unit already; `{name}` would be a second one");
            return Err(ParseError::new(span, message));
        }
        let wanted = match self.quantity(context) {
            Quantity::Open => self.measures,
            quantity => Some(quantity),
        };
        if let Some(wanted) = wanted.filter(|q| *q != unit.quantity) {
            let message = format!("`{name}` measures {}; this is {}", unit.quantity.name(), wanted.name());
            return Err(ParseError::new(span, message));
        }
        if context == Context::Whole {
            self.measures = Some(unit.quantity);
        }
        match term.expr.as_number() {
            Some(number) if unit.quantity == Quantity::Angle && is_radian => {
                let is_warned = self.style.nearly && context == Context::Whole;
                Ok(self.exact_angle(number, &term.span, is_warned))
            }
            _ => Ok(term.expr * unit.factor()),
        }
    }

    fn bare(&mut self, term: &Term, context: Context) -> Expr {
        let Some(number) = term.expr.as_number().filter(|r| !r.is_zero()) else { return term.expr };
        let is_whole = context == Context::Whole;
        if is_whole {
            self.bare.push((number.to_f64(), term.span.clone()));
        }
        match self.style.bare.filter(|_| is_whole) {
            Some(unit) => term.expr * Unit::factor(unit),
            None if self.quantity(context) == Quantity::Angle => {
                self.exact_angle(number, &term.span, self.style.nearly && is_whole)
            }
            None => term.expr,
        }
    }

    fn power(&mut self, n: i32) -> Result<(), String> {
        self.powers += 1;
        match n.unsigned_abs() <= MAX_POWER && self.powers <= MAX_POWERS {
            true => Ok(()),
            false => Err(format!("a power is a whole number up to {MAX_POWER}, and a cell has few")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::mended;
    use crate::random::Random;

    /// Whatever is repaired, every byte stays at its place: spans of the one text are spans of the other.
    #[test]
    fn repaired_texts_keep_their_places() {
        const PIECES: [&str; 14] = [
            "\t",
            " ",
            "ext{",
            "extsf",
            "oldsymbol",
            "\u{8}",
            "é",
            "θ",
            "1,5",
            ",",
            "}",
            "2",
            "boldsymbol",
            "\\text{",
        ];
        let mut random = Random(1);
        for _ in 0..20_000 {
            let count = 1 + (random.unit() * 6.0) as usize;
            let text: String =
                (0..count).map(|_| PIECES[(random.unit() * PIECES.len() as f64) as usize]).collect();
            let repaired = mended(&text, random.unit() < 0.5);
            let kept = |c: char| ['é', 'θ', '}', '2'].contains(&c);
            let places = |text: &str| text.char_indices().filter(|x| kept(x.1)).collect::<Vec<_>>();
            assert_eq!(
                (repaired.len(), places(&repaired)),
                (text.len(), places(&text)),
                "{text:?}: {repaired:?}"
            );
        }
    }
}
