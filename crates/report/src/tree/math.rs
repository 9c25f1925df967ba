//! A formula of a document in any style.

use super::{Factor, Math, Sign};
use denavit_symbolic::print::{Style, print, print_digits};
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Expr, Symbol};

/// The formula; `names` says how angles are numbered.
pub fn math(m: &Math, names: &Vocabulary, style: Style) -> String {
    Writer { names: &with_indexed(m, names, style), style }.math(m)
}

/// The names with those that are set with an index: px is p with the index x.
pub(super) fn with_indexed(m: &Math, names: &Vocabulary, style: Style) -> Vocabulary {
    if matches!(style, Style::Ascii | Style::Unicode) {
        return names.clone();
    }
    let entries = m.exprs().into_iter().flat_map(Expr::symbols).filter_map(indexed);
    entries.filter_map(Expr::as_symbol).fold(names.clone(), |v, s| v.symbol(&s.name()))
}

/// An entry of the pose, a component of a velocity or of a vector in a frame (x4x), with its index apart.
fn indexed(s: Symbol) -> Option<Expr> {
    let name = s.name();
    let index = name.strip_prefix(['n', 'o', 'a', 'p', 'v', 'w', 'r', 'x', 'y', 'z'])?;
    let frame = index.strip_suffix(['x', 'y', 'z'])?;
    let is_bare = frame.is_empty() && !name.starts_with(['x', 'y', 'z']);
    let is_in_frame = !frame.is_empty()
        && frame.bytes().all(|b| b.is_ascii_digit())
        && name.starts_with(['x', 'y', 'z', 'p']);
    (is_bare || is_in_frame).then(|| Expr::symbol(&format!("{}_{index}", &name[..1])))
}

pub(super) struct Writer<'a> {
    pub(super) names: &'a Vocabulary,
    pub(super) style: Style,
}

fn raised(digits: &str) -> String {
    digits.chars().filter_map(|c| "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().nth(c.to_digit(10)? as usize)).collect()
}

fn lowered(digits: &str) -> String {
    digits.chars().filter_map(|c| "₀₁₂₃₄₅₆₇₈₉".chars().nth(c.to_digit(10)? as usize)).collect()
}

impl Writer<'_> {
    pub(super) fn math(&self, m: &Math) -> String {
        let text = match m {
            Math::Expr(e) => self.expr(*e),
            Math::Chain(first, rest) => rest
                .iter()
                .fold(self.expr(*first), |text, (sign, e)| text + self.sign(*sign) + &self.expr(*e)),
            Math::Product(factors) => self.product(factors),
            Math::Products(left, right) => self.product(left) + self.sign(Sign::Equal) + &self.product(right),
            Math::Determinant(of, e) => self.determinant(of) + self.sign(Sign::Equal) + &self.expr(*e),
            Math::Matrix(name, rows) => self.factor(name) + self.sign(Sign::Equal) + &self.matrix(rows),
            Math::Numbers(name, rows) => {
                let rows = rows.iter().map(|r| r.iter().map(|x| self.number(x)).collect()).collect();
                self.factor(name) + self.sign(Sign::Equal) + &self.grid(rows)
            }
            Math::Quantity { of, is_rate, digits, unit } => {
                let of = if *is_rate { self.rate(*of) } else { self.expr(*of) };
                of + self.sign(Sign::Equal) + &self.number(digits) + &self.unit(unit)
            }
        };
        match self.style {
            Style::MathMl => format!("<mrow>{text}</mrow>"),
            _ => text,
        }
    }

    pub(super) fn determinant(&self, of: &Factor) -> String {
        let det = match self.style {
            Style::Latex => "\\det ",
            Style::MathMl => "<mi>det</mi>",
            Style::Ascii | Style::Unicode | Style::Typst => "det ",
        };
        det.to_string() + &self.factor(of)
    }

    /// Names such as px are p with the index x where indices can be set.
    pub(super) fn expr(&self, e: Expr) -> String {
        print(self.set(e), self.names, self.style)
    }

    /// The expression with the names that are set.
    pub(super) fn set(&self, e: Expr) -> Expr {
        match self.style {
            Style::Ascii | Style::Unicode => e,
            Style::Latex | Style::Typst | Style::MathMl => e.substitute(indexed),
        }
    }

    pub(super) fn sign(&self, sign: Sign) -> &'static str {
        let k = match sign {
            Sign::Equal => 0,
            Sign::Different => 1,
            Sign::Less => 2,
            Sign::AtMost => 3,
            Sign::AtLeast => 4,
            Sign::EitherSign => 5,
        };
        match self.style {
            Style::Ascii => [" = ", " != ", " < ", " <= ", " >= ", " = +-"][k],
            Style::Unicode => [" = ", " ≠ ", " < ", " ≤ ", " ≥ ", " = ±"][k],
            Style::Latex => [" = ", " \\neq ", " < ", " \\leq ", " \\geq ", " = \\pm "][k],
            Style::Typst => [" = ", " != ", " < ", " <= ", " >= ", " = plus.minus "][k],
            Style::MathMl => [
                "<mo>=</mo>",
                "<mo>≠</mo>",
                "<mo>&lt;</mo>",
                "<mo>≤</mo>",
                "<mo>≥</mo>",
                "<mo>=</mo><mo>±</mo>",
            ][k],
        }
    }

    pub(super) fn product(&self, factors: &[Factor]) -> String {
        let dot = match self.style {
            Style::Ascii => "*",
            Style::Unicode => "·",
            Style::Latex => " \\, ",
            Style::Typst => " ",
            Style::MathMl => "<mo>&#x2062;</mo>",
        };
        factors.iter().map(|f| self.factor(f)).collect::<Vec<_>>().join(dot)
    }

    fn factor(&self, f: &Factor) -> String {
        match f {
            Factor::Named { letter, number, of, inverse } => {
                let number = number.map(|n| n.to_string()).unwrap_or_default();
                let name = match (self.style, number.is_empty()) {
                    (Style::Latex, false) => format!("{letter}_{{{number}}}"),
                    (Style::Typst, false) => format!("{letter}_{number}"),
                    (Style::MathMl, false) => format!("<msub><mi>{letter}</mi><mn>{number}</mn></msub>"),
                    (Style::MathMl, true) => format!("<mi>{letter}</mi>"),
                    _ => format!("{letter}{number}"),
                };
                let name = of.map_or(name.clone(), |e| self.call(&name, &[self.expr(e)]));
                if *inverse { self.inverse(&name) } else { name }
            }
            Factor::Indexed(letter, index) => match self.style {
                Style::Latex | Style::Typst => format!("{letter}_{index}"),
                Style::MathMl => format!("<msub><mi>{letter}</mi><mi>{index}</mi></msub>"),
                Style::Ascii | Style::Unicode => format!("{letter}{index}"),
            },
            Factor::Frame { from, to } => self.frame(from, to),
            Factor::Rotation(axis, angle) => {
                let angle = self.angle(*angle);
                self.call(&self.function("Rot"), &[self.letter(*axis), angle])
            }
            Factor::Translation(p) => {
                let zero = |e: &Expr| e.is_zero();
                match p.iter().filter(|e| !zero(e)).count() {
                    1 => {
                        let k = p.iter().position(|e| !zero(e)).unwrap_or(0);
                        self.call(
                            &self.function("Trans"),
                            &[self.letter(['x', 'y', 'z'][k]), self.expr(p[k])],
                        )
                    }
                    _ => self.call(&self.function("Trans"), &p.map(|e| self.expr(e))),
                }
            }
            Factor::Inverse(of) => self.inverse(&self.factor(of)),
            Factor::Constant(rows) => self.matrix(rows),
        }
    }

    /// ⁰T₆
    fn frame(&self, from: &str, to: &str) -> String {
        let numbers = [from, to].map(|name| name.bytes().all(|b| b.is_ascii_digit()));
        match self.style {
            Style::Ascii => format!("T({from}, {to})"),
            Style::Unicode if numbers == [true; 2] => format!("{}T{}", raised(from), lowered(to)),
            Style::Unicode => format!("T({from} → {to})"),
            Style::Latex => {
                let [from, to] = [from, to].map(|name| match name.bytes().all(|b| b.is_ascii_digit()) {
                    true => name.to_string(),
                    // Any frame, and the one before it.
                    false if name.starts_with('j') => name.replace('−', "-"),
                    false => format!("\\mathrm{{{name}}}"),
                });
                format!("{{}}^{{{from}}}T_{{{to}}}")
            }
            Style::Typst => format!("attach(T, tl: \"{from}\", br: \"{to}\")"),
            Style::MathMl => {
                let [from, to] = [from, to].map(|name| match name.bytes().all(|b| b.is_ascii_digit()) {
                    true => format!("<mn>{name}</mn>"),
                    false => format!("<mtext>{name}</mtext>"),
                });
                format!(
                    "<mmultiscripts><mi>T</mi>{to}<mrow></mrow><mprescripts></mprescripts><mrow></mrow>{from}</mmultiscripts>"
                )
            }
        }
    }

    /// Multiples of π in degrees, as tables have them.
    fn angle(&self, e: Expr) -> String {
        let turns = denavit_symbolic::Angle::of(e);
        let degrees = &turns.turns * &denavit_symbolic::Rational::from(180);
        let is_multiple =
            e.symbols().is_empty() && turns.to_expr() == (Expr::from(turns.turns.clone()) * Expr::pi());
        if !is_multiple || degrees.is_zero() {
            return self.expr(e);
        }
        let number = self.expr(degrees.into());
        match self.style {
            Style::Ascii => format!("{number} deg"),
            Style::Unicode => format!("{number}°"),
            Style::Latex => format!("{number}^{{\\circ}}"),
            Style::Typst => format!("{number} degree"),
            Style::MathMl => format!("{number}<mo>°</mo>"),
        }
    }

    fn function(&self, name: &str) -> String {
        match self.style {
            Style::Latex => format!("\\operatorname{{{name}}}"),
            Style::Typst => format!("op(\"{name}\")"),
            Style::MathMl => format!("<mi>{name}</mi>"),
            Style::Ascii | Style::Unicode => name.into(),
        }
    }

    fn letter(&self, c: char) -> String {
        if self.style == Style::MathMl { format!("<mi>{c}</mi>") } else { c.to_string() }
    }

    fn call(&self, function: &str, arguments: &[String]) -> String {
        match self.style {
            Style::MathMl => {
                format!("{function}<mo>(</mo>{}<mo>)</mo>", arguments.join("<mo>,</mo>"))
            }
            _ if self.names.has_decimal_comma() && arguments.iter().any(|a| a.contains(',')) => {
                format!("{function}({})", arguments.join("; "))
            }
            _ => format!("{function}({})", arguments.join(", ")),
        }
    }

    fn inverse(&self, of: &str) -> String {
        match self.style {
            Style::Ascii => format!("{of}^-1"),
            Style::Unicode => format!("{of}⁻¹"),
            Style::Latex => format!("{of}^{{-1}}"),
            Style::Typst => format!("{of}^(-1)"),
            Style::MathMl => {
                format!("<msup><mrow>{of}</mrow><mrow><mo>−</mo><mn>1</mn></mrow></msup>")
            }
        }
    }

    /// A decimal number; its sign is that of formulas.
    fn number(&self, text: &str) -> String {
        let (sign, digits) = text.strip_prefix('-').map_or(("", text), |digits| ("-", digits));
        let digits = print_digits(digits, self.names, self.style);
        match (self.style, sign) {
            (Style::MathMl, "") => digits,
            (Style::MathMl, _) => format!("<mrow><mo>−</mo>{digits}</mrow>"),
            (Style::Unicode, "-") => format!("−{digits}"),
            _ => format!("{sign}{digits}"),
        }
    }

    /// The velocity of a variable: with a dot.
    fn rate(&self, of: Expr) -> String {
        let name = self.expr(of);
        match self.style {
            Style::Ascii => format!("d{name}"),
            Style::Unicode => {
                let mut letters = name.chars();
                let first: String = letters.next().into_iter().chain(['\u{307}']).collect();
                first + letters.as_str()
            }
            Style::Latex => match name.split_once('_') {
                Some((base, index)) => format!("\\dot{{{base}}}_{index}"),
                None => format!("\\dot{{{name}}}"),
            },
            Style::Typst => format!("dot({name})"),
            Style::MathMl => format!("<mover>{name}<mo>˙</mo></mover>"),
        }
    }

    /// A unit behind a number.
    fn unit(&self, unit: &str) -> String {
        match (self.style, unit) {
            (Style::Ascii, "°") => " deg".into(),
            (Style::Unicode, "°") => "°".into(),
            (Style::Latex, "°") => "^{\\circ}".into(),
            (Style::Typst, "°") => " degree".into(),
            (Style::MathMl, "°") => "<mo>°</mo>".into(),
            (Style::Ascii | Style::Unicode, _) => format!(" {unit}"),
            (Style::Latex, _) => format!(" \\text{{ {unit}}}"),
            (Style::Typst, _) => format!(" thin upright(\"{unit}\")"),
            (Style::MathMl, _) => format!("<mspace width=\"0.2em\"/><mtext>{unit}</mtext>"),
        }
    }

    fn matrix(&self, rows: &[Vec<Expr>]) -> String {
        self.grid(rows.iter().map(|r| r.iter().map(|&e| self.expr(e)).collect()).collect())
    }

    fn grid(&self, rows: Vec<Vec<String>>) -> String {
        let joined = |cell: &str, row: &str| rows.iter().map(|r| r.join(cell)).collect::<Vec<_>>().join(row);
        match self.style {
            Style::Unicode if self.names.has_decimal_comma() => format!("[{}]", joined("  ", "; ")),
            Style::Ascii | Style::Unicode => format!("[{}]", joined(", ", "; ")),
            Style::Latex => format!("\\begin{{bmatrix}} {} \\end{{bmatrix}}", joined(" & ", " \\\\ ")),
            Style::Typst => format!("mat(delim: \"[\", {})", joined(", ", "; ")),
            Style::MathMl => {
                let cells = |r: &Vec<String>| r.iter().map(|c| format!("<mtd>{c}</mtd>")).collect::<String>();
                let rows: String = rows.iter().map(|r| format!("<mtr>{}</mtr>", cells(r))).collect();
                format!("<mrow><mo>[</mo><mtable>{rows}</mtable><mo>]</mo></mrow>")
            }
        }
    }
}
