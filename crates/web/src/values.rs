//! The numbers that names in formulas stand for now.

use crate::formulas;
use crate::refusal::Refusal;
use crate::subject::Subject;
use serde::Serialize;
use std::collections::BTreeMap;

/// Names and their numbers; null where a number is not finite.
#[derive(Serialize)]
pub struct Values {
    values: BTreeMap<String, f64>,
}

/// The current number of each name that a topic defines.
///
/// # Errors
/// If there is no such topic, or the configuration does not fit.
pub fn values(subject: &mut Subject, topic: &str, q: &[f64]) -> Result<Values, Refusal> {
    subject.configuration(q)?;
    if !subject.formulas.iter().any(|(known, _)| known == topic) {
        formulas::formulas(subject, topic, q)?;
    }
    let found = subject.formulas.iter().find(|(known, _)| known == topic);
    let values = found
        .map(|(_, definitions)| definitions.values(&subject.valued, &subject.robot, q))
        .unwrap_or_default();
    Ok(Values { values })
}
