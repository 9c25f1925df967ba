"""The joints of a chain as Pinocchio reads them from a URDF: where each stands in the one before, its axis, its body.

Run: python model.py FILE TIP NAME FOLDER, in an environment with pin; writes NAME.inc, which is C++, and NAME.urdf there.
"""

import pathlib
import sys

import numpy as np
import pinocchio as pin


def main(path, tip, name, folder):
    model = pin.buildModelFromXML(pathlib.Path(path).read_text(encoding="utf-8"))
    joint, chain = model.frames[model.getFrameId(tip)].parentJoint, []
    while joint:
        chain.insert(0, joint)
        joint = model.parents[joint]
    locked = [j for j in range(1, model.njoints) if j not in chain]
    model = pin.buildReducedModel(model, locked, pin.neutral(model))
    folder = pathlib.Path(folder)
    (folder / f"{name}.inc").write_text(cpp(model, name), encoding="utf-8")
    (folder / f"{name}.urdf").write_text(urdf(model, name), encoding="utf-8")


def axis(model, j):
    return "XYZ".index(model.joints[j].shortname()[-1])


def cpp(model, name):
    list_of = lambda x: ", ".join(repr(float(v)) for v in np.asarray(x).ravel())
    lines = [f"static const Link {name}_links[{model.nv}] = {{"]
    for j in range(1, model.njoints):
        place, body = model.jointPlacements[j], model.inertias[j]
        lines.append(f"    {{{{{list_of(place.rotation)}}}, {{{list_of(place.translation)}}}, {axis(model, j)},")
        lines.append(f"     {float(body.mass)!r}, {{{list_of(body.lever)}}}, {{{list_of(body.inertia)}}}}},")
    return "\n".join([*lines, "};", ""])


def urdf(model, name):
    list_of = lambda x: " ".join(repr(float(v)) for v in x)
    lines = [f'<robot name="{name}">', '<link name="l0"/>']
    for j in range(1, model.njoints):
        place, body = model.jointPlacements[j], model.inertias[j]
        about = " ".join(
            f'i{"xyz"[r]}{"xyz"[c]}="{float(body.inertia[r, c])!r}"' for r in range(3) for c in range(r, 3)
        )
        lines += [
            f'<link name="l{j}"><inertial><origin xyz="{list_of(body.lever)}" rpy="0 0 0"/>',
            f'<mass value="{float(body.mass)!r}"/><inertia {about}/></inertial></link>',
            f'<joint name="j{j}" type="continuous"><parent link="l{j - 1}"/><child link="l{j}"/>',
            f'<origin xyz="{list_of(place.translation)}" rpy="{list_of(pin.rpy.matrixToRpy(place.rotation))}"/>',
            f'<axis xyz="{list_of(np.eye(3)[axis(model, j)])}"/></joint>',
        ]
    return "\n".join([*lines, "</robot>", ""])


main(*sys.argv[1:])
