"""Poses of all bodies and sites of MuJoCo models, computed by MuJoCo.

Three kinds of models:
- public ones, out of the packages dm_control and robosuite (PyPI): without what says nothing of kinematics (looks, contacts,
  drives; no digit is changed) they go to ../mjcf, with the files that they include;
- made ones, put together at random of everything that places a body: their text stands in mjcf.json;
- every robot of the catalogue as `denavit convert --to mjcf` writes it: the pose of its tool.

Beside this file mjcf.json: at each configuration the value of each joint by its name, and the pose of each body and site with a
name in the world, rows of the 3x4 matrix. Joints that follow others by an equality do so. Where a body has no mass MuJoCo is
given a ball for it, which moves nothing.

Run: python make_mjcf.py DENAVIT, in an environment with mujoco, dm_control and robosuite; DENAVIT is the program.
"""

import datetime
import json
import math
import pathlib
import random
import subprocess
import sys
import xml.etree.ElementTree as ET
from importlib.metadata import distribution, version

import mujoco
import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
OUT = HERE.parent / "mjcf"
SEED = 20
MOVED = {int(mujoco.mjtJoint.mjJNT_HINGE), int(mujoco.mjtJoint.mjJNT_SLIDE)}
COUPLED = int(mujoco.mjtEq.mjEQ_JOINT)
FILES = [
    ("robosuite", "robosuite/models/assets/robots/panda/robot.xml", "panda"),
    ("robosuite", "robosuite/models/assets/robots/ur5e/robot.xml", "ur5e"),
    ("robosuite", "robosuite/models/assets/robots/iiwa/robot.xml", "iiwa"),
    ("robosuite", "robosuite/models/assets/robots/kinova3/robot.xml", "kinova3"),
    ("robosuite", "robosuite/models/assets/robots/jaco/robot.xml", "jaco"),
    ("robosuite", "robosuite/models/assets/robots/sawyer/robot.xml", "sawyer"),
    ("robosuite", "robosuite/models/assets/robots/xarm7/robot.xml", "xarm7"),
    ("robosuite", "robosuite/models/assets/robots/baxter/robot.xml", "baxter"),
    ("robosuite", "robosuite/models/assets/robots/spot_arm/robot.xml", "spot_arm"),
    ("robosuite", "robosuite/models/assets/grippers/robotiq_gripper_85.xml", "robotiq_85"),
    ("dm_control", "dm_control/third_party/kinova/jaco_arm.xml", "jaco_arm"),
    ("dm_control", "dm_control/mjcf/test_assets/robot_arm.xml", "robot_arm"),
    ("dm_control", "dm_control/suite/manipulator.xml", "manipulator"),
    ("dm_control", "dm_control/suite/quadruped.xml", "quadruped"),
    ("dm_control", "dm_control/suite/humanoid_CMU.xml", "humanoid_cmu"),
    ("dm_control", "dm_control/suite/finger.xml", "finger"),
]
KEPT = {
    "mujoco": ["compiler", "default", "worldbody", "equality", "include"],
    "default": ["default", "joint", "site"],
    "worldbody": ["body", "site", "frame"],
    "body": ["body", "site", "frame", "joint", "freejoint", "inertial"],
    "equality": ["joint", "connect", "weld"],
}
INCLUDED = {"common.xml", "skybox.xml", "visual.xml", "materials.xml"}


def stripped(element):
    """The element without what says nothing of kinematics."""
    for child in list(element):
        is_looks = child.tag == "include" and pathlib.Path(child.get("file", "")).name in INCLUDED
        if is_looks or (element.tag in KEPT and child.tag not in KEPT[element.tag]):
            element.remove(child)
        else:
            stripped(child)
    if element.tag == "site":
        for name in {"rgba", "material", "group"} & set(element.attrib):
            del element.attrib[name]
    if element.tag == "compiler":
        for name in set(element.attrib) - {"angle", "eulerseq", "autolimits", "coordinate"}:
            del element.attrib[name]
    element.text = element.tail = None


def with_balls(text):
    """The model with a ball in each body."""
    root = ET.fromstring(text)
    for body in root.iter("body"):
        ET.SubElement(body, "geom", size="0.01")
    return ET.tostring(root, encoding="unicode")


def follow(model, data):
    """Joints that follow others where those are; several times, as one may follow one that follows."""
    for _ in range(4):
        for i in range(model.neq):
            linear = not any(model.eq_data[i][2:5])
            if int(model.eq_type[i]) != COUPLED or not model.eq_active0[i] or not linear:
                continue
            one, other = model.jnt_qposadr[model.eq_obj1id[i]], model.eq_obj2id[i]
            constant, factor = model.eq_data[i][:2]
            moved = 0.0
            if other >= 0:
                there = model.jnt_qposadr[other]
                moved = factor * (data.qpos[there] - model.qpos0[there])
            data.qpos[one] = model.qpos0[one] + constant + moved


def pose(matrix, place):
    return np.hstack([matrix.reshape(3, 3), place.reshape(3, 1)]).ravel().tolist()


def poses(model, count=3):
    """Values of the joints, and the poses of bodies and sites."""
    samples = []
    for k in range(count):
        data = mujoco.MjData(model)
        for j in range(model.njnt):
            if int(model.jnt_type[j]) in MOVED and k:
                data.qpos[model.jnt_qposadr[j]] = random.uniform(-1.5, 1.5)
        follow(model, data)
        joints = {
            model.joint(j).name: float(data.qpos[model.jnt_qposadr[j]])
            for j in range(model.njnt)
            if int(model.jnt_type[j]) in MOVED
        }
        mujoco.mj_kinematics(model, data)
        bodies = {model.body(i).name: pose(data.xmat[i], data.xpos[i]) for i in range(1, model.nbody) if model.body(i).name}
        sites = {
            model.site(i).name: pose(data.site_xmat[i], data.site_xpos[i])
            for i in range(model.nsite)
            if model.site(i).name
        }
        samples.append({"joints": joints, "bodies": bodies, "sites": sites})
    return samples


def number(low, high, digits=3):
    return f"{random.uniform(low, high):.{digits}f}"


def three(size=1.0):
    return " ".join(number(-size, size) for _ in range(3))


def turned():
    """How a frame is turned, in one of the ways there are."""
    return random.choice(
        [
            "",
            f' euler="{three(90)}"',
            f' quat="{number(0.2, 1)} {three()}"',
            f' axisangle="{three()} {number(-180, 180)}"',
            f' zaxis="{three()}"',
            f' xyaxes="{three()} {three()}"',
            ' quat="0.707107 0 -0.707107 0"',
            ' zaxis="0 0 -1"',
        ]
    )


class Model:
    """A model made at random."""

    def __init__(self):
        self.count = 0
        self.hinges = []

    def named(self, kind):
        self.count += 1
        return f"{kind}{self.count}"

    def joint(self):
        name = self.named("j")
        kind = random.choice(["hinge", "hinge", "slide"])
        ref = f' ref="{number(-1, 1) if kind == "slide" else number(-90, 90)}"' if random.random() < 0.3 else ""
        pos = f' pos="{three(0.3)}"' if random.random() < 0.5 else ""
        axis = f' axis="{three()}"' if random.random() < 0.7 else ""
        given = random.choice(["", "", ' class="outer"', ' class="inner"'])
        if not given or kind == "slide":
            given += f' type="{kind}"'
        self.hinges.append(name)
        return f'<joint name="{name}"{given}{pos}{axis}{ref}/>'

    def body(self, depth):
        name = self.named("b")
        text = f'<body name="{name}" pos="{three()}"{turned()}{random.choice(["", " childclass=" + chr(34) + "inner" + chr(34)])}>'
        for _ in range(random.choice([0, 1, 1, 1, 2, 3])):
            joint = self.joint()
            if random.random() < 0.2:
                joint = f'<frame pos="{three()}"{turned()}>{joint}</frame>'
            text += joint
        if random.random() < 0.6:
            text += f'<site name="{self.named("s")}" pos="{three()}"{turned()}/>'
        if random.random() < 0.2:
            text += f'<site name="{self.named("s")}" type="capsule" size=".01" fromto="{three()} {three()}"/>'
        if random.random() < 0.2:
            inside = f'<body name="{self.named("r")}" pos="{three()}"><site name="{self.named("s")}"{turned()}/></body>'
            text += f'<replicate count="{random.choice([2, 11])}" offset="{three()}" euler="{three(40)}" sep="-">{inside}</replicate>'
        for _ in range(random.choice([0, 1, 1, 2]) if depth else 0):
            inner = self.body(depth - 1)
            if random.random() < 0.3:
                inner = f'<frame pos="{three()}"{turned()} childclass="outer">{inner}</frame>'
            text += inner
        return text + "</body>"

    def text(self):
        sequence = random.choice(["xyz", "zyx", "XYZ", "zXy", "ZYZ"])
        world = self.body(4)
        pairs = random.sample(self.hinges, min(4, len(self.hinges)) // 2 * 2)
        equal = "".join(
            f'<joint joint1="{a}" joint2="{b}" polycoef="{number(-1, 1)} {number(-2, 2)}"/>' for a, b in zip(pairs[::2], pairs[1::2])
        )
        return (
            f'<mujoco model="made"><compiler eulerseq="{sequence}"/><default><joint axis="0 1 0"/><site group="1"/>'
            f'<default class="outer"><joint pos="0.1 0 0" type="hinge"/><default class="inner"><joint axis="1 1 0" ref="30" type="hinge"/>'
            f'<site euler="10 20 30"/></default></default></default><worldbody>{world}</worldbody><equality>{equal}</equality></mujoco>'
        )


def made(count):
    """Models at random that MuJoCo takes: it refuses some, such as a turn about 0."""
    models = []
    while len(models) < count:
        text = Model().text()
        try:
            model = mujoco.MjModel.from_xml_string(with_balls(text))
        except ValueError:
            continue
        if 3 <= model.njnt <= 14:
            models.append({"text": text, "samples": poses(model, 2)})
    return models


def of_catalogue(denavit):
    """The tools of the robots of the catalogue: of each the values of its joints by name, and the pose."""
    listed = json.loads(subprocess.run([denavit, "robots", "--json"], check=True, capture_output=True, text=True).stdout)
    robots = {}
    for name in [r["name"] for r in listed["robots"]]:
        run = subprocess.run([denavit, "convert", name, "--to", "mjcf"], capture_output=True, text=True)
        if run.returncode:
            continue  # a parameter has no value
        model = mujoco.MjModel.from_xml_string(run.stdout)
        data = mujoco.MjData(model)
        following = {int(model.eq_obj1id[i]) for i in range(model.neq)}
        own = [j for j in range(model.njnt) if j not in following]
        q = [round(0.3 + 0.2 * i, 3) for i in range(len(own))]
        for j, x in zip(own, q):
            data.qpos[model.jnt_qposadr[j]] = x
        follow(model, data)
        mujoco.mj_kinematics(model, data)
        site = model.site("tool").id
        robots[name] = {"q": q, "tool": pose(data.site_xmat[site], data.site_xpos[site])}
    return robots


def main():
    random.seed(SEED)
    OUT.mkdir(exist_ok=True)
    files = []
    for package, path, name in FILES:
        root = ET.fromstring(pathlib.Path(distribution(package).locate_file(path)).read_text())
        stripped(root)
        ET.indent(root, " ")
        text = ET.tostring(root, encoding="unicode") + "\n"
        (OUT / f"{name}.xml").write_text(text)
        model = mujoco.MjModel.from_xml_string(with_balls(text))
        files.append({"name": name, "from": path, "samples": poses(model)})
    result = {
        "made_by": "make_mjcf.py",
        "made_on": datetime.date.today().isoformat(),
        "mujoco": version("mujoco"),
        "source": f"dm_control {version('dm_control')} (PyPI), Apache-2.0; robosuite {version('robosuite')} (PyPI), MIT; "
        "what is not kinematics left out",
        "files": files,
        "made": made(40),
        "catalogue": of_catalogue(sys.argv[1]),
    }
    (HERE / "mjcf.json").write_text(json.dumps(result, separators=(",", ":")) + "\n")
    print(len(files), "files,", len(result["made"]), "made,", len(result["catalogue"]), "of the catalogue")


if __name__ == "__main__":
    main()
