//! What is worth saying of a document beside its verdicts, and why parts of it are not read.

use super::facts::{ReadWith, Sense, ShortRow};
use super::inverse::Composed;
use denavit::description::{Convention, Diagnostic, NotSet, Severity};
use denavit_symbolic::parse::ParseError;
use std::ops::Range;

/// How many notes are worth listing.
const MAX_NOTES: usize = 100;

/// Something worth saying at a place of the document.
#[derive(Clone, PartialEq, Debug)]
pub struct Note {
    /// How much it matters.
    pub severity: Severity,
    /// Where: bytes of the text.
    pub span: Range<usize>,
    /// What.
    pub what: Noted,
}

/// What is worth saying.
#[derive(Clone, PartialEq, Debug)]
pub enum Noted {
    /// What the reader of tables says.
    Table {
        /// Its message.
        message: String,
        /// What would help.
        hint: Option<String>,
    },
    /// What the reader of documents says.
    Document(String),
    /// The document is too long.
    TooLong {
        /// Its bytes.
        bytes: usize,
        /// The most that are read.
        most: usize,
    },
    /// There is no robot that anything could be about.
    NoRobot,
    /// The tables are read in the convention that the text names.
    ReadAs(Convention),
    /// Lengths without a unit in tables are in millimetres: the text says so.
    InMillimetres,
    /// The text does not say the convention of its tables; it is the one in which its own statements are right.
    Supported {
        /// Which.
        convention: Convention,
        /// How many statements are right so.
        right: usize,
        /// How many at most in another convention.
        rival: usize,
    },
    /// Names are read in a sense that is not the first one: the document supports it.
    Reading(Sense),
    /// A directive names a robot that is not in the catalogue.
    UnknownRobot(String),
    /// A parameter that is to have a value does not get it.
    NotSet(String, NotSet),
    /// A directive names a table that is not there.
    NoSuchTable,
    /// A directive names a convention that is none.
    UnknownConvention(String),
    /// A directive gives a tool that is not three lengths.
    NoTool,
    /// A statement that says nothing of the robot was passed over.
    PassedOver(Unreadable),
    /// A part of a program was not read.
    NotRead(Unreadable),
    /// What the formulas of all joints yield one after another.
    Together(Composed),
    /// Masses and gravity are read so that most formulas of dynamics are right, and the words do not say that they are so.
    ReadWith(Vec<ReadWith>),
}

/// A part of the document that could not be read.
#[derive(Clone, PartialEq, Debug)]
pub struct Unread {
    /// Where: bytes of the text.
    pub span: Range<usize>,
    /// Why.
    pub why: Unreadable,
}

/// Why a part of a document could not be read.
#[derive(Clone, PartialEq, Debug)]
pub enum Unreadable {
    /// What the reader of formulas or of programs says.
    Syntax {
        /// Its message.
        message: String,
        /// What to write instead, if that is known.
        hint: Option<String>,
    },
    /// A name without meaning.
    Unknown(String),
    /// A matrix has too many elements.
    ManyElements {
        /// Its elements.
        elements: usize,
        /// The most that are read.
        most: usize,
    },
    /// A row is too short.
    ShortRow(ShortRow),
    /// A product is too long to be worked out.
    LongProduct,
    /// Neither a formula nor a product of matrices.
    NeitherFormulaNorProduct,
    /// No product of matrices that are known.
    NoKnownProduct,
    /// A number, but the joints have no values.
    NoConfiguration,
    /// A directive gives a name a meaning that cannot be read.
    Alias,
    /// Nothing says what a function of a program returns.
    NothingTold(String),
}

impl Unread {
    /// What could not be read at a place.
    pub(super) fn new(span: Range<usize>, why: Unreadable) -> Self {
        Unread { span, why }
    }

    /// The name that is not known.
    pub(super) fn unknown(&self) -> Option<&str> {
        match &self.why {
            Unreadable::Unknown(name) => Some(name),
            Unreadable::Syntax { message, .. } => message.strip_prefix("unknown `")?.strip_suffix('`'),
            _ => None,
        }
    }
}

impl From<ParseError> for Unread {
    fn from(error: ParseError) -> Self {
        let ParseError { span, message, hint } = error;
        Unread { span, why: Unreadable::Syntax { message, hint } }
    }
}

impl From<Diagnostic> for Note {
    fn from(found: Diagnostic) -> Self {
        let Diagnostic { severity, span, message, hint } = found;
        Note { severity, span, what: Noted::Table { message, hint } }
    }
}

/// Notes in the making, as many as are worth listing.
#[derive(Default)]
pub(super) struct Notes(Vec<Note>);

impl Notes {
    /// Adds a note, unless there are enough.
    pub fn add(&mut self, note: Note) {
        if self.0.len() < MAX_NOTES {
            self.0.push(note);
        }
    }

    /// Adds an error.
    pub fn error(&mut self, span: Range<usize>, what: Noted) {
        self.add(Note { severity: Severity::Error, span, what });
    }

    /// Adds a warning.
    pub fn warning(&mut self, span: Range<usize>, what: Noted) {
        self.add(Note { severity: Severity::Warning, span, what });
    }

    /// Adds a remark.
    pub fn note(&mut self, span: Range<usize>, what: Noted) {
        self.add(Note { severity: Severity::Note, span, what });
    }

    /// As they were found.
    pub fn found(self) -> Vec<Note> {
        self.0
    }

    /// In the order of the text, none twice.
    pub fn sorted(self) -> Vec<Note> {
        let mut all = self.0;
        all.sort_by_key(|n| n.span.start);
        all.dedup();
        all
    }
}
