"""Formulas as SymPy has them: the numbers of the compiled programs, proofs that can fail; what notebooks show."""

import pickle

import numpy as np
import pytest

from denavit import Derivation, Robot, UnsupportedError, UsageError, _denavit
from test_numbers import with_values

sympy = pytest.importorskip("sympy")
ARMS = ["ur5", "staubli-rx90", "scara", "stanford", "puma560"]


def valued(robot):
    """The robot with a value for everything, and the values by symbol."""
    lacking = [name for name, x in robot.parameters.items() if x is None]
    robot = robot.set(**{name: 0.2 + 0.1 * k for k, name in enumerate(lacking)})
    return robot, {sympy.Symbol(name): x for name, x in robot.parameters.items()}


def numbers(expressions, symbols, values, rows):
    """Values of expressions at rows of the symbols."""
    function = sympy.lambdify(symbols, [e.subs(values) for e in expressions], "numpy", cse=True)
    return np.stack([np.broadcast_to(x, len(rows)) for x in function(*rows.T)], axis=-1).astype(float)


def stepped(steps, values, symbols, row):
    """The values of steps, one after another."""
    known = {**values, **dict(zip(symbols, row))}
    for step in steps:
        known[step.name] = float(step.value.subs(known))
    return known


@pytest.mark.parametrize("name", ARMS)
def test_poses_and_jacobians_are_those_that_are_computed(name):
    robot, values = valued(Robot(name))
    q = [sympy.Symbol(joint.variable) for joint in robot.joints]
    rows = np.random.default_rng(6).uniform(-2, 2, (20, robot.n))
    found = robot.derive().to_sympy()
    assert found.pose.shape == (4, 4) and len(found.links) == len(robot._core.table[1])
    pose = numbers(list(found.pose), q, values, rows).reshape(-1, 4, 4)
    assert np.abs(pose - robot.fk(rows)).max() < 1e-12
    known = stepped(found.steps, values, q, rows[0])
    assert abs(known[sympy.Symbol("t14")] - robot.fk(rows[0])[0, 3]) < 1e-12
    product = sympy.eye(4)
    for link in found.links:
        product = product * link
    last = robot.frames(rows, of=[len(found.links)])[:, 0]
    base = robot.frames(rows, of=[0])[:, 0]
    assert np.abs(base @ numbers(list(product), q, values, rows).reshape(-1, 4, 4) - last).max() < 1e-12
    # The determinant does not depend on the frame.
    jacobian = robot.jacobian_explain().to_sympy()
    if robot.n == 6 and jacobian.determinants:
        det = numbers(jacobian.determinants, q, values, rows)[:, 0]
        wanted = np.linalg.det(robot.jacobian(rows))
        assert np.abs(np.abs(det) - np.abs(wanted)).max() <= 1e-12 * max(1.0, np.abs(wanted).max())
    for equation in robot.ik_explain().to_sympy().all:
        assert isinstance(equation, sympy.Eq)


def test_torques_are_those_that_are_computed():
    robot = Robot.from_dh(
        [
            {
                "theta": "q1",
                "a": 0.5,
                "mass": 2.0,
                "com": [-0.2, 0.01, 0.0],
                "inertia": [0.1, 0.2, 0.3, 0, 0, 0],
            },
            {
                "theta": "q2",
                "a": 0.4,
                "mass": 1.5,
                "com": [-0.1, 0.0, 0.02],
                "inertia": [0.2, 0.1, 0.4, 0, 0, 0],
            },
        ],
        convention="standard",
        gravity=[0, -9.81, 0],
    )
    found = robot.dynamics_explain().to_sympy()
    q = [sympy.Symbol("q1"), sympy.Symbol("q2")]
    symbols = sorted(found.inertia.free_symbols - set(q), key=str)
    assert symbols and {step.name for step in found.base} >= {s for s in symbols if str(s)[0] in "ZXYM"}
    # A is symmetric, linear in the base parameters, and that of the arm for its numbers, which a fit gives back.
    rows = np.random.default_rng(7).uniform(-2, 2, (40, 2))
    flat = sympy.Matrix(list(found.inertia))
    slopes = flat.jacobian(symbols)
    assert not slopes.free_symbols & set(symbols) and found.inertia == found.inertia.T
    columns = numbers(list(slopes), q, {}, rows).reshape(-1, len(symbols))
    wanted = robot.inertia(rows).reshape(-1)
    fitted, *_ = np.linalg.lstsq(columns, wanted, rcond=None)
    assert np.abs(columns @ fitted - wanted).max() < 1e-12


def test_representatives_of_base_parameters_are_chosen():
    robot = Robot("planar-2r")
    plain = robot.dynamics_explain().to_sympy()
    kept = robot.dynamics_explain(keep="M2", drop=["ZZ1"]).to_sympy()
    named = [{str(step.name) for step in found.base} for found in (plain, kept)]
    assert "ZZR1" in named[0] and "MR2" not in named[0]
    assert "MR2" in named[1] and "ZZR1" not in named[1]
    assert "MR2" in robot.dynamics_explain(keep=["M2"], format="latex").to("text")
    # In the parameters of the links the torques are the same.
    matrices = [f.inertia.subs({step.name: step.value for step in f.base}) for f in (plain, kept)]
    assert plain.inertia != kept.inertia
    assert (matrices[0] - matrices[1]).applyfunc(sympy.simplify) == sympy.zeros(2, 2)
    for wrong, why in [
        ({"keep": "XX1"}, "XX1 has no effect"),
        ({"keep": ["ZZ1", "M2"]}, "cannot be kept with the others"),
        ({"keep": "M2", "drop": "M2"}, "kept and dropped"),
        ({"drop": "ZZ9"}, "no parameter ZZ9"),
    ]:
        with pytest.raises(UsageError, match=why):
            robot.dynamics_explain(**wrong)


def test_the_closed_form_of_two_links():
    robot, values = valued(Robot("planar-2r"))
    rows = np.random.default_rng(8).uniform(-1, 1, (5, 2))
    equations = robot.ik_explain().to_sympy().equations
    for row in rows:
        pose = robot.fk(row)
        # The derivation has brought the constants behind the last joint to the side of the pose.
        p = pose[:2, 3] - robot.parameters["a2"] * pose[:2, 0]
        names = {"px": p[0], "py": p[1], "nx": pose[0, 0], "ox": pose[0, 1]}
        known = {**values, **{sympy.Symbol(k): x for k, x in names.items()}}
        for name in ("q1", "q12", "joints"):
            for equation in equations[name]:
                known[equation.lhs] = float(equation.rhs.subs(known))
        assert [known[sympy.Symbol(k)] for k in ("q1", "q2")] == pytest.approx(list(row), abs=1e-12)


def test_proofs_can_fail():
    x, y = sympy.symbols("x y")
    from denavit._sympy import made, nodes_of

    def open_ones(one, other):
        (a, [i]), (b, [j]) = nodes_of([one]), nodes_of([other])
        return _denavit.not_proved(a, b, [(i, j)])

    assert open_ones(sympy.sin(x + y), sympy.sin(x) * sympy.cos(y) + sympy.cos(x) * sympy.sin(y)) == []
    assert open_ones(sympy.sin(x + y), sympy.sin(x) * sympy.cos(y) - sympy.cos(x) * sympy.sin(y)) == [0]
    assert open_ones(sympy.sqrt(x) ** 3 / 7, sympy.Rational(1, 7) * x * sympy.sqrt(x)) == []
    assert open_ones(x, x + sympy.Rational(1, 10**30)) == [0]
    with pytest.raises(UnsupportedError, match="exp"):
        nodes_of([sympy.exp(x)])
    # What assumptions change for the worse is seen: a root of a square is no number without its sign.
    nodes = [("symbol", [], "x"), ("pow", [0], "2"), ("sqrt", [1], "")]
    assert made(nodes, [("y", [[2]])], {"real": True})[0][1] == [[sympy.Abs(sympy.Symbol("x", real=True))]]
    with pytest.raises(UnsupportedError, match="not proved"):
        made(nodes, [("y", [[2]])], {"positive": True})


def test_derivations_are_texts_with_more():
    robot = with_values("planar-2r", {})
    found = robot.derive()
    assert isinstance(found, str) and isinstance(found, Derivation)
    assert found.to("json") == robot.derive("json") and found.latex == robot.derive("latex")
    assert found.to("latex").to("text") == found
    page = found._repr_html_()
    assert "<math" in page and "<script" not in page and "<!DOCTYPE" not in page and "@font-face" not in page
    assert page.count("<div") == page.count("</div>")
    assert "\\begin{bmatrix}" in found._repr_latex_()
    assert pickle.loads(pickle.dumps(found)) == found
    assert str(found.to_sympy(real=True).pose[0, 3]) == "a1*cos(q1) + a2*cos(q1 + q2)"
    for other in (robot.jacobian_explain(), robot.dynamics_explain(), robot.ik_explain()):
        assert "<math" in other._repr_html_() and other.to_sympy() is not None
