//! Configurations in words: the angles of joints that have words for names; and letters that nothing gives a meaning.

use super::Walk;
use denavit_symbolic::Expr;

impl Walk<'_> {
    /// Reads the angles that stand behind the words for joints: `Shoulder 90°, elbow −90°`.
    pub(super) fn told_words(&mut self, line: &str) {
        const LETTERS: usize = 3;
        let words: Vec<&str> = line.split_whitespace().collect();
        for pair in words.windows(2) {
            let name = pair[0].trim_matches(['*', '(', '`', '_']);
            let is_word =
                name.chars().count() >= LETTERS && name.chars().all(|c| c.is_alphanumeric() || c == '_');
            let value = pair[1].trim_end_matches([',', ';', ':', '.', ')', '*']);
            let is_angle =
                value.ends_with('°') && value.starts_with(|c: char| c.is_ascii_digit() || "-−+".contains(c));
            if is_word && is_angle && !self.assign(name, value) {
                self.assign(&name.to_lowercase(), value);
            }
        }
    }

    /// True if components along axes occur that are neither the robot's nor the pose's: `w_x` of a point that is given.
    pub(super) fn has_strange_components(&self, value: Expr) -> bool {
        let d = &self.subject.description;
        let (joints, rates) = (self.subject.joints(), self.subject.rates());
        let strange: Vec<String> = value
            .symbols()
            .into_iter()
            .filter(|s| d.parameter(*s).is_none())
            .filter(|s| !joints.contains(&(*s).into()) && !rates.contains(&(*s).into()))
            .map(|s| s.name().to_string())
            .collect();
        let has = |axis: &str, stem: &str| strange.iter().any(|n| n.strip_suffix(axis) == Some(stem));
        let is_force = |stem: &str| stem.starts_with(['f', 'F', 'm', 'M', 'N', 'n']);
        strange.iter().any(|n| {
            let stem = n.strip_suffix('x').unwrap_or_default();
            !stem.is_empty() && !is_force(stem) && has("y", stem)
        })
    }
}
