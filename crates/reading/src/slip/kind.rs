//! The kinds of slips.

/// What kind of slip it is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Slip {
    /// A sign.
    Sign,
    /// A sine for a cosine, or a cosine for a sine.
    SineForCosine,
    /// Another index: another angle, another length of the same name.
    Index,
    /// Another symbol.
    Symbol,
    /// A factor is missing.
    LostFactor,
    /// A factor too many.
    ExtraFactor,
    /// A term is missing.
    LostTerm,
    /// A term too many.
    ExtraTerm,
    /// A bracket that opens or closes at the wrong place, is missing, or is too many.
    Bracket,
    /// An exponent.
    Exponent,
    /// A number.
    Number,
    /// Two names exchanged.
    Exchanged,
    /// Something else.
    Replaced,
    /// More than one slip.
    Several(Vec<Slip>),
}

impl Slip {
    /// One slip, or several.
    pub(super) fn joined(slips: &[Slip]) -> Slip {
        let single = slips.iter().flat_map(|s| match s {
            Slip::Several(all) => all.clone(),
            one => vec![one.clone()],
        });
        let mut all: Vec<Slip> = single.collect();
        match all.len() {
            1 => all.remove(0),
            _ => Slip::Several(all),
        }
    }

    /// A word for programs: `lost-factor`.
    pub fn id(&self) -> &'static str {
        match self {
            Slip::Sign => "sign",
            Slip::SineForCosine => "sine-for-cosine",
            Slip::Index => "index",
            Slip::Symbol => "symbol",
            Slip::LostFactor => "lost-factor",
            Slip::ExtraFactor => "extra-factor",
            Slip::LostTerm => "lost-term",
            Slip::ExtraTerm => "extra-term",
            Slip::Bracket => "bracket",
            Slip::Exponent => "exponent",
            Slip::Number => "number",
            Slip::Exchanged => "exchanged",
            Slip::Replaced => "replaced",
            Slip::Several(_) => "several",
        }
    }
}
