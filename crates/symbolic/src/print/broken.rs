//! Long formulas in lines, broken before the signs between addends and behind the commas between arguments,
//! outside of brackets where that is possible.

use super::width::width;
use super::{Mark, Printer, Style};
use crate::expr::Expr;
use crate::vocabulary::Vocabulary;

/// A line of a formula.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct BrokenLine {
    /// How many brackets are open where it starts.
    pub depth: usize,
    /// What stands in it; brackets that are not closed in the same line have a fixed size.
    pub text: String,
}

/// The formula in lines whose estimated width is at most `first` and `rest` em, in LaTeX, Typst or MathML. Fractions,
/// roots and arguments of functions are not broken, so that a line may be wider.
pub fn broken(e: Expr, vocabulary: &Vocabulary, style: Style, first: f64, rest: f64) -> Vec<BrokenLine> {
    let pieces = pieces(e, vocabulary, style);
    let measured = if style == Style::Latex { None } else { Some(self::pieces(e, vocabulary, Style::Latex)) };
    let measured = measured.as_ref().unwrap_or(&pieces);
    let whole = || vec![BrokenLine { depth: 0, text: pieces.iter().map(|p| p.text.as_str()).collect() }];
    // The three notations have the same structure.
    if measured.len() != pieces.len() {
        return whole();
    }
    let widths: Vec<f64> = measured.iter().map(|p| width(&p.text)).collect();
    let breaks = breaks(&pieces, &widths, first, rest);
    if breaks.is_empty() {
        return whole();
    }
    lines(pieces, &breaks, style)
}

struct Piece {
    text: String,
    mark: Option<Mark>,
}

/// The text cut where it may be broken and where brackets stand.
fn pieces(e: Expr, vocabulary: &Vocabulary, style: Style) -> Vec<Piece> {
    let printer = Printer::of(e, vocabulary, style);
    let [open, close] = printer.notation.paren;
    let mut pieces: Vec<Piece> = vec![];
    let mut frozen = 0;
    let mut from = 0;
    // Empty pieces, too: what is nothing in one notation is a blank in another.
    let mut push = |from: usize, to: usize, mark: Option<Mark>| {
        pieces.push(Piece { text: printer.out[from..to].to_string(), mark });
    };
    for &(at, mark) in &printer.marks {
        let sign = match mark {
            Mark::Freeze => {
                frozen += 1;
                continue;
            }
            Mark::Thaw => {
                frozen -= 1;
                continue;
            }
            _ if frozen > 0 => continue,
            Mark::Open => open.len(),
            Mark::Close => close.len(),
            Mark::Call => printer.notation.call[0].len(),
            Mark::CallEnd => printer.notation.call[2].len(),
            Mark::Comma => 0,
            Mark::Sign if printer.out[at..].starts_with(printer.notation.plus) => printer.notation.plus.len(),
            Mark::Sign => printer.notation.minus.len(),
        };
        // A text that was cut off ends before its marks do.
        if at + sign > printer.out.len() {
            break;
        }
        push(from, at, None);
        push(at, at + sign, Some(mark));
        from = at + sign;
    }
    push(from, printer.out.len(), None);
    pieces
}

/// The signs before which a line ends.
fn breaks(pieces: &[Piece], widths: &[f64], first: f64, rest: f64) -> Vec<usize> {
    let mut chosen = vec![];
    let (mut start, mut room) = (0, first);
    // Possible places of this line: piece, depth, width so far.
    let mut places: Vec<(usize, usize, f64)> = vec![];
    let (mut x, mut depth) = (0.0, 0_usize);
    let mut k = 0;
    while k < pieces.len() {
        match pieces[k].mark {
            Some(Mark::Open | Mark::Call) => depth += 1,
            Some(Mark::Close | Mark::CallEnd) => depth = depth.saturating_sub(1),
            Some(Mark::Sign | Mark::Comma) if k > start => places.push((k, depth, x)),
            _ => {}
        }
        x += widths[k];
        if x > room && !places.is_empty() {
            // The outermost place behind the first third, and of those the last; else the last.
            let good = places.iter().filter(|p| p.2 > room / 3.0);
            let at = good.min_by_key(|p| (p.1, std::cmp::Reverse(p.0))).or(places.last()).map(|p| p.0);
            let Some(at) = at else { break };
            chosen.push(at);
            start = at;
            // What stands behind the place is measured again from there.
            depth = places.iter().find(|p| p.0 == at).map_or(0, |p| p.1);
            room = rest - 1.5 * (depth as f64);
            (k, x) = (at, 0.0);
            places.clear();
            continue;
        }
        k += 1;
    }
    chosen
}

fn lines(pieces: Vec<Piece>, breaks: &[usize], style: Style) -> Vec<BrokenLine> {
    let fixed = match style {
        Style::Latex => ["\\bigl(", "\\bigr)"],
        Style::Typst => ["\\(", "\\)"],
        Style::MathMl => ["<mo stretchy=\"false\">(</mo>", "<mo stretchy=\"false\">)</mo>"],
        Style::Ascii | Style::Unicode => ["(", ")"],
    };
    // Brackets with a break between them.
    let mut split = vec![false; pieces.len()];
    let mut open = vec![];
    for (k, piece) in pieces.iter().enumerate() {
        match piece.mark {
            Some(Mark::Open | Mark::Call) => open.push(k),
            Some(Mark::Close | Mark::CallEnd) => {
                if let Some(from) = open.pop() {
                    let is_split = breaks.iter().any(|&b| from < b && b < k);
                    (split[from], split[k]) = (is_split, is_split);
                }
            }
            _ => {}
        }
    }
    let mut all = vec![BrokenLine { depth: 0, text: String::new() }];
    let mut depth = 0_usize;
    for (k, piece) in pieces.into_iter().enumerate() {
        if breaks.contains(&k) {
            all.push(BrokenLine { depth, text: String::new() });
        }
        let text = match piece.mark {
            Some(Mark::Open | Mark::Call) if split[k] => fixed[0],
            Some(Mark::Close | Mark::CallEnd) if split[k] => fixed[1],
            _ => &piece.text,
        };
        if let Some(line) = all.last_mut() {
            // A sign at the start of a line stands between two addends all the same.
            match style {
                Style::MathMl if line.text.is_empty() && piece.mark == Some(Mark::Sign) => {
                    line.text += &text.replacen("<mo>", "<mo form=\"infix\">", 1);
                }
                _ => line.text += text,
            }
        }
        match piece.mark {
            Some(Mark::Open | Mark::Call) => depth += 1,
            Some(Mark::Close | Mark::CallEnd) => depth = depth.saturating_sub(1),
            _ => {}
        }
    }
    all
}
