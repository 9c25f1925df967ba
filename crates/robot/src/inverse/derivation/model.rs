//! The inverse model of a robot: the derivation, what it could not find and why, its solver.

use super::candidates::Problem;
use super::chain::{End, Motion, NormalChain, Unsuitable};
use super::compile::{self, Compiled};
use super::conditions::{self, Condition, Task};
use super::drivers::Lattice;
use super::equations::{Goal, Length, Split, equations};
use super::known::{Known, Samples, Unknown, axis_unknown};
use super::plan::{Form, Step};
use super::screen::Screen;
use super::screws;
use super::search::{self, Outcome};
use crate::description::Description;
use crate::inverse::branch::{Label, Part};
use denavit_symbolic::poly::Poly;
use denavit_symbolic::print::{Style, print};
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Expr, Rational, Symbol};
use std::fmt;

/// What is asked of a derivation.
#[derive(Clone, Debug)]
pub struct InverseOptions {
    /// What of the hand is given.
    pub goal: Goal,
    /// Joint variables (from 0) whose values are given; `None` lets the derivation choose as many as the arm has too
    /// many.
    pub given: Option<Vec<usize>>,
}

impl Default for InverseOptions {
    fn default() -> Self {
        InverseOptions { goal: Goal::Pose, given: None }
    }
}

/// A closed-form inverse model.
#[derive(Debug)]
pub struct InverseModel {
    /// What was derived for: parameters that are 0, and angles with values, put in.
    pub description: Description,
    /// What of the hand is given.
    pub goal: Goal,
    /// Joint variables (from 0) that are given beside it, sorted.
    pub given: Vec<usize>,
    /// True if the derivation chose them.
    pub given_by_choice: bool,
    /// Independent directions in which the hand can move.
    pub rank: usize,
    /// What the arm serves.
    pub task: Task,
    /// What a pose must meet, as many as the arm lacks degrees of freedom.
    pub conditions: Vec<Condition>,
    /// The problem's normal form.
    pub chain: NormalChain,
    /// The steps, in order.
    pub steps: Vec<Step>,
    /// For steps whose equation does not determine its unknown everywhere, derivations that find it in another way.
    pub variants: Vec<Variant>,
    /// What the branches of each step are called, if it has more than one.
    pub labels: Vec<Option<Label>>,
    /// Both sides of the chain's equations at each two cuts.
    pub splits: Vec<Split>,
    /// The same without the entries that the arm holds at a number.
    pub(super) whole: Vec<Split>,
    /// The steps as a solver, and its inputs.
    pub compiled: Compiled,
}

/// A derivation with another equation for the unknown of a step.
#[derive(Debug)]
pub struct Variant {
    /// The step, from 0.
    pub step: usize,
    /// The steps of the variant.
    pub steps: Vec<Step>,
    /// What their branches are called.
    pub labels: Vec<Option<Label>>,
    /// Its solver.
    pub compiled: Compiled,
}

/// Why there is no closed form, or none that was found.
#[derive(Debug)]
pub enum Refusal {
    /// The robot has no normal form.
    Unsuitable(Unsuitable),
    /// Values are given for joints that the arm does not have, or for too many.
    Given(NotGiven),
    /// The derivation ended before everything was found.
    Stuck(Box<Stuck>),
}

/// A derivation that ended early.
#[derive(Debug)]
pub struct Stuck {
    /// The normal form.
    pub chain: NormalChain,
    /// The steps that were found.
    pub steps: Vec<Step>,
    /// The joint variables (from 0) that were not.
    pub missing: Vec<usize>,
    /// How many joints the arm has more than the hand has directions to move in.
    pub surplus: usize,
    /// The joint variables that were given.
    pub given: Vec<usize>,
    /// What the derivation took, as products of two terms.
    pub work: u64,
    /// True if that was all that a derivation may take: there may be a closed form that was not found.
    pub is_spent: bool,
}

/// Why no values can be given for some joints.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum NotGiven {
    /// The arm does not have the joint.
    NoSuchJoint {
        /// The joint, from 0.
        joint: usize,
        /// How many there are.
        joints: usize,
    },
    /// The arm has no more joints than its hand can use.
    NoSurplus,
    /// The arm has fewer joints too many.
    TooMany {
        /// How many values are given.
        given: usize,
        /// How many joints the arm has too many.
        surplus: usize,
    },
}

impl fmt::Display for NotGiven {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let joints = |n: usize| if n == 1 { "joint" } else { "joints" };
        match *self {
            NotGiven::NoSuchJoint { joint, joints } => {
                write!(f, "joint {} is given, but there are only {joints}", joint + 1)
            }
            NotGiven::NoSurplus => {
                f.write_str("no joint can be given: the arm has no more joints than its hand can use")
            }
            NotGiven::TooMany { given, surplus } => {
                let (more, only) = (joints(given), joints(surplus));
                write!(f, "{given} {more} given, but the arm has only {surplus} {only} too many")
            }
        }
    }
}

impl std::error::Error for NotGiven {}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Refusal::Unsuitable(why) => write!(f, "{why}"),
            Refusal::Given(why) => write!(f, "{why}"),
            Refusal::Stuck(stuck) => write!(f, "{stuck}"),
        }
    }
}

impl std::error::Error for Refusal {}

impl fmt::Display for Stuck {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [found, missing] = [self.found(), self.open()].map(|all| all.join(", "));
        let found = if found.is_empty() { "nothing".into() } else { found };
        if self.is_spent {
            write!(f, "no closed form within the bound on work: found {found} so far; open: {missing}")
        } else {
            write!(
                f,
                "no closed form: found {found}; no equation of degree up to 4 in one unknown is left for {missing}"
            )
        }
    }
}

impl std::error::Error for Stuck {}

impl Stuck {
    /// The unknowns that were found, as formulas to read.
    pub fn found(&self) -> Vec<String> {
        self.steps.iter().map(|s| self.chain.describe(s.unknown)).collect()
    }

    /// The joint variables that were not found, by name.
    pub fn open(&self) -> Vec<String> {
        self.missing.iter().map(|&j| self.chain.variables[j].name().to_string()).collect()
    }
}

/// How much of a model is derived.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(in crate::inverse) enum Extent {
    /// Everything that can be said of it; of one that is refused, what was found.
    Whole,
    /// What solves poses; a derivation that cannot end is refused before it begins.
    Solver,
    /// The steps and their solver alone, of a redundant arm, if what is left with joints given has a usual geometry.
    Steps,
}

/// Sets of joints that are tried as given.
const TRIALS: usize = 40;
/// Branches of a derivation that is accepted at once.
const FEW: usize = 8;

impl InverseModel {
    /// Derives the inverse model of a robot.
    ///
    /// # Errors
    /// See [`Refusal`].
    pub fn derive(description: &Description, options: &InverseOptions) -> Result<Self, Refusal> {
        InverseModel::derive_for(description, options, Extent::Whole)
    }

    /// The same for a purpose.
    pub(in crate::inverse) fn derive_for(
        description: &Description,
        options: &InverseOptions,
        extent: Extent,
    ) -> Result<Self, Refusal> {
        let settled = screws::settled(description);
        let end = if options.goal == Goal::Pose { End::Pose } else { End::Point };
        let chain = NormalChain::new(&settled, end).map_err(Refusal::Unsuitable)?;
        let n = chain.variables.len();
        if let Some(j) = options.given.iter().flatten().find(|&&j| j >= n) {
            return Err(Refusal::Given(NotGiven::NoSuchJoint { joint: *j, joints: n }));
        }
        let samples = Samples::new(&chain, |s: Symbol| settled.value(s));
        let rank = rank(&chain, &samples, options.goal);
        let surplus = n - rank.min(n);

        let mut asked: Vec<usize> = options.given.clone().unwrap_or_default();
        asked.sort_unstable();
        asked.dedup();
        if asked.len() > surplus {
            return Err(Refusal::Given(match surplus {
                0 => NotGiven::NoSurplus,
                _ => NotGiven::TooMany { given: asked.len(), surplus },
            }));
        }
        let screen =
            (options.goal == Goal::Pose).then(|| Screen::new(&chain, &samples, extent == Extent::Steps));
        if extent != Extent::Whole && !may_end(&chain, screen.as_ref(), &asked, surplus) {
            let outcome =
                Outcome { steps: vec![], missing: Known::new(&chain, &chain.axes_of(&asked)).open(&chain) };
            return Err(stuck(chain, outcome, asked, surplus, false));
        }
        let searched = |problem: &Problem| choose(problem, screen.as_ref(), &asked, surplus);
        let short = equations(&chain, options.goal, Length::Short);
        let mut problem = Problem::new(&chain, &short, &samples);
        let (mut given, mut outcome) = searched(&problem);
        let long;
        // Elimination and descents solve poses where none of the short ones ends the search.
        let is_tried = extent == Extent::Whole && short.is_cut && !chain.algebra.is_spent();
        if !outcome.is_complete() && is_tried {
            long = equations(&chain, options.goal, Length::Any);
            problem = Problem::new(&chain, &long, &samples);
            (given, outcome) = searched(&problem);
        }
        let sides = problem.sides;
        if !outcome.is_complete() || !is_whole(&chain, &sides.splits, options.goal) {
            let is_spent = chain.algebra.is_spent() || !is_whole(&chain, &sides.splits, options.goal);
            return Err(stuck(chain, outcome, given, surplus, is_spent));
        }
        let labels = labels(&chain, &outcome.steps);
        let [of_position, with_axis] =
            [Goal::Position, Goal::PositionAndAxis].map(|goal| self::rank(&chain, &samples, goal));
        let task = conditions::task(&chain, rank, of_position, with_axis);
        let lacking = if options.goal == Goal::Pose { 6 - rank } else { 0 };
        let axes = chain.axes_of(&given);
        let conditions =
            conditions::conditions(&chain, &sides.found, &outcome.steps, &axes, &samples, lacking);
        let others = if extent != Extent::Steps && (rank < 6 || !given.is_empty()) {
            search::variants(&problem, &axes, &outcome.steps)
        } else {
            vec![]
        };
        let variants = others
            .into_iter()
            .map(|(step, steps)| {
                let labels = self::labels(&chain, &steps);
                let compiled = compile::compile(&chain, &steps, &sides.whole, options.goal, &given, &labels);
                Variant { step, steps, labels, compiled }
            })
            .collect();
        let compiled = compile::compile(&chain, &outcome.steps, &sides.whole, options.goal, &given, &labels);
        Ok(InverseModel {
            goal: options.goal,
            given_by_choice: given.len() > asked.len(),
            given,
            rank,
            task,
            conditions,
            steps: outcome.steps,
            variants,
            labels,
            splits: sides.splits.clone(),
            whole: sides.whole.clone(),
            compiled,
            chain,
            description: settled,
        })
    }

    /// A condition as a formula to read: `S1·px = C1·py`.
    pub(crate) fn condition_text(&self, c: &Condition) -> String {
        let vocabulary = Vocabulary::default();
        let flipped = c.pose.terms().first().is_some_and(|t| t.1.is_negative());
        let sign = Rational::from(if flipped { -1 } else { 1 });
        let side =
            |p: &Poly| print(self.chain.algebra.formula(&p.scaled(&sign)), &vocabulary, Style::Unicode);
        format!("{} = {}", side(&c.pose), side(&c.chain))
    }

    /// The largest number of isolated solutions.
    pub fn max_solutions(&self) -> usize {
        self.compiled.solver.max_solutions()
    }
}

/// A refusal.
fn stuck(chain: NormalChain, outcome: Outcome, given: Vec<usize>, surplus: usize, is_spent: bool) -> Refusal {
    let missing = missing(&chain, &outcome, &given);
    let (steps, work) = (outcome.steps, chain.algebra.work());
    Refusal::Stuck(Box::new(Stuck { chain, steps, missing, surplus, given, work, is_spent }))
}

/// False if no search can end, with the joints that are given or with as many more as the arm has too many.
fn may_end(chain: &NormalChain, screen: Option<&Screen>, asked: &[usize], surplus: usize) -> bool {
    let Some(screen) = screen else { return true };
    let open: Vec<usize> = (0..chain.variables.len()).filter(|j| !asked.contains(j)).collect();
    let may_end = |more: &Vec<usize>| {
        let given: Vec<usize> = asked.iter().chain(more).copied().collect();
        are_axes(chain, &given) && screen.may_end(&chain.axes_of(&given))
    };
    // Of more sets than are tried only the first are listed.
    let sets = subsets(&open, surplus - asked.len());
    sets.len() > TRIALS || sets.iter().any(may_end)
}

/// True if the product of the whole chain was formed: it was not too long, and there was work left for it.
fn is_whole(chain: &NormalChain, splits: &[Split], goal: Goal) -> bool {
    let columns = match goal {
        Goal::Pose => 0..3,
        Goal::Position => 0..0,
        Goal::PositionAndAxis => 2..3,
    };
    let mut ends = splits.iter().filter(|s| s.left == 0 && s.right == chain.elements.len());
    ends.any(|s| {
        let turned = s.pose_rotation.iter().flat_map(|row| &row[columns.clone()]);
        s.pose.iter().chain(turned).all(Option::is_some)
    })
}

/// Whether joint variables determine as many axes: of coupled joints, some tell how axes move together, which no step asks.
fn are_axes(chain: &NormalChain, given: &[usize]) -> bool {
    let mut turning = Lattice::default();
    let mut sliding = 0;
    for k in chain.axes_of(given) {
        match axis_unknown(chain, k) {
            Unknown::Angle(d) => turning.add(&chain.form(d)),
            Unknown::Slide(k) => sliding += usize::from(chain.drivers.drives(k)),
        }
    }
    turning.rank() + sliding == given.len()
}

/// The joint variables that are still open.
fn missing(chain: &NormalChain, outcome: &Outcome, given: &[usize]) -> Vec<usize> {
    let open = |k: usize| outcome.missing.contains(&axis_unknown(chain, k));
    (0..chain.variables.len())
        .filter(|j| !given.contains(j) && chain.drivers.inverse[*j].iter().any(|f| open(f.0)))
        .collect()
}

/// Branches, whether roots may be added, conditions, length.
type Price = (usize, bool, u32, usize);

/// Searches with the given joints, and as many more as the arm has too many: those with which the search ends with the
/// fewest branches.
fn choose(
    problem: &Problem,
    screen: Option<&Screen>,
    asked: &[usize],
    surplus: usize,
) -> (Vec<usize>, Outcome) {
    let chain = problem.chain;
    let first = match are_axes(chain, asked) {
        true => search::search(problem, &chain.axes_of(asked)),
        false => Outcome { steps: vec![], missing: Known::new(chain, &chain.axes_of(asked)).open(chain) },
    };
    let more = surplus - asked.len();
    if first.is_complete() || more == 0 {
        return (asked.to_vec(), first);
    }
    let mut open = missing(chain, &first, asked);
    // Slides at the base carry the arm about; then the joint that swings the elbow of a 7R arm, then the ends.
    let n = chain.variables.len();
    let usual = [n.saturating_sub(5), n - 1, 0];
    let place = |j: usize| usual.iter().position(|&u| u == j).unwrap_or(3);
    open.sort_by_key(|&j| (chain.is_angle(j), place(j), j));
    let mut best: Option<(Price, Vec<usize>, Outcome)> = None;
    for set in subsets(&open, more).into_iter().take(TRIALS) {
        if chain.algebra.is_spent() {
            break;
        }
        let mut given: Vec<usize> = asked.iter().chain(&set).copied().collect();
        given.sort_unstable();
        let axes = chain.axes_of(&given);
        if !are_axes(chain, &given) || screen.is_some_and(|s| !s.may_end(&axes)) {
            continue;
        }
        let outcome = search::search(problem, &axes);
        if !outcome.is_complete() {
            continue;
        }
        let spurious = outcome.steps.iter().any(|s| s.cost.spurious);
        let conditions: u32 = outcome.steps.iter().map(|s| u32::from(s.cost.condition)).sum();
        let terms: usize = outcome.steps.iter().map(|s| s.cost.terms).sum();
        let cost = (outcome.leaves(), spurious, conditions, terms);
        let accepted = n > 6 && outcome.leaves() <= FEW && !spurious;
        if best.as_ref().is_none_or(|b| cost < b.0) {
            best = Some((cost, given, outcome));
        }
        if accepted {
            break;
        }
    }
    best.map_or((asked.to_vec(), first), |(_, given, outcome)| (given, outcome))
}

/// All subsets with `size` members, those of the first members first.
fn subsets(of: &[usize], size: usize) -> Vec<Vec<usize>> {
    if size == 0 {
        return vec![vec![]];
    }
    let mut found = vec![];
    for (k, &x) in of.iter().enumerate() {
        for mut rest in subsets(&of[k + 1..], size - 1) {
            rest.insert(0, x);
            found.push(rest);
        }
        if found.len() > 4 * TRIALS {
            break;
        }
    }
    found
}

/// The rank of the derivative of what the goal gives, by the axes.
fn rank(chain: &NormalChain, samples: &Samples, goal: Goal) -> usize {
    const STEP: f64 = 1e-5;
    let rows: Vec<usize> = (0..12)
        .filter(|k| match goal {
            Goal::Pose => true,
            Goal::Position => k % 4 == 3,
            Goal::PositionAndAxis => k % 4 >= 2,
        })
        .collect();
    let mut columns: Vec<Vec<f64>> = (chain.drivers.axes.iter())
        .map(|&k| {
            let unit = if chain.axes[k].motion == Motion::Slide { samples.length() } else { 1.0 };
            let [plus, minus] = [STEP, -STEP].map(|h| samples.moved(chain, k, h * unit));
            let size = |r: usize| if r % 4 == 3 { samples.length() } else { 1.0 };
            rows.iter().map(|&r| (plus[r] - minus[r]) / (2.0 * STEP * size(r))).collect()
        })
        .collect();
    // Gram–Schmidt, the longest column first.
    let mut rank = 0;
    let norm = |v: &Vec<f64>| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let scale = columns.iter().map(norm).fold(0.0, f64::max);
    while let Some(k) = (0..columns.len()).max_by(|&a, &b| norm(&columns[a]).total_cmp(&norm(&columns[b]))) {
        let pivot = columns.swap_remove(k);
        let length = norm(&pivot);
        if length <= 1e-6 * scale {
            break;
        }
        rank += 1;
        for c in &mut columns {
            let along: f64 = c.iter().zip(&pivot).map(|(x, y)| x * y).sum::<f64>() / (length * length);
            c.iter_mut().zip(&pivot).for_each(|(x, y)| *x -= along * y);
        }
    }
    rank
}

/// What people call the branches: the first turning joint's are the shoulder's, those of the last three joints the
/// wrist's, those between the elbow's; joints of an arm that has fewer than five are an elbow's but for the first of more than
/// three, or of three of which the others are parallel to each other.
fn labels(chain: &NormalChain, steps: &[Step]) -> Vec<Option<Label>> {
    // Axes that follow others are nobody's shoulder; the others are counted by themselves.
    let axes = &chain.drivers.axes;
    let n = axes.len();
    let slides = |k: usize| chain.axes[axes[k]].motion == Motion::Slide;
    let turns: Vec<usize> = (0..n).filter(|&k| !slides(k)).collect();
    let ends_turning = n >= 5 && (n - 3..n).all(|k| !slides(k));
    let wrist = if ends_turning { n - if n == 5 { 2 } else { 3 } } else { n };
    // Of three joints the first turns the plane of the others: it chooses on which side of its axis they are.
    let group = |k: usize| match chain.axes[axes[k]].motion {
        Motion::Turn { group, .. } => Some(group),
        Motion::Slide => None,
    };
    let is_waist =
        turns.len() == 3 && group(turns[0]) != group(turns[1]) && group(turns[1]) == group(turns[2]);
    // Three axes that meet, and nothing else.
    let is_wrist_alone = n == 3 && turns.len() == 3 && steps.iter().all(|s| s.degree == 0);
    let slides_next = |k: usize| k + 1 < n && slides(k + 1);
    let mut used: Vec<Part> = vec![];
    steps
        .iter()
        .map(|step| {
            if step.cost.roots < 2 {
                return None;
            }
            let of: Vec<usize> = match step.unknown {
                Unknown::Slide(k) => vec![k],
                Unknown::Angle(d) => chain.axes_between(d).iter().map(|x| x.0).collect(),
            };
            let mut own = (0..n).filter(|&k| of.contains(&axes[k]));
            let first = own.next().unwrap_or(0);
            let last = own.next_back().unwrap_or(first);
            let spans_wrist = last >= wrist && (first >= wrist || last - first >= 2);
            let part = if matches!(step.unknown, Unknown::Slide(_)) {
                Part::Reach
            } else if spans_wrist || is_wrist_alone {
                Part::Wrist
            } else if first == turns[0] && (turns.len() > 3 || is_waist || matches!(step.form, Form::Line))
                || turns.len() >= 7 && turns[..3].contains(&last)
                // What carries a slide points the arm: there is no elbow.
                || matches!(step.form, Form::Line) && slides_next(last)
            {
                Part::Shoulder
            } else {
                Part::Elbow
            };
            used.push(part);
            Some(Label { part, number: used.iter().filter(|p| **p == part).count() })
        })
        .collect()
}

impl NormalChain {
    /// An unknown as a formula in the joint variables.
    pub fn unknown_expr(&self, x: Unknown) -> Expr {
        match x {
            Unknown::Angle(d) => self.angle(d),
            Unknown::Slide(k) => self.axes[k].value,
        }
    }

    /// An unknown's factors of the joint variables.
    pub(crate) fn unknown_terms(&self, x: Unknown) -> Vec<(usize, f64)> {
        let mut sum = vec![0.0; self.variables.len()];
        let axes = match x {
            Unknown::Slide(k) => vec![(k, false)],
            Unknown::Angle(d) => self.axes_between(d),
        };
        for (k, negative) in axes {
            for &(j, factor) in &self.axes[k].form.terms {
                let factor = factor.eval(|_| None).unwrap_or(0.0);
                sum[j] += if negative { -factor } else { factor };
            }
        }
        sum.into_iter().enumerate().filter(|t| t.1 != 0.0).collect()
    }

    /// An unknown in words: `θ2 + θ3`.
    pub fn describe(&self, x: Unknown) -> String {
        let vocabulary = denavit_symbolic::vocabulary::Vocabulary::default();
        denavit_symbolic::print::print(
            self.unknown_expr(x),
            &vocabulary,
            denavit_symbolic::print::Style::Unicode,
        )
    }
}
