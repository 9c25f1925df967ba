//! Formulas of inverse kinematics as the files in `sources/` hold them.

use denavit_symbolic::Expr;
use denavit_symbolic::parse::parse;
use denavit_symbolic::vocabulary::Vocabulary;
use toml::{Table, Value};

/// A cell that must be a string.
pub fn text(v: &Value) -> &str {
    v.as_str().unwrap_or_else(|| panic!("{v} is no string"))
}

/// The string under a key that must be there.
pub fn string<'a>(table: &'a Table, key: &str) -> &'a str {
    table.get(key).map(text).unwrap_or_else(|| panic!("no `{key}` in {table}"))
}

/// The tables under a key, none if it is missing.
pub fn list<'a>(table: &'a Table, key: &str) -> Vec<&'a Table> {
    let items = table.get(key).and_then(Value::as_array).into_iter().flatten();
    items.filter_map(Value::as_table).collect()
}

/// The strings under a key, none if it is missing.
pub fn strings(table: &Table, key: &str) -> Vec<String> {
    table.get(key).and_then(Value::as_array).into_iter().flatten().map(|v| text(v).to_string()).collect()
}

/// The formulas under a key, none if it is missing.
pub fn formulas(table: &Table, key: &str, names: &Vocabulary) -> Vec<Expr> {
    strings(table, key).iter().map(|f| read(f, names)).collect()
}

/// A formula, inverse functions of sines read as their principal values.
pub fn read(formula: &str, names: &Vocabulary) -> Expr {
    let formula = principal(formula);
    parse(&formula, names).unwrap_or_else(|errors| panic!("`{formula}`: {errors:?}"))
}

/// Writes arccos u as atan2(√(1−u²), u), and so on.
fn principal(formula: &str) -> String {
    let Some((at, name)) =
        ["arccos(", "arcsin(", "arctan("].iter().filter_map(|f| Some((formula.find(f)?, *f))).min()
    else {
        return formula.into();
    };
    let (before, rest) = (&formula[..at], &formula[at + name.len()..]);
    let mut depth = 1;
    let end = rest.find(|c| {
        depth += i32::from(c == '(') - i32::from(c == ')');
        depth == 0
    });
    let (inner, behind) = rest.split_at(end.expect("a closing bracket"));
    let (u, behind) = (principal(inner), principal(&behind[1..]));
    let meaning = match name {
        "arccos(" => format!("atan2(sqrt(1 - ({u})^2), {u})"),
        "arcsin(" => format!("atan2({u}, sqrt(1 - ({u})^2))"),
        _ => format!("atan2({u}, 1)"),
    };
    format!("{before}{meaning}{behind}")
}

/// A formula with each ± replaced by both signs, the first one slowest.
fn both_signs(formula: &str) -> Vec<String> {
    let Some((before, behind)) = formula.split_once('±') else { return vec![formula.into()] };
    let leads = before.trim_end().is_empty() || before.trim_end().ends_with(['(', ',']);
    let signs = [if leads { "" } else { "+" }, "-"];
    signs.iter().flat_map(|sign| both_signs(&format!("{before}{sign}{behind}"))).collect()
}

/// The printed values: for each, one formula per unknown.
pub fn values(table: &Table, names: &Vocabulary) -> Vec<Vec<Expr>> {
    let rows = table["values"].as_array().expect("values");
    let rows = rows.iter().map(|row| row.as_array().expect("one formula per unknown"));
    rows.flat_map(|row| {
        let cells: Vec<Vec<String>> = row.iter().map(|cell| both_signs(text(cell))).collect();
        assert!(cells.iter().filter(|c| c.len() > 1).count() <= 1, "signs that go together are written out");
        let count = cells.iter().map(Vec::len).max().unwrap_or(0);
        (0..count)
            .map(|k| cells.iter().map(|c| read(&c[k.min(c.len() - 1)], names)).collect())
            .collect::<Vec<Vec<Expr>>>()
    })
    .collect()
}
