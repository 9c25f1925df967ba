#!/usr/bin/env python3
"""Checks certificates that `denavit … --certificate FILE.json` writes; docs/certificates.md says what one is.

    python3 check_certificate.py FILE.json …

Nothing that a certificate says is believed. The links of its table are multiplied here, every formula is expanded here to a
polynomial in parameters, sines, cosines and roots, and a claim `left = right` holds if left − right is, as a polynomial, the
sum of its cofactors times the c² + s² − 1 and r² − radicand. Exit codes: 0 all claims hold, 1 one does not, 3 no certificate.
"""
import ast
import itertools
import json
import sys
from fractions import Fraction
from functools import reduce

BITS, MOST = 24, (1 << 24) - 1  # of an exponent in a monomial, which is an integer; its total degree stands lowest
ORDER = {"standard": ["theta", "d", "a", "alpha"], "craig": ["alpha", "a", "theta", "d"],
         "khalil": ["gamma", "b", "alpha", "a", "theta", "d"]}
# Sine and cosine of 15°, 30°, 45°, 60° and 75°, the angle in π/12; roots are those that are not negative.
R6 = "sqrt(2)*sqrt(3)"
EXACT = {1: (f"({R6}-sqrt(2))/4", f"({R6}+sqrt(2))/4"), 2: ("1/2", "sqrt(3)/2"), 3: ("sqrt(2)/2", "sqrt(2)/2"),
         4: ("sqrt(3)/2", "1/2"), 5: (f"({R6}+sqrt(2))/4", f"({R6}-sqrt(2))/4")}
ZERO, ONE, R3 = {}, {0: 1}, range(3)

class Refused(Exception):
    """A certificate that does not hold."""

def need(condition, why):
    if not condition:
        raise Refused(why)

def plus(p, q, k=1):  # p + k·q; a polynomial maps monomials to coefficients, none of which is 0
    total = dict(p)
    for m, c in q.items():
        total[m] = total.get(m, 0) + k * c
        if total[m] == 0:
            del total[m]
    return total

def times(p, q):
    found = {}
    for m, c in p.items():
        for n, d in q.items():
            found[m + n] = found.get(m + n, 0) + c * d
    need(all(m & MOST < 1 << 20 for m in found), "a degree is too high")
    return {m: c for m, c in found.items() if c != 0}

def product(a, b):  # of transforms, three rows each
    dot = lambda row, k: plus(plus(times(row[0], b[0][k]), times(row[1], b[1][k])), times(row[2], b[2][k]))
    return [[plus(dot(row, k), row[3] if k == 3 else ZERO) for k in range(4)] for row in a]

def inverse(x):  # Rᵀ, −Rᵀp
    turned = [[x[k][i] for k in R3] + [ZERO] for i in R3]
    return [[*turned[i][:3], plus(ZERO, row[3], -1)] for i, row in enumerate(product(turned, x))]

class Checker:
    def __init__(self, certificate):
        need(certificate["format"] == "denavit certificate 1", "the format is not known")
        self.values, self.unit, self.squares, self.proved, self.angles, self.roots = {}, {}, {}, {}, [], []
        self.joints = certificate["variables"]
        _ = [self.variable(name) for name in ["pi", *self.joints, *certificate["parameters"]]]
        for c, s, angle in certificate["angles"]:
            self.angles.append((self.polynomial(angle), self.variable(s), self.variable(c)))
            self.squares[s] = plus(ONE, times(self.values[c][0], self.values[c][0]), -1)
        for name, radicand in certificate["roots"]:
            self.squares[name] = self.polynomial(radicand)
            need(set(self.squares[name]) != {0} or self.squares[name][0] > 0, "a root of a negative number")
            self.roots.append(self.variable(name) and name)
        robot = certificate["robot"]
        self.rows, order = robot["rows"], ORDER[robot["convention"]]
        need(all(set(row) == set(order) for row in self.rows), "a row has other cells than its convention")
        base, tool = ([[[self.polynomial(x) for x in row] for row in robot[end]]] for end in ("base", "tool"))
        self.links = [base, *([self.screw(row, order[k:k + 2]) for k in range(0, len(order), 2)] for row in self.rows), tool]
        self.before = order.index("theta") // 2  # screws of a row that stand before its joint's
        for name, value in certificate["definitions"]:
            need(name not in self.values, f"{name} is defined twice")
            self.values[name] = self.quantity(value)

    def variable(self, name):  # a new one, whose monomial is `unit`
        need(name.isidentifier() and name not in self.values, f"{name} is not a new name")
        self.unit[name] = (1 << BITS * (len(self.unit) + 1)) + 1
        self.values[name] = {self.unit[name]: 1}, ONE
        return self.values[name][0]

    def polynomial(self, text):
        value, by = self.value(ast.parse(text, mode="eval").body if isinstance(text, str) else text)
        need(by == ONE, "a denominator where there must be none")
        return value

    def screw(self, row, cells):  # rotation about and translation along x or z
        angle, length = sorted(cells, key=lambda cell: cell in ("a", "b", "d"))
        (s, c), d = self.sine(self.polynomial(row[angle])), self.polynomial(row[length])
        if angle == "alpha":
            return [[ONE, ZERO, ZERO, d], [ZERO, c, plus(ZERO, s, -1), ZERO], [ZERO, s, c, ZERO]]
        return [[c, plus(ZERO, s, -1), ZERO, ZERO], [s, c, ZERO, ZERO], [ZERO, ZERO, ONE, d]]

    def sine(self, rest):  # sine and cosine of a sum of multiples of declared angles and of quarter turns
        s, c, pi = ZERO, ONE, self.unit["pi"]
        turn = lambda sine, cosine: (plus(times(s, cosine), times(c, sine)), plus(times(c, cosine), times(s, sine), -1))
        for form, sine, cosine in self.angles:
            name, k = next(iter(form.items()))
            if len(form) == 1 and name in rest and name not in (0, pi):
                n = Fraction(rest[name]) / k
                need(n.denominator == 1 and abs(n) <= 64, "a sine of a part of a declared angle")
                rest = plus(rest, form, -n)
                for _ in range(abs(n.numerator)):
                    s, c = turn(plus(ZERO, sine, -1 if n < 0 else 1), cosine)
        quarters = 2 * Fraction(rest.get(pi, 0)) // 1
        rest = plus(rest, {pi: 1}, Fraction(-quarters, 2))
        if set(rest) == {pi} and 12 * rest[pi] in EXACT:
            s, c = turn(*map(self.polynomial, EXACT[12 * rest[pi]]))
        elif rest:
            ones = [(form, plus(ZERO, x, k), y, k) for form, x, y in self.angles for k in (1, -1) if set(form) <= {0, pi}]
            sums = (t for n in (1, 2, 3) for t in itertools.product(ones, repeat=n))
            off = ((reduce(lambda p, one: plus(p, one[0], -one[3]), t, rest), t) for t in sums)
            fits = next((f for f in off if set(f[0]) <= {pi} and Fraction(2 * f[0].get(pi, 0)).denominator == 1), None)
            need(fits, "a sine of an angle that is not declared")
            for _, sine, cosine, _ in fits[1]:
                s, c = turn(sine, cosine)
            quarters += 2 * fits[0].get(pi, 0)
        for _ in range(int(quarters) % 4):
            s, c = c, plus(ZERO, s, -1)
        return s, c

    def value(self, node):  # numerator and denominator of a formula
        match node:
            case ast.Constant(value=int(n)):
                return ({0: int(n)} if n else ZERO), ONE
            case ast.Name(id=name) if name in self.values:
                return self.values[name]
            case ast.UnaryOp(op=ast.USub(), operand=a):
                return plus(ZERO, self.value(a)[0], -1), self.value(a)[1]
            case ast.BinOp(left=x, op=ast.Pow(), right=ast.Constant(value=int(n))) if 0 < n <= 64:
                return tuple(reduce(times, [p] * n) for p in self.value(x))
            case ast.BinOp(left=x, op=ast.Add() | ast.Sub() as op, right=y):
                (a, by), (b, d), k = self.value(x), self.value(y), -1 if isinstance(op, ast.Sub) else 1
                return (plus(a, b, k), by) if by == d else (plus(times(a, d), times(b, by), k), times(by, d))
            case ast.BinOp(left=x, op=ast.Mult() | ast.Div() as op, right=y):
                (a, by), (b, d) = self.value(x), self.value(y)[:: 1 if isinstance(op, ast.Mult) else -1]
                a, by = times(a, b), times(by, d)
                need(self.reduced(by), "a denominator is 0")
                return (times(a, {0: Fraction(1) / by[0]}), ONE) if set(by) == {0} else (a, by)
            case ast.Call(func=ast.Name(id="sin" | "cos" as name), args=[angle]):
                return self.sine(self.polynomial(angle))[name == "cos"], ONE
            case ast.Call(func=ast.Name(id="sqrt"), args=[x]):
                found = [r for r in self.roots if (self.squares[r], ONE) == self.value(x)]
                need(found, "a root that is not declared")
                return self.values[found[0]]
        raise Refused(f"a formula is not understood: {ast.unparse(node)[:60]}")

    def reduced(self, p):  # s² → 1 − c² and r² → radicand, as long as there are such
        for name, square in reversed(self.squares.items()):
            at = self.unit[name].bit_length() - 1
            while high := [m for m in p if m >> at & MOST > 1]:
                for m in high:
                    p = plus(plus(p, {m: p[m]}, -1), times({m - 2 * self.unit[name]: p[m]}, square))
        return p

    def quantity(self, q):  # what a claim or a definition speaks of
        if isinstance(q, str):
            return self.value(ast.parse(q, mode="eval").body)
        (kind, about), = q.items()
        return (self.between(*about[:2])[range(1, 4).index(about[2])][range(1, 5).index(about[3])] if kind == "frame" else
                {"terms": self.terms, "jacobian": self.jacobian, "minor": self.minor}[kind](*about)), ONE

    def terms(self, *terms):  # of a polynomial: a coefficient, then names and exponents
        found = {sum(n * self.unit[x] for x, n in zip(t[1::2], t[2::2])): t[0] if isinstance(t[0], int) else Fraction(t[0]) for t in terms}
        need(len(found) == len(terms) and 0 not in found.values(), "terms are not collected")
        need(all(0 < n < 4096 for t in terms for n in t[2::2]), "an exponent is not positive")
        return found

    def between(self, a, b):  # frame b in frame a; the base is a frame before frame 0, the tool one behind the last
        a, b = ({"base": -1, "tool": len(self.rows) + 1}[x] if isinstance(x, str) else x for x in (a, b))
        need(-1 <= min(a, b) and max(a, b) <= len(self.rows) + 1, "there is no such frame")
        x = [[ONE if i == k else ZERO for k in range(4)] for i in R3]
        x = reduce(product, [screw for link in self.links[min(a, b) + 1:max(a, b) + 1] for screw in link], x)
        return x if a <= b else inverse(x)

    def jacobian(self, view, row, joint):  # Σ θ' z × (p − o) + d' z, then Σ θ' z, over the rows before the body
        (body, axes, at, offset), total, q = view, ZERO, self.unit[self.joints[joint - 1]]
        need(0 < row < 7 and 0 < joint, "there is no such entry")
        p = product(self.between(axes, at), [[ONE, ZERO, ZERO, self.polynomial(x)] for x in offset])
        for i, cells in enumerate(self.rows[:len(self.rows) if body == "tool" else body]):
            forms = [self.polynomial(cells[cell]) for cell in ("theta", "d")]
            need(all(m == q or m >> (q.bit_length() - 1) & MOST == 0 for f in forms for m in f), "a cell is not linear")
            x = reduce(product, self.links[i + 1][:self.before], self.between(axes, i))
            (a, b, c), lever = [x[n % 3][2] for n in (row, row + 1, row - 1)], lambda n: plus(p[n % 3][3], x[n % 3][3], -1)
            twist = plus(times(a, lever(row + 1)), times(b, lever(row)), -1) if row < 4 else c
            total = plus(plus(total, twist, forms[0].get(q, 0)), c if row < 4 else ZERO, forms[1].get(q, 0))
        return total

    def minor(self, view, rows, joints, along):  # by Laplace's rule along a row, from entries and minors claimed before
        total, rest = ZERO, [r for r in rows if r != along]
        known = lambda rows, joints: self.proved[json.dumps([view, rows, joints])]
        for k, joint in enumerate(joints):
            if entry := known([along], [joint]):
                smaller = known(rest, [j for j in joints if j != joint]) if rest else ONE
                total = plus(total, times(entry, smaller), (-1) ** (rows.index(along) + k))
        return total

    def check(self, claim):
        (a, x), (b, y) = self.quantity(claim["left"]), self.quantity(claim["right"])
        off = plus(times(a, y), times(b, x), -1)
        for name, cofactor in claim["cofactors"].items():
            off = plus(off, times(plus({2 * self.unit[name]: 1}, self.squares[name], -1), self.terms(*cofactor)), -1)
        need(not off, f"{claim['name']}: left − right is not the sum of cofactors times relations")
        if isinstance(claim["left"], dict) and y == ONE and "frame" not in claim["left"]:
            (view, rows, joints, *_), = claim["left"].values()
            self.proved[json.dumps([view, *([k] if isinstance(k, int) else k for k in (rows, joints))])] = b

def main(files):
    bad = 0
    for file in files:
        try:
            certificate = json.load(open(file, encoding="utf-8"))
            names, checker = [c["name"] for c in certificate["claims"]], Checker(certificate)
            need(names == certificate["summary"] and len(set(names)) == len(names), "its claims are not those of its summary")
            need(names or certificate["missing"], "it says nothing")
            for claim in certificate["claims"]:
                checker.check(claim)
            open_ = "; not certified: " + ", ".join(certificate["missing"]) if certificate["missing"] else ""
            print(f"{file}: {certificate['robot']['name']}: {len(names)} claims hold{open_}")
        except (Refused, KeyError, ValueError, TypeError, IndexError, SyntaxError, AttributeError) as why:
            print(f"{file}: refused: {why}" if isinstance(why, Refused) else f"{file}: not a certificate: {why!r}")
            bad = max(bad, 1 if isinstance(why, Refused) else 3)
    return bad

if __name__ == "__main__":
    sys.setrecursionlimit(20_000)
    sys.exit(main(sys.argv[1:]))
