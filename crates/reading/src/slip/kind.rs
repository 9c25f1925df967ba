//! The kinds of slips, and what they are called.

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

    /// What the slip is, in words: `a sign`, `a sign and an index`.
    pub fn words(&self) -> String {
        let words = match self {
            Slip::Sign => "a sign",
            Slip::SineForCosine => "sine and cosine swapped",
            Slip::Index => "an index",
            Slip::Symbol => "another symbol",
            Slip::LostFactor => "a lost factor",
            Slip::ExtraFactor => "a factor too many",
            Slip::LostTerm => "a lost term",
            Slip::ExtraTerm => "a term too many",
            Slip::Bracket => "a bracket",
            Slip::Exponent => "an exponent",
            Slip::Number => "a number",
            Slip::Exchanged => "two names exchanged",
            Slip::Replaced => "another expression",
            Slip::Several(all) => {
                return match all.first() {
                    Some(first) if all.iter().all(|s| s == first) => {
                        format!("{}, {} times", first.words(), all.len())
                    }
                    _ => all.iter().map(Slip::words).collect::<Vec<_>>().join(" and "),
                };
            }
        };
        words.to_string()
    }
}
