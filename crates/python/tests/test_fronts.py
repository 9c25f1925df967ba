"""The interfaces of other packages: EAIK's, ikpy's and LeRobot's."""

import numpy as np
import pytest

from conftest import URDF
from denavit import ChainError, FileError, Robot, ShapeError, UsageError
from denavit.eaik import DhRobot, HPRobot, IKRobot, UrdfRobot
from denavit.ikpy import Chain, OriginLink, URDFLink
from denavit.lerobot import RobotKinematics

HALF = np.pi / 2
UR5 = (
    [HALF, 0, 0, HALF, -HALF, 0],
    [0, -0.425, -0.39225, 0, 0, 0],
    [0.089159, 0, 0, 0.10915, 0.09465, 0.0823],
)
Q = np.array([0.3, -1.2, 1.5, 0.4, 0.9, -0.6])


def test_the_solutions_of_eaiks_tables():
    robot = DhRobot(*UR5)
    pose = robot.fwdKin(Q)
    found = robot.IK(pose)
    assert found.num_solutions() == 8 and not any(found.is_LS) and found.complete
    assert all(np.abs(robot.fwdKin(q) - pose).max() < 1e-9 for q in found.Q)
    assert robot.hasKnownDecomposition()
    many = robot.IK_batched([pose, robot.fwdKin(0.5 * Q)])
    assert [one.num_solutions() for one in many] == [8, 8]
    far = pose.copy()
    far[:3, 3] = [5.0, 0.0, 0.0]
    assert robot.IK(far).is_LS == [True] == robot.IK_batched([far])[0].is_LS
    with pytest.raises(ShapeError):
        DhRobot(UR5[0], UR5[1][:5], UR5[2])


def test_axes_and_offsets_are_the_arm_of_its_table():
    robot = Robot.from_dh(
        [("q1", 0.4, 0.1, HALF), ("q2", 0, 0.3, 0), ("q3", 0, 0.2, 0)], convention="standard"
    )
    frames = robot.frames(np.zeros(3))
    points = [frames[k][:3, 3] for k in range(3)]
    offsets = np.diff([np.zeros(3), *points, robot.fk(np.zeros(3))[:3, 3]], axis=0)
    same = HPRobot([frames[k][:3, 2] for k in range(3)], offsets)
    for q in ([0.2, -0.4, 0.9], [1.2, 0.3, -2.0]):
        # The orientation of the tip at rest is the base's.
        assert np.abs(same.fwdKin(q)[:3, 3] - robot.fk(q)[:3, 3]).max() < 1e-12


def test_joints_that_are_fixed():
    q = np.array([0.1, -0.6, 0.2, -1.9, 0.3, 1.5, 0.4])
    held = IKRobot(Robot("franka-panda"), [(6, 0.4)])
    found = held.IK(held.fwdKin(q))
    assert found.num_solutions() > 0
    assert all(abs(np.remainder(s[6] - 0.4 + np.pi, 2 * np.pi) - np.pi) < 1e-9 for s in found.Q)


FIVE = """<robot name="five">{links}
{joints}</robot>"""


@pytest.fixture
def five(tmp_path):
    """An arm with five joints and a gripper behind its hand."""
    names = ["base", "shoulder", "upper", "lower", "wrist", "hand_frame", "jaw"]
    axes = [(0, 0, 1), (0, 1, 0), (0, 1, 0), (0, 1, 0), (1, 0, 0), (0, 0, 1)]
    at = [(0, 0, 0.05), (0, 0, 0.06), (0.02, 0, 0.11), (0.13, 0, 0), (0.06, 0, 0), (0.02, 0, 0)]
    joints = [
        f'<joint name="j{k + 1}" type="revolute"><parent link="{names[k]}"/><child link="{names[k + 1]}"/>'
        f'<origin xyz="{" ".join(map(str, at[k]))}"/><axis xyz="{" ".join(map(str, axes[k]))}"/>'
        '<limit lower="-2" upper="2" effort="1" velocity="1"/></joint>'
        for k in range(6)
    ]
    file = tmp_path / "five.urdf"
    file.write_text(
        FIVE.format(links="".join(f'<link name="{n}"/>' for n in names), joints="\n".join(joints))
    )
    return file


def test_lerobots_arms(five):
    names = [f"j{k}" for k in range(1, 6)]
    arm = RobotKinematics(five, "hand_frame", names)
    q = np.array([20.0, -30.0, 40.0, 25.0, -60.0, 12.0])
    pose = arm.forward_kinematics(q)
    assert np.abs(pose - Robot.from_file(five, tip="hand_frame").fk(np.radians(q[:5]))).max() < 1e-14
    # A pose that the arm has: found, the gripper's value kept.
    found = arm.inverse_kinematics(q + 5.0, pose)
    assert np.abs(found[:5] - q[:5]).max() < 1e-6 and found[5] == q[5] + 5.0
    assert max(arm.residual) < 1e-8
    # One that it has not: the position is kept far better than the orientation, and both are told.
    turned = pose.copy()
    turned[:3, :3] = pose[:3, :3] @ np.array([[0.8, -0.6, 0], [0.6, 0.8, 0], [0, 0, 1]])
    near = arm.inverse_kinematics(q, turned)
    distance, angle = arm.residual
    assert 0.0 < distance < 0.02 and 0.1 < angle < 0.7
    there = arm.forward_kinematics(near)
    assert abs(np.linalg.norm(there[:3, 3] - turned[:3, 3]) - distance) < 1e-12

    def cost(x):
        p = arm.forward_kinematics(x)
        turn = turned[:3, :3] @ p[:3, :3].T
        angle = np.arccos(np.clip(0.5 * (np.trace(turn) - 1.0), -1.0, 1.0))
        return np.sum((turned[:3, 3] - p[:3, 3]) ** 2) + 0.01 * angle**2

    # Nothing near to it is better.
    best = cost(near)
    for k in range(5):
        for step in (-0.05, 0.05):
            moved = near.copy()
            moved[k] += step
            assert cost(moved) >= best - 1e-12
    # The position alone.
    arm.inverse_kinematics(q, turned, orientation_weight=0.0)
    assert arm.residual[0] < 1e-8


def test_lerobots_errors(five):
    with pytest.raises(UsageError, match="j5"):
        RobotKinematics(five, "hand_frame", ["j1", "j2", "j3", "j4"])
    with pytest.raises(ShapeError, match=r"\(5,\) is needed"):
        RobotKinematics(five, "hand_frame").forward_kinematics([0.0, 1.0])


def test_urdf_by_eaiks_name():
    arm = UrdfRobot(URDF / "double_pendulum.urdf")
    q = np.array([0.3, -0.5])
    assert any(np.abs(s - q).max() < 1e-9 for s in arm.IK(arm.fwdKin(q)).Q)


def beside(file, elements, mask=None, last=None):
    """Chains of the same file, here and there."""
    chain = pytest.importorskip("ikpy.chain")
    arguments = {"base_elements": list(elements), "active_links_mask": mask, "last_link_vector": last}
    there = chain.Chain.from_urdf_file(str(file), **arguments, symbolic=False)
    return Chain.from_urdf_file(file, **arguments, as_written=True), there


@pytest.mark.filterwarnings("ignore")
def test_ikpys_chains(five):
    last = [0.01, 0.02, 0.03]
    for file, elements, tip in [
        (URDF / "ur5_robot.urdf", ["base_link"], None),
        (URDF / "ur5_robot.urdf", ["shoulder_link", "shoulder_lift_joint"], last),
        (five, ["base", "j1", "shoulder"], last),
        (URDF / "double_pendulum.urdf", ["base_link"], None),
    ]:
        here, there = beside(file, elements, last=tip)
        assert [link.name for link in here.links][1:] == [
            "last_joint" if link.name == "last_joint" else link.name for link in there.links
        ][1:]
        assert [link.bounds for link in here.links] == [tuple(link.bounds) for link in there.links]
        random = np.random.default_rng(9)
        for _ in range(5):
            joints = random.uniform(-1, 1, len(here))
            assert np.abs(here.forward_kinematics(joints) - there.forward_kinematics(joints)).max() < 1e-12
            pairs = zip(
                here.forward_kinematics(joints, full_kinematics=True),
                there.forward_kinematics(joints, full_kinematics=True),
            )
            assert all(np.abs(a - b).max() < 1e-12 for a, b in pairs)


@pytest.mark.filterwarnings("ignore")
def test_ikpys_inverse_kinematics():
    here, there = beside(URDF / "ur5_robot.urdf", ["base_link"])
    moving = [k for k, link in enumerate(here.links) if link.joint_type != "fixed"]
    random = np.random.default_rng(10)
    for _ in range(4):
        joints = np.zeros(len(here))
        joints[moving] = random.uniform(-1.5, 1.5, len(moving))
        pose = here.forward_kinematics(joints)
        near = joints.copy()
        near[moving] += random.uniform(-0.1, 0.1, len(moving))
        whole = here.inverse_kinematics_frame(pose, initial_position=near, orientation_mode="all")
        assert np.abs(whole - joints).max() < 1e-9 and here.residual < 1e-9
        for arguments in (
            {"target_position": pose[:3, 3]},
            {"target_position": pose[:3, 3], "target_orientation": pose[:3, 0], "orientation_mode": "X"},
            {"target_orientation": pose[:3, 2], "orientation_mode": "Z"},
        ):
            found = here.inverse_kinematics(initial_position=near, **arguments)
            reached = there.forward_kinematics(found)
            assert here.residual < 1e-7
            if "target_position" in arguments:
                assert np.linalg.norm(reached[:3, 3] - pose[:3, 3]) < 1e-7
            other = there.inverse_kinematics(initial_position=near, **arguments)
            column = {"X": 0, "Z": 2}.get(arguments.get("orientation_mode"))
            if column is not None:
                assert np.abs(reached[:3, column] - pose[:3, column]).max() < 1e-7
                # What it finds is no worse than what ikpy finds.
                off = there.forward_kinematics(other)[:3, column] - pose[:3, column]
                assert here.residual <= np.linalg.norm(off) + 1e-7
    # What is not active stays.
    mask = [k in moving[:4] for k in range(len(here))]
    held, _ = beside(URDF / "ur5_robot.urdf", ["base_link"], mask)
    found = held.inverse_kinematics([0.3, 0.2, 0.4], initial_position=near)
    assert held.residual < 1e-7
    assert all(found[k] == near[k] for k in range(len(here)) if not mask[k])
    assert np.array_equal(held.active_to_full(held.active_from_full(found), near), found)


@pytest.mark.filterwarnings("ignore")
def test_chains_by_hand_are_ikpys():
    parts = [
        ("turn", [0.1, 0.0, 0.2], [0.0, 0.3, 0.0], {"rotation": [0, 0, 1], "bounds": (-2.0, 2.0)}),
        ("bend", [0.0, 0.1, 0.3], [1.5707, 0.0, 0.1], {"rotation": [0, 1, 0]}),
        (
            "slide",
            [0.2, 0.0, 0.0],
            [0.0, 0.0, 0.0],
            {"translation": [1, 0, 0], "joint_type": "prismatic", "bounds": (0.0, 0.5)},
        ),
        ("hand", [0.05, 0.0, 0.0], [0.0, 0.0, 0.7], {"joint_type": "fixed"}),
    ]
    here = Chain([OriginLink(), *(URDFLink(n, p, r, **more) for n, p, r, more in parts)], name="arm")
    joints = [0.0, 0.4, -0.7, 0.2, 0.0]
    pose = here.forward_kinematics(joints)
    found = here.inverse_kinematics(pose[:3, 3], initial_position=[0, 0.1, -0.2, 0.1, 0])
    assert here.residual < 1e-7 and 0.0 <= found[3] <= 0.5
    there = pytest.importorskip("ikpy.chain")
    link = pytest.importorskip("ikpy.link")
    made = [link.OriginLink()]
    for name, p, r, more in parts:
        made.append(link.URDFLink(name, np.array(p), np.array(r), use_symbolic_matrix=False, **more))
    other = there.Chain(made)
    assert np.abs(other.forward_kinematics(joints) - pose).max() < 1e-12


def test_what_ikpys_chains_refuse(five):
    with pytest.raises(ChainError, match="no link `base_link`"):
        Chain.from_urdf_file(five)
    with pytest.raises(ChainError, match="no joint `knee`"):
        Chain.from_urdf_file(five, ["base", "knee"])
    with pytest.raises(FileError, match="none.urdf"):
        Chain.from_urdf_file(five.with_name("none.urdf"))
    chain = Chain.from_urdf_file(five, ["base"])
    assert len(chain) == 7 and repr(chain).startswith("Kinematic chain")
    with pytest.raises(ShapeError, match=r"\(7,\) is needed"):
        chain.forward_kinematics([0.0] * 6)
    with pytest.raises(UsageError, match="neither"):
        chain.inverse_kinematics()
    with pytest.raises(UsageError, match="no orientation_mode `W`"):
        chain.inverse_kinematics([0, 0, 0], [0, 0, 1], "W")
    with pytest.raises(UsageError, match="has 2 entries; 7"):
        Chain.from_urdf_file(five, ["base"], active_links_mask=[True, False])
    # Out of reach: what comes nearest, and how far off that is.
    found = chain.inverse_kinematics([2.0, 0.0, 0.1])
    assert chain.residual > 1.0
    tip = chain.forward_kinematics(found)[:3, 3]
    assert abs(np.linalg.norm(tip - [2.0, 0.0, 0.1]) - chain.residual) < 1e-12
