//! Points for a teacher: a TOML file says which claims count how much.
//!
//! ```toml
//! title = "Exercise 3"
//! robot = "arm.toml"           # of a task: the robot, by its name or its file
//! conditional = 0.5            # the share that a formula right under a condition earns
//! carried = 1                  # and one that is right but for an earlier error
//!
//! [[items]]
//! name = "link transforms"
//! claims = ["A_1", "A_2"]      # left sides as printed; "*" stands for any letters
//! points = 4
//! whole = true                 # all or nothing; else each formula earns its share
//! formulas = 12                # how many a full answer has: what is missing earns nothing
//! answers = [{ names = ["T_1"], value = "2.5", unit = "s" }]   # values that say nothing of the robot
//! about = ["links"]            # what it asks for, by which answers are found whatever they are called
//! form = "formulas"            # or "numbers"; either will do where it is not said
//! configurations = [{ q = [1.3, 0.2], within = [0.001, 0.001] }]  # all configurations, radians and metres
//! zeros = [{ joint = 2, value = "pi" }]  # all values of joints at which the arm is singular
//! ```

use crate::failure::Failure;
use denavit::description::line_column;
use denavit_check::Answer;
use denavit_check::marking::{Asked, Form, Item, Rubric, Subject};
use denavit_symbolic::parse::parse;
use denavit_symbolic::vocabulary::Vocabulary;

/// The keys of the file.
const KEYS: [&str; 5] = ["title", "robot", "conditional", "carried", "items"];

/// What a rubric file says, and the robot that it names.
pub struct Task {
    pub rubric: Rubric,
    /// A name of the catalogue, or a file beside that of the task.
    pub robot: Option<String>,
    /// The name of the file.
    name: String,
}

impl Task {
    /// Whether all that the items ask for is of an arm with so many joints.
    ///
    /// # Errors
    /// All that is not.
    pub fn fits(&self, joints: usize) -> Result<(), Failure> {
        let mut errors = vec![];
        for (n, item) in (1..).zip(&self.rubric.items) {
            for (k, (joint, _)) in (1..).zip(&item.zeros).filter(|(_, z)| z.0 > joints) {
                errors.push(format!(
                    "`zeros` of item {n}: number {k} is of joint {joint}, the robot has {joints}"
                ));
            }
            for (k, asked) in (1..).zip(&item.configurations).filter(|(_, a)| a.q.len() != joints) {
                let count = asked.q.len();
                let values = if count == 1 { "1 value".into() } else { format!("{count} values") };
                errors.push(format!(
                    "`configurations` of item {n}: number {k} has {values}, the robot has {joints} joints"
                ));
            }
        }
        refused(&self.name, &errors)
    }
}

/// The errors of a file, if there are some.
fn refused(name: &str, errors: &[String]) -> Result<(), Failure> {
    let lines: Vec<String> = errors.iter().map(|e| format!("{name}: error: {e}")).collect();
    if lines.is_empty() { Ok(()) } else { Err(Failure::Input(lines.join("\n"))) }
}

/// What of a list is no formula: its numbers, from 1, and what is there. Values of joints have no letters.
fn unread<'a>(values: impl Iterator<Item = &'a str>, has_letters: bool) -> Vec<(usize, &'a str)> {
    let is_formula = |text: &str| {
        parse(text, &Vocabulary::new().open(true)).is_ok_and(|e| has_letters || e.symbols().is_empty())
    };
    (1..).zip(values).filter(|(_, text)| !is_formula(text)).collect()
}

/// A rubric as a file that [`read`] reads, of a task with this robot.
pub fn write(rubric: &Rubric, robot: &str) -> String {
    let text = |s: &str| toml::Value::from(s).to_string();
    let mut out = String::new();
    if let Some(title) = &rubric.title {
        out += &format!("title = {}\n", text(title));
    }
    out += &format!("robot = {}\n", text(robot));
    out += &format!("conditional = {:?}\ncarried = {:?}\n", rubric.conditional, rubric.carried);
    for item in &rubric.items {
        let claims: Vec<String> = item.claims.iter().map(|c| text(c)).collect();
        out += &format!("\n[[items]]\nname = {}\nclaims = [{}]\n", text(&item.name), claims.join(", "));
        out += &format!("points = {:?}\nformulas = {}\n", item.points, item.formulas);
        if item.whole {
            out += "whole = true\n";
        }
        if !item.answers.is_empty() {
            out += "answers = [\n";
            for answer in &item.answers {
                let names: Vec<String> = answer.names.iter().map(|n| text(n)).collect();
                let [names, value, unit] = [names.join(", "), text(&answer.value), text(&answer.unit)];
                out += &format!("  {{ names = [{names}], value = {value}, unit = {unit} }},\n");
            }
            out += "]\n";
        }
        if !item.about.is_empty() {
            let about: Vec<String> = item.about.iter().map(|a| text(a.name())).collect();
            out += &format!("about = [{}]\n", about.join(", "));
        }
        if let Some(form) = item.form {
            out += &format!("form = {}\n", text(form.name()));
        }
        if !item.configurations.is_empty() {
            let listed = |all: &[f64]| all.iter().map(|x| format!("{x:?}")).collect::<Vec<_>>().join(", ");
            out += "configurations = [\n";
            for Asked { q, within } in &item.configurations {
                out += &format!("  {{ q = [{}], within = [{}] }},\n", listed(q), listed(within));
            }
            out += "]\n";
        }
        if !item.zeros.is_empty() {
            let zero =
                |(joint, value): &(usize, String)| format!("{{ joint = {joint}, value = {} }}", text(value));
            out += &format!("zeros = [{}]\n", item.zeros.iter().map(zero).collect::<Vec<_>>().join(", "));
        }
    }
    out
}

/// A word, or a list of them, each one of a set; nothing if there is another.
fn one_of<T: Copy>(value: Option<&toml::Value>, all: &[T], name: fn(T) -> &'static str) -> Option<Vec<T>> {
    let words: Vec<&str> = match value {
        None => vec![],
        Some(toml::Value::String(one)) => vec![one],
        Some(value) => value.as_array()?.iter().map(toml::Value::as_str).collect::<Option<_>>()?,
    };
    words.into_iter().map(|w| all.iter().copied().find(|x| name(*x) == w)).collect()
}

/// The configurations that an item asks for; nothing if they are not told.
fn configurations(value: Option<&toml::Value>) -> Option<Vec<Asked>> {
    let Some(value) = value else { return Some(vec![]) };
    let number = |v: &toml::Value| v.as_float().or(v.as_integer().map(|n| n as f64));
    let numbers = |v: &toml::Value| v.as_array()?.iter().map(number).collect::<Option<Vec<f64>>>();
    let one = |value: &toml::Value| {
        let q = numbers(value.get("q")?)?;
        let within = match value.get("within") {
            Some(within) => numbers(within)?,
            None => vec![0.0; q.len()],
        };
        (q.len() == within.len()).then_some(Asked { q, within })
    };
    value.as_array()?.iter().map(one).collect()
}

/// The values at which an arm is singular; nothing if they are not told.
fn zeros(value: Option<&toml::Value>) -> Option<Vec<(usize, String)>> {
    let Some(value) = value else { return Some(vec![]) };
    let one = |value: &toml::Value| {
        let joint = usize::try_from(value.get("joint")?.as_integer()?).ok().filter(|k| *k > 0)?;
        let number = value.get("value")?;
        Some((joint, number.as_str().map_or_else(|| number.to_string(), str::to_string)))
    };
    value.as_array()?.iter().map(one).collect()
}

/// The values that an item asks for; nothing if they are not told.
fn answers(value: Option<&toml::Value>) -> Option<Vec<Answer>> {
    let Some(value) = value else { return Some(vec![]) };
    let one = |value: &toml::Value| {
        let names = value.get("names")?.as_array()?.iter();
        let number = value.get("value")?;
        Some(Answer {
            names: names.map(|n| n.as_str().map(str::to_string)).collect::<Option<_>>()?,
            value: number.as_str().map_or_else(|| number.to_string(), str::to_string),
            unit: value.get("unit").and_then(toml::Value::as_str).unwrap_or_default().to_string(),
        })
    };
    value.as_array()?.iter().map(one).collect()
}

/// Reads a rubric file.
///
/// # Errors
/// All that is wrong with it.
pub fn read(name: &str, text: &str) -> Result<Task, Failure> {
    let file: toml::Table = text.parse().map_err(|e: toml::de::Error| {
        let (line, column) = line_column(text, e.span().map_or(0, |s| s.start));
        Failure::Input(format!("{name}:{line}:{column}: error: {}", e.message()))
    })?;
    let mut errors = vec![];
    for key in file.keys().filter(|k| !KEYS.contains(&k.as_str())) {
        errors.push(format!("`{key}` is not known; the keys are {}", KEYS.join(", ")));
    }
    let number =
        |v: &toml::Value| v.as_float().or(v.as_integer().map(|n| n as f64)).filter(|x| x.is_finite());
    let mut share = |key: &str, usual: f64| match file.get(key) {
        None => usual,
        Some(v) => number(v).filter(|x| (0.0..=1.0).contains(x)).unwrap_or_else(|| {
            errors.push(format!("`{key}` is a number from 0 to 1"));
            usual
        }),
    };
    let (conditional, carried) = (share("conditional", 0.5), share("carried", 1.0));
    let mut items = vec![];
    let listed = file.get("items").and_then(toml::Value::as_array).cloned().unwrap_or_default();
    for (n, value) in (1..).zip(&listed) {
        let get = |key: &str| value.get(key);
        let claims = match get("claims") {
            Some(toml::Value::String(one)) => Some(vec![one.clone()]),
            Some(toml::Value::Array(all)) => all.iter().map(|c| c.as_str().map(str::to_string)).collect(),
            // Values have names of their own.
            None if ["answers", "about"].iter().any(|key| get(key).is_some()) => Some(vec![]),
            _ => None,
        };
        let mut told = |key: &str, what: &str| errors.push(format!("`{key}` of item {n} {what}"));
        let about = one_of(get("about"), &Subject::ALL, Subject::name).unwrap_or_else(|| {
            let all: Vec<&str> = Subject::ALL.iter().map(|s| s.name()).collect();
            told("about", &format!("is one of {}", all.join(", ")));
            vec![]
        });
        let form = one_of(get("form"), &Form::ALL, Form::name).unwrap_or_else(|| {
            told("form", "is formulas or numbers");
            vec![]
        });
        let configurations = configurations(get("configurations")).unwrap_or_else(|| {
            told("configurations", "are `q` and `within`, a number for each joint");
            vec![]
        });
        let zeros = zeros(get("zeros")).unwrap_or_else(|| {
            told("zeros", "are a `joint`, from 1, and its `value`, a formula");
            vec![]
        });
        for (k, value) in unread(zeros.iter().map(|z| z.1.as_str()), false) {
            errors.push(format!("`zeros` of item {n}: number {k}, `{value}`, is no value"));
        }
        let answers = answers(get("answers")).unwrap_or_else(|| {
            errors.push(format!("the answers of item {n} need `names` and a `value`, a formula"));
            vec![]
        });
        for (k, value) in unread(answers.iter().map(|a| a.value.as_str()), true) {
            errors.push(format!("`answers` of item {n}: number {k}, `{value}`, is no formula"));
        }
        match (claims, get("points").and_then(&number)) {
            (Some(claims), Some(points)) if points >= 0.0 => items.push(Item {
                name: get("name").and_then(|v| v.as_str()).map_or_else(|| claims.join(", "), str::to_string),
                claims,
                points,
                whole: get("whole").and_then(toml::Value::as_bool).unwrap_or(false),
                answers,
                formulas: get("formulas").and_then(toml::Value::as_integer).map_or(0, |n| n.max(0) as usize),
                about,
                form: form.first().copied(),
                configurations,
                zeros,
            }),
            _ => errors.push(format!("item {n} needs `claims` (names) or `about`, and `points` (a number)")),
        }
    }
    if listed.is_empty() {
        errors.push("there are no [[items]]".into());
    }
    refused(name, &errors)?;
    let words = |key: &str| file.get(key).and_then(|v| v.as_str()).map(str::to_string);
    let rubric = Rubric { title: words("title"), conditional, carried, items };
    Ok(Task { rubric, robot: words("robot"), name: name.to_string() })
}
