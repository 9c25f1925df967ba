
@about@
#define @NAME@_IK_MAX 16

/* Whether @name@_ik found all solutions. */
typedef enum @name@_ik_certificate {
    /* All of them, each of them isolated. */
    @NAME@_IK_COMPLETE = 0,
    /* Two come together, or are about to, or miss each other by less than rounding tells; or the
       arm can move with its hand still. */
    @NAME@_IK_NEAR_DOUBLE_ROOT = 1,
    /* There may be more. */
    @NAME@_IK_UNDECIDED = 2,
    /* The rotation is off by more than a tenth, or something is no number. */
    @NAME@_IK_NOT_A_POSE = 3
} @name@_ik_certificate;

typedef struct @name@_ik_solution {
    /* The joint variables. */
    double q[6];
    /* How far the forward model is from the pose: turn (rad) and shift divided by the arm's size. */
    double residual;
    /* The smallest singular value of the Jacobian, lengths divided by the arm's size. */
    double singular;
    /* 2 where two solutions come together, else 1. */
    int multiplicity;
} @name@_ik_solution;

/* Fills the array of the caller; returns the number of solutions. The certificate may be NULL.
   The rotation nearest to that of the pose is meant: rounded numbers will do. */
int @name@_ik(
    const double pose[12],
    @name@_ik_solution solutions[@NAME@_IK_MAX],
    @name@_ik_certificate *certificate);
