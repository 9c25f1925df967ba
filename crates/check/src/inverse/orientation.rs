//! Printed formulas for roll-pitch-yaw and Euler angles in the entries of a rotation matrix.

use super::compare::{Comparison, Formulas, apart, fails_at, share};
use super::condition;
use super::judgement::{Fault, Grounds, Judgement, Origin, Right, Undecided, Verdict, Where};
use super::mend;
use super::proof;
use super::setting::{Sample, Setting, Unknown};
use denavit::geometry::Rotation;
use denavit::geometry::orientation::{OrientationSet, extract, extraction_formulas, rotation};
use denavit::random::Random;
use denavit_symbolic::{Expr, Symbol};
use std::f64::consts::{FRAC_PI_2, PI};

/// Orientations that are compared.
const SAMPLES: usize = 150;
/// Special ones beside.
const SPECIAL: usize = 40;

/// The answer about the angles of an orientation.
#[derive(Clone, Debug)]
pub struct Orientation {
    /// What is positive in the range of the angles that is meant: sin θ for a set like `zyz`, cos θ for `rpy` and its
    /// kin, or its negative. Outside it, and at its ends, the formulas give the other angles or none.
    pub range: Expr,
    /// Each angle with its judgement, in that range.
    pub angles: Vec<(String, Judgement)>,
}

/// Judges formulas for the angles of a set (roll, pitch, yaw; φ, θ, ψ) in the entries of a matrix by rows. `angles` are
/// names of the set with their formulas; nothing for a set without angles, or where a name is none of its own.
pub fn orientation(
    set: OrientationSet,
    angles: &[(String, Expr)],
    entries: &[[Symbol; 3]; 3],
) -> Option<Orientation> {
    let names = set.names();
    let variables: Vec<Symbol> = names.iter().map(|n| Symbol::new(&format!("angle {n}"))).collect();
    let matrix = Rotation::from_rows(entries.map(|row| row.map(Expr::from)));
    let formulas = extraction_formulas(&matrix, set)?;
    let places: Option<Vec<usize>> = angles.iter().map(|(n, _)| names.iter().position(|m| m == n)).collect();
    let places = places?;
    let meant = turned(set, &variables);
    let values = (0..3).flat_map(|r| (0..3).map(move |c| (r, c)));
    let rows = meant.rows();
    let by_table = values.map(|(r, c)| (entries[r][c], rows[r][c])).collect();
    let setting = Setting::new(variables.clone(), vec![true; 3], by_table, vec![], 1.0);
    let middle = Expr::from(variables[1]);
    let is_proper = matches!(set, OrientationSet::Euler(e) if e.is_proper());
    let range = if is_proper { middle.sin() } else { middle.cos() };

    // The usual range, or the other one, if the formulas suit it better.
    let judged = |other: bool| -> Vec<(String, Judgement)> {
        let [samples, special] = samples(set, other, &setting);
        let judge = |((name, formula), &k): (&(String, Expr), &usize)| {
            let usual = (!other).then(|| formulas[k].1);
            (name.clone(), judge(&setting, [&samples, &special], variables[k], *formula, usual, range))
        };
        angles.iter().zip(&places).map(judge).collect()
    };
    let count = |of: &[(String, Judgement)]| of.iter().filter(|a| a.1.verdict == Verdict::Right).count();
    let (usual, other) = (judged(false), judged(true));
    Some(match count(&other) > count(&usual) {
        true => Orientation { range: -range, angles: other },
        false => Orientation { range, angles: usual },
    })
}

/// The rotation of a set over formulas.
fn turned(set: OrientationSet, variables: &[Symbol]) -> Rotation<Expr> {
    let [a, b, c] = std::array::from_fn(|k| Expr::from(variables[k]));
    match set {
        OrientationSet::Euler(e) => {
            let [i, j, k] = e.axes();
            Rotation::about(i, a) * Rotation::about(j, b) * Rotation::about(k, c)
        }
        _ => Rotation::from_rpy(a, b, c),
    }
}

/// Orientations with their angles in the usual range, or in the other one: random, and special ones.
fn samples(set: OrientationSet, other: bool, setting: &Setting) -> [Vec<Sample>; 2] {
    let mut random = Random(11);
    let mut of = |is_special: bool| {
        let mut next = || match is_special {
            true => [0.0, FRAC_PI_2, -FRAC_PI_2, PI][(random.unit() * 4.0) as usize % 4],
            false => ((2.0 * random.unit() - 1.0) * PI * 1e3).round() / 1e3,
        };
        let angles = [next(), next(), next()];
        let r = rotation(set, &angles).ok()?;
        let usual = extract(&r, set);
        if usual.singular {
            return None;
        }
        let found = if other { usual.other_solution()? } else { usual };
        let entries = r.rows().concat();
        debug_assert_eq!(entries.len(), setting.entries.len());
        Some(Sample { q: found.values.clone(), entries, solutions: vec![found.values], motions: vec![] })
    };
    let random: Vec<Sample> = (0..SAMPLES).filter_map(|_| of(false)).collect();
    let special = (0..SPECIAL).filter_map(|_| of(true)).collect();
    [random, special]
}

/// One angle.
fn judge(
    setting: &Setting,
    [samples, special]: [&[Sample]; 2],
    angle: Symbol,
    formula: Expr,
    usual: Option<Expr>,
    range: Expr,
) -> Judgement {
    let of: Vec<Unknown> = vec![setting.unknown(angle.into())];
    let branches = [vec![formula]];
    let formulas = Formulas { of: &of, known: &[], branches: &branches };
    let compared = match Comparison::new(setting, samples, &formulas) {
        Ok(compared) => compared,
        Err(why) => return Judgement::undecided(why),
    };
    if !compared.finite[0].iter().any(|&f| f) {
        return Judgement::undecided(Undecided::NeverDefined);
    }
    let mut pool = condition::own(&branches[0], &[]);
    pool.extend(setting.entries.iter().map(|e| Expr::from(e.0)));
    let place = condition::place(setting, samples, &compared.right[0], &pool);
    let verdict = match &place {
        Where::Everywhere => Verdict::Right,
        Where::Nowhere => Verdict::Wrong,
        Where::If(_) | Where::Partly(_) => Verdict::Conditional,
    };
    let mut faults = vec![];
    if let Where::If(conditions) = &place {
        let (cause, conditions) = (condition::cause(&branches[0]), conditions.clone());
        faults.push(Fault::WrongQuadrant { branch: 0, cause, conditions });
    }
    let undefined = share(compared.finite[0].iter().map(|f| !f));
    if undefined > 0.0 {
        faults.push(Fault::OutOfDomain { branch: 0, share: undefined });
    }
    if verdict == Verdict::Right {
        faults.extend(fails_at(setting, special, &formulas).map(Fault::FailsAt));
    }
    let places = std::slice::from_ref(&place);
    let right = match verdict {
        Verdict::Right => None,
        _ => mend::mended(setting, samples, &formulas, places).or_else(|| {
            let (of, branches) = (vec![angle.into()], vec![vec![usual?]]);
            Some(Right { of, branches, known: vec![], origin: Origin::Derived })
        }),
    };
    // In its range an angle has the sign that the range says.
    let in_range = match &place {
        Where::Everywhere => Where::If(vec![range_by(samples, setting, range)]),
        Where::If(all) => Where::If(all.iter().copied().chain([range_by(samples, setting, range)]).collect()),
        other => other.clone(),
    };
    let proof = match verdict {
        Verdict::Wrong => None,
        _ => proof::proof(setting, samples, &of, &branches, std::slice::from_ref(&in_range)),
    };
    let proved = verdict == Verdict::Wrong || proof.is_some();
    Judgement {
        identities: proof.unwrap_or_default(),
        verdict,
        grounds: Grounds {
            proved,
            poses: samples.len(),
            special: special.len(),
            apart: apart(setting, samples, &formulas),
        },
        branches: vec![place],
        missing: None,
        extra: if compared.extra(0) > 0.0 { vec![0] } else { vec![] },
        faults,
        counterexample: compared.example,
        right,
    }
}

/// The range with the sign that it has at the samples.
fn range_by(samples: &[Sample], setting: &Setting, range: Expr) -> Expr {
    let positive = setting
        .tape(&[range])
        .is_ok_and(|t| samples.first().is_some_and(|s| t.values(&setting.point(&s.q, &s.entries))[0] > 0.0));
    if positive { range } else { -range }
}
