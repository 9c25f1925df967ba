
@about@
#define @NAME@_SOLVE_MAX 16

/* Whether @name@_solve found all solutions. */
typedef enum @name@_solve_certificate {
    /* All of them, each of them isolated. */
    @NAME@_SOLVE_COMPLETE = 0,
    /* Two come together, or are about to, or miss each other by less than rounding tells; or the
       arm can move with its hand still. */
    @NAME@_SOLVE_NEAR_DOUBLE_ROOT = 1,
    /* There may be more. */
    @NAME@_SOLVE_UNDECIDED = 2,
    /* The rotation is off by more than a tenth, or something is no number. */
    @NAME@_SOLVE_NOT_A_POSE = 3
} @name@_solve_certificate;

typedef struct @name@_solve_solution {
    /* The joint variables. */
    double q[6];
    /* How far the forward model is from the pose: turn (rad) and shift divided by the arm's size. */
    double residual;
    /* The smallest singular value of the Jacobian, lengths divided by the arm's size. */
    double singular;
    /* 2 where two solutions come together, else 1. */
    int multiplicity;
} @name@_solve_solution;

/* Fills the array of the caller; returns the number of solutions. The certificate may be NULL.
   The rotation nearest to that of the pose is meant: rounded numbers will do. */
int @name@_solve(
    const double pose[12],
    @name@_solve_solution solutions[@NAME@_SOLVE_MAX],
    @name@_solve_certificate *certificate);
