//! Names of symbols taken apart, and the indices of short sines and cosines.

use crate::expr::{Angle, Expr, Symbol};
use crate::greek;
use crate::rational::Rational;
use crate::vocabulary::Vocabulary;

/// What a name may not look like where it is not quoted.
const FUNCTIONS: [&str; 7] = ["pi", "π", "sqrt", "sin", "cos", "atan2", "arctan2"];

/// A name as it may be written.
pub(super) enum Spelling {
    /// A word that stands in a formula as it is: with Greek letters spelled out, and as letters.
    Plain { ascii: String, unicode: String },
    /// A word of the vocabulary with brackets: `d(O_2,O_3)`.
    Declared(String),
    /// Anything else.
    Quoted(String),
}

impl Spelling {
    pub(super) fn of(name: &str, vocabulary: &Vocabulary) -> Self {
        let own = Expr::symbol(name);
        let means = |w: &String| vocabulary.lookup(w) == Some(own);
        let number = vocabulary.number_of(Symbol::new(name)).map(|n| format!("q{n}"));
        let mut declared = [name.to_string()].into_iter().chain(number);
        let declared = declared.find(means).or_else(|| vocabulary.words().into_iter().find(means));
        let name = declared.as_deref().unwrap_or(name);
        let is_plain = match declared {
            Some(_) => is_word(name),
            None => {
                is_word(name)
                    && !(vocabulary.is_open() && name.contains('_'))
                    && !is_misread(name, vocabulary)
            }
        };
        if is_plain && !FUNCTIONS.contains(&name) {
            let is_free = |w: &String| {
                let meaning = vocabulary.lookup(w);
                meaning == Some(own) || meaning.is_none() && (declared.is_some() || !vocabulary.is_open())
            };
            let ascii = spelled_out(name).filter(is_free).unwrap_or_else(|| name.to_string());
            let unicode = in_greek(name).filter(is_free).unwrap_or_else(|| name.to_string());
            Spelling::Plain { ascii, unicode }
        } else if declared.is_some() && is_call_like(name) {
            Spelling::Declared(name.to_string())
        } else {
            Spelling::Quoted(name.to_string())
        }
    }

    /// Base and subscript of a typeset name: `RL4` is RL and 4, `base_height` base and height. `None` for a name
    /// that is no word.
    pub(super) fn parts(&self) -> Result<(&str, String), &str> {
        match self {
            Spelling::Plain { unicode, .. } => Ok(parts(unicode)),
            Spelling::Declared(name) | Spelling::Quoted(name) => Err(name),
        }
    }
}

/// Base and subscript of a word.
pub(super) fn parts(word: &str) -> (&str, String) {
    match word.split_once('_') {
        Some((base, index)) => (base, index.replace('_', "")),
        None => {
            let (base, index) = split_digits(word);
            (base, index.to_string())
        }
    }
}

/// Letters, then letters and digits, with `_` between them.
fn is_word(name: &str) -> bool {
    let is_part = |w: &str| !w.is_empty() && w.chars().all(|c| is_letter(c) || c.is_ascii_digit());
    name.starts_with(is_letter) && name.split('_').all(is_part)
}

/// A letter that needs no quotes.
pub(super) fn is_letter(c: char) -> bool {
    c.is_ascii_alphabetic() || greek::is_letter(c)
}

/// `d(O_2,O_3)`: a word, then words in brackets.
fn is_call_like(name: &str) -> bool {
    let Some((head, tail)) = name.split_once('(') else { return false };
    let Some(inner) = tail.strip_suffix(')') else { return false };
    is_word(head) && !FUNCTIONS.contains(&head) && inner.split(',').all(|w| is_word(w.trim()))
}

/// True if an undeclared name may be read as something else: a sine, a unit, a product of known words.
fn is_misread(name: &str, vocabulary: &Vocabulary) -> bool {
    let letters = name.trim_end_matches(|c: char| c.is_ascii_digit());
    let has_sine = letters.ends_with(['C', 'S']) && letters != name;
    matches!(letters, "C" | "S" | "c" | "s" | "cos" | "sin" | "rad" | "deg")
        || has_sine && letters.chars().rev().nth(1).is_some_and(char::is_lowercase)
        || vocabulary.lookup(name).is_some()
        || letters.starts_with(['C', 'S', 'c', 's']) && letters.chars().any(greek::is_letter)
        || name.as_bytes().windows(2).any(|p| p[0].is_ascii_digit() && !p[1].is_ascii_digit())
        || name.char_indices().skip(1).any(|(i, _)| vocabulary.lookup(&name[..i]).is_some())
}

/// `α2` for `alpha2`.
fn in_greek(name: &str) -> Option<String> {
    let (base, _) = parts(name);
    let (_, letter) = greek::LETTERS.iter().find(|g| g.0 == base)?;
    Some(format!("{letter}{}", &name[base.len()..]))
}

/// `alpha2` for `α2`.
fn spelled_out(name: &str) -> Option<String> {
    let first = name.chars().next()?;
    let spelling = greek::name(first)?;
    let rest = &name[first.len_utf8()..];
    rest.chars().all(|c| c.is_ascii_digit() || c == '_').then(|| format!("{spelling}{rest}"))
}

/// `RL4` is `RL` and `4`.
fn split_digits(word: &str) -> (&str, &str) {
    word.split_at(word.trim_end_matches(|c: char| c.is_ascii_digit()).len())
}

/// The numbers of the angles in a sine or cosine, as they are written: `23`, `2,10`, `2-3`.
pub(super) struct Index {
    pub text: String,
    /// The two numbers of a difference.
    pub difference: Option<(u32, u32)>,
}

impl Index {
    /// `None` if the angle has no short form that is read back.
    pub(super) fn of(angle: &Angle, vocabulary: &Vocabulary) -> Option<Self> {
        if !angle.turns.is_zero() || !angle.radians.is_zero() {
            return None;
        }
        let (mut plus, mut minus) = (vec![], vec![]);
        for (x, k) in &angle.terms {
            let number = number_of(x.as_symbol()?, vocabulary)?;
            match k {
                k if k.is_one() => plus.push(number),
                k if *k == -Rational::ONE => minus.push(number),
                _ => return None,
            }
        }
        plus.sort_unstable();
        let list = |sign: &str| plus.iter().map(u32::to_string).collect::<Vec<_>>().join(sign);
        // Ascending digits would be a sum: `C12`.
        let is_one = |n: &u32| *n < 10 || !n.to_string().as_bytes().is_sorted_by(|a, b| a < b);
        match (&plus[..], &minus[..]) {
            ([n], []) if is_one(n) => Some(Index { text: n.to_string(), difference: None }),
            ([_, _, ..], []) => {
                let has_digits = plus.iter().all(|&n| n < 10);
                let is_number = |n: u32| vocabulary.angle_number(n).is_some() || vocabulary.is_sliding(n);
                let is_other = list("").parse().is_ok_and(is_number);
                Some(Index { text: list(if has_digits && !is_other { "" } else { "," }), difference: None })
            }
            (&[a], &[b]) if is_one(&a) && is_one(&b) => {
                Some(Index { text: format!("{a}-{b}"), difference: Some((a, b)) })
            }
            _ => None,
        }
    }

    /// Digits only.
    pub(super) fn is_plain(&self) -> bool {
        self.text.bytes().all(|c| c.is_ascii_digit())
    }
}

fn number_of(angle: Symbol, vocabulary: &Vocabulary) -> Option<u32> {
    let open =
        || angle.name().strip_prefix('q')?.parse().ok().filter(|&n: &u32| vocabulary.is_open() && n < 10);
    let number = vocabulary.number_of(angle).or_else(open)?;
    (vocabulary.angle_number(number) == Some(angle) && !vocabulary.is_sliding(number)).then_some(number)
}

/// The words in which a letter or bracket follows a digit: `d4C` could swallow the start of a factor behind `d4`.
pub(super) fn bridges(vocabulary: &Vocabulary) -> Vec<String> {
    let crosses =
        |w: &String| w.as_bytes().windows(2).any(|p| p[0].is_ascii_digit() && !p[1].is_ascii_digit());
    vocabulary.words().into_iter().filter(crosses).collect()
}
