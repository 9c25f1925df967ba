//! What is to be said of a linkage: how many joints can be driven, and whether it can be assembled.

use super::linear::Factors;
use super::rates::RANK;
use super::{Assembly, Loops, Open};
use crate::description::JointKind;
use crate::description::diagnostic::{Diagnostic, Diagnostics};
use crate::description::linkage::{Fault, Linkage, NoMode, Plan, Unsolved};
use crate::quantity::reading;
use crate::random::Random;
use denavit_symbolic::{Expr, Symbol};
use std::f64::consts::PI;

/// How many joints of a linkage can be driven, by the rank of its constraints where it is closed and not singular.
#[derive(Clone, PartialEq, Debug)]
pub struct Mobility {
    /// All joints, cut ones included.
    pub joints: usize,
    /// The rank of the constraints.
    pub rank: usize,
    /// At how many closed configurations it was taken, the largest of all counting.
    pub configurations: usize,
    /// Passive joints (from 0) that nothing determines.
    pub free: Vec<usize>,
    /// True if driven joints cannot be moved by themselves.
    pub is_jammed: bool,
}

impl Mobility {
    /// Joints that can be driven.
    pub fn count(&self) -> usize {
        self.joints - self.rank
    }
}

/// How many configurations are tried until so many are closed.
const TRIES: usize = 400;
const WANTED: usize = 12;
/// The same where loops are closed by descent, which takes its time.
const NUMERIC_TRIES: usize = 24;
/// How many modes are tried there.
const NUMERIC_MODES: usize = 4;

/// The mobility of a linkage; nothing if it does not close anywhere where it was tried.
pub fn mobility(loops: &Loops) -> Option<Mobility> {
    let mut random = Random(0xC105ED);
    let n = loops.driven().len();
    let (mut found, mut best): (usize, Option<Mobility>) = (0, None);
    let is_numeric = !loops.rest.is_empty();
    let mut modes = loops.plan().modes();
    if is_numeric {
        modes.truncate(NUMERIC_MODES);
    }
    for _ in 0..if is_numeric { NUMERIC_TRIES } else { TRIES } {
        let q = anywhere(loops, &mut random);
        let closed = |mode| loops.assembly(&q, mode).ok().filter(|a| a.flat.is_empty());
        let Some(assembly) = modes.iter().find_map(closed) else { continue };
        found += 1;
        let w = loops.constraint(&[&q[..], &assembly.passive[..]].concat());
        let rank = Factors::of(&w, RANK).rank();
        let passive = Factors::of(&w[n..], RANK);
        let better = best.as_ref().is_none_or(|b| rank > b.rank);
        if better {
            let is_jammed = passive.rank() < rank;
            let free = passive.dependent();
            best = Some(Mobility { joints: w.len(), rank, configurations: 0, free, is_jammed });
        }
        if found == WANTED {
            break;
        }
    }
    best.map(|b| Mobility { configurations: found, ..b })
}

/// Driven joints here and there within their limits, slides up to the size.
fn anywhere(loops: &Loops, random: &mut Random) -> Vec<f64> {
    let d = &loops.linkage.tree.rows;
    let number = |e: Expr| e.eval(|_| None).ok();
    let limits: Vec<Option<[f64; 2]>> = d
        .iter()
        .filter(|r| r.variable.is_some_and(|v| !crate::description::linkage::is_passive(v.symbol)))
        .map(|r| Some([number(r.limits?[0])?, number(r.limits?[1])?]))
        .collect();
    let one = |(kind, limits): (&JointKind, &Option<[f64; 2]>)| {
        let [low, high] = limits.unwrap_or(match kind {
            JointKind::Revolute => [-PI, PI],
            JointKind::Prismatic => [0.1 * loops.size, 2.0 * loops.size],
        });
        low + (high - low) * random.unit()
    };
    loops.driven().iter().zip(&limits).map(one).collect()
}

/// How many configurations are compared.
const COMPARED: usize = 32;
/// Passive joints that differ less are the same: by the size where they slide.
const SAME: f64 = 1e-9;

/// At how many configurations, here and there, two linkages are closed by the same assemblies, mode by mode with the same passive
/// joints; nothing if they differ at one. Neither may be closed anywhere: then it is 0.
pub fn compare(a: &Linkage, b: &Linkage) -> Option<usize> {
    let (a, b) = (Loops::new(a).ok()?, Loops::new(b).ok()?);
    if a.driven() != b.driven() || a.passive() != b.passive() {
        return None;
    }
    let mut random = Random(1);
    let near = |k: usize, x: f64, y: f64| match a.passive()[k] {
        JointKind::Revolute => ((x - y) / 2.0).sin().abs() < SAME,
        JointKind::Prismatic => (x - y).abs() < SAME * a.size,
    };
    let mut count = 0;
    for _ in 0..COMPARED {
        let q = anywhere(&a, &mut random);
        let (x, y) = (a.assemblies(&q), b.assemblies(&q));
        let same = |(x, y): (&Assembly, &Assembly)| {
            (0..x.passive.len()).all(|k| near(k, x.passive[k], y.passive[k]))
        };
        if x.len() != y.len() || !x.iter().zip(&y).all(same) {
            return None;
        }
        count += usize::from(!x.is_empty());
    }
    Some(count)
}

/// What is to be said of a linkage that was read: what is wrong with its loops, with its places.
pub fn findings(linkage: &Linkage) -> Vec<Diagnostic> {
    let mut out = Diagnostics::default();
    let plan = Plan::of(linkage);
    for mode in &linkage.modes {
        if let Err(NoMode::Nowhere(name)) = linkage.mode(&plan, Some(&mode.name)) {
            let signs: Vec<String> = plan.modes().iter().map(ToString::to_string).collect();
            out.error(mode.span.clone(), format!("no assembly mode is told by what is said of `{name}`"))
                .hint(format!(
                    "what is said has to hold wherever the driven joints are; or give its signs, of {}",
                    signs.join(", ")
                ));
        }
    }
    let loops = Loops::new(linkage);
    let numbers = linkage.in_numbers();
    for (closure, why) in &plan.unsolved {
        let span = linkage.closures[*closure].span.clone();
        match why {
            Unsolved::NotPlanar(Fault::Offset(offset)) => {
                let far = match numbers_of(&numbers, *closure) {
                    Some(Fault::Offset(e)) => e.eval(|_| None).ok(),
                    _ => offset.eval(|_| None).ok(),
                };
                let far = far.map_or(offset.to_string(), |x| format!("{x:.3e} m"));
                out.error(
                    span,
                    format!(
                        "`{}` cannot be assembled: its sides end {far} apart along its axes",
                        linkage.loop_name(*closure)
                    ),
                )
                .hint("all its axes are parallel: what stands along them has to cancel exactly");
            }
            Unsolved::NotPlanar(Fault::Tilted) => {
                out.error(
                    span,
                    format!(
                        "`{}` cannot be assembled: all its axes are parallel, and its two frames are tilted against each other",
                        linkage.loop_name(*closure)
                    ),
                )
                .hint("turn the right frame: gamma and alpha");
            }
            Unsolved::NotPlanar(_) | Unsolved::Unknowns(_) | Unsolved::Determined => {}
        }
    }
    let Ok(loops) = loops else { return out.list().to_vec() };
    let Some(first) = linkage.closures.first().map(|c| c.span.clone()) else { return out.list().to_vec() };
    let has_errors = !out.list().is_empty();
    let rest: Vec<String> =
        loops.rest.iter().map(|&k| format!("p{}", k + 1 - loops.driven().len())).collect();
    if !rest.is_empty() && !has_errors {
        let near = nearly_planar(&loops);
        let (are, s) = if rest.len() == 1 { ("is", "") } else { ("are", "s") };
        let rest = rest.join(", ");
        let message = format!(
            "the passive joint{s} {rest} {are} found by Newton's method: no closed form, and how many assembly modes there are is not known"
        );
        match near {
            Some((closure, angle)) => {
                let name = linkage.loop_name(closure);
                let span = linkage.closures[closure].span.clone();
                out.warning(
                    span,
                    format!("`{name}` is over-constrained by its decimals: its axes are up to {angle:.1e} rad off parallel"),
                )
                .hint("angles in degrees are exact; axes that are exactly parallel make a planar loop, which closes in closed form");
            }
            None => {
                out.note(first.clone(), message);
            }
        }
    }
    if !has_errors {
        closes(linkage, &loops, &first, &mut out);
    }
    out.list().to_vec()
}

/// Whether it closes at rest and anywhere, and whether its mobility is that of its driven joints.
fn closes(linkage: &Linkage, loops: &Loops, first: &std::ops::Range<usize>, out: &mut Diagnostics) {
    let rest = vec![0.0; loops.driven().len()];
    let mut modes = loops.plan().modes();
    if !loops.rest.is_empty() {
        modes.truncate(NUMERIC_MODES);
    }
    let at_rest: Vec<Result<_, Open>> = modes.iter().map(|mode| loops.assembly(&rest, mode)).collect();
    let mobility = mobility(loops);
    // Closed in more ways than can be counted is closed.
    let is_open = |a: &Result<_, Open>| matches!(a, Err(why) if !matches!(why, Open::Indeterminate { .. }));
    if at_rest.iter().all(is_open) {
        let gap = at_rest.iter().find_map(|a| match a {
            Err(Open::Gap { closure, metres }) => Some((*closure, *metres)),
            Err(Open::Contradicts { closure, .. }) => Some((*closure, None)),
            _ => None,
        });
        let span = gap.map_or(first.clone(), |(closure, _)| linkage.closures[closure].span.clone());
        let how = gap.map_or(String::new(), |(closure, metres)| {
            let far = metres.map_or(String::new(), |m| format!(" by {}", reading(m, JointKind::Prismatic)));
            format!(": `{}` is open{far}", linkage.loop_name(closure))
        });
        match mobility {
            Some(_) => out.note(span, format!("not closed with all driven joints at 0{how}")),
            None => out
                .warning(span, format!("not closed wherever it was tried; with all driven joints at 0{how}")),
        };
    }
    let driven = loops.driven().len();
    let Some(mobility) = mobility else {
        // Closed at rest alone: driven joints are more than it has freedoms, mostly.
        if !at_rest.iter().all(is_open) {
            let message = format!(
                "closed with all driven joints at 0, and nowhere else where it was tried: fewer than {driven} joints can be driven, or it is closed in few places"
            );
            out.warning(first.clone(), message)
                .hint("drive fewer joints (p in the place of q), or see how far each may go");
        }
        return;
    };
    let (count, rank, joints) = (mobility.count(), mobility.rank, mobility.joints);
    let said = format!(
        "the mobility is {count} ({joints} joints, constraints of rank {rank} at {} closed configurations), and {driven} joint{} driven",
        mobility.configurations,
        if driven == 1 { " is" } else { "s are" }
    );
    let names = |all: &[usize]| {
        let passive: Vec<Symbol> = linkage.passive().iter().map(|v| v.symbol).collect();
        all.iter().map(|&k| passive[k].name().to_string()).collect::<Vec<_>>().join(", ")
    };
    if count > driven {
        out.warning(first.clone(), said).hint(format!(
            "nothing determines {}: drive it (q in the place of p), or close another loop",
            names(&mobility.free)
        ));
    } else if count < driven || mobility.is_jammed {
        out.warning(first.clone(), said).hint(
            "driven joints cannot be moved by themselves: one of them is passive (p in the place of q)",
        );
    }
}

fn numbers_of(numbers: &Linkage, closure: usize) -> Option<Fault> {
    crate::description::linkage::Planar::of(numbers, closure).err()
}

/// Axes that are less than this off parallel were meant to be.
const NEARLY: f64 = 1e-3;

/// A loop of which all axes are parallel up to some decimals, and by how much they are not.
fn nearly_planar(loops: &Loops) -> Option<(usize, f64)> {
    let all = vec![0.0; loops.driven.len() + loops.passive.len()];
    let frames = loops.placed(&all);
    loops.plan.unsolved.iter().find_map(|(closure, why)| {
        let Unsolved::NotPlanar(Fault::Axis { .. } | Fault::Tilted) = why else { return None };
        // z of each row of the loop and of both ends, all variables at 0.
        let place = |on: Option<usize>| on.map_or(loops.base, |r| frames[r]);
        let mut axes = vec![];
        for (link, on) in &loops.sides[*closure] {
            axes.push(link.axis(&place(*on)).direction);
            let mut next = *on;
            while let Some(row) = next {
                let (link, on) = &loops.links[row];
                if link.turns() {
                    axes.push(link.axis(&place(*on)).direction);
                }
                next = *on;
            }
        }
        // Rows that both sides stand on count as well: their axes may be across.
        let z = axes[0];
        let off: Vec<f64> = axes.iter().map(|a| a.cross(z).norm()).filter(|x| *x < 0.5).collect();
        let worst = off.iter().copied().fold(0.0, f64::max);
        (off.len() > 2 && worst > 0.0 && worst < NEARLY).then_some((*closure, worst))
    })
}
