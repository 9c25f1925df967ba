
function z = outside(chart, z)
% From a chart, a part of the circle, magnified, tan((a - centre)/2) = kappa tan(b/2), to the circle.
near = z + 1;
far = chart.kappa*(z - 1);
z = chart.centre*on_circle((near + far) ./ (near - far));
end

function z = inside(chart, z)
% From the circle to the chart.
z = z/chart.centre;
near = chart.kappa*(z + 1);
far = z - 1;
z = on_circle((near + far) ./ (near - far));
end

function it_does = answers_for(chart, cosine)
% Whether the chart is to find what is there.
it_does = chart.depth == 0 | cosine >= 0;
end

function x = part(chart, centre, half_width)
% An arc of a chart as a chart of its own.
ends = outside(chart, exp(1i*(centre + half_width*[-1, 1])));
half = mod(angle(ends(2)/ends(1)), 2*pi)/2;
x.centre = ends(1)*exp(1i*half);
x.kappa = tan(min(half, 2.8)/2);
x.depth = chart.depth + 1;
end

function [polynomial, noise] = fitted(matrix, chart, degree, count)
% The determinant of a matrix in a chart: coefficients from 0 on of a trigonometric polynomial, whose others are
% their conjugates, its largest sample 1; and what they may be off. None if it tells nothing.
nodes = exp(2i*pi*((0:count - 1).' + 0.381966011250105)/count);
points = outside(chart, nodes);
samples = zeros(count, 1);
for k = 1:count
    samples(k) = det(matrix_at(matrix, points(k)));
end
samples = samples .* (abs(nodes + 1 - chart.kappa*(nodes - 1)).^2/4).^degree;
polynomial = [];
noise = Inf;
top = max(abs(samples));
if ~all(isfinite(samples)) || ~(top > 1e-250 && top < 1e250)
    return
end
% Harmonics above the degree would vanish without rounding.
harmonics = fft(samples/top)/count;
harmonics = harmonics(1:count/2 + 1) .* nodes(1).^-(0:count/2).';
above = norm(harmonics(degree + 2:end));
if above <= 1e-5
    polynomial = harmonics(1:degree + 1);
    noise = max(4*above, 2e-14);
end
end

function found = roots_of(polynomial, noise)
% All roots, with discs that hold those of every polynomial that differs by the noise (Smith 1970).
while numel(polynomial) > 1 && abs(polynomial(end)) < 1e-14
    polynomial(end) = [];
end
whole = [conj(polynomial(end:-1:2)); polynomial];
count = numel(whole) - 1;
z = reshape(roots(whole(end:-1:1)), count, 1);
others = ~eye(count);
slopes = whole(2:end) .* (1:count).';
for step = 1:40
    % Aberth's and Ehrlich's steps, none where a value is its rounding error.
    powers = z.^(0:count);
    values = powers*whole;
    growth = max(1, abs(z).^count);
    apart = z - z.';
    pull = 1 ./ apart;
    pull(~others | apart == 0) = 0;
    away = values ./ (powers(:, 1:count)*slopes - values .* sum(pull, 2));
    away(~isfinite(away) | abs(values) < 1e-16*growth) = 0;
    if step == 40 || ~any(abs(away) > 1e-11*abs(z))
        break
    end
    z = z - away;
end
gaps = max(abs(apart), 1e-15);
gaps(~others) = 1;
found.z = z;
found.radius = count*(abs(values) + growth*noise) ./ (prod(gaps, 2)*abs(whole(end)));
end

function x = clear_of(polynomial, noise, from, side)
% The first of steps from an angle to one side at which the polynomial is clear of its noise.
at = from + side*cumsum(5e-4*1.3.^(0:23).');
values = 2*real(exp(1i*at*(0:numel(polynomial) - 1))*polynomial) - real(polynomial(1));
x = at(min([find(abs(values) > 2*noise, 1), 24]));
end

function arcs = crowds(polynomial, noise, marks)
% The arcs, centres and half widths, in which there may be roots that are not where they seem to be; none if they
% are too many.
arcs = zeros(0, 2);
for k = 1:numel(marks)
    away = abs(mod(marks(k) - arcs(:, 1) + pi, 2*pi) - pi);
    if any(away < arcs(:, 2))
        continue
    end
    low = clear_of(polynomial, noise, marks(k), -1);
    high = clear_of(polynomial, noise, marks(k), 1);
    arcs(end + 1, :) = [low + high, high - low]/2; %#ok<AGROW>
end
if size(arcs, 1) > 8
    arcs = zeros(0, 2);
end
end

function [x, is_known] = shift_of(basis, at, by)
% Of mixtures g of vectors that are products of powers, some entries are v/u times others: the matrix with
% that number as eigenvalue of g, if there is one. The pair is turned by a fixed angle, so that no solution has
% u = 0 but by accident.
top = cos(1)*basis(at, :) + sin(1)*basis(by, :);
bottom = cos(1)*basis(by, :) - sin(1)*basis(at, :);
[u, s, v] = svd(top, 'econ');
s = diag(s);
is_known = s(end) > 1e-7*s(1);
x = v*diag(1 ./ s)*u.'*bottom;
end

function vectors = real_products(basis, matrix, tolerance)
% Null vectors that belong to eigenvalues that are real up to a tolerance.
eigenvalues = eig(matrix);
are_real = abs(imag(eigenvalues)) <= tolerance*(1 + abs(real(eigenvalues)));
eigenvalues = real(eigenvalues(are_real));
vectors = zeros(size(basis, 1), numel(eigenvalues));
for k = 1:numel(eigenvalues)
    [~, ~, v] = svd(matrix - eigenvalues(k)*eye(size(matrix)));
    vectors(:, k) = basis*v(:, end);
end
end

function [hidden, vectors] = narrow_candidates(cut, matrix, chart, roots)
% Values of the hidden joint with null vectors there, from the roots near the circle and the middles of those
% that are close together: a root that several configurations share falls apart by the root of the noise, its
% middle does not.
own = on_circle(roots.z);
own = own(abs(abs(roots.z) - 1) < 0.02 & answers_for(chart, real(own) + 0.1));
middles = zeros(0, 1);
for k = 2:numel(own)
    close = find(abs(own(1:k - 1) - own(k)) < 3e-4, 1, 'last');
    middles = [middles; on_circle(own(close) + own(k))]; %#ok<AGROW>
end
all_values = outside(chart, [own; middles]);
count = numel(all_values);
is_middle = (1:count).' > numel(own);
is_shared = false(count, 1);
null = zeros(12, 6, count);
sizes = zeros(6, count);
for k = 1:count
    [~, s, v] = svd(matrix_at(matrix, all_values(k)));
    s = diag(s)/s(1);
    % Where the second smallest is small too, several solutions share the value.
    is_shared(k) = s(11) <= 1e-5;
    null(:, :, k) = v(:, 7:12);
    sizes(:, k) = s(7:12);
end
serve = all_values(is_middle & is_shared);
hidden = zeros(0, 1);
vectors = zeros(12, 0);
for k = 1:count
    if (is_middle(k) && ~is_shared(k)) || (~is_middle(k) && any(abs(serve - all_values(k)) < 6e-4))
        continue
    end
    found = null(:, 6, k);
    if is_shared(k)
        basis = null(:, sizes(:, k) <= 1e-5, k);
        [x, is_known] = shift_of(basis ./ powers_weights(cut).', 1:9, 4:12);
        if is_known
            found = [found, real_products(basis, x, 0.03)]; %#ok<AGROW>
        end
    end
    hidden = [hidden; all_values(k)*ones(size(found, 2), 1)]; %#ok<AGROW>
    vectors = [vectors, found]; %#ok<AGROW>
end
end

function [basis, least] = wide_null(matrix, z, small)
% The vectors that all equations take to zero, or almost, and the smallest singular value beside the largest.
[~, s, v] = svd(matrix_at(matrix, z));
s = diag(s)/s(1);
basis = v(:, (1:16).' > 10 & s <= small);
least = s(end);
end

function [found, is_known] = wide_products(basis, tolerance)
% The products (u^3 ... v^3) x (u'^3 ... v'^3) among null vectors that are real up to a tolerance, if they are
% known: eigenvectors of a mixture of both shifts.
found = basis;
is_known = true;
if size(basis, 2) < 2
    return
end
at = find(mod(0:15, 4) < 3);
[one, is_one] = shift_of(basis, 1:12, 5:16);
[other, is_other] = shift_of(basis, at, at + 1);
is_known = is_one && is_other;
if is_known
    found = real_products(basis, one + 0.6180339887498949*other, tolerance);
end
end

function z = pair_of(slides, blocks)
% The number u + i v to whose third powers four columns are proportional: of length 1, or 1 + i d of a slide.
uu = sum(sum(blocks(:, 1:3).^2));
uv = sum(sum(blocks(:, 1:3) .* blocks(:, 2:4)));
vv = sum(sum(blocks(:, 2:4).^2));
if uu > vv
    z = uu + 1i*uv;
else
    z = uv + 1i*vv;
end
if slides
    z = 1 + 1i*imag(z)/real(z);
else
    z = on_circle(z);
end
end

function x = powers_of(z)
% (u^3, u^2 v, u v^2, v^3) of a number u + i v.
u = real(z);
v = imag(z);
x = [u^3; u^2*v; u*v^2; v^3];
end

function vectors = narrowed(cut, products)
% The null vectors of the narrow matrix that belong to products of powers.
vectors = zeros(12, size(products, 2));
for k = 1:size(products, 2)
    blocks = reshape(products(:, k), 4, 4);
    powers = powers_of(pair_of(cut.slides(cut.multiplied), blocks));
    z = pair_of(cut.slides(cut.other), (blocks*powers).');
    if cut.slides(cut.other)
        w = [1; imag(z); imag(z)^2];
    else
        w = [1; real(z^2); imag(z^2)];
    end
    vectors(:, k) = kron(powers, w) .* powers_weights(cut).';
end
end

function groups = grouped(chart, roots)
% The roots near the circle, those that lie together in one cell.
off = abs(abs(roots.z) - 1);
is_near = ~(off >= 0.02 & off > roots.radius) & answers_for(chart, real(roots.z) ./ abs(roots.z) + 0.1);
groups = {};
for k = find(is_near).'
    is_with = false(size(groups));
    for g = 1:numel(groups)
        is_with(g) = any(abs(roots.z(groups{g}) - roots.z(k)) < 2e-3);
    end
    together = [groups{is_with}, k];
    groups = [groups(~is_with), {together}];
end
end

function [hidden, vectors, roots] = wide_candidates(cut, matrix, chart, roots)
% Values of the hidden joint with null vectors of the narrow matrix there; roots that belong to no configuration
% have a radius less than 0.
hidden = zeros(0, 1);
vectors = zeros(12, 0);
groups = grouped(chart, roots);
for g = 1:numel(groups)
    group = groups{g};
    % If they are one root that as many solutions share, in their middle, then these are all there are, and those
    % that are not real need no configuration. Ten times the root of the bound is the most by which a double
    % eigenvalue can be off.
    z = outside(chart, on_circle(sum(roots.z(group))));
    is_known = false;
    if numel(group) > 1
        basis = wide_null(matrix, z, 1e-8);
        if size(basis, 2) == numel(group)
            [found, is_known] = wide_products(basis, 1e-3);
        end
    end
    if is_known
        hidden = [hidden; z*ones(size(found, 2), 1)]; %#ok<AGROW>
        vectors = [vectors, narrowed(cut, found)]; %#ok<AGROW>
        roots.radius(group(size(found, 2) + 1:end)) = -1;
        continue
    end
    for k = group
        z = outside(chart, on_circle(roots.z(k)));
        [basis, least] = wide_null(matrix, z, 1e-3);
        % Full rank at every angle in the disc: a root of the mixtures only.
        if least > 100*chart.kappa*roots.radius(k) && least > 1e-9
            roots.radius(k) = -1;
        end
        [found, is_known] = wide_products(basis, 0.03);
        if is_known
            hidden = [hidden; z*ones(size(found, 2), 1)]; %#ok<AGROW>
            vectors = [vectors, narrowed(cut, found)]; %#ok<AGROW>
        end
    end
end
end

function values = completed(cut, loop, arm_slides, hidden, null)
% All joints at values of the hidden one with null vectors, a row each; two for each where the functions leave the
% first joint's angle open.
branches = 1;
if ~isempty(loop.open)
    branches = [1, -1];
end
values = zeros(numel(hidden)*numel(branches), 6);
row = 0;
for k = 1:numel(hidden)
    for branch = branches
        row = row + 1;
        values(row, cut.joints) = ring_of(cut, loop, branch, hidden(k), null(:, k));
    end
end
if ~cut.is_forwards
    values(:, arm_slides) = -values(:, arm_slides);
    values(:, ~arm_slides) = conj(values(:, ~arm_slides));
end
end

function ring = ring_of(cut, loop, branch, hidden, null)
% All joints of a cut; the branch chooses between the first joint's angles where the functions leave it open.
slides = cut.slides;
links = loop.links;
ring = ones(1, 6);
ring(3) = hidden;

% The two joints behind it: y = (u^3, u^2 v, u v^2, v^3) x w.
y = null ./ powers_weights(cut).';
uu = y(1:9).'*y(1:9);
uv = y(1:9).'*y(4:12);
vv = y(4:12).'*y(4:12);
if slides(cut.multiplied)
    pair = 1 + 1i*uv/uu;
    ring(cut.multiplied) = uv/uu;
else
    ring(cut.multiplied) = on_circle(uu - vv + 2i*uv);
    pair = sqrt(ring(cut.multiplied));
end
w = reshape(y, 3, 4)*powers_of(pair);
if slides(cut.other)
    ring(cut.other) = w(2)/w(1);
elseif w(1) < 0
    ring(cut.other) = on_circle(-(w(2) + 1i*w(3)));
else
    ring(cut.other) = on_circle(w(2) + 1i*w(3));
end
ring = ring .* cut.back;

% The first joint from the line of the last one.
frame = three(links, slides, ring);
seen = line_of(frame);
first = loop.weights*(seen(left_alone(slides(2))).' - loop.first(:, 1));
if ~isempty(loop.open)
    first = first + branch*sqrt(max(1 - first.'*first, 0))*loop.open;
end
if slides(1)
    ring(1) = first(1);
else
    ring(1) = on_circle(first(1) + 1i*first(2));
end

% The second joint takes that line to where it is from the other side.
ahead = links(:, :, 6)*about(slides(1), ring(1))*links(:, :, 1);
there = inverse(ahead);
if slides(2)
    ring(2) = there(3, 4) - frame(3, 4);
else
    from = frame(1, 3:4) + 1i*frame(2, 3:4);
    to = there(1, 3:4) + 1i*there(2, 3:4);
    ring(2) = on_circle(sum(conj(from) .* to));
end

% The last joint closes the loop.
rest = ahead*about(slides(2), ring(2))*frame;
ring(6) = on_circle(rest(1, 1) - 1i*rest(2, 1));
end
