"""The notebooks of the documentation: each runs, and gives what stands in it."""

import pytest

from notebooks import FOLDER, read, run

NOTEBOOKS = sorted(FOLDER.glob("*.ipynb"))


def test_there_are_notebooks():
    assert [path.stem for path in NOTEBOOKS] == ["dynamics", "first_steps", "homework", "own_urdf"]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_gives_what_stands_in_it(path, tmp_path, monkeypatch):
    if path.stem in ("dynamics", "homework"):
        pytest.importorskip("sympy")
    monkeypatch.chdir(tmp_path)
    notebook = read(path)
    assert (notebook["nbformat"], notebook["nbformat_minor"]) == (4, 5)
    assert len({cell["id"] for cell in notebook["cells"]}) == len(notebook["cells"])
    claims = 0
    for cell, count, outputs in run(notebook):
        assert cell["execution_count"] == count
        claims += "".join(cell["source"]).count("assert ")

        # Pictures may change; texts are what a reader compares.
        def texts(outputs):
            return [o.get("text") or o["data"]["text/plain"] for o in outputs]

        assert texts(cell["outputs"]) == texts(outputs), "".join(cell["source"])
    assert claims >= 5


def test_notebooks_are_valid():
    nbformat = pytest.importorskip("nbformat")
    for path in NOTEBOOKS:
        nbformat.validate(nbformat.read(path, as_version=4))
