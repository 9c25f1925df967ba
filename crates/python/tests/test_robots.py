"""Robots from the catalogue, files, rows and texts; what they say; what is derived of them."""

import copy
import doctest
import importlib
import inspect
import json
import math
import pickle
import subprocess
import sys

import numpy as np
import pytest

import denavit
from conftest import DOCUMENTS, ROOT, URDF
from denavit import (
    ChainError,
    DenavitError,
    DescriptionError,
    DescriptionWarning,
    FileError,
    Robot,
    UnknownRobotError,
    UnsupportedError,
    UsageError,
    check,
)


def test_names_of_the_catalogue():
    assert Robot("UR5") == Robot("ur5") == Robot("ur5", convention="standard")
    with pytest.raises(UnknownRobotError, match="did you mean .*ur5") as caught:
        Robot("ur-5")
    assert isinstance(caught.value, (DenavitError, LookupError))
    assert len(denavit.catalogue()) == 99


def test_what_a_robot_says():
    robot = Robot("ur5")
    assert repr(robot) == "<Robot: Universal Robots UR5, 6 joints (RRRRRR), standard convention>"
    assert (robot.name, robot.n, robot.convention) == ("Universal Robots UR5", 6, "standard")
    assert robot.parameters["a2"] == -0.425
    assert robot.joints[5].limits == (-2 * math.pi, 2 * math.pi)
    assert robot.joints[0].velocity == pytest.approx(math.pi)
    assert np.allclose(robot.poses["home"], [0, -math.pi / 2, 0, -math.pi / 2, 0, 0])
    assert "a2" in str(robot) and "−90°" in str(robot)
    page = robot._repr_html_()
    assert page.count("<tr>") == 7 and "<svg" in page and "<script" not in page
    assert "Forward model <math" in page and "<mtable>" in page and page.count("<div") == page.count("</div>")


def test_what_stands_in_a_page_is_escaped():
    robot = Robot.from_dh([("q1", 0, 1, 0)], convention="standard", name='<b>"&\n\x7f \U0001f9be')
    assert robot.name == '<b>"&   \U0001f9be'
    assert "<b>" not in robot._repr_html_().split("<svg")[0]


def test_rows():
    half = math.pi / 2
    rows = [("q1", 0.4, 0, half), ("q2", 0, "L", 0), (0, 0, 0.1, 0)]
    robot = Robot.from_dh(rows, convention="standard", parameters={"L": "300 mm"})
    # A quarter turn is exact.
    assert robot.fk([0.0, 0.0])[2, 2] == 0.0
    assert 'alpha = "90 deg"' in robot.toml
    assert any("read as π/2" in f.message for f in robot.findings)
    by_letter = [
        {"theta": "q1", "d": 0.4, "alpha": "pi/2"},
        {"theta": "q2", "a": "L"},
        {"a": np.float64(0.1)},
    ]
    assert Robot.from_dh(by_letter, convention="standard", parameters={"L": 0.3}).toml == robot.toml
    khalil = Robot.from_dh([{"alpha": 0, "theta": "q1", "gamma": half, "r": 1}], convention="khalil")
    assert np.allclose(khalil.fk([0.0])[:3, 3], [0, 0, 1])
    tool = Robot.from_dh(
        [("q1", 0, 1, 0)], convention="standard", tool={"xyz": [0, 0, 0.1], "rpy": [half, 0, 0]}
    )
    assert tool.fk([0.0])[2, 3] == pytest.approx(0.1)
    slide = Robot.from_dh([(0, "q1", 0, 0)], convention="standard")
    assert [j.kind for j in slide.joints] == ["prismatic"]


def test_rows_that_are_wrong():
    with pytest.raises(DescriptionError) as caught:
        Robot.from_dh([("q1", "L", 0, "90 dge"), ("q3", 0, 0, 0)], convention="standard")
    findings = caught.value.findings
    errors = [f for f in findings if f.severity == "error"]
    assert len(errors) >= 2 and all(f.line > 0 and f.column > 0 and f.message for f in errors)
    assert "dge" in str(caught.value)
    again = pickle.loads(pickle.dumps(caught.value))
    assert again.findings == findings and str(again) == str(caught.value)
    for rows, convention, what in [
        ([("q1", 0, 0)], "standard", "row 1 has 3 cells"),
        (["q1"], "standard", "row 1 is neither"),
        ([("q1", 0, 0, math.inf)], "standard", "inf is no value"),
        ([("q1", 0, True, 0)], "standard", "True is no value"),
        ([("q1", 0, object(), 0)], "standard", "is no value"),
        ([], "paul", "no convention `paul`"),
    ]:
        with pytest.raises(UsageError, match=what):
            Robot.from_dh(rows, convention=convention)


def test_warnings_are_pythons_own():
    with pytest.warns(DescriptionWarning, match="no row holds a joint variable") as caught:
        Robot.from_dh([(0, 0, 1, 0)], convention="standard")
    assert caught[0].filename == __file__
    robot = Robot.from_dh([("q1", 0, 1, 0)], convention="standard", tool=np.eye(4))
    assert robot.findings == () and robot.fk([0.0])[0, 3] == 1.0
    with pytest.raises(UsageError, match="4×4"):
        Robot.from_dh([("q1", 0, 1, 0)], convention="standard", tool=np.eye(3))


INTERRUPTED = """
import os, signal, threading, time
from denavit import Robot

# Whoever runs the tests in the background may have it ignored.
signal.signal(signal.SIGINT, signal.default_int_handler)
robot = Robot("franka-panda")
begun = time.perf_counter()
robot.dynamics_explain()
whole = time.perf_counter() - begun
sent = []


def interrupt():
    sent.append(time.perf_counter())
    os.kill(os.getpid(), signal.SIGINT)


threading.Timer(whole / 10, interrupt).start()
try:
    for _ in range(100):
        robot.dynamics_explain()
except KeyboardInterrupt:
    print((time.perf_counter() - sent[0]) / whole)
"""


def test_long_derivations_hear_signals():
    run = subprocess.run([sys.executable, "-c", INTERRUPTED], capture_output=True, text=True, check=True)
    assert "PanicException" not in run.stderr
    # As a share of a derivation that nobody interrupts: heard within it, not behind it.
    assert float(run.stdout) < 0.8


def test_the_position_of_short_arms_is_looked_at():
    found = Robot("planar-2r").jacobian_explain()
    assert "a1a2S2" in found and "Rows vy, wz" in found
    assert json.loads(found.to("json"))["point"]["determinants"][0]["determinant"] == "a1*a2*S2"
    assert "point" not in json.loads(Robot("ur5").jacobian_explain("json"))


def test_values_of_parameters():
    robot = Robot("ur5").set(d6="100 mm", a2=-0.5)
    assert (robot.parameters["d6"], robot.parameters["a2"]) == (0.1, -0.5)
    assert Robot("ur5").parameters["d6"] == 0.0823
    with pytest.raises(UsageError, match="d9"):
        robot.set(d9=1)
    with pytest.raises(UsageError, match="dge"):
        robot.set(d6="1 dge")


def test_files(tmp_path, cli):
    arm = Robot.from_file(URDF / "ur5_robot.urdf", tip="wrist_3_link")
    assert arm.n == 6 and arm.joints[0].name == "shoulder_pan_joint" and arm.joints[0].limits is not None
    q = [0.3, -1.2, 1.5, 0.4, 0.9, -0.6]
    words = [str(URDF / "ur5_robot.urdf"), "--tip", "wrist_3_link"]
    printed = json.loads(cli("fk", *words, "-q", ",".join(map(str, q)), "--json"))
    assert np.abs(arm.fk(q) - np.array(printed["pose"])).max() <= 1e-15
    part = arm.chain("shoulder_link", "wrist_1_link")
    assert [j.name for j in part.joints] == [j.name for j in arm.joints[1:4]]
    with pytest.raises(ChainError, match="no_such_link"):
        arm.chain(tip="no_such_link")
    with pytest.raises(ChainError, match="one chain"):
        Robot("ur5").chain(tip="wrist")
    assert pickle.loads(pickle.dumps(arm)).fk(q).tolist() == arm.fk(q).tolist()

    table = tmp_path / "arm.csv"
    table.write_text("theta,d,a,alpha\nq1,400,0,90\nq2,0,300,0\n")
    small = Robot.from_file(table, convention="standard", angles="deg", lengths="mm")
    assert np.allclose(small.fk([0, 0])[:3, 3], [0.3, 0, 0.4])
    file = tmp_path / "arm.toml"
    file.write_text(small.toml, encoding="utf-8")
    assert Robot.from_file(str(file)).toml == small.toml
    file.write_text(small.toml.replace("90 deg", "90 dge"), encoding="utf-8")
    with pytest.raises(DescriptionError) as caught:
        Robot.from_file(file)
    assert caught.value.findings[0].file == str(file)
    assert caught.value.findings[0].rendered in str(caught.value)
    for path, what in [(tmp_path / "none.toml", "none.toml"), (tmp_path, "what is this")]:
        with pytest.raises(FileError, match=what):
            Robot.from_file(path)
    with pytest.raises(UsageError, match="no unit `inch`"):
        Robot.from_file(table, lengths="inch")


def test_notes_are_kept():
    notes = Robot.from_file(URDF / "ur5_robot.urdf", tip="wrist_3_link").findings
    assert notes and all(n.severity in ("note", "warning") for n in notes)


def test_conversions():
    robot = Robot("puma560")
    q = np.linspace(-1, 1, 6)
    for convention in ("standard", "craig", "khalil"):
        assert np.allclose(robot.converted(convention).fk(q), robot.fk(q), atol=1e-14)
    with pytest.raises(UsageError, match="standard, craig or khalil"):
        robot.converted("paul")


def test_a_robot_is_a_value():
    robot = Robot("scara")
    assert copy.copy(robot) == copy.deepcopy(robot) == robot != Robot("ur5")
    assert len({robot, Robot("scara")}) == 1


def test_formulas(cli):
    robot = Robot("staubli-rx90")
    text = robot.derive()
    assert "= C1(D3C2 − RL4S23)" in text and "proved equal" in text
    assert robot.derive("json").strip() == cli("derive", "staubli-rx90", "--json").strip()
    assert robot.derive("latex").strip() == cli("derive", "staubli-rx90", "--format", "latex").strip()
    assert "\\cos" in robot.derive("latex") or "C_" in robot.derive("latex")
    assert "t14" not in robot.derive("text", only="orientation").split("lgorithm")[1]
    assert robot.ik_explain().strip() == cli("ik", "staubli-rx90", "--explain").strip()
    assert robot.jacobian_explain().strip() == cli("jacobian", "staubli-rx90", "--explain").strip()
    assert (
        robot.jacobian_explain("json").strip()
        == cli("jacobian", "staubli-rx90", "--explain", "--json").strip()
    )
    with pytest.raises(UsageError, match="no format `word`"):
        robot.derive("word")
    with pytest.raises(UnsupportedError, match="no closed form"):
        Robot("fanuc-crx10ia-l").ik_explain()
    assert "XX1" in Robot("planar-2r").dynamics_explain() or "ZZ1" in Robot("planar-2r").dynamics_explain()
    assert robot.figure(scheme=True).startswith("<svg")
    assert robot.report().lstrip().lower().startswith("<!doctype html")


def test_documents(cli):
    path = DOCUMENTS / "rx90.md"
    found = check(path)
    printed = json.loads(cli("check", str(path), "--json", may_fail=True))
    assert found.data["claims"] == printed["claims"] and found.tally == printed["tally"]
    assert not found.ok and [c for c in found.claims if c.verdict == "wrong"]
    assert Robot("staubli-rx90").check(path.read_text(encoding="utf-8")).tally["equal"] > 0
    assert check(str(path)).tally == found.tally
    for none in (path.with_name("none.md"), "none.md", "p_x = 1"):
        with pytest.raises(FileError):
            check(none)


def test_code(tmp_path):
    robot = Robot("ur5")
    files = robot.generate("python", folder=tmp_path / "ur5", name="ur5")
    assert all((tmp_path / "ur5" / path).read_text(encoding="utf-8") == text for path, text in files.items())
    robot.generate("python", folder=tmp_path / "ur5", name="ur5")
    changed = next(iter(files))
    (tmp_path / "ur5" / changed).write_text("mine")
    with pytest.raises(FileError, match="there already"):
        robot.generate("python", folder=tmp_path / "ur5", name="ur5")
    assert (tmp_path / "ur5" / changed).read_text() == "mine"
    robot.generate("python", folder=tmp_path / "ur5", name="ur5", overwrite=True)
    assert (tmp_path / "ur5" / changed).read_text(encoding="utf-8") == files[changed]
    with pytest.raises(UsageError, match="no code is written in `cobol`"):
        robot.generate("cobol")
    with pytest.raises(UsageError, match="dance"):
        robot.generate("c", ["dance"])


@pytest.mark.parametrize("page", ["README.md", "docs/python.md", "docs/migration.md", "docs/site/index.md"])
def test_programs_of_pages_run(page, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    programs = (ROOT / page).read_text(encoding="utf-8").split("```python\n")[1:]
    assert programs
    for program in programs:
        exec(compile(program.split("```")[0], page, "exec"), {})
    assert page == "docs/migration.md" or "8 solutions, complete" in capsys.readouterr().out


@pytest.mark.parametrize(
    "name",
    [
        "denavit",
        "denavit._answers",
        "denavit._derivations",
        "denavit._documents",
        "denavit._formulas",
        "denavit._motion",
        "denavit._numbers",
        "denavit._robot",
        "denavit.eaik",
        "denavit.ikpy",
        "denavit.jax",
    ],
)
def test_docstrings(name):
    failed, tried = doctest.testmod(importlib.import_module(name))
    assert failed == 0 and tried > 0


def test_everything_public_is_described():
    for name in denavit.__all__:
        what = getattr(denavit, name)
        assert isinstance(what, str) or what.__doc__
    for name, what in inspect.getmembers(Robot):
        if not name.startswith("_"):
            assert what.__doc__, name


def test_import_is_quick():
    code = "import numpy, time; t = time.process_time(); import denavit; print(time.process_time() - t)"
    times = [float(subprocess.check_output([sys.executable, "-c", code])) for _ in range(5)]
    assert min(times) < 0.1, times


@pytest.mark.skipif(not hasattr(__import__("os"), "fork"), reason="no fork")
def test_a_fork_goes_on():
    # In a process of its own: those that other tests load may not be forked.
    code = """
import os
from denavit import Robot
robot = Robot("ur5")
robot.fk([0.0] * 6)
child = os.fork()
if child == 0:
    ok = robot.jacobian([0.1] * 6).shape == (6, 6) and len(robot.ik(robot.fk([0.1] * 6))) > 0
    os._exit(0 if ok else 1)
assert os.waitpid(child, 0)[1] == 0
"""
    subprocess.run([sys.executable, "-c", code], check=True, timeout=120)
