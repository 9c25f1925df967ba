//! The quantities of dynamics, and which of them a name may be.

use super::points::Place;
use crate::names::Name;

/// What a formula of dynamics may be about; joints and bodies are counted from 0.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) enum Quantity {
    /// τ_i
    Torque(usize),
    /// What is not A q̈ of a torque.
    Bias(usize),
    /// A q̈
    Inertial(usize),
    /// An entry of the inertia matrix.
    Inertia(usize, usize),
    /// An entry of Ȧ.
    InertiaRate(usize, usize),
    /// Centrifugal and Coriolis torque.
    Velocity(usize),
    /// The factor of q̇_j² in row i.
    Centrifugal(usize, usize),
    /// The factor of q̇_j q̇_k, j < k, in row i.
    Coriolis(usize, usize, usize),
    /// The torque of gravity.
    Gravity(usize),
    /// T, or that of one body.
    Kinetic(Option<usize>),
    /// T of one body without the motor that turns it.
    Link(usize),
    /// T of the motor that turns a body: of its rotor, and of its mass.
    Motor(usize),
    /// V, or that of one body; both but for a constant.
    Potential(Option<usize>),
    /// T − V
    Lagrangian,
    /// T + V
    Energy,
    /// ∂T/∂q̇_i
    Momentum(usize),
    /// d/dt ∂T/∂q̇_i
    MomentumRate(usize),
    /// ∂T/∂q_i
    KineticSlope(usize),
    /// ∂L/∂q_i
    LagrangianSlope(usize),
    /// Christoffel's symbol of row i.
    Christoffel(usize, usize, usize),
    /// ∂H_ij/∂q_k − ½ ∂H_jk/∂q_i
    Asada(usize, usize, usize),
    /// An entry of C by Christoffel's symbols.
    CoriolisEntry(usize, usize),
    /// Of a point of a link a coordinate in the base, by its axis.
    Coordinate(Place, usize, usize),
    /// Its rate.
    Rate(Place, usize, usize),
    /// Its derivative by a joint variable.
    Slope(Place, usize, usize, usize),
    /// The square of the speed of a point of a link.
    Speed(Place, usize),
}

/// How many joints an arm has, and how many bodies: more, where rows follow others.
#[derive(Clone, Copy)]
pub(super) struct Size {
    pub joints: usize,
    pub bodies: usize,
}

impl Size {
    /// That of an arm with a body behind each joint.
    pub fn of(joints: usize) -> Self {
        Size { joints, bodies: joints }
    }

    /// Whether an arm of that size has a quantity.
    fn has(self, quantity: Quantity) -> bool {
        let is_joint = |all: &[usize]| all.iter().all(|k| *k < self.joints);
        match quantity {
            Quantity::Kinetic(Some(k))
            | Quantity::Link(k)
            | Quantity::Motor(k)
            | Quantity::Potential(Some(k))
            | Quantity::Coordinate(_, k, _)
            | Quantity::Rate(_, k, _)
            | Quantity::Speed(_, k) => k < self.bodies,
            Quantity::Slope(_, k, _, j) => k < self.bodies && is_joint(&[j]),
            Quantity::Torque(i)
            | Quantity::Bias(i)
            | Quantity::Inertial(i)
            | Quantity::Velocity(i)
            | Quantity::Gravity(i)
            | Quantity::Momentum(i)
            | Quantity::MomentumRate(i)
            | Quantity::KineticSlope(i)
            | Quantity::LagrangianSlope(i) => is_joint(&[i]),
            Quantity::Inertia(i, j)
            | Quantity::InertiaRate(i, j)
            | Quantity::Centrifugal(i, j)
            | Quantity::CoriolisEntry(i, j) => is_joint(&[i, j]),
            Quantity::Coriolis(i, j, k) | Quantity::Christoffel(i, j, k) | Quantity::Asada(i, j, k) => {
                is_joint(&[i, j, k])
            }
            Quantity::Kinetic(None) | Quantity::Potential(None) | Quantity::Lagrangian | Quantity::Energy => {
                true
            }
        }
    }
}

impl Quantity {
    /// True for what is known but for a constant.
    pub fn is_up_to_constant(self) -> bool {
        matches!(self, Quantity::Potential(_) | Quantity::Lagrangian | Quantity::Energy)
    }

    /// True for what depends on gravity.
    pub fn feels_gravity(self) -> bool {
        matches!(
            self,
            Quantity::Torque(_)
                | Quantity::Bias(_)
                | Quantity::Gravity(_)
                | Quantity::Potential(_)
                | Quantity::Lagrangian
                | Quantity::Energy
                | Quantity::LagrangianSlope(_)
        )
    }
}

/// What a formula speaks of.
#[derive(Clone, Copy, Default, Debug)]
pub(super) struct Content {
    pub accelerations: bool,
    pub rates: bool,
    pub gravity: bool,
}

/// The indices of a name: `12`, `1,2`, `{1 2}`, from 0 and below `n`.
pub(super) fn indices(sub: &str, n: usize) -> Option<Vec<usize>> {
    let digits: Vec<usize> = sub
        .chars()
        .filter(|c| !matches!(c, ',' | ' ' | '{' | '}' | '\\' | ';'))
        .map(|c| c.to_digit(10).map(|d| d as usize))
        .collect::<Option<_>>()?;
    let found: Vec<usize> = digits.into_iter().map(|d| d.checked_sub(1)).collect::<Option<_>>()?;
    (!found.is_empty() && found.len() <= 3 && found.iter().all(|k| *k < n)).then_some(found)
}

/// The letters of a name without what stands around it, and its indices as text.
pub(super) fn key(name: &Name) -> (String, String) {
    let sub: String = name.sub.chars().filter(|c| !matches!(c, '{' | '}' | '\\' | ' ')).collect();
    let cut = sub.find(|c: char| c.is_ascii_digit()).unwrap_or(sub.len());
    let (letters, digits) = sub.split_at(cut);
    let letters: String = letters.chars().filter(|c| c.is_alphanumeric()).collect();
    let sup: String = name.sup.chars().filter(|c| c.is_alphanumeric()).collect();
    (format!("{}{letters}{sup}", name.base), digits.to_string())
}

const TORQUES: [&str; 9] = ["τ", "Γ", "Q", "u", "T", "F", "f", "M", "N"];
const INERTIAS: [&str; 13] = ["M", "D", "A", "H", "B", "m", "d", "a", "h", "b", "J", "I", "Mm"];
const VELOCITIES: [&str; 12] = ["C", "c", "h", "H", "V", "v", "b", "B", "N", "n", "S", "ν"];
const GRAVITIES: [&str; 9] = ["G", "g", "N", "φ", "Φ", "Q", "e", "τg", "γ"];
const KINETIC: [&str; 14] =
    ["T", "K", "k", "Ek", "Ec", "KE", "W", "E", "Ekin", "Ecin", "Wk", "Tkin", "𝒯", "𝒦"];
const POTENTIAL: [&str; 14] = ["U", "V", "P", "u", "Ep", "PE", "E", "W", "Epot", "Wp", "Eg", "Up", "𝒰", "Π"];

/// Names with three indices.
const SYMBOLS: [&str; 9] = ["c", "C", "Γ", "γ", "b", "h", "H", "B", "D"];

/// True for the letters of names with three indices.
pub(super) fn is_symbol(letters: &str) -> bool {
    SYMBOLS.contains(&letters)
}

/// What a name with three indices means: a document has one meaning for each letter.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Style {
    /// Christoffel's symbol whose row is the last index.
    RowLast,
    /// Christoffel's symbol whose row is the first index.
    RowFirst,
    /// ∂H_ij/∂q_k − ½ ∂H_jk/∂q_i
    Slopes,
    /// The factor of q̇_j q̇_k in row i.
    Factors,
}

pub(super) const STYLES: [Style; 4] = [Style::RowLast, Style::RowFirst, Style::Slopes, Style::Factors];

impl Style {
    pub fn quantity(self, [i, j, k]: [usize; 3]) -> Option<Quantity> {
        Some(match self {
            Style::RowLast => Quantity::Christoffel(k, i, j),
            Style::RowFirst => Quantity::Christoffel(i, j, k),
            Style::Slopes => Quantity::Asada(i, j, k),
            Style::Factors if j < k => Quantity::Coriolis(i, j, k),
            Style::Factors if j == k => Quantity::Centrifugal(i, j),
            Style::Factors => return None,
        })
    }
}

/// The letters and the indices of a name with three of them.
pub(super) fn symbol(name: &Name, n: usize) -> Option<(String, [usize; 3])> {
    let (letters, digits) = key(name);
    let all = indices(&digits, n)?.try_into().ok()?;
    SYMBOLS.contains(&letters.as_str()).then_some((letters, all))
}

/// What a scalar with a name may be, by its letters and what its formula speaks of.
pub(super) fn of_scalar(name: &Name, size: Size, content: Content) -> Vec<Quantity> {
    let n = size.joints;
    let (letters, digits) = key(name);
    let is = |all: &[&str]| all.contains(&letters.as_str());
    // `T_{\ell_1}`, that of a link.
    let is_energy = |all: &[&str]| is(all) || letters.strip_suffix('l').is_some_and(|l| all.contains(&l));
    let mut found = vec![];
    let index = indices(&digits, n.max(size.bodies));
    let index = match index {
        None if digits.is_empty() && n == 1 => Some(vec![0]),
        other => other,
    };
    let Content { accelerations, rates, gravity } = content;
    match index.as_deref() {
        Some(&[i]) => {
            if is(&TORQUES)
                || letters == "t" && accelerations
                || letters.starts_with('τ')
                || letters.starts_with('Γ')
            {
                if accelerations {
                    found.push(Quantity::Torque(i));
                } else if rates && gravity {
                    found.push(Quantity::Bias(i));
                } else if gravity && !is(&["T", "M", "F"]) {
                    found.push(Quantity::Gravity(i));
                }
            }
            if !accelerations && rates && !gravity && (is(&VELOCITIES) || is(&["Cqd", "τc", "τC", "τv"])) {
                found.push(Quantity::Velocity(i));
            }
            if !accelerations && rates && gravity && is(&["N", "n", "h", "H", "b", "V"]) {
                found.push(Quantity::Bias(i));
            }
            if !accelerations && !rates && gravity && is(&GRAVITIES) {
                found.push(Quantity::Gravity(i));
            }
            if !accelerations && rates && !gravity && is_energy(&KINETIC) {
                found.push(Quantity::Kinetic(Some(i)));
            }
            // `T_{m_1}`
            let is_motor = letters.strip_suffix('m').is_some_and(|l| KINETIC.contains(&l));
            if !accelerations && rates && !gravity && is_motor {
                found.push(Quantity::Motor(i));
            }
            if !accelerations && !rates && gravity && is_energy(&POTENTIAL) {
                found.push(Quantity::Potential(Some(i)));
            }
            if n == 1 && !accelerations && !rates && !gravity && is(&INERTIAS) {
                found.push(Quantity::Inertia(0, 0));
            }
        }
        Some(&[i, j]) => {
            let is_still = !accelerations && !rates && !gravity;
            if is_still && is(&INERTIAS) {
                found.push(Quantity::Inertia(i, j));
            }
            if !accelerations && !gravity && rates && is(&["C", "c", "h", "b", "V"]) {
                found.push(Quantity::CoriolisEntry(i, j));
            }
            if !accelerations && rates && is(&["dotM", "dotD", "dotA", "dotH", "dotB", "dotm", "dotd"]) {
                found.push(Quantity::InertiaRate(i, j));
            }
        }
        Some(&[i, j, k]) if !accelerations && !rates && !gravity && is(&SYMBOLS) => {
            found.extend(STYLES.iter().filter_map(|style| style.quantity([i, j, k])));
        }
        _ => {}
    }
    found.retain(|q| size.has(*q));
    if digits.is_empty() {
        if size.bodies > 1 {
            // Of several bodies the one is not named.
            found.retain(|q| {
                !matches!(q, Quantity::Kinetic(Some(_)) | Quantity::Motor(_) | Quantity::Potential(Some(_)))
            });
        }
        if letters == "L" || letters == "ℒ" {
            found.push(Quantity::Lagrangian);
        }
        if !accelerations && rates && !gravity && is(&KINETIC) {
            found.push(Quantity::Kinetic(None));
        }
        if !accelerations && rates && gravity && is(&["E", "H", "W"]) {
            found.push(Quantity::Energy);
        }
        if !accelerations && !rates && gravity && is(&POTENTIAL) {
            found.push(Quantity::Potential(None));
        }
    }
    found.dedup();
    found
}

/// What a vector with a name may be: for each of its rows.
pub(super) fn of_vector(name: &Name, content: Content) -> Vec<fn(usize) -> Quantity> {
    let (letters, _) = key(name);
    let is = |all: &[&str]| all.contains(&letters.as_str());
    let Content { accelerations, rates, gravity } = content;
    let mut found: Vec<fn(usize) -> Quantity> = vec![];
    if accelerations {
        if is(&TORQUES) {
            found.push(Quantity::Torque);
        }
    } else if rates && gravity {
        if is(&VELOCITIES) || is(&TORQUES) {
            found.push(Quantity::Bias);
        }
    } else if rates {
        if is(&VELOCITIES) || is(&["Cqd", "τc"]) {
            found.push(Quantity::Velocity);
        }
    } else if gravity && (is(&GRAVITIES) || is(&["τ", "Γ"])) {
        found.push(Quantity::Gravity);
    }
    found
}

/// True for a name of the inertia matrix.
pub(super) fn is_inertia(name: &Name) -> bool {
    let (letters, digits) = key(name);
    digits.is_empty() && INERTIAS.contains(&letters.as_str())
}

/// True for a name of the matrix of the velocity torques, or of one part of it.
pub(super) fn is_coriolis(name: &Name) -> bool {
    let (letters, digits) = key(name);
    digits.is_empty() && ["C", "c", "V", "B", "b", "Vm", "Cm", "D", "H"].contains(&letters.as_str())
}
