//! The derivation of an inverse model, every formula proved.
//!
//! An [`Explanation`] holds what is to be said, step by step; [`Explanation::document`] says it in a language.

mod names;
mod origin;
mod prove;
mod reading;
mod step;
mod written;

pub use crate::explained::{Bound, Case, Component, Consequence, Explained, Kind, Remark, Source, Statement};

pub(crate) use written::uses_letters;

use crate::document::{Block, Branch, Factor, Math, Proof};
use crate::words::Tongue;
use denavit::description::Description;
use denavit::geometry::Transform;
use denavit::inverse::Label;
use denavit::inverse::derivation::{
    Condition, Equations, Form, Goal, InverseModel, InverseOptions, Length, Norm, NormalChain, Split, Step,
    Stuck, Task, Unknown, axis_unknown, equations, settled,
};
use denavit_symbolic::poly::Poly;
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Expr, Node, Rational, Symbol};
use names::Names;
use origin::Matrices;
use prove::Prover;
use reading::Reading;
use step::Context;

/// How a derivation goes, step by step.
#[derive(Clone, Debug)]
pub struct Explanation {
    /// The robot that is solved.
    pub description: Description,
    /// What of the hand is given.
    pub goal: Goal,
    /// Joint variables that are given beside it.
    pub given: Vec<Expr>,
    /// True if the derivation chose them.
    pub given_by_choice: bool,
    /// Independent directions in which the hand can move, if that was asked.
    pub rank: Option<usize>,
    /// What the hand can be told.
    pub task: Option<Task>,
    /// The matrices A1, A2, … of the chain.
    pub matrices: Vec<(Factor, Vec<Factor>)>,
    /// What was brought to the side of the pose, in front and behind: T(base) and T(tool).
    pub moved: [Option<Vec<Factor>>; 2],
    /// The names of the entries of U, row-major 3×4.
    pub pose: [Expr; 12],
    /// The steps.
    pub steps: Vec<Explained>,
    /// How joint variables follow that no step gives by name.
    pub joints: Vec<Statement>,
    /// What a pose must meet: an arm with fewer than six directions does not reach all.
    pub leftovers: Vec<Statement>,
    /// The largest number of isolated solutions; nothing if the derivation ended early.
    pub solutions: Option<usize>,
    /// Joint variables that were not found.
    pub missing: Vec<Expr>,
    /// Joints that the arm has too many.
    pub surplus: usize,
}

/// What both kinds of outcome have in common.
struct Facts<'a> {
    description: &'a Description,
    chain: &'a NormalChain,
    steps: &'a [Step],
    labels: &'a [Option<Label>],
    splits: &'a [Split],
    conditions: &'a [Condition],
    given: &'a [usize],
    goal: Goal,
}

impl Explanation {
    /// Explains a complete derivation.
    pub fn of(model: &InverseModel) -> Self {
        let facts = Facts {
            description: &model.description,
            chain: &model.chain,
            steps: &model.steps,
            labels: &model.labels,
            splits: &model.splits,
            conditions: &model.conditions,
            given: &model.given,
            goal: model.goal,
        };
        let mut explanation = facts.explain();
        explanation.given_by_choice = model.given_by_choice;
        explanation.rank = Some(model.rank);
        explanation.task = Some(model.task);
        explanation.solutions = Some(model.max_solutions());
        explanation
    }

    /// Explains how far a derivation came that ended early.
    pub fn of_stuck(description: &Description, stuck: &Stuck, goal: Goal) -> Self {
        let settled = settled(description);
        stuck.chain.algebra.restart();
        let Equations { splits, .. } = equations(&stuck.chain, goal, Length::Any);
        let labels = vec![None; stuck.steps.len()];
        let facts = Facts {
            description: &settled,
            chain: &stuck.chain,
            steps: &stuck.steps,
            labels: &labels,
            splits: &splits,
            conditions: &[],
            given: &stuck.given,
            goal,
        };
        let mut explanation = facts.explain();
        explanation.missing = stuck.missing.iter().map(|&j| stuck.chain.variables[j].into()).collect();
        explanation.surplus = stuck.surplus;
        explanation
    }

    /// Every statement that is proved or not.
    pub fn statements(&self) -> impl Iterator<Item = &Statement> {
        let steps = self.steps.iter().flat_map(|s| {
            s.sources
                .iter()
                .flat_map(|o| o.equations.iter())
                .chain(&s.names)
                .chain(&s.coefficients)
                .chain(&s.solution)
        });
        steps.chain(&self.joints).chain(&self.leftovers)
    }

    /// What all formulas together are: proved only if each is.
    pub fn proof(&self) -> Proof {
        self.statements().filter_map(|s| s.proof).max().unwrap_or(Proof::Proved)
    }

    /// The names that the formulas use.
    pub fn names(&self) -> Vocabulary {
        let numbers = self.description.vocabulary();
        let variables: Vec<Symbol> = self.description.variables().iter().map(|v| v.symbol).collect();
        let mut names: Vec<Symbol> = self.pose.iter().filter_map(|e| e.as_symbol()).collect();
        for s in self.statements() {
            names.extend(s.math.exprs().into_iter().flat_map(Expr::symbols));
        }
        for s in &self.steps {
            names.extend(s.form.iter().flat_map(Math::exprs).flat_map(Expr::symbols));
            names.extend(s.unknown.symbols());
        }
        names.retain(|s| !variables.contains(s));
        names.into_iter().fold(numbers, |v, s| v.symbol(&s.name()))
    }

    /// A sum of angles that occurs, for the legend.
    fn sum(&self) -> Option<Expr> {
        let mut found = self.statements().flat_map(|s| s.math.exprs()).flat_map(|e| Expr::postorder(&[e]));
        found.find_map(|e| match e.node() {
            Node::Cos(a) | Node::Sin(a) if matches!(a.node(), Node::Add(..)) => Some(a),
            _ => None,
        })
    }

    /// The document.
    pub fn document(&self, language: Tongue) -> Vec<Block> {
        written::document(self, language.words())
    }

    /// The document with the problem of the position behind that of the pose; its names are [`names_with`](Self::names_with).
    pub fn document_with(&self, position: &Explanation, language: Tongue) -> Vec<Block> {
        written::with_position(self, position, language.words())
    }

    /// The formulas alone of both problems.
    pub fn summary_with(&self, position: &Explanation, language: Tongue) -> Vec<Block> {
        written::formulas_with_position(self, position, language.words())
    }

    /// The names that the formulas of both use.
    pub fn names_with(&self, position: &Explanation) -> Vocabulary {
        position.names().declared().fold(self.names(), |names, name| names.symbol(name))
    }

    /// The problem of the position alone, where an arm is one for positions: it has three joints at the most, each of which
    /// moves its hand's origin.
    pub fn of_its_position(model: &InverseModel) -> Option<Explanation> {
        if model.goal != Goal::Pose || model.description.variables().len() > 3 || !model.given.is_empty() {
            return None;
        }
        let options = InverseOptions { goal: Goal::Position, ..InverseOptions::default() };
        let position = InverseModel::derive(&model.description, &options).ok()?;
        (position.rank == model.rank).then(|| Explanation::of(&position))
    }

    /// The formulas alone, to be computed one after another.
    pub fn summary(&self, language: Tongue) -> Vec<Block> {
        written::formulas(self, language.words())
    }

    /// The branches, with the number of the solution at the ends; nothing if the derivation ended early.
    pub fn branches(&self, language: Tongue) -> Option<Branch> {
        self.solutions.map(|_| written::branches(&self.steps, &mut 0, language.words()))
    }
}

impl Facts<'_> {
    fn explain(&self) -> Explanation {
        let chain = self.chain;
        let reading = Reading::new(chain, self.given, self.steps);
        let matrices = Matrices::new(&reading, self.splits, self.description.convention);
        let mut taken: Vec<String> = chain
            .variables
            .iter()
            .chain(&chain.parameters)
            .chain(&chain.pose)
            .map(|s| s.name().to_string())
            .collect();
        taken.extend(["T", "U", "t"].map(String::from));
        let mut unique = |wanted: &str| {
            let mut name = wanted.to_string();
            while taken.contains(&name) {
                name.push('_');
            }
            taken.push(name.clone());
            Expr::symbol(&name)
        };
        let letters = ["A", "B", "D", "E", "F"].map(&mut unique);
        let helpers = ["R", "Δ"].map(&mut unique);
        let mut in_use = |name: &str| {
            let is = taken.contains(&name.to_string());
            if !is {
                taken.push(name.to_string());
            }
            is
        };
        let names = Names::new(&reading, &written(self.steps), &mut in_use);
        let prover = Prover::new(&reading, &names.meanings(&reading));
        let mut context = Context {
            reading: &reading,
            matrices: &matrices,
            names: &names,
            prover: &prover,
            letters,
            helpers,
            equations: 0,
            signs: 0,
        };
        let mut steps: Vec<Explained> = vec![];
        for (i, step) in self.steps.iter().enumerate() {
            steps.push(context.explain(i, step, self.labels.get(i).copied().flatten()));
        }
        for (i, step) in self.steps.iter().enumerate() {
            for p in polys(step) {
                for j in reading.steps_in(&p, i) {
                    if !steps[j].used_by.contains(&(i + 1)) {
                        steps[j].used_by.push(i + 1);
                    }
                }
            }
        }
        let grouped = |k: usize| {
            let of = chain.axes[k].value;
            let factors = matrices.groups[k].clone().flat_map(|e| matrices.written(e)).collect();
            (Factor::Named { letter: "A", number: Some(k + 1), of: Some(of), inverse: false }, factors)
        };
        let placed = |x: &Transform<Expr>| (*x != Transform::identity()).then(|| placement(x));
        Explanation {
            description: self.description.clone(),
            goal: self.goal,
            given: self.given.iter().map(|&j| chain.variables[j].into()).collect(),
            given_by_choice: false,
            rank: None,
            matrices: (0..chain.axes.len()).map(grouped).collect(),
            moved: [placed(&chain.base), placed(&chain.tool)],
            pose: chain.pose.map(Expr::from),
            joints: self.joints(&reading, &prover),
            leftovers: self.leftovers(&reading, &prover),
            task: None,
            steps,
            solutions: None,
            missing: vec![],
            surplus: 0,
        }
    }

    /// Joint variables that no step is about: θ4 = θ234 − θ2 − θ3.
    fn joints(&self, reading: &Reading, prover: &Prover) -> Vec<Statement> {
        let chain = self.chain;
        let mut found = vec![];
        for (j, &variable) in chain.variables.iter().enumerate() {
            if self.given.contains(&j) {
                continue;
            }
            let direct = |s: &Step| chain.unknown_expr(s.unknown) == Expr::from(variable);
            if self.steps.iter().any(direct) {
                continue;
            }
            // The variable by its axes, each by the steps that lead to it.
            let mut terms: Vec<(Rational, Expr, Expr)> = vec![];
            let mut known = true;
            for (k, factor) in &chain.drivers.inverse[j] {
                let before = terms.len();
                match axis_unknown(chain, *k) {
                    x @ Unknown::Slide(_) => {
                        let (name, meaning) = reading.name(x);
                        if self.steps.iter().any(|s| s.unknown == x) {
                            terms.push((factor.clone(), name, meaning.unwrap_or(name)));
                        }
                    }
                    Unknown::Angle(d) => {
                        // The angle of an axis that drives is that axis's, or its negative.
                        let reversed = chain.form(d).iter().any(|x| *x < 0);
                        for (e, _, backwards) in reading.path(d, self.steps.len()).unwrap_or_default() {
                            let (name, meaning) = reading.name(Unknown::Angle(e));
                            let factor = if backwards == reversed { factor.clone() } else { -factor };
                            terms.push((factor, name, meaning.unwrap_or(name)));
                        }
                    }
                }
                known &= terms.len() > before;
                let offset = chain.axes[*k].form.offset;
                if !offset.is_zero() {
                    terms.push((-factor, offset, offset));
                }
            }
            // What is added, then what is taken away, each along the chain.
            terms.sort_by_cached_key(|t| {
                (t.0.is_negative(), t.1.symbols().first().map(|s| s.name().to_string()))
            });
            let total = |part: fn(&(Rational, Expr, Expr)) -> Expr| {
                terms.iter().map(|t| Expr::from(t.0.clone()) * part(t)).reduce(|a, b| a + b)
            };
            let (sum, in_joints) = (total(|t| t.1), total(|t| t.2));
            let (Some(sum), Some(meaning), true) = (sum, in_joints, known) else { continue };
            let proof = Some(prover.equation(variable.into(), meaning));
            found.push(Statement { math: Math::equation(variable.into(), sum), number: None, proof });
        }
        found
    }

    /// What a pose must meet beside.
    fn leftovers(&self, reading: &Reading, prover: &Prover) -> Vec<Statement> {
        let statement = |c: &Condition| {
            let (mut left, mut right) = (reading.plain(&c.pose), reading.plain(&c.chain));
            let proof = Some(prover.equation(left, right));
            if step::unsigned(left) != left {
                (left, right) = (-left, -right);
            }
            Statement { math: Math::equation(left, right), number: None, proof }
        };
        self.conditions.iter().map(statement).collect()
    }
}

/// The polynomials of a step's equation.
fn polys(step: &Step) -> Vec<Poly> {
    written_of(step).into_iter().map(|w| w.0).collect()
}

fn written(steps: &[Step]) -> Vec<(Poly, usize)> {
    steps.iter().flat_map(written_of).collect()
}

/// What is written of a step, and how often.
fn written_of(step: &Step) -> Vec<(Poly, usize)> {
    let mut found: Vec<(Poly, usize)> = vec![];
    let unit = |p: &Poly| p.as_constant().is_some();
    for row in &step.rows {
        let simple = unit(&row.a) && unit(&row.b);
        let times = match step.form {
            Form::Pair { .. } if !simple => 2,
            Form::Sincos => 2,
            _ => 1,
        };
        found.extend([(row.a.clone(), times), (row.b.clone(), times), (row.c.plus.clone(), times)]);
        found.extend(row.c.squares.iter().map(|p| (p.clone(), 2)));
    }
    let mut norm = |n: &Norm, times: usize| {
        found.push((n.plus.clone(), times));
        found.extend(n.squares.iter().map(|p| (p.clone(), 2)));
    };
    match &step.form {
        Form::Ratio { numerator, denominator } => {
            norm(&numerator.clone().into(), 1);
            norm(&denominator.clone().into(), 1);
        }
        Form::Quadratic { a, b, c } => {
            norm(&a.clone().into(), 1);
            norm(&b.clone().into(), 1);
            norm(c, 1);
        }
        Form::Quartic(all) => all.iter().for_each(|n| norm(n, 1)),
        Form::Pair { .. } | Form::Line | Form::Sincos => {}
    }
    found.retain(|f| !f.0.is_zero());
    found
}

/// A constant placement as a product of a displacement and turns.
fn placement(x: &Transform<Expr>) -> Vec<Factor> {
    let mut found = vec![];
    if x.translation.0.iter().any(|e| !e.is_zero()) {
        found.push(Factor::Translation(x.translation.0));
    }
    let rows = x.rotation.rows();
    match origin::elementary(&rows) {
        Some(turns) => found.extend(turns),
        None => found.push(Factor::Constant(
            rows.iter().map(|r| r.iter().copied().chain([Expr::int(0)]).collect()).collect(),
        )),
    }
    found
}
