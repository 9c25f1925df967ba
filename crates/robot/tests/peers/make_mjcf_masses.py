"""What bodies of MuJoCo models weigh whose geoms say so, computed by MuJoCo.

Models are put together at random of all that a geom's mass depends on; their text stands in mjcf_masses.json, with the mass of
each body, its centre and the inertia about it along the axes of the body's frame (xx xy xz yy yz zz).

Run: python make_mjcf_masses.py, in an environment with mujoco.
"""

import json
import pathlib
import random

import mujoco
import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
SIZES = {"sphere": 1, "capsule": 2, "ellipsoid": 3, "cylinder": 2, "box": 3}


def number(low, high, digits=3):
    return f"{random.uniform(low, high):.{digits}f}"


def three(size=1.0):
    return " ".join(number(-size, size) for _ in range(3))


def turned():
    kinds = ["", f' euler="{three(90)}"', f' quat="{number(0.2, 1)} {three()}"', f' zaxis="{three()}"', ' quat="0.707107 0 -0.707107 0"']
    return random.choice(kinds)


def geom():
    kind = random.choice(list(SIZES))
    with_ends = kind != "sphere" and random.random() < 0.4
    count = SIZES[kind] - with_ends
    text = f'<geom type="{kind}" size="{" ".join(number(0.02, 0.3) for _ in range(count))}"'
    text += f' fromto="{three()} {three()}"' if with_ends else f' pos="{three()}"{turned()}'
    text += random.choice(["", "", f' mass="{number(0.1, 4)}"', f' density="{number(100, 3000, 0)}"', ' mass="0"', ' class="light"'])
    return text + random.choice(["", "", ' group="3"', ' group="1"']) + "/>"


def body(depth, name):
    text = f'<body name="{name}" pos="{three()}"{turned()}><joint axis="{three()}"/>'
    if random.random() < 0.3:
        text += f'<inertial pos="{three()}"{turned()} mass="{number(1, 5)}" diaginertia="{number(2, 3)} {number(2, 3)} {number(2, 3)}"/>'
    for _ in range(random.randint(1, 3)):
        one = geom()
        if random.random() < 0.3:
            one = f'<frame pos="{three()}"{turned()}>{one}</frame>'
        if random.random() < 0.15:
            one = f'<replicate count="3" offset="{three()}" euler="{three(40)}">{one}</replicate>'
        text += one
    # A body that moves has a mass.
    text += '<geom size="0.05" group="0"/>'
    if depth:
        text += "".join(body(depth - 1, f"{name}{k}") for k in range(random.choice([0, 1, 2])))
    return text + "</body>"


def model():
    modes = ["", "", ' settotalmass="14"', ' inertiafromgeom="true"', ' inertiagrouprange="0 2"', ' inertiafromgeom="auto"']
    default = f'<default><geom density="{number(500, 2000, 0)}"/><default class="light"><geom density="20"/></default></default>'
    return f"<mujoco><compiler{random.choice(modes)}/>{default}<worldbody><geom type='plane' size='1 1 1'/>{body(3, 'b')}</worldbody></mujoco>"


def masses(text):
    m = mujoco.MjModel.from_xml_string(text)
    found = {}
    for i in range(1, m.nbody):
        turn = np.zeros(9)
        mujoco.mju_quat2Mat(turn, m.body_iquat[i])
        turn = turn.reshape(3, 3)
        tensor = turn @ np.diag(m.body_inertia[i]) @ turn.T
        six = [tensor[a, b] for a, b in [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)]]
        found[m.body(i).name] = {"mass": m.body_mass[i], "com": m.body_ipos[i].tolist(), "inertia": six}
    return found


random.seed(20)
models = []
while len(models) < 30:
    text = model()
    if len(text) < 6000:
        models.append({"text": text, "bodies": masses(text)})
with open(HERE / "mjcf_masses.json", "w") as out:
    json.dump({"peer": f"MuJoCo {mujoco.__version__}", "models": models}, out, indent=0)
    out.write("\n")
