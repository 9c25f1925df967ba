//! Formulas as text: ASCII and Unicode that the parser reads back, LaTeX, Typst and MathML.
//!
//! ```
//! use denavit_symbolic::print::{Style, print};
//! use denavit_symbolic::{Expr, Symbol, vocabulary::Vocabulary};
//! let names = Vocabulary::new().angle(2, Symbol::new("q2")).angle(3, Symbol::new("q3")).symbol("a2");
//! let (q2, q3) = (Expr::symbol("q2"), Expr::symbol("q3"));
//! let x = Expr::symbol("a2") * (q2 + q3).cos() * (q2.sin() - Expr::int(3).sqrt()) / Expr::int(2);
//! assert_eq!(print(x, &names, Style::Ascii), "a2*C23*(S2 - sqrt(3))/2");
//! assert_eq!(print(x, &names, Style::Unicode), "a2C23(S2 − √3)/2");
//! assert_eq!(print(x, &Vocabulary::new(), Style::Ascii), "a2*cos(q2 + q3)*(sin(q2) - sqrt(3))/2");
//! ```
//!
//! ASCII, Unicode and LaTeX are read back as the same handle. Parentheses stand where reading would build another
//! graph, and nowhere else; where factors side by side would be cut elsewhere, a sign of multiplication stands. Not
//! read back are x/0, roots of negative numbers and exponents above 1000, and symbols whose name the vocabulary
//! gives to something else without another word for them. Nothing recurses: the formula is
//! unrolled on a stack of its own, and the text ends in `…` once it is longer than [`MAX_BYTES`].

mod ascii;
mod broken;
mod latex;
mod mathml;
mod names;
mod notation;
mod typst;
mod unicode;
mod width;

pub use broken::{BrokenLine, broken};
pub use width::width;

use crate::expr::{Angle, Expr, Node};
use crate::rational::Rational;
use crate::vocabulary::Vocabulary;
use names::{Index, Spelling};
use notation::{Head, Notation, Seam};
use rustc_hash::FxHashMap;
use std::rc::Rc;

/// The length at which a text is cut off.
pub const MAX_BYTES: usize = 10_000_000;

/// How a formula is written.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Style {
    /// `a2*C23*(S2 - sqrt(3))/2`
    Ascii,
    /// `a2C23(S2 − √3)/2`
    Unicode,
    /// `\frac{a_{2} C_{23}\left(S_{2} - \sqrt{3}\right)}{2}`
    Latex,
    /// `frac(a_2 C_23 (S_2 - sqrt(3)), 2)`
    Typst,
    /// Presentation MathML, an `mrow` to be put into a `math` element.
    MathMl,
}

/// The formula as text. Angles that the vocabulary numbers are written `C23`, `S1`, `C_{2-3}`.
pub fn print(e: Expr, vocabulary: &Vocabulary, style: Style) -> String {
    let printer = Printer::of(e, vocabulary, style);
    let [before, after] = printer.notation.whole;
    format!("{before}{}{after}", printer.out)
}

/// A decimal number, digits with a point, as it stands in a formula.
pub fn print_digits(digits: &str, vocabulary: &Vocabulary, style: Style) -> String {
    (Printer::new(vocabulary, style).notation.digits)(digits.to_string())
}

/// A symbol's name as it stands in a formula, for tables and legends: `RL4` is `\mathit{RL}_{4}` in LaTeX.
pub fn print_symbol(name: &str, style: Style) -> String {
    (style.notation().symbol)(&Spelling::of(name, &Vocabulary::new()))
}

impl Style {
    fn notation(self) -> &'static Notation {
        match self {
            Style::Ascii => &ascii::NOTATION,
            Style::Unicode => &unicode::NOTATION,
            Style::Latex => &latex::NOTATION,
            Style::Typst => &typst::NOTATION,
            Style::MathMl => &mathml::NOTATION,
        }
    }
}

/// What the place of a formula asks of it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Place {
    /// Anything.
    Whole,
    /// An addend: no sum, no sign.
    Addend,
    /// A factor: no product or quotient either.
    Factor,
    /// A base: no power either.
    Base,
}

enum Task {
    Text(&'static str),
    Own(String),
    Write(Expr, Place),
    Times(Expr, bool),
    Mark(Mark),
}

/// What stands next in the text, for those who break it into lines.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Mark {
    /// A bracket around a sum.
    Open,
    /// Its end.
    Close,
    /// The sign between two addends.
    Sign,
    /// The bracket around the arguments of a function.
    Call,
    /// Behind the comma between two arguments.
    Comma,
    /// The end of the arguments.
    CallEnd,
    /// What cannot be broken: a fraction, a root, an argument.
    Freeze,
    /// Its end.
    Thaw,
}

struct Printer<'a> {
    notation: Notation,
    vocabulary: &'a Vocabulary,
    bridges: Vec<String>,
    /// Symbols, and sines and cosines that have a short spelling.
    leaves: FxHashMap<Expr, Option<Rc<str>>>,
    out: String,
    /// Marks and where in `out` they stand.
    marks: Vec<(usize, Mark)>,
}

impl<'a> Printer<'a> {
    fn new(vocabulary: &'a Vocabulary, style: Style) -> Self {
        let notation = match style {
            Style::Ascii | Style::Unicode | Style::Latex => style.notation().beside(vocabulary),
            Style::Typst | Style::MathMl => *style.notation(),
        };
        let comma = vocabulary.has_decimal_comma();
        let notation = if comma { Notation { digits: notation.comma, ..notation } } else { notation };
        Printer {
            notation,
            vocabulary,
            bridges: names::bridges(vocabulary),
            leaves: FxHashMap::default(),
            out: String::new(),
            marks: vec![],
        }
    }

    /// With the formula written: its arguments have semicolons between them where a number has a comma.
    fn of(e: Expr, vocabulary: &'a Vocabulary, style: Style) -> Self {
        let mut printer = Printer::new(vocabulary, style);
        printer.write(e);
        let calls = printer.marks.iter().any(|m| m.1 == Mark::Comma);
        if calls && vocabulary.has_decimal_comma() && has_comma_in_number(&printer.out) {
            let mut again = Printer::new(vocabulary, style);
            again.notation.call[1] = again.notation.semicolon;
            again.write(e);
            return again;
        }
        printer
    }

    fn write(&mut self, e: Expr) {
        let mut tasks = vec![Task::Write(e, Place::Whole)];
        while let Some(task) = tasks.pop() {
            if self.out.len() > MAX_BYTES {
                self.out.push('…');
                return;
            }
            match task {
                Task::Text(text) => self.out.push_str(text),
                Task::Own(text) => self.out.push_str(&text),
                Task::Mark(mark) => self.marks.push((self.out.len(), mark)),
                Task::Times(right, after_slash) => {
                    let seam = Seam {
                        right: self.head(right),
                        left: &self.out,
                        after_slash,
                        bridges: &self.bridges,
                    };
                    let sign = (self.notation.times)(&seam);
                    self.out.push_str(sign);
                    tasks.push(Task::Write(right, Place::Factor));
                }
                Task::Write(e, place) => {
                    let start = tasks.len();
                    if self.needs_parens(e, place) {
                        let [open, close] = self.notation.paren;
                        tasks.extend([Task::Mark(Mark::Open), Task::Text(open)]);
                        tasks.push(Task::Write(e, Place::Whole));
                        tasks.extend([Task::Mark(Mark::Close), Task::Text(close)]);
                    } else {
                        self.unroll(e, &mut tasks);
                    }
                    tasks[start..].reverse();
                }
            }
        }
    }

    fn needs_parens(&self, e: Expr, place: Place) -> bool {
        let bar = self.notation.bar.is_some();
        let looseness = match e.node() {
            Node::Number(r) if r.is_negative() => Place::Whole,
            Node::Number(r) if number_parts(&r).1.is_some() => {
                if bar {
                    Place::Factor
                } else {
                    Place::Addend
                }
            }
            Node::Add(..) | Node::Sub(..) | Node::Neg(_) => Place::Whole,
            Node::Div(_, b) if b.is_zero() && !bar => Place::Whole,
            Node::Div(..) if bar => Place::Factor,
            Node::Mul(..) | Node::Div(..) => Place::Addend,
            Node::Pow(..) => Place::Factor,
            Node::Sqrt(_) if self.notation.short_root.is_some() => Place::Factor,
            Node::Pi | Node::Symbol(_) | Node::Number(_) => Place::Base,
            Node::Sqrt(_) | Node::Sin(_) | Node::Cos(_) | Node::Atan2(..) | Node::Sign(_) => Place::Base,
        };
        looseness < place
    }

    /// The pieces of a formula in the order of reading.
    fn unroll(&mut self, e: Expr, tasks: &mut Vec<Task>) {
        let n = self.notation;
        if let Some(leaf) = self.leaf(e) {
            tasks.push(Task::Own(leaf.to_string()));
            return;
        }
        let is_solid = matches!(e.node(), Node::Pow(..) | Node::Sqrt(_) | Node::Sin(_) | Node::Cos(_));
        if is_solid {
            tasks.push(Task::Mark(Mark::Freeze));
        }
        self.unroll_node(e, n, tasks);
        if is_solid {
            tasks.push(Task::Mark(Mark::Thaw));
        }
    }

    fn unroll_node(&mut self, e: Expr, n: Notation, tasks: &mut Vec<Task>) {
        match e.node() {
            Node::Number(r) if r.is_negative() => {
                tasks.extend([Task::Text(n.negative), Task::Write((-r).into(), Place::Addend)]);
            }
            Node::Number(r) => {
                let (p, q) = number_parts(&r);
                self.ratio(Some(p), Expr::int(1), q, None, tasks);
            }
            Node::Pi => tasks.push(Task::Text(n.pi)),
            Node::Symbol(_) => unreachable!("a symbol is a leaf"),
            Node::Neg(a) => tasks.extend([Task::Text(n.negative), Task::Write(a, Place::Addend)]),
            Node::Add(..) | Node::Sub(..) => self.sum(e, tasks),
            Node::Mul(a, b) => match a.as_number() {
                Some(r) if b == Expr::pi() && degrees(&r).is_some() => {
                    let number = degrees(&r).unwrap_or_default();
                    tasks.extend([Task::Own((n.digits)(number)), Task::Text(n.degree)]);
                }
                Some(r) => {
                    let (p, q) = if b == Expr::pi() { fraction_parts(&r) } else { number_parts(&r) };
                    let p = Some(p).filter(|p| p != "1");
                    match b.node() {
                        Node::Div(a, b) if !b.is_zero() => self.ratio(p, a, q, Some(b), tasks),
                        _ => self.ratio(p, b, q, None, tasks),
                    }
                }
                None => self.ratio(None, e, None, None, tasks),
            },
            Node::Div(a, b) => match (n.bar, b.is_zero()) {
                (None, true) => {
                    tasks.extend([
                        Task::Write(a, Place::Factor),
                        Task::Text("/"),
                        Task::Write(b, Place::Base),
                    ]);
                }
                (None, false) => self.ratio(None, e, None, None, tasks),
                (Some(_), _) => self.ratio(None, a, None, Some(b), tasks),
            },
            Node::Pow(a, k) => tasks.extend([
                Task::Text(n.power[0]),
                Task::Write(a, Place::Base),
                Task::Text(n.power[1]),
                Task::Own((n.exponent)(k)),
            ]),
            Node::Sqrt(a) => match (n.short_root, a.as_number()) {
                (Some(sign), Some(r)) if r.is_integer() && !r.is_negative() => {
                    tasks.extend([Task::Text(sign), Task::Write(a, Place::Whole)]);
                }
                _ => {
                    tasks.extend([Task::Text(n.root[0]), Task::Write(a, Place::Whole), Task::Text(n.root[1])])
                }
            },
            Node::Sin(a) => {
                tasks.extend([Task::Text(n.sine), Task::Text(n.call[0])]);
                self.argument(a, tasks);
                tasks.push(Task::Text(n.call[2]));
            }
            Node::Cos(a) => {
                tasks.extend([Task::Text(n.cosine), Task::Text(n.call[0])]);
                self.argument(a, tasks);
                tasks.push(Task::Text(n.call[2]));
            }
            Node::Sign(a) => tasks.extend([
                Task::Text(n.sign),
                Task::Mark(Mark::Call),
                Task::Text(n.call[0]),
                Task::Write(a, Place::Whole),
                Task::Mark(Mark::CallEnd),
                Task::Text(n.call[2]),
            ]),
            Node::Atan2(y, x) => tasks.extend([
                Task::Text(n.arctangent),
                Task::Mark(Mark::Call),
                Task::Text(n.call[0]),
                Task::Write(y, Place::Whole),
                Task::Text(n.call[1]),
                Task::Mark(Mark::Comma),
                Task::Write(x, Place::Whole),
                Task::Mark(Mark::CallEnd),
                Task::Text(n.call[2]),
            ]),
        }
    }

    /// The argument of a sine or cosine.
    fn argument(&self, a: Expr, tasks: &mut Vec<Task>) {
        let (rest, negative, radians) = match a.node() {
            _ if !self.vocabulary.in_degrees() => return tasks.push(Task::Write(a, Place::Whole)),
            Node::Number(r) => (None, false, r),
            Node::Add(a, b) => (Some(a), false, b.as_number().unwrap_or(Rational::ZERO)),
            Node::Sub(a, b) => (Some(a), true, b.as_number().unwrap_or(Rational::ZERO)),
            _ => (None, false, Rational::ZERO),
        };
        if radians.is_zero() {
            return tasks.push(Task::Write(a, Place::Whole));
        }
        if let Some(rest) = rest {
            tasks.push(Task::Write(rest, Place::Whole));
            tasks.push(Task::Text(if negative { self.notation.minus } else { self.notation.plus }));
        }
        let (p, q) = number_parts(&radians);
        tasks.extend([Task::Own((self.notation.digits)(p)), Task::Text(self.notation.radian)]);
        if let Some(q) = q {
            tasks.extend([Task::Text("/"), Task::Own((self.notation.digits)(q))]);
        }
    }

    /// `a + b − c`, nested to the left.
    fn sum(&self, e: Expr, tasks: &mut Vec<Task>) {
        let n = self.notation;
        let (mut first, mut rest) = (e, vec![]);
        loop {
            let (a, sign, b) = match first.node() {
                Node::Add(a, b) => (a, n.plus, b),
                Node::Sub(a, b) => (a, n.minus, b),
                _ => break,
            };
            rest.push((sign, b));
            first = a;
        }
        tasks.push(Task::Write(first, Place::Addend));
        for (sign, b) in rest.into_iter().rev() {
            tasks.extend([Task::Mark(Mark::Sign), Task::Text(sign), Task::Write(b, Place::Addend)]);
        }
    }

    /// `p·a / (q·b)`, where `None` stands for 1.
    fn ratio(&self, p: Option<String>, a: Expr, q: Option<String>, b: Option<Expr>, tasks: &mut Vec<Task>) {
        let is_whole = q.is_none() && b.is_none();
        match self.notation.bar {
            _ if is_whole => self.product(p, a, Place::Factor, tasks),
            Some([before, between, after]) => {
                tasks.extend([Task::Mark(Mark::Freeze), Task::Text(before)]);
                self.product(p, a, Place::Whole, tasks);
                tasks.push(Task::Text(between));
                self.product(q, b.unwrap_or(Expr::int(1)), Place::Whole, tasks);
                tasks.extend([Task::Text(after), Task::Mark(Mark::Thaw)]);
            }
            None => {
                self.product(p, a, Place::Factor, tasks);
                tasks.push(Task::Text("/"));
                match (q, b) {
                    (None, Some(b)) => tasks.push(Task::Write(b, Place::Factor)),
                    (q, None) => self.product(q, Expr::int(1), Place::Factor, tasks),
                    (q, Some(b)) => {
                        tasks.push(Task::Text(self.notation.paren[0]));
                        self.product(q, b, Place::Factor, tasks);
                        tasks.push(Task::Text(self.notation.paren[1]));
                    }
                }
            }
        }
    }

    /// `p·x`, where x is unrolled as far as it is nested to the left; `alone` is the place of an x that is neither
    /// product nor quotient if nothing stands next to it.
    fn product(&self, p: Option<String>, x: Expr, alone: Place, tasks: &mut Vec<Task>) {
        let (mut first, mut rest) = (x, vec![]);
        loop {
            first = match first.node() {
                Node::Mul(a, b) if a.as_number().is_none() => {
                    rest.push((true, b));
                    a
                }
                Node::Div(a, b) if self.notation.bar.is_none() && !b.is_zero() => {
                    rest.push((false, b));
                    a
                }
                _ => break,
            };
        }
        match p {
            Some(p) => {
                tasks.push(Task::Own((self.notation.digits)(p)));
                if !first.is_one() {
                    tasks.push(Task::Times(first, false));
                }
            }
            None if rest.is_empty() => tasks.push(Task::Write(first, alone)),
            None => tasks.push(Task::Write(first, Place::Factor)),
        }
        let mut after_slash = false;
        for (times, b) in rest.into_iter().rev() {
            if times {
                tasks.push(Task::Times(b, after_slash));
            } else {
                tasks.extend([Task::Text("/"), Task::Write(b, Place::Factor)]);
                after_slash = true;
            }
        }
    }

    /// How a formula starts in the place of a factor.
    fn head(&mut self, mut e: Expr) -> Head {
        let mut place = Place::Factor;
        loop {
            if self.needs_parens(e, place) {
                return Head::Paren;
            }
            if let Some(leaf) = self.leaf(e) {
                return Head::Word(leaf);
            }
            match e.node() {
                Node::Number(r) if number_parts(&r).1.is_none() => return Head::Number,
                Node::Pi if self.notation.pi == self.notation.half_turn => return Head::Number,
                Node::Pi => return Head::Word(self.notation.pi.into()),
                Node::Pow(a, _) => (e, place) = (a, Place::Base),
                Node::Sqrt(_) => return Head::Root,
                Node::Sin(_) | Node::Cos(_) | Node::Atan2(..) | Node::Sign(_) => return Head::Call,
                Node::Number(_) | Node::Div(..) => return Head::Fraction,
                Node::Symbol(_) | Node::Neg(_) | Node::Add(..) | Node::Sub(..) | Node::Mul(..) => {
                    return Head::Paren;
                }
            }
        }
    }

    /// The spelling of a symbol, or of the sine or cosine of numbered angles.
    fn leaf(&mut self, e: Expr) -> Option<Rc<str>> {
        let node = e.node();
        if !matches!(node, Node::Symbol(_) | Node::Sin(_) | Node::Cos(_)) {
            return None;
        }
        if let Some(known) = self.leaves.get(&e) {
            return known.clone();
        }
        let text = match node {
            Node::Symbol(s) => Some((self.notation.symbol)(&Spelling::of(&s.name(), self.vocabulary))),
            Node::Sin(a) => self.short_trig('S', a),
            Node::Cos(a) => self.short_trig('C', a),
            _ => None,
        };
        let text: Option<Rc<str>> = text.map(Rc::from);
        self.leaves.insert(e, text.clone());
        text
    }

    fn short_trig(&self, letter: char, argument: Expr) -> Option<String> {
        let index = Index::of(&Angle::of(argument), self.vocabulary)?;
        let word = ascii::trig(letter, &index);
        // A symbol of the same name has the right of way.
        self.vocabulary.lookup(&word).is_none().then(|| (self.notation.trig)(letter, &index))
    }
}

/// `0,5` or `0{,}5`
fn has_comma_in_number(text: &str) -> bool {
    let is_digit = |c: Option<char>| c.is_some_and(|c| c.is_ascii_digit());
    text.match_indices(',').any(|(at, _)| {
        let (before, behind) = (text[..at].trim_end_matches('{'), text[at + 1..].trim_start_matches('}'));
        is_digit(before.chars().next_back()) && is_digit(behind.chars().next())
    })
}

/// Numerator and denominator (`None` for 1) of a positive number, or a decimal if it is a short one.
fn number_parts(r: &Rational) -> (String, Option<String>) {
    decimal(r).map_or_else(|| fraction_parts(r), |text| (text, None))
}

/// The multiple `r` of π in degrees, if that is a short decimal and `r` no usual fraction.
fn degrees(r: &Rational) -> Option<String> {
    let (_, d) = r.to_parts()?;
    let degrees = r * &Rational::from(180);
    match degrees.to_integer() {
        _ if d <= 12 => None,
        Some(whole) => Some(whole.to_string()),
        None => decimal(&degrees),
    }
}

fn fraction_parts(r: &Rational) -> (String, Option<String>) {
    let (p, q) = r.digits();
    (p, Some(q).filter(|q| q != "1"))
}

/// The largest number of decimals of a fraction that may come out of the algebra; what needs more stays a fraction.
const MAX_DECIMALS: u32 = 6;
/// The same where numerator and denominator are so large that somebody wrote decimals.
const WRITTEN: i64 = 1_000_000;
const MAX_WRITTEN: u32 = 30;

/// The decimals of a number beyond machine words, if they end.
fn written(r: &Rational) -> Option<String> {
    const MOST_BITS: u64 = 160;
    let (numerator, _) = r.digits();
    if r.bits() > MOST_BITS || numerator.len() <= MAX_DECIMALS as usize {
        return None;
    }
    let ten = Rational::from(10);
    let mut scaled = r.clone();
    for places in 1..=MAX_WRITTEN as usize {
        scaled = &scaled * &ten;
        if scaled.is_integer() {
            let (digits, _) = scaled.digits();
            let digits = format!("{digits:0>width$}", width = places + 1);
            let (whole, rest) = digits.split_at(digits.len() - places);
            return Some(format!("{whole}.{rest}"));
        }
    }
    None
}

/// `0.1519`, `0.3`; not for halves and quarters, which come out of the algebra.
fn decimal(r: &Rational) -> Option<String> {
    let Some((n, d)) = r.to_parts() else { return written(r) };
    if d <= 4 {
        return None;
    }
    let most = if d > WRITTEN && n.abs() > WRITTEN { MAX_WRITTEN } else { MAX_DECIMALS };
    let places = (1..=most).find(|&k| 10_i128.pow(k) % i128::from(d) == 0)?;
    let scale = 10_i128.pow(places);
    let digits = i128::from(n).checked_mul(scale / i128::from(d))?;
    Some(format!("{}.{:0width$}", digits / scale, digits % scale, width = places as usize))
}
