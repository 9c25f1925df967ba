"""How many solutions the inverse kinematics of a catalogue robot has, counted by peers.

Reads ../../catalogue/*.toml, places every robot in random configurations (angles in (-pi, pi), limits
ignored) and writes ik.json beside this file: the configuration and the number of distinct joint vectors
that reach its pose. Counters:
  EAIK    closed forms by subproblems, revolute arms of one to six joints
  ssik    closed forms and the general elimination, revolute arms of six joints
  newton  ours: damped Newton (Levenberg-Marquardt) from 2,000 random starts, 16,000 where the rarest
          solution was found by fewer than 4 starts; a lower bound, no proof
Every solution of a counter is put into the forward kinematics here, must give the pose to 1e-8 in every
element of the matrix (metres), and is counted once modulo 2 pi (1e-6). Where the sets of two counters are
equal, or where newton alone can count and met every solution at least 4 times, `count` is stored; where
they differ `counts` says what each found and `union` how many distinct ones they found together. `given`
names joints whose values (those of q) are handed to the counter: it counts the values of the others.

The forward kinematics are the rows of make_fk.py multiplied out; they are held to Pinocchio's poses in
fk.json first. Run: nice python ik.py, in an environment with numpy, EAIK and ssik (5 minutes on two
cores; with names of robots: those alone, to ./ik.part.json).
"""

import datetime
import json
import math
import multiprocessing
import os
import pathlib
import sys
import time
import warnings
import zlib
from importlib.metadata import version

os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np

from make_fk import CATALOGUE, Robot

HERE = pathlib.Path(__file__).resolve().parent
SEED = 20261121
CASES = 40
CASES_NEWTON = 10
VERIFY, SAME = 1e-8, 1e-6
# The joints that are given, for arms with more joints than their pose needs.
GIVEN = {
    "franka-panda": ["q7"], "kuka-iiwa-7": ["q3"], "kuka-iiwa-14": ["q3"], "kuka-lwr4": ["q3"], "srs-7r": ["q3"],
    "kinova-gen3": ["q3"], "ufactory-xarm7": ["q7"], "rethink-baxter-left": ["q3"], "rethink-sawyer": ["q3"],
    "smart5-six-rail": ["q1", "q2"], "rail-puma": ["q1"], "anthropomorphic-8r": ["q3", "q8"], "prrrrp": ["q1", "q6"],
}
# Counted by newton as well, where the closed forms already agree: the control group.
CONTROL = {"puma560", "ur5", "franka-panda", "smart5-six-rail", "kinova-gen3", "planar-3r", "rhino-xr3"}


def turn(value):
    """Rz(value) for an array of angles: (..., 4, 4)."""
    value = np.asarray(value, dtype=float)
    m = np.zeros(value.shape + (4, 4))
    m[..., 0, 0] = m[..., 1, 1] = np.cos(value)
    m[..., 1, 0] = np.sin(value)
    m[..., 0, 1] = -m[..., 1, 0]
    m[..., 2, 2] = m[..., 3, 3] = 1
    return m


def slide(value):
    value = np.asarray(value, dtype=float)
    m = np.zeros(value.shape + (4, 4))
    m[..., range(4), range(4)] = 1
    m[..., 2, 3] = value
    return m


def inverse(m):
    r = np.eye(4)
    r[:3, :3] = m[:3, :3].T
    r[:3, 3] = -m[:3, :3].T @ m[:3, 3]
    return r


class Chain:
    """C0 Z1 C1 Z2 ... Zk Ck with the given joints frozen; the free variables are v = M q_free + const."""

    def __init__(self, robot, given):
        self.constants, self.kinds, rows = [robot.base], [], []
        free = [f"q{i + 1}" for i in range(robot.n) if f"q{i + 1}" not in given]
        self.index = [int(name[1:]) - 1 for name in free]
        self.shift = []
        for row in robot.rows:
            self.constants[-1] = self.constants[-1] @ row.before
            if row.kind != "F":
                rest = sum(float(k) * given[n] for n, k in row.joints.items() if n in given)
                if any(n not in given for n in row.joints):
                    rows.append([float(row.joints.get(n, 0)) for n in free])
                    self.kinds.append(row.kind)
                    self.shift.append(rest)
                    self.constants.append(np.eye(4))
                else:
                    self.constants[-1] = self.constants[-1] @ (turn if row.kind == "R" else slide)(rest)
            self.constants[-1] = self.constants[-1] @ row.after
        self.constants[-1] = self.constants[-1] @ robot.tool
        self.matrix, self.shift = np.array(rows), np.array(self.shift)
        self.back = np.linalg.inv(self.matrix)
        assert np.array_equal(self.back, np.round(self.back)), "a coupling that is not unimodular"
        self.back = np.round(self.back)
        self.n = len(free)
        self.revolute = np.array([robot_kind == "R" for robot_kind in self.kinds])
        # Which free joint variables are angles: those that move a revolute row.
        self.angle = np.array([self.revolute[np.nonzero(self.matrix[:, j])[0][0]] for j in range(self.n)])

    def frames(self, q):
        """The frame of every moving row before its motion, and the pose; q is (..., n)."""
        v = np.asarray(q) @ self.matrix.T + self.shift
        t, frames = self.constants[0], []
        for i, kind in enumerate(self.kinds):
            frames.append(t)
            t = t @ (turn if kind == "R" else slide)(v[..., i]) @ self.constants[i + 1]
        return frames, t

    def pose(self, q):
        return self.frames(q)[1]

    def wrapped(self, difference):
        return np.where(self.angle, difference - 2 * math.pi * np.round(difference / (2 * math.pi)), difference)

    def distinct(self, candidates, pose):
        """The candidates that give the pose, each once."""
        kept = []
        for q in candidates:
            if not np.isfinite(q).all() or np.abs(self.pose(q) - pose).max() > VERIFY:
                continue
            if not self.holds(kept, q):
                kept.append(np.asarray(q))
        return kept

    def holds(self, kept, q, tolerance=SAME):
        return any(np.abs(self.wrapped(q - k)).max() < tolerance for k in kept)

    def inner(self):
        """C1 ... C(k-1), and the target's own part of the chain: U = C0^-1 T Ck^-1."""
        left, right = inverse(self.constants[0]), inverse(self.constants[-1])
        return self.constants[1:-1], lambda pose: left @ pose @ right

    def joints(self, v):
        """Joint variables of row values."""
        return (np.asarray(v) - self.shift) @ self.back.T


def eaik(chain):
    """A counter by EAIK, or why not."""
    if not chain.revolute.all():
        return None, "prismatic"
    from eaik.IK_HP import HPRobot

    inner, reduced = chain.inner()
    t, axes, offsets = np.eye(4), [], []
    last = np.zeros(3)
    for c in [np.eye(4)] + inner:
        t = t @ c
        axes.append(t[:3, 2].copy())
        offsets.append(t[:3, 3] - last)
        last = t[:3, 3].copy()
    # The tip stands on the last axis. EAIK 1.2.2 then returns 0 for the last joint of a 2R arm: give arms of
    # fewer than six joints a tool off that axis. (It does not help the 4R arm within prrrrp.)
    tool = np.array([0.13, 0.07, 0.05]) if chain.n < 6 else np.zeros(3)
    offsets.append(t[:3, :3] @ tool)
    rest = t[:3, :3].T
    try:
        robot = HPRobot(np.array(axes), np.array(offsets))
        family = robot.getKinematicFamily()
        if not robot.hasKnownDecomposition():
            return None, family
    except Exception as error:  # EAIK throws plain errors for what it does not serve
        return None, f"{type(error).__name__}: {error}"

    def solve(pose):
        target = reduced(pose)
        target[:3, 3] += target[:3, :3] @ tool
        target[:3, :3] = target[:3, :3] @ rest
        found = np.asarray(robot.IK(target).Q)
        return [chain.joints(v) for v in found.reshape(-1, chain.n)] if found.size else []

    return solve, family


def ssik(chain):
    """A counter by ssik, or why not. The class is `reversed` where the chain is handed over tip first."""
    if not chain.revolute.all() or chain.n != 6:
        return None, "six revolute joints only"
    import ssik as package

    def build(inner):
        t, axes, origins = np.eye(4), [], []
        for c in [np.eye(4)] + inner:
            t = t @ c
            z, p = t[:3, 2].copy(), t[:3, 3].copy()
            # A joint's origin may stand anywhere on its axis. ssik 8.2.0 (poe_to_dh, `_line_line_perpendicular`)
            # takes a wrong foot when parallel neighbours have origins apart along the axis: put them level.
            if axes and np.linalg.norm(np.cross(axes[-1], z)) < 1e-9:
                p = p + z * (z @ (origins[-1] - p))
            axes.append(z)
            origins.append(p)
        steps = []
        for k, p in enumerate(origins):
            m = np.eye(4)
            m[:3, 3] = p - (origins[k - 1] if k else 0)
            steps.append(m)
        end = t.copy()
        end[:3, 3] -= origins[-1]
        return package.Manipulator.from_transforms(np.array(steps + [end]), np.array(axes))

    inner, reduced = chain.inner()
    try:
        robot, backwards = build(inner), False
        if "general" in robot.solver_name:
            other = build([inverse(c) for c in reversed(inner)])
            if "general" not in other.solver_name:
                robot, backwards = other, True
    except Exception as error:
        return None, f"{type(error).__name__}: {error}"

    def solve(pose):
        target = reduced(pose)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            found = robot.solve(inverse(target) if backwards else target, respect_limits=False, allow_refinement=True)
        return [chain.joints(-np.asarray(s.q)[::-1] if backwards else s.q) for s in found]

    return solve, robot.solver_name + (" reversed" if backwards else "")


def newton(chain, scale, rng):
    """A counter by brute force: Levenberg-Marquardt on the pose from random starts."""

    def descend(pose, count):
        q = np.where(chain.angle, rng.uniform(-math.pi, math.pi, (count, chain.n)), rng.uniform(-1.5, 1.5, (count, chain.n)) * scale)
        damping = np.full(count, 1e-2)

        def error(q):
            _, t = chain.frames(q)
            e = np.empty((len(q), 6))
            e[:, :3] = (pose[:3, 3] - t[:, :3, 3]) / scale
            r = pose[:3, :3] @ np.swapaxes(t[:, :3, :3], 1, 2)  # the turn that is missing, in the base
            axis = np.stack([r[:, 2, 1] - r[:, 1, 2], r[:, 0, 2] - r[:, 2, 0], r[:, 1, 0] - r[:, 0, 1]], axis=1)
            s = np.linalg.norm(axis, axis=1)
            angle = np.arctan2(s, np.trace(r, axis1=1, axis2=2) - 1)
            e[:, 3:] = axis * np.where(s > 1e-12, angle / np.maximum(s, 1e-300), 0.5)[:, None]
            return e

        def jacobian(q):
            frames, t = chain.frames(q)
            j = np.zeros((len(q), 6, chain.n))
            for i, f in enumerate(frames):
                f = np.broadcast_to(f, t.shape)
                z = f[:, :3, 2]
                if chain.revolute[i]:
                    j[:, :3, i] = np.cross(z, t[:, :3, 3] - f[:, :3, 3]) / scale
                    j[:, 3:, i] = z
                else:
                    j[:, :3, i] = z / scale
            return j @ chain.matrix

        e = error(q)
        cost = (e * e).sum(axis=1)
        done, live = [], np.arange(count)
        for _ in range(120):
            j = jacobian(q)
            a = np.swapaxes(j, 1, 2) @ j
            g = (np.swapaxes(j, 1, 2) @ e[:, :, None])[:, :, 0]
            a[:, range(chain.n), range(chain.n)] += damping[:, None] * np.maximum(a[:, range(chain.n), range(chain.n)], 1e-3)
            step = np.linalg.solve(a, g[:, :, None])[:, :, 0]
            size = np.abs(step).max(axis=1)
            step *= np.minimum(1.0, 1.0 / np.maximum(size, 1e-300))[:, None]
            tried = q + step
            e2 = error(tried)
            cost2 = (e2 * e2).sum(axis=1)
            good = cost2 <= cost
            q, e = np.where(good[:, None], tried, q), np.where(good[:, None], e2, e)
            cost = np.where(good, cost2, cost)
            damping = np.where(good, np.maximum(damping * 0.2, 1e-12), np.minimum(damping * 4, 1e6))
            finished = cost < 1e-26
            if finished.any():
                done.append(q[finished])
            keep = ~finished & (damping < 1e6)
            q, e, cost, damping = q[keep], e[keep], cost[keep], damping[keep]
            if not len(q):
                break
        if len(q):
            done.append(q[cost < 1e-20])
        return np.concatenate(done) if done else np.zeros((0, chain.n))

    def solve(pose):
        kept, hits, total = [], [], 0
        for count in (2000, 2000, 4000, 4000, 4000):
            total += count
            for q in descend(pose, count):
                for k, other in enumerate(kept):
                    if np.abs(chain.wrapped(q - other)).max() < 1e-5:
                        hits[k] += 1
                        break
                else:
                    kept.append(q)
                    hits.append(1)
            if len(kept) > 40:
                raise ValueError("more than 40: a family of solutions")
            if hits and min(hits) >= 4:
                break
        solve.rarest = (min(hits, default=0), total)
        return kept

    return solve, "Levenberg-Marquardt"


def record(name):
    began = time.time()
    robot = Robot(CATALOGUE / f"{name}.toml")
    rng = np.random.default_rng([SEED, zlib.crc32(name.encode())])
    given_names = GIVEN.get(name, [])
    kinds = {}
    for row in robot.rows:
        for joint in row.joints:
            kinds.setdefault(joint, row.kind)
    scale = max(0.1, robot.reach() / 2)

    def draw():
        ranges = [(-math.pi, math.pi) if kinds[f"q{i + 1}"] == "R" else (0.1, 0.7) for i in range(robot.n)]
        return [round(float(rng.uniform(*r)), 6) for r in ranges]

    def smallest(chain, q):
        """The smallest singular value of the pose's derivative: 0 where solutions form families or meet."""
        columns = [(chain.pose(q + d) - chain.pose(q - d)).ravel() / 2e-6 for d in np.eye(chain.n) * 1e-6]
        return float(np.linalg.svd(np.array(columns), compute_uv=False)[-1])

    first = draw()
    freeze = lambda q: {g: q[int(g[1:]) - 1] for g in given_names}
    chain = Chain(robot, freeze(first))
    result = {"given": given_names, "parameters": robot.parameters}
    if smallest(chain, np.array(first)[chain.index]) < 1e-6:
        result["refused"] = "the arm moves with its hand still: no count"
        return name, result, {"seconds": 0}
    builders = {}
    for label, build in (("EAIK", eaik), ("ssik", ssik)):
        solve, result[label] = build(chain)
        if solve:
            builders[label] = build
    # ssik derives a general arm once (a minute): its given joints keep one value.
    constant = "general" in result["ssik"]

    def equal(a, b):
        return len(a) == len(b) and all(chain.holds(b, x, 1e-4) for x in a)

    cases, notes = [], {"agree": 0, "differ": []}
    for k in range(CASES if builders else CASES_NEWTON):
        q = draw()
        if constant:
            for g in given_names:
                q[int(g[1:]) - 1] = first[int(g[1:]) - 1]
        if k == 0 or given_names and not constant:
            chain = Chain(robot, freeze(q))
            solvers = {label: build(chain)[0] for label, build in builders.items()}
        free = np.array(q)[chain.index]
        pose = chain.pose(free)
        returned, found, rarest = {}, {}, None
        for label, solve in solvers.items():
            try:
                returned[label] = solve(pose) if solve else []
            except Exception as error:
                notes["differ"].append((k, label, f"{type(error).__name__}: {error}"[:120]))
                returned[label] = []
            found[label] = chain.distinct(returned[label], pose)
        complete = lambda: all(chain.holds(s, free, 1e-4) for s in found.values()) and all(
            equal(a, b) for a in found.values() for b in found.values())
        if not complete() or len(found) < 2 or name in CONTROL and k < CASES_NEWTON:
            solve = newton(chain, scale, rng)[0]
            found["newton"] = chain.distinct(solve(pose), pose)
            rarest = solve.rarest
        case = {"q": q}
        if complete() and (len(found) >= 2 or rarest[0] >= 4):
            case["count"] = len(found["newton"] if "newton" in found else found["ssik"])
            if "newton" in found:
                case["by"] = list(found)
                case["rarest"] = list(rarest)
            notes["agree"] += 1
        else:
            union = [free]
            for s in found.values():
                union += [x for x in s if not chain.holds(union, x, 1e-4)]
            case["counts"] = {label: len(s) for label, s in found.items()}
            case["union"] = len(union)
            case["smallest_singular_value"] = float(f"{min(smallest(chain, u) for u in union):.1e}")
            case["rarest"] = list(rarest)
            if builders:
                # What a counter missed: the nearest of what it returned, and by how much it fails.
                misses = {}
                for label in solvers:
                    for u in union:
                        if not chain.holds(found[label], u, 1e-4):
                            near = [(float(np.abs(chain.wrapped(np.asarray(c) - u)).max()), float(np.abs(chain.pose(c) - pose).max()))
                                    for c in returned[label] if np.isfinite(c).all()]
                            misses.setdefault(label, []).append(min(near, default=None))
                notes["differ"].append((k, case["counts"], case["union"], case["smallest_singular_value"], rarest, misses))
        if k < 2:
            case["pose"] = [[float(v) + 0.0 for v in row] for row in pose]
        cases.append(case)
    result["source"] = [f"{label} {version(label)}" for label in builders]
    if any("newton" in c.get("by", c.get("counts", [])) for c in cases):
        result["source"].append("newton")
    result["cases"] = cases
    notes["seconds"] = round(time.time() - began, 1)
    return name, result, notes


def check_forward():
    """Our forward kinematics against Pinocchio's poses."""
    worst = 0.0
    for name, robot in json.loads((HERE / "fk.json").read_text())["robots"].items():
        model = Robot(CATALOGUE / f"{name}.toml")
        chain = Chain(model, {})
        for sample in robot["samples"]:
            worst = max(worst, np.abs(chain.pose(np.array(sample["q"])) - np.array(sample["pose"])).max())
    assert worst < 1e-13, worst
    return worst


def main():
    worst = check_forward()
    names = sys.argv[1:] or [p.stem for p in sorted(CATALOGUE.glob("*.toml"))]
    # Long derivations first.
    slow = {"kinova-jaco", "kinova-mico", "oblique-6r", "ufactory-xarm6", "fanuc-crx10ia-l", "abb-gofa-crb15000-5",
            "motoman-hc10", "rethink-sawyer", "rethink-baxter-left"}
    names.sort(key=lambda n: (n not in slow, n))
    robots = {}
    with multiprocessing.Pool(2) as pool:
        for name, result, notes in pool.imap_unordered(record, names):
            robots[name] = result
            print(name, result.get("refused") or (result["EAIK"], result["ssik"], notes["agree"], len(notes["differ"])), notes["seconds"], flush=True)
            for line in notes["differ"][:3]:
                print("   differ: case, counts, union, smallest singular value, rarest, nearest (joints, pose):", line, flush=True)
    provenance = {
        "EAIK": version("EAIK"), "ssik": version("ssik"), "numpy": version("numpy"),
        "made_by": "crates/robot/tests/peers/ik.py",
        "date": datetime.date.today().isoformat(),
        "seed": SEED,
        "note": "count: distinct real solutions modulo 2 pi, limits ignored, the same set from every counter named in `by` "
        "(EAIK and ssik where there is no `by`), each held to the pose by make_fk.py's rows to 1e-8; counts: what each counter "
        "found where they differ; union: distinct solutions found by all together; rarest: starts that "
        "led to newton's rarest solution, of how many; SI units, radians",
        "forward_difference": worst,
    }
    lines = ["{", f'"provenance": {json.dumps(provenance)},', '"robots": {']
    for k, name in enumerate(sorted(robots)):
        robot = robots[name]
        cases = robot.pop("cases", [])
        head = json.dumps({"robot": name} | robot)[1:-1]
        lines.append(f'"{name}": {{{head}, "cases": [')
        lines += [json.dumps(c, separators=(",", ":")) + ("," if i + 1 < len(cases) else "") for i, c in enumerate(cases)]
        lines.append("]}" + ("," if k + 1 < len(robots) else ""))
    lines += ["}", "}"]
    (HERE / "ik.json" if not sys.argv[1:] else pathlib.Path("ik.part.json")).write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
