"""The package `denavit` beside other packages, on a UR5: seconds, as one JSON object.

Everybody is held to the same poses before anything is timed, and those who solve poses to the same number of solutions. Peers that
are not installed are left out. The best of several rounds counts, everything on one core but where it is said.
"""

import json
import subprocess
import sys
import time
import warnings
from importlib import metadata

import numpy as np

from denavit import Robot

HALF = np.pi / 2
D = [0.089159, 0.0, 0.0, 0.10915, 0.09465, 0.0823]
A = [0.0, -0.425, -0.39225, 0.0, 0.0, 0.0]
ALPHA = [HALF, 0.0, 0.0, HALF, -HALF, 0.0]
ROWS = 1_000_000
POSES = 200
RANDOM = np.random.default_rng(0)


def best(work, times=5):
    """Seconds of the quickest round."""

    def once():
        start = time.perf_counter()
        work()
        return time.perf_counter() - start

    return min(once() for _ in range(times))


def each(work, items):
    """Seconds an item, one call each."""

    def loop():
        for item in items:
            work(item)

    return best(loop) / len(items)


def robotics_toolbox():
    import roboticstoolbox as rtb

    links = [rtb.RevoluteDH(d=d, a=a, alpha=alpha) for d, a, alpha in zip(D, A, ALPHA)]
    robot = rtb.DHRobot(links)
    return {"fk": lambda q: robot.fkine(q).A}


def pinocchio():
    import pinocchio as pin

    model, joint, placement = pin.Model(), 0, pin.SE3.Identity()
    for k in range(6):
        joint = model.addJoint(joint, pin.JointModelRZ(), placement, f"q{k + 1}")
        turn = np.array(
            [[1, 0, 0], [0, np.cos(ALPHA[k]), -np.sin(ALPHA[k])], [0, np.sin(ALPHA[k]), np.cos(ALPHA[k])]]
        )
        placement = pin.SE3(turn, np.array([A[k], 0.0, D[k]]))
    tool = model.addFrame(pin.Frame("tool", joint, placement, pin.FrameType.OP_FRAME))
    data = model.createData()

    def fk(q):
        pin.forwardKinematics(model, data, q)
        return pin.updateFramePlacement(model, data, tool).homogeneous

    return {"fk": fk}


def eaik():
    from eaik.IK_DH import DhRobot

    robot = DhRobot(np.array(ALPHA), np.array(A), np.array(D))
    return {
        "fk": robot.fwdKin,
        "ik": lambda pose: len(np.asarray(robot.IK(pose).Q)),
        "many": lambda poses: robot.IK_batched(poses, 1),
    }


def ssik():
    import ssik as package

    robot = package.Manipulator.from_dh(ALPHA, A, D)
    return {"fk": robot.fk, "ik": lambda pose: len(robot.solve(pose, respect_limits=False))}


def ikpy():
    from ikpy.chain import Chain
    from ikpy.link import OriginLink, URDFLink

    links, origin, turn = [OriginLink()], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]
    for k in range(6):
        links.append(URDFLink(f"q{k + 1}", origin, turn, rotation=[0, 0, 1], use_symbolic_matrix=False))
        origin, turn = [A[k], 0.0, D[k]], [ALPHA[k], 0.0, 0.0]
    links.append(URDFLink("tool", origin, turn, use_symbolic_matrix=False, joint_type="fixed"))
    chain = Chain(links)
    return {"fk": lambda q: chain.forward_kinematics([0.0, *q, 0.0])}


PEERS = {
    "Pinocchio": ("pin", pinocchio),
    "Robotics Toolbox": ("roboticstoolbox-python", robotics_toolbox),
    "EAIK": ("EAIK", eaik),
    "ssik": ("ssik", ssik),
    "ikpy": ("ikpy", ikpy),
}


def own():
    """What the package takes."""
    robot = Robot("ur5")
    many = RANDOM.uniform(-3, 3, (ROWS, 6))
    out = np.empty((ROWS, 4, 4))
    compiled, branches = robot.compile("fk"), robot.compile("ik")
    singles = list(many[:2000])
    goals = robot.fk(many[:10_000])
    code = "import numpy, time; t = time.perf_counter(); import denavit; print(time.perf_counter() - t)"
    imports = [float(subprocess.check_output([sys.executable, "-c", code])) for _ in range(7)]
    return {
        "fk_single": each(robot.fk, singles),
        "fk_list": each(robot.fk, [q.tolist() for q in singles]),
        "fk_compiled": each(compiled, singles),
        "fk": best(lambda: robot.fk(many, out=out)) / ROWS,
        "fk_one_core": best(lambda: robot.fk(many, out=out, threads=1)) / ROWS,
        "ik_single": each(robot.ik, list(goals[:500])),
        "ik_one_core": best(lambda: robot.ik_batch(goals, threads=1), 3) / len(goals),
        "branches_one_core": best(lambda: branches(goals, threads=1)) / len(goals),
        "import": min(imports),
    }


def peers():
    """What others take for a pose, and for all solutions of one."""
    robot = Robot("ur5")
    rows = list(RANDOM.uniform(-3, 3, (POSES, 6)))
    goals = [robot.fk(q) for q in rows]
    counts = [len(robot.ik(goal)) for goal in goals]
    found = {}
    for name, (package, make) in PEERS.items():
        try:
            peer = make()
        except ImportError:
            continue
        for q, goal in zip(rows, goals):
            off = np.abs(np.asarray(peer["fk"](q)) - goal).max()
            assert off < 1e-9, (name, off)
        one = {"version": metadata.version(package), "fk_single": each(peer["fk"], rows)}
        if "ik" in peer:
            own = [peer["ik"](goal) for goal in goals]
            one["same_counts"] = sum(a == b for a, b in zip(own, counts)) / len(counts)
            one["ik_single"] = each(peer["ik"], goals)
        if "many" in peer:
            one["ik_many"] = best(lambda peer=peer: peer["many"](goals)) / len(goals)
        found[name] = one
    return found


if __name__ == "__main__":
    warnings.simplefilter("ignore")
    print(json.dumps({"denavit": own(), "peers": peers(), "numpy": np.__version__}))
