//! Holding a printed formula against the robot.
//!
//! `cargo run --example 02_is_it_true -p denavit`

use denavit::catalogue;
use denavit::forward::{ForwardModel, Outputs, Reference};
use denavit_symbolic::parse::parse;
use denavit_symbolic::print::{Style, print};
use denavit_symbolic::{Equality, equal};

fn main() {
    let robot = catalogue::robot("staubli-rx90").expect("in the catalogue");
    let names = robot.vocabulary();
    let model = ForwardModel::derive(&robot, Reference::Frame(0), Reference::Frame(6), Outputs::ALL);
    let n_x = model.matrix.expect("six joints are small")[0][1];

    // As a lecture prints it: C6 and S6 are exchanged in the first bracket.
    let printed = "C1(-C23(C4C5C6 + S4S6) + S23S5S6) + S1(S4C5S6 - C4C6)";
    let claim = parse(printed, &names).expect("it can be read");
    let verdict = equal(claim, n_x);
    println!("n_x = {printed}\nis wrong: {verdict:?}");
    println!("right is {}", print(n_x, &names, Style::Unicode));
    assert!(matches!(verdict, Equality::Different { .. }));

    let corrected = "C1(-C23(C4C5S6 + S4C6) + S23S5S6) + S1(S4C5S6 - C4C6)";
    assert!(equal(parse(corrected, &names).expect("it can be read"), n_x).is_equal());
}
