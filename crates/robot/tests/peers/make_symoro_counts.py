"""Operation counts of the inverse dynamics that OpenSYMORO derives for every catalogue robot.

OpenSYMORO (github.com/symoro/symoro, MIT) is run as it is, converted by lib2to3 since it is written for Python 2: its base parameters
(`baseparams.base_inertial_parameters`), then its recursive Newton-Euler algorithm (`nealgos.fixed_inverse_dynmodel`), on the .par file
that `denavit convert ROBOT --to par` writes: Khalil's table with symbols for lengths, all inertial parameters symbols, gravity G3 along z,
no wrench at the tool, no friction, no rotors. Results go to symoro_counts.json, multiplications and additions: "base" with its
base parameters (null where its grouping for a slide along the axes before it stops with an error), "all" with ten parameters a link.

Counting rule, that of `denavit dynamics --symbolic`: what no torque reads is left out, equal values count once; a product of n factors is
n - 1 multiplications, a power k is k - 1, a sum of n terms n - 1 additions; what depends on parameters alone is free but for the
operation that joins it to a variable; signs are free; twice a value is an addition; sines and cosines are free.
Run: python make_symoro_counts.py OPENSYMORO DENAVIT [robot ...], in an environment with sympy and lib2to3 (Python 3.11 has it):
the folder of OpenSYMORO, converted, and the program.
"""

import copy
import datetime
import json
import pathlib
import subprocess
import sys
import tempfile

import sympy
from sympy import Add, Matrix, Mul, Pow, Symbol, cos, sin, var, zeros

HERE = pathlib.Path(__file__).resolve().parent
CATALOGUE = HERE.parent.parent / "catalogue"
RESULT = HERE / "symoro_counts.json"


def derived(par, is_grouped):
    """The robot of a .par file and the equations of its torques."""
    from pysymoro import baseparams, nealgos
    from symoroutils import parfile, symbolmgr, tools

    robot, flag = parfile.readpar("robot", par)
    if flag != tools.OK:
        raise ValueError(f"OpenSYMORO does not read {par}")
    robot.Nex = [zeros(3, 1) for _ in range(robot.NL)]
    robot.Fex = [zeros(3, 1) for _ in range(robot.NL)]
    robot.FS = robot.FV = robot.IA = [0] * robot.NL
    robot.G = Matrix([0, 0, var("G3")])
    if is_grouped:
        robot = copy.deepcopy(robot)
        # What is grouped has names of its own there, and is given to the torques.
        baseparams.base_inertial_parameters(robot, symbolmgr.SymbolManager(None))
    equations = symbolmgr.SymbolManager(None)
    nealgos.fixed_inverse_dynmodel(robot, equations)
    return robot, equations.sydi


def counted(robot, equations):
    """Multiplications and additions of the torques."""
    variables = set()
    for j in range(1, robot.NL):
        q = robot.theta[j] if robot.sigma[j] == 0 else robot.r[j]
        for x in (q, robot.qdot[j], robot.qddot[j]):
            variables |= sympy.sympify(x).free_symbols
    torques = [Symbol(f"GAM{j}") for j in range(1, robot.NL)]
    live, stack = set(), list(torques)
    while stack:
        symbol = stack.pop()
        if symbol not in live:
            live.add(symbol)
            stack.extend(s for s in sympy.sympify(equations[symbol]).free_symbols if s in equations)
    known = {}

    def is_variable(symbol):
        if symbol not in known:
            given = equations.get(symbol)
            known[symbol] = symbol in variables or given is not None and varies(sympy.sympify(given))
        return known[symbol]

    def varies(e):
        return any(is_variable(s) for s in e.free_symbols)

    count, seen = [0, 0], set()

    def walk(e):
        if e.is_Atom or not varies(e) or e in seen or e.func in (sin, cos):
            return
        seen.add(e)
        moving = [a for a in e.args if varies(a)]
        fixed = [a for a in e.args if not varies(a)]
        if e.func is Mul:
            constant = Mul(*fixed)
            if abs(constant) == 2:
                count[1] += 1
            elif abs(constant) != 1:
                count[0] += 1
            count[0] += len(moving) - 1
        elif e.func is Add:
            count[1] += len(moving) - 1 + bool(fixed)
        elif e.func is Pow and e.exp.is_Integer and e.exp > 1:
            count[0] += int(e.exp) - 1
        else:
            raise ValueError(f"no operation: {e}")
        for a in moving:
            walk(a)

    for symbol in live:
        walk(sympy.sympify(equations[symbol]))
    return count


def tried(par, is_grouped):
    """The counts; None where OpenSYMORO's grouping stops with an error of its own."""
    try:
        return counted(*derived(par, is_grouped))
    except AttributeError as e:
        # `group_param_prism_spec` reads a `robo.JJ` that no robot has.
        if not is_grouped or "JJ" not in str(e):
            raise
        return None


def main():
    symoro, denavit, *names = sys.argv[1:]
    sys.path.insert(0, symoro)
    sys.setrecursionlimit(100_000)
    robots = {}
    if names:
        robots = json.loads(RESULT.read_text())["robots"]
    for name in names or sorted(p.stem for p in CATALOGUE.glob("*.toml")):
        made = subprocess.run([denavit, "--quiet", "convert", name, "--to", "par"], capture_output=True, text=True)
        if made.returncode != 0:
            # Joints that follow others have no place in a .par file.
            print(name, made.stderr.strip().splitlines()[0])
            continue
        with tempfile.TemporaryDirectory() as folder:
            par = pathlib.Path(folder) / "robot.par"
            par.write_text(made.stdout)
            robots[name] = {key: tried(str(par), key == "base") for key in ("base", "all")}
        print(name, robots[name], flush=True)
    provenance = (
        f"OpenSYMORO 0ec0f80 by lib2to3 under Python {sys.version.split()[0]} with SymPy {sympy.__version__}, "
        f"{datetime.date.today()}; make_symoro_counts.py"
    )
    lines = ",\n".join(f"  {json.dumps(name)}: {json.dumps(robots[name])}" for name in sorted(robots))
    RESULT.write_text(f'{{\n "provenance": {json.dumps(provenance)},\n "robots": {{\n{lines}\n }}\n}}\n')


if __name__ == "__main__":
    main()
