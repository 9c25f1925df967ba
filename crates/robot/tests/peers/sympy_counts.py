"""Operation counts of 0Tn of every catalogue robot, as SymPy's common-subexpression elimination finds them.

For each ../../catalogue/*.toml: the product of the rows (without base and tool), lengths and joint
variables symbolic, fixed angles exact; then `cse` over its twelve entries, once on the raw product
("raw") and once after `trigsimp` of every entry ("trigsimp"). Results go to sympy_counts.json, one robot
at a time, so an interrupted run continues where it stopped.

Counting rule: a product of n factors is n - 1 multiplications and an integer power k is k - 1; a sum of n
terms is n - 1 additions; a factor of -1, a constant and an expression in parameters alone are free; sine
and cosine of one angle are one pair, and a sum of joint variables (or with an offset) inside an angle is
counted like any other sum; a quarter turn inside an angle is folded before counting.
Run: python sympy_counts.py [robot ...], in an environment with sympy.
"""

import datetime
import json
import multiprocessing
import pathlib
import sys
import time
import tomllib

import sympy as sp

HERE = pathlib.Path(__file__).resolve().parent
CATALOGUE = HERE.parent.parent / "catalogue"
RESULT = HERE / "sympy_counts.json"
SECONDS = 120
UNITS = {"deg": sp.pi / 180, "rad": sp.Integer(1), "m": sp.Integer(1), "mm": sp.Rational(1, 1000), "pi": sp.pi}


def cell(text, symbols):
    """The cell as an exact expression; parameters and joint variables stay symbols."""
    transform = sp.parsing.sympy_parser.standard_transformations + (
        sp.parsing.sympy_parser.implicit_multiplication, sp.parsing.sympy_parser.rationalize)
    return sp.parse_expr(str(text), local_dict=symbols | {k: v for k, v in UNITS.items() if k not in symbols},
                         transformations=transform)


def product(path):
    file = tomllib.loads(path.read_text(encoding="utf-8"))
    names = list(file.get("parameters", {})) + [f"q{i}" for i in range(1, 100)]
    symbols = {n: sp.Symbol(n, real=True) for n in names}
    t = sp.eye(4)
    for row in file["joints"]:
        read = lambda key: cell(row.get(key, "0"), symbols)
        khalil = file["convention"] == "khalil"
        theta, alpha = read("theta"), read("alpha")
        d, a = (read("r"), read("d")) if khalil else (read("d"), read("a"))
        ct, st, ca, sa = sp.cos(theta), sp.sin(theta), sp.cos(alpha), sp.sin(alpha)
        z = sp.Matrix([[ct, -st, 0, 0], [st, ct, 0, 0], [0, 0, 1, d], [0, 0, 0, 1]])
        x = sp.Matrix([[1, 0, 0, a], [0, ca, -sa, 0], [0, sa, ca, 0], [0, 0, 0, 1]])
        t = t * (z * x if file["convention"] == "standard" else x * z)
    return [t[i, j] for i in range(3) for j in range(4)]


def variables(expr):
    return {s for s in expr.free_symbols if s.name[0] == "q" and s.name[1:].isdigit()}


def count(entries):
    """The smaller of the counts of cse(entries) with and without its optimizations."""
    results = [tally(*sp.cse(entries, symbols=sp.numbered_symbols("_x"), optimizations=o)) for o in (None, "basic")]
    return min(results, key=lambda r: r["mul"] + r["add"] + r["sincos"])


def tally(replacements, reduced):
    """Multiplications, additions and sine/cosine pairs of a list of intermediates and results."""
    definition = dict(replacements)
    full = {}

    def expand(e):
        """`e` with the intermediates written out (memoised)."""
        if e not in full:
            full[e] = e.xreplace({s: expand(definition[s]) for s in e.free_symbols if s in definition})
        return full[e]

    pairs, arguments, mul, add = set(), set(), 0, 0

    def constant(e):
        return not variables(expand(e))

    def walk(e):
        nonlocal mul, add
        if e.is_Atom or constant(e):
            return
        free = [f for f in e.args if constant(f)]
        moving = [f for f in e.args if not constant(f)]
        if isinstance(e, (sp.sin, sp.cos)):
            angle = expand(e.args[0])
            pairs.add(max(angle, -angle, key=sp.default_sort_key))
            if e.args[0] in arguments:
                return
            arguments.add(e.args[0])
        elif e.is_Mul:
            scale = sp.Mul(*[expand(f) for f in free])
            mul += len(moving) - 1 + (0 if scale in (1, -1) else 1)
        elif e.is_Add:
            add += len(moving) - 1 + (1 if free else 0)
        elif e.is_Pow and e.exp.is_Integer and e.exp > 1:
            mul += int(e.exp) - 1
        else:
            raise ValueError(f"cannot count {e}")
        for f in moving:
            walk(f)

    for e in [e for _, e in replacements] + list(reduced):
        walk(e)
    return {"mul": mul, "add": add, "sincos": len(pairs)}


def measure(path, variant, queue):
    start = time.process_time()
    entries = product(path)
    if variant == "trigsimp":
        entries = [sp.trigsimp(e) for e in entries]
    simplified = time.process_time()
    result = count(entries)
    result["seconds"] = round(simplified - start, 3)
    queue.put(result)


def bounded(path, variant):
    """`measure` in a process of its own, ended after SECONDS."""
    queue = multiprocessing.Queue()
    process = multiprocessing.Process(target=measure, args=(path, variant, queue))
    process.start()
    process.join(SECONDS)
    if process.is_alive():
        process.terminate()
        process.join()
        return "timeout"
    return queue.get(timeout=10) if process.exitcode == 0 else "failed"


def structure(path):
    """Robots with the same table have the same counts: values, limits and names do not matter."""
    file = tomllib.loads(path.read_text(encoding="utf-8"))
    keys = ("theta", "d", "a", "alpha", "r")
    return json.dumps([file["convention"], [[str(r.get(k, "0")) for k in keys] for r in file["joints"]]])


def main():
    data = {"provenance": {}, "robots": {}}
    if RESULT.exists():
        data = json.loads(RESULT.read_text(encoding="utf-8"))
    data["provenance"] = {
        "sympy": sp.__version__, "made_by": "crates/robot/tests/peers/sympy_counts.py",
        "date": datetime.date.today().isoformat(), "seconds_bound": SECONDS,
        "rule": "0Tn without base and tool; n-ary product n-1, sum n-1; signs, constants and parameter-only "
                "expressions free; one pair an angle; sums inside angles counted as additions",
    }
    wanted = sys.argv[1:]
    paths = sorted(CATALOGUE.glob("*.toml"))
    order = {"staubli-rx90": 0, "ur5": 1, "puma560": 2, "stanford": 3, "prrrrp": 4}
    paths.sort(key=lambda p: (order.get(p.stem, 9), len(tomllib.loads(p.read_text(encoding="utf-8"))["joints"]), p.stem))
    known = {}
    for path in paths:
        if path.stem in data["robots"] and data["robots"][path.stem].get("table") == structure(path):
            known[structure(path)] = data["robots"][path.stem]
    for path in paths:
        if wanted and path.stem not in wanted:
            continue
        key = structure(path)
        if key not in known or path.stem in wanted:
            known[key] = {"table": key} | {v: bounded(path, v) for v in ("raw", "trigsimp")}
            scored = [(r["mul"] + r["add"] + r["sincos"], v) for v in ("trigsimp", "raw")
                      if isinstance(r := known[key][v], dict)]
            known[key]["smaller"] = min(scored)[1] if scored else None
        data["robots"][path.stem] = known[key]
        data["robots"] = dict(sorted(data["robots"].items()))
        RESULT.write_text(json.dumps(data, indent=1) + "\n", encoding="utf-8")
        print(path.stem, {v: known[key][v] for v in ("raw", "trigsimp")}, flush=True)


if __name__ == "__main__":
    main()
