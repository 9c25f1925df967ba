//! Jacobian and pose in one pass, by every evaluator.

use crate::compiled::jacobian as generated;
use crate::measure::Entry;
use crate::{block, compiled, entry};
use anyhow::Result;
use denavit::velocity::{Viewpoint, geometric, jacobian_and_pose_program};
use denavit::{Description, Robot};
use denavit_jit::MachineCode;
use denavit_program::{Function, Isa};
use std::hint::black_box;

const ONE: &str = "Jacobian and pose, one configuration";
const BATCH: &str = "Jacobian and pose, batch";

/// A UR5's and a Panda's; the angles of a Panda are those of a UR5 taken seven at a time.
pub fn entries<'a>(ur5: &Description, panda: &Description, angles: &'a [f64]) -> Result<Vec<Entry<'a>>> {
    let (six, seven): (&[[f64; 6]], &[[f64; 7]]) = (angles.as_chunks().0, angles.as_chunks().0);
    let function = |d: &Description| compiled(d, &jacobian_and_pose_program(d, &Viewpoint::tool()));
    let (of_ur5, of_panda) = (function(ur5), function(panda));
    let mut entries = vec![];
    entries.extend(evaluated("UR5", ur5, &of_ur5, six)?);
    entries.extend(generated::ur5(ONE, six));
    entries.extend(evaluated("Panda", panda, &of_panda, seven)?);
    entries.extend(generated::panda(ONE, seven));
    entries.extend(blocks("UR5", &of_ur5, Some(generated::BATCH_LIMIT)));
    entries.extend(generated::ur5_blocks(BATCH));
    entries.extend(blocks("Panda", &of_panda, None));
    entries.extend(generated::panda_blocks(BATCH));
    Ok(entries)
}

/// One configuration at a time.
fn evaluated<'a, const J: usize>(
    arm: &str,
    d: &Description,
    function: &Function,
    configurations: &'a [[f64; J]],
) -> Result<[Entry<'a>; 3]> {
    let robot = Robot::numeric(d)?;
    let mut scalar = function.scalar();
    let machine = MachineCode::compile(function).map_err(|e| anyhow::anyhow!("{e}"))?;
    let mut results = vec![0.0; 6 * J + 16];
    let count = configurations.len();
    let each = move |name: &str, limit, mut f: Box<dyn FnMut(&[f64; J])>| {
        let run = move || configurations.iter().for_each(|q| f(black_box(q)));
        entry(ONE, format!("{name}, {arm}"), count, limit, run)
    };
    Ok([
        each(
            "product of 4×4 matrices and cross products, f64 (the oracle)",
            None,
            Box::new(move |q| {
                black_box((robot.pose(q), geometric(&robot, q, &Viewpoint::tool())));
            }),
        ),
        each(
            "interpreter",
            None,
            Box::new(move |q| {
                black_box(scalar.eval(q));
            }),
        ),
        each(
            "machine code (JIT)",
            Some(generated::LIMIT),
            Box::new(move |q| machine.eval(q, black_box(&mut results))),
        ),
    ])
}

/// Blocks that stay in the cache; the limit is that with AVX-512.
fn blocks(arm: &str, function: &Function, limit: Option<f64>) -> Vec<Entry<'static>> {
    let on = |isa: Isa| {
        let name = format!("interpreter over blocks, {arm}, {}", isa.name());
        let limit = limit.filter(|_| isa.name() == "AVX-512");
        block::<f64>(BATCH, name, &function.on(isa, isa.arithmetic()), limit)
    };
    Isa::available().into_iter().map(on).collect()
}
