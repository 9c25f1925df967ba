"""Forward kinematics of every catalogue robot, computed by two peers.

Reads ../../catalogue/*.toml, places every robot in random configurations and writes fk.json beside this
file: the pose of the last frame (with base and tool), and for some robots every link frame (with base,
without tool). The numbers are Pinocchio's; robotics-toolbox-python computes them again, and the two must
agree to 1e-13 of the reach.

Conventions (one row = one transform):
  standard  Rz(theta) Tz(d) Tx(a) Rx(alpha)
  craig     Rx(alpha) Tx(a) Rz(theta) Tz(d)
  khalil    the same product as craig, with d for a and r for d
Run: python make_fk.py, in an environment with pin, numpy and roboticstoolbox-python.
"""

import ast
import datetime
import json
import math
import pathlib
import re
import tomllib
from fractions import Fraction
from importlib.metadata import version

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
CATALOGUE = HERE.parent.parent / "catalogue"
SEED = 20240229
WITH_FRAMES = {
    "staubli-rx90", "stanford", "prrrrp", "ur3-lab", "cylindrical-wrist", "cylindrical-wrist-b",
    "smart5-six-rail", "franka-panda", "ur5",
}


class Cell:
    """An exact value: number + angle in turns + a linear combination of joint variables."""

    def __init__(self, number=0, turns=0, joints=None):
        self.number, self.turns = Fraction(number), Fraction(turns)
        self.joints = {k: v for k, v in (joints or {}).items() if v}

    def scaled(self, k):
        return Cell(self.number * k, self.turns * k, {q: v * k for q, v in self.joints.items()})

    def plus(self, other):
        joints = dict(self.joints)
        for q, v in other.joints.items():
            joints[q] = joints.get(q, Fraction(0)) + v
        return Cell(self.number + other.number, self.turns + other.turns, joints)

    def times(self, other):
        if not other.turns and not other.joints:
            return self.scaled(other.number)
        if not self.turns and not self.joints:
            return other.scaled(self.number)
        raise ValueError("a product of two angles or joint variables")

    def si(self):
        assert not self.joints
        return float(self.number) + 2 * math.pi * float(self.turns)


UNITS = {
    "deg": Cell(turns=Fraction(1, 360)), "pi": Cell(turns=Fraction(1, 2)), "rad": Cell(1), "m": Cell(1),
    "cm": Cell(Fraction(1, 100)), "mm": Cell(Fraction(1, 1000)), "s": Cell(1),
}


def evaluate(text, symbols):
    """The cell `text`: numbers, units, pi, + - * / and parentheses, and the names in `symbols`."""
    if not isinstance(text, str):
        return Cell(Fraction(repr(text)))
    text = re.sub(r"(?<![\w.])(\d+\.?\d*(?:[eE][-+]?\d+)?)\s*(deg|rad|mm|cm|m|pi)\b", r"(\1*\2)", text)

    def walk(node):
        match node:
            case ast.Expression():
                return walk(node.body)
            case ast.Constant():
                return Cell(Fraction(ast.get_source_segment(text, node)))
            case ast.Name():
                return symbols[node.id] if node.id in symbols else UNITS[node.id]
            case ast.UnaryOp(op=ast.USub()):
                return walk(node.operand).scaled(-1)
            case ast.UnaryOp(op=ast.UAdd()):
                return walk(node.operand)
            case ast.BinOp(op=ast.Add()):
                return walk(node.left).plus(walk(node.right))
            case ast.BinOp(op=ast.Sub()):
                return walk(node.left).plus(walk(node.right).scaled(-1))
            case ast.BinOp(op=ast.Mult()):
                return walk(node.left).times(walk(node.right))
            case ast.BinOp(op=ast.Div()):
                divisor = walk(node.right)
                assert not divisor.turns and not divisor.joints, text
                return walk(node.left).scaled(1 / divisor.number)
        raise ValueError(f"cannot read {text!r}")

    return walk(ast.parse(text.strip(), mode="eval"))


def cos_sin(angle, rest=0.0):
    """cos and sin of the constant angle plus `rest` radians; whole quarter turns are exact."""
    quarters = round(angle.turns * 4)
    x = 2 * math.pi * float(angle.turns - Fraction(quarters, 4)) + float(angle.number) + rest
    c, s = math.cos(x), math.sin(x)
    return [(c, s), (-s, c), (-c, -s), (s, -c)][quarters % 4]


def rot(axis, angle):
    c, s = cos_sin(angle)
    i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    m = np.eye(4)
    m[i, i], m[i, j], m[j, i], m[j, j] = c, -s, s, c
    return m


def trans(axis, length):
    m = np.eye(4)
    m["xyz".index(axis), 3] = length.si()
    return m


class Row:
    """theta, d, a, alpha as cells; the joint's type; the constant parts before and after its motion."""

    def __init__(self, convention, table, symbols, number):
        read = lambda key: evaluate(table.get(key, "0"), symbols)
        if convention == "khalil":
            self.theta, self.d, self.a, self.alpha = read("theta"), read("r"), read("d"), read("alpha")
        else:
            self.theta, self.d, self.a, self.alpha = read("theta"), read("d"), read("a"), read("alpha")
        assert not self.a.joints and not self.alpha.joints
        assert not (self.theta.joints and self.d.joints), "two joint variables in a row"
        moving = self.theta if self.theta.joints else self.d
        self.kind = "R" if self.theta.joints else "P" if self.d.joints else "F"
        self.joints = moving.joints
        constant = lambda cell: Cell(cell.number, cell.turns)
        self.theta0, self.d0 = constant(self.theta), constant(self.d)
        z = rot("z", self.theta0) @ trans("z", self.d0)
        x = trans("x", self.a) @ rot("x", self.alpha)

        self.before, self.after = (z, x) if convention == "standard" else (x @ z, np.eye(4))
        self.limits = None
        if "limits" in table:
            self.limits = tuple(evaluate(v, symbols).si() for v in table["limits"])
        if number is not None:
            assert f"q{number}" in self.joints, f"the variable of this row is q{number}"

    def value(self, q):
        """What the joint of this row moves by: a coupling adds several joint variables."""
        return sum(float(k) * q[name] for name, k in self.joints.items())


class Robot:
    def __init__(self, path):
        self.file = tomllib.loads(path.read_text(encoding="utf-8"))
        self.convention = self.file["convention"]
        self.symbols = {}
        for i, (name, text) in enumerate(self.file.get("parameters", {}).items()):
            if text == {}:
                text = f"{0.2 + 0.07 * i:.2f}"
            self.symbols[name] = evaluate(text, {})
        self.parameters = {k: v.si() for k, v in self.symbols.items()}
        names = {f"q{i}": Cell(joints={f"q{i}": Fraction(1)}) for i in range(1, 100)}
        symbols = names | self.symbols
        self.rows, count = [], 0
        for table in self.file["joints"]:
            row = Row(self.convention, table, symbols, None)
            if row.kind != "F":
                count += 1
                row = Row(self.convention, table, symbols, count)
            self.rows.append(row)
        self.n = count
        self.base, self.tool = (self.placement(self.file.get(k, {}), symbols) for k in ("base", "tool"))

    @staticmethod
    def placement(table, symbols):
        if "matrix" in table:
            return np.array(table["matrix"], dtype=float)
        xyz = [evaluate(v, symbols) for v in table.get("xyz", ["0"] * 3)]
        rpy = [evaluate(v, symbols) for v in table.get("rpy", ["0"] * 3)]
        t = trans("x", xyz[0]) @ trans("y", xyz[1]) @ trans("z", xyz[2])
        return t @ rot("z", rpy[2]) @ rot("y", rpy[1]) @ rot("x", rpy[0])

    def reach(self):
        lengths = [abs(r.a.si()) + abs(r.d0.si()) + (0.5 if r.kind == "P" else 0) for r in self.rows]
        return max(1.0, sum(lengths) + np.linalg.norm(self.base[:3, 3]) + np.linalg.norm(self.tool[:3, 3]))

    def draw(self, rng):
        q = []
        for row in self.rows:
            if row.kind != "F":
                q.append(rng.uniform(*(row.limits or ((-math.pi, math.pi) if row.kind == "R" else (0.0, 0.5)))))
        return [float(v) for v in q]

    def named(self, q):
        return {f"q{i + 1}": v for i, v in enumerate(q)}


def pinocchio_frames(robot, q):
    """Frame i after row i, with base; the joints are built one by one."""
    import pinocchio as pin

    se3 = lambda m: pin.SE3(m[:3, :3].copy(), m[:3, 3].copy())
    model, parent, pending, values = pin.Model(), 0, robot.base, []
    named, frames = robot.named(q), []
    for i, row in enumerate(robot.rows):
        pending = pending @ row.before
        if row.kind != "F":
            joint = pin.JointModelRZ() if row.kind == "R" else pin.JointModelPZ()
            parent = model.addJoint(parent, joint, se3(pending), f"j{i}")
            pending = np.eye(4)
            values.append(row.value(named))
        pending = pending @ row.after
        frames.append(model.addFrame(pin.Frame(f"f{i}", parent, 0, se3(pending), pin.FrameType.OP_FRAME)))
    data = model.createData()
    pin.framesForwardKinematics(model, data, np.array(values))
    return [data.oMf[f].homogeneous.copy() for f in frames]


def toolbox_pose(robot, q):
    """The last frame with base and tool; constant rows are folded into base and tool."""
    import roboticstoolbox as rtb
    from spatialmath import SE3

    se3 = lambda m: SE3(m, check=False)
    standard = robot.convention == "standard"
    links, base, tool, values, named = [], robot.base, np.eye(4), [], robot.named(q)
    for row in robot.rows:
        if row.kind == "F":
            fixed = row.before @ row.after
            if links:
                tool = tool @ fixed
            else:
                base = base @ fixed
            continue
        assert np.array_equal(tool, np.eye(4)), "a constant row between joints"
        common = dict(a=row.a.si(), alpha=row.alpha.si())
        if row.kind == "R":
            link = (rtb.RevoluteDH if standard else rtb.RevoluteMDH)(d=row.d0.si(), offset=row.theta0.si(), **common)
        else:
            link = (rtb.PrismaticDH if standard else rtb.PrismaticMDH)(theta=row.theta0.si(), offset=row.d0.si(), **common)
        links.append(link)
        values.append(row.value(named))
    arm = rtb.DHRobot(links, base=se3(base), tool=se3(tool @ robot.tool))
    return arm.fkine(values).A


def matrix(m):
    return [[float(v) + 0.0 for v in row] for row in m]


def main():
    rng = np.random.default_rng(SEED)
    robots, worst = {}, 0.0
    for path in sorted(CATALOGUE.glob("*.toml")):
        robot = Robot(path)
        samples = []
        for q in [[0.0] * robot.n] + [robot.draw(rng) for _ in range(8)]:
            frames = pinocchio_frames(robot, q)
            pose = frames[-1] @ robot.tool
            difference = np.abs(pose - toolbox_pose(robot, q)).max() / robot.reach()
            assert difference < 1e-13, (path.stem, q, difference)
            worst = max(worst, difference)
            sample = {"q": q, "pose": matrix(pose)}
            if path.stem in WITH_FRAMES:
                sample["frames"] = [matrix(f) for f in frames]
            samples.append(sample)
        robots[path.stem] = {"parameters": robot.parameters, "reach": robot.reach(), "samples": samples}
    provenance = {
        "pinocchio": version("pin"),
        "roboticstoolbox": version("roboticstoolbox-python"),
        "made_by": "crates/robot/tests/peers/make_fk.py",
        "date": datetime.date.today().isoformat(),
        "note": "numbers: Pinocchio; agreed with the toolbox to 1e-13 of the reach; SI units, radians",
        "largest_difference": worst,
    }
    lines = ["{", f'"provenance": {json.dumps(provenance)},', '"robots": {']
    for k, (name, robot) in enumerate(robots.items()):
        lines.append(f'"{name}": {{"parameters": {json.dumps(robot["parameters"])}, "reach": {float(robot["reach"])!r}, "samples": [')
        lines += [json.dumps(s) + ("," if i + 1 < len(robot["samples"]) else "") for i, s in enumerate(robot["samples"])]
        lines.append("]}" + ("," if k + 1 < len(robots) else ""))
    lines += ["}", "}"]
    (HERE / "fk.json").write_text("\n".join(lines) + "\n", encoding="utf-8")
    print(f"{len(robots)} robots, largest difference {worst:.1e} of the reach")


if __name__ == "__main__":
    main()
