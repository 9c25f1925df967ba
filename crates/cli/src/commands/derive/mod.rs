//! `denavit derive`: formulas, in the format asked for.

pub mod html;
mod json;
pub mod latex;
mod terminal;
pub mod typst;

use crate::arguments::{DeriveArguments, Format, RobotArguments};
use crate::failure::Failure;
use crate::load;
use denavit::description::Description;
use denavit::forward::{ForwardModel, Outputs, Proof, Reference, link_transforms};
use denavit::geometry::Transform;
use denavit_program::Step;
use denavit_symbolic::Expr;
use denavit_symbolic::print::{Style, print};
use denavit_symbolic::vocabulary::Vocabulary;
use std::io::Write;

/// Derives a robot's formulas.
///
/// # Errors
/// If there is no such robot or frame, or nothing can be written.
pub fn run(arguments: &DeriveArguments) -> Result<(), Failure> {
    let description = load::robot(&arguments.robot)?;
    let from = reference(&description, &arguments.from, "--from")?;
    let to = reference(&description, &arguments.to, "--to")?;
    let outputs: Outputs = arguments.only.parse().map_err(|e| Failure::Usage(format!("--only: {e}")))?;
    let derivation = Derivation::new(&description, from, to, outputs);
    let format = if arguments.json { Format::Json } else { arguments.format };
    write!(anstream::stdout(), "{}", derivation.printed(format))?;
    derivation.verdict()
}

/// The simplified pose of the tool alone, for `fk --symbolic`.
///
/// # Errors
/// As [`run`].
pub fn matrix_only(robot: &RobotArguments, format: Format) -> Result<(), Failure> {
    let description = load::robot(robot)?;
    let derivation = Derivation::new(&description, Reference::Base, Reference::Tool, Outputs::ALL);
    let text =
        if format == Format::Json { derivation.printed(format) } else { terminal::forward(&derivation) };
    write!(anstream::stdout(), "{text}")?;
    derivation.verdict()
}

/// A frame by name or number.
///
/// # Errors
/// If the robot has no such frame.
pub fn reference(d: &Description, text: &str, option: &str) -> Result<Reference, Failure> {
    let last = d.rows.len();
    match (text, text.parse::<usize>()) {
        ("base", _) => Ok(Reference::Base),
        ("tool", _) => Ok(Reference::Tool),
        (_, Ok(i)) if i <= last => Ok(Reference::Frame(i)),
        _ => Err(Failure::Usage(format!("{option} {text}: `base`, `tool`, or a frame from 0 to {last}"))),
    }
}

/// Everything that is printed, whatever the format.
pub struct Derivation<'a> {
    description: &'a Description,
    /// The robot's names and those of the algorithm's intermediates.
    names: Vocabulary,
    links: Vec<[[Expr; 4]; 4]>,
    model: ForwardModel,
    steps: Vec<Step>,
}

impl<'a> Derivation<'a> {
    fn new(description: &'a Description, from: Reference, to: Reference, outputs: Outputs) -> Self {
        let model = ForwardModel::derive(description, from, to, outputs);
        let steps = model.algorithm.steps();
        let names = steps.iter().fold(description.vocabulary(), |v, step| v.symbol(&step.name));
        Derivation { description, names, links: link_transforms(description), model, steps }
    }

    fn printed(&self, format: Format) -> String {
        match format {
            Format::Terminal => terminal::document(self),
            Format::Latex => latex::document(self),
            Format::Typst => typst::document(self),
            Format::Html => html::document(self),
            Format::Json => json::document(self),
        }
    }

    /// Whether everything was expanded and proved.
    fn verdict(&self) -> Result<(), Failure> {
        match (&self.model.matrix, self.model.proof) {
            (Err(why), _) => Err(Failure::GaveUp(format!("the matrix is not expanded: {why}"))),
            (_, Proof::Proved) => Ok(()),
            (_, proof) => Err(Failure::GaveUp(format!("the algorithm is {proof}"))),
        }
    }

    fn text(&self, e: Expr, style: Style) -> String {
        print(e, &self.names, style)
    }

    /// A formula with sines and cosines in full: cos(q2 + q3).
    fn in_full(&self, e: Expr, style: Style) -> String {
        print(e, &Vocabulary::new(), style)
    }

    /// Name and value, `C23` and cos(q2 + q3), of each sine and cosine that the algorithm takes and that has a
    /// short name; along the chain, cosine first.
    fn trigonometry(&self) -> Vec<(String, Expr)> {
        let taken = self.model.algorithm.sines_and_cosines().into_iter();
        let named = taken.map(|e| (self.text(e, Style::Ascii), e));
        let mut named: Vec<(String, Expr)> =
            named.filter(|(name, e)| *name != self.in_full(*e, Style::Ascii)).collect();
        let indices = |name: &str| -> Vec<u32> {
            let text = name[1..].trim_start_matches("_{").trim_end_matches('}');
            match text.contains([',', '-']) {
                true => text.split([',', '-']).filter_map(|n| n.parse().ok()).collect(),
                false => text.chars().filter_map(|c| c.to_digit(10)).collect(),
            }
        };
        named.sort_by_cached_key(|(name, _)| (indices(name), name.clone()));
        named
    }

    /// The names of the two frames: `0` and `6`, or `base` and `tool` where those differ from them.
    fn frames(&self) -> [String; 2] {
        let d = self.description;
        [self.model.from, self.model.to].map(|r| match r {
            Reference::Base if d.base == Transform::identity() => "0".into(),
            Reference::Base => "base".into(),
            Reference::Frame(i) => i.to_string(),
            Reference::Tool if d.tool == Transform::identity() => d.rows.len().to_string(),
            Reference::Tool => "tool".into(),
        })
    }
}
