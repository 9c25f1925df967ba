//! Poses, frames, Jacobians; functions of many states.

#![allow(unsafe_code, clippy::missing_safety_doc)] // functions of C; what pointers have to be stands in `lib.rs`

use super::objects::Robot;
use crate::border::{Place, array, object, overlap, room};
use crate::robot::Core;
use crate::solver::{finite, pose as pose_of};
use crate::trouble::{Trouble, guarded};
use crate::types::{Code, Function, Pose, Status};

/// Vectors with an entry a joint, one behind the other.
pub unsafe fn state(
    core: &Core,
    vectors: &[(*const f64, &str)],
    joints: usize,
    read: &mut Vec<f64>,
) -> Result<(), Trouble> {
    if joints != core.joints() {
        return Err(Trouble::length("q", joints, core.joints()));
    }
    for &(pointer, name) in vectors {
        let vector = unsafe { array(pointer, joints, name) }?;
        finite(vector, name)?;
        read.extend_from_slice(vector);
    }
    Ok(())
}

/// The pose of the tool in the base at q. `joints` is the length of q.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_fk(
    robot: *const Robot,
    q: *const f64,
    joints: usize,
    pose: *mut Pose,
) -> Status {
    guarded(|| unsafe {
        let core = &object(robot, "robot")?.0;
        let place = Place::new(pose, "pose")?;
        if joints != core.joints() {
            return Err(Trouble::length("q", joints, core.joints()));
        }
        let q = array(q, joints, "q")?;
        finite(q, "q")?;
        place.put(core.function(Function::Fk)?.one(q, pose_of));
        Ok(Status::Ok)
    })
}

/// Frames 0, 1, … of the table and, behind them, the tool, all in the base at q: `poses_length` is one more than the number of frames.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_frames(
    robot: *const Robot,
    q: *const f64,
    joints: usize,
    poses: *mut Pose,
    poses_length: usize,
) -> Status {
    guarded(|| unsafe {
        let core = &object(robot, "robot")?.0;
        let mut read = Vec::new();
        state(core, &[(q, "q")], joints, &mut read)?;
        let poses = room(poses, poses_length, "poses")?;
        if poses.len() != core.frames() + 1 {
            return Err(Trouble::length("poses", poses.len(), core.frames() + 1));
        }
        core.function(Function::Frames)?.one(&read, |all| {
            poses.iter_mut().zip(all.chunks_exact(16)).for_each(|(place, one)| *place = pose_of(one));
        });
        Ok(Status::Ok)
    })
}

/// The geometric Jacobian of the origin of frame `of` in the base, along the axes of frame `axes`, at q: 6 x n, row by row; rows vx, vy, vz
/// (m/rad, or 1 for a joint that slides), wx, wy, wz. A frame is its number, `DENAVIT_TOOL` or `DENAVIT_BASE`. `jacobian_length` is 6 n.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_jacobian(
    robot: *const Robot,
    of: i32,
    axes: i32,
    q: *const f64,
    joints: usize,
    jacobian: *mut f64,
    jacobian_length: usize,
) -> Status {
    guarded(|| unsafe {
        let core = &object(robot, "robot")?.0;
        let mut read = Vec::new();
        state(core, &[(q, "q")], joints, &mut read)?;
        let place = room(jacobian, jacobian_length, "jacobian")?;
        if place.len() != 6 * joints {
            return Err(Trouble::length("jacobian", place.len(), 6 * joints));
        }
        core.jacobian(of, axes, |ready| {
            ready.one(&read, |all| place.copy_from_slice(all));
            Ok(Status::Ok)
        })
    })
}

/// What a number names.
fn named(function: Code<Function>) -> Result<Function, Trouble> {
    function.meant().ok_or_else(|| Trouble::new(Status::BadArgument, format!("no function {}", function.0)))
}

/// How many numbers a function reads of a state, and how many it gives. It is derived and compiled now, which may take seconds for
/// derivatives of dynamics: the first call of a function does it otherwise. Each of the two places may be null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_prepare(
    robot: *const Robot,
    function: Code<Function>,
    inputs: *mut usize,
    outputs: *mut usize,
) -> Status {
    guarded(|| unsafe {
        let (core, name) = (&object(robot, "robot")?.0, named(function)?);
        core.function(name)?;
        let size = core.size(name);
        if let Some(place) = Place::optional(inputs, "inputs")? {
            place.put(size.0);
        }
        if let Some(place) = Place::optional(outputs, "outputs")? {
            place.put(size.1);
        }
        Ok(Status::Ok)
    })
}

/// A function of `rows` states: a row of inputs is the vectors that the function reads, one behind the other (q, then qd, then qdd or
/// torques), a row of outputs its results. `inputs_length` and `outputs_length` are those of `denavit_prepare`, times `rows`. By `threads`
/// threads; 0: one a core. A row's results have the same bits whatever the number of rows and threads.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)] // arrays with their lengths
pub unsafe extern "C" fn denavit_evaluate(
    robot: *const Robot,
    function: Code<Function>,
    rows: usize,
    inputs: *const f64,
    inputs_length: usize,
    outputs: *mut f64,
    outputs_length: usize,
    threads: usize,
) -> Status {
    guarded(|| unsafe {
        let (core, name) = (&object(robot, "robot")?.0, named(function)?);
        let (reads, gives) = core.size(name);
        for (what, given, one) in [("inputs", inputs_length, reads), ("outputs", outputs_length, gives)] {
            let wanted = one.saturating_mul(rows);
            if given != wanted {
                return Err(Trouble::length(what, given, wanted));
            }
        }
        let inputs = array(inputs, inputs_length, "inputs")?;
        if overlap(inputs, outputs, outputs_length) {
            return Err(Trouble::new(Status::BadPointer, "outputs overlap inputs"));
        }
        let outputs = room(outputs, outputs_length, "outputs")?;
        finite(inputs, "inputs")?;
        core.function(name)?.many(inputs, outputs, threads);
        Ok(Status::Ok)
    })
}
