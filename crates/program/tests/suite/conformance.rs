//! Every evaluator does what the operations are defined to do, for every operation and for special values.
//!
//! The definition is `Program::eval` over `f64`. Sums, products, quotients and roots must agree with it bit for bit;
//! sines, cosines and arctangents to 2 units in the last place.

use denavit_program::{Arithmetic, Function, Graph, Isa, Opcode, Program, Value};
use denavit_symbolic::{Rational, Symbol};
use std::num::NonZero;

const NAMES: [&str; 4] = ["a", "b", "c", "d"];
const PARAMETERS: [f64; 2] = [0.75, -1.5];

/// Numbers that go wrong where anything does.
const SPECIAL: [f64; 22] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    -2.5,
    std::f64::consts::FRAC_PI_2,
    -std::f64::consts::FRAC_PI_2,
    std::f64::consts::PI,
    -std::f64::consts::PI,
    0.1,
    3.0e5,
    -1.7e6,
    1.0e22,
    -1.0e300,
    f64::MAX,
    f64::MIN_POSITIVE,
    5.0e-324,
    -1.0e-310,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::NAN,
];

/// Programs in four variables and two parameters, each with what it is there to show.
fn programs() -> Vec<(&'static str, Program)> {
    let build = |outputs: fn(&mut Graph, [Value; 4], [Value; 2]) -> Vec<Value>| {
        let variables = NAMES.map(Symbol::new);
        let parameters = ["k", "l"].map(Symbol::new);
        let mut graph = Graph::new(&variables, &parameters);
        let inputs = variables.map(|s| graph.input(s));
        let constants = parameters.map(|s| graph.input(s));
        let values = outputs(&mut graph, inputs, constants);
        let outputs: Vec<(String, Value)> =
            values.into_iter().enumerate().map(|(i, v)| (format!("r{i}"), v)).collect();
        Program::new(&graph, &outputs, |_| None, &Default::default())
    };
    vec![
        ("sums", build(|g, [a, b, c, _], _| vec![g.add(a, b), g.sub(b, c), -g.add(a, c), -g.sub(a, b), -a])),
        ("products", build(|g, [a, b, c, _], _| vec![g.mul(a, b), -g.mul(b, c), g.mul(a, a)])),
        (
            "sums of products",
            build(|g, [a, b, c, d], _| {
                let m = g.mul(a, b);
                let n = g.mul(c, d);
                let [p, q, r, s] = [(a, c), (a, d), (b, c), (b, d)].map(|(x, y)| g.mul(x, y));
                let (u, v) = (g.add(m, n), g.sub(p, q));
                vec![u, v, g.add(r, a), -g.add(s, c)]
            }),
        ),
        (
            "differences with products",
            build(|g, [a, b, c, d], _| {
                let [p, q] = [(a, b), (c, d)].map(|(x, y)| g.mul(x, y));
                let negated = [(a, c), (b, d)].map(|(x, y)| g.mul(x, y));
                vec![g.sub(p, c), g.sub(a, q), -g.add(negated[0], negated[1])]
            }),
        ),
        (
            "quotients and roots",
            build(|g, [a, b, c, d], _| vec![g.div(a, b), -g.div(b, c), g.sqrt(c), g.sqrt(-d)]),
        ),
        (
            "sines and cosines",
            build(|g, [a, b, c, d], _| {
                let sum = g.add(a, b);
                vec![g.sin(a), g.cos(a), -g.sin(b), g.cos(c), g.sin(d), g.cos(sum), g.sin(sum)]
            }),
        ),
        (
            // What is not read of a pair may share a register with the next pair.
            "halves of pairs",
            build(|g, inputs, _| {
                let [a, b, c, d] = inputs;
                let sums = [g.add(a, b), g.add(b, c), g.add(c, d), g.sub(a, d), g.sub(b, d), g.sub(a, c)];
                sums.into_iter().chain(inputs).map(|x| g.sin(x)).collect()
            }),
        ),
        ("signs", build(|g, [a, b, _, d], _| vec![g.sign(a), -g.sign(b), g.sign(-d)])),
        ("arctangents", build(|g, [a, b, c, d], _| vec![g.atan2(a, b), g.atan2(-c, d), -g.atan2(d, -a)])),
        (
            "sines of sines",
            build(|g, [a, b, _, _], _| {
                let s = g.sin(a);
                let c = g.cos(s);
                let angle = g.atan2(c, b);
                vec![g.sin(angle), c]
            }),
        ),
        (
            "parameters and constants",
            build(|g, [a, b, _, _], [k, l]| {
                let third = g.number(&Rational::new(1, 3));
                let hoisted = g.mul(k, l);
                let sine = g.sin(hoisted);
                let scaled = g.mul(third, a);
                let sum = g.add(scaled, sine);
                let zero = g.number(&Rational::from(0));
                vec![sum, g.mul(b, k), sine, -hoisted, third, -third, zero, a, -b, sum]
            }),
        ),
        ("nothing", build(|_, _, _| vec![])),
        ("many registers", build(many)),
    ]
}

fn named(what: &str) -> Program {
    programs().into_iter().find(|p| p.0 == what).expect("one of the programs").1
}

/// A program whose intermediates are all alive at once, more than a small register file holds.
fn many(g: &mut Graph, [a, b, c, d]: [Value; 4], _: [Value; 2]) -> Vec<Value> {
    let mut values = vec![a, b, c, d];
    for i in 0..400 {
        let number = g.number(&Rational::new(i + 1, 7));
        let scaled = g.mul(number, values[i as usize]);
        let next = g.add(scaled, values[(i / 2) as usize]);
        values.push(next);
    }
    let sum = values.clone().into_iter().reduce(|x, y| g.add(x, y)).expect("there are values");
    let products: Vec<Value> = values.windows(2).map(|w| g.mul(w[0], w[1])).collect();
    let other = products.into_iter().reduce(|x, y| g.sub(x, y)).expect("there are values");
    vec![sum, other]
}

fn defined(program: &Program, row: &[f64]) -> Vec<f64> {
    let value = |s: Symbol| {
        let place = |list: &[Symbol]| list.iter().position(|x| *x == s);
        place(program.variables())
            .map(|k| row[k])
            .or_else(|| place(program.parameters()).map(|k| PARAMETERS[k]))
    };
    program.eval(value).expect("all inputs have values")
}

/// Rows of special values in all positions, and ordinary ones between.
fn rows() -> Vec<f64> {
    let mut rows = vec![];
    // Miri is slow; what it looks for does not depend on the numbers.
    let step = if cfg!(miri) { 6 } else { 1 };
    for (i, &x) in SPECIAL.iter().enumerate().step_by(step) {
        for (j, &y) in SPECIAL.iter().enumerate().step_by(step) {
            rows.extend([
                x,
                y,
                SPECIAL[(i + 3 * j + 1) % SPECIAL.len()],
                SPECIAL[(5 * i + j + 2) % SPECIAL.len()],
            ]);
            rows.extend([0.01 * i as f64 - 3.0, 0.3 * j as f64, 1.0 + i as f64, -0.7 * j as f64]);
        }
    }
    rows
}

/// Equal bits, any NaN being as good as another.
fn same(x: f64, y: f64) -> bool {
    x.to_bits() == y.to_bits() || x.is_nan() && y.is_nan()
}

/// Units in the last place between two numbers.
fn ulps(x: f64, y: f64) -> u64 {
    let ordered = |x: f64| {
        let bits = x.to_bits() as i64;
        if bits < 0 { i64::MIN - bits } else { bits }
    };
    if x.is_nan() && y.is_nan() { 0 } else { ordered(x).abs_diff(ordered(y)) }
}

fn targets() -> Vec<(Isa, Arithmetic)> {
    let both = |isa| [(isa, Arithmetic::Fused), (isa, Arithmetic::Strict)];
    Isa::available().into_iter().flat_map(both).collect()
}

fn has_routines(function: &Function) -> bool {
    function.code().body.iter().any(|i| i.opcode.is_routine())
}

#[test]
fn every_operation_occurs() {
    let mut seen: Vec<Opcode> = vec![];
    for (_, program) in programs() {
        seen.extend(program.compile(&PARAMETERS).code().body.iter().map(|i| i.opcode));
        // A result that two names share is copied by the tape.
    }
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
    let missing: Vec<Opcode> = all.into_iter().filter(|op| !seen.contains(op)).collect();
    assert_eq!(missing, []);
}

#[test]
fn one_configuration_at_a_time_follows_the_definition() {
    for (what, program) in programs() {
        let function = program.compile(&PARAMETERS);
        for (isa, arithmetic) in targets() {
            let mut scalar = function.on(isa, arithmetic).scalar();
            for row in rows().chunks_exact(4) {
                let expected = defined(&program, row);
                for (k, (x, e)) in scalar.eval(row).iter().zip(&expected).enumerate() {
                    // A routine inside may be off by a unit or two, and what follows it by more.
                    let agrees = if has_routines(&function) { close(*x, *e, what) } else { same(*x, *e) };
                    assert!(agrees, "{what} {}: result {k} at {row:?} is {x:e}, not {e:e}", isa.name());
                }
            }
        }
    }
}

/// What a routine computed, or something from that.
fn close(x: f64, expected: f64, what: &str) -> bool {
    let few = if what == "sines of sines" { 8 } else { 2 };
    // Near a zero of the sine of a sine, the error is that of its argument.
    ulps(x, expected) <= few || what == "sines of sines" && (x - expected).abs() < 1e-15
}

#[test]
fn blocks_and_batches_give_the_bits_of_one_configuration() {
    let rows = rows();
    let count = rows.len() / 4;
    for (what, program) in programs() {
        let results = program.outputs().len();
        for (isa, arithmetic) in targets() {
            let function = program.compile(&PARAMETERS).on(isa, arithmetic);
            let mut scalar = function.scalar();
            let expected: Vec<f64> = rows.chunks_exact(4).flat_map(|row| scalar.eval(row).to_vec()).collect();

            let mut block = function.block::<f64>();
            let lanes = block.lanes();
            for (b, chunk) in rows.chunks_exact(4 * lanes).enumerate() {
                for j in 0..4 {
                    block.variable(j).iter_mut().zip(chunk.chunks_exact(4)).for_each(|(x, row)| *x = row[j]);
                }
                block.run();
                for k in 0..results {
                    for (i, x) in block.output(k).iter().enumerate() {
                        let e = expected[(b * lanes + i) * results + k];
                        assert!(same(*x, e), "{what} {} block: {x:e}, not {e:e}", isa.name());
                    }
                }
            }

            for size in [1, 7, 63, 64, 65, count].into_iter().filter(|n| *n <= count) {
                let (part, wanted) = (&rows[..4 * size], &expected[..results * size]);
                let mut out = vec![f64::NAN; results * size];
                function.batch().run(part, &mut out);
                assert!(out.iter().zip(wanted).all(|(x, e)| same(*x, *e)), "{what}: {size} rows");
                for threads in [1, 2, 5] {
                    out.fill(f64::NAN);
                    function.batch().run_parallel(NonZero::new(threads), part, &mut out);
                    let agree = out.iter().zip(wanted).all(|(x, e)| same(*x, *e));
                    assert!(agree, "{what}: {size} rows on {threads} threads");
                }
            }
        }
    }
}

#[test]
fn strict_routines_give_the_same_bits_on_all_instructions() {
    for (what, program) in programs() {
        let function = program.compile(&PARAMETERS);
        let mut reference = function.on(Isa::PORTABLE, Arithmetic::Strict).scalar();
        for isa in Isa::available() {
            let mut scalar = function.on(isa, Arithmetic::Strict).scalar();
            for row in rows().chunks_exact(4) {
                let pairs = scalar.eval(row).iter().zip(reference.eval(row));
                assert!(pairs.into_iter().all(|(x, e)| same(*x, *e)), "{what} {}", isa.name());
            }
        }
    }
}

#[test]
fn results_that_bypass_the_cache_are_the_same() {
    let program = named("sines and cosines");
    let function = program.compile(&PARAMETERS);
    // More results than are left in the cache.
    let count = if cfg!(miri) { 1_503 } else { 200_003 };
    let rows: Vec<f64> = (0..4 * count).map(|i| 1e-3 * i as f64).collect();
    let mut out = vec![f64::NAN; 7 * count];
    function.batch().run(&rows, &mut out);
    let mut scalar = function.scalar();
    for (row, results) in rows.chunks_exact(4).zip(out.chunks_exact(7)).step_by(97) {
        assert_eq!(scalar.eval(row), results);
    }
    let mut parallel = vec![f64::NAN; 7 * count];
    function.batch().run_parallel(None, &rows, &mut parallel);
    assert_eq!(out, parallel);
}

#[test]
fn single_precision_follows_double() {
    for (what, program) in programs().into_iter().filter(|p| p.0 != "many registers") {
        for (isa, arithmetic) in targets() {
            let function = program.compile(&PARAMETERS).on(isa, arithmetic);
            let mut block = function.block::<f32>();
            let row = [0.7, -1.3, 2.1, -0.4];
            (0..4).for_each(|j| block.variable(j).fill(row[j]));
            block.run();
            let expected = defined(&program, &row.map(f64::from));
            for (k, e) in expected.iter().enumerate() {
                let x = f64::from(block.output(k)[0]);
                let tolerance = 4.0 * f64::from(f32::EPSILON) * e.abs().max(1.0);
                assert!((x - e).abs() <= tolerance || x.is_nan() && e.is_nan(), "{what} {k}: {x}, not {e}");
            }
        }
    }
}

#[test]
fn other_parameters_need_no_second_compilation() {
    let program = named("parameters and constants");
    let function = program.compile(&[1.0, 1.0]).with_parameters(&PARAMETERS);
    let row = [0.25, -0.5, 0.0, 0.0];
    assert_eq!(function.scalar().eval(&row), program.compile(&PARAMETERS).scalar().eval(&row));
    assert_eq!(function.scalar().eval(&row)[1], -0.375);
}
