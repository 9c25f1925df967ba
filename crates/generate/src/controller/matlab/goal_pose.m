
function [status, goal, off] = wanted(a, pose)
% Reads a pose, and brings its rotation to the nearest one; with how far it was away, by the largest entry.
goal = pose;
off = 0;
if ~all(isfinite(pose(:)))
    status = 'not finite';
    return;
end
status = 'not a rotation';
r = pose(:, 1:3);
for step = 1:8
    defect = eye(3) - r.'*r;
    if ~(max(abs(defect(:))) <= 0.5)
        off = Inf;
        return;
    end
    if max(abs(defect(:))) <= 4e-16
        break;
    end
    r = r + 0.5*r*defect;
end
if ~(det(r) > 0)
    off = Inf;
    return;
end
goal = [r, pose(:, 4)];
off = max(max(abs(r - pose(:, 1:3))));
if off <= a.tolerance
    status = 'solved';
end
end

function [turn, jacobian] = turned(goal, rotation, jacobian)
% The turn from a rotation to that of the goal, along the axes of the base (rad), and how it changes.
e = goal(:, 1:3)*rotation.';
turn = 0.5*[e(3, 2) - e(2, 3); e(1, 3) - e(3, 1); e(2, 1) - e(1, 2)];
angle = atan2(norm(turn), 0.5*(trace(e) - 1));
if norm(turn) > 1e-7
    turn = turn*angle/norm(turn);
elseif angle > 1
    % Half a turn: the axis is the longest column of e + 1.
    [~, k] = max(diag(e));
    axis = e(:, k) + double((1:3).' == k);
    turn = axis*angle/norm(axis);
end
end
