"""Jacobians of catalogue robots, computed by Pinocchio.

Builds the robots of make_fk.py, places them in random configurations with random joint velocities, and writes
jacobian.json beside this file: the geometric Jacobian of the tool at its own origin along the axes of the base, six
rows (linear first), and the acceleration of the tool without joint accelerations (J' q').

Run: python make_jacobian.py, in an environment with pin and numpy.
"""

import datetime
import json
from importlib.metadata import version

import numpy as np
import pinocchio as pin

from make_fk import CATALOGUE, HERE, Robot

ROBOTS = [
    "abb-irb120", "cylindrical-wrist", "fanuc-crx10ia-l", "franka-panda", "kinova-jaco", "kuka-iiwa-14", "oblique-6r",
    "parallelogram-5r", "prrrrp", "puma560", "rethink-sawyer", "scara", "smart5-six-rail", "stanford", "staubli-rx90",
    "ur3-lab", "ur5",
]
SEED = 20240301


def built(robot):
    """The model, the number of the tool's frame, and the matrix from joint variables to its joints."""
    se3 = lambda m: pin.SE3(m[:3, :3].copy(), m[:3, 3].copy())
    model, parent, pending, coupling = pin.Model(), 0, robot.base, []
    for i, row in enumerate(robot.rows):
        pending = pending @ row.before
        if row.kind != "F":
            joint = pin.JointModelRZ() if row.kind == "R" else pin.JointModelPZ()
            parent = model.addJoint(parent, joint, se3(pending), f"j{i}")
            pending = np.eye(4)
            coupling.append([float(row.joints.get(f"q{k + 1}", 0)) for k in range(robot.n)])
        pending = pending @ row.after
    tool = model.addFrame(pin.Frame("tool", parent, 0, se3(pending @ robot.tool), pin.FrameType.OP_FRAME))
    return model, tool, np.array(coupling)


def sample(robot, rng):
    model, tool, coupling = built(robot)
    data, axes = model.createData(), pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
    q, rates = np.array(robot.draw(rng)), rng.uniform(-1, 1, robot.n)
    pin.forwardKinematics(model, data, coupling @ q, coupling @ rates, np.zeros(model.nv))
    drift = pin.getFrameClassicalAcceleration(model, data, tool, axes).vector
    jacobian = pin.computeFrameJacobian(model, data, coupling @ q, tool, axes) @ coupling
    return {
        "q": q.tolist(), "rates": rates.tolist(),
        "jacobian": (jacobian + 0.0).tolist(), "drift": (drift + 0.0).tolist(),
    }


def main():
    rng = np.random.default_rng(SEED)
    provenance = {
        "pinocchio": version("pin"),
        "made_by": "crates/robot/tests/peers/make_jacobian.py",
        "date": datetime.date.today().isoformat(),
        "note": "tool at its origin, axes of the base, rows vx vy vz wx wy wz; drift is J' q'; SI units, radians",
    }
    lines = ["{", f'"provenance": {json.dumps(provenance)},', '"robots": {']
    for k, name in enumerate(ROBOTS):
        robot = Robot(CATALOGUE / f"{name}.toml")
        samples = ",\n".join(json.dumps(sample(robot, rng)) for _ in range(4))
        parameters = json.dumps(robot.parameters)
        end = "," if k + 1 < len(ROBOTS) else ""
        lines.append(f'"{name}": {{"parameters": {parameters}, "samples": [\n{samples}]}}{end}')
    (HERE / "jacobian.json").write_text("\n".join(lines) + "\n}\n}\n", encoding="utf-8")
    print(f"{len(ROBOTS)} robots")


if __name__ == "__main__":
    main()
