//! Singular configurations in numbers, where the determinant is refused.

use crate::common::{case, robot};
use denavit::Robot;
use denavit::velocity::{Viewpoint, geometric, singular_configurations};

/// Where the determinant is refused, numbers are had: each configuration is singular, and the motion that is told leaves
/// the body, or its point, at rest.
#[test]
fn singular_configurations_are_found_in_numbers() {
    let arms = ["ur5cal", "g1off", "so101"].map(|name| (name, case(name), 0..6));
    for (name, d, rows) in arms.into_iter().chain([("puma560", robot("puma560"), 0..3)]) {
        let numeric = Robot::numeric(&d).expect("an arm with numbers");
        let view = Viewpoint::tool();
        let asked: Vec<usize> = rows.clone().collect();
        let found = singular_configurations(&d, &view, &asked).expect("numbers");
        assert!(!found.is_empty(), "{name} {rows:?}");
        let at = Viewpoint::of(view.body, view.axes);
        for one in found {
            let jacobian = geometric(&numeric, &one.q, &at);
            assert!(!one.free.is_empty() && (!one.lost.is_empty() || one.q.len() < 6), "{name}: {one:?}");
            for free in &one.free {
                let twist = jacobian.twist(free);
                assert!(twist[rows.clone()].iter().all(|x| x.abs() < 1e-6), "{name}: {twist:?}");
            }
        }
    }
}
