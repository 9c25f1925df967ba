//! The interpreter for one configuration at a time. It allocates nothing after it is made.

use crate::code::Opcode;
use crate::evaluate::machine::{Arithmetic, Instructions, Isa, Work};
use crate::evaluate::tape::{Cells, Run, Tape};
use crate::kernel::{self, sign};

/// Registers up to which the small form serves, whose accesses need no check.
const SMALL: usize = 256;

/// Runs a [`Function`](crate::Function) for one configuration.
#[derive(Clone, Debug)]
pub struct Scalar {
    variables: usize,
    outputs: usize,
    isa: Isa,
    arithmetic: Arithmetic,
    runs: Vec<Run>,
    form: Form,
}

#[derive(Clone, Debug)]
enum Form {
    Small { cells: Vec<Cells<u8>>, file: Box<[f64; SMALL]> },
    Large { cells: Vec<Cells<u32>>, file: Vec<f64> },
}

/// A register file and how it is addressed.
trait File<R: Copy> {
    fn get(&self, r: R) -> f64;
    fn set(&mut self, r: R, x: f64);
}

impl File<u8> for [f64; SMALL] {
    #[inline(always)]
    fn get(&self, r: u8) -> f64 {
        self[usize::from(r)]
    }
    #[inline(always)]
    fn set(&mut self, r: u8, x: f64) {
        self[usize::from(r)] = x;
    }
}

impl File<u32> for [f64] {
    #[inline(always)]
    fn get(&self, r: u32) -> f64 {
        self[r as usize]
    }
    #[inline(always)]
    fn set(&mut self, r: u32, x: f64) {
        self[r as usize] = x;
    }
}

impl Scalar {
    pub(crate) fn new(tape: &Tape, uniforms: &[f64], isa: Isa, arithmetic: Arithmetic) -> Self {
        let first = tape.variables + tape.outputs;
        let place = |file: &mut [f64]| {
            file[first..first + tape.uniforms].copy_from_slice(uniforms);
            tape.constant_outputs.iter().for_each(|&(k, u)| file[tape.variables + k] = uniforms[u]);
        };
        let form = if tape.registers <= SMALL {
            let mut file = Box::new([0.0; SMALL]);
            place(&mut *file);
            let small =
                |c: &Cells<u32>| Cells { reads: c.reads.map(|r| r as u8), writes: c.writes.map(|r| r as u8) };
            Form::Small { cells: tape.cells.iter().map(small).collect(), file }
        } else {
            let mut file = vec![0.0; tape.registers];
            place(&mut file);
            Form::Large { cells: tape.cells.clone(), file }
        };
        let (variables, outputs) = (tape.variables, tape.outputs);
        Scalar { variables, outputs, isa, arithmetic, runs: tape.runs.clone(), form }
    }

    /// The results at a configuration; they stay readable until the next call.
    ///
    /// # Panics
    /// If there is not one value per variable.
    #[inline]
    pub fn eval(&mut self, variables: &[f64]) -> &[f64] {
        assert_eq!(variables.len(), self.variables, "one value per variable");
        let results = self.variables..self.variables + self.outputs;
        match &mut self.form {
            Form::Small { cells, file } => {
                file[..variables.len()].copy_from_slice(variables);
                execute(&self.runs, cells, &mut **file, self.isa, self.arithmetic);
                &file[results]
            }
            Form::Large { cells, file } => {
                file[..variables.len()].copy_from_slice(variables);
                execute(&self.runs, cells, &mut file[..], self.isa, self.arithmetic);
                &file[results]
            }
        }
    }
}

#[inline(always)]
fn each<R: Copy, F: File<R> + ?Sized>(file: &mut F, cells: &[Cells<R>], f: impl Fn(&F, [R; 4]) -> f64) {
    for cell in cells {
        let x = f(file, cell.reads);
        file.set(cell.writes[0], x);
    }
}

fn execute<R: Copy, F: File<R> + ?Sized>(
    runs: &[Run],
    mut cells: &[Cells<R>],
    file: &mut F,
    isa: Isa,
    arithmetic: Arithmetic,
) {
    for run in runs {
        let (now, rest) = cells.split_at(run.count);
        cells = rest;
        match run.opcode {
            Opcode::Copy => each(file, now, |f, [a, ..]| f.get(a)),
            Opcode::Neg => each(file, now, |f, [a, ..]| -f.get(a)),
            Opcode::Add => each(file, now, |f, [a, b, ..]| f.get(a) + f.get(b)),
            Opcode::Sub => each(file, now, |f, [a, b, ..]| f.get(a) - f.get(b)),
            Opcode::Mul => each(file, now, |f, [a, b, ..]| f.get(a) * f.get(b)),
            Opcode::NegMul => each(file, now, |f, [a, b, ..]| -(f.get(a) * f.get(b))),
            Opcode::MulAdd => each(file, now, |f, [a, b, c, _]| f.get(a) * f.get(b) + f.get(c)),
            Opcode::MulSub => each(file, now, |f, [a, b, c, _]| f.get(a) * f.get(b) - f.get(c)),
            Opcode::SubMul => each(file, now, |f, [a, b, c, _]| f.get(c) - f.get(a) * f.get(b)),
            Opcode::NegMulAdd => each(file, now, |f, [a, b, c, _]| -(f.get(a) * f.get(b) + f.get(c))),
            Opcode::MulAddMul => {
                each(file, now, |f, [a, b, c, d]| f.get(a) * f.get(b) + f.get(c) * f.get(d));
            }
            Opcode::MulSubMul => {
                each(file, now, |f, [a, b, c, d]| f.get(a) * f.get(b) - f.get(c) * f.get(d));
            }
            Opcode::Div => each(file, now, |f, [a, b, ..]| f.get(a) / f.get(b)),
            Opcode::Sqrt => each(file, now, |f, [a, ..]| f.get(a).sqrt()),
            Opcode::Sign => each(file, now, |f, [a, ..]| sign(f.get(a))),
            Opcode::SinCos => {
                now.chunks(GROUP).for_each(|group| isa.run(arithmetic, Pairs(&mut *file, group)));
            }
            Opcode::Atan2 => {
                now.chunks(GROUP).for_each(|group| isa.run(arithmetic, Angles(&mut *file, group)));
            }
        }
    }
}

/// Routines done at once. Their operands are gathered inside the vector code, in arrays whose address nobody takes, so
/// that they stay in registers: eight stores followed by one wide load would wait for each other.
const GROUP: usize = 8;

/// What lane k of a group reads; lanes that are left over repeat the last one.
#[inline(always)]
fn lanes<R: Copy, F: File<R> + ?Sized>(file: &F, cells: &[Cells<R>], operand: usize) -> [f64; GROUP] {
    let last = cells.len() - 1;
    let at = |k: usize| file.get(cells[k.min(last)].reads[operand]);
    [at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7)]
}

/// Sines and cosines of up to eight angles.
struct Pairs<'a, R, F: ?Sized>(&'a mut F, &'a [Cells<R>]);

impl<R: Copy, F: File<R> + ?Sized> Work for Pairs<'_, R, F> {
    #[inline(always)]
    fn run<I: Instructions, const FUSED: bool>(self) {
        let Pairs(file, cells) = self;
        let x = lanes(file, cells, 0);
        if !x.iter().fold(true, |all, x| all & kernel::sin_cos_in_range(*x)) {
            let angles = x;
            return pairs_one_by_one::<R, F, FUSED>(file, cells, &angles);
        }
        let (mut s, mut c) = ([0.0; GROUP], [0.0; GROUP]);
        for (i, x) in x.into_iter().enumerate() {
            (s[i], c[i]) = if FUSED { kernel::sin_cos_fused(x) } else { kernel::sin_cos_strict(x) };
        }
        for ((cell, s), c) in cells.iter().zip(s).zip(c) {
            file.set(cell.writes[0], s);
            file.set(cell.writes[1], c);
        }
    }
}

/// Up to eight arctangents.
struct Angles<'a, R, F: ?Sized>(&'a mut F, &'a [Cells<R>]);

impl<R: Copy, F: File<R> + ?Sized> Work for Angles<'_, R, F> {
    #[inline(always)]
    fn run<I: Instructions, const FUSED: bool>(self) {
        let Angles(file, cells) = self;
        let (y, x) = (lanes(file, cells, 0), lanes(file, cells, 1));
        if !y.iter().zip(&x).fold(true, |all, (y, x)| all & kernel::atan2_in_range(*y, *x)) {
            let points = (y, x);
            return angles_one_by_one::<R, F, FUSED>(file, cells, &points.0, &points.1);
        }
        let mut a = [0.0; GROUP];
        for (i, (y, x)) in y.into_iter().zip(x).enumerate() {
            a[i] = if FUSED { kernel::atan2_fused(y, x) } else { kernel::atan2_strict(y, x) };
        }
        cells.iter().zip(a).for_each(|(cell, a)| file.set(cell.writes[0], a));
    }
}

#[cold]
#[inline(never)]
fn pairs_one_by_one<R: Copy, F: File<R> + ?Sized, const FUSED: bool>(
    file: &mut F,
    cells: &[Cells<R>],
    x: &[f64],
) {
    for (cell, &x) in cells.iter().zip(x) {
        let (s, c) = kernel::sin_cos::<FUSED>(x);
        file.set(cell.writes[0], s);
        file.set(cell.writes[1], c);
    }
}

#[cold]
#[inline(never)]
fn angles_one_by_one<R: Copy, F: File<R> + ?Sized, const FUSED: bool>(
    file: &mut F,
    cells: &[Cells<R>],
    y: &[f64],
    x: &[f64],
) {
    for ((cell, &y), &x) in cells.iter().zip(y).zip(x) {
        file.set(cell.writes[0], kernel::atan2::<FUSED>(y, x));
    }
}
