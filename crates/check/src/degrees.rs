//! Programs that have the angles of joints in degrees, and turn them by constants of their own: `j1 * RAD`, `atan2(s, c) * DEG`.

use denavit_reading::code::Dialect;
use denavit_symbolic::parse::parse;
use denavit_symbolic::vocabulary::Vocabulary;
use denavit_symbolic::{Expr, Node};
use std::collections::BTreeMap;
use std::ops::Range;

/// The names of constants that turn degrees into radians, and radians into degrees.
#[derive(Clone, Default, PartialEq, Eq, Debug)]
pub(crate) struct Conversions {
    pub per_degree: Vec<String>,
    pub per_radian: Vec<String>,
}

impl Conversions {
    /// Those that a program defines, `const float RAD = PI / 180.0`, `#define DEG (180/M_PI)`.
    fn defined(program: &str) -> Self {
        let mut found = Conversions::default();
        for line in program.lines().filter(|l| l.len() < 200) {
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
}

/// In what a function has the angles of joints.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Angles {
    Radians,
    Degrees,
    /// Nothing says which.
    Open,
}

/// A function by its head.
struct Function {
    span: Range<usize>,
    name: String,
    /// One of its parameters is an angle of a joint.
    takes: bool,
    /// It turns one into radians itself, not for another function.
    turns: bool,
    /// It hands one in radians to another function.
    hands: bool,
    /// A sine or cosine of one has no factor.
    is_plain: bool,
}

/// Where a program turns the angles of joints into radians by constants of its own, `cos(j1 * RAD)`: function by function, in its code alone.
pub(crate) struct Turned {
    pub constants: Conversions,
    functions: Vec<Function>,
    /// What stands outside of functions.
    script: Function,
    /// Functions that are called with joints in radians.
    given_radians: Vec<String>,
}

impl Turned {
    /// `program` is a text without comments, `functions` are those in it, with their heads.
    pub fn of(program: &str, functions: &[Range<usize>], is_angle: &dyn Fn(&str) -> bool) -> Self {
        let constants = Conversions::defined(program);
        let heads: Vec<(String, Vec<&str>)> =
            functions.iter().map(|f| head(program.get(f.clone()).unwrap_or_default())).collect();
        let own: Vec<&str> = heads.iter().map(|h| h.0.as_str()).collect();
        let mut given_radians = vec![];
        let mut read = |span: Range<usize>, source: &str, name: String, takes: bool| {
            let (mut turns, mut hands) = (false, false);
            for at in constants.per_degree.iter().flat_map(|c| turned(source, c, is_angle)) {
                match called(source, at, &own) {
                    Some(other) if other != name => {
                        hands = true;
                        given_radians.push(other.to_string());
                    }
                    _ => turns = true,
                }
            }
            let is_plain = has_plain_sine(source, &constants.per_degree, is_angle);
            Function { span, name, takes, turns, hands, is_plain }
        };
        let mut outside = program.as_bytes().to_vec();
        let mut all = vec![];
        for (span, (name, parameters)) in functions.iter().zip(&heads) {
            let source = program.get(span.clone()).unwrap_or_default();
            all.push(read(span.clone(), source, name.clone(), parameters.iter().any(|p| is_angle(p))));
            outside[span.clone()].fill(b' ');
        }
        let outside = String::from_utf8(outside).unwrap_or_default();
        let script = read(0..0, &outside, String::new(), false);
        Turned { constants, functions: all, script, given_radians }
    }

    /// True if some joint is turned somewhere.
    fn is_any(&self) -> bool {
        self.functions.iter().chain([&self.script]).any(|f| f.turns || f.hands)
    }

    /// The angles of the function at a place, of what stands outside of functions where there is none.
    pub fn angles(&self, span: Option<&Range<usize>>) -> Angles {
        let at = |s: &Range<usize>| {
            let own = self.functions.iter().filter(|f| f.span.start <= s.start && s.start < f.span.end);
            own.max_by_key(|f| f.span.start)
        };
        let f = span.and_then(at).unwrap_or(&self.script);
        let others_turn = self.functions.iter().any(|f| f.turns);
        match () {
            () if !self.is_any() => Angles::Radians,
            () if f.turns || f.hands => Angles::Degrees,
            () if f.takes && (!others_turn || self.given_radians.contains(&f.name)) => Angles::Radians,
            () if !others_turn && !self.script.turns => Angles::Radians,
            () if f.takes || f.is_plain => Angles::Open,
            () => Angles::Degrees,
        }
    }

    /// The angles of all functions, if they have one unit.
    pub fn of_all(&self) -> Angles {
        let own = |f: &Function| self.angles(Some(&f.span));
        let telling = self.functions.iter().filter(|f| f.takes || f.turns || f.is_plain);
        let mut all = telling.map(own);
        let Some(first) = all.next() else { return self.angles(None) };
        if all.all(|a| a == first) { first } else { Angles::Open }
    }
}

/// The name and the parameters of a function: `void f(float j1, float j2)`, `function [x, y] = f(j1, j2)`.
fn head(source: &str) -> (String, Vec<&str>) {
    let (left, rest) = source.split_once('(').unwrap_or((source, ""));
    let inside = rest.split_once(')').map_or("", |r| r.0);
    let name = names_in(left.trim_end().trim_end_matches('=')).last().unwrap_or_default();
    (name.into(), names_in(inside).collect())
}

fn is_part(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// Where a constant is a factor of angles: `j1 * RAD`, `RAD * (j1 + j2)`.
fn turned<'a>(
    source: &'a str,
    constant: &'a str,
    is_angle: &'a dyn Fn(&str) -> bool,
) -> impl Iterator<Item = usize> + 'a {
    let has_angle = move |part: &str| names_in(part).any(is_angle);
    source.match_indices(constant).map(|m| m.0).filter(move |&at| {
        let behind = &source[at + constant.len()..];
        if source[..at].ends_with(is_part) || behind.starts_with(is_part) {
            return false;
        }
        let before = source[..at].trim_end().strip_suffix('*').map_or("", str::trim_end);
        let left = match before.strip_suffix(')') {
            Some(inner) => opened(inner).map_or("", |open| &inner[open + 1..]),
            None => &before[before.trim_end_matches(is_part).len()..],
        };
        let after = behind.trim_start().strip_prefix('*').map_or("", str::trim_start);
        let right = match after.strip_prefix('(') {
            Some(inner) => &inner[..closed(inner)],
            None => after.split(|c| !is_part(c)).next().unwrap_or_default(),
        };
        has_angle(left) || has_angle(right)
    })
}

/// Where the bracket stands that is open at the end.
fn opened(source: &str) -> Option<usize> {
    let mut depth = 0_i32;
    source.char_indices().rev().take(LONGEST).find_map(|(i, c)| {
        depth += i32::from(c == ')') - i32::from(c == '(');
        (depth < 0).then_some(i)
    })
}

/// How long what stands before the bracket is that closes.
fn closed(source: &str) -> usize {
    let mut depth = 0_i32;
    let end = source.char_indices().take(LONGEST).find_map(|(i, c)| {
        depth += i32::from(c == '(') - i32::from(c == ')');
        (depth < 0).then_some(i)
    });
    end.unwrap_or(source.len())
}

/// The longest argument that is looked through, in characters, and in so many brackets.
const LONGEST: usize = 2_000;
const DEEPEST: usize = 60;

/// The function of the program in a call of which a place stands.
fn called<'a>(source: &'a str, at: usize, own: &[&'a str]) -> Option<&'a str> {
    let mut rest = &source[..at];
    for _ in 0..DEEPEST {
        let open = opened(rest)?;
        rest = &rest[..open];
        let word = &rest[rest.trim_end_matches(is_part).len()..];
        if own.contains(&word) {
            return Some(word);
        }
    }
    None
}

/// True if a sine, cosine or tangent of a joint has no constant as a factor.
fn has_plain_sine(source: &str, constants: &[String], is_angle: &dyn Fn(&str) -> bool) -> bool {
    ["sin", "cos", "tan"].iter().flat_map(|f| source.match_indices(f)).any(|(at, f)| {
        let rest = source[at + f.len()..].trim_start_matches('f');
        let Some(inner) = rest.strip_prefix('(') else { return false };
        let argument = &inner[..closed(inner)];
        names_in(argument).any(is_angle) && !names_in(argument).any(|w| constants.iter().any(|c| c == w))
    })
}

/// A text in which comments, texts in quotes and what is no program are blanks, in as many bytes.
pub(crate) fn code_alone(text: &str, blocks: &[Range<usize>], language: Dialect) -> String {
    let mut out: Vec<u8> = text.bytes().map(|b| if b == b'\n' { b } else { b' ' }).collect();
    let source = text.as_bytes();
    for block in blocks.iter().filter(|b| text.get((*b).clone()).is_some()) {
        let mut at = block.start;
        // What ends a comment or a text in quotes that is open.
        let mut until: Option<&[u8]> = None;
        while at < block.end {
            let rest = &source[at..block.end];
            if let Some(end) = until {
                if rest.starts_with(end) {
                    at += end.len();
                    until = None;
                } else {
                    at += 1;
                }
                continue;
            }
            let opens: &[(&[u8], &[u8])] = match language {
                Dialect::C => &[(b"//", b"\n"), (b"/*", b"*/"), (b"\"", b"\"")],
                Dialect::Python => {
                    &[(b"#", b"\n"), (b"\"\"\"", b"\"\"\""), (b"'''", b"'''"), (b"\"", b"\""), (b"'", b"'")]
                }
                Dialect::Matlab => &[(b"%", b"\n"), (b"#", b"\n")],
            };
            match opens.iter().find(|(open, _)| rest.starts_with(open)) {
                Some((open, end)) => {
                    at += open.len();
                    until = Some(end);
                }
                None => {
                    out[at] = source[at];
                    at += 1;
                }
            }
        }
    }
    String::from_utf8(out).unwrap_or_default()
}

/// Powers of degrees and of radians in a quantity.
type Unit = [i32; 2];
const NONE: Unit = [0, 0];
const DEGREES: Unit = [1, 0];
const RADIANS: Unit = [0, 1];

/// The units of the names of a function, formula by formula.
pub(super) struct Units<'a> {
    constants: &'a Conversions,
    is_joint: &'a dyn Fn(&str) -> bool,
    known: BTreeMap<String, Unit>,
}

impl<'a> Units<'a> {
    pub fn new(constants: &'a Conversions, is_joint: &'a dyn Fn(&str) -> bool) -> Self {
        Units { constants, is_joint, known: BTreeMap::new() }
    }

    /// True if a formula has one unit throughout, and that of a joint is degrees: each sine has radians, and each arctangent has one
    /// factor. Notes what its name then is.
    pub fn hold_in(&mut self, name: &str, formula: &str) -> bool {
        let Ok(value) = parse(&self.renamed(formula), &Vocabulary::new().open(true)) else { return false };
        let Some(unit) = self.of(value) else { return false };
        self.known.insert(name.into(), unit);
        self.known.extend(plain_name_of(name).map(|n| (n, unit)));
        !(self.is_joint)(name) || unit == DEGREES || unit == NONE
    }

    /// A formula in which names of the program that look like sines and cosines, `c2`, are names.
    fn renamed(&self, formula: &str) -> String {
        let mut out = String::with_capacity(formula.len());
        for part in formula.split_inclusive(|c: char| !is_part(c)) {
            let word = part.trim_end_matches(|c: char| !is_part(c));
            match plain_name_of(word).filter(|_| self.known.contains_key(word)) {
                Some(name) => out += &(name + &part[word.len()..]),
                None => out += part,
            }
        }
        out
    }

    fn of(&self, e: Expr) -> Option<Unit> {
        // What is a number is an angle in any unit only if it is 0.
        let mut units: BTreeMap<Expr, Unit> = BTreeMap::new();
        for e in Expr::postorder(&[e]) {
            let own = |e: Expr| units.get(&e).copied();
            let unit = match e.node() {
                Node::Number(_) | Node::Pi => NONE,
                Node::Symbol(s) => self.named(&s.name()),
                Node::Neg(a) => own(a)?,
                Node::Add(a, b) | Node::Sub(a, b) => self.sum((a, own(a)?), (b, own(b)?))?,
                Node::Mul(a, b) => [own(a)?[0] + own(b)?[0], own(a)?[1] + own(b)?[1]],
                Node::Div(a, b) => [own(a)?[0] - own(b)?[0], own(a)?[1] - own(b)?[1]],
                Node::Pow(a, n) => [own(a)?[0] * n, own(a)?[1] * n],
                Node::Sin(a) | Node::Cos(a) => {
                    (own(a)? == RADIANS || a.symbols().is_empty()).then_some(NONE)?
                }
                Node::Sqrt(a) | Node::Sign(a) => (own(a)? == NONE).then_some(NONE)?,
                Node::Atan2(y, x) => (own(y)? == NONE && own(x)? == NONE).then_some(RADIANS)?,
            };
            units.insert(e, unit);
        }
        units.get(&e).copied()
    }

    fn named(&self, name: &str) -> Unit {
        let is = |names: &[String]| names.iter().any(|n| n == name);
        match self.known.get(name) {
            _ if is(&self.constants.per_degree) => [-1, 1],
            _ if is(&self.constants.per_radian) => [1, -1],
            Some(unit) => *unit,
            None if (self.is_joint)(name) => DEGREES,
            None => NONE,
        }
    }

    /// A number is radians beside them, as it is written; beside degrees it is read as radians further on.
    fn sum(&self, (a, of_a): (Expr, Unit), (b, of_b): (Expr, Unit)) -> Option<Unit> {
        let is_number = |e: Expr| e.symbols().is_empty();
        match () {
            () if of_a == of_b || b.is_zero() => Some(of_a),
            () if a.is_zero() || (is_number(a) && of_b == RADIANS && of_a == NONE) => Some(of_b),
            () if is_number(b) && of_a == RADIANS && of_b == NONE => Some(of_a),
            () => None,
        }
    }
}

/// Another name for one that would be read as a sine or a cosine: `c2`, `S23`.
fn plain_name_of(name: &str) -> Option<String> {
    let digits = name.strip_prefix(['c', 's', 'C', 'S'])?;
    let letter = name.bytes().next()?;
    let is_one = !digits.is_empty() && digits.chars().all(|c| c.is_ascii_digit());
    is_one.then(|| format!("j{letter}{digits}"))
}

/// The names in a formula of a program.
pub(super) fn names_in(formula: &str) -> impl Iterator<Item = &str> {
    formula.split(|c: char| !c.is_alphanumeric() && c != '_').filter(|w| !w.is_empty())
}

/// Functions by which inverse formulas are told.
pub(super) const INVERSE: [&str; 7] = ["atan2", "arctan", "atan(", "acos", "arccos", "asin", "arcsin"];

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
    use super::{Angles, Conversions, Turned, Units, code_alone, without_factor};
    use denavit_reading::code::Dialect;

    const CONSTANTS: &str = "const float RAD = PI / 180.0;\n#define DEG (180/M_PI)\nconst float L = 3.0;\n";

    fn is_joint(name: &str) -> bool {
        matches!(name, "j1" | "j2")
    }

    #[test]
    fn constants_that_turn_degrees() {
        let found = Conversions::defined(CONSTANTS);
        assert_eq!(found.per_degree, ["RAD"]);
        assert_eq!(found.per_radian, ["DEG"]);
        for (formula, now) in
            [("sin(a * RAD)", "sin(a      )"), ("RAD * a", "      a"), ("xRAD * a", "xRAD * a")]
        {
            assert_eq!(without_factor(formula, "RAD"), now);
        }
    }

    #[test]
    fn each_function_has_angles_of_its_own() {
        use Angles::{Degrees, Open, Radians};
        let turns = "float f(float j1) { return cos(j1 * RAD); }";
        let sums = "float f(float j1, float j2) { return cos(RAD * (j1 + j2)); }";
        let plain = "float g(float j1) { return cos(j1); }";
        let of_globals = "float g() { return cos(j1); }";
        let hands = "float f(float j1) { return g(j1 * RAD); }";
        for (first, second, expected) in [
            (turns, plain, [Degrees, Open]),
            (sums, of_globals, [Degrees, Open]),
            (hands, plain, [Degrees, Radians]),
            (of_globals, plain, [Radians, Radians]),
            ("float f(float j1) { return cos(j1); /* j1 * RAD */ }", plain, [Radians, Radians]),
        ] {
            let text = format!("{CONSTANTS}{first}\n{second} // j2 * RAD\n");
            let at = text.find(first).unwrap();
            let next = text.find(second).unwrap();
            let functions = [at..at + first.len(), next..next + second.len()];
            let whole = 0..text.len();
            let program = code_alone(&text, std::slice::from_ref(&whole), Dialect::C);
            let turned = Turned::of(&program, &functions, &is_joint);
            assert_eq!([0, 1].map(|k| turned.angles(Some(&functions[k]))), expected, "{first}");
        }
    }

    #[test]
    fn formulas_have_one_unit() {
        let constants = Conversions::defined(CONSTANTS);
        let mut units = Units::new(&constants, &is_joint);
        assert!(units.hold_in("c2", "x/L") && units.hold_in("j1", "atan2(y, L + c2) * DEG"));
        for (formula, holds) in [
            ("(atan2(y, x) - atan2(L, x)) * DEG", true),
            ("atan2(y, x) * DEG - atan2(L * sin(j2 * RAD), x) * DEG", true),
            ("(atan2(y, x) - pi/2) * DEG", true),
            ("atan2(y, x) * DEG - atan2(L * sin(j2 * RAD), x)", false),
            ("atan2(y, x) * DEG - atan2(L * sin(j2 * RAD * RAD), x) * DEG", false),
            ("atan2(y, x) * DEG - 90", false),
            ("atan2(y, x)", false),
        ] {
            let mut units = Units::new(&constants, &is_joint);
            assert_eq!(units.hold_in("j1", formula), holds, "{formula}");
        }
    }
}
