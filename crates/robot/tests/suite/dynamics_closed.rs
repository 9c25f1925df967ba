//! Dynamics of closed loops: Lagrange's equations in the driven joints alone, the chain with couplings where there is one, the balance of
//! energy.

use crate::common::Random;
use crate::linkages::{Between, SR400, catalogued, linkage, par};
use denavit::description::linkage::Plan;
use denavit::description::{JointKind, Linkage, RowTree};
use denavit::dynamics::{
    ClosedDynamics, DynamicModel, Dynamics, Formulas, Ground, Minimality, NoMotion, Torques, drive_torques,
    inertia_matrix, inverse_dynamics, kinetic_energy, potential_energy, simulate_closed,
};
use denavit_symbolic::{Expr, Rational, Symbol};
use std::f64::consts::PI;

const NAMES: [&str; 6] = ["sr400", "akr3000", "palletiser", "four-bar", "five-bar", "slider-crank"];

/// A linkage whose rows have masses at random.
fn weighed(mut linkage: Linkage, random: &mut Random) -> Linkage {
    let number = |x: f64| Expr::from(Rational::new((x * 1000.0).round() as i64, 1000));
    for row in &mut linkage.tree.rows {
        row.mass = Some(number(random.between(0.5, 5.0)));
        row.com = Some([0; 3].map(|_| number(random.between(-0.2, 0.2))));
        let [a, b, c] = [0; 3].map(|_| random.between(0.02, 0.1));
        row.inertia = Some([b + c, 0.003, -0.002, a + c, 0.001, a + b].map(number));
        if row.variable.is_some() {
            row.rotor = Some(number(random.between(0.0, 0.3)));
            row.viscous = Some(number(random.between(0.0, 2.0)));
        }
    }
    linkage.tree.gravity = Some([number(1.3), number(-2.1), number(-9.4)]);
    linkage
}

/// A configuration of a linkage that is not near one at which modes meet, in any of its modes.
fn somewhere(
    of: &ClosedDynamics,
    random: &mut Random,
) -> (Vec<f64>, Vec<f64>, denavit::description::linkage::Mode) {
    let loops = of.loops();
    for _ in 0..10_000 {
        let q: Vec<f64> = loops
            .driven()
            .iter()
            .map(|kind| match kind {
                JointKind::Revolute => random.between(-3.0, 3.0),
                JointKind::Prismatic => random.between(-1.0, 1.0),
            })
            .collect();
        let mut all = loops.assemblies(&q);
        if all.is_empty() {
            continue;
        }
        let chosen = all.swap_remove((random.unit() * all.len() as f64) as usize);
        let is_tame =
            loops.passive_rates(&q, &chosen.passive).is_ok_and(|g| g.iter().flatten().all(|x| x.abs() < 4.0));
        if is_tame {
            return (q, chosen.passive, chosen.mode);
        }
    }
    panic!("no configuration");
}

#[track_caller]
fn close(what: &str, a: &[f64], b: &[f64], tolerance: f64) {
    assert_eq!(a.len(), b.len(), "{what}");
    let size = b.iter().fold(1e-3_f64, |m, x| m.max(x.abs()));
    let off = a.iter().zip(b).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max) / size;
    assert!(off <= tolerance, "{what}: {off:e}\n{a:?}\n{b:?}");
}

/// τ = d/dt ∂T/∂q̇ − ∂T/∂q + ∂V/∂q + friction, T and V of the linkage as it is assembled, by differences.
#[test]
fn torques_of_loops_are_lagranges() {
    let mut random = Random(101);
    for name in NAMES {
        for _ in 0..6 {
            let of = ClosedDynamics::new(&weighed(catalogued(name), &mut random)).unwrap();
            let (q, p, mode) = somewhere(&of, &mut random);
            let n = q.len();
            let [qd, qdd] = [0; 2].map(|_| (0..n).map(|_| random.between(-1.0, 1.0)).collect::<Vec<f64>>());
            let energies = |q: &[f64], qd: &[f64]| -> [f64; 2] {
                let p = of.loops().assembly_near(q, &mode, Some(&p)).unwrap().passive;
                let all = [q, &p].concat();
                // Rates by differences along the motion, too.
                let h = 1e-5;
                let at = |t: f64| -> Vec<f64> {
                    let q: Vec<f64> = q.iter().zip(qd).map(|(x, v)| x + t * v).collect();
                    of.loops().assembly_near(&q, &mode, Some(&p)).unwrap().passive
                };
                let (before, behind) = (at(-h), at(h));
                let wrapped = |x: f64, kind: &JointKind| match kind {
                    JointKind::Revolute => (x + PI).rem_euclid(2.0 * PI) - PI,
                    JointKind::Prismatic => x,
                };
                let kinds = of.loops().passive();
                let rates =
                    behind.iter().zip(&before).zip(kinds).map(|((b, a), k)| wrapped(b - a, k) / (2.0 * h));
                let rates: Vec<f64> = qd.iter().copied().chain(rates).collect();
                [kinetic_energy(of.tree(), &all, &rates), potential_energy(of.tree(), &all)]
            };
            let held = of.at(&q, &p).unwrap();
            let own = held.energies(&qd);
            close(&format!("{name}, energies"), &own, &energies(&q, &qd), 1e-7);
            // T is quadratic in the rates: its slopes by differences of any length.
            let momentum = |q: &[f64], qd: &[f64], j: usize| {
                let moved =
                    |by: f64| -> Vec<f64> { (0..n).map(|k| qd[k] + if k == j { by } else { 0.0 }).collect() };
                (energies(q, &moved(1.0))[0] - energies(q, &moved(-1.0))[0]) / 2.0
            };
            let h = 1e-4;
            let along = |t: f64| -> [Vec<f64>; 2] {
                let q = (0..n).map(|k| q[k] + t * qd[k] + 0.5 * t * t * qdd[k]).collect();
                [q, (0..n).map(|k| qd[k] + t * qdd[k]).collect()]
            };
            let wanted: Vec<f64> = (0..n)
                .map(|j| {
                    let [a, b] = [-h, h].map(along);
                    let change = (momentum(&b[0], &b[1], j) - momentum(&a[0], &a[1], j)) / (2.0 * h);
                    let by = |sign: f64| {
                        let moved: Vec<f64> =
                            (0..n).map(|k| q[k] + if k == j { sign * h } else { 0.0 }).collect();
                        let [t, v] = energies(&moved, &qd);
                        v - t
                    };
                    change + (by(1.0) - by(-1.0)) / (2.0 * h)
                })
                .collect();
            let rubbed = held.friction(&qd);
            let torques: Vec<f64> = held.torques(&qd, &qdd).iter().zip(&rubbed).map(|(t, f)| t - f).collect();
            close(&format!("{name} {mode}, torques"), &torques, &wanted, 2e-5);
            // What the parts add up to, and back.
            let matrix = held.inertia();
            let (gravity, velocity) = (held.gravity(), held.velocity(&qd));
            let sum: Vec<f64> = (0..n)
                .map(|i| {
                    matrix[i].iter().zip(&qdd).map(|(a, b)| a * b).sum::<f64>()
                        + velocity[i]
                        + gravity[i]
                        + rubbed[i]
                })
                .collect();
            close(&format!("{name}, parts"), &sum, &held.torques(&qd, &qdd), 1e-10);
            let back = held.under(&qd, &sum).unwrap();
            close(&format!("{name}, accelerations"), &back, &qdd, 1e-8);
        }
    }
}

/// The tree of a linkage in the mode that is meant, whose passive joints are couplings.
fn coupled(linkage: &Linkage) -> RowTree {
    let plan = Plan::of(linkage);
    let mode = linkage.mode(&plan, None).unwrap();
    let (tree, is_left_out) = linkage.coupled(&plan, &mode);
    assert!(!is_left_out.contains(&true) && linkage.first_open(&plan, &mode).is_none());
    tree
}

/// A parallelogram's torques by couplings are those by its closures.
#[test]
fn parallelograms_by_couplings_and_by_closures_are_the_same() {
    let mut random = Random(102);
    let [mut compared, mut worst] = [0.0, 0.0_f64];
    for name in ["sr400", "palletiser"] {
        for _ in 0..20 {
            let mut linkage = weighed(catalogued(name), &mut random);
            for row in linkage
                .tree
                .rows
                .iter_mut()
                .filter(|r| r.variable.is_some_and(|v| v.symbol.name().starts_with('p')))
            {
                (row.rotor, row.viscous) = (None, None);
            }
            let of = ClosedDynamics::new(&linkage).unwrap();
            let plain = Dynamics::numeric_of_rows(&coupled(&linkage), None).unwrap();
            let mode = of.loops().mode(None).unwrap();
            let (q, p) = loop {
                let (q, ..) = somewhere(&of, &mut random);
                if let Ok(found) = of.loops().assembly(&q, &mode)
                    && of.loops().passive_rates(&q, &found.passive).is_ok()
                {
                    break (q, found.passive);
                }
            };
            let n = q.len();
            let [qd, qdd] = [0; 2].map(|_| (0..n).map(|_| random.between(-1.0, 1.0)).collect::<Vec<f64>>());
            let held = of.at(&q, &p).unwrap();
            let wanted = drive_torques(&plain, &q, &qd, &qdd, None);
            let size = wanted.iter().fold(1.0_f64, |m, x| m.max(x.abs()));
            let own = held.torques(&qd, &qdd);
            let off = own.iter().zip(&wanted).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / size;
            worst = worst.max(off);
            compared += 1.0;
            close(
                &format!("{name}, A"),
                &held.inertia().concat(),
                &inertia_matrix(&plain, &q).concat(),
                1e-9,
            );
        }
    }
    assert!(worst < 1e-9, "{worst:e} of {compared} states");
}

/// By elimination, the largest entry first.
fn rank(mut rows: Vec<Vec<f64>>) -> usize {
    let largest = |rows: &[Vec<f64>]| {
        let all = rows
            .iter()
            .enumerate()
            .flat_map(|(i, r)| r.iter().enumerate().map(move |(j, x)| (x.abs(), i, j)));
        all.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((0.0, 0, 0))
    };
    let first = largest(&rows).0;
    let mut rank = 0;
    loop {
        let (size, i, j) = largest(&rows);
        if size <= 1e-9 * first {
            return rank;
        }
        let pivot = rows.swap_remove(i);
        for row in &mut rows {
            let by = row[j] / pivot[j];
            row.iter_mut().zip(&pivot).for_each(|(x, p)| *x -= by * p);
            row[j] = 0.0;
        }
        rank += 1;
    }
}

/// SR400 with symbols: the torques are Lagrange's, and its base parameters the fewest, which no rule of chains says.
#[test]
fn base_parameters_of_a_parallelogram_are_the_fewest() {
    let linkage = par(SR400);
    let tree = coupled(&linkage);
    let model = DynamicModel::of_tree(Formulas::of_rows(&tree));
    assert!(matches!(model.ground, Ground::Proved | Ground::Modulo(_)), "{:?}", model.ground);
    assert_eq!(model.base.minimality, Minimality::Proved, "{} parameters", model.base.parameters.len());
    // The rank of the torques by all numbers of the links, in numbers: as many.
    let mut random = Random(103);
    let formulas = Formulas::of_rows(&tree);
    let own = formulas.dynamics.links.iter().flat_map(|l| l.before.matrix().concat());
    let mut values: Vec<(Symbol, f64)> = vec![];
    for s in own.flat_map(Expr::symbols) {
        if !values.iter().any(|v| v.0 == s) {
            values.push((s, random.between(0.3, 1.2)));
        }
    }
    let value = |s: Symbol| values.iter().find(|v| v.0 == s).map_or(Some(0.0), |v| Some(v.1));
    let plain = formulas.dynamics.map(|e| e.eval(value).unwrap());
    let mut rows: Vec<Vec<f64>> = vec![];
    let mut random = Random(104);
    for _ in 0..30 {
        let [q, qd, qdd] = [0; 3].map(|_| (0..6).map(|_| random.between(-2.0, 2.0)).collect::<Vec<f64>>());
        let mut columns: Vec<Vec<f64>> = vec![];
        for link in 0..plain.links.len() {
            for k in 0..10 {
                let mut one = plain.clone();
                for (j, l) in one.links.iter_mut().enumerate() {
                    let own = std::array::from_fn(|i| f64::from(u8::from(j == link && i == k)));
                    l.body = denavit::geometry::Body::of(own);
                }
                columns.push(inverse_dynamics(&one, &q, &qd, &qdd, None));
            }
        }
        rows.extend((0..6).map(|j| columns.iter().map(|c| c[j]).collect()));
    }
    assert_eq!(model.base.parameters.len(), rank(rows));
}

/// Linkages fall, without friction: the energy stays, and the loops stay closed; or it ends where modes meet.
#[test]
fn loops_that_fall_keep_their_energy() {
    let mut random = Random(105);
    let (mut fell, mut ended) = (0, 0);
    for name in ["four-bar", "five-bar", "slider-crank", "palletiser", "akr3000"] {
        for _ in 0..3 {
            let mut linkage = weighed(catalogued(name), &mut random);
            linkage.tree.rows.iter_mut().for_each(|r| r.viscous = None);
            let of = ClosedDynamics::new(&linkage).unwrap();
            let (q, p, _) = somewhere(&of, &mut random);
            let still = vec![0.0; q.len()];
            let torques = Torques::constant(still.clone());
            let found = match simulate_closed(&of, (&q, &p, &still), &torques, (0.4, 0.02), 1e-9) {
                Ok(found) => found,
                Err((NoMotion::Meets { t }, found)) => {
                    assert!(t > 0.0, "{name}");
                    ended += 1;
                    found
                }
                Err((why, _)) => panic!("{name}: {why}"),
            };
            fell += 1;
            let (drift, size) = found.drift();
            assert!(drift < 1e-5 * size.max(1e-3), "{name}: {drift:e} of {size:e}");
            for m in &found.moments {
                let (q, p) = m.q.split_at(q.len());
                assert!(of.loops().is_closed(q, p), "{name} at {} s", m.t);
            }
        }
    }
    assert!(3 * ended < fell, "{ended} of {fell}");
}

/// A four-bar of which the driven joint only rocks goes through its dead points, where that joint stands still and its rate says nothing:
/// the energy stays, and it comes out on the other side.
#[test]
fn a_rocker_that_is_driven_goes_through_its_dead_points() {
    let text = "name = \"rocker\"\nconvention = \"khalil\"\ntip = \"coupler\"\ngravity = [0, -9.81, 0]\n\
        [[joints]]\nname = \"rocker\"\ntheta = \"q1\"\nmass = 3\ncom = [1, 0, 0]\ninertia = [0, 0, 0, 1, 0, 1]\n\
        [[joints]]\nname = \"coupler\"\nd = 2.5\ntheta = \"p1\"\nmass = 3\ncom = [1.5, 0, 0]\ninertia = [0, 0, 0, 2, 0, 2]\n\
        [[joints]]\nname = \"crank\"\nafter = \"base\"\nd = 3\ntheta = \"p2\"\nmass = 1\ncom = [0.5, 0, 0]\ninertia = [0, 0, 0, 0.1, 0, 0.1]\n\
        [[closures]]\nleft = { after = \"coupler\", d = 2.7, theta = \"p3\" }\nright = { after = \"crank\", d = 1 }\n";
    let of = ClosedDynamics::new(&linkage(text)).unwrap();
    let q = [1.2];
    let p = of.loops().assemblies(&q)[0].passive.clone();
    // A push that turns the crank round and round.
    let found = simulate_closed(&of, (&q, &p, &[3.0]), &Torques::constant(vec![0.0]), (6.0, 0.01), 1e-10);
    let found = found.unwrap_or_else(|(why, s)| panic!("{why} ({} samples)", s.moments.len()));
    let (drift, size) = found.drift();
    assert!(drift < 1e-6 * size, "{drift:e} of {size:e}");
    let turned =
        found.moments.iter().map(|m| m.q[2]).fold([f64::MAX, f64::MIN], |[a, b], x| [a.min(x), b.max(x)]);
    assert!(turned[1] - turned[0] > 2.0 * PI, "the crank goes round: {turned:?}");
    let rocks = found.moments.windows(2).filter(|w| w[0].qd[0] * w[1].qd[0] < 0.0).count();
    assert!(rocks >= 2, "{rocks}");
}
