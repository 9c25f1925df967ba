"""Constants of the kernels: minimax polynomials, pieces of pi/2, bits of 2/pi. Needs mpmath; prints Rust.

A polynomial is fitted by the Remez exchange on the relative error of the function it serves. Its coefficients are
rounded to the format one after another, lowest order first, and those that remain are fitted again each time.
"""

import struct

from mpmath import atan, cos, floor, ldexp, log, lu_solve, matrix, mp, mpf, nint, pi, sin, sqrt

mp.prec = 240


def to_f64(v):
    return float(v)


def to_f32(v):
    return struct.unpack("f", struct.pack("f", float(v)))[0]


def peaks(error, top, count):
    """The points of largest error between the sign changes of `error` on (0, top]."""
    grid = [top * (1 - cos(pi * i / (40 * count))) / 2 for i in range(1, 40 * count + 1)]
    runs, last = [], 0
    for z in grid:
        e = error(z)
        if e == 0:
            continue
        if (e > 0) != last or not runs:
            runs.append((abs(e), z))
        last = e > 0
        runs[-1] = max(runs[-1], (abs(e), z))
    while len(runs) > count:  # keep the neighbours that are largest
        runs.pop(0 if runs[0] < runs[-1] else -1)
    return [z for _, z in runs]


def remez(f, weight, top, orders):
    """c minimising the largest |weight(z) (f(z) - sum c_k z^k)| on (0, top] over the given orders k."""
    n = len(orders)
    points = [top * (1 - cos(pi * (i + mpf(1) / 2) / (n + 1))) / 2 for i in range(n + 1)]
    for _ in range(12):
        a = matrix(n + 1, n + 1)
        b = matrix(n + 1, 1)
        for i, z in enumerate(points):
            for j, k in enumerate(orders):
                a[i, j] = z**k
            a[i, n] = (-1) ** i / weight(z)
            b[i] = f(z)
        c = list(lu_solve(a, b))[:n]
        better = peaks(lambda z: weight(z) * (f(z) - sum(v * z**k for v, k in zip(c, orders))), top, n + 1)
        if len(better) < n + 1:
            break
        moved = max(abs(p - q) for p, q in zip(points, better))
        points = better
        if moved < top / 10**4:
            break
    return c


def fit(f, weight, top, count, rounded):
    """Coefficients in the format of `rounded`, and log2 of the largest weighted error."""
    done = []
    while len(done) < count:
        rest = lambda z: f(z) - sum(v * z**k for k, v in enumerate(done))
        done.append(rounded(remez(rest, weight, top, range(len(done), count))[0]))
    grid = [top * i / 2000 for i in range(1, 2001)]
    worst = max(abs(weight(z) * (f(z) - sum(v * z**k for k, v in enumerate(done)))) for z in grid)
    return done, float(log(worst, 2))


def pieces(value, bits):
    """`value` as a sum of pieces, each rounded to nearest, at most so many bits long."""
    parts = []
    for n in bits:
        unit = mpf(2) ** (floor(log(abs(value), 2)) + 1 - n)
        parts.append(nint(value / unit) * unit)
        value -= parts[-1]
    return parts


def sine(z):  # sin r = r + r z S(z), z = r²
    return (sin(sqrt(z)) / sqrt(z) - 1) / z


def cosine(z):  # cos r = 1 - z/2 + z² C(z)
    return (cos(sqrt(z)) - 1 + z / 2) / z**2


def arctangent(z):  # atan t = t + t z A(z), z = t²
    return (atan(sqrt(z)) / sqrt(z) - 1) / z


def shortest(v, kind):
    return repr(v) if kind == "f64" else next(s for s in (f"{v:.{d}g}" for d in range(6, 10)) if to_f32(s) == v)


def show(name, kind, values):
    print(f"const {name}: [{kind}; {len(values)}] = [")
    for v in values:
        print(f"    {shortest(v, kind)},")
    print("];")


def main():
    quarter = pi / 4
    for kind, rounded, counts, slack in [("f64", to_f64, (6, 6, 12), 20), ("f32", to_f32, (3, 3, 5), 10)]:
        # The quadrant is rounded, so |r| exceeds π/4 by a little.
        top = (quarter * (1 + mpf(2) ** -slack)) ** 2
        for name, f, weight, top, count in [
            ("SIN", sine, lambda z: z * sqrt(z) / sin(sqrt(z)), top, counts[0]),
            ("COS", cosine, lambda z: z**2 / cos(sqrt(z)), top, counts[1]),
            ("ATAN", arctangent, lambda z: z * sqrt(z) / atan(sqrt(z)), mpf(1) / 4, counts[2]),
        ]:
            values, error = fit(f, weight, top, count, rounded)
            print(f"// {kind}, error 2^{error:.1f}")
            show(name, kind, values)
    for name, kind, bits in [
        ("fused", "f64", (53, 33, 53)),
        ("strict", "f64", (33, 33, 33, 53)),
        ("fused", "f32", (24, 12, 24)),
        ("strict", "f32", (12, 12, 12, 24)),
    ]:
        print(f"// pi/2, {name}, {kind}:", [shortest(float(p), kind) for p in pieces(pi / 2, bits)])
    for name, value in [("pi/4", pi / 4), ("pi/2", pi / 2), ("3 pi/4", 3 * pi / 4), ("pi", pi)]:
        for kind, bits in [("f64", (53, 53)), ("f32", (24, 24))]:
            print(f"// {name}, {kind}:", [shortest(float(p), kind) for p in pieces(value, bits)])
    print("// limits:", float(ldexp(pi / 2, 20)), shortest(to_f32(ldexp(pi / 2, 12)), "f32"))
    print("// 2/pi:")
    mp.prec = 1400
    digits = int(floor(ldexp(2 / pi, 64 * 19)))
    for i in reversed(range(19)):
        print(f"    0x{digits >> (64 * i) & (2**64 - 1):016x},")


main()
