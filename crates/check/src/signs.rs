//! Words and signs of other languages and of programs in prose, turned into those of formulas, byte for byte.

/// A text with the words that other languages have for a root, and with `dx/dt`, as formulas are written, byte for byte; nothing
/// for other texts.
pub(super) fn words_as_signs(text: &str) -> Option<String> {
    const WORDS: [(&str, &str); 9] = [
        ("racine(", "sqrt  ("),
        ("radice(", "sqrt  ("),
        ("wortel(", "sqrt  ("),
        ("raiz(", "sqrt("),
        ("Wurzel(", "sqrt  ("),
        ("wurzel(", "sqrt  ("),
        ("dx/dt", "xdot "),
        ("dy/dt", "ydot "),
        ("dz/dt", "zdot "),
    ];
    if !WORDS.iter().any(|w| text.contains(w.0)) {
        return None;
    }
    let is_part = |c: char| c.is_alphanumeric();
    let mut bytes = text.as_bytes().to_vec();
    for (word, now) in WORDS {
        for (at, _) in text.match_indices(word) {
            if !text[..at].ends_with(is_part) && !text[at + word.len()..].starts_with(is_part)
                || word.ends_with('(')
            {
                bytes[at..at + word.len()].copy_from_slice(now.as_bytes());
            }
        }
    }
    String::from_utf8(bytes).ok()
}

/// A text with commas for the semicolons between the arguments of `atan2(y; x)`, byte for byte; nothing for other texts.
pub(super) fn commas_in_calls(text: &str) -> Option<String> {
    const LONGEST: usize = 400;
    let mut bytes = text.as_bytes().to_vec();
    let mut is_any = false;
    let mut until = 0;
    for (at, name) in ["tan2", "TAN2"].iter().flat_map(|n| text.match_indices(n)) {
        let rest = &text[at + name.len()..];
        let inside =
            rest.trim_start_matches(|c: char| matches!(c, ' ' | '}') || c.is_ascii_alphabetic() || c == '\\');
        let Some(arguments) = inside.strip_prefix('(').filter(|_| at >= until || at + LONGEST < until) else {
            continue;
        };
        let start = text.len() - arguments.len();
        let mut depth = 0_usize;
        until = start + LONGEST;
        for (i, c) in arguments.char_indices().take(LONGEST) {
            match c {
                '(' | '[' => depth += 1,
                ')' | ']' if depth > 0 => depth -= 1,
                ')' | ']' | '\n' => {
                    until = start + i;
                    break;
                }
                ';' if depth == 0 => {
                    bytes[start + i] = b',';
                    is_any = true;
                }
                _ => {}
            }
        }
    }
    if is_any { String::from_utf8(bytes).ok() } else { None }
}

/// A text with `= D` for `=: D`, byte for byte; nothing for other texts.
pub(super) fn names_behind(text: &str) -> Option<String> {
    let mut bytes = text.as_bytes().to_vec();
    let mut is_any = false;
    for (at, _) in text.match_indices("=:") {
        let rest = text[at + 2..].trim_start_matches([' ', '~']);
        let is_name = rest.starts_with(|c: char| c.is_alphabetic() || c == '\\');
        if is_name && !text[..at].ends_with([':', '=']) {
            bytes[at + 1] = b' ';
            is_any = true;
        }
    }
    if is_any { String::from_utf8(bytes).ok() } else { None }
}

/// A text with `a2= 0.45, a3= 0.02` for `vals = {a2: 0.45, a3: 0.02}`, outside of fenced programs; nothing for other texts.
pub(super) fn values_of_dictionaries(text: &str) -> Option<String> {
    const LONGEST: usize = 400;
    let mut bytes = text.as_bytes().to_vec();
    let (mut is_any, mut is_fenced) = (false, false);
    for line in super::lines::lines(text) {
        let source = text.get(line.clone()).unwrap_or_default();
        let is_fence = source.trim_start().starts_with("```");
        is_fenced ^= is_fence;
        if is_fenced || is_fence || source.len() > LONGEST {
            continue;
        }
        for (open, _) in source.match_indices('{') {
            let Some(length) = source[open..].find('}') else { break };
            let inner = &source[open + 1..open + length];
            let is_name = |n: &str| {
                n.starts_with(char::is_alphabetic) && n.chars().all(|c| c.is_alphanumeric() || c == '_')
            };
            let is_item = |item: &str| {
                item.split_once(':').is_some_and(|(name, value)| {
                    is_name(name.trim().trim_matches(['\'', '"'])) && value.trim().parse::<f64>().is_ok()
                })
            };
            let before = source[..open].trim_end();
            let named = before.strip_suffix('=').map(str::trim_end);
            let name = named.map_or("", |n| n.rsplit([' ', '`', '(']).next().unwrap_or_default());
            let is_alone = match named {
                Some(_) => is_name(name),
                None => before.is_empty() || before.ends_with(['`', ',', ':']),
            };
            if !is_alone || !inner.split(',').all(is_item) {
                continue;
            }
            let start = line.start + named.map_or(open, |n| n.len() - name.len());
            bytes[start..=line.start + open].fill(b' ');
            bytes[line.start + open + length] = b' ';
            let inside = line.start + open + 1..line.start + open + length;
            for b in &mut bytes[inside] {
                match *b {
                    b':' => *b = b'=',
                    b'\'' | b'"' => *b = b' ',
                    _ => {}
                }
            }
            is_any = true;
        }
    }
    if is_any { String::from_utf8(bytes).ok() } else { None }
}

#[cfg(test)]
mod tests {
    use super::values_of_dictionaries;

    #[test]
    fn dictionaries_are_lists_of_values() {
        for (text, expected) in [
            ("`vals = {a2: 0.45, d4: 1}` and", Some("`        a2= 0.45, d4= 1 ` and")),
            ("{'a': 2}", Some("  a = 2 ")),
            ("f({a: 2}) and x_{a: 2}", None),
            ("{a: b}", None),
            ("```python\nvals = {a2: 0.45}\n```\n", None),
        ] {
            assert_eq!(values_of_dictionaries(text).as_deref(), expected, "{text}");
        }
    }
}
