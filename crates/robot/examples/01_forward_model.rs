//! From a table to a proved forward model, and to numbers.
//!
//! `cargo run --example 01_forward_model -p denavit`

use denavit::Robot;
use denavit::description::{read_toml, render};
use denavit::forward::{ForwardModel, Outputs, Proof, link_transforms};
use denavit_symbolic::print::{Style, print};

const ROBOT: &str = r#"
name = "Two links in a plane"
convention = "standard"

[parameters]
a1 = "400 mm"
a2 = "300 mm"

[[joints]]
theta = "q1"
a = "a1"

[[joints]]
theta = "q2"
a = "a2"
"#;

fn main() {
    let (robot, _notes) = match read_toml(ROBOT) {
        Ok(read) => read,
        Err(findings) => {
            println!("{}", render(&findings, "robot.toml", ROBOT));
            return;
        }
    };

    // Formulas are values; a vocabulary says how to spell them.
    let names = robot.vocabulary();
    let links = link_transforms(&robot);
    assert_eq!(print(links[0][0][3], &names, Style::Unicode), "a1C1");

    let model = ForwardModel::of_tool(&robot, Outputs::ALL);
    let matrix = model.matrix.expect("a planar arm is small");
    println!("x = {}", print(matrix[0][3], &names, Style::Unicode));
    println!("y = {}", print(matrix[1][3], &names, Style::Unicode));
    assert_eq!(print(matrix[0][3], &names, Style::Latex), "a_{1} C_{1} + a_{2} C_{12}");

    println!("{}; {:?}", model.algorithm.count(), model.proof);
    assert_eq!(model.proof, Proof::Proved);

    // The same chain over numbers.
    let numeric = Robot::numeric(&robot).expect("both lengths have values");
    let x_0t = numeric.pose(&[0.0, std::f64::consts::FRAC_PI_2]);
    println!("at q = (0, 90°): {:?}", x_0t.translation);
    assert!((x_0t.translation[0] - 0.4).abs() < 1e-15 && (x_0t.translation[1] - 0.3).abs() < 1e-15);
}
