//! What a document means by names that may mean several things: the reading that most of its statements support.
//!
//! Statements are held against the robot at random points only; the winner is judged by proof afterwards.

use super::CheckOptions;
use super::facts::{About, Meaning, Sense};
use super::formula::{Formula, has_root_of_sum};
use super::habits::{Columns, Habits, Places, with_named_signs};
use super::matrix::Matrix;
use super::names::{Name, Token, tokens};
use super::numbers;
use super::order;
use super::outcome::Finding;
use super::plan::{Plan, Walked};
use super::trial::{self, Trial};
use super::walk::{Assertion, Piece, Spoken, is_measured};
use denavit::forward::Reference;
use denavit::geometry::{Axis, Vector};
use denavit_reading::document::{Document, Statement};
use denavit_reading::slip::Points;
use denavit_symbolic::vocabulary::plain_name;
use denavit_symbolic::{Expr, equal};
use std::collections::BTreeSet;
use std::rc::Rc;

/// The most formulas of a document whose readings are weighed.
const MAX_FORMULAS: usize = 3_000;
/// Rounds in which one more habit is taken on.
const ROUNDS: usize = 4;
/// So many more right statements make a habit that is not the first.
const MARGIN: usize = 2;

/// How many statements are right and wrong, and which are wrong.
struct Score {
    right: usize,
    right_at: BTreeSet<usize>,
    wrong: BTreeSet<usize>,
}

/// The letters that a document has for the hand.
struct Letters {
    /// It names them in its words.
    tells_hand: bool,
    /// o has coordinates, and neither n, s nor p has.
    may_be_o: bool,
    /// It speaks of frame 6 in frame 3, and of r_ij.
    has_wrist: bool,
    /// Letters that may be those of a load on the hand.
    loads: Vec<char>,
    /// It speaks of millimetres.
    has_millimetres: bool,
    /// Its words say that the arm holds something.
    holds: bool,
    /// It speaks of the frame of the hand.
    in_hand: bool,
}

impl Letters {
    fn of(text: &str) -> Self {
        // As words: `o_x`, `o_{x}` or `ox`.
        let words: String = text.chars().filter(|c| !matches!(c, '_' | '{' | '}' | '\\')).collect();
        let words: BTreeSet<&str> = words.split(|c: char| !c.is_alphanumeric()).collect();
        let has =
            |letter: &str| ["x", "y", "z"].iter().any(|a| words.contains(format!("{letter}{a}").as_str()));
        Letters {
            tells_hand: !super::custom::hand_letters(text).is_empty(),
            loads: super::loads::letters_of_load(text),
            has_millimetres: text.contains("mm"),
            in_hand: IN_HAND.iter().any(|w| text.to_lowercase().contains(w)),
            holds: HOLDING.iter().any(|w| text.to_lowercase().contains(w)),
            may_be_o: has("o") && !["n", "p", "P", "s"].into_iter().any(has),
            has_wrist: super::custom::speaks_of_wrist(&plain_name(text)) && words.iter().any(|w| is_r(w)),
        }
    }
}

/// Words of what is along the axes of the hand.
const IN_HAND: [&str; 8] = [
    "tip frame",
    "tool frame",
    "hand frame",
    "frame of the hand",
    "frame of the tool",
    "werkzeugsystem",
    "terna della pinza",
    "repère de l'outil",
];

/// Words of loads that are held.
const HOLDING: [&str; 16] = [
    "hold",
    "held",
    "balanc",
    "equilib",
    "weigh",
    "against",
    "acting on",
    "counter",
    "support",
    "halten",
    "gewicht",
    "équilibr",
    "poids",
    "peso",
    "sosten",
    "sorregg",
];

/// True for `r13`, `rij`.
fn is_r(word: &str) -> bool {
    word == "rij"
        || word
            .strip_prefix('r')
            .is_some_and(|d| d.len() == 2 && d.bytes().all(|b| (b'1'..=b'3').contains(&b)))
}

/// The plan with the readings that the document supports, and what is said of them.
pub(super) fn weighed(
    text: &str,
    document: &Document,
    plan: Plan,
    options: &CheckOptions,
) -> (Plan, Vec<Sense>) {
    let mut plan = plan;
    let mut senses = vec![];
    let mut walked = plan.walk(text, document, options);
    let count: usize = walked.assertions.iter().map(|a| a.pieces.len()).sum();
    if count > MAX_FORMULAS {
        return (plan, senses);
    }
    let mut trials = Trials::new(&plan);
    let mut score = trials.score(&plan, &walked);
    let letters = Letters::of(text);
    let has_base = plan.subjects.iter().any(|s| s.ground() == Reference::Base);
    for _ in 0..ROUNDS {
        let may_load = plan.habits.load.is_none() && !letters.loads.is_empty();
        let tools = super::tools::candidates(text, &plan, &walked);
        let has_letters = !super::tools::letters_of_lengths(&plan, &walked).is_empty();
        if score.wrong.is_empty() && !may_load && tools.is_empty() && !has_letters {
            break;
        }
        let mut best: Option<(usize, Plan, Walked, Score, Sense)> = None;
        let unit = (plan.is_own && letters.has_millimetres && !score.wrong.is_empty()).then(|| {
            let scaled = !plan.habits.scaled;
            (Habits { scaled, ..Habits::clone(&plan.habits) }, Sense::Unit { millimetres: scaled }, MARGIN)
        });
        let found = candidates(&plan.habits, &walked, &score, &letters, has_base);
        let tools = tools.into_iter().map(|(place, is_told)| {
            let names = Rc::new(plan.subjects[0].vocabulary());
            let place = place.0.map(|e| Formula::new(e, &names));
            (Habits::clone(&plan.habits), Sense::Tool { place }, if is_told { 1 } else { MARGIN })
        });
        let lengths = super::tools::letters_of_lengths(&plan, &walked).into_iter();
        let lengths = lengths.map(|letter| (Habits::clone(&plan.habits), Sense::Lengths { letter }, MARGIN));
        for (habits, sense, margin) in found.into_iter().chain(unit).chain(tools).chain(lengths) {
            let other = match &sense {
                Sense::Unit { millimetres } => plan.with_unit(*millimetres),
                Sense::Lengths { letter } => plan.with_lengths(*letter),
                Sense::Tool { place } => plan.with_tool(&Vector(place.clone().map(|f| f.value))),
                _ => plan.with_habits(habits),
            };
            let there = other.walk(text, document, options);
            let own = trials.score(&other, &there);
            let gain = own.right.saturating_sub(score.right);
            // Links that are the document's own must yield something of the robot that else is wrong.
            let is_borne_out = sense != Sense::OwnLinks
                || own.right_at.iter().any(|at| is_own_chain(text, document, &other, &walked, &score, *at));
            // What could not be read before may be wrong then.
            let is_load = matches!(sense, Sense::Load { .. } | Sense::Tool { .. } | Sense::Lengths { .. });
            let is_better = gain >= margin
                && is_borne_out
                && (own.wrong.len() < score.wrong.len()
                    || is_load
                        && own.wrong.len() <= score.wrong.len() + gain * if margin == 1 { 2 } else { 1 })
                && best.as_ref().is_none_or(|b| gain > b.0);
            if is_better {
                best = Some((gain, other, there, own, sense));
            }
        }
        let Some((_, other, there, own, sense)) = best else { break };
        senses.push(sense);
        (plan, walked, score) = (other, there, own);
    }
    (plan, senses)
}

/// How many statements of a document are right and how many wrong of its robots, with the readings that it supports.
pub(super) fn support(text: &str, document: &Document, plan: Plan, options: &CheckOptions) -> [usize; 2] {
    let (plan, _) = weighed(text, document, plan, options);
    let walked = plan.walk(text, document, options);
    let score = Trials::new(&plan).score(&plan, &walked);
    [score.right, score.wrong.len()]
}

/// How many entries of formulas are right and how many wrong; zeros and ones are not counted.
pub(super) fn entries(walked: &Walked) -> [usize; 2] {
    let mut points = Points::new(41);
    let mut found = [0, 0];
    for piece in walked.assertions.iter().flat_map(|a| &a.pieces) {
        let Piece::Pair(pair) = piece else { continue };
        let is_plain = |e: Expr| e.as_number().is_some_and(|r| r.is_zero() || r.is_one());
        if !(is_plain(pair.value) && is_plain(pair.wanted)) {
            let is_right = points.value(pair.value) == points.value(pair.wanted);
            found[usize::from(!is_right)] += 1;
        }
    }
    found
}

/// Other habits that may explain what is wrong, how they are said, and how many more statements must be right.
fn candidates(
    habits: &Habits,
    walked: &Walked,
    score: &Score,
    letters: &Letters,
    has_base: bool,
) -> Vec<(Habits, Sense, usize)> {
    let wrong: Vec<&Assertion> =
        score.wrong.iter().filter_map(|&at| walked.assertions.iter().find(|a| a.span.start == at)).collect();
    let mut found = vec![];
    let speaks_of_frames = |a: &&Assertion| {
        matches!(&a.about, About::Matrix(m) if !matches!(m, Meaning::Jacobian(_))) || a.about == About::Entry
    };
    if wrong.iter().any(speaks_of_frames) {
        if !habits.links {
            found.push((Habits { links: true, ..habits.clone() }, Sense::LinkAlone, MARGIN));
        }
        if !habits.exchanged {
            found.push((Habits { exchanged: true, ..habits.clone() }, Sense::IndicesExchanged, MARGIN));
        }
        // One entry is a slip; a frame elsewhere shows in several.
        let differs = |p: &&Piece| matches!(p, Piece::Pair(p) if !equal(p.value, p.wanted).is_equal());
        let is_elsewhere = |a: &&&Assertion| a.pieces.iter().filter(differs).count() > 1;
        if !habits.zero_is_base && has_base && wrong.iter().any(|a| is_elsewhere(&a)) {
            found.push((Habits { zero_is_base: true, ..habits.clone() }, Sense::ZeroIsBase, 1));
        }
        if habits.columns == Columns::Noap {
            found.push((Habits { columns: Columns::Snap, ..habits.clone() }, Sense::ColumnsSnap, MARGIN));
        }
        // Where the entries are by custom those of the second column, and the text has no other letter for the place.
        if habits.columns == Columns::Noap && letters.may_be_o {
            found.push((Habits { columns: Columns::Nsao, ..habits.clone() }, Sense::PlaceIsO, 1));
        }
    }
    if habits.load.is_none() {
        let axes = [Axis::X, Axis::Y, Axis::Z].into_iter().enumerate();
        for (letter, (k, axis)) in letters.loads.iter().flat_map(|&l| axes.clone().map(move |a| (l, a))) {
            for is_minus in [false, true] {
                let load = Some((letter, k, is_minus));
                // A torque that is 0 is so in many readings.
                let margin = if letter == super::weights::LETTER { MARGIN } else { 1 };
                let sense = Sense::Load { letter, axis, is_minus };
                if letters.in_hand {
                    let load_in_hand = true;
                    found.push((Habits { load, load_in_hand, ..habits.clone() }, sense.clone(), MARGIN));
                }
                found.push((Habits { load, ..habits.clone() }, sense, margin));
            }
        }
    }
    let is_torque = |a: &&Assertion| {
        let name = plain_name(&super::custom::plain(&a.name));
        name.starts_with(['τ', 'Γ']) || name.starts_with("Gamma")
    };
    if !habits.load_in_hand && wrong.iter().any(is_torque) {
        found.push((Habits { load_in_hand: true, ..habits.clone() }, Sense::LoadInHand, MARGIN));
    }
    if !habits.against_load && wrong.iter().any(is_torque) {
        let margin = if letters.holds { 1 } else { MARGIN };
        found.push((Habits { against_load: true, ..habits.clone() }, Sense::AgainstLoad, margin));
    }
    let is_place = |a: &&Assertion| {
        matches!(&a.about, About::Matrix(Meaning::Origin(_)))
            && a.name.trim_start_matches(['\\', '{']).contains(['P', 'p'])
    };
    if !habits.hand_in_frames && wrong.iter().any(is_place) {
        found.push((Habits { hand_in_frames: true, ..habits.clone() }, Sense::HandInFrames, 1));
    }
    let own: BTreeSet<String> = walked.assertions.iter().filter_map(own_link).collect();
    if wrong.iter().any(|a| own_link(a).is_some()) && !own.is_subset(&habits.products) {
        let products = habits.products.union(&own).cloned().collect();
        found.push((Habits { products, ..habits.clone() }, Sense::OwnLinks, 0));
    }
    let has_wrist = letters.has_wrist && wrong.iter().any(|a| a.spoken.is_some());
    if !habits.wrist_entries && has_wrist {
        found.push((Habits { wrist_entries: true, ..habits.clone() }, Sense::WristEntries, 1));
    }
    if !habits.cosine_first && wrong.iter().any(|a| a.spoken.is_some()) {
        found.push((Habits { cosine_first: true, ..habits.clone() }, Sense::CosineFirst, MARGIN));
    }
    let is_rate = |a: &&Assertion| {
        let is_of = |e: Expr| e.symbols().iter().any(|s| s.name().starts_with("rate of "));
        a.pieces.iter().any(|p| matches!(p, Piece::Pair(pair) if is_of(pair.wanted) || is_of(pair.value)))
    };
    if !habits.velocities_of_jacobian && wrong.iter().any(is_rate) {
        found.push((
            Habits { velocities_of_jacobian: true, ..habits.clone() },
            Sense::VelocitiesOfJacobian,
            MARGIN,
        ));
    }
    // A coordinate whose others are those of the hand is the hand's.
    let is_entry = |a: &&Assertion| a.about == About::Entry && score.right_at.contains(&a.span.start);
    let entries = walked.assertions.iter().filter(is_entry);
    let known: BTreeSet<String> =
        entries.map(|a| family(&plain_name(&super::custom::plain(&a.name)))).collect();
    let names: BTreeSet<String> = wrong
        .iter()
        .filter(|a| matches!(a.about, About::Entry | About::Equation) && a.spoken.is_none())
        .map(|a| plain_name(&super::custom::plain(&a.name)))
        .filter(|n| n.chars().count() <= 6 && n.chars().all(char::is_alphanumeric))
        .filter(|n| may_be_helper(n, letters.tells_hand) && !known.contains(&family(n)))
        .chain(walked.defined.iter().filter(|d| d.by_custom).map(|d| plain_name(&d.name)))
        .collect();
    let families: BTreeSet<String> = names.iter().map(|n| family(n)).collect();
    let mut sets: Vec<BTreeSet<String>> =
        families.iter().map(|f| names.iter().filter(|n| family(n) == *f).cloned().collect()).collect();
    sets.push(names);
    // A coordinate with the distance from an axis in it is none: √(x² + y²) − L.
    let radial: BTreeSet<String> = wrong
        .iter()
        .filter(|a| a.spoken.is_none() && a.pieces.iter().any(is_radial))
        .map(|a| plain_name(&super::custom::plain(&a.name)))
        .filter(|n| n.chars().count() <= 4 && may_be_helper(n, letters.tells_hand))
        .collect();
    if !radial.is_empty() && !radial.is_subset(&habits.helpers) {
        let helpers = habits.helpers.union(&radial).cloned().collect();
        found.push((Habits { helpers, ..habits.clone() }, Sense::Helper, 0));
    }
    for set in sets.into_iter().filter(|s| !s.is_empty() && !s.is_subset(&habits.helpers)) {
        let helpers = habits.helpers.union(&set).cloned().collect();
        found.push((Habits { helpers, ..habits.clone() }, Sense::Helper, 1));
    }
    found
}

/// True for a statement that holds the product of all links that are wrong by themselves against the robot's pose, by
/// names that it uses or that these stand for: `U = A_1 A_2`, `U = T`.
fn is_own_chain(
    text: &str,
    document: &Document,
    plan: &Plan,
    first: &Walked,
    score: &Score,
    at: usize,
) -> bool {
    let is_pose = |name: &Name| {
        let is_own = plan.habits.products.contains(&name.key());
        let mut meanings = plan.subjects.iter().map(|s| (s, s.meaning(name, false, &plan.habits)));
        !is_own && meanings.any(|(s, m)| m.is_some_and(|m| m.0 == Matrix::of(&s.pose())))
    };
    let names =
        |s: &Statement| s.sides.iter().flat_map(|side| order::names(text, side)).collect::<Vec<Name>>();
    let Some(statement) = document.statements.iter().find(|s| s.span.start == at) else { return false };
    let mut all = names(statement);
    let own: BTreeSet<String> = all.iter().map(Name::key).collect();
    for other in &document.statements {
        let left = other.sides.first().map(|side| order::names(text, side)).unwrap_or_default();
        if matches!(&left[..], [name] if own.contains(&name.key())) {
            all.extend(names(other));
        }
    }
    let wrong = first.assertions.iter().filter(|a| score.wrong.contains(&a.span.start));
    let mut wrong = wrong.filter_map(own_link);
    wrong.all(|key| all.iter().any(|n| n.key() == key)) && all.iter().any(is_pose)
}

/// The name of the matrix that a statement gives a link of its own: `A_2 = Rot(z, q_2) Trans(x, a_2)`.
fn own_link(assertion: &Assertion) -> Option<String> {
    let About::Matrix(Meaning::Frame { of: Reference::Frame(j), seen_from: Reference::Frame(i) }) =
        assertion.about
    else {
        return None;
    };
    let found = tokens(&assertion.name, &(0..assertion.name.len()), &|_| false)?;
    match &found[..] {
        [Token::Name(name)] if i + 1 == j && name.base != "T" => Some(name.key()),
        _ => None,
    }
}

/// True for a name that custom alone makes an entry of the pose; those of the position where the text gives the hand other
/// letters.
fn may_be_helper(name: &str, tells_hand: bool) -> bool {
    let chars: Vec<char> = name.chars().collect();
    match chars[..] {
        ['r' | 't' | 'R' | 'T', a, b] if a.is_ascii_digit() && b.is_ascii_digit() => false,
        ['n' | 'o' | 's' | 'a', 'x' | 'y' | 'z'] => false,
        ['p' | 'P', 'x' | 'y' | 'z'] => tells_hand,
        // The torque of a joint.
        ['τ' | 'Γ', k] if k.is_ascii_digit() => false,
        _ => true,
    }
}

/// True for a formula with a root of a sum, where the robot has none.
fn is_radial(piece: &Piece) -> bool {
    let Piece::Pair(pair) = piece else { return false };
    has_root_of_sum(pair.value) && !has_root_of_sum(pair.wanted)
}

/// A name without the letter of its axis.
fn family(name: &str) -> String {
    match name.chars().count() {
        1 if name.chars().all(char::is_uppercase) => "XYZ".into(),
        1 => "xyz".into(),
        _ => name.trim_end_matches(['x', 'y', 'z']).into(),
    }
}

/// Random points and configurations for each robot.
struct Trials {
    points: Points,
    by_subject: Vec<[Option<Trial>; 4]>,
}

impl Trials {
    fn new(plan: &Plan) -> Self {
        Trials {
            points: Points::new(23),
            by_subject: plan.subjects.iter().map(|_| [None, None, None, None]).collect(),
        }
    }

    fn score(&mut self, plan: &Plan, walked: &Walked) -> Score {
        let mut score = Score { right: 0, right_at: BTreeSet::new(), wrong: BTreeSet::new() };
        for assertion in &walked.assertions {
            match self.is_right(plan, assertion) {
                Some(true) => {
                    score.right += 1;
                    score.right_at.insert(assertion.span.start);
                }
                Some(false) => {
                    score.wrong.insert(assertion.span.start);
                }
                None => {}
            }
        }
        score
    }

    fn is_right(&mut self, plan: &Plan, assertion: &Assertion) -> Option<bool> {
        let subject = &plan.subjects[assertion.subject];
        match &assertion.spoken {
            Some(Spoken::Joint { of, branches, .. }) => {
                let columns = plan.habits.columns;
                let slot = &mut self.by_subject[assertion.subject][columns as usize];
                let trial = slot.get_or_insert_with(|| Trial::new(subject, &Places(columns)));
                let [own, any] = trial.shares(*of, branches);
                return (any > 0.0).then_some(own > 0.0);
            }
            Some(Spoken::Angle { set, name, value: (_, syntax) }) => {
                return trial::is_angle(*set, name, syntax.value(), &Places(plan.habits.columns));
            }
            None => {}
        }
        let (mut is_any, mut is_whole) = (false, true);
        for piece in &assertion.pieces {
            let is_right = match piece {
                Piece::Pair(pair) => {
                    let d = &subject.description;
                    let known = |e: Expr| e.substitute(|s| d.exact_value(s));
                    let printed = pair.value.symbols();
                    let missing = pair.wanted.symbols().into_iter().filter(|s| !printed.contains(s));
                    let missing: Vec<Option<Expr>> = missing.map(|s| d.exact_value(s)).collect();
                    let has_value = !missing.is_empty() && missing.iter().all(|v| v.is_some_and(is_measured));
                    let is_by_numbers = has_value
                        && self.points.value(known(pair.wanted)) == self.points.value(known(pair.value));
                    if is_by_numbers {
                        is_any = true;
                        continue;
                    }
                    let wanted = self.points.value(pair.wanted);
                    let variants = match &pair.printed {
                        Some(syntax) if syntax.sign_choices() > 0 => {
                            syntax.variants().iter().map(|s| s.value()).collect()
                        }
                        _ => vec![pair.value],
                    };
                    let variants = with_named_signs(variants);
                    // A root has no value at a random point: the product of the differences has.
                    if variants.len() > 1 {
                        let product = variants.iter().fold(Expr::int(1), |p, &v| p * (pair.wanted - v));
                        if variants.len() <= 4 && equal(product, Expr::int(0)).is_equal() {
                            is_any = true;
                            continue;
                        }
                    }
                    let values: Vec<_> = variants.into_iter().map(|v| self.points.value(v)).collect();
                    if wanted.is_none() || values.iter().all(Option::is_none) {
                        continue;
                    }
                    values.contains(&wanted)
                }
                Piece::Number { answer, .. } => match numbers::judge(answer, subject, None) {
                    Finding::Equal { .. } => true,
                    Finding::Wrong(_) => false,
                    _ => continue,
                },
                Piece::Unreadable { .. } => {
                    is_whole = false;
                    continue;
                }
            };
            if !is_right {
                return Some(false);
            }
            is_any = true;
        }
        // What is read in part only is no support.
        (is_any && is_whole).then_some(true)
    }
}
