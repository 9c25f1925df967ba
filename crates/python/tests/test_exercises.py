"""Exercise sheets: made again they are the same, their solutions earn all points, slips do not."""

import json
import pickle

import pytest

from denavit import Robot, UnsupportedError, UsageError

KINDS = ["fk", "dh", "ik", "jacobian", "singularities"]


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", ["planar-3r", "puma560"])
def test_solutions_earn_all_points(name, kind):
    exercise = Robot(name).exercise(kind, seed=21)
    marked = exercise.check(exercise.solution)
    assert marked.checked.ok and marked.points == marked.most > 0, str(marked)
    assert exercise == Robot(name).exercise(kind, seed=21)
    assert Robot.from_toml(exercise.toml).n == Robot(name).n


def test_a_slip_costs_points():
    exercise = Robot("planar-2r").exercise("fk", seed=2)
    slipped = exercise.solution.replace("-S_{1}", "S_{1}", 1)
    marked = exercise.check(slipped)
    assert not marked.checked.ok and marked.points < marked.most
    assert "points" in str(marked)


def test_as_on_the_command_line(cli):
    exercise = Robot("scara").exercise("ik", seed=5, count=2)
    command = ["exercise", "scara", "--kind", "ik", "--seed", "5", "--count", "2", "--solution"]
    assert json.loads(cli(*command, "--format", "json")) == exercise.data
    assert exercise.sheet("latex", solution=True).startswith("%")
    assert "Pose 2" in exercise.sheet("typst") and exercise._repr_markdown_() == exercise.statement


def test_what_there_is_not():
    with pytest.raises(UsageError, match="fk, dh, ik"):
        Robot("ur5").exercise("poetry")
    with pytest.raises(UsageError, match="1 to 20"):
        Robot("ur5").exercise("fk", count=0)
    with pytest.raises(UnsupportedError, match="infinitely many"):
        Robot("kuka-iiwa-7").exercise("ik")
    with pytest.raises(UsageError, match="written in `it`"):
        Robot("ur5").exercise("fk", language="it")
    assert pickle.loads(pickle.dumps(Robot("planar-2r").exercise("dh"))).title
