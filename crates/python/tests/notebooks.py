"""Notebooks run without a notebook: `python tests/notebooks.py` runs those of `docs/notebooks` and stores what their cells give."""

import ast
import contextlib
import io
import json
import os
import tempfile
from pathlib import Path

FOLDER = Path(__file__).resolve().parents[3] / "docs" / "notebooks"


def read(path):
    return json.loads(path.read_text(encoding="utf-8"))


def lines(text):
    """A text as notebooks hold it."""
    return text.splitlines(keepends=True)


def run(notebook):
    """What each cell with code gives, in order: cells share their names, and the last expression of one is shown."""
    names = {"__name__": "__main__"}
    count = 0
    for cell in notebook["cells"]:
        if cell["cell_type"] != "code":
            continue
        count += 1
        tree = ast.parse("".join(cell["source"]))
        last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
        printed, shown = io.StringIO(), None
        with contextlib.redirect_stdout(printed):
            exec(compile(tree, f"cell {count}", "exec"), names)
            if last is not None:
                shown = eval(compile(ast.Expression(last.value), f"cell {count}", "eval"), names)
        outputs = []
        if printed.getvalue():
            outputs.append({"name": "stdout", "output_type": "stream", "text": lines(printed.getvalue())})
        if shown is not None:
            data = {"text/plain": lines(repr(shown))}
            if hasattr(shown, "_repr_html_"):
                data["text/html"] = lines(shown._repr_html_())
            outputs.append(
                {"data": data, "execution_count": count, "metadata": {}, "output_type": "execute_result"}
            )
        yield cell, count, outputs


def write(path):
    """Runs a notebook and stores what its cells give."""
    notebook = read(path)
    for cell, count, outputs in run(notebook):
        cell["execution_count"], cell["outputs"] = count, outputs
    text = json.dumps(notebook, indent=1, ensure_ascii=False) + "\n"
    path.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    notebooks = sorted(FOLDER.glob("*.ipynb"))
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for each in notebooks:
            write(each)
