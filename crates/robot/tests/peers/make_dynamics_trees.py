"""Torques, inertia matrices, accelerations and energies of whole trees, computed by Pinocchio.

Writes dynamics_trees.json beside this file: two-armed, legged and many-fingered robots of ../urdf with their own inertias, the root
held, all joints moving; those that follow another (<mimic>) are joints of Pinocchio's, too, with tau = G^T tau of them. The numbers are
those of make_dynamics.py, one for each joint that moves by itself ("joints").

Run: python make_dynamics_trees.py, in an environment with pin and numpy.
"""

import datetime
import json
import math
from importlib.metadata import version
from xml.etree import ElementTree

import numpy as np
import pinocchio as pin

from make_dynamics import HERE, answers

SEED = 2022
FILES = ["baxter", "allegro_left_hand", "anymal_c", "solo12", "bolt", "b1_z1", "laikago"]


def main():
    rng = np.random.default_rng(SEED)
    trees = []
    for name in FILES:
        text = (HERE.parent / "urdf" / f"{name}.urdf").read_text(encoding="utf-8")
        model = pin.buildModelFromXML(text)
        all_names = list(model.names)[1:]
        follows = {}
        for joint in ElementTree.fromstring(text).iter("joint"):
            mimic = joint.find("mimic")
            if mimic is not None and joint.get("name") in all_names:
                of = (mimic.get("joint"), float(mimic.get("multiplier", 1)), float(mimic.get("offset", 0)))
                follows[joint.get("name")] = of
        names = [name for name in all_names if name not in follows]
        n = len(names)
        q, g, values = rng.uniform(-1.5, 1.5, n), np.zeros((model.nv, n)), []
        for row, (joint_name, joint) in enumerate(zip(all_names, list(model.joints)[1:])):
            leader, factor, offset = follows.get(joint_name, (joint_name, 1.0, 0.0))
            g[row, names.index(leader)] = factor
            x = factor * q[names.index(leader)] + offset
            values += [math.cos(x), math.sin(x)] if joint.nq == 2 else [x]
        qd, qdd = rng.uniform(-2, 2, n), rng.uniform(-3, 3, n)
        sample = {"q": q.tolist()} | answers(model, g, np.array(values), qd, qdd, np.zeros(n))
        # Half of a symmetric matrix, row by row.
        sample["A"] = [row[: i + 1] for i, row in enumerate(sample["A"])]
        trees.append({"name": name, "joints": names, "sample": sample})
    written = {
        "provenance": {
            "pinocchio": version("pin"),
            "made_by": "crates/robot/tests/peers/make_dynamics_trees.py",
            "date": datetime.date.today().isoformat(),
            "seed": SEED,
        },
        "trees": trees,
    }
    (HERE / "dynamics_trees.json").write_text(json.dumps(written, indent=None, separators=(",", ":")) + "\n")


main()
