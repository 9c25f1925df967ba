//! The names that a formula may use, and what they mean.

use crate::expr::{Expr, Symbol};
use std::collections::BTreeMap;
use std::rc::Rc;

/// Known symbols, numbered angles, and how to read what is not declared.
///
/// ```
/// use denavit_symbolic::{Expr, Symbol, vocabulary::Vocabulary};
/// let names = Vocabulary::new()
///     .symbol("RL4")
///     .alias("R4", Expr::symbol("RL4"))
///     .angle(2, Symbol::new("q2"))
///     .angle(3, Symbol::new("q3"));
/// assert_eq!(names.lookup("θ2"), Some(Expr::symbol("q2")));
/// assert_eq!(names.number_of(Symbol::new("q3")), Some(3));
/// ```
#[derive(Clone, Debug, Default)]
pub struct Vocabulary {
    words: BTreeMap<String, Expr>,
    /// Declared names that are more than one word: `d(O2,O3)`.
    bracketed: Rc<Vec<Vec<char>>>,
    /// No declared name is longer, in bytes.
    longest: usize,
    angles: BTreeMap<u32, Symbol>,
    sliding: BTreeMap<u32, Symbol>,
    is_open: bool,
    in_degrees: bool,
    has_decimal_comma: bool,
}

impl Vocabulary {
    /// No names at all.
    pub fn new() -> Self {
        Self::default()
    }

    /// Declares a symbol under its own name.
    pub fn symbol(self, name: &str) -> Self {
        self.alias(name, Expr::symbol(name))
    }

    /// Declares several symbols.
    pub fn symbols<'a>(self, names: impl IntoIterator<Item = &'a str>) -> Self {
        names.into_iter().fold(self, Self::symbol)
    }

    /// Declares a name for an expression. A later declaration of the same name wins.
    pub fn alias(mut self, name: &str, meaning: Expr) -> Self {
        let word = plain_name(name);
        self.longest = self.longest.max(word.len());
        let is_bracketed = word.contains('(') && word.starts_with(char::is_alphabetic);
        if self.words.insert(word.clone(), meaning).is_none() && is_bracketed {
            Rc::make_mut(&mut self.bracketed).push(word.chars().collect());
        }
        self
    }

    /// Declares angle number `n`: `C2`, `S23`, `c_{2}` take their sines and cosines, and `q2`, `θ2`, `theta2`,
    /// `th2` and `t2` name it unless those are declared otherwise.
    pub fn angle(mut self, n: u32, angle: Symbol) -> Self {
        self.angles.insert(n, angle);
        self
    }

    /// Declares variable number `n` as a length: `q3` names it, and 3 is no index of a sine or cosine.
    pub fn sliding(mut self, n: u32, length: Symbol) -> Self {
        self.sliding.insert(n, length);
        self
    }

    /// Whether unknown words (letters and digits) become new symbols, and every index an angle `q1`, `q2`, ….
    pub fn open(mut self, open: bool) -> Self {
        self.is_open = open;
        self
    }

    /// Whether bare numbers in angles are degrees (`90+θ2`).
    pub fn degrees(mut self, degrees: bool) -> Self {
        self.in_degrees = degrees;
        self
    }

    /// Whether formulas are printed with a comma in decimal numbers, `0,5`, and semicolons between arguments with such numbers.
    /// ASCII, which is read by programs, keeps points.
    pub fn decimal_comma(mut self, comma: bool) -> Self {
        self.has_decimal_comma = comma;
        self
    }

    /// Whether formulas are printed with a comma in decimal numbers.
    pub fn has_decimal_comma(&self) -> bool {
        self.has_decimal_comma
    }

    /// The meaning of a whole word, subscript marks and braces left aside.
    pub fn lookup(&self, word: &str) -> Option<Expr> {
        let word = plain_name(word);
        if let Some(&meaning) = self.words.get(&word) {
            return Some(meaning);
        }
        let digits = word.trim_start_matches(|c: char| !c.is_ascii_digit());
        let number: u32 = digits.parse().ok()?;
        match &word[..word.len() - digits.len()] {
            "q" => self.angle_number(number).or(self.sliding.get(&number).copied()).map(Expr::from),
            "θ" | "theta" | "th" | "t" => self.angle_number(number).map(Expr::from),
            _ => None,
        }
    }

    /// The symbol of angle number `n`.
    pub(crate) fn angle_number(&self, n: u32) -> Option<Symbol> {
        match self.angles.get(&n) {
            Some(&s) => Some(s),
            None if self.is_open && !self.sliding.contains_key(&n) => Some(Symbol::new(&format!("q{n}"))),
            None => None,
        }
    }

    /// True if variable number `n` is a length.
    pub(crate) fn is_sliding(&self, n: u32) -> bool {
        self.sliding.contains_key(&n)
    }

    /// The number under which a symbol was declared as an angle.
    pub fn number_of(&self, angle: Symbol) -> Option<u32> {
        self.angles.iter().find(|(_, s)| **s == angle).map(|(n, _)| *n)
    }

    /// Whether unknown words become new symbols.
    pub fn is_open(&self) -> bool {
        self.is_open
    }

    /// Whether bare numbers in angles are degrees.
    pub fn in_degrees(&self) -> bool {
        self.in_degrees
    }

    /// The words that are declared as such, in alphabetical order.
    pub fn declared(&self) -> impl Iterator<Item = &str> {
        self.words.keys().map(String::as_str)
    }

    /// True if [`Vocabulary::words`] has the word.
    pub(crate) fn is_declared(&self, word: &str) -> bool {
        let number = |rest: &str| rest.parse::<u32>().ok().filter(|n| n.to_string() == rest);
        let angle = |rest: &str| number(rest).is_some_and(|n| self.angles.contains_key(&n));
        let sliding = |rest: &str| number(rest).is_some_and(|n| self.sliding.contains_key(&n));
        self.words.contains_key(word)
            || word.strip_prefix('q').is_some_and(|rest| angle(rest) || sliding(rest))
            || word.strip_prefix('θ').is_some_and(angle)
    }

    /// The declared names that are more than one word.
    pub(crate) fn bracketed(&self) -> &[Vec<char>] {
        &self.bracketed
    }

    /// The length of the longest declared name, in bytes.
    pub(crate) fn longest(&self) -> usize {
        self.longest
    }

    /// The declared words in alphabetical order, the spellings of numbered variables included.
    pub fn words(&self) -> Vec<String> {
        let numbered = self.angles.keys().flat_map(|n| ["q", "θ"].map(|letter| format!("{letter}{n}")));
        let sliding = self.sliding.keys().map(|n| format!("q{n}"));
        let mut words: Vec<String> = self.words.keys().cloned().chain(numbered).chain(sliding).collect();
        words.sort();
        words.dedup();
        words
    }
}

/// The name without marks of subscripts: `d(O_2, O_3)` and `d(O2,O3)` are one name, as are `a_{2}` and `a2`.
pub fn plain_name(name: &str) -> String {
    name.chars().filter(|c| !matches!(c, '_' | '{' | '}' | '\\' | ' ')).collect()
}
