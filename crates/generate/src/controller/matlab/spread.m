
function [lower, upper] = around(a, limits, previous)
% What the limits allow around a configuration.
half = 0.5*a.period;
half(a.period <= 0) = a.size;
lower = max(limits.lower, min(previous, limits.upper) - half);
upper = min(limits.upper, max(previous, limits.lower) + half);
end

function given = spread(a, limits, previous, sample)
% Values of the given joints: the previous ones first, then spread over what the limits allow.
if sample == 0
    given = clamped(limits, previous);
else
    [lower, upper] = around(a, limits, previous);
    % Multiples of the golden ratio and of its like, modulo 1.
    x = zeros(1, a.n);
    x(a.given) = sample*[0.6180339887498949, 0.7548776662466927./(1:numel(a.given) - 1)];
    given = lower + (upper - lower).*(x - floor(x));
end
given = given(a.given);
end
