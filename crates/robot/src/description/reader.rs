//! The numbers of a robot description in XML: exact decimals, and angles by their digits.

use super::Decimals;
use super::decimals::{Found, Meant, name, places, recognise};
use super::diagnostic::{Diagnostics, Severity};
use super::xml::{Element, Text, shown};
use crate::geometry::{Rotation, Transform, Vector};
use denavit_symbolic::{Expr, Rational};
use std::collections::{BTreeMap, HashMap};
use std::ops::Range;

/// Lengths below this (metres) are noise of a program.
const NOISE: (i64, i64) = (1, 1_000_000_000_000);
/// More than a turn, radians: no file needs such a roll, pitch or yaw.
const TURN: i64 = 7;
/// How large a number may be: a robot is no continent.
const LARGEST: i64 = 1_000_000_000;

/// A text being read, and what was found in it.
pub(super) struct Reader {
    pub out: Diagnostics,
    pub decimals: Decimals,
    /// True if a link or a joint could not be read: what hangs on what is not known.
    pub is_part: bool,
    /// What angles were taken for: by text and multiple, where first, how often.
    angles: BTreeMap<(String, i64), Angles>,
    /// Roll, pitch or yaw of more than a turn.
    pub far_angles: Vec<Range<usize>>,
    /// Rotations by roll, pitch and yaw: most are those of many joints.
    rotations: HashMap<[Expr; 3], Rotation<Expr>>,
}

struct Angles {
    first: Range<usize>,
    count: usize,
    meant: Meant,
    is_taken: bool,
}

impl Reader {
    pub fn new(out: Diagnostics, decimals: Decimals) -> Self {
        Reader {
            out,
            decimals,
            is_part: false,
            angles: BTreeMap::new(),
            far_angles: vec![],
            rotations: HashMap::new(),
        }
    }

    /// A decimal.
    pub fn decimal(&mut self, word: &Text) -> Option<Rational> {
        let number = match word.exact {
            // What is computed in doubles only, such as a mass.
            Some(e) => e.eval(|_| None).ok().and_then(Rational::from_f64),
            None => Rational::from_decimal(word.text),
        };
        let Some(number) = number else {
            let finding =
                self.out.error(word.span.clone(), format!("`{}` is no decimal number", shown(word.text)));
            if word.text.contains(',') {
                finding.hint("numbers stand between blanks, with a point: `0.07 0 0`");
            } else if word.text.contains("$(") || word.text.contains("${") {
                finding.hint("this is to be replaced by xacro: expand the file first");
            }
            return None;
        };
        if number.abs() > Rational::from(LARGEST) {
            self.out.error(word.span.clone(), format!("`{}` is out of range", shown(word.text)));
            return None;
        }
        Some(number)
    }

    /// The numbers of an attribute; nothing where it is missing or wrong, which is said.
    pub fn numbers<'a>(
        &mut self,
        value: &Text<'a>,
        what: &str,
        count: usize,
    ) -> Option<Vec<(Rational, Text<'a>)>> {
        let words = value.words();
        if words.len() != count {
            let message = format!("`{what}` has {} numbers, not {count}", words.len());
            let finding = self.out.error(value.span.clone(), message);
            if value.text.contains(',') {
                finding.hint("numbers stand between blanks");
            }
            return None;
        }
        let numbers: Vec<_> = words.into_iter().map(|w| Some((self.decimal(&w)?, w))).collect();
        numbers.into_iter().collect()
    }

    /// A number in an attribute that may be missing, however large.
    pub fn any_number(&mut self, element: &Element, name: &str) -> Option<Rational> {
        let value = element.attribute(name)?;
        let known = value.words();
        match (&known[..], Rational::from_decimal(value.text.trim())) {
            ([_], Some(number)) => Some(number),
            _ => Some(self.numbers(&value, name, 1)?.remove(0).0),
        }
    }

    /// A number in an attribute that may be missing.
    pub fn number(&mut self, element: &Element, name: &str) -> Option<Rational> {
        let value = element.attribute(name)?;
        Some(self.numbers(&value, name, 1)?.remove(0).0)
    }

    /// A length; noise of a program is 0.
    pub fn length(&mut self, x: Rational, word: &Text) -> Expr {
        if let Some(exact) = word.exact {
            return exact;
        }
        let is_noise = !x.is_zero() && x.abs() < Rational::new(NOISE.0, NOISE.1);
        if is_noise && self.decimals == Decimals::Meant {
            self.out.note(word.span.clone(), format!("{} m is read as 0", shown(word.text)));
            return Expr::int(0);
        }
        x.into()
    }

    /// An angle: a multiple of π/12 where its digits print one.
    pub fn angle(&mut self, x: Rational, word: &Text) -> Expr {
        if let Some(exact) = word.exact {
            return exact;
        }
        if self.decimals == Decimals::AsWritten {
            return x.into();
        }
        let (meant, is_taken) = match recognise(&x, places(word.text)) {
            Found::Multiple(meant) => (meant, true),
            Found::Nearly(meant) => (meant, false),
            Found::Plain => return x.into(),
        };
        let first = || Angles { first: word.span.clone(), count: 0, meant, is_taken };
        // Each finding shows its text; of very many only the count matters.
        if self.angles.len() < 1000 {
            self.angles.entry((word.text.into(), meant.twelfths)).or_insert_with(first).count += 1;
        }
        if is_taken { Expr::from(Rational::new(meant.twelfths, 12)) * Expr::pi() } else { x.into() }
    }

    /// Says what angles were taken for.
    pub fn say_angles(&mut self) {
        for ((text, twelfths), Angles { first, count, meant, is_taken }) in std::mem::take(&mut self.angles) {
            let places = if count == 1 { String::new() } else { format!("; {count} places") };
            let off = format!("{}{places}", meant.distance());
            let (severity, message) = match (is_taken, meant.is_doubtful) {
                (true, true) => {
                    (Severity::Warning, format!("{} is read as {} ({off})", shown(&text), name(twelfths)))
                }
                (true, false) => {
                    (Severity::Note, format!("{} is read as {} ({off})", shown(&text), name(twelfths)))
                }
                (false, _) => (
                    Severity::Note,
                    format!("{} is nearly {} ({off}), and stays as it is", shown(&text), name(twelfths)),
                ),
            };
            let finding = match severity {
                Severity::Warning => self.out.warning(first, message),
                _ => self.out.note(first, message),
            };
            if severity == Severity::Warning {
                finding.hint("`--as-written` takes decimals as they are");
            }
        }
    }

    /// `<origin xyz rpy>`; the identity where there is none.
    pub fn origin(&mut self, element: Option<Element>) -> Transform<Expr> {
        let Some(element) = element else { return Transform::identity() };
        element.only(&["xyz", "rpy"], &mut self.out);
        let zero = [Expr::int(0); 3];
        let mut three = |name: &str, is_angle: bool| {
            let Some(value) = element.attribute(name) else { return zero };
            let Some(numbers) = self.numbers(&value, name, 3) else { return zero };
            let mut read = numbers.into_iter().map(|(x, word)| match is_angle {
                true => {
                    if x.abs() > Rational::from(TURN) {
                        self.far_angles.push(word.span.clone());
                    }
                    self.angle(x, &word)
                }
                false => self.length(x, &word),
            });
            [0, 1, 2].map(|_| read.next().unwrap_or(Expr::int(0)))
        };
        let (xyz, rpy) = (three("xyz", false), three("rpy", true));
        let [roll, pitch, yaw] = rpy;
        let rotation = self.rotations.entry(rpy).or_insert_with(|| Rotation::from_rpy(roll, pitch, yaw));
        Transform::from_rotation_translation(*rotation, Vector(xyz))
    }

    /// `<axis xyz>`, x where there is none.
    pub fn axis(&mut self, element: Option<Element>) -> Vector<Expr> {
        let x = Vector([1, 0, 0].map(Expr::int));
        let Some(element) = element else { return x };
        element.only(&["xyz"], &mut self.out);
        let Some(value) = element.attribute("xyz") else {
            self.out.warning(element.span(), "an axis without `xyz` is taken as x");
            return x;
        };
        self.direction(&value, "xyz").unwrap_or(x)
    }

    /// Three numbers that are a direction; nothing where they are none, which is said.
    pub fn direction(&mut self, value: &Text, what: &str) -> Option<Vector<Expr>> {
        let numbers = self.numbers(value, what, 3)?;
        self.direction_of(numbers, value, what)
    }

    /// Numbers of a value that are a direction.
    pub fn direction_of(
        &mut self,
        numbers: Vec<(Rational, Text)>,
        value: &Text,
        what: &str,
    ) -> Option<Vector<Expr>> {
        let exact: Vec<Expr> =
            numbers.iter().map(|(x, word)| word.exact.unwrap_or_else(|| x.clone().into())).collect();
        let is_exact = numbers.iter().any(|n| n.1.exact.is_some());
        let mut v: Vec<Rational> = numbers.into_iter().map(|n| n.0).collect();
        let largest = v.iter().map(Rational::abs).max().unwrap_or_default();
        if largest.is_zero() {
            self.out.error(value.span.clone(), format!("the {} is the vector 0", said(what)));
            return None;
        }
        if is_exact {
            return Some(Vector([exact[0], exact[1], exact[2]]));
        }
        let noise = &largest * &Rational::new(NOISE.0, NOISE.1);
        let is_noise = |c: &Rational| !c.is_zero() && c.abs() < noise;
        if self.decimals == Decimals::Meant {
            if v.iter().any(is_noise) {
                self.out.note(value.span.clone(), "components below 1e-12 of the largest are read as 0");
                v.iter_mut().filter(|c| is_noise(c)).for_each(|c| *c = Rational::ZERO);
            }
            self.diagonal(&mut v, &largest, value, what);
        }
        Some(Vector([0, 1, 2].map(|i| Expr::from(v[i].clone()))))
    }

    /// `0.7071 0 0.7072` is a diagonal.
    fn diagonal(&mut self, v: &mut [Rational], largest: &Rational, value: &Text, what: &str) {
        let near = |c: &Rational| {
            let off = (&c.abs() - largest).abs();
            !off.is_zero() && off < largest * &Rational::new(1, 10_000)
        };
        let all = v.iter().filter(|c| !c.is_zero()).all(|c| near(c) || c.abs() == *largest);
        if all && v.iter().any(near) {
            self.out.note(
                value.span.clone(),
                format!("the {} {} is read as a diagonal", said(what), shown(value.text)),
            );
            for c in v.iter_mut().filter(|c| !c.is_zero()) {
                *c = if c.is_negative() { -largest } else { largest.clone() };
            }
        }
    }
}

/// What the value of an attribute is.
fn said(attribute: &str) -> &str {
    if attribute == "xyz" { "axis" } else { attribute }
}
