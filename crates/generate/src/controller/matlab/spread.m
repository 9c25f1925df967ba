
function given = spread(a, limits, previous, sample)
% Values of the given joints: the previous ones first, then spread over what the limits allow.
given = zeros(1, numel(a.given));
for k = 1:numel(a.given)
    j = a.given(k);
    within = min(max(previous(j), limits.lower(j)), limits.upper(j));
    half = a.size;
    if a.period(j) > 0
        half = 0.5*a.period(j);
    end
    lower = max(limits.lower(j), min(previous(j), limits.upper(j)) - half);
    upper = min(limits.upper(j), max(previous(j), limits.lower(j)) + half);
    % Multiples of the golden ratio and of its like, modulo 1.
    x = sample*0.6180339887498949;
    if k > 1
        x = sample*0.7548776662466927/(k - 1);
    end
    given(k) = lower + (upper - lower)*(x - floor(x));
    if sample == 0
        given(k) = within;
    end
end
end
