//! Arms made up from a seed: the structures of textbooks, with lengths of their own.

use super::{Exercise, ExerciseOptions, NoExercise, exercise};
use crate::render;
use crate::words::Tongue;
use denavit::description::{Description, read_toml};
use denavit::random::Random;
use denavit_check::{CheckOptions, check};
use denavit_reading::document::Format;

/// How hard an arm that is made up makes an exercise.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Difficulty {
    /// Two joints.
    Easy,
    /// Three joints.
    #[default]
    Medium,
    /// Three joints with offsets, or four to six.
    Hard,
}

/// Which arm is made up.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct ArmOptions {
    /// How hard it is.
    pub difficulty: Difficulty,
    /// Arms with the same number have the same sequence of joints: those of a class.
    pub series: u64,
}

/// A structure: its rows as θ, d, a, α. `±` is either sign, `!` a length of the row that is there or not, `L` one that is there.
type Structure = &'static [[&'static str; 4]];

const EASY: [Structure; 4] = [
    &[["q", "0", "L", "0"], ["q", "0", "L", "0"]],
    &[["q", "!", "0", "±90"], ["q", "0", "L", "0"]],
    &[["q+90", "0", "0", "90"], ["0", "q", "0", "0"]],
    &[["0", "q", "0", "±90"], ["q", "0", "L", "0"]],
];

const MEDIUM: [Structure; 7] = [
    &[["q", "0", "L", "0"], ["q", "0", "L", "0"], ["q", "0", "L", "0"]],
    &[["q+90", "0", "0", "90"], ["0", "q", "0", "-90"], ["q", "0", "L", "0"]],
    &[["q", "L", "0", "0"], ["0", "q", "0", "±90"], ["0", "q", "0", "0"]],
    &[["q", "L", "0", "±90"], ["q", "0", "0", "±90"], ["0", "q", "0", "0"]],
    &[["q", "L", "0", "±90"], ["q", "0", "L", "0"], ["q", "0", "L", "0"]],
    &[["q", "!", "L", "0"], ["q", "0", "L", "180"], ["0", "q", "0", "0"]],
    &[["0", "q", "0", "0"], ["q", "0", "L", "0"], ["q", "0", "L", "0"]],
];

const HARD: [Structure; 6] = [
    &[["q", "L", "L", "±90"], ["q", "0", "L", "0"], ["q", "0", "L", "0"]],
    &[["q", "!", "0", "±90"], ["q", "L", "0", "±90"], ["0", "q", "0", "0"]],
    &[["q", "0", "0", "±90"], ["q", "L", "L", "0"], ["q", "0", "L", "0"]],
    &[["q", "!", "L", "0"], ["q", "0", "L", "180"], ["0", "q", "0", "0"], ["q", "!", "0", "0"]],
    &[
        ["q", "!", "0", "90"],
        ["q", "0", "L", "0"],
        ["q+90", "0", "0", "90"],
        ["q", "L", "0", "-90"],
        ["q", "0", "0", "90"],
        ["q", "0", "0", "0"],
    ],
    &[
        ["q", "!", "0", "-90"],
        ["q", "L", "0", "90"],
        ["0", "q", "0", "0"],
        ["q", "0", "0", "-90"],
        ["q", "0", "0", "90"],
        ["q", "0", "0", "0"],
    ],
];

/// How many structures are tried, each for an exercise that it may not have.
const TRIED: u64 = 24;

/// The rows of the table, and the letters of the joints.
fn rows(structure: Structure, random: &mut Random) -> (String, String) {
    let (mut toml, mut lengths, mut letters) = (String::new(), String::new(), String::new());
    for (k, row) in (1..).zip(structure) {
        toml += "\n[[joints]]\n";
        for (key, cell) in ["theta", "d", "a", "alpha"].iter().zip(row) {
            let half = random.unit() < 0.5;
            let value = match *cell {
                "0" => continue,
                "q" => format!("q{k}"),
                "q+90" => format!("q{k} + 90 deg"),
                "!" if half => continue,
                "L" | "!" => {
                    lengths += &format!("{key}{k} = \"\"\n");
                    format!("{key}{k}")
                }
                "±90" if half => "-90 deg".into(),
                "±90" => "90 deg".into(),
                angle => format!("{angle} deg"),
            };
            letters += match (*key, cell.starts_with('q')) {
                ("theta", true) => "R",
                ("d", true) => "P",
                _ => "",
            };
            toml += &format!("{key} = \"{value}\"\n");
        }
    }
    (format!("[parameters]\n{lengths}{toml}"), letters)
}

/// An arm of this difficulty; `attempt` goes on where an arm does not serve.
fn arm(options: &ArmOptions, language: Tongue, seed: u64, attempt: u64) -> Description {
    let all: &[Structure] = match options.difficulty {
        Difficulty::Easy => &EASY,
        Difficulty::Medium => &MEDIUM,
        Difficulty::Hard => &HARD,
    };
    let mut of_series = Random(options.series.wrapping_mul(0x9E37_79B9).wrapping_add(17));
    of_series.unit();
    let first = (of_series.unit() * all.len() as f64) as u64;
    let structure = all[((first + attempt) % all.len() as u64) as usize];
    let mut random = Random(seed.wrapping_add(attempt / all.len() as u64 * 7919));
    random.unit();
    let (rows, letters) = rows(structure, &mut random);
    let name = language.words().made_up_arm(&letters, seed);
    let toml = format!("name = \"{name}\"\nconvention = \"standard\"\n{rows}");
    read_toml(&toml).map_or_else(|errors| unreachable!("{errors:?}\n{toml}"), |(d, _)| d)
}

/// Whether the check gives the exercise's own solution all its points: what it cannot judge is no exercise of an arm that
/// may be another.
fn earns_all(made: &Exercise) -> bool {
    let text = render::markdown(&made.solution, "figures").text;
    let checked = check(&text, Format::Markdown, Some(&made.robot), &CheckOptions::default());
    checked.is_ok_and(|mut checked| {
        made.rubric.answer(&text, Format::Markdown, &mut checked);
        made.rubric.mark(&text, &checked).points() > made.rubric.points() - 0.01
    })
}

/// Makes an exercise about an arm that is made up for it.
///
/// ```
/// use denavit_report::words::Tongue;
/// use denavit_report::{ArmOptions, Difficulty, ExerciseKind, ExerciseOptions, exercise_of_arm};
///
/// let options = ExerciseOptions { kind: ExerciseKind::Statics, seed: 3, count: 1, language: Tongue::English };
/// let arm = ArmOptions { difficulty: Difficulty::Easy, series: 1 };
/// let made = exercise_of_arm(&arm, &options).expect("some arm serves");
/// assert_eq!(made.robot.variables().len(), 2);
/// ```
///
/// # Errors
/// If none of the structures has what such an exercise is about: why the last of them has not.
pub fn exercise_of_arm(arm_options: &ArmOptions, options: &ExerciseOptions) -> Result<Exercise, NoExercise> {
    let mut why = NoExercise::Still;
    for attempt in 0..TRIED {
        match exercise(&arm(arm_options, options.language, options.seed, attempt), options) {
            Ok(made) if earns_all(&made) => return Ok(made),
            Ok(_) => why = NoExercise::Unmarked,
            Err(no @ NoExercise::Count(_)) => return Err(no),
            Err(no) => why = no,
        }
    }
    Err(why)
}
