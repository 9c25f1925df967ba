function choice = @name@_ik_nearest(pose, previous, limits@parameters_given@)
%@NAME@_IK_NEAREST  The configuration with a pose that is nearest to the previous one.
%
%   CHOICE = @NAME@_IK_NEAREST(POSE, PREVIOUS) within the limits of the robot, @NAME@_LIMITS;
%   CHOICE = @NAME@_IK_NEAREST(POSE, PREVIOUS, LIMITS@PARAMETERS@) within those of a struct: lower and upper,
%   1 x @n@, infinite ones for none, as are those beyond 1e6 rad, or 1e6 of the arm's sizes; [] for those of
%   the robot. The status is 'not finite' if they exclude all values, or a previous value is beyond
%   that. POSE is 4 x 4, or the first three rows; PREVIOUS is 1 x @n@ (rad, m). The nearest by the largest
%   difference of a joint, joints moved by whole turns where that is nearer.
%
@nearest@
%
%   CHOICE.status        as @NAME@_IK says it, or 'outside limits': there are solutions, and none that is known
%                        is within the limits
%   CHOICE.is_found      true if q has the pose and is within the limits
%   CHOICE.q             the joint variables (rad, m). Outside limits: the nearest solution that is not within
%                        them. Where no solution is known: where the hand comes close, within the limits,
%                        found by descent from the previous configuration
%   CHOICE.distance      the largest difference of a joint from the previous configuration (rad; m divided
%                        by the arm's size). This and what is missed are Inf, and q is PREVIOUS, with
%                        'not a rotation' and 'not finite'
%   CHOICE.off           how far the rotation was from the nearest one, by its largest entry
%   CHOICE.missed_shift  by how far q misses the position (m); 0 but for rounding where it is solved. Out
%                        of reach, this is at most how far
%   CHOICE.missed_turn   by what turn it misses the rotation (rad)
%@parameters_about@
%   See also @NAME@_IK, @NAME@_IK_ALL_WITHIN_LIMITS, @NAME@_LIMITS.

narginchk(@nearest_least@, @nearest_arguments@);
if nargin < 3 || isempty(limits)
    limits = @name@_limits();
end@nearest_default@
pose = @name@_numbers(pose, 'pose', {[4, 4], [3, 4]});
previous = @name@_numbers(previous, 'previous', {[1, @n@]});
limits.lower = @name@_numbers(limits.lower, 'limits.lower', {[1, @n@]});
limits.upper = @name@_numbers(limits.upper, 'limits.upper', {[1, @n@]});
choice = @name@_answer('nearest', @parameters_or_none@, pose(1:3, :), previous, limits);
end
