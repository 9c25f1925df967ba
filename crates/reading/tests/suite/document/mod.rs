//! The reader of documents holds whatever text it is given: it does not panic, its places lie in the text, and it
//! takes time in proportion.

mod pieces;

use denavit_reading::document::{Document, Format, Part, formula, read, sides};
use std::ops::Range;
use std::time::{Duration, Instant};

const FORMATS: [Format; 4] = [Format::Markdown, Format::Latex, Format::Plain, Format::Toml];

/// Numbers that look random: xorshift64*, Vigna 2016.
struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 33) as usize % n.max(1)
    }
}

const TOKENS: [&str; 96] = [
    "$",
    "$$",
    "\n",
    "\n\n",
    "\r\n",
    " ",
    "  ",
    "\t",
    "=",
    ":=",
    "≡",
    "\\approx",
    "&",
    "\\\\",
    "\\\\[4pt]",
    "\\cr",
    "(",
    ")",
    "[",
    "]",
    "{",
    "}",
    "\\{",
    "\\}",
    "\\left(",
    "\\right)",
    "\\left\\{",
    "\\right.",
    "\\left[",
    "\\right]",
    "\\begin{bmatrix}",
    "\\end{bmatrix}",
    "\\begin{array}{ll}",
    "\\end{array}",
    "\\begin{align}",
    "\\end{align}",
    "\\begin{cases}",
    "\\end{cases}",
    "\\begin{split}",
    "\\end{split}",
    "\\begin{pmatrix}",
    "\\end{pmatrix}",
    "\\underbrace",
    "_{T_{45}}",
    "^{-1}",
    "_",
    "^",
    "\\frac{a}{b}",
    "\\text{and}",
    "\\text{",
    "\\quad",
    "\\ ",
    "\\,",
    "x",
    "T_{06}",
    "c1",
    "-s1",
    "0",
    "1.5",
    "a + b",
    "\\theta_2",
    "θ",
    "⁰T₆",
    "⎡",
    "⎤",
    "⎢",
    "⎥",
    "⎣",
    "⎦",
    "|",
    "|---|",
    "```",
    "```python",
    "`",
    "``",
    "<!-- check: a -->",
    "<!--",
    "-->",
    "% check: b",
    "# check: c",
    "%",
    "#",
    "# H",
    "- ",
    "t11: ",
    "(3) ",
    ";",
    ",",
    ".",
    "...",
    "\\",
    "\0",
    "\u{200b}",
    "\u{feff}",
    "或",
    "\"",
];

/// Whether every place lies in the text, on the ends of characters, and what is found can be read again.
fn sound(text: &str, document: &Document) {
    let inside = |span: &Range<usize>| assert!(text.get(span.clone()).is_some(), "{span:?} in {text:?}");
    for s in &document.statements {
        inside(&s.span);
        assert_eq!(s.relations.len() + 1, s.sides.len(), "{s:?} in {text:?}");
        [&s.heading, &s.prose, &s.label, &s.link, &s.aside].into_iter().flatten().for_each(inside);
        s.directives.iter().for_each(|d| inside(&d.span));
        for side in &s.sides {
            inside(&side.span);
            for part in &side.parts {
                inside(part.span());
                assert_eq!(formula(text, part.span()).len(), part.span().len());
                sides(text, part.span()).iter().for_each(inside);
                if let Part::Matrix(grid) = part {
                    grid.rows.iter().flatten().for_each(inside);
                    grid.under.iter().for_each(inside);
                }
            }
        }
    }
    document.notes.iter().for_each(|n| inside(&n.span));
    document.directives.iter().for_each(|d| inside(&d.span));
    document.code.iter().for_each(|c| inside(&c.span));
}

#[test]
fn any_text_is_read() {
    let mut random = Random(0x1234_5678_9abc_d0f1);
    for _ in 0..rounds() {
        let length = 1 + random.below(80);
        let text: String = (0..length).map(|_| TOKENS[random.below(TOKENS.len())]).collect();
        FORMATS.iter().for_each(|&f| sound(&text, &read(&text, f)));
    }
}

fn rounds() -> usize {
    if cfg!(debug_assertions) { 3000 } else { 20_000 }
}

#[test]
fn damaged_documents_are_read() {
    let source = concat!(
        include_str!("../../../../../examples/documents/ur3.md"),
        include_str!("../../../../../examples/documents/prrrrp.md")
    );
    let chars: Vec<char> = source.chars().collect();
    let mut random = Random(0xfeed_beef_0bad_cafe);
    for _ in 0..rounds() / 20 {
        let mut text = chars.clone();
        for _ in 0..1 + random.below(8) {
            let at = random.below(text.len());
            match random.below(4) {
                0 if text.len() > 1 => drop(text.remove(at)),
                1 => drop(text.splice(at..at, TOKENS[random.below(TOKENS.len())].chars())),
                2 => text.truncate(at.max(1)),
                _ => {
                    let end = (at + random.below(200)).min(text.len());
                    let piece: Vec<char> = text[at..end].to_vec();
                    let to = random.below(text.len());
                    drop(text.splice(to..to, piece));
                }
            }
        }
        let text: String = text.into_iter().collect();
        FORMATS.iter().for_each(|&f| sound(&text, &read(&text, f)));
    }
}

/// Pieces that are bad for readers if they are repeated.
const REPEATED: [&str; 48] = [
    "x = (\n",
    "\\[ ",
    "\\( ",
    "$a",
    "$$ a = b\n```\n",
    "\\begin{align} ",
    "` `` ``` ",
    "a, ",
    "x = a, ",
    "\\quad ",
    "= a\n",
    "| a |\n",
    "[ a\n",
    "T =\n\n",
    "\\text{",
    "\\left( ",
    "( ] ",
    "{ ) ",
    "- x\n",
    "a = b\n",
    "<!-- check: ",
    "check: ",
    "% check: x\n",
    "t1: ",
    "> ",
    "1. ",
    "x = [a b; ",
    "x = a = b = ",
    "$a = b$ ",
    "\\begin{equation*} ",
    "\\verb|",
    "\\verb|$",
    "```\n",
    "x = \\begin{bmatrix} a & ",
    "⎡ a ⎤\n",
    "a\n=\n",
    "[[",
    "x_",
    "a = [\n\n",
    "$$a=b$$\n$$=c$$\n",
    "a =\n",
    "\"\"\"",
    "[a]\n",
    "x = 1\n",
    "[a.b]\n",
    "x = [",
    "a b c d ",
    "a;b,",
];

#[test]
fn time_is_in_proportion_to_the_text() {
    let size = if cfg!(debug_assertions) { 1 << 19 } else { 1 << 20 };
    let fill = |piece: &str| piece.repeat(size / piece.len() + 1);
    let long = ["a & ", "( a, ", "\\quad ", "a, b; ", "a = "]
        .map(|p| format!("$$ x = {} $$\n", p.repeat(250_000 / p.len())));
    let pieces = TOKENS.iter().chain(&REPEATED).copied().chain(long.iter().map(String::as_str));
    for text in pieces.map(fill) {
        FORMATS.iter().for_each(|&f| in_time(&text, f));
    }
}

#[test]
fn five_megabytes_take_less_than_two_seconds() {
    let mut random = Random(42);
    let mut text = String::new();
    while text.len() < 5 << 20 {
        let piece = if random.below(2) == 0 { REPEATED[random.below(48)] } else { TOKENS[random.below(96)] };
        let times = 1 << random.below(12);
        text.push_str(&piece.repeat(times));
    }
    FORMATS.iter().for_each(|&f| in_time(&text, f));
}

fn in_time(text: &str, format: Format) {
    let start = Instant::now();
    let document = read(text, format);
    let taken = start.elapsed();
    let limit = Duration::from_secs(if cfg!(debug_assertions) { 20 } else { 2 });
    assert!(taken < limit, "{taken:?} for {format:?} {:?}", text.chars().take(40).collect::<String>());
    assert!(document.statements.len() <= 20_000 + 400 && document.notes.len() <= 1002);
}
