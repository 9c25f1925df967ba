//! Rates of joints that words give, and the numbers of the hand's motion that have a letter of their own: ω, v.

use super::told::List;
use super::{Scalar, Walk};
use denavit::description::JointKind;
use denavit_symbolic::Expr;

/// Units of rates.
const UNITS: [&str; 8] = ["rad/s", "deg/s", "°/s", "grad/s", "1/s", "mm/s", "cm/s", "m/s"];
/// What stands between two numbers of a list.
const BETWEEN: [&str; 8] = ["and", "und", "et", "y", "e", "en", "i", "и"];
/// Words of numbers that are not those of a motion.
const LIMITS: [&str; 8] = ["limit", "max", "grenz", "least", "most", "höchst", "at first", "between"];
/// Words that say that no other joint moves.
const ALONE: [&str; 12] =
    ["only", "alone", "nur ", "allein", "seul", "solo", "sola", "sólo", "apenas", "alleen", "just ", "tylko"];
/// Words before the number of a joint.
const JOINT: [&str; 16] = [
    "joint",
    "axis",
    "axe",
    "gelenk",
    "achse",
    "eje",
    "asse",
    "giunto",
    "junta",
    "articulation",
    "articulación",
    "articulacion",
    "eixo",
    "motor",
    "gewricht",
    "as",
];

/// Words that say that joints do not move.
const STILL: [&str; 14] = [
    "parad", "at rest", "still", "locked", "not move", "fixed", "ruht", "ruhen", "fest", "ferm", "quiet",
    "bloqu", "immobile", "stil",
];

/// The place of the joint, from 0, that the first ordinal of some words names: `on the second axis`.
fn ordinal(words: &str) -> Option<usize> {
    const ORDINALS: [&[&str]; 4] = [
        &["first", "erste", "premi", "primer", "primeir", "prima", "primo", "eerste"],
        &["second", "zweite", "deuxi", "segund", "seconda", "tweede"],
        &["third", "dritte", "troisi", "tercer", "terceir", "terza", "terzo", "derde"],
        &["fourth", "vierte", "quatri", "cuart", "quart", "vierde"],
    ];
    let lower = words.to_lowercase();
    let mut said = lower.split(|c: char| !c.is_alphabetic()).filter(|w| w.len() > 4);
    said.find_map(|w| ORDINALS.iter().position(|all| all.iter().any(|o| w.starts_with(o))))
}

/// A number with its unit, if it has one, and where both stand.
struct Quantity<'a> {
    number: &'a str,
    unit: Option<&'a str>,
    start: usize,
    end: usize,
}

impl Walk<'_> {
    /// Reads rates of joints: `the rates 0.4, -0.2 and 0.3 rad/s`, `6 rad/s on axis 1 alone`.
    pub(super) fn told_speeds(&mut self, line: &str) {
        let lower = line.to_lowercase();
        if !UNITS.iter().any(|u| line.contains(u)) || LIMITS.iter().any(|w| lower.contains(w)) {
            return;
        }
        let kinds: Vec<JointKind> = self.subject.description.variables().iter().map(|v| v.kind).collect();
        let n = kinds.len();
        if self.told_one_by_one(line, &kinds) {
            return;
        }
        // `0.5 m/s` is none of a joint that turns.
        let fits = |kind: JointKind, unit: &str| unit.ends_with("m/s") == (kind == JointKind::Prismatic);
        for run in runs(line) {
            // Numbers in a row share the unit of the last.
            let Some(last) = run.last().and_then(|q| q.unit) else { continue };
            let text = |q: &Quantity| format!("{} {}", q.number, q.unit.unwrap_or(last));
            let values: Vec<String> = run.iter().map(text).collect();
            let values: Vec<&str> = values.iter().map(String::as_str).collect();
            let units: Vec<&str> = run.iter().map(|q| q.unit.unwrap_or(last)).collect();
            if values.len() == n && n > 1 {
                if kinds.iter().zip(&units).all(|(kind, unit)| fits(*kind, unit)) {
                    self.assign_list(List::Rates, &values);
                }
                continue;
            }
            let alone = ALONE.iter().any(|w| lower.contains(w));
            let joint = joint_named(&lower).filter(|k| (1..=n).contains(k) && fits(kinds[k - 1], last));
            if let (true, [value], Some(joint)) = (alone, &values[..], joint) {
                let mut all = vec!["0"; n];
                all[joint - 1] = value;
                self.assign_list(List::Rates, &all);
            }
        }
    }

    /// Rates that words give joint by joint, each by an ordinal or a number behind it or a name before it: `0.8 rad/s na primeira
    /// junta e 0.5 rad/s na segunda`, `0.5 rad/s on joint 1`, `q1 at 10 °/s, q2 and q3 at rest`. Joints of which nothing is said keep
    /// their rates, and are still where words say so.
    fn told_one_by_one(&mut self, line: &str, kinds: &[JointKind]) -> bool {
        let all: Vec<Quantity> = runs(line).into_iter().flatten().collect();
        let quantities: Vec<&Quantity> = all.iter().filter(|q| q.unit.is_some()).collect();
        let mut given: Vec<Option<String>> = vec![None; kinds.len()];
        for (k, q) in quantities.iter().enumerate() {
            let unit = q.unit.unwrap_or_default();
            let next = quantities.get(k + 1).map_or(line.len(), |n| n.start);
            let behind = line.get(q.end..next).unwrap_or_default();
            let before = line.get(..q.start).unwrap_or_default();
            let by_number = || joint_named(&behind.to_lowercase())?.checked_sub(1);
            let joint = ordinal(behind).or_else(by_number).or_else(|| self.joint_before(before));
            let Some(joint) = joint else { return false };
            let fits =
                kinds.get(joint).is_some_and(|kind| unit.ends_with("m/s") == (*kind == JointKind::Prismatic));
            if !fits || given[joint].is_some() {
                return false;
            }
            given[joint] = Some(format!("{} {unit}", q.number));
        }
        if quantities.is_empty() {
            return false;
        }
        let lower = line.to_lowercase();
        let rests = STILL.iter().chain(&ALONE).any(|w| lower.contains(w));
        let rates = self.subject.rates();
        for (rate, value) in rates.iter().zip(&given) {
            let told = value.as_deref().or(Some("0").filter(|_| rests));
            if let (Some(symbol), Some(value)) = (rate.as_symbol(), told.and_then(|v| self.constant(v))) {
                self.at.give(symbol, value);
            }
        }
        true
    }

    /// The joint whose name stands before a number, with a short word between: `q1 a`, `θ2 mit`.
    fn joint_before(&self, before: &str) -> Option<usize> {
        const WITH: [&str; 9] = ["a", "at", "mit", "with", "con", "com", "à", "met", "bei"];
        let mut words = before.split_whitespace().rev();
        let name = words.next().filter(|w| WITH.contains(w)).and(words.next())?;
        let value = self.lexis.names.lookup(name.trim_matches(['`', '$', ',', '(']))?;
        self.subject.joints().iter().position(|q| *q == value)
    }

    /// What a lone letter is by the unit of its number, where the joints' rates are known: ω of an arm whose hand turns about one
    /// direction, v as the size of the hand's velocity.
    pub(super) fn of_motion(&self, read: &[Scalar]) -> Option<Expr> {
        let [Scalar::Lone(name), Scalar::Formula(span, syntax)] = read else { return None };
        let source = self.source(span);
        let has = |units: &[&str]| units.iter().any(|u| source.trim_end_matches(['.', ',']).ends_with(u));
        let rates = self.subject.rates();
        let is_known = rates.iter().all(|r| r.as_symbol().is_some_and(|s| self.at.length(s).is_some()));
        if !syntax.value().symbols().is_empty() || !name.is_bare() || !is_known {
            return None;
        }
        let velocity = self.subject.velocity();
        match name.base.as_str() {
            "ω" | "w" | "omega" | "Ω" | "W" if has(&["rad/s", "deg/s", "°/s", "1/s"]) => {
                let mut turning = velocity[3..].iter().filter(|e| !e.is_zero());
                turning.next().copied().filter(|_| turning.next().is_none())
            }
            "v" | "V" | "speed" | "SPEED" if has(&["m/s"]) => {
                let squares = velocity[..3].iter().fold(Expr::int(0), |sum, e| sum + e.powi(2));
                Some(squares.sqrt())
            }
            _ => None,
        }
    }
}

/// The numbers of a line that stand in a row.
fn runs(line: &str) -> Vec<Vec<Quantity<'_>>> {
    let mut found: Vec<Vec<Quantity>> = vec![];
    let mut at = 0;
    while let Some(q) = next_quantity(line, at) {
        at = q.end;
        let goes_on = found.last().and_then(|run| run.last()).is_some_and(|p| {
            let between = line[p.end..q.start].trim().trim_matches([',', ';']).trim();
            between.is_empty() && line[p.end..q.start].contains([',', ';']) || BETWEEN.contains(&between)
        });
        match found.last_mut().filter(|_| goes_on) {
            Some(run) => run.push(q),
            None => found.push(vec![q]),
        }
    }
    found
}

/// The next number of a line that is no part of a name and no side of an equation.
fn next_quantity(line: &str, from: usize) -> Option<Quantity<'_>> {
    let bytes = line.as_bytes();
    let mut at = from;
    loop {
        let digit = at + line.get(at..)?.find(|c: char| c.is_ascii_digit())?;
        let length =
            line[digit..].find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(line.len() - digit);
        let digits = line[digit..digit + length].trim_end_matches('.');
        let mut start = digit;
        for sign in ["-", "−", "+"] {
            if line[..digit].ends_with(sign) && start == digit {
                start -= sign.len();
            }
        }
        let before = line[..start].trim_end();
        let is_part = line[..start].ends_with(|c: char| c.is_alphanumeric() || "_{^.".contains(c));
        at = digit + length.max(1);
        // `joint 2` is a name.
        let last = before.rsplit(|c: char| !c.is_alphanumeric()).next().unwrap_or_default().to_lowercase();
        let is_name = JOINT.contains(&last.as_str());
        if is_part || is_name || before.ends_with('=') || bytes.get(digit + digits.len()) == Some(&b'_') {
            continue;
        }
        let rest = &line[digit + digits.len()..];
        let bare = rest.trim_start_matches([' ', '~', '\\', ',', '{']);
        let bare = ["mathrm{", "text{", "rm "].iter().fold(bare, |b, w| b.strip_prefix(w).unwrap_or(b));
        let gap = rest.len() - bare.len();
        let unit = UNITS.iter().copied().find(|u| bare.starts_with(u)).filter(|_| !rest.starts_with(','));
        let end = digit + digits.len() + unit.map_or(0, |u| gap + u.len());
        return Some(Quantity { number: &line[start..digit + digits.len()], unit, start, end });
    }
}

/// The number behind the word for a joint, the only one of a line.
fn joint_named(line: &str) -> Option<usize> {
    let words: Vec<&str> = line.split(|c: char| !c.is_alphanumeric()).filter(|w| !w.is_empty()).collect();
    let mut named = words.windows(2).filter(|w| JOINT.contains(&w[0])).filter_map(|w| w[1].parse().ok());
    let first = named.next()?;
    named.all(|k: usize| k == first).then_some(first)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_in_a_row() {
        for (line, expected) in [
            ("Rates of 0.3, -0.4 and 0.2 rad/s give", vec!["0.3", "-0.4", "0.2 rad/s"]),
            ("were 0.5 rad/s, -0.1 m/s and 0.2 m/s. Jacobian", vec!["0.5 rad/s", "-0.1 m/s", "0.2 m/s"]),
            ("avec 6 rad/s sur l'axe 1 seul", vec!["6 rad/s"]),
            ("q1 = 0.3 rad/s", vec![]),
            ("0.5 rad/s on joint 1 and -0.3 rad/s on joint 2", vec!["0.5 rad/s"]),
        ] {
            let runs = runs(line);
            let shown: Vec<String> = runs
                .first()
                .into_iter()
                .flatten()
                .map(|q| [q.number].into_iter().chain(q.unit).collect::<Vec<_>>().join(" "))
                .collect();
            assert_eq!(shown, expected, "{line}");
        }
        assert_eq!(joint_named("with 6 rad/s on axis 1 alone"), Some(1));
        assert_eq!(joint_named("joint 1 and joint 2"), None);
    }
}
