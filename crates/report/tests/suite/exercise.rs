//! Exercise sheets: their solutions fed back to the check are right line by line and earn all points.

use denavit::catalogue;
use denavit::description::Description;
use denavit_check::{CheckOptions, Checked, Finding, Standing, check};
use denavit_reading::document::Format;
use denavit_report::words::Tongue;
use denavit_report::{Exercise, ExerciseKind, ExerciseOptions, NoExercise, exercise, render};

/// Planar arms, slides, three conventions, offsets, a wrist, lengths without names, a tool.
const ROBOTS: [&str; 8] = [
    "planar-2r",
    "planar-3r",
    "scara",
    "cylindrical-rpp",
    "spherical-rrp",
    "puma560",
    "stanford",
    "staubli-rx90",
];

fn robot(name: &str) -> Description {
    catalogue::robot(name).expect("in the catalogue")
}

fn made(name: &str, kind: ExerciseKind, seed: u64) -> Result<Exercise, NoExercise> {
    made_in(Tongue::English, name, kind, seed)
}

fn made_in(language: Tongue, name: &str, kind: ExerciseKind, seed: u64) -> Result<Exercise, NoExercise> {
    exercise(&robot(name), &ExerciseOptions { kind, seed, count: 1, language })
}

fn judged(text: &str, format: Format, of: &Description) -> Checked {
    check(text, format, Some(of), &CheckOptions::default())
        .unwrap_or_else(|errors| panic!("{errors:?}\n{text}"))
}

/// What an answer earns.
pub struct Earned {
    pub points: f64,
    /// What a teacher decides on.
    pub open: f64,
    /// Whether something is called wrong, and with its slip.
    pub accused: bool,
    pub named: bool,
}

pub fn earned(e: &Exercise, text: &str, format: Format) -> Earned {
    let mut checked = judged(text, format, &e.robot);
    e.rubric.answer(text, format, &mut checked);
    let sheet = e.rubric.mark(text, &checked);
    let entries = checked.claims.iter().flat_map(|c| &c.entries);
    let wrong: Vec<bool> = entries
        .filter_map(|entry| match &entry.finding {
            Finding::Wrong(wrong) => Some(wrong.slip.is_some()),
            _ => None,
        })
        .chain(checked.answered.iter().filter(|a| a.slip.is_some()).map(|_| true))
        .collect();
    Earned {
        points: sheet.points(),
        open: sheet.open(),
        accused: !wrong.is_empty(),
        named: wrong.contains(&true),
    }
}

/// What is not right of a solution.
fn faults(e: &Exercise, text: &str, format: Format, of: &Description) -> Vec<String> {
    let mut checked = judged(text, format, of);
    e.rubric.answer(text, format, &mut checked);
    let open = checked.claims.iter().filter(|c| c.standing() != Standing::Equal);
    let mut faults: Vec<String> =
        open.map(|c| format!("{:?} {}: {}", c.standing(), c.name, &text[c.span.clone()])).collect();
    let wrong = checked.answered.iter().filter_map(|a| Some((a.slip?, &a.name, &a.right)));
    faults.extend(wrong.map(|(slip, name, right)| format!("{name}: {slip:?}, right is {right}")));
    faults.extend(checked.unjudged.iter().map(|u| format!("not judged: {}", &text[u.span.clone()])));
    for (mark, item) in e.rubric.mark(text, &checked).marks.iter().zip(&e.rubric.items) {
        if mark.points < item.points {
            faults
                .push(format!("{}: {} of {} points, {:?}", item.name, mark.points, item.points, mark.right));
        }
    }
    faults
}

#[test]
fn solutions_are_proved_and_earn_all_points() {
    let mut made_of = [0; 10];
    let mut found = vec![];
    for name in ROBOTS {
        for (k, kind) in ExerciseKind::ALL.into_iter().enumerate() {
            let e = match made(name, kind, 3) {
                Ok(e) => e,
                // Slides alone are never singular in the form of an angle; positions leave joints free; torques are for three joints,
                // and what a page holds.
                Err(NoExercise::NeverSingular | NoExercise::Singular(_)) => continue,
                Err(
                    NoExercise::Redundant | NoExercise::ManyJoints | NoExercise::Masses | NoExercise::Large,
                ) => continue,
                Err(why) => {
                    found.push(format!("{name}, {kind:?}: {why}"));
                    continue;
                }
            };
            made_of[k] += 1;
            let markdown = render::markdown(&e.solution, "figures").text;
            let faults = faults(&e, &markdown, Format::Markdown, &e.robot);
            found.extend(faults.into_iter().map(|f| format!("{name}, {kind:?}: {f}")));
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
    assert!(made_of.iter().all(|n| *n >= 3), "{made_of:?}");
}

/// In every language, with its decimal sign, the same solutions are right, in LaTeX and Typst, too.
#[test]
fn solutions_in_every_language_earn_all_points() {
    let mut found = vec![];
    for (name, kind) in [
        ("planar-3r", ExerciseKind::Forward),
        ("scara", ExerciseKind::Table),
        ("spherical-rrp", ExerciseKind::Inverse),
        ("scara", ExerciseKind::Jacobian),
        ("planar-2r", ExerciseKind::Singularities),
        ("cylindrical-rpp", ExerciseKind::Transforms),
        ("planar-2r", ExerciseKind::Position),
        ("scara", ExerciseKind::Statics),
        ("planar-2r", ExerciseKind::Torques),
        ("spherical-rrp", ExerciseKind::Path),
    ] {
        for language in Tongue::ALL {
            let e = made_in(language, name, kind, 3).unwrap_or_else(|why| panic!("{name}, {kind:?}: {why}"));
            let markdown = render::markdown(&e.solution, "figures").text;
            let has_comma = language.words().has_decimal_comma();
            let decimals = |sign: &str| (0..10).any(|n| markdown.contains(&format!("{sign}{n}")));
            assert!(!has_comma || !decimals("."), "{name}, {kind:?}, {language:?}: a point in {markdown}");
            let mut texts = vec![(markdown.clone(), Format::Markdown)];
            // Tables of LaTeX are none that is read.
            if kind != ExerciseKind::Table {
                texts.push((render::latex_fragment(&e.solution), Format::Latex));
            }
            for (text, format) in texts {
                let faults = faults(&e, &text, format, &e.robot);
                found.extend(
                    faults.into_iter().map(|f| format!("{name}, {kind:?}, {language:?}, {format:?}: {f}")),
                );
            }
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

/// Held against the robot of the catalogue, too, and as LaTeX, whose tables are none that is read.
#[test]
fn the_robot_itself_serves_as_well() {
    for (name, kind) in [
        ("planar-3r", ExerciseKind::Forward),
        ("cylindrical-rpp", ExerciseKind::Jacobian),
        ("ur5", ExerciseKind::Table),
    ] {
        let e = made(name, kind, 11).expect("it can be made");
        let (text, format) = match kind {
            ExerciseKind::Table => (render::markdown(&e.solution, "figures").text, Format::Markdown),
            _ => (render::latex_fragment(&e.solution), Format::Latex),
        };
        assert_eq!(faults(&e, &text, format, &robot(name)), [""; 0], "{name}, {kind:?}");
    }
}

#[test]
fn the_same_seed_makes_the_same_sheet() {
    let text = |seed| {
        let e = made("puma560", ExerciseKind::Forward, seed).expect("it can be made");
        render::markdown(&e.statement, "figures").text + &render::markdown(&e.solution, "figures").text
    };
    assert_eq!(text(5), text(5));
    let numbers = |seed| text(seed).split("Configuration 1").nth(1).map(str::to_string);
    let all: Vec<_> = (1..6).map(numbers).collect();
    let different = all.iter().enumerate().all(|(k, one)| !all[..k].contains(one));
    assert!(different, "{all:?}");
}

/// A sign that is lost in a solution costs points.
#[test]
fn a_slip_costs_points() {
    let e = made("planar-2r", ExerciseKind::Forward, 2).expect("it can be made");
    let right = render::markdown(&e.solution, "figures").text;
    let wrong = right.replacen("-S_{1}", "S_{1}", 1);
    assert_ne!(right, wrong);
    let points = |text: &str| earned(&e, text, Format::Markdown).points;
    assert_eq!(points(&right), e.rubric.points());
    assert!(points(&wrong) < e.rubric.points());
    // And so does what is left out.
    let (first, _) = right.split_once("## The pose in numbers").expect("a heading");
    assert!(points(first) <= e.rubric.points() - 2.0);
}

/// Lengths without values get some; nothing of a solution stands on the sheet of tasks.
#[test]
fn sheets_say_what_is_given() {
    let mut d = robot("planar-2r");
    d.parameters.iter_mut().for_each(|p| p.value = None);
    let options =
        ExerciseOptions { kind: ExerciseKind::Inverse, seed: 4, count: 3, language: Tongue::French };
    let e = exercise(&d, &options).expect("it can be made");
    assert!(e.robot.parameters.iter().all(|p| p.value.is_some()));
    let sheet = render::markdown(&e.statement, "figures").text;
    assert!(sheet.contains("Situation 3") && !sheet.contains("Solution"), "{sheet}");
    assert!(e.rubric.items[0].formulas >= 6);
    let refused = exercise(&robot("kuka-iiwa-7"), &options);
    assert!(matches!(refused, Err(NoExercise::Redundant)));
}

/// An arm whose base has a row of its own, here one that stands its plane upright, has masses at the ends of its links as any other.
#[test]
fn rows_of_the_base_carry_no_mass() {
    let text = "name = \"upright\"\nconvention = \"standard\"\n[parameters]\nl1 = 0.5\nl2 = 0.4\n\
                [[joints]]\nalpha = \"90 deg\"\n[[joints]]\ntheta = \"q1\"\na = \"l1\"\n[[joints]]\ntheta = \"q2\"\na = \"l2\"\n";
    let made = |text: &str| {
        let (d, _) = denavit::description::read_toml(text).expect("a robot");
        let options =
            ExerciseOptions { kind: ExerciseKind::Torques, seed: 3, count: 1, language: Tongue::English };
        exercise(&d, &options)
    };
    let sheet = made(text).unwrap_or_else(|why| panic!("{why}"));
    let solution = render::markdown(&sheet.solution, "f").text;
    // Weight turns a joint by the horizontal way of what it carries.
    assert!(
        solution.contains("C_{12}") && solution.contains("m_{2}") && !solution.contains("m_{3}"),
        "{solution}"
    );
    let all: f64 = sheet.rubric.items.iter().map(|i| i.points).sum();
    assert!((earned(&sheet, &solution, Format::Markdown).points - all).abs() < 1e-9, "{solution}");
    // Behind a joint a row puts the end of the link elsewhere.
    let flange = format!("{text}[[joints]]\na = 0.1\n");
    assert!(matches!(made(&flange), Err(NoExercise::Masses)));
}
