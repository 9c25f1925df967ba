//! The crate dynibo for `bench.cpp`: what the arm of a URDF has for states of q, q̇ and q̈ (or τ), one after the other.
//!
//! All functions end the program where dynibo has an error.

use dynibo::Robot;
use std::ffi::{CStr, c_char};

/// The robot of a file, which stays until the program ends; null if it has another number of joints.
///
/// # Safety
/// `path` is a string that ends with 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dynibo_robot(path: *const c_char, joints: usize) -> *mut Robot {
    // SAFETY: the caller's promise.
    let path = unsafe { CStr::from_ptr(path) }.to_str().expect("a path in UTF-8");
    let robot = Robot::from_urdf(path).expect("a URDF that dynibo reads");
    if robot.joint_count() == joints { Box::into_raw(Box::new(robot)) } else { std::ptr::null_mut() }
}

/// The robot, its state, and where results go.
///
/// # Safety
/// As for the functions below.
unsafe fn given<'a>(
    robot: *mut Robot,
    state: *const f64,
    results: *mut f64,
    squared: bool,
) -> (&'a mut Robot, [&'a [f64]; 3], &'a mut [f64]) {
    // SAFETY: the caller's promise.
    unsafe {
        let robot = &mut *robot;
        let n = robot.joint_count();
        let state = std::slice::from_raw_parts(state, 3 * n);
        let results = std::slice::from_raw_parts_mut(results, if squared { n * n } else { n });
        (robot, [&state[..n], &state[n..2 * n], &state[2 * n..]], results)
    }
}

/// The torques.
///
/// # Safety
/// `robot` is of [`dynibo_robot`], `state` has three numbers a joint, `torques` one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dynibo_torque(robot: *mut Robot, state: *const f64, torques: *mut f64) {
    // SAFETY: the caller's promise.
    let (robot, [q, qd, qdd], torques) = unsafe { given(robot, state, torques, false) };
    robot.inverse_dynamics(q, qd, qdd, &[], torques).expect("torques");
}

/// The inertia matrix.
///
/// # Safety
/// `robot` is of [`dynibo_robot`], `state` has three numbers a joint, `matrix` one for each two joints.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dynibo_inertia(robot: *mut Robot, state: *const f64, matrix: *mut f64) {
    // SAFETY: the caller's promise.
    let (robot, [q, _, _], matrix) = unsafe { given(robot, state, matrix, true) };
    robot.mass_matrix(q, matrix).expect("a matrix");
}

/// The accelerations under torques.
///
/// # Safety
/// `robot` is of [`dynibo_robot`], `state` has three numbers a joint, `accelerations` one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dynibo_acceleration(robot: *mut Robot, state: *const f64, accelerations: *mut f64) {
    // SAFETY: the caller's promise.
    let (robot, [q, qd, tau], accelerations) = unsafe { given(robot, state, accelerations, false) };
    robot.forward_dynamics(q, qd, tau, &[], accelerations).expect("accelerations");
}
