//! Attachments, behind the other functions of a module.

use super::Module;
use crate::Attachment;

impl Module<'_> {
    /// Their definitions.
    pub(super) fn attached(&self) -> String {
        self.with_calls(|a| &a.definitions)
    }

    /// Their tests.
    pub(super) fn attached_tests(&self) -> String {
        self.with_calls(|a| &a.test)
    }

    /// A text of all of them, with calls and values of the library in it.
    fn with_calls(&self, text: impl Fn(&Attachment) -> &str) -> String {
        let of_functions = self.library.routines.iter().zip(&self.functions);
        let of_functions = of_functions.map(|(r, f)| (f.one.as_str(), self.parameters_of(r).is_empty()));
        let of_solvers =
            self.plans.iter().map(|p| (p.name.as_str(), self.parameters_of_solver(p).is_empty()));
        let texts = self.library.attachments.iter().map(|a| Attachment::named(text(a), &self.name));
        let text = Attachment::called(texts.collect(), of_functions.chain(of_solvers));
        let text = Attachment::with_results(text, &self.plans);
        Attachment::with_values(text, |values| {
            let fields = self.library.parameters.iter().zip(values);
            let fields: Vec<String> =
                fields.map(|(p, value)| format!("{}: {value}", self.names.of(p.symbol))).collect();
            format!("{{ {} }}", fields.join(", "))
        })
    }
}

/// The functions that a text exports.
pub(super) fn functions(text: &str) -> impl Iterator<Item = &str> {
    text.lines().filter_map(|line| Some(line.strip_prefix("export function ")?.split_once('(')?.0))
}
