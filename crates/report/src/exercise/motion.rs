//! The equations of motion of an arm with few joints and masses.

use super::NoExercise;
use super::chosen::Chosen;
use super::sheet::{Asked, Ground, Task, counted, digits};
use super::statics::{claims, in_numbers_task, name, of_joint};
use crate::document::{Block, Factor, Line, Math, Proof, Section};
use crate::render::too_long;
use denavit::description::{Convention, Description, JointKind, Parameter};
use denavit::dynamics::{DynamicModel, Dynamics, Ground as Rests, inverse_dynamics};
use denavit::forward::Reference;
use denavit::mechanism::{Robot, Walk};
use denavit_symbolic::readable::settled;
use denavit_symbolic::{Expr, Symbol};

/// The most joints of such an arm.
const MOST: usize = 3;

/// The robot with a mass at the end of each link where it has none, and gravity down the drawing of a planar arm.
///
/// # Errors
/// If it has too many joints, or its frames are not at the ends of its links.
pub(super) fn weighted(description: &Description) -> Result<Description, NoExercise> {
    let mut d = description.clone();
    if d.variables().len() > MOST {
        return Err(NoExercise::ManyJoints);
    }
    if d.has_masses() {
        return Ok(d);
    }
    // Rows before the first joint are the base's; one behind a joint puts the link's end elsewhere than its frame.
    let first = d.rows.iter().position(|row| row.variable.is_some()).unwrap_or(0);
    let links = &mut d.rows[first..];
    if d.convention != Convention::Standard || links.iter().any(|row| row.variable.is_none()) {
        return Err(NoExercise::Masses);
    }
    for (k, row) in links.iter_mut().enumerate() {
        let symbol = Symbol::new(&format!("m{}", k + 1));
        row.mass = Some(symbol.into());
        d.parameters.push(Parameter { symbol, value: None });
    }
    if d.gravity.is_none() && is_planar(&d) {
        let g = Expr::from(denavit_symbolic::Rational::new(981, 100));
        d.gravity = Some([Expr::int(0), -g, Expr::int(0)]);
    }
    Ok(d)
}

/// Whether all axes are along z of the base, and turn.
fn is_planar(d: &Description) -> bool {
    let q: Vec<Expr> = d.variables().iter().map(|v| v.symbol.into()).collect();
    let walk = Walk::seen_from(&Robot::symbolic(d), &q, Reference::Base);
    let is_along = |v: [Expr; 3]| settled(v[0]).is_zero() && settled(v[1]).is_zero();
    d.variables().iter().all(|v| v.kind == JointKind::Revolute)
        && walk.axes().iter().all(|axis| is_along(axis.direction.0))
}

/// Inertia matrix, velocity torques, gravity, the torques as formulas and in numbers.
pub(super) fn equations(ground: &Ground, chosen: &mut Chosen) -> Result<Asked, NoExercise> {
    let (s, words) = (&ground.setting, ground.words());
    let d = &s.description;
    let arm = Dynamics::numeric(d).map_err(|_| NoExercise::Masses)?;
    let robot = denavit::robot::Robot::numeric(d).map_err(NoExercise::Values)?;
    let space = denavit::inverse::JointSpace::new(d, &robot);
    let model = DynamicModel::derive(d);
    let parts = model.parts.as_ref().filter(|p| p.ground == Rests::Proved).ok_or(NoExercise::Large)?;
    let joints = space.is_angle.len();

    // Of base parameters, what they are in masses and lengths.
    let base = |x: Symbol| model.base.parameters.iter().find(|p| p.symbol == x).map(|p| p.value);
    let own = |e: &Expr| settled(e.substitute(base));
    let inertia: Vec<Vec<Expr>> = parts.inertia.iter().map(|row| row.iter().map(own).collect()).collect();
    let velocity: Vec<Expr> = parts.velocity.iter().map(own).collect();
    let gravity: Vec<Expr> = parts.gravity.iter().map(own).collect();
    let names = crate::explain::dynamics_vocabulary(d, &model);
    let names = (1..=joints).fold(names, |names, j| names.symbol(&format!("tau{j}")));

    let column = |all: &[Expr]| all.iter().map(|e| vec![*e]).collect::<Vec<_>>();
    let mut of_parts = Section::new(names.clone());
    for (step, letter, rows) in [
        (words.inertia_step(), "M", inertia.clone()),
        (words.velocity_torques_step(), "V", column(&velocity)),
        (words.gravity_step(), "G", column(&gravity)),
    ] {
        let math = Math::Matrix(Factor::named(letter), rows);
        if too_long(&math, &names) {
            return Err(NoExercise::Large);
        }
        of_parts.paragraph(Line::new(step));
        of_parts.push(Block::Formula { math, number: None, proof: Some(Proof::Proved) });
    }
    let mut formulas = Section::new(names.clone());
    formulas.paragraph(Line::new(words.motion_step()));
    for j in 0..joints {
        let accelerated = model.formulas.qdd.iter().zip(&inertia[j]);
        let accelerated = accelerated.fold(Expr::int(0), |sum, (qdd, m)| sum + *m * Expr::from(*qdd));
        let math = Math::equation(name(j), accelerated + velocity[j] + gravity[j]);
        if too_long(&math, &names) {
            return Err(NoExercise::Large);
        }
        formulas.push(Block::Formula { math, number: None, proof: Some(Proof::Proved) });
    }

    let all = chosen.configurations(d, ground.options.count, |_| true)?;
    let (rates, accelerations) = (chosen.rates(&space), chosen.rates(&space));
    let moving = |symbols: &[Symbol], values: &[f64], power: &str| {
        let value = |(k, (s, x)): (usize, (&Symbol, &f64))| Math::Quantity {
            of: (*s).into(),
            is_rate: false,
            digits: digits(*x, 4),
            unit: match (space.is_angle[k], power) {
                (true, "") => "rad/s",
                (true, _) => "rad/s²",
                (false, "") => "m/s",
                (false, _) => "m/s²",
            },
        };
        symbols.iter().zip(values).enumerate().map(value).collect::<Vec<_>>()
    };
    let mut section = Section::new(names.clone());
    if are_points(ground) {
        section.paragraph(Line::new(words.point_masses()));
    }
    let [x, y, z] = model.formulas.dynamics.gravity.0.map(Math::Expr);
    section.paragraph(words.gravity_in_base([x, y, z]));
    let (qd, qdd) = (&model.formulas.qd, &model.formulas.qdd);
    let states = [
        Line::new(words.rates_given()).numbers(moving(qd, &rates, ""), words.between()).text("."),
        Line::new(words.accelerations_given())
            .numbers(moving(qdd, &accelerations, "2"), words.between())
            .text("."),
    ];
    section.parts.extend(states.iter().cloned().map(|line| Block::Paragraph(line).into()));
    let mut given = vec![section];
    given.extend(ground.given(&all));
    let (mut in_numbers, mut answers) = (Section::new(names), vec![]);
    for (k, q) in all.iter().enumerate() {
        in_numbers.heading(3, Line::new(words.configuration_title(k + 1)));
        for (j, value) in inverse_dynamics(&arm, q, &rates, &accelerations, None).into_iter().enumerate() {
            let unit = if space.is_angle[j] { "N m" } else { "N" };
            in_numbers.paragraph(Line::default().math(super::sheet::quantity(name(j), value, 4, unit)));
            answers.push(of_joint(j, value, space.is_angle[j]));
        }
    }
    let whole = inertia.iter().flatten().chain(&velocity).chain(&gravity);
    Ok(Asked {
        given,
        tasks: vec![
            Task {
                name: words.motion_parts_title(),
                words: Line::new(words.ask_motion_parts()),
                points: 3 * joints as u32,
                claims: ["M", "A", "D", "H", "B", "V", "h", "C", "c", "G", "g", "Q"]
                    .map(String::from)
                    .to_vec(),
                formulas: counted(whole),
                has_formulas: true,
                answer: vec![of_parts],
                ..Task::default()
            },
            Task {
                name: words.torque_formulas_title(),
                words: Line::new(words.ask_motion()),
                points: 2 * joints as u32,
                claims: claims(d.variables().iter().map(|v| v.kind)),
                formulas: joints,
                has_formulas: true,
                answer: vec![formulas],
                ..Task::default()
            },
            in_numbers_task(ground, all.len(), answers, in_numbers),
        ],
    })
}

/// Whether the masses are points at the origins of the frames.
fn are_points(ground: &Ground) -> bool {
    let rows = &ground.setting.description.rows;
    !rows.iter().any(|r| {
        r.com.is_some() || r.inertia.is_some() || r.first_moment.is_some() || r.inertia_at_origin.is_some()
    })
}
