//! All functions in one file of C++11, in a namespace of their own, between what attachments put ahead of it and behind.
//!
//! The file may itself be included inside of a namespace: it includes nothing, and its macros are gone where it ends.

use super::solver::{ROOTS, keep, structure};
use super::{Source, block_comment};
use crate::compiled::{WIDTH, file_name, functions, inputs, lines, opening};
use crate::names::brief;
use crate::nested;
use crate::wrap::comments;
use crate::{Attachment, File, Language, Library};

/// Words of interfaces, besides those of C.
const RESERVED: &[&str] = &[
    "ikfast",
    "ikreal",
    "ikfast_api",
    "ikfast_assert",
    "ikfast_clibrary",
    "ikfast_has_library",
    "ikfast_header_common",
    "ikfast_namespace",
    "ikfast_no_main",
    "ikfast_real",
    "ikfast_version",
    "iksingledofsolutionbase_indices_size",
];

/// What macros of the file begin with, which are not named after the library.
const PREFIX: &str = "DENAVIT_";

pub(crate) fn emit(library: &Library) -> Vec<File> {
    let reserved = [super::RESERVED, RESERVED].concat();
    let name = file_name(library, Language::IkFast);
    let names = inputs(library, Language::IkFast, &reserved);
    let functions = functions(library, Language::IkFast, &names, &[]);
    let opening = opening(library, &functions, &names, &name);
    let plans = super::solver_plans(library, &functions);
    let source = Source { library, functions, plans, opening, name, names };
    let file = |path: String, text: String| File { path, text };
    let head = brief(library, &format!("{}.cpp", source.name));
    let head = head.iter().map(String::as_str);
    let words = "The stored configurations.";
    let test = block_comment(head.clone().chain([words])) + &source.attached(|a| &a.test);
    let makefile = include_str!("single_makefile.txt").replace("@name@", &source.name);
    let mut files = vec![
        file(format!("{}.cpp", source.name), source.single()),
        file(format!("test_{}.cpp", source.name), test),
        file("Makefile".into(), format!("{}\n{makefile}", lines(&comments(head, "# ", WIDTH)))),
    ];
    files.extend(library.attachments.iter().flat_map(|a| a.named_files(&source.name)));
    files
}

impl Source<'_> {
    fn single(&self) -> String {
        let name = &self.name;
        let text = block_comment(self.lines());
        let (inner, macros) = with_own_macros(&self.inner(), &self.upper());
        let gone: String = macros.iter().map(|m| format!("#undef {m}\n")).collect();
        let ahead = self.attached(|a| &a.around[0]);
        let behind = self.attached(|a| &a.around[1]);
        format!(
            "{text}{ahead}\n/* Nothing of this is seen from outside. */\nnamespace {name}_solver {{\nnamespace {{\n\n\
             {inner}\n}} // namespace\n}} // namespace {name}_solver\n\n{gone}{behind}"
        )
    }

    /// What stands in the namespace.
    fn inner(&self) -> String {
        let upper = self.upper();
        let mut text = include_str!("single_macros.txt").replace("@NAME@", &upper);
        text.push_str(&self.routines());
        for plan in &self.plans {
            let room = format!("{upper}_{}_MAX", plan.name.to_uppercase());
            text.push_str(&format!("\n{}", structure(plan, &self.name, &room)));
        }
        text.push_str(&self.attached(|a| &a.declarations));
        self.functions.iter().for_each(|f| text.push_str(&self.one(f)));
        if !self.plans.is_empty() {
            let roots = nested::routines(ROOTS, &self.plans).replace("@p@", "").replace("@P@", "");
            text.push_str(&format!("\n{roots}"));
        }
        for plan in &self.plans {
            text.push_str(&keep(plan, &self.name).replace("@p@", ""));
            text.push_str(&self.solver(plan));
        }
        let text = text + &self.attached(|a: &Attachment| &a.definitions);
        // Compiled once: nothing chooses when a program starts.
        text.replace("CLONES ", "").replace(&format!(" && !defined({upper}_MULTIVERSION)"), "")
    }
}

/// The text with a prefix to the macros that it defines, unless they begin with `upper` and an underscore; and all of them.
fn with_own_macros(text: &str, upper: &str) -> (String, Vec<String>) {
    let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let mut defined: Vec<&str> = vec![];
    for rest in text.lines().filter_map(|line| line.strip_prefix("#define ")) {
        let name = rest.split(|c| !is_word(c)).next().unwrap_or_default();
        if !defined.contains(&name) {
            defined.push(name);
        }
    }
    let own = format!("{upper}_");
    let renamed = |word: &str| {
        let is_foreign = defined.contains(&word) && !word.starts_with(&own);
        if is_foreign { format!("{PREFIX}{word}") } else { word.to_string() }
    };
    let mut new = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(start) = rest.find(is_word) {
        let (before, word) = rest.split_at(start);
        let (word, after) = word.split_at(word.find(|c| !is_word(c)).unwrap_or(word.len()));
        new.push_str(before);
        new.push_str(&renamed(word));
        rest = after;
    }
    new.push_str(rest);
    let all = defined.iter().map(|word| renamed(word)).collect();
    (new, all)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn macros_get_a_prefix_and_words_that_hold_their_names_do_not() {
        let text = "#define ADD(a, b) ((a) + (b))\n#define ARM_MAX 3\nx = ADD(ADDED, BADD) + ARM_MAX;\n";
        let (new, all) = with_own_macros(text, "ARM");
        assert_eq!(all, ["DENAVIT_ADD", "ARM_MAX"]);
        assert_eq!(
            new,
            "#define DENAVIT_ADD(a, b) ((a) + (b))\n#define ARM_MAX 3\nx = DENAVIT_ADD(ADDED, BADD) + ARM_MAX;\n"
        );
    }
}
