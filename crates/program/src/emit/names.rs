//! Identifiers for symbols: ASCII letters, digits and underscores, no keyword, no two alike.

use crate::emit::{Language, Library};
use denavit_symbolic::Symbol;
use rustc_hash::{FxHashMap, FxHashSet};

/// The longest identifier; a longer name is cut.
const MAX_LENGTH: usize = 40;

/// Identifiers of one scope.
#[derive(Clone, Debug, Default)]
pub(crate) struct Names {
    identifiers: FxHashMap<Symbol, String>,
    /// Words that are not used, in lower case.
    reserved: FxHashSet<String>,
    /// Identifiers in use, and the same in lower case.
    exact: FxHashSet<String>,
    taken: FxHashSet<String>,
}

impl Names {
    /// No names yet; the keywords of the language and the words given are not used. What differs from them in case
    /// only is not used either, unless it is a single letter.
    pub fn new(language: Language, reserved: &[&str]) -> Self {
        let words = keywords(language).iter().chain(reserved);
        Names { reserved: words.map(|w| w.to_lowercase()).collect(), ..Names::default() }
    }

    /// Gives a symbol its identifier, the nearest to its name that is free.
    pub fn declare(&mut self, symbol: Symbol) {
        if !self.identifiers.contains_key(&symbol) {
            let is_free = |names: &Self, c: &str| {
                let is_letter = c.len() == 1;
                !names.exact.contains(c)
                    && !names.reserved.contains(&if is_letter { c.into() } else { c.to_lowercase() })
            };
            let identifier = self.take(&sanitised(&symbol.name()), is_free);
            self.identifiers.insert(symbol, identifier);
        }
    }

    /// A name that no symbol has yet, with its identifier declared.
    pub fn fresh(&mut self, wanted: &str) -> String {
        let numbered = (2..).map(|k| format!("{wanted}_{k}"));
        let is_new = |name: &String| !self.identifiers.contains_key(&Symbol::new(name));
        let name = std::iter::once(wanted.to_string()).chain(numbered).find(is_new);
        let name = name.expect("numbers do not end");
        self.declare(Symbol::new(&name));
        name
    }

    /// An identifier that is not used yet, for what is no symbol; it differs from all others not in case only.
    pub fn free(&mut self, wanted: &str) -> String {
        let is_free = |names: &Self, c: &str| {
            let lower = c.to_lowercase();
            !names.taken.contains(&lower) && !names.reserved.contains(&lower)
        };
        self.take(wanted, is_free)
    }

    fn take(&mut self, wanted: &str, is_free: impl Fn(&Self, &str) -> bool) -> String {
        let numbered = (2..).map(|k| format!("{wanted}_{k}"));
        let mut candidates = std::iter::once(wanted.to_string()).chain(numbered);
        let name = candidates.find(|c| is_free(self, c)).expect("numbers do not end");
        self.exact.insert(name.clone());
        self.taken.insert(name.to_lowercase());
        name
    }

    /// What a symbol is, to stand behind its identifier: names the symbol where the identifier differs from it.
    pub fn about(&self, symbol: Symbol, about: &str) -> String {
        let name = symbol.name();
        if *name == *self.of(symbol) { about.into() } else { format!("the symbol {name}; {about}") }
    }

    /// The identifier of a declared symbol.
    pub fn of(&self, symbol: Symbol) -> &str {
        &self.identifiers[&symbol]
    }
}

/// The nearest identifier to a name: what is no ASCII letter or digit becomes an underscore, a Greek letter its name.
pub(crate) fn sanitised(name: &str) -> String {
    let mut text = String::new();
    for c in name.chars() {
        match denavit_symbolic::greek_name(c) {
            _ if c.is_ascii_alphanumeric() => text.push(c),
            Some(letter) => text.push_str(letter),
            None if text.ends_with('_') => {}
            None => text.push('_'),
        }
        if text.len() >= MAX_LENGTH {
            break;
        }
    }
    let text = text.trim_matches('_');
    match text.chars().next() {
        None => "x".into(),
        Some(c) if c.is_ascii_digit() => format!("x{text}"),
        Some(_) => text.into(),
    }
}

/// A name of files, none that tests have: their names begin with `test_`.
pub(crate) fn no_test(name: String) -> String {
    if name == "test" || name.starts_with("test_") { format!("x_{name}") } else { name }
}

/// The words that open a file beside the main one: the first and the last line of the header, and where all stands.
pub(crate) fn brief(library: &Library, main: &str) -> Vec<String> {
    let mut lines: Vec<String> = library.header.first().cloned().into_iter().collect();
    lines.extend(library.header.last().filter(|_| library.header.len() > 1).cloned());
    lines.push(format!("More stands in {main}."));
    lines
}

/// A text as one line of a comment in any of the languages: no control characters, no end of a comment, no trigraph
/// or line splice.
pub(crate) fn comment(text: &str) -> String {
    let plain: String = text.chars().map(|c| if is_harmless(c) { c } else { ' ' }).collect();
    plain.replace("*/", "* /").replace("/*", "/ *").replace("??", "? ?").replace('\\', "/").trim_end().into()
}

/// Neither a control character nor one that changes the direction or the breaks of lines.
fn is_harmless(c: char) -> bool {
    let hidden = ['\u{2028}', '\u{2029}', '\u{85}', '\u{feff}'];
    let directions = ['\u{200e}'..='\u{200f}', '\u{202a}'..='\u{202e}', '\u{2066}'..='\u{2069}'];
    !c.is_control() && !hidden.contains(&c) && !directions.iter().any(|d| d.contains(&c))
}

/// Words that the language keeps for itself, or that shadow what the emitted code uses.
fn keywords(language: Language) -> &'static [&'static str] {
    match language {
        Language::Rust => &[
            "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "core",
            "crate", "do", "dyn", "else", "enum", "extern", "f32", "f64", "false", "final", "fn", "for",
            "gen", "if", "impl", "in", "let", "loop", "macro", "match", "mod", "move", "mut", "override",
            "priv", "pub", "ref", "return", "self", "static", "std", "struct", "super", "trait", "true",
            "try", "type", "typeof", "union", "unsafe", "unsized", "use", "virtual", "where", "while",
            "yield",
        ],
        Language::C | Language::Cuda => &[
            "alignas",
            "alignof",
            "and",
            "and_eq",
            "asm",
            "atan2",
            "auto",
            "bitand",
            "bitor",
            "bool",
            "break",
            "case",
            "catch",
            "char",
            "char16_t",
            "char32_t",
            "char8_t",
            "class",
            "complex",
            "compl",
            "concept",
            "const",
            "const_cast",
            "consteval",
            "constexpr",
            "constinit",
            "continue",
            "cos",
            "decltype",
            "default",
            "delete",
            "do",
            "double",
            "dynamic_cast",
            "else",
            "enum",
            "explicit",
            "export",
            "extern",
            "false",
            "float",
            "for",
            "friend",
            "gamma",
            "goto",
            "i",
            "if",
            "imaginary",
            "inline",
            "int",
            "j0",
            "j1",
            "jn",
            "long",
            "main",
            "mutable",
            "namespace",
            "new",
            "noexcept",
            "not",
            "not_eq",
            "nullptr",
            "operator",
            "or",
            "or_eq",
            "private",
            "protected",
            "public",
            "register",
            "reinterpret_cast",
            "requires",
            "restrict",
            "return",
            "short",
            "signed",
            "sin",
            "sizeof",
            "sqrt",
            "static",
            "static_assert",
            "static_cast",
            "struct",
            "switch",
            "template",
            "this",
            "thread_local",
            "throw",
            "true",
            "try",
            "typedef",
            "typeid",
            "typename",
            "typeof",
            "union",
            "unsigned",
            "using",
            "virtual",
            "void",
            "volatile",
            "wchar_t",
            "while",
            "xor",
            "xor_eq",
            "y0",
            "y1",
            "yn",
            "linux",
            "unix",
            "blockidx",
            "blockdim",
            "threadidx",
            "griddim",
        ],
        Language::Python => &[
            "and", "as", "assert", "async", "await", "break", "case", "class", "continue", "def", "del",
            "elif", "else", "except", "false", "finally", "for", "from", "global", "if", "import", "in",
            "is", "lambda", "match", "none", "nonlocal", "not", "np", "or", "pass", "raise", "return",
            "true", "try", "type", "while", "with", "yield",
        ],
        Language::Matlab => &[
            "ans",
            "break",
            "case",
            "catch",
            "classdef",
            "continue",
            "cos",
            "do",
            "e",
            "else",
            "elseif",
            "end",
            "end_try_catch",
            "end_unwind_protect",
            "endfor",
            "endfunction",
            "endif",
            "endswitch",
            "endwhile",
            "eps",
            "for",
            "function",
            "global",
            "i",
            "if",
            "inf",
            "j",
            "na",
            "nan",
            "otherwise",
            "parfor",
            "persistent",
            "pi",
            "return",
            "sin",
            "spmd",
            "sqrt",
            "atan2",
            "switch",
            "try",
            "until",
            "unwind_protect",
            "unwind_protect_cleanup",
            "while",
            "zeros",
            "ones",
            "size",
            "reshape",
        ],
        Language::JavaScript => &[
            "abstract",
            "arguments",
            "await",
            "boolean",
            "break",
            "byte",
            "case",
            "catch",
            "char",
            "class",
            "const",
            "continue",
            "debugger",
            "default",
            "delete",
            "do",
            "double",
            "else",
            "enum",
            "eval",
            "export",
            "extends",
            "false",
            "final",
            "finally",
            "float",
            "for",
            "function",
            "goto",
            "if",
            "implements",
            "import",
            "in",
            "infinity",
            "instanceof",
            "int",
            "interface",
            "let",
            "long",
            "math",
            "nan",
            "native",
            "new",
            "null",
            "package",
            "private",
            "protected",
            "public",
            "return",
            "short",
            "static",
            "super",
            "switch",
            "synchronized",
            "this",
            "throw",
            "throws",
            "transient",
            "true",
            "try",
            "typeof",
            "undefined",
            "var",
            "void",
            "volatile",
            "while",
            "with",
            "yield",
        ],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hostile_names_become_plain_identifiers() {
        for (name, expected) in [
            ("a2", "a2"),
            ("α_2", "alpha_2"),
            ("x; system(\"rm\")", "x_system_rm"),
            ("*/ int main() {", "int_main"),
            ("2d", "x2d"),
            ("___", "x"),
            ("\u{202e}evil\n", "evil"),
        ] {
            assert_eq!(sanitised(name), expected, "{name}");
        }
        assert_eq!(comment("a */ b \\\n c"), "a * / b /  c");
    }

    #[test]
    fn no_two_identifiers_are_alike_and_none_is_a_keyword() {
        let mut names = Names::new(Language::C, &["q"]);
        let symbols = ["double", "Double", "q", "a b", "a_b"].map(Symbol::new);
        symbols.iter().for_each(|s| names.declare(*s));
        let identifiers = symbols.map(|s| names.of(s).to_string());
        assert_eq!(identifiers, ["double_2", "Double_2", "q_2", "a_b", "a_b_2"]);
    }

    #[test]
    fn letters_of_either_case_are_names_of_their_own() {
        let mut names = Names::new(Language::Python, &["q", "l"]);
        let symbols = ["L", "l", "Q", "a", "A"].map(Symbol::new);
        symbols.iter().for_each(|s| names.declare(*s));
        assert_eq!(symbols.map(|s| names.of(s).to_string()), ["L", "l_2", "Q", "a", "A"]);
        assert_eq!(names.about(symbols[0], "a length"), "a length");
        assert_eq!(names.about(symbols[1], "a length"), "the symbol l; a length");
        assert_eq!(names.free("Q"), "Q_2");
    }

    #[test]
    fn no_file_is_taken_for_a_test() {
        for (name, expected) in [("test", "x_test"), ("test_fk", "x_test_fk"), ("tester", "tester")] {
            assert_eq!(no_test(name.into()), expected);
        }
    }
}
