//! A program in Cranelift's intermediate form.
//!
//! One block without branches: `function(variables, uniforms, results, scratch)`, four pointers. Every operation is
//! one rounding, as the program says; Cranelift contracts nothing. It orders arithmetic anew, from the results back.

use crate::routines::{ANGLES, POINTS, Results};
use cranelift_codegen::ir::condcodes::FloatCC;
use cranelift_codegen::ir::types::F64;
use cranelift_codegen::ir::{FuncRef, Function, InstBuilder, MemFlagsData, Value};
use cranelift_codegen::isa::TargetFrontendConfig;
use cranelift_frontend::{FunctionBuilder, FunctionBuilderContext};
use denavit_program::{Code, Instruction, Opcode};
use std::mem::offset_of;

/// The routines, as the function refers to them.
pub(crate) struct Callees {
    pub sin_cos: FuncRef,
    pub atan2: FuncRef,
}

/// Writes the function, whose signature is set already.
pub(crate) fn emit(code: &Code, callees: &Callees, function: &mut Function, target: TargetFrontendConfig) {
    let mut context = FunctionBuilderContext::new();
    let mut builder = FunctionBuilder::new(function, &mut context);
    let block = builder.create_block();
    builder.append_block_params_for_function_params(block);
    builder.switch_to_block(block);
    builder.seal_block(block);
    let &[variables, uniforms, results, scratch] = builder.block_params(block) else {
        unreachable!("the signature has four parameters")
    };
    let values = vec![None; code.values];
    let mut body = Body { builder, variables, uniforms, scratch, count: code.variables, values };

    let mut rest = &code.body[..];
    while let [first, ..] = rest {
        let (now, later) = rest.split_at(together(rest));
        match first.opcode {
            Opcode::SinCos => body.sin_cos(now, callees.sin_cos),
            Opcode::Atan2 => body.atan2(now, callees.atan2),
            _ => body.arithmetic(first),
        }
        rest = later;
    }
    for (k, &v) in code.outputs.iter().enumerate() {
        let value = body.value(v);
        body.builder.ins().store(MemFlagsData::trusted(), value, results, bytes(k));
    }
    body.builder.ins().return_(&[]);
    body.builder.finalize(target);
}

/// How many instructions, from the first on, one step takes: one, or what a single call of a routine computes, none of
/// which reads another.
fn together(list: &[Instruction]) -> usize {
    let most = match list[0].opcode {
        Opcode::SinCos => ANGLES,
        Opcode::Atan2 => POINTS,
        _ => 1,
    };
    let fits = |k: usize| {
        let mut written = list[..k].iter().flat_map(|i| i.writes());
        list[k].opcode == list[0].opcode && !written.any(|v| list[k].reads().contains(v))
    };
    let most = most.min(list.len());
    (1..most).find(|&k| !fits(k)).unwrap_or(most)
}

/// Where the k-th double of an array is.
fn bytes(k: usize) -> i32 {
    i32::try_from(k * size_of::<f64>()).expect("the size was checked")
}

struct Body<'a> {
    builder: FunctionBuilder<'a>,
    variables: Value,
    uniforms: Value,
    scratch: Value,
    /// How many variables there are; the uniforms follow them.
    count: usize,
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
        let (array, k) = if v < self.count { (self.variables, v) } else { (self.uniforms, v - self.count) };
        let flags = MemFlagsData::trusted().with_readonly().with_can_move();
        let value = self.builder.ins().load(F64, flags, array, bytes(k));
        self.values[v] = Some(value);
        value
    }

    fn arithmetic(&mut self, instruction: &Instruction) {
        let mut read = [self.scratch; 4];
        for (slot, &v) in read.iter_mut().zip(instruction.reads()) {
            *slot = self.value(v);
        }
        let [a, b, c, d] = read;
        let builder = &mut self.builder;
        let mut product = |a, b| builder.ins().fmul(a, b);
        let result = match instruction.opcode {
            Opcode::Copy => a,
            Opcode::Neg => builder.ins().fneg(a),
            Opcode::Add => builder.ins().fadd(a, b),
            Opcode::Sub => builder.ins().fsub(a, b),
            Opcode::Mul => product(a, b),
            Opcode::NegMul => {
                let ab = product(a, b);
                builder.ins().fneg(ab)
            }
            Opcode::MulAdd => {
                let ab = product(a, b);
                builder.ins().fadd(ab, c)
            }
            Opcode::MulSub => {
                let ab = product(a, b);
                builder.ins().fsub(ab, c)
            }
            Opcode::SubMul => {
                let ab = product(a, b);
                builder.ins().fsub(c, ab)
            }
            Opcode::NegMulAdd => {
                let ab = product(a, b);
                let sum = builder.ins().fadd(ab, c);
                builder.ins().fneg(sum)
            }
            Opcode::MulAddMul => {
                let (ab, cd) = (product(a, b), product(c, d));
                builder.ins().fadd(ab, cd)
            }
            Opcode::MulSubMul => {
                let (ab, cd) = (product(a, b), product(c, d));
                builder.ins().fsub(ab, cd)
            }
            Opcode::Div => builder.ins().fdiv(a, b),
            Opcode::Sqrt => builder.ins().sqrt(a),
            Opcode::Sign => {
                let [zero, one, less] = [0.0, 1.0, -1.0].map(|x| builder.ins().f64const(x));
                let is_below = builder.ins().fcmp(FloatCC::LessThan, a, zero);
                let below = builder.ins().select(is_below, less, a);
                let is_above = builder.ins().fcmp(FloatCC::GreaterThan, a, zero);
                builder.ins().select(is_above, one, below)
            }
            Opcode::SinCos | Opcode::Atan2 => unreachable!("routines are called"),
        };
        self.values[instruction.results[0] as usize] = Some(result);
    }

    fn sin_cos(&mut self, group: &[Instruction], callee: FuncRef) {
        let angles: Vec<Value> = group.iter().map(|i| self.value(i.operands[0])).collect();
        self.call(callee, angles, 0.0);
        self.take(group, 0, offset_of!(Results, first));
        self.take(group, 1, offset_of!(Results, second));
    }

    fn atan2(&mut self, group: &[Instruction], callee: FuncRef) {
        let points: Vec<Value> =
            group.iter().flat_map(|i| [i.operands[0], i.operands[1]]).map(|v| self.value(v)).collect();
        self.call(callee, points, 1.0);
        self.take(group, 0, offset_of!(Results, first));
    }

    /// Calls a routine; lanes that nobody needs get something harmless.
    fn call(&mut self, callee: FuncRef, mut arguments: Vec<Value>, otherwise: f64) {
        if arguments.len() < ANGLES {
            let padding = self.builder.ins().f64const(otherwise);
            arguments.resize(ANGLES, padding);
        }
        arguments.push(self.scratch);
        self.builder.ins().call(callee, &arguments);
    }

    /// Reads what a routine has computed.
    fn take(&mut self, group: &[Instruction], result: usize, place: usize) {
        for (lane, instruction) in group.iter().enumerate() {
            let offset = bytes(place / size_of::<f64>() + lane);
            let value = self.builder.ins().load(F64, MemFlagsData::trusted(), self.scratch, offset);
            self.values[instruction.results[result] as usize] = Some(value);
        }
    }
}
