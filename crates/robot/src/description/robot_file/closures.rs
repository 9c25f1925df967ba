//! `[[closures]]` and `[modes]`: loops, and names of the ways to assemble them.

use super::fields::{Fields, Reader};
use super::joints::Draft;
use super::{Convention, MAX_ROWS, Style, quantity_of};
use crate::description::branches::RowTree;
use crate::description::cell::{Place, read_cell, variable_number};
use crate::description::linkage::{Closure, Linkage, NamedMode, Side, Told, is_passive, passive_number};
use crate::description::rows::Cells;
use crate::description::{Row, Variable};
use denavit_symbolic::{Expr, Symbol};
use std::ops::Range;
use toml::Spanned;
use toml::de::DeValue;

/// A closure of which the two frames are drafts behind those of the rows.
pub(super) struct Half {
    name: Option<String>,
    after: [Option<usize>; 2],
    span: Range<usize>,
}

/// What makes a tree of rows a linkage.
pub(super) struct Loops {
    pub halves: Vec<Half>,
    pub sides: Vec<Row>,
    pub modes: Vec<NamedMode>,
}

impl Loops {
    /// The linkage of a tree.
    pub fn linkage(self, mut tree: RowTree) -> Linkage {
        let closure = |(half, rows): (Half, &[Row])| {
            let side = |k: usize| Side { after: half.after[k], row: rows[k].clone() };
            Closure { left: side(0), right: side(1), name: half.name, span: half.span }
        };
        let closures = self.halves.into_iter().zip(self.sides.chunks_exact(2)).map(closure).collect();
        let poses = std::mem::take(&mut tree.poses);
        Linkage { tree, closures, modes: self.modes, poses }
    }
}

/// True for what is nothing but signs.
fn is_signs(text: &str) -> bool {
    !text.trim().is_empty() && text.trim().chars().all(|c| "+-−=x×∥".contains(c))
}

impl Reader<'_> {
    /// The closures, and their frames as drafts: the left and the right one of each.
    pub fn closures<'a>(
        &mut self,
        value: &'a Spanned<DeValue<'a>>,
        names: &[Option<String>],
        convention: Option<Convention>,
    ) -> (Vec<Half>, Vec<Draft<'a>>) {
        let (mut halves, mut drafts) = (vec![], vec![]);
        if convention.is_some_and(|c| c != Convention::Khalil) {
            self.out
                .error(value.span(), "closed loops stand in the convention khalil")
                .hint("convention = \"khalil\": each row names the row that it stands `after`");
            return (halves, drafts);
        }
        let Some(array) = self.array(value, "[[closures]]") else { return (halves, drafts) };
        if array.len() > MAX_ROWS / 2 {
            let message = format!("{} closures; {} are allowed", array.len(), MAX_ROWS / 2);
            self.out.error(value.span(), message);
            return (halves, drafts);
        }
        for item in array.iter() {
            let Some(fields) = self.table(item, "closures") else { continue };
            self.unknown_keys(&fields, &["name", "left", "right"], |key| {
                matches!(key, "after" | "theta" | "alpha" | "d" | "r" | "gamma" | "b")
                    .then(|| format!("`{key}` belongs to a side: left = {{ after = \"…\", {key} = … }}"))
            });
            let name = self.string(fields.get("name"));
            let mut sides = vec![];
            for key in ["left", "right"] {
                let Some(side) = fields.get(key) else {
                    self.out.error(fields.span.clone(), format!("a closure without `{key}`")).hint(
                        "left = { after = \"rod\", d = \"d3\", theta = \"p3\" } holds the variable of the cut joint, right = { after = \"forearm\", d = \"-d8\" } is constant",
                    );
                    continue;
                };
                let Some(inner) = self.table(side, key) else { continue };
                let after = match inner.get("after") {
                    Some(on) => self.row_named(on, names, names.len()).unwrap_or(None),
                    None => {
                        self.out
                            .error(side.span(), "on which row does this side stand?")
                            .hint("after = \"NAME\", or the number of a row; \"base\" is frame 0");
                        None
                    }
                };
                let draft = self.side(inner, side.span());
                sides.push((after, draft));
            }
            if let Ok([(left, a), (right, b)]) = <[_; 2]>::try_from(sides) {
                halves.push(Half { name, after: [left, right], span: item.span() });
                drafts.extend([a, b]);
            }
        }
        (halves, drafts)
    }

    /// Says what of the variables of closures cannot be: `variables` are those of the sides, `all` those of all rows, too.
    pub fn check_sides(
        &mut self,
        drafts: &[Cells],
        variables: &[Option<Variable>],
        all: &[Option<Variable>],
    ) {
        for (k, (cells, variable)) in drafts.iter().zip(variables).enumerate() {
            let moving = [&cells.theta, &cells.d].into_iter().flat_map(|c| &c.symbols);
            let moving = moving.filter(|s| variable_number(&s.0).is_some() || passive_number(&s.0).is_some());
            let Some((name, span)) = moving.into_iter().next() else { continue };
            if k % 2 == 1 {
                self.out
                    .error(
                        span.clone(),
                        format!("the right side of a closure is constant, and holds `{name}`"),
                    )
                    .hint("the variable of the cut joint stands on the left side");
                continue;
            }
            // What is wrong with how they are counted is said where they are counted.
            let is_another = || all.iter().flatten().any(|v| *v.symbol.name() == **name);
            let is_cut = variable.map_or_else(|| !is_another(), |v| is_passive(v.symbol));
            if !is_cut {
                self.out
                    .error(span.clone(), format!("`{name}` is not the variable of a cut joint"))
                    .hint("a joint that is cut is passive, and has a variable of its own: p1, p2, …; driven joints stand in [[joints]]");
            }
        }
    }

    /// Names of assembly modes.
    pub fn modes(
        &mut self,
        value: Option<&Spanned<DeValue>>,
        variables: &[Variable],
        parameters: &[String],
    ) -> Vec<NamedMode> {
        let Some(table) = value.and_then(|v| self.table(v, "modes")) else { return vec![] };
        let mut modes = vec![];
        for (name, value) in &table.entries {
            let Some(text) = self.string(Some(value)) else { continue };
            let told = match is_signs(&text) {
                true => Some(Told::Signs(text.trim().to_string())),
                false => self.relations(&text, value.span(), variables, parameters).map(Told::Relations),
            };
            if let Some(told) = told {
                let name = name.replace(|c: char| c.is_control(), " ");
                modes.push(NamedMode { name, told, span: value.span() });
            }
        }
        modes
    }

    fn relations(
        &mut self,
        text: &str,
        span: Range<usize>,
        variables: &[Variable],
        parameters: &[String],
    ) -> Option<Vec<(Symbol, Expr)>> {
        let mut all = vec![];
        for part in text.split([',', ';']) {
            let sides = part.split_once('=').map(|(left, right)| (left.trim(), right.trim()));
            let Some((left, right)) = sides else {
                self.out
                    .error(span, format!("`{}` tells no assembly mode", part.trim().escape_debug()))
                    .hint("what passive joints are in it, \"p1 = q6 - q2 - 90 deg\", or signs such as \"+-\", as `show` prints them");
                return None;
            };
            let symbol = Symbol::new(left);
            let Some(own) = variables.iter().find(|v| v.symbol == symbol && is_passive(v.symbol)) else {
                self.out.error(span, format!("there is no passive joint `{}`", left.escape_debug()));
                return None;
            };
            let place = Place { span: span.clone(), start: None };
            let read = read_cell(right, &place, &Style::plain(quantity_of(own.kind)), &mut self.out)?;
            let is_known = |name: &String| {
                let driven = variables.iter().any(|v| *v.symbol.name() == **name && !is_passive(v.symbol));
                driven || parameters.contains(name)
            };
            if let Some((name, _)) = read.symbols.iter().find(|s| !is_known(&s.0)) {
                let message = format!("`{name}` is neither a driven joint nor a parameter");
                self.out.error(span, message).hint("relations are in q1, q2, … and lengths");
                return None;
            }
            all.push((symbol, read.expr));
        }
        Some(all)
    }
}

/// The passive variables that stand in cells.
pub(super) fn passive_names(cells: &[Cells]) -> Vec<String> {
    let mut all: Vec<String> = vec![];
    for (name, _) in cells.iter().flat_map(Cells::all).flat_map(|c| &c.symbols) {
        if passive_number(name).is_some() && !all.contains(name) {
            all.push(name.clone());
        }
    }
    all
}

/// The head of a linkage in a file: what says that there is one.
pub(super) fn of<'a>(fields: &Fields<'a>) -> Option<&'a Spanned<DeValue<'a>>> {
    fields.get("closures")
}
