//! What formulas are about: a robot, its frames, and what people call its quantities.

use super::counted;
use super::facts::Meaning;
use super::habits::Habits;
use super::matrix::Matrix;
use super::names::{Index, Name, index, pair};
use denavit::description::{Convention, Description, JointKind, Measure, Screw};
use denavit::forward::Reference;
use denavit::geometry::{Axis, Rotation, Transform, Vector};
use denavit::robot::Robot;
use denavit::velocity::{Viewpoint, geometric};
use denavit_symbolic::vocabulary::{Vocabulary, plain_name};
use denavit_symbolic::{Angle, Expr, Rational, Symbol, greek};
use std::cell::RefCell;
use std::collections::BTreeMap;

/// A robot as formulas name it.
#[derive(Clone, Debug)]
pub(super) struct Subject {
    pub description: Description,
    /// The line of its table in the document.
    pub line: Option<usize>,
    /// The letters of the table for the lengths along x and z.
    pub letters: [String; 2],
    /// What the table calls the joint variables.
    pub variables: Vec<Option<String>>,
    /// The index of lengths along x and of α is that of the row before.
    pub previous: bool,
    /// The number of the frame before the first row, where the rows are not numbered from 1.
    pub first: usize,
    /// What a document prints in place of what the robot gives.
    printed: Printed,
    robot: Robot<Expr>,
    q: Vec<Expr>,
    /// Determinants that were asked for, by the number of their part.
    pub determinants: Known,
}

/// What is known of one subject, and of no other that is made from it.
#[derive(Debug, Default)]
pub(super) struct Known(pub RefCell<Vec<(usize, Option<Expr>)>>);

impl Clone for Known {
    fn clone(&self) -> Self {
        Known::default()
    }
}

/// Frames and entries of the pose as an author has them.
#[derive(Clone, Debug, Default)]
struct Printed {
    /// The second in the first.
    frames: BTreeMap<(usize, usize), Transform<Expr>>,
    /// Entries of the pose, row and column from 0.
    entries: BTreeMap<(usize, usize), Expr>,
}

/// How the name of a variable may be spelled: as its table has it, and with a Greek letter for its word.
pub(super) fn spellings(printed: &str) -> impl Iterator<Item = String> {
    let plain = plain_name(printed);
    let stem = plain.trim_end_matches(|c: char| c.is_ascii_digit());
    let greek = greek::letter(stem).map(|letter| format!("{letter}{}", &plain[stem.len()..]));
    [printed.to_string()].into_iter().chain(greek)
}

/// The words that a robot's file has for its joints, which formulas may take for their variables: `shoulder_pan` of
/// `shoulder_pan_joint`. Shorter names are those of lengths, too.
fn joint_words(d: &Description) -> Vec<Option<String>> {
    const LETTERS: usize = 3;
    let word = |name: &str| {
        let word = name.strip_suffix("_joint").unwrap_or(name);
        let letters = word.chars().take_while(|c| c.is_alphabetic()).count();
        let is_word = letters >= LETTERS && word.chars().all(|c| c.is_alphanumeric() || c == '_');
        is_word.then(|| word.to_string())
    };
    let moving = d.rows.iter().filter(|r| r.variable.is_some());
    moving.map(|r| r.name.as_deref().and_then(word)).collect()
}

/// The most rows of a table whose formulas are checked.
const MAX_ROWS: usize = 30;

impl Subject {
    /// A robot whose lengths have the letters of its convention.
    pub fn new(description: Description) -> Option<Self> {
        let convention = description.convention;
        let variables = joint_words(&description);
        Subject::printed(
            description,
            [convention.length_x(), convention.length_z()].map(String::from),
            variables,
            convention == Convention::Craig,
        )
    }

    /// A robot with the letters that its table has in print; `previous` if α and the length along x have the index of
    /// the row before.
    pub fn printed(
        description: Description,
        letters: [String; 2],
        variables: Vec<Option<String>>,
        previous: bool,
    ) -> Option<Self> {
        if description.rows.len() > MAX_ROWS {
            return None;
        }
        let robot = Robot::symbolic(&description);
        let q = description.variables().iter().map(|v| v.symbol.into()).collect();
        let printed = Printed::default();
        let determinants = Known::default();
        Some(Subject {
            description,
            line: None,
            letters,
            variables,
            previous,
            first: 0,
            printed,
            robot,
            q,
            determinants,
        })
    }

    /// The same with another table.
    pub fn with(&self, description: Description) -> Self {
        let robot = Robot::symbolic(&description);
        Subject { description, robot, ..self.clone() }
    }

    /// The same with its lengths in another unit: so many of them are one of those before.
    pub fn in_unit(&self, factor: &Rational) -> Self {
        let mut d = self.description.clone();
        let (up, down) = (Expr::from(factor.clone()), Expr::int(1) / Expr::from(factor.clone()));
        let sliding: Vec<Symbol> =
            d.variables().iter().filter(|v| v.kind == JointKind::Prismatic).map(|v| v.symbol).collect();
        let lengths: Vec<Symbol> =
            d.parameters.iter().map(|p| p.symbol).filter(|s| d.measure(*s) == Measure::Length).collect();
        let scaled = |e: Expr| {
            let is_length = |s: Symbol| lengths.contains(&s) || sliding.contains(&s);
            let there = e.substitute(|s| is_length(s).then(|| Expr::from(s) * down));
            let angle = Angle::of(there * up);
            // A sum of symbols and numbers is written as such.
            if angle.terms.iter().all(|(e, _)| e.as_symbol().is_some()) {
                angle.to_expr()
            } else {
                there * up
            }
        };
        for row in &mut d.rows {
            (row.a, row.d, row.b) = (scaled(row.a), scaled(row.d), scaled(row.b));
        }
        for p in &mut d.parameters {
            p.value = p.value.map(|v| if lengths.contains(&p.symbol) { v * up } else { v });
        }
        for x in [&mut d.base, &mut d.tool] {
            x.translation = Vector(x.translation.0.map(scaled));
        }
        self.with(d)
    }

    /// The arm of the first rows alone.
    pub fn first_rows(&self, rows: usize) -> Self {
        let mut d = self.description.clone();
        if rows < d.rows.len() {
            d.rows.truncate(rows);
            d.tool = Transform::identity();
        }
        let q = d.variables().iter().map(|v| v.symbol.into()).collect();
        Subject { q, ..self.with(d) }
    }

    /// The number of the last frame.
    pub fn last(&self) -> usize {
        self.robot.links.len()
    }

    /// Frame `to` in frame `from`, by the product of the link transforms between; `None` stands for the tool.
    pub fn transform(&self, from: Option<usize>, to: Option<usize>) -> Option<Transform<Expr>> {
        let n = self.last();
        let (i, j) = (from.unwrap_or(n), to.unwrap_or(n));
        if i > n || j > n {
            return None;
        }
        let between = |i: usize, j: usize| self.between(i, j);
        let mut x = if i <= j { between(i, j) } else { between(j, i).inverse() };
        if from.is_none() {
            x = self.robot.tool.inverse() * x;
        }
        if to.is_none() {
            x = x * self.robot.tool;
        }
        Some(x)
    }

    /// Frame `j` in a frame `i` before it, by what an author prints where that is known.
    fn between(&self, i: usize, j: usize) -> Transform<Expr> {
        let mut x = Transform::identity();
        let mut k = i;
        while k < j {
            let printed = self.printed.frames.range((k, k + 1)..=(k, j)).next_back();
            match printed {
                Some(((_, to), frame)) => {
                    x = x * *frame;
                    k = *to;
                }
                None => {
                    x = x * self.robot.links[k].transform(&self.q);
                    k += 1;
                }
            }
        }
        x
    }

    /// The joint variables.
    pub fn joints(&self) -> &[Expr] {
        &self.q
    }

    /// True if an author's own frames or entries stand for those of the robot.
    pub fn is_printed(&self) -> bool {
        !self.printed.frames.is_empty() || !self.printed.entries.is_empty()
    }

    /// The same with a frame in another as an author has it.
    pub fn with_frame(&self, from: usize, to: usize, frame: Transform<Expr>) -> Self {
        let mut subject = self.clone();
        subject.printed.frames.insert((from, to), frame);
        subject
    }

    /// The same with an entry of the pose as an author has it.
    pub fn with_entry(&self, row: usize, column: usize, value: Expr) -> Self {
        let mut subject = self.clone();
        subject.printed.entries.insert((row, column), value);
        subject
    }

    /// The base, or frame 0 where that is the same.
    pub fn ground(&self) -> Reference {
        if self.robot.base == Transform::identity() { Reference::Frame(0) } else { Reference::Base }
    }

    /// The tool in the base, which frame 0 is where the robot says nothing else.
    pub fn pose(&self) -> Transform<Expr> {
        let pose = self.transform(Some(0), None).unwrap_or_else(Transform::identity);
        let pose = self.robot.base * pose;
        if self.printed.entries.is_empty() {
            return pose;
        }
        let (mut rows, mut position) = (pose.rotation.rows(), pose.translation);
        for (&(r, c), &value) in &self.printed.entries {
            match c {
                0..3 => rows[r][c] = value,
                _ => position.0[r] = value,
            }
        }
        Transform::from_rotation_translation(Rotation::from_rows(rows), position)
    }

    /// A frame in the base.
    pub fn placed(&self, frame: usize) -> Option<Transform<Expr>> {
        Some(self.robot.base * self.transform(Some(0), Some(frame))?)
    }

    /// The origin of a frame in the base.
    pub fn origin(&self, frame: usize) -> Vector<Expr> {
        let x = self.transform(Some(0), Some(frame)).unwrap_or_else(Transform::identity);
        (self.robot.base * x).translation
    }

    /// The rows of the geometric Jacobian of the hand's point at the origin of a frame, linear first.
    pub fn geometric_rows_at(&self, at: Reference, along: Reference) -> Vec<Vec<Expr>> {
        let view = Viewpoint { at, ..Viewpoint::of(Reference::Tool, along) };
        geometric(&self.robot, &self.q, &view).rows().iter().map(|row| row.to_vec()).collect()
    }

    /// The rows of the geometric Jacobian, linear first.
    pub fn geometric_rows(&self, body: Reference, along: Reference) -> Vec<Vec<Expr>> {
        if !self.is_printed() {
            let rows = geometric(&self.robot, &self.q, &Viewpoint::of(body, along)).rows();
            return rows.iter().map(|row| row.to_vec()).collect();
        }
        // By the frames as the author has them.
        let is_first = self.description.convention.begins_with_joint();
        let moving = (0..).zip(&self.description.rows).filter_map(|(k, row)| Some((k, row.variable?)));
        let frames: Vec<(Transform<Expr>, bool)> = moving
            .filter_map(|(k, v)| {
                let frame = self.transform(Some(0), Some(if is_first { k } else { k + 1 }))?;
                Some((frame, v.kind == JointKind::Revolute))
            })
            .collect();
        let (frames, is_revolute): (Vec<_>, Vec<_>) = frames.into_iter().unzip();
        let hand = match body {
            Reference::Frame(k) if k < self.last() => self.transform(Some(0), Some(k)),
            _ => Some(self.pose()),
        };
        of_frames(&frames, &hand.unwrap_or_else(Transform::identity), &is_revolute)
    }

    /// The names of the robot's quantities: parameters, joint variables, the table's own names for them, cells of
    /// the table (`d_3`), sums of angles (`θ_{234}`), the letters of a general row (`θ_j`).
    pub fn vocabulary(&self) -> Vocabulary {
        let d = &self.description;
        let variables = d.variables();
        let numbers = if self.first == 0 { counted::numbers(&self.variables, &variables) } else { None };
        let mut names = match &numbers {
            None => d.vocabulary(),
            Some(all) => {
                let names = d.parameters.iter().fold(Vocabulary::new(), |v, p| v.symbol(&p.symbol.name()));
                all.iter().zip(&variables).fold(names, |v, (n, variable)| {
                    match (n.and_then(|n| u32::try_from(n).ok()), variable.kind) {
                        (Some(n), JointKind::Revolute) => v.angle(n, variable.symbol),
                        (Some(n), JointKind::Prismatic) => v.sliding(n, variable.symbol),
                        (None, _) => v,
                    }
                })
            }
        };
        let declare = |names: Vocabulary, name: &str, meaning: Expr| match names.lookup(name) {
            None => names.alias(name, meaning),
            Some(_) => names,
        };
        for (variable, printed) in variables.iter().zip(&self.variables) {
            if let Some(printed) = printed {
                for name in spellings(printed) {
                    names = declare(names, &name, variable.symbol.into());
                    // `sa`, `ca` beside the angle a.
                    if variable.kind == JointKind::Revolute && name.chars().count() == 1 {
                        let (sine, cosine) = Expr::from(variable.symbol).sin_cos();
                        names = declare(names, &format!("s{name}"), sine);
                        names = declare(names, &format!("c{name}"), cosine);
                    }
                }
            }
        }
        for (n, v) in (self.first + 1..).zip(&variables).filter(|_| self.first > 0) {
            if v.kind == JointKind::Revolute {
                names = names.angle(u32::try_from(n).unwrap_or(0), v.symbol);
            }
        }
        let first = i32::try_from(self.first).unwrap_or(0);
        for (i, row) in (first + 1..).zip(&d.rows) {
            let k = i - i32::from(self.previous);
            for (letter, cell, i) in [(&self.letters[0], row.a, k), (&self.letters[1], row.d, i)] {
                let cell = match row.variable {
                    Some(v) if v.kind == JointKind::Prismatic && *letter == self.letters[1] => {
                        v.symbol.into()
                    }
                    _ => cell,
                };
                names = declare(names, &format!("{letter}{i}"), cell);
            }
            names = declare(names, &format!("α{k}"), row.alpha);
            let theta = match row.variable {
                Some(v) if v.kind == JointKind::Revolute => v.symbol.into(),
                _ => row.theta,
            };
            if numbers.is_some() {
                continue;
            }
            names = declare(names, &format!("θ{i}"), theta);
        }
        let counted: Vec<Option<usize>> =
            numbers.unwrap_or_else(|| (self.first + 1..).map(Some).take(variables.len()).collect());
        let angles: Vec<(usize, Symbol)> = counted
            .into_iter()
            .zip(&variables)
            .filter_map(|(n, v)| Some((n.filter(|n| *n <= 9)?, v)))
            .filter(|(_, v)| v.kind == JointKind::Revolute)
            .map(|(n, v)| (n, v.symbol))
            .collect();
        for start in 0..angles.len() {
            let (mut digits, mut sum) = (angles[start].0.to_string(), Expr::from(angles[start].1));
            for (number, symbol) in &angles[start + 1..] {
                digits.push_str(&number.to_string());
                sum = sum + (*symbol).into();
                let is_t = self
                    .variables
                    .iter()
                    .flatten()
                    .any(|v| v.starts_with('t') && v[1..].parse::<usize>().is_ok());
                for letter in ["θ", "th", "q", "t"].into_iter().filter(|l| *l != "t" || is_t) {
                    names = declare(names, &format!("{letter}{digits}"), sum);
                }
            }
        }
        for index in ["i", "j", "n"] {
            for letter in ["θ", "α", &self.letters[0], &self.letters[1]] {
                let name = format!("{letter}{index}");
                names = declare(names, &name, Expr::symbol(&name));
            }
        }
        names
    }

    /// The transform of row `j` of any table of this convention, in the document's letters.
    pub fn general_link(&self, index: char) -> Transform<Expr> {
        let symbol = |letter: &str| Expr::symbol(&format!("{letter}{index}"));
        let (theta, alpha) = (symbol("θ"), symbol("α"));
        let (x, z) = (symbol(&self.letters[0]), symbol(&self.letters[1]));
        let screw_z = Screw { axis: Axis::Z, angle: theta, length: z }.transform();
        let screw_x = Screw { axis: Axis::X, angle: alpha, length: x }.transform();
        match self.description.convention.begins_with_joint() {
            true => screw_z * screw_x,
            false => screw_x * screw_z,
        }
    }

    /// `{}^iω_j` and `{}^iv_j`: how frame j moves, along the axes of frame i.
    fn velocity_named(&self, name: &Name) -> Option<(Matrix, Meaning)> {
        let is_angular = match name.base.as_str() {
            "ω" | "Ω" => true,
            "v" | "V" => false,
            _ => return None,
        };
        if !name.sup.is_empty() || !name.arguments.is_empty() {
            return None;
        }
        let place = |s: &str| s.parse::<usize>().ok()?.checked_sub(self.first).filter(|k| *k <= self.last());
        let [of, along] = [place(&name.sub)?, place(&name.left)?].map(Reference::Frame);
        let rates = self.rates();
        let first = if is_angular { 3 } else { 0 };
        let rows = self.geometric_rows(of, along);
        let sum =
            |row: &Vec<Expr>| row.iter().zip(&rates).fold(Expr::int(0), |sum, (&e, &rate)| sum + e * rate);
        let entries = rows.get(first..first + 3)?.iter().map(|row| vec![Some(sum(row))]).collect();
        Some((Matrix(entries), Meaning::Velocity { of, along, is_angular }))
    }

    /// What a matrix's name means, and what that is.
    /// Frames named by letters, `{}^iT_j`, are somewhere if `anywhere`, and have no meaning otherwise.
    pub fn meaning(&self, name: &Name, anywhere: bool, habits: &Habits) -> Option<(Matrix, Meaning)> {
        if let Some(found) = self.velocity_named(name) {
            return Some(found);
        }
        let (from, to) = frames(name, habits)?;
        let is_lone = name.left.is_empty() && name.sup.is_empty() && pair(&name.sub).is_none();
        let is_seen = habits.hand_in_frames && is_lone && matches!(name.base.as_str(), "P" | "p");
        let (from, to) = match &to {
            Index::Number(_) if is_seen => (to, Index::End),
            _ => (from, to),
        };
        let place = |i: &Index| match i {
            Index::Number(k) => k.checked_sub(self.first).map(Some),
            Index::End => Some(None),
            Index::Letter('n', 0) => Some(Some(self.last())),
            Index::Letter(..) => None,
        };
        // Letters for the base and the hand: `T_{BE}`, `T_{sb}`, `T_e^b`.
        let is_base = |i: &Index| matches!(i, Index::Letter('s' | 'S' | 'b' | 'B' | 'w' | 'W', 0));
        let is_hand = |i: &Index| matches!(i, Index::End | Index::Letter('b' | 't' | 'T', 0));
        let is_space = matches!(from, Index::Letter('s' | 'S', 0));
        let hand = matches!(to, Index::End) || is_hand(&to) && (is_space || !is_base(&to));
        let (from, to) = match () {
            () if is_base(&from) && hand && from != to => (Index::Number(self.first), Index::End),
            () if is_base(&to) && from == Index::End => (Index::End, Index::Number(self.first)),
            () => (from, to),
        };
        let (transform, frame) = match (&from, &to) {
            (Index::Letter(i, a), Index::Letter(j, b)) if i == j && (b - a).abs() == 1 && *b.max(a) == 0 => {
                let link = self.general_link(*j);
                let link = if b > a { link } else { link.inverse() };
                (link, Meaning::Row)
            }
            (Index::Letter(i, 0), Index::Letter(j, 0)) if anywhere && i != j && *i != 'n' && *j != 'n' => {
                (between(*i, *j), Meaning::AnyFrame { of: *j, seen_from: *i })
            }
            _ => {
                let (i, j) = (place(&from)?, place(&to)?);
                let is_hand = [&name.left, &name.sub, &name.sup].iter().all(|s| s.is_empty());
                let found = self.transform(i, j)?;
                let is_base = habits.zero_is_base && i == Some(0);
                let found = if is_hand || is_base { self.robot.base * found } else { found };
                (found, Meaning::Frame { of: frame(j), seen_from: frame(i) })
            }
        };
        Some(match name.base.as_str() {
            "T" | "A" | "H" | "M" => (Matrix::of(&transform), frame),
            "R" => (Matrix::of_rotation(&transform.rotation), Meaning::Rotation(frame.into())),
            "Z" | "z" => (Matrix::column(&transform.rotation.z()), Meaning::Axis(Axis::Z, frame.into())),
            "P" | "p" | "O" | "Ω" | "o" => {
                (Matrix::column(&transform.translation), Meaning::Origin(frame.into()))
            }
            _ => return None,
        })
    }
}

/// Any frame in any other.
fn between(i: char, j: char) -> Transform<Expr> {
    let (a, b) = (i.min(j), i.max(j));
    let symbol = |what: &str| Expr::symbol(&format!("{what} of {b} in {a}"));
    let rotation = Rotation::from_rpy(symbol("roll"), symbol("pitch"), symbol("yaw"));
    let position = Vector([symbol("x"), symbol("y"), symbol("z")]);
    let x = Transform::from_rotation_translation(rotation, position);
    if i < j { x } else { x.inverse() }
}

/// A frame by its number; `None` stands for the tool.
fn frame(number: Option<usize>) -> Reference {
    number.map_or(Reference::Tool, Reference::Frame)
}

/// From which frame to which a name leads.
pub(super) fn frames(name: &Name, habits: &Habits) -> Option<(Index, Index)> {
    let (from, to) = indices(name, habits)?;
    let is_pair = !matches!((name.left.as_str(), name.sup.as_str()), ("", "")) || pair(&name.sub).is_some();
    Some(if habits.exchanged && is_pair { (to, from) } else { (from, to) })
}

/// The indices of a name: that of the frame in which it is seen first.
fn indices(name: &Name, habits: &Habits) -> Option<(Index, Index)> {
    let base = Index::Number(0);
    let is_vector = matches!(name.base.as_str(), "Z" | "z" | "O" | "Ω" | "P" | "p" | "o");
    if !is_vector && !matches!(name.base.as_str(), "T" | "A" | "H" | "M" | "R") {
        return None;
    }
    match (name.left.as_str(), name.sub.as_str(), name.sup.as_str()) {
        ("", "", "") if matches!(name.base.as_str(), "T" | "R") => Some((base, Index::End)),
        ("", "", _) => None,
        ("", sub, "") => match pair(sub) {
            Some(found) if !is_vector => Some(found),
            _ => {
                let to = index(sub)?;
                let from = match (&to, name.base.as_str()) {
                    (Index::Number(k), "T" | "R") if habits.links => Index::Number(k.checked_sub(1)?),
                    (Index::Number(k), "A" | "H" | "M") => Index::Number(k.checked_sub(1)?),
                    (Index::Letter(j, k), "A" | "H" | "M" | "T") => Index::Letter(*j, k - 1),
                    (Index::End, "A" | "H" | "M") => return None,
                    _ => base,
                };
                Some((from, to))
            }
        },
        ("", sub, sup) => Some((index(sup)?, index(sub)?)),
        (left, sub, "") => Some((index(left)?, index(sub)?)),
        _ => None,
    }
}

/// `Rot(x, θ)`, `Trans(a, b, c)`, `R_z(θ)`, with arguments read by `value`.
pub(super) fn elementary(name: &Name, value: &dyn Fn(&str) -> Option<Expr>) -> Option<(Matrix, Meaning)> {
    let axis = |text: &str| match text.trim_matches(['\\', '{', '}', ' ']) {
        "x" | "X" => Some(Axis::X),
        "y" | "Y" => Some(Axis::Y),
        "z" | "Z" => Some(Axis::Z),
        _ => None,
    };
    let is_turn = matches!(name.base.as_str(), "Rot" | "rot" | "R");
    let along = |axis: Axis, d: Expr| match axis {
        Axis::X => Transform::translation_x(d),
        Axis::Y => Transform::translation_y(d),
        Axis::Z => Transform::translation_z(d),
    };
    let (about, argument) = match (&name.arguments[..], axis(&name.sub)) {
        ([argument], Some(about)) => (about, argument),
        ([about, argument], None) if name.sub.is_empty() => (axis(about)?, argument),
        ([x, y, z], None) if matches!(name.base.as_str(), "Trans" | "trans") => {
            let x = Transform::translation(value(x)?, value(y)?, value(z)?);
            return Some((Matrix::of(&x), Meaning::Translation));
        }
        _ => return None,
    };
    let value = value(argument)?;
    match name.base.as_str() {
        _ if is_turn => {
            let x = Transform::rotation_about(about, value);
            Some((Matrix::of(&x), Meaning::RotationAbout(about)))
        }
        "Trans" | "trans" => Some((Matrix::of(&along(about, value)), Meaning::TranslationAlong(about))),
        _ => None,
    }
}

/// The cross products and axes of the joints by frames as an author has them: row by row, linear first.
fn of_frames(frames: &[Transform<Expr>], hand: &Transform<Expr>, is_revolute: &[bool]) -> Vec<Vec<Expr>> {
    let mut rows = vec![vec![]; 6];
    for (x, is_revolute) in frames.iter().zip(is_revolute) {
        let axis = x.rotation.z();
        let (linear, angular) = match is_revolute {
            true => (axis.cross(hand.translation - x.translation), axis),
            false => (axis, Vector([Expr::int(0); 3])),
        };
        for r in 0..3 {
            rows[r].push(linear.0[r]);
            rows[3 + r].push(angular.0[r]);
        }
    }
    rows
}
