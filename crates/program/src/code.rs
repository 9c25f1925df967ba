//! The arithmetic of a program as evaluators execute it.
//!
//! Lowering makes signs explicit, joins the sine and cosine of one angle, writes a product that is read once into the
//! sum that reads it (two roundings, as the program says: nothing is contracted), and sorts the instructions into runs
//! of one operation: first what leads to the sines, all sines of one depth together, and so on.

use crate::graph::{Op, Stage, Value};
use crate::program::Program;
use rustc_hash::FxHashMap;

/// What an instruction computes from its operands a, b, c, d; every operation is rounded.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub enum Opcode {
    /// `a`
    Copy,
    /// `−a`
    Neg,
    /// `a + b`
    Add,
    /// `a − b`
    Sub,
    /// `a·b`
    Mul,
    /// `−(a·b)`
    NegMul,
    /// `a·b + c`
    MulAdd,
    /// `a·b − c`
    MulSub,
    /// `c − a·b`
    SubMul,
    /// `−(a·b + c)`
    NegMulAdd,
    /// `a·b + c·d`
    MulAddMul,
    /// `a·b − c·d`
    MulSubMul,
    /// `a / b`
    Div,
    /// `√a`
    Sqrt,
    /// `sin a` and `cos a`
    SinCos,
    /// `atan2(a, b)`
    Atan2,
    /// The sign of `a`
    Sign,
}

impl Opcode {
    /// How many operands it reads.
    pub(crate) fn arity(self) -> usize {
        match self {
            Opcode::Copy | Opcode::Neg | Opcode::Sqrt | Opcode::SinCos | Opcode::Sign => 1,
            Opcode::Add | Opcode::Sub | Opcode::Mul | Opcode::NegMul | Opcode::Div | Opcode::Atan2 => 2,
            Opcode::MulAdd | Opcode::MulSub | Opcode::SubMul | Opcode::NegMulAdd => 3,
            Opcode::MulAddMul | Opcode::MulSubMul => 4,
        }
    }

    /// True for a function that is computed by a routine, many values at a time.
    pub fn is_routine(self) -> bool {
        matches!(self, Opcode::SinCos | Opcode::Atan2)
    }
}

/// One instruction; what it does not use of its operands and results is [`NONE`].
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Instruction {
    /// What is computed.
    pub opcode: Opcode,
    /// The values that are read.
    pub operands: [u32; 4],
    /// The values that are written, the second by [`Opcode::SinCos`] only.
    pub results: [u32; 2],
}

/// No value.
pub const NONE: u32 = u32::MAX;

impl Instruction {
    /// The values that are read.
    pub fn reads(&self) -> &[u32] {
        &self.operands[..self.opcode.arity()]
    }

    /// The values that are written.
    pub fn writes(&self) -> &[u32] {
        &self.results[..if self.opcode == Opcode::SinCos { 2 } else { 1 }]
    }
}

/// A program as a list of instructions, each value written once.
///
/// Values are numbered: variables, parameters, constants, what the prelude computes, what the body computes.
#[derive(Clone, PartialEq, Debug)]
pub struct Code {
    /// How many variables there are.
    pub variables: usize,
    /// How many parameters there are.
    pub parameters: usize,
    /// Constants, each the double nearest to its exact value.
    pub constants: Vec<f64>,
    /// What depends on parameters alone, to be run once for each set of parameters.
    pub prelude: Vec<Instruction>,
    /// What is run for each configuration, in runs of one operation.
    pub body: Vec<Instruction>,
    /// The results, in order.
    pub outputs: Vec<u32>,
    /// The names of the results.
    pub names: Vec<String>,
    /// How many values there are.
    pub values: usize,
}

impl Code {
    /// Lowers a program.
    pub fn new(program: &Program) -> Self {
        let mut lowering = Lowering::new(program);
        let prelude = lowering.stage(Stage::Parameter);
        let body = lowering.stage(Stage::Variable);
        let outputs: Vec<u32> =
            program.outputs().iter().map(|o| lowering.ids[&(o.1.node, o.1.negative)]).collect();
        Code {
            variables: program.variables().len(),
            parameters: program.parameters().len(),
            constants: lowering.constants,
            prelude,
            body: scheduled(&body, lowering.next),
            outputs,
            names: program.outputs().iter().map(|o| o.0.clone()).collect(),
            values: lowering.next as usize,
        }
    }

    /// The body in runs of one operation. The routines of a run do not read one another, so that one call can do
    /// several of them.
    pub fn runs(&self) -> impl Iterator<Item = &[Instruction]> {
        let mut written: Vec<u32> = vec![];
        self.body.chunk_by(move |a, b| {
            written.extend(a.writes());
            let joins = a.opcode == b.opcode
                && !(b.opcode.is_routine() && b.reads().iter().any(|v| written.contains(v)));
            if !joins {
                written.clear();
            }
            joins
        })
    }

    /// The first value that the body computes; those before it, but for the variables, do not vary in a batch.
    pub fn first_of_body(&self) -> usize {
        let written: usize = self.body.iter().map(|i| i.writes().len()).sum();
        self.values - written
    }

    /// The parameters, the constants and what the prelude computes from them.
    ///
    /// # Panics
    /// If there is not one value per parameter.
    pub fn uniforms(&self, parameters: &[f64]) -> Vec<f64> {
        assert_eq!(parameters.len(), self.parameters, "one value per parameter");
        let mut values = [parameters, &self.constants[..]].concat();
        values.resize(self.first_of_body() - self.variables, f64::NAN);
        for instruction in &self.prelude {
            let at = |k: usize| values[instruction.operands[k] as usize - self.variables];
            let results = match instruction.opcode {
                Opcode::Copy => [at(0), 0.0],
                Opcode::Neg => [-at(0), 0.0],
                Opcode::Add => [at(0) + at(1), 0.0],
                Opcode::Sub => [at(0) - at(1), 0.0],
                Opcode::Mul => [at(0) * at(1), 0.0],
                Opcode::NegMul => [-(at(0) * at(1)), 0.0],
                Opcode::MulAdd => [at(0) * at(1) + at(2), 0.0],
                Opcode::MulSub => [at(0) * at(1) - at(2), 0.0],
                Opcode::SubMul => [at(2) - at(0) * at(1), 0.0],
                Opcode::NegMulAdd => [-(at(0) * at(1) + at(2)), 0.0],
                Opcode::MulAddMul => [at(0) * at(1) + at(2) * at(3), 0.0],
                Opcode::MulSubMul => [at(0) * at(1) - at(2) * at(3), 0.0],
                Opcode::Div => [at(0) / at(1), 0.0],
                Opcode::Sqrt => [at(0).sqrt(), 0.0],
                Opcode::SinCos => at(0).sin_cos().into(),
                Opcode::Atan2 => [at(0).atan2(at(1)), 0.0],
                Opcode::Sign => [crate::kernel::sign(at(0)), 0.0],
            };
            for (&id, x) in instruction.writes().iter().zip(results) {
                values[id as usize - self.variables] = x;
            }
        }
        values
    }
}

struct Lowering<'a> {
    program: &'a Program,
    /// How often each node is read, results counted.
    uses: Vec<u32>,
    /// The number of a node's value, with its sign.
    ids: FxHashMap<(u32, bool), u32>,
    constants: Vec<f64>,
    next: u32,
}

impl<'a> Lowering<'a> {
    fn new(program: &'a Program) -> Self {
        let ops = program.ops();
        let mut uses = vec![0_u32; ops.len()];
        let mut ids = FxHashMap::default();
        let mut exact: Vec<f64> = vec![0.0; ops.len()];
        let count = (program.variables().len() + program.parameters().len()) as u32;
        for (i, (op, stage)) in ops.iter().enumerate() {
            op.nodes().for_each(|n| uses[n as usize] += 1);
            if *stage == Stage::Constant {
                exact[i] = op.value(|_| f64::NAN, |n| exact[n as usize]);
            }
            if let Op::Input(s) = op {
                let mut inputs = program.variables().iter().chain(program.parameters());
                let place = inputs.position(|x| x == s).expect("an input is declared");
                ids.insert((i as u32, false), place as u32);
            }
        }
        program.outputs().iter().for_each(|o| uses[o.1.node as usize] += 1);
        // Every constant that something which is not constant reads, with its sign.
        let mut constants: Vec<f64> = vec![];
        let varying = ops.iter().filter(|o| o.1 != Stage::Constant).flat_map(|o| o.0.operands());
        for v in varying.chain(program.outputs().iter().map(|o| o.1)) {
            if ops[v.node as usize].1 != Stage::Constant {
                continue;
            }
            let x = exact[v.node as usize] * if v.negative { -1.0 } else { 1.0 };
            // A negative zero is no constant that anybody wrote.
            let x = if x == 0.0 { 0.0 } else { x };
            let known = constants.iter().position(|c| c.to_bits() == x.to_bits());
            let place = known.unwrap_or(constants.len());
            if known.is_none() {
                constants.push(x);
            }
            ids.insert((v.node, v.negative), count + place as u32);
        }
        let next = count + constants.len() as u32;
        Lowering { program, uses, ids, constants, next }
    }

    fn fresh(&mut self) -> u32 {
        self.next += 1;
        self.next - 1
    }

    /// The operands of a product that is read by one operation of the same stage and can be written into it.
    fn product(&self, node: u32, stage: Stage) -> Option<[u32; 2]> {
        match self.program.ops()[node as usize] {
            (Op::Mul(a, b), s) if s == stage && self.uses[node as usize] == 1 => Some([a, b]),
            _ => None,
        }
    }

    /// The instructions of a stage.
    fn stage(&mut self, stage: Stage) -> Vec<Instruction> {
        let ops = self.program.ops();
        let mut list = vec![];
        // Products that a sum takes over, and results that are wanted with the other sign only.
        let mut absorbed = vec![false; ops.len()];
        let mut negated = vec![false; ops.len()];
        for (op, s) in ops {
            if let (Op::Add(a, b) | Op::Sub(a, b), true) = (op, *s == stage) {
                for n in [a, b] {
                    absorbed[*n as usize] |= self.product(*n, stage).is_some();
                }
            }
        }
        for (_, v) in self.program.outputs() {
            let node = v.node as usize;
            negated[node] = v.negative && self.uses[node] == 1;
        }
        for (i, (op, s)) in ops.iter().enumerate() {
            if *s != stage || absorbed[i] {
                continue;
            }
            self.lower(i as u32, op, negated[i], &mut list);
        }
        // Results with a sign that nothing else took care of.
        for (_, v) in self.program.outputs() {
            if ops[v.node as usize].1 == stage {
                self.read(*v, &mut list);
            }
        }
        list
    }

    fn lower(&mut self, node: u32, op: &Op, negated: bool, list: &mut Vec<Instruction>) {
        let stage = self.program.ops()[node as usize].1;
        let plain = |n: u32| Value { node: n, negative: false };
        let (opcode, values): (Opcode, Vec<Value>) = match *op {
            Op::Number(_) | Op::Pi | Op::Input(_) => return,
            Op::Add(a, b) => match (self.product(a, stage), self.product(b, stage)) {
                (Some([a, b]), Some([c, d])) if !negated => {
                    (Opcode::MulAddMul, vec![plain(a), plain(b), plain(c), plain(d)])
                }
                (Some([x, y]), None) | (None, Some([x, y])) => {
                    let other = if self.product(a, stage).is_some() { b } else { a };
                    let opcode = if negated { Opcode::NegMulAdd } else { Opcode::MulAdd };
                    (opcode, vec![plain(x), plain(y), plain(other)])
                }
                (Some([x, y]), Some([c, d])) => {
                    // −(x·y + c·d): the second product on its own.
                    let second = self.emit(Opcode::Mul, &[plain(c), plain(d)], list);
                    let id = self.fresh();
                    let [x, y] = [x, y].map(|n| self.read(plain(n), list));
                    let operands = [x, y, second, NONE];
                    list.push(Instruction { opcode: Opcode::NegMulAdd, operands, results: [id, NONE] });
                    self.ids.insert((node, true), id);
                    return;
                }
                (None, None) => (Opcode::Add, vec![plain(a), plain(b)]),
            },
            Op::Sub(a, b) => match (self.product(a, stage), self.product(b, stage)) {
                (Some([a, b]), Some([c, d])) => {
                    (Opcode::MulSubMul, vec![plain(a), plain(b), plain(c), plain(d)])
                }
                (Some([x, y]), None) => (Opcode::MulSub, vec![plain(x), plain(y), plain(b)]),
                (None, Some([x, y])) => (Opcode::SubMul, vec![plain(x), plain(y), plain(a)]),
                (None, None) => (Opcode::Sub, vec![plain(a), plain(b)]),
            },
            Op::Mul(a, b) => (if negated { Opcode::NegMul } else { Opcode::Mul }, vec![plain(a), plain(b)]),
            Op::Div(a, b) => (Opcode::Div, vec![plain(a), plain(b)]),
            Op::Sqrt(a) => (Opcode::Sqrt, vec![a]),
            Op::Atan2(a, b) => (Opcode::Atan2, vec![a, b]),
            Op::Sign(a) => (Opcode::Sign, vec![plain(a)]),
            Op::Sin(a) | Op::Cos(a) => return self.pair(node, a, list),
        };
        let id = self.emit(opcode, &values, list);
        let is_negative = matches!(opcode, Opcode::NegMul | Opcode::NegMulAdd);
        self.ids.insert((node, is_negative), id);
    }

    /// The sine and cosine of an angle, once for both.
    fn pair(&mut self, node: u32, angle: u32, list: &mut Vec<Instruction>) {
        if self.ids.contains_key(&(node, false)) {
            return;
        }
        let operand = self.read(Value { node: angle, negative: false }, list);
        let results = [self.fresh(), self.fresh()];
        let operands = [operand, NONE, NONE, NONE];
        list.push(Instruction { opcode: Opcode::SinCos, operands, results });
        for (i, (op, _)) in self.program.ops().iter().enumerate() {
            match op {
                Op::Sin(a) if *a == angle => self.ids.insert((i as u32, false), results[0]),
                Op::Cos(a) if *a == angle => self.ids.insert((i as u32, false), results[1]),
                _ => None,
            };
        }
    }

    fn emit(&mut self, opcode: Opcode, values: &[Value], list: &mut Vec<Instruction>) -> u32 {
        let mut operands = [NONE; 4];
        for (slot, v) in operands.iter_mut().zip(values) {
            *slot = self.read(*v, list);
        }
        let id = self.fresh();
        list.push(Instruction { opcode, operands, results: [id, NONE] });
        id
    }

    /// The number of a value; a sign that is not there yet is put in front of it.
    fn read(&mut self, v: Value, list: &mut Vec<Instruction>) -> u32 {
        if let Some(&id) = self.ids.get(&(v.node, v.negative)) {
            return id;
        }
        let operand = self.ids[&(v.node, !v.negative)];
        let id = self.fresh();
        let operands = [operand, NONE, NONE, NONE];
        list.push(Instruction { opcode: Opcode::Neg, operands, results: [id, NONE] });
        self.ids.insert((v.node, v.negative), id);
        id
    }
}

/// The instructions sorted into runs: level by level of routines that read one another, what a level needs before
/// its routines; within that, the operation that most instructions are ready for.
fn scheduled(list: &[Instruction], values: u32) -> Vec<Instruction> {
    let mut producer = vec![usize::MAX; values as usize];
    for (i, instruction) in list.iter().enumerate() {
        instruction.writes().iter().for_each(|&v| producer[v as usize] = i);
    }
    let before = |i: usize| {
        let read: &Instruction = &list[i];
        read.reads().iter().map(|&v| producer[v as usize]).filter(|&p| p != usize::MAX)
    };
    let mut level = vec![0_usize; list.len()];
    let mut readers: Vec<Vec<usize>> = vec![vec![]; list.len()];
    let mut missing = vec![0_usize; list.len()];
    for i in 0..list.len() {
        for p in before(i) {
            level[i] = level[i].max(level[p] + usize::from(list[p].opcode.is_routine()));
            readers[p].push(i);
            missing[i] += 1;
        }
    }
    // The first level of routines that an instruction leads to.
    let mut needed = vec![usize::MAX; list.len()];
    for i in (0..list.len()).rev() {
        if list[i].opcode.is_routine() {
            needed[i] = level[i];
        }
        for p in before(i) {
            needed[p] = needed[p].min(needed[i]);
        }
    }
    let mut ready: Vec<usize> = (0..list.len()).filter(|&i| missing[i] == 0).collect();
    let mut order: Vec<Instruction> = Vec::with_capacity(list.len());
    while !ready.is_empty() {
        let urgent = ready.iter().map(|&i| needed[i]).min().unwrap_or(usize::MAX);
        let pending = |i: &usize| needed[*i] == urgent;
        // Routines of a level wait for what leads to the others of that level.
        let plain = ready.iter().filter(|i| pending(i)).any(|&i| !list[i].opcode.is_routine());
        let mut counts: FxHashMap<Opcode, usize> = FxHashMap::default();
        for &i in ready.iter().filter(|i| pending(i)) {
            if !(plain && list[i].opcode.is_routine()) {
                *counts.entry(list[i].opcode).or_default() += 1;
            }
        }
        let most = counts.iter().map(|(&op, &n)| (n, std::cmp::Reverse(op))).max();
        let Some((_, std::cmp::Reverse(opcode))) = most else { break };
        let (mut run, rest): (Vec<usize>, Vec<usize>) =
            ready.into_iter().partition(|&i| list[i].opcode == opcode && needed[i] == urgent);
        run.sort_unstable();
        ready = rest;
        for i in run {
            order.push(list[i]);
            for &r in &readers[i] {
                missing[r] -= 1;
                if missing[r] == 0 {
                    ready.push(r);
                }
            }
        }
    }
    order
}
