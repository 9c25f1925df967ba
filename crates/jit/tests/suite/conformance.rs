//! Machine code gives the bits of the scalar evaluator: for every operation, at special values, for random programs.

use denavit_jit::MachineCode;
use denavit_program::{Arithmetic, Function, Graph, Isa, Opcode, Program, Value};
use denavit_symbolic::{Expr, Rational, Symbol};
use std::collections::BTreeSet;

const SPECIAL: [f64; 22] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    -2.5,
    std::f64::consts::PI,
    -std::f64::consts::FRAC_PI_2,
    5e-324,
    -1e-310,
    f64::MIN_POSITIVE,
    1e-300,
    1e-17,
    1.7e6,
    -1e9,
    1e22,
    -1e291,
    f64::MAX,
    f64::MIN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::NAN,
];

/// Numbers from a seed (Marsaglia's xorshift).
struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        for shift in [13, -7, 17] {
            self.0 ^= if shift > 0 { self.0 << shift } else { self.0 >> -shift };
        }
        (self.0 % n as u64) as usize
    }

    fn number(&mut self) -> f64 {
        match self.below(4) {
            0 => SPECIAL[self.below(SPECIAL.len())],
            _ => (self.below(1 << 30) as f64 / f64::from(1 << 29) - 1.0) * 4.0,
        }
    }
}

fn symbols(names: &[&str]) -> Vec<Symbol> {
    names.iter().map(|n| Expr::symbol(n).as_symbol().expect("a symbol")).collect()
}

fn program(variables: &[&str], parameters: &[&str], trace: impl FnOnce(&mut Graph) -> Vec<Value>) -> Program {
    let mut graph = Graph::new(&symbols(variables), &symbols(parameters));
    let values = trace(&mut graph);
    let outputs: Vec<(String, Value)> =
        values.into_iter().enumerate().map(|(k, v)| (format!("out{k}"), v)).collect();
    Program::new(&graph, &outputs, |_| None, &Default::default())
}

fn of(variables: &[&str], formulas: impl FnOnce(&[Expr]) -> Vec<Expr>) -> Program {
    let inputs: Vec<Expr> = variables.iter().map(|n| Expr::symbol(n)).collect();
    program(variables, &[], |graph| formulas(&inputs).into_iter().map(|e| graph.trace(e)).collect())
}

fn opcodes(function: &Function) -> BTreeSet<Opcode> {
    function.code().body.iter().map(|i| i.opcode).collect()
}

/// The same bits, or not a number on both sides.
fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
}

/// Compares on all instructions and roundings that this processor has.
fn check(function: &Function, configurations: &[Vec<f64>]) {
    for isa in Isa::available() {
        for arithmetic in [Arithmetic::Fused, Arithmetic::Strict] {
            let function = function.on(isa, arithmetic);
            let code = MachineCode::compile(&function).expect("code for this processor");
            let mut scalar = function.scalar();
            let mut results = vec![0.0; function.code().outputs.len()];
            for variables in configurations {
                code.eval(variables, &mut results);
                for (k, (&a, &b)) in scalar.eval(variables).iter().zip(&results).enumerate() {
                    let target = (isa.name(), arithmetic);
                    assert!(same(a, b), "{target:?}, result {k} at {variables:?}: {a:e} and {b:e}");
                }
            }
        }
    }
}

fn random_configurations(random: &mut Random, variables: usize, count: usize) -> Vec<Vec<f64>> {
    (0..count).map(|_| (0..variables).map(|_| random.number()).collect()).collect()
}

/// All pairs of special values for the first two variables, others at random.
fn special_configurations(variables: usize) -> Vec<Vec<f64>> {
    let mut random = Random(7);
    let mut list = vec![];
    for x in SPECIAL {
        for y in SPECIAL {
            let mut row: Vec<f64> = (0..variables).map(|_| random.number()).collect();
            row.iter_mut().zip([x, y]).for_each(|(slot, v)| *slot = v);
            list.push(row);
        }
    }
    list
}

#[test]
fn every_operation_has_the_bits_of_the_scalar_evaluator() {
    let names = ["a", "b", "c", "d"];
    let rows = special_configurations(4);
    let mut seen = BTreeSet::new();
    let mut each = |formula: fn(&[Expr]) -> Expr| {
        let function = of(&names, |x| vec![formula(x)]).compile(&[]);
        seen.extend(opcodes(&function));
        check(&function, &rows);
    };
    each(|x| -x[0]);
    each(|x| x[0] + x[1]);
    each(|x| x[0] - x[1]);
    each(|x| x[0] * x[1]);
    each(|x| -(x[0] * x[1]));
    each(|x| x[0] * x[1] + x[2]);
    each(|x| x[0] * x[1] - x[2]);
    each(|x| x[2] - x[0] * x[1]);
    each(|x| -(x[0] * x[1] + x[2]));
    each(|x| x[0] * x[1] + x[2] * x[3]);
    each(|x| x[0] * x[1] - x[2] * x[3]);
    each(|x| x[0] / x[1]);
    each(|x| x[0].sqrt());
    each(|x| x[0].sin());
    each(|x| x[0].cos());
    each(|x| x[0].atan2(x[1]));
    each(|x| x[0].sign());
    // Lowering copies results outside the body; there is no instruction for it.
    let all = [
        Opcode::Neg,
        Opcode::Add,
        Opcode::Sub,
        Opcode::Mul,
        Opcode::NegMul,
        Opcode::MulAdd,
        Opcode::MulSub,
        Opcode::SubMul,
        Opcode::NegMulAdd,
        Opcode::MulAddMul,
        Opcode::MulSubMul,
        Opcode::Div,
        Opcode::Sqrt,
        Opcode::SinCos,
        Opcode::Atan2,
        Opcode::Sign,
    ];
    assert_eq!(seen, all.into());
}

#[test]
fn routines_are_called_for_any_number_of_values() {
    let names: Vec<String> = (0..20).map(|k| format!("x{k}")).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let rows = [special_configurations(20), random_configurations(&mut Random(3), 20, 50)].concat();
    for count in [1, 2, 4, 5, 7, 8, 9, 16, 19] {
        let sines = of(&names, |x| x[..count].iter().flat_map(|x| [x.sin(), x.cos()]).collect());
        let function = sines.compile(&[]);
        assert_eq!(function.code().body.len(), count);
        check(&function, &rows);
        let angles = of(&names, |x| (0..count).map(|k| x[k].atan2(x[k + 1])).collect());
        check(&angles.compile(&[]), &rows);
    }
}

#[test]
fn routines_of_results_of_routines() {
    let rows = [special_configurations(3), random_configurations(&mut Random(5), 3, 100)].concat();
    let mixed = of(&["x", "y", "z"], |x| {
        let angle = (x[0].sin() + x[1]).atan2(x[1].cos() * x[2]);
        vec![angle, (angle + x[0]).sin(), (angle + angle).cos() * x[2].sin(), x[0].sin() + angle]
    });
    check(&mixed.compile(&[]), &rows);
}

/// The sine of a sine, next to each other in the code: one call cannot compute both.
#[test]
fn a_routine_that_reads_the_one_before_it() {
    let function = of(&["x"], |x| vec![x[0].sin().sin(), x[0].cos().cos().cos()]).compile(&[]);
    let one = MachineCode::compile(&function).expect("code for this processor");
    let step = of(&["x"], |x| vec![x[0].sin(), x[0].cos()]).compile(&[]);
    let at = |x: f64| <[f64; 2]>::try_from(step.scalar().eval(&[x])).expect("two results");
    let mut results = [0.0; 2];
    for x in SPECIAL {
        one.eval(&[x], &mut results);
        let expected = [at(at(x)[0])[0], at(at(at(x)[1])[1])[1]];
        assert!(results.iter().zip(expected).all(|(&a, b)| same(a, b)), "{results:?}, {expected:?} at {x}");
    }
}

#[test]
fn results_without_a_computation() {
    let rows = special_configurations(2);
    let repeated = of(&["x", "y"], |x| {
        let (one, u) = (Expr::int(1), x[0] * x[1]);
        vec![one, Expr::pi(), x[0], x[1], x[0], -x[1], u, u, -u, u + one, Expr::int(0), -one]
    });
    check(&repeated.compile(&[]), &rows);
    check(&of(&["x", "y"], |_| vec![]).compile(&[]), &rows);
    check(&of(&[], |_| vec![Expr::pi()]).compile(&[]), &[vec![]]);
    check(&of(&[], |_| vec![]).compile(&[]), &[vec![]]);
}

#[test]
fn parameters_can_be_bound_anew() {
    let [x, p, q] = ["x", "p", "q"].map(Expr::symbol);
    let formulas = [p * x.sin(), p.sin() * q + x, p, q / p, x.atan2(q), (p * q).sqrt() * x];
    let program = program(&["x"], &["p", "q"], |g| formulas.iter().map(|e| g.trace(*e)).collect());
    let first = MachineCode::compile(&program.compile(&[1.0, 2.0])).expect("code for this processor");
    let mut random = Random(11);
    let mut results = [0.0; 6];
    for _ in 0..200 {
        let (x, parameters) = (random.number(), [random.number(), random.number()]);
        let bound = first.with_parameters(&parameters);
        bound.eval(&[x], &mut results);
        let function = program.compile(&parameters);
        assert!(function.scalar().eval(&[x]).iter().zip(&results).all(|(&a, &b)| same(a, b)));
        assert!(bound.function().uniforms().iter().zip(function.uniforms()).all(|(&a, &b)| same(a, b)));
    }
    // The first has kept its own.
    let mut scalar = program.compile(&[1.0, 2.0]).scalar();
    first.eval(&[0.3], &mut results);
    assert_eq!(scalar.eval(&[0.3]), results);
}

#[test]
fn random_programs() {
    let names = ["a", "b", "c", "d", "e"];
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    let mut seen = BTreeSet::new();
    for round in 0..60 {
        let length = 5 + random.below(if round % 10 == 0 { 600 } else { 60 });
        let program = program(&names[..3], &names[3..], |graph| {
            let mut values: Vec<Value> = symbols(&names).into_iter().map(|s| graph.input(s)).collect();
            values.push(graph.number(&Rational::from(2)));
            for _ in 0..length {
                // Late values more often than early ones: long chains.
                let pick = |random: &mut Random| {
                    let v = values[values.len() - 1 - random.below(values.len().min(12))];
                    if random.below(4) == 0 { -v } else { v }
                };
                let (a, b) = (pick(&mut random), pick(&mut random));
                let value = match random.below(14) {
                    0..=3 => graph.mul(a, b),
                    4..=6 => graph.add(a, b),
                    7..=9 => graph.sub(a, b),
                    10 => graph.div(a, b),
                    11 => graph.sqrt(a),
                    12 if random.below(2) == 0 => graph.sin(a),
                    12 => graph.cos(a),
                    _ => graph.atan2(a, b),
                };
                values.push(value);
            }
            (0..random.below(14)).map(|_| values[random.below(values.len())]).collect()
        });
        let function = program.compile(&[random.number(), random.number()]);
        seen.extend(opcodes(&function));
        check(&function, &random_configurations(&mut random, 3, 40));
    }
    assert!(seen.len() >= 14, "{seen:?}");
}

#[test]
fn threads_share_the_code() {
    let program = of(&["x", "y"], |x| vec![(x[0] + x[1]).sin() * x[0], x[1].atan2(x[0]), x[0].cos() + x[1]]);
    let function = program.compile(&[]);
    let code = MachineCode::compile(&function).expect("code for this processor");
    std::thread::scope(|scope| {
        for seed in 1..5 {
            let (function, own) = (&function, code.clone());
            let borrowed = &code;
            scope.spawn(move || {
                let (mut scalar, mut random) = (function.scalar(), Random(seed));
                let mut results = [0.0; 3];
                for k in 0..2000 {
                    let row = [random.number(), random.number()];
                    if k % 2 == 0 { &own } else { borrowed }.eval(&row, &mut results);
                    assert!(scalar.eval(&row).iter().zip(&results).all(|(&a, &b)| same(a, b)));
                }
            });
        }
    });
}

#[test]
fn clones_outlive_the_first() {
    let function = of(&["x"], |x| vec![x[0].cos()]).compile(&[]);
    let first = MachineCode::compile(&function).expect("code for this processor");
    let second = first.clone();
    drop(first);
    let mut results = [0.0];
    second.eval(&[0.0], &mut results);
    assert_eq!(results, [1.0]);
}

#[test]
#[cfg(target_os = "linux")]
fn code_is_freed_with_its_last_user() {
    // Bytes that can be executed.
    let executable = || {
        let maps = std::fs::read_to_string("/proc/self/maps").expect("Linux tells");
        let size = |line: &str| {
            let (start, end) = line.split_once(" r-xp ")?.0.split_once('-')?;
            Some(usize::from_str_radix(end, 16).ok()? - usize::from_str_radix(start, 16).ok()?)
        };
        maps.lines().filter_map(size).sum::<usize>()
    };
    let function = of(&["x"], |x| vec![x[0].sin()]).compile(&[]);
    let compile = |_| MachineCode::compile(&function).expect("code for this processor");
    let before = executable();
    (0..1000).map(compile).for_each(drop);
    // Other tests have some code at the same time.
    assert!(executable() < before + 500 * 4096);
    let kept: Vec<MachineCode> = (0..1000).map(compile).collect();
    assert!(executable() >= before + 500 * 4096);
    drop(kept);
}

#[test]
#[should_panic(expected = "one place per result")]
fn a_wrong_number_of_results_panics() {
    let function = of(&["x"], |x| vec![x[0].sin()]).compile(&[]);
    MachineCode::compile(&function).expect("code for this processor").eval(&[0.0], &mut []);
}

#[test]
#[should_panic(expected = "one value per variable")]
fn a_wrong_number_of_variables_panics() {
    let function = of(&["x"], |x| vec![x[0].sin()]).compile(&[]);
    MachineCode::compile(&function).expect("code for this processor").eval(&[], &mut [0.0]);
}
