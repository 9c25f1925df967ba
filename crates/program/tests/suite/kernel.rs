//! The kernels against reference values of 420 digits (`kernel/vectors.py`), and the promises of their module.

use denavit_program::kernel::*;

const VECTORS: &str = include_str!("../kernel/vectors.csv");

/// An error in units of the last place of `near`, where `exact` = near + `lacks` of these.
fn ulps(got: f64, near: f64, ulp: f64, lacks: f64) -> f64 {
    ((got - near) / ulp - lacks).abs()
}

fn ulp(near: f64) -> f64 {
    near.abs().next_up() - near.abs()
}

fn ulp_f32(near: f32) -> f64 {
    f64::from(near.abs().next_up()) - f64::from(near.abs())
}

fn double(hex: &str) -> f64 {
    f64::from_bits(u64::from_str_radix(hex, 16).unwrap())
}

fn single(hex: &str) -> f32 {
    f32::from_bits(u32::from_str_radix(hex, 16).unwrap())
}

/// The columns of the rows of a kind.
fn rows(kind: &str) -> impl Iterator<Item = Vec<&'static str>> {
    VECTORS.lines().filter_map(move |l| Some(l.strip_prefix(kind)?.strip_prefix(',')?.split(',').collect()))
}

/// Largest errors of sine and cosine over the stored arguments.
fn worst_sin_cos(f: impl Fn(f64) -> (f64, f64)) -> (f64, f64) {
    rows("sin_cos").fold((0.0, 0.0), |worst: (f64, f64), row| {
        let (s, c) = f(double(row[0]));
        let error = |got: f64, at: usize| {
            let near = double(row[at]);
            ulps(got, near, ulp(near), row[at + 1].parse().unwrap())
        };
        assert!(s.is_finite() && c.is_finite(), "{row:?}");
        (worst.0.max(error(s, 1)), worst.1.max(error(c, 3)))
    })
}

fn worst_sin_cos_f32(f: impl Fn(f32) -> (f32, f32)) -> (f64, f64) {
    rows("sin_cos_f32").fold((0.0, 0.0), |worst: (f64, f64), row| {
        let (s, c) = f(single(row[0]));
        let error = |got: f32, at: usize| {
            let near = single(row[at]);
            ulps(f64::from(got), f64::from(near), ulp_f32(near), row[at + 1].parse().unwrap())
        };
        assert!(s.is_finite() && c.is_finite(), "{row:?}");
        (worst.0.max(error(s, 1)), worst.1.max(error(c, 3)))
    })
}

fn worst_atan2(f: impl Fn(f64, f64) -> f64) -> f64 {
    rows("atan2").fold(0.0, |worst: f64, row| {
        let angle = f(double(row[0]), double(row[1]));
        assert!(angle.is_finite(), "{row:?}");
        let near = double(row[2]);
        worst.max(ulps(angle, near, ulp(near), row[3].parse().unwrap()))
    })
}

fn worst_atan2_f32(f: impl Fn(f32, f32) -> f32) -> f64 {
    rows("atan2_f32").fold(0.0, |worst: f64, row| {
        let angle = f(single(row[0]), single(row[1]));
        assert!(angle.is_finite(), "{row:?}");
        let near = single(row[2]);
        worst.max(ulps(f64::from(angle), f64::from(near), ulp_f32(near), row[3].parse().unwrap()))
    })
}

#[test]
fn errors_are_within_their_bounds() {
    for (s, c) in
        [worst_sin_cos(sin_cos::<true>), worst_sin_cos(sin_cos::<false>), worst_sin_cos(sin_cos_huge)]
    {
        assert!(s <= 0.78 && c <= 0.78, "sine {s}, cosine {c}");
    }
    for (s, c) in [worst_sin_cos_f32(sin_cos_f32::<true>), worst_sin_cos_f32(sin_cos_f32::<false>)] {
        assert!(s <= 0.8 && c <= 0.8, "sine {s}, cosine {c}, in single precision");
    }
    for e in [worst_atan2(atan2::<true>), worst_atan2(atan2::<false>)] {
        assert!(e <= 1.6, "atan2 {e}");
    }
    for e in [worst_atan2_f32(atan2_f32::<true>), worst_atan2_f32(atan2_f32::<false>)] {
        assert!(e <= 1.6, "atan2 {e}, in single precision");
    }
}

/// No double is closer to a multiple of π/2: its cosine is -4.68716592425462761112e-19 (Muller, Elementary
/// Functions, 3rd ed., ch. 11).
#[test]
fn the_hardest_argument_keeps_all_its_digits() {
    let x = 6381956970095103.0 * 2.0_f64.powi(797);
    let (n, r, lo) = reduce_huge(x);
    assert_eq!((n, r), (1, 4.687165924254628e-19));
    assert!((lo / -4.37205574e-36 - 1.0).abs() < 1e-6); // mpmath
    assert_eq!(sin_cos_huge(x), (1.0, -4.687165924254628e-19));
}

/// Equal bits, or both not numbers.
fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
}

fn special_angles<const FUSED: bool>() {
    let inf = f64::INFINITY;
    for x in [inf, -inf, f64::NAN, -f64::NAN] {
        let ((s, c), (s_f32, c_f32)) = (sin_cos::<FUSED>(x), sin_cos_f32::<FUSED>(x as f32));
        assert!(s.is_nan() && c.is_nan() && s_f32.is_nan() && c_f32.is_nan(), "{x}");
    }
    let tiny = f64::from_bits(1);
    for x in [0.0, tiny, f64::MIN_POSITIVE, 1e-200] {
        for x in [x, -x] {
            let (s, c) = sin_cos::<FUSED>(x);
            assert!(same(s, x) && same(c, 1.0), "{x}");
            let (s, c) = sin_cos_f32::<FUSED>(x as f32);
            assert!(s.to_bits() == (x as f32).to_bits() && c == 1.0, "{x}");
        }
    }
}

#[test]
fn sines_of_zeros_infinities_and_tiny_numbers() {
    special_angles::<true>();
    special_angles::<false>();
}

/// ISO/IEC 9899:2018, F.10.1.4; every value is the double nearest to the angle.
fn special_points<const FUSED: bool>() {
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};
    let (inf, tiny, huge, three) = (f64::INFINITY, f64::from_bits(1), f64::MAX, 2.356194490192345);
    #[rustfmt::skip]
    let cases = [
        (0.0, 0.0, 0.0), (0.0, -0.0, PI), (0.0, 3.0, 0.0), (0.0, -3.0, PI), (0.0, tiny, 0.0), (0.0, -tiny, PI),
        (0.0, huge, 0.0), (0.0, -huge, PI), (3.0, 0.0, FRAC_PI_2), (3.0, -0.0, FRAC_PI_2),
        (tiny, 0.0, FRAC_PI_2), (tiny, -0.0, FRAC_PI_2), (huge, 0.0, FRAC_PI_2), (huge, -0.0, FRAC_PI_2),
        (1.0, inf, 0.0), (1.0, -inf, PI), (huge, inf, 0.0), (huge, -inf, PI), (0.0, inf, 0.0), (0.0, -inf, PI),
        (inf, 1.0, FRAC_PI_2), (inf, -1.0, FRAC_PI_2), (inf, -huge, FRAC_PI_2), (inf, 0.0, FRAC_PI_2),
        (inf, inf, FRAC_PI_4), (inf, -inf, three), (tiny, tiny, FRAC_PI_4), (tiny, -tiny, three),
        (huge, huge, FRAC_PI_4), (huge, -huge, three), (1.0, 1.0, FRAC_PI_4), (1.0, -1.0, three),
        (tiny, 1.0, tiny), (tiny, huge, 0.0), (huge, tiny, FRAC_PI_2), (tiny, -huge, PI), (1e-300, 1e300, 0.0),
        (1e-315, 1.0, 1e-315), (2.0 * tiny, 2.0, tiny), (1e-310, -1e-310, three), (1e308, 1e-308, FRAC_PI_2),
    ];
    for (y, x, angle) in cases {
        for (y, angle) in [(y, angle), (-y, -angle)] {
            let got = atan2::<FUSED>(y, x);
            assert!(same(got, angle), "atan2({y}, {x}) = {got}, not {angle}");
        }
        // The same in single precision, where it has such numbers.
        let (y, x) = (y as f32, x as f32);
        let got = atan2_f32::<FUSED>(y, x);
        let angle = f64::from(y).atan2(f64::from(x)) as f32;
        assert_eq!(got.to_bits(), angle.to_bits(), "atan2({y}, {x}) = {got}, not {angle}");
    }
    for v in [0.0, 1.0, inf, f64::NAN] {
        assert!(atan2::<FUSED>(v, f64::NAN).is_nan() && atan2::<FUSED>(f64::NAN, v).is_nan());
        let v = v as f32;
        assert!(atan2_f32::<FUSED>(v, f32::NAN).is_nan() && atan2_f32::<FUSED>(f32::NAN, v).is_nan());
    }
}

#[test]
fn angles_of_zeros_infinities_and_extremes() {
    special_points::<true>();
    special_points::<false>();
}

/// Stored arguments, with some that no block may forget.
fn angles() -> Vec<f64> {
    let special = [0.0, -0.0, f64::NAN, f64::INFINITY, f64::MAX, SINCOS_LIMIT, SINCOS_LIMIT.next_up()];
    special.into_iter().chain(rows("sin_cos").map(|r| double(r[0]))).collect()
}

fn points() -> Vec<(f64, f64)> {
    let special = [
        (0.0, -0.0),
        (f64::NAN, 1.0),
        (f64::INFINITY, f64::INFINITY),
        (f64::MAX, -1.2e308),
        (1e-320, 1e-320),
        (1e300, -1e-300),
    ];
    special.into_iter().chain(rows("atan2").map(|r| (double(r[0]), double(r[1])))).collect()
}

fn symmetry<const FUSED: bool>() {
    for x in angles() {
        let ((s, c), (s_minus, c_minus)) = (sin_cos::<FUSED>(x), sin_cos::<FUSED>(-x));
        assert!(same(s_minus, -s) && same(c_minus, c), "{x}");
        let ((s, c), (s_minus, c_minus)) = (sin_cos_f32::<FUSED>(x as f32), sin_cos_f32::<FUSED>(-x as f32));
        assert!(same(s_minus.into(), (-s).into()) && same(c_minus.into(), c.into()), "{x}, single precision");
    }
    for (y, x) in points() {
        assert!(same(atan2::<FUSED>(-y, x), -atan2::<FUSED>(y, x)), "{y}, {x}");
        let (y, x) = (y as f32, x as f32);
        assert!(same(atan2_f32::<FUSED>(-y, x).into(), (-atan2_f32::<FUSED>(y, x)).into()), "{y}, {x}");
    }
}

#[test]
fn a_sine_changes_sign_with_its_argument() {
    symmetry::<true>();
    symmetry::<false>();
}

/// The bits that every function gives for `N` lanes at a time, one result after the other.
#[inline(always)]
fn in_blocks<const FUSED: bool, const N: usize>(angles: &[f64], points: &[(f64, f64)]) -> Vec<u64> {
    let mut bits = vec![];
    for x in angles.as_chunks::<N>().0 {
        let (mut s, mut c) = ([0.0; N], [0.0; N]);
        sin_cos_lanes::<FUSED, N>(x, &mut s, &mut c);
        bits.extend(s.iter().zip(c).flat_map(|(s, c)| [s.to_bits(), c.to_bits()]));
    }
    for x in angles.as_chunks::<N>().0 {
        let (mut s, mut c) = ([0.0; N], [0.0; N]);
        sin_cos_lanes_f32::<FUSED, N>(&x.map(|x| x as f32), &mut s, &mut c);
        bits.extend(s.iter().zip(c).flat_map(|(s, c)| [s.to_bits(), c.to_bits()].map(u64::from)));
    }
    for p in points.as_chunks::<N>().0 {
        let mut angle = [0.0; N];
        atan2_lanes::<FUSED, N>(&p.map(|p| p.0), &p.map(|p| p.1), &mut angle);
        bits.extend(angle.map(f64::to_bits));
    }
    for p in points.as_chunks::<N>().0 {
        let mut angle = [0.0; N];
        atan2_lanes_f32::<FUSED, N>(&p.map(|p| p.0 as f32), &p.map(|p| p.1 as f32), &mut angle);
        bits.extend(angle.map(|a| u64::from(a.to_bits())));
    }
    bits
}

/// The same by the functions of one argument.
fn one_by_one<const FUSED: bool>(angles: &[f64], points: &[(f64, f64)]) -> Vec<u64> {
    let sines = angles.iter().map(|x| sin_cos::<FUSED>(*x)).flat_map(|(s, c)| [s.to_bits(), c.to_bits()]);
    let singles = angles.iter().map(|x| sin_cos_f32::<FUSED>(*x as f32));
    let singles = singles.flat_map(|(s, c)| [s.to_bits(), c.to_bits()].map(u64::from));
    let directions = points.iter().map(|(y, x)| atan2::<FUSED>(*y, *x).to_bits());
    let single_directions =
        points.iter().map(|(y, x)| atan2_f32::<FUSED>(*y as f32, *x as f32).to_bits().into());
    sines.chain(singles).chain(directions).chain(single_directions).collect()
}

/// Arguments in multiples of 7·64, so that no lane is left over.
fn whole_blocks() -> (Vec<f64>, Vec<(f64, f64)>) {
    let (mut angles, mut points) = (angles(), points());
    angles.truncate(angles.len() / 448 * 448);
    points.truncate(points.len() / 448 * 448);
    assert!(!angles.is_empty() && !points.is_empty());
    (angles, points)
}

fn check_blocks<const FUSED: bool>() {
    let (x, p) = whole_blocks();
    let expected = one_by_one::<FUSED>(&x, &p);
    assert_eq!(in_blocks::<FUSED, 1>(&x, &p), expected);
    assert_eq!(in_blocks::<FUSED, 7>(&x, &p), expected);
    assert_eq!(in_blocks::<FUSED, 8>(&x, &p), expected);
    assert_eq!(in_blocks::<FUSED, 64>(&x, &p), expected);
}

#[test]
fn a_block_gives_the_bits_of_its_lanes() {
    check_blocks::<true>();
    check_blocks::<false>();
}

/// The arithmetic of the hardware, against multiplication and addition fused by the library.
#[cfg(target_arch = "x86_64")]
#[test]
fn target_features_do_not_change_bits() {
    #[target_feature(enable = "avx2,fma")]
    fn avx2<const FUSED: bool>(x: &[f64], p: &[(f64, f64)]) -> Vec<u64> {
        in_blocks::<FUSED, 64>(x, p)
    }
    #[target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma")]
    fn avx512<const FUSED: bool>(x: &[f64], p: &[(f64, f64)]) -> Vec<u64> {
        in_blocks::<FUSED, 64>(x, p)
    }
    let (x, p) = whole_blocks();
    let (fused, strict) = (one_by_one::<true>(&x, &p), one_by_one::<false>(&x, &p));
    assert_ne!(fused, strict);
    if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
        // SAFETY: the processor has the features of the function.
        #[allow(unsafe_code)]
        let got = unsafe { (avx2::<true>(&x, &p), avx2::<false>(&x, &p)) };
        assert!(got.0 == fused && got.1 == strict);
    }
    let avx512_found = is_x86_feature_detected!("avx512f")
        && is_x86_feature_detected!("avx512dq")
        && is_x86_feature_detected!("avx512vl");
    if avx512_found {
        // SAFETY: as above; whatever has AVX-512 has AVX2 and fused multiply-add.
        #[allow(unsafe_code)]
        let got = unsafe { (avx512::<true>(&x, &p), avx512::<false>(&x, &p)) };
        assert!(got.0 == fused && got.1 == strict);
    }
}
