function [status, q] = @name@_ik_all_within_limits(pose@given_local@, limits@parameters_given@)
%@NAME@_IK_ALL_WITHIN_LIMITS  All configurations of a pose within limits, with copies whole turns away.
%
%   [STATUS, Q] = @NAME@_IK_ALL_WITHIN_LIMITS(POSE@GIVEN@) within the limits of the robot, @NAME@_LIMITS;
%   [STATUS, Q] = @NAME@_IK_ALL_WITHIN_LIMITS(POSE@GIVEN@, LIMITS@PARAMETERS@) within those of a struct: lower and
%   upper, 1 x @n@, infinite ones for none; [] for those of the robot. An angle without a limit takes one
%   turn. Q has a configuration a row (rad, m), at most about a million. STATUS is that of @NAME@_IK, or
%   'outside limits'. Of families there is one member, if one within the limits is found. Limits
%   beyond 1e6 rad, or 1e6 of the arm's sizes, are none; the status is 'not finite' if
%   they exclude all values.
@given_about@%@parameters_about@
%   See also @NAME@_IK, @NAME@_IK_NEAREST, @NAME@_LIMITS.

narginchk(@least@, @all_arguments@);
if nargin < @limits_place@ || isempty(limits)
    limits = @name@_limits();
end@all_default@
pose = @name@_numbers(pose, 'pose', {[4, 4], [3, 4]});@given_check@
limits.lower = @name@_numbers(limits.lower, 'limits.lower', {[1, @n@]});
limits.upper = @name@_numbers(limits.upper, 'limits.upper', {[1, @n@]});
[status, q] = @name@_answer('within', @parameters_or_none@, pose(1:3, :), @given_or_none@, limits);
end
