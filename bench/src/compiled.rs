//! Generated source code, compiled beforehand: Rust, and C by two compilers in two precisions.

use crate::entry;
use crate::measure::Entry;
use std::hint::black_box;
use ur5_generated as rust;

/// What everything is compiled for.
pub const LEVEL: &str = env!("DENAVIT_BENCH_LEVEL");
const LANES: usize = rust::LANES;
/// Runs over one block that stays in the cache.
const RUNS: usize = 64;

/// As in the header of the generated file.
#[repr(C)]
#[derive(Clone, Copy)]
struct Parameters<T>([T; 6]);

/// A block of values, aligned as the generated header asks.
#[repr(align(64))]
struct Block<T, const N: usize>([[T; LANES]; N]);

macro_rules! c {
    ($number:ty: $fk_gcc:ident, $block_gcc:ident, $defaults_gcc:ident, $fk_clang:ident, $block_clang:ident, $defaults_clang:ident) => {
        unsafe extern "C" {
            fn $fk_gcc(q: *const $number, parameters: *const Parameters<$number>, pose: *mut $number);
            fn $block_gcc(q: *const $number, parameters: *const Parameters<$number>, pose: *mut $number);
            static $defaults_gcc: Parameters<$number>;
            fn $fk_clang(q: *const $number, parameters: *const Parameters<$number>, pose: *mut $number);
            fn $block_clang(q: *const $number, parameters: *const Parameters<$number>, pose: *mut $number);
            static $defaults_clang: Parameters<$number>;
        }
    };
}
c!(f64: ur5_fk_gcc, ur5_fk_block_gcc, ur5_defaults_gcc, ur5_fk_clang, ur5_fk_block_clang, ur5_defaults_clang);
c!(f32: ur5f_fk_gcc, ur5f_fk_block_gcc, ur5f_defaults_gcc, ur5f_fk_clang, ur5f_fk_block_clang, ur5f_defaults_clang);

type Function<T> = unsafe extern "C" fn(*const T, *const Parameters<T>, *mut T);

/// (compiler, one configuration, block, parameters)
#[allow(unsafe_code)]
fn double() -> [(&'static str, Function<f64>, Function<f64>, Parameters<f64>); 2] {
    // SAFETY: constants of the generated files.
    let defaults = unsafe { (ur5_defaults_gcc, ur5_defaults_clang) };
    [("gcc", ur5_fk_gcc, ur5_fk_block_gcc, defaults.0), ("clang", ur5_fk_clang, ur5_fk_block_clang, defaults.1)]
}

#[allow(unsafe_code)]
fn single() -> [(&'static str, Function<f32>, Function<f32>, Parameters<f32>); 2] {
    // SAFETY: constants of the generated files.
    let defaults = unsafe { (ur5f_defaults_gcc, ur5f_defaults_clang) };
    [("gcc", ur5f_fk_gcc, ur5f_fk_block_gcc, defaults.0), ("clang", ur5f_fk_clang, ur5f_fk_block_clang, defaults.1)]
}

/// One configuration at a time.
#[allow(unsafe_code)]
pub fn one_configuration(configurations: &[[f64; 6]]) -> Vec<Entry<'_>> {
    let group = "one configuration";
    let count = configurations.len();
    let run = move || {
        for q in configurations {
            black_box(rust::fk(black_box(q), &rust::Parameters::default()));
        }
    };
    let mut entries = vec![entry(group, "generated Rust", count, Some(0.5), run)];
    for (compiler, fk, _, parameters) in double() {
        let mut pose = [0.0; 16];
        let run = move || {
            for q in configurations {
                // SAFETY: six variables, six parameters and sixteen results, as the header says.
                unsafe { fk(black_box(q).as_ptr(), &parameters, pose.as_mut_ptr()) };
                black_box(&pose);
            }
        };
        entries.push(entry(group, format!("generated C, {compiler}"), count, Some(0.6), run));
    }
    entries
}

/// Blocks that stay in the cache.
#[allow(unsafe_code)]
pub fn batch(configurations: &[[f64; 6]]) -> Vec<Entry<'_>> {
    let group = "batch";
    let wide = LEVEL == "x86-64-v4";
    let mut q = Block([[0.0; LANES]; 6]);
    for (i, row) in configurations.iter().take(LANES).enumerate() {
        (0..6).for_each(|j| q.0[j][i] = row[j]);
    }
    let q32 = Block(q.0.map(|row| row.map(|x| x as f32)));
    let limit = Some(if wide { 0.15 } else { 0.22 });
    let mut entries = vec![];
    let (q_rust, mut out) = (Block(q.0), Block([[0.0; LANES]; 16]));
    let run = move || {
        for _ in 0..RUNS {
            rust::fk_block(black_box(&q_rust.0), &rust::Parameters::default(), &mut out.0);
            black_box(&out.0);
        }
    };
    entries.push(entry(group, "generated Rust, blocks, f64", RUNS * LANES, limit, run));
    for (compiler, _, block, parameters) in double() {
        let (q, mut out) = (Block(q.0), Block([[0.0; LANES]; 16]));
        let run = move || {
            for _ in 0..RUNS {
                // SAFETY: blocks of six variables and sixteen results, as the header says.
                unsafe { block(black_box(&q.0).as_ptr().cast(), &parameters, out.0.as_mut_ptr().cast()) };
                black_box(&out.0);
            }
        };
        entries.push(entry(group, format!("generated C, {compiler}, blocks, f64"), RUNS * LANES, limit, run));
    }
    let limit = Some(if wide { 0.055 } else { 0.075 });
    for (compiler, _, block, parameters) in single() {
        let (q, mut out) = (Block(q32.0), Block([[0.0_f32; LANES]; 16]));
        let run = move || {
            for _ in 0..RUNS {
                // SAFETY: as above.
                unsafe { block(black_box(&q.0).as_ptr().cast(), &parameters, out.0.as_mut_ptr().cast()) };
                black_box(&out.0);
            }
        };
        entries.push(entry(group, format!("generated C, {compiler}, blocks, f32"), RUNS * LANES, limit, run));
    }
    entries
}
