//! What the names of a document mean at a place of it: the robot's quantities, and what was defined further up.

use super::custom;
use super::facts::Meaning;
use super::habits::{Habits, Places, named_signs, pose_symbol};
use super::jacobians;
use super::matrix::Matrix;
use super::names::{Name, Token, tokens};
use super::subject::{Subject, elementary};
use denavit::geometry::orientation::OrientationSet;
use denavit_reading::document::formula;
use denavit_symbolic::parse::{ParseError, Syntax, parse_syntax};
use denavit_symbolic::readable::literals;
use denavit_symbolic::vocabulary::{Vocabulary, plain_name};
use denavit_symbolic::{Expr, Node, Symbol};
use std::cell::Cell;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::rc::Rc;

/// No more names are kept.
const MAX_NAMES: usize = 2_000;
/// Names for longer formulas are not kept.
const MAX_LITERALS: u64 = 20_000;
/// Names for longer numbers are not kept.
const MAX_NUMBER_BITS: u64 = 4_096;
/// The axes of coordinates.
const AXES: [&str; 3] = ["x", "y", "z"];

/// Names and their meanings.
#[derive(Clone)]
pub(super) struct Lexis {
    /// Entries of the pose stand for what the robot makes them.
    pub names: Vocabulary,
    /// Entries of the pose are symbols.
    pub inverse: Vocabulary,
    pub habits: Rc<Habits>,
    /// What the names of the whole document are looked for in.
    text: Rc<str>,
    /// Names that the robot gives their meaning, not the document.
    right: BTreeSet<String>,
    /// Those that have it by custom only.
    by_custom: BTreeSet<String>,
    matrices: BTreeMap<String, (Matrix, Option<Meaning>)>,
    scalars: Vec<(String, Expr)>,
    /// Sines and cosines of sums of joints, by what the document finds them from the pose.
    sines: Vec<(String, Expr)>,
    /// Matrices of the document in the entries of the pose as symbols.
    posed: BTreeMap<String, Matrix>,
    /// Frames named by letters are anywhere.
    pub anywhere: Cell<bool>,
    /// The pose is one of symbols.
    pub is_posed: Cell<bool>,
}

impl Lexis {
    /// The names of a robot in a document whose pose has these columns.
    pub fn new(subject: &Subject, habits: &Rc<Habits>, text: &Rc<str>) -> Self {
        let names = subject.vocabulary().degrees(true);
        let columns = habits.columns;
        let mut lexis = Lexis {
            inverse: names.clone(),
            names,
            habits: Rc::clone(habits),
            text: Rc::clone(text),
            right: BTreeSet::new(),
            by_custom: BTreeSet::new(),
            matrices: BTreeMap::new(),
            scalars: vec![],
            sines: vec![],
            posed: BTreeMap::new(),
            anywhere: Cell::new(false),
            is_posed: Cell::new(false),
        };
        if subject.last() == 0 {
            return lexis;
        }
        let pose = subject.pose().matrix();
        lexis.by_custom.extend(AXES.iter().flat_map(|a| [a.to_string(), a.to_uppercase()]));
        lexis.by_custom.retain(|name| lexis.names.lookup(name).is_none());
        let has_place = custom::has_place(text);
        for (r, axis) in AXES.iter().enumerate() {
            lexis.declare(axis, pose[r][3], pose_symbol(columns, r, 3).into());
            // Beside p_x another X is the author's own.
            if !has_place {
                lexis.declare(&axis.to_uppercase(), pose[r][3], pose_symbol(columns, r, 3).into());
            }
        }
        let (calls_entries, names_entries) = (custom::calls_entries(text), custom::names_entries(text));
        let wrist = habits.wrist_entries.then(|| custom::wrist_frame(subject, &Places(columns))).flatten();
        for (r, axis) in AXES.iter().enumerate() {
            for (c, letter) in columns.letters().iter().enumerate() {
                let symbol = pose_symbol(columns, r, c);
                let mut spellings = vec![format!("{letter}{axis}")];
                if *letter == "p" {
                    spellings.push(format!("P{axis}"));
                }
                for spelling in spellings {
                    lexis.declare(&spelling, pose[r][c], symbol.into());
                }
                let name = format!("r{}{}", r + 1, c + 1);
                match wrist.as_ref().filter(|_| c < 3) {
                    Some((x, y)) => lexis.declare(&name, x.matrix()[r][c], y.matrix()[r][c]),
                    None => lexis.declare(&name, pose[r][c], symbol.into()),
                };
                if !calls_entries {
                    lexis.declare(&format!("t{}{}", r + 1, c + 1), pose[r][c], symbol.into());
                }
                if c < 3 && names_entries {
                    lexis.declare(&format!("R{}{}", r + 1, c + 1), pose[r][c], symbol.into());
                }
                for matrix in ["T", "R"] {
                    lexis.declare(&format!("{matrix}({},{})", r + 1, c + 1), pose[r][c], symbol.into());
                }
            }
        }
        for (name, sign) in named_signs(&custom::plain(text).replace(['$', '\u{200b}'], "")) {
            if lexis.names.lookup(&name).is_none() {
                lexis.names = std::mem::take(&mut lexis.names).alias(&name, sign);
                lexis.inverse = std::mem::take(&mut lexis.inverse).alias(&name, sign);
            }
        }
        if let Some(torques) = custom::torque_column(subject, text, habits) {
            let name = Name { base: "τ".into(), ..Name::default() };
            lexis.matrices.insert(name.key(), (torques, Some(Meaning::Torques)));
        }
        for custom in custom::names(subject, text, habits) {
            if lexis.declare(&custom.name, custom.meaning, custom.inverse) {
                lexis.by_custom.insert(plain_name(&custom.name));
            }
        }
        lexis
    }

    /// The names of another robot, with what the document has defined so far.
    pub fn of(&self, subject: &Subject) -> Self {
        let mut lexis = Lexis::new(subject, &self.habits, &self.text);
        for (name, meaning) in &self.scalars {
            if lexis.names.lookup(name).is_none() {
                lexis.define(name, *meaning);
            }
        }
        lexis
    }

    /// The same names about a robot whose pose is another.
    pub fn posed(&self, subject: &Subject) -> Self {
        let mut lexis = self.of(subject);
        lexis.matrices = self.matrices.clone();
        lexis
    }

    /// A name that the robot gives its meaning, unless the name is taken, or a helper by the habits of the document.
    fn declare(&mut self, name: &str, meaning: Expr, in_inverse: Expr) -> bool {
        let is_free = self.names.lookup(name).is_none() && !self.habits.helpers.contains(&plain_name(name));
        if is_free {
            self.names = std::mem::take(&mut self.names).alias(name, meaning);
            self.inverse = std::mem::take(&mut self.inverse).alias(name, in_inverse);
            self.right.insert(plain_name(name));
        }
        is_free
    }

    /// True for a name that the document has defined by a formula.
    pub fn is_helper(&self, name: &str) -> bool {
        let plain = plain_name(name);
        !self.right.contains(&plain) && self.scalars.iter().any(|(n, _)| plain_name(n) == plain)
    }

    /// True for a name whose meaning is one by custom only.
    pub fn is_by_custom(&self, name: &str) -> bool {
        let plain = custom::plain(name);
        self.by_custom.contains(&plain) && self.right.contains(&plain)
    }

    /// A name that the document gives its meaning. What is no formula that a person would print is given none:
    /// squares of squares double their numbers each time.
    pub fn define(&mut self, name: &str, meaning: Expr) {
        let factor = match meaning.node() {
            Node::Mul(a, _) | Node::Div(a, _) => a,
            _ => meaning,
        };
        let is_long = factor.as_number().is_some_and(|r| r.bits() > MAX_NUMBER_BITS)
            || literals(meaning) > MAX_LITERALS;
        if is_long || self.scalars.len() >= MAX_NAMES {
            return;
        }
        self.names = std::mem::take(&mut self.names).alias(name, meaning);
        self.inverse = std::mem::take(&mut self.inverse).alias(name, meaning);
        self.right.remove(&plain_name(name));
        self.scalars.push((name.to_string(), meaning));
    }

    /// What a name that the document defines means in inverse formulas.
    pub fn define_inverse(&mut self, name: &str, meaning: Expr) {
        if self.names.lookup(name).is_some() && literals(meaning) <= MAX_LITERALS {
            self.inverse = std::mem::take(&mut self.inverse).alias(name, meaning);
        }
    }

    /// What `s_{234}` is in inverse formulas, where an angle is found before its parts; in print it stays what it is.
    pub fn define_sine(&mut self, name: &str, meaning: Expr) {
        if literals(meaning) <= MAX_LITERALS && self.sines.len() < MAX_NAMES {
            self.sines.retain(|s| s.0 != name);
            self.sines.push((name.to_string(), meaning));
        }
    }

    /// A name for an entry of a matrix that is known from the robot.
    pub fn define_right(&mut self, name: &str, meaning: Expr, in_inverse: Expr) {
        self.define(name, meaning);
        self.inverse = std::mem::take(&mut self.inverse).alias(name, in_inverse);
        self.right.insert(plain_name(name));
    }

    /// A name for a matrix; what it is, if it is known from the robot.
    pub fn define_matrix(&mut self, name: &Name, value: Matrix, about: Option<Meaning>) {
        let is_long = value.0.iter().flatten().flatten().any(|&e| literals(e) > MAX_LITERALS);
        if !is_long && self.matrices.len() < MAX_NAMES {
            self.matrices.insert(name.key(), (value, about));
        }
    }

    /// What a matrix of the document is in the entries of the pose.
    pub fn define_posed(&mut self, name: &Name, value: Matrix) {
        if self.posed.len() < MAX_NAMES {
            self.posed.insert(name.key(), value);
        }
    }

    /// Forgets a transform that the document defines.
    pub fn forget_frame(&mut self, key: &str) {
        let is_frame = |(_, about): &(Matrix, Option<Meaning>)| {
            !matches!(about, Some(Meaning::Jacobian(_) | Meaning::Torques))
        };
        if self.matrices.get(key).is_some_and(is_frame) {
            self.matrices.remove(key);
        }
        self.posed.remove(key);
    }

    /// What a matrix of the document is in the entries of the pose, if that is known.
    pub fn posed_matrix(&self, name: &Name) -> Option<&Matrix> {
        self.posed.get(&name.key())
    }

    /// The names in which inverse formulas are printed.
    pub fn inverse_names(&self) -> Vocabulary {
        let places = (0..3).flat_map(|r| (0..4).map(move |c| (r, c)));
        places.fold(self.inverse.clone(), |names, (r, c)| names.symbol(&self.pose_symbol(r, c).name()))
    }

    /// The matrix that the document gives a name.
    pub fn defined(&self, name: &Name) -> Option<&Matrix> {
        self.matrices.get(&name.key()).map(|m| &m.0)
    }

    /// True if the document has defined this matrix.
    pub fn has_defined(&self, name: &Name) -> bool {
        self.matrices.contains_key(&name.key())
    }

    /// True if the document has defined a matrix whose name has this base.
    pub fn has_matrix(&self, base: &str) -> bool {
        self.matrices.contains_key(base)
    }

    /// The symbol of an entry of the pose.
    pub fn pose_symbol(&self, row: usize, column: usize) -> Symbol {
        pose_symbol(self.habits.columns, row, column)
    }

    /// True if the robot, not the document, says what a name means.
    pub fn is_right(&self, name: &str) -> bool {
        self.right.contains(&plain_name(name))
    }

    /// Reads a formula.
    ///
    /// # Errors
    /// What is wrong with it, places in the whole text.
    pub fn formula(&self, text: &str, span: &Range<usize>) -> Result<Syntax, Vec<ParseError>> {
        read(text, span, &self.names).map(|s| self.habits.ordered(s))
    }

    /// Reads a formula in which the entries of the pose are symbols.
    ///
    /// # Errors
    /// As [`Lexis::formula`].
    pub fn inverse_formula(&self, text: &str, span: &Range<usize>) -> Result<Syntax, Vec<ParseError>> {
        let names = |names: Vocabulary| self.sines.iter().fold(names, |names, (n, e)| names.alias(n, *e));
        let own = (!self.sines.is_empty()).then(|| names(self.inverse.clone()));
        read(text, span, own.as_ref().unwrap_or(&self.inverse)).map(|s| self.habits.ordered(s))
    }

    /// The one name that a text is, without powers.
    pub fn lone_name(&self, text: &str, span: &Range<usize>) -> Option<Name> {
        match <[Token; 1]>::try_from(tokens(text, span, &|_| true)?).ok()? {
            [Token::Name(name)] => (!name.is_inverse && !name.is_transposed).then_some(name),
            _ => None,
        }
    }

    /// What a matrix's name means, powers included, and what that is if it is known from the robot.
    pub fn matrix(&self, subject: &Subject, name: &Name) -> Option<(Matrix, Option<Meaning>)> {
        let anywhere = self.anywhere.get();
        let is_free = || {
            crate::subject::frames(name, &self.habits).is_some_and(|(i, j)| i.is_letter() && j.is_letter())
        };
        let known = self.matrices.get(&name.key()).filter(|_| !(anywhere && is_free()));
        let posed = self.posed.get(&name.key()).filter(|_| self.is_posed.get());
        let found = match known {
            _ if posed.is_some() => (posed?.clone(), None),
            Some(found) => found.clone(),
            None => {
                let value = |argument: &str| self.argument(argument);
                let by_robot = || subject.meaning(name, anywhere, &self.habits);
                let is_own = self.habits.products.contains(&name.key());
                match elementary(name, &value).or_else(|| by_robot().filter(|_| !is_own)) {
                    Some((matrix, about)) => (matrix, Some(about)),
                    None if name.base == "J" && (name.is_inverse || name.is_transposed) => {
                        let part = jacobians::told(name).part;
                        (subject.square_jacobian(part)?, None)
                    }
                    None => (self.matrices.get(&name.backwards()?.key())?.0.inverse()?, None),
                }
            }
        };
        let mut matrix = found.0;
        if self.is_posed.get() && matrix == Matrix::of(&subject.pose()) {
            matrix = Matrix::of(&Places(self.habits.columns).pose());
        }
        if name.is_at_rest()
            && matches!(found.1, Some(Meaning::Frame { .. } | Meaning::Rotation(_) | Meaning::Origin(_)))
        {
            let joints = subject.joints();
            let still = |e: Expr| e.substitute(|s| joints.contains(&s.into()).then(|| Expr::int(0)));
            matrix = Matrix(matrix.0.iter().map(|row| row.iter().map(|e| e.map(still)).collect()).collect());
        }
        if name.is_inverse {
            matrix = matrix.inverse()?;
        }
        if name.is_transposed {
            matrix = matrix.transposed();
        }
        let about = found.1.map(|about| match (name.is_inverse, name.is_transposed) {
            (true, _) => Meaning::Inverse(about.into()),
            (_, true) => Meaning::Transpose(about.into()),
            _ => about,
        });
        Some((matrix, about))
    }

    /// The argument of an elementary transform: a formula, or a letter that stands for itself.
    fn argument(&self, text: &str) -> Option<Expr> {
        if let Ok(syntax) = read(text, &(0..text.len()), &self.names) {
            return Some(syntax.value());
        }
        let open = Vocabulary::new().open(true).degrees(true);
        read(text, &(0..text.len()), &open).ok().map(|s| s.value())
    }

    /// The letters that stand for themselves in the arguments of elementary transforms.
    pub fn declare_arguments(&mut self, name: &Name) {
        for argument in &name.arguments {
            let Some(value) = self.argument(argument) else { continue };
            for symbol in value.symbols() {
                if self.names.lookup(&symbol.name()).is_none() && !AXES.contains(&&*symbol.name()) {
                    self.names = std::mem::take(&mut self.names).alias(&symbol.name(), symbol.into());
                }
            }
        }
    }
}

/// Reads the formula at a place of a text; the places in it count from its beginning, those of errors in the text.
pub(super) fn read(text: &str, span: &Range<usize>, names: &Vocabulary) -> Result<Syntax, Vec<ParseError>> {
    let source = formula(text, span);
    let moved = |r: &Range<usize>| r.start + span.start..r.end + span.start;
    parse_syntax(&source, names)
        .map_err(|errors| errors.into_iter().map(|e| ParseError { span: moved(&e.span), ..e }).collect())
}

/// The set of angles that words name: `ZYZ`, `RPY`, `roll-pitch-yaw`.
pub(super) fn set_in(words: &str) -> Option<OrientationSet> {
    let upper = words.to_uppercase();
    let is_word = |w: &&str| (w.len() == 3) && w.chars().all(|c| matches!(c, 'X' | 'Y' | 'Z'));
    let sequence = upper.split(|c: char| !c.is_alphanumeric()).find(is_word);
    if let Some(sequence) = sequence {
        return sequence.to_lowercase().parse().ok();
    }
    let is_rpy = upper.split(|c: char| !c.is_alphanumeric()).any(|w| w == "RPY") || upper.contains("ROLL");
    is_rpy.then_some(OrientationSet::Rpy)
}
