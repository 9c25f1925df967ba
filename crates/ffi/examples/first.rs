//! What `first.c`, `first.cpp` and `first.go` print, by the library itself.

use denavit::catalogue;
use denavit::geometry::Transform;
use denavit::inverse::{Answer, Course, InverseKinematics, InverseOptions};
use denavit::velocity::{Viewpoint, geometric};
use denavit_report::words::Tongue;

fn list(numbers: &[f64]) -> String {
    numbers.iter().map(|x| format!(" {x:9.5}")).collect()
}

fn status(answer: &Answer) -> (i32, usize, usize) {
    let families = answer.families.len();
    let code = match (answer.is_reachable(), answer.is_complete()) {
        (true, true) => i32::from(families > 0),
        (true, false) => 2,
        (false, true) => 3,
        (false, false) => 4,
    };
    (code, answer.solutions.len(), families)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let description = catalogue::robot("ur5").ok_or("no UR5")?;
    let solver = InverseKinematics::new(&description, &InverseOptions::default())?;
    let robot = &solver.robot;
    println!("{}: {} joints", description.name, robot.joints);
    let q = [0.3, -1.2, 1.5, 0.4, 0.9, -0.6];
    let pose = robot.pose(&q);
    println!("tool at   {}", list(&pose.translation.0));
    let jacobian = geometric(robot, &q, &Viewpoint::tool());
    println!("vx by     {}", list(&jacobian.rows()[0]));

    let answer = solver.solve(&pose, &[]);
    println!("status {}: {} solutions, {} families", status(&answer).0, status(&answer).1, status(&answer).2);
    answer.solutions.iter().for_each(|s| println!("          {}", list(&s.q)));
    let near = q.map(|x| x + 0.1);
    let nearest = solver.nearest(&pose, &answer, &near).ok_or("a solution")?;
    println!("nearest   {}", list(&nearest.q));

    // One centimetre up, from where the joints are.
    let mut next = pose;
    next.translation.0[2] += 0.01;
    let tracked = solver.track(&next, &q).ok_or("a way")?;
    println!("followed {}          {}", i32::from(tracked.course == Course::Followed), list(&tracked.q));

    // A straight wrist, and a pose out of reach.
    let straight = [0.3, -1.2, 1.5, 0.4, 0.0, -0.6];
    let (code, solutions, families) = status(&solver.solve(&robot.pose(&straight), &[]));
    println!("status {code}: {solutions} solutions, {families} families");
    next.translation.0[0] += 3.0;
    let answer = solver.solve(&next, &[]);
    let obstacle = answer.obstacle.as_ref().ok_or("an obstacle")?;
    println!("status {}: {}", status(&answer).0, Tongue::English.words().obstacle(obstacle));

    let mut matrix = next.matrix();
    matrix[0][0] = f64::NAN;
    if let Err(why) = Transform::from_matrix(matrix) {
        println!("error -5: pose: {why}");
    }
    Ok(())
}
