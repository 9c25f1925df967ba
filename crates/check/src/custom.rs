//! Names that custom gives a meaning beside the entries of the pose: velocities and rates, torques and forces, the wrist centre,
//! entries of frames in each other, the direction of a planar arm, and the letters that a text uses for the hand's place.

use super::habits::{Habits, Places};
pub(super) use super::letters::plain;
use super::letters::{AXES, Add, is_mentioned, speaks_of_speed};
use super::matrix::Matrix;
use super::subject::Subject;
use denavit::description::JointKind;
use denavit::geometry::{Transform, Vector};
use denavit_reading::slip::Points;
use denavit_symbolic::Expr;
use denavit_symbolic::vocabulary::plain_name;
use std::collections::BTreeSet;
use std::ops::Range;

/// A name with its meaning.
#[derive(Clone, Debug)]
pub(super) struct Custom {
    pub name: String,
    pub meaning: Expr,
    /// The same with the entries of the pose as symbols.
    pub inverse: Expr,
}

/// The customary names that a text mentions.
pub(super) fn names(subject: &Subject, text: &str, habits: &Habits) -> Vec<Custom> {
    let places = &Places(habits.columns);
    if subject.last() == 0 {
        return vec![];
    }
    let plain = plain(text);
    let mut found = vec![];
    let mut add = |name: &str, meaning: Expr, inverse: Expr| {
        found.push(Custom { name: name.to_string(), meaning, inverse });
    };
    rates(subject, text, &plain, &mut add);
    super::loads::torques(subject, text, habits, &mut add);
    wrist(subject, &plain, places, &mut add);
    frames(subject, &plain, places, &mut add);
    told_origins(subject, text, places, &mut add);
    wrist_rotation(subject, &plain, places, &mut add);
    super::components::of_columns(subject, &plain, places, &mut add);
    super::directions::direction(subject, &plain, places, &mut add);
    for letters in hand_letters(text) {
        for (r, name) in letters.iter().enumerate() {
            add(name, subject.pose().translation.0[r], places.symbol(r, 3).into());
        }
    }
    found
}

/// Words for an angular velocity, which is `wx, wy, wz` for those who write no ω.
const ANGULAR: [&str; 9] = [
    "angular",
    "angulaire",
    "vitesse de rotation",
    "vitesses de rotation",
    "winkelgeschw",
    "drehgeschw",
    "angolare",
    "hoeksnelheid",
    "rotational velocity",
];

/// Joint rates, and the velocity of the hand in them.
fn rates(subject: &Subject, text: &str, plain: &str, add: &mut Add<'_>) {
    let speaks = speaks_of_speed(text);
    let is_moving = speaks
        || plain.contains("dot")
        || plain.contains('\u{307}')
        || ["vx", "vy", "vz", "Vx", "Vy", "ωx", "ωz"].iter().any(|n| plain.contains(n));
    if !is_moving {
        return;
    }
    let names = subject.vocabulary();
    for (v, rate) in subject.description.variables().iter().zip(subject.rates()) {
        let is_own = |name: &str| names.lookup(name).is_none_or(|e| e.as_symbol() == Some(v.symbol));
        // By its own name, unless the document gives that to another joint.
        let mut spellings: Vec<String> =
            Some(v.symbol.name().to_string()).filter(|n| is_own(n)).into_iter().collect();
        // Rows that are numbered on from another table, or from 0.
        let counted =
            v.symbol.name().trim_start_matches('q').parse::<usize>().map_or(0, |n| n + subject.first);
        let letters: &[&str] = match v.kind {
            JointKind::Revolute => &["θ", "t", "th", "theta", "q"],
            JointKind::Prismatic => &["d", "r", "q", "l"],
        };
        let numbers = [counted, counted.saturating_sub(1)];
        for (letter, number) in letters.iter().flat_map(|l| numbers.map(|n| (l, n))) {
            let name = format!("{letter}{number}");
            if names.lookup(&name).is_some_and(|e| e.as_symbol() == Some(v.symbol)) {
                spellings.push(name);
            }
        }
        spellings.extend(
            subject
                .variables
                .iter()
                .flatten()
                .filter(|p| names.lookup(p).is_some_and(|e| e.as_symbol() == Some(v.symbol)))
                .flat_map(|p| super::subject::spellings(p)),
        );
        spellings.sort();
        spellings.dedup();
        for name in spellings {
            for spelled in [format!("dot{name}"), format!("{name}dot"), format!("d{name}")] {
                add(&spelled, rate, rate);
            }
        }
    }
    if speaks {
        for (name, joint) in lettered_rates(subject, text, plain) {
            let rate = subject.rates()[joint];
            add(&name, rate, rate);
        }
    }
    let lower = text.to_lowercase();
    let turns = ANGULAR.iter().any(|words| lower.contains(words));
    let velocity = subject.velocity();
    for (r, axis) in AXES.iter().enumerate() {
        let (linear, angular) = (velocity[r], velocity[3 + r]);
        let upper = axis.to_uppercase();
        for name in [
            format!("v{axis}"),
            format!("V{axis}"),
            format!("dot{axis}"),
            format!("{axis}dot"),
            format!("dot{upper}"),
            format!("{upper}dot"),
            format!("dotp{axis}"),
            format!("dotP{axis}"),
            format!("p{axis}dot"),
        ] {
            add(&name, linear, linear);
        }
        add(&format!("ω{axis}"), angular, angular);
        if turns {
            add(&format!("w{axis}"), angular, angular);
        }
    }
}

/// Letters of their own for the rates of joints, each with the place of the joint: `w1 for θ1`, or ω1, ω2 with the numbers of joints.
fn lettered_rates(subject: &Subject, text: &str, plain: &str) -> Vec<(String, usize)> {
    const LETTERS: [&str; 4] = ["ω", "w", "Ω", "u"];
    const FOR: [&str; 8] = ["for", "für", "pour", "para", "per", "of", "voor", "dla"];
    const MOST: usize = 20;
    let names = subject.vocabulary();
    let joint = |name: &str| names.lookup(name).and_then(|e| subject.joints().iter().position(|q| *q == e));
    let is_name = |w: &str| {
        let stem = w.trim_end_matches(|c: char| c.is_ascii_digit());
        w.len() < 12 && stem.len() < w.len() && (1..=2).contains(&stem.chars().count())
    };
    let mut found: Vec<(String, usize)> = vec![];
    let spoken = |l: &&str| l.len() < 1_000 && speaks_of_speed(l);
    for line in text.lines().filter(spoken).take(MOST) {
        let words: Vec<&str> = line
            .split(|c: char| c.is_whitespace() || matches!(c, ',' | '(' | ')' | ':' | ';' | '.' | '$' | '`'))
            .filter(|w| !w.is_empty())
            .collect();
        for w in words.windows(3).filter(|w| FOR.contains(&w[1])) {
            let name = plain_name(w[0]);
            if let Some(k) = joint(w[2]).filter(|_| is_name(&name) && names.lookup(&name).is_none()) {
                found.push((name, k));
            }
        }
    }
    for letter in LETTERS {
        let number = |k: u32| {
            let name = format!("{letter}{k}");
            let is_there = is_mentioned(text, &name) || is_mentioned(plain, &name);
            let own = joint(&format!("q{k}")).or_else(|| joint(&format!("θ{k}")));
            (is_there && names.lookup(&name).is_none()).then_some((name, own))
        };
        let all: Vec<(String, Option<usize>)> = (0..10).filter_map(number).collect();
        // `ω_2 = (0, w_1, 0)` is something else.
        let has_formula = |name: &str| {
            let mut given = ["=", "&="].into_iter().flat_map(|sign| {
                let at = plain.match_indices(&format!("{name}{sign}")).collect::<Vec<_>>();
                at.into_iter().map(move |(i, m)| i + m.len())
            });
            let is_number = |c: char| c.is_ascii_digit() || matches!(c, '-' | '−' | '+' | '.' | '$');
            given.any(|i| !plain[i..].starts_with(is_number))
        };
        let is_family = all.len() > 1 || all.len() == subject.joints().len();
        if !is_family || all.iter().any(|(name, own)| own.is_none() || has_formula(name)) {
            continue;
        }
        found.extend(all.into_iter().filter_map(|(name, own)| Some((name, own?))));
    }
    found.truncate(MOST);
    found
}

/// The torques of all joints, below one another.
pub(super) fn torque_column(subject: &Subject, text: &str, habits: &Habits) -> Option<Matrix> {
    let mut found: Vec<(String, Expr)> = vec![];
    super::loads::torques(subject, text, habits, &mut |name, meaning, _| {
        found.push((name.to_string(), meaning))
    });
    let of = |k: usize| found.iter().find(|(name, _)| *name == format!("τ{k}")).map(|f| vec![Some(f.1)]);
    let column: Vec<Vec<Option<Expr>>> = (1..=subject.joints().len()).map_while(of).collect();
    (!column.is_empty() && column.len() == subject.joints().len()).then_some(Matrix(column))
}

/// True for a text that has p_x, p_y for the place of the hand.
pub(super) fn has_place(text: &str) -> bool {
    let has = |axis: &str| {
        let marked = ["p_", "p_{", "P_", "P_{"].iter().any(|p| text.contains(&format!("{p}{axis}")));
        marked || ["p", "P"].iter().any(|p| is_mentioned(text, &format!("{p}{axis}")))
    };
    has("x") && has("y")
}

/// True for a text that gives the entries of some matrix names t_ij: `call its entries t11, t21, …`.
pub(super) fn calls_entries(text: &str) -> bool {
    let lower = text.to_lowercase();
    if !["entries", "element", "élément"].iter().any(|w| lower.contains(w)) {
        return false;
    }
    let lower = plain_name(&lower).replace('$', "");
    ["entriest1", "elementst1", "elementet1", "élémentst1", "elementost1", "elementit1"]
        .iter()
        .any(|w| lower.contains(w))
}

/// True for a text that has names for the entries of a rotation: no frame is turned against itself, as `R_{11}` would be.
pub(super) fn names_entries(text: &str) -> bool {
    ["R11", "R22", "R33"].iter().any(|name| is_mentioned(text, name))
}

/// The point in which the last three axes meet.
fn wrist(subject: &Subject, plain: &str, places: &Places, add: &mut Add<'_>) {
    let n = subject.last();
    // The arm without its wrist has the wrist's centre as its hand.
    let is_arm = (2..=4).contains(&n) && subject.joints().len() <= 3;
    let origin = || subject.transform(Some(n), None).map(|x| x.translation).filter(|_| is_arm);
    let own = subject.wrist_centre();
    let is_only_arm = own.is_none();
    let Some(centre) = own.or_else(origin) else { return };
    let Some(base) = subject.transform(Some(0), Some(n)) else { return };
    let point = base.act_on_point(centre);
    let Some(tool) = subject.transform(None, Some(n)) else { return };
    let inverse = places.pose().act_on_point(tool.act_on_point(centre));
    for (r, axis) in AXES.iter().enumerate() {
        let spelled = |a: &str| {
            [
                format!("{a}c"),
                format!("{a}w"),
                format!("p{a}c"),
                format!("p{a}w"),
                format!("pc{a}"),
                format!("pw{a}"),
                format!("pW{a}"),
                format!("PW{a}"),
                format!("oW{a}"),
                format!("oc{a}"),
                format!("P{a}w"),
                format!("Pw{a}"),
                format!("w{a}"),
                format!("W{a}"),
            ]
        };
        let is_meant =
            |name: &String| plain.contains(name.as_str()) && (!is_only_arm || name.starts_with(['p', 'P']));
        for name in spelled(axis).into_iter().filter(is_meant) {
            add(&name, point.0[r], inverse.0[r]);
        }
    }
}

/// Entries of a frame in another: `p_{14x}` is the x of its origin, `x_{34y}` the y of its axis x.
fn frames(subject: &Subject, plain: &str, places: &Places, add: &mut Add<'_>) {
    let chars: Vec<char> = plain.chars().collect();
    let mut seen = BTreeSet::new();
    // The origin of a frame in the base: `p_{5x}`.
    for w in chars.windows(3) {
        let [letter @ ('p' | 'P' | 'o' | 'O'), j, axis] = w else { continue };
        let (Some(j), Some(r)) = (j.to_digit(10), AXES.iter().position(|a| a.starts_with(*axis))) else {
            continue;
        };
        let name = format!("{letter}{j}{axis}");
        let j = j as usize;
        if j == 0 || j > subject.last() || !seen.insert(name.clone()) {
            continue;
        }
        let behind = subject.transform(None, Some(j));
        if let (Some(x), Some(behind)) = (subject.transform(Some(0), Some(j)), behind) {
            add(&name, x.translation.0[r], (places.pose() * behind).translation.0[r]);
        }
    }
    for w in chars.windows(4) {
        let [letter, i, j, axis] = w else { continue };
        let (Some(i), Some(j)) = (i.to_digit(10), j.to_digit(10)) else { continue };
        let Some(r) = ['x', 'y', 'z'].iter().position(|a| a == axis) else { continue };
        let column = match letter {
            'x' => 0,
            'y' => 1,
            'z' => 2,
            'p' | 'P' | 'o' | 'O' => 3,
            _ => continue,
        };
        let name: String = w.iter().collect();
        if !seen.insert(name.clone()) || seen.len() > 200 {
            continue;
        }
        let (i, j) = (i as usize, j as usize);
        if let (Some(x), Some(y)) = (subject.transform(Some(i), Some(j)), seen_through(subject, places, i, j))
        {
            add(&name, x.matrix()[r][column], y.matrix()[r][column]);
        }
    }
}

/// Components of a point that words call the origin of a frame, `w = (w_x, w_y), the origin of frame {3}`, in the base; nothing where
/// the clause names another frame in which they may be.
fn told_origins(subject: &Subject, text: &str, places: &Places, add: &mut Add<'_>) {
    const WORDS: [&str; 9] = [
        "origin of frame",
        "origin of the frame",
        "origine du repère",
        "origine du rep\\`ere",
        "ursprung des koordinatensystems",
        "ursprung des systems",
        "origen del sistema",
        "origine della terna",
        "origem do sistema",
    ];
    let lower = text.to_ascii_lowercase();
    for (at, word) in WORDS.iter().flat_map(|w| lower.match_indices(w).take(10)) {
        let behind = lower[at + word.len()..].trim_start_matches(|c: char| " $\\{~".contains(c));
        let digits = behind.chars().take_while(char::is_ascii_digit).count();
        let Some(frame) = behind[..digits].parse().ok().filter(|k| (1..=subject.last()).contains(k)) else {
            continue;
        };
        let behind = text.len() - (behind.len() - digits);
        let clause = clause(text, at, behind);
        if is_seen_from_another(&lower[clause.start..at]) || is_seen_from_another(&lower[behind..clause.end])
        {
            continue;
        }
        let list = list_before(&text[clause.start..at]).or_else(|| list_behind(&text[behind..clause.end]));
        let names: Vec<String> =
            list.unwrap_or_default().split(',').map(|n| plain_name(&n.replace('$', ""))).collect();
        let stem = names[0].strip_suffix('x').unwrap_or_default();
        let is_list = names.iter().zip(AXES).all(|(n, axis)| n.strip_suffix(axis) == Some(stem));
        let is_letter =
            (1..=2).contains(&stem.chars().count()) && !stem.contains(|c: char| c.is_ascii_digit());
        // The hand's own letter stays that.
        let is_hand = stem.eq_ignore_ascii_case("p") && frame != subject.last();
        if !(2..=3).contains(&names.len()) || !is_list || !is_letter || is_hand {
            continue;
        }
        let (own, behind) = (subject.transform(Some(0), Some(frame)), subject.transform(None, Some(frame)));
        let (Some(own), Some(behind)) = (own, behind) else { continue };
        let inverse = (places.pose() * behind).translation;
        for (r, name) in names.iter().enumerate() {
            add(name, own.translation.0[r], inverse.0[r]);
        }
    }
}

/// The clause around a part of a text, as far as it matters.
fn clause(text: &str, from: usize, to: usize) -> Range<usize> {
    const FAR: usize = 120;
    let start = (from.saturating_sub(FAR)..from).find(|&i| text.is_char_boundary(i)).unwrap_or(from);
    let end = (to..text.len().min(to + FAR)).rev().find(|&i| text.is_char_boundary(i)).unwrap_or(to);
    let marks = [". ", ".\n", "; ", ": ", ":\n", "\n\n"];
    let cut = |part: &str| marks.iter().filter_map(|m| part.rfind(m).map(|i| i + m.len())).max();
    let start = start + cut(&text[start..from]).unwrap_or(0);
    let behind = &text[to..end];
    let end = marks.iter().filter_map(|m| behind.find(m)).min().map_or(end, |i| to + i);
    start..end
}

/// True if a part of a clause names a frame other than the base, or says that something is seen from elsewhere.
fn is_seen_from_another(part: &str) -> bool {
    const FRAMES: [&str; 6] = ["frame", "system", "repère", "rep\\`ere", "terna", "sistema"];
    const SEEN: [&str; 12] = [
        "seen",
        "view",
        "relativ",
        "respect",
        "express",
        "gesehen",
        "bezüglich",
        "rapport",
        "exprim",
        "rispetto",
        "would",
        "along",
    ];
    let is_base = ["base", "basis", "basi", "frame 0", "{0", "system 0"].iter().any(|w| part.contains(w));
    let names_frame = FRAMES.iter().flat_map(|w| part.match_indices(w).map(|m| m.0 + w.len())).any(|i| {
        let number = part[i..].trim_start_matches(|c: char| " $\\{~".contains(c));
        number.starts_with(|c: char| c.is_ascii_digit() && c != '0')
    });
    names_frame || (SEEN.iter().any(|w| part.contains(w)) && !is_base)
}

/// The list that a part of a text ends with: `w = (w_x, w_y) be the`, `w = (w_x, w_y) (the`.
fn list_before(part: &str) -> Option<&str> {
    const WORDS: [&str; 18] = [
        "the", "be", "is", "as", "der", "den", "ist", "sei", "l", "est", "soit", "el", "es", "sea", "o", "é",
        "seja", "la",
    ];
    let mut rest = part;
    for _ in 0..4 {
        rest = rest.trim_end_matches([' ', ',', '\n', '$', '(', '\'', '’', '~']);
        let word = rest.rsplit([' ', '\n', '$', ')', '(']).next().unwrap_or_default();
        if !WORDS.contains(&word) {
            break;
        }
        rest = &rest[..rest.len() - word.len()];
    }
    let (before, list) = rest.strip_suffix(')')?.rsplit_once('(')?;
    // `{}^1 w = (…)` is in a frame.
    let name = before.rsplit([' ', '\n']).next().unwrap_or_default();
    (!before.ends_with('^') && !name.contains('^')).then_some(list)
}

/// The list that a part of a text says to be what stands before it: `} is w = (w_x, w_y)`.
fn list_behind(part: &str) -> Option<&str> {
    const WORDS: [&str; 9] = ["is", "be", "ist", "sei", "est", "es", "è", "é", "liegt"];
    let rest = part.trim_start_matches([' ', '\\', '}', '$', ')', ',', '\n', '~']);
    let word =
        WORDS.iter().find(|w| rest.strip_prefix(**w).is_some_and(|r| r.starts_with([' ', '\n', '~'])))?;
    let (name, rest) = rest[word.len()..].split_once('(')?;
    let name = name.trim_matches([' ', '$', '\n', '=', '~']);
    let (list, _) = rest.split_once(')')?;
    let is_name = name.chars().count() <= 2 && name.chars().all(char::is_alphabetic);
    (is_name || matches!(name, "at" | "bei" | "en" | "in")).then_some(list)
}

/// Entries of the rotation of the wrist, frame 6 in frame 3: `m_{13}`, where a text has several of them and speaks of that frame.
fn wrist_rotation(subject: &Subject, plain: &str, places: &Places, add: &mut Add<'_>) {
    let entries = |letter: &str| {
        (0..9).filter(|k| plain.contains(&format!("{letter}{}{}", k / 3 + 1, k % 3 + 1))).count()
    };
    let letters: Vec<&str> = ["m", "M", "g", "G", "u", "U"].into_iter().filter(|l| entries(l) >= 3).collect();
    if letters.is_empty() || !speaks_of_wrist(plain) {
        return;
    }
    let (Some(x), Some(y)) = (subject.transform(Some(3), Some(6)), seen_through(subject, places, 3, 6))
    else {
        return;
    };
    let (x, y) = (x.rotation.rows(), y.rotation.rows());
    for (r, c) in (0..9).map(|k| (k / 3, k % 3)) {
        for letter in &letters {
            add(&format!("{letter}{}{}", r + 1, c + 1), x[r][c], y[r][c]);
        }
    }
}

/// True for a text, without marks of subscripts, that speaks of frame 6 in frame 3.
pub(super) fn speaks_of_wrist(plain: &str) -> bool {
    ["36", "3R6", "R^36", "3^6", "6^3", "3T6", "3A6"].iter().any(|f| plain.contains(f))
}

/// Frame 6 in frame 3 of an arm with six joints, and that by the pose as symbols.
pub(super) fn wrist_frame(subject: &Subject, places: &Places) -> Option<(Transform<Expr>, Transform<Expr>)> {
    let n = subject.last();
    let has_wrist = matches!(n, 6 | 7);
    has_wrist
        .then(|| Some((subject.transform(Some(n - 3), Some(n))?, seen_through(subject, places, n - 3, n)?)))?
}

/// A frame in another by the hand's pose as symbols and the joints outside of both.
pub(super) fn seen_through(
    subject: &Subject,
    places: &Places,
    i: usize,
    j: usize,
) -> Option<Transform<Expr>> {
    let before = subject.transform(Some(0), Some(i))?.inverse();
    let behind = subject.transform(None, Some(j))?;
    Some(before * places.pose() * behind)
}

/// The letters for the hand's place that sentences tell: `the tip is at (q_x, q_y)`.
pub(super) fn hand_letters(text: &str) -> Vec<Vec<String>> {
    const HANDS: [&str; 22] = [
        "end effector",
        "end-effector",
        "effector",
        " hand ",
        "tip ",
        "gripper",
        "tool",
        "tcp",
        "spitze",
        "greifer",
        "hand ",
        "endeffektor",
        "organe terminal",
        "outil",
        "efector",
        "pinza",
        "mano",
        "punta",
        "garra",
        "extremo",
        "flange",
        "position",
    ];
    let lower = text.to_ascii_lowercase();
    let mut found: Vec<Vec<String>> = vec![];
    for (at, word) in HANDS.iter().flat_map(|w| lower.match_indices(w).take(10)) {
        let rest = &text[at + word.len()..];
        let sentence = rest.split(['\n', ';', ':']).next().unwrap_or_default();
        let sentence = sentence.split(". ").next().unwrap_or_default();
        let bare = letters_without_brackets(sentence);
        found.extend(bare.filter(|names| !found.contains(names)));
        let Some(open) = sentence.find('(').filter(|o| *o < 40) else { continue };
        if sentence[..open].contains('=') {
            continue;
        }
        let Some(close) = sentence[open..].find(')') else { continue };
        let inner = &sentence[open + 1..open + close];
        let names: Vec<String> = inner.split(',').map(|n| plain_name(&n.replace(['$', '*'], ""))).collect();
        // `(w_1, w_2, w_3)`
        let by_numbers = names.len() == 3
            && names.iter().zip(["1", "2", "3"]).all(|(n, k)| {
                n.strip_suffix(k).is_some_and(|s| {
                    s.chars().count() == 1 && s.chars().all(|c| matches!(c, 'p' | 'P' | 'w' | 'x' | 'r'))
                })
            });
        let is_name = |n: &String| {
            n.chars().next().is_some_and(char::is_alphabetic)
                && n.chars().count() <= 4
                && n.chars().all(char::is_alphanumeric)
        };
        let ends = |n: &String, a: &str| n.to_lowercase().ends_with(a);
        let by_axes = names.iter().zip(AXES).all(|(n, a)| ends(n, a));
        if (2..=3).contains(&names.len())
            && names.iter().all(is_name)
            && (by_axes || by_numbers)
            && !found.contains(&names)
        {
            found.push(names);
        }
    }
    found
}

/// `… is given by $q_x$, $q_y$, $q_z$`
fn letters_without_brackets(sentence: &str) -> Option<Vec<String>> {
    let words: Vec<&str> =
        sentence.split([' ', ',']).filter(|w| !w.is_empty() && *w != "and").take(12).collect();
    let names: Vec<String> = words.iter().map(|w| plain_name(&w.replace(['$', '*', '.'], ""))).collect();
    let is_name = |n: &str, axis: &str| {
        let stem = n.strip_suffix(axis);
        stem.is_some_and(|s| (1..=2).contains(&s.chars().count()) && s.chars().all(char::is_alphabetic))
    };
    let run = names.windows(3).find(|w| w.iter().zip(AXES).all(|(n, a)| is_name(n, a)))?;
    let stems: BTreeSet<&str> = run.iter().zip(AXES).filter_map(|(n, a)| n.strip_suffix(a)).collect();
    (stems.len() == 1 && !stems.contains("p")).then(|| run.to_vec())
}

impl Subject {
    /// The point in which the last three axes meet, in the last frame, where it is fixed there and they turn.
    pub(super) fn wrist_centre(&self) -> Option<Vector<Expr>> {
        let n = self.last();
        let rows = &self.description.rows;
        let is_turning =
            |k: usize| rows.get(k).and_then(|r| r.variable).is_some_and(|v| v.kind == JointKind::Revolute);
        if n < 4 || !(n - 3..n).all(is_turning) {
            return None;
        }
        // Of the origins, the one that none of the last three joints moves.
        for k in (0..n).rev() {
            let here = self.transform(Some(n), Some(k))?.translation;
            let still = self.transform(Some(n - 3), Some(k))?.translation;
            let moves = |p: &Vector<Expr>, joints: &[Expr]| {
                p.0.iter().any(|e| {
                    let symbols = e.symbols();
                    joints.iter().filter_map(|q| q.as_symbol()).any(|s| symbols.contains(&s))
                        && points_differ(*e, joints)
                })
            };
            let last = &self.joints()[self.joints().len().checked_sub(3)?..];
            if !moves(&here, last) && !moves(&still, last) {
                return Some(here);
            }
        }
        None
    }
}

/// True if a formula depends on joints, not only in print.
fn points_differ(e: Expr, joints: &[Expr]) -> bool {
    let mut points = Points::new(13);
    let moved = e.substitute(|s| {
        joints.iter().any(|q| q.as_symbol() == Some(s)).then(|| Expr::symbol(&format!("{} moved", s.name())))
    });
    points.value(e) != points.value(moved)
}
