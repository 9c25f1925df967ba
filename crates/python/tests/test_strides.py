"""Arrays as they lie in memory: whatever their strides, the bits are those of their copies, and they are not copied."""

import tracemalloc

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from denavit import Robot

SCARA = Robot("scara")
PENDULUM = Robot.from_dh(
    [{"theta": "q1", "a": 1, "mass": 2}, {"theta": "q2", "a": "L", "mass": 1, "com": [0.1, 0, 0]}],
    convention="standard",
    parameters={"L": 0.5},
)
STEPS = st.sampled_from([1, 2, 3, -1, -2])


@st.composite
def views(draw, n, leading=None):
    """A view of the shape `(..., n)`, some axes of which are skipped through, turned round, swapped or repeated."""
    shape = draw(st.lists(st.integers(1, 5), max_size=4)) if leading is None else list(leading)
    dtype = draw(st.sampled_from([np.float64, np.float32]))
    steps = [draw(STEPS) for _ in shape]
    last, more = draw(STEPS), draw(st.integers(0, 2))
    order = draw(st.permutations(range(len(shape)))) if leading is None else range(len(shape))
    sizes = [size * abs(step) for size, step in zip(shape, steps)] + [n * abs(last) + more]
    rng = np.random.default_rng(draw(st.integers(0, 2**16)))
    whole = (3 * rng.standard_normal(sizes)).astype(dtype, order=draw(st.sampled_from("CF")))
    view = whole[tuple(slice(None, None, step) for step in [*steps, last])][..., :n]
    view = view.transpose([*order, len(shape)])
    if leading is None and draw(st.booleans()):
        view = np.broadcast_to(view, (draw(st.integers(1, 3)), *view.shape))
    return view


@settings(max_examples=300, deadline=None)
@given(q=views(4), threads=st.sampled_from([None, 1, 3]))
def test_strides_do_not_change_bits(q, threads):
    before = q.copy()
    copy = np.ascontiguousarray(q)
    for function in (SCARA.fk, SCARA.jacobian):
        found = function(q, threads=threads)
        assert found.dtype == q.dtype
        assert found.tobytes() == function(copy).tobytes()
    assert np.array_equal(q, before)


@settings(max_examples=150, deadline=None)
@given(q=views(2, (3, 4)), qd=views(2, (4,)), qdd=views(2, (3, 1)))
def test_strides_of_several_vectors_do_not_change_bits(q, qd, qdd):
    found = PENDULUM.torque(q, qd, qdd)
    copies = [np.ascontiguousarray(np.broadcast_to(v, (3, 4, 2))) for v in (q, qd, qdd)]
    assert found.shape == (3, 4, 2)
    assert found.dtype == np.result_type(q, qd, qdd)
    assert found.tobytes() == PENDULUM.torque(*copies).tobytes()


@settings(max_examples=60, deadline=None)
@given(q=views(4, (2, 3)))
def test_strides_of_poses_do_not_change_bits(q):
    poses = SCARA.fk(q.astype(np.float64))
    turned = np.ascontiguousarray(poses.transpose(3, 1, 0, 2)).transpose(2, 1, 3, 0)
    assert turned.strides != poses.strides
    one, other = SCARA.ik_batch(poses), SCARA.ik_batch(turned)
    assert one.solutions.tobytes() == other.solutions.tobytes()
    assert one.branches == other.branches


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_many_rows_anywhere(dtype):
    robot = Robot("ur5")
    rng = np.random.default_rng(3)
    whole = rng.uniform(-3, 3, (3, 15_000, 8)).astype(dtype)
    for view in (
        whole[..., 1:7],
        whole[:, ::-2, :6],
        whole.transpose(1, 0, 2)[..., ::-1][..., :6],
        whole.T[2:].T,
    ):
        wanted = robot.fk(np.ascontiguousarray(view), threads=1).tobytes()
        for threads in (None, 1, 2, 5):
            assert robot.fk(view, threads=threads).tobytes() == wanted


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_views_are_not_copied(dtype):
    robot = Robot("ur5")
    whole = np.zeros((100_000, 8), dtype=dtype)
    out = np.empty((50_000, 4, 4), dtype=dtype)
    view = whole[::2, 1:7]
    robot.fk(view[:3], out=out[:3])
    tracemalloc.start()
    try:
        robot.fk(view, out=out)
        assert tracemalloc.get_traced_memory()[1] < 10_000
        robot.fk(view.astype(">f8" if dtype == np.float64 else ">f4"), out=out)
        assert tracemalloc.get_traced_memory()[1] > view.nbytes
    finally:
        tracemalloc.stop()


def test_numbers_that_are_not_where_they_should_be_are_copied():
    q = np.random.default_rng(4).standard_normal((5, 6))
    robot = Robot("ur5")
    wanted = robot.fk(q)
    odd = np.zeros(q.nbytes + 1, dtype=np.uint8)[1:].view(np.float64).reshape(q.shape)
    odd[:] = q
    records = np.zeros(5, dtype=[("q", np.float64, 6), ("more", np.uint8, 3)])
    records["q"] = q
    assert not odd.flags.aligned
    assert records["q"].strides[0] % 8
    for view in (odd, odd[::-1], records["q"]):
        assert np.array_equal(robot.fk(view), robot.fk(np.array(view)))
        assert np.array_equal(robot.fk(view[0]), robot.fk(np.array(view[0])))
    assert np.array_equal(robot.fk(odd), wanted)


def test_views_without_numbers():
    robot = Robot("ur5")
    assert robot.fk(np.zeros((3, 0, 8))[::-1, :, 1:7]).shape == (3, 0, 4, 4)
    assert robot.fk(np.zeros((0, 8))[::-2, :6]).shape == (0, 4, 4)
