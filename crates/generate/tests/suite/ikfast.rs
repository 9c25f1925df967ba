//! Files with IKFast's interface: built, held to their own test, to the library, and to what those expect that include them.

use crate::common::{Random, robot, share};
use crate::packages::{self, folder, run};
use denavit::Description;
use denavit::inverse::{Goal, InverseKinematics, InverseOptions};
use denavit::robot::Robot;
use denavit::space::JointSpace;
use denavit_emit::Language;
use denavit_generate::{Generated, PackageOptions, Unable, Wanted, generate};
use std::f64::consts::PI;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The largest file and the longest build that are allowed.
const LARGEST: usize = 300_000;
/// The command that the tests build with, beside `make`.
const COMPILER: &[&str] =
    &["-O1", "-std=c++11", "-Wall", "-Wextra", "-Werror", "-pedantic", "-isystem", "interface"];

fn options(goal: Goal) -> PackageOptions {
    PackageOptions {
        inverse: InverseOptions { goal, given: None },
        ..packages::options(Language::IkFast, &[Wanted::Pose, Wanted::Inverse])
    }
}

fn generated(d: &Description, goal: Goal) -> Generated {
    generate(d, &options(goal)).expect("parameters have values")
}

/// A folder of its own with the files.
fn written(name: &str, generated: &Generated) -> PathBuf {
    assert!(!generated.files.is_empty(), "{name}: {:?}", generated.refused);
    for file in &generated.files {
        assert!(file.text.len() <= LARGEST, "{name}: {} has {} bytes", file.path, file.text.len());
    }
    folder(&format!("ikfast-{name}"), &generated.files)
}

/// Builds a program from a text and runs it.
fn program(folder: &Path, text: &str, flags: &[&str]) -> String {
    fs::write(folder.join("driver.cpp"), text).expect("it can be written");
    let mut compiler = Command::new("c++");
    compiler.args(COMPILER).args(flags).args(["driver.cpp", "-o", "driver"]);
    run(compiler.current_dir(folder));
    run(Command::new("./driver").current_dir(folder))
}

/// Arms of every kind of goal with the type that is theirs; the first ones in every run.
const ARMS: &[(&str, Goal, &str)] = &[
    ("ur5", Goal::Pose, "0x67000001"),
    ("scara", Goal::Pose, "0x4400000e"),
    ("franka-panda", Goal::Pose, "0x67000001"),
    ("kuka-kr6-r900", Goal::Pose, "0x67000001"),
    ("fanuc-crx10ia-l", Goal::Pose, "0x67000001"),
    ("stanford", Goal::Pose, "0x67000001"),
    ("adept-cobra-600", Goal::Pose, "0x4400000e"),
    ("ur5", Goal::PositionAndAxis, "0x56000007"),
    ("articulated-3r", Goal::Position, "0x33000003"),
];

#[test]
fn files_pass_their_own_test() {
    for (name, goal, kind) in &ARMS[..share(ARMS.len(), 2)] {
        let found = generated(&robot(name), *goal);
        let folder = written(name, &found);
        let main = &found.files[0];
        assert!(main.path == "arm.cpp" && main.text.contains(&format!("return {kind};")), "{name}");
        let said = run(Command::new("make").args(["test", "CXXFLAGS=-O1"]).current_dir(folder));
        assert!(said.contains("all configurations agree"), "{name}: {said}");
    }
}

/// What plug-ins do: they include the file in a namespace of theirs, use the names of `ikfast.h` without prefix, and take solutions
/// with free values of their own.
const PLUGIN: &str = r#"
#include <cmath>
#include <cstdio>
#include <vector>
namespace plugin {
static int doubtful = 0;
#define IKFAST_ASSERT(condition) { if (!(condition)) { doubtful++; } }
#define IKFAST_NO_MAIN
#include "arm.cpp"

/* The families among the solutions for the pose of q: how many of them, with 1 in `is_wrong` for a member that misses it. */
static int families(const double *q, int first, int second, int &is_wrong)
{
    double trans[3], rot[9], other_trans[3], other_rot[9];
    ComputeFk(q, trans, rot);
    IkSolutionList<IkReal> solutions;
    if (!ComputeIk(trans, rot, NULL, solutions)) {
        return -1;
    }
    int count = 0;
    for (size_t s = 0; s < solutions.GetNumSolutions(); s++) {
        const IkSolutionBase<IkReal> &solution = solutions.GetSolution(s);
        if (solution.GetFree().empty()) {
            continue;
        }
        count += solution.GetFree().size() == 1 && solution.GetFree()[0] == first;
        double before[6] = {0}, joints[6];
        for (int step = -3; step <= 3; step++) {
            const double value = step;
            solution.GetSolution(joints, &value);
            ComputeFk(joints, other_trans, other_rot);
            for (int k = 0; k < 9; k++) {
                is_wrong |= std::fabs(other_rot[k] - rot[k]) > 1e-9 || std::fabs(other_trans[k % 3] - trans[k % 3]) > 1e-9;
            }
            for (int j = 0; j < 6 && step > -3; j++) {
                /* The two joints move, and no other. */
                is_wrong |= (joints[j] != before[j]) != (j == first || j == second);
            }
            for (int j = 0; j < 6; j++) {
                before[j] = joints[j];
            }
        }
    }
    return count;
}
} // namespace plugin

#if defined(INLINE) || defined(FUSED) || defined(DENAVIT_INLINE) || defined(DENAVIT_FUSED) || defined(ARM_SOLVE_MAX)
#error "macros leak"
#endif

int main()
{
    /* The wrist straight: joints 4 and 6 turn about one line. */
    const double straight[6] = {0.4, -1.1, 0.7, 0.3, 0.0, 0.5};
    const double bent[6] = {0.4, -1.1, 0.7, 0.3, 0.9, 0.5};
    int is_wrong = 0;
    const int found = plugin::families(straight, 3, 5, is_wrong);
    const int none = plugin::families(bent, 3, 5, is_wrong);
    const double rot[9] = {1, 0, 0, 0, 1, 0, 0, 0, 2};
    plugin::ikfast::IkSolutionList<double> solutions;
    const bool is_reached = plugin::ComputeIk(straight, rot, NULL, solutions);
    std::printf("%d %d %d %d %d\n", found > 0, none, is_wrong, is_reached ? 1 : 0, plugin::doubtful);
    return 0;
}
"#;

#[test]
fn families_are_told_by_free_values_inside_of_any_namespace() {
    let folder = written("families", &generated(&robot("kuka-kr6-r900"), Goal::Pose));
    assert_eq!(program(&folder, PLUGIN, &[]).trim(), "1 0 0 0 1");
    // The namespace of the interface, its types, and a library without C++ names.
    for flags in [&["-DIKFAST_NAMESPACE=inner", "-DIKFAST_REAL=float"][..], &["-DIKFAST_CLIBRARY", "-fPIC"]] {
        let mut compiler = Command::new("c++");
        compiler.args(COMPILER).args(flags).args(["-c", "arm.cpp", "-o", "arm.o"]);
        run(compiler.current_dir(&folder));
    }
}

/// Reads goals (3, 9 and the values of given joints a line), writes the joints of all solutions of each.
const DRIVER: &str = r#"
#define IKFAST_NO_MAIN
#include "arm.cpp"
#include <cstdio>
#include <vector>
int main()
{
    std::vector<double> goal(12 + GetNumFreeParameters()), joints(GetNumJoints());
    ikfast::IkSolutionList<double> solutions;
    for (;;) {
        for (std::size_t k = 0; k < goal.size(); k++) {
            if (std::scanf("%lf", &goal[k]) != 1) {
                return 0;
            }
        }
        ComputeIk(&goal[0], &goal[3], goal.data() + 12, solutions);
        for (std::size_t s = 0; s < solutions.GetNumSolutions(); s++) {
            const std::vector<double> none(solutions.GetSolution(s).GetFree().size() + 1);
            solutions.GetSolution(s).GetSolution(&joints[0], &none[0]);
            for (std::size_t j = 0; j < joints.size(); j++) {
                std::printf("%.17g ", joints[j]);
            }
        }
        std::printf("\n");
    }
}
"#;

/// Of what random poses the arm's file gives other solutions than the library, which is certain of its own.
fn differing(name: &str, count: usize) -> (usize, usize) {
    let d = robot(name);
    let folder = written(&format!("many-{name}"), &generated(&d, Goal::Pose));
    let numeric = Robot::numeric(&d).expect("parameters have values");
    let space = JointSpace::new(&d, &numeric);
    let given = generated(&d, Goal::Pose).inverse.expect("it has one").given;
    let given: Vec<usize> =
        given.iter().filter_map(|s| d.variables().iter().position(|v| v.symbol == *s)).collect();
    let options = InverseOptions { goal: Goal::Pose, given: Some(given.clone()).filter(|g| !g.is_empty()) };
    let solver = InverseKinematics::new(&d, &options).expect("it has one");
    let mut random = Random(23);
    let mut value = |is_angle| if is_angle { PI * (2.0 * random.unit() - 1.0) } else { 0.5 * random.unit() };
    let all: Vec<Vec<f64>> =
        (0..count).map(|_| space.is_angle.iter().map(|&is_angle| value(is_angle)).collect()).collect();
    let is_turn = name == "scara";
    let mut input = String::new();
    for q in &all {
        let pose = numeric.pose(q);
        let r = pose.rotation.rows();
        pose.translation.0.iter().for_each(|x| write!(input, "{x:e} ").expect("text"));
        let mut rotation = r.concat();
        if is_turn {
            rotation[0] = r[1][0].atan2(r[0][0]);
        }
        rotation.iter().for_each(|x| write!(input, "{x:e} ").expect("text"));
        given.iter().for_each(|&j| write!(input, "{:e} ", q[j]).expect("text"));
        input.push('\n');
    }
    fs::write(folder.join("goals"), input).expect("it can be written");
    fs::write(folder.join("driver.cpp"), DRIVER).expect("it can be written");
    let mut compiler = Command::new("c++");
    compiler.args(COMPILER).args(["-Wno-unused-result", "-O2", "driver.cpp", "-o", "driver"]);
    run(compiler.current_dir(&folder));
    let said = run(Command::new("sh").args(["-c", "./driver < goals"]).current_dir(&folder));
    let (mut wrong, mut missing) = (0, 0);
    let lines: Vec<&str> = said.lines().collect();
    assert_eq!(lines.len(), count);
    for (q, line) in all.iter().zip(lines) {
        let numbers: Vec<f64> = line.split_whitespace().map(|x| x.parse().expect("a number")).collect();
        let found: Vec<&[f64]> = numbers.chunks(numeric.joints).collect();
        let values: Vec<f64> = given.iter().map(|&j| q[j]).collect();
        let known = solver.solve(&numeric.pose(q), &values).solutions;
        let is_near = |a: &[f64], b: &[f64]| space.distance(a, b) <= 1e-6;
        let is_same =
            known.len() == found.len() && known.iter().all(|s| found.iter().any(|f| is_near(f, &s.q)));
        wrong += usize::from(!is_same);
        missing += usize::from(!found.iter().any(|f| is_near(f, q)));
    }
    (wrong, missing)
}

/// A hundred thousand poses an arm (a soak): the library's solutions, all of them and no others.
#[test]
fn files_give_what_the_library_gives() {
    let arms: &[&str] = &["scara", "ur5", "franka-panda", "kuka-kr6-r900", "fanuc-crx10ia-l"];
    for name in &arms[..share(arms.len(), 1)] {
        let count = share(100_000, 2_000);
        let (wrong, missing) = differing(name, count);
        println!(
            "{name}: {count} poses, {wrong} with other solutions than the library's, {missing} without their own configuration"
        );
        assert_eq!((wrong, missing), (0, 0), "{name}");
    }
}

/// What IKFast has no type for is refused in words; what takes parameters has their values or none.
#[test]
fn what_the_interface_has_not_is_refused() {
    for (name, goal, words) in [
        ("parallelogram-5r", Goal::Pose, "5 directions"),
        ("articulated-3r", Goal::Pose, "3 directions; --goal position"),
        ("planar-3r", Goal::Pose, "Transform6D takes six directions"),
        ("planar-2r", Goal::Position, "Translation3D takes three directions"),
    ] {
        let found = generated(&robot(name), goal);
        let why = found.refused.expect("a reason");
        assert!(found.files.is_empty() && why.contains(words), "{name}: {why}");
    }
    let jacobian = PackageOptions { functions: vec![Wanted::Pose, Wanted::Jacobian], ..options(Goal::Pose) };
    let refused = generate(&robot("ur5"), &jacobian).map(|_| ());
    assert_eq!(refused, Err(Unable::NotInInterface(Wanted::Jacobian)));
}
