//! The two sheets of an exercise, put together from what is asked and answered.

use super::{Exercise, ExerciseOptions};
use crate::document::{Block, Document, Line, Math, Part, Section};
use crate::figure::{FigureOptions, scheme};
use crate::sections::{self, Setting};
use crate::words::{Caption, ExerciseKind, Heading, Wording};
use crate::{ReportOptions, decimals};
use denavit::description::{Description, JointKind, Variable};
use denavit_check::Answer;
use denavit_check::marking::{Asked as Configuration, Form, Item, Rubric, Subject};
use denavit_symbolic::Expr;
use denavit_symbolic::print::Style;
use denavit_symbolic::vocabulary::Vocabulary;

/// What is asked, in its order.
pub(super) struct Asked {
    /// What is given beside the robot, below the tasks.
    pub given: Vec<Section>,
    pub tasks: Vec<Task>,
}

/// A task with its answer.
#[derive(Default)]
pub(super) struct Task {
    /// What it is called on the sheet of points.
    pub name: String,
    /// What is to be done.
    pub words: Line,
    pub points: u32,
    /// The left sides of what answers it, as [`Item::claims`] has them.
    pub claims: Vec<String>,
    /// How many formulas the answer has.
    pub formulas: usize,
    /// Values that it asks for, which say nothing of the robot by themselves.
    pub answers: Vec<Answer>,
    /// What it asks for, by which answers are found whatever they are called.
    pub about: Vec<Subject>,
    /// Whether it asks for formulas or for numbers, where it is one of these alone.
    pub form: Option<Form>,
    /// All configurations that answer it.
    pub configurations: Vec<Configuration>,
    /// All values of joints that answer it, as [`Item::zeros`] has them.
    pub zeros: Vec<(usize, String)>,
    /// Numbers that it asks for beside these.
    pub fields: Vec<Field>,
    /// Whether it asks for formulas, alone or beside numbers.
    pub has_formulas: bool,
    pub answer: Vec<Section>,
}

/// A task as systems have it that ask and mark by themselves.
#[derive(Clone, Debug)]
pub(super) struct Question {
    pub name: String,
    pub words: Line,
    pub points: u32,
    /// Numbers that answer it; none where it asks for formulas.
    pub fields: Vec<Field>,
    /// Whether it asks for formulas, too.
    pub has_formulas: bool,
    pub answer: Vec<Section>,
    /// The names in its words.
    pub names: Vocabulary,
}

/// A number that is asked for.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Field {
    /// Where it holds: the title of a configuration, or nothing.
    pub group: String,
    /// What it is called, in LaTeX.
    pub label: String,
    pub value: f64,
    pub unit: String,
    /// How far the digits of what is given let it be off.
    pub within: f64,
}

impl Field {
    /// The entries of a matrix of numbers, but zeros and ones.
    pub(super) fn entries(group: &str, math: &Math, names: &Vocabulary) -> Vec<Field> {
        let Math::Numbers(factor, rows) = math else { return vec![] };
        let matrix = claimed(&Math::Product(vec![factor.clone()]), names);
        let mut fields = vec![];
        for (r, row) in (1..).zip(rows) {
            for (c, x) in (1..).zip(row).filter(|(_, x)| !matches!(x.as_str(), "0" | "1")) {
                fields.push(Field {
                    group: group.into(),
                    label: format!("({matrix})_{{{r}{c}}}"),
                    value: x.parse().unwrap_or_default(),
                    unit: String::new(),
                    within: 0.0,
                });
            }
        }
        fields
    }
}

impl Task {
    /// The numbers of its answers: of those with the same names, one for each configuration.
    fn question(&self, words: &dyn Wording, names: &Vocabulary) -> Question {
        let mut fields = self.fields.clone();
        for (k, answer) in self.answers.iter().enumerate() {
            let (Ok(value), Some(name)) = (answer.value.parse(), answer.names.first()) else { continue };
            let alike = |all: &[Answer]| all.iter().filter(|other| other.names == answer.names).count();
            let several = alike(&self.answers) > 1;
            let group = several.then(|| words.configuration_title(alike(&self.answers[..=k])));
            let symbol = Expr::symbol(name);
            let label = claimed(&Math::Expr(symbol), &names.clone().symbol(name));
            fields.push(Field {
                group: group.unwrap_or_default(),
                label,
                value,
                unit: answer.unit.clone(),
                within: 0.0,
            });
        }
        fields.sort_by(|a, b| a.group.cmp(&b.group));
        Question {
            name: self.name.clone(),
            words: self.words.clone(),
            points: self.points,
            fields,
            has_formulas: self.has_formulas,
            answer: self.answer.clone(),
            names: self.answer.first().map_or_else(|| names.clone(), |s| s.names.clone()),
        }
    }
}

/// What the sheets of all kinds have in common.
pub(super) struct Ground<'a> {
    pub setting: Setting<'a>,
    pub options: &'a ExerciseOptions,
}

impl<'a> Ground<'a> {
    pub(super) fn new(robot: &Description, options: &'a ExerciseOptions) -> Self {
        let report = ReportOptions { language: options.language, ..ReportOptions::default() };
        Ground { setting: Setting::new(robot, &report), options }
    }

    pub(super) fn words(&self) -> &'static dyn Wording {
        self.setting.words()
    }

    pub(super) fn names(&self) -> Vocabulary {
        self.setting.description.vocabulary()
    }

    /// Joint values below a heading with a number.
    pub(super) fn given(&self, all: &[Vec<f64>]) -> Vec<Section> {
        let mut section = Section::new(self.names());
        for (k, q) in all.iter().enumerate() {
            section.heading(3, Line::new(self.words().configuration_title(k + 1)));
            section.paragraph(self.configuration(q));
        }
        vec![section]
    }

    /// The values of the joints in a line, each a formula: degrees with two decimals and metres with four.
    pub(super) fn configuration(&self, q: &[f64]) -> Line {
        let value = |(x, v): (&f64, &Variable)| match v.kind {
            JointKind::Revolute => quantity(v.symbol.into(), x.to_degrees(), 2, "°"),
            JointKind::Prismatic => quantity(v.symbol.into(), *x, 4, "m"),
        };
        let all = q.iter().zip(&self.setting.description.variables()).map(value).collect::<Vec<_>>();
        Line::default().numbers(all, self.words().between())
    }

    /// What people call joints and sums of them: `q1`, `θ12`; slides `d3`, `r3`.
    pub(super) fn joints(&self) -> Vec<String> {
        let slides = (1..).zip(self.setting.description.variables());
        let slides = slides.filter(|(_, v)| v.kind == JointKind::Prismatic);
        let named = slides.flat_map(|(k, _)| [format!("d{k}"), format!("r{k}")]);
        ["q*", "theta*", "th*"].map(String::from).into_iter().chain(named).collect()
    }

    /// The exercise.
    pub(super) fn exercise(self, asked: Asked) -> Exercise {
        let (kind, name, words) = (self.options.kind, &self.setting.description.name, self.words());
        let document = |title: String, sections: Vec<Section>| Document {
            title,
            author: None,
            language: self.options.language,
            sections,
        };
        let mut statement = self.arm();
        let mut tasks = Section::new(self.names());
        tasks.heading(2, Line::new(words.tasks()));
        let line = |t: &Task| {
            let mut line = t.words.clone();
            line = line.text(format!(" {}", words.points(t.points)));
            line
        };
        tasks.push(Block::List(asked.tasks.iter().map(line).collect()));
        statement.push(tasks);
        statement.extend(asked.given);
        let items = asked.tasks.iter().map(|t| Item {
            name: t.name.clone(),
            claims: t.claims.clone(),
            points: f64::from(t.points),
            whole: false,
            formulas: t.formulas,
            answers: t.answers.clone(),
            about: t.about.clone(),
            form: t.form,
            configurations: t.configurations.clone(),
            zeros: t.zeros.clone(),
        });
        let title = words.exercise_title(kind, name);
        let rubric =
            Rubric { title: Some(title.clone()), conditional: 0.5, carried: 1.0, items: items.collect() };
        let questions = asked.tasks.iter().map(|t| t.question(words, &self.names())).collect();
        let answers = asked.tasks.into_iter().flat_map(|task| {
            let mut heading = Section::new(self.names());
            heading.heading(2, Line::new(task.name));
            [heading].into_iter().chain(task.answer)
        });
        let solution = document(words.solution_title(kind, name), answers.collect());
        Exercise {
            options: *self.options,
            statement: document(title, statement),
            solution,
            rubric,
            questions,
            robot: self.setting.description,
        }
    }

    /// The arm as it is given: a drawing, and its table where that is not what is asked for.
    fn arm(&self) -> Vec<Section> {
        let (s, words) = (&self.setting, self.words());
        let mut section = Section::new(self.names());
        section.paragraph(Line::new(words.seed(self.options.seed)));
        section.heading(2, Line::new(words.heading(Heading::Arm)));
        let is_table = self.options.kind == ExerciseKind::Table;
        if let Some(arm) = &s.arm {
            let look = FigureOptions { frames: !is_table, ..FigureOptions::main() };
            section.push(Part::figure(words, scheme(arm, &look), Line::new(words.caption(Caption::Scheme))));
        }
        if !is_table {
            sections::rows(s, &s.description, &mut section);
        }
        sections::values(s, &s.description, &mut section);
        if !is_table {
            sections::ends(s, &s.description, &mut section);
        }
        vec![section]
    }
}

/// How many entries count: not zeros and ones, unless there is nothing else.
pub(super) fn counted<'e>(entries: impl IntoIterator<Item = &'e Expr>) -> usize {
    let trivial = |e: &Expr| *e == Expr::int(0) || *e == Expr::int(1);
    entries.into_iter().filter(|e| !trivial(e)).count().max(1)
}

/// A number with at most so many digits behind the point, a hyphen for its minus sign.
pub(super) fn digits(x: f64, most: usize) -> String {
    decimals(x, most).replace('−', "-")
}

/// A value with its unit.
pub(super) fn quantity(of: Expr, x: f64, most: usize, unit: &'static str) -> Math {
    Math::Quantity { of, is_rate: false, digits: digits(x, most), unit }
}

/// A formula's text in LaTeX, as the left side of a claim.
pub(super) fn claimed(math: &Math, names: &Vocabulary) -> String {
    crate::document::math(math, names, Style::Latex)
}
