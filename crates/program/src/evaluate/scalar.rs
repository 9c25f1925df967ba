//! The interpreter for one configuration at a time. It allocates nothing after it is made.

use crate::code::Opcode;
use crate::evaluate::machine::{Arithmetic, Isa, Work};
use crate::evaluate::tape::{Cells, Run, Tape};
use crate::kernel;

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
            Opcode::SinCos => {
                for group in now.chunks(8) {
                    let (mut x, mut s, mut c) = ([0.0; 8], [0.0; 8], [0.0; 8]);
                    for (x, cell) in x.iter_mut().zip(group) {
                        *x = file.get(cell.reads[0]);
                    }
                    sin_cos_8(isa, arithmetic, &x, &mut s, &mut c);
                    for (k, cell) in group.iter().enumerate() {
                        file.set(cell.writes[0], s[k]);
                        file.set(cell.writes[1], c[k]);
                    }
                }
            }
            Opcode::Atan2 => {
                for group in now.chunks(8) {
                    let (mut y, mut x, mut a) = ([0.0; 8], [1.0; 8], [0.0; 8]);
                    for (k, cell) in group.iter().enumerate() {
                        (y[k], x[k]) = (file.get(cell.reads[0]), file.get(cell.reads[1]));
                    }
                    atan2_8(isa, arithmetic, &y, &x, &mut a);
                    for (&a, cell) in a.iter().zip(group) {
                        file.set(cell.writes[0], a);
                    }
                }
            }
        }
    }
}

/// Sines and cosines of eight angles at once, at most 0.8 units in the last place off.
pub fn sin_cos_8(isa: Isa, arithmetic: Arithmetic, x: &[f64; 8], s: &mut [f64; 8], c: &mut [f64; 8]) {
    struct Pairs<'a>(&'a [f64; 8], &'a mut [f64; 8], &'a mut [f64; 8]);
    impl Work for Pairs<'_> {
        #[inline(always)]
        fn run<const FUSED: bool>(self) {
            kernel::sin_cos_lanes::<FUSED, 8>(self.0, self.1, self.2);
        }
    }
    isa.run(arithmetic, Pairs(x, s, c));
}

/// Arctangents of eight quotients at once, at most 2 units in the last place off.
pub fn atan2_8(isa: Isa, arithmetic: Arithmetic, y: &[f64; 8], x: &[f64; 8], a: &mut [f64; 8]) {
    struct Angles<'a>(&'a [f64; 8], &'a [f64; 8], &'a mut [f64; 8]);
    impl Work for Angles<'_> {
        #[inline(always)]
        fn run<const FUSED: bool>(self) {
            kernel::atan2_lanes::<FUSED, 8>(self.0, self.1, self.2);
        }
    }
    isa.run(arithmetic, Angles(y, x, a));
}
