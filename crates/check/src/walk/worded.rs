//! Configurations in words: the angles of joints that have words for names.

use super::Walk;

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
}
