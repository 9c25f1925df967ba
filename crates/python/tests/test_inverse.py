"""Inverse kinematics: counts of peers, ways to write a pose, what an answer holds."""

import numpy as np
import pytest

from conftest import peers
from denavit import PoseError, Robot, ShapeError, UsageError

Q = np.array([0.3, -1.2, 1.5, 0.4, 0.9, -0.6])

# One arm of each way to solve: spherical wrists, parallel axes, elimination, fewer than six joints.
ARMS = ["ur5", "puma560", "staubli-rx90", "kuka-kr6-r900-2", "fanuc-crx10ia-l", "scara", "stanford"]


@pytest.mark.parametrize("name", ARMS)
def test_solutions_are_those_of_peers(name):
    one = next(
        (o for o in peers("ik.json")["robots"].values() if o["robot"] == name and not o["given"]), None
    )
    if one is None:
        pytest.skip("no peer solves it")
    robot = Robot(name)
    known = {k: v for k, v in one["parameters"].items() if k in robot.parameters}
    robot = robot.set(**known) if known else robot
    cases = one["cases"][:5]
    poses = [case["pose"] if "pose" in case else robot.fk(case["q"]) for case in cases]
    answers = robot.ik_batch(np.array(poses))
    for case, pose, answer in zip(cases, poses, answers):
        assert len(answer) == case["count"] or "counts" in case, (name, case["q"])
        assert np.abs(robot.fk(answer.solutions) - np.array(pose)).max() < 1e-8
        single = robot.ik(pose)
        assert np.array_equal(single.solutions, answer.solutions)
        assert single.complete == answer.complete and single.branches == answer.branches
        assert (single.residuals < 1e-8).all()


def test_poses_as_people_have_them():
    spatial = pytest.importorskip("scipy.spatial.transform")
    robot = Robot("ur5")
    pose = robot.fk(Q)
    wanted = robot.ik(pose).solutions
    rotation = spatial.Rotation.from_matrix(pose[:3, :3])
    p = pose[:3, 3]

    class SE3:
        A = pose

    for given in (
        pose.tolist(),
        np.asfortranarray(pose),
        (p, rotation.as_quat()),
        (p, 2.0 * rotation.as_quat()),
        (p.tolist(), pose[:3, :3]),
        (p, rotation),
        SE3(),
    ):
        assert np.allclose(robot.ik(given).solutions, wanted, atol=1e-9)
    many = robot.fk(np.stack([Q, 0.9 * Q, 1.1 * Q]))
    pairs = (many[:, :3, 3], spatial.Rotation.from_matrix(many[:, :3, :3]))
    assert np.array_equal(robot.ik_batch(pairs).counts, robot.ik_batch(many).counts)


def test_what_is_no_pose_is_refused():
    robot = Robot("ur5")
    for given, shape in [(np.eye(3), r"\(3, 3\)"), (np.zeros(16), r"\(16,\)")]:
        with pytest.raises(ShapeError, match=rf"pose has the shape {shape}; \(..., 4, 4\)"):
            robot.ik(given)
    with pytest.raises(ShapeError, match="ik_batch takes many|`ik_batch` takes many"):
        robot.ik(np.stack([np.eye(4)] * 2))
    for wrong in (np.diag([1.0, 1.0, -1.0, 1.0]), 2 * np.eye(4), np.full((4, 4), np.nan)):
        with pytest.raises(PoseError):
            robot.ik(wrong)
    with pytest.raises(PoseError, match="pose 1: "):
        robot.ik_batch(np.stack([np.eye(4), 2 * np.eye(4)]))
    with pytest.raises(PoseError, match="quaternion"):
        robot.ik(([0, 0, 0], [0, 0, 0, 0]))
    with pytest.raises(ShapeError, match="near has 2 values; 6 are needed"):
        robot.ik(robot.fk(Q), near=[0.0, 0.0])
    with pytest.raises(UsageError, match="no goal"):
        robot.ik(robot.fk(Q), goal="dance")


def test_an_answer_says_what_it_is():
    robot = Robot("ur5")
    far = np.eye(4)
    far[:3, 3] = [3.0, 0.0, 0.0]
    answer = robot.ik(far)
    assert (answer.status, len(answer), bool(answer), answer.complete) == ("unreachable", 0, False, True)
    assert answer.solutions.shape == (0, 6)
    assert answer.obstacle is not None and answer.obstacle.distance > 1.0
    assert "not found" not in repr(answer) and "unreachable" in repr(answer)

    singular = Robot("staubli-rx90")
    q = np.radians([10, 20, 30, 40, 0, 60])
    answer = singular.ik(singular.fk(q))
    assert len(answer.families) == 2
    family = answer.families[0]
    assert family.dimension == 1 and family.free == ["q4"] and family.affine
    moved = family.q + 0.3 * family.direction
    assert np.allclose(singular.fk(moved), singular.fk(q), atol=1e-9)

    one = robot.ik(robot.fk(Q), one=True, near=Q)
    assert one.solutions.shape == (1, 6) and not one.complete and one.doubt
    assert np.allclose(one.solutions[0], Q, atol=1e-9)


def test_limits_and_turns():
    robot = Robot.from_dh(
        [
            {"theta": "q1", "a": 1, "limits": ["-90 deg", "90 deg"]},
            {"theta": "q2", "a": 1, "limits": ["0 deg", "170 deg"]},
        ],
        convention="standard",
    )
    pose = robot.fk([0.3, 0.5])
    everything, allowed = robot.ik(pose, goal="position"), robot.ik(pose, goal="position", limits=True)
    assert (len(everything), len(allowed)) == (2, 1)
    assert allowed.within_limits.all()
    assert np.allclose(allowed.solutions, [[0.3, 0.5]])
    assert (everything.left_out, allowed.left_out) == (0, 1)
    # Solutions that the limits exclude are no proof that there is none.
    outside = robot.ik(robot.fk([2.5, 0.0]), goal="position", limits=True)
    assert (len(outside), outside.left_out, outside.status) == (0, 1, "outside the limits")
    both = robot.ik_batch(robot.fk([[0.3, 0.5], [2.5, 0.0]]), goal="position", limits=True)
    assert both.status == ["solved", "outside the limits"] and both.left_out == [1, 1]
    assert both[1].status == "outside the limits"
    ur5 = Robot("ur5")
    near = Q + np.array([2 * np.pi, 0, 0, 0, 0, 0]) * 0.9
    nearest = ur5.ik(ur5.fk(Q), near=near).nearest
    assert np.allclose(ur5.fk(nearest), ur5.fk(Q), atol=1e-9)


def test_redundant_arms():
    robot = Robot("kuka-iiwa-14")
    q = np.array([0.1, 0.5, -0.3, -1.2, 0.4, 0.8, 0.2])
    answer = robot.ik(robot.fk(q), given={"q3": q[2]})
    assert answer.given == (("q3", q[2]),)
    assert any(np.allclose(s, q, atol=1e-8) for s in answer)
    assert np.array_equal(robot.ik(robot.fk(q), given={3: q[2]}).solutions, answer.solutions)
    with pytest.raises(UsageError, match="no joint"):
        robot.ik(robot.fk(q), given={"elbow": 0.0})
    motion = robot.ik(robot.fk(q), near=q)
    assert motion.method == "self-motion" and motion.families
    assert np.allclose(robot.fk(motion.nearest), robot.fk(q), atol=1e-6)
    for member in motion.families[0].curve[::20]:
        assert np.allclose(robot.fk(member), robot.fk(q), atol=1e-6)


def test_batches_of_any_shape():
    robot = Robot("ur5")
    q = np.random.default_rng(3).uniform(-2, 2, (2, 3, 6))
    answers = robot.ik_batch(robot.fk(q))
    assert answers.counts.shape == (2, 3) == answers.complete.shape
    assert answers.offsets[-1] == len(answers.solutions) == answers.counts.sum()
    assert len(answers) == 6 and len(list(answers)) == 6
    assert np.array_equal(answers[-1].solutions, robot.ik(robot.fk(q[1, 2])).solutions)
    assert len(answers[1:3]) == 2
    with pytest.raises(IndexError):
        answers[6]
    empty = robot.ik_batch(np.empty((0, 4, 4)))
    assert len(empty) == 0 and empty.solutions.shape == (0, 6)
    again = robot.ik_batch(robot.fk(q), threads=1)
    assert np.array_equal(again.solutions, answers.solutions)


def test_points_will_do_for_positions():
    robot = Robot("articulated-3r")
    poses = robot.fk([[0.1, 0.2, 0.3], [0.4, -0.3, 0.8], [1.0, 0.1, -0.4], [0.2, 0.3, 0.9]]).reshape(
        2, 2, 4, 4
    )
    by_points = robot.ik_batch(poses[..., :3, 3], goal="position")
    assert np.array_equal(by_points.solutions, robot.ik_batch(poses, goal="position").solutions)
    one = robot.ik(poses[1, 0][:3, 3], goal="position")
    assert np.array_equal(by_points[1, 0].solutions, one.solutions) and len(one) == 4
    with pytest.raises(IndexError, match="2 indices"):
        by_points[1, 0, 0]
    with pytest.raises(ShapeError):
        robot.ik(poses[1, 0][:3, 3])


def test_numbers_that_are_no_counts():
    robot = Robot("ur5")
    for threads in (0, -1):
        with pytest.raises(UsageError, match="threads"):
            robot.fk(np.zeros((4, 6)), threads=threads)
    with pytest.raises(UsageError, match="seed"):
        robot.exercise("fk", seed=-1)
