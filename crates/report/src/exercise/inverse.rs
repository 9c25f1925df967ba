//! All configurations for a pose.

use super::NoExercise;
use super::chosen::Chosen;
use super::sheet::{Asked, Field, Ground, Task, claimed, quantity};
use crate::document::{Block, Line, Math, Proof, Section, Sign};
use crate::explain::{Explained, Explanation, Statement, uses_letters};
use crate::render::too_long;
use crate::sections::{numbers, within_turns};
use crate::words::ExerciseKind;
use denavit::description::JointKind;
use denavit::geometry::{Rotation, Transform, Vector};
use denavit::inverse::{Goal, InverseKinematics, InverseModel, InverseOptions, Solution};
use denavit::velocity::{Viewpoint, geometric, measures};
use denavit_check::marking::{Asked as Configuration, Subject};
use denavit_symbolic::readable::settled;
use denavit_symbolic::{Expr, Symbol};
use std::cmp::Ordering;
use std::f64::consts::TAU;

/// A pose with more configurations is not asked for.
const MOST: usize = 16;

/// Half a unit of the last digit of the numbers that are given, metres, and in the entries of a rotation, radians.
const HALF: f64 = 5e-5;
/// No pose is asked for at which that moves a joint by more, radians and metres.
const SURE: f64 = 0.02;

/// A pose with all its configurations.
struct Solved {
    pose: Transform<f64>,
    solutions: Vec<Solution>,
    /// How far the digits that are given let the joints of each be off.
    within: Vec<Vec<f64>>,
}

/// The joints for poses: the formulas where there is a closed form, and all configurations in numbers.
pub(super) fn configurations(ground: &Ground, chosen: &mut Chosen) -> Result<Asked, NoExercise> {
    solved(ground, chosen, Goal::Pose)
}

/// The joints for positions of the tool.
pub(super) fn positions(ground: &Ground, chosen: &mut Chosen) -> Result<Asked, NoExercise> {
    solved(ground, chosen, Goal::Position)
}

fn solved(ground: &Ground, chosen: &mut Chosen, goal: Goal) -> Result<Asked, NoExercise> {
    let (s, words) = (&ground.setting, ground.words());
    let is_pose = goal == Goal::Pose;
    let solver = InverseKinematics::new(&s.description, &InverseOptions { goal, given: None });
    let solver = solver.map_err(NoExercise::Unprepared)?;
    if !solver.given.is_empty() {
        return Err(NoExercise::Redundant);
    }
    let mut found: Vec<Solved> = vec![];
    let mut is_endless = false;
    // All configurations are known, each by itself, and the pose has been met.
    let all = chosen.configurations(&s.description, ground.options.count, |q| {
        let pose = solver.robot.pose(q);
        let answer = solver.solve(&pose, &[]);
        let single = answer.solutions.iter().all(|f| f.multiplicity == 1 && f.residual < 1e-7);
        is_endless |= !answer.families.is_empty();
        let serves = answer.is_complete()
            && answer.families.is_empty()
            && (1..=MOST).contains(&answer.solutions.len())
            && single;
        let within = if serves { within(&solver, &pose, &answer.solutions) } else { None };
        let Some(within) = within else { return false };
        let turned = answer.solutions.into_iter().map(|f| within_turns(f, &solver.space));
        found.push(Solved { pose, solutions: turned.collect(), within });
        true
    });
    let leaves_free = || {
        let model = InverseModel::derive(&s.description, &InverseOptions { goal, given: None });
        model.is_ok_and(|model| !model.given.is_empty())
    };
    is_endless = is_endless || (found.is_empty() && leaves_free());
    let all = all.map_err(|why| if found.is_empty() && is_endless { NoExercise::Redundant } else { why })?;

    let mut given = Section::new(ground.names());
    let mut answers = formulas(ground, goal);
    let mut in_numbers = Section::new(ground.names());
    for (k, one) in found.iter().enumerate() {
        let titles = match is_pose {
            true => [words.given_pose_title(k + 1), words.solved_pose_title(k + 1)],
            false => [words.given_position_title(k + 1), words.solved_position_title(k + 1)],
        };
        for (section, title) in [&mut given, &mut in_numbers].into_iter().zip(titles) {
            section.heading(3, Line::new(title));
            if is_pose {
                section.formula(numbers(&one.pose));
                continue;
            }
            let coordinates = one.pose.translation.0.iter().zip(["px", "py", "pz"]);
            let coordinates = coordinates.map(|(x, name)| quantity(Expr::symbol(name), *x, 4, "m"));
            section.paragraph(Line::new(words.position_given()).numbers(coordinates, words.between()));
        }
        for (j, f) in one.solutions.iter().enumerate() {
            let mut line = Line::new(words.numbered_solution(j + 1));
            line.0.extend(ground.configuration(&f.q).0);
            in_numbers.paragraph(line);
        }
        let (count, families) = (one.solutions.len(), 0);
        in_numbers.paragraph(Line::new(words.found(count, families, true)));
    }
    answers.push(in_numbers);
    let fields = fields(ground, &found);
    let joints: usize = found.iter().map(|one| one.solutions.len()).sum::<usize>() * all[0].len();
    Ok(Asked {
        given: vec![given],
        tasks: vec![Task {
            name: match is_pose {
                true => words.configurations_title(),
                false => words.positions_title(),
            },
            words: Line::new(match is_pose {
                true => words.ask_configurations(all.len()),
                false => words.ask_positions(all.len()),
            }),
            points: 10,
            claims: ground.joints(),
            formulas: joints,
            about: vec![Subject::Joints],
            configurations: found
                .iter()
                .flat_map(|one| one.solutions.iter().zip(&one.within))
                .map(|(f, within)| Configuration { q: f.q.clone(), within: within.clone() })
                .collect(),
            fields,
            has_formulas: true,
            answer: answers,
            ..Task::default()
        }],
    })
}

/// How many configurations there are, and the joints of that with the largest first joint, of several such the largest second.
fn fields(ground: &Ground, found: &[Solved]) -> Vec<Field> {
    let words = ground.words();
    let is_pose = ground.options.kind == ExerciseKind::Inverse;
    let mut fields = vec![];
    for (k, one) in found.iter().enumerate() {
        let (pose, position) = (words.given_pose_title(k + 1), words.given_position_title(k + 1));
        let title = words.largest_of(if is_pose { &pose } else { &position });
        let field = |label: String, value: f64, unit: &str, within: f64| Field {
            group: title.clone(),
            label,
            value,
            unit: unit.into(),
            within,
        };
        fields.push(field("N".into(), one.solutions.len() as f64, "", 0.0));
        // What is equal but for rounding is equal.
        let rounded = |q: &[f64]| q.iter().map(|x| (x * 1e6).round()).collect::<Vec<f64>>();
        let last = one
            .solutions
            .iter()
            .zip(&one.within)
            .max_by(|a, b| rounded(&a.0.q).partial_cmp(&rounded(&b.0.q)).unwrap_or(Ordering::Equal));
        let Some((last, within)) = last else { continue };
        for ((x, within), v) in last.q.iter().zip(within).zip(ground.setting.description.variables()) {
            let label = claimed(&Math::Expr(v.symbol.into()), &ground.names());
            fields.push(match v.kind {
                JointKind::Revolute => field(label, x.to_degrees(), "°", within.to_degrees()),
                JointKind::Prismatic => field(label, *x, "m", *within),
            });
        }
    }
    fields
}

/// How far the digits that are given let the joints of each solution be off; nothing where that is far, or where it decides
/// how many solutions there are.
fn within(
    solver: &InverseKinematics,
    pose: &Transform<f64>,
    solutions: &[Solution],
) -> Option<Vec<Vec<f64>>> {
    let all = match solver.goal {
        Goal::Position => {
            solutions.iter().map(|f| of_position(solver, pose, solutions.len(), &f.q)).collect()
        }
        _ => solutions.iter().map(|f| of_pose(solver, &f.q)).collect::<Option<Vec<Vec<f64>>>>(),
    };
    all.filter(|all| all.iter().flatten().all(|x| *x < SURE))
}

/// The sum of what half a unit of each coordinate does to the joints of a solution.
fn of_position(
    solver: &InverseKinematics,
    pose: &Transform<f64>,
    count: usize,
    q: &[f64],
) -> Option<Vec<f64>> {
    let off = |other: &[f64]| -> Vec<f64> {
        let joints = q.iter().zip(other).zip(&solver.space.is_angle);
        let one = |((a, b), is_angle): ((&f64, &f64), &bool)| match is_angle {
            true => (b - a) - TAU * ((b - a) / TAU).round(),
            false => b - a,
        };
        joints.map(one).map(f64::abs).collect()
    };
    let mut sum = vec![0.0; q.len()];
    for axis in 0..3 {
        let mut most = vec![0.0; q.len()];
        for sign in [-1.0, 1.0] {
            let mut moved = *pose;
            moved.translation.0[axis] += sign * HALF;
            let answer = solver.solve(&moved, &[]);
            // In a plane there is no other way.
            if answer.solutions.is_empty() {
                continue;
            }
            if answer.solutions.len() != count {
                return None;
            }
            let total = |x: &Vec<f64>| x.iter().sum::<f64>();
            let all = answer.solutions.iter().map(|f| off(&f.q));
            let nearest = all.min_by(|a, b| total(a).total_cmp(&total(b)))?;
            most.iter_mut().zip(nearest).for_each(|(m, x)| *m = f64::max(*m, x));
        }
        sum.iter_mut().zip(most).for_each(|(s, m)| *s += m);
    }
    Some(sum)
}

/// What half a unit of each entry of a pose does at most, by the smallest singular value there.
fn of_pose(solver: &InverseKinematics, q: &[f64]) -> Option<Vec<f64>> {
    let length = solver.robot.reach().max(1e-9);
    let jacobian = geometric(&solver.robot, q, &Viewpoint::tool());
    let values = measures(&jacobian, &solver.space.is_angle, length).whole.singular_values;
    let least = *values.get(q.len().checked_sub(1)?)?;
    // Of each column of a rotation, and of the position in lengths of the arm.
    let off = HALF * 3.0_f64.sqrt() * f64::hypot(2.0_f64.sqrt(), 1.0 / length) / least;
    let joint = |is_angle: &bool| if *is_angle { off } else { off * length };
    off.is_finite().then(|| solver.space.is_angle.iter().map(joint).collect())
}

/// The closed form, where there is one that is proved: the equations of each step with their solution.
fn formulas(ground: &Ground, goal: Goal) -> Vec<Section> {
    let (s, words) = (&ground.setting, ground.words());
    let derived = (goal != Goal::Pose)
        .then(|| InverseModel::derive(&s.description, &InverseOptions { goal, given: None }));
    let Ok(model) = derived.as_ref().unwrap_or_else(|| s.inverse()) else { return vec![] };
    let explanation = Explanation::of(model);
    if explanation.proof() != Proof::Proved {
        return vec![];
    }
    let mut section = Section::new(explanation.names());
    section.heading(3, Line::new(words.formulas_title()));
    // What the formulas say of the pose without the robot's base and tool they say of the pose itself.
    let names: [Expr; 12] = explanation.pose;
    let pose = Transform {
        rotation: Rotation::from_rows([0, 1, 2].map(|r| [0, 1, 2].map(|c| names[4 * r + c]))),
        translation: Vector([3, 7, 11].map(|k| names[k])),
    };
    let own =
        (model.chain.base.inverse() * pose * model.chain.tool.inverse()).matrix().map(|row| row.map(settled));
    let of_pose = |x: Symbol| {
        let k = names.iter().position(|name| name.as_symbol() == Some(x))?;
        Some(own[k / 4][k % 4])
    };
    let signs: Vec<Math> = explanation
        .steps
        .iter()
        .filter_map(|step| Some(Math::relation(step.sign?, Sign::EitherSign, Expr::int(1))))
        .collect();
    if !signs.is_empty() {
        section.paragraph(Line::default().list(signs));
    }
    let mut written: Vec<String> = vec![];
    for statement in explanation.steps.iter().flat_map(shown).chain(&explanation.joints) {
        let Some(math) = put(&statement.math, &of_pose) else { continue };
        // Two steps may start from the same equations.
        let text = claimed(&math, &section.names);
        if !too_long(&math, &section.names) && !written.contains(&text) {
            written.push(text);
            section.push(Block::Formula { math, number: None, proof: statement.proof });
        }
    }
    vec![section]
}

/// A relation with other things in the places of its symbols; nothing of what is no relation.
fn put(math: &Math, leaf: &impl Fn(Symbol) -> Option<Expr>) -> Option<Math> {
    let Math::Chain(first, rest) = math else { return None };
    let rest = rest.iter().map(|(sign, e)| (*sign, e.substitute(leaf)));
    Some(Math::Chain(first.substitute(leaf), rest.collect()))
}

/// What is shown of a step: the names, its equations, and what they are solved to, down to the joint.
fn shown(step: &Explained) -> impl Iterator<Item = &Statement> {
    let is_lettered = step.solution.iter().any(|s| uses_letters(s, step));
    let letters = step.coefficients.iter().filter(move |_| is_lettered);
    let equations = step.sources.iter().flat_map(|source| &source.equations);
    step.names.iter().chain(equations).chain(letters).chain(&step.solution)
}
