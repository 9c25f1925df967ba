//! Answers to parallel robots.

use denavit::geometry::Transform;
use denavit::geometry::orientation::{OrientationSet, extract};
use denavit_parallel::{Robot, catalogue};
use denavit_wire::parallel::{Drives, Geometry, Moving, Placed, Shown, Solved, Unreached};
use denavit_wire::pose::matrix;
use denavit_wire::{Schema, catalogue::Catalogue, text};
use serde_json::Value;

/// One of each kind, with everything that an answer can have.
pub fn answers() -> Vec<String> {
    let mut all = vec![];
    for name in catalogue::names() {
        let parallel = catalogue::robot(name).expect("it is listed");
        let family = parallel.numbers().expect("all parameters have values");
        let (robot, kind) = (Robot::from(&family), parallel.family.kind());
        let drives = parallel.family.drives();
        all.push(text(&Catalogue::of([], [], []).with([(name, &parallel)])));
        all.push(text(&Shown {
            drives: (0..drives).map(|k| parallel.family.drive_name(k)).collect(),
            geometry: Geometry::from(&family),
            kind,
            limits: vec![[0.0, 1.0]],
            poses: parallel.poses.iter().map(|p| p.0.as_str()).collect(),
            robot: &parallel.name,
            schema: Schema,
            source: parallel.source.as_deref(),
        }));
        let pose = match robot {
            Robot::Stewart(_) => Transform::translation(0.1, 0.0, 0.8),
            Robot::Delta(_) => {
                Transform::translation(0.02, 0.0, if name == "linear-delta" { -0.4 } else { -0.8 })
            }
            Robot::Planar(_) => Transform::translation(0.25, 0.15, 0.0),
        };
        let solutions = robot.inverse(&pose).expect("it reaches");
        let q = &solutions[0].q;
        let found = robot.forward(q);
        let orientation = |x: &Transform<f64>| Some(extract(&x.rotation, OrientationSet::Rpy).into());
        all.push(text(&Placed::of(
            (&parallel.name, kind),
            q,
            (&found, found.is_complete()),
            Some(true),
            orientation,
        )));
        all.push(text(&Solved {
            kind,
            left_out: Some(0),
            pose: matrix(&pose),
            robot: &parallel.name,
            schema: Schema,
            solutions: solutions
                .iter()
                .map(|s| Drives {
                    mode: s.mode.clone(),
                    q: s.q.clone(),
                    residual: s.residual,
                    within_limits: Some(true),
                })
                .collect(),
            status: "solved",
            unreached: Some(Unreached { by: 0.1, leg: 1 }),
        }));
        let rates = robot.rates(&pose, q).expect("legs have lengths");
        let who = (parallel.name.as_str(), kind, "1");
        all.push(text(&Moving::of(who, &pose, q, &rates, &rates.singular())));
    }
    all
}

#[test]
fn what_is_singular_has_no_condition() {
    let parallel = catalogue::robot("octahedral-hexapod").expect("it is listed");
    let robot = Robot::from(&parallel.numbers().expect("all parameters have values"));
    let pose = Transform::translation(0.0, 0.0, 0.8) * Transform::rotation_z(std::f64::consts::FRAC_PI_2);
    let q = &robot.inverse(&pose).expect("it reaches")[0].q;
    let rates = robot.rates(&pose, q).expect("legs have lengths");
    let answer = text(&Moving::of(("x", "gough-stewart", "1"), &pose, q, &rates, &rates.singular()));
    let answer: Value = serde_json::from_str(&answer).expect("JSON");
    assert!(answer["condition"].is_null() && answer["jacobian"].is_null(), "{answer}");
    assert!(
        answer["gained"][0]["pitch"].is_number() && answer["j_x"].as_array().is_some_and(|r| r.len() == 6),
        "{answer}"
    );
}
