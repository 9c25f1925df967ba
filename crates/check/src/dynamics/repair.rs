//! The slip in a formula of dynamics, in the author's notation.

use super::model::State;
use super::statements::{Piece, Read};
use crate::judge::slip;
use crate::outcome::Slip;
use crate::subject::Subject;
use denavit::description::JointKind;
use denavit_reading::slip::{Effort, Lexicon, Repair, Slip as Kind, Wanted, repairs};
use denavit_symbolic::Expr;
use denavit_symbolic::parse::{Syntax, SyntaxKind};
use denavit_symbolic::readable::{literals, simplify};
use denavit_symbolic::vocabulary::Vocabulary;

/// The cost of the largest change that is called a slip; a sign costs 10.
const MAX_COST: u32 = 60;
/// The cost of the largest lost term, which may be long.
const MAX_TERM: u32 = 100;
/// No more formulas are looked at.
const MAX_SLIPS: usize = 120;
/// Longer formulas are not simplified.
const MAX_LITERALS: u64 = 6_000;

/// Looks for slips.
pub(super) struct Repairer<'a> {
    text: &'a str,
    names: &'a Vocabulary,
    lexicon: Option<Lexicon>,
    budget: usize,
}

impl<'a> Repairer<'a> {
    pub fn new(text: &'a str, subject: &Subject, read: &'a Read, state: &State) -> Self {
        let mut atoms: Vec<Expr> = vec![];
        let variables = subject.description.variables();
        let mut sum: Option<Expr> = None;
        for v in &variables {
            let q = Expr::from(v.symbol);
            atoms.push(q);
            if v.kind == JointKind::Revolute {
                let (s, c) = q.sin_cos();
                atoms.extend([s, c]);
                if let Some(before) = sum {
                    let (s, c) = (before + q).sin_cos();
                    atoms.extend([s, c]);
                }
                sum = Some(sum.map_or(q, |before| before + q));
            }
        }
        atoms.extend(state.qd.iter().chain(&state.qdd).map(|s| Expr::from(*s)));
        let mut spellings: Vec<(Expr, String)> = vec![];
        for piece in &read.pieces {
            let source = text.get(piece.span.clone()).unwrap_or_default();
            if let Some(syntax) = &piece.syntax {
                visit(syntax, &mut |part| {
                    if let SyntaxKind::Name(e) = part.kind
                        && let Some(spelled) = source.get(part.span.clone())
                        && spelled.len() < 60
                    {
                        spellings.push((e, spelled.to_string()));
                        if !atoms.contains(&e) && e.symbols().len() <= 3 && atoms.len() < 200 {
                            atoms.push(e);
                        }
                    }
                });
            }
        }
        spellings.sort_by(|a, b| a.1.cmp(&b.1));
        spellings.dedup();
        let mut lexicon = Lexicon::new(&atoms, &[]);
        if let Some(lexicon) = &mut lexicon {
            for (e, text) in &spellings {
                lexicon.spelled(*e, text);
            }
        }
        Repairer { text, names: &read.vocabulary, lexicon, budget: MAX_SLIPS }
    }

    /// Learns from a right formula how the author writes.
    pub fn learn(&mut self, piece: &Piece) {
        if let (Some(lexicon), Some(syntax)) = (&mut self.lexicon, &piece.syntax) {
            lexicon.learn(self.text.get(piece.span.clone()).unwrap_or_default(), syntax);
        }
    }

    /// The smallest changes that make a formula what is wanted, their cost, and what the changed formula is.
    pub fn slips(&mut self, piece: &Piece, wanted: Expr) -> Option<(u32, Vec<Slip>, Expr)> {
        let (lexicon, printed) = (self.lexicon.as_mut()?, piece.syntax.as_ref()?);
        self.budget = self.budget.checked_sub(1)?;
        let source = self.text.get(piece.span.clone())?;
        let wanted = match literals(wanted) <= MAX_LITERALS {
            true => simplify(wanted, &wanted.symbols()).map_or(wanted, |s| s.expr),
            false => wanted,
        };
        let found =
            repairs(source, printed, &Wanted::Formula(wanted), lexicon, self.names, Effort::default());
        let limit = |r: &Repair| if r.slip == Kind::LostTerm { MAX_TERM } else { MAX_COST };
        let (best, value) = found.first().map(|r| (r.cost, r.value))?;
        let close = found.into_iter().filter(|r| r.cost <= best.min(limit(r))).take(4);
        let found: Vec<Slip> = close.map(|r| slip(r, piece.span.start)).collect();
        (!found.is_empty()).then_some((best, found, value))
    }
}

fn visit(syntax: &Syntax, each: &mut dyn FnMut(&Syntax)) {
    each(syntax);
    syntax.children().into_iter().for_each(|part| visit(part, each));
}
