//! Jacobian and pose in one pass: generated Rust and C.

use super::{Block, C, LANES, RUNS, blocks, name, runs};
use crate::entry;
use crate::measure::Entry;
use std::ffi::c_void;
use std::hint::black_box;

/// The most that one configuration may take, U.
pub const LIMIT: f64 = 1.1;
/// The most that a configuration in a batch may take with AVX-512, U.
pub const BATCH_LIMIT: f64 = 0.25;

/// Results: the Jacobian of six or seven joints, and a pose.
const UR5: usize = 6 * 6 + 16;
const PANDA: usize = 6 * 7 + 16;

/// One configuration of the generated Rust of an arm at a level.
macro_rules! one {
    ($package:ident, $arm:literal, $level:literal, $group:expr, $configurations:expr) => {{
        let configurations = $configurations;
        let run = move || {
            for q in configurations {
                black_box($package::jacobian_fk(black_box(q), &$package::Parameters::default()));
            }
        };
        let what = concat!("generated Rust, ", $arm);
        entry($group, name(what, $level), configurations.len(), Some(LIMIT), run)
    }};
}

/// Blocks of the generated Rust of an arm at a level.
macro_rules! block {
    ($package:ident, $arm:literal, $level:literal, $group:expr, $results:expr) => {{
        let (q, mut out) = (angles(), Box::new(Block([[0.0; LANES]; $results])));
        let run = move || {
            for _ in 0..RUNS {
                $package::jacobian_fk_block(black_box(&q.0), &$package::Parameters::default(), &mut out.0);
                black_box(&out.0);
            }
        };
        let what = concat!("generated Rust, blocks, ", $arm);
        entry($group, name(what, $level), RUNS * LANES, limit($level), run)
    }};
}

/// Generated C by both compilers at both levels.
fn ur5_c() -> [C<f64>; 4] {
    [
        c!(f64, "gcc", "v3", ur5j_gcc_v3_jacobian_fk, ur5j_gcc_v3_jacobian_fk_block, ur5j_gcc_v3_defaults),
        c!(
            f64,
            "clang",
            "v3",
            ur5j_clang_v3_jacobian_fk,
            ur5j_clang_v3_jacobian_fk_block,
            ur5j_clang_v3_defaults
        ),
        c!(f64, "gcc", "v4", ur5j_gcc_v4_jacobian_fk, ur5j_gcc_v4_jacobian_fk_block, ur5j_gcc_v4_defaults),
        c!(
            f64,
            "clang",
            "v4",
            ur5j_clang_v4_jacobian_fk,
            ur5j_clang_v4_jacobian_fk_block,
            ur5j_clang_v4_defaults
        ),
    ]
}

fn panda_c() -> [C<f64>; 4] {
    [
        c!(
            f64,
            "gcc",
            "v3",
            pandaj_gcc_v3_jacobian_fk,
            pandaj_gcc_v3_jacobian_fk_block,
            pandaj_gcc_v3_defaults
        ),
        c!(
            f64,
            "clang",
            "v3",
            pandaj_clang_v3_jacobian_fk,
            pandaj_clang_v3_jacobian_fk_block,
            pandaj_clang_v3_defaults
        ),
        c!(
            f64,
            "gcc",
            "v4",
            pandaj_gcc_v4_jacobian_fk,
            pandaj_gcc_v4_jacobian_fk_block,
            pandaj_gcc_v4_defaults
        ),
        c!(
            f64,
            "clang",
            "v4",
            pandaj_clang_v4_jacobian_fk,
            pandaj_clang_v4_jacobian_fk_block,
            pandaj_clang_v4_defaults
        ),
    ]
}

/// One configuration of a UR5 at a time.
pub fn ur5<'a>(group: &'static str, configurations: &'a [[f64; 6]]) -> Vec<Entry<'a>> {
    let mut entries = vec![one!(ur5j_v3, "UR5", "v3", group, configurations)];
    if runs("v4") {
        entries.push(one!(ur5j_v4, "UR5", "v4", group, configurations));
    }
    entries.extend(one_by_c::<6, UR5>(group, "UR5", ur5_c(), configurations));
    entries
}

/// One configuration of a Panda at a time.
pub fn panda<'a>(group: &'static str, configurations: &'a [[f64; 7]]) -> Vec<Entry<'a>> {
    let mut entries = vec![one!(pandaj_v3, "Panda", "v3", group, configurations)];
    if runs("v4") {
        entries.push(one!(pandaj_v4, "Panda", "v4", group, configurations));
    }
    entries.extend(one_by_c::<7, PANDA>(group, "Panda", panda_c(), configurations));
    entries
}

/// Blocks of a UR5 that stay in the cache.
pub fn ur5_blocks(group: &'static str) -> Vec<Entry<'static>> {
    let mut entries = vec![block!(ur5j_v3, "UR5", "v3", group, UR5)];
    if runs("v4") {
        entries.push(block!(ur5j_v4, "UR5", "v4", group, UR5));
    }
    entries.extend(blocks_by_c::<6, UR5>(group, "UR5", ur5_c()));
    entries
}

/// Blocks of a Panda that stay in the cache.
pub fn panda_blocks(group: &'static str) -> Vec<Entry<'static>> {
    let mut entries = vec![block!(pandaj_v3, "Panda", "v3", group, PANDA)];
    if runs("v4") {
        entries.push(block!(pandaj_v4, "Panda", "v4", group, PANDA));
    }
    entries.extend(blocks_by_c::<7, PANDA>(group, "Panda", panda_c()));
    entries
}

/// `M` results of `J` variables.
#[allow(unsafe_code)]
fn one_by_c<'a, const J: usize, const M: usize>(
    group: &'static str,
    arm: &'static str,
    all: [C<f64>; 4],
    configurations: &'a [[f64; J]],
) -> impl Iterator<Item = Entry<'a>> {
    all.into_iter().filter(|c| runs(c.level)).map(move |c| {
        let mut results = [0.0; M];
        let run = move || {
            for q in configurations {
                // SAFETY: J variables and M results, as the header says.
                unsafe { (c.one)(black_box(q).as_ptr(), c.parameters, results.as_mut_ptr()) };
                black_box(&results);
            }
        };
        let what = name(&format!("generated C, {}, {arm}", c.compiler), c.level);
        entry(group, what, configurations.len(), Some(LIMIT), run)
    })
}

fn blocks_by_c<const J: usize, const M: usize>(
    group: &'static str,
    arm: &'static str,
    all: [C<f64>; 4],
) -> impl Iterator<Item = Entry<'static>> {
    all.into_iter().filter(|c| runs(c.level)).map(move |c| {
        let what = name(&format!("generated C, {}, blocks, {arm}", c.compiler), c.level);
        entry(group, what, RUNS * LANES, limit(c.level), blocks::<_, J, M, LANES>(c, angles()))
    })
}

fn limit(level: &str) -> Option<f64> {
    (level == "v4").then_some(BATCH_LIMIT)
}

/// Angles for a block.
fn angles<const J: usize>() -> Block<f64, J> {
    let mut q = Block([[0.0; LANES]; J]);
    for (j, row) in q.0.iter_mut().enumerate() {
        row.iter_mut().enumerate().for_each(|(i, x)| *x = 0.1 * (i as f64 - 30.0) + j as f64);
    }
    q
}
