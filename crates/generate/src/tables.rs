//! Numbers as C has them in braces, and lines of bounded length.

use std::fmt::Write;

/// Width of a line.
const WIDTH: usize = 100;

/// `{1, 2, 3}`
pub fn integers<T: std::fmt::Display>(values: &[T]) -> String {
    let values: Vec<String> = values.iter().map(T::to_string).collect();
    format!("{{{}}}", values.join(", "))
}

/// A row in braces a line or more, with commas between them.
pub fn table<R: AsRef<[f64]>>(rows: &[R]) -> String {
    let rows: Vec<String> = rows.iter().map(|row| list(row.as_ref(), 4)).collect();
    rows.join(",\n")
}

/// Numbers in braces, on as many lines as they need.
pub fn list(values: &[f64], indent: usize) -> String {
    let margin = " ".repeat(indent);
    let numbers: Vec<String> = values.iter().map(|x| format!("{x:?}")).collect();
    let whole = format!("{margin}{{{}}}", numbers.join(", "));
    if whole.len() <= WIDTH {
        return whole;
    }
    let inner = wrapped(&format!("{margin}    "), &numbers.join(", "), "");
    format!("{margin}{{\n{inner}{margin}}}")
}

/// Lines of bounded length behind a prefix; those after the first are indented by `more`.
pub fn wrapped(prefix: &str, text: &str, more: &str) -> String {
    wrapped_in(WIDTH, prefix, text, more)
}

/// The same in lines of a width.
pub fn wrapped_in(width: usize, prefix: &str, text: &str, more: &str) -> String {
    let mut lines = String::new();
    let mut line = prefix.to_string();
    let mut is_empty = true;
    for word in text.split(' ') {
        if !is_empty && line.len() + 1 + word.len() > width {
            let _ = writeln!(lines, "{}", line.trim_end());
            line = format!("{prefix}{more}");
            is_empty = true;
        }
        if !is_empty {
            line.push(' ');
        }
        line.push_str(word);
        is_empty = false;
    }
    lines + line.trim_end() + "\n"
}
