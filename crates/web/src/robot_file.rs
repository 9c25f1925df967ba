//! A robot file as cells that one can edit, and the way back: every finding to its cell.

use serde::{Deserialize, Serialize};
use std::fmt::Write;
use std::ops::Range;
use toml::{Table, Value};

/// A robot file; every value is the text of its cell.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize)]
pub struct RobotFile {
    pub name: String,
    pub convention: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gravity: Option<Vec<String>>,
    #[serde(default)]
    pub parameters: Vec<Parameter>,
    #[serde(default)]
    pub joints: Vec<Row>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub base: Option<Frame>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tool: Option<Frame>,
    #[serde(default)]
    pub poses: Vec<Pose>,
}

/// A symbol; its value is empty where none is known.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Parameter {
    pub name: String,
    pub value: String,
}

/// A named configuration.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Pose {
    pub name: String,
    pub values: Vec<String>,
}

/// A row of the table: cells by their keys.
pub type Row = serde_json::Map<String, serde_json::Value>;

/// A constant transform: displacement and roll, pitch, yaw, or a matrix.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize)]
pub struct Frame {
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub xyz: Option<Vec<String>>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rpy: Option<Vec<String>>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub matrix: Option<Vec<Vec<String>>>,
}

/// The keys of a row, in the order in which they are written.
const KEYS: [&str; 19] = [
    "name",
    "gamma",
    "b",
    "theta",
    "d",
    "a",
    "alpha",
    "r",
    "limits",
    "velocity",
    "acceleration",
    "mass",
    "com",
    "inertia",
    "first_moment",
    "inertia_at_origin",
    "rotor",
    "viscous",
    "coulomb",
];

/// A text, and which bytes of it are which cell.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Written {
    pub text: String,
    cells: Vec<(Range<usize>, String)>,
}

impl Written {
    /// The cell that a place of the text lies in: `joints.2.theta`; of a row without such a cell the row.
    pub fn cell(&self, at: usize) -> Option<&str> {
        let within = self.cells.iter().filter(|(span, _)| span.contains(&at) || span.start == at);
        within.min_by_key(|(span, _)| span.len()).map(|(_, name)| name.as_str())
    }

    fn push(&mut self, text: &str) {
        self.text.push_str(text);
    }

    fn cell_of(&mut self, name: String, text: &str) {
        let start = self.text.len();
        self.push(&quoted(text));
        self.cells.push((start..self.text.len(), name));
    }

    fn line(&mut self, key: &str, name: String, text: &str) {
        let start = self.text.len();
        self.push(&format!("{key} = "));
        self.cell_of(name.clone(), text);
        self.cells.push((start..self.text.len(), name));
        self.push("\n");
    }

    fn list(&mut self, key: &str, name: &str, texts: &[String]) {
        let start = self.text.len();
        self.push(&format!("{key} = "));
        self.row(name, texts);
        self.cells.push((start..self.text.len(), name.to_string()));
        self.push("\n");
    }

    fn row(&mut self, name: &str, texts: &[String]) {
        self.push("[");
        for (k, text) in texts.iter().enumerate() {
            self.push(if k > 0 { ", " } else { "" });
            self.cell_of(format!("{name}.{k}"), text);
        }
        self.push("]");
    }

    fn frame(&mut self, key: &str, frame: &Option<Frame>) {
        let Some(frame) = frame else { return };
        let start = self.text.len();
        let _ = writeln!(self.text, "\n[{key}]");
        if let Some(rows) = &frame.matrix {
            self.push("matrix = [\n");
            for (k, row) in rows.iter().enumerate() {
                self.push("  ");
                self.row(&format!("{key}.matrix.{k}"), row);
                self.push(",\n");
            }
            self.push("]\n");
        } else {
            for (part, texts) in [("xyz", &frame.xyz), ("rpy", &frame.rpy)] {
                if let Some(texts) = texts {
                    self.list(part, &format!("{key}.{part}"), texts);
                }
            }
        }
        self.cells.push((start..self.text.len(), key.to_string()));
    }
}

impl RobotFile {
    /// The robot file as TOML.
    pub fn to_toml(&self) -> Written {
        let mut out = Written::default();
        out.line("name", "name".into(), &self.name);
        out.line("convention", "convention".into(), &self.convention);
        if let Some(source) = &self.source {
            out.line("source", "source".into(), source);
        }
        if let Some(gravity) = &self.gravity {
            out.list("gravity", "gravity", gravity);
        }
        if !self.parameters.is_empty() {
            out.push("\n[parameters]\n");
        }
        for (k, p) in self.parameters.iter().enumerate() {
            let start = out.text.len();
            let key = quoted(&p.name);
            out.push(&key);
            out.cells.push((start..start + key.len(), format!("parameters.{k}.name")));
            out.push(" = ");
            match p.value.trim() {
                "" => out.push("{}"),
                value => out.cell_of(format!("parameters.{k}.value"), value),
            }
            out.push("\n");
        }
        for (k, row) in self.joints.iter().enumerate() {
            let start = out.text.len();
            out.push("\n[[joints]]\n");
            let unknown = row.keys().map(String::as_str).filter(|key| !KEYS.contains(key));
            let keys: Vec<&str> = KEYS.into_iter().chain(unknown).collect();
            for key in keys {
                let name = format!("joints.{k}.{key}");
                match row.get(key) {
                    Some(serde_json::Value::String(text)) if !text.trim().is_empty() => {
                        out.line(&bare(key), name, text.trim());
                    }
                    Some(serde_json::Value::Array(items)) => {
                        let texts: Vec<String> =
                            items.iter().map(|x| x.as_str().unwrap_or_default().trim().to_string()).collect();
                        if texts.iter().any(|t| !t.is_empty()) {
                            out.list(&bare(key), &name, &texts);
                        }
                    }
                    _ => {}
                }
            }
            out.cells.push((start..out.text.len(), format!("joints.{k}")));
        }
        out.frame("base", &self.base);
        out.frame("tool", &self.tool);
        if !self.poses.is_empty() {
            out.push("\n[poses]\n");
        }
        for (k, pose) in self.poses.iter().enumerate() {
            out.list(&bare(&pose.name), &format!("poses.{k}.values"), &pose.values);
        }
        out
    }

    /// The cells of a robot file; nothing if it is not TOML.
    pub fn from_toml(text: &str) -> Option<Self> {
        let table: Table = text.parse().ok()?;
        let string = |key: &str| table.get(key).map(cell);
        let frame = |key: &str| {
            let part = table.get(key)?.as_table()?;
            Some(Frame {
                xyz: part.get("xyz").map(cells),
                rpy: part.get("rpy").map(cells),
                matrix: part.get("matrix").and_then(Value::as_array).map(|m| m.iter().map(cells).collect()),
            })
        };
        let entries = |key: &str| table.get(key).and_then(Value::as_table).cloned().unwrap_or_default();
        let rows = table.get("joints").and_then(Value::as_array).cloned().unwrap_or_default();
        let row = |row: &Value| {
            let pairs = row.as_table().into_iter().flatten();
            let value = |v: &Value| match v {
                Value::Array(_) => cells(v).into(),
                other => serde_json::Value::from(cell(other)),
            };
            pairs.map(|(key, v)| (key.clone(), value(v))).collect()
        };
        Some(RobotFile {
            name: string("name").unwrap_or_else(|| "robot".into()),
            convention: string("convention").unwrap_or_default(),
            source: string("source"),
            gravity: table.get("gravity").map(cells),
            parameters: entries("parameters")
                .iter()
                .map(|(name, v)| Parameter { name: name.clone(), value: cell(v) })
                .collect(),
            joints: rows.iter().map(row).collect(),
            base: frame("base"),
            tool: frame("tool"),
            poses: entries("poses")
                .iter()
                .map(|(name, v)| Pose { name: name.clone(), values: cells(v) })
                .collect(),
        })
    }
}

/// A value as the text of a cell; empty for a parameter without value.
fn cell(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Integer(n) => n.to_string(),
        Value::Float(x) => x.to_string(),
        Value::Table(_) => String::new(),
        other => other.to_string(),
    }
}

fn cells(value: &Value) -> Vec<String> {
    value.as_array().into_iter().flatten().map(cell).collect()
}

/// A key without quotes where it needs none.
fn bare(key: &str) -> String {
    let is_bare = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    if !key.is_empty() && key.chars().all(is_bare) { key.into() } else { quoted(key) }
}

fn quoted(text: &str) -> String {
    let mut out = String::from('"');
    for c in text.chars() {
        match c {
            '"' => out.push_str("\\\""),
            '\\' => out.push_str("\\\\"),
            '\n' => out.push_str("\\n"),
            '\t' => out.push_str("\\t"),
            c if c.is_control() => {
                let _ = write!(out, "\\u{:04x}", c as u32);
            }
            c => out.push(c),
        }
    }
    out.push('"');
    out
}
