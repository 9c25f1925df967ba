//! What fits a page, the same in every format: lines of formulas, matrices by names, what stands side by side.

use crate::document::{Block, Factor, Laid, Line, Math, Proof, aligned, laid, math, matrix_width, plain};
use crate::document::{Document, Part, Table};
use crate::words::Wording;
use denavit_symbolic::Expr;
use denavit_symbolic::print::{Style, width};
use denavit_symbolic::vocabulary::Vocabulary;
use std::borrow::Cow;

/// What a formula on a line of its own may take of a page, em.
const ROOM: f64 = 40.0;
/// Formulas in running text are cut into parts of about this width, em, between which a line may end.
const INLINE: f64 = 14.0;
/// Entries narrower than this stand in a matrix whatever else does, em.
const NARROW: f64 = 3.0;

/// More is not printed, em: about a page and a half.
const MOST: f64 = 2_400.0;
/// What fits a telephone, em.
const PHONE: f64 = 15.0;
/// Tables with more columns are set smaller.
pub const WIDE: usize = 8;

/// Columns with longer words are broken into lines, letters.
const LONG: usize = 26;

/// For each column of a table the share of the page that its lines may fill, where they are to be broken.
pub fn shares(table: &Table, names: &Vocabulary) -> Vec<Option<f64>> {
    let letters = |line: &Line| plain(line, names).chars().count();
    let longest = |k: usize| {
        let cells = table.rows.iter().filter_map(|r| r.get(k)).chain(table.head.get(k));
        cells.map(letters).max().unwrap_or(0)
    };
    let all: Vec<usize> = (0..table.head.len()).map(longest).collect();
    let long: usize = all.iter().filter(|n| **n > LONG).sum();
    // A letter of a short column, and the space between two.
    let short: f64 = all.iter().filter(|n| **n <= LONG).map(|n| 0.0115 * *n as f64).sum();
    let room = (0.97 - short - 0.022 * all.len() as f64).max(0.3);
    all.iter().map(|&n| (n > LONG).then(|| room * n as f64 / long as f64)).collect()
}

/// A formula on lines of its own.
pub fn display(m: &Math, names: &Vocabulary, style: Style) -> Laid {
    laid(m, names, style, ROOM)
}

/// One of several equations below each other: the left side apart.
pub fn equation(m: &Math, names: &Vocabulary, style: Style) -> Laid {
    aligned(m, names, style, ROOM)
}

/// How wide a formula is in one line, em.
fn extent(m: &Math, names: &Vocabulary) -> f64 {
    match m {
        Math::Matrix(_, rows) => matrix_width(rows, names) + 4.0,
        other => width(&math(other, names, Style::Latex)) + 1.0,
    }
}

/// True for a formula that fills more than a page.
pub fn too_long(m: &Math, names: &Vocabulary) -> bool {
    match m {
        Math::Matrix(_, rows) => {
            let all = rows.iter().flatten();
            all.map(|&e| matrix_width(&[vec![e]], names)).sum::<f64>() > MOST
        }
        other => extent(other, names) > MOST,
    }
}

/// True for a formula that may not fit a narrow screen.
pub fn is_wide(m: &Math, names: &Vocabulary) -> bool {
    extent(m, names) > PHONE
}

/// Formulas in rows that fit the page.
pub fn beside<'a>(all: &'a [Math], names: &Vocabulary) -> Vec<Vec<&'a Math>> {
    let mut rows: Vec<Vec<&Math>> = vec![];
    let mut x = f64::INFINITY;
    for m in all {
        let own = extent(m, names) + 2.0;
        if x + own > ROOM {
            rows.push(vec![]);
            x = 0.0;
        }
        x += own;
        if let Some(row) = rows.last_mut() {
            row.push(m);
        }
    }
    rows
}

/// A formula in running text, in parts.
pub fn inline(m: &Math, names: &Vocabulary, style: Style) -> Vec<String> {
    let laid = laid(m, names, style, INLINE);
    let mut parts: Vec<String> = laid.lines.into_iter().map(|l| l.text).collect();
    if let Some(first) = parts.first_mut() {
        first.insert_str(0, &laid.left);
    }
    parts
}

/// The mark behind a formula: those of proved, of checked at samples, and what is made of the word for not true.
pub fn mark(
    proof: Option<Proof>,
    words: &dyn Wording,
    [proved, sampled]: [&str; 2],
    wrong: impl Fn(&str) -> String,
) -> String {
    match proof {
        None => String::new(),
        Some(Proof::Proved) => proved.into(),
        Some(Proof::Sampled) => sampled.into(),
        Some(Proof::Wrong) => wrong(words.mark(Proof::Wrong)),
    }
}

/// A matrix that is too wide for the page as one of names, with the names and what they stand for.
pub struct Named {
    /// The matrix of names.
    pub matrix: Block,
    /// What they stand for.
    pub entries: Vec<Math>,
    /// The names of the formulas and these.
    pub names: Vocabulary,
}

/// Names for the entries of a matrix that does not fit the page; nothing if it fits, or is none.
pub fn named(block: &Block, names: &Vocabulary) -> Option<Named> {
    let Block::Formula { math: Math::Matrix(name, rows), number, proof } = block else { return None };
    if matrix_width(rows, names) + 6.0 <= ROOM {
        return None;
    }
    let wanted = match name {
        Factor::Named { letter, .. } => letter.to_lowercase(),
        _ => "t".into(),
    };
    let wide = |e: Expr| e.as_symbol().is_none() && matrix_width(&[vec![e]], names) > NARROW + 1.0;
    let places: Vec<(usize, usize)> = (0..rows.len())
        .flat_map(|r| (0..rows[r].len()).map(move |c| (r, c)))
        .filter(|&(r, c)| wide(rows[r][c]))
        .collect();
    if places.is_empty() {
        return None;
    }
    let is_column = rows.iter().all(|row| row.len() == 1);
    let called = |letter: &str, (r, c): (usize, usize)| match r.max(c) < 9 {
        _ if is_column => format!("{letter}{}", r + 1),
        true => format!("{letter}{}{}", r + 1, c + 1),
        false => format!("{letter}{}_{}", r + 1, c + 1),
    };
    // The algorithm of a Jacobian calls its entries alike: j11.
    let is_own = |letter: &str| letter == "j" && letter == wanted;
    let is_free =
        |letter: &&str| is_own(letter) || places.iter().all(|&p| names.lookup(&called(letter, p)).is_none());
    let letters = [wanted.as_str(), "t", "u", "w", "m", "k"];
    let letter = *letters.iter().find(|l| is_free(l))?;
    let mut with = Cow::Borrowed(names);
    let mut short = rows.clone();
    let mut entries = vec![];
    for &(r, c) in &places {
        let symbol = called(letter, (r, c));
        entries.push(Math::equation(Expr::symbol(&symbol), rows[r][c]));
        short[r][c] = Expr::symbol(&symbol);
        with = Cow::Owned(with.into_owned().symbol(&symbol));
    }
    let math = Math::Matrix(name.clone(), short);
    let matrix = Block::Formula { math, number: *number, proof: *proof };
    Some(Named { matrix, entries, names: with.into_owned() })
}

/// Every formula as it is shown, with its names: wide matrices by the names of their entries.
pub fn formulas(document: &Document) -> Vec<(Math, Vocabulary)> {
    let mut out = vec![];
    for section in &document.sections {
        for part in &section.parts {
            match part {
                Part::Block(block) => formulas_of(block, &section.names, &mut out),
                Part::Equations(all) | Part::Beside(all) => {
                    out.extend(all.iter().map(|m| (m.clone(), section.names.clone())));
                }
                _ => {}
            }
        }
    }
    out
}

fn formulas_of(block: &Block, names: &Vocabulary, out: &mut Vec<(Math, Vocabulary)>) {
    match (named(block, names), block) {
        (Some(named), _) => {
            formulas_of(&named.matrix, &named.names, out);
            out.extend(named.entries.into_iter().map(|m| (m, named.names.clone())));
        }
        (None, Block::Formula { math, .. }) => out.push((math.clone(), names.clone())),
        _ => {}
    }
}

/// How many pictures stand side by side.
pub fn columns(count: usize) -> usize {
    match count {
        0..=4 => count.max(1),
        5 | 6 | 9 => 3,
        _ => 4,
    }
}
