//! Speed of what evaluates a pose, in units of six `sincos` calls of the C library timed in the same run; with the
//! argument `inverse`, of what solves one, in units of `ik-geo`; with `arms`, of what solves one without a closed form; with
//! `derivation` and `report`, the CPU time of deriving the models of every robot and of writing about it; with `descriptions`,
//! that of reading a URDF.
//!
//! Prints one JSON object, here the unit in ns and a figure for each entry. `cargo xtask bench` makes tables of it.

extern crate irb2400_ik_v3;
extern crate irb2400_ik_v4;
extern crate panda_v3;
extern crate panda_v4;
extern crate pandaj_v3;
extern crate pandaj_v4;
extern crate ur5_ik_v3;
extern crate ur5_ik_v4;
extern crate ur5_v3;
extern crate ur5_v4;
extern crate ur5j_v3;
extern crate ur5j_v4;

mod arms;
mod compiled;
mod derivation;
mod descriptions;
mod inverse;
mod jacobian;
mod measure;
mod memory;
mod peers;
mod report;

use anyhow::{Context, Result};
use denavit::forward::{Reference, frames_program, pose_program};
use denavit::{Description, Robot, catalogue};
use denavit_jit::MachineCode;
use denavit_program::{Arithmetic, Block, Function, Isa, Program, Real};
use measure::{COUNT, Entry};
use rs_opw_kinematics::kinematic_traits::Kinematics;
use rs_opw_kinematics::kinematics_impl::OPWKinematics;
use rs_opw_kinematics::parameters::opw_kinematics::Parameters;
use serde_json::json;
use std::hint::black_box;

fn main() -> Result<()> {
    let mut state = 1_u64;
    // Knuth's linear congruential generator; angles in (−π, π).
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5) * std::f64::consts::TAU
    };
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [] => {}
        ["inverse"] => return inverse::run(random),
        ["arms"] => return arms::run(false, random),
        ["arms", "--quick"] => return arms::run(true, random),
        ["derivation"] => return derivation::run(),
        ["descriptions"] => return descriptions::run(),
        ["report", folder] => return report::run(folder.as_ref()),
        _ => anyhow::bail!("no such benchmark: {}", arguments.join(" ")),
    }
    let ur5 = read("ur5")?;
    let panda = read("franka-panda")?;
    let pose = compiled(&ur5, &pose_program(&ur5));
    let all = (0..=panda.rows.len()).map(Reference::Frame).collect::<Vec<_>>();
    let frames = compiled(&panda, &frames_program(&panda, &all));
    let angles: Vec<f64> = (0..6 * COUNT).map(|_| random()).collect();
    let configurations: &[[f64; 6]] = angles.as_chunks().0;

    let mut entries = one_configuration(&ur5, &pose, configurations)?;
    entries.extend(compiled::one_configuration(configurations));
    for isa in Isa::available() {
        let limits = |limits: [f64; 2]| match isa.name() {
            "AVX-512" => Some(limits[0]),
            "AVX2" => Some(limits[1]),
            _ => None,
        };
        let on = pose.on(isa, isa.arithmetic());
        let name = |what: &str| format!("{what}, {}", isa.name());
        entries.push(block::<f64>("batch", name("interpreter over blocks, f64"), &on, limits([0.24, 0.28])));
        entries.push(block::<f32>("batch", name("interpreter over blocks, f32"), &on, None));
        let strict = pose.on(isa, Arithmetic::Strict);
        entries.push(block::<f64>(
            "batch",
            name("interpreter over blocks, f64, strict arithmetic"),
            &strict,
            None,
        ));
        let frames = frames.on(isa, isa.arithmetic());
        entries.push(block::<f64>(
            "batch",
            name("interpreter over blocks, all link frames of a Panda"),
            &frames,
            Some(0.35),
        ));
    }
    entries.extend(compiled::batch(configurations));
    // 23 MB in and out.
    const ROWS: usize = 32 * COUNT;
    let rows: Vec<f64> = configurations.iter().cycle().take(ROWS).flatten().copied().collect();
    for (name, threads) in [("rows to rows, 23 MB, one core", 1), ("rows to rows, 23 MB, two cores", 2)] {
        let (batch, rows) = (pose.batch::<f64>(), rows.clone());
        let mut out = vec![0.0; ROWS * 16];
        let threads = std::num::NonZero::new(threads);
        let run = move || batch.run_parallel(threads, black_box(&rows), black_box(&mut out));
        entries.push(entry("batch", name, ROWS, None, run));
    }
    entries.extend(jacobian::entries(&ur5, &panda, &angles)?);
    entries.extend(memory::entries(&pose, &mut random));
    entries.extend(compilation(&ur5, &pose_program(&ur5), &pose));

    let (unit, figures) = measure::measure(&mut entries, measure::library_unit(&angles));
    let figures: Vec<_> = figures.iter().map(measure::Figure::json).collect();
    println!("{}", json!({"unit_ns": unit, "figures": figures}));
    Ok(())
}

fn read(name: &str) -> Result<Description> {
    catalogue::robot(name).context("a robot of the catalogue")
}

/// The values of a program's parameters.
fn values(d: &Description, program: &Program) -> Vec<f64> {
    d.values(program.parameters()).expect("the catalogue gives all lengths")
}

fn compiled(d: &Description, program: &Program) -> Function {
    program.compile(&values(d, program))
}

pub(crate) fn entry<'a>(
    group: &'static str,
    name: impl Into<String>,
    items: usize,
    limit: Option<f64>,
    run: impl FnMut() + 'a,
) -> Entry<'a> {
    Entry { group, name: name.into(), items, limit, run: Box::new(run) }
}

/// Somebody's way to a pose.
type Pose = Box<dyn FnMut(&[f64; 6])>;

/// A pose of a UR5 by everybody.
fn one_configuration<'a>(
    ur5: &Description,
    pose: &Function,
    configurations: &'a [[f64; 6]],
) -> Result<Vec<Entry<'a>>> {
    let group = "one configuration";
    let count = configurations.len();
    let robot = Robot::numeric(ur5)?;
    let (k, plain) = (peers::KChain::new(&robot, &[])?, peers::PlainNalgebra::new(&robot));
    let expected = robot.pose(&configurations[0]).translation.0;
    for found in [
        k.pose(&configurations[0]).translation.vector.data.0[0],
        plain.pose(&configurations[0]).translation.vector.data.0[0],
    ] {
        let error = expected.iter().zip(found).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        anyhow::ensure!(error < 1e-12, "a peer computes another pose: {found:?}, not {expected:?}");
    }
    // The arm of the peer's own parameters: a spherical wrist, six sines as well.
    let opw = OPWKinematics::new(Parameters::irb2400_10());
    let mut scalar = pose.scalar();
    let machine = MachineCode::compile(pose).map_err(|e| anyhow::anyhow!("{e}"))?;
    let mut results = [0.0; 16];
    let each = move |name: &str, limit, mut f: Pose| {
        entry(group, name, count, limit, move || configurations.iter().for_each(|q| f(black_box(q))))
    };
    Ok(vec![
        each(
            "plain product of 4×4 matrices, f64 (the oracle)",
            None,
            Box::new(move |q| {
                black_box(robot.pose(q));
            }),
        ),
        each(
            "nalgebra 0.34, product of isometries",
            None,
            Box::new(move |q| {
                black_box(plain.pose(q));
            }),
        ),
        each(
            "k 0.32",
            None,
            Box::new(move |q| {
                black_box(k.pose(q));
            }),
        ),
        each(
            "rs-opw-kinematics 3.0 (an IRB 2400)",
            None,
            Box::new(move |q| {
                black_box(opw.forward(q));
            }),
        ),
        each(
            "interpreter",
            Some(1.25),
            Box::new(move |q| {
                black_box(scalar.eval(q));
            }),
        ),
        each(
            "machine code (JIT)",
            Some(0.65),
            Box::new(move |q| {
                machine.eval(q, black_box(&mut results));
            }),
        ),
    ])
}

/// A block that stays in the first-level cache.
fn block<T: Real>(
    group: &'static str,
    name: String,
    function: &Function,
    limit: Option<f64>,
) -> Entry<'static> {
    const RUNS: usize = 64;
    let mut block: Block<T> = function.block();
    let lanes = block.lanes();
    for j in 0..function.code().variables {
        for (i, x) in block.variable(j).iter_mut().enumerate() {
            *x = T::from_f64(0.1 * (i as f64 - 30.0) + j as f64);
        }
    }
    entry(group, name, RUNS * lanes, limit, move || {
        for _ in 0..RUNS {
            black_box(&mut block).run();
        }
    })
}

/// From a derived program to something that runs.
fn compilation<'a>(d: &Description, program: &Program, pose: &Function) -> Vec<Entry<'a>> {
    let (program, parameters, pose) = (program.clone(), values(d, program), pose.clone());
    let group = "compilation";
    vec![
        entry(group, "a program for the interpreters", 1, None, move || {
            black_box(program.compile(&parameters));
        }),
        entry(group, "machine code (JIT)", 1, None, move || {
            black_box(MachineCode::compile(&pose)).ok();
        }),
    ]
}
