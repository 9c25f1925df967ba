//! The ways in which a linkage can be assembled: of each dyad with two solutions, one.

use super::affine::within_turn;
use super::order::{Dyad, Plan, Step};
use super::{Linkage, Told};
use denavit_symbolic::{Angle, Expr, Rational, Symbol};
use std::fmt;

/// Which solution of a dyad is meant.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Sign {
    /// The root with its plus: the triangle of the dyad turns as the normal of the loop does; of one with a slide, the other two
    /// lie on the side of the slide's direction; of a spherical loop, on which side of each other its three axes lie.
    Plus,
    /// The root with its minus.
    Minus,
    /// The affine solution of a parallelogram or a kite.
    Affine,
    /// The other solution of such a one.
    Crossed,
    /// There is but one.
    Single,
}

/// One way to assemble a linkage: a sign for each step of its [`Plan`].
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub struct Mode(pub Vec<Sign>);

/// The signs of the steps with two solutions, in order: `+`, `-`, `=` (affine) and `x` (crossed).
impl fmt::Display for Mode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().filter_map(|s| s.letter()).try_for_each(|c| write!(f, "{c}"))
    }
}

/// Why there is no such mode.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum NoMode {
    /// It is neither a name nor the signs of one.
    Unknown {
        /// What was asked for.
        text: String,
        /// What there is: names, then signs.
        known: Vec<String>,
    },
    /// What a named one is told by holds in none.
    Nowhere(String),
}

impl fmt::Display for NoMode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NoMode::Unknown { text, known } if known.is_empty() => {
                write!(f, "no assembly mode `{text}`: there is but one")
            }
            NoMode::Unknown { text, known } => {
                write!(f, "no assembly mode `{text}`; there are {}", known.join(", "))
            }
            NoMode::Nowhere(name) => {
                write!(f, "there is no assembly mode in which all that tells `{name}` holds")
            }
        }
    }
}

impl Sign {
    /// How it is written.
    pub fn letter(self) -> Option<char> {
        match self {
            Sign::Plus => Some('+'),
            Sign::Minus => Some('-'),
            Sign::Affine => Some('='),
            Sign::Crossed => Some('x'),
            Sign::Single => None,
        }
    }
}

/// So many modes are listed.
const MOST_MODES: usize = 64;
/// So many beginnings of modes are tried for relations.
const MOST_TRIED: usize = 4_096;

impl Step {
    /// The signs that its solutions have.
    pub fn signs(&self) -> &'static [Sign] {
        match &self.dyad {
            Dyad::Slides { .. } => &[Sign::Single],
            Dyad::Turns { affine, .. } if !affine.is_empty() => &[Sign::Affine, Sign::Crossed],
            _ => &[Sign::Plus, Sign::Minus],
        }
    }

    /// The unknown angles with this sign, where they are affine in what is known.
    pub fn affine(&self, sign: Sign) -> Vec<(Symbol, Option<Angle>)> {
        let found = match (&self.dyad, sign) {
            (Dyad::Turns { affine, .. }, Sign::Affine) => affine.first(),
            (Dyad::Turns { affine, .. }, Sign::Crossed) => affine.get(1),
            _ => None,
        };
        let own = |angle: &super::order::Sum| {
            if matches!(self.dyad, Dyad::Spherical(_)) {
                return (angle.symbol, None);
            }
            let [turn, one, two] = angle.of;
            let times = |a: &Angle, k: i64| a.scaled(&Rational::from(k));
            let form = match (found, one, two) {
                (_, 0, 0) => Some(times(&self.turn, turn)),
                (Some([a, b]), ..) => Some(times(&self.turn, turn).plus(&times(a, one)).plus(&times(b, two))),
                (None, ..) => None,
            };
            (angle.symbol, form.map(|f| within_turn(&f)))
        };
        let angles = self.angles.iter().map(own);
        let slides = self.unknowns().into_iter().skip(self.angles.len()).map(|s| (s, None));
        angles.chain(slides).collect()
    }
}

impl Plan {
    /// The mode that is meant where nothing is said: affine solutions, and plus.
    pub fn usual(&self) -> Mode {
        Mode(self.steps.iter().map(|s| s.signs()[0]).collect())
    }

    /// How many modes there are at most.
    pub fn count(&self) -> usize {
        self.steps.iter().map(Step::solutions).fold(1, usize::saturating_mul)
    }

    /// The modes, the usual one first; of very many the first.
    pub fn modes(&self) -> Vec<Mode> {
        let mut all = vec![Mode(vec![])];
        for step in self.steps.iter().rev() {
            let longer = step
                .signs()
                .iter()
                .flat_map(|&sign| all.iter().map(move |m: &Mode| Mode([&[sign], &m.0[..]].concat())));
            all = longer.take(MOST_MODES).collect();
        }
        all
    }

    /// The passive variables in this mode, in the driven ones, where they are affine in them.
    pub fn affine(&self, mode: &Mode) -> Vec<(Symbol, Option<Expr>)> {
        let mut known: Vec<(Symbol, Option<Expr>)> = vec![];
        for (step, &sign) in self.steps.iter().zip(&mode.0) {
            for (symbol, form) in step.affine(sign) {
                let value = form.and_then(|f| {
                    let e = f.to_expr();
                    let of = |s: Symbol| known.iter().find(|k| k.0 == s);
                    if e.symbols().into_iter().any(|s| of(s).is_some_and(|k| k.1.is_none())) {
                        return None;
                    }
                    let e = e.substitute(|s| of(s)?.1);
                    Some(within_turn(&Angle::of(e)).to_expr())
                });
                known.push((symbol, value));
            }
        }
        known
    }

    /// The mode of these signs.
    fn of_signs(&self, text: &str) -> Option<Mode> {
        let plain = |c: char| match c {
            '−' => '-',
            '∥' => '=',
            '×' | 'X' => 'x',
            other => other,
        };
        let mut letters = text.trim().chars().map(plain);
        let mut signs = vec![];
        for step in &self.steps {
            signs.push(match step.signs() {
                [one] => *one,
                several => {
                    let letter = letters.next()?;
                    *several.iter().find(|s| s.letter() == Some(letter))?
                }
            });
        }
        letters.next().is_none().then_some(Mode(signs))
    }

    /// The mode in which these relations hold, whatever the driven joints are; the usual one as far as they say nothing.
    fn of_relations(&self, relations: &[(Symbol, Expr)]) -> Option<Mode> {
        let mut left = MOST_TRIED;
        let mut mode = Mode(vec![]);
        self.chosen(relations, &mut mode, &mut left).then_some(mode)
    }

    /// Goes on with a mode step by step, so that what is found holds; true if it is whole.
    fn chosen(&self, relations: &[(Symbol, Expr)], mode: &mut Mode, left: &mut usize) -> bool {
        let affine = self.affine(mode);
        let holds = |(symbol, told): &(Symbol, Expr)| match affine.iter().find(|a| a.0 == *symbol) {
            // A later step finds it.
            None => mode.0.len() < self.steps.len(),
            Some((_, found)) => {
                let rest = found.map(|e| within_turn(&Angle::of(e - *told)));
                rest.is_some_and(|rest| rest == Angle::default())
            }
        };
        if *left == 0 || !relations.iter().all(holds) {
            return false;
        }
        *left -= 1;
        let Some(step) = self.steps.get(mode.0.len()) else { return true };
        step.signs().iter().any(|&sign| {
            mode.0.push(sign);
            self.chosen(relations, mode, left) || {
                mode.0.pop();
                false
            }
        })
    }
}

impl Linkage {
    /// The mode of this name or of these signs; that which is meant where nothing is asked for.
    ///
    /// # Errors
    /// If there is none.
    pub fn mode(&self, plan: &Plan, asked: Option<&str>) -> Result<Mode, NoMode> {
        let named = match asked {
            None => self.modes.first(),
            Some(text) => self.modes.iter().find(|m| m.name == text.trim()),
        };
        match (named, asked) {
            (Some(named), _) => {
                let mode = match &named.told {
                    Told::Signs(text) => plan.of_signs(text),
                    Told::Relations(all) => {
                        // Where lengths are the same by their values alone, so are the forms.
                        let of_names = plan.of_relations(all);
                        of_names.or_else(|| {
                            let numbers = self.in_numbers();
                            let at = self.modes.iter().position(|m| m.name == named.name)?;
                            let Told::Relations(all) = &numbers.modes[at].told else { return None };
                            Plan::of(&numbers).of_relations(all)
                        })
                    }
                };
                mode.ok_or_else(|| NoMode::Nowhere(named.name.clone()))
            }
            (None, None) => Ok(plan.usual()),
            (None, Some(text)) => plan.of_signs(text).ok_or_else(|| {
                let signs = plan.modes().into_iter().map(|m| m.to_string()).filter(|m| !m.is_empty());
                let names = self.modes.iter().map(|m| m.name.clone());
                NoMode::Unknown { text: text.into(), known: names.chain(signs).collect() }
            }),
        }
    }

    /// What a mode is called, if it has a name.
    pub fn mode_name(&self, plan: &Plan, mode: &Mode) -> Option<&str> {
        let found = self.modes.iter().find(|m| self.mode(plan, Some(&m.name)).as_ref() == Ok(mode));
        found.map(|m| m.name.as_str())
    }
}
