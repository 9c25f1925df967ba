//! Torques, inertia, accelerations, energies of one state; of many states, and with derivatives: `denavit_evaluate`.

#![allow(unsafe_code, clippy::missing_safety_doc)] // functions of C; what pointers have to be stands in `lib.rs`

use super::kinematics::state;
use super::objects::Robot;
use crate::border::{Place, Room, object};
use crate::trouble::{Trouble, guarded};
use crate::types::{Function, Status};

/// The results of a function of one state, put into a room that may be where its vectors were.
unsafe fn one(
    robot: *const Robot,
    function: Function,
    vectors: &[(*const f64, &str)],
    joints: usize,
    (results, length, name): (*mut f64, usize, &str),
) -> Status {
    guarded(|| unsafe {
        let core = &object(robot, "robot")?.0;
        let place = Room::new(results, length, name)?;
        let mut read = Vec::new();
        state(core, vectors, joints, &mut read)?;
        core.function(function)?.one(&read, |found| place.fill(found, name))?;
        Ok(Status::Ok)
    })
}

/// The torques of the drives (N m; N of a slide) for accelerations qdd in the state q, qd, with gravity, rotors and friction. All vectors
/// have `joints` entries; the torques may be where one of the others is.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_torque(
    robot: *const Robot,
    q: *const f64,
    qd: *const f64,
    qdd: *const f64,
    joints: usize,
    torque: *mut f64,
) -> Status {
    let vectors = [(q, "q"), (qd, "qd"), (qdd, "qdd")];
    unsafe { one(robot, Function::Torque, &vectors, joints, (torque, joints, "torque")) }
}

/// The torques without accelerations: Coriolis and centrifugal ones, gravity and friction.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_bias(
    robot: *const Robot,
    q: *const f64,
    qd: *const f64,
    joints: usize,
    torque: *mut f64,
) -> Status {
    unsafe { one(robot, Function::Bias, &[(q, "q"), (qd, "qd")], joints, (torque, joints, "torque")) }
}

/// The torques that hold the arm at rest.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_gravity(
    robot: *const Robot,
    q: *const f64,
    joints: usize,
    torque: *mut f64,
) -> Status {
    unsafe { one(robot, Function::Gravity, &[(q, "q")], joints, (torque, joints, "torque")) }
}

/// The inertia matrix, n x n, row by row: `inertia_length` is n squared.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_inertia(
    robot: *const Robot,
    q: *const f64,
    joints: usize,
    inertia: *mut f64,
    inertia_length: usize,
) -> Status {
    unsafe { one(robot, Function::Inertia, &[(q, "q")], joints, (inertia, inertia_length, "inertia")) }
}

/// The accelerations of the joints for torques in the state q, qd.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_acceleration(
    robot: *const Robot,
    q: *const f64,
    qd: *const f64,
    torque: *const f64,
    joints: usize,
    qdd: *mut f64,
) -> Status {
    let vectors = [(q, "q"), (qd, "qd"), (torque, "torque")];
    unsafe { one(robot, Function::Acceleration, &vectors, joints, (qdd, joints, "qdd")) }
}

/// The kinetic and the potential energy in the state q, qd, joules.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_energy(
    robot: *const Robot,
    q: *const f64,
    qd: *const f64,
    joints: usize,
    kinetic: *mut f64,
    potential: *mut f64,
) -> Status {
    guarded(|| unsafe {
        let core = &object(robot, "robot")?.0;
        let places = [Place::new(kinetic, "kinetic")?, Place::new(potential, "potential")?];
        let mut read = Vec::new();
        state(core, &[(q, "q"), (qd, "qd")], joints, &mut read)?;
        let found = core.function(Function::Energy)?.one(&read, |e| [e[0], e[1]]);
        places.iter().zip(found).for_each(|(place, energy)| place.put(energy));
        Ok::<Status, Trouble>(Status::Ok)
    })
}
