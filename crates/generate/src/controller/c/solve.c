
/* What @name@_solve lists; 1 if that is all. */
static int answer_solve(
    double goal[4][4],@given_local@@parameters_local@ @name@_ik_result *result)
{
    @name@_solve_solution found[@NAME@_SOLVE_MAX];
    @name@_solve_certificate certificate;
    double values[@values@];@parameters_unread@
@flatten@    result->count = @name@_solve(values@solve_parameters@, found, &certificate);
    for (int s = 0; s < @NAME@_SOLVE_MAX && s < result->count; s++) {
        @name@_ik_solution *own = &result->solutions[s];
        memcpy(own->q, found[s].q, sizeof own->q);
        memset(own->motion, 0, sizeof own->motion);
        own->residual = found[s].residual;
        own->multiplicity = found[s].multiplicity;
        own->branch = @found_branch@;
        own->dimension = 0;
    }
    return certificate == @NAME@_SOLVE_COMPLETE;
}
