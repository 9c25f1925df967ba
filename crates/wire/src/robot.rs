//! A robot as it is described: its table, its parameters, what is special about it.

use crate::{Schema, words};
use denavit::description::{Cell, Description, JointKind, Variable};
use denavit::geometry::Transform;
use denavit_report::words::Geometry as _;
use denavit_symbolic::Expr;
use denavit_symbolic::print::{Style, print};
use denavit_symbolic::vocabulary::Vocabulary;
use serde::Serialize;

/// `R` for a joint that turns, `P` for one that slides.
pub fn kind(kind: JointKind) -> &'static str {
    match kind {
        JointKind::Revolute => "R",
        JointKind::Prismatic => "P",
    }
}

/// The kinds of all joints: `RRPRRR`.
pub fn joints(d: &Description) -> String {
    d.variables().iter().map(|v| kind(v.kind)).collect()
}

/// A joint.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Joint {
    /// `R` or `P`.
    pub kind: &'static str,
    /// Its variable: `q1`.
    pub name: String,
}

impl From<&Variable> for Joint {
    fn from(variable: &Variable) -> Self {
        Joint { kind: kind(variable.kind), name: variable.symbol.name().to_string() }
    }
}

/// Everything that a description says.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Robot {
    /// Frame 0 in the base, 4×4 formulas.
    pub base: Formulas,
    /// The convention of the table.
    pub convention: &'static str,
    /// `RRPRRR`.
    pub joints: String,
    /// Its symbols.
    pub parameters: Vec<Parameter>,
    /// Its name.
    pub robot: String,
    /// The table.
    pub rows: Vec<Row>,
    /// The version.
    pub schema: Schema,
    /// Where the numbers come from.
    pub source: Option<String>,
    /// What is special about it.
    pub structure: Structure,
    /// The tool in the last frame, 4×4 formulas.
    pub tool: Formulas,
}

/// A pose as formulas, 4×4 by rows.
pub type Formulas = [[String; 4]; 4];

/// A symbol.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Parameter {
    /// What it is called.
    pub name: String,
    /// Its value as a formula, metres or radians; null where none is known.
    pub value: Option<String>,
}

/// A row of the table: a formula for each letter of the convention, `gamma` and `b` where a row branches.
#[derive(Clone, PartialEq, Debug, Default, Serialize)]
pub struct Row {
    /// The length along x in the conventions that call it so.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub a: Option<String>,
    /// The angle about x.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub alpha: Option<String>,
    /// The length along z before all others.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub b: Option<String>,
    /// The length along z, in `khalil` along x.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub d: Option<String>,
    /// The angle about z before all others.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gamma: Option<String>,
    /// The least and the greatest value of its variable.
    pub limits: Option<[String; 2]>,
    /// What its file calls it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// The length along z in `khalil`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub r: Option<String>,
    /// The angle about z.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub theta: Option<String>,
    /// `q1`; null in a row that does not move.
    pub variable: Option<String>,
}

impl Row {
    /// The cell of a letter.
    fn cell(&mut self, key: &str) -> &mut Option<String> {
        match key {
            "a" => &mut self.a,
            "alpha" => &mut self.alpha,
            "b" => &mut self.b,
            "d" => &mut self.d,
            "gamma" => &mut self.gamma,
            "r" => &mut self.r,
            _ => &mut self.theta,
        }
    }

    fn of(d: &Description, columns: &[Cell], row: &denavit::description::Row) -> Self {
        let mut new = Row {
            limits: row.limits.map(|l| l.map(text)),
            name: row.name.clone(),
            variable: row.variable.map(|v| v.symbol.name().to_string()),
            ..Row::default()
        };
        for column in columns {
            *new.cell(column.key(d.convention)) = Some(text(column.of(row)));
        }
        new
    }
}

/// What is special about an arm.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Structure {
    /// Pairs of axes that are nearly special.
    pub nearly: Vec<Nearly>,
    /// Runs of joints whose axes stay parallel.
    pub parallel: Vec<Vec<usize>>,
    /// How axes k and k + 1 lie.
    pub relations: Vec<String>,
    /// `RRR·RRR with spherical wrist`.
    pub schematic: String,
    /// The first of three joints whose axes meet in one point.
    pub spherical_wrists: Vec<usize>,
}

/// Axes that miss something special.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Nearly {
    /// By how much, radians or metres.
    pub by: f64,
    /// The two joints.
    pub joints: [usize; 2],
    /// What they nearly are: `parallel`.
    pub nearly: &'static str,
}

impl From<&denavit::structure::Structure> for Structure {
    fn from(s: &denavit::structure::Structure) -> Self {
        let nearly = s.nearly.iter();
        Structure {
            nearly: nearly
                .map(|n| Nearly { by: n.by, joints: n.joints.into(), nearly: n.nearly.name() })
                .collect(),
            parallel: s.parallel.clone(),
            relations: s.relations.iter().map(|r| words().relation(*r)).collect(),
            schematic: s.schematic(),
            spherical_wrists: s.spherical.clone(),
        }
    }
}

/// Without names of its own: sines and cosines in full.
fn text(e: Expr) -> String {
    print(e, &Vocabulary::new(), Style::Ascii)
}

fn formulas(x: &Transform<Expr>) -> Formulas {
    x.matrix().map(|row| row.map(text))
}

impl Robot {
    /// A description.
    pub fn of(d: &Description) -> Self {
        let columns = d.columns();
        let parameter = |p: &denavit::description::Parameter| Parameter {
            name: p.symbol.name().to_string(),
            value: p.value.map(text),
        };
        Robot {
            base: formulas(&d.base),
            convention: d.convention.name(),
            joints: joints(d),
            parameters: d.parameters.iter().map(parameter).collect(),
            robot: d.name.clone(),
            rows: d.rows.iter().map(|row| Row::of(d, &columns, row)).collect(),
            schema: Schema,
            source: d.source.clone(),
            structure: Structure::from(&denavit::structure::Structure::of(d)),
            tool: formulas(&d.tool),
        }
    }
}
