//! Delta robots.

use crate::{cases, signed};
use denavit::geometry::Vector;
use denavit::random::Random;
use denavit_parallel::delta::{Delta, Drive, NoPosition, Sign};
use std::f64::consts::TAU;

fn arms() -> [f64; 3] {
    [0.0, TAU / 3.0, 2.0 * TAU / 3.0]
}

fn turning() -> Delta {
    Delta { base: 0.2, platform: 0.045, rod: 0.8, arms: arms(), drive: Drive::Turns(0.235) }
}

fn rods(delta: &Delta, p: Vector<f64>, q: &[f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| {
        let (sin, cos) = delta.arms[i].sin_cos();
        (p + Vector([cos, sin, 0.0]).scale(delta.platform) - delta.end(i, q[i])).norm()
    })
}

/// Any delta of either kind.
fn any(random: &mut Random) -> Delta {
    let drive = if random.unit() < 0.5 {
        Drive::Turns(0.1 + random.unit())
    } else {
        Drive::Slides(TAU * (random.unit() - 0.5))
    };
    let arms = arms().map(|a| a + 0.8 * signed(random));
    Delta { base: 0.1 + random.unit(), platform: random.unit(), rod: 0.5 + random.unit(), arms, drive }
}

#[test]
fn all_eight_modes_close_and_lead_back() {
    let (mut random, mut reached) = (Random(8), 0);
    for case in 0..cases(2_000, 200_000) {
        let delta = any(&mut random);
        let p = Vector([0; 3].map(|_| signed(&mut random)));
        let Ok(modes) = delta.inverse(p) else { continue };
        reached += 1;
        assert_eq!(modes.len(), 8);
        for mode in &modes {
            let off = rods(&delta, p, &mode.q).iter().map(|l| (l - delta.rod).abs()).fold(0.0, f64::max);
            assert!(off < 1e-12, "{case} {}: {off:e}", mode.name());
            match delta.forward(&mode.q) {
                Ok(both) => {
                    let off = both.iter().map(|b| (b.1 - p).norm()).fold(f64::INFINITY, f64::min);
                    assert!(off < 1e-5, "{case} {}: {off:e}", mode.name());
                    for (_, x) in &both {
                        let closes = rods(&delta, *x, &mode.q).iter().all(|l| (l - delta.rod).abs() < 1e-9);
                        assert!(closes, "{case} {}", mode.name());
                    }
                }
                Err(why) => assert_eq!(why, NoPosition::OnALine, "{case}"),
            }
        }
        let mut names: Vec<String> = modes.iter().map(denavit_parallel::delta::Mode::name).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), 8);
    }
    assert!(reached > 100, "{reached}");
}

#[test]
fn signs_say_where_elbows_and_platforms_are() {
    let delta = turning();
    let p = Vector([0.05, -0.08, -0.75]);
    for mode in delta.inverse(p).expect("it reaches") {
        for (leg, sign) in mode.signs.into_iter().enumerate() {
            let other = delta.inverse(p).expect("it reaches").into_iter();
            let other =
                other.filter(|m| m.signs[leg] != sign).map(|m| m.q[leg]).next().expect("there are two");
            let out = |q: f64| {
                let end = delta.end(leg, q);
                end[0].hypot(end[1])
            };
            assert_eq!(sign == Sign::Plus, out(mode.q[leg]) > out(other), "{}", mode.name());
        }
    }
    let both = delta.forward(&[0.3; 3]).expect("they meet");
    assert!(both[0].0 == Sign::Plus && both[0].1[2] > 0.0 && both[1].1[2] < 0.0);
    // On the axis of symmetry: a = base + arm cos q − platform from it, and −arm sin q ± √(rod² − a²).
    let a = 0.2 + 0.235 * 0.3_f64.cos() - 0.045;
    let z = -0.235 * 0.3_f64.sin() - (0.8 * 0.8 - a * a).sqrt();
    assert!((both[1].1 - Vector([0.0, 0.0, z])).norm() < 1e-14);
}

#[test]
fn out_of_reach_is_said() {
    let delta = turning();
    assert!(delta.inverse(Vector([0.0, 0.0, -2.0])).is_err_and(|why| why.leg == 0 && why.metres > 0.5));
    assert!(delta.inverse(Vector([0.0, 3.0, 0.0])).is_err());
    // Ends of the arms in one point: no triangle.
    let point = Delta { base: 0.045, drive: Drive::Slides(0.25 * TAU), ..delta };
    assert_eq!(point.forward(&[0.1; 3]), Err(NoPosition::OnALine));
    let wide = Delta { base: 2.0, ..delta };
    assert_eq!(wide.forward(&[0.0; 3]), Err(NoPosition::Apart));
}
