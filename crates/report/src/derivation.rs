//! The link transforms, a forward model and its algorithm as a document.

use crate::document::{Document, Part, Section};
use crate::render::too_long;
use denavit::description::Description;
use denavit::explain::{Factor, Language, Line, Math, Piece, count};
use denavit::forward::{ForwardModel, Outputs, Reference, link_transforms};
use denavit::geometry::Transform;
use denavit_program::{COUNTING_RULE, Step};
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
        self.frames_in(Language::English)
    }

    fn frames_in(&self, language: Language) -> [String; 2] {
        let d = self.description;
        [self.model.from, self.model.to].map(|r| match r {
            Reference::Base if d.base == Transform::identity() => "0".into(),
            Reference::Base => "base".into(),
            Reference::Frame(i) => i.to_string(),
            Reference::Tool if d.tool == Transform::identity() => d.rows.len().to_string(),
            Reference::Tool => language.pick("tool", "outil").into(),
        })
    }

    /// The matrix and its algorithm, a section each; headings have this level.
    pub fn sections(&self, level: u8, language: Language) -> [Section; 2] {
        let say = |english: &str, french: &str| language.spaced(language.pick(english, french));
        // An entry of the matrix is called as the algorithm calls it: t11.
        let mut section = Section::new(self.description.vocabulary());
        let [from, to] = self.frames_in(language);
        let frame = Factor::Frame { from: from.clone(), to: to.clone() };
        let title = Line::new(say("Forward model ", "Modèle géométrique direct "));
        section.heading(level, title.math(Math::Product(vec![frame])));
        match &self.model.matrix {
            Ok(rows) if too_long(&matrix(&from, &to, rows), &section.names) => {
                section.paragraph(Line::new(say(
                    "The entries of the matrix are too long to be printed; the algorithm below computes them.",
                    "Les éléments de la matrice sont trop longs pour être imprimés ; l'algorithme ci-dessous les calcule.",
                )));
            }
            Ok(rows) => section.formula(matrix(&from, &to, rows)),
            Err(why) => {
                let why = denavit::explain::refusal(*why, language);
                section.paragraph(Line::new(
                    say("The matrix is not expanded: ", "La matrice n'est pas développée : ") + &why + ".",
                ));
            }
        }
        let matrix = section;
        let mut section = Section::new(self.names.clone());
        section.heading(level, Line::new(say("Algorithm", "Algorithme")));
        section.paragraph(Line::new(say(
            "The same model as the shortest program that was found for it:",
            "Le même modèle, par le programme le plus court trouvé :",
        )));
        section.paragraph(self.legend(language));
        let steps = self.steps.iter().filter(|s| !(s.is_output && s.value.as_number().is_some()));
        let steps = steps.map(|s| Math::equation(Expr::symbol(&s.name), s.value));
        section.push(Part::Equations(steps.collect()));
        let cost = format!(
            "{}{} {}.",
            count(&self.model.algorithm.count(), language),
            language.pick(";", "\u{a0};"),
            self.model.proof.of_model(language)
        );
        section.paragraph(Line::new(cost));
        section.paragraph(Line::new(language.pick(
            format!("Counted: {COUNTING_RULE}."),
            language.spaced(
                "On compte chaque multiplication et chaque addition dont le résultat dépend d'une variable ; les signes ne \
                 comptent pas ; le sinus et le cosinus d'un même angle forment un couple ; une constante ajoutée à une \
                 variable (son décalage) et ce qui ne dépend que des paramètres sont comptés à part.",
            ),
        )));
        [matrix, section]
    }

    /// What the short names of sines and cosines mean, angle by angle.
    fn legend(&self, language: Language) -> Line {
        let mut angles: Vec<(Expr, Vec<Expr>)> = vec![];
        for (_, e) in self.trigonometry() {
            let (Node::Sin(angle) | Node::Cos(angle)) = e.node() else { continue };
            match angles.iter_mut().find(|a| a.0 == angle) {
                Some(known) => known.1.push(e),
                None => angles.push((angle, vec![e])),
            }
        }
        let mut line = Line::default();
        for (k, (angle, taken)) in angles.into_iter().enumerate() {
            line = line.text(if k > 0 { "; " } else { "" }).list(taken.iter().map(|&e| e.into()));
            let is_cosine = |e: &Expr| matches!(e.node(), Node::Cos(_));
            line = line.text(match (taken.iter().any(is_cosine), taken.iter().all(is_cosine)) {
                (true, true) => language.pick(": cosine of ", " : cosinus de "),
                (true, false) => language.pick(": cosine and sine of ", " : cosinus et sinus de "),
                (false, _) => language.pick(": sine of ", " : sinus de "),
            });
            line = line.math(angle);
        }
        let mut line = if line.0.is_empty() { line } else { line.text(".") };
        for piece in &mut line.0 {
            if let Piece::Text(words) = piece {
                *words = language.spaced(&words.replace("; ", language.pick("; ", " ; ")));
            }
        }
        line
    }

    /// The document of `denavit derive`.
    pub fn document(&self, language: Language) -> Document {
        let mut links = Section::new(self.names.clone());
        links.heading(2, Line::new(language.pick("Link transforms", "Matrices de passage")));
        links.push(transforms(&self.links));
        let [matrix, algorithm] = self.sections(2, language);
        Document { title: self.description.name.clone(), language, sections: vec![links, matrix, algorithm] }
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
