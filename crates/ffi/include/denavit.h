/**
 * denavit.h
 *
 * Denavit for C and for whatever calls C: robots, their poses, Jacobians, torques, and all solutions of the inverse
 * kinematics.
 *
 * Status. What can fail returns a `denavit_status`: 0 where all is as usual, a positive one where there is an answer of
 * another kind (a pose out of reach, a family of solutions), a negative one where nothing was computed and nothing was
 * written. What went wrong in words, with file, line and column where it is a description, is what
 * `denavit_error_message` and `denavit_error_finding` say until the next failure on the same thread. No panic leaves
 * the library, and no bad argument ends the program, as far as pointers tell what they are: a pointer is null, or
 * points to what its type says, `length` of them where it is an array.
 *
 * Units. SI units and radians, right-handed frames. Matrices are row by row. Joints and frames are counted from 0;
 * frame 0 is that at the root of the table, frame i the one behind row i.
 *
 * Lengths. Each array comes with the number of its entries (doubles, poses), and must have exactly those that are
 * meant; `joints` is the length of each vector before it, and must be the robot's number of joints. What is written
 * must not overlap what is read, unless it is said that it may. An array of length 0 may be null.
 *
 * Texts are UTF-8. Those that are given end with a zero byte, or come with their length; those that come out end with a
 * zero byte and belong to the object that they were asked of: they are there until it is freed, and are not to be
 * freed.
 *
 * Objects. What ends in `_new`, or makes a robot or an answer, gives an object, which is freed by its own `_free`;
 * freeing null does nothing. Objects never change: one of them may be used by any number of threads at once, and freed
 * when none of them uses it any more. A solver and an answer do not need the robot that they were made from. There is
 * no global state, but the last error of each thread.
 */
#ifndef DENAVIT_H
#define DENAVIT_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif


/* Types: statuses, names of functions, and structures that are read and written. */

/** How a call ended. Negative: nothing was computed. */
typedef int32_t denavit_status;

enum {
  /** Done. Of an answer: these are all solutions, each isolated. */
  DENAVIT_OK = 0,
  /**
   * These are all solutions, and some hang together: the arm can move there with its hand still (a singular pose, a
   * redundant arm).
   */
  DENAVIT_FAMILY = 1,
  /** There are solutions; whether these are all is not decided. */
  DENAVIT_UNDECIDED = 2,
  /** It is certain that there is no solution: the pose is out of reach. */
  DENAVIT_UNREACHABLE = 3,
  /** No solution was found; whether there is one is not decided. */
  DENAVIT_NOT_FOUND = 4,
  /** There are solutions, and the limits of the joints exclude all of them. */
  DENAVIT_OUTSIDE_LIMITS = 5,
  /** A solution within the limits, which is not near to where the joints were. */
  DENAVIT_JUMPED = 6,
  /** A pointer is null that must not be, or is not aligned. */
  DENAVIT_BAD_POINTER = -1,
  /** An array has another length than it must have. */
  DENAVIT_WRONG_LENGTH = -2,
  /** A text is no UTF-8. */
  DENAVIT_NOT_TEXT = -3,
  /** There is no such joint, frame, link, parameter, function, convention, …, or it does not fit the robot. */
  DENAVIT_BAD_ARGUMENT = -4,
  /** A number is infinite or none. */
  DENAVIT_NOT_FINITE = -5,
  /**
   * A matrix is no pose: its rotation is not orthonormal within 1e-5, is a reflection, or its last row is not 0 0 0 1.
   */
  DENAVIT_NOT_A_ROTATION = -6,
  /** The catalogue has no such robot. */
  DENAVIT_UNKNOWN_ROBOT = -7,
  /** A file cannot be read, or its ending is not known. */
  DENAVIT_BAD_FILE = -8,
  /** A description has errors: `denavit_error_finding` has each with its place. */
  DENAVIT_BAD_DESCRIPTION = -9,
  /** There is no such chain in the description. */
  DENAVIT_NO_CHAIN = -10,
  /** A parameter of the robot has no value. */
  DENAVIT_MISSING_VALUE = -11,
  /** The description says nothing of masses. */
  DENAVIT_NO_MASSES = -12,
  /** There is no such program or solver for this robot. */
  DENAVIT_UNSUPPORTED = -13,
  /** A fault of the library: it panicked, which was caught. */
  DENAVIT_PANIC = -14
};

/** The convention of a Denavit-Hartenberg table: which elementary transforms make a row, in this order. */
typedef int32_t denavit_convention;

enum {
  /** None is named. */
  DENAVIT_CONVENTION_NONE = 0,
  /** Rz(theta) Tz(d) Tx(a) Rx(alpha): the cells of a row are theta, d, a, alpha. */
  DENAVIT_CONVENTION_STANDARD = 1,
  /** Rx(alpha) Tx(a) Rz(theta) Tz(d): alpha, a, theta, d. */
  DENAVIT_CONVENTION_CRAIG = 2,
  /** Rx(alpha) Tx(d) Rz(theta) Tz(r): alpha, d, theta, r. */
  DENAVIT_CONVENTION_KHALIL = 3
};

/** How a joint moves. */
typedef int32_t denavit_joint_kind;

enum {
  /** It turns: radians. */
  DENAVIT_REVOLUTE = 0,
  /** It slides: metres. */
  DENAVIT_PRISMATIC = 1,
  /** A row of a table that does not move, and is no joint. */
  DENAVIT_FIXED = 2
};

/** What of the hand is given. */
typedef int32_t denavit_goal;

enum {
  /** All of the pose. */
  DENAVIT_GOAL_POSE = 0,
  /** The position of the tool: the rotation of a pose does not count. */
  DENAVIT_GOAL_POSITION = 1
};

/** Functions of joint variables q, rates qd, and accelerations qdd or torques. n is the number of joints. */
typedef int32_t denavit_function;

enum {
  /** q: the tool in the base, 16 numbers, as `denavit_pose` has them. */
  DENAVIT_FUNCTION_FK = 0,
  /** q: frames 0, 1, … of the table and the tool in the base, 16 numbers each. */
  DENAVIT_FUNCTION_FRAMES = 1,
  /** q: the geometric Jacobian of the tool along the axes of the base, 6 x n. */
  DENAVIT_FUNCTION_JACOBIAN = 2,
  /** q, qd, qdd: the torques of the drives (N m; N of a slide), n. */
  DENAVIT_FUNCTION_TORQUE = 3,
  /** q: the inertia matrix, n x n. */
  DENAVIT_FUNCTION_INERTIA = 4,
  /** q, qd: the torques without accelerations, with gravity and friction, n. */
  DENAVIT_FUNCTION_BIAS = 5,
  /** q: the torques that hold the arm at rest, n. */
  DENAVIT_FUNCTION_GRAVITY = 6,
  /** q, qd, torques: the accelerations of the joints, n. */
  DENAVIT_FUNCTION_ACCELERATION = 7,
  /** q, qd: the kinetic and the potential energy (J), 2. */
  DENAVIT_FUNCTION_ENERGY = 8,
  /** q, qd, qdd: the derivatives of the torques by q, by qd and by qdd side by side, n x 3n. */
  DENAVIT_FUNCTION_TORQUE_DERIVATIVES = 9,
  /** q, qd, torques: the derivatives of the accelerations by q, by qd and by the torques side by side, n x 3n. */
  DENAVIT_FUNCTION_ACCELERATION_DERIVATIVES = 10,
  /** q, qd, qdd: a column with the torques, and the derivatives behind it, n x (3n + 1). */
  DENAVIT_FUNCTION_TORQUE_WITH_DERIVATIVES = 11,
  /** q, qd, torques: a column with the accelerations, and the derivatives behind it, n x (3n + 1). */
  DENAVIT_FUNCTION_ACCELERATION_WITH_DERIVATIVES = 12
};

/** Why an answer may lack solutions. */
typedef int32_t denavit_doubt;

enum {
  /** It lacks none: all solutions are there. */
  DENAVIT_DOUBT_NONE = 0,
  /** Some were found by trying values or from nearby, where others may hide. */
  DENAVIT_DOUBT_SAMPLED = 1,
  /** Two roots nearly coincide: whether they are two, one or none is below rounding. */
  DENAVIT_DOUBT_DOUBLE_ROOT = 2,
  /** The roots could not be counted. */
  DENAVIT_DOUBT_UNCOUNTED = 3,
  /** They were searched for by descent from several starts. */
  DENAVIT_DOUBT_SEARCHED = 4,
  /** One was asked for. */
  DENAVIT_DOUBT_ONE_ASKED = 5,
  /** Gears repeat each configuration more often within a turn than is listed. */
  DENAVIT_DOUBT_COPIES = 6,
  /** The robot stands so far from the origin that a pose has too few digits. */
  DENAVIT_DOUBT_DIGITS = 7
};

/** The tool, where a frame is asked for. */
enum { DENAVIT_TOOL = -1 };

/** The base, where a frame is asked for: what frame 0 stands in. */
enum { DENAVIT_BASE = -2 };

/** How bad a finding is. */
typedef int32_t denavit_finding_severity;

enum {
  /** The description means nothing. */
  DENAVIT_FINDING_ERROR = 0,
  /** It may not mean what it was to. */
  DENAVIT_FINDING_WARNING = 1,
  /** What was understood. */
  DENAVIT_FINDING_NOTE = 2
};

/**
 * A pose: the matrix that takes coordinates in a frame (the tool, say) to those in the base, row by row; the last row
 * is 0 0 0 1. Its last column is the position, metres.
 */
typedef struct denavit_pose {
  /** Rows. */
  double matrix[4][4];
} denavit_pose;

/** How a description is read. All zero is usual. */
typedef struct denavit_options {
  /** The link or frame at which the chain begins; null: the root. */
  const char *base;
  /** The link or frame at which it ends; null: the leaf with the most joints. */
  const char *tip;
  /** The convention of a table that does not say it, or of the table that is made of bodies. */
  denavit_convention convention;
  /** Not 0: decimals of angles are taken as they are written (1.5708 is no quarter turn). */
  int32_t as_written;
  /** What columns of a table are in where it does not say it: 0 not told, 1 radians, 2 degrees. */
  int32_t angles;
  /** The same of lengths: 0 not told, 1 metres, 2 millimetres. */
  int32_t lengths;
  /** Which table or robot of a document, from 1; 0: there is one. */
  size_t table;
  /** What the columns of a table mean, as `theta,d,a,alpha`; null: it says it. */
  const char *columns;
  /** Values of a xacro file's arguments: names and values in turn. */
  const char *const *arguments;
  /** How many texts these are. */
  size_t arguments_length;
  /** Folders of packages: names and paths in turn. */
  const char *const *packages;
  /** How many texts these are. */
  size_t packages_length;
} denavit_options;

/** A joint. Its texts belong to the robot. */
typedef struct denavit_joint {
  /** The joint variable in the table: `q1`. */
  const char *variable;
  /** What the description calls the joint; null where it does not. */
  const char *name;
  /** Revolute or prismatic. */
  denavit_joint_kind kind;
  /** Whether limits are known. */
  int32_t limited;
  /** The lowest value, radians or metres; minus infinity where it is not known. */
  double lower;
  /** The highest value; infinity where it is not known. */
  double upper;
  /** The largest speed, rad/s or m/s; infinity where it is not known. */
  double velocity;
} denavit_joint;

/** A finding in a description. Its texts belong to the robot or to the error that it was asked of. */
typedef struct denavit_finding {
  /** How bad it is. */
  denavit_finding_severity severity;
  /** From 1; 0 where there is no place. */
  size_t line;
  /** From 1, in characters. */
  size_t column;
  /** The file, or what the text is called. */
  const char *file;
  /** What was found. */
  const char *message;
  /** What would help; null where nothing is known. */
  const char *hint;
  /** All of it, with the line of the text and a mark below the place. */
  const char *rendered;
} denavit_finding;

/** A solution of the inverse kinematics. Its texts belong to the answer. */
typedef struct denavit_solution {
  /**
   * The distance from the pose, without dimension: the rotation (Frobenius norm of two columns), and the position by
   * the arm's size.
   */
  double residual;
  /**
   * The smallest quantity that formulas divide by, without dimension: joints are determined to about 1e-16 by it; 0
   * where it is not known.
   */
  double guard;
  /** How many configurations within the limits it stands for, joints moved by whole turns; 0 if they exclude all. */
  uint64_t copies;
  /** How many branches coincide here. */
  uint32_t multiplicity;
  /** Whether the limits allow it, or a copy of it whole turns away. */
  int32_t within_limits;
  /** The branch: `shoulder+ elbow− wrist+`; empty where branches have no names. */
  const char *branch;
} denavit_solution;

/** A family: configurations with the pose that hang together. Its texts belong to the answer. */
typedef struct denavit_family {
  /** One of them. */
  denavit_solution representative;
  /** How many parameters it has. */
  size_t dimension;
  /** How many members along it are known, neighbours next to each other; 0 where it was not followed. */
  size_t members;
  /** How many stretches of what is free are known to be within the limits. */
  size_t stretches;
  /** Whether the joints move in the same proportions everywhere: q + t direction is in the family for each t. */
  int32_t affine;
  /** Whether the interval is known. */
  int32_t bounded;
  /** For one free unknown the values for which there is a solution, radians or metres. */
  double interval[2];
  /** The unknowns that are free, separated by commas: `q4`, or `q2 + q3 + q4`. */
  const char *free_unknowns;
} denavit_family;

/** Why a pose has no solution, and how near the arm comes. Its text belongs to the answer. */
typedef struct denavit_obstacle {
  /** The rotation that is missing at the nearest configuration that was found, radians. */
  double angle;
  /** The displacement that is missing there, metres. */
  double distance;
  /** Why, in words. */
  const char *message;
} denavit_obstacle;

/** A configuration that follows another. */
typedef struct denavit_tracked {
  /** Its distance from the pose, as that of a solution. */
  double residual;
  /** The largest change of a joint, radians, and lengths by the arm's reach. */
  double distance;
  /**
   * The smallest singular value of the Jacobian, lengths by the reach, or up to a third less: 0 at a singular
   * configuration, and where fewer than six joints move or the goal is less than a pose.
   */
  double guard;
  /** How many joints are at a limit. */
  size_t at_limit;
} denavit_tracked;

/** A configuration near to another. */
typedef struct denavit_nearest {
  /** The largest difference of a joint, radians, and lengths by the arm's reach. */
  double distance;
  /** Whether the limits allow it. */
  int32_t within_limits;
} denavit_nearest;


/* Objects: what only pointers to are seen of. */

/** A robot: one chain of joints with its tool. Used by any number of threads at once. */
typedef struct denavit_robot denavit_robot;

/** The inverse kinematics of a robot, prepared. Used by any number of threads at once. */
typedef struct denavit_solver denavit_solver;

/** All that was found for a pose. */
typedef struct denavit_answer denavit_answer;


/* Errors: what went wrong last on this thread, and the version. */

/**
 * What went wrong in the last call on this thread that returned a negative status; an empty text if none did. It is
 * there until the next such call on this thread, or the end of the thread.
 */
const char *denavit_error_message(void);

/** How many findings belong to it: those of a description that has errors, warnings and notes among them. */
size_t denavit_error_findings(void);

/** Finding `index` of the last error of this thread. Its texts are there as long as the message. */
denavit_status denavit_error_finding(size_t index, denavit_finding *finding);

/** What a status is, in a few words; never null. */
const char *denavit_status_text(denavit_status status);

/** The version of the library: `0.1.0`. */
const char *denavit_version(void);


/* Robots: from the catalogue, from files, texts and tables; what they are. */

/** How many robots the catalogue has. */
size_t denavit_catalogue_length(void);

/** The name of robot `index` of the catalogue. The text is always there. */
denavit_status denavit_catalogue(size_t index, const char **name);

/** A robot of the catalogue, by its name: `ur5`. `options` may be null. */
denavit_status denavit_robot_catalogue(const char *name, const denavit_options *options, denavit_robot **robot);

/**
 * A robot from a file: a robot file (.toml, .par), a URDF, xacro or MJCF, a table in Markdown, CSV or LaTeX, or a
 * program (.py, .m), which is read and not run. `options` may be null.
 */
denavit_status denavit_robot_file(const char *path, const denavit_options *options, denavit_robot **robot);

/**
 * A robot from `length` bytes of text, which need no end. `format` is the ending that a file of it would have (`urdf`,
 * `toml`, `md`, `csv`, …); null: bodies by the root element, a robot file by its heads, else a table of Markdown. Files
 * that it names are looked for in the working folder and in packages. `options` may be null.
 */
denavit_status denavit_robot_text(
    const char *text,
    size_t length,
    const char *format,
    const denavit_options *options,
    denavit_robot **robot
);

/**
 * A robot from a Denavit-Hartenberg table in numbers, metres and radians. Each of its `rows` has 4 cells in the order
 * of the convention: `cells_length` is 4 times `rows`. `kinds` says of each row how it moves (`DENAVIT_REVOLUTE`,
 * `DENAVIT_PRISMATIC`, `DENAVIT_FIXED`); the joint variable is added to the cell that it moves. `limits` has the lowest
 * and the highest value of each row (`limits_length` is twice `rows`; not finite: no limits); it may be null with
 * length 0. `base` is frame 0 in the base, `tool` the tool in the last frame; each may be null. A number that is the
 * nearest double to a multiple of pi/12 is that angle exactly.
 */
denavit_status denavit_robot_table(
    denavit_convention convention,
    size_t rows,
    const double *cells,
    size_t cells_length,
    const denavit_joint_kind *kinds,
    size_t kinds_length,
    const double *limits,
    size_t limits_length,
    const denavit_pose *base,
    const denavit_pose *tool,
    denavit_robot **robot
);

/**
 * Another chain of what a robot was read from: from `base` to `tip`, each a link or frame, or null. Its file is read
 * again.
 */
denavit_status denavit_robot_chain(
    const denavit_robot *robot,
    const char *base,
    const char *tip,
    denavit_robot **chain
);

/** The same robot with a value for a parameter of its table, metres or radians. */
denavit_status denavit_robot_set(const denavit_robot *robot, const char *name, double value, denavit_robot **changed);

/** Frees a robot. */
void denavit_robot_free(denavit_robot *robot);

/** The robot's name. */
denavit_status denavit_robot_name(const denavit_robot *robot, const char **name);

/** The robot as the text of a robot file (TOML), exact: `denavit_robot_text` reads it again. */
denavit_status denavit_robot_toml(const denavit_robot *robot, const char **toml);

/** The convention of the robot's table. */
denavit_status denavit_robot_convention(const denavit_robot *robot, denavit_convention *convention);

/** How many joints the robot has: the length of q. */
denavit_status denavit_robot_joints(const denavit_robot *robot, size_t *joints);

/** Joint `index`, from 0. */
denavit_status denavit_robot_joint(const denavit_robot *robot, size_t index, denavit_joint *joint);

/** Which joint has a name: its variable, or what the description calls it; or its number from 1. */
denavit_status denavit_robot_find_joint(const denavit_robot *robot, const char *name, size_t *index);

/** How many frames the robot's table has: one more than rows. The tool is none of them. */
denavit_status denavit_robot_frames(const denavit_robot *robot, size_t *frames);

/** Which frame has a name: that of its row, or its number. */
denavit_status denavit_robot_find_frame(const denavit_robot *robot, const char *name, int32_t *frame);

/** Whether the description says something of masses: 1 or 0. */
denavit_status denavit_robot_has_masses(const denavit_robot *robot, int32_t *has_masses);

/** How many warnings and notes the description of a robot gave. */
denavit_status denavit_robot_findings(const denavit_robot *robot, size_t *findings);

/** Warning or note `index` of a robot's description. */
denavit_status denavit_robot_finding(const denavit_robot *robot, size_t index, denavit_finding *finding);


/* Poses, frames, Jacobians; functions of many states. */

/** The pose of the tool in the base at q. `joints` is the length of q. */
denavit_status denavit_fk(const denavit_robot *robot, const double *q, size_t joints, denavit_pose *pose);

/**
 * Frames 0, 1, … of the table and, behind them, the tool, all in the base at q: `poses_length` is one more than the
 * number of frames.
 */
denavit_status denavit_frames(
    const denavit_robot *robot,
    const double *q,
    size_t joints,
    denavit_pose *poses,
    size_t poses_length
);

/**
 * The geometric Jacobian of the origin of frame `of` in the base, along the axes of frame `axes`, at q: 6 x n, row by
 * row; rows vx, vy, vz (m/rad, or 1 for a joint that slides), wx, wy, wz. A frame is its number, `DENAVIT_TOOL` or
 * `DENAVIT_BASE`. `jacobian_length` is 6 n.
 */
denavit_status denavit_jacobian(
    const denavit_robot *robot,
    int32_t of,
    int32_t axes,
    const double *q,
    size_t joints,
    double *jacobian,
    size_t jacobian_length
);

/**
 * How many numbers a function reads of a state, and how many it gives. It is derived and compiled now, which may take
 * seconds for derivatives of dynamics: the first call of a function does it otherwise. Each of the two places may be
 * null.
 */
denavit_status denavit_prepare(const denavit_robot *robot, denavit_function function, size_t *inputs, size_t *outputs);

/**
 * A function of `rows` states: a row of inputs is the vectors that the function reads, one behind the other (q, then
 * qd, then qdd or torques), a row of outputs its results. `inputs_length` and `outputs_length` are those of
 * `denavit_prepare`, times `rows`. By `threads` threads; 0: one a core. A row's results have the same bits whatever the
 * number of rows and threads.
 */
denavit_status denavit_evaluate(
    const denavit_robot *robot,
    denavit_function function,
    size_t rows,
    const double *inputs,
    size_t inputs_length,
    double *outputs,
    size_t outputs_length,
    size_t threads
);


/* Torques, inertia, accelerations, energies of one state; of many states, and with derivatives: `denavit_evaluate`. */

/**
 * The torques of the drives (N m; N of a slide) for accelerations qdd in the state q, qd, with gravity, rotors and
 * friction. All vectors have `joints` entries; the torques may be where one of the others is.
 */
denavit_status denavit_torque(
    const denavit_robot *robot,
    const double *q,
    const double *qd,
    const double *qdd,
    size_t joints,
    double *torque
);

/** The torques without accelerations: Coriolis and centrifugal ones, gravity and friction. */
denavit_status denavit_bias(
    const denavit_robot *robot,
    const double *q,
    const double *qd,
    size_t joints,
    double *torque
);

/** The torques that hold the arm at rest. */
denavit_status denavit_gravity(const denavit_robot *robot, const double *q, size_t joints, double *torque);

/** The inertia matrix, n x n, row by row: `inertia_length` is n squared. */
denavit_status denavit_inertia(
    const denavit_robot *robot,
    const double *q,
    size_t joints,
    double *inertia,
    size_t inertia_length
);

/** The accelerations of the joints for torques in the state q, qd. */
denavit_status denavit_acceleration(
    const denavit_robot *robot,
    const double *q,
    const double *qd,
    const double *torque,
    size_t joints,
    double *qdd
);

/** The kinetic and the potential energy in the state q, qd, joules. */
denavit_status denavit_energy(
    const denavit_robot *robot,
    const double *q,
    const double *qd,
    size_t joints,
    double *kinetic,
    double *potential
);


/* Inverse kinematics: solvers; many poses at once; one pose after the other. */

/**
 * Prepares the inverse kinematics of a robot: derives a closed form, or chooses another method, which takes up to a
 * second. `given` are joints (from 0) whose values go with each pose, `given_length` of them; null with length 0: none
 * is chosen, and an arm with more joints than the hand can use is answered with its self-motion.
 */
denavit_status denavit_solver_new(
    const denavit_robot *robot,
    denavit_goal goal,
    const size_t *given,
    size_t given_length,
    denavit_solver **solver
);

/** Frees a solver. */
void denavit_solver_free(denavit_solver *solver);

/** The method: `closed form`, `elimination`, `self-motion` or `descent`. */
denavit_status denavit_solver_method(const denavit_solver *solver, const char **method);

/** How many joints are given beside the pose: the length of `given` in the calls below. */
denavit_status denavit_solver_given_length(const denavit_solver *solver, size_t *given_length);

/** Which joints these are, in the order of their values. */
denavit_status denavit_solver_given(const denavit_solver *solver, size_t *given, size_t given_length);

/**
 * All solutions of a pose of the tool in the base, as an object that is asked for them; its status is returned, too.
 * `given` are the values of given joints; null with length 0: 0, or the middle of limits that exclude it.
 * `within_limits`, not 0: what the limits exclude is left out, and what is left stands where they allow it. A pose is
 * taken to be as precise as its rotation is orthonormal: the nearest rotation is meant.
 */
denavit_status denavit_solve(
    const denavit_solver *solver,
    const denavit_pose *pose,
    const double *given,
    size_t given_length,
    int32_t within_limits,
    denavit_answer **answer
);

/**
 * All solutions of many poses, without an object: at most `most` a pose, and behind the isolated ones one of each
 * family. `q` has room for `most` rows of n a pose (`q_length` is poses_length x most x n), the rest of which is filled
 * with NaN; `residuals` for `most` a pose, or it is null with length 0. `counts` says how many there are of each pose,
 * which may be more than `most`; `statuses` what came of each pose, as `denavit_solve` would return it, negative where
 * it is none. `given`: the values of given joints, the same for all poses. By `threads` threads; 0: one a core.
 */
denavit_status denavit_ik(
    const denavit_solver *solver,
    const denavit_pose *poses,
    size_t poses_length,
    const double *given,
    size_t given_length,
    int32_t within_limits,
    size_t most,
    double *q,
    size_t q_length,
    double *residuals,
    size_t residuals_length,
    size_t *counts,
    size_t counts_length,
    denavit_status *statuses,
    size_t statuses_length,
    size_t threads
);

/**
 * The configuration for a pose that is nearest to the previous one, within the limits if one is, for a controller that
 * goes from pose to pose: a few steps of Newton's method where the pose is near, all solutions where these do not lead
 * to it. Joints that are given stay. `q` may be where `previous` is; both have `joints` entries. `tracked` may be null.
 *
 * Returns 0 where the joints move by less than half a radian (slides: half the reach), `DENAVIT_JUMPED` where the
 * nearest of all that are known is further away, `DENAVIT_OUTSIDE_LIMITS` where it leaves the limits,
 * `DENAVIT_NOT_FOUND` where there is none, and q is as it was.
 */
denavit_status denavit_track(
    const denavit_solver *solver,
    const denavit_pose *pose,
    const double *previous,
    size_t joints,
    double *q,
    denavit_tracked *tracked
);


/* Answers of the inverse kinematics: solutions, families, what stands in the way. */

/** Frees an answer. */
void denavit_answer_free(denavit_answer *answer);

/** What came of the pose, as `denavit_solve` returned it: 0 to 5. */
denavit_status denavit_answer_status(const denavit_answer *answer);

/** Why there may be more solutions; `DENAVIT_DOUBT_NONE`: these are all. */
denavit_status denavit_answer_doubt(const denavit_answer *answer, denavit_doubt *reason);

/**
 * How many isolated solutions and how many families there are, and how many of both the limits exclude, where they were
 * left out. Each place may be null.
 */
denavit_status denavit_answer_counts(
    const denavit_answer *answer,
    size_t *solutions,
    size_t *families,
    size_t *left_out
);

/**
 * Isolated solution `index`: its joint variables, angles in (-pi, pi] unless limits count, and what is known of it.
 * `joints` is the length of q. `solution` may be null.
 */
denavit_status denavit_answer_solution(
    const denavit_answer *answer,
    size_t index,
    double *q,
    size_t joints,
    denavit_solution *solution
);

/**
 * The configurations within the limits that solution `index` stands for, each joint moved by whole turns, the nearest
 * first: as many as there is room for, rows of n. `count` is how many were written.
 */
denavit_status denavit_answer_copies(
    const denavit_answer *answer,
    size_t index,
    double *q,
    size_t q_length,
    size_t *count
);

/**
 * Family `index`: the joint variables of one member, how the joints move there (a unit vector), and what is known of
 * it. `joints` is the length of both; `direction` and `family` may be null.
 */
denavit_status denavit_answer_family(
    const denavit_answer *answer,
    size_t index,
    double *q,
    double *direction,
    size_t joints,
    denavit_family *family
);

/**
 * The members of family `index` that are known, rows of n, neighbours next to each other (the first again at the end of
 * a closed one): `members_length` is the family's `members` times n. And the stretches of what is free that are within
 * the limits, a lower and an upper end each: `stretches_length` is twice the family's `stretches`; it may be null with
 * length 0.
 */
denavit_status denavit_answer_members(
    const denavit_answer *answer,
    size_t index,
    double *members,
    size_t members_length,
    double *stretches,
    size_t stretches_length
);

/**
 * The configuration that is nearest to another, members of families included, within the limits if one is: joints are
 * whole turns away from a solution. `q` may be where `to` is; both have `joints` entries. `nearest` may be null.
 * `DENAVIT_NOT_FOUND`, and q as it was, if the answer has none.
 */
denavit_status denavit_answer_nearest(
    const denavit_answer *answer,
    const double *to,
    size_t joints,
    double *q,
    denavit_nearest *nearest
);

/**
 * Where there is no solution: the configuration that comes nearest of those that were found, by how much it misses the
 * pose, and why. `joints` is the length of q. `DENAVIT_NOT_FOUND`, and nothing written, if there are solutions or
 * nothing is known.
 */
denavit_status denavit_answer_obstacle(
    const denavit_answer *answer,
    double *q,
    size_t joints,
    denavit_obstacle *obstacle
);

#ifdef __cplusplus
}
#endif

#endif
