"""Derivatives of torques and accelerations, computed by Pinocchio for the arms of dynamics.json.

Writes dynamics_derivatives.json beside this file. For the first state of each arm of the catalogue there: d tau / d q, d tau / d qd
and the matrix d tau / d qdd (computeRNEADerivatives), and for arms whose joints are one a row and have no rotors d qdd / d q,
d qdd / d qd and d qdd / d tau under the torque `pulled` (computeABADerivatives). What joints and rows have to do with each other
is the matrix G of make_dynamics.py.

Run: python make_dynamics_derivatives.py, in an environment with pin and numpy.
"""

import datetime
import json
import pathlib
from importlib.metadata import version

import numpy as np
import pinocchio as pin

from make_dynamics import lists, of_rows
from make_fk import CATALOGUE, Robot

HERE = pathlib.Path(__file__).resolve().parent


def symmetric(matrix):
    return np.triu(matrix) + np.triu(matrix, 1).T


def derivatives(one):
    robot = Robot(CATALOGUE / f"{one['name']}.toml")
    model, g, _ = of_rows(robot, None, one["bodies"])
    model.gravity = pin.Motion(np.array(one["gravity"]), np.zeros(3))
    rotors, sample = np.array(one["rotors"]), one["samples"][0]
    q, qd, qdd, pulled = (np.array(sample[key]) for key in ["q", "qd", "qdd", "pulled"])
    values = np.array([row.value(robot.named(q)) for row in robot.rows if row.kind != "F"])
    data = model.createData()
    by_q, by_qd, by_qdd = pin.computeRNEADerivatives(model, data, values, g @ qd, g @ qdd)
    found = {
        "tau_q": g.T @ by_q @ g, "tau_qd": g.T @ by_qd @ g, "tau_qdd": g.T @ symmetric(by_qdd) @ g + np.diag(rotors),
    }
    if len(g) == len(g.T) and not rotors.any():
        by_q, by_qd, by_tau = pin.computeABADerivatives(model, data, values, g @ qd, np.linalg.solve(g.T, pulled))
        back = np.linalg.inv(g)
        found |= {"qdd_q": back @ by_q @ g, "qdd_qd": back @ by_qd @ g, "qdd_tau": back @ symmetric(by_tau) @ back.T}
    return {"name": one["name"]} | {key: lists(np.asarray(value)) for key, value in found.items()}


def main():
    states = json.loads((HERE / "dynamics.json").read_text(encoding="utf-8"))
    provenance = {
        "pinocchio": version("pin"),
        "made_by": "crates/robot/tests/peers/make_dynamics_derivatives.py",
        "date": datetime.date.today().isoformat(),
    }
    arms = ",\n".join(json.dumps(derivatives(one)) for one in states["catalogue"])
    text = f'{{\n"provenance": {json.dumps(provenance)},\n"catalogue": [\n{arms}\n]\n}}\n'
    (HERE / "dynamics_derivatives.json").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
