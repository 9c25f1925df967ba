//! The link transforms, a forward model and its algorithm as a document.

use crate::document::{Document, Factor, Line, Math, Part, Section};
use crate::render::too_long;
use crate::words::{Heading, Names, Tongue, Wording};
use denavit::description::Description;
use denavit::forward::{ForwardModel, Outputs, Reference, link_transforms};
use denavit::geometry::Transform;
use denavit_program::Step;
use denavit_symbolic::print::{Style, print};
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Expr, Node};

/// A forward model with the names that its formulas use.
pub struct Derivation<'a> {
    /// The robot.
    pub description: &'a Description,
    /// The robot's names and those of the algorithm's intermediates.
    pub names: Vocabulary,
    /// One matrix a row of the table.
    pub links: Vec<[[Expr; 4]; 4]>,
    /// The model.
    pub model: ForwardModel,
    /// Its algorithm, step by step.
    pub steps: Vec<Step>,
}

impl<'a> Derivation<'a> {
    /// Derives the model of one frame in another.
    pub fn new(description: &'a Description, from: Reference, to: Reference, outputs: Outputs) -> Self {
        Self::of(description, ForwardModel::derive(description, from, to, outputs))
    }

    /// Of a model that is derived already.
    pub fn of(description: &'a Description, model: ForwardModel) -> Self {
        let steps = model.algorithm.steps();
        let names = steps.iter().fold(description.vocabulary(), |v, step| v.symbol(&step.name));
        Derivation { description, names, links: link_transforms(description), model, steps }
    }

    /// A formula in a style.
    pub fn text(&self, e: Expr, style: Style) -> String {
        print(e, &self.names, style)
    }

    /// A formula with sines and cosines in full: cos(q2 + q3).
    pub fn in_full(&self, e: Expr, style: Style) -> String {
        print(e, &Vocabulary::new(), style)
    }

    /// Name and value, `C23` and cos(q2 + q3), of each sine and cosine that the algorithm takes and that has a
    /// short name; along the chain, cosine first.
    pub fn trigonometry(&self) -> Vec<(String, Expr)> {
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
    pub fn frames(&self) -> [String; 2] {
        self.frames_in(Tongue::English.words())
    }

    fn frames_in(&self, words: &dyn Wording) -> [String; 2] {
        let d = self.description;
        [self.model.from, self.model.to].map(|r| match r {
            Reference::Base if d.base == Transform::identity() => "0".into(),
            Reference::Base => words.base(),
            Reference::Frame(i) => i.to_string(),
            Reference::Tool if d.tool == Transform::identity() => d.rows.len().to_string(),
            Reference::Tool => words.tool(),
        })
    }

    /// A point with these coordinates in the frame that the pose is of, in the frame that it is given in: R·x + p; of a free vector,
    /// which has a direction and no place, R·x. Nothing if the matrix is not expanded.
    pub fn image(&self, of: [Expr; 3], is_point: bool) -> Option<[Expr; 3]> {
        let rows = self.model.matrix.as_ref().ok()?;
        let last = Expr::int(i64::from(is_point));
        let image = |row: &[Expr; 4]| {
            let turned = (0..3).fold(Expr::int(0), |sum, k| sum + row[k] * of[k]);
            turned + row[3] * last
        };
        Some([0, 1, 2].map(|r| image(&rows[r])))
    }

    /// What is said of a point, or of a free vector, and its coordinates in the other frame.
    pub fn image_section(&self, of: [Expr; 3], is_point: bool, language: Tongue) -> Section {
        let words = language.words();
        let [from, to] = self.frames_in(words);
        let mut section = Section::new(
            of.iter()
                .flat_map(|e| e.symbols())
                .fold(self.description.vocabulary(), |v, s| v.symbol(&s.name())),
        );
        section.heading(2, Line::new(words.image_title(is_point)));
        section.paragraph(words.image(is_point, of.map(Math::Expr), &from, &to));
        if let Some(image) = self.image(of, is_point) {
            // Names that the coordinates do not have themselves.
            let letters = if is_point { ["p", "r", "s"] } else { ["v", "u", "w"] };
            let named = |letter: &str| ["x", "y", "z"].map(|axis| format!("{letter}{axis}"));
            let taken = |name: &String| of.iter().flat_map(|e| e.symbols()).any(|s| *s.name() == **name);
            let free = letters.into_iter().map(named).find(|names| !names.iter().any(taken));
            let names = free.unwrap_or_else(|| named("image_"));
            section.names = names.iter().fold(section.names, |v, name| v.symbol(name));
            let equations = names.iter().zip(image).map(|(name, e)| Math::equation(Expr::symbol(name), e));
            section.push(Part::Equations(equations.collect()));
        }
        section
    }

    /// The matrix and its algorithm, a section each; headings have this level.
    pub fn sections(&self, level: u8, language: Tongue) -> [Section; 2] {
        let words = language.words();
        // An entry of the matrix is called as the algorithm calls it: t11.
        let mut section = Section::new(self.description.vocabulary());
        let [from, to] = self.frames_in(words);
        let frame = Factor::Frame { from: from.clone(), to: to.clone() };
        let title = Line::new(words.forward_title());
        section.heading(level, title.math(Math::Product(vec![frame])));
        match &self.model.matrix {
            Ok(rows) if too_long(&matrix(&from, &to, rows), &section.names) => {
                section.paragraph(Line::new(words.long_matrix()));
            }
            Ok(rows) => section.formula(matrix(&from, &to, rows)),
            Err(why) => section.paragraph(Line::new(words.no_matrix(*why))),
        }
        let matrix = section;
        let mut section = Section::new(self.names.clone());
        section.heading(level, Line::new(words.heading(Heading::Algorithm)));
        section.paragraph(Line::new(words.shortest_program()));
        section.paragraph(self.legend(words));
        let steps = self.steps.iter().filter(|s| !(s.is_output && s.value.as_number().is_some()));
        let steps = steps.map(|s| Math::equation(Expr::symbol(&s.name), s.value));
        section.push(Part::Equations(steps.collect()));
        let cost = words.forward_cost(&self.model.algorithm.count(), self.model.proof);
        section.paragraph(Line::new(cost));
        section.paragraph(Line::new(words.counting_rule()));
        [matrix, section]
    }

    /// What the short names of sines and cosines mean, angle by angle.
    fn legend(&self, words: &dyn Wording) -> Line {
        let mut angles: Vec<(Expr, Vec<Expr>)> = vec![];
        for (_, e) in self.trigonometry() {
            let (Node::Sin(angle) | Node::Cos(angle)) = e.node() else { continue };
            match angles.iter_mut().find(|a| a.0 == angle) {
                Some(known) => known.1.push(e),
                None => angles.push((angle, vec![e])),
            }
        }
        let is_cosine = |e: &Expr| matches!(e.node(), Node::Cos(_));
        let names = angles.into_iter().map(|(angle, taken)| Names {
            has_cosine: taken.iter().any(is_cosine),
            has_sine: !taken.iter().all(is_cosine),
            names: taken.into_iter().map(Math::from).collect(),
            angle,
        });
        words.names(names.collect())
    }

    /// The document of `denavit derive`.
    pub fn document(&self, language: Tongue) -> Document {
        let mut links = Section::new(self.names.clone());
        links.heading(2, Line::new(language.words().heading(Heading::Links)));
        links.push(transforms(&self.links));
        let [matrix, algorithm] = self.sections(2, language);
        Document {
            title: self.description.name.clone(),
            author: None,
            language,
            sections: vec![links, matrix, algorithm],
        }
    }
}

/// The link transforms side by side.
pub fn transforms(links: &[[[Expr; 4]; 4]]) -> Part {
    let all = links.iter().enumerate();
    Part::Beside(all.map(|(i, link)| matrix(&i.to_string(), &(i + 1).to_string(), link)).collect())
}

/// A homogeneous matrix with the names of its frames.
pub fn matrix(from: &str, to: &str, rows: &[[Expr; 4]; 4]) -> Math {
    let frame = Factor::Frame { from: from.into(), to: to.into() };
    Math::Matrix(frame, rows.iter().map(|r| r.to_vec()).collect())
}
