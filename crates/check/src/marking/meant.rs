//! Which item of a rubric a claim belongs to: by what it is about, and only where that does not say it by its name.

use super::{Form, Item, Subject, fits, plain};
use crate::facts::{About, Instead, Meaning};
use crate::outcome::{Checked, Claim, Standing};
use denavit::description::Description;
use denavit::forward::Reference;
use denavit::geometry::Transform;
use denavit_symbolic::parse::parse;
use denavit_symbolic::vocabulary::Vocabulary;

/// A place in the arm: the base, a frame by its row, the tool.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Place {
    Base,
    Frame(usize),
    Tool,
}

/// How a claim belongs to an item.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Belongs {
    /// By its name, or by what it is about.
    Yes,
    /// Its value answers the item, its name says something else.
    NamedOtherwise,
}

/// What the items of a rubric are about, where they do not say it: as their left sides are read of this robot.
pub(super) fn subjects(item: &Item, robot: Option<&Description>) -> Vec<Subject> {
    if !item.about.is_empty() {
        return item.about.clone();
    }
    let rows = robot.map_or(0, |d| d.rows.len());
    let names: Vec<String> = item.claims.iter().map(|c| plain(c)).collect();
    let has = |all: &[&str]| names.iter().any(|n| all.contains(&n.as_str()));
    let pairs: Vec<(usize, usize)> = names.iter().filter_map(|n| between(n)).collect();
    // An item for one link or one joint is about no other.
    let is_links = rows > 0 && (0..rows).all(|k| pairs.contains(&(k, k + 1)));
    let all = [
        (Subject::Links, is_links),
        (Subject::Pose, rows > 1 && pairs.contains(&(0, rows))),
        (Subject::Determinant, has(&["detJ", "det*"])),
        (Subject::Joints, has(&["q*", "theta*"])),
    ];
    all.into_iter().filter(|(_, is)| *is).map(|(subject, _)| subject).collect()
}

/// The frames that a name of one letter has: `{}^0T_3`, `T03`, `0T3`.
fn between(name: &str) -> Option<(usize, usize)> {
    let (letters, digits): (Vec<char>, Vec<char>) = name.chars().partition(|c| !c.is_ascii_digit());
    let digit = |k: usize| digits.get(k).and_then(|d| d.to_digit(10)).map(|d| d as usize);
    (letters.len() == 1 && digits.len() == 2 && matches!(letters[0], 'A' | 'T' | 'H'))
        .then(|| digit(0).zip(digit(1)))?
}

/// The frames between which a claim's matrix goes, the one in which it is seen first; of a part of it, too.
fn frames(meaning: &Meaning) -> Option<(Place, Place)> {
    let place = |r: &Reference| match r {
        Reference::Base => Place::Base,
        Reference::Frame(k) => Place::Frame(*k),
        Reference::Tool => Place::Tool,
    };
    match meaning {
        Meaning::Hand | Meaning::Position => Some((Place::Base, Place::Tool)),
        Meaning::Frame { of, seen_from } => Some((place(seen_from), place(of))),
        Meaning::Rotation(inner) | Meaning::Origin(inner) => frames(inner),
        Meaning::Inverse(inner) => frames(inner).map(|(from, to)| (to, from)),
        Meaning::Product(factors) => {
            let mut all = factors.iter().map(frames);
            let first = all.next()??;
            all.try_fold(first, |(from, at), next| {
                let (next_from, to) = next?;
                (next_from == at).then_some((from, to))
            })
        }
        _ => None,
    }
}

/// Whether a claim is about the pose of the tool in the base, or a link, with the ends that are the same taken for one.
fn of_frames((from, to): (Place, Place), robot: &Description) -> Option<Subject> {
    let same = |x: &Transform<_>| *x == Transform::identity();
    let rows = robot.rows.len();
    let own = |place: Place| match place {
        Place::Base if same(&robot.base) => Place::Frame(0),
        Place::Tool if same(&robot.tool) => Place::Frame(rows),
        other => other,
    };
    let ends = [own(from), own(to)];
    let is_pose = ends == [own(Place::Base), own(Place::Tool)];
    match ends {
        _ if is_pose && rows > 1 => Some(Subject::Pose),
        [Place::Frame(i), Place::Frame(j)] if j == i + 1 => Some(Subject::Links),
        _ if is_pose => Some(Subject::Pose),
        _ => None,
    }
}

/// What a claim is about, as far as a rubric asks for it.
fn subject(claim: &Claim, robot: &Description) -> Option<Subject> {
    match &claim.about {
        About::Matrix(Meaning::Row) => Some(Subject::Links),
        About::Matrix(meaning) => of_frames(frames(meaning)?, robot),
        About::Singularity => Some(Subject::Singularities),
        About::Joint | About::Configuration => Some(Subject::Joints),
        _ if is_determinant(&claim.name) => Some(Subject::Determinant),
        _ => None,
    }
}

/// The pose by its value, where its name makes it the inverse.
fn by_value(claim: &Claim, robot: &Description) -> Option<Subject> {
    let About::Matrix(meaning) = &claim.about else { return None };
    let is_inverse = matches!(claim.instead, Some(Instead::Inverse));
    if !matches!(meaning, Meaning::Frame { .. }) || claim.standing() != Standing::Wrong || !is_inverse {
        return None;
    }
    let (from, to) = frames(meaning)?;
    of_frames((to, from), robot).filter(|subject| *subject == Subject::Pose)
}

/// For each claim, whether the same whole matrix of formulas stands before it, and right as it is: it says nothing new.
pub(super) fn repeated(text: &str, checked: &Checked) -> Vec<bool> {
    let mut seen: Vec<(usize, (Place, Place))> = vec![];
    let is_again = |claim: &Claim| {
        let About::Matrix(meaning) = &claim.about else { return false };
        let is_whole = claim.entries.iter().filter(|e| e.place.is_some()).count() >= 12
            && form(text, claim) == Some(Form::Formulas);
        let Some(key) = frames(meaning).filter(|_| is_whole && claim.standing() == Standing::Equal) else {
            return false;
        };
        let is_known = seen.contains(&(claim.robot, key));
        seen.push((claim.robot, key));
        is_known
    };
    checked.claims.iter().map(is_again).collect()
}

/// A name of a determinant: `det J`, `|J|`.
fn is_determinant(name: &str) -> bool {
    let mut bare: String = name.chars().filter(|c| !c.is_whitespace() && *c != '$').collect();
    for mark in ["\\left", "\\right", "\\operatorname", "\\mathrm", "{", "}"] {
        bare = bare.replace(mark, "");
    }
    let bare = bare.replace("\\lvert", "|").replace("\\rvert", "|").replace("\\vert", "|");
    let is_barred = bare.len() > 2 && bare.starts_with('|') && bare.ends_with('|');
    is_barred || bare.trim_start_matches('\\').to_lowercase().starts_with("det")
}

/// Whether a claim gives numbers alone: of a matrix, whether no entry has a letter and some are more than zeros and ones.
fn form(text: &str, claim: &Claim) -> Option<Form> {
    let printed = |span: &std::ops::Range<usize>| text.get(span.clone()).unwrap_or_default();
    let bare = |source: &str| source.replace("\\pi", "3").replace('π', "3").replace('−', "-");
    let is_number = |source: &str| {
        let source = bare(source);
        match parse(source.trim(), &Vocabulary::new().open(true)) {
            Ok(value) => value.symbols().is_empty(),
            Err(_) => !source.chars().any(char::is_alphabetic),
        }
    };
    let is_trivial = |source: &str| matches!(source.trim(), "0" | "1" | "-1" | "−1" | "");
    // What stands before a matrix, as a product, is not one of its entries.
    let entries = || claim.entries.iter().filter(|e| e.place.is_some() || claim.entries.len() == 1);
    if !entries().all(|e| is_number(printed(&e.span))) {
        return Some(Form::Formulas);
    }
    let is_told = entries().any(|e| !is_trivial(printed(&e.span)));
    (is_told && claim.entries.iter().any(|e| e.place.is_some())).then_some(Form::Numbers)
}

/// The items to which each claim belongs.
pub(super) fn belonging(items: &[Item], text: &str, checked: &Checked) -> Vec<Vec<Option<Belongs>>> {
    let of_items: Vec<Vec<Subject>> = items.iter().map(|i| subjects(i, checked.robots.first())).collect();
    let row = |claim: &Claim| -> Vec<Option<Belongs>> {
        let Some(robot) = checked.robots.get(claim.robot) else { return vec![None; items.len()] };
        let form = form(text, claim);
        let is_form = |item: &Item| item.form.is_none() || form.is_none() || item.form == form;
        let about = |subject: Option<Subject>| {
            (0..items.len())
                .filter(|&k| subject.is_some_and(|s| of_items[k].contains(&s)) && is_form(&items[k]))
                .collect::<Vec<usize>>()
        };
        let named = |item: &Item| item.claims.iter().any(|c| fits(&plain(c), &plain(&claim.name)));
        let (own, by_value) = (about(subject(claim, robot)), about(by_value(claim, robot)));
        // Where nothing says which item asks for numbers, their name does.
        let by_name = |k: usize| form == Some(Form::Numbers) && named(&items[k]) && items[k].about.is_empty();
        let is_matrix = matches!(claim.about, About::Matrix(_)) && !(0..items.len()).any(by_name);
        let mut found: Vec<Option<Belongs>> = vec![None; items.len()];
        // What a matrix is decides; its name where that is nothing that an item asks for.
        if !is_matrix || (own.is_empty() && by_value.is_empty()) {
            for k in (0..items.len()).filter(|&k| named(&items[k]) && is_form(&items[k])) {
                found[k] = Some(Belongs::Yes);
            }
        }
        if by_value.is_empty() && found.iter().all(Option::is_none) {
            // Of several that ask for it, those that name it so.
            let by_name: Vec<usize> = own.iter().copied().filter(|&k| named(&items[k])).collect();
            for k in if by_name.is_empty() { own } else { by_name } {
                found[k] = Some(Belongs::Yes);
            }
        }
        by_value.into_iter().for_each(|k| found[k] = Some(Belongs::NamedOtherwise));
        found
    };
    checked.claims.iter().map(row).collect()
}

/// Whether a claim that belongs to no item may be meant for this one: it is not known to be something else.
pub(super) fn may_be_meant(item: &Item, claim: &Claim, checked: &Checked) -> bool {
    let about = subjects(item, checked.robots.first());
    let is_joints = || about.contains(&Subject::Joints) || about.contains(&Subject::Singularities);
    match &claim.about {
        About::Helper | About::Table | About::TableRow | About::Dynamics(_) => false,
        About::Matrix(Meaning::Jacobian(_) | Meaning::Column(..) | Meaning::Torques) => false,
        About::Matrix(_) | About::Matrices => {
            let is_square = claim.entries.iter().filter(|e| e.place.is_some()).count() >= 12;
            is_square && (about.contains(&Subject::Pose) || about.contains(&Subject::Links))
        }
        About::Entry => about.contains(&Subject::Pose),
        About::Singularity | About::Joint | About::Configuration => is_joints(),
        About::Equation => {
            is_joints() || (about.contains(&Subject::Determinant) && is_determinant(&claim.name))
        }
        About::Angle(_) => false,
    }
}
