@ head

function found = roots_of(x, y)
% The roots of an equation in one unknown: cosine and sine of an angle, or a number and 0.
found = struct('count', numel(x), 'is_free', 0, 'multiplicity', ones(1, 4), 'x', x, 'y', y);
end

function gone = vanishes(guard, divisor, scale)
% A guard that is small, times the size to its power, has vanished.
gone = abs(guard) <= 2.842170943040401e-14*scale || divisor == 0;
end
@ free

function found = free_root(x)
% Nothing determines the unknown: one value stands for all.
found = roots_of(x, 0);
found.is_free = 1;
end
@ double

function found = double_root(x, y)
% Two roots that come together.
found = roots_of(x, y);
found.multiplicity = 2*ones(1, 4);
end
@ ratio

function found = ratio_roots(numerator, denominator, guard, scale)
% denominator r = numerator.
if vanishes(guard, denominator, scale)
    found = free_root(0);
else
    found = roots_of(numerator/denominator, 0);
end
end
@ direction

function found = direction_roots(x, y, direction, guard, scale)
% The angle of (x, y), or of (-x, -y) if the direction is negative.
r = sqrt(x*x + y*y);
if vanishes(guard, r, scale)
    found = free_root(1);
elseif direction < 0
    found = roots_of(-x/r, -y/r);
else
    found = roots_of(x/r, y/r);
end
end
@ line

function found = line_roots(x, y, guard, scale)
% x sin = y cos: the angle of (x, y) and the opposite one.
r = sqrt(x*x + y*y);
if vanishes(guard, r, scale)
    found = free_root(1);
else
    found = roots_of([x, -x]/r, [y, -y]/r);
end
end
@ length

function found = length_roots(x, y, guard, scale)
% r r = x x + y y.
r = sqrt(x*x + y*y);
if vanishes(guard, r, scale)
    found = double_root(r, 0);
else
    found = roots_of([r, -r], [0, 0]);
end
end
@ sincos

function found = sincos_roots(a, b, c, d, guard, scale)
% a cos + b sin = c, of the discriminant d = a a + b b - c c.
found = roots_of([], []);
n = a*a + b*b;
if vanishes(guard, n, scale)
    if abs(c) <= 1e-9*scale
        found = free_root(1);
    end
elseif d > 0
    r = sqrt(d);
    found = roots_of([a*c - b*r, a*c + b*r]/n, [b*c + a*r, b*c - a*r]/n);
elseif d >= -1e-6*(n + c*c)
    % Below 0 by less than this, it is 0: the nearest there is. The residual decides.
    r = sqrt(n);
    if c < 0
        r = -r;
    end
    found = double_root(a/r, b/r);
end
end
@ quadratic

function found = quadratic_roots(a, b, c, guard, scale)
% a r r + 2 b r + c = 0.
found = roots_of([], []);
d = b*b - a*c;
if vanishes(guard, a, scale)
    if abs(b) > 2.842170943040401e-14*scale
        found = roots_of(-c/(2*b), 0);
    elseif abs(c) <= 1e-9*scale
        found = free_root(0);
    end
elseif d > 0
    % b and the root have the same sign in q: nothing cancels.
    if b < 0
        q = sqrt(d) - b;
        found = roots_of([q/a, c/q], [0, 0]);
    else
        q = -sqrt(d) - b;
        found = roots_of([c/q, q/a], [0, 0]);
    end
elseif d >= -1e-6*(b*b + abs(a*c))
    found = double_root(-b/a, 0);
end
end
@ quartic

function x = root_between(p, low, high)
% The root of a polynomial between two places of different sign: Newton's steps, or halves.
rises = polyval(p, low) < 0;
x = 0.5*(low + high);
step = high - low;
for k = 1:100
    value = 0;
    slope = 0;
    for coefficient = p
        slope = slope*x + value;
        value = value*x + coefficient;
    end
    if (value < 0) == rises
        low = x;
    else
        high = x;
    end
    next = x - value/slope;
    if ~(next > low && next < high && abs(next - x) <= 0.5*abs(step))
        next = 0.5*(low + high);
    end
    step = next - x;
    x = next;
    if step == 0
        break
    end
end
end

function found = quartic_roots(cc, cs, c, s, one, guard, scale)
% f = cc cos cos + cs cos sin + c cos + s sin + one = 0.
%
% A quartic in t = tan(u / 2), where u is measured from the direction opposite to that in which f
% is largest of eight: its leading coefficient is not small. The roots of each derivative separate
% those of the one before. Where f touches 0 without changing its sign, two roots come together.
sizes = abs([cc, cs, c, s, one]);
if vanishes(min(abs(guard), max(sizes)), max(sizes), scale)
    found = free_root(1);
    return
end
f = @(x, y) cc*x.*x + cs*x.*y + c*x + s*y + one;
circle = (0:7)*(pi/4);
values = f(cos(circle), sin(circle));
[~, largest] = max(abs(values));
lead = values(largest);
x0 = -cos(circle(largest));
y0 = -sin(circle(largest));

% The coefficients for u, then those of t and of the derivatives, from the highest power.
even = cc*(x0*x0 - y0*y0) + 2*cs*x0*y0;
mixed = cs*(x0*x0 - y0*y0) - 2*cc*x0*y0;
along = c*x0 + s*y0;
across = s*x0 - c*y0;
rest = one + cc*y0*y0 - cs*x0*y0;
p = [1, [2*(across - mixed), 2*(rest - even), 2*(across + mixed), even + along + rest]/lead];
all_p = {polyder(polyder(polyder(p))), polyder(polyder(p)), polyder(p), p};
bound = sum(abs(p));

% Where a derivative has no root between two places, the second place stands for it.
ends = [-bound, bound];
is_root = [false, false];
t = zeros(1, 0);
times = zeros(1, 0);
for degree = 1:4
    own = all_p{degree};
    next = -bound;
    is_next = false;
    heights = polyval(own, ends);
    is_below = heights < 0;
    for k = find(is_root(1:degree) & degree == 4)
        % An extremum at the height of rounding is on the side of its neighbours.
        is_rounding = abs(heights(k)*lead) <= 3.6e-15*sum(sizes)*(1 + ends(k)^2)^2;
        if is_rounding && is_below(k - 1) == is_below(k + 1)
            is_below(k) = is_below(k - 1);
        end
    end
    for k = 1:degree
        changes = is_below(k) ~= is_below(k + 1);
        place = ends(k + 1);
        if changes
            place = root_between(own, ends(k), ends(k + 1));
        end
        % An extremum, with no change of sign on either side.
        is_extremum = degree == 4 && is_root(k) && ~is_next(k) && ~changes;
        is_near = abs(heights(k)*lead) <= 1e-6*sum(sizes)*(1 + ends(k)^2)^2;
        bend = polyval(all_p{2}, ends(k));
        touches = (is_below(k) && bend <= 0) || (~is_below(k) && bend >= 0);
        if is_extremum && is_near && touches
            t(end + 1) = ends(k);
            times(end + 1) = 2;
        elseif degree == 4 && changes
            t(end + 1) = place;
            times(end + 1) = 1;
        end
        next(end + 1) = place;
        is_next(end + 1) = changes;
    end
    ends = [next, bound];
    is_root = [is_next, false];
end

x = (x0*(1 - t.*t) - 2*y0*t)./(1 + t.*t);
y = (y0*(1 - t.*t) + 2*x0*t)./(1 + t.*t);
for k = 1:2
    step = f(x, y)./(cs*(x.*x - y.*y) - 2*cc*x.*y - c*y + s*x);
    step(~(abs(step) <= 1e-8)) = 0;
    [x, y] = deal(x + y.*step, y - x.*step);
end
r = sqrt(x.*x + y.*y);
[~, order] = sort(atan2(y, x));
found = roots_of(x(order)./r(order), y(order)./r(order));
found.multiplicity = times(order);
end
@ keep

function solutions = keep(solutions, found)
% Adds a solution, or its multiplicity to an equal one.
is_angle = logical([@angles@]);
if ~all(isfinite(found.results))
    return
end
for k = 1:numel(solutions)
    apart = solutions(k).results - found.results;
    apart(is_angle) = apart(is_angle) - 2*pi*round(apart(is_angle)/(2*pi));
    if all(abs(apart) <= 2e-7)
        solutions(k).multiplicity = solutions(k).multiplicity + found.multiplicity;
        return
    end
end
solutions(end + 1) = found;
end
