//! Programs of inverse kinematics: what they give joints, held against all solutions, the pose that they are told as symbols.

use super::stated::in_radians;
use super::{Program, Programs, Source, defined, given_in, names_in};
use crate::directions::{DIRECTIONS, parallel_sum, sum_in_pose};
use crate::facts::About;
use crate::habits::{Habits, Places, named_sign, with_named_signs};
use crate::lexis::Lexis;
use crate::named_sums::told;
use crate::note::Unread;
use crate::subject::Subject;
use crate::walk::{Assertion, Piece, Spoken};
use denavit::description::JointKind;
use denavit_reading::code::{Asked, Assigned, Cell, Code, Posed, Reading, Value, is_vector, read_blocks};
use denavit_symbolic::parse::{Syntax, SyntaxKind};
use denavit_symbolic::{Expr, Node};
use std::collections::BTreeMap;
use std::ops::Range;
use std::rc::Rc;

/// 180/π in the values of `atan2d`.
const PER_RADIAN: &str = "degrees of a radian";
/// The most values of one statement of a loop.
const MAX_VALUES: usize = 16;

/// What is known of a program that is told of a pose.
pub(super) struct Telling<'a> {
    pub subject: &'a Rc<Subject>,
    pub habits: &'a Rc<Habits>,
    pub lexis: &'a Lexis,
    /// Functions that give joints their values, or whole programs.
    pub functions: &'a [Range<usize>],
}

/// What the functions give joints, with the other claims in them; it takes the place of what was found there.
pub(super) fn solutions(of: &Source<'_>, telling: &Telling<'_>, asked: &Asked<'_>, found: &mut Programs) {
    let Source { text, blocks, language, number, .. } = *of;
    let Telling { subject, habits, lexis, functions } = *telling;
    let touches = |span: &Range<usize>| functions.iter().any(|f| f.start < span.end && span.start < f.end);
    if !blocks.iter().any(touches) {
        return;
    }
    let places = Places(habits.columns);
    let pitch = parallel_sum(subject).and_then(|sum| sum_in_pose(subject, &places, sum));
    let length = |name: &str| -> Option<Expr> {
        let lower = name.to_lowercase();
        let found = lexis.names.lookup(name).or_else(|| lexis.names.lookup(&lower))?;
        let d = &subject.description;
        // A number that the table has stays what the program says.
        found.as_symbol().filter(|s| d.parameter(*s).is_some() && d.exact_value(*s).is_none()).map(Expr::from)
    };
    // `H` is a pose, unless it is a length of the table.
    let own = |name: &str| lexis.names.lookup(name).and_then(|_| length(name)).map(|e| vec![vec![e]]);
    let sums = told(text, subject, &lexis.names, &places);
    let sum = |name: &str| sums.iter().find(|s| s.0 == name).map(|s| vec![vec![s.2]]);
    let given = |name: &str| {
        own(name)
            .or_else(|| sum(name))
            .or_else(|| given(name, lexis, &places, pitch))
            .or_else(|| Some(vec![vec![length(name)?]]))
    };
    let in_degrees = blocks.iter().any(|b| {
        let source = text.get(b.clone()).unwrap_or_default();
        ["atan2d(", "acosd(", "asind(", "cosd("].iter().any(|f| source.contains(f))
    });
    let per_radian = Expr::symbol(PER_RADIAN);
    let joint = |name: &str| {
        let joint = joint_of(name, lexis, subject)?;
        // `cosd(q1)` turns it back.
        Some(if in_degrees && is_turning(joint, subject) {
            joint * Expr::int(180) / Expr::pi()
        } else {
            joint
        })
    };
    let sign = |name: &str| named_sign(name);
    let posed = Posed { given: &given, joint: &joint, sign: &sign, per_radian };
    let mended = BTreeMap::new();
    let nothing = |_: &str, _: &[Expr]| None;
    let asked = Asked { posed: Some(posed), mended: &mended, stated: &nothing, ..*asked };
    let codes = read_blocks(text, blocks, language, &asked);
    let is_told = |f: &&Reading| {
        functions
            .iter()
            .any(|span| span.contains(&f.span.start) && (!f.name.is_empty() || f.span.end <= span.end + 1))
    };
    let mut chosen: Vec<Code> = vec![];
    for code in &codes {
        for function in code.functions.iter().filter(is_told) {
            let joints = joints_in(function, lexis, subject, number, &places);
            if joints.is_empty() {
                continue;
            }
            let inside = |span: &Range<usize>| {
                let is_script = function.name.is_empty();
                match is_script {
                    true => joints.iter().any(|a| a.span.start < span.end && span.start < a.span.end),
                    false => function.span.start < span.end && span.start < function.span.end,
                }
            };
            found.assertions.retain(|a| !inside(&a.span));
            found.refused.retain(|e| !inside(&e.span));
            found.unsaid.retain(|u| !inside(&u.0));
            let told = function.assigned.iter().filter(|a| !value_of(a).symbols().is_empty());
            found.unsaid.extend(told.map(|a| (a.span.clone(), a.name.clone())));
            found.defined.retain(|d| !inside(&d.statement));
            if !function.name.is_empty() {
                let refusals = code.refusals.iter().filter(|e| inside(&e.span)).cloned();
                found.refused.extend(refusals.map(Unread::from));
            }
            let by_table = at_the_pose(function, subject, &places);
            let names = Rc::new(names_in(function, lexis));
            let given = given_in(function, subject, lexis);
            let at: &[_] = &[];
            let program = Program { text, subject, lexis, number, names, given, functions: &[], at };
            let mut others = program.recognised(&by_table, &joints);
            let named = program.assigned(&by_table).into_iter();
            let named: Vec<Assertion> = named
                .filter(|a| matches!(a.about, About::Matrix(_)) && others_apart(&others, &a.span))
                .collect();
            others.extend(named);
            // What could not be read there is read here.
            let is_lost = |a: &Assertion| {
                a.pieces.iter().all(|p| matches!(p, Piece::Unreadable { .. })) && !a.pieces.is_empty()
            };
            found.assertions.retain(|a| !is_lost(a) || others_apart(&others, &a.span));
            let taken = found.assertions.iter().map(|a| a.span.clone()).collect::<Vec<_>>();
            let is_free =
                |a: &Assertion| taken.iter().all(|t| a.span.end <= t.start || t.end <= a.span.start);
            found.assertions.extend(joints.into_iter().chain(others).filter(is_free));
            let functions = vec![function.clone()];
            chosen.push(Code { functions, ..Code::default() });
        }
    }
    let more = defined(text, &chosen, &found.assertions, number);
    let is_new: Vec<_> =
        more.into_iter().filter(|d| found.defined.iter().all(|o| o.statement != d.statement)).collect();
    found.defined.extend(is_new);
}

fn others_apart(others: &[Assertion], span: &Range<usize>) -> bool {
    others.iter().all(|o| o.span.end <= span.start || span.end <= o.span.start)
}

/// The entries of the pose that a name of a program stands for.
fn given(name: &str, lexis: &Lexis, places: &Places, pitch: Option<Expr>) -> Option<Vec<Vec<Expr>>> {
    let pose = places.pose();
    let rows = pose.rotation.rows();
    let lower = name.to_lowercase();
    let stem = [
        "_goal", "goal", "_des", "des", "_target", "target", "_d", "_in", "_ee", "06", "05", "04", "03", "d",
    ]
    .iter()
    .find_map(|s| lower.strip_suffix(s).filter(|s| !s.is_empty()))
    .unwrap_or(&lower);
    match stem {
        "t" | "h" | "pose" | "tf" => return Some(pose.matrix().iter().map(|r| r.to_vec()).collect()),
        "r" | "rot" | "rotation" if name.starts_with('R') || stem.len() > 1 => {
            return Some(rows.iter().map(|r| r.to_vec()).collect());
        }
        "p" | "pos" | "position" | "xyz" | "point" | "tip" | "o" => {
            return Some(pose.translation.0.iter().map(|e| vec![*e]).collect());
        }
        _ => {}
    }
    let is_right = |name: &str| lexis.is_right(name) || lexis.is_by_custom(name);
    let symbol = lexis.inverse.lookup(name).filter(|e| is_right(name) && e.as_symbol().is_some());
    if let Some(symbol) = symbol {
        return Some(vec![vec![symbol]]);
    }
    let axis = |word: &str| ["x", "y", "z"].iter().position(|a| *a == word);
    if let Some(r) = axis(stem).or_else(|| axis(stem.strip_prefix('p')?)) {
        return Some(vec![vec![pose.translation.0[r]]]);
    }
    let is_pitch = DIRECTIONS.contains(&stem);
    pitch.filter(|_| is_pitch).map(|e| vec![vec![e]])
}

fn is_turning(joint: Expr, subject: &Subject) -> bool {
    let variables = subject.description.variables();
    variables.iter().any(|v| Expr::from(v.symbol) == joint && v.kind == JointKind::Revolute)
}

/// The joint that a name is for: its own, or one with a word behind its number, `th1s`, `q2_sol`.
fn joint_of(name: &str, lexis: &Lexis, subject: &Subject) -> Option<Expr> {
    let known = |name: &str| lexis.names.lookup(name).filter(|e| subject.joints().contains(e));
    if let Some(index) = name.strip_suffix(']').and_then(|n| n.split_once('[')) {
        let k: usize = index.1.parse().ok()?;
        let joint = subject.joints().get(k).copied()?;
        // Numbered from 1, or as the table itself writes them.
        let is_own = || [k + 1, k].iter().any(|n| known(&format!("{}{n}", index.0)) == Some(joint));
        return (is_vector(index.0) || is_own()).then_some(joint);
    }
    if let Some(joint) = known(name) {
        return Some(joint);
    }
    if lexis.names.lookup(name).is_some() {
        return None;
    }
    let start = name.find(|c: char| c.is_ascii_digit())?;
    let digits = name[start..].chars().take_while(char::is_ascii_digit).count();
    let (own, behind) = name.split_at(start + digits);
    let is_rate = ["d", "dot", "p", "_dot", "_d", "v", "dd"].contains(&behind);
    known(own).filter(|_| behind.len() <= 6 && !is_rate)
}

/// The statements that give joints values, each with all that it gives.
fn joints_in(
    function: &Reading,
    lexis: &Lexis,
    subject: &Subject,
    number: usize,
    places: &Places,
) -> Vec<Assertion> {
    let mut found: Vec<Assertion> = vec![];
    let names = Rc::new(lexis.inverse_names());
    for a in &function.assigned {
        let (Some(of), Value::Scalar(cell)) = (joint_of(&a.name, lexis, subject), &a.value) else { continue };
        let Some(value) = solved(cell.value, places) else { continue };
        let branches = with_named_signs(vec![value]);
        let is_same = |x: &&mut Assertion| x.span == whole(a);
        if let Some(before) = found.iter_mut().find(is_same) {
            if let Some(Spoken::Joint { branches: all, .. }) = &mut before.spoken {
                all.extend(branches.into_iter().filter(|b| !all.contains(b)).collect::<Vec<_>>());
                all.truncate(MAX_VALUES);
            }
            continue;
        }
        let side = match &cell.syntax {
            Some(syntax) => (cell.span.clone(), syntax.clone()),
            None => {
                let span = 0..a.span.len();
                (a.span.clone(), Syntax { kind: SyntaxKind::Name(value), span })
            }
        };
        found.push(Assertion {
            span: whole(a),
            name: a.name.clone(),
            about: About::Joint,
            pieces: vec![],
            remarks: vec![],
            subject: number,
            names: Some(Rc::clone(&names)),
            whole: None,
            reference: None,
            spoken: Some(Spoken::Joint { of, sides: vec![side], branches }),
        });
    }
    found
}

/// The value of a scalar, or the first entry of a matrix.
fn value_of(a: &Assigned) -> Expr {
    match &a.value {
        Value::Scalar(cell) => cell.value,
        Value::Matrix(rows) => rows.iter().flatten().next().map_or(Expr::int(0), |c| c.value),
    }
}

fn whole(a: &Assigned) -> Range<usize> {
    a.span.clone()
}

/// A value of a joint in radians, if it is one: it speaks of the pose, or has an arctangent.
fn solved(value: Expr, places: &Places) -> Option<Expr> {
    let per_radian = Expr::symbol(PER_RADIAN).as_symbol()?;
    let with = |e: Expr, n: i64| e.substitute(|s| (s == per_radian).then(|| Expr::int(n)));
    let mut value = value;
    if value.symbols().contains(&per_radian) {
        let rest = with(value, 0);
        let offset = rest.symbols().is_empty().then_some(rest)?;
        value = with(value, 1) - offset + offset * Expr::pi() / Expr::int(180);
    }
    let value = in_radians(value);
    let symbols = value.symbols();
    let is_entry = |r: usize, c: usize| symbols.contains(&places.symbol(r, c));
    let speaks = (0..3).any(|r| (0..4).any(|c| is_entry(r, c)));
    let turns = Expr::postorder(&[value]).iter().any(|e| matches!(e.node(), Node::Atan2(..)));
    (!symbols.is_empty() && (speaks || turns)).then_some(value)
}

/// What a function computes, the robot's own pose in the place of the one that it is told.
fn at_the_pose(function: &Reading, subject: &Subject, places: &Places) -> Reading {
    let pose = subject.pose().matrix();
    let own = |e: Expr| {
        e.substitute(|s| {
            let mut all = (0..3).flat_map(|r| (0..4).map(move |c| (r, c)));
            all.find(|(r, c)| places.symbol(*r, *c) == s).map(|(r, c)| pose[r][c])
        })
    };
    let cell = |c: &Cell| {
        let value = own(c.value);
        let syntax = c.syntax.clone().filter(|_| value == c.value);
        Cell { value, syntax, span: c.span.clone() }
    };
    let value = |v: &Value| match v {
        Value::Scalar(c) => Value::Scalar(cell(c)),
        Value::Matrix(rows) => Value::Matrix(rows.iter().map(|r| r.iter().map(cell).collect()).collect()),
    };
    let assigned = function.assigned.iter();
    let assigned = assigned.map(|a| Assigned { value: value(&a.value), ..a.clone() }).collect();
    Reading { assigned, returned: vec![], shown: vec![], ..function.clone() }
}
