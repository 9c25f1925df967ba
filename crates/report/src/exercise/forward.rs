//! Forward kinematics, and the table of a drawing.

use super::NoExercise;
use super::chosen::Chosen;
use super::sheet::{Asked, Field, Ground, Task, claimed, counted};
use crate::derivation::{Derivation, matrix, transforms};
use crate::document::{Block, Factor, Line, Math, Part, Section, Table};
use crate::render::{named, too_long};
use crate::sections::{ends, numbers, rows as table_of};
use crate::words::{Column, Heading};
use denavit::description::JointKind;
use denavit::forward::Reference;
use denavit::inverse::JointSpace;
use denavit::mechanism::{Robot, Walk};
use denavit_check::marking::{Form, Subject};
use denavit_symbolic::Expr;
use denavit_symbolic::readable::settled;
use denavit_symbolic::vocabulary::Vocabulary;

/// Link transforms, the pose of the tool as a formula and in numbers.
pub(super) fn poses(ground: &Ground, chosen: &mut Chosen) -> Result<Asked, NoExercise> {
    let (s, words) = (&ground.setting, ground.words());
    let robot = Robot::numeric(&s.description).map_err(NoExercise::Values)?;
    let all = chosen.configurations(&s.description, ground.options.count, |_| true)?;
    let model = Derivation::of(&s.description, s.forward().clone());
    let names = ground.names();

    let mut links = Section::new(names.clone());
    links.push(transforms(&model.links));
    let letters = ["A", "T", "H"];
    let n = model.links.len();
    // Of an arm with one row that is the pose itself.
    let link_claims = if n > 1 { of_links(n, &names) } else { vec![] };

    let [from, to] = model.frames();
    let frame = Factor::Frame { from: from.clone(), to: to.clone() };
    let mut forward = Section::new(names.clone());
    let mut forward_claims = vec![claimed(&Math::Product(vec![frame]), &names)];
    forward_claims.extend(letters.iter().flat_map(|l| [format!("{l}0{n}"), format!("0{l}{n}")]));
    forward_claims.extend(["n*", "o*", "a*", "p*", "t*"].map(String::from));
    let formulas = match &model.model.matrix {
        Ok(rows) if !too_long(&matrix(&from, &to, rows), &names) => {
            let whole = Block::Formula { math: matrix(&from, &to, rows), number: None, proof: None };
            match named(&whole, &names) {
                None => forward.push(whole),
                // A matrix of names says nothing of the robot; its entries do.
                Some(_) => forward.push(Part::Equations(entries(rows))),
            }
            counted(rows[..3].iter().flatten())
        }
        _ => {
            let steps: Vec<_> = model.steps.iter().filter(|s| s.value.as_number().is_none()).collect();
            forward = Section::new(model.names.clone());
            let equation = |s: &&denavit_program::Step| Math::equation(Expr::symbol(&s.name), s.value);
            forward.push(Part::Equations(steps.iter().map(equation).collect()));
            steps.iter().filter(|s| s.is_output).count()
        }
    };

    let mut in_numbers = Section::new(names);
    let (mut entries_in_numbers, mut fields) = (0, vec![]);
    for (k, q) in all.iter().enumerate() {
        let pose = robot.pose(q);
        in_numbers.heading(3, Line::new(words.configuration_title(k + 1)));
        in_numbers.paragraph(ground.configuration(q));
        let shown = numbers(&pose);
        let title = if all.len() > 1 { words.configuration_title(k + 1) } else { String::new() };
        fields.extend(Field::entries(&title, &shown, &ground.names()));
        if let Math::Numbers(_, rows) = &shown {
            let counts = |x: &&String| !matches!(x.as_str(), "0" | "1");
            entries_in_numbers += rows.iter().flatten().filter(counts).count().max(1);
        }
        in_numbers.formula(shown);
    }
    let link_entries = model.links.iter().map(|l| counted(l[..3].iter().flatten())).sum();
    Ok(Asked {
        given: ground.given(&all),
        tasks: vec![
            Task {
                name: words.heading(Heading::Links),
                words: Line::new(words.ask_links()),
                points: 4,
                claims: link_claims,
                formulas: if n > 1 { link_entries } else { 0 },
                about: if n > 1 { vec![Subject::Links] } else { vec![] },
                form: Some(Form::Formulas),
                has_formulas: true,
                answer: vec![links],
                ..Task::default()
            },
            Task {
                name: words.pose_title(),
                words: Line::new(words.ask_pose()),
                points: 4,
                claims: forward_claims,
                formulas,
                about: vec![Subject::Pose],
                form: Some(Form::Formulas),
                has_formulas: true,
                answer: vec![forward],
                ..Task::default()
            },
            Task {
                name: words.numbers_title(),
                words: Line::new(words.ask_numbers(all.len())),
                points: 2 * all.len() as u32,
                claims: ["T", "P", "x", "y", "z"].map(String::from).to_vec(),
                formulas: entries_in_numbers,
                about: vec![Subject::Pose],
                form: Some(Form::Numbers),
                fields,
                has_formulas: false,
                answer: vec![in_numbers],
                ..Task::default()
            },
        ],
    })
}

/// What people call the transforms of so many links.
fn of_links(n: usize, names: &Vocabulary) -> Vec<String> {
    let of_link = |k: usize| {
        let frame = claimed(&Math::Product(vec![link(k)]), names);
        let letters = ["A", "T", "H"].iter();
        let by_letter = letters.flat_map(move |l| [format!("{l}{k}{}", k + 1), format!("{k}{l}{}", k + 1)]);
        [frame, format!("A{}", k + 1)].into_iter().chain(by_letter)
    };
    (0..n).flat_map(of_link).collect()
}

/// The link transforms alone, as formulas and in numbers.
pub(super) fn links(ground: &Ground, chosen: &mut Chosen) -> Result<Asked, NoExercise> {
    let (s, words) = (&ground.setting, ground.words());
    let d = &s.description;
    let robot = Robot::numeric(d).map_err(NoExercise::Values)?;
    let all = chosen.configurations(d, ground.options.count, |_| true)?;
    let names = ground.names();
    let model = Derivation::of(d, s.forward().clone());
    let n = model.links.len();
    let mut answer = Section::new(names.clone());
    answer.push(transforms(&model.links));
    let mut fields = vec![];
    let mut formulas: usize = model.links.iter().map(|l| counted(l[..3].iter().flatten())).sum();
    for (k, q) in all.iter().enumerate() {
        answer.heading(3, Line::new(words.configuration_title(k + 1)));
        answer.paragraph(ground.configuration(q));
        for (j, row) in robot.links.iter().enumerate() {
            let Math::Numbers(_, rows) = numbers(&row.transform(q)) else { continue };
            let counts = |x: &&String| !matches!(x.as_str(), "0" | "1");
            formulas += rows.iter().flatten().filter(counts).count().max(1);
            let shown = Math::Numbers(link(j), rows);
            let title = if all.len() > 1 { words.configuration_title(k + 1) } else { String::new() };
            fields.extend(Field::entries(&title, &shown, &names));
            answer.formula(shown);
        }
    }
    Ok(Asked {
        given: ground.given(&all),
        tasks: vec![Task {
            name: words.heading(Heading::Links),
            words: Line::new(words.ask_transforms()),
            points: 2 * n as u32,
            claims: of_links(n, &names),
            formulas,
            about: vec![Subject::Links],
            fields,
            has_formulas: true,
            answer: vec![answer],
            ..Task::default()
        }],
    })
}

/// The frame of a row in that before it.
fn link(k: usize) -> Factor {
    Factor::Frame { from: k.to_string(), to: (k + 1).to_string() }
}

/// The entries of a pose one by one, without the last row.
fn entries(rows: &[[Expr; 4]; 4]) -> Vec<Math> {
    let letters = ["n", "o", "a", "p"];
    let entry = |c: usize, r: usize| {
        let name = format!("{}{}", letters[c], ["x", "y", "z"][r]);
        Math::equation(Expr::symbol(&name), rows[r][c])
    };
    (0..4).flat_map(|c| (0..3).map(move |r| (c, r))).map(|(c, r)| entry(c, r)).collect()
}

/// The Denavit–Hartenberg table of a drawing: how the axes lie at quarter turns.
pub(super) fn table(ground: &Ground, chosen: &mut Chosen) -> Result<Asked, NoExercise> {
    let (s, words) = (&ground.setting, ground.words());
    let (d, names) = (&s.description, ground.names());
    let robot = Robot::numeric(d).map_err(NoExercise::Values)?;
    let q = chosen.quarters(&JointSpace::new(d, &robot));
    let walk = Walk::seen_from(&Robot::symbolic(d), &q, Reference::Base);
    let vector = |v: [Expr; 3]| {
        let line = Line::new("(").numbers(v.map(|e| Math::Expr(settled(e))), words.between());
        line.text(")")
    };
    let mut rows = vec![];
    for (row, axis) in d.rows.iter().zip(walk.axes()) {
        let Some(variable) = row.variable else { continue };
        let kind = if variable.kind == JointKind::Revolute { "R" } else { "P" };
        rows.push(vec![
            Line::new((rows.len() + 1).to_string()),
            Line::new(kind),
            vector(axis.point.0),
            vector(axis.direction.0),
        ]);
    }
    let mut given = Section::new(names.clone());
    given.heading(2, Line::new(words.axes_title()));
    let values: Vec<f64> = q.iter().map(|x| x.eval(|_| None).unwrap_or_default()).collect();
    given.paragraph(words.axes_lie(ground.configuration(&values)));
    given.push(Part::Table(Table {
        caption: Line::new(words.axes_caption()),
        head: vec![
            Line::default(),
            Line::new(words.column(Column::Joint)),
            Line::new(words.point()),
            Line::new(words.direction()),
        ],
        rows,
    }));
    let tool = walk.place(Reference::Tool).matrix().into_iter().map(|row| row.map(settled).to_vec());
    given.paragraph(Line::new(words.tool_there()));
    given.formula(Math::Matrix(Factor::named("T"), tool.collect()));
    let mut answer = Section::new(names);
    table_of(s, d, &mut answer);
    ends(s, d, &mut answer);
    Ok(Asked {
        given: vec![given],
        tasks: vec![Task {
            name: words.heading(Heading::Table),
            words: Line::new(words.ask_table(d.convention)),
            points: 2 * d.rows.len() as u32,
            claims: vec!["table".into(), "table*".into()],
            formulas: 1,
            has_formulas: true,
            answer: vec![answer],
            ..Task::default()
        }],
    })
}
