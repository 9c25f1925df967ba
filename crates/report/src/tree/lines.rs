//! Formulas in lines that fit a page.

use super::math::{Writer, with_indexed};
use super::{Factor, Math, Sign};
use denavit_symbolic::Expr;
use denavit_symbolic::print::{BrokenLine, Style, broken, width};
use denavit_symbolic::vocabulary::Vocabulary;

/// A formula in lines, in LaTeX, Typst or MathML.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Laid {
    /// What stands left of the first sign of equality, where the lines are aligned behind it.
    pub left: String,
    /// The lines; the first starts with the sign, if there is one.
    pub lines: Vec<BrokenLine>,
}

/// Between the columns of a matrix, em.
const COLUMN: f64 = 1.0;
/// What indents lines that go on, em.
const INDENT: f64 = 2.0;

/// The formula in lines of at most `room` em; all in one with nothing apart if it fits. Matrices, fractions and roots
/// are not broken.
pub fn laid(m: &Math, names: &Vocabulary, style: Style, room: f64) -> Laid {
    let measured = with_indexed(m, names, Style::Latex);
    let fits = || width(&Writer { names: &measured, style: Style::Latex }.math(m)) <= room;
    if matches!(m, Math::Matrix(..) | Math::Numbers(..)) || fits() {
        whole(m, names, style)
    } else {
        aligned(m, names, style, room)
    }
}

fn whole(m: &Math, names: &Vocabulary, style: Style) -> Laid {
    let text = Writer { names: &with_indexed(m, names, style), style }.math(m);
    Laid { left: String::new(), lines: vec![BrokenLine { depth: 0, text }] }
}

/// As [`laid`], with the left side of an equation apart however short it is.
pub fn aligned(m: &Math, names: &Vocabulary, style: Style, room: f64) -> Laid {
    let names = with_indexed(m, names, style);
    let measured = Writer { names: &with_indexed(m, &names, Style::Latex), style: Style::Latex };
    let writer = Writer { names: &names, style };
    match m {
        Math::Matrix(..) | Math::Numbers(..) | Math::Quantity { .. } => whole(m, &names, style),
        Math::Expr(e) => Laid {
            left: String::new(),
            lines: continued(broken(writer.set(*e), &names, style, room, room - INDENT)),
        },
        Math::Chain(first, rest) => {
            let left = width(&measured.expr(*first));
            if left > room / 2.0 {
                let mut lines = continued(broken(writer.set(*first), &names, style, room, room - INDENT));
                for (sign, e) in rest {
                    lines.extend(side(&writer, *sign, *e, room - INDENT));
                }
                return Laid { left: String::new(), lines };
            }
            let lines = rest.iter().flat_map(|(sign, e)| side(&writer, *sign, *e, room - left));
            Laid { left: writer.expr(*first), lines: lines.collect() }
        }
        Math::Determinant(of, e) => {
            let left = width(&measured.determinant(of));
            Laid { left: writer.determinant(of), lines: side(&writer, Sign::Equal, *e, room - left) }
        }
        Math::Product(factors) => {
            Laid { left: String::new(), lines: products(&writer, &measured, factors, room) }
        }
        Math::Products(left, right) => {
            let taken = width(&measured.product(left));
            if taken > room / 2.0 {
                let mut lines = products(&writer, &measured, left, room);
                let behind = products(&writer, &measured, right, room - INDENT);
                lines.extend(behind.into_iter().enumerate().map(|(k, l)| equal(&writer, k, l)));
                return Laid { left: String::new(), lines };
            }
            let lines = products(&writer, &measured, right, room - taken - 1.33);
            let lines = lines.into_iter().enumerate().map(|(k, l)| equal(&writer, k, l));
            Laid { left: writer.product(left), lines: lines.collect() }
        }
    }
}

/// The width of a matrix by its entries, without what stands left of it, em.
pub fn matrix_width(rows: &[Vec<Expr>], names: &Vocabulary) -> f64 {
    let columns = rows.first().map_or(0, Vec::len);
    let of = |e: Expr| {
        let m = Math::Expr(e);
        width(&Writer { names: &with_indexed(&m, names, Style::Latex), style: Style::Latex }.math(&m))
    };
    let column = |k: usize| rows.iter().filter_map(|r| r.get(k)).map(|&e| of(e)).fold(0.0, f64::max);
    (0..columns).map(|k| column(k) + COLUMN).sum()
}

/// A relation sign and what follows it.
fn side(writer: &Writer, sign: Sign, e: Expr, room: f64) -> Vec<BrokenLine> {
    let first = room - 1.33;
    let mut lines = continued(broken(writer.set(e), writer.names, writer.style, first, first - INDENT));
    if let Some(line) = lines.first_mut() {
        line.text = writer.sign(sign).to_string() + &line.text;
    }
    lines
}

/// Lines behind the first are indented.
fn continued(mut lines: Vec<BrokenLine>) -> Vec<BrokenLine> {
    lines.iter_mut().skip(1).for_each(|l| l.depth += 1);
    lines
}

/// Factors side by side, in lines.
fn products(writer: &Writer, measured: &Writer, factors: &[Factor], room: f64) -> Vec<BrokenLine> {
    let mut lines: Vec<(usize, usize)> = vec![];
    let (mut from, mut x) = (0, 0.0);
    for (k, factor) in factors.iter().enumerate() {
        let next = match factor {
            Factor::Constant(rows) => matrix_width(rows, measured.names),
            other => width(&measured.product(std::slice::from_ref(other))),
        };
        if k > from && x + next > room {
            lines.push((from, k));
            (from, x) = (k, INDENT);
        }
        x += next + 0.17;
    }
    lines.push((from, factors.len()));
    let line = |(k, (from, to)): (usize, (usize, usize))| BrokenLine {
        depth: usize::from(k > 0),
        text: writer.product(&factors[from..to]),
    };
    lines.into_iter().enumerate().map(line).collect()
}

fn equal(writer: &Writer, k: usize, line: BrokenLine) -> BrokenLine {
    match k {
        0 => BrokenLine { text: writer.sign(Sign::Equal).to_string() + &line.text, ..line },
        _ => line,
    }
}
