//! Programs that have the angles of joints in degrees, and turn them by constants of their own: `j1 * RAD`, `atan2(s, c) * DEG`.

use std::ops::Range;

/// The names of constants that turn degrees into radians, and radians into degrees.
#[derive(Clone, Default, PartialEq, Eq, Debug)]
pub(crate) struct Conversions {
    pub per_degree: Vec<String>,
    pub per_radian: Vec<String>,
}

impl Conversions {
    /// Those that a program defines, `const float RAD = PI / 180.0`, `#define DEG (180/M_PI)`, if it turns a joint into radians by one of
    /// them: else its joints may be in radians.
    pub fn of(text: &str, span: &Range<usize>, is_angle: &dyn Fn(&str) -> bool) -> Self {
        let found = Conversions::defined(text, span);
        let program = text.get(span.clone()).unwrap_or_default();
        let is_part = |c: char| c.is_alphanumeric() || c == '_';
        let turns = |constant: &String| {
            program.match_indices(constant.as_str()).any(|(at, _)| {
                let before =
                    program[..at].trim_end().strip_suffix('*').map(str::trim_end).unwrap_or_default();
                let name = &before[before.trim_end_matches(is_part).len()..];
                let behind =
                    program[at + constant.len()..].trim_start().strip_prefix('*').unwrap_or_default();
                let next = behind.trim_start().split(|c| !is_part(c)).next().unwrap_or_default();
                is_angle(name) || is_angle(next)
            })
        };
        if found.per_degree.iter().any(turns) { found } else { Conversions::default() }
    }

    fn defined(text: &str, span: &Range<usize>) -> Self {
        let mut found = Conversions::default();
        for line in text.get(span.clone()).unwrap_or_default().lines().filter(|l| l.len() < 200) {
            for part in line.split([';', ',']) {
                let told = match part.trim_start().strip_prefix("#define ") {
                    Some(rest) => rest.trim().split_once(char::is_whitespace),
                    None => part.split_once('='),
                };
                let Some((left, right)) = told else { continue };
                let name = left.trim().rsplit([' ', '*']).next().unwrap_or_default();
                let is_name = name.starts_with(char::is_alphabetic)
                    && name.chars().all(|c| c.is_alphanumeric() || c == '_');
                if !is_name {
                    continue;
                }
                match plain(right).as_str() {
                    "pi/180" => found.per_degree.push(name.into()),
                    "180/pi" => found.per_radian.push(name.into()),
                    _ => {}
                }
            }
        }
        found
    }

    pub fn is_empty(&self) -> bool {
        self.per_degree.is_empty() && self.per_radian.is_empty()
    }

    pub fn names(&self) -> impl Iterator<Item = &String> {
        self.per_degree.iter().chain(&self.per_radian)
    }

    /// True if all angles of joints of a function are in degrees: what gives one its value turns it into degrees, and each sine of one
    /// turns it into radians.
    pub(super) fn hold_in<'a>(
        &self,
        text: &str,
        mut parts: impl Iterator<Item = &'a (String, Range<usize>)>,
        is_joint: &dyn Fn(&str) -> bool,
    ) -> bool {
        parts.all(|(name, formula)| {
            let source = &text[formula.clone()];
            let gives = is_joint(name) && INVERSE.iter().any(|f| source.contains(f));
            (!gives || has_word(source, &self.per_radian)) && self.turns_all(source, is_joint)
        })
    }

    /// True if each sine and cosine of joints has a factor that turns degrees into radians.
    fn turns_all(&self, source: &str, is_joint: &dyn Fn(&str) -> bool) -> bool {
        ["sin", "cos", "tan"].iter().flat_map(|f| source.match_indices(f)).all(|(at, f)| {
            let rest = source[at + f.len()..].trim_start_matches('f');
            let Some(inner) = rest.strip_prefix('(') else { return true };
            let mut depth = 1_i32;
            let end = inner.char_indices().find_map(|(i, c)| {
                depth += i32::from(c == '(') - i32::from(c == ')');
                (depth == 0).then_some(i)
            });
            let argument = &inner[..end.unwrap_or(inner.len())];
            !names_in(argument).any(is_joint) || has_word(argument, &self.per_degree)
        })
    }
}

/// The names in a formula of a program.
pub(super) fn names_in(formula: &str) -> impl Iterator<Item = &str> {
    formula.split(|c: char| !c.is_alphanumeric() && c != '_').filter(|w| !w.is_empty())
}

/// Functions by which inverse formulas are told.
pub(super) const INVERSE: [&str; 7] = ["atan2", "arctan", "atan(", "acos", "arccos", "asin", "arcsin"];

fn has_word(source: &str, names: &[String]) -> bool {
    names_in(source).any(|w| names.iter().any(|n| n == w))
}

/// A constant without what spelling adds: `(float)(M_PI / 180.0)` is `pi/180`.
fn plain(source: &str) -> String {
    let source = source.split("//").next().unwrap_or_default();
    let source = source.split("/*").next().unwrap_or_default();
    let bare: String = source.chars().filter(|c| !c.is_whitespace() && !matches!(c, '(' | ')')).collect();
    let bare = bare.to_lowercase().replace("180.0f", "180").replace("180.0", "180").replace("180.f", "180");
    let bare = bare.trim_end_matches('.').replace("180./", "180/");
    ["m_pi", "math.pi", "np.pi", "std::numbers::pi", "π"].iter().fold(bare, |b, word| b.replace(word, "pi"))
}

/// A formula without a constant as a factor, in as many bytes: `(a + b) * RAD` is `(a + b)`.
pub(super) fn without_factor(text: &str, name: &str) -> String {
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(i) = rest.find(name) {
        let behind = &rest[i + name.len()..];
        let is_word = !rest[..i].ends_with(is_part) && !behind.starts_with(is_part);
        out += &rest[..i];
        let head = out.trim_end().len();
        let star = behind.len() - behind.trim_start().len();
        if is_word && out[..head].ends_with('*') {
            let length = out.len() - (head - 1) + name.len();
            out.truncate(head - 1);
            out.push_str(&" ".repeat(length));
            rest = behind;
        } else if is_word && behind[star..].starts_with('*') {
            out.push_str(&" ".repeat(name.len() + star + 1));
            rest = &behind[star + 1..];
        } else {
            out += name;
            rest = behind;
        }
    }
    out + rest
}

#[cfg(test)]
mod tests {
    use super::{Conversions, without_factor};

    #[test]
    fn constants_that_turn_degrees() {
        let text = "const float RAD = PI / 180.0;\n#define DEG (180/M_PI)\nconst float L = 3.0;\n";
        let found = Conversions::of(text, &(0..text.len()), &|name| name == "j1");
        assert_eq!(found, Conversions::default(), "no joint is turned");
        let text = format!("{text}x = cos(j1 * RAD);\n");
        let found = Conversions::of(&text, &(0..text.len()), &|name| name == "j1");
        assert_eq!(found.per_degree, ["RAD"]);
        assert_eq!(found.per_radian, ["DEG"]);
        for (formula, now) in
            [("sin(a * RAD)", "sin(a      )"), ("RAD * a", "      a"), ("xRAD * a", "xRAD * a")]
        {
            assert_eq!(without_factor(formula, "RAD"), now);
        }
    }
}
