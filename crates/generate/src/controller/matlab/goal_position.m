
function [status, goal, off] = wanted(a, pose) %#ok<INUSL>
% Reads the position of a pose.
goal = [eye(3), pose(:, 4)];
off = 0;
status = 'solved';
if ~all(isfinite(pose(:, 4)))
    status = 'not finite';
end
end

function [turn, jacobian] = turned(goal, rotation, jacobian) %#ok<INUSL>
% The rotation is not looked at.
turn = zeros(3, 1);
jacobian = zeros(size(jacobian));
end
