"""Writes ruckig.json: the fastest motions between states by the original ruckig (C++, MIT), for tests/motion_profiles.rs.

python3 -m venv venv && venv/bin/pip install ruckig numpy && venv/bin/python ruckig_moves.py > ruckig.json
"""

import importlib.metadata
import json

import numpy as np
from ruckig import InputParameter, Ruckig, Trajectory

NAMES = ["current_position", "current_velocity", "current_acceleration", "target_position", "target_velocity",
         "target_acceleration", "max_velocity", "min_velocity", "max_acceleration", "min_acceleration", "max_jerk"]


def main():
    rng = np.random.default_rng(2021)
    cases = []
    while len(cases) < 30:
        n = int(rng.choice([1, 3, 7]))
        given = {name: np.zeros(n) for name in NAMES}
        given["max_velocity"], given["min_velocity"] = rng.uniform(1, 3, n), -rng.uniform(1, 3, n)
        given["max_acceleration"], given["min_acceleration"] = rng.uniform(5, 20, n), -rng.uniform(5, 20, n)
        given["max_jerk"] = rng.uniform(50, 500, n)
        for end in ["current", "target"]:
            given[f"{end}_position"] = rng.uniform(-3, 3, n)
            if len(cases) % 3:
                given[f"{end}_velocity"] = rng.uniform(-0.8, 0.8, n)
                given[f"{end}_acceleration"] = rng.uniform(-2, 2, n)
        given = {name: np.round(values, 6).tolist() for name, values in given.items()}
        otg, inp, out = Ruckig(n), InputParameter(n), Trajectory(n)
        for name, values in given.items():
            setattr(inp, name, values)
        if otg.calculate(inp, out) < 0:
            continue
        times = [out.duration * k / 5 for k in range(6)]
        cases.append({**given, "duration": out.duration,
                      "samples": [{"t": t, "q": np.round(out.at_time(t)[0], 12).tolist()} for t in times]})
    version = importlib.metadata.version("ruckig")
    print(json.dumps({"provenance": f"ruckig {version} (PyPI, MIT), random states, seed 2021; written by ruckig_moves.py",
                      "cases": cases}))


if __name__ == "__main__":
    main()
