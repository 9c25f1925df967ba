//! Dynamic functions of an arm as machine code: the bits of the scalar evaluator, Coulomb's friction among them.

use denavit::description::read_toml;
use denavit::dynamics::{DynamicFunction, DynamicPrograms, Masses};
use denavit_jit::MachineCode;

const ARM: &str = "\
convention = 'khalil'
[[joints]]
theta = 'q1'
inertia = [0.4, 0, 0, 0.5, 0, 0.3]
mass = 3
com = [0.1, 0.02, 0]
coulomb = 0.7
viscous = 0.2
[[joints]]
alpha = '90 deg'
d = '0.3 m'
theta = 'q2'
inertia = [0.2, 0.01, 0, 0.25, 0, 0.2]
mass = 2
com = [0.2, 0, 0.05]
coulomb = 0.4
[[joints]]
d = '0.4 m'
theta = 'q3'
inertia = [0.1, 0, 0.01, 0.1, 0, 0.05]
mass = 1
com = [0.15, 0.01, 0]
rotor = 0.05
";

#[test]
fn machine_code_gives_the_bits_of_the_scalar_evaluator() {
    let d = read_toml(ARM).unwrap_or_else(|e| panic!("{e:?}")).0;
    let all = DynamicPrograms::new(&d, Masses::Numbers).unwrap();
    for f in DynamicFunction::ALL {
        let program = all.program(f).expect("numbers tell all").program;
        let function = program.compile_with(|_| None).unwrap_or_else(|e| panic!("{f:?}: {e}"));
        let code = MachineCode::compile(&function).unwrap_or_else(|e| panic!("{f:?}: {e}"));
        let mut scalar = function.scalar();
        let mut found = vec![0.0; program.outputs().len()];
        let mut seen = 0.0;
        for k in 0..20 {
            let at = |j: usize| ((7 * k + 3 * j) as f64 * 0.37).sin() * if j % 2 == 0 { 2.0 } else { -1.5 };
            let x: Vec<f64> = (0..program.variables().len()).map(at).collect();
            code.eval(&x, &mut found);
            let wanted = scalar.eval(&x);
            assert!(found.iter().zip(wanted).all(|(a, b)| a.to_bits() == b.to_bits()), "{f:?} at {x:?}");
            seen += wanted.iter().map(|v| v.abs()).sum::<f64>();
        }
        assert!(seen.is_finite() && seen > 1.0, "{f:?}");
    }
}
