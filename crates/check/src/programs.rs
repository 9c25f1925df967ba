//! What straight-line code computes, as claims about the robot: matrices and scalars whose names say what they are, and
//! what a function returns.

use super::facts::{About, Meaning};
use super::inverse::rebuilt;
use super::jacobians::{Part, Told};
use super::lexis::Lexis;
use super::matrix::Matrix;
use super::note::{Unread, Unreadable};
use super::numbers::{Answer, Configuration, half_unit};
use super::subject::Subject;
use super::walk::{Assertion, Pair, Piece, is_measured};
use denavit::description::{Convention, JointKind, Screw};
use denavit::forward::Reference;
use denavit::geometry::Axis;
use denavit_reading::code::{
    Assigned, Cell, Code, Dialect, Reading, RowFunction, Value, is_vector, read_stated,
};
use denavit_symbolic::parse::ParseError;
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Angle, Expr, Node, Rational, Symbol, equal};
use std::f64::consts::TAU;
use std::ops::Range;
use std::rc::Rc;

/// The claims of a program, and what of it could not be read.
pub(super) fn assertions(
    text: &str,
    span: &Range<usize>,
    language: Dialect,
    subject: &Subject,
    lexis: &Lexis,
    number: usize,
    at: &Configuration,
) -> (Vec<Assertion>, Vec<Unread>) {
    let joints: Vec<Expr> = subject.description.variables().iter().map(|v| v.symbol.into()).collect();
    let meaning = |name: &str| lexis.names.lookup(name).filter(|_| !lexis.is_by_custom(name));
    let stated = Stated::of(text.get(span.clone()).unwrap_or_default(), subject);
    let joint = |name: &str| {
        let found = lexis.names.lookup(name)?;
        joints.iter().position(|q| *q == found)
    };
    let told = |name: &str, values: &[Expr]| stated.joints(values, joint(name), name);
    let Code { functions, rows, refusals } =
        read_stated(text, span.clone(), language, &meaning, &joints, &told);
    // What stands in a function that is judged as that of a row is not refused as another one.
    let of_row = |e: &ParseError| rows.iter().any(|r| r.reading.span.contains(&e.span.start));
    let mut refusals: Vec<Unread> = refusals.into_iter().filter(|e| !of_row(e)).map(Unread::from).collect();
    let mut found: Vec<Assertion> = rows
        .iter()
        .filter_map(|r| row_function(text, r, subject.description.convention, number, lexis))
        .collect();
    let own: Vec<String> = functions.iter().map(|f| f.name.clone()).filter(|n| !n.is_empty()).collect();
    for function in &functions {
        let names = Rc::new(names_in(function, lexis));
        let given = functions.iter().filter(|f| f.name.is_empty() || f.name == function.name);
        let given = given.flat_map(|f| given_in(f, subject, lexis)).collect();
        let program = Program { text, subject, lexis, number, names, given, functions: &own, at };
        let before = found.len();
        found.extend(program.assigned(function));
        found.extend(program.returned(function));
        if found.len() == before && !function.returned.is_empty() {
            let why = Unreadable::NothingTold(function.name.clone());
            refusals.push(Unread::new(function.span.clone(), why));
        }
    }
    (found, refusals)
}

/// The transform of a row as a function gives it, held against the convention to which it is nearest, the robot's first.
fn row_function(
    text: &str,
    function: &RowFunction,
    convention: Convention,
    number: usize,
    lexis: &Lexis,
) -> Option<Assertion> {
    let returned = function.reading.returned.first()?;
    let Value::Matrix(rows) = &returned.value else { return None };
    if rows.len() != 4 || rows.iter().any(|r| r.len() != 4) {
        return None;
    }
    let [theta, alpha] = function.angles;
    let [first, second] = function.lengths;
    let mut best: Option<(usize, Matrix)> = None;
    let standard = convention.begins_with_joint();
    for begins_with_joint in [standard, !standard] {
        for (along_x, along_z) in [(first, second), (second, first)] {
            let z = Screw { axis: Axis::Z, angle: theta, length: along_z }.transform();
            let x = Screw { axis: Axis::X, angle: alpha, length: along_x }.transform();
            let wanted = Matrix::of(&if begins_with_joint { z * x } else { x * z });
            let differs = |&(r, c): &(usize, usize)| {
                wanted.entry(r, c).is_none_or(|w| !equal(rows[r][c].value, w).is_equal())
            };
            let count = (0..16).map(|k| (k / 4, k % 4)).filter(differs).count();
            if best.as_ref().is_none_or(|b| count < b.0) {
                best = Some((count, wanted));
            }
        }
    }
    let (_, wanted) = best.filter(|b| b.0 <= MOST_WRONG)?;
    let mut pieces = vec![];
    for (r, row) in rows.iter().enumerate() {
        for (c, cell) in row.iter().enumerate() {
            let printed = cell.syntax.clone().filter(|_| text.get(cell.span.clone()).is_some());
            pieces.push(Piece::Pair(Pair {
                place: Some((r + 1, c + 1)),
                span: cell.span.clone(),
                printed,
                value: cell.value,
                wanted: wanted.entry(r, c)?,
                also: vec![],
            }));
        }
    }
    let own = names_in(&function.reading, lexis);
    let names = [theta, alpha, first, second].iter().fold(own, |names, e| {
        let name = e.as_symbol().map_or_else(String::new, |s| s.name().trim_end_matches("_i").to_string());
        names.alias(&name, *e)
    });
    Some(Assertion {
        span: returned.span.clone(),
        name: function.reading.name.clone(),
        about: About::Matrix(Meaning::Row),
        pieces,
        remarks: vec![],
        subject: number,
        whole: None,
        names: Some(Rc::new(names)),
        reference: None,
        spoken: None,
    })
}

/// Names that scripts give the hand's pose and Jacobian.
const HANDS: [&str; 4] = ["T", "H", "Tee", "T_ee"];
const JACOBIANS: [&str; 11] = ["J", "Jac", "jac", "Jv", "J_v", "Jp", "J_p", "Jw", "J_w", "Jo", "J_o"];
/// Names of the determinant of the Jacobian.
const DETERMINANTS: [&str; 4] = ["detJ", "det_J", "detj", "det_j"];

/// A matrix with more wrong entries is none of a row.
const MOST_WRONG: usize = 5;

/// 180/π, until what it stands in is worked out.
const PER_RADIAN: &str = "degrees per radian";

/// Angles that a script has in degrees, worked out: π · 180/π is 180.
fn in_radians(e: Expr) -> Expr {
    let per_radian = Expr::symbol(PER_RADIAN);
    let has = |e: Expr| e.symbols().iter().any(|s| Expr::from(*s) == per_radian);
    if !has(e) {
        return e;
    }
    // π · 180/π does not depend on what π is.
    let back = |e: Expr| {
        let at = |pi: i64| {
            let named = rebuilt(e, &mut |_, new: Expr| if new == Expr::pi() { Expr::int(pi) } else { new });
            let full = Expr::from(Rational::new(180, pi));
            Angle::of(named.substitute(|s| (Expr::from(s) == per_radian).then_some(full))).to_expr()
        };
        let all = [at(2), at(3), at(5), at(7)];
        match all.windows(2).all(|pair| pair[0] == pair[1]) {
            true => all[0],
            false => e.substitute(|s| (Expr::from(s) == per_radian).then(|| Expr::int(180) / Expr::pi())),
        }
    };
    let mut change = |_, new: Expr| match new.node() {
        Node::Sin(a) if has(a) => back(a).sin(),
        Node::Cos(a) if has(a) => back(a).cos(),
        _ => new,
    };
    let inner = rebuilt(e, &mut change);
    if has(inner) { back(inner) } else { inner }
}

/// How a script gives joints their values: what it computes from them is read as a formula in the joints.
struct Stated {
    kinds: Vec<JointKind>,
    joints: Vec<Expr>,
    in_degrees: bool,
}

impl Stated {
    /// Angles are in degrees if the script turns degrees into radians somewhere, or a name of a joint gets a number that
    /// looks like degrees.
    fn of(text: &str, subject: &Subject) -> Self {
        const TURNS: [&str; 8] =
            ["deg2rad", "radians(", "cosd(", "sind(", "pi/180", "pi / 180", "*pi/180", "pi)/180"];
        let kinds = subject.description.variables().iter().map(|v| v.kind).collect();
        let in_degrees = TURNS.iter().any(|t| text.contains(t));
        Stated { kinds, joints: subject.joints().to_vec(), in_degrees }
    }

    /// The joints for their values: of one name, or of a vector of all of them.
    fn joints(&self, values: &[Expr], joint: Option<usize>, name: &str) -> Option<Vec<Expr>> {
        let numbers: Vec<usize> = match (joint, values) {
            (Some(k), [_]) => vec![k],
            (None, all) if all.len() > 1 && all.len() == self.joints.len() && is_vector(name) => {
                (0..all.len()).collect()
            }
            _ => return None,
        };
        numbers.into_iter().zip(values).map(|(k, value)| self.joint(k, *value)).collect()
    }

    fn joint(&self, k: usize, value: Expr) -> Option<Expr> {
        let form = Angle::of(value);
        if !form.terms.is_empty() {
            return None;
        }
        let is_angle = self.kinds[k] == JointKind::Revolute;
        let x = value.as_number().map(|r| r.to_f64());
        // `q1 = 30` with `deg2rad(q1)` further down; `q1 = pi/6`, `q1 = 0.5`.
        let is_degrees = match x {
            Some(0.0) => self.in_degrees,
            Some(x) => x.abs() > TAU || x % 5.0 == 0.0,
            None => false,
        };
        Some(if is_angle && is_degrees { self.joints[k] * Expr::symbol(PER_RADIAN) } else { self.joints[k] })
    }
}

/// Lengths of the robot that a program sets to numbers.
fn given_in(function: &Reading, subject: &Subject, lexis: &Lexis) -> Vec<(Symbol, Expr)> {
    let of = |a: &Assigned| {
        let Value::Scalar(cell) = &a.value else { return None };
        let symbol = lexis.names.lookup(&a.name)?.as_symbol()?;
        let is_length = subject.description.parameter(symbol).is_some();
        (is_length && cell.value.symbols().is_empty()).then_some((symbol, cell.value))
    };
    function.assigned.iter().filter_map(of).collect()
}

/// The names of the document and those that a function gives its scalars.
fn names_in(function: &Reading, lexis: &Lexis) -> Vocabulary {
    function.assigned.iter().fold(lexis.names.clone(), |names, a| match &a.value {
        Value::Scalar(cell) if a.name.chars().all(char::is_alphanumeric) => names.alias(&a.name, cell.value),
        _ => names,
    })
}

struct Program<'a> {
    text: &'a str,
    subject: &'a Subject,
    lexis: &'a Lexis,
    number: usize,
    names: Rc<Vocabulary>,
    /// Lengths that the program has as numbers.
    given: Vec<(Symbol, Expr)>,
    /// The functions of the program that are judged.
    functions: &'a [String],
    /// The configuration that comments state.
    at: &'a Configuration,
}

impl Program<'_> {
    /// The last values of variables whose names say what they are.
    fn assigned(&self, function: &Reading) -> Vec<Assertion> {
        let mut found = vec![];
        let determinants = function.assigned.iter().filter(|a| DETERMINANTS.contains(&a.name.as_str()));
        for a in determinants {
            if let (Value::Scalar(cell), Some(wanted)) = (&a.value, self.subject.determinant(Part::Any)) {
                let pieces = vec![self.piece(None, cell, wanted)];
                found.push(self.assertion(&a.name, About::Equation, &a.span, pieces, None));
            }
        }
        for (i, a) in function.assigned.iter().enumerate() {
            let is_last = !function.assigned[i + 1..].iter().any(|b| b.name == a.name);
            // What is returned under that name is judged there.
            let is_returned = function.returned.iter().any(|r| r.name.as_deref() == Some(a.name.as_str()));
            if is_last
                && !is_returned
                && !(is_of_part(function) && matches!(a.name.to_lowercase().as_str(), "x" | "y" | "z"))
                && a.name.contains(|c: char| c.is_ascii_digit() || c == 'x' || c == 'y' || c == 'z')
            {
                found.extend(self.named(&a.name, &a.name, &a.span, &a.value));
            } else if is_last
                && !is_returned
                && (HANDS.contains(&a.name.as_str()) || JACOBIANS.contains(&a.name.as_str()))
                && let Value::Matrix(rows) = &a.value
                && self.moves(rows)
                && !self.is_call_of_own(&a.span)
            {
                // What a script calls so is the hand's.
                found.extend(self.pose(function, &a.name, &a.span, rows));
            }
        }
        found
    }

    /// True for a call of a function of the program, which is judged itself.
    fn is_call_of_own(&self, span: &Range<usize>) -> bool {
        let source = self.text.get(span.clone()).unwrap_or_default();
        let called = source.split_once('(').map_or("", |c| c.0.trim());
        self.functions.iter().any(|f| f == called)
    }

    /// True if a joint occurs.
    fn moves(&self, rows: &[Vec<Cell>]) -> bool {
        let joints = self.subject.joints();
        let symbols = rows.iter().flatten().flat_map(|c| c.value.symbols());
        symbols.into_iter().any(|s| joints.contains(&s.into()))
    }

    fn returned(&self, function: &Reading) -> Vec<Assertion> {
        let mut found = vec![];
        for r in &function.returned {
            let shown = r.name.clone().unwrap_or_else(|| format!("{}(…)", function.name));
            // A name is given back, its formula stands where it got its value.
            let own = |name: &String| function.assigned.iter().rev().find(|a| a.name == *name);
            let span = r.name.as_ref().and_then(own).map_or(&r.span, |a| &a.span);
            let named = r.name.as_ref().and_then(|name| self.named(name, &shown, span, &r.value));
            found.extend(named.or_else(|| match &r.value {
                Value::Matrix(rows) => self.pose(function, &shown, span, rows),
                Value::Scalar(_) => None,
            }));
        }
        found
    }

    /// A variable whose name has a meaning.
    fn named(&self, name: &str, shown: &str, span: &Range<usize>, value: &Value) -> Option<Assertion> {
        match value {
            // A name for another one says nothing.
            Value::Scalar(cell) if cell.value.as_symbol().is_some() => None,
            Value::Scalar(cell) => {
                let axis = ["x", "y", "z"].iter().position(|a| *a == name.to_lowercase());
                let wanted = match axis.filter(|_| self.lexis.names.lookup(name).is_none()) {
                    Some(r) => self.subject.pose().translation.0[r],
                    None => self.lexis.names.lookup(name).filter(|_| self.lexis.is_right(name))?,
                };
                let pieces = vec![self.piece(None, cell, wanted)];
                Some(self.assertion(shown, About::Entry, span, pieces, None))
            }
            Value::Matrix(rows) => {
                let name = self.lexis.lone_name(name, &(0..name.len()))?;
                if name.is_bare() {
                    return None;
                }
                let (matrix, about) = self.lexis.matrix(self.subject, &name)?;
                let pieces = self.compare(rows, &matrix)?;
                Some(self.assertion(shown, About::Matrix(about?), span, pieces, Some(matrix)))
            }
        }
    }

    /// What a function gives back without a telling name: by its shape the hand's pose, rotation, position or Jacobian.
    fn pose(
        &self,
        function: &Reading,
        shown: &str,
        span: &Range<usize>,
        rows: &[Vec<Cell>],
    ) -> Option<Assertion> {
        if is_of_part(function) {
            return None;
        }
        let pose = self.subject.pose();
        let columns = rows.first()?.len();
        let joints = self.subject.description.variables().len();
        let is_jacobian = function.name.to_lowercase().contains("jac") || shown.starts_with('J');
        let hand = Meaning::Frame { of: Reference::Tool, seen_from: Reference::Frame(0) };
        let (matrix, about) = match (rows.len(), columns) {
            (n, m) if is_jacobian && m == joints && n <= 6 => {
                let value = |c: &Cell| Some(in_radians(c.value));
                let values = Matrix(rows.iter().map(|r| r.iter().map(value).collect()).collect());
                let part = match shown {
                    "Jv" | "J_v" | "Jp" | "J_p" => Part::Linear,
                    "Jw" | "J_w" | "Jo" | "J_o" => Part::Angular,
                    _ => Part::Any,
                };
                let told = Told { part, ..Told::default() };
                let (matrix, jacobian) = self.subject.nearest_jacobian(&values, &told)?;
                (matrix, Meaning::Jacobian(jacobian))
            }
            (4, 4) => (Matrix::of(&pose), hand),
            (3, 3) => (Matrix::of_rotation(&pose.rotation), Meaning::Rotation(hand.into())),
            (3, 1) => (Matrix::column(&pose.translation), Meaning::Position),
            _ => return None,
        };
        let pieces = self.compare(rows, &matrix)?;
        Some(self.assertion(shown, About::Matrix(about), span, pieces, Some(matrix)))
    }

    fn compare(&self, rows: &[Vec<Cell>], matrix: &Matrix) -> Option<Vec<Piece>> {
        let mut pieces = vec![];
        for (r, row) in rows.iter().enumerate() {
            for (c, cell) in row.iter().enumerate() {
                let wanted = matrix.entry(r, c)?;
                pieces.push(self.piece(Some((r + 1, c + 1)), cell, wanted));
            }
        }
        Some(pieces)
    }

    /// A computed value against the right one; lengths that the program has as numbers are numbers in both.
    fn piece(&self, place: Option<(usize, usize)>, cell: &Cell, wanted: Expr) -> Piece {
        let value = in_radians(cell.value);
        let joints = self.subject.joints();
        let moves = wanted.symbols().iter().any(|s| joints.contains(&(*s).into()));
        let is_number = moves && value.symbols().is_empty() && is_measured(value);
        if is_number
            && self.at.knows(wanted, self.subject)
            && let Ok(printed) = value.eval(|_| None)
        {
            let half = half_unit(self.text.get(cell.span.clone()).unwrap_or_default());
            let answer = Answer { printed, half, wanted, at: self.at.clone(), constant: Some(value) };
            return Piece::Number { place, span: cell.span.clone(), answer };
        }
        if is_number {
            let errors = vec![Unread::new(cell.span.clone(), Unreadable::NoConfiguration)];
            return Piece::Unreadable { place, span: cell.span.clone(), errors };
        }
        let d = &self.subject.description;
        let uses = |e: Expr| e.symbols().iter().any(|s| d.parameter(*s).is_some());
        let wanted = match uses(value) {
            true => wanted,
            false => wanted.substitute(|s| {
                let given = self.given.iter().rev().find(|g| g.0 == s).map(|g| g.1);
                given.or_else(|| d.exact_value(s))
            }),
        };
        let is_written = value == cell.value && self.text.get(cell.span.clone()).is_some();
        let printed = cell.syntax.clone().filter(|_| is_written);
        Piece::Pair(Pair { place, span: cell.span.clone(), printed, value, wanted, also: vec![] })
    }

    fn assertion(
        &self,
        name: &str,
        about: About,
        span: &Range<usize>,
        pieces: Vec<Piece>,
        whole: Option<Matrix>,
    ) -> Assertion {
        Assertion {
            span: span.clone(),
            name: name.to_string(),
            about,
            pieces,
            remarks: vec![],
            subject: self.number,
            whole,
            names: Some(Rc::clone(&self.names)),
            reference: None,
            spoken: None,
        }
    }
}

/// True for a function whose name says that it is about a part of the arm, not about the hand.
fn is_of_part(function: &Reading) -> bool {
    const PARTS: [&str; 18] = [
        "wrist",
        "elbow",
        "shoulder",
        "knee",
        "ankle",
        "hip",
        "axis",
        "axes",
        "center",
        "centre",
        "poignet",
        "coude",
        "epaule",
        "handgelenk",
        "ellbogen",
        "schulter",
        "muneca",
        "codo",
    ];
    let name = function.name.to_lowercase();
    PARTS.iter().any(|part| name.contains(part))
}
