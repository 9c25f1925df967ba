//! Denavit for C and for whatever calls C: robots, their poses, Jacobians, torques, and all solutions of the inverse kinematics.
//!
//! Status. What can fail returns a `denavit_status`: 0 where all is as usual, a positive one where there is an answer of another kind
//! (a pose out of reach, a family of solutions), a negative one where nothing was computed and nothing was written. What went wrong in
//! words, with file, line and column where it is a description, is what `denavit_error_message` and `denavit_error_finding` say until
//! the next failure on the same thread. No panic leaves the library, and no bad argument ends the program, as far as pointers tell what
//! they are: a pointer is null, or points to what its type says, `length` of them where it is an array.
//!
//! Units. SI units and radians, right-handed frames. Matrices are row by row. Joints and frames are counted from 0; frame 0 is that at the
//! root of the table, frame i the one behind row i.
//!
//! Lengths. Each array comes with the number of its entries (doubles, poses), and must have exactly those that are meant; `joints` is the
//! length of each vector before it, and must be the robot's number of joints. What is written must not overlap what is read, unless it is
//! said that it may. An array of length 0 may be null.
//!
//! Texts are UTF-8. Those that are given end with a zero byte, or come with their length; those that come out end with a zero byte and
//! belong to the object that they were asked of: they are there until it is freed, and are not to be freed.
//!
//! Objects. What ends in `_new`, or makes a robot or an answer, gives an object, which is freed by its own `_free`; freeing null does
//! nothing. Objects never change: one of them may be used by any number of threads at once, and freed when none of them uses it any more.
//! A solver and an answer do not need the robot that they were made from. There is no global state, but the last error of each thread.

mod border;
mod c;
mod dh;
mod functions;
mod loading;
mod robot;
mod solver;
mod trouble;
mod types;
