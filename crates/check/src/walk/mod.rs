//! From the statements of a document to pairs of formulas: what is printed, and what the robot makes of it.

mod again;
mod author;
mod cases;
mod compare;
mod defines;
mod derivatives;
mod determinants;
mod elsewhere;
mod entries;
mod extracts;
mod goal;
mod labels;
mod matrices;
mod points;
mod rate_letters;
mod rates;
mod recorded;
mod scalars;
mod singular;
mod speeds;
mod told;
mod units;
mod worded;
mod words;

pub(super) use elsewhere::of_other_points;
pub(super) use goal::{Answered, GIVEN, Goal, Target};
pub(super) use points::points;
pub(super) use scalars::is_measured;
pub(super) use singular::speaks_of_singularity;

use super::facts::{About, Meaning, Remark, Sense};
use super::habits::{Habits, Places};
use super::lexis::{Lexis, read};
use super::matrix::Matrix;
use super::named_sums::told;
use super::names::Name;
use super::note::{Unread, Unreadable};
use super::numbers::{Answer, Configuration};
use super::subject::Subject;
use denavit::geometry::orientation::OrientationSet;
use denavit_reading::document::{Part, Place, Statement};
use denavit_symbolic::parse::{Syntax, whole_word};
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Expr, Symbol};
use rustc_hash::FxHashMap;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::ops::Range;
use std::rc::Rc;

/// A formula in print, and what it should be.
#[derive(Clone, Debug)]
pub(super) struct Pair {
    /// Row and column from 1, in a matrix.
    pub place: Option<(usize, usize)>,
    /// Where it stands.
    pub span: Range<usize>,
    /// What is printed; nothing where it is worked out from printed factors.
    pub printed: Option<Syntax>,
    /// Its value.
    pub value: Expr,
    /// What the robot makes of it.
    pub wanted: Expr,
    /// Further equalities that the piece stands for, proved already.
    pub also: Vec<[Expr; 2]>,
}

/// A part of a claim.
#[derive(Clone, Debug)]
pub(super) enum Piece {
    Pair(Pair),
    /// A number at a configuration.
    Number {
        place: Option<(usize, usize)>,
        span: Range<usize>,
        answer: Answer,
    },
    /// A formula that could not be read.
    Unreadable {
        place: Option<(usize, usize)>,
        span: Range<usize>,
        errors: Vec<Unread>,
    },
}

/// What a statement claims of the robot.
#[derive(Clone, Debug)]
pub(super) struct Assertion {
    pub span: Range<usize>,
    /// The left side as printed.
    pub name: String,
    /// What it is about.
    pub about: About,
    pub pieces: Vec<Piece>,
    /// Remarks, such as a row that is too short.
    pub remarks: Vec<Remark>,
    /// Which of the robots of the document it is about.
    pub subject: usize,
    /// The names of its formulas, where they are its own.
    pub names: Option<Rc<Vocabulary>>,
    /// What a single printed matrix should be.
    pub whole: Option<Matrix>,
    /// The side of an equation that the others are held against, as printed.
    pub reference: Option<(Range<usize>, Syntax)>,
    /// Values for joints and angles are judged in their own way.
    pub spoken: Option<Spoken>,
}

/// Printed values, the entries of the pose as symbols.
#[derive(Clone, Debug)]
pub(super) enum Spoken {
    /// Of a joint, or of a sum of joints, each value in print.
    Joint { of: Expr, sides: Vec<(Range<usize>, Syntax)>, branches: Vec<Expr> },
    /// Of an angle of an orientation.
    Angle { set: OrientationSet, name: String, value: (Range<usize>, Syntax) },
}

/// A name that the document defines by a formula.
#[derive(Clone, Debug)]
pub(super) struct Defined {
    pub name: String,
    /// By custom it is an entry of the pose.
    pub by_custom: bool,
    /// The whole statement, and its left side as printed.
    pub statement: Range<usize>,
    pub shown: String,
    /// Where the formula stands.
    pub span: Range<usize>,
    pub printed: Syntax,
    pub value: Expr,
    /// Which of the robots is spoken of.
    pub subject: usize,
    /// The place from which on the name has this meaning.
    pub from: usize,
}

/// So many bytes may stand between a paragraph and what it is about.
const MAX_DISTANCE: usize = 120;
/// The longest heading at the beginning of a paragraph, in bytes.
const MAX_HEADING: usize = 60;
/// The most elements of a matrix that are read.
const MAX_ELEMENTS: usize = 4_096;

/// The document from beginning to end.
pub(super) struct Walk<'a> {
    text: &'a str,
    pub lexis: Lexis,
    pub subject: Rc<Subject>,
    number: usize,
    pub assertions: Vec<Assertion>,
    /// Names that the document defines by formulas.
    pub defined: Vec<Defined>,
    /// Sines and cosines of joints that the document gives formulas for, the entries of the pose as symbols.
    pub sines: Vec<(Expr, Vec<Expr>)>,
    /// The configuration that was stated last.
    pub at: Configuration,
    /// The prose that stated it, and the one before it.
    before_told: (Range<usize>, Configuration),
    /// The configurations that have names.
    labels: labels::Labels,
    /// The set of angles that a directive names.
    pub angles: Option<OrientationSet>,
    /// Statements that say nothing of the robot and could not be read.
    pub skipped: Vec<(Range<usize>, Unreadable)>,
    /// What states a configuration or a case, and claims nothing.
    pub taken: Vec<Range<usize>>,
    /// Numbers that joints are said to have where a pose is given.
    pub answered: Vec<Answered>,
    /// The velocity that told which letters are rates, and how they are read.
    rates_told: Option<(Range<usize>, Sense)>,
    /// Velocities in letters of which it is not known yet which joint's rates they are.
    waiting: Vec<rate_letters::Waiting>,
    /// Components of the velocity for which joint rates are asked, by their rows.
    sought: BTreeMap<usize, Expr>,
    /// The pose that is to be reached, as far as the text has given it in numbers, and where it did last.
    goal: Vec<Target>,
    goal_at: usize,
    /// Numbers that were taken for those of such a pose though no words say so.
    pub assumed: Vec<Range<usize>>,
    /// The poses that were to be reached so far, each as it stood behind a statement.
    pub goals: Vec<Goal>,
    /// What is read is about inverse kinematics.
    in_inverse: bool,
    /// The components of the load that was given last, where these have names; nothing if it could not be read.
    load: Option<Vec<(Symbol, Expr)>>,
    /// Names that the document gives matrices: the statement and the name as printed.
    pub named: Vec<(Range<usize>, String)>,
    /// The rotation, or the transform, that was printed last, and where it ends.
    printed_last: Option<(Matrix, usize)>,
    /// The statement before which another one is read.
    reader: Option<usize>,
    /// Under which heading each matrix has its name from.
    named_under: BTreeMap<String, Option<Range<usize>>>,
    /// The prose and the heading that were looked at last.
    last_prose: Range<usize>,
    /// How far its values were read.
    told_to: usize,
    last_heading: Range<usize>,
    /// Where the statements so far end.
    last_end: usize,
    /// The cells of the matrices of the present statement.
    cells: RefCell<FxHashMap<usize, Rc<Cells>>>,
}

/// The cells of a printed matrix, by rows.
type Cells = Vec<Vec<Cell>>;

/// A cell of a printed matrix.
#[derive(Clone, Debug)]
enum Cell {
    LeftOut,
    /// Formulas with `=` between them.
    Formulas(Vec<(Range<usize>, Syntax)>),
    /// A name without meaning.
    Lone(Name),
    Broken(Range<usize>, Vec<Unread>),
}

/// A side of an equation between scalars.
enum Scalar {
    Formula(Range<usize>, Syntax),
    Lone(Name),
    Broken(Range<usize>, Vec<Unread>),
}

/// A name that a statement defines.
enum Definition {
    Matrix(Name, Matrix, Option<Meaning>),
    /// An entry of a matrix that the robot gives, and what it is in the entries of the pose.
    Entry(String, Expr, Expr),
    /// A matrix in the entries of the pose.
    Posed(Name, Matrix),
    /// The value of a cell.
    Cell(String, Expr),
}

/// What is known before anything is compared.
struct Reference {
    matrix: Matrix,
    /// What it is by the robot; nothing where it is what was printed first.
    about: Option<Meaning>,
}

impl<'a> Walk<'a> {
    /// Begins with a robot.
    pub fn new(text: &'a str, subject: &Rc<Subject>, habits: &Rc<Habits>) -> Self {
        let mut lexis = Lexis::new(subject, habits, &Rc::from(text));
        for (name, sum, entry) in told(text, subject, &lexis.names, &Places(habits.columns)) {
            lexis.define(&name, sum);
            lexis.define_inverse(&name, entry);
        }
        Walk {
            text,
            lexis,
            subject: Rc::clone(subject),
            number: 0,
            assertions: vec![],
            defined: vec![],
            sines: vec![],
            taken: vec![],
            answered: vec![],
            rates_told: None,
            waiting: vec![],
            sought: BTreeMap::new(),
            goal: vec![],
            goal_at: 0,
            assumed: vec![],
            goals: vec![],
            in_inverse: false,
            load: Some(vec![]),
            told_to: 0,
            named: vec![],
            printed_last: None,
            reader: None,
            last_prose: 0..0,
            named_under: BTreeMap::new(),
            last_heading: 0..0,
            last_end: 0,
            at: Configuration::default(),
            before_told: (0..0, Configuration::default()),
            labels: labels::Labels::default(),
            angles: None,
            skipped: vec![],
            cells: RefCell::default(),
        }
    }

    /// Goes on with another robot of the document.
    pub fn turn_to(&mut self, subject: &Rc<Subject>, number: usize) {
        if number != self.number {
            self.lexis = self.lexis.of(subject);
            (self.subject, self.number) = (Rc::clone(subject), number);
        }
    }

    /// The number of formulas so far.
    pub fn count(&self) -> usize {
        self.assertions.iter().map(|a| a.pieces.len()).sum()
    }

    /// A second name for a quantity.
    pub fn alias(&mut self, name: &str, meaning: &str) -> Option<()> {
        let value = match read(meaning, &(0..meaning.len()), &self.lexis.names) {
            Ok(syntax) => syntax.value(),
            Err(_) => {
                let word = whole_word(meaning)?.replace('_', "");
                self.lexis.names.lookup(&word)?
            }
        };
        self.lexis.define(name, value);
        Some(())
    }

    /// Reads a statement; `claim` says what its left side means, where that is told.
    pub fn statement(&mut self, statement: &Statement, claim: Option<&str>) {
        if let Some(heading) = &statement.heading
            && *heading != self.last_heading
        {
            self.last_heading = heading.clone();
            let words = self.text.get(heading.clone()).unwrap_or_default().to_lowercase();
            self.begin(&words);
            self.told_in(heading);
        }
        let before = self.last_end.min(statement.span.start)..statement.span.start;
        self.last_end = self.last_end.max(statement.span.end);
        self.told_between(&before, statement.prose.as_ref());
        if let Some(prose) = &statement.prose {
            if *prose != self.last_prose {
                self.last_prose = prose.clone();
                self.told_to = prose.start;
                let words = self.text.get(prose.clone()).unwrap_or_default().to_lowercase();
                match words.trim_start().strip_prefix("**").and_then(|w| w.split_once("**")) {
                    // A heading that the paragraph begins with.
                    Some((head, _)) if head.len() < MAX_HEADING => self.begin(head),
                    _ if words.len() < MAX_HEADING && cases::tells_inverse(&words) => self.look_for_joints(),
                    _ => {}
                }
            }
            // What later sentences give is not given yet.
            let end = told::sentence_end(self.text, prose, statement.span.end);
            if end > self.told_to {
                self.told_in(&(self.told_to..end));
                self.told_to = end;
            }
        }
        self.recall_before(statement.span.start);
        if self.aims_at_components(statement) {
            return;
        }
        if statement.sides.iter().flat_map(|s| &s.parts).all(|p| matches!(p, Part::Text(_)))
            && self.scalars(statement, claim)
        {
            self.know_in_pose(statement);
            return;
        }
        self.matrices(statement, claim);
        self.know_components(statement);
        self.keep_printed(statement);
    }

    /// Begins a part of the document under a heading, in small letters.
    fn begin(&mut self, heading: &str) {
        let were_found = self.seek(cases::tells_inverse(heading));
        if self.in_inverse {
            self.at.forget_joints(were_found);
        }
    }

    /// True for a statement that gives a name without meaning, or a helper, its meaning.
    pub fn may_define(&self, statement: &Statement) -> bool {
        let [left, _, ..] = &statement.sides[..] else { return false };
        let [Part::Text(span)] = &left.parts[..] else { return false };
        let name = self.lexis.lone_name(self.text, span);
        let is_own = name.as_ref().is_some_and(|n| self.lexis.habits.products.contains(&n.key()));
        let is_free = name.is_some() && self.lexis.formula(self.text, span).is_err();
        is_own || self.lexis.is_helper(self.source(span)) || is_free && !self.is_right_name(span)
    }

    /// Reads a statement that gives a name its meaning before the one that uses it.
    pub fn ahead_of(&mut self, user: &Statement, definition: &Statement) {
        self.reader = Some(user.span.start);
        self.statement(definition, None);
        self.reader = None;
    }

    /// Whether the joints are what is asked for from here on; tells whether they were.
    fn seek(&mut self, joints: bool) -> bool {
        self.at.is_sought = joints;
        std::mem::replace(&mut self.in_inverse, joints)
    }

    /// From here on the joints are what is asked for.
    pub(super) fn look_for_joints(&mut self) {
        let were_found = self.seek(true);
        self.at.forget_joints(were_found);
    }

    /// True for a statement that stands in a sentence that tells a case.
    fn is_case(&self, statement: &Statement) -> bool {
        let prose = statement.prose.clone().filter(|p| {
            let between = self.text.get(p.end.min(statement.span.start)..statement.span.start);
            statement.place == Place::Inline && between.is_some_and(|b| b.len() < 200 && !b.contains("\n\n"))
        });
        prose.and_then(|p| self.text.get(p)).is_some_and(told::is_case)
    }

    fn source(&self, span: &Range<usize>) -> &'a str {
        self.text.get(span.clone()).unwrap_or_default().trim()
    }

    /// The paragraph that ends before a statement.
    fn paragraph_before(&self, statement: &Statement) -> &'a str {
        let text: &'a str = self.text;
        let Some(prose) = statement.prose.clone().filter(|p| p.end <= statement.span.start) else {
            return "";
        };
        if statement.span.start - prose.end > MAX_DISTANCE {
            return "";
        }
        let before = text.get(..prose.end).unwrap_or_default();
        let lines = before.rsplit('\n').take_while(|l| !l.trim().is_empty()).take(8);
        let length: usize = lines.map(|l| l.len() + 1).sum();
        before.get(before.len().saturating_sub(length)..).unwrap_or_default()
    }

    fn claim_name(&self, statement: &Statement) -> String {
        let first = statement.sides.first().map_or(&statement.span, |s| &s.span);
        let name: String = self.source(first).chars().take(80).collect();
        name.split_whitespace().collect::<Vec<_>>().join(" ")
    }

    fn assertion(&self, statement: &Statement, about: About) -> Assertion {
        // A drawn matrix stands above and below its name: the claim is where that stands.
        let start = statement.sides.first().map_or(0, |s| s.span.start);
        Assertion {
            span: statement.span.start.max(start)..statement.span.end,
            name: self.claim_name(statement),
            about,
            pieces: vec![],
            remarks: self
                .rates_told
                .iter()
                .filter(|t| t.0 == statement.span)
                .map(|t| Remark::ReadAs(t.1.clone()))
                .collect(),
            subject: self.number,
            whole: None,
            names: None,
            reference: None,
            spoken: None,
        }
    }
}
