"""Compiled functions: the bits of the methods, many functions at once, the closed form by itself."""

import pickle
import threading

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from conftest import peers
from denavit import (
    MissingValueError,
    NoMassesError,
    PoseError,
    Robot,
    ShapeError,
    UnsupportedError,
    UsageError,
)
from test_numbers import with_bodies

Q = np.array([0.3, -1.2, 1.5, 0.4, 0.9, -0.6])
UR5 = Robot("ur5")


def test_compiled_functions_have_the_bits_of_the_methods():
    rows = np.random.default_rng(3).uniform(-3, 3, (3000, 6))
    alone = UR5.compile("fk")
    assert alone.native and alone.functions == ["fk"] and alone.arguments == ["q"]
    assert np.array_equal(alone(rows), UR5.fk(rows)) and np.array_equal(alone(Q), UR5.fk(Q))
    # Machine code for one, blocks for many.
    assert all(np.array_equal(alone(q), pose) for q, pose in zip(rows[:50], alone(rows[:50])))
    pose, jacobian, frames = UR5.compile("fk, jacobian, frames")(rows)
    assert np.array_equal(pose, UR5.fk(rows))
    assert np.array_equal(jacobian, UR5.jacobian(rows)) and np.array_equal(frames, UR5.frames(rows))
    assert alone(Q.astype("f4")).dtype == np.float32
    assert alone(np.zeros((0, 6))).shape == (0, 4, 4)
    out = np.empty((4, 4))
    assert alone(Q, out=out) is out and np.array_equal(out, UR5.fk(Q))


def test_compiled_dynamics():
    one = next(o for o in peers("dynamics.json")["catalogue"] if o["name"] == "articulated-3r")
    robot = with_bodies(one)
    q, qd, qdd, tau = (np.array([s[k] for s in one["samples"]]) for k in ("q", "qd", "qdd", "pulled"))
    all_of_it = robot.compile(["torque", "inertia", "acceleration", "fk", "torque_derivatives"])
    assert all_of_it.arguments == ["q", "qd", "qdd", "tau"]
    torque, inertia, acceleration, pose, slopes = all_of_it(q, qd, qdd, tau)
    assert np.array_equal(torque, robot.torque(q, qd, qdd))
    assert np.array_equal(inertia, robot.inertia(q))
    assert np.array_equal(acceleration, robot.acceleration(q, qd, tau))
    assert np.array_equal(pose, robot.fk(q))
    assert np.array_equal(slopes.by_q, robot.torque_derivatives(q, qd, qdd).by_q)
    assert robot.compile("energy")(q, qd[0]).shape == (len(q), 2)
    with pytest.raises(ShapeError, match="do not go together: q .*, qd "):
        robot.compile("energy")(q, np.zeros((len(q) + 1, 3)))


def test_the_closed_form_by_itself():
    ik = UR5.compile("ik")
    rows = np.random.default_rng(4).uniform(-3, 3, (200, 6))
    poses = UR5.fk(rows).reshape(20, 10, 4, 4)
    found = ik(poses)
    assert found.solutions.shape == (20, 10, ik.most, 6) and found.counts.shape == (20, 10)
    assert np.array_equal(found.counts, np.sum(~np.isnan(found.solutions[..., 0]), axis=-1))
    answers = UR5.ik_batch(poses)
    regular = found.regular
    assert regular.mean() > 0.9 and np.array_equal(found.counts[regular], answers.counts[regular])
    for k in np.argwhere(regular)[:40]:
        one = found.solutions[tuple(k)][: found.counts[tuple(k)]]
        assert np.abs(UR5.fk(one) - poses[tuple(k)]).max() < 1e-9
        # One by one they are the same.
        single = ik(poses[tuple(k)])
        assert np.array_equal(single.solutions, found.solutions[tuple(k)], equal_nan=True)
    nowhere = np.eye(4)
    nowhere[0, 3] = 9.0
    assert ik(nowhere).counts == 0 and np.isnan(ik(nowhere).solutions).all()
    assert ik(np.zeros((0, 4, 4))).solutions.shape == (0, ik.most, 6)
    with pytest.raises(PoseError, match="pose 1"):
        ik(np.stack([np.eye(4), 2 * np.eye(4)]))
    with pytest.raises(UnsupportedError, match="no closed form"):
        Robot("fanuc-crx10ia-l").compile("ik")
    with pytest.raises(UnsupportedError, match="given"):
        Robot("franka-panda").compile("ik")


def test_pickles_are_made_again():
    both, ik = pickle.loads(pickle.dumps((COMPILED, UR5.compile("ik"))))
    assert both.functions == COMPILED.functions
    assert all(np.array_equal(a, b) for a, b in zip(both(Q), COMPILED(Q)))
    assert np.array_equal(ik(UR5.fk(Q)).solutions, UR5.compile("ik")(UR5.fk(Q)).solutions, equal_nan=True)
    rows = [("q1", 0.4, 0, np.pi / 2), ("q2", 0, 0.3, 0), ("q3", 0, 0.2, 0)]
    arm = Robot.from_dh(rows, convention="standard")
    pose = arm.fk([0.1, 0.2, 0.3])
    places = pickle.loads(pickle.dumps(arm.compile("ik", goal="position")))(pose)
    assert int(places.counts) == len(arm.ik(pose, goal="position")) == 4


def test_what_cannot_be_compiled():
    with pytest.raises(UsageError, match="no function `dance`: fk"):
        UR5.compile("dance")
    with pytest.raises(UsageError, match="or ik, alone"):
        UR5.compile(["fk", "ik"])
    with pytest.raises(UsageError, match="no function"):
        UR5.compile([])
    with pytest.raises(NoMassesError):
        UR5.compile("torque")
    with pytest.raises(MissingValueError):
        Robot.from_dh([("q1", 0, "L", 0)], convention="standard", parameters={"L": None}).compile()
    with pytest.raises(UsageError, match="2 vectors are given; q are needed"):
        UR5.compile()(Q, Q)
    with pytest.raises(UsageError, match="several"):
        UR5.compile("fk,jacobian")(Q, out=np.empty((4, 4)))
    with pytest.raises(ShapeError, match=r"q has the shape \(5,\); \(..., 6\) is needed"):
        UR5.compile()(Q[:5])


COMPILED = UR5.compile("fk,jacobian")


@settings(max_examples=60, deadline=None)
@given(
    st.data(),
    arrays.array_shapes(min_dims=0, max_dims=3, min_side=0, max_side=4),
    st.sampled_from(["f8", "f4", ">f8", "i2", "u1", "?", "f2"]),
)
def test_any_shape_dtype_and_stride(data, leading, dtype):
    elements = None if dtype in ("i2", "u1", "?") else {"min_value": -8, "max_value": 8}
    whole = data.draw(arrays.arrays(dtype, (*leading, 6), elements=elements))
    strided = np.stack([whole, whole], axis=-1)[..., 0]
    backwards = np.ascontiguousarray(whole[..., ::-1])[..., ::-1]
    wanted = UR5.fk(whole.astype("f4" if dtype == "f4" else "f8"))
    assert wanted.shape == (*leading, 4, 4)
    for given_array in (whole, strided, backwards, np.asfortranarray(whole), whole.tolist()):
        if isinstance(given_array, list) and (dtype == "f4" or 0 in leading):
            continue
        pose, jacobian = COMPILED(given_array)
        assert np.array_equal(UR5.fk(given_array), wanted) and np.array_equal(pose, wanted)
        assert jacobian.shape == (*leading, 6, 6)


@settings(max_examples=40, deadline=None)
@given(arrays.array_shapes(min_dims=0, max_dims=3, min_side=0, max_side=7))
def test_wrong_shapes_are_named(shape):
    array = np.zeros(shape)
    written = str(array.shape).replace("(", r"\(").replace(")", r"\)")
    if shape[-1:] != (6,):
        for call in (UR5.fk, UR5.jacobian, UR5.frames, COMPILED):
            with pytest.raises(ShapeError, match=f"q has the shape {written}"):
                call(array)
    if shape[-2:] != (4, 4):
        with pytest.raises(ShapeError, match=f"pose has the shape {written}"):
            UR5.ik_batch(array)


@settings(max_examples=40, deadline=None)
@given(st.lists(st.sampled_from([np.nan, np.inf, -np.inf, 0.5]), min_size=6, max_size=6))
def test_what_is_no_number_spoils_only_what_depends_on_it(q):
    pose, jacobian = COMPILED(q)
    rows = UR5.fk([q, [0.5] * 6])
    assert np.array_equal(rows[0], pose, equal_nan=True) and np.isfinite(rows[1]).all()
    assert np.isnan(pose).any() == (not np.isfinite(q).all())
    # The first column depends on all joints but itself by the position; directions on those before.
    assert np.isfinite(jacobian[3:, 0]).all()


def test_eight_threads_have_the_same_bits():
    rows = np.random.default_rng(5).uniform(-3, 3, (20_000, 6))
    ik = UR5.compile("ik")
    wanted = (COMPILED(rows), ik(COMPILED(rows[:500])[0]))
    found = [None] * 8

    def work(k):
        one = [COMPILED(q)[0] for q in rows[:200]]
        found[k] = (COMPILED(rows), ik(COMPILED(rows[:500])[0]), np.array(one))

    threads = [threading.Thread(target=work, args=(k,)) for k in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for both, solved, one in found:
        assert all(np.array_equal(a, b) for a, b in zip(both, wanted[0]))
        assert all(np.array_equal(a, b, equal_nan=True) for a, b in zip(solved, wanted[1]))
        assert np.array_equal(one, wanted[0][0][:200])
