//! A recipe as TOML, to be edited.

use crate::arm::Arm;
use crate::data::Direction;
use crate::decode::{Form, Format};
use crate::finding::Off;
use crate::recipe::{ColumnUnit, JointColumn, Recipe, Rows, table_of};
use crate::words::direction_of;
use denavit::geometry::{Axis, Rotation, Transform, Vector};
use std::fmt;
use toml::{Table, Value};

/// Why a text is no recipe.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct RecipeError(pub String);

impl fmt::Display for RecipeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for RecipeError {}

/// Names that a text in TOML needs quoted.
fn quoted(text: &str) -> String {
    Value::String(text.into()).to_string()
}

fn list<T>(all: &[T], one: impl Fn(&T) -> String) -> String {
    format!("[{}]", all.iter().map(one).collect::<Vec<_>>().join(", "))
}

/// A number that reads back as a float.
fn number(x: &f64) -> String {
    format!("{:?}", x + 0.0)
}

impl fmt::Display for Recipe {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let joints = &self.joints;
        let unit = |u: &ColumnUnit| match u {
            ColumnUnit::Times(k) => format!("{{ times = {} }}", number(k)),
            ColumnUnit::Range(r) => format!("{{ range = {} }}", list(r, number)),
        };
        writeln!(
            f,
            "# q = sign · gain · (unit · column) − zero, in radians and metres; then couplings, then what stands behind them."
        )?;
        writeln!(f, "robot = {}", quoted(&self.robot))?;
        writeln!(f, "table = {} # a recipe is of one table", quoted(&self.table))?;
        writeln!(f, "\n[source]")?;
        writeln!(f, "joints = {}", list(joints, |j| quoted(&j.column)))?;
        writeln!(f, "position = {}", list(&self.position, |n| quoted(n)))?;
        writeln!(f, "rotation = {}", list(&self.rotation, |n| quoted(n)))?;
        writeln!(f, "\n[joints]")?;
        writeln!(f, "unit = {}", list(joints, |j| unit(&j.unit)))?;
        writeln!(f, "sign = {}", list(joints, |j| if j.is_reversed { "-1".into() } else { "1".into() }))?;
        writeln!(f, "gain = {}", list(joints, |j| number(&j.gain)))?;
        writeln!(f, "zero = {}", list(joints, |j| number(&j.zero)))?;
        let turn = |j: &JointColumn| number(&j.turn.unwrap_or(0.0));
        writeln!(f, "turn = {} # whole turns of these are undone", list(joints, turn))?;
        let coupling = |c: &(usize, f64)| format!("{{ joint = {}, less = {} }}", c.0 + 1, number(&c.1));
        writeln!(f, "couplings = {} # so much of the joint before", list(&self.couplings, coupling))?;
        writeln!(f, "gain_behind = {}", list(joints, |j| number(&j.behind[0])))?;
        writeln!(f, "zero_behind = {}", list(joints, |j| number(&j.behind[1])))?;
        let seconds = self.delay.1.map_or(String::new(), |s| format!(", seconds = {}", number(&s)));
        writeln!(f, "delay = {{ rows = {}{seconds} }}", number(&self.delay.0))?;
        writeln!(f, "\n[position]\nper_metre = {}", number(&self.scale))?;
        let mirrored = self.mirror.map_or("none".into(), |a| a.to_string());
        writeln!(f, "mirrored = {}", quoted(&mirrored))?;
        writeln!(f, "\n[rotation]\nformat = {}", quoted(&self.format.form.to_string()))?;
        writeln!(f, "degrees = {}", self.format.degrees)?;
        writeln!(f, "of = {}", quoted(direction_of(self.direction)))?;
        writeln!(f, "\n[frames]")?;
        let frame = |x: &Transform<f64>| list(&x.matrix()[..3], |row| list(row, number));
        writeln!(f, "base = {}", frame(&self.base))?;
        writeln!(f, "tool = {}", frame(&self.tool))?;
        let length = |l: &(usize, usize, f64)| {
            format!("{{ behind_joint = {}, along = \"{}\", by = {} }}", l.0, Axis::ALL[l.1], number(&l.2))
        };
        writeln!(f, "lengths = {}", list(&self.lengths, length))?;
        for r in &self.rows {
            writeln!(
                f,
                "\n[[rows]] # counted from 0, `to` is behind the last\nfrom = {}\nto = {}",
                r.from, r.to
            )?;
            if let Some(column) = &r.column {
                writeln!(f, "column = {}", quoted(column))?;
            }
            writeln!(f, "cause = {}", quoted(&r.cause))?;
        }
        writeln!(f, "\n[evidence]")?;
        writeln!(
            f,
            "left_over = {{ turn = {}, shift = {} }} # radians and metres, root mean square",
            number(&self.left_over.turn),
            number(&self.left_over.shift)
        )
    }
}

impl Recipe {
    /// Reads a recipe.
    ///
    /// # Errors
    /// If it is none: the key that is missing or of another kind.
    pub fn read(text: &str) -> Result<Self, RecipeError> {
        let all: Table = text.parse().map_err(|e: toml::de::Error| RecipeError(e.to_string()))?;
        let fail = |key: &str, wanted: &str| RecipeError(format!("`{key}` is missing, or is not {wanted}"));
        let text_at = |key: &str| {
            at(&all, key).and_then(Value::as_str).map(String::from).ok_or_else(|| fail(key, "a text"))
        };
        let texts = |key: &str| {
            let list = at(&all, key).and_then(Value::as_array);
            list.and_then(|l| l.iter().map(|v| v.as_str().map(String::from)).collect::<Option<Vec<_>>>())
                .ok_or_else(|| fail(key, "a list of texts"))
        };
        let numbers =
            |key: &str| at(&all, key).and_then(floats).ok_or_else(|| fail(key, "a list of numbers"));
        let list =
            |key: &str| at(&all, key).and_then(Value::as_array).cloned().ok_or_else(|| fail(key, "a list"));
        let columns = texts("source.joints")?;
        let n = columns.len();
        let each = |key: &str| {
            numbers(key)
                .and_then(|l| if l.len() == n { Ok(l) } else { Err(fail(key, "one number for each joint")) })
        };
        let (sign, gain, zero, turn) =
            (each("joints.sign")?, each("joints.gain")?, each("joints.zero")?, each("joints.turn")?);
        let behind = [each("joints.gain_behind")?, each("joints.zero_behind")?];
        let units = list("joints.unit")?;
        let mut joints = vec![];
        for (i, column) in columns.into_iter().enumerate() {
            let unit = units.get(i).and_then(|u| {
                let range = u.get("range").and_then(floats).filter(|r| r.len() == 2);
                let times = u.get("times").and_then(float).map(ColumnUnit::Times);
                times.or(range.map(|r| ColumnUnit::Range([r[0], r[1]])))
            });
            joints.push(JointColumn {
                column,
                unit: unit.ok_or_else(|| fail("joints.unit", "`times` or `range` for each joint"))?,
                is_reversed: sign[i] < 0.0,
                gain: gain[i],
                zero: zero[i],
                turn: (turn[i] != 0.0).then_some(turn[i]),
                behind: [behind[0][i], behind[1][i]],
            });
        }
        let mut couplings = vec![];
        for c in list("joints.couplings")? {
            let joint = c.get("joint").and_then(Value::as_integer).and_then(|j| usize::try_from(j).ok());
            match (joint, c.get("less").and_then(float)) {
                (Some(j), Some(k)) if (2..=n).contains(&j) => couplings.push((j - 1, k)),
                _ => return Err(fail("joints.couplings", "`joint` from 2 on and `less` of each")),
            }
        }
        let axis = |name: &str| Axis::ALL.into_iter().find(|a| a.to_string() == name);
        let mirror = match text_at("position.mirrored")?.as_str() {
            "none" => None,
            name => Some(axis(name).ok_or_else(|| fail("position.mirrored", "none, x, y or z"))?),
        };
        let form: Form =
            text_at("rotation.format")?.parse().map_err(|()| fail("rotation.format", "a format"))?;
        let degrees = at(&all, "rotation.degrees")
            .and_then(Value::as_bool)
            .ok_or_else(|| fail("rotation.degrees", "true or false"))?;
        let of = text_at("rotation.of")?;
        let direction = Direction::ALL.into_iter().find(|d| direction_of(*d) == of);
        let frame = |key: &str| -> Result<Transform<f64>, RecipeError> {
            let rows: Option<Vec<Vec<f64>>> = list(key)?.iter().map(floats).collect();
            let rows = rows
                .filter(|r| r.len() == 3 && r.iter().all(|r| r.len() == 4))
                .ok_or_else(|| fail(key, "three rows of four numbers"))?;
            let turn = Rotation::from_matrix(std::array::from_fn(|i| [rows[i][0], rows[i][1], rows[i][2]]))
                .map_err(|e| RecipeError(format!("`{key}`: {e}")))?;
            Ok(Transform::from_rotation_translation(turn, Vector(std::array::from_fn(|i| rows[i][3]))))
        };
        let mut lengths = vec![];
        for l in list("frames.lengths")? {
            let k = l.get("behind_joint").and_then(Value::as_integer).and_then(|k| usize::try_from(k).ok());
            let along = l.get("along").and_then(Value::as_str).and_then(axis);
            match (k, along, l.get("by").and_then(float)) {
                (Some(k), Some(a), Some(by)) => lengths.push((k, a.index(), by)),
                _ => return Err(fail("frames.lengths", "`behind_joint`, `along` and `by` of each")),
            }
        }
        let mut rows = vec![];
        for r in all.get("rows").and_then(Value::as_array).into_iter().flatten() {
            let row =
                |key: &str| r.get(key).and_then(Value::as_integer).and_then(|k| usize::try_from(k).ok());
            let text = |key: &str| r.get(key).and_then(Value::as_str).map(String::from);
            let (Some(from), Some(to)) = (row("from"), row("to")) else {
                return Err(fail("rows", "`from` and `to` of each"));
            };
            rows.push(Rows { from, to, column: text("column"), cause: text("cause").unwrap_or_default() });
        }
        let one = |key: &str| at(&all, key).and_then(float).ok_or_else(|| fail(key, "a number"));
        let scale = one("position.per_metre")?;
        if !scale.is_finite() || scale <= 0.0 {
            return Err(fail("position.per_metre", "a positive number"));
        }
        Ok(Recipe {
            robot: text_at("robot")?,
            table: text_at("table")?,
            joints,
            couplings,
            delay: (one("joints.delay.rows")?, one("joints.delay.seconds").ok()),
            position: texts("source.position")?,
            scale,
            mirror,
            rotation: texts("source.rotation")?,
            format: Format { form, degrees },
            direction: direction.ok_or_else(|| fail("rotation.of", "a direction"))?,
            base: frame("frames.base")?,
            tool: frame("frames.tool")?,
            lengths,
            rows,
            left_over: Off { turn: one("evidence.left_over.turn")?, shift: one("evidence.left_over.shift")? },
        })
    }

    /// Whether the recipe is one of this arm's table.
    ///
    /// # Errors
    /// If it is one of another table.
    pub fn is_of(&self, arm: &Arm) -> Result<(), RecipeError> {
        if self.table == table_of(arm) && self.joints.len() == arm.joints() {
            return Ok(());
        }
        Err(RecipeError(format!(
            "the recipe is of another table: {}, {}; this one is {}",
            self.robot,
            self.table,
            table_of(arm)
        )))
    }
}

/// The value at keys joined by points.
fn at<'a>(table: &'a Table, key: &str) -> Option<&'a Value> {
    let mut keys = key.split('.');
    let first = table.get(keys.next()?)?;
    keys.try_fold(first, |v, k| v.get(k))
}

fn float(v: &Value) -> Option<f64> {
    v.as_float().or_else(|| v.as_integer().map(|i| i as f64))
}

fn floats(v: &Value) -> Option<Vec<f64>> {
    v.as_array()?.iter().map(float).collect()
}
