//! Closed loops: their passive joints, their velocities, and the chains that they are.

use crate::common::Random;
use denavit::catalogue;
use denavit::closure::{Loops, Open, findings, mobility};
use denavit::description::linkage::spherical::{spherical_square, type_2};
use denavit::description::linkage::{Dyad, Plan, Unsolved};
use denavit::description::{
    Convention, Decimals, Described, Description, JointKind, Linkage, NotCoupled, prove_same_chain, read_par,
    read_robot, read_toml, write_toml,
};
use denavit::geometry::Transform;
use denavit::inverse::{InverseKinematics, InverseOptions};
use denavit::robot::Robot;
use denavit_symbolic::{Expr, equal};
use std::f64::consts::PI;

pub trait Between {
    fn between(&mut self, low: f64, high: f64) -> f64;
}

impl Between for Random {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }
}

pub fn linkage(text: &str) -> Linkage {
    match read_robot(text)
        .unwrap_or_else(|f| panic!("{}\n{text}", denavit::description::render(&f, "", text)))
        .0
    {
        Described::Linkage(linkage) => *linkage,
        _ => panic!("a linkage is expected"),
    }
}

pub fn par(text: &str) -> Linkage {
    match read_par(text, Decimals::Meant)
        .unwrap_or_else(|f| panic!("{}\n{text}", denavit::description::render(&f, "", text)))
        .0
    {
        Described::Linkage(linkage) => *linkage,
        _ => panic!("a linkage is expected"),
    }
}

pub fn catalogued(name: &str) -> Linkage {
    catalogue::linkage(name).unwrap_or_else(|| panic!("{name}"))
}

/// The geometry of SR400.par, AKR3000.par and TwoLoops.par of SYMORO (github.com/symoro/symoro-robots), by columns.
pub const SR400: &str = "(* Robotname = 'SR400' *)\nNL = 8\nNJ = 9\nNF = 10\nType = 2\nant = {0,1,2,3,4,5,1,7,8,3}\n\
    sigma = {0,0,0,0,0,0,0,0,0,2}\nb = {1,0,0,0,0,0,0,0,0,0}\nd = {0,d2,d3,d4,0,0,d2,-d8,d3,-d8}\n\
    r = {0,0,0,r4,0,0,0,0,0,0}\ngamma = {0,0,0,0,0,0,0,0,0,pi/2}\n\
    alpha = {0,-pi/2,0,-pi/2,pi/2,-pi/2,-pi/2,0,0,0}\nmu = {1,1,0,1,1,1,1,0,0,0}\n\
    theta = {th1,th2,th3,th4,th5,th6,th7,th8,th9,0}\n";
const AKR3000: &str = "(* Robotname = 'AKR3000' *)\nNL = 10\nNJ = 12\nNF = 14\nType = 2\n\
    ant = {0,1,1,1,3,4,2,7,8,9,5,6,7,2}\nsigma = {0,0,0,0,1,1,0,0,0,0,0,0,2,2}\n\
    d = {0,0,D3,D4,0,0,D7,0,0,0,0,0,D13,D14}\nr = {0,0,0,0,r5,r6,0,RL8,0,0,0,0,0,0}\n\
    gamma = {0,0,0,0,0,0,0,0,0,0,0,0,gam13,gam14}\nb = {0,0,0,0,0,0,0,0,0,0,0,0,0,0}\n\
    alpha = {0,pi/2,pi/2,pi/2,-pi/2,-pi/2,0,-pi/2,pi/2,-pi/2,pi/2,pi/2,0,0}\n\
    mu = {1,0,0,0,1,1,0,1,1,1,0,0,0,0}\ntheta = {t1,t2,t3,t4,0,0,t7,t8,t9,t10,t11,t12,0,0}\n\
    (* D3 = 0.4 *)\n(* D4 = 0.5 *)\n(* D7 = 0.9 *)\n(* RL8 = 0.8 *)\n(* D13 = 0.35 *)\n(* D14 = 0.4 *)\n\
    (* gam13 = 0.6 *)\n(* gam14 = -0.7 *)\n";
const TWO_LOOPS: &str = "(* Robotname = 'TwoLoops' *)\nNL = 8\nNJ = 10\nNF = 12\nType = 2\n\
    ant = {0,1,2,3,4,1,4,3,7,6,8,11}\nsigma = {0,0,0,0,0,0,0,0,0,0,2,2}\n\
    b = {0,0,0,0,0,d12*cos(g12),0,0,0,0,0,0}\nd = {0,0,d3,d4,0,-d12*sin(g12),d7,0,d4,d3,d7,0}\n\
    r = {0,0,0,0,0,0,0,0,0,0,0,0}\ngamma = {0,0,0,0,0,0,g12 + pi/2,0,0,0,g12 + pi/2,0}\n\
    alpha = {0,pi/2,0,0,pi/2,pi/2,0,0,0,0,0,0}\nmu = {1,1,1,0,1,0,0,0,0,0,0,0}\n\
    theta = {th1,th2,th3,th4,th5,th6,th7,th8,th9,th10,0,0}\n";

fn affine(linkage: &Linkage) -> Vec<String> {
    let plan = Plan::of(linkage);
    let all = plan.affine(&plan.usual());
    let shown = |(s, e): &(denavit_symbolic::Symbol, Option<Expr>)| {
        format!("{} = {}", s.name(), e.map_or("?".into(), |e| e.to_string()))
    };
    let mut all: Vec<String> = all.iter().map(shown).collect();
    all.sort();
    all
}

#[test]
fn symoros_sr400_has_its_closure_relations() {
    // Khalil and Dombre (2002), ch. 7: θ3 = π/2 − θ2 + θ7 up to the zero of frame 10, θ8 = θ2 − θ7, θ9 = θ7 − θ2. In this file's
    // numbers p1 = θ3, p2 = θ8, p3 = θ9, q6 = θ7; both sides are proved to coincide below.
    let l = par(SR400);
    assert_eq!(affine(&l), ["p1 = q6 - q2 - pi/2", "p2 = q2 - q6", "p3 = q6 - q2"]);
    let plan = Plan::of(&l);
    assert!(plan.unsolved.is_empty());
    assert_eq!(plan.modes().iter().map(ToString::to_string).collect::<Vec<_>>(), ["=", "x"]);
    assert_eq!(l.first_open(&plan, &plan.usual()), None, "both frames coincide, proved");
    // The relation is not proved of the crossed mode, which is another one.
    let chain = l.chain(None, None, None, Convention::Khalil).expect("a chain");
    assert_eq!(chain.to, "6");
    let names: Vec<String> = chain.variables.iter().map(|s| s.name().to_string()).collect();
    assert_eq!(names, ["q1", "q2", "q6", "q3", "q4", "q5"], "the lever stands third on the way");
    assert_eq!(chain.description.rows[2].theta.to_string(), "q3 - q2 - pi/2");
    let closed = chain.closed.expect("it was taken out of a linkage");
    let shown = |all: &[Expr]| all.iter().map(ToString::to_string).collect::<Vec<_>>();
    assert_eq!(shown(&closed.meets), ["sin(q2 - q6)"], "flat where the lever lies along the arm");
    assert_eq!(closed.beside, ["7", "8"]);
    let why = l.chain(None, None, Some("x"), Convention::Khalil).expect_err("crossed, it is not affine");
    assert_eq!(why, NotCoupled::NotAffine { passive: vec!["p1".into()], mode: "x".into() });
}

#[test]
fn the_other_two_of_symoros_linkages_are_read_and_solved() {
    let l = par(AKR3000);
    let plan = Plan::of(&l);
    // First the loop of the arm, then that of the forearm, which stands on it.
    assert_eq!(plan.steps.iter().map(|s| s.closure).collect::<Vec<_>>(), [1, 0]);
    assert_eq!(plan.modes().iter().map(ToString::to_string).collect::<Vec<_>>(), ["++", "+-", "-+", "--"]);
    assert!(matches!(
        l.chain(None, None, None, Convention::Khalil),
        Err(NotCoupled::NotAffine { passive, .. }) if passive == ["p1", "p4"]
    ));
    let l = par(TWO_LOOPS);
    assert_eq!((l.tree.rows.len(), l.closures.len()), (9, 2), "the side that carries the other is a row");
    let plan = Plan::of(&l);
    assert!(plan.unsolved.is_empty(), "{:?}", plan.unsolved);
    // The ground of the second loop is d12 long, its opposite d7: a parallelogram where these are one.
    assert_eq!(plan.usual().to_string(), "+=");
    let l = par(&TWO_LOOPS.replace("d12", "d7"));
    let plan = Plan::of(&l);
    assert_eq!(plan.usual().to_string(), "==", "{plan:?}");
    assert_eq!(l.first_open(&plan, &plan.usual()), None, "closed, proved");
}

#[test]
fn mobility_is_that_of_the_prototype() {
    for (name, joints, count) in [
        ("sr400", 9, 6),
        ("akr3000", 12, 6),
        ("palletiser", 13, 4),
        ("four-bar", 4, 1),
        ("five-bar", 5, 2),
        ("slider-crank", 4, 1),
        ("irb660", 13, 4),
        ("kr-pa", 13, 4),
        ("irb2400", 9, 6),
        ("four-bar-gripper", 7, 1),
    ] {
        let loops = Loops::new(&catalogued(name)).expect("all values are there");
        let m = mobility(&loops).unwrap_or_else(|| panic!("{name} closes"));
        assert_eq!((m.joints, m.count(), m.is_jammed), (joints, count, false), "{name}");
        assert!(m.free.is_empty(), "{name}: {:?}", m.free);
    }
}

/// Driven joints at random; slides from 0.5 m to 1.2 m.
pub fn anywhere(loops: &Loops, random: &mut Random) -> Vec<f64> {
    let kinds = loops.driven().iter();
    kinds
        .map(|k| match k {
            denavit::description::JointKind::Revolute => random.between(-3.0, 3.0),
            denavit::description::JointKind::Prismatic => random.between(0.5, 1.2),
        })
        .collect()
}

#[test]
fn every_assembly_closes_and_modes_are_different() {
    for (name, most) in [
        ("sr400", 2),
        ("akr3000", 4),
        ("palletiser", 8),
        ("four-bar", 2),
        ("five-bar", 2),
        ("slider-crank", 2),
        ("irb660", 8),
        ("kr-pa", 8),
        ("irb2400", 2),
        ("four-bar-gripper", 4),
    ] {
        let loops = Loops::new(&catalogued(name)).expect("values");
        let mut random = Random(7);
        let (mut counts, mut worst) = (std::collections::BTreeSet::new(), 0.0_f64);
        for _ in 0..60 {
            let q = anywhere(&loops, &mut random);
            let all = loops.assemblies(&q);
            counts.insert(all.len());
            for (i, a) in all.iter().enumerate() {
                worst = worst.max(a.residual);
                assert!(!a.is_numeric);
                for b in &all[..i] {
                    let apart = a.passive.iter().zip(&b.passive).map(|(x, y)| ((x - y) / 2.0).sin().abs());
                    assert!(apart.fold(0.0, f64::max) > 1e-6, "{name}: {} and {} are one", a.mode, b.mode);
                }
            }
        }
        assert!(worst < 1e-12, "{name}: {worst:e}");
        assert_eq!(counts.last(), Some(&most), "{name}: {counts:?}");
    }
}

#[test]
fn the_parallelogram_is_the_mode_that_is_meant() {
    let loops = Loops::new(&catalogued("sr400")).expect("values");
    let mode = loops.mode(Some("parallelogram")).expect("it is named");
    let q = [0.3, -1.2, 0.4, 0.1, 0.2, 0.3];
    let a = loops.assembly(&q, &mode).expect("it closes");
    let expected = [q[2] - q[1] - PI / 2.0, q[1] - q[2], q[2] - q[1]];
    assert!(
        a.passive.iter().zip(expected).all(|(p, e)| ((p - e) / 2.0).sin().abs() < 1e-15),
        "{:?}",
        a.passive
    );
    // Flat, both modes meet: it is said, and nothing is free that is not.
    let q = [0.3, 0.7, 0.7, 0.1, 0.2, 0.3];
    let flat = loops.assembly(&q, &mode).expect("it closes");
    assert_eq!(flat.flat, [0]);
    let place = loops.place(None).expect("a tip").1;
    let rates = loops.rates(&place, &q, &flat.passive);
    assert_eq!((rates.free, rates.passive.is_none()), (1, true), "W_p loses rank");
}

#[test]
fn the_palletiser_is_the_serial_table_with_couplings() {
    let serial = "name = \"by hand\"\nconvention = \"khalil\"\n[parameters]\nh = 0.8\na1 = 0.26\na2 = 1\na3 = 1.1\na5 = 0.22\n\
        d6 = 0.25\n[[joints]]\ntheta = \"q1\"\nr = \"h\"\n[[joints]]\nalpha = \"90 deg\"\nd = \"a1\"\ntheta = \"q2\"\n\
        [[joints]]\nd = \"a2\"\ntheta = \"q3 - q2\"\n[[joints]]\nd = \"a3\"\ntheta = \"-q3\"\n\
        [[joints]]\nalpha = \"-90 deg\"\nd = \"a5\"\nr = \"-d6\"\ntheta = \"q4\"\n";
    let (serial, _) = read_toml(serial).expect("a table");
    let l = catalogued("palletiser");
    let chain = l.chain(None, None, None, Convention::Khalil).expect("a chain");
    assert!(prove_same_chain(&chain.description, &serial).is_equal(), "{}", write_toml(&chain.description));
    let closed = chain.closed.expect("it was taken out of a linkage");
    assert_eq!(
        (closed.mode.to_string().as_str(), closed.mode_name.as_deref()),
        ("===", Some("parallelograms"))
    );
    assert!(!closed.is_of_values);
    // The hand of the closed linkage is where that of the chain is.
    let (robot, loops) =
        (Robot::numeric(&chain.description).expect("values"), Loops::new(&l).expect("values"));
    let (mode, place) = (loops.mode(None).expect("the first"), loops.place(None).expect("a tip").1);
    let mut random = Random(3);
    for _ in 0..50 {
        let q = anywhere(&loops, &mut random);
        let a = loops.assembly(&q, &mode).expect("it closes");
        assert!(apart(&loops.pose(&place, &q, &a.passive), &robot.pose(&q)) < 1e-13);
    }
    // The same solutions of the same poses.
    let options = InverseOptions::default();
    let solvers =
        [&chain.description, &serial].map(|d: &Description| InverseKinematics::new(d, &options).ok());
    if let [Some(a), Some(b)] = solvers {
        for _ in 0..20 {
            let q: Vec<f64> = (0..4).map(|_| random.between(-1.5, 1.5)).collect();
            let pose = robot.pose(&q);
            let (a, b) = (a.solve(&pose, &[]), b.solve(&pose, &[]));
            assert_eq!(a.solutions.len(), b.solutions.len());
            assert!(!a.solutions.is_empty(), "the configuration itself is one");
        }
    } else {
        panic!("both have inverse kinematics");
    }
}

fn apart(a: &Transform<f64>, b: &Transform<f64>) -> f64 {
    let (a, b) = (a.matrix(), b.matrix());
    a.as_flattened().iter().zip(b.as_flattened()).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
}

#[test]
fn the_sr400_has_all_its_inverse_solutions_in_driven_joints() {
    let l = catalogued("sr400");
    let d = l.chain(None, None, None, Convention::Khalil).expect("a chain").description;
    let solver = InverseKinematics::new(&d, &InverseOptions::default()).expect("a spherical wrist");
    let (loops, robot) = (Loops::new(&l).expect("values"), Robot::numeric(&d).expect("values"));
    let (mode, place) = (loops.mode(None).expect("the first"), loops.place(None).expect("a tip").1);
    let mut random = Random(11);
    for _ in 0..30 {
        let q: Vec<f64> = (0..6).map(|_| random.between(-1.3, 1.3)).collect();
        let pose = robot.pose(&q);
        let answer = solver.solve(&pose, &[]);
        assert!(answer.is_complete());
        let own = |s: &[f64]| s.iter().zip(&q).all(|(a, b)| ((a - b) / 2.0).sin().abs() < 1e-9);
        assert!(answer.solutions.iter().any(|s| own(&s.q)), "{q:?}");
        for s in &answer.solutions {
            let a = loops.assembly(&s.q, &mode).expect("it closes");
            assert!(apart(&loops.pose(&place, &s.q, &a.passive), &pose) < 1e-9);
        }
    }
}

#[test]
fn velocities_are_those_of_differences() {
    for name in ["sr400", "akr3000", "palletiser", "four-bar", "five-bar", "slider-crank"] {
        let loops = Loops::new(&catalogued(name)).expect("values");
        let place = loops.place(None).expect("a tip").1;
        let mut random = Random(5);
        let (mut compared, mut fine) = (0, 0);
        for _ in 0..25 {
            let q = anywhere(&loops, &mut random);
            for a in loops.assemblies(&q) {
                let rates = loops.rates(&place, &q, &a.passive);
                let (Some(g), Some(j)) = (&rates.passive, &rates.frame) else { continue };
                let size = g.iter().flatten().fold(1.0_f64, |m, x| m.max(x.abs()));
                if size > 20.0 {
                    continue; // differences say little where modes nearly meet
                }
                // Differences of order 8 by two steps: what they leave out is less than what tells them apart.
                let here = loops.pose(&place, &q, &a.passive);
                for k in 0..q.len() {
                    let at = |by: f64| {
                        let mut q = q.clone();
                        q[k] += by;
                        let p = loops.assembly(&q, &a.mode).ok()?.passive;
                        // A turn of a whole is none.
                        let near = |(x, near): (&f64, &f64)| x - 2.0 * PI * ((x - near) / (2.0 * PI)).round();
                        let pose = loops.pose(&place, &q, &p).matrix().concat();
                        let angles = loops.passive().iter().zip(p.iter().zip(&a.passive));
                        let p = angles.map(|(kind, both)| match kind {
                            JointKind::Revolute => near(both),
                            JointKind::Prismatic => *both.0,
                        });
                        Some([pose, p.collect()].concat())
                    };
                    let slope_by = |h: f64| -> Option<Vec<f64>> {
                        let mut slope = vec![0.0; 16 + a.passive.len()];
                        for (step, part) in (1..).zip([4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0]) {
                            let by = f64::from(step) * h;
                            let (after, before) = (at(by)?, at(-by)?);
                            let all = slope.iter_mut().zip(after.iter().zip(&before));
                            all.for_each(|(s, (x, y))| *s += part * (x - y) / h);
                        }
                        Some(slope)
                    };
                    let (Some(coarse), Some(slope)) = (slope_by(4e-3), slope_by(2e-3)) else { continue };
                    let apart = coarse.iter().zip(&slope).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                    let tolerance = 1e-10 + apart;
                    fine += usize::from(apart < 1e-11);
                    for (i, row) in g.iter().enumerate() {
                        let off = (slope[16 + i] - row[k]).abs();
                        assert!(off < tolerance, "{name} p{} q{}: {off:e}", i + 1, k + 1);
                    }
                    // Ṙ Rᵀ
                    let r = here.rotation.rows();
                    let turning =
                        |i: usize, j: usize| (0..3).map(|m| slope[4 * i + m] * r[j][m]).sum::<f64>();
                    let w = [turning(2, 1), turning(0, 2), turning(1, 0)];
                    for (i, x) in [slope[3], slope[7], slope[11]].into_iter().chain(w).enumerate() {
                        let off = (x - j[k][i]).abs();
                        assert!(off < tolerance, "{name}: {i} of q{}: {off:e}", k + 1);
                    }
                    compared += 1;
                }
            }
        }
        assert!(compared > 10 && 2 * fine > compared, "{name}: {fine} of {compared}");
    }
}

#[test]
fn four_bars_at_random_close_in_both_modes_or_are_open_by_what_is_said() {
    let mut random = Random(21);
    let (mut closed, mut open) = (0, 0);
    for _ in 0..150 {
        let mut l = || random.between(0.2, 2.0);
        let (a, b, c, g) = (l(), l(), l(), l());
        let text = format!(
            "name = \"x\"\nconvention = \"khalil\"\n[[joints]]\nname = \"a\"\ntheta = \"q1\"\n[[joints]]\nname = \"b\"\n\
             d = {a}\ntheta = \"p1\"\n[[joints]]\nname = \"c\"\nafter = \"base\"\nd = {g}\ntheta = \"p2\"\n[[closures]]\n\
             left = {{ after = \"b\", d = {b}, theta = \"p3\" }}\nright = {{ after = \"c\", d = {c} }}\n"
        );
        let loops = Loops::new(&linkage(&text)).expect("values");
        let q = random.between(-3.0, 3.0);
        let far = (g - a * q.cos()).hypot(a * q.sin());
        let all = loops.assemblies(&[q]);
        if far < b + c && far > (b - c).abs() {
            assert_eq!(all.len(), 2, "{text} at {q}");
            assert!(all.iter().all(|x| x.residual < 1e-12 && x.flat.is_empty()));
            // The sign is that of the area of the triangle from the end of the crank to the end of the coupler: the coupler turns
            // from the line between the pivots.
            for x in &all {
                let (o, e) = ((a * q.cos(), a * q.sin()), q + x.passive[0]);
                let area = (g - o.0) * e.sin() - (-o.1) * e.cos();
                assert_eq!(x.mode.to_string(), if area > 0.0 { "+" } else { "-" });
            }
            closed += 1;
        } else {
            assert!(all.is_empty());
            let gap = (far - b - c).max((b - c).abs() - far);
            match loops.assembly(&[q], &loops.plan().usual()) {
                Err(Open::Gap { metres: Some(said), .. }) => assert!((said - gap).abs() < 1e-12),
                other => panic!("{other:?}"),
            }
            open += 1;
        }
    }
    assert!(closed > 30 && open > 30);
}

#[test]
fn kites_and_parallelograms_are_found_exactly_and_nothing_else_is() {
    let four = |a: &str, b: &str, c: &str, g: &str| {
        linkage(&format!(
            "name = \"x\"\nconvention = \"khalil\"\n[parameters]\na = 1\nb = 2\nc = 3\ng = 4\n[[joints]]\nname = \"a\"\n\
             theta = \"q1\"\n[[joints]]\nname = \"b\"\nd = \"{a}\"\ntheta = \"p1\"\n[[joints]]\nname = \"c\"\nafter = \"base\"\n\
             d = \"{g}\"\ntheta = \"p2\"\n[[closures]]\nleft = {{ after = \"b\", d = \"{b}\", theta = \"p3\" }}\n\
             right = {{ after = \"c\", d = \"{c}\" }}\n"
        ))
    };
    let parallelogram = four("a", "b", "a", "b");
    assert_eq!(affine(&parallelogram), ["p1 = -q1", "p2 = q1", "p3 = q1"]);
    assert_eq!(affine(&four("a", "a", "b", "b")), ["p1 = pi", "p2 = pi", "p3 = -q1"], "a kite, folded");
    let [first, second] = [four("a", "a", "a", "a"), four("a", "b", "c", "g")].map(|l| Plan::of(&l));
    let Dyad::Turns { affine, .. } = &first.steps[0].dyad else { panic!("three turn") };
    assert_eq!(affine.len(), 2, "of a rhombus both are affine");
    assert_eq!(second.usual().to_string(), "+");
    // The discriminant is a square: of the parallelogram, (2·area)² = (a·b·sin q1)².
    let plan = Plan::of(&parallelogram);
    let Dyad::Turns { a, b, p, affine } = &plan.steps[0].dyad else { panic!("three turn") };
    let square = denavit::description::linkage::dyad::rrr_square(a.formula(), b.formula(), p.formula());
    let root = Expr::symbol("a") * Expr::symbol("b") * Expr::symbol("q1").sin();
    assert!(equal(square, root * root).is_equal());
    // Its other mode is rational, and closes: |w|² = |A|² and |P − w|² = |B|² for w mirrored at P, with the parameter's names.
    let mirrored = denavit::description::linkage::dyad::rrr_mirrored(
        a.formula(),
        b.formula(),
        p.formula(),
        denavit::description::linkage::Complex::direction(affine[0][0].to_expr()),
    );
    let rest = a.formula() * mirrored[0] + b.formula() * mirrored[1] - p.formula();
    for e in [rest.re, rest.im, mirrored[0].square() - Expr::int(1), mirrored[1].square() - Expr::int(1)] {
        assert!(equal(e, Expr::int(0)).is_equal());
    }
}

#[test]
fn dyads_are_proved_for_all_lengths() {
    use denavit::description::linkage::Complex;
    use denavit::description::linkage::dyad::{rpr, rpr_square, rrp, rrp_square, rrr, rrr_square, slides};
    let s = Expr::symbol;
    let z = |name: &str| Complex::new(s(&format!("{name}x")), s(&format!("{name}y")));
    let (a, b, p) = (z("a"), z("b"), z("p"));
    let is_zero = |all: &[Expr]| all.iter().all(|&e| equal(e, Expr::int(0)).is_equal());
    let one = Expr::int(1);
    let [e1, e2] = rrr(a, b, p, rrr_square(a, b, p).sqrt());
    let rest = a * e1 + b * e2 - p;
    assert!(is_zero(&[rest.re, rest.im, e1.square() - one, e2.square() - one]), "R R R");
    let (e, r) = rrp(a, b, p, rrp_square(a, b, p).sqrt());
    let rest = a * e + b.scale(r) - p;
    assert!(is_zero(&[rest.re, rest.im, e.square() - one]), "R R P");
    let (e, r) = rpr(a, b, p, rpr_square(a, b, p).sqrt());
    let rest = (a + b.scale(r)) * e - p;
    assert!(is_zero(&[rest.re, rest.im, e.square() - one]), "R P R");
    let ([r, t], _) = slides(a, b, p);
    let rest = a.scale(r) + b.scale(t) - p;
    assert!(is_zero(&[rest.re, rest.im]), "two slides");
}

/// A spherical four-bar: all axes through the origin.
fn spherical(last: &str) -> String {
    format!(
        "name = \"x\"\nconvention = \"khalil\"\n[[joints]]\nname = \"a\"\ntheta = \"q1\"\n[[joints]]\nname = \"b\"\n\
        alpha = \"40 deg\"\ntheta = \"p1\"\n[[joints]]\nname = \"c\"\nafter = \"base\"\nalpha = \"70 deg\"\ntheta = \"p2\"\n\
        [[closures]]\nleft = {{ after = \"b\", alpha = \"60 deg\", theta = \"p3\" }}\n\
        right = {{ after = \"c\", {last} }}\n"
    )
}

#[test]
fn spherical_loops_have_closed_forms() {
    let l = linkage(&spherical("alpha = \"50 deg\""));
    let plan = Plan::of(&l);
    let [step] = &plan.steps[..] else { panic!("{:?}", plan.unsolved) };
    let Dyad::Spherical(between) = &step.dyad else { panic!("it is spherical") };
    // Proved: Rz(a)·K1·Rz(b)·K2·Rz(c)·K3 has the zz entry that b is made for, for all q1.
    let [a, b, d] = type_2(&between.0);
    let h = spherical_square(&between.0).sqrt();
    let cos = (a * d - b * h) / (a * a + b * b);
    let sin = (b * d + a * h) / (a * a + b * b);
    for e in [a * cos + b * sin - d, cos * cos + sin * sin - Expr::int(1)] {
        assert!(equal(e, Expr::int(0)).is_equal());
    }
    let loops = Loops::new(&l).expect("values");
    let (mut two, mut none) = (0, 0);
    for k in 0..63 {
        let q = f64::from(k) * 0.1 - 3.1;
        let all = loops.assemblies(&[q]);
        assert!(all.iter().all(|a| !a.is_numeric && a.residual < 1e-12), "{all:?}");
        match all.len() {
            2 => two += 1,
            0 => none += 1,
            n => panic!("{n} at {q}"),
        }
    }
    assert!(two > 10 && none + two == 63, "{two} {none}");
    assert_eq!(mobility(&loops).expect("it closes").count(), 1);
}

#[test]
fn loops_that_are_neither_are_found_by_descent_and_say_so() {
    // One axis misses the others by 10 cm, so that nothing moves: the mobility is 0, where it closes at all.
    let l = linkage(&spherical("alpha = \"50 deg\", d = 0.1"));
    assert!(matches!(Plan::of(&l).unsolved[..], [(0, Unsolved::NotPlanar(_))]));
    let loops = Loops::new(&l).expect("values");
    for k in 0..6 {
        assert!(loops.assemblies(&[f64::from(k)]).iter().all(|a| a.is_numeric && a.residual < 1e-8));
    }
    // A planar loop of two driven and four passive joints: a descent ends in one of its modes.
    let five = "name = \"x\"\nconvention = \"khalil\"\n[[joints]]\nname = \"a\"\ntheta = \"q1\"\n[[joints]]\nname = \"b\"\nd = 1\n\
        theta = \"p1\"\n[[joints]]\nname = \"c\"\nd = 1\ntheta = \"p2\"\n[[joints]]\nname = \"e\"\nafter = \"base\"\nd = 1.5\n\
        theta = \"p3\"\n[[closures]]\nleft = { after = \"c\", d = 1, theta = \"p4\" }\nright = { after = \"e\", d = 1 }\n";
    let l = linkage(five);
    assert!(matches!(&Plan::of(&l).unsolved[..], [(0, Unsolved::Unknowns(all))] if all.len() == 4));
    assert!(findings(&l).iter().any(|d| d.message.contains("found by Newton's method")));
    let loops = Loops::new(&l).expect("values");
    let a = &loops.assemblies(&[0.7])[0];
    assert!(a.is_numeric && a.residual < 1e-9, "{a:?}");
    assert_eq!(mobility(&loops).expect("it closes").count(), 2);
}

/// A loop that is not affine beside a parallelogram is not proved by it, and that is said.
#[test]
fn what_is_not_proved_beside_a_chain_is_named() {
    let text = "name = \"two loops\"\nconvention = \"khalil\"\n\
                [[joints]]\nname = \"crank\"\ntheta = \"q1\"\n\
                [[joints]]\nname = \"coupler\"\nd = 1\ntheta = \"p1\"\n\
                [[joints]]\nname = \"other\"\nafter = \"base\"\nd = 3\ntheta = \"p2\"\n\
                [[joints]]\nname = \"rod\"\nafter = \"crank\"\nd = 0.5\ntheta = \"p3\"\n\
                [[joints]]\nname = \"rocker\"\nafter = \"base\"\nd = 2\ntheta = \"p4\"\n\
                [[closures]]\nname = \"four\"\nleft = { after = \"coupler\", d = 3, theta = \"p5\" }\nright = { after = \"other\", d = 1 }\n\
                [[closures]]\nname = \"dyad\"\nleft = { after = \"rod\", d = 0.9, theta = \"p6\" }\nright = { after = \"rocker\", d = 0.7 }\n";
    let read = read_robot(text).unwrap_or_else(|f| panic!("{}", denavit::description::render(&f, "", text)));
    let Described::Linkage(linkage) = read.0 else { panic!("closed loops") };
    let chain = linkage.chain(None, Some("coupler"), None, Convention::Khalil).expect("a chain");
    let closed = chain.closed.expect("out of loops");
    assert_eq!(closed.untested, ["dyad"]);
    assert_eq!(closed.passive.iter().map(|p| p.0.name().to_string()).collect::<Vec<_>>(), ["p1", "p2", "p5"]);
}

/// Of a rhombus the parallelogram is what is meant, and a rhombus at rest is closed.
#[test]
fn a_rhombus_is_a_parallelogram_first() {
    let text = "name = \"rhombus\"\nconvention = \"khalil\"\n\
                [[joints]]\nname = \"crank\"\ntheta = \"q1\"\n\
                [[joints]]\nname = \"coupler\"\nd = 1\ntheta = \"p1\"\n\
                [[joints]]\nname = \"rocker\"\nafter = \"base\"\nd = 1\ntheta = \"p2\"\n\
                [[closures]]\nleft = { after = \"coupler\", d = 1, theta = \"p3\" }\nright = { after = \"rocker\", d = 1 }\n";
    let (read, _) = read_robot(text).expect("loops");
    let Described::Linkage(linkage) = read else { panic!("closed loops") };
    let loops = Loops::new(&linkage).expect("in numbers");
    let first = loops.assembly(&[1.0], &loops.plan().usual()).expect("closed");
    assert!((first.passive[0] + 1.0).abs() < 1e-12, "the coupler keeps its direction: {first:?}");
    assert!(!findings(&linkage).iter().any(|d| d.message.contains("not closed")));
}

/// More modes than are listed: relations of the last ones are found all the same.
#[test]
fn modes_beyond_those_that_are_listed() {
    let mut text = String::from("name = \"many\"\nconvention = \"khalil\"\n");
    for k in 0..8 {
        text += &format!(
            "[[joints]]\nname = \"crank{k}\"\nafter = \"base\"\ntheta = \"q{}\"\n[[joints]]\nname = \"coupler{k}\"\nd = 1\ntheta = \"p{}\"\n\
             [[joints]]\nname = \"rocker{k}\"\nafter = \"base\"\nd = 3\ntheta = \"p{}\"\n",
            k + 1,
            2 * k + 1,
            2 * k + 2
        );
    }
    for k in 0..8 {
        text += &format!(
            "[[closures]]\nleft = {{ after = \"coupler{k}\", d = 2.5, theta = \"p{}\" }}\nright = {{ after = \"rocker{k}\", d = 2 }}\n",
            17 + k
        );
    }
    let read =
        read_robot(&text).unwrap_or_else(|f| panic!("{}", denavit::description::render(&f, "", &text)));
    let Described::Linkage(linkage) = read.0 else { panic!("closed loops") };
    let loops = Loops::new(&linkage).expect("in numbers");
    assert_eq!((loops.plan().count(), loops.plan().modes().len()), (256, 64));
    let mode = loops.mode(Some("--------")).expect("a mode that is not listed");
    assert!(loops.assembly(&[1.0; 8], &mode).is_ok());
    assert!(loops.tried(&[1.0; 8]).len() < loops.plan().count(), "the command says so");
}
