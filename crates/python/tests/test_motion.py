"""Motions: those of the command line, within their limits, along their paths."""

import json
import pickle
import re

import numpy as np
import pytest

from conftest import URDF
from denavit import MotionError, NoMassesError, Robot, ShapeError, UsageError

Q = np.array([0.3, -1.2, 1.5, 0.4, 0.9, -0.6])
UR5 = Robot("ur5")


def written(q):
    return ",".join(map(str, np.asarray(q).tolist()))


def same(motion, printed, within=1e-12):
    """Whether it is what the command line prints."""
    samples = printed["samples"]
    assert len(samples) == len(motion)
    for mine, name in (
        (motion.q, "q"),
        (motion.qd, "velocity"),
        (motion.qdd, "acceleration"),
        (motion.t, "t"),
    ):
        assert np.abs(mine - np.array([s[name] for s in samples])).max() <= within
    assert np.abs(motion.poses - np.array([s["pose"] for s in samples])).max() <= within
    assert motion.duration == printed["duration"] and motion.timing == printed["timing"]
    assert motion.course == printed["path"] and motion.reached == printed.get("reached", 1.0)
    assert [e.kind for e in motion.events] == [e["kind"] for e in printed.get("events", [])]


def test_motions_are_those_of_the_command_line(cli):
    there = np.zeros(6)
    motion = UR5.path(
        [Q, there], velocity=1.0, acceleration=[2.0] * 6, law="jerk-limited", jerk=10.0, dt=0.05
    )
    words = [
        "--velocity",
        "1",
        "--acceleration",
        "2",
        "--jerk",
        "10",
        "--law",
        "jerk-limited",
        "--dt",
        "0.05",
    ]
    same(
        motion, json.loads(cli("path", "ur5", "-q", written(Q), "--joint", written(there), *words, "--json"))
    )
    motion = UR5.path([Q, 0.5 * Q, there], velocity=1.0, acceleration=2.0, blend=0.1)
    words = ["--joint", written(0.5 * Q), "--joint", written(there), "--velocity", "1", "--acceleration", "2"]
    same(motion, json.loads(cli("path", "ur5", "-q", written(Q), *words, "--blend", "0.1", "--json")))
    goal = UR5.fk(Q)
    goal[:3, 3] += [0.1, 0.0, 0.05]
    motion = UR5.follow(goal, start=Q, alternatives=True)
    printed = json.loads(
        cli("path", "ur5", "-q", written(Q), "--line", json.dumps(goal.tolist()), "--alternatives", "--json")
    )
    same(motion, printed, 1e-9)
    assert [(s.branch, s.reached, s.singular) for s in motion.starts] == [
        (s["branch"], s["reached"], s["singular"]) for s in printed["starts"]
    ]
    via = goal[:3, 3] + [0.0, 0.05, 0.0]
    end = goal.copy()
    end[:3, 3] += [0.0, 0.08, 0.02]
    motion = UR5.follow([goal, end], start=Q, along=["screw", via], duration=4.0)
    alone = UR5.follow([goal, end], along=via, duration=4.0)
    assert alone.course == UR5.follow([goal, end], along=[via], duration=4.0).course
    assert motion.ok and motion.course == "1 line, 1 arc" and motion.duration == 4.0
    assert np.abs(motion.poses[-1] - end).max() < 1e-5
    # It goes through the point.
    assert np.abs(motion.at(np.linspace(0, 4, 4000)).q[:, None] - motion.q[0]).min() < 1e-9
    places = UR5.fk(motion.at(np.linspace(0.0, 4.0, 4000)).q)[:, :3, 3]
    assert np.linalg.norm(places - via, axis=1).min() < 1e-3


def test_a_motion_keeps_its_limits_and_its_derivatives():
    velocity, acceleration, jerk = 1.0, 2.0, 20.0
    motion = UR5.path([Q, 0.5 * Q, -Q], velocity=velocity, acceleration=acceleration, jerk=jerk)
    t = np.linspace(0.0, motion.duration, 2001)
    state = motion.at(t)
    assert state.q.shape == (2001, 6)
    assert np.abs(state.qd).max() <= velocity * (1 + 1e-6)
    assert np.abs(state.qdd).max() <= acceleration * (1 + 1e-6)
    slope = np.gradient(state.q, t, axis=0)
    assert np.abs(slope - state.qd)[2:-2].max() < 1e-3
    assert np.abs(np.gradient(state.qd, t, axis=0) - state.qdd)[2:-2].max() < 5e-2
    assert np.array_equal(state.q[0], Q) and np.allclose(state.q[-1], -Q, atol=1e-12)
    # At rest before and behind.
    outside = motion.at([[-1.0, motion.duration + 1.0]])
    assert outside.q.shape == (1, 2, 6) and not outside.qd.any()
    assert np.array_equal(motion.at(motion.t[3]).q, motion.q[3])
    assert motion.deviation is None and motion.events == [] and motion.ok


def test_torques_are_kept():
    robot = Robot.from_toml(re.sub(r"limits = .*\n", "", Robot.from_file(URDF / "double_pendulum.urdf").toml))
    points = [[0.0, 0.0], [1.0, -0.5], [0.5, 0.8]]
    free = robot.path(points, velocity=3.0, acceleration=50.0)
    most = np.abs(robot.torque(free.q, free.qd, free.qdd)).max()
    bound = 0.8 * most
    held = robot.path(points, velocity=3.0, torque=bound)
    assert np.abs(robot.torque(held.q, held.qd, held.qdd)).max() <= bound * 1.01
    with pytest.raises(NoMassesError):
        UR5.path([Q, -Q], torque=5.0)


def test_paths_that_end_say_why():
    far = UR5.fk(Q)
    far[:3, 3] += [2.0, 0.0, 0.0]
    motion = UR5.follow([UR5.fk(Q), far], start=Q)
    assert not motion.ok and 0.0 < motion.reached < 1.0
    assert (
        motion.events[-1].kind == "end"
        and motion.events[-1].words
        and "cannot be followed beyond" in motion.verdict
    )
    assert motion.events[-1].q.shape == (6,)
    with pytest.raises(MotionError, match="out of reach"):
        UR5.follow([far, UR5.fk(Q)])


def test_splines_through_poses():
    poses = UR5.fk([Q, Q + 0.1, Q + [0.2, 0.1, 0.0, 0.1, 0.2, 0.0]])
    motion = UR5.follow(poses, start=Q, along="spline", max_deviation=1e-4)
    assert motion.ok and motion.deviation.distance <= 1e-4
    places = motion.at(np.linspace(0, motion.duration, 3001)).q
    assert np.abs(UR5.fk(places) - poses[1]).max(axis=(1, 2)).min() < 1e-2
    assert np.abs(motion.poses[-1] - poses[-1]).max() < 1e-5


def test_what_does_not_go_together():
    for arguments, error, what in [
        ({"law": "square"}, UsageError, "no law `square`"),
        ({"law": "cubic", "acceleration": 1.0, "jerk": 5.0}, UsageError, "law: "),
        ({"velocity": [1.0, 2.0]}, ShapeError, r"velocity has the shape \(2,\)"),
        ({"velocity": -1.0}, UsageError, "velocity holds -1.0: positive"),
        ({"duration": -1.0}, UsageError, "duration"),
        ({"duration": 1e-3, "velocity": 1.0}, MotionError, "duration: "),
        ({"dt": 0.0}, UsageError, "dt: "),
    ]:
        with pytest.raises(error, match=what):
            UR5.path([Q, -Q], **arguments)
    for points in ([Q], Q, [Q[:5], Q[:5]]):
        with pytest.raises(ShapeError, match="points has the shape"):
            UR5.path(points)
    pose = UR5.fk(Q)
    for arguments, error, what in [
        ({"along": "loop"}, UsageError, "no piece `loop`"),
        ({"along": ["line", "line"]}, ShapeError, "along has 2 entries for 1 pieces"),
        ({"along": [[0.0, 1.0]]}, ShapeError, r"a point of an arc has the shape \(2,\)"),
        ({"along": [pose[:3, 3]]}, UsageError, "along 1: "),
        ({"start": [0.0]}, UsageError, "start"),
    ]:
        there = pose.copy()
        there[2, 3] += 0.1
        with pytest.raises(error, match=what):
            UR5.follow([pose, there], **arguments)
    with pytest.raises(UsageError, match="two poses"):
        UR5.follow([pose])


def test_a_motion_can_be_pickled():
    robot = Robot("ur5")
    q = np.array([0.3, -1.2, 1.5, 0.4, 0.9, -0.6])
    pose = robot.fk(q)
    there = pose.copy()
    there[2, 3] += 0.1
    for motion in (
        robot.path([q, q + 0.5], velocity=1.0, acceleration=2.0),
        robot.follow([pose, there], start=q, duration=2.0),
    ):
        copied = pickle.loads(pickle.dumps(motion))
        assert np.array_equal(copied.q, motion.q) and repr(copied) == repr(motion)
        assert np.array_equal(copied.at([0.1, 0.7]).qd, motion.at([0.1, 0.7]).qd)
