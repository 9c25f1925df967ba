//! Attachments, behind the other functions of a module.

use super::{Module, WRAP, float};
use crate::Attachment;

impl Module<'_> {
    /// What they import, a line each.
    pub(super) fn imports(&self) -> impl Iterator<Item = &str> {
        self.library.attachments.iter().flat_map(|a| a.declarations.lines())
    }

    /// Their definitions.
    pub(super) fn attached(&self) -> String {
        self.with_calls(|a| &a.definitions, "")
    }

    /// Their tests.
    pub(super) fn attached_tests(&self) -> String {
        self.with_calls(|a| &a.test, &format!("{}.", self.name))
    }

    /// A text of all of them, with calls and values of the library in it; its class of parameters is in a scope.
    fn with_calls(&self, text: impl Fn(&Attachment) -> &str, scope: &str) -> String {
        let of_functions = self.library.routines.iter().zip(&self.functions);
        let of_functions = of_functions.map(|(r, name)| (name.as_str(), !self.is_parametric(r)));
        let of_solvers = self.plans.iter().map(|p| {
            let is_read = self.library.parameters.iter().any(|q| p.reads(q.symbol));
            (p.name.as_str(), !is_read)
        });
        let texts = self.library.attachments.iter().map(|a| Attachment::named(text(a), &self.name));
        let text = Attachment::called(texts.collect(), of_functions.chain(of_solvers));
        Attachment::with_values(text, |values| {
            let fields = self.library.parameters.iter().zip(values);
            let fields: Vec<String> =
                fields.map(|(p, value)| format!("{}={}", self.names.of(p.symbol), float(value))).collect();
            let whole = format!("{scope}Parameters({})", fields.join(", "));
            // Behind a name, in a class.
            if whole.len() + 20 <= WRAP.width {
                return whole;
            }
            format!("{scope}Parameters(\n{}\n    )", WRAP.list(&fields, 8).join("\n"))
        })
    }
}

/// Names that a text defines for others: those of classes, functions and constants without an underscore ahead.
pub(super) fn public(text: &str) -> impl Iterator<Item = &str> {
    let own = |line: &'_ str| -> Option<usize> {
        let start = ["class ", "def "].into_iter().find(|word| line.starts_with(word)).map_or(0, str::len);
        let end = line[start..].find(|c: char| !(c.is_ascii_alphanumeric() || c == '_'))?;
        let is_defined = start > 0 || line[end..].starts_with(" = ");
        let is_public = line[start..].starts_with(|c: char| c.is_ascii_alphabetic());
        (is_defined && is_public).then_some(start + end)
    };
    text.lines().filter_map(move |line| {
        let end = own(line)?;
        line[..end].split(' ').next_back()
    })
}
