//! What is said of a document that was checked.

use denavit::description::{Diagnostic, Severity};
use denavit_check::inverse::Undecided;
use denavit_check::{
    About, Change, Condition, Instead, Jacobian, Meaning, Note, Noted, Remark, Sense, Skipped, SlipKind,
    Unproved, Unread, Unreadable, ValueSlip,
};
use denavit_reading::slip::Slip;
use denavit_symbolic::Symbol;

/// Values that are apart by less are apart by rounding.
pub const ROUNDING: f64 = 1e-11;

/// What is said of a document that was checked.
pub trait Check {
    /// What a claim is about.
    fn about(&self, about: &About) -> String;

    /// The name of a claim, and the place in it: `H_6^3, row 3, column 2`.
    fn entry(&self, name: &str, place: Option<(usize, usize)>) -> String;

    /// What a matrix is by the robot.
    fn meaning(&self, meaning: &Meaning) -> String;

    /// What a matrix that is wrong as a whole is.
    fn instead(&self, instead: Instead) -> String;

    /// What else is to be said of a claim or of a formula.
    fn remarked(&self, remark: &Remark) -> String;

    /// A meaning of a name that is not the first one.
    fn sense(&self, sense: &Sense) -> String;

    /// Why a line that looks like a formula was not judged.
    fn skipped(&self, why: &Skipped) -> String;

    /// That a formula follows correctly from a wrong one, which stands in a line.
    fn carried(&self, cause: &str, line: usize) -> String;

    /// Where a formula is right; the word *right* stands before it.
    fn right_where(&self, condition: &Condition) -> String;

    /// The values that are right, as formulas: `a or b`; nothing if there is none.
    fn either(&self, values: &[String]) -> Option<String>;

    /// A parameter that would have to be 0.
    fn is_zero(&self, parameter: Symbol) -> String {
        format!("{} = 0", parameter.name())
    }

    /// Why a formula is neither proved nor refuted.
    fn unproved(&self, why: Unproved) -> String;

    /// Why nothing follows for values of joints and angles.
    fn undecided(&self, why: Undecided) -> String;

    /// What was done to a formula.
    fn slip(&self, kind: &SlipKind) -> String;

    /// What kind of change of a formula it is.
    fn formula_slip(&self, slip: &Slip) -> String;

    /// How a value that was asked for differs from the right one.
    fn value_slip(&self, slip: ValueSlip) -> String;

    /// A change of the robot, or of what is meant.
    fn change(&self, change: &Change) -> String;

    /// Why a part of a document could not be read. What the readers of formulas and of programs say stays English.
    fn unreadable(&self, why: &Unreadable) -> String;

    /// What to write instead.
    fn unreadable_hint(&self, why: &Unreadable) -> Option<String>;

    /// What is worth saying. What the readers of tables and of documents say stays English.
    fn noted(&self, what: &Noted) -> String;

    /// What would help.
    fn noted_hint(&self, what: &Noted) -> Option<String>;

    /// A note at its place.
    fn note(&self, note: &Note) -> Diagnostic {
        let (message, hint) = (self.noted(&note.what), self.noted_hint(&note.what));
        Diagnostic { severity: note.severity, span: note.span.clone(), message, hint }
    }

    /// What could not be read, at its place.
    fn unread(&self, unread: &Unread) -> Diagnostic {
        let (message, hint) = (self.unreadable(&unread.why), self.unreadable_hint(&unread.why));
        Diagnostic { severity: Severity::Error, span: unread.span.clone(), message, hint }
    }
}

/// The rows of a Jacobian, where they are not those in their usual order: `vx, vy, ωz`.
pub(super) fn rows_of(jacobian: &Jacobian) -> Option<String> {
    const ROWS: [&str; 6] = ["vx", "vy", "vz", "ωx", "ωy", "ωz"];
    let order = jacobian.order.get(..jacobian.rows)?;
    let is_usual = match jacobian.rows {
        6 => true,
        rows => (0..rows).all(|r| usize::from(order[r]) == r),
    };
    let names = order.iter().filter_map(|&k| ROWS.get(usize::from(k)).copied());
    (!is_usual).then(|| names.collect::<Vec<_>>().join(", "))
}

/// A share as a percentage: `25`.
pub(super) fn percent(share: f64) -> f64 {
    (100.0 * share).round()
}

/// Formulas that are positive.
pub(super) fn positive(formulas: &[denavit_check::Formula], and: &str) -> String {
    formulas.iter().map(|f| format!("{f} > 0")).collect::<Vec<_>>().join(and)
}
