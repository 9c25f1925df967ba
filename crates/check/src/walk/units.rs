//! Units that stand once behind several values: `a = 52, b = 66, c = 138 (mm)`.

use super::words::JOINTS;

/// No more values are looked at.
const MOST: usize = 12;
/// Longer names are none of lengths.
const LONGEST: usize = 24;

/// The unit of length behind the last of a list of lengths, for a value that `, b = 66, c = 138 (mm)` follows.
pub(super) fn shared(behind: &str, is_length: &dyn Fn(&str) -> bool) -> Option<&'static str> {
    const OPEN: [&str; 10] = ["(", "[", "\\,", "\\;", "\\:", "\\ ", "~", "\\mathrm{", "\\text{", "\\rm "];
    let blank = [' ', '$', '~', '&'];
    let mut rest = behind;
    for _ in 0..MOST {
        rest = match rest.trim_start_matches(blank).strip_prefix(',') {
            Some(next) => {
                let next = next.trim_start_matches(blank);
                JOINTS.iter().find_map(|j| next.strip_prefix(j.trim_start())).unwrap_or(next)
            }
            None => JOINTS.iter().find_map(|j| rest.trim_start_matches('$').strip_prefix(j))?,
        };
        let (name, value) = rest.split_at(rest.bytes().take(2 * LONGEST).position(|b| b == b'=')?);
        let name = name.trim_matches(blank);
        if name.is_empty() || name.len() > LONGEST || !is_length(name) {
            return None;
        }
        let value = value[1..].trim_start_matches(blank).trim_start_matches(['-', '−', '+']);
        let number = value.find(|c: char| !(c.is_ascii_digit() || c == '.')).unwrap_or(value.len());
        if number == 0 {
            return None;
        }
        rest = value[number..].trim_start_matches(blank);
        let unit =
            OPEN.iter().fold(rest, |r, open| r.strip_prefix(open).unwrap_or(r).trim_start_matches(blank));
        let ends = |u: &str| unit.strip_prefix(u).is_some_and(|r| !r.starts_with(char::is_alphanumeric));
        if let Some(found) = ["mm", "cm", "m"].into_iter().find(|u| ends(u)) {
            return Some(found);
        }
        rest = &value[number..];
    }
    None
}

#[cfg(test)]
mod tests {
    use super::shared;

    #[test]
    fn a_unit_behind_the_last_value() {
        let is_length = |name: &str| name.starts_with(['a', 'l']);
        for (behind, unit) in [
            (", a2 = 66, a3 = 138 (mm), q1 = 0", Some("mm")),
            (", $a_2 = 0.3$ and $a_3=0.4$ m", Some("m")),
            (" and l2 = 30 cm", Some("cm")),
            (", a2 = 0.3, q1 = 2 m", None),
            (", a2 = 0.3, a3 = 0.4; a4 = 3 mm", None),
            (", a2 = 0.3 mean", None),
            ("", None),
        ] {
            assert_eq!(shared(behind, &is_length), unit, "{behind}");
        }
    }
}
