
function [status, goal, off] = wanted(a, pose)
% Reads position and z axis of a pose, and brings the axis to length 1; with how far it was from that.
goal = [eye(3, 2), pose(:, 3:4)];
off = 0;
if ~all(isfinite(goal(:)))
    status = 'not finite';
    return;
end
off = abs(norm(goal(:, 3)) - 1);
status = 'not a rotation';
if off <= a.tolerance
    status = 'solved';
    goal(:, 3) = goal(:, 3)/norm(goal(:, 3));
end
end

function [turn, jacobian] = turned(goal, rotation, jacobian)
% The turn that brings the z axis to that of the goal by the shortest way, and how it changes; turns about
% the axis are not seen.
z = rotation(:, 3);
turn = cross(z, goal(:, 3));
angle = atan2(norm(turn), z.'*goal(:, 3));
if norm(turn) > 1e-7
    turn = turn*angle/norm(turn);
elseif angle > 1
    % Against it: about the axis of the base that is farthest from it, made orthogonal.
    [~, k] = min(abs(z));
    axis = double((1:3).' == k) - z(k)*z;
    turn = axis*angle/norm(axis);
end
jacobian = jacobian - z*(z.'*jacobian);
end
