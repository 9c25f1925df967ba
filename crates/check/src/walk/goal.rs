//! Poses that are to be reached, as far as a document gives them in numbers, and the numbers that it gives joints for them.

use super::{Cell, Scalar, Walk};
use crate::matrix::Matrix;
use crate::names::Name;
use crate::numbers::Configuration;
use crate::subject::Subject;
use denavit_reading::document::{Part, Place, Statement};
use denavit_symbolic::parse::{Syntax, SyntaxKind};
use denavit_symbolic::{Angle, Expr};
use std::f64::consts::PI;
use std::ops::Range;

/// A quantity of the pose with its printed value, and half a unit of the last digit.
#[derive(Clone, Debug)]
pub(in super::super) struct Target {
    pub wanted: Expr,
    pub printed: f64,
    pub half: f64,
    /// It is a length, not an entry of a rotation or an angle.
    pub is_length: bool,
}

impl Target {
    /// A quantity of a robot.
    pub fn new(subject: &Subject, wanted: Expr, printed: f64, half: f64) -> Self {
        let is_length = subject.pose().translation.0.contains(&wanted);
        Target { wanted, printed, half, is_length }
    }

    /// What of the pose tells the joints, as it is at a configuration: the place of the hand, or all of the pose where that does
    /// not. Nothing where a value is not known.
    pub fn of_pose(subject: &Subject, at: &Configuration) -> Option<Vec<Self>> {
        let pose = subject.pose().matrix();
        let columns = if subject.is_for_places() { 3..4 } else { 0..4 };
        let entries = pose.iter().take(3).flat_map(|row| row[columns.clone()].iter().copied());
        let moves = |e: &Expr| e.symbols().iter().any(|s| subject.joints().contains(&(*s).into()));
        let target = |wanted| Some(Target::new(subject, wanted, at.number(wanted, subject)?, 0.0));
        entries.filter(moves).map(target).collect()
    }
}

/// A joint, or a sum of joints, and the numbers that a document gives it.
#[derive(Clone, Debug)]
pub(in super::super) struct Answered {
    pub span: Range<usize>,
    /// As printed.
    pub name: String,
    /// Where the values stand.
    pub value: Range<usize>,
    pub of: Expr,
    pub values: Vec<f64>,
    /// Half a unit of the last digit.
    pub half: f64,
    /// The values have a unit.
    pub has_unit: bool,
    pub subject: usize,
    /// The pose that should be reached.
    pub targets: Vec<Target>,
    /// Lengths that the document states.
    pub at: Configuration,
    /// They were taken as a configuration that is given: they are an answer only if they reach a pose that is known.
    pub is_given: bool,
}

/// A pose that is to be reached, as it is known from a place on.
#[derive(Clone, Debug)]
pub(in super::super) struct Goal {
    pub end: usize,
    pub subject: usize,
    pub targets: Vec<Target>,
}

/// Words that begin what joints are given as.
pub(in super::super) const GIVEN: [&str; 15] = [
    "with ", "for ", "at ", "example", "bei ", "für ", "mit ", "beispiel", "pour ", "avec ", "para ", "con ",
    "per ", "com ", "exemp",
];

/// No pose has more numbers.
const MAX_TARGETS: usize = 16;

/// A number beside others of a pose stands no farther behind them, in bytes.
const MAX_BESIDE: usize = 40;
/// Numbers of one pose stand no farther from each other, in bytes.
const FAR: usize = 300;

impl Walk<'_> {
    /// The joint, or the sum of joints, that is said to have numbers.
    pub(super) fn numbers_of_joint<'r>(
        &self,
        read: &'r [Scalar],
    ) -> Option<(Expr, &'r Range<usize>, &'r Syntax)> {
        let (Scalar::Formula(_, left), rest) = read.split_first()? else { return None };
        let joints = self.subject.joints();
        let form = Angle::of(left.value());
        // `θ_1 + θ_2`, or `q_3 - δ` with a number δ.
        let is_part = |e: &Expr| joints.contains(e) || e.symbols().is_empty();
        let is_sum =
            form.terms.iter().any(|t| joints.contains(&t.0)) && form.terms.iter().all(|t| is_part(&t.0));
        let is_number = |s: &Scalar| matches!(s, Scalar::Formula(_, s) if s.value().symbols().is_empty());
        // The last side is the number that the others come to.
        let last = rest.last().filter(|s| is_number(s))?;
        let Scalar::Formula(span, syntax) = last else { return None };
        is_sum.then_some((left.value(), span, syntax))
    }

    /// True if each side between a joint and its number is a number, too, or follows from the pose that is to be reached:
    /// `θ_3 = 70° - θ_1 - θ_2` where `θ_1 + θ_2 + θ_3 = 70°` is.
    fn only_numbers(&self, read: &[Scalar]) -> bool {
        let [Scalar::Formula(_, left), rest @ ..] = read else { return false };
        let follows = |e: Expr| {
            let rest = left.value() - e;
            self.goal.iter().any(|t| {
                let is = |e: Expr, value: f64| {
                    let form = Angle::of(e);
                    let constant = form.turns.to_f64() * PI + form.radians.to_f64();
                    form.terms.is_empty() && (constant - value).abs() < t.half
                };
                is(rest - t.wanted, -t.printed) || is(rest + t.wanted, t.printed)
            })
        };
        rest.iter().all(|s| match s {
            Scalar::Formula(_, s) => s.value().symbols().is_empty() || follows(s.value()),
            _ => false,
        })
    }

    /// True for numbers with signs that a joint is said to have, `θ_5 = ±60°`, where nothing says for which pose.
    pub(super) fn is_number_with_signs(&self, read: &[Scalar]) -> bool {
        self.numbers_of_joint(read).filter(|_| self.only_numbers(read)).is_some_and(|(of, _, syntax)| {
            let at = |e: Expr| e.eval(|_| None).ok();
            let known = self.at.knows(of, &self.subject);
            syntax.sign_choices() > 0
                && !(known
                    && syntax
                        .variants()
                        .iter()
                        .any(|v| at(v.value()).is_some_and(|x| self.at.has(of, x, &self.subject))))
        })
    }

    /// Keeps the numbers that a joint is said to have for the pose that is to be reached; false if there is more to judge.
    pub(super) fn answer(&mut self, statement: &Statement, read: &[Scalar]) -> bool {
        let Some((of, span, syntax)) = self.numbers_of_joint(read) else {
            return self.number_at_goal(statement, read);
        };
        let targets = match self.in_inverse && !self.goal.is_empty() {
            true => self.goal.clone(),
            false => self.pose_of_other_solution(statement),
        };
        if targets.is_empty() {
            return false;
        }
        // The direction of the hand beside the place that is to be reached: `x = 150, y = 0, z = 40, p = -90`.
        let is_named_sum = matches!(read.first(), Some(Scalar::Formula(_, s)) if matches!(s.kind, SyntaxKind::Name(_)))
            && Angle::of(of).terms.len() > 1;
        let between = self.text.get(self.goal_at.min(statement.span.start)..statement.span.start);
        if is_named_sum && between.is_some_and(|b| b.len() < MAX_BESIDE && !b.contains('\n')) {
            let Ok(value) = syntax.value().eval(|_| None) else { return false };
            let target = Target::new(&self.subject, of, self.in_radians(span, value), self.half(span));
            self.aim_at(statement, vec![target]);
            self.taken.push(statement.span.clone());
            return true;
        }
        // `With θ1 = 30°, θ2 = 45°:` begins what is computed from them.
        let rest = self.text.get(statement.span.end..).unwrap_or_default();
        let line = rest.split('\n').next().unwrap_or_default();
        let before = self.text.get(..statement.span.start).unwrap_or_default();
        let begins = before.rsplit('\n').next().unwrap_or_default();
        let begins = begins.trim_start_matches(|c: char| !c.is_alphabetic()).to_lowercase();
        let is_given = GIVEN.iter().any(|word| begins.starts_with(word));
        // `For θ1 = 30°, θ2 = 45° they say x = 0.4`.
        let sentence = begins.rsplit(". ").next().unwrap_or_default();
        let leads = GIVEN.iter().any(|word| sentence.starts_with(word));
        let is_told = leads && says_a_place(line.split(". ").next().unwrap_or_default());
        if is_given && line.trim_end().ends_with(':') && line.len() < FAR || is_told {
            self.seek(false);
            return false;
        }
        let answered = Answered { targets, ..self.as_answered(statement, of, span, syntax) };
        let joints = self.subject.joints();
        if let (Some(joint), &[value]) = (joints.iter().position(|q| *q == of), &answered.values[..]) {
            let joints = joints.len();
            self.at.find_joint(joint, joints, (value, answered.has_unit));
        }
        self.answered.push(Answered { at: self.at.clone(), ..answered });
        self.only_numbers(read)
    }

    /// Numbers in print for a joint, of no pose as yet.
    fn as_answered(&self, statement: &Statement, of: Expr, span: &Range<usize>, syntax: &Syntax) -> Answered {
        let source = self.source(span);
        let is_degree = source.contains('°') || source.contains("deg") || source.contains("circ");
        Answered {
            span: statement.span.clone(),
            name: self.claim_name(statement),
            value: span.clone(),
            of,
            values: syntax.variants().iter().filter_map(|v| v.value().eval(|_| None).ok()).collect(),
            half: self.half(span),
            has_unit: is_degree || source.contains(|c: char| c.is_alphabetic() || c == 'π'),
            subject: self.number,
            targets: vec![],
            at: self.at.clone(),
            is_given: false,
        }
    }

    /// Keeps the number of a joint that is taken as given.
    pub(super) fn keep_given(&mut self, statement: &Statement, read: &[Scalar]) {
        if let Some((of, span, syntax)) = self.numbers_of_joint(read).filter(|_| self.only_numbers(read)) {
            let answered = self.as_answered(statement, of, span, syntax);
            self.answered.push(Answered { is_given: true, ..answered });
        }
    }

    /// An angle in print in radians: one without a unit that is more than a turn, or a multiple of 5, is in degrees.
    fn in_radians(&self, span: &Range<usize>, value: f64) -> f64 {
        let is_bare = !self.source(span).contains(|c: char| c.is_alphabetic() || matches!(c, '°' | 'π'));
        let looks_like_degrees = value.abs() > 2.0 * PI || value != 0.0 && value % 5.0 == 0.0;
        if is_bare && looks_like_degrees { value.to_radians() } else { value }
    }

    /// Keeps the number that a formula has where the pose is reached, `cos θ_3 = 0.426`, `D = (x² + y² - …)/… = 0.18`; false if
    /// there is more to judge.
    fn number_at_goal(&mut self, statement: &Statement, read: &[Scalar]) -> bool {
        let [first, middle @ .., Scalar::Formula(span, number)] = read else { return false };
        // That a helper vanishes is a condition: `p_z = 0 and X = 0`.
        let is_helper = |span: &Range<usize>| {
            let plain = crate::custom::plain(self.source(span));
            self.defined.iter().any(|d| crate::custom::plain(&d.name) == plain)
        };
        if matches!(first, Scalar::Formula(name, _) if number.value().is_zero() && is_helper(name)) {
            return false;
        }
        let joints = self.subject.joints();
        let moves = |e: Expr| e.symbols().iter().any(|s| joints.contains(&(*s).into()));
        let is_known = |e: Expr| {
            let d = &self.subject.description;
            e.symbols().iter().all(|s| joints.contains(&(*s).into()) || d.parameter(*s).is_some())
        };
        let formula = match (first, middle) {
            (Scalar::Formula(name, s), _) if moves(s.value()) => {
                // What the pose itself is told to be.
                let is_entry = self.is_right_name(name) && self.lexis.lone_name(self.text, name).is_some();
                (!is_entry).then(|| s.value())
            }
            (Scalar::Lone(_), [Scalar::Formula(_, s), ..]) if moves(s.value()) => Some(s.value()),
            _ => None,
        };
        let Some(of) = formula.filter(|e| is_known(*e)) else { return false };
        let is_number = number.value().symbols().is_empty() && number.sign_choices() == 0;
        if !self.in_inverse || self.goal.is_empty() || !is_number || self.at.knows(of, &self.subject) {
            return false;
        }
        let Ok(value) = number.value().eval(|_| None) else { return false };
        // `β = q_2 + q_3 + q_4 = -30°` tells the direction of the hand.
        let form = Angle::of(of);
        if form.terms.len() > 1 && form.terms.iter().all(|t| joints.contains(&t.0)) {
            let target = Target::new(&self.subject, of, self.in_radians(span, value), self.half(span));
            self.aim_at(statement, vec![target]);
            return false;
        }
        if statement.span.start.saturating_sub(self.goal_at) > 2 * FAR {
            return false;
        }
        let answered = Answered {
            span: statement.span.clone(),
            name: self.claim_name(statement),
            value: span.clone(),
            of,
            values: vec![value],
            half: self.half(span),
            has_unit: true,
            subject: self.number,
            targets: self.goal.clone(),
            at: self.at.clone(),
            is_given: false,
        };
        self.answered.push(answered);
        middle.is_empty()
    }

    /// The pose of the configuration that the document states, where the words before a statement speak of another solution,
    /// `the elbow-down solution has q2 = 40°`, or where joints are sought and no pose is given: then it is that one.
    fn pose_of_other_solution(&self, statement: &Statement) -> Vec<Target> {
        const SOLUTIONS: [&str; 6] = ["solution", "soluzion", "lösung", "solucion", "solución", "solução"];
        const SAME_PLACE: [&str; 10] = [
            "same po",
            "même po",
            "meme po",
            "gleiche po",
            "gleichen po",
            "selbe po",
            "misma posici",
            "mismo punto",
            "stessa posizione",
            "mesma posi",
        ];
        const OTHERS: [&str; 18] = [
            "other",
            "second",
            "flip",
            "elbow",
            "altr",
            "gomito",
            "andere",
            "zweite",
            "ellbogen",
            "otra",
            "codo",
            "autre",
            "coude",
            "deuxième",
            "outra",
            "cotovelo",
            "mirror",
            "alternativ",
        ];
        let before = self.text.get(..statement.span.start).unwrap_or_default();
        let mut lines = before.rsplit('\n');
        let own = lines.next().unwrap_or_default();
        // Numbers on lines of their own stand behind the line that leads to them.
        let lead =
            lines.map(str::trim).find(|l| !l.is_empty() && !l.contains('=')).filter(|l| l.ends_with(':'));
        if own.len() > FAR || lead.is_some_and(|l| l.len() > FAR) {
            return vec![];
        }
        let line = format!("{} {}", lead.unwrap_or_default(), own).to_lowercase();
        let says = |words: &[&str]| words.iter().any(|w| line.contains(w));
        // `solution A:`
        let is_labelled = SOLUTIONS.iter().flat_map(|w| line.match_indices(w)).any(|(at, word)| {
            let label = line[at + word.len()..].trim_start_matches(char::is_alphabetic).trim_start();
            let length = label.chars().take_while(|c| c.is_alphanumeric()).count();
            length == 1
                && label[label.chars().next().map_or(0, char::len_utf8)..].trim_start().starts_with(':')
        });
        let is_other = (says(&SOLUTIONS) || says(&SAME_PLACE)) && (says(&OTHERS) || is_labelled);
        if !is_other && !self.in_inverse {
            return vec![];
        }
        // What the sentence itself states is the solution.
        let (told, before) = &self.before_told;
        let own = told.contains(&statement.span.start);
        let mut at = if own && is_other { before.clone() } else { self.at.clone() };
        if !is_other {
            at.recall_joints();
        }
        Target::of_pose(&self.subject, &at).unwrap_or_default()
    }

    /// Keeps a number for an entry of the pose that is to be reached: `x = 516.8 mm` above inverse kinematics.
    pub(super) fn aims(&mut self, statement: &Statement, read: &[Scalar]) -> bool {
        let (Scalar::Formula(name, left), Scalar::Formula(span, right)) = (match read {
            [name, number] => (name, number),
            // `φ = θ_1 + θ_2 + θ_3 = 70°`.
            [Scalar::Formula(_, a), Scalar::Formula(_, b), _] if a.value() != b.value() => return false,
            [name, Scalar::Formula(..), number] => (name, number),
            _ => return false,
        }) else {
            return false;
        };
        let wanted = left.value();
        let moves = wanted.symbols().iter().any(|s| self.subject.joints().contains(&(*s).into()));
        let is_place = self.is_right_name(name) || self.numbers_of_joint(read).is_some();
        let is_known = self.at.knows(wanted, &self.subject);
        // Torques, velocities and determinants are asked for themselves.
        let plain = crate::custom::plain(self.source(name));
        let is_other =
            plain.starts_with(['τ', 'Γ', 'M', 'F', 'f', 'v', 'ω', 'J', '|']) || plain.starts_with("det");
        if !self.in_inverse
            || !moves
            || is_known
            || is_other
            || !right.value().symbols().is_empty()
            || !is_place
        {
            return false;
        }
        let Ok(printed) = right.value().eval(|_| None) else { return false };
        let half = self.half(span);
        let target = Target::new(&self.subject, wanted, printed, half);
        self.aim_at(statement, vec![target]);
        true
    }

    /// Adds to the pose that is to be reached; what stands far behind begins another one.
    pub(super) fn aim_at(&mut self, statement: &Statement, targets: Vec<Target>) {
        let is_told = |t: &Target| targets.iter().any(|n| n.wanted == t.wanted);
        if statement.span.start.saturating_sub(self.goal_at) > FAR || self.goal.iter().any(is_told) {
            self.goal.clear();
        }
        self.goal.extend(targets);
        self.goal_at = statement.span.end;
        if self.goal.len() <= MAX_TARGETS {
            let (end, subject) = (self.goal_at, self.number);
            self.goals.push(Goal { end, subject, targets: self.goal.clone() });
        }
    }

    /// True for what a pose is to be, or a condition. Numbers of a pose that no words give are kept: something should rest on them.
    pub(super) fn is_taken_as_goal(&mut self, statement: &Statement, read: &[Scalar]) -> bool {
        let aims = self.aims(statement, read);
        if !aims && self.is_condition(statement, read) {
            return true;
        }
        let is_goal = aims || self.is_goal(statement, read);
        let is_number = matches!(read, [_, Scalar::Formula(_, s)] if s.value().symbols().is_empty());
        if is_goal && is_number && !self.tells_goal(statement) {
            self.assumed.push(statement.span.clone());
        }
        is_goal
    }

    /// Keeps coordinates in numbers that are to be reached, `(x, y, z) = (0.2, 0.45, 0.3)` behind `target`.
    pub(super) fn aims_at_components(&mut self, statement: &Statement) -> bool {
        let [left, right] = &statement.sides[..] else { return false };
        let (Some(names), Some(numbers)) = (self.components(&left.span), self.components(&right.span)) else {
            return false;
        };
        if names.len() != numbers.len() || !(self.in_inverse || self.tells_goal(statement)) {
            return false;
        }
        let joints = self.subject.joints();
        let target = |(name, number): (&Range<usize>, &Range<usize>)| {
            let wanted = self.lexis.formula(self.text, name).ok()?.value();
            let moves = wanted.symbols().iter().any(|s| joints.contains(&(*s).into()));
            let value = self.constant(self.source(number))?.eval(|_| None).ok()?;
            let is_place = moves && !joints.contains(&wanted);
            is_place.then(|| Target::new(&self.subject, wanted, value, self.half(number)))
        };
        let Some(targets) = names.iter().zip(&numbers).map(target).collect::<Option<Vec<_>>>() else {
            return false;
        };
        self.look_for_joints();
        self.aim_at(statement, targets);
        self.taken.push(statement.span.clone());
        true
    }

    /// The parts of a tuple in print, `(x, y)`.
    fn components(&self, span: &Range<usize>) -> Option<Vec<Range<usize>>> {
        let text = self.text.get(span.clone())?;
        let inner = text.trim().strip_prefix('(')?.strip_suffix(')')?;
        let start = span.start + text.find('(')? + 1;
        let mut at = start;
        let mut found = vec![];
        // `\\,` is a blank.
        let blank = inner.replace("\\,", "  ");
        for part in blank.split(',') {
            let bare = part.trim_matches(|c: char| c.is_whitespace() || matches!(c, '\\' | '~'));
            let from = at + (bare.as_ptr() as usize - part.as_ptr() as usize);
            found.push(from..from + bare.len());
            at += part.len() + 1;
        }
        (found.len() > 1 && found.iter().all(|f| !f.is_empty())).then_some(found)
    }

    /// True where the word before a statement says that it names a point.
    fn is_point(&self, statement: &Statement) -> bool {
        const POINTS: [&str; 12] = [
            "point",
            "target",
            "goal",
            "punkt",
            "ziel",
            "punto",
            "ponto",
            "place",
            "position",
            "posición",
            "posizione",
            "cible",
        ];
        let before = self.text.get(..statement.span.start).unwrap_or_default();
        let line = before.rsplit('\n').next().unwrap_or_default().to_lowercase();
        let word = line.trim_end_matches([' ', '$', '*']).rsplit([' ', '*', '$']).next().unwrap_or_default();
        POINTS.contains(&word)
    }

    /// Keeps a pose of numbers that is to be reached: `p = (0.4, 0.2, 0.3)`, `T_06 = […]` above inverse kinematics.
    pub(super) fn aims_at_matrix(&mut self, statement: &Statement) -> bool {
        let is_told = statement.place == Place::Told;
        let (left, right) = match &statement.sides[..] {
            [left, right] => (Some(left), right),
            [only] if is_told => (None, only),
            _ => return false,
        };
        let [Part::Matrix(grid)] = &right.parts[..] else { return false };
        if !self.in_inverse {
            return false;
        }
        let name = match left.map(|l| self.lone(l)) {
            Some(Some(name)) => Some(name),
            None => None,
            Some(None) => return false,
        };
        let Some(printed) = self.printed(grid) else { return false };
        let is_number = |e: &Option<Expr>| e.is_some_and(|e| e.symbols().is_empty());
        if !printed.0.iter().flatten().all(is_number) {
            return false;
        }
        let is_short = matches!(printed.shape(), Some((2 | 3, 1) | (1, 2 | 3)));
        let place = || {
            let is_letter = |n: &Name| {
                let is_own = matches!(n.base.as_str(), "p" | "P" | "x" | "X" | "r" | "o" | "d");
                n.left.is_empty() && (is_own || self.is_point(statement) && n.base.chars().count() == 1)
            };
            let is_place = name.as_ref().map_or(is_told && is_short, is_letter);
            is_place.then(|| Matrix::column(&self.subject.pose().translation))
        };
        let named = name.as_ref().and_then(|name| self.lexis.matrix(&self.subject, name));
        let known = named.filter(|m| m.1.is_some()).map(|m| m.0);
        let Some(wanted) = known.or_else(place) else { return false };
        let is_row = printed.shape().is_some_and(|s| s.0 == 1 && s.1 > 1);
        let wanted = if is_row { wanted.transposed() } else { wanted };
        let mut targets = vec![];
        for (r, row) in self.cells(grid).iter().enumerate() {
            for (c, cell) in row.iter().enumerate() {
                let (Cell::Formulas(formulas), Some(wanted)) = (cell, wanted.entry(r, c)) else { continue };
                let Some((span, syntax)) = formulas.first() else { continue };
                let moves = wanted.symbols().iter().any(|s| self.subject.joints().contains(&(*s).into()));
                if moves && self.at.knows(wanted, &self.subject) {
                    return false;
                }
                if let (true, Ok(printed)) = (moves, syntax.value().eval(|_| None)) {
                    let unit = self.unit_outside(span);
                    targets.push(Target::new(&self.subject, wanted, printed * unit, self.half(span) * unit));
                }
            }
        }
        if targets.is_empty() {
            return false;
        }
        self.aim_at(statement, targets);
        self.taken.push(statement.span.clone());
        true
    }
}

/// True if a text says a coordinate of the hand: `x = 0.4`, `p_y=0.1`.
fn says_a_place(text: &str) -> bool {
    text.match_indices('=').any(|(at, _)| {
        let before = text[..at].trim_end_matches(|c: char| c.is_whitespace() || matches!(c, '$' | '&' | '}'));
        let word = before.rsplit(|c: char| !(c.is_alphanumeric() || c == '_')).next().unwrap_or_default();
        let axis = word.to_lowercase();
        let axis = axis.strip_prefix('p').map_or(axis.as_str(), |rest| rest.trim_start_matches('_'));
        matches!(axis, "x" | "y" | "z")
    })
}
