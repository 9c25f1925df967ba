//! Points for a teacher: a TOML file says which claims count how much.
//!
//! ```toml
//! title = "Exercise 3"
//! conditional = 0.5            # the share that a claim right under a condition earns
//!
//! [[items]]
//! name = "link transforms"
//! claims = ["A_1", "A_2"]      # left sides as printed; "*" stands for any letters
//! points = 4
//! whole = true                 # all or nothing; else each formula earns its share
//! ```

use super::Document;
use crate::failure::Failure;
use crate::terminal::{Align, decimals, table};
use denavit::description::line_column;
use denavit_check::{Claim, Standing};

/// One item of the sheet.
struct Item {
    name: String,
    claims: Vec<String>,
    points: f64,
    whole: bool,
}

/// What a rubric file says.
struct Rubric {
    title: Option<String>,
    conditional: f64,
    items: Vec<Item>,
}

/// The sheet: points for each item and their sum.
///
/// # Errors
/// What is wrong with the rubric file.
pub fn sheet(document: &Document, name: &str, text: &str) -> Result<String, Failure> {
    let rubric = read(name, text)?;
    let mut rows = vec![];
    let (mut earned, mut possible) = (0.0, 0.0);
    for item in &rubric.items {
        let plain: Vec<String> = item.claims.iter().map(|c| plain(c)).collect();
        let is_meant = |claim: &&Claim| plain.iter().any(|pattern| fits(pattern, &self::plain(&claim.name)));
        let claims: Vec<&Claim> = document.checked.claims.iter().filter(is_meant).collect();
        let shares: Vec<f64> = claims
            .iter()
            .flat_map(|c| &c.entries)
            .map(|e| match e.finding.standing() {
                Standing::Equal => 1.0,
                Standing::Conditional => rubric.conditional,
                _ => 0.0,
            })
            .collect();
        let share = match shares.len() {
            0 => 0.0,
            _ if item.whole => f64::from(u8::from(shares.iter().all(|s| *s == 1.0))),
            n => shares.iter().sum::<f64>() / n as f64,
        };
        let points = (share * item.points * 100.0).round() / 100.0;
        earned += points;
        possible += item.points;
        let right = shares.iter().filter(|s| **s == 1.0).count();
        let remark = match shares.len() {
            0 => "not in the document".to_string(),
            n => {
                let wrong: Vec<&str> = claims
                    .iter()
                    .filter(|c| c.standing() != Standing::Equal)
                    .map(|c| c.name.as_str())
                    .take(6)
                    .collect();
                let which =
                    if wrong.is_empty() { String::new() } else { format!(", not {}", wrong.join(", ")) };
                format!("{right} of {n} right{which}")
            }
        };
        rows.push(vec![item.name.clone(), decimals(points, 2), decimals(item.points, 2), remark]);
    }
    rows.push(vec!["sum".into(), decimals(earned, 2), decimals(possible, 2), String::new()]);
    let title = rubric.title.unwrap_or_else(|| document.name.to_string());
    let align = [Align::Left, Align::Right, Align::Right, Align::Left];
    Ok(format!("{title}\n{}", table(&["item", "points", "of", ""], &align, &rows)))
}

/// Letters and digits alone.
fn plain(name: &str) -> String {
    name.chars().filter(|c| c.is_alphanumeric() || *c == '*').collect()
}

/// Whether a name fits a pattern in which `*` stands for any letters.
fn fits(pattern: &str, name: &str) -> bool {
    let parts: Vec<&str> = pattern.split('*').collect();
    let (Some(first), Some(last)) = (parts.first(), parts.last()) else { return false };
    if parts.len() == 1 {
        return pattern == name;
    }
    let Some(mut rest) = name.strip_prefix(first) else { return false };
    for part in &parts[1..parts.len() - 1] {
        let Some(at) = rest.find(part) else { return false };
        rest = &rest[at + part.len()..];
    }
    rest.ends_with(last)
}

fn read(name: &str, text: &str) -> Result<Rubric, Failure> {
    let file: toml::Table = text.parse().map_err(|e: toml::de::Error| {
        let (line, column) = line_column(text, e.span().map_or(0, |s| s.start));
        Failure::Input(format!("{name}:{line}:{column}: error: {}", e.message()))
    })?;
    let mut errors = vec![];
    for key in file.keys().filter(|k| !matches!(k.as_str(), "title" | "conditional" | "items")) {
        errors.push(format!("`{key}` is not known; the keys are title, conditional and items"));
    }
    let number =
        |v: &toml::Value| v.as_float().or(v.as_integer().map(|n| n as f64)).filter(|x| x.is_finite());
    let conditional = match file.get("conditional") {
        None => 0.5,
        Some(v) => number(v).filter(|x| (0.0..=1.0).contains(x)).unwrap_or_else(|| {
            errors.push("`conditional` is a number from 0 to 1".into());
            0.5
        }),
    };
    let mut items = vec![];
    let listed = file.get("items").and_then(toml::Value::as_array).cloned().unwrap_or_default();
    for (n, value) in (1..).zip(&listed) {
        let get = |key: &str| value.get(key);
        let claims = match get("claims") {
            Some(toml::Value::String(one)) => Some(vec![one.clone()]),
            Some(toml::Value::Array(all)) => all.iter().map(|c| c.as_str().map(str::to_string)).collect(),
            _ => None,
        };
        match (claims, get("points").and_then(&number)) {
            (Some(claims), Some(points)) if points >= 0.0 => items.push(Item {
                name: get("name").and_then(|v| v.as_str()).map_or_else(|| claims.join(", "), str::to_string),
                claims,
                points,
                whole: get("whole").and_then(toml::Value::as_bool).unwrap_or(false),
            }),
            _ => errors.push(format!("item {n} needs `claims` (names) and `points` (a number)")),
        }
    }
    if listed.is_empty() {
        errors.push("there are no [[items]]".into());
    }
    if errors.is_empty() {
        let title = file.get("title").and_then(|v| v.as_str()).map(str::to_string);
        return Ok(Rubric { title, conditional, items });
    }
    let lines = errors.iter().map(|e| format!("{name}: error: {e}"));
    Err(Failure::Input(lines.collect::<Vec<_>>().join("\n")))
}

#[cfg(test)]
mod tests {
    use super::fits;

    #[test]
    fn patterns() {
        for (pattern, name, expected) in [
            ("T06", "T06", true),
            ("T06", "T16", false),
            ("t*", "t34", true),
            ("*x", "Px", true),
            ("n*z", "nyz", true),
            ("n*z", "nx", false),
        ] {
            assert_eq!(fits(pattern, name), expected, "{pattern} {name}");
        }
    }
}
