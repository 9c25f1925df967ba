//! What lines of programs compute, so that none of them is passed over in silence.

use super::{MODULES, Region, regions};
use crate::degrees::names_in;
use denavit_reading::code::Dialect;
use std::collections::BTreeSet;
use std::ops::Range;

/// Lines of programs that compute something from the arguments of a function, or from joints: each with its name.
pub(crate) fn computed(
    text: &str,
    programs: &[(Range<usize>, Dialect)],
    is_joint: &dyn Fn(&str) -> bool,
) -> Vec<(Range<usize>, String)> {
    let mut found = vec![];
    for (span, language) in programs {
        let tests = tests(text, span);
        let named: BTreeSet<&str> =
            tests.iter().flat_map(|t| names_in(text.get(t.0.clone()).unwrap_or_default())).collect();
        for region in regions(text, span, *language) {
            let before = found.len();
            let mut moving: BTreeSet<String> =
                region.parameters.iter().filter(|p| !p.is_empty()).cloned().collect();
            for line in &region.lines {
                for (name, formula) in &line.parts {
                    let source = text.get(formula.clone()).unwrap_or_default();
                    let uses = |w: &str| moving.contains(w) || is_joint(w);
                    let is_told = names_in(source).any(uses);
                    // `*t = 0`: an output that does not move.
                    let is_output = text[..line.span.start].ends_with('*');
                    if !is_told && !is_output {
                        moving.remove(name);
                        // What a test expects, in numbers.
                        if named.contains(name.as_str()) && source.contains('[') {
                            found.push((line.span.start..formula.end, name.clone()));
                        }
                        continue;
                    }
                    moving.insert(name.clone());
                    if is_output || computes(source) && !is_abbreviation(name, source) {
                        found.push((line.span.start..formula.end, name.clone()));
                    }
                }
            }
            let more = [entries_beside(text, &region, &found[before..]), initialized(text, &region)].concat();
            found.extend(more);
        }
        found.extend(tests);
    }
    found
}

/// Arrays of C that are given their entries at once, `double M[3][3] = {{c1, -s1, 0}, …`.
fn initialized(text: &str, region: &Region) -> Vec<(Range<usize>, String)> {
    let Some(function) = &region.function else { return vec![] };
    let source = text.get(function.clone()).unwrap_or_default();
    let opened = |(at, _): (usize, &str)| {
        let head = source[..at].trim_end().strip_suffix(']')?;
        let line = head.rfind(['\n', ';', '{', '(']).map_or(head, |i| &head[i + 1..]);
        let name = line.split('[').next()?.rsplit([' ', '*']).next()?.to_string();
        let end = source[at..].find(';').map_or(source.len(), |i| at + i);
        let is_name = !name.is_empty() && name.chars().all(|c| c.is_alphanumeric() || c == '_');
        let computes = source[at..end].contains(char::is_alphabetic);
        let start = source[..at].rfind(&name)?;
        (is_name && computes).then(|| (function.start + start..function.start + end, name))
    };
    source.match_indices("= {").chain(source.match_indices("={")).filter_map(opened).collect()
}

/// What a function gives back under a bare name, beside others that compute something: `ds = vz`. And entries that are a bare name beside others that compute something: `M33 = mt` below `M11 = …`.
fn entries_beside(
    text: &str,
    region: &Region,
    found: &[(Range<usize>, String)],
) -> Vec<(Range<usize>, String)> {
    let family = |name: &str| {
        let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
        (stem.to_string(), name.len() - stem.len())
    };
    let families: BTreeSet<(String, usize)> =
        found.iter().map(|f| family(&f.1)).filter(|f| f.1 > 0).collect();
    let lines = region.lines.iter().flat_map(|l| l.parts.iter().map(move |p| (l.span.start..p.1.end, p)));
    let is_plain = |formula: &Range<usize>| {
        let source = text.get(formula.clone()).unwrap_or_default().trim();
        source.starts_with(char::is_alphabetic) && source.chars().all(|c| c.is_alphanumeric() || c == '_')
    };
    let is_new = |name: &str| !found.iter().any(|f| f.1 == name);
    let whole = region.function.clone().and_then(|f| text.get(f)).unwrap_or_default();
    let returned: BTreeSet<&str> =
        whole.lines().filter_map(|l| l.trim_start().strip_prefix("return ")).flat_map(names_in).collect();
    let gives_back = found.iter().any(|f| returned.contains(f.1.as_str()));
    let is_beside = |name: &str| families.contains(&family(name)) || gives_back && returned.contains(name);
    let beside = lines.filter(|(_, (name, f))| is_beside(name) && is_new(name) && is_plain(f));
    beside.map(|(span, (name, _))| (span, name.clone())).collect()
}

/// The comparisons of tests, `np.testing.assert_allclose(T, expected)`, with what they are called.
fn tests(text: &str, span: &Range<usize>) -> Vec<(Range<usize>, String)> {
    const CALLS: [&str; 5] = ["assert", "EXPECT_", "ASSERT_", "CHECK", "REQUIRE"];
    let program = text.get(span.clone()).unwrap_or_default();
    let test = |line: Range<usize>| {
        let source = program.get(line.clone())?;
        let bare = source.trim();
        let name = bare.split(['(', ' ']).next().unwrap_or_default();
        let last = name.rsplit('.').next().unwrap_or_default();
        let is_called = bare[name.len()..].starts_with('(') || last == "assert";
        let is_test = is_called && CALLS.iter().any(|c| last.starts_with(c));
        let start = span.start + line.start + (source.len() - source.trim_start().len());
        is_test.then(|| (start..start + bare.len(), last.to_string()))
    };
    crate::lines::lines(program).filter_map(test).collect()
}

/// True for `c12 = cos(q1 + q2)`.
fn is_abbreviation(name: &str, source: &str) -> bool {
    let plain = source.trim_start();
    let bare = MODULES.iter().find_map(|m| plain.strip_prefix(m)).unwrap_or(plain);
    name.to_lowercase().starts_with(['c', 's']) && (bare.starts_with("cos") || bare.starts_with("sin"))
}

/// True for a formula that is more than a name, a number or the call of a function.
fn computes(source: &str) -> bool {
    let plain = source.trim();
    let has_operator = plain.trim_start_matches(['-', '+']).contains(['+', '-', '*', '/']);
    let is_text = plain.contains(['"', '\'', '{']);
    (has_operator || ["sin(", "cos(", "tan(", "sqrt("].iter().any(|f| plain.contains(f))) && !is_text
}
