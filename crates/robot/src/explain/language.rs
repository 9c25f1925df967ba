//! The language of the words around formulas.
//!
//! A sentence is written in both languages where it is composed, French with ordinary blanks and apostrophes;
//! [`Language::set`] gives a finished document the blanks and apostrophes that print wants.

use super::document::{Block, Branch, Line, Piece};

/// The language of the words around formulas.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Language {
    /// English.
    #[default]
    English,
    /// French, with the terms of courses in robotics.
    French,
}

/// The same words in each language.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Words {
    /// In English.
    pub english: String,
    /// In French, with ordinary blanks.
    pub french: String,
}

impl Words {
    /// Words in both languages.
    pub fn new(english: impl Into<String>, french: impl Into<String>) -> Self {
        Words { english: english.into(), french: french.into() }
    }

    /// Those of one language, as they are printed.
    pub fn of(&self, language: Language) -> String {
        match language {
            Language::English => self.english.clone(),
            Language::French => language.spaced(&self.french),
        }
    }
}

impl Language {
    /// What is said in this language.
    pub fn pick<T>(self, english: T, french: T) -> T {
        match self {
            Language::English => english,
            Language::French => french,
        }
    }

    /// `1 joint`, `3 joints`; French has the singular for none, too.
    pub fn counted(self, n: usize, english: [&str; 2], french: [&str; 2]) -> String {
        let [one, many] = self.pick(english, french);
        let is_one = self.pick(n == 1, n < 2);
        format!("{n} {}", if is_one { one } else { many })
    }

    /// `a, b and c`
    pub fn listed(self, words: &[String]) -> String {
        match words {
            [] => String::new(),
            [one] => one.clone(),
            [front @ .., last] => {
                format!("{} {} {last}", front.join(", "), self.pick("and", "et"))
            }
        }
    }

    /// Numbers from 0, shown from 1: `2, 3 and 4`.
    pub fn numbers(self, all: &[usize]) -> String {
        self.listed(&all.iter().map(|k| (k + 1).to_string()).collect::<Vec<_>>())
    }

    /// The text with the blanks of the language: in French none that breaks before `: ; ? !` and within `« »`, and the
    /// apostrophe of print.
    pub fn spaced(self, text: &str) -> String {
        if self == Language::English {
            return text.into();
        }
        let mut all: Vec<char> = text.chars().collect();
        for k in 0..all.len() {
            let before = k.checked_sub(1).map(|b| all[b]);
            let next = all.get(k + 1).copied();
            match all[k] {
                ' ' if before == Some('«') || matches!(next, Some(':' | ';' | '?' | '!' | '»')) => {
                    all[k] = '\u{a0}';
                }
                '\'' if before.is_some_and(char::is_alphabetic) && next.is_none_or(char::is_alphanumeric) => {
                    all[k] = '’';
                }
                _ => {}
            }
        }
        all.into_iter().collect()
    }

    /// The document with the blanks of the language.
    pub fn set(self, mut blocks: Vec<Block>) -> Vec<Block> {
        if self == Language::French {
            for block in &mut blocks {
                match block {
                    Block::Heading(_, line) | Block::Paragraph(line) => self.line(line),
                    Block::List(lines) => lines.iter_mut().for_each(|line| self.line(line)),
                    Block::Tree(branch) => self.branch(branch),
                    Block::Formula { .. } => {}
                }
            }
        }
        blocks
    }

    fn branch(self, branch: &mut Branch) {
        self.line(&mut branch.line);
        branch.children.iter_mut().for_each(|child| self.branch(child));
    }

    fn line(self, line: &mut Line) {
        for piece in &mut line.0 {
            match piece {
                Piece::Text(words) | Piece::Strong(words) => *words = self.spaced(words),
                Piece::Math(_) => {}
            }
        }
    }
}
