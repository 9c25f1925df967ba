//! The Jacobian, and where it loses rank.

use super::NoExercise;
use super::chosen::Chosen;
use super::sheet::{Asked, Field, Ground, Task, counted, digits, quantity};
use crate::document::{Block, Factor, Line, Math, Proof, Section};
use crate::explain::velocity_vocabulary;
use crate::render::{named, too_long};
use denavit::description::JointKind;
use denavit::forward::{Proof as Forward, Reference};
use denavit::inverse::JointSpace;
use denavit::robot::Robot;
use denavit::velocity::{JacobianModel, ROWS, Viewpoint, geometric};
use denavit_check::Answer;
use denavit_check::marking::Subject;
use denavit_symbolic::print::{Style, print};
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Angle, Expr};

/// The matrix as a formula and in numbers.
pub(super) fn jacobian(ground: &Ground, chosen: &mut Chosen) -> Result<Asked, NoExercise> {
    let (s, words) = (&ground.setting, ground.words());
    let d = &s.description;
    let robot = Robot::numeric(d).map_err(NoExercise::Values)?;
    let all = chosen.configurations(d, ground.options.count, |_| true)?;
    let names = velocity_vocabulary(d);
    // Along the axes of the base where it fits the page, where it is shortest otherwise.
    let in_base = JacobianModel::derive(d, Viewpoint::tool());
    let model =
        if fits(&in_base, ground) { in_base } else { JacobianModel::shortest_at_origin(d, Reference::Tool) };
    let matrix = model.matrix.as_ref().map_err(|_| NoExercise::Large)?;
    let rows = matrix.rows().to_vec();
    let view = &model.view;
    let place = words.viewpoint(view.body, view.at, None, view.axes);

    let mut answer = Section::new(names.clone());
    answer.paragraph(place.clone());
    let proof = (model.proof == Forward::Proved).then_some(Proof::Proved);
    let whole = Block::Formula { math: Math::Matrix(Factor::named("J"), rows.clone()), number: None, proof };
    if too_long(&Math::Matrix(Factor::named("J"), rows.clone()), &names) {
        return Err(NoExercise::Large);
    }
    answer.push(whole);

    let in_base = Viewpoint::tool();
    let base = words.viewpoint(in_base.body, in_base.at, None, in_base.axes);
    let mut in_numbers = Section::new(names);
    let (mut entries, mut fields) = (0, vec![]);
    for (k, q) in all.iter().enumerate() {
        let shown: Vec<Vec<String>> = geometric(&robot, q, &in_base)
            .rows()
            .iter()
            .map(|row| row.iter().map(|x| digits(*x, 4)).collect())
            .collect();
        entries += shown.iter().flatten().filter(|x| !matches!(x.as_str(), "0" | "1")).count().max(1);
        in_numbers.heading(3, Line::new(words.configuration_title(k + 1)));
        in_numbers.paragraph(ground.configuration(q));
        // What stands right before a matrix says where it holds.
        in_numbers.paragraph(base.clone());
        let shown = Math::Numbers(Factor::named("J"), shown);
        let title = if all.len() > 1 { words.configuration_title(k + 1) } else { String::new() };
        fields.extend(Field::entries(&title, &shown, &ground.names()));
        in_numbers.formula(shown);
    }
    let mut tasks = vec![Task {
        name: words.jacobian_formula(),
        words: Line::new(words.ask_jacobian()),
        points: 6,
        claims: ["J", "J0", "0J", "Jv", "Jw", "j*"].map(String::from).to_vec(),
        formulas: counted(rows.iter().flatten()) + entries,
        fields,
        has_formulas: true,
        answer: vec![answer, in_numbers],
        ..Task::default()
    }];
    let mut section = Section::new(ground.names());
    section.heading(3, Line::new(words.formulas_title()));
    section.paragraph(place);
    let mut given = vec![section];
    given.extend(ground.given(&all));
    let rates = chosen.rates(&JointSpace::new(d, &robot));
    let (asked, twist) = velocities(ground, &robot, &all[0], &rates);
    given.push(asked);
    tasks.push(twist);
    Ok(Asked { given, tasks })
}

/// Whether a matrix can be printed on the page entry by entry.
fn fits(model: &JacobianModel, ground: &Ground) -> bool {
    let Ok(matrix) = &model.matrix else { return false };
    let math = Math::Matrix(Factor::named("J"), matrix.rows().to_vec());
    let whole = Block::Formula { math, number: None, proof: None };
    named(&whole, &ground.names()).is_none()
}

/// The velocity of the tool at the first configuration, with its task.
fn velocities(ground: &Ground, robot: &Robot<f64>, q: &[f64], rates: &[f64]) -> (Section, Task) {
    let (s, words) = (&ground.setting, ground.words());
    let names = velocity_vocabulary(&s.description);
    let line = Line::new(words.rates_given());
    let variables = s.description.variables();
    let rate = |(v, x): (&denavit::description::Variable, &f64)| {
        let unit = if v.kind == JointKind::Revolute { "rad/s" } else { "m/s" };
        Math::Quantity { of: v.symbol.into(), is_rate: true, digits: digits(*x, 4), unit }
    };
    let line = line.numbers(variables.iter().zip(rates).map(rate), words.between());
    let twist = geometric(robot, q, &Viewpoint::tool()).twist(rates);
    let mut section = Section::new(names.clone());
    section.paragraph(ground.configuration(q));
    section.paragraph(line.clone());
    let mut answers = vec![];
    for (name, x) in ROWS.iter().zip(twist).take(3).filter(|(_, x)| x.abs() > 1e-9) {
        let axis = name.trim_start_matches('v');
        let called = ["v", "V", "dot", "dotp", "dp", "d"].map(|l| format!("{l}{axis}"));
        let behind = [format!("{axis}dot"), format!("{axis}p")];
        answers.push(Answer {
            names: called.into_iter().chain(behind).collect(),
            value: digits(x, 4),
            unit: "m/s".into(),
        });
        section.paragraph(Line::default().math(quantity(Expr::symbol(name), x, 4, "m/s")));
    }
    let mut given = Section::new(names);
    given.paragraph(line);
    let task = Task {
        name: words.velocity_title(),
        words: Line::new(words.ask_velocity()),
        points: 2,
        answers,
        has_formulas: false,
        answer: vec![section],
        ..Task::default()
    };
    (given, task)
}

/// The determinant and where it is 0.
pub(super) fn singularities(ground: &Ground, _: &mut Chosen) -> Result<Asked, NoExercise> {
    let (s, words) = (&ground.setting, ground.words());
    let whole = s.singular().as_ref().map_err(|why| NoExercise::Singular(why.clone()))?;
    // An arm whose body is nowhere singular may have a hand whose position is.
    let point = if whole.common.is_empty() { whole.of_its_point(&s.description) } else { None };
    let found = point.as_ref().unwrap_or(whole);
    if found.common.is_empty() {
        return Err(NoExercise::NeverSingular);
    }
    let names = velocity_vocabulary(&s.description);
    let view = &found.jacobian.view;
    let place = words.viewpoint(view.body, view.at, None, view.axes);
    let mut tasks = vec![];
    let mut given = vec![];
    // Of an arm with fewer freedoms the square part of the matrix is no determinant that has a name, but that of positions.
    let is_named = matches!(found.jacobian.view.body, Reference::Tool)
        && found
            .minors
            .first()
            .is_some_and(|m| m.rows.len() == ROWS.len() || m.rows.iter().copied().eq(0..m.rows.len()));
    if let ([whole], true) = (&found.minors[..], is_named) {
        let mut answer = Section::new(names.clone());
        answer.push(Block::Formula {
            math: Math::Determinant(Factor::named("J"), whole.determinant.to_expr()),
            number: None,
            proof: Some(Proof::Proved),
        });
        let mut section = Section::new(names.clone());
        section.paragraph(place);
        given.push(section);
        tasks.push(Task {
            name: words.determinant_title(),
            words: Line::new(words.ask_determinant()),
            points: 4,
            claims: ["det J", "det*", "D"].map(String::from).to_vec(),
            formulas: 1,
            about: vec![Subject::Determinant],
            has_formulas: true,
            answer: vec![answer],
            ..Task::default()
        });
    }
    let mut answer = Section::new(names);
    let (mut formulas, mut zeros) = (0, vec![]);
    let variables = s.description.variables();
    let joint = |e: Expr| variables.iter().position(|v| e.as_symbol() == Some(v.symbol));
    for one in &found.common {
        let (unknown, values) = match one.zeros.first().map(|zero| zero.solved()) {
            Some(solved) if solved.1.iter().all(|value| Angle::of(*value).terms.is_empty()) => solved,
            // A slide that is a factor.
            _ if joint(one.factor).is_some() => (one.factor, vec![Expr::int(0)]),
            _ => {
                answer.paragraph(words.singular_where(Math::equation(one.factor, Expr::int(0))));
                continue;
            }
        };
        for value in values {
            formulas += 1;
            if let Some(k) = joint(unknown).filter(|_| value.symbols().is_empty()) {
                zeros.push((k + 1, print(value, &Vocabulary::new(), Style::Ascii)));
            }
            answer.paragraph(words.singular_where(Math::equation(unknown, value)));
        }
    }
    if formulas == 0 && tasks.is_empty() {
        return Err(NoExercise::NeverSingular);
    }
    tasks.push(Task {
        name: words.singularities_title(),
        words: Line::new(words.ask_singular()),
        points: 4,
        claims: ground.joints(),
        formulas,
        about: vec![Subject::Singularities],
        zeros,
        has_formulas: true,
        answer: vec![answer],
        ..Task::default()
    });
    Ok(Asked { given, tasks })
}
