//! Which statements of a document are about dynamics.

use super::letters::{Letters, is_body as is_lettered, letters};
use super::measures::measures;
use super::points::{Kind, Named, named};
use super::quantity::{Content, Quantity, Size, is_coriolis, is_inertia, is_symbol, key, of_scalar};
use super::statements::{formula_span, lone_name, word};
use super::words::{Role, role, words};
use denavit_reading::document::{Document, Part, Statement};
use std::collections::BTreeSet;
use std::ops::Range;

/// No more statements of dynamics are judged.
const MAX_TAKEN: usize = 400;
/// Longer statements are no formulas that people print.
const LONGEST: usize = 20_000;
/// Arms have no more joints here than an index has digits.
const JOINTS: usize = 9;

/// Words that speak of dynamics.
const SAYS: [&str; 32] = [
    "mass",
    "masa",
    "gravit",
    "gravedad",
    "gravidade",
    "schwer",
    "pesanteur",
    "torque",
    "couple",
    "coppi",
    "kinetic",
    "kinetisch",
    "cinétique",
    "cinetique",
    "cinetic",
    "cinétic",
    "inertia matri",
    "mass matri",
    "massenmatrix",
    "trägheit",
    "inertie",
    "inerzia",
    "inercia",
    "inércia",
    "coriolis",
    "lagrang",
    "dynami",
    "dynamik",
    "dinámic",
    "dinamic",
    "dinâmic",
    "equations of motion",
];

/// True for a text that may have formulas of dynamics.
fn may_be(text: &str) -> bool {
    let lower = text.to_lowercase();
    has_accelerations(text) || SAYS.iter().any(|w| lower.contains(w))
}

fn has_accelerations(source: &str) -> bool {
    let spelled = ["\\ddot", "\u{308}", "ddq", "qdd", "ddtheta", "thetadd", "ddθ", "θdd", "ddot"];
    spelled.iter().any(|s| source.contains(s)) || source.contains("dd(")
}

fn has_rates(source: &str) -> bool {
    let spelled = ["\\dot", "\u{307}", "dq", "qd", "dtheta", "thetad", "dθ", "θd", "dot"];
    spelled.iter().any(|s| source.contains(s))
}

/// What a statement mentions of dynamics.
struct Spoken {
    is_certain: bool,
    words: BTreeSet<String>,
    has_rates: bool,
}

fn spoken(source: &str, has_jacobians: bool, matrices: &BTreeSet<String>, letters: &[char]) -> Spoken {
    let words = words(source);
    let has_rates = has_rates(source);
    let has = |w: &str| words.contains(w);
    let is_body = |w: &String| {
        let is_jacobian = has_jacobians && w.starts_with('J');
        let numbered = matches!(
            role(w, JOINTS),
            Some(
                Role::Mass(Some(_))
                    | Role::Motor(_)
                    | Role::Rotor(Some(_))
                    | Role::Inertia(Some(_))
                    | Role::About(..)
                    | Role::Ten(..)
            )
        );
        // `M_1 = [4 × 4]` is a matrix of this name.
        let is_matrix = matches!(role(w, JOINTS), Some(Role::Mass(_))) && matrices.contains(w);
        (numbered || is_lettered(w, letters)) && !is_jacobian && !is_matrix
    };
    let lone = ["m", "M", "I", "J"].iter().any(|w| has(w));
    let is_certain = has_accelerations(source)
        || words.iter().any(is_body)
        || has("m") && (has("g") || has("g0"))
        || has("M") && has("g")
        || lone && has_rates && !has_jacobians;
    Spoken { is_certain, words, has_rates }
}

/// Takes the statements about dynamics out of a document; those within `rows` are of tables.
pub(in crate::dynamics) fn taken(
    text: &str,
    document: &mut Document,
    rows: &[Range<usize>],
) -> Vec<Statement> {
    if !may_be(text) {
        return vec![];
    }
    let has_jacobians = text.to_lowercase().contains("jacob");
    // Names of matrices, which are no masses.
    let is_grid = |s: &Statement| s.sides.iter().flat_map(|s| &s.parts).any(|p| matches!(p, Part::Matrix(_)));
    let grids = document.statements.iter().filter(|s| is_grid(s)).flat_map(|s| &s.sides);
    let matrices: BTreeSet<String> =
        grids.filter_map(|side| Some(word(&lone_name(text, &formula_span(side)?)?))).collect();
    let sources = document.statements.iter().filter(|s| s.span.len() <= LONGEST);
    let mentioned: BTreeSet<String> =
        sources.filter_map(|s| text.get(s.span.clone())).flat_map(words).collect();
    let letters = letters(&mentioned, text);
    let is_mass = |w: &String| matches!(role(w, JOINTS), Some(Role::Mass(_)));
    let is_measured = measures(text).keys().any(is_mass);
    let mut is_off = false;
    let mut found: Vec<(usize, Spoken)> = vec![];
    let mut is_taken = vec![false; document.statements.len()];
    let mut is_free = vec![true; document.statements.len()];
    for (at, statement) in document.statements.iter().enumerate() {
        for directive in &statement.directives {
            match directive.words.trim() {
                "off" => is_off = true,
                "on" => is_off = false,
                _ => {}
            }
        }
        let is_row = rows.iter().any(|t| t.start <= statement.span.start && statement.span.end <= t.end);
        if is_off || !statement.directives.is_empty() || is_row || statement.span.len() > LONGEST {
            is_free[at] = false;
            continue;
        }
        if found.len() >= 20 * MAX_TAKEN {
            break;
        }
        let source = text.get(statement.span.clone()).unwrap_or_default();
        let spoken = spoken(source, has_jacobians, &matrices, &letters);
        let is_number = statement.sides.len() < 2;
        let is_inertia = || {
            let name = statement.sides.first().and_then(formula_span).and_then(|s| lone_name(text, &s));
            let name =
                name.filter(|n| n.left.is_empty() && !n.is_inverse && !(has_jacobians && n.base == "J"));
            // `M_{11} = m l^2`
            let is_entry = name.as_ref().is_some_and(|n| {
                let still = of_scalar(n, Size::of(JOINTS), Content::default());
                matches!(still[..], [Quantity::Inertia(..)])
            });
            // `c_{112} = -m l^2 s_2 c_2`
            let is_symbol = name.as_ref().is_some_and(|n| {
                let (letters, digits) = key(n);
                digits.len() == 3 && is_symbol(&letters)
            });
            let role = name.and_then(|n| role(&word(&n), JOINTS));
            (matches!(role, Some(Role::Inertia(_) | Role::About(..))) || is_entry || is_symbol)
                && spoken.words.contains("m")
        };
        let is_said = (spoken.is_certain || is_inertia()) && !is_number && !is_measure(text, statement);
        if is_said || is_form(source) || is_measured && is_in_numbers(text, statement) {
            is_taken[at] = true;
        }
        found.push((at, spoken));
    }
    if !is_taken.contains(&true) {
        return vec![];
    }
    // Beside Khalil's numbers all that leads to a torque, whatever it is called.
    let is_ten = |w: &String| matches!(role(w, JOINTS), Some(Role::Ten(..)));
    let is_khalil = mentioned.iter().filter(|w| is_ten(w)).count() > 1;
    // What uses a name that is defined there, as `C` does below `h = …`.
    for _ in 0..12 {
        // `c_{121} = … = h` defines both.
        let defined: BTreeSet<String> = (0..is_taken.len())
            .filter(|at| is_taken[*at])
            .flat_map(|at| &document.statements[at].sides)
            .filter_map(|side| Some(word(&lone_name(text, &formula_span(side)?)?)))
            .collect();
        // `c_{222} = 0` beside other symbols of the same name.
        let family = |at: usize| {
            let side = formula_span(document.statements[at].sides.first()?)?;
            let (letters, digits) = key(&lone_name(text, &side)?);
            (!digits.is_empty()).then_some((letters, digits.len()))
        };
        let families: BTreeSet<(String, usize)> =
            (0..is_taken.len()).filter(|at| is_taken[*at]).filter_map(family).collect();
        let mut is_new = false;
        // What formulas of dynamics speak of.
        let used = found.iter().filter(|(at, _)| is_taken[*at]).flat_map(|(_, spoken)| &spoken.words);
        let used: BTreeSet<&String> = used.collect();
        for (at, spoken) in &found {
            if is_taken[*at] || document.statements[*at].sides.len() < 2 {
                continue;
            }
            let statement = &document.statements[*at];
            // `x_2` beside a `y_2` that is used.
            let is_used = |p: &Named| {
                let axes = || ["x", "y", "z"].into_iter().filter(|_| p.word.starts_with(['x', 'y', 'z']));
                used.contains(&p.word) || axes().any(|a| used.contains(&format!("{a}{}", &p.word[1..])))
            };
            if point(text, statement).is_some_and(|p| p.is_centre || is_used(&p)) {
                is_taken[*at] = true;
                is_new = true;
                continue;
            }
            // `w2hz = qd1 + qd2`, which torques use.
            let name = formula_span(&statement.sides[0]).and_then(|s| lone_name(text, &s)).map(|n| word(&n));
            let is_own = |w: &String| {
                used.contains(w)
                    && w.chars().filter(|c| c.is_alphabetic()).count() > 1
                    && w.contains(|c: char| c.is_ascii_digit())
            };
            let is_needed = spoken.has_rates && name.as_ref().is_some_and(is_own);
            let is_used = |n: &String| used.contains(n) || spoken.words.iter().any(|w| defined.contains(w));
            if is_needed || is_khalil && name.as_ref().is_some_and(|n| !is_common(n) && is_used(n)) {
                is_taken[*at] = true;
                is_new = true;
                continue;
            }
            let uses = spoken.words.iter().any(|w| defined.contains(w) && !is_common(w));
            let is_kin = || family(*at).is_some_and(|f| families.contains(&f));
            if (uses || is_kin()) && is_of_dynamics(text, statement, spoken) {
                is_taken[*at] = true;
                is_new = true;
            }
        }
        if !is_new {
            break;
        }
    }
    let mut taken = vec![];
    let mut at = 0;
    document.statements.retain(|statement| {
        let is_here = is_taken.get(at).copied().unwrap_or(false) && is_free[at] && taken.len() < MAX_TAKEN;
        at += 1;
        if is_here {
            taken.push(statement.clone());
        }
        !is_here
    });
    taken
}

/// True for what says how matrices make torques, `M(q) q̈ + C(q, q̇) q̇ + g(q) = τ`, or for the end of it.
pub(super) fn is_form(source: &str) -> bool {
    let plain: String =
        source.chars().filter(|c| !c.is_whitespace() && !matches!(c, '{' | '}' | '$')).collect();
    let parts = ["M(q)", "D(q)", "H(q)", "B(q)", "A(q)", "C(q,", "V(q,", "h(q,", "G(q)", "g(q)", "N(q,"];
    let parts = parts.iter().filter(|part| plain.contains(**part)).count();
    let is_torque = ["τ", "\\tau", "Γ", "\\Gamma", "=Q", "=u"].iter().any(|t| plain.contains(t));
    parts > 0 && is_torque && has_rates(source) && !plain.contains(|c: char| c.is_ascii_digit())
}

/// What the left side of a statement says of a point that a body has; of one without a mark, `x_2`, a number.
fn point(text: &str, statement: &Statement) -> Option<Named> {
    let span = formula_span(statement.sides.first()?)?;
    let named = named(text, &span, JOINTS, &Letters::new())?;
    let is_grid = statement.sides.iter().flat_map(|s| &s.parts).any(|p| matches!(p, Part::Matrix(_)));
    let is_vector = named.kind.is_matrix() || is_grid && named.kind == Kind::Speed;
    (is_vector == is_grid && (named.is_centre || !is_grid)).then_some(named)
}

/// Names of kinematics, which say nothing of dynamics.
fn is_common(word: &str) -> bool {
    matches!(word, "T" | "J" | "x" | "y" | "z" | "q" | "θ")
}

/// True for a statement whose left side may be a quantity of dynamics.
fn is_of_dynamics(text: &str, statement: &Statement, spoken: &Spoken) -> bool {
    let Some(side) = statement.sides.first().and_then(formula_span) else { return spoken.has_rates };
    let Some(name) = lone_name(text, &side) else { return spoken.has_rates };
    let is_grid = statement.sides.iter().flat_map(|s| &s.parts).any(|p| matches!(p, Part::Matrix(_)));
    let kinds = [(false, true, false), (false, false, true), (false, false, false), (true, true, true)];
    let is_scalar = kinds.iter().any(|&(accelerations, rates, gravity)| {
        !of_scalar(&name, Size::of(JOINTS), Content { accelerations, rates, gravity }).is_empty()
    });
    is_scalar || is_grid && (is_inertia(&name) || is_coriolis(&name) || spoken.has_rates)
}

/// True for what may be a quantity of dynamics with numbers for masses and lengths: `M_{11} = 3.7 + 1.6 \\cos q_2`.
fn is_in_numbers(text: &str, statement: &Statement) -> bool {
    let [left, right] = &statement.sides[..] else { return false };
    let (Some(left), Some(right)) = (formula_span(left), formula_span(right)) else { return false };
    let Some(name) = lone_name(text, &left) else { return false };
    let (_, digits) = key(&name);
    let is_other = matches!(name.base.as_str(), "A" | "J" | "I" | "T" | "R" | "P" | "X");
    let is_large = name.base.starts_with(|c: char| c.is_uppercase() || c == 'τ');
    let source = text.get(right).unwrap_or_default();
    if is_other || !is_large || digits.is_empty() || !source.contains(|c: char| c.is_ascii_digit()) {
        return false;
    }
    let is = |rates: bool, gravity: bool| {
        !of_scalar(&name, Size::of(JOINTS), Content { accelerations: false, rates, gravity }).is_empty()
    };
    let has_joint = source.contains(['c', 's']);
    is(false, false) || has_joint && (is(has_rates(source), true) || is(true, false))
}

/// True for a value in numbers, `m_1 = 2 kg`.
pub(super) fn is_measure(text: &str, statement: &Statement) -> bool {
    let is_value =
        |s: &str| s.trim().trim_start_matches(['-', '−']).starts_with(|c: char| c.is_ascii_digit());
    let first = statement.sides.first().and_then(formula_span);
    if first.and_then(|s| lone_name(text, &s)).is_none() {
        return false;
    }
    let sides = statement.sides.iter().skip(1);
    let is_unit = |w: &str| matches!(w, "m" | "k" | "g");
    let is_short = |s: &str| s.split_whitespace().count() <= 2 && !s.contains(['\\', '(', '_']);
    let shown: Vec<&str> = sides.map(|s| text.get(s.span.clone()).unwrap_or_default()).collect();
    !shown.is_empty()
        && shown.iter().all(|s| {
            is_value(s) && is_short(s) && words(s).iter().all(|w| role(w, 9).is_none() || is_unit(w))
        })
}
