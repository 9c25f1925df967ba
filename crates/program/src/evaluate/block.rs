//! The interpreter over blocks: each instruction is a loop over the configurations of a block.
//!
//! Plain loops over arrays of fixed length, which the compiler turns into vector instructions of the width that the
//! calling function is compiled for ([`crate::evaluate::machine`]).

use crate::code::Opcode;
use crate::evaluate::machine::{Instructions, Work};
use crate::evaluate::real::Real;
use crate::evaluate::tape::{Cells, Tape};
use crate::kernel::sign;

/// One register for each configuration of a block.
#[derive(Clone, Copy, PartialEq, Debug)]
#[repr(C, align(64))]
pub struct Lanes<T, const N: usize>(pub [T; N]);

/// The register written, and those read. An instruction reads no register that it writes, so they are apart.
#[inline(always)]
fn apart<'a, T, const N: usize>(
    file: &'a mut [Lanes<T, N>],
    write: u32,
) -> (&'a mut [T; N], impl Fn(u32) -> &'a [T; N] + Copy) {
    let (below, rest) = file.split_at_mut(write as usize);
    let [written, above @ ..] = rest else { unreachable!("registers are inside the file") };
    let (below, above): (&[Lanes<T, N>], &[Lanes<T, N>]) = (below, above);
    let read = move |r: u32| {
        if r < write { &below[r as usize].0 } else { &above[(r - write - 1) as usize].0 }
    };
    (&mut written.0, read)
}

#[inline(always)]
fn each<T: Real, const N: usize>(
    file: &mut [Lanes<T, N>],
    cells: &[Cells<u32>],
    f: impl Fn(T, T, T, T) -> T + Copy,
) {
    for cell in cells {
        let (out, read) = apart(file, cell.writes[0]);
        // Not by `map`, which the compiler may leave as a call.
        let [a, b, c, d] = cell.reads;
        loops(out, [read(a), read(b), read(c), read(d)], f);
    }
}

#[inline(always)]
fn loops<T: Real, const N: usize>(out: &mut [T; N], [a, b, c, d]: [&[T; N]; 4], f: impl Fn(T, T, T, T) -> T) {
    for i in 0..N {
        out[i] = f(a[i], b[i], c[i], d[i]);
    }
}

/// Runs the tape once over all lanes of the register file.
#[inline(always)]
pub(crate) fn run<I: Instructions, T: Real, const FUSED: bool, const N: usize>(
    tape: &Tape,
    file: &mut [Lanes<T, N>],
) {
    I::apart::<_, FUSED>(Run(tape, file));
}

/// One run of a tape.
pub(crate) struct Run<'a, T, const N: usize>(pub &'a Tape, pub &'a mut [Lanes<T, N>]);

impl<T: Real, const N: usize> Work for Run<'_, T, N> {
    #[inline(always)]
    fn run<I: Instructions, const FUSED: bool>(self) {
        execute::<T, FUSED, N>(self.0, self.1);
    }
}

#[inline(always)]
fn execute<T: Real, const FUSED: bool, const N: usize>(tape: &Tape, file: &mut [Lanes<T, N>]) {
    assert_eq!(file.len(), tape.registers, "the file has the tape's registers");
    let mut cells = &tape.cells[..];
    for run in &tape.runs {
        let (now, rest) = cells.split_at(run.count);
        cells = rest;
        match run.opcode {
            Opcode::Copy => each(file, now, |a, _, _, _| a),
            Opcode::Neg => each(file, now, |a, _, _, _| -a),
            Opcode::Add => each(file, now, |a, b, _, _| a + b),
            Opcode::Sub => each(file, now, |a, b, _, _| a - b),
            Opcode::Mul => each(file, now, |a, b, _, _| a * b),
            Opcode::NegMul => each(file, now, |a, b, _, _| -(a * b)),
            Opcode::MulAdd => each(file, now, |a, b, c, _| a * b + c),
            Opcode::MulSub => each(file, now, |a, b, c, _| a * b - c),
            Opcode::SubMul => each(file, now, |a, b, c, _| c - a * b),
            Opcode::NegMulAdd => each(file, now, |a, b, c, _| -(a * b + c)),
            Opcode::MulAddMul => each(file, now, |a, b, c, d| a * b + c * d),
            Opcode::MulSubMul => each(file, now, |a, b, c, d| a * b - c * d),
            Opcode::Div => each(file, now, |a, b, _, _| a / b),
            Opcode::Sqrt => each(file, now, |a, _, _, _| a.sqrt()),
            Opcode::Sign => each(file, now, |a, _, _, _| sign(a)),
            Opcode::SinCos => {
                for cell in now {
                    let [s, c] = cell.writes;
                    let x = file[cell.reads[0] as usize].0;
                    let wanted = file.get_disjoint_mut([s as usize, c as usize]);
                    let [s, c] = wanted.expect("a sine and its cosine have registers of their own");
                    T::sin_cos_lanes::<FUSED, N>(&x, &mut s.0, &mut c.0);
                }
            }
            Opcode::Atan2 => {
                for cell in now {
                    let (out, read) = apart(file, cell.writes[0]);
                    T::atan2_lanes::<FUSED, N>(read(cell.reads[0]), read(cell.reads[1]), out);
                }
            }
        }
    }
}
