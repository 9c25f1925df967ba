//! Code with registers instead of values: what the interpreters run.
//!
//! Registers are one index space, `[variables | results | uniforms | scratch]`; uniforms are parameters, constants and
//! what depends on these alone. An instruction never writes a register that it reads.

use crate::code::{Code, Instruction, NONE, Opcode};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Consecutive instructions of one operation.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Run {
    pub opcode: Opcode,
    pub count: usize,
}

/// Registers: operands a, b, c, d, then results. What an operation does not use is a valid register all the same.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Cells<R> {
    pub reads: [R; 4],
    pub writes: [R; 2],
}

/// A scheduled program in registers.
#[derive(Clone, PartialEq, Debug)]
pub struct Tape {
    pub variables: usize,
    pub outputs: usize,
    pub uniforms: usize,
    pub registers: usize,
    pub runs: Vec<Run>,
    pub cells: Vec<Cells<u32>>,
    /// Results that are uniforms: result, uniform.
    pub constant_outputs: Vec<(usize, usize)>,
}

impl Tape {
    /// Allocates registers, the one that was freed last first.
    pub fn new(code: &Code) -> Self {
        let (variables, outputs) = (code.variables, code.outputs.len());
        let first = code.first_of_body();
        let uniforms = first - variables;
        let scratch = variables + outputs + uniforms;

        // The first result that a value of the body is; further ones are copies.
        let mut register = vec![u32::MAX; code.values];
        let mut constant_outputs = vec![];
        let mut copies = vec![];
        (0..variables).for_each(|v| register[v] = v as u32);
        (0..uniforms).for_each(|u| register[variables + u] = (variables + outputs + u) as u32);
        for (k, &v) in code.outputs.iter().enumerate() {
            let value = v as usize;
            if (variables..first).contains(&value) {
                constant_outputs.push((k, value - variables));
            } else if register[value] == u32::MAX {
                register[value] = (variables + k) as u32;
            } else {
                copies.push((v, (variables + k) as u32));
            }
        }

        let mut last_read = vec![usize::MAX; code.values];
        for (i, instruction) in code.body.iter().enumerate() {
            instruction.reads().iter().for_each(|&v| last_read[v as usize] = i);
        }
        copies.iter().for_each(|c| last_read[c.0 as usize] = code.body.len());

        let mut free: BinaryHeap<Reverse<u32>> = BinaryHeap::new();
        let mut registers = scratch as u32;
        let mut cells = vec![];
        let mut runs: Vec<Run> =
            code.runs().map(|run| Run { opcode: run[0].opcode, count: run.len() }).collect();
        for (i, instruction) in code.body.iter().enumerate() {
            // Results before operands are freed, so that no register is read and written at once.
            for &v in instruction.writes() {
                if register[v as usize] == u32::MAX {
                    register[v as usize] = free.pop().map_or_else(
                        || {
                            registers += 1;
                            registers - 1
                        },
                        |Reverse(r)| r,
                    );
                }
            }
            cells.push(cell(instruction, &register));
            let mut done: Vec<u32> =
                instruction.reads().iter().copied().filter(|&v| last_read[v as usize] == i).collect();
            done.extend(instruction.writes().iter().filter(|&&v| last_read[v as usize] == usize::MAX));
            done.sort_unstable();
            done.dedup();
            let freed = done.iter().map(|&v| register[v as usize]).filter(|&r| r as usize >= scratch);
            free.extend(freed.map(Reverse));
        }
        if !copies.is_empty() {
            runs.push(Run { opcode: Opcode::Copy, count: copies.len() });
        }
        let copy = |(v, r): (u32, u32)| Cells { reads: [register[v as usize]; 4], writes: [r; 2] };
        cells.extend(copies.into_iter().map(copy));
        let registers = registers as usize;
        Tape { variables, outputs, uniforms, registers, runs, cells, constant_outputs }
    }
}

fn cell(instruction: &Instruction, register: &[u32]) -> Cells<u32> {
    let first = register[instruction.operands[0] as usize];
    let reads = instruction.operands.map(|v| if v == NONE { first } else { register[v as usize] });
    let own = register[instruction.results[0] as usize];
    let writes = instruction.results.map(|v| if v == NONE { own } else { register[v as usize] });
    Cells { reads, writes }
}
