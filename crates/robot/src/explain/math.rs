//! A formula of a document in any style.

use super::document::{Factor, Math, Sign};
use denavit_symbolic::print::{Style, print};
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Expr, Symbol};

/// The formula; `names` says how angles are numbered.
pub fn math(m: &Math, names: &Vocabulary, style: Style) -> String {
    if matches!(style, Style::Ascii | Style::Unicode) {
        return Writer { names, style }.math(m);
    }
    // px is set as p with the index x.
    let entries = m.exprs().into_iter().flat_map(Expr::symbols).filter_map(indexed);
    let names = entries.filter_map(Expr::as_symbol).fold(names.clone(), |v, s| v.symbol(&s.name()));
    Writer { names: &names, style }.math(m)
}

/// An entry of the pose, or a component of a velocity, with its index apart.
fn indexed(s: Symbol) -> Option<Expr> {
    let name = s.name();
    let mut letters = name.chars();
    match (letters.next(), letters.next(), letters.next()) {
        (Some(a @ ('n' | 'o' | 'a' | 'p' | 'v' | 'w' | 'r')), Some(b @ ('x' | 'y' | 'z')), None) => {
            Some(Expr::symbol(&format!("{a}_{b}")))
        }
        _ => None,
    }
}

struct Writer<'a> {
    names: &'a Vocabulary,
    style: Style,
}

impl Writer<'_> {
    fn math(&self, m: &Math) -> String {
        let text = match m {
            Math::Expr(e) => self.expr(*e),
            Math::Chain(first, rest) => rest
                .iter()
                .fold(self.expr(*first), |text, (sign, e)| text + self.sign(*sign) + &self.expr(*e)),
            Math::Product(factors) => self.product(factors),
            Math::Products(left, right) => self.product(left) + self.sign(Sign::Equal) + &self.product(right),
            Math::Determinant(of, e) => {
                let det = match self.style {
                    Style::Latex => "\\det ",
                    Style::MathMl => "<mi>det</mi>",
                    Style::Ascii | Style::Unicode | Style::Typst => "det ",
                };
                det.to_string() + &self.factor(of) + self.sign(Sign::Equal) + &self.expr(*e)
            }
            Math::Matrix(name, rows) => self.factor(name) + self.sign(Sign::Equal) + &self.matrix(rows),
        };
        match self.style {
            Style::MathMl => format!("<mrow>{text}</mrow>"),
            _ => text,
        }
    }

    /// Names such as px are p with the index x where indices can be set.
    fn expr(&self, e: Expr) -> String {
        let e = match self.style {
            Style::Ascii | Style::Unicode => e,
            Style::Latex | Style::Typst | Style::MathMl => e.substitute(indexed),
        };
        print(e, self.names, self.style)
    }

    fn sign(&self, sign: Sign) -> &'static str {
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

    fn product(&self, factors: &[Factor]) -> String {
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

    fn matrix(&self, rows: &[Vec<Expr>]) -> String {
        let rows: Vec<Vec<String>> = rows.iter().map(|r| r.iter().map(|&e| self.expr(e)).collect()).collect();
        let joined = |cell: &str, row: &str| rows.iter().map(|r| r.join(cell)).collect::<Vec<_>>().join(row);
        match self.style {
            Style::Ascii | Style::Unicode => format!("[{}]", joined(", ", "; ")),
            Style::Latex => format!("\\begin{{bmatrix}} {} \\end{{bmatrix}}", joined(" & ", " \\\\ ")),
            Style::Typst => format!("mat(delim: \"[\", {})", joined(", ", "; ")),
            Style::MathMl => {
                let cells = |r: &Vec<String>| r.iter().map(|c| format!("<mtd>{c}</mtd>")).collect::<String>();
                let rows: String = rows.iter().map(|r| format!("<mtr>{}</mtr>", cells(r))).collect();
                format!("<mtable>{rows}</mtable>")
            }
        }
    }
}
