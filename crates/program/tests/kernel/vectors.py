"""Writes vectors.csv, the reference values of tests/kernel.rs. Needs mpmath (1.3.0 was used).

A row: what, arguments, then for every result the nearest number of the format and what it lacks, in units of its last
place. Numbers are the hexadecimal bits of the format.
"""

import math
import random
import struct
from pathlib import Path

from mpmath import atan2, cos, ldexp, mp, mpf, pi, sin

mp.prec = 1400
rng = random.Random(20)

# Where searches over 1.4 million arguments and 1.8 million pairs found the largest errors; in single precision, every
# argument was tried.
WORST = [
    -761.0976169804003, 643.2118071431707, -0.8267840621399896, -0.7644395647823834, 63310.17998137744,
    -1064110.0494383965, 134393.40672975435, 382868.2528874783, 3.9269908169872423, 49.480084294039244,
    -0.8543045919921939, 309937.7502307181, 41.62610266006476, -522.303043489346, 659.0036171828242,
    -4.742710574153649e223, -6.653355101705822e174,
]
WORST_PAIRS = [
    (0.6983644834944929, 1.3306688915438487), (-0.7875902795228302, 1.452997453140564),
    (0.12360434167197883, 0.4863296008613283), (-5.307013536586849e98, 1.060463846292018e99),
    (-1.83e-321, 7.29e-321), (0.69876729, 1.33735852),
]
WORST_F32 = [24.34865, 0.7855211, 3129.812, -2.3562343, 3228.772, 73.10018]
WORST_PAIRS_F32 = [
    (0.708537220954895, 1.4170417785644531), (0.3525923490524292, 0.6782421469688416),
    (-0.09306782484054565, 1.4885092973709106), (-0.015612667426466942, 0.061452314257621765),
]


def single(v):
    """The nearest number in single precision; infinite if v is too large."""
    return struct.unpack("f", struct.pack("f", float(v)))[0]


class Format:
    def __init__(self, name, rounded, code, integer, digits, limit, largest, smallest, exponent):
        self.name, self.rounded, self.code, self.integer, self.digits = name, rounded, code, integer, digits
        self.limit, self.largest, self.smallest, self.exponent = limit, largest, smallest, exponent

    def bits(self, v):
        return struct.unpack(self.integer, struct.pack(self.code, v))[0]

    def number(self, bits):
        return struct.unpack(self.code, struct.pack(self.integer, bits))[0]

    def hex(self, v):
        return f"{self.bits(v):0{self.digits}x}"

    def moved(self, v, steps):
        return self.number(self.bits(v) + steps)

    def result(self, exact):
        near = self.rounded(exact)
        unit = self.number(self.bits(abs(near)) + 1) - abs(near)
        return f"{self.hex(near)},{float((exact - mpf(near)) / mpf(unit)):.4f}"


F64 = Format("", float, "<d", "<Q", 16, 1647099.3291652855, 1.7976931348623157e308, 5e-324, 308)
F32 = Format("_f32", single, "<f", "<I", 8, 6433.98193359375, 3.4028234663852886e38, 2.0**-149, 38)


def angles(f, n, worst):
    yield from worst
    yield from [f.smallest, -f.smallest * 12345, f.limit, -f.limit, f.moved(f.limit, 1), f.largest, -f.largest]
    # the number of the format that is nearest to a multiple of pi/2
    yield from [1e22, 6381956970095103 * 2.0**797 if f is F64 else 16367173 * 2.0**72]
    for reach, share in [(math.pi, 4), (1000, 3), (f.limit, 3)]:
        yield from (rng.uniform(-reach, reach) for _ in range(n * share))
    top = int(f.limit / (math.pi / 4)) - 1
    for reach in [64, min(top, 10**6), min(top, 10**6)]:
        for _ in range(2 * n):
            yield f.moved(f.rounded(rng.randint(1, reach) * pi / 4), rng.choice([-2, -1, 0, 0, 1, 2]))
    yield from (rng.choice([-1, 1]) * 10 ** rng.uniform(-f.exponent, 0) for _ in range(n))
    yield from (rng.choice([-1, 1]) * 10 ** rng.uniform(math.log10(f.limit), f.exponent) for _ in range(3 * n))


def points(f, n, worst):
    yield from worst
    direction = lambda a, r: (r * math.sin(a), r * math.cos(a))
    for _ in range(4 * n):
        yield direction(rng.uniform(-math.pi, math.pi), 2 ** rng.uniform(-20, 20))
    for centre in [math.atan(0.5), math.atan(2.0), math.pi - math.atan(0.5)]:  # where the two forms of t meet
        yield from (direction(centre + rng.uniform(-0.03, 0.03), rng.uniform(0.5, 2)) for _ in range(n))
    for _ in range(2 * n):
        yield direction(rng.randint(-8, 8) * math.pi / 8 + rng.gauss(0, 1e-3), rng.uniform(0.5, 2))
    far = lambda: rng.choice([-1, 1]) * 10 ** rng.uniform(-0.98 * f.exponent, 0.98 * f.exponent)
    yield from ((far(), far()) for _ in range(2 * n))
    tiny = lambda: rng.choice([-1, 1]) * rng.randint(1, 2000) * f.smallest
    yield from ((tiny(), tiny()) for _ in range(n))
    yield from ((rng.randint(-200, 200), rng.randint(1, 200)) for _ in range(n))
    yield from [(0.7 * f.largest, f.largest), (-f.largest, -0.7 * f.largest)]  # their sum overflows
    yield from [(f.largest, f.largest), (f.largest, f.smallest), (-f.smallest, f.largest), (f.smallest, -f.largest)]


def main():
    lines = []
    for f, n, worst, pairs in [(F64, 85, WORST, WORST_PAIRS), (F32, 32, WORST_F32, WORST_PAIRS_F32)]:
        for x in map(f.rounded, angles(f, n, worst)):
            lines.append(f"sin_cos{f.name},{f.hex(x)},{f.result(sin(mpf(x)))},{f.result(cos(mpf(x)))}")
        for y, x in points(f, n, pairs):
            y, x = f.rounded(y), f.rounded(x)
            lines.append(f"atan2{f.name},{f.hex(y)},{f.hex(x)},{f.result(atan2(mpf(y), mpf(x)))}")
    Path(__file__).with_name("vectors.csv").write_text("\n".join(lines) + "\n")


main()
