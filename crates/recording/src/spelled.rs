//! Names of columns, however they are spelled.

/// Small letters, digits and Greek ones alone.
pub(crate) fn plain(name: &str) -> String {
    name.to_lowercase().chars().filter(|c| c.is_alphanumeric()).collect()
}

/// A name in front of its number, and the number.
pub(crate) fn numbered(name: &str) -> Option<(String, usize)> {
    let trimmed = name.trim_end_matches([']', ')', '}']);
    let digits = trimmed.len() - trimmed.bytes().rev().take_while(u8::is_ascii_digit).count();
    let number = trimmed[digits..].parse().ok()?;
    Some((plain(&trimmed[..digits]), number))
}
