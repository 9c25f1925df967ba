//! Measures the solver on arms of many kinds: times, splits used, missed and certified poses.
//!
//! `cargo run -p denavit-elimination --release --example measure [poses] [arm]`

#[path = "../tests/suite/arms/mod.rs"]
mod arms;

use arms::{Draws, named};
use denavit_elimination::{Answer, Certificate, Joint, Plan};
use std::time::Instant;

fn main() {
    let mut arguments = std::env::args().skip(1);
    let poses: usize = arguments.next().and_then(|x| x.parse().ok()).unwrap_or(4000);
    let only = arguments.next().unwrap_or_default();
    println!(
        "{:26} {:>6} {:>6} {:>7} {:>6} {:>6} {:>6} {:>8}  {:>9} {:>7} {:>7}",
        "arm", "plan", "solut.", "splits", "mean", "p50", "p99", "missed", "fallback", "certif.", "odd"
    );
    for (name, arm) in named() {
        if !name.contains(&only) {
            continue;
        }
        let start = Instant::now();
        let plan = match Plan::new(&arm) {
            Ok(plan) => plan,
            Err(error) => {
                println!("{name:26} {error}");
                continue;
            }
        };
        let build = start.elapsed().as_secs_f64() * 1e3;
        let (mut draws, mut answer) = (Draws(77), Answer::default());
        let mut times = vec![];
        let (mut missed, mut fallback, mut certified, mut odd, mut solutions, mut splits) =
            (0, 0, 0, 0, 0, 0u64);
        for _ in 0..poses {
            let q = draws.configuration(&arm);
            let pose = arm.pose(&q);
            let mut best = f64::INFINITY;
            for _ in 0..if poses > 20_000 { 1 } else { 3 } {
                let start = Instant::now();
                plan.solve(&pose, &mut answer);
                best = best.min(start.elapsed().as_secs_f64() * 1e6);
            }
            times.push(best);
            solutions += answer.solutions.len();
            splits += u64::from(answer.splits);
            fallback += usize::from(answer.splits > 1);
            certified += usize::from(answer.certificate == Certificate::Complete);
            odd += answer.solutions.len() % 2;
            let size = arm.size();
            missed += usize::from(!answer.solutions.iter().any(|solution| {
                (0..6).all(|i| match arm.joints[i] {
                    Joint::Revolute => ((solution.q[i] - q[i]) / 2.0).sin().abs() < 1e-5,
                    Joint::Prismatic => (solution.q[i] - q[i]).abs() < 1e-5 * size,
                })
            }));
        }
        times.sort_by(f64::total_cmp);
        let n = poses as f64;
        println!(
            "{:26} {:6.0} {:6.2} {:7.3} {:6.1} {:6.1} {:6.1} {:8}  {:8.3}% {:6.2}% {:7}  {:?}",
            name,
            build,
            solutions as f64 / n,
            splits as f64 / n,
            times.iter().sum::<f64>() / n,
            times[poses / 2],
            times[poses * 99 / 100],
            missed,
            100.0 * fallback as f64 / n,
            100.0 * certified as f64 / n,
            odd,
            plan.hidden()
        );
    }
}
