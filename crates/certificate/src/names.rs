//! What symbols are called in a certificate: ASCII identifiers that neither Python nor Coq takes for something else.

use denavit_symbolic::{Symbol, greek_name};
use rustc_hash::{FxHashMap, FxHashSet};

/// The names given so far.
#[derive(Clone, Debug)]
pub struct Names {
    given: FxHashMap<Symbol, String>,
    taken: FxHashSet<String>,
    /// Symbols that are called otherwise, in order, with their names.
    pub changed: Vec<(String, String)>,
}

/// Words that mean something to a reader of certificates.
const RESERVED: &[&str] = &[
    "pi", "sin", "cos", "sqrt", "and", "as", "assert", "async", "await", "break", "class", "continue", "def",
    "del", "elif", "else", "except", "finally", "for", "from", "global", "if", "import", "in", "is",
    "lambda", "nonlocal", "not", "or", "pass", "raise", "return", "try", "while", "with", "yield", "at",
    "cofix", "end", "exists", "exists2", "fix", "forall", "fun", "let", "match", "mod", "Prop", "Set",
    "SProp", "Type", "then", "using", "where", "by", "R", "IZR", "Lemma", "PI", "link", "mul", "inv",
];

impl Default for Names {
    fn default() -> Self {
        let taken = RESERVED.iter().map(|w| (*w).to_string()).collect();
        Names { given: FxHashMap::default(), taken, changed: vec![] }
    }
}

impl Names {
    /// What a symbol is called.
    pub fn of(&mut self, symbol: Symbol) -> String {
        if let Some(known) = self.given.get(&symbol) {
            return known.clone();
        }
        let printed = symbol.name();
        let name = self.new_name(&printed);
        if name != *printed {
            self.changed.push((name.clone(), printed.to_string()));
        }
        self.given.insert(symbol, name.clone());
        name
    }

    /// A name like this one that is not taken.
    pub fn new_name(&mut self, wanted: &str) -> String {
        let mut name = String::new();
        for c in wanted.chars() {
            match greek_name(c) {
                _ if c.is_ascii_alphanumeric() || c == '_' => name.push(c),
                Some(greek) => name += greek,
                None => name.push('_'),
            }
        }
        if !name.starts_with(|c: char| c.is_ascii_alphabetic()) {
            name.insert(0, 'x');
        }
        while !self.taken.insert(name.clone()) {
            name.push('_');
        }
        name
    }
}
