"""Configurations of MuJoCo models with closed loops, computed by MuJoCo.

Each model is put together here; its lengths are drawn. The driven joints get values, and the others are found by Newton's method on
MuJoCo's own residual of the constraints (`efc_pos` of <connect> and <weld>), from where the file shows the model and on in small
steps, so that its assembly mode stays. Beside this file mjcf_loops.json: the texts, and at each configuration the value of each joint
by its name and the pose of each site in the world, rows of the 3x4 matrix.

Run: python make_mjcf_loops.py, in an environment with mujoco.
"""

import datetime
import json
import math
import pathlib
import random

import mujoco
import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
SEED = 31
GEOM = '<geom size="0.01"/>'


def four_bar(draw):
    """A crank and a rocker, upright in space and turned; the coupler is connected to the rocker."""
    a, b, e, g = 0.2, draw(0.55, 0.65), draw(0.5, 0.6), draw(0.6, 0.7)
    # The angle at the crank's joint with which it closes where the crank lies along the ground.
    x = g - a
    c = (b * b + x * x - e * e) / (2 * b * x)
    angle = math.degrees(math.acos(c))
    reach = [b * math.cos(math.radians(angle)) - x, b * math.sin(math.radians(angle))]
    rocker = math.degrees(math.atan2(reach[1], reach[0]))
    return f"""<mujoco model="four-bar">
  <worldbody>
    <body name="ground" euler="90 0 30" pos="0.1 0.2 0.5">
      <body name="crank"><joint name="crank" axis="0 0 1"/>{GEOM}
        <body name="coupler" pos="{a} 0 0" euler="0 0 {angle:.6f}"><joint name="coupler" axis="0 0 1"/>{GEOM}
          <site name="point" pos="{b / 2:.4f} 0.1 0"/></body></body>
      <body name="rocker" pos="{g:.6f} 0 0" euler="0 0 {rocker:.6f}"><joint name="rocker" axis="0 0 -1"/>{GEOM}</body>
    </body>
  </worldbody>
  <equality><connect name="joint" body1="coupler" body2="rocker" anchor="{b:.6f} 0 0"/></equality>
  <actuator><motor joint="crank"/></actuator>
</mujoco>""", ["crank"], [(-2.5, 2.5)]


def five_bar(draw):
    """Two arms that meet at two sites; one joint is shown off its zero."""
    a, b, g = draw(0.2, 0.3), draw(0.35, 0.45), draw(0.15, 0.25)
    # Symmetric: both arms at right angles to the ground, the rods meet in the middle.
    angle = math.degrees(math.acos(g / 2 / b)) - 90
    return f"""<mujoco model="five-bar">
  <compiler angle="degree"/>
  <worldbody>
    <body name="left arm" euler="0 0 90"><joint name="left" axis="0 0 1" ref="90"/>{GEOM}
      <body name="left rod" pos="{a} 0 0" euler="0 0 {angle:.8f}"><joint name="left elbow" axis="0 0 1"/>{GEOM}
        <site name="point" pos="{b} 0 0"/></body></body>
    <body name="right arm" pos="{g} 0 0" euler="0 0 90"><joint name="right" axis="0 0 1"/>{GEOM}
      <body name="right rod" pos="{a} 0 0" euler="0 0 {-angle:.8f}"><joint name="right elbow" axis="0 0 1"/>{GEOM}
        <site name="end" pos="{b} 0 0"/></body></body>
  </worldbody>
  <equality><connect site1="point" site2="end"/></equality>
  <actuator><position joint="left"/><position joint="right"/></actuator>
</mujoco>""", ["left", "right"], [(-0.5, 0.5), (-0.5, 0.5)]


def slider(draw):
    """A crank, a rod and a slide; the rod's end is welded to a body that turns on the slide."""
    a, b = draw(0.1, 0.2), draw(0.4, 0.5)
    return f"""<mujoco model="slider-crank">
  <worldbody>
    <body name="crank" euler="0 90 0"><joint name="crank" axis="0 0 1"/>{GEOM}
      <body name="rod" pos="{a} 0 0"><joint name="rod" axis="0 0 1"/>{GEOM}<site name="middle" pos="{b / 2} 0 0"/></body></body>
    <body name="slide" pos="0 0 {-(a + b)}"><joint name="slide" type="slide" axis="0 0 -1"/>{GEOM}
      <body name="pin"><joint name="pin" axis="1 0 0"/>{GEOM}</body></body>
  </worldbody>
  <equality><weld name="end" body1="rod" body2="pin"/></equality>
  <actuator><motor joint="crank"/></actuator>
</mujoco>""", ["crank"], [(-2.0, 2.0)]


def spatial(draw):
    """A crank and a rocker about crossing axes, with a rod between whose ends are a universal joint and a point."""
    a, c = draw(0.1, 0.15), draw(0.3, 0.4)
    return f"""<mujoco model="crossing axes">
  <worldbody>
    <body name="crank"><joint name="crank" axis="0 0 1"/>{GEOM}
      <body name="rod" pos="{a} 0 0"><joint name="yaw" axis="0 0 1"/><joint name="pitch" axis="0 1 0"/>{GEOM}
        <site name="middle" pos="0.2 0 0.1"/></body></body>
    <body name="rocker" pos="{a + 0.5} 0 0"><joint name="rocker" axis="0 1 0"/>{GEOM}</body>
  </worldbody>
  <equality><connect body1="rod" body2="rocker" anchor="0.5 0 {c}"/></equality>
  <actuator><motor joint="crank"/></actuator>
</mujoco>""", ["crank"], [(-1.0, 1.0)]




def solve(model, data, driven, values, passive):
    """Newton's method on the constraints of equality."""
    for name, value in zip(driven, values):
        data.qpos[model.joint(name).qposadr[0]] = value
    address = [model.joint(name).qposadr[0] for name in passive]

    def residual():
        mujoco.mj_fwdPosition(model, data)
        rows = data.efc_type[: data.nefc] == int(mujoco.mjtConstraint.mjCNSTR_EQUALITY)
        return np.array(data.efc_pos[: data.nefc][rows])

    for _ in range(50):
        r = residual()
        if np.abs(r).max() < 1e-14:
            break
        jacobian = np.zeros((len(r), len(address)))
        for k, at in enumerate(address):
            here = data.qpos[at]
            data.qpos[at] = here + 1e-6
            plus = residual()
            data.qpos[at] = here - 1e-6
            minus = residual()
            data.qpos[at] = here
            jacobian[:, k] = (plus - minus) / 2e-6
        step = np.linalg.lstsq(jacobian, r, rcond=1e-9)[0]
        for k, at in enumerate(address):
            data.qpos[at] -= step[k]
    return np.abs(residual()).max()


def main():
    rng = random.Random(SEED)
    draw = lambda low, high: round(rng.uniform(low, high), 3)
    cases = []
    for make in [four_bar, five_bar, slider, spatial]:
        for _ in range(3):
            text, driven, ranges = make(draw)
            model = mujoco.MjModel.from_xml_string(text)
            data = mujoco.MjData(model)
            names = [model.joint(k).name for k in range(model.njnt)]
            passive = [n for n in names if n not in driven]
            start = np.array([model.qpos0[model.joint(n).qposadr[0]] for n in driven])
            configurations = []
            for _ in range(6):
                goal = start + np.array([rng.uniform(*r) for r in ranges])
                data.qpos[:] = model.qpos0
                missed = 0.0
                for k in range(1, 101):
                    missed = solve(model, data, driven, start + (goal - start) * k / 100, passive)
                    if missed > 1e-12:
                        break
                if missed > 1e-12:
                    continue
                mujoco.mj_fwdPosition(model, data)
                sites = {}
                for k in range(model.nsite):
                    rotation = data.site_xmat[k].reshape(3, 3)
                    sites[model.site(k).name] = np.hstack([rotation, data.site_xpos[k].reshape(3, 1)]).tolist()
                joints = {n: float(data.qpos[model.joint(n).qposadr[0]]) for n in names}
                configurations.append({"joints": joints, "sites": sites})
            cases.append({"configurations": configurations, "driven": driven, "text": text})
            print(model.names.split(b"\0")[0].decode(), len(configurations), "configurations")
    out = {"made": f"make_mjcf_loops.py, MuJoCo {mujoco.__version__}, {datetime.date.today()}", "cases": cases}
    (HERE / "mjcf_loops.json").write_text(json.dumps(out, indent=1) + "\n")


main()
