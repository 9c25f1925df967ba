//! Columns of which there is one a joint, by their names: of rates, of torques.

use crate::spelled::{numbered, plain};

/// The columns of a quantity, one a joint: names in front of numbers that are known for it (`tau1`, `effort[0]`), or a joint's own name
/// before or behind one of these (`elbow_torque`). What is known is small letters and digits.
pub fn columns_of_joints(names: &[&str], joints: &[Vec<String>], known: &[&str]) -> Option<Vec<usize>> {
    let count = joints.first().map_or(0, Vec::len);
    for word in known {
        let mut found: Vec<(usize, usize)> = vec![];
        for (k, name) in names.iter().enumerate() {
            if let Some((stem, number)) = numbered(name).filter(|(stem, _)| stem == word) {
                found.extend((!stem.is_empty()).then_some((number, k)));
            }
        }
        found.sort_unstable();
        if found.len() == count && count > 0 {
            return Some(found.into_iter().map(|f| f.1).collect());
        }
    }
    let all: Vec<String> = names.iter().map(|n| plain(n)).collect();
    for own in joints {
        let find = |joint: &String| {
            let joint = plain(joint);
            let is = |name: &String| {
                known.iter().any(|w| *name == format!("{joint}{w}") || *name == format!("{w}{joint}"))
            };
            all.iter().position(is)
        };
        if let Some(found) = own.iter().map(find).collect::<Option<Vec<usize>>>().filter(|f| !f.is_empty()) {
            return Some(found);
        }
    }
    None
}
