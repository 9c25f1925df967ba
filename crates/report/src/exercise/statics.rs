//! Torques of the joints for a force of the tool: τ = Jᵀ F.

use super::NoExercise;
use super::chosen::Chosen;
use super::sheet::{Asked, Ground, Task, digits, quantity};
use crate::document::{Block, Factor, Line, Math, Section};
use crate::product::times;
use crate::render::{named, too_long};
use denavit::description::JointKind;
use denavit::inverse::JointSpace;
use denavit::robot::Robot;
use denavit::velocity::{JacobianModel, Viewpoint, geometric};
use denavit_check::Answer;
use denavit_symbolic::Expr;

/// The components of the force.
const FORCE: [&str; 3] = ["F_x", "F_y", "F_z"];

/// The torques as formulas and in numbers.
pub(super) fn torques(ground: &Ground, chosen: &mut Chosen) -> Result<Asked, NoExercise> {
    let (s, words) = (&ground.setting, ground.words());
    let d = &s.description;
    let robot = Robot::numeric(d).map_err(NoExercise::Values)?;
    let space = JointSpace::new(d, &robot);
    let all = chosen.configurations(d, ground.options.count, |_| true)?;
    let model = JacobianModel::derive(d, Viewpoint::tool());
    let matrix = model.matrix.as_ref().map_err(|_| NoExercise::Large)?;
    let rows: Vec<Vec<Expr>> = matrix.rows()[..3].to_vec();
    // A component that no joint feels is not there.
    let felt: Vec<usize> = (0..3).filter(|&r| rows[r].iter().any(|e| !e.is_zero())).collect();
    let joints = d.variables().len();
    let torque =
        |j: usize| felt.iter().fold(Expr::int(0), |sum, &r| sum + times(Expr::symbol(FORCE[r]), rows[r][j]));
    let names = felt.iter().fold(ground.names(), |names, &r| names.symbol(FORCE[r]));
    let names = (1..=joints).fold(names, |names, j| names.symbol(&format!("tau{j}")));

    let mut answer = Section::new(names.clone());
    answer.paragraph(Line::new(words.statics_step()));
    let jacobian = Math::Matrix(Factor::Indexed("J", 'v'), rows.clone());
    // A matrix of names says nothing; the torques do.
    let whole = Block::Formula { math: jacobian, number: None, proof: None };
    if named(&whole, &names).is_none() {
        answer.push(whole);
    }
    for j in 0..joints {
        let math = Math::equation(name(j), torque(j));
        if too_long(&math, &names) {
            return Err(NoExercise::Large);
        }
        answer.push(Block::Formula { math, number: None, proof: None });
    }

    let force: Vec<f64> = felt.iter().map(|_| chosen.force()).collect();
    let components = || felt.iter().zip(&force).map(|(&r, x)| quantity(Expr::symbol(FORCE[r]), *x, 2, "N"));
    let mut section = Section::new(names.clone());
    section.paragraph(Line::new(words.force_given()).numbers(components(), words.between()).text("."));
    let mut given = vec![section];
    given.extend(ground.given(&all));
    let (mut in_numbers, mut answers) = (Section::new(names), vec![]);
    for (k, q) in all.iter().enumerate() {
        in_numbers.heading(3, Line::new(words.configuration_title(k + 1)));
        in_numbers.paragraph(ground.configuration(q));
        in_numbers.paragraph(Line::default().numbers(components(), words.between()));
        let columns = geometric(&robot, q, &Viewpoint::tool());
        let rows = columns.rows();
        for (j, &turns) in space.is_angle.iter().enumerate() {
            let value: f64 = felt.iter().zip(&force).map(|(&r, f)| rows[r][j] * f).sum();
            in_numbers.paragraph(Line::default().math(quantity(name(j), value, 4, unit(turns))));
            answers.push(of_joint(j, value, turns));
        }
    }
    let letters = felt.iter().map(|&r| Math::Expr(Expr::symbol(FORCE[r]))).collect();
    Ok(Asked {
        given,
        tasks: vec![
            Task {
                name: words.torque_formulas_title(),
                words: words.ask_statics(letters),
                points: 2 * joints as u32,
                claims: claims(d.variables().iter().map(|v| v.kind)),
                // A torque that is 0 says nothing.
                formulas: (0..joints).filter(|&j| !torque(j).is_zero()).count(),
                has_formulas: true,
                answer: vec![answer],
                ..Task::default()
            },
            in_numbers_task(ground, all.len(), answers, in_numbers),
        ],
    })
}

/// The task to give these torques in numbers, a point each.
pub(super) fn in_numbers_task(
    ground: &Ground,
    configurations: usize,
    answers: Vec<Answer>,
    solution: Section,
) -> Task {
    let words = ground.words();
    Task {
        name: words.torque_numbers_title(),
        words: Line::new(words.ask_torque_numbers(configurations)),
        points: answers.len() as u32,
        answers,
        has_formulas: false,
        answer: vec![solution],
        ..Task::default()
    }
}

/// What the torque of a joint is called.
pub(super) fn name(j: usize) -> Expr {
    Expr::symbol(&format!("tau{}", j + 1))
}

fn unit(turns: bool) -> &'static str {
    if turns { "N m" } else { "N" }
}

/// The torque of a joint in numbers.
pub(super) fn of_joint(j: usize, value: f64, turns: bool) -> Answer {
    let j = j + 1;
    let mut names: Vec<String> =
        ["tau", "Gamma", "M", "C", "T", "u", "Q"].iter().map(|letter| format!("{letter}{j}")).collect();
    if !turns {
        names.extend(["f", "F"].map(|letter| format!("{letter}{j}")));
    }
    Answer { names, value: digits(value, 4), unit: unit(turns).to_string() }
}

/// What people call torques, and forces of slides.
pub(super) fn claims(kinds: impl Iterator<Item = JointKind>) -> Vec<String> {
    let kinds: Vec<JointKind> = kinds.collect();
    let forces = (1..).zip(&kinds).filter(|(_, kind)| **kind == JointKind::Prismatic);
    let forces = forces.flat_map(|(j, _)| [format!("f{j}"), format!("F{j}")]);
    let torques = (1..=kinds.len()).flat_map(|j| ["M", "C", "T", "u", "Q"].map(|l| format!("{l}{j}")));
    ["tau*", "Gamma*"].map(String::from).into_iter().chain(torques).chain(forces).collect()
}
