
% @name@_ik and what is around it, at configurations whose poses are regular.
configurations = @configurations@;
counts = @solutions@;
unit = @units@;
window = @windows@;
turn = window;
turn(window <= 0) = Inf;
apart = @(a, b) max(abs(b - a - window.*floor((b - a)./turn + 0.5))./unit, [], 2);@parameters_test@
none = struct('lower', -Inf(1, @n@), 'upper', Inf(1, @n@));
for k = 1:size(configurations, 1)
    q = configurations(k, :);
    variables = zeros(1, @variables@);
    variables(1:@n@) = q;
    both = @name@_jacobian_fk(variables@jacobian_fk_parameters@);
    pose = reshape(both(end - 15:end), 4, 4).';
    found = @name@_ik(pose@given_test@@parameters_passed@);
    if ~strcmp(found.status, 'solved') || size(found.q, 1) ~= counts(k) || min(apart(found.q, q)) > 1e-6
        error('@name@:test', '@name@_ik: pose %d is not solved as it is known.', k);
    end
    if ~isequal(@name@_ik(pose(1:3, :)@given_test@@parameters_passed@), found)
        error('@name@:test', '@name@_ik: three rows of pose %d have another answer.', k);
    end
    % The nearest one to a configuration beside it is itself, or what is nearer has the pose, too.
    previous = q + 1e-3*unit.*(-1).^(0:@n@ - 1);
    choice = @name@_ik_nearest(pose, previous, none@parameters_passed@);
    if ~strcmp(choice.status, 'solved') || ~choice.is_found || choice.distance > 4e-3 ...
            || choice.missed_shift > 1e-8*@size@ || choice.missed_turn > 1e-8
        error('@name@:test', '@name@_ik_nearest: of pose %d another one is the nearest.', k);
    end
    % Limits around it allow it, and nothing else if they are narrow; those far away allow none.
    narrow = struct('lower', q - 1e-4*unit, 'upper', q + 1e-4*unit);
    [status, all_q] = @name@_ik_all_within_limits(pose@given_test@, narrow@parameters_passed@);
    if ~strcmp(status, 'solved') || isempty(all_q) || min(apart(all_q, q)) > 1e-6 || max(apart(all_q, q)) > 3e-4
        error('@name@:test', '@name@_ik_all_within_limits: limits around configuration %d leave it out.', k);
    end
    far = q + 100.3*max(window, unit);
    [status, all_q] = @name@_ik_all_within_limits(pose@given_test@, ...
        struct('lower', far, 'upper', far)@parameters_passed@);
    if ~strcmp(status, 'outside limits') || ~isempty(all_q)
        error('@name@:test', '@name@_ik_all_within_limits: limits far from pose %d allow it.', k);
    end
@wrong@    infinite = pose;
    infinite(2, 4) = Inf;
    found = @name@_ik(infinite@given_test@@parameters_passed@);
    if ~strcmp(found.status, 'not finite') || ~isempty(found.q)
        error('@name@:test', '@name@_ik: an infinite position is taken for a pose.');
    end
end
@clear@
