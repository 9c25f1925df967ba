
function [nodes, weights] = sampled(slides)
% Where functions of a joint are sampled, and what makes the coefficients of (1, cos, sin) or (1, d, d^2) of the
% samples.
if slides
    nodes = [-1; 0; 1];
    weights = inv([ones(3, 1), nodes, nodes.^2]);
else
    nodes = exp(2i*pi*(0:2).'/3);
    weights = inv([ones(3, 1), real(nodes), imag(nodes)]);
end
end

function x = mixture(rows, columns, by)
% Fixed numbers between -1 and 1 without pattern.
x = mod(by*(1:rows*columns), 1);
x = reshape(2*mod(997*x, 1) - 1, columns, rows).';
end

function f = line_of(frame)
% Functions of the z axis of a frame through which the loop is cut (Raghavan and Roth 1990):
% [p, l, p.p, p.l, p x l, (p.p) l - 2 (p.l) p] of a point p and the direction l. A rigid motion acts on them by
% an affine map, so they are linear in (1, cos, sin) of each angle and (1, d, d^2) of each slide on the way.
p = frame(1:3, 4);
l = frame(1:3, 3);
f = [p; l; p.'*p; p.'*l; crossed(p, l); (p.'*p)*l - 2*(p.'*l)*p].';
end

function places = left_alone(slides)
% Functions of a line that a turn about z, or a shift along it, leaves alone.
if slides
    places = [1, 2, 4, 5, 6, 11];
else
    places = [3, 6, 7, 8, 11, 14];
end
end

function x = three(links, slides, ring)
% The frame behind the hidden joint and the two after it.
x = links(:, :, 2);
for k = 3:5
    x = x*about(slides(k), ring(k))*links(:, :, k);
end
end

function cut = cut_of(a, hidden, is_last_multiplied)
% A cut of the loop Z1 L1 ... Z6 L6 = 1, read from any joint in either direction:
% L2 Z3 L3 Z4 L4 Z5 L5 = Z2' L1' Z1' L6' Z6', inverses on the right. The last motion leaves its axis where it is;
% the functions of that line are fourteen equations. Their left sides stand over the monomials of the third, the
% multiplied and the other joint.
cut.is_forwards = hidden <= 3;
if cut.is_forwards
    cut.joints = mod(hidden - 1 + (4:9), 6) + 1;
    cut.pose_link = find(cut.joints == 6);
else
    cut.joints = mod(hidden - 1 + (8:-1:3), 6) + 1;
    cut.pose_link = find(cut.joints == 1);
end
cut.slides = a.slides(cut.joints);
% The link with the pose is the identity.
cut.links = zeros(4, 4, 6);
for k = 1:6
    joint = cut.joints(k);
    if k == cut.pose_link
        cut.links(:, :, k) = eye(4);
    elseif cut.is_forwards
        cut.links(:, :, k) = a.links(:, :, joint);
    else
        cut.links(:, :, k) = inverse(a.links(:, :, joint - 1));
    end
end
cut.multiplied = 4 + is_last_multiplied;
cut.other = 5 - is_last_multiplied;
order = [3, cut.multiplied, cut.other];
% Added to the angles of two joints in the equations, so that none is special.
aside = exp(0.7i);
cut.back = ones(1, 6);
cut.back([false(1, 3), ~cut.slides(4:5), false]) = conj(aside);
[nodes, weights] = arrayfun(@sampled, cut.slides(order), 'UniformOutput', false);
samples = zeros(27, 14);
for k = 0:26
    at = [floor(k/9), mod(floor(k/3), 3), mod(k, 3)] + 1;
    ring = ones(1, 6);
    ring(order) = [nodes{1}(at(1)), nodes{2}(at(2)), nodes{3}(at(3))];
    samples(k + 1, :) = line_of(three(cut.links, cut.slides, ring .* cut.back));
end
cut.left = (kron(weights{1}, kron(weights{2}, weights{3}))*samples).';
end

function [loop, is_finite] = eliminated(cut, closing)
% Eliminates the first two joints: six equations over the monomials of the left side, the largest entry of each
% 1, and what the first two joints are found from.
if ~cut.is_forwards
    closing = inverse(closing);
end
loop.links = cut.links;
loop.links(:, :, cut.pose_link) = closing;
[one, weights_one] = sampled(cut.slides(1));
[two, weights_two] = sampled(cut.slides(2));
first = zeros(3, 14);
both = zeros(9, 14);
behind = eye(4);
if cut.pose_link == 2
    behind = inverse(closing);
end
for i = 1:3
    turn = inverse(about(cut.slides(1), one(i)));
    ahead = inverse(loop.links(:, :, 1))*turn*inverse(loop.links(:, :, 6));
    first(i, :) = line_of(ahead);
    for k = 1:3
        turn = inverse(about(cut.slides(2), two(k)));
        both(3*i + k - 3, :) = line_of(behind*turn*ahead);
    end
end
right = (kron(weights_one, weights_two)*both).';
is_finite = all(isfinite(right(:)));
if ~is_finite
    return
end

% What vanishes on the right sides but for the constant leaves the equations.
[basis, large, ~] = svd(right(:, 2:9));
large = diag(large);
rank_of = sum(large > 1e-11*large(1));
left = cut.left;
left(:, 1) = left(:, 1) - right(:, 1);
rows = basis(:, rank_of + 1:14).'*left;
if rank_of < 8
    mixed = mixture(6, 14, 0.6180339887498949);
    rows = mixed(:, rank_of + 1:14)*rows;
end
loop.sizes = max(abs(rows), [], 2);
scale = loop.sizes;
scale(scale == 0) = 1;
loop.rows = rows ./ scale;

% The first joint by least squares from functions that the second one leaves alone. If they know one
% combination of its cosine and sine only: the direction that they leave open.
first = weights_one*first;
loop.first = first(:, left_alone(cut.slides(2))).';
own = loop.first(:, 2:3);
[u, large, v] = svd(own, 'econ');
large = diag(large);
loop.open = zeros(2, 0);
if (large(1)*large(2))^2 > 1e-9*(large.'*large)^2
    loop.weights = v*diag(1 ./ large)*u.';
elseif cut.slides(1)
    square = own(:, 1).'*own(:, 1);
    loop.weights = [own(:, 1).'/(square + (square == 0)); zeros(1, 6)];
else
    loop.weights = v(:, 1)*u(:, 1).'/(large(1) + (large(1) == 0));
    loop.open = v(:, 2);
end
end

function form = halved(form, stride)
% From the monomials of a joint, every so many of nine columns, to those of its half angle: 1 = u^2 + v^2,
% c = u^2 - v^2, s = 2 u v.
for at = 1:9
    if mod(floor((at - 1)/stride), 3) == 0
        one = form(:, at);
        c = form(:, at + stride);
        form(:, at + stride) = 2*form(:, at + 2*stride);
        form(:, at) = one + c;
        form(:, at + 2*stride) = one - c;
    end
end
end

function weights = powers_weights(cut)
% What the powers (u^3, u^2 v, u v^2, v^3) of the multiplied joint are weighted by, a number an unknown.
r = sqrt(3);
if cut.slides(cut.multiplied)
    r = 1;
end
weights = kron([1, r, r, 1], ones(1, 3));
end

function matrix = narrow_matrix(cut, loop)
% The matrix of the hidden joint over (1, cos, sin), 12 x 12 x 3. With u = cos(q/2), v = sin(q/2) of the
% multiplied joint (1, q if it slides) each equation reads (A u^2 + B u v + C v^2) w = 0, w = (1, cos, sin) of the
% other joint. The unknowns (u^3, r u^2 v, r u v^2, v^3) x w obey [A B/r C/r 0; 0 A/r B/r C] x = 0, r = sqrt(3).
matrix = zeros(12, 12, 3);
for k = 1:3
    form = loop.rows(:, 9*k - 8:9*k);
    if ~cut.slides(cut.multiplied)
        form = halved(form, 3);
    end
    own = [form, zeros(6, 3); zeros(6, 3), form];
    matrix(:, :, k) = own ./ powers_weights(cut);
end
end

function [every, some] = wide_matrix(cut, loop)
% A wider matrix, for poses at which the determinant of the narrow one vanishes identically, such as those
% whose last axis is parallel to the first: all its rows, 24 x 16 x 3, and sixteen mixtures of them. With half
% angles for both joints the equations are forms of degree 2 in either pair. Multiplied by u u', u v', v u' and
% v v' they are 24 equations between the 16 monomials of degree 3 in either pair, and lose rank only where there
% is a solution. The determinant of the mixtures has degree 12 in the hidden angle; those of its roots at which
% the 24 equations keep their rank, or have null vectors that are not real, are dismissed.
every = zeros(24, 16, 3);
some = zeros(16, 16, 3);
mixed = mixture(16, 6, 0.7548776662466928);
for k = 1:3
    form = loop.rows(:, 9*k - 8:9*k) .* loop.sizes;
    if ~cut.slides(cut.multiplied)
        form = halved(form, 3);
    end
    if ~cut.slides(cut.other)
        form = halved(form, 1);
    end
    for by = 0:3
        places = reshape(4*((0:2) + floor(by/2)) + ((0:2).' + mod(by, 2)) + 1, 1, 9);
        every(6*by + (1:6), places, k) = form;
        some(4*by + (1:4), places, k) = mixed(4*by + (1:4), :)*form;
    end
end
end

function x = matrix_at(matrix, z)
% A matrix over (1, cos, sin) at a point of the circle.
x = matrix(:, :, 1) + real(z)*matrix(:, :, 2) + imag(z)*matrix(:, :, 3);
end
