//! What the library itself takes for what `bench/python/bench.py` measures: seconds, as one JSON object.
//!
//! Poses of 10⁶ configurations of a UR5, one configuration, all solutions of poses.

use denavit::description::{Described, read_robot};
use denavit::forward::pose_program;
use denavit::inverse::{Goal, InverseKinematics, InverseOptions};
use std::hint::black_box;
use std::num::NonZero;
use std::time::Instant;

/// Configurations, and poses that are solved.
const ROWS: usize = 1_000_000;
const POSES: usize = 10_000;

/// The shortest time of five.
fn best(mut work: impl FnMut()) -> f64 {
    let mut once = || {
        let start = Instant::now();
        work();
        start.elapsed().as_secs_f64()
    };
    (0..5).map(|_| once()).fold(f64::INFINITY, f64::min)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let text = denavit::catalogue::text("ur5").ok_or("no UR5")?;
    let (described, _) = read_robot(text).map_err(|_| "no robot")?;
    let Described::Chain(d) = described else { return Err("no chain".into()) };
    let function = pose_program(&d).compile_with(|s| d.value(s))?;
    let mut state = 1_u64;
    let mut angle = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64 * 6.0 - 3.0
    };
    let rows: Vec<f64> = (0..6 * ROWS).map(|_| angle()).collect();
    let mut poses = vec![0.0; 16 * ROWS];
    let one_core = NonZero::new(1);
    let fk_one_core = best(|| function.batch::<f64>().run_parallel(one_core, &rows, &mut poses));
    let fk = best(|| function.batch::<f64>().run_parallel(None, &rows, &mut poses));
    let mut scalar = function.scalar();
    let single = best(|| rows[..60_000].chunks(6).for_each(|q| drop(black_box(scalar.eval(q).to_vec()))));
    let solver = InverseKinematics::new(&d, &InverseOptions { goal: Goal::Pose, given: None })?;
    let goals: Vec<_> = rows.chunks(6).take(POSES).map(|q| solver.robot.pose(q)).collect();
    let one = NonZero::<usize>::MIN;
    let ik_one_core = best(|| drop(black_box(solver.solve_all(&goals, &[], one))));
    println!(
        "{}",
        serde_json::json!({
            "fk": fk / ROWS as f64,
            "fk_one_core": fk_one_core / ROWS as f64,
            "fk_single": single / 10_000.0,
            "ik_one_core": ik_one_core / POSES as f64,
        })
    );
    Ok(())
}
