//! Motions within their limits.

use crate::made::arm;
use denavit_identification::{Criterion, Excitation, Limits, Model, NoExcitation, Search, Sought, excite};

const SEARCH: Search =
    Search { duration: 10.0, harmonics: 5, seed: 1, trials: 60, criterion: Criterion::Determinant };

fn limits(n: usize) -> Limits {
    Limits {
        position: vec![[-1.5, 2.0]; n],
        velocity: vec![1.5; n],
        acceleration: vec![4.0; n],
        torque: None,
    }
}

fn made(search: &Search) -> Excitation {
    let model = Model::new(&arm("staubli-rx90"), Sought::default()).expect("a model");
    excite(&model, &limits(6), search, |_, _| true).expect("a motion")
}

#[test]
fn limits_hold_and_it_begins_and_ends_at_rest() {
    let found = made(&SEARCH);
    let limits = limits(6);
    let mut most = [0.0_f64; 2];
    for k in 0..=20_000 {
        let [q, qd, qdd] = found.at(found.duration * f64::from(k) / 20_000.0);
        for j in 0..6 {
            let [low, high] = limits.position[j];
            assert!((low - 1e-9..=high + 1e-9).contains(&q[j]), "{k}: {q:?}");
            most = [
                most[0].max(qd[j].abs() / limits.velocity[j]),
                most[1].max(qdd[j].abs() / limits.acceleration[j]),
            ];
        }
    }
    assert!(most.iter().all(|m| *m <= 1.0 + 1e-9), "{most:?}");
    // Something bounds it: it is not small.
    assert!(most.iter().any(|m| *m > 0.99), "{most:?}");
    let ([from, rate, pull], [to, last, end]) = (found.at(0.0), found.at(found.duration));
    for j in 0..6 {
        for x in [rate[j], pull[j], last[j], end[j], to[j] - from[j]] {
            assert!(x.abs() < 1e-9, "{x}");
        }
    }
}

/// Rates are those of the positions, accelerations those of the rates.
#[test]
fn rates_are_derivatives() {
    let (found, h) = (made(&SEARCH), 1e-5);
    for t in [0.3, 4.7, 8.1] {
        let ([q, qd, _], [p, pd, _], [_, v, a]) = (found.at(t + h), found.at(t - h), found.at(t));
        for j in 0..6 {
            assert!(((q[j] - p[j]) / (2.0 * h) - v[j]).abs() < 1e-7);
            assert!(((qd[j] - pd[j]) / (2.0 * h) - a[j]).abs() < 1e-7);
        }
    }
}

#[test]
fn the_same_seed_gives_the_same_and_more_trials_no_worse() {
    let first = made(&SEARCH);
    assert_eq!(first, made(&SEARCH));
    assert_ne!(first.series, made(&Search { seed: 2, ..SEARCH }).series);
    let random = made(&Search { trials: 1, ..SEARCH });
    let longer = made(&Search { trials: 300, ..SEARCH });
    assert!(first.log_det >= random.log_det && longer.log_det > random.log_det + 1.0);
    let conditioned = made(&Search { trials: 300, criterion: Criterion::Condition, ..SEARCH });
    let one = made(&Search { trials: 1, criterion: Criterion::Condition, ..SEARCH });
    assert!(conditioned.condition < one.condition, "{} {}", conditioned.condition, one.condition);
}

#[test]
fn no_room_is_said() {
    let model = Model::new(&arm("scara"), Sought::default()).expect("a model");
    let n = model.joints();
    let ask = |l: &Limits, s: &Search| excite(&model, l, s, |_, _| true).map(|_| ());
    assert_eq!(ask(&limits(n), &Search { harmonics: 2, ..SEARCH }), Err(NoExcitation::Harmonics));
    let mut narrow = limits(n);
    narrow.position[1] = [0.5, 0.5];
    assert_eq!(ask(&narrow, &SEARCH), Err(NoExcitation::NoRoom(1)));
    let mut weak = limits(n);
    let mut heavy = model.arm.clone();
    heavy.links.iter_mut().for_each(|l| {
        l.body = denavit::geometry::Body::about_centre(
            5.0,
            denavit::geometry::Vector([0.1, 0.0, 0.0]),
            [0.1, 0.0, 0.0, 0.1, 0.0, 0.1],
        );
    });
    weak.torque = Some((heavy, vec![1e-6; n]));
    assert_eq!(ask(&weak, &SEARCH), Err(NoExcitation::Torques));
}

/// Told to stop, it gives what it has.
#[test]
fn it_stops_when_it_is_told() {
    let model = Model::new(&arm("scara"), Sought::default()).expect("a model");
    let mut heard = 0;
    let found = excite(&model, &limits(model.joints()), &Search { trials: 1_000_000, ..SEARCH }, |_, _| {
        heard += 1;
        heard < 5
    });
    assert!(found.is_ok());
    assert_eq!(heard, 5);
}
