//! Millions of poses through memory: (N, 6) rows in, (N, 4, 4) rows out, beside the traffic alone.

use crate::measure::Entry;
use denavit_program::Function;
use std::hint::black_box;

/// Poses; 176 bytes each, far more than a cache holds.
const POSES: usize = 1_000_000;

/// Rows read and results written, with and without anything computed.
pub fn entries(function: &Function, random: &mut impl FnMut() -> f64) -> Vec<Entry<'static>> {
    let variables: Vec<f64> = (0..6 * POSES).map(|_| random()).collect();
    let batch = function.batch::<f64>();
    let group = "memory";
    let (q, mut out) = (variables.clone(), vec![0.0; 16 * POSES]);
    let mut one = batch.clone();
    let compute = Entry {
        group,
        name: "(N, 6) to (N, 4, 4), one core".into(),
        items: POSES,
        limit: None,
        run: Box::new(move || one.run(black_box(&q), black_box(&mut out))),
    };
    let (q, mut out) = (variables.clone(), vec![0.0; 16 * POSES]);
    let both = Entry {
        group,
        name: "(N, 6) to (N, 4, 4), all cores".into(),
        items: POSES,
        limit: None,
        run: Box::new(move || batch.run_parallel(None, black_box(&q), black_box(&mut out))),
    };
    let (q, mut out) = (variables.clone(), vec![0.0; 16 * POSES]);
    let copy = Entry {
        group,
        name: "the traffic alone: each row copied to the head of its result, the rest filled".into(),
        items: POSES,
        limit: None,
        run: Box::new(move || traffic(black_box(&q), black_box(&mut out))),
    };
    vec![compute, both, copy]
}

/// Reads and writes what the batch does, past the cache as it does.
fn traffic(q: &[f64], out: &mut [f64]) {
    for (q, out) in q.chunks_exact(6).zip(out.chunks_exact_mut(16)) {
        let mut row = [0.0; 16];
        row[..6].copy_from_slice(q);
        #[cfg(target_arch = "x86_64")]
        stream(&row, out);
        #[cfg(not(target_arch = "x86_64"))]
        out.copy_from_slice(&row);
    }
}

#[cfg(target_arch = "x86_64")]
#[allow(unsafe_code)]
fn stream(row: &[f64; 16], out: &mut [f64]) {
    use std::arch::x86_64::{_mm_loadu_pd, _mm_stream_pd};
    assert!(out.len() == 16 && out.as_ptr().align_offset(16) == 0, "an aligned row");
    for k in (0..16).step_by(2) {
        // SAFETY: both are 16 numbers long, and the target is aligned to 16 bytes.
        unsafe { _mm_stream_pd(out.as_mut_ptr().add(k), _mm_loadu_pd(row.as_ptr().add(k))) }
    }
}
