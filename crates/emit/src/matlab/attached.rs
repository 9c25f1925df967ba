//! Attachments: files of their own.

use super::Module;
use crate::{Attachment, File};

impl Module<'_> {
    /// Their files.
    pub(super) fn attached(&self) -> impl Iterator<Item = File> {
        let files = self.library.attachments.iter().flat_map(|a| a.named_files(&self.name));
        files.map(|file| File { text: self.with_calls(file.text), ..file })
    }

    /// Their tests.
    pub(super) fn attached_tests(&self) -> String {
        let texts = self.library.attachments.iter().map(|a| Attachment::named(&a.test, &self.name));
        self.with_calls(texts.collect())
    }

    /// A text with calls and values of the library in it.
    fn with_calls(&self, text: String) -> String {
        let of_functions =
            self.library.routines.iter().map(|r| (r.name.as_str(), self.parameters_of(r).is_empty()));
        let of_solvers = self.plans.iter().map(|p| {
            let is_read = self.library.parameters.iter().any(|q| p.reads(q.symbol));
            (p.name.as_str(), !is_read)
        });
        let text = Attachment::called(text, of_functions.chain(of_solvers));
        Attachment::with_values(text, |values| {
            let fields = self.library.parameters.iter().zip(values);
            let fields: Vec<String> =
                fields.map(|(p, value)| format!("'{}', {value}", self.names.of(p.symbol))).collect();
            format!("struct({})", fields.join(", "))
        })
    }
}
