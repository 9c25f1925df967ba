//! A formula as a program: one configuration, thousands, derivatives, sines instead of angles, text.
//!
//! `cargo run --release --example 03_programs -p denavit`

use denavit::catalogue;
use denavit::forward::pose_program;
use denavit_program::Program;

fn main() {
    let robot = catalogue::robot("ur5").expect("in the catalogue");
    // Sixteen results, the matrix row by row.
    let program = pose_program(&robot);
    println!("{}; depth {}", program.count(), program.depth());

    // The lengths get their values; nothing is compiled again when they change.
    let length = |s| robot.value(s);
    let fk = program.compile_with(length).expect("the catalogue gives all lengths");
    let q = [0.1, -1.2, 1.4, 0.3, 0.8, -0.5];
    let pose = fk.scalar().eval(&q).to_vec();
    println!("position {:.4?}", [pose[3], pose[7], pose[11]]);

    // A thousand configurations, one a row, on all cores; each result has the bits of the single call.
    let rows: Vec<f64> = (0..1000).flat_map(|i| q.map(|x| x + 1e-3 * f64::from(i))).collect();
    let mut poses = vec![0.0; 1000 * 16];
    fk.batch().run_parallel(None, &rows, &mut poses);
    assert_eq!(poses[..16], pose);

    // ∂(result)/∂q, sixteen rows of six, is a program like any other.
    let jacobian = program.jacobian();
    let jacobian_function = jacobian.compile_with(length).expect("the same lengths");
    let derivative = jacobian_function.scalar().eval(&q).to_vec();
    println!("∂x/∂q {:.4?} for {}", &derivative[3 * 6..4 * 6], jacobian.count());

    // (cos, sin) in the place of each angle: no trigonometry is left.
    let pairs = program.with_pairs(program.variables()).expect("angles stand in sines and cosines only");
    assert_eq!(pairs.count().sincos, 0);
    let circle: Vec<f64> = q.iter().flat_map(|x| [x.cos(), x.sin()]).collect();
    let of_pairs = pairs.compile_with(length).expect("the same lengths");
    let same = of_pairs.scalar().eval(&circle).to_vec();
    assert!(pose.iter().zip(&same).all(|(a, b)| (a - b).abs() < 1e-14));

    // The text form reads back to the same program.
    let text = program.to_text();
    println!("{}", text.lines().take(12).collect::<Vec<_>>().join("\n"));
    assert_eq!(Program::from_text(&text).expect("it reads back").to_text(), text);
}
