//! Generated source code, compiled beforehand for two levels of instructions: Rust, and C by two compilers in two
//! precisions.

pub mod inverse;

// Modules that use a macro stand behind it.
macro_rules! c {
    ($number:ty, $compiler:literal, $level:literal, $one:ident, $block:ident, $defaults:ident) => {{
        unsafe extern "C" {
            fn $one(q: *const $number, parameters: *const c_void, results: *mut $number);
            fn $block(q: *const $number, parameters: *const c_void, results: *mut $number);
            static $defaults: c_void;
        }
        let parameters = &raw const $defaults;
        C { compiler: $compiler, level: $level, one: $one, block: $block, parameters }
    }};
}

pub mod jacobian;

use crate::entry;
use crate::measure::Entry;
use std::ffi::c_void;
use std::hint::black_box;

const LANES: usize = ur5_v3::LANES;
/// Configurations of a block of C with all frames of a Panda: its results are too many for more to stay in the first cache.
const PANDA_LANES: usize = lanes(env!("PANDA_LANES"));
const _: () = assert!(lanes(env!("UR5_LANES")) == LANES && lanes(env!("UR5F_LANES")) == LANES);
const _: () = assert!(lanes(env!("UR5J_LANES")) == LANES && lanes(env!("PANDAJ_LANES")) == LANES);
/// Runs over one block that stays in the cache.
const RUNS: usize = 64;

/// A block of values, aligned as the generated header asks.
#[derive(Clone, Copy)]
#[repr(align(64))]
struct Block<T, const N: usize, const L: usize = LANES>([[T; L]; N]);

/// What `build.rs` read in a header.
const fn lanes(text: &str) -> usize {
    match usize::from_str_radix(text, 10) {
        Ok(lanes) => lanes,
        Err(_) => panic!("a header says its lanes"),
    }
}

/// Variables, parameters, results, as the generated header says.
type Function<T> = unsafe extern "C" fn(*const T, *const c_void, *mut T);

/// What a compiler made of a generated C file.
#[derive(Clone, Copy)]
struct C<T> {
    compiler: &'static str,
    level: &'static str,
    one: Function<T>,
    block: Function<T>,
    parameters: *const c_void,
}

fn ur5() -> [C<f64>; 4] {
    [
        c!(f64, "gcc", "v3", ur5_gcc_v3_fk, ur5_gcc_v3_fk_block, ur5_gcc_v3_defaults),
        c!(f64, "clang", "v3", ur5_clang_v3_fk, ur5_clang_v3_fk_block, ur5_clang_v3_defaults),
        c!(f64, "gcc", "v4", ur5_gcc_v4_fk, ur5_gcc_v4_fk_block, ur5_gcc_v4_defaults),
        c!(f64, "clang", "v4", ur5_clang_v4_fk, ur5_clang_v4_fk_block, ur5_clang_v4_defaults),
    ]
}

fn ur5_single() -> [C<f32>; 4] {
    [
        c!(f32, "gcc", "v3", ur5f_gcc_v3_fk, ur5f_gcc_v3_fk_block, ur5f_gcc_v3_defaults),
        c!(f32, "clang", "v3", ur5f_clang_v3_fk, ur5f_clang_v3_fk_block, ur5f_clang_v3_defaults),
        c!(f32, "gcc", "v4", ur5f_gcc_v4_fk, ur5f_gcc_v4_fk_block, ur5f_gcc_v4_defaults),
        c!(f32, "clang", "v4", ur5f_clang_v4_fk, ur5f_clang_v4_fk_block, ur5f_clang_v4_defaults),
    ]
}

fn panda() -> [C<f64>; 4] {
    [
        c!(f64, "gcc", "v3", panda_gcc_v3_frames, panda_gcc_v3_frames_block, panda_gcc_v3_defaults),
        c!(f64, "clang", "v3", panda_clang_v3_frames, panda_clang_v3_frames_block, panda_clang_v3_defaults),
        c!(f64, "gcc", "v4", panda_gcc_v4_frames, panda_gcc_v4_frames_block, panda_gcc_v4_defaults),
        c!(f64, "clang", "v4", panda_clang_v4_frames, panda_clang_v4_frames_block, panda_clang_v4_defaults),
    ]
}

/// Whether this processor runs code of a level.
fn runs(level: &str) -> bool {
    #[cfg(target_arch = "x86_64")]
    if level == "v4" {
        return std::is_x86_feature_detected!("avx512f")
            && std::is_x86_feature_detected!("avx512bw")
            && std::is_x86_feature_detected!("avx512cd")
            && std::is_x86_feature_detected!("avx512dq")
            && std::is_x86_feature_detected!("avx512vl");
    }
    level == "v3"
}

fn name(what: &str, level: &str) -> String {
    let instructions = if level == "v4" { "AVX-512" } else { "AVX2" };
    format!("{what}, {instructions}")
}

/// One configuration at a time.
#[allow(unsafe_code)]
pub fn one_configuration(configurations: &[[f64; 6]]) -> Vec<Entry<'_>> {
    let group = "one configuration";
    let count = configurations.len();
    let mut entries = vec![entry(group, name("generated Rust", "v3"), count, Some(0.5), move || {
        for q in configurations {
            black_box(ur5_v3::fk(black_box(q), &ur5_v3::Parameters::default()));
        }
    })];
    if runs("v4") {
        entries.push(entry(group, name("generated Rust", "v4"), count, Some(0.5), move || {
            for q in configurations {
                black_box(ur5_v4::fk(black_box(q), &ur5_v4::Parameters::default()));
            }
        }));
    }
    for c in ur5().into_iter().filter(|c| runs(c.level)) {
        let mut pose = [0.0; 16];
        let run = move || {
            for q in configurations {
                // SAFETY: six variables, six parameters and sixteen results, as the header says.
                unsafe { (c.one)(black_box(q).as_ptr(), c.parameters, pose.as_mut_ptr()) };
                black_box(&pose);
            }
        };
        let what = format!("generated C, {}", c.compiler);
        entries.push(entry(group, name(&what, c.level), count, Some(0.6), run));
    }
    entries
}

/// Blocks that stay in the cache.
pub fn batch(configurations: &[[f64; 6]]) -> Vec<Entry<'_>> {
    let group = "batch";
    let limit = |level: &str, limits: [f64; 2]| Some(limits[usize::from(level == "v4")]);
    let mut q = Block([[0.0; LANES]; 6]);
    for (i, row) in configurations.iter().take(LANES).enumerate() {
        (0..6).for_each(|j| q.0[j][i] = row[j]);
    }
    let mut entries = vec![];
    let mut out = Block([[0.0; LANES]; 16]);
    let run = move || {
        for _ in 0..RUNS {
            ur5_v3::fk_block(black_box(&q.0), &ur5_v3::Parameters::default(), &mut out.0);
            black_box(&out.0);
        }
    };
    let double_limits = [0.22, 0.15];
    let what = "generated Rust, blocks, f64";
    entries.push(entry(group, name(what, "v3"), RUNS * LANES, limit("v3", double_limits), run));
    if runs("v4") {
        let run = move || {
            for _ in 0..RUNS {
                ur5_v4::fk_block(black_box(&q.0), &ur5_v4::Parameters::default(), &mut out.0);
                black_box(&out.0);
            }
        };
        entries.push(entry(group, name(what, "v4"), RUNS * LANES, limit("v4", double_limits), run));
    }
    for c in ur5().into_iter().filter(|c| runs(c.level)) {
        let what = name(&format!("generated C, {}, blocks, f64", c.compiler), c.level);
        entries.push(entry(
            group,
            what,
            RUNS * LANES,
            limit(c.level, double_limits),
            blocks::<_, 6, 16, LANES>(c, q),
        ));
    }
    let q7 = Block([q.0[0], q.0[1], q.0[2], q.0[3], q.0[4], q.0[5], q.0[0]]);
    entries.extend(frames(q7));
    let q = Block(q.0.map(|row| row.map(|x| x as f32)));
    for c in ur5_single().into_iter().filter(|c| runs(c.level)) {
        let what = name(&format!("generated C, {}, blocks, f32", c.compiler), c.level);
        entries.push(entry(
            group,
            what,
            RUNS * LANES,
            limit(c.level, [0.075, 0.055]),
            blocks::<_, 6, 16, LANES>(c, q),
        ));
    }
    entries
}

/// All link frames of a Panda: nine matrices.
fn frames(q: Block<f64, 7>) -> Vec<Entry<'static>> {
    const RESULTS: usize = 9 * 16;
    let limit = Some(0.35);
    let what = "generated Rust, blocks, all link frames of a Panda";
    let mut out = Box::new(Block([[0.0; LANES]; RESULTS]));
    let run = move || {
        for _ in 0..RUNS {
            panda_v3::frames_block(black_box(&q.0), &panda_v3::Parameters::default(), &mut out.0);
            black_box(&out.0);
        }
    };
    let mut entries = vec![entry("batch", name(what, "v3"), RUNS * LANES, limit, run)];
    if runs("v4") {
        let mut out = Box::new(Block([[0.0; LANES]; RESULTS]));
        let run = move || {
            for _ in 0..RUNS {
                panda_v4::frames_block(black_box(&q.0), &panda_v4::Parameters::default(), &mut out.0);
                black_box(&out.0);
            }
        };
        entries.push(entry("batch", name(what, "v4"), RUNS * LANES, limit, run));
    }
    let q: Block<f64, 7, PANDA_LANES> = Block(q.0.map(|row| std::array::from_fn(|i| row[i])));
    for c in panda().into_iter().filter(|c| runs(c.level)) {
        let what = name(&format!("generated C, {}, blocks, all link frames of a Panda", c.compiler), c.level);
        let count = RUNS * PANDA_LANES;
        entries.push(entry("batch", what, count, limit, blocks::<_, 7, RESULTS, PANDA_LANES>(c, q)));
    }
    entries
}

/// Runs a C function over one block, again and again; `M` results each.
#[allow(unsafe_code)]
fn blocks<T: Copy + Default + 'static, const J: usize, const M: usize, const L: usize>(
    c: C<T>,
    q: Block<T, J, L>,
) -> impl FnMut() + 'static {
    let mut out = Box::new(Block([[T::default(); L]; M]));
    move || {
        for _ in 0..RUNS {
            // SAFETY: blocks of J variables and M results, as the header says.
            unsafe { (c.block)(black_box(&q.0).as_ptr().cast(), c.parameters, out.0.as_mut_ptr().cast()) };
            black_box(&out.0);
        }
    }
}
