//! Vectors, rotations, transforms and orientations: hand values, books, a peer, and every singular case.

use denavit::geometry::orientation::{SINGULAR, extract, extraction_formulas, rotation};
use denavit::geometry::{
    Axis, EulerSet, NotRigid, Orientation, OrientationError, OrientationSet, Rotation, Transform, Vector,
};
use denavit_symbolic::{Expr, Symbol};
use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, FRAC_PI_4, PI};

/// Three angles of up to π are rounded to 2.2e-16 each, and their sines, cosines and products once more.
const ROUNDING: f64 = 2e-15;

fn distance(a: &Rotation<f64>, b: &Rotation<f64>) -> f64 {
    let entries = a.rows().concat().into_iter().zip(b.rows().concat());
    entries.map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
}

fn set(name: &str) -> OrientationSet {
    name.parse().unwrap()
}

/// Sets of three angles.
fn angle_sets() -> impl Iterator<Item = OrientationSet> {
    OrientationSet::ALL.into_iter().filter(|s| s.names().len() == 3)
}

/// Numbers in [0, 1), the same in every run (Knuth's 64-bit linear congruential generator).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn angle(&mut self) -> f64 {
        PI - 2.0 * PI * self.next()
    }

    fn rotation(&mut self) -> Rotation<f64> {
        let q: Vec<f64> = (0..4).map(|_| self.next() - 0.5).collect();
        rotation(OrientationSet::Quaternion, &q).unwrap()
    }
}

/// Extracts in every set, checks ranges and names, and that the values give the rotation back within `bound`;
/// where the set calls it singular, within the threshold for that.
fn check_round_trip(r: &Rotation<f64>, bound: f64) {
    for set in OrientationSet::ALL {
        let o = extract(r, set);
        let back = rotation(set, &o.values).unwrap();
        // Beside 0 and π the angle of an axis is off by the threshold, and the entries of a half turn by twice that.
        let slack =
            if o.singular || set == OrientationSet::AxisAngle && o.values[3] == PI { SINGULAR } else { 0.0 };
        let error = distance(r, &back);
        assert!(error <= bound + slack, "{set} {:?} of {r:?}: off by {error:e}", o.values);
        assert_eq!(o.values.len(), o.names().len());
        check_canonical(&o);
        if let Some(other) = o.other_solution() {
            let error = distance(r, &rotation(set, &other.values).unwrap());
            assert!(error <= bound + slack + ROUNDING, "{set} other solution: off by {error:e}");
        }
    }
}

fn check_canonical(o: &Orientation) {
    let v = &o.values;
    let turn = -PI < v[0] && v[0] <= PI && -PI < v[2] && v[2] <= PI;
    let ok = match o.set {
        OrientationSet::Matrix => true,
        OrientationSet::Quaternion => {
            v[3] > 0.0 || v[3] == 0.0 && v.iter().find(|x| **x != 0.0).is_some_and(|x| *x > 0.0)
        }
        OrientationSet::AxisAngle => {
            (0.0..=PI).contains(&v[3]) && (!o.singular || *v == [0.0, 0.0, 1.0, 0.0])
        }
        OrientationSet::Euler(e) if e.is_proper() => {
            let middle = !o.singular || v[1] == 0.0 || v[1] == PI;
            turn && (0.0..=PI).contains(&v[1]) && middle && (!o.singular || v[2] == 0.0)
        }
        OrientationSet::Euler(_) | OrientationSet::Rpy => {
            turn && v[1].abs() <= FRAC_PI_2 && (!o.singular || v[1].abs() == FRAC_PI_2 && v[2] == 0.0)
        }
    };
    assert!(ok, "{} {v:?}", o.set);
    assert!(v.iter().all(|x| *x != 0.0 || x.is_sign_positive()), "−0 in {} {v:?}", o.set);
}

#[test]
fn vectors_by_hand() {
    let (a, b) = (Vector([1.0, 2.0, 3.0]), Vector([4.0, 5.0, 6.0]));
    assert_eq!(a.dot(b), 32.0);
    assert_eq!(a.cross(b), Vector([-3.0, 6.0, -3.0]));
    assert_eq!(
        (a + b, a - b, -a, a * 2.0),
        (
            Vector([5.0, 7.0, 9.0]),
            Vector([-3.0, -3.0, -3.0]),
            Vector([-1.0, -2.0, -3.0]),
            Vector([2.0, 4.0, 6.0]),
        )
    );
    assert_eq!(Vector([2.0, 3.0, 6.0]).norm(), 7.0);
    // Right-handed: x × y = z and around.
    for (x, y, z) in [(Axis::X, Axis::Y, Axis::Z), (Axis::Y, Axis::Z, Axis::X), (Axis::Z, Axis::X, Axis::Y)] {
        assert_eq!(Vector::<f64>::unit(x).cross(Vector::unit(y)), Vector::unit(z));
    }
}

#[test]
fn a_quarter_turn_takes_each_axis_to_the_next() {
    // The right-hand rule: about x, y goes to z; about y, z to x; about z, x to y. Exact in formulas.
    let quarter = Expr::pi() / Expr::int(2);
    for (about, from, to) in
        [(Axis::X, Axis::Y, Axis::Z), (Axis::Y, Axis::Z, Axis::X), (Axis::Z, Axis::X, Axis::Y)]
    {
        let r = Rotation::about(about, quarter);
        assert_eq!(r * Vector::unit(from), Vector::unit(to));
        assert_eq!(r.column(from), Vector::unit(to));
        assert_eq!(r.column(about), Vector::unit(about));
        assert_eq!(r.inverse() * Vector::unit(to), Vector::unit(from));
    }
}

#[test]
fn composition_is_associative_and_inverse_undoes() {
    let mut random = Random(2);
    for _ in 0..200 {
        let (a, b, c) = (random.rotation(), random.rotation(), random.rotation());
        assert!(distance(&((a * b) * c), &(a * (b * c))) < ROUNDING);
        assert!(distance(&(a * a.inverse()), &Rotation::identity()) < ROUNDING);
        assert!(a.orthonormality_error() < ROUNDING && (a.determinant() - 1.0).abs() < ROUNDING);
        let v = Vector([random.next(), random.next(), random.next()]);
        assert!(((a * b) * v - a * (b * v)).norm() < ROUNDING);
    }
}

#[test]
fn formulas_of_rotations_are_the_books() {
    // Siciliano et al., Robotics, 2009, sections 2.4.1 (ZYZ) and 2.4.2 (RPY, ψ about x, θ about y, φ about z).
    let mut random = Random(3);
    for _ in 0..200 {
        let (phi, theta, psi) = (random.angle(), random.angle(), random.angle());
        let ((s, c), (st, ct), (sp, cp)) = (phi.sin_cos(), theta.sin_cos(), psi.sin_cos());
        let zyz = [
            [c * ct * cp - s * sp, -c * ct * sp - s * cp, c * st],
            [s * ct * cp + c * sp, -s * ct * sp + c * cp, s * st],
            [-st * cp, st * sp, ct],
        ];
        let rpy = [
            [c * ct, c * st * sp - s * cp, c * st * cp + s * sp],
            [s * ct, s * st * sp + c * cp, s * st * cp - c * sp],
            [-st, ct * sp, ct * cp],
        ];
        let found = rotation(set("zyz"), &[phi, theta, psi]).unwrap();
        assert!(distance(&found, &Rotation::from_rows(zyz)) < ROUNDING);
        assert!(distance(&Rotation::from_rpy(psi, theta, phi), &Rotation::from_rows(rpy)) < ROUNDING);
        // Fixed axes x, y, z are moving axes z, y, x.
        let zyx = rotation(set("zyx"), &[phi, theta, psi]).unwrap();
        assert_eq!(zyx, rotation(OrientationSet::Rpy, &[psi, theta, phi]).unwrap());
    }
}

#[test]
fn a_peer_reads_the_same_values() {
    // The quaternion (1, −2, 3, 4)/√30; its matrix by hand from x² − y² − z² + w², 2(xy − zw), …
    let r = Rotation::from_rows(
        [[2.0, -14.0, -5.0], [10.0, 5.0, -10.0], [11.0, -2.0, 10.0]].map(|row| row.map(|x| x / 15.0)),
    );
    // SciPy 1.17.1, Rotation.from_quat([1, -2, 3, 4]): as_euler("ZYZ") …, as_euler("xyz") for rpy, as_quat(),
    // as_rotvec() / |·| with magnitude().
    let rows: [(&str, &[f64]); 15] = [
        ("xyx", &[2.403777593469328, 1.437064737384955, -1.9138202672155997]),
        ("xzx", &[0.8329812666744316, 1.437064737384955, -0.3430239404207034]),
        ("yxy", &[-1.7126933813990606, 1.2309594173407747, FRAC_PI_4]),
        ("yzy", &[-0.1418970546041639, 1.2309594173407747, -FRAC_PI_4]),
        ("zxz", &[-0.46364760900080604, 0.8410686705679302, 1.7506498265873747]),
        ("zyz", &[-2.0344439357957027, 0.8410686705679302, -2.961739153797315]),
        ("xyz", &[FRAC_PI_4, -0.33983690945412204, 1.4288992721907325]),
        ("xzy", &[-0.38050637711236485, 1.2035883062370596, -1.1902899496825317]),
        ("yxz", &[-0.4636476090008061, 0.7297276562269666, 1.1071487177940904]),
        ("yzx", &[-1.3909428270024184, 0.7297276562269666, 1.1071487177940904]),
        ("zxy", &[1.2277723863741932, -0.13373158940994156, -0.8329812666744317]),
        ("zyx", &[1.3734007669450157, -0.8232119771258758, -0.19739555984988078]),
        ("rpy", &[-0.19739555984988078, -0.8232119771258758, 1.3734007669450157]),
        ("xyzw", &[0.18257418583505536, -0.3651483716701107, 0.5477225575051661, 0.7302967433402214]),
        ("axis-angle", &[0.2672612419124244, -0.5345224838248488, 0.8017837257372731, 1.5040801783846713]),
    ];
    for (name, wanted) in rows {
        let o = extract(&r, set(name));
        assert!(!o.singular);
        for (x, y) in o.values.iter().zip(wanted) {
            assert!((x - y).abs() < 1e-15, "{name}: {:?}, not {wanted:?}", o.values);
        }
        assert!(distance(&rotation(set(name), wanted).unwrap(), &r) < ROUNDING, "{name}");
    }
}

#[test]
fn random_rotations_round_trip_in_every_set() {
    let mut random = Random(1);
    for _ in 0..2000 {
        check_round_trip(&random.rotation(), ROUNDING);
    }
}

#[test]
fn the_24_turns_of_a_cube_round_trip_in_every_set() {
    let mut count = 0;
    for code in 0..27 * 8 {
        let (axes, signs) = ([code % 3, code / 3 % 3, code / 9 % 3], code / 27);
        let mut rows = [[0.0; 3]; 3];
        for (n, &axis) in axes.iter().enumerate() {
            rows[n][axis] = if signs >> n & 1 == 0 { 1.0 } else { -1.0 };
        }
        let Ok(r) = Rotation::from_matrix(rows) else { continue };
        count += 1;
        check_round_trip(&r, ROUNDING);
        for set in angle_sets() {
            let o = extract(&r, set);
            let quarters = o.values.iter().map(|a| a / FRAC_PI_2);
            assert!(quarters.clone().all(|q| q == q.round()), "{set}: {:?}", o.values);
            let middle = if matches!(set, OrientationSet::Euler(e) if e.is_proper()) { 0.0 } else { 1.0 };
            assert_eq!(o.singular, (o.values[1] / FRAC_PI_2).abs() % 2.0 == middle, "{set}: {:?}", o.values);
        }
    }
    assert_eq!(count, 24);
}

#[test]
fn quarter_turn_angles_round_trip_in_every_set() {
    let grid = [-FRAC_PI_2, 0.0, FRAC_PI_2, PI];
    for built in angle_sets() {
        for n in 0..64 {
            check_round_trip(
                &rotation(built, &[n % 4, n / 4 % 4, n / 16].map(|k| grid[k])).unwrap(),
                ROUNDING,
            );
        }
    }
}

#[test]
fn beside_each_singularity_the_values_reproduce_the_matrix() {
    let mut random = Random(7);
    for built in angle_sets() {
        let proper = matches!(built, OrientationSet::Euler(e) if e.is_proper());
        let singular = if proper { [0.0, PI] } else { [-FRAC_PI_2, FRAC_PI_2] };
        for (at, exponent) in singular.into_iter().flat_map(|at| (1..=16).map(move |e| (at, e))) {
            for digit in [1.0, -1.0, 3.0] {
                let off = if exponent == 16 { 0.0 } else { digit * 10f64.powi(-exponent) };
                let r = rotation(built, &[random.angle(), at + off, random.angle()]).unwrap();
                check_round_trip(&r, ROUNDING);
                // Rounding decides within 2e-15 of the threshold.
                if (off.abs() - SINGULAR).abs() > 2e-15 {
                    assert_eq!(
                        extract(&r, built).singular,
                        off.abs() < SINGULAR,
                        "{built} at {at} + {off:e}"
                    );
                }
            }
        }
    }
}

#[test]
fn beside_no_turn_and_half_turns_axis_and_angle_reproduce_the_matrix() {
    let mut random = Random(8);
    for (at, exponent) in [0.0, PI].into_iter().flat_map(|at| (1..=16).map(move |e| (at, e))) {
        for sign in [1.0, -1.0] {
            let off = if exponent == 16 { 0.0 } else { sign * 10f64.powi(-exponent) };
            let axis = [random.next() - 0.5, random.next() - 0.5, random.next() - 0.5];
            let r = rotation(OrientationSet::AxisAngle, &[axis[0], axis[1], axis[2], at + off]).unwrap();
            check_round_trip(&r, ROUNDING);
            let o = extract(&r, OrientationSet::AxisAngle);
            assert_eq!(o.singular, at == 0.0 && off.abs() < 0.9 * SINGULAR, "{at} + {off:e}: {:?}", o.values);
            if at == 0.0 && !o.singular {
                // Small angles keep their digits: sin is linear there.
                assert!(
                    (o.values[3] - off.abs()).abs() < 4e-16 * off.abs().max(1e-1),
                    "{off:e}: {:?}",
                    o.values
                );
            }
        }
    }
}

#[test]
fn half_turns_have_one_axis() {
    // By hand: a half turn about u is 2uuᵀ − 1; u and −u are the same turn, the one led by a positive entry wins.
    let h = FRAC_1_SQRT_2;
    for (axis, wanted) in [
        ([1.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
        ([-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
        ([0.0, -1.0, 0.0], [0.0, 1.0, 0.0]),
        ([0.0, 0.0, -1.0], [0.0, 0.0, 1.0]),
        ([-h, h, 0.0], [h, -h, 0.0]),
        ([0.0, -h, -h], [0.0, h, h]),
    ] {
        for angle in [PI, -PI] {
            let r = rotation(OrientationSet::AxisAngle, &[axis[0], axis[1], axis[2], angle]).unwrap();
            let o = extract(&r, OrientationSet::AxisAngle);
            assert!(!o.singular && o.values[3] == PI);
            assert!((Vector([o.values[0], o.values[1], o.values[2]]) - Vector(wanted)).norm() < ROUNDING);
        }
    }
}

#[test]
fn singular_representatives_by_hand() {
    // At θ = 0, Rz(φ)Ry(0)Rz(ψ) is Rz(φ+ψ); at θ = π it is Ry(π) turned by φ−ψ; at pitch ±π/2,
    // Rz(yaw)Ry(±π/2)Rx(roll) depends on roll ∓ yaw only: Ry(π/2) takes −x to z.
    for (name, given, wanted) in [
        ("zyz", [0.5, 0.0, 0.25], [0.75, 0.0, 0.0]),
        ("zyz", [0.5, PI, 0.25], [0.25, PI, 0.0]),
        ("zyz", [3.0, 0.0, 1.0], [4.0 - 2.0 * PI, 0.0, 0.0]),
        ("zxz", [0.5, PI, 0.25], [0.25, PI, 0.0]),
        ("rpy", [0.5, FRAC_PI_2, 0.25], [0.25, FRAC_PI_2, 0.0]),
        ("rpy", [0.5, -FRAC_PI_2, 0.25], [0.75, -FRAC_PI_2, 0.0]),
        ("zyx", [0.25, FRAC_PI_2, 0.5], [-0.25, FRAC_PI_2, 0.0]),
        ("xyz", [0.5, FRAC_PI_2, 0.25], [0.75, FRAC_PI_2, 0.0]),
    ] {
        let o = extract(&rotation(set(name), &given).unwrap(), set(name));
        assert!(o.singular && o.values[1..] == wanted[1..], "{name} {given:?}: {:?}", o.values);
        assert!((o.values[0] - wanted[0]).abs() < ROUNDING, "{name} {given:?}: {:?}", o.values);
        assert_eq!(o.other_solution(), None);
    }
    let o = extract(&Rotation::identity(), OrientationSet::AxisAngle);
    assert_eq!((o.values, o.singular), (vec![0.0, 0.0, 1.0, 0.0], true));
}

#[test]
fn the_other_solution_comes_back() {
    // Spong, Hutchinson and Vidyasagar 2006, section 2.5.1: the second ZYZ solution has −θ and φ, ψ turned by π.
    let zyz = extract(&rotation(set("zyz"), &[0.5, 1.0, -2.0]).unwrap(), set("zyz"));
    let other = zyz.other_solution().unwrap();
    for (x, y) in other.values.iter().zip([0.5 - PI, -1.0, PI - 2.0]) {
        assert!((x - y).abs() < ROUNDING, "{:?}", other.values);
    }
    let mut random = Random(9);
    for set in OrientationSet::ALL.into_iter().filter(|s| *s != OrientationSet::Matrix) {
        let o = extract(&random.rotation(), set);
        let twice = o.other_solution().and_then(|other| other.other_solution()).unwrap();
        assert!(o.values.iter().zip(&twice.values).all(|(x, y)| (x - y).abs() < ROUNDING), "{set}");
    }
    assert_eq!(extract(&Rotation::identity(), OrientationSet::Matrix).other_solution(), None);
}

fn symbolic_entries() -> Rotation<Expr> {
    Rotation::from_rows([1, 2, 3].map(|i| [1, 2, 3].map(|j| Expr::symbol(&format!("r{i}{j}")))))
}

#[test]
fn extraction_formulas_are_the_books() {
    // Siciliano et al., Robotics, 2009, sections 2.4.1 and 2.4.2 (there with φ for yaw, θ for pitch, ψ for roll).
    let r = |name| Expr::symbol(name);
    let norm = |a: Expr, b: Expr| (a.powi(2) + b.powi(2)).sqrt();
    let found = extraction_formulas(&symbolic_entries(), set("zyz")).unwrap();
    let zyz = [
        ("phi", r("r23").atan2(r("r13"))),
        ("theta", norm(r("r13"), r("r23")).atan2(r("r33"))),
        ("psi", r("r32").atan2(-r("r31"))),
    ];
    assert_eq!(found, zyz);
    let found = extraction_formulas(&symbolic_entries(), OrientationSet::Rpy).unwrap();
    let rpy = [
        ("roll", r("r32").atan2(r("r33"))),
        ("pitch", (-r("r31")).atan2(norm(r("r32"), r("r33")))),
        ("yaw", r("r21").atan2(r("r11"))),
    ];
    assert_eq!(found, rpy);
    for none in ["matrix", "xyzw", "axis-angle"] {
        assert_eq!(extraction_formulas(&symbolic_entries(), set(none)), None);
    }
}

#[test]
fn extraction_formulas_give_the_numbers() {
    let mut random = Random(4);
    for set in angle_sets() {
        let formulas = extraction_formulas(&symbolic_entries(), set).unwrap();
        for _ in 0..50 {
            let r = random.rotation();
            let entry = |s: Symbol| {
                let digits: Vec<usize> = s.name().bytes().skip(1).map(|b| usize::from(b - b'1')).collect();
                Some(r[(digits[0], digits[1])])
            };
            for ((name, formula), x) in formulas.iter().zip(extract(&r, set).values) {
                let y = formula.eval(entry).unwrap();
                assert!((x - y).abs() < 1e-13, "{set} {name}: {x} and {y}"); // sin θ may be as small as 1e-2
            }
        }
    }
}

#[test]
fn formulas_of_transforms_evaluate_to_the_numbers() {
    fn chain<T: denavit::scalar::Scalar>(v: [T; 6]) -> Transform<T> {
        let first =
            Transform::rotation_z(v[0]) * Transform::translation_z(v[1]) * Transform::rotation_x(v[2]);
        let tool = Transform::from_rotation_translation(
            Rotation::from_rpy(v[3], v[4], v[5]),
            Vector::new(v[1], v[0], v[2]),
        );
        (first * Transform::rotation_y(v[3]) * Transform::translation_y(v[4])).inverse() * tool
    }
    let mut random = Random(5);
    let names = ["a", "b", "c", "d", "e", "f"];
    let formulas = chain(names.map(Expr::symbol));
    for _ in 0..20 {
        let values = names.map(|_| random.angle());
        let value = |s: Symbol| names.iter().position(|n| *n == &*s.name()).map(|i| values[i]);
        let found = formulas.map(|e| e.eval(value).unwrap());
        let wanted = chain(values);
        assert!(distance(&found.rotation, &wanted.rotation) < ROUNDING);
        assert!((found.translation - wanted.translation).norm() < 1e-14);
    }
}

#[test]
fn inverse_of_a_lecture_example() {
    // D. Djoudi, lecture on robotics (Djelfa), "Homogenous coordinates": ⁱTⱼ and its inverse, which follows by hand from [Rᵀ, −Rᵀp].
    let m = [[0.0, 0.0, 1.0, 3.0], [0.0, 1.0, 0.0, 12.0], [-1.0, 0.0, 0.0, 6.0], [0.0, 0.0, 0.0, 1.0]];
    let inverse =
        [[0.0, 0.0, -1.0, 6.0], [0.0, 1.0, 0.0, -12.0], [1.0, 0.0, 0.0, -3.0], [0.0, 0.0, 0.0, 1.0]];
    let x_ij = Transform::from_matrix(m).unwrap();
    assert_eq!(x_ij.matrix(), m);
    assert_eq!(x_ij.inverse().matrix(), inverse);
    assert_eq!((x_ij * x_ij.inverse()).matrix(), Transform::<f64>::identity().matrix());
    // It is Trans(3, 12, 6) after a quarter turn about y; exact in formulas.
    let built = Transform::translation(Expr::int(3), Expr::int(12), Expr::int(6))
        * Transform::rotation_y(Expr::pi() / Expr::int(2));
    assert_eq!(built.matrix(), m.map(|row| row.map(|x| Expr::int(x as i64))));
}

#[test]
fn points_move_and_free_vectors_only_turn() {
    // By hand: a quarter turn about z takes (1, 2, 3) to (−2, 1, 3).
    let x_ab = Transform::translation(10.0, 20.0, 30.0)
        * Transform::from_rotation_translation(Rotation::from_sin_cos(Axis::Z, 1.0, 0.0), Vector::zero());
    let v = Vector([1.0, 2.0, 3.0]);
    assert_eq!(x_ab.act_on_vector(v), Vector([-2.0, 1.0, 3.0]));
    assert_eq!(x_ab.act_on_point(v), Vector([8.0, 21.0, 33.0]));
    assert_eq!(x_ab.inverse().act_on_point(Vector([8.0, 21.0, 33.0])), v);
    // Translation first, rotation first: Tx(1)·Rz(90°) and Rz(90°)·Tx(1) put the origin in different places.
    let quarter = Expr::pi() / Expr::int(2);
    let (t, r) = (Transform::translation_x(Expr::int(1)), Transform::rotation_z(quarter));
    assert_eq!((t * r).translation, Vector::unit(Axis::X));
    assert_eq!((r * t).translation, Vector::unit(Axis::Y));
}

#[test]
fn matrices_that_are_not_rigid_are_refused() {
    let good = Transform::<f64>::identity().matrix();
    let with = |row: usize, column: usize, x: f64| {
        let mut m = good;
        m[row][column] = x;
        Transform::from_matrix(m)
    };
    assert!(with(0, 3, 1e300).is_ok());
    assert!(with(0, 0, 1.0 + 1e-6).is_ok());
    assert!(matches!(with(1, 2, f64::NAN), Err(NotRigid::NotFinite { row: 1, column: 2 })));
    assert!(matches!(with(2, 3, f64::INFINITY), Err(NotRigid::NotFinite { row: 2, column: 3 })));
    assert!(matches!(with(0, 0, -1.0), Err(NotRigid::Mirrored)));
    assert!(matches!(with(0, 0, 2.0), Err(NotRigid::NotOrthonormal { error }) if error == 3.0));
    assert!(matches!(with(0, 1, 1e200), Err(NotRigid::NotOrthonormal { .. })));
    assert!(matches!(with(0, 0, 0.0), Err(NotRigid::NotOrthonormal { .. })));
    assert!(matches!(with(3, 3, 0.0), Err(NotRigid::LastRow(_))));
    let transposed = with(3, 0, 0.5).unwrap_err().to_string();
    assert!(transposed.contains("0.5 0 0 1") && transposed.contains("transposed"), "{transposed}");
}

#[test]
fn names_parse_back() {
    for set in OrientationSet::ALL {
        assert_eq!(set.to_string().parse(), Ok(set));
        assert_eq!(set.to_string().to_uppercase().parse(), Ok(set));
    }
    assert_eq!("xyzw".parse(), Ok(OrientationSet::Quaternion));
    assert_eq!("zyz".parse(), Ok(EulerSet::ZYZ));
    for axes in (0..27).map(|n| [n % 3, n / 3 % 3, n / 9].map(|i| Axis::ALL[i])) {
        let known = EulerSet::ALL.into_iter().find(|s| s.axes() == axes);
        assert_eq!(EulerSet::new(axes), known);
    }
    for unknown in ["", "zzy", "euler", "zyzz", "\u{1b}[31m"] {
        let error = unknown.parse::<OrientationSet>().unwrap_err();
        assert_eq!(error, OrientationError::UnknownSet(unknown.into()));
        assert!(error.to_string().contains("axis-angle") && !error.to_string().contains('\u{1b}'));
    }
}

#[test]
fn values_that_are_no_orientation_are_refused() {
    for set in OrientationSet::ALL {
        let count = set.names().len();
        for wrong in [0, count - 1, count + 1] {
            let error = rotation(set, &vec![0.5; wrong]).unwrap_err();
            assert_eq!(error, OrientationError::WrongCount { set, found: wrong });
        }
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut values = vec![0.5; count];
            values[count - 1] = bad;
            let name = set.names()[count - 1];
            assert_eq!(rotation(set, &values), Err(OrientationError::NotFinite { set, name }));
        }
    }
    let zero = OrientationSet::Quaternion;
    assert_eq!(rotation(zero, &[0.0; 4]), Err(OrientationError::ZeroLength(zero)));
    let zero = OrientationSet::AxisAngle;
    assert_eq!(rotation(zero, &[0.0, 0.0, 0.0, 1.0]), Err(OrientationError::ZeroLength(zero)));
    let mirrored = rotation(OrientationSet::Matrix, &[-1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
    assert_eq!(mirrored, Err(OrientationError::NotRigid(NotRigid::Mirrored)));
    // Length does not count, however extreme: (0, 0, 1, 1) is a quarter turn about z.
    for scale in [1e-320, 1e-200, 1.0, 1e300] {
        let r = rotation(OrientationSet::Quaternion, &[0.0, 0.0, scale, scale]).unwrap();
        assert!(distance(&r, &Rotation::from_sin_cos(Axis::Z, 1.0, 0.0)) < ROUNDING);
    }
}

#[test]
fn what_is_no_rotation_gives_no_panic() {
    for x in [f64::NAN, f64::INFINITY, 1e200, 0.0] {
        for set in OrientationSet::ALL {
            let o = extract(&Rotation::from_rows([[x; 3]; 3]), set);
            assert_eq!(o.values.len(), set.names().len());
            o.other_solution();
        }
    }
}
