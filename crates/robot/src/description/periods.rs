//! By what joint variables can be moved so that every link comes back to where it was.
//!
//! The angles of the rows are K·q + c. What brings all links back are the q with K·q whole turns: a lattice. A joint alone
//! has the period 1/gcd of its factors; couplings can have motions of several joints beside those.

use super::Description;
use crate::space::Periods;
use denavit_symbolic::{Angle, Expr, Rational, Symbol};
use std::f64::consts::TAU;

/// The most copies of one configuration in the windows; with more, each joint's window is its own period.
const MOST: usize = 64;

impl Periods {
    /// Those of the joints of a description.
    pub(crate) fn of(description: &Description) -> Self {
        let variables: Vec<Symbol> = description.variables().iter().map(|v| v.symbol).collect();
        let place = |e: Expr| e.as_symbol().and_then(|s| variables.iter().position(|v| *v == s));
        let mut turning: Vec<Vec<Rational>> = vec![];
        let mut slides = vec![false; variables.len()];
        for row in &description.rows {
            let joint = row.screws(description.convention).joint;
            let mut factors = vec![Rational::ZERO; variables.len()];
            for (x, k) in Angle::of(joint.angle).terms {
                place(x).into_iter().for_each(|j| factors[j] = &factors[j] + &k);
            }
            turning.extend(factors.iter().any(|k| !k.is_zero()).then_some(factors));
            for (x, _) in Angle::of(joint.length).terms {
                place(x).into_iter().for_each(|j| slides[j] = true);
            }
        }
        let is_plain = |row: &Vec<Rational>| {
            let mut all = row.iter().filter(|k| !k.is_zero());
            all.next().is_some_and(|k| k.abs().is_one()) && all.next().is_none()
        };
        let joints: Vec<usize> = (0..variables.len()).filter(|&j| !slides[j]).collect();
        let whole = Periods::whole_turns(slides.iter().map(|x| !x));
        if turning.iter().all(is_plain) { whole } else { lattice(&turning, &joints, &whole) }
    }
}

/// The periods of some joints, in the others' places what `whole` says.
fn lattice(rows: &[Vec<Rational>], joints: &[usize], whole: &Periods) -> Periods {
    let n = whole.periods.len();
    let divisor =
        |j: usize| rows.iter().map(|r| r[j].abs()).filter(|k| !k.is_zero()).reduce(|a, b| gcd(&a, &b));
    let joints: Vec<usize> = joints.iter().copied().filter(|&j| divisor(j).is_some()).collect();
    let mut found = whole.clone();
    let (mut periods, mut windows) = (vec![Rational::ZERO; n], vec![Rational::ZERO; n]);
    for &j in &joints {
        let g = divisor(j).unwrap_or(Rational::ONE);
        periods[j] = &Rational::ONE / &g;
        let more = -&(-&g).floor();
        windows[j] = &more / &g;
        found.periods[j] = TAU * periods[j].to_f64();
    }
    let mut generators: Vec<Vec<Rational>> = joints
        .iter()
        .map(|&j| (0..n).map(|i| if i == j { periods[j].clone() } else { Rational::ZERO }).collect())
        .collect();
    generators.extend(inverse(rows, &joints));
    let copies = reached(&generators, rows, &joints, &windows);
    found.all_copies = copies.is_some();
    let copies = copies.or_else(|| {
        windows.clone_from(&periods);
        reached(&generators, rows, &joints, &windows)
    });
    let copies = copies.unwrap_or_default();
    for &j in &joints {
        found.windows[j] = TAU * windows[j].to_f64();
    }
    found.copies = copies.iter().map(|c| c.iter().map(|x| TAU * x.to_f64()).collect()).collect();
    found
}

/// The largest rational that goes into two a whole number of times.
fn gcd(a: &Rational, b: &Rational) -> Rational {
    let (mut a, mut b) = (a.clone(), b.clone());
    while !b.is_zero() {
        let rest = &a - &(&(&a / &b).floor() * &b);
        (a, b) = (b, rest);
    }
    a
}

/// For each of as many independent rows as there are joints, the motion that turns that row once and none of the others.
fn inverse(rows: &[Vec<Rational>], joints: &[usize]) -> Vec<Vec<Rational>> {
    let (n, m) = (rows.first().map_or(0, Vec::len), joints.len());
    // Rows of (K | how it is made), reduced as they come.
    let mut reduced: Vec<(usize, Vec<Rational>, Vec<Rational>)> = vec![];
    for row in rows {
        if reduced.len() == m {
            break;
        }
        let mut own: Vec<Rational> = joints.iter().map(|&j| row[j].clone()).collect();
        let mut made = vec![Rational::ZERO; m];
        made[reduced.len()] = Rational::ONE;
        let subtract = |x: &mut Vec<Rational>, factor: &Rational, y: &[Rational]| {
            x.iter_mut().zip(y).for_each(|(x, y)| *x = &*x - &(factor * y));
        };
        for (pivot, r, by) in &reduced {
            let factor = own[*pivot].clone();
            subtract(&mut own, &factor, r);
            subtract(&mut made, &factor, by);
        }
        let Some(pivot) = own.iter().position(|x| !x.is_zero()) else { continue };
        let scale = own[pivot].recip().unwrap_or(Rational::ONE);
        own.iter_mut().chain(&mut made).for_each(|x| *x = &*x * &scale);
        for (_, r, by) in &mut reduced {
            let factor = r[pivot].clone();
            subtract(r, &factor, &own);
            subtract(by, &factor, &made);
        }
        reduced.push((pivot, own, made));
    }
    if reduced.len() < m {
        return vec![];
    }
    (0..m)
        .map(|k| {
            let mut motion = vec![Rational::ZERO; n];
            reduced.iter().for_each(|(pivot, _, made)| motion[joints[*pivot]] = made[k].clone());
            motion
        })
        .collect()
}

/// What sums of the generators reach within the windows and brings all links back, the start left aside; nothing if that
/// is too much.
fn reached(
    generators: &[Vec<Rational>],
    rows: &[Vec<Rational>],
    joints: &[usize],
    windows: &[Rational],
) -> Option<Vec<Vec<Rational>>> {
    let within = |x: &mut Vec<Rational>| {
        for &j in joints {
            x[j] = &x[j] - &(&(&x[j] / &windows[j]).floor() * &windows[j]);
        }
    };
    let mut all = vec![vec![Rational::ZERO; windows.len()]];
    let mut next = 0;
    while next < all.len() {
        for g in generators {
            let mut x: Vec<Rational> = all[next].iter().zip(g).map(|(a, b)| a + b).collect();
            within(&mut x);
            if !all.contains(&x) {
                all.push(x);
            }
        }
        if all.len() > MOST {
            return None;
        }
        next += 1;
    }
    let is_back = |x: &Vec<Rational>| {
        rows.iter().all(|r| {
            let turned = r.iter().zip(x).fold(Rational::ZERO, |sum, (k, x)| &sum + &(k * x));
            turned.is_integer()
        })
    };
    Some(all.into_iter().skip(1).filter(is_back).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::description::read_toml;
    use std::f64::consts::PI;

    fn of(angles: &[&str]) -> Periods {
        let row = |theta: &&str| format!("[[joints]]\ntheta = \"{theta}\"\na = 0.3\n");
        let rows: String = angles.iter().map(row).collect();
        Periods::of(&read_toml(&format!("name = \"x\"\nconvention = \"craig\"\n{rows}")).expect("a robot").0)
    }

    #[test]
    fn gears_have_their_own_periods() {
        let p = of(&["q1/2", "-q2", "2*q3", "2*q4/3", "q5 + q4"]);
        assert_eq!(p.periods, [4.0 * PI, TAU, PI, 6.0 * PI, TAU]);
        assert_eq!(p.windows, [4.0 * PI, TAU, TAU, 6.0 * PI, TAU]);
        // q3 by half a turn; q4 by one and a half turns with q5 by half a turn back, and so on.
        assert_eq!(p.copies.len(), 3);
        assert!(of(&["q1", "q1 + q2", "q3 - q1"]).copies.is_empty());
    }

    #[test]
    fn too_many_copies_are_not_listed() {
        let p = of(&["300*q1", "q2"]);
        assert!(!p.all_copies && p.copies.is_empty());
        assert!((p.windows[0] - TAU / 300.0).abs() < 1e-15 && p.windows[1] == TAU);
        assert!(of(&["2*q1", "3*q2"]).all_copies);
    }

    #[test]
    fn couplings_have_motions_of_several_joints() {
        let p = of(&["q1", "q2 + q1/2"]);
        assert_eq!((p.periods, p.copies), (vec![4.0 * PI, TAU], vec![vec![TAU, PI]]));
    }
}
