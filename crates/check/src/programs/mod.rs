//! What straight-line code computes, as claims about the robot: matrices and scalars whose names say what they are, and
//! what a function returns.

mod called;
mod compared;
mod defined;
mod followed;
mod moving;
mod piece;
mod posed;
mod rows;
mod shown;
mod stated;

use super::custom;
use super::directions::parallel_sum;
use super::facts::{About, Meaning};
use super::habits::Habits;
use super::jacobians::{Part, Told};
use super::lexis::Lexis;
use super::lines::lines;
use super::matrix::Matrix;
use super::note::{Unread, Unreadable};
use super::numbers::Configuration;
use super::recognised;
use super::subject::Subject;
use super::walk::{Assertion, Defined, Piece, Walk};
use crate::degrees::{Angles, Turned, code_alone, names_in as words};
use called::{
    as_square, axis_of, determinant_named, given_in, gives_another, is_of_part, is_velocity, joints_taken,
    lacking, names_in, says_inverse, stem, without,
};
use defined::{defined, numbers, unsaid};
use denavit::forward::Reference;
use denavit_reading::code::{Asked, Assigned, Cell, Code, Dialect, Reading, Value, read_blocks};
use denavit_symbolic::parse::ParseError;
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Expr, Symbol, equal};
use followed::{followed, mended_by};
use piece::{angles_open, is_moved};
use posed::Telling;
use rows::row_function;
use shown::Showing;
use stated::{Stated, in_radians};
use std::collections::BTreeMap;
use std::ops::Range;
use std::rc::Rc;

/// What the programs of a document claim.
#[derive(Default)]
pub(super) struct Programs {
    pub assertions: Vec<Assertion>,
    /// What of them could not be read.
    pub refused: Vec<Unread>,
    /// Scalars that they give names.
    pub defined: Vec<Defined>,
    /// What follows from something wrong before.
    pub followed: Vec<Followed>,
    /// Names that get a value with joints in it of which nothing is said, and where.
    pub unsaid: Vec<(Range<usize>, String)>,
    /// Names that get numbers, and that the robot does not have.
    pub numbers: Vec<String>,
    /// Comparisons of tests that are judged, and calls of the robot's functions for these.
    pub tested: Vec<Range<usize>>,
}

/// A claim whose entries are right given what the program computed before.
#[derive(Clone, Debug)]
pub(super) struct Followed {
    /// The claim.
    pub span: Range<usize>,
    /// The claim that it follows from.
    pub by: Range<usize>,
    /// For each entry.
    pub follows: Vec<bool>,
}

/// A program of a document: blocks of one language about one robot, in which names keep their values.
pub(super) struct Source<'a> {
    /// The text as it is.
    pub text: &'a str,
    /// The text with what else is read of it left out.
    pub source: &'a str,
    pub blocks: &'a [Range<usize>],
    /// Where what each block shows may stand outside of it.
    pub outputs: &'a [Range<usize>],
    pub language: Dialect,
    /// The number of the robot.
    pub number: usize,
    /// Functions, or whole programs, that give joints their values.
    pub posed: &'a [Range<usize>],
}

/// The claims of a program, and what of it could not be read.
pub(super) fn assertions(of: &Source<'_>, subject: &Rc<Subject>, habits: &Rc<Habits>) -> Programs {
    let Source { text, source, blocks, language, number, .. } = *of;
    let lexis = &Lexis::new(subject, habits, &Rc::from(text));
    let joints: Vec<Expr> = subject.description.variables().iter().map(|v| v.symbol.into()).collect();
    // `q.pan`: a member with the name of a joint.
    let member = |name: &str| {
        let own = name.split_once('_').map(|n| n.1).filter(|n| n.len() > 1)?;
        lexis.names.lookup(own).filter(|e| subject.joints().contains(e))
    };
    // The components of a load and the rates of joints are known by custom alone.
    let rates = subject.rates();
    let load = |name: &str, e: &Expr| {
        let is_component = name.len() == 2 && name.starts_with(['F', 'f']) && name.ends_with(['x', 'y', 'z']);
        is_component && e.as_symbol().is_some_and(|s| *s.name() == *name) || rates.contains(e)
    };
    let all: String = blocks.iter().filter_map(|b| source.get(b.clone())).collect();
    let turning = stated::turning(subject);
    let in_radians = |name: &str| {
        let found = lexis.names.lookup(name).filter(|e| !lexis.is_by_custom(name) || load(name, e));
        found.or_else(|| member(name))
    };
    let in_degrees =
        |name: &str| in_radians(name).map(|e| if turning.contains(&e) { stated::of_degrees(e) } else { e });
    let stated = Stated::of(&all, subject);
    let joint = |name: &str| {
        let found = lexis.names.lookup(name)?;
        joints.iter().position(|q| *q == found)
    };
    // A component of a load stays one whatever number it has.
    let component = |name: &str, values: &[Expr]| {
        let stem = name.strip_suffix(['x', 'y', 'z'])?;
        let is_load = matches!(stem, "F" | "f") && values.len() == 1 && values[0].symbols().is_empty();
        is_load.then(|| vec![Expr::symbol(name)])
    };
    let told = |name: &str, values: &[Expr]| {
        stated.joints(values, joint(name), name).or_else(|| component(name, values))
    };
    let (mut mended, none) = (BTreeMap::new(), BTreeMap::new());
    let asked =
        Asked { names: &in_radians, joints: &joints, stated: &told, mended: &none, posed: None, own: None };
    let program = code_alone(source, blocks, language);
    let is_angle = |name: &str| lexis.names.lookup(name).is_some_and(|e| turning.contains(&e));
    let mut codes = read_blocks(source, blocks, language, &asked);
    let heads: Vec<Range<usize>> = codes
        .iter()
        .flat_map(|c| &c.functions)
        .filter(|f| !f.name.is_empty())
        .map(|f| f.span.clone())
        .collect();
    let turned = Turned::of(&program, &heads, &is_angle);
    let angles = |f: &Reading| turned.angles(Some(&f.span).filter(|_| !f.name.is_empty()));
    let is_turned = |code: &Code| code.functions.iter().any(|f| angles(f) == Angles::Degrees);
    // Each function with its joints in what it has them in.
    let chosen = |codes: &mut Vec<Code>, asked: Asked<'_>| {
        if codes.iter().any(is_turned) {
            let others = read_blocks(source, blocks, language, &Asked { names: &in_degrees, ..asked });
            for (code, other) in codes.iter_mut().zip(others) {
                let own = |f: &&mut Reading| angles(f) == Angles::Degrees;
                for f in code.functions.iter_mut().filter(own) {
                    let same = other.functions.iter().find(|o| o.span == f.span && o.name == f.name);
                    same.into_iter().for_each(|o| *f = o.clone());
                }
            }
        }
    };
    chosen(&mut codes, asked);
    let meaning: &dyn Fn(&str) -> Option<Expr> =
        if turned.of_all() == Angles::Degrees { &in_degrees } else { &in_radians };
    let asked = Asked { names: meaning, ..asked };
    let mut found = Programs::default();
    let mut comments = Walk::new(text, subject, habits);
    let has_links = !subject.description.rows.is_empty();
    for (code, span) in codes.iter().zip(blocks) {
        let mut places = vec![(span.start, comments.at.clone())];
        for line in lines(text.get(span.clone()).unwrap_or_default()) {
            let line = span.start + line.start..span.start + line.end;
            comments.told_in_comments(&line, language);
            places.push((line.end, comments.at.clone()));
        }
        let Code { functions, rows, refusals, .. } = code;
        // What stands in a function of a row is not refused as another one.
        let of_row = |e: &ParseError| rows.iter().any(|r| r.reading.span.contains(&e.span.start));
        found.refused.extend(refusals.iter().filter(|e| !of_row(e)).cloned().map(Unread::from));
        let convention = subject.description.convention;
        found
            .assertions
            .extend(rows.iter().filter_map(|r| row_function(source, r, convention, number, lexis)));
        if !has_links {
            continue;
        }
        let own: Vec<String> = functions.iter().map(|f| f.name.clone()).filter(|n| !n.is_empty()).collect();
        for function in functions {
            if angles(function) == Angles::Open && is_moved(function, subject) {
                found.refused.push(Unread::new(function.span.clone(), angles_open()));
                continue;
            }
            let names = Rc::new(names_in(function, lexis));
            let before = codes.iter().flat_map(|c| &c.functions);
            let given = before.filter(|f| f.name.is_empty() || f.name == function.name);
            let given = given.flat_map(|f| given_in(f, subject, lexis)).collect();
            let at = &places;
            let program = Program { text: source, subject, lexis, number, names, given, functions: &own, at };
            let count = found.assertions.len();
            let lacking = lacking(function, source, lexis, subject);
            let of_others = |mut a: Assertion| {
                a.pieces.iter_mut().for_each(|p| without(p, &lacking));
                a
            };
            found.assertions.extend(program.assigned(function).into_iter().map(of_others));
            found.assertions.extend(program.returned(function).into_iter().map(of_others));
            let entries = program.entries(function, &found.assertions[count..]);
            found.assertions.extend(entries.into_iter().map(of_others));
            let torques = program.torques_one_by_one(function, &found.assertions[count..]);
            found.assertions.extend(torques.into_iter().map(of_others));
            let judged = found.assertions[count..].to_vec();
            found.assertions.extend(program.recognised(function, &judged));
            found.assertions.extend(program.places(function, &judged));
            if found.assertions.len() == count && !function.returned.is_empty() {
                let why = Unreadable::NothingTold(function.name.clone());
                found.refused.push(Unread::new(function.span.clone(), why));
            }
        }
    }
    if !has_links {
        return found;
    }
    mended.extend(found.assertions.iter().filter_map(mended_by));
    let truth = (!mended.is_empty()).then(|| {
        let asked = Asked { mended: &mended, names: &in_radians, ..asked };
        let mut truth = read_blocks(source, blocks, language, &asked);
        chosen(&mut truth, asked);
        truth
    });
    let right = truth.as_deref().unwrap_or(&codes);
    found.followed = followed(source, &codes, right, &found.assertions);
    let shown = Showing { of, subject, lexis, stated: &stated, meaning, judged: &found.assertions };
    let (outputs, follow) = shown.outputs(&codes, right);
    found.assertions.extend(outputs);
    found.followed.extend(follow);
    found.unsaid = unsaid(&codes, subject);
    found.numbers = numbers(&codes, lexis);
    found.defined = defined(source, &codes, &found.assertions, number);
    let telling = Telling { subject, habits, lexis, functions: of.posed };
    if turned.of_all() == Angles::Open {
        let open = of.posed.iter().map(|span| Unread::new(span.clone(), angles_open()));
        found.refused.extend(open);
        return found;
    }
    posed::solutions(of, &telling, &asked, &mut found);
    compared::tests(of, (subject, lexis), &asked, &mut found);
    found
}

/// `T01` for `T0_1`: a matrix between two frames.
fn joined(name: &str) -> String {
    let parts: Vec<&str> = name.split('_').collect();
    let is_number = |s: &str| s.len() == 1 && s.chars().all(|c| c.is_ascii_digit());
    match parts[..] {
        [first, last] if first.len() == 2 && is_number(&first[1..]) && is_number(last) => {
            format!("{first}{last}")
        }
        _ => name.into(),
    }
}

/// Names that scripts give the hand's pose and Jacobian.
const HANDS: [&str; 4] = ["T", "H", "Tee", "T_ee"];
const JACOBIANS: [&str; 11] = ["J", "Jac", "jac", "Jv", "J_v", "Jp", "J_p", "Jw", "J_w", "Jo", "J_o"];

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
    /// The configurations that comments state, each from a place on.
    at: &'a [(usize, Configuration)],
}

impl Program<'_> {
    /// The last values of variables whose names say what they are.
    fn assigned(&self, function: &Reading) -> Vec<Assertion> {
        let mut found = vec![];
        // `det` alone is that of J if its formula says so.
        let of_jacobian = |a: &&Assigned| {
            let source = self.text.get(a.span.clone()).unwrap_or_default();
            determinant_named(&a.name).is_some()
                && (a.name != "det" || words(source).any(|w| JACOBIANS.contains(&w)))
        };
        let determinants = function.assigned.iter().filter(of_jacobian);
        for a in determinants {
            let part = determinant_named(&a.name).unwrap_or(Part::Any);
            if let (Value::Scalar(cell), Some(wanted)) = (&a.value, self.subject.determinant(part)) {
                let pieces = vec![self.piece(None, cell, wanted)];
                found.push(self.assertion(&a.name, About::Equation, &a.span, pieces, None));
            }
        }
        let of_hand = parallel_sum(self.subject);
        let is_other = |f: &Reading| is_of_part(f) || is_velocity(f);
        for (i, a) in function.assigned.iter().enumerate() {
            let is_last = !function.assigned[i + 1..].iter().any(|b| b.name == a.name);
            // What is returned under that name is judged there.
            let is_returned = function.returned.iter().any(|r| r.name.as_deref() == Some(a.name.as_str()));
            if is_last
                && !is_returned
                && !(is_other(function) && matches!(a.name.to_lowercase().as_str(), "x" | "y" | "z"))
                && a.name.contains(|c: char| c.is_ascii_digit() || c == 'x' || c == 'y' || c == 'z')
            {
                found.extend(self.named(&a.name, &a.name, &a.span, &a.value));
            } else if is_last
                && !is_returned
                && (HANDS.contains(&stem(&a.name)) || JACOBIANS.contains(&stem(&a.name)))
                && let Value::Matrix(rows) = &a.value
                && self.moves(rows)
                && !self.is_call_of_own(&a.span)
            {
                // What a script calls so is the hand's.
                found.extend(self.pose(function, &a.name, &a.span, rows));
            } else if is_last
                && !is_returned
                && let Value::Matrix(rows) = &a.value
                && let Some(torques) = self.torques(&a.name, &a.name, &a.span, rows)
            {
                found.push(torques);
            } else if is_last
                && !is_returned
                && let (Value::Scalar(cell), Some(sum)) = (&a.value, of_hand)
                && (equal(cell.value, sum).is_equal()
                    || equal(cell.value, stated::of_degrees(sum)).is_equal())
            {
                // A name of its own for the angle of the hand.
                let is_plain = equal(cell.value, sum).is_equal();
                let wanted = if is_plain { sum } else { in_radians(stated::of_degrees(sum)) };
                let pieces = vec![self.piece(None, cell, wanted)];
                found.push(self.assertion(&a.name, About::Equation, &a.span, pieces, None));
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

    /// Matrices whose names say nothing, if they are ones of the robot.
    fn recognised(&self, function: &Reading, judged: &[Assertion]) -> Vec<Assertion> {
        let mut found = vec![];
        for (i, a) in function.assigned.iter().enumerate() {
            let Value::Matrix(rows) = &a.value else { continue };
            let is_last = !function.assigned[i + 1..].iter().any(|b| b.name == a.name);
            let is_judged = judged.iter().any(|x| x.span.start < a.span.end && a.span.start < x.span.end);
            if !is_last || is_judged || !self.moves(rows) {
                continue;
            }
            let values = rows.iter().map(|r| r.iter().map(|c| Some(in_radians(c.value))).collect()).collect();
            let printed = Matrix(values);
            let given = |e: Expr| e.substitute(|s| self.given.iter().rev().find(|g| g.0 == s).map(|g| g.1));
            let nearest = recognised::nearest_with(self.subject, &printed, &given);
            let Some(((matrix, about), agreement)) = nearest else { continue };
            // A column that is named by its joint, as others are.
            let column = |m: &Meaning, name: &str| match m {
                Meaning::Column(joint, jacobian) => {
                    let number = name.strip_prefix('J')?.trim_start_matches('_').parse::<usize>().ok()?;
                    (number == *joint).then_some(jacobian.order)
                }
                _ => None,
            };
            let is_column = || {
                let own = column(&about, &a.name);
                let others = found.iter().filter_map(|x: &Assertion| match &x.about {
                    About::Matrix(m) => column(m, &x.name),
                    _ => None,
                });
                own.is_some() && agreement.agreeing > 0 && others.into_iter().any(|o| Some(o) == own)
            };
            if !agreement.is_whole && !is_column() {
                continue;
            }
            if let Some(pieces) = self.compare(rows, &matrix) {
                found.push(self.assertion(&a.name, About::Matrix(about), &a.span, pieces, Some(matrix)));
            }
        }
        found
    }

    /// A variable whose name has a meaning.
    fn named(&self, name: &str, shown: &str, span: &Range<usize>, value: &Value) -> Option<Assertion> {
        match value {
            // A name for another one says nothing.
            Value::Scalar(cell) if cell.value.as_symbol().is_some() => {
                // The force of a slide may be a component of the load.
                let told = self.lexis.names.lookup(&custom::plain(name)).filter(|e| *e == cell.value);
                if let Some(wanted) =
                    told.filter(|_| custom::plain(name) != custom::plain(self.written(cell)))
                {
                    let pieces = vec![self.piece(None, cell, wanted)];
                    return Some(self.assertion(shown, About::Entry, span, pieces, None));
                }
                let axis = ["x", "y", "z"].iter().position(|a| *a == name.to_lowercase())?;
                let wanted = self.subject.pose().translation.0[axis];
                let pieces = vec![self.piece(None, cell, wanted)];
                let is_right = equal(cell.value, wanted).is_equal();
                is_right.then(|| self.assertion(shown, About::Entry, span, pieces, None))
            }
            Value::Scalar(cell) => {
                let axis = ["x", "y", "z"].iter().position(|a| *a == name.to_lowercase());
                let told = axis_of(name)
                    .filter(|_| shown.ends_with("(…)") || self.lexis.names.lookup(name).is_none());
                let wanted = match axis.or(told).filter(|_| self.lexis.names.lookup(name).is_none()) {
                    Some(r) => self.subject.pose().translation.0[r],
                    None => {
                        let plain = custom::plain(name);
                        let own = self.lexis.names.lookup(name).filter(|_| self.lexis.is_right(name));
                        let is_torque = plain.starts_with('τ') && self.lexis.is_right(&plain);
                        own.or_else(|| self.lexis.names.lookup(&plain).filter(|_| is_torque))?
                    }
                };
                let pieces = vec![self.piece(None, cell, wanted)];
                Some(self.assertion(shown, About::Entry, span, pieces, None))
            }
            Value::Matrix(rows) => {
                let name = joined(stem(name));
                let name = self.lexis.lone_name(&name, &(0..name.len()))?;
                if name.is_bare() {
                    return None;
                }
                let (matrix, about) = self.lexis.matrix(self.subject, &name)?;
                let pieces = self.compare(rows, &matrix)?;
                Some(self.assertion(shown, About::Matrix(about?), span, pieces, Some(matrix)))
            }
        }
    }

    /// A cell as it is written.
    fn written(&self, cell: &Cell) -> &str {
        self.text.get(cell.span.clone()).unwrap_or_default().trim()
    }

    /// What a function gives back without a telling name: by its shape the hand's pose, rotation, position or Jacobian.
    fn pose(
        &self,
        function: &Reading,
        shown: &str,
        span: &Range<usize>,
        rows: &[Vec<Cell>],
    ) -> Option<Assertion> {
        if is_of_part(function) || gives_another(function) {
            return None;
        }
        let pose = self.subject.pose();
        let square = as_square(rows, &Matrix::of(&pose), (function, self.text));
        let rows = square.as_deref().unwrap_or(rows);
        let columns = rows.first()?.len();
        let joints = self.subject.description.variables().len();
        let taken = joints_taken(function, self.text, self.lexis, self.subject);
        // Of a part of the joints, or of names that are no joints: another frame, or a transform of any row.
        let own = |rows: &[Vec<Cell>]| -> Vec<Symbol> {
            let symbols = rows.iter().flatten().flat_map(|c| c.value.symbols());
            symbols.filter(|s| self.subject.joints().contains(&(*s).into())).collect()
        };
        let printed = own(rows);
        let hand = Matrix::of(&pose).0.concat();
        let of_hand = hand.iter().flatten().flat_map(|e| e.symbols());
        let mut of_hand = of_hand.filter(|s| self.subject.joints().contains(&(*s).into()));
        let is_jacobian = function.name.to_lowercase().contains("jac") || shown.starts_with('J');
        let is_other = !is_jacobian && rows.len() == 4 && of_hand.any(|s| !printed.contains(&s));
        if is_other && shown.ends_with("(…)") {
            let values = rows.iter().map(|r| r.iter().map(|c| Some(in_radians(c.value))).collect()).collect();
            let ((matrix, about), agreement) = recognised::nearest(self.subject, &Matrix(values))?;
            let pieces = self.compare(rows, &matrix).filter(|_| agreement.is_whole)?;
            return Some(self.assertion(shown, About::Matrix(about), span, pieces, Some(matrix)));
        }
        let hand = Meaning::Frame { of: Reference::Tool, seen_from: Reference::Frame(0) };
        let (matrix, about) = match (rows.len(), columns) {
            (n, m) if is_jacobian && 1 < m && m <= joints && n <= 6 => {
                let value = |c: &Cell| Some(in_radians(c.value));
                let values = Matrix(rows.iter().map(|r| r.iter().map(value).collect()).collect());
                let part = match stem(shown) {
                    "Jv" | "J_v" | "Jp" | "J_p" => Part::Linear,
                    "Jw" | "J_w" | "Jo" | "J_o" => Part::Angular,
                    _ => Part::Any,
                };
                let nearest = |values: &Matrix| match m == joints {
                    true => {
                        let told = Told { part, ..Told::default() };
                        self.subject.nearest_jacobian(values, &told, &Configuration::default())
                    }
                    false => self.jacobian_of(values, &taken, m),
                };
                match says_inverse(function, shown) {
                    false => nearest(&values).map(|(matrix, j)| (matrix, Meaning::Jacobian(j)))?,
                    true => {
                        let (matrix, jacobian) = nearest(&values.inverse()?)?;
                        (matrix.inverse()?, Meaning::Inverse(Meaning::Jacobian(jacobian).into()))
                    }
                }
            }
            // A part of a Jacobian is no pose.
            _ if is_jacobian => return None,
            (4, 4) => (Matrix::of(&pose), hand),
            (3, 3) => (Matrix::of_rotation(&pose.rotation), Meaning::Rotation(hand.into())),
            (3, 1) => match self.other_vector(rows) {
                Some(found) => found,
                None => (Matrix::column(&pose.translation), Meaning::Position),
            },
            // A place, and the angle of the hand about axes that are parallel.
            (4, 1) => {
                let mut column = Matrix::column(&pose.translation);
                column.0.push(vec![Some(parallel_sum(self.subject)?)]);
                (column, Meaning::Position)
            }
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
