//! Results against what the robot computes of a row alone, in numbers.

use super::common::{batch, fk, joints, mapping, numbers, run, ur5};
use arrow_array::builder::{FixedSizeListBuilder, Float32Builder, Float64Builder, ListBuilder};
use arrow_array::cast::AsArray;
use arrow_array::types::{Float64Type, Int32Type};
use arrow_array::{Array, ArrayRef, Float32Array, Float64Array, Int64Array, RecordBatch, StringArray};
use arrow_schema::{DataType, Field, Schema};
use denavit::Robot;
use denavit::description::{Convention, Decimals, read_urdf};
use denavit::dynamics::{Dynamics, inverse_dynamics};
use denavit::forward::Reference;
use denavit::geometry::orientation::{OrientationSet, extract};
use denavit::velocity::{Viewpoint, geometric};
use denavit_map::{Angle, Frame, Inverse, Keep, Length, Names, Orientation, Request, Solutions, Units};
use std::sync::Arc;

const ENTRIES: [&str; 9] = ["r11", "r12", "r13", "r21", "r22", "r23", "r31", "r32", "r33"];

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-12
}

#[test]
fn poses_are_the_robots() {
    // Not a multiple of any number of lanes.
    let rows = 1003;
    let input = run(rows, 7);
    let bound = mapping(&fk()).bind(&input.schema()).expect("bound");
    let (out, counts) = bound.run(&input).expect("computed");
    assert_eq!((counts.rows, counts.faults()), (rows as u64, 0));
    let names: Vec<&str> = out.schema_ref().fields().iter().map(|f| f.name().as_str()).collect();
    let own = ["time", "q1", "q2", "q3", "q4", "q5", "q6", "x", "y", "z"];
    assert_eq!(names, [&own[..], &ENTRIES[..]].concat());
    let robot = Robot::numeric(&ur5()).expect("numbers");
    let q = joints(rows, 7);
    for row in 0..rows {
        let at: Vec<f64> = q.iter().map(|c| c[row]).collect();
        let pose = robot.pose(&at);
        for (k, name) in ["x", "y", "z"].into_iter().enumerate() {
            assert!(near(numbers(&out, name)[row].expect("a number"), pose.translation.0[k]), "{name} {row}");
        }
        if row % 100 == 0 {
            for (k, name) in ENTRIES.into_iter().enumerate() {
                let entry = pose.rotation.rows()[k / 3][k % 3];
                assert!(near(numbers(&out, name)[row].expect("a number"), entry), "{name} {row}");
            }
        }
    }
}

/// A row's bits do not depend on which rows are around it.
#[test]
fn a_row_has_the_same_bits_wherever_it_stands() {
    let input = run(5000, 3);
    let request = Request {
        orientation: Orientation::Vector,
        manipulability: true,
        jacobian: Some(Frame::tool()),
        ..fk()
    };
    let bound = mapping(&request).bind(&input.schema()).expect("bound");
    let whole = bound.run(&input).expect("computed").0;
    for (first, count) in [(0, 1), (1, 7), (4999, 1), (123, 1000)] {
        let part = bound.run(&input.slice(first, count)).expect("computed").0;
        assert_eq!(part, whole.slice(first, count));
    }
}

#[test]
fn orientations_in_every_set() {
    let input = run(40, 11);
    let robot = Robot::numeric(&ur5()).expect("numbers");
    let q = joints(40, 11);
    let sets = OrientationSet::ALL.map(Orientation::Set);
    for orientation in sets.into_iter().chain([Orientation::Vector]) {
        let request = Request { orientation, keep: Keep::Some(vec![]), ..fk() };
        let out = mapping(&request).bind(&input.schema()).expect("bound").run(&input).expect("computed").0;
        for row in 0..40 {
            let pose = robot.pose(&q.iter().map(|c| c[row]).collect::<Vec<_>>());
            let wanted = match orientation {
                Orientation::Set(set) => extract(&pose.rotation, set).values,
                Orientation::Vector => {
                    let v = extract(&pose.rotation, OrientationSet::AxisAngle).values;
                    vec![v[0] * v[3], v[1] * v[3], v[2] * v[3]]
                }
            };
            for (name, x) in orientation.names().iter().zip(wanted) {
                let found = numbers(&out, name)[row].expect("a number");
                assert!((found - x).abs() < 1e-9, "{orientation} {name} {row}: {found} {x}");
            }
        }
    }
}

#[test]
fn frames_that_are_asked_for() {
    let input = run(9, 5);
    let offset = denavit::geometry::Transform::translation(0.1, 0.0, -0.2);
    let third = Frame { label: "f3".into(), on: Reference::Frame(3), offset: None };
    let other = Frame { label: "camera".into(), on: Reference::Frame(3), offset: Some(offset) };
    let request = Request { poses: vec![third, other], keep: Keep::Some(vec![]), ..Request::default() };
    let out = mapping(&request).bind(&input.schema()).expect("bound").run(&input).expect("computed").0;
    let robot = Robot::numeric(&ur5()).expect("numbers");
    let q = joints(9, 5);
    for row in 0..9 {
        let at: Vec<f64> = q.iter().map(|c| c[row]).collect();
        let frame = robot.frames(&at)[3];
        for (label, pose) in [("f3", frame), ("camera", frame * offset)] {
            for (k, name) in ["x", "y", "z"].into_iter().enumerate() {
                let found = numbers(&out, &format!("{label}_{name}"))[row].expect("a number");
                assert!(near(found, pose.translation.0[k]), "{label} {name}");
            }
        }
    }
}

#[test]
fn jacobians_and_torques_are_the_robots() {
    let text = include_str!("../../../robot/tests/urdf/ur10_robot.urdf");
    let mechanism = read_urdf(text, Decimals::Meant).expect("a URDF").0;
    let d = mechanism.chain(None, Some("tool0"), Convention::Standard).expect("a chain").description;
    let rows = 50;
    let (q, qd, qdd) = (joints(rows, 1), joints(rows, 2), joints(rows, 3));
    let names = |letter: &str| (1..=6).map(|k| format!("{letter}{k}")).collect::<Vec<_>>();
    let all: Vec<String> = ["q", "qd", "qdd"].into_iter().flat_map(names).collect();
    let columns: Vec<(&str, Vec<f64>)> =
        all.iter().map(String::as_str).zip(q.iter().chain(&qd).chain(&qdd).cloned()).collect();
    let input = batch(&columns);
    let request = Request {
        jacobian: Some(Frame::tool()),
        manipulability: true,
        torque: true,
        keep: Keep::Some(vec![]),
        ..Request::default()
    };
    let mapping = denavit_map::Mapping::new(&d, &request).expect("a mapping");
    let out = mapping.bind(&input.schema()).expect("bound").run(&input).expect("computed").0;
    let robot = Robot::numeric(&d).expect("numbers");
    let dynamics = Dynamics::numeric(&d).expect("masses");
    for row in 0..rows {
        let at = |c: &Vec<Vec<f64>>| c.iter().map(|c| c[row]).collect::<Vec<f64>>();
        let jacobian = geometric(&robot, &at(&q), &Viewpoint::tool());
        for (r, row_name) in denavit::velocity::ROWS.into_iter().enumerate() {
            for c in 0..6 {
                let found = numbers(&out, &format!("{row_name}_q{}", c + 1))[row].expect("a number");
                assert!(near(found, jacobian.columns[c][r]), "{row_name} {c}");
            }
        }
        let torques = inverse_dynamics(&dynamics, &at(&q), &at(&qd), &at(&qdd), None);
        for (k, wanted) in torques.into_iter().enumerate() {
            let found = numbers(&out, &format!("tau_q{}", k + 1))[row].expect("a number");
            assert!((found - wanted).abs() < 1e-9 * (1.0 + wanted.abs()), "{found} {wanted}");
        }
        let space = denavit::space::JointSpace::new(&d, &robot);
        let whole = denavit::velocity::Whole::new(&jacobian, &space.is_angle, space.length());
        let found = numbers(&out, "manipulability")[row].expect("a number");
        assert!((found - whole.manipulability).abs() < 1e-9);
    }
}

#[test]
fn all_solutions_have_the_pose() {
    let rows = 20;
    let input = run(rows, 9);
    let request = Request { orientation: "quaternion".parse().expect("a set"), ..fk() };
    let poses = mapping(&request).bind(&input.schema()).expect("bound").run(&input).expect("computed").0;
    let wish = |solutions| Request {
        inverse: Some(Inverse { solutions, limits: false }),
        orientation: request.orientation,
        keep: Keep::Some(vec![]),
        ..Request::default()
    };
    let bound = mapping(&wish(Solutions::Lists)).bind(&poses.schema()).expect("bound");
    let out = bound.run(&poses).expect("computed").0;
    let slots = mapping(&wish(Solutions::Slots(8))).bind(&poses.schema()).expect("bound");
    let slots = slots.run(&poses).expect("computed").0;
    let nearest = mapping(&wish(Solutions::Nearest)).bind(&poses.schema()).expect("bound");
    let nearest = nearest.run(&poses).expect("computed").0;
    let robot = Robot::numeric(&ur5()).expect("numbers");
    let counts = out.column_by_name("ik_count").expect("counts").as_primitive::<Int32Type>();
    let q = joints(rows, 9);
    for row in 0..rows {
        let status = out.column_by_name("ik_status").expect("a status").as_string::<i32>();
        assert_eq!(status.value(row), "solved");
        let wanted = robot.pose(&q.iter().map(|c| c[row]).collect::<Vec<_>>());
        let solutions = out.column_by_name("ik").expect("solutions").as_list::<i32>().value(row);
        let solutions = solutions.as_list::<i32>();
        assert_eq!(solutions.len() as i32, counts.value(row));
        assert!(!solutions.is_empty());
        for k in 0..solutions.len() {
            let one = solutions.value(k);
            let one = one.as_primitive::<Float64Type>();
            let pose = robot.pose(one.values());
            for j in 0..3 {
                assert!((pose.translation.0[j] - wanted.translation.0[j]).abs() < 1e-9);
            }
            // The same in places of their own, to the bit.
            for j in 0..6 {
                let name = format!("ik{}_q{}", k + 1, j + 1);
                assert_eq!(numbers(&slots, &name)[row], Some(one.value(j)));
            }
        }
        let behind = format!("ik{}_q1", solutions.len() + 1);
        assert!(solutions.len() == 8 || numbers(&slots, &behind)[row].is_none());
        for (j, own) in q.iter().enumerate() {
            let found = numbers(&nearest, &format!("ik_q{}", j + 1))[row].expect("a number");
            assert!((found - own[row]).abs() < 1e-6, "{row} {j}: {found} {}", own[row]);
        }
    }
}

#[test]
fn poses_that_are_out_of_reach_or_none() {
    let input = batch(&[
        ("x", vec![5.0, 0.3, f64::NAN]),
        ("y", vec![0.0; 3]),
        ("z", vec![0.0; 3]),
        ("qx", vec![0.0; 3]),
        ("qy", vec![0.0; 3]),
        ("qz", vec![0.0; 3]),
        ("qw", vec![1.0, 0.0, 1.0]),
    ]);
    let request = Request {
        inverse: Some(Inverse { solutions: Solutions::Lists, limits: false }),
        orientation: "quaternion".parse().expect("a set"),
        ..Request::default()
    };
    let (out, counts) =
        mapping(&request).bind(&input.schema()).expect("bound").run(&input).expect("computed");
    assert_eq!((counts.no_pose, counts.not_finite, counts.first_fault), (1, 1, Some(1)));
    let status = out.column_by_name("ik_status").expect("a status").as_string::<i32>();
    assert_eq!(status.value(0), "unreachable");
    assert!(out.column_by_name("ik_complete").expect("said").as_boolean().value(0));
    assert!(status.is_null(1) && status.is_null(2));
    assert!(out.column_by_name("ik").expect("solutions").is_null(1));
}

#[test]
fn units_of_columns() {
    let input = run(30, 4);
    let plain = mapping(&fk()).bind(&input.schema()).expect("bound").run(&input).expect("computed").0;
    let q = joints(30, 4);
    let degrees: Vec<Vec<f64>> = q.iter().map(|c| c.iter().map(|x| x.to_degrees()).collect()).collect();
    let names = |suffix: &str| (1..=6).map(|k| format!("q{k}{suffix}")).collect::<Vec<String>>();
    let units = Units { angle: Angle::Degree, length: Length::Millimetre };
    for (suffix, units) in
        [("|deg", Units::default()), ("_deg", Units::default()), (" [deg]", Units::default()), ("", units)]
    {
        let names = names(suffix);
        let input = batch(&names.iter().map(String::as_str).zip(degrees.clone()).collect::<Vec<_>>());
        let request = Request { units, ..fk() };
        let bound = mapping(&request).bind(&input.schema()).expect("bound");
        let out = bound.run(&input).expect("computed").0;
        let factor = if suffix.is_empty() { 1000.0 } else { 1.0 };
        let unit = &out.schema_ref().field_with_name("x").expect("a column").metadata()["unit"];
        assert_eq!(unit, if suffix.is_empty() { "mm" } else { "m" });
        for (a, b) in numbers(&out, "x").into_iter().zip(numbers(&plain, "x")) {
            assert!((a.expect("a number") - factor * b.expect("a number")).abs() < 1e-9);
        }
    }
    // What a column says counts more than what is said of all; a unit that is none is refused.
    let names = names("|furlong");
    let input = batch(&names.iter().map(String::as_str).zip(q).collect::<Vec<_>>());
    let why = mapping(&fk()).bind(&input.schema()).err().expect("refused").to_string();
    assert!(why.contains("furlong") && why.contains("hint"), "{why}");
}

#[test]
fn rows_without_numbers_have_nulls_and_are_counted() {
    let q = joints(6, 2);
    let mut arrays: Vec<ArrayRef> =
        q.iter().map(|c| Arc::new(Float64Array::from(c.clone())) as ArrayRef).collect();
    let mut third: Vec<Option<f64>> = q[2].iter().copied().map(Some).collect();
    third[1] = None;
    third[3] = Some(f64::NAN);
    third[4] = Some(f64::INFINITY);
    arrays[2] = Arc::new(Float64Array::from(third));
    arrays.push(Arc::new(StringArray::from(vec!["a", "b", "c", "d", "e", "f"])));
    let fields: Vec<Field> = (1..=6)
        .map(|k| Field::new(format!("q{k}"), DataType::Float64, true))
        .chain([Field::new("note", DataType::Utf8, true)])
        .collect();
    let input = RecordBatch::try_new(Arc::new(Schema::new(fields)), arrays).expect("a batch");
    let (out, counts) = mapping(&fk()).bind(&input.schema()).expect("bound").run(&input).expect("computed");
    assert_eq!((counts.rows, counts.nulls, counts.not_finite, counts.first_fault), (6, 1, 2, Some(1)));
    let x = numbers(&out, "x");
    assert_eq!(x.iter().map(Option::is_some).collect::<Vec<_>>(), [true, false, true, false, false, true]);
    // What goes through goes through as it is.
    assert_eq!(out.column_by_name("note"), input.column_by_name("note"));
    assert_eq!(out.column_by_name("q3"), input.column_by_name("q3"));
}

#[test]
fn joints_in_lists_and_other_types() {
    let q = joints(10, 8);
    let wide: Vec<Vec<f64>> = q.iter().map(|c| c.iter().map(|x| f64::from(*x as f32)).collect()).collect();
    let names: Vec<String> = (1..=6).map(|k| format!("q{k}")).collect();
    let plain = batch(&names.iter().map(String::as_str).zip(wide).collect::<Vec<_>>());
    let request = Request { keep: Keep::Some(vec![]), ..fk() };
    let wanted = mapping(&request).bind(&plain.schema()).expect("bound").run(&plain).expect("computed").0;
    let mut fixed = FixedSizeListBuilder::new(Float32Builder::new(), 6);
    let mut lists = ListBuilder::new(Float32Builder::new());
    for row in 0..10 {
        for c in &q {
            fixed.values().append_value(c[row] as f32);
            lists.values().append_value(c[row] as f32);
        }
        fixed.append(true);
        lists.append(true);
    }
    let singles =
        q.iter().map(|c| Arc::new(Float32Array::from_iter_values(c.iter().map(|x| *x as f32))) as ArrayRef);
    let of = |columns: Vec<(&str, ArrayRef)>| RecordBatch::try_from_iter(columns).expect("a batch");
    let inputs = [
        of(vec![("q", Arc::new(fixed.finish()))]),
        of(vec![("q", Arc::new(lists.finish()))]),
        of(names.iter().map(String::as_str).zip(singles).collect()),
    ];
    for input in inputs {
        let bound = mapping(&request).bind(&input.schema()).expect("bound");
        assert_eq!(bound.run(&input).expect("computed").0.columns(), wanted.columns());
        // A part of a batch begins in the middle of its buffers.
        let part = bound.run(&input.slice(3, 4)).expect("computed").0;
        assert_eq!(part.columns(), wanted.slice(3, 4).columns());
    }
}

#[test]
fn what_does_not_fit_is_refused() {
    let refused = |request: &Request, input: &RecordBatch, what: &str| {
        let why = match mapping(request).bind(&input.schema()) {
            Err(why) => why.to_string(),
            Ok(bound) => bound.run(input).expect_err("refused").to_string(),
        };
        assert!(why.contains(what) && why.contains("= hint: "), "{why}");
    };
    let numbered = |names: &[&str]| batch(&names.iter().map(|n| (*n, vec![0.0])).collect::<Vec<_>>());
    refused(&fk(), &numbered(&["a", "b"]), "joint variables are in no columns that are known");
    refused(&fk(), &numbered(&["q1", "q2", "q3"]), "joint variables");
    let six = ["q1", "q2", "q3", "q4", "q5", "q6"];
    refused(&fk(), &numbered(&[&six[..], &["x"]].concat()), "two columns `x`");
    let names = Names { joints: Some("q1..q5".into()), ..Names::default() };
    refused(&Request { names, ..fk() }, &numbered(&six), "5 columns, and 6 are needed");
    let names = Names { joints: Some("q6..q1".into()), ..Names::default() };
    refused(&Request { names, ..fk() }, &numbered(&six), "stands before the first");
    let names = Names { joints: Some("a,b".into()), ..Names::default() };
    refused(&Request { names, ..fk() }, &numbered(&six), "there is no column `a`");
    refused(&Request { keep: Keep::Some(vec!["w".into()]), ..fk() }, &numbered(&six), "--keep w");
    let text =
        RecordBatch::try_from_iter(six.map(|n| (n, Arc::new(StringArray::from(vec!["0.1"])) as ArrayRef)));
    refused(&fk(), &text.expect("a batch"), "holds Utf8, no numbers");
    let mut short = ListBuilder::new(Float32Builder::new());
    short.values().append_slice(&[0.0; 5]);
    short.append(true);
    let lists = RecordBatch::try_from_iter([("q", Arc::new(short.finish()) as ArrayRef)]).expect("a batch");
    refused(&fk(), &lists, "row 1: `q` holds 5 numbers; 6 are needed");
    refused(
        &Request { keep: Keep::Some(vec!["q1".into(), "q1".into()]), ..fk() },
        &numbered(&six),
        "told twice",
    );
    // The unit of a list is one of what it holds.
    for unit in ["mrad", "min", "mm", "deg/s"] {
        let mut long = ListBuilder::new(Float64Builder::new());
        long.values().append_slice(&[0.0; 6]);
        long.append(true);
        let list: ArrayRef = Arc::new(long.finish());
        let field = Field::new("q", list.data_type().clone(), true)
            .with_metadata(std::collections::HashMap::from([("unit".to_string(), unit.to_string())]));
        let input = RecordBatch::try_new(Arc::new(Schema::new(vec![field])), vec![list]).expect("a batch");
        refused(&fk(), &input, unit);
    }
    let nothing = denavit_map::Mapping::new(&ur5(), &Request::default());
    assert!(nothing.err().expect("refused").to_string().contains("nothing is to be computed"));
    let masses = denavit_map::Mapping::new(&ur5(), &Request { torque: true, ..Request::default() });
    if let Err(why) = masses {
        assert!(why.to_string().contains("masses"), "{why}");
    }
}

#[test]
fn whole_numbers_are_numbers() {
    let names: Vec<String> = (1..=6).map(|k| format!("q{k}")).collect();
    let whole = names.iter().map(|n| (n.as_str(), Arc::new(Int64Array::from(vec![1, -2])) as ArrayRef));
    let input = RecordBatch::try_from_iter(whole).expect("a batch");
    let other = batch(&names.iter().map(|n| (n.as_str(), vec![1.0, -2.0])).collect::<Vec<_>>());
    let request = Request { keep: Keep::Some(vec![]), ..fk() };
    let one = mapping(&request).bind(&input.schema()).expect("bound").run(&input).expect("computed").0;
    let two = mapping(&request).bind(&other.schema()).expect("bound").run(&other).expect("computed").0;
    assert_eq!(one.columns(), two.columns());
}
