function result = @name@_ik(pose@given_local@@parameters_given@)
%@NAME@_IK  All configurations that have a pose, each once.
%
%   RESULT = @NAME@_IK(POSE@GIVEN@@PARAMETERS@): POSE is 4 x 4, or the first three rows, which are read:
%   @read@.
@given_about@%   Angles are @range@. Limits are not looked at.
%
%   RESULT.status     what is said:
%     'solved'          what is listed is all
%     'no solution'     the arm does not reach
%     'family'          joints can move with the hand still: solutions whose dimension is not 0 are members of
%                       families. Isolated solutions are listed, too, as far as poses beside this one lead
%                       to them; there may be more
%     'undecided'       the pose is singular, or nearly so: what is listed has the pose; there may be more that
%                       poses beside this one do not lead to, or some although none is listed
%     'not a rotation'  the rotation is off by more than 1e-5. Nothing is listed
%     'not finite'      a number that is read is infinite or none
%   RESULT.off        how far the rotation was from the nearest one, which is meant, by its largest entry
%   RESULT.q          a solution a row (rad, m)
%   RESULT.solutions  for each a struct: q, residual (how far the forward model is from the pose there: turn,
%                     and shift divided by the arm's size), multiplicity (how many branches come together
%                     in it), branch (@branch_about@), dimension
%                     (in how many directions the joints can move from here with the hand still), motion (such
%                     a direction, a unit vector, m of joints that slide divided by the arm's size)
%@parameters_about@
%   See also @NAME@_IK_NEAREST, @NAME@_IK_ALL_WITHIN_LIMITS, @NAME@_SOLVE.

narginchk(@least@, @arguments@);@parameters_default@
pose = @name@_numbers(pose, 'pose', {[4, 4], [3, 4]});@given_check@
result = @name@_answer('ik', @parameters_or_none@, pose(1:3, :), @given_or_none@);
end
