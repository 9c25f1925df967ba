//! On what it rests that programs compute the same.

use super::{DynamicProgram, DynamicPrograms};
use crate::dynamics::base::inputs;
use crate::dynamics::expansion::are_equal;
use crate::dynamics::lagrange::{Ground, ROUNDING, STATES};
use crate::random::Random;
use denavit_program::{Program, Residue};
use denavit_symbolic::{Symbol, equal};
use rustc_hash::FxHashMap;

/// How a shortened program is held against what it was.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Held {
    /// By expansion to polynomials, where that goes.
    Expanded,
    /// At random states.
    AtStates,
}

impl DynamicPrograms {
    /// The one that is the shortest once all are shortened, in so many orders at random, with what that rests on; as it was, where
    /// it is not the same. There must be one.
    pub(super) fn shortened(&self, all: Vec<DynamicProgram>, orders: u64, held: Held) -> DynamicProgram {
        let pairs = all.into_iter().map(|long| (long.program.shortened(orders), long));
        let (program, long) = pairs.min_by_key(|(short, _)| short.count().cost()).expect("there is one");
        if program.count() == long.program.count() {
            return long;
        }
        let shortening =
            match held == Held::Expanded && are_equal(&self.model.formulas, &program, &long.program) {
                true => Ground::Proved,
                false => same(&program, &long.program, false),
            };
        match shortening {
            Ground::Failed => long,
            _ => DynamicProgram { program, shortening: long.shortening.and(shortening), ..long },
        }
    }
}

/// On what it rests that two programs are equal: their canonical forms, if these may be asked for, or values at random points, modulo a
/// prime or, where constants have no value there, in doubles.
pub(super) fn same(a: &Program, b: &Program, expands: bool) -> Ground {
    if expands && a.formulas().into_iter().zip(b.formulas()).all(|(x, y)| equal(x, y).is_equal()) {
        return Ground::Proved;
    }
    let mut random = Random(1982);
    let mut any = || (random.unit() * (1_u64 << 53) as f64) as u64;
    let mut ground = Ground::Modulo(STATES);
    for _ in 0..STATES {
        let mut at: FxHashMap<Symbol, Residue> = FxHashMap::default();
        let mut near: FxHashMap<Symbol, f64> = FxHashMap::default();
        for s in inputs(a).chain(inputs(b)) {
            at.entry(s).or_insert_with(|| Residue::input(any(), any()));
            near.entry(s).or_insert_with(|| any() as f64 / (1_u64 << 53) as f64);
        }
        let [x, y] = [a, b].map(|p| {
            let values = p.eval(|s| at.get(&s).cloned()).ok()?;
            values.iter().map(Residue::get).collect::<Option<Vec<u64>>>()
        });
        if let (Some(x), Some(y)) = (x, y) {
            if x != y {
                return Ground::Failed;
            }
            continue;
        }
        let [x, y] = [a, b].map(|p| p.eval(|s| near.get(&s).copied()).unwrap_or_default());
        let size = x.iter().fold(f64::MIN_POSITIVE, |m, v| m.max(v.abs()));
        let off = x.iter().zip(&y).map(|(v, w)| (v - w).abs() / size);
        let worst = off.fold(0.0_f64, |m, v| if v.is_nan() { f64::INFINITY } else { m.max(v) });
        if x.is_empty() || x.len() != y.len() || worst > ROUNDING {
            return Ground::Failed;
        }
        ground = ground.and(Ground::Numbers(STATES, worst));
    }
    ground
}
