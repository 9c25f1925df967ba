//! What a report is about: the robot, a configuration, what was asked for.

use crate::cell::{cell, decimals};
use crate::document::Line;
use crate::figure::Arm;
use crate::words::{Tongue, Wording};
use denavit::description::{Convention, Description, JointKind, Measure, Parameter};
use denavit::forward::{ForwardModel, Outputs, Reference};
use denavit::inverse::{InverseModel, JointSpace, Refusal};
use denavit::robot::Robot;
use denavit::structure::Structure;
use denavit::velocity::{Obstacle, Singularities, regular_configuration};
use denavit_check::Checked;
use denavit_symbolic::Expr;
use std::cell::OnceCell;

/// A section that can be asked for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Topic {
    /// The robot at a glance.
    Summary,
    /// The arm as it looks, and as a line diagram.
    Figures,
    /// The Denavit–Hartenberg table.
    Table,
    /// The link transforms.
    Links,
    /// The forward model and its algorithm.
    Forward,
    /// Numbers at a configuration.
    Example,
    /// Inverse kinematics.
    Inverse,
    /// The Jacobian and its singularities.
    Velocity,
    /// Base parameters and torques, of an arm with masses.
    Dynamics,
    /// What is reached.
    Workspace,
    /// What is wrong in the document that the robot comes from.
    Errata,
    /// Where methods and numbers come from.
    References,
}

impl Topic {
    /// All of them, in their order.
    pub const ALL: [Topic; 12] = [
        Topic::Summary,
        Topic::Figures,
        Topic::Table,
        Topic::Links,
        Topic::Forward,
        Topic::Example,
        Topic::Inverse,
        Topic::Velocity,
        Topic::Dynamics,
        Topic::Workspace,
        Topic::Errata,
        Topic::References,
    ];
}

/// How much a report says.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Level {
    /// The results: no worked example, no steps of derivations, no pictures of solutions and singularities.
    Short,
    /// Everything.
    #[default]
    Full,
}

impl Level {
    /// The sections that it has where nobody chooses them.
    pub fn topics(self) -> Vec<Topic> {
        let is_left_out =
            |t: &Topic| matches!(t, Topic::Links | Topic::Example | Topic::Workspace | Topic::References);
        Topic::ALL.into_iter().filter(|t| self == Level::Full || !is_left_out(t)).collect()
    }
}

/// What a report contains.
#[derive(Clone, Debug)]
pub struct ReportOptions<'a> {
    /// The language of the words.
    pub language: Tongue,
    /// The title; one that names the robot otherwise.
    pub title: Option<String>,
    /// Who hands it in.
    pub author: Option<String>,
    /// How much is said in the sections.
    pub level: Level,
    /// The sections.
    pub topics: Vec<Topic>,
    /// Conventions in which the table is shown beside its own.
    pub conventions: Vec<Convention>,
    /// The configuration of figures and examples, radians and metres; one that shows the arm well otherwise.
    pub pose: Option<Vec<f64>>,
    /// What was found in the document that the robot comes from.
    pub errata: Option<Errata<'a>>,
    /// Whether figures are to fill slides.
    pub for_slides: bool,
}

impl Default for ReportOptions<'_> {
    fn default() -> Self {
        ReportOptions {
            language: Tongue::English,
            title: None,
            author: None,
            level: Level::Full,
            topics: Topic::ALL.to_vec(),
            conventions: vec![],
            pose: None,
            errata: None,
            for_slides: false,
        }
    }
}

/// A document that was checked.
#[derive(Clone, Copy, Debug)]
pub struct Errata<'a> {
    /// What it is called.
    pub name: &'a str,
    /// Its text.
    pub text: &'a str,
    /// What was found.
    pub checked: &'a Checked,
}

/// The robot with everything that several sections need, derived when it is first asked for.
pub struct Setting<'a> {
    pub description: Description,
    pub options: ReportOptions<'a>,
    pub structure: Structure,
    /// The robot with values for all lengths, some of them chosen here.
    pub valued: Description,
    /// Its pictures; none if it cannot be drawn.
    pub arm: Option<Arm>,
    /// The configuration of figures and examples.
    pub q: Vec<f64>,
    forward: OnceCell<ForwardModel>,
    inverse: OnceCell<Result<InverseModel, Refusal>>,
    singular: OnceCell<Result<Singularities, Obstacle>>,
}

impl<'a> Setting<'a> {
    pub fn new(description: &Description, options: &ReportOptions<'a>) -> Self {
        let (description, inverse) = named(description);
        let valued = description.filled();
        let arm = Arm::new(&valued).ok();
        let joints = description.variables().len();
        let given = options.pose.clone().filter(|q| q.len() == joints);
        let q = given.unwrap_or_else(|| {
            let shown = arm.as_ref().map_or_else(|| vec![0.0; joints], |a| a.pose().to_vec());
            regular_configuration(&valued, shown)
        });
        let arm = arm.map(|a| if a.pose() == q { a } else { a.at(&q) });
        Setting {
            options: options.clone(),
            structure: Structure::of(&description),
            description,
            valued,
            arm,
            q,
            forward: OnceCell::new(),
            inverse,
            singular: OnceCell::new(),
        }
    }

    /// The words of its language.
    pub fn words(&self) -> &'static dyn Wording {
        self.options.language.words()
    }

    /// The pose of the tool in the base.
    pub fn forward(&self) -> &ForwardModel {
        let derive =
            || ForwardModel::derive(&self.description, Reference::Base, Reference::Tool, Outputs::ALL);
        self.forward.get_or_init(derive)
    }

    /// The inverse model, or how far its derivation came.
    pub fn inverse(&self) -> &Result<InverseModel, Refusal> {
        let options = denavit::inverse::InverseOptions::default();
        self.inverse.get_or_init(|| InverseModel::derive(&self.description, &options))
    }

    /// Where the arm is singular.
    pub fn singular(&self) -> &Result<Singularities, Obstacle> {
        self.singular.get_or_init(|| Singularities::derive(&self.description, Reference::Tool))
    }

    /// The robot in numbers.
    pub fn robot(&self) -> Option<(Robot<f64>, JointSpace)> {
        let robot = Robot::numeric(&self.valued).ok()?;
        let space = JointSpace::new(&self.valued, &robot);
        Some((robot, space))
    }

    /// The lengths that the robot does not give, with the values that numbers here take for them; nothing if it gives all.
    pub fn assumed(&self) -> Option<Line> {
        let missing = self.description.parameters.iter().zip(&self.valued.parameters);
        let chosen: Vec<_> = missing.filter(|(own, _)| own.value.is_none()).map(|(_, p)| p).collect();
        (!chosen.is_empty()).then(|| {
            quantities(Line::new(self.words().assumed_lengths()), &self.valued, &chosen, self.words())
        })
    }

    /// The values of the joints in a line: `q1 = 30°, …`.
    pub fn configuration(&self, q: &[f64]) -> Line {
        let mut line = Line::default();
        for (k, (x, v)) in q.iter().zip(self.description.variables()).enumerate() {
            line = line.text(if k > 0 { self.words().between() } else { "" }).math(Expr::from(v.symbol));
            line = line.text(format!(" = {}", self.reading(*x, v.kind)));
        }
        line
    }

    /// A joint's value with its unit.
    pub fn reading(&self, x: f64, kind: JointKind) -> String {
        self.words().written(match kind {
            JointKind::Revolute => format!("{}°", decimals(x.to_degrees(), 2)),
            JointKind::Prismatic => format!("{} m", decimals(x, 4)),
        })
    }
}

/// Parameters with their values and units behind the start of a sentence: `a2 = 0.4 m, … .`
pub fn quantities(mut line: Line, d: &Description, all: &[&Parameter], words: &dyn Wording) -> Line {
    let known = all.iter().filter_map(|p| Some((p.symbol, p.value?)));
    for (k, (symbol, value)) in known.enumerate() {
        let unit = match d.measure(symbol) {
            Measure::Angle | Measure::Other("") => String::new(),
            Measure::Length => " m".into(),
            Measure::Other(unit) => format!(" {unit}"),
        };
        line = line.text(if k > 0 { words.between() } else { "" }).math(Expr::from(symbol)).text(" = ");
        line.0.extend(cell(value, d.measure(symbol) == Measure::Angle, words).0);
        line = line.text(unit);
    }
    line.text(".")
}

/// The robot with names for the lengths that are numbers, and its inverse model if that had to be derived; as it is where a
/// closed form depends on what the numbers are.
fn named(description: &Description) -> (Description, OnceCell<Result<InverseModel, Refusal>>) {
    let named = description.with_named_lengths();
    if named.parameters.len() == description.parameters.len() {
        return (named, OnceCell::new());
    }
    let options = denavit::inverse::InverseOptions::default();
    let model = InverseModel::derive(&named, &options);
    if model.is_err() {
        let own = InverseModel::derive(description, &options);
        if own.is_ok() {
            return (description.clone(), OnceCell::from(own));
        }
    }
    (named, OnceCell::from(model))
}
