//! Answers of the inverse kinematics: solutions, families, what stands in the way.

#![allow(unsafe_code, clippy::missing_safety_doc)] // functions of C; what pointers have to be stands in `lib.rs`

use super::objects::Answer;
use super::robot::index_error;
use crate::border::{Place, Room, array, object, take};
use crate::solver::{Found, doubt, finite, status};
use crate::trouble::{Trouble, guarded};
use crate::types::{Code, Doubt, Family, Nearest, Obstacle, Solution, Status};
use denavit::inverse;
use std::ffi::c_char;

/// Frees an answer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_answer_free(answer: *mut Answer) {
    unsafe { take(answer) }
}

/// What came of the pose, as `denavit_solve` returned it: 0 to 5.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_answer_status(answer: *const Answer) -> Status {
    guarded(|| unsafe {
        let found = &object(answer, "answer")?.0;
        Ok(status(&found.answer, found.left_out))
    })
}

/// Why there may be more solutions; `DENAVIT_DOUBT_NONE`: these are all.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_answer_doubt(answer: *const Answer, reason: *mut Code<Doubt>) -> Status {
    guarded(|| unsafe {
        let found = &object(answer, "answer")?.0;
        Place::new(reason, "reason")?.put(doubt(&found.answer).into());
        Ok(Status::Ok)
    })
}

/// How many isolated solutions and how many families there are, and how many of both the limits exclude, where they were left out. Each
/// place may be null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_answer_counts(
    answer: *const Answer,
    solutions: *mut usize,
    families: *mut usize,
    left_out: *mut usize,
) -> Status {
    guarded(|| unsafe {
        let found = &object(answer, "answer")?.0;
        let counts = [found.answer.solutions.len(), found.answer.families.len(), found.left_out.unwrap_or(0)];
        for ((place, name), count) in
            [(solutions, "solutions"), (families, "families"), (left_out, "left_out")].into_iter().zip(counts)
        {
            if let Some(place) = Place::optional(place, name)? {
                place.put(count);
            }
        }
        Ok(Status::Ok)
    })
}

/// A solution as C sees it.
fn solution(found: &Found, s: &inverse::Solution, branch: *const c_char) -> Solution {
    Solution {
        residual: s.residual,
        guard: s.guard,
        copies: found.solver.kinematics.space.copies_within(&s.q),
        multiplicity: s.multiplicity,
        within_limits: s.within_limits.into(),
        branch,
    }
}

fn solution_at(found: &Found, index: usize) -> Result<&inverse::Solution, Trouble> {
    let all = &found.answer.solutions;
    all.get(index).ok_or_else(|| index_error("solutions", index, all.len()))
}

fn family_at(found: &Found, index: usize) -> Result<&inverse::Family, Trouble> {
    let all = &found.answer.families;
    all.get(index).ok_or_else(|| index_error("families", index, all.len()))
}

/// Isolated solution `index`: its joint variables, angles in (-pi, pi] unless limits count, and what is known of it. `joints` is the length of
/// q. `solution` may be null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_answer_solution(
    answer: *const Answer,
    index: usize,
    q: *mut f64,
    joints: usize,
    solution: *mut Solution,
) -> Status {
    guarded(|| unsafe {
        let found = &object(answer, "answer")?.0;
        let s = solution_at(found, index)?;
        let told = Place::optional(solution, "solution")?;
        Room::new(q, joints, "q")?.fill(&s.q, "q")?;
        if let Some(told) = told {
            told.put(self::solution(found, s, found.branches[index].as_ptr()));
        }
        Ok(Status::Ok)
    })
}

/// The configurations within the limits that solution `index` stands for, each joint moved by whole turns, the nearest first: as many as
/// there is room for, rows of n. `count` is how many were written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_answer_copies(
    answer: *const Answer,
    index: usize,
    q: *mut f64,
    q_length: usize,
    count: *mut usize,
) -> Status {
    guarded(|| unsafe {
        let found = &object(answer, "answer")?.0;
        let s = solution_at(found, index)?;
        let place = Place::new(count, "count")?;
        let n = found.solver.joints();
        let most = q_length.checked_div(n).unwrap_or(0);
        if most * n != q_length {
            let why = format!("q has {q_length} entries, which are no rows of {n}");
            return Err(Trouble::new(Status::WrongLength, why));
        }
        Room::new(q, q_length, "q")?;
        let all = found.solver.kinematics.space.listed_copies(&s.q, most);
        let flat: Vec<f64> = all.concat();
        Room::new(q, flat.len(), "q")?.fill(&flat, "q")?;
        place.put(all.len());
        Ok(Status::Ok)
    })
}

/// Family `index`: the joint variables of one member, how the joints move there (a unit vector), and what is known of it. `joints` is the
/// length of both; `direction` and `family` may be null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_answer_family(
    answer: *const Answer,
    index: usize,
    q: *mut f64,
    direction: *mut f64,
    joints: usize,
    family: *mut Family,
) -> Status {
    guarded(|| unsafe {
        let found = &object(answer, "answer")?.0;
        let f = family_at(found, index)?;
        let told = Place::optional(family, "family")?;
        Room::new(q, joints, "q")?.fill(&f.representative.q, "q")?;
        if !direction.is_null() {
            Room::new(direction, joints, "direction")?.fill(&f.direction, "direction")?;
        }
        if let Some(told) = told {
            let branch = found.branches[found.answer.solutions.len() + index].as_ptr();
            told.put(Family {
                representative: solution(found, &f.representative, branch),
                dimension: f.dimension,
                members: f.curve.len(),
                stretches: f.feasible.len(),
                affine: f.is_affine.into(),
                bounded: f.interval.is_some().into(),
                interval: f.interval.unwrap_or([f64::NAN; 2]),
                free_unknowns: found.free[index].as_ptr(),
            });
        }
        Ok(Status::Ok)
    })
}

/// The members of family `index` that are known, rows of n, neighbours next to each other (the first again at the end of a closed one):
/// `members_length` is the family's `members` times n. And the stretches of what is free that are within the limits, a lower and an upper end
/// each: `stretches_length` is twice the family's `stretches`; it may be null with length 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_answer_members(
    answer: *const Answer,
    index: usize,
    members: *mut f64,
    members_length: usize,
    stretches: *mut f64,
    stretches_length: usize,
) -> Status {
    guarded(|| unsafe {
        let found = &object(answer, "answer")?.0;
        let f = family_at(found, index)?;
        let all: Vec<f64> = f.curve.concat();
        let ends: Vec<f64> = f.feasible.concat();
        let place = Room::new(stretches, stretches_length, "stretches")?;
        if !(stretches.is_null() && stretches_length == 0) && stretches_length != ends.len() {
            return Err(Trouble::length("stretches", stretches_length, ends.len()));
        }
        Room::new(members, members_length, "members")?.fill(&all, "members")?;
        if !stretches.is_null() {
            place.fill(&ends, "stretches")?;
        }
        Ok(Status::Ok)
    })
}

/// The configuration that is nearest to another, members of families included, within the limits if one is: joints are whole turns away from
/// a solution. `q` may be where `to` is; both have `joints` entries. `nearest` may be null. `DENAVIT_NOT_FOUND`, and q as it was, if the
/// answer has none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_answer_nearest(
    answer: *const Answer,
    to: *const f64,
    joints: usize,
    q: *mut f64,
    nearest: *mut Nearest,
) -> Status {
    guarded(|| unsafe {
        let found = &object(answer, "answer")?.0;
        let (place, told) = (Room::new(q, joints, "q")?, Place::optional(nearest, "nearest")?);
        if joints != found.solver.joints() {
            return Err(Trouble::length("to", joints, found.solver.joints()));
        }
        let to = array(to, joints, "to")?;
        finite(to, "to")?;
        let best = found.solver.kinematics.nearest(&found.pose, &found.answer, to);
        let Some(best) = best else { return Ok(Status::NotFound) };
        place.fill(&best.q, "q")?;
        if let Some(told) = told {
            told.put(Nearest { distance: best.distance, within_limits: best.within_limits.into() });
        }
        Ok(Status::Ok)
    })
}

/// Where there is no solution: the configuration that comes nearest of those that were found, by how much it misses the pose, and why.
/// `joints` is the length of q. `DENAVIT_NOT_FOUND`, and nothing written, if there are solutions or nothing is known.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn denavit_answer_obstacle(
    answer: *const Answer,
    q: *mut f64,
    joints: usize,
    obstacle: *mut Obstacle,
) -> Status {
    guarded(|| unsafe {
        let found = &object(answer, "answer")?.0;
        let (room, told) = (Room::new(q, joints, "q")?, Place::new(obstacle, "obstacle")?);
        let (Some(o), Some(words)) = (&found.answer.obstacle, &found.obstacle) else {
            return Ok(Status::NotFound);
        };
        room.fill(&o.q, "q")?;
        told.put(Obstacle { angle: o.angle, distance: o.distance, message: words.as_ptr() });
        Ok(Status::Ok)
    })
}
