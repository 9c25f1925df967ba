//! What the styles differ in, and what decides between two spellings: where factors meet, how a factor starts.

use super::names::{Index, Spelling};
use crate::vocabulary::{Vocabulary, plain_name};
use std::rc::Rc;

/// Everything that differs between the styles.
#[derive(Clone, Copy)]
pub(super) struct Notation {
    /// Around the whole formula.
    pub whole: [&'static str; 2],
    pub plus: &'static str,
    pub minus: &'static str,
    pub negative: &'static str,
    pub paren: [&'static str; 2],
    /// Before, between and after the parts of a fraction with a bar; `None` writes `a/b`.
    pub bar: Option<[&'static str; 3]>,
    pub root: [&'static str; 2],
    /// The root sign of a bare integer, where it needs no parentheses.
    pub short_root: Option<&'static str>,
    /// The root where a symbol is called `sqrt`.
    pub root_sign: [&'static str; 2],
    /// The names of functions, which stand before an argument in `call`.
    pub sine: &'static str,
    pub cosine: &'static str,
    pub arctangent: &'static str,
    pub sign: &'static str,
    /// Before, between and behind the arguments of a function.
    pub call: [&'static str; 3],
    pub pi: &'static str,
    /// π where its name means something else.
    pub half_turn: &'static str,
    /// Behind a number of degrees.
    pub degree: &'static str,
    /// Behind a number in an angle, where a bare number would be degrees.
    pub radian: &'static str,
    /// Before a power and between base and exponent; what closes it comes with the exponent.
    pub power: [&'static str; 2],
    pub exponent: fn(i32) -> String,
    /// A number without sign or fraction bar.
    pub digits: fn(String) -> String,
    /// A number with a comma for its point.
    pub comma: fn(String) -> String,
    /// Between arguments with such numbers.
    pub semicolon: &'static str,
    pub symbol: fn(&Spelling) -> String,
    /// The sine or cosine (first letter) of numbered angles.
    pub trig: fn(char, &Index) -> String,
    pub times: fn(&Seam) -> &'static str,
}

impl Notation {
    /// With other spellings for what the vocabulary gives another meaning: a length may be called `pi` or `cos`.
    pub fn beside(mut self, vocabulary: &Vocabulary) -> Self {
        let is_taken = |word: &str| vocabulary.lookup(word).is_some();
        if is_taken("pi") || is_taken("π") {
            self.pi = self.half_turn;
        }
        if is_taken("sin") || is_taken("cos") {
            let letters = if is_taken("C") || is_taken("S") { ["s", "c"] } else { ["S", "C"] };
            (self.sine, self.cosine) = (letters[0], letters[1]);
        }
        if is_taken("sqrt") {
            self.root = self.root_sign;
        }
        if is_taken("atan2") {
            self.arctangent = "arctan2";
        }
        self
    }
}

/// Where two factors meet.
pub(super) struct Seam<'a> {
    /// What is written so far.
    pub left: &'a str,
    pub right: Head,
    /// A slash stands to the left, so that only a visible sign keeps the order of reading.
    pub after_slash: bool,
    /// Words that run across the border of a digit and a letter.
    pub bridges: &'a [String],
}

impl Seam<'_> {
    /// True if a known word that runs across a border lies in `text`.
    pub fn bridges_at(&self, text: &str) -> bool {
        self.bridges.iter().any(|w| text.contains(w.as_str()) || text.ends_with('(') && w.contains(text))
    }

    /// True if a bracket here would complete the start of a known word such as `d2(x)`.
    pub fn calls(&self) -> bool {
        let heads = self.bridges.iter().filter_map(|w| w.split_once('('));
        heads.into_iter().any(|(head, _)| {
            let tail = self.left.char_indices().rev().nth(4 * head.len() + 20).map_or(0, |(i, _)| i);
            plain_name(&self.left[tail..]).ends_with(head)
        })
    }
}

/// How a factor starts.
pub(super) enum Head {
    Number,
    Paren,
    Word(Rc<str>),
    Call,
    Root,
    Fraction,
}
