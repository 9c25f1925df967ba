//! A program in Cranelift's intermediate form.

use crate::memory::Scratch;
use cranelift_codegen::ir::{FuncRef, InstBuilder, MemFlagsData, Value};
use cranelift_codegen::isa::TargetFrontendConfig;
use cranelift_frontend::{FunctionBuilder, FunctionBuilderContext};
use cranelift_codegen::ir::types::F64;
use cranelift_codegen::ir::Function;
use denavit_program::{Code, Instruction, Opcode};
use std::mem::offset_of;

/// The routines as the function calls them.
pub(crate) struct Routines {
    pub sin_cos: FuncRef,
    pub atan2: FuncRef,
}

/// Writes the body of `function (variables, uniforms, results, scratch)`, four pointers.
pub(crate) fn emit(code: &Code, routines: &Routines, function: &mut Function, config: TargetFrontendConfig) {
    let mut context = FunctionBuilderContext::new();
    let mut builder = FunctionBuilder::new(function, &mut context);
    let block = builder.create_block();
    builder.append_block_params_for_function_params(block);
    builder.switch_to_block(block);
    let [variables, uniforms, results, scratch] = builder.block_params(block).try_into().expect("four parameters");
    let mut body = Body { code, builder, variables, uniforms, scratch, values: vec![None; code.values] };

    let mut rest = &code.body[..];
    while let [first, ..] = rest {
        let count = if first.opcode.is_routine() { together(rest) } else { 1 };
        let (now, later) = rest.split_at(count);
        match first.opcode {
            Opcode::SinCos => body.sin_cos(now, routines.sin_cos),
            Opcode::Atan2 => body.atan2(now, routines.atan2),
            _ => body.arithmetic(first),
        }
        rest = later;
    }
    for (k, &v) in code.outputs.iter().enumerate() {
        let value = body.value(v);
        body.builder.ins().store(MemFlagsData::trusted(), value, results, at(k));
    }
    body.builder.ins().return_(&[]);
    body.builder.seal_all_blocks();
    body.builder.finalize(config);
}

/// How many instructions from the first on one call of a routine computes: of one operation, at most eight, none of
/// which reads another.
fn together(list: &[Instruction]) -> usize {
    let fits = |k: usize| {
        let reads_another = list[..k].iter().flat_map(|i| i.writes()).any(|v| list[k].reads().contains(v));
        list[k].opcode == list[0].opcode && !reads_another
    };
    (1..list.len().min(Scratch::LANES)).find(|&k| !fits(k)).unwrap_or(list.len().min(Scratch::LANES))
}

/// Where the k-th double of an array lies.
fn at(k: usize) -> i32 {
    i32::try_from(8 * k).expect("arrays below 2 GiB")
}

struct Body<'a> {
    code: &'a Code,
    builder: FunctionBuilder<'a>,
    variables: Value,
    uniforms: Value,
    scratch: Value,
    /// The values that are known so far.
    values: Vec<Option<Value>>,
}

impl Body<'_> {
    /// A value; variables and uniforms are loaded when they are first read.
    fn value(&mut self, v: u32) -> Value {
        let v = v as usize;
        if let Some(value) = self.values[v] {
            return value;
        }
        let (array, k) = if v < self.code.variables {
            (self.variables, v)
        } else {
            (self.uniforms, v - self.code.variables)
        };
        let flags = MemFlagsData::trusted().with_readonly().with_can_move();
        let value = self.builder.ins().load(F64, flags, array, at(k));
        self.values[v] = Some(value);
        value
    }

    fn arithmetic(&mut self, instruction: &Instruction) {
        let mut operands = [None; 4];
        for (slot, &v) in operands.iter_mut().zip(instruction.reads()) {
            *slot = Some(self.value(v));
        }
        let of = |k: usize| operands[k].expect("as many operands as the operation reads");
        let ins = || self.builder.ins();
        let _ = ins;
        let b = &mut self.builder;
        let result = match instruction.opcode {
            Opcode::Copy => of(0),
            Opcode::Neg => b.ins().fneg(of(0)),
            Opcode::Add => b.ins().fadd(of(0), of(1)),
            Opcode::Sub => b.ins().fsub(of(0), of(1)),
            Opcode::Mul => b.ins().fmul(of(0), of(1)),
            Opcode::NegMul => {
                let p = b.ins().fmul(of(0), of(1));
                b.ins().fneg(p)
            }
            Opcode::MulAdd => {
                let p = b.ins().fmul(of(0), of(1));
                b.ins().fadd(p, of(2))
            }
            Opcode::MulSub => {
                let p = b.ins().fmul(of(0), of(1));
                b.ins().fsub(p, of(2))
            }
            Opcode::SubMul => {
                let p = b.ins().fmul(of(0), of(1));
                b.ins().fsub(of(2), p)
            }
            Opcode::NegMulAdd => {
                let p = b.ins().fmul(of(0), of(1));
                let s = b.ins().fadd(p, of(2));
                b.ins().fneg(s)
            }
            Opcode::MulAddMul => {
                let p = b.ins().fmul(of(0), of(1));
                let q = b.ins().fmul(of(2), of(3));
                b.ins().fadd(p, q)
            }
            Opcode::MulSubMul => {
                let p = b.ins().fmul(of(0), of(1));
                let q = b.ins().fmul(of(2), of(3));
                b.ins().fsub(p, q)
            }
            Opcode::Div => b.ins().fdiv(of(0), of(1)),
            Opcode::Sqrt => b.ins().sqrt(of(0)),
            Opcode::SinCos | Opcode::Atan2 => unreachable!("routines are called"),
        };
        self.values[instruction.results[0] as usize] = Some(result);
    }

    fn sin_cos(&mut self, group: &[Instruction], routine: FuncRef) {
        self.put(group, 0, offset_of!(Scratch, x), 0.0);
        self.builder.ins().call(routine, &[self.scratch]);
        self.take(group, 0, offset_of!(Scratch, s));
        self.take(group, 1, offset_of!(Scratch, c));
    }

    fn atan2(&mut self, group: &[Instruction], routine: FuncRef) {
        self.put(group, 0, offset_of!(Scratch, s), 0.0);
        self.put(group, 1, offset_of!(Scratch, x), 1.0);
        self.builder.ins().call(routine, &[self.scratch]);
        self.take(group, 0, offset_of!(Scratch, c));
    }

    /// Stores an operand of all instructions, and something harmless in the lanes that are left.
    fn put(&mut self, group: &[Instruction], operand: usize, place: usize, otherwise: f64) {
        for lane in 0..Scratch::LANES {
            let value = match group.get(lane) {
                Some(instruction) => self.value(instruction.operands[operand]),
                None => self.builder.ins().f64const(otherwise),
            };
            let offset = place as i32 + at(lane);
            self.builder.ins().store(MemFlagsData::trusted(), value, self.scratch, offset);
        }
    }

    fn take(&mut self, group: &[Instruction], result: usize, place: usize) {
        for (lane, instruction) in group.iter().enumerate() {
            let offset = place as i32 + at(lane);
            let value = self.builder.ins().load(F64, MemFlagsData::trusted(), self.scratch, offset);
            self.values[instruction.results[result] as usize] = Some(value);
        }
    }
}
