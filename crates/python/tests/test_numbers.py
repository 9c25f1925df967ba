"""Numbers against those of peers and of the command line, and what arrays may be."""

import json
import os
import pickle
import threading

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from conftest import URDF, peers
from denavit import MissingValueError, NoMassesError, Robot, ShapeError, UsageError, catalogue

Q = [0.3, -1.2, 1.5, 0.4, 0.9, -0.6]


def with_values(name, parameters):
    robot = Robot(name)
    known = {k: v for k, v in parameters.items() if k in robot.parameters}
    return robot.set(**known) if known else robot


def test_poses_of_all_robots_are_those_of_peers():
    robots = peers("fk.json")["robots"]
    assert set(robots) == set(catalogue())
    for name, one in robots.items():
        robot = with_values(name, one["parameters"])
        q = np.array([s["q"] for s in one["samples"]])
        found = robot.fk(q)
        wanted = np.array([s["pose"] for s in one["samples"]])
        assert found.shape == (*q.shape[:-1], 4, 4)
        assert np.abs(found - wanted).max() <= 1e-13 * max(1.0, one["reach"]), name
        # A row's bits do not depend on how many there are.
        assert np.array_equal(found[0], robot.fk(q[0])), name


def test_jacobians_are_those_of_pinocchio():
    for name, one in peers("jacobian.json")["robots"].items():
        robot = with_values(name, one["parameters"])
        for sample in one["samples"]:
            found = robot.jacobian(sample["q"])
            assert np.abs(found - np.array(sample["jacobian"])).max() <= 1e-12, name


def with_bodies(one):
    """An arm of the catalogue with stored bodies, rotors and gravity."""
    text = with_values(one["name"], one["parameters"]).toml
    head, *rows = text.split("\n[[joints]]\n")
    rotors = iter(one["rotors"])
    made = [f"gravity = {one['gravity']}\n{head}"]
    for row, body in zip(rows, one["bodies"]):
        more = ""
        if body is not None:
            more = f"inertia_at_origin = {body[:6]}\nfirst_moment = {body[6:9]}\nmass = {body[9]}\n"
        if '"q' in row or "q" in row.split("[")[0].replace("sqrt", ""):
            more += f"rotor = {next(rotors, 0.0)}\n"
        made.append(more + row)
    made += rows[len(one["bodies"]) :]
    return Robot.from_toml("\n[[joints]]\n".join(made))


def close(found, wanted, tolerance):
    wanted = np.array(wanted)
    return np.abs(found - wanted).max() <= tolerance * max(1.0, np.abs(wanted).max())


@pytest.mark.parametrize("name", ["planar-2r", "scara", "articulated-3r", "cylindrical-rpp"])
def test_dynamics_are_those_of_pinocchio(name):
    one = next(o for o in peers("dynamics.json")["catalogue"] if o["name"] == name)
    robot = with_bodies(one)
    assert robot.has_masses
    of = {k: np.array([s[k] for s in one["samples"]]) for k in one["samples"][0] if k != "W"}
    q, qd, qdd = of["q"], of["qd"], of["qdd"]
    assert close(robot.torque(q, qd, qdd), of["tau"], 1e-10)
    assert close(robot.inertia(q), of["A"], 1e-10)
    assert close(robot.bias(q, qd), of["h"], 1e-10)
    assert close(robot.gravity(q), of["Q"], 1e-10)
    assert close(robot.acceleration(q, qd, of["pulled"]), of["direct"], 1e-8)
    assert close(robot.energy(q, qd), np.stack([of["T"], of["V"]], axis=-1), 1e-10)


def test_dynamics_of_a_file_are_those_of_pinocchio():
    one = next(o for o in peers("dynamics.json")["urdf"] if o["name"] == "double_pendulum")
    robot = Robot.from_file(URDF / "double_pendulum.urdf", tip=one["tip"], as_written=True)
    for s in one["samples"]:
        assert close(robot.torque(s["q"], s["qd"], s["qdd"]), s["tau"], 1e-10)
        assert close(robot.inertia(s["q"]), s["A"], 1e-10)


def test_dynamics_say_what_they_lack():
    with pytest.raises(NoMassesError, match="masses"):
        Robot("ur5").torque(Q, Q, Q)
    pendulum = Robot.from_dh([{"theta": "q1", "a": 1, "mass": 2}], convention="standard")
    with pytest.raises(ShapeError, match=r"qd has the shape \(2,\); \(..., 1\) is needed"):
        pendulum.bias([0.0], [0.0, 1.0])
    with pytest.raises(ShapeError, match="do not go together"):
        pendulum.bias(np.zeros((2, 1)), np.zeros((3, 1)))
    assert pendulum.bias(np.zeros((4, 1, 1)), np.zeros((3, 1))).shape == (4, 3, 1)


def test_numbers_are_those_of_the_command_line(cli):
    robot = Robot("puma560")
    text = ",".join(map(str, Q))
    pose = np.array(json.loads(cli("fk", "puma560", "-q", text, "--json"))["pose"])
    assert np.abs(robot.fk(Q) - pose).max() <= 1e-15
    printed = json.loads(cli("ik", "puma560", "-q", text, "--json"))
    answer = robot.ik(pose)
    assert np.abs(answer.solutions - np.array([s["q"] for s in printed["solutions"]])).max() <= 1e-12
    assert answer.branches == [s["branch"] for s in printed["solutions"]]
    assert (answer.complete, answer.status, answer.method) == (
        printed["complete"],
        printed["status"],
        printed["method"],
    )


def test_frames_and_jacobians_by_frame():
    robot = Robot("ur5")
    frames = robot.frames(Q)
    assert frames.shape == (8, 4, 4)
    assert np.array_equal(frames[0], np.eye(4))
    assert np.allclose(frames[-1], robot.fk(Q), atol=1e-15)
    assert np.array_equal(robot.frames(Q, of=[2, "tool"]), frames[[2, 7]])
    with pytest.raises(UsageError, match="name a frame from 0 to 6"):
        robot.frames(Q, of=[9])
    j = robot.jacobian(Q)
    turn = robot.fk(Q)[:3, :3].T
    own = np.vstack([turn @ j[:3], turn @ j[3:]])
    assert np.allclose(robot.jacobian(Q, frame="tool"), own, atol=1e-14)
    assert np.allclose(robot.jacobian(Q, of=2)[:, 2:], 0.0)
    with pytest.raises(UsageError, match="the base does not move"):
        robot.jacobian(Q, of="base")
    # The derivative of the position.
    h = 1e-6
    for k in range(6):
        step = h * np.eye(6)[k]
        slope = (robot.fk(Q + step)[:3, 3] - robot.fk(Q - step)[:3, 3]) / (2 * h)
        assert np.allclose(j[:3, k], slope, atol=1e-8)


@settings(max_examples=60, deadline=None)
@given(
    shape=st.lists(st.integers(0, 4), max_size=3),
    dtype=st.sampled_from(["f8", "f4", "f2", ">f8", "i4", "u1", "?"]),
    order=st.sampled_from("CF"),
    step=st.sampled_from([1, 2, -1]),
)
def test_arrays_of_any_kind(shape, dtype, order, step):
    robot = Robot("scara")
    rng = np.random.default_rng(0)
    whole = (3 * rng.standard_normal((*shape, 8))).astype(dtype, order=order)
    q = whole[..., ::step][..., :4]
    found = robot.fk(q)
    assert found.shape == (*shape, 4, 4)
    assert found.flags.c_contiguous
    assert found.dtype == (np.float32 if dtype == "f4" else np.float64)
    exact = robot.fk(np.ascontiguousarray(q, dtype=np.float64))
    assert np.allclose(found, exact, atol=1e-5 if dtype == "f4" else 0.0)


def test_wrong_arrays_are_refused():
    robot = Robot("ur5")
    for q, shape in [([0.0] * 5, r"\(5,\)"), (0.0, r"\(\)"), (np.zeros((2, 7)), r"\(2, 7\)")]:
        with pytest.raises(ShapeError, match=rf"q has the shape {shape}; \(..., 6\) is needed"):
            robot.fk(q)
    with pytest.raises(ShapeError, match="no array"):
        robot.fk([[0.0] * 6, [0.0]])
    for q in (np.zeros(6, dtype=complex), ["a"] * 6, [None] * 6):
        with pytest.raises(TypeError, match="real numbers are needed"):
            robot.fk(q)
    assert np.isnan(robot.fk([np.nan] + [0.0] * 5)[:2, 3]).all()
    with pytest.raises(MissingValueError, match="r7|value"):
        Robot.from_dh([("q1", 0, "L", 0)], convention="standard", parameters={"L": None}).fk([0.0])


def test_results_go_where_they_are_wanted():
    robot = Robot("ur5")
    q = np.random.default_rng(1).standard_normal((100, 6))
    out = np.empty((100, 4, 4))
    assert robot.fk(q, out=out) is out
    assert np.array_equal(out, robot.fk(q))
    for bad in (np.empty((99, 4, 4)), np.empty((100, 4, 4), "f4"), np.empty((4, 4, 100)).T, [0]):
        with pytest.raises(ShapeError, match=r"out: an array of float64 is needed, \(100, 4, 4\)"):
            robot.fk(q, out=bad)
    out.flags.writeable = False
    with pytest.raises(ShapeError, match="out"):
        robot.fk(q, out=out)
    space = np.zeros(16 * 6)
    with pytest.raises(ShapeError, match="out|borrow"):
        robot.fk(space.reshape(16, 6), out=space[:16].reshape(1, 4, 4))


def test_bits_depend_neither_on_threads_nor_on_pickles():
    robot = Robot("ur5")
    q = np.random.default_rng(2).standard_normal((50_000, 6))
    wanted = robot.fk(q, threads=1)
    assert np.array_equal(wanted, robot.fk(q))
    assert np.array_equal(wanted, robot.fk(q, threads=3))
    found = [None] * 8
    copy = pickle.loads(pickle.dumps(robot))
    assert copy == robot and hash(copy) == hash(robot)

    def work(k):
        one = [robot, copy, Robot("ur5")][k % 3]
        found[k] = (one.fk(q), one.jacobian(q[:100]), one.ik(wanted[k]).solutions)

    threads = [threading.Thread(target=work, args=(k,)) for k in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for k, (poses, jacobians, solutions) in enumerate(found):
        assert np.array_equal(poses, wanted)
        assert np.array_equal(jacobians, robot.jacobian(q[:100]))
        assert np.array_equal(solutions, robot.ik(wanted[k]).solutions)


def test_derivations_leave_nothing_behind():
    resource = pytest.importorskip("resource")
    count = 10_000 if os.environ.get("DENAVIT_SOAK") else 1_000
    scara, planar = Robot("scara"), Robot("planar-2r")
    length = next(iter(scara.parameters))

    def derive(k):
        scara.set(**{length: 0.3 + k / count}).fk([0.0] * 4)
        if k % 4 == 0:
            planar.derive("latex")
        if k % 16 == 0:
            planar.ik_explain()
            planar.set(a1=1.0 + k).compile("fk,jacobian")([0.1, 0.2])

    def peak():
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss

    for k in range(100):
        derive(k)
    before = peak()
    for k in range(count):
        derive(k)
    # Kilobytes.
    assert peak() - before < 16 * 1024
