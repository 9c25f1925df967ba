//! Greek letters and their names, which are TeX's.

/// The letters that TeX has a command for, but for π, which is a number here.
pub(crate) const LETTERS: [(&str, char); 31] = [
    ("alpha", 'α'),
    ("beta", 'β'),
    ("gamma", 'γ'),
    ("delta", 'δ'),
    ("epsilon", 'ε'),
    ("zeta", 'ζ'),
    ("eta", 'η'),
    ("theta", 'θ'),
    ("iota", 'ι'),
    ("kappa", 'κ'),
    ("lambda", 'λ'),
    ("mu", 'μ'),
    ("nu", 'ν'),
    ("xi", 'ξ'),
    ("rho", 'ρ'),
    ("sigma", 'σ'),
    ("tau", 'τ'),
    ("phi", 'φ'),
    ("chi", 'χ'),
    ("psi", 'ψ'),
    ("omega", 'ω'),
    ("Gamma", 'Γ'),
    ("Delta", 'Δ'),
    ("Theta", 'Θ'),
    ("Lambda", 'Λ'),
    ("Xi", 'Ξ'),
    ("Sigma", 'Σ'),
    ("Phi", 'Φ'),
    ("Psi", 'Ψ'),
    ("Omega", 'Ω'),
    ("upsilon", 'υ'),
];

/// True for a letter of the table.
pub(crate) fn is_letter(c: char) -> bool {
    LETTERS.iter().any(|g| g.1 == c)
}

/// The name of a letter.
pub fn name(letter: char) -> Option<&'static str> {
    LETTERS.iter().find(|g| g.1 == letter).map(|g| g.0)
}

/// The letter with a name, that of TeX; `vartheta` and `varphi` are θ and φ.
pub fn letter(name: &str) -> Option<char> {
    let name = name.strip_prefix("var").unwrap_or(name);
    LETTERS.iter().find(|g| g.0 == name).map(|g| g.1)
}
