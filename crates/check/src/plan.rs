//! Which robot each part of a document is about: tables and directives in their order.

use super::CheckOptions;
use super::blocks;
use super::changed::{self, with_lengths, with_names, with_tool, with_tool_at};
use super::convention;
use super::facts::Motion;
use super::habits::Habits;
use super::letters::mentioned;
use super::lexis::set_in;
use super::listing;
use super::note::{Note, Noted, Notes, Unread, Unreadable};
use super::numbers::Configuration;
use super::order;
use super::programs::{self, Followed, Source};
use super::remarks;
use super::subject::Subject;
use super::tables::OwnTable;
use super::walk::{Answered, Assertion, Defined, Goal, Walk, of_other_points, points};
use denavit::catalogue;
use denavit::description::table::{PrintedTable, convention_said, tables};
use denavit::description::{
    Convention, Description, Diagnostic, Measure, NotSet, Severity, TableKind, line_column,
};
use denavit::geometry::{Transform, Vector};
use denavit_reading::code::Dialect;
use denavit_reading::document::{Directive, Document, Format};
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Expr, Rational, Symbol};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::rc::Rc;

/// The robots of a document, and from where on each holds.
pub(super) struct Plan {
    pub subjects: Vec<Rc<Subject>>,
    /// What the document means by names that may mean several things.
    pub habits: Rc<Habits>,
    /// The document's own tables, where another robot is given.
    pub own_tables: Rc<Vec<OwnTable>>,
    /// Where claims stand that are taken as the author prints them.
    authors: BTreeSet<usize>,
    /// Where coordinates stand that are taken as they are, not as they are printed, by their names.
    truths: BTreeMap<usize, (String, Expr)>,
    /// Place in the text and number of the robot, in the order of the text.
    turns: Vec<(usize, usize)>,
    /// False where neither a robot was given nor a table stands in the document.
    pub has_robot: bool,
    /// The text of which programs are read, where it is another.
    pub programs: Option<Rc<str>>,
    /// Functions, or whole programs, that give joints their values and are not read line by line.
    pub posed: Vec<Range<usize>>,
    /// The robots are the document's own.
    pub is_own: bool,
    /// Where its tables stand.
    pub tables: Rc<Vec<Range<usize>>>,
    /// Statements in the comments of a program.
    pub remarks: Rc<Vec<Range<usize>>>,
    /// Names of programs for rates and accelerations of joints.
    pub motion: Rc<Motion>,
}

/// What the statements of a document claim.
pub(super) struct Walked {
    pub assertions: Vec<Assertion>,
    pub skipped: Vec<(Range<usize>, Unreadable)>,
    /// What states a configuration or a case, and claims nothing.
    pub taken: Vec<Range<usize>>,
    /// Numbers that joints are said to have where a pose is given.
    pub answered: Vec<Answered>,
    /// The poses that are to be reached.
    pub goals: Vec<Goal>,
    /// Numbers that were taken for those of such a pose though no words say so.
    pub assumed: Vec<Range<usize>>,
    /// What the document tells not to judge.
    pub ignored: Vec<Range<usize>>,
    /// Names that the document gives matrices: the statement and the name as printed.
    pub named: Vec<(Range<usize>, String)>,
    /// Names that the document defines by formulas.
    pub defined: Vec<Defined>,
    /// What of programs could not be read.
    pub refused: Vec<Unread>,
    /// What of programs follows from something wrong before.
    pub followed: Vec<Followed>,
    /// Names that programs give values with joints in them, and where.
    pub unsaid: Vec<(Range<usize>, String)>,
    /// Names that programs give numbers, and the robot does not have.
    pub numbers: Vec<String>,
    /// Comparisons of tests that are judged, and calls of the robot's functions for these.
    pub tested: Vec<Range<usize>>,
    /// The names of each robot's part of the document, at its end.
    pub names: Vec<Rc<Vocabulary>>,
    /// The same with the entries of the pose as symbols.
    pub inverse_names: Vec<Rc<Vocabulary>>,
    /// The lengths that each robot's part of the document has stated at its end.
    pub stated: Vec<Configuration>,
}

impl Walked {
    /// The names of a robot's part of the document, at its end.
    pub fn names_of(&self, subject: usize) -> &Rc<Vocabulary> {
        &self.names[subject.min(self.names.len() - 1)]
    }

    /// The same with the entries of the pose as symbols.
    pub fn inverse_names_of(&self, subject: usize) -> &Rc<Vocabulary> {
        &self.inverse_names[subject.min(self.inverse_names.len() - 1)]
    }
}

/// A directive with its first word and the rest.
fn words(directive: &Directive) -> (&str, &str) {
    let words = directive.words.trim();
    words.split_once(char::is_whitespace).map_or((words, ""), |(first, rest)| (first, rest.trim()))
}

impl Plan {
    /// The robots of a document: the one given, or its tables.
    pub fn of(
        text: &str,
        format: Format,
        document: &Document,
        robot: Option<&Description>,
        options: &CheckOptions,
        notes: &mut Notes,
    ) -> Result<Self, Vec<Note>> {
        let mentioned = mentioned(text);
        let named = |d: &Description| Subject::new(d.clone()).map(|s| with_names(s, &mentioned));
        let mut is_set = vec![false; options.set.len()];
        let mut refused: Vec<Note> = vec![];
        let unset = |name: &str, why| {
            let what = Noted::NotSet(name.into(), why);
            Note { severity: Severity::Error, span: 0..0, what }
        };
        let in_millimetres = options.table.lengths_in_millimetres == Some(true);
        // Lengths of tables of its own are in the document's unit in the end.
        let is_scaled = in_millimetres || convention::only_in_millimetres(text).is_some();
        let mut from_table = |d: &Description, table: &PrintedTable| {
            let mut d = d.clone();
            for ((name, value), is_set) in options.set.iter().zip(&mut is_set) {
                match d.set(name, value) {
                    Ok(()) => *is_set = true,
                    Err(NotSet::Unknown { .. }) => {}
                    Err(why) => refused.push(unset(name, why)),
                }
            }
            let open: Vec<Symbol> =
                d.parameters.iter().filter(|p| p.value.is_none()).map(|p| p.symbol).collect();
            for symbol in open.iter().filter(|_| options.language == Some(Dialect::C)) {
                // `#define H 1.20` puts the number into every formula.
                let Some(number) = changed::defined_in(text, &symbol.name()) else { continue };
                let is_length = is_scaled && d.measure(*symbol) == Measure::Length;
                let value = if is_length { format!("{number} mm") } else { number.to_string() };
                // What cannot be read so stays a letter.
                let _ = d.set(&symbol.name(), &value);
            }
            let d = &d;
            let convention = [d.convention.length_x(), d.convention.length_z()];
            let letters = [0, 1].map(|k| table.letters[k].unwrap_or(convention[k]).to_string());
            let subject = Subject::printed(d.clone(), letters, table.variables.clone(), table.previous)?;
            let mut subject = with_names(subject, &mentioned);
            // Rows 4 to 6 alone are those joints.
            let is_alone = subject.description.rows.len() < table.first;
            subject.first = if is_alone { table.first - 1 } else { 0 };
            subject.line = Some(line_column(text, table.span.start).0);
            Some(subject)
        };
        let habits = Habits::of(text).with_products(text, document);
        let millimetres = in_millimetres && robot.is_some();
        let habits = Rc::new(Habits { millimetres, ..habits });
        let authors = BTreeSet::new();
        let turns = vec![];
        let own_tables = Rc::new(vec![]);
        let (has_robot, programs, is_own) = (true, None, robot.is_none());
        let mut plan = Plan {
            subjects: vec![],
            habits,
            own_tables,
            authors,
            truths: BTreeMap::new(),
            turns,
            has_robot,
            programs,
            posed: vec![],
            is_own,
            tables: Rc::default(),
            remarks: Rc::default(),
            motion: Rc::default(),
        };
        if let Some(robot) = robot {
            plan.push(0, named(robot));
        }
        let kind = kind_of_tables(format);
        let mut reading = options.table.clone();
        let is_open = format != Format::Toml;
        if let (None, Some((convention, place))) = (reading.convention, convention_said(text)) {
            // What the columns of a table say comes before words, as where it is read for itself.
            let differs = |t: &PrintedTable| t.robot.as_ref().is_ok_and(|r| r.0.convention != convention);
            if !(is_open && tables(text, kind, &reading).iter().any(differs)) {
                notes.note(place, Noted::ReadAs(convention));
                reading.convention = Some(convention);
            }
        }
        let printed = if is_open { listing::tables_of(text, kind, options, &reading) } else { vec![] };
        plan.tables = Rc::new(printed.iter().map(|t| t.span.clone()).collect());
        let mut events: Vec<(usize, Event)> =
            directives(document).map(|d| (d.span.start, Event::Directive(d))).collect();
        if robot.is_none() {
            events.extend(printed.iter().map(|t| (t.span.end, Event::Table(t))));
        }
        if robot.is_some() {
            let mut own: Vec<OwnTable> = vec![];
            for (table, is_tried) in convention::in_each(text, kind, &reading, &printed) {
                if let Ok((d, _)) = &table.robot
                    && let Some(subject) = from_table(d, &table)
                {
                    own.push(OwnTable { table, subject: Rc::new(subject), is_tried });
                }
            }
            plan.own_tables = Rc::new(own);
        }
        events.sort_by_key(|e| e.0);
        let mut failed: Vec<Diagnostic> = vec![];
        for (at, event) in events {
            let found = match event {
                Event::Table(table) => match &table.robot {
                    Ok((d, found)) => {
                        // Lines such as `x = 0.5` are claims here, not values of the table.
                        let own = found
                            .iter()
                            .filter(|f| f.span.start >= table.span.start && f.span.end <= table.span.end);
                        own.for_each(|f| notes.add(f.clone().into()));
                        from_table(d, table)
                    }
                    Err(errors) => {
                        failed.extend(errors.iter().cloned());
                        continue;
                    }
                },
                Event::Directive(directive) => match words(directive) {
                    ("robot", name) => match catalogue::robot(name) {
                        Some(d) => named(&d),
                        None => {
                            notes.error(directive.span.clone(), Noted::UnknownRobot(name.into()));
                            continue;
                        }
                    },
                    ("table", number) => {
                        let last = number.split([',', ' ', '+']).rfind(|n| !n.is_empty());
                        let number =
                            last.and_then(|n| n.parse::<usize>().ok()).and_then(|n| n.checked_sub(1));
                        match number.and_then(|n| printed.get(n)) {
                            Some(table @ PrintedTable { robot: Ok((d, _)), .. }) => from_table(d, table),
                            _ => {
                                notes.error(directive.span.clone(), Noted::NoSuchTable);
                                continue;
                            }
                        }
                    }
                    ("rows", number) => {
                        let rows = number.parse::<usize>().ok().filter(|n| *n > 0);
                        match (rows, plan.subjects.last()) {
                            (Some(rows), Some(subject)) => Some(subject.first_rows(rows)),
                            _ => continue,
                        }
                    }
                    ("convention", name) => match Convention::ALL.into_iter().find(|c| c.name() == name) {
                        Some(convention) => Subject::new(nothing(convention)),
                        None => {
                            notes.error(directive.span.clone(), Noted::UnknownConvention(name.into()));
                            continue;
                        }
                    },
                    ("tool", place) => match plan.subjects.last() {
                        Some(subject) => match with_tool(&subject.description, place) {
                            Some(d) => Some(subject.with(d)),
                            None => {
                                notes.error(directive.span.clone(), Noted::NoTool);
                                continue;
                            }
                        },
                        None => continue,
                    },
                    _ => continue,
                },
            };
            plan.push(at, found);
        }
        for ((name, _), _) in options.set.iter().zip(&is_set).filter(|s| !s.1) {
            let known = plan.subjects.iter().flat_map(|s| &s.description.parameters);
            let known: BTreeSet<String> = known.map(|p| p.symbol.name().to_string()).collect();
            let why = NotSet::Unknown { name: name.clone(), known: known.into_iter().collect() };
            refused.push(unset(name, why));
        }
        if !refused.is_empty() {
            return Err(refused);
        }
        if plan.subjects.is_empty() {
            if !failed.is_empty() {
                return Err(failed.into_iter().map(Note::from).collect());
            }
            // Formulas that hold of any robot need none.
            plan.has_robot = false;
            plan.push(0, Subject::new(nothing(Convention::Standard)));
        }
        failed.into_iter().for_each(|f| notes.add(f.into()));
        Ok(if is_scaled && plan.is_own { plan.with_unit(true) } else { plan })
    }

    /// The number of the robot that a place of the text is about.
    pub fn at(&self, place: usize) -> usize {
        self.turns.iter().rev().find(|t| t.0 <= place).map_or(0, |t| t.1)
    }

    /// True for a name of a joint.
    pub fn is_joint(&self, name: &str) -> bool {
        self.joint(name).is_some()
    }

    /// The number of the joint that a name is of.
    pub fn joint(&self, name: &str) -> Option<usize> {
        let found = |s: &Rc<Subject>| {
            let own = s.vocabulary().lookup(name)?;
            s.joints().iter().position(|q| *q == own)
        };
        self.subjects.iter().find_map(found)
    }

    /// The programs of a document: the number of the robot, the language, and the blocks.
    fn blocks(
        &self,
        text: &str,
        document: &Document,
        options: &CheckOptions,
    ) -> Vec<(usize, Dialect, Vec<Range<usize>>)> {
        let mut found: Vec<(usize, Dialect, Vec<Range<usize>>)> = vec![];
        for (span, language) in blocks::programs(text, document, options) {
            let number = self.at(span.start);
            match found.iter_mut().find(|f| (f.0, f.1) == (number, language)) {
                Some(program) => program.2.push(span),
                None => found.push((number, language, vec![span])),
            }
        }
        found
    }

    fn push(&mut self, at: usize, subject: Option<Subject>) {
        if let Some(subject) = subject {
            // What stands before the first table is about it, too.
            let at = if self.subjects.is_empty() { 0 } else { at };
            self.subjects.push(Rc::new(subject));
            self.turns.push((at, self.subjects.len() - 1));
        }
    }

    /// The same document about other robots.
    pub fn with(&self, change: &dyn Fn(&Subject) -> Option<Subject>) -> Self {
        let changed = |s: &Rc<Subject>| change(s).map_or_else(|| Rc::clone(s), Rc::new);
        let subjects = self.subjects.iter().map(changed).collect();
        let (habits, turns) = (Rc::clone(&self.habits), self.turns.clone());
        let (own_tables, authors) = (Rc::clone(&self.own_tables), self.authors.clone());
        let programs = self.programs.clone();
        let (has_robot, is_own, tables) = (self.has_robot, self.is_own, Rc::clone(&self.tables));
        let (posed, remarks, motion) =
            (self.posed.clone(), Rc::clone(&self.remarks), Rc::clone(&self.motion));
        Plan {
            subjects,
            habits,
            own_tables,
            authors,
            truths: self.truths.clone(),
            turns,
            has_robot,
            programs,
            posed,
            is_own,
            tables,
            remarks,
            motion,
        }
    }

    /// The same document, claims at these places taken as the author prints them.
    pub fn with_authors(&self, authors: BTreeSet<usize>) -> Self {
        Plan { authors, ..self.with(&|_| None) }
    }

    /// The same document, the names of coordinates at these places taken for what they are.
    pub fn with_truths(&self, truths: BTreeMap<usize, (String, Expr)>) -> Self {
        Plan { truths, ..self.with(&|_| None) }
    }

    /// The same document, programs read in its own text.
    pub fn without_programs(&self) -> Self {
        Plan { programs: None, ..self.with(&|_| None) }
    }

    /// The same document, its lengths without a unit in millimetres or in metres; only tables of its own have such.
    pub fn with_unit(&self, millimetres: bool) -> Self {
        let plan = self.with_habits(Habits { scaled: millimetres, ..Habits::clone(&self.habits) });
        if millimetres == self.habits.scaled {
            return plan;
        }
        let thousand = Rational::from(1000);
        let factor = if millimetres { thousand } else { &Rational::ONE / &thousand };
        plan.with(&|s| Some(s.in_unit(&factor)))
    }

    /// The same document, the hand at a place in the last frame.
    pub fn with_tool(&self, place: &Vector<Expr>) -> Self {
        self.with(&|s| Some(s.with(with_tool_at(&s.description, place))))
    }

    /// The same document, lengths in numbers under a letter with the number of their row.
    pub fn with_lengths(&self, letter: char) -> Self {
        self.with(&|s| with_lengths(s, letter))
    }

    /// The same document with names in other senses.
    pub fn with_habits(&self, habits: Habits) -> Self {
        Plan { habits: Rc::new(habits), ..self.with(&|_| None) }
    }

    /// Reads the statements.
    pub fn walk(&self, text: &str, document: &Document, options: &CheckOptions) -> Walked {
        let (mut names, mut inverse_names, mut stated) = (vec![], vec![], vec![]);
        let mut walk = Walk::new(text, &self.subjects[0], &self.habits);
        let mut ignored = vec![];
        let mut turns = self.turns.iter().skip(1).peekable();
        let mut is_off = false;
        let mut told = options.claim.as_deref();
        let mut is_read = vec![false; document.statements.len()];
        for (at, statement) in document.statements.iter().enumerate() {
            while let Some(&(_, number)) = turns.next_if(|t| t.0 <= statement.span.start) {
                names.push(Rc::new(walk.lexis.names.clone()));
                inverse_names.push(Rc::new(walk.lexis.inverse_names()));
                stated.push(walk.at.lengths_alone());
                walk.turn_to(&self.subjects[number], number);
            }
            let mut claim = told.take();
            let mut is_skipped = false;
            for directive in &statement.directives {
                match words(directive) {
                    ("off", _) => is_off = true,
                    ("on", _) => is_off = false,
                    ("skip", _) => is_skipped = true,
                    ("claim", words) => claim = Some(words),
                    ("euler" | "angles", words) => walk.angles = set_in(words),
                    ("alias" | "let", words) => {
                        if let Some((name, meaning)) = words.split_once('=') {
                            let done = walk.alias(name.trim(), meaning.trim());
                            if done.is_none() {
                                walk.skipped.push((directive.span.clone(), Unreadable::Alias));
                            }
                        }
                    }
                    _ => {}
                }
            }
            let is_row = |t: &Range<usize>| t.start <= statement.span.start && statement.span.end <= t.end;
            if is_off || is_skipped || self.tables.iter().any(is_row) {
                ignored.push(statement.span.clone());
            } else if walk.count() < super::MAX_FORMULAS && !is_read[at] {
                let first = walk.assertions.len();
                let limit = turns.peek().map_or(text.len(), |t| t.0);
                for k in order::before(text, &document.statements, at, &self.habits) {
                    let other = &document.statements[k];
                    let is_plain = other.directives.is_empty() && other.span.end <= limit;
                    if is_plain && !is_read[k] && walk.may_define(other) {
                        walk.ahead_of(statement, other);
                        is_read[k] = true;
                    }
                }
                walk.statement(statement, claim);
                if !self.authors.is_empty() {
                    walk.believe(&self.authors, first);
                }
                walk.mend(self.truths.range(statement.span.clone()).map(|t| t.1));
            }
        }
        names.push(Rc::new(walk.lexis.names.clone()));
        inverse_names.push(Rc::new(walk.lexis.inverse_names()));
        stated.push(walk.at.lengths_alone());
        let (mut assertions, mut refused) = (walk.assertions, vec![]);
        let of_document = assertions.len();
        let source = self.programs.as_deref().unwrap_or(text);
        let (mut followed, mut unsaid, mut numbers, mut tested) = (vec![], vec![], vec![], vec![]);
        for (number, language, blocks) in self.blocks(text, document, options) {
            let outputs = blocks::outputs(text, document, &blocks);
            let of = Source {
                text,
                source,
                blocks: &blocks,
                outputs: &outputs,
                language,
                number,
                posed: &self.posed,
            };
            let found = programs::assertions(&of, &self.subjects[number], &self.habits);
            assertions.extend(found.assertions);
            refused.extend(found.refused);
            followed.extend(found.followed);
            unsaid.extend(found.unsaid);
            numbers.extend(found.numbers);
            tested.extend(found.tested);
            walk.defined.extend(found.defined);
        }
        walk.defined.sort_by_key(|d| d.from);
        // What a program shows in its comments is said there.
        let mut shown: Vec<Range<usize>> = assertions[of_document..]
            .iter()
            .map(|a: &Assertion| a.span.clone())
            .filter(|s| remarks::is_in(s, &self.remarks))
            .collect();
        shown.sort_by_key(|s| s.start);
        let is_twice = |a: &Assertion| remarks::is_in(&a.span, &shown);
        let mut number = 0;
        assertions.retain(|a| {
            number += 1;
            number > of_document || !remarks::is_idle(a, &self.remarks) && !is_twice(a)
        });
        ignored.extend(self.remarks.iter().cloned());
        assertions.extend(points(&walk.defined, &assertions, &self.subjects));
        assertions.sort_by_key(|a| a.span.start);
        of_other_points(&mut assertions, &self.subjects);
        Walked {
            assertions,
            skipped: walk.skipped,
            taken: walk.taken,
            answered: walk.answered,
            goals: walk.goals,
            assumed: walk.assumed,
            ignored,
            named: walk.named,
            defined: walk.defined,
            refused,
            followed,
            unsaid,
            numbers,
            tested,
            names,
            inverse_names,
            stated,
        }
    }
}

/// How tables are set in a document.
pub(super) fn kind_of_tables(format: Format) -> TableKind {
    if format == Format::Latex { TableKind::Latex } else { TableKind::Markdown }
}

/// True for a line that says how tables are read: `convention: craig`, `lengths: mm`.
pub(super) fn is_setting(line: &str) -> bool {
    let lower = line.to_lowercase();
    ["convention:", "columns:", "angles:", "lengths:", "name:"].iter().any(|k| lower.starts_with(k))
}

enum Event<'a> {
    Table(&'a PrintedTable),
    Directive(&'a Directive),
}

/// A robot without links, for what holds of any.
fn nothing(convention: Convention) -> Description {
    Description {
        name: "any robot".into(),
        source: None,
        convention,
        parameters: vec![],
        rows: vec![],
        base: Transform::identity(),
        tool: Transform::identity(),
        poses: vec![],
        gravity: None,
    }
}

/// All directives of a document.
fn directives(document: &Document) -> impl Iterator<Item = &Directive> {
    document.statements.iter().flat_map(|s| &s.directives).chain(&document.directives)
}
