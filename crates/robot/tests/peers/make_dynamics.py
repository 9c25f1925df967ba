"""Torques, inertia matrices, accelerations, energies and regressors, computed by Pinocchio.

Writes dynamics.json beside this file. Two kinds of robots:
- catalogue: arms of ../../catalogue, each row that moves with a random body about the origin of the row's frame (M, MX MY MZ,
  XX XY XZ YY YZ ZZ as Khalil and Dombre have them), a rotor and a random direction of gravity; joints that stand in several rows
  or are added in one are one Pinocchio joint a row, and tau = G^T tau_rows.
- urdf: files of ../urdf with their own inertias; joints that are not on the way to the tip are locked at 0.
For each: tau (rnea), A (crba), h = C qd + Q, Q, qdd of a torque (aba), T, V; for some the regressor times nothing: W itself,
its columns in the order XX XY XZ YY YZ ZZ MX MY MZ M.

Run: python make_dynamics.py, in an environment with pin and numpy.
"""

import datetime
import json
import math
import pathlib
from importlib.metadata import version

import numpy as np
import pinocchio as pin

from make_fk import CATALOGUE, Robot

HERE = pathlib.Path(__file__).resolve().parent
SEED = 2021
ARMS = [
    "planar-2r", "planar-3r", "scara", "articulated-3r", "staubli-rx90", "puma560", "puma560-craig", "stanford", "ur5", "ur10e",
    "franka-panda", "smart5-six-rail", "oblique-6r", "cartesian-ppp", "cylindrical-rpp", "spherical-rrp", "kinova-gen3",
    "kuka-iiwa-14", "prrrrp", "parallelogram-5r", "ur3-lab", "comau-smart-six", "rail-puma", "anthropomorphic-8r", "abb-irb140",
    "kuka-kr5-arc", "techman-tm5-700", "kinova-jaco",
]
FILES = [
    ("panda", "panda_hand"), ("ur3_robot", "tool0"), ("ur5_robot", "tool0"), ("ur10_robot", "tool0"), ("kinova", "j2s6s200_end_effector"),
    ("xarm7", None), ("z1", None), ("so100", None), ("so101", None), ("double_pendulum", None), ("ur5_gripper", "tool0"),
    ("finger_edu", None),
]
WITH_REGRESSOR = {"planar-3r", "scara", "stanford", "parallelogram-5r"}


def random_body(rng):
    """Mass, centre and a positive inertia about it, as ten numbers about the origin."""
    mass, centre = rng.uniform(0.5, 5), rng.uniform(-0.2, 0.2, 3)
    root = rng.uniform(-0.15, 0.15, (3, 3))
    second = mass * (root @ root.T + np.outer(centre, centre))
    inertia = np.trace(second) * np.eye(3) - second
    xx, xy, xz, yy, yz, zz = (inertia[i, j] for i, j in [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)])
    return [float(x) for x in [xx, xy, xz, yy, yz, zz, *(mass * centre), mass]]


def pinocchio_body(ten):
    xx, xy, xz, yy, yz, zz, mx, my, mz, mass = ten
    about = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    centre = np.array([mx, my, mz]) / mass
    at_centre = about - mass * (centre @ centre * np.eye(3) - np.outer(centre, centre))
    return pin.Inertia(mass, centre, at_centre)


def se3(m):
    return pin.SE3(m[:3, :3].copy(), m[:3, 3].copy())


def of_rows(robot, rng, given=None):
    """The model with one joint a row that moves, the matrix G, and the bodies: those given, or random ones."""
    model, parent, pending, g, bodies = pin.Model(), 0, robot.base, [], []
    for i, row in enumerate(robot.rows):
        pending = pending @ row.before
        if row.kind != "F":
            joint = pin.JointModelRZ() if row.kind == "R" else pin.JointModelPZ()
            parent = model.addJoint(parent, joint, se3(pending), f"j{i}")
            pending = np.eye(4)
            g.append([float(row.joints.get(f"q{k + 1}", 0)) for k in range(robot.n)])
        pending = pending @ row.after
        body = None if row.kind == "F" else given[i] if given else random_body(rng)
        bodies.append(body)
        if body:
            model.appendBodyToJoint(parent, pinocchio_body(body), se3(pending))
    return model, np.array(g), bodies


def lists(x):
    return [lists(v) for v in x] if getattr(x, "ndim", 0) else float(x) + 0.0


def answers(model, g, q, qd, qdd, rotors, with_regressor=False):
    """Everything at a state of the joints; `q` are the model's own values."""
    data, n = model.createData(), g.shape[1]
    v, a = g @ qd, g @ qdd
    matrix = pin.crba(model, data, q)
    matrix = np.triu(matrix) + np.triu(matrix, 1).T
    inertia = g.T @ matrix @ g + np.diag(rotors)
    tau = g.T @ pin.rnea(model, data, q, v, a) + rotors * qdd
    h = g.T @ pin.rnea(model, data, q, v, np.zeros(model.nv))
    gravity = g.T @ pin.computeGeneralizedGravity(model, data, q)
    # An acceleration for torques of another state: by aba where each joint is a row's, else by the matrix.
    pulled = tau + np.linspace(-1, 1, n)
    if n == model.nv and not rotors.any():
        direct = pin.aba(model, data, q, v, np.linalg.solve(g.T, pulled))
        direct = np.linalg.solve(g, direct)
    else:
        direct = np.linalg.solve(inertia, pulled - h)
    pin.computeAllTerms(model, data, q, v)
    kinetic = pin.computeKineticEnergy(model, data, q, v) + 0.5 * rotors @ (qd * qd)
    found = {
        "qd": qd, "qdd": qdd, "tau": tau, "A": inertia, "h": h, "Q": gravity, "pulled": pulled, "direct": direct, "T": kinetic,
        "V": pin.computePotentialEnergy(model, data, q),
    }
    if with_regressor:
        w = g.T @ pin.computeJointTorqueRegressor(model, data, q, v, a)
        # Pinocchio's order is M MX MY MZ XX XY YY XZ YZ ZZ.
        order = [4, 5, 7, 6, 8, 9, 1, 2, 3, 0]
        found["W"] = np.hstack([w[:, 10 * k:10 * k + 10][:, order] for k in range(model.nv)])
    return {key: lists(np.asarray(value)) for key, value in found.items()}


def catalogue(rng):
    robots = []
    for name in ARMS:
        robot = Robot(CATALOGUE / f"{name}.toml")
        model, g, bodies = of_rows(robot, rng)
        direction = rng.normal(size=3)
        gravity = 9.81 * direction / np.linalg.norm(direction)
        model.gravity = pin.Motion(gravity, np.zeros(3))
        rotors = rng.uniform(0.01, 0.1, robot.n) if name in ("staubli-rx90", "parallelogram-5r") else np.zeros(robot.n)
        samples = []
        for _ in range(2):
            q = np.array(robot.draw(rng))
            values = np.array([row.value(robot.named(q)) for row in robot.rows if row.kind != "F"])
            qd, qdd = rng.uniform(-2, 2, robot.n), rng.uniform(-3, 3, robot.n)
            samples.append({"q": lists(q)} | answers(model, g, values, qd, qdd, rotors, name in WITH_REGRESSOR))
        robots.append({
            "name": name, "parameters": robot.parameters, "bodies": bodies, "gravity": lists(gravity), "rotors": lists(rotors),
            "samples": samples,
        })
    return robots


def urdf(rng):
    robots = []
    for name, tip in FILES:
        model = pin.buildModelFromXML((HERE.parent / "urdf" / f"{name}.urdf").read_text(encoding="utf-8"))
        neutral = pin.neutral(model)
        if tip is None:
            joints = list(range(1, model.njoints))
        else:
            joint, joints = model.frames[model.getFrameId(tip)].parentJoint, []
            while joint:
                joints.insert(0, joint)
                joint = model.parents[joint]
        locked = [j for j in range(1, model.njoints) if j not in joints]
        model = pin.buildReducedModel(model, locked, neutral) if locked else model
        samples = []
        for _ in range(2):
            values, q = [], []
            for j in range(1, model.njoints):
                x = float(rng.uniform(-1.5, 1.5))
                q.append(x)
                values += [math.cos(x), math.sin(x)] if model.joints[j].nq == 2 else [x]
            n = model.nv
            qd, qdd = rng.uniform(-2, 2, n), rng.uniform(-3, 3, n)
            samples.append({"q": q} | answers(model, np.eye(n), np.array(values), qd, qdd, np.zeros(n)))
        robots.append({"name": name, "tip": tip, "joints": list(model.names)[1:], "samples": samples})
    return robots


def main():
    rng = np.random.default_rng(SEED)
    provenance = {
        "pinocchio": version("pin"),
        "made_by": "crates/robot/tests/peers/make_dynamics.py",
        "date": datetime.date.today().isoformat(),
        "note": "SI units, radians; bodies are ten numbers about the origin of their row's frame",
    }
    arms, files = catalogue(rng), urdf(rng)
    block = lambda robots: ",\n".join(json.dumps(r) for r in robots)
    text = f'{{\n"provenance": {json.dumps(provenance)},\n"catalogue": [\n{block(arms)}\n],\n"urdf": [\n{block(files)}\n]\n}}\n'
    (HERE / "dynamics.json").write_text(text, encoding="utf-8")
    print(f"{len(arms)} arms, {len(files)} files")


if __name__ == "__main__":
    main()
