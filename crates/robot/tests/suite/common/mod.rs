//! What several test files share.
#![allow(dead_code, reason = "the tests of `generate` take their part of it by path")]

pub mod printed;

use denavit::catalogue;
use denavit::description::{Description, Diagnostic, line_column};

/// A robot of the catalogue.
pub fn robot(name: &str) -> Description {
    catalogue::robot(name).unwrap_or_else(|| panic!("no robot {name}"))
}

/// A robot of `tests/cases`: what an attack or an engineer found once.
pub fn case(name: &str) -> Description {
    let path = format!("{}/../robot/tests/cases/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{path}: {e}"));
    denavit::description::read_toml(&text).unwrap_or_else(|e| panic!("{name}: {e:?}")).0
}

/// `line:column severity: message | hint` of each finding.
pub fn shown(text: &str, findings: &[Diagnostic]) -> Vec<String> {
    findings
        .iter()
        .map(|d| {
            let (line, column) = line_column(text, d.span.start);
            let hint = d.hint.as_deref().map_or(String::new(), |h| format!(" | {h}"));
            format!("{line}:{column} {}: {}{hint}", d.severity.name(), d.message)
        })
        .collect()
}

/// A small generator of numbers that look random (splitmix64).
pub struct Random(pub u64);

impl Random {
    /// A number in [0, 1).
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// A whole soak takes minutes; a test run takes a part of it (`cargo xtask soak`).
pub fn share(of: usize, usual: usize) -> usize {
    if std::env::var_os("DENAVIT_SOAK").is_some() { of } else { usual }
}

/// The robot with the parameter values that the peer used where the file gives none.
pub fn with_values(mut d: Description, values: &serde_json::Value) -> Description {
    for p in &mut d.parameters {
        if let (None, Some(x)) = (p.value, values[&*p.symbol.name()].as_f64()) {
            p.value = denavit_symbolic::Rational::from_f64(x).map(denavit_symbolic::Expr::from);
        }
    }
    d
}

/// The numbers of a JSON array.
pub fn numbers(v: &serde_json::Value) -> Vec<f64> {
    v.as_array().map(|a| a.iter().filter_map(serde_json::Value::as_f64).collect()).unwrap_or_default()
}
