//! What a person reads in a terminal: headings, aligned tables, matrices with brackets.

pub use denavit_report::decimals;

use anstyle::{AnsiColor, Style};
use denavit::geometry::Transform;
use denavit_report::words::{Tongue, Wording};
use std::collections::BTreeSet;
use std::io::Write;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use unicode_width::UnicodeWidthStr;

/// Headings.
pub const HEADING: Style = Style::new().bold();
/// What stands back: zeros, rules, units.
pub const FAINT: Style = Style::new().dimmed();
/// Names of results.
pub const NAME: Style = AnsiColor::Cyan.on_default();

static IS_QUIET: AtomicBool = AtomicBool::new(false);

/// From here on notes and warnings are left away.
pub fn be_quiet() {
    IS_QUIET.store(true, Ordering::Relaxed);
}

/// What was said, the first of it.
static SAID: Mutex<BTreeSet<String>> = Mutex::new(BTreeSet::new());
/// So many texts are kept of what was said.
const MOST_SAID: usize = 1_000;

/// A note or a warning on standard error, unless it is to be quiet; of the first ones the same is said but once.
pub fn note(text: &str) {
    if !IS_QUIET.load(Ordering::Relaxed) && !text.is_empty() {
        if let Ok(mut said) = SAID.lock() {
            if said.contains(text) {
                return;
            }
            if said.len() < MOST_SAID {
                said.insert(text.into());
            }
        }
        // There is nobody to tell that nobody listens.
        let _ = writeln!(anstream::stderr(), "{}", text.trim_end());
    }
}

/// What rounding leaves of a length in these poses where it is 0.
pub fn noise<'a>(poses: impl IntoIterator<Item = &'a Transform<f64>>) -> f64 {
    let all = poses.into_iter().flat_map(|x| x.translation.0);
    1e-14 * all.fold(1.0, |largest: f64, x| largest.max(x.abs()))
}

/// The words of a terminal.
pub fn words() -> &'static dyn Wording {
    Tongue::English.words()
}

/// The text in a style.
pub fn styled(text: &str, style: Style) -> String {
    format!("{style}{text}{style:#}")
}

/// Which side of a column the text keeps to.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Align {
    /// Text and formulas.
    Left,
    /// Numbers.
    Right,
}

/// Rows of cells in aligned columns with a header; every line ends with a newline.
pub fn table(header: &[&str], align: &[Align], rows: &[Vec<String>]) -> String {
    let widths: Vec<usize> = (0..header.len())
        .map(|c| rows.iter().map(|r| r[c].width()).chain([header[c].width()]).max().unwrap_or(0))
        .collect();
    let line = |cells: &[String]| {
        let cells: Vec<String> =
            cells.iter().enumerate().map(|(c, text)| pad(text, widths[c], align[c])).collect();
        cells.join("  ")
    };
    let head: Vec<String> = header.iter().map(|h| (*h).to_string()).collect();
    let mut out = format!("  {}\n", styled(line(&head).trim_end(), FAINT));
    for row in rows {
        out += &format!("  {}\n", line(row).trim_end());
    }
    out
}

/// A matrix with brackets, `label` in front of its middle row; every line ends with a newline.
pub fn matrix(label: &str, rows: &[Vec<String>], align: Align) -> String {
    let columns = rows.first().map_or(0, Vec::len);
    let widths: Vec<usize> =
        (0..columns).map(|c| rows.iter().map(|r| r[c].width()).max().unwrap_or(0)).collect();
    let middle = (rows.len().saturating_sub(1)) / 2;
    let mut out = String::new();
    for (r, row) in rows.iter().enumerate() {
        let (open, close) = match (r, rows.len()) {
            (_, 1) => ('[', ']'),
            (0, _) => ('⎡', '⎤'),
            (r, n) if r + 1 == n => ('⎣', '⎦'),
            _ => ('⎢', '⎥'),
        };
        let front = if r == middle { label.to_string() } else { " ".repeat(label.width()) };
        let cells: Vec<String> = row
            .iter()
            .enumerate()
            .map(|(c, text)| {
                let padded = pad(text, widths[c], align);
                if text == "0" { padded.replacen('0', &styled("0", FAINT), 1) } else { padded }
            })
            .collect();
        out += &format!("  {front}{open} {} {close}\n", cells.join("  "));
    }
    out
}

/// The width of a matrix printed without label.
pub fn matrix_width(rows: &[Vec<String>]) -> usize {
    let columns = rows.first().map_or(0, Vec::len);
    (0..columns).map(|c| 2 + rows.iter().map(|r| r[c].width()).max().unwrap_or(0)).sum::<usize>() + 6
}

fn pad(text: &str, width: usize, align: Align) -> String {
    let space = " ".repeat(width.saturating_sub(text.width()));
    match align {
        Align::Left => format!("{text}{space}"),
        Align::Right => format!("{space}{text}"),
    }
}

/// Digits as superscripts or subscripts; other characters stay.
pub fn raised(text: &str) -> String {
    text.chars().map(|c| shift(c, "⁰¹²³⁴⁵⁶⁷⁸⁹")).collect()
}

/// Digits as subscripts; other characters stay.
pub fn lowered(text: &str) -> String {
    text.chars().map(|c| shift(c, "₀₁₂₃₄₅₆₇₈₉")).collect()
}

fn shift(c: char, digits: &str) -> char {
    c.to_digit(10).and_then(|d| digits.chars().nth(d as usize)).unwrap_or(c)
}

/// A number of a pose for reading: rounding noise below `noise` is 0, what is not finite a dash.
pub fn number(x: f64, noise: f64) -> String {
    if !x.is_finite() {
        return "—".into();
    }
    if x.abs() <= noise {
        return "0".into();
    }
    if x == x.round() && x.abs() < 1e6 {
        return format!("{x}").replace('-', "−");
    }
    if (1e-4..1e6).contains(&x.abs()) {
        return decimals(x, 6);
    }
    let text = format!("{x:.6e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    format!("{}e{exponent}", mantissa.trim_end_matches('0').trim_end_matches('.')).replace('-', "−")
}
