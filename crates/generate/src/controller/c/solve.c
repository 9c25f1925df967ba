
/* What @name@_solve lists: how many, and whether that is all. */
static int answer_list(
    double goal[4][4],@given_local@@parameters_local@
    @name@_solve_solution found[@NAME@_SOLVE_MAX],
    int *is_all)
{
    @name@_solve_certificate certificate;
    double values[@values@];@parameters_unread@
@flatten@    const int count = @name@_solve(values@solve_parameters@, found, &certificate);
    *is_all = certificate == @NAME@_SOLVE_COMPLETE;
    return count < @NAME@_SOLVE_MAX ? count : @NAME@_SOLVE_MAX;
}

/* The same as a result; 1 if that is all. */
static NOINLINE int answer_solve(
    double goal[4][4],@given_local@@parameters_local@ @name@_ik_result *result)
{
    @name@_solve_solution found[@NAME@_SOLVE_MAX];
    int is_all;
    const int count = answer_list(goal@given_passed@@parameters_passed@, found, &is_all);
    for (int s = 0; s < @NAME@_SOLVE_MAX && s < count; s++) {
        @name@_ik_solution *own = &result->solutions[s];
        memcpy(own->q, found[s].@solve_result@, sizeof own->q);
        memset(own->motion, 0, sizeof own->motion);
        own->residual = found[s].residual;
        own->multiplicity = found[s].multiplicity;
        own->branch = @found_branch@;
        own->dimension = 0;
    }
    result->count = count;
    return is_all;
}
