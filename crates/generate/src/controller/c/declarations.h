
@about@
/* The most configurations that a call of @name@_ik lists. */
#define @NAME@_IK_MAX @max@
/* What a rotation may be off, by its largest entry, from the nearest rotation, which is meant. */
#ifndef @NAME@_IK_ROTATION_TOLERANCE
#define @NAME@_IK_ROTATION_TOLERANCE 1e-5
#endif
/* How many poses beside a singular one are solved for what it hides. 0: such calls take as long as others, list what
   @name@_solve finds, and say UNDECIDED, whether the arm can move with its hand still or not. */
#ifndef @NAME@_IK_NEIGHBOURS
#define @NAME@_IK_NEIGHBOURS 6
#endif

/* What a call says. */
typedef enum @name@_ik_status {
    /* Solved: what is listed is all. */
    @NAME@_IK_SOLVED = 0,
    /* There is no solution: the arm does not reach. */
    @NAME@_IK_NO_SOLUTION = 1,
    /* Joints can move with the hand still: solutions whose dimension is not 0 are members of families.
       Isolated solutions are listed, too, as far as poses beside this one lead to them; there may be more. */
    @NAME@_IK_FAMILY = 2,
    /* Not decided: the pose is singular, or nearly so. What is listed has the pose; there may be more that
       poses beside this one do not lead to, or some although none is listed. */
    @NAME@_IK_UNDECIDED = 3,
    /* The rotation is off by more than @NAME@_IK_ROTATION_TOLERANCE. Nothing is listed. */
    @NAME@_IK_NOT_A_ROTATION = 4,
    /* A number that is read (the pose, previous or given values, parameters, limits) is infinite or none; a previous value is
       beyond 1e6 rad, or 1e6 sizes of the arm; or limits exclude all values: a lower one above the upper one, say. */
    @NAME@_IK_NOT_FINITE = 5,
    /* There are solutions, and none that is known is within the limits. */
    @NAME@_IK_OUTSIDE_LIMITS = 6
} @name@_ik_status;

/* A configuration that has the pose. */
typedef struct @name@_ik_solution {
    /* The joint variables (rad, m). */
    double q[@n@];
    /* How far the forward model is from the pose there: turn (rad), and shift divided by the arm's size. */
    double residual;
    /* How many branches come together in it. */
    int multiplicity;
    /* @branch@ */
    int branch;
    /* In how many directions the joints can move from here with the hand still: 0 if it is isolated. */
    int dimension;
    /* Such a direction, a unit vector (m of joints that slide divided by the arm's size); 0 if there is
       none. */
    double motion[@n@];
} @name@_ik_solution;

/* What @name@_ik answers. */
typedef struct @name@_ik_result {
    /* How many solutions are listed. */
    int count;
    /* How far the rotation of the pose was from the nearest one, by its largest entry. */
    double off;
    @name@_ik_solution solutions[@NAME@_IK_MAX];
} @name@_ik_result;

/* What joints may be (rad, m). What is beyond 1e6 rad, or 1e6 sizes of the arm, is no limit. */
typedef struct @name@_ik_limits {
    double lower[@n@];
    double upper[@n@];
} @name@_ik_limits;

/* What @name@_ik_nearest answers. With NOT_A_ROTATION and NOT_FINITE q is the previous configuration, and distance, missed_shift
   and missed_turn are HUGE_VAL. */
typedef struct @name@_ik_choice {
    /* 1 if q has the pose and is within the limits. */
    int is_found;
    /* The joint variables (rad, m). With OUTSIDE_LIMITS: the nearest solution that is not within them.
       Where no solution is known: where the hand comes close, within the limits, found by descent from
       the previous configuration. */
    double q[@n@];
    /* The largest difference of a joint from the previous configuration (rad; m divided by the arm's
       size). */
    double distance;
    /* How far the rotation of the pose was from the nearest one, by its largest entry. */
    double off;
    /* By how much q misses the pose: a shift (m) and a turn (rad); 0 but for rounding where it is solved.
       Out of reach, the least distance is at most that. */
    double missed_shift;
    double missed_turn;
} @name@_ik_choice;

/* The limits of the robot's description; where it has none, minus and plus HUGE_VAL. */
extern const @name@_ik_limits @name@_limits;

/*
 * Work is bounded: no loop waits for convergence. @name@_ik calls @name@_solve once and, where that says that there may be more, for
 * each of @NAME@_IK_NEIGHBOURS poses beside, and follows what it finds by Newton's method, at most 40 steps each: such calls take some
 * hundred to some thousand times as long as others. @name@_ik_nearest calls @name@_ik once@given_bound@, and moves along families in at
 * most 60 steps a start. Nothing is allocated; each call may be made by any number of threads.
 *
 * No pointer but that to limits may be NULL. A pose is not changed. The previous configuration may be the q of the choice that is
 * written. With a negative `room` nothing is written.
 */

/*
 * All configurations that have the pose, each once. Of the pose the first three rows are read, @read@.
 * Angles are @range@. Limits are not looked at.
 */
@name@_ik_status @name@_ik(
    double pose[4][4],@given_declaration@@parameters_declaration@
    @name@_ik_result *result);

/*
 * The configuration with the pose that is nearest to the previous one, by the largest difference of a
 * joint, within the limits (NULL: those of the robot), joints moved by whole turns where that is nearer.
 * @nearest@
 */
@name@_ik_status @name@_ik_nearest(
    double pose[4][4],
    const double previous[@n@],
    const @name@_ik_limits *limits,@parameters_declaration@
    @name@_ik_choice *choice);

/*
 * All configurations of @name@_ik within the limits (NULL: those of the robot), with their copies whole turns
 * away. An angle without a limit takes one turn. Writes the first `room` of them; *count is how many
 * there are, at most 2147483647. Of families there is one member, within the limits if moving along the family leads there. The status is that of @name@_ik, or OUTSIDE_LIMITS.
 */
@name@_ik_status @name@_ik_all_within_limits(
    double pose[4][4],@given_declaration@
    const @name@_ik_limits *limits,@parameters_declaration@
    int room,
    double (*q)[@n@],
    int *count);
