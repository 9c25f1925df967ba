function limits = @name@_limits()
%@NAME@_LIMITS  What joints may be (rad, m).
%
%   LIMITS = @NAME@_LIMITS() is a struct of lower and upper, 1 x @n@: the limits of the robot's description,
%   infinite where it has none.

limits.lower = @lower@;
limits.upper = @upper@;
end
