//! Robot files (TOML), as `docs/robot-files.md` describes them.

mod axes;
mod closures;
mod fields;
mod frames;
mod joints;
mod masses;
mod parallel;
mod parameters;
mod tree;
mod write;
mod write_axes;

pub use parallel::{ParallelRead, VERBS as PARALLEL_VERBS, read_parallel};
pub(super) use parameters::name_fault;
pub(super) use write::exact_rpy;
pub use write::{write_linkage, write_toml, write_tree};
pub use write_axes::{AxesAs, write_axes};

use super::branches::RowTree;
use super::cell::{Style, Value};
use super::diagnostic::{Diagnostic, Diagnostics, nearest};
use super::linkage::Linkage;
use super::rows::{self, Cell};
use super::units::Quantity;
use super::{Convention, Description, JointKind, Row, Variable};
use denavit_symbolic::{Expr, Symbol};
use fields::{Fields, Reader};
use frames::FrameCells;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// The longest text that is read, in bytes.
pub const MAX_BYTES: usize = 1 << 20;
/// The largest number of rows.
pub const MAX_ROWS: usize = 500;
/// The largest number of parameters.
const MAX_PARAMETERS: usize = 1000;

const KEYS: &[&str] = &[
    "name",
    "convention",
    "source",
    "parameters",
    "joints",
    "base",
    "tool",
    "poses",
    "gravity",
    "frames",
    "tip",
    "closures",
    "modes",
];

/// What a text describes.
#[derive(Clone, Debug)]
pub enum Described {
    /// One chain.
    Chain(Box<Description>),
    /// A tree of rows.
    Tree(Box<RowTree>),
    /// A tree of rows with closed loops.
    Linkage(Box<Linkage>),
}

/// Reads a robot file; of a tree the chain to its tip, or to the frame with the most joints on the way. With the description come
/// warnings and notes.
///
/// # Errors
/// All errors of the text (with the warnings and notes), in the order of the text; a tree with several ends and no `tip`.
pub fn read_toml(text: &str) -> Result<(Description, Vec<Diagnostic>), Vec<Diagnostic>> {
    read_robot(text).and_then(|(read, findings)| read.chain(findings))
}

/// Reads a robot file. With what it describes come warnings and notes.
///
/// # Errors
/// All errors of the text (with the warnings and notes), in the order of the text.
pub fn read_robot(text: &str) -> Result<(Described, Vec<Diagnostic>), Vec<Diagnostic>> {
    let mut out = Diagnostics::default();
    if text.len() > MAX_BYTES {
        out.error(0..0, format!("the text has {} bytes; {MAX_BYTES} are allowed", text.len()));
        return out.finish(None);
    }
    let (table, errors) = DeTable::parse_recoverable(text);
    let mut readable = true;
    for e in errors {
        let span = fields::clamp(text, e.span().unwrap_or(0..0));
        let key = text[span.clone()].to_string();
        match e.message() {
            "duplicate key" => out.error(span, format!("`{key}` is given twice")),
            message => {
                readable = false;
                out.error(span, format!("not TOML: {message}"))
            }
        };
    }
    if !readable {
        return out.finish(None); // what a broken line meant is anybody's guess
    }
    let mut reader = Reader { text, out, branches: None, loops: None };
    let description = reader.description(table.get_ref());
    let described = description.map(|d| match (reader.branches.take(), reader.loops.take()) {
        (Some(branches), None) => Described::Tree(Box::new(branches.tree(d))),
        (Some(branches), Some(loops)) => Described::Linkage(Box::new(loops.linkage(branches.tree(d)))),
        (None, _) => Described::Chain(Box::new(d)),
    });
    reader.out.finish(described)
}

impl Reader<'_> {
    fn description(&mut self, table: &DeTable) -> Option<Description> {
        let fields = Fields::new(table, 0..0);
        if let Some(given) = axes::Given::of(&fields) {
            return self.axes_description(&fields, given);
        }
        if let Some(kind) = fields.get("kind") {
            self.out
                .error(kind.span(), "a parallel robot: it is no chain of rows")
                .hint(format!("{PARALLEL_VERBS}; a file of rows has no `kind`"));
            return None;
        }
        self.unknown_keys(&fields, KEYS, top_level_hint);
        let name = self.string(fields.get("name")).unwrap_or_else(|| "robot".into());
        let source = self.string(fields.get("source"));
        let convention = self.convention(fields.get("convention"));

        let declared = self.parameter_names(fields.get("parameters"));
        let names: Vec<String> = declared.iter().map(|p| p.name.clone()).collect();
        // Frames alone are a tree, too.
        let needs_joints = fields.get("frames").is_none();
        let mut drafts = self.joints(fields.get("joints"), convention, needs_joints);
        let pieces = self.branches(&fields, &drafts, convention);
        let count = drafts.len();
        let closures = closures::of(&fields);
        let halves = closures.map(|value| {
            let row_names: Vec<Option<String>> =
                drafts.iter().map(|d| self.string(d.fields.get("name"))).collect();
            let (halves, sides) = self.closures(value, &row_names, convention);
            drafts.extend(sides);
            halves
        });
        let cells: Vec<rows::Cells> = drafts.iter().map(|d| d.cells.clone()).collect();
        let (base, base_cells) = self.frame(fields.get("base"), "base");
        let (tool, tool_cells) = self.frame(fields.get("tool"), "tool");

        let passive = if halves.is_some() { closures::passive_names(&cells) } else { vec![] };
        for p in declared.iter().filter(|p| passive.contains(&p.name)) {
            self.out
                .error(p.value.span(), format!("the parameter `{}` is named like a passive joint", p.name))
                .hint("p1, p2, … are the passive joints of a file with [[closures]]; choose another letter");
        }
        let known = [&names[..], &passive[..]].concat();
        rows::check_declared(cells.iter().flat_map(|r| r.all()), &known, count, &mut self.out);
        let frame_cells: Vec<&FrameCells> = [&base_cells, &tool_cells].into_iter().chain(&pieces).collect();
        for cell in frame_cells.iter().flat_map(|c| c.lengths.iter().chain(&c.angles).chain(&c.entries)) {
            self.constant_of_parameters(cell, &names, drafts.len());
        }
        let order = convention.unwrap_or(Convention::Standard);
        let variables = match halves {
            None => rows::assign_variables(&cells, order, &mut self.out),
            Some(_) => rows::assign_all_variables(&cells, order, &mut self.out),
        };
        self.check_sides(&cells[count..], &variables[count..], &variables);
        let mut uses = parameters::Uses::of(&cells, &frame_cells);
        let driven = variables.iter().flatten().filter(|v| !passive.contains(&v.symbol.name().to_string()));
        let kinds: Vec<JointKind> = driven.map(|v| v.kind).collect();
        let mut rows = self.rows(drafts, &variables, &known);
        let sides = rows.split_off(count);
        uses.others = rows.iter().flat_map(Row::mass_summands).collect();
        let parameters = self.parameter_values(&declared, &uses);
        let poses = self.poses(fields.get("poses"), &kinds);
        let gravity = self.gravity(fields.get("gravity"), &names, kinds.len());
        if needs_joints && kinds.is_empty() && !self.out.has_errors() {
            let first = cells.first().map_or(0..0, |c| c.span.clone());
            let finding = self.out.warning(first, "no row holds a joint variable: this is a fixed transform");
            finding.hint("the cell of a joint holds its variable: `q1`, or `q1 + 90 deg`");
        }
        if let Some(halves) = halves {
            let variables: Vec<Variable> = variables.iter().flatten().copied().collect();
            let modes = self.modes(fields.get("modes"), &variables, &names);
            self.loops = Some(closures::Loops { halves, sides, modes });
        } else if let Some(value) = fields.get("modes") {
            self.out
                .error(value.span(), "assembly modes of what has no closed loop")
                .hint("[[closures]] are the loops: left = { after = … }, right = { after = … }");
        }
        Some(Description {
            name,
            source,
            convention: convention?,
            parameters,
            rows,
            base: base?,
            tool: tool?,
            poses,
            gravity,
        })
    }

    fn gravity(
        &mut self,
        value: Option<&Spanned<DeValue>>,
        names: &[String],
        count: usize,
    ) -> Option<[Expr; 3]> {
        let cells = self.list(value?, &Style::plain(Quantity::Acceleration), "gravity", 3)?;
        cells.iter().for_each(|c| self.constant_of_parameters(c, names, count));
        cells.iter().map(|c| c.expr).collect::<Vec<Expr>>().try_into().ok()
    }

    fn convention(&mut self, value: Option<&Spanned<DeValue>>) -> Option<Convention> {
        let choices =
            "\"standard\" (theta d a alpha), \"craig\" (alpha a theta d) or \"khalil\" (alpha d theta r)";
        let Some(value) = value else {
            self.out
                .error(0..0, "the convention is missing")
                .hint(format!("a table means nothing without it: convention = {choices}"));
            return None;
        };
        let text = self.string(Some(value))?;
        let known = Convention::ALL.into_iter().find(|c| c.name() == text);
        if known.is_none() {
            let synonym = match text.to_lowercase().as_str() {
                "modified" | "mdh" | "modified dh" | "proximal" => {
                    Some("the modified convention has two alphabets: craig (a, d) and khalil (d, r)")
                }
                "classic" | "classical" | "distal" | "paul" | "dh" => Some("this is called \"standard\""),
                _ => None,
            };
            let hint = match (synonym, nearest(&text, Convention::ALL.map(Convention::name))) {
                (Some(hint), _) => hint.to_string(),
                (None, Some(near)) => format!("did you mean \"{near}\"?"),
                (None, None) => format!("it is {choices}"),
            };
            let shown: String = text.chars().take(40).collect();
            self.out
                .error(value.span(), format!("unknown convention \"{}\"", shown.escape_debug()))
                .hint(hint);
        }
        known
    }

    fn poses(&mut self, value: Option<&Spanned<DeValue>>, kinds: &[JointKind]) -> Vec<(String, Vec<Expr>)> {
        let Some(table) = value.and_then(|v| self.table(v, "poses")) else { return vec![] };
        let mut poses = vec![];
        for (name, value) in &table.entries {
            let Some(values) = self.array(value, "a pose") else { continue };
            if values.len() != kinds.len() {
                let (found, wanted) = (values.len(), kinds.len());
                self.out
                    .error(
                        value.span(),
                        format!("the pose `{name}` has {found} values for {wanted} joint variables"),
                    )
                    .hint("one value for each joint variable, in the order q1, q2, …");
                continue;
            }
            let mut pose = vec![];
            for (value, kind) in values.iter().zip(kinds) {
                pose.extend(self.constant(value, &Style::plain(quantity_of(*kind))));
            }
            if pose.len() == kinds.len() {
                poses.push((name.to_string(), pose));
            }
        }
        poses
    }

    /// A constant without names.
    fn constant(&mut self, value: &Spanned<DeValue>, style: &Style) -> Option<Expr> {
        let cell = self.cell(value, style)?;
        match cell.symbols.first() {
            None => Some(cell.expr),
            Some((name, span)) => {
                self.out.error(span.clone(), format!("`{name}` stands where a number is needed"));
                None
            }
        }
    }

    /// Reports names in a cell that are not parameters.
    fn constant_of_parameters(&mut self, cell: &Cell, names: &[String], count: usize) {
        for (name, span) in &cell.symbols {
            if super::cell::variable_number(name).is_some() {
                let message = format!("the joint variable `{name}` in what is constant");
                self.out
                    .error(span.clone(), message)
                    .hint("joint variables belong in the rows of [[joints]]");
            }
        }
        rows::check_declared([cell], names, count, &mut self.out);
    }

    /// Reports numbers without unit that look as if they were not SI.
    fn bare_numbers(&mut self, value: &Value, quantity: Quantity) {
        for (x, span) in &value.bare {
            super::suspicious_number(*x, span, quantity, "", &mut self.out);
        }
    }
}

fn quantity_of(kind: JointKind) -> Quantity {
    if kind == JointKind::Revolute { Quantity::Angle } else { Quantity::Length }
}

fn top_level_hint(key: &str) -> Option<String> {
    let belongs = |table: &str| Some(format!("`{key}` belongs under {table}"));
    match key {
        "theta" | "d" | "a" | "alpha" | "r" | "gamma" | "b" | "limits" | "velocity" | "mass" => {
            belongs("[[joints]]")
        }
        "xyz" | "rpy" | "matrix" => belongs("[base] or [tool]"),
        "frames" => Some("[[frames]] are frames with names in a tree".into()),
        "tip" => Some("a file with [[joints]] has [tool]; [tip] belongs to [[axes]] and [[screws]]".into()),
        "left" | "right" | "closure" | "loops" => {
            Some("each closed loop is a [[closures]]: left, right".into())
        }
        "joint" | "links" | "rows" => Some("each row of the table is a [[joints]]".into()),
        _ => None,
    }
}

/// A parameter as declared, its value still to be read.
struct Declared<'a> {
    name: String,
    symbol: Symbol,
    value: &'a Spanned<DeValue<'a>>,
}
