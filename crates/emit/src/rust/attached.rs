//! Files of attachments, with the calls and values of the library in them.

use super::{Source, is_called};
use crate::{Attachment, File};

impl Source<'_> {
    /// The files of attachments.
    pub(super) fn attached(&self) -> impl Iterator<Item = File> {
        let of_functions =
            || self.functions.iter().map(|f| (f.name.as_str(), f.parameters(self.library).is_empty()));
        let of_solvers =
            || self.plans.iter().map(|p| (p.name.as_str(), p.parameters(self.library).is_empty()));
        let files = self.library.attachments.iter().flat_map(|a| a.named_files(&self.name));
        files.map(move |file| {
            let text = Attachment::called(file.text, of_functions().chain(of_solvers()));
            let text = Attachment::with_results(text, &self.plans);
            let text = Attachment::with_values(text, |values| {
                let fields = self.library.parameters.iter().zip(values);
                let fields: Vec<String> =
                    fields.map(|(p, value)| format!("{}: {value}", self.names.of(p.symbol))).collect();
                format!("Parameters {{ {} }}", fields.join(", "))
            });
            File { text, ..file }
        })
    }

    /// Whether the file of an attachment calls something of the kernel.
    pub(super) fn is_called_beside(&self, word: &str) -> bool {
        let mut files = self.library.attachments.iter().flat_map(|a| &a.files);
        files.any(|f| f.text.contains("use crate::kernel::") && is_called(&f.text, word))
    }
}
