"""The joints of a chain as Pinocchio reads them from a URDF, as C++: where each stands in the one before, its axis, its body.

Run: python model.py FILE TIP NAME > NAME.inc, in an environment with pin.
"""

import pathlib
import sys

import numpy as np
import pinocchio as pin


def main(path, tip, name):
    model = pin.buildModelFromXML(pathlib.Path(path).read_text(encoding="utf-8"))
    joint, chain = model.frames[model.getFrameId(tip)].parentJoint, []
    while joint:
        chain.insert(0, joint)
        joint = model.parents[joint]
    locked = [j for j in range(1, model.njoints) if j not in chain]
    model = pin.buildReducedModel(model, locked, pin.neutral(model))
    list_of = lambda x: ", ".join(repr(float(v)) for v in np.asarray(x).ravel())
    print(f"static const Link {name}_links[{model.nv}] = {{")
    for j in range(1, model.njoints):
        place, body = model.jointPlacements[j], model.inertias[j]
        axis = "XYZ".index(model.joints[j].shortname()[-1])
        print(f"    {{{{{list_of(place.rotation)}}}, {{{list_of(place.translation)}}}, {axis},")
        print(f"     {float(body.mass)!r}, {{{list_of(body.lever)}}}, {{{list_of(body.inertia)}}}}},")
    print("};")


main(*sys.argv[1:])
