//! Files of parallel robots: what is read, and what is said of what cannot be.

use denavit::description::parallel::Place;
use denavit::description::{Diagnostic, read_parallel, read_robot, render};
use denavit::geometry::Transform;
use denavit_parallel::{Robot, catalogue};

#[test]
fn the_catalogue_is_read_and_its_poses_close() {
    for name in catalogue::names() {
        let (parallel, findings) = read_parallel(catalogue::text(name).expect("it is listed"))
            .expect("it has a kind")
            .unwrap_or_else(|found| {
                panic!("{}", render(&found, name, catalogue::text(name).unwrap_or_default()))
            });
        assert!(findings.is_empty() && parallel.source.is_some(), "{name}: {findings:?}");
        let robot = Robot::from(&parallel.numbers().expect("all parameters have values"));
        assert!(!parallel.poses.is_empty(), "{name}");
        for (pose, place) in &parallel.poses {
            let number = |e| parallel.number(e).expect("no parameters");
            let q = match place {
                Place::Drives(q) => q.iter().map(|&e| number(e)).collect(),
                Place::Platform(x) => robot.inverse(&x.map(number)).expect("it reaches")[0].q.clone(),
            };
            let found = robot.forward(&q);
            // Where solutions meet, nothing is proved.
            assert_eq!(found.is_complete(), pose != "fichter", "{name} {pose}: {:?}", found.known);
            let is_own = |x: &Transform<f64>| match place {
                Place::Platform(own) => crate::apart(x, &own.map(number)) < 1e-4,
                Place::Drives(_) => true,
            };
            assert!(found.all.iter().any(|a| is_own(&a.pose)), "{name} {pose}: {found:?}");
            assert!(found.all.iter().all(|a| robot.open(&a.pose, &q) < 1e-10), "{name} {pose}: {found:?}");
            for limits in &parallel.limits {
                let [least, most] = limits.map(number);
                assert!(q.iter().all(|q| (least..=most).contains(q)), "{name} {pose}: {q:?}");
            }
        }
    }
}

fn errors(text: &str) -> Vec<Diagnostic> {
    match read_parallel(text) {
        Some(Err(found)) => found,
        other => panic!("{text}: {other:?}"),
    }
}

/// The line of a message, and a part of it or of its hint.
fn said(text: &str, wanted: &[(usize, &str)]) {
    let found = errors(text);
    for (line, part) in wanted {
        let is_there = found.iter().any(|d| {
            let at = denavit::description::line_column(text, d.span.start).0;
            let whole = format!("{} {}", d.message, d.hint.as_deref().unwrap_or_default());
            at == *line && whole.contains(part)
        });
        assert!(is_there, "line {line}: {part}\n{}", render(&found, "file", text));
    }
    assert_eq!(found.len(), wanted.len(), "{}", render(&found, "file", text));
}

#[test]
fn what_is_wrong_is_said_all_at_once_with_its_place() {
    said("kind = \"hexapod\"", &[(1, "did you mean \"gough-stewart\"?")]);
    said("kind = \"scara\"", &[(1, "a parallel robot is \"gough-stewart\", \"delta\" or \"planar-3rrr\"")]);
    said("kind = 3", &[(1, "text in quotes")]);
    said("kind = \"delta\"\nkind = \"delta\"", &[(2, "`kind` is given twice")]);
    said("kind = \"delta\"\nbase_radius = [", &[(2, "not TOML")]);
    said(
        "kind = \"gough-stewart\"\nbase = [[0, 0, 0]]\nplatform = [[0,0,0],[0,0],[1,0,\"1 kg\"],[0,0,0],[0,0,0],[\"a\",0,0]]\n\
         legs = 3\n[poses]\nhome = [1, 2]",
        &[
            (2, "6 points [x, y, z], not 1"),
            (3, "3 values, not 2"),
            (3, "kg"),
            (4, "did you mean `limits`?"),
            (3, "`a`"),
        ],
    );
    said(
        "kind = \"delta\"\nbase_radius = \"-0.2 m\"\nplatform_radius = 0.1\nlower_arm = 0\nupper_arm = \"20 deg\"\nangles = [0, 1]\n\
         limits = [\"90 deg\", 0]",
        &[(2, "not less than 0"), (4, "greater than 0"), (5, "a length"), (6, "3 values, not 2")],
    );
    said(
        "kind = \"delta\"\nbase_radius = 0.2\nplatform_radius = 0.1",
        &[(1, "`lower_arm` is missing"), (1, "how are the arms driven?")],
    );
    said(
        "kind = \"delta\"\nbase_radius = 0.2\nplatform_radius = 0.1\nlower_arm = 0.5\nupper_arm = 0.2\nslope = 1\n[[joints]]\ntheta = \"q1\"",
        &[(6, "`slope` beside `upper_arm`"), (7, "has no rows")],
    );
    let planar = "kind = \"planar-3rrr\"\nbase = [[0,0],[1,0],[0,1]]\nplatform = [[0,0],[1,0],[0,1]]\nproximal = [1, 1]\ndistal = \"L\"\n";
    said(planar, &[(4, "3 values, not 2"), (5, "`L`")]);
    let good = planar.replace("[1, 1]", "1").replace("\"L\"", "1");
    assert!(read_parallel(&good).is_some_and(|r| r.is_ok()));
    said(&format!("{good}limits = [1, 2, 3]"), &[(6, "3 of such pairs")]);
    said(&format!("{good}limits = [2, 1]"), &[(6, "the first limit is the least")]);
    said(
        &format!("{good}[poses]\na = {{ xyz = [0, 0, 1] }}\nb = [1]"),
        &[(7, "in the plane"), (8, "1 values for 3 drives")],
    );
    said(&format!("{good}[parameters]\nq1 = 3"), &[(7, "named like a joint variable")]);
}

#[test]
fn parameters_have_values_or_are_missed() {
    let text = catalogue::text("planar-3rrr").expect("it is listed");
    let open = text.replace("\"0.15 m\"", "\"\"");
    let (mut parallel, _) = read_parallel(&open).expect("a kind").expect("it is read");
    assert_eq!(parallel.numbers().expect_err("e has no value").parameters, ["e"]);
    parallel.set("e", "150 mm").expect("a length");
    let known = catalogue::robot("planar-3rrr").expect("it is listed");
    assert_eq!(parallel.numbers(), known.numbers());
    assert!(parallel.set("x", "1").is_err() && parallel.set("e", "3 deg").is_err());
}

#[test]
fn other_readers_say_what_it_is() {
    let found = read_robot(catalogue::text("dietmaier").expect("it is listed")).expect_err("no chain");
    assert!(found.len() == 1 && found[0].message.contains("a parallel robot"), "{found:?}");
    assert!(found[0].hint.as_deref().is_some_and(|h| h.contains("`fk`")), "{found:?}");
    // A chain has no `kind`.
    assert!(
        read_parallel("name = \"x\"").is_none()
            && read_parallel("").is_none()
            && read_parallel("kind").is_none()
    );
}

#[test]
fn legs_have_no_negative_lengths() {
    let text = catalogue::text("dietmaier").expect("it is listed").replace("forty = [1,", "forty = [-1,");
    let found = errors(&text);
    assert!(found.len() == 1 && found[0].message == "the length of a leg is not negative", "{found:?}");
}

/// Texts that nobody should write end, and end without a panic.
#[test]
fn hostile_files_end() {
    let many = "[0,0,0],".repeat(60_000);
    let deep = format!("kind = \"delta\"\nlimits = {}{}", "[".repeat(5_000), "]".repeat(5_000));
    let texts = [
        format!("kind = \"gough-stewart\"\nbase = [{many}]\nplatform = [{many}]"),
        deep,
        format!("kind = \"{}\"", "x".repeat(500_000)),
        format!("kind = \"delta\"\nlower_arm = \"{}\"", "(".repeat(900)),
        "kind = \"delta\"\nbase_radius = 1e999\nplatform_radius = nan\nlower_arm = inf\nupper_arm = 1e-320".into(),
        "kind = \"delta\"\nbase_radius = 1e308\nplatform_radius = 1e308\nlower_arm = 1e308\nupper_arm = 1e308".into(),
        "kind = \"delta\"\nslope = \"1/0\"\nlower_arm = \"sqrt(-1)\"\nbase_radius = \"0/0\"\nplatform_radius = \"a\"\n[parameters]\na = \"a\"".into(),
        format!("kind = \"planar-3rrr\"\n[poses]\n{}", (0..2_000).map(|k| format!("p{k} = [1e400]\n")).collect::<String>()),
        "kind = \"delta\"\n\u{0}\u{202e}".into(),
    ];
    for text in texts {
        if let Some(Ok((parallel, _))) = read_parallel(&text)
            && let Ok(family) = parallel.numbers()
        {
            let robot = Robot::from(&family);
            let q = vec![0.5; if matches!(robot, Robot::Stewart(_)) { 6 } else { 3 }];
            let _ = robot.forward(&q);
        }
    }
    // Numbers of any size in what is asked.
    for name in catalogue::names() {
        let robot = Robot::from(&catalogue::robot(name).expect("listed").numbers().expect("values"));
        let count = if matches!(robot, Robot::Stewart(_)) { 6 } else { 3 };
        for x in [0.0, 1e-300, 1e300, f64::MAX, f64::INFINITY, f64::NAN, -1.0] {
            let found = robot.forward(&vec![x; count]);
            assert!(found.all.iter().all(|a| a.residual.is_finite()), "{name} {x}: {found:?}");
            if !x.is_finite() {
                assert!(found.all.is_empty(), "{name} {x}: {found:?}");
            }
        }
    }
}
