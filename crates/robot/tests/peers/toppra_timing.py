"""Writes toppra.json: time-optimal timings by the package toppra (MIT), for tests/motion_timing.rs.

python3 -m venv venv && venv/bin/pip install toppra==0.6.10 numpy scipy && venv/bin/python toppra_timing.py [cases] > toppra.json
"""

import json
import logging
import sys
import time

import numpy as np
import toppra
import toppra.algorithm
import toppra.constraint

logging.disable(logging.WARNING)
PANDA_V = [2.175] * 4 + [2.61] * 3
PANDA_A = [15, 7.5, 10, 12.5, 15, 20, 20]


def rounded(a, digits=12):
    return np.round(np.asarray(a, float), digits).tolist()


def case(rng, kind):
    dof, n = (7, 20) if kind != "small" else (int(rng.integers(1, 4)), int(rng.integers(3, 7)))
    way_points = np.array(rounded(rng.uniform(-2, 2, (n, dof)), 6))
    if kind == "walk":  # small steps, and some joints that stand still between way-points
        way_points = np.array(rounded(np.cumsum(rng.uniform(-0.4, 0.4, (n, dof)), axis=0), 6))
        way_points[3:6, 2] = way_points[3, 2]
    v, a = np.array(PANDA_V[:dof]), np.array(PANDA_A[:dof], float)
    vlim, alim = np.stack([-v, v], 1), np.stack([-a, a], 1)
    if kind == "asymmetric":
        vlim, alim = vlim * rounded(rng.uniform(0.3, 1, (dof, 2)), 3), alim * rounded(rng.uniform(0.3, 1, (dof, 2)), 3)
    ends = "clamped" if kind == "clamped" else "natural"
    parameters = np.array(rounded(np.linspace(0, 1, n)))
    path = toppra.SplineInterpolator(parameters, way_points, bc_type=ends)
    scheme = "collocation" if kind == "collocation" else "interpolation"
    acceleration = toppra.constraint.JointAccelerationConstraint(
        alim,
        toppra.constraint.DiscretizationType.Collocation
        if scheme == "collocation"
        else toppra.constraint.DiscretizationType.Interpolation,
    )
    constraints = [toppra.constraint.JointVelocityConstraint(vlim), acceleration]
    intervals = 500
    speeds = [0.01, 0.015] if kind == "speeds" else [0.0, 0.0]
    best = np.inf
    for _ in range(3):
        start = time.perf_counter()
        algorithm = toppra.algorithm.TOPPRA(
            constraints, path, gridpoints=np.linspace(0, 1, intervals + 1), solver_wrapper="seidel",
            parametrizer="ParametrizeConstAccel",
        )
        _, sd, _ = algorithm.compute_parameterization(*speeds)
        best = min(best, time.perf_counter() - start)
    if sd is None:
        return None
    duration = float(np.sum(2 / intervals / (sd[:-1] + sd[1:])))
    return {
        "kind": kind, "scheme": scheme, "ends": ends, "intervals": intervals, "speeds": speeds,
        "parameters": parameters.tolist(), "way_points": way_points.tolist(),
        "velocity": rounded(vlim), "acceleration": rounded(alim),
        "duration": duration, "speed_samples": rounded(sd[::25], 9), "milliseconds": round(best * 1e3, 3),
    }


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 1
    kinds = ["plain", "asymmetric", "clamped", "collocation", "speeds", "walk", "small"]
    cases = [c for seed in range(count) for k, kind in enumerate(kinds)
             if (c := case(np.random.default_rng([2018, seed, k]), kind))]
    print(json.dumps({
        "provenance": f"toppra {toppra.__version__ if hasattr(toppra, '__version__') else '0.6.10'} (PyPI, MIT), TOPPRA"
                      f" with seidel, NumPy {np.__version__}; written by toppra_timing.py",
        "cases": cases,
    }))


if __name__ == "__main__":
    main()
