"""Reads every URDF and xacro file of three packages of PyPI with Denavit, beside Pinocchio and the reference xacro.

Run: python read_all.py DENAVIT WHEEL, with the path of the program and that of pybullet's wheel, of which only the data are used;
in an environment with pin, example-robot-data, rtb-data and xacro.

A file is sound if xacro, where it is one for xacro, and Pinocchio read it. At three configurations, the first with all joints
at 0, the poses of all its links are held against Pinocchio's as they are written, entry by entry, lengths by the reach of the
file's links. What is refused is refused with line and column. Each chain from the root to a leaf that moves is asked for, with its
angles as they are written: its table is proved to be the chain, or the bound that the program gives for the difference of axes and
tip, in directions and metres, is below BOUND.
"""

import collections
import concurrent.futures
import functools
import importlib.util
import json
import math
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ET
import zipfile

import numpy as np
import pinocchio as pin
import xacro
import xacro.substitution_args

TOLERANCE = 1e-12
LEAST_READ = 0.99
CONFIGURATIONS = 3
SEED = 20
FIND = re.compile(r"\$\(find ([A-Za-z0-9_]+)\)")
PLACE = re.compile(r":\d+:\d+: error: ")
WITHIN = re.compile(r"chain within ([0-9.e-]+)")
BOUND = 1e-17
PACKAGES = {}
ENVIRONMENT = {**os.environ, "NO_COLOR": "1"}


def folders(wheel, scratch):
    """The packages by name, and where their files are."""
    share = next(p for p in pathlib.Path(pin.__file__).parents if (p / "share/example-robot-data").is_dir())
    rtb = pathlib.Path(importlib.util.find_spec("rtbdata").origin).parent
    with zipfile.ZipFile(wheel) as archive:
        wanted = [n for n in archive.namelist() if n.startswith("pybullet_data/") and n.endswith((".urdf", ".xacro", ".xml", ".yaml"))]
        archive.extractall(scratch, wanted)
    return {
        "example-robot-data": share / "share/example-robot-data/robots",
        "pybullet_data": pathlib.Path(scratch) / "pybullet_data",
        "rtb-data": rtb,
    }


def packages_in(folder):
    """The packages that files look for, where a folder is theirs: their own name, or with or without a word more."""
    folders = {}
    for found in sorted(p for p in folder.rglob("*") if p.is_dir()):
        folders.setdefault(found.name, found)
    texts = (p.read_text(errors="replace") for p in folder.rglob("*.xacro"))
    wanted = {name for text in texts for name in FIND.findall(text)}
    spellings = {n: (n, n.removesuffix("_support"), f"{n}_description", f"clearpath_{n}") for n in wanted}
    found = {n: next((folders[s] for s in all_of if s in folders), None) for n, all_of in spellings.items()}
    return {name: str(path) for name, path in sorted(found.items()) if path}


def find_package(packages, name):
    if name not in packages:
        raise ValueError("a package is not there")
    return packages[name]


def expanded(path):
    """The URDF that a file is; an error if xacro refuses it."""
    text = path.read_bytes()
    if path.suffix != ".xacro" and b"xmlns:xacro" not in text:
        return text
    return xacro.process_file(str(path)).toxml().encode()


def model_of(text):
    """The model, and whether mimic joints are left to us."""
    try:
        return pin.buildModelFromXML(text.decode(), mimic=True), False
    except ValueError:
        # It takes no joints that mimic joints that mimic, for one.
        return pin.buildModelFromXML(text.decode()), True


def mimics(root):
    """The joint that each follows, with factor and offset."""
    found = {}
    for joint in root.findall("joint"):
        if (m := joint.find("mimic")) is not None:
            found[joint.get("name")] = (m.get("joint"), float(m.get("multiplier", 1)), float(m.get("offset", 0)))
    return found


def samples(text, seed):
    """Values of the joints by name, and the poses of the links that Pinocchio gives."""
    chance = random.Random(seed)
    model, is_free = model_of(text)
    data = model.createData()
    follows = mimics(ET.fromstring(text)) if is_free else {}
    result = []
    for k in range(CONFIGURATIONS):
        values = {}

        def value(name):
            if name in follows and model.existJointName(follows[name][0]):
                leader, factor, offset = follows[name]
                return factor * value(leader) + offset
            return values.setdefault(name, chance.uniform(-1.5, 1.5) if k else 0.0)

        q = pin.neutral(model)
        for j in range(1, model.njoints):
            joint, name = model.joints[j], model.names[j]
            kind, at = joint.shortname(), slice(joint.idx_q, joint.idx_q + joint.nq)
            if "Mimic" in kind or "FreeFlyer" in kind:
                continue
            if "Planar" in kind:
                x, y, turn = (value(f"{name} {part}") for part in ("x", "y", "turn"))
                q[at] = [x, y, math.cos(turn), math.sin(turn)]
            elif joint.nq == 2:
                q[at] = [math.cos(value(name)), math.sin(value(name))]
            else:
                q[at] = value(name)
        pin.forwardKinematics(model, data, q)
        pin.updateFramePlacements(model, data)
        links = {f.name: data.oMf[i].homogeneous for i, f in enumerate(model.frames) if f.type == pin.FrameType.BODY}
        result.append((values, links))
    return result


def denavit(program, verb, path, *words):
    if path.suffix == ".xacro":
        words += tuple(f"--package={name}={folder}" for name, folder in PACKAGES.items())
    words = (verb, str(path), *words)
    done = subprocess.run([program, *words], capture_output=True, env=ENVIRONMENT, timeout=600)
    return done.returncode, done.stdout.decode(), done.stderr.decode()


def apart(program, path, expected):
    """The largest difference of a pose, by the reach; or why the file is not read."""
    most = 0.0
    for values, links in expected:
        at = "; ".join(f"{name}={value!r}" for name, value in values.items())
        words = ["-q", at] if at else ["-q", ""]
        code, out, said = denavit(program, "fk", path, "--frames", "all", "--as-written", "--json", *words)
        if code != 0:
            return None, said
        ours = {frame["name"]: np.array(frame["pose"]) for frame in json.loads(out)["frames"]}
        reach = max([np.linalg.norm(x[:3, 3]) for x in links.values()] + [1e-3])
        for name, pose in links.items():
            if name not in ours:
                return None, f"no link {name}"
            difference = np.abs(ours[name] - pose)
            difference[:3, 3] /= reach
            most = max(most, difference.max())
    return most, None


def chains(program, path, text):
    """The chains from the root to leaves that move, by what was said of them."""
    root = ET.fromstring(text)
    joints = [(j.find("parent").get("link"), j.find("child").get("link"), j.get("type")) for j in root.findall("joint")]
    above = {child: (parent, kind) for parent, child, kind in joints}
    parents = {parent for parent, _, _ in joints}
    found = []
    for leaf in (child for child in above if child not in parents):
        link, moves = leaf, False
        while link in above:
            link, kind = above[link]
            moves |= kind not in ("fixed", "floating")
        if not moves:
            continue
        _, _, said = denavit(program, "show", path, "--tip", leaf, "--as-written", "--json")
        within = WITHIN.search(said)
        kind = None
        if "is proved to be the file's chain" in said:
            kind = "proved"
        elif "to 60 digits" in said or within and float(within[1].rstrip(".")) <= BOUND:
            kind = f"held to {BOUND:.0e}"
        found.append((leaf, kind, said.strip().splitlines()[-1:]))
    return found


def reason(said):
    """The first error, without its place."""
    errors = [line for line in said.splitlines() if "error: " in line]
    return re.sub(r"`[^`]*`", "`…`", errors[0].split("error: ", 1)[1]) if errors else said.strip()


def reference(path):
    """The URDF and its poses by the peers, or why there are none."""
    try:
        text = expanded(path)
        if ET.fromstring(text).tag != "robot" or b"<link" not in text:
            return None, None, "macros alone"
        return text, samples(text, f"{SEED} {path.name}"), None
    except Exception as why:  # Whatever a peer raises.
        return None, None, f"not sound ({type(why).__name__}: {(str(why).splitlines() or [''])[0][:70]})"


def judge(program, path, text, expected, wrong):
    """What is counted of a file, how far its links are off, and what is not as it should be."""
    if wrong:
        code, _, said = denavit(program, "fk", path, "--frames", "all", "--as-written", "--json", "-q", "")
        is_refused = code == 3
        findings = [] if not is_refused or PLACE.search(said) else [f"refused without a place: {said.strip()}"]
        return [f"{wrong}; here {'refused: ' + reason(said) if is_refused else 'read'}"], 0, findings
    most, why = apart(program, path, expected)
    if why is None and not most <= TOLERANCE:
        why = f"links differ by {most:.1e} of the reach"
    if why is not None:
        return ["sound"], 0, [why.strip()]
    counted = ["sound", "sound and read"]
    counted += ["links"] * len(expected[0][1]) + ["poses"] * sum(len(links) for _, links in expected)
    findings = []
    for leaf, kind, said in chains(program, path, text):
        counted += ["chains"] + ([f"chains {kind}"] if kind else [])
        if kind is None:
            findings.append(f"the chain to {leaf}: {said}")
    return counted, most, findings


def main(program, wheel):
    failures = []
    with tempfile.TemporaryDirectory() as scratch:
        packages = folders(wheel, scratch)
        for folder in packages.values():
            PACKAGES.update(packages_in(folder))
        xacro.substitution_args._eval_find = functools.partial(find_package, PACKAGES)
        sound = read = 0
        for package, folder in packages.items():
            counts, most = collections.Counter(), 0
            files = sorted(p for p in folder.rglob("*") if p.suffix in (".urdf", ".xacro"))
            with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
                # The peers run one file at a time: xacro keeps its state in the module.
                judged = [(path, pool.submit(judge, program, path, *reference(path))) for path in files]
            for path, one in judged:
                counted, apart_by, findings = one.result()
                counts.update(counted)
                most = max(most, apart_by)
                failures += [f"{path.relative_to(folder)}: {finding}" for finding in findings]
            sound, read = sound + counts["sound"], read + counts["sound and read"]
            print(f"{package}: {len(files)} files, links apart by {most:.1e} of the reach at most")
            for what, count in sorted(counts.items()):
                print(f"  {count:5} {what}")
    for failure in failures:
        print(failure, file=sys.stderr)
    print(f"{read} of {sound} sound files are read, links as Pinocchio has them; {len(failures)} findings")
    return 0 if not failures and read >= LEAST_READ * sound else 1


sys.exit(main(*sys.argv[1:]))
