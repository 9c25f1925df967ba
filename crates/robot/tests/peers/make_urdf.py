"""Poses of all links of public URDF files, computed by Pinocchio.

Takes the files named below out of the package example-robot-data (PyPI), leaves out what says nothing of kinematics (looks,
collisions, drives; no digit is changed), writes them to ../urdf and, beside this file, urdf.json: at three configurations the
pose of each link in the root, rows of the 3x4 matrix. Joints that mimic others follow them.

Run: python make_urdf.py, in an environment with pin and example-robot-data.
"""

import datetime
import json
import math
import pathlib
import random
import sys
import xml.etree.ElementTree as ET
from importlib.metadata import version

import numpy as np
import pinocchio as pin

HERE = pathlib.Path(__file__).resolve().parent
OUT = HERE.parent / "urdf"
ROBOTS = pathlib.Path(pin.__file__).parents[4] / "share/example-robot-data/robots"
SEED = 20
FILES = [
    "panda_description/urdf/panda.urdf",
    "ur_description/urdf/ur3_robot.urdf",
    "ur_description/urdf/ur5_robot.urdf",
    "ur_description/urdf/ur10_robot.urdf",
    "ur_description/urdf/ur5_gripper.urdf",
    "ur_description/urdf/ur3_joint_limited_robot.urdf",
    "kinova_description/robots/kinova.urdf",
    "xarm_description/urdf/xarm7.urdf",
    "so_arm_description/urdf/so100.urdf",
    "so_arm_description/urdf/so101.urdf",
    "z1_description/urdf/z1.urdf",
    "baxter_description/urdf/baxter.urdf",
    "pr2_description/urdf/pr2.urdf",
    "allegro_hand_description/urdf/allegro_right_hand.urdf",
    "allegro_hand_description/urdf/allegro_left_hand.urdf",
    "anymal_c_simple_description/urdf/anymal.urdf",
    "anymal_b_simple_description/robots/anymal-kinova.urdf",
    "asr_twodof_description/urdf/TwoDofs.urdf",
    "double_pendulum_description/urdf/double_pendulum.urdf",
    "double_pendulum_description/urdf/double_pendulum_continuous.urdf",
    "finger_edu_description/robots/finger_edu.urdf",
    "bolt_description/robots/bolt.urdf",
    "solo_description/robots/solo12.urdf",
    "b1_description/urdf/b1-z1.urdf",
    "laikago_description/urdf/laikago.urdf",
]
KEPT = {
    "robot": ["link", "joint"],
    "link": ["inertial"],
    "joint": ["origin", "parent", "child", "axis", "limit", "mimic", "safety_controller"],
}


def stripped(element):
    """The element without what says nothing of kinematics."""
    for child in list(element):
        if element.tag in KEPT and child.tag not in KEPT[element.tag]:
            element.remove(child)
        else:
            stripped(child)
    element.text = element.tail = None


def name_of(path):
    """ur_description/urdf/ur5_robot.urdf: ur5_robot; TwoDofs: twodofs; two anymal files keep their folders' letters."""
    name = pathlib.Path(path).stem.lower().replace("-", "_")
    return f"{name}_{path.split('_')[1]}" if name == "anymal" else name


def poses(text):
    """Values of the joints, and the poses of the links."""
    model = pin.buildModelFromXML(text, mimic=True)
    data = model.createData()
    samples = []
    for k in range(3):
        q, values = pin.neutral(model), {}
        for j in range(1, model.njoints):
            joint = model.joints[j]
            if "Mimic" in joint.shortname() or joint.nq not in (1, 2):
                continue
            value = random.uniform(-1.5, 1.5) if k else 0.0
            q[joint.idx_q : joint.idx_q + joint.nq] = [value] if joint.nq == 1 else [math.cos(value), math.sin(value)]
            values[model.names[j]] = value
        pin.forwardKinematics(model, data, q)
        pin.updateFramePlacements(model, data)
        links = {
            frame.name: np.round(data.oMf[i].homogeneous[:3], 17).ravel().tolist()
            for i, frame in enumerate(model.frames)
            if frame.type == pin.FrameType.BODY
        }
        samples.append({"joints": values, "links": links})
    return samples


def main():
    random.seed(SEED)
    OUT.mkdir(exist_ok=True)
    files = []
    for path in FILES:
        tree = ET.parse(ROBOTS / path)
        stripped(tree.getroot())
        ET.indent(tree, " ")
        text = ET.tostring(tree.getroot(), encoding="unicode") + "\n"
        try:
            samples = poses(text)
        except ValueError as why:
            sys.exit(f"{path}: {why}")
        name = name_of(path)
        (OUT / f"{name}.urdf").write_text(text)
        files.append({"name": name, "from": path, "samples": samples})
    result = {
        "made_by": "make_urdf.py",
        "made_on": datetime.date.today().isoformat(),
        "pinocchio": version("pin"),
        "source": f"example-robot-data {version('example-robot-data')} (PyPI), BSD-3-Clause; what is not kinematics left out",
        "files": files,
    }
    (HERE / "urdf.json").write_text(json.dumps(result, separators=(",", ":")) + "\n")
    print(len(files), "files")


if __name__ == "__main__":
    main()
