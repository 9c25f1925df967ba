//! Inverse kinematics: solvers; many poses at once; one pose after the other.

#![allow(unsafe_code, clippy::missing_safety_doc)] // functions of C; what pointers have to be stands in `lib.rs`

use super::objects::{Answer, Robot, Solver};
use crate::border::{Place, Room, array, give, object, overlap, room, take};
use crate::solver::{Core, Rows, finite, rigid};
use crate::trouble::{Trouble, guarded};
use crate::types::{Code, Goal, Pose, Status, Tracked};
use denavit::inverse::Course;
use std::ffi::c_char;
use std::sync::Arc;

/// Prepares the inverse kinematics of a robot: derives a closed form, or chooses another method, which takes up to a second. `given` are
/// joints (from 0) whose values go with each pose, `given_length` of them; null with length 0: none is chosen, and an arm with more joints
/// than the hand can use is answered with its self-motion.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_solver_new(
    robot: *const Robot,
    goal: Code<Goal>,
    given: *const usize,
    given_length: usize,
    solver: *mut *mut Solver,
) -> Status {
    guarded(|| unsafe {
        let core = &object(robot, "robot")?.0;
        let place = Place::new(solver, "solver")?;
        let given = array(given, given_length, "given")?;
        let goal = goal.meant();
        let goal = goal.ok_or_else(|| Trouble::new(Status::BadArgument, "no such goal"))?;
        give(&place, Solver(Arc::new(Core::new(core, goal, given)?)));
        Ok(Status::Ok)
    })
}

/// Frees a solver.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_solver_free(solver: *mut Solver) {
    unsafe { take(solver) }
}

/// The method: `closed form`, `elimination`, `self-motion` or `descent`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_solver_method(solver: *const Solver, method: *mut *const c_char) -> Status {
    guarded(|| unsafe {
        let core = &object(solver, "solver")?.0;
        Place::new(method, "method")?.put(core.method.as_ptr());
        Ok(Status::Ok)
    })
}

/// How many joints are given beside the pose: the length of `given` in the calls below.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_solver_given_length(
    solver: *const Solver,
    given_length: *mut usize,
) -> Status {
    guarded(|| unsafe {
        let core = &object(solver, "solver")?.0;
        Place::new(given_length, "given_length")?.put(core.kinematics.given.len());
        Ok(Status::Ok)
    })
}

/// Which joints these are, in the order of their values.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_solver_given(
    solver: *const Solver,
    given: *mut usize,
    given_length: usize,
) -> Status {
    guarded(|| unsafe {
        let core = &object(solver, "solver")?.0;
        Room::new(given, given_length, "given")?.fill(&core.kinematics.given, "given")?;
        Ok(Status::Ok)
    })
}

/// All solutions of a pose of the tool in the base, as an object that is asked for them; its status is returned, too. `given` are the values
/// of given joints; null with length 0: 0, or the middle of limits that exclude it. `within_limits`, not 0: what the limits exclude is left
/// out, and what is left stands where they allow it. A pose is taken to be as precise as its rotation is orthonormal: the nearest rotation
/// is meant.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_solve(
    solver: *const Solver,
    pose: *const Pose,
    given: *const f64,
    given_length: usize,
    within_limits: i32,
    answer: *mut *mut Answer,
) -> Status {
    guarded(|| unsafe {
        let core = &object(solver, "solver")?.0;
        let (pose, place) = (object(pose, "pose")?, Place::new(answer, "answer")?);
        let found = core.all(pose, array(given, given_length, "given")?, within_limits != 0)?;
        let status = crate::solver::status(&found.answer, found.left_out);
        give(&place, Answer(found));
        Ok(status)
    })
}

/// All solutions of many poses, without an object: at most `most` a pose, and behind the isolated ones one of each family. `q` has room for
/// `most` rows of n a pose (`q_length` is poses_length x most x n), the rest of which is filled with NaN; `residuals` for `most` a pose, or
/// it is null with length 0. `counts` says how many there are of each pose, which may be more than `most`; `statuses` what came of each pose,
/// as `denavit_solve` would return it, negative where it is none. `given`: the values of given joints, the same for all poses. By `threads`
/// threads; 0: one a core.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments)] // arrays with their lengths
pub unsafe extern "C" fn denavit_ik(
    solver: *const Solver,
    poses: *const Pose,
    poses_length: usize,
    given: *const f64,
    given_length: usize,
    within_limits: i32,
    most: usize,
    q: *mut f64,
    q_length: usize,
    residuals: *mut f64,
    residuals_length: usize,
    counts: *mut usize,
    counts_length: usize,
    statuses: *mut Code<Status>,
    statuses_length: usize,
    threads: usize,
) -> Status {
    guarded(|| unsafe {
        let core = &object(solver, "solver")?.0;
        let slots = poses_length.checked_mul(most);
        for (what, given, wanted) in [
            ("q", q_length, slots.and_then(|s| s.checked_mul(core.joints()))),
            ("residuals", residuals_length, if residuals.is_null() { Some(0) } else { slots }),
            ("counts", counts_length, Some(poses_length)),
            ("statuses", statuses_length, Some(poses_length)),
        ] {
            if wanted != Some(given) {
                return Err(Trouble::length(what, given, wanted.unwrap_or(usize::MAX)));
            }
        }
        let poses = array(poses, poses_length, "poses")?;
        if overlap(poses, q, q_length) || overlap(poses, residuals, residuals_length) {
            return Err(Trouble::new(Status::BadPointer, "what is written overlaps the poses"));
        }
        let given = core.given(array(given, given_length, "given")?)?.to_vec();
        let rows = Rows {
            most,
            q: room(q, q_length, "q")?,
            counts: room(counts, counts_length, "counts")?,
            statuses: room(statuses.cast::<i32>(), statuses_length, "statuses")?,
            residuals: if residuals.is_null() {
                None
            } else {
                Some(room(residuals, residuals_length, "residuals")?)
            },
        };
        core.many(poses, &given, within_limits != 0, rows, threads);
        Ok(Status::Ok)
    })
}

/// The configuration for a pose that is nearest to the previous one, within the limits if one is, for a controller that goes from pose to
/// pose: a few steps of Newton's method where the pose is near, all solutions where these do not lead to it. Joints that are given stay.
/// `q` may be where `previous` is; both have `joints` entries. `tracked` may be null.
///
/// Returns 0 where the joints move by less than half a radian (slides: half the reach), `DENAVIT_JUMPED` where the nearest of all that are
/// known is further away, `DENAVIT_OUTSIDE_LIMITS` where it leaves the limits, `DENAVIT_NOT_FOUND` where there is none, and q is as it was.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_track(
    solver: *const Solver,
    pose: *const Pose,
    previous: *const f64,
    joints: usize,
    q: *mut f64,
    tracked: *mut Tracked,
) -> Status {
    guarded(|| unsafe {
        let core = &object(solver, "solver")?.0;
        let pose = rigid(object(pose, "pose")?)?;
        let (place, told) = (Room::new(q, joints, "q")?, Place::optional(tracked, "tracked")?);
        if joints != core.joints() {
            return Err(Trouble::length("previous", joints, core.joints()));
        }
        let previous = array(previous, joints, "previous")?;
        finite(previous, "previous")?;
        let Some(found) = core.kinematics.track(&pose, previous) else { return Ok(Status::NotFound) };
        place.fill(&found.q, "q")?;
        if let Some(told) = told {
            told.put(Tracked {
                residual: found.residual,
                distance: found.distance,
                guard: found.guard,
                at_limit: found.at_limit.len(),
            });
        }
        Ok(match found.course {
            Course::Followed => Status::Ok,
            Course::Jumped => Status::Jumped,
            Course::BeyondLimits => Status::OutsideLimits,
        })
    })
}
